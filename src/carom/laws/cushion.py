"""Shared by the published laws of cushions: the ball stays on the table, and what is said where that matters."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from carom.bodies import State, kinetic_energy
from carom.core.jit.kernel import Vec, kernel
from carom.core.motion.phases import ROUNDING
from carom.laws.arrays import WallKernel
from carom.laws.law import (
    Answer,
    Card,
    FitSpec,
    Law,
    Meeting,
    approaches,
    required_friction,
    respond,
    wall_law,
    wall_then_floor,
)

__all__ = ["Struck", "cushion_law", "nose_alone", "stays_on_table"]


class Struck(NamedTuple):
    """A ball after a cushion, with its vertical velocity."""

    after: State
    required_wall: Any
    required_floor: Any = None
    """None: the table does not act during the impact."""


@kernel
def stays_on_table(before: Vec, after: Vec, n: Vec) -> Vec:
    """Return the velocity after a cushion, without its vertical part if the ball came along the table.

    A wall that touches below the centre (a ramp) is no cushion, and keeps no ball down.
    """
    if before[2] == 0 and n[2] <= ROUNDING:
        return after[0], after[1], 0 * before[2]
    return after


def nose_alone(law: WallKernel, meeting: Meeting, last: Any) -> Struck:
    """Return the state after a nose whose law is a kernel, and the friction that it requires."""
    after = respond(law, meeting, last)
    return Struck(after, required_friction(meeting.ball, meeting.state, after, meeting.normal))


def cushion_law(
    card: Card,
    law: WallKernel,
    struck: Callable[[Meeting], Struck],
    on_table: str,
    fit: FitSpec,
    conditions: Callable[[Meeting], list[Any]] = approaches,
    **more: Any,
) -> Law:
    """Return a law of cushions: a kernel that keeps the ball on the table, and the same impact with its vertical velocity."""

    def answer(meeting: Meeting) -> Answer:
        found = struck(meeting)
        before, v = meeting.state.velocity, found.after.velocity.copy()
        v[..., 2] = np.where((before[..., 2] == 0) & (meeting.normal[..., 2] <= ROUNDING), 0.0, v[..., 2])
        own = wall_then_floor(meeting, State.of(v, found.after.spin))
        floor = own.required_floor if found.required_floor is None else found.required_floor
        return replace(own, required_wall=found.required_wall, required_floor=floor)

    def objections(meeting: Meeting, _answer: Answer) -> list[str]:
        m = meeting
        if m.ball.planar:
            return []
        if np.any(m.state.velocity[..., 2] != 0) or np.any(np.asarray(m.height) > 0):
            return ["it describes a ball on the table; one in flight meets the cushion as if there were no table"]
        if np.any(m.normal[..., 2] > ROUNDING):
            return ["it describes a cushion, which touches the ball at or above its centre"]
        rise = struck(m).after.velocity[..., 2]
        if not np.any(np.abs(rise) > 1e-9 * np.abs(m.state.velocity).sum(axis=-1)):
            return []
        share = 100 * float(np.max(m.ball.mass * rise * rise / 2 / kinetic_energy(m.ball, m.state)))
        way = "throws it up" if float(np.max(rise)) > 0 else "drives it into the table"
        return [f"it keeps the ball on the table, though the cushion {way}: {share:.3g} % of the energy is dropped"]

    made = wall_law(
        card, law, conditions, objections, on_table=on_table,
        fits=(FitSpec("planar", absent="it describes a ball on a table"), fit), **more,
    )  # fmt: skip
    return replace(made, answer=answer)
