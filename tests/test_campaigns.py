"""Every campaign runs, as small as it goes; and what a complete run writes, and where."""

from __future__ import annotations

import importlib
import os
import re
import signal
import time
from concurrent.futures import ProcessPoolExecutor
from contextlib import closing
from multiprocessing import get_context
from pathlib import Path

import pytest
from campaign import NAMES, RESULTS, ROOT, campaign, counting_errors, held, left_to_the_parent, shares, write_result
from mutation.places import Mutant
from mutation.runs import Copy, NotGreenError


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.slow
def test_it_runs(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    before = RESULTS.read_text(encoding="utf-8")
    assert not importlib.import_module(name).main(["--small"])
    said = capsys.readouterr().out
    assert said
    # (a mutant's line of source may say math.inf)
    assert name == "mutants" or not re.search(r"\b(nan|inf)\b", said)
    assert RESULTS.read_text(encoding="utf-8") == before  # a small run is no result
    assert f"| `{name}` |" in before  # and the page names every campaign


def test_arcs_of_scenes_are_hit_as_brute_force_says() -> None:
    assert not importlib.import_module("curve_hits").main(["--small", "1000", "--only", "scene: flower, parabolas"])


def test_error_bars_of_fits_hold_the_truth(capsys: pytest.CaptureFixture[str]) -> None:
    # 60 tables: each share within three counting errors of what is promised
    importlib.import_module("fit_coverage").main(["--small", "60", "--only", "40 bounces, all measured"])
    for line in capsys.readouterr().out.splitlines():
        one, two = map(float, re.findall(r"(\d+\.\d) / +(\d+\.\d) ", line)[0])
        errors = counting_errors(60)
        assert abs(one - 68.27) < 3 * errors[0]
        assert abs(two - 95.0) < 3 * errors[1]


def test_an_equivalent_mutant_is_one_line_of_code_of_today() -> None:
    """Another change of the same numbers elsewhere in its module is none."""
    mutants = importlib.import_module("mutants")
    for known in mutants.judged_equivalent():
        path, rest = known.split(" | ", 1)
        text, change = rest.rsplit(" | ", 1)  # (code may have bars, too)
        lines = [line.strip() for line in (ROOT / "src" / "carom" / path).read_text(encoding="utf-8").splitlines()]
        assert text in lines, known
        assert change.split(" -> ")[0] in text, known
    row = {"mutant": "gas/species.py:23: 0 -> 1", "text": "found = 0"}
    assert mutants.identity(row) == "gas/species.py | found = 0 | 0 -> 1"
    elsewhere = {"mutant": "billiards/setup.py:1: 0 -> 1", "text": "return np.zeros(0)"}
    assert mutants.identity(elsewhere) not in mutants.judged_equivalent()


def test_a_complete_run_is_written(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    page = tmp_path / "page.md"
    page.write_text("# Campaigns\n\nWhat they are.\n")
    for words, result in (
        ([], "first"),
        ([], "second"),
        (["--small"], "small"),
        (["7"], "seven"),
        (["--only", "a"], "a"),
    ):
        with campaign("one", "What it counts.\n\nMore.", [*words, "--results", str(page)]) as run:
            run.say(result, run.count)
    write_result(page, "another", "Title.", ["line"], 60.0)
    text = page.read_text()
    assert text.startswith("# Campaigns\n\nWhat they are.\n\n## another\n\nTitle.\n")
    assert "second 1" in text
    assert not re.search("first|small|seven|\\na 1", text)
    assert len(capsys.readouterr().out.splitlines()) == 5


def test_no_section_of_the_page_is_lost_where_two_have_one_title(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text("# Campaigns\n\n## b\n\nThe last.\n\n## a\n\nOne.\n\n## a\n\nTwo.\n\n## b\n\nAn older part.\n")
    write_result(page, "b", "Title.", ["line"], 60.0)
    text = page.read_text()
    assert re.findall("^## (.*)", text, re.MULTILINE) == ["a", "a", "b", "b"]
    assert all(one in text for one in ("One.", "Two.", "line", "An older part."))
    assert "The last." not in text


def test_the_page_has_a_section_once() -> None:
    titles = re.findall("^## (.*)", RESULTS.read_text(encoding="utf-8"), re.MULTILINE)
    assert titles == sorted(set(titles))


def _survives() -> str:
    for one in (signal.SIGINT, signal.SIGTERM):
        os.kill(os.getpid(), one)
    return "it goes on"


def test_a_worker_leaves_signals_to_its_parent() -> None:
    """``timeout`` sends SIGTERM to all: the workers ended first, and the campaign with a traceback of their pool."""
    # (not forked: another test of this process may have loaded JAX, whose threads a fork does not bear)
    with ProcessPoolExecutor(1, get_context("spawn"), left_to_the_parent) as pool:
        assert pool.submit(_survives).result() == "it goes on"


def test_a_run_that_is_ended_reports_and_goes_on_from_its_rows(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    page, kept = tmp_path / "page.md", tmp_path / "rows.jsonl"
    page.write_text("# Campaigns\n")
    wanted, done = [(kind, seed) for seed in range(4) for kind in ("a", "b")], []

    def one(kind: str, seed: int) -> dict[str, int]:
        if len(done) == 5:
            os.kill(os.getpid(), signal.SIGTERM)  # (as timeout does)
            time.sleep(30)
        done.append((kind, seed))
        return {"square": seed**2}

    def go() -> list[dict[str, int]]:
        with campaign("one", "What it counts.", ["--rows", str(kept), "--results", str(page)]) as run:
            return run.go_through(wanted, one)

    before = signal.getsignal(signal.SIGTERM)
    assert [row["square"] for row in go()] == [0, 0, 1, 1, 4]
    assert signal.getsignal(signal.SIGTERM) is before
    assert capsys.readouterr().out == "ended after 5 of 8\n"
    assert "## one" not in page.read_text()  # what was ended is no result
    with kept.open("a") as file:
        file.write('{"kind": "b", "se')  # a line that was broken off
    done.append(("a line", 0))
    assert [row["square"] for row in go()] == [0, 0, 1, 1, 4, 4, 9, 9]
    assert done[6:] == wanted[5:]
    assert "## one" in page.read_text()
    done.clear()
    assert len(go()) == 8
    assert done == []  # all rows are in the file, after the broken line too
    with campaign("one", "What it counts.", ["--rows", str(kept), "--results", str(page)]) as run:
        run.go_through(wanted, one, again=lambda row: row["square"] == 4)
    assert done == [("a", 2), ("b", 2)]


def test_scenes_are_judged_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    module = importlib.import_module("no_event_missed")
    words = ["4", "--first", "100", "--processes", "1", "--rows", str(tmp_path / "rows.jsonl")]
    assert module.main(words) == 0
    first = capsys.readouterr().out
    assert re.match(r"4 scenes, [1-9]\d* events, [1-9][\d,]+ steps", first)
    monkeypatch.setattr(module, "random_scene", None)
    assert module.main(words) == 0
    assert capsys.readouterr().out == first
    monkeypatch.setattr(
        module, "look", lambda _kind, seed: {"fault": "deep in a wall", "row": 3, "size": 0.1, "events": {}, "steps": 1}
    )
    assert module.main(["2", "--first", "7", "--processes", "1"]) == 1
    assert "scene 8: deep in a wall, row 3, 0.1" in capsys.readouterr().out


def test_shares_and_their_counting_errors() -> None:
    assert held([0.5, -1.5, 2.5, [True, True]]) == (50.0, 75.0)
    assert counting_errors(100) == pytest.approx((4.654, 2.179), abs=1e-3)
    assert "(68.3 ± 23.3, 95.0 ± 10.9; 4 of 5)" in shares([0.1, 0.2, 0.3, 1.5, None])


@pytest.mark.slow
def test_a_mutant_is_killed_by_a_test_that_reaches_it_and_survives_where_there_is_none(tmp_path: Path) -> None:
    part, path = "core/test_phases.py", "core/motion/phases.py"
    source = (ROOT / "src" / "carom" / path).read_text(encoding="utf-8")
    with closing(Copy(ROOT, tmp_path)) as copied:
        with pytest.raises(NotGreenError, match="in use by another"):
            Copy(ROOT, tmp_path)
        baseline = copied.baseline([part])

        def fate(function: str, before: str, after: str) -> str:
            assert before in source
            return copied.try_mutant(
                Mutant(path, 1, "", function, before, after, source.replace(before, after)), baseline
            )

        assert fate("accelerations", "phase > PIVOTING or not", "phase > PIVOTING and not") == "plain"
        assert fate("accelerations", "phase > PIVOTING or not", "PIVOTING < phase or not") == "survived"
        assert fate("advance", "h = s * s / 2", "h = s * s / 3") == "survived"  # which none of these tests calls
