"""Collisions of free balls or discs found in their tracks, as rebounds: two balls meet as one with the reduced mass meets a wall.

With the velocity u = v1 - v2, the normal n from the second ball to the first, and S = a1 w1 + a2 w2, the slip is u - S x n. An
impulse J changes u by J/M and S by -n x J/(kappa M), where M is the reduced mass. So a pair with one kappa is a ball of velocity u
and spin S/a at a wall.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.data.rebounds import Rebounds, make_rebounds
from carom.errors import CaromError
from carom.tracks.judgement import event_time, nearest_image, path_events
from carom.tracks.judgement_paths import PathPiece, read_paths

__all__ = ["collisions_of_tracks"]

Array = NDArray[np.float64]
LEAST_SIGMA = 1e-9  # of the speeds: simulated numbers have no noise, but a fit needs error bars
LEAST_APPROACH = 4.0  # error bars of the approach speed: slower collisions tell nothing


def collisions_of_tracks(
    columns: dict[str, Any], radius: float, sides: Array | None = None
) -> tuple[Rebounds, list[str]]:
    """Return the collisions of two balls that free tracks show, as planar rebounds along their slip, and notes.

    Parameters
    ----------
    columns : dict of arrays
        ``t`` (s), ``ball``, ``x``, ``y`` and maybe ``z`` (m), spins ``wz`` and, of spheres, ``wx``, ``wy`` (rad/s); maybe
        ``radius`` and ``mass`` of each ball.
    radius : float
        Of balls without one, m.
    sides : (3,) array, optional
        Of a periodic box, m, in which balls meet each other's images; inf along an axis that is not periodic. Places may be wrapped
        into the box, or not.

    Returns
    -------
    Rebounds, list of str
        ``spin`` columns are those of a ball with ``radius`` (the first one's). Raises CaromError where no collision is resolved.
    """
    rows = len(np.asarray(columns["t"]))
    filled = {name: np.asarray(values) for name, values in columns.items()}
    for name in ("wx", "wy") if "wz" in filled else ():
        filled.setdefault(name, np.zeros(rows))
    filled.setdefault("z", np.zeros(rows))
    filled.setdefault("radius", np.full(rows, radius))
    balls, sigma, _notes = read_paths(filled, radius, 1.0, None)
    found: list[tuple[float, ...]] = []
    seen = 0
    for event in path_events(balls, sigma, sides):
        if len(event.members) != 2:
            continue
        seen += 1
        t, late = event_time(event)
        if not math.isnan(t) and (row := _row(event.members[0], event.members[1], t, late, radius, sides)) is not None:
            found.append(row)
    if not found:
        raise CaromError(
            "fit_gas: tracks: expected collisions of two balls with four or more frames before and after, got none;"
            " film at a higher rate, or give the radius"
        )
    names = [name + side for side in ("_in", "_out") for name in ("v_n", "v_t", "spin")]
    table = np.array(found)
    given = dict(zip(names, table[:, :6].T, strict=True))
    given |= {f"sigma_{name}": column for name, column in zip(names, table[:, 6:].T, strict=True)}
    notes = [f"{len(found)} collisions of two balls, of {seen} in the tracks; noise of a coordinate {sigma:.3g} m"]
    if "wz" not in columns:  # (unknown spins are integrated out)
        given = {name: column for name, column in given.items() if "spin" not in name}
    return make_rebounds("planar", given, source="tracks"), notes


def _row(one: Any, two: Any, t: float, late: float, radius: float, sides: Array | None) -> tuple[float, ...] | None:
    """Return velocities and spins of a pair before and after, and their error bars; None for a slow approach."""
    pieces: list[tuple[PathPiece, PathPiece]] = [(one.before, two.before), (one.after, two.after)]
    r = np.zeros(3)
    spread = 0.0
    for a, b in pieces:
        (x, dx), (y, dy) = a.place(t), b.place(t)
        r += nearest_image(x - y, sides) / 2
        spread += (dx * dx + dy * dy) / 4
    distance = float(np.linalg.norm(r))
    n = r / distance
    arms = (one.ball.radius, two.ball.radius)
    states = []
    for a, b in pieces:
        (v, dv), (w, dw) = a.velocity(t), b.velocity(t)
        turn = np.zeros(3)
        if a.spins is not None and b.spins is not None:
            turn = np.cross(arms[0] * a.spin(t) + arms[1] * b.spin(t), n)
        errors = (math.hypot(dv, dw), math.hypot(arms[0] * a.spin_error, arms[1] * b.spin_error) / radius)
        states.append((v - w, turn, errors))
    approach = -float(states[0][0] @ n)
    if approach < LEAST_APPROACH * states[0][2][0]:
        return None
    if float(states[1][0] @ n) < 0:  # (they meet again, or a third ball, before four frames have gone by)
        return None
    slip = states[0][0] + approach * n - states[0][1]
    length = float(np.linalg.norm(slip))
    along = slip / length if length > 0 else np.cross(n, [0.0, 0.0, 1.0])
    speed = float(np.linalg.norm(states[0][0]))
    tilt = math.sqrt(spread + (speed * late) ** 2) / distance  # of the line of centres
    values: list[float] = []
    sigmas: list[float] = []
    for sign, (u, turn, (dv, dw)) in zip((-1.0, 1.0), states, strict=True):
        normal, tangential = float(u @ n), float(u @ along)
        values += [sign * normal, tangential, float(turn @ along) / radius]
        sigmas += [math.hypot(dv, tangential * tilt), math.hypot(dv, normal * tilt), dw]
    least = LEAST_SIGMA * speed
    sigmas = [max(s, least / (radius if k % 3 == 2 else 1.0)) for k, s in enumerate(sigmas)]
    return (*values, *sigmas)
