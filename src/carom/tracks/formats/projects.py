"""Files that are no tables: projects of tracking programs, pictures, spreadsheets; and the menu that exports positions as text."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

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
FILM = "track the ball first, with Tracker or Kinovea, and export its positions"
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
    (b"\x89PNG", "a picture (PNG)", FILM), (b"\xff\xd8\xff", "a picture (JPEG)", FILM), (b"GIF8", "a picture (GIF)", FILM),
    (b"MATLAB", "a MATLAB file", MATLAB), (b"\x93NUMPY", "a NumPy array", "write it with numpy.savetxt, delimiter and header"),
    (b"PAR1", "a Parquet file", PANDAS), (b"ARROW1", "a Feather file", PANDAS), (b"\x80\x04", "a pickle of Python", PANDAS),
    (b"\x80\x05", "a pickle of Python", PANDAS), (b"\x80\x03", "a pickle of Python", PANDAS),
    (b"\xd0\xcf\x11\xe0", "an old spreadsheet (xls)", "save the sheet as CSV"),
    (b"PK\x03\x04", *ARCHIVE), (b"\x1aE\xdf\xa3", "a film", FILM), (b"RIFF", "a film (AVI)", FILM), (b"%PDF", "a PDF", TABLE),
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
    **dict.fromkeys((".mp4", ".mov", ".avi", ".mkv"), ("a film", FILM)),
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
        return "a film (MP4)", FILM
    return next(((what, advice) for sign, what, advice in BEGINNINGS if start.startswith(sign)), None)
