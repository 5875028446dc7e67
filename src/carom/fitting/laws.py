"""Laws that can be fitted: their contact model, free and fixed parameters, and how the engine simulates them.

They are made from the descriptors in carom.laws; a :class:`FittedLaw` holds everything that fits need to know about a law.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Literal

from carom.data.rebounds import Kind
from carom.errors import CaromError, Fault, did_you_mean
from carom.fitting.kernels import CONTACT, CONVENTIONAL, SMOOTH, TOGETHER, TURN
from carom.laws.arrays import WallKernel
from carom.laws.callbacks import user_address
from carom.laws.law import CALLED_WALL, MIRROR_WALL, ROLLING_WALL, TWO_STEP_WALL, FitSpec, Law
from carom.laws.registry import laws

__all__ = ["FITTED", "FittedLaw", "TrackEngine", "laws_for", "laws_named", "track_laws_named", "unknown_laws"]


@dataclass(frozen=True)
class TrackEngine:
    """How :func:`carom.simulate` evaluates a law when whole tracks are fitted."""

    law: str = "two-step"
    floor_contact: Literal["with", "after"] = "after"
    surface: bool = True
    """Whether the law reads restitution and friction of the wall."""
    rolling_only: bool = False
    """Whether the law requires balls that roll before the wall."""


@dataclass(frozen=True)
class FittedLaw:
    """A law in the form in which it is fitted to one kind of rebound.

    Examples
    --------
    >>> from carom.fitting import FITTED
    >>> [law.name for law in FITTED if law.kind == "planar"]
    ['mirror', 'no-slip', 'sticking', 'sliding', 'maw', 'stronge', 'contact']
    """

    name: str
    kind: Kind
    code: int
    """Code of the contact model (:mod:`carom.fitting.kernels`); -1: the one of its ``kernel``."""
    free: tuple[str, ...]
    words: str
    """Its name in a sentence."""
    pinned: dict[str, float] = field(default_factory=dict)
    """Parameters with values that define the law."""
    within: tuple[str, ...] = ()
    """Laws that contain it as a special case, exactly or nearly."""
    upright: bool = False
    """Whether the wall always touches at the height of the centre."""
    engine: TrackEngine | None = None
    """None: the law is not fitted to whole tracks."""
    search_code: int | None = None
    """Cheaper contact model with which the search begins."""
    chi_range: tuple[float, float] | None = None
    """Range of stiffness_ratio (1 + 1/kappa)/2 over which the law is tabulated."""

    on_request: bool = False
    """Whether the law is fitted only if it is named."""
    redundant_upright: bool = False
    """Whether it equals another law if the wall touches at the height of the centre."""
    kernel: WallKernel | None = None
    """Kernel of a law that is not compiled in."""
    stiffness_last: bool = False
    """Whether the last argument of the kernel is the stiffness ratio."""

    @property
    def contact_code(self) -> int:
        """Code for the compiled loops: the contact model, or the address of the law's kernel, negative with stiffness_last."""
        if self.kernel is None:
            return self.code
        return -user_address(self.kernel) if self.stiffness_last else user_address(self.kernel)

    @property
    def called(self) -> str:
        """Name of the law in a sentence, with that on the command line if it differs."""
        return self.words if self.name in self.words.lower() else f"{self.words} ({self.name})"

    @property
    def frictionless(self) -> bool:
        """Whether the wall exerts no tangential force."""
        return self.pinned.get("friction") == 0

    @property
    def feels_floor(self) -> bool:
        """Whether friction and restitution of the floor matter."""
        return self.kind == "table" and self.code not in (SMOOTH, CONVENTIONAL)


def _spec(law: Law, spec: FitSpec) -> FittedLaw:
    """Return how a law of carom.LAWS is fitted to one kind of rebound."""
    free = law.free if spec.free is None else spec.free
    height = {"contact_height": 1.0} if spec.upright else {}
    pinned = {name: value for name, value in {**law.pinned, **spec.pinned, **height}.items() if name not in free}
    with_floor = spec.rolling_only or law.response in (TWO_STEP_WALL, ROLLING_WALL, CALLED_WALL)
    engine = TrackEngine(
        law.name if law.response in (ROLLING_WALL, CALLED_WALL) else "two-step", "with" if with_floor else "after",
        law.response != ROLLING_WALL, spec.rolling_only,
    )  # fmt: skip
    table = spec.kind == "table"
    return FittedLaw(
        law.name, spec.kind, _code(law, table), free, spec.phrase or law.name, pinned, spec.nested_in, spec.upright,
        engine if table else None, TURN if table and law.response == TWO_STEP_WALL else None, law.chi_range, spec.on_request,
        spec.redundant_upright, law.kernel if law.response == CALLED_WALL else None, law.last == "stiffness_ratio",
    )  # fmt: skip


def _code(law: Law, table: bool) -> int:
    """Return the contact model of a law; minus 1 for one that is not compiled in (see :attr:`FittedLaw.contact_code`)."""
    if law.response == CALLED_WALL:
        return -1
    on_table = {MIRROR_WALL: SMOOTH, ROLLING_WALL: CONVENTIONAL, TWO_STEP_WALL: TOGETHER}
    return on_table.get(law.response, TURN) if table else CONTACT


def _all_laws() -> tuple[FittedLaw, ...]:
    specs = [
        (law, spec) for law in laws().values() if law.kernel for spec in law.fits if not (spec.same_as or spec.absent)
    ]
    found = [_spec(law, spec) for law, spec in specs]
    # (planar first; of each kind the laws with fewer free parameters first)
    return tuple(sorted(found, key=lambda law: (law.kind, len(law.free))))


FITTED = _all_laws()
"""All laws that can be fitted, each for one kind of rebound."""
# Other names of laws, and why a law cannot be fitted
ALIASES = {
    (name, spec.kind): spec.same_as or law.name
    for law in laws().values() for spec in law.fits for name in (law.name, *law.aliases) if not spec.absent
}  # fmt: skip
ABSENT = {(law.name, spec.kind): spec.absent for law in laws().values() for spec in law.fits if spec.absent}


def laws_for(kind: Kind, upright: bool) -> list[FittedLaw]:
    """Return all laws for a kind of rebound, without duplicates if the wall touches at the height of the centre."""
    taking_part = [law for law in FITTED if law.kind == kind and not law.on_request]
    return [law for law in taking_part if not (upright and law.redundant_upright)]


def unknown_laws(names: Sequence[str], kind: Kind | None = None) -> list[Fault]:
    """Return the fault of each name that no law has, whatever the kind of rebound."""
    everything = sorted(
        {law.name for law in FITTED} | {name for name, _kind in ALIASES} | {name for name, _kind in ABSENT}
    )
    known = list(dict.fromkeys(law.name for law in FITTED if kind in (None, law.kind)))
    return [
        Fault("law", "", f"one of {', '.join(known)}", repr(name), did_you_mean(name, everything))
        for name in names
        if name not in everything
    ]


def laws_named(names: list[str] | None, kind: Kind, upright: bool) -> tuple[list[FittedLaw], list[str]]:
    """Return the named laws (all by default) and notes; CaromError with the nearest name for an unknown one."""
    if not names:
        others = [law.name for law in FITTED if law.kind == kind and law.on_request]
        said = f"laws that were not fitted, as they take long and are for comparison: {', '.join(others)}; name them in `laws`"
        return laws_for(kind, upright), [said] if others else []
    known = {law.name: law for law in FITTED if law.kind == kind}
    found: dict[str, FittedLaw] = {}
    notes, faults = [], unknown_laws(names, kind)
    for name in names:
        means = ALIASES.get((name, kind), name)
        if means in known:
            found[means] = known[means]
            if means != name:
                notes.append(f"{name}: for a {kind} rebound this is the law {means}")
        elif (name, kind) in ABSENT:
            notes.append(f"{name}: left out, {ABSENT[name, kind]}")
    if not found and not faults:
        faults.append(Fault("laws", "", f"one that applies to a {kind} rebound", "none", "; ".join(notes)))
    if faults:
        raise CaromError(*faults)
    return list(found.values()), notes


def track_laws_named(names: Sequence[str] | None, upright: bool) -> tuple[list[FittedLaw], list[str]]:
    """Return the named laws (all of :data:`FITTED` by default) for whole tracks, and notes."""
    chosen, notes = laws_named(list(names) if names else None, "table", upright)
    return [law for law in chosen if law.engine is not None], notes
