"""From pixels to metres, from frames to the times of rows: flights, gravity, the camera's readout, lengths in the picture."""

from __future__ import annotations

import contextlib
import re
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.units import parse_quantity
from carom.errors import CaromError, Fault, FaultList
from carom.formatting import counted
from carom.tracks.video.reading import Array, Mask

NUMBER = r"-?\d+(?:\.\d*)?"
LEAST_FLIGHT = 6  # frames
SHARP_TURN, TURN_SHARE = 8.0, 0.12  # times the usual change of velocity in a frame, and of the largest speed: a contact
MOST_MISFIT = 1.5  # px, rms of places about flights
UPRIGHT = 0.35  # rad between gravity and the picture's vertical
USUAL_READOUT = 0.02  # s, of cameras that read row after row
AT_ONCE = 0.5  # share of cameras that read all rows at once
LIKELY = 0.05  # probability of another camera, below which none is taken into account
DRAG = 0.05  # 1/m: standard deviation of the prior of the air's drag
RADIUS = 0.02  # of the scale by the ball's radius, which light and shadow change
FIELD, FIELD_DOUBT = 0.8, 0.3  # focal length of a usual camera, in sides of its picture; and by which factor it differs
MOST_CORNERS = 8.0  # px, of the corners of a table
HELD = 1.1  # exposures from a contact: what a frame shows of the ball, or of its velocity, is that of both sides
DIFFERENT = 0.03  # of two scales, which is said


class Falls(NamedTuple):
    """Flights of balls fitted with one acceleration."""

    gravity: Array
    """(2,) px/s^2."""
    error: float
    """Of its size, px/s^2."""
    rms: float
    """px."""
    readout: float
    """s, from the first to the last row of the camera; and its error."""
    readout_error: float
    rises: bool
    """Whether balls both rise and fall."""


def row_phase(places: Array, size: tuple[int, int], rotation: int) -> Array:
    """Return which part (n,) of the readout has passed, -1/2 to 1/2, at places (n, 2) of the upright picture (width, height)."""
    across = places[:, 0] / size[0] if rotation % 2 else places[:, 1] / size[1]
    return np.asarray(0.5 - across if rotation in (2, 3) else across - 0.5)


def rows_direction(rotation: int) -> tuple[float, float]:
    """Return the direction in the upright picture in which rows are read."""
    sign = -1.0 if rotation in (2, 3) else 1.0
    return (sign, 0.0) if rotation % 2 else (0.0, sign)


def choose_readout(found: Sequence[tuple[float, float]], notes: list[str]) -> tuple[float, float]:
    """Return the readout of a camera and its error, s, from estimates with errors; 0 of a camera that reads all rows at once."""
    known = [(value, error) for value, error in found if error > 0]
    if not known:
        return 0.0, 0.0
    # (what cameras have is known beforehand, so that what the film does not show is not taken from it: the mean of two kinds)
    weights = np.array([1 / error**2 for _value, error in known])
    seen, doubt = float(np.average([one for one, _error in known], weights=weights)), float(weights.sum() ** -0.5)
    error = (USUAL_READOUT**-2 + doubt**-2) ** -0.5
    value = seen * (error / doubt) ** 2
    against = AT_ONCE / (1 - AT_ONCE) * np.exp(-0.5 * (value / error) ** 2) * USUAL_READOUT / error
    likely = float(1 / (1 + against))
    if likely < LIKELY or value <= -2 * error:
        return 0.0, 0.0
    value = max(value, 0.0)
    value, error = likely * value, float(np.sqrt(likely * error**2 + likely * (1 - likely) * value**2))
    said = f"the readout from first to last row is {1e3 * value:.3g} ± {1e3 * error:.1g} ms by outlines and flights"
    if value < 2 * error:
        said = f"the film does not determine the readout, first to last row (below {1e3 * (value + 2 * error):.2g} ms)"
    notes.append(f"rolling shutter: {said}; its error is part of all error bars (`readout` gives another, 0 for none)")
    return value, error


def turning(times: Array, places: Array) -> Mask:
    """Return the frames (F,) beside which a ball turns sharply: places (F, 2) are NaN where it was not seen."""
    rows = np.flatnonzero(np.isfinite(places[:, 0]))
    found = np.zeros(len(times), bool)
    if len(rows) < 5:
        return found
    slope = np.diff(places[rows], axis=0) / np.diff(times[rows])[:, None]
    change = np.hypot(*np.diff(slope, axis=0).T)
    away = np.abs(change - np.median(change))
    limit = max(SHARP_TURN * float(np.median(away)), TURN_SHARE * float(np.hypot(*slope.T).max()))
    found[rows[1:-1][away > limit]] = True
    return found


def flights_of(times: Array, places: Array, used: Mask) -> list[NDArray[np.intp]]:
    """Return the frames (n,) of each flight: those between which a ball, at places (F, 2) where it is ``used``, turns sharply."""
    turns, rows = turning(times, np.where(used[:, None], places, np.nan)), np.flatnonzero(used)
    cut = np.flatnonzero(turns[rows] | (np.diff(rows, prepend=rows[:1]) > 3))
    parts = [part[~turns[part]] for part in np.split(rows, cut)]
    return [part for part in parts if len(part) >= LEAST_FLIGHT]


def fit_falls(
    balls: Sequence[tuple[Array, Array, Mask]], size: tuple[int, int], rotation: int, free: bool
) -> Falls | None:
    """Fit all flights of balls with one acceleration, and with ``free`` a readout of the camera and the air's drag.

    ``balls``: times (F,), s, places (F, 2), px, and which (F,) are used; ``size``: width and height of the picture.
    Returns None without flights.
    """
    flights = [(t[rows], x[rows]) for t, x, used in balls for rows in flights_of(t, x, used)]
    if not flights:
        return None
    columns, values = [], []
    for number, (t, x) in enumerate(flights):
        s = t - t.mean()
        v = np.gradient(x, s, axis=0)
        phase = row_phase(x, size, rotation)
        push = -np.hypot(*v.T)[:, None] * v
        step = np.diff(s)[:, None]
        speed = np.concatenate([np.zeros((1, 2)), np.cumsum((push[1:] + push[:-1]) / 2 * step, axis=0)])
        way = np.concatenate([np.zeros((1, 2)), np.cumsum((speed[1:] + speed[:-1]) / 2 * step, axis=0)])
        for axis in (0, 1):
            block = np.zeros((len(t), 4 + 4 * len(flights)))
            block[:, axis] = s * s / 2
            block[:, 2], block[:, 3] = v[:, axis] * phase, way[:, axis]
            block[:, 4 + 4 * number + 2 * axis], block[:, 5 + 4 * number + 2 * axis] = 1.0, s
            columns.append(block)
            values.append(x[:, axis])
    matrix, target = np.concatenate(columns), np.concatenate(values)
    # (a shift of all rows by -phase s: x(t + readout phase))
    prior = np.zeros(matrix.shape[1])
    usual = np.linalg.lstsq(np.delete(matrix, (2, 3), axis=1), target, rcond=None)[0]
    fall = float(np.hypot(usual[0], usual[1]))
    prior[3] = (1 / (DRAG * 9.81 / max(fall, 1e-9))) ** 2 if free else 1e30
    prior[2] = 1e-12 if free else 1e30
    noise = 1.0
    for _ in range(2):
        normal = matrix.T @ matrix / noise**2 + np.diag(prior + 1e-12)
        solved = np.linalg.solve(normal, matrix.T @ target / noise**2)
        left = target - matrix @ solved
        noise = float(np.sqrt((left**2).sum() / max(len(left) - len(solved), 1))) + 1e-6
    spread = np.linalg.inv(normal)
    rises = any((np.diff(x @ usual[:2]) < 0).any() for _t, x in flights)
    # (errors of neighbouring frames are alike: twice the formal error)
    error, of_readout = (2 * float(np.sqrt(one)) for one in (max(spread[0, 0], spread[1, 1]), spread[2, 2]))
    return Falls(np.asarray(solved[:2], dtype=np.float64), error, noise, float(solved[2]), of_readout, rises)


def parse_length(text: str) -> tuple[Array, float]:
    """Return two points (2, 2), px, and their distance, m, of a text such as ``"100,620,900,618=1m"``.

    Raises CaromError for another text.

    Examples
    --------
    >>> points, length = parse_length("100,600,900,600=80cm")
    >>> points.tolist(), length
    ([[100.0, 600.0], [900.0, 600.0]], 0.8)
    """
    ends, _equals, long = text.partition("=")
    points, metres = np.array(_numbers(4, ends)).reshape(-1, 2), _metres(long)
    if not (len(points) and 0 < metres < 1e4 and np.hypot(*(points[1] - points[0])) > 0):
        raise CaromError(Fault("`length`", "", "two points in px and their distance, x1,y1,x2,y2=1m", repr(text)))
    return points, metres


def _metres(text: str) -> float:
    """Return a length, m, with its unit or without; NaN of another text."""
    for read in (float, lambda text: float(parse_quantity(text, "m"))):
        with contextlib.suppress(ValueError):
            return read(text)
    return np.nan


class Corners(NamedTuple):
    """Corners of a table in the picture."""

    points: Array
    """(4, 2) px."""
    sides: tuple[float, float]
    """From the first to the second corner, and from there to the third, m."""
    height: float
    """Above the cloth, m."""


def parse_corners(text: str) -> Corners:
    """Return the corners of a table of a text such as ``"100,90,900,90,900,490,100,490=2.84mx1.42m@37mm"``.

    Raises CaromError for another text.

    Examples
    --------
    >>> parse_corners("100,90,900,90,900,490,100,490=2.84x1.42@37mm")[1:]
    ((2.84, 1.42), 0.037)
    """
    wanted = "four corners in px, sides and height, x1,y1,x2,y2,x3,y3,x4,y4=2.84mx1.42m@37mm"
    at, _equals, sizes = text.partition("=")
    points, found = np.array(_numbers(8, at)).reshape(-1, 2), re.fullmatch(r"(.+)x(.+)@(.+)", sizes)
    long, wide, height = (_metres(one) for one in found.groups()) if found else (np.nan,) * 3
    side = np.roll(points, -1, axis=0) - points
    turns = side[:, 0] * np.roll(side, -1, axis=0)[:, 1] - side[:, 1] * np.roll(side, -1, axis=0)[:, 0]
    if not (0 < long < 1e3 and 0 < wide < 1e3 and abs(height) < 1 and abs(np.sign(turns).sum()) == 4):
        raise CaromError(Fault("`corners`", "", f"{wanted}, around the table", repr(text)))
    return Corners(points, (long, wide), height)


class TableView(NamedTuple):
    """A camera above a table, from the table's corners: calling it gives places on the table of places in the picture."""

    corners: Corners
    middle: Array
    """(2,) px."""
    focal: float
    """px."""
    turn: Array
    """(3, 3): from the table, x along the first side, y to its left as seen from above, z up from the corners, to the camera."""
    shift: Array
    """(3,) m."""
    ball: float
    """Height of the balls' middles above the corners, m."""

    @classmethod
    def seen(cls, corners: Corners, size: tuple[int, int], radius: float) -> TableView:
        """Return the camera whose picture, width and height ``size``, has the corners there: a pinhole, its axis in the middle.

        How wide it sees is little known from four corners: a usual camera's is the prior.
        """
        from scipy.optimize import least_squares
        from scipy.spatial.transform import Rotation

        middle, usual = (np.array(size) - 1) / 2, FIELD * max(size)
        x, y = corners.sides
        at = np.array([[0, 0, 0], [x, 0, 0], [x, y, 0], [0, y, 0]], dtype=float)
        area = np.roll(corners.points, -1, axis=0)
        left = float((corners.points[:, 0] * area[:, 1] - corners.points[:, 1] * area[:, 0]).sum()) > 0
        if left:  # (clockwise as shown: the first side is the far one)
            at[:, 1] = y - at[:, 1]

        def projected(p: Array) -> Array:
            seen = at @ Rotation.from_rotvec(p[:3]).as_matrix().T + p[3:6]
            return np.asarray(middle + usual * np.exp(p[6]) * seen[:, :2] / np.maximum(seen[:, 2:], 1e-6))

        def off(p: Array) -> Array:
            return np.append((projected(p) - corners.points).ravel(), p[6] / FIELD_DOUBT)

        step = corners.points[1] - corners.points[0]
        far = usual * x / float(np.hypot(*step))
        side = step / np.hypot(*step)
        # (from straight above: the table's y is up in the picture, its z toward the camera)
        down = np.array([[side[0], side[1], 0], [side[1], -side[0], 0], [0, 0, -1.0]])
        centre = np.append((corners.points.mean(axis=0) - middle) / usual * far, far)
        start = np.concatenate([Rotation.from_matrix(down).as_rotvec(), centre - down @ at.mean(axis=0), [0.0]])
        found = least_squares(off, start, x_scale=[1, 1, 1, far, far, far, 1])
        p, worst = found.x, float(np.hypot(*(projected(found.x) - corners.points).T).max())
        if worst > MOST_CORNERS or abs(p[6]) > 3 * FIELD_DOUBT:
            got = f"at best {worst:.2g} px off, with a focal length of {np.exp(p[6]) * FIELD:.2g} widths of the picture"
            wanted = "corners of a rectangle, as a camera sees it"
            raise CaromError(Fault("`corners`", "", wanted, got, "is the first side right?"))
        turn = Rotation.from_rotvec(p[:3]).as_matrix()
        return cls(corners, middle, float(usual * np.exp(p[6])), turn, p[3:6], radius - corners.height)

    def __call__(self, places: Array) -> Array:
        """Return places (n, 2), m, of balls' middles that are seen at places (n, 2), px: from the lower left corner."""
        rays = np.column_stack([(places - self.middle) / self.focal, np.ones(len(places))]) @ self.turn
        eye = -self.shift @ self.turn
        return np.asarray(eye[:2] + rays[:, :2] * ((self.ball - eye[2]) / rays[:, 2])[:, None])

    @property
    def scale(self) -> float:
        """m per px, in the middle of the table."""
        middle = self.corners.points.mean(axis=0)
        x, y = np.diff(self(middle + np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 0.0], [0.0, 1.0]])), axis=0)[::2]
        return float(np.sqrt(abs(x[0] * y[1] - x[1] * y[0])))


class Asked(NamedTuple):
    """Arguments of track_film that were read."""

    seeds: list[tuple[float, ...]]
    """x, y, t of each ball."""
    colour: Array | None
    region: tuple[float, ...] | None
    corners: Corners | None = None


def check_arguments(
    balls: int, radius: float | None, scale: float | str | None, length: str | None, readout: float | None, rate: float | None,
    ball: Sequence[str] | str, colour: str | None, region: str | None, corners: str | None, start: float | None,
    end: float | None,
) -> Asked:  # fmt: skip
    """Read the arguments of track_film. Raises CaromError with all that are wrong."""
    faults = FaultList()
    if not 1 <= balls <= 30:
        faults.add("`balls`", "1 to 30 balls", repr(balls))
    limits = {"radius": (radius, 0.0), "readout": (readout, -1e-9), "rate": (rate, 0.0), "end": (end, start or 0.0)}
    for name, (value, low) in limits.items():
        if value is not None and not low < value < 1e6:
            faults.add(f"`{name}`", f"a number {'of at least 0' if low < 0 else f'above {low:g}'}", repr(value))
    if scale is not None and scale != "gravity" and not (isinstance(scale, float | int) and 0 < scale < 1e3):
        faults.add("`scale`", "metres per pixel, above 0, or gravity", repr(scale))
    if length is not None:
        faults.attempt(parse_length, length)
    seeds = [_numbers(3, one, "@", "s?") for one in ([ball] if isinstance(ball, str) else ball)]
    if () in seeds:
        faults.add("`ball`", "a place and a time, x,y@t (px, s)", repr(ball))
    elif seeds and len(seeds) != balls:
        faults.add("`ball`", f"one for each of {counted(balls, 'ball')}", str(len(seeds)))
    tone = re.fullmatch(r"#[0-9a-fA-F]{6}", colour or "")
    if colour is not None and tone is None:
        faults.add("`colour`", "red, green, blue as in '#e0b020'", repr(colour))
    part = _numbers(4, region or "")
    if region is not None and not (part and part[2] > part[0] and part[3] > part[1]):
        faults.add("`region`", "x0,y0,x1,y1 in px, x0 < x1 and y0 < y1", repr(region))
    table = None if corners is None else faults.attempt(parse_corners, corners)
    if corners is not None and not radius:
        faults.add("`radius`", "the radius of the balls, with `corners`", "none")
    faults.raise_if_any()
    return Asked(
        seeds, None if tone is None else np.array(list(bytes.fromhex(tone[0][1:])), float), part or None, table
    )


def _numbers(count: int, text: str, last: str = ",", end: str = "") -> tuple[float, ...]:
    """Return the numbers of a text, with commas between and another sign before the last one; none of another text."""
    pattern = ",".join([f"({NUMBER})"] * (count - 1)) + f"{last}({NUMBER}){end}"
    found = re.fullmatch(pattern, re.sub(r"\s", "", text))
    return tuple(float(one) for one in found.groups()) if found else ()


def choose_scale(
    radius_px: float, falls: Falls | None, *, scale: float | str | None, length: str | None, radius: float | None, gravity: float,
    table: TableView | None, notes: list[str],
) -> float:  # fmt: skip
    """Return the length of a pixel, m: as given, of a length in the picture, gravity, or the ball's radius; notes compare them.

    Raises CaromError where nothing gives it.
    """
    known: dict[str, tuple[float, float]] = {}
    if isinstance(scale, float | int):
        known["the scale given"] = float(scale), 0.0
    if length is not None:
        points, metres = parse_length(length)
        size = float(np.hypot(*(points[1] - points[0])))
        known["the length in the picture"] = metres / size, 1 / size
    if table is not None:
        known["the table's corners"] = table.scale, 0.002
    fall = 0.0 if falls is None else float(np.hypot(*falls.gravity))
    # (what only falls may roll down a slope)
    down = (
        falls is not None and falls.rms < MOST_MISFIT and falls.error < 0.1 * fall
        and abs(np.arctan2(falls.gravity[0], falls.gravity[1])) < UPRIGHT
    )  # fmt: skip
    if down and falls is not None and (falls.rises or scale == "gravity"):
        known["gravity"] = gravity / fall, falls.error / fall
    if radius:
        known["the ball's radius"] = radius / radius_px, RADIUS
    if scale == "gravity":
        if "gravity" not in known:
            wanted = "a ball in free flight, seen from the side, for gravity"
            raise CaromError(Fault("`scale`", "", wanted, "no motion with one acceleration downward", "give `length`"))
        order = ["gravity"]
    else:
        order = ["the table's corners", "the scale given", "the length in the picture", "the ball's radius", "gravity"]
        if "gravity" in known and abs(known["gravity"][0] / known.get(order[-2], known["gravity"])[0] - 1) < 2 * RADIUS:
            # (the better of the two, where the radius says that the film is not slowed down)
            order[-2:] = order[:-3:-1]
    first = next((name for name in order if name in known), None)
    if first is None:
        advice = "give `length` x1,y1,x2,y2=1m (two points in px and their distance), or `radius` of the ball"
        got = "none, and no flight that rises and falls was seen"
        if down:
            got = f"none: in pixels the ball falls with {fall:.4g} px/s^2"
            advice += f"; if only gravity acts on it, `scale` gravity ({1e3 * gravity / fall:.3g} mm per px)"
        raise CaromError(Fault("film", "scale", "a length in the picture", got, advice))
    value, error = known.pop(first)
    notes.append(
        f"scale: {1e3 * value:.4g} mm per px{f' ± {100 * error:.1g} %' if error else ''}, from {first}"
        + ("; speeds have this error in common, restitution has not" if error > 1e-3 else "")
    )
    for name, (other, doubt) in known.items():
        if abs(other / value - 1) > max(DIFFERENT, 2 * (doubt + error)):
            if name == "gravity":
                notes.append(slowed_note(fall * value, gravity))
            else:
                notes.append(f"by {name} a pixel were {1e3 * other:.4g} mm, {100 * (other / value - 1):+.2g} %")
    return value


SLOWED = "by this scale and the film's times"  # a note of a film whose ball falls with another g


def slowed_note(fall: float, gravity: float) -> str:
    """Return what to do where a ball falls in a film with another acceleration, m/s^2."""
    return (
        f"{SLOWED} the ball falls with {fall:.3g} m/s^2: is the film slowed down (`rate` {np.sqrt(gravity / fall):.3g} times the"
        " container's), or the scale wrong (`scale` gravity)?"
    )


def beside(k: int, rows: NDArray[np.intp]) -> list[NDArray[np.intp]]:
    """Return up to four of ``rows`` (sorted) before frame k, and up to four after it; none of those that are far away."""
    at, end = np.searchsorted(rows, [k, k + 1])
    return [one[np.abs(one - k) < 9] for one in (rows[max(at - 4, 0) : at], rows[end : end + 4])]


def sides(k: int, rows: NDArray[np.intp], times: Array, places: Array) -> list[Array]:
    """Return parabolas (3, 2), from the square on, about frame k through four of ``rows`` before it, and four after it."""
    return [np.polyfit(times[one] - times[k], places[one], 2) for one in beside(k, rows) if len(one) >= 3]


def contacts_within(times: Array, places: Array, exposure: float) -> Mask:
    """Return the frames (F,) whose exposure, s, holds a contact that moves the middle of the blurred ball, or ends beside it.

    ``places``: (F, 2), px.
    """
    found = np.zeros(len(times), bool)
    rows = np.flatnonzero(np.isfinite(places[:, 0]))
    near = np.flatnonzero(np.convolve(turning(times, places), np.ones(3), "same") > 0)
    for k in near.tolist():
        fits = sides(k, rows, times, places)
        if len(fits) == 2:
            change = fits[1][1] - fits[0][1]
            size = float(np.hypot(*change))
            when = float((fits[0][2] - fits[1][2]) @ change) / max(size**2, 1e-12)
            found[k] = abs(when) < HELD * exposure and size * exposure > 1.6
    return found
