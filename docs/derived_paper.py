"""The equations of the paper with their verdicts, for the pages that show them: derived once in a build, not once a page."""

from __future__ import annotations

import fcntl
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
    if not shared:
        return _derived()
    file = Path(shared) / "paper.json"
    with open(Path(shared) / "paper.lock", "w") as lock:  # one page derives them, another one waits
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not file.exists():
            write_text(file, json.dumps(_derived()))
        found: list[dict[str, Any]] = json.loads(file.read_text(encoding="utf-8"))
        return found


def _derived() -> list[dict[str, Any]]:
    return [
        {"section": section, **paper.as_record(entry, paper.judge(entry))}
        for _, build, _, section in paper.STAGES
        for entry in build()
    ]
