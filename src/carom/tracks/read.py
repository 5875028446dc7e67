"""Read track files: which program wrote one, its tracks, and files that are no tables.

Files that are no tables: projects of tracking programs, pictures, spreadsheets; and the menu that exports positions as text.
"""

from __future__ import annotations

import contextlib
import csv
import io
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.data.columns import as_columns, is_columns
from carom.data.rebound_files import heads_rebounds
from carom.errors import CaromError, Fault, FaultList, shortened_list, suggestion
from carom.files import as_path, open_regular, read_text
from carom.public.defaults import GRAVITY
from carom.tracks.flights import in_a_plane, likely_unit
from carom.tracks.formats import pooltool, programs
from carom.tracks.formats import tables as columns
from carom.tracks.formats.missing import without_marked_places
from carom.tracks.formats.pooltool import open_file
from carom.tracks.formats.tables import Calibration, first_rows
from carom.tracks.plausibility import flight_gravity
from carom.tracks.preprocess import (
    MIN_INTERVAL_S,
    at_rate,
    times_in_words,
    with_one_name,
    with_own_names,
    without_rounding,
)
from carom.tracks.track import Track, position_noise
from carom.tracks.video.film import track_film
from carom.tracks.video.reading import TrackedFilm, is_film
from carom.tracks.video.scale import SLOWED, slowed_note

START = 1 << 16  # bytes from which a file is recognised
TRACKER = "export the positions with Tracker's menu File > Export > Data File"
KINOVEA = "export the positions with Kinovea's menu File > Export to spreadsheet, as CSV"
TRACKMATE = "export the spots as a table: TrackMate's last panel, Spots, Export to CSV"
SLEAP = "export the positions with SLEAP's menu File > Export Analysis CSV"
DEEPLABCUT = (
    "write it as CSV with deeplabcut.analyze_videos_converth5_to_csv, or analyse the film with save_as_csv=True"
)
LOGGER_PRO = "export the positions with Logger Pro's menu File > Export As > CSV"
VERNIER = "export the positions with the program's menu File > Export > CSV"
IDTRACKER = "write the trajectories of idtracker.ai as CSV (trajectories_formats = csv)"
MATLAB = "write the positions as CSV with MATLAB's writetable, under names such as t, x, y"
PANDAS = "write the data frame as CSV with its method to_csv"
BALL = "track the ball first, with Tracker or Kinovea, and export its positions"
TABLE = "export the positions as a table of text (CSV) from the program that made it"


@dataclass(frozen=True)
class ForeignFile:
    """A file that holds no table of text.

    Examples
    --------
    >>> foreign_file("ball.trk", b"<?xml version='1.0'?><object class='org.opensourcephysics.cabrillo.tracker.TrackerPanel'>").what
    'a project of Tracker'
    """

    what: str
    advice: str


ARCHIVE = ("a spreadsheet or another archive (zip)", "save the sheet as CSV")
XML = ("an XML file", TABLE)
# What a file begins with or has near its beginning, and what it is; the first that is found counts.
BEGINNINGS = (
    (b"\x89PNG", "a picture (PNG)", BALL), (b"\xff\xd8\xff", "a picture (JPEG)", BALL), (b"GIF8", "a picture (GIF)", BALL),
    (b"MATLAB", "a MATLAB file", MATLAB), (b"\x93NUMPY", "a NumPy array", "write it with numpy.savetxt, delimiter and header"),
    (b"PAR1", "a Parquet file", PANDAS), (b"ARROW1", "a Feather file", PANDAS), (b"\x80\x04", "a pickle of Python", PANDAS),
    (b"\x80\x05", "a pickle of Python", PANDAS), (b"\x80\x03", "a pickle of Python", PANDAS),
    (b"\xd0\xcf\x11\xe0", "an old spreadsheet (xls)", "save the sheet as CSV"),
    (b"PK\x03\x04", *ARCHIVE), (b"\x1aE\xdf\xa3", "a film", BALL), (b"RIFF", "a film (AVI)", BALL), (b"%PDF", "a PDF", TABLE),
)  # fmt: skip
WITHIN = (
    (b"org.opensourcephysics", "a project of Tracker", TRACKER),
    (b"<KinoveaVideoAnalysis", "a file of annotations of Kinovea", KINOVEA),
    (b"<TrackMate", "a project of TrackMate", TRACKMATE),
    (b"<Tracks ", "tracks of TrackMate as XML", TRACKMATE),
    (b"<?xml", *XML),
    (b"<html", "a web page", TABLE),
)
HDF5 = (b"\x89HDF\r\n\x1a\n", "an HDF5 file", TABLE)
MARKUP = ("a file of markup", TABLE)
IN_HDF5 = (
    (b"df_with_missing", "positions of DeepLabCut (HDF5)", DEEPLABCUT),
    (b"node_names", "an analysis of SLEAP (HDF5)", SLEAP), (b"track_occupancy", "an analysis of SLEAP (HDF5)", SLEAP),
    (b"suggestions_json", "a project of SLEAP", SLEAP), (b"id_probabilities", "trajectories of idtracker.ai", IDTRACKER),
)  # fmt: skip
SHARED = (HDF5[1:], MARKUP, ARCHIVE, XML, ("a MATLAB file", MATLAB))
ENDINGS = {
    ".trk": ("a project of Tracker", TRACKER), ".trz": ("a project of Tracker", TRACKER),
    ".kva": ("a file of annotations of Kinovea", KINOVEA), ".slp": ("a project of SLEAP", SLEAP),
    ".cmbl": ("a file of Logger Pro", LOGGER_PRO), ".gambl": ("a file of Graphical Analysis", VERNIER),
    ".vmbl": ("a file of Video Analysis", VERNIER), ".mat": ("a MATLAB file", MATLAB),
    ".pkl": ("a pickle of Python", PANDAS), ".pickle": ("a pickle of Python", PANDAS),
    ".xlsx": ("a spreadsheet", "save the sheet as CSV"), ".ods": ("a spreadsheet", "save the sheet as CSV"),
    **dict.fromkeys((".mp4", ".mov", ".avi", ".mkv"), ("a film", BALL)),
}  # fmt: skip


def foreign_file(path: str | Path, start: bytes) -> ForeignFile | None:
    """Return the kind of a file that holds no table of text, from its name and its first bytes; None if it may hold one."""
    ending = ENDINGS.get(Path(path).suffix.lower())
    found = _from_start(start)
    if found is not None:  # a name says more than the beginnings that many programs share
        return ForeignFile(*(ending if ending and found in SHARED else found))
    return ForeignFile(*ending) if ending and b"\0" in start else None


def _from_start(start: bytes) -> tuple[str, str] | None:
    """Return the kind of file that begins with these bytes, and the advice; None if they may be a table of text."""
    plain = start.replace(b"\0", b"")
    if start.startswith(HDF5[0]):
        return next(((what, advice) for sign, what, advice in IN_HDF5 if sign in start), HDF5[1:])
    if plain.lstrip(b"\xef\xbb\xbf\xff\xfe \t\r\n").startswith(b"<"):
        return next(((what, advice) for sign, what, advice in WITHIN if sign in plain), MARKUP)
    if start[4:8] == b"ftyp":
        return "a film (MP4)", BALL
    return next(((what, advice) for sign, what, advice in BEGINNINGS if start.startswith(sign)), None)


# ----------------------------------------------------------------------------------------------------
# Track files: recognise the program that wrote one, read its tracks, and check them.


MESSAGE_PACK = ".msgpack"
OF_REBOUNDS = ("v_n_in", "vn_in", "v_n_out", "vn_out", "v_t_in", "vt_in")  # columns

PICTURE_SETTINGS = ("length", "ball", "colour", "region", "corners", "marks", "start", "end")
MIN_POSITIONS = 9  # fewer cannot hold a contact
# Beyond these a number is damaged, or its unit wrong.
MAX_POSITION_M, MAX_TIME_S = 1e9, 1e9
OTHER_DAY_S = 1e7  # no film is as long: such times count from another day than the film's
# Of films without a word on their unit: larger, smaller or faster than those that are taken of balls, in m and m/s.
SMALLEST_FILM_M, LARGEST_FILM_M, FASTEST_BALL = 5e-3, 20.0, 80.0
USUAL_SHARE = 0.9  # of the steps from frame to frame: the fastest may be errors
MAX_NOISE_RATIO = 20.0  # of the two coordinates, in one unit
JUMP_STEPS = 30.0  # times the usual step: no ball moves so far between two frames


@dataclass(frozen=True)
class Format:
    """A file format: a test of whether a text has it, and the reader of its tracks."""

    title: str
    matches: Callable[[str], bool]
    read: Callable[[str, str, Calibration], list[Track]]


# Tried in this order; the last accepts any table with columns x and y.
FORMATS = {
    "tracker": Format("Tracker (Open Source Physics)", programs.is_tracker, programs.tracker),
    "kinovea": Format("Kinovea", programs.is_kinovea, programs.kinovea),
    "deeplabcut": Format("DeepLabCut", programs.is_deeplabcut, programs.deeplabcut),
    "sleap": Format("SLEAP analysis", programs.is_sleap, programs.sleap),
    "carom-table": Format("carom table (JSON)", programs.is_carom_table, programs.carom_table),
    "tailuge": Format("tailuge/billiards (JSON)", programs.is_tailuge, programs.tailuge),
    "pooltool": Format("pooltool's recorded shot", pooltool.matches, pooltool.read),
    "trackpy": Format("trackpy data frame", programs.is_trackpy, programs.trackpy),
    "trackmate": Format("TrackMate spots", programs.is_trackmate, programs.trackmate),
    "mtrack2": Format("MTrack2 (ImageJ)", programs.is_mtrack2, programs.mtrack2),
    "idtracker": Format("idTracker", programs.is_idtracker, programs.idtracker),
    "columns": Format("named columns", columns.matches, columns.read),
}
FILM = "film"


@dataclass(frozen=True, eq=False)
class TrackFile:
    """The tracks of a file, its format, and notes on how it was read.

    Examples
    --------
    >>> import tempfile, pathlib
    >>> from carom.tracks import read_tracks
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "shot.csv"
    ...     _ = path.write_text("t,x,y\\n0,0,0\\n0.1,1,1\\n")
    ...     file = read_tracks(path)
    >>> file.format, len(file.tracks), file.notes[0]
    ('columns', 1, "no unit in 't', 'x', 'y': assumed to be m and s")
    """

    path: Path
    format: str
    tracks: tuple[Track, ...]
    notes: tuple[str, ...]
    film: TrackedFilm | None = None
    """The film, where carom tracked the balls itself."""


def read_tracks(path: str | Path, format: str | None = None, calibration: Calibration | None = None) -> TrackFile:  # noqa: A002
    """Read the tracks of a file that a tracking program wrote, in SI units.

    Parameters
    ----------
    path : path
        A file of one of the programs in FORMATS, any table with columns t, x, y, or a film.
    format : str, optional
        A key of FORMATS; by default the format is recognised from the content.
    calibration : Calibration, optional
        Scale and frame rate, if the file lacks them.

    Returns
    -------
    TrackFile
        Tracks in SI units, the format, and notes.

    Raises
    ------
    CaromError
        One line per problem: an unknown format, cells that are not numbers, decreasing times, missing columns by name.

    Examples
    --------
    >>> import tempfile, pathlib
    >>> from carom.tracks import Calibration, read_tracks
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "shot.csv"
    ...     _ = path.write_text("frame,x [px],y [px]\\n0,10,20\\n1,12,30\\n")
    ...     tracks = read_tracks(path, calibration=Calibration(scale=0.001, rate=100)).tracks
    >>> tracks[0].time, tracks[0].position  # pixels count downward
    (array([0.  , 0.01]), array([[ 0.01 , -0.02 ],
           [ 0.012, -0.03 ]]))
    """
    path, calibration = as_path("read_tracks", path), calibration or Calibration()
    _check(calibration)
    if path.is_dir():
        raise CaromError(f"{path}: expected a track file, got a folder")
    if format is not None and format not in FORMATS:
        raise CaromError(
            Fault("tracks", "format", "the name of a format", repr(format), suggestion(format, list(FORMATS)))
        )
    if is_film(path) and format is None:
        return _of_film(track_film(path, **{"scale": calibration.scale, "rate": calibration.rate, **calibration.film}))
    if path.suffix.lower() == MESSAGE_PACK:
        return _with_positions(path, "pooltool", pooltool.tracks_of(open_file(path), calibration), calibration)
    require_text(path, "positions")
    text = track_text(path)
    if not text.strip():
        raise CaromError(f"{path}: expected a track, got an empty file")
    name = format or format_of(text)
    if name is None and is_table_of_rebounds(text):
        advice = "carom fit and carom predict take it as it is"
        raise CaromError(Fault(f"{path}", "", "a track", "a table of rebounds", advice))
    if name is None:
        raise CaromError(
            f"{path}: expected a track of {', '.join(FORMATS)}, {got_instead(text)}; a table can always be read if its header"
            f" is like {columns.HEADER_EXAMPLE!r} or 't/s;x/cm;height/cm'; or name the format with `format`"
        )
    return _tracks_of_text(path, text, name, calibration)


def _tracks_of_text(path: Path, text: str, name: str, calibration: Calibration) -> TrackFile:
    """Return the tracks in a text of a format; ``path`` says where it stands. Raises CaromError as :func:`read_tracks` does."""
    return _with_positions(path, name, FORMATS[name].read(str(path), text, calibration), calibration)


def require_table_settings(path: str | Path, calibration: Calibration) -> None:
    """Raise CaromError where what applies to pictures alone is given for positions in numbers."""
    _check(calibration)
    faults = FaultList(f"{path}")
    if word := calibration.film.get("scale"):
        advice = "of films alone it is found by gravity"
        faults.add("`scale`", "the length of a unit of its positions, such as 1cm", repr(word), advice)
    unused = ("picture_height",) * (not calibration.film.get("readout"))
    for name in (*PICTURE_SETTINGS, *unused):
        if calibration.film.get(name):
            faults.add(f"`{name}`", "a film (it applies to pictures alone)", "a table of positions", "omit it")
    faults.raise_if_any()


def _with_positions(path: Path, name: str, tracks: list[Track], calibration: Calibration) -> TrackFile:
    require_table_settings(path, calibration)
    if not tracks or not any(track.seen.any() for track in tracks):
        raise CaromError(f"{path}: {FORMATS[name].title}: expected positions of a ball, got none")
    if name != "columns":  # (which does so before its units are converted)
        tracks = [without_marked_places(track, calibration.scale or 1.0) for track in tracks]
    found = _checked_tracks(path, name, tracks, calibration)
    return replace(found, tracks=tuple(read_by_rows(path, found.tracks, calibration)))


def read_by_rows(path: str | Path, tracks: Sequence[Track], calibration: Calibration) -> Sequence[Track]:
    """Return tracks with the times at which the camera has read their rows, where it is known how long it reads a picture."""
    readout, height = (calibration.film.get(one) for one in ("readout", "picture_height"))
    if not readout:
        return tracks
    if not height:
        wanted = "the height of the picture in the scene, m, with `readout`"
        raise CaromError(Fault(f"{path}", "`picture_height`", wanted, "none"))
    # (a row that is lower in the picture is read later; where the picture begins shifts all times alike)
    seen = [one.select(one.seen) for one in tracks]
    return [replace(one, time=one.time - readout * one.position[:, 1] / height, stamped=True) for one in seen]


def _checked_tracks(path: Path, name: str, tracks: Sequence[Track], calibration: Calibration) -> TrackFile:
    """Return tracks with increasing times and on one clock, with notes; CaromError for times and places that cannot be right."""
    notes: list[str] = []
    faults = FaultList(str(path))
    checked = [_in_order(track, notes, faults) for track in _from_zero(tracks, notes)]
    faults.raise_if_any()
    if all(track.stamped for track in checked):
        pass
    elif calibration.rate is not None:
        checked = at_rate(checked, calibration.rate, str(path), notes)
    else:
        checked = without_rounding(checked, notes)
    checked = [_one_row_per_time(track, notes) for track in checked]
    checked = with_own_names(with_one_name([track for track in checked if track.seen.any()], notes), notes)
    if calibration.scale is None:
        _require_likely_unit(checked, str(path))
    for track in checked:
        notes += [note for note in track.notes if note not in notes]
    _plausibility_notes(checked, notes)
    return TrackFile(path, name, tuple(checked), tuple(notes))


def _of_film(film: TrackedFilm) -> TrackFile:
    """Return the tracks of a film that carom tracked, with its notes."""
    found = _checked_tracks(film.path, FILM, film.tracks, Calibration(scale=film.scale))
    return replace(found, notes=(*film.notes, *found.notes), film=film)


def film_of(
    one: Any, number: int, calibration: Calibration | None = None, format: str | None = None,  # noqa: A002
) -> TrackFile:  # fmt: skip
    """Return the tracks of a film: a file, columns in memory, tracks, or a file that was read before."""
    if isinstance(one, TrackFile):
        return one
    known = calibration or Calibration()
    if is_columns(one):
        rows = io.StringIO()
        columns = as_columns(one, "measure_tracks: files")
        csv.writer(rows).writerows(
            [list(columns), *zip(*(column.tolist() for column in columns.values()), strict=True)]
        )
        return _tracks_of_text(Path(f"table {number}"), rows.getvalue(), "columns", known)
    if isinstance(one, TrackedFilm):
        return _of_film(one)
    tracks = [one] if isinstance(one, Track) else one
    if isinstance(tracks, list | tuple) and tracks and all(isinstance(track, Track) for track in tracks):
        if known.scale is not None:
            raise CaromError("measure_tracks: `scale` has no effect with Tracks, which are in m; omit it")
        return _checked_tracks(Path(f"film {number}"), "tracks", tracks, known)
    if not isinstance(one, str | Path):
        wanted = "the name of a track file, columns t, x, y, or Tracks"
        raise CaromError(Fault("measure_tracks", "files", wanted, f"{type(one).__name__} {one!r:.60}"))
    return read_tracks(one, format, calibration)


def require_text(path: Path, wanted: str) -> None:
    """Raise CaromError for a file that is a project, a picture or a spreadsheet, with the menu that exports a table of text."""
    with open_regular(path) as file:
        foreign = foreign_file(path, file.read(START))
        if foreign is not None:
            raise CaromError(f"{path}: expected {wanted}, as text, got {foreign.what}; {foreign.advice}")


def track_text(path: Path) -> str:
    """Return the text of a file, whatever its line ends."""
    return read_text(path).replace("\r\n", "\n").replace("\r", "\n")


def format_of(text: str) -> str | None:
    """Return the format of a text, a key of FORMATS; None if it is none of them.

    Examples
    --------
    >>> format_of("t [s],x [cm],y [cm]\\n0,1,2\\n"), format_of("vx,vy\\n1,2\\n")
    ('columns', None)
    """
    return next((name for name, one in FORMATS.items() if one.matches(text)), None)


def is_table_of_rebounds(text: str) -> bool:
    """Return whether a text is taken for a table of rebounds: its first lines name a column of such a table.

    Examples
    --------
    >>> is_table_of_rebounds("v_n_in,v_t_in,v_n_out,v_t_out,spin_in\\n1,1,0.8,1,0\\n"), is_table_of_rebounds("t,x,y\\n")
    (True, False)
    """
    return any(name in text[:START].lower() for name in OF_REBOUNDS) or heads_rebounds(text[:START])


def got_instead(text: str) -> str:
    """Return the description of a text of no known format, for a message: its columns, or its beginning.

    Examples
    --------
    >>> got_instead("vx,vy\\n1,2\\n"), got_instead("Hello")
    ('got the columns vx, vy', "got a file that begins 'Hello'")
    """
    rows = first_rows(text, 1)
    cells = [cell.strip() for cell in rows[0] if cell.strip()] if rows else []
    if len(cells) > 1 and not any(re.match(r"[-+.\d]", cell) for cell in cells):
        return f"got the columns {', '.join(cells):.100}"
    return f"got a file that begins {text.strip().splitlines()[0][:60]!r}"


def _check(calibration: Calibration) -> None:
    faults = FaultList()
    for name, value in (("scale", calibration.scale), ("rate", calibration.rate)):
        if value is not None and not 0 < value < np.inf:
            faults.add(f"`{name}`", "a number above 0", repr(value))
    faults.raise_if_any()


def _from_zero(tracks: Sequence[Track], notes: list[str]) -> Sequence[Track]:
    """Return tracks with times from the first row on, where they count from another day: seconds since 1970, or parts of them."""
    times = np.concatenate([track.time[np.isfinite(track.time)] for track in tracks])
    first = float(times.min()) if len(times) else 0.0
    if first < OTHER_DAY_S:
        return tracks
    # (between 2001 and 2128, in units of 1, 1e-3, 1e-6 or 1e-9 s)
    part = next((part for part in (1.0, 1e-3, 1e-6, 1e-9) if 1e9 <= first * part < 5e9), 1.0)
    since = "" if part == 1 else f", counted in units of {part:g} s,"
    notes.append(
        f"times{since} begin at {first * part:.10g} s, as of a clock that counts from another day: the first is subtracted"
    )
    digits = int(-np.ceil(np.log10(np.spacing(float(times.max())) * part)))  # (those that such large numbers hold)
    return [replace(track, time=np.round((track.time - first) * part, digits)) for track in tracks]


def _in_order(track: Track, notes: list[str], faults: FaultList) -> Track:
    """Return the rows that have a time; times that decrease are a fault."""
    label = _label(track)
    for name, values, most, unit in (
        ("time", track.time, MAX_TIME_S, "s"), ("position", track.position.ravel(), MAX_POSITION_M, "m")
    ):  # fmt: skip
        far = np.flatnonzero(np.abs(values) > most)
        if len(far):
            got = f"{values[far[0]]:g} {unit} ({len(far)} in all)"
            advice = "is the unit right?"
            if unit == "m":
                advice += " `scale` is the length of one unit of the file"
            faults.add(f"{label}: {name}", f"at most {most:g} {unit}", got, advice)
    known: NDArray[np.bool_] = np.isfinite(track.time)
    if (~known & np.isfinite(track.position).any(axis=1)).any():
        notes.append(f"{label}: {(~known).sum():,} rows without a time were omitted")
    track = track.select(known)
    step = np.diff(track.time)
    if (step < 0).any():
        i = int(np.flatnonzero(step < 0)[0])
        got = f"{track.time[i + 1]:g} s after {track.time[i]:g} s, at its row {i + 2} ({(step < 0).sum()} in all)"
        advice = "sort the rows, or give each ball and shot a name in columns 'ball', 'shot'"
        faults.add(f"{label}: time", "increasing times", got, advice)
    return track


def _one_row_per_time(track: Track, notes: list[str]) -> Track:
    """Return the track with increasing times: of rows with the same time the first."""
    again = np.diff(track.time, prepend=-np.inf) < MIN_INTERVAL_S
    if again.any():
        moved = np.append(False, np.abs(np.diff(track.position, axis=0)).max(axis=1) > 0) & again
        where = " at another position" if moved.any() else ""
        at = shortened_list([f"{t:.6g}" for t in np.unique(track.time[moved if moved.any() else again])])
        notes.append(
            f"{_label(track)}: {again.sum()} rows repeat the time of the row before{where}: the first is used; t = {at} s"
        )
        track = track.select(~again)
    return replace(track, position=np.ascontiguousarray(track.position))


def _label(track: Track) -> str:
    """Return group and name of a track, for messages."""
    return " ".join(filter(None, (track.group, track.name)))


def _speeds(track: Track) -> NDArray[np.float64]:
    """Return the speeds from frame to frame, m/s."""
    steps = np.diff(track.time[track.seen])
    ways = np.linalg.norm(np.diff(track.position[track.seen], axis=0), axis=1)
    return np.asarray(np.divide(ways, steps, out=np.zeros_like(ways), where=steps > 0))


def _require_likely_unit(tracks: list[Track], path: str) -> None:
    """Raise CaromError if a ball falls as if lengths taken as m were in cm or mm."""
    with contextlib.suppress(CaromError):  # (three coordinates of which none is the height have no fall)
        tracks = in_a_plane(tracks, [])
    unit, fall = likely_unit([track.select(track.seen) for track in tracks])
    if unit:
        raise CaromError(
            f"{path}: expected lengths in m, but then the ball falls with {fall:.3g} m/s^2, {fall / GRAVITY:.3g} times gravity:"
            f" they are probably in {unit}; give `scale` 1{unit} (or `scale` 1m if they are in m)"
        )


def _plausibility_notes(tracks: list[Track], notes: list[str]) -> None:
    """Add notes on signs of a wrong unit, several units in one file, or a ball that was lost and found elsewhere."""
    size = max(float(np.ptp(track.position[track.seen], axis=0).max()) for track in tracks)
    speed = max(
        (float(np.quantile(_speeds(track), USUAL_SHARE)) for track in tracks if track.seen.sum() > 2), default=0.0
    )
    if size == 0:
        notes.append("the ball does not move: all its positions are the same")
    elif not SMALLEST_FILM_M < size < LARGEST_FILM_M or speed > FASTEST_BALL:
        notes.append(
            f"the tracks span {size:.3g} m, and the ball moves at {speed:.3g} m/s: is the unit right? `scale` 1mm (or 1cm, 0.42mm"
            " per pixel) gives it"
        )
        spans = np.array([np.ptp(track.position[track.seen], axis=0) for track in tracks]).max(axis=0)
        if spans.max() > 100 * spans.min() > 0 and not _equally_noisy(tracks):
            notes.append(
                f"the axes span {' and '.join(f'{x:.3g}' for x in spans)} m: are both columns in the same unit?"
            )
    steps = np.concatenate([np.diff(track.time) for track in tracks])
    if len(steps) and not 1e-5 < float(np.median(steps)) < 0.5:
        notes.append(
            f"one frame every {np.median(steps):.3g} s: is the unit right? write it in the header, as in 't [ms]'"
            + ("; or are these frame numbers? then give the frame rate" if (steps == np.round(steps)).all() else "")
        )
    most = max(int(track.seen.sum()) for track in tracks)
    if most < MIN_POSITIONS:
        notes.append(f"{most} positions: too few for a contact, which needs 4 before it and 5 after it; film longer")
    for track in tracks:
        notes += _jumps(track)


def _equally_noisy(tracks: list[Track]) -> bool:
    """Return whether both coordinates have noise of the same size: then they have one unit, however different their spans."""
    noise = [
        max(position_noise(track.time[track.seen], track.position[track.seen][:, [axis]], np.nan) for track in tracks)
        for axis in (0, 1)
    ]
    return 0 < max(noise) < MAX_NOISE_RATIO * min(noise)


def _jumps(track: Track) -> list[str]:
    """Return a note if the ball jumps: some steps are far longer than its usual ones."""
    seen = track.select(track.seen)
    if len(seen) < MIN_POSITIONS:
        return []
    step = np.hypot(*np.diff(seen.position[:, :2], axis=0).T)
    usual = float(np.median(step))
    label = _label(track)
    if float(np.median(np.hypot(*(seen.position[2:, :2] - seen.position[:-2, :2]).T))) < 0.1 * usual:
        return [f"{label}: the positions alternate from row to row: are there rows in two units, or of two balls?"]
    far = np.flatnonzero(
        (step > JUMP_STEPS * usual) & (step > 0.05) & (np.diff(seen.time) < 3 * np.median(np.diff(seen.time)))
    )
    if not len(far) or usual == 0:
        return []
    at = seen.time[far[0] + 1]
    return [
        f"{label}: the ball jumps {times_in_words(len(far))}, by up to {step[far].max():.3g} m, first at t = {at:.6g} s; its usual"
        f" step is {usual:.2g} m: are there rows in another unit, or was another object tracked? correct or delete these rows"
    ]


def film_at_its_rate(path: Path, known: Calibration, gravity: float) -> Any:
    """Return the tracks of a film. Raises CaromError where its ball falls with another g, and no rate is given."""
    tracked = read_tracks(path, None, known)
    slow = [note for note in tracked.notes if note.startswith(SLOWED)]
    if gravity and (fall := flight_gravity(tracked.tracks, gravity)) != gravity:
        slow.append(slowed_note(fall, gravity))
    if known.rate is None and slow:
        raise CaromError(slow[0])
    return tracked
