"""Registry of laws: every module of this package that defines LAW, and every card in it.

A file added to the package is found here, and so by `carom laws`, `compare`, `predict`, scenes, billiards and fits.
"""

from __future__ import annotations

import copyreg
import functools
import importlib
import pkgutil
from collections.abc import Iterable, Sequence
from typing import Any

from carom.errors import CaromError, Fault, did_you_mean, require_type, suggestion
from carom.laws.law import Card, Law

__all__ = ["card_named", "cards", "law_for_pairs", "law_named", "law_styles", "laws", "laws_of_pairs", "one_or_several"]


@functools.cache
def _modules() -> tuple[Any, ...]:
    package = importlib.import_module(__package__)
    names = sorted(found.name for found in pkgutil.iter_modules(package.__path__))
    return tuple(importlib.import_module(f"{__package__}.{name}") for name in names)


class _ByName(dict[str, Any]):
    """Laws by name, with an error that says which there are."""

    def __missing__(self, name: object) -> Any:
        raise KeyError(f"no law {name!r:.60}; {suggestion(name, list(self))}")


@functools.cache
def laws() -> dict[str, Law]:
    """Return all laws by name, sorted by ``order``: the value of ``carom.LAWS``."""
    found = [module.LAW for module in _modules() if isinstance(getattr(module, "LAW", None), Law)]
    return _ByName({law.name: law for law in sorted(found, key=lambda law: (law.order, law.name))})


@functools.cache
def cards() -> dict[str, Card]:
    """Return every card by name, first of the laws, then of parts of laws: the value of ``carom.CARDS``."""
    others = [x for module in _modules() for x in vars(module).values() if isinstance(x, Card)]
    return {card.name: card for card in (*(law.card for law in laws().values()), *others)}


def law_named(name: str) -> Law:
    """Return a law by its name; CaromError with the nearest name where there is none."""
    require_type("law_named", "name", name, str)
    for law in laws().values():
        if name == law.name or name in law.aliases:
            return law
    raise CaromError(Fault("law", "", f"one of {', '.join(laws())}", repr(name), did_you_mean(name, list(laws()))))


def laws_of_pairs() -> list[str]:
    """Return the names of the laws by which two balls may meet."""
    return [law.name for law in laws().values() if law.for_pairs]


def law_for_pairs(law: Law) -> Law:
    """Return a law by which two balls may meet; CaromError for one that is more than a contact. Custom ones are trusted."""
    known = laws().get(law.name) is law
    if law.kernel is None or (known and not law.for_pairs):
        got = f"{law.name!r}, a law of {'walls' if law.kernel is not None else 'walls without a kernel'}"
        raise CaromError(Fault("law", "", f"a law of one contact: {', '.join(laws_of_pairs())}, or file.py:name", got))
    return law


def _pickled(law: Law) -> Any:
    """Pickle a law of this package by its name, and a custom one by its fields (its functions have to be importable)."""
    return (law_named, (law.name,)) if laws().get(law.name) is law else law.__reduce_ex__(2)


copyreg.pickle(Law, _pickled)


def one_or_several(where: str, laws: str | Law | Iterable[str | Law]) -> list[Any]:
    """Return names or Laws as a list, where one is given as where several are; CaromError for what is neither."""
    if isinstance(laws, (str, Law)):
        return [laws]
    if not isinstance(laws, Iterable):
        raise CaromError(f"{where}: laws: expected a name or a sequence of names, got {laws!r:.60}")
    return list(laws)


def card_named(name: str) -> Card:
    """Return the card of a law by name; CaromError with the nearest name where there is none."""
    require_type("card_named", "name", name, str)
    if name not in cards():
        raise CaromError(
            Fault("law", "", f"one of {', '.join(cards())}", repr(name), did_you_mean(name, list(cards())))
        )
    return cards()[name]


# The lines of laws have the colours of Okabe & Ito, distinct for colour-blind people, and different dashes for print.
MORE_COLOURS = ("#B8A600", "#000000", "#7A4FB5", "#A0522D")


def law_styles(names: Sequence[str]) -> dict[str, tuple[str, Any]]:
    """Return colour and dashes of each law; custom laws get the remaining colours, in order."""
    known = laws()
    found: dict[str, tuple[str, Any]] = {}
    new = 0
    for law in names:
        if law in known and (line := known[law].line) is not None:
            found[law] = line
        else:
            found[law] = (MORE_COLOURS[new % len(MORE_COLOURS)], (0, (3 + new, 1.5)))
            new += 1
    return found


def __getattr__(name: str) -> Any:
    """Create LAWS and CARDS on first access: the laws are imported then, not with this module."""
    if name == "LAWS":
        return laws()
    if name == "CARDS":
        return cards()
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
