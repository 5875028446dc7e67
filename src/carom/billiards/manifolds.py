"""Stable and unstable manifolds of hyperbolic periodic orbits in the plane, as curves of points just after a bounce."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from carom.billiards.energy_shell import EnergyShell
from carom.billiards.orbits import Orbit
from carom.billiards.periodic_records import PeriodicOrbit
from carom.billiards.same_orbits import run_orbits
from carom.errors import CaromError, Fault

__all__ = ["Manifold", "manifold"]

Array = NDArray[np.float64]
FIRST = 1e-7  # of the table's size and the ball's speed: the distance from the orbit at which the curve begins
ROUNDS = 24  # in which points are put between those that come apart
MOST_POINTS = 400_000
MOST_IMAGES = 60
FINEST = 1e-13  # distance of two starts on the eigenvector, relative to the piece that is followed


@dataclass(frozen=True, eq=False)
class Manifold:
    """Points of a manifold in the order along its two branches, which begin at the periodic orbit."""

    kind: str
    """"unstable" or "stable"."""
    branch: NDArray[np.int64]
    """(N): 0 or 1."""
    position: Array
    """(N, 2): of the bounce (m)."""
    velocity: Array
    """(N, 2): after it (m/s)."""
    spin: Array
    """(N): rad/s."""
    arc: Array
    """(N): arc length along the boundary (m)."""
    phase: Array
    """(N, 2): velocity phase disc, as :attr:`Orbit.phase`."""
    apart: float
    """The longest distance between neighbours, relative to the table's size and the ball's speed."""


def manifold(found: PeriodicOrbit, kind: str = "unstable", *, length: float = 3.0, apart: float = 0.02) -> Manifold:
    """Compute a manifold of a hyperbolic periodic orbit: the curves that leave it, or those that lead to it.

    A short piece along the eigenvector of the multiplier is followed for so many periods that its end comes ``length`` far; points
    are put between neighbours until none are more than ``apart`` from each other. A stable manifold is the unstable one of the
    reversed orbit, reversed: the laws that keep the energy are reversible.

    Parameters
    ----------
    found : PeriodicOrbit
        Hyperbolic, from `periodic_orbits` or `refine_orbit`, in a table without a force.
    kind : "unstable" or "stable"
    length : float
        Growth of a point's distance from the orbit by which periods are counted, relative to the table's size and the ball's speed.
    apart : float
        Longest distance between neighbours, in the same unit.

    Returns
    -------
    Manifold
        Points of both branches.

    Raises
    ------
    CaromError
        An orbit that is not hyperbolic, or a table with a force.

    Examples
    --------
    In an ellipse the manifolds of the long axis are the orbits through the foci: their angular momenta about these have the
    product 0.

    >>> import numpy as np
    >>> from carom import billiards
    >>> axis = billiards.periodic_orbits(billiards.ellipse(1.25, 1.0), 2, law="mirror")[-1]
    >>> curve = billiards.manifold(axis)
    >>> to_foci = [curve.position - (sign * 0.75, 0.0) for sign in (1, -1)]
    >>> momenta = [x[:, 0] * curve.velocity[:, 1] - x[:, 1] * curve.velocity[:, 0] for x in to_foci]
    >>> bool(np.abs(momenta[0] * momenta[1]).max() < 1e-12)
    True
    """
    if found.stability != "hyperbolic":
        raise CaromError(Fault("manifold", "found", "a hyperbolic periodic orbit", f"one that is {found.stability}"))
    setup = found.orbit.setup
    if setup.table.has_force:
        raise CaromError(Fault("manifold", "found", "an orbit in a table without a force", f"{setup.table}"))
    if kind not in ("unstable", "stable"):
        raise CaromError(Fault("manifold", "kind", "'unstable' or 'stable'", repr(kind)))
    shell = EnergyShell(setup, found.energy)
    start = _coordinates(shell, found.orbit, kind)
    return _grow(shell, start, found.period, kind, float(length), float(apart))


def _coordinates(shell: EnergyShell, orbit: Orbit, kind: str) -> Array:
    """Return the coordinates (4) of the last bounce of a periodic orbit; for a stable manifold, of the reversed orbit."""
    velocity, spin = orbit.velocity[-1, :2], orbit.spin[-1]
    if kind == "stable":  # just before that bounce, which is just after the one before it, reversed
        before = -2 if len(orbit.t) > 1 else -1
        velocity, spin = -orbit.velocity[before, :2], -orbit.spin[before]
    found = shell.coordinates(orbit.piece[-1:], orbit.position[-1:, :2], velocity[None], np.atleast_1d(spin))
    return np.asarray(found[0])


def _grow(shell: EnergyShell, start: Array, period: int, kind: str, length: float, apart: float) -> Manifold:
    """Follow a piece of the eigenvector between a distance and its image, and put points between those that come apart."""
    values, vectors = np.linalg.eig(shell.equations(start[None], period)[2][0])
    far = int(np.argmax(np.abs(values)))
    value, vector = float(values[far].real), np.real(vectors[:, far])
    each = period if value > 0 else 2 * period  # (a negative multiplier changes the branch at every period)
    growth = abs(value) ** (each // period)
    images = min(max(math.ceil(math.log(length / FIRST) / math.log(growth)), 1), MOST_IMAGES)
    rows, branches, widest = [], [], 0.0
    for branch, sign in enumerate((1.0, -1.0)):

        def points(u: Array, sign: float = sign) -> Array:
            begin = start + (sign * FIRST) * growth ** u[:, None] * vector
            return _images(shell, run_orbits(shell, begin, each * images), each, kind)

        u = np.linspace(0.0, 1.0, 65)
        found = points(u)
        for _ in range(ROUNDS):
            wide = np.flatnonzero((_gaps(shell, found) > apart).any(axis=1) & (np.diff(u) > FINEST))
            if not len(wide) or len(u) * images > MOST_POINTS:
                break
            middle = (u[wide] + u[wide + 1]) / 2
            u, found = np.insert(u, wide + 1, middle), np.insert(found, wide + 1, points(middle), axis=0)
        widest = max(widest, float(_gaps(shell, found).max()))
        rows.append(found.transpose(1, 0, 2).reshape(-1, found.shape[-1]))  # (one image after the other)
        branches.append(np.full(len(rows[-1]), branch))
    table = np.concatenate(rows)
    return Manifold(
        kind, np.concatenate(branches), table[:, :2], table[:, 2:4], table[:, 4], table[:, 5], table[:, 6:], widest
    )


def _images(shell: EnergyShell, run: Orbit, each: int, kind: str) -> Array:
    """Return position, velocity, spin, arc length and phase (N, K, 8) after every period; reversed, for a stable manifold."""
    velocity, spin, begin = run.velocity[..., :2], run.spin, run.start
    if kind == "stable":
        velocity = -np.concatenate([np.asarray(begin.velocity)[:, None, :2], velocity[:, :-1]], axis=1)
        spin = -np.concatenate([np.reshape(begin.spin, (-1, 1)), spin[:, :-1]], axis=1)
    n, ball = run.normal, shell.setup.ball
    along = n[..., 1] * velocity[..., 0] - n[..., 0] * velocity[..., 1]
    rolls = math.sqrt(1.0 + ball.kappa) if shell.setup.rolls else 1.0
    phase = np.stack([math.sqrt(ball.kappa) * ball.radius * spin, rolls * along], axis=-1) / shell.speed
    every = slice(each - 1, None, each)
    parts = [run.position[..., :2], velocity, spin[..., None], run.arc[..., None], phase]
    return np.concatenate(parts, axis=-1)[:, every]


def _gaps(shell: EnergyShell, found: Array) -> Array:
    """Return the distances (N - 1, K) of neighbours in position and phase, relative to the table's size and the ball's speed."""
    here = np.concatenate([found[..., :2] / shell.size, found[..., 6:]], axis=-1)
    return np.asarray(np.linalg.norm(np.diff(here, axis=0), axis=-1))
