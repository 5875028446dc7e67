"""Laws fitted to files, arrays and films: ``carom fit``, in Python ``carom.fit``."""

from __future__ import annotations

import inspect
import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any, NamedTuple

import numpy as np

from carom.bodies import inertia_number
from carom.data.columns import as_rebounds, is_columns
from carom.data.published import published_at
from carom.data.rebound_files import read_rebounds
from carom.data.rebounds import KINDS, STAGES, Rebounds
from carom.data.where import Where
from carom.errors import CaromError, Fault, FaultList, noting, suggestion
from carom.files import as_path, cannot_write, require_library, write_text
from carom.fitting.laws import ALONG, INDEX, unknown_laws
from carom.fitting.ranking import Ranking, RankingsBy, fit_by, fit_laws
from carom.fitting.rows import FORM_PARAMETERS, Setting, require_error_bars, require_settings, spin_of_rows
from carom.fitting.shots.fit import fit_shots
from carom.fitting.shots.result import FREE, ShotsRanking
from carom.fitting.tracks.fit import TrackRanking, fit_tracks
from carom.public.defaults import CONTACTS
from carom.public.progress import Progress
from carom.scene.scene import Scene
from carom.scene.toml import load_scene
from carom.simulation.simulate import simulate
from carom.tracks.contact import Settings
from carom.tracks.films import (
    FilmOptions,
    MeasuredFilms,
    are_films,
    film_options,
    is_track,
    measure_films,
    tracks_of_films,
)
from carom.tracks.formats.tables import Calibration
from carom.tracks.measurement import measure

TRACK_NUMBERS = ("rolling_resistance", "spin_loss", "wall_left", "wall_right", "wall_bottom", "wall_top")
"""Parameters of whole tracks that a table of rebounds does not have."""
OF_CONTACTS = (
    "sigma_v", "sigma_spin", "bootstrap", "profiles", "every_contact", "by", "kind", "stage", "seed", "robust",
    "forms", "scatter", "balls", "roll",
)  # fmt: skip
OF_FRAMES = ("noise", "contacts")
OF_SHOTS = (
    "files", "radius", "laws", "fit", "fix", "bound", "rate", "scale", "where", "seed", "shot", "table", "progress",
)  # fmt: skip
OF_FILMS = ("scale", "rate", "view", "balls", "film")
OF_TABLES = ("contact_height", "floor_friction", "floor_restitution", "roll")
MEASURING = 0.4  # of the progress, until all contacts are measured


def fit(
    files: str | Path | Sequence[str | Path] | Rebounds | MeasuredFilms | Any,
    radius: float | None = None,
    *,
    inertia: str | float | None = None,
    laws: str | Sequence[str] | None = None,
    restitution: float | str = "constant",
    friction: float | str = "constant",
    tangential_restitution: float | str = "constant",
    stiffness_ratio: float | str = "constant",
    forms: bool = False,
    fit: Sequence[str] = (),
    fix: Mapping[str, float] | None = None,
    bound: Mapping[str, tuple[float, float]] | None = None,
    robust: bool = False,
    contact_height: float | None = None,
    floor_friction: float | None = None,
    floor_restitution: float = 0.0,
    roll: float = 1.0,
    kind: str | None = None,
    stage: str | None = None,
    rate: float | None = None,
    scale: float | str | None = None,
    view: str | None = None,
    balls: bool = False,
    film: Mapping[str, Any] | None = None,
    whole: bool = False,
    contacts: int = CONTACTS,
    shot: bool = False,
    table: str | Path | Scene | None = None,
    noise: float | None = None,
    where: Where = (),
    by: str | None = None,
    sigma_v: float | None = None,
    sigma_spin: float | None = None,
    spin: float | str | None = None,
    every_contact: bool = False,
    scatter: str | None = None,
    bootstrap: int | None = None,
    profiles: bool | None = None,
    seed: int | None = None,
    progress: Progress | None = None,
) -> Ranking | TrackRanking | ShotsRanking | RankingsBy:
    """Fit the laws of impact to measured rebounds, whole tracks or whole shots: ``carom fit``, for files and for arrays.

    Parameters
    ----------
    files : path, sequence of paths, columns, Rebounds, or films that were measured
        A table of rebounds, one or more track files or films, or the name of a published set; or a dict of arrays, a DataFrame, a
        structured array with the columns of such a table; or what :func:`carom.measure_tracks` returns.
    radius : float, optional
        Radius, m. Default: the radius of a set that comes with carom; rebounds straight up need none.
    inertia : str or float, optional
        "solid", "hollow" or I/(m a^2). Default: solid.
    laws : str or sequence of str, optional
        Fit only these laws. Default: all laws for this kind of rebound.
    restitution : float or str
        Coefficient of restitution, held; or its form that is fitted: constant, line, polynomial, power, viscoelastic, exponential.
    friction : float or str
        Friction coefficient, held; or its form: constant, or linear or exponential in the slip, or in v_n, slip/v_n, speed after a
        colon.
    tangential_restitution : float or str
        Tangential restitution, held; or its form: constant, linear or exponential, by default in slip/v_n.
    stiffness_ratio : float or str
        Stiffness ratio, held; or its form: constant, linear or exponential, by default in slip/v_n.
    forms : bool
        Choose a form or a spline for each parameter of the best law, and the tails of errors, by rows held out.
    fit : sequence of str
        Fit this as well: kappa, contact_height, floor_friction, roll.
    fix : mapping, optional
        Hold a parameter of the laws at a value.
    bound : mapping, optional
        Bounds of a fitted parameter.
    robust : bool
        Assume errors with heavy tails (Student's t).
    contact_height : float, optional
        Height of the contact above the floor, in ball radii; billiard cushions: 1.25 to 1.4. Default: 1.
    floor_friction : float, optional
        Friction of the floor. Default: that of the film, else 0.2.
    floor_restitution : float
        Restitution at the floor, 0 to 1.
    roll : float
        Spin before the wall, in units of a rolling ball's spin: 1 rolling, 0 without spin.
    kind : str, optional
        "planar" (ball in flight) or "table" (ball on a table). Default: by the columns.
    stage : str, optional
        Stage of all rows: after_wall or rolling.
    rate : float, optional
        Frames per second; overrides the times of the file. Default: from the times.
    scale : float or str, optional
        Metres per unit of the file, 0.0005 or 0.5mm; of a film also gravity.
    view : str, optional
        Filmed from "above" (balls on a table) or the "side" (balls in flight). Default: by the motion.
    balls : bool
        Measure balls that strike balls at rest, not balls at walls.
    film : mapping, optional
        Further arguments of :func:`carom.measure_tracks` and :func:`carom.track_film`, such as ``{"down": True}``.
    whole : bool
        Fit whole tracks, each simulated from its own initial state, instead of contacts.
    contacts : int
        With ``whole``: largest number of contacts followed per ball.
    shot : bool
        Fit whole shots from the stroke to rest, all balls and cushions (:func:`carom.fit_shots`); ``fit``, ``fix`` and ``bound``
        take paths of a scene.
    table : path or Scene, optional
        With ``shot``: the table with which the fit begins. Default: a carom table between the cushions of the films.
    noise : float, optional
        With ``whole``: error of one coordinate in one frame, m. Default: estimated.
    where : optional
        Use only rows with this value in the column.
    by : str, optional
        Fit the rows of each value of this column, such as surface.
    sigma_v : float, optional
        Standard error of speeds, m/s. Default: of the table.
    sigma_spin : float, optional
        Standard error of spins, rad/s. Default: of the table.
    spin : float or str, optional
        Unmeasured spins before the wall: rad/s at the first contact of each ball (0: thrown without spin), or a prior: normal,
        normal:WIDTH, uniform:WIDTH (in v/a, about 0). Default: normal, mean along v_t and width fitted.
    every_contact : bool
        Take unmeasured spins of a ball's later contacts as independent; by default each contact sets the next one's.
    scatter : str, optional
        Fit what contacts scatter beyond the error bars: "share" of the speed before the wall, or "absolute", m/s. Default: none.
    bootstrap : int, optional
        Number of bootstrap fits. Default: 200 where quick.
    profiles : bool, optional
        Compute intervals by profile likelihood. Default: where quick.
    seed : int, optional
        Seed of the bootstrap. Default: 0.
    progress : callable(done, total, text), optional

    Returns
    -------
    Ranking, with ``whole`` TrackRanking, with ``shot`` ShotsRanking, with ``by`` a RankingsBy: a Ranking for each value

    Raises
    ------
    CaromError
        One line per problem.

    Examples
    --------
    >>> import carom
    >>> v = [1.0, 2.0, 3.0, 4.0]
    >>> columns = {"v_n_in": v, "v_t_in": v, "spin_in": [0.0] * 4, "v_n_out": [0.81, 1.59, 2.42, 3.18],
    ...            "v_t_out": [0.71, 1.43, 2.15, 2.85], "sigma_v_n_out": 0.02, "sigma_v_t_out": 0.02}
    >>> carom.fit(columns, 0.02, laws=["sticking", "mirror"], bootstrap=0).best.law.name
    'sticking'
    """
    options = SimpleNamespace(**locals())
    require_library("scipy", "fit")
    if shot:
        return _fit_shot(options)
    if table is not None:
        raise CaromError("`table`: expected `shot` as well, which fits whole shots on a table; omit it")
    ready = _checked(options)
    known = film_options(scale, rate, ready.setting.radius, film)
    if whole:
        return _fit_whole(ready, known.calibration, where, progress)
    if not ready.films:
        _require_effect(options, OF_FILMS, "a track", "rebounds")
    rebounds = _rebounds(ready, known, kind, stage, view, balls, progress)
    if rebounds.kind == "planar":
        _require_effect(options, OF_TABLES, "rebounds of a ball on a table", "planar ones")
    how: dict[str, Any] = {
        "where": where, "sigma_v": sigma_v, "sigma_spin": sigma_spin, "spin": spin, "every_contact": every_contact,
        "profiles": profiles, "bootstrap": bootstrap, "seed": seed or 0, "progress": progress,
    }  # fmt: skip
    if by is not None:
        return fit_by(rebounds, ready.setting, ready.laws or None, by, forms=forms, **how)
    shifted = ready.published.shifted if ready.published else ()
    ranking = fit_laws(rebounds, ready.setting, ready.laws or None, shifted=shifted, **how)
    return ranking.with_forms(progress) if forms else ranking


def check_fit(**options: Any) -> None:
    """Raise CaromError, one line per problem, for arguments of :func:`fit` that it refuses before it reads the data."""
    bound = inspect.signature(fit).bind(**options)
    bound.apply_defaults()
    asked = SimpleNamespace(**bound.arguments)
    (_check_shot if asked.shot else _checked)(asked)


def _defaults() -> dict[str, Any]:
    return {name: one.default for name, one in inspect.signature(fit).parameters.items()}


class _Request(NamedTuple):
    """Validated arguments of a fit."""

    paths: list[Path]
    data: Any
    """A table or films in memory; None for files."""
    published: Any
    films: bool
    laws: list[str]
    setting: Setting


def _checked(asked: SimpleNamespace) -> _Request:
    """Return validated arguments of :func:`fit`; CaromError with all problems that can be found before the data are read."""
    faults = FaultList()
    memory = isinstance(asked.files, Rebounds | MeasuredFilms) or is_columns(asked.files)
    several = isinstance(asked.files, list | tuple)
    paths = [] if memory else [as_path("fit", one) for one in (asked.files if several else [asked.files])]
    if not memory and not paths:
        raise CaromError("fit: files: expected a table of rebounds, or track files, got none")
    films: bool | None = isinstance(asked.files, MeasuredFilms)
    if paths and not asked.whole:  # (of whole tracks every file is looked at below)
        films = faults.attempt(are_films, paths)
    kappa = None if asked.inertia is None else faults.attempt(inertia_number, asked.inertia)
    prior = faults.attempt(_prior, asked.spin, asked.whole) or {}
    forms = {name: getattr(asked, name) for name in ("restitution", *ALONG)}
    held = {name: number for name, given in forms.items() if (number := _number(given)) is not None}
    fixed, bounds = {**held, **(asked.fix or {})}, dict(asked.bound or {})
    for name in held.keys() & {*(asked.fix or {}), *bounds}:
        faults.add(
            f"`{name}`", "a form beside `fix` or `bound` of the same parameter", f"{held[name]:g}", "give one of them"
        )
    strange = [*_strange_parameters("fix", fixed, asked.whole), *_strange_parameters("bound", bounds, asked.whole)]
    faults += strange
    if strange:  # (said once)
        fixed, bounds = {}, {}
    faults.attempt(require_error_bars, asked.sigma_v, asked.sigma_spin)
    unused = _given(asked, OF_CONTACTS if asked.whole else OF_FRAMES)
    wanted = "no `whole`, which fits frames instead of contacts" if asked.whole else "`whole` as well"
    faults += [Fault("", f"`{name}`", wanted, advice="omit it") for name in unused]
    names = [asked.laws] if isinstance(asked.laws, str) else list(asked.laws or [])
    faults += _strange_words(asked, names)
    before = FaultList()
    ours = before.attempt(published_at, paths[0]) if paths else None
    if asked.radius is None and ours is None and not before and (films or asked.whole or _has_size(asked, paths)):
        faults.add("`radius`", "the ball's radius in m", "none", "a table-tennis ball has `radius` 0.02")
    given = {"kappa": kappa} | {name: getattr(asked, name) for name in ("radius", "contact_height", "floor_friction")}
    ball = {"radius": 1.0} | (ours.setting if ours else {}) | {k: x for k, x in given.items() if x is not None}
    of_whole: dict[str, Any] = {"noise": asked.noise, "contacts": asked.contacts} if asked.whole else {}
    setting = Setting(
        **ball, **forms | dict.fromkeys(held, "constant"), floor_restitution=asked.floor_restitution, roll=asked.roll,
        **prior, fixed=fixed, bounds=bounds, fit=tuple(asked.fit), robust=asked.robust, scatter=asked.scatter or "",
        **of_whole,
    )  # fmt: skip
    faults.attempt(require_settings, setting, whole=asked.whole, held=held)
    if asked.whole:
        for path in paths:
            if path.is_file() and faults.attempt(is_track, path) is False:
                faults.add(str(path), "a track with `whole`", "a table of rebounds", "omit `whole`")
        if memory:
            faults.append(Fault("fit", "files", "track files with `whole`", type(asked.files).__name__))
        if asked.view == "side":
            faults.add("`view`", "above with `whole` (balls on a table)", "side")
        before.clear()
    # (before contacts are measured, which takes time)
    if before or (faults and (ours or films or asked.whole or memory)):
        raise CaromError(*faults, *before)
    if faults:  # (with those of the table)
        if films is not None:
            kind, stage = (
                given if given in known else None for given, known in ((asked.kind, KINDS), (asked.stage, STAGES))
            )
            faults.attempt(read_rebounds, paths[0], kind=kind, stage=stage)
        raise CaromError(*faults)
    return _Request(paths, asked.files if memory else None, ours, bool(films), names, setting)


def _has_size(asked: SimpleNamespace, paths: Sequence[Path]) -> bool:
    """Whether rebounds depend on the ball's radius: something moves along the wall, or turns."""
    found = FaultList().attempt(read_rebounds, *paths[:1], kind=asked.kind, stage=asked.stage) if paths else None
    return found is None or any(np.nan_to_num(x).any() for name, x in found.columns.items() if "v_n" not in name)


def _prior(spin: float | str | None, whole: bool) -> dict[str, Any]:
    name = "normal" if spin is None else str(spin).partition(":")[0]
    if whole and name != "normal":
        raise CaromError(
            f"`spin`: expected normal:WIDTH (in v/a) with `whole`, got {spin!r}; the spin of each track is fitted"
        )
    return spin_of_rows(spin)[1]


def _number(given: float | str) -> float | None:
    """Return a number, or a text that is one; None for the name of a form."""
    try:
        return float(given.replace(",", ".") if isinstance(given, str) else given)
    except (TypeError, ValueError):  # (what is neither is refused as a form)
        return None


def _strange_parameters(argument: str, given: Mapping[str, Any], whole: bool) -> FaultList:
    """Return faults of names that no law has as a parameter, and of values that are no numbers."""
    forms = (one.name for one in FORM_PARAMETERS)
    known = sorted({*INDEX, *forms, *(TRACK_NUMBERS if whole else ())})
    faults = FaultList(f"`{argument}`")
    for name, value in given.items():
        ends = value if argument == "bound" and isinstance(value, tuple | list) else [value]
        good = all(isinstance(x, int | float) and not isinstance(x, bool) and not math.isnan(x) for x in ends)
        if name not in known:
            faults.add("", "a parameter of a law", repr(name), suggestion(name, known))
        elif not good or (argument == "bound" and not (len(ends) == 2 and ends[0] < ends[1])):
            what = "LOW:HIGH, LOW below HIGH" if argument == "bound" else "a number"
            faults.add(name, what, repr(value))
    return faults


def _strange_words(asked: SimpleNamespace, names: list[str]) -> FaultList:
    """Return the faults of invalid arguments, as far as these do not depend on the data; ``names``: of the laws."""
    faults = FaultList()
    faults += [replace(fault, where="`laws`") for fault in unknown_laws(names)]
    if asked.laws is not None and not names:
        faults.add("`laws`", "names of laws", "none", "omit it to fit all laws")
    if asked.seed is not None and asked.seed < 0:
        faults.add("`seed`", "a whole number >= 0", str(asked.seed))
    if asked.view not in (None, "above", "side"):
        faults.add("`view`", "above (a ball on a table) or side (a ball in flight)", repr(asked.view))
    if asked.whole:  # (not used)
        return faults
    if asked.kind not in (None, *KINDS):
        faults.add("`kind`", "planar or table", repr(asked.kind))
    if asked.stage not in (None, *STAGES):
        faults.add("`stage`", "after_wall or rolling", repr(asked.stage))
    if asked.bootstrap is not None and (asked.bootstrap < 0 or asked.bootstrap == 1):
        faults.add("`bootstrap`", "0 (none) or a number of draws, 2 or more", str(asked.bootstrap))
    return faults


def _rebounds(
    ready: _Request, known: FilmOptions, kind: Any, stage: Any, view: Any, balls: bool, progress: Progress | None
) -> Rebounds:
    if ready.published is not None:
        return ready.published.rebounds  # type: ignore[no-any-return]
    if isinstance(ready.data, MeasuredFilms):
        return ready.data.rebounds(stage or "best", balls=balls)
    if ready.data is not None:
        return as_rebounds(ready.data, kind, stage, (ready.setting.radius, ready.setting.kappa))
    radius, kappa = ready.setting.radius, ready.setting.kappa
    if not ready.films:
        return read_rebounds(ready.paths[0], kind=kind, stage=stage, ball=(radius, kappa))
    about = Settings(radius=radius, kappa=kappa, view=view, **known.settings)
    films = measure_films(ready.paths, known.calibration, about, progress=progress, **known.how)
    return films.rebounds(stage or "best", balls=balls)


def _given(asked: SimpleNamespace, names: Sequence[str]) -> list[str]:
    """Return the arguments of :func:`fit` that were given, of some."""
    defaults = _defaults()
    return [name for name in names if getattr(asked, name) not in (defaults[name], "")]


def _check_shot(asked: SimpleNamespace) -> None:
    """Raise CaromError, one line per problem, for arguments without effect on whole shots, and without a radius."""
    faults = FaultList()
    for name in _given(asked, [name for name in _defaults() if name not in OF_SHOTS]):
        faults.add("", "", advice=f"`{name}` has no effect with `shot`, which fits whole shots; omit it")
    if asked.radius is None and asked.table is None:
        faults.add("`radius`", "the balls' radius in m", "none", "a carom ball has `radius` 0.03075")
    faults.raise_if_any()


def _fit_shot(asked: SimpleNamespace) -> ShotsRanking:
    _check_shot(asked)
    table = load_scene(asked.table) if isinstance(asked.table, str | Path) else asked.table
    if table is not None and not isinstance(table, Scene):
        raise CaromError(f"`table`: expected a scene, or its file, got {type(table).__name__}")
    return fit_shots(
        asked.files, table, asked.radius, laws=asked.laws or None, free=(*FREE, *asked.fit), fix=asked.fix, bound=asked.bound,
        rate=asked.rate, scale=asked.scale, where=asked.where, seed=asked.seed or 0, progress=asked.progress,
    )  # fmt: skip


def _require_effect(asked: SimpleNamespace, names: Sequence[str], expected: str, got: str) -> None:
    """Raise CaromError for arguments that were given and apply to other data alone."""
    faults = FaultList()
    for name in _given(asked, names):
        faults.add(f"`{name}`", expected, got, "omit it")
    faults.raise_if_any()


def _fit_whole(ready: _Request, film: Calibration, where: Where, progress: Progress | None) -> TrackRanking:
    setting = ready.setting

    def tell(share: float, text: str) -> None:
        if progress is not None:
            progress(share, 1.0, text)

    about = Settings(radius=setting.radius, kappa=setting.kappa, view="above", noise=setting.noise)
    tracks, notes = tracks_of_films(ready.paths, film, where)
    with noting(notes):
        measured = measure(tracks, about, lambda done, total: tell(MEASURING * done / max(total, 1), "contacts"))
    measured = replace(measured, notes=(*notes, *measured.notes))
    with noting(measured.notes):
        said = ready.laws or None
        return fit_tracks(
            measured, setting, said, progress=lambda done, _all, text: tell(MEASURING + (1 - MEASURING) * done, text)
        )


# ----------------------------------------------------------------------------------------------------
# Sixteen example films of one ball at one cushion, as the program Tracker exports them; the true law and surface are known.
#
# A pool ball rolls into one cushion, without sidespin, at two speeds and eight angles, and is filmed from above at 60 frames
# per second; each coordinate in each frame is off by 0.4 mm (standard deviation). `carom tracks example` writes them.


RADIUS, NOSE = 0.0286, 0.036  # m: of the ball; height of the cushion's nose
TRUTH = {"restitution": 0.85, "friction": 0.17}
SPEEDS, ANGLES = (0.9, 1.7), (12, 18, 24, 30, 36, 42, 48, 54)  # m/s; degrees from the cushion's normal


def write_example_films(folder: str | Path) -> list[Path]:
    """Write the films to a folder, which is made if it is not there, and return their paths: shot01.txt to shot16.txt.

    Raises CaromError where they cannot be written, and where a file has such a name already.
    """
    folder = as_path("example films", folder)
    try:
        folder.mkdir(exist_ok=True)
    except OSError as error:
        raise cannot_write(folder, error) from None
    shots = [(speed, angle) for speed in SPEEDS for angle in ANGLES]
    paths = [folder / f"shot{number:02d}.txt" for number in range(1, len(shots) + 1)]
    for path in paths:
        if path.exists():
            raise CaromError(f"{path}: expected no file of that name, got one; name another folder")
    rng = np.random.default_rng(7)
    for path, (speed, angle) in zip(paths, shots, strict=True):
        v, a = speed * rng.uniform(0.95, 1.05), math.radians(angle + rng.uniform(-2, 2))
        velocity = (-v * math.cos(a), v * math.sin(a), 0.0)
        ball = {"radius": RADIUS, "mass": 0.17, "position": (0.45, 0.25), "velocity": velocity, "rolling": True}
        table = {"shape": "table", "length": 2.54, "width": 1.27, "center": (1.27, 0.635), "nose_height": NOSE, **TRUTH}
        floor = {"friction": 0.2, "rolling_resistance": 0.01, "spin_friction": 0.02}
        scene: dict[str, Any] = {"floor": floor, "walls": [table], "balls": [ball], "run": {"duration": 1.2}}
        run = simulate(Scene(**scene))
        meets = [event.t for event in run.events.of("wall")]
        time = np.arange(0, min([run.end, *(t - 0.02 for t in meets[1:])]), 1 / 60)  # until it meets another cushion
        place = np.asarray(run.at(time).position)[:, 0, :2] + rng.normal(0, 4e-4, (len(time), 2))
        rows = [f"{t:.6E}\t{x:.6E}\t{y:.6E}\t" for t, (x, y) in zip(time, place, strict=True)]
        write_text(path, "\n".join(["ball A\t\t", "t\tx\ty\t", *rows, ""]))
    return paths
