"""Sensitivities of random scenes against central differences of whole runs, extrapolated (Richardson)."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from reference.drawn_options import random_scene
from reference.scenes_of_all_laws import scene_of_all_laws
from reference.trips import leaves

import carom
from carom.scene.toml import path_match, replaced

EVENTS = 50
LEVELS = 6
# m/s: an impact slower than this belongs to low bounces along a wall, which multiply the rounding of the runs by its inverse.
LOW = 4e-3


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


# Of these, each scene has one or two in turn, where it has them at all.
MORE = (
    "balls.0.radius", "balls.0.mass", "balls.*.spin", "balls.0.position", "gravity", "walls.0.restitution", "walls.*.restitution",
    "walls.0.friction", "ball_contact.friction", "ball_contact.restitution", "floor.restitution", "floor.rolling_resistance",
    "walls.0.point", "walls.0.radius", "walls.0.vertices.1", "walls.0.center", "walls.0.length",
)  # fmt: skip


def paths_of(scene: carom.Scene, seed: int = 0) -> list[str]:
    """Return velocities of two balls, frictions, and two other numbers that the scene has."""
    found = [f"balls.{i}.velocity" for i, ball in enumerate(scene.balls) if np.any(ball.state.velocity != 0)][:2]
    found += [path for path in ("walls.*.friction", "floor.friction") if _is_number(scene, path)]
    return found + [path for path in MORE if path not in found and _is_number(scene, path)][seed % 7 :: 7][:2]


def _is_number(scene: carom.Scene, path: str) -> bool:
    """Return whether a path leads to positive numbers, or to vectors, that are finite."""
    try:
        values = path_match(scene, path).values
    except carom.CaromError:
        return False
    parts = [getattr(one, "value", one) for one in values]
    return all(
        (isinstance(one, float) and 0 < one < math.inf)
        or (isinstance(one, tuple) and all(isinstance(x, float) and math.isfinite(x) for x in one))
        for one in parts
    )


def sequence(run: Any, t: float) -> list[tuple[int, ...]]:
    rows = run.log[run.log["t"] <= t]
    names = ("kind", "ball", "met", "other", "phase_before", "phase", "regime")
    return [tuple(int(row[name]) for name in names) for row in rows]


def drawn_paths(scene: carom.Scene, seed: int) -> list[str]:
    """Return four numbers of a scene, drawn from all that it has: of every shape, option and form."""
    rng = np.random.default_rng([seed, 63])
    found = [path for path, value in leaves(scene) if isinstance(value, float) and _may_vary(scene, path, value)]
    return [str(path) for path in rng.choice(found, min(4, len(found)), replace=False)]


def _may_vary(scene: carom.Scene, path: str, value: float) -> bool:
    """Return whether a number of a scene can be a little larger and smaller, and has a derivative by itself."""
    if not (value and math.isfinite(value)) or path.startswith(("run.", "rack.")):
        return False
    for factor in (1 + 1e-6, 1 - 1e-6):
        try:
            replaced(scene, {path: value * factor})
        except carom.CaromError:
            return False
    return True


def compare(seed: int, drawn: bool = False) -> list[Case]:
    """Compare the derivatives of a random scene at a time between two of its events with those of differences.

    ``drawn``: of a scene of every shape and option, by numbers among all of its own.
    """
    scene = random_scene(seed) if drawn else scene_of_all_laws(seed)
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
    paths = drawn_paths(scene, seed) if drawn else paths_of(scene, seed)
    if not paths:
        return [Case(seed, "", "no parameter")]
    try:
        found = run.sensitivity(paths)
    except carom.CaromError as error:
        return [Case(seed, "", f"refused: {str(error)[:110]}")]
    at = found.at(t)
    told = np.concatenate([at.position, at.velocity], axis=1)  # (B, 6, p)
    passed = found._passages.values
    if np.nanmin(np.abs(passed["approach"][passed["time"] <= t]), initial=math.inf) < LOW:
        return [Case(seed, "", "bounces along a wall")]
    expected, cases = sequence(run, t), []
    for c, column in enumerate(found.columns):
        path = next(path for path in paths if column == path or column.startswith(path + "."))
        name = column
        cases.append(_one(scene, expected, t, name, path, float(found.values[c]), told[..., c], seed))
    return cases


def _shifted(scene: carom.Scene, name: str, path: str, by: float) -> carom.Scene:
    """Return the scene with a number, or a component, changed at every place of the path by as much."""
    match, changes = path_match(scene, path), {}
    for place, old in zip(match.places, match.values, strict=True):
        x = getattr(old, "value", old)
        k = None if name == path else "xyz".index(name[-1])
        changes[".".join(map(str, place))] = x + by if k is None else (*x[:k], x[k] + by, *x[k + 1 :])
    return replaced(scene, changes)


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
                    run = carom.simulate(_shifted(scene, name, path, sign * h))
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
            good, before = (
                rows[k][-1],
                (rows[k - 1][-1], rows[k - 1][-2], rows[k][-2] if len(rows[k]) > 1 else rows[k - 1][-2]),
            )
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
