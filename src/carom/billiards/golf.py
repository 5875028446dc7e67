"""Putts at golf's hole: which speeds and offsets are caught, which lip out."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.billiards.rolling_run import STICKS, RollingRun, roll
from carom.billiards.surfaces import hole
from carom.bodies import Ball, Surface
from carom.errors import CaromError, Fault
from carom.public.progress import Progress

__all__ = ["OUTCOMES", "Putts", "putt", "putts"]

Array = NDArray[np.float64]
OUTCOMES = ("caught", "lips out", "rolls past", "goes round", "flies over")
GOLF = Ball(0.02135, 0.0459)
RADIUS, DEPTH = 0.054, 0.1016
STARTS = 1.05  # radii of the hole, from its centre: the place along the way at which a putt begins
TURNED = math.radians(1.0)  # a ball that comes away in another direction by more than this has lipped out
ACCURACY = 1e-9
LOOKS = 5  # times in each phase at which the height is looked at: phases are steps of the integrator
LONGEST = 20.0  # s: without losses a ball may go round in the hole, up to the rim and down again, for ever


@dataclass(frozen=True, eq=False)
class Putts:
    """Outcomes of putts by speed and offset."""

    speeds: Array
    """m/s, at the edge of the hole."""
    offsets: Array
    """From the line through the hole's centre (m)."""
    outcome: NDArray[np.int64]
    """Index into OUTCOMES, (speeds, offsets)."""
    turn: Array
    """Angle (rad) by which the velocity as seen from above is turned; NaN for a ball that is caught."""
    radius: float
    """Of the hole (m)."""
    lowest: Array
    """Least height of the centre over the green (m), (speeds, offsets): a ball that lips out with a negative one was in the hole,
    the others stay on the rim (Hogan & Antali's hole and rim lip outs)."""

    @property
    def lips_out_of_hole(self) -> NDArray[np.bool_]:
        """(speeds, offsets): whether the ball lips out after its centre was below the green."""
        found: NDArray[np.bool_] = (self.outcome == OUTCOMES.index("lips out")) & (self.lowest < 0)
        return found


def putt(
    speed: float,
    offset: float = 0.0,
    *,
    ball: Ball = GOLF,
    radius: float = RADIUS,
    depth: float = DEPTH,
    contact: Surface | None = None,
) -> RollingRun:
    """Follow one putt that rolls in the x direction towards a hole at the origin.

    Parameters
    ----------
    speed : float
        m/s, at the edge of the hole.
    offset : float
        y of the ball (m), less than the hole's radius in size.
    ball : Ball
        A golf ball of 42.7 mm by default.
    radius, depth : float
        Of the hole (m); golf's, 54 mm and 101.6 mm (4 in), by default.
    contact : Surface, optional
        For impacts with the rim and the wall, by the contact law; without restitution, and sticking, by default.

    Returns
    -------
    RollingRun
        It ends with "bottom" (caught), "away", or "duration" after 20 s in which the ball goes round.

    Raises
    ------
    CaromError
        A speed that is not positive, an offset that misses the hole.

    Examples
    --------
    >>> from carom import billiards
    >>> billiards.putt(1.3).end, billiards.putt(1.3, 0.03).end
    ('bottom', 'away')
    """
    if not (0 < speed < math.inf and abs(offset) < radius):
        expected = "a speed > 0 m/s and an offset of less than the hole's radius"
        raise CaromError(Fault("putt", "speed, offset", expected, f"{speed!r}, {offset!r}"))
    r = float(ball.radius)
    x = -math.sqrt((STARTS * radius) ** 2 - offset * offset)
    start = (x, offset, r), (speed, 0, 0)
    return roll(
        hole(radius, depth, r), *start, ball=ball, duration=LONGEST, contact=contact or STICKS, accuracy=ACCURACY
    )


def putts(
    speeds: ArrayLike,
    offsets: ArrayLike,
    *,
    ball: Ball = GOLF,
    radius: float = RADIUS,
    depth: float = DEPTH,
    contact: Surface | None = None,
    progress: Progress | None = None,
) -> Putts:
    """Follow putts of all speeds and offsets, for a map of those that are caught.

    Compare Hogan & Antali, *Mechanics of the golf lip out*, R. Soc. Open Sci. 12, 250907 (2025). The parameters are those of
    `putt`, with an array (N,) of speeds and an array (M,) of offsets.

    Returns
    -------
    Putts
        Outcomes (N, M).

    Examples
    --------
    >>> from carom import billiards
    >>> found = billiards.putts([0.4, 1.8], [0.0, 0.03])
    >>> [[billiards.OUTCOMES[k] for k in row] for row in found.outcome]
    [['caught', 'caught'], ['flies over', 'lips out']]
    """
    v, y = np.atleast_1d(np.asarray(speeds, dtype=float)), np.atleast_1d(np.asarray(offsets, dtype=float))
    outcome, turn = np.zeros((v.size, y.size), dtype=np.int64), np.full((v.size, y.size), math.nan)
    lowest = np.zeros((v.size, y.size))
    for i, speed in enumerate(v):
        for k, offset in enumerate(y):
            run = putt(float(speed), float(offset), ball=ball, radius=radius, depth=depth, contact=contact)
            lowest[i, k] = min(
                float(phase.state(t)[2]) for phase in run.phases for t in np.linspace(phase.begin, phase.end, LOOKS)
            )
            if run.end == "duration":
                outcome[i, k] = 3
            elif run.end == "away":
                after = run.events[-1].velocity
                turn[i, k] = abs(math.atan2(after[1], after[0]))
                flew = any(event.kind == "leaves" for event in run.events)
                outcome[i, k] = 1 if turn[i, k] > TURNED else 4 if flew else 2
        if progress:
            progress(i + 1, v.size, f"putts at {speed:.3g} m/s")
    return Putts(v, y, outcome, turn, radius, lowest)
