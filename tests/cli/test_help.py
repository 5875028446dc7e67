"""The help of every command: it fits the terminal, flags have no type, defaults have few digits."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import pytest
import typer
from reference.commands import command

import carom.cli


def commands(found: Any, words: tuple[str, ...] = ()) -> Iterator[tuple[str, ...]]:
    yield words
    for name, inner in getattr(found, "commands", {}).items():
        yield from commands(inner, (*words, name))


ALL = list(commands(typer.main.get_command(carom.cli.app)))


@pytest.mark.parametrize("width", [40, 80, 120])
def test_help_of_every_command(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, width: int) -> None:
    monkeypatch.setenv("COLUMNS", str(width))
    assert len(ALL) > 20
    for words in ALL:
        code, out, _err = command(capsys, *words, "--help")
        assert code == 0, words
        assert "Usage:" in out, words
        assert max(map(len, out.splitlines())) <= width, words
        assert "<bool>" not in out, words
        said = " ".join(re.sub("[│╭╮╰╯─]", " ", out).split())
        for default in re.findall(r"\[default: ([^\]]*)\]", said):
            for number in re.findall(r"\d+\.\d+(?:e[-+]?\d+)?", default):
                assert len(number.replace(".", "").lstrip("0")) <= 6, (words, number)
