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
from carom.fitting.table_numbers import StatesBy
from carom.fitting.tracks import fit_tracks, model
from carom.simulation.sensitivity.sensitivity import states_at
from carom.tracks import Measured, Settings, measure

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
from reference.synthetic_bounces import SETTING, bounces
from reference.synthetic_runs import RADIUS, film


def tracks(shots: int) -> Measured:
    """The synthetic shots of docs/howto/fit_shots.md, measured."""
    return measure(film(np.random.default_rng(1), shots), Settings(radius=0.0, view="above", noise=3e-4))


@contextmanager
def by_differences() -> Iterator[None]:
    """Within, let fits of whole tracks take derivatives by one step forward, as they did before they were exact."""

    def states(table, frames, q, shared=False):
        def places(at, tried):
            balls, _by = model._on_table(at.arrays, frames, tried)
            return states_at(at.arrays, balls, frames.time, frames.count, 2)

        here, by_start = places(table, q), []
        for k in range(q.shape[1]):
            moves = k not in range(q.shape[1])[model.SLIP] or q[:, k].any()  # (no slip: held)
            h = 1e-6 * max(float(np.abs(q[:, k]).max()), 0.01)
            tried = q + h * np.eye(q.shape[1])[k]
            by_start.append((places(table, tried) - here) / h if moves else 0 * here)
        by_shared = []
        for k, one in enumerate(table.shared if shared else ()):
            h = 1e-6 * min(one.high - one.low, 1.0)
            h = -h if table.values[k] + h > one.high else h
            by_shared.append((places(table.at(table.values + h * np.eye(len(table.values))[k]), q) - here) / h)
        columns = [np.nan_to_num(np.stack(some, axis=-1)) if some else None for some in (by_start, by_shared)]
        return StatesBy(here, *columns)

    before, model._states = model._states, states
    try:
        yield
    finally:
        model._states = before


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
