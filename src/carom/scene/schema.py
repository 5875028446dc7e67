"""Fields of a scene: numbers with units and bounds, vectors; and error messages, one line per problem.

A message says where, what was expected, what was found, and how to fix it; all problems of a scene are reported at once.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from numbers import Real
from typing import Annotated, Any, ClassVar, TypeVar, get_args

import numpy as np
from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Strict, ValidationError
from pydantic_core import InitErrorDetails, PydanticCustomError, PydanticKnownError, core_schema
from pydantic_core.core_schema import ValidationInfo

from carom.core.units import parse_quantity
from carom.errors import (
    MAX_MAGNITUDE,
    MIN_MAGNITUDE,
    CaromError,
    Fault,
    did_you_mean,
    near_name,
    shown,
    suggestion,
    with_size_limit,
)
from carom.public.guard import called_from_outside

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


def refused(expected: str, got: str = "", advice: str = "", field: str = "") -> PydanticCustomError:
    """Return the error of a validator, which pydantic collects; ``field`` lies below the model or field that is validated."""
    return _error(Fault("", field, expected, got, advice))


def _error(fault: Fault) -> PydanticCustomError:
    return PydanticCustomError("carom", "{said}", {"said": str(fault), "fault": fault})


def raise_faults(faults: Iterable[Fault]) -> None:
    """Raise all problems at once from inside a validator, if there are any; their fields lie below what is validated."""
    if details := [InitErrorDetails(type=_error(fault), input=None) for fault in faults]:
        raise ValidationError.from_exception_data("scene", details)


def with_faults_of_part(make: Callable[[], Any]) -> Any:
    """Return the result of ``make``; the faults of its arguments become faults of the fields with the same names."""
    try:
        return make()
    except CaromError as error:
        raise_faults(error.records_at(""))


class Model(BaseModel):
    """A part of a scene: validated when it is made, immutable afterwards.

    Raises CaromError with one line for each problem; unknown fields are refused.
    """

    model_config = ConfigDict(extra="forbid", frozen=True, ser_json_inf_nan="constants", arbitrary_types_allowed=True)
    tag: ClassVar[str] = ""
    """The field that tells which of several models one is: shape, form."""
    absent: ClassVar[dict[str, str]] = {}
    """Fields that it has not although others have, and why."""

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
            raise CaromError(*faults_of(type(self).__name__, error, type(self))) from None

    # Inside another model pydantic makes this one itself, and gathers its faults with all the others.
    __init__.__pydantic_base_init__ = True  # type: ignore[attr-defined]

    def __eq__(self, other: object) -> bool:
        """Return whether another one of this class was declared alike: what is kept beside its fields does not count."""
        if type(self) is not type(other):
            return NotImplemented
        return all(getattr(self, name) == getattr(other, name) for name in type(self).model_fields)

    def __hash__(self) -> int:
        """Return a hash of its class and its fields."""
        return hash((type(self), *(getattr(self, name) for name in type(self).model_fields)))

    def __setattr__(self, name: str, value: Any) -> None:
        """Refuse: a scene is validated as a whole, when it is made."""
        raise CaromError(
            Fault(
                type(self).__name__,
                "",
                "no assignment",
                f"{name} = {value!r:.60}",
                "carom.replaced(scene, {PATH: value}) returns a changed copy",
            )
        )


OWN_LAWS = {"own_laws": True}  # pydantic's context, where custom laws may run


def runs_own_laws(info: ValidationInfo) -> bool:
    """Return whether what is validated may name a Python file as a law, which is then run: only where that is said."""
    return bool((info.context or {}).get("own_laws"))


_Model = TypeVar("_Model", bound=Model)


def checked_part(model: type[_Model], value: Any) -> _Model:
    """Return the model of a part of a scene that stands in the place of a number; it runs no code."""
    try:
        return model.model_validate(value)
    except ValidationError as error:  # (whose places lie in that model)
        raise_faults(faults_of("", error, model))
        raise


def from_file(where: str, model: type[_Model], table: Any, *, allow_own_laws: bool = False) -> _Model:
    """Return the model of a table that a file holds: the one way from any file to a scene.

    Opening a file runs no code: a custom law in the table is a fault, unless ``allow_own_laws``. Raises CaromError, one line per
    problem, each beginning with ``where``.
    """
    try:
        return model.model_validate(table, context=OWN_LAWS if allow_own_laws else None)
    except ValidationError as error:
        raise CaromError(*faults_of(where, error, model)) from None


def faults_of(where: str, error: ValidationError, model: type[Model]) -> list[Fault]:
    """Return pydantic's errors about a model as faults."""
    return [_fault(where, one, model) for one in error.errors(include_url=False)]


def _fault(where: str, error: Any, model: type[Model]) -> Fault:
    path, owner, field, inside = _resolve(error["loc"], model)
    kind, context, value = error["type"], error.get("ctx", {}), error["input"]
    if kind == "carom":
        fault: Fault = context["fault"]
        dot = "." if path and fault.field and not fault.field.startswith("[") else ""
        return replace(fault, where=where, field=f"{path}{dot}{fault.field}")
    if kind == "extra_forbidden":
        absent = owner.absent | ({"diameter": "give the radius, half of it"} if "radius" in owner.model_fields else {})
        advice = absent.get(field) or suggestion(field, list(owner.model_fields))
        return Fault(where, path, "a field that is known here", repr(field), advice)
    if kind in {"union_tag_invalid", "union_tag_not_found"}:
        return _choice(where, path, value, inside)
    if kind == "missing":
        return Fault(where, path, _expectation(owner, field), "nothing")
    expected = EXPECTED.get(kind, "").format(**context) or context.get("expected") or error["msg"]
    brackets = f"write [[{path}]], with double brackets" if kind == "tuple_type" and isinstance(value, dict) else ""
    return Fault(where, path, expected, shown(value), brackets)


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


def _choice(where: str, path: str, value: Any, inside: list[type[Model]]) -> Fault:
    """The fault of a table whose tag is unknown, or has none."""
    tag, names = inside[0].tag, [_tag(one) for one in inside]
    fields = value if isinstance(value, dict) else {}
    if tag in fields:
        got, advice = shown(fields[tag]), did_you_mean(str(fields[tag]), names)
    else:
        near = near_name(tag, list(fields))
        got, advice = "nothing", f"is {near!r} meant to be {tag!r}?" if near else ""
    return Fault(where, f"{path}.{tag}" if path else tag, f"one of {', '.join(names)}", got, advice)


def _expectation(owner: type[Model], field: str) -> str:
    """Expectation of a field, from its type."""
    for one in owner.model_fields[field].metadata:
        what = getattr(getattr(one, "func", None), "what", None)
        if what is not None:
            return str(what)
    return "a value"


class OneOf:
    """Metadata of a field that takes one of several models, each by the text of its tag.

    pydantic builds a model when it is first used: building those of all shapes takes a quarter of a second.
    """

    def __init__(self, models: Mapping[str, type[Model]]) -> None:
        self.models = models

    def __get_pydantic_core_schema__(self, _source: Any, _handler: Any) -> Any:
        """Return pydantic's schema of the field."""
        written = core_schema.plain_serializer_function_ser_schema(_written, info_arg=True)
        return core_schema.with_info_plain_validator_function(self._made, serialization=written)

    def _made(self, value: Any, info: ValidationInfo) -> Any:
        kinds = list(self.models.values())
        if isinstance(value, tuple(kinds)):
            return value
        if not isinstance(value, Mapping):
            raise PydanticKnownError("model_attributes_type")
        model = self.models.get(str(value.get(kinds[0].tag)))
        if model is None:
            raise _error(_choice("", "", value, kinds))
        try:
            return model.model_validate(value, context=info.context)
        except ValidationError as error:
            raise_faults(faults_of("", error, model))
            raise


def _written(value: Model, info: Any) -> dict[str, Any]:
    return value.model_dump(mode=info.mode)


Vector = tuple[float, float, float]
EXAMPLES = {
    "m": "61.5 mm", "m/s": "2 m/s", "m/s^2": "9.81 m/s^2", "kg": "210 g", "s": "10 s", "rad/s": "30 rev/s", "degree": "0.5 rad",
    "J": "2 uJ", "1/s": "50 Hz", "s/m": "0.002 s/m", "rad/m": "2 rad/m", "Pa": "5.84 GPa",
    "K": "20 degC", "kg/m^3": "1.2 kg/m^3", "kg/m^2": "20 kg/m^2", "Pa*s": "18.1 uPa*s",
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
        if self.infinite and isinstance(value, str) and value in ("inf", "-inf"):  # (as JSON has it)
            x = float(value)
        elif isinstance(value, str) and self.unit:
            try:
                x, advice = parse_quantity(value, self.unit), ""
            except ValueError as error:
                advice = str(error) or advice
        elif isinstance(value, Real) and not isinstance(value, bool):
            x = _float(value)
        elif isinstance(value, np.ndarray) and value.ndim == 0 and value.dtype.kind in "iuf":
            x = float(value)
        held = self.least < x if self.above else self.least <= x
        least = MIN_MAGNITUDE if self.above else 0.0
        if not (held and x <= self.most and (least <= abs(x) <= MAX_MAGNITUDE or (self.infinite and math.isinf(x)))):
            raise refused(with_size_limit(self.what, x), shown(value), advice)
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
        raise refused(self.what, shown(value))


@dataclass(frozen=True)
class Whole:
    """Expectation of a whole number."""

    what: str
    least: int

    def __call__(self, value: Any) -> int:
        """The number as an int; TOML and Python write large ones as 2e4, too."""
        if isinstance(value, float) and value.is_integer():
            value = int(value)
        if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or value < self.least:
            raise refused(self.what, shown(value))
        if value >= 1 << 63:
            raise refused("a whole number < 2^63", shown(value))
        return int(value)


def _not_zero(value: Vector) -> Vector:
    if not any(value):
        raise refused("a direction, not all zero", repr(list(value)))
    return value


Flag = Annotated[bool, Strict()]
Count = Annotated[int, BeforeValidator(Whole("a whole number >= 1", 1))]
CountOrZero = Annotated[int, BeforeValidator(Whole("a whole number >= 0", 0))]
Coefficient = Annotated[float, BeforeValidator(Number("a number"))]
PositiveNumber = Annotated[float, BeforeValidator(Number("a number > 0", least=0, above=True))]
NotNegative = Annotated[float, BeforeValidator(Number("a number >= 0", least=0))]
Share = Annotated[float, BeforeValidator(Number("a number from 0 to 1", least=0, most=1))]
Spring = Annotated[float, BeforeValidator(Number("a number from -1 to 1", least=-1, most=1))]
Drag = Annotated[float, BeforeValidator(Number("a number in s/m, >= 0", "s/m", least=0))]
SpinDamping = Annotated[float, BeforeValidator(Number("a rate in 1/s, >= 0", "1/s", least=0))]
SpinDrag = Annotated[float, BeforeValidator(Number("a number in rad/m, >= 0", "rad/m", least=0))]
Friction = Annotated[
    float, BeforeValidator(Number("a number >= 0 (inf: never slips)", least=0, infinite=True))
]  # fmt: skip

Fall = Annotated[float, BeforeValidator(Number("a number from -1 to 1", least=-1, most=1))]
Slope = Annotated[
    tuple[Fall, Fall], BeforeValidator(Components("2 numbers: how far the floor falls per metre along x, y", (2,)))
]

Length = Annotated[float, BeforeValidator(Number("a length in m", "m"))]
Size = Annotated[float, BeforeValidator(Number("a length in m, > 0", "m", least=0, above=True))]
Gap = Annotated[float, BeforeValidator(Number("a length in m, >= 0", "m", least=0))]
Extent = Annotated[float, BeforeValidator(Number("a length in m, or inf", "m", infinite=True))]
Mass = Annotated[float, BeforeValidator(Number("a mass in kg, > 0", "kg", least=0, above=True))]
Modulus = Annotated[float, BeforeValidator(Number("Young's modulus in Pa, > 0", "Pa", least=0, above=True))]
PoissonRatio = Annotated[float, BeforeValidator(Number("Poisson's ratio, from 0 to 0.5", least=0, most=0.5))]
Time = Annotated[float, BeforeValidator(Number("a time in s, > 0", "s", least=0, above=True))]
ContactTime = Annotated[float, BeforeValidator(Number("a time in s, from 0 to 1", "s", least=0, most=1))]
YieldTime = Annotated[float, BeforeValidator(Number("a time in s, from 0 to 0.1", "s", least=0, most=0.1))]
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
