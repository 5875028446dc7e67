"""Walls of figures with smooth pieces: rooms and posts, and open curves, which have two sides and two ends."""

from __future__ import annotations

import functools
import math
from collections.abc import Hashable, Sequence
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import create_model, model_validator

from carom.core.geometry.angles import direction
from carom.core.geometry.arc_tables import arc_circle, arc_tables, join_ends
from carom.core.geometry.features import CURVE
from carom.core.geometry.polygon import outline_faults, polygon_depth
from carom.core.jit.kernel import kernel
from carom.core.jit.pointers import address_of_table
from carom.errors import Fault
from carom.scene.feature_builders import Feature, Flat, built, put_post
from carom.scene.figures import FIGURES, ArcPiece, Piece, PlaneFigure, SegmentPiece
from carom.scene.figures.curve import CurveFigure
from carom.scene.schema import Flag, Vector, raise_faults
from carom.scene.shapes.outline import REENTRANT, FigureWall, pieces_features, placed_piece
from carom.scene.wall import Outline, ShapeKernels

__all__ = ["CurveWallShape", "CurvedWallShape", "figure_walls"]

Array = NDArray[np.float64]
OPEN = 1e-9  # of the size: so far may the last place of a closed curve be from the first one
DRAWN = 360  # places of a smooth piece in a drawing


@kernel
def _no_features(p: Sequence[float], out: Any) -> int:
    """Write nothing: the features of a curve need its table (:meth:`CurvedWallShape.features`)."""
    return 0


class _Built(NamedTuple):
    """A boundary in the frame of its figure."""

    arcs: tuple[tuple[int, float, float, float], ...]
    """Of each arc: the address of its table, a circle in which it lies."""
    others: tuple[tuple[Piece, bool], ...]
    """Straight sides and arcs of circles, and whether a re-entrant corner is at their ends."""
    posts: tuple[Flat, ...]
    """Ends of open curves, and re-entrant corners at the ends of smooth pieces."""
    outline: Array
    """(N, 2)."""


def _way_round(pieces: Sequence[Piece]) -> list[Piece]:
    return [piece.reversed() for piece in reversed(pieces)]


@functools.lru_cache(256)
def _built(of: type[Any], fields: tuple[tuple[str, Hashable], ...], inside: bool, closed: bool) -> _Built:
    """Return the boundary of a figure, seen from the inside or the outside, or an open curve; a fault where it is none."""
    figure = of(**dict(fields))
    loops = figure.outline()
    if len(loops) > 1:
        raise_faults([Fault("", "", "a figure without obstacles of its own", f"a {figure.kind()}")])
    pieces: list[Piece] = list(loops[0])
    if not closed:
        pieces = figure.open_pieces()
    ends = [(piece, *piece.at(np.array(piece.span()))) for piece in pieces]
    outline = np.concatenate([one[:-1] if closed else one for one in _polylines(pieces)])
    size = float(np.abs(outline).max())
    if not np.isfinite(outline).all():
        raise_faults([Fault("", "", "a curve of finite places", "others")])
    gaps = [math.dist(one[1][1], two[1][0]) for one, two in zip(ends, [*ends[1:], ends[0]], strict=True)]
    if closed and max(gaps) > OPEN * size:
        got = f"one whose last place is {max(gaps):.6g} m from the first"
        raise_faults([Fault("", "closed", "true for a curve that closes", got, "let it close, or set closed = false")])
    if closed and outline_faults(outline):
        raise_faults([Fault("", "", "a curve that does not meet itself", "one that does")])
    if closed and not inside:
        pieces = _way_round(pieces)
    sides = [pieces] if closed else [pieces, _way_round(pieces)]
    arcs = [arc for side in sides for arc in _arcs(side)]
    posts: list[Any] = []
    others: list[tuple[Piece, bool]] = []
    if closed:
        for one, two in zip(pieces, [*pieces[1:], pieces[0]], strict=True):
            corner = _turn(one, two) < REENTRANT
            if _is_simple(one):
                others.append((one, corner))
            elif corner:
                posts.append(tuple(one.at(np.array([one.span()[1]]))[0][0].tolist()))
    else:
        posts = [tuple(ends[0][1][0].tolist()), tuple(ends[-1][1][1].tolist())]
    return _Built(tuple(arcs), tuple(others), tuple(posts), outline)


def _is_simple(piece: Piece) -> bool:
    return isinstance(piece, SegmentPiece | ArcPiece)


def _samples(piece: Piece) -> int:
    return 2 if isinstance(piece, SegmentPiece) else DRAWN + 1


def _polylines(pieces: Sequence[Piece]) -> list[Array]:
    return [piece.at(np.linspace(*piece.span(), _samples(piece)))[0] for piece in pieces]


def _turn(one: Piece, two: Piece) -> float:
    """Return the sine of the angle by which the tangent turns from a piece to the next one."""
    d, e = one.at(np.array([one.span()[1]]))[1][0], two.at(np.array([two.span()[0]]))[1][0]
    return float((d[0] * e[1] - d[1] * e[0]) / (np.linalg.norm(d) * np.linalg.norm(e)))


def _arcs(pieces: Sequence[Piece]) -> list[tuple[int, float, float, float]]:
    """Return the arcs of the smooth pieces of a side."""
    found: list[Array] = []
    for piece in pieces:
        try:
            found += [] if _is_simple(piece) else arc_tables(piece.at, *piece.span(), getattr(piece, "cuts", None))
        except ValueError as error:
            x, y = piece.at(np.array([error.args[0]]))[0][0]
            got = f"one that has none near ({x:.6g}, {y:.6g})"
            raise_faults([Fault("", "", "a curve with a continuous tangent and curvature", got)])
    join_ends([*found, *found[:1]])
    return [(address_of_table(table), *arc_circle(table)) for table in found]


class CurvedWallShape(FigureWall):
    """A figure with smooth pieces as a wall: a room with the balls inside, or a post with the balls outside. It is upright.

    Parameters
    ----------
    center : 2 lengths, m, as seen from above: the place of the figure's origin; default: the origin
    angle : degrees: by which the figure is turned; default: 0
    inside : whether the balls are inside; default: true
    restitution, friction, tangential_restitution, stiffness_ratio, contact_time, law, name : fields of every wall
    """

    kernels: ClassVar = ShapeKernels(_no_features)
    inside: Flag = True

    @model_validator(mode="after")
    def _is_a_boundary(self) -> CurvedWallShape:
        _ = self._boundary
        return self

    @property
    def _is_closed(self) -> bool:
        return True

    @property
    def _boundary(self) -> _Built:
        """Return its boundary in the frame of the figure. (No property that is kept: an address is one of this process.)"""
        fields = tuple((name, getattr(self, name)) for name in self.of.model_fields if getattr(self, name) is not None)
        return _built(self.of, fields, self.inside, self._is_closed)

    @property
    def is_of_arcs(self) -> bool:
        """Whether it is straight sides and arcs of circles alone, with the balls inside: the page has its outline."""
        return self._is_closed and self.inside and not self._boundary.arcs

    @property
    def numbers(self) -> tuple[float, ...]:
        """Return nothing: its kernels take none."""
        return ()

    def features(self) -> tuple[Feature, ...]:
        """Return its arcs, its straight and round sides, and the edges at its ends and corners."""
        found, (c, s), (x, y) = self._boundary, direction(self.angle), self.center
        arcs = [
            Feature(
                CURVE, (x, y, 0.0), (p, q, 0.0), far, 1.0, (c, s, 0.0), float(address), 0.0, -math.inf, math.inf, -1
            )
            for address, p, q, far in found.arcs
        ]
        rows = [placed_piece(piece, corner, self.center, self.angle) for piece, corner in found.others]
        numbers = [float(len(rows)), *(number for row in rows if row is not None for number in row)]
        posts = [
            built(put_post, x + c * p - s * q, y + c * q + s * p, -math.inf, math.inf, 0)[0] for p, q in found.posts
        ]
        return (*arcs, *built(pieces_features, numbers), *posts)

    def blocked(self, x: Vector) -> bool:
        """Return whether a point is outside of the room, or in the post; an open curve blocks no place."""
        if not self._is_closed:
            return False
        (c, s), (p, q) = direction(self.angle), (x[0] - self.center[0], x[1] - self.center[1])
        depth = float(polygon_depth(self._boundary.outline, np.array([[c * p + s * q, c * q - s * p]]))[0])
        return (depth > 0) != self.inside

    def outline(self) -> Outline:
        """Return its outline."""
        (c, s), at = direction(self.angle), self._boundary.outline
        found = np.array(self.center) + np.stack([c * at[:, 0] - s * at[:, 1], s * at[:, 0] + c * at[:, 1]], axis=-1)
        return [np.concatenate([found, found[:1]]) if self._is_closed else found]


class CurveWallShape(CurvedWallShape):
    """A smooth curve as a wall: a room, a post, or an open curve, which is a thin wall with two sides, and posts at its ends.

    Parameters
    ----------
    closed : whether it returns to its beginning; default: true
    center : 2 lengths, m, as seen from above: the place of the figure's origin; default: the origin
    angle : degrees: by which the figure is turned; default: 0
    inside : whether the balls are inside; default: true
    restitution, friction, tangential_restitution, stiffness_ratio, contact_time, law, name : fields of every wall
    """

    closed: Flag = True

    @property
    def _is_closed(self) -> bool:
        return self.closed


# --- a wall for each figure ---------------------------------------------------------------------------------------------------


def _wall_of(kind: type[PlaneFigure]) -> type[FigureWall]:
    """Return the class of walls of a figure: its fields are the sizes of the figure and the fields of a wall."""
    fields: dict[str, Any] = {name: (info.annotation, info) for name, info in kind.model_fields.items()}
    name = f"{kind.__name__.removesuffix('Figure')}Wall"
    base = (
        FigureWall if _of_sides_and_arcs(kind) else CurveWallShape if issubclass(kind, CurveFigure) else CurvedWallShape
    )
    made: Any = create_model(
        name, __base__=base, __module__=__name__, __doc__=f"{kind.__doc__}\n\n{base.__doc__}", **fields
    )
    made.of = kind
    globals()[name] = made  # (where a pickle looks for it)
    return made  # type: ignore[no-any-return]


def figure_walls(beside: Sequence[str]) -> dict[str, type[FigureWall]]:
    """Return a class of walls for each plane figure but those that have their own."""
    return {
        name: _wall_of(kind) for name, kind in FIGURES.items() if issubclass(kind, PlaneFigure) and name not in beside
    }


def _of_sides_and_arcs(kind: type[PlaneFigure]) -> bool:
    return bool(kind.usual) and all(map(_is_simple, (one for loop in kind(**kind.usual).outline() for one in loop)))
