"""How fast the laws answer: ratios of one run, on this machine, best of several.

    python benchmarks/arrays.py [balls]

Arrays: the final state of one contact and of the two-step, for N balls into arrays that exist, on 2 threads, against
``np.copyto`` of the same bytes in and out. Then one call for one state; ``import carom``; ``carom compare``; and, where
pooltool is installed, its cushion laws a resolve against the array laws a ball.
"""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Callable

import numba
import numpy as np
from rows import REPEATS, SMALL, alone, compare, paired, process, report, run_script, seconds, usually

import carom
from carom.laws.arrays import loop_for
from carom.laws.arrays import wall_law_rows as law_rows
from carom.laws.law import LIKE_SOLIDS
from carom.laws.maw import maw_contact
from carom.laws.stronge import stronge_contact

NUMPY = f"NumPy {np.__version__}"
# Half the bytes a ball that a full result reads and writes. An impact reads velocity and spin, and writes both, an
# impulse and the required friction; the two-step law reads and writes so for the wall and for the floor, and the
# flight and the rolling state besides.
IMPACT_BYTES = (6 + 9 + 1) * 8 // 2
TWO_STEP_BYTES = (6 + 12 + 1 + 6 + 3 + 12 + 1 + 6) * 8 // 2


def best(function: Callable[[], object], times: int) -> float:
    """The shortest of several runs, s: the one that other work on the machine disturbed least."""
    return min(seconds(function) for _ in range(usually(times, 1)))


def python(*command: str) -> float:
    """The shortest of five runs of a process, s."""
    return min(process([sys.executable, *command], os.environ)[0] for _ in range(REPEATS))


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
    some, some_out, some_why = sliding[:few], carom.State(np.ones((few, 3)), np.ones((few, 3))), why[:few]
    found = {}
    print(f"{count:,} balls, {numba.get_num_threads()} threads; the copy moves {4 * v.nbytes / 1e9:.2f} GB")
    jobs: list[tuple[str, Callable[[], object]]] = [
        ("one contact, sticks", lambda: carom.impact_into(out, ball, state, surface=stick)),
        ("one contact, mu = 0.2", lambda: carom.impact_into(out, ball, state, surface=slide)),
        ("two-step, the paper's", lambda: carom.two_step_into(out, why, ball, state)),
        ("two-step, mu = 0.2, cloth", lambda: carom.two_step_into(out, why, ball, state, slide, cloth)),
    ]
    for name, job in jobs:
        row = compare(f"{name}, final state", job, copy, f"np.copyto, {NUMPY}", count=count, calls=3, wanted=1.1)
        found[name] = report(row).nanoseconds
    # a full result is in new memory, as a copy of half the bytes that it reads and writes
    full: list[tuple[str, int, float, Callable[[], object]]] = [
        ("one contact, full result", IMPACT_BYTES, 3, lambda: carom.impact(ball, state, surface=slide)),
        ("two-step, full result", TWO_STEP_BYTES, 6, lambda: carom.two_step(ball, state, slide, cloth)),
    ]
    for name, bytes_a_ball, wanted, job in full:
        source = np.ones(count * bytes_a_ball // 8)
        report(compare(name, job, source.copy, f"np.copy, {NUMPY}", count=count, wanted=wanted))
    rolls = carom.State(v[:few], np.ascontiguousarray(w[:few]))
    for name, those in (("pressed", some), ("pressed, rolling", rolls)):
        job = lambda: carom.two_step_into(some_out, some_why, ball, those, carom.Surface(0.85, 0.14), cloth, cushion)  # noqa: B023, E731
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
        report(alone(f"one state as Python: {name}", job, calls=1000, wanted=25_000))
    rests, hits = carom.State((0.0, 0.0, 0.0), (0.0, 0.0, 0.0)), carom.State((1.0, 0.1, 0.0), (0.0, 0.0, 3.0))
    cloth, nose = carom.Surface(0.5, 0.2), (math.sqrt(0.84), 0.0, -0.4)
    rows = carom.rolling(ball, np.tile([-1.0, 0.5, 0.0], (1000, 1)))
    out, why = carom.State(np.zeros((1, 3)), np.zeros((1, 3))), np.zeros(1, np.int8)
    for name, wanted, calls, job in (
        ("collide", 15e3, 1000, lambda: carom.collide(ball, hits, ball, rests, surface=rough)),
        ("pressed on the floor", 60e3, 1000, lambda: carom.two_step(ball, state, rough, cloth, nose)),
        ("impact_into, 1 row", 50e3, 1000, lambda: carom.impact_into(out, ball, rows[:1], surface=rough)),
        ("two_step_into, 1 pressed row", 50e3, 100, lambda: carom.two_step_into(out, why, ball, rows[:1], rough, cloth, nose)),
        ("two_step, 100 states", 2e6, 100, lambda: carom.two_step(ball, rows[:100])),
        ("two_step, 1000 states", 1e6, 100, lambda: carom.two_step(ball, rows)),
    ):  # fmt: skip
        for _ in range(usually(1000, 1) if "pressed" in name else 1):
            job()  # (Python finds that it takes long)
        report(alone(name, job, calls=calls, wanted=wanted))


def starts() -> None:
    """Print how long things take to start, less what Python itself takes."""
    bare = python("-c", "pass")
    print(f"  import carom                 {python('-c', 'import carom') - bare:6.3f} s")
    everything = "import carom; carom.Ball, carom.State, carom.two_step, carom.LAWS"
    print(f"  import and name everything   {python('-c', everything) - bare:6.3f} s (NumPy's part of it")
    print(f"    import numpy               {python('-c', 'import numpy') - bare:6.3f} s)")
    print(f"  carom compare                {python('-m', 'carom', 'compare'):6.3f} s")


def pooltool(few: int = 100_000) -> None:
    """Measure pooltool's cushion laws against ours, where it is installed."""
    try:
        from peers import pooltool_resolves

        measured = list(pooltool_resolves())
    except ImportError as missing:
        print(f"  not measured: {missing}")
        return
    works = physics_of_pooltool(few)
    for name, resolve in measured:
        work, ours = next(works[word] for word in works if word in name)
        ours(), resolve()
        pairs = [(best(ours, 3) / few, best(resolve, 1000)) for _ in range(REPEATS)]
        wanted = 0.01 if "Mathavan" in name else math.nan
        report(paired(work, pairs, name, count=1, unit="ball", wanted=wanted))


def physics_of_pooltool(few: int) -> dict[str, tuple[str, Callable[[], object]]]:
    """Return, by a word of pooltool's name for it, our works of the same physics on ``few`` rolling balls."""
    ball, rng = carom.Ball(), np.random.default_rng(1)
    v = rng.normal(size=(few, 3))
    v[:, 0], v[:, 2] = -np.abs(v[:, 0]) - 0.01, 0
    w = np.stack([-v[:, 1] / ball.radius, v[:, 0] / ball.radius, rng.normal(size=few) / ball.radius], axis=-1)
    state, out, why = carom.State(v, w), carom.State(np.ones_like(v), np.ones_like(w)), np.ones(few, dtype=np.int8)
    wall, cloth, cushion = carom.Surface(0.85, 0.14), carom.Surface(0.5, 0.2), (math.sqrt(0.84), 0.0, -0.4)
    loop, n, given = loop_for(law_rows(stronge_contact), few), np.array([[1.0, 0.0, 0.0]]), np.empty((1, 5))
    given[0] = ball.radius, ball.kappa, 0.85, 0.2, LIKE_SOLIDS
    return {
        "Han": ("one contact, in arrays", lambda: carom.impact_into(out, ball, state, surface=wall)),
        "Mathavan": (
            "wall and floor at once, rolling, in arrays",
            lambda: carom.two_step_into(out, why, ball, state, wall, cloth, cushion),
        ),
        "Stronge": (
            "Stronge's two springs, in arrays",
            lambda: loop(state.velocity, state.spin, n, given, out.velocity, out.spin),
        ),
    }


def main() -> None:
    """Print all figures."""
    arrays(int(float(sys.argv[1])) if len(sys.argv) > 1 else usually(10_000_000, 2_000))
    print("one state, as Python")
    scalars()
    if not SMALL:
        print("starts")
        starts()
    print("pooltool's cushion laws")
    pooltool()


if __name__ == "__main__":
    run_script(main)
