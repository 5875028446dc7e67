"""How fast the laws answer: ratios of one run, on this machine, best of several.

    python benchmarks/arrays.py [balls]

Arrays: the final state of one contact and of the two-step, for N balls into arrays that exist, on 2 threads, against
``np.copyto`` of the same bytes in and out. Then one call for one state; ``import carom``; ``carom compare``; and, where
pooltool is installed, its cushion laws a resolve against the array laws a ball.
"""

from __future__ import annotations

import math
import subprocess
import sys
import time
from collections.abc import Callable

import numba
import numpy as np

import carom
from carom.laws.arrays import loop_for
from carom.laws.arrays import wall_law_rows as law_rows
from carom.laws.law import LIKE_SOLIDS
from carom.laws.maw import maw_contact
from carom.laws.stronge import stronge_contact

# pooltool's models and ours of the same physics
SAME = {"Han": "one contact, mu = 0.2", "Mathavan": "pressed, rolling", "Stronge": "stronge"}


def best(function: Callable[[], object], times: int) -> float:
    """The shortest of several runs, s: the one that other work on the machine disturbed least."""
    found = math.inf
    for _ in range(times):
        start = time.perf_counter()
        function()
        found = min(found, time.perf_counter() - start)
    return found


def alternating(first: Callable[[], object], second: Callable[[], object], times: int) -> tuple[float, float]:
    """The shortest run of each, taken in turn so that both meet the same machine."""
    pairs = [(best(first, 1), best(second, 1)) for _ in range(times)]
    return min(a for a, _ in pairs), min(b for _, b in pairs)


def process(*command: str) -> float:
    """The shortest of five runs of a process, s."""
    return best(lambda: subprocess.run([sys.executable, *command], check=True, capture_output=True), 5)


def arrays(count: int) -> dict[str, float]:
    """Print the array ratios; return ns a ball."""
    rng = np.random.default_rng(1)
    ball = carom.Ball()
    v = rng.normal(size=(count, 3))
    v[:, 0], v[:, 2] = -np.abs(v[:, 0]) - 0.01, 0
    w = np.stack([-v[:, 1] / ball.radius, v[:, 0] / ball.radius, rng.normal(size=count) / ball.radius], axis=-1)
    state = carom.State(v, w)
    out = carom.State(np.ones_like(v), np.ones_like(w))
    why = np.ones(count, dtype=np.int8)
    sliding = carom.State(v, np.ascontiguousarray(rng.normal(size=(count, 3)) / ball.radius))
    stick, slide = carom.Surface(0.85, math.inf), carom.Surface(0.85, 0.2)
    cloth, cushion = carom.Surface(0.5, 0.2), (math.sqrt(0.84), 0.0, -0.4)

    def copy() -> None:
        np.copyto(out.velocity, v)
        np.copyto(out.spin, w)

    few = max(count // 100, 1)
    some, some_out = sliding[:few], carom.State(np.ones((few, 3)), np.ones((few, 3)))
    found = {}
    print(f"{count:,} balls, {numba.get_num_threads()} threads; the copy moves {4 * v.nbytes / 1e9:.2f} GB")
    jobs: list[tuple[str, Callable[[], object]]] = [
        ("one contact, sticks", lambda: carom.impact_into(out, ball, state, surface=stick)),
        ("one contact, mu = 0.2", lambda: carom.impact_into(out, ball, state, surface=slide)),
        ("two-step, the paper's", lambda: carom.two_step_into(out, why, ball, state)),
        ("two-step, mu = 0.2, cloth", lambda: carom.two_step_into(out, why, ball, state, slide, cloth)),
        ("one contact, full result", lambda: carom.impact(ball, state, surface=slide)),
        ("two-step, full result", lambda: carom.two_step(ball, state, slide, cloth)),
    ]
    for name, job in jobs:
        job()  # compile, or load what was compiled
        a, b = alternating(job, copy, 3 if "full" in name else 9)
        found[name] = a / count * 1e9
        print(f"  {name:28s} {a / b:6.2f} x copyto   ({a / count * 1e9:6.2f} ns a ball; copy {b / count * 1e9:5.2f})")
    rolls = carom.State(v[:few], np.ascontiguousarray(w[:few]))
    for name, those in (("pressed", some), ("pressed, rolling", rolls)):
        job = lambda: carom.two_step_into(some_out, why, ball, those, carom.Surface(0.85, 0.14), cloth, cushion)  # noqa: B023, E731
        job()
        found[name] = best(job, 30) / few * 1e9
        print(f"  {'cushion nose, wall and floor at once' + name[7:]:45s} {found[name]:8.0f} ns a ball ({few:,} balls)")
    n, spread = np.array([[1.0, 0.0, 0.0]]), [np.ones((few, 3)), np.ones((few, 3))]
    for name in ("maw", "stronge"):
        kernel = {"maw": maw_contact, "stronge": stronge_contact}[name]
        loop = loop_for(law_rows(kernel), few)
        given = np.array([[ball.radius, ball.kappa, 0.85, 0.2, LIKE_SOLIDS]])
        job = lambda: loop(some.velocity, some.spin, n, given, *spread)  # noqa: B023, E731
        job()
        found[name] = best(job, 3) / few * 1e9
        print(f"  {name + ', tangential compliance':40s} {found[name]:8.0f} ns a ball ({few:,} balls)")
    return found


def scalars() -> None:
    """Print the single calls, as Python."""
    ball = carom.Ball()
    state, rough = carom.rolling(ball, (-1.0, 1.0)), carom.Surface(0.9, 0.2)
    for name, job in (
        ("impact", lambda: carom.impact(ball, state, (1, 0, 0), rough)),
        ("two_step", lambda: carom.two_step(ball, state)),
        ("conventional", lambda: carom.conventional(ball, state)),
        ("mirror", lambda: carom.mirror(ball, state)),
        ("no_slip", lambda: carom.no_slip(ball, state)),
    ):
        job()
        print(f"  {name:28s} {best(job, 3000) * 1e6:6.1f} us a call")


def starts() -> None:
    """Print how long things take to start, less what Python itself takes."""
    python = process("-c", "pass")
    print(f"  import carom                 {process('-c', 'import carom') - python:6.3f} s")
    everything = "import carom; carom.Ball, carom.State, carom.two_step, carom.LAWS"
    print(f"  import and name everything   {process('-c', everything) - python:6.3f} s (NumPy's part of it")
    print(f"    import numpy               {process('-c', 'import numpy') - python:6.3f} s)")
    print(f"  carom compare                {process('-m', 'carom', 'compare'):6.3f} s")


def pooltool(found: dict[str, float]) -> None:
    """Print pooltool's cushion laws against ours, where it is installed."""
    try:
        from peers import pooltool_resolves

        measured = list(pooltool_resolves(best))
    except ImportError as missing:
        print(f"  not measured: {missing}")
        return
    for name, seconds in measured:
        ours = next(key for word, key in SAME.items() if word in name)
        print(f"  {name:40s} {seconds * 1e6:7.1f} us a resolve, {seconds * 1e9 / found[ours]:6.0f} x {ours}")


if __name__ == "__main__":
    balls = int(float(sys.argv[1])) if len(sys.argv) > 1 else 10_000_000
    numbers = arrays(balls)
    print("one state, as Python")
    scalars()
    print("starts")
    starts()
    print("pooltool's cushion laws")
    pooltool(numbers)
