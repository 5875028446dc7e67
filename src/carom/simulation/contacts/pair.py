"""The impact of two balls: by the law of the pair, or with all balls around where contacts overlap in time."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from carom.core.contact import friction_at_slip
from carom.core.jit.kernel import Vec, dot, kernel, vector
from carom.core.motion.phases import HELD, LEFT
from carom.core.motion.restitution import restitution
from carom.formatting import counted, format_number
from carom.laws.callbacks import call_user
from carom.laws.law import CALLED_WALL
from carom.laws.pair import pair_as_wall, pair_contact, pair_slip, struck_as_wall
from carom.simulation.cluster import collide_cluster, overlaps_in_time, place_all
from carom.simulation.contacts.contact import DONE, NO_IMPULSE, ContactKind, Outcome, leave, leave_cluster
from carom.simulation.motion import is_on_floor
from carom.simulation.phrases import at, direction, speed
from carom.simulation.records import BALL, IN_CLUSTER, MEETINGS, NO_REGIME
from carom.simulation.resting_contact import continue_ball_contact, is_pressed_on_ball, keep_on_floor

if TYPE_CHECKING:
    from carom.simulation.run_record import RunRecord

__all__ = ["PAIR", "line_of_centres", "meet_ball", "pair_friction"]

RACK = 6  # balls at rest that are struck at once are a rack


@kernel
def line_of_centres(ball: Any, other: Any) -> Vec:
    """Return the unit vector from the centre of the other ball to the centre of the first."""
    x, y = vector(ball.x), vector(other.x)
    r = (x[0] - y[0], x[1] - y[1], x[2] - y[2])
    far = math.sqrt(dot(r, r))
    return (r[0] / far, r[1] / far, r[2] / far)


@kernel
def pair_friction(world: Any, ball: Any, other: Any, n: Vec) -> float:
    """Return the friction coefficient of two balls that meet: at the slip that they have, where it depends on it."""
    if not world.pair_drop > 0:
        return float(world.pair_mu)
    v, w, v2, w2 = vector(ball.v), vector(ball.w), vector(other.v), vector(other.w)
    _un, ut = pair_slip(v, w, v2, w2, n, ball.radius, other.radius)
    return friction_at_slip(world.pair_mu, world.pair_drop, world.pair_rate, math.sqrt(dot(ut, ut)))


@kernel
def meet_ball(world: Any, features: Any, balls: Any, i: int, k: int, users: Any) -> Outcome:
    """Resolve the impact of balls i and k, or of a whole cluster (carom.simulation.cluster); the impulse is on ball i."""
    ball, other = balls[i], balls[k]
    n = line_of_centres(ball, other)
    v, w, v2, w2 = vector(ball.v), vector(ball.w), vector(other.v), vector(other.w)
    approach = dot((v2[0] - v[0], v2[1] - v[1], v2[2] - v[2]), n)
    pressed, driven = is_pressed_on_ball(world, ball, other, n, approach)
    e = 1.0 if driven else restitution(world.pair_form, vector(world.pair_p), max(approach, 0.0))
    a, m, kappa, a2, m2, kappa2 = ball.radius, ball.mass, ball.kappa, other.radius, other.mass, other.kappa
    mu, last, law = pair_friction(world, ball, other, n), world.pair_beta, world.pair_law
    if law >= CALLED_WALL:
        before, spin, radius, inertia, mass = pair_as_wall(v, w, v2, w2, a, m, kappa, a2, m2, kappa2)
        after, _spin = call_user(users[law - CALLED_WALL], before, spin, n, radius, inertia, e, mu, last)
        v, w, v2, w2, j = struck_as_wall(v, w, v2, w2, n, before, after, mass, a, m, kappa, a2, m2, kappa2)
        required, regime = 0 * mass, NO_REGIME
    else:
        v, w, v2, w2, j, required, regime = pair_contact(v, w, v2, w2, n, a, m, kappa, a2, m2, kappa2, e, mu, last)
    if world.pair_modulus > 0 and not pressed:
        place_all(world, balls, i, k)
        if overlaps_in_time(world, features, balls, i, k, v, v2, approach):
            count = collide_cluster(world, features, balls, i, k, -1)
            if count > 0:
                leave_cluster(world, balls, count)
                c, m = vector(ball.dv), ball.mass
                v = vector(ball.v)
                j = (m * (v[0] - c[0]), m * (v[1] - c[1]), m * (v[2] - c[2]))
                return j, NO_IMPULSE, 0 * required, NO_REGIME, DONE, count
    one_lies, other_lies = is_on_floor(world, ball), is_on_floor(world, other)
    if driven:
        v, v2 = keep_on_floor(world, ball, v, one_lies), keep_on_floor(world, other, v2, other_lies)
    leave(world, ball, v, w, one_lies)
    leave(world, other, v2, w2, other_lies)
    p = continue_ball_contact(world, ball, other, n, approach)
    if p != 0:
        j = (j[0] + p * n[0], j[1] + p * n[1], j[2] + p * n[2])
    return j, NO_IMPULSE, required, regime, DONE, 0


def sentence(run: RunRecord, features: Any, row: Any) -> str:
    """Return the words for an impact of two balls: who strikes whom, and this one's speed afterwards."""
    other = run.scene.ball_names[row["other"]]
    before, after = speed(row["v_before"]), speed(row["v"])
    how = f"is struck by {other}" if before == 0 else f"meets {other} at {format_number(before)} m/s"
    met = _met_at_once(run, row)
    if len(met) >= RACK and before > 0 and not np.any(met["v_before"]):
        how = f"breaks the rack, {len(met)} balls, at {format_number(before)} m/s"
    elif len(met) > 1:
        how += f", together with {counted(len(met) - 1, 'other ball')}"
    text = f"{at(row)} it {how}"
    if row["phase"] in (HELD, LEFT):
        return text
    if after <= 1e-9 * before:
        return f"{text} and stops"
    return f"{text} and goes off at {format_number(after)} m/s{direction(row['v'])}"


def _met_at_once(run: RunRecord, row: Any) -> NDArray[np.void]:
    """Return the rows of the other balls of a meeting of balls whose contacts overlap in time; none where two meet."""
    log = run.log[run.log["t"] == row["t"]]
    rows = log[np.isin(log["kind"], MEETINGS) & (log["ball"] != row["ball"])]
    found: NDArray[np.void] = rows if (rows["kind"] == IN_CLUSTER).any() else rows[:0]
    return found


PAIR = ContactKind(BALL, meet_ball, BALL, "ball", sentence=sentence)
