"""A gas, equilibrated and measured, in one call: of species in a box, or of a scene."""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any, overload

from carom.errors import FaultList
from carom.gas.build import load_gas
from carom.gas.containers import Container
from carom.gas.ensembles import Ensemble, simulate_ensemble
from carom.gas.gas import Gas
from carom.gas.results import GasRun
from carom.gas.scene import GasScene
from carom.gas.session import Session
from carom.gas.species import Species
from carom.public.progress import Progress
from carom.scene.paths import replaced

__all__ = ["simulate_gas"]


@overload
def simulate_gas(
    species: GasScene | str | Path,
    *,
    max_events: int | None = None,
    duration: float | str | None = None,
    seed: int | None = None,
    ensemble: None = None,
    equilibrate: int | None = None,
    from_time: float | str | None = None,
    progress: Progress | None = None,
) -> tuple[Gas, GasRun]: ...


@overload
def simulate_gas(
    species: GasScene | str | Path,
    *,
    max_events: int | None = None,
    duration: float | str | None = None,
    seed: int | None = None,
    ensemble: int,
    equilibrate: int | None = None,
    from_time: float | str | None = None,
    progress: Progress | None = None,
) -> Ensemble: ...


@overload
def simulate_gas(
    species: Sequence[Species],
    side: Sequence[float] | Container,
    *,
    max_events: int,
    equilibrate: int | None = None,
    **options: Any,
) -> tuple[Gas, GasRun]: ...


def simulate_gas(
    species: Sequence[Species] | GasScene | str | Path,
    side: Sequence[float] | Container | None = None,
    *,
    max_events: int | None = None,
    duration: float | str | None = None,
    seed: int | None = None,
    ensemble: int | None = None,
    equilibrate: int | None = None,
    from_time: float | str | None = None,
    progress: Progress | None = None,
    **options: Any,
) -> tuple[Gas, GasRun] | Ensemble:
    """Make a gas, equilibrate it, and measure the next collisions.

    Parameters
    ----------
    species : path, GasScene, or sequence of Species
        A scene, as a file or as :func:`load_gas` returns it, has all the rest too.
    side, **options : as for :class:`Gas`; not with a scene
    max_events : int
        Number of collisions that are measured, with walls included; default with a scene: its own, or its duration.
    duration : float or str, optional
        Of a scene: time that is measured.
    seed : int, optional
        Of the random numbers. Default: the scene's.
    ensemble : int, optional
        Of a scene: simulate so many independent gases, on all cores, as :func:`simulate_ensemble` does.
    equilibrate : int, optional
        Number of collisions before; default: the scene's, or 40 per ball.
    from_time : float or str, optional
        Of a scene: simulated time before which nothing is measured; all means are then over the time after it.
    progress : callable(done, total, text), optional
        Of a scene: called some ten times per second with the number of collisions so far, and of all (NaN: not known).

    Returns
    -------
    Gas, GasRun; with ``ensemble`` an Ensemble
        The gas at the end, and what was measured. Raises CaromError as :class:`Gas` and :meth:`Gas.run` do. Of a scene,
        :class:`Session` also measures distributions, g(r) and diffusion, and :func:`simulate_ensemble` gives error bars.

    Examples
    --------
    >>> from carom import Ball, Surface
    >>> from carom.gas import GasScene, Species, simulate_gas
    >>> elastic = Surface(1, 0, -1)
    >>> gas, run = simulate_gas([Species(Ball(0.5, 1.0), 64)], (6.0, 6.0, 6.0), contacts=elastic, max_events=1000)
    >>> gas.collisions, run.pair_collisions
    (3560, 1000)

    The scene of a file is run in the same way, ``simulate_gas(load_gas("gas.toml"))``:

    >>> contact = {"between": ("a", "a"), "restitution": 1, "friction": 0}
    >>> scene = GasScene(
    ...     container={"shape": "periodic", "size": (6, 6, 6)}, species=[{"count": 64, "radius": 0.5}], contacts=[contact],
    ...     run={"max_events": 2000},
    ... )
    >>> simulate_gas(scene)[1].pair_collisions, simulate_gas(scene, max_events=500)[1].pair_collisions
    (2000, 500)
    """
    faults = FaultList("simulate_gas")
    if isinstance(species, str | os.PathLike):
        species = load_gas(species)
    if isinstance(species, GasScene):
        run = {
            "max_events": max_events,
            "equilibrate": equilibrate,
            "duration": duration,
            "seed": seed,
            "from_time": from_time,
        }
        for name, value in {"side": side, **options}.items():
            if value is not None:
                faults.add(name, "none beside a GasScene", f"{value!r}", "change the scene")
        faults.raise_if_any()
        scene = replaced(species, {f"run.{name}": x for name, x in run.items() if x is not None})
        if ensemble is None:
            return _simulate_scene(scene, progress)
        return simulate_ensemble(scene, ensemble, progress=progress)
    if not isinstance(species, list | tuple) or not all(isinstance(one, Species) for one in species):
        wanted = "a scene (the name of a file, or a GasScene), or a list of Species"
        faults.add("species", wanted, f"{type(species).__name__} {species!r:.60}")
        faults.raise_if_any()
    for name, value in {"duration": duration, "ensemble": ensemble, "from_time": from_time}.items():
        if value is not None:
            faults.add(name, "a scene, to which it belongs", "a list of Species", "omit it")
    if side is None:
        faults.add("side", "two or three lengths, or a container, with a list of Species", "none")
    if max_events is None:
        faults.add("max_events", "the number of collisions to measure", "none")
    faults.raise_if_any()
    assert side is not None
    assert max_events is not None
    given: dict[str, Any] = options if seed is None else {**options, "seed": seed}
    gas = Gas(species, side, **given)
    gas.run(40 * sum(one.count for one in species) if equilibrate is None else equilibrate)
    return gas, gas.run(max_events)


def _simulate_scene(scene: GasScene, progress: Progress | None) -> tuple[Gas, GasRun]:
    most = scene.run.max_events
    total = math.nan if most is None else scene.equilibrate + most
    session = Session(scene)
    session.run(progress=progress and (lambda *_: progress(session.gas.collisions, total, "collisions")))
    return session.gas, session.result
