"""Kernels that are compiled for their callers only; and in the ordinary way, where Numba is not as carom knows it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numba
import pytest
from numba.extending import register_jitable

from carom.core.jit import compile as linked


def half(x: float) -> float:
    return x / 2


def third(x: float) -> float:
    return half(x) / 3


def test_what_is_linked_gives_the_same_bits(tmp_path: Path) -> None:
    made = []
    for options in (linked.linked_only(tmp_path), {}):
        space: dict[str, Any] = {}
        for function in (half, third):
            fresh = type(function)(function.__code__, {**globals(), **space}, function.__name__)
            space[function.__name__] = register_jitable(no_cpython_wrapper=True, no_cfunc_wrapper=True, **options)(
                fresh
            )
        kernel = space["third"]
        made.append(numba.njit(lambda x, kernel=kernel: kernel(x) + kernel(x + 1)))
    for x in (0.1, 1e-300, 3.7e8, float("inf")):
        assert made[0](x) == made[1](x) == third(x) + third(x + 1)


def test_another_numba_is_met_by_the_ordinary_way(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(linked, "linked_pipeline", object)  # not a compiler
    assert linked.linked_only.__wrapped__(tmp_path) == {}
    assert list(tmp_path.iterdir()) == []


def test_one_trial_is_enough(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    tried = []
    monkeypatch.setattr(linked, "_try", tried.append)
    for _ in range(2):
        assert list(linked.linked_only.__wrapped__(tmp_path / "new")) == ["pipeline_class"]
    assert len(tried) == 1
    assert [path.name for path in (tmp_path / "new").iterdir()] == [f"linked_with_numba_{numba.__version__}"]
