"""The explorer's WebAssembly module and its description: what lies in the package, and what today's sources would make.

``engine.wasm`` holds the event loop and the laws; ``engine.json`` says where the fields of its records are, which laws there are
and what they read, and what numbers in its logs mean. Both carry the hash of the kernels' sources: a page refuses one of another.
"""

from __future__ import annotations

import functools
import json
import math
import sys
from collections.abc import Iterator
from importlib import resources
from pathlib import Path
from types import UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

import numpy as np
from pydantic.fields import FieldInfo

from carom.core.geometry.features import CURVE, FACE, FALLS, FEATURES, GOES_ON, LEAVES, LINE, OVER, POINT, RIM
from carom.core.jit.cache import kernel_hash
from carom.core.jit.calls import register_tables
from carom.core.jit.kernel import kernel
from carom.core.motion.phases import FORMS, PHASES
from carom.errors import CaromError
from carom.explorer.entries import PARTS, entries, rule_name, rules_of
from carom.files import write_text
from carom.formatting import json_value
from carom.laws.air import AIR_LAWS
from carom.laws.callbacks import register_calls
from carom.laws.landing import REGIME_NAMES, WHY
from carom.laws.law import CALLED_WALL, CONTACT_WALL, MIRROR_WALL, NO_SLIP_WALL, ROLLING_WALL, TWO_STEP_WALL
from carom.laws.registry import laws, laws_of_pairs
from carom.laws.two_step import answer_two_step
from carom.laws.wall_and_floor.solver import LEAST_FIRM
from carom.scene.air import DRAG, LIFT, SceneAir
from carom.scene.ball import KAPPA, RUBBING, BallContact
from carom.scene.feature_builders import FIRST_CUSHION
from carom.scene.presets import presets
from carom.scene.restitution import Constant, Exponential, Han2005, Polynomial, Power, Viscoelastic
from carom.scene.ruled import LAW_FAULTS, SCENE_FAULTS, Ruled, number_fields
from carom.scene.scene import GRAVITY, Run, Scene, needed_faults
from carom.scene.schema import EXPECTED, Acceleration, Components, Model, Number, Whole
from carom.scene.shapes import PAGE_SHAPES
from carom.scene.wall import VANISHES
from carom.simulation.contact_kinds import ALL_REFUSALS, DONE, joint_impact
from carom.simulation.loop import ALL, FULL, LIMIT, QUIET, ROWS
from carom.simulation.records import BALLS, LOG, SEEN, WORLD

# What the page takes at most: balls, and features (faces, edges, rims... of all walls).
MOST_BALLS, MOST_FEATURES = 100, 2000
ASSETS = Path(str(resources.files("carom.explorer"))) / "assets"


def engine_bytes() -> bytes:
    """Return the module, ``engine.wasm``."""
    return (ASSETS / "engine.wasm").read_bytes()


def engine_layout() -> dict[str, Any]:
    """Return its description, ``engine.json``."""
    return json.loads((ASSETS / "engine.json").read_text(encoding="utf-8"))  # type: ignore[no-any-return]


@functools.cache
def version() -> str:
    """Return the hash of the kernels as they are today, and of their description."""
    return kernel_hash((entry.function for entry in entries()), json.dumps(_described(), sort_keys=True))


def description() -> dict[str, Any]:
    """Return the content of ``engine.json`` for today's sources; the versions of the building tools are added to it."""
    return {"version": version(), **_described()}


@functools.cache
def _described() -> dict[str, Any]:
    return {
        "records": {
            name: _record(dtype) for name, dtype in (("world", WORLD), ("features", FEATURES), ("balls", BALLS), ("log", LOG))
        },
        "functions": [entry.name for entry in entries()],
        "features": {"face": FACE, "over": OVER, "line": LINE, "point": POINT, "rim": RIM, "curve": CURVE},
        "first_cushion": FIRST_CUSHION,
        "gates": {"goes_on": GOES_ON, "leaves": LEAVES, "falls": FALLS},
        "kinds": list(SEEN),
        "phases": list(PHASES),
        "regimes": [str(name) for name in REGIME_NAMES],
        "forms": {name: code for code, name in enumerate(FORMS)},
        "han2005": list(Han2005().p),
        "reasons": list(WHY),
        "run": {"done": DONE, "full": FULL, "limit": LIMIT, "quiet": QUIET, "rows": ROWS, "all": ALL},
        "refusals": {str(code): text for code, text in ALL_REFUSALS.items()},
        "responses": {
            "two-step": TWO_STEP_WALL, "rolling": ROLLING_WALL, "no-slip": NO_SLIP_WALL, "mirror": MIRROR_WALL,
            "contact": CONTACT_WALL, "called": CALLED_WALL,
        },
        "limits": {"least_firm": LEAST_FIRM, "balls": MOST_BALLS, "features of walls": MOST_FEATURES},
        "laws": [_law(law) for law in laws().values() if law.kernel is not None],
        "air_laws": {
            name: {what: [list(one) for one in json_value(getattr(law, what), infinite=True)] for what in ("drag", "lift")}
            for name, law in AIR_LAWS.items()
        },
        "shapes": {name: {**_ruled(shape), "pockets": list(shape.pocket_places)} for name, shape in PAGE_SHAPES.items()},
        "parts": {name: _ruled(part) for name, part in PARTS.items()},
        "scene_faults": [text._asdict() for text in SCENE_FAULTS],
        "vanishes": VANISHES._asdict(),
        "law_faults": {name: text._asdict() for name, text in LAW_FAULTS.items()},
        "fields": scene_fields(),
    }  # fmt: skip


def _record(dtype: np.dtype[Any]) -> dict[str, Any]:
    """Where a record's fields are: offset in bytes, number of items, and whether they are whole numbers."""
    fields = {}
    for name, (kind, offset, *_title) in (dtype.fields or {}).items():
        fields[name] = {"at": offset, "count": int(np.prod(kind.shape, dtype=int)), "whole": kind.base.kind == "i"}
    return {"bytes": dtype.itemsize, "fields": fields}


def _ruled(part: type[Ruled]) -> dict[str, Any]:
    """Description of a part with rules: the fields that its kernels take as numbers, and the texts of its faults."""
    return {"numbers": number_fields(part), "faults": [text._asdict() for text in part.fault_texts]}


def _rules(asked: Any) -> list[dict[str, str]]:
    """Description of a law's conditions or objections: their functions, and their sentences with places for two numbers."""
    return [{"function": rule_name(rule), "text": rule.text, "field": rule.field} for rule in rules_of(asked)]


def _order(law: Any) -> str:
    """Return the order of wall and floor in a law that answers as the two-step law does: "scene", that of the scene, or its own."""
    order = getattr(law.answer, "keywords", {}).get("order", "scene")
    return order if getattr(law.answer, "func", law.answer) is answer_two_step else ""


def _law(law: Any) -> dict[str, Any]:
    """Description of a law for the page."""
    return {
        "name": law.name,
        "title": law.card.summary,
        "assumptions": list(law.card.assumptions),
        "valid": law.card.valid,
        "citation": law.card.citation,
        "doi": law.card.doi,
        "parameters": None if law.reads is None else list(law.reads),
        "needed": list(needed_faults(law).values()),
        "pinned": {name: "inf" if math.isinf(x) else x for name, x in law.pinned.items()},
        "response": law.response,
        "function": f"law_{law.name.replace('-', '_')}",
        "last": law.last,
        "defaults": dict(law.defaults),
        "on_table": law.on_table,
        "order": _order(law),
        "variant_of": law.variant_of,
        "one_contact": law.one_contact,
        "slip_friction": law.slip_friction and list(law.slip_friction),
        "ignores_floor": law.ignores_floor,
        "colour": law.line[0] if law.line else None,
        "dashes": list(law.line[1][1]) if law.line and not isinstance(law.line[1], str) else [],
        "conditions": _rules(law.conditions),
        "objections": _rules(law.objections),
    }


# ----------------------------------------------------------------------------------------------------
# Build the explorer's WebAssembly module from today's kernels: what `make wasm` runs.
#
# ``python -m carom.explorer.module`` writes ``assets/engine.wasm``, ``assets/engine.json`` and musl's licence.


MAX_BYTES = 300_000


def build() -> tuple[bytes, str, str]:
    """Return the module, the text of its description, and the licence of the functions of libm in it.

    Raises CaromError where it cannot be built.
    """
    from carom.core.jit.build import (
        Export,
        build_module,
        libm_licence,
        plain_signature,
        require_tools,
        tool_versions,
    )
    from carom.core.jit.compile import signature

    require_tools()  # (before the kernels are compiled, which takes a minute)
    # (in the engine's own loop another process compiles this part)
    kernel(joint_impact)
    register_calls()
    register_tables()
    exports = [
        Export(one.name, one.function, plain_signature(one.numbers), True) if one.numbers
        else Export(one.name, one.function, signature(one.returns, *one.arguments))
        for one in entries()
    ]  # fmt: skip
    described = description()
    module = build_module(exports, described["version"])
    described["built_with"] = tool_versions()
    if len(module) > MAX_BYTES:
        raise CaromError(f"make wasm: expected at most {MAX_BYTES:,} bytes, got {len(module):,}")
    return module, json.dumps(described, indent=1, allow_nan=False) + "\n", libm_licence()


def main() -> int:
    """Build the module and write it beside its description; return the exit code."""
    try:
        module, text, licence = build()
    except CaromError as error:
        sys.stderr.write(f"carom: {error}\n")
        return 2
    ASSETS.mkdir(exist_ok=True)
    (ASSETS / "engine.wasm").write_bytes(module)
    write_text(ASSETS / "engine.json", text)
    write_text(ASSETS / "LICENSE-musl.txt", licence)
    sys.stdout.write(f"engine.wasm: {len(module):,} bytes\n")
    return 0


# ----------------------------------------------------------------------------------------------------
# The fields of a scene as data: what the page checks numbers by, and names them by, is what Python checks them by.
#
# Read from the models of :mod:`carom.scene`, so that a bound and a text stand in one place.

RESTITUTIONS = (Constant, Polynomial, Han2005, Power, Viscoelastic, Exponential)


def _within(annotation: Any) -> Iterator[type[Model]]:
    """Yield the models that a field's type names, and those within them first; the forms of a restitution are none."""
    if isinstance(annotation, type) and issubclass(annotation, Model) and annotation not in RESTITUTIONS:
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
            "options": {model.model_fields["form"].default: _part(model) for model in RESTITUTIONS},
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
        return {"kind": "vector", "what": GRAVITY.what, "counts": [3, 3], "each": _described_field(Acceleration, [])}
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
    return {**_described_field(info.annotation, list(info.metadata)), **optional}


def _says_nothing(part: Model) -> bool:
    """Return whether a part has no value of its own in any field: then it may be left out, as the sides of a table."""
    return all(value is None or (isinstance(value, Model) and _says_nothing(value)) for _name, value in part)


def _number(number: Number) -> dict[str, Any]:
    return {
        "kind": "number", "what": number.what, "unit": number.unit,
        "least": json_value(number.least), "most": json_value(number.most), "above": number.above, "infinite": number.infinite,
    }  # fmt: skip


def _described_field(annotation: Any, metadata: list[Any]) -> dict[str, Any]:  # noqa: PLR0911  (one return a kind)
    while get_origin(annotation) is Annotated:
        annotation, *more = get_args(annotation)
        metadata = [*metadata, *more]
    if get_origin(annotation) in (Union, UnionType):
        options = [one for one in get_args(annotation) if one is not type(None)]
        optional = {"optional": True} if len(options) < len(get_args(annotation)) else {}
        return {**(_described_field(options[0], metadata) if len(options) == 1 else {"of": "restitution"}), **optional}
    checks = [getattr(one, "func", None) for one in metadata]
    check = next((one for one in checks if isinstance(one, Components | Number | Whole)), None)
    if isinstance(check, Components):
        each = _described_field(next(one for one in get_args(annotation) if one is not Ellipsis), [])
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


if __name__ == "__main__":
    sys.exit(main())
