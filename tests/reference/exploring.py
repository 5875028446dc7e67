"""How much a test tries: in the suite enough to see a fault, and all that it can with CAROM_EXPLORE=1 (``make explore``)."""

from __future__ import annotations

import os
from typing import TypeVar

__all__ = ["EXPLORE", "tried"]

EXPLORE = bool(os.environ.get("CAROM_EXPLORE"))
"""Whether property tests look for new examples and counting tests draw all their cases."""
Cases = TypeVar("Cases")


def tried(few: Cases, many: Cases) -> Cases:
    """Return what a test tries in the suite, or what it tries when exploring: counts, lists of cases."""
    return many if EXPLORE else few
