"""Contacts of balls that overlap in time, where a run is to resolve one pair at a time: in racks, cradles, rows of balls."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.motion.phases import HELD, LEFT, POCKETED
from carom.formatting import counted, format_length
from carom.laws.pair import contact_modulus, contact_time, stiffness
from carom.scene.scene import Scene
from carom.simulation.records import BALL, RunRecord

Array = NDArray[np.float64]
ROUNDING = 1e-9  # of the speed of approach: slower balls do not approach
MEETINGS = 1000  # that are looked at, from the first on


class OverlapInTime(NamedTuple):
    """A meeting of two balls during which a third one is near enough to touch one of them."""

    time: float
    pair: tuple[int, int]
    third: int
    gap: float
    """From the third ball to the nearer of the two, m."""


def overlaps(run: RunRecord) -> list[OverlapInTime]:
    """Return the meetings of two balls, of the first thousand, during which a third ball touches or is about to touch one of them.

    That is so where its gap is at most the duration of the contact times its speed of approach, before or after the meeting.
    """
    log, balls = run.log, run.scene.balls
    first = np.flatnonzero(_are_pairs(log))[:MEETINGS]
    if len(first) == 0 or len(balls) < 3:
        return []
    one, two = log["ball"][first], log["ball"][first + 1]
    own = [np.flatnonzero(log["ball"] == i) for i in range(len(balls))]
    after = run.at(log["t"][first])
    assert after.position is not None
    found = []
    for k, row in enumerate(first):
        i, j = int(one[k]), int(two[k])
        x, v = after.position[k].copy(), after.velocity[k].copy()
        for ball, rows in enumerate(own):
            # of several events of an instant, those up to this one have happened, and the others not yet
            place = np.searchsorted(rows, row + 1, side="right")
            last, later = rows[place - 1], rows[place : place + 1]
            if log["phase"][last] in (HELD, LEFT, POCKETED):
                x[ball] = np.nan
            elif log["t"][last] == log["t"][row]:
                v[ball] = log["v"][last]
            elif len(later) and log["t"][later[0]] == log["t"][row]:
                v[ball] = log["v_before"][later[0]]
        before = v.copy()
        before[i], before[j] = log["v_before"][row], log["v_before"][row + 1]
        if (near := _third(run.scene, x, before, v, i, j)) is not None:
            found.append(OverlapInTime(float(log["t"][row]), (i, j), *near))
    return found


def _are_pairs(log: NDArray[np.void]) -> NDArray[np.bool_]:
    """Return for each row but the last whether it and the next one are the two of a meeting: first its lower-numbered row."""
    one, two = log[:-1], log[1:]
    meet = (one["kind"] == BALL) & (two["kind"] == BALL) & (one["t"] == two["t"])
    meet &= (one["ball"] == two["other"]) & (one["other"] == two["ball"])
    begins, taken = np.zeros(len(meet), bool), False
    for k, same in enumerate(meet):  # (the same balls may meet several times in an instant)
        begins[k] = same and not taken
        taken = bool(begins[k])
    return begins


def _third(scene: Scene, x: Array, before: Array, after: Array, i: int, j: int) -> tuple[int, float] | None:
    """Return the ball nearest to touching one of two that meet, and its gap; None where none does before they part."""
    radius, mass = (np.array([getattr(ball, name) for ball in scene.balls]) for name in ("radius", "mass"))
    n = x[j] - x[i]
    approach = float((before[i] - before[j]) @ n) / float(np.linalg.norm(n))
    if not approach > 0:
        return None
    reduced, pair = mass[i] * mass[j] / (mass[i] + mass[j]), scene.ball_contact
    stiff = stiffness(contact_modulus(pair.young, pair.poisson), radius[i], radius[j])
    lasts, nearest = contact_time(reduced, stiff, approach), None
    for k in (i, j):
        away = x - x[k]
        distance = np.linalg.norm(away, axis=1)
        distance[[i, j]] = np.nan
        gap = distance - radius - radius[k]
        closing = [((v[k] - v) * away).sum(axis=1) / distance for v in (before, after)]
        reach = lasts * np.fmax(*closing)
        with np.errstate(invalid="ignore"):
            touches = (gap <= reach) & (np.fmax(*closing) > ROUNDING * approach)
        for ball in np.flatnonzero(touches):
            if nearest is None or gap[ball] < nearest[1]:
                nearest = int(ball), float(gap[ball])
    return nearest


def overlap_note(run: RunRecord) -> str | None:
    """Return a line on contacts that overlap in time and were resolved one by one; None where there are none.

    There are none in a scene whose ``ball_contact.overlap`` is true: they are resolved together.

    Examples
    --------
    A ball meets two that touch each other:

    >>> import carom
    >>> from carom.simulation.contacts_in_time import overlap_note
    >>> ball = {"radius": 0.03, "mass": 0.17}
    >>> row = [{**ball, "position": (x, 0, 0.03), "velocity": (v, 0, 0)} for x, v in ((0, 1), (0.5, 0), (0.56, 0))]
    >>> overlap_note(carom.simulate(carom.Scene(balls=row, ball_contact={"overlap": False}, run={"duration": 1.0})))[:60]
    'contacts overlap in time at 1 of 2 meetings of balls (first '
    """
    found = [] if run.scene.ball_contact.overlap else overlaps(run)
    if not found:
        return None
    names, first = run.scene.ball_names, found[0]
    pair = " and ".join(names[ball] for ball in first.pair)
    gap = "in contact" if first.gap <= 1e-9 else f"{format_length(first.gap)} away"
    meetings = int(_are_pairs(run.log).sum())
    of = f"the first {MEETINGS:,}" if meetings > MEETINGS else counted(meetings, "meeting")
    return (
        f"contacts overlap in time at {len(found)} of {of}{' meetings' * (meetings > MEETINGS)} of balls (first at"
        f" {first.time:.4g} s: {pair}, with {names[first.third]} {gap}); the run resolves one pair at a time, so that speeds and"
        " directions of balls that touch or nearly touch, as in a rack, are not right"
    )
