"""Kernels of pages, forked from one process that has imported what most pages import: that takes longer than most cells.

Each page has a process of its own, as it had, and nothing of a page is left to another one. ``python forked_kernels.py SOCKET``
serves: a caller sends a line of JSON, gets the new process's number, and keeps the connection; it is closed when the process ends.
"""

from __future__ import annotations

import atexit
import contextlib
import importlib
import json
import os
import select
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

from jupyter_client import AsyncKernelManager

import carom

IMPORTED = ("ipykernel.kernelapp", "matplotlib.pyplot", "scipy.optimize", "scipy.stats", "sympy")
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


def start(folder: Path) -> None:
    """Start the server, which ends with the process that has started it; its socket is made in ``folder``."""
    ForkingManager.server = folder / "kernels"
    # (kept: a pipe that nobody holds is closed)
    ForkingManager.holding = subprocess.Popen(
        [sys.executable, __file__, str(ForkingManager.server)], stdin=subprocess.PIPE
    )


def _serve(place: Path) -> None:
    for name in IMPORTED:
        importlib.import_module(name)
    for name in NAMES:
        getattr(carom, name)
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
                order = json.loads(connection.makefile().readline())
                if os.fork() == 0:
                    server.close()
                    _kernel(connection, **order)


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
