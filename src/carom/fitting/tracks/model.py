"""Laws for whole tracks: the parameters that all tracks share, and the scene in which a ball is simulated."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from carom.errors import CaromError
from carom.fitting.cushions import cushions_between
from carom.fitting.laws import FittedLaw, track_laws_named
from carom.fitting.parameters import FORMS, PARAMETERS, Parameter
from carom.fitting.setting import Setting, decided, forms_of, require_settings
from carom.fitting.table_numbers import SharedNumber, TableNumbers, affine_table
from carom.fitting.usable_rows import assumed_height
from carom.laws.law import LIKE_SOLIDS
from carom.scene.ball import SceneBall
from carom.scene.floor import Floor
from carom.scene.restitution import Constant
from carom.scene.scene import Run, Scene
from carom.tracks.events import WallLine

__all__ = ["WALL_RANGE", "TrackModel", "side_of", "track_models"]

FAR = 100.0  # m: distance of sides of the table that no ball of the film meets
ON_WALL = ("friction", "tangential_restitution", "stiffness_ratio")
WALL_RANGE = 0.01  # m about the turning point of the frames, within which a cushion is searched for
SPIN_LOSS = 10.0  # rad/s^2 of spin about the vertical; Alciatore has 5 to 15
START_MARGIN = 0.02  # of a parameter's range, between its bounds and its start
START_VALUES = {
    "friction": 0.2, "tangential_restitution": 0.0, "stiffness_ratio": LIKE_SOLIDS, "restitution_1": 0.0, "restitution_2": 0.0,
}  # fmt: skip
_NAMED = {parameter.name: parameter for parameter in PARAMETERS}
# Parameters of the floor; the same friction acts while a cushion presses the ball on the cloth.
FLOOR = (
    replace(_NAMED["floor_friction"], low=0.01, value=0.2, meaning="of the cloth"),
    Parameter("rolling_resistance", 0.0, 0.1, (0.007,), 0.007, meaning="deceleration / g of a rolling ball"),
    Parameter(
        "spin_loss", 0.0, 200.0, (SPIN_LOSS,), SPIN_LOSS, "rad/s^2", "of the spin about the vertical", origin="setting"
    ),
)


@dataclass(frozen=True, eq=False)
class TrackModel:
    """A law, the parameters that all tracks share, and the table."""

    law: FittedLaw
    setting: Setting
    walls: tuple[WallLine, ...]
    free: dict[str, Parameter]
    held: dict[str, float]
    """Parameters that are not fitted."""
    start: TableNumbers | None = None
    """The table of :meth:`scene` where the search begins, by parameter, also of parameters that are held later on."""

    @property
    def rolling_only(self) -> bool:
        """Whether the law is about balls that roll before the wall."""
        return self.law.engine is not None and self.law.engine.rolling_only

    def holding(self, name: str, value: float) -> TrackModel:
        """Return the model with one parameter held."""
        free = {other: one for other, one in self.free.items() if other != name}
        return replace(self, free=free, held=self.held | {name: value})

    def table(self, numbers: Mapping[str, float]) -> TableNumbers:
        """Return the arrays of the scene, and their derivatives."""
        assert self.start is not None
        at = {**self.held, **numbers}
        return self.start.at(np.array([at[one.name] for one in self.start.shared]))

    def scene(self, numbers: Mapping[str, float]) -> Scene:
        """Return the table with one ball in its middle."""
        at, given, engine = {**self.held, **numbers}, self.setting, self.law.engine
        assert engine is not None
        a = given.radius
        nose = None if self.law.upright or given.contact_height == 1 else (given.contact_height or 1.0) * a
        lines = {"left": -FAR, "right": FAR, "bottom": -FAR, "top": FAR}
        lines |= {side: at[f"wall_{side}"] for side in map(side_of, self.walls)}
        smooth = self.law.frictionless
        table = cushions_between(
            lines, a, nose, stiffness_ratio=at["stiffness_ratio"],
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
            balls=(SceneBall(radius=a, mass=1.0, inertia=given.kappa, position=table.center),),
            run=Run(law=engine.law, floor_contact=engine.floor_contact),
        )  # fmt: skip


def side_of(wall: WallLine) -> str:
    """Return which side of a table a wall along an axis is: left, right, bottom or top."""
    return {(1, 0): "left", (-1, 0): "right", (0, 1): "bottom", (0, -1): "top"}[
        round(wall.normal[0]), round(wall.normal[1])
    ]


def _form(name: str, at: Mapping[str, float]) -> Any:
    """Return the scene's form of restitution, from the parameters of a fit."""
    least = 1e-12 if name == "viscoelastic" else -math.inf  # (a scene has no form without dissipation)
    return FORMS[name].for_scene(name, [max(at[one.name], least) for one in FORMS[name].parameters])


def track_models(
    names: Sequence[str] | None, setting: Setting, walls: Sequence[WallLine], start: Mapping[str, float]
) -> tuple[list[TrackModel], list[str]]:
    """Return the laws to fit, and notes. ``start``: initial values of parameters, as far as known."""
    require_settings(setting, whole=True)
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
    notes = assumed_height("table", setting)
    setting = setting.with_height()
    chosen, more = track_laws_named(names, setting.contact_height == 1.0)
    return [_model(law, setting, walls, start) for law in chosen], [*notes, *more]


def _model(law: FittedLaw, setting: Setting, walls: Sequence[WallLine], start: Mapping[str, float]) -> TrackModel:
    form = forms_of(law, setting).get("restitution", FORMS["constant"]).parameters
    known = [*form, *(_NAMED[name] for name in ON_WALL), *FLOOR]
    if setting.floor_friction is not None:
        known[-len(FLOOR)] = replace(FLOOR[0], value=setting.floor_friction, origin="setting")
    for wall in walls:
        side = side_of(wall)
        at = start.get(f"wall_{side}", wall.point[0 if side in ("left", "right") else 1])
        far = start.get(f"range_{side}", WALL_RANGE)
        meaning = "position at which the ball's centre is reflected"
        known.append(Parameter(f"wall_{side}", at - far, at + far, (at,), at, "m", meaning))
    also = [one.name for one in known[len(form) + len(ON_WALL) :] if not one.origin or one.name in setting.fit]
    every = decided(law, setting, known, also)
    free = {name: _begun(one, start) for name, one in every.items() if one.free}
    model = TrackModel(
        law, setting, tuple(walls), free, {name: one.value for name, one in every.items() if not one.free}
    )
    shared = tuple(SharedNumber(name, one.value, one.low, one.high, one.high - one.low) for name, one in free.items())
    return replace(model, start=affine_table(model.scene, shared))


def _begun(one: Parameter, start: Mapping[str, float]) -> Parameter:
    """Return a free parameter with the value from which its search begins, off its bounds."""
    at = start.get(one.name, START_VALUES.get(one.name, one.tried[len(one.tried) // 2]))
    inside = START_MARGIN * (one.high - one.low)
    return replace(one, value=float(np.clip(at, one.low + inside, one.high - inside)))
