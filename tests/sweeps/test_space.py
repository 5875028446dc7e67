"""Spaces of sweeps: dimensions, points, draws that follow from a point's index alone, and what they refuse."""

from __future__ import annotations

import warnings

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
            "balls.0.velocity": carom.polar(speed=[1.0, 2.0], angle_deg=np.linspace(0, 90, 4)),
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


@pytest.mark.parametrize("form", ["linspace", "geomspace", "arange"])
@pytest.mark.parametrize("given", [[0.5, np.inf, 3], [np.nan, 1.0, 3], [-1e308, 1e308, 3], [1e-320, np.inf, 2]])
def test_values_between_ends_that_are_too_large_are_refused(form: str, given: list[float]) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(carom.CaromError):
            axis_from_data({form: given}, "axis")


def test_values_are_those_that_were_given_bit_for_bit() -> None:
    for given in (np.linspace(0.1, 0.3, 21), np.array([0.1 + 0.2, 0.3, 0.0, 1 / 3])):
        space = carom.Space(table_scene(), {"walls.*.friction": given})
        again = axis_from_data(axis_to_data(space.parameters["walls.*.friction"]), "axis")
        assert space.columns(0, len(given))["walls.*.friction"].tobytes() == given.tobytes() == again.values.tobytes()


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


KINDS = {
    "number": 0.1, "numbers": [0.1, 0.2], "pairs": [[0.1, 0.2], [0.3, 0.4]], "vectors": [[0.1, 0.2, 0.3], [0.3, 0.4, 0.5]],
    "names": ["mirror", "no-slip"], "uniform": sweeps.uniform(0, 1), "normal": sweeps.normal(0.5, 0.1),
    "sobol": sweeps.sobol(0, 1, 4), "hypercube": sweeps.latin_hypercube(0, 1, 4), "polar": carom.polar([1, 2], [100, 120]),
    "drawn polar": carom.polar(sweeps.uniform(0, 1), 90), "along": sweeps.along("axis", [1, 2]), "infinite": [1, np.inf],
}  # fmt: skip
PLACES = {
    "scene": (
        "floor.friction",
        "balls.0.velocity",
        "balls.0.velocity.x",
        "balls.0",
        "balls",
        "balls.*.spin",
        "run.law",
        "gravity",
    ),
    "cylinder": ("walls.0.axis", "walls.0.axis.x", "walls.0.radius"),
    "impact": ("angle", "law", "inertia", "spin_x"),
    "orbit": ("law", "bounces", "table.points", "table.points.0", "table.points.0.x", "kappa"),
}


def subject(name: str) -> tuple[object, list[str]]:
    """A subject, and outcomes with dimensions of their own."""
    if name == "impact":
        return sweeps.ImpactCase(), ["reflection_angle", "final.velocity"]
    if name == "orbit":
        return sweeps.OrbitCase(table="polygon:points=0,0 1,0 0,1", bounces=3), ["time"]
    if name == "scene":
        return table_scene(duration=0.1), ["final.position"]
    wall = {
        "shape": "cylinder",
        "inside": True,
        "point": (0, 0, 0),
        "axis": (0, 0, 1),
        "radius": 2.0,
        "restitution": 0.9,
        "friction": 0.1,
    }
    ball = {"radius": 0.03, "mass": 0.2, "position": (0, 0, 0), "velocity": (1, 0, 0)}
    return carom.Scene(gravity=0, walls=[wall], balls=[ball], run={"duration": 0.1}), ["final.position"]


@pytest.mark.parametrize("name", PLACES)
@pytest.mark.filterwarnings("error")
def test_every_kind_of_values_in_every_place(name: str) -> None:
    """Computed, or refused in one line: draws in the place of a vector, vectors in the place of a number ended in IndexErrors."""
    given, keep = subject(name)
    computed = 0
    for path in PLACES[name]:
        for kind, values in KINDS.items():
            try:
                found = carom.sweep(carom.Space(given, {path: values}), keep).run()
            except carom.CaromError as error:
                unclear = [fault for fault in error.faults if not fault.startswith("Space: ")]
                assert unclear == [], (path, kind)
            else:
                computed += int((found["failed"] == 0).any())
    assert computed >= {"scene": 20, "cylinder": 6, "impact": 10, "orbit": 6}[name]


@pytest.mark.parametrize(
    ("path", "values", "said"),
    [
        ("balls.0.velocity", sweeps.uniform(0, 1), r"expected .*, got 0\.5"),
        ("balls.0.velocity.x", np.ones((4, 3)), "expected a speed in m/s, got"),
        ("floor.friction", carom.polar(1, [0, 90]), "expected"),
        ("balls.0", [[0, 1, 2]], "expected"),
    ],
)
def test_what_cannot_stand_in_a_place_is_refused(path: str, values: object, said: str) -> None:
    with pytest.raises(carom.CaromError, match=f"Space: {path}: .*{said}"):
        carom.Space(table_scene(), {path: values})


def test_points_that_a_scene_refuses_are_no_reason_to_refuse_a_space() -> None:
    places = [[0.29, 0.2], [0.31, 0.2], [0.3, 0.21], [-0.6, 0.0]]  # (the first three in another ball)
    found = carom.sweep(carom.Space(table_scene(duration=0.1), {"balls.0.position": places}), ["final.time"]).run()
    assert (found["failed"].values == 0).tolist() == [False, False, False, True]
    carom.Space(table_scene(), {"floor.friction": sweeps.uniform(-0.5, 0.5)})


@pytest.mark.parametrize("dim", ["axis", "ball", "failed", "blocks", "repeat", "events.count"])
@pytest.mark.parametrize("make", [sweeps.along, lambda dim, values: sweeps.sobol(values[0], values[1], 2, dim)])
def test_a_dimension_with_a_name_of_the_result(dim: str, make: object) -> None:
    def run() -> None:
        axis = make(dim, [0.1, 0.2])  # type: ignore[operator]
        carom.sweep(carom.Space(table_scene(), {"floor.friction": axis}), ["final.position", "events.count"])

    with pytest.raises(carom.CaromError, match="expected a name"):
        run()


def test_names_that_two_things_would_have() -> None:
    case = sweeps.ImpactCase()
    with pytest.raises(carom.CaromError, match=r"Space: angle: expected a name .*, got 'energy_ratio'"):
        carom.sweep(carom.Space(case, {"angle": sweeps.along("energy_ratio", [1.0, 2.0])}), ["energy_ratio"])
    together = {"angle": sweeps.along("k", [1.0, 2.0]), "speed": sweeps.along("k", [1.0, 2.0])}
    with pytest.raises(carom.CaromError, match=r"Space: angle: expected a name .*, got 'angle'"):
        carom.Space(case, {**together, "spin_z": sweeps.along("angle", [1.0, 2.0, 3.0])})


def test_a_list_has_a_dimension_of_its_own() -> None:
    """A dimension that somebody else had named so, or an axis given twice, made two parameters vary together."""
    named = sweeps.along("friction", [0.1, 0.2])
    space = carom.Space(table_scene(), {"floor.friction": named, "walls.0.friction": [0.3, 0.4]})
    assert space.dims == {"friction": 2, "walls_0_friction": 2}
    aim = carom.polar([1.0, 2.0], [0.0, 90.0])
    space = carom.Space(table_scene(), {"balls.0.velocity": aim, "balls.1.velocity": aim})
    assert len(space.dims) == 4
    points = {str(space.point(k)) for k in range(space.size)}
    assert len(points) == space.size == 16
    assert list(
        carom.Space(sweeps.ImpactCase(), {"angle": sweeps.along("speed", [1, 2]), "speed": [1, 2]}).dims.values()
    ) == [2, 2]
    with pytest.raises(carom.CaromError, match="along: values: expected values, got"):
        sweeps.along("k", sweeps.uniform(0, 1))
    with pytest.raises(carom.CaromError, match="sobol: dim: expected a name"):
        sweeps.sobol(0, 1, 4, dim=3)


def test_points_that_no_impact_has_are_refused_alone() -> None:
    """One ball of kappa above 2/3, or a negative friction, ended the whole sweep."""
    for path, values, good in (
        ("inertia", sweeps.sobol(0.3, 1.0, 64), 2 / 3),
        ("friction", sweeps.sobol(-0.2, 0.5, 64), None),
        ("gravity", [9.8, 1.6], None),
    ):
        space = carom.Space(sweeps.ImpactCase(friction=0.2), {path: values})
        found = carom.sweep(space, ["final.velocity"]).run()
        given = found[path if path == "gravity" else "sample"].values
        accepted = given <= good if good else given >= 0
        assert (found["failed"].values == 0).tolist() == accepted.tolist()
        alone = carom.Space(
            sweeps.ImpactCase(**{"friction": 0.2, path: given[-1 if accepted[-1] else accepted.argmax()]}),
            {"angle": 45.0},
        )
        number = len(given) - 1 if accepted[-1] else int(accepted.argmax())
        expected = carom.sweep(alone, ["final.velocity"]).run()["final.velocity"].values
        assert found["final.velocity"].values[number].tolist() == expected.tolist()
