"""The explorer's WebAssembly module: that it is of today's kernels, and that a Numba that writes other code is refused."""

from __future__ import annotations

import json
import math
import subprocess
import sys
from typing import Any

import pytest

import carom
from carom.core.jit import build as lowered
from carom.core.jit.cache import kernel_hash
from carom.core.jit.compile import numba_signature, signature
from carom.core.jit.lowering import LoweringError, linked_dispatcher, llvm_text
from carom.explorer import module as build
from carom.explorer.module import ASSETS, MAX_BYTES, description, engine_bytes, engine_layout, version
from carom.scene.schema import Model
from carom.scene.shapes.table import Side, Sides


def test_the_module_is_of_todays_kernels() -> None:
    layout = engine_layout()
    built_with = layout.pop("built_with")
    assert set(built_with) == {"numba", "llvmlite", "ziglang"}
    advice = "the kernels have changed since engine.wasm was built: make wasm (extra wasm), and commit src/carom/explorer/assets"
    assert layout["version"] == version(), advice
    assert layout == json.loads(json.dumps(description())), advice


def test_the_module_carries_the_version_and_is_small() -> None:
    module = engine_bytes()
    assert module[:4] == b"\0asm"
    assert module.endswith(b"\x05carom" + version().encode())
    assert len(module) < MAX_BYTES


def test_the_licence_of_what_is_linked_in_is_kept() -> None:
    text = (ASSETS / "LICENSE-musl.txt").read_text(encoding="utf-8")
    for holder in ("Rich Felker", "Sun Microsystems", "Arm Limited"):
        assert holder in text


FACTOR = 2.0


def _half(x: float) -> float:
    """Return a half."""
    return x / FACTOR


def _entry(x: float) -> float:
    return _half(x) + 1


def test_the_hash_is_of_code_and_constants_and_not_of_comments(monkeypatch: pytest.MonkeyPatch) -> None:
    before = kernel_hash([_entry])
    assert kernel_hash([_entry]) == before
    assert kernel_hash([_entry], "more") != before
    for function in (_half, _entry):
        monkeypatch.setattr(function, "__module__", "carom.test")
    with_half = kernel_hash([_entry])  # a function of carom's is followed
    assert with_half != before
    monkeypatch.setitem(globals(), "FACTOR", 3.0)
    assert kernel_hash([_entry]) != with_half


def test_code_that_numba_writes_otherwise_is_refused_in_a_sentence() -> None:
    export = lowered.Export("entry", _entry_alone, signature(float, float))
    made, needed = lowered._object([export], [lowered._text(export)])
    assert made[:4] == b"\0asm"
    assert needed == {"exp"}
    name, text = llvm_text(linked_dispatcher(_entry_alone, numba_signature(export.signature)))
    arguments = numba_signature(export.signature).args

    def build(text: str) -> None:
        lowered._object([export], [lowered._of_numbas_text(export, arguments, name, text)])

    build(text)
    with pytest.raises(LoweringError, match=r"^expected LLVM code as Numba .* arguments .* for "):
        build(text.replace("double %arg.x", "float %arg.x"))
    with pytest.raises(LoweringError, match=r"^expected LLVM code as Numba .* no function "):
        build(text.replace(f"@{name}(", "@other("))
    with pytest.raises(carom.CaromError, match=r"^make wasm: expected LLVM code as Numba "):
        build(text.replace("ret i32 0", "return 0"))


def _entry_alone(x: float) -> float:
    return math.exp(x)


@pytest.mark.slow
def test_the_version_does_not_depend_on_what_was_imported() -> None:
    """Public classes explain their misuse once they are asked for; the kernels that they name stay as they are."""
    code = "import carom.scene as s; s.SceneBall, s.Floor; from carom.explorer.module import version; print(version())"
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert ran.stdout.strip() == description()["version"]


def test_a_missing_ziglang_is_said_first_in_one_line(monkeypatch: pytest.MonkeyPatch, capsys: Any) -> None:
    """It was said after all kernels had been compiled, without the command that installs it."""
    monkeypatch.setattr(lowered, "find_spec", lambda _name: None)
    monkeypatch.setattr(build, "entries", lambda: pytest.fail("kernels are compiled before"))
    assert build.main() == 2
    said = capsys.readouterr().err
    assert said == "carom: make wasm: expected ziglang, got none; run python -m pip install -e '.[wasm]'\n"


class Rim(Model):
    friction: float | None = None


class Rims(Model):
    inner: Rim = Rim()
    outer: Rim | None = None


def test_parts_within_shapes_are_found_by_their_type() -> None:
    assert list(dict.fromkeys(build._within(tuple[Rims, ...] | None))) == [Rim, Rims]
    found = build._field(Rims, "inner", Rims.model_fields["inner"])
    assert found["optional"]  # it says nothing
    assert build.NAMED["sides"] is Sides
    assert build.NAMED["side"] is Side
