"""Runs in other processes are those of this one: ProcessPoolExecutor, joblib and Dask over carom.simulate; laws of files too."""

from __future__ import annotations

import copy
import functools
import importlib.util
import os
import pickle
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import pytest

import carom
from carom import scene
from carom.laws.registry import find_law
from carom.public.own_laws import OwnLaw

OWN = "def law(v, w, n, a, kappa, e, mu, beta):\n    return (-0.5 * v[0], v[1], v[2]), w\n"


def scenes(law: Any = "two-step") -> list[carom.Scene]:
    wall = scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.85, friction=0.2)
    balls = [carom.SceneBall(radius=0.03, mass=0.2, position=(0.5, 0), velocity=(-2, 1), rolling=True)]
    first = carom.Scene(floor=carom.Floor(friction=0.2), walls=[wall], balls=balls, run=carom.Run(duration=1, law=law))
    return [carom.replaced(first, {"balls.0.velocity": (-2, y)}) for y in (0.5, 1.0, 1.5)]


@functools.cache
def spawned() -> ProcessPoolExecutor:
    """One pool for all tests: each process imports carom."""
    return ProcessPoolExecutor(1, mp_context=get_context("spawn"))


def processes(given: Sequence[Any]) -> list[Any]:
    return list(spawned().map(carom.simulate, given))


def joblib(given: Sequence[Any]) -> list[Any]:
    import joblib

    return list(joblib.Parallel(n_jobs=2)(joblib.delayed(carom.simulate)(one) for one in given))


def dask(given: Sequence[Any]) -> list[Any]:
    import dask

    return list(
        dask.compute(*(dask.delayed(carom.simulate)(one) for one in given), scheduler="processes", num_workers=1)
    )


def installed(name: str) -> bool:
    """Whether an extra of the developers is there; CI, which installs it, fails without it."""
    return bool(os.environ.get("CI")) or importlib.util.find_spec(name) is not None


POOLS = [
    processes,
    pytest.param(
        joblib, marks=pytest.mark.skipif(not installed("joblib"), reason="joblib, of the extra dev, is not installed")
    ),
    pytest.param(
        dask, marks=pytest.mark.skipif(not installed("dask"), reason="dask, of the extra dev, is not installed")
    ),
]


@pytest.mark.parametrize("pool", POOLS)
@pytest.mark.slow(keep=1)
def test_runs_of_a_pool_are_those_of_this_process(pool: Callable[[Sequence[Any]], list[Any]]) -> None:
    for run, one in zip(pool(scenes()), scenes(), strict=True):
        expected = carom.simulate(one)
        assert run.log.tobytes() == expected.log.tobytes()
        assert run.at(0.5).position.tobytes() == expected.at(0.5).position.tobytes()


def test_a_pool_runs_laws_of_a_file(tmp_path: Path) -> None:
    (tmp_path / "own.py").write_text(OWN)
    law = find_law(OwnLaw(f"{tmp_path / 'own.py'}:law"))
    for run, one in zip(processes(scenes(law)), scenes(law), strict=True):
        assert run.log.tobytes() == carom.simulate(one).log.tobytes()


def test_laws_of_a_file_are_pickled_as_its_place_and_copied(tmp_path: Path) -> None:
    file = tmp_path / "own.py"
    file.write_text(OWN)
    law = find_law(OwnLaw(f"{file}:law"))
    assert OWN.encode() not in pickle.dumps(law)
    for other in (pickle.loads(pickle.dumps(law)), copy.copy(law), copy.deepcopy(law)):
        assert (type(other), other.name) == (type(law), "law")
        one, two = (carom.compare(laws=[x], friction=0.0)["law"].angle_after_wall_deg for x in (law, other))
        assert one == two
    again = pickle.dumps(law)
    file.write_text(OWN.replace("0.5", "0.6"))
    with pytest.raises(carom.CaromError, match="expected the file as it was when the law was pickled"):
        pickle.loads(again)
    file.unlink()
    with pytest.raises(carom.CaromError, match="expected a Python file"):
        pickle.loads(again)


def test_an_opened_file_still_runs_no_law(tmp_path: Path) -> None:
    """The permission is the pickle's: a text of the same place that comes out of a file has none."""
    file = tmp_path / "own.py"
    file.write_text(OWN)
    law = find_law(OwnLaw(f"{file}:law"))
    assert pickle.loads(pickle.dumps(law)).name == "law"
    text = carom.scene_text().replace('law = "two-step"', f'law = "{file}:law"')
    with pytest.raises(carom.CaromError, match="opening a file runs no code"):
        carom.load_scene(text)
