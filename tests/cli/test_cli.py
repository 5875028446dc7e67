"""The command: tables that nothing is cut from, JSON alone on standard output, one line a fault, nothing half-written."""

from __future__ import annotations

import json
import math
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from reference.bad_options import BAD
from reference.commands import fails
from typer.testing import CliRunner

import carom
from carom.cli import app

runner = CliRunner()

# what compare asks for a ball on the floor at an upright wall: "contact" leaves the floor out
ON_FLOOR = [name for name, law in carom.LAWS.items() if not (law.ignores_floor or law.variant_of or law.on_table)]


def test_json_is_the_librarys_answer_in_full() -> None:
    result = runner.invoke(app, ["compare", "--json", "--angle", "30", "--spin-z", "-7.5", "--friction", "0.2"])
    assert result.exit_code == 0
    expected = carom.compare(carom.incoming(angle_deg=30.0, spin_z=-7.5, friction=0.2)).as_dict()
    assert json.loads(result.stdout) == expected
    assert expected["settings"]["wall"]["friction"] == 0.2
    assert expected["settings"]["floor"]["friction"] == "inf"


def test_every_option_reaches_the_library() -> None:
    settings = {
        "speed": 2.0, "angle_deg": 10.0, "spin_z": 1.0, "spin_x": 2.0, "spin_y": 3.0, "vertical_speed": 0.1, "height": 0.01,
        "inertia": 0.5, "radius": 0.03, "mass": 0.2, "restitution": 0.9, "friction": 0.3, "tangential_restitution": -0.5,
        "floor_restitution": 0.4, "floor_friction": 0.25, "gravity": 1.6, "contact_height": 1.2, "floor_contact": "after",
    }  # fmt: skip
    options = [
        part
        for key, value in settings.items()
        for part in (f"--{key.removesuffix('_deg').replace('_', '-')}", str(value))
    ]
    result = runner.invoke(app, ["compare", "--json", *options])
    assert json.loads(result.stdout) == carom.compare(carom.incoming(**settings)).as_dict()  # type: ignore[arg-type]
    sliding = runner.invoke(app, ["compare", "--json", "--sliding"])
    assert json.loads(sliding.stdout)["incident"]["spin"] == [0.0, 0.0, 0.0]


def test_only_the_laws_asked_for() -> None:
    result = runner.invoke(app, ["compare", "--json", "--laws", "two-step", "--laws", "mirror"])
    assert [row["law"] for row in json.loads(result.stdout)["laws"]] == ["two-step", "mirror"]


def test_piped_at_80_columns_nothing_is_cut(carom_command: Any) -> None:
    result = carom_command("compare", COLUMNS="80")
    assert result.returncode == 0
    assert result.stderr == ""
    lines = result.stdout.splitlines()
    assert max(map(len, lines)) <= 80
    assert "\x1b" not in result.stdout
    assert "…" not in result.stdout
    row = next(line for line in lines if line.strip().startswith("two-step"))
    assert row.split() == [
        "two-step",
        "35.54°",
        "51.52°",
        "0.447,",
        "0.563",
        "2.08",
        "35.8",
        "59.0%",
        "0.202",
        "1.32",
        "✓",
    ]
    row = next(line for line in lines if line.strip().startswith("conventional"))
    assert row.split() == ["conventional", "29.05°", "29.05°", "0.707,", "0.393", "–", "–", "100.0%", "1", "1", "✗"]
    for law in ON_FLOOR:
        assert any(line.startswith((f"✓ {law}:", f"✗ {law}:")) for line in lines)


def test_large_numbers_are_not_cut_either(carom_command: Any) -> None:
    result = carom_command("compare", "--speed", "123456789", "--spin-z", "-1234567", COLUMNS="80")
    assert "5.52e+07, 6.95e+07" in result.stdout or "e+07" in result.stdout
    assert "conventional" in result.stdout
    assert result.stdout.count("✗") + result.stdout.count("✓") == 2 * len(ON_FLOOR)


def test_wide_tables_have_the_spin(carom_command: Any) -> None:
    narrow, wide = (carom_command("compare", COLUMNS=columns).stdout for columns in ("80", "140"))
    assert "final spin" in wide
    assert "final spin" not in narrow
    assert "-21.4, 17, 19.2" in wide


def test_an_output_without_ticks() -> None:
    result = subprocess.run(
        [sys.executable, "-m", "carom", "compare"], capture_output=True, text=True, check=False, encoding="utf-8",
        env={**os.environ, "PYTHONIOENCODING": "ascii", "PYTHONUTF8": "0", "COLUMNS": "80"},
    )  # fmt: skip
    assert result.returncode == 0
    assert "yes two-step:" in result.stdout
    assert "no conventional:" in result.stdout


def test_a_process_fails_with_code_2_and_only_standard_error(carom_command: Any) -> None:
    result = carom_command("compare", "--angle", "95", "--radius", "0", "--laws", "twostep", "--json")
    assert result.returncode == 2
    assert result.stdout == ""
    lines = result.stderr.splitlines()
    assert len(lines) == 3
    assert all(line.startswith("carom: ") for line in lines)
    assert "did you mean 'two-step'" in lines[0]
    assert "radius" in lines[1]
    assert "angle" in lines[2]


@pytest.mark.parametrize(("given", "where"), BAD)
def test_the_command_refuses_what_the_library_refuses(
    given: dict[str, object], where: str, capsys: pytest.CaptureFixture[str]
) -> None:
    ((key, value),) = given.items()
    with pytest.raises(carom.CaromError) as caught:
        carom.incoming(**given)  # type: ignore[arg-type]
    option = f"--{key.removesuffix('_deg').replace('_', '-')}"
    assert where in caught.value.faults[0]
    assert fails(capsys, "compare", f"{option}={value}") == [
        f"carom: {option}: {caught.value.faults[0].removeprefix(where + ' ')}"
    ]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["compare", "--sped", "3"], "--sped"),
        (["compare", "--speed", "fast"], "--speed"),
        (["compare", "--speed"], "--speed"),
        (["comparee"], "comparee"),
        (["laws", "convential"], "did you mean 'conventional'"),
    ],
)
def test_usage_errors_are_one_line(arguments: list[str], said: str, capsys: pytest.CaptureFixture[str]) -> None:
    lines = fails(capsys, *arguments)
    assert len(lines) == 1
    assert lines[0].startswith("carom: ")
    assert said in lines[0]


def test_pictures_that_cannot_be_written(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name, said in (
        ("a.jpg", "'.jpg'"),
        ("a", "got none"),
        ("no/a.svg", "make it first"),
        ("a.pvg", "did you mean '."),
    ):
        (line,) = fails(capsys, "compare", "--plot", str(tmp_path / name))
        assert said in line
    (tmp_path / "folder.svg").mkdir()
    (line,) = fails(capsys, "compare", "--plot", str(tmp_path / "folder.svg"))
    assert "got a folder" in line
    # a bad ball and a good path: nothing is written
    fails(capsys, "compare", "--plot", str(tmp_path / "a.svg"), "--speed", "nan")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["folder.svg"]


def test_picture_and_json_keep_apart(tmp_path: Path, carom_command: Any) -> None:
    result = carom_command("compare", "--json", "--plot", str(tmp_path / "a.svg"))
    assert result.returncode == 0
    assert json.loads(result.stdout)["incident"]["angle_deg"] == pytest.approx(45)
    assert "a.svg" in result.stderr
    assert (tmp_path / "a.svg").read_text(encoding="utf-8").startswith("<?xml")


@pytest.mark.parametrize(
    ("words", "name"),
    [
        (("compare", "--plot"), "a[b].svg"),
        (("orbit", "circle", "--bounces", "3", "--position", "0,0", "--velocity", "1,0", "--plot"), "a[b].svg"),
        (("predict", "in.csv", "--law", "mirror", "--out"), "a[b].csv"),
        (("datasets", "kharaz2001", "--out"), "a[b].csv"),
        (("design", "--laws", "contact,sliding", "--plot"), "a[b].svg"),
        (("scene", "new"), "a[b].toml"),
        (("derive", "--equation", "1", "--json"), "a[b].json"),
    ],
    ids=lambda words: words[0] if isinstance(words, tuple) else "",
)
@pytest.mark.slow(keep=1)
def test_every_verb_says_alike_what_it_wrote(
    words: tuple[str, ...], name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "in.csv").write_text("velocity_x,velocity_y\n-1,1\n")
    result = runner.invoke(app, [*words, name])
    assert result.exit_code == 0
    assert [line for line in result.stderr.splitlines() if name in line] == [f"written: {name}"]
    assert (tmp_path / name).stat().st_size > 0


def test_nothing_heavy_is_imported() -> None:
    code = (
        "import sys; from carom.cli import main; sys.argv = ['carom', 'compare']\n"
        "try: main()\n"
        "except SystemExit: pass\n"
        "print([m for m in ('numba', 'matplotlib', 'sympy', 'scipy', 'pyarrow') if m in sys.modules], file=sys.stderr)"
    )
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert result.stderr.strip() == "[]"


def test_laws(carom_command: Any) -> None:
    told = json.loads(runner.invoke(app, ["laws", "--json"]).stdout)["laws"]
    assert [card["name"] for card in told] == list(carom.CARDS)
    table = carom_command("laws", COLUMNS="80").stdout
    assert max(map(len, table.splitlines())) <= 80
    assert all(name in table for name in carom.CARDS)
    assert len(table.splitlines()) < 6 * len(carom.CARDS)  # no column is squeezed so that a law takes a screen


@pytest.mark.parametrize("name", list(carom.CARDS))
def test_one_laws_card_is_whole(name: str) -> None:
    card = carom.CARDS[name]
    words = " ".join(runner.invoke(app, ["laws", name], env={"COLUMNS": "80"}).stdout.split())
    for part in (card.name, card.summary, card.valid, card.equations, card.citation, card.doi, *card.assumptions):
        assert " ".join(part.split()) in words
    told = json.loads(runner.invoke(app, ["laws", name, "--json"]).stdout)
    assert told["assumptions"] == list(card.assumptions)


def test_infinity_is_told_as_text() -> None:
    result = runner.invoke(app, ["compare", "--json", "--gravity", "0"])
    two = next(row for row in json.loads(result.stdout)["laws"] if row["law"] == "two-step")
    assert two["flight"] == {"duration": "inf", "height": "inf", "distance": "inf"}
    assert not any(isinstance(x, float) and math.isinf(x) for x in two["flight"].values())


def test_the_command_starts_without_the_rooms_that_only_some_verbs_need() -> None:
    code = (
        "import sys; from carom.cli import main; sys.argv = ['carom', {words}]\n"
        "try: main()\n"
        "except SystemExit: pass\n"
        "print(*sys.modules, file=sys.stderr)"
    )
    for words in ("'fit', '--help'", "'gas', '--help'", "'--help'"):
        done = subprocess.run(
            [sys.executable, "-c", code.format(words=words)], capture_output=True, text=True, check=True
        )
        loaded = done.stderr.split()
        assert done.stdout.startswith("Usage: carom")
        assert {name.split(".")[1] for name in loaded if name.startswith("carom.")} <= {
            "cli", "public", "errors", "files", "formatting", "core",
        }  # fmt: skip
        assert not {"pydantic", "scipy"} & set(loaded)
        assert words == "'--help'" or not {"numpy", "rich", "carom.core"} & set(loaded)
