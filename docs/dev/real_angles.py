"""The paper's question on real shots: where do rolling balls go after a cushion? For docs/validation/which_law.md.

    python docs/dev/real_rebounds.py carom_tracks_50hz.csv --out rebounds.csv --stage rolling
    python docs/dev/real_angles.py rebounds.csv

The sidespin of these balls is unknown and is averaged over: normal, with a mean along the wall and a width that are fitted.
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
import numpy as np

from carom.data import Rebounds, make_rebounds, read_rebounds
from carom.fitting import Fit, Ranking, Setting, fit_laws, make_problem
from carom.fitting.model import predict_law
from carom.fitting.result import with_error_bar

IMAGES = Path(__file__).parents[1] / "images"
RADIUS, NOSE = 0.03075, 37 / 30.75
SLOWEST = 0.3  # m/s toward the cushion


def ranked(rebounds: Rebounds, names: list[str] | None, **changes: object) -> Ranking:
    """All laws, and what there is to say."""
    setting = Setting(radius=RADIUS, contact_height=NOSE, **{"scatter": "share", **changes})  # type: ignore[arg-type]
    start = time.process_time()
    ranking = fit_laws(rebounds, setting, names, profiles=False, bootstrap=0)
    print(f"\n{len(rebounds)} rebounds, {changes or 'as they are'}: {time.process_time() - start:.0f} s of processor")
    for one in ranking.ranked:
        fit = one.fit
        said = ", ".join(f"{key} {with_error_bar(e)}" for key, e in fit.estimates.items())
        print(
            f"{fit.law.name:15s} AICc {fit.aicc:10.1f}  chi2 {fit.chi2:8.1f}/{fit.dof}  CV {one.score:8.3f}  {said}",
            flush=True,
        )
    print(
        ranking.verdict,
        *ranking.degenerate,
        *(f"outlier: {o.row}, chi2 {o.chi2:.1f}" for o in ranking.outliers),
        sep="\n",
    )
    print(*(note for note in ranking.notes if "heavy tails" in note), sep="\n", flush=True)
    return ranking


def at(fit: Fit, angle: np.ndarray, spin: float | np.ndarray) -> np.ndarray:
    """Reflection (degrees) once the ball rolls again, of a ball at 1 m/s with a sidespin in v/a."""
    n = len(angle)
    v = {"v_n_in": np.cos(angle), "v_t_in": np.sin(angle), "spin_z_in": np.broadcast_to(spin / RADIUS, n)}
    columns = v | {"v_n_out": v["v_n_in"], "v_t_out": v["v_t_in"]}
    columns |= {f"sigma_{name}": np.full(n, 0.01) for name in ("v_n_out", "v_t_out")}
    problem, _ = make_problem(make_rebounds("table", columns, stage="rolling"), fit.problem.setting)
    out = predict_law(fit.law, problem, fit.numbers)
    return np.degrees(np.arctan2(out[:, 1], out[:, 0]))


def folded(rebounds: Rebounds) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Incidence and reflection, degrees, both with their error bars, mirrored to incidence above zero."""
    a, b = np.degrees(rebounds.angle_in), np.degrees(rebounds.angle_out)
    sign = np.where(a < 0, -1.0, 1.0)

    def error(side: str) -> np.ndarray:
        n, t = rebounds[f"v_n_{side}"], rebounds[f"v_t_{side}"]
        sn, st = rebounds.sigma[f"v_n_{side}"], rebounds.sigma[f"v_t_{side}"]
        return np.degrees(np.sqrt((t * sn) ** 2 + (n * st) ** 2) / (n * n + t * t))

    return a * sign, b * sign, error("in"), error("out")


def prior(fit: Fit) -> tuple[float, float]:
    """Mean (v_t/a) and width (v/a) of the sidespins that describe the data best, as the page prints them."""
    mean, width = (fit.estimates[name].value for name in ("spin_mean", "spin_width"))
    return float(mean), float(width)  # type: ignore[arg-type]


def draw(rebounds: Rebounds, first: np.ndarray, fits: dict[str, Fit], *, narrow: bool = False) -> None:
    """Save the panels side by side, or (for phones, where the letters would be 7 px high) one below the other."""
    style = {
        "svg.hashsalt": "carom", "font.family": "STIXGeneral", "mathtext.fontset": "stix",
        "svg.fonttype": "path", "font.size": 11, "axes.spines.top": False, "axes.spines.right": False,
        "axes.titlesize": 11, "axes.titlelocation": "left", "legend.frameon": False,
    }  # fmt: skip
    with plt.rc_context(style):
        shape, size = ((3, 1), (3.9, 8.4)) if narrow else ((1, 3), (7.4, 3.9))
        figure, panels = plt.subplots(*shape, figsize=size, sharex=True, sharey=True)
        a, b, sa, sb = folded(rebounds)
        line = np.radians(np.linspace(0.5, 80, 120))
        titles = {
            "conventional": "conventional", "two-step-paper": "two-step, the paper's", "two-step": "two-step, fitted",
        }  # fmt: skip
        for axes, (name, title) in zip(panels, titles.items(), strict=True):
            fit = fits[name]
            c, w = prior(fits["two-step"])  # one population of spins for all: the one that describes the data best
            none, middle, one, other = (
                at(fit, line, s) for s in (0.0, c * np.sin(line), c * np.sin(line) + w, c * np.sin(line) - w)
            )
            low, high = np.minimum(one, other), np.maximum(one, other)
            within = f"${c:.2f}\\,v_t/a \\pm {w:.2f}\\,v/a$"
            axes.plot(np.degrees(line), none, color="#0072B2", lw=1.2, ls="--", label="without sidespin")
            axes.fill_between(np.degrees(line), low, high, color="#0072B2", alpha=0.15, lw=0, label=within)
            axes.plot(np.degrees(line), middle, color="#0072B2", lw=1.5, label="with the mean sidespin")
            for rows, ink, label in ((~first, "#222222", "other balls"), (first, "#D55E00", "first ball at a cushion")):
                axes.errorbar(
                    a[rows],
                    b[rows],
                    xerr=sa[rows],
                    yerr=sb[rows],
                    fmt="o",
                    ms=2.6,
                    color=ink,
                    elinewidth=0.6,
                    label=label,
                )
            axes.plot((0, 80), (0, 80), color="#999999", lw=0.6, ls=":")
            axes.set(xlim=(0, 80), ylim=(-30, 90), xticks=range(0, 81, 20), yticks=range(-30, 91, 30), title=title)
        panels[1 if narrow else 0].set_ylabel("reflection once it rolls again, degrees")
        panels[2 if narrow else 1].set_xlabel("incidence, degrees from the normal")
        figure.tight_layout(rect=(0, 0.15, 1, 1), w_pad=1.2)
        handles = panels[0].get_legend_handles_labels()
        figure.legend(*handles, loc="lower center", ncols=1 if narrow else 3, fontsize=10, columnspacing=1.2)
        name = "which_law_narrow" if narrow else "which_law"
        figure.savefig(IMAGES / f"{name}.svg", metadata={"Date": None, "Creator": None})


def first_balls(rebounds: Rebounds) -> np.ndarray:
    """(N,) of each rebound: whether the ball is the first of its shot at a cushion, most often the cue ball."""
    shot, ball = rebounds.extra["shot"], rebounds.extra["ball"]
    t = np.array([float(x) for x in rebounds.extra["t"]])
    first = {s: ball[shot == s][np.argmin(t[shot == s])] for s in np.unique(shot)}
    return np.array([first[s] == b for s, b in zip(shot, ball, strict=True)])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("rebounds", type=Path)
    parser.add_argument("--first", action="store_true", help="only with all rows, and without the outliers")
    given = parser.parse_args()
    table = read_rebounds(given.rebounds)
    table = table.select((table.stage == "rolling") & (table["v_n_in"] > SLOWEST))
    print(f"{len(table)} rebounds of rolling balls, {len(np.unique(table.extra['shot']))} shots")
    everything = ranked(table, None)
    names = [row.row for row in everything.outliers]
    odd = np.isin(np.array(table.rows), names)
    for i in np.flatnonzero(odd):
        n, t, after, along = (table[name][i] for name in ("v_n_in", "v_t_in", "v_n_out", "v_t_out"))
        where = ", ".join(str(table.extra[name][i]) for name in ("shot", "ball", "wall"))
        print(f"left out: {where}: v_n {n:.2f}, v_t {t:.2f} m/s before, {after:.2f} and {along:.2f} after")
    kept = table.select(~odd)
    ranking = ranked(kept, None)
    for narrow in (False, True):
        draw(kept, first_balls(table)[~odd], {one.fit.law.name: one.fit for one in ranking.ranked}, narrow=narrow)
    if given.first:
        return
    two = ["two-step", "two-step-after", "contact", "no-slip"]
    ranked(kept, two, spin_mean=0.0)
    ranked(table, two, robust=True, scatter="")  # (heavy tails in place of a fitted scatter)
    by_hand = first_balls(table)[~odd]
    ranked(kept.select(by_hand), two[:2])
    ranked(kept.select(~by_hand), two[:2])


if __name__ == "__main__":
    main()
