"""Which pooltool is installed. The main branch calls itself 0.6.0, as the release does; only main has an engine with ``is_3d``."""

from __future__ import annotations

import importlib.util
from typing import Any

from carom.errors import CaromError, MissingLibraryError

__all__ = ["has_flights", "require_pooltool"]

VERSION = "0.6"
MAIN_MODULE = "pooltool.evolution.engine"


def require_pooltool(needed_by: str) -> Any:
    """Return pooltool. MissingLibraryError, one line, where it is not installed; CaromError where it is of another version."""
    if importlib.util.find_spec("pooltool") is None:
        raise MissingLibraryError(
            f"{needed_by}: needs pooltool {VERSION}, which is not installed; carom's page 'From pooltool to carom' has two"
            " commands that install it"
        )
    try:
        import pooltool
    except ImportError as error:
        raise MissingLibraryError(
            f"{needed_by}: cannot import pooltool: {error}; install what it names with pip"
        ) from None
    found = str(getattr(pooltool, "__version__", "unknown"))
    if not found.startswith(f"{VERSION}."):
        raise CaromError(
            f"{needed_by}: expected pooltool {VERSION}, got {found}; pip install --no-deps pooltool-billiards==0.6.0"
        )
    return pooltool


def has_flights() -> bool:
    """Return whether the pooltool that is installed lets balls fly, as its main branch does."""
    return importlib.util.find_spec(MAIN_MODULE) is not None
