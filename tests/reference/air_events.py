"""Check a run in air, flight by flight, beside DOP853: the state at each event, the gaps there, and that nothing is passed."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from reference.air_compiled import FLIGHT as FLIES
from reference.air_compiled import SIZE, dop853, floor_path, hops

import carom
from carom.core.motion.phases import BOUNCING, FLIGHT, ROLLING, SLIDING
from carom.simulation.records import PHASE


def _law(value: Any) -> tuple[float, float, float]:
    """A coefficient written down anew, (c0 + c1 S)/(1 + c2 S): a number, or a table of a form."""
    value = value.model_dump() if hasattr(value, "model_dump") else value
    if isinstance(value, dict):
        if value["form"] == "spin":
            return value["still"], value["per_spin"], 0.0
        return 0.0, value["slope"], value["saturation"]
    return value or 0.0, 0.0, 0.0


def numbers(scene: Any, ball: Any) -> Any:
    """Return the numbers of a ball for :mod:`reference.air_compiled`."""
    air, floor, a = scene.air, scene.floor, ball.radius
    area, volume = math.pi * a**2, 4 / 3 * math.pi * a**3
    weight = 1 - air.rho * volume / ball.mass if air.buoyancy else 1.0
    found = [0.5 * air.rho * area / ball.mass, a, ball.spin_decay, *air.wind, *(weight * g for g in scene.gravity)]
    found += [*_law(ball.drag), *_law(ball.lift), ball.ball.kappa]
    return np.array([*found, floor.friction, floor.rolling_resistance, floor.spin_friction, 0.0][:SIZE], float)


def worst_of_flights(run: Any, gaps: Any, samples: int = 100, most: int = 1_000_000) -> dict[str, float]:
    """Return the worst differences of a run in air of all its balls: place, velocity, spin, ``at``, depth, ends of phases.

    ``gaps(x, radius)`` returns the gaps (N, G) of places (N, 3) to all walls and the floor. Of a ball with more events
    than ``most`` only some are looked at.
    """
    scene, log = run.scene, run.log
    worst = dict.fromkeys(("place", "velocity", "spin", "at", "depth", "time"), 0.0)
    for i, ball in enumerate(scene.balls):
        own, force = log[log["ball"] == i], numbers(scene, ball)
        ends = np.array([*own["t"][1:], run.end])
        spans = [k for k in range(0, len(own), 1 + len(own) // most) if ends[k] > own["t"][k]]
        at = run.at(np.concatenate([np.linspace(own["t"][k], ends[k], samples) for k in spans])).position[:, i]
        for k, places in zip(spans, at.reshape(len(spans), samples, 3), strict=True):
            row, end = own[k], ends[k]
            times = np.linspace(0, end - row["t"], samples)
            after = own[own["t"] == end]
            if row["phase"] != FLIGHT:
                _on_floor(worst, run, i, row, times, after, force, gaps, places)
                continue
            start, found = np.concatenate([row["x"], row["v"], row["w"]]), np.empty((samples - 1, 9))
            dop853(force, FLIES, 0.0, start, times[1:], found, 3e-14, 1e-16)
            found = np.vstack([start, found]).T
            if len(after):
                worst["place"] = max(worst["place"], float(np.abs(found[:3, -1] - after[0]["x"]).max()))
                worst["velocity"] = max(worst["velocity"], float(np.abs(found[3:6, -1] - after[0]["v_before"]).max()))
                worst["spin"] = max(worst["spin"], float(np.abs(found[6:, -1] - after[0]["w_before"]).max()))
            worst["at"] = max(worst["at"], float(np.abs(places[1:-1] - found[:3, 1:-1].T).max()))
            worst["depth"] = max(worst["depth"], float(-gaps(found[:3].T, ball.radius).min()))
    return worst


def _on_floor(
    worst: Any, run: Any, i: int, row: Any, times: Any, after: Any, force: Any, gaps: Any, places: Any
) -> None:
    """Compare the motion of ball i on the floor from a row of the log on, and its end, if that is what the rows ``after`` say."""
    ball, floor = run.scene.balls[i], run.scene.floor
    worst["depth"] = max(worst["depth"], float(-gaps(places, ball.radius).min()))
    start = np.concatenate([row["x"], row["v"], row["w"]])
    ends = None
    if row["phase"] in (SLIDING, ROLLING):
        force[-1] = np.sign(row["w"][2])
        by_itself = len(after) > 0 and after[0]["kind"] == PHASE
        found, ends = floor_path(force, row["phase"] == SLIDING, start, times, by_itself)
        worst["at"] = max(worst["at"], float(np.nan_to_num(np.abs(places[:-1] - found[:3, :-1].T)).max()))
        if len(after) and after[0]["kind"] != PHASE:
            ends = (times[-1], found[:3, -1], found[3:6, -1], found[6:, -1])
    elif row["phase"] == BOUNCING:
        t, y = hops(force, float(floor.contact[1][0]), start)
        ends = (t, y[:3], y[3:6], y[6:])
    if ends is not None and len(after):
        worst["time"] = max(worst["time"], abs(ends[0] - float(times[-1])))
        for name, value, field in zip(
            ("place", "velocity", "spin"), ends[1:], ("x", "v_before", "w_before"), strict=True
        ):
            worst[name] = max(worst[name], float(np.abs(value - after[0][field]).max()))


HALF, SPHERE = 0.5, (0.0, 0.0, 0.3)  # m: half the width of a room, and a sphere of 0.1 m in it


def drawn_room(seed: int, balls: int = 3) -> Any:
    """Return balls in a room with a sphere in it, at random, with wind or without, and laws of the spin ratio."""
    rng = np.random.default_rng(seed)
    surface = {"restitution": 0.9, "friction": 0.2}
    walls: list[Any] = [
        {"shape": "plane", "point": (s * HALF * x, s * HALF * y, 0), "normal": (-s * x, -s * y, 0)} | surface
        for x, y in ((1, 0), (0, 1)) for s in (1, -1)
    ]  # fmt: skip
    walls.append({"shape": "sphere", "center": SPHERE, "radius": 0.1} | surface)
    drag = [0.5, {"form": "spin", "still": 0.4, "per_spin": 0.1}][seed % 2]
    made = [
        {
            "radius": 0.02, "mass": 0.0027, "inertia": "hollow", "position": place, "velocity": tuple(rng.normal(0, 3, 3)),
            "spin": tuple(rng.normal(0, 100, 3)), "drag": drag, "spin_decay": 1e-3 * (seed % 2),
            "lift": {"form": "saturating", "slope": 1.0, "saturation": 2.0},
        }
        for place in ((0.3, 0.3, 0.5), (-0.3, 0.3, 0.4), (0.3, -0.3, 0.3))[:balls]
    ]  # fmt: skip
    parts: Any = carom.Scene
    return parts(
        air={"density": 1.2, "wind": (0, seed % 3, 0), "buoyancy": seed % 2 == 0}, walls=walls, balls=made,
        floor={"friction": 0.3, "restitution": 0.9}, run={"duration": 0.35, "law": "contact"},
    )  # fmt: skip


def room_distances(x: Any, a: float) -> Any:
    """Return the gaps (N, 6) of places to the floor, the walls and the sphere."""
    sides = [x[:, 2], HALF - np.abs(x[:, 0]), HALF - np.abs(x[:, 1]), np.linalg.norm(x - SPHERE, axis=1) - 0.1]
    return np.column_stack(sides) - a


def drawn_table(seed: int, balls: int = 3, duration: float = 1.5) -> Any:
    """Return balls that slide, roll and hop on a floor with four walls, at random, with wind or without."""
    rng = np.random.default_rng(seed)
    room = drawn_room(seed)
    made = [
        ball.model_copy(
            update={
                "position": (*ball.position[:2], 0.02 + (0.0 if seed % 3 else 2e-7 * rng.random())),
                "velocity": (*rng.normal(0, 2, 2), 0.0),
                "spin": tuple(rng.normal(0, 80, 3)),
            }
        )
        for ball in room.balls[:balls]
    ]
    floor = {
        "friction": rng.uniform(0.1, 0.4), "restitution": rng.uniform(0.2, 0.7), "rolling_resistance": rng.uniform(0.01, 0.05),
        "spin_friction": 0.01 * (seed % 4),
    }  # fmt: skip
    parts: Any = carom.Scene
    return parts(
        air=room.air, walls=room.walls[:4], balls=made, floor=floor, run={"duration": duration, "law": "contact"}
    )


def table_distances(x: Any, a: float) -> Any:
    """Return the gaps (N, 5) of places to the floor and the walls."""
    return room_distances(x, a)[:, :-1]
