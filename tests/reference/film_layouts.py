"""One film with a known truth in the layouts that programs and spreadsheets write: a ball that bounces with restitution 0.8.

Each layout is a function from the film to the text of a file; beside it stands what the reader has to be given.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

RESTITUTION, GRAVITY, RATE = 0.8, 9.80665, 120.0
PIXEL = 1 / 300  # m
HEIGHT = 720  # of the picture, in pixels


@dataclass(frozen=True)
class Film:
    """Times, s, and places, m, of a ball; the second axis points up."""

    time: np.ndarray
    place: np.ndarray
    gone: np.ndarray
    """Rows in which the ball is not found, where a layout can say so."""


def film(rows: int = 110, seed: int = 0, along: float = 1.0) -> Film:
    """A ball thrown along x that bounces once, seen 120 times per second, with noise of 0.3 mm."""
    rng = np.random.default_rng(seed)
    t = np.arange(rows) / RATE
    hit = 0.5262
    v = GRAVITY * hit - 0.3
    before = 0.3 * t - GRAVITY / 2 * t**2 + GRAVITY / 2 * hit**2 - 0.3 * hit
    since = t - hit
    after = RESTITUTION * v * since - GRAVITY / 2 * since**2
    x = -0.4 + along * (t - 0.1 * np.maximum(since, 0))
    place = np.stack([x, 0.02 + np.where(t < hit, before, after)], axis=-1) + rng.normal(0, 3e-4, (rows, 2))
    gone = rng.random(rows) < 0.12
    gone[[0, -1]] = False
    return Film(t, place, gone)


def pixels(one: Film) -> np.ndarray:
    """Places in pixels from the upper left corner of the picture."""
    return np.stack([one.place[:, 0] / PIXEL + 300, HEIGHT - 100 - one.place[:, 1] / PIXEL], axis=-1)


def table(header: str | Sequence[str], columns: Sequence[Sequence[object]], sep: str = ",", end: str = "\n") -> str:
    """Header lines, and rows of cells between ``sep``."""
    lines = [header] if isinstance(header, str) else list(header)
    return end.join([*lines, *(sep.join(map(str, row)) for row in zip(*columns, strict=True))]) + end


def cells(
    values: np.ndarray, form: str = ".6f", comma: bool = False, minus: str = "-", quote: bool = False
) -> list[str]:
    """Numbers as a language writes them."""
    texts = [f"{x:{form}}" for x in values]
    texts = [x.replace(".", ",") if comma else x for x in texts]
    texts = [x.replace("-", minus) for x in texts]
    return [f'"{x}"' for x in texts] if quote else texts


def plain(
    header: str | Sequence[str], sep: str = ",", end: str = "\n", unit: float = 1.0, **form: object
) -> Callable[[Film], str]:
    """Columns t, x, y."""
    return lambda one: table(
        header, [cells(a, **form) for a in (one.time, one.place[:, 0] / unit, one.place[:, 1] / unit)], sep, end  # type: ignore[arg-type]
    )  # fmt: skip


def framed(
    header: str | Sequence[str], order: str = "fxy", sep: str = ",", **more: Callable[[Film], Sequence[object]]
) -> Callable[[Film], str]:
    """Columns of frame numbers, pixels, and ``more``, in the order of their letters."""

    def write(one: Film) -> str:
        place = pixels(one)
        known = {"f": range(len(one.time)), "x": cells(place[:, 0], ".3f"), "y": cells(place[:, 1], ".3f")}
        return table(header, [known[k] if k in known else more[k](one) for k in order], sep)

    return write


def marked(header: str, mark: str) -> Callable[[Film], str]:
    """Frame, x, y in pixels, with a mark where the ball is not found; {v} in the header: a column of visibility."""

    def write(one: Film) -> str:
        x, y = (np.where(one.gone, mark, cells(column, ".2f")) for column in pixels(one).T)
        frame = range(len(x))
        seen = ["0" if gone else "1" for gone in one.gone]
        return table(header, [frame, seen, x, y] if "isib" in header else [frame, x, y])

    return write


def kinovea(code: Callable[[int], str], blocks: int = 1, labels: bool = False) -> Callable[[Film], str]:
    """The older text export: blocks of rows T X Y, decimals with points or commas."""

    def write(one: Film) -> str:
        place = pixels(one)
        text = "#Kinovea Trajectory data export\n#T X Y\n"
        for k in range(blocks):
            text += (f"\n# Ball {k}\n" if labels else "\n" if k else "") + "".join(
                f"{code(i)} {x + 40 * k:.2f} {y:.2f} \n" for i, (x, y) in enumerate(place)
            )
        return text

    return write


def same(text: str) -> Callable[[Film], list[str]]:
    """A column with the same text in all rows."""
    return lambda one: [text] * len(one.time)


def numbered(name: str) -> Callable[[Film], str]:
    """A column that numbers the rows, t, x, y."""
    header = f"{name},t [s],x [m],y [m]"
    return lambda one: table(header, [range(len(one.time)), *(cells(a) for a in (one.time, *one.place.T))])


def grouped(thousands: str, comma: bool) -> Callable[[Film], str]:
    """Millimetres with a separator of thousands, between semicolons."""

    def number(x: float) -> str:
        left, right = f"{1000 * x:,.2f}".split(".")
        return left.replace(",", thousands) + ("," if comma else ".") + right

    header = "t [s];x [mm];y [mm]"
    return lambda one: table(header, [cells(one.time, comma=comma), *(list(map(number, a)) for a in one.place.T)], ";")


def milliseconds(i: int) -> str:
    """h:mm:ss and thousandths of a second."""
    return f"0:00:{int(i / RATE):02d}:{round(1000 * (i / RATE % 1)):03d}"


def code(i: int, last: int = 100) -> str:
    """h:mm:ss and the number of a frame."""
    return f"0:00:{i // last:02d}:{i % last:02d}"


def beside(head: Sequence[str], shared: bool = True) -> Callable[[Film], str]:
    """Two balls side by side: t, x, y, x, y, or t, x, y, t, x, y."""

    def write(one: Film) -> str:
        x, y, t = one.place[:, 0], one.place[:, 1], cells(one.time)
        first, other = [cells(x), cells(y)], [cells(x + 0.5), cells(y)]
        return table(head, [t, *first, *([] if shared else [t]), *other], "\t")

    return write


@dataclass(frozen=True)
class Layout:
    """How a program writes the film, and what its reader has to be given."""

    write: Callable[[Film], str]
    scale: float | None = None
    rate: float | None = None
    down: bool | None = None
    tracks: int = 1
    missing: bool = False
    note: str = ""
    """Part of a note that says what was taken for granted."""
    encoding: str = "utf-8"


# Names of a column of frame numbers in programs and spreadsheets; any other name is as good where the numbers rise with jumps.
CLOCK_NAMES = (
    "frame", "Frame", "FRAME", "Frame #", "Frame No.", "Frame nr", "frameNumber", "frame_number", "Frames", "frame idx", "FrameID",
    "Image", "Image #", "image_id", "img_num", "Slice", "Slice n\u00b0", "Slice number", "Bild", "Bildnummer", "Bild-Nr.", "trame",
    "vue", "cuadro", "fotograma", "quadro", "kader", "ruta", "klatka", "n\u00b0", "No.", "Nr.", "#", "n", "N", "k", "i", "f", "fr",
    "num", "number", "index", "idx", "id", "step", "timestep", "time step", "tick", "sample", "point", "row", "trial", "picture",
    "Photo", "Time [frames]", "", "Unnamed: 0",
)  # fmt: skip


def clock_of_frames(name: str, order: str, frame: np.ndarray) -> Callable[[Film], str]:
    """Columns of a clock under a name, x, y in pixels, and others that are no clock, in the order of their letters: c, x, y, and
    the size, the mean, the number of the track."""

    def write(one: Film) -> str:
        place = pixels(one)[frame]
        rng = np.random.default_rng(len(frame))
        known = {
            "c": (name, (frame + 5).tolist()), "x": ("x", cells(place[:, 0], ".3f")), "y": ("y", cells(place[:, 1], ".3f")),
            "s": ("Area", rng.integers(90, 140, len(frame)).tolist()), "m": ("Mean", cells(rng.random(len(frame)), ".3f")),
            "t": ("Track n\u00b0", [1] * len(frame)),
        }  # fmt: skip
        return table(",".join(known[k][0] for k in order), [known[k][1] for k in order])

    return write


PX = {"scale": PIXEL, "rate": RATE, "down": True}
LOGGER_PRO = ["Vernier Format 2", "ball.cmbl 6/11/2024 14:32:02", "Latest", "Time\tX\tY", "t\tX\tY"]
MINUS, ARABIC = "\u2212", "\u061c-"
EASTERN = str.maketrans("0123456789.", "\u0660\u0661\u0662\u0663\u0664\u0665\u0666\u0667\u0668\u0669\u066b")
LAYOUTS: dict[str, Layout] = {
    # Tracker
    "tracker": Layout(plain(["mass A\t\t", "t\tx\ty"], "\t", form=".6E")),
    "tracker, U+2212, decimal commas": Layout(plain(["mass A\t\t", "t\tx\ty"], "\t", form=".6E", comma=True, minus=MINUS)),
    "tracker, semicolons": Layout(plain(["mass A;;", "t;x;y"], ";", comma=True)),
    "tracker, Arabic": Layout(lambda one: plain(["mass A\t\t", "t\tx\ty"], "\t", minus=ARABIC)(one).translate(EASTERN)),
    "tracker, Swedish exponents": Layout(
        lambda one: plain(["mass A\t\t", "t\tx\ty"], "\t", form=".6E", comma=True, minus=MINUS)(one).replace("E", "\u00d710^")
    ),
    "tracker, two tracks without the mark": Layout(beside(["\tmass A\t\tmass B\t", "t\tx\ty\tx\ty"]), tracks=2),
    "tracker, two tracks with the mark": Layout(beside(["#multi:", "\tmass A\t\tmass B\t", "t\tx\ty\tx\ty"]), tracks=2),
    # Kinovea
    "kinovea, hundredths": Layout(kinovea(code), scale=PIXEL, rate=RATE, down=True, note="taken as hundredths of a second"),
    "kinovea, frames": Layout(kinovea(lambda i: code(i, 30)), scale=PIXEL, rate=RATE, down=True, note="taken as frames, 30 per"),
    "kinovea, thousandths": Layout(
        kinovea(milliseconds), scale=PIXEL, down=True, note="thousandths"
    ),
    "kinovea, seconds, two blocks": Layout(kinovea(lambda i: f"{i / RATE:.4f}", 2), scale=PIXEL, down=True, tracks=2),
    "kinovea, decimal commas, labels": Layout(
        lambda one: kinovea(lambda i: f"{i / RATE:.4f}", 2, labels=True)(one).replace(".", ","), scale=PIXEL, down=True, tracks=2
    ),
    "kinovea, times in ms": Layout(
        lambda one: table(
            '"Time (ms)","Ball/0/X","Ball/0/Y"', [cells(x) for x in (1e3 * one.time, *one.place.T / 0.01)]
        ),
        scale=0.01,
    ),
    "kinovea 2023": Layout(plain('"Time","Ball/0/X","Ball/0/Y"', unit=0.01, quote=True), scale=0.01),
    # Vernier: Graphical Analysis and Video Analysis, Logger Pro
    "vernier, Latest": Layout(plain("Latest: Time (s),Latest: X (m),Latest: Y (m)")),
    "vernier, runs": Layout(
        beside(["Run 1: Time (s)\tRun 1: X (m)\tRun 1: Y (m)\tRun 2: Time (s)\tRun 2: X (m)\tRun 2: Y (m)"], shared=False), tracks=2
    ),
    "vernier, data set": Layout(plain('"Data Set 1:Time(s)","Data Set 1:X(m)","Data Set 1:Y(m)"')),
    "vernier, two points": Layout(beside(["Time (s)\tX (m)\tY (m)\tX 2 (m)\tY 2 (m)"]), tracks=2),
    "logger pro, text": Layout(plain([*LOGGER_PRO, "s\tm\tm", ""], "\t"), note="above the header"),
    # neural networks
    "deeplabcut": Layout(
        framed(["scorer,net,net,net", "bodyparts,ball,ball,ball", "coords,x,y,likelihood"], "fxyp", p=same("0.9")), **PX
    ),
    "sleap": Layout(
        framed("track,frame_idx,instance.score,ball.x,ball.y,ball.score", "afsxys", a=same("track_0"),
               s=same("0.9")), **PX),
    "tracknet": Layout(marked("Frame,Visibility,X,Y", "0"), **PX, missing=True, note="taken as missing"),
    "visibility with places": Layout(
        marked("frame,visible,x,y", "17"), **PX, missing=True, note="not visible in"
    ),
    "minus one": Layout(marked("frame,x [px],y [px]", "-1"), **PX, missing=True, note="-1, -1 in"),
    "zero": Layout(marked("frame,x,y", "0"), **PX, missing=True, note="0, 0 in"),
    "empty": Layout(marked("frame,x [px],y [px]", ""), **PX, missing=True),
    "nan": Layout(marked("frame,x [px],y [px]", "NaN"), **PX, missing=True),
    "dashes": Layout(marked("frame,x [px],y [px]", "\u2014"), **PX, missing=True),
    # trackers of particles and animals
    "trackpy": Layout(
        framed(",y,x,mass,frame,particle", "fyxmfp", m=same("190.5"), p=same("0")), **PX
    ),
    "trackmate": Layout(
        framed("LABEL,ID,TRACK_ID,POSITION_X,POSITION_Y,FRAME", "lfkxyf", l=lambda one: [f"ID{i}" for i in range(len(one.time))],
               k=same("0")), **PX),
    "mtrack2": Layout(framed(["Tracks 1 to 1", "Frame\tX1\tY1\tFlag1"], "fxys", "\t", s=same(" ")), **PX),
    "mtrack2, names once": Layout(
        lambda one: framed(["Frame\tX1\tY1\tFlag1", "Tracks 1 to 1"], "fxys", "\t", s=same(" "))(one)
        + "\nTrack \tLength\tDistance traveled\tNr of Frames\n1\t1234.5\t400.2\t110\n", **PX),
    "mtrack2, two blocks": Layout(
        lambda one: framed(["Frame\tX1\tY1\tFlag1", "Tracks 1 to 1"], "fxys", "\t", s=same(" "))(one)
        + framed(["Tracks 2 to 2"], "fzys", "\t", s=same("*"), z=lambda one: cells(pixels(one)[:, 0] + 40, ".3f"))(one),
        **PX, tracks=2),
    "idtracker": Layout(framed("X1\tY1\tProbId1", "xyp", "\t", p=same("1")), **PX),
    "napari": Layout(
        framed("track_id,t,y,x,id,parent_id", "kfyxfq", k=same("1"),
               q=lambda one: range(-1, len(one.time) - 1)), **PX, note="numbers the rows"),
    # MATLAB, NumPy, spreadsheets, editors
    "matlab": Layout(plain("t,x,y", form=".15g")),
    "numpy": Layout(plain("# t x y", " ", form=".18e")),
    "percent": Layout(plain(["% written by hand", "% t, x, y"], ", ")),
    "rows are frames": Layout(lambda one: table("x,y", [cells(a) for a in one.place.T]), rate=RATE),
    "id": Layout(numbered("id"), note="numbers the rows"),
    "trial": Layout(numbered("trial"), note="numbers the rows"),
    "spreadsheet, German": Layout(plain("Zeit [s];x [cm];y [cm]", ";", "\r\n", unit=0.01, comma=True), encoding="utf-8-sig"),
    "spreadsheet, French": Layout(plain("temps (s);x (mm);y (mm)", ";", "\r\n", unit=0.001, comma=True), encoding="cp1252"),
    "spreadsheet, thousands": Layout(grouped("\u202f", comma=True)),
    "spreadsheet, thousands, German": Layout(grouped(".", comma=True)),
    "spreadsheet, Swiss": Layout(grouped("'", comma=False)),
    "spreadsheet, named delimiter": Layout(plain(["sep=;", "t;x;y"], ";", comma=True)),
    "spreadsheet, quoted": Layout(plain('"t","x","y"', comma=True, quote=True)),
    "spreadsheet, UTF-16": Layout(plain("t\tx\ty", "\t", "\r\n"), encoding="utf-16"),
    "units row": Layout(plain(["t,x,y", "s,m,m"])),
    "units row, cm": Layout(plain(["time;x;y", "(s);(cm);(cm)"], ";", unit=0.01, comma=True)),
    "blanks around commas": Layout(plain("t , x , y", " , ")),
    "blanks around quotes": Layout(plain('"t" , "x" , "y"', " , ", quote=True)),
    "en dash": Layout(plain("t;x;y", ";", minus="\u2013")),
    "bars": Layout(plain("t|x|y", "|")),
    "spaces and commas": Layout(plain("t x y", "  ", comma=True, minus=MINUS)),
    "lines above": Layout(plain(["Ball 1, Tuesday", "filmed by hand", "t [s],x [m],y [m]"]), note="above the header"),
    "two balls, numbered": Layout(beside(["t\tx1\ty1\tx2\ty2"]), tracks=2),
    "two balls, named": Layout(beside(["t\tred x\tred y\twhite x\twhite y"]), tracks=2),
    "two balls, repeated": Layout(beside(["t\tx\ty\tx\ty"]), tracks=2),
    "two balls, with their times": Layout(beside(["t\tx\ty\tt\tx\ty"], shared=False), tracks=2),
    "ball and unit": Layout(plain("time_s,ball_x_m,ball_y_m")),
    "metres beside pixels": Layout(
        lambda one: table("time_s,ball_u_px,ball_x_px,ball_y_px,ball_x_m,ball_y_m",
                          [cells(a) for a in (one.time, *pixels(one).T[[0, 0, 1]], *one.place.T)]), note="not used: column"),
    "pixels beside metres": Layout(
        lambda one: table("frame,x_px,y_px,x_m,y_m", [range(len(one.time)), *(cells(a) for a in (*pixels(one).T, *one.place.T))]),
        **PX),
    "steps of time": Layout(lambda one: table("dt,x,y", [cells(np.diff(one.time, prepend=0)), *(cells(a) for a in one.place.T)])),
    "across and up": Layout(plain("t;x;z", ";")),
    "names of pictures": Layout(
        framed("image,x,y", "pxy", p=lambda one: [f"IMG_{i + 31:04d}.jpg" for i in range(len(one.time))]), **PX),
    "clock": Layout(lambda one: table("time,x,y", [[f"00:00:{t:09.6f}" for t in one.time], *(cells(a) for a in one.place.T)])),
}  # fmt: skip


# --- drawn layouts ------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Drawn:
    """A film as a file, what its reader has to be given, and its truth: the frame of each row, and the places."""

    text: str
    scale: float | None
    rate: float | None
    down: bool | None
    frame: np.ndarray
    place: np.ndarray
    coarse: float
    """Rounding of the times, in frames."""
    about: str


WORDS = (
    "tick",
    "cadre",
    "bilde",
    "mom",
    "obr",
    "kare",
    "fr_count",
    "Marke",
    "Aufnahme",
    "shots",
    "Zeitschritt",
    "pos_nr",
    "T_i",
    "frm",
    "seq",
)
DRAWN = (
    "names of the clock", "significant digits", "gaps and a rate", "another day", "three coordinates", "a height", "units in names",
)  # fmt: skip


def _kept(rng: np.random.Generator, rows: int) -> np.ndarray:
    """The frames that have a row: all, all but every n-th, or all but some at random; both ends stay."""
    number = np.arange(rows)
    kind = rng.integers(3)
    every = int(rng.integers(3, 11))
    keep = [number >= 0, number % every != every - 1, rng.random(rows) > rng.choice([0.03, 0.1, 0.25])][kind]
    keep[[0, -1]] = True
    return np.flatnonzero(keep)


def drawn(kind: str, seed: int) -> Drawn:
    """Draw a film in a layout of a kind: names, orders and numbers of columns, rows that are missing, rounding, the first time."""
    rng = np.random.default_rng([DRAWN.index(kind), seed])
    one = film(seed=seed, along=float(rng.uniform(0.3, 1.5)))
    kept = _kept(rng, len(one.time))
    time, place = one.time[kept], one.place[kept]
    start, coarse, rate, about = 0.0, 0.0, None, ""
    x, y = cells(place[:, 0]), cells(place[:, 1])
    others = {
        "Area": rng.integers(90, 140, len(kept)).tolist(),
        "Mean": cells(rng.random(len(kept)), ".3f"),
        "Track n\u00b0": [1] * len(kept),
    }
    more = dict(list(others.items())[: rng.integers(4)])
    if kind == "names of the clock":
        names = [*CLOCK_NAMES, *WORDS, "".join(rng.choice(list("bcdghkmpqruvw"), int(rng.integers(2, 9))))]
        name = names[seed % len(names)]
        columns = {name: (kept + int(rng.integers(500))).tolist(), "x [m]": x, "y [m]": y, **more}
        rate, about = RATE, f"frames in a column {name!r}"
    elif kind == "significant digits":
        start, digits = float(rng.choice([0, 0, 0.3, 0.9, 2.5, 9.6])), int(rng.integers(3, 7))
        about = f"{digits} digits from {start:g} s on"
        columns = {"t": [f"{t:.{digits - 1}E}" for t in start + time], "x": x, "y": y}
        coarse = 10.0 ** (np.floor(np.log10(start + time[-1])) + 1 - digits) * RATE
        rate = [None, RATE][int(rng.integers(2))]
        if coarse > 0.5:  # (which rows are missing is lost: the rate has to be given, and no row be missing)
            return drawn(kind, seed + 100_000)
    elif kind == "gaps and a rate":
        playback = float(rng.choice([24, 25, 30, 29.97, 50, 60, 100, 100, 100]))
        decimals = int(rng.integers(2, 7))
        coarse = 10.0**-decimals * playback
        if coarse > 0.5 and playback != 100:
            return drawn(kind, seed + 100_000)
        about = f"played back at {playback:g}, {decimals} decimals"
        columns = {"t [s]": [f"{k / playback:.{decimals}f}" for k in kept], "x [m]": x, "y [m]": y, **more}
        rate = RATE
    elif kind == "another day":
        start, form = 1617472415.25, int(rng.integers(5))
        about = ["s", "ms", "us", "ns", "date"][form]
        written: list[Callable[[float], str]] = [
            lambda t: f"{start + t:.6f}", lambda t: f"{1e3 * (start + t):.3f}", lambda t: f"{round(1e6 * start) + round(1e6 * t)}",
            lambda t: f"{round(1e9 * start) + round(1e9 * t)}", lambda t: f"2021-04-03T17:53:{35.25 + t:09.6f}",
        ]  # fmt: skip
        columns = {"timestamp": [written[form](t) for t in time], "x": x, "y": y, **more}
    elif kind == "three coordinates":
        turn = float(rng.uniform(0, 2 * np.pi))
        aside = rng.normal(0, 3e-4, len(kept))
        flat = [place[:, 0] * np.cos(turn) - aside * np.sin(turn), place[:, 0] * np.sin(turn) + aside * np.cos(turn)]
        axes = rng.permutation(3).tolist()  # the names of the two along the floor, and of the height
        named = dict(zip(["xyz"[k] for k in axes], [*flat, place[:, 1]], strict=True))
        about = f"{'xyz'[axes[2]]} up"
        columns = {"t": cells(time), **{name: cells(named[name]) for name in "xyz"}}
    elif kind == "a height":
        head = [
            ("t", "y"), ("Time (s)", "Position (m)"), ("Latest: Time (s)", "Latest: Position (m)"), ("zeit [s]", "h\u00f6he [m]"),
            ("time_s", "ball_y_m"), ("t", "z"), ("t [s]", "x [m]"),
        ][int(rng.integers(7))]  # fmt: skip
        about = head[1]
        columns = {head[0]: cells(time), head[1]: y, **more}
    else:
        ball = str(rng.choice(["ball", "red", "Ball 1", "cue ball", "white"]))
        sign, unit = rng.choice([" ", "_"]), float(rng.choice([1, 0.01, 0.001]))
        text = {1.0: "m", 0.01: "cm", 0.001: "mm"}[unit]
        head = [
            f"{ball}{sign}{axis}{ending}"
            for ending in [str(rng.choice([f"_{text}", f" ({text})", f" [{text}]"]))]
            for axis in "xy"
        ]
        about = head[0]
        px = {
            f"{ball}{sign}{name}_px": cells(a)
            for name, a in zip(rng.permutation(["u", "v"]), pixels(one)[kept].T, strict=True)
        }
        columns = {
            "time_s": cells(time),
            head[0]: cells(place[:, 0] / unit),
            head[1]: cells(place[:, 1] / unit),
            **px,
            **more,
        }
    order = rng.permutation(list(columns)).tolist()
    text = table(",".join(order), [columns[name] for name in order])
    return Drawn(text, None, rate, None, kept, place, float(coarse), about)
