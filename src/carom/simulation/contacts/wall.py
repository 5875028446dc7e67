"""The impact of a ball on a wall: by the wall's law, with wall and floor at once where the wall presses the ball down."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from carom.core.contact import SLIDE, STICK, one_contact, slip_velocity
from carom.core.geometry.features import OVER, feature_normal, gap_to_feature
from carom.core.geometry.gaps import feature_gap, impact_normal
from carom.core.jit.kernel import Vec, dot, kernel, vector
from carom.core.motion.phases import FLIGHT, HELD, PIVOTING, REST, ROLLING, ROUNDING
from carom.core.motion.restitution import restitution
from carom.core.motion.rolling import UP
from carom.formatting import format_number
from carom.laws.callbacks import call_user
from carom.laws.conventional import conventional_reflection
from carom.laws.law import CALLED_WALL, CONTACT_WALL, MIRROR_WALL, NO_SLIP_WALL, ROLLING_WALL, TWO_STEP_WALL
from carom.laws.two_step import UNDEFINED
from carom.laws.wall_and_floor.solver import JAM, STALL
from carom.simulation.cluster import collide_cluster, overlaps_at_wall
from carom.simulation.contacts.contact import DONE, ContactKind, Outcome, leave, leave_cluster, without_impulse
from carom.simulation.motion import is_on_floor, write_vector
from carom.simulation.phrases import at, speed
from carom.simulation.records import NO_REGIME, WALL
from carom.simulation.resting_contact import continue_wall_contact, is_driven_into_wall
from carom.simulation.wall_and_floor import joint_impact

if TYPE_CHECKING:
    from carom.simulation.run_record import RunRecord

__all__ = [
    "REFUSED_ROLLING",
    "REFUSED_STALL",
    "REFUSED_UNDEFINED",
    "WALL_CONTACT",
    "cushion_side",
    "meet_wall",
    "wall_normal",
]

REFUSED_ROLLING, REFUSED_UNDEFINED, REFUSED_STALL = 1, 2, 3
REFUSALS = {
    REFUSED_ROLLING: "the wall's law is for a ball that rolls into a vertical wall (carom laws conventional); this one slides or"
    " flies there; the law two-step takes any ball",
    REFUSED_UNDEFINED: "a wall with tangential restitution presses the ball on the floor, which has no law; take"
    " tangential_restitution = 0, or floor_contact = 'after'",
    REFUSED_STALL: "wall and floor lock the ball between them, which is not followed to its end; take a smaller friction,"
    " or floor_contact = 'after'",
}

# Relative errors of a speed that are rounding: below the first it has no digits left, above the second it is not rounding.
LEAST_ROUNDING, MOST_ROUNDING = 3e-16, 1e-11
REGIME_PHRASES = {STICK: ", sticks", SLIDE: ", slides along it", JAM: ", is wedged between it and the floor"}


@kernel
def _kinetic(ball: Any) -> float:
    """Return twice the kinetic energy per mass: v^2 + kappa a^2 w^2."""
    v, w, a = vector(ball.v), vector(ball.w), ball.radius
    return float(dot(v, v) + ball.kappa * (a * a) * dot(w, w))


@kernel
def keeps_energy(world: Any, ball: Any) -> bool:
    """Return whether a ball moves on without a loss of energy: in flight, or rolling without resistance."""
    rolls = ball.phase == ROLLING and not world.resistance > 0 and not world.spin_friction > 0
    rolls = rolls and not world.rolling_drag > 0 and not world.spin_damping > 0 and not world.spin_drag > 0
    return bool(ball.phase == FLIGHT or rolls)


@kernel
def _restore(world: Any, ball: Any, energy: float) -> None:
    """Correct the rounding of the energy of a ball that has lost none: otherwise it adds up, impact by impact.

    ``energy`` is twice the energy per mass that it has had since its last loss, kinetic and potential.
    """
    now = _kinetic(ball)
    rest = energy + 2 * dot(vector(world.force), vector(ball.x))
    ball.energy = energy
    c = (rest - now) / (2 * now) if now > 0 else 0 * now
    # (more is not rounding)
    if LEAST_ROUNDING < abs(c) < MOST_ROUNDING:
        v, w = vector(ball.v), vector(ball.w)
        write_vector(ball.v, (v[0] + c * v[0], v[1] + c * v[1], v[2] + c * v[2]))
        write_vector(ball.w, (w[0] + c * w[0], w[1] + c * w[1], w[2] + c * w[2]))


@kernel
def _collide_at_wall(world: Any, features: Any, balls: Any, i: int, who: int, n: Vec, v: Vec, approach: float) -> int:
    """Resolve what overlaps with the contact of ball i and a feature, which it would leave with v; return how many balls move."""
    if not (world.pair_modulus > 0 and overlaps_at_wall(world, features, balls, i, who, n, v, approach)):
        return 0
    count = collide_cluster(world, features, balls, i, i, who)
    leave_cluster(world, balls, count)
    return count


@kernel
def _note_depth(f: Any, ball: Any, who: int) -> None:
    """Note how deep a ball has turned in feature ``who``, if that yields: what drives it back before it is out finds it there."""
    if f.yield_time > 0:
        ball.turned_in, ball.turned_at = who + 1, feature_gap(f, ball.radius, vector(ball.x))


@kernel
def _with_kick(j: Vec, kick: Vec, m: float) -> Vec:
    """Return an impulse per mass with that of the bounce that follows; unchanged to the last bit, and sign, if there is none."""
    if kick[0] == 0 and kick[1] == 0 and kick[2] == 0:
        return j
    return (j[0] + kick[0] / m, j[1] + kick[1] / m, j[2] + kick[2] / m)


@kernel
def meet_wall(world: Any, features: Any, balls: Any, i: int, who: int, users: Any) -> Outcome:
    """Resolve the impact of ball i on feature ``who`` by the law of its wall."""
    f, ball = features[who], balls[i]
    a, kappa, mu, beta, law = ball.radius, ball.kappa, f.mu, f.beta, f.law
    v, w = vector(ball.v), vector(ball.w)
    n = impact_normal(f, a, vector(ball.x), v)
    approach = -dot(v, n)
    pushed = is_driven_into_wall(world, f, ball, n, approach)
    e = 1.0 if pushed else restitution(f.form, vector(f.e), max(approach, 0.0))
    _note_depth(f, ball, who)
    on_floor = is_on_floor(world, ball)
    energy = ball.energy
    if math.isnan(energy) or not keeps_energy(world, ball):
        energy = _kinetic(ball) - 2 * dot(vector(world.force), vector(ball.x))
    ball.energy = math.nan
    _j, jf, required, regime, refusal, _many = without_impulse()
    if law == CONTACT_WALL or (law == TWO_STEP_WALL and not on_floor):
        v1, w1, j, required, regime = one_contact(v, w, n, a, kappa, e, mu, beta)
    elif law == ROLLING_WALL:
        _un, u = slip_velocity(v, w, UP, a)
        speed = math.sqrt(dot(v, v)) + a * math.sqrt(dot(w, w))
        if not on_floor or abs(n[2]) > ROUNDING or math.sqrt(dot(u, u)) > 1e-9 * speed:
            refusal = REFUSED_ROLLING
        v1, w1 = conventional_reflection(v, w, n, a, kappa)
        j = (v1[0] - v[0], v1[1] - v[1], v1[2] - v[2])
    elif law == NO_SLIP_WALL:
        # as carom.laws.no_slip and carom.laws.mirror have them: members of the one contact's family
        v1, w1, j, required, _regime = one_contact(v, w, n, a, kappa, 1.0, math.inf, 1.0)
    elif law == MIRROR_WALL:
        v1, w1, j, _required, _regime = one_contact(v, w, n, a, kappa, e, 0.0, 0.0)
    elif law >= CALLED_WALL:
        v1, w1 = call_user(users[law - CALLED_WALL], v, w, n, a, kappa, e, mu, beta)
        j = (v1[0] - v[0], v1[1] - v[1], v1[2] - v[2])
    else:  # (last, as the compiler takes them in this order, and another process is at work on this one)
        ef = restitution(world.floor_form, vector(world.floor_p), 0.0)
        v1, w1, j, jf, required, regime, _way = joint_impact(
            v, w, n, a, kappa, e, mu, beta, ef, world.floor_mu, world.floor_beta, world.together != 0
        )
        if regime == STALL:
            refusal = REFUSED_STALL
        elif regime == UNDEFINED:
            refusal = REFUSED_UNDEFINED
    many = 0 if pushed or refusal != DONE else _collide_at_wall(world, features, balls, i, who, n, v1, approach)
    if many > 0:
        none = (0 * approach, 0 * approach, 0 * approach)
        return none, none, 0 * approach, NO_REGIME, DONE, many
    if refusal == DONE:
        leave(world, ball, v1, w1, on_floor)
        j = _with_kick(j, continue_wall_contact(world, f, ball, n, approach, law == ROLLING_WALL), ball.mass)
        # two-step keeps it where friction does not act, or turns all of the slip round
        one = law == CONTACT_WALL or (law == TWO_STEP_WALL and not on_floor)
        elastic = e == 1 and (law == MIRROR_WALL or (one and (mu == 0 or beta == -1)))
        rough = one and e == 1 and beta == 1 and regime == STICK
        if (elastic or rough or law in (NO_SLIP_WALL, ROLLING_WALL)) and keeps_energy(world, ball):
            _restore(world, ball, energy)
    m = ball.mass
    return (m * j[0], m * j[1], m * j[2]), (m * jf[0], m * jf[1], m * jf[2]), required, regime, refusal, many


def wall_normal(features: Any, row: Any, radius: float) -> Any:
    """Return the normal of the wall where the ball meets it: of its nearest feature."""
    x = tuple(row["x"].tolist())
    own = [f for f in features if f.wall == row["other"] and f.kind != OVER]
    nearest = min(own, key=lambda f: abs(gap_to_feature(f, radius, x)))
    return feature_normal(nearest, x)


def _angle(v: Any, n: Any, above: bool) -> float | None:
    """Return the angle between a velocity and a normal, degrees; on a table as seen from above. None for no velocity."""
    n, v = np.array(n), np.array(v)
    if above and abs(n[2]) < 0.9 and (v[:2] != 0).any():
        n[2] = v[2] = 0.0
    size = speed(n) * speed(v)
    return math.degrees(math.acos(max(-1.0, min(1.0, float(n @ v) / size)))) if size > 0 else None


def cushion_side(run: RunRecord, features: Any, row: Any) -> str:
    """Return which cushion of a table a ball meets, seen from above with x to the right; empty for jaws, and for other walls."""
    if run.scene.walls[row["other"]].kind not in ("table", "box"):
        return ""
    n = wall_normal(features, row, run.scene.balls[row["ball"]].radius)
    sides = {"left": n[0], "right": -n[0], "bottom": n[1], "top": -n[1]}
    side = max(sides, key=lambda name: sides[name])
    return side if sides[side] > 0.7 * speed(np.array(n)) and min(abs(n[0]), abs(n[1])) < 1e-9 else ""


def sentence(run: RunRecord, features: Any, row: Any) -> str:
    """Return the words for an impact on a wall: angle of incidence, sticking or sliding, speed and angle afterwards."""
    wall = int(row["other"])
    n = wall_normal(features, row, run.scene.balls[row["ball"]].radius)
    table = run.scene.floor is not None
    came, went = _angle(-row["v_before"], n, table), _angle(row["v"], n, table)
    side = cushion_side(run, features, row)
    text = f"{at(row)} it meets {run.scene.wall_names[wall]}{f' ({side})' if side else ''}"
    text += "" if came is None else f", {came:.0f}° from its normal"
    response = int(next(f.law for f in features if f.wall == wall))
    friction = response in (TWO_STEP_WALL, CONTACT_WALL) and dot(n, tuple(row["impulse"])) != 0
    text += REGIME_PHRASES.get(int(row["regime"]), "") if friction else ""
    if row["phase"] in (HELD, REST, PIVOTING) or went is None:
        return text
    return f"{text}{',' if friction else ''} and leaves at {format_number(speed(row['v']))} m/s, {went:.0f}° from it"


WALL_CONTACT = ContactKind(WALL, meet_wall, WALL, "wall", sentence=sentence, refusals=REFUSALS)
