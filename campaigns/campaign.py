"""Shared by all campaigns: the command line, runs that are kept, shares with their counting errors, and where results are written.

A campaign counts something that takes minutes to hours: how often error bars hold the truth, how often verdicts are right, how far
a gas drifts. ``python campaigns/NAME.py`` runs one, ``python campaigns`` (or ``make campaigns``) all. A complete run writes what
it printed into campaigns/results.md, with date, commit and time taken; the tests run each with ``--small``.
"""

from __future__ import annotations

import argparse
import io
import json
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, TextIO

import numpy as np
from rich.console import Console
from rich.progress import track

Row = dict[str, Any]
Mapping = Callable[..., Iterable[Row]]
SHARES = (0.6827, 0.95)
ROOT = Path(__file__).parents[1]
RESULTS = ROOT / "campaigns" / "results.md"
# (bits.py compares with a record that somebody made before a change; held_out_shots.py is a part of shots_real.py)
NAMES = sorted(
    path.stem
    for path in Path(__file__).parent.glob("[a-z]*.py")
    if path.stem not in ("campaign", "bits", "held_out_shots")
)

# Made-up data come from the tests' own helpers.
if str(ROOT / "tests") not in sys.path:
    sys.path.insert(0, str(ROOT / "tests"))


class Campaign:
    """The arguments of a campaign, and the lines that it has printed."""

    def __init__(self, given: argparse.Namespace, count: int) -> None:
        self.given = given
        self.count = count
        self.small: bool = given.small
        self.rows = Rows(given.rows)
        self.lines: list[str] = []
        self.ended = False
        """Whether it was ended before all was counted: what was counted is reported, and is no complete result."""

    def say(self, *cells: object) -> None:
        """Print a line of the result."""
        self.lines += " ".join(map(str, cells)).split("\n")
        print(*cells, flush=True)

    def go_through(
        self,
        wanted: Sequence[tuple[str, int]],
        one: Callable[[str, int], Row],
        *,
        again: Callable[[Row], bool] = lambda _row: False,
        many: Mapping = map,
    ) -> list[Row]:
        """Return the rows of runs by kind and seed; ``one`` computes those that are not known yet, or are wanted ``again``.

        ``many`` maps ``one`` over kinds and seeds, in order. Where it is ended by Ctrl-C or by SIGTERM, the rows that are known by
        then are returned, and with ``--rows`` another call computes the others.
        """
        with _terminated_as_interrupted():
            try:
                self.rows.go_through(wanted, one, again, many)
            except KeyboardInterrupt:
                self.ended = True
        found = [self.rows.known[key] for key in wanted if key in self.rows.known]
        if self.ended:
            self.say(f"ended after {len(found):,} of {len(wanted):,}")
        return found

    def wants(self, name: str, names: Iterable[str] = ()) -> bool:
        """Return whether ``--only`` means this kind: it names one of ``names``, or all that begin so; with --small the first."""
        only, names = self.given.only, list(names)
        if self.small and not only and names:
            return name == names[0]
        return name == only or (only not in names and name.startswith(only))


@contextmanager
def campaign(
    name: str, doc: str, words: Sequence[str] | None, *, count: int = 1, small: int = 1, **options: dict[str, Any]
) -> Iterator[Campaign]:
    """Read the command line; write what was said into campaigns/results.md at the end of a complete run.

    ``count`` is how many of whatever it counts a run has, ``small`` how many with ``--small``. ``options`` are further arguments of
    the command line, by name, as for :meth:`argparse.ArgumentParser.add_argument`.
    """
    parser = argparse.ArgumentParser(name, description=doc.split("\n", maxsplit=1)[0])
    parser.add_argument("count", nargs="?", type=int, help=f"how many (default: {count})")
    parser.add_argument("--only", default="", help="kinds whose names begin so")
    parser.add_argument(
        "--rows", type=Path, help="keep every run in this file, one line each; go on from what is there"
    )
    parser.add_argument("--small", action="store_true", help=f"a first look: {small} of the first kind")
    parser.add_argument("--results", type=Path, default=RESULTS, help="where a complete run is written")
    for option, settings in options.items():
        parser.add_argument(f"--{option.replace('_', '-')}", **settings)
    given = parser.parse_args(words)
    run = Campaign(given, given.count or (small if given.small else count))
    begin = time.monotonic()
    yield run
    if not given.small and not given.only and given.count is None and not run.ended:
        write_result(given.results, name, doc, run.lines, time.monotonic() - begin)


def film_campaign(
    name: str,
    doc: str,
    words: Sequence[str] | None,
    kinds: Iterable[str],
    report: Callable[[Campaign, str], None],
    count: int,
) -> None:
    """Run a campaign over filmed tables: ``report`` on each kind that is wanted, with ``--shots`` of a table."""
    shots = {"type": int, "help": "of a table (default: 20; with --small 5)"}
    with campaign(name, doc, words, count=count, small=1, shots=shots) as run:
        run.given.shots = run.given.shots or (5 if run.small else 20)
        for kind in kinds:
            if run.wants(kind, kinds):
                report(run, kind)


def write_result(path: Path, name: str, doc: str, lines: Sequence[str], seconds: float) -> None:
    """Put the result of a campaign into the page, in place of its last one; other sections stay, of whatever titles."""
    commit = subprocess.run(
        ["git", "-C", str(ROOT), "describe", "--always", "--dirty"], capture_output=True, text=True, check=False
    ).stdout.strip()
    title = doc.split("\n", maxsplit=1)[0]
    about = f"{datetime.now(UTC):%Y-%m-%d}, commit {commit or 'unknown'}, {seconds / 60:.0f} min: `python campaigns/{name}.py`"
    section = "\n".join((f"## {name}", "", title, "", about, "", "```text", *lines, "```", ""))
    head, *old = path.read_text(encoding="utf-8").split("\n## ")
    sections = [(one.split("\n", maxsplit=1)[0], f"## {one.rstrip()}\n") for one in old]
    last = next((k for k, (title, _text) in enumerate(sections) if title == name), len(sections))
    sections[last : last + 1] = [(name, section)]
    sections.sort(key=lambda one: one[0])
    path.write_text(head.rstrip() + "\n" + "".join(f"\n{text}" for _title, text in sections), encoding="utf-8")


class Rows:
    """Runs by kind and seed, in a file of one JSON line each where there is one; a run that was broken off goes on from there."""

    def __init__(self, path: Path | None) -> None:
        self.path = path
        self.known: dict[tuple[str, int], Row] = {}
        if path and path.exists():
            for line in path.read_text().splitlines():
                with suppress(json.JSONDecodeError):  # (of a line that was broken off)
                    row = json.loads(line)
                    self.known[row["kind"], row["seed"]] = row

    def fill(self, kind: str, seeds: Iterable[int], run: Callable[[int], Row]) -> list[Row]:
        """Return one row for each seed; ``run`` computes those that are not known yet."""
        wanted = [(kind, seed) for seed in seeds]
        self.go_through(wanted, lambda _kind, seed: run(seed))
        return [self.known[key] for key in wanted]

    def go_through(
        self,
        wanted: Sequence[tuple[str, int]],
        one: Callable[[str, int], Row],
        again: Callable[[Row], bool] = lambda _row: False,
        many: Mapping = map,
    ) -> None:
        """Compute rows by kind and seed that are not known yet, or are wanted ``again``, and keep each as soon as it is there."""
        missing = [key for key in wanted if key not in self.known or again(self.known[key])]
        if not missing:
            return
        found = many(one, *(list(column) for column in zip(*missing, strict=True)))
        with self._file() as file:
            keys = track(missing, missing[0][0], console=Console(stderr=True), transient=True)
            for (kind, seed), its in zip(keys, found, strict=True):
                row = self.known[kind, seed] = {"kind": kind, "seed": seed, **its}
                file.write(json.dumps(row) + "\n")
                file.flush()

    def _file(self) -> TextIO:
        """Return the file to write rows to, on a new line."""
        if self.path is None:
            return io.StringIO()
        file = self.path.open("a+")
        file.seek(max(file.tell() - 1, 0))
        if file.read(1) not in ("", "\n"):
            file.write("\n")
        return file


@contextmanager
def _terminated_as_interrupted() -> Iterator[None]:
    """Take SIGTERM as Ctrl-C: ``timeout`` and ``kill`` end a campaign with what it has counted."""
    before = signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


def left_to_the_parent() -> None:
    """Let a worker's parent decide what Ctrl-C and SIGTERM mean, which ``timeout`` sends to all: for the worker's process."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_IGN)


def counting_errors(count: int) -> tuple[float, float]:
    """Return the standard errors of shares of 68.3 and 95 % among so many, in percentage points."""
    one, two = (100 * float(np.sqrt(p * (1 - p) / max(count, 1))) for p in SHARES)
    return one, two


def held(pulls: Sequence[float | Sequence[bool]]) -> tuple[float, float]:
    """Return the shares (%) within 1 and 1.96 error bars: of (fitted - true) / error, or of intervals that held or did not."""
    each = [one if isinstance(one, (list, tuple)) else (abs(one) < 1, abs(one) < 1.96) for one in pulls]
    one, two = (100 * np.mean(each, axis=0)).tolist() if each else (np.nan, np.nan)
    return one, two


def deviations(truth: dict[str, float], values: dict[str, Any], errors: dict[str, Any]) -> dict[str, Any]:
    """Return each number's deviation from the truth in error bars, None without one, and its error bar."""
    found: dict[str, Any] = {}
    for name, true in truth.items():
        value, error = values.get(name), errors.get(name)
        found[name] = None if value is None or not error else (value - true) / error
        found[f"{name} bar"] = error
    return found


def say_shares(run: Any, kind: str, rows: Sequence[Row], names: Iterable[str]) -> None:
    """Print a line a number: how often its error bars hold the truth, and their median."""
    for name in names:
        bars = [row[f"{name} bar"] for row in rows if row[f"{name} bar"]]
        bar = f"; error bar {np.median(bars):.2g}" if bars else ""
        run.say(f"{kind:7} {name:24} {shares([row[name] for row in rows])}{bar}")


def shares(pulls: Sequence[float | Sequence[bool] | None]) -> str:
    """Format shares with their counting errors; an exclamation mark where one is off by more than two of them."""
    good = [one for one in pulls if one is not None]
    if not good:
        return f"without an error bar in any of {len(pulls)}"
    one, two = held(good)
    errors = counting_errors(len(good))
    mark = "!" if any(abs(s - 100 * p) > 2 * e for s, p, e in zip((one, two), SHARES, errors, strict=True)) else " "
    said = (
        f"{one:5.1f} / {two:4.1f} {mark} (68.3 ± {errors[0]:.1f}, 95.0 ± {errors[1]:.1f}; {len(good)} of {len(pulls)})"
    )
    z = np.array([pull for pull in good if isinstance(pull, float)])
    return said + (f"; mean {z.mean():+.2f}, scatter {z.std():.2f} error bars" if len(z) else "")
