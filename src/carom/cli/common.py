"""Shared by commands: collection of errors, the console, and checks of output files before a run."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from carom.cli.streams import note, say_json
from carom.errors import Fault, FaultList, collected, noting
from carom.files import require_library, require_writable

__all__ = [
    "noting",
    "require_outputs",
    "tell",
    "tick",
    "write_files",
    "write_report_page",
    "wrote",
]

if TYPE_CHECKING:
    from rich.console import Console


def tick(console: Console, good: bool) -> str:
    """Return a tick or a cross; yes or no if the output has no such characters."""
    if console.encoding.startswith("utf"):
        return "✓" if good else "✗"
    return "yes" if good else "no"


def tell(ranking: Any, show: Callable[[Any], None], as_json: bool, console: Console, written: Sequence[Path]) -> None:
    """Print a ranking of laws, as JSON or by ``show``; on the console also its notes, and the paths of files that were written."""
    if as_json:
        say_json(ranking.as_dict())
    else:
        show(ranking)
    for text in ranking.notes:
        console.print(f"note: {text}", style="yellow", soft_wrap=True)
    wrote(*written)


def wrote(*paths: Path) -> None:
    """Print the names of files that were written, on standard error."""
    for path in paths:
        note(f"written: {path}")


def write_files(
    found: FaultList, result: Any, actions: Sequence[tuple[Path | None, Callable[[Any, Path], None]]]
) -> list[Path]:
    """Write the files of a result that were asked for; return the paths of those written, and add the faults to ``found``."""
    written = []
    for path, action in actions:
        if path is not None:
            with collected(found):
                action(result, path)
                written.append(path)
    return written


def write_report_page(write: Callable[[], Path], say: Callable[[str, float], None]) -> Path:
    """Write a requested report and return its path; CaromError if Matplotlib is missing."""
    require_library("matplotlib", "--report")
    say("report", 1.0)
    return write()


PICTURES = (".svg", ".pdf", ".png")
GAS_FILMS = (".svg", ".gif", ".mp4")
LIBRARIES = {
    **dict.fromkeys((*PICTURES, ".mp4", ".gif"), ("matplotlib",)),
    **dict.fromkeys((".parquet", ".pq"), ("pyarrow",)),
    ".gsd": ("gsd",),
}
"""The optional libraries that a file needs, by its ending."""


def require_outputs(
    found: FaultList,
    named: dict[str, Path | None],
    kinds: dict[str, tuple[str, ...]] | None = None,
    source: Path | None = None,
) -> None:
    """Add to ``found`` why the files that options name cannot be written.

    ``kinds`` are the endings that an option accepts; other options accept the endings of figures. The libraries that a file
    requires must be installed. ``source`` is an input file, which must not be overwritten.
    """
    seen: dict[Path, str] = {}
    for option, path in named.items():
        if path is None:
            continue
        endings = (kinds or {}).get(option, PICTURES)
        faults = FaultList()
        faults.attempt(lambda path=path, endings=endings: require_writable(path, endings, source=source))
        found += [of_option(option, fault) for fault in faults]
        for library in LIBRARIES.get(path.suffix.lower(), ()) if not faults else ():
            found.attempt(require_library, library, option)
        if (other := seen.setdefault(path.absolute(), option)) != option:
            found.add(f"{option} {path}", f"another file than {other}'s", "the same", "name a new one")


def of_option(option: str, fault: Fault) -> Fault:
    """Return the fault of a file with the option that names it in front of its name."""
    return Fault(advice=f"{option} {fault}")
