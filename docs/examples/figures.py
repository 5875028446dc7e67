"""Pictures of pages of theory."""

from __future__ import annotations

from typing import Any

import numpy as np

import carom
from carom.laws.maw import maw_slip_ratio
from carom.laws.stronge import stronge_slip_ratio
from carom.plot.style import GREY, new_figure, style

COLOURS = ("#0072B2", "#009E73", "#D55E00", "#CC79A7")
# Largest difference of (v, a omega) between springs, the floor these times as stiff as the wall and damped, and the law.
RATIO = (1, 10, 100, 1e3, 1e4, 1e5)
SPRINGS = {
    "backspin, upright wall, both slip": (1.90e-2, 1.56e-2, 2.25e-3, 2.33e-4, 2.34e-5, 2.34e-6),
    "rolling, cushion": (7.38e-2, 2.54e-2, 4.52e-3, 4.98e-4, 5.03e-5, 5.04e-6),
    "stunned with side, cushion": (2.21e-1, 6.23e-2, 5.47e-3, 5.34e-4, 5.35e-5, 5.68e-6),
    "backspin, wall sticks, floor lets go": (6.56e-2, 6.15e-2, 2.95e-2, 9.93e-3, 3.18e-3, 1.01e-3),
}


def thrown(speed: float, cut: Any, rolling: bool) -> Any:
    """Return the throw (degrees) under the law alciatore at cut angles (n,), degrees."""
    ball, rest = carom.Ball(radius=0.028575, mass=0.17), carom.State((0, 0, 0), (0, 0, 0))
    phi = np.radians(cut)
    roll = (0, speed / ball.radius if rolling else 0, 0)
    cue = carom.State(np.stack([speed + 0 * phi, 0 * phi, 0 * phi], axis=-1), roll)
    n = np.stack([-np.cos(phi), np.sin(phi), 0 * phi], axis=-1)
    v = carom.collide(ball, cue, ball, rest, n, carom.Surface(1.0, 0.0), law="alciatore").after[1].velocity
    return cut + np.degrees(np.arctan2(v[:, 1], v[:, 0]))


def published_throw(speed: float, cut: Any, rolling: bool) -> Any:
    """(15) to (17) of TP A.14."""
    phi = np.radians(cut)
    slip = speed * np.hypot(np.sin(phi), np.cos(phi) if rolling else 0)
    mu = 9.951e-3 + 0.108 * np.exp(-1.088 * slip)
    return np.degrees(np.arctan(np.minimum(mu * speed * np.cos(phi) / slip, 1 / 7) * np.tan(phi)))


def throw() -> Any:
    """The throw over the cut angle, beside Alciatore's formula."""
    with style():
        figure = new_figure(6, 3.6)
        axes = figure.subplots()
        cut, every = np.linspace(1, 89, 177), np.arange(5, 90, 10.0)
        for mph, colour in zip((1, 3, 7), COLOURS, strict=False):
            v = 0.44704 * mph
            for rolling in (False, True):
                label = f"{mph} mph, {'rolling' if rolling else 'stun'}"
                axes.plot(cut, thrown(v, cut, rolling), colour, ls="--" if rolling else "-", label=label)
                axes.plot(every, published_throw(v, every, rolling), "o", color=colour, mfc="none", ms=5)
        axes.set(
            xlabel="cut angle (degrees)", ylabel="throw (degrees)", title="alciatore; circles: TP A.14", ylim=(0, 7)
        )
        axes.legend(fontsize=8, ncols=2)
        figure.tight_layout()
    return figure


def struck(runs: dict[str, Any]) -> Any:
    """Paths of struck balls from above."""
    with style():
        figure = new_figure(7.2, 3.0)
        axes = figure.subplots()
        looks = zip(("-", "--", "-", ":"), ("#888888", "#E69F00", "#0072B2", "#D55E00"), strict=True)
        for (name, run), (line, colour) in zip(runs.items(), looks, strict=True):
            x, y, _z = run.at(np.linspace(0, 1.2, 600)).position[:, 0].T
            axes.plot(x, y, line, color=colour, label=name)
        axes.set(
            xlabel="x, m (where the cue points)", ylabel="y, m", xlim=(-0.3, 2.2), ylim=(-0.7, 0.15), aspect="equal"
        )
        axes.legend(frameon=False, fontsize=8)
        figure.tight_layout()
    return figure


def compliance() -> Any:
    """Slip after an impact over slip before it, with springs and without."""
    k, kappa = 14 / 17, 2 / 5
    psi, chi = np.linspace(0.02, 6.5, 400), k * 3.5 / 2
    with style():
        figure = new_figure(6, 3.8)
        axes = figure.subplots()
        axes.plot(psi, [p * maw_slip_ratio(p, chi) for p in psi], color="#CC79A7", lw=1.8, label="maw, e = 1")
        for e, dashes in ((1.0, "solid"), (0.7, (0, (4, 2)))):
            slips = [p * stronge_slip_ratio(p / k, kappa, e, k) for p in psi]
            axes.plot(psi, slips, color="#E69F00", ls=dashes, lw=1.8, label=f"stronge, e = {e:g}")
        rigid = np.maximum(psi - 2 * 3.5 * k, 0)
        axes.plot(psi, rigid, color="#0072B2", lw=1, ls=(0, (1, 1.5)), label="rigid (Coulomb), e = 1")
        axes.axhline(0, color="#8a8a8a", lw=0.5)
        axes.set(xlabel=r"slip before, $\psi = k u_t/(\mu u_n)$", ylabel="slip after, in the same unit")
        axes.legend(fontsize=8, frameon=False, loc="upper left")
        figure.tight_layout()
    return figure


def springs() -> Any:
    """How springs approach the law of wall and floor at once."""
    with style():
        figure = new_figure(6, 3.6)
        axes = figure.subplots()
        for (name, error), mark, colour in zip(SPRINGS.items(), "os^D", COLOURS, strict=True):
            axes.loglog(RATIO, error, marker=mark, lw=1.2, ms=5, color=colour, label=name)
        axes.set(xlabel="floor's stiffness over the wall's", ylabel="difference to the law")
        axes.legend(fontsize=8, frameon=False)
        figure.tight_layout()
    return figure


def gases(x: Any, theory: Any, points: tuple[Any, Any, Any], words: str, **labels: Any) -> Any:
    """Means over gases with error bars, beside a theory without fitted numbers."""
    with style():
        figure = new_figure(5.6, 3.2)
        axes = figure.add_subplot()
        axes.plot(x, theory, color=GREY, label=f"{words}; nothing fitted")
        axes.errorbar(*points[:2], yerr=points[2], fmt="o", ms=2.5, label="32 gases of 1,000 grains")
        axes.set(**labels)
        axes.legend()
        figure.tight_layout()
    return figure


def regular_shares(radii: Any, shares: Any) -> Any:
    """Share of regular orbits of Sinai's billiard over the radius of the scatterer."""
    shares = np.array(shares)
    with style():
        figure = new_figure(5.6, 3.2)
        axes = figure.add_subplot()
        axes.axvline(1 / 3, color=GREY, lw=0.8, ls="--")
        axes.text(0.326, 30, "1/(2 + 2κ)", ha="right", color=GREY)
        axes.errorbar(radii, 100 * shares, yerr=100 * np.sqrt(shares * (1 - shares) / 1000), fmt="o-", ms=3, lw=0.8)
        axes.set(xlabel="radius of the scatterer / side of the cell", ylabel="regular orbits, %", ylim=(-1, 36))
        figure.tight_layout()
    return figure
