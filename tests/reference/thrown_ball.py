"""A hollow ball thrown without spin, filmed from the side: flights and bounces on a floor with Coulomb friction, in closed form."""

from __future__ import annotations

import numpy as np

from carom.tracks import Track

RADIUS, KAPPA, GRAVITY = 0.033, 2 / 3, 9.80665
Bounce = tuple[float, float, float, float, float, float]


def thrown(
    speed: float, height: float, restitution: float = 0.78, friction: float = 0.15, count: int = 3, spin: float = 0.0
) -> list[Bounce]:
    """Bounces of a ball that starts level: time, v_n and v_t before, spin before (along v_t), v_n and v_t after."""
    found, t, up = [], 0.0, 0.0
    fall = height - RADIUS
    for _ in range(count):
        down = float(np.sqrt(up**2 + 2 * GRAVITY * fall))
        t += (up + down) / GRAVITY
        slip = speed - RADIUS * spin
        change = np.sign(slip) * min(friction * (1 + restitution) * down, abs(slip) / (1 + 1 / KAPPA))
        found.append((t, down, speed, spin, restitution * down, speed - change))
        speed, spin, up, fall = speed - change, spin + change / (KAPPA * RADIUS), restitution * down, 0.0
    return found


def film(bounces: list[Bounce], rate: float = 240.0, noise: float = 5e-4, seed: int = 1, scale: float = 1.0) -> Track:
    """The track of a ball from its start to the end of the flight after the last bounce, in units of 1/scale m: x along, y up."""
    t = np.arange(0, bounces[-1][0] + 1.9 * bounces[-1][4] / GRAVITY, 1 / rate)
    first = bounces[0]
    x, y = first[2] * t, RADIUS + GRAVITY / 2 * (first[0] ** 2 - t**2)
    place, last = 0.0, 0.0  # of the bounce before
    for begin, _down, before, _spin, up, after in bounces:
        place, last = place + before * (begin - last), begin
        later, since = t >= begin, t - begin
        x = np.where(later, place + after * since, x)
        y = np.where(later, RADIUS + up * since - GRAVITY / 2 * since**2, y)
    seen = np.stack([x, y], axis=-1) + np.random.default_rng(seed).normal(0, noise, (len(t), 2))
    return Track("ball", t, scale * seen)


def table(films: list[list[Bounce]], sigma: float = 2e-3, seed: int = 1) -> dict[str, list[str]]:
    """Rebounds of several films as cells of a table, as ``carom tracks`` writes them: no spin was seen."""
    rng = np.random.default_rng(seed)
    rows = []
    for number, bounces in enumerate(films):
        for bounce, (t, *speeds) in enumerate(bounces, 1):
            seen = [speeds[0], speeds[1], speeds[3], speeds[4]] + sigma * rng.normal(size=4)
            rows.append([f"film{number}", "", "ball", str(bounce), f"{t:.4f}", *(f"{v:.6f}" for v in seen), ""])
    names = ("film", "shot", "ball", "bounce", "t", "v_n_in", "v_t_in", "v_n_out", "v_t_out", "spin_in")
    found = {name: [row[i] for row in rows] for i, name in enumerate(names)}
    return found | {f"sigma_{name}": [str(sigma)] * len(rows) for name in names[5:9]}


def as_csv(columns: dict[str, list[str]]) -> str:
    """The table as text."""
    return "\n".join([",".join(columns), *(",".join(row) for row in zip(*columns.values(), strict=True))]) + "\n"
