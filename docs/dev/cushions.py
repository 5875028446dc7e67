"""The published laws of cushions against measured cushions: tables and the picture of docs/theory/cushions.md.

    carom tracks show carom_tracks_50hz.csv --view above --radius 0.03075 --stage rolling --out rebounds.csv
    python docs/dev/cushions.py [rebounds.csv]

Without the rebounds of the filmed shots, which are not part of carom, only the two published sets are compared.
"""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
import numpy as np
from scipy.optimize import least_squares

import carom
from carom.data import datasets, read_rebounds
from carom.fitting import Setting, fit_laws
from carom.fitting.result import with_error_bar
from carom.laws.law import LIKE_SOLIDS, Meeting
from carom.laws.registry import law_styles
from carom.scene.restitution import Han2005

IMAGES = Path(__file__).parents[1] / "images"
LAWS = ("han2005", "mathavan2010", "stronge-cushion")
CLOTH = 0.212  # Mathavan et al.; of pool tables about the same
SNOOKER, POOL, CAROM = 1.4, 1.28, 37 / 30.75  # height of the nose, in radii
SLOWEST = 0.3  # m/s toward the cushion
Array = np.ndarray[Any, np.dtype[np.float64]]


def after(
    law: str, v: Array, w: Array, e: Any, mu: Any, nose: float, k: float = LIKE_SOLIDS, radius: float = 0.02625
) -> Any:
    """The law's answer for balls (N, 3) at a nose; restitution and friction may be arrays (N)."""
    n = np.array([math.sqrt(1 - (nose - 1) ** 2), 0.0, 1 - nose])
    meeting = Meeting(
        carom.Ball(radius, 0.1406), carom.State(v, w), n, carom.Surface(e, mu), carom.Surface(0.0, CLOTH),
        stiffness_ratio=k,
    )  # fmt: skip
    return carom.LAWS[law].answer(meeting)


def han_friction(theta: Array) -> Array:
    """Han (27)."""
    return 0.471 - 0.241 * theta


def han_restitution(speed: Array) -> Array:
    """Han (26), level beyond its vertex."""
    return np.array([Han2005().at(float(x)) for x in speed])


def score(wrong: Array, parameters: int) -> tuple[float, float]:
    """RMS deviation, and AICc for normal errors of one unknown size, which is a parameter, too."""
    n, k = len(wrong), parameters + 1
    mean = float((wrong**2).mean())
    return math.sqrt(mean), n * math.log(mean) + 2 * k + 2 * k * (k + 1) / (n - k - 1)


def best(wrong: Any, starts: list[list[float]], bounds: Any) -> Any:
    """Least squares from several starts."""
    found = [least_squares(wrong, start, bounds=bounds, x_scale=0.1, diff_step=1e-4) for start in starts]
    return min(found, key=lambda one: one.cost)


def row(law: str, numbers: str, wrong: Array, parameters: int) -> None:
    """Print a row of a table."""
    rms, aicc = score(wrong, parameters)
    print(f"| {law} | {numbers} | {rms:.3f} | {aicc:.1f} |", flush=True)


# --- a snooker ball, square on -------------------------------------------------------------------------------------


def snooker(law: str, speed: Array, e: Any, mu: float, k: float = LIKE_SOLIDS) -> Array:
    """Speed after the cushion of balls that roll square on."""
    v = np.stack([-speed, 0 * speed, 0 * speed], axis=-1)
    w = np.stack([0 * speed, -speed / 0.02625, 0 * speed], axis=-1)
    found: Array = after(law, v, w, e, mu, SNOOKER, k).after_wall.velocity[:, 0]
    return found


def falling(p: Any, speed: Array) -> Array:
    """A restitution that falls with the square of the normal speed."""
    return np.clip(p[0] - p[1] * speed**2, 0, 1)


AUTHORS = {
    "han2005": lambda speed, theta: (han_restitution(speed), han_friction(theta)),
    "mathavan2010": lambda speed, theta: (0.98 + 0 * speed, 0.14 + 0 * theta),
    "stronge-cushion": lambda speed, theta: (0.85 + 0 * speed, 0.2 + 0 * theta),
}


def fit_snooker(law: str, speed: Array, out: Array, mu: float) -> tuple[Any, Any]:
    """A constant restitution, and one that falls with the square of the normal speed, at a given friction.

    Of springs, friction and stiffness ratio as well, to the second: they return slip, so also topspin, as speed.
    """
    normal = speed * math.sqrt(1 - (SNOOKER - 1) ** 2)
    one = best(lambda p: snooker(law, speed, p[0], mu) - out, [[0.9], [0.7]], ([0], [1]))
    starts = [[0.95, 0.02, 0.3, 0.8], [0.9, 0.01, 0.5, 1.8], [0.9, 0.005, 1.0, 0.5]]
    bounds = [[0, 0, 0, 0.3], [1.2, 0.1, 2, 2.5]]
    if law == "stronge-cushion":
        return one, best(lambda p: snooker(law, speed, falling(p, normal), p[2], p[3]) - out, starts, bounds)
    starts, bounds = ([one[:2] for one in these] for these in (starts, bounds))
    return one, best(lambda p: snooker(law, speed, falling(p, normal), mu) - out, starts, bounds)


def compare_snooker(ax: Any) -> None:
    """Mathavan 2009."""
    columns = datasets.load("mathavan2009").columns
    speed, out = columns["v_n_in_m_s"], columns["v_n_out_m_s"]
    cosine = math.sqrt(1 - (SNOOKER - 1) ** 2)
    grid = np.linspace(0.2, 3.3, 60)
    ax.plot(speed, out / speed, "o", ms=4, color="#222222", zorder=3)
    print("\n| law | numbers | RMS, m/s | AICc |\n|---|---|---|---|")
    for law in LAWS:
        colour, dashes = law_styles([law])[law]
        e, rubs = AUTHORS[law](speed * cosine, 0 * speed)
        mu = float(rubs[0])
        row(f"`{law}`", "its authors'", snooker(law, speed, e, mu) - out, 0)
        e, _mu = AUTHORS[law](grid * cosine, 0 * grid)
        ax.plot(grid, snooker(law, grid, e, mu) / grid, color=colour, ls=dashes, lw=1)
        one, two = fit_snooker(law, speed, out, mu)
        row("", f"e = {one.x[0]:.3f}", one.fun, 1)
        mu, k = (*two.x[2:], mu, LIKE_SOLIDS)[:2]
        also = f", μ = {mu:.3f}, k = {k:.2f}" if len(two.x) > 2 else ""
        row("", f"e = {two.x[0]:.3f} - {two.x[1]:.4f} v²{also}", two.fun, len(two.x))
        ax.plot(grid, snooker(law, grid, falling(two.x, grid * cosine), mu, k) / grid, color=colour, lw=2, label=law)
    ax.set(xlabel="speed before, m/s", ylabel="speed after / before", title="A snooker ball, square on", ylim=(0.3, 1))


# --- bank shots ----------------------------------------------------------------------------------------------------


def bank(law: str, tangent: Array, e: Any, mu: Any, k: float) -> Array:
    """Tangent of the angle at which balls without spin come back, once they roll."""
    v = np.stack([-1 + 0 * tangent, tangent, 0 * tangent], axis=-1)
    final = after(law, v, 0 * v, e, mu, POOL, k, 0.028575).final.velocity
    found: Array = final[:, 1] / final[:, 0]
    return found


def fit_banks(law: str, into: Array, out: Array) -> Any:
    """Restitution, friction and, for springs, the ratio of their stiffnesses."""
    count = 3 if law == "stronge-cushion" else 2
    starts = [[0.8, 0.2, 0.8][:count], [0.6, 0.4, 1.2][:count]]
    bounds = ([0.2, 0.0, 0.3][:count], [1.0, 1.5, 2.5][:count])
    return best(lambda p: bank(law, into, p[0], p[1], p[2] if count > 2 else LIKE_SOLIDS) - out, starts, bounds)


def compare_banks(ax: Any) -> None:
    """Alciatore, TP B.28; Han's restitution is that at 1 m/s."""
    columns = datasets.load("alciatore_tpb28").columns
    rows = np.isfinite(columns["tan_in_derived"]) & np.isfinite(columns["tan_out_derived"])
    into, out = columns["tan_in_derived"][rows], columns["tan_out_derived"][rows]
    grid = np.linspace(0.02, 1.3, 60)
    ax.plot(into, out / into, "o", ms=4, color="#222222", zorder=3)
    print(f"\n{len(into)} banks\n\n| law | numbers | RMS of tan | AICc |\n|---|---|---|---|")
    for law in LAWS:
        colour, dashes = law_styles([law])[law]
        row(
            f"`{law}`",
            "its authors'",
            bank(law, into, *AUTHORS[law](1 + 0 * into, np.arctan(into)), LIKE_SOLIDS) - out,
            0,
        )
        curve = bank(law, grid, *AUTHORS[law](1 + 0 * grid, np.arctan(grid)), LIKE_SOLIDS)
        ax.plot(grid, curve / grid, color=colour, ls=dashes, lw=1)
        found = fit_banks(law, into, out)
        e, mu, k = (*found.x, LIKE_SOLIDS)[:3]
        row("", f"e = {e:.3f}, μ = {mu:.3f}" + (f", k = {k:.2f}" if len(found.x) > 2 else ""), found.fun, len(found.x))
        ax.plot(grid, bank(law, grid, e, mu, k) / grid, color=colour, lw=2, label=law)
    ax.set(
        xlabel="tan of the angle in", ylabel="tan out / tan in", title="Banks of balls without spin, five pool tables"
    )


# --- filmed three-cushion shots --------------------------------------------------------------------------------------


def compare_films(path: Path) -> None:
    """The rebounds of docs/validation/which_law.md; sidespin unknown, scatter fitted."""
    table = read_rebounds(path)
    table = table.select((table.stage == "rolling") & (table["v_n_in"] > SLOWEST))
    # (the ball that met something else: see the page)
    odd = (abs(table["v_n_in"] - 0.53) < 0.01) & (abs(abs(table["v_t_in"]) - 0.86) < 0.02)
    table = table.select(~odd)
    theta = np.arctan2(abs(table["v_t_in"]), table["v_n_in"])
    han = {"restitution_0": 0.39, "restitution_1": 0.257, "restitution_2": -0.044}
    springs = {"stiffness_ratio": LIKE_SOLIDS}
    jobs: list[tuple[str, str, str, dict[str, float]]] = [
        ("han2005", "its author's", "polynomial", han | {"friction": float(han_friction(theta).mean())}),
        ("mathavan2010", "its authors'", "constant", {"restitution": 0.98, "friction": 0.14, "floor_friction": CLOTH}),
        ("stronge-cushion", "pooltool's", "constant", {"restitution": 0.85, "friction": 0.2} | springs),
        *((law, "fitted", form, {}) for law in LAWS for form in ("constant", "polynomial")),
    ]
    print(f"\n{len(table)} rebounds\n\n| law | numbers | scatter | AICc | CV |\n|---|---|---|---|---|")
    for law, numbers, form, fixed in jobs:
        cloth = fixed.pop("floor_friction", None)
        setting = Setting(
            radius=0.03075, contact_height=CAROM, restitution=form, scatter="share", fixed=fixed, floor_friction=cloth
        )
        one = fit_laws(table, setting, [law], profiles=False, bootstrap=0).ranked[0]
        said = ", ".join(f"{key} {with_error_bar(e)}" for key, e in one.fit.estimates.items())
        scatter = 100 * one.fit.scatter["contacts"]
        print(f"| `{law}` | {numbers}: {said} | {scatter:.1f} % | {one.fit.aicc:.1f} | {one.score:.3f} |", flush=True)


def main() -> None:
    """Tables on standard output, and the picture."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("rebounds", type=Path, nargs="?")
    given = parser.parse_args()
    style = {"svg.hashsalt": "carom", "font.family": "STIXGeneral", "mathtext.fontset": "stix",
    "svg.fonttype": "path", "axes.spines.top": False, "axes.spines.right": False,
             "axes.titlesize": 10, "axes.titlelocation": "left", "legend.frameon": False}  # fmt: skip
    with plt.rc_context(style):
        figure, (left, right) = plt.subplots(1, 2, figsize=(9.5, 4.0), layout="constrained")
        compare_snooker(left)
        compare_banks(right)
        left.legend(title="fitted (thin: authors' numbers)", title_fontsize=9, fontsize=9, loc="lower right")
        figure.savefig(IMAGES / "cushions.svg", metadata={"Date": None})
    if given.rebounds:
        compare_films(given.rebounds)


if __name__ == "__main__":
    main()
