"""Kernels as LLVM's intermediate code, each with an entry of plain C types: the one path to code that runs without Numba.

Numba types and lowers a function with all that it calls (:mod:`carom.core.jit.compile`). To its text an entry is added whose
arguments are addresses and numbers, and that calls Numba's function. Two targets follow (:mod:`carom.core.jit.build`): the page's
module, and the loops that lie ready in the package.

This relies on how Numba writes its code (as of 0.68); where that has changed, a LoweringError says so.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Sequence
from typing import Any, NamedTuple

from carom.core.jit.compile import KERNEL_OPTIONS, linked_pipeline


class LoweringError(Exception):
    """Code cannot be made: a sentence says why, and what to do."""


class CFunction(NamedTuple):
    """An entry that calls a compiled function.

    ``name``: of the entry. ``objects``: an array is the address of NumPy's object, and whole numbers have 64 bits; else it is the
    address of its items, with their number on each axis, and whole numbers have 32 bits. ``returns``: the entry returns Numba's
    status. ``out``: the first argument is the place to which the function's value is written. ``context``: the second is Numba's
    place for an error, beyond which a share of the work is written (:func:`carom.core.jit.build.part_range`).
    """

    name: str
    objects: bool = False
    returns: bool = False
    out: bool = True
    context: bool = False


def linked_dispatcher(function: Callable[..., Any], signature: Any, **options: Any) -> Any:
    """Return Numba's dispatcher of a function, compiled for one signature to be linked into its callers."""
    import numba

    dispatcher = numba.njit(**{**KERNEL_OPTIONS, "pipeline_class": linked_pipeline(), **options})(function)
    dispatcher.compile(signature)
    return dispatcher


def llvm_text(dispatcher: Any) -> tuple[str, str]:
    """Return the name of the function that a dispatcher has compiled, and LLVM's text of it with all that it calls."""
    compiled = next(iter(dispatcher.overloads.values()))
    return compiled.fndesc.llvm_func_name, str(compiled.library._final_module)


def with_entry(entry: CFunction, arguments: Sequence[Any], name: str, text: str) -> str:
    """Return LLVM's text with an entry (of arguments of Numba's types) that calls the function ``name``."""
    taken, given, before = ["ptr %out"], ["ptr %out", "ptr %context" if entry.context else "ptr null"], list[str]()
    if entry.context:
        taken.append("ptr %context")
    for i, kind in enumerate(arguments):
        _hand_over(kind, str(i), entry.objects, (taken, given, before))
    _require_signature(name, text, given)
    if not entry.out:  # called with numbers and a place for the answer: Numba's own results are none
        taken, given[0] = taken[1:], "ptr %none"
        before.insert(0, "  %none = alloca ptr")
    lines, result = "\n".join(before), "i32" if entry.returns else "void"
    call = f'call i32 @"{name}"({", ".join(given)})'
    back = "ret i32 %r" if entry.returns else "ret void"
    body = f"define {result} @{entry.name}({', '.join(taken)}) {{\n{lines}\n  %r = {call}\n  {back}\n}}\n"
    return f"{text}\n{body}"


def _hand_over(kind: Any, i: str, objects: bool, code: tuple[list[str], list[str], list[str]]) -> None:
    """Add the argument ``i`` to the arguments that an entry takes, to those that it gives on, and to its lines before the call."""
    from numba import types

    taken, given, before = code
    if isinstance(kind, types.BaseTuple):
        for k, item in enumerate(kind):
            _hand_over(item, f"{i}_{k}_", objects, code)
    elif isinstance(kind, types.Array):
        taken.append(f"ptr %{'o' if objects else 'a'}{i}")
        if objects:
            before += [
                f"  %a{i} = load ptr, ptr %o{i}",
                f"  %p{i} = getelementptr i8, ptr %o{i}, i64 16",
                f"  %d{i} = load ptr, ptr %p{i}",
            ]
        for axis in range(kind.ndim):
            if objects:
                before += [
                    f"  %q{i}_{axis} = getelementptr i64, ptr %d{i}, i64 {axis}",
                    f"  %m{i}_{axis} = load i64, ptr %q{i}_{axis}",
                ]
            else:
                taken.append(f"i32 %n{i}_{axis}")
                before.append(f"  %m{i}_{axis} = sext i32 %n{i}_{axis} to i64")
        given += _array(kind, i, before)
    elif isinstance(kind, (types.CPointer, types.Record)):
        taken.append(f"ptr %a{i}")
        given.append(f"ptr %a{i}")
    elif isinstance(kind, types.NoneType):
        given.append("ptr null")
    elif kind == types.float64:
        taken.append(f"double %a{i}")
        given.append(f"double %a{i}")
    else:
        wide, here = "i8" if kind == types.boolean else f"i{kind.bitwidth}", "i64" if objects else "i32"
        taken.append(f"{here} %a{i}")
        if wide == here:
            given.append(f"{wide} %a{i}")
        else:
            before.append(f"  %w{i} = {'trunc' if wide == 'i8' else 'sext'} {here} %a{i} to {wide}")
            given.append(f"{wide} %w{i}")


def _array(kind: Any, i: str, before: list[str]) -> list[str]:
    """Return the arguments that stand for a contiguous array, whose items begin at %a and whose numbers of items are %m."""
    from numba import types

    of = kind.dtype
    size = int(of.size if isinstance(of, types.Record) else 1 if of == types.boolean else of.bitwidth // 8)
    step, strides = f"{size}", list[str]()
    for axis in reversed(range(kind.ndim)):
        strides.insert(0, f"i64 {step}")
        if axis > 0:
            before.append(f"  %s{i}_{axis} = mul i64 {step}, %m{i}_{axis}")
            step = f"%s{i}_{axis}"
    before.append(f"  %c{i}_0 = add i64 %m{i}_0, 0")
    before += [f"  %c{i}_{axis} = mul i64 %c{i}_{axis - 1}, %m{i}_{axis}" for axis in range(1, kind.ndim)]
    shape = [f"i64 %m{i}_{axis}" for axis in range(kind.ndim)]
    return ["ptr null", "ptr null", f"i64 %c{i}_{kind.ndim - 1}", f"i64 {size}", f"ptr %a{i}", *shape, *strides]


def whole_module(texts: Sequence[str], kept: Collection[str]) -> Any:
    """Return LLVM's module of texts, in which only the functions ``kept`` are seen from outside."""
    import llvmlite.binding as llvm

    try:
        whole, *parts = map(llvm.parse_assembly, texts)
        for part in parts:
            whole.link_in(part)
        for function in whole.functions:
            if not function.is_declaration:
                function.linkage = "external" if function.name in kept else "internal"
        whole.verify()
    except RuntimeError as error:
        raise _changed(str(error).splitlines()[0]) from None
    return whole


def _require_signature(name: str, text: str, given: Sequence[str]) -> None:
    """Refuse a function whose arguments differ from the arguments that Numba has written so far."""
    found = re.search(rf'^define [^@]*\bi32 @"?{re.escape(name)}"?\((.*?)\) [^()]*\{{$', text, flags=re.M)
    if found is None:
        raise _changed(f"no function {name:.40} that returns i32")
    kinds = [re.sub(r"\(.*?\)", "", one).split()[0] for one in re.sub(r"captures\([^)]*\)", "", found[1]).split(", ")]
    expected = [one.split()[0] for one in given]
    if kinds != expected:
        raise _changed(f"arguments {', '.join(kinds)} for {', '.join(expected)}")


def _changed(what: str) -> LoweringError:
    """Return the error that Numba writes other code than this module knows."""
    import numba

    return LoweringError(
        f"expected LLVM code as Numba 0.68 writes it, got other code from Numba {numba.__version__}: {what};"
        f" build with Numba 0.68, or follow the change in {__name__}"
    )
