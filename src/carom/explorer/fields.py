"""The fields of a scene as data: what the page checks numbers by, and names them by, is what Python checks them by.

Read from the models of :mod:`carom.scene`, so that a bound stands in one place.
"""

from __future__ import annotations

from types import UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from pydantic.fields import FieldInfo

from carom.formatting import json_value
from carom.laws.registry import laws_of_pairs
from carom.scene.ball import SceneBall
from carom.scene.ball_contact import BallContact, FallingFriction
from carom.scene.floor import Floor
from carom.scene.pockets import Pockets
from carom.scene.restitution import Constant, Exponential, Han2005, Polynomial, Power, Viscoelastic
from carom.scene.scene import Run, Scene
from carom.scene.schema import Components, Model, Number
from carom.scene.shapes import PAGE_SHAPES

__all__ = ["scene_fields"]

FORMS = (Constant, Polynomial, Han2005, Power, Viscoelastic, Exponential)

# Fields of several types, which the page checks by their names.
OF_THEIR_OWN = ("gravity", "inertia", "law", "restitution")
POCKETS = ("corner_pockets", "side_pockets")


def scene_fields() -> dict[str, Any]:
    """Return the fields of each part of a scene by name: of walls by shape, of restitutions by form.

    A field is a number with its bounds, a vector of numbers with its possible lengths, a flag, a choice, a text, or a part.
    """
    return {
        "scene": _fields(Scene),
        "floor": _fields(Floor),
        "ball": _fields(SceneBall),
        "ball_contact": _pair_fields(),
        "run": _fields(Run),
        "walls": {name: _fields(shape) for name, shape in PAGE_SHAPES.items()},
        "pockets": _fields(Pockets),
        "restitution": {model.model_fields["form"].default: _fields(model) for model in FORMS},
    }


def _fields(model: type[Model]) -> dict[str, Any]:
    # (a strike has become velocity and spin, and a rack positions, before a scene is shown)
    return {name: _field(name, info) for name, info in model.model_fields.items() if name not in ("strike", "rack")}


def _pair_fields() -> dict[str, Any]:
    """Return the fields of a contact of two balls: its laws by their names, its friction with the form that falls with the slip."""
    friction = {"kind": "friction", "number": _fields(Floor)["friction"], "falling": _fields(FallingFriction)}
    return _fields(BallContact) | {
        "law": {"kind": "choice", "values": laws_of_pairs(), "optional": True}, "friction": friction
    }  # fmt: skip


def _field(name: str, info: FieldInfo) -> dict[str, Any]:
    found = _described(info.annotation, list(info.metadata))
    if name in OF_THEIR_OWN:
        found = {"kind": name, **({"optional": True} if found.get("optional") else {})}
    if name in POCKETS:
        found = {"kind": "pockets", "optional": True}
    if info.is_required():
        found["required"] = True
    return found


def _described(annotation: Any, metadata: list[Any]) -> dict[str, Any]:  # noqa: PLR0911  (one return a kind)
    while get_origin(annotation) is Annotated:
        annotation, *more = get_args(annotation)
        metadata = [*metadata, *more]
    if get_origin(annotation) in (Union, UnionType):
        options = [one for one in get_args(annotation) if one is not type(None)]
        optional = len(options) < len(get_args(annotation))
        found = _described(options[0], metadata) if len(options) == 1 else {"kind": "part"}
        return {**found, **({"optional": True} if optional else {})}
    checks = [getattr(one, "func", None) for one in metadata]
    counts = next((one for one in checks if isinstance(one, Components)), None)
    if get_origin(annotation) is tuple and counts is not None:
        each = _described(next(one for one in get_args(annotation) if one is not Ellipsis), [])
        found = {"kind": "vector", "what": counts.what, "counts": [counts.counts[0], counts.counts[-1]], "each": each}
        return {**found, **({"nonzero": True} if counts.what.endswith("a direction") else {})}
    number = next((one for one in checks if isinstance(one, Number)), None)
    if number is not None:
        return {
            "kind": "number", "what": number.what, "unit": number.unit,
            "least": json_value(number.least), "most": json_value(number.most), "above": number.above, "infinite": number.infinite,
        }  # fmt: skip
    if get_origin(annotation) is Literal:
        return {"kind": "choice", "values": list(get_args(annotation))}
    if annotation is bool:
        return {"kind": "flag"}
    if annotation is str:
        return {"kind": "text"}
    return {"kind": "whole"} if annotation is int else {"kind": "number"} if annotation is float else {"kind": "part"}
