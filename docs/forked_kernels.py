"""Kernels of pages, and commands in their cells, forked from one process that has imported what most of them import.

The imports take longer than most cells. Each page and each command has a process of its own, and nothing is left to another one.
``python forked_kernels.py SOCKET`` serves: a caller sends a line of JSON, gets the new process's number, and keeps the connection;
it is closed when the process ends. A command sends its three streams along, and gets its exit code before that.
"""

from __future__ import annotations

import atexit
import contextlib
import gc
import importlib
import json
import os
import select
import shlex
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

from jupyter_client import AsyncKernelManager

import carom

IMPORTED = (
    "ipykernel.kernelapp", "matplotlib.pyplot", "scipy.optimize", "scipy.stats", "sympy.physics.mechanics", "xarray", "zarr",
    "shell_cells", "carom.cli.verbs",
)  # fmt: skip
NAMES = ("Scene", "simulate", "fit", "orbit", "simulate_gas")  # of carom: what they need is imported with them
PATIENCE = 300.0  # s, until all this is imported


class ForkedProcess:
    """A process that the server forked, with what is asked of a ``subprocess.Popen``."""

    stdin = stdout = stderr = None

    def __init__(self, server: Path, words: list[str], folder: str, environment: dict[str, str]) -> None:
        begin = time.monotonic()
        while not server.exists():  # (it imports)
            if time.monotonic() - begin > PATIENCE:
                raise RuntimeError(
                    "docs/forked_kernels.py: expected a server of kernels, got none: what it said stands above"
                )
            time.sleep(0.05)
        self._connection = socket.socket(socket.AF_UNIX)
        self._connection.connect(str(server))
        order = {"words": words, "folder": folder, "environment": environment}
        self._connection.sendall(json.dumps(order).encode() + b"\n")
        self.pid = int(self._connection.recv(32))

    def poll(self) -> int | None:
        """Return None while it runs, else 0 (its exit code is not known)."""
        return 0 if select.select([self._connection], [], [], 0)[0] else None

    def wait(self) -> int:
        """Wait for its end."""
        self._connection.recv(1)
        self._connection.close()
        return 0

    def send_signal(self, number: int) -> None:
        """Send a signal."""
        if self.poll() is None:
            os.kill(self.pid, number)

    def terminate(self) -> None:
        """Ask it to end."""
        self.send_signal(signal.SIGTERM)

    def kill(self) -> None:
        """End it."""
        self.send_signal(signal.SIGKILL)


class ForkingManager(AsyncKernelManager):
    """A manager whose kernels are forked from the server of the build."""

    server: Path
    holding: subprocess.Popen[bytes]

    async def _async_launch_kernel(self, kernel_cmd: list[str], **options: Any) -> None:
        made = ForkedProcess(
            self.server, kernel_cmd[3:], str(options["cwd"]), options["env"]
        )  # (python -m ipykernel_launcher ...)
        provisioner: Any = self.provisioner
        provisioner.process, provisioner.pid, provisioner.pgid = made, made.pid, made.pid
        provisioner.cwd = options["cwd"]
        self._reconcile_connection_info(provisioner.connection_info)


# The command ``carom`` of cells: a Python without libraries, which hands its words and streams to the server.
COMMAND = """
import json, os, socket, sys
with socket.socket(socket.AF_UNIX) as server:
    server.connect(sys.argv[1])
    order = {"words": sys.argv[2:], "folder": os.getcwd(), "environment": dict(os.environ), "command": True}
    socket.send_fds(server, [b"+"], [0, 1, 2])
    server.sendall(json.dumps(order).encode() + b"\\n")
    sys.exit(int(server.makefile().read().split()[1]))
"""


def start(folder: Path) -> None:
    """Start the server, which ends with the process that has started it; its socket is made in ``folder``.

    The command ``carom`` of this process and of its children is from now on one that the server forks.
    """
    ForkingManager.server = folder / "kernels"
    (folder / "bin").mkdir()
    (folder / "bin" / "carom.py").write_text(COMMAND, encoding="utf-8")
    words = shlex.join([sys.executable, "-IS", str(folder / "bin" / "carom.py"), str(ForkingManager.server)])
    (folder / "bin" / "carom").write_text(f'#!/bin/sh\nexec {words} "$@"\n', encoding="utf-8")
    (folder / "bin" / "carom").chmod(0o755)
    os.environ["PATH"] = os.pathsep.join([str(folder / "bin"), os.environ.get("PATH", "")])
    # (kept: a pipe that nobody holds is closed)
    ForkingManager.holding = subprocess.Popen(
        [sys.executable, __file__, str(ForkingManager.server)], stdin=subprocess.PIPE
    )


def _serve(place: Path) -> None:
    for name in IMPORTED:
        importlib.import_module(name)
    for name in NAMES:
        getattr(carom, name)
    sys.modules["xarray"].DataArray([0.0])  # (which looks for arrays of other libraries, and imports these)
    gc.collect()
    gc.freeze()  # (no process that is forked goes through all this again)
    with socket.socket(socket.AF_UNIX) as server:
        server.bind(f"{place}.part")
        server.listen(64)
        os.rename(f"{place}.part", place)
        signal.signal(signal.SIGCHLD, signal.SIG_IGN)  # (no process waits for what is forked)
        while True:
            # (standard input ends with the build)
            if sys.stdin in select.select([server, sys.stdin], [], [])[0]:
                os._exit(0)
            connection, _ = server.accept()
            with connection:
                first, streams, *_ = socket.recv_fds(connection, 1, 3)
                order = json.loads(first.strip(b"+") + connection.makefile("rb").readline())
                if os.fork() == 0:
                    server.close()
                    if order.pop("command", False):
                        _command(connection, streams, **order)
                    _kernel(connection, **order)
                for stream in streams:
                    os.close(stream)


def _command(
    connection: socket.socket, streams: list[int], words: list[str], folder: str, environment: dict[str, str]
) -> None:
    """Become a run of ``carom``; its exit code goes to ``connection``, which stays open until the end."""
    signal.signal(signal.SIGCHLD, signal.SIG_DFL)
    for number, stream in enumerate(streams):
        os.dup2(stream, number)
        os.close(stream)
    os.chdir(folder)
    os.environ.clear()
    os.environ.update(environment)
    connection.sendall(f"{os.getpid()} ".encode())
    import carom.cli  # (which the server has loaded)

    sys.stdout.reconfigure(line_buffering=False)  # (as where it is no terminal)
    sys.argv = ["carom", *words]
    code: Any = 1
    try:
        carom.cli.main()
    except SystemExit as end:
        code = end.code or 0
    atexit._run_exitfuncs()
    sys.stdout.flush()
    connection.sendall(str(code).encode())
    os._exit(int(code))


def _kernel(connection: socket.socket, words: list[str], folder: str, environment: dict[str, str]) -> None:
    """Become a kernel; ``connection`` stays open until the end."""
    with contextlib.suppress(SystemExit):
        os.setsid()
        signal.signal(signal.SIGCHLD, signal.SIG_DFL)
        os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
        os.chdir(folder)
        os.environ.clear()
        os.environ.update(environment)
        connection.sendall(str(os.getpid()).encode())
        from ipykernel.kernelapp import launch_new_instance

        # (it ends with its parent, as kernels do)
        launch_new_instance(argv=[*words, f"--IPKernelApp.parent_handle={os.getppid()}"])
    atexit._run_exitfuncs()  # (not all the modules, one by one)
    sys.stdout.flush()
    os._exit(0)


if __name__ == "__main__":
    _serve(Path(sys.argv[1]))
