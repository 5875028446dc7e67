"""Laws of a cluster side by side: smooth balls of one size that touch, one of which is struck.

Each law takes the centres and velocities of the balls, (N, 3) in m and m/s, and the restitution of a pair, and returns the
velocities after. The two in the middle have no length and no time: balls with a gap do not touch, for them.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

import carom
from carom.plot.style import new_figure, style

Array = Any
RADIUS, MASS = 0.028575, 0.17
TOUCH = 1e-6  # of the radius: balls with such a gap touch


def contacts(position: Array) -> tuple[Array, Array, Array]:
    """Return the pairs that touch, and the unit vectors from the first ball of each to the second."""
    i, j = np.triu_indices(len(position), 1)
    apart = position[j] - position[i]
    length = np.linalg.norm(apart, axis=1)
    near = length < 2 * RADIUS * (1 + TOUCH)
    return i[near], j[near], apart[near] / length[near, None]


def opening_rates(position: Array) -> Array:
    """Return the matrix (C, 3 N) that gives the rates at which contacts open from all velocities."""
    i, j, n = contacts(position)
    rates = np.zeros((len(i), len(position), 3))
    rates[np.arange(len(i)), j] = n
    rates[np.arange(len(i)), i] = -n
    return rates.reshape(len(i), -1)


def at_once(position: Array, velocity: Array, restitution: float) -> Array:
    """Newton's law at all contacts at once (J. J. Moreau): u+ + e u- >= 0, impulses >= 0, and one of the two is zero.

    The linear complementarity problem of a matrix A^T A is that of the least squares |A p + b| over impulses p >= 0.
    """
    from scipy.optimize import nnls

    rates = opening_rates(position)
    impulses, _rest = nnls(rates.T, -(1 + restitution) * velocity.ravel())
    return velocity + (rates.T @ impulses).reshape(velocity.shape)


def impulse_space(position: Array, velocity: Array, restitution: float, step: float = 1e-3) -> Array:
    """The law of C. Liu, Z. Zhao and B. Brogliato (Proc. R. Soc. A 464, 3193, 2008) for contacts of Hertz's kind.

    The places stay as they are, and each contact keeps the work E done on it: forces are as E^(3/5), dE = -u dP where it is
    compressed and -u dP/e^2 where it expands (bistiff). With s as E^(2/5) that is s' = -u or -u/e^2, and a force s^(3/2), in a
    time of its own, here in units of the mass and of the speed; it is over when no work is left and nothing approaches.
    """
    rates = opening_rates(position)
    scale = np.abs(velocity).max()
    v, s = velocity.ravel() / scale, np.zeros(len(rates))

    def change(v: Array, s: Array) -> tuple[Array, Array]:
        u = rates @ v
        return rates.T @ np.maximum(s, 0) ** 1.5, np.where(u < 0, -u, -u / restitution**2)

    for _ in range(math.ceil(40 * math.sqrt(len(position)) / step)):
        dv, ds = change(v, s)
        dv2, ds2 = change(v + step / 2 * dv, s + step / 2 * ds)
        v, s = (
            v + step * dv2,
            np.maximum(s + step * ds2, 0),
        )  # (none is lost below zero: a contact that opened may close again)
        if s.max() == 0 and (rates @ v).min() > -1e-6:
            break
    return scale * v.reshape(velocity.shape)


def hertz(position: Array, velocity: Array, restitution: float, young: float = 5.84e9) -> Array:
    """carom's cluster: Hertz's contacts with Tsuji's damping, integrated together."""
    return _carom(position, velocity, {"restitution": restitution, "young": young})


def one_pair_at_a_time(position: Array, velocity: Array, restitution: float) -> Array:
    """Contacts that take no time, one after the other."""
    return _carom(position, velocity, {"restitution": restitution, "overlap": False})


def _carom(position: Array, velocity: Array, contact: dict[str, Any]) -> Array:
    balls = [
        {"radius": RADIUS, "mass": MASS, "position": x, "velocity": v}
        for x, v in zip(position.tolist(), velocity.tolist(), strict=True)
    ]
    run = {"duration": 2.5 * RADIUS / np.abs(velocity).max()}  # (until all have met that are so near)
    return carom.simulate(carom.Scene(gravity=0, balls=balls, ball_contact=contact, run=run)).final.velocity


LAWS: dict[str, Callable[[Array, Array, float], Array]] = {
    "one pair at a time": one_pair_at_a_time,
    "at once (Moreau)": at_once,
    "impulse space (LZB)": impulse_space,
    "Hertz (carom)": hertz,
}


# --- cases ----------------------------------------------------------------------------------------------------------


def _struck(others: Array, speed: float, from_: Array) -> tuple[Array, Array]:
    """Return centres and velocities of a ball that moves along x and has just come to touch the first of the others."""
    position = np.vstack([from_, others])
    velocity = np.zeros_like(position)
    velocity[0, 0] = speed
    return position, velocity


def row(count: int, speed: float = 1.0, gap: float = 0.0) -> tuple[Array, Array]:
    """A cradle: a ball that meets the first of a row, with a gap between its balls."""
    others = np.arange(count - 1)[:, None] * np.array([2 * RADIUS + gap, 0.0, 0.0])
    return _struck(others, speed, np.array([-2 * RADIUS, 0.0, 0.0]))


def vee(speed: float = 1.0) -> tuple[Array, Array]:
    """One ball that meets two touching ones in the middle."""
    others = RADIUS * np.array([[math.sqrt(3), 1, 0], [math.sqrt(3), -1, 0]])
    return _struck(others, speed, np.zeros(3))


def combination(angle_deg: float = 30.0, speed: float = 1.0) -> tuple[Array, Array]:
    """A frozen combination: the ball that is met touches another one in a direction off the line of the shot."""
    angle = math.radians(angle_deg)
    others = 2 * RADIUS * np.array([[0, 0, 0], [math.cos(angle), math.sin(angle), 0]])
    return _struck(others, speed, np.array([-2 * RADIUS, 0.0, 0.0]))


def rack(
    speed: float = 9.5, off: float = 0.0, gap: float = 0.0, spread: float = 0.0, seed: int = 0
) -> tuple[Array, Array]:
    """A triangle of fifteen, met at its apex, so far (m) off the middle; with gaps, drawn as those of a scene's rack."""
    lying = carom.Rack(balls=[str(k) for k in range(15)], gap=gap, gap_spread=spread, seed=seed)
    others = np.array(lying.places((0.0, 0.0, 0.0), RADIUS))
    return _struck(others, speed, np.array([-math.sqrt(4 * RADIUS * RADIUS - off * off), off, 0.0]))


def draw_break(off: float = 0.0) -> Any:
    """Draw the velocities after a break of touching balls, by each law."""
    from matplotlib.patches import Circle

    with style():
        figure = new_figure(6.4, 4.7)
        panels = figure.subplots(2, 2, sharex=True, sharey=True)
    position, velocity = rack(off=off)
    for axes, (name, law) in zip(panels.ravel(), LAWS.items(), strict=True):
        after = law(position, velocity, 0.95)
        for k, (x, v) in enumerate(zip(position, after, strict=True)):
            colour = "#D55E00" if k == 0 else "#0072B2"
            axes.add_patch(Circle((x[0], x[1]), RADIUS, fill=False, ec=colour if k == 0 else "0.65", lw=0.8))
            if np.linalg.norm(v) > 0.1:
                tip = (x[0] + 0.03 * v[0], x[1] + 0.03 * v[1])
                axes.annotate("", tip, (x[0], x[1]), arrowprops={"arrowstyle": "->", "color": colour, "lw": 1.3})
        axes.set(title=name, aspect="equal", xlim=(-0.3, 0.44), ylim=(-0.26, 0.25))
        axes.set_axis_off()
        axes.title.set_fontsize(9)
    axes.plot([0.12, 0.42], [-0.25, -0.25], color="0.3", lw=1.2)
    axes.text(0.27, -0.24, "10 m/s", ha="center", va="bottom", fontsize=8)
    return figure


def few_balls() -> Any:
    """A table of velocities after impacts of three to five balls, by each law."""
    from IPython.display import Markdown

    cases = {
        "cradle of 3, e = 1": (row(3), 1.0),
        "cradle of 5, e = 1": (row(5), 1.0),
        "cradle of 5, e = 0.95": (row(5), 0.95),
        "one on two that touch, e = 1": (vee(), 1.0),
        "frozen combination, 30°, e = 0.95": (combination(), 0.95),
    }

    def in_words(v: Array, flat: bool) -> str:
        return f"{v[0] + 0:.3f}" if flat else f"({v[0] + 0:.3f},\u00a0{v[1] + 0:.3f})"

    lines = ["| | law | velocities, m/s | energy |", "|---|---|---|---|"]
    for title, (case, e) in cases.items():
        for k, (name, law) in enumerate(LAWS.items()):
            after = law(*case, e)
            energy = (after**2).sum() / (case[1] ** 2).sum()
            words = ", ".join(in_words(v, flat=not after[:, 1].any()) for v in after.round(3))
            lines.append(f"| {'' if k else title} | {name} | {words} | {energy:.3f} |".replace("-", "−"))
    return Markdown("\n".join(lines))


def beside_belk() -> Any:
    """A table of speeds after the break that Jim Belk integrated, by each law."""
    from IPython.display import Markdown

    names = ["white", "1", "2, 3", "4, 6", "5", "7, 10", "8, 9", "11, 15", "12, 14", "13"]
    first = [0, 1, 2, 4, 5, 7, 8, 11, 12, 13]
    belk = [1.79, 1.20, 1.57, 1.42, 0.12, 1.31, 0.25, 5.60, 2.57, 2.63]
    laws = {**LAWS, "Hertz, as stiff as his": lambda *case: hertz(*case, young=7.6e14)}
    head = ["| |" + "|".join(names) + "|", "|---" * (len(names) + 1) + "|"]
    lines = [*head, "| **Belk** |" + "|".join(f"{x:.2f}" for x in belk) + "|"]
    for name, law in laws.items():
        speed = np.linalg.norm(law(*rack(10.0), 1.0), axis=1)[first]
        lines.append(f"| {name} |" + "|".join(f"{x:.2f}" for x in speed) + "|")
    return Markdown("\n".join(lines))


def draw_gaps() -> Any:
    """Draw the velocity of a ball that has met two at rest, over the gap between these."""
    gaps = np.array([1, 2, 5, 10, 20, 30, 40, 50, 70, 100, 150, 200]) * 1e-6
    with style():
        figure = new_figure(6.4, 3.0)
        axes = figure.subplots()
        for e, line in ((1.0, "-"), (0.95, "--")):
            striker = [[law(*row(3, gap=gap), e)[0, 0] for gap in gaps] for law in (hertz, one_pair_at_a_time)]
            axes.plot(1e6 * gaps, striker[0], line, color="#0072B2", label=f"Hertz, e = {e:g}")
            axes.plot(1e6 * gaps, striker[1], line, color="#D55E00", label=f"one pair at a time, e = {e:g}")
        axes.axhline(0, color="0.6", lw=0.8)
        axes.set(
            xscale="log", xlabel="gap between the two at rest, µm", ylabel="striker after, m/s", ylim=(-0.08, 0.045)
        )
        axes.legend(frameon=False, fontsize=8)
        figure.tight_layout()
    return figure
