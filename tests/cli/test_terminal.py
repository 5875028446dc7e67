"""Names cannot steer the terminal; output that nobody takes ends in one line, and loses nothing."""

from __future__ import annotations

import io
import json
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from reference.commands import command, fails
from rich.table import Table
from rich.text import Text

import carom.cli
from carom.cli.console import TextConsole
from carom.formatting import escape_controls

# (red letters, a closing tag of Rich's markup, a text that runs backwards, a bell)
EVIL = "\x1b[31mred[/b]\u202e\x9b2J\x07"
ESCAPED = r"\x1b[31mred[/b]\u202e\x9b2J\x07"
STEERS = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]")
SCENE = """
gravity = 0
[[walls]]
shape = "plane"
point = [0, 0, 0]
normal = [1, 0, 0]
restitution = 1
friction = 0.3
name = {name}
[[balls]]
radius = 0.1
mass = 1
position = [1, 0]
velocity = [-1, 0]
name = {name}
[[balls]]
radius = 0.1
mass = 1
position = [5, 0]
[run]
max_events = {most}
"""
GAS = """
[container]
shape = "box"
size = [6, 6]
[[species]]
name = {name}
count = 9
radius = 0.5
[[contacts]]
between = [{name}, {name}]
restitution = 0.9
friction = 0.1
[[contacts]]
between = [{name}, "{wall}"]
restitution = 0.9
friction = 0.1
[run]
equilibrate = 10
max_events = 100
"""


@pytest.mark.parametrize("width", [20, 40, 47, 60, 200])
def test_tables_keep_their_numbers_whole(width: int) -> None:
    table = Table(pad_edge=False)
    table.add_column("law")
    for head in ("angle after the wall, degrees", "speed"):
        table.add_column(head, justify="right")
    table.add_column("parameters")
    table.add_row("contact", "123.456789", "-0.0976", "restitution 0.742 ± 0.012, friction 0.2")
    file = io.StringIO()
    console = TextConsole(file=file, width=width)
    console.print(table)
    text = file.getvalue()
    words = text.replace("│", " ").replace("┃", " ").split()
    for number in ("123.456789", "-0.0976", "0.742", "0.012,", "0.2"):
        assert number in words
    assert "…" not in text
    assert console.width == width
    assert max(map(len, text.splitlines())) <= max(width, 60)


@pytest.mark.parametrize(
    "words", ["design --laws contact,maw", "orbit sinai:radius=0.3 --bounces 300 --lyapunov --seed 1", "datasets"]
)
def test_narrow_output_has_the_same_words(
    words: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    numbers = []
    for width in ("200", "40"):
        monkeypatch.setenv("COLUMNS", width)
        code, out, _err = command(capsys, *words.split())
        assert code == 0
        numbers.append(sorted(re.findall(r"-?\d+\.\d+", out)))
    assert numbers[0] == numbers[1]
    assert numbers[0]


def test_sentences_wrap_where_the_width_is_known(monkeypatch: pytest.MonkeyPatch) -> None:
    text = "words " * 30
    shown = {}
    for columns in ("40", None):
        monkeypatch.delenv("COLUMNS", raising=False)
        if columns:
            monkeypatch.setenv("COLUMNS", columns)
        file = io.StringIO()
        TextConsole(file=file).print(text, soft_wrap=True)
        shown[columns] = file.getvalue().splitlines()
    assert len(shown["40"]) > 4
    assert max(map(len, shown["40"])) <= 40
    assert len(shown[None]) == 1


def clean(text: str) -> str:
    assert not STEERS.search(text), ascii(text)
    return text


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("plain, with\ttabs\nand lines, wëiß, 球, 👩‍🚀", None),
        (EVIL, ESCAPED),
        ("\x00\x7f\x80\u2028\u2066\u200f", r"\x00\x7f\x80\u2028\u2066\u200f"),
        (os.fsdecode(b"a\xff.csv"), r"a\udcff.csv"),
    ],
)
def test_control_characters_are_written_out(text: str, shown: str | None) -> None:
    assert escape_controls(text) == (text if shown is None else shown)


def test_names_in_a_scene(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "scene.toml"
    file.write_text(SCENE.format(name=json.dumps(EVIL), most=3))
    code, out, err = command(capsys, "simulate", str(file))
    assert code == 0
    assert ESCAPED.replace(r"\x07", "") in clean(out).replace(r"\x07", "")
    clean(err)
    file.write_text(SCENE.format(name=json.dumps(EVIL), most=3).replace("[5, 0]", "[1, 0]"))
    clean(" ".join(fails(capsys, "scene", "check", str(file))))


def test_names_in_a_gas(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "gas.toml"
    file.write_text(GAS.format(name=json.dumps(EVIL), wall="wall"))
    code, out, err = command(capsys, "gas", str(file))
    assert code == 0
    assert "red[/b]" in clean(out)
    clean(err)
    file.write_text(GAS.format(name=json.dumps(EVIL), wall="floor"))
    clean(" ".join(fails(capsys, "scene", "check", str(file))))


def test_names_of_columns_and_laws(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    table, strange = tmp_path / "shots.csv", "\u202e\x9b2J[/b]"  # (with a character below the space it is no text file)
    table.write_text(f"speed,incidence_deg,{strange}\n1,45,{strange}\n{strange},30,{strange}\n", encoding="utf-8")
    code, out, err = command(capsys, "predict", str(table), "--out", str(tmp_path / "out.csv"))
    assert code == 0
    clean(out)
    assert r"\x9b2J[/b]" in clean(err)
    table.write_text(f"speed{strange},incidence_deg\n1,45\n", encoding="utf-8")
    assert "2J[/b]" in clean(" ".join(fails(capsys, "predict", str(table))))
    law = tmp_path / "law.py"
    law.write_text(
        f"from carom import Card, wall_law\n"
        f"law = wall_law(Card({EVIL!r}, {EVIL!r}, (), '', '', ''), lambda v, w, n, a, kappa, e, mu, beta: (v, w))\n"
    )
    code, out, err = command(capsys, "compare", "--laws", f"{law}:law", "--laws", "mirror")
    assert code == 0
    assert "red[/b]" in clean(out)


def test_names_of_files(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / f"{EVIL.replace('/', '')}.toml"
    assert r"\x1b[31mred" in clean(" ".join(fails(capsys, "scene", "check", str(file))))
    file.write_text(SCENE.format(name='"a"', most=1))
    code, out, _err = command(capsys, "scene", "check", str(file))
    assert code == 0
    assert r"\x1b[31mred" in clean(out)
    code, _out, err = command(capsys, "simulate", str(file), "--save-events", str(tmp_path / "\x1b[2J.csv"))
    assert code == 0
    assert r"written: " in clean(err)


def test_styles_reach_the_terminal_and_names_do_not(capsys: pytest.CaptureFixture[str]) -> None:
    screen = io.StringIO()
    console = TextConsole(file=screen, force_terminal=True, color_system="standard", width=100)
    table = Table(title=EVIL)
    table.add_column(EVIL, no_wrap=True, min_width=40)
    table.add_row(Text.assemble((EVIL, "bold red")))
    table.add_row(EVIL)
    console.print(table)
    console.print(Text(EVIL, "green"), end="\r")
    shown = screen.getvalue()
    assert "\x1b[1;31m" in shown
    assert shown.endswith("\r")
    styles = re.compile("\x1b" + r"\[(0|1|3|1;31|32)m")  # (of the title, the head, the bold row and the green line)
    clean(styles.sub("", shown).removesuffix("\r"))
    assert shown.count(r"\x1b[31mred[/b]\u202e\x9b2J") == 5


def test_no_text_is_read_as_markup() -> None:
    """Square brackets are text on carom's consoles; nothing prints past them."""
    source = Path(carom.cli.__file__).parent
    markup = re.compile(
        r"\[/?(bold|dim|red|green|yellow|progress\.\w+)?( \w+)*\](?=[^\n]*\[/\])|rich\.markup|\bConsole\("
    )
    found = {file.name: markup.findall(file.read_text(encoding="utf-8")) for file in source.glob("*.py")}
    assert not {name: hits for name, hits in found.items() if hits}


# --- output that nobody takes ---------------------------------------------------------------------------------------

VERBS = [
    ["--help"], ["--version"], ["compare"], ["compare", "--json"], ["laws"], ["laws", "maw", "--json"], ["datasets"],
    ["datasets", "kharaz2001"], ["scene", "new"], ["orbit", "circle", "--bounces", "5"],
]  # fmt: skip
FULL = "carom: standard output: expected room to write, got: No space left on device; free some space, or choose another place"
CLOSED = "carom: standard output: expected a place to write to, got: a closed one; choose another one"


@pytest.fixture
def files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A scene, a gas and a table."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scene.toml").write_text(SCENE.format(name='"a"', most=3))
    (tmp_path / "gas.toml").write_text(GAS.format(name='"a"', wall="wall"))
    (tmp_path / "shots.csv").write_text("speed,incidence_deg\n1,45\n2,30\n")
    return tmp_path


FILES = [
    ["scene", "check", "scene.toml"], ["simulate", "scene.toml"], ["simulate", "scene.toml", "--json", "--save", "run.parquet"],
    ["predict", "shots.csv"], ["gas", "gas.toml", "--measures", "measures.json"], ["gas", "gas.toml", "--json"],
]  # fmt: skip


def ends(
    words: list[str], stream: Any, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> list[str]:
    """Run carom with another standard output; it must end with code 2. What it says on standard error but notes."""
    monkeypatch.setattr(sys, "stdout", stream)
    monkeypatch.setattr(sys, "argv", ["carom", *words])
    with pytest.raises(SystemExit) as end:
        carom.cli.main()
    assert end.value.code == 2
    return [line for line in capsys.readouterr().err.splitlines() if line.startswith("carom:")]


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs /dev/full")
@pytest.mark.parametrize("words", [*VERBS, *FILES], ids=" ".join)
def test_a_full_standard_output(
    words: list[str], files: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    with Path("/dev/full").open("w") as full:
        assert ends(words, full, capsys, monkeypatch) == [FULL]
    assert all((files / name).stat().st_size for name in words if name.endswith((".parquet", "measures.json")))


@pytest.mark.parametrize("words", [*VERBS, *FILES], ids=" ".join)
def test_a_closed_standard_output(
    words: list[str], files: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    assert ends(words, None, capsys, monkeypatch) == [CLOSED]
    assert all((files / name).stat().st_size for name in words if name.endswith((".parquet", "measures.json")))


def test_what_prints_nothing_needs_no_standard_output(
    files: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "stdout", None)
    monkeypatch.setattr(sys, "argv", ["carom", "simulate", "scene.toml", "--quiet", "--save-events", "out.csv"])
    with pytest.raises(SystemExit) as end:
        carom.cli.main()
    assert end.value.code == 0
    assert (files / "out.csv").stat().st_size
    assert capsys.readouterr().err == ""


@pytest.mark.skipif(os.name != "posix" or not Path("/dev/full").exists(), reason="needs a shell and /dev/full")
@pytest.mark.slow
def test_streams_of_a_shell(files: Path) -> None:
    """As a shell has them: full, closed, a reader that is gone, and messages that nobody takes."""
    carom_ = f"{sys.executable} -m carom"
    script = f"""
        {carom_} laws >/dev/full; echo $? >&2
        {carom_} laws >&-; echo $? >&2
        {carom_} simulate scene.toml --json --save-events all.csv | true; echo ${{PIPESTATUS[0]}} >&2
        {carom_} laws --frob 2>/dev/full; echo $? >&2
        {carom_} simulate scene.toml --save-events more.csv >/dev/null 2>&-; echo $? >&2
    """
    done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=True, timeout=120)
    written = "written: all.csv"
    assert done.stderr.splitlines() == [FULL, "2", CLOSED, "2", written, "0", "2", "0"]
    assert (files / "all.csv").read_text() == (files / "more.csv").read_text()
