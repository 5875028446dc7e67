"""Misuse of the Python API: every public name, given wrong things, raises a CaromError and nothing else."""

from __future__ import annotations

import ast
import importlib
import inspect
import pickle
import signal
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import carom
from carom import billiards, gas
from carom.core.jit.kernel import KERNELS

SOURCE = Path(carom.__file__).parent
PATIENCE = 60  # s: no call with wrong things may take that long


class _Strange:
    """A thing that is none of carom's."""


WRONG: dict[str, Any] = {
    "None": None, "text": "x", "number": 5, "object": _Strange(), "point": np.array(0.5), "list": [], "swapped": {"a": 1},
    "nan": float("nan"), "class": carom.Ball, "texts": ["x", "y"],
}  # fmt: skip


def public_names() -> list[tuple[str, str]]:
    """Every name in every stub that is a function or a class: (package, name)."""
    found = []
    for stub in sorted(SOURCE.rglob("__init__.pyi")):
        package = ".".join(("carom", *stub.parent.relative_to(SOURCE).parts))
        for node in ast.parse(stub.read_text(encoding="utf-8")).body:
            if isinstance(node, ast.ImportFrom) and node.module is not None:
                found += [(package, alias.name) for alias in node.names]
    return found


NAMES = [
    (package, name)
    for package, name in public_names()
    if callable(found := getattr(importlib.import_module(package), name))
    and not (inspect.isclass(found) and (issubclass(found, Exception) or inspect.isabstract(found)))
]


@contextmanager
def allowed(what: str) -> Iterator[None]:
    """CaromErrors only; a TypeError of Python's for a wrong number of arguments, or an unknown one; no endless call."""

    def late(_signal: int, _frame: Any) -> None:
        raise AssertionError(f"{what}: expected an answer, got none in {PATIENCE} s")

    before = signal.signal(signal.SIGALRM, late)
    signal.alarm(PATIENCE)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            yield
    except Exception as error:
        if isinstance(error, carom.CaromError):
            good = bool(error.faults) and all("\n" not in fault and len(fault) < 2000 for fault in error.faults)
        else:
            good = isinstance(error, TypeError) and "argument" in str(error)
        if not good:
            raise AssertionError(f"{what}: expected a CaromError, got {error!r}") from error
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)


def required(function: Callable[..., Any]) -> list[inspect.Parameter]:
    kinds = (inspect.Parameter.VAR_KEYWORD, inspect.Parameter.VAR_POSITIONAL)
    parameters = inspect.signature(function).parameters.values()
    return [one for one in parameters if one.default is one.empty and one.kind not in kinds]


def call(what: str, function: Callable[..., Any], wrong: Any, more: dict[str, Any] | None = None) -> None:
    """Call it with a wrong thing for everything that it needs."""
    needed = required(function)
    args = [wrong for one in needed if one.kind is not one.KEYWORD_ONLY]
    options = {one.name: wrong for one in needed if one.kind is one.KEYWORD_ONLY}
    with allowed(f"{what}({', '.join(map(repr, args))})"):
        function(*args, **options | (more or {}))


@pytest.fixture(autouse=True)
def elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What a call writes, in spite of all, is written to a temporary folder."""
    monkeypatch.chdir(tmp_path)


@pytest.mark.skipif(not hasattr(signal, "SIGALRM"), reason="needs SIGALRM")
@pytest.mark.parametrize(("package", "name"), NAMES, ids=".".join)
@pytest.mark.slow(keep=10)
def test_wrong_things_for_all_that_is_needed(package: str, name: str) -> None:
    public = getattr(importlib.import_module(package), name)
    for wrong in WRONG.values() if required(public) else [None]:  # (what needs nothing is called once)
        call(f"{package}.{name}", public, wrong)
    for one in inspect.signature(public).parameters.values():
        if one.default is not one.empty:
            for wrong in WRONG.values():
                call(f"{package}.{name}[{one.name}]", public, 5, {one.name: wrong})


BALL = carom.Ball()
STATE = carom.rolling(BALL)
AFTER = carom.State((1.0, 0.5, 0.2), (1.0, 2.0, 3.0))
FASTER = carom.State((-3.0, 0.5, 0.2), (1.0, 2.0, 3.0))
PLANE = {"shape": "plane", "point": (0, 0, 0), "normal": (1, 0, 0), "restitution": 0.9, "friction": 0.1}
SCENE_BALL = {"radius": 0.03, "mass": 0.2, "position": (1, 0), "velocity": (-1, 0)}


def right() -> dict[str, tuple[Callable[..., Any], dict[str, Any]]]:
    """Calls that are right, with all that they may be given."""
    scene = carom.Scene(walls=[PLANE], balls=[SCENE_BALL], gravity=0, run={"duration": 2})
    run = carom.simulate(scene)
    table, start = billiards.circle(), ((0.1, 0.2), (0.7, 0.4), 0.3)
    orbit = billiards.orbit(table, start, 20)
    some = gas.Gas([gas.Species(carom.Ball(0.5, 1.0), 30)], (6.0, 6.0, 6.0), contacts=carom.Surface(1, 0, -1))
    wall = carom.Surface(0.9, 0.2)
    hit = {"ball": BALL, "state": STATE, "normal": (1.0, 0.0, 0.0)}
    floor = {"floor": wall, "gravity": 9.8, "height": 0.0}
    pair = {
        "ball": BALL,
        "state": STATE,
        "other": BALL,
        "other_state": FASTER,
        "normal": (-1.0, 0.0, 0.0),
        "surface": wall,
    }
    return {
        "Ball": (carom.Ball, {"radius": 0.1, "mass": 1.0, "inertia": "solid"}),
        "Disc": (carom.Disc, {"radius": 0.1, "mass": 1.0, "inertia": "disc"}),
        "Surface": (carom.Surface, {"restitution": 0.9, "friction": 0.2, "tangential_restitution": 0.0}),
        "State": (carom.State, {"velocity": (1, 2, 3), "spin": (0, 0, 0), "position": None}),
        "rolling": (carom.rolling, {"ball": BALL, "velocity": (-1.0, 1.0), "spin_z": 0.0}),
        "slip": (carom.slip, {"ball": BALL, "state": STATE, "normal": (0.0, 0.0, 1.0)}),
        "kinetic_energy": (carom.kinetic_energy, {"ball": BALL, "state": STATE}),
        "impact": (carom.impact, hit | {"surface": wall}),
        "mirror": (carom.mirror, hit),
        "no_slip": (carom.no_slip, hit),
        "conventional": (carom.conventional, hit),
        "two_step": (carom.two_step, hit | floor | {"wall": wall, "floor_contact": "with"}),
        "settle": (carom.settle, hit | floor | {"state": AFTER}),
        "collide": (carom.collide, pair),
        "domenech": (carom.domenech, {"ball": BALL, "state": None, "other": BALL}),
        "incoming": (carom.incoming, {"speed": 1.0, "angle_deg": 45.0, "spin_z": 0.0, "restitution": 0.9, "friction": 0.2}),
        "compare": (carom.compare, {"meeting": carom.incoming(), "laws": ["mirror"]}),
        "SceneBall.of": (carom.SceneBall.of, {"ball": BALL, "state": carom.State((1, 0, 0), (0, 0, 0), (0, 0, 1)), "name": "a"}),
        "SceneBall": (carom.SceneBall, SCENE_BALL),
        "Plane": (carom.scene.Plane, PLANE),
        "Scene": (carom.Scene, {"walls": [PLANE], "balls": [SCENE_BALL], "gravity": 0.0, "run": {"duration": 1.0}}),
        "simulate": (carom.simulate, {"scene": scene, "progress": None}),
        "simulate_many": (
            carom.simulate_many,
            {"scene": scene, "velocity": [[-1, 0, 0]], "spin": None, "position": None, "events": 1, "kinds": ("wall",)},
        ),
        "sensitivities": (
            carom.sensitivities,
            {"scene": scene, "wrt": ["balls.0.velocity"], "velocity": [[-1, 0, 0]], "spin": None, "position": None},
        ),
        "Trajectory.at": (run.at, {"t": 0.5}),
        "Trajectory.energy": (run.energy, {"t": 0.5}),
        "Trajectory.phase": (run.phase, {"t": 0.5}),
        "Trajectory.save": (run.save, {"path": "run.parquet"}),
        "Events.of": (run.events.of, {"ball": 0}),
        "load_scene": (carom.load_scene, {"path": "none.toml", "allow_own_laws": False}),
        "load_trajectory": (carom.load_trajectory, {"path": "none.parquet", "allow_own_laws": False}),
        "orbit": (billiards.orbit, {"table": table, "start": start, "bounces": 5, "law": "no-slip", "at_corner": "end"}),
        "lyapunov": (billiards.lyapunov, {"table": table, "start": start, "bounces": 50, "law": "no-slip", "blocks": 5}),
        "tangent_map": (billiards.tangent_map, {"table": table, "start": start, "bounces": 2}),
        "starts": (billiards.starts, {"table": table, "count": 3, "seed": 1}),
        "reverse": (billiards.reverse, {"found": orbit}),
        "circle": (billiards.circle, {"radius": 1.0}),
        "stadium": (billiards.stadium, {"straight": 1.0, "radius": 1.0}),
        "polygon": (billiards.polygon, {"vertices": [(0, 0), (1, 0), (0, 1)]}),
        "Gas": (
            gas.Gas,
            {"species": [gas.Species(carom.Ball(0.5, 1.0), 20)], "side": (6.0, 6.0, 6.0), "contacts": carom.Surface(1, 0, -1),
             "gravity": (0, 0, 0), "contact_time": 0.0, "periodic": True, "drives": None, "thermostat": None, "seed": 1,
             "position": None, "velocity": None, "spin": None, "touch": 1e-9},
        ),
        "Gas.run": (some.run, {"collisions": 10, "until": 5.0, "progress": None, "chunk": 100}),
        "dense": (gas.dense, {"radius": np.full(9, 0.5), "side": (6.0, 6.0, 6.0), "periodic": True, "seed": 0}),
        "lattice": (gas.lattice, {"count": 9, "side": (6.0, 6.0, 6.0), "radius": 0.5}),
        "thermal": (
            gas.thermal, {"mass": np.ones(9), "axes": (0, 1, 2), "temperature": 1.0, "rng": np.random.default_rng(1)},
        ),
        "Species": (gas.Species, {"ball": BALL, "count": 3, "name": "a", "temperature": 1.0}),
        "Drive": (gas.Drive, {"amplitude": 0.1, "frequency": 1.0, "phase": 0.0}),
        "Measures": (gas.Measures, {"gas": some, "names": (), "container": None}),
    }  # fmt: skip


@pytest.mark.skipif(not hasattr(signal, "SIGALRM"), reason="needs SIGALRM")
def test_one_wrong_thing_among_right_ones() -> None:
    """Each argument of many calls in turn is replaced; and each by each other one of the call."""
    count = 0
    for name, (function, options) in right().items():
        if "load" not in name:
            function(**options)  # it is right as it stands
        for one in options:
            for wrong in (*WRONG.values(), *(value for other, value in options.items() if other != one)):
                with allowed(f"{name}: {one} = {wrong!r:.80}"):
                    function(**options | {one: wrong})
                count += 1
    assert count > 1500


@pytest.mark.skipif(not hasattr(signal, "SIGALRM"), reason="needs SIGALRM")
def test_methods_of_what_calls_return() -> None:
    for name, (function, options) in right().items():
        if "load" in name:
            continue
        found = function(**options)
        for thing in found if isinstance(found, tuple) else (found,):
            if type(thing).__module__.startswith("carom."):
                kept = {key for key, one in inspect.getmembers(type(thing)) if not isinstance(one, property)}
                methods = {key: getattr(thing, key) for key in kept if not key.startswith(("_", "model_"))}
                for key, method in methods.items():
                    if inspect.ismethod(method) and method.__func__ in KERNELS:  # (what compiled code calls)
                        continue
                    if inspect.ismethod(method) and method.__func__.__module__.startswith("carom."):
                        for wrong in WRONG.values():
                            call(f"{name}().{key}", method, wrong)


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: carom.mirror(BALL, STATE, surface=0.9), "mirror: surface: expected a Surface, got float 0.9"),  # type: ignore[arg-type]
        (lambda: carom.slip(STATE, BALL), "slip: ball: expected a Ball, got State "),  # type: ignore[arg-type]
        (lambda: carom.settle(BALL, None), "settle: state: expected a State, got NoneType None"),  # type: ignore[arg-type]
        (lambda: carom.SceneBall.of(5, STATE), "SceneBall.of: ball: expected a Ball, got int 5"),  # type: ignore[arg-type]
        (lambda: carom.scene.Plane(**PLANE | {"point": np.array(1.0)}), "Plane: point: expected 3 lengths in m"),
    ],
)
def test_function_argument_expectation_and_what_came(make: Callable[[], Any], said: str) -> None:
    with pytest.raises(carom.CaromError) as found:
        make()
    assert found.value.faults[0].startswith(said)


def test_what_is_the_callers_own_goes_on() -> None:
    class OwnError(Exception):
        pass

    def stop(*_progress: Any) -> None:
        raise OwnError

    scene = carom.Scene(walls=[PLANE], balls=[SCENE_BALL], gravity=0, run={"duration": 2})
    with pytest.raises(OwnError):
        carom.simulate_many(scene, velocity=[[-1, 0, 0]], progress=stop)
    with pytest.raises(TypeError, match="missing 1 required positional argument: 'state'"):
        carom.impact(BALL)  # type: ignore[call-arg]
    with pytest.raises(TypeError, match="unexpected keyword argument 'frction'; did you mean 'friction'\\?") as caught:
        carom.Surface(frction=0.2)  # type: ignore[call-arg]
    assert caught.value.__notes__ == ["Surface takes restitution, friction, tangential_restitution"]
    with pytest.raises(TypeError, match="unexpected keyword argument 'durtion'; did you mean 'duration'\\?"):
        carom.simulate(scene, durtion=3)  # type: ignore[call-overload]


def test_names_keep_signature_docstring_and_place() -> None:
    assert list(inspect.signature(carom.impact).parameters) == ["ball", "state", "normal", "surface"]
    assert (carom.impact.__doc__ or "").startswith("Compute a single contact")
    assert carom.impact.__module__ == "carom.laws.contact"
    assert pickle.loads(pickle.dumps(carom.impact)) is carom.impact
    assert inspect.isclass(carom.State)
    assert carom.gas.Gas is importlib.import_module("carom.gas.gas").Gas
