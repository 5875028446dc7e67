"""What stands in several files of the repository says the same: the version, the bounds of libraries, the sources of the paper."""

from __future__ import annotations

import re
import subprocess
import tomllib
from pathlib import Path

import pytest
from reference.exploring import tried
from reference.forking import Forked

import carom

ROOT = Path(__file__).parents[1]


def text(name: str) -> str:
    return (ROOT / name).read_text(encoding="utf-8")


def test_version_is_that_of_the_package_everywhere() -> None:
    project = tomllib.loads(text("pyproject.toml"))
    assert project["project"]["dynamic"] == ["version"]
    assert project["tool"]["hatch"]["version"]["path"] == "src/carom/__init__.py"
    for name in ("CITATION.cff", "recipe/recipe.yaml"):
        found = re.findall(r'^\s*version: "?(\d[\d.]*)"?$', text(name), re.MULTILINE)
        assert found == [carom.__version__], name


def test_the_table_of_extras_names_every_extra_and_those_outside_all() -> None:
    extras = tomllib.loads(text("pyproject.toml"))["project"]["optional-dependencies"]
    table = text("docs/project.md").split("| extra | for |", 1)[1].split("\n\n", 1)[0]
    rows = {
        name: use
        for names, use in re.findall(r"^\| (`.*?) \| (.*) \|$", table, re.MULTILINE)
        for name in re.findall(r"`(\w+)`", names)
    }
    assert set(rows) == set(extras) - {"wasm"}  # (builds the explorer's engine: contributing.md)
    (everything,) = extras["all"]
    in_all = set(re.findall(r"\w+", everything)) - {"carom"}
    assert {name for name, use in rows.items() if "not in `all`" in use} == set(rows) - in_all - {"all", "docs", "dev"}
    # `make docs` needs this extra and no other: pages run the optional parts, and the reference imports JAX's
    assert "carom[all,jax]" in extras["docs"]


def test_groups_have_what_the_extra_for_development_has() -> None:
    project = tomllib.loads(text("pyproject.toml"))
    groups, extra = project["dependency-groups"], project["project"]["optional-dependencies"]["dev"]
    assert sorted([*groups["test"], *groups["lint"]]) == sorted(one for one in extra if not one.startswith("carom"))


def test_the_recipe_has_all_licence_files() -> None:
    (listed,) = re.findall(r"  license_file:\n((?:    - .*\n)+)", text("recipe/recipe.yaml"))
    named = set(re.findall(r"- (\S+)", listed))
    assert named == {str(path.relative_to(ROOT)) for path in (ROOT / "LICENSE", *(ROOT / "src").rglob("LICENSE*"))}


def test_recipe_needs_what_the_package_needs() -> None:
    needed = tomllib.loads(text("pyproject.toml"))["project"]["dependencies"]
    run = text("recipe/recipe.yaml").split("  run:\n", 1)[1].split("\ntests:", 1)[0]
    found = [line.strip(" -").replace(" ", "") for line in run.splitlines() if "python" not in line and line.strip()]
    assert sorted(found) == sorted(needed)


@pytest.mark.parametrize("missing", ["doi", "year"])
def test_sources_of_the_paper(missing: str) -> None:
    entries = dict(re.findall(r"@\w+\{(\w+),(.*?)\n\}", text("paper.bib"), re.DOTALL))
    cited = set(re.findall(r"@([a-z]+\d{4}|paper)\b", text("paper.md")))
    assert cited == set(entries)
    without = {key for key, entry in entries.items() if f"{missing} =" not in entry}
    # (the paper that began carom bears none; Siconos' report has no DOI)
    assert without == ({"paper", "acary2019"} if missing == "doi" else {"paper"})


def test_pictures_of_the_paper_are_there() -> None:
    pictures = re.findall(r"\]\((docs/\S+)\)", text("paper.md"))
    assert len(pictures) == 2
    assert all((ROOT / name).is_file() for name in pictures)


def test_the_comparison_counts_the_laws() -> None:
    (found,) = re.findall(
        r"a law of impact out of (\d+), or your own \(`carom laws` has (\d+) cards", text("docs/comparison.md")
    )
    assert tuple(map(int, found)) == (len(carom.LAWS), len(carom.CARDS))


def readme_lines(*begin: str) -> list[str]:
    """The commands of the README that begin so, as words of a shell."""
    lines = re.findall(r"^\.venv/bin/(carom .*)$", text("README.md"), re.MULTILINE)
    return [line for line in lines if line.startswith(begin)]


def words_of(line: str, folder: Path) -> list[str]:
    """The words that a shell in a folder makes of a line."""
    said = subprocess.run(
        ["bash", "-c", f"carom() {{ printf '%s\\0' \"$@\"; }}; {line}"],
        cwd=folder,
        capture_output=True,
        text=True,
        check=True,
    )
    return said.stdout.split("\0")[:-1]


def test_commands_of_the_readme_on_films_and_aiming_run(tmp_path: Path, forked: Forked) -> None:
    pytest.importorskip("scipy")
    (tmp_path / "docs").symlink_to(ROOT / "docs")
    lines = readme_lines("carom tracks", "carom fit", "carom aim")
    assert len(lines) == 5
    for line in lines:
        laws = tried(" --laws two-step-paper,mirror", "")  # (fitted surfaces beside unknown spins take ten seconds)
        fewer = {"carom aim": " --starts 256", "carom fit": f"{laws} --no-profiles --bootstrap 0"}.get(line[:9], "")
        code, _out, err = forked(tmp_path, *words_of(line.partition("  #")[0] + fewer, tmp_path))
        assert code == 0, (line, err)
    assert {"films", "film.svg", "rebounds.csv", "shots.svg"} < {path.name for path in tmp_path.iterdir()}


def test_python_of_the_readme_runs(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.chdir(ROOT)
    names: dict[str, object] = {}
    for block in re.findall(r"^```python\n(.*?)^```", text("README.md"), re.MULTILINE | re.DOTALL):
        exec(block, names)
    assert capsys.readouterr().out.startswith("1.0121")
    assert names["derivatives"].final.position.shape[0] == 3  # type: ignore[attr-defined]


def test_a_part_of_ci_that_fails_fails_the_run(tmp_path: Path) -> None:
    """The docs failed for days while the run said that all is well: bash's errexit does not hold beside ``&&``."""
    text = (ROOT / ".ci" / "run").read_text(encoding="utf-8")
    parts = text[text.index('failed=""') : text.index("command -v npm")]
    script = (
        f"set -euo pipefail\nwork={tmp_path}\nsay() {{ :; }}\n{parts}\nbad() {{ false; }}\ngood() {{ true; }}\n"
        'begin good && begin bad && begin good\nfinish\necho "failed:$failed"'
    )
    done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "failed: bad"
