"""The functions that the explorer's module offers: entries of a few lines over the kernels that Python runs.

Each is described by the records and numbers that it takes; :mod:`carom.explorer.module` compiles them to WebAssembly.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

from carom.core.geometry.circles import NUMBERS as RIM_NUMBERS
from carom.core.geometry.circles import rim_entry
from carom.core.geometry.curve_arcs import NUMBERS as ARC_NUMBERS
from carom.core.geometry.curve_arcs import arc_entry
from carom.core.geometry.features import FEATURES, contact_normal, gap_to_feature
from carom.core.jit.compile import array_of
from carom.core.jit.kernel import Vec, dot, kernel, vector
from carom.core.motion.phases import BOUNCING, HELD, restitution
from carom.laws.callbacks import NUMBERS as LAW_NUMBERS
from carom.laws.callbacks import law_entry
from carom.laws.landing import second_impact
from carom.laws.law import Case, Conditions, Objections, Predicted, Rule, energy_of, size_of, slips_at_wall
from carom.laws.pair import YOUNG
from carom.laws.registry import laws
from carom.laws.two_step import first_impact
from carom.scene.ball import FallingFriction, SceneBall
from carom.scene.feature_builders import minus
from carom.scene.floor import Floor
from carom.scene.ruled import Ruled, floor_faults, gravity_faults, name_fault, pair_fault, stiffness_faults, wall_faults
from carom.scene.shapes import PAGE_SHAPES
from carom.scene.wall import ShapeKernels
from carom.simulation.loop import run
from carom.simulation.motion import begin_phase, is_in_air, move_by, set_to_row
from carom.simulation.records import BALLS, LOG, WORLD

PARTS: dict[str, type[Ruled]] = {"floor": Floor, "ball": SceneBall, "falling_friction": FallingFriction}
"""Parts of a scene with rules, beside walls."""


class ModuleFunction(NamedTuple):
    """A function of the module, and what it takes and returns, as for :func:`carom.core.jit.compile.signature`."""

    name: str
    function: Callable[..., Any]
    returns: Any
    arguments: tuple[Any, ...]
    numbers: int = 0
    """Number of the arguments of a function that is called by its address, beside the place that it writes to."""


def entries() -> list[ModuleFunction]:
    """Return all functions of the module."""
    world, features, balls, log, floats = map(array_of, (WORLD, FEATURES, BALLS, LOG, float))
    rows = array_of(float, 2)
    counts = (int, int, int, int, float, float)
    return [
        ModuleFunction("run", run_events, counts, (world, features, balls, log, float, float, int, array_of(int), int)),
        ModuleFunction("pieces", piece_rows, int, (world, balls, log, int, float, float, floats, rows)),
        ModuleFunction("judge", judge_row, None, (floats, floats)),
        ModuleFunction("gaps", gap_rows, None, (features, balls, array_of(float, 2))),
        ModuleFunction("meet", meet_row, None, (features, balls, floats)),
        ModuleFunction("restitution", restitution_row, None, (floats, floats)),
        ModuleFunction("first_impact", first_impact_row, None, (floats, floats)),
        ModuleFunction("second_impact", second_impact_row, None, (floats, floats)),
        *(_faults(f"part_{name}", part.fault_rules()) for name, part in PARTS.items()),
        ModuleFunction("faults_on_floor", faults_on_floor, int, (floats, rows, rows)),
        ModuleFunction("faults_at_walls", faults_at_walls, int, (floats, rows, rows, features, rows, rows)),
        *(one for name, shape in PAGE_SHAPES.items() for one in _of_shape(name, shape.kernels)),
        *_rules(),
        ModuleFunction("rim", rim_entry, None, (), RIM_NUMBERS),
        ModuleFunction("arc", arc_entry, None, (), ARC_NUMBERS),
        *(ModuleFunction(f"law_{law.name.replace('-', '_')}", law_entry(law.kernel), None, (), LAW_NUMBERS)
          for law in laws().values() if law.kernel is not None),
    ]  # fmt: skip


def _of_shape(name: str, kernels: ShapeKernels) -> list[ModuleFunction]:
    """Return the functions of a shape: its features, what it says of places, and its faults."""
    features, blocked, vertical, encloses, room, faults = kernels

    def write_features(p: Any, rows: Any) -> Any:
        return features(p, rows)

    def write_place(p: Any, x: Any, out: Any) -> None:
        out[0], out[1] = blocked(p, vector(x)), vertical(p, x[2])
        out[2], out[3] = encloses(p), room(p)

    floats, rows = array_of(float), array_of(float, 2)
    return [
        ModuleFunction(f"features_{name}", write_features, int, (floats, rows)),
        _faults(name, faults),
        ModuleFunction(f"place_{name}", write_place, None, (floats, floats, floats)),
    ]


def _faults(name: str, report: Callable[[Any, Any], int]) -> ModuleFunction:
    """Return the function that writes the faults of a part of a scene."""

    def write_faults(p: Any, rows: Any) -> Any:
        return report(p, rows)

    return ModuleFunction(f"faults_{name}", write_faults, int, (array_of(float), array_of(float, 2)))


def faults_on_floor(p: Any, balls: Any, out: Any) -> Any:
    """Write the faults of gravity, floor and balls on it; p: gravity (3), whether there is a floor, the first table's number.

    A row of balls is a :class:`carom.scene.ruled.BallRow`, and the ball's speed and mass.
    """
    floor = p[3] != 0
    row = gravity_faults((p[0], p[1], p[2]), floor, int(p[4]), 0, out)
    for i in range(len(balls)):
        row = floor_faults(i, balls[i, 2], balls[i, 3], balls[i, 4] != 0, floor, row, out)
    return row


def faults_at_walls(p: Any, balls: Any, walls: Any, features: Any, blocked: Any, out: Any) -> Any:
    """Write the faults of balls at walls and among each other; p: Young's modulus and E* of two balls (0: none).

    A row of walls: whether it is a plane, the room in it, the height of its noses (NaN: none). ``blocked`` (W, B).
    """
    least, most, fastest = 0, 0, 0
    for i in range(len(balls)):
        least = i if balls[i, 3] < balls[least, 3] else least
        most = i if balls[i, 3] > balls[most, 3] else most
        fastest = i if balls[i, 7] > balls[fastest, 7] else fastest
    row, end = 0, 0
    for k in range(len(walls)):
        first = end
        while end < len(features) and features[end].wall == k:
            end += 1
        row = wall_faults(
            k,
            walls[k, 0] != 0,
            walls[k, 1],
            walls[k, 2],
            least,
            most,
            balls,
            blocked[k],
            features,
            first,
            end,
            row,
            out,
        )
    for i in range(len(balls)):
        row = name_fault(i, balls, row, out)
    for k in range(len(balls)):
        for i in range(k + 1, len(balls)):
            row = pair_fault(i, k, balls, row, out)
    if p[1] > 0 and len(balls) > 1 and p[0] != YOUNG:
        row = stiffness_faults(p[0], p[1], balls[fastest, 7], balls[fastest, 8], balls[fastest, 3], row, out)
    return row


def rule_name(rule: Rule) -> str:
    """Return the name of the function of a condition or an objection."""
    return f"rule_{rule.kernel.__module__.rpartition('.')[2]}_{rule.kernel.__name__.strip('_')}"


def rules_of(asked: Conditions | Objections | Any) -> tuple[Rule, ...]:
    """Return the rules of a law's conditions or objections."""
    found: tuple[Rule, ...] = getattr(asked, "rules", ())
    return found


def _rules() -> list[ModuleFunction]:
    """Return the conditions and objections of all laws, each once."""
    found = {rule_name(rule): _of_case(rule.kernel) for law in laws().values() for rule in rules_of(law.conditions)}
    found |= {rule_name(rule): _of_outcome(rule.kernel) for law in laws().values() for rule in rules_of(law.objections)}
    floats = array_of(float)
    return [ModuleFunction(name, function, None, (floats, floats)) for name, function in found.items()]


@kernel
def _case(p: Any) -> Case:
    v, w, n = (p[0], p[1], p[2]), (p[3], p[4], p[5]), (p[6], p[7], p[8])
    return Case(v, w, n, p[9], p[10], p[11], p[12], p[13], p[14], p[15], p[16], p[17], p[18], p[19], p[20])


@kernel
def _outcome(p: Any) -> Predicted:
    return Predicted((p[21], p[22], p[23]), (p[24], p[25], p[26]), p[27], p[28], p[29])


def _of_case(check: Callable[..., Any]) -> Callable[..., None]:
    def rule(p: Any, out: Any) -> None:
        out[0], out[1], out[2] = check(_case(p))

    return rule


def _of_outcome(check: Callable[..., Any]) -> Callable[..., None]:
    def rule(p: Any, out: Any) -> None:
        out[0], out[1], out[2] = check(_case(p), _outcome(p))

    return rule


def run_events(
    worlds: Any, features: Any, balls: Any, log: Any, slow: float, until: float, most: int, users: Any, keep: int
) -> Any:
    """Run events: :func:`carom.simulation.loop.run`."""
    return run(worlds[0], features, balls, log, slow, until, most, users, keep)


def gap_rows(features: Any, balls: Any, gaps: Any) -> None:
    """Write the gap (B, F) between each ball and each feature: :func:`carom.core.geometry.features.gap_to_feature`."""
    for i in range(balls.shape[0]):
        for f in range(features.shape[0]):
            gaps[i, f] = gap_to_feature(features[f], balls[i].radius, vector(balls[i].x))


def meet_row(features: Any, balls: Any, out: Any) -> None:
    """Write the normal (3) at which the first ball meets the first feature, its speed of approach, and the restitution there."""
    f, ball = features[0], balls[0]
    v = vector(ball.v)
    n = contact_normal(f, vector(ball.x), v)
    approach = -(v[0] * n[0] + v[1] * n[1] + v[2] * n[2])
    out[0], out[1], out[2], out[3] = n[0], n[1], n[2], approach
    out[4] = restitution(f.form, vector(f.e), max(approach, 0.0))


def judge_row(p: Any, out: Any) -> None:
    """Write what is said of a motion after a wall; p: a case (:class:`carom.laws.law.Case`), v and w just after, and at last.

    Friction that the wall needs for the motion just after it, whether the ball slips before it, the angles before, just after and
    at last (degrees from the normal, along the floor; NaN at rest), and the share of the energy that is kept (NaN: there was none).
    """
    c = _case(p)
    v, v2, w2 = (p[21], p[22], p[23]), (p[27], p[28], p[29]), (p[30], p[31], p[32])
    j = minus(v, c.v)
    jn = dot(j, c.n)
    f = (j[0] - jn * c.n[0], j[1] - jn * c.n[1], j[2] - jn * c.n[2])
    out[0] = math.sqrt(dot(f, f)) / jn if jn > 0 else 0.0
    out[1] = slips_at_wall(c)
    size = size_of(c.v) + c.a * size_of(c.w)
    out[2], out[3], out[4] = _angle(c.n, c.v, -1.0, 0.0), _angle(c.n, v, 1.0, size), _angle(c.n, v2, 1.0, size)
    energy = energy_of(c.v, c.w, c)
    out[5] = energy_of(v2, w2, c) / energy if energy > 0 else math.nan


@kernel
def _angle(n: Vec, v: Vec, way: float, size: float) -> float:
    """Return the angle of a velocity from the normal; NaN if it is at rest up to rounding, or the normal is vertical."""
    flat = math.sqrt(n[0] * n[0] + n[1] * n[1])
    if not abs(v[0]) + abs(v[1]) > 1e-12 * size or flat == 0:
        return math.nan
    x, y = n[0] / flat, n[1] / flat
    return math.atan2(abs(x * v[1] - y * v[0]), way * (x * v[0] + y * v[1])) * 180 / math.pi


def restitution_row(p: Any, out: Any) -> None:
    """:func:`carom.core.motion.phases.restitution` of a form, its three numbers and a speed."""
    out[0] = restitution(int(p[0]), (p[1], p[2], p[3]), p[4])


def first_impact_row(p: Any, out: Any) -> None:
    """:func:`carom.laws.two_step.first_impact` of v, w, n (3 each), a, kappa, e, mu, beta, floor's e, mu, beta, height, together.

    Writes v, w, impulses of wall and floor per mass (3 each), the required friction and the regime.
    """
    v, w, j, jf, required, regime = first_impact(
        (p[0], p[1], p[2]), (p[3], p[4], p[5]), (p[6], p[7], p[8]), p[9], p[10], p[11], p[12], p[13], p[14], p[15], p[16],
        p[17], p[18] != 0,
    )  # fmt: skip
    out[0], out[1], out[2] = v
    out[3], out[4], out[5] = w
    out[6], out[7], out[8] = j
    out[9], out[10], out[11] = jf
    out[12], out[13] = required, regime


def second_impact_row(p: Any, out: Any) -> None:
    """:func:`carom.laws.landing.second_impact` of v, w, n (3 each), a, kappa, the floor's e, mu, beta, gravity, height.

    Writes flight (duration, height, distance), landing (v, w, impulse per mass; 3 each), required friction, regime, rolling state
    (v, w; 3 each) and the reason's code.
    """
    t, rise, far, v, w, j, required, regime, v3, w3, why = second_impact(
        (p[0], p[1], p[2]), (p[3], p[4], p[5]), (p[6], p[7], p[8]), p[9], p[10], p[11], p[12], p[13], p[14], p[15]
    )
    out[0], out[1], out[2] = t, rise, far
    out[3], out[4], out[5] = v
    out[6], out[7], out[8] = w
    out[9], out[10], out[11] = j
    out[12], out[13] = required, regime
    out[14], out[15], out[16] = v3
    out[17], out[18], out[19] = w3
    out[20] = why


# ----------------------------------------------------------------------------------------------------
# The motion of a ball between its events as pieces that a page draws: parabolas, with spins that change at a constant rate.


PIECE = 0.05  # s: a ball whose acceleration decays is drawn by parabolas so short, 1e-7 m from its path
IN_AIR_PIECE = 0.01  # s: so is one in air, 1e-5 m from its path
ZERO: Vec = (0.0, 0.0, 0.0)


def piece_rows(worlds: Any, balls: Any, log: Any, number: int, end: float, until: float, final: Any, out: Any) -> Any:
    """Write the pieces of ball ``number``, and its position, velocity and spin at the time ``until``; return the pieces' number.

    ``balls`` is a record of the ball to work in, ``end`` the end of its last motion (inf: nothing more happens).
    """
    world, ball = worlds[0], balls[0]
    count, last = 0, -1
    for i in range(log.shape[0]):
        if log[i].ball != number:
            continue
        if last >= 0:
            count = _put_motion(world, ball, log[last], log[i].t, False, count, out)
        last = i
    count = _put_motion(world, ball, log[last], end, True, count, out)
    _begin(world, ball, log[last])
    if ball.phase < HELD:
        move_by(world, ball, until - log[last].t, 0.0)
    for k in range(3):
        final[k], final[3 + k], final[6 + k] = ball.x[k], ball.v[k], ball.w[k]
    return count


@kernel
def _begin(world: Any, ball: Any, row: Any) -> None:
    """Bring the ball into the state of a row of the log."""
    set_to_row(ball, row)
    ball.clock = 0.0
    begin_phase(world, ball)


@kernel
def _put_motion(world: Any, ball: Any, row: Any, end: float, is_last: bool, i: int, out: Any) -> int:
    """Write the pieces from a row of the log to a time; return the number of the next one."""
    lasts = end - row.t
    if not lasts > 0 and not is_last:
        return i
    _begin(world, ball, row)
    x, w, turn = vector(row.x), vector(row.w), vector(ball.turn)
    if ball.phase >= HELD:
        return _put(row.t, lasts, x, ZERO, w, ZERO, ZERO, row.phase, i, out)
    if ball.phase == BOUNCING:
        # bounces too low to see, as the straight line from the first to the last
        v = ZERO
        if lasts > 0:
            move_by(world, ball, lasts, 0.0)
            v = ((ball.x[0] - x[0]) / lasts, (ball.x[1] - x[1]) / lasts, 0.0)
        return _put(row.t, lasts, x, v, w, ZERO, turn, row.phase, i, out)
    piece = IN_AIR_PIECE if is_in_air(ball) else PIECE
    parts = math.ceil(lasts / piece) if ball.decays != 0 and piece < lasts < math.inf else 1
    for k in range(parts):
        begin = k * piece
        if k > 0:
            _begin(world, ball, row)
            move_by(world, ball, begin, 0.0)
            begin_phase(world, ball)
        long = lasts - begin if k == parts - 1 else piece
        i = _put_until_spin_ends(
            row.t + begin,
            long,
            vector(ball.x),
            vector(ball.v),
            vector(ball.w),
            vector(ball.acc),
            vector(ball.turn),
            row.phase,
            i,
            out,
        )
    return i


@kernel
def _put_until_spin_ends(
    t: float, lasts: float, x: Vec, v: Vec, w: Vec, acc: Vec, turn: Vec, phase: int, i: int, out: Any
) -> int:
    """Write a piece; one in which the spin about the vertical fades to zero, where it stays, is two."""
    s = -w[2] / turn[2] if turn[2] != 0 else 0.0
    if not 0 < s < lasts:
        return _put(t, lasts, x, v, w, acc, turn, phase, i, out)
    i = _put(t, s, x, v, w, acc, turn, phase, i, out)
    half = s * s / 2
    x1 = (x[0] + v[0] * s + acc[0] * half, x[1] + v[1] * s + acc[1] * half, x[2] + v[2] * s + acc[2] * half)
    v1 = (v[0] + acc[0] * s, v[1] + acc[1] * s, v[2] + acc[2] * s)
    w1 = (w[0] + turn[0] * s, w[1] + turn[1] * s, 0.0)
    return _put(t + s, lasts - s, x1, v1, w1, acc, (turn[0], turn[1], 0.0), phase, i, out)


@kernel
def _put(t: float, lasts: float, x: Vec, v: Vec, w: Vec, acc: Vec, turn: Vec, phase: int, i: int, out: Any) -> int:
    """Write a piece; return the number of the next one."""
    if i < out.shape[0]:
        out[i, 0], out[i, 1], out[i, 17] = t, lasts, phase
        for k in range(3):
            out[i, 2 + k], out[i, 5 + k], out[i, 8 + k], out[i, 11 + k], out[i, 14 + k] = (
                x[k],
                v[k],
                w[k],
                acc[k],
                turn[k],
            )
    return i + 1
