"""Walls of figures: any closed loop of straight sides and arcs, with the balls inside."""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from pydantic import BeforeValidator, model_validator

from carom.core.geometry.angles import direction
from carom.core.geometry.features import FACE, LINE
from carom.core.jit.kernel import kernel
from carom.errors import Fault
from carom.scene.feature_builders import UP, circle, put, put_line, put_round
from carom.scene.figures import ArcPiece, PlaneFigure, SegmentPiece
from carom.scene.schema import Angle, Coefficient, Components, Place, Vector, raise_faults, with_faults_of_part
from carom.scene.wall import Outline, ShapeKernels, WallShape

__all__ = ["REENTRANT", "FigureWall", "OutlineWall", "pieces_features", "placed_piece", "placed_pieces"]

Numbers = Sequence[float]
COLUMNS = 10  # of a piece: way, x, y, ux, uy, size, cosine, x and y of its end, whether a re-entrant corner is there
# (way 0: a segment about (x, y) along u, of half the length ``size``; 1, -1: an arc about (x, y) with the middle direction u, the
# radius ``size`` and the cosine of half its angle, with the centre on the open side, or not)
REENTRANT = -1e-12  # sine of the turn at a corner


@kernel
def pieces_features(p: Numbers, out: Any) -> int:
    """Write a face or a part of a cylinder for each piece, and an edge at each re-entrant corner."""
    i = 0
    for k in range(int(p[0])):
        j = 1 + COLUMNS * k
        u = (p[j + 3], p[j + 4], 0.0)
        if p[j] == 0:
            at, n, half = (p[j + 1], p[j + 2], 0.0), (-p[j + 4], p[j + 3], 0.0), p[j + 5]
            i = put(out, i, FACE, at, n, 0.0, 1.0, u, -half, half, -math.inf, math.inf, -1)
        else:
            i = put_round(LINE, p[j + 1], p[j + 2], p[j + 5], -p[j], u, p[j + 6], -math.inf, math.inf, i, out)
        if p[j + 9] != 0:
            i = put_line((p[j + 7], p[j + 8], 0.0), UP, -math.inf, math.inf, 0.0, 1.0, i, out)
    return i


@kernel
def _outside(p: Numbers, x: Vector) -> bool:
    """Return whether a point is outside: the pieces to the right of it at its y are even in number."""
    inside = False
    for k in range(int(p[0])):
        j = 1 + COLUMNS * k
        cx, cy, ux, uy, size = p[j + 1], p[j + 2], p[j + 3], p[j + 4], p[j + 5]
        dy = x[1] - cy
        if p[j] == 0:
            one, two = cy - size * uy, cy + size * uy
            if (one > x[1]) != (two > x[1]) and x[0] < cx + dy * ux / uy:
                inside = not inside
        elif abs(dy) < size:
            w = math.sqrt(size * size - dy * dy)
            for dx in (-w, w):
                if cx + dx > x[0] and dx * ux + dy * uy >= size * p[j + 6]:
                    inside = not inside
    return not inside


KERNELS = ShapeKernels(pieces_features, _outside)
_PIECE = Components("a piece: way, x, y, ux, uy, size, cosine, x and y of its end, re-entrant", (COLUMNS,))


class OutlineWall(WallShape):
    """A closed loop of straight sides and arcs, with the balls inside: the wall of any figure, as the explorer's page has it.

    Parameters
    ----------
    pieces : rows of 10 numbers: way (0: a segment; 1, -1: an arc with its centre on the open side, or not), x and y of its middle
        or its centre, ux and uy of its direction or its middle direction, half its length or its radius, the cosine of half its
        angle, x and y of its end, 1 where a re-entrant corner is there
    restitution, friction, tangential_restitution, stiffness_ratio, contact_time, law, name : fields of every wall
    """

    kernels: ClassVar = KERNELS
    shape: Literal["outline"] = "outline"
    pieces: Annotated[
        tuple[Annotated[tuple[Coefficient, ...], BeforeValidator(_PIECE)], ...],
        BeforeValidator(Components("2 or more pieces", range(1, 1_000_000))),
    ]

    def outline(self) -> Outline:
        """Return its closed outline."""
        parts = []
        for way, x, y, ux, uy, size, cosine, *_end in self.pieces:
            if way:
                middle, half = math.atan2(uy, ux), math.acos(max(-1.0, min(1.0, cosine)))
                parts.append(circle((x, y), size, middle - way * half, middle + way * half))
            else:
                parts.append(np.array([(x - size * ux, y - size * uy), (x + size * ux, y + size * uy)]))
        return [np.concatenate([*parts, parts[0][:1]])]

    def describe(self) -> str:
        """Return a description of a few words."""
        return f"an outline of {len(self.pieces)} pieces"


class FigureWall(WallShape):
    """A figure as a wall, with the balls inside: its sizes and its place.

    Parameters
    ----------
    center : 2 lengths, m, as seen from above: the place of the figure's origin; default: the origin
    angle : degrees: by which the figure is turned; default: 0
    restitution, friction, tangential_restitution, stiffness_ratio, contact_time, law, name : fields of every wall
    """

    kernels: ClassVar = KERNELS
    in_page: ClassVar[bool] = False
    of: ClassVar[type[PlaneFigure]]
    center: Place = (0.0, 0.0)
    angle: Angle = 0.0

    @model_validator(mode="before")
    @classmethod
    def _sound_figure(cls, given: Any) -> Any:
        fields = cls.of.model_fields
        if isinstance(given, dict) and all(name in given for name, info in fields.items() if info.is_required()):
            with_faults_of_part(lambda: cls.of(**{name: given[name] for name in fields if given.get(name) is not None}))
        return given

    @functools.cached_property
    def figure(self) -> PlaneFigure:
        """The figure."""
        fields = {name: getattr(self, name) for name in self.of.model_fields}
        return self.of(**{name: value for name, value in fields.items() if value is not None})

    @property
    def is_of_arcs(self) -> bool:
        """Whether it is straight sides and arcs of circles alone, with the balls inside: the page has its outline."""
        return True

    @functools.cached_property
    def as_outline(self) -> OutlineWall:
        """The same wall by its pieces."""
        loops = self.figure.outline()
        if len(loops) > 1:
            raise_faults([Fault("", "", "a figure without obstacles of its own", f"a {self.kind}")])
        surface = {name: getattr(self, name) for name in WallShape.model_fields}
        return OutlineWall(pieces=placed_pieces(self.kind, loops[0], self.center, self.angle), **surface)

    @property
    def numbers(self) -> tuple[float, ...]:
        """Return the number of its pieces, and these."""
        return self.as_outline.numbers

    def outline(self) -> Outline:
        """Return its closed outline."""
        return self.as_outline.outline()

    def describe(self) -> str:
        """Return a description of a few words."""
        said = self.figure.describe()
        return f"{'an' if said[0] in 'aeiou' else 'a'} {said}"


def placed_pieces(kind: str, loop: Sequence[Any], center: Place, angle: float) -> tuple[tuple[float, ...], ...]:
    """Return the rows of pieces that are turned by an angle, degrees, and moved to a place."""
    rows: list[tuple[float, ...]] = []
    for piece, after in zip(loop, (*loop[1:], loop[0]), strict=True):
        turned = piece.tangent(np.array([piece.length]))[0], after.tangent(np.zeros(1))[0]
        corner = float(turned[0][0] * turned[1][1] - turned[0][1] * turned[1][0]) < REENTRANT
        row = placed_piece(piece, corner, center, angle)
        rows.append(row or ())
    if () in rows:
        raise_faults(
            [Fault("", "shape", "a figure of straight sides and arcs of circles", f"a {kind}, with other pieces")]
        )
    return tuple(rows)


def placed_piece(piece: Any, corner: bool, center: Place, angle: float) -> tuple[float, ...] | None:
    """Return the row of a straight side or an arc, or None; ``corner``: whether a re-entrant corner is at its end."""
    (c, s), (x, y) = direction(angle), center
    end = piece.at(np.array([piece.span()[1]]))[0][0].tolist()
    if isinstance(piece, SegmentPiece):
        (u, v), (p, q) = piece.start, piece.end
        at, along = ((u + p) / 2, (v + q) / 2), ((p - u) / piece.length, (q - v) / piece.length)
        way, size, cosine, end = 0.0, piece.length / 2, 0.0, [p, q]
    elif isinstance(piece, ArcPiece):
        first, last = sorted((piece.from_angle_deg, piece.to_angle_deg))
        at, along, way, size = piece.center, direction((first + last) / 2), piece.way, piece.radius
        cosine = -1.0 if last - first >= 360 else direction((last - first) / 2)[0]
    else:
        return None
    placed = [(x + a * c - b * s, y + a * s + b * c) for a, b in (at, end)]
    turned_along = (along[0] * c - along[1] * s, along[0] * s + along[1] * c)
    return (way, *placed[0], *turned_along, size, cosine, *placed[1], float(corner))
