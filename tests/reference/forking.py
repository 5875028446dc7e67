"""Runs of carom, and of Python with carom, in processes of their own: one process imports, and forks for each of them."""

from __future__ import annotations

import contextlib
import json
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

__all__ = ["Forked", "forking"]

# (what a run writes to standard error is read after all of its standard output: it has to fit into a pipe)
SERVER = """
import json, os, signal, sys
import carom.cli
len(carom.LAWS)  # (loads them)
prepare, *names = sys.argv[1:]
for name in names:
    try:
        __import__(name)
    except ImportError:
        pass
exec(prepare, {"__name__": "prepare"})
for line in sys.stdin:
    folder, size, environment, words = json.loads(line)
    pipes = os.pipe(), os.pipe()
    child = os.fork()
    if child == 0:
        os.chdir(folder)
        os.environ.update(environment)
        os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
        for (_read, write), stream in zip(pipes, (1, 2)):
            os.dup2(write, stream)
        if size is not None:
            import resource
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            sys.dont_write_bytecode = True  # (Python would leave what is cut short)
            resource.setrlimit(resource.RLIMIT_FSIZE, (size, resource.RLIM_INFINITY))
        if words[0] == "-c":
            exec(words[1], {"__name__": "__main__"})
            sys.exit()
        sys.argv = ["carom", *words]
        sys.exit(carom.cli.main())
    for _read, write in pipes:
        os.close(write)
    said = [open(read, encoding="utf-8").read() for read, _write in pipes]
    print(json.dumps([os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), *said]), flush=True)
"""

Forked = Callable[..., tuple[int, str, str]]


@contextlib.contextmanager
def forking(*libraries: str, prepare: str = "", **environment: str) -> Iterator[Forked]:
    """Yield ``run(folder, *words, size=None, **environment)``: exit code, standard output, standard error.

    The words are those of the command, or ``"-c"`` and a program. ``size`` is the largest file that it may write, in bytes.
    The process that forks has imported carom and these libraries, where they are installed, and run the program ``prepare``.
    """
    with subprocess.Popen(
        [sys.executable, "-c", SERVER, prepare, *libraries], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
        env=os.environ | environment,
    ) as process:  # fmt: skip
        assert process.stdin is not None
        assert process.stdout is not None
        requests, answers = process.stdin, process.stdout

        def run(folder: Path, *words: str, size: int | None = None, **more: str) -> tuple[int, str, str]:
            print(json.dumps([str(folder), size, more, words]), file=requests, flush=True)
            code, out, err = json.loads(answers.readline())
            return code, out, err

        yield run
        requests.close()
