"""``carom doctor --warm``: bring every loop to machine code in advance, in several processes."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from carom.core.jit.workers import run_in_workers
from carom.errors import CaromError

if TYPE_CHECKING:
    from carom.bodies import State

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


def compile_all(workers: int | None = None, report: Callable[[str, str], None] | None = None) -> None:
    """Compile all loops that are not in the cache yet, in ``workers`` processes (default: one per core).

    ``report(job, error)`` is called after each of :data:`COMPILE_JOBS`; ``error`` is empty if it succeeded.
    """
    run_in_workers(COMPILE_JOBS, workers, report)


def warm_up() -> None:
    """Bring all loops to this processor's machine code, with a line for each job; CaromError where some fail."""
    from carom.cli.console import err

    console, begin, failed = err(), time.monotonic(), []

    def report(job: str, error: str) -> None:
        if error:
            failed.append(f"{job}: {error}")
        else:
            console.print(f"{time.monotonic() - begin:6.1f} s  {job}", markup=False)

    compile_all(report=report)
    if failed:
        raise CaromError(*failed)


# --- calls that compile ---------------------------------------------------------------------------------------------


def answer_many_rows() -> None:
    """Compile every wall law and the collision of balls, for arrays of states."""
    import numpy as np

    import carom

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

    import carom

    ball, surface, state = carom.Ball(1.0, 1.0), carom.Surface(0.8, 0.2), _states()
    carom.two_step(ball, state, wall=surface, floor=surface)
    out = carom.State(np.zeros((MANY, 3)), np.zeros((MANY, 3)))
    carom.two_step_into(out, np.zeros(MANY, np.int8), ball, state, surface, surface)


def _states() -> State:
    import numpy as np

    import carom

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

    import carom
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
    from carom.simulation.sensitivity.at_times import compiled_runs

    compiled_runs()


def measure_gas() -> None:
    """Compile the event loop of gases, random starts, and sums over all balls."""
    import carom
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
    import carom
    from carom.gas import Gas, Species

    gas = Gas([Species(carom.Ball(0.5, 1.0), 50)], (10.0,) * 3, contacts=carom.Surface(1, 0, -1), shear_rate=0.1)
    gas.run(10)


def measure_heat_current() -> None:
    """Compile the event loop of gases whose heat current is measured."""
    import carom
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

    import carom
    from carom.gas import Gas, Species, container

    discs = Species(carom.Disc(0.5, 1.0), 2)
    position = np.array([[4.0, 3.0], [6.0, 3.0]])
    Gas([discs], container(shape, **sizes), contacts=carom.Surface(1, math.inf, 1), position=position).run(10)


def fit_bounces() -> None:
    """Compile the likelihood of the fits, in the plane and on the table, with and without measured spins."""
    from carom.fitting import likelihood

    likelihood.compile_likelihood()
