"""A plugin of pytest: which tests a mutant is shown to, in which order, with which compiled code; and what each test reaches.

What it is to do stands in a file, as JSON (:class:`Task`), which the environment names. Kernels run as plain Python, or
compiled; then a loop that the mutant does not touch is taken from a warm cache.
"""

from __future__ import annotations

import contextlib
import functools
import hashlib
import importlib
import json
import os
import shutil
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from importlib.util import find_spec
from pathlib import Path
from types import CodeType, FrameType, FunctionType
from typing import Any, NamedTuple

import numpy as np
import pytest
from hypothesis import Phase, settings

VARIABLE = "CAROM_MUTATION"
NOT_IMPORTED = 77


class Task(NamedTuple):
    """What one run of pytest is for."""

    plain: bool
    """Kernels as plain Python."""
    record: str = ""
    """File for what each test did: outcome, time, functions that it reached."""
    reach: bool = True
    """Whether to note these functions, which takes time."""
    warm: str = ""
    """Folder with the compiled loops of the code without the mutant."""
    keep: str = ""
    """Folder to keep the compiled loops in, at the end."""
    tests: dict[str, float] | None = None
    """Tests to run, each within so many seconds, in this order; None: all."""
    if_compiled: dict[str, float] | None = None
    """Tests to run instead, in this order, where the mutant changes what is compiled."""
    limit: float = 600.0
    """Seconds for a test that ``tests`` has no time for."""


TASK = Task(**json.loads(Path(os.environ[VARIABLE]).read_text(encoding="utf-8")))
PACKAGE = ""
reached: set[str] = set()
rows: dict[str, dict[str, Any]] = {}
touched = True
stack = contextlib.ExitStack()
compiling: list[str] = []


class Late(BaseException):
    """A test that takes too long; no exception that a test would catch."""


def pytest_configure(config: pytest.Config) -> None:
    """Prepare before any test is imported."""
    global PACKAGE, touched  # noqa: PLW0603
    settings.register_profile(
        "mutants", settings.get_profile("carom"), phases=[Phase.explicit, Phase.generate], print_blob=False
    )
    settings.load_profile("mutants")
    PACKAGE = str(Path(str(find_spec("carom").origin)).parent) + os.sep  # type: ignore[union-attr]
    try:
        if TASK.plain:
            run_as_python()
        elif TASK.warm:
            touched = take_loops(Path(TASK.warm))
    except Exception as error:
        if isinstance(error, OSError):
            raise
        # (the mutant cannot even be imported)
        pytest.exit(f"{type(error).__name__}: {error}", returncode=NOT_IMPORTED)
    if TASK.record and TASK.reach:
        from carom.core.jit.threads import watch_compiling

        stack.enter_context(watch_compiling(while_compiling))
        threading.setprofile(note)


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Keep the tests that are wanted, in the order wanted."""
    if TASK.tests is None:
        return
    wanted = TASK.if_compiled if touched and TASK.if_compiled is not None else TASK.tests
    order = {name: number for number, name in enumerate(wanted)}
    config.hook.pytest_deselected(items=[item for item in items if item.nodeid not in order])
    items[:] = sorted((item for item in items if item.nodeid in order), key=lambda item: order[item.nodeid])


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Iterator[None]:
    """Run a test within its time; note what it reaches."""
    if TASK.plain:
        forget()
    reached.clear()
    if TASK.record and TASK.reach:
        # (anew for each test: Python drops a profiler in which an exception is raised, as by too_late)
        compiling.clear()
        sys.setprofile(note)
    allowed = {**(TASK.tests or {}), **(TASK.if_compiled or {})}.get(item.nodeid, TASK.limit)
    # (of the processor: other programs may run beside this one)
    signal.signal(signal.SIGPROF, too_late)
    signal.setitimer(signal.ITIMER_PROF, allowed)
    begin = time.process_time()
    row = rows[item.nodeid] = {"passed": True}
    try:
        return (yield)
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        row |= {"seconds": time.process_time() - begin, "reached": sorted(reached)}


def pytest_runtest_logreport(report: pytest.TestReport) -> None:
    """Note a failure."""
    if report.failed:
        rows[report.nodeid]["passed"] = False


def pytest_sessionfinish() -> None:
    """Write what was noted."""
    if TASK.record:
        sys.setprofile(None)
        stack.close()
        Path(TASK.record).write_text(json.dumps(rows), encoding="utf-8")
    if TASK.keep and not TASK.plain:
        from carom.core.jit.cache import cache_folder

        shutil.copytree(cache_folder(), TASK.keep, dirs_exist_ok=True, ignore=shutil.ignore_patterns("locks"))
        Path(TASK.keep, "loops.json").write_text(json.dumps(loop_hashes(Path(TASK.keep))))


def too_late(_number: int, _frame: FrameType | None) -> None:
    """The time of a test is over."""
    raise Late


def note(frame: FrameType, event: str, _argument: Any) -> None:
    """Remember which functions of the package are called; another process calls any."""
    if event == "call":
        code = frame.f_code
        if code.co_filename.startswith(PACKAGE):
            reached.add(name_of(code))
        elif code.co_name == "Popen.__init__" or (code.co_name == "__init__" and "subprocess" in code.co_filename):
            reached.add("*")


def while_compiling(name: str, finished: bool) -> None:
    """Note nothing while Numba compiles, which is much Python."""
    if not finished:
        compiling.append(name)
    elif compiling:
        compiling.pop()
    sys.setprofile(None if compiling else note)


@functools.cache
def name_of(code: CodeType) -> str:
    """Return "path:function" of the outermost function, as the mutants name it."""
    path = Path(code.co_filename.removeprefix(PACKAGE)).as_posix()
    return f"{path}:{code.co_qualname.split('.<locals>')[0]}"


def run_as_python() -> None:
    """Have loops and kernels run as plain Python, all warnings of NumPy's numbers off, as in compiled code."""
    from carom.core.jit import calls as pointers
    from carom.core.jit import compile as compiling
    from carom.core.jit.kernel import as_objects, write_back

    def njit(function: Callable[..., Any], signature: Any = None, **_options: Any) -> Callable[..., Any]:
        @functools.wraps(function)
        def loop(*arguments: Any) -> Any:
            as_python: list[Any] = []
            written: list[Any] = []
            for one in arguments:
                if isinstance(one, np.ndarray) and one.dtype.names:
                    flat = one.ndim == 1
                    as_python.append(as_objects(one) if flat else one.view(np.recarray))
                    written += [(as_python[-1], one)] if flat else []
                else:
                    as_python.append(one)
            try:
                with np.errstate(all="ignore"):
                    return function(*as_python)
            finally:
                for objects, records in written:
                    if objects:  # (a scene may have none of them)
                        write_back(objects, records)

        return loop

    compiling.njit = njit
    compiling.parallel_range = lambda: range
    pointers.address_of = lambda entry, numbers, keep=False: pointers.python_address(entry)


def forget() -> None:
    """Empty the package's caches of answers, so that a test reaches what it uses."""
    for name, module in list(sys.modules.items()):
        if name.startswith("carom.") and not name.startswith("carom.core.jit"):
            for one in vars(module).values():
                if callable(getattr(one, "cache_clear", None)):
                    one.cache_clear()


# --- compiled loops that a mutant leaves as they are ----------------------------------------------------------------------


def take_loops(warm: Path) -> bool:
    """Fill the cache of compiled loops with those that mean the same as in ``warm``; return whether there were others."""
    from carom.core.jit.cache import cache_folder

    here, known = cache_folder(), json.loads((warm / "loops.json").read_text())
    now = loop_hashes(warm)
    for index in warm.glob("*/*.nbi"):
        if now[index.name] == known[index.name]:
            for file in index.parent.glob(f"{index.stem}.*"):
                new = here / index.parent.name / file.name
                new.parent.mkdir(parents=True, exist_ok=True)
                if not new.exists():
                    os.link(file, new)
    for file in warm.glob("linked_with*"):
        here.mkdir(parents=True, exist_ok=True)
        (here / file.name).touch()
    return bool(now != known)


def loop_hashes(warm: Path) -> dict[str, str]:
    """Return what each compiled loop of a folder means: the code of all that it calls, and the numbers that it refers to."""
    hashes, found = {}, []
    for index in sorted(warm.glob("*/*.nbi")):
        name, ours, module = index.name.removesuffix(".nbi").rpartition("-carom.")
        function = None
        if ours:
            home = importlib.import_module("carom." + module.rpartition(".py")[0])
            function = getattr(home, name.split(".", maxsplit=1)[1], None)
            function = getattr(function, "__wrapped__", function)
        found.append((index.name, function if isinstance(function, FunctionType) else None))
    from carom.core.jit.kernel import KERNELS

    # (one that is made by a function, or is a test's own, may call any kernel; all are there once their modules are)
    for path in sorted(Path(PACKAGE).glob("*/**/*.py")):
        if path.relative_to(PACKAGE).parts[0] in ("core", "laws"):
            name = path.relative_to(PACKAGE).with_suffix("").as_posix().replace("/", ".")
            importlib.import_module(f"carom.{name}".removesuffix(".__init__"))
    every = meaning(*(one for one in KERNELS if one.__module__.startswith(("carom.core.", "carom.laws."))))
    for name, function in found:
        hashes[name] = meaning(function) if function is not None else every
    return hashes


def meaning(*functions: Callable[..., Any]) -> str:
    """Return a hash of the code of functions, of what they call, and of the numbers that they refer to."""
    seen, todo, parts = set[str](), [f for f in functions if isinstance(f, FunctionType)], set[str]()
    while todo:
        function = todo.pop()
        name = f"{function.__module__}:{function.__qualname__}"
        if name in seen:
            continue
        seen.add(name)
        parts.add(name + code_text(function.__code__))
        cells = [cell.cell_contents for cell in function.__closure__ or ()]
        values = [function.__globals__[n] for n in sorted(names_of(function.__code__)) if n in function.__globals__]
        for value in (getattr(one, "__wrapped__", one) for one in [*cells, *values]):
            if isinstance(value, FunctionType):
                todo += [value] if value.__module__.startswith("carom.") else []
            elif isinstance(value, np.ndarray):
                parts.add(name + hashlib.sha256(value.tobytes()).hexdigest())
            elif isinstance(value, (int, float, str, tuple, np.dtype)):
                parts.add(name + repr(value))
            elif isinstance(value, type) and hasattr(value, "_fields"):
                parts.add(name + repr(value._fields))
    return hashlib.sha256("\n".join(sorted(parts)).encode()).hexdigest()


def names_of(code: CodeType) -> set[str]:
    """Return all names that code refers to."""
    return set(code.co_names).union(*(names_of(one) for one in code.co_consts if isinstance(one, CodeType)))


def code_text(code: CodeType) -> str:
    """Return what code does, without its lines."""
    inner = [code_text(one) if isinstance(one, CodeType) else repr(one) for one in code.co_consts]
    return repr((code.co_code, code.co_names, code.co_varnames, inner))
