"""The help of every command: it fits the terminal, cuts no name, gives flags no type, and defaults few digits."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import pytest
import typer
from reference.commands import command

from carom.cli import app


def all_commands(found: Any, path: tuple[str, ...] = ()) -> Iterator[tuple[str, ...]]:
    yield path
    for name, inner in getattr(found, "commands", {}).items():
        yield from all_commands(inner, (*path, name))


def find(words: tuple[str, ...]) -> Any:
    found: Any = typer.main.get_command(app)
    for word in words:
        found = found.commands[word]
    return found


ALL = list(all_commands(typer.main.get_command(app)))


def test_there_are_all_commands() -> None:
    assert len(ALL) > 20
    assert ("simulate",) in ALL
    assert ("sweep", "run") in ALL


def test_a_verb_that_is_left_out(capsys: pytest.CaptureFixture[str]) -> None:
    assert command(capsys, "tracks", "film.csv") == (
        2, "", "carom: tracks: expected show or example before 'film.csv' (carom tracks --help)\n",
    )  # fmt: skip
    assert "did you mean 'show'?" in command(capsys, "tracks", "shw", "film.csv")[2]


@pytest.mark.parametrize(
    ("words", "line"),
    [
        ("compare --sped 3", "--sped: expected an option of carom compare; did you mean '--speed'?"),
        (
            "compare --rate 60",
            "--rate: expected an option of carom compare; carom track, carom fit, carom judge and 1 more have --rate",
        ),
        ("compare --unheard", "--unheard: expected an option of carom compare"),
        ("fit --law x", "--law: expected an option of carom fit; did you mean '--laws'?"),
        ("compare --rakc", "--rakc: expected an option of carom compare; carom scene new has --rack"),
        ("gas --no-ball", "--no-ball: expected an option of carom gas"),
        ("fit --no-profile", "--no-profile: expected an option of carom fit; did you mean '--no-profiles'?"),
        ("fit --scatter kharaz2001", "--scatter: expected share or absolute, got 'kharaz2001'"),
        ("predict", "Missing argument 'table'."),
        ("sweep rum", "sweep: expected one of new, explain, run, status, verify, plot, got 'rum'; did you mean 'run'?"),
    ],
)
def test_unknown_words(words: str, line: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert command(capsys, *words.split()) == (2, "", f"carom: {line} (carom {words.split(maxsplit=1)[0]} --help)\n")


@pytest.mark.parametrize(
    ("words", "line"),
    [
        ("compare --speed", "--speed: expected a value, got none"),
        ("compare --speed --angle 30", "--speed: expected a value, got the next option, --angle"),
        ("fit kharaz2001 --scatter", "--scatter: expected share or absolute, got none"),
        ("fit kharaz2001 --scatter --laws maw", "--scatter: expected share or absolute, got the next option, --laws"),
    ],
)
def test_an_option_without_its_value(words: str, line: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert command(capsys, *words.split()) == (2, "", f"carom: {line}\n")
    # an empty value is one, and a number below 0
    assert "got none" not in command(capsys, "compare", "--angle", "", "--speed", "-1")[2]


@pytest.mark.parametrize("width", [40, 80, 120])
@pytest.mark.parametrize("words", ALL, ids=lambda words: " ".join(words) or "carom")
@pytest.mark.slow(keep=16)
def test_help(
    words: tuple[str, ...], width: int, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", str(width))
    code, text, _err = command(capsys, *words, "--help")
    assert code == 0
    assert [line for line in text.splitlines() if len(line.rstrip()) > width] == []
    assert "…" not in text  # (no name is cut)
    assert not re.search(r"bool|list\[", text, re.IGNORECASE)
    for option in find(words).params:
        if option.param_type_name == "option" and not option.hidden:
            assert [name for name in option.opts if not re.search(rf"{name}\b", text)] == []
    joined = re.sub(r"[\s│]+", " ", text)
    assert not re.search(r"\[default: \([^]]*\)\]", joined)  # (one pair of brackets)
    for default in re.findall(r"\[default: ([^]]*)", joined):
        for number in re.findall(r"\d*\.?\d+", default):
            assert len(number.replace(".", "").lstrip("0")) <= 6, f"{default} in carom {' '.join(words)} --help"


def test_texts_stand_beside_the_names_or_below_them(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    assert "\nRun:\n  --max-events N        Number of collisions" in command(capsys, "gas", "--help")[1]
    monkeypatch.setenv("COLUMNS", "40")
    assert "\nRun:\n  --max-events N\n    Number of" in command(capsys, "gas", "--help")[1]
