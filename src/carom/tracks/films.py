"""Films to one table of rebounds: of one, of several, and of files."""

from __future__ import annotations

import functools
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.bodies import inertia_number
from carom.data.columns import Columns
from carom.data.rebounds import Kind, Rebounds, energy_remarks, make_rebounds
from carom.data.table_cells import parse_numbers
from carom.data.where import Where, rows_where
from carom.errors import CaromError, FaultList, collected, noting, shortened_list, suggestion
from carom.files import open_regular, text_encoding
from carom.formatting import counted
from carom.public.defaults import GRAVITY, WINDOW
from carom.public.progress import Progress
from carom.tracks.contact import DECISIVE, Settings, TrackContact, WithError, hop_excess, shared_fraction
from carom.tracks.events import wall_of_text
from carom.tracks.flights import drag_in_words, joint_air, with_other_drag
from carom.tracks.formats.tables import HEADER_EXAMPLE, Calibration
from carom.tracks.least_squares import OUTPUTS
from carom.tracks.measurement import Measured, measure
from carom.tracks.pairs import PairContact, measure_pairs, pair_rebounds
from carom.tracks.read import TrackFile, film_of, format_of, got_instead, is_table_of_rebounds, require_text, track_text
from carom.tracks.track import Track
from carom.tracks.video.reading import is_film

Stage = Literal["best", "after_wall", "rolling", "both"]
# Properties of the floor: name, name in a fit, prefix of columns
FLOOR = (("floor friction", "mu_g", "cloth"), ("rolling resistance", "c_g", "rolling"))


def usable_stages(one: TrackContact, stage: Stage, keep_sliding: bool = False) -> tuple[list[str], str]:
    """Return the stages of a contact that go into a table of rebounds, and the reason if there is none.

    Parameters
    ----------
    one : TrackContact
        From :func:`carom.tracks.measure`.
    stage : "best", "after_wall", "rolling" or "both"
        As in :func:`to_rebounds`.
    keep_sliding : bool
        Whether to keep balls that still slide when they meet the wall.

    Returns
    -------
    stages : list of str
        "after_wall", "rolling", or both.
    why : str
        The reason if there is none; else empty.

    Examples
    --------
    >>> from carom.tracks import TrackContact, WallLine, usable_stages
    >>> wall = WallLine("left", (0.0, 0.0), (1.0, 0.0))
    >>> usable_stages(TrackContact("ball", "", wall, 0.2, 2, 9, why="2 frames before it"), "best")
    ([], '2 frames before it')
    """
    if one.fit is None:
        return [], one.why
    slip = sliding_reason(one)
    if slip and not keep_sliding:
        return [], slip
    if one.planar:
        why = one.why_not("after_wall")
        return ([] if why else ["after_wall"]), why
    wanted = ("after_wall", "rolling") if stage in ("best", "both") else (stage,)
    if stage == "best" and one.hop != "none":
        wanted = ("rolling", "after_wall")  # what follows the hop is determined better
    whys = {name: one.why_not(name) for name in wanted}
    good = [name for name in wanted if not whys[name]]
    return (good[:1] if stage == "best" else good), ("" if good else "; ".join(dict.fromkeys(whys.values())))


def sliding_reason(one: TrackContact) -> str:
    """Return why a contact is not a rebound of a rolling ball (it still slides); empty if it rolls, or is in flight."""
    if one.fit is None or one.planar or not one.fit.slid_before:
        return ""
    size = float(np.hypot(one.fit["un_in"], one.fit["ut_in"]))
    error = float(np.hypot(one.fit.error("un_in"), one.fit.error("ut_in")))
    if size < max(2 * error, 0.01):
        return ""
    return "it still slides when it meets the wall; rebounds on a table are of rolling balls (`keep_sliding` keeps it)"


def to_rebounds(measured: Measured, stage: Stage = "best", *, keep_sliding: bool = False) -> Rebounds:
    """Make a table of rebounds from measured contacts: planar in flight, else of a ball on a table.

    Parameters
    ----------
    measured : Measured
        From :func:`carom.tracks.measure`.
    stage : "best", "after_wall", "rolling" or "both"
        Of a ball on a table: as it leaves the wall, once it rolls again, the first of these that the track determines (the
        second, if it may hop off the wall), or both as two rows, which are not independent.
    keep_sliding : bool
        Whether to keep balls that still slide when they meet the wall; the columns slip_n_in, slip_t_in are their slip.

    Returns
    -------
    Rebounds
        One row per contact. Extra columns: shot, ball, wall, contact (its number in the film), bounce (its number among the
        contacts of its ball in its shot), t (s); spin_source, the source of the spin before the contact (tracked, rolling
        (inferred), sliding (fitted), none); e_n, v_n_out/v_n_in just after the wall, and in flight rebound_height, m, in a vacuum
        above a floor, with their errors; covariance_v_n and covariance_v_t of the errors before and after, m^2/s^2, which fits
        use; of a table also the slips on the floor (velocity less rolling, m/s, with the axes and signs of v_n and v_t)
        with their errors, and the floor as estimated from the film.

    Raises
    ------
    CaromError
        If no contact could be measured, with the most frequent reason.

    Examples
    --------
    >>> import numpy as np
    >>> from carom.tracks import Settings, Track, measure, to_rebounds
    >>> t = np.arange(40) / 200
    >>> y = np.where(t < 0.1, 2 * (0.1 - t), 1.6 * (t - 0.1)) - 9.81 / 2 * (t - 0.1) ** 2
    >>> ball = Track("ball", t, np.stack([0.5 * t, y], axis=-1))
    >>> table = to_rebounds(measure([ball], Settings(view="side", noise=1e-4)))
    >>> table.kind, table["v_n_in"].round(3), table["v_n_out"].round(3)
    ('planar', array([2.]), array([1.6]))
    """
    planar = measured.view == "side" or any(one.planar for one in measured.measured)
    kind: Kind = "planar" if planar else "table"
    spin = "spin" if planar else "spin_z"
    rows: list[dict[str, Any]] = []
    bounces: Counter[tuple[str, str]] = Counter()
    for number, one in enumerate(measured.contacts):
        bounces[one.group, one.track] += 1
        numbers = {"contact": number + 1, "bounce": bounces[one.group, one.track]}
        for name in usable_stages(one, stage, keep_sliding)[0]:
            rows.append(_row(one, numbers, name, spin, measured))  # noqa: PERF401
    if not rows:
        raise CaromError(_nothing(measured, stage, keep_sliding))
    speeds = [f"{side}_{which}" for which in ("in", "out") for side in ("v_n", "v_t", spin)]
    read = (*speeds, *(f"sigma_{name}" for name in speeds))
    columns = {name: np.array([row[name] for row in rows]) for name in read}
    for name in (f"{spin}_in", f"{spin}_out"):
        if np.isnan(columns[name]).all():
            del columns[name], columns[f"sigma_{name}"]
        elif (np.isnan(columns[f"sigma_{name}"]) & ~np.isnan(columns[name])).any():
            # (one value for a flight, with neither an error bar nor a scatter)
            del columns[f"sigma_{name}"]
    extra = {name: np.array([row[name] for row in rows]) for name in rows[0] if name not in (*read, "stage")}
    table = make_rebounds(
        kind, columns, stage=None if planar else [row["stage"] for row in rows], extra=extra, source="tracks"
    )
    return replace(table, notes=(*table.notes, *energy_remarks(table, measured.radius, measured.kappa)))


def first_contacts(rebounds: Rebounds) -> NDArray[np.bool_]:
    """Return which rows (N,) are the first contact of a ball in a film or shot; every row where the table has no such column.

    The column ``bounce`` numbers the contacts of each ball. In a table without it, the first is the one with the lowest number in
    the column ``contact`` of a film, shot and ball.
    """

    def numbers(name: str) -> NDArray[np.float64]:
        return parse_numbers([str(cell) for cell in rebounds.extra[name].tolist()]).values

    every = np.ones(len(rebounds), bool)
    if "bounce" in rebounds.extra:
        return np.asarray(~(numbers("bounce") > 1))
    if "contact" not in rebounds.extra:
        return every
    contact = numbers("contact")
    names = [rebounds.extra[name].astype(str).tolist() for name in ("film", "shot", "ball") if name in rebounds.extra]
    least: dict[tuple[str, ...], float] = {}
    keys = list(zip(*names, strict=True)) if names else [()] * len(rebounds)
    for key, number in zip(keys, contact.tolist(), strict=True):
        least[key] = min(least.get(key, np.inf), number)
    return np.array([not number > least[key] for key, number in zip(keys, contact.tolist(), strict=True)], bool)


def rebound_height(one: TrackContact, gravity: float) -> tuple[float, float]:
    """Return how high a ball rises from a floor, level within 8°, in a vacuum, and the error, m; NaN off another wall."""
    if one.fit is None or not one.planar or one.wall.normal[1] < 0.99:
        return np.nan, np.nan
    return one.fit["vn_out"] ** 2 / (2 * gravity), one.fit["vn_out"] * one.fit.error("vn_out") / gravity


def _row(one: TrackContact, numbers: dict[str, int], stage: str, spin: str, measured: Measured) -> dict[str, Any]:
    fit = one.fit
    assert fit is not None
    out = ("vn_roll", "vt_roll") if stage == "rolling" else ("vn_out", "vt_out")
    ratio, ratio_error = (np.nan, np.nan) if stage == "rolling" else fit.restitution
    row: dict[str, Any] = {
        "shot": one.group, "ball": one.track, "wall": one.wall.name, **numbers, "t": fit["t"],
        "sigma_t": fit.error("t"), "spin_source": _spin_source(one),
        "v_n_in": -fit["vn_in"], "sigma_v_n_in": fit.error("vn_in"),
        "v_t_in": fit["vt_in"], "sigma_v_t_in": fit.error("vt_in"),
        "v_n_out": fit[out[0]], "sigma_v_n_out": fit.error(out[0]),
        "v_t_out": fit[out[1]], "sigma_v_t_out": fit.error(out[1]),
        f"{spin}_in": one.spin.before, f"sigma_{spin}_in": one.spin.before_error,
        f"{spin}_out": one.spin.after, f"sigma_{spin}_out": one.spin.after_error,
        "stage": stage, "e_n": ratio, "sigma_e_n": ratio_error,
        "covariance_v_n": -fit.covariance_of("vn_in", out[0]), "covariance_v_t": fit.covariance_of("vt_in", out[1]),
    }  # fmt: skip
    if one.planar:
        row["rebound_height"], row["sigma_rebound_height"] = rebound_height(one, measured.gravity)
    names = {"v_n_in": "vn_in", "v_t_in": "vt_in", "v_n_out": out[0], "v_t_out": out[1]}
    if one.blind_shift is not None:  # all rows share the error of the blind time
        shift = {name: one.blind_shift.get(inner, 0.0) for name, inner in names.items()}
        shift["v_n_in"] *= -1
        row |= {f"sigma_{name}": float(np.hypot(row[f"sigma_{name}"], change)) for name, change in shift.items()}
        row["covariance_v_n"] += shift["v_n_in"] * shift["v_n_out"]
        row["covariance_v_t"] += shift["v_t_in"] * shift["v_t_out"]
        row |= {f"blind_{name}": change for name, change in shift.items()}
    for prefix, values in fit.shifts.items():  # part of the error bars of the fit already
        shift = {name: float(values[OUTPUTS.index(inner)]) for name, inner in names.items()}
        row |= {f"{prefix}_{name}": -change if name == "v_n_in" else change for name, change in shift.items()}
    if not one.planar:
        for side in ("in", "out"):
            for axis in "nt":
                sign = -1.0 if (axis, side) == ("n", "in") else 1.0
                resolved = fit.resolved(f"u{axis}_{side}")
                row[f"slip_{axis}_{side}"] = sign * fit[f"u{axis}_{side}"] if resolved else np.nan
                row[f"sigma_slip_{axis}_{side}"] = fit.error(f"u{axis}_{side}") if resolved else np.nan
    return row | _floor(one, stage, measured) | _air(one, measured)


def _air(one: TrackContact, measured: Measured) -> dict[str, float]:
    """Return the drag of the air, which rows share where it is the same."""
    if one.fit is None or "drag" not in one.fit.shifts:
        return {}
    return {"drag_per_metre": measured.air.drag_per_metre, "sigma_drag_per_metre": measured.air.drag_error}


def _floor(one: TrackContact, stage: str, measured: Measured) -> dict[str, float]:
    """Return the estimate of the floor, and by how much the velocities change with one standard deviation of it.

    The motion is extrapolated to the contact with these numbers, so rows share their errors, as far as they come from all contacts.
    """
    found: dict[str, float] = {}
    out = ("vn_roll", "vt_roll") if stage == "rolling" else ("vn_out", "vt_out")
    names = {"v_n_in": "vn_in", "v_t_in": "vt_in", "v_n_out": out[0], "v_t_out": out[1]}
    for label, inner, prefix in FLOOR:
        if one.fit is None or one.planar or label not in measured.floor:
            continue
        value, sigma = measured.floor[label]
        found |= {label.replace(" ", "_"): value, f"sigma_{label.replace(' ', '_')}": sigma}
        error, own = sigma * measured.gravity, one.fit.error(inner)
        # (limited: a contact whose prior leaves an outlier out may be more precise than the mean of all)
        part = shared_fraction(own, getattr(one.prior, f"{inner}_error"), getattr(one.prior, f"{inner}_between"))
        share = min(error * part / own**2, 1 / error) if own and error else 0.0
        for name, of in names.items():
            found[f"{prefix}_{name}"] = (-share if name == "v_n_in" else share) * one.fit.covariance_of(of, inner)
    return found


def _spin_source(one: TrackContact) -> str:
    if np.isfinite(one.spin.before):
        return "tracked"
    if one.planar:
        return "none"
    return "sliding (fitted)" if sliding_reason(one) else "rolling (inferred)"


def _nothing(measured: Measured, stage: Stage, keep_sliding: bool) -> str:
    if not measured.contacts:
        walls = ", ".join(wall.name for wall in measured.walls) or "none"
        return (
            f"tracks: expected a contact with a wall, got none (walls: {walls}); give the wall with `wall`, or film until"
            " the ball has left the wall"
        )
    whys: dict[str, int] = {}
    for one in measured.contacts:
        why = usable_stages(one, stage, keep_sliding)[1]
        whys[why] = whys.get(why, 0) + 1
    most = max(whys, key=lambda why: whys[why])
    count = len(measured.contacts)
    return f"tracks: expected a contact that can be measured, got {count} that cannot; {whys[most]} of them: {most}"


# ----------------------------------------------------------------------------------------------------
# Several films: rebounds of each, in one table with a column for the film.


def film_names(paths: Sequence[Path]) -> list[str]:
    """Return a name for each file: the shortest end of its path that no other has, without the suffix where that is unique.

    Examples
    --------
    >>> from pathlib import Path
    >>> film_names([Path("a/one.txt"), Path("a/two.txt")]), film_names([Path("a/one.txt"), Path("b/one.txt")])
    (['one', 'two'], ['a/one.txt', 'b/one.txt'])
    """
    if len({path.stem for path in paths}) == len(paths):
        return [path.stem for path in paths]
    if len({path.name for path in paths}) == len(paths):
        return [path.name for path in paths]
    return [path.as_posix() for path in paths]


def combined_rebounds(tables: Mapping[str, Rebounds]) -> Rebounds:
    """Return the rebounds of several films as one table; the column ``film`` has the names, the keys of ``tables``.

    Raises CaromError if some films are of balls on a table and others of balls in flight.

    Examples
    --------
    >>> from carom.data import make_rebounds
    >>> one = make_rebounds("planar", {"v_n_in": [1.0], "v_n_out": [0.8]})
    >>> two = make_rebounds("planar", {"v_n_in": [2.0], "v_n_out": [1.5]})
    >>> table = combined_rebounds({"a": one, "b": two})
    >>> table["v_n_in"], table.extra["film"]
    (array([1., 2.]), array(['a', 'b'], dtype=object))
    """
    kinds = {table.kind: name for name, table in tables.items()}
    if len(kinds) > 1:
        raise CaromError(
            f"films: expected films of one kind, got a ball on a table in {kinds['table']!r} and a ball in flight in"
            f" {kinds['planar']!r}; `view` above or `view` side says what they are"
        )
    parts = list(tables.values())
    size = {id(table): len(table) for table in parts}
    columns = {name: np.concatenate([table[name] for table in parts]) for name in parts[0].columns}
    for name in parts[0].columns:
        if any(name in table.sigma for table in parts):
            columns[f"sigma_{name}"] = np.concatenate(
                [table.sigma.get(name, np.full(size[id(table)], np.nan)) for table in parts]
            )
    spins = [name for name in parts[0].columns if name.startswith("spin") and np.isnan(columns[name]).all()]
    for name in spins:
        del columns[name]
        columns.pop(f"sigma_{name}", None)
    film = np.array([name for name, table in tables.items() for _ in range(len(table))], dtype=object)
    extra: dict[str, NDArray[Any]] = {"film": film}
    for name in dict.fromkeys(name for table in parts for name in table.extra):
        extra[name] = np.concatenate([table.extra.get(name, np.full(size[id(table)], np.nan)) for table in parts])
    stages = [table.stage for table in parts if table.stage is not None]
    notes = [f"{name}: {note}" for name, table in tables.items() for note in table.notes if note.startswith("energy:")]
    return make_rebounds(
        next(iter(kinds)), columns, stage=np.concatenate(stages) if stages else None, extra=extra,
        rows=[f"{name}, row {i + 1}" for name, table in tables.items() for i in range(len(table))],
        source=f"films {shortened_list(list(tables))}", notes=notes,
    )  # fmt: skip


def hops_together(films: Sequence[Measured], again: Callable[[int, bool], Measured]) -> list[Measured]:
    """Return films of one table with one verdict on hops, if all of them together decide and one film does not.

    ``again(i, hops)`` measures film i anew, with what is known then.
    """
    excess = sum(hop_excess(one) for film in films for one in film.contacts)
    if abs(excess) < DECISIVE or len(films) < 2:
        return list(films)
    verdict = "seen" if excess < 0 else "none"
    return [
        again(i, excess < 0) if any(one.fit is not None and one.hop != verdict for one in film.contacts) else film
        for i, film in enumerate(films)
    ]


def decided_together(films: Sequence[Measured], again: Callable[..., Measured]) -> list[Measured]:
    """Return films of one table with one verdict on hops and on the floor's friction, where all of them together decide.

    ``again(i, slides=...)`` and ``again(i, hops=...)`` measure film i anew, with what is known then.
    """
    excess = [sum(one.friction_excess for one in film.contacts) for film in films]
    if abs(sum(excess)) >= DECISIVE:
        slides = sum(excess) < 0
        films = [again(i, slides=slides) if 0 < abs(excess[i]) < DECISIVE else one for i, one in enumerate(films)]
    return hops_together(films, lambda i, hops: again(i, hops=hops))


def air_together(films: Sequence[Measured]) -> tuple[list[Measured], list[str]]:
    """Return films of one ball with one drag of the air, if their flights agree on it, and a note; else the films as they are."""
    air = joint_air([film.air for film in films])
    if air is None:
        return list(films), []

    def moved(one: TrackContact, film: Measured) -> TrackContact:
        return one if one.fit is None else replace(one, fit=with_other_drag(one.fit, film.air, air))

    found = []
    for film in films:
        contacts = tuple(moved(one, film) for one in film.contacts)
        floor = {name: value for name, value in film.floor.items() if name != "air drag"}
        floor |= {"air drag": WithError(air.drag_per_metre, air.drag_error)} if air.drag_shown else {}
        notes = tuple(note for note in film.notes if not note.startswith("air drag:"))
        own = film.air.with_drag(air.drag_per_metre, air.drag_error)
        found.append(replace(film, contacts=contacts, floor=floor, notes=notes, air=own))
    return found, [
        f"{drag_in_words(air)}, from the flights of all films together, as of one ball; its error is shared by all velocities"
        " (`drag_per_metre` gives k, 0 for none)"
    ]


# ----------------------------------------------------------------------------------------------------
# Films to one measurement and one table: track files are read, measured with what they share, and their rebounds joined.


# Of carom.track_film
FILM_ARGUMENTS = (
    "balls", "length", "readout", "ball", "colour", "region", "corners", "picture_height", "marks", "start", "end",
)  # fmt: skip
START_BYTES = 4096  # in which the header of a table shows
REBOUND_COLUMNS = (
    "v_n_in, v_t_in, v_n_out, v_t_out (m/s, toward the wall, along it, away from it, along it), and spin_in, spin_out if they were"
    " measured (rad/s)"
)


@dataclass(frozen=True, eq=False)
class MeasuredFilms:
    """Films that were measured together; made by :func:`measure_films`."""

    files: tuple[TrackFile, ...]
    measured: tuple[Measured, ...]
    """The contacts of each."""
    joint_notes: tuple[str, ...] = ()
    """On what was measured from all films together."""

    def __repr__(self) -> str:
        """Return one line: the number of films, and of contacts."""
        contacts = sum(len(one.contacts) for one in self.measured)
        return f"<{type(self).__name__}: {counted(len(self.files), 'film')}, {counted(contacts, 'contact')}>"

    @property
    def names(self) -> list[str]:
        """A name for each film; empty for a single one."""
        return film_names([film.path for film in self.files]) if len(self.files) > 1 else [""]

    @property
    def notes(self) -> list[str]:
        """Notes of reading and of measuring, beginning with the film's name where there are several."""
        return [*self.reading_notes, *self._by_film([one.notes for one in self.measured]), *self.joint_notes]

    @property
    def reading_notes(self) -> list[str]:
        """Notes of reading alone."""
        return self._by_film([film.notes for film in self.files])

    def _by_film(self, notes: Sequence[Sequence[str]]) -> list[str]:
        return [
            f"{name}: {note}" if name else note for name, own in zip(self.names, notes, strict=True) for note in own
        ]

    @functools.cached_property
    def pairs(self) -> tuple[tuple[PairContact, ...], ...]:
        """The contacts of balls with each other in each film, as :func:`carom.tracks.measure_pairs` returns them."""
        return tuple(measure_pairs(one) for one in self.measured)

    def tables(self, stage: Stage = "best", *, keep_sliding: bool = False, balls: bool = False) -> dict[str, Rebounds]:
        """Return the rebounds of each film that has some, by its name. Raises CaromError, with a line per film, if none has."""
        faults = FaultList()
        tables: dict[str, Rebounds] = {}
        pairs = self.pairs if balls else ((),) * len(self.measured)
        for name, one, met in zip(self.names, self.measured, pairs, strict=True):
            with collected(faults):
                tables[name] = (
                    pair_rebounds(met, one.radius or 0.0)
                    if balls
                    else to_rebounds(one, stage, keep_sliding=keep_sliding)
                )
        if not tables:
            faults.raise_if_any()
        return tables

    def rebounds(self, stage: Stage = "best", *, keep_sliding: bool = False, balls: bool = False) -> Rebounds:
        """Return the rebounds of all films as one table, as :func:`carom.tracks.to_rebounds` does, with the notes of all steps; of
        several films, with a column film.

        With ``balls`` those of balls off each other, as :func:`carom.tracks.pair_rebounds` does. Raises CaromError, with a line per
        film, if none has a contact that can be measured.
        """
        notes, count = self.notes, len(self.files)
        with noting(notes):
            tables = self.tables(stage, keep_sliding=keep_sliding, balls=balls)
            rebounds = combined_rebounds(tables) if count > 1 else next(iter(tables.values()))
        notes.append(f"{counted(len(rebounds), 'rebound')} measured (carom tracks shows them)")
        if count > len(tables):
            notes.append(f"{count - len(tables)} of {count} films have no contact that can be measured")
        source = rebounds.source if count > 1 else str(self.files[0].path)
        return replace(rebounds, source=source, notes=(*notes, *rebounds.notes))


def read_films(files: Any, calibration: Calibration | None = None, format: str | None = None) -> tuple[TrackFile, ...]:  # noqa: A002
    """Return the tracks in films as :func:`measure_tracks` takes them. Raises CaromError with the faults of all of them."""
    several = isinstance(files, list | tuple) and not all(isinstance(one, Track) for one in files)
    faults, found = FaultList(), list[TrackFile]()
    for number, one in enumerate(files if several else [files], 1):
        with collected(faults):
            found.append(film_of(one, number, calibration, format))
    faults.raise_if_any()
    return tuple(found)


def measure_films(
    files: Any,
    calibration: Calibration | None = None,
    settings: Settings | None = None,
    *,
    format: str | None = None,  # noqa: A002
    wall: Sequence[str] = (),
    progress: Progress | None = None,
) -> MeasuredFilms:
    """Read films of one table or of one kind of throw, and measure the contacts in each.

    Parameters
    ----------
    files
        As for :func:`measure_tracks`; also those that were read before.
    calibration : Calibration, optional
        Scale and frame rate of all of them, if the files lack these.
    settings : Settings, optional
        Prior knowledge, of all films.
    format : str, optional
        A key of FORMATS; by default the format is recognised from the content.
    wall : sequence of str
        Lines at which the balls' centres are reflected, ``"x=0.03"``, ``"y=1.4"`` or ``"x1,y1,x2,y2"`` (m). Default: found.
    progress : callable(done, total, text), optional

    Returns
    -------
    MeasuredFilms
        Whether balls hop, and whether the floor has friction, all films together decide where they do.

    Raises
    ------
    CaromError
        With the faults of all files; for settings as :func:`carom.tracks.measure`, with the notes of reading.
    """
    settings = settings or Settings()
    found = read_films(files, replace(calibration or Calibration(), view=settings.view), format)
    walls = [tuple(wall_of_text(text, film.tracks) for text in wall) or settings.walls for film in found]
    known = [replace(settings, walls=lines) for lines in walls]

    def once(number: int, **verdict: Any) -> Measured:
        def told(done: int, total: int) -> None:
            if progress is not None:
                progress(number + done / max(total, 1), len(found), "contacts")

        known[number] = replace(known[number], **verdict)
        return measure(found[number].tracks, known[number], told)

    with noting(MeasuredFilms(found, ()).reading_notes):
        films, notes = air_together(decided_together([once(i) for i in range(len(found))], once))
    return MeasuredFilms(found, tuple(films), tuple(notes))


def measure_tracks(
    files: str | Path | Any,
    *,
    format: str | None = None,  # noqa: A002
    scale: float | str | None = None,
    rate: float | None = None,
    down: bool | None = None,
    view: str | None = None,
    radius: float | None = None,
    inertia: str | float = "solid",
    wall: Sequence[str] = (),
    hard: bool = False,
    floor_friction: float | None = None,
    rolling_resistance: float | None = None,
    gravity: float = GRAVITY,
    drag_per_metre: float | None = None,
    noise: float | None = None,
    window: float = WINDOW,
    blind: float | None = None,
    film: Mapping[str, Any] | None = None,
    progress: Progress | None = None,
) -> MeasuredFilms:
    """Measure the contacts in films: ``carom tracks show``, with the names and defaults of its options.

    Parameters
    ----------
    files : path, columns or Track, or a sequence of these
        Films of one table, or of one kind of throw: films, which carom tracks itself; track files; what :func:`carom.track_film`
        returns; tables in memory (a dict of arrays, a DataFrame, a structured array) with the columns of such a file, ``t``, ``x``,
        ``y``, and ``ball`` where there are several; or :class:`Track`. A list of Track is one film.
    format : str, optional
        Format of the files, such as tracker or kinovea; a wrong name is answered with all. Default: by their content.
    scale : float or str, optional
        Metres per unit of the file, 0.0005 or 0.5mm; of a film also gravity.
    rate : float, optional
        Frames per second; overrides the times of the file. Default: from the times.
    down : bool, optional
        The second axis points down, as in images.
    view : str, optional
        Filmed from "above" (balls on a table) or the "side" (balls in flight). Default: by the motion.
    radius : float, optional
        Radius, m; needed where several balls are filmed; 0: they cannot meet.
    inertia : str or float
        "solid", "hollow" or I/(m a^2).
    wall : sequence of str
        Line at which the balls' centres are reflected: x=0.03, y=1.4 or x1,y1,x2,y2 (m). Default: found.
    hard : bool
        The wall is rigid: both motions meet on its line.
    floor_friction : float, optional
        Coulomb friction of the floor. Default: fitted.
    rolling_resistance : float, optional
        Deceleration / g of a rolling ball. Default: fitted.
    gravity : float
        Gravity, m/s^2.
    drag_per_metre : float, optional
        Air drag k, 1/m: it slows a ball of speed v down by k v^2. Default: from the flights.
    noise : float, optional
        Error of one coordinate in one frame, m. Default: estimated.
    window : float
        Time fitted before and after a contact, s.
    blind : float, optional
        Time excluded before and after a contact, s. Default: from the frames.
    film : mapping, optional
        Further arguments of :func:`carom.track_film`, such as ``{"length": "102,655,1180,650=1m"}``.
    progress : callable(done, total, text), optional

    Returns
    -------
    MeasuredFilms
        ``found.rebounds()`` is their table, which :func:`carom.fit` and :func:`carom.predict` take.

    Raises
    ------
    CaromError
        With the faults of all arguments, or of all files.

    Examples
    --------
    >>> import carom, numpy as np
    >>> t = np.arange(0.0, 0.6, 0.01)
    >>> x = np.where(t < 0.3, 0.6 - 2 * t, 1.5 * (t - 0.3))
    >>> found = carom.measure_tracks({"t [s]": t, "x [m]": x, "y [m]": 0.1 + t}, view="above", radius=0.03, noise=1e-4)
    >>> found
    <MeasuredFilms: 1 film, 1 contact>
    """
    kappa = check_tracks(inertia, view)
    asked = {"hard": hard, "floor_friction": floor_friction, "rolling_resistance": rolling_resistance, "gravity": gravity,
             "drag_per_metre": drag_per_metre, "noise": noise, "window": window, "blind": blind, "down": down}  # fmt: skip
    calibration, numbers, _how = film_options(scale, rate, radius, {**(film or {}), **asked})
    settings = Settings(radius=radius, kappa=kappa, view=view, **numbers)  # type: ignore[arg-type]
    return measure_films(files, calibration, settings, format=format, wall=wall, progress=progress)


def check_tracks(inertia: str | float = "solid", view: str | None = None, **_others: Any) -> float | None:
    """Return kappa; CaromError for arguments of :func:`measure_tracks` that are refused before a file is read."""
    faults = FaultList()
    kappa: float | None = faults.attempt(inertia_number, inertia)
    if view not in (None, "above", "side"):
        faults.add("`view`", "one of above, side", repr(view))
    faults.raise_if_any()
    return kappa


OF_SETTINGS = ("hard", "floor_friction", "rolling_resistance", "gravity", "drag_per_metre", "noise", "window", "blind")


class FilmOptions(NamedTuple):
    """What is known of films, by who asks for it."""

    calibration: Calibration
    settings: dict[str, Any]
    """Of :class:`carom.tracks.Settings`."""
    how: dict[str, Any]
    """Of :func:`measure_films`: format and walls."""


def film_options(
    scale: float | str | None, rate: float | None, radius: float | None, more: Mapping[str, Any] | None
) -> FilmOptions:
    """Sort what is known of films: arguments of :func:`measure_tracks` and of :func:`carom.track_film` in ``more``.

    Raises CaromError for names that neither has.
    """
    given = {name: value for name, value in (more or {}).items() if value is not None}
    settings = {name: given.pop(name) for name in OF_SETTINGS if name in given}
    how: dict[str, Any] = {name: given.pop(name) for name in ("format", "wall") if name in given}
    down = given.pop("down", None)
    faults, known = FaultList(), (*OF_SETTINGS, "format", "wall", "down", *FILM_ARGUMENTS)
    for name in given.keys() - set(FILM_ARGUMENTS):
        faults.add("`film`", f"arguments of films: {', '.join(known)}", repr(name), suggestion(name, known))
    faults.raise_if_any()
    film = {"radius": radius or None, "gravity": settings.get("gravity", GRAVITY), **given}
    if isinstance(scale, str):
        film["scale"] = scale
    return FilmOptions(Calibration(None if isinstance(scale, str) else scale, rate, down, film=film), settings, how)


def tracks_of_films(
    files: Any, calibration: Calibration | None = None, where: Where = ()
) -> tuple[list[Track], list[str]]:
    """Return the tracks in films of one table, as :func:`measure_tracks` takes them, and notes of reading, for fits of whole tracks
    and shots: each film is a shot, or has several.

    ``where``: the tracks that enter, ``"shot=NAME"`` or ``"ball=NAME"``. Raises CaromError where no track has such a name.
    """
    films, tracks, said = MeasuredFilms(read_films(files, calibration), ()), list[Track](), list[str]()
    for name, film in zip(films.names, films.files, strict=True):
        for track in film.tracks:
            tracks.append(replace(track, group=f"{name} {track.group}".strip()))
            said.append(": ".join(filter(None, (name, f"{track.group} {track.name}".strip()))) + ": ")
    names = {"shot": [one.group for one in tracks], "ball": [one.name for one in tracks]}
    with noting(films.reading_notes):
        chosen = rows_where(names, where, len(tracks), "the name of a shot or ball").tolist()
    left_out = tuple(start for start, keep in zip(said, chosen, strict=True) if not keep)
    notes = [note for note in films.reading_notes if not note.startswith(left_out)]
    return [track for track, keep in zip(tracks, chosen, strict=True) if keep], notes


def are_films(paths: Sequence[Path]) -> bool:
    """Return whether files are films, not a table of rebounds. Raises CaromError where tables are among several files."""
    faults = FaultList()
    for path in paths if len(paths) > 1 else ():
        with collected(faults):
            if not path.exists():
                raise CaromError(f"{path}: expected a file, got none of that name")
            if not is_track(path):
                raise CaromError(
                    f"{path}: expected a track, as several files are given, got a table of rebounds; join tables to one"
                )
    faults.raise_if_any()
    return len(paths) > 1 or is_track(paths[0])


def is_track(path: Path) -> bool:
    """Return whether a file is a track: a film, or no column of a rebound. Raises CaromError for a file that is not text."""
    if is_film(path):
        return True
    if path.suffix.lower() in (".parquet", ".pq") or path.is_dir() or not path.exists():
        return False
    with open_regular(path) as opened:
        raw = opened.read(START_BYTES)
    wanted = f"{path}: expected a table of rebounds or a track, as text"
    if not raw.strip():
        raise CaromError(f"{wanted}, got an empty file")
    require_text(path, "a table of rebounds or a track")
    codec = text_encoding(raw).codec
    if b"\0" in raw and codec == "utf-8":
        raise CaromError(f"{wanted}, got bytes that are not text; export it as CSV from the program that made it")
    text = raw.decode(codec, errors="replace")
    if is_table_of_rebounds(text):
        return False
    whole = track_text(path)
    if format_of(whole) is None:
        raise CaromError(
            f"{wanted}, {got_instead(whole)}; a table of rebounds has the columns {REBOUND_COLUMNS}; a track is like"
            f" {HEADER_EXAMPLE!r} (carom tracks show)"
        )
    return True


def columns_of_tracks(tracks: Sequence[Track], names: Sequence[str] = ("x", "y", "z")) -> Columns:
    """Return the rows of tracks as columns: times, balls, and the coordinates that they have, with these names."""
    balls = np.concatenate([np.full(len(track), track.name) for track in tracks])
    found: Columns = {"t": np.concatenate([track.time for track in tracks]), "ball": balls}
    return found | dict(zip(names, np.concatenate([track.position for track in tracks]).T, strict=False))


def columns_of_file(path: Path, columns: Columns, notes: list[str], known: Calibration) -> Columns:
    """Return the columns of a file that a tracking program wrote, with headers that have units, too."""
    try:
        file = film_of(path, 1, known)
    except CaromError:
        if {"t", "x"} <= set(columns) or not columns:
            raise
        return columns
    notes += [
        note for note in file.notes if "assumed" in note or note.startswith(("not used", "column ", "times "))
    ]  # (others are on rebounds)
    side = file.tracks[0].position.shape[1] == 2 and any(
        "height" in name.lower() or name.lower()[:1] == "z" for name in columns
    )
    found = columns_of_tracks(file.tracks, ("x", "z") if side else ("x", "y", "z"))
    return {"y": np.zeros(len(found["t"]))} | found
