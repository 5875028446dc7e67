"""Registry of laws: every module of this package that defines LAW, and every card in it.

A file added to the package is found here, and so by `carom laws`, `compare`, `predict`, scenes, billiards and fits.
"""

from __future__ import annotations

import copyreg
import functools
import hashlib
import importlib
import importlib.util
import math
import pkgutil
import sys
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, fields, replace
from functools import partial
from pathlib import Path
from typing import Any

from carom.core.jit.kernel import kernel
from carom.errors import CaromError, Fault, did_you_mean, require_type, shown, suggestion
from carom.files import read_regular
from carom.laws.arrays import WallKernel
from carom.laws.law import Answer, Card, Law, Meeting, wall_law
from carom.public.guard import called_from_outside
from carom.public.own_laws import OwnLaw


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
    name = next((law.name for law in laws().values() if name in law.aliases), name)
    if name not in cards():
        raise CaromError(Fault("law", "", f"one of {', '.join(cards())}", repr(name), did_you_mean(name, [*cards()])))
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


# ----------------------------------------------------------------------------------------------------
# Find a law by its name, or load a custom law from a Python file.


FORBIDDEN = (
    "one of carom's laws, as opening a file runs no code",
    "to run that Python file, if you trust it: `allow_own_laws=True`",
)
"""Expected, and what to do, where a text from a file names a Python file."""


def find_law(name: str) -> Law:
    """Return a law by its name, or a custom law by ``file.py:name``.

    The file defines a :class:`carom.Law`, or a kernel of the wall, (v, w, n, a, kappa, e, mu, beta) -> (v, w). This is the only
    place in carom that runs it; it runs none for a text out of a file (:mod:`carom.public.own_laws`).

    Raises CaromError for an unknown name (with the nearest one), for a file that does not run or lacks the name, and for a custom
    law that nobody has typed or allowed.
    """
    require_type("find_law", "name", name, str)
    if ".py" in name and not isinstance(name, OwnLaw) and not called_from_outside():
        expected, advice = FORBIDDEN
        raise CaromError(Fault("law", "", expected, shown(Path(name).name, 100), advice))
    file, colon, what = name.rpartition(":")
    if not colon or not file.endswith(".py"):
        if name.endswith(".py"):
            raise CaromError(Fault("", f"`law` {name}", f"the law's name in the file as well, as in {name}:law"))
        return law_named(name)
    path = Path(file)
    try:
        text = read_regular(path, "a Python file")
    except CaromError as error:
        raise CaromError(*(replace(one, where="", field=f"`law` {file}") for one in error.records)) from None
    # The module's name depends on the file's content: compiled loops are cached by it, and an edited law is a different law.
    module_name = f"carom_law_{hashlib.sha256(str(path.resolve()).encode() + text).hexdigest()[:16]}"
    spec = importlib.util.spec_from_file_location(module_name, path)
    if spec is None or spec.loader is None:
        raise CaromError(Fault("", f"`law` {file}", "a Python file", "one that Python cannot load"))
    module = importlib.util.module_from_spec(spec)
    sys.modules[module_name] = module
    try:
        spec.loader.exec_module(module)
    except Exception as error:
        raise CaromError(Fault("", f"`law` {file}", "a file that runs", f"{type(error).__name__}: {error}")) from error
    found = getattr(module, what, None)
    if found is None:
        names = [
            key
            for key, value in vars(module).items()
            if not key.startswith("_") and (callable(value) or isinstance(value, Law))
        ]
        raise CaromError(Fault("", f"`law` {name}", f"{what!r} in the file", "no such name", suggestion(what, names)))
    if isinstance(found, Law):
        law = found
    elif callable(found):
        law = wall_law(Card(what, "A custom law.", (), "", str(path), ""), kernel(found))
    else:
        raise CaromError(Fault("", f"`law` {name}", "a carom.Law or a kernel", type(found).__name__))
    if law.kernel is not None:
        _try_once(name, law.kernel)
    parts = {one.name: getattr(law, one.name) for one in fields(Law)} | {
        "answer": partial(_answer_or_fault, name, law.answer)
    }
    return LawOfFile(**parts, source=f"{path.resolve()}:{what}", digest=hashlib.sha256(text).hexdigest())


@dataclass(frozen=True, eq=False, repr=False)
class LawOfFile(Law):
    """A custom law out of a Python file: pickled as the place of that file, which is read again where the pickle is opened.

    The law exists because somebody typed its name, or allowed the file that names it; its pickle carries that permission. (Opening
    any pickle runs code.) The file has to be there, and the same.
    """

    source: str = ""
    """``file.py:name``, the path in full."""
    digest: str = ""
    """SHA-256 of the file."""

    def __reduce_ex__(self, _protocol: Any) -> tuple[Any, ...]:
        """Pickle the file's name and digest, from which the law is loaded again."""
        return law_of_file, (str(self.source), self.digest)

    def __copy__(self) -> LawOfFile:
        """Return the law itself, which does not change."""
        return self

    def __deepcopy__(self, _memo: Any) -> LawOfFile:
        """Return the law itself, which does not change."""
        return self


def law_of_file(source: str, digest: str) -> Law:
    """Return the law that was pickled; CaromError where its file is not there, or has changed."""
    path = Path(source.rpartition(":")[0])
    if path.is_file() and hashlib.sha256(read_regular(path)).hexdigest() != digest:
        raise CaromError(
            Fault("law", str(path), "the file as it was when the law was pickled", "one that has changed since")
        )
    return find_law(OwnLaw(source))


def _try_once(name: str, kernel: WallKernel) -> None:
    """Raise CaromError if a kernel does not take eight arguments and return two triples of finite numbers."""
    try:
        found = kernel((-1.0, 0.5, 0.0), (1.0, 2.0, 3.0), (1.0, 0.0, 0.0), 0.03, 0.4, 0.9, 0.2, 0.0)
    except Exception as error:
        raise CaromError(
            Fault(
                "", f"`law` {name}", "law(v, w, n, a, kappa, e, mu, beta) -> (v, w)", f"{type(error).__name__}: {error}"
            )
        ) from error
    try:
        v, w = found
        good = len(v) == len(w) == 3 and all(math.isfinite(x) for x in (*v, *w))
    except (TypeError, ValueError):
        good = False
    if not good:
        raise CaromError(Fault("", f"`law` {name}", "(v, w), two triples of finite numbers", repr(found)))


def _answer_or_fault(name: str, answer: Callable[[Meeting], Answer], meeting: Meeting) -> Answer:
    """Return the answer of a custom law; an exception of its own is reported as one line."""
    try:
        return answer(meeting)
    except CaromError:
        raise
    except Exception as error:
        first = " ".join(str(error).split())[:300]
        raise CaromError(
            Fault("", f"`law` {name}", "numbers for this ball", f"{type(error).__name__}: {first}")
        ) from error
