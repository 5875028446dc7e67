"""Laws as whole tracks are fitted to them: their shared numbers, and the table they make of them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from carom.checks import real
from carom.errors import CaromError
from carom.fitting.data import table_faults
from carom.fitting.laws import FittedLaw, laws_named
from carom.fitting.parameters import FORMS, PARAMETERS, Parameter
from carom.laws.maw import CHI, LIKE_SOLIDS
from carom.scene.balls import SceneBall
from carom.scene.model import Floor, Run, Scene
from carom.scene.restitution import Bounce, Constant, Exponential, Polynomial, Viscoelastic
from carom.scene.walls import Table
from carom.tracks.contacts import Wall

__all__ = ["GIVE", "WholeLaw", "WholeSetting", "side_of", "whole_laws"]

FAR = 100.0  # m: where a table has its sides that no ball of the film meets
GIVE = 0.01  # m: how far from where the frames turn a cushion is sought
SPIN_LOSS = 10.0  # rad/s^2 of spin about the vertical; Alciatore has 5 to 15
BEGIN = {
    "friction": 0.2, "tangential_restitution": 0.0, "stiffness_ratio": LIKE_SOLIDS, "restitution_1": 0.0, "restitution_2": 0.0,
}  # fmt: skip
# What the engine plays and rebounds are not fitted to; by name alone, for it says nearly what maw does.
STRONGE = FittedLaw(
    "stronge", "table", -1, ("restitution", "friction", "stiffness_ratio"), "two springs (Stronge), then the floor"
)
SPRINGS = ("maw", STRONGE.name)
_NAMED = {parameter.name: parameter for parameter in PARAMETERS}
# The numbers of the floor; while a cushion presses the ball on the cloth it is the same friction that acts.
FLOOR = (
    replace(_NAMED["floor_friction"], low=0.01, start=0.2, meaning="of the cloth"),
    Parameter("rolling_resistance", 0.0, 0.1, (0.007,), 0.007, meaning="deceleration / g of a rolling ball"),
    Parameter("spin_loss", 0.0, 200.0, (SPIN_LOSS,), SPIN_LOSS, "rad/s^2", "of the spin about the vertical"),
)


@dataclass(frozen=True)
class WholeSetting:
    """What tracks do not say, and how they are fitted."""

    radius: float
    """m"""
    kappa: float = 0.4
    noise: float | None = None
    """m, of one coordinate of one frame; None: what each law leaves over."""
    contact_height: float = 1.0
    """Where the wall touches, in radii above the floor; a billiard cushion 1.2 to 1.4."""
    floor_restitution: float = 0.0
    restitution: str = "constant"
    """One of FORMS but the line, which no scene has."""
    cushions: int = 3
    """A track is followed until the next contact after so many: each makes what went before larger."""
    after: float = 2.0
    """s that a track is followed after its last contact: what a ball does later tells of the table's slope and dirt."""
    spin_width: float = 1.25
    """v/a: the sidespin at the start is normal about zero with this width."""
    gravity: float = 9.80665
    fit: tuple[str, ...] = ()
    """Numbers to fit beside the law's own: spin_loss."""
    fixed: dict[str, float] = field(default_factory=dict)
    bounds: dict[str, tuple[float, float]] = field(default_factory=dict)

    def check(self) -> None:
        """CaromError, a line a fault."""
        faults = table_faults(self.radius, self.contact_height, self.floor_restitution)
        if not 0 < real(self.kappa) <= 2 / 3 * (1 + 1e-12):
            faults.append(f"inertia: expected solid, hollow or kappa in (0, 2/3], got {self.kappa!r}")
        if self.noise is not None and not 0 < real(self.noise) < 1:
            faults.append(f"noise: expected a length above 0 (m), got {self.noise!r}")
        if str(self.restitution) not in FORMS or self.restitution == "line":
            forms = ", ".join(name for name in FORMS if name != "line")
            faults.append(f"restitution: expected one of {forms} for whole tracks, got {self.restitution!r}")
        if not real(self.cushions) >= 1:
            faults.append(f"cushions: expected a whole number of contacts, 1 or more, got {self.cushions!r}")
        if not real(self.spin_width) > 0:
            faults.append(f"spin_width: expected a width above 0 (v/a), got {self.spin_width!r}")
        allowed = {"spin_loss"}
        faults += [f"fit: expected one of {', '.join(sorted(allowed))} for whole tracks, got {name!r}"
                   for name in self.fit if name not in allowed]  # fmt: skip
        if faults:
            raise CaromError(*faults)


@dataclass(frozen=True, eq=False)
class WholeLaw:
    """A law, its shared numbers, and the table on which it plays."""

    law: FittedLaw
    setting: WholeSetting
    walls: tuple[Wall, ...]
    free: dict[str, Parameter]
    held: dict[str, float]
    """Numbers that are not fitted."""

    @property
    def name(self) -> str:
        """The law's."""
        return self.law.name

    @property
    def rolls(self) -> bool:
        """Whether it knows only balls that roll."""
        return self.name in ("conventional", "two-step-paper")

    def scene(self, numbers: Mapping[str, float], duration: float | None = None) -> Scene:
        """The table with one ball in its middle."""
        at = {**self.held, **numbers}
        given, nose = self.setting, None if self.law.upright or self.setting.contact_height == 1 else 1.0
        a = given.radius
        if nose is not None:
            nose = given.contact_height * a
        reach = a if nose is None else math.sqrt(a * a - (nose - a) ** 2)
        sides = {}
        for wall in self.walls:
            sides[side_of(wall)] = at[f"wall_{side_of(wall)}"]
        x0, x1 = sides.get("left", -FAR) - reach, sides.get("right", FAR) + reach
        y0, y1 = sides.get("bottom", -FAR) - reach, sides.get("top", FAR) + reach
        smooth, plain = self.name == "mirror", self.name == "conventional"
        center = ((x0 + x1) / 2, (y0 + y1) / 2)
        table = Table(
            length=x1 - x0, width=y1 - y0, center=center, nose_height=nose, stiffness_ratio=at["stiffness_ratio"],
            restitution=None if plain else _form(given.restitution if "restitution" in self.law.free else "constant", at),
            friction=None if plain else 0.0 if smooth else at["friction"],
            tangential_restitution=0.0 if plain or smooth else at["tangential_restitution"],
        )  # fmt: skip
        floor = Floor(
            friction=at["floor_friction"], restitution=Constant(value=given.floor_restitution),
            rolling_resistance=at["rolling_resistance"], spin_friction=given.kappa * a * at["spin_loss"] / given.gravity,
        )  # fmt: skip
        law = "conventional" if plain else self.name if self.name in SPRINGS else "two-step"
        after = self.name in ("two-step-after", "contact", "no-slip", "mirror")
        return Scene(
            gravity=(0.0, 0.0, -given.gravity), floor=floor, walls=(table,),
            balls=(SceneBall(radius=a, mass=1.0, inertia=given.kappa, position=center),),
            run=Run(law=law, floor_contact="after" if after else "with", duration=duration),
        )  # fmt: skip


def side_of(wall: Wall) -> str:
    """Which side of a table a wall along an axis is: left, right, bottom, top."""
    return {(1, 0): "left", (-1, 0): "right", (0, 1): "bottom", (0, -1): "top"}[
        round(wall.normal[0]), round(wall.normal[1])
    ]


def _form(name: str, at: Mapping[str, float]) -> Bounce:
    """The scene's form of restitution, from the numbers of a fit."""
    value = [at[parameter.name] for parameter in FORMS[name].parameters]
    if name == "constant":
        return Constant(value=value[0])
    if name == "polynomial":
        return Polynomial(coefficients=(value[0], value[1], value[2]))
    if name == "viscoelastic":
        # e = 1 / (1 + c + 2/5 c^2) with c = dissipation v^(1/5)
        return Viscoelastic(c=max(value[0], 1e-12))
    return Exponential(at_rest=value[0], at_speed=value[1], speed=value[2])


def whole_laws(
    names: Sequence[str] | None, setting: WholeSetting, walls: Sequence[Wall], start: Mapping[str, float]
) -> tuple[list[WholeLaw], list[str]]:
    """The laws to fit, and what there is to say. ``start``: numbers to begin with where something is known of them."""
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
    upright = setting.contact_height == 1.0
    others = [name for name in names or () if name != STRONGE.name]
    chosen, notes = laws_named(others or None, "table", upright) if others or not names else ([], [])
    if names and STRONGE.name in names:
        chosen.append(STRONGE)
    return [_whole(law, setting, walls, start) for law in chosen], notes


def _whole(law: FittedLaw, setting: WholeSetting, walls: Sequence[Wall], start: Mapping[str, float]) -> WholeLaw:
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
        give = start.get(f"give_{side}", GIVE)
        free[f"wall_{side}"] = Parameter(f"wall_{side}", at - give, at + give, (at,), at, "m", "where the centre turns")
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
        at = start.get(name, BEGIN.get(name, middle))
        if (
            name == "stiffness_ratio" and law.name == "maw"
        ):  # the law's curve is known where it, times this share, is within CHI
            share = (1 + 1 / setting.kappa) / 2
            low, high = max(low, CHI[0] / share), min(high, CHI[1] / share)
        inside = 0.02 * (high - low)
        free[name] = replace(parameter, low=low, high=high, start=float(np.clip(at, low + inside, high - inside)))
    return WholeLaw(law, setting, tuple(walls), free, held)
