"""Figures: their pieces against closed forms and against a general piece, areas, the files in which they stand."""

from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np
import pytest

import carom
from carom.errors import CaromError
from carom.scene.figures import FIGURES, ArcPiece, EllipsePiece, ParallelPiece, Piece, PlaneFigure, SegmentPiece, figure
from carom.scene.shapes.curves import OutlineWall, placed_pieces


class General(Piece):
    """A piece by its two methods alone."""

    def __init__(self, of: Piece) -> None:
        self.of = of

    def at(self, t: Any) -> Any:
        return self.of.at(t)

    def span(self) -> tuple[float, float]:
        return self.of.span()


PIECES = [
    SegmentPiece((0.1, 0.2), (1.3, -0.4)), ArcPiece((0.3, -0.1), 0.7, 20.0, 130.0), ArcPiece((0.3, -0.1), 0.7, 130.0, 20.0),
    EllipsePiece((1.2, 0.5)), EllipsePiece((0.4, 0.9), 200.0, 40.0),
]  # fmt: skip


@pytest.mark.parametrize("piece", PIECES, ids=lambda piece: type(piece).__name__)
def test_closed_forms_are_those_of_a_general_piece(piece: Piece) -> None:
    one = General(piece)
    s = np.linspace(0.0, piece.length, 7)
    assert one.length == pytest.approx(piece.length, rel=1e-13)
    for name in ("place", "tangent", "normal", "curvature"):
        assert getattr(one, name)(s) == pytest.approx(getattr(piece, name)(s), abs=1e-12), name
    near, far = one.inset(0.05), piece.inset(0.05)
    t = np.linspace(*piece.span(), 5)
    assert near.at(t)[0] == pytest.approx(piece.at(t)[0] + 0.05 * one.normal(_lengths(one, t)), abs=1e-12)
    assert far.place(s * far.length / piece.length) == pytest.approx(
        near.place(s * near.length / piece.length), abs=1e-12
    )


def _lengths(piece: Piece, t: np.ndarray) -> np.ndarray:
    """Arc lengths at parameters, by the trapezoidal rule on many nodes."""
    fine = np.linspace(*piece.span(), 200_001)
    rate = np.linalg.norm(piece.at(fine)[1], axis=-1)
    return np.interp(t, fine, np.concatenate([[0.0], np.cumsum((rate[1:] + rate[:-1]) / 2 * np.diff(fine))]))


@pytest.mark.parametrize("piece", PIECES, ids=lambda piece: type(piece).__name__)
def test_curvature_is_the_turn_of_the_tangent(piece: Piece) -> None:
    h, s = 1e-5 * piece.length, np.linspace(0.1, 0.9, 5) * piece.length
    turn = (piece.tangent(s + h) - piece.tangent(s - h)) / (2 * h)
    assert (turn * piece.normal(s)).sum(-1) == pytest.approx(piece.curvature(s), rel=1e-6, abs=1e-7)
    inset = ParallelPiece(piece, 0.02)
    assert inset.curvature(s * 0.9) == pytest.approx(Piece.curvature(inset, s * 0.9), rel=1e-6, abs=1e-7)


@pytest.mark.parametrize("piece", [*PIECES, *map(General, PIECES)], ids=lambda piece: type(piece).__name__)
def test_a_reversed_piece_has_its_open_side_on_the_other_side(piece: Piece) -> None:
    s, back = np.linspace(0.0, 1.0, 5) * piece.length, piece.reversed()
    assert back.place(piece.length - s) == pytest.approx(piece.place(s), abs=1e-12)
    assert back.normal(piece.length - s) == pytest.approx(-piece.normal(s), abs=1e-12)
    assert back.curvature(piece.length - s) == pytest.approx(-piece.curvature(s), abs=1e-9)
    assert back.reversed().place(s) == pytest.approx(piece.place(s), abs=1e-12)


AREAS = {
    "circle": ({"radius": 2}, 4 * math.pi), "ellipse": ({"half_axes": (2, 0.5)}, math.pi),
    "stadium": ({"straight": 1, "radius": 0.5}, 1 + math.pi / 4),
    "rectangle": ({"size": (2, 0.5)}, 1.0), "regular": ({"sides": 6, "radius": 1}, 1.5 * math.sqrt(3)),
    "polygon": ({"points": [(0, 0), (0, 2), (1, 2), (1, 1), (2, 1), (2, 0)]}, 3.0),
}  # fmt: skip


@pytest.mark.parametrize("shape", AREAS)
def test_outlines_are_closed_counterclockwise_and_of_the_known_area(shape: str) -> None:
    sizes, area = AREAS[shape]
    made = FIGURES[shape](**sizes)
    assert isinstance(made, PlaneFigure)
    assert made.area == pytest.approx(area, rel=1e-12)
    for loop in made.outline():
        for one, two in zip(loop, loop[1:] + loop[:1], strict=True):
            assert one.at(one.span()[1:])[0] == pytest.approx(two.at(two.span()[:1])[0], abs=1e-15)


def test_faults_of_sizes_are_one_line_each() -> None:
    with pytest.raises(carom.CaromError) as caught:
        FIGURES["stadium"](straight=-1, radius="2 s", angle=3)
    assert len(str(caught.value).splitlines()) == 3


# What a wall has besides the sizes of its figure: where it lies, and on which side the balls are.
WHERE = {
    "wedge": {"apex": (0, 0, 0)}, "cylinder": {"point": (0, 0, 0), "inside": True}, "sphere": {"center": (0, 0, 0), "inside": True},
    "box": {"center": (0, 0, 0), "inside": True},
    "strip": {"point": (0, -0.5, 0), "normal": (0, 1, 0)}, "polygon": {"closed": True},
}  # fmt: skip
TRIANGLE = {"points": [(0, 0), (2, 0), (0, 1)]}


@pytest.mark.parametrize("name", sorted(FIGURES))
def test_all_users_of_a_figure_take_its_sizes_by_the_same_names(name: str) -> None:
    sizes = FIGURES[name].usual or (TRIANGLE if name == "polygon" else {"r": "1 + 0.1*cos(theta)"})
    sizes = sizes | ({"height": 2.0} if name == "cylinder" else {})
    made = FIGURES[name](**sizes)
    assert carom.billiards.table(name, **sizes).figure == made
    # scenes and gases take all names, or have no such figure at all
    for user, take in (
        (
            "walls",
            lambda: carom.Scene(walls=[{"shape": name, "restitution": 1.0, **sizes, **WHERE.get(name, {})}], gravity=0),
        ),
        ("container", lambda: carom.gas.container(name, **sizes)),
    ):
        said = ""
        try:
            take()
        except carom.CaromError as error:
            said = f"{user}: {error}"
        assert not [one for one in sizes if f" {one}: " in said or f".{one}: " in said], said


def test_wedges_by_their_angles() -> None:
    wedge = carom.scene.Wedge(apex=(0, 0, 0), angle=40)
    assert (wedge.from_angle, wedge.to_angle) == (-20, 20)
    assert carom.scene.Wedge(apex=(0, 0, 0), from_angle=10, angle="1 rad").to_angle == pytest.approx(
        10 + math.degrees(1)
    )
    for given, text in (
        ({"angle": 40, "to_angle": 20}, "either angle or to_angle, got both"),
        ({"angle": "x"}, "an angle in degrees"),
    ):
        with pytest.raises(carom.CaromError, match=text) as caught:
            carom.scene.Wedge(apex=(0, 0, 0), **given)
        assert len(str(caught.value).splitlines()) == 1


class NotchFigure(PlaneFigure):
    """A square with a half circle cut out above and a notch below, for tests: arcs both ways, and re-entrant corners."""

    side: Any = 2.0

    def outline(self) -> Any:
        points = [(-1.0, -1.0), (-0.2, -1.0), (0.0, -0.6), (0.2, -1.0), (1.0, -1.0), (1.0, 1.0), (0.5, 1.0)]
        sides = [SegmentPiece(one, two) for one, two in itertools.pairwise(points)]
        arc = ArcPiece((0.0, 1.0), 0.5, 360.0, 180.0)
        return [[*sides, arc, SegmentPiece((-0.5, 1.0), (-1.0, 1.0)), SegmentPiece((-1.0, 1.0), (-1.0, -1.0))]]


def wall_of(made: PlaneFigure, center: tuple[float, float] = (0.0, 0.0), angle: float = 0.0) -> OutlineWall:
    """The wall of a figure."""
    return OutlineWall(pieces=placed_pieces("notch", made.outline()[0], center, angle), restitution=1.0, friction=0.0)


@pytest.mark.parametrize(
    "text", ["rectangle:size=2,1.2", "regular:sides=5,radius=1.2", "circle:radius=0.8", "stadium:straight=1,radius=0.7"]
)
def test_a_ball_in_a_wall_of_a_figure_is_where_the_billiard_has_it(text: str) -> None:
    """Bounces of a mirror ball, under no force, as of the table that bounds its surface."""
    made = figure(text)
    assert isinstance(made, PlaneFigure)
    start, velocity = (0.11, 0.07), (0.8, 0.37)
    found = carom.orbit(made, 12, bounds="surface", law="mirror", ball_radius=0.05, position=start, velocity=velocity)
    ball = {"radius": 0.05, "mass": 0.2, "position": (*start, 0.0), "velocity": (*velocity, 0.0)}
    for wall in (wall_of(made), {"shape": made.kind(), **made.sizes, "restitution": 1.0, "friction": 0.0}):
        scene = carom.Scene(
            gravity=0, walls=[wall], balls=[ball], run={"max_events": 12, "law": "mirror", "duration": 100}
        )
        run = carom.simulate(scene)
        places = np.array([run.at(float(t)).position[0, :2] for t in found.t[:10]])
        assert places == pytest.approx(found.position[:10], abs=1e-9)


@pytest.mark.slow
def test_a_ball_stays_in_a_figure_with_arcs_and_corners_both_ways() -> None:
    """The gap to every piece, from points along it, and the places that are blocked, turned and moved."""
    made, center, angle = NotchFigure(), (0.3, -0.2), 25.0
    wall = wall_of(made, center, angle)
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    turn = np.array([[c, s], [-s, c]])
    edge = np.concatenate([p.place(np.linspace(0, p.length, 4001)) for p in made.outline()[0]]) @ turn + center
    ball = {"radius": 0.06, "mass": 0.2, "position": (0.5, 0.1, 0.0), "velocity": (1.3, 0.71, 0.0), "spin": (0, 0, 5)}
    rough = wall.model_copy(update={"friction": 0.2})
    scene = carom.Scene(gravity=0, walls=[rough], balls=[ball], run={"law": "no-slip", "duration": 30.0})
    run = carom.simulate(scene)
    assert len(run.events) > 20
    places = np.array([run.at(t).position[0, :2] for t in np.linspace(0, 30, 400)])
    gaps = np.linalg.norm(places[:, None] - edge, axis=-1).min(axis=1)
    assert gaps.min() > 0.06 - 1e-5
    assert not any(wall.blocked((*place, 0.0)) for place in places)
    outside = np.array([(0.0, -0.9), (0.0, 0.8), (1.2, 0.0), (-1.1, -1.1), (0.0, 1.5)]) @ turn + center
    assert all(wall.blocked((*place, 0.0)) for place in outside)
    ends = wall.outline()[0]
    assert np.abs(ends[:, None] - edge).sum(-1).min(axis=1).max() < 2e-3


def test_a_size_that_a_figure_lacks_is_refused_with_an_example() -> None:
    with pytest.raises(CaromError, match=r"known are shape, half_axes; an example is ellipse:half_axes=1\.0,0\.8$"):
        figure("ellipse:a=2,b=1")
    with pytest.raises(CaromError, match=r"an example is cell:size=1\.0,1\.0,obstacles=\[\[0\.0,0\.0,0\.3\]\]$"):
        figure("cell:a=1")
