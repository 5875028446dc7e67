"""Gases that end before the collisions or the time asked for: inelastic collapse, rest, speeds too small to compute with."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError, Fault, FaultList
from carom.formatting import counted, format_number
from carom.gas.edmd.collisions import QUICK
from carom.gas.edmd.driver import GasArrays

__all__ = ["AT_REST", "COLLAPSE", "TOO_SLOW", "EarlyEnd", "EndedEarlyError", "collapse_of"]

COLLAPSE, AT_REST, TOO_SLOW = "inelastic collapse", "at rest", "too slow"
MOST_NAMED = 8  # balls in a message
CONTACT_TIME_SHARE = 1e-3  # of the mean free time: a contact time that is suggested


@dataclass(frozen=True)
class EarlyEnd:
    """When and why a gas ended before the collisions or the time asked for."""

    kind: str
    """``"inelastic collapse"``, ``"at rest"`` or ``"too slow"`` (speeds that double precision cannot square)."""
    time: float
    balls: tuple[int, ...] = ()
    """Of a collapse: the balls that collide ever faster, by their numbers in :meth:`carom.gas.Gas.balls`."""
    collisions: int | None = None
    """Of a collapse of several balls: about how many collisions they had with each other beyond the median of the others of their
    species; None where these are no majority."""

    def to_dict(self) -> dict[str, Any]:
        """Return the fields as plain data, ``balls`` as a list."""
        return asdict(self) | {"balls": list(self.balls)}


class EndedEarlyError(CaromError):
    """Raised where a gas ends before the collisions or the time asked for, with what was measured until then.

    Attributes
    ----------
    end : EarlyEnd
        When and why; of a collapse, which balls.
    result : GasRun, Ensemble or None
        What was measured until then: of :meth:`carom.gas.Gas.run` and :func:`carom.gas.simulate_gas` a GasRun, of
        :func:`carom.gas.simulate_ensemble` the Ensemble, whose gases count up to where each of them ended.

    Examples
    --------
    Of discs that keep a tenth of their speed of approach, a few soon collide infinitely often in a finite time:

    >>> from carom import Disc, Surface
    >>> from carom.gas import EndedEarlyError, Gas, Species
    >>> gas = Gas([Species(Disc(0.5, 1.0), 400)], (60.0, 60.0), contacts=Surface(0.1, 0, -1), seed=1)
    >>> try:
    ...     gas.run(100_000)
    ... except EndedEarlyError as error:
    ...     end, run = error.end, error.result
    >>> end.kind, len(end.balls) >= 3, run.pair_collisions < 10_000
    ('inelastic collapse', True, True)
    """

    def __init__(self, end: EarlyEnd, *faults: Fault | str, result: Any = None) -> None:
        super().__init__(*faults)
        self.end, self.result = end, result

    @classmethod
    def of(cls, end: EarlyEnd, mean_free_time: float = math.inf) -> EndedEarlyError:
        """Return the error for an end; the mean free time says what contact time prevents a collapse."""
        faults, at = FaultList("Gas.run"), f"at t = {end.time!r}"
        if end.kind == COLLAPSE:
            got = f"an inelastic collapse {at}: {_colliding(end)} ever faster, infinitely often in a finite time"
            share = CONTACT_TIME_SHARE * mean_free_time
            such = f", such as {format_number(share, 1)}" if 0 < share < math.inf else ""
            faults.add(
                "contact_time",
                "a finite number of collisions",
                got,
                f"give a contact_time > 0, a small part of the mean free time{such}",
            )
        elif end.kind == TOO_SLOW:
            got = f"slower balls {at}, whose squared speeds double precision cannot hold"
            faults.add("collisions", "speeds above 1e-140", got, "end the run earlier, or start with larger speeds")
        else:
            advice = "run to a time, not to a number of collisions; or supply energy"
            faults.add("collisions", "a gas with collisions to come", f"a gas at rest {at}", advice)
        return cls(end, *faults)


def _colliding(end: EarlyEnd) -> str:
    """Return the balls of a collapse with their verb."""
    if not end.balls:
        return "balls collide"
    if len(end.balls) == 1:
        return f"ball {end.balls[0]} hits a wall"
    if len(end.balls) > MOST_NAMED:
        more = counted(len(end.balls) - MOST_NAMED, "other")
        return f"balls {', '.join(map(str, end.balls[:MOST_NAMED]))} and {more} collide"
    return f"balls {', '.join(map(str, end.balls[:-1]))} and {end.balls[-1]} collide"


def collapse_of(arrays: GasArrays, time: float) -> EarlyEnd:
    """Return the collapse in which the engine has just ended: the balls that are ahead of the clock, or meet at its time."""
    one, balls = arrays.system[0], arrays.balls
    ahead = balls.bodies["last_contact"] - one["now"]
    pause = QUICK * one["bin_width"] * one["balls"]
    # (with the TC model, the time of the last contact itself)
    involved = np.flatnonzero(ahead > (1.5 * pause if one["contact_time"] == 0 else -pause))
    extra = _extra_collisions(balls.motions["collisions"], balls.motions["species"], involved)
    return EarlyEnd(COLLAPSE, time, tuple(sorted(balls.numbers[involved].tolist())), extra)


def _extra_collisions(collisions: NDArray[Any], species: NDArray[Any], involved: NDArray[Any]) -> int | None:
    """Return about how many collisions some balls had with each other beyond the median of the others of their species."""
    if len(involved) < 2:  # (one ball alone hits a wall)
        return 0
    others = np.ones(len(collisions), bool)
    others[involved] = False
    extra = 0.0
    for kind in np.unique(species[involved]):
        usual = collisions[others & (species == kind)]
        own = collisions[involved[species[involved] == kind]]
        if len(usual) <= len(own):
            return None
        extra += float(np.maximum(own - float(np.median(usual)), 0.0).sum())
    return int(extra / 2)
