"""Trips of a model: through files, dumps, pickles, copies, changes of its own numbers to what they are, stores, and back."""

from __future__ import annotations

import copy
import json
import pickle
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

import carom
from carom.gas import GasScene, Session, gas_text, load_checkpoint, load_gas, save_checkpoint
from carom.scene.scene import plain_model
from carom.scene.schema import Model
from carom.scene.toml import path_match
from carom.simulation.records import set_up
from carom.sweeps import ImpactCase, OrbitCase

__all__ = ["fields_given", "leaves", "lost_trips", "same", "swept_otherwise"]

# What a model is whose number stands for others, or for what is computed anew.
FIXED = ("preset", "shape", "form", "distribution", "rack")
AXES = {
    Model: "",
    carom.Scene: "final.position",
    GasScene: "pressure",
    ImpactCase: "energy_ratio",
    OrbitCase: "bounces.count",
}


def leaves(model: Any, path: str = "") -> Iterator[tuple[str, Any]]:
    """Return the paths to all numbers, texts and choices of a model, with their values."""
    if isinstance(model, Model):
        for name in type(model).model_fields:
            yield from leaves(getattr(model, name), f"{path}.{name}" if path else name)
    elif isinstance(model, tuple):
        for i, one in enumerate(model):
            yield from leaves(one, f"{path}.{i}")
    elif model is not None:
        yield path, model


def fields_given(model: Any) -> set[tuple[type[Model], str]]:
    """Return the fields of a model and of its parts that differ from their defaults."""
    if isinstance(model, tuple):
        return set().union(*map(fields_given, model))
    if not isinstance(model, Model):
        return set()
    own = {(name, getattr(model, name), info) for name, info in type(model).model_fields.items()}
    found = {(type(model), name) for name, value, info in own if repr(value) != repr(info.default)}
    return found.union(*(fields_given(value) for _name, value, _info in own))


def same(one: Any, two: Any) -> bool:
    """Whether two models are the same: equal, to the sign of zeros, with one hash; of scenes also the records of the loop."""
    alike = type(one) is type(two) and one == two and hash(one) == hash(two) and repr(one) == repr(two)
    if alike and isinstance(one, carom.Scene):
        pairs = zip(set_up(one), set_up(two), strict=True)
        return all(a.tobytes() == b.tobytes() for a, b in pairs)
    return alike


def _changed(model: Any) -> Iterator[tuple[str, Any]]:
    """Return the model with each of its numbers set to what it is: one by one for some, and all at once."""
    found = [(path, value) for path, value in leaves(model) if not set(path.split(".")) & set(FIXED)]
    struck = [path for path, _value in found if ".strike." in path]
    found = [
        (path, value) for path, value in found if not (struck and path.split(".")[2:3] in (["velocity"], ["rolling"]))
    ]
    laid = isinstance(model, carom.Scene) and model.rack is not None and model.rack.gap is not None
    found = [(path, value) for path, value in found if not (laid and ".position" in path)]
    yield "all at once", lambda: carom.replaced(model, dict(found))
    for path, value in found[:: max(len(found) // 3, 1)]:
        yield path, lambda path=path, value=value: carom.replaced(model, {path: value})


def _run(scene: carom.Scene, path: Path) -> Any:
    try:
        run = carom.simulate(scene)
    except carom.CaromError:  # (a law has no answer)
        return scene
    again = carom.load_trajectory(run.save(path))
    assert again.log.tobytes() == run.log.tobytes() == carom.simulate(again.scene).log.tobytes()
    assert (again.end, again.ended) == (run.end, run.ended)
    return again.scene


def _resumed(scene: GasScene, path: Path) -> Any:
    session = Session(scene)
    save_checkpoint(session, path)
    again = load_checkpoint(path)
    for one in (session, again):
        one.gas.run(20)
    balls = [vars(one.gas.balls()).values() for one in (session, again)]
    assert all(np.array_equal(a, b) for a, b in zip(*balls, strict=True))
    return load_checkpoint(path, scene).scene


def _swept(model: Any, path: Path) -> Any:
    """Return the subject of the store of a sweep over one of its numbers, opened again."""
    numbers = [
        at for at, value in leaves(model) if isinstance(value, float) and np.isfinite(value) and "rack" not in at
    ]
    for at in numbers:
        try:
            space = carom.Space(model, {at: [path_match(model, at).values[0]]})
            made = carom.sweep(space, [AXES[type(model)]], path)
        except carom.CaromError as error:
            if "place follows from rack.gap" in str(error):
                continue
            raise
        made.prepare()
        again = carom.sweep(path)
        assert again.specification["identity"] == made.specification["identity"]
        subject: Any = again.space.subject
        return next(value for value in vars(subject).values() if isinstance(value, type(model)))
    return model


def _trips(model: Any, folder: Path, stores: bool) -> Iterator[tuple[str, Callable[[], Any]]]:
    kind = type(model)
    yield "dump", lambda: kind(**model.model_dump())
    yield "JSON", lambda: kind(**json.loads(json.dumps(plain_model(model))))
    yield "pickle", lambda: pickle.loads(pickle.dumps(model))
    yield "copy", lambda: copy.copy(model)
    yield "deep copy", lambda: copy.deepcopy(model)
    yield from _changed(model)
    if kind is carom.Scene:
        yield "scene file", lambda: carom.load_scene(carom.save_scene(model, folder / "scene.toml"))
        yield "saved run", lambda: _run(model, folder / "run.parquet")
    if kind is GasScene:
        yield "gas file", lambda: load_gas(gas_text(model))
        if stores:
            yield "checkpoint", lambda: _resumed(model, folder / "gas.npz")
    if stores:
        yield "store", lambda: _swept(model, folder / "sweep.zarr")


def lost_trips(model: Any, folder: Path, stores: bool = True) -> list[str]:
    """Return the trips from which a model does not come back as it was, and why: none."""
    found = []
    folder.mkdir(exist_ok=True)
    for name, trip in _trips(model, folder, stores):
        try:
            again = trip()
            if not same(model, again):
                other = dict(leaves(again))
                found.append(
                    f"{name}: {[(at, x, other.get(at)) for at, x in leaves(model) if repr(x) != repr(other.get(at))][:3]}"
                )
        except (carom.CaromError, AssertionError, TypeError, ValueError, KeyError) as error:
            found.append(f"{name}: {type(error).__name__} {str(error)[:300]}")
    return found


def swept_otherwise(scene: carom.Scene, path: str, values: list[float]) -> int:
    """Return at how many values of a number a sweep gives another final state than a run of the scene with that number."""
    keep = ["final.position", "final.velocity", "final.spin"]
    found = carom.sweep(carom.Space(scene, {path: values}), keep).run()
    count = 0
    for k, value in enumerate(values):
        swept = [found[name].values.reshape(len(values), len(scene.balls), 3)[k] for name in keep]
        try:
            final = carom.simulate(carom.replaced(scene, {path: value})).final
            alone = [final.position, final.velocity, final.spin]
        except carom.CaromError:
            alone = [np.full((len(scene.balls), 3), np.nan)] * 3
        count += any(one.tobytes() != two.tobytes() for one, two in zip(swept, alone, strict=True))
    return count
