"""Fields of a scene: numbers with units and bounds, vectors; and error messages, one line per problem.

A message says where, what was expected, what was found, and how to fix it; all problems of a scene are reported at once.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from difflib import get_close_matches
from numbers import Real
from typing import Annotated, Any, ClassVar, TypeVar, get_args

import numpy as np
from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Strict, ValidationError
from pydantic_core import InitErrorDetails, PydanticCustomError
from pydantic_core.core_schema import ValidationInfo

from carom.core.units import parse_quantity
from carom.errors import MAX_MAGNITUDE, MIN_MAGNITUDE, CaromError, suggestion, with_size_limit
from carom.public.callers import called_from_outside

__all__ = [
    "Acceleration",
    "Angle",
    "Coefficient",
    "Components",
    "Direction",
    "Extent",
    "Fault",
    "Flag",
    "Friction",
    "Length",
    "Mass",
    "Model",
    "NotNegative",
    "Number",
    "Place",
    "Point",
    "PositiveNumber",
    "Share",
    "Size",
    "Sizes",
    "Speed",
    "Spin",
    "Spring",
    "Time",
    "Unquoted",
    "Vector",
    "fault_lines",
    "from_file",
    "raise_faults",
    "runs_own_laws",
    "with_faults_of_part",
]

EXPECTED = {
    "tuple_type": "a list",
    "model_type": "a table of fields",
    "model_attributes_type": "a table of fields",
    "string_type": "text",
    "bool_type": "true or false",
    "greater_than": "a number > {gt:g}",
    "greater_than_equal": "a number >= {ge:g}",
    "less_than": "a number < {lt:g}",
    "less_than_equal": "a number <= {le:g}",
}


class Unquoted(str):
    """A text that a message shows without quotes."""

    __slots__ = ()


@dataclass(frozen=True)
class Fault:
    """A problem: what was expected, what was found, how to fix it, and where, below the model that finds it."""

    expected: str
    got: Any
    advice: str = ""
    at: tuple[int | str, ...] = ()

    def error(self) -> PydanticCustomError:
        """Return the problem as an error that pydantic collects."""
        context = {"expected": self.expected, "got": _shown(self.got), "advice": self.advice}
        return PydanticCustomError("carom", "expected {expected}, got {got}", context)


def raise_faults(faults: list[Fault]) -> None:
    """Raise all problems at once from inside a validator, if there are any."""
    if faults:
        details = [InitErrorDetails(type=fault.error(), loc=fault.at, input=fault.got) for fault in faults]
        raise ValidationError.from_exception_data("scene", details)


def with_faults_of_part(make: Callable[[], Any]) -> Any:
    """Return what ``make`` makes; its faults, "name: field: expected ..., got ...", become faults of a part of a scene."""
    try:
        return make()
    except CaromError as error:
        found = []
        for line in error.faults:
            _name, field, said = line.split(": ", 2)
            expected, got = said.removeprefix("expected ").split(", got ", 1)
            part = field if field.isidentifier() else field.partition("[")[0]
            found.append(Fault(expected, Unquoted(got), at=(part,)))
        raise_faults(found)


class Model(BaseModel):
    """A part of a scene: validated when it is made, immutable afterwards.

    Raises CaromError with one line for each problem; unknown fields are refused.
    """

    model_config = ConfigDict(extra="forbid", frozen=True, ser_json_inf_nan="constants", arbitrary_types_allowed=True)
    tag: ClassVar[str] = ""
    """The field that tells which of several models one is: shape, form."""

    def __init__(self, *unnamed: Any, **fields: Any) -> None:
        if unnamed:
            own, names = type(self).__name__, list(type(self).model_fields)
            raise CaromError(
                f"{own}: expected fields by name, of {', '.join(names)}, got {unnamed[0]!r:.60} without one"
            )
        # (who writes a program may name a file with a law in it; carom itself makes models of what came from anywhere)
        context = OWN_LAWS if called_from_outside() else None
        try:
            self.__pydantic_validator__.validate_python(fields, self_instance=self, context=context)
        except ValidationError as error:
            raise CaromError(*fault_lines(type(self).__name__, error, type(self))) from None

    # Inside another model pydantic makes this one itself, and gathers its faults with all the others.
    __init__.__pydantic_base_init__ = True  # type: ignore[attr-defined]

    def __setattr__(self, name: str, value: Any) -> None:
        """Refuse: a scene is validated as a whole, when it is made."""
        raise CaromError(
            f"{type(self).__name__}: expected no assignment, got {name} = {value!r:.60};"
            " carom.replaced(scene, {PATH: value}) returns a changed copy"
        )


OWN_LAWS = {"own_laws": True}  # pydantic's context, where custom laws may run


def runs_own_laws(info: ValidationInfo) -> bool:
    """Return whether what is validated may name a Python file as a law, which is then run: only where that is said."""
    return bool((info.context or {}).get("own_laws"))


_Model = TypeVar("_Model", bound=Model)


def from_file(where: str, model: type[_Model], table: Any, *, allow_own_laws: bool = False) -> _Model:
    """Return the model of a table that a file holds: the one way from any file to a scene.

    Opening a file runs no code: a custom law in the table is a fault, unless ``allow_own_laws``. Raises CaromError, one line per
    problem, each beginning with ``where``.
    """
    try:
        return model.model_validate(table, context=OWN_LAWS if allow_own_laws else None)
    except ValidationError as error:
        raise CaromError(*fault_lines(where, error, model)) from None


def fault_lines(where: str, error: ValidationError, model: type[Model]) -> list[str]:
    """Return one line for each of pydantic's errors about a model."""
    return [_line(where, one, model) for one in error.errors(include_url=False)]


def _line(where: str, error: Any, model: type[Model]) -> str:
    path, owner, field, inside = _resolve(error["loc"], model)
    at = f"{where}: {path}" if path else where
    kind, context, value = error["type"], error.get("ctx", {}), error["input"]
    if kind == "carom":
        advice = f"; {context['advice']}" if context["advice"] else ""
        return f"{at}: expected {context['expected']}, got {context['got']}{advice}"
    if kind == "extra_forbidden":
        halved = field == "diameter" and "radius" in owner.model_fields
        advice = "give the radius, half of it" if halved else suggestion(field, list(owner.model_fields))
        return f"{at}: expected a field that is known here, got {field!r}; {advice}"
    if kind in {"union_tag_invalid", "union_tag_not_found"}:
        return _choice(at, value, inside)
    if kind == "missing":
        return f"{at}: expected {_expectation(owner, field)}, got nothing"
    expected = EXPECTED.get(kind, "").format(**context) or context.get("expected") or error["msg"]
    brackets = f"; write [[{path}]], with double brackets" if kind == "tuple_type" and isinstance(value, dict) else ""
    return f"{at}: expected {expected}, got {_shown(value)}{brackets}"


def _resolve(location: tuple[int | str, ...], model: type[Model]) -> tuple[str, type[Model], str, list[type[Model]]]:
    """A location as people write it, the model it lies in, the field, and the models that the field may hold."""
    path, owner, field, inside = "", model, "", [model]
    for part in location:
        tagged = {_tag(one): one for one in inside} if len(inside) > 1 else {}
        if isinstance(part, int):
            path += f"[{part}]"
        elif part in tagged:  # which of several models it is; not a field
            inside = [tagged[part]]
            owner = tagged[part]
        else:
            owner, field = inside[0] if len(inside) == 1 else owner, part
            path += f".{part}" if path else part
            known = owner.model_fields.get(field)
            inside = _models(known.annotation) if known else []
    return path, owner, field, inside


def _tag(model: type[Model]) -> str:
    return str(model.model_fields[model.tag].default)


def _models(annotation: Any) -> list[type[Model]]:
    """The models in a type."""
    if isinstance(annotation, type) and issubclass(annotation, Model):
        return [annotation]
    return [found for part in get_args(annotation) for found in _models(part)]


def _choice(at: str, value: Any, inside: list[type[Model]]) -> str:
    """The fault of a table whose tag is unknown, or has none."""
    tag, names = inside[0].tag, [_tag(one) for one in inside]
    fields = value if isinstance(value, dict) else {}
    got = _shown(fields[tag]) if tag in fields else "nothing"
    line = f"{at}.{tag}: expected one of {', '.join(names)}, got {got}"
    if tag in fields:
        close = get_close_matches(str(fields[tag]), names, n=1, cutoff=0.5)
        return f"{line}; did you mean {close[0]!r}?" if close else line
    close = get_close_matches(tag, list(fields), n=1, cutoff=0.5)
    return f"{line}; is {close[0]!r} meant to be {tag!r}?" if close else line


def _expectation(owner: type[Model], field: str) -> str:
    """Expectation of a field, from its type."""
    for one in owner.model_fields[field].metadata:
        what = getattr(getattr(one, "func", None), "what", None)
        if what is not None:
            return str(what)
    return "a value"


def _shown(value: Any) -> str:
    if isinstance(value, Unquoted):
        return str(value)
    text = repr(value)
    return text if len(text) <= 80 else f"{text[:77]}..."


Vector = tuple[float, float, float]
EXAMPLES = {
    "m": "61.5 mm", "m/s": "2 m/s", "m/s^2": "9.81 m/s^2", "kg": "210 g", "s": "10 s", "rad/s": "30 rev/s", "degree": "0.5 rad",
    "J": "2 uJ", "1/s": "50 Hz",
}  # fmt: skip


@dataclass(frozen=True)
class Number:
    """Expectation of a number; a call returns the value as a float, or raises the problem.

    With a unit, a string like "61.5 mm" is a number too. ``above``: greater than ``least``, not equal to it.
    """

    what: str
    unit: str = ""
    least: float = -math.inf
    most: float = math.inf
    above: bool = False
    infinite: bool = False

    def __call__(self, value: Any) -> float:
        """The number as a float."""
        x = math.nan
        advice = f"units are written as in {EXAMPLES[self.unit]!r}" if self.unit and isinstance(value, str) else ""
        if isinstance(value, str) and self.unit:
            try:
                x = parse_quantity(value, self.unit)
            except ValueError as error:
                advice = str(error) or advice
        elif isinstance(value, Real) and not isinstance(value, bool):
            x = _float(value)
        elif isinstance(value, np.ndarray) and value.ndim == 0 and value.dtype.kind in "iuf":
            x = float(value)
        held = self.least < x if self.above else self.least <= x
        least = MIN_MAGNITUDE if self.above else 0.0
        if not (held and x <= self.most and (least <= abs(x) <= MAX_MAGNITUDE or (self.infinite and math.isinf(x)))):
            raise Fault(with_size_limit(self.what, x), value, advice).error()
        return x


def _float(value: Real) -> float:
    try:
        return float(value)
    except OverflowError:
        return math.nan


@dataclass(frozen=True)
class Components:
    """Expectation of a vector: the number of its components. They are validated afterwards, one by one."""

    what: str
    counts: tuple[int, ...]

    def __call__(self, value: Any) -> tuple[Any, ...]:
        """The components as a tuple."""
        number = isinstance(value, np.ndarray) and value.ndim == 0  # (which says that it can be iterated over)
        if isinstance(value, Iterable) and not isinstance(value, (str, dict, set)) and not number:
            parts = tuple(value)
            if len(parts) in self.counts:
                return parts
        raise Fault(self.what, value).error()


def _not_zero(value: Vector) -> Vector:
    if not any(value):
        raise Fault("a direction, not all zero", list(value)).error()
    return value


Flag = Annotated[bool, Strict()]
Coefficient = Annotated[float, BeforeValidator(Number("a number"))]
PositiveNumber = Annotated[float, BeforeValidator(Number("a number > 0", least=0, above=True))]
NotNegative = Annotated[float, BeforeValidator(Number("a number >= 0", least=0))]
Share = Annotated[float, BeforeValidator(Number("a number from 0 to 1", least=0, most=1))]
Spring = Annotated[float, BeforeValidator(Number("a number from -1 to 1", least=-1, most=1))]
Friction = Annotated[
    float, BeforeValidator(Number("a number >= 0 (inf: never slips)", least=0, infinite=True))
]  # fmt: skip

Length = Annotated[float, BeforeValidator(Number("a length in m", "m"))]
Size = Annotated[float, BeforeValidator(Number("a length in m, > 0", "m", least=0, above=True))]
Extent = Annotated[float, BeforeValidator(Number("a length in m, or inf", "m", infinite=True))]
Mass = Annotated[float, BeforeValidator(Number("a mass in kg, > 0", "kg", least=0, above=True))]
Time = Annotated[float, BeforeValidator(Number("a time in s, > 0", "s", least=0, above=True))]
Speed = Annotated[float, BeforeValidator(Number("a speed in m/s", "m/s"))]
Spin = Annotated[float, BeforeValidator(Number("a spin in rad/s", "rad/s"))]
Acceleration = Annotated[float, BeforeValidator(Number("an acceleration in m/s^2", "m/s^2"))]
Angle = Annotated[float, BeforeValidator(Number("an angle in degrees", "degree"))]

Point = Annotated[
    tuple[Length, Length, Length], BeforeValidator(Components("3 lengths in m: x, y, z", (3,)))
]  # fmt: skip
Place = Annotated[
    tuple[Length, Length], BeforeValidator(Components("2 lengths in m: x, y, as seen from above", (2,)))
]  # fmt: skip
Sizes = Annotated[
    tuple[Size, Size, Size], BeforeValidator(Components("3 lengths in m, > 0: along x, y, z", (3,)))
]  # fmt: skip
Direction = Annotated[
    tuple[Coefficient, Coefficient, Coefficient],
    BeforeValidator(Components("3 numbers: a direction", (3,))),
    AfterValidator(_not_zero),
]
