"""States: a gas, its session and what was measured, as arrays, of which each is made again with the same bits.

Of arrays that come from a file, all types, lengths and contents are checked before compiled loops use them: these check none.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import MAX_MAGNITUDE
from carom.gas.build import records_of
from carom.gas.edmd.driver import BINS_PER_BALL, STATE, SystemRecords
from carom.gas.edmd.gas_records import NO_BALL
from carom.gas.edmd.walls import FIRST_WALL, PREDICT_AGAIN
from carom.gas.gas import Gas
from carom.gas.measures import MAX_FOLLOWED, SERIES, Measures
from carom.gas.results import TOTALS, Mark
from carom.gas.scene import GasScene
from carom.gas.sizes import LONGEST_SIDE

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
    if measures.profiles is not None:
        _take(measures.profiles, PROFILED, state, {})


def _take(one: Any, names: tuple[str, ...], state: Arrays, free: Mapping[str, tuple[int, ...]]) -> None:
    """Set attributes from arrays of the form that they have, or that ``free`` gives: numbers as whole numbers."""
    for name in names:
        fresh = np.array(getattr(one, name))
        require_same_form(name, state[name], fresh.dtype, free.get(name, fresh.shape))
    for name in names:
        setattr(one, name, int(state[name]) if isinstance(getattr(one, name), int) else state[name].copy())


# --- requirements --------------------------------------------------------------------------------------------------

# What changes while a gas runs, of records that the scene makes, and of the system what does not.
TOTAL = ("collisions", "lost_normal", "lost_tangential", "to_spin")
CHANGES = {
    "species": (), "pairs": TOTAL, "pair_forms": (), "contacts": TOTAL, "contact_forms": (), "shear": ("offset",), "curves": (),
    "faces": ("start", "offset", "speed", "since", "stop", "collisions", "impulse", "energy"),
}  # fmt: skip
FIXED = (
    "side", "periodic", "cells", "cell_size", "dimensions", "gravity", "contact_time", "volume", "scale", "growth", "key", "rate",
    "temperature", "spin_temperature",
)  # fmt: skip
MAY_BE_INFINITE = {
    "event_time",
    "collision_time",
    "last_contact",
    "stop",
    "reach",
    "overlap",
    "mu",
    "low",
    "high",
    "clock",
}
MAY_BE_NEGATIVE = {"axis", "rotor", "image", "key"}
SQUARED = {"motions", "bodies", "frame"}
OUTSIDE = 1e-6  # of a cell, by which rounding may have a ball outside its own


def require_state(scene: GasScene, state: Arrays) -> None:
    """Raise KeyError, TypeError or ValueError where an array of a session is missing, or has another form or other contents."""
    records, groups = records_of(scene)
    forms = _forms(scene, records)
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
        _require_numbers(name.removeprefix("gas."), array)
        del array
    for name, changing in CHANGES.items():
        own = getattr(records, name)
        fields = [field for field in own.dtype.names or ("",) if field not in changing]
        for part in ("gas.", "mark."):  # (most are absent in a mark)
            _require_the_scenes(state.get(part + name, own.ravel()), name, own, fields)
    _require_the_scenes(state["gas.system"], "system", records.system, FIXED)
    _require_the_scenes(state["gas.whole"], "whole", records.whole, ("axis",))
    _require_the_scenes(state["gas.groups"], "groups", groups, ("",))
    _require_contents(scene, state, records.system[0])


def require_same_form(name: str, array: NDArray[Any], kind: np.dtype[Any], shape: tuple[int, ...]) -> None:
    """Raise TypeError where an array has other records, ValueError where it has another shape."""
    if array.dtype != kind and not (kind.kind == array.dtype.kind == "U"):
        raise TypeError(f"other records of {name.removeprefix('gas.')!r}")
    if array.shape != shape:
        raise ValueError(f"{name.removeprefix('gas.')!r} of shape {array.shape}, not {shape}")


def _forms(scene: GasScene, records: SystemRecords) -> dict[str, tuple[np.dtype[Any], tuple[int, ...]]]:
    """Return type and shape of every array of a gas and of its session, by name."""
    count = {name: getattr(records, name).size for name in records._fields}
    count |= dict.fromkeys(("motions", "bodies", "numbers"), scene.count) | {"plans": scene.count + 1}
    number, whole, text = np.dtype("f8"), np.dtype("i8"), np.dtype("U32")
    return {f"gas.{name}": (kind, (count[name],)) for name, kind in STATE.items()} | {
        "gas.names": (text, (len(records.faces),)), "gas.time": (number, (1,)), "gas.groups": (whole, (len(records.species),)),
        "session": (whole, (5,)), "clock": (number, (3,)),
    }  # fmt: skip


def _require_numbers(name: str, array: NDArray[Any]) -> None:
    """Raise ValueError for numbers that can be in no state: NaN, infinite ones, negative counts."""
    for field in array.dtype.names or ("",):
        values, what = array[field] if field else array, field or name
        if values.dtype.kind == "f" and not np.isfinite(values).all():
            if np.isnan(values).any() or what not in MAY_BE_INFINITE:
                raise ValueError(f"{name!r} with {what} that is {'NaN' if np.isnan(values).any() else 'infinite'}")
        elif (
            (name in SQUARED or what in SQUARED) and values.dtype.kind == "f" and (np.abs(values) > MAX_MAGNITUDE).any()
        ):
            raise ValueError(f"{name!r} with {what} beyond {MAX_MAGNITUDE:g}")
        elif values.dtype.kind == "i" and what not in MAY_BE_NEGATIVE and (values < 0).any():
            raise ValueError(f"{name!r} with {what} below 0")


def _require_the_scenes(given: NDArray[Any], name: str, own: NDArray[Any], fields: Iterable[str]) -> None:
    """Raise ValueError where fields of an array are not as the scene makes them."""
    for field in fields:
        if not np.array_equal(given[field] if field else given, own[field] if field else own.ravel()):
            raise ValueError(f"{name!r} with {field or 'numbers'} that no gas of this scene has")


def _require_contents(scene: GasScene, state: Arrays, own: Any) -> None:
    """Raise ValueError for indices out of range, balls outside their cells, times and counts that disagree."""
    motions, plans = state["gas.motions"], state["gas.plans"][: scene.count]
    one, count, now = state["gas.system"][0], scene.count, float(state["gas.system"][0]["now"])
    partner, boundary = plans["partner"], plans["boundary"].astype(np.int64)
    pairs, walls = (int(one[f"{name}_collisions"]) for name in ("pair", "wall"))
    counted = {
        name: int(state[f"gas.{name}"]["collisions"].sum()) for name in ("motions", "pairs", "contacts", "faces")
    }
    first, sampled, interval, *_snapshots = state["session"].tolist()
    time, clock = float(state["gas.time"][0]), state["clock"]
    planned = plans[: one["planned"]]
    first_event = float(planned["event_time"].min(initial=math.inf)) if len(planned) == count else math.inf
    slack = 1e-9 * (abs(now) + float(one["base"]))
    whole = {
        "numbers": np.array_equal(np.sort(state["gas.numbers"]), np.arange(count)),
        "motions": bool((motions["species"] < len(scene.groups)).all() and (motions["time"] <= now + slack).all())
        # (a ball's number of collisions is kept modulo 2^32; a kick of the thermostat counts as one, too)
        and (counted["motions"] - 2 * pairs - walls - int(one["kicks"])) % 2**32 == 0,
        "session": first <= pairs + walls and sampled <= pairs + walls and interval >= 1,
        "clock": bool((clock >= 0).all()) and clock[1] <= time,
        "time": time >= 0 and time - float(one["base"]) - float(one["rest"]) <= first_event + slack,
        "system": (pairs, walls, walls) == tuple(counted[name] for name in ("pairs", "contacts", "faces"))
        and one["balls"] == count
        and one["species"] == len(scene.groups)
        and one["bins"] == BINS_PER_BALL * count
        and one["bin"] <= one["bins"]
        and one["planned"] <= count
        and bool((one["free"] <= 1).all())
        and min(now, one["base"], one["threshold"], one["progress_time"]) >= 0
        and (len(planned) < count or one["bin_width"] > 0),
        "plans": bool(((partner < count) | (partner == NO_BALL)).all())
        and bool(((boundary < FIRST_WALL + len(state["gas.faces"])) | (boundary == PREDICT_AGAIN)).all())
        and bool((planned["event_time"] >= now - slack).all())
        and _in_their_cells(motions, plans, own, np.full(count, now))
        and _in_their_cells(motions[: len(planned)], planned, own, planned["event_time"]),
    }  # fmt: skip
    for name, sound in whole.items():
        if not sound:
            raise ValueError(f"{name!r} with contents that no gas of this scene has")


def _in_their_cells(motions: NDArray[Any], plans: NDArray[Any], own: Any, t: NDArray[Any]) -> bool:
    """Return whether all balls are, at times (N,), in the cells that they are entered in; at no time only balls at rest may be."""
    s = np.where(np.isinf(t), 0.0, t - motions["time"])
    for k, axis in enumerate("xyz"):
        cell, v, g = plans["c" + axis], motions["v" + axis], float(own["gravity"][k])
        with np.errstate(over="ignore", invalid="ignore"):
            place = (motions[axis] + (v + g / 2 * s) * s) / own["cell_size"][k] - cell
        # (a wall that moves may let balls out of the box: a piston that nothing holds, far out)
        last = own["cells"][k] - 1
        room = OUTSIDE + np.where((own["periodic"][k] == 0) & ((cell == 0) | (cell == last)), LONGEST_SIDE, 0)
        inside = (place >= -room) & (place <= 1 + room) & (cell <= last) & (cell >= 0)
        if not (inside & (np.isfinite(t) | ((v == 0) & (g == 0)))).all():
            return False
    return True
