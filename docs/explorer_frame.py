"""The explorer in the pages: ``{explorer} NAME`` shows a preset in a frame, a picture where scripts are off."""

from __future__ import annotations

import posixpath
import shutil
from pathlib import Path

from docutils import nodes
from docutils.parsers.rst import Directive
from sphinx.application import Sphinx

import carom
from carom.explorer.page import presets

PAGE = "_static/explorer.html"


class Explorer(Directive):
    """A frame with the explorer, loaded when it is scrolled to."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        known = {preset["name"]: preset["title"] for preset in presets()}
        name = self.arguments[0]
        if name not in known:
            raise self.error(f"explorer: expected one of {', '.join(known)}, got {name!r}")
        docname = self.state.document.settings.env.docname
        up = posixpath.relpath(".", posixpath.dirname(docname) or ".")
        title = f"The explorer: {known[name]}"
        dark = f'<source media="(prefers-color-scheme: dark)" srcset="{up}/_static/explorer-dark.png">'
        picture = f'<picture>{dark}<img src="{up}/_static/explorer.png" alt="{title}"></picture>'
        frame = f'<iframe class="explorer" loading="lazy" src="{up}/{PAGE}#preset={name}" title="{title}"></iframe>'
        # (without scripts the frame would be empty)
        text = f"{frame}<noscript><style>iframe.explorer {{ display: none }}</style>{picture}</noscript>"
        return [nodes.raw("", text, format="html")]


def _write_page(app: Sphinx, error: Exception | None) -> None:
    if error is None and app.builder.format == "html":
        static = Path(app.outdir) / "_static"
        carom.explore().save(static / "explorer.html")
        images = Path(__file__).parent / "images"
        shutil.copy(images / "explorer.png", static)
        shutil.copy(images / "dark" / "explorer.png", static / "explorer-dark.png")


def setup(app: Sphinx) -> dict[str, bool]:
    app.add_directive("explorer", Explorer)
    app.connect("build-finished", _write_page)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
