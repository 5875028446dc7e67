"""Spaces of sweeps: dimensions, points, draws that follow from a point's index alone, and what they refuse."""

from __future__ import annotations

import numpy as np
import pytest
from reference.sweep_scenes import table_scene

import carom
from carom import sweeps
from carom.sweeps.axes import axis_from_data, axis_to_data


def test_dimensions_multiply_and_shared_ones_vary_together() -> None:
    space = carom.Space(
        table_scene(),
        {
            "balls.0.velocity": carom.polar(speed=[1.0, 2.0], angle=np.linspace(0, 90, 4)),
            "walls.*.friction": sweeps.along("cloth", [0.1, 0.2, 0.3]),
            "floor.friction": sweeps.along("cloth", [0.15, 0.2, 0.25]),
            "run.law": ["two-step", "mirror"],
        },
    )
    assert space.dims == {"speed": 2, "angle": 4, "cloth": 3, "law": 2}
    assert space.size == 48
    columns = space.columns(0, space.size)
    index = int(np.ravel_multi_index((1, 2, 1, 1), space.shape))
    assert columns["balls.0.velocity"][index] == pytest.approx([2 * np.cos(np.pi / 3), 2 * np.sin(np.pi / 3), 0])
    assert columns["walls.*.friction"][index] == 0.2
    assert columns["floor.friction"][index] == 0.2
    assert columns["run.law"][index] == "mirror"
    assert space.point(index)["run.law"] == "mirror"


def test_multiples_of_a_right_angle_are_exact() -> None:
    space = carom.Space(table_scene(), {"balls.0.velocity": carom.polar(2.0, [0.0, 90.0, 180.0, 270.0])})
    assert space.columns(0, 4)["balls.0.velocity"].tolist() == [[2, 0, 0], [0, 2, 0], [-2, 0, 0], [0, -2, 0]]


def test_draws_follow_from_the_index_alone() -> None:
    space = carom.Space(
        table_scene(),
        {
            "walls.*.friction": sweeps.uniform(0.1, 0.3),
            "floor.friction": sweeps.normal(0.2, 0.01),
            "balls.0.mass": [0.2, 0.21],
        },
        repeats=500,
        seed=3,
    )
    whole = space.columns(0, space.size)
    parts = [space.columns(first, min(first + 137, space.size)) for first in range(0, space.size, 137)]
    for path, column in whole.items():
        assert np.array_equal(column, np.concatenate([part[path] for part in parts]))
    friction, cloth = whole["walls.*.friction"], whole["floor.friction"]
    assert friction.min() >= 0.1
    assert friction.max() < 0.3
    # mean and deviation of 1,000 numbers: four standard errors
    assert abs(friction.mean() - 0.2) < 4 * 0.2 / np.sqrt(12 * 1000)
    assert abs(cloth.mean() - 0.2) < 4 * 0.01 / np.sqrt(1000)
    assert abs(cloth.std() - 0.01) < 4 * 0.01 / np.sqrt(2000)
    other = carom.Space(table_scene(), {"walls.*.friction": sweeps.uniform(0.1, 0.3)}, repeats=1000, seed=4)
    assert not np.isin(other.columns(0, 1000)["walls.*.friction"], friction).any()


def test_designs_of_one_dimension_fill_the_space_together() -> None:
    given = {"walls.*.friction": sweeps.sobol(0, 1, 256), "floor.friction": sweeps.sobol(0, 1, 256)}
    space = carom.Space(table_scene(), given)
    assert space.dims == {"sample": 256}
    columns = space.columns(0, 256)
    # a net in base 2: every one of 16 x 16 boxes holds one of the 256 points
    boxes = {
        (int(16 * a), int(16 * b)) for a, b in zip(columns["walls.*.friction"], columns["floor.friction"], strict=True)
    }
    assert len(boxes) == 256
    hypercube = carom.Space(table_scene(), {"walls.*.friction": sweeps.latin_hypercube(0, 1, 100)})
    cells = np.floor(hypercube.columns(0, 100)["walls.*.friction"] * 100)
    assert sorted(cells) == list(range(100))


@pytest.mark.parametrize(
    "axis",
    [
        [0.1, 0.2, 0.35], np.linspace(0.1, 0.3, 21), ["two-step", "mirror"], [[1.0, 2.0], [3.0, 4.0]], [1.0, np.inf],
        sweeps.along("a", [1.0, 2.0]), sweeps.uniform(0, 1), sweeps.normal(1, 2), sweeps.sobol(0, 1, 8, dim="d"),
        sweeps.latin_hypercube(0, 1, 9), carom.polar(sweeps.uniform(1, 2), np.linspace(0, 90, 7)),
    ],
)  # fmt: skip
def test_axes_survive_as_plain_data(axis: object) -> None:
    data = axis_to_data(sweeps.axes.as_axis(axis, "axis"))
    assert axis_to_data(axis_from_data(data, "axis")) == data


def test_values_of_linspace_can_be_selected() -> None:
    space = carom.Space(table_scene(), {"walls.*.friction": np.linspace(0.1, 0.3, 21)})
    assert 0.2 in space.columns(0, 21)["walls.*.friction"]


@pytest.mark.parametrize(
    ("parameters", "said"),
    [
        ({"walls.*.frction": [0.1]}, "did you mean 'walls.*.friction'?"),
        ({"walls.*.friction": []}, "walls.*.friction: expected at least one value, got none"),
        ({"walls.*.friction": [0.1, -0.2]}, "expected a number >= 0 (inf: never slips), got -0.2"),
        ({"walls.*.friction": [0.1, np.nan]}, "got NaN at index 1"),
        ({"walls.*.friction": [0.1], "walls.0.friction": [0.2]}, "expected parameters of different numbers"),
        ({"run.law": ["two-stp"]}, "did you mean 'two-step'?"),
        ({"floor.friction": sweeps.along("a", [0.1, 0.2]), "floor.restitution": sweeps.along("a", [0])}, "dimension a has, got 1"),
        ({"walls.*.friction": sweeps.sobol(0, 1, 8), "floor.friction": sweeps.sobol(0, 1, 16)}, "expected designs of one kind"),
        ({}, "expected a mapping of paths to values"),
        ({"balls.0.velocity": [[1, 2, 3, 4]]}, "vectors (N, 2) or (N, 3), got shape (1, 4)"),
    ],
)  # fmt: skip
def test_bad_input_is_one_clear_line(parameters: dict[str, object], said: str) -> None:
    with pytest.raises(carom.CaromError) as caught:
        carom.Space(table_scene(), parameters)
    assert said in str(caught.value)
    assert len(caught.value.faults) == 1


def test_all_faults_at_once() -> None:
    with pytest.raises(carom.CaromError) as caught:
        carom.Space(table_scene(), {"walls.*.frction": [0.1], "floor.friction": []}, repeats=0, seed=-1)
    assert len(caught.value.faults) == 4
