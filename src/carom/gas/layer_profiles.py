"""Profiles across a gas with their errors: density, velocity, temperatures and fluxes in layers, from blocks of a run."""

from __future__ import annotations

import math
from dataclasses import fields
from typing import Any, NamedTuple

import numpy as np

from carom.errors import FaultList
from carom.gas.gas import Gas
from carom.gas.time_averages import LayerAverages
from carom.public.progress import Progress

__all__ = ["LayerProfiles", "layer_profiles"]

BLOCKS = 10  # of the run, for the errors
PLACES = ("axis", "edges")  # fields that are no measurements


class LayerProfiles(NamedTuple):
    """Exact means over a run, and their standard errors in the same form."""

    mean: LayerAverages
    error: LayerAverages


def layer_profiles(
    gas: Gas, collisions: int, *, blocks: int = BLOCKS, progress: Progress | None = None
) -> LayerProfiles:
    """Return the profiles of a gas between walls, or of a sheared gas, which is advanced by so many collisions.

    The means are exact (:class:`carom.gas.time_averages.LayerAverages`). Their standard errors are those of the means of the
    blocks, which should be long compared with the memory of the gas: the time in which heat crosses it.

    Parameters
    ----------
    gas : Gas
        With walls or a shear rate; in a steady state.
    collisions : int
        To measure over, those with walls included.
    blocks : int
        Into which the run is divided, at least 2.
    progress : callable(done, total, text), optional

    Returns
    -------
    LayerProfiles

    Raises
    ------
    CaromError
        For a gas without layers, too few collisions or blocks, and as :meth:`Gas.run` does.

    Examples
    --------
    >>> from carom import Ball, Surface
    >>> from carom.gas import Drive, Gas, Species, layer_profiles
    >>> surfaces = {("a", "a"): Surface(1, 0, -1), ("a", "wall"): Surface(1, 0, -1)}
    >>> gas = Gas(
    ...     [Species(Ball(0.5, 1.0), 60)], (5.0, 5.0, 12.0), periodic=(True, True, False), contacts=surfaces,
    ...     drives={"bottom": Drive(temperature=2.0), "top": Drive(temperature=1.0)}, seed=1,
    ... )
    >>> gas.advance(2000)
    >>> found = layer_profiles(gas, 20_000)
    >>> flux, error = found.mean.heat_flux[1:-1], found.error.heat_flux[1:-1]
    >>> bool((flux > 3 * error).all())  # from the warm wall at the bottom to the top
    True
    """
    faults = FaultList("layer_profiles")
    if len(gas.arrays.averages.layers) == 0:
        faults.add("gas", "a gas with walls or a shear rate", "one without")
    for name, value, least in (("blocks", blocks, 2), ("collisions", collisions, 2)):
        if isinstance(value, bool) or not isinstance(value, int | np.integer) or value < least:
            faults.add(name, f"a whole number >= {least}", f"{value!r}")
    faults.raise_if_any()
    begin, found = gas.mark(), []
    for k in range(blocks):
        layers = gas.run(max(int(collisions) // int(blocks), 1)).averages.layers
        assert layers is not None
        found.append(layers)
        if progress is not None:
            progress(k + 1, blocks, "blocks")
    mean = gas.measured_since(begin).averages.layers
    assert mean is not None

    def error(name: str) -> Any:
        values = np.array([getattr(one, name) for one in found])
        return getattr(mean, name) if name in PLACES else np.std(values, axis=0, ddof=1) / math.sqrt(blocks)

    return LayerProfiles(mean, LayerAverages(**{one.name: error(one.name) for one in fields(LayerAverages)}))
