"""Cells of commands: the magic ``%%sh`` runs them; pages show these cells, and files that cells write, without magic.

A command that fails stops the build; where a refusal is shown, ``%%sh refused`` expects exit code 2 of the last command.
"""

from __future__ import annotations

import re
import subprocess
import textwrap
from pathlib import Path
from typing import Any

from docutils import nodes
from IPython.core.magic import register_cell_magic
from sphinx.application import Sphinx

PROGRESS = re.compile(
    r"(?:[a-z ]+|\d+ gases): (?:.*, )?\d+ s$"
)  # where standard error is no terminal, every ten seconds
LANGUAGES = {".toml": "toml", ".py": "python"}  # in which "#" begins a comment


def sh(line: str, cell: str) -> None:
    """Print what commands print, long sentences in several lines."""
    done = subprocess.run(
        ["bash", "-euc", cell], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False
    )
    for text in done.stdout.splitlines():
        if PROGRESS.fullmatch(text):
            continue
        sentence = len(text) > 106 and "   " not in text.strip() and "──" not in text  # (no row of a table)
        print("\n".join(textwrap.wrap(text, 106)) if sentence else text)
    expected = 2 if line.strip() == "refused" else 0
    if done.returncode != expected:
        raise RuntimeError(f"exit code {done.returncode}, expected {expected}: {cell}")


def load_ipython_extension(_shell: Any) -> None:
    """``%load_ext shell_cells``."""
    register_cell_magic(sh)


def _without_magic(_app: Sphinx, document: nodes.document) -> None:
    for block in document.findall(nodes.literal_block):
        first, _, rest = block.rawsource.partition("\n")
        magic, _, word = first.partition(" ")
        if magic == "%%sh":
            language = "sh"
        elif magic == "%%writefile" and Path(word).suffix in LANGUAGES:
            language, rest = LANGUAGES[Path(word).suffix], f"# {word}\n{rest}"
        else:
            continue
        block["language"], block.rawsource, block.children = language, rest, [nodes.Text(rest)]


def setup(app: Sphinx) -> dict[str, bool]:
    app.connect("doctree-read", _without_magic)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
