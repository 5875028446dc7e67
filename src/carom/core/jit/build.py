"""Kernels brought to code that runs without Numba: the package's loops (`make native`), and the page's module (`make wasm`).

Numba types and lowers each with all that it calls (:mod:`carom.core.jit.lowering`). A loop of the package, of those that
carom.cli.doctor names, is optimised for any processor, and kept as bitcode beside an index that says what it takes and returns
(:mod:`carom.core.jit.native`). The jobs of carom.cli.doctor are run here with these very loops, so that the list is the same and
each loop has run before it is kept. What is current is left as it lies.
"""

from __future__ import annotations

import functools
import itertools
import json
import lzma
import re
import subprocess
import sys
import tempfile
from collections.abc import Callable, Collection, Iterator, Sequence
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path
from typing import Any, NamedTuple

from carom.core.jit import native
from carom.core.jit.cache import hash_of_files, name_with_values
from carom.core.jit.compile import numba_signature, register_kernels
from carom.core.jit.lowering import CFunction, LoweringError, linked_dispatcher, llvm_text, whole_module, with_entry
from carom.core.jit.native import FOLDER, INDEX, LoopSource, NativeCode, NativeLoop, dtype_text, library_version
from carom.errors import CaromError

# Loops over numbers become vectors of four for any processor: LLVM has them computed in halves, or one by one, where there are none
# so wide. Their code is plain: no gathers, no masks. Without vectors gases take 1.3 times as long, many orbits 1.5 to 8 times.
FOUR_WIDE = "x86-64-v3"
# Where so much of the code becomes vectors, that is left to the user's machine, which may have wider ones: at most 0.4 s, once.
MOSTLY_VECTORS = 0.1


class NativeBuild:
    """The package's loops in the making: those that are current, and those that are asked for and are not."""

    def __init__(self) -> None:
        self.made: dict[str, list[NativeCode]] = {}
        self.failed: dict[str, str] = {}
        self.bitcode: dict[str, bytes] = {}
        self._loops: dict[tuple[str, str | None], BuiltLoop] = {}
        self.dtypes: list[Any] = []
        self._before: dict[str, Any] = {}
        self._files = _hash_of_files()
        if INDEX.exists() and not native.native_is_off():
            self.dtypes, self._before = list(native._dtypes()), native._index()["loops"]

    @contextmanager
    def recording(self) -> Iterator[None]:
        """While inside, every loop that is asked for and is not current is built, and run as built."""
        native.recorder = self._loop
        try:
            yield
        finally:
            native.recorder = None

    def _loop(self, source: LoopSource) -> NativeLoop | None:
        from numba.core.errors import NumbaError

        if source.options.get("cache") is False:  # a law of the user's own
            return None
        key, takes = name_with_values(source.function), source.takes
        if (key, takes) not in self._loops:
            current = native.current_codes(source)
            try:
                self._loops[key, takes] = BuiltLoop(self, source, key, current)
            except (NumbaError, LoweringError) as error:
                self.note_failure(key, error)
                return None  # (asked again, Numba is asked again)
        return self._loops[key, takes]

    def note_failure(self, key: str, error: Exception) -> None:
        """Note that a loop cannot be built: Numba compiles it on the user's machine."""
        self.failed[key] = str(error).strip().splitlines()[0]

    def add(self, key: str, source: LoopSource, dispatcher: Any, kinds: Sequence[Any], returns: Any) -> NativeCode:
        """Keep a loop that was lowered for arguments of these types of Numba's."""
        codes, known = self.made.setdefault(key, []), native._native_codes(source.function)
        taken = {one.described["name"] for one in (*codes, *known)}
        names = (_file_name(key) + (f"-{k}" if k else "") for k in itertools.count())
        name = next(one for one in names if one not in taken)
        made = _optimised(name, source, dispatcher, kinds)
        arguments = [self._described(kind) for kind in kinds]
        described = {
            "name": name,
            "arguments": arguments,
            "returns": "none" if source.plain else self._described(returns),
            "fixed": source.signature is not None,
            "parallel": bool(source.options.get("parallel")),
            "nogil": bool(source.options.get("nogil")),
            **made,
        }
        self.bitcode[name] = described.pop("bitcode")
        described["hash"] = native.hash_of_code(source.function, native.arguments_text(described, self.dtypes))
        described["files"] = native.hash_of_kernel_files(source.function)
        codes.append(NativeCode(described, self.dtypes, lambda: self.bitcode[name]))
        return codes[-1]

    def note_use(self, key: str, code: NativeCode, function: Callable[..., Any]) -> None:
        """Note that a job needs this code of a function: what none needs any more is not kept."""
        codes = self.made.setdefault(key, [])
        if code not in codes:
            code.described["files"] = native.hash_of_kernel_files(function)
            codes.append(code)

    def _described(self, kind: Any) -> Any:
        """Return the description of one of Numba's types (:func:`carom.core.jit.native.argument_writers`)."""
        from numba import types
        from numba.np.numpy_support import as_dtype

        if isinstance(kind, types.BaseTuple):
            return [self._described(one) for one in kind]
        if isinstance(kind, types.Array):
            return {"array": self._dtype(as_dtype(kind.dtype)), "axes": kind.ndim, "readonly": not kind.mutable}
        if isinstance(kind, types.Record):
            return {"record": self._dtype(as_dtype(kind))}
        if isinstance(kind, types.CPointer):
            return "int64"
        return {"none": "none", "float64": "float64", "int64": "int64", "bool": "bool"}[str(kind)]

    def _dtype(self, dtype: Any) -> int:
        if dtype not in self.dtypes:
            self.dtypes.append(dtype)
        return self.dtypes.index(dtype)

    def write(self, done: bool = True) -> list[Path]:
        """Write the index and what was built; return the files.

        ``done``: all jobs have run, and what no loop has any more is removed; else what is written is for a later build to resume.
        """
        FOLDER.mkdir(exist_ok=True)
        loops = {key: [code.described for code in codes] for key, codes in self.made.items() if codes}
        for key, before in () if done else self._before.items():
            now = loops.setdefault(key, [])
            now += [one for one in before if one["name"] not in {code["name"] for code in now}]
        names = {one["name"] for codes in loops.values() for one in codes}
        written = []
        for name, bitcode in self.bitcode.items():
            written.append(FOLDER / f"{name}.bc.xz")
            written[-1].write_bytes(lzma.compress(bitcode, preset=9 | lzma.PRESET_EXTREME))
        for path in FOLDER.glob("*.bc.xz"):
            if path.name.removesuffix(".bc.xz") not in names:
                path.unlink()
        if self._files != _hash_of_files():  # (edited while it was built)
            for one in itertools.chain(*loops.values()):
                one["files"] = ""
        index = {
            "built_with": _versions(),
            "dtypes": [dtype_text(one) for one in self.dtypes],
            "loops": dict(sorted(loops.items())),
        }
        INDEX.write_text(json.dumps(index, indent=1) + "\n", encoding="utf-8")
        return written


class BuiltLoop(NativeLoop):
    """A loop that is built for every kind of arguments that it is called with."""

    def __init__(self, build: NativeBuild, source: LoopSource, key: str, current: list[NativeCode]) -> None:
        super().__init__(source, current)
        self._build, self._key, self._dispatchers = build, key, list[Any]()
        if current:
            if source.plain is not None or source.signature is not None:
                build.note_use(key, current[0], source.function)
            return
        if source.plain is not None:
            from numba import types

            numbers, places = source.plain
            arguments = [types.float64] * numbers + [types.CPointer(types.float64)] * places
            self._add(arguments, types.void(*arguments))
        elif source.signature is not None:
            for prepare in source.needs:
                prepare()
            kind = numba_signature(source.signature)
            self._add(kind.args, kind)

    def __call__(self, *arguments: Any) -> Any:
        """Call the code for arguments of these kinds, built if there is none."""
        from numba import typeof
        from numba.core.errors import NumbaError

        if (found := self.code_for(arguments)) is not None:
            self._build.note_use(self._key, found[0], self.source.function)
            return found[0].call(arguments, found[1])
        if self.source.signature is not None:
            raise TypeError(f"{self._key}: expected arguments of its signature, got others")
        kinds = tuple(map(typeof, arguments))
        try:
            self._add(kinds, kinds)
        except (NumbaError, LoweringError) as error:
            self._build.note_failure(self._key, error)
            return self.source.compile_here()(*arguments)
        return self.codes[-1].call(arguments, self.codes[-1].given(arguments))

    def _add(self, arguments: Sequence[Any], signature: Any) -> None:
        for prepare in self.source.needs:
            prepare()
        register_kernels()
        if self.source.options.get("parallel"):
            self.py_func.__globals__["prange"] = part_range()
        try:
            made = linked_dispatcher(self.py_func, signature)
        finally:
            if self.source.options.get("parallel"):
                self.py_func.__globals__["prange"] = range
        self._dispatchers.append(made)
        returns = next(iter(made.overloads.values())).signature.return_type
        self.codes.append(self._build.add(self._key, self.source, made, arguments, returns))

    def numbas(self) -> Any:
        """Return the code that callers link when they are built."""
        if not self._dispatchers:  # (its code is current, a caller's is not)
            for prepare in self.source.needs:
                prepare()
            register_kernels()
            self._dispatchers.append(linked_dispatcher(self.py_func, numba_signature(self.source.signature)))
        return self._dispatchers[0]


@functools.cache
def part_range() -> Any:
    """Return the range of a parallel loop in code for one of several threads: its share of the steps.

    The entry's place for an error is followed by the number of this part and of all parts.
    """
    from llvmlite import ir
    from numba import types
    from numba.extending import intrinsic

    @intrinsic  # type: ignore[untyped-decorator]
    def share(typing: Any, count: Any) -> Any:
        function = typing.resolve_value_type(range)
        kind = typing.resolve_function_type(function, (types.int64, types.int64), {})

        def build(context: Any, builder: Any, _signature: Any, args: Any) -> Any:
            whole = ir.IntType(64)
            place = builder.bitcast(builder.function.args[1], whole.as_pointer())
            part, parts = (builder.load(builder.gep(place, [ir.Constant(whole, k)])) for k in (1, 2))
            after = builder.add(part, ir.Constant(whole, 1))
            builder.assume(builder.icmp_signed(">=", part, ir.Constant(whole, 0)))
            ends = [builder.sdiv(builder.mul(args[0], one), parts) for one in (part, after)]
            return context.get_function(function, kind)(builder, ends)

        return kind.return_type(types.int64), build

    return share


def _optimised(name: str, source: LoopSource, dispatcher: Any, kinds: Sequence[Any]) -> dict[str, Any]:
    """Return the entry of the index for a loop, and its bitcode."""
    import llvmlite.binding as llvm

    entry = f"carom_{name}"
    numbas, text = llvm_text(dispatcher)
    plain = source.plain is not None
    made = with_entry(
        CFunction(entry, True, not plain, not plain, not plain),
        kinds,
        numbas,
        text.replace(" = common ", " = internal "),
    )
    parts = [_module(made, {entry, numbas}, wide) for wide in (False, True)]
    (_, before), (lines, after) = map(_count_vectors, parts)
    vectorise = after - before > MOSTLY_VECTORS * lines
    module = parts[0 if vectorise else 1]
    module.get_function(numbas).name = f"numba_{name}"
    declared = {one.name for one in module.functions if one.is_declaration}
    if foreign := [one for one in declared if one.startswith(("NRT_", "Py", "numba_", "llvm.x86"))]:
        raise LoweringError(
            f"{name}: expected a loop that makes no arrays and calls no Python, got calls of {', '.join(foreign)}"
        )
    # (what LLVM has an intrinsic for may become a call of libm)
    called = {one for one in declared if not one.startswith("llvm.")}
    called |= {
        m for one in declared for m in re.findall(r"^llvm\.(sin|cos|tan|exp|log|pow|exp2|log2|log10)\.f64$", one)
    }
    return {
        "vectorise": vectorise,
        "calls": sorted(called),
        "llvm": list(llvm.llvm_version_info),
        "bitcode": bytes(module.as_bitcode()),
    }


def _module(text: str, kept: Collection[str], wide: bool) -> Any:
    """Return LLVM's module of a text, optimised for any processor: with vectors of four, or as a machine is to vectorise it."""
    import llvmlite.binding as llvm

    module = whole_module([text], kept)
    llvm.initialize_native_target()
    machine = llvm.Target.from_default_triple().create_target_machine(
        cpu=FOUR_WIDE if wide else "x86-64", opt=3, codemodel="jitdefault", jit=True
    )
    options = llvm.create_pipeline_tuning_options(speed_level=3 if wide else 2)
    options.slp_vectorization = False
    options.loop_vectorization = options.loop_unrolling = options.loop_interleaving = wide
    builder = llvm.create_pass_builder(machine, options)
    builder.getModulePassManager().run(module, builder)
    names = llvm.create_new_module_pass_manager()
    names.add_strip_symbols_pass()
    names.add_strip_dead_prototype_pass()
    names.run(module, builder)
    return module


def _count_vectors(module: Any) -> tuple[int, int]:
    """Return how many instructions a module has, and how many of them are about vectors of numbers."""
    lines = [line for line in str(module).splitlines() if line.startswith("  ")]
    return len(lines), sum(" x double>" in line for line in lines)


def _file_name(key: str) -> str:
    """Return a short name of a loop for a file: its module and function, and what it holds."""
    function, *held = key.split(" ")
    parts = [function.removeprefix("carom.").replace(".<locals>", ""), *(one.rpartition(".")[2] for one in held)]
    return re.sub(r"[^A-Za-z0-9_]+", "-", "-".join(parts))


def _hash_of_files() -> str:
    return hash_of_files(Path(__file__).parents[2])


def _versions() -> dict[str, str]:
    import numba

    return {"numba": numba.__version__, "llvmlite": library_version()}


# ----------------------------------------------------------------------------------------------------
# The page's WebAssembly module: the very code that Numba makes of kernels, brought to another machine.
#
# The text (:mod:`carom.core.jit.lowering`) is told to be for WebAssembly, is optimised and brought to an object by llvmlite, which
# carries that target, and is linked with musl's mathematical functions (libm), so that all browsers give the same bits. Linker
# and C compiler are ziglang's.

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
