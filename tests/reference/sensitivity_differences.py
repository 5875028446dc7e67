"""Sensitivities of random scenes against central differences of whole runs, extrapolated (Richardson)."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from reference.scenes_of_all_laws import scene_of_all_laws

import carom
from carom.scene.paths import replaced

EVENTS = 50
LEVELS = 6
# m/s: an impact slower than this belongs to low bounces along a wall, which multiply the rounding of the runs by its inverse.
LOW = 1e-2


class Case(NamedTuple):
    """What came of one scene and one parameter."""

    seed: int
    column: str
    verdict: str
    error: float = math.nan
    """Largest difference of positions and velocities, as a share of the largest derivative."""
    doubt: float = math.nan
    """The error that the differences themselves may have, as the same share."""
    events: int = 0


def paths_of(scene: carom.Scene) -> list[str]:
    found = [f"balls.{i}.velocity" for i, ball in enumerate(scene.balls) if np.any(ball.state.velocity != 0)][:2]
    # (the differences give all walls one value)
    if len({wall.friction for wall in scene.walls}) == 1 and 0 < scene.walls[0].friction < math.inf:
        found.append("walls.*.friction")
    if scene.floor is not None and 0 < scene.floor.friction < math.inf:
        found.append("floor.friction")
    return found


def sequence(run: Any, t: float) -> list[tuple[int, ...]]:
    rows = run.log[run.log["t"] <= t]
    names = ("kind", "ball", "met", "other", "phase_before", "phase", "regime")
    return [tuple(int(row[name]) for name in names) for row in rows]


def compare(seed: int) -> list[Case]:
    """Compare the derivatives of a random scene at a time between two of its events with those of differences."""
    scene = scene_of_all_laws(seed)
    most = min(EVENTS, scene.run.max_events or EVENTS)
    scene = replaced(scene, {"run.max_events": most})
    try:
        run = carom.simulate(scene)
    except carom.CaromError as error:
        return [Case(seed, "", f"no run: {str(error)[:60]}")]
    times = np.unique(np.append(run.events.t, run.end))
    gaps = np.diff(times)
    wide = np.flatnonzero(gaps > 1e-3 * (run.end or 1.0) / len(times)) if len(gaps) else []
    if len(wide) == 0:
        return [Case(seed, "", "no events")]
    t = float((times[wide[-1]] + times[wide[-1] + 1]) / 2)
    paths = paths_of(scene)
    if not paths:
        return [Case(seed, "", "no parameter")]
    try:
        found = run.sensitivity(paths)
    except carom.CaromError as error:
        return [Case(seed, "", f"refused: {str(error)[:110]}")]
    at = found.at(t)
    told = np.concatenate([at.position, at.velocity], axis=1)  # (B, 6, p)
    low = [one for one, time in zip(found.margin, run.events.t, strict=True) if one.which == "graze" and time <= t]
    if any(one.distance < LOW for one in low):
        return [Case(seed, "", "bounces along a wall")]
    expected, cases = sequence(run, t), []
    for c, column in enumerate(found.columns):
        path = next(path for path in paths if column == path or column.startswith(path + "."))
        name = column
        cases.append(_one(scene, expected, t, name, path, float(found.values[c]), told[..., c], seed))
    return cases


def _value(scene: carom.Scene, name: str, path: str, x: float) -> carom.Scene:
    if name == path:
        return replaced(scene, {path: x})
    i = int(path.split(".")[1])
    old = list(scene.balls[i].velocity)
    old["xyz".index(name[-1])] = x
    return replaced(scene, {path: tuple(old)})


def _one(scene: Any, expected: Any, t: float, name: str, path: str, x: float, told: Any, seed: int) -> Case:
    size = max(abs(x), 0.1 if name != path else abs(x))
    largest = float(np.nanmax(np.abs(told)))
    best: tuple[float, float] | None = None
    # steps ten times as small where the sequence changes, or where the differences have not converged
    for start in (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7):
        table = []
        for level in range(LEVELS):
            h = start * size / 2**level
            ends = []
            for sign in (1, -1):
                try:
                    run = carom.simulate(_value(scene, name, path, x + sign * h))
                    state = run.at(t)
                except carom.CaromError:
                    break
                if sequence(run, t) != expected:
                    break
                ends.append(np.concatenate([state.position, state.velocity], axis=1))
            if len(ends) < 2:
                break
            table.append((ends[0] - ends[1]) / (2 * h))
        if len(table) < LEVELS:
            continue
        rows = [table]
        for k in range(1, LEVELS):
            rows.append([(4**k * b - a) / (4**k - 1) for a, b in zip(rows[-1], rows[-1][1:], strict=False)])
        for k in range(1, LEVELS):
            # (two estimates that share the smallest steps are wrong together: Ridders' doubt, Adv. Eng. Software 4, 75 (1982))
            good, before = rows[k][-1], (rows[k - 1][-1], rows[k - 1][-2], rows[k][-2] if len(rows[k]) > 1 else rows[k - 1][-2])
            # (where nothing depends on the parameter, rounding is all that is left)
            scale = max(largest, float(np.nanmax(np.abs(good))), 1e-3)
            doubt = max(float(np.nanmax(np.abs(good - one))) for one in before) / scale
            error = float(np.nanmax(np.abs(good - told))) / scale
            if best is None or doubt < best[1]:
                best = error, doubt
        if best and best[1] < 1e-9:
            break
    if best is None:
        return Case(seed, name, "the sequence changes", events=len(expected))
    return Case(seed, name, "compared", *best, events=len(expected))
