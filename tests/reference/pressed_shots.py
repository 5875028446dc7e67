"""Derivatives of shots at the noses of the tables that carom knows, against central differences of whole runs in four steps.

A nose touches the ball above its centre, so it presses it on the cloth: both act at once. A shot rolls, slides with any spin, or is
struck; the cloth's friction is between 0.05 and 0.6.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

import carom
from carom.scene.presets import presets
from carom.scene.restitution import Constant
from carom.scene.toml import replaced
from carom.simulation.records import WALL

__all__ = ["FLOOR", "LIMIT", "ShotCase", "compare_shot", "shot_at_nose"]

Array = NDArray[np.float64]
# A derivative is wrong if it is off by more than LIMIT of the larger of FLOOR and the difference; four differences agree to AGREE.
LIMIT, FLOOR, AGREE = 1e-4, 0.1, 3e-5
# The widest of four steps, each a third of the one before it, over the parameter's size: smaller ones where they do not agree.
# (Steps that span less than that agree on the slope of the runs' own errors of 1e-8, which are smooth over short distances.)
STEPS = (1e-2, 2e-3, 4e-4)
COLUMNS = 2  # of each shot, in turn


class ShotCase(NamedTuple):
    """One shot and one parameter: the derivatives of what follows, those of differences, and their doubt."""

    seed: int
    column: str
    verdict: str
    """ "compared", or why not."""
    worst: float = 0.0
    """The largest error over the larger of FLOOR and the difference."""
    told: Array | None = None
    expected: Array | None = None
    radius: float = np.inf


def shot_at_nose(seed: int) -> tuple[carom.Scene, list[str]]:
    """Return a shot at a table, and the paths of what it depends on."""
    rng = np.random.default_rng([37, seed])
    names = sorted(presets())
    name = names[seed % len(names)]
    preset = presets()[name]
    ball = {key: one.value for key, one in preset.parts["ball"].items()}
    floor = {key: one.value for key, one in preset.parts["floor"].items()}
    floor["friction"] = float(rng.uniform(0.05, 0.6))
    length, width = preset.cushions["length"].value, preset.cushions["width"].value
    ball["position"] = tuple((rng.uniform(-0.4, 0.4, 2) * (length, width)).tolist())
    turn, speed = rng.uniform(0, 2 * np.pi), float(np.exp(rng.uniform(np.log(0.2), np.log(6))))
    velocity = (speed * np.cos(turn), speed * np.sin(turn))
    kind = seed // len(names) % 3
    paths = ["balls.0.velocity"]
    if kind == 0:
        ball |= {"velocity": velocity, "rolling": True}
        if rng.random() < 0.5:
            ball["spin_z"] = float(rng.normal() * speed / ball["radius"])
    elif kind == 1:
        ball |= {"velocity": velocity, "spin": tuple((rng.normal(size=3) * speed / ball["radius"]).tolist())}
        paths.append("balls.0.spin")
    else:
        strike = {"speed": speed, "azimuth": float(np.degrees(turn)), "elevation": float(rng.uniform(0, 8))}
        ball["strike"] = strike | {"offset": tuple(rng.uniform(-0.35, 0.35, 2).tolist())}
        paths = ["balls.0.strike.speed", "balls.0.strike.azimuth", "balls.0.strike.offset"]
    if seed % 4 == 0:
        paths += ["floor.friction", "walls.0.friction"]
    wall = {"shape": "table", "preset": name}
    if seed % 5 == 0:
        wall["restitution"] = float(rng.uniform(0.4, 1.0))
    return carom.Scene(floor=floor, walls=[wall], balls=[ball], run={"duration": 10, "max_events": 60}), paths


def _after(run: Any, row: int, radius: float) -> Array:
    """Return velocity and radius times spin after an event."""
    one = run.log[len(run.scene.balls) + row]
    return np.concatenate([one["v"], radius * one["w"]])


def _sequence(run: Any) -> list[tuple[int, int, int]]:
    return [(int(one["kind"]), int(one["other"]), int(one["phase"])) for one in run.log]


def compare_shot(seed: int, whole: bool = False) -> list[ShotCase]:
    """Compare the derivatives of a shot up to its first cushion, or of its end, with differences."""
    scene, paths = shot_at_nose(seed)
    first = carom.simulate(scene)
    walls = np.flatnonzero(first.log["kind"][1:] == WALL)
    if not len(walls):
        return [ShotCase(seed, "", "no cushion")]
    row, radius = int(walls[0]), scene.balls[0].radius
    if not whole:
        scene = replaced(scene, {"run.max_events": row + 1})
    else:  # (up to a time between its last two events: there its state has derivatives)
        times = np.append(0.0, first.events.t)
        scene = replaced(scene, {"run.duration": float((times[-2] + times[-1]) / 2)})
    run = carom.simulate(scene)
    if not np.any(run.log["floor_impulse"][run.log["kind"] == WALL]):
        return [ShotCase(seed, "", "not pressed")]
    try:
        found = run.sensitivity(paths)
    except carom.CaromError as error:
        return [ShotCase(seed, "", f"refused: {str(error)[:150]}")]
    sequence = _sequence(run)

    def state(run: Any) -> Array:
        if whole:
            return np.concatenate([run.final.position[0], run.final.velocity[0]])
        return _after(run, row, radius)

    if whole:
        now = found.final
        told = np.concatenate([now.position[0], now.velocity[0]])
    else:
        one = found.events[row]
        told = np.concatenate([one.velocity, radius * one.spin])

    def at(changes: dict[str, Any]) -> Array | None:
        try:
            other = carom.simulate(replaced(scene, changes))
        except carom.CaromError:
            return None
        if _sequence(other) != sequence:
            return None
        return state(other)

    margin = found.radius if whole else min((one.radius for one in found.margin), default=np.inf)
    cases = []
    turn = seed // 21
    for c in {(turn + k) % len(found.columns) for k in range(COLUMNS)}:
        column = found.columns[c]
        path = next(path for path in paths if column == path or column.startswith(path + "."))
        old, x, k = _value(scene, path), float(found.values[c]), "xyz".find(column[-1]) if column != path else -1
        size = max(abs(x), _least(path, old, radius))

        def shifted(by: float, old: Any = old, path: str = path, k: int = k) -> Array | None:
            return at({path: old + by if k < 0 else tuple(y + by * (m == k) for m, y in enumerate(old))})

        expected = differences(shifted, size, told[:, c])
        if expected is None:
            cases.append(ShotCase(seed, column, "differences do not agree", told=told[:, c], radius=margin))
            continue
        error = np.abs(told[:, c] - expected) / np.maximum(FLOOR, np.abs(expected))
        worst = float(np.nan_to_num(error, nan=np.inf).max())
        cases.append(ShotCase(seed, column, "compared", worst, told[:, c], expected, margin))
    return cases


def _value(scene: Any, path: str) -> Any:
    from carom.scene.toml import path_match

    value = path_match(scene, path).values[0]
    return value.value if isinstance(value, Constant) else value


def _least(path: str, old: Any, radius: float) -> float:
    """Return the size of a number that may be zero: that of its vector."""
    if isinstance(old, tuple):
        size = float(np.linalg.norm(old))
        return max(size, 0.3 if path.endswith("offset") else 0.1)
    return 0.01


def differences(shifted: Callable[[float], Array | None], size: float, like: Array) -> Array | None:
    """Return the derivative that four central differences agree on; None if there is none."""
    for start in STEPS:
        found = []
        for level in range(4):
            h = start * size / 3**level
            ends = [shifted(sign * h) for sign in (1, -1)]
            if ends[0] is None or ends[1] is None:
                break
            found.append((ends[0] - ends[1]) / (2 * h))
        if len(found) < 4:
            continue
        better = [(9 * b - a) / 8 for a, b in itertools.pairwise(found)]
        scale = np.maximum(FLOOR, np.abs(better[1]))
        if all((np.abs(one - better[1]) <= AGREE * scale).all() for one in (better[0], better[2], found[-1])):
            return np.asarray(better[1])
    return None
