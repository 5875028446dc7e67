"""Holes in walls: over the beginning of the arc length, in several walls, and what is refused; places told from positions."""

from __future__ import annotations

import math

import numpy as np
import pytest

import carom
from carom import billiards

BOUNCES = 30


def first_in(inside: np.ndarray) -> np.ndarray:
    """Return the number of bounces (N,) up to the first that lies in a hole; BOUNCES where none does."""
    return np.where(inside.any(axis=1), inside.argmax(axis=1) + 1, BOUNCES)


def from_angle(x: np.ndarray, angle: float) -> np.ndarray:
    """Return the angles of places (..., 2) about the origin from an angle, in (-pi, pi]."""
    return np.angle(np.exp(1j * (np.arctan2(x[..., 1], x[..., 0]) - angle)))


@pytest.mark.parametrize("hole", [(-0.1, 0.2), (2 * math.pi - 0.1, 2 * math.pi + 0.2), (-1.0, 2.0), (1.0, 1.3)])
def test_a_hole_in_a_circle_is_where_its_angles_are(hole: tuple[float, float]) -> None:
    table = billiards.circle()
    start = billiards.starts(table, 300, seed=5)
    found = billiards.escape(table, start, BOUNCES, holes=[hole], law="mirror")
    middle, half = sum(hole) / 2, (hole[1] - hole[0]) / 2
    x = billiards.orbit(table, start, BOUNCES, law="mirror").position
    assert found.bounces.tolist() == first_in(np.abs(from_angle(x, middle)) < half).tolist()


def test_a_hole_around_a_corner_and_in_an_ellipse() -> None:
    for table, near in (
        # (around the corner at which the arc length of a polygon begins; around the end of the long axis)
        (billiards.rectangle(2.0, 1.0), lambda x: np.abs(x - [-1.0, -0.5]).sum(axis=-1) < 0.1),
        (billiards.ellipse(1.0, 0.5), lambda x: (x[..., 0] > 0) & (np.abs(x[..., 1]) < 0.1)),
        (billiards.ellipse(1.0, 0.5), lambda x: (x[..., 0] < 0) & (np.abs(x[..., 1]) < 0.1)),
    ):
        size = float(table.wall().lengths.sum())
        half = 0.1 if table.name != "ellipse" else float(table.wall().coordinate([0], [(math.sqrt(0.96), 0.1)])[0])
        middle = size / 2 if table.name == "ellipse" and near(np.array([-1.0, 0.0])) else 0.0
        start = billiards.starts(table, 300, seed=2)
        found = billiards.escape(table, start, BOUNCES, holes=[(middle - half, middle + half)])
        x = billiards.orbit(table, start, BOUNCES).position
        assert found.bounces.tolist() == first_in(near(x)).tolist(), table


def test_a_hole_of_several_walls_lies_in_one_of_them() -> None:
    table = billiards.periodic_strip(1.0, 1.0, [(0.0, 0.0, 0.2)])
    low, high, obstacle = table.wall().connected
    assert [(wall.first, wall.last, wall.closed) for wall in (low, high)] == [(0.0, 1.0, True), (1.0, 2.0, True)]
    start = billiards.starts(table, 200, seed=3)
    run = billiards.orbit(table, start, BOUNCES)
    x = run.folded
    # over the end of all walls: on the obstacle, around the angle 0, from which its arc length is clockwise
    found = billiards.escape(table, start, BOUNCES, holes=[(obstacle.last - 0.04, obstacle.last + 0.06)])
    angle = from_angle(x, 0.0)
    assert (
        found.bounces.tolist()
        == first_in((np.hypot(*np.moveaxis(x, -1, 0)) < 0.4) & (angle < 0.2) & (angle > -0.3)).tolist()
    )
    # before the beginning: on the lower wall, through the side of the cell
    found = billiards.escape(table, start, BOUNCES, holes=[(-0.1, 0.2)])
    along = (x[..., 0] + 0.5 + 0.1) % 1.0
    assert found.bounces.tolist() == first_in((x[..., 1] < -0.45) & (along < 0.3)).tolist()
    for hole in ((0.9, 1.1), (obstacle.first - 0.1, obstacle.first + 0.1), (-0.1, 2.1)):
        with pytest.raises(
            carom.CaromError, match="escape: holes: expected a hole in one of the walls that it touches"
        ):
            billiards.escape(table, start, BOUNCES, holes=[hole])


def test_lids_are_no_part_of_a_hole_and_a_prism_keeps_its_wall() -> None:
    pipe = billiards.cylinder(1.0, 0.5)
    start = ((0.0, 0.0, 0.0), (0.2, 1.0, 3.0), (0.0, 0.0, 0.0))
    run = billiards.orbit(pipe, start, 10, law="mirror")
    wall = np.hypot(run.position[:, 0], run.position[:, 1]) > 0.999
    assert not wall[0]  # the first bounce is at a lid
    found = billiards.escape(pipe, start, 10, holes=[(-0.5, 5.0)], law="mirror")
    assert int(found.bounces) == int(wall.argmax()) + 1
    section = billiards.stadium(2.0, 1.0)
    (prism,) = billiards.cylinder(section, 2.0).wall().connected
    (flat,) = section.wall().connected
    assert (
        (prism.first, prism.last, prism.closed) == (flat.first, flat.last, flat.closed) == (0.0, 4 + 2 * math.pi, True)
    )


@pytest.mark.parametrize(
    ("hole", "said"),
    [
        ((7.0, 8.0), "expected a hole in the wall, whose arc length is from 0 to 6.28318531 m, got (7, 8)"),
        ((-2.0, -1.0), "expected a hole in the wall, whose arc length is from 0 to 6.28318531 m, got (-2, -1)"),
        ((-1.0, 6.0), "expected a hole within its wall, which is closed, from 0 to 6.28318531 m, got (-1, 6)"),
        ((-math.inf, 1.0), "expected a hole within its wall"),
        ((0.2, 0.1), "expected intervals (from, to) of arc length in m with from < to, got (0.2, 0.1)"),
        ((0.1, 0.1), "expected intervals"), ((math.nan, 1.0), "expected intervals"), ((0.0, math.nan), "expected intervals"),
        ((1.0,), "expected intervals"), ((1.0, 2.0, 3.0), "expected intervals"), (("a", "b"), "expected intervals"),
    ],
)  # fmt: skip
def test_what_is_no_hole_is_one_line(hole: tuple[float, ...], said: str) -> None:
    start = ((0.0, 0.0), (1.0, 0.0), 0.0)
    with pytest.raises(carom.CaromError) as error:
        billiards.escape(billiards.circle(), start, holes=[hole], law="mirror")
    assert str(error.value).startswith(f"escape: holes: {said}")
    assert "\n" not in str(error.value)
    with pytest.raises(carom.CaromError, match=r"escape: holes\[1\]: expected"):
        billiards.escape(billiards.circle(), start, holes=[(0.0, 0.1), (7.0, 8.0)], law="mirror")


def test_a_sphere_has_no_holes_and_a_wedge_has_them_on_both_sides() -> None:
    with pytest.raises(carom.CaromError, match="got a sphere"):
        billiards.escape(billiards.sphere(), ((0, 0, 0), (1, 0, 0), (0, 0, 0)), holes=[(0.0, 0.1)])
    wedge = billiards.wedge(60)
    for y, hole in ((-1.0, (0.5, 3.0)), (1.0, (-3.0, -0.5))):
        found = billiards.escape(wedge, ((1.0, 0.0), (0.0, y), 0.0), holes=[hole], law="mirror")
        assert (int(found.bounces), bool(found.escaped)) == (1, True)
