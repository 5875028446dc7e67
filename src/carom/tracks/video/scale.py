"""From pixels to metres, from frames to the times of rows: flights, gravity, the camera's readout, lengths in the picture."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.units import parse_quantity
from carom.errors import CaromError, Fault, FaultList
from carom.formatting import counted

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
NUMBER = r"-?\d+(?:\.\d*)?"
LEAST_FLIGHT = 6  # frames
SHARP_TURN, TURN_SHARE = 8.0, 0.12  # times the usual change of velocity in a frame, and of the largest speed: a contact
MOST_MISFIT = 1.5  # px, rms of places about flights
UPRIGHT = 0.35  # rad between gravity and the picture's vertical
MOST_READOUT, LEAST_READOUT = 0.06, 2e-3  # s, of cameras that read row after row
EXCLUDED = 2.5  # error bars
DRAG = 0.05  # 1/m: standard deviation of the prior of the air's drag
RADIUS = 0.02  # of the scale by the ball's radius, which light and shadow change
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
    weights = np.array([1 / error**2 for _value, error in found if error > 0])
    if not len(weights):
        return 0.0, 0.0
    value, error = (
        float(np.array([one for one, error in found if error > 0]) @ weights / weights.sum()),
        float(weights.sum() ** -0.5),
    )
    if value + EXCLUDED * error < LEAST_READOUT or value - EXCLUDED * error > MOST_READOUT:
        return 0.0, 0.0
    value = max(value, 0.0)
    notes.append(
        f"rolling shutter: outlines and flights show a readout of {1e3 * value:.3g} ± {1e3 * error:.1g} ms from first to last row;"
        " used, and its error is part of all error bars (`readout` gives another, 0 for none)"
    )
    return value, error


def turning(times: Array, places: Array) -> Mask:
    """Return the frames (F,) beside which a ball turns sharply: places (F, 2) are NaN where it was not seen."""
    rows = np.flatnonzero(np.isfinite(places[:, 0]))
    found = np.zeros(len(times), bool)
    if len(rows) < 5:
        return found
    slope = np.diff(places[rows], axis=0) / np.diff(times[rows])[:, None]
    change = np.hypot(*np.diff(slope, axis=0).T)
    limit = max(
        SHARP_TURN * float(np.median(np.abs(change - np.median(change)))), TURN_SHARE * float(np.hypot(*slope.T).max())
    )
    found[rows[1:-1][np.abs(change - np.median(change)) > limit]] = True
    return found


def fit_falls(
    balls: Sequence[tuple[Array, Array, Mask]], size: tuple[int, int], rotation: int, free: bool
) -> Falls | None:
    """Fit all flights of balls with one acceleration, and with ``free`` a readout of the camera and the air's drag.

    ``balls``: times (F,), s, places (F, 2), px, and which (F,) are used; ``size``: width and height of the picture.
    Returns None without flights.
    """
    flights = []
    for times, places, used in balls:
        known = np.where(used[:, None], places, np.nan)
        turns = turning(times, known)
        rows = np.flatnonzero(used)
        cut = np.flatnonzero(turns[rows] | (np.diff(rows, prepend=rows[:1]) > 3))
        for between in np.split(rows, cut):
            part = between[~turns[between]]
            if len(part) >= LEAST_FLIGHT:
                flights.append((times[part], places[part]))
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
    rises = any(((x[-1] - x[0]) @ usual[:2] < 0) for _t, x in flights) or any(
        (np.diff(x @ usual[:2]) < 0).any() and (np.diff(x @ usual[:2]) > 0).any() for _t, x in flights
    )
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
    found = re.fullmatch(",".join([rf"\s*({NUMBER})\s*"] * 4) + r"=\s*(.+)", text)
    wanted = "two points in px and their distance, x1,y1,x2,y2=1m"
    if found is None:
        raise CaromError(Fault("`length`", "", wanted, repr(text)))
    points = np.array([float(one) for one in found.groups()[:4]]).reshape(2, 2)
    try:
        metres = float(found[5])
    except ValueError:
        try:
            metres = float(parse_quantity(found[5], "m"))
        except ValueError:
            metres = np.nan
    if not 0 < metres < 1e4 or not np.hypot(*(points[1] - points[0])) > 0:
        raise CaromError(Fault("`length`", "", wanted, repr(text)))
    return points, metres


class Asked(NamedTuple):
    """Arguments of track_film that were read."""

    seeds: list[tuple[float, ...]]
    """x, y, t of each ball."""
    colour: Array | None
    region: tuple[float, ...] | None


def check_arguments(
    balls: int, radius: float | None, scale: float | str | None, length: str | None, readout: float | None, rate: float | None,
    ball: Sequence[str] | str, colour: str | None, region: str | None, start: float | None, end: float | None,
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
    seeds = [
        _numbers(rf"({NUMBER}),({NUMBER})@({NUMBER})s?", one) for one in ([ball] if isinstance(ball, str) else ball)
    ]
    if () in seeds:
        faults.add("`ball`", "a place and a time, x,y@t (px, s)", repr(ball))
    elif seeds and len(seeds) != balls:
        faults.add("`ball`", f"one for each of {counted(balls, 'ball')}", str(len(seeds)))
    tone = re.fullmatch(r"#[0-9a-fA-F]{6}", colour or "")
    if colour is not None and tone is None:
        faults.add("`colour`", "red, green, blue as in '#e0b020'", repr(colour))
    corners = _numbers(",".join([f"({NUMBER})"] * 4), region or "")
    if region is not None and not (corners and corners[2] > corners[0] and corners[3] > corners[1]):
        faults.add("`region`", "x0,y0,x1,y1 in px, x0 < x1 and y0 < y1", repr(region))
    faults.raise_if_any()
    return Asked(seeds, None if tone is None else np.array(list(bytes.fromhex(tone[0][1:])), float), corners or None)


def _numbers(pattern: str, text: str) -> tuple[float, ...]:
    """Return the numbers of a text of that form; none of another one."""
    found = re.fullmatch(pattern, re.sub(r"\s", "", text))
    return tuple(float(one) for one in found.groups()) if found else ()


def choose_scale(
    radius_px: float, falls: Falls | None, *, scale: float | str | None, length: str | None, radius: float | None, gravity: float,
    notes: list[str],
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
    fall = 0.0 if falls is None else float(np.hypot(*falls.gravity))
    side = (
        falls is not None and falls.rms < MOST_MISFIT and falls.error < 0.1 * fall
        and abs(np.arctan2(falls.gravity[0], falls.gravity[1])) < UPRIGHT and falls.rises
    )  # fmt: skip
    if side and falls is not None:
        known["gravity"] = gravity / fall, falls.error / fall
    if radius:
        known["the ball's radius"] = radius / radius_px, RADIUS
    if scale == "gravity":
        if "gravity" not in known:
            got = (
                "no flight that rises and falls"
                if falls is None or not falls.rises
                else "no motion with one acceleration downward"
            )
            raise CaromError(
                Fault("`scale`", "", "a ball in free flight, seen from the side, for gravity", got, "give `length`")
            )
        order = ["gravity"]
    else:
        order = ["the scale given", "the length in the picture", "the ball's radius", "gravity"]
        if "gravity" in known and abs(known["gravity"][0] / known.get(order[2], known["gravity"])[0] - 1) < 2 * RADIUS:
            order[2:] = order[:1:-1]  # (the better of the two, where the radius says that the film is not slowed down)
    first = next((name for name in order if name in known), None)
    if first is None:
        advice = "give `length` x1,y1,x2,y2=1m (two points in px and their distance), or `radius` of the ball"
        raise CaromError(Fault("film", "scale", "a length, and no free fall was seen", "none", advice))
    value, error = known.pop(first)
    notes.append(
        f"scale: {1e3 * value:.4g} mm per px{f' ± {100 * error:.1g} %' if error else ''}, from {first}"
        + ("; speeds have this error in common, restitution has not" if error > 1e-3 else "")
    )
    for name, (other, doubt) in known.items():
        if abs(other / value - 1) > max(DIFFERENT, 2 * (doubt + error)):
            if name == "gravity":
                notes.append(
                    f"by this scale and the film's times the ball falls with {fall * value:.3g} m/s^2: is the film slowed down"
                    f" (`rate` {np.sqrt(other / value):.3g} times the container's), or the scale wrong (`scale` gravity)?"
                )
            else:
                notes.append(f"by {name} a pixel were {1e3 * other:.4g} mm, {100 * (other / value - 1):+.2g} %")
    return value


def contacts_within(times: Array, places: Array, exposure: float) -> Mask:
    """Return the frames (F,) whose exposure, s, holds a contact that moves the middle of the blurred ball: places (F, 2), px."""
    found = np.zeros(len(times), bool)
    rows = np.flatnonzero(np.isfinite(places[:, 0]))
    turns = turning(times, places)
    near = np.flatnonzero(np.convolve(turns, np.ones(3), "same") > 0)
    for k in near.tolist():
        sides = []
        for side in (rows[rows < k][-4:], rows[rows > k][:4]):
            if len(side) < 3 or abs(side - k).max() > 8:
                break
            t = times[side] - times[k]
            sides.append(np.array([np.polyfit(t, places[side, axis], 2) for axis in (0, 1)]))
        if len(sides) == 2:
            change = sides[1][:, 1] - sides[0][:, 1]
            size = float(np.hypot(*change))
            when = float((sides[0][:, 2] - sides[1][:, 2]) @ change) / max(size**2, 1e-12)
            found[k] = abs(when) < 0.55 * exposure and size * exposure > 1.6
    return found
