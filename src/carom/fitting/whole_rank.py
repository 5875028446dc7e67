"""Which law whole tracks prefer, and how surely."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.fitting.rank import to_one
from carom.fitting.whole import WholeFit, first_numbers
from carom.fitting.whole_laws import WholeSetting, whole_laws
from carom.fitting.whole_runs import stretches
from carom.fitting.whole_search import fit_law_whole
from carom.fitting.whole_told import TOO_SMALL
from carom.tracks.measure import Measured

__all__ = ["WholeRanking", "fit_whole"]

Array = NDArray[np.float64]
Say = Callable[[str, float], None]
DECIDED, LEANS = 20.0, 3.0  # odds
SURE, HINT = 0.01, 0.1  # chances that shots alike would part so far (Wilcoxon's signed ranks)


@dataclass(frozen=True, eq=False)
class WholeRanking:
    """All laws, best first, and what follows."""

    fits: tuple[WholeFit, ...]
    weights: Array
    """Akaike's; where no law follows the frames to their noise they are far too sure, and the verdict counts shots."""
    verdict: str
    odds: float
    """Of the best law against the best that does not contain it; NaN where no law follows the frames."""
    against: str
    closer: tuple[int, int] | None
    """Shots in which the best law is nearer than that one, and shots in all."""
    chance: float
    """That shots alike would part the two so far (Wilcoxon's signed-rank test)."""
    notes: tuple[str, ...]

    @property
    def best(self) -> WholeFit:
        """The first."""
        return self.fits[0]

    def as_dict(self) -> dict[str, Any]:
        """For JSON: numbers in full, None where there is none."""
        best = self.best
        return {
            "ranking": [_law(fit, float(weight)) for fit, weight in zip(self.fits, self.weights, strict=True)],
            "degenerate": [
                {"law": fit.law.name, "parameters": list(fit.untold), "what": sentence}
                for fit in self.fits
                for sentence in fit.degenerate
            ],
            "verdict": self.verdict,
            "odds": _finite(self.odds),
            "against": self.against or None,
            "follows": best.follows,
            "closer_in": None if self.closer is None else {"shots": self.closer[0], "of": self.closer[1]},
            "chance": _finite(self.chance),
            "noise": best.noise,
            "noise_given": best.known,
            "tracks": [
                {
                    "shot": one.group, "ball": one.name, "since": one.since, "frames": int(best.frames.count[n]),
                    "walls": list(one.walls), "contacts": one.contacts.tolist(), "slides_at_start": bool(best.starts.free[n, 4]),
                    "rms": {fit.law.name: fit.rms([n]) for fit in self.fits},
                    "start": {fit.law.name: fit.start(n).tolist() for fit in self.fits},
                }
                for n, one in enumerate(best.frames.stretches)
            ],
            "notes": list(self.notes),
        }  # fmt: skip


def _finite(value: float | None) -> float | None:
    return float(value) if value is not None and math.isfinite(value) else None


def _law(fit: WholeFit, weight: float) -> dict[str, Any]:
    def estimate(name: str) -> dict[str, Any]:
        found = fit.estimates[name]
        told = {"value": _finite(found.value), "stderr": _finite(found.stderr)}
        return told | ({"note": found.note} if found.note else {})

    return {
        "law": fit.law.name,
        "aicc": _finite(fit.aicc),
        "weight": weight,
        "chi2": _finite(fit.chi2),
        "dof": fit.dof,
        "numbers_adjusted": fit.k,
        "rms": fit.rms(),
        "median_rms": float(np.median([fit.rms([n]) for n in range(len(fit.q))])),
        "parameters": {name: estimate(name) for name in fit.law.free},
        "held": {name: _finite(value) for name, value in fit.law.held.items()},
        "covariance": {"names": list(fit.law.free), "matrix": [[_finite(x) for x in row] for row in fit.covariance]},
    }


def fit_whole(
    measured: Measured, setting: WholeSetting, laws: Sequence[str] | None = None, *, say: Say | None = None
) -> WholeRanking:
    """Fit laws to whole tracks through the engine, and rank them.

    ``measured``: tracks with their walls and contacts (:func:`carom.tracks.measure.measure`). ``laws``: names, all by default.
    ``say`` is told what is being done and how much of all is done, 0 to 1. Raises CaromError, a line a fault, where there is
    nothing to follow, or a setting makes no sense.
    """
    import importlib.util

    if importlib.util.find_spec("lmfit") is None:
        raise CaromError("fit: needs lmfit, which is not installed; run: pip install 'carom[fit]'")
    if measured.view != "above":
        raise CaromError(
            "whole tracks: expected balls on a table, seen from above, got balls in flight; leave out --whole"
        )
    setting.check()
    found, notes = stretches(measured, setting.cushions, setting.after)
    if not found:
        raise CaromError(
            "whole tracks: expected a ball that is seen before and after a wall, with nothing else on its way, got none"
            + "".join(f"; {note}" for note in notes)
        )
    tell = say or (lambda _what, _done: None)
    chosen, more = whole_laws(laws, setting, measured.walls, first_numbers(measured))
    fits = []
    for i, law in enumerate(chosen):

        def part(done: float, i: int = i, name: str = law.name) -> None:
            tell(f"fit {name}", (i + done) / len(chosen))

        part(0.0)
        fits.append(fit_law_whole(law, found, measured.noise, part))
    fits.sort(key=lambda fit: fit.aicc)
    notes = [*measured.notes, *more, *notes]
    if any(fit.law.rolls for fit in fits) and fits[0].starts.free[:, 4].any():
        names = ", ".join(fit.law.name for fit in fits if fit.law.rolls)
        notes.append(f"{names}: for balls that roll; balls that slide at the start were taken as rolling")
    return _ranked(fits, notes)


def _ranked(fits: list[WholeFit], notes: list[str]) -> WholeRanking:
    aicc = np.array([fit.aicc for fit in fits])
    weights = np.exp(-(aicc - aicc[0]) / 2)
    best = fits[0]
    others = [
        fit for fit in fits[1:] if fit.law.name not in best.law.law.within and best.law.name not in fit.law.law.within
    ]
    others = others or [fit for fit in fits[1:] if best.law.name not in fit.law.law.within]
    rival = others[0] if others else None
    odds = math.exp(min((rival.aicc - best.aicc) / 2, 700.0)) if rival and best.follows else math.nan
    closer, chance, middles = None, math.nan, (0.0, 0.0)
    if rival is not None:
        closer, chance, middles = _shots(best, rival)
    verdict = _verdict(best, rival, odds, closer, chance, middles)
    return WholeRanking(
        tuple(fits),
        weights / weights.sum(),
        verdict,
        odds,
        rival.law.name if rival else "",
        closer,
        chance,
        tuple(notes),
    )


def _shots(best: WholeFit, rival: WholeFit) -> tuple[tuple[int, int], float, tuple[float, float]]:
    """In how many shots the best is nearer; the chance of that; the two median distances."""
    from scipy.stats import wilcoxon

    groups = [one.group or one.name for one in best.frames.stretches]
    rows = [[n for n, g in enumerate(groups) if g == group] for group in dict.fromkeys(groups)]
    near, far = (np.array([fit.rms(which) for which in rows]) for fit in (best, rival))
    ratio = np.log(np.maximum(far, 1e-12) / np.maximum(near, 1e-12))
    chance = float(wilcoxon(ratio).pvalue) if len(ratio) > 1 and np.any(ratio != 0) else 1.0
    return (int((ratio > 0).sum()), len(rows)), chance, (float(np.median(near)), float(np.median(far)))


def _verdict(
    best: WholeFit, rival: WholeFit | None, odds: float, closer: tuple[int, int] | None, chance: float,
    middles: tuple[float, float],
) -> str:  # fmt: skip
    from carom.units import length

    called = best.law.law.called
    first = ""
    if not best.follows:
        scatter = length(float(np.median(best.scatter)))
        leaves = f"leaves {scatter}" + (f", chi^2 {best.chi2:.0f} where {best.dof:.0f} is due" if best.known else "")
        worst = best.frames.stretches[int(np.argmax(best.scatter))].label
        first = f"No law follows the tracks to their noise of {length(best.noise)}: the best, {called}, {leaves}"
        first += f", most in {worst}" if len(best.scatter) > 1 else ""
        loose = any(estimate.note == TOO_SMALL for estimate in best.estimates.values())
        first += "; do not rely on its numbers, which may be off by many error bars. " if loose else ". "
    if rival is None:
        return f"{first}There was no other law to set against {called}."
    name = rival.law.name
    if best.follows and odds < LEANS:
        return f"These tracks cannot decide between {best.law.name} and {name}."
    if best.follows:
        word, end = ("prefer", "") if odds >= DECIDED else ("lean to", ": not enough to decide")
        return f"The tracks {word} {called}, {to_one(odds)} over {name}{end}."
    assert closer is not None
    said = (
        f"in {closer[0]} of {closer[1]} shots it comes nearer than {name} (in the middle {length(middles[0])} against"
    )
    said += f" {length(middles[1])})"
    if chance > HINT or closer[0] <= closer[1] / 2:
        return f"{first}They cannot decide between {best.law.name} and {name}: {said}."
    return (
        f"{first}The tracks prefer it: {said}."
        if chance < SURE
        else f"{first}The tracks lean to it: {said}; not enough."
    )
