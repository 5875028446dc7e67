"""Laws against learners: five-fold held-out scores of a law, a law with functions of the impact, a Gaussian process, a small net.

    python docs/dev/contest.py                                              the published sets
    python docs/dev/contest.py TABLE.csv --radius 0.02 --inertia hollow     a table of your own; --by COLUMN: each surface apart

Everything is chosen and fitted within the four fifths that train: the law by AICc, forms and splines by held-out rows among them.
The log score is the mean log density of a held-out row, in m/s (a spin counts as the radius times its size). The lengths are
those of Gossard (arXiv 2604.11349): mean length of the error of the velocity, mean absolute error of the spin.
"""

from __future__ import annotations

import argparse
import math
import warnings
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from carom.bodies import inertia_number
from carom.data import published_rebounds, read_rebounds
from carom.fitting import Setting, fit_law, make_problem
from carom.fitting.data import Problem
from carom.fitting.form_choice import choose_forms
from carom.fitting.laws import laws_for
from carom.fitting.parameters import FORMS
from carom.fitting.predictive import predictive_of

FOLDS = 5
Answer = tuple[Any, Any]  # mean (N, 3) and log density (N,) of the rows that were left out


def best_law(problem: Problem, setting: Setting) -> Any:
    """Return the law with the least AICc."""
    problem = replace(problem, setting=setting)
    laws = laws_for(problem.rebounds.kind, setting.contact_height == 1.0)
    fits = [fit_law(law, problem) for law in laws]
    return min(fits, key=lambda fit: fit.aicc)


def answer(fit: Any, test: Problem) -> Answer:
    """Return what a fit says of other rows."""
    said = predictive_of(fit)
    return said.of_rows(test).mean, said.log_density(test)


def law(train: Problem, test: Problem) -> Answer:
    """Constants."""
    return answer(best_law(train, train.setting), test)


def law_of_speed(train: Problem, test: Problem) -> Answer:
    """The restitution as that function of the normal speed, of a scene or a line, which has the least AICc."""
    fits = [best_law(train, replace(train.setting, restitution=form)) for form in FORMS]
    return answer(min(fits, key=lambda fit: fit.aicc), test)


def law_and_functions(train: Problem, test: Problem) -> Answer:
    """Forms and splines of the impact, chosen by rows held out of those that train."""
    choice = choose_forms(best_law(train, train.setting), noise=False)
    return answer(choice.best.fit, test)


def _inputs(problem: Problem) -> Any:
    return problem.x * (1, 1, problem.setting.radius)


def _outputs(problem: Problem) -> Any:
    return problem.y * (1, 1, problem.setting.radius)


def _learnt(learner: Callable[[], Any], train: Problem, test: Problem) -> Answer:
    """Return mean and density of one learner for each output; ``learner()`` has fit(x, y) and predict(x) -> mean, error."""
    y, seen, moving = _outputs(train), np.isfinite(train.y).all(axis=0), train.x.std(axis=0) > 0
    mean, logs = np.full(test.y.shape, np.nan), np.zeros(len(test.y))
    for i in np.flatnonzero(seen):
        one = learner()
        one.fit(_inputs(train)[:, moving], y[:, i])
        said, error = one.predict(_inputs(test)[:, moving])
        off = (_outputs(test)[:, i] - said) / error
        logs += -0.5 * off**2 - np.log(error) - 0.5 * math.log(2 * math.pi)
        mean[:, i] = said / (train.setting.radius if i == 2 else 1.0)
    return mean, logs


class _Process:
    """scikit-learn's Gaussian process: a line, a squared exponential with a length for each input, and noise."""

    def fit(self, x: Any, y: Any) -> None:
        from sklearn.gaussian_process import GaussianProcessRegressor
        from sklearn.gaussian_process.kernels import RBF, ConstantKernel, DotProduct, WhiteKernel

        self.center, self.size, self.shift, self.scale = x.mean(axis=0), x.std(axis=0), y.mean(), y.std()
        kernel = (
            DotProduct(1.0) + ConstantKernel(1.0) * RBF(np.ones(x.shape[1]), (0.1, 100)) + WhiteKernel(0.01, (1e-6, 10))
        )
        self.process = GaussianProcessRegressor(kernel, n_restarts_optimizer=1, random_state=0)
        self.process.fit((x - self.center) / self.size, (y - self.shift) / self.scale)

    def predict(self, x: Any) -> tuple[Any, Any]:
        mean, error = self.process.predict((x - self.center) / self.size, return_std=True)
        return mean * self.scale + self.shift, error * self.scale


class _Net:
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
        self.center, self.size, self.shift, self.scale = x.mean(axis=0), x.std(axis=0), y.mean(), y.std()
        x, y = (x - self.center) / self.size, (y - self.shift) / self.scale
        fold, off = np.arange(len(x)) % 4, np.zeros(len(x))
        for one in range(4):
            out = fold == one
            off[out] = y[out] - self._one(x[~out], y[~out]).predict(x[out])
        self.net, self.error = self._one(x, y), float(np.sqrt(np.square(off).mean()))

    def predict(self, x: Any) -> tuple[Any, Any]:
        mean = self.net.predict((x - self.center) / self.size) * self.scale + self.shift
        return mean, np.full(len(mean), self.error * self.scale)


CONTESTANTS: dict[str, Callable[[Problem, Problem], Answer]] = {
    "law": law,
    "law, e(v)": law_of_speed,
    "law and functions": law_and_functions,
    "Gaussian process": lambda train, test: _learnt(_Process, train, test),
    "net": lambda train, test: _learnt(_Net, train, test),
}


def contest(problem: Problem, names: Any = tuple(CONTESTANTS)) -> dict[str, dict[str, Any]]:
    """Return scores of the contestants: per row the log score, the length of the velocity's error, the spin's absolute error."""
    n, found = len(problem.x), {}
    fold = np.arange(n) % FOLDS
    for name in names:
        mean, logs = np.full((n, 3), np.nan), np.zeros(n)
        for one in range(FOLDS):
            out = fold == one
            mean[out], logs[out] = CONTESTANTS[name](problem.select(~out), problem.select(out))
        off = mean - problem.y
        velocity = np.hypot(*np.where(np.isfinite(problem.y), off, 0.0)[:, :2].T)
        found[name] = {"score": logs, "velocity": velocity, "spin": np.abs(off[:, 2])}
    return found


def where_it_wins(problem: Problem, gain: Any) -> str:
    """Return the mean gain of a learner over a law in the four quarters of speed and slip angle."""
    speed = np.hypot(problem.x[:, 0], problem.x[:, 1])
    angle = np.degrees(np.arctan2(np.abs(problem.x[:, 1] - problem.setting.radius * problem.x[:, 2]), problem.x[:, 0]))
    fast, steep = speed > np.median(speed), angle > np.median(angle)
    parts = []
    for quick, words in ((False, "slow"), (True, "fast")):
        for wide, more in ((False, "little slip"), (True, "much slip")):
            some = (fast == quick) & (steep == wide)
            parts.append(f"{words}, {more}: {gain[some].mean():+.2f}" if some.any() else f"{words}, {more}: no rows")
    return "; ".join(parts)


def sets(arguments: Any) -> list[tuple[str, Problem]]:
    """Return the data sets as problems."""
    if arguments.table:
        setting = Setting(radius=arguments.radius, kappa=inertia_number(arguments.inertia))
        tables = [(arguments.table, read_rebounds(arguments.table), setting)]
        by = arguments.by
    else:
        chosen = {name: published_rebounds(name) for name in ("tt_rackets", "kharaz2001", "mathavan2009")}
        tables, by = [(name, one.rebounds, Setting(**one.setting)) for name, one in chosen.items()], "racket"
    found = []
    for name, rows, setting in tables:
        labels = rows.extra.get(by) if by else None
        parts = (
            [(name, rows)]
            if labels is None
            else [(f"{name} {one}", rows.select(labels == one)) for one in np.unique(labels)]
        )
        found += [(label, make_problem(part, setting)[0]) for label, part in parts]
    return found


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("table", nargs="?")
    parser.add_argument("--radius", type=float, default=0.02)
    parser.add_argument("--inertia", default="solid")
    parser.add_argument("--by")
    warnings.filterwarnings("ignore")
    print("| set | rows | contestant | log score per row | error of the velocity, m/s | error of the spin, rad/s |")
    print("|---|---:|---|---:|---:|---:|", flush=True)
    for label, problem in sets(parser.parse_args()):
        found = {}
        for name in CONTESTANTS:
            one = found[name] = contest(problem, (name,))[name]
            spin = "–" if np.isnan(one["spin"]).all() else f"{np.nanmean(one['spin']):.1f}"
            score = f"{one['score'].mean():.2f} ± {one['score'].std(ddof=1) / math.sqrt(len(one['score'])):.2f}"
            print(
                f"| {label} | {len(problem.x)} | {name} | {score} | {one['velocity'].mean():.3f} | {spin} |", flush=True
            )
        for name in ("Gaussian process", "net"):
            gain = found[name]["score"] - found["law and functions"]["score"]
            print(f"<!-- {label}: {name} over law and functions: {where_it_wins(problem, gain)} -->", flush=True)


if __name__ == "__main__":
    main()
