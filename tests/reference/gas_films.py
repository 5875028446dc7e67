"""Made-up films of gases: tracks of discs with noise."""

from __future__ import annotations

import numpy as np

from carom.gas import GasScene
from carom.gas.session import build

SIDE = 40.0


def scene(restitution=0.85, friction=0.3, tangential_restitution=0.4, count=60, seed=1, sides=(SIDE, SIDE)):
    """Discs in a square, or balls in a box of three sides."""
    contact = {
        "between": ("a", "a"), "restitution": restitution, "friction": friction, "tangential_restitution": tangential_restitution,
    }  # fmt: skip
    return GasScene(
        container={"shape": "periodic", "size": sides}, contacts=[contact], contact_time=1e-6,
        species=[{"count": count, "radius": 0.5, "temperature_rotational": 0.2}], run={"max_events": 1000, "seed": seed},
    )  # fmt: skip


def film(one, frames=150, interval=0.15, noise=0.001, spin_noise=0.05, seed=1):
    """Tracks as columns, unwrapped; no noise gives the simulation's own numbers."""
    gas, rng = build(one), np.random.default_rng(seed)
    axes = one.container.dimensions
    names, spins = ("x", "y", "z")[:axes], ("wx", "wy", "wz")[-1 if axes == 2 else 0 :]
    sides, rows = np.array(one.container.size), []
    for k in range(frames):
        if k:
            gas.advance(until=k * interval)
        now = gas.balls()
        x = now.position[:, :axes] + now.images[:, :axes] * sides
        rows.append(np.column_stack([np.full(len(x), k * interval), np.arange(len(x)), x, now.spin[:, -len(spins) :]]))
    table = np.concatenate(rows)
    table[:, 2 : 2 + axes] += noise * rng.standard_normal((len(table), axes))
    table[:, 2 + axes :] += spin_noise * rng.standard_normal((len(table), len(spins)))
    return dict(zip(("t", "ball", *names, *spins), table.T, strict=True))
