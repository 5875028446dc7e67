"""``carom fit``, ``carom.fit`` and ``fit_laws`` on the same data: one verdict, the same rows, numbers and notes, word by word."""

from __future__ import annotations

import json
import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
from reference.commands import command
from reference.thrown_ball import KAPPA, RADIUS, as_csv, film, table, thrown

import carom
from carom.cli.verbs import with_options
from carom.data import make_rebounds, published_rebounds, read_rebounds
from carom.data.datasets import load
from carom.fitting import Ranking, Setting, fit_laws, ranking
from carom.tracks import Settings
from carom.tracks.films import measure_films

BALL = ("--radius", str(RADIUS), "--inertia", str(KAPPA))
SETTING = {"radius": RADIUS, "kappa": KAPPA}
THROWS = [
    thrown(speed, height) for speed, height in ((2.0, 0.5), (2.5, 0.4), (3.0, 0.6), (3.5, 0.5), (4.0, 0.7), (4.5, 0.4))
]


def throws(folder: Path, count: int = 6) -> list[Path]:
    """Balls that are thrown without spin and bounce three times each; no spin was seen."""
    file = folder / "throws.csv"
    file.write_text(as_csv(table(THROWS[:count])))
    return [file]


def few_throws(folder: Path) -> list[Path]:
    """Too few first contacts to leave the later ones out."""
    return throws(folder, 3)


def rolled(folder: Path) -> list[Path]:
    """Balls that roll into an upright wall and, after it, roll again."""
    rng = np.random.default_rng(1)
    ball = carom.Ball(radius=0.025, mass=0.04)
    v_n, v_t = rng.uniform(0.5, 2.0, 16), rng.uniform(-1, 1, 16)
    before = carom.rolling(ball, np.stack([-v_n, v_t], axis=-1), np.zeros(16))
    v = carom.two_step(ball, before, wall=carom.Surface(0.72, 0.18), floor=carom.Surface(0.0, 0.25)).rolling.velocity
    columns = {"v_n_in": v_n, "v_t_in": v_t, "spin_z_in": np.zeros(16), "sigma_v_n_out": 0.005, "sigma_v_t_out": 0.005}
    columns |= {f"v_{name}_out": v[:, k] + 0.005 * rng.normal(size=16) for k, name in enumerate("nt")}
    return [make_rebounds("table", columns, stage="rolling").save(folder / "rolled.csv")]


def discs(folder: Path, *, bars: bool = False, gaps: bool = False) -> list[Path]:
    """Discs that slide into a wall with friction 0.3; their spins were measured, in the rows without a gap."""
    rng = np.random.default_rng(2)
    v_n, v_t, spin = rng.uniform(1, 3, 14), rng.uniform(-2, 2, 14), rng.uniform(-20, 20, 14)
    slip = v_t - 0.05 * spin
    change = -np.sign(slip) * np.minimum(0.3 * 1.8 * v_n, np.abs(slip) / 3)
    columns = {"v_n_in": v_n, "v_t_in": v_t, "spin_in": spin, "v_n_out": 0.8 * v_n, "v_t_out": v_t + change,
               "spin_out": spin - change / (0.5 * 0.05)}  # fmt: skip
    for name, size in {"v_n_out": 0.01, "v_t_out": 0.01, "spin_out": 0.5}.items():
        columns[name] = columns[name] + size * rng.normal(size=14)
        if bars:
            columns[f"sigma_{name}"] = np.full(14, size)
    if gaps:
        columns["spin_in"][::3] = np.nan
    return [make_rebounds("planar", columns).save(folder / "discs.csv")]


def discs_with_bars_and_gaps(folder: Path) -> list[Path]:
    """Discs with error bars; of some the spin before was not measured."""
    return discs(folder, bars=True, gaps=True)


def rackets(folder: Path) -> list[Path]:
    """The measured rebounds of two rackets, with a column that says which."""
    lines = Path(load("tt_rackets").path).read_text().splitlines()
    file = folder / "rackets.csv"
    file.write_text(
        "\n".join([lines[0], *(line for line in lines if "01_inverted" in line or "10_antispin" in line)]) + "\n"
    )
    return [file]


def side_films(folder: Path) -> list[Path]:
    """Films of thrown balls, and one without a contact."""
    files = [folder / f"film{number}.csv" for number in range(5)]
    for number, file in enumerate(files[:4]):
        track = film(THROWS[number], seed=number)
        rows = np.column_stack([track.time, track.position])
        np.savetxt(file, rows, fmt="%.6f", delimiter=",", header="t [s],x [m],y [m]", comments="")
    files[-1].write_text("t,x,y\n" + "".join(f"{k / 50},{0.02 * k},{0.01 * k}\n" for k in range(40)))
    return files


def one_film(folder: Path) -> list[Path]:
    """One film of a ball that bounces five times."""
    track = film(thrown(3.0, 1.2, count=5))
    file = folder / "film.csv"
    rows = np.column_stack([track.time, track.position])
    np.savetxt(file, rows, fmt="%.6f", delimiter=",", header="t [s],x [m],y [m]", comments="")
    return [file]


class Case(NamedTuple):
    """Data, and what is said of them on the command line and in Python."""

    data: Callable[[Path], list[Path]] | str
    words: tuple[str, ...] = ()
    setting: dict[str, Any] = {}  # noqa: RUF012
    rows: dict[str, Any] = {}  # noqa: RUF012
    said: str = ""
    """Part of a note, in the words of the command line."""


DISC = (("--radius", "0.05", "--inertia", "0.5"), {"radius": 0.05, "kappa": 0.5})
CASES = {
    "throws, spins carried on": Case(throws, BALL, SETTING, {}, "in 12 later contacts carried on from the ball's contact before"),
    "throws without spin": Case(throws, (*BALL, "--spin", "0"), SETTING, {"spin": 0.0}, "--spin 0 holds for the first contact"),
    "throws, every contact": Case(throws, (*BALL, "--every-contact"), SETTING, {"every_contact": True}, "in 18 of 18 rows"),
    "throws, a prior": Case(throws, (*BALL, "--spin", "normal:0.5"), SETTING, {"spin": "normal:0.5"}, "width 0.5 v/a"),
    "few throws": Case(few_throws, BALL, SETTING, {}, "film more throws before relying on a verdict (--spin 0 if"),
    "rolled": Case(rolled, ("--radius", "0.025"), {"radius": 0.025}, {}, "--contact-height is not given: assumed to be 1"),
    "rolled, a nose": Case(
        rolled, ("--radius", "0.025", "--contact-height", "1.2", "--floor-friction", "0.25"),
        {"radius": 0.025, "contact_height": 1.2, "floor_friction": 0.25},
    ),
    "discs without error bars": Case(discs, *DISC, {}, "the scatter is estimated"),
    "discs, given error bars": Case(
        discs, (*DISC[0], "--sigma-v", "0.01", "--sigma-spin", "0.5"), DISC[1], {"sigma_v": 0.01, "sigma_spin": 0.5}
    ),
    "discs, missing spins": Case(
        discs_with_bars_and_gaps, (*DISC[0], "--spin", "uniform:1.5"), DISC[1], {"spin": "uniform:1.5"}, "in 5 of 14 rows"
    ),
    "rackets": Case(
        rackets, ("--radius", "0.02", "--inertia", "hollow"), {"radius": 0.02, "kappa": 2 / 3}, {},
        "2 kinds of rows are fitted together (01_inverted, 10_antispin); --where racket=01_inverted selects one",
    ),
    "one racket": Case(
        rackets, ("--radius", "0.02", "--inertia", "hollow", "--where", "racket=10_antispin"),
        {"radius": 0.02, "kappa": 2 / 3}, {"where": {"racket": "10_antispin"}},
    ),
    "films": Case(side_films, BALL, SETTING, {}, "1 of 5 films have no contact that can be measured"),
    "one film": Case(one_film, BALL, SETTING, {}, "film more throws before relying on a verdict"),
    "kharaz2001": Case("kharaz2001", said="are the second error bar"),
    "mathavan2009": Case("mathavan2009", said="the printed error bars contain the digitisation alone"),
}  # fmt: skip


def in_python(case: Case, files: list[Path], laws: list[str]) -> dict[str, Any]:
    """The ranking of the same data by calls of the library."""
    quick: dict[str, Any] = {"profiles": False, "bootstrap": 0}
    if isinstance(case.data, str):
        ours = published_rebounds(case.data)
        return fit_laws(ours.rebounds, Setting(**ours.setting), laws, shifted=ours.shifted, **quick).as_dict()
    if case.data in (side_films, one_film):
        rows = measure_films(files, settings=Settings(**case.setting)).rebounds()
    else:
        rows = read_rebounds(files[0], kind="planar" if case.data is not rolled else None)
    return fit_laws(rows, Setting(**case.setting), laws, **case.rows, **quick).as_dict()


@pytest.fixture
def rankings(monkeypatch: pytest.MonkeyPatch) -> dict[bytes, Ranking]:
    """All rankings of a test, by what they were made of: the same rows and settings, bit by bit, are fitted once.

    What could differ between Python and the command is what they make of data and options before; and then it is fitted again.
    """
    known: dict[bytes, Ranking] = {}
    fit_rows = ranking._fit_rows

    def fit_new(*given: Any) -> Ranking:
        rows, setting, laws, profiles, bootstrap, seed, _progress, *before = given
        asked = pickle.dumps((rows, setting, laws, profiles, bootstrap, seed, before))
        if asked not in known:
            known[asked] = fit_rows(*given)
        return known[asked]

    monkeypatch.setattr(ranking, "_fit_rows", fit_new)
    return known


@pytest.mark.parametrize("name", CASES)
@pytest.mark.slow(keep=2)
def test_python_and_the_command_say_the_same(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str], rankings: dict[bytes, Ranking]
) -> None:
    case = CASES[name]
    files = [Path(case.data)] if isinstance(case.data, str) else case.data(tmp_path)
    laws = ["sliding", "mirror"] if case.data is not rolled and name != "mathavan2009" else ["two-step", "mirror"]
    if case.data is throws:  # (a fit with unmeasured spins takes a second)
        laws = ["sliding"] if case.rows else ["sliding", "maw"]
    if case.data is side_films:  # (or ten, with all the contacts of films; one film has both laws)
        laws = ["mirror"]
    words = ("--laws", ",".join(laws), "--no-profiles", "--bootstrap", "0", "--json", *case.words)
    kind = ("--kind", "planar") if case.data in (throws, few_throws, rackets) else ()
    code, out, err = command(capsys, "fit", *map(str, files), *words, *kind)
    assert code == 0, err
    told, found = json.loads(out), in_python(case, files, laws)
    for part in ("verdict", "rows", "notes"):
        assert told[part] == with_options(found[part])
    assert told == json.loads(json.dumps(with_options(found)))
    ball: dict[str, Any] = {"inertia" if name == "kappa" else name: value for name, value in case.setting.items()}
    more: dict[str, Any] = {"laws": laws, "profiles": False, "bootstrap": 0, "kind": kind[-1] if kind else None}
    ranking = carom.fit(files if len(files) > 1 else files[0], **ball, **case.rows, **more)
    assert told == json.loads(json.dumps(with_options(ranking.as_dict())))
    assert case.said in "\n".join(told["notes"])
