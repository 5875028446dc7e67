"""Contacts that overlap in time, beside an integration by small steps: rows of balls, and layouts of balls at walls.

    python campaigns/clusters.py [N] [--first SEED]

N rows (300) of three to five balls of any size and mass, and N layouts of two to four equal balls at one or two walls, hard or
soft (0.3 or 3 ms): gaps of 0 to 0.1 mm, restitutions of 0.6 to 1, a third of them without loss; half with friction (0.05 to 0.3)
and spin. A ball comes with 1 m/s. The largest difference of a velocity, or of a spin times the radius, from
tests/reference/contacts_followed.py (steps of 0.1 us), which follows them until nothing will touch within 50 ms, at walls within 1,
10 or 50 ms, whichever ends where an event of carom does: nothing that overlaps is left out, and no later contact is blamed on it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from campaign import Row, campaign

import carom

RADIUS, MASS = 0.028575, 0.17
LIMIT = 0.01
KINDS = {"rows": None, "hard walls": 3e-4, "soft walls": 3e-3}  # contact times of the walls, s
# s: for so long nothing may touch at the end. What comes later is an event of its own, which begins with rigid contacts before it.
AHEAD = (0.001, 0.01, 0.05)
Random = np.random.Generator


def losses(rng: Random) -> tuple[float, float]:
    """A restitution and a friction."""
    e = 1.0 if rng.uniform() < 1 / 3 else rng.uniform(0.6, 1)
    return float(e), float(rng.uniform(0.05, 0.3)) if rng.uniform() < 0.5 else 0.0


def gap(rng: Random) -> float:
    """A gap, m: none at one of two."""
    return 0.0 if rng.uniform() < 0.5 else float(rng.uniform(0, 1e-4))


def row(rng: Random) -> Any:
    """Balls in a row, the first of which comes to the others."""
    from reference.contacts_followed import Layout

    count = int(rng.integers(3, 6))
    a = RADIUS * rng.uniform(0.6, 1.4, count)
    m = MASS * (a / RADIUS) ** 3 if rng.uniform() < 0.5 else MASS * np.exp(rng.uniform(-1.4, 1.4, count))
    x, v, w = np.zeros((3, count, 3))
    for k in range(1, count):
        x[k, 0] = x[k - 1, 0] + a[k - 1] + a[k] + (gap(rng) if k > 1 else 0)
    e, mu = losses(rng)
    v[0, 0] = 1
    if mu > 0:
        w[0] = rng.normal(size=3) / a[0]
    return Layout(a, m, x, v, w, e, mu)


def at_walls(rng: Random, time: float) -> Any:
    """Balls at walls and at each other, one of which is struck by another ball."""
    from reference.contacts_followed import Layout
    from reference.hertz_contacts import Wall

    e, mu = losses(rng)
    turn = math.radians(rng.uniform(40, 150))
    normals = [np.array([1.0, 0, 0]), np.array([math.cos(turn), math.sin(turn), 0])][: int(rng.integers(1, 3))]
    x = [np.zeros(3)]
    walls = []
    for n in normals:
        loss, rub = losses(rng)
        walls.append(Wall(-(RADIUS + gap(rng)) * n, n, time, loss, rub if mu > 0 else 0.0))
    for _ in range(int(rng.integers(1, 4))):
        while True:
            on, way = x[rng.integers(len(x))], rng.uniform(0, 2 * math.pi)
            there = on + (2 * RADIUS + gap(rng)) * np.array([math.cos(way), math.sin(way), 0])
            apart = min((np.linalg.norm(there - one) for one in x if one is not on), default=1.0)
            free = min(float((there - wall.point) @ wall.normal) for wall in walls) - RADIUS
            # (a ball near another one, or a wall, by chance, would be in the cluster or not by a hair)
            if apart > 2.3 * RADIUS and free > 0.3 * RADIUS:
                x.append(there)
                break
    v, w = np.zeros((2, len(x), 3))
    # the last one comes, and strikes the one that it was put at
    near = min(range(len(x) - 1), key=lambda k: float(np.linalg.norm(x[-1] - x[k])))
    line = (x[near] - x[-1]) / np.linalg.norm(x[near] - x[-1])
    x[-1] = x[near] - 2 * RADIUS * line
    cut = rng.uniform(-1.2, 1.2)
    v[-1] = math.cos(cut) * line + math.sin(cut) * np.array([-line[1], line[0], 0])
    if mu > 0:
        w[-1] = rng.normal(size=3) / RADIUS
    return Layout(np.full(len(x), RADIUS), np.full(len(x), MASS), np.array(x), v, w, e, mu, tuple(walls))


def drawn(kind: str, seed: int) -> Any:
    """A layout of a kind."""
    rng, time = np.random.default_rng([list(KINDS).index(kind), seed]), KINDS[kind]
    return row(rng) if time is None else at_walls(rng, time)


def scene_of(layout: Any, duration: float) -> carom.Scene:
    """The scene of a layout."""
    balls = [
        {"radius": a, "mass": m, "position": x, "velocity": v, "spin": w}
        for a, m, x, v, w in zip(*(np.array(one).tolist() for one in layout[:5]), strict=True)
    ]
    walls = [
        {"shape": "plane", "point": list(one.point), "normal": list(one.normal), "contact_time": one.contact_time,
         "restitution": one.restitution, "friction": one.friction}
        for one in layout.walls
    ]  # fmt: skip
    contact = {"restitution": layout.restitution, "friction": layout.friction}
    return carom.Scene(
        gravity=0, balls=balls, walls=walls, ball_contact=contact, run={"law": "contact", "duration": duration}
    )


def one(kind: str, seed: int) -> Row:
    """A row of the result."""
    from reference.contacts_followed import follow

    layout, off = drawn(kind, seed), np.inf
    for ahead in AHEAD if KINDS[kind] else AHEAD[-1:]:
        t, _x, v, w = follow(layout, 1e-7, ahead)
        # (what comes after the contacts, a wall a little farther, comes a little earlier or later: the state nearest to that)
        run = carom.simulate(scene_of(layout, t + ahead))
        for state in map(run.at, [*np.unique(run.log["t"]), t]):
            spins = layout.radius[:, None] * np.abs(state.spin - w)
            off = min(off, max(np.abs(state.velocity - v).max(), spins.max()))
    return {"kind": kind, "seed": seed, "off": float(off), "friction": layout.friction}


def main(words: Sequence[str] | None = None) -> None:
    """A line for each kind."""
    first = {"type": int, "default": 0, "help": "the first seed (default: 0)"}
    with campaign("clusters", __doc__, words, count=300, small=1, first=first) as run:
        counts = dict.fromkeys(KINDS, (run.count + 1) // 2) | {"rows": run.count}
        seeds = {kind: range(run.given.first, run.given.first + count) for kind, count in counts.items()}
        found = run.go_through([(kind, k) for kind in KINDS for k in seeds[kind]], one)
        for kind in KINDS:
            off = np.array([row["off"] for row in found if row["kind"] == kind])
            if len(off):
                median, ninth, worst = np.quantile(off, [0.5, 0.9, 1])
                above = int((off > LIMIT).sum())
                run.say(
                    f"{kind:18} {len(off)}: {above} above {LIMIT}; median {median:.1e}, nine in ten {ninth:.1e}, worst {worst:.1e}"
                )


if __name__ == "__main__":
    main()
