"""The folder in which compiled code is cached, one for each state of carom's code; hashes of what functions and modules compute."""

from __future__ import annotations

import ast
import contextlib
import functools
import hashlib
import importlib.util
import inspect
import os
import re
import shutil
import sys
import time
import types
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

KEPT_SECONDS = 30 * 86_400.0
MARK_SECONDS = 86_400.0  # a use is marked at most once a day, and that often is looked for what is no longer used
NAME = re.compile(r"[0-9a-f]{16}")  # of a version's folder: no other folder is touched
# Rooms that hold no compiled code: what changes there leaves compiled loops as they are.
PLAIN_ROOMS = {"cli", "data", "derive", "explorer", "plot", "public"}


def cache_base() -> Path:
    """Return CAROM_CACHE, else ``carom`` in the user's ordinary cache folder."""
    own = os.environ.get("CAROM_CACHE")
    return Path(own) if own else Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "carom"


@functools.cache
def cache_folder() -> Path:
    """Return where the compiled loops of this version of carom are kept: a folder in :func:`cache_base`, in use from now on."""
    here = cache_base() / source_hash()
    use_folder(here)
    return here


def use_folder(folder: Path) -> None:
    """Begin to use a version's folder; once a day mark its use, and remove those that were not used for a month.

    (A process has its machine code in memory: one that outlives its folder goes on.)
    """
    now = time.time()
    with contextlib.suppress(OSError):
        if folder.exists() and now - folder.stat().st_mtime < MARK_SECONDS:
            return
        folder.mkdir(parents=True, exist_ok=True)
        os.utime(folder)
        for path in version_folders(folder.parent):
            with contextlib.suppress(OSError):  # (another process removes it at this moment)
                if now - path.stat().st_mtime > KEPT_SECONDS:
                    shutil.rmtree(path)


def version_folders(base: Path) -> list[Path]:
    """Return the folders of all versions in a cache folder; none where it cannot be read."""
    with contextlib.suppress(OSError):
        return [path for path in base.iterdir() if NAME.fullmatch(path.name) and path.is_dir()]
    return []


@functools.cache
def source_hash() -> str:
    """Hash of the code of all modules that may hold kernels, and of Python's and Numba's versions."""
    root = Path(__file__).parents[2]
    return hashlib.sha256(f"{hash_of_files(root)} {sys.version}".encode() + _numba_version()).hexdigest()[:16]


def hash_of_files(root: Path) -> str:
    """Return the hash of the modules that may hold kernels, as they lie on the disk: quick, and another for any edit."""
    digest = hashlib.sha256()
    for path in sorted(root.rglob("*.py")):
        name = path.relative_to(root)
        if name.parts[0] not in PLAIN_ROOMS:
            digest.update(name.as_posix().encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()[:16]


def _numba_version() -> bytes:
    """Contents of the file that says Numba's version: Numba itself takes half a second to import."""
    try:
        spec = importlib.util.find_spec("numba")
        return (Path(spec.origin or "").parent / "_version.py").read_bytes() if spec is not None else b""
    except (OSError, ImportError, ValueError):
        return b""


# ----------------------------------------------------------------------------------------------------
# Hash of what functions compute, with all that they call: the same for every Python, for comments, docstrings and names of files.
#
# A module that was built from kernels, and is kept (carom.explorer), is known by it to be of today's kernels.

# What does not change the results: annotations and decorators (every kernel is made the same way), and what only some versions
# of Python have.
LEFT_OUT = {"annotation", "returns", "decorator_list", "type_comment", "type_params", "kind", "ctx"}


def kernel_hash(
    functions: Iterable[Callable[..., Any]],
    *more: str,
    instead: Mapping[Callable[..., Any], Callable[..., Any]] | None = None,
    by_file: bool = False,
) -> str:
    """Return 16 hexadecimal digits: of the code and the constants of functions, and of further texts.

    Followed are functions of carom and their global numbers, tuples and arrays; of other modules' functions the names count.
    ``instead``: functions in whose place others may be compiled, which are followed as well. ``by_file``: the whole file of a
    function counts for its code, which needs no reading of Python (a hundred times quicker), and comments count, too.
    """
    found: dict[str, str] = {}
    for function in functions:
        _collect(function, found, instead or {}, _file_and_names if by_file else _written)
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


def _collect(
    function: Any,
    found: dict[str, str],
    instead: Mapping[Callable[..., Any], Callable[..., Any]],
    written: Callable[[types.CodeType], tuple[str, list[str]]],
) -> None:
    held = inspect.getclosurevars(function).nonlocals if function.__closure__ else {}
    name = name_with_values(function)
    if name in found:
        return
    found[name], used = written(function.__code__)
    for key in used:
        value = held.get(key, function.__globals__.get(key))
        if isinstance(value, functools._lru_cache_wrapper):
            value = value.__wrapped__
        value = getattr(value, "py_func", value)  # (of what was compiled)
        if isinstance(value, types.FunctionType):
            for one in (value, instead.get(value)):
                if one is not None and one.__module__.startswith("carom."):
                    _collect(one, found, instead, written)
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


@functools.cache
def _file_and_names(code: types.CodeType) -> tuple[str, list[str]]:
    """Return the hash of a function's file, and the names in its bytecode: attributes' names, too, which do no harm."""
    names = {*code.co_names, *code.co_freevars}
    for inner in code.co_consts:
        if isinstance(inner, types.CodeType):
            names.update(_file_and_names(inner)[1])
    return file_hash(code.co_filename), sorted(names)


@functools.cache
def file_hash(file: str | Path) -> str:
    """Return the hash of a file's content."""
    return hashlib.sha256(Path(file).read_bytes()).hexdigest()


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
