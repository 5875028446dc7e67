"""Walls of figures with smooth pieces: rooms and posts, and open curves, which have two sides and two ends."""

from __future__ import annotations

import functools
import math
from collections.abc import Hashable, Iterator, Sequence
from typing import Annotated, Any, ClassVar, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator, create_model, model_validator

from carom.core.geometry.circles import direction
from carom.core.geometry.curve import COEFFICIENTS, CX, DEGREE, HALF, OX, ROW, X
from carom.core.geometry.curve_arcs import COUNT, arc_circle, arc_tables, join_ends
from carom.core.geometry.features import CURVE, FACE, LINE
from carom.core.jit.calls import address_of_table
from carom.core.jit.kernel import kernel
from carom.errors import Fault
from carom.scene.feature_builders import UP, Feature, circle, put, put_line, put_post, put_round
from carom.scene.figures import FIGURES, ArcPiece, Piece, PlaneFigure, SegmentPiece
from carom.scene.figures.curve import CurveFigure
from carom.scene.figures.figure import joints
from carom.scene.figures.polygons import outline_faults
from carom.scene.schema import Angle, Coefficient, Components, Flag, Place, Vector, raise_faults, with_faults_of_part
from carom.scene.wall import Outline, ShapeKernels, WallShape

Array = NDArray[np.float64]
Numbers = Sequence[float]
SAMPLES = 9  # places of a panel in a drawing
COLUMNS = 10  # of a piece: way, x, y, ux, uy, size, cosine, x and y of its end, whether a re-entrant corner is there
# way 0: a segment about (x, y) along u, of half the length ``size``; 1, -1: an arc about (x, y) with the middle direction u, the
# radius ``size`` and the cosine of half its angle, with the centre on the open side, or not; SMOOTH: an arc of a smooth curve whose
# frame is at (x, y) along u, with the first row of its table in place of the cosine, within ``size`` of the end, in that frame;
# POST: an edge at (x, y)
SMOOTH, POST = 2.0, 3.0
REENTRANT = -1e-12  # sine of the turn at a corner
UNIT = 1e-9  # rounding of the length of a direction


@kernel
def pieces_features(p: Numbers, out: Any) -> int:
    """Write a face, a part of a cylinder or of a curve, or an edge for each piece, and an edge at each re-entrant corner."""
    i = 0
    for k in range(int(p[0])):
        j = 1 + COLUMNS * k
        u = (p[j + 3], p[j + 4], 0.0)
        if p[j] == 0:
            at, n, half = (p[j + 1], p[j + 2], 0.0), (-p[j + 4], p[j + 3], 0.0), p[j + 5]
            i = put(out, i, FACE, at, n, 0.0, 1.0, u, -half, half, -math.inf, math.inf, -1)
        elif p[j] == SMOOTH:
            at, middle = (p[j + 1], p[j + 2], 0.0), (p[j + 7], p[j + 8], 0.0)
            i = put(out, i, CURVE, at, middle, p[j + 5], 1.0, u, p[j + 6], 0.0, -math.inf, math.inf, -1)
        elif p[j] == POST:
            i = put_post(p[j + 1], p[j + 2], -math.inf, math.inf, i, out)
        else:
            i = put_round(LINE, p[j + 1], p[j + 2], p[j + 5], -p[j], u, p[j + 6], -math.inf, math.inf, i, out)
        if p[j + 9] != 0:
            i = put_line((p[j + 7], p[j + 8], 0.0), UP, -math.inf, math.inf, 0.0, 1.0, i, out)
    return i


@kernel
def _passes_chord(p: Numbers, j: int, one: int, x: Vector) -> bool:
    """Return whether an odd number of chord and panel of a smooth arc lie between a point and what is right of it at its y."""
    dx, dy, u, v = x[0] - p[j + 1], x[1] - p[j + 2], p[j + 3], p[j + 4]
    # the nodes from the point, and the point in the frame of the chord
    two = one + ROW
    y0, y1 = v * p[one + X] + u * p[one + X + 1] - dy, v * p[two + X] + u * p[two + X + 1] - dy
    x0, x1 = u * p[one + X] - v * p[one + X + 1] - dx, u * p[two + X] - v * p[two + X + 1] - dx
    odd = (y0 > 0.0) != (y1 > 0.0) and x0 - y0 * (x1 - x0) / (y1 - y0) > 0.0
    q, r, ex, ey = u * dx + v * dy - p[one + OX], u * dy - v * dx - p[one + OX + 1], p[one + CX], p[one + CX + 1]
    w, eta, f = (ex * q + ey * r) / p[one + HALF] - 1.0, ex * r - ey * q, 0.0
    for m in range(DEGREE + 1):
        f = f * w + p[one + COEFFICIENTS + DEGREE - m]
    return odd != (-1.0 <= w <= 1.0 and (eta > 0.0) != (eta > f))


@kernel
def _outside(p: Numbers, x: Vector) -> bool:
    """Return whether no ball can be at a point: an even number of pieces is right of it at its y (sense 1), or an odd one (-1)."""
    inside, panels = False, 2 + COLUMNS * int(p[0])
    for k in range(int(p[0])):
        j = 1 + COLUMNS * k
        cx, cy, ux, uy, size = p[j + 1], p[j + 2], p[j + 3], p[j + 4], p[j + 5]
        dy = x[1] - cy
        if p[j] == 0:
            one, two = cy - size * uy, cy + size * uy
            if (one > x[1]) != (two > x[1]) and x[0] < cx + dy * ux / uy:
                inside = not inside
        elif p[j] == SMOOTH:
            first = panels + ROW * int(p[j + 6])
            for m in range(int(p[first + COUNT])):
                inside = inside != _passes_chord(p, j, first + ROW * (m + 1), x)
        elif p[j] != POST and abs(dy) < size:
            w = math.sqrt(size * size - dy * dy)
            for dx in (-w, w):
                if cx + dx > x[0] and dx * ux + dy * uy >= size * p[j + 6]:
                    inside = not inside
    sense = p[panels + ROW * int(p[panels - 1])]
    return sense != 0.0 and inside != (sense > 0.0)


KERNELS = ShapeKernels(pieces_features, _outside)
_PIECE = Components("a piece: way, x, y, ux, uy, size, cosine, x and y of its end, re-entrant", (COLUMNS,))
_PANEL = Components("a row of the table of an arc", (ROW,))
Rows = tuple[tuple[float, ...], ...]


class OutlineWall(WallShape):
    """The wall of any figure by its pieces, as the explorer's page has it.

    Parameters
    ----------
    pieces : rows of 10 numbers: way (0: a segment; 1, -1: an arc with its centre on the open side, or not; 2: an arc of a smooth
        curve; 3: a post), x and y of its middle or its centre, ux and uy of its direction or its middle direction, half its length
        or its radius, the cosine of half its angle, x and y of its end, 1 where a re-entrant corner is there
    panels : rows of the tables of all smooth arcs (:mod:`carom.core.geometry.curve_arcs`)
    sense : 1 with the balls inside, -1 outside, 0 for an open curve
    restitution, friction, tangential_restitution, stiffness_ratio, contact_time, law, name : fields of every wall
    """

    kernels: ClassVar = KERNELS
    shape: Literal["outline"] = "outline"
    pieces: Annotated[
        tuple[Annotated[tuple[Coefficient, ...], BeforeValidator(_PIECE)], ...],
        BeforeValidator(Components("1 or more pieces", range(1, 1_000_000))),
    ]
    panels: Annotated[
        tuple[Annotated[tuple[Coefficient, ...], BeforeValidator(_PANEL)], ...],
        BeforeValidator(Components("rows of tables", range(1_000_000))),
    ] = ()
    sense: Coefficient = 1.0

    @model_validator(mode="after")
    def _sound_pieces(self) -> OutlineWall:
        faults = [fault for k, row in enumerate(self.pieces) for fault in self._faults(f"pieces.{k}", *row)]
        if self.sense not in (-1, 0, 1):
            faults.append(Fault("", "sense", "1, -1 or 0", f"{self.sense:g}"))
        raise_faults(faults)
        return self

    def _faults(
        self, where: str, way: float, x: float, y: float, ux: float, uy: float, size: float, cosine: float,
        _x: float, _y: float, corner: float,
    ) -> Iterator[Fault]:  # fmt: skip
        if way not in (-1, 0, 1, SMOOTH, POST):
            yield Fault("", f"{where}.0", "a way: 0, 1, -1, 2 or 3", f"{way:g}")
        if corner not in (0, 1):
            yield Fault("", f"{where}.9", "1 where a re-entrant corner is, or 0", f"{corner:g}")
        if way != POST and abs(math.hypot(ux, uy) - 1) > UNIT:
            yield Fault("", f"{where}.3", "a direction of length 1", f"({ux:.6g}, {uy:.6g})")
        if way != POST and not size > 0:
            yield Fault("", f"{where}.5", "a size > 0", f"{size:g}")
        if way == SMOOTH and not self._has_table(cosine):
            yield Fault("", f"{where}.6", "the first row of a table in panels", f"{cosine:g}")

    def _has_table(self, first: float) -> bool:
        if not (first.is_integer() and 0 <= first < len(self.panels)):
            return False
        count = self.panels[int(first)][COUNT]
        return count.is_integer() and 1 <= count <= len(self.panels) - first - 2

    def features(self) -> tuple[Feature, ...]:
        """Return its faces, arcs and edges."""
        return tuple(
            one._replace(lo1=float(address_of_table(self._table(int(one.lo1))))) if one.kind == CURVE else one
            for one in super().features()
        )

    def _table(self, first: int) -> Array:
        return np.array(self.panels[first : first + int(self.panels[first][COUNT]) + 2])

    def outline(self) -> Outline:
        """Return its closed outline; the parts of one with smooth arcs."""
        parts = []
        for way, x, y, ux, uy, size, cosine, *_end in self.pieces:
            if way == SMOOTH:
                rows, w = self._table(int(cosine))[1:-1, :, None], np.linspace(-1, 1, SAMPLES)
                xi, f = (
                    rows[:, HALF] * (1 + w),
                    (rows[:, COEFFICIENTS:] * w ** np.arange(DEGREE + 1)[:, None]).sum(axis=1),
                )
                p = (rows[:, OX] + rows[:, CX] * xi - rows[:, CX + 1] * f).ravel()
                q = (rows[:, OX + 1] + rows[:, CX + 1] * xi + rows[:, CX] * f).ravel()
                parts.append(np.stack([x + ux * p - uy * q, y + uy * p + ux * q], axis=-1))
            elif abs(way) == 1:
                middle, half = math.atan2(uy, ux), math.acos(max(-1.0, min(1.0, cosine)))
                parts.append(circle((x, y), size, middle - way * half, middle + way * half))
            elif way == 0:
                parts.append(np.array([(x - size * ux, y - size * uy), (x + size * ux, y + size * uy)]))
        return parts if self.panels else [np.concatenate([*parts, parts[0][:1]])]

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

    @functools.cached_property
    def as_outline(self) -> OutlineWall:
        """The same wall by its pieces."""
        loops = self.figure.outline()
        if len(loops) > 1:
            raise_faults([Fault("", "", "a figure without obstacles of its own", f"a {self.kind}")])
        return OutlineWall(pieces=placed_pieces(self.kind, loops[0], self.center, self.angle), **self._surface)

    @property
    def _surface(self) -> dict[str, Any]:
        return {name: getattr(self, name) for name in WallShape.model_fields}

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
    for piece, turn in zip(loop, joints(loop).turn, strict=True):
        rows.append(placed_piece(piece, bool(turn < REENTRANT), center, angle) or ())
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


# ----------------------------------------------------------------------------------------------------
# Walls of figures with smooth pieces: rooms and posts, and open curves, which have two sides and two ends.


OPEN = 1e-9  # of the size: so far may the last place of a closed curve be from the first one
DRAWN = 360  # places of a smooth piece in a drawing


class _Built(NamedTuple):
    """A boundary: the same by its pieces, their features, which hold addresses of this process, and how it is drawn."""

    wall: OutlineWall
    numbers: tuple[float, ...]
    features: tuple[Feature, ...]
    outline: Array
    """(N, 2)."""


def _way_round(pieces: Sequence[Piece]) -> list[Piece]:
    return [piece.reversed() for piece in reversed(pieces)]


@functools.lru_cache(256)
def _built(
    of: type[Any], fields: tuple[tuple[str, Hashable], ...], inside: bool, closed: bool, center: Place, angle: float
) -> _Built:
    """Return the boundary of a figure, seen from the inside or the outside, or an open curve; a fault where it is none."""
    figure = of(**dict(fields))
    loops = figure.outline()
    if len(loops) > 1:
        raise_faults([Fault("", "", "a figure without obstacles of its own", f"a {figure.kind()}")])
    pieces: list[Piece] = list(loops[0])
    if not closed:
        pieces = figure.open_pieces()
    ends = joints(pieces).ends
    outline = np.concatenate([one[:-1] if closed else one for one in _polylines(pieces)])
    size = float(np.abs(outline).max())
    if not np.isfinite(outline).all():
        raise_faults([Fault("", "", "a curve of finite places", "others")])
    gap = float(np.linalg.norm(ends[:, 1] - np.roll(ends[:, 0], -1, axis=0), axis=1).max())
    if closed and gap > OPEN * size:
        got = f"one whose last place is {gap:.6g} m from the first"
        raise_faults([Fault("", "closed", "true for a curve that closes", got, "let it close, or set closed = false")])
    if closed and outline_faults(outline):
        raise_faults([Fault("", "", "a curve that does not meet itself", "one that does")])
    if closed and not inside:
        pieces = _way_round(pieces)
    sides = [pieces] if closed else [pieces, _way_round(pieces)]
    (c, s), (x, y) = direction(angle), center
    rows: list[tuple[float, ...]] = []
    tables = [table for side in sides for table in _arcs(side)]
    first = 0
    for table in tables:
        p, q, far = arc_circle(table)
        rows.append((SMOOTH, x, y, c, s, far, float(first), p, q, 0.0))
        first += len(table)
    ends_of = joints(pieces) if closed else None
    posts = [ends[0, 0].tolist(), ends[-1, 1].tolist()] if not closed else []
    for one, turn, last in zip(pieces, ends_of.turn, ends_of.ends[:, 1].tolist(), strict=True) if ends_of else ():
        corner = bool(turn < REENTRANT)
        row = placed_piece(one, corner, center, angle)
        rows += [] if row is None else [row]
        posts += [last] if corner and row is None else []
    rows += [(POST, x + c * p - s * q, y + c * q + s * p, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0) for p, q in posts]
    panels = tuple(tuple(row) for table in tables for row in table.tolist())
    wall = OutlineWall(pieces=tuple(rows), panels=panels, sense=float(closed) * (1 if inside else -1))
    placed = np.array(center) + np.stack(
        [c * outline[:, 0] - s * outline[:, 1], s * outline[:, 0] + c * outline[:, 1]], axis=-1
    )
    return _Built(wall, wall.numbers, wall.features(), placed)


def _is_simple(piece: Piece) -> bool:
    return isinstance(piece, SegmentPiece | ArcPiece)


def _samples(piece: Piece) -> int:
    return 2 if isinstance(piece, SegmentPiece) else DRAWN + 1


def _polylines(pieces: Sequence[Piece]) -> list[Array]:
    return [piece.at(np.linspace(*piece.span(), _samples(piece)))[0] for piece in pieces]


def _arcs(pieces: Sequence[Piece]) -> list[Array]:
    """Return the tables of the arcs of the smooth pieces of a side."""
    found: list[Array] = []
    for piece in pieces:
        try:
            found += [] if _is_simple(piece) else arc_tables(piece.at, *piece.span(), getattr(piece, "cuts", None))
        except ValueError as error:
            x, y = piece.at(np.array([error.args[0]]))[0][0]
            got = f"one that has none near ({x:.6g}, {y:.6g})"
            raise_faults([Fault("", "", "a curve with a continuous tangent and curvature", got)])
    join_ends([*found, *found[:1]])
    return found


class CurvedWallShape(FigureWall):
    """A figure with smooth pieces as a wall: a room with the balls inside, or a post with the balls outside. It is upright.

    Parameters
    ----------
    center : 2 lengths, m, as seen from above: the place of the figure's origin; default: the origin
    angle : degrees: by which the figure is turned; default: 0
    inside : whether the balls are inside; default: true
    restitution, friction, tangential_restitution, stiffness_ratio, contact_time, law, name : fields of every wall
    """

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
        """Return its boundary. (No property that is kept: an address is one of this process.)"""
        fields = tuple((name, getattr(self, name)) for name in self.of.model_fields if getattr(self, name) is not None)
        return _built(self.of, fields, self.inside, self._is_closed, self.center, self.angle)

    @property
    def as_outline(self) -> OutlineWall:
        """The same wall by its pieces."""
        return self._boundary.wall.model_copy(update=self._surface)

    @property
    def numbers(self) -> tuple[float, ...]:
        """Return those of its pieces."""
        return self._boundary.numbers

    def features(self) -> tuple[Feature, ...]:
        """Return its arcs, its straight and round sides, and the edges at its ends and corners."""
        return self._boundary.features

    def outline(self) -> Outline:
        """Return its outline."""
        found = self._boundary.outline
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
