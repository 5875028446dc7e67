"""How pages look, by rule and not at each place: columns of numbers, units once, numbers of equations and pictures, theorems.

- A table of many columns is set small. A column of numbers is set to the right; a unit that all of them have stands in its head
  instead.
- An equation has a number with an anchor: its own (``\\tag{28}``: ``#eq-28``), otherwise E1, E2, ... on its page (``#eq-E1``).
- A picture that has a text for those who do not see it has that as its numbered caption.
- A paragraph that begins with **Theorem** stands in a box.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.transforms.post_transforms import SphinxPostTransform

UNITS = "mm|cm|m|km|ns|[µu]s|ms|s|min|h|%|°|deg|m/s|mm/s|rad/s|kg|g|N|J|kB|MB|GB|bytes"
NUMBER = re.compile(
    rf"[<>≤≥~≈]?\s*[-−+±]?[\d.,]*\d[\d.,]*(?:e[-−+]?\d+)?(?:\s*±\s*[\d.,]+)?(?:\(\d+\))?(?:(?P<space>\s*)(?P<unit>{UNITS}))?"
)
BROAD = 660.0, 1.25  # pixels, and times the height: on a phone such a picture scrolls in its frame
MANY = 7  # columns: such a table is set small
NONE = {"", "-", "–", "—", "inf", "∞", "none", "nan"}
TAG = re.compile(r"[ \t]*\\tag\{([^}]+)\}")


class Looks(SphinxPostTransform):
    """Numbers, units, captions and boxes of a page."""

    default_priority = 900  # after the outputs of cells were chosen
    formats = ("html",)

    def run(self, **_: Any) -> None:
        """Set them."""
        for table in self.document.findall(nodes.table):
            align(table)
        number_equations(self.document)
        number_pictures(self.document, str(self.env.srcdir))
        for paragraph in list(self.document.findall(nodes.paragraph)):
            box_theorems(paragraph)


# --- tables ---------------------------------------------------------------------------------------------------------
def align(table: nodes.table) -> None:
    """Set columns of numbers to the right, and a unit that all have in the head."""
    body = [list(row.children) for part in table.findall(nodes.tbody) for row in part.children]
    head = [list(row.children) for part in table.findall(nodes.thead) for row in part.children]
    if not body or len(lengths := {len(row) for row in (*head, *body)}) != 1:
        return
    if max(lengths) >= MANY:
        table["classes"].append("many")
    for k in range(*lengths):
        cells = [row[k] for row in body]
        said = [NUMBER.fullmatch(cell.astext().strip()) for cell in cells]
        numbers = [found for found in said if found]
        if not numbers or any(
            not found and cell.astext().strip() not in NONE for cell, found in zip(cells, said, strict=True)
        ):
            continue
        for cell in (row[k] for row in (*head, *body)):
            cell["classes"] = [name for name in cell["classes"] if not name.startswith("text-")] + ["number"]
        units = {found["unit"] for found in numbers}
        texts = [list(cell.findall(nodes.Text)) for cell in cells]
        if (
            len(numbers) > 1
            and len(head) == 1
            and units != {None}
            and len(units) == 1
            and all(len(one) <= 1 for one in texts)
        ):
            unit = units.pop()
            for found, (text,) in ((f, t) for f, t in zip(said, texts, strict=True) if f and t):
                text.parent.replace(text, nodes.Text(found.string[: found.start("space")]))
            (paragraph,) = list(head[0][k].findall(nodes.paragraph))[:1] or [head[0][k]]
            paragraph += nodes.Text(f", {unit}" if paragraph.astext() else unit)


# --- equations ------------------------------------------------------------------------------------------------------
def number_equations(document: nodes.document) -> None:
    """Give each equation on display a number and an anchor; equations that cells print have none."""
    count = 0
    for block in document.findall(nodes.math_block):
        if _in_cell(block):
            continue
        tags = TAG.findall(block.astext())
        if len(tags) == 1:
            text = TAG.sub("", block.astext())
            block.rawsource, block.children = text, []
            block.append(nodes.Text(text))
        elif tags:  # (several lines with a number each)
            block["ids"] += [f"eq-{tag}" for tag in tags]
            continue
        else:
            count += 1
            tags = [f"E{count}"]
        block["number"], block["ids"] = tags[0], [*block["ids"], f"eq-{tags[0]}"]


def _in_cell(node: nodes.Node) -> bool:
    while node is not None:
        if isinstance(node, nodes.Element) and "cell_output" in node.get("classes", ()):
            return True
        node = node.parent
    return False


# --- pictures -------------------------------------------------------------------------------------------------------
def number_pictures(document: nodes.document, folder: str) -> None:
    """Put each picture into a figure, with a numbered caption if it has a text; a copy for other pages or windows shares it."""
    count, last, figure = 0, "", nodes.figure()
    for image in list(document.findall(nodes.image)):
        if isinstance(image.parent, (nodes.figure, nodes.reference, nodes.TextElement)):
            continue
        text = image.get("alt", "")
        if text and text == last:  # (the same for dark pages, or for phones)
            figure["classes"] += ["two"]
            image["classes"] += [name for name in figure[0]["classes"] if name == "broad"]
            image.parent.remove(image)
            figure.insert(1, image)
            continue
        count, last = count + bool(text), text
        figure = nodes.figure(ids=[f"figure-{count}"] if text else [], classes=["picture"])
        if not {"wide", "narrow"} & set(image["classes"]) and is_broad(Path(folder, image["uri"].lstrip("/"))):
            image["classes"].append("broad")
        image.parent.replace(image, figure)
        figure += [image]
        if text:
            number = nodes.inline("", f"Figure {count}", classes=["caption-number"])
            figure += [nodes.caption("", "", number, nodes.Text(f". {text}"))]


def is_broad(file: Path) -> bool:
    """Return whether a picture is so broad that a phone would show its letters too small: SVG or PNG, other files are not."""
    if not file.is_file():
        return False
    head = file.read_bytes()[:2000]
    if head.startswith(b"\x89PNG"):
        width, height = (float(int.from_bytes(head[k : k + 4], "big")) for k in (16, 20))
    elif found := re.search(rb'viewBox="[\d.-]+ [\d.-]+ ([\d.]+) ([\d.]+)"', head):
        width, height = (float(size) * 4 / 3 for size in found.groups())  # (points)
    else:
        return False
    return width > BROAD[0] and width > BROAD[1] * height


# --- theorems -------------------------------------------------------------------------------------------------------
def box_theorems(paragraph: nodes.paragraph) -> None:
    """Put a paragraph, or what of it begins with the bold word Theorem, into a box."""
    places = [
        k
        for k, child in enumerate(paragraph.children)
        if isinstance(child, nodes.strong) and child.astext() in ("Theorem", "Lemma")
    ]
    if not places or not isinstance(paragraph.parent, (nodes.section, nodes.document)):
        return
    children = list(paragraph.children)
    pieces = [children[a:b] for a, b in zip([0, *places], [*places, None], strict=True)]
    made: list[nodes.Node] = []
    for piece in pieces:
        if "".join(child.astext() for child in piece).strip():
            part = nodes.paragraph("", "", *piece)
            theorem = isinstance(piece[0], nodes.strong) and piece[0].astext() in ("Theorem", "Lemma")
            made.append(nodes.container("", part, classes=["theorem"]) if theorem else part)
    paragraph.replace_self(made)


def setup(app: Sphinx) -> dict[str, bool]:
    app.add_post_transform(Looks)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
