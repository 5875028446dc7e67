"""How long fits take: one law to 10,000 rebounds, 1,000 bootstrap fits to 100, and whole tracks, also by differences.

python benchmarks/fits.py
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from rows import REPEATS, SMALL, alone, paired, report, run_script, seconds, usually

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


@contextmanager
def by_differences() -> Iterator[None]:
    """Within, let fits of whole tracks take derivatives by one step forward, as they did before they were exact."""

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

    before = objective._start_slope, objective.shared_slope
    objective._start_slope = start_slope
    objective.shared_slope = errors.shared_slope = shared_slope
    try:
        yield
    finally:
        objective._start_slope, objective.shared_slope = before
        errors.shared_slope = before[1]


def whole(measured: Measured) -> list[float]:
    """Return the times of five fits, s."""
    times = [
        seconds(lambda: fit_tracks(measured, Setting(radius=RADIUS, noise=3e-4), ["two-step"]))
        for _ in range(REPEATS + 1)
    ]
    return times[1:]


def main() -> None:
    """Six rows."""
    contact = laws_named(["contact"], "planar", True)[0][0]
    rows, draws = usually(10_000, 100), usually(1000, 2)
    many, _ = make_problem(make_rebounds("planar", bounces(0, rows, 0.02, 2.0, False)), SETTING)
    some, _ = make_problem(make_rebounds("planar", bounces(0, 100, 0.02, 2.0, False)), SETTING)
    report(alone(f"one law fitted to {rows:,} rebounds", lambda: fit_law(contact, many), unit="fit"))
    fit = fit_law(contact, some)
    report(alone("a bootstrap fit of 100 rebounds", lambda: with_bootstrap(fit, draws), count=draws, unit="fit"))
    films = {shots: tracks(shots) for shots in ([] if SMALL else [3, 30])}
    exact = {shots: whole(seen) for shots, seen in films.items()}
    with by_differences():
        for shots, seen in films.items():
            pairs = list(zip(exact[shots], whole(seen), strict=True))
            report(paired(f"{shots} whole tracks fitted", pairs, "derivatives by differences", count=1, unit="fit"))


if __name__ == "__main__":
    run_script(main)
