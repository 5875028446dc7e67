"""Orbits in a figure or a table, from a given state or sampled ones: ``carom orbit``, in Python ``carom.orbit``."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields
from os import PathLike
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.billiards.orbits import Orbit, orbit_from_setup, require_reversible
from carom.billiards.orbits import reverse as backwards
from carom.billiards.orbits import starts as sampled_starts
from carom.billiards.periodic import PeriodicOrbits, periodic_orbits
from carom.billiards.setup import Start, default_ball, law_of, needs_surface, orbit_setup, start_rows
from carom.billiards.stability import Lyapunov, spectrum_of
from carom.billiards.tables import Table, in_magnetic_field, under
from carom.billiards.tables import table as table_of
from carom.bodies import Ball, Disc, Surface
from carom.errors import CaromError, Fault, FaultList, did_you_mean, near_name, require_count
from carom.laws.law import Law
from carom.public.defaults import BOUNCES, PERIODIC_STARTS
from carom.public.other_rooms import saved_figure
from carom.public.progress import Progress
from carom.scene.figures import FIGURES, Figure

if TYPE_CHECKING:
    import matplotlib.figure

Array = NDArray[np.float64]

ALONG = {"strip": (1, 0), "plates": (0, 0, 1), "cylinder": (0, 0, 1)}  # in which a scalar acceleration acts
COUNTS = {
    1: "a number",
    2: "two numbers, such as 0.1,0.2",
    3: "three numbers, such as 0.1,0.2,0",
}


@dataclass(frozen=True, eq=False, repr=False)
class OrbitResult(Orbit):
    """The orbits that :func:`carom.orbit` followed, and what it was asked for besides.

    Examples
    --------
    >>> import carom
    >>> carom.orbit("circle", 20, reverse=True).reversal_error.shape
    (1, 20)
    """

    spectrum: Lyapunov | None = None
    """The Lyapunov exponents, with ``lyapunov``."""
    reversal_error: Array | None = None
    """(..., B), m: distance of each bounce of the reversed orbits from the original one, with ``reverse``."""
    periodic: PeriodicOrbits | None = None
    """The periodic orbits, with ``periodic``."""

    def plot(self, file: str | Path | None = None, **options: Any) -> matplotlib.figure.Figure:
        """Return a Matplotlib figure: one orbit in its table, or the periodic orbits found. ``file``: write it there."""
        if self.periodic is None:
            return super().plot(file, **options)
        return saved_figure("plot_periodic", file, self.periodic, **options)  # type: ignore[no-any-return]

    def lyapunov(self, file: str | Path | None = None) -> matplotlib.figure.Figure:
        """Return a figure of how the Lyapunov exponents converge, which are computed if they were not. ``file``: write it there."""
        return saved_figure("plot_lyapunov", file, self.spectrum or _spectrum(self))  # type: ignore[no-any-return]


def orbit(
    table: str | Mapping[str, Any] | PathLike[str] | Figure | Table,
    bounces: int = BOUNCES,
    *,
    bounds: str = "centre",
    acceleration: ArrayLike | None = None,
    magnetic_field: float | None = None,
    kappa: float | None = None,
    ball_radius: float | None = None,
    law: str | Law | Any = "no-slip",
    restitution: float | None = None,
    friction: float | None = None,
    tangential_restitution: float | None = None,
    at_corner: str = "end",
    position: ArrayLike | None = None,
    velocity: ArrayLike | None = None,
    spin: ArrayLike | None = None,
    orbits: int = 1,
    seed: int = 0,
    lyapunov: bool = False,
    reverse: bool = False,
    periodic: int | str | Iterable[int] | None = None,
    itinerary: str | Iterable[str] | None = None,
    starts: int = PERIODIC_STARTS,
    progress: Progress | None = None,
    **sizes: Any,
) -> OrbitResult:
    """Follow a ball in a table from bounce to bounce: ``carom orbit``, with the names and defaults of its options.

    Parameters
    ----------
    table : str, dict, Path, Figure or Table
        The figure, as :func:`carom.scene.figures.figure` takes it: a name, a text such as "stadium:straight=2,radius=1" or
        "cylinder:stadium:height=2", a table of its fields, a Path of a TOML or JSON file; or a table of :mod:`carom.billiards`.
    bounces : int
        Number of bounces.
    bounds : "centre" or "surface"
        Whether the table bounds the ball's centre or its surface.
    acceleration : 2 or 3 numbers, or one, optional
        Constant acceleration, m/s^2: x,y or x,y,z; one number: along a strip (x), plates or a cylinder (z).
    magnetic_field : float, optional
        Magnetic field perpendicular to the plane, as the cyclotron frequency, rad/s: the centre moves on circles of the Larmor
        radius speed/|this|, counterclockwise where it is positive (:func:`carom.billiards.in_magnetic_field`).
    kappa : float, optional
        Moment of inertia, I/(m a^2); any in the plane. Default: 0.5; in space 0.4.
    ball_radius : float, optional
        Radius, m. Default: 1; 0.1 where the table bounds the surface.
    law : str, Law or kernel
        no-slip, mirror, contact, rolling, another law that answers at a wall alone (of two-step the part at the wall: there is no
        floor), or a custom law, my_law.py:law.
    restitution : float, optional
        Coefficient of restitution, 0 to 1. Default: 1.
    friction : float, optional
        Friction coefficient; inf: never slips. Default: inf.
    tangential_restitution : float, optional
        Tangential restitution, -1 to 1: 0 stops the slip, 1 reverses it. Default: 0.
    at_corner : "end" or "pass"
        At a corner: end the orbit, or pass (one side, then the other).
    position : array (..., d), optional
        Of the centre at the beginning: x,y or x,y,z; m. Default: sampled.
    velocity : array (..., d), optional
        At the beginning: x,y or x,y,z; m/s. Default: sampled.
    spin : array (...) in the plane or (..., 3) in space, optional
        At the beginning, rad/s; in space x,y,z. Default: sampled, or 0.
    orbits : int
        Number of orbits, sampled from the invariant measure.
    seed : int
        Seed of the random numbers.
    lyapunov : bool
        Compute the Lyapunov spectrum.
    reverse : bool
        Run the orbits backwards, too, and measure the error.
    periodic : int, several, or text such as "2-6", optional
        Find the periodic orbits with these numbers of bounces, such as 4, 2-6 or 3,5 (:func:`carom.billiards.periodic_orbits`).
    itinerary : str or several, optional
        Find the periodic orbits that meet these walls in turn, such as ABC or AB,ABC; A is the boundary's first piece.
    starts : int
        Starts of the search for periodic orbits, for each period.
    progress : callable(done, total, text), optional
        Called with the number of bounces done, and of all.
    **sizes : optional
        Sizes of the figure, by their names, such as ``straight=2.0``; those left out are about 1 m.

    Returns
    -------
    OrbitResult

    Raises
    ------
    CaromError
        One line per problem, all problems at once.

    Examples
    --------
    >>> import carom
    >>> found = carom.orbit("stadium", 50, law="mirror", position=(0.1, 0.2), velocity=(1.0, 0.3))
    >>> int(found.count), found.position.shape
    (50, (50, 2))
    >>> carom.orbit("circle", 100, orbits=3, seed=1, lyapunov=True).spectrum.per_bounce.shape
    (3, 4)
    """
    setup, start = check_orbit(**{name: value for name, value in locals().items() if name != "sizes"}, **sizes)
    surface = _surface(law, restitution, friction, tangential_restitution)
    closed = None
    if periodic is not None or itinerary is not None:
        closed = periodic_orbits(
            setup.table,
            periodic,
            itinerary=itinerary,
            ball=setup.ball,
            law=law,
            surface=surface,
            starts=starts,
            seed=seed,
            progress=progress,
        )
    if start is None:
        start = sampled_starts(setup.table, orbits, seed, ball=setup.ball, law=law)
    found = orbit_from_setup(setup, start, bounces, progress)
    spectrum = _spectrum(found) if lyapunov else None
    parts = {one.name: getattr(found, one.name) for one in fields(found)}
    error = backwards(found)[1] if reverse else None
    return OrbitResult(**parts, spectrum=spectrum, reversal_error=error, periodic=closed)


OPTIONS: dict[str, Any] = orbit.__kwdefaults__ or {}


def _spectrum(found: Orbit) -> Lyapunov:
    return spectrum_of(found.setup, found.start, found.t.shape[-1])


def check_orbit(table: Any, bounces: int = BOUNCES, **given: Any) -> tuple[Any, Start | None]:
    """Return the validated OrbitSetup, and the initial state (None: to be sampled), of arguments of :func:`orbit`.

    Raises CaromError, one line per problem. ``table=None``: a table whose faults are known already.
    """
    faults, one = FaultList(), SimpleNamespace(**OPTIONS | given)
    sizes = {name: value for name, value in given.items() if name not in OPTIONS and value is not None}
    known = [*OPTIONS, *(name for kind in FIGURES.values() for name in kind.model_fields)]
    for name in [name for name in sizes if near_name(name, known) in OPTIONS]:
        faults.add(name, "an option or a size of the figure", f"{name!r}", did_you_mean(name, known))
        del sizes[name]
    made = None
    if table is not None:
        made = faults.attempt(_table, table, sizes, one.bounds, one.acceleration, one.magnetic_field)
    before = len(faults)
    surface = faults.attempt(_surface, one.law, one.restitution, one.friction, one.tangential_restitution)
    ball = None if made is None else faults.attempt(_ball, made, one.kappa, one.ball_radius)
    together = len(faults) == before  # else each of these faults would be reported again below
    faults.attempt(require_count, "orbit", "bounces", bounces)
    faults.attempt(require_count, "orbit", "seed", one.seed, 0)
    if one.starts != PERIODIC_STARTS and one.periodic is None and one.itinerary is None:
        faults.append(Fault(advice="`starts` has no effect without `periodic` or `itinerary`; omit it"))
    start = None if made is None else faults.attempt(_start, made, one.position, one.velocity, one.spin, one.orbits)
    setup = None
    if together:
        if made is None:
            faults.attempt(law_of, one.law, surface)
        elif (setup := faults.attempt(orbit_setup, made, ball, one.law, surface, one.at_corner)) is not None:
            if one.reverse:
                faults.attempt(require_reversible, setup)
            if start is not None:
                faults.attempt(start_rows, setup, start)
    faults.raise_if_any()
    return setup, start


def _table(table: Any, given: dict[str, Any], bounds: Any, acceleration: Any, magnetic_field: Any) -> Table:
    forces = {"acceleration": acceleration, "magnetic_field": magnetic_field}
    beside = given | {name: value for name, value in forces.items() if value is not None}
    if isinstance(table, Table) and beside:
        raise CaromError(*(f"`{name}`: has no effect on a Table, which has its sizes; omit it" for name in beside))
    made = table if isinstance(table, Table) else table_of(table, bounds=bounds, **given)
    if magnetic_field is not None:
        made = in_magnetic_field(made, magnetic_field)
    if acceleration is None:
        return made
    axis = ALONG.get(made.name)
    if axis is not None and np.ndim(acceleration) == 0:
        return under(made, [x * _vector("acceleration", acceleration, 1)[0] for x in axis])
    return under(made, _vector("acceleration", acceleration, made.dimension))


def _vector(name: str, value: Any, count: int) -> tuple[float, ...]:
    try:
        found = tuple(map(float, np.atleast_1d(value)))
    except (TypeError, ValueError):
        found = ()
    if len(found) != count:
        got = ",".join(f"{x:g}" for x in found) if found else value
        raise CaromError(f"`{name}`: expected {COUNTS[count]}, got {got!r}")
    return found


def _ball(table: Table, kappa: float | None, radius: float | None) -> Ball | None:
    if kappa is None and radius is None:
        return None
    usual = default_ball(table)
    make = Disc if table.dimension == 2 else Ball
    return make(usual.radius if radius is None else radius, 1.0, usual.kappa if kappa is None else kappa)


def _surface(law: Any, e: float | None, mu: float | None, beta: float | None) -> Surface | None:
    given = {"restitution": e, "friction": mu, "tangential_restitution": beta}
    chosen: dict[str, Any] = {key: value for key, value in given.items() if value is not None}
    found, name = law_of(law, Surface() if needs_surface(law) else None)
    if idle := [key for key in chosen if key not in found.free]:
        raise CaromError(*(f"`{key}`: law {name} does not use it; `law` contact does" for key in idle))
    return Surface(**chosen) if chosen or needs_surface(law) else None


def _start(table: Table, position: Any, velocity: Any, spin: Any, count: int) -> Start | None:
    """Return the initial state that is given; None where it is to be sampled."""
    d = table.dimension
    if (position is None) != (velocity is None):
        missing, given = ("velocity", "position") if velocity is None else ("position", "velocity")
        raise CaromError(f"`{missing}`: expected one together with `{given}`, got none")
    if position is None or velocity is None:
        if spin is not None:
            raise CaromError("`spin`: expected `position` and `velocity` with it, got none")
        require_count("orbit", "orbits", count)
        return None
    if count != 1:
        raise CaromError(f"`orbits`: expected 1 with `position`, got {count}; without it, initial states are sampled")
    states = [("position", position, d), ("velocity", velocity, d)]
    for name, value, size in [*states, *([("spin", spin, 3)] if d == 3 and spin is not None else [])]:
        if np.ndim(value) <= 1:
            _vector(name, value, size)
    return Start(position, velocity, 0.0 if spin is None else spin)
