"""Gases of many balls or discs: event-driven, rough or smooth, in periodic boxes and between walls."""

from carom.gas.run import Gas, GasBalls, GasRun, simulate_gas
from carom.gas.setup import WALLS, Species
from carom.gas.start import lattice, scattered, thermal

__all__ = ["WALLS", "Gas", "GasBalls", "GasRun", "Species", "lattice", "scattered", "simulate_gas", "thermal"]
