"""``carom doctor``: what this installation has: versions, optional libraries, the cache of compiled code, cores."""

from __future__ import annotations

import importlib.metadata
import platform
from pathlib import Path
from typing import Annotated, Any

import typer

from carom.cli.options import shared
from carom.cli.streams import say_json

BASE = ("numpy", "numba", "llvmlite", "pydantic", "pint", "rich", "typer", "lazy_loader")
# Names of packages where they differ from the names of their modules.
PACKAGES = {"imageio_ffmpeg": "imageio-ffmpeg"}


def register(app: typer.Typer) -> None:
    """Add the command."""
    app.command("doctor")(doctor)


def doctor(
    warm: Annotated[
        bool,
        typer.Option(
            "--warm",
            help="Bring all loops to this processor's machine code first: it is cached, later runs only load it.",
        ),
    ] = False,
    as_json: Annotated[bool, shared("json")] = False,
) -> None:
    """Say what this installation has: versions, optional libraries, the cache of compiled code, cores."""
    if warm:
        from carom.cli.warm import warm_up

        warm_up()
    found = report()
    if as_json:
        say_json(found)
        return
    from rich import box
    from rich.table import Table

    from carom.cli.console import out
    from carom.files import install_command

    console = out()
    table = Table(box=box.SIMPLE, show_header=False, pad_edge=False)
    table.add_row("carom", found["carom"] + (f", commit {found['commit']}" if found["commit"] else ""))
    table.add_row("Python", f"{found['python']} on {found['platform']}")
    for name, version in found["libraries"].items():
        table.add_row(name, version)
    for name, about in found["optional"].items():
        table.add_row(name, about["version"] or f"not installed (extra {about['extra']})")
    table.add_row("loops", found["loops"])
    cache = found["cache"]
    ready = "ready" if cache["engine_ready"] else "the event loop is compiled when it is first needed"
    state = f"{cache['megabytes']:.1f} MB, {ready}"
    table.add_row("cache", f"{cache['folder']}: {state}")
    if cache["versions"] > 1:
        table.add_row("", f"compiled code of {cache['versions']} versions, {cache['all_megabytes']:.1f} MB in all")
    table.add_row("cores", f"{found['cores']}, of which compiled loops use {found['threads']} at once")
    console.print(table)
    if any(about["version"] is None for about in found["optional"].values()):
        console.print("An extra, here plot, is installed by", soft_wrap=True)
        # (whole, to be copied, however narrow the terminal)
        console.print(install_command("plot"), no_wrap=True, overflow="ignore", crop=False)


def report() -> dict[str, Any]:
    """Return the versions and features of the installation."""
    import carom
    from carom.core.jit.cache import cache_base, cache_folder, version_folders
    from carom.core.jit.native import describe_loops
    from carom.core.jit.threads import thread_count
    from carom.core.jit.workers import core_count
    from carom.files import OPTIONAL
    from carom.simulation.loop import compiled_before

    folder = cache_folder()
    sizes = {one: _megabytes(one) for one in version_folders(cache_base())}
    return {
        "carom": carom.__version__,
        "commit": commit(),
        "python": platform.python_version(),
        "platform": platform.platform(),
        "libraries": {name: _version(name) for name in BASE},
        "optional": {
            name: {"version": _version(name), "extra": extra} for name, (_prose, extra) in sorted(OPTIONAL.items())
        },
        "loops": describe_loops(),
        "cache": {
            "folder": str(folder),
            "megabytes": sizes.get(folder, 0.0),
            "engine_ready": compiled_before(),
            "versions": len(sizes),
            "all_megabytes": sum(sizes.values()),
        },
        "cores": core_count(),
        "threads": thread_count(),
    }


def _megabytes(folder: Path) -> float:
    return sum(path.stat().st_size for path in folder.rglob("*") if path.is_file()) / 1e6


def _version(name: str) -> str | None:
    try:
        return importlib.metadata.version(PACKAGES.get(name, name))
    except importlib.metadata.PackageNotFoundError:
        return None


def commit() -> str | None:
    """Return the commit that carom is run from, of a clone; None for an installed package."""
    import carom

    git = Path(carom.__file__).parents[2] / ".git"
    try:
        head = (git / "HEAD").read_text(encoding="utf-8").strip()
        if not head.startswith("ref: "):
            return head[:9]
        name = head.removeprefix("ref: ")
        if (git / name).exists():
            return (git / name).read_text(encoding="utf-8").strip()[:9]
        packed = (git / "packed-refs").read_text(encoding="utf-8").splitlines()
        return next((line.split()[0][:9] for line in packed if line.endswith(f" {name}")), None)
    except OSError:
        return None
