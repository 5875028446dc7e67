"""Record what carom answers, as hashes; later, compare another version with the record: are the bits the same?

    python campaigns/bits.py --out record.json
    python campaigns/bits.py --against record.json
    python campaigns/bits.py --against record.json --only laws,scenes

The groups: ``laws`` (every law, arrays and single states), ``scenes`` (random scenes), ``orbits`` (billiards),
``gases`` (with a checkpoint in the middle), ``cli`` (what the commands print), ``fits`` (statistics). A case is
recorded as a hash of all its numbers. Two kinds are not: texts for people are kept as texts, and fits are kept as
numbers, because both may change on purpose. Of these a comparison tells what has changed, but only hashes that differ,
cases that are missing and commands that fail make the exit code 1.

Only public names and the command line are used, so that modules may move. The carom that is looked at is the one that
this Python imports. The same bits can be asked for only on the same kind of processor, with the same NumPy and Numba:
the record says which. Some five minutes on one core, when the compiled loops are in the cache.
"""

from __future__ import annotations

import argparse
import csv
import hashlib
import importlib
import json
import math
import os
import subprocess
import sys
import tempfile
import time
import traceback
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import carom
from carom import gas as gases_of

Array = NDArray[Any]
Case = tuple[str, Any]
# What sentences for people stand under, in JSON: kept as text. What depends on the clock or on the machine: left out.
WORDS = {"why", "remarks", "title", "note", "notes", "summary", "assumptions", "valid", "citation", "ended"}
PASSING = {"cpu_seconds", "seconds", "path"}
COUNT = 100_000  # states a law
SINGLE = 20  # of them one at a time
SCENES = 200
BOUNCES = 2000


# --- where commands run ---------------------------------------------------------------------------------------------


class FailedError(Exception):
    """A command that ended with another code than 0."""


class Place:
    """Where commands run: a folder of their own, under the same names each time."""

    def __init__(self, root: Path, folder: Path, say: Callable[[str], None]) -> None:
        self.root, self.folder, self.say, self._count = root, folder, say, 0

    def empty(self) -> Path:
        """A new folder."""
        self._count += 1
        found = self.folder / f"{self._count}"
        found.mkdir()
        return found

    def command(self, *words: str, folder: Path | None = None) -> str:
        """What ``carom`` prints for these words. FailedError where it ends with a fault."""
        plain = {k: v for k, v in os.environ.items() if k not in ("FORCE_COLOR", "CLICOLOR", "CLICOLOR_FORCE")}
        done = subprocess.run(
            [sys.executable, "-m", "carom", *words],
            cwd=folder or self.folder,
            env=plain | {"COLUMNS": "120", "NO_COLOR": "1", "PYTHONIOENCODING": "utf-8"},
            capture_output=True,
            encoding="utf-8",
            check=False,
        )
        if done.returncode != 0:
            raise FailedError(f"carom {' '.join(words)}: code {done.returncode}: {done.stderr.strip()[-600:]}")
        return done.stdout


# --- hashes --------------------------------------------------------------------------------------------------------


def digest(*things: Any) -> str:
    """A hash of numbers, texts, arrays and what is made of them: of values and shapes, not of how they are stored."""
    total = hashlib.sha256()
    for thing in things:
        _feed(total.update, thing)
    return total.hexdigest()


def _feed(put: Callable[[bytes], None], thing: Any) -> None:
    if thing is None:
        put(b"none;")
    elif isinstance(thing, str):
        put(f"text {len(thing)};{thing}".encode())
    elif isinstance(thing, carom.State):
        _feed(put, [thing.velocity, thing.spin, thing.position])
    elif isinstance(thing, dict):
        put(f"table {len(thing)};".encode())
        for key in sorted(thing):
            _feed(put, key)
            _feed(put, thing[key])
    elif isinstance(thing, list | tuple):
        put(f"list {len(thing)};".encode())
        for part in thing:
            _feed(put, part)
    else:
        _feed_array(put, np.asarray(thing))


def _feed_array(put: Callable[[bytes], None], array: Array) -> None:
    if array.dtype.names is not None:  # field by field: what lies between fields is anything
        _feed(put, {name: array[name] for name in array.dtype.names})
    elif array.dtype.kind in "USO":
        put(f"texts {array.shape};".encode() + "\0".join(map(str, array.ravel().tolist())).encode())
    elif array.dtype.kind in "biu":
        wide = array.astype(np.uint64 if array.dtype == np.uint64 else np.int64)
        put(f"whole {array.shape};".encode() + wide.tobytes())
    elif array.dtype.kind == "f":
        wide = array.astype(np.float64)
        put(f"real {array.shape};".encode() + np.where(np.isnan(wide), np.nan, wide).tobytes())
    else:
        raise TypeError(f"digest: expected numbers or texts, got an array of {array.dtype}")


def labels(names: Any) -> list[int]:
    """Names as numbers, in the order in which they first come, so that they may be worded anew."""
    known: dict[str, int] = {"": 0}
    return [known.setdefault(str(name), len(known)) for name in np.asarray(names).ravel()]


def generator(*name: Any) -> np.random.Generator:
    """Random numbers of a case's own: no case depends on what is done before it."""
    return np.random.default_rng(list(" ".join(map(str, name)).encode()))


# --- laws ----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Shots:
    """Balls (N) on their way to walls, each with a wall and a floor of its own; or, without arrays, one of them."""

    planar: bool
    radius: Any
    mass: Any
    kappa: Any
    velocity: Any
    spin: Any
    normal: Any
    wall: Any
    floor: Any
    height: Any
    stiffness: Any

    def __getitem__(self, index: Any) -> Shots:
        """Some of them; or one, with plain numbers."""

        def part(x: Any) -> Any:
            return x.item() if isinstance(x, np.generic) else x

        fields = {name: part(x[index]) for name, x in vars(self).items() if isinstance(x, np.ndarray)}
        surfaces = {name: tuple(part(x[index]) for x in getattr(self, name)) for name in ("wall", "floor")}
        return replace(self, **fields, **surfaces)

    @property
    def ball(self) -> carom.Ball:
        """The balls, or discs."""
        return (carom.Disc if self.planar else carom.Ball)(self.radius, self.mass, self.kappa)

    @property
    def state(self) -> carom.State:
        """How they move."""
        return carom.State(self.velocity, self.spin)

    @property
    def surfaces(self) -> tuple[carom.Surface, carom.Surface]:
        """Wall and floor."""
        return carom.Surface(*self.wall), carom.Surface(*self.floor)

    def meeting(self, floor_contact: Any = "with") -> carom.Meeting:
        """As laws are asked."""
        wall, floor = self.surfaces
        return carom.Meeting(
            self.ball, self.state, self.normal, wall, floor, height=self.height, floor_contact=floor_contact,
            stiffness_ratio=self.stiffness,
        )  # fmt: skip


def shots(name: str, count: int, *, rolls: bool = False, planar: bool = False) -> Shots:
    """Balls that roll, slide, have backspin or fly, towards walls and cushions whose noses are low or high.

    ``rolls``: all of them roll, into upright elastic walls. ``planar``: discs.
    """
    rng = generator("shots", name)

    def any_of(*choices: Any) -> Array:
        rows = np.stack([np.broadcast_to(np.asarray(one, float), count) for one in choices])
        return np.asarray(rows[rng.integers(len(choices), size=count), np.arange(count)])

    def upto(low: float, high: float) -> Array:
        return rng.uniform(low, high, count)

    radius = upto(0.01, 0.05)
    kind = rng.integers(4, size=count)  # rolls, slides, backspin, flies
    if rolls or planar:
        kind[:] = 0 if rolls else 1
    velocity = rng.normal(size=(count, 3)) * upto(0.1, 5.0)[:, None]
    velocity[kind != 3, 2] = 0.0
    level = rng.normal(size=(count, 2))
    tilt = 0.0 * radius if rolls or planar else any_of(0.0, 0.0, upto(-0.6, 0.0), upto(-0.6, 0.0), upto(0.0, 0.4))
    level *= (np.sqrt(1 - tilt * tilt) / np.sqrt((level * level).sum(axis=1)))[:, None]
    normal = np.column_stack([level, tilt])
    normal[rng.random(count) < 0.2] = (1.0, 0.0, 0.0)
    velocity[(velocity * normal).sum(axis=1) > 0] *= -1.0
    spin = rng.normal(size=(count, 3)) * (upto(0.1, 5.0) / radius)[:, None]
    share = any_of(1.0, 1.0, -upto(0.2, 3.0))
    share[kind == 0], share[kind == 2] = 1.0, -upto(0.2, 3.0)[kind == 2]
    over = (kind == 0) | (kind == 2)
    spin[over, 0] = (-share * velocity[:, 1] / radius)[over]
    spin[over, 1] = (share * velocity[:, 0] / radius)[over]
    if planar:
        spin[:, :2] = 0.0

    def surface() -> tuple[Array, Array, Array]:
        return (
            any_of(0.0, 1.0, upto(0.0, 1.0), upto(0.0, 1.0)),
            any_of(0.0, math.inf, upto(0.0, 0.5), upto(0.0, 0.5)),
            any_of(0.0, 0.0, 0.0, -1.0, 1.0, upto(-1.0, 1.0)),
        )

    wall, floor = surface(), surface()
    # (a smooth wall of infinite friction that presses a ball down takes a second a ball and has no answer: left out)
    wall[1][(wall[1] == math.inf) & (wall[2] == -1.0)] = 0.3
    if rolls:
        wall = (np.ones(count), *wall[1:])
    return Shots(
        planar=planar,
        radius=radius,
        mass=upto(0.05, 0.5),
        kappa=any_of(0.5, 1.0, upto(0.1, 1.0)) if planar else any_of(0.4, 2 / 3, upto(0.05, 0.66)),
        velocity=velocity,
        spin=spin,
        normal=normal,
        wall=wall,
        floor=floor,
        height=np.where(kind == 3, upto(0.0, 0.1), 0.0),
        stiffness=upto(0.3, 2.0),
    )


def allowed(law: Any, balls: Shots, floor_contact: str = "with") -> Array:
    """(N,): where a law may be asked."""
    keep = np.ones(len(balls.radius), dtype=bool)
    for holds, _expected, *_field in law.conditions(balls.meeting(floor_contact)):
        keep &= np.broadcast_to(holds, keep.shape)
    return keep


def of_impact(hit: Any) -> list[Any]:
    """What an impact, or a collision, says."""
    return [hit.after, hit.impulse, hit.required_friction, hit.regime, hit.energy_lost]


def of_settled(then: Any) -> list[Any]:
    """What the floor made of a ball; and the wall before it, if that is a part of the answer."""
    found = [
        then.flight.duration, then.flight.height, then.flight.distance, then.after_floor, of_impact(then.floor),
        then.rolling, then.rolls, labels(then.why), then.reflection_angle,
    ]  # fmt: skip
    if hasattr(then, "after_wall"):
        found += [then.after_wall, of_impact(then.wall), then.floor_impulse]
    return found


def of_answer(answer: Any) -> list[Any]:
    """What a law says."""
    steps = [] if answer.steps is None else of_settled(answer.steps)
    return [answer.after_wall, answer.final, answer.required_wall, answer.required_floor, labels(answer.why), *steps]


def both_ways(name: str, balls: Shots, ask: Callable[[Shots], Any]) -> Iterator[Case]:
    """A question asked of all balls at once, and of the first of them one at a time."""
    yield f"{name}, arrays", digest(ask(balls))
    yield f"{name}, one by one", digest([ask(balls[k]) for k in range(SINGLE)])


def laws(_place: Place) -> Iterator[Case]:
    """Every law by name; then the functions that people call."""
    for name, law in carom.LAWS.items():
        contacts = ("with", "after") if name == "two-step" else ("with",)
        for floor_contact in contacts:
            balls = shots("laws", COUNT, rolls=name == "conventional")
            keep = allowed(law, balls, floor_contact)
            case = f"law {name}" + (f", {floor_contact}" if len(contacts) > 1 else "")
            yield f"{case}, where", digest(keep)

            def ask(some: Shots, law: Any = law, floor_contact: str = floor_contact) -> Any:
                return of_answer(law.answer(some.meeting(floor_contact)))

            yield from both_ways(case, balls[keep], ask)
        discs = shots("laws of discs", COUNT // 10, planar=True)
        keep = allowed(law, discs)
        if keep.any():
            yield from both_ways(f"law {name}, discs", discs[keep], ask)
    yield from verbs()
    yield from pairs()
    yield from comparisons()


def verbs() -> Iterator[Case]:
    """The functions for one ball and a wall."""
    balls, rolling = shots("verbs", COUNT), shots("verbs", COUNT, rolls=True)
    yield from both_ways("impact", balls, lambda b: of_impact(carom.impact(b.ball, b.state, b.normal, b.surfaces[0])))
    for floor_contact in ("with", "after"):

        def ask(b: Shots, floor_contact: Any = floor_contact) -> Any:
            wall, floor = b.surfaces
            found = carom.two_step(b.ball, b.state, wall, floor, b.normal, height=b.height, floor_contact=floor_contact)
            return of_settled(found)

        may = balls[allowed(carom.LAWS["two-step"], balls, floor_contact)]
        yield from both_ways(f"two_step, {floor_contact}", may, ask)
    yield from both_ways("mirror", balls, lambda b: carom.mirror(b.ball, b.state, b.normal, b.surfaces[0]))
    yield from both_ways("no_slip", balls, lambda b: carom.no_slip(b.ball, b.state, b.normal))
    yield from both_ways("conventional", rolling, lambda b: carom.conventional(b.ball, b.state, b.normal))
    yield from both_ways(
        "energy and slip", balls, lambda b: [carom.kinetic_energy(b.ball, b.state), carom.slip(b.ball, b.state)]
    )

    def settled(b: Shots) -> Any:
        after = carom.mirror(b.ball, b.state, b.normal)
        return of_settled(carom.settle(b.ball, after, b.surfaces[1], b.normal, height=b.height))

    yield from both_ways("settle", balls, settled)
    # one ball, one wall and one floor for all, into arrays that exist
    ball, towards = carom.Ball(), balls[(balls.velocity[:, 0] <= 0) & (balls.height == 0)]
    out = carom.State(0.0 * towards.velocity, 0.0 * towards.spin)
    carom.impact_into(out, ball, towards.state, surface=carom.Surface(0.9, 0.2, 0.3))
    yield "impact_into", digest(out)
    why = np.zeros(len(towards.velocity), dtype=np.int8)
    for normal in ((1.0, 0.0, 0.0), (1.0, 0.0, -0.4)):
        carom.two_step_into(
            out, why, ball, towards.state, carom.Surface(0.85, 0.2), carom.Surface(0.5, 0.2), normal=normal
        )
        yield f"two_step_into, normal {normal}", digest(out, labels(why))


def pairs() -> Iterator[Case]:
    """The functions for two balls."""
    one, two = shots("first of a pair", COUNT), shots("second of a pair", COUNT)
    line = np.where(((one.velocity - two.velocity) * one.normal).sum(axis=1) > 0, -1.0, 1.0)[:, None] * one.normal
    smooth = (*one.wall[:2], 0.0 * one.radius)
    angles = generator("angles").uniform(-1.5, 1.5, COUNT)
    level = one.velocity * (1.0, 1.0, 0.0)

    def collided(k: Any) -> Any:
        a, b = one[k], two[k]
        hit = carom.collide(a.ball, a.state, b.ball, b.state, line[k], a.surfaces[0])
        return [*hit.after, hit.impulse, hit.required_friction, hit.regime, hit.energy_lost]

    def scattered(k: Any) -> Any:
        a, b = replace(one, velocity=level, wall=smooth)[k], two[k]
        hit = carom.domenech(a.ball, a.state, b.ball, angles[k], a.surfaces[0])
        found = [*hit.collision.after, hit.collision.impulse, hit.collision.required_friction, hit.regime]
        return [*found, *hit.rolling, hit.post_collision_angles, hit.post_transition_angles]

    for name, ask in (("collide", collided), ("domenech", scattered)):
        yield f"{name}, arrays", digest(ask(slice(None)))
        yield f"{name}, one by one", digest([ask(k) for k in range(SINGLE)])


def comparisons() -> Iterator[Case]:
    """All laws side by side, of many balls, but for the sentences."""
    rng = generator("compare")
    found = []
    for k in range(40):
        surfaces = {} if k < 10 else {
            "restitution": rng.uniform(0, 1), "friction": rng.uniform(0, 0.5), "floor_friction": rng.uniform(0, 0.5),
            "floor_restitution": rng.uniform(0, 0.9), "contact_height": rng.uniform(0.8, 1.5),
        }  # fmt: skip
        if k % 5 == 0:
            surfaces |= {"sliding": True, "spin_y": rng.normal(0, 50)}
        meeting = carom.incoming(rng.uniform(0.1, 5), rng.uniform(0, 89), rng.normal(0, 40), **surfaces)
        found.append(parted(carom.compare(meeting).as_dict())[0])
    yield "compare", digest(found)


# --- scenes --------------------------------------------------------------------------------------------------------

FORMS: tuple[Any, ...] = (
    {"form": "han-2005"},
    {"form": "power", "at_rest": 0.9, "speed": 0.3},
    {"form": "viscoelastic", "c": 0.2},
    {"form": "exponential", "at_rest": 0.95, "at_speed": 0.5, "speed": 1.0},
    {"form": "polynomial", "coefficients": [0.9, -0.1, 0.005]},
)


class Throw:
    """Random words for scenes."""

    def __init__(self, *name: Any) -> None:
        self.rng = generator(*name)

    def chance(self, share: float) -> bool:
        """True in so many cases of one."""
        return bool(self.rng.random() < share)

    def pick(self, *items: Any) -> Any:
        """One of them."""
        return items[self.rng.integers(len(items))]

    def number(self, low: float, high: float) -> float:
        """A number between two."""
        return float(self.rng.uniform(low, high))

    def vector(self, size: float = 1.0, axes: int = 3) -> list[float]:
        """A vector in any direction."""
        return [float(c) for c in self.rng.normal(size=axes) * size]


def room(t: Throw, *, upright: bool) -> list[dict[str, Any]]:
    """What stands around the balls, if anything does."""
    kind = t.pick(
        "table", "stadium", "polygon", "tube", "strip", *(() if upright else ("box", "hollow", "arc", "none"))
    )
    axis = [0, 0, 1] if upright or t.chance(0.5) else t.vector()
    tall = {} if upright or t.chance(0.6) else {"height": t.number(0.13, 0.3)}
    if kind == "table":
        nose = {} if upright or t.chance(0.4) else {"nose_height": t.number(0.02, 0.039)}
        return [{"shape": "table", "length": 2.0, "width": 1.2, **nose, **tall}]
    corners = [[-1.0, -0.9], [0.2, -0.2], [1.0, -0.8], [0.9, 0.9], [0.0, 0.4], [-0.9, 1.0]]
    normal = [*t.vector(axes=2), 0.0 if upright or t.chance(0.5) else t.number(-0.5, 0.5)]
    size = math.sqrt(sum(c * c for c in normal))
    known: dict[str, list[dict[str, Any]]] = {
        "stadium": [{"shape": "stadium", "straight": 1.0, "radius": 0.8, "angle": t.number(0, 180)}],
        "polygon": [{"shape": "polygon", "points": corners[:: t.pick(1, -1)], **tall}],
        "tube": [{"shape": "cylinder", "point": [0, 0, 0], "axis": axis, "radius": 1.0, "inside": True}],
        "strip": [{"shape": "strip", "point": [-0.8 * c / size for c in normal], "normal": normal, "width": 1.6}],
        "box": [{"shape": "box", "center": [0, 0, 0.6], "size": [2, 1.6, 2.4], "inside": True}],
        "hollow": [{"shape": "sphere", "center": [0, 0, 0.2], "radius": 1.0, "inside": True}],
        "arc": [{"shape": "arc", "center": [0, 0], "radius": 1.0, "from_angle": 0, "to_angle": 360, **tall}],
        "none": [],
    }
    return known[kind]


def obstacle(t: Throw, *, upright: bool) -> dict[str, Any]:
    """A wall somewhere in the middle."""
    x, y = t.number(-0.6, 0.6), t.number(-0.6, 0.6)
    axis = [0, 0, 1] if upright or t.chance(0.5) else t.vector()
    low = t.pick(-math.inf, 0.0, t.number(0.05, 0.2))
    ends = {} if upright or t.chance(0.5) else {"low": low, "height": max(low, 0.0) + t.number(0.02, 0.4)}
    first, normal = float(t.rng.integers(360)), t.vector()
    if upright:
        normal[2] = 0.0
    off = -t.number(0.3, 0.9) / math.sqrt(sum(c * c for c in normal))
    ring = [
        [x + t.number(0.1, 0.3) * c, y + t.number(0.1, 0.3) * s] for c, s in ((1, 0), (0.3, 0.9), (-0.8, 0.6), (0, -1))
    ]
    pillar = {} if upright or t.chance(0.5) else {"height": t.number(0.05, 0.6), "inside": t.chance(0.3)}
    sizes = [t.number(0.1, 0.4), t.number(0.1, 0.4), 4.0 if upright else t.number(0.1, 0.4)]
    known: dict[str, dict[str, Any]] = {
        "plane": {"point": [off * c for c in normal], "normal": normal},
        "segment": {"start": [x, y], "end": [x + t.number(-0.5, 0.5), y + t.number(-0.5, 0.5)], **ends},
        "box": {"center": [x, y, 0.1], "size": sizes},
        "cylinder": {"point": [x, y, 0.3], "axis": axis, "radius": t.number(0.02, 0.3), **pillar},
        "arc": {"center": [x, y], "radius": t.number(0.15, 0.5), "from_angle": first,
                "to_angle": first + t.number(20, 360), **ends},
        "wedge": {"apex": [x, y, 0.0], "axis": axis, "from_angle": first,
                  "to_angle": first + t.pick(t.number(40, 180), t.number(180, 360), 360.0)},
        "polygon": {"points": ring, "closed": t.chance(0.7), **ends},
        "sphere": {"center": [x, y, t.number(-0.1, 0.3)], "radius": t.number(0.02, 0.3)},
    }  # fmt: skip
    shape = t.pick(*(name for name in known if not (upright and name == "sphere")))
    return {"shape": shape, **known[shape]}


def surface(t: Throw, law: str, *, springs: bool) -> dict[str, Any]:
    """A wall's restitution and friction, as far as its law takes them."""
    if law == "conventional":
        return {}
    bounce = t.pick(0.0, 1.0, 0.9, t.number(0, 1), t.number(0, 1), t.pick(*FORMS), t.pick(*FORMS))
    beta = t.pick(0.0, t.number(-1, 1)) if springs and law == "two-step" else 0.0
    extra = {"stiffness_ratio": t.number(0.5, 1.4)} if law in ("maw", "stronge") else {}
    friction = t.pick(0.0, 0.2, t.number(0, 1), math.inf)
    return {"restitution": bounce, "friction": friction, "tangential_restitution": beta, **extra}


def scene_words(k: int) -> dict[str, Any]:
    """A random scene, without its balls."""
    t = Throw("scene", k)
    names = ("two-step", "two-step", "two-step", "no-slip", "mirror", "maw", "stronge", "conventional")
    law = t.pick(*names)
    rolls = law == "conventional"
    floor = rolls or t.chance(0.6)
    together = t.chance(0.7)
    walls = room(t, upright=rolls)
    walls += [obstacle(t, upright=rolls) for _ in range(t.rng.integers(0 if walls else 1, 4))]
    for wall in walls:
        own = t.pick(*names[:-1]) if not rolls and t.chance(0.2) else law
        wall.update(surface(t, own, springs=not (floor and together)) | ({} if own == law else {"law": own}))
    words: dict[str, Any] = {
        "walls": walls,
        "run": {"law": law, "duration": 8.0, "max_events": 80, "floor_contact": "with" if together else "after"},
        "ball_contact": {
            "restitution": t.pick(1.0, 0.95, 0.0, t.number(0, 1), t.pick(*FORMS)),
            "friction": t.pick(0.0, 0.06, t.number(0, 1)),
            "tangential_restitution": t.pick(0.0, 0.0, t.number(-1, 1)),
        },
        "gravity": t.pick(9.8, 9.8, 1.0, 0.0) if floor else t.pick(0.0, t.vector(3.0), t.vector(3.0), 9.8),
    }
    if floor:
        words["floor"] = {
            "restitution": t.pick(0.0, 0.5, t.number(0, 0.95), 1.0, t.pick(*FORMS)),
            "friction": t.pick(0.0, 0.2, t.number(0, 1), math.inf),
            "tangential_restitution": t.pick(0.0, 0.0, t.number(-1, 1)),
            "rolling_resistance": t.pick(0.0, 0.01, 0.1),
            "spin_friction": t.pick(0.0, 0.02),
        }
    if rolls:
        words["gravity"] = words["floor"]["friction"] = 1.0
    return words


def thrown_ball(t: Throw, *, floor: bool, rolls: bool) -> dict[str, Any]:
    """A ball somewhere, which moves anyhow."""
    radius, speed = t.number(0.02, 0.07), t.pick(0.3, 1.0, 3.0, 10.0)
    lies = floor and (rolls or t.chance(0.7))
    ball = {
        "radius": radius,
        "mass": t.number(0.1, 0.3),
        "inertia": t.pick("solid", "hollow", t.number(0.05, 0.66)),
        "position": [t.number(-0.9, 0.9), t.number(-0.9, 0.9)],
        "velocity": t.vector(speed, 2 if lies else 3),
    }
    if not lies:
        ball["position"].append(t.number(radius if floor else -0.3, 0.7))
    if lies and (rolls or t.chance(0.4)):
        ball |= {"rolling": True, "spin_z": float(t.rng.normal() * 20)}
    elif t.chance(0.7):
        ball["spin"] = t.vector(speed / radius)
    if not rolls and t.chance(0.1):
        ball["velocity"] = [0.0, 0.0, 0.0]
    return ball


def made(k: int) -> carom.Scene:
    """A random scene; its balls are thrown until there is room for them. CaromError where there is none for any."""
    words, t = scene_words(k), Throw("balls", k)
    rolls = words["run"]["law"] == "conventional"
    wanted = 1 if rolls else int(t.rng.integers(1, 5))
    scene, balls = None, []
    for _ in range(40):
        if len(balls) == wanted:
            break
        ball = thrown_ball(t, floor="floor" in words, rolls=rolls)
        try:
            scene = carom.Scene(**words, balls=[*balls, ball])
        except carom.CaromError:
            continue
        balls.append(ball)
    return carom.Scene(**words, balls=[ball]) if scene is None else scene


def of_run(run: carom.Trajectory) -> list[Any]:
    """All events of a run."""
    return [
        [
            e.t, e.kind, e.ball, e.other, e.phase, e.before, e.after, e.impulse, e.floor_impulse, e.required_friction,
            e.regime, e.energy_lost,
        ]
        for e in run.events
    ]  # fmt: skip


def followed(name: str, scene: carom.Scene) -> Iterator[Case]:
    """What happens in a scene, and the states on the way: few times (plain Python) and many (compiled)."""
    run = carom.simulate(scene)
    yield f"{name} events", digest(of_run(run))
    few, many = np.linspace(0, run.end, 5), np.linspace(0, run.end, 301)
    yield f"{name} states", digest(run.at(few), run.at(many), run.final, run.final_phase, run.end, run.energy(few))
    yield f"{name} turned", digest(run.orientation(few))


def soft(v: Any, w: Any, n: Any, a: float, kappa: float, e: float, mu: float, beta: float) -> Any:
    """A law of one's own: a wall that returns less of a faster ball, and takes some of what goes along it."""
    u = v[0] * n[0] + v[1] * n[1] + v[2] * n[2]
    back = -e * u / (1 + abs(u) / 10)
    along = 1 - mu / 4
    v1 = (
        along * (v[0] - u * n[0]) + back * n[0],
        along * (v[1] - u * n[1]) + back * n[1],
        along * (v[2] - u * n[2]) + back * n[2],
    )
    return v1, (w[0] / 2, w[1] / 2, w[2] / 2)


def scenes(place: Place) -> Iterator[Case]:
    """Random scenes, the scene of the docs, a law of one's own, and many shots at once."""
    refused = 0
    for k in range(SCENES):
        try:
            yield from followed(f"{k:03d}", made(k))
        except carom.CaromError as error:
            refused += 1
            yield f"{k:03d} refused", f"refused: {type(error).__name__}"
    place.say(f"{refused} of {SCENES} scenes refused")
    three = carom.load_scene(place.root / "docs" / "scenes" / "three_balls.toml")
    yield from followed("three balls", three)
    card = carom.Card("soft", "A test.", ("none",), "Never.", "", "")
    law = carom.wall_law(card, soft)
    walls = [{"shape": "table", "length": 2.0, "width": 1.0, "restitution": 0.9, "friction": 0.3, "law": law}]
    ball = {"radius": 0.03, "mass": 0.2, "position": [0.1, 0.2], "velocity": [2.0, 1.3], "rolling": True, "spin_z": 9.0}
    floor = {"friction": 0.2, "restitution": 0.5, "rolling_resistance": 0.01}
    yield from followed("own law", carom.Scene(floor=floor, walls=walls, balls=[ball], run={"duration": 8.0}))
    rng = generator("many")
    velocity, spin = np.zeros((2, 500, 3, 3))
    velocity[:, :, :2], spin[:] = rng.normal(size=(500, 3, 2)) * 2, rng.normal(size=(500, 3, 3)) * 30
    many = carom.simulate_many(three, velocity, spin, events=6, kinds=("wall", "ball"))
    yield "many shots", digest(many.final, many.phase, many.end, many.count, labels(many.why), many.events)


# --- orbits --------------------------------------------------------------------------------------------------------

HERE, UP_HERE = ("--position=0.2,0.1", "--velocity=0.8,0.3"), ("--position=0.2,0.1,0.3", "--velocity=0.8,0.3,-0.2")
ROUGH_LAW = ("--law=contact", "--restitution=1", "--tangential-restitution=1")
ORBITS: dict[str, tuple[str, ...]] = {
    "strip, no-slip": ("strip", "--position=0.1,0.05", "--velocity=0.8,0.3", "--spin=0.5"),
    "wedge, mirror, force": ("wedge:angle=100", "--acceleration=-1,0", "--law=mirror", "--position=0.7,0",
                             "--velocity=0.2,0.75", "--lyapunov"),
    "polygon, no-slip": ("regular:sides=5", "--seed=3", "--reverse"),
    "polygon, re-entrant corner": ("polygon:points=[[0,0],[3,0],[3,1],[1,1],[1,2],[0,2]]", "--bounds=surface", "--seed=5"),
    "circle, rolling": ("circle", "--law=rolling", *HERE, "--spin=0.5"),
    "ellipse, mirror": ("ellipse:half_axes=[1.3,0.7]", "--law=mirror", *HERE),
    "ellipse, wide ball, force": ("ellipse:half_axes=[1.2,0.5]", "--bounds=surface", "--ball-radius=0.35",
                                  "--acceleration=0,-2", "--at-corner=pass", *HERE, "--spin=0.7"),
    "stadium, rough": ("stadium", *ROUGH_LAW, *HERE, "--spin=0.5"),
    "stadium, contact": ("stadium", "--law=contact", "--restitution=0.9", "--friction=0.2", *HERE, "--spin=0.5"),
    "sinai, no-slip": ("sinai:radius=0.3", "--seed=1", "--lyapunov"),
    "cylinder, no-slip, force": ("cylinder:stadium", "--acceleration=-9.81", "--seed=2"),
    "sphere, no-slip": ("sphere", *UP_HERE, "--spin=0.5,0.2,-0.7"),
    "box, rough": ("box", *ROUGH_LAW, "--seed=4"),
}  # fmt: skip


def orbits(place: Place) -> Iterator[Case]:
    """One ball in every table, bounce by bounce; exponents of two; many balls at once."""
    for name, words in ORBITS.items():
        yield from facts_of(place, name, "orbit", *words, f"--bounces={BOUNCES}", "--json")
    try:
        library: Any = importlib.import_module("carom.billiards")
    except ModuleNotFoundError:
        library = importlib.import_module("carom.orbits")
    for name, table in (("stadium", library.stadium()), ("cylinder", library.cylinder(library.circle()))):
        begin = library.starts(table, 40, seed=6)
        found = library.orbit(table, begin, 200)
        yield f"40 in a {name}, starts", digest(begin.position, begin.velocity, begin.spin)
        yield (
            f"40 in a {name}",
            digest(found.t, found.position, found.velocity, found.spin, found.piece, found.arc, found.phase),
        )
        spectrum = library.lyapunov(table, begin, 200)
        yield f"40 in a {name}, exponents", digest(spectrum.per_bounce, spectrum.per_time, spectrum.error)
        yield f"40 in a {name}, tangent", digest(library.tangent_map(table, begin, 20).matrix)


# --- gases ---------------------------------------------------------------------------------------------------------


def _contact(one: str, two: str, restitution: float, friction: float, tangential: float = 0.0) -> str:
    return (
        f'[[contacts]]\nbetween = ["{one}", "{two}"]\nrestitution = {restitution}\nfriction = {friction}\n'
        f"tangential_restitution = {tangential}\n"
    )


def _species(name: str, count: int, radius: float, mass: float, more: str = "") -> str:
    return f'[[species]]\nname = "{name}"\ncount = {count}\nradius = {radius}\nmass = {mass}\n{more}\n'


RUN = "[run]\nequilibrate = 1_000\nmax_events = 6_000\nseed = 5\n"
GASES = {
    "rough discs": '[container]\nshape = "periodic"\nsize = [16.0, 14.0]\n'
    + _species("a", 120, 0.5, 1.0, "temperature_rotational = 0.2")
    + _contact("a", "a", 1.0, math.inf, 1.0)
    + RUN,
    "spheres in a box": 'gravity = 0.5\ncontact_time = 1e-6\n[container]\nshape = "box"\nsize = [8.0, 7.0, 9.0]\n'
    + _species("a", 150, 0.5, 1.0)
    + _contact("a", "a", 0.98, 0.3, 0.4)
    + _contact("a", "wall", 0.99, 0.5)
    + RUN,
    "shaken discs": "gravity = 1.0\ncontact_time = 1e-5\n"
    + '[container]\nshape = "box"\nsize = [18.0, 40.0]\nperiodic = ["x"]\n'
    + _species("steel", 60, 0.5, 1.0, "temperature = 5.0")
    + _species("glass", 90, 0.35, 0.16, 'temperature = 5.0\ninertia = "ring"')
    + _contact("steel", "steel", 0.93, 0.15, 0.3)
    + _contact("steel", "glass", 0.9, 0.2, 0.4)
    + _contact("glass", "glass", 0.9, 0.25, 0.4)
    + _contact("steel", "wall", 0.95, 0.1)
    + _contact("glass", "wall", 0.95, 0.1)
    + '[[drives]]\nwall = "bottom"\namplitude = 0.6\nfrequency = 2.0\n'
    + RUN.replace("seed", 'start = "random"\nseed'),
    "a mixture kept warm": '[container]\nshape = "cylinder"\nradius = 4.5\nheight = 8.0\n'
    + _species("big", 60, 0.6, 2.0)
    + _species("small", 120, 0.3, 0.3, 'inertia = "hollow"')
    + _contact("big", "big", 0.9, 0.3, 0.5)
    + _contact("small", "big", 0.95, 0.2)
    + _contact("small", "small", 1.0, 0.0, -1.0)
    + _contact("big", "wall", 0.95, 0.5)
    + _contact("small", "side", 1.0, math.inf, 1.0)
    + _contact("small", "bottom", 1.0, 0.0)
    + _contact("small", "top", 0.9, 0.1)
    + '[[drives]]\nwall = "bottom"\ntemperature = 1.5\n[thermostat]\ntemperature = 1.0\nrate = 0.1\n'
    + RUN,
}


def kept(file: Path) -> Iterator[Case]:
    """The arrays of a checkpoint, each by itself, but for the processor's time and what says who wrote it."""
    with np.load(file, allow_pickle=False) as arrays:
        for name in arrays:
            if name != "carom_checkpoint":
                array = arrays[name]
                yield name, digest(array[:-1] if name == "mark.numbers" else array)


def gases(place: Place) -> Iterator[Case]:
    """Gases run a third of their way, kept, and resumed; and two of them without a scene."""
    for name, text in GASES.items():
        folder = place.empty()
        (folder / "gas.toml").write_text(text)
        first = ("gas", "gas.toml", "--json", "--max-events", "2000", "--checkpoint", "first.npz")
        then = (
            "gas",
            "gas.toml",
            "--json",
            "--resume",
            "first.npz",
            "--checkpoint",
            "then.npz",
            "--measures",
            "all.json",
        )
        for part, words in (("first", first), ("then", then)):
            yield from facts_of(place, f"{name}, {part}", *words, folder=folder)
            if (folder / f"{part}.npz").exists():
                yield from ((f"{name}, {part}, {array}", value) for array, value in kept(folder / f"{part}.npz"))
        if (folder / "all.json").exists():
            yield from facts(f"{name}, measures", json.loads((folder / "all.json").read_text()))
        if (folder / "then.npz").exists():
            yield from gas_now(name, gases_of.load_checkpoint(folder / "then.npz").gas)
    discs = gases_of.Gas(
        [gases_of.Species(carom.Disc(0.5, 1.0), 100)], (13.0, 12.0), contacts=carom.Surface(0.99, 0.4, 0.6), seed=8
    )
    walls = {("a", "a"): carom.Surface(1, 0, -1), ("a", "wall"): carom.Surface(1, math.inf, 1)}
    kind = gases_of.Species(carom.Ball(0.5, 1.0), 150, "a", 1.0, 0.5)
    balls = gases_of.Gas([kind], (9.0, 8.0, 7.0), periodic=(True, False, True), contacts=walls, seed=9)
    for name, gas in (("discs without a scene", discs), ("balls without a scene", balls)):
        gas.run(2000)
        again = gases_of.Gas.restore(gas.state())
        yield f"{name}, measured", digest(without_clock(again.run(3000).to_dict()))
        yield from gas_now(name, again)


def gas_now(name: str, gas: Any) -> Iterator[Case]:
    """All balls of a gas."""
    now = gas.balls()
    found = [now.time, now.position, now.velocity, now.spin, now.species, now.images, gas.energy()]
    yield f"{name}, balls", digest(found)


def without_clock(table: dict[str, Any]) -> dict[str, Any]:
    """A table without what depends on the clock."""
    return {key: value for key, value in table.items() if key not in PASSING}


# --- the command line ----------------------------------------------------------------------------------------------


def parted(value: Any) -> tuple[Any, list[str]]:
    """What was found, without sentences, times and paths; and the sentences."""
    if isinstance(value, list):
        parts = [parted(one) for one in value]
        return [one for one, _ in parts], [word for _, words in parts for word in words]
    if not isinstance(value, dict):
        return value, []
    found, said = {}, []
    for key, one in value.items():
        if key in WORDS and (isinstance(one, str) or (isinstance(one, list) and all(isinstance(x, str) for x in one))):
            said += [one] if isinstance(one, str) else one
        elif key not in PASSING:
            found[key], more = parted(one)
            said += more
    return found, said


def facts(name: str, value: Any) -> Iterator[Case]:
    """A case for every part of what a command found, and one for its sentences."""
    found, said = parted(value)
    table = found if isinstance(found, dict) else {"all": found}
    yield from ((f"{name}: {key}", digest(one)) for key, one in table.items())
    if any(said):
        yield f"{name}: in words", {"text": "\n".join(said)}


def facts_of(place: Place, name: str, *words: str, folder: Path | None = None) -> Iterator[Case]:
    """What a command prints with ``--json``."""
    try:
        yield from facts(name, json.loads(place.command(*words, folder=folder)))
    except FailedError as error:
        yield name, {"failed": str(error)}


def columns(name: str, file: Path) -> Iterator[Case]:
    """A case for every column of a table that a command wrote."""
    with file.open(newline="", encoding="utf-8") as lines:
        rows = list(csv.DictReader(lines))
    for column in rows[0]:
        cells = [row[column] for row in rows]
        yield f"{name}: {column}", {"text": "\n".join(cells)} if "note" in column else digest(cells)


CUSHION = ("--contact-height=1.4", "--restitution=0.98", "--friction=0.14", "--floor-friction=0.212")
PREDICTED = {
    "mathavan2009": CUSHION,
    "kharaz2001": ("--speed=3.9", "--law=maw", "--restitution=0.98", "--friction=0.09", "--radius=0.0025"),
    "tt_rackets": ("--law=contact", "--radius=0.02", "--inertia=hollow", "--restitution=0.75", "--friction=0.4"),
}


def cli(place: Place) -> Iterator[Case]:
    """What the commands print."""
    turned = ("--angle", "30", "--spin-z", "40", "--restitution", "0.85", "--friction", "0.2")
    yield from facts_of(place, "compare", "compare", "--json")
    yield from facts_of(place, "compare, a cushion", "compare", *turned, "--cushion-height", "1.4", "--json")
    yield from facts_of(place, "laws", "laws", "--json")
    yield from facts_of(place, "datasets", "datasets", "--json")
    three = str(place.root / "docs" / "scenes" / "three_balls.toml")
    yield from facts_of(place, "simulate", "simulate", three, "--json")
    yield from facts_of(place, "simulate, mirror", "simulate", three, "--law", "mirror", "--at", "0.5,1", "--json")
    for words in (("compare",), ("compare", *turned), ("laws",), ("laws", "two-step"), ("datasets",)):
        try:
            yield " ".join(words), {"text": place.command(*words)}
        except FailedError as error:
            yield " ".join(words), {"failed": str(error)}
    for name, words in PREDICTED.items():
        folder = place.empty()
        try:
            place.command("datasets", name, "--out", "measured.csv", folder=folder)
            place.command("predict", "measured.csv", *words, "--out", "predicted.csv", folder=folder)
            yield from columns(f"predict {name}", folder / "predicted.csv")
        except FailedError as error:
            yield f"predict {name}", {"failed": str(error)}
    yield from facts_of(place, "derive", "derive", "--json")


# --- fits ----------------------------------------------------------------------------------------------------------


def film(file: Path, count: int) -> Path:
    """A made-up film of a ball on a table from above, 60 frames a second; rounded, so that last bits do not matter."""
    rng, a = generator("film", count), 0.03075
    table = {
        "shape": "table",
        "length": 2.84,
        "width": 1.42,
        "center": (1.42, 0.71),
        "restitution": 0.85,
        "friction": 0.18,
    }
    floor = {"friction": 0.2, "rolling_resistance": 0.008, "spin_friction": 0.0125}
    lines = ["shot,ball,t [s],x [mm],y [mm]"]
    for k in range(count):
        v = rng.uniform(1.5, 2.5, 2) * rng.choice([-1.0, 1.0], 2)
        place = (float(rng.uniform(1.0, 1.8)), float(rng.uniform(0.5, 0.9)))
        ball = {
            "radius": a,
            "mass": 0.2,
            "position": place,
            "velocity": v.tolist(),
            "rolling": True,
            "spin_z": 10.0 * k,
        }
        run = carom.simulate(carom.Scene(floor=floor, walls=[table], balls=[ball], run={"duration": 1.0}))
        times = 0.004 + np.arange(58) / 60
        seen = run.at(times).position
        assert seen is not None
        noisy = 1e3 * (seen[:, 0, :2] + rng.normal(0, 3e-4, (len(times), 2)))
        lines += [f"{k},1,{t:.5f},{x:.3f},{y:.3f}" for t, (x, y) in zip(times, noisy, strict=True)]
    file.write_text("\n".join(lines) + "\n")
    return file


SETTLED = ("--bootstrap=50", "--json")
FITS = {
    "kharaz2001": ("fit", "kharaz2001", *SETTLED),
    "mathavan2009": ("fit", "mathavan2009", "--restitution=line", *SETTLED),
    "tt_rackets": ("fit", "tt_rackets", "--where", "racket=01_inverted", *SETTLED),
    "a film, its contacts": ("fit", "film.csv", "--radius=0.03075", "--laws=two-step,contact", "--bootstrap=0",
                             "--json"),
    "a film, whole": ("fit", "pair.csv", "--whole", "--radius=0.03075", "--laws=two-step", "--contacts=1",
                      "--noise=0.3mm",
                      "--json"),
    "design in flight": ("design", "--laws=maw,contact", "--radius=0.02", "--inertia=hollow", "--sigma-v=0.15",
                         "--sigma-spin=10", "--speeds=3:10", "--json"),
    "design on a table": ("design", "--kind=table", "--laws=two-step,contact", "--contact-height=1.2",
                          "--stage=rolling", "--spins=-20:20", "--json"),
}  # fmt: skip


def fits(place: Place) -> Iterator[Case]:
    """What the statistics say, as numbers."""
    folder = place.empty()
    film(folder / "film.csv", 5)
    film(folder / "pair.csv", 2)
    (folder / "tracker.txt").write_bytes(
        (place.root / "tests" / "tracks" / "files" / "tracker_single.txt").read_bytes()
    )
    for name, words in FITS.items():
        try:
            yield name, {"numbers": json.loads(place.command(*words, folder=folder))}
        except FailedError as error:
            yield name, {"failed": str(error)}
    for name, file in (("a film", "film.csv"), ("a track of Tracker's", "tracker.txt")):
        try:
            told = place.command(
                "tracks", "show", file, "--radius=0.03075", "--json", "--out", "out.csv", folder=folder
            )
        except FailedError as error:
            yield f"{name}, tracks", {"failed": str(error)}
            continue
        yield f"{name}, tracks", {"numbers": json.loads(told)}
        with (folder / "out.csv").open(newline="", encoding="utf-8") as lines:
            rows = [{key: number(cell) for key, cell in row.items()} for row in csv.DictReader(lines)]
        yield f"{name}, rebounds", {"numbers": rows}


def number(cell: str) -> Any:
    """A cell as a number, if it is one."""
    try:
        return float(cell)
    except ValueError:
        return cell


# --- a record, and a comparison with one ---------------------------------------------------------------------------

GROUPS: dict[str, Callable[[Place], Iterator[Case]]] = {
    "laws": laws,
    "scenes": scenes,
    "orbits": orbits,
    "gases": gases,
    "cli": cli,
    "fits": fits,
}


def about() -> dict[str, str]:
    """What the bits depend on besides carom."""
    from llvmlite.binding import get_host_cpu_name

    found = {"python": sys.version.split()[0], "processor": get_host_cpu_name()}
    for name in ("numpy", "numba", "llvmlite", "sympy", "lmfit", "scipy"):
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            found[name] = "none"
    return found


def computed(names: Iterable[str], root: Path) -> dict[str, dict[str, Any]]:
    """All cases of the groups."""

    def say(text: str) -> None:
        sys.stderr.write(f"  {text}\n")

    record: dict[str, dict[str, Any]] = {}
    with tempfile.TemporaryDirectory() as folder:
        place = Place(root, Path(folder), say)
        for name in names:
            sys.stderr.write(f"{name}\n")
            begin, cases = time.monotonic(), record.setdefault(name, {})
            try:
                for case, value in GROUPS[name](place):
                    if case in cases:
                        raise ValueError(f"{name}: two cases are named {case!r}")
                    cases[case] = value
                    if sys.stderr.isatty():
                        sys.stderr.write(f"\r  {len(cases)} cases \r")
                    if isinstance(value, dict) and "failed" in value:
                        say(value["failed"])
            except Exception:
                cases["(the rest of the group)"] = {"failed": traceback.format_exc(limit=-3)}
                say(traceback.format_exc())
            say(f"{len(cases)} cases, {time.monotonic() - begin:.0f} s")
    return record


def kind_of(value: Any) -> str:
    """How a case is kept: "hash", "text", "numbers"; or "failed"."""
    return next(iter(value)) if isinstance(value, dict) else "hash"


def leaves(value: Any, at: str = "") -> Iterator[tuple[str, Any]]:
    """All that is no list and no table in JSON, each with where it stands; rows that have names go by these."""
    if isinstance(value, dict):
        for key, one in value.items():
            yield from leaves(one, f"{at}.{key}" if at else key)
    elif isinstance(value, list):
        for k, one in enumerate(value):
            name = next((one[key] for key in ("law", "name") if key in one), k) if isinstance(one, dict) else k
            yield from leaves(one, f"{at}[{name}]")
    else:
        yield at, value


def error_bar(at: str, table: dict[str, Any]) -> float | None:
    """The error bar of the number that stands there, if the record has one."""
    head, dot, last = at.rpartition(".")
    found: Any = table.get(f"{head}.stderr") if last == "value" else table.get(f"{head}{dot}sigma_{last}")
    if last.startswith("values["):
        k = last.removeprefix("values")
        variance = table.get(f"{head}{dot}covariance{k}{k}")
        found = math.sqrt(variance) if isinstance(variance, float) and variance > 0 else None
    return float(found) if isinstance(found, float | int) and found > 0 else None


def told_numbers(case: str, old: Any, new: Any) -> list[str]:
    """By how much the numbers of a fit differ: the three largest, relatively and in error bars."""
    was, now = dict(leaves(old)), dict(leaves(new))
    both = [at for at in was if at in now]
    reals = [at for at in both if all(type(x[at]) in (int, float) for x in (was, now))]
    changed = [at for at in reals if was[at] != now[at]]
    words = sum(was[at] != now[at] for at in both if at not in set(reals))
    missing, added = len(was) - len(both), len(now) - len(both)
    head = f"    {case}: {len(reals) - len(changed)} of {len(reals)} numbers equal"
    head += "".join(f", {n} {what}" for n, what in ((words, "others changed"), (missing, "gone"), (added, "new")) if n)
    relative = [(abs(now[at] - was[at]) / max(abs(now[at]), abs(was[at])), at) for at in changed]
    bars = [(abs(now[at] - was[at]) / bar, at) for at in changed if (bar := error_bar(at, was)) is not None]
    lines = [head]
    lines += [f"      relative {x:.2g}: {at}: {was[at]:.9g} -> {now[at]:.9g}" for x, at in sorted(relative)[:-4:-1]]
    lines += [f"      {x:.2g} error bars: {at}: {was[at]:.9g} -> {now[at]:.9g}" for x, at in sorted(bars)[:-4:-1]]
    return lines


def compared(old: dict[str, Any], new: dict[str, Any]) -> tuple[list[str], bool]:
    """What is told of a group, and whether all that has to be equal is."""
    equal = [case for case in old if case in new and old[case] == new[case]]
    lines, wrong = [], []
    for case in {**old, **new}:
        if case not in old or case not in new:
            wrong.append(f"{case} ({'new' if case in new else 'missing'})")
        elif "failed" in (kinds := {kind_of(old[case]), kind_of(new[case])}):
            wrong.append(f"{case} (failed)")
        elif old[case] != new[case]:
            if kinds == {"numbers"}:
                lines += told_numbers(case, old[case]["numbers"], new[case]["numbers"])
            elif kinds == {"text"}:
                lines.append(f"    {case}: text changed")
            else:
                wrong.append(case)
    head = f"{len(equal)} of {len(old)} equal" + (f", {len(wrong)} differ:" if wrong else "")
    return [head, *(f"    {case}" for case in wrong), *lines], not wrong


def main() -> int:
    """The command."""
    parser = argparse.ArgumentParser(description="Record what carom answers, or compare it with a record.")
    way = parser.add_mutually_exclusive_group(required=True)
    way.add_argument("--out", type=Path, metavar="FILE.json", help="record here")
    way.add_argument("--against", type=Path, metavar="FILE.json", help="compare with this record")
    parser.add_argument("--only", metavar="GROUP,GROUP", help=f"of {', '.join(GROUPS)}")
    root = Path(__file__).resolve().parents[1]
    parser.add_argument(
        "--root", type=Path, default=root, help="the repository, whose docs and tests have scenes and tracks"
    )
    given = parser.parse_args()
    names = list(GROUPS) if given.only is None else given.only.split(",")
    if unknown := [name for name in names if name not in GROUPS]:
        parser.error(f"--only: expected some of {', '.join(GROUPS)}, got {', '.join(unknown)}")
    old = None if given.against is None else json.loads(given.against.read_text())
    if old is not None and (absent := [name for name in names if name not in old]):
        parser.error(f"--against: the record has no {', '.join(absent)}")
    sys.stderr.write(f"carom of {Path(carom.__file__).parent}\n")
    new = computed(names, given.root.resolve())
    if old is None:
        given.out.write_text(json.dumps({"about": about(), **new}, indent=1, ensure_ascii=False) + "\n")
        return int(any(kind_of(value) == "failed" for cases in new.values() for value in cases.values()))
    for key, value in about().items():
        if old["about"].get(key) != value:
            sys.stdout.write(f"another {key}: {old['about'].get(key)} then, {value} now\n")
    right = True
    for name in names:
        lines, fine = compared(old[name], new[name])
        right &= fine
        sys.stdout.write(f"{name:8}" + "\n".join(lines) + "\n")
    return 0 if right else 1


if __name__ == "__main__":
    sys.exit(main())
