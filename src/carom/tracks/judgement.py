"""Laws of mechanics in a trajectory of balls, of another engine, a video model or a film: which are violated, when, by how much.

Tracks are cut into pieces of constant acceleration (:mod:`carom.tracks.judgement`). Velocities just before and after an
event, with their errors, follow from the pieces; the event is where their paths meet. Nothing else is assumed of the program that
made the trajectory: not its law of impact, nor its steps. An event that moves no place by 27 standard deviations of the noise
within a frame is seen between two flights alone.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from itertools import combinations, product
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.polynomial import Polynomial
from numpy.typing import NDArray

from carom.bodies import inertia_number
from carom.data.columns import Columns, as_columns, is_columns, read_columns
from carom.data.rebounds import not_used
from carom.errors import CaromError, FaultList, checked_number
from carom.files import MOST_TABLE, as_path, parse_json, read_regular
from carom.formatting import counted
from carom.public.defaults import GRAVITY
from carom.scene.floor import gravity_on_slope
from carom.tracks.contact import View
from carom.tracks.films import columns_of_file, columns_of_tracks, film_options
from carom.tracks.formats.tables import Calibration
from carom.tracks.preprocess import at_rate, guess_view, times_behind_rounding
from carom.tracks.read import film_at_its_rate, read_by_rows, require_table_settings
from carom.tracks.track import (
    EXACT,
    FEW,
    BallRows,
    PathPiece,
    Track,
    fitted_piece,
    hidden_by_noise,
    noise_of_rows,
    path_pieces,
)
from carom.tracks.verdicts import SIGMAS, Judgement, by_film_laws
from carom.tracks.video.film import likeliest_ball
from carom.tracks.video.reading import is_film

Array = NDArray[np.float64]
POOL_BALL = 0.028575  # m
LARGEST = 1e30  # in SI units: no squares of squares overflow
LABELS = ("name", "ball")
# What carom's own files have besides
OF_FRAMES = ("vx", "vy", "vz", "qw", "qx", "qy", "qz", "energy", "phase", "species", "shot", "frame")
OF_AIR = ("air_x", "air_y", "air_z")  # the acceleration that the air gives a ball
LENGTHS = ("x", "y", "z", "radius", *OF_AIR)
NUMBERS = ("t", "x", "y", "z", "wx", "wy", "wz", "radius", "mass", "kappa", *OF_AIR)
UNKNOWN = Calibration()
NO_PULL: tuple[View, str] = ("above", "no gravity along the picture")
UPRIGHT = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])  # turns the plane of a picture upright


def read_rows(
    table: Any, radius: float | None, mass: float, noise: float | None, gravity: float = 0.0,
    calibration: Calibration = UNKNOWN,
) -> tuple[list[BallRows], float, list[str], View | None]:  # fmt: skip
    """Return the rows of each ball of a table, on the camera's clock, the noise of a coordinate (m), and what was assumed.

    And the view, of a table without heights: as fits and films guess it.
    """
    where, notes = "judge", list[str]()
    if is_columns(table):
        columns = as_columns(table, where)
    else:
        where = str(path := as_path("judge", table))
        columns, calibration = _columns(path, notes, calibration)
    require_table_settings(where, calibration)
    faults = FaultList(where)
    if not {"t", "x", "y"} <= set(columns):
        got = ", ".join(columns)
        expected = "columns t, x and y, in s and m, a row per ball and frame, or tracks of a program that carom reads"
        faults.add("", expected, f"{got:.60}{'...' if got[60:] else ''}")
    faults.raise_if_any()
    unit = dict.fromkeys(LENGTHS, calibration.scale or 1.0)
    numbers = {name: _numbers(faults, name, columns[name]) * unit.get(name, 1.0) for name in NUMBERS if name in columns}
    faults.raise_if_any()
    notes += not_used(name for name in columns if name not in (*NUMBERS, *LABELS, *OF_FRAMES))
    known = _known_rows(faults, numbers, notes)
    if not {"wx", "wy", "wz"} <= set(numbers):
        notes.append("no columns wx, wy, wz: spins are unknown; a contact may add as much energy as rolling has")
    rows = _rows_of_balls(where, columns, numbers, known, radius, mass, notes)
    if not any(len(one.t) > FEW for one in rows):
        raise CaromError(f"{where}: expected more than {FEW} frames of a ball, got fewer")
    # (rows share a time in some frames only where times are rounded)
    several = [one.name for one in rows if len(one.t) > FEW and np.unique(one.t, return_counts=True)[1].min() > 1]
    filmed = _in_plane(rows)
    filmed = filmed if calibration.rate is None else at_rate(filmed, calibration.rate, where, notes)
    filmed = list(read_by_rows(where, filmed, calibration))
    rows = [replace(row, t=one.time) for row, one in zip(rows, filmed, strict=True)]
    clock = [one.t for one in rows] if several else times_behind_rounding([one.t for one in rows], notes)
    several += [one.name for one, t in zip(rows, clock, strict=True) if len(t) > FEW and np.any(np.diff(t) <= 0)]
    if several:
        raise CaromError(
            f"{where}: {several[0]}: expected one row per frame, got two of the same time; name each ball in a column ball"
        )
    rows = [replace(one, t=t, clock=_clock_error(one.t, t)) for one, t in zip(rows, clock, strict=True)]
    sigma = noise_of_rows(rows) if noise is None else float(noise)
    rows, view = (rows, None) if "z" in numbers else _in_view(rows, gravity, notes)
    return rows, max(sigma, 4e-16 * max(float(np.abs(one.x).max(initial=0.0)) for one in rows)), notes, view


def _in_plane(rows: Sequence[BallRows]) -> list[Track]:
    return [Track(one.name, one.t, one.x[:, :2]) for one in rows]


def _in_view(rows: list[BallRows], gravity: float, notes: list[str]) -> tuple[list[BallRows], View]:
    """Return rows without heights in the view that their motion suggests: from the side y is the height."""
    view, why = guess_view(_in_plane(rows), gravity) if gravity else NO_PULL
    if view == "above":
        notes.append(f"seen from above ({why}): the balls are on the floor")
        return rows, view
    notes.append(f"seen from the side ({why}): y is the height, above the lowest place of a ball")
    low = min(float(one.x[:, 1].min()) for one in rows)
    w, air = (
        [None if part is None else part @ UPRIGHT for part in parts]
        for parts in ([b.w for b in rows], [b.air for b in rows])
    )
    x = [one.x @ UPRIGHT + [0, one.radius, one.radius - low] for one in rows]
    return [replace(one, x=x[k], w=w[k], air=air[k]) for k, one in enumerate(rows)], view


def _clock_error(rounded: Array, t: Array) -> float:
    """Return the relative standard error of the interval of even times, by what their rounding moved."""
    return float(np.std(rounded - t)) / max(math.sqrt(len(t) / 12) * float(np.ptp(t)), 1e-300)


def _rows_of_balls(
    where: str, columns: Columns, numbers: dict[str, Array], known: NDArray[np.bool_], radius: float | None, mass: float,
    notes: list[str],
) -> list[BallRows]:  # fmt: skip
    """Return the rows of each ball; a note says where a radius was assumed. Raises for balls whose radius is not known."""
    count, label = len(known), next((name for name in LABELS if name in columns), None)
    names = np.full(count, "ball")
    if label:  # (numbers are read as such: ball 1, not 1.0)
        names = np.array([f"{one:g}" if isinstance(one, float) else str(one) for one in columns[label]])
    spins, air = (
        np.stack([numbers[name] for name in three], axis=-1) if set(three) <= set(numbers) else None
        for three in (("wx", "wy", "wz"), OF_AIR)
    )
    if radius is None and "radius" not in numbers:
        assumed = "its least height" if "z" in numbers else f"{POOL_BALL:g} m, a pool ball's"
        notes.append(f"no radius: each ball's is assumed to be {assumed}")
    used, inverse = np.unique(names[known], return_inverse=True)
    order = np.lexsort((numbers["t"][known], inverse))
    by_name = np.split(np.flatnonzero(known)[order], np.cumsum(np.bincount(inverse))[:-1]) if len(used) else []
    faults, rows = FaultList(where), list[BallRows]()
    for own in sorted(by_name, key=lambda one: int(one.min())):
        name = str(names[own[0]])
        least = float(numbers["z"][own].min()) if "z" in numbers else POOL_BALL
        a = float(numbers["radius"][own][0]) if "radius" in numbers else least if radius is None else radius
        if not a > 0:
            got = f"none, and a least height of {a:g} m"
            faults.add(name, "the radius of the ball", got, "give it, or heights of the ball's centre")
        m = float(numbers["mass"][own][0]) if "mass" in numbers else mass
        z = numbers["z"][own] if "z" in numbers else np.full(len(own), a)
        x = np.stack([numbers["x"][own], numbers["y"][own], z], axis=-1)
        of_own = (None if one is None else one[own] for one in (spins, air))
        kappa = float(numbers["kappa"][own][0]) if "kappa" in numbers else 0.0
        rows.append(BallRows(name, numbers["t"][own], x, next(of_own), a, m, next(of_own), kappa))
    faults.raise_if_any()
    return rows


def _columns(path: Path, notes: list[str], known: Calibration) -> tuple[Columns, Calibration]:
    """Return the columns of a file, and by what their lengths and times are to be calibrated.

    Of JSON, frames as ``save_frames`` writes them, with arrays (frame, ball, axis). Any other file of tracks is read as tracks,
    with its units.
    """
    if path.suffix.lower() != ".json":
        columns = {} if path.suffix.lower() == ".msgpack" else read_columns(path)[0]
        if {"t", "x", "y"} <= set(columns):
            return columns, known
        return columns_of_file(path, columns, notes, known), UNKNOWN
    wanted = "a table (.csv, .parquet), or JSON with t, balls and position as frames are saved"
    expected, given = f"{path}: expected {wanted}", parse_json(path, read_regular(path, most=MOST_TABLE), wanted)
    try:
        count, balls = len(given["t"]), given["balls"]
        found: Columns = {"t": np.repeat(np.array(given["t"], dtype=float), len(balls))}
        for key, axes in (("position", "x y z"), ("spin", "wx wy wz"), ("air", " ".join(OF_AIR))):
            if key == "position" or key in given:
                flat = np.array(given[key], dtype=float).reshape(count * len(balls), 3)
                found |= dict(zip(axes.split(), flat.T, strict=True))
        found |= {
            key: np.tile([ball[key] for ball in balls], count)
            for key in ("name", "radius", "mass", "kappa")
            if key != "kappa" or key in balls[0]
        }
    except KeyError as error:
        raise CaromError(f"{expected}, got JSON without {error.args[0]!r}") from None
    except (ValueError, TypeError):
        raise CaromError(f"{expected}, got JSON of another form") from None
    return found, known


def _known_rows(faults: FaultList, numbers: dict[str, Array], notes: list[str]) -> NDArray[np.bool_]:
    """Return which rows have a time and a place; a note says how many have not. Raises for radii and masses that are none."""
    known = np.ones(len(numbers["t"]), dtype=bool)
    for name in {"t", "x", "y", "z"} & set(numbers):
        known &= np.isfinite(numbers[name])
    for name in ("radius", "mass", "kappa"):
        wrong = numbers[name][known & ~(numbers[name] > 0)] if name in numbers else np.array([])
        if len(wrong):
            faults.add(name, "numbers > 0", f"{wrong[0]:g}")
    faults.raise_if_any()
    if not known.all():
        notes.append(f"{counted(int((~known).sum()), 'row')} without a time and a place in finite numbers left out")
    return known


def _numbers(faults: FaultList, name: str, column: NDArray[Any]) -> Array:
    numbers = np.full(len(column), math.nan)
    for k, value in enumerate(column if column.dtype.kind not in "fiu" else ()):
        try:
            numbers[k] = math.nan if value is None else float(value)
        except (TypeError, ValueError):
            faults.add(name, "numbers", f"{str(value)!r:.40} in row {k + 1}")
            return numbers
    if column.dtype.kind in "fiu":
        numbers = np.asarray(column, dtype=float)
    large = np.flatnonzero(np.isfinite(numbers) & (np.abs(numbers) > LARGEST))
    if len(large):
        faults.add(name, f"numbers up to {LARGEST:g}", f"{numbers[large[0]]:g}")
    return numbers


LEAST = 1e-6  # relative: what is less is the rounding of a file
RESOLVED = 2e-3  # relative: more than two events between the same two frames change
PRESSED = 0.03  # of the impulse: the floor's friction on a ball that another presses down takes more of the momentum
COMPRESSED = 1e-3  # of their distance: balls that meet are, those of pool at 0.4 m/s, and at 1 m/s twice as much
RESISTANCE = 0.05  # of the weight: what resists a ball that rolls is less
SAME = 1e-3  # of the speed: a ball that slips less rolls
MOST_BEHIND = 64  # places that are looked at, of a wall: in doubt it may be
TOUCHED = 0.05  # of the radius: as deep a ball may be in a wall
OUTLINE = 0.03, 0.4  # radii, and px: by so much marks and shadows move the outlines of a film, alike in some frames
IN_FILMS = 0.1  # of gravity: by so much drag, perspective and the scale's error change it in a film
CAMERA_ROLL = 0.06  # rad: upright is known no better in a film
CELLS = 2**40  # along an axis: cells farther apart may have one number
MOST_PAIRS = 50_000_000  # of places in cells beside each other


def judge(
    table: Any,
    *,
    radius: float | None = None,
    mass: float = 0.17,
    inertia: str | float = "solid",
    friction: float = 1.0,
    floor_friction: float = 1.0,
    gravity: float = GRAVITY,
    drag_per_metre: float = 0.0,
    slope: tuple[float, float] = (0.0, 0.0),
    obstacles: bool = False,
    noise: float | None = None,
    scale: float | str | None = None,
    rate: float | None = None,
    film: Mapping[str, Any] | None = None,
) -> Judgement:
    """Find which laws of mechanics a trajectory of balls violates, when, and by how many standard errors.

    Parameters
    ----------
    table : path, or columns
        A row per ball and frame: ``t`` (s), ``x``, ``y``, ``z`` (m), where there are several balls ``ball``; where they are known
        ``wx``, ``wy``, ``wz`` (rad/s), ``radius`` (m), ``mass`` (kg), ``kappa``, and the acceleration that the air gives the ball,
        ``air_x``, ``air_y``, ``air_z`` (m/s^2; none: a vacuum). ``Trajectory.save_frames`` writes these, as CSV, Parquet or JSON.
        Without ``z`` the view is guessed from the motion, as fits guess it: y is the height where a ball falls, else all lie on the
        floor. Or a film, whose balls are tracked; one ball that is not seen to fall is judged by the laws without units, too.
    radius : float, optional
        Of balls without a column for it, m. Default: the least height of the ball's own centre, so that it is never in the floor.
    mass : float
        Of balls without a column for it, kg.
    inertia : str or float
        Of balls without a column ``kappa``: "solid", "hollow" or I/(m a^2).
    friction : float
        Largest friction between balls that counts as possible.
    floor_friction : float
        Largest friction of the floor that counts as possible.
    gravity : float
        Gravity, m/s^2.
    drag_per_metre : float
        1/m: of balls without columns for it, air slows one of speed v by drag_per_metre v^2; across its way a spin may push it as
        much.
    slope : (x, y)
        How far the floor falls per metre of its own along x and y (the sine of the angle, as in ``Floor``); z is normal to it.
    obstacles : bool
        Whether there may be things in the air behind which balls have been: a turn there is no violation.
    noise : float, optional
        Standard deviation of a coordinate, m. Default: estimated from third differences.
    scale : float or str, optional
        Metres per unit of the file, 0.0005 or 0.5mm; of a film also gravity. Default of a film: by gravity, or the radius.
    rate : float, optional
        Frames per second; overrides the times of the file. Default: from the times.
    film : mapping, optional
        Further arguments of :func:`carom.track_film`.

    Returns
    -------
    Judgement. Raises CaromError, all problems at once, for columns that are missing or are no numbers, and numbers out of
    range.

    Examples
    --------
    >>> import carom, tempfile, pathlib
    >>> from carom.tracks import judge
    >>> run = carom.simulate(carom.new_scene("pool-9ft"), duration=1.0)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     found = judge(run.save_frames(pathlib.Path(folder) / "run.csv", 240))
    >>> len(found.violations)
    0
    """
    not_negative = {"friction": friction, "floor_friction": floor_friction, "gravity": gravity, "noise": noise}
    kappa = _checked(
        {"radius": radius, "mass": mass}, not_negative | {"drag_per_metre": drag_per_metre}, inertia, slope
    )
    pull, tracked = np.array(gravity_on_slope(gravity, slope)), None
    known = film_options(scale, rate, radius, {**(film or {}), "gravity": gravity or GRAVITY}).calibration
    if not is_columns(table) and is_film(path := as_path("judge", table)):
        part = {name: known.film.get(name) for name in ("start", "end", "region")}
        try:
            tracked = film_at_its_rate(path, known, gravity)
        except CaromError as error:
            return by_film_laws(likeliest_ball(path, error, rate=rate, **part), f"{error}")
        table, radius = columns_of_tracks(tracked.tracks), tracked.film.radius_px * tracked.film.scale
        known = UNKNOWN  # (used)
    rows, sigma, notes, view = read_rows(table, radius, mass, noise, 0.0 if any(slope) else gravity, known)
    smooth = 0.0 if tracked is None else tracked.film.scale * max(OUTLINE[0] * tracked.film.radius_px, OUTLINE[1])
    if any(one.w is not None and not one.kappa for one in rows):
        notes.append(f"no column kappa: the moment of inertia of balls is taken as {kappa:g} m a^2 (`inertia`)")
    rows = [replace(one, kappa=one.kappa or kappa, smooth=smooth) for one in rows]
    balls = [replace(one, pieces=tuple(path_pieces(one, sigma, drag_per_metre))) for one in rows]
    remedy = [] if view is None else ["if that is wrong, give the heights of the balls as a column z"]
    notes += remedy if tracked is None else tracked.notes
    times = np.concatenate([ball.t for ball in balls])
    found = Judgement(sigma, notes, (float(times.min()), float(times.max())))
    places, roll = _Places(balls, sigma), CAMERA_ROLL if view == "side" else 0.0
    walls, rubs = None if obstacles else places, 0.0  # (what the floor's friction does at most, m/s^2)
    for ball in balls:
        if view is None:  # (else the floor is where the ball is lowest)
            _in_the_floor(ball, sigma, found)
        for piece in ball.pieces:
            own = drag_per_metre if piece.air is not None else 0.0
            rubs = max(rubs, _between_contacts(ball, piece, sigma, pull, floor_friction, own, roll, walls, found))
    _overlaps(balls, sigma, found)
    for event in _events(balls, sigma, places):
        t, late = _event_time(event)
        if not math.isnan(t):
            _energy(t, late, event, pull, found)
            if len(event.members) == 2:
                _momentum(t, late, event, friction, gravity, rubs, places, found)
            elif len(event.members) == 1 and not obstacles:
                _turn(t, event, places, found)
    if found.of("gravity") and not any(piece.air is not None for ball in balls for piece in ball.pieces):
        notes.append("gravity: flights are compared with those in a vacuum; drag_per_metre allows for air")
    by_gravity = tracked is not None and any(" from gravity" in note for note in tracked.notes)
    one_flight = by_gravity and found.checked["gravity"] == 1 and not found.of("gravity")
    found.checked["gravity"] *= not one_flight
    found.unchecked = {law: _why_unchecked(law, balls, one_flight) for law, count in found.checked.items() if not count}
    if tracked is not None and view == "above" and len(balls) == 1:  # (these hold in any view)
        with suppress(CaromError):
            alone = by_film_laws(likeliest_ball(path, CaromError(view), rate=rate, **part), view)
            for name in ("laws", "checked", "unchecked"):
                getattr(found, name).update(getattr(alone, name))
            found.violations += alone.violations
    found.violations.sort(key=lambda one: one.time)
    return found


def _checked(
    positive: Mapping[str, float | None], not_negative: Mapping[str, float | None], inertia: str | float, slope: Sequence[float]
) -> float:  # fmt: skip
    """Return the moment of inertia, I/(m a^2). Raises CaromError for all arguments out of range."""
    faults = FaultList("judge")
    for name, value in {**positive, **not_negative}.items():
        if value is not None and name in positive:
            checked_number(faults, name, value, "a number > 0", lambda x: x > 0)
        elif value is not None:
            checked_number(faults, name, value, "a number >= 0", lambda x: x >= 0)
    if not (len(slope) == 2 and math.hypot(*slope) < 1):
        faults.add("slope", "two sines, of a floor that is less steep than upright", f"{slope}")
    kappa = faults.attempt(inertia_number, inertia) or 0.0
    faults.raise_if_any()
    return kappa


def _why_unchecked(law: str, balls: Sequence[BallRows], one_flight: bool) -> str:
    if law == "penetration":
        return "there is one ball only, and the height of the floor is not known"
    pieces = [piece for ball in balls for piece in ball.pieces]
    if not pieces:
        return f"no ball has more than {FEW} frames on a smooth path: too few frames, or too much noise"
    if law == "gravity" and all(np.ptp(ball.x[:, 2]) == 0 for ball in balls):
        return "no ball leaves the floor, or heights are not known"
    if law == "momentum" and len(balls) == 1:
        return "there is one ball only"
    if law == "slip" and all(piece.spins is None for piece in pieces):
        return "spins are not known"
    in_flight = (
        "the scale is from the one flight that is seen"
        if one_flight
        else f"no ball is in the air for more than {FEW} frames"
    )
    return {
        "turn": "no ball turns alone and higher than a cushion, or obstacles are there",
        "gravity": in_flight,
        "momentum": "no collision of two balls, and of them alone, was seen",
        "energy": "no event was seen whose balls moved before it",
        "friction": f"no ball is on the floor for more than {FEW} frames, and no collision was seen",
        "slip": f"no ball with a spin is on the floor for more than {FEW} frames",
    }[law]


# --- without contacts ---------------------------------------------------------------------------------------------------


def _in_the_floor(ball: BallRows, sigma: float, found: Judgement) -> None:
    depth = ball.radius - ball.x[:, 2]
    k = int(np.argmax(depth))
    least, error = 1e-4 * ball.radius, sigma * _of_largest(len(depth))
    found.check("penetration", float(ball.t[k]), [ball.name], float(depth[k]), error, least, "the ball is in the floor")


def _of_largest(count: int) -> float:
    """Return by how much the error bar of one of so many is to be longer, so that the largest is a violation no more often."""
    return math.sqrt(1 + 2 * math.log(count) / SIGMAS**2)


def _overlaps(balls: Sequence[BallRows], sigma: float, found: Judgement) -> None:
    """Check all pairs of balls that have frames in common; only places in cells beside each other are compared."""
    begin, end = (np.sort([ball.t[k] for ball in balls]) for k in (0, -1))
    # (all pairs but those of which one has ended before the other begins)
    pairs = len(balls) * (len(balls) - 1) // 2 - int(np.searchsorted(end, begin, side="left").sum())
    found.checked["penetration"] += pairs
    of = np.repeat(np.arange(len(balls)), [len(ball.t) for ball in balls])
    x, radius = np.concatenate([ball.x for ball in balls]), np.array([ball.radius for ball in balls])[of]
    t = np.concatenate([ball.t for ball in balls])
    frame = np.unique(t, return_inverse=True)[1]
    cell = np.mod(np.floor(x / (2 * radius.max())), CELLS).astype(np.int64)
    key = _hashed(frame, cell)
    order = np.argsort(key, kind="stable")
    worst: dict[tuple[int, int], tuple[float, int]] = {}
    budget = MOST_PAIRS
    for step in product((-1, 0, 1), repeat=3):
        if step < (0, 0, 0):
            continue
        beside = _hashed(frame, (cell + step) % CELLS)
        low, high = (np.searchsorted(key[order], beside, side=side) for side in ("left", "right"))
        budget -= int((high - low).sum())
        if budget < 0:
            raise CaromError(
                f"judge: expected balls apart, got more than {MOST_PAIRS:,} pairs of places less than two diameters"
                " apart; is the radius, or its unit, right?"
            )
        i = np.repeat(np.arange(len(key)), high - low)
        j = order[np.arange(len(i)) + np.repeat(high - np.cumsum(high - low), high - low)]
        depth = radius[i] + radius[j] - np.linalg.norm(x[i] - x[j], axis=1)
        for k in np.flatnonzero((depth > 0) & (of[i] != of[j]) & (frame[i] == frame[j])).tolist():
            pair = (int(min(of[i[k]], of[j[k]])), int(max(of[i[k]], of[j[k]])))
            worst[pair] = max(worst.get(pair, (0.0, 0)), (float(depth[k]), -int(min(i[k], j[k]))))
    found.checked["penetration"] -= len(worst)
    for (one, other), (size, row) in sorted(worst.items()):
        names = [balls[one].name, balls[other].name]
        error = math.sqrt(2) * sigma * _of_largest(len(balls[one].t))
        least = COMPRESSED * (balls[one].radius + balls[other].radius)
        found.check("penetration", float(t[-row]), names, size, error, least, "the balls overlap")


def _hashed(frame: NDArray[np.int64], cell: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return a number (n,) for each frame and cell (n, 3); another cell's may be the same."""
    found: NDArray[np.int64] = frame * 2654435761 + cell @ np.array([73856093, 19349669, 83492791]) * 1000003
    return found


def _between_contacts(
    ball: BallRows, piece: PathPiece, sigma: float, pull: Array, floor_friction: float, drag: float, roll: float,
    places: _Places | None, found: Judgement,
) -> float:  # fmt: skip
    """Check free fall in the air; friction and its direction on the floor, and return how much it accelerates the ball at least."""
    through = ball.x[piece.first : piece.last + 1]
    up = through[:, 2] - ball.radius
    if (aloft := up > hidden_by_noise(sigma) + LEAST * ball.radius).any():  # (lower frames may be beyond a bounce)
        low, high = int(aloft.argmax()), len(up) - int(aloft[::-1].argmax())
        if FEW < high - low < len(up):
            piece = fitted_piece(ball, piece.first + low, piece.first + high - 1, sigma, drag)
        up, through = up[low:high], through[low:high]
    (a, error), t, names = piece.acceleration, float(ball.t[piece.first]), [ball.name]
    if len(up) <= FEW or (len(up) < 2 * FEW and not piece.even):
        return 0.0
    step = float(np.diff(ball.t[piece.first : piece.last + 1]).max())
    if up.min() > hidden_by_noise(sigma) + LEAST * ball.radius:
        if up.max() < -pull[2] * step**2 / 2 or (roll and _supported(through, SIGMAS * sigma + 2 * ball.smooth)):
            return 0.0  # (it may hop from frame to frame; or there is something else than the floor below it)
        if piece.hides > 1 and (not places or any(places.pushes(ball, x, a - pull, slack=TOUCHED) for x in through)):
            error *= math.sqrt(piece.hides)
        aside = max(float(np.hypot(*(a - pull)[:2])) - roll * float(np.linalg.norm(a)), 0.0)
        off = math.hypot(aside, abs(float(a[2] - pull[2]))) if roll else float(np.linalg.norm(a - pull))
        speed = float(np.linalg.norm(v := piece.velocity(piece.middle)[0]))
        if drag > 0 and speed > 0:  # (the Magnus force may be as large, and is across the way)
            along = float((a - pull) @ v) / speed
            off = math.hypot(along, max(math.sqrt(max(off * off - along * along, 0.0)) - drag * speed * speed, 0.0))
        said = ", ".join(f"{x:.3g}" for x in piece.parabola(piece.middle)[2] * 2)
        error, least = math.hypot(error, 2 * ball.clock * float(np.linalg.norm(a))), IN_FILMS if ball.smooth else LEAST
        found.check(
            "gravity", t, names, off, error, least * -pull[2], f"the ball in the air accelerates by ({said}) m/s^2"
        )
    elif np.abs(up).max() < SIGMAS * sigma + 1e-4 * ball.radius and pull[2] < 0:
        rubs = a[:2] - pull[:2]
        along = float(np.hypot(*rubs)) / -pull[2]
        text = f"the floor's friction would be {along:.3g}"
        found.check("friction", t, names, along - floor_friction, error / -pull[2], LEAST, text)
        if piece.spins is not None:
            _slip(ball, piece, rubs, error, found)
        return max(float(np.hypot(*rubs)) - SIGMAS * error, 0.0)
    return 0.0


def _supported(x: Array, slack: float) -> bool:
    """Return whether a ball at places x (n, 3), seen from the side, bounces meanwhile, or rolls along a straight line."""
    z = x[:, 2]
    dips = np.minimum(np.maximum.accumulate(z), np.maximum.accumulate(z[::-1])[::-1]) - z
    along = np.linalg.svd(middle := (x - x.mean(axis=0))[:, [0, 2]])[2][0]
    beside = np.abs(middle @ [along[1], -along[0]])
    limit = slack + LEAST * float(np.ptp(x, axis=0).max())
    return bool(dips.max() > limit or (beside.max() < limit and abs(along[1]) < abs(along[0])))


def _slip_of(ball: BallRows, piece: PathPiece, t: float) -> float:
    """Return the speed of the lowest point of a ball on the floor, infinite where spins are unknown."""
    if piece.spins is None:
        return math.inf
    v, w = piece.velocity(t)[0], piece.spin(t)
    return math.hypot(v[0] - ball.radius * w[1], v[1] + ball.radius * w[0])


def _slip(ball: BallRows, piece: PathPiece, a: Array, error: float, found: Judgement) -> None:
    """Check that friction acts against the slip of a ball on the floor, and that a ball that rolls goes on rolling."""
    t0, t1 = float(ball.t[piece.first]), float(ball.t[piece.last])
    slips = []
    for t in (t0, t1):
        v, w = piece.velocity(t)[0], piece.spin(t)
        slips.append(v[:2] + ball.radius * np.array([-w[1], w[0]]))
    speed, size, size1 = (float(np.linalg.norm(x)) for x in (piece.velocity(t0)[0], *slips))
    dv = math.hypot(piece.velocity(t0)[1], piece.velocity(t1)[1], ball.radius * piece.spin_error)
    rolls = SAME * speed + SIGMAS * dv
    if size <= rolls:
        fast = max(speed, float(np.linalg.norm(piece.velocity(t1)[0])), 1e-300)  # (it may start from rest)
        text = "a ball that rolls begins to slip"
        found.check("slip", t0, [ball.name], size1 / fast - 2 * SAME, dv / fast, LEAST, text)
    elif min(size, size1) > rolls and slips[0] @ slips[1] > 0:
        pull = max(float(np.hypot(*a)), 1e-300)
        # (on a slope the slip turns, and the mean friction is against a direction between its first and its last)
        across = [float((a[0] * slip[1] - a[1] * slip[0]) / np.linalg.norm(slip)) for slip in slips]
        sideways = 0.0 if across[0] * across[1] < 0 else min(map(abs, across))
        share = max(float(a @ slips[0]) / size, float(a @ slips[1]) / size1, sideways) / pull
        wrong = math.hypot(error / pull, dv / min(size, size1))
        found.check("slip", t0, [ball.name], share, wrong, SAME, "friction does not act against the slip")


# --- contacts -----------------------------------------------------------------------------------------------------------


class _Change(NamedTuple):
    """A ball, and its pieces before and after an event."""

    ball: BallRows
    before: PathPiece
    after: PathPiece


class _Event(NamedTuple):
    """Balls whose acceleration changes between the same two frames."""

    low: float
    high: float
    members: tuple[_Change, ...]


def _events(balls: Sequence[BallRows], sigma: float, places: _Places) -> Iterator[_Event]:
    """Yield events: changes of one ball, joined where two balls are in reach of each other at the same time."""
    most = 1 if sigma < EXACT else 5  # frames between two pieces, with one event there
    changes = [
        _Change(ball, a, b)
        for ball in balls
        for a, b in zip(ball.pieces, ball.pieces[1:], strict=False)
        if b.first - a.last <= most
    ]
    changes.sort(key=lambda one: float(one.ball.t[one.before.last]))
    index = {id(ball): k for k, ball in enumerate(balls)}
    of = np.array([index[id(one.ball)] for one in changes], dtype=int)
    lows = np.array([one.ball.t[one.before.last] for one in changes])
    numbers = np.array([one.before.parabola(low) for one, low in zip(changes, lows, strict=True)]).reshape(-1, 3, 3)
    radius = np.array([ball.radius for ball in balls])
    used = np.zeros(len(changes), dtype=bool)
    for i, first in enumerate(changes):
        if used[i]:
            continue
        low, high = float(lows[i]), float(first.ball.t[first.after.first])
        stop = max(int(np.searchsorted(lows, high, side="left")), i + 1)
        group, near, k = [i], np.zeros(stop - i, dtype=bool), i
        while True:  # (what a ball of the group reaches belongs to the group, in order of time)
            rest = slice(k + 1, stop)
            tau = (lows[k] - lows[rest])[:, None]
            x, v, half = (numbers[rest, power] for power in range(3))
            here, own = changes[k].before.place(float(lows[k]))[0], changes[k].before.velocity(float(lows[k]))[0]
            gap = np.linalg.norm(here - (x + v * tau + half * tau**2), axis=1)
            gap -= radius[of[k]] + radius[of[rest]]
            closing = np.linalg.norm(own - (v + 2 * half * tau), axis=1)
            reached = (gap < SIGMAS * sigma + 2 * closing * (high - low)) & (of[rest] != of[k])
            near[k + 1 - i :] |= reached & ~used[rest]
            following = np.flatnonzero(near[k + 1 - i :])
            if not len(following):
                break
            k += 1 + int(following[0])
            group.append(k)
            used[k] = True
        event = _Event(low, high, tuple(changes[g] for g in group))
        if places.resolves(event):
            yield event


class _Places:
    """Where all balls are, in order of time: which are beside an event, and where walls may be, behind which none was ever."""

    def __init__(self, balls: Sequence[BallRows], sigma: float) -> None:
        self.balls, self.sigma = balls, sigma
        self.of = np.repeat(np.arange(len(balls)), [len(ball.t) for ball in balls])
        t = np.concatenate([ball.t for ball in balls])
        order = np.argsort(t, kind="stable")
        self.t, self.x, self.of = t[order], np.concatenate([ball.x for ball in balls])[order], self.of[order]
        self.radius, self.fastest = (
            np.array([getattr(ball, name) for ball in balls]) for name in ("radius", "fastest")
        )

    def beside(self, low: float, high: float, balls: Sequence[BallRows]) -> list[BallRows]:
        """Return the balls beside some that are in reach of one between two times."""
        rows = slice(*np.searchsorted(self.t, [low - (high - low), high + (high - low)], side="left"))
        x, of = self.x[rows], self.of[rows]
        near = np.zeros(len(x), dtype=bool)
        fastest = np.maximum(self.fastest[of], max(one.fastest for one in balls))
        for ball in balls:
            gap = np.linalg.norm(x - ball.at(low), axis=1)
            near |= gap - ball.radius - self.radius[of] < SIGMAS * self.sigma + 4 * fastest * (high - low)
        found = (self.balls[k] for k in np.unique(of[near]))
        return [ball for ball in found if all(one is not ball for one in balls)]

    def resolves(self, event: _Event) -> bool:
        """Return whether each ball beside an event is on one path meanwhile, so that none takes part in it.

        A ball that touches another one may pass on a blow and stay where it is: what is beside it counts as well.
        """
        low, high, touching = event.low, event.high, [one.ball for one in event.members]
        balls = list[BallRows]()
        while touching:
            balls += touching
            beside = self.beside(low, high, balls)
            for ball in beside:
                if not any(p.even and ball.t[p.first] <= low and ball.t[p.last] >= high for p in ball.pieces):
                    return False
            apart = [min(math.dist(a.at(low), b.at(low)) - a.radius - b.radius for b in balls) for a in beside]
            touching = [a for a, gap in zip(beside, apart, strict=True) if gap < hidden_by_noise(self.sigma)]
        return True

    def pushes(
        self, ball: BallRows, place: Array, impulse: Array, widest: float = math.pi / 4, slack: float = SAME
    ) -> bool:
        """Return whether a wall that touches a ball at its place may give it an impulse, both (2,) or (3,).

        Its normal is within an angle of the impulse (friction up to 1); ``slack``: by which balls are behind it, in radii.
        """
        d = impulse / np.linalg.norm(impulse)
        wider = self.radius[self.of] - ball.radius
        ahead = self.x[:, : len(d)] - place
        ahead += ((SIGMAS * self.sigma + slack * ball.radius) - np.where(wider < 0, 1.5, 1.0) * wider)[:, None] * d
        n, kept = d, list[Array]()
        for _ in range(MOST_BEHIND):
            k = int(np.argmin(behind := ahead @ n))
            if behind[k] > -1e-9 * np.linalg.norm(ahead[k]):
                return True
            kept.append(ahead[k])
            # the nearest direction to the impulse with all of these in front: one or two of them are on the wall
            found = [d - (d @ one) / (one @ one) * one for one in kept]
            if len(d) == 3:
                found += [line * (line @ d) for one, two in combinations(kept, 2) for line in [np.cross(one, two)]]
            sizes = [max(float(np.linalg.norm(one)), 1e-300) for one in found]
            ways = [one / size for one, size in zip(found, sizes, strict=True)]
            fit = [way for way in ways if all(way @ one > -1e-9 * np.linalg.norm(one) for one in kept)]
            n = max(fit, key=lambda way: float(way @ d), default=-d)
            if n @ d < math.cos(widest):
                return False
        return True


def _event_time(event: _Event) -> tuple[float, float]:
    """Return when an event is, and its error: where the paths before and after meet; NaN where several events lie between."""
    best, error = math.nan, math.inf
    span = event.high - event.low
    for ball, a, b in event.members:
        # how far both paths are apart, squared, over the share of the interval that has gone by
        gone = (b.parabola(event.low) - a.parabola(event.low)) * np.array([[1.0], [span], [span * span]])
        squares = [Polynomial(one) ** 2 for one in gone.T]
        apart = squares[0] + squares[1] + squares[2]
        turns = np.real(apart.deriv().trim(1e-12 * float(np.abs(apart.coef).max())).roots())
        shares = [0.0, 1.0, *turns[(turns > 0) & (turns < 1)].tolist()]
        share = min(shares, key=lambda one: float(apart(one)))
        t = event.low + share * span
        off = math.hypot(a.place(t)[1], b.place(t)[1])
        if math.sqrt(max(float(apart(share)), 0.0)) > SIGMAS * off + LEAST * ball.radius:
            return math.nan, 0.0
        jump = float(np.linalg.norm(b.velocity(t)[0] - a.velocity(t)[0]))
        bend = float(np.linalg.norm(b.acceleration[0] - a.acceleration[0]))
        # the paths cross at an angle, or touch
        own = min(off / max(jump, 1e-300), math.sqrt(2 * off / max(bend, 1e-300)), span)
        if own < error:
            best, error = t, own
    return best, error


def _energy(t: float, late: float, event: _Event, pull: Array, found: Judgement) -> None:
    """Check that no energy appears; where spins are unknown, up to that of rolling may come from them."""
    sums, variance, hidden, most = [0.0, 0.0], 0.0, 0.0, 0.0
    for ball, *pieces in event.members:
        moment = ball.kappa * ball.mass * ball.radius**2
        base = pieces[0].place(t)[0] if pull[0] or pull[1] else np.array([0.0, 0.0, ball.radius])
        for k, piece in enumerate(pieces):
            (v, dv), a = piece.velocity(t), piece.acceleration[0]
            energy = ball.mass * (float(v @ v) / 2 - float(pull @ (piece.place(t)[0] - base)))
            power = ball.mass * float(v @ (a - pull))
            if piece.spins is not None:
                w = piece.spin(t)
                energy, power = energy + moment * float(w @ w) / 2, power + moment * float(w @ piece.spins[1])
                variance += (moment * float(np.linalg.norm(w)) * piece.spin_error) ** 2
            elif k == 0:
                hidden += ball.kappa * ball.mass * float(v @ v) / 2
            sums[k] += energy
            variance += (ball.mass * float(np.linalg.norm(v)) * dv) ** 2 + (power * late) ** 2
        most = max(most, ball.mass * ball.fastest**2 / 2)
    had, has = sums
    if had > LEAST * most:  # (else a cue strikes a ball at rest, or all has come to rest)
        names = [ball.name for ball, *_pieces in event.members]
        text = f"{100 * (has - had) / had:.3g} % more energy after an event than before"
        found.check("energy", t, names, has - had - hidden, math.sqrt(variance), RESOLVED * had, text)


def _turn(t: float, event: _Event, places: _Places, found: Judgement) -> None:
    """Check that a ball that turns alone in the air, higher than a cushion, is at a wall behind which no ball has been."""
    ((ball, a, b),) = event.members
    (x, dx), (v, dv), (u, du) = a.place(t), a.velocity(t), b.velocity(t)
    error, size = math.hypot(dv, du), float(np.linalg.norm(u - v))
    low = x[2] < 3 * ball.radius + SIGMAS * dx + float(np.linalg.norm(v)) * (event.high - event.low)
    if low or size <= SIGMAS * error or places.beside(event.low, event.high, [ball]):
        return
    share = math.sqrt(0.5)
    if a.spins is not None and b.spins is not None:  # (friction turns the ball, most of all a solid one)
        spun = float(np.linalg.norm(b.spin(t) - a.spin(t))) + SIGMAS * (a.spin_error + b.spin_error)
        share = min(share, SAME + max(ball.kappa, 2 / 3) * ball.radius * spun / max(size, 1e-300))
    widest = math.asin(share) + SIGMAS * error / max(size, 1e-300)
    may = places.pushes(ball, x, u - v, widest, TOUCHED)
    said = ", ".join(f"{one:.3g}" for one in x)
    text = f"the ball in the air turns by {size:.3g} m/s at ({said}) m, where no wall can be"
    found.check("turn", t, [ball.name], 0.0 if may else size, error, LEAST * ball.fastest, text)


def _momentum(
    t: float, late: float, event: _Event, friction: float, g: float, rubs: float, places: _Places, found: Judgement
) -> None:
    """Check the momentum of two balls along the floor, but for what the floor and a wall can give them; and their friction.

    Between the frames beside a contact the floor's friction acts, and a ball may roll again or rest.
    """
    (one, a, b), (other, c, d) = event.members
    (x, dx), (y, dy) = a.place(t), c.place(t)
    reach = one.radius + other.radius
    if np.linalg.norm(x - y) - reach > SIGMAS * math.hypot(dx, dy) + SAME * reach:
        return  # two events side by side
    p, q = one.mass * (b.velocity(t)[0] - a.velocity(t)[0]), other.mass * (d.velocity(t)[0] - c.velocity(t)[0])
    most = max(one.kappa, other.kappa)
    of_one, of_other = (math.hypot(x.velocity(t)[1], y.velocity(t)[1]) for x, y in ((a, b), (c, d)))
    error = math.hypot(one.mass * of_one, other.mass * of_other, (one.mass + other.mass) * g * late)
    size, extra = float(np.linalg.norm(p)), float(np.linalg.norm((p + q)[:2]))
    floor = abs(float(p[2])) + abs(float(q[2]))  # of its friction, where a ball is pressed down
    floor = (floor if floor > SIGMAS * error else 0.0) + (one.mass + other.mass) * rubs * max(
        event.high - event.low, 0.0
    )
    if rubs < RESISTANCE * g and any(
        _slip_of(ball, piece, event.high) < SAME * ball.fastest for ball, _, piece in event.members
    ):
        # (no ball was seen to slide, but one rolls: it did so between two frames, and the floor gave it this at most)
        floor += min((one.mass + other.mass) * g * max(event.high - event.low, 0.0), 2 * most / (1 + most) * size)
    if extra - floor > max(SIGMAS * error, PRESSED * size) and any(
        places.pushes(ball, place[:2], (p + q)[:2], slack=TOUCHED + SIGMAS * off / ball.radius)
        for ball, place, off in ((one, x, dx), (other, y, dy))
    ):
        return  # (a ball that touches a cushion is struck)
    names = [one.name, other.name]
    text = f"{extra:.3g} N s of momentum appear in a contact of {size:.3g} N s"
    found.check("momentum", t, names, extra - floor, error, PRESSED * size, text)
    n = (x - y) / np.linalg.norm(x - y)
    normal = float(p @ n)
    if normal > SIGMAS * error:
        mu = (float(np.linalg.norm(p - normal * n)) - floor) / normal
        wrong = math.hypot(error / normal, 2 * math.hypot(dx, dy) / float(np.linalg.norm(x - y)))
        found.check("friction", t, names, mu - friction, wrong, RESOLVED, f"the balls' friction would be {mu:.3g}")
