"""Films of shots that carom draws, with known truth: what a fit has to find again."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from carom.scene.scene import Scene
from carom.scene.toml import path_match, replaced
from carom.simulation.simulate import simulate
from carom.tracks.track import Track

RADIUS, MASS, GRAVITY = 0.03075, 0.21, 9.80665
SPIN_LOSS = 5.0  # rad/s^2


def drawn_films(
    count: int, *, seed: int = 0, noise: float = 1.5e-3, rate: float = 50.0, until: float = 12.0, law: str = "two-step",
    numbers: Mapping[str, float] | None = None, scatter: Mapping[str, float] | None = None,
) -> tuple[list[Track], list[Scene]]:  # fmt: skip
    """Draw shots on a carom table, and films of them: tracks of three balls, and the scenes with the true numbers.

    The cue ball hits another ball first. ``noise``: of one coordinate, m; ``rate``: frames per second; ``until``: length of a
    film, s. ``numbers``: of the table, by their paths in the scene; ``scatter``: standard deviations between shots, as shares of
    these numbers.

    Examples
    --------
    >>> from carom.fitting.shots import drawn_films
    >>> tracks, scenes = drawn_films(2, seed=1)
    >>> [track.group for track in tracks], len(scenes)
    (['shot 1', 'shot 1', 'shot 1', 'shot 2', 'shot 2', 'shot 2'], 2)
    """
    rng = np.random.default_rng(seed)
    tracks, scenes = list[Track](), list[Scene]()
    ball: dict[str, Any] = {"radius": RADIUS, "mass": MASS}
    half = np.array([1.42, 0.71]) - 0.15
    while len(scenes) < count:
        places = rng.uniform(-half, half, (3, 2)) + np.array([1.42, 0.71])
        gaps = [np.hypot(*(places[i] - places[j])) for i, j in ((0, 1), (0, 2), (1, 2))]
        if min(gaps) < 0.25 or gaps[0] > 1.6:
            continue
        way = places[1] - places[0]
        aside = rng.uniform(-0.75, 0.75) * 2 * RADIUS
        angle = math.atan2(way[1], way[0]) + math.asin(aside / float(np.hypot(*way)))
        speed, side, follow = rng.uniform(2.5, 5.0), rng.uniform(-0.6, 0.6), rng.uniform(-0.3, 0.9)
        v = speed * np.array([math.cos(angle), math.sin(angle)])
        w = speed / RADIUS * np.array([-follow * math.sin(angle), follow * math.cos(angle), side])
        given: dict[str, Any] = {
            "floor": {"friction": 0.19, "rolling_resistance": 0.006, "spin_friction": 0.4 * RADIUS * SPIN_LOSS / GRAVITY},
            "walls": [{"shape": "table", "length": 2.84, "width": 1.42, "center": (1.42, 0.71), "nose_height": 0.037,
                       "restitution": 0.85, "friction": 0.2}],
            "balls": [ball | {"name": "1", "position": tuple(places[0]), "velocity": tuple(v), "spin": tuple(w)},
                      ball | {"name": "2", "position": tuple(places[1])}, ball | {"name": "3", "position": tuple(places[2])}],
            "ball_contact": {"restitution": 0.94, "friction": 0.06}, "run": {"duration": 60.0, "law": law},
        }  # fmt: skip
        scene = replaced(Scene(**given), dict(numbers or {}))
        for path, share in (scatter or {}).items():
            own = path_match(scene, path).values[0]
            scene = replaced(scene, {path: getattr(own, "value", own) * (1 + share * rng.normal())})
        run = simulate(scene)
        first = next((event for event in run.events if event.kind in ("ball", "wall")), None)
        if first is None or first.kind != "ball":
            continue
        begins = rng.uniform(0.0, 1 / rate)
        time = np.arange(int(min(until, run.end) * rate)) / rate
        places_seen = np.asarray(run.at(np.clip(time - begins, 0.0, run.end)).position)
        name = f"shot {len(scenes) + 1}"
        for k in range(3):
            seen = places_seen[:, k, :2] + rng.normal(0.0, noise, (len(time), 2))
            tracks.append(Track(str(k + 1), time, seen, group=name))
        scenes.append(replaced(scene, {"run.duration": 60.0}))
    return tracks, scenes
