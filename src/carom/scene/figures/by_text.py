"""Figures by a text, such as "stadium:straight=2,radius=1", by a table of their fields, and from a file."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import Annotated, Any

from pydantic import PlainSerializer, PlainValidator

from carom.errors import CaromError, Fault, did_you_mean, near_name, shown
from carom.files import as_path, parse_json, read_regular
from carom.scene.figures.figure import FIGURES, Figure
from carom.scene.presets import read_toml
from carom.scene.schema import from_file, refused, with_faults_of_part

# What other names are called here, with an example as it is written
CALLED = {
    "cardioid": "a cardioid is the limit of 'limacon:eps=0.99'", "bunimovich": "'stadium' is Bunimovich's",
    "triangle": "a regular one is 'regular:sides=3'", "square": "it is 'regular:sides=4', or 'rectangle:size=1,1'",
    "pentagon": "it is 'regular:sides=5'", "hexagon": "it is 'regular:sides=6'", "octagon": "it is 'regular:sides=8'",
    "lorentz": "'sinai' is one cell of the Lorentz gas, and 'cell' others",
    "poincare": "`portrait` draws the Poincare section of a table", "portrait": "`portrait` draws the portrait of a table",
}  # fmt: skip
OTHER_CURVES = "any smooth curve is given by its formula: 'curve:r=1 + 0.1*cos(3*theta)'"


def figure(what: str | Mapping[str, Any] | Figure | PathLike[str], /, **sizes: Any) -> Figure:
    """Return a figure by its name and its sizes.

    Parameters
    ----------
    what : str, dict, Path or Figure
        A name; a text such as "stadium:straight=2,radius=50 cm", "rectangle:size=2,1", "polygon:points=[[0,0],[2,0],[0,1]]" or
        "cylinder:stadium:straight=2,radius=1,height=3"; a table of its fields; a Path of a TOML file of these, or of a JSON file
        of these or of a polygon's points.
    **sizes : optional
        Its sizes, by their names. Of a text, and with no sizes at all, those left out are about 1 m.

    Returns
    -------
    Figure

    Raises
    ------
    CaromError
        One line per problem.

    Examples
    --------
    >>> from carom.scene.figures import figure
    >>> round(figure("ellipse", half_axes=(1.2, "50 cm")).area, 6)
    1.884956
    >>> figure("cylinder:stadium:straight=2,radius=1,height=3").over.describe()
    'stadium (straight 2.0, radius 1.0)'
    """
    table = figure_table(what, sizes)
    return what if isinstance(what, Figure) else _made(str(what) if isinstance(what, PathLike) else "figure", table)


def figure_table(what: str | Mapping[str, Any] | Figure | PathLike[str], sizes: Mapping[str, Any]) -> dict[str, Any]:
    """Return the table of the fields of a figure that is given as :func:`figure` takes it."""
    if isinstance(what, Figure):
        if sizes:
            expected = "no sizes beside a figure, which has its own"
            raise CaromError(*(Fault("figure", name, expected, shown(x)) for name, x in sizes.items()))
        return _fields_of(what)
    if isinstance(what, PathLike):
        return {**_read(as_path("figure", what)), **sizes}
    return {**what, **sizes} if isinstance(what, Mapping) else _table(str(what), sizes)


def _made(where: str, table: dict[str, Any]) -> Figure:
    name = table.get("shape")
    if name not in FIGURES:
        got = "nothing" if name is None else shown(name)
        meant = CALLED.get(near_name(str(name), CALLED)) or did_you_mean(str(name), list(FIGURES))
        raise CaromError(Fault(where, "shape", f"one of {', '.join(FIGURES)}", got, meant or OTHER_CURVES))
    try:
        return from_file(name if where == "figure" else where, FIGURES[name], table)
    except CaromError as error:
        raise CaromError(*(_with_example(fault, FIGURES[name]) for fault in error.records)) from None


def _with_example(fault: Fault, kind: type[Figure]) -> Fault:
    """Return the fault of a size that the figure does not have with its usual sizes, as they are written."""
    if not kind.usual or "." in fault.field or not fault.advice.startswith("known are"):
        return fault
    sizes = {name: json.dumps(value).replace(" ", "") for name, value in kind.usual.items()}
    example = ",".join(f"{name}={text if '[[' in text else text.strip('[]')}" for name, text in sizes.items())
    return replace(fault, advice=f"{fault.advice}; an example is {kind.model_fields['shape'].default}:{example}")


def _table(text: str, sizes: Mapping[str, Any]) -> dict[str, Any]:
    """Return the table of fields of a text; what it leaves out is as usual."""
    name, _colon, rest = text.partition(":")
    over, _colon, of_section = rest.partition(":")
    if name == "cylinder" and over in FIGURES:
        given = {**_fields(of_section), **sizes}
        own = {"height": given.pop("height")} if "height" in given else {}
        if over == "circle":
            return {"shape": name, **own, **FIGURES[over].usual, **given}
        return {"shape": name, **own, "section": {"shape": over, **FIGURES[over].usual, **given}}
    given = {**_fields(rest), **sizes}
    usual = FIGURES[name].usual if name in FIGURES and "section" not in given else {}
    return {"shape": name, **usual, **given}


def _fields(text: str) -> dict[str, Any]:
    """Return the fields of "name=value,name=value"; commas without a name after them belong to a value."""
    parts: list[str] = []
    for part in text.split(",") if text else []:
        if "=" in part or not parts:
            parts.append(part)
        else:
            parts[-1] += f",{part}"
    found = {}
    for part in parts:
        name, equals, value = part.partition("=")
        if not equals or not name.strip():
            raise CaromError(Fault("figure", "", "sizes such as straight=2,radius=1", repr(part)))
        found[name.strip()] = value_of_text(value.strip())
    return found


def value_of_text(text: str) -> Any:
    """Return the value of a text: JSON; numbers with commas between them; points "x,y x,y"; else a quantity with its unit."""
    try:
        return json.loads(text)
    except (ValueError, RecursionError):
        pass
    if "," not in text:
        return text
    rows = [[value_of_text(one.strip()) for one in row.split(",")] for row in text.split()]
    if len(rows) > 1 and all(len(row) > 1 for row in rows):
        return rows
    return [value_of_text(one.strip()) for one in text.split(",")]


def _read(path: Path) -> dict[str, Any]:
    """Return the table of fields in a file."""
    if path.suffix.lower() in {".csv", ".tsv", ".txt", ".parquet"}:
        curve = 'shape = "curve" with points = [[x, y], ...]'
        advice = f"corners are a list of [x, y] in JSON; points of a smooth curve are {curve} in TOML"
        raise CaromError(Fault(f"{path}", "", "a figure in TOML or JSON", f"a table ({path.suffix})", advice))
    if path.suffix.lower() != ".json":
        return read_toml(path, "it holds a shape and its sizes, as a wall of a scene does", "a file of a figure")
    found = parse_json(path, read_regular(path, "a file of a figure"))
    if isinstance(found, list):
        return {"shape": "polygon", "points": found}
    if not isinstance(found, dict):
        raise CaromError(Fault(f"{path}", "", "a table of fields, or a list of points", shown(found)))
    return found


def _validated(value: Any) -> Figure:
    return (
        with_faults_of_part(lambda: figure(value)) if isinstance(value, str | Mapping | Figure) else _no_figure(value)
    )


def _no_figure(value: Any) -> Figure:
    raise refused("a figure: a text such as 'stadium:straight=2,radius=1', or a table of its fields", shown(value))


def _fields_of(value: Figure) -> dict[str, Any]:
    return {"shape": value.kind(), **value.sizes}


# A field of a model that takes any figure.
AnyFigure = Annotated[Figure, PlainValidator(_validated), PlainSerializer(_fields_of)]
