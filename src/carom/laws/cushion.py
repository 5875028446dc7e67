"""Shared by the published laws of cushions: the ball stays on the table, and what is said where that matters."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from carom.bodies import State
from carom.core.jit.kernel import Vec, dot, kernel
from carom.core.motion.phases import ROUNDING
from carom.laws.arrays import WallKernel
from carom.laws.law import (
    NOTICED,
    Answer,
    Card,
    Case,
    FitSpec,
    Law,
    Meeting,
    Objections,
    Predicted,
    Rule,
    Said,
    approaches,
    required_friction,
    respond,
    size_of,
    wall_law,
    wall_then_floor,
)


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


@kernel
def _in_flight(c: Case, r: Predicted) -> Said:
    return c.planar == 0 and (c.v[2] != 0 or c.height > 0), 0.0, 0.0


@kernel
def _along_table(c: Case) -> bool:
    return c.planar == 0 and c.v[2] == 0 and not c.height > 0


@kernel
def _no_nose(c: Case, r: Predicted) -> Said:
    return _along_table(c) and c.n[2] > ROUNDING, 0.0, 0.0


@kernel
def _share_dropped(c: Case, r: Predicted) -> float:
    """Return the share of the energy that the vertical velocity has, percent."""
    energy = dot(c.v, c.v) + c.kappa * c.a * c.a * dot(c.w, c.w)
    return 100 * r.dropped * r.dropped / energy if energy > 0 else 0.0


@kernel
def _thrown_up(c: Case, r: Predicted) -> Said:
    noticed = r.dropped > NOTICED * size_of(c.v)
    return _along_table(c) and not c.n[2] > ROUNDING and noticed, _share_dropped(c, r), 0.0


@kernel
def _driven_down(c: Case, r: Predicted) -> Said:
    noticed = r.dropped < -NOTICED * size_of(c.v)
    return _along_table(c) and not c.n[2] > ROUNDING and noticed, _share_dropped(c, r), 0.0


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

    def dropped(meeting: Meeting) -> Any:
        return struck(meeting).after.velocity[..., 2]

    objections = Objections(
        Rule(_in_flight, "it describes a ball on the table; one in flight meets the cushion as if there were no table"),
        Rule(_no_nose, "it describes a cushion, which touches the ball at or above its centre"),
        *(
            Rule(
                way, f"it keeps the ball on the table, though the cushion {does}: {{a:.3g}} % of the energy is dropped"
            )
            for way, does in ((_thrown_up, "throws it up"), (_driven_down, "drives it into the table"))
        ),
        dropped=dropped,
    )
    made = wall_law(
        card, law, conditions, objections, on_table=on_table,
        fits=(FitSpec("planar", absent="it describes a ball on a table"), fit), **more,
    )  # fmt: skip
    return replace(made, answer=answer)
