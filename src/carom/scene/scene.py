"""A scene: gravity, floor, walls, balls, and run settings, with the same names in Python and in TOML; and its validation.

The parts validate themselves; here the scene as a whole is checked: overlaps, numbers that a law needs, what a floor admits.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Sequence
from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator, Field, field_validator, model_validator
from pydantic_core.core_schema import ValidationInfo

from carom.bodies import State, Surface
from carom.core.geometry.curve_features import arc_address
from carom.core.geometry.features import CURVE, FALLS, FEATURES, GOES_ON, LEAVES, OVER, feature_normal, gap_to_feature
from carom.core.jit.kernel import Vec
from carom.errors import Fault, FaultList, shown
from carom.formatting import format_length, format_time
from carom.laws.law import CALLED_WALL, Law, Meeting
from carom.laws.registry import laws
from carom.laws.user import find_law
from carom.scene.among_balls import TOUCH, default_is_too_soft, name_faults, overlap_faults, stiffness_faults
from carom.scene.ball import SceneBall
from carom.scene.ball_contact import BallContact
from carom.scene.feature_builders import Feature
from carom.scene.floor import Floor, gravity_on_slope
from carom.scene.rack import Rack
from carom.scene.restitution import Constant
from carom.scene.schema import (
    Acceleration,
    Components,
    Count,
    Model,
    Number,
    Time,
    raise_faults,
    refused,
)
from carom.scene.shapes import AnyWall
from carom.scene.wall import LawChoice, WallShape, format_vector, law_name

__all__ = ["Run", "Scene", "scene_faults"]


class Run(Model):
    """Run settings: the law of the walls, and when to stop.

    Parameters
    ----------
    law : law of the walls: a name of carom.LAWS, "file.py:name", or a carom.Law; default: "two-step"
    duration : s; default: no limit
    max_events : whole number; default: no limit
    floor_contact : "with" (default): wall and floor act at once on a ball that the wall presses on the floor; "after": one after
        the other

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> carom.Run(law="no-slip", duration="500 ms").duration
    0.5
    """

    law: LawChoice = "two-step"
    duration: Time | None = None
    max_events: Count | None = None
    floor_contact: Literal["with", "after"] = "with"


_GRAVITY = Number("an acceleration in m/s^2, or 3 of them", "m/s^2")
_VECTOR = Components(_GRAVITY.what, (3,))


def _gravity(value: Any) -> tuple[Any, ...]:
    several = isinstance(value, (list, tuple)) or (isinstance(value, np.ndarray) and value.ndim > 0)
    return _VECTOR(value) if several else (0.0, 0.0, -_GRAVITY(value))


class Scene(Model):
    """Gravity, floor, walls, balls, and run settings.

    Parameters
    ----------
    gravity : m/s^2: a number, downwards, or 3 numbers; default: 9.80665
    floor : Floor; default: none
    walls : walls of any shape (:mod:`carom.scene`); default: none
    rack : Rack: which balls lie in a rack, and the gaps between them; default: none
    balls : SceneBalls, at least one
    ball_contact : BallContact; default: elastic, without friction
    run : Run; default: the two-step law, no limits

    Parts may also be given as dicts of their fields, a wall with its ``shape``. A scene is validated as a whole when it is made:
    overlaps, and numbers that a law needs. Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.85, friction=0.2)
    >>> ball = carom.SceneBall(radius=0.03, mass=0.2, position=(1, 0), velocity=(-2, 1), rolling=True)
    >>> scene = carom.Scene(floor=carom.Floor(friction=0.2), walls=[wall], balls=[ball], run=carom.Run(duration=2))
    >>> scene.describe()
    'a floor, a plane through (0, 0, 0) with normal (1, 0, 0), 1 ball, law two-step, 2 s'
    """

    gravity: Annotated[tuple[Acceleration, Acceleration, Acceleration], BeforeValidator(_gravity)] = (
        0.0,
        0.0,
        -9.80665,
    )
    floor: Floor | None = None
    walls: tuple[AnyWall, ...] = ()
    rack: Rack | None = None
    balls: Annotated[tuple[SceneBall, ...], Field(validate_default=True)] = ()
    ball_contact: BallContact = BallContact()
    run: Run = Run()

    @field_validator("balls")
    @classmethod
    def _placed(cls, balls: tuple[SceneBall, ...], info: ValidationInfo) -> tuple[SceneBall, ...]:
        """Balls with three numbers for a position: on the floor, or in the plane z = 0; of a rack, with its gaps."""
        if not balls:
            raise refused("at least one ball", "none", "a file has a table [[balls]] for each")
        floor, rack = info.data.get("floor"), info.data.get("rack")
        placed = tuple(
            ball
            if len(ball.position) == 3
            else ball.model_copy(update={"position": (*ball.position, ball.radius if floor else 0.0)})
            for ball in balls
        )
        names = _names(placed)
        if rack is None or rack.gap is None or rack.faults(names, placed):
            return placed
        first = placed[names.index(rack.balls[0])]
        laid = dict(zip(rack.balls, rack.places(first.center, first.radius), strict=True))
        return tuple(
            ball.model_copy(update={"position": laid[name]}) if name in laid else ball
            for name, ball in zip(names, placed, strict=True)
        )

    @model_validator(mode="after")
    def _sound(self) -> Scene:
        if default_is_too_soft(self.ball_contact, self.balls):
            # (nobody gave these balls a modulus, so their contacts take no time)
            object.__setattr__(self, "ball_contact", self.ball_contact.model_copy(update={"overlap": False}))
            self.model_fields_set.add("ball_contact")
        raise_faults(scene_faults(self))
        return self

    @property
    def pull(self) -> tuple[float, float, float]:
        """Return the acceleration of balls in flight, m/s^2, along the axes of the floor: gravity, turned by the floor's slope."""
        slope = (0.0, 0.0) if self.floor is None else self.floor.slope
        return gravity_on_slope(-self.gravity[2], slope) if any(slope) else self.gravity

    @property
    def wall_laws(self) -> tuple[str | Law, ...]:
        """Return the law of each wall as it was given: its own, or the run's."""
        return tuple(wall.law or self.run.law for wall in self.walls)

    @property
    def given_laws(self) -> tuple[str | Law, ...]:
        """Return every law as it was given, each once: the run's, those of walls, that of pairs."""
        return tuple(dict.fromkeys((self.run.law, *self.wall_laws, self.ball_contact.law)))

    @functools.cached_property
    def found_laws(self) -> dict[str | Law, Law]:
        """Laws by their names in the scene: a custom law's file is run once. (A copy with other walls shares them.)"""
        return {}

    @functools.cached_property
    def kept(self) -> dict[str, Any]:
        """Return objects computed from this scene, by name, such as its arrays; neither a copy nor a pickle takes it along."""
        return {}

    def __getstate__(self) -> dict[Any, Any]:
        """Pickle what was declared: laws are found again by their names."""
        state = super().__getstate__()
        return {**state, "__dict__": {k: v for k, v in state["__dict__"].items() if k not in ("found_laws", "kept")}}

    def __copy__(self) -> Scene:
        """Copy what was declared, and the laws found (``model_copy`` then changes some of it)."""
        copied = super().__copy__()
        copied.__dict__.pop("kept", None)
        return copied

    def __deepcopy__(self, memo: dict[int, Any] | None = None) -> Scene:
        """Copy as :meth:`__copy__` does: the parts cannot be changed, so that copies share them."""
        return self.__copy__()

    def _found(self, law: str | Law) -> Law:
        if law not in self.found_laws:
            self.found_laws[law] = law if isinstance(law, Law) else find_law(law)
        return self.found_laws[law]

    @property
    def laws(self) -> tuple[Law, ...]:
        """The law of each wall."""
        return tuple(map(self._found, self.wall_laws))

    @property
    def pair_law(self) -> Law:
        """The law by which two balls meet."""
        return self._found(self.ball_contact.law)

    @property
    def called_laws(self) -> tuple[Law, ...]:
        """The laws that the event loop calls by their address: each once, in the order of the walls, then that of pairs."""
        called = [law for law in self.laws if law.response == CALLED_WALL]
        return tuple(dict.fromkeys(called if self.pair_law.one_contact else [*called, self.pair_law]))

    def features(self) -> NDArray[np.void]:
        """Return all that a ball can touch, (F,) of :data:`carom.core.geometry.features.FEATURES`, wall by wall.

        ``law`` is the law's response; from CALLED_WALL on, its place in ``called_laws``. In the place of the tangential
        restitution stands the last number that the law reads: stiffness ratio, or friction of the floor.
        """
        rows: list[tuple[Any, ...]] = []
        pockets = 0  # of the features before
        for i, (wall, law) in enumerate(zip(self.walls, self.laws, strict=True)):
            number, contact = law.response, wall.contact_of(law)
            if number == CALLED_WALL:
                number += self.called_laws.index(law)
            if law.last == "floor_friction":
                contact = contact._replace(beta=0.0 if self.floor is None else self.floor.contact.mu)
            gate = LEAVES if wall.encloses else GOES_ON
            for *shape, pocket in wall.features():
                times, ends = (wall.contact_time, wall.yield_time), (gate, 0) if pocket < 0 else (FALLS, pockets)
                rows.append((*shape, i, *contact, *times, number, *ends))
                pockets += pocket >= 0
        found = np.array(rows, dtype=FEATURES)
        found["at"][found["kind"] == CURVE] = arc_address(compiled=False)
        return found

    @property
    def wall_names(self) -> tuple[str, ...]:
        """Return the walls' names; of one without, its shape and its number."""
        return tuple(wall.name or f"{wall.kind} {i}" for i, wall in enumerate(self.walls))

    @property
    def pocket_names(self) -> tuple[str, ...]:
        """Return the names of all pockets, wall by wall."""
        return tuple(pocket.name for wall in self.walls for pocket in wall.pockets)

    @property
    def ball_names(self) -> tuple[str, ...]:
        """Return the balls' names; of one without, its number."""
        return _names(self.balls)

    def describe(self) -> str:
        """Return one line: floor, walls, balls, laws, limits of the run."""
        words = [wall.describe() for wall in self.walls]
        shown = words if len(words) <= 3 else [*words[:2], f"{len(words) - 2} more walls"]
        floor = [] if self.floor is None else ["a tilted floor" if any(self.floor.slope) else "a floor"]
        balls = f"{len(self.balls)} ball{'s' if len(self.balls) > 1 else ''}"
        if self.rack is not None and self.rack.gap is not None:
            balls += f" ({self.rack.describe()})"
        laws = dict.fromkeys(map(law_name, self.wall_laws)) or {law_name(self.run.law): None}
        law = f"law{'s' if len(laws) > 1 else ''} {' and '.join(laws)}"
        pair = law_name(self.ball_contact.law)
        law += "" if pair == "contact" else f", balls by {pair}"
        run = [] if self.run.duration is None else [format_time(self.run.duration)]
        run += [] if self.run.max_events is None else [f"at most {self.run.max_events:,} events"]
        return ", ".join([*floor, *shown, balls, law, *run])


def _names(balls: Sequence[SceneBall]) -> tuple[str, ...]:
    return tuple(ball.name or f"ball {i}" for i, ball in enumerate(balls))


def scene_faults(scene: Scene) -> list[Fault]:
    """Return all problems of a scene whose parts are valid."""
    among = [*name_faults(scene.balls, scene.ball_names), *overlap_faults(scene.balls)]
    among += stiffness_faults(scene.ball_contact, scene.balls)
    among += [] if scene.rack is None else scene.rack.faults(scene.ball_names, scene.balls)
    return [*_floor_faults(scene), *_law_faults(scene), *_wall_overlaps(scene), *among]


# --- floor --------------------------------------------------------------------------------------------------------


def _floor_faults(scene: Scene) -> list[Fault]:
    found = FaultList()
    gx, gy, gz = scene.gravity
    if scene.floor is None and gz < 0 and (tables := [i for i, wall in enumerate(scene.walls) if wall.kind == "table"]):
        advice = "a table is its cushions alone, and balls would fall: add a floor, or set gravity = 0"
        found.add(f"walls[{tables[0]}]", "a floor, as there is a table", "none", advice)
    if scene.floor is not None and (gx != 0 or gy != 0 or gz > 0):
        advice = "for a tilted floor give floor.slope, such as [0.001, 0] for a fall of 1 mm per metre along x"
        got = format_vector(scene.gravity)
        found.add("gravity", "gravity along -z, as there is a floor", got, advice if gx or gy else "")
    for i, ball in enumerate(scene.balls):
        z, a = ball.center[2], ball.radius
        if scene.floor is not None and z < a * (1 - TOUCH):
            got = f"{z:.6g}, which overlaps the floor by {format_length(a - z)}"
            advice = "leave out z to put it on the floor"
            found.add(f"balls[{i}].position[2]", f"z of at least the radius, {a:.6g}", got, advice)
        elif ball.rolling and scene.floor is None:
            found.add(f"balls[{i}].rolling", "a floor to roll on", "true in a scene without one")
        elif ball.rolling and z > a * (1 + TOUCH):
            got, advice = f"{z:.6g} of a ball that rolls", "leave out z, or rolling"
            found.add(f"balls[{i}].position[2]", f"z = radius = {a:.6g}", got, advice)
    return found


# --- laws ---------------------------------------------------------------------------------------------------------


def _law_faults(scene: Scene) -> list[Fault]:
    found = FaultList()
    for i, (wall, law) in enumerate(zip(scene.walls, scene.laws, strict=True)):
        at = f"walls[{i}]"
        for name, expected in NEEDED.items():
            if name in law.needs and getattr(wall, name) is None:
                others = [
                    one.name for one in laws().values() if not (name in one.needs or one.variant_of or one.on_table)
                ]
                advice = f"the law {law.name} reads it; {', '.join(others)} do not need it"
                found.add(f"{at}.{name}", expected, "nothing", advice)
        got = {
            "shape": (wall.describe(), at),
            "floor": ("a scene without a floor", f"{at}.law" if wall.law else "run.law"),
        }
        found += _condition_faults(scene, wall, law, at, got, wall.stiffness_ratio, wall.vertical)
    pair = scene.ball_contact
    return [*found, *_condition_faults(scene, pair, scene.pair_law, "ball_contact", {}, pair.tangential_stiffness)]


NEEDED = {"restitution": "a number from 0 to 1, or a form", "friction": "a number >= 0 (inf: never slips)"}


def _condition_faults(
    scene: Scene, surface: WallShape | BallContact, law: Law, at: str, got: dict[str, tuple[str, str]], stiffness_ratio: float,
    vertical: Callable[[float], bool] = lambda z: True,
) -> list[Fault]:  # fmt: skip
    """Ask a law's conditions on what a scene declares (a wall, the floor, the pairs) of each ball, coming square to the surface.

    (The one ball that two are to each other has an inertia between theirs.)
    """
    found: dict[str, Fault] = {}
    restitution = surface.restitution
    e = 1.0 if restitution is None else restitution.value if isinstance(restitution, Constant) else 0.5
    got |= {
        "restitution": ("" if restitution is None else restitution.describe().removeprefix("restitution "),
                        f"{at}.restitution"),
        "stiffness_ratio": (shown(stiffness_ratio), f"{at}.stiffness_ratio"),
    }  # fmt: skip
    for ball in {(ball.ball.kappa, ball.radius): ball for ball in scene.balls}.values():
        towards = State((-1.0, 0.0, 0.0), (0.0, -1.0 / ball.radius if scene.floor else 0.0, 0.0))
        normal = np.array([1.0, 0.0, 0.0] if vertical(ball.radius) else [0.8, 0.0, 0.6])
        meeting = Meeting(ball.ball, towards, normal, Surface(e), stiffness_ratio=stiffness_ratio)
        for holds, expected, *field in law.conditions(meeting):
            if field and field[0] in got and not np.all(holds):
                value, place = got[field[0]]
                found.setdefault(field[0], Fault("", place, f"{expected}, for the law {law.name}", value))
    faults = list(found.values())
    if law.last == "stiffness_ratio" and surface.tangential_restitution != 0:
        advice = "that law computes the tangential rebound from springs; omit it, and give stiffness_ratio"
        got_beta = shown(surface.tangential_restitution)
        faults.append(Fault("", f"{at}.tangential_restitution", f"0 for the law {law.name}", got_beta, advice))
    return faults


# --- walls --------------------------------------------------------------------------------------------------------


def _wall_overlaps(scene: Scene) -> list[Fault]:
    found = FaultList()
    largest = max(range(len(scene.balls)), key=lambda i: scene.balls[i].radius)
    for k, wall in enumerate(scene.walls):
        name = f"walls[{k}] ({scene.wall_names[k]})"
        if scene.balls[largest].radius >= wall.room:
            expected = f"room for a ball of radius {format_length(scene.balls[largest].radius)} (balls[{largest}])"
            got = f"room for radii below {format_length(wall.room)}"
            found.add(f"walls[{k}]", expected, got, "make the wall larger, or the ball smaller")
            continue
        found += _rolls_under(scene, wall, k)
        features = [feature for feature in wall.features() if feature.kind != OVER]
        for i, ball in enumerate(scene.balls):
            at = f"balls[{i}].position"
            if wall.blocked(ball.center):
                got = f"{format_vector(ball.center)}, where {wall.describe()} lets no ball be"
                advice = "move the ball" + ("; or turn the normal round" if wall.kind == "plane" else "")
                found.add(at, f"a place on the free side of {name}", got, advice)
            else:
                found += _overlap(ball, features, name, at)
    return found


def _rolls_under(scene: Scene, wall: WallShape, k: int) -> list[Fault]:
    """Report a table whose cushions a ball would roll under: there is nothing behind them."""
    nose = getattr(wall, "nose_height", None)
    smallest = min(range(len(scene.balls)), key=lambda i: scene.balls[i].radius)
    diameter = 2 * scene.balls[smallest].radius
    if nose is None or nose < diameter:
        return []
    expected = f"less than {format_length(diameter)}, the diameter of balls[{smallest}], which would roll under it"
    return [
        Fault(
            "", f"walls[{k}].nose_height", expected, shown(nose), "a cushion's nose stands at 5/4 to 7/5 of the radius"
        )
    ]


def _overlap(ball: SceneBall, features: list[Feature], name: str, at: str) -> list[Fault]:
    """Report the deepest overlap of a ball with a wall; a face that the ball is behind does not count."""
    a, x = ball.radius, ball.center
    gaps = [gap_to_feature(feature, a, x) for feature in features]
    gap = min((gap for gap in gaps if gap >= -a), default=math.inf)
    if gap >= -TOUCH * a:
        return []
    n: Vec = feature_normal(features[gaps.index(gap)], x)
    place = (x[0] - (gap + a) * n[0], x[1] - (gap + a) * n[1], x[2] - (gap + a) * n[2])
    got = f"{format_vector(x)}, which overlaps {name} by {format_length(-gap)} at {format_vector(place)}"
    return [Fault("", at, "a place where the ball touches nothing", got, f"move it by {format_length(-gap)} or more")]
