"""Compile kernels to a WebAssembly module: the very code that Numba makes of them, brought to another machine.

Numba types and lowers the functions to LLVM's intermediate code (:mod:`carom.core.jit.lowering`). That code is told to be for
WebAssembly, is optimised and brought to an object by llvmlite, which carries that target, and is linked with musl's mathematical
functions (libm), so that all browsers give the same bits. Linker and C compiler are ziglang's.
"""

from __future__ import annotations

import re
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import Any, NamedTuple

from carom.core.jit.compile import numba_signature, register_kernels
from carom.core.jit.lowering import CFunction, LoweringError, linked_dispatcher, llvm_text, whole_module, with_entry
from carom.errors import CaromError

INSTALL = "python -m pip install -e '.[wasm]'"  # in a clone, where make wasm runs
TRIPLE = "wasm32-unknown-unknown"
LAYOUT = "e-m:e-p:32:32-p10:8:8-p20:8:8-i64:64-i128:128-n32:64-S128-ni:1:10:20"
STACK_BYTES = 1 << 18
INLINED = 40  # cost of a call, as LLVM counts it, up to which it is inlined
# musl's files for a function of libm. sqrt, floor, ceil and fabs are instructions of WebAssembly.
_ANGLES = ("__sin", "__cos", "__rem_pio2", "__rem_pio2_large")
LIBM = {
    "exp": ("exp", "exp_data"), "log": ("log", "log_data"), "pow": ("pow", "pow_data", "exp_data"),
    "sin": ("sin", *_ANGLES), "cos": ("cos", *_ANGLES), "acos": ("acos",), "atan2": ("atan2", "atan"),
}  # fmt: skip
LIBM_ALWAYS = ("__math_divzero", "__math_invalid", "__math_oflow", "__math_uflow", "__math_xflow", "scalbn")
INSTRUCTIONS = {"sqrt", "floor", "ceil", "fabs"}


class Export(NamedTuple):
    """A function of the module: an entry of one line over kernels, and Numba's signature of it.

    An array is handed over as its address and the number of its items (two i32), a float as f64, an int or a bool as i32; what is
    returned is written to the address in the first argument. ``by_address``: what is exported is the function's place in the
    module's table, for calls through an address.
    """

    name: str
    function: Callable[..., Any]
    signature: Any
    by_address: bool = False


def require_tools() -> None:
    """Raise CaromError where ziglang is missing, or is one that cannot build a module."""
    _math_folder()


def plain_signature(numbers: int) -> Any:
    """Return Numba's signature of a function that takes so many floats and a place to write floats to."""
    from numba import types

    return types.void(*[types.float64] * numbers, types.CPointer(types.float64))


def build_module(exports: Sequence[Export], version: str = "") -> bytes:
    """Return the WebAssembly module with the exports.

    ``version`` is kept in it, as its custom section "carom".

    Raises CaromError where ziglang is missing, and where Numba writes other code than this module knows.
    """
    register_kernels()
    text = [_text(export) for export in exports]
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder)
        made, needed = _object(exports, text)
        if unknown := needed - set(LIBM):
            raise CaromError(
                f"make wasm: expected functions of {', '.join(LIBM)}, got {', '.join(sorted(unknown))};"
                f" add their files to LIBM in {__name__}"
            )
        (work / "engine.o").write_bytes(made)
        addresses = [f"address_of_{one.name}" for one in exports if one.by_address]
        names = [*(one.name for one in exports), *addresses]
        return _link(work, sorted(needed), names) + _custom_section("carom", version.encode())


def _custom_section(name: str, content: bytes) -> bytes:
    """Return a section that a module may hold beside its code (of less than 128 bytes, which keeps its lengths to one byte)."""
    body = bytes([len(name)]) + name.encode() + content
    return bytes([0, len(body)]) + body


# --- Numba's code -----------------------------------------------------------------------------------------------------


def _text(export: Export) -> str:
    """Return LLVM's text of an export, with all that it calls, for WebAssembly."""
    kind = numba_signature(export.signature)
    try:
        name, text = llvm_text(linked_dispatcher(export.function, kind))
        return _of_numbas_text(export, kind.args, name, text)
    except LoweringError as error:
        raise CaromError(f"make wasm: {error}") from None


def _of_numbas_text(export: Export, arguments: Sequence[Any], name: str, text: str) -> str:
    made = with_entry(CFunction(export.name, out=not export.by_address), arguments, name, _for_webassembly(text))
    if export.by_address:
        made += f"define i32 @address_of_{export.name}() {{\n  ret i32 ptrtoint (ptr @{export.name} to i32)\n}}\n"
    return made


def _object(exports: Sequence[Export], texts: Sequence[str]) -> tuple[bytes, set[str]]:
    """Return the object of all functions, optimised, and the names of functions that it needs."""
    import llvmlite.binding as llvm

    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    try:
        whole = whole_module(texts, {f"{of}{one.name}" for one in exports for of in ("", "address_of_")})
    except LoweringError as error:
        raise CaromError(f"make wasm: {error}") from None
    machine = llvm.Target.from_triple(TRIPLE).create_target_machine(opt=3, reloc="static", codemodel="default")
    options = llvm.create_pipeline_tuning_options(speed_level=2)
    options.inlining_threshold, options.loop_unrolling = INLINED, False  # (a page is to be small)
    builder = llvm.create_pass_builder(machine, options)
    builder.getModulePassManager().run(whole, builder)
    undefined = {f.name for f in whole.functions if f.is_declaration and not f.name.startswith("llvm.")} - INSTRUCTIONS
    # (what LLVM has an intrinsic for becomes a call of libm)
    undefined |= {m for f in whole.functions for m in re.findall(r"^llvm\.(\w+)\.f64$", f.name)} & set(LIBM)
    return bytes(machine.emit_object(whole)), undefined


def _for_webassembly(text: str) -> str:
    changed = re.sub(r'^target datalayout = ".*"$', f'target datalayout = "{LAYOUT}"', text, flags=re.M)
    changed = re.sub(r'^target triple = ".*"$', f'target triple = "{TRIPLE}"', changed, flags=re.M)
    changed = re.sub(r"^(define .*) \{$", r"\1 optsize {", changed, flags=re.M)
    # (LLVM ends the process where it meets a common symbol here)
    return changed.replace(" = common ", " = internal ")


# --- linking ----------------------------------------------------------------------------------------------------------


def _zig(*arguments: str) -> None:
    done = subprocess.run([sys.executable, "-m", "ziglang", *arguments], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        said = done.stderr.strip().splitlines() or ["no message"]
        first = next((line for line in said if "error" in line), said[0])
        raise CaromError(f"make wasm: expected {arguments[0]} to succeed, got: {first}")


def _math_folder() -> Path:
    found = find_spec("ziglang")
    if found is None or found.origin is None:
        raise CaromError(f"make wasm: expected ziglang, got none; run {INSTALL}")
    folder = Path(found.origin).parent / "lib" / "libc" / "musl" / "src" / "math"
    if not (folder / "exp.c").is_file():
        raise CaromError(f"make wasm: expected a ziglang with musl's libm (0.13), got another; run {INSTALL}")
    return folder


def _link(work: Path, functions: Sequence[str], names: Sequence[str]) -> bytes:
    folder = _math_folder()
    files = sorted({file for one in functions for file in LIBM[one]} | set(LIBM_ALWAYS))
    objects = []
    arch = folder.parents[2] / "wasi" / "libc-top-half" / "musl" / "arch" / "wasm32"
    flags = ["-target", "wasm32-wasi", "-O2", "-fno-math-errno", "-ffp-contract=off", "-D_GNU_SOURCE", "-Dhidden="]
    for file in files:
        objects.append(str(work / f"{file}.o"))
        include = ["-I", str(folder.parent / "internal"), "-I", str(arch)]
        _zig("cc", *flags, *include, "-c", str(folder / f"{file}.c"), "-o", objects[-1])
    _zig(
        "wasm-ld", "--no-entry", "--strip-all", "--gc-sections", "--compress-relocations",
        "--stack-first", "-z", f"stack-size={STACK_BYTES}",
        *(f"--export={name}" for name in names), "--export=__heap_base", str(work / "engine.o"), *objects,
        "-o", str(work / "engine.wasm"),
    )  # fmt: skip
    return (work / "engine.wasm").read_bytes()


def libm_licence() -> str:
    """Return the licence of what is linked into a module beside the kernels: musl's, with the notices of its libm."""
    return (_math_folder().parents[1] / "COPYRIGHT").read_text(encoding="utf-8")


def tool_versions() -> dict[str, str]:
    """Return the versions of what builds a module."""
    from importlib.metadata import version

    return {name: version(name) for name in ("numba", "llvmlite", "ziglang")}
