"""A ball at the edge of a scene's pocket: it rolls over the rim, falls, or comes back."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from carom.billiards.rolling_run import STICKS, RollingRun, roll
from carom.billiards.surfaces import hole
from carom.bodies import State, Surface
from carom.errors import CaromError, Fault
from carom.scene import Scene

__all__ = ["pocket_rim"]

DEPTH = 0.1
BEFORE = 1e-6  # of the pocket's radius, ahead of the edge: there the run begins
SLIPS = 1e-6  # of the speed: a ball whose contact point moves faster does not roll
LONGEST = 20.0  # s
ACCURACY = 1e-10


def pocket_rim(
    scene: Scene,
    pocket: str,
    state: State,
    *,
    ball: int = 0,
    depth: float = DEPTH,
    friction: float = math.inf,
    contact: Surface | None = None,
) -> RollingRun:
    """Follow a ball that rolls over the rim of a scene's pocket, from the state at which a run catches it.

    A run of a scene ends for a ball where its centre passes a pocket's edge. Here it goes on: the ball rolls over the sharp edge,
    leaves it, meets it or the pocket's wall, an upright cylinder, and falls to the bottom or comes out again. What stands around
    the pocket is left out, its jaws and the liner behind it, which stops fast balls: the answer is right for balls that pass the
    edge slowly or from the side.

    Parameters
    ----------
    scene : Scene
        With a table that has pockets.
    pocket : str
        Its name (``scene.pocket_names``; ``name`` of the event).
    state : State
        Place, velocity and spin of the ball as it passes the edge: ``after`` of the event "pocketed". It rolls there.
    ball : int
        Number of the ball.
    depth : float
        Of the pocket (m).
    friction : float
        Coefficient of friction of the edge: the run ends with "slips" where rolling needs more.
    contact : Surface, optional
        For impacts with edge and wall, by the contact law; without restitution, and sticking, by default.

    Returns
    -------
    RollingRun
        About the pocket's middle. It ends with "bottom" (it falls), "away" (it comes out: its centre is two radii from the middle),
        or "duration" after 20 s.

    Raises
    ------
    CaromError
        A pocket that the scene lacks, a ball that is not at its edge, flies or slides.

    Examples
    --------
    >>> import carom
    >>> from carom import billiards
    >>> table = {"shape": "table", "preset": "pool-9ft", "restitution": 0.9, "friction": 0.2}
    >>> shot = {"radius": 0.028575, "mass": 0.163, "position": (0.0, -0.5), "velocity": (0.0, -0.8), "rolling": True}
    >>> scene = carom.Scene(floor={"friction": 0.2}, walls=[table], balls=[shot])
    >>> caught = carom.simulate(scene).events.of("pocketed")[0]
    >>> billiards.pocket_rim(scene, caught.name, caught.after).end
    'bottom'
    """
    edges = {one.name: one for wall in scene.walls for one in wall.pockets}
    if pocket not in edges:
        raise CaromError(Fault("pocket_rim", "pocket", f"one of {', '.join(edges) or 'none'}", repr(pocket)))
    if state.position is None:
        raise CaromError(Fault("pocket_rim", "state", "a state with a position", "none"))
    made = scene.balls[ball].ball
    r = float(made.radius)
    middle, size = np.array([*edges[pocket].center, 0.0]), float(edges[pocket].radius)
    x, v, w = (np.asarray(one, float) for one in (state.position - middle, state.velocity, state.spin))
    speed = float(np.linalg.norm(v))
    if abs(math.hypot(x[0], x[1]) - size) > 1e-6 * size or abs(x[2] - r) > 1e-6 * r:
        got = f"one {1e3 * (math.hypot(x[0], x[1]) - size):.3g} mm outside it, {1e3 * (x[2] - r):.3g} mm over the cloth"
        raise CaromError(Fault("pocket_rim", "state", "a ball on the cloth at the pocket's edge", got))
    slip = float(np.linalg.norm(v - r * np.cross(w, (0.0, 0.0, 1.0))))
    if not slip <= SLIPS * speed:
        raise CaromError(Fault("pocket_rim", "state", "a ball that rolls", f"one that slides at {slip:.3g} m/s"))
    # at the edge itself the ball is on the border of the cloth; with the height that rounding took from it
    begin = np.array([x[0], x[1], r]) - BEFORE * size / speed * v
    how: dict[str, Any] = {"gravity": scene.gravity, "duration": LONGEST, "friction": friction, "accuracy": ACCURACY}
    flat = np.array([v[0], v[1], 0.0])
    return roll(hole(size, depth, r), begin, flat, float(w[2]), ball=made, contact=contact or STICKS, **how)
