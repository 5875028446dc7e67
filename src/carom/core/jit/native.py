"""Loops that lie ready in the package: nothing is compiled by Numba, which is not even imported, on a user's machine.

`make native` has Numba type and lower every loop that carom.cli.doctor names, and keeps each as LLVM's bitcode, optimised, for any
processor (:mod:`carom.core.jit.build`). Here llvmlite alone finishes it for this processor, when it is first called, in a
fraction of a second; the machine code is kept in the user's cache, from where it is loaded in a millisecond.

A loop is taken from the package only while its kernels are those of which it was built: by the hash of their files, or else by the
hash of what they do (half a second of reading Python). Otherwise, and for arguments or machines that it is not for, Numba compiles
it.
"""

from __future__ import annotations

import contextlib
import ctypes
import functools
import hashlib
import json
import math
import mmap
import operator
import os
import platform
import struct
import sys
import threading
import time
import zlib
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from carom.core.jit.cache import cache_base, file_hash, kernel_hash, module_hash, name_with_values, use_folder
from carom.core.jit.kernel import DERIVED
from carom.core.jit.threads import call_in_parts, thread_count

# Where NumPy keeps an array's address and shape: after what all objects of Python begin with (16 bytes, or 32 without a lock).
HEAD = object.__basicsize__
CODES = {"float64": "d", "int64": "q", "bool": "?"}
C_KINDS = {"float64": ctypes.c_double, "int64": ctypes.c_int64, "bool": ctypes.c_int64}


class MismatchError(Exception):
    """An argument is not of the kind that a loop was built for."""


class ArgumentWriter(NamedTuple):
    """How one argument is handed over."""

    kinds: list[Any]
    """Of C."""
    write: Callable[[Any, list[Any]], None]
    """Add the description of a value to a list; MismatchError where it is of another kind."""


def argument_writers(kinds: Sequence[Any], dtypes: Sequence[Any], fixed: bool) -> list[ArgumentWriter]:
    """Return a writer for each argument.

    A kind is a name of CODES, "none", a list of kinds (a tuple), ``{"array": dtype, "axes": n, "readonly": bool}`` or
    ``{"record": dtype}`` with indices of ``dtypes``. ``fixed``: the loop takes nothing else, and a whole number stands for a
    float.
    """
    return [_writer(kind, dtypes, fixed) for kind in kinds]


def _writer(kind: Any, dtypes: Sequence[Any], fixed: bool) -> ArgumentWriter:
    if isinstance(kind, list):
        return _tuple_writer([_writer(one, dtypes, fixed) for one in kind])
    if isinstance(kind, dict):
        if "record" in kind:
            return _record_writer(dtypes[kind["record"]])
        return _array_writer(dtypes[kind["array"]], kind["axes"], kind["readonly"])
    if kind == "none":
        return ArgumentWriter([], _write_none)
    numbers: dict[str, tuple[Any, Any]] = {
        "float64": ((float, int, np.floating, np.integer) if fixed else float, float),
        "int64": ((int, np.integer), operator.index),
        "bool": ((bool, np.bool_, int) if fixed else (bool, np.bool_), bool),
    }
    taken, convert = numbers[kind]
    whole = kind == "int64"

    def write(value: Any, given: list[Any]) -> None:
        if not isinstance(value, taken) or (whole and isinstance(value, bool)):
            raise MismatchError
        given.append(convert(value))

    return ArgumentWriter([C_KINDS[kind]], write)


def _write_none(value: Any, given: list[Any]) -> None:
    if value is not None:
        raise MismatchError


def _tuple_writer(items: list[ArgumentWriter]) -> ArgumentWriter:
    def write(value: Any, given: list[Any]) -> None:
        if not isinstance(value, tuple) or len(value) != len(items):
            raise MismatchError
        for item, one in zip(items, value, strict=True):
            item.write(one, given)

    return ArgumentWriter([kind for item in items for kind in item.kinds], write)


def _array_writer(dtype: Any, axes: int, readonly: bool) -> ArgumentWriter:
    seen = dtype  # the same type is mostly the same object; comparing two takes a microsecond

    def write(value: Any, given: list[Any]) -> None:
        nonlocal seen
        if not isinstance(value, np.ndarray) or value.ndim != axes:
            raise MismatchError
        if value.dtype is not seen:
            if value.dtype != dtype:
                raise MismatchError
            seen = value.dtype
        flags = value.flags
        if not (flags.c_contiguous and flags.aligned if readonly else flags.carray):
            raise MismatchError
        given.append(id(value) + HEAD)

    return ArgumentWriter([ctypes.c_void_p], write)


def _record_writer(dtype: Any) -> ArgumentWriter:
    def write(value: Any, given: list[Any]) -> None:
        if not isinstance(value, np.void) or value.dtype != dtype:
            raise MismatchError
        given.append(value.__array_interface__["data"][0])

    return ArgumentWriter([ctypes.c_void_p], write)


class ValueReader:
    """Result of a loop, in a buffer of ``size`` bytes."""

    def __init__(self, kind: Any) -> None:
        self._kind = kind
        self._struct = struct.Struct("@" + "".join(_codes(kind)))
        self._flat = isinstance(kind, list) and not any(isinstance(one, list) for one in kind)
        self.size = self._struct.size + 8  # (a tuple in a tuple may end later)

    def read(self, buffer: Any) -> Any:
        """Return the value."""
        if self._flat:
            return self._struct.unpack_from(buffer)
        return _value(self._kind, iter(self._struct.unpack_from(buffer)))


def value_reader(kind: Any) -> ValueReader | None:
    """Return the reader of a value of a kind (:func:`argument_writers`), None for no value."""
    return None if kind == "none" else ValueReader(kind)


def _codes(kind: Any) -> list[str]:
    return [code for one in kind for code in _codes(one)] if isinstance(kind, list) else [CODES[kind]]


def _value(kind: Any, numbers: Iterator[Any]) -> Any:
    return tuple(_value(one, numbers) for one in kind) if isinstance(kind, list) else next(numbers)


def kinds_text(takes: Sequence[Any], returns: Any) -> str:
    """Return the text of what a loop takes and returns: kinds with dtypes in place of their indices."""

    def whole(kind: Any) -> Any:
        if isinstance(kind, list):
            return [whole(one) for one in kind]
        if isinstance(kind, dict):
            return {key: dtype_text(x) if key in ("array", "record") else x for key, x in kind.items()}
        return kind

    return json.dumps([whole(list(takes)), whole(returns)])


def dtype_text(dtype: Any) -> Any:
    """Return a dtype as JSON has it: of records with the places of their fields."""
    if dtype.names is None:
        return dtype.str
    fields = [dtype.fields[name] for name in dtype.names]
    return {
        "names": list(dtype.names),
        "formats": [
            kind.str if kind.subdtype is None else [kind.subdtype[0].str, list(kind.shape)] for kind, *_ in fields
        ],
        "offsets": [offset for _kind, offset, *_ in fields],
        "itemsize": dtype.itemsize,
    }


def dtype_of(text: Any) -> Any:
    """Return the dtype of a :func:`dtype_text`."""
    if isinstance(text, str):
        return np.dtype(text)
    layout: Any = {
        **text,
        "formats": [one if isinstance(one, str) else (one[0], tuple(one[1])) for one in text["formats"]],
    }
    return np.dtype(layout)


# ----------------------------------------------------------------------------------------------------
# Machine code of the package's loops for the processor at hand: made of bitcode by llvmlite, kept in the cache, linked in.


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
def _processor() -> str:
    """Return a text that names this processor and LLVM's version: without LLVM, where the system says which processor it is."""
    import llvmlite

    named = ("vendor_id", "cpu family", "model", "stepping", "flags")
    with contextlib.suppress(OSError):
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").partition("\n\n")[0].splitlines()
        if found := [line for line in lines if line.startswith(named)]:
            return "\n".join([platform.machine(), *found, llvmlite.__version__])
    return _machine()[1]


@functools.cache
def _objects(index: Path) -> Path:
    """Return the folder of machine code made for this processor of the bitcode that an index names."""
    name = hashlib.sha256(index.read_bytes() + _processor().encode()).hexdigest()[:16]
    folder = cache_base() / name
    use_folder(folder)
    return folder


_linked: dict[str, dict[str, int]] = {}
_memory: list[Any] = []


def function_address(code: Bitcode, symbol: str) -> int:
    """Return the address of a function of the bitcode; UnusableError where it is not for this machine."""
    with _engines:
        if code.name not in _linked:
            made = _object(code)
            try:
                _linked[code.name] = linked(made)
            except UnusableError:
                _link_by_llvm(code, made)
        return _linked[code.name].get(symbol) or int(_engine().get_function_address(symbol))


def _link_by_llvm(code: Bitcode, made: bytes) -> None:
    import llvmlite.binding as llvm

    _require_library(code)
    _engine().add_object_file(llvm.ObjectFileRef.from_data(made))
    _engine().finalize_object()
    _linked[code.name] = {}


# Parts of an object file: System V ABI, AMD64 supplement, chapter 4 (names are those of carom).
SECTIONS = np.dtype({
    "names": ["kind", "flags", "offset", "size", "link", "of", "align"],
    "formats": ["<u4", "<u8", "<u8", "<u8", "<u4", "<u4", "<u8"],
    "offsets": [4, 8, 24, 32, 40, 44, 48], "itemsize": 64,
})  # fmt: skip
SYMBOLS = np.dtype(
    {"names": ["name", "section", "value"], "formats": ["<u4", "<u2", "<u8"], "offsets": [0, 6, 8], "itemsize": 24}
)
ADDRESSES = np.dtype([("at", "<u8"), ("kind", "<u4"), ("symbol", "<u4"), ("more", "<i8")])
CONTENT, SYMBOL_TABLE, ADDRESS_TABLE, UNWINDING = 1, 2, 4, 0x70000001  # kinds of sections
WRITTEN, IN_MEMORY, WHOLE_ADDRESS = 1, 2, 1


def linked(data: bytes) -> dict[str, int]:
    """Return the addresses of the functions of machine code, linked in; UnusableError for code that only LLVM can link.

    LLVM's library takes 40 MB and a tenth of a second to load. Code of the large model, for x86-64 on Linux, has nothing but whole
    addresses to be filled in.
    """
    if sys.platform != "linux" or data[:6] != b"\x7fELF\2\1" or data[18:20] != b"\x3e\0":
        raise UnusableError
    (begin,), (count,) = struct.unpack_from("<Q", data, 40), struct.unpack_from("<H", data, 60)
    sections = np.frombuffer(data, SECTIONS, count, begin)
    places, end = np.full(count, -1), 0
    for k, one in enumerate(sections):
        if one["flags"] & IN_MEMORY and one["kind"] != UNWINDING and one["size"]:
            if one["kind"] != CONTENT or one["flags"] & WRITTEN:
                raise UnusableError
            places[k] = -(-end // int(one["align"])) * int(one["align"])
            end = int(places[k] + one["size"])
    memory = mmap.mmap(-1, end, mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS)
    base, process = ctypes.addressof(ctypes.c_char.from_buffer(memory)), ctypes.CDLL(None)
    for place, one in zip(places, sections, strict=True):
        if place >= 0:
            memory[place : place + int(one["size"])] = data[int(one["offset"]) :][: int(one["size"])]
    (table,) = sections[sections["kind"] == SYMBOL_TABLE]
    names = data[int(sections[table["link"]]["offset"]) :]
    symbols = np.frombuffer(data, SYMBOLS, int(table["size"]) // SYMBOLS.itemsize, int(table["offset"]))
    called = [names[start : names.index(b"\0", start)].decode() for start in symbols["name"].tolist()]
    values = np.zeros(len(symbols), np.uint64)
    for k, (name, section) in enumerate(zip(called, symbols["section"].tolist(), strict=True)):
        if section == 0 and name:
            try:
                values[k] = ctypes.cast(getattr(process, name), ctypes.c_void_p).value or 0
            except AttributeError:
                raise UnusableError from None
        elif section < count:
            values[k] = base + int(places[section]) + int(symbols["value"][k])
    into = np.frombuffer(memory, np.uint8)
    for one in sections[(sections["kind"] == ADDRESS_TABLE) & (places[sections["of"] % count] >= 0)]:
        rows = np.frombuffer(data, ADDRESSES, int(one["size"]) // ADDRESSES.itemsize, int(one["offset"]))
        if (rows["kind"] != WHOLE_ADDRESS).any():
            raise UnusableError
        at = int(places[one["of"]]) + rows["at"].astype(np.int64)
        filled = values[rows["symbol"]] + rows["more"].astype(np.uint64)
        into[at[:, None] + np.arange(8)] = filled.view(np.uint8).reshape(-1, 8)
    if process.mprotect(ctypes.c_void_p(base), ctypes.c_size_t(end), mmap.PROT_READ | mmap.PROT_EXEC):
        raise UnusableError
    _memory.append(memory)
    return {name: int(value) for name, value in zip(called, values, strict=True) if name}


def _object(code: Bitcode) -> bytes:
    """Return a loop's machine code: from the cache, or made now."""
    if code.names is None:
        return finished_code(code)
    folder, name = _objects(code.names), code.name
    path = folder / f"{name}.o"
    found = _checked(path)
    if found is None:
        found = finished_code(code)
        with contextlib.suppress(OSError):
            part = path.with_name(f"{name}.{os.getpid()}")
            part.write_bytes(zlib.crc32(found).to_bytes(4, "little") + found)
            part.replace(path)
    return found


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

    _require_library(code)
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


# ----------------------------------------------------------------------------------------------------
# Loops that lie ready in the package: nothing is compiled by Numba, which is not even imported, on a user's machine.


FOLDER = Path(__file__).with_name("native")
INDEX = FOLDER / "index.json"
# Settings of Numba's that ask for other code than what is shipped: Numba then compiles.
SETTINGS = (
    "BOUNDSCHECK", "CPU_FEATURES", "CPU_NAME", "DEBUGINFO", "DISABLE_JIT", "LOOP_VECTORIZE", "OPT", "SLP_VECTORIZE",
)  # fmt: skip
# The modules of this room that decide how a kernel is lowered, beside the kernels.
LOWERING = ("calls.py", "compile.py", "dual.py", "kernel.py", "lowering.py")


class LoopSource(NamedTuple):
    """A loop as its module declares it (:func:`carom.core.jit.compile.njit`)."""

    function: Callable[..., Any]
    signature: Any
    needs: Sequence[Callable[[], Any]]
    """Called before it is compiled."""
    options: dict[str, Any]
    """Numba's."""
    compile_here: Callable[[], Any]
    """Return Numba's compiled version of it."""
    takes: str | None = None
    """Text of what its signature says (:func:`carom.core.jit.native.kinds_text`), if it has one."""
    plain: tuple[int, int] | None = None
    """Numbers, and places of numbers, that a function takes which is called by its address alone."""


class NativeCode:
    """One variant of a loop: its bitcode, and what its entry takes and returns, as the index says."""

    def __init__(self, described: dict[str, Any], dtypes: Sequence[Any], read: Callable[[], bytes]) -> None:
        self.described, self.read = described, read
        self.entry = f"carom_{described['name']}"
        self.numbas = f"numba_{described['name']}"
        self.writers: list[ArgumentWriter] = argument_writers(described["arguments"], dtypes, described["fixed"])
        self.reader: ValueReader | None = value_reader(described["returns"])
        self._writes = [writer.write for writer in self.writers]
        self._room: Any = None if self.reader is None else ctypes.c_char * self.reader.size
        self._lock = threading.Lock()
        self._row_seconds = math.inf  # of the last call
        self._kinds = [ctypes.c_void_p, ctypes.c_void_p, *(kind for one in self.writers for kind in one.kinds)]
        self._call: Callable[..., int] | None = None
        self._addresses: dict[str, int] = {}

    def address(self, symbol: str) -> int:
        """Return the address of one of its two functions, brought to machine code."""
        if symbol not in self._addresses:  # (LLVM takes 10 us to say it)
            described = self.described
            self._addresses[symbol] = function_address(
                Bitcode(
                    described["name"], self.read, described["vectorise"], described["calls"], described["llvm"],
                    INDEX if recorder is None else None,
                ),
                symbol,
            )  # fmt: skip
        return self._addresses[symbol]

    def is_kept(self) -> bool:
        """Return whether its machine code for this processor is in the process or in the cache."""
        if self._addresses:
            return True
        try:
            return (_objects(INDEX) / f"{self.described['name']}.o").exists()
        except (OSError, RuntimeError, ImportError):
            return False

    def given(self, arguments: tuple[Any, ...]) -> list[Any]:
        """Return the arguments as C takes them; MismatchError where they are not of the kinds that this code is for."""
        if len(arguments) != len(self._writes):
            raise MismatchError
        given: list[Any] = []
        for write, argument in zip(self._writes, arguments, strict=True):
            write(argument, given)
        return given

    def call(self, arguments: tuple[Any, ...], given: list[Any]) -> Any:
        """Call the loop, parallel ones on all threads."""
        call = self._call or self._load()
        out = NOTHING if self.reader is None else self._room()
        if self.described["parallel"]:
            self._share(call, out, arguments, given)
        else:
            self._require_ok(call(out, WHOLE, *given))
        return None if self.reader is None else self.reader.read(out)

    def fixed(self, arguments: tuple[Any, ...], given: list[Any]) -> Callable[[], Any]:
        """Return the loop, of one thread, as a function of nothing: with these arguments, whose arrays it reads as they then are.

        (C's form of them is made once: making it at each call takes longer than a shot of one ball.)
        """
        reader, room, require_ok = self.reader, self._room(), self._require_ok
        assert reader is not None
        self._load()
        row = [kind.from_param(one) for kind, one in zip(self._kinds, (room, WHOLE, *given), strict=True)]
        call, read = self._bare, reader.read

        def run(_kept: object = arguments) -> Any:  # (`row` has their addresses only)
            if (status := call(*row)) not in OK:
                require_ok(status)
            return read(room)

        return run

    def _share(self, call: Callable[..., int], out: Any, arguments: tuple[Any, ...], given: list[Any]) -> None:
        """Call a parallel loop, by one thread where the work is less than handing it over."""
        rows = max((len(x) for x in arguments if hasattr(x, "__len__")), default=0) or 1
        parts = 1 if self._row_seconds * rows < SERIAL_SECONDS else min(thread_count(), rows)
        spent = []

        def work(part: int, _kept: object = arguments) -> int:  # (`given` has their addresses only)
            begin = time.perf_counter()
            status = call(out, PART(0, part, parts), *given)
            spent.append(time.perf_counter() - begin)
            return status

        for status in [work(0)] if parts <= 1 else call_in_parts(work, parts):
            self._require_ok(status)
        # (of the work alone: handing a part over takes longer than the work of few rows, which would go on being shared)
        self._row_seconds = sum(spent) / rows

    def _require_ok(self, status: int) -> None:
        if status not in OK:
            raise RuntimeError(
                f"{self.described['name']}: expected no error within a compiled loop, got status {status}"
            )

    def _load(self) -> Callable[..., int]:
        with self._lock:
            if self._call is None:
                # (with Python's lock held, as Numba's loops hold it that do not say otherwise)
                leaves, address = self.described["parallel"] or self.described["nogil"], self.address(self.entry)
                prototype = ctypes.CFUNCTYPE if leaves else ctypes.PYFUNCTYPE
                self._bare = prototype(ctypes.c_int32)(address)
                self._call = prototype(ctypes.c_int32, *self._kinds)(address)
        return self._call


SERIAL_SECONDS = 1e-4  # of work in all, below which handing a part to another thread takes longer than doing it
PART = ctypes.c_int64 * 3  # which part of how many a call does
WHOLE = PART(0, 0, 1)
NOTHING = ctypes.create_string_buffer(8)  # to which a function without a value writes that
OK = (0, -2)  # Numba's status of a function that returned a value, or None


class NativeLoop:
    """A loop of the package, called as Numba's dispatcher is; that one is made only for what the package has no code for."""

    def __init__(self, source: LoopSource, codes: Sequence[NativeCode]) -> None:
        self.source, self.codes = source, list(codes)
        self.py_func = source.function
        self._numbas: Any = None

    def __call__(self, *arguments: Any) -> Any:
        """Call the first code that is for arguments of these kinds, else Numba's."""
        if (found := self.code_for(arguments)) is not None:
            code, given = found
            try:
                return code.call(arguments, given)
            except UnusableError:
                self.codes.clear()
        return self.numbas()(*arguments)

    def code_for(self, arguments: tuple[Any, ...]) -> tuple[NativeCode, list[Any]] | None:
        """Return the first code for arguments of these kinds, and the arguments as it takes them; None if there is none."""
        for code in self.codes:
            try:
                return code, code.given(arguments)
            except MismatchError:
                continue
        return None

    def numbas(self) -> Any:
        """Return the function as Numba compiles it on this machine."""
        if self._numbas is None:
            self._numbas = self.source.compile_here()
        return self._numbas

    @property
    def address(self) -> int:
        """Address of a function of numbers and places of numbers, for calls from compiled code."""
        try:
            return self.codes[0].address(self.codes[0].entry)
        except UnusableError:
            return int(self.numbas().address)

    @property
    def numba_address(self) -> int | None:
        """Address of the function with the arguments that Numba gives it; None where the package's code cannot be used."""
        try:
            return self.codes[0].address(self.codes[0].numbas)
        except UnusableError:
            return None

    @property
    def _numba_type_(self) -> Any:
        """Numba's type of this loop in a compiled caller."""
        from numba import typeof

        return typeof(self.numbas())


def fixed(loop: Callable[..., Any], arguments: tuple[Any, ...]) -> Callable[[], Any]:
    """Return a loop of one thread as a function of nothing (:meth:`NativeCode.fixed`)."""
    if isinstance(loop, NativeLoop) and (found := loop.code_for(arguments)) is not None:
        with contextlib.suppress(UnusableError):
            return found[0].fixed(arguments, found[1])
    return functools.partial(loop, *arguments)


# --- which loops are shipped ------------------------------------------------------------------------------------------


def native_is_off() -> bool:
    """Return whether the package's code is not to be used: by CAROM_NATIVE=0, or by settings of Numba's that ask for other code."""
    if os.environ.get("CAROM_NATIVE", "1").strip() == "0":
        return True
    return any(os.environ.get(f"NUMBA_{name}", "").strip() for name in SETTINGS)


@functools.cache
def why_not_shipped() -> str:
    """Return why the package's code is not for this process; empty if it is."""
    if native_is_off():
        return "CAROM_NATIVE or a setting of Numba's asks for loops that are compiled here"
    if not _index():
        return "the package holds no compiled loops"
    if ctypes.sizeof(ctypes.c_void_p) != 8 or sys.byteorder != "little" or os.name != "posix":
        return f"the package's loops are for 64 bits on Linux and macOS, not for {platform.platform()}"
    if platform.python_implementation() != "CPython":
        return f"the package's loops are for CPython, not for {platform.python_implementation()}"
    return ""


@functools.cache
def _index() -> dict[str, Any]:
    try:
        return json.loads(INDEX.read_text(encoding="utf-8"))  # type: ignore[no-any-return]
    except (OSError, ValueError):
        return {}


@functools.cache
def _dtypes() -> list[Any]:
    return [dtype_of(one) for one in _index()["dtypes"]]


@functools.cache
def _lowering() -> str:
    return module_hash(Path(__file__).with_name(name) for name in LOWERING)


def hash_of_code(function: Callable[..., Any], arguments: str) -> str:
    """Return the hash of what a loop does, for arguments that a text describes, and of how it is lowered."""
    return kernel_hash([function], arguments, _lowering(), instead=DERIVED)


def hash_of_kernel_files(function: Callable[..., Any]) -> str:
    """Return the hash of the files that hold a loop's kernels, and of those that lower them: quick, another for any edit."""
    lowering = [file_hash(Path(__file__).with_name(name)) for name in LOWERING]
    return kernel_hash([function], *lowering, instead=DERIVED, by_file=True)


def _is_current(function: Callable[..., Any], described: dict[str, Any]) -> bool:
    """Return whether a loop's kernels are as they were when its code was built."""
    return bool(
        described["files"] == hash_of_kernel_files(function)
        or described["hash"] == hash_of_code(function, arguments_text(described, _dtypes()))
    )


def arguments_text(described: dict[str, Any], dtypes: Sequence[Any]) -> str:
    """Return the text of what a loop takes and returns, part of its hash."""

    def whole(kind: Any) -> Any:
        if isinstance(kind, list):
            return [whole(one) for one in kind]
        if isinstance(kind, dict):
            return {key: dtypes[x] if key in ("array", "record") else x for key, x in kind.items()}
        return kind

    return kinds_text(whole(described["arguments"]), whole(described["returns"]))


@functools.cache
def _native_codes(function: Callable[..., Any]) -> list[NativeCode]:
    """Return the package's code of a loop; none where there is none, or where its kernels have changed."""
    if why_not_shipped():
        return []
    found = _index()["loops"].get(name_with_values(function), [])
    return [
        NativeCode(one, _dtypes(), functools.partial(_bitcode, one["name"]))
        for one in found
        if _is_current(function, one)
    ]


def current_codes(source: LoopSource) -> list[NativeCode]:
    """Return the package's code of a loop as it is declared today: its kernels may be the same while its records are others.

    (What is called by its address alone is never asked whether its arguments are of these kinds.)
    """
    codes, takes = _native_codes(source.function), source.takes
    return [one for one in codes if takes is None or arguments_text(one.described, _dtypes()) == takes]


def describe_loops() -> str:
    """Return where compiled loops come from, in a sentence."""
    why = why_not_shipped()
    if why:
        return f"compiled here: {why}"
    return f"{len(_index()['loops'])} lie ready in the package"


def _bitcode(name: str) -> bytes:
    import lzma  # (Pyodide's Python has none)

    try:
        return lzma.decompress((FOLDER / f"{name}.bc.xz").read_bytes())
    except lzma.LZMAError:
        raise UnusableError from None


def is_shipped(function: Callable[..., Any]) -> bool:
    """Return whether the package has code of a loop."""
    return bool(_native_codes(function))


def is_kept(function: Callable[..., Any]) -> bool | None:
    """Return whether a loop of the package is at hand as machine code for this processor; None for one that it has not."""
    codes = _native_codes(function)
    return any(one.is_kept() for one in codes) if codes else None


def shipped_loop(source: LoopSource) -> NativeLoop | None:
    """Return a loop of the package; None where it has none, and Numba is to compile it."""
    made = recorder(source) if recorder is not None else None
    if made is not None:
        return made
    codes = current_codes(source)
    return NativeLoop(source, codes) if codes else None


# While the package's code is built: what makes it of a loop (carom.core.jit.build).
recorder: Callable[[LoopSource], NativeLoop | None] | None = None
