"""Gases of many balls or discs: event-driven, rough or smooth, in periodic boxes, between walls, in round rooms.

What reads scenes, measures and keeps is imported when it is first used.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from carom.gas.container import SHAPES, WALLS, Container, container
from carom.gas.dense import dense
from carom.gas.drive import Drive, Thermostat
from carom.gas.run import Gas, GasBalls, GasRun, simulate_gas
from carom.gas.setup import Species
from carom.gas.start import lattice, scattered, thermal

if TYPE_CHECKING:
    from carom.gas.channel import channels as channels
    from carom.gas.checkpoint import load_checkpoint as load_checkpoint
    from carom.gas.checkpoint import save_checkpoint as save_checkpoint
    from carom.gas.measure import Measures as Measures
    from carom.gas.model import GasScene as GasScene
    from carom.gas.session import Session as Session
    from carom.gas.snapshots import Snapshots as Snapshots
    from carom.gas.toml import load_gas as load_gas
    from carom.gas.toml import new_gas as new_gas

HOME = {
    "GasScene": "model", "Measures": "measure", "Session": "session", "Snapshots": "snapshots", "channels": "channel",
    "load_checkpoint": "checkpoint", "load_gas": "toml", "new_gas": "toml", "save_checkpoint": "checkpoint",
}  # fmt: skip

__all__ = [  # noqa: PLE0604
    "SHAPES", "WALLS", "Container", "Drive", "Gas", "GasBalls", "GasRun", "Species", "Thermostat", "container", "dense",
    "lattice", "scattered", "simulate_gas", "thermal", *HOME,
]  # fmt: skip


def __getattr__(name: str) -> Any:
    if name not in HOME:
        raise AttributeError(f"module 'carom.gas' has no attribute {name!r}")
    found = getattr(importlib.import_module(f"carom.gas.{HOME[name]}"), name)
    globals()[name] = found
    return found


def __dir__() -> list[str]:
    return sorted({*globals(), *HOME})
