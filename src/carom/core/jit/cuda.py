"""Compile loops for a GPU by numba-cuda: the very loops and kernels that the cores run.

A loop whose steps do not depend on each other goes through Numba's ``prange`` on the cores; here each thread of the GPU takes the
steps that are left to it (:func:`grid_range`). All is in double precision; products and sums are rounded one by one, as on the
cores (without fused multiply-add), and what is not + - * / or a square root is a function of NVIDIA's libdevice, whose last bit may
be another. What is called by an address on the cores has none here (:func:`answer_at`): a caller gives what takes its place.

This relies on how numba-cuda drives its compiler (as of 0.30), which has no option for fused multiply-add.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from types import FunctionType, SimpleNamespace
from typing import Any

import numpy as np

from carom.core.jit.cache import cache_folder
from carom.core.jit.compile import numba_signature
from carom.core.jit.kernel import HOT, KERNELS, ON_GPU
from carom.core.jit.pointers import answer_at

__all__ = ["CudaLoop", "aligned", "computes_on_gpu", "computing_on_gpu", "grid_range", "on_device", "ptx", "why_no_gpu"]

THREADS = 128  # of a block
MOST_THREADS = 1 << 20  # of a grid: what is more is taken in strides
# Longer functions are called, not copied into their callers: the instructions are Numba's, before any of them is optimised away.
LONGEST_COPIED = 300

# The module of numba-cuda, once it is asked for: a global, so that its simulator can stand in for it.
cuda: Any = None
_registered: set[Callable[..., Any]] = set()
_on_gpu: ContextVar[bool] = ContextVar("carom_on_gpu", default=False)


@contextmanager
def computing_on_gpu() -> Iterator[None]:
    """Have loops over rows of arrays, and loops of sweeps, run on the GPU."""
    before = _on_gpu.set(True)
    try:
        yield
    finally:
        _on_gpu.reset(before)


def computes_on_gpu() -> bool:
    """Return whether loops run on the GPU here."""
    return _on_gpu.get()


def why_no_gpu() -> str:
    """Return why nothing can be computed on a GPU, and what to do; empty if it can."""
    global cuda  # noqa: PLW0603
    try:
        from numba import cuda as found

        from_package = "numba_cuda" in str(found.__file__)
    except ImportError:
        from_package = False
    if not from_package:  # (Numba has a module of that name, which is no longer kept)
        return "got no numba-cuda (carom's extra cuda)"
    cuda = found
    if _simulated() or cuda.is_available():
        return ""
    try:
        cuda.current_context()
    except Exception as error:  # whatever the driver says
        lines = [line.strip() for line in str(error).splitlines() if line.strip(" :")]
        said = [line for line in lines if not line.endswith(":")] or [type(error).__name__]
        return f"got none ({said[0]})"
    return "got none"


def _simulated() -> bool:
    from numba.cuda.core import config

    return bool(config.ENABLE_CUDASIM)


def grid_range(count: int) -> Any:
    """Return the steps of a loop that are this thread's."""
    return range(cuda.grid(1), count, cuda.gridsize(1))


# --- compiling --------------------------------------------------------------------------------------------------------


def _register(*functions: Any) -> None:
    """Make all kernels, and some functions, callable from the GPU's code."""
    from numba.cuda import extending

    for function in {answer_at: None, **ON_GPU, **dict.fromkeys(KERNELS), **dict.fromkeys(functions)}:
        if function not in _registered and function is not grid_range:
            _registered.add(function)
            other = ON_GPU.get(function, function) if function is not answer_at else _no_answer
            options = {"forceinline": function in HOT}
            extending.overload(function, jit_options=options, strict=False)(lambda *_types, other=other: other)


def _no_answer(address: int, numbers: Any) -> Any:
    """In the place of what has an address: nothing that reaches it is computed here."""
    nan = numbers[0] * float("nan")
    return (nan, nan, nan, nan, nan, nan)


@contextmanager
def _compiling() -> Iterator[None]:
    """Have numba-cuda leave products and sums apart, and compile every function once, in what is compiled meanwhile."""
    from numba.cuda.codegen import CUDACodeLibrary
    from numba.cuda.cudadrv.nvvm import CompilationUnit

    make, add = CompilationUnit.__init__, CUDACodeLibrary.add_ir_module
    changed: list[tuple[Any, str, Any]] = [
        (CompilationUnit, "__init__", lambda self, options: make(self, {**options, "fma": False})),
        (CUDACodeLibrary, "add_ir_module", lambda self, module: add(self, _with_calls(module))),
        (CUDACodeLibrary, "modules", property(_modules_once)),
    ]
    before = [vars(kind)[name] for kind, name, _ours in changed]
    for kind, name, ours in changed:
        setattr(kind, name, ours)
    try:
        yield
    finally:
        for (kind, name, _ours), theirs in zip(changed, before, strict=True):
            setattr(kind, name, theirs)


def _with_calls(module: Any) -> Any:
    """Have the long functions of an LLVM module called: NVVM copies them into all callers (five times the size)."""
    for function in module.functions:
        size = sum(len(block.instructions) for block in function.blocks)
        if size > LONGEST_COPIED and "alwaysinline" not in function.attributes:
            function.attributes.add("noinline")
    return module


def _modules_once(library: Any) -> list[Any]:
    """Return the modules of a library and of all that it calls (numba-cuda's are as many as there are chains of calls)."""
    found, left = {}, [library]
    while left:
        one = left.pop()
        if one not in found:
            found[one] = one._module
            left.extend(one._linking_libraries)
    return list(found.values())


@contextmanager
def _cached() -> Iterator[None]:
    """Keep the GPU's code beside the cores', under the hash of carom's sources."""
    from numba.cuda.core import config

    before = getattr(config, "CACHE_DIR", "")
    config.CACHE_DIR = str(cache_folder() / "cuda")
    try:
        yield
    finally:
        config.CACHE_DIR = before


class CudaLoop:
    """A loop on the GPU.

    Parameters
    ----------
    loop : function of arrays and numbers
        Its parallel range is the global ``prange``, or one that ``names`` names.
    names : mapping, optional
        Other globals of the loop: functions that it calls, and :func:`grid_range` for its parallel range.
    """

    def __init__(self, loop: Callable[..., None], names: Mapping[str, Any] | None = None) -> None:
        self.name = f"{loop.__module__}.{loop.__qualname__}"
        self._source, self._names = loop, names or {}

    @functools.cached_property
    def _loop(self) -> Any:
        """The loop with other globals."""
        loop = self._source
        _register(*self._names.values())
        steps = cuda.jit(device=True)(grid_range)
        names = {name: steps if one is grid_range else one for name, one in self._names.items()}
        space = {**loop.__globals__, "prange": steps, **names}
        made = FunctionType(loop.__code__, space, loop.__name__, loop.__defaults__, loop.__closure__)
        made.__qualname__, made.__module__ = loop.__qualname__, loop.__module__
        return made

    @functools.cached_property
    def _kernel(self) -> Any:
        if _simulated():
            return cuda.jit(self._loop)
        with _cached():
            # (linked as PTX: the linker would contract what it compiles itself. The loop is an argument, as numba-cuda forgets
            # ``lto`` where ``jit`` is a decorator with options.)
            return cuda.jit(self._loop, cache=self._loop.__closure__ is None, lto=False)

    def on(self, threads: int, *arguments: Any) -> None:
        """Run the loop by so many threads; arrays lie on the GPU (:func:`on_device`)."""
        block = THREADS if not _simulated() else min(threads, 8)
        grid = (min(threads, MOST_THREADS) + block - 1) // block
        if _simulated():
            self._kernel[grid, block](*arguments)
            return
        with _cached(), _compiling():
            self._kernel[grid, block](*arguments)

    def __call__(self, *arguments: Any) -> None:
        """Run the loop, one thread for every row of its first array, on arrays of this machine."""
        arrays = [one for one in arguments if isinstance(one, np.ndarray)]
        with on_device(*arrays) as there:
            moved = iter(there)
            self.on(len(arrays[0]), *(next(moved) if isinstance(one, np.ndarray) else one for one in arguments))


@contextmanager
def on_device(*arrays: Any) -> Iterator[list[Any]]:
    """Copy arrays to the GPU; at the end copy them back, except read-only ones."""
    there = [cuda.to_device(one.view(aligned(one.dtype))) for one in arrays]
    yield there
    for one, here in zip(there, arrays, strict=True):
        if here.flags.writeable and here.size:
            one.copy_to_host(here.view(aligned(here.dtype)))


def aligned(dtype: np.dtype[Any]) -> np.dtype[Any]:
    """Return a type of records whose numbers are known to be aligned: others are read byte by byte here."""
    return dtype if dtype.names is None else np.dtype(dtype.descr, align=True)


def ptx(loop: CudaLoop, signature: Any, capability: tuple[int, int] = (8, 0)) -> str:
    """Return a loop as assembly of NVIDIA's (PTX), for a compute capability; no GPU is needed, only NVVM."""
    from numba.cuda import dispatcher

    before = dispatcher.get_current_device
    dispatcher.get_current_device = lambda: SimpleNamespace(compute_capability=capability)
    try:
        with _compiling():
            kinds = numba_signature(signature)
            text, _returns = cuda.compile(loop._loop, kinds, device=False, abi="numba", cc=capability)
    finally:
        dispatcher.get_current_device = before
    return str(text)
