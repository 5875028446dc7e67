"""Each page says in its front matter how many pictures it must have (`pictures: 2`); the build warns where it has another number.

A figure that a cell no longer shows vanishes without an error of its own.
"""

from __future__ import annotations

from typing import Any

from sphinx.application import Sphinx
from sphinx.util import logging

LOG = logging.getLogger(__name__)


def check(app: Sphinx, page: str, _template: str, context: dict[str, Any], _doctree: Any) -> None:
    """Compare the pictures of a page with the number that it states."""
    if page not in app.env.found_docs or app.config.nb_execution_mode == "off":  # (an index of Sphinx's; words alone)
        return
    expected, found = int(app.env.metadata[page].get("pictures", 0)), context.get("body", "").count("<img ")
    if found != expected:
        LOG.warning(
            "expected %d pictures (the page's front matter, 'pictures'), got %d", expected, found, location=page
        )


def setup(app: Sphinx) -> dict[str, bool]:
    """Called by Sphinx."""
    app.connect("html-page-context", check)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
