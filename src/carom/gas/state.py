"""States: a gas, its session and what was measured, as arrays, of which each is made again with the same bits.

Of arrays that come from a file, all types, lengths and contents are checked before compiled loops use them: these check none.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.gas.edmd.driver import BINS_PER_BALL, STATE
from carom.gas.edmd.gas_records import MOTION, NO_BALL
from carom.gas.edmd.walls import FIRST_WALL, PREDICT_AGAIN
from carom.gas.gas import Gas
from carom.gas.measures import MAX_FOLLOWED, SERIES, Measures
from carom.gas.results import TOTALS, Mark
from carom.gas.scene import GasScene
from carom.gas.sizes import cells_at_most
from carom.gas.spatial_profiles import layer_axis

__all__ = ["State", "course_as_arrays", "gas_of_arrays", "require_state", "set_course"]

State = dict[str, NDArray[Any]]
Arrays = Mapping[str, NDArray[Any]]
# What a session keeps of its course, beside the gas and its measures: whole numbers, and times.
COUNTS = ("first_collision", "last_sample_collisions", "sample_interval", "snapshots_taken", "snapshots_by_time")
CLOCK = ("sample_due", "last_sample_time", "snapshot_due")
# What measures count, and what their profiles count.
MEASURED = (
    "velocity_counts", "spin_counts", "fourth_moments", "temperatures", "pair_counts", "expected_pairs", "samples",
    "pair_samples", "rows", "followed",
)  # fmt: skip
PROFILED = (
    "profile_counts", "profile_heat", "profile_centers", "profile_inner", "profile_samples", "profile_pair_samples",
)  # fmt: skip
# Of the gas when the measurement began: the arrays that have the form of the gas's own.
MARKED = ("system", *TOTALS)


# --- as arrays -----------------------------------------------------------------------------------------------------


def course_as_arrays(session: Any) -> State:
    """Return the state of a :class:`carom.gas.Session` without its gas."""
    found = {
        "session": np.array([getattr(session, name) for name in COUNTS], np.int64),
        "clock": np.array([getattr(session, name) for name in CLOCK]),
    }
    if session.mark is not None and session.measures is not None:
        mark, measures = session.mark, session.measures
        # (the processor time that the measurement has taken so far)
        numbers = np.array([*mark.energy, mark.time, session.result.cpu_seconds])
        begun = {"system": np.array([mark.system]), "numbers": numbers} | {name: getattr(mark, name) for name in TOTALS}
        found |= _named("mark.", begun) | _named("measures.", _counted(measures, MEASURED))
        if measures.profiles is not None:
            found |= _named("measures.", _counted(measures.profiles, PROFILED))
    return found


def _named(prefix: str, arrays: Arrays) -> State:
    return {prefix + name: array for name, array in arrays.items()}


def _counted(one: Any, names: tuple[str, ...]) -> State:
    return {name: np.array(getattr(one, name)) for name in names}


# --- from arrays ---------------------------------------------------------------------------------------------------


class _Part(Mapping[str, NDArray[Any]]):
    """The arrays whose names have a prefix, by the rest of the name; none is read before it is asked for."""

    def __init__(self, state: Arrays, prefix: str) -> None:
        self._state, self._prefix = state, prefix

    def __getitem__(self, name: str) -> NDArray[Any]:
        return self._state[self._prefix + name]

    def __iter__(self) -> Iterator[str]:
        return (name.removeprefix(self._prefix) for name in self._state if name.startswith(self._prefix))

    def __len__(self) -> int:
        return sum(1 for _ in self)


def gas_of_arrays(state: Arrays) -> Gas:
    """Return the gas in the state of a session."""
    return Gas.restore(_Part(state, "gas."))


def set_course(session: Any, state: Arrays) -> None:
    """Give a :class:`carom.gas.Session` that has its scene and its gas the rest of a state."""
    for names, kind in ((COUNTS, int), (CLOCK, float)):
        for name, value in zip(names, state["session" if kind is int else "clock"], strict=True):
            setattr(session, name, kind(value))
    session.mark, session.measures = None, None
    if (begun := _Part(state, "mark.")) and (counted := _Part(state, "measures.")):
        *energy, time, cpu = map(float, begun["numbers"])
        totals = (begun[name] for name in TOTALS)
        began = session.gas.cpu_seconds - cpu
        session.mark = Mark._make((begun["system"][0], *totals, (energy[0], energy[1], energy[2]), time, began))
        session.measures = Measures(session.gas, session.names, session.scene.container.geometry)
        _set_measures(session.measures, session.gas, counted)


def _set_measures(measures: Measures, gas: Gas, state: Arrays) -> None:
    """Let measures continue from what was counted."""
    samples = len(state["rows"])
    free = {"rows": (samples, len(SERIES)), "temperatures": (samples, len(measures.names), 2)}
    if samples == 0:
        free = dict.fromkeys(free, (0,))
    free["followed"] = state["followed"].shape
    _take(measures, MEASURED, state, free)
    moved = (samples, min(len(gas.arrays.balls.motions), MAX_FOLLOWED), measures.dimensions)
    if state["followed"].shape != (moved if measures.has_diffusion and samples else (0,)):
        raise ValueError(f"'followed' of shape {state['followed'].shape}, not {moved}")
    measures.rows = [tuple(row) for row in state["rows"].reshape(-1, len(SERIES)).tolist()]
    measures.followed, measures.temperatures = list(state["followed"]), list(state["temperatures"])
    # (the state of an earlier version has no profiles: their counts begin anew)
    if measures.profiles is not None and any(name in state for name in PROFILED):
        _take(measures.profiles, PROFILED, state, {})


def _take(one: Any, names: tuple[str, ...], state: Arrays, free: Mapping[str, tuple[int, ...]]) -> None:
    """Set attributes from arrays of the form that they have, or that ``free`` gives: numbers as whole numbers."""
    for name in names:
        fresh = np.array(getattr(one, name))
        require_same_form(name, state[name], fresh.dtype, free.get(name, fresh.shape))
    for name in names:
        setattr(one, name, int(state[name]) if isinstance(getattr(one, name), int) else state[name].copy())


# --- requirements --------------------------------------------------------------------------------------------------


def require_state(scene: GasScene, state: Arrays) -> None:
    """Raise KeyError, TypeError or ValueError where an array of a session is missing, or has another form or other contents."""
    forms, species = _forms(scene, state), len(scene.groups)
    if any(name.startswith("mark.") for name in state):
        forms |= {f"mark.{name}": forms[f"gas.{name}"] for name in MARKED}
        forms["mark.numbers"] = (np.dtype("f8"), (5,))
    for name in forms:
        # (the state of an earlier version has no curves, and no classes of radii)
        absent = (name in {"gas.curves", "gas.shear"} and forms[name][1] == (0,)) or (
            name == "gas.groups" and species == len(scene.species)
        )
        if name not in state and not absent:
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


def _forms(scene: GasScene, state: Arrays) -> dict[str, tuple[np.dtype[Any], tuple[int, ...]]]:
    """Return type and shape of every array of a gas and of its session, by name."""
    balls, species, faces = scene.count, len(scene.groups), len(scene.container.geometry.faces)
    count = {
        "system": 1, "motions": balls, "plans": balls + 1, "bodies": balls, "numbers": balls, "species": species,
        "pairs": species**2, "pair_forms": species**2, "contacts": faces * species, "contact_forms": faces * species,
        "faces": faces, "whole": 1, "flows": species,
        "layers": _layers(state) * species,
        "curves": scene.container.geometry.curves.size,
        "shear": int(scene.shear_rate != 0),
    }  # fmt: skip
    forms: dict[str, tuple[np.dtype[Any], tuple[int, ...]]] = {
        f"gas.{name}": (kind, (count[name],)) for name, kind in STATE.items()
    }
    number, whole, text = np.dtype("f8"), np.dtype("i8"), np.dtype("U32")
    return forms | {
        "gas.names": (text, (faces,)), "gas.time": (number, (1,)), "gas.groups": (whole, (species,)), "session": (whole, (5,)),
        "clock": (number, (3,)),
    }  # fmt: skip


def _layers(state: Arrays) -> int:
    """Return the number of layers of a gas across its axis, whose number is compared with the scene's later; 0 without walls."""
    for name in ("system", "whole"):
        require_same_form(name, state[f"gas.{name}"], STATE[name], (1,))
    axis = int(state["gas.whole"][0]["axis"])
    return int(state["gas.system"][0]["cells"][axis]) if axis in range(3) else 0


def _require_no_nan(name: str, array: NDArray[Any]) -> None:
    for field in array.dtype.names or ("",):
        values = array[field] if field else array
        if values.dtype.kind == "f" and np.isnan(values).any():
            raise ValueError(f"NaN in {name.removeprefix('gas.')!r}")


def _require_contents(scene: GasScene, state: Arrays) -> None:
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
    driven = {drive.wall for drive in scene.drives}
    axis = layer_axis(scene.container.geometry, one["gravity"].tolist(), driven, scene.shear_rate != 0)
    first, sampled, interval, snapshots, _timed = state["session"].tolist()
    whole = {
        "numbers": np.array_equal(np.sort(state["gas.numbers"]), np.arange(count)),
        "motions": all(np.isfinite(motions[name]).all() for name in MOTION.names or () if motions[name].dtype.kind == "f")
        and bool((motions["species"] < len(scene.groups)).all())
        # (a ball's number of collisions is kept modulo 2^32; a kick of the thermostat counts as one, too)
        and (counted["motions"] - 2 * pairs - walls - int(one["kicks"])) % 2**32 == 0,
        "whole": int(state["gas.whole"][0]["axis"]) == axis,
        "groups": np.array_equal(state.get("gas.groups", scene.groups), scene.groups),
        "shear": all(one["rate"] == scene.shear_rate for one in state.get("gas.shear", ())),
        "curves": np.array_equal(state.get("gas.curves", np.empty(0)), scene.container.geometry.curves.ravel()),
        "bodies": all(np.isfinite(bodies[name]).all() for name in ("wx", "wy", "wz")),
        "session": 0 <= first <= pairs + walls and 0 <= sampled <= pairs + walls and interval >= 1 and snapshots >= 0,
        "system": (pairs, walls, walls) == tuple(counted[name] for name in ("pairs", "contacts", "faces"))
        and one["balls"] == count
        and one["species"] == len(scene.groups)
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
