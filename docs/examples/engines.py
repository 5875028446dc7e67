"""Tables and pictures of the page on engines judged, from the frames in docs/data/engines."""

from __future__ import annotations

import csv
import sys
from pathlib import Path
from typing import Any

import numpy as np
from IPython.display import Markdown

import carom
from carom.interop import engines
from carom.plot.style import new_figure, style

sys.path.insert(0, str(Path(__file__).parents[2] / "campaigns"))
from engines_asked import TABLE, by_carom
from engines_judged import ENGINES, RADIUS, SITUATIONS, file_of, judged, plays

FOUND = {
    (situation, engine): judged(engine, situation)
    for situation in SITUATIONS
    for engine in ENGINES
    if plays(engine, situation)
}


def violations() -> Markdown:
    """Violations of each law, of as many as were checked, with the largest."""
    lines = ["| situation | engine | violated | the largest |", "|---|---|---|---|"]
    for (situation, engine), one in FOUND.items():
        for law, count in one.checked.items():
            worst = max(one.of(law), key=lambda violation: violation.size, default=None)
            if worst is not None:
                size = f"{1e3 * worst.size:.2g} mm: {worst.text}" if law == "penetration" else worst.text
                lines.append(
                    f"| {situation} | {engine} | {law}, {len(one.of(law))} of {count} | {worst.time:.3f} s: {size} |"
                )
        if not one.violations:
            lines.append(f"| {situation} | {engine} | none | {sum(one.checked.values())} checks |")
    return Markdown("\n".join(lines))


def marks(situation: str, engine: str) -> Any:
    """The violations over time."""
    return carom.plot.plot_judgement(FOUND[situation, engine])


def frames(engine: str, situation: str) -> tuple[Any, Any, Any]:
    """Times (n,), places (n, ball, axis) and spins of all balls."""
    rows = np.loadtxt(file_of(engine, situation), delimiter=",", skiprows=1)
    rows = rows.reshape(-1, len(SITUATIONS[situation].places), rows.shape[-1])
    return rows[:, 0, 0], rows[:, :, 2:5], rows[:, :, 5:8]


def last_velocities(engine: str, situation: str) -> Any:
    """Velocities (ball, axis) over the last four frames."""
    t, x, _w = frames(engine, situation)
    return (x[-1] - x[-4]) / (t[-1] - t[-4])


def bounced(engine: str) -> Any:
    """Restitutions of the first two bounces, from the heights between them."""
    t, x, _w = frames(engine, "bounce")
    z = x[:, 0, 2] - RADIUS
    top = [z[i] for i in range(1, len(z) - 1) if z[i - 1] <= z[i] > z[i + 1] and t[i] > 0.2][:2]
    return np.sqrt([top[0] / z[0], top[1] / top[0]])


def numbers() -> Markdown:
    """What was given, and what the frames show."""
    heads = "| engine | e of bounce 1 | e of bounce 2 | speed as it rolls, m/s | spin × radius, m/s"
    lines = [f"{heads} | speed after the rack: first, mean of six, m/s |", "|---|---:|---:|---:|---:|---:|"]
    lines.append("| *given, exact* | 0.8 | 0.8 | 5/7 = 0.7143 | 0.7143 | |")
    for engine in ENGINES:
        e1, e2 = (f"{e:.3f}" for e in bounced(engine)) if plays(engine, "bounce") else ("–", "–")
        v, w = last_velocities(engine, "roll")[0, 0], frames(engine, "roll")[2][-1, 0, 1] * RADIUS
        speeds = np.linalg.norm(last_velocities(engine, "rack"), axis=1)
        lines.append(f"| {engine} | {e1} | {e2} | {v:.4f} | {w:.4f} | {speeds[0]:.2f}, {speeds[1:].mean():.2f} |")
    return Markdown("\n".join(lines))


def picture() -> Any:
    """Velocities after the cradle, and heights of the bounces."""
    with style():
        figure = new_figure(8.4, 3.2)
        cradle, bounce = figure.subplots(1, 2)
        for k, engine in enumerate(engine for engine in ENGINES if plays(engine, "cradle")):
            cradle.bar(np.arange(5) + 0.2 * (k - 1.5), last_velocities(engine, "cradle")[:, 0], 0.2, label=engine)
            t, x, _w = frames(engine, "bounce")
            bounce.plot(t, 1e3 * (x[:, 0, 2] - RADIUS), lw=1.2, label=engine)
        cradle.axhline(0, color="0.5", lw=0.8)
        cradle.set(
            xlabel="ball",
            ylabel="velocity after the cradle, m/s",
            xticks=range(5),
            xticklabels=["first", 2, 3, 4, "last"],
        )
        bounce.set(xlabel="t, s", ylabel="height above the floor, mm")
        cradle.legend(fontsize=8)
        figure.tight_layout()
    return figure


def asked() -> Markdown:
    """Restitution and friction got, of what was asked."""
    with TABLE.open(encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))[1:]
    es = list(dict.fromkeys(row[2] for row in rows))
    lines = [f"| e asked | {' | '.join(es)} | {' | '.join(es)} |", "|---|" + "---:|" * (2 * len(es))]
    for name, rate in dict.fromkeys((row[0], row[1]) for row in rows):
        mine = [row for row in rows if row[:2] == [name, rate]]
        cells = [f"{float(row[k]):.{3 if k == 3 else 4}f}" for k in (3, 5) for row in mine]
        lines.append(f"| {name}, {rate}/s | {' | '.join(cells)} |")
    exact = [by_carom(float(e)) for e in es]
    lines.append(
        f"| carom | {' | '.join(f'{one[0]:.3f}' for one in exact)} | {' | '.join(f'{one[1]:.4f}' for one in exact)} |"
    )
    return Markdown("\n".join(lines))


def recipes() -> Markdown:
    """MuJoCo's solref and Hunt and Crossley's dissipation for some restitutions."""
    lines = ["| e | `solref`, 20 ms | d at 1 m/s, s/m | at 5 m/s |", "|---|---|---:|---:|"]
    for e in (0.1, 0.3, 0.5, 0.7, 0.8, 0.9, 1.0):
        spring = " ".join(f"{one:.5g}" for one in engines.solref(e, 0.02).round(2) + 0.0)
        d = engines.hunt_crossley_dissipation(e, [1.0, 5.0])
        lines.append(f"| {e} | {spring} | {d[0]:.4f} | {d[1]:.4f} |")
    return Markdown("\n".join(lines))
