"""Hash of what functions compute, with all that they call: the same for every Python, for comments, docstrings and names of files.

A module that was built from kernels, and is kept (carom.explorer), is known by it to be of today's kernels.
"""

from __future__ import annotations

import ast
import functools
import hashlib
import inspect
import types
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

# What does not change the results: annotations and decorators (every kernel is made the same way), and what only some versions
# of Python have.
LEFT_OUT = {"annotation", "returns", "decorator_list", "type_comment", "type_params", "kind", "ctx"}


def kernel_hash(
    functions: Iterable[Callable[..., Any]],
    *more: str,
    instead: Mapping[Callable[..., Any], Callable[..., Any]] | None = None,
) -> str:
    """Return 16 hexadecimal digits: of the code and the constants of functions, and of further texts.

    Followed are functions of carom and their global numbers, tuples and arrays; of other modules' functions the names count.
    ``instead``: functions in whose place others may be compiled, which are followed as well.
    """
    found: dict[str, str] = {}
    for function in functions:
        _collect(function, found, instead or {})
    digest = hashlib.sha256()
    for name in sorted(found):
        digest.update(f"{name} {found[name]}\n".encode())
    for text in more:
        digest.update(text.encode())
    return digest.hexdigest()[:16]


def name_with_values(function: Callable[..., Any]) -> str:
    """Return a function's name with its module, and with the names of what it holds from the function that made it."""
    held = inspect.getclosurevars(function).nonlocals if function.__closure__ else {}
    return f"{function.__module__}:{function.__qualname__}" + "".join(
        f" {key}={getattr(value, '__module__', '')}.{getattr(value, '__qualname__', value)}"
        for key, value in sorted(held.items())
    )


def _collect(function: Any, found: dict[str, str], instead: Mapping[Callable[..., Any], Callable[..., Any]]) -> None:
    held = inspect.getclosurevars(function).nonlocals if function.__closure__ else {}
    name = name_with_values(function)
    if name in found:
        return
    found[name], used = _written(function.__code__)
    for key in used:
        value = held.get(key, function.__globals__.get(key))
        if isinstance(value, functools._lru_cache_wrapper):
            value = value.__wrapped__
        value = getattr(value, "py_func", value)  # (of what was compiled)
        if isinstance(value, types.FunctionType):
            for one in (value, instead.get(value)):
                if one is not None and one.__module__.startswith("carom."):
                    _collect(one, found, instead)
        elif isinstance(value, np.ndarray):
            found[f"{function.__module__}.{key}"] = (
                f"{value.dtype} {value.shape} {hashlib.sha256(value.tobytes()).hexdigest()}"
            )
        elif isinstance(value, (int, float, str, tuple)):
            found[f"{function.__module__}.{key}"] = repr(value)


@functools.cache
def _written(code: types.CodeType) -> tuple[str, list[str]]:
    """Return a function's arguments and statements as a text, and the names in them (many loops share most of their kernels)."""
    node = _definitions(code.co_filename)[code.co_firstlineno]
    body = node.body[1:] if ast.get_docstring(node) is not None else node.body
    used = {one.id for part in body for one in ast.walk(part) if isinstance(one, ast.Name)}
    return repr([_shape(node.args), *map(_shape, body)]), sorted(used)


def module_hash(paths: Iterable[Path]) -> str:
    """Return 16 hexadecimal digits: of what modules do, whatever their comments, docstrings and annotations are."""
    digest = hashlib.sha256()
    for path in paths:
        tree = ast.parse(path.read_text(encoding="utf-8"))
        for node in ast.walk(tree):
            body = getattr(node, "body", None)
            if (
                isinstance(body, list)
                and body
                and isinstance(body[0], ast.Expr)
                and isinstance(body[0].value, ast.Constant)
            ):
                body[0].value.value = None
        digest.update(f"{path.name} {_shape(tree)}".encode())
    return digest.hexdigest()[:16]


@functools.cache
def _definitions(file: str) -> dict[int, ast.FunctionDef]:
    """Return a file's functions by the line on which each begins, decorators included."""
    tree = ast.parse(Path(file).read_text(encoding="utf-8"))
    functions = [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)]
    return {min([node.lineno, *(one.lineno for one in node.decorator_list)]): node for node in functions}


def _shape(node: Any) -> Any:
    """Return an abstract syntax tree as nested lists of its names and constants, without places."""
    if isinstance(node, list):
        return [_shape(one) for one in node]
    if not isinstance(node, ast.AST):
        return repr(node)
    fields = [
        (name, _shape(value))
        for name, value in ast.iter_fields(node)
        if name not in LEFT_OUT and value not in (None, [])
    ]
    return [type(node).__name__, *fields]
