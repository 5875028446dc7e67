"""Check a run in air, flight by flight, beside DOP853: the state at each event, the gaps there, and that nothing is passed."""

from __future__ import annotations

from typing import Any

import numpy as np
from reference.air_path import air_path

import carom


def _law(value: Any) -> Any:
    """A coefficient written down anew: a number, or a table of a form."""
    if isinstance(value, dict):
        if value["form"] == "spin":
            return lambda s, ratio: value["still"] + value["per_spin"] * ratio
        return lambda s, ratio: value["slope"] * ratio / (1 + value["saturation"] * ratio)
    return lambda s, ratio: value


def worst_of_flights(run: Any, gaps: Any, samples: int = 100) -> dict[str, float]:
    """Return the worst differences of a run in air of all its balls: place, velocity, spin, ``at``, gap at events, and depth.

    ``gaps(x, radius)`` returns the gaps (N, G) of places (N, 3) to all walls and the floor.
    """
    scene, log = run.scene, run.log
    air = scene.air
    worst = dict.fromkeys(("place", "velocity", "spin", "at", "depth"), 0.0)
    for i, ball in enumerate(scene.balls):
        own = log[log["ball"] == i]
        known = {
            "radius": ball.radius, "mass": ball.mass, "density": air.rho, "wind": air.wind, "gravity": scene.gravity,
            "drag": _law(_given(ball.drag)), "lift": _law(_given(ball.lift) or 0.0), "spin_decay": ball.spin_decay,
            "buoyancy": air.buoyancy, "tolerance": 1e-14,
        }  # fmt: skip
        ends = [*own["t"][1:], run.end]
        for row, end in zip(own, ends, strict=True):
            lasts = end - row["t"]
            if lasts <= 0:
                continue
            times = np.linspace(0, lasts, samples)
            found = air_path(times, row["x"], row["v"], row["w"], **known).y
            after = own[own["t"] == end]
            if len(after) and end > row["t"]:
                worst["place"] = max(worst["place"], float(np.abs(found[:3, -1] - after[0]["x"]).max()))
                worst["velocity"] = max(worst["velocity"], float(np.abs(found[3:6, -1] - after[0]["v_before"]).max()))
                worst["spin"] = max(worst["spin"], float(np.abs(found[6:, -1] - after[0]["w_before"]).max()))
            inner = times[1:-1]
            places = run.at(row["t"] + inner).position[:, i]
            worst["at"] = max(worst["at"], float(np.abs(places - found[:3, 1:-1].T).max()))
            worst["depth"] = max(worst["depth"], float(-gaps(found[:3].T, ball.radius).min()))
    return worst


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
