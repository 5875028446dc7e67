"""A plugin of mypy (pyproject.toml): an index is not tried against declarations that it cannot fit. Types stay as they are.

NumPy declares ``ndarray.__getitem__`` five times: for integer arrays, integers, anything else but fields, a field, several fields. mypy
tries them in turn, again for each declaration of an operator beside the index, and writes for each that fails a message with the
whole union of indices, which nobody sees: a third of its time. Here a declaration that cannot fit a field's name, or an index with a
slice, an ellipsis or None in it, takes ``Never``: it fails as before, and its message is short.
"""

from __future__ import annotations

from collections.abc import Callable

from mypy.nodes import EllipsisExpr, Expression, NameExpr, SliceExpr, StrExpr, TupleExpr
from mypy.plugin import MethodSigContext, Plugin
from mypy.types import FunctionLike, Instance, Type, UninhabitedType, UnionType, get_proper_type


def _is_view(index: Expression) -> bool:
    """Return whether an index has a slice, an ellipsis or None in it: neither an integer nor an array."""
    if isinstance(index, TupleExpr):
        return any(map(_is_view, index.items))
    return isinstance(index, (SliceExpr, EllipsisExpr)) or (isinstance(index, NameExpr) and index.name == "None")


def _takes(declared: Type, name: str) -> bool:
    """Return whether a class of this name stands among the types of an index."""
    kind = get_proper_type(declared)
    if isinstance(kind, UnionType):
        return any(_takes(item, name) for item in kind.items)
    return isinstance(kind, Instance) and kind.type.fullname == name


def _narrowed(context: MethodSigContext) -> FunctionLike:
    """Return a declaration of ``__getitem__`` for the index that is written."""
    declared = context.default_signature
    ((index,),) = context.args
    wanted = "builtins.str" if isinstance(index, StrExpr) else "builtins.slice" if _is_view(index) else None
    if wanted is None or _takes(declared.arg_types[0], wanted):
        return declared
    return declared.copy_modified(arg_types=[UninhabitedType()])


class Indices(Plugin):
    """Declarations of indices that cannot fit fail at once."""

    def get_method_signature_hook(self, fullname: str) -> Callable[[MethodSigContext], FunctionLike] | None:
        """Called by mypy for each method that is called."""
        return _narrowed if fullname == "numpy.ndarray.__getitem__" else None


def plugin(_version: str) -> type[Plugin]:
    """Called by mypy."""
    return Indices
