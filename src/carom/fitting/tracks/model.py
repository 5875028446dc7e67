"""Laws for whole tracks: the parameters that all tracks share, and the scene in which a ball is simulated."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from carom.errors import CaromError, float_or_nan
from carom.fitting.data import common_faults
from carom.fitting.laws import FittedLaw, track_laws_named
from carom.fitting.parameters import FORMS, PARAMETERS, Parameter
from carom.fitting.tracks.arrays import AffineArrays, Table
from carom.laws.law import LIKE_SOLIDS
from carom.scene.ball import SceneBall
from carom.scene.restitution import Bounce, Constant, Exponential, Polynomial, Viscoelastic
from carom.scene.scene import Floor, Run, Scene
from carom.scene.shapes import Table as Cushions
from carom.tracks.events import WallLine

__all__ = ["WALL_RANGE", "TrackModel", "TrackSetting", "side_of", "track_models"]

FAR = 100.0  # m: distance of sides of the table that no ball of the film meets
WALL_RANGE = 0.01  # m about the turning point of the frames, within which a cushion is searched for
SPIN_LOSS = 10.0  # rad/s^2 of spin about the vertical; Alciatore has 5 to 15
START_MARGIN = 0.02  # of a parameter's range, between its bounds and its start
START_VALUES = {
    "friction": 0.2, "tangential_restitution": 0.0, "stiffness_ratio": LIKE_SOLIDS, "restitution_1": 0.0, "restitution_2": 0.0,
}  # fmt: skip
_NAMED = {parameter.name: parameter for parameter in PARAMETERS}
# Parameters of the floor; the same friction acts while a cushion presses the ball on the cloth.
FLOOR = (
    replace(_NAMED["floor_friction"], low=0.01, start=0.2, meaning="of the cloth"),
    Parameter("rolling_resistance", 0.0, 0.1, (0.007,), 0.007, meaning="deceleration / g of a rolling ball"),
    Parameter("spin_loss", 0.0, 200.0, (SPIN_LOSS,), SPIN_LOSS, "rad/s^2", "of the spin about the vertical"),
)


@dataclass(frozen=True)
class TrackSetting:
    """Settings of a fit to whole tracks: the ball, the noise, the height of the wall contact, and the extent of the simulation.

    Examples
    --------
    >>> from carom.fitting.tracks import TrackSetting
    >>> TrackSetting(radius=0.03075, noise=3e-4).cushions
    3
    """

    radius: float
    """m"""
    kappa: float = 0.4
    noise: float | None = None
    """m, of one coordinate of one frame; None: estimated from each law's residuals."""
    contact_height: float = 1.0
    """Height of the wall contact above the floor, in radii (billiard cushions: 1.2 to 1.4)."""
    floor_restitution: float = 0.0
    restitution: str = "constant"
    """One of FORMS except line, which no scene has."""
    cushions: int = 3
    """Largest number of contacts of a simulated track: each of them magnifies the errors made before."""
    after: float = 2.0
    """Time simulated after the last contact, s: later motion is dominated by slope and dirt of the table."""
    spin_width: float = 1.25
    """v/a: standard deviation of the prior of the initial sidespin, normal about zero."""
    gravity: float = 9.80665
    fit: tuple[str, ...] = ()
    """Parameters to fit in addition: spin_loss."""
    fixed: dict[str, float] = field(default_factory=dict)
    bounds: dict[str, tuple[float, float]] = field(default_factory=dict)

    def check(self) -> None:
        """Raise CaromError with one line per problem."""
        faults = common_faults(self)
        if not 0 < float_or_nan(self.kappa) <= 2 / 3 * (1 + 1e-12):
            faults.append(f"inertia: expected solid, hollow or kappa in (0, 2/3], got {self.kappa!r}")
        if self.noise is not None and not 0 < float_or_nan(self.noise) < 1:
            faults.append(f"noise: expected a length above 0 (m), got {self.noise!r}")
        if str(self.restitution) not in FORMS or self.restitution == "line":
            forms = ", ".join(name for name in FORMS if name != "line")
            faults.append(f"restitution: expected one of {forms} for whole tracks, got {self.restitution!r}")
        if not float_or_nan(self.cushions) >= 1:
            faults.append(f"cushions: expected a whole number of contacts, 1 or more, got {self.cushions!r}")
        if not float_or_nan(self.spin_width) > 0:
            faults.append(f"spin_width: expected a width above 0 (v/a), got {self.spin_width!r}")
        allowed = {"spin_loss"}
        faults += [f"fit: expected one of {', '.join(sorted(allowed))} for whole tracks, got {name!r}"
                   for name in self.fit if name not in allowed]  # fmt: skip
        if faults:
            raise CaromError(*faults)


@dataclass(frozen=True, eq=False)
class TrackModel:
    """A law, the parameters that all tracks share, and the table."""

    law: FittedLaw
    setting: TrackSetting
    walls: tuple[WallLine, ...]
    free: dict[str, Parameter]
    held: dict[str, float]
    """Parameters that are not fitted."""
    family: AffineArrays | None = None
    """The arrays of :meth:`scene` by parameter, of those that are held later on as well."""

    @property
    def rolling_only(self) -> bool:
        """Whether the law is about balls that roll before the wall."""
        return self.law.engine is not None and self.law.engine.rolling_only

    def holding(self, name: str, value: float) -> TrackModel:
        """Return the model with one parameter held."""
        free = {other: one for other, one in self.free.items() if other != name}
        return replace(self, free=free, held=self.held | {name: value})

    def table(self, numbers: Mapping[str, float]) -> Table:
        """Return the arrays of the scene."""
        assert self.family is not None
        return self.family.at({**self.held, **numbers})

    def scene(self, numbers: Mapping[str, float], duration: float | None = None) -> Scene:
        """Return the table with one ball in its middle."""
        at, given, engine = {**self.held, **numbers}, self.setting, self.law.engine
        assert engine is not None
        a = given.radius
        nose = None if self.law.upright or given.contact_height == 1 else given.contact_height * a
        reach = a if nose is None else math.sqrt(a * a - (nose - a) ** 2)
        sides = {side_of(wall): at[f"wall_{side_of(wall)}"] for wall in self.walls}
        x0, x1 = sides.get("left", -FAR) - reach, sides.get("right", FAR) + reach
        y0, y1 = sides.get("bottom", -FAR) - reach, sides.get("top", FAR) + reach
        center, smooth = ((x0 + x1) / 2, (y0 + y1) / 2), self.law.frictionless
        table = Cushions(
            length=x1 - x0, width=y1 - y0, center=center, nose_height=nose, stiffness_ratio=at["stiffness_ratio"],
            restitution=_form(given.restitution if "restitution" in self.law.free else "constant", at) if engine.surface else None,
            friction=None if not engine.surface else 0.0 if smooth else at["friction"],
            tangential_restitution=0.0 if smooth or not engine.surface else at["tangential_restitution"],
        )  # fmt: skip
        floor = Floor(
            friction=at["floor_friction"], restitution=Constant(value=given.floor_restitution),
            rolling_resistance=at["rolling_resistance"], spin_friction=given.kappa * a * at["spin_loss"] / given.gravity,
        )  # fmt: skip
        return Scene(
            gravity=(0.0, 0.0, -given.gravity), floor=floor, walls=(table,),
            balls=(SceneBall(radius=a, mass=1.0, inertia=given.kappa, position=center),),
            run=Run(law=engine.law, floor_contact=engine.floor_contact, duration=duration),
        )  # fmt: skip


def side_of(wall: WallLine) -> str:
    """Return which side of a table a wall along an axis is: left, right, bottom or top."""
    return {(1, 0): "left", (-1, 0): "right", (0, 1): "bottom", (0, -1): "top"}[
        round(wall.normal[0]), round(wall.normal[1])
    ]


def _form(name: str, at: Mapping[str, float]) -> Bounce:
    """Return the scene's form of restitution, from the parameters of a fit."""
    value = [at[parameter.name] for parameter in FORMS[name].parameters]
    if name == "constant":
        return Constant(value=value[0])
    if name == "polynomial":
        return Polynomial(coefficients=(value[0], value[1], value[2]))
    if name == "viscoelastic":
        # e = 1 / (1 + c + 2/5 c^2) with c = dissipation v^(1/5)
        return Viscoelastic(c=max(value[0], 1e-12))
    return Exponential(at_rest=value[0], at_speed=value[1], speed=value[2])


def track_models(
    names: Sequence[str] | None, setting: TrackSetting, walls: Sequence[WallLine], start: Mapping[str, float]
) -> tuple[list[TrackModel], list[str]]:
    """Return the laws to fit, and notes. ``start``: initial values of parameters, as far as known."""
    setting.check()
    odd = [wall.name for wall in walls if max(abs(wall.normal[0]), abs(wall.normal[1])) < 1 - 1e-9]
    sides = [side_of(wall) for wall in walls if wall.name not in odd]
    faults = [f"wall {name}: expected walls along the axes for whole tracks, got one that is tilted" for name in odd]
    faults += [
        f"walls: expected one {side} wall, got {sides.count(side)}"
        for side in dict.fromkeys(sides)
        if sides.count(side) > 1
    ]
    if faults:
        raise CaromError(*faults)
    chosen, notes = track_laws_named(names, setting.contact_height == 1.0)
    return [_model(law, setting, walls, start) for law in chosen], notes


def _model(law: FittedLaw, setting: TrackSetting, walls: Sequence[WallLine], start: Mapping[str, float]) -> TrackModel:
    free: dict[str, Parameter] = {}
    held = {"friction": math.inf, "tangential_restitution": 0.0, "restitution": 1.0, "spin_loss": SPIN_LOSS,
            "stiffness_ratio": LIKE_SOLIDS}  # fmt: skip
    for name in law.free:
        parameters = FORMS[setting.restitution].parameters if name == "restitution" else (_NAMED[name],)
        free |= {parameter.name: parameter for parameter in parameters}
    for parameter in FLOOR:
        if parameter.name != "spin_loss" or "spin_loss" in setting.fit:
            free[parameter.name] = parameter
    for wall in walls:
        side = side_of(wall)
        at = start.get(f"wall_{side}", wall.point[0 if side in ("left", "right") else 1])
        far = start.get(f"range_{side}", WALL_RANGE)
        free[f"wall_{side}"] = Parameter(
            f"wall_{side}", at - far, at + far, (at,), at, "m", "position at which the ball's centre is reflected"
        )
    for name, value in law.pinned.items():
        free.pop(name, None)
        held[name] = value
    for name, value in setting.fixed.items():
        if name in free or name == "spin_loss":
            free.pop(name, None)
            held[name] = value
    for name, parameter in free.items():
        low, high = setting.bounds.get(name, (parameter.low, parameter.high))
        middle = parameter.tried[len(parameter.tried) // 2] if parameter.tried else parameter.start
        at = start.get(name, START_VALUES.get(name, middle))
        if name == "stiffness_ratio" and law.chi_range is not None:
            share = (1 + 1 / setting.kappa) / 2
            low, high = max(low, law.chi_range[0] / share), min(high, law.chi_range[1] / share)
        inside = START_MARGIN * (high - low)
        free[name] = replace(parameter, low=low, high=high, start=float(np.clip(at, low + inside, high - inside)))
    model = TrackModel(law, setting, tuple(walls), free, held)
    return replace(model, family=AffineArrays(model.scene, free))
