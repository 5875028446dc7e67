"""Ctrl-C ends every compiled loop: each is run in slices, between which Python hears of it.

Every job here would take minutes or hours. It runs in another process, which says when it has begun, gets SIGINT, and must
leave the job by KeyboardInterrupt long before the job would end.
"""

from __future__ import annotations

import json
import multiprocessing
import os
import signal
import subprocess
import sys
import threading
import time
import warnings
from collections.abc import Iterator

import pytest
from reference.commands import command

from carom.core.jit.threads import GROWTH, Pace, call_in_parts, call_in_threads, row_slices, sliced

PATIENCE = 60  # s: a job that goes on is killed then

# (a shell that runs the tests in the background has told them to ignore SIGINT, and they pass that on)
BEGIN = """
import signal
signal.signal(signal.SIGINT, signal.default_int_handler)
import numpy as np
import carom
from carom import billiards
def begin():
    print("begun", flush=True)
"""
BOX = """
wall = {"shape": "box", "corner": (0, 0, 0), "size": (9, 9, 9), "inside": True}
balls = [{"radius": 0.1, "mass": 1, "position": (1 + i % 5, 1 + i // 5, 1), "velocity": (1, 0.3 * i, 0.7)} for i in range(30)]
def scene(**run):
    return carom.Scene(gravity=0, walls=[wall], balls=balls[:run.pop("count", 30)], run={"law": "mirror"} | run)
"""
JOBS = {
    "simulate": BOX + """
carom.simulate(scene(max_events=20_000))
begin()
carom.simulate(scene(count=1, max_events=10**12), progress=lambda *_: None)
""",
    "simulate_many": BOX + """
carom.simulate_many(scene(count=1, duration=10), velocity=[[1, 2, 3]])
begin()
carom.simulate_many(scene(count=1, duration=1e12), velocity=[[1, 2, 3], [1, 2, 4]])
""",
    "gas": """
from carom.gas import Gas, Species
gas = Gas([Species(carom.Ball(0.5, 1.0), 2)], (1e6, 1e6, 1e6), contacts=carom.Surface(1, 0, -1))
gas.run(until=1.0)
begin()
gas.run(until=1e18)  # hardly ever a collision, only borders of cells
""",
    "orbit": """
billiards.final(billiards.stadium(), ((0.1, 0.2), (0.7, 0.4), 0.3), 10)
begin()
billiards.final(billiards.stadium(), ((0.1, 0.2), (0.7, 0.4), 0.3), 10**12)
""",
    "lyapunov": """
billiards.lyapunov(billiards.stadium(), ((0.1, 0.2), (0.7, 0.4), 0.3), 10, blocks=2)
begin()
billiards.lyapunov(billiards.stadium(), ((0.1, 0.2), (0.7, 0.4), 0.3), 10**12, blocks=2)
""",
    "fit": """
from carom.fitting import Setting, fit_laws
from carom.data import published_rebounds
rows = published_rebounds("kharaz2001").rebounds
setting = Setting(radius=0.0025)
fit_laws(rows, setting, ["sliding"], bootstrap=5)
begin()
fit_laws(rows, setting, ["sliding"], bootstrap=10**7)
""",
    # (the last, as it loads Numba, and loops of one part run in another thread from then on)
    "rows": """
from carom.core.jit.kernel import kernel
@kernel
def slow(v, w, n, a, kappa, e, mu, beta):
    x = v[0]
    for k in range(200_000):
        x += x * 1e-9
    return (x, v[1], v[2]), w
law = carom.wall_law(carom.Card("slow", "", (), "", "", ""), slow)
def answer(count):
    v = np.tile([-1.0, 0.0, 0.0], (count, 1))
    return law.answer(carom.Meeting(carom.Ball(), carom.State(v, 0 * v), wall=carom.Surface(1, 0)))
answer(500)
begin()
answer(3_000_000)
""",
}  # fmt: skip
SERVER = f"""{BEGIN}
import json, sys
for line in sys.stdin:
    try:
        exec(json.loads(line), globals())
    except KeyboardInterrupt:
        print("interrupted", flush=True)
    else:
        print("finished", flush=True)
"""


@pytest.fixture(scope="module")
def workers() -> Iterator[list[subprocess.Popen[str]]]:
    """The process that does one job after the other, once the first is asked for; another where a job has not ended."""
    running: list[subprocess.Popen[str]] = []
    yield running
    for process in running:
        process.kill()
        process.communicate()


@pytest.mark.skipif(os.name != "posix", reason="needs signals")
@pytest.mark.parametrize("job", JOBS)
def test_an_interrupt_ends_it(job: str, workers: list[subprocess.Popen[str]]) -> None:
    if not workers:
        workers.append(
            subprocess.Popen([sys.executable, "-c", SERVER], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        )
    process = workers.pop()
    assert process.stdin is not None
    assert process.stdout is not None
    late = threading.Timer(PATIENCE, process.kill)
    try:
        print(json.dumps(JOBS[job]), file=process.stdin, flush=True)
        assert process.stdout.readline() == "begun\n"
        time.sleep(0.1)
        process.send_signal(signal.SIGINT)
        late.start()
        assert process.stdout.readline() == "interrupted\n"
    except BaseException:
        process.kill()
        raise
    finally:
        late.cancel()
    workers.append(process)


def test_an_interrupted_loop_ends_when_all_its_threads_have(monkeypatch: pytest.MonkeyPatch) -> None:
    """Else a thread writes to arrays that are free, and Python ends by a segmentation fault some time later."""
    monkeypatch.setattr("carom.core.jit.threads._most_threads", lambda: 2)
    begun, ended = threading.Event(), threading.Event()

    def work(part: int) -> None:
        if part == 0:
            assert begun.wait(PATIENCE)
            raise KeyboardInterrupt
        begun.set()
        time.sleep(0.2)
        ended.set()

    with pytest.raises(KeyboardInterrupt):
        call_in_parts(work, 2)
    assert ended.is_set()


def test_the_command_ends_without_a_traceback(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def interrupted(*_words: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("carom.laws.registry.card_named", interrupted)
    code, out, err = command(capsys, "laws", "maw")
    assert (code, out) == (130, "")
    assert err in ("", "carom: interrupted\n")  # (some versions of Typer end by themselves)


def test_slices_cover_all_rows_and_grow(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = [0.0]
    monkeypatch.setattr(time, "perf_counter", lambda: clock[0])
    lengths = []
    rows = []
    for part in row_slices(1000, 4):
        rows += range(part.start, part.stop)
        lengths.append(part.stop - part.start)
        clock[0] += 0.01 * lengths[-1]  # a hundred rows a second: twenty in a fifth
    assert rows == list(range(1000))
    assert lengths[:3] == [4, 20, 20]
    assert list(row_slices(0)) == []
    pace = Pace(10)
    pace.begin()
    pace.done(10)  # in no time
    assert pace.amount == 10 * GROWTH


def test_what_is_sliced() -> None:
    import numpy as np

    seen: list[tuple[int, ...]] = []
    rows, flat, same = np.zeros((9000, 3)), np.zeros(27000), np.zeros((1, 3))
    loop = sliced(lambda *parts: seen.append(tuple(len(x) if isinstance(x, np.ndarray) else x for x in parts)), 9000)
    loop(rows, flat, same, 7)
    assert [part[2:] for part in seen] == [(1, 7)] * len(seen)
    assert sum(part[0] for part in seen) == 9000
    assert all(part[1] == 3 * part[0] for part in seen)
    assert seen[0][0] == 4096


@pytest.mark.parametrize("loaded", [False, True])
def test_a_single_part_leaves_the_main_thread_once_numba_is_loaded(
    loaded: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """There an interrupt would come while Numba looks up the types of a loop's arguments, and be lost."""
    if loaded:
        monkeypatch.setitem(sys.modules, "numba", sys)
    else:
        monkeypatch.delitem(sys.modules, "numba", raising=False)
    main = threading.main_thread()
    found = call_in_threads(lambda part: (part, threading.current_thread() is main), [7])
    assert found == [(7, not loaded)]


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
@pytest.mark.slow
def test_the_threads_are_made_anew_in_a_forked_process() -> None:
    call_in_threads(abs, [-1, -2])
    fork = multiprocessing.get_context("fork")
    child = fork.Process(target=call_in_threads, args=(abs, [-1]))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # (newer Pythons warn of a fork beside threads)
        child.start()
    child.join(PATIENCE)
    alive = child.is_alive()
    child.kill()
    assert not alive
    assert child.exitcode == 0
