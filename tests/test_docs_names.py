"""The pages of the docs name files and functions that exist: those included, imported in cells, listed and referred to."""

from __future__ import annotations

import ast
import importlib
import re
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[1]
PAGES = [page for page in sorted((ROOT / "docs").rglob("*.md")) if "_build" not in page.parts]
INCLUDED = re.compile(r"literalinclude\} (\S+)\n(?:(?!```).*\n)*?:pyobject: (\S+)")
MEMBERS = re.compile(r"automodule:: (carom[\w.]*)\n(?: +:.*\n)*? +:members: (\w.*)")
IMPORTED = re.compile(r"^from (carom[\w.]*) import ([\w, ]+)$", re.MULTILINE)
REFERRED = re.compile(r"\{py:\w+\}`~?(carom\.[\w.]+)`")


@cache
def defined(file: Path) -> set[str]:
    kinds = (ast.FunctionDef, ast.ClassDef)
    return {one.name for one in ast.walk(ast.parse(file.read_text(encoding="utf-8"))) if isinstance(one, kinds)}


def exists(dotted: str) -> bool:
    parts = dotted.split(".")
    for k in range(len(parts), 0, -1):
        try:
            found = importlib.import_module(".".join(parts[:k]))
        except ImportError:
            continue
        for name in parts[k:]:
            if not hasattr(found, name):
                return False
            found = getattr(found, name)
        return True
    return False


def test_included_functions_exist() -> None:
    found = [(page, *match) for page in PAGES for match in INCLUDED.findall(page.read_text(encoding="utf-8"))]
    assert len(found) > 10
    wrong = [
        (page.name, file, name) for page, file, name in found if name not in defined((page.parent / file).resolve())
    ]
    assert not wrong


def test_imported_and_referred_names_exist() -> None:
    names = set()
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        names |= {f"{module}.{one.split()[0]}" for module, some in IMPORTED.findall(text) for one in some.split(",")}
        names |= {f"{module}.{one.strip()}" for module, some in MEMBERS.findall(text) for one in some.split(",")}
        names |= set(REFERRED.findall(text))
    assert len(names) > 50
    assert not sorted(name for name in names if not exists(name))


def prose(page: Path) -> str:
    """A page without front matter, code, names in code, and addresses."""
    text = re.sub(r"\A---\n.*?^---$", "", page.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
    text = re.sub(r"^(`{3,}|:{3,}).*?^\1[ \t]*$", "", text, flags=re.DOTALL | re.MULTILINE)
    return re.sub(r"`[^`\n]+`|\]\([^)\s]*\)|\$[^$]+\$", "", text)


def test_the_docs_stay_short() -> None:
    """Counted as `find docs -name '*.md' | xargs cat | wc -w` does: with code, tables and front matter."""
    assert len(PAGES) <= 60
    assert sum(len(page.read_text(encoding="utf-8").split()) for page in PAGES) <= 70_000
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    assert len(readme.split()) <= 1_000
    assert len(readme.splitlines()) <= 130


def test_plain_words_where_a_newcomer_reads() -> None:
    """Nothing inanimate tells, wants or asks; a noun for "so many"."""
    words = re.compile(r"\b(?:told|tells|said|asked|asks|whoever|so many|wants|untold)\b", re.IGNORECASE)
    pages = [ROOT / "README.md", *(page for page in PAGES if page.parent.name in ("tutorials", "howto"))]
    found = {page.name: hits for page in pages if (hits := words.findall(prose(page)))}
    assert len(pages) > 20
    assert found == {}


def test_the_changelog_of_a_version_is_one_page() -> None:
    """What a user can do now, in at most 600 words for 0.2.0: who adds a bullet condenses another."""
    assert len((ROOT / "CHANGELOG.md").read_text(encoding="utf-8").split()) <= 600
