"""Compile kernels and loops with Numba, and cache them; the other rooms use Numba only through this one.

``register_jitable`` makes a kernel callable from compiled code while it stays a plain function for Python. Compiled loops
are cached by Numba in a folder that is named after a hash of carom's sources: Numba looks only at the file of the function
that it caches, and would go on using a loop whose kernels, in other files, have changed.

Signatures are written with Python's own types (:func:`signature`), so that a module which compiles a loop need not import
Numba::

    loop = njit(follow, signature=signature((int, int), array_of(WORLD), array_of(float, 2), float), _nrt=False)

Loops that lie ready in the package (:mod:`carom.core.jit.native`) are taken from there: Numba is then not even imported.
"""

from __future__ import annotations

import contextlib
import functools
import inspect
import os
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from carom.core.jit.cache import cache_folder
from carom.core.jit.kernel import DERIVED, HOT, KERNELS, PLAIN
from carom.core.jit.native import LoopSource, is_kept, is_shipped, kinds_text, shipped_loop
from carom.core.jit.threads import listen, thread_count
from carom.errors import CaromError

_registered: set[Callable[..., Any]] = set()

# Called from compiled code only: the wrappers for Python would take a sixth of the compiling. And no kernel of ours makes an
# array: counting who holds those that it is handed (_nrt, a private option of Numba's) takes time.
KERNEL_OPTIONS = {"error_model": "numpy", "no_cpython_wrapper": True, "no_cfunc_wrapper": True, "_nrt": False}


@contextmanager
def _numba_cache() -> Iterator[None]:
    """Point Numba's cache at ours while a function is compiled, and back: a user's own functions keep theirs."""
    import numba

    before = numba.config.CACHE_DIR
    numba.config.CACHE_DIR = str(cache_folder())
    try:
        yield
    finally:
        numba.config.CACHE_DIR = before


def _kept_if_possible(compiled: Callable[[bool], Any], keep: bool) -> Any:
    """Return what ``compiled(keep)`` returns; ``compiled(False)`` where nothing can be kept: a full disk, a folder that is none."""
    # (Numba would keep it beside the source, where it does not see that other files have changed)
    keep = keep and os.access(cache_folder(), os.W_OK)
    with _numba_cache():
        try:
            return compiled(keep)
        except OSError:
            if not keep:
                raise
            return compiled(False)


def register_kernels() -> None:
    """Make every kernel marked so far callable from compiled code."""
    from numba.extending import overload, register_jitable

    _register_plain()
    for function in KERNELS:
        if function not in _registered:
            # (a law of a user's own may do whatever Numba can)
            own = str(function.__module__).startswith("carom.")
            options = {**KERNEL_OPTIONS, **linked_only(cache_folder())} if own else {**KERNEL_OPTIONS, "_nrt": True}
            if isinstance(function, functools._lru_cache_wrapper):
                overload(function, jit_options=options, strict=False)(_without_keeping(function))
            elif function in DERIVED:
                overload(function, jit_options=options, strict=False)(_for_plain_numbers(function))
            else:
                register_jitable(forceinline=function in HOT, **options)(function)
            _registered.add(function)


def _without_keeping(function: Any) -> Callable[..., Any]:
    """Return the compiled form of a kernel whose answers Python keeps: it computes them anew."""
    return lambda *types: function.__wrapped__


def _for_plain_numbers(function: Callable[..., Any]) -> Callable[..., Any]:
    return lambda *types: function if plain_numbers(*types) else None


@functools.cache
def _register_plain() -> None:
    """Tell the compiler what the functions of numbers with derivatives are of plain numbers."""
    from numba.extending import overload

    def typed(work: Callable[..., Any], arguments: int) -> Callable[..., Any]:
        if arguments == 1:
            return lambda x: work if plain_numbers(x) else None
        return lambda x, gap, rate: work if plain_numbers(x, gap, rate) else None

    for function, work in PLAIN.items():
        overload(function, strict=False)(typed(work, len(inspect.signature(work).parameters)))


# --- types, without an import of Numba by those who need them -----------------------------------------------------------


class ArrayOf(NamedTuple):
    """A C-contiguous array of ``axes`` axes, whose items are of a Python type or a NumPy dtype."""

    item: Any
    axes: int = 1


class NamedTupleOf(NamedTuple):
    """A NamedTuple of a class, with items as described."""

    kind: type
    items: tuple[Any, ...]


def named_tuple_type(kind: type, *items: Any) -> NamedTupleOf:
    """Describe a NamedTuple with items as described, for :func:`signature`."""
    return NamedTupleOf(kind, items)


class Signature(NamedTuple):
    """Types of a function's result and arguments, each described as for :func:`numba_type`."""

    returns: Any
    arguments: tuple[Any, ...]


def array_of(item: Any, axes: int = 1) -> ArrayOf:
    """Describe a C-contiguous array for :func:`signature`: ``item`` is float, int, bool, or a NumPy dtype (of records, too)."""
    return ArrayOf(item, axes)


def numba_type(described: Any) -> Any:
    """Return Numba's type for a description.

    ``float``, ``int`` and ``bool`` have 64, 64 and 8 bits, None is no value, a NumPy dtype stands for one item of it (a
    record), :func:`array_of` for an array, a tuple of descriptions for a tuple. A type of Numba's is returned as it is.
    """
    from numba import from_dtype, types

    plain = {float: types.float64, int: types.int64, bool: types.boolean, None: types.none}
    if isinstance(described, ArrayOf):
        return types.Array(numba_type(described.item), described.axes, "C")
    if isinstance(described, NamedTupleOf):
        return types.NamedTuple(tuple(numba_type(one) for one in described.items), described.kind)
    if isinstance(described, np.dtype):
        return from_dtype(described)
    if isinstance(described, tuple):
        return types.Tuple([numba_type(one) for one in described])
    return plain[described] if described in (float, int, bool, None) else described


def _kind(described: Any) -> Any:
    """Return the kind that a description stands for among those of :mod:`carom.core.jit.native`."""
    if isinstance(described, ArrayOf):
        return {"array": np.dtype(described.item), "axes": described.axes, "readonly": False}
    if isinstance(described, np.dtype):
        return {"record": described}
    if isinstance(described, tuple):
        return [_kind(one) for one in (described.items if isinstance(described, NamedTupleOf) else described)]
    return {float: "float64", int: "int64", bool: "bool", None: "none"}[described]


def signature(returns: Any, *arguments: Any) -> Signature:
    """Describe a function, each type as for :func:`numba_type`."""
    return Signature(returns, arguments)


def numba_signature(described: Any) -> Any:
    """Return Numba's signature of a function for its description; a signature of Numba's is returned as it is."""
    if isinstance(described, Signature):
        return numba_type(described.returns)(*map(numba_type, described.arguments))
    return described


def call_compiled(function: Callable[..., Any], provide: Callable[[], Callable[..., Any]]) -> None:
    """Have compiled code that calls ``function`` call the one that ``provide()`` returns, compiled by itself.

    Python goes on calling ``function``. ``provide`` is called when a caller is compiled, once for each caller.
    """
    from numba.extending import overload

    options = {**KERNEL_OPTIONS, **linked_only(cache_folder())}
    overload(function, jit_options=options)(call_of(function, provide, True))


def call_of(function: Callable[..., Any], provide: Callable[[], Callable[..., Any]], plain: bool) -> Callable[..., Any]:
    """Return what Numba's ``overload`` takes: a call of ``provide()`` for plain numbers, or else for numbers with derivatives."""
    # Numba wants the arguments by name, the same in both functions, and without annotations
    names = ", ".join(inspect.signature(function).parameters)
    space: dict[str, Any] = {"provide": provide, "is_plain": plain_numbers, "plain": plain}
    exec(
        f"def typed({names}):\n    if is_plain({names}) != plain:\n        return None\n    part = provide()\n"
        f"    def call({names}):\n        return part({names})\n    return call\n",
        space,
    )
    return space["typed"]  # type: ignore[no-any-return]


def plain_numbers(*kinds: Any) -> bool:
    """Return whether Numba's types are numbers and tuples of numbers (and none of numbers with derivatives)."""
    from numba import types

    return all(
        plain_numbers(*one) if isinstance(one, types.BaseTuple) else isinstance(one, types.Number | types.Boolean)
        for one in kinds
    )


# --- compiled functions ----------------------------------------------------------------------------------------------


def is_at_hand(function: Callable[..., Any]) -> bool:
    """Return whether a loop is machine code already, in the process or in the cache."""
    kept = is_kept(function)
    return is_cached(function) if kept is None else kept


def is_cached(function: Callable[..., Any]) -> bool:
    """Return whether the compiled code of a loop lies in the package or in the cache, for some signature."""
    if is_shipped(function):
        return True
    name = f"{function.__module__.rpartition('.')[2]}.{function.__qualname__}"
    try:
        return any(cache_folder().glob(f"*/{name}-*.nbi"))
    except OSError:  # another process removes folders of old versions at this moment
        return False


def compiling_failed() -> type[Exception]:
    """Return the class of what the compiler raises for code that it refuses."""
    from numba.core.errors import NumbaError

    return NumbaError


@functools.cache
def _has_numba() -> bool:
    """Return whether Numba is installed: a browser has none (docs/howto/explorer.md)."""
    return find_spec("numba") is not None


def compiler_is_off() -> bool:
    """Return whether Numba was told to compile nothing, or is not there."""
    if sys.modules.get("numba") is None:  # (its import takes half a second)
        return not _has_numba() or os.environ.get("NUMBA_DISABLE_JIT", "0").strip() not in ("", "0")
    import numba

    return bool(numba.config.DISABLE_JIT)


def _require_compiler() -> None:
    """Raise CaromError where nothing is compiled: loops read records, and count in 32 and 64 bits, as compiled code does."""
    computed = "single impacts, arrays of them, and short runs are computed in Python"
    if not _has_numba():
        raise CaromError(
            f"numba: expected to be installed for what runs as compiled code, and is not; install it ({computed})"
        )
    if compiler_is_off():
        raise CaromError(
            "NUMBA_DISABLE_JIT: expected 0, or no such variable, for what runs as compiled code, got"
            f" {os.environ.get('NUMBA_DISABLE_JIT', '1')}; unset it ({computed})"
        )


def njit(
    function: Callable[..., Any],
    signature: Signature | None = None,
    needs: Sequence[Callable[[], Any]] = (),
    **options: Any,
) -> Callable[..., Any]:
    """Return a loop over kernels as machine code, with the same bits as Python: shipped with the package, or compiled here.

    With a signature it is compiled, or loaded, at once and for nothing else. ``needs`` are called before anything is compiled.
    CaromError where Numba was told to compile nothing.
    """
    _require_compiler()
    compile_here = functools.partial(_compile, function, signature, needs, options)
    takes = None if signature is None else kinds_text(list(map(_kind, signature.arguments)), _kind(signature.returns))
    source = LoopSource(function, signature, needs, options, compile_here, takes)
    return shipped_loop(source) or compile_here()


def _compile(
    function: Callable[..., Any], signature: Signature | None, needs: Sequence[Callable[[], Any]], options: dict[str, Any]
) -> Any:  # fmt: skip
    """Return Numba's dispatcher of a loop; fastmath stays off, so that it gives the same bits as Python."""
    import numba

    for prepare in needs:
        prepare()
    register_kernels()
    listen()
    options = {"error_model": "numpy", "cache": True, **options}
    if options.get("parallel"):
        function.__globals__["prange"] = numba.prange
        numba.set_num_threads(thread_count())

    def compiled(keep: bool) -> Any:
        made = numba.njit(**options | {"cache": keep})(function)
        if signature is not None:
            made.compile(numba_signature(signature))
            made.disable_compile()
        return made

    return _kept_if_possible(compiled, options["cache"])


def cfunc(
    function: Callable[..., Any], numbers: int, keep: bool = False, places: int = 1, needs: Sequence[Callable[[], Any]] = ()
) -> Any:  # fmt: skip
    """Return a function of so many floats and of so many places of floats, with its ``address``; ``keep`` what is compiled."""
    _require_compiler()

    def compile_here() -> Any:
        import numba
        from numba import types

        for prepare in needs:
            prepare()
        register_kernels()
        signature = types.void(*[types.float64] * numbers, *[types.CPointer(types.float64)] * places)
        return _kept_if_possible(lambda kept: numba.cfunc(signature, error_model="numpy", cache=kept)(function), keep)

    source = LoopSource(function, None, needs, {}, compile_here, plain=(numbers, places))
    return (shipped_loop(source) if keep else None) or compile_here()


# ----------------------------------------------------------------------------------------------------
# Compile kernels for their callers only: to LLVM's intermediate code, not to machine code.
#
# Numba brings every function to machine code, optimised together with all that it calls, and then the same once more within each
# of its callers. For kernels, which only compiled code calls, that is half of the compile time, for nothing: here they are
# typed, lowered and linked, and optimised once, in the loop that calls them. The machine code of that loop is as fast.
#
# This relies on internals of Numba (as of 0.68). It is tried on one small function first; where Numba has changed, kernels are
# compiled in the ordinary way, in twice the time (:func:`linked_only`).


# Numba's passes that kernels have nothing for: expressions of arrays, comprehensions, functions within functions.
LEFT_OUT = {"nopython_rewrites", "inline_closure_likes"}


@functools.cache
def linked_only(folder: Path) -> dict[str, Any]:
    """Return options for ``numba.extending.register_jitable``; none if its internals have changed. ``folder``: the cache's."""
    import numba

    # (the trial takes longer than loading what is compiled)
    tried = folder / f"linked_with_numba_{numba.__version__}"
    try:
        options = {"pipeline_class": linked_pipeline()}
        if not tried.exists():
            _try(options)
            with contextlib.suppress(OSError):
                tried.parent.mkdir(parents=True, exist_ok=True)
                tried.touch()
    except Exception:  # whatever it is, there is the ordinary way
        return {}
    return options


def _try(options: dict[str, Any]) -> None:
    """Compile a function that calls another one, which is linked only."""
    import numba
    from numba.extending import register_jitable

    @register_jitable(no_cpython_wrapper=True, no_cfunc_wrapper=True, **options)  # type: ignore[untyped-decorator]
    def half(x: float) -> float:
        return x / 2

    @numba.njit("float64(float64)")  # type: ignore[untyped-decorator]
    def quarter(x: float) -> float:
        return half(half(x))  # type: ignore[no-any-return]

    if quarter(1.0) != 0.25:
        raise AssertionError


def linked_pipeline() -> Any:
    """Return Numba's compiler with a last step that links a function and makes no machine code of it."""
    from numba import _dynfunc
    from numba.core.codegen import JITCodeLibrary
    from numba.core.compiler import CompilerBase, DefaultPassBuilder, _LowerResult
    from numba.core.compiler_machinery import register_pass
    from numba.core.lowering import Lower
    from numba.core.typed_passes import BaseNativeLowering, NativeLowering

    class Linked(JITCodeLibrary):  # type: ignore[misc]
        """A function with what it calls, to be linked into its callers."""

        def finalize(self) -> None:
            for library in dict.fromkeys(self._linking_libraries):
                self._reload_init.update(library._reload_init)
                self._final_module.link_in(library._get_module_for_linking(), preserve=True)
            self._finalize_dynamic_globals()
            # (as Numba has it of what is linked more than once; no machine code, so no need of a copy)
            for function in self._final_module.functions:
                if not function.is_declaration and function.linkage.name == "external":
                    function.linkage = "linkonce_odr"
            self._shared_module = self._final_module
            self._finalized = True

    @register_pass(mutates_CFG=False, analysis_only=False)
    class LinkedLowering(BaseNativeLowering):  # type: ignore[misc]
        """Numba's lowering, without an address at its end."""

        _name = "carom_linked_lowering"
        lowering_class = Lower

        def run_pass(self, state: Any) -> bool:
            state.library = library = Linked(state.targetctx.codegen(), state.func_id.func_qualname)
            state.flags.no_compile = True
            try:
                super().run_pass(state)
            finally:
                state.flags.no_compile = False
            library.finalize()
            state.reload_init.extend(library._reload_init)
            # What callers know the function by. It cannot be called from Python, and so has no use for its environment.
            made = state["cr"]
            described = made.fndesc
            name = described.qualname.split(".")[-1]
            key = _dynfunc.make_function(described.lookup_module(), name, "", 0, made.env, (library,))
            state.targetctx.insert_user_function(key, described, [library])
            state["cr"] = _LowerResult(described, made.call_helper, cfunc=key, env=made.env)
            return True

    class LinkedCompiler(CompilerBase):  # type: ignore[misc]
        """Numba's passes, with another last one, and without what kernels do not need."""

        def define_pipelines(self) -> list[Any]:
            passes = DefaultPassBuilder.define_nopython_pipeline(self.state)
            kept = [(one, text) for one, text in passes.passes if one.name() not in LEFT_OUT]
            passes.passes = [(LinkedLowering if one is NativeLowering else one, text) for one, text in kept]
            passes.finalize()
            return [passes]

    return LinkedCompiler
