"""Where code can be changed in one place, and what stands there then."""

from __future__ import annotations

import ast
import copy
import functools
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

__all__ = ["Mutant", "draw"]

SWAPPED: dict[type, type] = {
    ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult,
    ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt, ast.Eq: ast.NotEq, ast.NotEq: ast.Eq,
    ast.And: ast.Or, ast.Or: ast.And,
}  # fmt: skip
CALLS = {"min": "max", "max": "min"}
SCOPES = (ast.FunctionDef, ast.ClassDef, ast.Lambda)


class Mutant(NamedTuple):
    """A change of one expression."""

    path: str
    """Of the module, within the package."""
    line: int
    text: str
    """This line, as it stands in the module."""
    function: str
    """In which it stands, as Python names it; "" in code that runs when the module is imported."""
    before: str
    after: str
    source: str
    """The whole module with it."""

    @property
    def about(self) -> str:
        """What is changed, in a line."""
        return f"{self.path}:{self.line}: {self.before} -> {self.after}"


def draw(package: Path, room: str, number: int) -> Mutant:
    """Return mutant ``number`` of a room: all its places in one random order, none twice."""
    places = places_of(package / room)
    order = np.random.default_rng(0).permutation(len(places))
    path, text, node, new, function = places[int(order[number])]
    lines = text.encode().splitlines(keepends=True)
    begin = sum(map(len, lines[: node.lineno - 1])) + node.col_offset
    end = sum(map(len, lines[: (node.end_lineno or 0) - 1])) + (node.end_col_offset or 0)
    whole, after = text.encode(), ast.unparse(new)
    source = (whole[:begin] + f"({after})".encode() + whole[end:]).decode()
    name = path.relative_to(package).as_posix()
    return Mutant(
        name, node.lineno, lines[node.lineno - 1].decode().strip(), function, ast.unparse(node), after, source
    )


@functools.cache
def places_of(room: Path) -> list[tuple[Path, str, ast.expr, ast.AST, str]]:
    """Return the module, its text, an expression, what it may become, and its function, for every place of a room."""
    places = []
    for path in sorted(room.rglob("*.py")):
        text = path.read_text(encoding="utf-8")
        places += [
            (path, text, node, new, function)
            for node, function in expressions(ast.parse(text))
            if (new := changed(node)) is not None
        ]
    return places


def changed(node: ast.AST) -> ast.AST | None:
    """Return a copy of an expression with another operator, sign or number; None where there is nothing to change."""
    new: Any = copy.deepcopy(node)
    match node:
        case ast.BinOp() if type(node.op) in SWAPPED:
            new.op = SWAPPED[type(node.op)]()
        case ast.BoolOp():
            new.op = SWAPPED[type(node.op)]()
        case ast.Compare() if type(node.ops[0]) in SWAPPED:
            new.ops[0] = SWAPPED[type(node.ops[0])]()
        case ast.UnaryOp(op=ast.USub() | ast.Not()):
            new = new.operand
        case ast.Call(func=ast.Name(id=name)) if name in CALLS:
            new.func.id = CALLS[name]
        case ast.Constant(value=value) if type(value) is int:
            new.value = value + 1
        case ast.Constant(value=value) if type(value) is float:
            new.value = value * 1.25 if value else 1.0
        case _:
            return None
    return new  # type: ignore[no-any-return]


def expressions(tree: ast.AST, scopes: tuple[ast.AST, ...] = ()) -> Iterator[tuple[ast.expr, str]]:
    """Yield what code computes, and in which function: no annotations, decorators, messages or names that are exported."""
    inner = (*scopes, tree) if isinstance(tree, SCOPES) else scopes
    for field, value in ast.iter_fields(tree):
        if field in ("annotation", "returns", "decorator_list") or isinstance(tree, (ast.Raise, ast.JoinedStr)):
            continue
        if isinstance(tree, ast.Assign) and any(isinstance(t, ast.Name) and t.id == "__all__" for t in tree.targets):
            continue
        # (defaults of arguments are computed where the function is defined)
        where = scopes if field == "args" else inner
        for child in value if isinstance(value, list) else [value]:
            if isinstance(child, ast.AST):
                if isinstance(child, ast.expr):
                    yield child, function_of(where)
                yield from expressions(child, where)


def function_of(scopes: tuple[ast.AST, ...]) -> str:
    """Return the outermost function of nested definitions, with its class; "" where there is none."""
    names = []
    for scope in scopes:
        names.append(getattr(scope, "name", "<lambda>"))
        if not isinstance(scope, ast.ClassDef):
            return ".".join(names)
    return ""
