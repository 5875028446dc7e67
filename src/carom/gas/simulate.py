"""A gas, equilibrated and measured, in one call: of species in a box, or of a scene."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, overload

from carom.errors import FaultList
from carom.gas.containers import Container
from carom.gas.gas import Gas
from carom.gas.results import GasRun
from carom.gas.scene import GasScene
from carom.gas.session import Session
from carom.gas.species import Species
from carom.scene.paths import replaced

__all__ = ["simulate_gas"]


@overload
def simulate_gas(
    species: GasScene, *, collisions: int | None = None, equilibrate: int | None = None
) -> tuple[Gas, GasRun]: ...


@overload
def simulate_gas(
    species: Sequence[Species],
    side: Sequence[float] | Container,
    *,
    collisions: int,
    equilibrate: int | None = None,
    **options: Any,
) -> tuple[Gas, GasRun]: ...


def simulate_gas(
    species: Sequence[Species] | GasScene,
    side: Sequence[float] | Container | None = None,
    *,
    collisions: int | None = None,
    equilibrate: int | None = None,
    **options: Any,
) -> tuple[Gas, GasRun]:
    """Make a gas, equilibrate it, and measure the next collisions.

    Parameters
    ----------
    species : sequence of Species, or GasScene
        A scene, such as :func:`load_gas` returns, has all the rest too.
    side, **options : as for :class:`Gas`; not with a scene
    collisions : int
        Number of collisions that are measured, with walls included; default with a scene: its ``max_events`` or ``duration``.
    equilibrate : int, optional
        Number of collisions before; default: the scene's, or 40 per ball.

    Returns
    -------
    Gas, GasRun
        The gas at the end, and what was measured. Raises CaromError as :class:`Gas` and :meth:`Gas.run` do. Of a scene,
        :class:`Session` also measures distributions, g(r) and diffusion, and :func:`simulate_ensemble` gives error bars.

    Examples
    --------
    >>> from carom import Ball, Surface
    >>> from carom.gas import GasScene, Species, simulate_gas
    >>> elastic = Surface(1, 0, -1)
    >>> gas, run = simulate_gas([Species(Ball(0.5, 1.0), 64)], (6.0, 6.0, 6.0), contacts=elastic, collisions=1000)
    >>> gas.collisions, run.pair_collisions
    (3560, 1000)

    The scene of a file is run in the same way, ``simulate_gas(load_gas("gas.toml"))``:

    >>> contact = {"between": ("a", "a"), "restitution": 1, "friction": 0}
    >>> scene = GasScene(
    ...     container={"shape": "periodic", "size": (6, 6, 6)}, species=[{"count": 64, "radius": 0.5}], contacts=[contact],
    ...     run={"max_events": 2000},
    ... )
    >>> simulate_gas(scene)[1].pair_collisions, simulate_gas(scene, collisions=500)[1].pair_collisions
    (2000, 500)
    """
    if isinstance(species, GasScene):
        given = {"side": side, **options}
        return _simulate_scene(
            species, {name: x for name, x in given.items() if x is not None}, collisions, equilibrate
        )
    faults = FaultList("simulate_gas")
    if side is None:
        faults.add("side", "two or three lengths, or a container, with a list of Species", "none")
    if collisions is None:
        faults.add("collisions", "the number of collisions to measure", "none")
    faults.raise_if_any()
    assert side is not None
    gas = Gas(species, side, **options)
    gas.run(40 * sum(one.count for one in species) if equilibrate is None else equilibrate)
    return gas, gas.run(collisions)


def _simulate_scene(
    scene: GasScene, others: Mapping[str, Any], collisions: int | None, equilibrate: int | None
) -> tuple[Gas, GasRun]:
    """Run a scene, with other numbers of collisions if these are given; ``others`` are arguments that a scene excludes."""
    faults = FaultList("simulate_gas")
    for name, value in others.items():
        faults.add(name, "none beside a GasScene", f"{value!r}", "change the scene")
    faults.raise_if_any()
    run = {"run.max_events": collisions, "run.equilibrate": equilibrate}
    session = Session(replaced(scene, {path: x for path, x in run.items() if x is not None}))
    session.run()
    return session.gas, session.result
