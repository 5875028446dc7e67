"""Laws that can be fitted: their contact model, free and fixed parameters, and how the engine simulates them.

They are made from the descriptors in carom.laws; a :class:`FittedLaw` holds everything that fits need to know about a law.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np

from carom.core.contact import slip_velocity, wall_contact
from carom.core.jit.kernel import Vec, dot, kernel
from carom.core.motion.phases import ROUNDING, UP, restitution, rolls_at_last
from carom.data.rebounds import Kind
from carom.errors import CaromError, Fault, did_you_mean
from carom.laws.arrays import WallKernel
from carom.laws.callbacks import call_user, user_address
from carom.laws.conventional import conventional_reflection
from carom.laws.law import CALLED_WALL, MIRROR_WALL, ROLLING_WALL, TWO_STEP_WALL, FitSpec, Law
from carom.laws.registry import laws
from carom.laws.two_step import UNDEFINED, first_impact
from carom.laws.wall_and_floor.solver import STALL

LEAST_RESTITUTION = 0.05  # of a start


def viscous_loss(restitution: Any) -> Any:
    """Return c of a viscoelastic ball, 1/e = 1 + c + 2/5 c^2 with c proportional to v^(1/5); 0 where e is 1 or more."""
    return (np.sqrt(1 + 1.6 * np.maximum(1 / np.maximum(restitution, LEAST_RESTITUTION) - 1, 0.0)) - 1) / 0.8


@dataclass(frozen=True)
class Parameter:
    """One parameter of a law, the ball or the table: as described below, or as :func:`carom.fitting.rows.decided` sets it."""

    name: str
    low: float
    high: float
    """Bounds of the fit."""
    tried: tuple[float, ...]
    """Starting values of the search."""
    value: float
    """Where it is not fitted, its value; in a fit of whole tracks also where the search begins."""
    unit: str = ""
    meaning: str = ""
    free: bool = False
    """Whether it is fitted."""
    origin: str = ""
    """Who says whether it is fitted, and its value if not: "law", "setting" (ball, table, or the user), or nobody (the default)."""

    @property
    def starts(self) -> tuple[float, ...]:
        """Starting values within the bounds."""
        return tuple(value for value in self.tried if self.low <= value <= self.high) or ((self.low + self.high) / 2,)


PARAMETERS = (
    Parameter("restitution", 0.0, 1.0, (0.4, 0.6, 0.75, 0.85, 0.95), 1.0, meaning="normal, at the speed of the impact"),
    Parameter("restitution_1", 0.0, 10.0, (0.1,), 0.0, meaning="second coefficient of the restitution's form"),
    Parameter("restitution_2", 0.0, 10.0, (0.25,), 0.0, meaning="third coefficient of the restitution's form"),
    Parameter("friction", 0.0, 5.0, (0.03, 0.06, 0.1, 0.15, 0.2, 0.3, 0.5, 0.9, 1.8), 0.0, meaning="Coulomb, at the wall"),
    Parameter("tangential_restitution", -1.0, 1.0, (-0.5, 0.0, 0.5, 0.9), 0.0, meaning="reversed fraction of the slip"),
    Parameter("kappa", 0.05, 1.0, (0.4, 0.65), 0.4, meaning="moment of inertia over m a^2"),
    Parameter("stiffness_ratio", 0.3, 2.5, (0.5, 0.82, 1.2, 1.8), 14 / 17, meaning="tangential over normal stiffness"),
    Parameter("contact_height", 1.0, 1.6, (1.05, 1.2, 1.4), 1.0, "a", "where the wall touches, above the floor"),
    Parameter("floor_friction", 0.0, 2.0, (0.1, 0.2, 0.4), 0.2, meaning="of the floor, while the wall presses on it"),
    Parameter("floor_restitution", 0.0, 1.0, (0.0, 0.5), 0.0, meaning="of the floor"),
    Parameter("spin_width", 1e-3, 3.0, (0.2, 0.6), 1.25, "v/a", "standard deviation of the unmeasured spins"),
    Parameter("roll", 0.0, 1.0, (0.5,), 1.0, meaning="fraction of rolling before the wall"),
    Parameter("spin_mean", -2.0, 2.0, (0.0, 0.5), 0.0, "v_t/a", "mean of the unmeasured spins: 1 is no slip"),
    Parameter("friction_1", -5.0, 5.0, (0.0,), 0.0, meaning="second number of the friction's form"),
    Parameter("friction_2", 0.0, 100.0, (1.0,), 1.0, meaning="third number of the friction's form"),
    Parameter("last_1", -5.0, 5.0, (0.0,), 0.0, meaning="second number of the form of tangential restitution or stiffness ratio"),
    Parameter("last_2", 0.0, 100.0, (1.0,), 1.0, meaning="third number of that form"),
)  # fmt: skip
INDEX = {parameter.name: i for i, parameter in enumerate(PARAMETERS)}
NUMBERS = len(PARAMETERS)
# All parameters of a law as one record: the same memory as an array of NUMBERS floats in the order of PARAMETERS.
LAW_NUMBERS = np.dtype([(parameter.name, "f8") for parameter in PARAMETERS])

# The places in the record of the numbers of a form: the parameter's own, then two more
PLACES = {
    name: (INDEX[name], INDEX[f"{more}_1"], INDEX[f"{more}_2"])
    for name, more in (("restitution", "restitution"), ("friction", "friction"), ("tangential_restitution", "last"),
                       ("stiffness_ratio", "last"))
}  # fmt: skip

# In addition to the forms of carom.core.motion.phases: v_out = slope v + offset, a straight line through measured speeds.
LINE = 5


@dataclass(frozen=True)
class Form:
    """A form of the restitution as a function of speed: its code and its parameters, in the places of restitution, _1 and _2.

    A parameter is called as the field of the form in a scene, after ``restitution_``.
    """

    code: int
    parameters: tuple[Parameter, ...]
    formula: str
    shape: str = ""
    """Of a form along the wall: linear or exponential,"""
    variable: str = ""
    """in one of VARIABLES."""

    def like(self, constant: float, speed: float) -> tuple[float, float, float]:
        """Return the three numbers with which the form has about this value at a speed, and near it."""
        if any(one.name.endswith("_at_speed") for one in self.parameters):
            return constant, constant, 1.0
        if [one.name for one in self.parameters] == ["restitution_c"]:
            return float(viscous_loss(constant)) / speed**0.2, 0.0, 0.0
        if "restitution_exponent" in [one.name for one in self.parameters]:
            return constant, speed, 0.0
        return constant, 0.0, 0.0

    def for_scene(self, name: str, values: Sequence[float]) -> float | dict[str, Any] | None:
        """Return the ``restitution`` of a wall in a scene, for the values of the parameters; None for a line, which scenes lack."""
        if name == "line":
            return None
        return values[0] if name == "constant" else self.table(name, values)

    def table(self, name: str, values: Sequence[float]) -> dict[str, Any]:
        """Return the form with its fields, as a table of a scene has them."""
        values = values[: len(self.parameters)]
        if name in ("polynomial", "linear"):
            return {"form": name, "coefficients": list(values)}
        fields = (
            re.sub("^(restitution|friction|tangential_restitution|stiffness_ratio)_", "", one.name)
            for one in self.parameters
        )
        return {"form": name, **dict(zip(fields, values, strict=True))}


def _e(name: str, low: float, high: float, *tried: float) -> Parameter:
    return Parameter(name, low, high, tried, tried[0])


FORMS = {
    "constant": Form(0, (PARAMETERS[0],), "e"),
    "line": Form(
        LINE,
        (_e("restitution_slope", 0.0, 1.0, 0.6, 0.8, 0.95), Parameter("restitution_offset", -1.0, 1.0, (0.0,), 0.0, "m/s")),
        "e = slope + offset / v_n, above 1 where the line is",
    ),
    "polynomial": Form(
        1,
        (
            _e("restitution_0", 0.0, 1.0, 0.5, 0.8, 0.95),
            # (from each side of zero: a rise that ends, a fall that ends and a fall that does not are separate valleys)
            _e("restitution_1", -2.0, 2.0, -0.1, 0.1),
            _e("restitution_2", -1.0, 1.0, -0.02, 0.02),
        ),
        "e = r0 + r1 v_n + r2 v_n^2, constant beyond its vertex (Han 2005, eq. 26)",
    ),
    "power": Form(
        2,
        (
            _e("restitution_at_rest", 0.0, 1.0, 0.6, 0.8, 0.95),
            Parameter("restitution_speed", 0.01, 100.0, (0.5, 2.0), 1.0, "m/s"),
            _e("restitution_exponent", 0.0, 2.0, 0.1, 0.25),
        ),
        "e = at_rest (v_n / speed)^-exponent, at_rest below the speed (Johnson 1985, 11.5)",
    ),
    "viscoelastic": Form(
        3,
        (_e("restitution_c", 0.0, 5.0, 0.05, 0.15, 0.3, 0.6),),
        "e = 1 / (1 + c + 2/5 c^2), c = restitution_c v_n^(1/5) (Ramirez et al. 1999)",
    ),
    "exponential": Form(
        4,
        (
            _e("restitution_at_rest", 0.0, 1.0, 0.9, 0.98),
            _e("restitution_at_speed", 0.0, 1.0, 0.5, 0.7),
            Parameter("restitution_speed", 0.01, 100.0, (0.5, 2.0), 1.0, "m/s"),
        ),
        "e = at_speed + (at_rest - at_speed) exp(-v_n / speed)",
    ),
}  # fmt: skip

# Of the impact, on which friction, tangential restitution and stiffness ratio may depend; each with its unit
VARIABLES = {"v_n": "m/s", "slip": "m/s", "slip/v_n": "", "speed": "m/s"}
SHAPES = ("constant", "linear", "exponential")
_USUAL = {"friction": "slip", "tangential_restitution": "slip/v_n", "stiffness_ratio": "slip/v_n"}
_TRIED = {
    "friction": (0.06, 0.15, 0.3, 0.9),
    "tangential_restitution": (-0.5, 0.0, 0.5),
    "stiffness_ratio": (0.5, 0.82, 1.8),
}
RESTITUTION_FORMS, ALONG_FORMS = 8, 4 * len(VARIABLES)  # numbers of codes of the forms, of each parameter


def _forms_along(parameter: str) -> dict[str, Form]:
    """Return the forms of friction, tangential restitution or stiffness ratio by their names: "linear:slip", shape and variable.

    The variable may be omitted: slip for the friction, slip/v_n for the others.
    """
    one = PARAMETERS[INDEX[parameter]]
    tried, size, found = (
        _TRIED[parameter],
        2.0 if parameter == "friction" else 5.0,
        {"constant": Form(0, (one,), parameter)},
    )
    for v, variable in enumerate(VARIABLES):
        first = Parameter(f"{parameter}_0", one.low, one.high, tried, tried[0])
        slope = Parameter(f"{parameter}_1", -size, size, (-0.05, 0.0, 0.05), 0.0, "s/m" if VARIABLES[variable] else "")
        formula = f"{parameter}_0 + {parameter}_1 {variable}, within its bounds"
        linear = Form(4 * v + 1, (first, slope), formula, "linear", variable)
        ends = (Parameter(f"{parameter}_{end}", one.low, one.high, tried, tried[0]) for end in ("at_rest", "at_speed"))
        reach = Parameter(f"{parameter}_speed", 0.01, 100.0, (1.0,), 1.0, VARIABLES[variable])
        formula = f"at_speed + (at_rest - at_speed) exp(-{variable} / {parameter}_speed)"
        exponential = Form(4 * v + 2, (*ends, reach), formula, "exponential", variable)
        found |= {f"linear:{variable}": linear, f"exponential:{variable}": exponential}
    return found | {shape: found[f"{shape}:{_USUAL[parameter]}"] for shape in SHAPES[1:]}


ALONG = {parameter: _forms_along(parameter) for parameter in _USUAL}
"""Forms of the parameters along the wall, by parameter and name."""


# ----------------------------------------------------------------------------------------------------
# Predictions of the laws for a rebound: kernels that map (v_n, v_t, spin) before the wall to the same after it.
#
# The wall is x = 0 with the ball at x > 0; v_n is positive toward the wall before and away from it after, v_t runs along
# it (y), spin is about z. A ball on a table rolls before the contact, or has a fraction ``roll`` of rolling. ``p`` is a record of
# :data:`carom.fitting.laws.LAW_NUMBERS`.


# Contact models that are compiled in. SMOOTH: wall and floor without friction; TURN: the wall and then the floor; TOGETHER: both
# at once. Any other code is the address of a law's kernel (carom.laws.callbacks); with a minus sign where the last number that
# the kernel takes is the stiffness ratio in place of the tangential restitution.
CONTACT, SMOOTH, CONVENTIONAL, TURN, TOGETHER = range(5)
TABULATED = 5  # both at once, from a table (carom.fitting.model)
LEAST_STIFFNESS = 0.1  # of a stiffness ratio that depends on the impact
# Stages at which the outgoing ball was measured
AFTER_WALL, ROLLING = 0, 1
DIRECTION = 2  # in place of a stage: v_t in units of the speed after, where only that was measured


@kernel
def speed_restitution(form: int, p: Vec, speed: float) -> float:
    """Return e at a speed of approach: a form of :mod:`carom.core.motion.phases`, or the line v_out = p0 v + p1."""
    if form == LINE:
        e = p[0] + p[1] / speed
        return max(e, 0 * e)  # above 1 at speeds below offset / (1 - slope)
    return restitution(form, p, speed)


@kernel
def of_impact(code: int, p: Vec, v: Vec, w: Vec, n: Vec, a: float) -> float:
    """Return a parameter along the wall: constant, or by its form (:data:`carom.fitting.laws.ALONG`)."""
    if code == 0:
        return p[0]
    un, ut = slip_velocity(v, w, n, a)
    slip, variable = math.sqrt(dot(ut, ut)), code // 4
    s = -un if variable == 0 else slip if variable == 1 else slip / -un if variable == 2 else math.sqrt(dot(v, v))
    return p[0] + p[1] * s if code % 4 == 1 else p[1] + (p[0] - p[1]) * math.exp(-s / p[2])


@kernel
def _along_wall(code: int, form: int, p: Any, v: Vec, w: Vec, n: Vec, a: float) -> tuple[float, float]:
    """Return the friction at an impact, and the last number of the law: tangential restitution or stiffness ratio."""
    stiff = code < 0
    last = p.stiffness_ratio if stiff else p.tangential_restitution
    mu = p.friction
    along = form // RESTITUTION_FORMS
    if along > 0:
        zero = 0 * a
        mu = max(of_impact(along % ALONG_FORMS, (mu, p.friction_1, p.friction_2), v, w, n, a), zero)
        last = of_impact(along // ALONG_FORMS, (last, p.last_1, p.last_2), v, w, n, a)
        last = max(last, zero + LEAST_STIFFNESS) if stiff else min(max(last, zero - 1), zero + 1)
    return mu, last


@kernel
def planar_rebound(code: int, form: int, stage: int, x: Vec, a: float, p: Any) -> Vec:
    """Return v_n, v_t and spin of a planar bounce after the wall; v_t in units of the speed where only the angle was measured."""
    zero = 0 * x[0]
    e = speed_restitution(form % RESTITUTION_FORMS, (p.restitution, p.restitution_1, p.restitution_2), x[0])
    v, w, n = (-x[0], x[1], zero), (zero, zero, x[2]), (1 + zero, zero, zero)
    mu, last = _along_wall(code, form, p, v, w, n, a)
    if code < 0 or code > TOGETHER:
        v1, w1 = call_user(abs(code), v, w, n, a, p.kappa, e, mu, last)
    else:
        v1, w1, _j, _required, _regime = wall_contact(v, w, n, a, p.kappa, e, mu, last)
    if stage == DIRECTION:
        speed = math.sqrt(v1[0] * v1[0] + v1[1] * v1[1])
        return v1[0], v1[1] / speed if speed > 0 else zero, w1[2]
    return v1[0], v1[1], w1[2]


@kernel
def table_rebound(code: int, form: int, stage: int, x: Vec, a: float, p: Any) -> Vec:
    """Return v_n, v_t and vertical spin of a ball on a table, after the wall or once it rolls again; NaN: undefined."""
    zero = 0 * x[0]
    up = 1 - p.contact_height
    n = (math.sqrt(1 - up * up), zero, up)
    v = (-x[0], x[1], zero)
    # (18), times the fraction of rolling
    w = (-p.roll * x[1] / a, -p.roll * x[0] / a, x[2])
    if code == CONVENTIONAL:
        v1, w1 = conventional_reflection(v, (-x[1] / a, -x[0] / a, x[2]), (1 + zero, zero, zero), a, p.kappa)
        return v1[0], v1[1], w1[2]
    e = speed_restitution(form % RESTITUTION_FORMS, (p.restitution, p.restitution_1, p.restitution_2), x[0] * n[0])
    if code == SMOOTH:
        return e * x[0], x[1], x[2]
    mu, last = _along_wall(code, form, p, v, w, n, a)
    if code < 0 or code > TOGETHER:
        v1, w1 = call_user(abs(code), v, w, n, a, p.kappa, e, mu, last)
    else:
        v1, w1, _j, _jf, _required, regime = first_impact(
            v,
            w,
            n,
            a,
            p.kappa,
            e,
            mu,
            last,
            p.floor_restitution,
            p.floor_friction,
            zero,
            zero,
            code == TOGETHER,
        )
        if regime in (UNDEFINED, STALL):
            return math.nan, math.nan, math.nan
    if stage == ROLLING:
        # (39)
        v1, w1 = rolls_at_last(v1, w1, a, p.kappa)
    elif v1[2] < -ROUNDING * x[0]:  # pushed onto the floor: it bounces off the floor at once
        v1, w1, _j, _required, _regime = wall_contact(
            v1, w1, UP, a, p.kappa, p.floor_restitution, p.floor_friction, zero
        )
    return v1[0], v1[1], w1[2]


# A table of a law at some restitution, wall friction and floor friction: its head, these three first, then for each stage,
# direction and spin the velocities, and a times the spin, of a ball that came with speed 1; then the same of their derivatives in
# the three, one after the other.
TABLE_HEAD = 10
_DIRECTION, _DIRECTIONS, _SPIN, _SPINS, _STAGES = 3, 5, 6, 8, 9
PLANES = 4
DENSE = 0.6  # v/a: spins below this are evenly spaced, and in proportion to their size beyond


@kernel
def _lagrange_weights(t: float) -> tuple[float, float, float, float]:
    """Return Lagrange's weights of four values at 0, 1, 2 and 3."""
    a, b, c = t - 1, t - 2, t - 3
    return -a * b * c / 6, t * b * c / 2, -t * a * c / 2, t * a * b / 6


@kernel
def _between_four(known: Any, at: int, u: tuple[float, float, float, float]) -> Vec:
    """Return the sum of four entries of a table, from a place on, with their weights."""
    u0, u1, u2, u3 = u
    return (
        u0 * known[at] + u1 * known[at + 3] + u2 * known[at + 6] + u3 * known[at + 9],
        u0 * known[at + 1] + u1 * known[at + 4] + u2 * known[at + 7] + u3 * known[at + 10],
        u0 * known[at + 2] + u1 * known[at + 5] + u2 * known[at + 8] + u3 * known[at + 11],
    )


@kernel
def look_up(stage: int, x: Vec, a: float, p: Any, known: Any) -> Vec:
    """Return a table's prediction: cubic in direction and spin, linear in the difference of the parameters from the table's.

    What comes from the other side is mirrored. The law is homogeneous in the speeds.
    """
    side = 1 + 0 * x[0] if x[1] >= 0 else -1 + 0 * x[0]
    along = side * x[1]
    speed = math.sqrt(x[0] * x[0] + along * along)
    sigma = side * x[2] * a / speed / DENSE
    root = math.sqrt(sigma * sigma + 1)
    place = math.log(sigma + root) if sigma >= 0 else -math.log(root - sigma)
    directions, spins = int(known[_DIRECTIONS]), int(known[_SPINS])
    one = (along / (x[0] + along) - known[_DIRECTION]) * known[_DIRECTION + 1]
    two = (place - known[_SPIN]) * known[_SPIN + 1]
    i = min(max(int(one) - 1, 0), directions - 4)
    j = min(max(int(two) - 1, 0), spins - 4)
    w0, w1, w2, w3 = _lagrange_weights(one - i)
    u0, u1, u2, u3 = _lagrange_weights(two - j)
    first = (int(min(stage, known[_STAGES] - 1)) * directions + i) * spins + j
    size = int(known[_STAGES]) * directions * spins * 3
    at, row, u = TABLE_HEAD + 3 * first, 3 * spins, (u0, u1, u2, u3)
    f0 = f1 = f2 = 0 * speed
    for plane in range(PLANES):
        off = 1 + 0 * speed if plane == 0 else p.restitution - known[0] if plane == 1 else p.friction - known[1]
        off = p.floor_friction - known[2] if plane == 3 else off
        if off != 0:
            r0, r1 = _between_four(known, at, u), _between_four(known, at + row, u)
            r2, r3 = _between_four(known, at + 2 * row, u), _between_four(known, at + 3 * row, u)
            f0 += off * (w0 * r0[0] + w1 * r1[0] + w2 * r2[0] + w3 * r3[0])
            f1 += off * (w0 * r0[1] + w1 * r1[1] + w2 * r2[1] + w3 * r3[1])
            f2 += off * (w0 * r0[2] + w1 * r1[2] + w2 * r2[2] + w3 * r3[2])
        at += size
    return speed * f0, side * speed * f1, side * speed * f2 / a


@kernel
def planar_law(code: int, form: int, stage: int, x: Vec, a: float, p: Any, _known: Any) -> Vec:
    """Return :func:`planar_rebound`, which no table replaces."""
    return planar_rebound(code, form, stage, x, a, p)


@kernel
def table_law(code: int, form: int, stage: int, x: Vec, a: float, p: Any, known: Any) -> Vec:
    """Return :func:`table_rebound`, or what a table of it says."""
    if code == TABULATED:
        return look_up(stage, x, a, p, known)
    return table_rebound(code, form, stage, x, a, p)


# ----------------------------------------------------------------------------------------------------
# Laws that can be fitted: their contact model, free and fixed parameters, and how the engine simulates them.


@dataclass(frozen=True)
class TrackEngine:
    """How :func:`carom.simulate` evaluates a law when whole tracks are fitted."""

    law: str = "two-step"
    floor_contact: Literal["with", "after"] = "after"
    surface: bool = True
    """Whether the law reads restitution and friction of the wall."""
    rolling_only: bool = False
    """Whether the law requires balls that roll before the wall."""


@dataclass(frozen=True)
class FittedLaw:
    """A law in the form in which it is fitted to one kind of rebound.

    Examples
    --------
    >>> from carom.fitting import FITTED
    >>> [law.name for law in FITTED if law.kind == "planar"]
    ['mirror', 'no-slip', 'sticking', 'sliding', 'maw', 'stronge', 'contact']
    """

    name: str
    kind: Kind
    code: int
    """Code of the contact model (:mod:`carom.fitting.laws`); -1: the one of its ``kernel``."""
    free: tuple[str, ...]
    words: str
    """Its name in a sentence."""
    pinned: dict[str, float] = field(default_factory=dict)
    """Parameters with values that define the law."""
    within: tuple[str, ...] = ()
    """Laws that contain it as a special case, exactly or nearly."""
    upright: bool = False
    """Whether the wall always touches at the height of the centre."""
    engine: TrackEngine | None = None
    """None: the law is not fitted to whole tracks."""
    search_code: int | None = None
    """Cheaper contact model with which the search begins."""
    chi_range: tuple[float, float] | None = None
    """Range of stiffness_ratio (1 + 1/kappa)/2 over which the law is tabulated."""

    on_request: bool = False
    """Whether the law is fitted only if it is named."""
    redundant_upright: bool = False
    """Whether it equals another law if the wall touches at the height of the centre."""
    kernel: WallKernel | None = None
    """Kernel of a law that is not compiled in."""
    stiffness_last: bool = False
    """Whether the last argument of the kernel is the stiffness ratio."""

    @property
    def contact_code(self) -> int:
        """Code for the compiled loops: the contact model, or the address of the law's kernel, negative with stiffness_last."""
        if self.kernel is None:
            return self.code
        return -user_address(self.kernel) if self.stiffness_last else user_address(self.kernel)

    @property
    def called(self) -> str:
        """Name of the law in a sentence, with that on the command line if it differs."""
        return self.words if self.name in self.words.lower() else f"{self.words} ({self.name})"

    @property
    def frictionless(self) -> bool:
        """Whether the wall exerts no tangential force."""
        return self.pinned.get("friction") == 0

    @property
    def feels_floor(self) -> bool:
        """Whether friction and restitution of the floor matter."""
        return self.kind == "table" and self.code not in (SMOOTH, CONVENTIONAL)


def _spec(law: Law, spec: FitSpec) -> FittedLaw:
    """Return how a law of carom.LAWS is fitted to one kind of rebound."""
    free = law.free if spec.free is None else spec.free
    height = {"contact_height": 1.0} if spec.upright else {}
    pinned = {name: value for name, value in {**law.pinned, **spec.pinned, **height}.items() if name not in free}
    with_floor = spec.rolling_only or law.response in (TWO_STEP_WALL, ROLLING_WALL, CALLED_WALL)
    engine = TrackEngine(
        law.name if law.response in (ROLLING_WALL, CALLED_WALL) else "two-step", "with" if with_floor else "after",
        law.response != ROLLING_WALL, spec.rolling_only,
    )  # fmt: skip
    table = spec.kind == "table"
    return FittedLaw(
        law.name, spec.kind, _code(law, table), free, spec.phrase or law.name, pinned, spec.nested_in, spec.upright,
        engine if table else None, TURN if table and law.response == TWO_STEP_WALL else None, law.chi_range, spec.on_request,
        spec.redundant_upright, law.kernel if law.response == CALLED_WALL else None, law.last == "stiffness_ratio",
    )  # fmt: skip


def _code(law: Law, table: bool) -> int:
    """Return the contact model of a law; minus 1 for one that is not compiled in (see :attr:`FittedLaw.contact_code`)."""
    if law.response == CALLED_WALL:
        return -1
    on_table = {MIRROR_WALL: SMOOTH, ROLLING_WALL: CONVENTIONAL, TWO_STEP_WALL: TOGETHER}
    return on_table.get(law.response, TURN) if table else CONTACT


def _all_laws() -> tuple[FittedLaw, ...]:
    specs = [
        (law, spec) for law in laws().values() if law.kernel for spec in law.fits if not (spec.same_as or spec.absent)
    ]
    found = [_spec(law, spec) for law, spec in specs]
    # (planar first; of each kind the laws with fewer free parameters first)
    return tuple(sorted(found, key=lambda law: (law.kind, len(law.free))))


FITTED = _all_laws()
"""All laws that can be fitted, each for one kind of rebound."""
# Other names of laws, and why a law cannot be fitted
ALIASES = {
    (name, spec.kind): spec.same_as or law.name
    for law in laws().values() for spec in law.fits for name in (law.name, *law.aliases) if not spec.absent
}  # fmt: skip
ABSENT = {(law.name, spec.kind): spec.absent for law in laws().values() for spec in law.fits if spec.absent}


def laws_for(kind: Kind, upright: bool) -> list[FittedLaw]:
    """Return all laws for a kind of rebound, without duplicates if the wall touches at the height of the centre."""
    taking_part = [law for law in FITTED if law.kind == kind and not law.on_request]
    return [law for law in taking_part if not (upright and law.redundant_upright)]


def unknown_laws(names: Sequence[str], kind: Kind | None = None) -> list[Fault]:
    """Return the fault of each name that no law has, whatever the kind of rebound."""
    everything = sorted(
        {law.name for law in FITTED} | {name for name, _kind in ALIASES} | {name for name, _kind in ABSENT}
    )
    known = list(dict.fromkeys(law.name for law in FITTED if kind in (None, law.kind)))
    return [
        Fault("law", "", f"one of {', '.join(known)}", repr(name), did_you_mean(name, everything))
        for name in names
        if name not in everything
    ]


def laws_named(names: list[str] | None, kind: Kind, upright: bool) -> tuple[list[FittedLaw], list[str]]:
    """Return the named laws (all by default) and notes; CaromError with the nearest name for an unknown one."""
    if not names:
        others = [law.name for law in FITTED if law.kind == kind and law.on_request]
        said = f"laws that were not fitted, as they take long and are for comparison: {', '.join(others)}; name them in `laws`"
        return laws_for(kind, upright), [said] if others else []
    known = {law.name: law for law in FITTED if law.kind == kind}
    found: dict[str, FittedLaw] = {}
    notes, faults = [], unknown_laws(names, kind)
    for name in names:
        means = ALIASES.get((name, kind), name)
        if means in known:
            found[means] = known[means]
            if means != name:
                notes.append(f"{name}: for a {kind} rebound this is the law {means}")
        elif (name, kind) in ABSENT:
            notes.append(f"{name}: left out, {ABSENT[name, kind]}")
    if not found and not faults:
        faults.append(Fault("laws", "", f"one that applies to a {kind} rebound", "none", "; ".join(notes)))
    if faults:
        raise CaromError(*faults)
    return list(found.values()), notes


def track_laws_named(names: Sequence[str] | None, upright: bool) -> tuple[list[FittedLaw], list[str]]:
    """Return the named laws (all of :data:`FITTED` by default) for whole tracks, and notes."""
    chosen, notes = laws_named(list(names) if names else None, "table", upright)
    return [law for law in chosen if law.engine is not None], notes
