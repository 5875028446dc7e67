"""Sweeps on a GPU beside the same ones on the cores, as a program of its own: numba-cuda's simulator is chosen when it is imported.

NUMBA_ENABLE_CUDASIM=1 python -m reference.sweeps_on_gpu
"""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Iterator
from hashlib import sha256
from importlib.metadata import version
from typing import Any

import numpy as np
from reference.exploring import tried
from reference.sweep_scenes import table_scene

import carom
from carom import sweeps
from carom.core.jit import cuda
from carom.core.jit.compile import ArrayOf, array_of, cache_folder, signature
from carom.core.jit.kernel import prange, vector
from carom.laws.arrays import wall_law_rows
from carom.laws.contact import contact_rows
from carom.laws.mirror import mirror_kernel
from carom.laws.two_step import first_rows
from carom.simulation.motion import write_vector
from carom.simulation.records import BALLS
from carom.simulation.run_many import LOOP, many_on_gpu

# Instructions of NVIDIA's assembly (PTX).
ROUNDED, CONTRACTIBLE = [r"(?:mul|add)\.rn\.f64"], [r"(?:mul|add)\.f64"]
# (bytes of the stack, ld.local, are truth values that functions return)
BYTEWISE = [r"ld(?:\.global)?\.[us]8"]


def spaces() -> Iterator[tuple[str, carom.Space, list[str]]]:
    """Yield small sweeps: every kind of event, walls of several shapes, several laws; impacts."""
    keep = [
        "final.position", "final.velocity", "final.spin", "final.phase", "events.count", "events.wall.count", "events.ball.count",
        "events.wall.1.position", "events.ball.0.time", "events.floor.count",
    ]  # fmt: skip
    speeds = carom.polar([0.8, 2.5], 34.0)
    numbers = {"balls.0.velocity": speeds, "walls.*.friction": [0.12, 0.25]}
    yield "a table", carom.Space(table_scene(duration=1.2), numbers), keep
    yield (
        "laws",
        carom.Space(
            table_scene(duration=0.8),
            {"balls.0.velocity": carom.polar(2.5, 21.0), "run.law": ["mirror", "contact", "no-slip"]},
        ),
        keep,
    )
    ball = carom.SceneBall(
        radius=0.03, mass=0.2, position=(0.4, 0.1, 0.3), velocity=(1.0, 0.4, 0.2), spin=(3.0, -20.0, 8.0)
    )
    walls = [
        carom.scene.Cylinder(point=(0, 0, 0), axis=(0, 0, 1), radius=0.8, inside=True, restitution=0.9, friction=0.2),
        carom.scene.Plane(point=(0, 0, 1.2), normal=(0, 0, -1), restitution=0.8, friction=0.3),
    ]
    flight = carom.Scene(
        floor=carom.Floor(restitution=0.6, friction=0.2),
        walls=walls,
        balls=[ball],
        run=carom.Run(duration=1.0, max_events=60),
    )
    yield (
        "a flight",
        carom.Space(flight, {"balls.0.velocity.z": [0.0, 3.0], "floor.restitution": [0.4]}),
        keep,
    )
    white = carom.SceneBall(radius=0.028575, mass=0.17, position=(0.3, 0.2), velocity=(1.2, 0.5), rolling=True)
    table = carom.Scene(
        floor=carom.Floor(restitution=0.5, friction=0.2, rolling_resistance=0.01),
        walls=[{"shape": "table", "preset": "pool-9ft"}],
        balls=[white],
        run=carom.Run(duration=0.8),
    )
    yield (
        "noses and pockets",
        carom.Space(table, {"balls.0.velocity": carom.polar(2.5, [10.0, 45.0])}),
        [*keep, "final.pocket"],
    )
    cloth = {  # (without any of them: the other tables)
        "floor.rolling_drag": tried([0.01], [0.0, 0.01]),
        "floor.spin_damping": tried([0.3], [0.0, 0.3]),
        "walls.*.yield_time": tried([0.003], [0.0, 0.003]),
    }
    yield "the cloth", carom.Space(table_scene(duration=0.6), cloth), keep
    # (balls that roll down a slope are followed to their end to see what they touch: half a minute in Python; these stop soon)
    slope = carom.replaced(table_scene(duration=0.6), {"floor.rolling_resistance": tried(0.2, 0.01)})
    yield "a slope", carom.Space(slope, {"floor.slope": [[0.0, 0.0], [0.02, -0.01]]}), keep
    case = sweeps.ImpactCase(restitution=0.85, friction=0.2)
    outcomes = ["reflection_angle", "after_wall.velocity", "final.spin", "energy_ratio", "required_friction.wall"]
    laws = ["two-step", "mirror", "contact", "no-slip", "maw"]
    yield (
        "impacts",
        carom.Space(
            case,
            {"law": laws, "angle": tried([15.0, 70.0], [15.0, 45.0, 70.0]), "spin_z": tried([-30.0], [-30.0, 30.0])},
        ),
        outcomes,
    )


def compare() -> None:
    """Compare all of them, bit by bit; exit code 1 where any differs."""
    differ = 0
    for name, space, keep in spaces():
        cores, gpu = (carom.sweep(space, keep).run(on=place) for place in ("cores", "cuda"))
        pairs = {one: (cores[one].values, gpu[one].values) for one in [*keep, "failed"]}
        worst = [one for one, (a, b) in pairs.items() if not np.array_equal(a, b, equal_nan=a.dtype.kind == "f")]
        different = f"different: {', '.join(worst)}" if worst else "the same bits"
        there = int((cores["failed"] == 0).sum())
        sys.stdout.write(f"{name}: {space.size} points, {there} with an outcome: {different}\n")
        differ += bool(worst)
    sys.exit(differ > 0)


def moved(balls: Any, t: float) -> None:
    """Move records by their velocities and accelerations: their numbers are read and written, and products rounded."""
    for n in prange(balls.shape[0]):
        ball = balls[n]
        x, v, acc = vector(ball.x), vector(ball.v), vector(ball.acc)
        write_vector(
            ball.x,
            (
                x[0] + t * (v[0] + t * acc[0]),
                x[1] + t * (v[1] + t * acc[1]),
                x[2] + t * (v[2] + t * acc[2]),
            ),
        )


def assemble() -> None:
    """Write of each loop what the linker gets, how often its assembly rounds an operation, may fuse two, reads a byte; its MB."""
    rows, vectors, numbers = [array_of(float, 2)] * 4, array_of(float, 2), array_of(float)
    codes = array_of(np.dtype(np.int8))
    loops: list[tuple[cuda.CudaLoop, list[Any]]] = [
        (cuda.CudaLoop(wall_law_rows(mirror_kernel)), [*rows, vectors, vectors]),
        (cuda.CudaLoop(contact_rows), [*rows, vectors, vectors, vectors, numbers, codes]),
        (cuda.CudaLoop(first_rows), [*rows, bool, *[vectors] * 4, numbers, codes]),
        (cuda.CudaLoop(moved), [array_of(BALLS), float]),
        (many_on_gpu(), list(LOOP[1:])),
    ]
    cuda.why_no_gpu()
    for loop, taken in tried([loops[1], loops[3]], loops):
        text = assembly(loop, taken)
        counts = [sum(len(re.findall(one, text)) for one in ones) for ones in (ROUNDED, CONTRACTIBLE, BYTEWISE)]
        # (what the linker is to optimise is compiled again by it, and products and sums are fused then)
        handed = "LLVM" if loop._kernel.targetoptions["lto"] else "assembly"
        sys.stdout.write(f"{loop.name}: {handed} {' '.join(map(str, counts))} {len(text) / 1e6:.2f}\n")


def assembly(loop: cuda.CudaLoop, taken: list[Any]) -> str:
    """Return a loop's assembly, kept as compiled loops are (half a minute): under the hash of carom's sources, and of the rest."""
    types = signature(None, *(aligned(one) for one in taken))
    known = f"{types} {[(name, version(name)) for name in ('numba-cuda', 'nvidia-nvvm', 'llvmlite')]}"
    place = cache_folder() / "cuda" / f"{loop.name}-{sha256(known.encode()).hexdigest()[:16]}.ptx"
    if not place.is_file():
        text = cuda.ptx(loop, types)
        place.parent.mkdir(parents=True, exist_ok=True)
        part = place.with_suffix(f".{os.getpid()}")
        part.write_text(text, encoding="utf-8")
        part.replace(place)
    return place.read_text(encoding="utf-8")


def aligned(taken: Any) -> Any:
    """Return an array's description as :func:`carom.core.jit.cuda.on_device` hands it over."""
    item = taken.item if isinstance(taken, ArrayOf) else None
    return taken._replace(item=cuda.aligned(item)) if isinstance(item, np.dtype) else taken


if __name__ == "__main__":
    {"compare": compare, "assemble": assemble}[sys.argv[1]]()
