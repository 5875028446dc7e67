"""The descriptor of a kind of contact, and what several kinds share: how a ball moves on after an impact."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.contact import NO_REGIME, SLIDE, STICK, friction_at_slip, one_contact, slip_velocity
from carom.core.geometry.features import GOES_ON, OVER, feature_gap, feature_normal, gap_to_feature, impact_normal
from carom.core.jit.compile import call_compiled, njit, signature
from carom.core.jit.kernel import Vec, dot, kernel, vector
from carom.core.motion.phases import (
    FLIGHT,
    HELD,
    LEFT,
    PIVOTING,
    POCKETED,
    REST,
    ROLLING,
    ROUNDING,
    UP,
    next_phase,
    restitution,
)
from carom.formatting import counted, format_length, format_number
from carom.laws.callbacks import call_user
from carom.laws.conventional import conventional_reflection
from carom.laws.law import CALLED_WALL, CONTACT_WALL, MIRROR_WALL, NO_SLIP_WALL, ROLLING_WALL, TWO_STEP_WALL
from carom.laws.pair import (
    contact_modulus,
    contact_time,
    pair_as_wall,
    pair_contact,
    pair_slip,
    stiffness,
    struck_as_wall,
)
from carom.laws.two_step import UNDEFINED, first_impact_and_way
from carom.laws.wall_and_floor.solver import JAM, STALL
from carom.scene.scene import Scene
from carom.simulation.cluster import collide_cluster, overlaps_at_wall, overlaps_in_time, place_all
from carom.simulation.motion import feels_air, is_on_floor, phase_on_floor, set_on_floor, write_vector
from carom.simulation.records import (
    BALL,
    FLOOR,
    HELD_EVENT,
    IN_CLUSTER,
    LEFT_EVENT,
    MEETINGS,
    NOTHING,
    PHASE,
    POCKETED_EVENT,
    SETTLED,
    WALL,
    RunRecord,
    at,
    direction,
    speed,
)
from carom.simulation.resting_contact import (
    continue_ball_contact,
    continue_wall_contact,
    is_calm,
    is_driven_into_wall,
    is_low_on_slope,
    is_pressed_on_ball,
    keep_on_floor,
    settle_along_wall,
    sum_bounces,
)

if TYPE_CHECKING:
    from carom.simulation.records import RunRecord

# How a contact may end: DONE, or as one of its refusals, where the law has no answer.
DONE = 0

# Impulses of what was met and of the floor, N s, required friction, regime, how it ended (DONE), and how many balls were touched
# where contacts overlap in time, else 0.
Outcome = tuple[Vec, Vec, float, int, int, int]
NO_IMPULSE = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class ContactKind:
    """A kind of contact: the kernel that resolves it, its place in the log, and its words."""

    code: int
    """As the loop and the log have it (carom.simulation.records)."""
    meet: Callable[..., Outcome]
    """``meet(world, features, balls, i, who, users)``: ball i, which is at the event, meets number ``who``: a feature or a ball."""
    met: int = NOTHING
    """Kind of the body whose number is the log's ``other``: WALL, BALL, POCKETED_EVENT, or NOTHING."""
    noun: str = ""
    """Name under which contacts are counted; empty where they are not."""
    clause: str = ""
    """Text that follows the noun."""
    sentence: Callable[[RunRecord, Any, Any], str] | None = None
    """``sentence(run, features, row)``: the words for a row of the log; None where it is part of another sentence."""
    last: bool = False
    """Whether nothing follows the sentence: the ball is followed no further."""
    refusals: Mapping[int, str] = field(default_factory=dict)
    """Codes of the events for which the law has no answer, with the reasons."""


@kernel
def without_impulse() -> Outcome:
    """Return the outcome of an event without an impulse."""
    return NO_IMPULSE, NO_IMPULSE, 0.0, NO_REGIME, DONE, 0


@kernel
def leave(world: Any, ball: Any, v: Vec, w: Vec, from_floor: bool) -> None:
    """Set velocity and spin after an impact, and the phase that follows: on the floor, or in flight."""
    ball.phase, ball.borne_by = FLIGHT, 0
    write_vector(ball.v, v)
    write_vector(ball.w, w)
    if from_floor:
        speed = math.sqrt(dot(v, v)) + ball.radius * math.sqrt(dot(w, w))
        if abs(v[2]) <= ROUNDING * speed:
            ball.x[2] = ball.radius
            set_on_floor(world, ball, v, w)


@kernel
def leave_cluster(world: Any, balls: Any, count: int) -> None:
    """Set velocities, spins and phases of the balls of a cluster (carom.simulation.cluster) after it."""
    for p in range(count):
        one = balls[balls[p].touched]
        leave(world, one, vector(one.cv), vector(one.cw), is_on_floor(world, one))


# ----------------------------------------------------------------------------------------------------
# The impact of two balls: by the law of the pair, or with all balls around where contacts overlap in time.


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
    pressed, driven, bend = is_pressed_on_ball(world, ball, other, n, approach)
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
    p = continue_ball_contact(world, ball, other, n, approach, bend)
    if p != 0:
        j = (j[0] + p * n[0], j[1] + p * n[1], j[2] + p * n[2])
    return j, NO_IMPULSE, required, regime, DONE, 0


def pair_sentence(run: RunRecord, features: Any, row: Any) -> str:
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


PAIR = ContactKind(BALL, meet_ball, BALL, "ball", sentence=pair_sentence)


# ----------------------------------------------------------------------------------------------------
# The landing of a ball on the floor: an impact, after which it flies, stays there, or bounces to the end.


@kernel
def meet_floor(world: Any, features: Any, balls: Any, i: int, who: int, users: Any) -> Outcome:
    """Resolve the landing of ball i."""
    ball = balls[i]
    v, w = vector(ball.v), vector(ball.w)
    e = restitution(world.floor_form, vector(world.floor_p), max(-v[2], 0.0))
    v1, w1, j, required, regime = one_contact(v, w, UP, ball.radius, ball.kappa, e, world.floor_mu, world.floor_beta)
    ball.x[2] = ball.radius
    leave(world, ball, v1, w1, True)
    if ball.phase == FLIGHT and world.g > 0 and e < 1 and sum_bounces(world, features, balls, i):
        leave(world, ball, (v1[0], v1[1], 0.0), w1, True)
    m = ball.mass
    return (m * j[0], m * j[1], m * j[2]), NO_IMPULSE, required, regime, DONE, 0


LANDING = ContactKind(FLOOR, meet_floor)


# ----------------------------------------------------------------------------------------------------
# A ball passes a gate: it falls into a pocket, or clears a low wall, behind which it is followed no further or goes on.


@kernel
def fall_into_pocket(world: Any, features: Any, balls: Any, i: int, who: int, users: Any) -> Outcome:
    """Catch ball i in the pocket whose edge is feature ``who``: its centre has passed the edge."""
    balls[i].phase = POCKETED
    return without_impulse()


@kernel
def clear_wall(world: Any, features: Any, balls: Any, i: int, who: int, users: Any) -> Outcome:
    """Let ball i pass over the wall that feature ``who`` continues upwards."""
    if features[who].ends != GOES_ON:
        balls[i].phase = LEFT
    return without_impulse()


def _falls(run: RunRecord, features: Any, row: Any) -> str:
    pocket = run.scene.pocket_names[row["other"]]
    return f"{at(row)} it falls into the {pocket} at {format_number(speed(row['v']))} m/s."


def _clears(run: RunRecord, features: Any, row: Any) -> str:
    return f"{at(row)} it clears {run.scene.wall_names[row['other']]}"


POCKET = ContactKind(POCKETED_EVENT, fall_into_pocket, POCKETED_EVENT, sentence=_falls, last=True)
CLEARANCE = ContactKind(LEFT_EVENT, clear_wall, WALL, "wall", " that it clears", _clears)


# ----------------------------------------------------------------------------------------------------
# A ball that is caught between things that send it to and fro without end is held there.


@kernel
def hold(world: Any, features: Any, balls: Any, i: int, who: int, users: Any) -> Outcome:
    """Hold ball i where it is, and the ball that it was to meet, if that has not moved either."""
    if balls[i].next_kind == BALL and balls[who].repeats > 0:
        balls[who].phase = HELD
    balls[i].phase = HELD
    return without_impulse()


def _is_held(run: RunRecord, features: Any, row: Any) -> str:
    return f"{at(row)} it is held where it is, pressed between what it touches, and is followed no further."


HOLDING = ContactKind(HELD_EVENT, hold, sentence=_is_held, last=True)


# ----------------------------------------------------------------------------------------------------
# The end of a phase: of sliding, rolling, spinning on the spot; and of infinitely many bounces, after which a ball has settled.


@kernel
def end_phase(world: Any, features: Any, balls: Any, i: int, who: int, users: Any) -> Outcome:
    """Begin the phase that follows the one of ball i."""
    ball = balls[i]
    if is_calm(world, ball):
        none = 0 * ball.radius
        ball.phase, ball.borne_by = REST, 0
        write_vector(ball.v, (none, none, none))
        write_vector(ball.w, (none, none, none))
        return without_impulse()
    if ball.borne_by != 0:
        # (it may lie where the friction of its spin has held it)
        ends = ball.borne_by < 0 or gap_to_feature(features[ball.borne_by - 1], ball.radius, vector(ball.x)) == math.inf
        settle_along_wall(world, ball)
        if ends:
            set_on_floor(world, ball, vector(ball.v), vector(ball.w))
        return without_impulse()
    phase, v, w = next_phase(ball.phase, vector(ball.v), vector(ball.w), ball.radius, ball.kappa)
    ball.phase = phase_on_floor(world, ball, phase, v, w)
    write_vector(ball.v, v)
    write_vector(ball.w, w)
    return without_impulse()


@kernel
def settle_on_floor(world: Any, features: Any, balls: Any, i: int, who: int, users: Any) -> Outcome:
    """Let ball i, whose bounces have ended, slide, roll or rest on the floor."""
    set_on_floor(world, balls[i], vector(balls[i].v), vector(balls[i].w))
    return without_impulse()


PHASE_END, SETTLING = ContactKind(PHASE, end_phase), ContactKind(SETTLED, settle_on_floor)


# ----------------------------------------------------------------------------------------------------
# The impact at wall and floor at once, compiled for the event loop as a function of its own.
#
# It is a third of all that has to be compiled.


def joint_impact(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float,
    floor_e: float, floor_mu: float, floor_beta: float, together: bool,
) -> tuple[Vec, Vec, Vec, Vec, float, int, int]:  # fmt: skip
    """A wall meets a ball that lies on the floor (carom.laws.two_step); compiled code calls :func:`compiled_joint_impact`."""
    return first_impact_and_way(v, w, n, a, kappa, e, mu, beta, floor_e, floor_mu, floor_beta, 0.0, together)


@functools.cache
def compiled_joint_impact() -> Callable[..., Any]:
    """:func:`joint_impact` compiled; from the second time on, loaded."""
    vector = (float, float, float)
    found = (vector, vector, vector, vector, float, int, int)
    return njit(joint_impact, signature(found, *[vector] * 3, *[float] * 8, bool), _nrt=False)


@functools.cache
def register_joint_impact() -> None:
    """Have compiled code call :func:`compiled_joint_impact` for :func:`joint_impact`."""
    call_compiled(joint_impact, compiled_joint_impact)


# ----------------------------------------------------------------------------------------------------
# The impact of a ball on a wall: by the wall's law, with wall and floor at once where the wall presses the ball down.


REFUSED_ROLLING, REFUSED_UNDEFINED, REFUSED_STALL, REFUSED_ON_FLOOR, REFUSED_ENDLESS = range(1, 6)
REFUSALS = {
    REFUSED_ROLLING: "the wall's law is for a ball that rolls into a vertical wall (carom laws conventional); this one slides or"
    " flies there; the law two-step takes any ball",
    REFUSED_UNDEFINED: "a wall with tangential restitution presses the ball on the floor, which has no law; take"
    " tangential_restitution = 0, or floor_contact = 'after'",
    REFUSED_STALL: "wall and floor lock the ball between them, which is not followed to its end; take a smaller friction,"
    " or floor_contact = 'after'",
    REFUSED_ON_FLOOR: "air lifts a ball from the floor along which it slides or rolls, or makes one slip that rolls, which is not"
    " followed; end the run before (run.duration), or leave out air",
    REFUSED_ENDLESS: "it moves on through the air and meets nothing; give run.duration",
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
    return bool((ball.phase == FLIGHT and not feels_air(world, ball)) or (rolls and ball.borne_by == 0))


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
def meet_wall(world: Any, features: Any, balls: Any, i: int, who: int, users: Any) -> Outcome:  # noqa: PLR0915
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
        v1 = keep_on_floor(world, ball, v1, on_floor and is_low_on_slope(world, ball, n, approach))
        leave(world, ball, v1, w1, on_floor)
        kick = continue_wall_contact(world, features, who, ball, n, approach, law == ROLLING_WALL)
        j = _with_kick(j, kick, ball.mass)
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


def wall_sentence(run: RunRecord, features: Any, row: Any) -> str:
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


WALL_CONTACT = ContactKind(WALL, meet_wall, WALL, "wall", sentence=wall_sentence, refusals=REFUSALS)


# ----------------------------------------------------------------------------------------------------
# The table of the kinds of contact, and what is made from it: the resolution of an event, and the names of what is met.


CONTACTS = {one.code: one for one in (WALL_CONTACT, LANDING, PAIR, PHASE_END, SETTLING, CLEARANCE, POCKET, HOLDING)}
ALL_REFUSALS = {code: text for one in CONTACTS.values() for code, text in one.refusals.items()}
# The names of all that ``other`` can be the number of, as a scene has them.
PARTNERS = {WALL: "wall_names", BALL: "ball_names", POCKETED_EVENT: "pocket_names"}


def partner_names(scene: Scene, met: int) -> tuple[str, ...] | None:
    """Return the names among which ``other`` of a row of the log is a number; None where ball and floor are alone."""
    return getattr(scene, PARTNERS[met]) if met in PARTNERS else None


@kernel
def met_at(kind: int) -> int:
    """Return the body that a ball meets at an event of a kind: ``met`` of its kind of contact."""
    if kind in (WALL, LEFT_EVENT):
        return WALL
    return kind if kind in (BALL, POCKETED_EVENT) else NOTHING


@kernel
def resolve_event(  # noqa: PLR0911
    kind: int, world: Any, features: Any, balls: Any, i: int, who: int, users: Any
) -> Outcome:
    """Resolve the event of ball i, which is at its place, with number ``who``: by ``meet`` of its kind of contact.

    (Compiled code cannot look a function up by a number; a test compares this, and ``met_at``, with the table.)
    """
    if kind == WALL:
        return meet_wall(world, features, balls, i, who, users)
    if kind == FLOOR:
        return meet_floor(world, features, balls, i, who, users)
    if kind == BALL:
        return meet_ball(world, features, balls, i, who, users)
    if kind == PHASE:
        return end_phase(world, features, balls, i, who, users)
    if kind == SETTLED:
        return settle_on_floor(world, features, balls, i, who, users)
    if kind == LEFT_EVENT:
        return clear_wall(world, features, balls, i, who, users)
    if kind == POCKETED_EVENT:
        return fall_into_pocket(world, features, balls, i, who, users)
    return hold(world, features, balls, i, who, users)


# ----------------------------------------------------------------------------------------------------
# Contacts of balls that overlap in time, where a run is to resolve one pair at a time: in racks, cradles, rows of balls.


Array = NDArray[np.float64]
APPROACHING = 1e-9  # of the speed of approach: slower balls do not approach
MOST_MEETINGS = 1000  # that are looked at, from the first on


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
    first = np.flatnonzero(_are_pairs(log))[:MOST_MEETINGS]
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
            touches = (gap <= reach) & (np.fmax(*closing) > APPROACHING * approach)
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
    >>> from carom.simulation.contact_kinds import overlap_note
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
    of = f"the first {MOST_MEETINGS:,}" if meetings > MOST_MEETINGS else counted(meetings, "meeting")
    return (
        f"contacts overlap in time at {len(found)} of {of}{' meetings' * (meetings > MOST_MEETINGS)} of balls (first at"
        f" {first.time:.4g} s: {pair}, with {names[first.third]} {gap}); the run resolves one pair at a time, so that speeds and"
        " directions of balls that touch or nearly touch, as in a rack, are not right"
    )
