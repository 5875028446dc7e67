"""The function that JAX and PyTorch are given, by itself."""

from __future__ import annotations

import numpy as np
import pytest
from reference.sweep_scenes import table_scene

from carom.interop.run_function import RunFunction


@pytest.mark.parametrize("wrt", ["balls.0.velocity", "walls.*.friction"])
def test_no_points_have_no_outcomes(wrt: str) -> None:
    run = RunFunction(table_scene(duration=0.5), wrt, "final.position", "test")
    p = len(run.columns)
    for before in ((0,), (3, 0), (0, 2)):
        none = np.zeros((*before, p))
        assert run.evaluate(none).shape == (*before, 3, 3)
        assert [one.shape for one in run.differentiate(none)] == [(*before, 3, 3), (*before, 3, 3, p)]
