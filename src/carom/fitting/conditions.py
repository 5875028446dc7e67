"""Conditions of a verdict: what was assumed, what the rows say of it, and numbers of the best law that forbid a decision."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from carom.fitting.data import Problem
from carom.fitting.fit import fit_law
from carom.fitting.model import model_of, predict_law
from carom.fitting.result import Fit

__all__ = ["assumptions_in_words", "kinked_rows_warning", "odds_note", "restitution_gain", "unsettled"]

GAIN = 6.0  # of AICc: odds of 20 to 1
MOST_WORK, MOST_ESTIMATED = (
    2e4,
    400,
)  # law evaluations (carom.fitting.data.Problem.work) and rows up to which e(v) is tried
KINKED_SIGMA, KINKED_SHARE = 0.3, 0.06  # of an error bar by which the prediction deviates from linear; of the rows
# Of simulated tables whose true law is among those fitted (campaigns/verdict_coverage.py): rows, decisions at 20 to 1, wrong ones
COUNTED = ((8, 249, 6), (30, 541, 7), (200, 251, 0))


def unsettled(best: Fit) -> str:
    """Return why the numbers of the best law forbid a decision for it: one is at a bound, or none is identifiable; else "".

    A width of 0 of the unmeasured spins forbids none: balls that are thrown without spin have it.
    """
    bound = [
        f"{name} is {estimate.note}" for name, estimate in best.estimates.items()
        if estimate.value is not None and estimate.stderr is None and estimate.note
        and not (name == "spin_width" and estimate.value <= model_of(best.law, best.problem).parameters[name].low)
    ]  # fmt: skip
    if bound:
        return f"its {' and its '.join(bound)}"
    if best.names and all(estimate.value is None for estimate in best.estimates.values()):
        return "none of its parameters is identifiable"
    return ""


def restitution_gain(best: Fit, problem: Problem) -> float:
    """Return by how much AICc falls if the best law's constant restitution becomes a straight line v_out = slope v + offset.

    0 where it does not fall, where the restitution is no free constant, and where this would take long. ``problem``: the rows,
    without a scatter between contacts.
    """
    setting, costly = best.problem.setting, best.law.search_code is not None
    line = replace(setting, restitution="line")
    if setting.restitution != "constant" or "restitution" not in best.names or best.problem.work(costly) > MOST_WORK:
        return 0.0
    if problem.estimated.any():
        if len(problem.x) > MOST_ESTIMATED:
            return 0.0
        aicc = fit_law(best.law, replace(problem, setting=replace(problem.setting, restitution="line"))).aicc
        return max(best.aicc - aicc, 0.0)
    model = model_of(best.law, replace(best.problem, setting=line))
    found = model.minimize(model.like(best.numbers))
    gain = best.deviance - best.determinants - float(found.value[0]) - 2
    return max(gain, 0.0) if math.isfinite(gain) else 0.0


def assumptions_in_words(best: Fit, gain: float) -> str:
    """Return the assumptions under which the laws were compared: parameters that are constants or not, spins, errors."""
    setting, problem = best.problem.setting, best.problem
    said = []
    if "restitution" in best.law.free:
        form = setting.restitution
        said.append("a constant restitution" if form == "constant" else f"a restitution of form {form}")
        if gain > GAIN:
            said[-1] += f" (a straight line in the speed would lower AICc by {gain:.3g}: `restitution` line)"
    if problem.spins is not None:
        shape = "mixture" if problem.mixture is not None else setting.spin_prior
        said.append(f"a {shape} distribution of unmeasured spins")
    if problem.nu:
        said.append("errors with heavy tails")
    return f"; assumed: {', '.join(said)}" if said else ""


def odds_note(rows: int, odds: float) -> list[str]:
    """Return a note on what odds mean, with the share of wrong decisions counted for simulated tables of about so many rows."""
    count, decided, wrong = min(COUNTED, key=lambda one: abs(math.log(one[0] / max(rows, 1))))
    if not math.exp(GAIN / 2) <= odds < math.inf:
        return []
    # (of none in n, a share of 3/n or more would be seen with 95 % probability: exp(-3) = 0.05)
    share = (
        f"{wrong} were wrong ({100 * wrong / decided:.1f} %)"
        if wrong
        else f"none was wrong (below {300 / decided:.1f} %)"
    )
    return [
        f"odds are a ratio of evidence, not an error rate: of {decided} decisions at 20 to 1 or more on simulated tables of {count}"
        f" rows, whose true law was among those fitted, {share}"
    ]


def kinked_rows_warning(fit: Fit) -> str:
    """Return a warning if the law is not linear within the error bars before the wall in many rows; else an empty text.

    The information of a row is computed from the law's derivatives at the measured state. If the contact sticks one error bar to
    one side and slides to the other, these do not represent how well the row determines a parameter. The same holds for profiles
    and the bootstrap.
    """
    problem, p = fit.problem, fit.numbers
    if problem.estimated.any() or not problem.vx.any():
        return ""
    here = fit.predicted()
    wide, turn = problem.vy.copy(), np.zeros(problem.y.shape)
    for o in range(3):
        step = np.sqrt(problem.vx[:, o])[:, None] * np.eye(3)[o]
        up, down = (predict_law(fit.law, replace(problem, x=problem.x + sign * step), p) for sign in (1, -1))
        wide += np.square((up - down) / 2)
        turn = np.maximum(turn, np.abs(up + down - 2 * here))
    seen = np.isfinite(problem.y)
    share = np.where(seen, turn / np.sqrt(np.where(seen, wide, 1.0)), 0.0).max(axis=1, initial=0.0)
    many = int((share > KINKED_SIGMA).sum())
    if many < KINKED_SHARE * len(share):
        return ""
    return (
        f"error bars before the wall: in {many} of {len(share)} rows they reach from sticking to sliding under {fit.law.name};"
        " nominal 95 % intervals then cover some 80 to 85 %, as do bootstrap and profiles; measure more precisely before the wall"
    )
