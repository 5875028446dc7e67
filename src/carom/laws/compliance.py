"""Shared by the laws of tangential compliance: the parameters that they read, and when they may not apply."""

from __future__ import annotations

from carom.core.jit.kernel import kernel
from carom.laws.law import ON_FLOOR
from carom.laws.rules import DRIVES_INTO_FLOOR, Case, Objections, Predicted, Rule, Said

__all__ = ["COMPLIANT_READS", "compliant_objections"]

COMPLIANT_READS = ("restitution", "friction", "stiffness_ratio", *ON_FLOOR)


@kernel
def _gives_back(c: Case, r: Predicted) -> Said:
    return c.beta != 0, 0.0, 0.0


compliant_objections = Objections(
    DRIVES_INTO_FLOOR,
    Rule(_gives_back, "it models the tangential rebound by springs and ignores this wall's tangential restitution"),
)
