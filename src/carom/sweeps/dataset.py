"""Results of sweeps as labelled arrays: an ``xarray.Dataset`` with coordinates, units and attributes."""

from __future__ import annotations

import json
import warnings
from collections import Counter
from typing import Any

import numpy as np

from carom.files import import_optional
from carom.formatting import counted, format_number
from carom.sweeps.outcomes import FAILED, FAILURES, Outcome

__all__ = ["dataset_of", "first_failures", "open_dataset"]

LOOKED_AT = 100  # points without an outcome


def _attributes(sweep: Any) -> dict[str, Any]:
    about = sweep.specification
    found = {name: about[name] for name in ("identity", "sources", "seed", "repeats")}
    versions = {f"{name}_version": version for name, version in about["versions"].items()}
    return {"specification": json.dumps(about, sort_keys=True), **found, **versions}


def _about(outcome: Outcome) -> dict[str, Any]:
    found: dict[str, Any] = {} if outcome.units == "1" else {"units": outcome.units}
    if outcome.meanings:
        found |= {"flag_values": list(range(len(outcome.meanings))), "flag_meanings": list(outcome.meanings)}
    return found


def _coordinates(sweep: Any) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for one in sweep.space.coordinates:
        about = {"path": one.path, **({"units": one.units} if one.units != "1" else {})}
        found[one.name] = (one.dims, one.values, about)
    for outcome in sweep.outcomes:
        for dim, labels in outcome.dims.items():
            found.setdefault(dim, ((dim,), np.array(labels)))
    return found


def dataset_of(sweep: Any, values: dict[str, Any]) -> Any:
    """Return the result as an ``xarray.Dataset``; ``values`` by name have the shape of the space, and then their own."""
    xarray = import_optional("xarray", "sweep")
    dims = tuple(sweep.space.dims)
    variables = {one.name: ((*dims, *one.dims), values[one.name], _about(one)) for one in sweep.outcomes}
    variables[FAILED] = (dims, values[FAILED], _about(Outcome(FAILED, "i1", meanings=FAILURES)))
    return xarray.Dataset(variables, _coordinates(sweep), _attributes(sweep))


def open_dataset(sweep: Any) -> Any:
    """Return the result in a store as an ``xarray.Dataset``, whose values are read when they are used."""
    xarray = import_optional("xarray", "sweep")
    assert sweep.store is not None
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message=".*onsolidated metadata.*")
        found = xarray.open_dataset(sweep.store.place, engine="zarr", chunks=None, mask_and_scale=False)
    # (names are numbers in a store)
    found = found[[*(one.name for one in sweep.outcomes), FAILED]].assign_coords(_coordinates(sweep))
    del found.attrs["carom"]  # (which is in "specification", as text)
    return found.assign_attrs(_attributes(sweep))


def first_failures(sweep: Any, most: int) -> list[str]:
    """Return the first points without an outcome, by their parameters, and why each one has none; repeats are counted."""
    codes = open_dataset(sweep)[FAILED].values
    shown: Counter[str] = Counter()
    for place in np.argwhere(codes > 0)[:LOOKED_AT]:
        index = int(np.ravel_multi_index(tuple(place), codes.shape)) if codes.shape else 0
        values = sweep.space.columns(index, index + 1)
        point = ", ".join(f"{path} = {_words(value)}" for path, value in values.items())
        line = f"{point}: {sweep.why(*place)}"
        if line in shown or len(shown) < most:
            shown[line] += 1
    left = int((codes > 0).sum()) - shown.total()
    lines = [line if count == 1 else f"{line} ({count:,} times)" for line, count in shown.items()]
    return [*lines, f"and {counted(left, 'more point')}"] if left else lines


def _words(value: Any) -> str:
    return ", ".join(format_number(x, 6) if isinstance(x, int | float) else str(x) for x in np.ravel(value).tolist())
