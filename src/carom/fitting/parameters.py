"""Parameters of the laws: names, bounds, starting values, and the record in which compiled code reads them."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

__all__ = [
    "ALONG", "ALONG_FORMS", "FORMS", "INDEX", "LAW_NUMBERS", "LINE", "NUMBERS", "PARAMETERS", "PLACES",
    "RESTITUTION_FORMS", "Form", "Parameter", "viscous_loss",
]  # fmt: skip

LEAST_RESTITUTION = 0.05  # of a start


def viscous_loss(restitution: Any) -> Any:
    """Return c of a viscoelastic ball, 1/e = 1 + c + 2/5 c^2 with c proportional to v^(1/5); 0 where e is 1 or more."""
    return (np.sqrt(1 + 1.6 * np.maximum(1 / np.maximum(restitution, LEAST_RESTITUTION) - 1, 0.0)) - 1) / 0.8


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
    Parameter("friction_1", -5.0, 5.0, (0.0,), 0.0, meaning="second number of the friction's form"),
    Parameter("friction_2", 0.0, 100.0, (1.0,), 1.0, meaning="third number of the friction's form"),
    Parameter("last_1", -5.0, 5.0, (0.0,), 0.0, meaning="second number of the form of tangential restitution or stiffness ratio"),
    Parameter("last_2", 0.0, 100.0, (1.0,), 1.0, meaning="third number of that form"),
)  # fmt: skip
INDEX = {parameter.name: i for i, parameter in enumerate(PARAMETERS)}
NUMBERS = len(PARAMETERS)
# All parameters of a law as one record: the same memory as an array of NUMBERS floats in the order of PARAMETERS.
LAW_NUMBERS = np.dtype([(parameter.name, "f8") for parameter in PARAMETERS])

# The places in the record of the numbers of a form: the parameter's own, then two more
PLACES = {
    name: (INDEX[name], INDEX[f"{more}_1"], INDEX[f"{more}_2"])
    for name, more in (("restitution", "restitution"), ("friction", "friction"), ("tangential_restitution", "last"),
                       ("stiffness_ratio", "last"))
}  # fmt: skip

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
    shape: str = ""
    """Of a form along the wall: linear or exponential,"""
    variable: str = ""
    """in one of VARIABLES."""

    def like(self, constant: float, speed: float) -> tuple[float, float, float]:
        """Return the three numbers with which the form has about this value at a speed, and near it."""
        if any(one.name.endswith("_at_speed") for one in self.parameters):
            return constant, constant, 1.0
        if [one.name for one in self.parameters] == ["restitution_c"]:
            return float(viscous_loss(constant)) / speed**0.2, 0.0, 0.0
        if "restitution_exponent" in [one.name for one in self.parameters]:
            return constant, speed, 0.0
        return constant, 0.0, 0.0

    def for_scene(self, name: str, values: Sequence[float]) -> float | dict[str, Any] | None:
        """Return the ``restitution`` of a wall in a scene, for the values of the parameters; None for a line, which scenes lack."""
        if name == "line":
            return None
        return values[0] if name == "constant" else self.table(name, values)

    def table(self, name: str, values: Sequence[float]) -> dict[str, Any]:
        """Return the form with its fields, as a table of a scene has them."""
        values = values[: len(self.parameters)]
        if name in ("polynomial", "linear"):
            return {"form": name, "coefficients": list(values)}
        fields = (
            re.sub("^(restitution|friction|tangential_restitution|stiffness_ratio)_", "", one.name)
            for one in self.parameters
        )
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
    "power": Form(
        2,
        (
            _e("restitution_at_rest", 0.0, 1.0, 0.6, 0.8, 0.95),
            Parameter("restitution_speed", 0.01, 100.0, (0.5, 2.0), 1.0, "m/s"),
            _e("restitution_exponent", 0.0, 2.0, 0.1, 0.25),
        ),
        "e = at_rest (v_n / speed)^-exponent, at_rest below the speed (Johnson 1985, 11.5)",
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

# Of the impact, on which friction, tangential restitution and stiffness ratio may depend; each with its unit
VARIABLES = {"v_n": "m/s", "slip": "m/s", "slip/v_n": "", "speed": "m/s"}
SHAPES = ("constant", "linear", "exponential")
_USUAL = {"friction": "slip", "tangential_restitution": "slip/v_n", "stiffness_ratio": "slip/v_n"}
_TRIED = {
    "friction": (0.06, 0.15, 0.3, 0.9),
    "tangential_restitution": (-0.5, 0.0, 0.5),
    "stiffness_ratio": (0.5, 0.82, 1.8),
}
RESTITUTION_FORMS, ALONG_FORMS = 8, 4 * len(VARIABLES)  # numbers of codes of the forms, of each parameter


def _forms_along(parameter: str) -> dict[str, Form]:
    """Return the forms of friction, tangential restitution or stiffness ratio by their names: "linear:slip", shape and variable.

    The variable may be omitted: slip for the friction, slip/v_n for the others.
    """
    one = PARAMETERS[INDEX[parameter]]
    tried, size, found = (
        _TRIED[parameter],
        2.0 if parameter == "friction" else 5.0,
        {"constant": Form(0, (one,), parameter)},
    )
    for v, variable in enumerate(VARIABLES):
        first = Parameter(f"{parameter}_0", one.low, one.high, tried, tried[0])
        slope = Parameter(f"{parameter}_1", -size, size, (-0.05, 0.0, 0.05), 0.0, "s/m" if VARIABLES[variable] else "")
        formula = f"{parameter}_0 + {parameter}_1 {variable}, within its bounds"
        linear = Form(4 * v + 1, (first, slope), formula, "linear", variable)
        ends = (Parameter(f"{parameter}_{end}", one.low, one.high, tried, tried[0]) for end in ("at_rest", "at_speed"))
        reach = Parameter(f"{parameter}_speed", 0.01, 100.0, (1.0,), 1.0, VARIABLES[variable])
        formula = f"at_speed + (at_rest - at_speed) exp(-{variable} / {parameter}_speed)"
        exponential = Form(4 * v + 2, (*ends, reach), formula, "exponential", variable)
        found |= {f"linear:{variable}": linear, f"exponential:{variable}": exponential}
    return found | {shape: found[f"{shape}:{_USUAL[parameter]}"] for shape in SHAPES[1:]}


ALONG = {parameter: _forms_along(parameter) for parameter in _USUAL}
"""Forms of the parameters along the wall, by parameter and name."""
