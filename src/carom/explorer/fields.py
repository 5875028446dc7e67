"""The fields of a scene as data: what the page checks numbers by, and names them by, is what Python checks them by.

Read from the models of :mod:`carom.scene`, so that a bound and a text stand in one place.
"""

from __future__ import annotations

from collections.abc import Iterator
from types import UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from pydantic.fields import FieldInfo

from carom.explorer.entries import PARTS
from carom.formatting import json_value
from carom.laws.registry import laws, laws_of_pairs
from carom.scene.air import DRAG, LIFT, SceneAir
from carom.scene.ball import KAPPA, RUBBING, BallContact
from carom.scene.presets import presets
from carom.scene.restitution import Constant, Exponential, Han2005, Polynomial, Power, Viscoelastic
from carom.scene.scene import GRAVITY, Run, Scene
from carom.scene.schema import EXPECTED, Acceleration, Components, Model, Number, Whole
from carom.scene.shapes import PAGE_SHAPES

FORMS = (Constant, Polynomial, Han2005, Power, Viscoelastic, Exponential)


def _within(annotation: Any) -> Iterator[type[Model]]:
    """Yield the models that a field's type names, and those within them first; the forms of a restitution are none."""
    if isinstance(annotation, type) and issubclass(annotation, Model) and annotation not in FORMS:
        for info in annotation.model_fields.values():
            yield from _within(info.annotation)
        yield annotation
    for one in get_args(annotation):
        yield from _within(one)


NAMED: dict[str, type[Model]] = {
    **PARTS,
    "ball_contact": BallContact,
    "run": Run,
    "air": SceneAir,
    **{
        part.__name__.lower(): part
        for shape in PAGE_SHAPES.values()
        for info in shape.model_fields.values()
        for part in _within(info.annotation)
    },
}


def scene_fields() -> dict[str, Any]:
    """Return the parts of a scene by name, ``wall`` and ``restitution`` by their shape and form.

    A field is a number with its bounds, a vector or a list, a flag, a choice, a text, a whole number, or ``of`` a part. ``what`` is
    expected in its place.
    """
    return {
        "scene": _part(Scene, walls={"kind": "list", "what": "a list", "each": {"of": "wall"}}, balls={
            "kind": "list", "what": "a list", "each": {"of": "ball"}, "least": "at least one ball"
        }),
        **{name: _part(model, rules=name if name in PARTS else None) for name, model in NAMED.items()},
        "wall": {
            "kind": "tagged", "tag": "shape",
            "options": {name: _part(shape, rules=name) for name, shape in PAGE_SHAPES.items()},
        },
        "restitution": {
            "kind": "tagged", "tag": "form", "what": "a number from 0 to 1, or a table { form = ... }",
            "options": {model.model_fields["form"].default: _part(model) for model in FORMS},
        },
    }  # fmt: skip


def _part(model: type[Model], rules: str | None = None, **own: Any) -> dict[str, Any]:
    # (a strike has become velocity and spin, a rack positions, and temperature and pressure density, before a scene is shown)
    without = ("strike", "rack", "temperature", "pressure")
    names = [name for name in model.model_fields if name not in without]
    fields = {name: own.get(name) or _field(model, name, model.model_fields[name]) for name in names}
    return {"kind": "part", "what": "a table of fields", "fields": fields, "rules": rules}


def _field(model: type[Model], name: str, info: FieldInfo) -> dict[str, Any]:  # noqa: PLR0911  (one return a kind)
    if name == "inertia":
        return {**_number(KAPPA), "words": ["solid", "hollow"]}
    if name in ("drag", "lift"):
        own = DRAG if name == "drag" else LIFT
        return {**_number(own.number), "words": own.names, "optional": True}
    if name == "gravity":
        return {"kind": "vector", "what": GRAVITY.what, "counts": [3, 3], "each": _described(Acceleration, [])}
    if name == "friction" and model is BallContact:
        return {**_number(RUBBING), "part": "falling_friction"}
    if name == "law":
        known = laws_of_pairs() if model is BallContact else [one.name for one in laws().values() if one.kernel]
        what = f"one of {', '.join(known)}, or file.py:name"
        return {"kind": "choice", "what": what, "values": known, "optional": info.default is None}
    if name == "preset":
        values = list(presets())
        return {"kind": "choice", "what": f"one of {', '.join(values)}", "values": values, "optional": True}
    # (a scene without air is shown without its numbers)
    says_nothing = name == "spin_decay" or (isinstance(info.default, Model) and _says_nothing(info.default))
    optional = {"optional": True} if says_nothing else {}
    return {**_described(info.annotation, list(info.metadata)), **optional}


def _says_nothing(part: Model) -> bool:
    """Return whether a part has no value of its own in any field: then it may be left out, as the sides of a table."""
    return all(value is None or (isinstance(value, Model) and _says_nothing(value)) for _name, value in part)


def _number(number: Number) -> dict[str, Any]:
    return {
        "kind": "number", "what": number.what, "unit": number.unit,
        "least": json_value(number.least), "most": json_value(number.most), "above": number.above, "infinite": number.infinite,
    }  # fmt: skip


def _described(annotation: Any, metadata: list[Any]) -> dict[str, Any]:  # noqa: PLR0911  (one return a kind)
    while get_origin(annotation) is Annotated:
        annotation, *more = get_args(annotation)
        metadata = [*metadata, *more]
    if get_origin(annotation) in (Union, UnionType):
        options = [one for one in get_args(annotation) if one is not type(None)]
        optional = {"optional": True} if len(options) < len(get_args(annotation)) else {}
        return {**(_described(options[0], metadata) if len(options) == 1 else {"of": "restitution"}), **optional}
    checks = [getattr(one, "func", None) for one in metadata]
    check = next((one for one in checks if isinstance(one, Components | Number | Whole)), None)
    if isinstance(check, Components):
        each = _described(next(one for one in get_args(annotation) if one is not Ellipsis), [])
        found = {"kind": "vector", "what": check.what, "counts": [check.counts[0], check.counts[-1]], "each": each}
        return {**found, **({"nonzero": True} if check.what.endswith("a direction") else {})}
    if isinstance(check, Number):
        return _number(check)
    if isinstance(check, Whole):
        return {"kind": "whole", "what": check.what, "least": check.least}
    if get_origin(annotation) is Literal:
        values = get_args(annotation)
        return {"kind": "choice", "what": " or ".join(map(repr, values)), "values": list(values)}
    if part := next((name for name, model in NAMED.items() if model is annotation), None):
        return {"of": part}
    if annotation is bool:
        return {"kind": "flag", "what": EXPECTED["bool_type"]}
    return {"kind": "text", "what": EXPECTED["string_type"]}
