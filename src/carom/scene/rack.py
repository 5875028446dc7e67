"""A rack of balls: which ones lie in it, row by row, and the gaps between them, drawn from a seed."""

from __future__ import annotations

import math
from collections.abc import Sequence

from pydantic import model_validator

from carom.core.random import uniform
from carom.errors import Fault, did_you_mean, shortened_list, shown
from carom.formatting import format_length
from carom.scene.ball import SceneBall
from carom.scene.schema import Count, CountOrZero, Gap, Model, Vector, raise_faults


class Rack(Model):
    """The balls of a rack, and the gaps between them.

    Parameters
    ----------
    balls : names of the balls, row by row. The first stays where it is declared, and the rows follow along x
    rows : how many balls each row has; default: a triangle, 1, 2, 3, ...
    gap : m, >= 0: the balls are laid anew around the first, with such gaps; default: each lies where it is declared
    gap_spread : m, at most ``gap``: each ball is moved at random by up to half of it, so that no gap differs from ``gap`` by more
        (their standard deviation is 0.35 of it); default: 0
    seed : of these moves; default: 0. The same seed gives the same places, to the last bit

    The balls have one radius. Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> scene = carom.load_scene("pool-9ft")
    >>> tight = carom.replaced(scene, {"rack.gap": "0.05 mm", "rack.gap_spread": "0.04 mm", "rack.seed": 3})
    >>> tight.rack.describe()
    'a rack of 15 balls with gaps of 50 µm ± 40 µm (seed 3)'
    """

    balls: tuple[str, ...] = ()
    rows: tuple[Count, ...] = ()
    gap: Gap | None = None
    gap_spread: Gap = 0.0
    seed: CountOrZero = 0

    @model_validator(mode="after")
    def _sound(self) -> Rack:
        faults = []
        if not self.balls or sum(self._rows) != len(self.balls):
            got = f"{len(self.balls)} balls" + (f" in rows of {shown(list(self.rows))}" if self.rows else "")
            wanted = f"names of {sum(self.rows)} balls" if self.rows else "names of 1, 3, 6, 10, 15, ... balls"
            faults.append(Fault("", "balls", wanted, got, "" if self.rows else "rows = [1, 2, 3, 2, 1] is a diamond"))
        if twice := next((name for i, name in enumerate(self.balls) if name in self.balls[:i]), None):
            faults.append(Fault("", "balls", "each ball once", f"{twice!r} twice"))
        if self.gap is None and self.gap_spread > 0:
            faults.append(Fault("", "gap", "a length in m, >= 0, as there is a gap_spread", "nothing"))
        elif self.gap is not None and self.gap_spread > self.gap:
            expected = f"at most the gap, {format_length(self.gap)}"
            got = format_length(self.gap_spread)
            faults.append(Fault("", "gap_spread", expected, got, "balls would overlap"))
        raise_faults(faults)
        return self

    @property
    def _rows(self) -> tuple[int, ...]:
        if self.rows:
            return self.rows
        return tuple(range(1, math.isqrt(2 * len(self.balls)) + 1))

    def describe(self) -> str:
        """Return the balls and their gaps in a few words."""
        gaps = "" if self.gap is None else f" with gaps of {format_length(self.gap)}"
        if self.gap_spread > 0:
            gaps += f" ± {format_length(self.gap_spread)} (seed {self.seed})"
        return f"a rack of {len(self.balls)} balls{gaps}"

    def faults(self, names: Sequence[str], balls: Sequence[SceneBall]) -> list[Fault]:
        """Report names that no ball has, balls of different radii, and gaps that are larger than a ball."""
        found = []
        widest = max(ball.radius for ball in balls)
        if self.gap is not None and self.gap >= widest:
            got, advice = format_length(self.gap), "a number is in m: gap = '0.05 mm'"
            found.append(Fault("", "rack.gap", f"less than the radius, {format_length(widest)}", got, advice))
        for i, name in enumerate(self.balls):
            at = f"rack.balls[{i}]"
            if name not in names:
                hint = did_you_mean(name, names)
                found.append(Fault("", at, f"a ball of {shortened_list(names, 16)}", repr(name), hint))
            elif self.gap is not None and self.balls[0] in names:
                one, first = (balls[names.index(ball)] for ball in (name, self.balls[0]))
                if one.radius != first.radius:
                    expected = f"a ball of radius {format_length(first.radius)}, as the first"
                    found.append(Fault("", at, expected, format_length(one.radius), "leave out rack.gap"))
        return found

    def lays(self, name: str) -> bool:
        """Return whether the gaps say where a ball lies, and not its own position: all but the first."""
        return self.gap is not None and name in self.balls[1:]

    def places(self, first: Vector, radius: float) -> tuple[Vector, ...]:
        """Return the centres of all balls, the first of which is given, m."""
        pitch, gap = 2 * radius + (self.gap or 0.0), self.gap_spread / 2
        found: list[Vector] = []
        x, before, drawn = 0.0, 0, 0
        dx0 = dy0 = 0.0
        for count in self._rows:
            if before:
                x += pitch * (math.sqrt(0.75) if (count - before) % 2 else 1.0)
            before = count
            for k in range(count):
                drawn, dx, dy = _in_disc(self.seed, drawn)
                if not found:
                    dx0, dy0 = dx, dy
                y = (k - (count - 1) / 2) * pitch
                found.append((first[0] + (x + gap * (dx - dx0)), first[1] + (y + gap * (dy - dy0)), first[2]))
        return tuple(found)


def _in_disc(seed: int, n: int) -> tuple[int, float, float]:
    """Draw a point in the unit disc from the numbers of a seed after the first n; and how many are drawn by then."""
    while True:
        x, y = (2 * uniform(seed & 0xFFFFFFFF, seed >> 32, n + k) - 1 for k in (0, 1))
        n += 2
        if x * x + y * y <= 1:
            return n, x, y
