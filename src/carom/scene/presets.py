"""Real tables by name: sizes, cushions, pockets, balls, cloth, each number with its source (``tables.toml``)."""

from __future__ import annotations

import functools
import tomllib
from dataclasses import dataclass, field
from importlib.resources import files
from typing import Any

from carom.errors import Fault, did_you_mean, shown

__all__ = ["Preset", "Sourced", "preset_fault", "presets", "wall_fields"]

PARTS = ("ball", "floor", "ball_contact", "corner_pockets", "side_pockets")
POCKETS = ("corner_pockets", "side_pockets")


@dataclass(frozen=True)
class Sourced:
    """A value, where it comes from, and the short name of that source."""

    value: Any
    source: str
    key: str


@dataclass(frozen=True)
class Preset:
    """A table by name: numbers of its cushions, and by part of pockets, balls and floor."""

    name: str
    title: str
    cushions: dict[str, Sourced]
    parts: dict[str, dict[str, Sourced]] = field(default_factory=dict)


@functools.cache
def presets() -> dict[str, Preset]:
    """Return all tables by name."""
    tables = tomllib.loads(files("carom.scene").joinpath("tables.toml").read_text(encoding="utf-8"))
    sources = tables.pop("sources")

    def numbers(found: dict[str, Any]) -> dict[str, Sourced]:
        return {name: Sourced(value, sources[key], key) for name, (value, key) in found.items()}

    made: dict[str, Preset] = {}
    for name, own in tables.items():
        parent = made[own.pop("like")] if "like" in own else Preset(name, "", {})
        title, own_parts = own.pop("title"), {part: numbers(own.pop(part)) for part in PARTS if part in own}
        made[name] = Preset(name, title, {**parent.cushions, **numbers(own)}, {**parent.parts, **own_parts})
    return made


def preset_fault(name: Any) -> list[Fault]:
    """Return the problem with a name that no table has, with the nearest one; nothing for a known one."""
    if isinstance(name, str) and name in presets():
        return []
    advice = did_you_mean(name, presets()) if isinstance(name, str) else ""
    return [Fault("", "preset", f"one of {', '.join(presets())}", shown(name), advice)]


def wall_fields(preset: Preset) -> dict[str, Any]:
    """Return the fields of a ``table`` that a preset fills, as a scene file has them."""
    pockets = {
        part: {name: one.value for name, one in preset.parts[part].items()} for part in POCKETS if part in preset.parts
    }
    return {**{name: one.value for name, one in preset.cushions.items()}, **pockets}
