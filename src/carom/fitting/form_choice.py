"""Which parameters of a law depend on the impact, and how errors scatter: chosen by the score of rows that were held out.

From constants on, one parameter after the other takes the form, or the spline, that predicts held-out rows best, as long as that
gains more than twice its standard error over the rows; then the scatter may grow with the speed, and errors have heavy tails.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.fitting.fit import fit_law
from carom.fitting.noise import ERRORS, NORMAL, Noise
from carom.fitting.parameters import FORMS, PLACES
from carom.fitting.predictive import Prediction, held_out_score, predictive_of
from carom.fitting.result import Fit
from carom.fitting.smooth import Smooth, smooth_parameter
from carom.fitting.varying import VaryingFit, VaryingModel, fit_varying, varying_model
from carom.formatting import json_value
from carom.public.progress import Progress

__all__ = ["FormChoice", "TriedForm", "choose_forms"]

Array = NDArray[np.float64]
WIDTHS = (0.2, 0.06, 0.02, 0.006)  # of the second differences of a spline's coefficients, that are tried
MOST_ROWS = 1000  # among which, of more, the choice is made
ALONG_TRIED = ("linear", "exponential", "linear:v_n")
SPLINES = {
    "restitution": "v_n",
    "friction": "slip",
    "tangential_restitution": "slip/v_n",
    "stiffness_ratio": "slip/v_n",
}
MOST_AICC, ERRORS_OF_GAIN = 2.0, 2.0
LEAST_GAIN = 1.0  # of the log score of all rows


@dataclass(frozen=True, eq=False)
class TriedForm:
    """A law with some of its parameters as functions of the impact, and its scores."""

    words: str
    """The change from what was chosen before, such as "friction linear"; "constants" first."""
    fit: VaryingFit
    base: Fit
    score: float
    """Mean log density of a held-out row, per (m/s)^3."""
    rows: Array
    """(N,) the density of each."""
    gain: float
    """Of the score over what was chosen before,"""
    gain_error: float
    """and its standard error over the rows."""
    aicc_change: float = 0.0

    @property
    def aicc(self) -> float:
        """With the effective number of parameters."""
        return self.fit.aicc

    @property
    def better(self) -> bool:
        """Whether the gain is larger than twice its error, and than 1 for all rows, and AICc does not rise by more than 2."""
        return (
            self.gain > max(ERRORS_OF_GAIN * self.gain_error, LEAST_GAIN / len(self.rows))
            and self.aicc_change < MOST_AICC
        )


@dataclass(frozen=True, eq=False)
class FormChoice:
    """All that was tried for one law, in order, and what was chosen; made by :func:`choose_forms`."""

    law: str
    tried: tuple[TriedForm, ...]
    chosen: tuple[int, ...]
    """Indices of what was chosen, one after the other; the first is 0, constants."""

    @property
    def best(self) -> TriedForm:
        """The latest choice."""
        return self.tried[self.chosen[-1]]

    @property
    def sentence(self) -> str:
        """The choice in one sentence."""
        first, best = self.tried[0], self.best
        if best is first:
            return f"{self.law}: constants predict held-out rows best ({first.score:.3g} per row)"
        words = ", then ".join(self.tried[i].words for i in self.chosen[1:])
        return (
            f"{self.law}: {words}: held-out score {best.score:.3g} per row for {first.score:.3g} of constants, AICc"
            f" {best.aicc - first.aicc:+.1f}"
        )

    def predict(self, before: Any) -> Prediction:
        """Return mean and covariance of the states after the wall, as :meth:`carom.fitting.Fit.predict`."""
        return predictive_of(self.best.fit).of_states(before)

    def as_dict(self) -> dict[str, Any]:
        """Return the choice for JSON."""
        tried = [
            {"words": one.words, "aicc": json_value(one.aicc), "score": json_value(one.score), "gain": json_value(one.gain),
             "gain_stderr": json_value(one.gain_error), "chosen": i in self.chosen}
            for i, one in enumerate(self.tried)
        ]  # fmt: skip
        return {"law": self.law, "sentence": self.sentence, "tried": tried}


def choose_forms(
    fit: Fit, parameters: Sequence[str] | None = None, *, noise: bool = True, progress: Progress | None = None
) -> FormChoice:
    """Choose forms or splines for the parameters of a fitted law, and the distribution of errors, by held-out rows.

    Parameters
    ----------
    fit : Fit
        Of a law to rows whose spins before the wall were measured.
    parameters : sequence of str, optional
        Of which forms are tried. Default: all of the law's.
    noise : bool
        Whether scatter that grows with the speed, Student's t and exponential errors are tried, too.
    progress : callable(done, total, text), optional

    Returns
    -------
    FormChoice

    Raises
    ------
    CaromError
        Where spins were not measured.

    Examples
    --------
    >>> from carom.data import published_rebounds
    >>> from carom.fitting import Setting, fit_laws
    >>> rows = published_rebounds("tt_rackets").rebounds
    >>> ranking = fit_laws(rows, Setting(radius=0.02, kappa=2 / 3), "contact", where="racket=10_antispin", bootstrap=0)
    >>> choice = choose_forms(ranking.best, ["friction"])
    >>> [one.words for one in choice.tried][:3]
    ['constants', 'friction linear', 'friction exponential']
    """
    problem = fit.problem
    varying_model(fit)  # (says what is missing)
    if len(problem.x) > MOST_ROWS:
        some = problem.select(np.linspace(0, len(problem.x) - 1, MOST_ROWS).astype(int))
        fit = fit_law(fit.law, some)
    tried = [_tried("constants", fit, (), NORMAL, None)]
    chosen, varied = [0], set[str]()
    names = [name for name in SPLINES if name in fit.law.free and (parameters is None or name in parameters)]
    while True:
        now, found = tried[chosen[-1]], list[TriedForm]()
        for name in names:
            if name not in varied and getattr(problem.setting, name) == "constant":
                if progress:
                    progress(len(varied) / (len(names) + 1), 1.0, f"forms of the {name.replace('_', ' ')}")
                found += _forms(now, name)
        if not found:
            break
        best = max(range(len(found)), key=lambda i: (found[i].better, found[i].score))
        tried += found
        if not found[best].better:
            break
        chosen.append(len(tried) - len(found) + best)
        varied.add(next(name for name in names if found[best].words.startswith(name.replace("_", " "))))
    if noise:
        now = tried[chosen[-1]]
        grows = (Noise(grows=True),) if len(now.fit.model.scattered) else ()
        found = [_tried(_noise_words(one), now.base, now.fit.model.smooth, one, now)
                 for one in (*grows, *(Noise(errors) for errors in ERRORS[1:]))]  # fmt: skip
        best = max(range(len(found)), key=lambda i: (found[i].better, found[i].score))
        tried += found
        if found[best].better:
            chosen.append(len(tried) - len(found) + best)
    return FormChoice(fit.law.name, tuple(tried), tuple(chosen))


def _noise_words(noise: Noise) -> str:
    return "scatter that grows with the speed" if noise.grows else f"{noise.errors} errors"


def _tried(words: str, base: Fit, smooth: tuple[Smooth, ...], noise: Noise, before: TriedForm | None) -> TriedForm:
    """Fit, and score held-out rows."""
    model = varying_model(base, smooth, noise)
    starts = [model.start()]
    if before is not None:
        starts.append(_carried(model, before.fit, starts[0]))
        if len(smooth) > len(
            before.fit.model.smooth
        ):  # (what the form that is a line reaches lies beyond a kink, perhaps)
            form = "line" if smooth[-1].parameter == "restitution" else f"linear:{smooth[-1].variable}"
            other = _refitted(base, smooth[-1].parameter, form)
            starts.append(model.start(varying_model(other).base, other.numbers))
    fits = [fit_varying(base, smooth, noise, start) for start in starts]
    fit = min(fits, key=lambda one: one.deviance + one.model.penalty(one.q)[0])
    score, rows = held_out_score(fit)
    gains = rows - before.rows if before is not None else np.zeros(len(rows))
    error = float(gains.std(ddof=1) / math.sqrt(len(rows)))
    change = fit.aicc - before.aicc if before is not None else 0.0
    return TriedForm(words, fit, base, score, rows, float(gains.mean()), error, change)


def _carried(model: VaryingModel, before: VaryingFit, start: Array) -> Array:
    """Return a start with the numbers of another fit that the model has, too, where they are of the same form."""
    q, old = start.copy(), before.model
    new, was = model.problem.setting, old.problem.setting
    changed = {place for one in PLACES for place in PLACES[one] if getattr(new, one) != getattr(was, one)}
    for i, place in enumerate(model.free.tolist()):
        if place in old.free and place not in changed:
            q[i] = before.q[old.free.tolist().index(place)]
    for name in ("smooth", "scatter", "power", "shape"):
        at, of = model.parts[name], old.parts[name]
        common = min(at.stop - at.start, of.stop - of.start)
        q[at.start : at.start + common] = before.q[of.start : of.start + common]
    return q


def _refitted(base: Fit, name: str, form: str) -> Fit:
    changed: dict[str, Any] = {name: form}
    return fit_law(base.law, replace(base.problem, setting=replace(base.problem.setting, **changed)))


def _forms(now: TriedForm, name: str) -> list[TriedForm]:
    """Return all forms of one parameter, and its best spline, on top of what was chosen."""
    forms = [form for form in FORMS if form != "constant"] if name == "restitution" else ALONG_TRIED
    words, smooth, noise = name.replace("_", " "), now.fit.model.smooth, now.fit.model.noise
    found = [_tried(f"{words} {form}", _refitted(now.base, name, form), smooth, noise, now) for form in forms]
    splines = []
    for width in WIDTHS:
        one = smooth_parameter(now.base, name, SPLINES[name], width)
        splines.append(_tried(f"{words} spline of {one.variable}", now.base, (*smooth, one), noise, now))
    return [*found, max(splines, key=lambda one: one.score)]
