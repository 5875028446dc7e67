"""NUMBA_DISABLE_JIT=1, or no Numba: what needs compiled code says so in one line, and what does not gives the same bits."""

from __future__ import annotations

import json
import os
import subprocess
import sys

import numpy as np
import pytest

import carom

# What a browser's Python lacks (docs/howto/explorer.md).
ABSENT = "import sys; sys.modules.update(dict.fromkeys(('numba', 'llvmlite', 'lzma')))"
REFUSED = """
import json, sys, carom
from carom import billiards, gas
from carom.tracks.contact_models import slide_then_roll
import numpy as np

wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0))
ball = carom.SceneBall(radius=0.03, mass=0.2, position=(1, 0, 0), velocity=(-1, 0, 0))
scene = carom.Scene(gravity=0, walls=[wall], balls=[ball], run=carom.Run(law="mirror", duration=2))
start = ((0.1, 0.2), (0.7, 0.4), 0.3)
jobs = {
    "simulate_many": lambda: carom.simulate_many(scene, velocity=[[-1, 0, 0], [-2, 0, 0]], events=3),
    "sensitivities": lambda: carom.sensitivities(scene, ["balls.0.velocity"], velocity=[[-1, 0, 0]]),
    "orbit": lambda: billiards.orbit(billiards.stadium(), start, 10),
    "lyapunov": lambda: billiards.lyapunov(billiards.stadium(), start, 10),
    "gas": lambda: gas.Gas([gas.Species(carom.Ball(0.5, 1.0), 2)], (9.0, 9.0, 9.0), contacts=carom.Surface(1, 0, -1)),
    "sweep": lambda: carom.sweep(carom.Space(scene, {"walls.0.restitution": [0.5, 1.0]}), ["final.time"]).run(),
    "motion": lambda: slide_then_roll(np.ones(2), np.ones(2), np.ones(3), 2.0, 0.1, 2 / 7),
}
said = {}
for name, job in jobs.items():
    try:
        job()
    except Exception as error:
        said[name] = f"{type(error).__name__}: {error}"
v = np.tile([-1.0, 0.5, 0.0], (500, 1))
v[:, 1] = np.linspace(-1, 1, 500)
many = carom.impact(carom.Ball(), carom.rolling(carom.Ball(), v), surface=carom.Surface(0.8, 0.2))
one = carom.simulate(scene)
json.dump([said, many.after.velocity.tolist(), one.final[0].velocity.tolist()], sys.stdout)
"""


@pytest.mark.parametrize(
    ("first", "off", "expected", "advice"),
    [
        ("", "1", "NUMBA_DISABLE_JIT: expected 0, or no such variable", "got 1; unset it"),
        (ABSENT, "0", "numba: expected to be installed", "and is not; install it"),
    ],
    ids=["off", "absent"],
)
def test_what_needs_the_compiler_says_so(first: str, off: str, expected: str, advice: str) -> None:
    """It was an AttributeError: functions without py_func."""
    environment = {**os.environ, "NUMBA_DISABLE_JIT": off}
    done = subprocess.run(
        [sys.executable, "-c", first + REFUSED], capture_output=True, text=True, env=environment, check=True
    )
    said, many, one = json.loads(done.stdout)
    assert set(said) == {"simulate_many", "sensitivities", "orbit", "lyapunov", "gas", "sweep", "motion"}
    for text in said.values():
        assert text.startswith(f"CaromError: {expected}")
        assert advice in text
    v = np.tile([-1.0, 0.5, 0.0], (500, 1))
    v[:, 1] = np.linspace(-1, 1, 500)
    compiled = carom.impact(carom.Ball(), carom.rolling(carom.Ball(), v), surface=carom.Surface(0.8, 0.2))
    assert many == compiled.after.velocity.tolist()
    assert one == [1, 0, 0]
