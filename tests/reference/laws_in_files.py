"""Files of every kind that carom reads, with a custom law in each of their text fields, and all that reads them.

The law's file writes a mark when it is run. A reader may answer or refuse, but nothing that it reads may run that file.
"""

from __future__ import annotations

import atexit
import contextlib
import io
import json
import re
import shutil
import sys
import tempfile
import tomllib
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import tomli_w

import carom

ROOT = Path(__file__).parents[2]
TRACKS = ROOT / "tests" / "tracks" / "files"
SHOTS = ROOT / "tests" / "interop" / "files"
LAW = "evil.py:law"
AS_IT_IS = "as it is"
EVIL = """
import pathlib
pathlib.Path({mark!r}).touch()
def law(v, w, n, a, kappa, e, mu, beta):
    return (-v[0], v[1], v[2]), w
"""
SCENE = """
[floor]
friction = 0.2
[[walls]]
shape = "plane"
name = "cushion"
point = ["0 m", 0, 0]
normal = [1, 0, 0]
restitution = 0.8
friction = 0.2
law = "mirror"
[[walls]]
shape = "polygon"
points = [[3, -3], [3, 3], [2.9, 3]]
restitution = {form = "exponential", at_rest = 0.9, at_speed = 0.7, speed = 1.0}
friction = 0.2
[[balls]]
name = "white"
radius = "30 mm"
mass = "0.2 kg"
inertia = "solid"
position = [1, 0]
velocity = ["-1 m/s", 0.3]
[ball_contact]
restitution = 0.9
friction = 0.1
[run]
law = "two-step"
duration = "0.1 s"
"""
GAS = """
[container]
shape = "periodic"
size = ["8 m", 8, 8]
[[species]]
name = "a"
count = 8
radius = 0.5
mass = 1.0
temperature = 1.0
inertia = "solid"
[[contacts]]
between = ["a", "a"]
restitution = 0.9
friction = 0.1
[run]
start = "lattice"
max_events = 20
"""
SWEEPS = {
    "scene": {
        "scene": tomllib.loads(SCENE),
        "keep": ["final.position"],
        "parameters": {"run.law": ["two-step", "mirror"], "walls.0.law": ["mirror"]},
    },
    "impact": {
        "impact": {"restitution": 0.8, "law": "mirror"},
        "keep": ["reflection_angle"],
        "parameters": {"law": ["two-step", "mirror"]},
    },
    "impact along": {
        "impact": {"restitution": 0.8},
        "keep": ["reflection_angle"],
        "parameters": {"law": {"values": ["two-step", "mirror"], "dim": "rule"}, "angle": {"linspace": [0, 50, 2]}},
    },
    "orbit": {
        "orbit": {"table": "circle", "law": "no-slip", "bounces": 20},
        "keep": ["bounces.count"],
        "parameters": {"law": ["no-slip", "mirror"], "kappa": [0.2]},
    },
    "gas": {"gas": tomllib.loads(GAS), "keep": ["events"], "parameters": {"contacts.0.restitution": [0.9]}},
}
FILM = ("--radius", "0", "--scale", "1mm", "--rate", "120")


class Case(NamedTuple):
    """A file with the law in one place: its kind, the place, its name, and what writes it."""

    kind: str
    place: str
    name: str
    write: Callable[[Path], object]


# --- places in trees of tables and lists -----------------------------------------------------------------------------------


def variants(tree: Any, law: str, every: bool) -> Iterator[tuple[str, Any]]:
    """A tree as it is, once for each text in it with the law in its place, and for each table with a key ``law`` more.

    Of places whose paths differ in numbers alone, the first, unless ``every``. A text that is JSON is a tree again.
    """
    yield AS_IT_IS, tree
    seen = set()
    for path, made in _changed(tree, law, ()):
        place = ".".join("*" if isinstance(part, int) and not every else str(part) for part in path)
        if place not in seen:
            seen.add(place)
            yield place, made


def _changed(value: Any, law: str, path: tuple[str | int, ...]) -> Iterator[tuple[tuple[str | int, ...], Any]]:
    if isinstance(value, str):
        inner = _as_json(value)
        if inner is None:
            yield path, law
        else:
            yield from ((place, json.dumps(made)) for place, made in _changed(inner, law, path))
    elif isinstance(value, dict):
        for key in ("law", "run.law"):
            if value.get(key) != law:
                yield (*path, key), value | {key: law}
        for key, one in value.items():
            for place, made in _changed(one, law, (*path, key)):
                yield place, value | {key: made}
    elif isinstance(value, list):
        for i, one in enumerate(value):
            for place, made in _changed(one, law, (*path, i)):
                yield place, [*value[:i], made, *value[i + 1 :]]


def _as_json(text: str) -> Any:
    if not text.startswith(("{", "[")):
        return None
    with contextlib.suppress(ValueError):
        return json.loads(text)
    return None


def texts(raw: str, law: str, every: bool) -> Iterator[tuple[str, str]]:
    """A table in text as it is, with the law in the place of each word of its first lines, and in a column of its own."""
    yield AS_IT_IS, raw
    lines = raw.split("\n")
    sign = max((",", "\t", ";", " "), key=raw.count)
    for i, line in enumerate(lines[: 40 if every else 5]):
        for k, cell in enumerate(line.split(sign)):
            if re.search(r"[A-Za-z]", cell) or (every and cell.strip()):
                cells = line.split(sign)
                cells[k] = law
                yield f"line {i + 1}, cell {k + 1}", "\n".join([*lines[:i], sign.join(cells), *lines[i + 1 :]])
    yield (
        "a column law",
        "\n".join(f"{line}{sign}{law if i else 'law'}" if line else line for i, line in enumerate(lines)),
    )
    yield "a comment", f"# law: {law}\n{raw}"


# --- files of every kind -----------------------------------------------------------------------------------------------------


KINDS = ("scene", "gas", "sweep", "store", "run", "checkpoint", "start", "shot", "track", "states", "rebounds")


def cases(kind: str, law: str = LAW, every: bool = False) -> Iterator[Case]:
    """The files of a kind, with the law in every text field; first each as it should be."""
    if kind in ("scene", "gas"):
        yield from _tables(kind, f"{kind}.toml", tomllib.loads(SCENE if kind == "scene" else GAS), law, every)
    elif kind == "sweep":
        for one, tree in SWEEPS.items():
            yield from _tables(f"sweep of {one}", "sweep.toml", tree, law, every)
    elif kind == "store":
        for one in SWEEPS:
            yield from _stores(one, law, every)
    elif kind == "run":
        yield from _runs(law, every)
    elif kind == "checkpoint":
        yield from _checkpoints(law, every)
    elif kind == "shot":
        yield from _shots(law, every)
    elif kind == "track":
        for file in sorted(TRACKS.iterdir()):
            yield from _lines(f"track {file.name}", file.name, file.read_text(encoding="utf-8-sig"), law, every)
    elif kind == "states":
        raw = "velocity_x,velocity_y,spin_z,radius_mm,note\n-1,1,0,26.25,first\n-2,0.5,10,26.25,second\n"
        yield from _lines(kind, "states.csv", raw, law, every)
    elif kind == "start":
        rows = "".join(f"{x},{y},1,a\n" for x in (1, 3, 5, 7) for y in (1, 3))
        yield from _lines(kind, "start.csv", f"x,y,z,species\n{rows}", law, every)
        grid = np.stack(np.meshgrid([1.0, 3, 5, 7], [1.0, 3], [1.0]), -1).reshape(-1, 3)
        start = {"position": grid, "species": np.array([law] * 8), "law": np.array(law)}
        yield Case(kind, "species and law", "start.npz", lambda file: np.savez(file, **start))
    elif kind == "rebounds":
        yield from _lines(kind, "rebounds.csv", _rebounds(), law, every)


def _tables(kind: str, name: str, tree: Any, law: str, every: bool) -> Iterator[Case]:
    for place, made in variants(tree, law, every):
        yield Case(kind, place, name, lambda file, made=made: file.write_text(tomli_w.dumps(made)))


def _lines(kind: str, name: str, raw: str, law: str, every: bool) -> Iterator[Case]:
    tree = _as_json(raw)
    found = (
        texts(raw, law, every) if tree is None else ((at, json.dumps(one)) for at, one in variants(tree, law, every))
    )
    for place, made in found:
        yield Case(kind, place, name, lambda file, made=made: file.write_text(made))


def _stores(kind: str, law: str, every: bool) -> Iterator[Case]:
    folder = _store(kind)
    if folder is None:
        return
    for meta in sorted(folder.rglob("zarr.json")):
        about = json.loads(meta.read_text())
        about.pop("consolidated_metadata", None)
        for place, made in variants(about, law, every):
            if not place.startswith(("attributes", AS_IT_IS)):
                continue

            def write(file: Path, meta: Path = meta, made: Any = made) -> None:
                shutil.copytree(folder, file)
                there = file / meta.relative_to(folder)
                whole = json.loads(there.read_text())
                there.write_text(json.dumps(whole | made))

            yield Case(f"store of {kind}", f"{meta.parent.name} {place}", "sweep.zarr", write)


@cache
def _store(kind: str) -> Path | None:
    """A store that is done, in a folder that stays as long as the process."""
    try:
        import zarr  # noqa: F401
    except ImportError:
        return None
    folder = Path(tempfile.mkdtemp(prefix="laws-"))
    _remove_at_exit(folder)
    file = folder / "sweep.toml"
    file.write_text(tomli_w.dumps(SWEEPS[kind]))
    carom.sweeps.load_sweep(file, folder / "sweep.zarr").run()
    return folder / "sweep.zarr"


def _remove_at_exit(folder: Path) -> None:
    atexit.register(shutil.rmtree, folder, ignore_errors=True)


def _runs(law: str, every: bool) -> Iterator[Case]:
    """Runs that were saved, whose checksums fit what the law was written into."""
    from carom.simulation import files as save

    run = carom.simulate(carom.load_scene(SCENE))
    columns = save.log_columns(run.log)
    about = {"carom_format": save.FORMAT, "carom": save.version(), "end": run.end, "ended": run.ended}
    about["scene"] = json.dumps(run.scene.model_dump(mode="json", exclude_none=True))
    for place, made in variants(about, law, every):
        signed = made | {"end": run.end}
        signed["sha256"] = save.digest_of(run.log, signed)
        whole = json.dumps(signed)
        yield Case(
            "run", place, "run.parquet", lambda file, whole=whole: save.write_parquet(columns, {"carom": whole}, file)
        )


def _checkpoints(law: str, every: bool) -> Iterator[Case]:
    from carom.gas import GasScene, Session, save_checkpoint

    session = Session(GasScene(**tomllib.loads(GAS)))
    session.outputs = {"--measures": "measures.json"}
    with tempfile.TemporaryDirectory() as folder:
        save_checkpoint(session, Path(folder) / "gas.npz")
        with np.load(Path(folder) / "gas.npz") as file:
            arrays = dict(file)
    about = json.loads(str(arrays["carom_checkpoint"]))
    for place, made in variants(about, law, every):
        whole = arrays | {"carom_checkpoint": np.array(json.dumps(made))}
        yield Case("checkpoint", place, "gas.npz", lambda file, whole=whole: np.savez(file, **whole))
    yield Case(
        "checkpoint", "name of an array", "gas.npz", lambda file: np.savez(file, **arrays, **{law: np.array(law)})
    )


def _shots(law: str, every: bool) -> Iterator[Case]:
    names = ("bank.json", "main_hop.json", "two_shots.json") if every else ("bank.json",)
    for name in names:
        tree = json.loads((SHOTS / name).read_text())
        for place, made in variants(tree, law, False):
            yield Case(
                "shot", f"{name} {place}", "shot.json", lambda file, made=made: file.write_text(json.dumps(made))
            )
            if every:
                import msgpack

                yield Case("shot", place, "shot.msgpack", lambda file, made=made: file.write_bytes(msgpack.packb(made)))


def _rebounds() -> str:
    from carom.data.published import published_rebounds

    with tempfile.TemporaryDirectory() as folder:
        return published_rebounds("mathavan2009").rebounds.save(Path(folder) / "table.csv").read_text()


# --- readers -------------------------------------------------------------------------------------------------------------------


def command(*words: str) -> Callable[[Path], object]:
    """Run ``carom`` with these words in this process; FILE stands for the file."""

    def run(file: Path) -> object:
        from carom.cli import main

        before, sys.argv = sys.argv, ["carom", *(str(file) if word == "FILE" else word for word in words)]
        try:
            main()
        except SystemExit as end:
            return end.code
        finally:
            sys.argv = before
        return None

    return run


def _start(file: Path) -> object:
    scene = file.with_name("of_start.toml")
    scene.write_text(GAS.replace('"lattice"', f'"{file.name}"'))
    return command("gas", str(scene), "--quiet")(file)


def readers(kind: str) -> list[tuple[str, Callable[[Path], object]]]:
    """All that reads a kind of file, by what it is called."""
    first = kind.split(" ", maxsplit=1)[0]
    sweep = carom.sweep
    measure: dict[str, list[tuple[str, Callable[[Path], object]]]] = {
        "scene": [
            ("load_scene", carom.load_scene),
            ("load_scene of the text", lambda file: carom.load_scene(file.read_text() + "\n")),
            ("simulate in Python", carom.simulate),
            ("scene check", command("scene", "check", "FILE")),
            ("simulate", command("simulate", "FILE", "--max-events", "3", "--json")),
            ("explore", command("explore", "FILE", "--no-open", "--out", "page.html")),
            ("aim", command("aim", "FILE", "--ball", "white", "--point", "0.5,0.1", "--starts", "4")),
        ],
        "gas": [
            ("load_gas", carom.gas.load_gas),
            ("scene check", command("scene", "check", "FILE")),
            ("gas", command("gas", "FILE", "--max-events", "3", "--quiet")),
        ],
        "sweep": [
            ("load_sweep", carom.sweeps.load_sweep),
            ("sweep explain", command("sweep", "explain", "FILE")),
            ("sweep run", command("sweep", "run", "FILE", "--store", "out.zarr")),
        ],
        "store": [
            ("sweep", sweep),
            ("sweep explain", command("sweep", "explain", "FILE")),
            ("sweep run", command("sweep", "run", "FILE")),
            ("sweep status", command("sweep", "status", "FILE")),
            ("sweep verify", command("sweep", "verify", "FILE")),
            ("sweep plot", command("sweep", "plot", "FILE", "--out", "map.svg")),
        ],
        "run": [("load_trajectory", carom.load_trajectory)],
        "checkpoint": [
            ("load_checkpoint", carom.gas.load_checkpoint),
            ("gas --resume", command("gas", "--resume", "FILE", "--quiet")),
        ],
        "start": [("gas", _start)],
        "shot": [("pooltool's shots", carom.interop.pooltool.read)],
        "track": [
            ("read_tracks", carom.tracks.read_tracks),
            ("tracks show", command("tracks", "show", "FILE", "--json", *FILM)),
        ],
        "states": [("predict", command("predict", "FILE"))],
        "rebounds": [
            ("read_rebounds", carom.data.read_rebounds),
            ("predict", command("predict", "FILE", "--out", "out.csv")),
            ("explore", command("explore", "--data", "FILE", "--no-open", "--out", "page.html")),
        ],
    }  # fmt: skip
    return measure[first]


# --- looking -------------------------------------------------------------------------------------------------------------------


class Found(NamedTuple):
    """How a reader dealt with a file."""

    case: Case
    reader: str
    answer: str
    """ "answered" or "refused", or what was wrong: the law ran, a file was left after a refusal, an exception."""


def tried(case: Case, folder: Path, turn: int | None = None) -> Iterator[Found]:
    """Write a case's file into an empty folder beside the law, and give it to all of its readers.

    With ``turn`` only to one of them.
    """
    mark = folder.parent / f"{folder.name}.ran"
    known = readers(case.kind)
    for name, read in known if turn is None else [known[turn % len(known)]]:
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        mark.unlink(missing_ok=True)
        (folder / "evil.py").write_text(EVIL.format(mark=str(mark)))
        file = folder / case.name
        case.write(file)
        before = _files(folder)
        silent = io.TextIOWrapper(io.BytesIO(), encoding="utf-8")
        with contextlib.chdir(folder), contextlib.redirect_stdout(silent), contextlib.redirect_stderr(silent):
            answer = _answer(read, file)
        if answer == "refused" and (left := _files(folder) - before - {"of_start.toml"}):
            answer = f"refused, and left {', '.join(sorted(left))}"
        if mark.exists():
            answer = "the law ran"
        yield Found(case, name, answer)


def _answer(read: Callable[[Path], object], file: Path) -> str:
    try:
        return "refused" if read(file) == 2 else "answered"
    except carom.CaromError:
        return "refused"
    except Exception as error:
        return f"{type(error).__name__}: {' '.join(str(error).split())[:100]}"


def _files(folder: Path) -> set[str]:
    return {str(path.relative_to(folder)) for path in folder.rglob("*")}
