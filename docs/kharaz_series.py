"""What each series of the alumina spheres (Kharaz, Gorham & Salman 2001) says by itself, and all of them together.

    python docs/kharaz_series.py

A ball without spin meets a wall at incidence i, with restitution e and r = v_t after / v_t before. Then

    spin = (1 - r) v sin(i) / (kappa a),    tan(rebound) = r tan(i) / e,    tan(patch) = ((1 + 1/kappa) r - 1/kappa) tan(i) / e,

and r hangs on tan(i), mu (1 + e) and the stiffness ratio only: r and spin by themselves never tell e.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from carom.data.datasets import load
from carom.laws.law import contact_kernel
from carom.laws.maw import maw_contact

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Array = NDArray[np.float64]
SERIES = {
    "kept": "vt_out/vt_in (centre)",
    "spin": "spin_out",
    "rebound": "rebound_angle_from_normal",
    "patch": "contact_patch_recoil_angle",
}
ANGLES = ("rebound", "patch")
RADIUS, SPEED = 0.0025, 3.9  # m, m/s
KAPPA = 0.4  # a solid sphere
READ = 0.2  # degrees: every angle, incidence too, by itself
SHARED = 0.25  # degrees: what all angles of a series have in common, such as a graph's axis that was set wrongly
# the patch's angles may not be used above 60 degrees; from 29 on all slide, if the stiffness ratio is that of solids
LAST, SLIDES = 61.0, 29.0
START = {"restitution": 0.98, "friction": 0.09, "stiffness_ratio": 0.85}


def said(name: str, incidence: Array, numbers: dict[str, float], slides: bool) -> Array:
    """Return what a series would show at these incidences (degrees): by maw, or by a contact that always slides."""
    e, mu = numbers["restitution"], numbers["friction"]
    # with beta = 1 the slip would be reversed if the contact held: it slides from 18 degrees on
    law, last = (contact_kernel, 1.0) if slides else (maw_contact, numbers["stiffness_ratio"])
    i = np.radians(incidence)
    before = [(-SPEED * math.cos(x), SPEED * math.sin(x), 0.0) for x in i]
    after = [law(v, (0.0, 0.0, 0.0), (1.0, 0.0, 0.0), RADIUS, KAPPA, e, mu, last) for v in before]
    n, t, w = np.array([(v[0], v[1], spin[2]) for v, spin in after]).T
    if name == "kept":
        return np.asarray(t / (SPEED * np.sin(i)))
    if name == "spin":
        return np.abs(w)
    return np.degrees(np.arctan2(t if name == "rebound" else t - RADIUS * w, n))


@dataclass
class Read:
    """A fit to some of the series."""

    values: dict[str, float]
    errors: dict[str, float]
    chi2: float
    dof: int
    scatter: dict[str, float]
    """Of each series, over the error of reading; 1 at least."""
    shifts: dict[tuple[str, str], float] = field(default_factory=dict)
    """Degrees by (series, "incidence" or "angle")."""


def fit_series(names: tuple[str, ...], *, slides: bool = False, shared: float = 0.0, fixed: dict[str, float] | None = None,
               scatter: dict[str, float] | None = None, only: tuple[str, str] | None = None) -> Read:  # fmt: skip
    """One law fitted to series, each read at its own incidences.

    ``shared``: the standard error (degrees) of a shift that all angles of a series have in common, sought along; 0 for none.
    ``only``: this shift alone. ``scatter``: by how much the readings of each series scatter more than they were read; sought by
    turns if it is not given.
    """
    from scipy.optimize import least_squares

    data = load("kharaz2001").columns
    rows = {}
    for name in names:
        at = data["incidence_from_normal_deg"][data["quantity"] == SERIES[name]]
        value = data["value"][data["quantity"] == SERIES[name]]
        use = (at < LAST) & (at > (SLIDES if slides else 0.5))  # straight on tells nothing: all angles are zero
        rows[name] = (at[use], value[use])
    fixed = fixed or {}
    free = [name for name in START if name not in fixed and not (slides and name == "stiffness_ratio")]
    shifts = [(name, "incidence") for name in rows] + [(name, "angle") for name in rows if name in ANGLES]
    shifts = [shift for shift in shifts if shared and only in (None, shift)]

    def parts(x: Array) -> dict[str, Array]:
        numbers = fixed | dict(zip(free, x, strict=False))
        moved = dict(zip(shifts, x[len(free) :], strict=True))
        gaps = {}
        for name, (at, value) in rows.items():
            there = at + moved.get((name, "incidence"), 0.0)
            here = said(name, there, numbers, slides)
            slope = (said(name, there + 0.01, numbers, slides) - here) / 0.01
            own = {"kept": 0.005, "spin": 5 + 0.01 * value}.get(name, READ)
            gaps[name] = (value - here - moved.get((name, "angle"), 0.0)) / np.hypot(own, slope * READ)
        return gaps

    def residuals(x: Array, scatter: dict[str, float]) -> Array:
        prior = x[len(free) :] / (shared or 1.0)
        return np.concatenate([*(gap / scatter[name] for name, gap in parts(x).items()), prior])

    x = np.array([START[name] for name in free] + [0.0] * len(shifts))
    low = np.array([0.3 if name == "stiffness_ratio" else 0.0 for name in free] + [-3.0] * len(shifts))
    wide = scatter or dict.fromkeys(rows, 1.0)
    for _ in range(1 if scatter else 8):
        found = least_squares(
            residuals, x, args=(wide,), bounds=(low, 3.0), x_scale=np.maximum(np.abs(x), 0.05), diff_step=1e-5
        )
        x, last = found.x, wide
        if not scatter:
            wide = {n: max(1.0, math.sqrt(float(gap @ gap) / (len(gap) - 1))) for n, gap in parts(x).items()}
    error = np.sqrt(np.diag(np.linalg.pinv(found.jac.T @ found.jac)))
    count = sum(len(at) for at, _value in rows.values())
    return Read(
        dict(zip(free, x.tolist(), strict=False)), dict(zip(free, error.tolist(), strict=False)), 2 * float(found.cost),
        count - len(free), last, dict(zip(shifts, x[len(free) :].tolist(), strict=True)),
    )  # fmt: skip


SETS = {
    "angle of rebound alone": ("rebound",),
    "recoil of the patch alone": ("patch",),
    "tangential speed, rebound": ("kept", "rebound"),
    "tangential speed, patch": ("kept", "patch"),
    "all but the patch": ("kept", "spin", "rebound"),
    "all four": ("kept", "spin", "rebound", "patch"),
}


def table(given: float = 0.98) -> str:
    """Restitution and friction by series and law, without and with shifts; and what a given restitution does to the rest."""
    lines = [f"{'':29s}{'each reading by itself':32s}series may be shifted, {SHARED:g} degrees"]
    for slides in (False, True):
        lines.append("all slide, 29 degrees and more" if slides else "tangential compliance, all angles")
        for words, names in SETS.items():
            line = f"  {words:27s}"
            for shared in (0.0, SHARED):
                one = fit_series(names, slides=slides, shared=shared)
                line += "".join(
                    f"{letter} {one.values[name]:.3f} ± {one.errors[name]:.3f}   "
                    for letter, name in (("e", "restitution"), ("μ", "friction"))
                )
            lines.append(line.rstrip())
    lines.append(f"restitution {given:g} given, all four series, tangential compliance")
    for shared in (0.0, SHARED):
        free = fit_series(SETS["all four"], shared=shared)
        held = fit_series(SETS["all four"], shared=shared, fixed={"restitution": given}, scatter=free.scatter)
        lines.append(
            f"  shifts of {shared:4g} degrees: μ {held.values['friction']:.4f} ± {held.errors['friction']:.4f},"
            f" stiffness ratio {held.values['stiffness_ratio']:.2f} ± {held.errors['stiffness_ratio']:.2f},"
            f" chi² {held.chi2:.1f} against {free.chi2:.1f} with restitution free"
        )
    # (what is read low by a shift has to be put up by it)
    for words, moved, sign in (
        ("angles of rebound", ("rebound", "angle"), -1),
        ("their incidences", ("rebound", "incidence"), 1),
    ):
        one = fit_series(("kept", "rebound"), shared=10.0, only=moved, fixed={"restitution": given})
        lines.append(
            f"  with the tangential speeds: it takes a shift of all {words} by {sign * one.shifts[moved]:+.2f} degrees"
        )
    for words, names in (("tangential speed", ("kept",)), ("spin", ("spin",))):
        one = fit_series(names, fixed={"restitution": given})
        lines.append(f"  {words} alone: μ {one.values['friction']:.4f} ± {one.errors['friction']:.4f}")
    return "\n".join(lines)


def draw(given: float = 0.98) -> Figure:
    """Restitution and friction by series, under tangential compliance, beside the published ones."""
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, 2, figsize=(8, 3), sharey=True, layout="constrained")
    for shared, colour, down in ((0.0, "#888888", -0.12), (SHARED, "#1f5fa8", 0.12)):
        found = [fit_series(names, shared=shared) for names in SETS.values()]
        for axis, name in zip(axes, ("restitution", "friction"), strict=True):
            axis.errorbar(
                [one.values[name] for one in found], np.arange(len(found)) + down, xerr=[one.errors[name] for one in found],
                fmt="o", ms=4, color=colour, label=f"series may be shifted, {shared:g}°" if shared else "readings by themselves",
            )  # fmt: skip
    # (printed to so many digits, and so it may be half of the last one off)
    for axis, published, last, words in zip(
        axes, (given, 0.09), (0.005, 0.005), ("restitution", "friction"), strict=True
    ):
        axis.axvspan(
            published - last,
            published + last,
            color="#c0392b",
            alpha=0.12,
            lw=0,
            zorder=0,
            label="published, as rounded",
        )
        axis.locator_params(axis="x", nbins=6)
        axis.set_xlabel(words)
        axis.spines[["top", "right"]].set_visible(False)
    axes[0].set_yticks(range(len(SETS)), list(SETS))
    axes[0].invert_yaxis()
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside upper center", ncols=3, frameon=False, fontsize=9)
    return figure


if __name__ == "__main__":
    print(table())
