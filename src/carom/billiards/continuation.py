"""Continuation of periodic orbits in a number of the table, the ball or the law, by pseudo-arclength (Keller 1977)."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.billiards.coded_orbits import (
    LARGEST_RESIDUAL,
    NULL,
    EnergyShell,
    energy_shell,
    newton_steps,
    residual,
    run_orbits,
)
from carom.billiards.orbits import Orbit
from carom.billiards.periodic import PeriodicOrbit, describe_periodic, first_coordinates, third_and_trace
from carom.billiards.setup import needs_surface
from carom.bodies import Surface
from carom.errors import CaromError, Fault, require_count
from carom.files import import_optional
from carom.public.progress import Progress

Array = NDArray[np.float64]
FIRST_STEP = 0.02  # of the range of the parameter, and of the table's size and the ball's speed
LONGEST_STEP, SHORTEST_STEP = 0.05, 1e-7
CORRECTIONS = 8  # Newton's steps after each step along the branch; more: the step is halved
CLOSED = 1e-11  # residual of a point of the branch, relative to 1 and the tangent map
AT_START = 1e-6  # residual of the given orbit with the first value of the parameter
DIFFERENCE = 1e-6  # of the range: the residual's derivative by the parameter is a central difference
LOCATED = 1e-13  # of the range: accuracy of an event's parameter
# Traces at which a pair of multipliers is a root of unity, and the names of these points.
RESONANCES = {2.0: "1:1 resonance", -2.0: "period doubling", -1.0: "1:3 resonance", 0.0: "1:4 resonance"}
APART = 1e-9  # traces nearer to a resonance do not cross it: rounding


class BranchPoint(NamedTuple):
    """A point of a branch at which its stability changes, or at which it turns back."""

    kind: str
    """"fold", "period doubling" (trace -2), "1:1 resonance" (trace 2), "1:3 resonance" (-1) or "1:4 resonance" (0)."""
    parameter: float
    trace: float
    duration: float
    """s."""


@dataclass(frozen=True, eq=False)
class OrbitBranch:
    """Periodic orbits along one branch, from the first one on.

    Examples
    --------
    >>> from carom import billiards
    >>> one = billiards.periodic_orbits(billiards.ellipse(1.2, 1.0), 2, law="mirror", starts=100)[0]
    >>> branch = billiards.continue_orbit(one, lambda major: {"table": billiards.ellipse(major, 1.0)}, 1.2, 2.5)
    >>> branch.ended, branch.events[0].kind, round(branch.events[0].parameter, 10)
    ('range', '1:3 resonance', 2.0)
    """

    parameter: Array
    """(M): of each orbit."""
    trace: Array
    """(M): as :attr:`PeriodicOrbit.trace`."""
    duration: Array
    """(M): s."""
    events: tuple[BranchPoint, ...]
    """In the order of the branch."""
    ended: str
    """"range" (the parameter reached the other end, or came back to its first value), "steps", or "orbit": the orbit ends
    there (at a corner, or at a wall that it touches without meeting it)."""
    _shells: tuple[EnergyShell, ...]
    _coordinates: Array
    _period: int

    def __len__(self) -> int:
        """Return the number of orbits."""
        return len(self.parameter)

    def __repr__(self) -> str:
        """Return one line."""
        low, high = self.parameter.min(), self.parameter.max()
        return f"<OrbitBranch: period {self._period}, {len(self)} orbits, parameter {low:g} to {high:g}, {len(self.events)} events>"

    def orbit(self, which: int) -> PeriodicOrbit:
        """Return one of the orbits."""
        return describe_periodic(self._shells[which], self._coordinates[which], self._period)

    def describe(self) -> str:
        """Return the range of the branch and its events, a line each."""
        lines = [f"{one.kind} at {one.parameter:.12g}, duration {one.duration:.9g} s" for one in self.events]
        why = {
            "range": "to the end of the range",
            "steps": "until the steps were used up",
            "orbit": "where the orbit ends",
        }
        first, last = self.parameter[0], self.parameter[-1]
        return "\n".join([f"{len(self)} orbits from {first:.9g} to {last:.9g}, {why[self.ended]}", *lines])


def continue_orbit(
    orbit: PeriodicOrbit,
    change: Callable[[float], Mapping[str, Any]],
    start: float,
    stop: float,
    *,
    steps: int = 500,
    progress: Progress | None = None,
) -> OrbitBranch:
    """Follow a periodic orbit while a number changes: of the table, of the ball, of a force.

    The branch is followed by its arc length, so that it may turn back (a fold). Between two steps, events are located by bisection.

    Parameters
    ----------
    orbit : PeriodicOrbit
        From :func:`periodic_orbits`, at the first value of the number.
    change : callable(value) -> mapping
        What belongs to a value: ``{"table": ...}``, ``{"ball": ...}`` or both; what it leaves out stays.
    start, stop : float
        The value of the orbit, and the value up to which it is followed.
    steps : int
        Largest number of steps.
    progress : callable(done, total, text), optional
        Called with the number of steps done, and of all.

    Returns
    -------
    OrbitBranch

    Raises
    ------
    CaromError
        The orbit is none at ``start``, a change of something else.

    Examples
    --------
    The orbit of period two in the corner of an equilateral triangle, with kappa: its trace is 2 cos theta, with
    theta = 2 arccos((kappa - cos 60 deg)/(1 + kappa)) (docs/theory/no_slip.md).

    >>> import math
    >>> import carom
    >>> from carom import billiards
    >>> one = billiards.periodic_orbits(billiards.regular(3), 2, ball=carom.Disc(1, 1, 0.4), starts=50)[0]
    >>> branch = billiards.continue_orbit(one, lambda kappa: {"ball": carom.Disc(1, 1, kappa)}, 0.4, 0.9)
    >>> theta = [2 * math.acos((kappa - 0.5) / (1 + kappa)) for kappa in branch.parameter]
    >>> bool(max(abs(branch.trace - [2 * math.cos(one) for one in theta])) < 1e-11)
    True
    """
    import_optional("scipy.optimize", "continue_orbit")  # (said before the work)
    if not isinstance(orbit, PeriodicOrbit):
        raise CaromError(Fault("continue_orbit", "orbit", "a PeriodicOrbit", f"{orbit!r:.60}"))
    steps = require_count("orbit", "steps", steps)
    for name, value in (("start", start), ("stop", stop)):
        if not (isinstance(value, int | float | np.number) and math.isfinite(value)):
            raise CaromError(Fault("continue_orbit", name, "a finite number", repr(value)))
    if start == stop:
        raise CaromError(Fault("continue_orbit", "stop", "another value than that of the orbit", repr(stop)))
    path = _Path(orbit, change, float(start), float(stop))
    return path.follow(steps, progress)


class _LostError(Exception):
    """The branch is lost within a step."""


class _Path:
    """The equations of a branch: unknowns z are the orbit's coordinates and the parameter, from 0 at the start to 1 at the stop."""

    def __init__(
        self, orbit: PeriodicOrbit, change: Callable[[float], Mapping[str, Any]], start: float, stop: float
    ) -> None:
        self.setup, self.change, self.period = orbit.orbit.setup, change, orbit.period
        self.start, self.stop = start, stop
        given = orbit.orbit.start
        self.energy = orbit.energy
        self.known: tuple[Array, tuple[Array, Array, Array]] = (np.empty(0), (np.empty(0),) * 3)
        shell = self.shell(start)
        if shell.setup.table.dimension != 2:
            raise CaromError(Fault("continue_orbit", "change", "a table in the plane", f"{shell.setup.table}"))
        self.free = shell.free
        # the state after the first bounce of the orbit at hand: it must close with the parameter's first value, too
        corrected = None
        with contextlib.suppress(CaromError):  # (the orbit may lie outside the table of that value)
            self.z0 = np.append(first_coordinates(shell, given)[0], 0.0)
            if residual(self.equations(self.z0)[0][None])[0] < AT_START:
                corrected = self.correct(self.z0, np.eye(5)[4], 0.0)
        if corrected is None:
            expected = "the value of the number for this orbit"
            raise CaromError(Fault("continue_orbit", "start", expected, f"{start:g}, where it does not close"))
        self.z0 = corrected

    def value(self, z: float) -> float:
        """Return the parameter."""
        return self.start + z * (self.stop - self.start)

    def shell(self, value: float) -> EnergyShell:
        """Return the energy shell with the parameter."""
        changed = self.change(value)
        if not isinstance(changed, Mapping):
            expected = "a mapping such as {'table': ...}"
            raise CaromError(Fault("continue_orbit", "change", f"{expected} for each value", f"{changed!r:.60}"))
        if unknown := set(changed) - {"table", "ball"}:
            raise CaromError(
                Fault("continue_orbit", "change", "`table` and `ball`", ", ".join(sorted(map(str, unknown))))
            )
        table, ball = changed.get("table", self.setup.table), changed.get("ball", self.setup.ball)
        world = self.setup.world[0]
        surface = (
            Surface(float(world["e"]), float(world["mu"]), float(world["beta"]))
            if needs_surface(self.setup.law)
            else None
        )
        return energy_shell(table, ball, self.setup.law, surface, math.sqrt(self.energy))

    def equations(self, z: Array) -> tuple[Array, Array, Array]:
        """Return the residuals (5), their derivatives (5, K + 1) by the free coordinates and the parameter, the tangent map."""
        if np.array_equal(z, self.known[0]):  # (a point's tangent and its trace follow from its last correction)
            return self.known[1]
        f, df, matrix = self.shell(self.value(z[4])).equations(z[None, :4], self.period)
        ends = [
            self.shell(self.value(z[4] + h)).equations(z[None, :4], self.period)[0][0]
            for h in (DIFFERENCE, -DIFFERENCE)
        ]
        by_parameter = (ends[0] - ends[1]) / (2 * DIFFERENCE)
        found = f[0], np.concatenate([df[0][:, self.free], by_parameter[:, None]], axis=1), matrix[0]
        self.known = z.copy(), found
        return found

    def correct(self, z: Array, along: Array, step: float) -> Array | None:
        """Return the point of the branch in the plane across ``along`` at a distance ``step`` from z; None where there is none."""
        guess = z + step * along
        for _ in range(CORRECTIONS):
            f, df, matrix = self.equations(guess)
            if not (np.isfinite(f).all() and np.isfinite(df).all()):
                return None
            across = (guess - z) @ along - step
            if (
                residual(f[None])[0] <= min(CLOSED * (1 + np.abs(matrix).max()), LARGEST_RESIDUAL)
                and abs(across) < CLOSED
            ):
                return guess
            rows = np.concatenate([df, self._part(along)[None]])
            moved = newton_steps(np.append(f, across)[None], rows[None])[0]
            guess = guess + self._whole(moved)
        return None

    def _part(self, z: Array) -> Array:
        return np.append(z[:4][self.free], z[4])

    def _whole(self, part: Array) -> Array:
        whole = np.zeros(5)
        whole[:4][self.free], whole[4] = part[:-1], part[-1]
        return whole

    def tangent(self, z: Array, before: Array) -> Array:
        """Return the unit vector along the branch nearest to the one before: in a family there are several directions."""
        _u, sizes, rows = np.linalg.svd(self.equations(z)[1])
        null = rows[np.append(sizes, np.zeros(len(rows) - len(sizes))) <= NULL * sizes[0]]
        if not len(null):
            return before
        found = null.T @ (null @ self._part(before))
        size = float(np.linalg.norm(found))
        return before if size < 1e-3 else self._whole(found / size)

    def follow(self, steps: int, report: Any) -> OrbitBranch:
        """Step along the branch."""
        z, step, ended = self.z0, FIRST_STEP, "steps"
        along = self.tangent(z, np.eye(5)[4])
        points, shown = [z], [self.measure(z)]
        events: list[BranchPoint] = []
        for k in range(steps):
            new = self.correct(z, along, step)
            while new is None and step > SHORTEST_STEP:
                step /= 2
                new = self.correct(z, along, step)
            if new is None:
                ended = "orbit"
                break
            edge = min(max(new[4], 0.0), 1.0)
            if new[4] != edge:
                ended = "range"
                step, new = self.located(z, along, step, self.parameter_beyond(edge))
            turned = self.tangent(new, along)
            points.append(new)
            shown.append(self.measure(new))
            events += self.events(z, along, step, shown[-2], shown[-1], along[4] * turned[4] < 0)
            z, along, step = new, turned, min(1.4 * step, LONGEST_STEP)
            if report is not None:
                report(k + 1, steps, "steps")
            if ended == "range":
                break
        path, seen = np.array(points), np.array(shown)
        shells = tuple(self.shell(self.value(float(one[4]))) for one in path)
        parameter = self.start + path[:, 4] * (self.stop - self.start)
        return OrbitBranch(parameter, seen[:, 0], seen[:, 1], tuple(events), ended, shells, path[:, :4], self.period)

    def measure(self, z: Array) -> tuple[float, float]:
        """Return trace and duration of an orbit of the branch."""
        shell = self.shell(self.value(z[4]))
        return third_and_trace(shell, self.equations(z)[2])[1], shell.duration(z[:4], self.period)

    def parameter_beyond(self, edge: float) -> Callable[[Array], float]:
        """Return the function whose zero is an end of the range."""
        return lambda z: float(z[4]) - edge

    def trace_beyond(self, trace: float) -> Callable[[Array], float]:
        """Return the function whose zero is a resonance."""
        return lambda z: self.measure(z)[0] - trace

    def located(self, z: Array, along: Array, step: float, sign: Callable[[Array], float]) -> tuple[float, Array]:
        """Return the distance from z, up to a step, at which a function of the branch's point changes its sign, and that point."""
        point = z

        def at(distance: float) -> float:
            nonlocal point
            if distance == 0.0:
                return sign(z)
            new = self.correct(z, along, distance)
            if new is None:
                raise _LostError
            point = new
            return sign(new)

        try:
            where = float(import_optional("scipy.optimize", "continue_orbit").brentq(at, 0.0, step, xtol=LOCATED))
            at(where)
        except (_LostError, ValueError):  # (a step fails on the way, or rounding gives both ends one sign)
            where = float(np.linalg.norm(point - z))
        return where, point

    def events(self, z: Array, along: Array, step: float, before: Any, after: Any, turns: bool) -> list[BranchPoint]:
        """Return the events between z and the point a step ahead, in their order."""
        found = []
        if turns:
            found.append((*self.located(z, along, step, lambda one: float(self.tangent(one, along)[4])), "fold"))
        for trace, kind in RESONANCES.items():
            p, q = before[0] - trace, after[0] - trace
            if p * q < 0 and min(abs(p), abs(q)) > APART:
                found.append((*self.located(z, along, step, self.trace_beyond(trace)), kind))
        found.sort(key=lambda one: one[0])
        return [BranchPoint(kind, self.value(float(at[4])), *self.measure(at)) for _where, at, kind in found]


# ----------------------------------------------------------------------------------------------------
# Stable and unstable manifolds of hyperbolic periodic orbits in the plane, as curves of points just after a bounce.


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
