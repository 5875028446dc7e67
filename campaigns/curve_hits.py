"""Launches in smooth curves against brute force: no crossing of a line or a parabola with the wall missed, none made up.

Each curve is the boundary of a billiard, and a wall of a scene: its arcs, asked through the address by which a run asks them.

    python campaigns/curve_hits.py [N] [--only CURVE]

N launches (1,000,000) a curve along lines and as many along parabolas; half from the wall, at angles down to 1e-3, a tenth of the
falling ones nearly or exactly vertical. Every hit must lie on the curve at the ball's distance, and brute force with
4,096 nodes must find no crossing before it, but for those within 1e-4 of the time scale. Ends with 1 if a launch is at fault.
"""

from __future__ import annotations

import ctypes
import functools
import sys
from collections.abc import Sequence

import numpy as np
from campaign import Row, campaign
from reference.curves import CURVES, depth, first_crossings, on_parallel

import carom
from carom import billiards
from carom.core.geometry.curve_arcs import HIT, NUMBERS, arc_address, arc_tables
from carom.core.jit.calls import address_of_table
from carom.scene.figures import OutlineFigure, Piece

NEAR = 1e-12  # m: a hit lies at the ball's distance from the curve to this
EARLIER = 1e-4  # s: a crossing that is earlier by less is not told apart
CHUNK = 20_000
GRAVITY = 1.0
SCENE = "scene: "
KINDS = [
    f"{user}{name}, {path}"
    for user in ("", SCENE)
    for name in CURVES
    for path in ("lines", "parabolas")
    if user or name != "swallowtail"  # (billiards refuse a ball that is larger than a radius of curvature)
]
SLOW = 1e-14  # m/s: approach that counts as rounding


class Given(Piece):
    """A piece by the formula of a reference curve."""

    def __init__(self, curve: object) -> None:
        self.curve = curve
        self.at, self.span = curve.at, curve.span  # type: ignore[attr-defined,method-assign]

    def at(self, t: object) -> object:  # type: ignore[override]
        """(replaced)"""

    def span(self) -> object:  # type: ignore[override]
        """(replaced)"""


def table(name: str) -> tuple[billiards.Table, carom.Disc]:
    """Return the table of a curve, and its ball."""
    curve, a = CURVES[name]
    made = billiards.table(OutlineFigure(loops=[[Given(curve)]]), bounds="surface" if a else "centre")
    return made, carom.Disc(a or 1.0, 1.0)


def launches(kind: str, seed: int, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return places and velocities (N, 2), half of them from the wall, and the acceleration."""
    name, path = kind.removeprefix(SCENE).split(", ")
    curve, a = CURVES[name]
    rng = np.random.default_rng([seed, KINDS.index(kind)])
    half = count // 2
    x, n = np.empty((0, 2)), np.empty((0, 2))
    while len(x) < half:  # (where a ball touches that is larger than a radius of curvature elsewhere)
        y, d, _dd = curve.at(rng.uniform(*curve.span(), 2 * half))
        m = np.stack([-d[:, 1], d[:, 0]], -1) / np.hypot(*d.T)[:, None]
        on = depth(curve, y + a * m) > a - 1e-13
        x, n = np.concatenate([x, (y + a * m)[on]]), np.concatenate([n, m[on]])
    x, n = x[:half], n[:half]
    angle = np.pi / 2 * (1 - 10 ** rng.uniform(-3, 0, half)) * rng.choice([-1, 1], half)
    v = np.cos(angle)[:, None] * n + np.sin(angle)[:, None] * np.stack([-n[:, 1], n[:, 0]], -1)
    inner = np.empty((0, 2))
    box = on_parallel(curve, 0.0, np.linspace(0, 2 * np.pi, 500))
    while len(inner) < half:
        y = rng.uniform(box.min(0), box.max(0), (2 * half, 2))
        inner = np.concatenate([inner, y[curve.holds(y) & (depth(curve, y) > a)]])
    turn = rng.uniform(0, 2 * np.pi, half)
    x, v = np.concatenate([x, inner[:half]]), np.concatenate([v, np.stack([np.cos(turn), np.sin(turn)], -1)])
    if path == "lines":
        return x, v, np.zeros(2)
    v *= rng.uniform(0.2, 2.2, (2 * half, 1))
    upright = half + np.arange(half // 5)
    v[upright, 0] *= np.where(np.arange(len(upright)) % 2, 0.0, 10 ** rng.uniform(-12, -2, len(upright)))
    return x, v, np.array([0.0, -GRAVITY])


def met_by_orbit(name: str, x: np.ndarray, v: np.ndarray, g: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return times (N) and places (N, 2) of the first bounces in a billiard; NaN where there is none."""
    made, ball = table(name)
    made = billiards.under(made, g) if g.any() else made
    found = billiards.orbit(made, (x, v, 0.0), 1, ball=ball, law="mirror", at_corner="pass")
    # (a flight of less than rounding leaves no bounce: it grazes)
    return np.where(found.count == 0, np.nan, found.t[:, 0]), found.position[:, 0]


def met_by_arcs(name: str, x: np.ndarray, v: np.ndarray, g: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return times (N) and places (N, 2) of the first contacts with the arcs of a scene's wall; NaN where there is none."""
    curve, a = CURVES[name]
    ask = ctypes.CFUNCTYPE(None, *[ctypes.c_double] * NUMBERS, ctypes.c_void_p)(arc_address())
    out = (ctypes.c_double * 6)()
    place, t = ctypes.addressof(out), np.full(len(x), np.inf)
    tables = arc_tables(curve.at, *curve.span())
    for address in [float(address_of_table(one)) for one in tables]:
        for k, ((px, py), (vx, vy)) in enumerate(zip(x.tolist(), v.tolist(), strict=True)):
            ask(HIT, address, a, px, py, vx, vy, *g.tolist(), t[k], SLOW, place)
            t[k] = min(t[k], out[0])
    t[np.isinf(t)] = np.nan
    return t, x + v * t[:, None] + g * (t * t / 2)[:, None]


def judge(kind: str, seed: int, count: int) -> Row:
    """Count launches, misses, hits that are none, and launches without a hit."""
    name = kind.removeprefix(SCENE).split(", ", maxsplit=1)[0]
    curve, a = CURVES[name]
    x, v, g = launches(kind, seed, count)
    t, place = (met_by_arcs if kind.startswith(SCENE) else met_by_orbit)(name, x, v, g)
    none = np.isnan(t)
    off = np.abs(depth(curve, place[~none]) - a)
    t = np.where(none, np.inf, t)
    earlier = first_crossings(curve, a, x, v, g, t - EARLIER, after=1e-6)
    missed = np.isfinite(earlier) & ~none
    return {
        "launches": len(x), "missed": int(missed.sum()), "off": float(off.max()), "none": int(none.sum()),
        "first": int(np.argmax(missed)) if missed.any() else -1,
    }  # fmt: skip


def main(words: Sequence[str] | None = None) -> int:
    """Judge so many launches of each curve; 1 if one is at fault."""
    bad = 0
    with campaign("curve_hits", __doc__, words, count=1_000_000, small=2_000) as run:
        for kind in KINDS:
            if not run.wants(kind, KINDS):
                continue
            one = functools.partial(judge, count=min(CHUNK, run.count))
            rows = run.go_through([(kind, seed) for seed in range(-(-run.count // CHUNK))], one)
            if not rows:
                continue
            missed, none = sum(row["missed"] for row in rows), sum(row["none"] for row in rows)
            off = max(row["off"] for row in rows)
            judged = sum(row["launches"] for row in rows)
            faults = missed + none + (off > NEAR)
            run.say(f"{kind}: {judged:,} launches, {missed} missed, {none} without a hit, hits within {off:.1e} m")
            bad += int(faults > 0)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
