"""Loops of the package: of today's kernels, with the same bits as Python, and Numba's wherever they are not for the case."""

from __future__ import annotations

import ast
import copy
import functools
import importlib
import json
import math
import os
import platform
import re
import sys
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from reference.forking import forking

from carom.core.jit import build, cache, native
from carom.core.jit import native as machine_code
from carom.core.jit.build import NativeBuild
from carom.core.jit.compile import array_of, njit, signature
from carom.core.jit.kernel import kernel, prange
from carom.core.jit.lowering import LoweringError
from carom.core.jit.native import NativeLoop, dtype_of, dtype_text
from carom.simulation import simulate as run_many

PLACE = np.dtype([("x", "f8", (3,)), ("count", "i4"), ("weight", "f8")])
SCALE = 3.0


def _function(name: str) -> Any:
    """Return the function of a name of the index: a loop, or what is made for one law."""
    whole, *held = name.split(" ")
    module, _, path = whole.partition(":")
    made = getattr(importlib.import_module(module), path.partition(".<locals>")[0])
    if not held:
        return made
    given = made(*(_function(":".join(one.partition("=")[2].rsplit(".", 1))) for one in held))
    return next(one for one in given if one.__qualname__ == path) if isinstance(given, tuple) else given


def test_the_packages_loops_are_of_todays_kernels() -> None:
    index = json.loads(native.INDEX.read_text(encoding="utf-8"))
    dtypes = [dtype_of(one) for one in index["dtypes"]]
    changed = [
        name
        for name, codes in index["loops"].items()
        for one in codes
        if native.hash_of_code(_function(name), native.arguments_text(one, dtypes)) != one["hash"]
        or native.hash_of_kernel_files(_function(name)) != one["files"]  # (else a first call takes half a second more)
    ]
    assert changed == [], (
        "kernels have changed since these loops were built: make native, and commit src/carom/core/jit/native"
    )
    files = {path.name.removesuffix(".bc.xz") for path in native.FOLDER.glob("*.bc.xz")}
    assert files == {one["name"] for codes in index["loops"].values() for one in codes}
    assert sum(path.stat().st_size for path in native.FOLDER.iterdir()) < 3_000_000


def test_no_constant_depends_on_the_version_of_python() -> None:
    """From Python 3.12 on the built-in sum carries rounding errors along: constants had other bits, and loops no longer fitted."""
    for path in sorted(native.FOLDER.parents[2].rglob("*.py")):
        text = path.read_text(encoding="utf-8")
        made = ast.parse(text).body if "sum(" in text else []
        named = [call for one in made if isinstance(one, (ast.Assign, ast.AnnAssign)) for call in ast.walk(one)]
        sums = [one.lineno for one in named if isinstance(one, ast.Call) and ast.unparse(one.func) == "sum"]
        assert not sums, f"{path.name}:{sums}"


@kernel
def _scaled(x: float, by: float) -> float:
    return math.sqrt(x * x + by) * SCALE


def _loop(places: Any, numbers: Any, by: float, most: int, upward: bool) -> Any:
    total, last = 0.0, 0
    for i in range(min(most, places.shape[0])):
        places[i].weight = _scaled(places[i].x[2], by)
        numbers[i, 1] = places[i].weight if upward else -places[i].weight
        total += numbers[i, 1]
        last = i
    return total, (last, upward)


def _rows(numbers: Any, out: Any) -> None:
    for i in prange(numbers.shape[0]):
        out[i] = _scaled(numbers[i], 1.0)


def _places(count: int) -> tuple[Any, Any]:
    places = np.zeros(count, PLACE)
    places["x"] = np.arange(3 * count).reshape(count, 3) / 7
    return places, np.zeros((count, 2))


@pytest.fixture(scope="module")
def built() -> dict[str, Any]:
    """Two loops, built for the package."""
    build, made = NativeBuild(), dict[str, Any]()
    with build.recording():
        made["loop"] = njit(
            _loop, signature((float, (int, bool)), array_of(PLACE), array_of(float, 2), float, int, bool)
        )
        made["rows"] = njit(_rows, parallel=True)
        made["rows"](np.ones(3), np.zeros(3))
        made["loop"](*_places(2), 1.0, 2, True)
    assert build.failed == {}
    return made


def test_loops_of_the_package_are_for_the_records_of_today(
    built: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A kernel may stay while a record grows; what is called by its address would then read the wrong places."""
    code = built["loop"].codes[0]
    source = built["loop"].source
    monkeypatch.setattr(native, "_native_codes", lambda _function: [code])
    order = [one["array"] for one in code.described["arguments"] if isinstance(one, dict)]
    dtypes: list[Any] = [None] * (max(order) + 1)
    dtypes[order[0]], dtypes[order[1]] = PLACE, np.dtype(float)
    monkeypatch.setattr(native, "_dtypes", lambda: dtypes)
    assert native.current_codes(source) == [code]
    dtypes[order[0]] = np.dtype([*PLACE.descr, ("more", "f8")])
    assert native.current_codes(source) == []


def test_every_loop_with_a_signature_is_in_the_package() -> None:
    from carom.fitting import likelihood
    from carom.simulation.loop import compiled_engine
    from carom.simulation.sensitivity import follow as compiled
    from carom.simulation.sensitivity import margins as near_misses
    from carom.simulation.sensitivity import sensitivity

    if native.why_not_shipped():
        pytest.skip("Numba compiles all loops")
    loops = [
        compiled_engine(), compiled.compiled_follow(), compiled.compiled_states(), near_misses.compiled_least_gaps(),
        run_many.compiled_many(), sensitivity.compiled_runs(),
        likelihood._evaluating(False), likelihood._evaluating(True), likelihood._predicting(),
    ]  # fmt: skip
    assert all(isinstance(getattr(one, "func", one), NativeLoop) for one in loops)


def _refused() -> Any:
    raise AssertionError("Numba was asked")


def _noting(asked: list[Any]) -> Callable[..., None]:
    """Return what stands for Numba's loop, and notes what it is asked."""
    return lambda *given: asked.append(given)


def _again(loop: Any, compile_here: Callable[[], Any] = _refused) -> NativeLoop:
    """Return a built loop as one of the package's."""
    return NativeLoop(loop.source._replace(compile_here=compile_here), loop.codes)


@pytest.mark.parametrize("upward", [True, False])
def test_a_loop_gives_pythons_bits(built: dict[str, Any], upward: bool) -> None:
    (places, numbers), (same, out) = _places(9), _places(9)
    found = _again(built["loop"])(places, numbers, 0.3, 7, upward)
    assert found == _loop(same.view(np.recarray), out, 0.3, 7, upward)
    assert isinstance(found[1][1], bool)
    assert places.tobytes() == same.tobytes()
    assert numbers.tobytes() == out.tobytes()


def test_a_parallel_loop_is_shared_out_and_given_every_row(
    built: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    threads, numbers = set(), np.linspace(0, 5, 1001)
    loop = _again(built["rows"])
    monkeypatch.setattr(native, "SERIAL_SECONDS", 0.0)
    for count in (1, 3, 7):
        monkeypatch.setattr(native, "thread_count", lambda count=count: count)
        out = np.zeros(1001)
        loop(numbers, out)
        assert out.tolist() == [_scaled(x, 1.0) for x in numbers.tolist()]
    call = loop.codes[0]._call
    assert call is not None
    monkeypatch.setattr(loop.codes[0], "_call", lambda *given: threads.add(threading.get_ident()) or call(*given))
    loop(numbers, np.zeros(1001))
    assert threading.get_ident() in threads
    loop(np.ones(1), one := np.zeros(1))
    assert one.tolist() == [_scaled(1.0, 1.0)]
    loop(np.ones(0), np.zeros(0))
    monkeypatch.setattr(native, "SERIAL_SECONDS", 1e9)  # so little work is one thread's
    asked = len(threads)
    monkeypatch.setattr(native, "call_in_parts", lambda *_given: pytest.fail("another thread was asked"))
    loop(numbers, np.zeros(1001))
    assert len(threads) == asked


@pytest.mark.parametrize(
    "change",
    [
        lambda p, x, *rest: (p, x.astype("f4"), *rest),
        lambda p, x, *rest: (p, x[:, :1], *rest),
        lambda p, x, *rest: (p, x[0], *rest),
        lambda p, x, *rest: (p, x.tolist(), *rest),
        lambda p, x, *rest: (p.view([("y", "f8", (3,)), ("count", "i4"), ("weight", "f8")]), x, *rest),
        lambda p, x, by, most, up: (p, x, by, 2.0, up),
        lambda p, x, by, most, up: (p, x, by, True, up),
        lambda p, x, by, most, up: (p, x, "1", most, up),
        lambda p, x, by, most, up: (p, x, by, most),
    ],
)  # fmt: skip
def test_arguments_of_other_kinds_are_numbas(built: dict[str, Any], change: Callable[..., Any]) -> None:
    asked: list[Any] = []
    loop = _again(built["loop"], functools.partial(_noting, asked))
    loop(*change(*_places(3), 1.0, 2, True))
    assert len(asked) == 1


def test_an_array_that_cannot_be_written_is_numbas(built: dict[str, Any]) -> None:
    asked: list[Any] = []
    loop = _again(built["rows"], functools.partial(_noting, asked))
    frozen = np.zeros(3)
    frozen.setflags(write=False)
    loop(np.ones(3), frozen)
    assert len(asked) == 1


def test_code_for_a_later_llvm_or_with_unknown_calls_is_left_to_numba(built: dict[str, Any]) -> None:
    good = built["rows"].codes[0]
    for change in ({"llvm": [99, 0, 0]}, {"calls": ["no_such_function"]}, {}):
        described = {**good.described, "name": f"other-{len(change)}", **change}
        code = native.NativeCode(described, [np.dtype(float)] * 9, good.read if change else lambda: b"no bitcode")
        asked: list[Any] = []
        source = built["rows"].source._replace(compile_here=functools.partial(_noting, asked))
        NativeLoop(source, [code])(np.ones(3), np.zeros(3))
        assert len(asked) == 1
        assert NativeLoop(source, [code]).numba_address is None


def _bitcode(built: dict[str, Any], folder: Path) -> machine_code.Bitcode:
    """Return the bitcode of a loop that was built, whose machine code is kept in a folder."""
    good = built["rows"].codes[0]
    kept_in = {name: good.described[name] for name in ("name", "vectorise", "calls", "llvm")}
    return machine_code.Bitcode(**kept_in, read=good.read, names=folder / "index.json")


def test_machine_code_is_kept_and_what_is_not_whole_is_made_again(
    built: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    code, made = _bitcode(built, tmp_path), list[Any]()
    finish = machine_code.finished_code
    monkeypatch.setattr(machine_code, "_objects", lambda _index: tmp_path)
    monkeypatch.setattr(machine_code, "finished_code", lambda code: made.append(code) or finish(code))
    first = machine_code._object(code)
    (kept,) = tmp_path.glob("*.o")
    assert machine_code._object(code) == first
    assert len(made) == 1
    kept.write_bytes(kept.read_bytes()[:-1])
    assert machine_code._object(code) == first
    assert len(made) == 2
    assert machine_code._object(code) == first
    assert len(made) == 2


def test_what_carom_cannot_link_llvm_links_with_the_same_bits(
    built: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    good = built["loop"].codes[0]
    made, linked = machine_code._object(_bitcode(built, tmp_path)._replace(names=None)), machine_code.linked
    for strange in (b"", made[:18] + b"\xb7\0" + made[20:]):
        with pytest.raises(machine_code.UnusableError):
            linked(strange)
    code = copy.copy(good)
    code._addresses, code._call = {}, None
    monkeypatch.setattr(machine_code, "_linked", {})
    monkeypatch.setattr(machine_code, "linked", lambda _data: linked(b""))
    (places, numbers), (same, out) = _places(9), _places(9)
    loop = NativeLoop(built["loop"].source._replace(compile_here=_refused), [code])
    assert loop(places, numbers, 0.3, 7, True) == _again(built["loop"])(same, out, 0.3, 7, True)
    assert places.tobytes() + numbers.tobytes() == same.tobytes() + out.tobytes()
    assert machine_code._linked == {good.described["name"]: {}}


def _vectors(code: Any) -> set[str]:
    """Return how wide the vectors of numbers in a loop's bitcode are."""
    import llvmlite.binding as llvm

    return set(re.findall(r"<(\d+) x double>", str(llvm.parse_bitcode(code.read()))))


@pytest.mark.parametrize("left", [False, True])
def test_loops_over_numbers_are_vectors_of_any_machine_or_of_the_users(
    left: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(build, "MOSTLY_VECTORS", 0.01 if left else 0.99)
    with NativeBuild().recording():
        rows = njit(_rows, parallel=True)
        rows(np.arange(9.0), out := np.zeros(9))
    assert rows.codes[0].described["vectorise"] == left
    assert _vectors(rows.codes[0]) == (set() if left else {"4"})
    assert out.tolist() == [_scaled(x, 1.0) for x in range(9)]


def test_a_loop_that_makes_an_array_is_refused_when_it_is_built() -> None:
    def makes(out: Any) -> None:
        out[:] = np.zeros(out.shape[0])

    build = NativeBuild()
    with build.recording():
        loop = njit(makes, cache=True)
        loop(out := np.ones(2))
    assert out.tolist() == [0, 0]  # (by Numba)
    assert list(build.failed) == [
        f"{__name__}:test_a_loop_that_makes_an_array_is_refused_when_it_is_built.<locals>.makes"
    ]
    assert issubclass(LoweringError, Exception)


def test_the_hash_is_of_the_code_and_of_the_arguments(monkeypatch: pytest.MonkeyPatch) -> None:
    for function in (_scaled, _rows):
        monkeypatch.setattr(function, "__module__", "carom.test")
    before, files = native.hash_of_code(_rows, "a"), native.hash_of_kernel_files(_rows)
    assert (native.hash_of_code(_rows, "a"), native.hash_of_kernel_files(_rows)) == (before, files)
    assert native.hash_of_code(_rows, "b") != before
    with monkeypatch.context() as edited:  # a comment: other files, the same code
        edited.setattr(cache, "file_hash", lambda file: f"edited {file}")
        cache._file_and_names.cache_clear()
        assert native.hash_of_code(_rows, "a") == before
        assert native.hash_of_kernel_files(_rows) != files
    cache._file_and_names.cache_clear()
    monkeypatch.setitem(globals(), "SCALE", 2.0)
    assert native.hash_of_code(_rows, "a") != before
    assert native.hash_of_kernel_files(_rows) != files


def test_a_changed_loop_is_numbas(monkeypatch: pytest.MonkeyPatch) -> None:
    from carom.simulation.motion import state_rows

    code = native._index()["loops"]["carom.simulation.motion:state_rows"][0]
    assert native._is_current(state_rows, {**code, "hash": "0" * 16})  # (its files are as they were)
    code = {**code, "files": ""}
    assert native._is_current(state_rows, code)
    assert not native._is_current(state_rows, {**code, "hash": "0" * 16})


@pytest.mark.parametrize("name", ["NUMBA_BOUNDSCHECK", "NUMBA_OPT", "NUMBA_DISABLE_JIT", "CAROM_NATIVE"])
def test_a_setting_that_asks_for_other_code_is_heard(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    for one in native.SETTINGS:
        monkeypatch.delenv(f"NUMBA_{one}", raising=False)
    monkeypatch.delenv("CAROM_NATIVE", raising=False)
    assert not native.native_is_off()
    monkeypatch.setenv(name, "0" if name == "CAROM_NATIVE" else "1")
    assert native.native_is_off()


def test_records_survive_the_index() -> None:
    for dtype in (PLACE, np.dtype("u4"), np.dtype({"names": ["a"], "formats": ["f8"], "offsets": [8], "itemsize": 32})):
        assert dtype_of(json.loads(json.dumps(dtype_text(dtype)))) == dtype


FIRST_RUN = """
import sys, json, carom
wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.8, friction=0.2)
ball = carom.SceneBall(radius=0.03, mass=0.2, position=(1, 0, 0.03), velocity=(-3, 0.4, 0), spin=(3, 40, 5))
scene = carom.Scene(floor=carom.Floor(friction=0.2, restitution=0.5), walls=[wall], balls=[ball], run=carom.Run(duration=2))
many = carom.simulate_many(scene, velocity=[[[-3, 0.4, 0]], [[-2, 0, 0]]])
print(json.dumps([many.final.velocity[0, 0].tolist(), carom.simulate(scene).final[0].velocity.tolist(), "numba" in sys.modules]))
print("llvmlite.binding" in sys.modules)
"""


@pytest.mark.slow
def test_a_first_run_needs_no_numba_and_gives_the_same_bits(tmp_path: Path) -> None:
    if not native.is_shipped(run_many._many):
        pytest.skip("the package's loops are not of today's kernels")
    found, llvm = [], []
    with forking() as forked:  # (which imports no Numba)
        for place in (
            tmp_path / "cache",
            tmp_path / "cache",
            os.devnull,
        ):  # (new, used, and one that cannot be written)
            code, out, err = forked(tmp_path, "-c", FIRST_RUN, CAROM_CACHE=str(place))
            assert code == 0, err
            found.append(json.loads(out.splitlines()[0]))
            llvm.append(out.splitlines()[1])
    assert list((tmp_path / "cache").rglob("*.o"))
    if platform.machine() == "x86_64" and sys.platform == "linux":  # (what is kept needs no LLVM)
        assert llvm == ["True", "False", "True"]
    many, one, numba = found[0]
    assert many == one
    assert not numba
    assert found[1:] == [found[0]] * 2
