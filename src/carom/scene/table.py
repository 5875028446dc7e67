"""A billiard table: cushions with noses, pockets where it has them, and real tables by name."""

from __future__ import annotations

import functools
import math
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import model_validator

from carom.errors import Fault, shown
from carom.formatting import format_length
from carom.scene.feature_builders import Feature, Flat, cushion, upright
from carom.scene.pockets import (
    Jaw,
    Pockets,
    is_free,
    jaw_at,
    jaw_features,
    jaw_line,
    mouth_faults,
    overlap_faults,
    pocket_features,
)
from carom.scene.presets import preset_fault, presets, wall_fields
from carom.scene.schema import Extent, Place, Size, Vector, raise_faults
from carom.scene.wall import Outline, Pocket, WallShape

__all__ = ["Table"]

# Counterclockwise, as the corners are.
CORNERS = ("bottom left pocket", "bottom right pocket", "top right pocket", "top left pocket")
SIDES = ("bottom middle pocket", "right middle pocket", "top middle pocket", "left middle pocket")
TURNS: tuple[Flat, ...] = ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))


class Mouth(NamedTuple):
    """A pocket with the jaws that one passes before and after it, and the field of the table that declares it."""

    pocket: Pocket
    before: Jaw
    after: Jaw
    field: str


class Layout(NamedTuple):
    """A table with pockets, as seen from above."""

    noses: list[tuple[Flat, Flat, Flat]]
    """Start, end, and direction of each."""
    mouths: list[Mouth]


class Table(WallShape):
    """A rectangular table: four cushions, and pockets where it has them.

    Parameters
    ----------
    preset : str, optional
        A real table by name, which fills all other fields but ``center`` and ``height``: "carom", "carom-half-match",
        "carom-small", "pool-9ft", "pool-8ft", "pool-7ft", "snooker". What is given beside it has precedence.
    length, width : m: along x and y, from nose to nose
    center : 2 lengths, m, as seen from above; default: the origin
    nose_height : m, optional: each cushion begins with an edge at this height. A ball of a smaller radius meets it above its
        centre; one in flight may meet the cushion above it
    height : m: the cushions' upper edge; default: infinite, so that no ball leaves the table
    corner_pockets, side_pockets : Pockets, optional: in the corners, and in the middle of the longer sides. A ball whose centre
        passes a pocket's edge, below the cushions' upper edge, falls: an event ``pocketed``; it is followed no further
    restitution, friction, tangential_restitution, stiffness_ratio, law, name : fields of every wall, as of :class:`Plane`

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> table = carom.scene.Table(length=2.84, width=1.42, nose_height="37 mm", restitution=0.9, friction=0.2)
    >>> table.nose_height, table.room
    (0.037, 0.71)
    >>> carom.scene.Table(preset="snooker", friction=0.2).describe()
    'a table of 3.57 m by 1.78 m, cushion noses at 36.8 mm, six pockets'
    """

    shape: Literal["table"] = "table"
    preset: str | None = None
    length: Size
    width: Size
    center: Place = (0.0, 0.0)
    nose_height: Size | None = None
    height: Extent = math.inf
    corner_pockets: Pockets | None = None
    side_pockets: Pockets | None = None

    @model_validator(mode="before")
    @classmethod
    def _filled(cls, fields: Any) -> Any:
        """Fill what a preset says and the scene does not."""
        name = fields.get("preset") if isinstance(fields, dict) else None
        if name is None:
            return fields
        raise_faults(preset_fault(name))
        filled = {**wall_fields(presets()[name]), **fields}
        for part in ("corner_pockets", "side_pockets"):
            own, known = fields.get(part), wall_fields(presets()[name]).get(part)
            if isinstance(own, dict) and known is not None:
                filled[part] = {**known, **own}
        return filled

    @model_validator(mode="after")
    def _sound(self) -> Table:
        low = self.nose_height or 0.0
        if not (self.height >= low and self.height > 0):
            expected = f"at least nose_height = {low:g} m" if low else "a height above the floor"
            raise_faults([Fault("", "height", expected, shown(self.height))])
        raise_faults(self._pocket_faults())
        return self

    def _pocket_faults(self) -> list[Fault]:
        noses, mouths = self._layout
        field = "side_pockets" if self.side_pockets else "corner_pockets"
        if any((u[0] - x[0]) * t[0] + (u[1] - x[1]) * t[1] <= 0 for x, u, t in noses):
            got = "mouths and jaws that leave none"
            return [
                Fault("", f"{field}.mouth", "a cushion between two pockets", got, "make mouth or jaw_radius smaller")
            ]
        found = []
        for part, shape in (("corner_pockets", self.corner_pockets), ("side_pockets", self.side_pockets)):
            jaws = [jaw for mouth in mouths for jaw in (mouth.before, mouth.after) if mouth.field == part]
            found += mouth_faults(part, shape, jaws) if shape else []
        return found or overlap_faults(field, list(self.pockets))

    @property
    def encloses(self) -> bool:
        """Return True: it surrounds the balls."""
        return True

    @property
    def room(self) -> float:
        """Return half of the shorter side, m."""
        return min(self.length, self.width) / 2

    @property
    def pockets(self) -> tuple[Pocket, ...]:
        """Return its pockets, from the bottom left one counterclockwise."""
        return tuple(mouth.pocket for mouth in self._layout.mouths)

    def _corners(self) -> list[Flat]:
        return _corners(self.length, self.width, self.center)

    @property
    def _layout(self) -> Layout:
        return _layout(self.length, self.width, self.center, self.corner_pockets, self.side_pockets)

    def features(self) -> list[Feature]:
        """Return faces, noses, upper edges, and gates; then jaws and pockets."""
        low = -math.inf if self.nose_height is None else self.nose_height
        noses, mouths = self._layout
        if not mouths:
            return upright(self._corners(), closed=True, low=low, high=self.height, inside=True)
        found = [one for start, end, _t in noses for one in cushion(start, end, low, self.height)]
        found += [one for m in mouths for jaw in (m.before, m.after) for one in jaw_features(jaw, low, self.height)]
        return found + [one for i, m in enumerate(mouths) for one in pocket_features(i, m.pocket, self.height)]

    def outline(self) -> Outline:
        """Return a rectangle; of a table with pockets, noses and jaws."""
        noses, mouths = self._layout
        if not mouths:
            return [np.array([*self._corners(), self._corners()[0]])]
        return [np.array(nose[:2]) for nose in noses] + [jaw_line(jaw) for m in mouths for jaw in (m.before, m.after)]

    @property
    def bed(self) -> NDArray[np.float64] | None:
        """Return the outline (n, 2) of the cloth of a table with pockets."""
        noses, mouths = self._layout
        if not mouths:
            return None
        before = {mouth.before.nose_end: mouth for mouth in mouths}
        parts: list[Any] = []
        for start, end, _t in noses:
            parts += [start, end]
            if end in before:
                mouth = before[end]
                parts += [*jaw_line(mouth.before), mouth.pocket.center, *jaw_line(mouth.after)[::-1]]
        return np.array(parts)

    def describe(self) -> str:
        """Return a description of a few words."""
        nose = "" if self.nose_height is None else f", cushion noses at {format_length(self.nose_height)}"
        count = {2: ", two pockets", 4: ", four pockets", 6: ", six pockets"}.get(len(self.pockets), "")
        return f"a table of {format_length(self.length)} by {format_length(self.width)}{nose}{count}"

    def blocked(self, x: Vector) -> bool:
        """Return whether a point is beyond a cushion, or over a pocket."""
        out = abs(x[0] - self.center[0]) > self.length / 2 or abs(x[1] - self.center[1]) > self.width / 2
        for pocket, before, after, _field in self._layout.mouths:
            (px, py), r = pocket.center, pocket.radius
            if (x[0] - px) * (x[0] - px) + (x[1] - py) * (x[1] - py) < r * r:
                return True
            if out:
                # between the jaws, in front of the pocket
                mx, my = (before.start[0] + after.start[0]) / 2, (before.start[1] + after.start[1]) / 2
                gx, gy = px - mx, py - my
                front = (x[0] - mx) * gx + (x[1] - my) * gy < gx * gx + gy * gy
                near = math.dist(x[:2], pocket.center) < 2 * r + math.dist(before.nose_end, after.nose_end)
                if front and near and is_free(x, before) and is_free(x, after):
                    return False
        return out

    def vertical(self, z: float) -> bool:
        """Return whether it has no nose above the balls' centres, and is not lower than they are."""
        return (self.nose_height is None or self.nose_height <= z) and z <= self.height


def _corners(length: float, width: float, center: Flat) -> list[Flat]:
    (x, y), dx, dy = center, length / 2, width / 2
    return [(x - dx, y - dy), (x + dx, y - dy), (x + dx, y + dy), (x - dx, y + dy)]


@functools.lru_cache(64)
def _layout(length: float, width: float, center: Flat, corner: Pockets | None, side: Pockets | None) -> Layout:
    """Lay out noses, pockets and jaws, in the order in which one comes by, counterclockwise from the bottom left corner."""
    if corner is None and side is None:
        return Layout([], [])
    corners = _corners(length, width, center)
    long = 0 if length >= width else 1  # the longer sides are those with this number, and two more
    half = math.sqrt(0.5)
    mouths: list[Mouth] = []
    ends: list[Flat] = []  # of the noses
    turns: list[Flat] = []
    for k, (x, y) in enumerate(corners):
        (tx, ty), (sx, sy) = TURNS[k], TURNS[k - 1]
        before, after = (x, y), (x, y)
        if corner:
            # outwards along the diagonal, from the corner
            gx, gy, far = half * (sx - tx), half * (sy - ty), corner.shelf + corner.radius - corner.mouth / 2
            pocket = Pocket(CORNERS[k], (x + far * gx, y + far * gy), corner.radius)
            m = half * corner.mouth
            one = jaw_at((x - m * sx, y - m * sy), (sx, sy), True, corner, pocket.center)
            two = jaw_at((x + m * tx, y + m * ty), (-tx, -ty), False, corner, pocket.center)
            mouths.append(Mouth(pocket, one, two, "corner_pockets"))
            before, after = one.nose_end, two.nose_end
        ends += [before, after]
        turns.append((tx, ty))
        if side and k % 2 == long:
            ux, uy = corners[(k + 1) % 4]
            mx, my, m, far = (x + ux) / 2, (y + uy) / 2, side.mouth / 2, side.shelf + side.radius
            pocket = Pocket(SIDES[k], (mx + far * ty, my - far * tx), side.radius)
            one = jaw_at((mx - m * tx, my - m * ty), (tx, ty), True, side, pocket.center)
            two = jaw_at((mx + m * tx, my + m * ty), (-tx, -ty), False, side, pocket.center)
            mouths.append(Mouth(pocket, one, two, "side_pockets"))
            ends += [one.nose_end, two.nose_end]
            turns.append((tx, ty))
    starts, lasts = ends[1::2], [*ends[2::2], ends[0]]
    return Layout(list(zip(starts, lasts, turns, strict=True)), mouths)
