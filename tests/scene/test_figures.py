"""Figures: their pieces against closed forms and against a general piece, areas, the files in which they stand."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import carom
from carom.scene.figures import FIGURES, ArcPiece, EllipsePiece, ParallelPiece, Piece, PlaneFigure, SegmentPiece


class General(Piece):
    """A piece by its three methods alone."""

    def __init__(self, of: Piece) -> None:
        self.of = of

    def at(self, t: Any) -> Any:
        return self.of.at(t)

    def span(self) -> tuple[float, float]:
        return self.of.span()

    def reversed(self) -> Piece:
        return General(self.of.reversed())


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


@pytest.mark.parametrize("piece", PIECES, ids=lambda piece: type(piece).__name__)
def test_a_reversed_piece_has_its_open_side_on_the_other_side(piece: Piece) -> None:
    s, back = np.linspace(0.0, 1.0, 5) * piece.length, piece.reversed()
    assert back.place(piece.length - s) == pytest.approx(piece.place(s), abs=1e-12)
    assert back.normal(piece.length - s) == pytest.approx(-piece.normal(s), abs=1e-12)
    assert back.curvature(piece.length - s) == pytest.approx(-piece.curvature(s), abs=1e-9)


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


def test_a_stadium_of_the_release_before_is_read_with_a_note() -> None:
    with pytest.warns(DeprecationWarning, match="stadium: length is called straight now"):
        old = carom.scene.Stadium.model_validate({"length": 2.0, "radius": 1.0, "angle": 30})
    assert old == carom.scene.Stadium(straight=2.0, radius=1.0, angle=30)
