"""What an instant does to a mechanical system: the answer of `ImpulsiveMotion`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import sympy as sp

from carom.derive.linear import Expr, tidy

__all__ = ["Jump"]


@dataclass(frozen=True)
class Jump:
    """What the instant does.

    Attributes:
        after: each speed to its value just after, in the speeds just before.
        impulses: each constraint's name to its impulse (multiplier), in the sense of that constraint's velocity.
        energy_change: kinetic energy after less before.
        redundant: each superfluous constraint's name to the combination of others that says the same.
        free_impulses: symbols for the impulses that rigid bodies leave undetermined (one a redundant constraint).
        conditions: what must be true for the answer to stand: name to a relation, e.g. Coulomb's cone.
        notes: plain sentences on choices and limits.
    """

    after: dict[Expr, Expr]
    impulses: dict[str, Expr]
    energy_change: Expr
    redundant: dict[str, dict[str, Expr]] = field(default_factory=dict)
    free_impulses: tuple[Expr, ...] = ()
    conditions: dict[str, Expr] = field(default_factory=dict)
    notes: tuple[str, ...] = ()

    def subs(self, values: Mapping[Expr, Expr]) -> Jump:
        """The same jump with values put in."""

        def put(table: Mapping[Any, Expr]) -> dict[Any, Expr]:
            return {k: sp.sympify(v).subs(values) for k, v in table.items()}

        return replace(
            self,
            after=put(self.after),
            impulses=put(self.impulses),
            conditions=put(self.conditions),
            energy_change=tidy(sp.sympify(self.energy_change).subs(values)),
        )
