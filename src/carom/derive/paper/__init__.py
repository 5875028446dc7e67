"""The paper, equation by equation: what it prints, what follows, and the verdict."""

from __future__ import annotations

from carom.derive.paper.ledger import Entry, Verdict, judge
from carom.derive.paper.report import STAGES, as_record, as_tex, derive_paper, find_entries

__all__ = ["STAGES", "Entry", "Verdict", "as_record", "as_tex", "derive_paper", "find_entries", "judge"]
