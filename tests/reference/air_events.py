"""Check a run in air, flight by flight, beside DOP853: the state at each event, the gaps there, and that nothing is passed."""

from __future__ import annotations

from typing import Any

import numpy as np
from reference.air_floor import OnFloor, floor_path, hops
from reference.air_path import air_force, air_path

import carom
from carom.core.motion.phases import BOUNCING, FLIGHT, ROLLING, SLIDING
from carom.simulation.records import PHASE


def _law(value: Any) -> Any:
    """A coefficient written down anew: a number, or a table of a form."""
    if isinstance(value, dict):
        if value["form"] == "spin":
            return lambda s, ratio: value["still"] + value["per_spin"] * ratio
        return lambda s, ratio: value["slope"] * ratio / (1 + value["saturation"] * ratio)
    return lambda s, ratio: value


def worst_of_flights(run: Any, gaps: Any, samples: int = 100, most: int = 1_000_000) -> dict[str, float]:
    """Return the worst differences of a run in air of all its balls: place, velocity, spin, ``at``, depth, ends of phases.

    ``gaps(x, radius)`` returns the gaps (N, G) of places (N, 3) to all walls and the floor. Of a ball with more events
    than ``most`` only some are looked at.
    """
    scene, log = run.scene, run.log
    air = scene.air
    worst = dict.fromkeys(("place", "velocity", "spin", "at", "depth", "time"), 0.0)
    for i, ball in enumerate(scene.balls):
        own = log[log["ball"] == i]
        known = {
            "radius": ball.radius, "mass": ball.mass, "density": air.rho, "wind": air.wind, "gravity": scene.gravity,
            "drag": _law(_given(ball.drag)), "lift": _law(_given(ball.lift) or 0.0), "spin_decay": ball.spin_decay,
            "buoyancy": air.buoyancy,
        }  # fmt: skip
        force = air_force(**known)
        ends = [*own["t"][1:], run.end]
        every = 1 + len(own) // most
        for row, end in list(zip(own, ends, strict=True))[::every]:
            lasts = end - row["t"]
            if lasts <= 0:
                continue
            times = np.linspace(0, lasts, samples)
            after = own[own["t"] == end]
            if row["phase"] != FLIGHT:
                _on_floor(worst, run, i, row, times, after, force, gaps)
                continue
            found = air_path(times, row["x"], row["v"], row["w"], tolerance=1e-14, **known).y
            if len(after) and end > row["t"]:
                worst["place"] = max(worst["place"], float(np.abs(found[:3, -1] - after[0]["x"]).max()))
                worst["velocity"] = max(worst["velocity"], float(np.abs(found[3:6, -1] - after[0]["v_before"]).max()))
                worst["spin"] = max(worst["spin"], float(np.abs(found[6:, -1] - after[0]["w_before"]).max()))
            inner = times[1:-1]
            places = run.at(row["t"] + inner).position[:, i]
            worst["at"] = max(worst["at"], float(np.abs(places - found[:3, 1:-1].T).max()))
            worst["depth"] = max(worst["depth"], float(-gaps(found[:3].T, ball.radius).min()))
    return worst


def _on_floor(worst: Any, run: Any, i: int, row: Any, times: Any, after: Any, force: Any, gaps: Any) -> None:
    """Compare the motion of ball i on the floor from a row of the log on, and its end, if that is what the rows ``after`` say."""
    ball, floor = run.scene.balls[i], run.scene.floor
    places = run.at(row["t"] + times).position[:, i]
    worst["depth"] = max(worst["depth"], float(-gaps(places, ball.radius).min()))
    start, kappa = (row["x"], row["v"], row["w"]), ball.ball.kappa
    ends = None
    if row["phase"] in (SLIDING, ROLLING):
        law = OnFloor(force, ball.radius, kappa, floor, row["phase"] == SLIDING, float(np.sign(row["w"][2])))
        found, ends = floor_path(law, *start, times)
        worst["at"] = max(worst["at"], float(np.nan_to_num(np.abs(places[:-1] - found[:3, :-1].T)).max()))
        if len(after) and after[0]["kind"] != PHASE:
            ends = (times[-1], found[:3, -1], found[3:6, -1], found[6:, -1])
    elif row["phase"] == BOUNCING:
        ends = hops(force, ball.radius, kappa, floor, *start)
    if ends is not None and len(after):
        worst["time"] = max(worst["time"], abs(ends[0] - float(times[-1])))
        for name, value, field in zip(
            ("place", "velocity", "spin"), ends[1:], ("x", "v_before", "w_before"), strict=True
        ):
            worst[name] = max(worst[name], float(np.abs(value - after[0][field]).max()))


def _given(value: Any) -> Any:
    return value.model_dump() if hasattr(value, "model_dump") else value


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
