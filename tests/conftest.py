"""Settings for all tests: where compiled loops are kept, and how Hypothesis searches."""

import collections
import contextlib
import functools
import gc
import importlib
import os
import sys
import time
from collections.abc import Generator, Iterator
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings
from reference.exploring import EXPLORE
from reference.forking import Forked, forking

# Compiled loops stay between runs, in the folder that pytest keeps anyway; carom itself adds the hash of its sources,
# so that a changed kernel is never answered by an old loop. Set before carom is imported by any test.
os.environ.setdefault("CAROM_CACHE", str(Path(__file__).parents[1] / ".pytest_cache" / "carom"))

# Threads of parallel loops sleep while they wait. They would spin, which takes the cores from the other workers' tests:
# four times the CPU time where the machine is busy. Set before any library starts its threads.
os.environ.setdefault("OMP_WAIT_POLICY", "passive")

# No deadline: the first call of a test may compile. The same examples every time, so that the same sources give the same
# verdict; CAROM_EXPLORE=1 (``make explore``) looks for new ones, and is worth an hour before a release. It also makes the tests
# that count draw all their cases (reference.exploring): the suite draws enough to see a fault.
settings.register_profile(
    "carom",
    deadline=None,
    derandomize=not EXPLORE,
    suppress_health_check=[HealthCheck.too_slow],
    print_blob=True,
)
settings.load_profile("carom")


@pytest.fixture(autouse=True)
def no_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    """No test depends on the caller's terminal (nor on the width that a driver of a browser writes into the environment)."""
    for name in ("COLUMNS", "LINES", "FORCE_COLOR", "TTY_COMPATIBLE", "TTY_INTERACTIVE"):
        monkeypatch.delenv(name, raising=False)


@pytest.fixture(autouse=True, scope="session")
def one_command() -> None:
    """Have Typer's runner make the command once, as carom itself does, and not at each of a hundred calls."""
    if (testing := sys.modules.get("typer.testing")) is not None:
        testing._get_command = functools.cache(testing._get_command)


@pytest.fixture(scope="session")
def forked() -> Iterator[Forked]:
    """Carom, and Python with carom, in processes of their own: forked from one that has imported what most verbs import.

    It has also imported the libraries of files: a process that cannot write large files (test_full_disk) would compile them anew.
    It has imported neither SciPy nor Matplotlib, which some processes must find missing.
    """
    with forking(
        "carom.laws.comparison", "pydantic.main", "pydantic.types", "carom.scene.openings", "rich.table",
        "carom.simulation.simulate", "carom.gas.session", "xarray", "pyarrow.parquet", "gsd.hoomd",
    ) as run:  # fmt: skip
        yield run


def _all_tests(config: pytest.Config) -> bool:
    return config.args_source is pytest.Config.ArgsSource.TESTPATHS


def pytest_xdist_auto_num_workers(config: pytest.Config) -> int | None:
    """All cores for the whole suite (xdist's own count); one process for chosen files, unless ``-n`` says otherwise."""
    return None if _all_tests(config) else 0


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave tests that take long out of the whole suite, but so many of their cases as they say; with ``-m`` all are there."""
    if EXPLORE or config.option.markexpr or not _all_tests(config):
        return
    met: collections.Counter[str] = collections.Counter()
    left = []
    for item in items:
        if (mark := item.get_closest_marker("slow")) is not None:
            case = item.nodeid.partition("[")[0]
            met[case] += 1
            left += [item] if met[case] > mark.kwargs.get("keep", 0) else []
    config.hook.pytest_deselected(items=left)
    gone = set(left)
    items[:] = [item for item in items if item not in gone]


@pytest.hookimpl(wrapper=True, trylast=True)
def pytest_collection(session: pytest.Session) -> Generator[None, object, object]:
    """Collect the tests, and leave what lives then out of the walks of Python's garbage collector.

    It walks through all objects: modules of large libraries and thousands of tests, which live to the end.
    """
    gc.disable()
    _import_share(session.config)
    collected = yield
    gc.collect()
    gc.freeze()
    gc.enable()
    return collected


def _import_share(config: pytest.Config) -> None:
    """Where several workers run the whole suite: import a part of the test files, whose bytecode the other workers then find.

    pytest rewrites the asserts of each file, 14 s of a core for all; every worker needs them all.
    """
    asked = getattr(config, "workerinput", None)
    if asked is None or sys.dont_write_bytecode or not _all_tests(config):
        return
    files = sorted(Path(__file__).parent.rglob("test_*.py"))
    for file in files[int(asked["workerid"].removeprefix("gw")) :: asked["workercount"]]:
        if str(file.parent) not in sys.path:
            sys.path.insert(0, str(file.parent))
        # (what a file says in its import is said again where it is collected: that it is skipped, or its error)
        with contextlib.suppress(BaseException):
            importlib.import_module(file.stem)


def pytest_sessionstart(session: pytest.Session) -> None:
    """Before the whole suite runs: compile all loops, in several processes, so that no two tests compile the same one."""
    config = session.config
    if hasattr(config, "workerinput") or not _all_tests(config):
        return
    from carom.cli.doctor import COMPILE_JOBS
    from carom.core.jit.threads import run_in_workers

    begin = time.monotonic()

    def report(job: str, error: str) -> None:
        done = f"compiled {job}: {time.monotonic() - begin:.0f} s"
        terminal.write_line(f"NOT compiled: {job}: {error}" if error else done)

    terminal = config.pluginmanager.get_plugin("terminalreporter")
    run_in_workers(COMPILE_JOBS, report=report)
