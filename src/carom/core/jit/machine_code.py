"""Machine code of the package's loops for the processor at hand: made of bitcode by llvmlite, kept in the cache, linked in."""

from __future__ import annotations

import contextlib
import functools
import hashlib
import os
import threading
import zlib
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from carom.core.jit.cache import cache_base
from carom.core.jit.file_locks import locked
from carom.core.jit.generations import use_generation

__all__ = ["Bitcode", "UnusableError", "finished_code", "function_address", "is_kept", "library_version"]

# What machine code may call although its bitcode does not.
ALWAYS_CALLED = {"memcpy", "memmove", "memset"}


class UnusableError(Exception):
    """Bitcode is not for this machine."""


class Bitcode(NamedTuple):
    """Bitcode of a loop."""

    name: str
    read: Callable[[], bytes]
    vectorise: bool
    """Whether it is optimised once more, for this processor's vectors."""
    calls: Sequence[str]
    """Functions of other libraries that it needs."""
    llvm: Sequence[int]
    """The version of LLVM that wrote it: an older one may not read it."""
    names: Path | None
    """The file whose content names its machine code in the cache; None: none is kept."""


_engines = threading.Lock()


def library_version() -> str:
    """Return the versions of llvmlite and of its LLVM."""
    import llvmlite
    import llvmlite.binding as llvm

    return f"{llvmlite.__version__} {'.'.join(map(str, llvm.llvm_version_info))}"


@functools.cache
def _machine() -> tuple[Any, str]:
    """Return LLVM's target machine for this processor, and a text that names it."""
    import llvmlite.binding as llvm

    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    target, features = llvm.Target.from_default_triple(), ""
    with contextlib.suppress(RuntimeError):
        features = llvm.get_host_cpu_features().flatten()
    processor = llvm.get_host_cpu_name()
    # (as Numba has it)
    made = target.create_target_machine(
        cpu=processor, features=features, opt=3, codemodel="jitdefault", jit=True,
        reloc="static" if target.name.startswith("x86") else "default",
    )  # fmt: skip
    return made, f"{target.triple} {processor} {features} {library_version()}"


@functools.cache
def _engine() -> Any:
    """Return LLVM's engine, which holds all machine code of this process."""
    import llvmlite.binding as llvm

    # (of a machine of its own, which the engine then owns)
    _machine()
    return llvm.create_mcjit_compiler(
        llvm.parse_assembly(""), llvm.Target.from_default_triple().create_target_machine(jit=True)
    )


@functools.cache
def _objects(index: Path) -> Path:
    """Return the folder of machine code made for this processor of the bitcode that an index names."""
    name = hashlib.sha256(index.read_bytes() + _machine()[1].encode()).hexdigest()[:16]
    folder = cache_base() / name
    use_generation(folder)
    return folder


_loaded: set[str] = set()


def function_address(code: Bitcode, symbol: str) -> int:
    """Return the address of a function of the bitcode; UnusableError where it is not for this machine."""
    import llvmlite.binding as llvm

    with _engines:
        if code.name not in _loaded:
            made = llvm.ObjectFileRef.from_data(_object(code))
            _engine().add_object_file(made)
            _engine().finalize_object()
            _loaded.add(code.name)
        return int(_engine().get_function_address(symbol))


def _object(code: Bitcode) -> bytes:
    """Return a loop's machine code: from the cache, or made now, by one process while others wait."""
    _require_library(code)
    if code.names is None:
        return finished_code(code)
    folder, name = _objects(code.names), code.name
    path = folder / f"{name}.o"
    found = _checked(path)
    if found is not None:
        return found
    with locked(folder / "locks" / name):
        found = _checked(path)
        if found is None:
            found = finished_code(code)
            with contextlib.suppress(OSError):
                part = path.with_name(f"{name}.{os.getpid()}")
                part.write_bytes(zlib.crc32(found).to_bytes(4, "little") + found)
                part.replace(path)
    return found


def is_kept(name: str, names: Path) -> bool:
    """Return whether the cache has a loop's machine code."""
    return (_objects(names) / f"{name}.o").exists()


def _checked(path: Path) -> bytes | None:
    """Return the machine code in a file; None where it is not there, or not whole."""
    try:
        data = path.read_bytes()
    except OSError:
        return None
    return data[4:] if len(data) > 4 and zlib.crc32(data[4:]) == int.from_bytes(data[:4], "little") else None


def _require_library(code: Bitcode) -> None:
    """Raise UnusableError where LLVM, or the system's libm, lacks what the code needs: LLVM would end the process."""
    import llvmlite.binding as llvm

    if tuple(code.llvm) > tuple(llvm.llvm_version_info):
        raise UnusableError
    _engine()  # (which has the process's own symbols looked up)
    for called in {*code.calls, *ALWAYS_CALLED}:
        if not llvm.address_of_symbol(called):
            raise UnusableError


def finished_code(code: Bitcode) -> bytes:
    """Return machine code made of bitcode for this processor; loops over rows are brought to its vectors first."""
    import llvmlite.binding as llvm

    machine = _machine()[0]
    try:
        module = llvm.parse_bitcode(code.read())
    except (RuntimeError, OSError):
        raise UnusableError from None
    module.triple, module.data_layout = machine.triple, str(machine.target_data)
    if code.vectorise:
        options = llvm.create_pipeline_tuning_options(speed_level=3)
        options.loop_vectorization = True
        builder = llvm.create_pass_builder(machine, options)
        builder.getModulePassManager().run(module, builder)
    return bytes(machine.emit_object(module))
