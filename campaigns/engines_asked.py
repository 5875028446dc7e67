"""Restitution and friction asked of engines, and got: a ball that falls, bounces once and slides on, at three steps.

    python campaigns/engines_asked.py [--python PYTHON] [--folder FOLDER] [--only rapier]

A script an engine, in campaigns/engines, whose first line says which package it needs. PYTHON (default: this one) has those of
PyPI, FOLDER/node_modules (default: here) those of npm; nothing is downloaded, and an engine that is not there is left out. What was
got goes to docs/data/engines/asked.csv. With --small the table that is there is read, and carom is asked.
"""

from __future__ import annotations

import csv
import json
import math
import subprocess
import sys
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from campaign import ROOT, campaign

import carom
from carom.interop.engines import solref

TABLE = ROOT / "docs" / "data" / "engines" / "asked.csv"
SCRIPTS = ROOT / "campaigns" / "engines"
STEPS, RESTITUTIONS = (60, 240, 1000), (0.1, 0.3, 0.5, 0.8, 1.0)  # per second
GIVEN = {
    "steps": [1 / rate for rate in STEPS], "restitutions": RESTITUTIONS, "friction": 0.2,
    "radius": 0.2, "height": 2.0, "speed": 20.0, "gravity": 9.81, "duration": 0.9,
    # (a contact of 10 steps)
    "solref": {f"{1 / rate}": solref(RESTITUTIONS, 10 / rate).tolist() for rate in STEPS},
}  # fmt: skip
ENGINES = {  # a script, and what is asked otherwise
    "Box2D": ("box2d.py", {}), "Jolt": ("jolt.mjs", {}), "MuJoCo": ("mujoco.py", {}),
    "MuJoCo, falling straight": ("mujoco.py", {"speed": 0.0}), "PyBullet": ("pybullet.py", {}),
    "pymunk": ("pymunk.py", {}), "Rapier": ("rapier.mjs", {}),
}  # fmt: skip
HEADS = ("engine", "steps per second", "restitution asked", "restitution got", "friction asked", "friction got")


def got(z: Any, vx: Any, vz: Any, step: float) -> tuple[float, float]:
    """Return restitution and friction of the first contact, of heights and velocities (n,) after each step.

    Speeds at the floor follow from those of the frames beside the contact, by energy. The contact's impulse is what gravity does
    not explain.
    """
    g = GIVEN["gravity"]
    push = np.diff(vz) + g * step
    touched = np.flatnonzero(np.abs(push) > 0.02 * g * step + 1e-4 * np.abs(vz[:-1]))
    touched = touched[: np.append(np.flatnonzero(np.diff(touched) > 3), len(touched))[0] + 1]
    before, after = touched[0], touched[-1] + 1
    came, left = (vz[k] ** 2 + 2 * g * (z[k] - GIVEN["radius"]) for k in (before, after))
    friction = (vx[before] - vx[after]) / (vz[after] - vz[before] + g * step * (after - before))
    return math.sqrt(max(left, 0.0) / came), float(friction)


def asked(script: str, given: dict[str, Any], python: str, folder: str) -> Iterator[tuple[float, float, float, float]]:
    """Yield steps per second, restitution asked, restitution and friction got; nothing if the engine is not there."""
    program = [python, "-W", "ignore"] if script.endswith(".py") else ["node"]
    done = subprocess.run(
        [*program, str(SCRIPTS / f"bounce_{script}"), json.dumps(GIVEN | given)],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    lines = [line.split() for line in done.stdout.splitlines()] if done.returncode == 0 else []
    rows = np.array([line for line in lines if len(line) == 5 and line[0][0].isdigit()], dtype=float).reshape(-1, 5)
    for rate in STEPS:
        for e in RESTITUTIONS:
            mine = rows[(np.abs(rows[:, 0] * rate - 1) < 1e-9) & (rows[:, 1] == e)]
            if len(mine):
                yield rate, e, *got(*mine.T[2:], 1 / rate)


def by_carom(e: float) -> tuple[float, float]:
    """Return restitution and friction of a run of carom."""
    ball = carom.SceneBall(
        radius=GIVEN["radius"], mass=1, position=(0, 0, GIVEN["height"]), velocity=(GIVEN["speed"], 0, 0)
    )
    floor = carom.Floor(restitution=e, friction=GIVEN["friction"])
    run = carom.simulate(carom.Scene(gravity=GIVEN["gravity"], floor=floor, balls=[ball], run=carom.Run(max_events=1)))
    fall, v = math.sqrt(2 * GIVEN["gravity"] * (GIVEN["height"] - GIVEN["radius"])), run.final.velocity[0]
    return v[2] / fall, (GIVEN["speed"] - v[0]) / (v[2] + fall)


def main(words: Sequence[str] | None = None) -> None:
    """A line an engine and step."""
    options = {"python": {"default": sys.executable}, "folder": {"default": str(ROOT)}}
    with campaign("engines_asked", __doc__, words, count=1, small=1, **options) as run:
        if not run.small:
            rows = [
                (name, *(f"{number:.5g}" for number in (rate, e, found, GIVEN["friction"], friction)))
                for name, (script, given) in ENGINES.items() if script.startswith(run.given.only)
                for rate, e, found, friction in asked(script, given, run.given.python, run.given.folder)
            ]  # fmt: skip
            names = {row[0] for row in rows}
            run.say("not here:", ", ".join(name for name in ENGINES if name not in names) or "none")
            if len(names) == len(ENGINES):
                with TABLE.open("w", encoding="utf-8", newline="") as file:
                    csv.writer(file, lineterminator="\n").writerows([HEADS, *rows])
        else:
            with TABLE.open(encoding="utf-8", newline="") as file:
                rows = [tuple(row) for row in csv.reader(file)][1:]
        carom_rows = [("carom", "any", f"{e}", *(f"{number:.5g}" for number in (found, 0.2, mu)))
                      for e in RESTITUTIONS for found, mu in [by_carom(e)]]  # fmt: skip
        run.say(f"asked: restitution {', '.join(map(str, RESTITUTIONS))}, friction {GIVEN['friction']}")
        for name, rate in dict.fromkeys((row[0], row[1]) for row in (*carom_rows, *rows)):
            mine = [row for row in (*carom_rows, *rows) if row[:2] == (name, rate)]
            restitutions, frictions = (", ".join(f"{float(row[k]):.4f}" for row in mine) for k in (3, 5))
            run.say(f"{name:24} {rate:>4}/s  restitution {restitutions}  friction {frictions}")


if __name__ == "__main__":
    main()
