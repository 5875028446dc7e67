"""Gases of many balls or discs: event-driven, rough or smooth, in periodic boxes, between walls, in round rooms."""

from carom.gas.container import SHAPES, WALLS, Container, container
from carom.gas.dense import dense
from carom.gas.drive import Drive, Thermostat
from carom.gas.run import Gas, GasBalls, GasRun, simulate_gas
from carom.gas.setup import Species
from carom.gas.start import lattice, scattered, thermal

__all__ = [
    "SHAPES", "WALLS", "Container", "Drive", "Gas", "GasBalls", "GasRun", "Species", "Thermostat", "container", "dense",
    "lattice", "scattered", "simulate_gas", "thermal",
]  # fmt: skip
