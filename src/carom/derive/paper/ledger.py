"""Compare a printed equation with what follows from its derivation, and compute the verdict.

An `Entry` holds the relations as the paper prints them, and what has been derived (``facts``: values of the symbols in the printed
relations). `judge` substitutes the facts and examines the difference. Which equations are misprints is not stated anywhere.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

import sympy as sp

from carom.derive.linear import Expr, is_zero, tidy

__all__ = ["Branch", "Entry", "EquationVerdict", "Step", "judge"]


@dataclass(frozen=True)
class Step:
    """One line of a derivation: a sentence, and the resulting expression or relation (or None)."""

    text: str
    result: Any = None


@dataclass(frozen=True)
class Branch:
    """A case: its name, and the values of the symbols of the printed relations in it."""

    name: str
    facts: Mapping[Expr, Expr] = field(default_factory=dict)


@dataclass(frozen=True)
class Entry:
    """One equation or sentence of the paper.

    Attributes
    ----------
    id : str
        "1" to "41", a part as "41e", an unnumbered statement as "s4-1".
    title : str
        Its subject.
    printed : tuple
        Its relations, as printed.
    derived : tuple
        The derived relations, in the same symbols.
    branches : tuple of Branch
        Cases that the paper's wording admits; the printed relations should hold in each.
    cases : tuple of Branch
        Narrower cases, tried where a branch fails; the name states the condition.
    attitude : mapping
        Euler angles at which the paper uses the equation; a pole there makes it conditional.
    steps : tuple of Step
        The derivation.
    note : str
        Explanation; numbers in it are computed where the entry is made.
    because : str
        Sentence for the condition, where the branches' names do not suffice.
    """

    id: str
    title: str
    printed: tuple[Any, ...]
    derived: tuple[Any, ...]
    branches: tuple[Branch, ...]
    cases: tuple[Branch, ...] = ()
    attitude: Mapping[Expr, Expr] = field(default_factory=dict)
    steps: tuple[Step, ...] = ()
    note: str = ""
    because: str = ""


@dataclass(frozen=True)
class EquationVerdict:
    """Status ("holds", "conditional", "misprint"), and the cases in which the printed form holds and fails."""

    status: str
    true_in: tuple[str, ...]
    false_in: tuple[str, ...]
    sentence: str
    failed: tuple[tuple[Any, Mapping[Expr, Expr]], ...] = ()
    """The printed relations, with the facts of each case in which not all of them hold."""
    idle: str = ""
    """Printed identities, which say nothing."""

    @property
    def gap(self) -> str:
        """The relations that fail, and by how much; simplified when asked for, which takes longer than the verdict."""
        fails = [f"{shown(r)}: {difference(r, facts)}" for r, facts in self.failed if not true_of(r, facts)]
        return self.idle or "; ".join(fails)


def _value(expr: Expr, facts: Mapping[Expr, Expr]) -> Expr:
    return sp.sympify(expr).subs(list(facts.items()), simultaneous=True).doit()


def shown(relation: Any) -> str:
    """Return a relation as text."""
    if isinstance(relation, sp.Equality):
        return f"{relation.lhs} = {relation.rhs}"
    if isinstance(relation, sp.core.relational.Relational):
        return f"{relation.lhs} {relation.rel_op} {relation.rhs}"
    return str(relation)


def true_of(relation: Any, facts: Mapping[Expr, Expr]) -> bool:
    """Return whether a relation holds with the facts substituted."""
    return _true_of(relation, tuple(facts.items()))


@lru_cache(maxsize=4096)
def _true_of(relation: Any, facts: tuple[tuple[Expr, Expr], ...]) -> bool:
    left, right = (_value(side, dict(facts)) for side in (relation.lhs, relation.rhs))
    if isinstance(relation, sp.Equality):
        return bool(left == right or is_zero(left - right))
    if relation.rel_op == "!=":
        return not is_zero(left - right)
    margin = left - right if relation.rel_op in (">", ">=") else right - left
    short = margin if margin.is_number else tidy(margin)
    sign = short.is_positive if relation.rel_op in ("<", ">") else short.is_nonnegative
    if sign is None:  # a sum of squares may hide its sign until it is expanded
        spread = sp.expand(short)
        sign = spread.is_positive if relation.rel_op in ("<", ">") else spread.is_nonnegative
    return bool(sign)


def difference(relation: Any, facts: Mapping[Expr, Expr]) -> str:
    """Return by how much a relation fails with the facts substituted."""
    left, right = _value(relation.lhs, facts), _value(relation.rhs, facts)
    if isinstance(relation, sp.Equality):
        return f"left - right = {tidy(left - right)}"
    if relation.rel_op == "!=":
        return "both sides are equal"
    margin = left - right if relation.rel_op in (">", ">=") else right - left
    return f"the margin {margin if margin.is_number else tidy(margin)} is not of one sign, or of the wrong one"


def says_nothing(relation: Any) -> bool:
    """Return whether an equation is an identity (x = x)."""
    return isinstance(relation, sp.Equality) and (relation.lhs == relation.rhs or is_zero(relation.lhs - relation.rhs))


def poles(relation: Any, facts: Mapping[Expr, Expr], attitude: Mapping[Expr, Expr]) -> list[str]:
    """Return the sides of a relation that are infinite at ``attitude``, taking the limits of the angles one after the other."""
    found = []
    for side in (relation.lhs, relation.rhs):
        value = side if any(sp.sympify(side).has(angle) for angle in attitude) else _value(side, facts)
        for angle, where in attitude.items():
            if value.has(angle):
                value = sp.limit(value, angle, where)
        if value.has(sp.oo, sp.zoo, sp.nan) or isinstance(value, sp.AccumBounds):
            found.append(str(side))
    return found


def judge(entry: Entry) -> EquationVerdict:
    """Return the verdict on an entry, from its printed relations, its facts and its cases."""
    true_in, false = [], []
    for branch in entry.branches:
        if all(true_of(r, branch.facts) for r in entry.printed):
            true_in.append(branch.name)
        else:
            false.append(branch)
    false_in = [branch.name for branch in false]
    failed = tuple((r, branch.facts) for branch in false for r in entry.printed)
    idle = [shown(r) for r in entry.printed if says_nothing(r)]
    wanted = [r for r in entry.derived if not says_nothing(r)]
    if idle and len(idle) > len(entry.derived) - len(wanted):
        said = "; ".join(idle)
        return EquationVerdict("misprint", (), tuple(false_in), f"{said} says nothing", failed, said)
    if not false_in:
        infinite = [s for r in entry.printed for s in poles(r, entry.branches[0].facts, entry.attitude)]
        if infinite:
            where = ", ".join(f"{k} = {v}" for k, v in entry.attitude.items())
            return EquationVerdict(
                "conditional", tuple(true_in), (), f"holds away from {where}, where {infinite[0]} is infinite"
            )
        return EquationVerdict("holds", tuple(true_in), (), "")
    true_in += [c.name for c in entry.cases if all(true_of(r, c.facts) for r in entry.printed)]
    named_true, named_false = [n for n in true_in if n], [n for n in false_in if n]
    if true_in:
        sentence = f"holds {'; '.join(named_true)}" + (f"; not {'; '.join(named_false)}" if named_false else "")
        return EquationVerdict("conditional", tuple(true_in), tuple(false_in), sentence, failed)
    right = "; ".join(shown(r) for r in entry.derived)
    return EquationVerdict("misprint", (), tuple(false_in), f"right is {right}", failed)
