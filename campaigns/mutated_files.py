"""Mutated files, to every command that reads files: an answer or one clear refusal, never a traceback, a hang or a warning.

    python campaigns/mutated_files.py [N] [--only COMMAND] [--first 0] [--limit 20] [--keep FOLDER] [--rows FILE]

N files (100,000) from the seed ``first`` on: tracks of all formats, tables of rebounds and states, scenes, gases and their
checkpoints, with bytes flipped, cut, moved and repeated, lines inserted, encodings swapped, cells of 200,000 characters, and
numbers such as 1e-320, 1e308, nan and inf; brackets nested 100,000 deep, devices and pipes. Each goes to one command, in a process
that is ended after ``limit`` seconds of CPU.
A gas is asked to end (SIGTERM) at half of that, and has to.
A fault is anything but success, or exit code 2 with clean lines on standard error and nothing on standard output; --keep saves such
files. The commands take turns, so that a run that is ended has files of each. Ends with 1 if there is a fault.
"""

from __future__ import annotations

import contextlib
import hashlib
import io
import json
import multiprocessing
import os
import pickle
import re
import signal
import sys
import tempfile
import threading
import traceback
import warnings
from collections import Counter, OrderedDict
from collections.abc import Callable, Iterator, Sequence
from functools import cache
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

import numpy as np
from campaign import ROOT, Row, campaign, left_to_the_parent

FILES = ROOT / "tests" / "tracks" / "files"
# Each command with the kinds of files that it reads; FILE stands for the file.
FILM = ("--scale", "0.5mm", "--rate", "120")
COMMANDS: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "tracks show": (("tracks", "show", "FILE", "--radius", "0", "--scale", "1mm"), ("track",)),
    "tracks show as JSON": (("tracks", "show", "FILE", "--json", "--radius", "0", *FILM), ("track",)),
    "tracks show from above": (("tracks", "show", "FILE", "--view", "above", "--radius", "20mm", "--scale", "1mm"), ("track",)),
    "fit of rebounds": (("fit", "FILE", "--radius", "0.02", "--laws", "contact"), ("rebounds",)),
    "fit of tracks": (("fit", "FILE", "--radius", "0.02", "--laws", "contact", "--rate", "60"), ("film",)),
    "fit of whole tracks": (("fit", "FILE", "--whole", "--radius", "0.02", "--laws", "two-step"), ("shot",)),
    "design": (("design", "FILE", "--radius", "0.02"), ("rebounds",)),
    "predict": (("predict", "FILE"), ("states", "rebounds")),
    "scene check": (("scene", "check", "FILE"), ("scene", "gas")),
    "simulate": (("simulate", "FILE", "--max-events", "40", "--duration", "2", "--json"), ("scene",)),
    "gas": (("gas", "FILE", "--max-events", "10", "--quiet"), ("gas",)),  # (a run of few events has hundreds of samples)
    "sweep": (("sweep", "explain", "FILE"), ("sweep",)),
    "figure": (("orbit", "--table", "FILE", "--bounces", "20"), ("figure",)),
    "judge": (("judge", "FILE", "--radius", "0.03"), ("film",)),
    "gas from a checkpoint": (("gas", "--resume", "FILE", "--quiet"), ("checkpoint",)),
}  # fmt: skip
ENDINGS = {"checkpoint": "npz", "scene": "toml", "gas": "toml", "sweep": "toml", "figure": "json"}  # (else csv)
# What stands for a file: devices without an end, and a pipe that nobody writes to.
NO_FILES = (b"link to /dev/zero", b"link to /dev/urandom", b"link to /dev/tty", b"pipe")
SLOW = {"fit of rebounds": 0.2, "fit of tracks": 0.1, "fit of whole tracks": 0.005, "design": 0.05, "gas": 0.5}
"""How many of these there are beside one of each other command. A first look leaves out what takes longest."""
NUMBERS = (
    "1e-320", "1e308", "-1e308", "nan", "inf", "-inf", "0", "-0.0", "1e-9", "1e15", "99999999999999999999999", "-1", "1,5", "0x1F",
    "1_000", "", "true", "[]", "{}", '"1 m"', "1e", "٣",
)  # fmt: skip
TEXTS = (
    "\x1b[31mred",
    "A" * 200_000,
    '"',
    '""',
    "\0",
    "[" * 100_000,
    '{"a":' * 3000,
    "\r",
    "\n\n\n",
    "#",
    ";",
    "\t\t",
    "é",
    "\ufeff",
    "\u2028",
    "'",
    "\\",
    "%s{0}",
)
ENCODINGS = ("utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "utf-32", "latin-1", "cp437")


COMPILING_S = 600.0
ENOUGH = 500  # files of a command, of which some are intact where it matters
STOPPED = "stopped without a checkpoint"  # (with one it has answered)
PATIENCE = 5.0  # times the limit: compiled code is not ended by it
KEPT_FILMS = 300


class _LateError(BaseException):
    """A command that took too long."""


# --- files ---------------------------------------------------------------------------------------------------------------


@cache
def bases() -> dict[str, list[bytes]]:
    """Intact files by kind."""
    from carom.data.published import published_rebounds
    from carom.gas.scene import gas_text
    from carom.scene.toml import scene_text
    from carom.sweeps import new_sweep

    scenes = [path.read_bytes() for path in sorted((ROOT / "docs" / "scenes").glob("*.toml"))]
    tables = []
    for name in ("kharaz2001", "mathavan2009"):
        with tempfile.TemporaryDirectory() as folder:
            tables.append(published_rebounds(name).rebounds.save(Path(folder) / "table.csv").read_bytes())
    return {
        "track": [path.read_bytes() for path in sorted(FILES.iterdir())] + [_film_above(), _film_aside()] * 3,
        "film": [_film_above(), _film_aside()],
        "shot": [_film_above(1)],
        "rebounds": tables,
        "states": [
            b"velocity_x [m/s],velocity_y,spin_z,radius_mm\n-1,1,0,26.25\n-2,0.5,10,26.25\n",
            b"speed,incidence_deg,restitution\n1,45,0.9\n2,30,\n",
        ],
        "scene": [scene_text().encode()] + [text for text in scenes if b"[[balls]]" in text],
        "gas": [gas_text().encode()] + [text for text in scenes if b"[[species]]" in text],
        "checkpoint": [_checkpoint()],
        "sweep": [new_sweep().encode()],
        "figure": [b"[[0, 0], [2, 0], [2, 1], [0, 1]]", b'{"shape": "curve", "r": "1 + 0.1*cos(3*theta)"}'],
    }


def _film_above(shots: int = 6) -> bytes:
    """Balls that roll into a cushion and slide away from it, seen from above at 60 frames per second; mm."""
    t, rng, rows = np.arange(40) / 60, np.random.default_rng(1), ""
    for shot in range(shots):
        speed, along = rng.uniform(700, 1700), rng.uniform(-900, 900)
        since = np.maximum(t - 0.3, 0)
        slide = np.minimum(since, 0.12)
        x = np.where(t < 0.3, speed * (0.3 - t), 0.85 * speed * since - 1800 * slide * (since - slide / 2)) + 30
        noise = rng.normal(0, 0.3, (2, len(t)))
        rows += _rows(np.full(len(t), shot), t, x + noise[0], 400 + along * t + noise[1])
    return f"shot,t [s],x [mm],y [mm]\n{rows}".encode()


def _film_aside() -> bytes:
    """A ball that bounces four times, seen from the side at 120 frames per second, as Tracker writes it."""
    t, y, begin, up = np.arange(120) / 120, np.zeros(120), -0.1, 1.7
    for _ in range(6):
        since = t - begin
        y = np.where((since >= 0) & (since < 2 * up / 9.81), up * since - 9.81 / 2 * since**2, y)
        begin, up = begin + 2 * up / 9.81, 0.8 * up
    noise = np.random.default_rng(2).normal(0, 3e-4, (2, len(t)))
    return ("mass A\nt\tx\ty\n" + _rows(t, 0.6 * t + noise[0], y + noise[1]).replace(",", "\t")).encode()


def _rows(*columns: np.ndarray) -> str:
    return "".join(",".join(f"{x:.5f}" for x in row) + "\n" for row in zip(*columns, strict=True))


SMALL_GAS = """
[container]
shape = "periodic"
size = [8.0, 8.0, 8.0]
[[species]]
name = "a"
count = 8
radius = 0.5
mass = 1.0
temperature = 1.0
[[contacts]]
between = ["a", "a"]
restitution = 0.9
friction = 0.1
[run]
max_events = 20
"""


def _checkpoint() -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        scene, file = Path(folder) / "gas.toml", Path(folder) / "gas.npz"
        scene.write_text(SMALL_GAS)
        found = outcome(["gas", str(scene), "--quiet", "--checkpoint", str(file)], 600.0)
        if found != "answered":
            raise SystemExit(f"a small gas: expected a checkpoint, got: {found}")
        return file.read_bytes()


def mutated(raw: bytes, rng: np.random.Generator) -> bytes:
    """A file with one change, or with some more; one in fifty stays as it is."""
    if rng.random() < 0.02:
        return raw if rng.random() < 0.8 else NO_FILES[rng.integers(len(NO_FILES))]
    if raw.startswith(b"PK") and rng.random() < 0.7:
        return _array(raw, rng)
    for _ in range(rng.geometric(0.6)):
        change = CHANGES[rng.integers(len(CHANGES))]
        raw = change(raw, rng)
        if len(raw) > 2_000_000:
            break
    return raw


def _span(raw: bytes, rng: np.random.Generator) -> tuple[int, int]:
    low = int(rng.integers(len(raw) + 1))
    return low, min(low + int(rng.exponential(20)) + 1, len(raw))


def _flip(raw: bytes, rng: np.random.Generator) -> bytes:
    found = bytearray(raw)
    for at in rng.integers(max(len(raw), 1), size=rng.integers(1, 6)).tolist() if raw else []:
        found[at] ^= 1 << int(rng.integers(8))
    return bytes(found)


def _cut(raw: bytes, rng: np.random.Generator) -> bytes:
    return raw[: int(rng.integers(len(raw) + 1))]


def _leave_out(raw: bytes, rng: np.random.Generator) -> bytes:
    low, high = _span(raw, rng)
    return raw[:low] + raw[high:]


def _repeat(raw: bytes, rng: np.random.Generator) -> bytes:
    low, high = _span(raw, rng)
    return raw[:high] + raw[low:high] * int(rng.integers(1, 4)) + raw[high:]


def _insert(raw: bytes, rng: np.random.Generator) -> bytes:
    at = int(rng.integers(len(raw) + 1))
    return raw[:at] + TEXTS[rng.integers(len(TEXTS))].encode() + raw[at:]


def _lines(raw: bytes, rng: np.random.Generator) -> bytes:
    """Lines in another order, left out, repeated or inserted."""
    lines = raw.split(b"\n")
    i, j = rng.integers(len(lines), size=2).tolist()
    how = rng.integers(4)
    if how == 0:
        lines[i], lines[j] = lines[j], lines[i]
    elif how == 1:
        del lines[i]
    else:
        lines.insert(i, lines[j] if how == 2 else TEXTS[rng.integers(len(TEXTS))].encode())
    return b"\n".join(lines)


def _number(raw: bytes, rng: np.random.Generator) -> bytes:
    """Another number in the place of one."""
    found = list(re.finditer(rb"[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?", raw))
    if not found:
        return raw
    at = found[rng.integers(len(found))]
    return raw[: at.start()] + NUMBERS[rng.integers(len(NUMBERS))].encode() + raw[at.end() :]


def _column(raw: bytes, rng: np.random.Generator) -> bytes:
    """Another number in a whole column of a table, and so in many rows at once."""
    lines = raw.split(b"\n")
    sign = max((b",", b"\t", b";"), key=raw.count)
    i, text = int(rng.integers(6)), NUMBERS[rng.integers(len(NUMBERS))].encode()
    first, share = int(rng.integers(4)), rng.choice((0.3, 1.0))
    for k in range(first, len(lines)):
        cells = lines[k].split(sign)
        if i < len(cells) and rng.random() < share:
            cells[i] = text
            lines[k] = sign.join(cells)
    return b"\n".join(lines)


def _encoding(raw: bytes, rng: np.random.Generator) -> bytes:
    text = raw.decode("utf-8", errors="replace").encode(ENCODINGS[rng.integers(len(ENCODINGS))], errors="replace")
    return text[: len(text) - int(rng.integers(2))]


def _ends(raw: bytes, rng: np.random.Generator) -> bytes:
    return raw.replace(b"\n", (b"\r", b"\r\n", b"\n\r", b"\n\n", b"")[rng.integers(5)])


def _delimiter(raw: bytes, rng: np.random.Generator) -> bytes:
    signs = (b",", b"\t", b";", b" ", b".", b'"', b"=")
    return raw.replace(signs[rng.integers(len(signs))], signs[rng.integers(len(signs))])


def _array(raw: bytes, rng: np.random.Generator) -> bytes:
    """One array of a file of NumPy with other numbers, another shape or type, or left out; its checksums are right."""
    with np.load(io.BytesIO(raw)) as file:
        arrays = dict(file)
    name = sorted(arrays)[rng.integers(len(arrays))]
    array = arrays[name].copy()
    how = rng.integers(6)
    if how == 0:
        del arrays[name]
    elif how == 1:
        arrays[name] = array[..., :-1] if array.ndim else np.array([array, array])
    elif how == 2:
        arrays[name] = np.full(array.shape, "x")
    elif how == 3:
        arrays[name] = np.array([], dtype=array.dtype)
    elif array.size and (array.dtype.names is not None or array.dtype.kind in "iuf"):
        arrays[name] = array
        if array.dtype.names is not None:  # (one field of records)
            array = array[array.dtype.names[rng.integers(len(array.dtype.names))]]
        value = (
            (np.nan, np.inf, -np.inf, 1e308, 1e-320, -1.0, -1e300)[rng.integers(7)]
            if array.dtype.kind == "f"
            else (-1, 2**31 - 1)[rng.integers(2)]
        )
        with np.errstate(all="ignore"):
            array.flat[rng.integers(array.size)] = np.array(value).astype(array.dtype)
    saved = io.BytesIO()
    np.savez(saved, **arrays)
    return saved.getvalue()


Change = Callable[[bytes, np.random.Generator], bytes]
CHANGES: tuple[Change, ...] = (
    _flip, _cut, _leave_out, _repeat, _insert, _lines, _lines, _number, _number, _number, _column, _column, _encoding, _ends,
    _delimiter,
)  # fmt: skip


# --- commands ------------------------------------------------------------------------------------------------------------


def outcome(words: Sequence[str], limit: float = 20.0) -> str:
    """Run a command in this process: "answered", "refused", or what was wrong.

    Warnings count as errors: a user would see them.
    """
    from carom.cli import main

    out, err = (
        io.TextIOWrapper(io.BytesIO(), encoding="utf-8", errors="surrogateescape", newline="") for _ in range(2)
    )
    before, watched = sys.argv, threading.current_thread() is threading.main_thread()
    sys.argv = ["carom", *words]
    if watched:
        ask = words[0] == "gas"
        handler = signal.signal(signal.SIGPROF, _ask_to_end if ask else _late)
        signal.setitimer(signal.ITIMER_PROF, limit / 2 if ask else limit, limit / 2)
    try:
        with warnings.catch_warnings(), contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            warnings.simplefilter("error")
            main()
    except SystemExit as end:
        return _judged(end.code or 0, _text(out), _text(err), "--json" in words)
    except _LateError:
        return f"longer than {limit:g} s of CPU"
    except BaseException as error:
        own = [frame for frame in traceback.extract_tb(error.__traceback__) if "carom" in Path(frame.filename).parts]
        where = f"{Path(own[-1].filename).name}, {own[-1].name}" if own else "outside carom"
        return f"{type(error).__name__} in {where}: {' '.join(str(error).split())[:80]}"
    finally:
        if watched:
            signal.setitimer(signal.ITIMER_PROF, 0)
            signal.signal(signal.SIGPROF, handler)
        sys.argv = before
    return "main returned"


def _text(stream: io.TextIOWrapper) -> str:
    stream.flush()
    assert isinstance(stream.buffer, io.BytesIO)
    return stream.buffer.getvalue().decode("utf-8", errors="surrogateescape")


def _late(_number: int, _frame: Any) -> None:
    raise _LateError


def _ask_to_end(_number: int, _frame: Any) -> None:
    """Ask a gas to end as a user would: what a file asks for may take 10^17 events. The next time it is late."""
    signal.signal(signal.SIGPROF, _late)
    signal.raise_signal(signal.SIGTERM)


def _judged(code: Any, out: str, err: str, as_json: bool) -> str:
    if re.search(r"[\x00-\x08\x0b-\x1f\x7f]", err):
        return "control characters on standard error"
    if "Traceback" in err:
        return "a traceback on standard error"
    lines = err.splitlines()
    if code == 2:
        # (notes on what runs come before a refusal that comes while it runs)
        clean = all(re.match(r"(carom|note): \S", line) for line in lines) and any(
            x.startswith("carom: ") for x in lines
        )
        return "refused" if clean and not out else "refused, with other lines"
    if code:
        asked = code == 128 + signal.SIGTERM and err.startswith("carom: stopped after")
        return STOPPED if asked else f"exit code {code}"
    if as_json:
        try:
            json.loads(out, parse_constant=_no_json)
        except ValueError:
            return "no JSON"
    return "answered"


def _no_json(text: str) -> None:
    raise ValueError(text)


def one(seed: int, command: str, limit: float, keep: Path | None) -> Row:
    """Mutate a file, and run the command on it."""
    rng = np.random.default_rng(seed)
    kinds = COMMANDS[command][1]
    known = bases()[kinds[rng.integers(len(kinds))]]
    raw = mutated(known[rng.integers(len(known))], rng)
    found = run_on(raw, command, limit)
    if keep is not None and found not in ("answered", "refused"):
        (keep / f"{command.replace(' ', '_')}_{seed}").write_bytes(raw)
    return {"outcome": found}


def run_on(raw: bytes, command: str, limit: float) -> str:
    """Run a command on a file with this content, in a folder of its own, in which it may leave nothing."""
    words, kinds = COMMANDS[command]
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        file = Path(folder) / f"case.{ENDINGS.get(kinds[0], 'csv')}"
        if raw == b"pipe":
            os.mkfifo(file)
        elif raw in NO_FILES:
            file.symlink_to(raw.decode().removeprefix("link to "))
        else:
            file.write_bytes(raw)
        found = outcome([str(file) if word == "FILE" else word for word in words], limit)
        left = sorted(path.name for path in Path(folder).iterdir() if path != file)
    if found == STOPPED and left == ["case.checkpoint.npz"]:
        return "answered"
    if left and found in ("answered", "refused"):
        found = f"left {', '.join(left)}"
    return found


# --- processes -----------------------------------------------------------------------------------------------------------


class Worker:
    """A process that runs commands, and is replaced by a new one where compiled code does not come back."""

    def __init__(self, limit: float, keep: Path | None) -> None:
        self.limit, self.keep = limit, keep
        self.process: multiprocessing.process.BaseProcess | None = None

    def __call__(self, seed: int, command: str) -> Row:
        """Run one; the first of a command may compile."""
        if self.process is None:
            context = multiprocessing.get_context("spawn")
            # (several threads for a small matrix wait for each other, and the longer the busier the machine is)
            os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
            self.line, there = context.Pipe()
            self.process = context.Process(target=_serve, args=(there, self.limit, self.keep), daemon=True)
            self.process.start()
            self.compiled: set[str] = set()
        self.line.send((seed, command))
        limit = PATIENCE * self.limit + (10 * COMPILING_S if command not in self.compiled else 0.0)
        self.compiled.add(command)
        begin = before = _processor_time(self.process.pid)
        while not self.line.poll(PATIENCE * self.limit):
            # (not by the clock: beside other work this process may have a small part of the processor)
            now = _processor_time(self.process.pid)
            if now - begin > limit or now == before:
                found = "compiled code that does not come back"
                break
            before = now
        else:
            try:
                row: Row = self.line.recv()
                return row
            except EOFError:
                found = "the process died"
        self.close()
        return {"outcome": found}

    def close(self) -> None:
        """End the process."""
        if self.process is not None:
            self.process.kill()
            self.process.join()
            self.process = None


def _processor_time(process: int | None) -> float:
    """Return how much processor time a process has taken, s."""
    fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def _serve(line: Connection, limit: float, keep: Path | None) -> None:
    left_to_the_parent()
    _measure_each_film_once()
    compiled = set()
    with contextlib.suppress(EOFError):
        while True:
            seed, command = line.recv()
            if command not in compiled:  # by intact files, without a limit; the last ones are films that are measured
                compiled.add(command)
                for kind in COMMANDS[command][1]:
                    for raw in dict.fromkeys([*bases()[kind][:2], *bases()[kind][-2:]]):
                        run_on(raw, command, COMPILING_S)
            line.send(one(seed, command, limit, keep))


def _measure_each_film_once() -> None:
    """Keep the latest films that were measured: many changes of a file leave its tracks as they were."""
    from carom.tracks import films as film_files

    known: OrderedDict[bytes, Any] = OrderedDict()
    measure = film_files.measure

    def once(tracks: Any, settings: Any = None, progress: Any = None) -> Any:
        key = hashlib.sha256(pickle.dumps((tracks, settings))).digest()
        found = known.pop(key) if key in known else measure(tracks, settings, progress)
        known[key] = found
        if len(known) > KEPT_FILMS:
            known.popitem(last=False)
        return found

    film_files.measure = once


@contextlib.contextmanager
def runner(limit: float, keep: Path | None, here: bool) -> Iterator[Callable[[int, str], Row]]:
    """Yield what runs a command on the file of a seed: in this process, or in another."""
    if here:
        yield lambda seed, command: one(seed, command, max(limit, COMPILING_S), keep)
        return
    worker = Worker(limit, keep)
    try:
        yield worker
    finally:
        worker.close()


def main(words: Sequence[str] | None = None) -> int:
    """Count outcomes by command; 1 if one is a fault."""
    options: dict[str, dict[str, Any]] = {
        "first": {"type": int, "default": 0},
        "limit": {"type": float, "default": 20.0},
        "keep": {"type": Path},
    }
    faults = Counter[str]()
    with campaign("mutated_files", __doc__, words, count=100_000, small=24, **options) as run:
        keep = run.given.keep
        if keep is not None:
            keep.mkdir(parents=True, exist_ok=True)
        names = [name for name in COMMANDS if not run.given.only or name.startswith(run.given.only)]
        whole = sum(SLOW.get(name, 1.0) for name in names)
        if run.small:
            names = [name for name in names if SLOW.get(name, 1.0) >= 0.1]
        counts = {name: max(1, round(run.count * SLOW.get(name, 1.0) / whole)) for name in names}
        turns = sorted(((k + 0.5) / counts[name], name, k) for name in names for k in range(counts[name]))
        with runner(run.given.limit, keep, run.small) as send:
            wanted = [(name, run.given.first + k) for _turn, name, k in turns]
            found = run.go_through(wanted, lambda name, seed: send(seed, name))
        for name in names:
            rows = [row for row in found if row["kind"] == name]
            each = Counter(row["outcome"] for row in rows)
            bad = {key: n for key, n in each.items() if key not in ("answered", "refused")}
            if len(rows) >= ENOUGH and not each["answered"]:  # (then the command itself is wrong)
                bad["refused without exception"] = len(rows)
            faults.update(bad)
            run.say(f"{name:24} {len(rows):6,} files, {each['answered']:6,} answered, {each['refused']:6,} refused")
            for key, n in bad.items():
                first = min((row["seed"] for row in rows if row["outcome"] == key), default=run.given.first)
                run.say(f"    {n} × {key} (seed {first})")
        run.say(f"{len(found):,} files, {faults.total():,} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    raise SystemExit(main())
