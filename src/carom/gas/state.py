"""Requirements on the arrays of a checkpoint, checked before compiled loops use them: these check no type, length or index."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.gas.edmd.driver import BINS_PER_BALL, STATE
from carom.gas.edmd.gas_records import MOTION, NO_BALL
from carom.gas.edmd.walls import FIRST_WALL, PREDICT_AGAIN
from carom.gas.results import TOTALS
from carom.gas.scene import GasScene
from carom.gas.sizes import cells_at_most

__all__ = ["require_same_form", "require_state"]

State = Mapping[str, NDArray[Any]]
# Of the gas when the measurement began: the arrays that have the form of the gas's own.
MARKED = ("system", *TOTALS)


def require_state(scene: GasScene, state: State) -> None:
    """Raise KeyError, TypeError or ValueError where an array of a session is missing, or has another form or other contents."""
    forms = _forms(scene)
    if any(name.startswith("mark.") for name in state):
        forms |= {f"mark.{name}": forms[f"gas.{name}"] for name in MARKED}
        forms["mark.numbers"] = (np.dtype("f8"), (5,))
    for name in forms:
        if name not in state:
            raise KeyError(name)
    for name in state:  # (read from a file one at a time)
        array = state[name]
        if name in forms:
            require_same_form(name, array, *forms[name])
        _require_no_nan(name, array)
        del array
    _require_contents(scene, state)


def require_same_form(name: str, array: NDArray[Any], kind: np.dtype[Any], shape: tuple[int, ...]) -> None:
    """Raise TypeError where an array has other records, ValueError where it has another shape."""
    if array.dtype != kind and not (kind.kind == array.dtype.kind == "U"):
        raise TypeError(f"other records of {name.removeprefix('gas.')!r}")
    if array.shape != shape:
        raise ValueError(f"{name.removeprefix('gas.')!r} of shape {array.shape}, not {shape}")


def _forms(scene: GasScene) -> dict[str, tuple[np.dtype[Any], tuple[int, ...]]]:
    """Return type and shape of every array of a gas and of its session, by name."""
    balls, species, faces = scene.count, len(scene.species), len(scene.container.geometry.faces)
    count = {
        "system": 1, "motions": balls, "plans": balls + 1, "bodies": balls, "numbers": balls, "species": species,
        "pairs": species**2, "contacts": faces * species, "faces": faces,
    }  # fmt: skip
    forms: dict[str, tuple[np.dtype[Any], tuple[int, ...]]] = {
        f"gas.{name}": (kind, (count[name],)) for name, kind in STATE.items()
    }
    number, whole, text = np.dtype("f8"), np.dtype("i8"), np.dtype("U32")
    return forms | {
        "gas.names": (text, (faces,)), "gas.time": (number, (1,)), "session": (whole, (5,)), "clock": (number, (3,)),
    }  # fmt: skip


def _require_no_nan(name: str, array: NDArray[Any]) -> None:
    for field in array.dtype.names or ("",):
        values = array[field] if field else array
        if values.dtype.kind == "f" and np.isnan(values).any():
            raise ValueError(f"NaN in {name.removeprefix('gas.')!r}")


def _require_contents(scene: GasScene, state: State) -> None:
    """Raise ValueError for indices out of range, places that are not finite, counts that disagree, and another container."""
    motions, plans, bodies = (state[f"gas.{name}"] for name in ("motions", "plans", "bodies"))
    one, count = state["gas.system"][0], scene.count
    size = np.array([*scene.container.geometry.size, 1.0])[:3]
    cells, plan = one["cells"], plans[:count]
    places = np.stack([plan["cx"], plan["cy"], plan["cz"]], axis=1)
    partner, boundary = plan["partner"], plan["boundary"].astype(np.int64)
    pairs, walls = (int(one[f"{name}_collisions"]) for name in ("pair", "wall"))
    counted = {
        name: int(state[f"gas.{name}"]["collisions"].sum()) for name in ("motions", "pairs", "contacts", "faces")
    }
    first, sampled, interval, snapshots, _timed = state["session"].tolist()
    whole = {
        "numbers": np.array_equal(np.sort(state["gas.numbers"]), np.arange(count)),
        "motions": all(np.isfinite(motions[name]).all() for name in MOTION.names or () if motions[name].dtype.kind == "f")
        and bool((motions["species"] < len(scene.species)).all())
        # (a ball's number of collisions is kept modulo 2^32; a kick of the thermostat counts as one, too)
        and (counted["motions"] - 2 * pairs - walls - int(one["kicks"])) % 2**32 == 0,
        "bodies": all(np.isfinite(bodies[name]).all() for name in ("wx", "wy", "wz")),
        "session": 0 <= first <= pairs + walls and 0 <= sampled <= pairs + walls and interval >= 1 and snapshots >= 0,
        "system": (pairs, walls, walls) == tuple(counted[name] for name in ("pairs", "contacts", "faces"))
        and one["balls"] == count
        and one["species"] == len(scene.species)
        and one["bins"] == BINS_PER_BALL * count
        and one["dimensions"] == scene.container.dimensions
        and 0 <= one["bin"] <= one["bins"]
        and 0 <= one["planned"] <= count
        and cells_at_most(cells.tolist(), count) == cells.tolist()
        and np.allclose(one["side"][: len(size)], size, rtol=1e-9)
        and np.allclose(cells * one["cell_size"], one["side"], rtol=1e-9),
        "plans": bool(((places >= 0) & (places < cells)).all())
        and bool(((partner < count) | (partner == NO_BALL)).all())
        and bool(((boundary < FIRST_WALL + len(state["gas.faces"])) | (boundary == PREDICT_AGAIN)).all()),
    }  # fmt: skip
    for name, sound in whole.items():
        if not sound:
            raise ValueError(f"{name!r} with contents that no gas of this scene has")
