"""Restitution as a scene has it: a number, or one of the published forms of the normal speed."""

from __future__ import annotations

from abc import abstractmethod
from typing import Annotated, Any, ClassVar, Literal

from pydantic import BeforeValidator, Field

from carom.core.motion.phases import CONSTANT, EXPONENTIAL, POLYNOMIAL, POWER, VISCOELASTIC, restitution
from carom.scene.schema import Coefficient, Components, Model, Number, PositiveNumber, Share, Vector

FasterThanNothing = Annotated[float, BeforeValidator(Number("a speed in m/s, > 0", "m/s", least=0, above=True))]


class Restitution(Model):
    """Coefficient of restitution as a function of the normal approach speed."""

    tag: ClassVar[str] = "form"
    code: ClassVar[int]

    @property
    @abstractmethod
    def p(self) -> Vector:
        """Return the three numbers of the form, as :func:`carom.core.motion.phases.restitution` takes them."""

    def at(self, speed: float) -> float:
        """e at a normal speed (m/s)."""
        return float(restitution(self.code, self.p, speed))

    def describe(self) -> str:
        """Return a description of a few words."""
        return f"restitution of the form {getattr(self, self.tag)}"


class Constant(Restitution):
    """The same restitution at every speed; a plain number stands for it."""

    form: Literal["constant"] = "constant"
    value: Share
    code: ClassVar[int] = CONSTANT

    @property
    def p(self) -> Vector:
        """Return the number."""
        return (self.value, 0.0, 0.0)

    def describe(self) -> str:
        """Return a description of a few words."""
        return f"restitution {self.value:g}"


class Polynomial(Restitution):
    """e = c0 + c1 v + c2 v^2, held in [0, 1]; beyond a vertex it stays what it is there."""

    form: Literal["polynomial"] = "polynomial"
    coefficients: Annotated[
        tuple[Coefficient, Coefficient, Coefficient],
        BeforeValidator(Components("3 numbers: c0, c1, c2 of c0 + c1 v + c2 v^2, v in m/s", (3,))),
    ]
    code: ClassVar[int] = POLYNOMIAL

    @property
    def p(self) -> Vector:
        """c0, c1, c2."""
        return self.coefficients


class Han2005(Restitution):
    """The cushion of a carom table: Han, J. Mech. Sci. Technol. 19, 976 (2005), eq. (26)."""

    form: Literal["han-2005"] = "han-2005"
    code: ClassVar[int] = POLYNOMIAL

    @property
    def p(self) -> Vector:
        """Return Han's coefficients, v in m/s."""
        return (0.39, 0.257, -0.044)


class Power(Restitution):
    """e = at_rest (v / speed)^-exponent above a speed, at_rest below: plastic impact, exponent 1/4 (Johnson 1985)."""

    form: Literal["power"] = "power"
    at_rest: Share
    speed: FasterThanNothing
    exponent: PositiveNumber = 0.25
    code: ClassVar[int] = POWER

    @property
    def p(self) -> Vector:
        """Return value at rest, speed (m/s), exponent."""
        return (self.at_rest, self.speed, self.exponent)


class Viscoelastic(Restitution):
    """1 - c v^(1/5) + (3/5) c^2 v^(2/5) - ...: Ramirez, Poschel, Brilliantov & Schwager, Phys. Rev. E 60, 4465 (1999)."""

    form: Literal["viscoelastic"] = "viscoelastic"
    c: PositiveNumber
    code: ClassVar[int] = VISCOELASTIC

    @property
    def p(self) -> Vector:
        """c, in (s/m)^(1/5)."""
        return (self.c, 0.0, 0.0)


class Exponential(Restitution):
    """e = at_speed + (at_rest - at_speed) exp(-v / speed)."""

    form: Literal["exponential"] = "exponential"
    at_rest: Share
    at_speed: Share
    speed: FasterThanNothing
    code: ClassVar[int] = EXPONENTIAL

    @property
    def p(self) -> Vector:
        """Return value at rest, at high speed, and the speed (m/s) over which it changes."""
        return (self.at_rest, self.at_speed, self.speed)


_NUMBER = Number("a number from 0 to 1, or a table { form = ... }", least=0, most=1)


def _from_number(value: Any) -> Any:
    return value if isinstance(value, (dict, Restitution)) else Constant(value=_NUMBER(value))


Form = Annotated[
    Constant | Polynomial | Han2005 | Power | Viscoelastic | Exponential, Field(discriminator="form")
]  # fmt: skip
Bounce = Annotated[Form, BeforeValidator(_from_number)]
"""A field that takes a number or a form."""
