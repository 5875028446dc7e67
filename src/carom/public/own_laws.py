"""Permission of a text to name a Python file that is run as a law: texts that a user types have it, texts out of files do not.

A law can be asked for by a text, and ``file.py:name`` runs that file. Texts come in many ways: files of a dozen kinds, stores,
links. So none of these ways is trusted, and none has to remember to refuse. A text carries its permission with it: it is an
:class:`OwnLaw`, or :func:`carom.laws.registry.find_law` refuses it. An OwnLaw is made in three places only:

- where code outside carom calls carom with the text (:mod:`carom.public.guard`): who writes a program may name files in it;
- in ``cli``, of what is typed on the command line;
- where a file is opened with ``allow_own_laws``.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any


class OwnLaw(str):
    """The name of a custom law, "file.py:name", whose file may be run."""

    __slots__ = ()


def with_own_laws(value: Any) -> Any:
    """Return a text, or lists, tables and arrays of texts, with each text that names a Python file as an OwnLaw."""
    if isinstance(value, str):
        return OwnLaw(value) if ".py" in value else value
    if getattr(getattr(value, "dtype", None), "kind", "") == "U":
        listed = value.tolist()
        return with_own_laws(listed) if ".py" in repr(listed) else value
    if type(value) in (list, tuple) and any(isinstance(one, str | list | tuple | Mapping) for one in value):
        return type(value)(map(with_own_laws, value))
    if isinstance(value, Mapping):
        return {name: with_own_laws(one) for name, one in value.items()}
    return value


def holds_own_laws(value: Any) -> bool:
    """Return whether an OwnLaw stands in a value: in lists, tables, and fields of models."""
    if isinstance(value, Mapping):
        return any(map(holds_own_laws, value.values()))
    if isinstance(value, list | tuple | set | frozenset):
        return any(map(holds_own_laws, value))
    return isinstance(value, OwnLaw) or (hasattr(type(value), "model_fields") and holds_own_laws(vars(value)))
