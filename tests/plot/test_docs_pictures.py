"""Pictures of the documentation on a dark page: the style sheet inverts them, which needs pictures that are drawn on white."""

from __future__ import annotations

import re
from pathlib import Path

import dark_pictures
from matplotlib import rcParams
from page_looks import is_broad

from carom import plot
from carom.plot.style import style

DOCS = Path(__file__).parents[2] / "docs"


def test_pictures_are_inverted_on_dark_pages_and_screenshots_are_not() -> None:
    """White boxes stood on the dark page."""
    sheet = (DOCS / "_static" / "carom.css").read_text(encoding="utf-8")
    rules = [line for line in sheet.splitlines() if "invert(1) hue-rotate(180deg)" in line]
    assert len(rules) == 2
    assert 'body[data-theme="dark"]' in rules[0]
    assert 'body:not([data-theme="light"])' in rules[1]  # where the system chooses
    for rule in rules:
        assert "mix-blend-mode: screen" in rule  # what was white lets the page through
        assert ':not([src*="explorer"])' in rule


def test_figures_are_drawn_on_white_in_one_font() -> None:
    with style():
        assert rcParams["figure.facecolor"] == "white"
        assert rcParams["axes.facecolor"] == "white"
        assert rcParams["font.family"] == ["STIXGeneral"]
        assert rcParams["mathtext.fontset"] == "stix"
    figure = plot.compare()
    texts = [text for axes in figure.axes for text in [*axes.texts, axes.xaxis.label, axes.yaxis.label]]
    assert {text.get_fontfamily()[0] for text in texts} == {"STIXGeneral"}


def test_the_readme_has_dark_copies_of_its_drawings() -> None:
    """On a dark page of GitHub they were white boxes; `python docs/dark_pictures.py` writes the copies."""
    readme = (DOCS.parent / "README.md").read_text(encoding="utf-8")
    assert not re.findall(r"!\[[^\]]*\]\(docs/images/\w+\.svg\)", readme)
    assert dark_pictures.pictures()
    for picture in dark_pictures.pictures():
        assert f'srcset="docs/images/dark/{picture.name}"' in readme
        copy = (DOCS / "images" / "dark" / picture.name).read_text(encoding="utf-8")
        assert copy == dark_pictures.dark(picture.read_text(encoding="utf-8"))
        figure = copy.split('<g id="patch_1">', 1)[1].split("</g>", 1)[0]
        assert "fill: none" in figure  # the page shows through


def test_all_drawings_are_in_the_one_font() -> None:
    for picture in (DOCS / "images").glob("*.svg"):
        fonts = set(re.findall(r'id="([A-Za-z]+)-[A-Za-z-]*[0-9a-f]+"', picture.read_text(encoding="utf-8")))
        assert not {font for font in fonts if font.startswith("DejaVu")}, picture.name


def test_broad_pictures_are_known_by_their_files() -> None:
    files = ("cushions.svg", "explorer.png", "orbit.svg", "which_law_narrow.svg", "none.png")
    assert [name for name in files if is_broad(DOCS / "images" / name)] == ["cushions.svg", "explorer.png"]
