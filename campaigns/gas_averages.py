"""Exact means over time of gases, beside dense samples of the same runs.

    python campaigns/gas_averages.py [COLLISIONS, 1000000] [--only shaken]

A gas of 20, 1,000 or 100,000 balls that cools, falls between walls or stands on a shaken floor is advanced by so many collisions
(the cooling one by 50 for each ball at most: its speeds fall for ever), and looked at 2,000 times on the way (a few balls up to
50,000 times), at random times within intervals of equally many collisions, by whose lengths these samples are weighted. Printed
are the relative differences between the exact means and those of the samples: of the energies of translation, spins and
height, and of the density in layers (root mean square).
What is left is the scatter of the samples, which falls with their number.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from campaign import campaign

import carom
from carom.gas import Drive, Gas, Species

SAMPLES = 2000
COOLING = 50  # collisions of a gas that cools, for each ball
ROUGH = carom.Surface(0.95, 0.3, 0.4)


def gases(balls: int) -> dict[str, Gas]:
    disc, ball = carom.Disc(0.5, 1.0), carom.Ball(0.5, 1.0)
    wide, side = (2.0 * balls) ** 0.5 + 4.0, (balls / 0.2) ** (1 / 3) + 3.0
    shaken = {"gravity": (0.0, -0.5), "contact_time": 1e-5, "drives": {"bottom": Drive(amplitude=0.5, frequency=1.0)}}
    elastic = carom.Surface(1.0, math.inf, 1.0)  # (sliding friction would bring the gas to rest)
    return {
        "cooling": Gas([Species(ball, balls)], (side,) * 3, contacts=ROUGH, contact_time=1e-6),
        "falling": Gas([Species(ball, balls)], (side,) * 3, periodic=False, contacts=elastic, gravity=(0, 0, -0.1)),
        "shaken": Gas([Species(disc, balls)], (wide, 2 * wide), periodic=(True, False), contacts=ROUGH, **shaken),
    }  # fmt: skip


def main(words: Sequence[str] | None = None) -> None:
    """A line for each gas and number of balls."""
    with campaign("gas_averages", __doc__, words, count=10**6, small=400) as run:
        rng = np.random.default_rng(1)
        for balls in (20,) if run.small else (20, 1000, 100_000):
            every = gases(balls)
            for name, gas in every.items():
                if run.wants(name, every):
                    most = min(run.count, COOLING * balls) if name == "cooling" else run.count
                    run.say(f"{balls:7,} balls, {name:8}", compared(gas, most, 50 if run.small else SAMPLES, rng))


def compared(gas: Gas, collisions: int, samples: int, rng: np.random.Generator) -> str:
    """The differences of the means: the times come from a trial of the same gas."""
    samples = (
        max(samples, min(50_000, 1_000_000 // len(gas.balls().species), collisions)) if samples == SAMPLES else samples
    )
    trial, ends = Gas.restore(gas.state()), []
    for k in range(samples):
        trial.advance((k + 1) * collisions // samples - k * collisions // samples)
        ends.append(trial.time)
    starts = np.array([gas.time, *ends[:-1]])
    widths = np.array(ends) - starts
    mark, energies, heights = gas.mark(), np.zeros(3), []
    layers = gas.measured_since(mark).averages.layers
    for start, width in zip(starts, widths, strict=True):
        gas.advance(until=start + rng.uniform() * width)
        energies += np.array(gas.energy()) * (width / widths.sum())
        if layers is not None:
            height = gas.balls().position[:, "xyz".index(layers.axis)]
            heights.append(np.histogram(height, layers.edges)[0])
    gas.advance(until=ends[-1])
    found = gas.measured_since(mark).averages
    count, axes = len(gas.balls().species), len(found.stress)
    exact = np.array([
        found.temperature * axes * count / 2, found.temperature_rotational * (3 if axes == 3 else 1) * count / 2,
        found.potential_energy,
    ])  # fmt: skip
    parts = [
        f"{what} {abs(one / two - 1):.1e}"
        for what, one, two in zip(("translation", "spins", "height"), energies, exact, strict=True)
        if two != 0
    ]
    if found.layers is not None:
        mean = np.average(heights, axis=0, weights=widths)
        parts.append(f"density {np.sqrt(np.mean((mean - found.layers.number[0]) ** 2)) / mean.mean():.1e}")
    return ", ".join(parts)


if __name__ == "__main__":
    main()
