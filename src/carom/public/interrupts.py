"""Ctrl-C while the command starts: it ends at once, in one line, as it does later.

What is imported meanwhile is in the hands of others, who may swallow an exception, or print it. Nothing was begun yet that would
have to be put in order.
"""

from __future__ import annotations

import os
import sys
from typing import Any

INTERRUPTED = 130  # the exit code: 128 and SIGINT
LINE = "carom: interrupted\n"


def end_at_once_while_starting() -> None:
    """If this process is the command, have Ctrl-C end it at once until ``carom.cli.main`` takes over. Else do nothing."""
    if not _is_command():
        return
    import signal

    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, _end)


def _end(_signal: int, _frame: Any) -> None:
    os.write(2, LINE.encode())
    os._exit(INTERRUPTED)


def _is_command() -> bool:
    """Return whether this process was started as ``python -m carom``, or by a script that imports the command."""
    name, words = (sys.argv or [""])[0], sys.orig_argv
    if name == "-m":  # (still so while the package is imported)
        return words[words.index("-m") + 1 :][:1] == ["carom"] if "-m" in words else False
    if os.path.basename(name) not in ("carom", "carom.exe", "carom-script.py"):
        return False
    try:
        with open(name, "rb") as script:
            return b"carom.cli" in script.read(4096)
    except OSError:
        return False
