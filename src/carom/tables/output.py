"""Files that are whole or not there: written beside their place, and moved to it at the end."""

from __future__ import annotations

import contextlib
import errno
import os
import shutil
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

from carom.errors import CaromError

__all__ = ["whole_file"]


FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)


@contextmanager
def _room(where: str) -> Iterator[None]:
    """CaromError where there is no room for what the block writes; all else that goes wrong in it goes its way."""
    try:
        yield
    except OSError as error:
        if error.errno not in FULL:
            raise
        raise CaromError(f"{where}: expected room for what is written, got: {error.strerror}") from None


@contextmanager
def whole_file(out: Path | None, source: Path | None = None) -> Iterator[BinaryIO]:
    """A binary file to write, which becomes ``out`` (None: standard output) only when the block ends without an error.

    Raises CaromError where ``out`` is ``source`` itself, a folder, or in a folder that is not there or not writable.
    """
    if out is None:
        with _room("standard output, put together in a temporary file"), tempfile.TemporaryFile() as file:
            yield file
            file.seek(0)
            # a reader that has seen enough, such as `head`, is no fault
            with contextlib.suppress(BrokenPipeError):
                shutil.copyfileobj(file, sys.stdout.buffer)
                sys.stdout.buffer.flush()
        return
    place = out.resolve()
    if source is not None and place.exists() and place.samefile(source):
        raise CaromError(f"--out {out}: expected another file than the table itself, got the same; name a new one")
    if place.is_dir():
        raise CaromError(f"--out {out}: expected a file, got a folder; name a file in it")
    if place.exists() and not place.is_file():  # a device or a pipe: it cannot be moved over
        with tempfile.TemporaryFile() as file:
            yield file
            file.seek(0)
            with place.open("wb") as device:
                shutil.copyfileobj(file, device)
        return
    try:
        handle, name = tempfile.mkstemp(prefix=f".{place.name}.", suffix=".part", dir=place.parent)
    except OSError as error:
        raise CaromError(f"--out {out}: expected a folder that can be written to, got: {error.strerror}") from None
    part = Path(name)
    try:
        with _room(f"--out {out}"), os.fdopen(handle, "wb") as file:
            yield file
        mask = os.umask(0)
        os.umask(mask)
        part.chmod(0o666 & ~mask)
        part.replace(place)
    finally:
        part.unlink(missing_ok=True)
