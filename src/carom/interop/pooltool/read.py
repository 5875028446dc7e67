"""Read the files of pooltool, 0.6.0 or its main branch, System or MultiSystem, as scenes. pooltool need not be installed."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.files import as_path
from carom.interop.pooltool.fields import check_fields
from carom.interop.pooltool.tables import walls_of
from carom.scene.scene import Scene
from carom.tracks.formats.pooltool import CONTINUOUS, EVENTS, POCKETED, recorded
from carom.tracks.formats.pooltool_fields import Field, open_file

__all__ = ["PooltoolShot", "read"]

Array = NDArray[np.float64]
FLYING = 5  # pooltool's number of that motion
CLOTH = ("u_s", "u_r", "u_sp_proportionality", "e_c", "f_c", "g")


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
    params = {name: _params(ball["params"], main) for name, ball in balls.items()}
    own = params[white]
    notes = [
        f"ball {name}: its {key}, {numbers[key]:g}, as the scene has the cue ball's, {own[key]:g}, for all"
        for name, numbers in params.items()
        for key in (*CLOTH, "e_b", "u_b", *(["e_t"] if main else []))
        if numbers[key] != own[key]
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
        if strike is None:
            notes.append("the cue: its speed is 0")
        else:
            notes.append("the shot was not simulated: carom.strike plays its cue, with friction at the tip")
            for ball in scene_balls:
                if ball["name"] == white:
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


def _params(params: Field, main: bool) -> dict[str, float]:
    return {key: params[key].number() for key in ("m", "R", *CLOTH, "e_b", "u_b", *(["e_t"] if main else []))}


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
