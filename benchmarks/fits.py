"""How long fits take: one law to 10,000 rebounds, 1,000 bootstrap fits to 100, and whole tracks, also by differences.

python benchmarks/fits.py
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

import numpy as np

from carom.data.rebounds import make_rebounds
from carom.fitting import Setting, fit_law, make_problem, with_bootstrap
from carom.fitting.laws import laws_named
from carom.fitting.tracks import errors, fit_tracks, objective
from carom.tracks import Measured, Settings, measure

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
from reference.synthetic_bounces import SETTING, bounces
from reference.synthetic_runs import RADIUS, film


def tracks(shots: int) -> Measured:
    """The synthetic shots of docs/howto/whole_tracks.md, measured."""
    return measure(film(np.random.default_rng(1), shots), Settings(radius=0.0, view="above", noise=3e-4))


def by_differences() -> None:
    """Let fits of whole tracks take derivatives by one step forward, as they did before they were exact."""

    def start_slope(table, frames, starts, q):
        gap = objective._many(table.setup, frames, q[:, None])
        columns = np.flatnonzero(starts.free.any(axis=0))
        tried = np.repeat(q[:, None], len(columns), axis=1)
        tried[:, np.arange(len(columns)), columns] += 1e-6 * starts.scale[:, columns]
        slope = np.zeros((len(q), gap.shape[-1], q.shape[1]))
        slope[:, :, columns] = np.moveaxis(objective._many(table.setup, frames, tried) - gap, 1, 2) / 1e-6
        return slope * starts.free[:, None]

    def shared_slope(model, frames, q, numbers):
        found = []
        here = objective._many(model.table(numbers).setup, frames, q[:, None])[:, 0]
        for name, parameter in model.free.items():
            h = 1e-6 * min(parameter.high - parameter.low, 1.0)
            h = -h if numbers[name] + h > parameter.high else h
            there = objective._many(model.table({**numbers, name: numbers[name] + h}).setup, frames, q[:, None])[:, 0]
            found.append((there - here) / h)
        return np.stack(found, axis=-1)

    objective._start_slope = start_slope
    objective.shared_slope = errors.shared_slope = shared_slope


def whole(measured: Measured) -> float:
    """Return the least time of five fits, s."""
    times = []
    for _ in range(6):
        start = time.perf_counter()
        fit_tracks(measured, Setting(radius=RADIUS, noise=3e-4), ["two-step"])
        times.append(time.perf_counter() - start)
    return min(times[1:])


def main() -> None:
    """Six lines."""
    contact = laws_named(["contact"], "planar", True)[0][0]
    many, _ = make_problem(make_rebounds("planar", bounces(0, 10_000, 0.02, 2.0, False)), SETTING)
    some, _ = make_problem(make_rebounds("planar", bounces(0, 100, 0.02, 2.0, False)), SETTING)
    fit_law(contact, many)
    start, cpu = time.perf_counter(), time.process_time()
    fit_law(contact, many)
    print(
        f"one law, 10,000 rebounds: {time.perf_counter() - start:.2f} s ({time.process_time() - cpu:.2f} s of processor)"
    )
    fit = fit_law(contact, some)
    with_bootstrap(fit, 10)
    start, cpu = time.perf_counter(), time.process_time()
    with_bootstrap(fit, 1000)
    print(
        f"1,000 bootstrap fits of 100: {time.perf_counter() - start:.2f} s ({time.process_time() - cpu:.2f} s of processor)"
    )
    films = {shots: tracks(shots) for shots in (3, 30)}
    exact = {shots: whole(seen) for shots, seen in films.items()}
    by_differences()
    for shots, seen in films.items():
        plain = whole(seen)
        ratio = plain / exact[shots]
        print(
            f"{shots} whole tracks: {exact[shots]:.3f} s by exact derivatives, {plain:.3f} s by differences ({ratio:.2f})"
        )


if __name__ == "__main__":
    main()
