"""Figures of a break: how the energy is shared when the rack has opened, and where the balls lie at the end."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from carom.core.motion.phases import POCKETED
from carom.errors import CaromError
from carom.formatting import counted, format_length, format_number
from carom.simulation.phrases import listed
from carom.simulation.records import BALL, IN_CLUSTER
from carom.simulation.run_record import RunRecord

__all__ = ["BreakStatistics", "break_statistics"]

OPEN_AFTER = 0.012  # s after the first contact: the balls of a rack have parted, and none has met a cushion
FAST = 1.0  # m/s


@dataclass(frozen=True)
class BreakStatistics:
    """Figures of a break: :func:`break_statistics`."""

    time: float
    """Of the first contact with the rack, s."""
    speeds: NDArray[np.float64]
    """Of all balls (B,), 12 ms later, m/s: the rack has opened then."""
    fastest: int
    """The number of the fastest ball of the rack then."""
    share: float
    """Its share of the kinetic energy of motion of all balls then."""
    distance: float
    """Mean distance of the racked balls that lie on the table at the end from the rack's centre, m; NaN if none does."""
    pocketed: tuple[int, ...]
    """Numbers of the balls that are pocketed."""
    names: tuple[str, ...]

    @property
    def fast(self) -> int:
        """The number of balls faster than 1 m/s when the rack has opened."""
        return int((self.speeds > FAST).sum())

    @property
    def median(self) -> float:
        """The median speed of all balls when the rack has opened, m/s."""
        return float(np.median(self.speeds))

    def describe(self) -> str:
        """Return the figures in a sentence or two."""
        down = [self.names[i] for i in self.pocketed]
        far = (
            "" if np.isnan(self.distance) else f"; on average {format_length(self.distance)} from its centre at the end"
        )
        return (
            f"The break: {counted(self.fast, 'ball')} faster than 1 m/s when the rack has opened, median"
            f" {format_number(self.median)} m/s; the fastest, {self.names[self.fastest]}, at"
            f" {format_number(float(self.speeds[self.fastest]))} m/s has {100 * self.share:.0f} % of the energy{far};"
            f" {f'pocketed: {listed(down)}' if down else 'none is pocketed'}."
        )


def break_statistics(run: RunRecord) -> BreakStatistics:
    """Return figures of the break of a run whose scene has a rack.

    Raises CaromError, one line, for a scene without a rack, and for a run in which no ball meets it.

    Examples
    --------
    >>> import carom
    >>> found = carom.simulate(carom.new_scene("pool-9ft", rack="9-ball")).break_statistics()
    >>> found.fast, found.names[found.fastest]
    (6, '5')
    """
    names = run.scene.ball_names
    racked = [] if run.scene.rack is None else [names.index(name) for name in run.scene.rack.balls]
    if not racked:
        raise CaromError("break_statistics: expected a scene with a rack, got one without; carom.Rack names its balls")
    met = run.log[np.isin(run.log["kind"], (BALL, IN_CLUSTER)) & np.isin(run.log["ball"], racked)]
    if len(met) == 0:
        raise CaromError("break_statistics: expected a ball that meets the rack, got none in this run")
    time = float(met["t"][0])
    opened = run.at(min(time + OPEN_AFTER, run.end)).velocity
    start, end = run.at(0.0).position, run.final.position
    assert start is not None
    assert end is not None
    speeds = np.nan_to_num(np.linalg.norm(opened, axis=1))
    energy = speeds**2 * np.array([ball.mass for ball in run.scene.balls])
    away = np.linalg.norm((end - start[racked].mean(axis=0))[racked, :2], axis=1)
    pocketed = {int(row["ball"]) for row in run.log[run.log["phase"] == POCKETED]}
    fastest = racked[int(np.argmax(speeds[racked]))]
    lying = away[~np.isnan(away)]
    return BreakStatistics(
        time=time, speeds=speeds, fastest=fastest, share=float(energy[fastest] / energy.sum()),
        distance=float(lying.mean()) if len(lying) else float("nan"), pocketed=tuple(sorted(pocketed)), names=names,
    )  # fmt: skip
