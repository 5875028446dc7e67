"""The faults of a scene: pydantic's errors, as one line each. Where, what was expected, what came, what to do."""

from __future__ import annotations

from dataclasses import dataclass
from difflib import get_close_matches
from typing import Any, ClassVar, get_args

from pydantic import BaseModel, ConfigDict, ValidationError
from pydantic_core import InitErrorDetails, PydanticCustomError

from carom.checks import nearest
from carom.errors import CaromError

__all__ = ["Fault", "Model", "Words", "refuse", "told"]

EXPECTED = {
    "tuple_type": "a list",
    "model_type": "a table of fields",
    "model_attributes_type": "a table of fields",
    "string_type": "text",
    "bool_type": "true or false",
}


class Words(str):
    """Something that came, in words: told without quotes."""

    __slots__ = ()


@dataclass(frozen=True)
class Fault:
    """What was expected, what came instead, what to do; and where, below the model that finds it."""

    expected: str
    got: Any
    advice: str = ""
    at: tuple[int | str, ...] = ()

    def error(self) -> PydanticCustomError:
        """The fault as what pydantic gathers."""
        context = {"expected": self.expected, "got": _shown(self.got), "advice": self.advice}
        return PydanticCustomError("carom", "expected {expected}, got {got}", context)


def refuse(faults: list[Fault]) -> None:
    """Raise all faults at once from inside a validator, if there are any."""
    if faults:
        details = [InitErrorDetails(type=fault.error(), loc=fault.at, input=fault.got) for fault in faults]
        raise ValidationError.from_exception_data("scene", details)


class Model(BaseModel):
    """A part of a scene. It is checked when it is made, and does not change afterwards.

    Raises CaromError with one line a fault, all at once; unknown fields are refused.
    """

    model_config = ConfigDict(extra="forbid", frozen=True, ser_json_inf_nan="constants", arbitrary_types_allowed=True)
    tag: ClassVar[str] = ""
    """The field that tells which of several models one is: shape, form."""

    def __init__(self, **fields: Any) -> None:
        try:
            super().__init__(**fields)
        except ValidationError as error:
            raise CaromError(*told(type(self).__name__, error, type(self))) from None

    # Inside another model pydantic makes this one itself, and gathers its faults with all the others.
    __init__.__pydantic_base_init__ = True  # type: ignore[attr-defined]


def told(where: str, error: ValidationError, model: type[Model]) -> list[str]:
    """One line for each of pydantic's errors about a model."""
    return [_line(where, one, model) for one in error.errors(include_url=False)]


def _line(where: str, error: Any, model: type[Model]) -> str:
    path, owner, field, inside = _resolve(error["loc"], model)
    at = f"{where}: {path}" if path else where
    kind, context, value = error["type"], error.get("ctx", {}), error["input"]
    if kind == "carom":
        advice = f"; {context['advice']}" if context["advice"] else ""
        return f"{at}: expected {context['expected']}, got {context['got']}{advice}"
    if kind == "extra_forbidden":
        return f"{at}: expected a field that is known here, got {field!r}; {nearest(field, list(owner.model_fields))}"
    if kind in {"union_tag_invalid", "union_tag_not_found"}:
        return _choice(at, value, inside)
    if kind == "missing":
        return f"{at}: expected {_expectation(owner, field)}, got nothing"
    expected = EXPECTED.get(kind) or context.get("expected") or error["msg"]
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
    """What a field is to be, from its type."""
    for one in owner.model_fields[field].metadata:
        what = getattr(getattr(one, "func", None), "what", None)
        if what is not None:
            return str(what)
    return "a value"


def _shown(value: Any) -> str:
    if isinstance(value, Words):
        return str(value)
    text = repr(value)
    return text if len(text) <= 80 else f"{text[:77]}..."
