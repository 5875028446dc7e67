"""Every row of the table of benchmarks: carom's time over a peer's, in one run, with the spread over five repeats.

    make benchmarks                                             # all scripts of this folder; build/benchmarks.json
    python benchmarks/rows.py arrays orbits --page docs/benchmarks.md
    python benchmarks/rows.py --cpu first                       # on a machine that does other work: s of processor

A script measures a row with :func:`compare` or :func:`alone` and hands it to :func:`report`, which prints it. Run by this file, the
scripts' rows are also gathered: into one table, a JSON file, and with ``--page`` the page of the documentation. A script that
reports no row is run as well, and prints what it measures. A peer that is not installed leaves its row out. ``--small`` runs each
script as small as it goes, as the tests do.
"""

from __future__ import annotations

import argparse
import datetime
import json
import math
import os
import platform
import subprocess
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from importlib import metadata
from pathlib import Path

HERE = Path(__file__).parent
SMALL = bool(os.environ.get("CAROM_BENCHMARK_SMALL"))  # everything once, and little of it
CPU = bool(os.environ.get("CAROM_BENCHMARK_CPU"))  # times are of the processor (of all threads together)
REPEATS = 1 if SMALL else 5
ROWS_FILE = "CAROM_BENCHMARK_ROWS"  # where a script appends its rows, one JSON object a line
CARRIED = ("numpy", "numba", "llvmlite", "pyarrow")


@dataclass(frozen=True)
class Row:
    """One row: a work, what it took, and against whom."""

    work: str
    nanoseconds: float
    """Of one unit, the shortest of the repeats."""
    unit: str
    peer: str = ""
    """Name and version; empty if the work has no peer."""
    ratio: float = math.nan
    """carom's shortest time over the peer's."""
    low: float = math.nan
    """The least of the five repeats' ratios (without a peer: of their times over the shortest)."""
    high: float = math.nan
    wanted: float = math.nan
    """The largest ratio, or time in ns if there is no peer, that this project wants."""
    memory: bool = False
    """Whether it is no time but bytes."""


def usually(usual: int, small: int) -> int:
    """Return how much of something is measured: ``small`` where it only has to run."""
    return small if SMALL else usual


def clock() -> float:
    """Return the time in s, or the processor's."""
    return time.process_time() if CPU else time.perf_counter()


def seconds(work: Callable[[], object]) -> float:
    """Return the seconds that a call takes."""
    begin = clock()
    work()
    return clock() - begin


def process(words: Sequence[str], environment: Mapping[str, str]) -> tuple[float, float]:
    """Return the seconds that a process takes, and the most memory that it has had, bytes; CalledProcessError if it fails."""
    begin = time.perf_counter()
    with subprocess.Popen(words, env=environment, stdout=subprocess.DEVNULL) as made:
        _pid, status, used = os.wait4(made.pid, 0)
        made.returncode = os.waitstatus_to_exitcode(status)
    took = time.perf_counter() - begin
    if made.returncode:
        raise subprocess.CalledProcessError(made.returncode, words)
    return used.ru_utime + used.ru_stime if CPU else took, used.ru_maxrss * (1 if sys.platform == "darwin" else 1024)


def run_script(main: Callable[[], object]) -> None:
    """Run a script's ``main``; where a library that it needs is not installed, say so in one line."""
    try:
        main()
    except ImportError as missing:
        print(f"not measured: {missing}")


def compare(
    work: str,
    ours: Callable[[], object],
    theirs: Callable[[], object],
    peer: str,
    *,
    count: float = 1,
    unit: str = "ball",
    calls: int = 1,
    wanted: float = math.nan,
    timed: Callable[[Callable[[], object]], float] = seconds,
) -> Row:
    """Measure both in turn, five times, the shortest of ``calls`` calls each; ``count`` units a call."""
    timed(ours), timed(theirs)
    calls = usually(calls, 1)
    pairs = [(min(timed(ours) for _ in range(calls)), min(timed(theirs) for _ in range(calls))) for _ in range(REPEATS)]
    return paired(work, pairs, peer, count=count, unit=unit, wanted=wanted)


def paired(
    work: str, pairs: list[tuple[float, float]], peer: str, *, count: float, unit: str, wanted: float = math.nan
) -> Row:
    """Return the row of pairs of times in s, carom's and the peer's, one pair a repeat."""
    ratios = [a / b for a, b in pairs]
    ours, theirs = (min(times) for times in zip(*pairs, strict=True))
    return Row(work, ours / count * 1e9, unit, peer, ours / theirs, min(ratios), max(ratios), wanted)


def alone(
    work: str,
    ours: Callable[[], object],
    *,
    count: float = 1,
    unit: str = "call",
    calls: int = 1,
    wanted: float = math.nan,
) -> Row:
    """Measure a work that has no peer, five times, the shortest of ``calls`` calls each."""
    seconds(ours)
    times = [min(seconds(ours) for _ in range(usually(calls, 1))) for _ in range(REPEATS)]
    return repeated(work, [one / count for one in times], unit=unit, wanted=wanted)


def repeated(work: str, times: Sequence[float], *, unit: str = "call", wanted: float = math.nan) -> Row:
    """Return the row of repeated times of one unit, s; ``wanted`` in ns."""
    least = min(times)
    return Row(work, least * 1e9, unit, low=1.0, high=max(times) / least, wanted=wanted)


def report(row: Row) -> Row:
    """Print a row, and hand it to the run that gathers rows; return it."""
    print("  " + "  ".join(cells(row)))
    gathered = os.environ.get(ROWS_FILE)
    if gathered:
        with Path(gathered).open("a") as file:
            file.write(json.dumps(asdict(row)) + "\n")
    return row


def cells(row: Row) -> list[str]:
    """Return a row as text: work, time, peer, ratio with its spread, what is wanted."""
    amount = _memory if row.memory else _time
    took = f"{amount(row.nanoseconds)} a {row.unit}"
    if not row.peer:
        wanted = "" if math.isnan(row.wanted) else amount(row.wanted)
        return [row.work, took, "", "", wanted]
    wanted = "" if math.isnan(row.wanted) else _ratio(row.wanted)
    return [row.work, took, row.peer, f"{_ratio(row.ratio)} ({_ratio(row.low)} to {_ratio(row.high)})", wanted]


def _time(ns: float) -> str:
    for size, unit in ((1e9, "s"), (1e6, "ms"), (1e3, "µs")):
        if ns >= size:
            return f"{ns / size:.3g} {unit}"
    return f"{ns:.3g} ns"


def _memory(count: float) -> str:
    return f"{count / 1e6:.0f} MB"


def _ratio(x: float) -> str:
    return f"1/{1 / x:.0f}" if x < 1 / 9.5 else f"{x:.2f}"


# --- all scripts ---------------------------------------------------------------------------------------------------


def gather(scripts: list[str], more: Mapping[str, str]) -> tuple[list[Row], list[str]]:
    """Run scripts with these variables; return their rows, and the names of the scripts that failed."""
    build = HERE.parent / "build"
    build.mkdir(exist_ok=True)
    collected = build / "benchmark_rows.jsonl"
    collected.unlink(missing_ok=True)
    failed = []
    for name in scripts:
        print(f"== {name}", flush=True)
        done = subprocess.run(
            [sys.executable, HERE / f"{name}.py"], env={**os.environ, **more, ROWS_FILE: str(collected)}, check=False
        )
        failed += [name] if done.returncode else []
    lines = collected.read_text().splitlines() if collected.exists() else []
    return [Row(**json.loads(line)) for line in lines], failed


def machine() -> str:
    """Return the processor and how many cores there are."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text().splitlines() if info.exists() else []
    model = next(
        (line.partition(":")[2].strip() for line in lines if line.startswith("model name")), platform.machine()
    )
    return f"{model}, {os.cpu_count()} cores, {platform.system()}"


def versions() -> str:
    """Return Python's version and those of the libraries that carom stands on."""
    import carom

    found = [f"Python {platform.python_version()}, carom {carom.__version__}"]
    for name in CARRIED:
        try:
            found.append(f"{name} {metadata.version(name)}")
        except metadata.PackageNotFoundError:
            continue
    return ", ".join(found)


HEAD = ["work", "carom takes", "peer", "carom's time over the peer's (spread)", "wanted"]


HOW = """\
Both sides of a row are timed in turn, five times in one run; the ratio is that of the shortest times, and in brackets
are the least and the largest of a repeat. Below 1 carom is faster; 1/70 is seventy times faster."""
OF_PROCESSOR = (
    "Times are of the processor, of all threads and processes of a work together: other work shared the machine."
)
PEERS = """\
Peers: `np.copy` copies half as many bytes as a result reads and writes, into new memory; `np.copyto` those of a final
state, into arrays that exist, on one thread where carom has two; C is a loop written by hand for one table
(`benchmarks/orbits.py`), which follows the same orbit. Of 100,000 spheres two take
0.9 µs more from the third-level cache (six lines of 150 ns); a collision takes 0.7 to 1.0 µs more. Gases with peers are on
[their page](theory/gas.md); what was tried and left, in [Architecture](design.md#tried)."""


def commit() -> str:
    """Return the commit that is measured, short; "an unknown commit" outside a clone."""
    words = ["git", "-C", str(HERE), "describe", "--always", "--dirty", "--exclude", "*"]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    return done.stdout.strip() or "an unknown commit"


def page(rows: list[Row], when: str, cpu: bool) -> str:
    """Return the page of the documentation."""
    columns = len(HEAD) - 1  # (what is wanted is printed, and not on the page)
    lines = [HEAD, ["---"] * columns, *map(cells, rows)]
    table = ["| " + " | ".join(row[:columns]) + " |" for row in lines]
    parts = [
        "# Benchmarks",
        "<!-- made by: python benchmarks/rows.py SCRIPTS --page docs/benchmarks.md -->",
        f"{when}, commit {commit()}, {machine()}; {versions()}.",
        HOW,
        *([OF_PROCESSOR] if cpu else []),
        "\n".join(table),
        PEERS,
    ]
    return "\n\n".join(parts) + "\n"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    known = sorted(path.stem for path in HERE.glob("*.py") if path.stem not in ("rows", "peers", "gas_dynamo"))
    parser.add_argument("scripts", nargs="*", metavar="script", help=f"default: all of {', '.join(known)}")
    parser.add_argument("--json", type=Path, default=HERE.parent / "build" / "benchmarks.json")
    parser.add_argument("--page", type=Path, help="write the page of the documentation")
    parser.add_argument(
        "--cpu", action="store_true", help="times of the processor, where other work shares the machine"
    )
    parser.add_argument("--small", action="store_true", help="see that all scripts run")
    given = parser.parse_args()
    more = {"CAROM_BENCHMARK_CPU": "1"} if given.cpu else {}
    more |= {"CAROM_BENCHMARK_SMALL": "1"} if given.small else {}
    unknown = sorted(set(given.scripts) - set(known))
    if unknown:
        parser.error(f"expected scripts out of {', '.join(known)}, got {', '.join(unknown)}")
    rows, failed = gather(given.scripts or known, more)
    when = datetime.datetime.now(datetime.UTC).date().isoformat()
    figures = {"date": when, "commit": commit(), "machine": machine(), "versions": versions()}
    figures |= {"rows": [asdict(row) for row in rows]}
    given.json.write_text(json.dumps(figures, indent=1) + "\n")
    table = [HEAD, *map(cells, rows)]
    widths = [max(map(len, column)) for column in zip(*table, strict=True)]
    for row in table:
        print("  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip())
    if given.page:
        given.page.write_text(page(rows, when, given.cpu))
    if failed:
        print(f"failed: {', '.join(failed)}", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
