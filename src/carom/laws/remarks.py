"""Describe what a law predicts for one ball in sentences: what happens at the wall, on the floor, and on the way."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from carom.bodies import State, slip
from carom.formatting import format_length, format_number, format_time
from carom.laws.law import Answer, Meeting
from carom.laws.results import Settled, TwoStep

__all__ = ["remarks_on"]


def remarks_on(meeting: Meeting, answer: Answer, final: State | None) -> Iterator[str]:
    """Yield sentences on what happens to one ball; ``final`` is None if it never rolls."""
    steps = answer.steps
    if isinstance(steps, TwoStep):
        yield from _wall(meeting, steps)
    if steps is not None:
        yield from _floor(meeting, steps)
    if final is None:
        yield f"the ball never rolls again: {answer.why}"
    else:
        yield from _way(meeting, final)


def _wall(meeting: Meeting, steps: TwoStep) -> Iterator[str]:
    hit = steps.wall
    mu = float(meeting.wall.friction)
    if np.any(steps.floor_impulse != 0):
        end = _ENDS[str(hit.regime)]
        yield f"the wall presses the ball on the floor: both act at once, and the wall contact ends {end}"
    elif hit.regime == "slide":
        needed = format_number(float(hit.required_friction))
        yield f"the ball slides on the wall: its friction {format_number(mu)} is below the {needed} required for sticking"
    elif hit.regime == "graze":
        yield "the ball only grazes the wall, without an impulse"


_ENDS = {
    "stick": "sticking", "slide": "sliding", "graze": "by separation", "jam": "jammed", "stall": "unresolved",
}  # fmt: skip


def _floor(meeting: Meeting, steps: Settled) -> Iterator[str]:
    flight = steps.flight
    if math.isfinite(flight.duration) and flight.duration > 0:
        yield (
            f"the ball flies for {format_time(flight.duration)}, {format_length(flight.distance)} far and up to"
            f" {format_length(flight.height)} high"
            + (", and bounces" if float(steps.after_floor.velocity[2]) > 0 else "")
        )
        if steps.floor.regime == "slide" and steps.rolls:
            mu, needed = (
                format_number(float(meeting.floor.friction)),
                format_number(float(steps.floor.required_friction)),
            )
            yield f"it lands sliding: the floor's friction {mu} is below the {needed} required for sticking"
    elif flight.duration == 0 and steps.rolls:
        left = slip(meeting.ball, steps.after_floor)
        speed = float(np.abs(steps.after_floor.velocity).sum())
        if float(np.abs(left).max()) > 1e-9 * speed:
            yield "the ball stays on the floor and slides until it rolls"


def _way(meeting: Meeting, final: State) -> Iterator[str]:
    v0, v = meeting.state.velocity, final.velocity
    size = float(np.abs(v0).sum() + meeting.ball.radius * np.abs(meeting.state.spin).sum())
    if not float(np.abs(v[:2]).sum()) > 1e-12 * size:
        yield "the ball stops at the wall"
        return
    n = meeting.normal
    if float(n[0] * v[0] + n[1] * v[1]) < -1e-9 * size:
        yield "its spin turns the ball round: it rolls back to the wall and meets it again"
    along0, along = (float(n[0] * u[1] - n[1] * u[0]) for u in (v0, v))
    if along0 * along < 0 and abs(along) > 1e-12 * size:
        yield "the ball returns to the side of the normal from which it came"
    elif along0 == 0 and abs(along) > 1e-12 * size:
        yield f"the ball leaves to the {'left' if along > 0 else 'right'} of the wall's normal"
