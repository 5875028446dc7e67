"""The laws that are fitted: which kernel, which numbers are free, which are what the law says."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

from carom.checks import nearest
from carom.errors import CaromError
from carom.fitting.kernels import CONTACT, CONVENTIONAL, MAW, SMOOTH, TOGETHER, TURN
from carom.rebounds import Kind

__all__ = ["FITTED", "FittedLaw", "laws_for", "laws_named", "unknown_laws"]


@dataclass(frozen=True)
class FittedLaw:
    """One law as it is fitted to one kind of rebound."""

    name: str
    kind: Kind
    code: int
    free: tuple[str, ...]
    words: str
    """What a sentence calls it."""
    pinned: dict[str, float] = field(default_factory=dict)
    within: tuple[str, ...] = ()
    """Laws that contain it: with some value of their own numbers they are this one, or as good as."""
    upright: bool = False
    """It knows no nose: the wall touches at the height of the centre."""

    @property
    def called(self) -> str:
        """Its words, with the name that the command knows where they lack it."""
        return self.words if self.name in self.words.lower() else f"{self.words} ({self.name})"


ANY = {"friction": math.inf}
FITTED = (
    FittedLaw("mirror", "planar", CONTACT, ("restitution",), "no friction (mirror)", {"friction": 0.0},
              ("sliding", "contact", "maw")),
    FittedLaw("no-slip", "planar", CONTACT, ("restitution",), "no-slip, all slip returned", ANY | {"tangential_restitution": 1.0},
              ("contact", "maw")),
    FittedLaw("sticking", "planar", CONTACT, ("restitution",), "sticking (the paper's wall)", ANY, ("sliding", "contact", "maw")),
    FittedLaw("sliding", "planar", CONTACT, ("restitution", "friction"), "sliding (Coulomb), slip stopped at most",
              {}, ("contact",)),
    FittedLaw("contact", "planar", CONTACT, ("restitution", "friction", "tangential_restitution"),
              "sliding with tangential restitution"),
    FittedLaw("maw", "planar", MAW, ("restitution", "friction", "stiffness_ratio"), "tangential compliance (Maw et al.)"),
    FittedLaw("mirror", "table", SMOOTH, ("restitution",), "no friction (mirror)", upright=True),
    FittedLaw("conventional", "table", CONVENTIONAL, (), "conventional rolling reflection", upright=True),
    FittedLaw("two-step-paper", "table", TURN, (), "two-step with the paper's surfaces",
              ANY | {"restitution": 1.0, "floor_friction": math.inf}, upright=True),
    FittedLaw("no-slip", "table", TURN, ("restitution",), "no-slip wall, then the floor",
              ANY | {"tangential_restitution": 1.0}, ("contact",), upright=True),
    FittedLaw("two-step", "table", TOGETHER, ("restitution", "friction"), "two-step, wall and floor at once"),
    FittedLaw("two-step-after", "table", TURN, ("restitution", "friction"), "two-step, the wall and then the floor",
              {}, ("contact",)),
    FittedLaw("contact", "table", TURN, ("restitution", "friction", "tangential_restitution"),
              "wall with tangential restitution, then the floor"),
    FittedLaw("maw", "table", MAW, ("restitution", "friction", "stiffness_ratio"),
              "tangential compliance (Maw et al.), then the floor"),
)  # fmt: skip
# Names that people use, and why a law cannot take part
ALIASES = {
    ("two-step", "planar"): "sliding", ("two-step-after", "planar"): "sliding", ("coulomb", "planar"): "sliding",
    ("sliding", "table"): "two-step-after", ("coulomb", "table"): "two-step-after", ("sticking", "table"): "two-step-paper",
}  # fmt: skip
ABSENT = {
    ("conventional", "planar"): "it is about a ball that rolls on a floor, and these are bounces in the plane",
    ("two-step-paper", "planar"): "it needs a floor; its wall is the law sticking",
}


def laws_for(kind: Kind, upright: bool) -> list[FittedLaw]:
    """All laws for a kind of rebound; where the wall touches at the centre's height, each once."""
    return [law for law in FITTED if law.kind == kind and not (upright and law.name == "two-step-after")]


def unknown_laws(names: Sequence[str], kind: Kind | None = None, more: Sequence[str] = ()) -> list[str]:
    """Faults of names that no law has, whatever the kind of rebound, a line each; ``more``: names that are known beside these."""
    everything = sorted({law.name for law in FITTED} | {name for name, _kind in ALIASES} | set(more))
    known = list(dict.fromkeys([*(law.name for law in FITTED if kind in (None, law.kind)), *more]))
    return [
        f"law: expected one of {', '.join(known)}, got {name!r}; {nearest(name, everything)}"
        for name in names
        if name not in everything
    ]


def laws_named(names: list[str] | None, kind: Kind, upright: bool) -> tuple[list[FittedLaw], list[str]]:
    """Those laws, and what there is to say; CaromError with the nearest name where there is none."""
    all_laws = laws_for(kind, upright)
    if not names:
        return all_laws, []
    known = {law.name: law for law in FITTED if law.kind == kind}
    found: dict[str, FittedLaw] = {}
    notes, faults = [], unknown_laws(names, kind)
    for name in names:
        means = ALIASES.get((name, kind), name)
        if means in known:
            found[means] = known[means]
            if means != name:
                notes.append(f"{name}: for a {kind} rebound that is the law {means}")
        elif (name, kind) in ABSENT:
            notes.append(f"{name}: left out, {ABSENT[name, kind]}")
    if faults or not found:
        raise CaromError(
            *(faults or [f"laws: expected one that a {kind} rebound can follow, got none; {'; '.join(notes)}"])
        )
    return list(found.values()), notes
