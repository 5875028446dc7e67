"""The function that JAX and PyTorch are given, by itself."""

from __future__ import annotations

import numpy as np
import pytest
from reference.sweep_scenes import table_scene

import carom
from carom.errors import CaromError
from carom.interop.run_function import RunFunction


@pytest.mark.parametrize("wrt", ["balls.0.velocity", "walls.*.friction"])
def test_no_points_have_no_outcomes(wrt: str) -> None:
    run = RunFunction(table_scene(duration=0.5), wrt, "final.position", "test")
    p = len(run.columns)
    for before in ((0,), (3, 0), (0, 2)):
        none = np.zeros((*before, p))
        assert run.evaluate(none).shape == (*before, 3, 3)
        assert [one.shape for one in run.differentiate(none)] == [(*before, 3, 3), (*before, 3, 3, p)]


@pytest.mark.parametrize("wrt", [["walls.*.friction"], ["balls.0.velocity", "floor.friction", "walls.0.restitution"]])
def test_surfaces_need_no_scene_of_their_own_at_each_point(wrt: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    """One surface's number among the parameters made a gradient 60 times slower."""
    scene = table_scene(duration=0.5)
    run = RunFunction(scene, wrt, "final.velocity", "test")
    points = run.start + 1e-3 * np.random.default_rng(1).uniform(-1, 1, (8, len(run.columns)))
    for point, found, slopes in zip(points, *run.differentiate(points), strict=True):
        one = carom.simulate(run._scene(point))
        assert np.array_equal(found, one.final.velocity)
        np.testing.assert_allclose(slopes, one.sensitivity(wrt).final.velocity, rtol=1e-9, atol=1e-9)
    assert np.array_equal(run.evaluate(points), run.differentiate(points)[0])
    monkeypatch.setattr(run, "_scene", None)  # (within the values that were accepted)
    assert run.differentiate(points[::-1])[1].shape == (8, 3, 3, len(run.columns))


@pytest.mark.parametrize("value", [-1.0, np.nan])
@pytest.mark.slow(keep=1)
def test_a_number_that_a_scene_refuses_is_refused(value: float) -> None:
    run = RunFunction(table_scene(duration=0.5), ["floor.friction"], "final.velocity", "test")
    with pytest.raises(CaromError, match=r"floor\.friction"):
        run.evaluate(np.array([[0.2], [value]]))
