"""Laws that a trajectory is judged by, and the result: :class:`Judgement`."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

from carom.formatting import counted

LAWS = {
    "penetration": "balls, and a ball and the floor, do not overlap",
    "gravity": "a ball in the air falls freely",
    "momentum": "two balls that meet keep their momentum",
    "energy": "no contact adds energy",
    "friction": "a contact's friction is at most mu times its normal force",
    "slip": "friction acts against the slip, and a ball that rolls goes on rolling",
}
FILM_LAWS = {
    "flight": "a ball in the air keeps one acceleration",
    "steady": "a ball moves smoothly from frame to frame",
}
UNITS = {"penetration": "m", "gravity": "m/s^2", "momentum": "N s", "energy": "J", "friction": "", "slip": ""}
SIGMAS = 5.0  # a violation is larger than so many of its standard errors


@dataclass(frozen=True)
class Violation:
    """A law that a trajectory violates."""

    law: str
    """One of :data:`LAWS`, or of :data:`FILM_LAWS`."""
    time: float
    """s."""
    balls: tuple[str, ...]
    size: float
    """m, m/s^2, N s, J; of friction and slip, a coefficient or a share; of laws of films, px."""
    error: float
    """Standard error of the size."""
    text: str

    @property
    def sigmas(self) -> float:
        """The size over its error."""
        return self.size / self.error if self.error > 0 else math.inf


@dataclass
class Judgement:
    """Result of :func:`judge`."""

    noise: float
    """Standard deviation of a coordinate in a frame, m."""
    notes: list[str]
    times: tuple[float, float] = (0.0, 0.0)
    """Of the first and the last frame, s."""
    checked: dict[str, int] = field(default_factory=lambda: dict.fromkeys(LAWS, 0))
    """How often each law was checked."""
    violations: list[Violation] = field(default_factory=list)
    """In order of time."""
    unchecked: dict[str, str] = field(default_factory=dict)
    """Why the other laws could not be checked."""
    laws: dict[str, str] = field(default_factory=lambda: dict(LAWS))
    """What they say; of a film without a scale or a clock those without units."""
    unit: str = "m"
    """Of the noise, and of sizes that are lengths."""

    @property
    def scores(self) -> dict[str, float | None]:
        """Return the share of checks that each law passed; None of one that was not checked."""
        return {law: 1 - len(self.of(law)) / n if n else None for law, n in self.checked.items()}

    @property
    def verdict(self) -> str:
        """How many laws were checked, and how many violations there are in them."""
        laws, count = len(self.laws) - len(self.unchecked), len(self.violations)
        found = counted(count, "violation") if count else "no violation"
        return f"checked {laws} of {len(self.laws)} laws: {found} in {'it' if laws == 1 else 'them'}"

    def of(self, law: str) -> list[Violation]:
        """Return the violations of a law."""
        return [one for one in self.violations if one.law == law]

    def worst(self, law: str) -> Violation | None:
        """Return the violation of a law that is the largest in its own errors; None if there is none."""
        return max(self.of(law), key=lambda one: one.sigmas, default=None)

    def check(
        self, law: str, time: float, balls: Sequence[str], size: float, error: float, least: float, text: str
    ) -> None:
        """Count a check; keep it if it is larger than its errors and than rounding."""
        self.checked[law] += 1
        if size > SIGMAS * error and size > least:
            self.violations.append(Violation(law, time, tuple(balls), size, error, text))
