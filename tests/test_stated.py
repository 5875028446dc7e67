"""Numbers of README, index and paper are what carom computes now, or stand in the tables of the docs; none is without a source."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from dev import stated
from reference.commands import command

README = (Path(__file__).parents[1] / "README.md").read_text(encoding="utf-8")


def test_statements_are_what_is_computed_now() -> None:
    pytest.importorskip("matplotlib")
    assert len(stated.STATEMENTS) > 20
    assert not [fault for one in stated.STATEMENTS if (fault := one.wrong())]


@pytest.mark.parametrize(
    ("printed", "value", "same"),
    [
        ("29.05", 29.0546, True),
        ("29.1", 29.0546, True),
        ("29.0", 29.0546, False),
        ("108,000", 108000, True),
        ("fifteen", 15, True),
        ("4", 4.06, True),
        ("0.027", 0.0276, False),
    ],
)
def test_a_number_agrees_where_it_is_the_value_rounded(printed: str, value: float, same: bool) -> None:
    assert stated.agrees(printed, value) is same


def test_a_sentence_that_is_gone_and_a_stale_one_are_faults() -> None:
    one = next(one for one in stated.STATEMENTS if one.page == "paper.md")
    assert "no sentence like" in stated.Statement("paper.md", r"a million (\d+)", one.computed, one.source).wrong()
    stale = stated.Statement(one.page, one.pattern, lambda: [2 * x for x in one.computed()], one.source)
    assert one.source in stale.wrong()


@pytest.mark.parametrize("page", stated.PAGES)
def test_no_number_is_without_a_source(page: str) -> None:
    found = stated.stated(page)
    assert found
    assert not [(one.line, one.number) for one in found if one.kind == "no source"]


def test_a_number_that_nobody_made_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stated, "text", lambda _page: "It is 739.5 times as fast, by $x^{17}$ (2001), `--n 55`.\n")
    kinds = {one.number: one.kind for one in stated.stated("README.md")}
    assert kinds == {"739.5": "no source", "17": "formula", "2001": "name", "55": "code"}


def test_the_table_of_the_readme_is_what_the_command_prints(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "100")
    (line,) = re.findall(r"^\.venv/bin/carom (compare .*)$", README, re.MULTILINE)
    code, told, _ = command(capsys, *line.split())
    assert code == 0
    (table,) = re.findall(r"^```\n( +angle .*?)^```", README, re.MULTILINE | re.DOTALL)
    printed = [line.split() for line in told.splitlines()]
    rows = [line.split() for line in table.splitlines() if line.rstrip()[-1:] in "✗✓"]
    assert len(rows) == 6
    assert [row for row in rows if row not in printed] == []


def test_results_in_comments_of_the_readme_are_what_its_code_prints(capsys: pytest.CaptureFixture[str]) -> None:
    block = re.findall(r"^```python\n(.*?)^```", README, re.MULTILINE | re.DOTALL)[0]
    exec(block, {})
    told = capsys.readouterr().out.split()
    comment = re.search(r"^# (\S+)\.\.\. rad .*?, (\S+)\.\.\. m, (\w+), (\S+)\.\.\., (\w+)$", block, re.MULTILINE)
    assert comment is not None
    assert len(told) == 5
    assert all(now.startswith(then) for now, then in zip(told, comment.groups(), strict=True)), (told, comment.groups())
