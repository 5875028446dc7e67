"""Parameters of the laws: names, bounds, starting values, and the record in which compiled code reads them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

__all__ = ["FORMS", "INDEX", "LAW_NUMBERS", "LINE", "NUMBERS", "PARAMETERS", "RENAMED", "Form", "Parameter"]


@dataclass(frozen=True)
class Parameter:
    """One parameter of a law, the ball or the table: as described below, or as :func:`carom.fitting.setting.decided` sets it."""

    name: str
    low: float
    high: float
    """Bounds of the fit."""
    tried: tuple[float, ...]
    """Starting values of the search."""
    value: float
    """Where it is not fitted, its value; in a fit of whole tracks also where the search begins."""
    unit: str = ""
    meaning: str = ""
    free: bool = False
    """Whether it is fitted."""
    origin: str = ""
    """Who says whether it is fitted, and its value if not: "law", "setting" (ball, table, or the user), or nobody (the default)."""

    @property
    def starts(self) -> tuple[float, ...]:
        """Starting values within the bounds."""
        return tuple(value for value in self.tried if self.low <= value <= self.high) or ((self.low + self.high) / 2,)


PARAMETERS = (
    Parameter("restitution", 0.0, 1.0, (0.4, 0.6, 0.75, 0.85, 0.95), 1.0, meaning="normal, at the speed of the impact"),
    Parameter("restitution_1", 0.0, 10.0, (0.1,), 0.0, meaning="second coefficient of the restitution's form"),
    Parameter("restitution_2", 0.0, 10.0, (0.25,), 0.0, meaning="third coefficient of the restitution's form"),
    Parameter("friction", 0.0, 5.0, (0.03, 0.06, 0.1, 0.15, 0.2, 0.3, 0.5, 0.9, 1.8), 0.0, meaning="Coulomb, at the wall"),
    Parameter("tangential_restitution", -1.0, 1.0, (-0.5, 0.0, 0.5, 0.9), 0.0, meaning="reversed fraction of the slip"),
    Parameter("kappa", 0.05, 1.0, (0.4, 0.65), 0.4, meaning="moment of inertia over m a^2"),
    Parameter("stiffness_ratio", 0.3, 2.5, (0.5, 0.82, 1.2, 1.8), 14 / 17, meaning="tangential over normal stiffness"),
    Parameter("contact_height", 1.0, 1.6, (1.05, 1.2, 1.4), 1.0, "a", "where the wall touches, above the floor"),
    Parameter("floor_friction", 0.0, 2.0, (0.1, 0.2, 0.4), 0.2, meaning="of the floor, while the wall presses on it"),
    Parameter("floor_restitution", 0.0, 1.0, (0.0, 0.5), 0.0, meaning="of the floor"),
    Parameter("spin_width", 1e-3, 3.0, (0.2, 0.6), 1.25, "v/a", "standard deviation of the unmeasured spins"),
    Parameter("roll", 0.0, 1.0, (0.5,), 1.0, meaning="fraction of rolling before the wall"),
    Parameter("spin_mean", -2.0, 2.0, (0.0, 0.5), 0.0, "v_t/a", "mean of the unmeasured spins: 1 is no slip"),
)  # fmt: skip
INDEX = {parameter.name: i for i, parameter in enumerate(PARAMETERS)}
NUMBERS = len(PARAMETERS)
# All parameters of a law as one record: the same memory as an array of NUMBERS floats in the order of PARAMETERS.
LAW_NUMBERS = np.dtype([(parameter.name, "f8") for parameter in PARAMETERS])

# In addition to the forms of carom.core.motion.restitution: v_out = slope v + offset, a straight line through measured speeds.
LINE = 5


@dataclass(frozen=True)
class Form:
    """A form of the restitution as a function of speed: its code and its parameters, in the places of restitution, _1 and _2.

    A parameter is called as the field of the form in a scene, after ``restitution_``.
    """

    code: int
    parameters: tuple[Parameter, ...]
    formula: str

    def for_scene(self, name: str, values: Sequence[float]) -> float | dict[str, Any] | None:
        """Return the ``restitution`` of a wall in a scene, for the values of the parameters; None for a line, which scenes lack."""
        if name == "line":
            return None
        if name == "constant":
            return values[0]
        if name == "polynomial":
            return {"form": name, "coefficients": list(values)}
        fields = (one.name.removeprefix("restitution_") for one in self.parameters)
        return {"form": name, **dict(zip(fields, values, strict=True))}


def _e(name: str, low: float, high: float, *tried: float) -> Parameter:
    return Parameter(name, low, high, tried, tried[0])


FORMS = {
    "constant": Form(0, (PARAMETERS[0],), "e"),
    "line": Form(
        LINE,
        (_e("restitution_slope", 0.0, 1.0, 0.6, 0.8, 0.95), Parameter("restitution_offset", -1.0, 1.0, (0.0,), 0.0, "m/s")),
        "e = slope + offset / v_n, above 1 where the line is",
    ),
    "polynomial": Form(
        1,
        (
            _e("restitution_0", 0.0, 1.0, 0.5, 0.8, 0.95),
            # (from each side of zero: a rise that ends, a fall that ends and a fall that does not are separate valleys)
            _e("restitution_1", -2.0, 2.0, -0.1, 0.1),
            _e("restitution_2", -1.0, 1.0, -0.02, 0.02),
        ),
        "e = r0 + r1 v_n + r2 v_n^2, constant beyond its vertex (Han 2005, eq. 26)",
    ),
    "viscoelastic": Form(
        3,
        (_e("restitution_c", 0.0, 5.0, 0.05, 0.15, 0.3, 0.6),),
        "e = 1 / (1 + c + 2/5 c^2), c = restitution_c v_n^(1/5) (Ramirez et al. 1999)",
    ),
    "exponential": Form(
        4,
        (
            _e("restitution_at_rest", 0.0, 1.0, 0.9, 0.98),
            _e("restitution_at_speed", 0.0, 1.0, 0.5, 0.7),
            Parameter("restitution_speed", 0.01, 100.0, (0.5, 2.0), 1.0, "m/s"),
        ),
        "e = at_speed + (at_rest - at_speed) exp(-v_n / speed)",
    ),
}  # fmt: skip
# Names of the release before, of which settings still take those of parameters held fixed or bounded.
RENAMED = {
    "restitution_slow": "restitution_at_rest", "restitution_fast": "restitution_at_speed", "dissipation": "restitution_c",
}  # fmt: skip
