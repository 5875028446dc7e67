"""Laws against learners: five-fold held-out scores of a law, a law with functions of the impact, a Gaussian process, both, a net.

    python docs/dev/contest.py                                              the published sets
    python docs/dev/contest.py TABLE.csv --radius 0.02 --inertia hollow     a table of your own; --by COLUMN: each surface apart
    python docs/dev/contest.py --only films                                 the sets whose name contains a text
    python docs/dev/contest.py --left-out                                   the filmed row that no law explains, after the others

Everything is chosen and fitted within the four fifths that train: the law by AICc, forms and splines by held-out rows among them.
The log score is the mean log density of a held-out row, in m/s (a spin counts as the radius times its size). The lengths are
those of Gossard (arXiv 2604.11349): mean length of the error of the velocity, mean absolute error of the spin.

Learners are told of the mirror: a bounce to the left is one to the right. Where the scatter of contacts is a share of the speed,
they learn shares of the speed. Spins that nobody measured are integrated over the prior that was fitted with the law.
"""

from __future__ import annotations

import argparse
import math
import warnings
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from carom.bodies import inertia_number
from carom.data import published_rebounds, read_rebounds
from carom.fitting import Setting, fit_law, make_problem
from carom.fitting.forms import choose_forms
from carom.fitting.laws import FORMS, laws_for
from carom.fitting.model import predict_law
from carom.fitting.rows import Problem
from carom.fitting.varying import predictive_of

FOLDS, SPINS = 5, 400
LEAST_NOISE = 1e-3  # of a Gaussian process: its variance, in that of the outputs
LEAST_LENGTH = 1.0  # in standard deviations of an input
FEW_FORMS = ("line", "viscoelastic")
FILMED = Path(__file__).parents[1] / "data" / "carom_tracks_rebounds.csv"


class Answer(NamedTuple):
    """What a contestant says of the rows that were left out."""

    mean: Any
    """(N, 3)"""
    error: Any
    """(N, 3)"""
    logs: Any
    """(N,) log densities."""


_BEST: dict[tuple[int, str], tuple[Problem, Any]] = {}  # of training rows, which more than one contestant asks for


def best_law(problem: Problem, setting: Setting) -> Any:
    """Return the law with the least AICc."""
    key = (id(problem), str(setting.restitution))
    if key not in _BEST:
        rows = replace(problem, setting=setting)
        laws = laws_for(rows.rebounds.kind, setting.contact_height == 1.0)
        _BEST[key] = (problem, min((fit_law(law, rows) for law in laws), key=lambda fit: fit.aicc))
    return _BEST[key][1]


def answer(fit: Any, test: Problem) -> Answer:
    """Return what a fit says of other rows."""
    if test.spins is not None:
        return _over_spins(fit, test)
    said = predictive_of(fit)
    rows = said.of_rows(test)
    return Answer(rows.mean, rows.stderr, said.log_density(test))


def _over_spins(fit: Any, test: Problem) -> Answer:
    """Return mean, error and density over the spins of the fitted prior, at the fitted numbers, with the fitted scatter."""
    from scipy.special import logsumexp, ndtri

    test = replace(test, setting=fit.problem.setting)  # (with the form of its restitution)
    places = {name: one.value for name, one in fit.estimates.items()}
    v, n = np.hypot(test.x[:, 0], test.x[:, 1]), len(test.x)
    share = ndtri((np.arange(SPINS) + 0.5) / SPINS)
    sigma = places.get("spin_mean", 0.0) * (test.x[:, 1] / v) + np.multiply.outer(
        share, places.get("spin_width", 0.0) + 0 * v
    )
    every = test.select(np.tile(np.arange(n), SPINS))
    x = every.x.copy()
    x[:, 2] = np.where(test.unknown, sigma * v / test.setting.radius, test.x[:, 2]).ravel()

    def after(x: Any) -> Any:
        return predict_law(fit.law, replace(every, x=x, spins=None), fit.numbers)[:, :2].reshape(SPINS, n, 2)

    here = after(x)
    size = fit.scatter.get("contacts", 0.0) * (v if test.setting.scatter == "share" else 1.0)
    s = np.einsum("nm,mk->nmk", test.vy[:, :2] + np.square(size)[:, None], np.eye(2))[None]
    for o in (0, 1):  # errors of the velocity before the wall
        step = np.zeros_like(x)
        step[:, o] = np.sqrt(every.vx[:, o])
        off = after(x + step) - here
        s = s + off[..., :, None] * off[..., None, :]
    r = test.y[:, :2] - here
    c = np.einsum("jnm,jnmk,jnk->jn", r, np.linalg.inv(s), r)
    logs = logsumexp(-0.5 * (c + np.linalg.slogdet(s)[1]), axis=0) - math.log(SPINS) - math.log(2 * math.pi)
    error = np.sqrt(here.var(axis=0) + np.einsum("jnmm->jnm", s).mean(axis=0))
    return Answer(*(np.pad(one, ((0, 0), (0, 1)), constant_values=np.nan) for one in (here.mean(axis=0), error)), logs)


def law(train: Problem, test: Problem) -> Answer:
    """Constants."""
    return answer(best_law(train, train.setting), test)


def law_of_speed(train: Problem, test: Problem) -> Answer:
    """The restitution as that function of the normal speed, of a scene or a line, which has the least AICc.

    Where spins are integrated over, which takes long, only the law whose constants have the least AICc is tried, with few forms.
    """
    if train.spins is None:
        fits = [best_law(train, replace(train.setting, restitution=form)) for form in FORMS]
    else:
        fits = [best_law(train, train.setting)]
        settings = [replace(train.setting, restitution=form) for form in FEW_FORMS]
        fits += [fit_law(fits[0].law, replace(train, setting=one)) for one in settings]
    return answer(min(fits, key=lambda fit: fit.aicc), test)


def law_and_functions(train: Problem, test: Problem) -> Answer:
    """Forms and splines of the impact, chosen by rows held out of those that train."""
    choice = choose_forms(best_law(train, train.setting), noise=False)
    return answer(choice.best.fit, test)


def law_and_process(train: Problem, test: Problem) -> Answer:
    """Constants, and a Gaussian process of what they leave, in error bars of the law's prediction; its noise is of their size."""
    fit = best_law(train, train.setting)
    said, left = answer(fit, test), answer(fit, train)
    mean, error, logs = said.mean.copy(), said.error.copy(), np.zeros(len(test.y))
    units, sides = np.array([1.0, 1.0, train.setting.radius]), (_side(train), _side(test))
    for i in np.flatnonzero(np.isfinite(train.y).all(axis=0)):
        process = _Process(residuals=True)
        process.fit(_inputs(train), ((train.y - left.mean) / left.error * sides[0])[:, i])
        off, wide = process.predict(_inputs(test))
        mean[:, i] += sides[1][:, i] * said.error[:, i] * off
        error[:, i] *= wide
        logs += _normal((test.y - mean)[:, i] * units[i], error[:, i] * units[i])
    return Answer(mean, error, logs)


def _side(problem: Problem) -> Any:
    """Return the signs (N, 3) by which a mirror turns all bounces to one side."""
    side = np.where(problem.x[:, 1] < 0, -1.0, 1.0)
    return np.stack([np.ones_like(side), side, side], axis=-1)


def _unit(problem: Problem) -> Any:
    """Return the units (N, 3) of velocities and spins for learners: m/s along one side, or shares of the speed."""
    speed = (
        np.hypot(problem.x[:, 0], problem.x[:, 1]) if problem.setting.scatter == "share" else np.ones(len(problem.x))
    )
    return _side(problem) * np.stack([speed, speed, speed / problem.setting.radius], axis=-1)


def _inputs(problem: Problem) -> Any:
    """Return what moves among the impacts (N, k)."""
    return problem.x * _side(problem) * (1, 1, problem.setting.radius)


def _normal(off: Any, error: Any) -> Any:
    return -0.5 * (off / error) ** 2 - np.log(error) - 0.5 * math.log(2 * math.pi)


def _learnt(learner: Callable[[], Any], train: Problem, test: Problem) -> Answer:
    """Return the answer of one learner for each output; ``learner()`` has fit(x, y) and predict(x) -> mean, error."""
    seen, unit = np.isfinite(train.y).all(axis=0), _unit(test)
    mean, error, logs = np.full(test.y.shape, np.nan), np.full(test.y.shape, np.nan), np.zeros(len(test.y))
    for i in np.flatnonzero(seen):
        one = learner()
        one.fit(_inputs(train), (train.y / _unit(train))[:, i])
        said, wide = one.predict(_inputs(test))
        mean[:, i], error[:, i] = said * unit[:, i], wide * np.abs(unit[:, i])
        a = test.setting.radius if i == 2 else 1.0
        logs += _normal((test.y - mean)[:, i] * a, error[:, i] * a)
    return Answer(mean, error, logs)


class _Scaled:
    """Inputs and output of a learner in their standard deviations; inputs that all rows share are left out."""

    def scaled(self, x: Any, y: Any) -> tuple[Any, Any]:
        self.moving = np.nan_to_num(x.std(axis=0)) > 0
        x = x[:, self.moving]
        self.center, self.size, self.shift, self.scale = x.mean(axis=0), x.std(axis=0), y.mean(), y.std()
        return (x - self.center) / self.size, (y - self.shift) / self.scale

    def inputs(self, x: Any) -> Any:
        return (x[:, self.moving] - self.center) / self.size


class _Process(_Scaled):
    """scikit-learn's Gaussian process: a line, a squared exponential with a length for each input, and noise."""

    def __init__(self, residuals: bool = False) -> None:
        self.residuals = residuals

    def fit(self, x: Any, y: Any) -> None:
        from sklearn.gaussian_process import GaussianProcessRegressor
        from sklearn.gaussian_process.kernels import RBF, ConstantKernel, DotProduct, WhiteKernel

        x, scaled = self.scaled(x, y)
        smooth = ConstantKernel(1.0, (1e-4, 1e4)) * RBF(np.ones(x.shape[1]), (LEAST_LENGTH, 100))
        if self.residuals:  # of a law, in error bars
            kernel, scaled, self.shift, self.scale = smooth + WhiteKernel(1.0, (0.1, 2.0)), y, 0.0, 1.0
        else:
            kernel = DotProduct(1.0) + smooth + WhiteKernel(0.01, (LEAST_NOISE, 10))
        self.process = GaussianProcessRegressor(kernel, n_restarts_optimizer=1, random_state=0).fit(x, scaled)

    def predict(self, x: Any) -> tuple[Any, Any]:
        mean, error = self.process.predict(self.inputs(x), return_std=True)
        return mean * self.scale + self.shift, error * self.scale


class _Net(_Scaled):
    """scikit-learn's net with eight hidden units; its error is that of training rows that four other nets left out."""

    def _one(self, x: Any, y: Any) -> Any:
        from sklearn.neural_network import MLPRegressor

        settings: dict[str, Any] = {
            "activation": "tanh",
            "solver": "lbfgs",
            "alpha": 0.1,
            "max_iter": 2000,
            "random_state": 0,
        }
        return MLPRegressor(hidden_layer_sizes=(8,), **settings).fit(x, y)

    def fit(self, x: Any, y: Any) -> None:
        x, y = self.scaled(x, y)
        fold, off = np.arange(len(x)) % 4, np.zeros(len(x))
        for one in range(4):
            out = fold == one
            off[out] = y[out] - self._one(x[~out], y[~out]).predict(x[out])
        self.net, self.error = self._one(x, y), float(np.sqrt(np.square(off).mean()))

    def predict(self, x: Any) -> tuple[Any, Any]:
        mean = self.net.predict(self.inputs(x)) * self.scale + self.shift
        return mean, np.full(len(mean), self.error * self.scale)


CONTESTANTS: dict[str, Callable[[Problem, Problem], Answer]] = {
    "law": law,
    "law, e(v)": law_of_speed,
    "law and functions": law_and_functions,
    "law and process": law_and_process,
    "Gaussian process": lambda train, test: _learnt(_Process, train, test),
    "net": lambda train, test: _learnt(_Net, train, test),
}


LAWS = ("law", "law, e(v)", "law and functions")


def contest(problem: Problem, names: Any = tuple(CONTESTANTS)) -> dict[str, dict[str, Any]]:
    """Return scores of the contestants: per row the log score, the length of the velocity's error, the spin's absolute error."""
    n, found = len(problem.x), {}
    fold = np.arange(n) % FOLDS
    parts = [(fold == one, problem.select(fold != one), problem.select(fold == one)) for one in range(FOLDS)]
    for name in names:
        mean, logs = np.full((n, 3), np.nan), np.zeros(n)
        for out, train, test in parts:
            said = CONTESTANTS[name](train, test)
            mean[out], logs[out] = said.mean, said.logs
        off = mean - problem.y
        velocity = np.hypot(*np.where(np.isfinite(problem.y), off, 0.0)[:, :2].T)
        found[name] = {"score": logs, "velocity": velocity, "spin": np.abs(off[:, 2])}
    return found


def where_it_wins(problem: Problem, gain: Any) -> str:
    """Return the mean gain of a learner over a law in the four quarters of speed and slip angle (of incidence, without spins)."""
    speed = np.hypot(problem.x[:, 0], problem.x[:, 1])
    slip = np.abs(problem.x[:, 1] - problem.setting.radius * np.nan_to_num(problem.x[:, 2]))
    angle = np.degrees(np.arctan2(slip, problem.x[:, 0]))
    fast, steep = speed > np.median(speed), angle > np.median(angle)
    parts = []
    for quick, words in ((False, "slow"), (True, "fast")):
        for wide, more in ((False, "little slip"), (True, "much slip")):
            some = (fast == quick) & (steep == wide)
            parts.append(f"{words}, {more}: {gain[some].mean():+.2f}" if some.any() else f"{words}, {more}: no rows")
    return f"(beyond {np.median(speed):.3g} m/s, {np.median(angle):.3g} degrees) " + "; ".join(parts)


def sets(arguments: Any) -> list[tuple[str, Problem]]:
    """Return the data sets as problems."""
    if arguments.table:
        setting = Setting(radius=arguments.radius, kappa=inertia_number(arguments.inertia))
        tables = [(arguments.table, read_rebounds(arguments.table), setting)]
        by = arguments.by
    else:
        chosen = {
            name: published_rebounds(name) for name in ("tt_rackets", "kharaz2001", "mathavan2009", "alciatore_tpb28")
        }
        tables, by = [(name, one.rebounds, Setting(**one.setting)) for name, one in chosen.items()], "racket"
        films = read_rebounds(FILMED)
        cushion = Setting(radius=0.03075, contact_height=1.2033, scatter="share")
        tables.append(("films", films.select(films.extra["use"] == "yes"), cushion))
    found = []
    for name, rows, setting in tables:
        labels = rows.extra.get(by) if by else None
        parts = (
            [(name, rows)]
            if labels is None
            else [(f"{name} {one}", rows.select(labels == one)) for one in np.unique(labels)]
        )
        found += [(label, make_problem(part, setting)[0]) for label, part in parts]
    return [(label, problem) for label, problem in found if (arguments.only or "") in label]


def left_out() -> None:
    """Print what contestants that know the other filmed rows say of the one that no law explains."""
    films = read_rebounds(FILMED)
    every = make_problem(films, Setting(radius=0.03075, contact_height=1.2033, scatter="share"))[0]
    train, test = (every.select(films.extra["use"] == use) for use in ("yes", "reversed"))
    law = next(one for one in laws_for("table", upright=False) if one.name == "two-step")
    print(f"law (two-step): {answer(fit_law(law, train), test).logs[0]:.0f}")
    for name in ("Gaussian process", "net"):
        print(f"{name}: {CONTESTANTS[name](train, test).logs[0]:.0f}", flush=True)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("table", nargs="?")
    parser.add_argument("--radius", type=float, default=0.02)
    parser.add_argument("--inertia", default="solid")
    parser.add_argument("--by")
    parser.add_argument("--only")
    parser.add_argument("--left-out", action="store_true")
    arguments = parser.parse_args()
    warnings.filterwarnings("ignore")
    if arguments.left_out:
        left_out()
        return
    print("| set | rows | contestant | log score per row | error of the velocity, m/s | error of the spin, rad/s |")
    print("|---|---:|---|---:|---:|---:|", flush=True)
    for label, problem in sets(arguments):
        # (forms are chosen where spins were measured)
        names = [name for name in CONTESTANTS if name != "law and functions" or problem.spins is None]
        found = contest(problem, names)
        _BEST.clear()
        for name, one in found.items():
            spin = "–" if np.isnan(one["spin"]).all() else f"{np.nanmean(one['spin']):.1f}"
            score = f"{one['score'].mean():.2f} ± {one['score'].std(ddof=1) / math.sqrt(len(one['score'])):.2f}"
            print(
                f"| {label} | {len(problem.x)} | {name} | {score} | {one['velocity'].mean():.3f} | {spin} |", flush=True
            )
        best = max((name for name in LAWS if name in found), key=lambda name: found[name]["score"].mean())
        for name in found:
            if name not in LAWS:
                gain = found[name]["score"] - found[best]["score"]
                error = gain.std(ddof=1) / math.sqrt(len(gain))
                said = f"{gain.mean():+.2f} ± {error:.2f} {where_it_wins(problem, gain)}"
                print(f"<!-- {label}: {name} over {best}: {said} -->", flush=True)


if __name__ == "__main__":
    main()
