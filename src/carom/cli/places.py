"""Where a verb is to write: the faults of all its files at once, before anything is run."""

from __future__ import annotations

from pathlib import Path

from carom.cli.shared import attempt

__all__ = ["require_drawable", "require_places"]


def require_drawable(path: Path) -> None:
    """CaromError where no picture can be written to ``path``, or drawn at all."""
    from carom.plot.save import require_matplotlib, require_writable

    require_writable(path)
    require_matplotlib()


def require_places(
    found: list[str], named: dict[str, Path | None], kinds: dict[str, tuple[str, ...]] | None = None
) -> None:
    """Add the faults of an option's file to those found: where it cannot be written, or is another option's too.

    ``kinds`` are the endings that an option takes; one that is not in it is a picture.
    """
    from carom.files import require_place

    seen: dict[Path, str] = {}
    for option, path in named.items():
        if path is None:
            continue
        if kinds and option in kinds:
            faults: list[str] = []
            attempt(faults, require_place, path, kinds[option])
            found += [f"{option} {fault}" for fault in faults]
        else:
            attempt(found, require_drawable, path)
        if (other := seen.setdefault(path.absolute(), option)) != option:
            found.append(f"{option} {path}: expected another file than {other}'s, got the same; name a new one")
