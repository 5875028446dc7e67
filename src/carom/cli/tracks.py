"""``carom tracks show``: summary of a track file, and velocities before and after each contact with a wall.

``carom tracks example``: films to try it with.
"""

from __future__ import annotations

import itertools
import math
import re
from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from carom.cli.console import err, working
from carom.cli.console import out as stdout
from carom.cli.options import FILM, FLOOR, option, require_outputs, shared, wrote
from carom.cli.parameters import Given, of_library
from carom.cli.streams import say_json
from carom.errors import CaromError, FaultList, shortened_list
from carom.formatting import Listing, called_ball, counted, format_length, json_value

if TYPE_CHECKING:
    from carom.cli.console import TextConsole as Console
    from carom.data.rebounds import Rebounds
    from carom.tracks.contact import TrackContact
    from carom.tracks.events import WallLine
    from carom.tracks.films import MeasuredFilms
    from carom.tracks.measurement import Measured
    from carom.tracks.pairs import PairContact
    from carom.tracks.read import TrackFile

MAX_TRACKS, MAX_ROWS = 12, 30
RATIO = "out/in"  # of v_n: the restitution
MAX_DECIMALS = 6  # a micrometre per second
NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w.])")


def facts(found: TrackFile, measured: Measured, stage: str, keep_sliding: bool) -> dict[str, Any]:
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
        "contacts": [_contact(one, stage, keep_sliding, measured.gravity) for one in measured.contacts],
        "notes": [*found.notes, *measured.notes],
    }  # fmt: skip


def _contact(one: TrackContact, stage: str, keep_sliding: bool, gravity: float) -> dict[str, Any]:
    from carom.tracks.films import rebound_height, usable_stages
    from carom.tracks.least_squares import OUTPUTS
    from carom.tracks.plausibility import impossible

    stages, why = usable_stages(one, stage, keep_sliding)  # type: ignore[arg-type]
    found: dict[str, Any] = {"group": one.group, "track": one.track, "wall": one.wall.name, "t": json_value(one.time),
             "frames_before": one.before, "frames_after": one.after, "stages": stages, "why_not": why,
             "impossible": impossible(one)}  # fmt: skip
    if one.fit is not None:
        found["fit"] = {
            "names": list(OUTPUTS),
            "values": json_value(one.fit.value),
            "covariance": json_value(one.fit.covariance),
            "chi2": one.fit.chi2, "dof": one.fit.dof, "restitution": list(one.fit.restitution),
            "rebound_height": json_value(rebound_height(one, gravity)),
        }  # fmt: skip
    return found


def _place_of(wall: WallLine) -> str:
    (x, y), n = wall.point, wall.normal
    if abs(n[0]) == 1:
        return f"x = {x:.4f} m"
    if abs(n[1]) == 1:
        return f"y = {y:.4f} m"
    return f"through ({x:.4f}, {y:.4f}) m, {math.degrees(math.atan2(abs(n[0]), abs(n[1]))):.3g}° from the x axis"


def _summary(file: TrackFile, measured: Measured) -> dict[str, str]:
    """Return what is said of a file, by its heads."""
    from carom.tracks.read import FORMATS

    rows = {"format": FORMATS[file.format].title if file.format in FORMATS else "film, tracked by carom"}
    rows |= {_label(track.group, track.name): _track_line(track) for track in file.tracks[:MAX_TRACKS]}
    if len(file.tracks) > MAX_TRACKS:
        rows["tracks"] = f"{counted(len(file.tracks) - MAX_TRACKS, 'more')}"
    steps = [f"{axis} to {format_length(x)}" for axis, x in zip("xy", measured.step, strict=True) if x]
    rounded = f"; the file rounds {' and '.join(steps)}" if steps else ""
    rows["camera"] = f"{1 / measured.interval:.5g} frames per second" if measured.interval > 0 else "frame rate unknown"
    rows[f"noise {'(given)' if measured.noise_given else '(estimated)'}"] = format_length(measured.noise) + rounded
    rows["filmed from"] = "above: a ball on a table" if measured.view == "above" else "the side: a ball in flight"
    for wall in measured.walls:
        rows[f"wall {wall.name}"] = f"{_place_of(wall)}{', positions clamped to it' if wall.clamped else ''}"
    return rows | {name: uncertain(*found) for name, found in measured.floor.items()}


def _track_line(track: Any) -> str:
    import numpy as np

    seen = track.select(track.seen)
    gaps = int((~track.seen).sum())
    spans = " × ".join(format_length(float(x)) for x in np.ptp(seen.position, axis=0)) if len(seen) else "nothing"
    missing = f", {gaps:,} missing" if gaps else ""
    return f"{counted(len(seen), 'position')}{missing}, {np.ptp(track.time):.3g} s, {spans}"


def _label(*names: str) -> str:
    return " ".join(filter(None, names))


def tell_contacts(console: Console, films: Sequence[tuple[str, Measured]], stage: str, keep_sliding: bool) -> None:
    """Print the contacts of some films, each with its name (empty for a single film), and why the others were not measured."""
    from carom.tracks.films import usable_stages
    from carom.tracks.plausibility import impossible

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
            stages, why = usable_stages(one, stage, keep_sliding)  # type: ignore[arg-type]
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


def tell_counts(console: Console, contacts: Listing, shown: int, total: int, whys: Sequence[str]) -> None:
    """Print a table of contacts, how many were measured, and the reasons why the others were not."""
    if shown:
        note = "Parentheses give the uncertainty in the last digits: 1.2292(12) is 1.2292 ± 0.0012"
        console.table(contacts._replace(note=note), grid=True)
    if shown > MAX_ROWS:
        console.print(f"and {counted(shown - MAX_ROWS, 'more row')}: --out and --json list all")
    lacking = f"; {len(whys)} not measured:" if whys else ""
    console.print(f"{counted(total, 'contact')}, {total - len(whys)} measured{lacking}")
    for count, why in grouped_reasons(whys):
        console.print(f"  {count} × {why}", soft_wrap=True)


def _contacts_table(console: Console, rows: Sequence[tuple[str, ...]]) -> tuple[Listing, list[str]]:
    """Return the table of contacts, and its heads. The restitution is shown where the console has room for it, if need be without
    the ball, where there is only one."""
    heads = ("ball", "wall", "t, s", "v_n in", "v_t in", "v_n out", "v_t out", RATIO, "stage")
    every = [i for i, head in enumerate(heads) if any(row[i] for row in rows) or head not in ("stage", RATIO)]
    wide = [max([len(head), *(len(row[i]) for row in rows)]) + 1 for i, head in enumerate(heads)]
    one_ball = len({row[0] for row in rows}) == 1
    choices = [every, every[1:] if one_ball else every]
    used = next(
        (some for some in choices if sum(wide[i] for i in some) <= console.width + 1),
        [i for i in every if heads[i] != RATIO],
    )
    heads_used = [heads[i] for i in used]
    return Listing(heads_used, [[row[i] for i in used] for row in rows]), heads_used


def _restitution(one: TrackContact) -> str:
    """Return the ratio of the normal speeds after and before a contact, with its uncertainty."""
    assert one.fit is not None
    if not one.fit["vn_in"] < 0 < one.fit["vn_out"]:
        return ""
    return uncertain(*one.fit.restitution)


def _without_names(why: str, names: Iterable[str]) -> str:
    """Return a reason without the names of other walls and balls."""
    for name in sorted(names, key=len, reverse=True):
        other = "another wall" if name.startswith("the wall") else "another ball"
        why = re.sub(rf"(?<!the )(?<!\w){re.escape(name)}(?!\w)", other, why)
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


# ----------------------------------------------------------------------------------------------------
# Output of ``carom tracks show`` with --balls: the contacts of balls with each other, and the same as JSON.


def pair_facts(one: PairContact) -> dict[str, Any]:
    """Return a contact of two balls as JSON."""
    from carom.tracks.pairs import PAIR_OUTPUTS

    found: dict[str, Any] = {"group": one.group, "striking": one.striking, "struck": one.struck, "t": json_value(one.time),
                             "why_not": one.why}  # fmt: skip
    if one.fit is not None:
        found |= {
            "restitution": list(one.restitution), "friction": list(one.friction), "chi2": one.fit.chi2, "dof": one.fit.dof,
            "names": list(PAIR_OUTPUTS), "values": json_value(one.fit.value), "covariance": json_value(one.fit.covariance),
        }  # fmt: skip
    return found


def tell_pairs(console: Console, films: Sequence[tuple[str, Sequence[PairContact]]]) -> None:
    """Print the contacts of balls with each other of some films, each with its name, and why the others were not measured."""
    rows = []
    whys, total, shown = [], 0, 0
    for film, contacts in films:
        total += len(contacts)
        whys += [one.why for one in contacts if one.fit is None]
        for one in contacts:
            fit = one.fit
            if fit is None or (shown := shown + 1) > MAX_ROWS:
                continue
            label = " ".join(filter(None, (film, one.group, one.striking)))
            parts = uncertain(fit["v1n_out"] - fit["v2n_out"], 2 * fit.error("jn"))
            before = (uncertain(sign * fit[name], fit.error(name)) for sign, name in ((-1, "vn_in"), (1, "vt_in")))
            ends = (uncertain(*one.restitution), uncertain(*one.friction))
            rows.append((label, one.struck, f"{one.time:.4f}", *before, parts, *ends))
    console.print(
        "\nBalls that strike balls at rest, m/s: v_n along the line of centres, relative, before (towards each other) and after"
        " (apart), v_t across it; out/in: restitution; friction: impulse across the line over that along it",
        soft_wrap=True,
    )
    heads = ("ball", "strikes", "t, s", "v_n in", "v_t in", "v_n out", "out/in", "friction")
    tell_counts(console, Listing(heads, rows), shown, total, whys)


# ----------------------------------------------------------------------------------------------------
# ``carom tracks show``: summary of a track file, and velocities before and after each contact with a wall.


TABLES = (".csv", ".txt", ".parquet", ".pq")
FILE, FIT = "Track file", "Contact fits"


@of_library(
    "tracks.films:measure_tracks", "tracks.video.film:track_film",
    panels={FILE: "format scale rate down view", FLOOR: "wall hard drag_per_metre", FIT: "noise window blind"},
)  # fmt: skip
def show(
    files: Annotated[
        list[Path],
        typer.Argument(
            metavar="FILE",
            help="Films, files from Tracker, Kinovea, trackpy ..., or columns t, x, y; several films make one table.",
        ),
    ],
    *,
    out: Annotated[Path | None, typer.Option(help="Write the rebounds: .csv or .parquet.")] = None,
    plot: Annotated[Path | None, shared("plot")] = None,
    json_: Annotated[bool, shared("json")] = False,
    stage: Annotated[str, typer.Option(help="Stage of balls on a table: best, after_wall, rolling or both.")] = "best",
    keep_sliding: Annotated[
        bool, typer.Option("--keep-sliding", help="Keep balls that are still sliding when they meet the wall.")
    ] = False,
    balls: Annotated[
        bool, option(FILE, "Measure balls that strike balls at rest, not balls at walls.", "--balls")
    ] = False,
    given: Given,
) -> None:
    """Summarise track files (format, tracks, frame rate, noise), and measure their contacts by fitting the physics.

    carom tracks show films/*.txt --out rebounds.csv
    """
    from carom.tracks.films import check_tracks, measure_tracks

    faults = given.faults
    if stage not in ("best", "after_wall", "rolling", "both"):
        faults.add("--stage", "one of best, after_wall, rolling, both", repr(stage))
    for file in files:
        require_outputs(faults, {"--plot": plot, "--out": out}, {"--out": TABLES}, source=file)
    if plot is not None and len(files) > 1:
        faults.add("--plot", "one film", str(len(files)), "name one file")
    given.raise_if_any(lambda: check_tracks(**given))
    console = err()
    with working("contacts", console) as bar:
        films = measure_tracks(files, progress=bar, **given)
    names, found, measured = films.names, films.files, films.measured
    written = None
    lacking = FaultList()
    table = lacking.attempt(films.rebounds, stage, keep_sliding=keep_sliding, balls=balls)
    if out is not None:
        if table is None:
            _notes(console, names, found, measured, None)
            raise CaromError(*lacking)
        written = (table.save(out), len(table))
    if plot is not None:
        from carom.plot.style import save
        from carom.plot.tracks import plot_tracks

        save(plot_tracks(measured[0]), plot)
    if json_:
        each = [facts(film, one, stage, keep_sliding) for film, one in zip(found, measured, strict=True)]
        if balls:
            each = [
                one | {"ball_contacts": [*map(pair_facts, met)]} for one, met in zip(each, films.pairs, strict=True)
            ]
        say_json(each[0] if len(each) == 1 else {"films": each})
    else:
        _tell(films, stage, keep_sliding, balls)
    _notes(console, names, found, measured, table)
    if written:
        console.print(f"{counted(written[1], 'rebound')} in the table")
        wrote(written[0])
    if plot is not None:
        wrote(plot)


@of_library(
    "tracks.video.film:track_film", without=("path", "picture_height"), panels={FILM: "balls scale rate gravity"}
)
def track(
    film: Annotated[
        Path, typer.Argument(metavar="FILM", help="A film, from a camera at rest: .mp4, .mov, .webm, .avi ...")
    ],
    *,
    out: Annotated[
        Path | None, typer.Option(help="Write the track: .csv, t, x, y upward in m; its sheet beside it.")
    ] = None,
    sheet: Annotated[
        Path | None, typer.Option(help="Draw the sheet: .png, .svg or .pdf.", show_default="beside --out")
    ] = None,
    overlay: Annotated[Path | None, typer.Option(help="Write the film with the outlines: .mp4.")] = None,
    as_json: Annotated[bool, shared("json")] = False,
    given: Given,
) -> None:
    """Track balls in a film by their outlines, with the times of its container (`carom tracks show` also measures contacts).

    carom track bounce.mp4 --length 102,655,1180,650=1m --out track.csv
    """
    from carom.tracks.video.film import track_film

    faults = given.faults
    if out is not None and sheet is None:
        sheet = out.with_suffix(".png")
    require_outputs(
        faults,
        {"--out": out, "--sheet": sheet, "--overlay": overlay},
        {"--out": (".csv",), "--overlay": (".mp4",)},
        film,
    )
    faults.raise_if_any()
    with working("balls", err()) as bar:
        found = track_film(film, progress=bar, **given)
    if as_json:
        columns = {name: column.tolist() for name, column in found.table().items()}
        say_json({
            "balls": columns, "scale": found.scale, "radius_px": found.radius_px, "exposure": found.exposure, "psf": found.psf,
            "readout": found.readout, "flagged": found.times[found.flagged].tolist(), "notes": list(found.notes),
        })  # fmt: skip
    else:
        for one in found.tracks:
            stdout().print(_track_line(one), soft_wrap=True)
        stdout().print(
            f"radius {found.radius_px:.3g} px, exposure {1e3 * found.exposure:.3g} ms, {1e3 * found.scale:.4g} mm per px",
            soft_wrap=True,
        )
    for note in found.notes:
        err().print(note, style="dim", soft_wrap=True)
    if out is not None:
        wrote(found.save(out))
    if sheet is not None:
        found.sheet(sheet)
        wrote(sheet)
    if overlay is not None:
        from carom.plot.tracks import write_overlay

        with working("overlay", err()) as bar:
            write_overlay(found, overlay, bar)
        wrote(overlay)


def example(
    folder: Annotated[Path, typer.Argument(metavar="FOLDER", help="Folder for the files; made if it is not there.")],
) -> None:
    """Write sixteen synthetic films of a ball at a cushion, as Tracker exports them, to try the commands with.

    carom tracks example films && carom tracks show films/*.txt --radius 28.6mm --out rebounds.csv

    The ball has radius 28.6 mm, the cushion's nose a height of 36 mm; one shot per film, 60 frames per second.
    """
    from carom.fitting.files import write_example_films

    paths = write_example_films(folder)
    err().print(f"written: {paths[0]} to {paths[-1].name}", soft_wrap=True)


def _tell(films: MeasuredFilms, stage: str, keep_sliding: bool, balls: bool) -> None:
    """Print what all films have in common, a table of the films, and one of all contacts."""
    told = [_summary(film, one) for film, one in zip(films.files, films.measured, strict=True)]
    common = {head: text for head, text in told[0].items() if all(one.get(head) == text for one in told)}
    stdout().facts(common.items())
    if len(told) > 1:
        heads = [head for head in dict.fromkeys(itertools.chain(*told)) if head not in common]
        rows = [[name, *(one.get(head, "") for head in heads)] for name, one in zip(films.names, told, strict=True)]
        shown = [*heads[:1], *(head.replace(" ", "\n") for head in heads[1:])]
        stdout().table(Listing(["film", *shown], rows), grid=True, fold=(1,))
    if balls:
        tell_pairs(stdout(), list(zip(films.names, films.pairs, strict=True)))
    else:
        tell_contacts(stdout(), list(zip(films.names, films.measured, strict=True)), stage, keep_sliding)


def _notes(
    console: Console,
    names: Sequence[str],
    found: Sequence[TrackFile],
    measured: Sequence[Measured],
    table: Rebounds | None,
) -> None:
    """Print the notes of all films, each once, and of their rebounds what the contacts alone do not show."""
    from carom.tracks.plausibility import needs_lines

    films: dict[str, list[str]] = {}
    for name, film, one in zip(names, found, measured, strict=True):
        for note in dict.fromkeys((*film.notes, *one.notes)):
            films.setdefault(note, []).append(name)
    notes = [
        f"all {len(names)} films: {note}" if len(of) == len(names) > 1
        else ": ".join(filter(None, (shortened_list(of), note)))
        for note, of in films.items()
    ]  # fmt: skip
    bare = [name for name, one in zip(names, measured, strict=True) if not one.measured]
    if bare and len(names) > 1:
        notes.append(f"{shortened_list(bare)}: no contact measured")
    notes += [] if table is None else [note for note in table.notes if note.startswith(("energy:", "v_t_out:"))]
    if any(needs_lines(one.contacts) for one in measured):
        notes.append("--wall x1,y1,x2,y2 gives the line of a wall by two points (m), and may be repeated")
    for note in notes:
        console.print(note, style="dim", soft_wrap=True)
