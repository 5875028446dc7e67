"""``carom doctor``: what this installation has: versions, optional libraries, the cache of compiled code, cores."""

from __future__ import annotations

import contextlib
import importlib.metadata
import math
import platform
import subprocess
import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

import carom
from carom.cli.options import shared
from carom.cli.streams import say_json
from carom.core.jit.threads import run_in_workers
from carom.errors import CaromError

if TYPE_CHECKING:
    from carom.bodies import State

BASE = ("numpy", "numba", "llvmlite", "pydantic", "pint", "rich", "typer", "lazy_loader")
# Names of packages where they differ from the names of their modules.
PACKAGES = {"imageio_ffmpeg": "imageio-ffmpeg"}


def doctor(
    warm: Annotated[
        bool,
        typer.Option(
            "--warm",
            help="Bring all loops to this processor's machine code first: it is cached, later runs only load it.",
        ),
    ] = False,
    as_json: Annotated[bool, shared("json")] = False,
) -> None:
    """Say what this installation has: versions, optional libraries, the cache of compiled code, cores."""
    if warm:
        warm_up()
    found = report()
    if as_json:
        say_json(found)
        return
    from carom.cli.console import out
    from carom.files import install_command

    console = out()
    cache = found["cache"]
    ready = "ready" if cache["engine_ready"] else "the event loop is compiled when it is first needed"
    rows = {
        "carom": found["carom"] + (f", commit {found['commit']}" if found["commit"] else ""),
        "Python": f"{found['python']} on {found['platform']}", **found["libraries"],
        **{name: one["version"] or f"not installed (extra {one['extra']})" for name, one in found["optional"].items()},
        "loops": found["loops"],
        "cache": f"{cache['folder']}: {cache['megabytes']:.1f} MB, {ready}",
        "versions": f"of compiled code: {cache['versions']}, {cache['all_megabytes']:.1f} MB in all",
        "cores": f"{found['cores']}, of which compiled loops use {found['threads']} at once",
    }  # fmt: skip
    console.facts(rows.items())
    if any(about["version"] is None for about in found["optional"].values()):
        console.print("An extra, here plot, is installed by", soft_wrap=True)
        # (whole, to be copied, however narrow the terminal)
        console.print(install_command("plot"), no_wrap=True, overflow="ignore", crop=False)


def report() -> dict[str, Any]:
    """Return the versions and features of the installation."""
    from carom.core.jit.cache import cache_base, cache_folder, version_folders
    from carom.core.jit.native import describe_loops
    from carom.core.jit.threads import core_count, thread_count
    from carom.files import OPTIONAL
    from carom.simulation.loop import compiled_before

    folder = cache_folder()
    sizes = {one: _megabytes(one) for one in version_folders(cache_base())}
    return {
        "carom": carom.__version__,
        "commit": commit(),
        "python": platform.python_version(),
        "platform": platform.platform(),
        "libraries": {name: _version(name) for name in BASE},
        "optional": {
            name: {"version": _version(name), "extra": extra} for name, (_prose, extra) in sorted(OPTIONAL.items())
        },
        "loops": describe_loops(),
        "cache": {
            "folder": str(folder),
            "megabytes": sizes.get(folder, 0.0),
            "engine_ready": compiled_before(),
            "versions": len(sizes),
            "all_megabytes": sum(sizes.values()),
        },
        "cores": core_count(),
        "threads": thread_count(),
    }


def _megabytes(folder: Path) -> float:
    return sum(path.stat().st_size for path in folder.rglob("*") if path.is_file()) / 1e6


def _version(name: str) -> str | None:
    try:
        return importlib.metadata.version(PACKAGES.get(name, name))
    except importlib.metadata.PackageNotFoundError:
        return None


def commit() -> str | None:
    """Return the commit that carom is run from, of a clone; None for an installed package."""
    root = Path(carom.__file__).parents[2]
    if not (root / ".git").exists():
        return None
    asked = ["git", "-C", str(root), "rev-parse", "--short=9", "HEAD"]
    with contextlib.suppress(OSError):
        return subprocess.run(asked, capture_output=True, text=True, check=False).stdout.strip() or None
    return None


# ----------------------------------------------------------------------------------------------------
# ``carom doctor --warm``: bring every loop to machine code in advance, in several processes.


# Compilation jobs, as module:function, the longest first. Loops without a fixed signature are compiled by calling them with
# typical arguments, in the functions below.
COMPILE_JOBS = (
    "carom.simulation.contact_kinds:compiled_joint_impact",
    "carom.simulation.loop:compiled_engine",
    "carom.simulation.sensitivity.follow:compiled_follow",
    f"{__name__}:measure_gas",
    f"{__name__}:measure_sheared_gas",
    f"{__name__}:measure_heat_current",
    f"{__name__}:measure_gas_in_curve",
    f"{__name__}:follow_called_laws",
    f"{__name__}:measure_gas_in_container",
    f"{__name__}:answer_many_rows",
    "carom.billiards.stability:compiled_tangent_loop",
    f"{__name__}:settle_many_rows",
    "carom.billiards.loop:compiled_many",
    f"{__name__}:fit_bounces",
    f"{__name__}:load_called_laws",
    "carom.simulation.simulate:compiled_many",
    "carom.simulation.sensitivity.margins:compiled_least_gaps",
    f"{__name__}:draw_shots",
    f"{__name__}:follow_many_runs",
    f"{__name__}:draw_numbers",
)
MANY = 500  # rows, enough for the compiled loop to be used


def warm_up() -> None:
    """Bring all loops to this processor's machine code, with a line for each job; CaromError where some fail."""
    from carom.cli.console import err

    console, begin, failed = err(), time.monotonic(), []

    def report(job: str, error: str) -> None:
        if error:
            failed.append(f"{job}: {error}")
        else:
            console.print(f"{time.monotonic() - begin:6.1f} s  {job}", markup=False)

    run_in_workers(COMPILE_JOBS, report=report)
    if failed:
        raise CaromError(*failed)


# --- calls that compile ---------------------------------------------------------------------------------------------


def answer_many_rows() -> None:
    """Compile every wall law and the collision of balls, for arrays of states."""
    import numpy as np

    ball, surface, state = carom.Ball(1.0, 1.0), carom.Surface(0.8, 0.2), _states()
    for law in carom.LAWS.values():
        if law.name != "two-step":
            law.answer(carom.Meeting(ball, state, wall=surface))
    out = carom.State(np.zeros((MANY, 3)), np.zeros((MANY, 3)))
    carom.impact(ball, state, surface=surface)
    carom.impact_into(out, ball, state, surface=surface)
    other = carom.State(-state.velocity, state.spin)
    for law in ("contact", "maw", "stronge"):
        carom.collide(ball, state, ball, other, (1.0, 0.0, 0.0), surface, law)


def settle_many_rows() -> None:
    """Compile the two-step law, for arrays of states."""
    import numpy as np

    ball, surface, state = carom.Ball(1.0, 1.0), carom.Surface(0.8, 0.2), _states()
    carom.two_step(ball, state, wall=surface, floor=surface)
    out = carom.State(np.zeros((MANY, 3)), np.zeros((MANY, 3)))
    carom.two_step_into(out, np.zeros(MANY, np.int8), ball, state, surface, surface)


def _states() -> State:
    import numpy as np

    return carom.rolling(carom.Ball(1.0, 1.0), velocity=np.tile([-1.0, 0.5, 0.0], (MANY, 1)))


def load_called_laws() -> None:
    """Compile the laws that loops call by their address, the rims of cylinders, and smooth curves."""
    from carom.core.geometry.circles import rim_address
    from carom.core.geometry.curve_arcs import arc_address
    from carom.laws.callbacks import user_address
    from carom.laws.law import CALLED_WALL
    from carom.laws.registry import laws

    rim_address()
    arc_address()
    for law in laws().values():
        if law.response == CALLED_WALL and law.kernel is not None:
            user_address(law.kernel)


def follow_called_laws() -> None:
    """Compile the laws that loops call by their address, with derivatives."""
    from carom.laws.law import CALLED_WALL
    from carom.laws.registry import laws
    from carom.simulation.sensitivity.follow import dual_users

    dual_users(law for law in laws().values() if law.response == CALLED_WALL)


def draw_shots() -> None:
    """Compile the states of a run between its events, and many runs at once."""
    import numpy as np

    from carom.simulation.motion import FEW_BEFORE_COMPILING

    ball = carom.SceneBall(radius=0.03, mass=0.2, position=(1.0, 0.0), velocity=(-1.0, 0.0, 0.0))
    wall = carom.scene.Plane(point=(0.0, 0.0, 0.0), normal=(1.0, 0.0, 0.0))
    run = carom.Run(duration=2.0, law="no-slip")
    scene = carom.Scene(floor=carom.Floor(friction=0.2), walls=(wall,), balls=(ball,), run=run)
    found = carom.simulate(scene)
    times = np.linspace(0, found.end, FEW_BEFORE_COMPILING)
    found.at(times)
    found.orientation(times)
    carom.simulate_many(scene, velocity=np.array([[[-1.0, 0.0, 0.0]], [[-2.0, 0.0, 0.0]]]))
    carom.simulate_many(scene, position=np.array([[[1.0, 0.0, 0.03]], [[1.1, 0.0, 0.03]]]))


def draw_numbers() -> None:
    """Compile the random numbers of sweeps, and the motions on a table and in flight that fits of films follow."""
    import numpy as np

    from carom.sweeps.draws import normal_draws, uniform_draws
    from carom.tracks.contact_models import COUNT, contact_path, contact_slopes, hop_slide_roll, slide_then_roll
    from carom.tracks.flights import flight_path

    uniform_draws(1, 1, 0, 2, 0.0, 1.0)
    normal_draws(1, 1, 0, 2, 0.0, 1.0)
    times = np.linspace(0.0, 1.0, 3)
    slide_then_roll(np.ones(2), np.ones(2), times, 2.0, 0.1, 2 / 7)
    hop_slide_roll(np.ones(2), np.ones(2), 0.1, times, 2.0, 0.1, 2 / 7)
    flight_path(np.ones(2), np.ones(2), 0.1, times)
    contact_path(np.ones(COUNT), 0.0, times, 2 / 7)
    contact_slopes(np.ones(COUNT), 0.0, times, 2 / 7)


def follow_many_runs() -> None:
    """Compile the loop over runs whose states are kept, with their derivatives: of many starts, and of whole tracks."""
    from carom.simulation.sensitivity.sensitivity import compiled_runs

    compiled_runs()


def measure_gas() -> None:
    """Compile the event loop of gases, random starts, and sums over all balls."""
    from carom.gas import Gas, Measures, Species, scattered

    side = (10.0, 10.0, 10.0)
    gas = Gas([Species(carom.Ball(0.5, 1.0), 50)], side, contacts=carom.Surface(1, math.inf, 1))
    measures = Measures(gas)
    gas.run(10)
    Gas.restore(gas.state())
    measures.sample(gas)
    scattered([0.5] * 50, side)


def measure_sheared_gas() -> None:
    """Compile the event loop of sheared gases."""
    from carom.gas import Gas, Species

    gas = Gas([Species(carom.Ball(0.5, 1.0), 50)], (10.0,) * 3, contacts=carom.Surface(1, 0, -1), shear_rate=0.1)
    gas.run(10)


def measure_heat_current() -> None:
    """Compile the event loop of gases whose heat current is measured."""
    from carom.gas import Gas, Species

    gas = Gas([Species(carom.Ball(0.5, 1.0), 50)], (10.0,) * 3, contacts=carom.Surface(1, 0, -1))
    gas.measure_heat()
    gas.run(10)


def measure_gas_in_container() -> None:
    """Compile the event loop of gases whose walls are not all fixed planes, random starts there, and checks of given places."""
    _run_in("circle", radius=5.0)


def measure_gas_in_curve() -> None:
    """Compile the event loop of gases in smooth curves."""
    _run_in("limacon", eps=0.1, radius=5.0)


def _run_in(shape: str, **sizes: Any) -> None:
    import numpy as np

    from carom.gas import Gas, Species, container

    discs = Species(carom.Disc(0.5, 1.0), 2)
    position = np.array([[4.0, 3.0], [6.0, 3.0]])
    Gas([discs], container(shape, **sizes), contacts=carom.Surface(1, math.inf, 1), position=position).run(10)


def fit_bounces() -> None:
    """Compile the likelihood of the fits, in the plane and on the table, with and without measured spins."""
    from carom.fitting import likelihood

    likelihood.compile_likelihood()
