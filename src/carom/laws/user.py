"""Find a law by its name, or load a custom law from a Python file."""

from __future__ import annotations

import hashlib
import importlib.util
import math
import sys
from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from functools import partial
from pathlib import Path
from typing import Any

from carom.core.jit.kernel import kernel
from carom.errors import CaromError, Fault, require_type, shown, suggestion
from carom.files import read_regular
from carom.laws.arrays import WallKernel
from carom.laws.law import Answer, Card, Law, Meeting, wall_law
from carom.laws.registry import law_named
from carom.public.callers import called_from_outside
from carom.public.own_laws import OwnLaw

__all__ = ["FORBIDDEN", "find_law"]

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
