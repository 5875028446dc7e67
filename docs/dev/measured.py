"""Prediction beside measurement: two pictures in docs/images and the table that the README shows.

    python docs/dev/measured.py

Nothing is fitted here: restitution and friction are the published ones. (The 0.4 of the second curve in the alumina's
picture is only there to show that no one value serves at all angles.)
"""

from __future__ import annotations

import math
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
import numpy as np

import carom
from carom.data import datasets

IMAGES = Path(__file__).parents[1] / "images"
STYLE = {
    "svg.hashsalt": "carom", "font.family": "STIXGeneral", "mathtext.fontset": "stix",
    "svg.fonttype": "path", "font.size": 10, "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.titlesize": 10, "axes.titlelocation": "left", "legend.frameon": False, "figure.figsize": (9.0, 3.9),
}  # fmt: skip
POINT = {"fmt": "o", "ms": 4, "color": "#222222", "lw": 1, "zorder": 3}
BLUE, RED, GREY = "#1f5fa8", "#c0392b", "#888888"

# Mathavan, Jackson & Parkin 2010: restitution and friction of the cushion, mean friction of the cloth, contact at 7R/5
SNOOKER = carom.Ball(radius=0.02625, mass=0.1406)
CUSHION = carom.Surface(restitution=0.98, friction=0.14)
CLOTH = carom.Surface(restitution=0.0, friction=0.212)
NOSE = (math.sqrt(1 - 0.4**2), 0.0, -0.4)


def cushion(speed: np.ndarray, **options: object) -> carom.TwoStep:
    state = carom.rolling(SNOOKER, np.stack([-speed, np.zeros_like(speed)], axis=-1))
    return carom.two_step(SNOOKER, state, **{"wall": CUSHION, "floor": CLOTH, "normal": NOSE, **options})


def deviation(predicted: np.ndarray, measured: np.ndarray) -> tuple[float, float]:
    gap = predicted - measured
    return float(np.sqrt((gap * gap).mean())), float(np.abs(gap).max())


def mathavan() -> list[tuple[str, ...]]:
    table = datasets.load("mathavan2009").columns
    before, measured = table["v_n_in_m_s"], table["v_n_out_m_s"]
    slow = before < 1.5
    speed = np.linspace(0.2, 3.5, 100)
    figure, (left, right) = plt.subplots(1, 2)
    for axis, low, top in ((left, None, 3.6), (right, slow, 1.55)):
        rows = slow if low is not None else slow | ~slow
        axis.errorbar(before[rows], measured[rows], xerr=table["u_digit_v_in"][rows], yerr=table["u_digit_v_out"][rows],
                      label="measured", **POINT)  # fmt: skip
        axis.plot(
            speed, cushion(speed).after_wall.velocity[:, 0], color=BLUE, label="two-step, cushion and cloth at once"
        )
        axis.plot(speed, cushion(speed, floor_contact="after").after_wall.velocity[:, 0], color=RED, ls="--",
                  label="cushion alone, then the cloth")  # fmt: skip
        axis.plot(speed, cushion(speed).rolling.velocity[:, 0], color=GREY, ls=":", label="once it rolls again")
        axis.set(xlim=(0, top), ylim=(0, top), xlabel="speed before, m/s", ylabel="speed after, m/s")
    left.axvline(1.5, color=GREY, lw=0.6)
    left.text(1.47, 3.5, "the authors fit below", ha="right", va="top", fontsize=8, color=GREY)
    left.set_title("Snooker ball rolling square into a cushion")
    right.set_title("The same, below 1.5 m/s")
    right.legend(loc="upper left", fontsize=8)
    save(figure, "mathavan2009")
    both = cushion(before).after_wall.velocity[:, 0]
    alone = cushion(before, floor_contact="after").after_wall.velocity[:, 0]
    rolls = cushion(before).rolling.velocity[:, 0]
    level = cushion(before, normal=(1.0, 0.0, 0.0)).after_wall.velocity[:, 0]
    return [
        row("Mathavan 2009, below 1.5 m/s", "speed after, m/s", both[slow], measured[slow]),
        row("&nbsp;&nbsp; the same, above", "speed after, m/s", both[~slow], measured[~slow]),
        row("&nbsp;&nbsp; below, cushion alone, then the cloth", "speed after, m/s", alone[slow], measured[slow]),
        row("&nbsp;&nbsp; below, cushion at the centre's height", "speed after, m/s", level[slow], measured[slow]),
        row("&nbsp;&nbsp; below, taken for the speed once it rolls", "speed after, m/s", rolls[slow], measured[slow]),
    ]


ALUMINA = carom.Ball(radius=0.0025, mass=2.6e-4)  # the mass drops out
GLASS = {beta: carom.Surface(restitution=0.98, friction=0.09, tangential_restitution=beta) for beta in (0.0, 0.4)}
SPEED = 3.9
# series, its share of the picture, what is computed from the state after
SERIES = (
    ("vt_out/vt_in (centre)", "tangential speed, after / before", lambda v, spin, a: v[:, 1] / (SPEED * np.sin(a))),
    ("spin_out", "spin after, rad/s", lambda v, spin, a: spin),
    ("rebound_angle_from_normal", "angle after, degrees", lambda v, spin, a: np.degrees(np.arctan2(v[:, 1], v[:, 0]))),
)


def glass(degrees: np.ndarray, beta: float, compute: object) -> np.ndarray:
    angle = np.radians(degrees)
    velocity = SPEED * np.stack([-np.cos(angle), np.sin(angle), np.zeros_like(angle)], axis=-1)
    after = carom.impact(ALUMINA, carom.State(velocity), surface=GLASS[beta]).after
    return compute(after.velocity, after.spin[:, 2], angle)


def kharaz() -> list[tuple[str, ...]]:
    table = datasets.load("kharaz2001").columns
    figure, axes = plt.subplots(1, 3)
    rows = []
    degrees = np.linspace(0.5, 65, 200)
    # with beta = 0 the contact slides from tan i = (1 + e) mu (1 + kappa)/kappa on
    slides = math.degrees(math.atan(1.98 * 0.09 * 3.5))
    for axis, (name, label, compute) in zip(axes, SERIES, strict=True):
        chosen = table["quantity"] == name
        angle, measured = table["incidence_from_normal_deg"][chosen], table["value"][chosen]
        axis.errorbar(angle, measured, label="measured", **POINT)
        axis.plot(degrees, glass(degrees, 0.0, compute), color=BLUE, label="β = 0: it stops the slip")
        axis.plot(degrees, glass(degrees, 0.4, compute), color=RED, ls="--", label="β = 0.4")
        axis.axvline(slides, color=GREY, lw=0.6)
        axis.set(xlim=(0, 65), xlabel="incidence from the normal, degrees", title=label)
        axis.set_ylim(bottom=0)
        large = angle > 35
        for beta, text in ((0.0, "β = 0"), (0.4, "β = 0.4")):
            gap = glass(angle, beta, compute)
            if beta == 0:
                rows.append(row("Kharaz 2001, above 35°", label, gap[large], measured[large]))
            rows.append(row(f"&nbsp;&nbsp; below 35°, {text}", label, gap[~large], measured[~large]))
    axes[0].text(slides + 1, 0.02, "slides →", fontsize=8, color=GREY)
    axes[0].legend(loc="lower left", fontsize=8, bbox_to_anchor=(0, 0.06))
    save(figure, "kharaz2001")
    return rows


def row(what: str, quantity: str, predicted: np.ndarray, measured: np.ndarray) -> tuple[str, ...]:
    rms, most = deviation(predicted, measured)
    return (
        what,
        quantity,
        str(len(measured)),
        f"{measured.min():.3g} to {measured.max():.3g}",
        short(rms),
        short(most),
    )


def short(x: float) -> str:
    return f"{x:.0f}" if x >= 10 else f"{x:.2g}"


def save(figure: plt.Figure, name: str) -> None:
    figure.tight_layout()
    IMAGES.mkdir(exist_ok=True)
    figure.savefig(IMAGES / f"{name}.svg", metadata={"Date": None, "Creator": None})


if __name__ == "__main__":
    with plt.rc_context(STYLE):
        found = mathavan() + kharaz()
    print("| measurement | quantity | shots | measured | RMS deviation | largest |")
    print("|---|---|---|---|---|---|")
    for line in found:
        print("| " + " | ".join(line) + " |")
