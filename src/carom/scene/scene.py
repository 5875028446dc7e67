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
from carom.core.geometry.curve_arcs import arc_address
from carom.core.geometry.features import CURVE, FALLS, FEATURES, GOES_ON, LEAVES
from carom.errors import Fault, FaultList, shown
from carom.formatting import format_time, json_value
from carom.laws.law import CALLED_WALL, Law, Meeting
from carom.laws.pair import YOUNG
from carom.laws.registry import find_law, laws
from carom.scene.air import SceneAir, air_faults, has_no_overlap
from carom.scene.ball import BallContact, Rack, SceneBall, default_is_too_soft, fastest, near_pairs
from carom.scene.floor import Floor, gravity_on_slope
from carom.scene.restitution import Constant
from carom.scene.ruled import (
    COLUMNS,
    LAW_FAULTS,
    NEEDED,
    SCENE_FAULTS,
    BallRow,
    filled,
    floor_faults,
    gravity_faults,
    name_fault,
    pair_fault,
    stiffness_faults,
    wall_faults,
)
from carom.scene.schema import Acceleration, Components, Count, Model, Number, Time, raise_faults, refused
from carom.scene.shapes import AnyWall
from carom.scene.wall import LawChoice, WallShape, law_name


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


GRAVITY = Number("an acceleration in m/s^2, or 3 of them", "m/s^2")
_VECTOR = Components(GRAVITY.what, (3,))


def _gravity(value: Any) -> tuple[Any, ...]:
    several = isinstance(value, (list, tuple)) or (isinstance(value, np.ndarray) and value.ndim > 0)
    return _VECTOR(value) if several else (0.0, 0.0, -GRAVITY(value))


class Scene(Model):
    """Gravity, floor, walls, balls, and run settings.

    Parameters
    ----------
    gravity : m/s^2: a number, downwards, or 3 numbers; default: 9.80665
    floor : Floor; default: none
    air : SceneAir (:class:`carom.scene.SceneAir`); default: none
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
    air: SceneAir | None = None
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
        untimed = len(self.balls) > 1 and has_no_overlap(self.air, list(self.ball_contact.model_fields_set))
        if self.ball_contact.overlap and (untimed or default_is_too_soft(self.ball_contact, self.balls)):
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
        """Return every law as it was given, each once: of the run, of walls, of pairs."""
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
        """The laws that the event loop calls by their address: each once, in the order of the walls, then the law of pairs."""
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
            number, contacts = law.response, wall.contacts_of(law)
            if number == CALLED_WALL:
                number += self.called_laws.index(law)
            if law.last == "floor_friction":
                mu = 0.0 if self.floor is None else self.floor.contact.mu
                contacts = tuple(one._replace(beta=mu) for one in contacts)
            gate = LEAVES if wall.encloses else GOES_ON
            for feature in wall.features():
                *shape, pocket = feature
                times, ends = (wall.contact_time, wall.yield_time), (gate, 0) if pocket < 0 else (FALLS, pockets)
                rows.append((*shape, i, *contacts[feature.cushion], *times, number, *ends))
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
        floor += [] if self.air is None else ["air"]
        return ", ".join([*floor, *shown, balls, law, *run])


def _names(balls: Sequence[SceneBall]) -> tuple[str, ...]:
    return tuple(ball.name or f"ball {i}" for i, ball in enumerate(balls))


def scene_faults(scene: Scene) -> list[Fault]:
    """Return all problems of a scene whose parts are valid."""
    balls = _ball_rows(scene)
    rack = [] if scene.rack is None else scene.rack.faults(scene.ball_names, scene.balls)
    return [
        *_floor_faults(scene, balls),
        *air_faults(scene),
        *_law_faults(scene),
        *_wall_faults(scene, balls),
        *_among_balls(scene, balls),
        *rack,
    ]


def _ball_rows(scene: Scene) -> list[BallRow]:
    names = scene.ball_names
    first = {name: len(names) - 1 - i for i, name in enumerate(reversed(names))}
    return [
        BallRow(*ball.center, ball.radius, ball.rolling, first[name], bool(ball.name))
        for ball, name in zip(scene.balls, names, strict=True)
    ]


def _told(scene: Scene, rows: NDArray[np.float64]) -> list[Fault]:
    """Return the faults of rows that kernels have written."""
    found = []
    for code, one, other, *numbers in rows.tolist():
        i, k = int(one), int(other)
        values = {"i": i, "k": k, "gravity": scene.gravity, "ball_contact": scene.ball_contact, "ball": scene.balls[i]}
        values |= {"name": scene.ball_names[i], **dict(zip("abcd", numbers, strict=True)), "place": tuple(numbers[1:])}
        if k < len(scene.walls):
            values["wall"] = f"walls[{k}] ({scene.wall_names[k]})"
        found.append(filled(SCENE_FAULTS[int(code)], values))
    return found


def _floor_faults(scene: Scene, balls: list[BallRow]) -> list[Fault]:
    out, floor = np.empty((len(balls) + 1, COLUMNS)), scene.floor is not None
    table = next((k for k, wall in enumerate(scene.walls) if wall.kind == "table"), -1)
    row = gravity_faults(scene.gravity, floor, table, 0, out)
    for i, ball in enumerate(balls):
        row = floor_faults(i, ball.z, ball.radius, bool(ball.rolling), floor, row, out)
    return _told(scene, out[:row])


def _wall_faults(scene: Scene, balls: list[BallRow]) -> list[Fault]:
    radii = [ball.radius for ball in balls]
    least, most = radii.index(min(radii)), radii.index(max(radii))
    found: list[Fault] = []
    for k, wall in enumerate(scene.walls):
        out = np.empty((len(balls) + 1, COLUMNS))
        features, nose = wall.features(), getattr(wall, "nose_height", None)
        blocked = [wall.blocked(ball.center) for ball in scene.balls]
        row = wall_faults(
            k, wall.kind == "plane", wall.room, math.nan if nose is None else nose, least, most, balls, blocked, features, 0,
            len(features), 0, out,
        )  # fmt: skip
        found += _told(scene, out[:row])
    return found


def _among_balls(scene: Scene, balls: list[BallRow]) -> list[Fault]:
    pairs, pair = near_pairs(scene.balls), scene.ball_contact
    out, row = np.empty((len(balls) + len(pairs) + 2, COLUMNS)), 0
    for i in range(len(balls)):
        row = name_fault(i, balls, row, out)
    for one, two in pairs:
        row = pair_fault(two, one, balls, row, out)
    if pair.modulus > 0 and len(balls) > 1 and pair.young != YOUNG:
        row = stiffness_faults(pair.young, pair.modulus, *fastest(scene.balls), row, out)
    return _told(scene, out[:row])


# --- laws ---------------------------------------------------------------------------------------------------------


def needed_faults(law: Law) -> dict[str, dict[str, str]]:
    """Return the values of the fault of a wall without what a law needs, by the field that is missing."""
    known = [one for one in laws().values() if not (one.variant_of or one.on_table)]
    return {
        name: {
            "name": name, "expected": expected, "law": law.name,
            "others": ", ".join(one.name for one in known if name not in one.needs),
        }
        for name, expected in NEEDED.items() if name in law.needs
    }  # fmt: skip


def _law_faults(scene: Scene) -> list[Fault]:
    found = FaultList()
    for i, (wall, law) in enumerate(zip(scene.walls, scene.laws, strict=True)):
        at = f"walls[{i}]"
        missing = [values for name, values in needed_faults(law).items() if getattr(wall, name) is None]
        found += [filled(LAW_FAULTS["needed"], {"at": at, **values}) for values in missing]
        places = {"shape": at, "floor": f"{at}.law" if wall.law else "run.law"}
        found += _condition_faults(scene, wall, law, at, places, wall.stiffness_ratio, wall.vertical)
        for part, own in wall.own_surfaces.items():
            faults = _condition_faults(scene, own, law, f"{at}.{part}", {}, own.stiffness_ratio, own.vertical)
            found += [fault for fault in faults if fault.field.endswith(".restitution")]
    pair = scene.ball_contact
    return [*found, *_condition_faults(scene, pair, scene.pair_law, "ball_contact", {}, pair.tangential_stiffness)]


def _condition_faults(
    scene: Scene, surface: WallShape | BallContact, law: Law, at: str, places: dict[str, str], stiffness_ratio: float,
    vertical: Callable[[float], bool] = lambda z: True,
) -> list[Fault]:  # fmt: skip
    """Ask a law's conditions on what a scene declares (a wall, the floor, the pairs) of each ball, coming square to the surface.

    (The one ball that two are to each other has an inertia between theirs.)
    """
    unmet: dict[str, str] = {}
    r = surface.restitution
    e = 1.0 if r is None else r.value if isinstance(r, Constant) else 0.5
    for ball in {(ball.ball.kappa, ball.radius): ball for ball in scene.balls}.values():
        towards = State((-1.0, 0.0, 0.0), (0.0, -1.0 / ball.radius if scene.floor else 0.0, 0.0))
        normal = np.array([1.0, 0.0, 0.0] if vertical(ball.radius) else [0.8, 0.0, 0.6])
        meeting = Meeting(ball.ball, towards, normal, Surface(e), stiffness_ratio=stiffness_ratio)
        for holds, expected, *field in law.conditions(meeting):
            if field and field[0] and not np.all(holds):
                unmet.setdefault(field[0], expected)
    got = {name: filled(LAW_FAULTS[name], {"shape": getattr(surface, "shape", "")}).got for name in places}
    got |= {
        "restitution": f"{r.value:g}" if isinstance(r, Constant)
        else "" if r is None else filled(LAW_FAULTS["restitution"], {"form": r.form}).got,
        "stiffness_ratio": shown(stiffness_ratio),
    }  # fmt: skip
    found = [
        filled(LAW_FAULTS["unmet"], {
            "at": places.get(field, f"{at}.{field}"), "expected": expected, "law": law.name, "got": got[field],
        })
        for field, expected in unmet.items() if field in got
    ]  # fmt: skip
    if law.last == "stiffness_ratio" and surface.tangential_restitution != 0:
        found.append(filled(LAW_FAULTS["springs"], {"at": at, "law": law.name, "beta": surface.tangential_restitution}))
    return found


# ----------------------------------------------------------------------------------------------------
# A validated scene as plain data for JSON: SI numbers, every default filled in.


def scene_dict(scene: Scene) -> dict[str, Any]:
    """Return a scene as lists, dicts and SI numbers, with the names of a scene file; infinity is the string "inf".

    Nothing is left to be inferred from other fields but the spin of a ball that rolls, which follows from its velocity (27) with
    ``spin_z``: every ``inertia`` is a number, every position has three (a rack has become positions), and a ball that does not roll
    has a ``spin``. The sides of a table are there only where they differ. What is not there is None: a floor, a name, a limit of
    the run, a wall's own law or a surface's number that its law does not read.

    Examples
    --------
    >>> import carom
    >>> ball = carom.SceneBall(radius="30 mm", mass=0.2, position=(1, 0), velocity=(-2, 1), rolling=True)
    >>> scene = carom.Scene(floor=carom.Floor(friction=float("inf")), balls=[ball])
    >>> found = scene_dict(scene)
    >>> found["floor"]["friction"], found["balls"][0]["position"], found["balls"][0]["inertia"]
    ('inf', [1.0, 0.0, 0.03], 0.4)
    """
    found = plain_model(scene)
    del found["rack"]
    if scene.air is not None:
        air = scene.air
        found["air"] = {"density": air.rho, "viscosity": air.eta, "wind": list(air.wind), "buoyancy": air.buoyancy}
    else:
        for part in (found, *found["balls"]):
            for name in ("air", "drag", "lift", "spin_decay"):
                part.pop(name, None)
    for entry, wall in zip(found["walls"], scene.walls, strict=True):
        if "sides" in entry and not wall.own_surfaces:
            del entry["sides"]
    for entry, ball in zip(found["balls"], scene.balls, strict=True):
        entry["inertia"] = float(ball.ball.kappa)
        if entry.pop("strike") is not None:
            entry["velocity"], entry["spin"] = ball.state.velocity.tolist(), ball.state.spin.tolist()
            continue
        if ball.rolling:
            entry["spin_z"] = ball.spin_z or 0.0
        else:
            entry["spin"] = list(ball.spin or (0.0, 0.0, 0.0))
    return found  # type: ignore[no-any-return]


def plain_model(model: Model) -> Any:
    """Return a model as lists, dicts and numbers; infinity is the string "inf"."""
    return json_value(model.model_dump(mode="json"), infinite=True)
