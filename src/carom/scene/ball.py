"""A ball of a scene: its properties and its initial state."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Annotated, Any, ClassVar

import numpy as np
from pydantic import AfterValidator, BeforeValidator, PlainSerializer, PlainValidator, model_validator

from carom.bodies import INERTIAS, Ball, State
from carom.core.contact import friction_at_slip
from carom.core.jit.kernel import kernel
from carom.core.random import uniform
from carom.errors import MIN_MAGNITUDE, CaromError, Fault, did_you_mean, shortened_list, shown, suggestion
from carom.formatting import format_length
from carom.laws.law import Law
from carom.laws.pair import POISSON, YOUNG, contact_modulus
from carom.laws.strike import DEFAULT_CUE, Cue, Strike, strike
from carom.scene.air import Drag, Lift
from carom.scene.restitution import Bounce, Constant, FasterThanNothing
from carom.scene.ruled import FaultText, Ruled, least_young, put_fault
from carom.scene.schema import (
    Angle,
    Components,
    Count,
    CountOrZero,
    Flag,
    Friction,
    Gap,
    Length,
    Mass,
    Model,
    Modulus,
    NotNegative,
    Number,
    PoissonRatio,
    PositiveNumber,
    Share,
    Size,
    Speed,
    Spin,
    Spring,
    Vector,
    checked_part,
    raise_faults,
    refused,
)
from carom.scene.wall import ContactParameters, PairLawChoice, contact

KAPPA = Number("'solid', 'hollow', or kappa = I/(m a^2) in (0, 2/3]", least=0, most=2 / 3 * (1 + 1e-12), above=True)


def _inertia(value: Any) -> str | float:
    if not isinstance(value, str):
        return KAPPA(value)
    if value not in INERTIAS:
        raise refused(KAPPA.what, shown(value), suggestion(value, list(INERTIAS)))
    return value


Inertia = Annotated[str | float, BeforeValidator(_inertia)]


def _three(value: tuple[float, ...]) -> Vector:
    return (value[0], value[1], value[2] if len(value) == 3 else 0.0)


class SceneCue(Model):
    """A cue in a scene: the numbers of :class:`carom.Cue`."""

    mass: Mass = float(DEFAULT_CUE.mass)
    end_mass: Mass = float(DEFAULT_CUE.end_mass)
    friction: Friction = float(DEFAULT_CUE.friction)
    restitution: Share = float(DEFAULT_CUE.restitution)


def _on_the_ball(value: tuple[float, float]) -> tuple[float, float]:
    if not math.hypot(*value) < 1:
        raise refused(_OFFSET.what, shown(list(value)), "the tip would miss the ball")
    return value


_OFFSET = Components("2 numbers, to the player's right and up in radii, less than 1 from the centre", (2,))


_Radii = Annotated[float, BeforeValidator(Number("a number in radii of the ball, such as 0.3"))]


class CueStrike(Model):
    """How a cue strikes a ball that is at rest: the arguments of :func:`carom.strike`.

    Parameters
    ----------
    speed : m/s, > 0, of the cue
    azimuth : degrees, counterclockwise from +x as seen from above; default: 0
    elevation : degrees, 0 to 90: how far the butt is raised; default: 0
    offset : 2 numbers, in radii: to the player's right, and up; default: the centre
    cue : SceneCue; default: an ordinary one

    Examples
    --------
    >>> import carom
    >>> ball = carom.SceneBall(radius=0.03, mass=0.2, position=(1, 0), strike={"speed": 2, "azimuth": 90, "offset": [0.2, 0]})
    >>> [round(float(v), 3) for v in ball.state.velocity]
    [-0.032, 2.364, 0.0]
    """

    speed: Annotated[float, BeforeValidator(Number("a speed in m/s, > 0", "m/s", least=0, above=True))]
    azimuth: Angle = 0.0
    elevation: Annotated[float, BeforeValidator(Number("an angle in degrees, 0 to 90", "degree", least=0, most=90))] = (
        0.0
    )
    offset: Annotated[tuple[_Radii, _Radii], BeforeValidator(_OFFSET), AfterValidator(_on_the_ball)] = (
        0.0,
        0.0,
    )
    cue: SceneCue = SceneCue()

    def on(self, ball: Ball) -> Strike:
        """Return its effect on a ball."""
        return strike(ball, Cue(**dict(self.cue)), self.speed, self.azimuth, self.elevation, self.offset)


@kernel
def _ball_rules(p: Any, out: Any) -> int:
    """Report motions that exclude each other; p: rolling, velocity after its length, spin (NaN: none), spin_z."""
    count, i = int(p[1]), 0
    largest = 0.0
    for k in range(2, len(p)):
        largest = max(largest, abs(p[k]))
    if p[0] != 0 and p[2 + count] == p[2 + count]:
        i = put_fault(0, 0.0, 0.0, 0.0, i, out)
    if p[0] != 0 and count == 3 and p[4] != 0:
        i = put_fault(1, p[4], 0.0, 0.0, i, out)
    if p[0] == 0 and p[5 + count] == p[5 + count]:
        i = put_fault(2, 0.0, 0.0, 0.0, i, out)
    return put_fault(3, MIN_MAGNITUDE, largest, 0.0, i, out) if 0 < largest < MIN_MAGNITUDE else i


class SceneBall(Ruled):
    """A ball and its initial state.

    Parameters
    ----------
    radius, mass : m and kg
    inertia : "solid", "hollow", or kappa = I/(m a^2); default: "solid"
    position : 2 or 3 lengths, m: the centre; two: on the floor (z = radius), or in the plane z = 0 of a scene without a floor
    velocity : 2 or 3 speeds, m/s; default: at rest
    rolling : whether it rolls on the floor: its spin follows from its velocity, except for ``spin_z``
    spin : 3 numbers, rad/s: angular velocity of a ball that does not roll; default: none
    spin_z : rad/s: sidespin of a ball that rolls; default: 0
    strike : how a cue strikes it, in place of velocity and spin: speed, azimuth, elevation, offset, cue (:class:`CueStrike`)
    drag, lift : in a scene with air, C_D and C_L: numbers; names of laws (``carom laws``); or forms, {"form": "spin", "still": C,
        "per_spin": C}, {"form": "saturating", "slope": C, "saturation": C} or {"form": "table", "reynolds": [..], "values": [..]}
        (or "spin_ratio"). C_L is along spin x velocity relative to the air; default: none
    spin_decay : in air the spin w fades at the rate spin_decay |u| w / radius, u the velocity relative to it; default: 0
    name : its name in tables; default: its number

    Every number with a unit may also be a text such as "61.5 mm". Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> ball = carom.SceneBall(radius="30.75 mm", mass=0.21, position=(1.0, 0.5), velocity=(-2, 1), rolling=True)
    >>> [round(float(w), 3) for w in ball.state.spin]
    [-32.52, -65.041, 0.0]
    """

    rules: ClassVar = _ball_rules
    ruled: ClassVar = ("rolling", "velocity", "spin", "spin_z")
    fault_texts: ClassVar = (
        FaultText(
            "spin", "no spin with rolling = true", "{spin}",
            "the spin of a ball that rolls follows from its velocity, except for spin_z; leave out rolling, or spin",
        ),
        FaultText("velocity[2]", "no speed along z with rolling = true", "{a}"),
        FaultText("spin_z", "no spin_z without rolling = true", "{spin_z}", "give spin = [x, y, z]"),
        FaultText("velocity", "a ball at rest, or a component of velocity or spin of at least {a:g}", "{b}"),
    )  # fmt: skip

    radius: Size
    mass: Mass
    inertia: Inertia = "solid"
    position: Annotated[
        tuple[Length, ...], BeforeValidator(Components("2 or 3 lengths in m: x, y and z, of the centre", (2, 3)))
    ]
    velocity: Annotated[
        tuple[Speed, ...],
        BeforeValidator(Components("2 or 3 speeds in m/s: along x, y and z", (2, 3))),
        AfterValidator(_three),
    ] = (0.0, 0.0, 0.0)
    rolling: Flag = False
    spin: (
        Annotated[tuple[Spin, Spin, Spin], BeforeValidator(Components("3 spins in rad/s: about x, y and z", (3,)))]
        | None
    ) = None
    spin_z: Spin | None = None
    strike: CueStrike | None = None
    drag: Drag | None = None
    lift: Lift | None = None
    spin_decay: NotNegative = 0.0
    name: str | None = None

    @model_validator(mode="after")
    def _struck_at_rest(self) -> SceneBall:
        if self.strike is not None and (self.rolling or self.spin is not None or any(self.velocity)):
            advice = "a ball is struck at rest; leave out velocity, spin and rolling, or strike"
            raise_faults([Fault("", "strike", "no velocity and no spin with strike", "both", advice)])
        return self

    @classmethod
    def of(cls, ball: Ball, state: State, name: str | None = None) -> SceneBall:
        """Return the scene's ball for a carom.Ball and a carom.State with a position. CaromError for arrays and for discs."""
        where = "SceneBall.of"
        if ball.planar:
            raise CaromError(f"{where}: ball: expected a ball, got a disc")
        if state.position is None:
            raise CaromError(f"{where}: state: expected one with a position, got None; State(velocity, spin, position)")
        shape = np.broadcast_shapes(state.shape, state.position.shape[:-1], np.shape(ball.radius), np.shape(ball.mass))
        if shape:
            raise CaromError(Fault(f"{where}", "state", "one ball", f"shape {shape}", "make one SceneBall of each"))
        return cls(
            radius=float(ball.radius),
            mass=float(ball.mass),
            inertia=float(ball.kappa),
            position=tuple(state.position.tolist()),
            velocity=tuple(state.velocity.tolist()),
            spin=tuple(state.spin.tolist()),
            name=name,
        )

    @property
    def ball(self) -> Ball:
        """Return the ball without its state."""
        return Ball(self.radius, self.mass, self.inertia)

    @property
    def center(self) -> Vector:
        """Return its centre (3,), m; of two numbers, with z = radius."""
        x, y, *z = self.position
        return (x, y, z[0] if z else self.radius)

    @property
    def state(self) -> State:
        """Return the initial velocity, spin and position."""
        if self.strike is not None:
            struck = self.strike.on(self.ball).state
            return State(velocity=struck.velocity, spin=struck.spin, position=self.center)
        x, y, z = self.velocity
        spin = self.spin or (0.0, 0.0, 0.0)
        if self.rolling:  # (27)
            spin = (-y / self.radius, x / self.radius, self.spin_z or 0.0)
        return State(velocity=(x, y, z), spin=spin, position=self.center)


# ----------------------------------------------------------------------------------------------------
# The contact of two balls of a scene: its surface and law, and the material that says how long it lasts.


@kernel
def _falls(p: Any, out: Any) -> int:
    """Report a friction that rises; p: at_rest, at_speed."""
    return put_fault(0, 0.0, 0.0, 0.0, 0, out) if p[0] < p[1] else 0


class FallingFriction(Ruled):
    """Friction of two balls that falls with their slip u: at_speed + (at_rest - at_speed) exp(-u / speed).

    Parameters
    ----------
    at_rest, at_speed : >= 0: the coefficients without slip and at great slip, at_rest the larger one
    speed : > 0 m/s, over which it falls

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> pair = carom.BallContact(friction={"at_rest": 0.118, "at_speed": 0.01, "speed": 0.92})
    >>> round(pair.friction.at(1.0), 4)
    0.0464
    """

    rules: ClassVar = _falls
    ruled: ClassVar = ("at_rest", "at_speed")
    fault_texts: ClassVar = (FaultText("at_rest", "at least at_speed = {at_speed:g}", "{at_rest:g}"),)

    at_rest: NotNegative
    at_speed: NotNegative
    speed: FasterThanNothing

    @property
    def parameters(self) -> Vector:
        """Return mu, drop, rate of mu + drop exp(-rate u)."""
        return (self.at_speed, self.at_rest - self.at_speed, 1 / self.speed)

    def at(self, slip: float) -> float:
        """Return the coefficient at a slip (m/s)."""
        return float(friction_at_slip(*self.parameters, slip))


RUBBING = Number("a number >= 0 (inf: never slips), or a table { at_rest, at_speed, speed }", least=0, infinite=True)


class _NumberOrTable:
    what = RUBBING.what

    def __call__(self, value: Any) -> float | FallingFriction:
        falls = isinstance(value, dict | FallingFriction)
        return checked_part(FallingFriction, value) if falls else RUBBING(value)


def _as_written(friction: float | FallingFriction) -> Any:
    return friction.model_dump() if isinstance(friction, FallingFriction) else friction


Rubbing = Annotated[float | FallingFriction, PlainValidator(_NumberOrTable()), PlainSerializer(_as_written)]


class BallContact(Model):
    """The surface of the balls for impacts of two of them, and their law; default: elastic, without friction.

    Parameters
    ----------
    restitution : number from 0 to 1, or a form of the normal speed; default: 1
    friction : >= 0, or inf, or a table of at_rest, at_speed, speed (m/s): friction that falls with the slip u, at_speed +
        (at_rest - at_speed) exp(-u / speed); default: 0
    tangential_restitution : -1 to 1; default: 0
    law : str or carom.Law: a law of one contact, such as "contact", "alciatore" (friction that falls with the slip), "maw"
        (tangential compliance), or one of your own; default: "contact". Where contacts overlap in time, friction is Coulomb's,
        whatever the law, and contacts that stick end without slip.
    stiffness_ratio : > 0, tangential over normal stiffness, which laws of tangential compliance read; default: 2 (1 - nu)/(2 - nu)
        of Poisson's ratio nu
    young : Young's modulus of the balls, > 0 Pa; default: 5.84e9, phenolic resin. It says how long contacts last, and so which of
        them overlap in time, as in a rack; in scenes of sizes and masses for which the default is too soft, overlap is False
    poisson : Poisson's ratio of the balls, 0 to 0.5; default: 0.34
    overlap : whether contacts that overlap in time are resolved together, or one pair after the other as if contacts took no time;
        default: True

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> carom.BallContact(restitution=0.95, friction=0.06).friction
    0.06
    """

    restitution: Bounce = Constant(value=1.0)
    friction: Rubbing = 0.0
    tangential_restitution: Spring = 0.0
    law: PairLawChoice = "contact"
    stiffness_ratio: PositiveNumber | None = None
    young: Modulus = YOUNG
    poisson: PoissonRatio = POISSON
    overlap: Flag = True

    @property
    def modulus(self) -> float:
        """Return E* of the contacts, E / (2 (1 - nu^2)), Pa; 0 where they are resolved one pair after the other."""
        return contact_modulus(self.young, self.poisson) if self.overlap else 0.0

    @property
    def contact(self) -> ContactParameters:
        """Return the parameters of the contact as numbers."""
        mu = self.friction.at_speed if isinstance(self.friction, FallingFriction) else self.friction
        return contact(self.restitution, mu, self.tangential_restitution)

    @property
    def tangential_stiffness(self) -> float:
        """Return the tangential over the normal stiffness of the contact: as given, or of its Poisson's ratio (Mindlin)."""
        found = 2 * (1 - self.poisson) / (2 - self.poisson) if self.stiffness_ratio is None else self.stiffness_ratio
        return float(found)

    def contact_of(self, law: Law) -> ContactParameters:
        """Return the parameters of the contact as a law's kernel takes them."""
        return self.contact.under(law, self.tangential_stiffness)

    def friction_of(self, law: Law) -> Vector:
        """Return mu, drop, rate of the friction mu + drop exp(-rate u) under a law."""
        if law.slip_friction is not None:
            return law.slip_friction
        if isinstance(self.friction, FallingFriction) and "friction" not in law.pinned:
            return self.friction.parameters
        return (self.contact_of(law).mu, 0.0, 0.0)


# ----------------------------------------------------------------------------------------------------
# Balls of a scene among each other: which of them overlap, and whether their material is too soft for them.


def near_pairs(balls: Sequence[SceneBall]) -> list[tuple[int, int]]:
    """Return the pairs of balls that are nearer than their radii together, by their numbers in order, found by sorting along x."""
    x = np.array([ball.center for ball in balls])
    a = np.array([ball.radius for ball in balls])
    order = np.argsort(x[:, 0], kind="stable")
    x, a = x[order], a[order]
    last = np.searchsorted(x[:, 0], x[:, 0] + a + a.max(), side="right")
    found: list[tuple[int, int]] = []
    for i in range(len(x) - 1):
        near = slice(i + 1, last[i])
        apart = np.sqrt(((x[near] - x[i]) ** 2).sum(axis=1))
        close = np.flatnonzero(apart < a[near] + a[i]).tolist()
        pairs = ((int(order[i]), int(order[i + 1 + j])) for j in close)
        found += [(min(pair), max(pair)) for pair in pairs]
    return sorted(found)


def fastest(balls: Sequence[SceneBall]) -> tuple[float, float, float]:
    """Return the speed (m/s), mass and radius of the fastest ball."""
    speeds = [math.hypot(*ball.state.velocity) for ball in balls]
    u, ball = max(zip(speeds, balls, strict=True), key=lambda one: one[0])
    return u, ball.mass, ball.radius


def default_is_too_soft(contact: BallContact, balls: Sequence[SceneBall]) -> bool:
    """Return whether the default modulus, that of phenolic resin, is too soft for balls of these sizes, masses and speeds."""
    default = contact.modulus > 0 and len(balls) > 1 and contact.young == YOUNG
    return default and contact.young < least_young(contact.young, contact.modulus, *fastest(balls))


# ----------------------------------------------------------------------------------------------------
# A rack of balls: which ones lie in it, row by row, and the gaps between them, drawn from a seed.


class Rack(Model):
    """The balls of a rack, and the gaps between them.

    Parameters
    ----------
    balls : names of the balls, row by row. The first stays where it is declared, and the rows follow along x
    rows : how many balls each row has; default: a triangle, 1, 2, 3, ...
    gap : m, >= 0: the balls are laid anew around the first, with such gaps; default: each lies where it is declared
    gap_spread : m, at most ``gap``: each ball is moved at random by up to half of it, so that no gap differs from ``gap`` by more
        (their standard deviation is 0.35 of it); default: 0
    seed : of these moves; default: 0. The same seed gives the same places, to the last bit

    The balls have one radius. Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> scene = carom.load_scene("pool-9ft")
    >>> tight = carom.replaced(scene, {"rack.gap": "0.05 mm", "rack.gap_spread": "0.04 mm", "rack.seed": 3})
    >>> tight.rack.describe()
    'a rack of 15 balls with gaps of 50 µm ± 40 µm (seed 3)'
    """

    balls: tuple[str, ...] = ()
    rows: tuple[Count, ...] = ()
    gap: Gap | None = None
    gap_spread: Gap = 0.0
    seed: CountOrZero = 0

    @model_validator(mode="after")
    def _sound(self) -> Rack:
        faults = []
        if not self.balls or sum(self._rows) != len(self.balls):
            got = f"{len(self.balls)} balls" + (f" in rows of {shown(list(self.rows))}" if self.rows else "")
            wanted = f"names of {sum(self.rows)} balls" if self.rows else "names of 1, 3, 6, 10, 15, ... balls"
            faults.append(Fault("", "balls", wanted, got, "" if self.rows else "rows = [1, 2, 3, 2, 1] is a diamond"))
        if twice := next((name for i, name in enumerate(self.balls) if name in self.balls[:i]), None):
            faults.append(Fault("", "balls", "each ball once", f"{twice!r} twice"))
        if self.gap is None and self.gap_spread > 0:
            faults.append(Fault("", "gap", "a length in m, >= 0, as there is a gap_spread", "nothing"))
        elif self.gap is not None and self.gap_spread > self.gap:
            expected = f"at most the gap, {format_length(self.gap)}"
            got = format_length(self.gap_spread)
            faults.append(Fault("", "gap_spread", expected, got, "balls would overlap"))
        raise_faults(faults)
        return self

    @property
    def _rows(self) -> tuple[int, ...]:
        if self.rows:
            return self.rows
        return tuple(range(1, math.isqrt(2 * len(self.balls)) + 1))

    def describe(self) -> str:
        """Return the balls and their gaps in a few words."""
        gaps = "" if self.gap is None else f" with gaps of {format_length(self.gap)}"
        if self.gap_spread > 0:
            gaps += f" ± {format_length(self.gap_spread)} (seed {self.seed})"
        return f"a rack of {len(self.balls)} balls{gaps}"

    def faults(self, names: Sequence[str], balls: Sequence[SceneBall]) -> list[Fault]:
        """Report names that no ball has, balls of different radii, and gaps that are larger than a ball."""
        found = []
        widest = max(ball.radius for ball in balls)
        if self.gap is not None and self.gap >= widest:
            got, advice = format_length(self.gap), "a number is in m: gap = '0.05 mm'"
            found.append(Fault("", "rack.gap", f"less than the radius, {format_length(widest)}", got, advice))
        for i, name in enumerate(self.balls):
            at = f"rack.balls[{i}]"
            if name not in names:
                hint = did_you_mean(name, names)
                found.append(Fault("", at, f"a ball of {shortened_list(names, 16)}", repr(name), hint))
            elif self.gap is not None and self.balls[0] in names:
                one, first = (balls[names.index(ball)] for ball in (name, self.balls[0]))
                if one.radius != first.radius:
                    expected = f"a ball of radius {format_length(first.radius)}, as the first"
                    found.append(Fault("", at, expected, format_length(one.radius), "leave out rack.gap"))
        return found

    def lays(self, name: str) -> bool:
        """Return whether the gaps say where a ball lies, and not its own position: all but the first."""
        return self.gap is not None and name in self.balls[1:]

    def places(self, first: Vector, radius: float) -> tuple[Vector, ...]:
        """Return the centres of all balls, the first of which is given, m."""
        pitch, gap = 2 * radius + (self.gap or 0.0), self.gap_spread / 2
        found: list[Vector] = []
        x, before, drawn = 0.0, 0, 0
        dx0 = dy0 = 0.0
        for count in self._rows:
            if before:
                x += pitch * (math.sqrt(0.75) if (count - before) % 2 else 1.0)
            before = count
            for k in range(count):
                drawn, dx, dy = _in_disc(self.seed, drawn)
                if not found:
                    dx0, dy0 = dx, dy
                y = (k - (count - 1) / 2) * pitch
                found.append((first[0] + (x + gap * (dx - dx0)), first[1] + (y + gap * (dy - dy0)), first[2]))
        return tuple(found)


def _in_disc(seed: int, n: int) -> tuple[int, float, float]:
    """Draw a point in the unit disc from the numbers of a seed after the first n; and how many are drawn by then."""
    while True:
        x, y = (2 * uniform(seed & 0xFFFFFFFF, seed >> 32, n + k) - 1 for k in (0, 1))
        n += 2
        if x * x + y * y <= 1:
            return n, x, y
