"""Whatever is written is read back: every shape, container, option and law, through files, dumps, pickles, changes and stores."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from reference.drawn_options import FORMULAS, random_gas, random_impact, random_orbit_case, random_scene
from reference.trips import lost_trips, same

import carom
from carom.gas import GasScene, Session, save_checkpoint
from carom.gas.containers import CONTAINERS, container
from carom.gas.files import RunFiles, run_with_files
from carom.scene.schema import from_file
from carom.scene.shapes import SHAPES

BALL = {"radius": 0.03, "mass": 0.2, "position": (0.1, 0.0), "velocity": (1.5, 0.4)}
GAS = {
    "species": [{"count": 4, "radius": 0.1}],
    "contacts": [{"between": ("*", "*"), "restitution": 0.9, "friction": 0}],
}


def in_curve(**curve: Any) -> carom.Scene:
    wall = {"shape": "curve", "restitution": 0.85, "friction": 0.2, **curve}
    return carom.Scene(floor={"friction": 0.2}, walls=[wall], balls=[BALL], run={"duration": 0.9})


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.slow(keep=8)
def test_a_scene_of_every_shape_comes_back(shape: str, tmp_path: Path) -> None:
    k = list(SHAPES).index(shape)
    assert lost_trips(random_scene(k, shape), tmp_path, stores=k % 6 == 0) == []


@pytest.mark.parametrize("shape", CONTAINERS)
def test_a_gas_in_every_container_comes_back(shape: str, tmp_path: Path) -> None:
    k = list(CONTAINERS).index(shape)
    assert lost_trips(random_gas(k, shape), tmp_path, stores=k % 5 == 3) == []


@pytest.mark.parametrize("make", [random_impact, random_orbit_case])
def test_what_sweeps_compute_comes_back_from_their_stores(make: Any, tmp_path: Path) -> None:
    for seed in range(3):
        assert lost_trips(make(seed), tmp_path / str(seed), stores=True) == []


def test_a_curve_by_formula_comes_back_and_its_numbers_have_derivatives(tmp_path: Path) -> None:
    for k, sizes in enumerate(FORMULAS):
        assert lost_trips(in_curve(**sizes), tmp_path / str(k), stores=False) == []
    scene = in_curve(**FORMULAS[0])
    found = carom.simulate(scene).sensitivity(
        [f"walls.0.{name}" for name in ("friction", "center", "angle", "yield_time")]
    )
    ends = [carom.simulate(carom.replaced(scene, {"walls.0.center": (x, 0.0)})).final.position for x in (1e-6, -1e-6)]
    assert found.columns[1:3] == ["walls.0.center.x", "walls.0.center.y"]
    assert np.abs((ends[0] - ends[1]) / 2e-6 - found.final.position[..., 1]).max() < 1e-6


def test_a_python_function_is_refused_before_anything_is_written(tmp_path: Path) -> None:
    scene = in_curve(r=lambda theta: 1 + 0.1 * np.cos(3 * theta))
    gas = GasScene(
        container={"shape": "curve", "r": lambda theta: 3 + 0.1 * np.cos(theta)}, **GAS, run={"max_events": 9}
    )
    session, files = Session(gas), RunFiles(checkpoint=tmp_path / "gas.npz")
    sweep = carom.sweep(carom.Space(scene, {"walls.0.friction": [0.1]}), ["events.count"], tmp_path / "s.zarr")
    for write, at in (
        (lambda: carom.save_scene(scene, tmp_path / "scene.toml"), "walls[0].r"),
        (lambda: carom.simulate(scene).save(tmp_path / "run.parquet"), "walls[0].r"),
        (lambda: save_checkpoint(session, tmp_path / "gas.npz"), "container.r"),
        (lambda: run_with_files(session, files, stop=lambda: False, progress=print, say=print), "container.r"),
        (sweep.run, "walls[0].r"),
    ):
        with pytest.raises(carom.CaromError) as refused:
            write()
        assert [fault.field for fault in refused.value.records] == [at]
    assert session.gas.collisions == 0
    assert not list(tmp_path.iterdir())
    # in memory it may be anything
    assert same(carom.Scene(**scene.model_dump()), scene)


def test_a_table_keeps_what_differs_from_its_preset(tmp_path: Path) -> None:
    for own in (
        {"corner_pockets": None},
        {"nose_height": None},
        {"contact_time": 0.003},
        {"tangential_restitution": 0.0},
    ):
        wall = {"shape": "table", "preset": "pool-9ft", **own}
        scene = carom.Scene(floor={"friction": 0.2}, walls=[wall], balls=[BALL])
        assert lost_trips(scene, tmp_path, stores=False) == []


def test_signs_of_zeros_and_names_of_numbers_come_back(tmp_path: Path) -> None:
    ball = {**BALL, "velocity": (-0.0, 1.0, -0.0), "name": "inf"}
    scene = carom.Scene(
        gravity=0,
        walls=[{"shape": "plane", "point": (-3, -0.0, 0), "normal": (1, 0, 0), "law": "mirror"}],
        balls=[ball],
    )
    assert lost_trips(scene, tmp_path) == []


def test_scenes_that_were_simulated_are_compared() -> None:
    one, two = in_curve(**FORMULAS[0]), in_curve(**FORMULAS[0])
    for scene in (one, two):
        carom.simulate(scene)
    other = carom.replaced(one, {"balls.0.mass": 0.3})
    assert one == two
    assert one in [other, two]
    assert {one: 1}[two] == 1
    assert one != other
    gases = [
        GasScene(container={"shape": "curve", "r": "3 + 0.1*cos(theta)"}, **GAS, run={"max_events": 9}) for _ in "ab"
    ]
    assert [made.container.geometry.outline is None for made in gases] == [False, False]
    assert gases[0] in [gases[1]]


def test_records_with_arrays_are_compared() -> None:
    corners = [(0, 0), (4, 0), (1, 1), (0, 4)]
    for make in (
        lambda x: carom.Ball(radius=np.array([0.1, x])), lambda x: carom.Surface(np.array([0.5, x])),
        lambda x: carom.Cue(mass=np.array([0.5, x])), lambda x: container("polygon", points=[*corners[:3], (0, 4 + x)]),
    ):  # fmt: skip
        assert make(0.2) == make(0.2)
        assert make(0.2) in [make(0.3), make(0.2)]
        assert make(0.2) != make(0.3)


def test_a_scene_file_of_infinite_numbers_as_json_has_them() -> None:
    assert from_file("floor", carom.Floor, {"friction": "inf"}).friction == float("inf")
    with pytest.raises(carom.CaromError):
        from_file("floor", carom.Floor, {"friction": 0.1, "rolling_resistance": "inf"})
