"""Whose code a frame of Python's stack is: carom's, a library's, or the user's."""

from __future__ import annotations

import sys
from types import FrameType

__all__ = ["called_from_outside", "is_the_users"]

PACKAGE = __name__.partition(".")[0]
BORDER = f"{PACKAGE}.public.guard"  # whose wrappers stand between a caller and each public function
LIBRARIES = frozenset({
    "carom", "dask", "distributed", "gsd", "h5netcdf", "h5py", "imageio_ffmpeg", "lazy_loader", "llvmlite", "matplotlib",
    "mpl_toolkits", "numba", "numpy", "pandas", "pint", "pyarrow", "pydantic", "pydantic_core", "rich", "scipy", "sympy",
    "typer", "xarray", "zarr",
})  # fmt: skip


def is_the_users(frame: FrameType) -> bool:
    """Return whether a frame is neither carom's nor a library's: a program of the user's, or a function that it handed over."""
    room = _name(frame).partition(".")[0]
    return room not in LIBRARIES and (room == "__main__" or room not in sys.stdlib_module_names)


def called_from_outside(depth: int = 2) -> bool:
    """Return whether the function that asks was called by code outside carom: directly, through a public name, or by a library."""
    frame: FrameType | None = sys._getframe(depth)
    while frame is not None and not is_the_users(frame):
        if _name(frame).partition(".")[0] == PACKAGE and _name(frame) != BORDER:
            return False
        frame = frame.f_back
    return True


def _name(frame: FrameType) -> str:
    return str(frame.f_globals.get("__name__", ""))
