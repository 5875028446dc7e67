"""One periodic orbit with its stability, and the list of the periodic orbits that were found."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.billiards.orbits import Orbit
from carom.billiards.symbols import letters_of
from carom.formatting import counted

__all__ = ["PeriodicOrbit", "PeriodicOrbits"]


@dataclass(frozen=True, eq=False)
class PeriodicOrbit:
    """One periodic orbit with its stability.

    Besides the multiplier 1 of the energy the map of one period has three, since bounces keep the measure |v.n| ds dv_t dspin:
    lambda, 1/lambda and 1 or -1.

    Examples
    --------
    >>> from carom import billiards
    >>> long, short = billiards.periodic_orbits(billiards.ellipse(2.0, 1.0), 2, law="mirror")[::-1]
    >>> round(long.duration, 9), long.stability, round(short.duration, 9), short.stability
    (8.0, 'hyperbolic', 4.0, 'elliptic')
    """

    orbit: Orbit
    """One period: p bounces, the last of which leads back to the start."""
    period: int
    """Least number of bounces p after which the state returns (in a periodic cell: up to whole cells)."""
    duration: float
    """s: of one period."""
    trace: float
    """lambda + 1/lambda of the pair of multipliers."""
    third: float
    """The third multiplier, 1 or -1: with the mirror law, of the spin."""
    stability: str
    """"elliptic" (|trace| < 2), "hyperbolic" (> 2) or "parabolic"."""
    winding: int | None
    """Turns of one period around the boundary, in the direction that has fewer (in a magnetic field counterclockwise); None if the
    boundary is not one closed curve."""
    cells: tuple[int, int] | None
    """Cells passed in x and y during one period; None in a table that is not periodic."""
    family: int
    """Number of directions in which there are neighbouring periodic orbits of the same energy; 0: it is isolated."""
    error: float
    """Estimated error of the first state, relative to the table's size and the ball's speed: residual and rounding, through the
    inverse of Newton's matrix; where that is singular although the orbit is isolated, some 1e-5."""
    energy: float
    """Twice the energy per mass, m^2/s^2."""
    found: int
    """Number of starts that led to this orbit, to a congruent one or to its family."""

    @property
    def multipliers(self) -> NDArray[np.complex128]:
        """(3): lambda, 1/lambda and the third; from the trace, so that they are exact to rounding for parabolic orbits too."""
        half = self.trace / 2
        root = np.sqrt(complex(half * half - 1))
        far = half + root if half >= 0 else half - root
        return np.array([far, 1 / far, self.third])

    @property
    def rotation_number(self) -> float | None:
        """Of the neighbours of an elliptic orbit: the angle of the multipliers over 2 pi, from 0 to 1/2; None for others."""
        return math.acos(self.trace / 2) / math.tau if self.stability == "elliptic" else None

    @property
    def multiple(self) -> bool:
        """Whether it is a multiple root of its equations: parabolic and isolated, so that it is known less well (``error``)."""
        return self.stability == "parabolic" and not self.family

    @property
    def pieces(self) -> tuple[int, ...]:
        """(p): index of the piece of the boundary at each bounce, as :attr:`Orbit.piece`."""
        return tuple(int(k) for k in self.orbit.piece)

    @property
    def itinerary(self) -> str:
        """The walls that it meets as letters (:func:`itinerary`), from where the text comes first in the alphabet."""
        walls = self.orbit.setup.shape.wall_parts(self.orbit.piece).tolist()
        return letters_of(min(walls[k:] + walls[:k] for k in range(self.period)))

    def to_dict(self) -> dict[str, Any]:
        """Return the orbit as plain numbers, for JSON: its multipliers as [real, imaginary], its bounces one after the other."""
        names = (
            "period", "duration", "stability", "trace", "rotation_number", "winding", "cells", "itinerary", "family", "error",
            "found",
        )  # fmt: skip
        run = self.orbit
        return {name: getattr(self, name) for name in names} | {
            "multipliers": [[one.real, one.imag] for one in self.multipliers.tolist()],
            "position": run.position.tolist(), "velocity": run.velocity.tolist(), "spin": run.spin.tolist(),
            "piece": list(self.pieces),
        }  # fmt: skip

    def __repr__(self) -> str:
        """Return one line."""
        return f"<PeriodicOrbit: {self.orbit.setup.table}: {self.describe()}>"

    def describe(self) -> str:
        """Return one line: period, duration, stability and what else is known."""
        said = [f"period {self.period}", f"duration {self.duration:.9g} s", self.stability]
        if self.rotation_number is not None:
            said.append(f"rotation number {self.rotation_number:.6f}")
        else:
            said.append(f"multiplier {self.multipliers[0].real:.9g}")
        if self.winding is not None:
            said.append(f"winds {self.winding} of {self.period}")
        if self.cells is not None:
            said.append(f"passes {self.cells[0]}, {self.cells[1]} cells")
        if self.family:
            said.append(f"one of a family with {self.family} parameter{'s' if self.family > 1 else ''}")
        return ", ".join(said)


@dataclass(frozen=True, eq=False)
class PeriodicOrbits(Sequence[PeriodicOrbit]):
    """The periodic orbits that were found, by period and duration, each once up to congruence.

    Orbits that differ by a rotation, a reflection or the direction of time are congruent; in a magnetic field by a rotation, or
    by a reflection and the direction of time. Of each continuous family one is listed.

    Examples
    --------
    >>> from carom import billiards
    >>> found = billiards.periodic_orbits(billiards.circle(), (2, 3, 4), law="mirror", starts=200)
    >>> [(one.period, one.winding, round(one.duration, 9)) for one in found]
    [(2, 1, 4.0), (3, 1, 5.196152423), (4, 1, 5.656854249)]
    """

    orbits: tuple[PeriodicOrbit, ...]
    starts: int
    """Number of starts for each period."""
    corners: bool = False
    """Whether the table has corners, at which orbits end."""

    def __len__(self) -> int:
        """Return the number of orbits."""
        return len(self.orbits)

    def __getitem__(self, which: Any) -> Any:
        """Return one orbit, or a tuple of them."""
        return self.orbits[which]

    def __iter__(self) -> Iterator[PeriodicOrbit]:
        """Iterate over the orbits."""
        return iter(self.orbits)

    @property
    def unseen(self) -> float:
        """Estimated chance that one more start that closes shows a new orbit: the share of orbits found once (Good 1953)."""
        closed = sum(one.found for one in self.orbits)
        return sum(one.found == 1 for one in self.orbits) / closed if closed else 1.0

    def __repr__(self) -> str:
        """Return one line."""
        return f"<PeriodicOrbits: {len(self)} from {self.starts:,} starts>"

    @property
    def completeness(self) -> str:
        """How many starts closed, whether orbits were found once only, and whether corners leave some out: one line."""
        closed, once = sum(one.found for one in self.orbits), sum(one.found == 1 for one in self.orbits)
        left_out = (
            " The map is not smooth at the table's corners: orbits that meet one are left out." if self.corners else ""
        )
        if not closed:
            return f"No periodic orbit: none of {self.starts:,} starts for each period closed.{left_out}"
        end = (
            f"{counted(once, 'orbit')} found once: more starts may show more"
            if once
            else "every orbit was found twice or more"
        )
        return f"{counted(closed, 'start')} closed, of {self.starts:,} for each period; {end}.{left_out}"

    def describe(self) -> str:
        """Return a line for each orbit, and how complete the list is likely to be."""
        return "\n".join([*(f"{one.describe()}, found {one.found} times" for one in self.orbits), self.completeness])
