"""Impulsive motion from a Lagrangian and its constraints, and the paper proved line by line (needs SymPy).

This room stands apart: it imports nothing of carom but its error, so that the numeric laws can be held against it.
"""

from __future__ import annotations

import importlib.util

if importlib.util.find_spec("sympy") is None:
    raise ImportError("carom.derive needs SymPy, which is not installed; run: pip install sympy")

from carom.derive.cautions import EnergyGain, FrictionJam, ImpactWarning
from carom.derive.contact import Contact, contact_at
from carom.derive.impulsive import ImpulsiveMotion
from carom.derive.jump import Jump

__all__ = ["Contact", "EnergyGain", "FrictionJam", "ImpactWarning", "ImpulsiveMotion", "Jump", "contact_at"]
