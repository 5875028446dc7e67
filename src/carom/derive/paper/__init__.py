"""The paper, equation by equation: the printed form, the derived form, and the verdict."""

from __future__ import annotations

from carom.derive.paper.ledger import Entry, EquationVerdict, judge
from carom.derive.paper.report import STAGES, as_record, as_tex, derive_paper, find_entries

__all__ = ["STAGES", "Entry", "EquationVerdict", "as_record", "as_tex", "derive_paper", "find_entries", "judge"]
