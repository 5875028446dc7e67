"""Options that fits and plans of shots share: moments of inertia, spins, NAME=VALUE."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

from carom.errors import CaromError

__all__ = ["bounds_of", "kappa_of", "length_of", "number", "pairs", "spin_of", "split", "unread"]


def split(text: str) -> list[str]:
    """The parts between commas."""
    return [part.strip() for part in text.split(",") if part.strip()]


def kappa_of(text: str) -> float:
    """I/(m a^2) of solid, hollow or a number."""
    from carom.ball import INERTIAS

    try:
        kappa = INERTIAS[text] if text in INERTIAS else float(text)
    except ValueError:
        kappa = math.nan
    if not 0 < kappa <= 1:
        raise CaromError(f"--inertia: expected solid, hollow or kappa = I/(m a^2) above 0, up to 1, got {text!r}")
    return kappa


def length_of(name: str, text: str | None) -> float | None:
    """A length in m, with or without a unit."""
    from carom.tables.units import UNITS

    if text is None:
        return None
    number = text.strip().rstrip("abcdefghijklmnopqrstuvwxyz ")
    unit = UNITS["length"].get(text.strip()[len(number) :].strip() or "m")
    try:
        value = float(number)
    except ValueError:
        unit = None
    if unit is None:
        raise CaromError(f"--{name}: expected a length, such as 0.0005 (m) or 0.5mm, got {text!r}")
    return float(unit.to_si(value))


def spin_of(text: str | None, whole: bool = False) -> tuple[float | None, dict[str, Any]]:
    """A spin for all; or what is assumed of spins that nobody measured, as fields of a Setting; ``whole``: at starts of tracks."""
    name, _, width = (text or "normal").partition(":")
    if whole and name != "normal":
        raise CaromError(
            f"--spin: expected normal:WIDTH (in v/a) with --whole, got {text!r}; each track's own is fitted"
        )
    try:
        if name == "normal" and not width:
            return None, {}
        if name in ("normal", "uniform"):
            if float(width) > 0:
                return None, {"spin_prior": name, "spin_width": float(width), "spin_mean": 0.0}
        elif math.isfinite(value := 0.0 if name == "none" else float(name)):
            return value, {}
    except ValueError:
        pass
    raise CaromError(f"--spin: expected a spin in rad/s, normal, normal:WIDTH or uniform:WIDTH (in v/a), got {text!r}")


def pairs(faults: list[str], option: str, texts: list[str] | None, known: list[str]) -> Iterator[tuple[str, str]]:
    """Names and values of NAME=VALUE, given once or often; faults where a name is not known."""
    from carom.checks import nearest

    for text in texts or []:
        name, equals, value = text.partition("=")
        if not equals:
            faults.append(f"{option}: expected NAME=..., got {text!r}")
        elif name not in known:
            faults.append(f"{option}: expected a number of a law, got {name!r}; {nearest(name, known)}")
        else:
            yield name, value


def number(option: str, name: str, text: str) -> float:
    """The number of NAME=VALUE."""
    try:
        return float(text)
    except ValueError:
        raise CaromError(f"{option}: {name}: expected a number, got {text!r}") from None


def bounds_of(name: str, text: str) -> tuple[float, float]:
    """The two numbers of NAME=LOW:HIGH."""
    low, _, high = text.partition(":")
    try:
        found = float(low), float(high)
    except ValueError:
        found = (1.0, 0.0)
    if not found[0] < found[1]:
        raise CaromError(f"--bound: {name}: expected LOW:HIGH, LOW below HIGH, got {text!r}")
    return found


def unread(whole: bool, of_contacts: dict[str, Any], of_frames: dict[str, Any]) -> list[str]:
    """The faults of options that were given and would do nothing: of contacts with ``--whole``, of whole tracks without it."""
    wanted = "no --whole, which fits frames and not contacts" if whole else "--whole beside it"
    given = of_contacts if whole else of_frames
    return [f"{name}: expected {wanted}; leave it out" for name, value in given.items() if value is not None]
