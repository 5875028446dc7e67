"""``carom fit TRACK --whole``: laws against whole tracks, each simulated from a start of its own."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from carom.checks import few, meant
from carom.cli.fit_options import length_of
from carom.cli.shared import attempt, noting, page_of, tell
from carom.errors import CaromError

if TYPE_CHECKING:
    from carom.fitting import Setting
    from carom.fitting.whole_rank import WholeRanking
    from carom.tracks.formats.sheet import Given
    from carom.tracks.track import Track

__all__ = ["NUMBERS", "fit_tracks"]

NUMBERS = ("rolling_resistance", "spin_loss", "wall_left", "wall_right", "wall_bottom", "wall_top")
"""Numbers of whole tracks that a table of rebounds does not have."""
READ = 0.4  # of the bar: until all contacts are measured


def fit_tracks(
    file: Path, given: Setting, laws: Sequence[str], reading: Given, frames: tuple[str | None, Sequence[str], int, str | None],
    pages: tuple[Path | None, bool, bool], faults: list[str], bar: Any,
) -> None:  # fmt: skip
    """Read, measure, fit, show.

    ``frames``: the view, what ``--where`` says, the contacts to follow, the noise. ``pages``: the report, None for none; whether
    it is a fault if it cannot be made; whether JSON is wanted. ``faults``: of the options, so far.
    """
    from rich.console import Console

    from carom.cli.fit_input import is_track
    from carom.fitting.whole_laws import WholeSetting
    from carom.fitting.whole_rank import fit_whole
    from carom.tracks.contact import Settings
    from carom.tracks.measure import measure
    from carom.tracks.read import read_tracks

    (view, where, cushions, noise), (page, insists, as_json) = frames, pages
    # (a number of the table like others there: fitted unless it is told)
    fixed = given.fixed if given.floor_friction is None else {"floor_friction": given.floor_friction} | given.fixed
    setting = WholeSetting(
        radius=given.radius, kappa=given.kappa, noise=attempt(faults, length_of, "noise", noise),
        contact_height=given.contact_height, restitution=given.restitution, floor_restitution=given.floor_restitution,
        cushions=cushions, spin_width=given.spin_width or 1.25, fit=given.fit, fixed=fixed, bounds=given.bounds,
    )  # fmt: skip
    attempt(faults, setting.check)
    if given.floor_friction is not None and not 0 <= given.floor_friction < float("inf"):
        faults.append(f"floor_friction: expected a number of at least 0, got {given.floor_friction!r}")
    if file.is_file() and not is_track(file):
        faults.append(f"{file}: expected a track with --whole, got a table of rebounds; leave out --whole")
    if view == "side":
        faults.append("--view: expected above with --whole (balls on a table), got side")
    if faults:
        raise CaromError(*faults)
    console = Console(stderr=True, highlight=False)
    with bar(console) as say:
        read = read_tracks(file, given=reading)
        settings = Settings(radius=setting.radius, kappa=setting.kappa, view="above", noise=setting.noise)
        with noting(read.notes):
            tracks = _chosen(read.tracks, where)
            measured = measure(tracks, settings, lambda done, total: say("contacts", READ * done / max(total, 1)))
        measured = replace(measured, notes=(*read.notes, *measured.notes))
        with noting(measured.notes):
            ranking = fit_whole(
                measured, setting, laws or None, say=lambda what, done: say(what, READ + (1 - READ) * done)
            )
        say("the page", 1.0)
        written = None if page is None else page_of(lambda: _page(ranking, file, page), insists, console)
    tell(ranking, _show, as_json, console, written)


def _chosen(tracks: Sequence[Track], where: Sequence[str]) -> list[Track]:
    """The tracks that ``--where shot=...`` and ``--where ball=...`` name."""
    found, faults = list(tracks), []
    for text in where:
        name, _equals, value = text.partition("=")
        if name not in ("shot", "ball") or not value:
            faults.append(f"--where: expected shot=NAME or ball=NAME with --whole, got {text!r}")
            continue
        known = list(dict.fromkeys(track.group if name == "shot" else track.name for track in tracks))
        if value not in known:
            faults.append(f"--where {name}: expected one of {few(known)}, got {value!r}{meant(value, known)}")
        found = [track for track in found if (track.group if name == "shot" else track.name) == value]
    if faults:
        raise CaromError(*faults)
    return found


def _page(ranking: WholeRanking, file: Path, page: Path) -> Path:
    from carom.plot.whole import write_whole_report

    return write_whole_report(ranking, str(file), page)


def _show(ranking: WholeRanking) -> None:
    """The ranking as a table, and the sentences below it."""
    import numpy as np
    from rich import box
    from rich.table import Table
    from rich.text import Text

    from carom.cli.shared import out
    from carom.fitting.output import with_error_bar

    console, best = out(), ranking.best
    tracks = best.frames.stretches
    console.print(
        f"{len(tracks)} stretches of track, {sum(len(one.contacts) for one in tracks)} contacts,"
        f" {int(best.frames.count.sum()):,} frames; noise {1e3 * best.noise:.3g} mm {'as given' if best.known else 'found'}"
    )
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, header_style="bold")
    for head, side in (
        ("law", "left"),
        ("AICc", "right"),
        ("chi²/dof", "right"),
        ("RMS, mm", "right"),
        ("numbers", "left"),
    ):
        table.add_column(head, justify=side, no_wrap=head != "numbers")  # type: ignore[arg-type]
    for fit in ranking.fits:
        middle = 1e3 * float(np.median([fit.rms([n]) for n in range(len(fit.q))]))
        numbers = ", ".join(
            f"{name} {with_error_bar(estimate)}"
            for name, estimate in fit.estimates.items()
            if not name.startswith("wall_")
        )
        table.add_row(
            fit.law.name,
            f"{fit.aicc:.1f}" if fit is best else f"+{fit.aicc - best.aicc:.1f}",
            f"{fit.chi2:.4g}/{fit.dof:.0f}" if fit.known else "–",
            f"{middle:.3g}",
            numbers,
            style="bold" if fit is best else None,
        )
    console.print(table)
    console.print(
        f"RMS: of the middle stretch; {best.law.name} over all {1e3 * best.rms():.3g} mm. Where the centres turn: --json, page",
        style="dim",
    )
    sure = "prefer" in ranking.verdict
    console.print(Text(ranking.verdict, style="bold green" if sure else "bold yellow"), soft_wrap=True)
    for sentence in dict.fromkeys(s for fit in ranking.fits for s in fit.degenerate):
        console.print(Text(f"not told: {sentence}"), soft_wrap=True)
