"""The equations of the paper with their verdicts, for the pages that show them: derived once in a build, not once a page."""

from __future__ import annotations

import json
import os
from functools import cache
from pathlib import Path
from typing import Any

from carom.derive import paper
from carom.files import write_text


@cache
def records() -> list[dict[str, Any]]:
    """Return every entry as ``carom derive --json`` prints it, with its ``section``, in the order of the derivation."""
    shared = os.environ.get("CAROM_DOCS_SHARED")  # a folder of this build (conf.py)
    file = Path(shared) / "paper.json" if shared else None
    if file is not None and file.exists():
        found: list[dict[str, Any]] = json.loads(file.read_text(encoding="utf-8"))
        return found
    found = [
        {"section": section, **paper.as_record(entry, paper.judge(entry))}
        for _, build, _, section in paper.STAGES
        for entry in build()
    ]
    if file is not None:
        write_text(file, json.dumps(found))
    return found
