"""The air of a scene: its density, viscosity and wind; and coefficients of drag and lift as balls have them."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Sequence
from typing import Annotated, Any, ClassVar, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator, PlainSerializer, PlainValidator, model_validator

from carom.core.motion.air import LAWS
from carom.errors import Fault, shown, suggestion
from carom.laws.air import AIR_LAWS, AirSegment
from carom.scene.schema import (
    Coefficient,
    Components,
    Flag,
    Model,
    NotNegative,
    Number,
    Speed,
    checked_part,
    raise_faults,
    refused,
)

Array = NDArray[np.float64]
# Dry air: gas constant, J/(kg K); Sutherland's viscosity, U.S. Standard Atmosphere (1976), eq. 51
GAS_CONSTANT, SUTHERLAND, SUTHERLAND_AT = 287.05287, 1.458e-6, 110.4
ATMOSPHERE = 101325.0  # Pa
# From which numbers those follow that are not given
FOLLOWS = {"air.density": "air.temperature and air.pressure", "air.viscosity": "air.temperature"}
Positive = Annotated[float, BeforeValidator(Number("a density in kg/m^3, > 0", "kg/m^3", least=0, above=True))]
Viscosity = Annotated[float, BeforeValidator(Number("a viscosity in Pa s, > 0", "Pa*s", least=0, above=True))]
Temperature = Annotated[float, BeforeValidator(Number('a temperature in K, >= 100, or as "20 degC"', "K", least=100))]
Pressure = Annotated[float, BeforeValidator(Number("a pressure in Pa, > 0", "Pa", least=0, above=True))]


class SceneAir(Model):
    """The air in which the balls of a scene fly.

    Parameters
    ----------
    density : kg/m^3; default: that of dry air at ``temperature`` and ``pressure``
    temperature, pressure : K (or "20 degC") and Pa; default: 293.15 K, 101325 Pa
    viscosity : Pa s; default: that of air at the temperature. Laws of the Reynolds number read it
    wind : 3 speeds, m/s; default: none
    buoyancy : whether the air bears its own weight; default: False

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> air = carom.scene.SceneAir(temperature="20 degC")
    >>> round(air.rho, 4), round(1e6 * air.eta, 2)
    (1.2041, 18.13)
    """

    density: Positive | None = None
    temperature: Temperature = 293.15
    pressure: Pressure = ATMOSPHERE
    viscosity: Viscosity | None = None
    wind: Annotated[tuple[Speed, Speed, Speed], BeforeValidator(Components("3 speeds in m/s: of the wind", (3,)))] = (
        0.0,
        0.0,
        0.0,
    )
    buoyancy: Flag = False

    @model_validator(mode="after")
    def _one_density(self) -> SceneAir:
        if self.density is not None and self.pressure != ATMOSPHERE:
            raise_faults([Fault("", "density", "no density with a pressure", "both", "leave out one of them")])
        return self

    @property
    def rho(self) -> float:
        """Return its density, kg/m^3."""
        return self.density if self.density is not None else self.pressure / (GAS_CONSTANT * self.temperature)

    @property
    def eta(self) -> float:
        """Return its viscosity, Pa s."""
        t = self.temperature
        return self.viscosity if self.viscosity is not None else SUTHERLAND * t * math.sqrt(t) / (t + SUTHERLAND_AT)


# ----------------------------------------------------------------------------------------------------
# Coefficients of drag and lift.


class WithSpin(Model):
    """C = still + per_spin S, S the spin ratio a |w| / |u|."""

    tag: ClassVar[str] = "form"
    form: Literal["spin"] = "spin"
    still: Coefficient = 0.0
    per_spin: Coefficient

    def segments(self) -> tuple[AirSegment, ...]:
        """Return the law as segments."""
        return (AirSegment(self.still, q=self.per_spin),)


class Saturating(Model):
    """C = slope S / (1 + saturation S)."""

    tag: ClassVar[str] = "form"
    form: Literal["saturating"] = "saturating"
    slope: Coefficient
    saturation: NotNegative = 0.0

    def segments(self) -> tuple[AirSegment, ...]:
        """Return the law as segments."""
        return (AirSegment(q=self.slope, r=self.saturation),)


class TabledCoefficient(Model):
    """C as a table over the Reynolds number or the spin ratio: linear between its rows, constant beyond them."""

    tag: ClassVar[str] = "form"
    form: Literal["table"] = "table"
    reynolds: tuple[NotNegative, ...] | None = None
    spin_ratio: tuple[NotNegative, ...] | None = None
    values: tuple[Coefficient, ...]

    @model_validator(mode="after")
    def _rows(self) -> TabledCoefficient:
        x = self.reynolds or self.spin_ratio or ()
        if (self.reynolds is None) == (self.spin_ratio is None):
            raise_faults([Fault("", "reynolds", "either reynolds or spin_ratio", "both" if x else "neither")])
        if len(x) != len(self.values) or len(x) < 2 or any(low >= high for low, high in itertools.pairwise(x)):
            expected = "2 numbers or more that increase, as many as values"
            raise_faults([Fault("", "reynolds" if self.reynolds else "spin_ratio", expected, shown(list(x)))])
        return self

    def segments(self) -> tuple[AirSegment, ...]:
        """Return the law as segments."""
        x, y, over = self.reynolds or self.spin_ratio or (), self.values, self.spin_ratio is not None
        found = [AirSegment(y[0], high=x[0], over_spin=over)] if x[0] > 0 else []
        for low, high, before, after in zip(x, x[1:], y, y[1:], strict=False):
            slope = (after - before) / (high - low)
            rises = {"q": slope} if over else {"p1": slope}
            found.append(AirSegment(before - slope * low, **rises, high=high, over_spin=over))
        return (*found, AirSegment(y[-1], over_spin=over))


FORMS: dict[str, type[Model]] = {"spin": WithSpin, "saturating": Saturating, "table": TabledCoefficient}


class Coefficients:
    """Expectation of a coefficient of drag or lift: a number, the name of a law, or a table of a form."""

    def __init__(self, name: str, least: float = -math.inf) -> None:
        self.names = [law.card.name for law in AIR_LAWS.values() if getattr(law, name)]
        number = "a number" if least == -math.inf else f"a number >= {least:g}"
        self.what = f"{number}, one of {', '.join(self.names)}, or a table {{ form = ... }} of {', '.join(FORMS)}"
        self.number = Number(self.what, least=least)

    def __call__(self, value: Any) -> Any:
        """The number, name or form."""
        if isinstance(value, str):
            if value not in self.names:
                raise refused(self.what, shown(value), suggestion(value, self.names) or "carom laws lists them")
            return value
        if isinstance(value, Model) and type(value) in FORMS.values():
            return value
        if isinstance(value, dict):
            if value.get("form") not in FORMS:
                raise refused(f"one of {', '.join(FORMS)}", shown(value.get("form", "nothing")), field="form")
            return checked_part(FORMS[value["form"]], value)
        return self.number(value)


def _as_written(value: Any) -> Any:
    return value.model_dump(exclude_none=True) if isinstance(value, Model) else value


DRAG, LIFT = Coefficients("drag", least=0), Coefficients("lift")
Drag = Annotated[
    float | str | WithSpin | Saturating | TabledCoefficient, PlainValidator(DRAG), PlainSerializer(_as_written)
]
Lift = Annotated[
    float | str | WithSpin | Saturating | TabledCoefficient, PlainValidator(LIFT), PlainSerializer(_as_written)
]


def segments_of(value: Any, name: str) -> tuple[AirSegment, ...]:
    """Return the segments of a ball's ``drag`` or ``lift``; of None one that is zero."""
    if isinstance(value, str):
        found: tuple[AirSegment, ...] = getattr(AIR_LAWS[value], name)
        return found
    if isinstance(value, WithSpin | Saturating | TabledCoefficient):
        return value.segments()
    return (AirSegment(value or 0.0),)


class BallInAir(NamedTuple):
    """What the event loop reads of a ball in air."""

    strength: float
    """K = rho pi a^2/(2 m), 1/m."""
    buoyancy: float
    """The share of its weight that the air bears."""
    drag: tuple[int, int]
    """First and last row of its law."""
    lift: tuple[int, int]


def balls_in_air(scene: Any, share: bool = False) -> tuple[list[BallInAir], list[tuple[float, ...]]]:
    """Return the balls of a scene with air, and the rows of all their laws: of the speed, in place of the Reynolds number.

    Balls with the same numbers ``share`` rows where there are too many otherwise.
    """
    air = scene.air or SceneAir()
    rows: list[tuple[float, ...]] = []
    found: list[BallInAir] = []
    for ball in scene.balls:
        per_speed = 2 * ball.radius * air.rho / air.eta  # the Reynolds number at 1 m/s
        places = {}
        for name in ("drag", "lift"):
            own: list[tuple[float, ...]] = [
                (float(s.over_spin), s.high if s.over_spin else s.high / per_speed, s.p0, s.p1 * per_speed, s.p2 / per_speed,
                 s.p3 / (per_speed * per_speed), s.q, s.r) for s in segments_of(getattr(ball, name), name)
            ]  # fmt: skip
            at = next((k for k in range(len(rows) if share else 0) if rows[k : k + len(own)] == own), len(rows))
            rows += own if at == len(rows) else []
            places[name] = (at, at + len(own) - 1)
        a = ball.radius
        moved = air.rho * 4 / 3 * math.pi * (a * a * a) / ball.mass
        k = air.rho * math.pi * (a * a) / (2 * ball.mass)
        found.append(BallInAir(strength=k, buoyancy=moved if air.buoyancy else 0.0, **places))
    return balls_in_air(scene, True) if len(rows) > LAWS and not share else (found, rows)


def air_acceleration(scene: Any, velocity: Array, spin: Array) -> Array:
    """Return the acceleration that air gives the balls of a scene at velocities and spins (..., B, 3): drag, lift, buoyancy."""
    balls, rows = balls_in_air(scene)
    u, size = velocity - np.array(scene.air.wind), np.linalg.norm(spin, axis=-1)
    s = np.linalg.norm(u, axis=-1)
    found = np.zeros_like(u)
    with np.errstate(divide="ignore", invalid="ignore"):
        for i, (own, ball) in enumerate(zip(balls, scene.balls, strict=True)):
            ratio = ball.radius * size[..., i] / s[..., i]
            drag, lift = (_coefficient(np.array(rows[a : b + 1]), s[..., i], ratio) for a, b in (own.drag, own.lift))
            across = np.nan_to_num(np.cross(spin[..., i, :], u[..., i, :]) / size[..., i, None])
            force = own.strength * s[..., i, None] * (lift[..., None] * across - drag[..., None] * u[..., i, :])
            found[..., i, :] = np.where(s[..., i, None] > 0, force, 0 * u[..., i, :])
    bears: Array = found - np.array([own.buoyancy for own in balls])[:, None] * np.array(scene.pull)
    return bears


def _coefficient(law: Array, s: Array, ratio: Array) -> Array:
    """Return a coefficient by the rows of its law, at speeds and spin ratios."""
    _over, _high, p0, p1, p2, p3, q, r = law[np.searchsorted(law[:-1, 1], np.where(law[0, 0] != 0, ratio, s))].T
    found: Array = (p0 + p1 * s + p2 / s + p3 / s**2 + q * ratio) / (1 + r * ratio)
    return found


def air_faults(scene: Any) -> Iterable[Fault]:
    """Report numbers of the air on balls of a scene without it, and what is not followed in air."""
    for i, ball in enumerate(scene.balls):
        given = [name for name in ("drag", "lift", "spin_decay") if getattr(ball, name) not in (None, 0)]
        if scene.air is None:
            for name in given:
                yield Fault("", f"balls[{i}].{name}", "a scene with air", "one without", "add a table [air]")
        elif ball.drag is None:
            yield Fault("", f"balls[{i}].drag", f"in air, {DRAG.what}", "nothing", "0 for no drag; sources: carom laws")
    if scene.air is None:
        return
    if scene.floor is not None and any(scene.floor.slope):
        yield Fault("", "floor.slope", "a level floor in air", shown(list(scene.floor.slope)))
    if scene.ball_contact.overlap and len(scene.balls) > 1:
        advice = "contacts that overlap in time are not followed in air; leave out young, and overlap = true"
        yield Fault("", "ball_contact.overlap", "false in air", "true", advice)
    if len(rows := balls_in_air(scene)[1]) > LAWS:
        yield Fault("", "air", f"at most {LAWS} segments of laws of drag and lift in all", f"{len(rows)}")


def has_no_overlap(air: SceneAir | None, given: Sequence[str]) -> bool:
    """Return whether contacts of balls take no time because there is air, and nothing was said of them."""
    return air is not None and not {"young", "overlap"} & set(given)
