"""A run of carom's as a System that pooltool, 0.6.0 or main, shows and saves."""

from __future__ import annotations

import math
import warnings
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError, FaultList, checked_number, require_type
from carom.interop.pooltool.physics import has_flights, require_pooltool
from carom.scene.restitution import Constant
from carom.scene.scene import Scene
from carom.scene.shapes.table import Table
from carom.simulation.trajectory import Trajectory

if TYPE_CHECKING:
    from pooltool import System

Array = NDArray[np.float64]
# pooltool's number of each phase; 0.6.0 has none for a ball in the air
MOTIONS = {
    "rest": 0,
    "held": 0,
    "left": 0,
    "pivoting": 1,
    "sliding": 2,
    "flight": 2,
    "bouncing": 2,
    "rolling": 3,
    "pocketed": 4,
}
FLYING = 5  # in pooltool's main branch
LEAST = 1e-12  # pooltool refuses frictions of 0


def to_system(run: Trajectory, dt: float = 0.01) -> System:
    """Turn a run into a System, for ``pooltool.show`` and ``System.save``, with hops: pooltool draws the heights that it is given.

    Parameters
    ----------
    run : Trajectory
        Of a scene with one wall of shape "table" and balls of one kind, as pooltool has them.
    dt : float
        Time between the recorded states, s.

    Returns
    -------
    pooltool.System
        In pooltool's frame (a corner of the table at the origin, the longer side along y), with the balls' histories. Its
        list of events has only the start and the end. Cushions with surfaces of their own are in the run, and not in the
        System's numbers, which a warning says.

    Raises
    ------
    CaromError
        For other scenes, and without pooltool 0.6 (MissingLibraryError).

    Examples
    --------
    >>> import carom.interop.pooltool
    >>> run = carom.simulate(carom.load_scene("docs/scenes/three_balls.toml"))        # doctest: +SKIP
    >>> system = carom.interop.pooltool.to_system(run)                                # doctest: +SKIP
    """
    require_type("to_system", "run", run, Trajectory)
    faults = FaultList("to_system")
    dt = checked_number(faults, "dt", dt, "a time in s, > 0", lambda x: x > 0)
    faults.raise_if_any()
    table = _table(run.scene)
    pt = require_pooltool("to_system")
    from pooltool.events.factory import null_event
    from pooltool.objects.ball.datatypes import BallHistory

    turn, corner = _frame(table)
    shown = _pooltool_table(pt, table, turn)
    names = run.scene.ball_names
    events = np.unique([0.0, *run.events.t, run.end])
    grid = np.unique([*np.arange(0.0, run.end, dt), run.end])
    histories = [
        [BallHistory.from_vectorization(one) for one in _states(run, times, turn, corner)] for times in (events, grid)
    ]
    balls = {}
    for i, name in enumerate(names):
        ball = pt.Ball.create(name, xy=(0.0, 0.0), **_params(run.scene))
        ball.history, ball.history_cts = histories[0][i], histories[1][i]
        ball.state = ball.history[-1].copy()
        balls[name] = ball
    speed = np.linalg.norm(run.start.velocity, axis=-1)
    first = int(np.argmax(speed))
    x, y, _z = turn @ run.start.velocity[first]
    cue = pt.Cue(cue_ball_id=names[first], V0=float(speed[first]), phi=math.degrees(math.atan2(y, x)) % 360)
    return pt.System(cue=cue, table=shown, balls=balls, t=run.end, events=[null_event(0.0), null_event(run.end)])


def _table(scene: Scene) -> Table:
    """Return the scene's table, with a warning where its cushions differ. CaromError for what pooltool cannot show."""
    if len(scene.walls) != 1 or not isinstance(scene.walls[0], Table):
        raise CaromError(
            f"to_system: run: expected a scene with one wall, of shape 'table', got {scene.describe()}; pooltool shows tables only"
        )
    if len({(ball.radius, ball.mass) for ball in scene.balls}) > 1:
        raise CaromError("to_system: run: expected balls of one radius and mass, got several; pooltool has no others")
    table = scene.walls[0]
    if (table.corner_pockets is None) != (table.side_pockets is None):
        raise CaromError(
            "to_system: run: expected a table with six pockets or none, got one with some; pooltool has no others"
        )
    if own := table.own_surfaces:
        said = f"to_system: run: {', '.join(own)} of the table are left out of the System's numbers, and the run is shown as it is"
        warnings.warn(f"{said}; pooltool has one surface for all cushions", stacklevel=3)
    return table


def _frame(table: Table) -> tuple[Array, Array]:
    """Return the rotation that brings the longer side along y, and the corner that comes to the origin."""
    turn = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]) if table.length > table.width else np.eye(3)
    half = np.abs(turn @ (table.length / 2, table.width / 2, 0.0))
    return turn, turn @ (*table.center, 0.0) - half


def _pooltool_table(pt: Any, table: Table, turn: Array) -> Any:
    from pooltool.objects.table.specs import BilliardTableSpecs, PocketTableSpecs

    short, long, _z = np.abs(turn @ (table.length, table.width, 0.0)).tolist()
    nose = {} if table.nose_height is None else {"cushion_height": table.nose_height}
    corner, side = table.corner_pockets, table.side_pockets
    if corner is None or side is None:
        return pt.Table.from_table_specs(BilliardTableSpecs(l=long, w=short, **nose))
    return pt.Table.from_table_specs(
        PocketTableSpecs(
            l=long, w=short, **nose,
            corner_pocket_width=corner.mouth, corner_pocket_angle=corner.jaw_angle - 135, corner_jaw_radius=corner.jaw_radius,
            corner_pocket_depth=corner.shelf + corner.radius - corner.mouth / 2, corner_pocket_radius=corner.radius,
            side_pocket_width=side.mouth, side_pocket_angle=side.jaw_angle - 90, side_jaw_radius=side.jaw_radius,
            side_pocket_depth=side.shelf + side.radius, side_pocket_radius=side.radius,
        )
    )  # fmt: skip


def _params(scene: Scene) -> dict[str, float]:
    """Return pooltool's numbers of the balls; those of which the scene has none, or a form, are pooltool's own."""
    ball, floor, wall, pair = scene.balls[0], scene.floor, scene.walls[0], scene.ball_contact
    found = {"m": ball.mass, "R": ball.radius, "g": -scene.gravity[2]}
    if isinstance(pair.friction, float):
        found["u_b"] = max(pair.friction, LEAST)
    if floor is not None:
        found["u_s"] = max(floor.friction, LEAST)
        found["u_r"] = max(floor.rolling_resistance, LEAST)
        found["u_sp_proportionality"] = max(floor.spin_friction / ball.radius, LEAST)
        if has_flights() and isinstance(floor.restitution, Constant):
            found["e_t"] = floor.restitution.value
    for key, form in (("e_b", pair.restitution), ("e_c", wall.restitution)):
        if isinstance(form, Constant):
            found[key] = form.value
    if wall.friction is not None:
        found["f_c"] = max(wall.friction, LEAST)
    return found


def _states(run: Trajectory, times: Array, turn: Array, corner: Array) -> list[tuple[Array, Any, Array]]:
    """Return position, velocity and spin (n, 3, 3), motion (n,) and time (n,) of each ball.

    A ball that is in a pocket, or has left, stays at the last place where it was seen.
    """
    state, phases = run.at(times), run.phase(times)
    motions = {**MOTIONS, "flight": FLYING, "bouncing": FLYING} if has_flights() else MOTIONS
    found = []
    for i in range(len(run.scene.balls)):
        rvw = np.stack(
            [
                np.asarray(state.position)[:, i] @ turn.T - corner,
                state.velocity[:, i] @ turn.T,
                state.spin[:, i] @ turn.T,
            ],
            axis=1,
        )
        gone = np.isnan(rvw[:, 0, 0])
        if gone.any():
            rvw[gone] = 0.0
            rvw[gone, 0] = turn @ np.asarray(run.final.position)[i] - corner
        found.append((rvw, np.array([motions[name] for name in phases[:, i]]), times))
    return found
