"""What an impact law may do that no body does: warnings with a class each, so that a caller can turn them into
errors."""

from __future__ import annotations

__all__ = ["EnergyGain", "FrictionJam", "ImpactWarning"]


class ImpactWarning(UserWarning):
    """A closing hypothesis of an impact gives an answer that deserves no trust."""


class EnergyGain(ImpactWarning):
    """Newton's restitution with friction returns more energy than came in (Kane and Levinson 1985)."""


class FrictionJam(ImpactWarning):
    """Friction turns the normal impulse against itself: the slipping contact jams (Painlevé 1895)."""
