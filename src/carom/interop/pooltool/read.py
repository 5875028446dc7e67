"""Read pooltool's files as carom's scenes: fields by version, cushions, pockets, balls."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.files import as_path
from carom.scene.scene import Scene
from carom.scene.shapes.planes import Segment
from carom.scene.shapes.rounds import Arc
from carom.scene.shapes.table import Pockets, Table
from carom.scene.wall import WallShape
from carom.tracks.formats.pooltool import CONTINUOUS, EVENTS, POCKETED, Field, open_file, recorded

Array = NDArray[np.float64]
SAME = 1e-6  # m: places in a file and on a carom table this close count as the same
CORNERS, SIDES = ("lb", "rb", "rt", "lt"), ("lc", "rc")


def walls_of(table: Field, surface: dict[str, Any]) -> tuple[list[WallShape], list[str]]:
    """Return the walls for a table in a file, and what is left out of it."""
    cushions = table["cushion_segments"]
    lines = {key: np.array([one["p1"].array(3), one["p2"].array(3)]) for key, one in cushions["linear"].parts().items()}
    circles = {
        key: np.array([*one["center"].array(3), one["radius"].number()])
        for key, one in cushions["circular"].parts().items()
    }
    holes = {
        key: np.array([*one["center"].array(3)[:2], one["radius"].number()])
        for key, one in table["pockets"].parts().items()
    }
    for key, line in lines.items():
        if line[0, 2] != line[1, 2]:
            at = cushions["linear"][key]
            raise at.fault("p1 and p2 of one height", f"{line[0, 2]:g} and {line[1, 2]:g} m")
    whole = _table(lines, circles, holes, surface)
    if whole is not None:
        return [whole], []
    notes = [f"pockets {', '.join(holes)}: the cushions have not pooltool's usual layout"] if holes else []
    return [*_segments(lines, surface), *_arcs(lines, circles, surface)], notes


def _table(
    lines: dict[str, Array], circles: dict[str, Array], holes: dict[str, Array], surface: dict[str, Any]
) -> Table | None:
    """Return a carom table of the same noses, jaws and pockets; None where there is none.

    pooltool numbers its cushions: 3 and 12 along y, 18 and 9 along x, each side of a middle pocket by itself.
    """
    if not {"3", "9", "12", "18"} <= set(lines):
        return None
    x1, x2, y1, y2 = lines["3"][0, 0], lines["12"][0, 0], lines["18"][0, 1], lines["9"][0, 1]
    heights = {z for line in lines.values() for z in line[:, 2].tolist()} | {c[2] for c in circles.values()}
    if len(heights) != 1 or not (x2 > x1 and y2 > y1):
        return None
    numbers: dict[str, Any] = {
        "length": x2 - x1, "width": y2 - y1, "center": ((x1 + x2) / 2, (y1 + y2) / 2), "nose_height": heights.pop(), **surface,
    }  # fmt: skip
    if not (holes or circles):
        return Table(name="cushions", **numbers) if len(lines) == 4 else None
    if set(holes) != {*CORNERS, *SIDES} or not {"1", "5"} <= set(lines) or not {"1t", "5t"} <= set(circles):
        return None
    try:
        corner = _corner(lines, circles["1t"], holes["lb"], x1, y1)
        side = _side(lines, circles["5t"], holes["lc"], x1, (y1 + y2) / 2)
        found = Table(name="cushions", corner_pockets=corner, side_pockets=side, **numbers)
    except (CaromError, ValueError, ZeroDivisionError):  # (a shape that carom's tables do not have)
        return None
    return found if _same_table(found, lines, circles, holes) else None


# The tip of a jaw is where the lines of nose and facing meet. An arc of radius r touches both; with s the angle between the
# facing and the normal of the nose, it touches the facing r (1 - sin s) behind the line of the nose, and the nose at
# r cos s/(1 + sin s) from the tip.


def _jaw(depth: float, radius: float) -> tuple[float, float]:
    """Return the jaw's angle in degrees, and the distance from tip to arc."""
    s = math.asin(1 - depth / radius)
    return max(90.0, 90 + math.degrees(s)), radius * math.cos(s) / (1 + math.sin(s))


def _corner(lines: dict[str, Array], jaw: Array, hole: Array, x: float, y: float) -> Pockets:
    angle, d = _jaw(y - lines["1"][1, 1], jaw[3])
    mouth = (min(lines["18"][:, 0]) - x - d) * math.sqrt(2)
    out = math.sqrt(2) * (x - hole[0])
    return Pockets(mouth=mouth, jaw_angle=angle, jaw_radius=jaw[3], shelf=out - hole[2] + mouth / 2, radius=hole[2])


def _side(lines: dict[str, Array], jaw: Array, hole: Array, x: float, middle: float) -> Pockets:
    angle, d = _jaw(x - lines["5"][1, 0], jaw[3])
    mouth = 2 * (jaw[1] - d - middle)
    return Pockets(mouth=mouth, jaw_angle=angle, jaw_radius=jaw[3], shelf=x - hole[0] - hole[2], radius=hole[2])


def _same_table(table: Table, lines: dict[str, Array], circles: dict[str, Array], holes: dict[str, Array]) -> bool:
    """Return whether all noses, arcs of jaws and pockets of a carom table agree with the file.

    (Facings are not compared: pooltool draws the middle pockets' ones with sin for tan, and they end 0.04 mm beside their line.)
    """
    noses, mouths = table._layout
    own = [(*start, *end) for start, end, _along in noses]
    theirs = [(*line[0, :2], *line[1, :2]) for key, line in lines.items() if key in NOSES]
    turned = [(*line[2:], *line[:2]) for line in theirs]
    arcs = [(*jaw.center, jaw.radius) for mouth in mouths for jaw in (mouth.before, mouth.after)]
    edges = [(*mouth.pocket.center, mouth.pocket.radius) for mouth in mouths]
    return (
        len(theirs) == len(own) and _all_in(own, theirs + turned)
        and len(circles) == len(arcs) and _all_in(arcs, [(*c[:2], c[3]) for c in circles.values()])
        and _all_in(edges, [tuple(hole) for hole in holes.values()])
    )  # fmt: skip


NOSES = ("3", "6", "9", "12", "15", "18")


def _all_in(some: list[Any], others: list[Any]) -> bool:
    gaps = np.abs(np.array(some)[:, None] - np.array(others)[None]).max(axis=-1)
    return bool((gaps.min(axis=1) < SAME).all())


# --- any other layout ---------------------------------------------------------------------------------------------------


def _segments(lines: dict[str, Array], surface: dict[str, Any]) -> list[WallShape]:
    return [
        Segment(start=line[0, :2].tolist(), end=line[1, :2].tolist(), low=line[0, 2], name=f"cushion {key}", **surface)
        for key, line in lines.items()
    ]


def _arcs(lines: dict[str, Array], circles: dict[str, Array], surface: dict[str, Any]) -> list[WallShape]:
    """Return the arcs between the cushions that touch each circle; of a circle that stands alone, all but the last bit."""
    found: list[WallShape] = []
    ends = np.array([end[:2] for line in lines.values() for end in line]).reshape(-1, 2)
    for key, (x, y, z, radius) in circles.items():
        near = ends[np.abs(np.hypot(ends[:, 0] - x, ends[:, 1] - y) - radius) < SAME]
        angles = sorted(math.degrees(math.atan2(q - y, p - x)) for p, q in near)
        first, last = (angles[0], angles[-1]) if len(angles) == 2 else (0.0, 359.999)
        if last - first > 180 and len(angles) == 2:
            first, last = last, first + 360
        found.append(
            Arc(center=(x, y), radius=radius, from_angle=first, to_angle=last, low=z, name=f"jaw {key}", **surface)
        )
    return found


# ----------------------------------------------------------------------------------------------------
# Read the files of pooltool, 0.6.0 or its main branch, System or MultiSystem, as scenes. pooltool need not be installed.


FLYING = 5  # pooltool's number of that motion


@dataclass(frozen=True, eq=False)
class PooltoolShot:
    """A shot in a file of pooltool's.

    Examples
    --------
    >>> import carom.interop.pooltool
    >>> shot = carom.interop.pooltool.read("tests/interop/files/bank.json")[0]      # doctest: +SKIP
    >>> carom.simulate(shot.scene).final.position                                   # doctest: +SKIP
    """

    scene: Scene
    """The start of the shot, with the law two-step."""
    notes: tuple[str, ...] = ()
    """Content of the file that the scene lacks, and effects that carom computes in another way; one sentence each."""
    paths: dict[str, Array] = field(default_factory=dict)
    """The path (n, 4) that pooltool has recorded of each ball: time (s) and centre (m). Empty where the shot was not simulated."""


def read(path: str | Path) -> list[PooltoolShot]:
    """Read the shots in a file that pooltool (0.6.0, or main of June 2026) wrote by ``System.save`` or ``MultiSystem.save``.

    Each becomes a scene at its start: table, noses, jaws and pockets, the balls' and the cloth's numbers. Balls that pooltool has
    already simulated start as they were at first, the cue ball as the cue left it; if nothing was simulated the cue of the file
    strikes the ball, by :func:`carom.strike`. pooltool need not be installed; .msgpack needs carom's extra ``msgpack``.

    Parameters
    ----------
    path : str or Path
        .json or .msgpack.

    Returns
    -------
    list of PooltoolShot
        One for a System.

    Raises
    ------
    CaromError
        For what is not such a file, or one of another version, whose fields are others: where, what was expected, what was found,
        what to do.

    Examples
    --------
    >>> import carom.interop.pooltool
    >>> shots = carom.interop.pooltool.read("break.msgpack")                        # doctest: +SKIP
    >>> shots[0].scene.describe()                                                   # doctest: +SKIP
    """
    file = open_file(as_path("read", path))
    if "multisystem" in file:
        return [_shot(one) for one in file["multisystem"].each()]
    if "balls" not in file or "table" not in file:
        found = ", ".join(str(key) for key in list(file.fields())[:4]) or "nothing"
        raise file.fault(
            "a System (cue, table, balls, t, events) or a MultiSystem of pooltool's", f"a table with {found}",
            "save the shot with system.save('shot.json')",
        )  # fmt: skip
    return [_shot(file)]


def _shot(system: Field) -> PooltoolShot:
    main = check_fields(system)
    events = system["events"].each()
    balls = system["balls"].parts()
    cue = system["cue"]
    white = cue["cue_ball_id"].text()
    if white not in balls:
        raise cue["cue_ball_id"].fault(f"one of the balls {', '.join(balls)}")
    params = {name: {key: one.number() for key, one in ball["params"].parts().items()} for name, ball in balls.items()}
    own = params[white]
    notes = [
        f"ball {name}: its {key}, {number:g}, as the scene has the cue ball's, {own[key]:g}, for all"
        for name, numbers in params.items()
        for key, number in numbers.items()
        if key not in ("m", "R") and number != own[key]
    ]
    if not main:
        notes.append("the floor has no restitution, as pooltool 0.6.0 has no such number; balls do not bounce on it")
    starts, struck = _starts(events, balls, white)
    scene_balls = []
    for name, (rvw, state) in starts.items():
        if state == POCKETED:
            notes.append(f"ball {name}: in a pocket at the start")
            continue
        scene_balls.append(_ball(name, rvw, params[name], state == FLYING and rvw[0, 2] > params[name]["R"]))
    if not struck:
        strike = _strike(cue)
        plays = "the shot was not simulated: carom.strike plays its cue, with friction at the tip"
        notes.append("the cue: its speed is 0" if strike is None else plays)
        for ball in scene_balls:
            if strike is not None and ball["name"] == white:
                ball.pop("velocity"), ball.pop("spin")
                ball["strike"] = strike
    if len(balls) > 1:
        notes.append(
            f"balls meet with the friction u_b = {own['u_b']:g}; pooltool's own model has one that falls with the slip, as"
            " the law alciatore of ball_contact has"
        )
    try:
        walls, left_out = walls_of(system["table"], {"restitution": own["e_c"], "friction": own["f_c"]})
        parts: dict[str, Any] = {
            "gravity": own["g"],
            "floor": {
                "friction": own["u_s"],
                "rolling_resistance": own["u_r"],
                "spin_friction": own["u_sp_proportionality"] * own["R"],
                **({"restitution": own["e_t"]} if main else {}),
            },
            "walls": walls,
            "balls": scene_balls,
            "ball_contact": {"restitution": own["e_b"], "friction": own["u_b"]},
        }
        scene = Scene(**parts)
    except CaromError as error:
        if error.faults[0].startswith(system.file):
            raise
        place = f"{system.file}: {system.place}" if system.place else system.file
        raise CaromError(*(f"{place}: as a {fault[0].lower()}{fault[1:]}" for fault in error.faults)) from None
    return PooltoolShot(scene, (*notes, *left_out), _paths(balls))


def _state(ball: Field) -> tuple[Array, int]:
    """Return position, velocity and spin (3, 3), and pooltool's number of the motion."""
    state = ball["state"]
    return state["rvw"].array(3, 3), int(state["s"].number())


def _starts(events: list[Field], balls: dict[str, Field], white: str) -> tuple[dict[str, tuple[Array, int]], bool]:
    """Return the state of each ball at the start, and whether the cue has struck.

    What stands under ``balls`` in a simulated file is the end. Before a ball's first event it was at rest, and that event holds its
    state before; only the cue ball moves off by the cue, and its start is the state after the event ``stick_ball``.
    """
    found: dict[str, tuple[Array, int]] = {}
    struck = False
    for event in events:
        kind = event["event_type"].text()
        for agent in event["agents"].each():
            name = agent["id"].text()
            if agent["agent_type"].text() != "ball" or name in found or name not in balls:
                continue
            hit = kind == "stick_ball" and name == white
            struck |= hit
            found[name] = _state(agent["final" if hit else "initial"])
    return {name: found.get(name) or _state(ball) for name, ball in balls.items()}, struck


def _ball(name: str, rvw: Array, params: dict[str, float], flies: bool) -> dict[str, Any]:
    """Return the fields of a scene's ball: on the floor (pooltool's rack may lie a rounding above it) if it does not fly."""
    (x, y, z), v, w = rvw.tolist()
    return {
        "name": name, "radius": params["R"], "mass": params["m"], "position": (x, y, z) if flies else (x, y), "velocity": v,
        "spin": w,
    }  # fmt: skip


def _strike(cue: Field) -> dict[str, Any] | None:
    """Return the strike of the file's cue. pooltool's tip is elastic, and its offset a points to the left."""
    speed, specs = cue["V0"].number(), cue["specs"]
    if speed == 0:
        return None
    return {
        "speed": speed,
        "azimuth": cue["phi"].number(),
        "elevation": cue["theta"].number(),
        "offset": (-cue["a"].number(), cue["b"].number()),
        "cue": {"mass": specs["M"].number(), "end_mass": specs["end_mass"].number(), "restitution": 1.0},
    }


def _paths(balls: dict[str, Field]) -> dict[str, Array]:
    """Return the recorded paths: pooltool's continuous ones where the file has them, else the places of the events."""
    found = {}
    for name, ball in balls.items():
        path = recorded(ball[CONTINUOUS]) or recorded(ball[EVENTS])
        if path is not None:
            found[name] = path[0]
    return found


# ----------------------------------------------------------------------------------------------------
# The fields of pooltool's files, by version; a file with others is of another version and is refused.
#
# An unknown field could change the shot, so none is passed over. No file says which version wrote it: a shot whose balls have
# ``e_t`` is read as one of the main branch (of 28 June 2026), any other as one of 0.6.0.

SYSTEM = ("cue", "table", "balls", "t", "events")
CUE = ("id", "V0", "phi", "theta", "a", "b", "cue_ball_id", "specs")
SPECS = ("brand", "M", "length", "tip_radius", "shaft_radius_at_tip", "shaft_radius_at_butt", "end_mass")
TABLE = ("cushion_segments", "pockets", "table_type", "model_descr", "height", "lights_height")
LINEAR, CIRCULAR = ("id", "p1", "p2", "direction"), ("id", "center", "radius")
POCKET = ("id", "center", "radius", "depth", "contains")
BALL = ("id", "state", "params", "ballset", "initial_orientation", "history", "history_cts")
PARAMS = ("m", "R", "u_s", "u_r", "u_sp_proportionality", "u_b", "e_b", "e_c", "f_c", "g")
STATE, EVENT, AGENT = ("rvw", "s", "t"), ("event_type", "agents", "time"), ("id", "agent_type", "initial", "final")
# what the main branch has besides
OF_MAIN = {CUE: ("model_name",), LINEAR: ("nose_radius",), PARAMS: ("e_t",)}
VERSIONS = {False: "pooltool 0.6.0", True: "pooltool's main branch of June 2026"}
TRANSITIONS = ("spinning_stationary", "rolling_stationary", "rolling_spinning", "sliding_rolling")
EVENT_KINDS = (
    "none", "ball_ball", "ball_linear_cushion", "ball_circular_cushion", "ball_pocket", "stick_ball", *TRANSITIONS,
)  # fmt: skip
EVENTS_OF_MAIN = ("ball_table",)
REMEDY = "the file is of another version or damaged: save the shot again with pooltool 0.6.0"


def check_fields(system: Field) -> bool:
    """Return whether a shot is of pooltool's main branch. CaromError where it has other fields than a known version, or fewer."""
    balls = system["balls"].parts()
    main = any("e_t" in ball["params"] for ball in balls.values() if "params" in ball)
    _same(system, SYSTEM, main)
    cue, table = system["cue"], system["table"]
    _same(cue, CUE, main)
    _same(cue["specs"], SPECS, main)
    _same(table, TABLE, main)
    cushions = table["cushion_segments"]
    _same(cushions, ("linear", "circular"), main)
    for parts, known in ((cushions["linear"], LINEAR), (cushions["circular"], CIRCULAR), (table["pockets"], POCKET)):
        for part in parts.parts().values():
            _same(part, known, main)
    for ball in balls.values():
        _same(ball, BALL, main)
        _same(ball["params"], PARAMS, main)
        _same(ball["state"], STATE, main)
    for event in system["events"].each():
        _same(event, EVENT, main)
        kinds = (*EVENT_KINDS, *EVENTS_OF_MAIN) if main else EVENT_KINDS
        if event["event_type"].text() not in kinds:
            raise event["event_type"].fault(f"an event of {VERSIONS[main]}", remedy=REMEDY)
        for agent in event["agents"].each():
            _same(agent, AGENT, main)
    return main


def _same(part: Field, known: tuple[str, ...], main: bool) -> None:
    names = (*known, *OF_MAIN.get(known, ())) if main else known
    for name in (*part.fields(), *names):
        if (name in part) != (name in names):
            asked, got = ("no", "one") if name in part else ("a", "none")
            place = f"{part.place}.{name}" if part.place else name
            expected = f"{asked} field of this name, as in files of {VERSIONS[main]}"
            raise Field(None, part.file, place).fault(expected, got, REMEDY)
