"""Files of NumPy's arrays, .npz: what they declare is looked at before anything is unpacked."""

from __future__ import annotations

import math
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any, BinaryIO, NamedTuple

import numpy as np

from carom.files import require_unpacked_size

__all__ = ["ArrayHeader", "npz_headers", "require_npz_size"]


class ArrayHeader(NamedTuple):
    """Description of an array in a file, from its header."""

    shape: tuple[int, ...]
    dtype: np.dtype[Any]

    @property
    def nbytes(self) -> int:
        """Its size in memory."""
        return math.prod(self.shape) * self.dtype.itemsize


def npz_headers(path: Path, raw: BinaryIO) -> dict[str, ArrayHeader]:
    """Return the headers of the arrays in an NPZ file by name; nothing else is unpacked.

    Raises errors of zipfile, zlib and NumPy for what is no such file, and ValueError where an array is not as large as its data.
    """
    with zipfile.ZipFile(raw) as archive:
        found = {}
        for one in archive.infolist():
            name, _dot, ending = one.filename.rpartition(".")
            if ending != "npy":  # (NumPy hands out such a member as a whole)
                raise ValueError(f"{one.filename}: no array")
            with archive.open(one) as part:
                version = np.lib.format.read_magic(part)
                if version != (1, 0):  # (whose headers may be as large as the array)
                    require_unpacked_size(path, one.file_size)
                v1 = version == (1, 0)
                read = np.lib.format.read_array_header_1_0 if v1 else np.lib.format.read_array_header_2_0
                shape, _order, dtype = read(part)
                found[name] = ArrayHeader(shape, dtype)
                # (np.load refuses objects)
                if not dtype.hasobject and found[name].nbytes != one.file_size - part.tell():
                    raise ValueError(f"{one.filename}: an array {shape} of another size than its data")
    raw.seek(0)
    return found


def require_npz_size(path: Path, headers: Mapping[str, ArrayHeader]) -> None:
    """Raise CaromError where the arrays of a file would be far larger in memory than the file."""
    require_unpacked_size(path, sum(one.nbytes for one in headers.values()))
