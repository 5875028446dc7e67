"""Output of ``carom tracks show``: the summary of a file, the table of its contacts, and the same as JSON."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from rich.console import Console
from rich.text import Text

from carom.formatting import called_ball, counted, format_length, format_number, json_value

if TYPE_CHECKING:
    from rich.table import Table

    from carom.tracks.contact import TrackContact
    from carom.tracks.events import WallLine
    from carom.tracks.measurement import Measured
    from carom.tracks.read import TrackFile

__all__ = ["MAX_ROWS", "facts", "grouped_reasons", "tell", "tell_contacts", "tell_counts", "uncertain"]

MAX_TRACKS, MAX_ROWS = 12, 30
RATIO = "out/in"  # of v_n: the restitution
MAX_DECIMALS = 6  # a micrometre per second
NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w.])")


def facts(found: TrackFile, measured: Measured, stage: str, sliding: bool) -> dict[str, Any]:
    """Return the content of --json."""
    return {
        "file": str(found.path),
        "format": found.format,
        "view": measured.view,
        "view_reason": measured.view_reason,
        "frame_interval": json_value(measured.interval),
        "noise": json_value(measured.noise),
        "noise_given": measured.noise_given,
        "rounded_to": json_value(measured.step),
        "blind": list(measured.blind[:2]),
        "blind_stderr": list(measured.blind[2:]),
        "tracks": [
            {"group": track.group, "name": track.name, "samples": len(track), "missing": int((~track.seen).sum()),
             "time": [json_value(track.time.min()), json_value(track.time.max())]} for track in found.tracks
        ],
        "walls": [{"name": one.name, "point": one.point, "normal": one.normal, "clamped": one.clamped, "found": one.found}
                  for one in measured.walls],
        "floor": {name: {"value": value, "stderr": error} for name, (value, error) in measured.floor.items()},
        "contacts": [_contact(one, stage, sliding) for one in measured.contacts],
        "notes": [*found.notes, *measured.notes],
    }  # fmt: skip


def _contact(one: TrackContact, stage: str, sliding: bool) -> dict[str, Any]:
    from carom.tracks.least_squares import OUTPUTS
    from carom.tracks.plausibility import impossible
    from carom.tracks.rebounds import usable_stages

    stages, why = usable_stages(one, stage, sliding)  # type: ignore[arg-type]
    found: dict[str, Any] = {"group": one.group, "track": one.track, "wall": one.wall.name, "t": json_value(one.time),
             "frames_before": one.before, "frames_after": one.after, "stages": stages, "why_not": why,
             "impossible": impossible(one)}  # fmt: skip
    if one.fit is not None:
        found["fit"] = {
            "names": list(OUTPUTS),
            "values": json_value(one.fit.value),
            "covariance": json_value(one.fit.covariance),
            "chi2": one.fit.chi2,
            "dof": one.fit.dof,
        }
    return found


def _place_of(wall: WallLine) -> str:
    (x, y), n = wall.point, wall.normal
    if abs(n[0]) == 1:
        return f"x = {x:.4f} m"
    if abs(n[1]) == 1:
        return f"y = {y:.4f} m"
    return f"through ({x:.4f}, {y:.4f}) m, {math.degrees(math.atan2(abs(n[0]), abs(n[1]))):.3g}° from the x axis"


def tell(console: Console, found: TrackFile, measured: Measured) -> None:
    """Print the summary of a file."""
    from rich.table import Table

    from carom.tracks.read import FORMATS

    rows = Table(box=None, show_header=False, padding=(0, 2, 0, 0))
    rows.add_row(Text("format", "bold"), FORMATS[found.format].title)
    for track in found.tracks[:MAX_TRACKS]:
        rows.add_row("track", _track_line(track))
    if len(found.tracks) > MAX_TRACKS:
        rows.add_row("", f"and {counted(len(found.tracks) - MAX_TRACKS, 'more track')}")
    rows.add_row(
        "camera", f"{1 / measured.interval:.5g} frames per second" if measured.interval > 0 else "frame rate unknown"
    )
    steps = [f"{axis} to {format_length(x)}" for axis, x in zip("xy", measured.step, strict=True) if x]
    rounded = f"; the file rounds {' and '.join(steps)}" if steps else ""
    rows.add_row(
        "noise", f"{format_length(measured.noise)} {'(given)' if measured.noise_given else '(estimated)'}{rounded}"
    )
    rows.add_row(
        "filmed from", "above: a ball on a table" if measured.view == "above" else "the side: a ball in flight"
    )
    for wall in measured.walls:
        rows.add_row("wall", f"{wall.name}: {_place_of(wall)}{', positions clamped to it' if wall.clamped else ''}")
    for name, (value, error) in measured.floor.items():
        rows.add_row(name, f"{format_number(value)} ± {format_number(error, 1)}")
    console.print(rows)


def _track_line(track: Any) -> str:
    import numpy as np

    seen = track.select(track.seen)
    gaps = int((~track.seen).sum())
    spans = " × ".join(format_length(float(x)) for x in np.ptp(seen.position, axis=0)) if len(seen) else "nothing"
    return (
        f"{_label(track.group, track.name)}: {counted(len(seen), 'position')}{f', {gaps:,} missing' if gaps else ''},"
        f" {np.ptp(track.time):.3g} s, {spans}"
    )


def _label(*names: str) -> str:
    return " ".join(filter(None, names))


def tell_contacts(console: Console, films: Sequence[tuple[str, Measured]], stage: str, sliding: bool) -> None:
    """Print the contacts of some films, each with its name (empty for a single film), and why the others were not measured."""
    from carom.tracks.plausibility import impossible
    from carom.tracks.rebounds import usable_stages

    rows: list[tuple[str, ...]] = []
    whys: list[str] = []
    shown = total = 0
    for film, measured in films:
        total += len(measured.contacts)
        names = [
            *(f"the wall {wall.name}" for wall in measured.walls),
            *(called_ball(track.name) for track in measured.tracks),
        ]
        for one in measured.contacts:
            stages, why = usable_stages(one, stage, sliding)  # type: ignore[arg-type]
            if not stages:
                whys.append(_without_names(why, names))
            for name in stages:
                shown += 1
                if shown > MAX_ROWS:
                    continue
                tail = "roll" if name == "rolling" else "out"
                cells = [_with_error(one, key, sign) for key, sign in
                         (("vn_in", -1), ("vt_in", 1), (f"vn_{tail}", 1), (f"vt_{tail}", 1))]  # fmt: skip
                label = _label(film, one.group, one.track)
                flag = "restitution above 1" if impossible(one) else ""
                restitution = "" if name == "rolling" else _restitution(one)
                end = _label("" if one.planar else name, flag)
                rows.append((label, one.wall.name, f"{one.time:.4f}", *cells, restitution, end))
    contacts, heads = _contacts_table(console, rows)
    console.print(
        "\nVelocities before (v_n toward the wall) and after the contact (v_n away from it), v_t along the wall, m/s"
        + (f"; {RATIO}: restitution, v_n out / v_n in" if RATIO in heads else ""),
        soft_wrap=True,
    )
    tell_counts(console, contacts, shown, total, whys)


def tell_counts(console: Console, contacts: Table, shown: int, total: int, whys: Sequence[str]) -> None:
    """Print a table of contacts, how many were measured, and the reasons why the others were not."""
    if shown:
        console.print(contacts)
        console.print(
            "Parentheses give the uncertainty in the last digits: 1.2292(12) is 1.2292 ± 0.0012",
            style="dim",
            soft_wrap=True,
        )
    if shown > MAX_ROWS:
        console.print(f"and {counted(shown - MAX_ROWS, 'more row')}: --out and --json list all")
    found = (counted(total, "contact"), "bold")
    console.print(
        Text.assemble(found, f", {total - len(whys)} measured", f"; {len(whys)} not measured:" if whys else "")
    )
    for count, why in grouped_reasons(whys):
        console.print(f"  {count} × {why}", soft_wrap=True)


def _contacts_table(console: Console, rows: Sequence[tuple[str, ...]]) -> tuple[Table, list[str]]:
    """Return the table of contacts, and its heads. The restitution is shown where the console has room for it, if need be without
    the ball, where there is only one."""
    from rich.table import Table

    heads = ("ball", "wall", "t, s", "v_n in", "v_t in", "v_n out", "v_t out", RATIO, "stage")
    every = [i for i, head in enumerate(heads) if any(row[i] for row in rows) or head not in ("stage", RATIO)]
    wide = [max([len(head), *(len(row[i]) for row in rows)]) + 1 for i, head in enumerate(heads)]
    one_ball = len({row[0] for row in rows}) == 1
    choices = [every, every[1:] if one_ball else every]
    used = next(
        (some for some in choices if sum(wide[i] for i in some) <= console.width + 1),
        [i for i in every if heads[i] != RATIO],
    )
    table = Table(box=None, padding=(0, 1, 0, 0), header_style="dim")
    for i in used:
        left = heads[i] in ("ball", "wall", "stage")
        table.add_column(heads[i], justify="left" if left else "right", no_wrap=True)
    for row in rows:
        table.add_row(*(row[i] for i in used))
    return table, [heads[i] for i in used]


def _restitution(one: TrackContact) -> str:
    """Return the ratio of the normal speeds after and before a contact, with its uncertainty."""
    assert one.fit is not None
    if not one.fit["vn_in"] < 0 < one.fit["vn_out"]:
        return ""
    return uncertain(*one.fit.restitution)


def _without_names(why: str, names: Iterable[str]) -> str:
    """Return a reason without the names of other walls and balls."""
    for name in sorted(names, key=len, reverse=True):
        why = re.sub(
            re.escape(name) + r"(?!\w)", "another wall" if name.startswith("the wall") else "another ball", why
        )
    return why


def grouped_reasons(whys: Iterable[str]) -> list[tuple[int, str]]:
    """Return how often each reason occurs, the most frequent first; reasons that differ in numbers only are one, with their range.

    Examples
    --------
    >>> grouped_reasons(["2 frames before, expected 4", "no wall", "0 frames before, expected 4"])
    [(2, '0 to 2 frames before, expected 4'), (1, 'no wall')]
    """
    groups: dict[str, list[list[str]]] = {}
    for why in whys:
        groups.setdefault(NUMBER.sub("\0", why), []).append(NUMBER.findall(why))
    found = Counter({_with_ranges(key, rows): len(rows) for key, rows in groups.items()})
    return [(count, why) for why, count in found.most_common()]


def _with_ranges(pattern: str, rows: Sequence[Sequence[str]]) -> str:
    """Fill in the numbers of all rows: each as it is where all agree, else the least and the greatest."""
    text = pattern
    for column in zip(*rows, strict=True):
        low, high = min(column, key=float), max(column, key=float)
        text = text.replace("\0", low if low == high else f"{low} to {high}", 1)
    return text


def _with_error(one: TrackContact, name: str, sign: int) -> str:
    """Return a value with its uncertainty in the last two digits: 1.2292(12) is 1.2292 ± 0.0012."""
    assert one.fit is not None
    return uncertain(sign * one.fit[name], one.fit.error(name))


def uncertain(value: float, error: float) -> str:
    """Return a value with its uncertainty in the last digits."""
    digits = 1 - math.floor(math.log10(error)) if 0 < error < 1 else 1 if error else MAX_DECIMALS
    digits = min(digits, MAX_DECIMALS)
    return f"{value:.{digits}f}({error * 10**digits:.0f})"
