"""Settings of a fit, to rebounds or to whole tracks, and the parameters that are free or held with them."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from carom.core.units import UNITS
from carom.data.headers import DIRECTION_COLUMN, DIRECTION_UNIT
from carom.data.rebounds import COLUMNS, STAGES, Kind, Rebounds, energy_remarks
from carom.data.where import Where, kinds_note, rows_where
from carom.errors import CaromError, FaultList, float_or_nan, require_type
from carom.fitting.laws import (
    AFTER_WALL,
    ALONG,
    ALONG_FORMS,
    DIRECTION,
    FORMS,
    PARAMETERS,
    RESTITUTION_FORMS,
    FittedLaw,
    Form,
    Parameter,
)
from carom.fitting.likelihood import SpinMixture
from carom.fitting.shared_errors import SHARED, Shared, film_says, numbers_of, shared_errors, shared_in_words
from carom.fitting.spin_chains import chains_of
from carom.fitting.spins import SpinGrid, sigma_grid
from carom.tracks.contact import BALL_RADIUS, MAX_RADIUS_M
from carom.tracks.films import first_contacts

SCATTERS = ("share", "absolute")
PRIORS = ("uniform", "normal")
MAX_SPIN = 5.0  # mean or width of spins before the wall, in v/a
SPHERE = 2 / 3 * (1 + 1e-12)  # largest kappa of a ball that is simulated: a hollow one's
FORM_PARAMETERS = tuple(
    {one.name: one for forms in (FORMS, *ALONG.values()) for form in forms.values() for one in form.parameters}.values()
)
EXTRA = (
    ("kappa", "contact_height", "floor_friction", "roll"),
    ("spin_loss",),
)  # fitted on request: rebounds, whole tracks


@dataclass(frozen=True)
class Setting:
    """Settings of a fit: the ball, the height of the wall contact, the form of restitution, priors, parameters to fit or hold.

    Fits to rebounds (:func:`carom.fitting.fit_laws`) and to whole tracks (:func:`carom.fitting.tracks.fit_tracks`) take it; fields
    that say "rebounds" or "whole tracks" matter to those only.

    Examples
    --------
    >>> from carom.fitting import Setting
    >>> Setting(radius=0.02, kappa=2 / 3).restitution
    'constant'
    """

    radius: float
    """m"""
    kappa: float = 0.4
    """I / (m a^2)"""
    restitution: str = "constant"
    """One of :data:`carom.fitting.laws.FORMS`; whole tracks: any but line, which no scene has."""
    friction: str = "constant"
    """Rebounds: constant, linear or exponential in the slip; ``linear:v_n`` in another variable: v_n, slip, slip/v_n, speed."""
    tangential_restitution: str = "constant"
    """Rebounds: the same, in slip/v_n by default."""
    stiffness_ratio: str = "constant"
    """Rebounds: the same, for laws with tangential compliance."""
    contact_height: float | None = None
    """Height of the wall contact above the floor, in radii (billiard cushions: 1.2 to 1.4); for balls on a table. None: taken as 1,
    and a note says so."""
    floor_friction: float | None = None
    """Friction of the floor. None: of rebounds, from the table's columns floor_friction and sigma_floor_friction (of a film), else
    0.2; of whole tracks, fitted."""
    floor_restitution: float = 0.0
    roll: float = 1.0
    """Rebounds: horizontal spin with which balls on a table arrive, as a fraction of the spin of rolling; 0: none."""
    spin_prior: str = "normal"
    """Rebounds: prior of an unmeasured spin: "normal" of width spin_width about spin_mean v_t/a, or "uniform" within it."""
    spin_width: float | None = None
    """Width of the prior of a spin that was not measured, v/a. None: of rebounds, fitted (too large a width favours laws that do
    not depend on the spin); of whole tracks, 1.25, normal about zero, at the first contact."""
    spin_mean: float | None = None
    """Rebounds: mean of that prior (running side), v_t/a; None: fitted (0 for a uniform prior)."""
    chained: bool = True
    """Rebounds: whether unmeasured spins of a ball's later contacts follow from the contacts before, and not from the prior."""
    fit: tuple[str, ...] = ()
    """Parameters to fit in addition to the law's own: kappa, contact_height, floor_friction, roll; of whole tracks, spin_loss."""
    fixed: dict[str, float] = field(default_factory=dict)
    """Parameters of the law that are held fixed, with their values."""
    bounds: dict[str, tuple[float, float]] = field(default_factory=dict)
    robust: bool = False
    """Rebounds: errors with heavy tails: Student's t with 4 degrees of freedom instead of normal."""
    scatter: str = ""
    """Rebounds: scatter between contacts that is fitted beyond the error bars: "share" (of the speed before the wall), "absolute"
    (m/s), or none."""
    noise: float | None = None
    """Whole tracks: of one coordinate of one frame, m; None: estimated from each law's residuals."""
    contacts: int = 3
    """Whole tracks: largest number of contacts of a simulated track: each of them magnifies the errors made before."""
    after: float = 2.0
    """Whole tracks: time simulated after the last contact, s: later motion is dominated by slope and dirt of the table."""
    gravity: float = 9.80665
    """Whole tracks, m/s^2."""

    def with_height(self) -> Setting:
        """Return the setting with a height of the contact: 1 where none is given."""
        return self if self.contact_height is not None else replace(self, contact_height=1.0)


def require_settings(setting: Setting, *, whole: bool = False, held: Collection[str] = ()) -> None:
    """Raise CaromError for a setting with which rebounds, or ``whole`` tracks, cannot be fitted, one line per problem; ``held``:
    parameters that are fixed by an argument of their own."""
    require_type("fit", "setting", setting, Setting)
    kappa, most, where = "kappa = I/(m a^2) above 0, up to 1", 1.0, ""
    if whole:
        kappa, most, where = "kappa in (0, 2/3]", SPHERE, " for whole tracks"
    forms = [form for form in FORMS if not (whole and form == "line")]
    limits = {one.name: one for one in (*PARAMETERS, *FORM_PARAMETERS)}
    faults = FaultList()

    def require(ok: bool, name: str, expected: str, got: Any) -> None:
        if not ok:
            faults.add(name, expected, f"{got!r:.60}")

    numbers: tuple[tuple[str, Callable[[float], bool], str], ...] = (
        ("radius", lambda x: 0 < x <= MAX_RADIUS_M, BALL_RADIUS),
        ("contact_height", lambda x: 1 <= x < 2, "1 (level with the centre) to 2, in radii"),
        ("floor_restitution", lambda x: 0 <= x <= 1, "0 to 1"),
        ("kappa", lambda x: 0 < x <= most, f"solid, hollow or {kappa}"),
        ("floor_friction", lambda x: 0 <= x < math.inf, "a number of at least 0"),
        ("roll", lambda x: 0 <= x < math.inf, "a number of at least 0"),
        ("spin_width", lambda x: 0 < x <= MAX_SPIN, f"a width above 0, up to {MAX_SPIN:g} v/a"),
        ("spin_mean", lambda x: abs(x) <= MAX_SPIN, f"{-MAX_SPIN:g} to {MAX_SPIN:g} v_t/a"),
        ("noise", lambda x: 0 < x < 1, "a length above 0 (m)"),
        ("contacts", lambda x: x >= 1, "a whole number of contacts, 1 or more"),
    )
    for name, holds, expected in numbers:
        value = getattr(setting, name)
        omitted = value is None and Setting.__dataclass_fields__[name].default is None
        require(omitted or holds(float_or_nan(value)), "inertia" if name == "kappa" else name, expected, value)
    along = ((name, ("constant",) if whole else tuple(known)) for name, known in ALONG.items())
    for name, known in (("restitution", forms), *along, ("spin_prior", PRIORS), ("scatter", SCATTERS)):
        value = getattr(setting, name)
        of_form = name == "restitution" or name in ALONG
        words = f"one of {', '.join(known)}{where}" if of_form else " or ".join(known)
        require(value in known or (name == "scatter" and value == ""), name, words, value)
    if setting.spin_prior == "uniform" and setting.spin_width is None:
        faults.add("spin_width", "a width in v/a for a uniform prior", "none", "a normal one's can be fitted")
    for name, kind, words in (
        ("fit", tuple | list, "tuple"), ("fixed", Mapping, "mapping"), ("bounds", Mapping, "mapping")
    ):  # fmt: skip
        value = getattr(setting, name)
        require(isinstance(value, kind), name, f"a {words} of names", value)
        for one in value if isinstance(value, kind) else ():
            if name == "fit":
                require(one in EXTRA[whole], "fit", f"one of {', '.join(EXTRA[whole])}{where}", one)
            elif name == "bounds":
                ends = [float_or_nan(end) for end in value[one]] if isinstance(value[one], tuple | list) else []
                ok = len(ends) == 2 and ends[0] < ends[1]
                require(ok, f"bounds: {one}", "two numbers, the lower first", value[one])
            elif one in limits:
                low, high = limits[one].low, limits[one].high
                place = one if one in held else f"fix: {one}"
                require(low <= float_or_nan(value[one]) <= high, place, f"{low:g} to {high:g}", value[one])
    faults.raise_if_any()


def forms_of(law: FittedLaw, setting: Setting) -> dict[str, Form]:
    """Return the form of each parameter that the law fits and that may depend on the impact."""
    found = {"restitution": FORMS[setting.restitution]} | {
        name: known[getattr(setting, name)] for name, known in ALONG.items()
    }
    return {name: form for name, form in found.items() if name in law.free}


def code_of(forms: Mapping[str, Form]) -> int:
    """Return the forms as one number, as the kernels of a rebound take it."""
    code = {name: form.code for name, form in forms.items()}
    last = code.get("tangential_restitution", 0) or code.get("stiffness_ratio", 0)
    return code.get("restitution", 0) + RESTITUTION_FORMS * (code.get("friction", 0) + ALONG_FORMS * last)


def decided(
    law: FittedLaw, setting: Setting, known: Sequence[Parameter], also: Iterable[str] = ()
) -> dict[str, Parameter]:
    """Return parameters by name, the free ones first, each with its bounds, its value, and who decided.

    ``known``: all parameters, those of the forms among them. The law's own and those named in ``also`` are free,
    unless the law pins them or the setting fixes them. (A value that the setting fixes counts only for a parameter that would be
    free, or that belongs to the ball or the table.)
    """
    forms = forms_of(law, setting)
    own = [one.name for form in forms.values() for one in form.parameters] + [
        name for name in law.free if name not in forms
    ]
    at, found = {one.name: one for one in known}, {}
    for name in dict.fromkeys([*own, *also, *at]):
        one, wanted = at[name], name in own or name in also
        if name in law.pinned:
            one = replace(one, value=law.pinned[name], origin="law")
        elif name in setting.fixed and (wanted or one.origin):
            one = replace(one, value=setting.fixed[name], origin="setting")
        elif wanted:
            low, high = setting.bounds.get(name, (one.low, one.high))
            if name == "stiffness_ratio" and law.chi_range is not None:
                share = (1 + 1 / setting.kappa) / 2
                low, high = max(low, law.chi_range[0] / share), min(high, law.chi_range[1] / share)
            one = replace(one, low=low, high=high, free=True, origin="law" if name in own else "setting")
        found[name] = one
    return {name: one for name, one in found.items() if one.free} | found


# ----------------------------------------------------------------------------------------------------
# Rebounds as arrays for the likelihood: measurements, variances, shared errors, the grid of unmeasured spins.


Array = NDArray[np.float64]
MAX_SHARED_VARIANCE = 0.95  # of a variance: the rest is a row's own
MAX_CORRELATION = 0.95  # of errors before and after: a row with fully correlated errors would carry no information
FLOOR_FRICTION = 0.2  # of a billiard table, by default
CARRIED_WORK = 10  # in that of a spin that is integrated over by itself
LEAST_UNITS = 3  # films, shots or chains that rows are divided into
FEW_DRAWN = 4  # spins from which the width of their prior is hardly known
FEW_ROWS, SAME_ANGLE, SAME_SPEED = 12, 3.0, 1.3  # rows; degrees; ratio of the fastest to the slowest


@dataclass(frozen=True)
class Problem:
    """N rebounds as arrays, with variances and the assumptions of the fit; made by :func:`make_problem`.

    Examples
    --------
    >>> from carom.data.rebounds import make_rebounds
    >>> from carom.fitting import Setting, make_problem
    >>> columns = {"v_n_in": [1.0, 2.0, 3.0], "v_t_in": [1.0] * 3, "spin_in": [0.0] * 3, "v_n_out": [0.8, 1.6, 2.4]}
    >>> columns |= {"v_t_out": [0.7, 0.8, 0.9], "sigma_v_n_out": 0.02, "sigma_v_t_out": 0.02}
    >>> problem, _notes = make_problem(make_rebounds("planar", columns), Setting(radius=0.02))
    >>> problem.select([0, 2]).x[:, 0], problem.count
    (array([1., 3.]), 6)
    """

    rebounds: Rebounds
    setting: Setting
    x: Array
    """(N, 3) before: v_n, v_t, spin (NaN: not measured)."""
    vx: Array
    """(N, 3) their variances."""
    covariance: Array
    """(N, 2) covariances of the errors of v_n before and after, and of v_t before and after."""
    y: Array
    """(N, 3) after; NaN: not measured."""
    vy: Array
    stages: NDArray[np.int64] | None
    spins: SpinGrid | None
    """Assumptions about unmeasured spins; None: all were measured."""
    estimated: NDArray[np.bool_]
    """(3,) whether an output has no error bars, so that its scatter is estimated."""
    shared: tuple[Shared, ...] = ()
    """Errors common to the rows of a film."""
    carried: bool = False
    """Whether unmeasured spins follow from those before the ball's last contact (:mod:`carom.fitting.spin_chains`)."""
    mixture: SpinMixture | None = None
    """The prior of unmeasured spins, where it is a mixture; None: normal or uniform."""

    @property
    def count(self) -> int:
        """Number of measurements after the wall."""
        return int(np.isfinite(self.y).sum())

    @property
    def unknown(self) -> NDArray[np.bool_]:
        """(N,) mask of rows whose spin before the wall was not measured."""
        return np.isnan(self.x[:, 2])

    @functools.cached_property
    def chains(self) -> NDArray[np.int64]:
        """(M, L) rows of contacts that follow each other (:func:`carom.fitting.spin_chains.chains_of`)."""
        return chains_of(self.rebounds)

    @functools.cached_property
    def units(self) -> NDArray[np.int64]:
        """(N,) number of the film, sheet, shot or chain of contacts of each row: rows of one are held out together.

        The largest of which there are enough; films not where their errors in common are fitted.
        """
        chain = np.empty(len(self.x), np.int64)
        for k, rows in enumerate(self.chains):
            chain[rows[rows >= 0]] = k
        levels = [*(() if self.shared else (("film",), ("sheet",))), ("film", "sheet", "shot")]
        for level in levels:
            labels = [self.rebounds.extra[name].astype(str).tolist() for name in level if name in self.rebounds.extra]
            numbers = _numbered(list(zip(*labels, strict=True)))
            if labels and numbers.max() >= LEAST_UNITS - 1:
                return numbers
        return _numbered(chain.tolist()) if self.carried or np.ptp(chain) >= LEAST_UNITS - 1 else np.arange(len(chain))

    def some(self, count: int) -> Problem:
        """Return the problem with about so many of its rows, of units that are far from each other."""
        if count >= len(self.x):
            return self
        kinds = int(self.units.max()) + 1
        chosen = np.linspace(0, kinds - 1, max(round(count * kinds / len(self.x)), 1)).astype(int)
        return self.select(np.isin(self.units, chosen))

    @property
    def drawn(self) -> NDArray[np.bool_]:
        """(N,) mask of rows whose spin before the wall is a draw of the prior."""
        if not self.carried:
            return self.unknown
        first = np.zeros(len(self.x), bool)
        first[self.chains[:, 0]] = True
        return self.unknown & first

    @property
    def nu(self) -> float:
        """Degrees of freedom of the errors; 0: normal."""
        return 4.0 if self.setting.robust else 0.0

    def select(self, rows: Any) -> Problem:
        """Return the problem with only some rows, from indices or a mask."""
        stages = None if self.stages is None else np.ascontiguousarray(self.stages[rows])
        names = ("x", "vx", "covariance", "y", "vy")
        arrays: dict[str, Any] = {name: np.ascontiguousarray(getattr(self, name)[rows]) for name in names}
        shared = tuple(replace(one, rows=np.ascontiguousarray(one.rows[rows])) for one in self.shared)
        return replace(self, rebounds=self.rebounds.select(rows), stages=stages, shared=shared, **arrays)

    def work(self, heavy: bool) -> float:
        """Return the number of law evaluations per evaluation of the likelihood; ``heavy``: of a costly law."""
        each = 0 if self.spins is None else len(self.spins.sigma) * (CARRIED_WORK if self.carried else 1)
        return float(len(self.x) + self.unknown.sum() * each) * (100.0 if heavy else 1.0)


def _numbered(labels: list[Any]) -> NDArray[np.int64]:
    """Return numbers of labels (N,), from 0 in the order in which they come."""
    numbers: dict[Any, int] = {}
    return np.array([numbers.setdefault(label, len(numbers)) for label in labels], np.int64)


def make_problem(rebounds: Rebounds, setting: Setting) -> tuple[Problem, list[str]]:
    """Return rebounds as arrays for a fit, and notes.

    Parameters
    ----------
    rebounds : Rebounds
    setting : Setting

    Returns
    -------
    Problem, and notes on assumptions and on properties of the data that limit any fit. Raises CaromError if a fit is impossible:
    too few rows, or no error bars where spins were not measured.

    Examples
    --------
    >>> from carom.data.rebounds import make_rebounds
    >>> from carom.fitting import Setting, make_problem
    >>> columns = {"v_n_in": [1.0, 2.0, 3.0], "v_t_in": [1.0] * 3, "spin_in": [0.0] * 3, "v_n_out": [0.8, 1.6, 2.4]}
    >>> columns |= {"v_t_out": [0.7, 0.8, 0.9], "sigma_v_n_out": 0.02, "sigma_v_t_out": 0.02}
    >>> problem, notes = make_problem(make_rebounds("planar", columns), Setting(radius=0.02))
    >>> problem.count
    6
    """
    names = COLUMNS[rebounds.kind]
    x = np.stack([rebounds[name] for name in names[:3]], axis=-1)
    y = np.stack([rebounds[name] for name in names[3:]], axis=-1)
    notes = _without_tangential(rebounds, x, y) or _without_spins(rebounds, setting, x, y)
    spins = names[5]
    seen = np.isfinite(y)

    def variance(name: str) -> Array:
        return np.square(np.nan_to_num(rebounds.sigma.get(name, np.zeros(len(rebounds)))))

    vx = np.stack([variance(name) for name in names[:3]], axis=-1)
    vy = np.stack([variance(name) for name in names[3:]], axis=-1)
    estimated = np.array([bool(seen[:, j].any()) and names[3 + j] not in rebounds.sigma for j in range(3)])
    unknown = np.isnan(x[:, 2])
    faults = _no_numbers(rebounds)
    covariance, wrong = _covariances(rebounds, np.where(estimated[:2], np.inf, np.sqrt(vx[:, :2] * vy[:, :2])))
    faults += wrong
    if estimated.any():
        lacks = ", ".join(f"sigma_{names[3 + j]}" for j in np.flatnonzero(estimated))
        if unknown.any() or setting.robust:
            why = (
                f"{names[2]} was not measured in {unknown.sum()} rows"
                if unknown.any()
                else "the robust fit is requested"
            )
            faults.append(
                f"{rebounds.source}: {lacks}: expected error bars, because {why} and its effect cannot be distinguished from"
                " scatter; got none; add the columns, or give `sigma_v` and `sigma_spin`"
            )
        else:
            notes.append(
                f"{lacks}: not given; the scatter is estimated for each law separately, so chi^2 cannot test any of them"
            )
        faults += _no_scatter(rebounds, setting, lacks)
        vy[:, estimated] = 1.0
    if len(rebounds) < 3:
        faults.append(
            f"{rebounds.source}: rows: expected at least 3 rebounds to fit, got {len(rebounds)}; measure more"
        )
    if faults:
        raise CaromError(*faults)
    exact = [name for name in names[:3] if name not in rebounds.sigma and np.nan_to_num(rebounds[name]).any()]
    if exact and rebounds.sigma:
        bars = ", ".join(f"sigma_{name}" for name in exact)
        notes.append(f"the table has no error bars {bars}: these are assumed to be exact before the wall")
    stages = _stages(rebounds)
    setting, floor, error = _with_floor(rebounds, setting.with_height())
    setting, held = _with_least_speed(setting, x[:, 0])
    notes += [*floor, *held]
    shared = () if estimated.any() else shared_errors(rebounds, names, error)
    if shared:  # each row keeps the rest of its variance
        square = np.sum([np.square(one.rows) for one in shared], axis=0)
        vx, vy = (v - np.minimum(s, MAX_SHARED_VARIANCE * v) for v, s in ((vx, square[:, :3]), (vy, square[:, 3:])))
        covariance = covariance - np.sum([one.rows[:, :2] * one.rows[:, 3:5] for one in shared], axis=0)
        notes.append(shared_in_words(shared))
    most = np.where(estimated[:2], 0.0, MAX_CORRELATION * np.sqrt(vx[:, :2] * vy[:, :2]))
    problem = Problem(
        rebounds, setting, x, vx, np.clip(covariance, -most, most), y, vy, stages, None, estimated, shared
    )
    if unknown.any():
        problem = replace(problem, spins=SpinGrid(sigma_grid(), setting.spin_prior == "uniform"))
        carried = rebounds.kind == "planar" and setting.chained and stages is None
        problem = replace(problem, carried=carried and not (replace(problem, carried=True).drawn == unknown).all())
        notes.append(_spins_in_words(problem, names[2]))
    notes += _warnings(problem, spins)
    return problem, notes


def _without_tangential(rebounds: Rebounds, x: Array, y: Array) -> list[str]:
    """Leave out of x and y (N, 3) what tells nothing where all balls come straight at the wall, and return a note on it."""
    if rebounds["v_t_in"].any() or rebounds["v_t_out"].any():
        return []
    y[:, 1] = np.nan
    if rebounds.kind == "table" or not np.isnan(x[:, 2]).any() or not np.isnan(y[:, 2]).all():
        return []
    x[:, 2] = np.nan_to_num(x[:, 2])
    return ["spin_in: not measured; taken as 0, since nothing along the wall was measured either"]


def _without_spins(rebounds: Rebounds, setting: Setting, x: Array, y: Array) -> list[str]:
    """Leave out of x and y (N, 3) what lies along the wall where no spin before it was measured and no error bar is known, and
    return a note on it: an unknown spin cannot be distinguished from scatter there. Not where spins after it were measured."""
    names = COLUMNS[rebounds.kind]
    bare = not rebounds.sigma and np.isnan(x[:, 2]).all() and np.isfinite(y[:, 0]).any() and not setting.robust
    if rebounds.kind != "planar" or not bare or np.isnan(y[:, 1]).all() or np.isfinite(y[:, 2]).any():
        return []
    x[:, 1], x[:, 2], y[:, 1:] = 0.0, 0.0, np.nan
    return [
        f"{names[2]} was not measured, and there are no error bars: what lies along the wall is left out, since a spin cannot be"
        " distinguished from scatter there; the restitution remains. Give `spin` (0: thrown without spin), or `sigma_v` and"
        " `sigma_spin`, to fit friction"
    ]


def _no_scatter(rebounds: Rebounds, setting: Setting, lacks: str) -> list[str]:
    """Return an error line where a scatter beyond error bars is asked for, and there are no error bars."""
    said = f"{rebounds.source}: scatter: expected error bars, beyond which contacts scatter, got no {lacks}"
    return [f"{said}; leave it out, all scatter is estimated then"] if setting.scatter else []


def _covariances(rebounds: Rebounds, most: Array) -> tuple[Array, list[str]]:
    """Return the covariances (N, 2) of the errors of v_n before and after and of v_t, 0 where not given, and their problems.
    ``most``: the products of the error bars.

    In a film the paths before and after a wall meet at one place and time, so the errors of their slopes are correlated.
    """
    found, faults = np.zeros((len(rebounds), 2)), []
    for o, name in enumerate(("v_n", "v_t")):
        found[:, o] = np.nan_to_num(numbers_of(rebounds, f"covariance_{name}"))
        wrong = np.flatnonzero(~(np.abs(found[:, o]) <= most[:, o] * (1 + 1e-6)))
        if len(wrong):
            label = rebounds.rows[wrong[0]] if rebounds.rows else f"row {wrong[0] + 1}"
            faults.append(
                f"{rebounds.source}: {label}: covariance_{name}: expected at most sigma_{name}_in times sigma_{name}_out,"
                f" {most[wrong[0], o]:.3g} m^2/s^2, got {found[wrong[0], o]:.3g}; omit the column if error bars were changed"
            )
    return found, faults


def _no_numbers(rebounds: Rebounds) -> list[str]:
    """Return one line per cell that is not a number in the columns of shared errors and covariances."""
    faults = []
    for name, column in rebounds.extra.items():
        prefixes = (*(f"{prefix}_" for prefix in SHARED), "covariance_", "floor_friction")
        if not name.removeprefix("sigma_").startswith(prefixes):
            continue
        for i, cell in enumerate(column.tolist()):
            try:
                float(cell or "nan")
            except ValueError:
                label = rebounds.rows[i] if rebounds.rows else f"row {i + 1}"
                faults.append(f"{rebounds.source}: {label}: {name}: expected a number, or an empty cell, got {cell!r}")
    return faults


def _stages(rebounds: Rebounds) -> NDArray[np.int64] | None:
    """Return at which stage, or in which unit, each row (N,) was measured after the wall, as kernels number it; None: all alike."""
    if rebounds.stage is not None:
        return np.array([STAGES.index(str(s)) for s in rebounds.stage])
    alone = directions_of(rebounds)
    return np.where(alone, DIRECTION, AFTER_WALL) if alone.any() else None


def directions_of(rebounds: Rebounds) -> NDArray[np.bool_]:
    """Return the rows (N,) of which only the direction after the wall was measured, whose v_t_out is in units of the speed."""
    column = rebounds.extra.get(DIRECTION_COLUMN)
    if column is None or rebounds.kind != "planar":
        return np.zeros(len(rebounds), bool)
    return np.array([str(cell) == DIRECTION_UNIT for cell in column.tolist()], bool)


def _with_floor(rebounds: Rebounds, setting: Setting) -> tuple[Setting, list[str], float]:
    """Return the setting with a floor friction, a note on its origin, and its error bar if it is from a film."""
    if setting.floor_friction is not None:
        return setting, [], 0.0
    if rebounds.kind == "planar":
        return replace(setting, floor_friction=FLOOR_FRICTION), [], 0.0
    found = film_says(rebounds, "floor_friction")
    fitted = "floor_friction" in setting.fit or "floor_friction" in setting.fixed
    if found is None:
        said = f"`floor_friction` is not given: assumed to be {FLOOR_FRICTION:g}; give it, or `fit` floor_friction"
        return replace(setting, floor_friction=FLOOR_FRICTION), [] if fitted else [said], 0.0
    value, error, films = found
    bar = f" ± {error:.2g}" if error else ""
    of = "from the film" if films == 1 else f"mean of {films} films"
    said = f"`floor_friction` is {value:.4g}{bar}, {of} (column floor_friction)"
    return replace(setting, floor_friction=value), [] if fitted else [said], 0.0 if fitted else error


def _with_least_speed(setting: Setting, v_n: Array) -> tuple[Setting, list[str]]:
    """Return the setting with the speed of a power law held at the least one measured, and a note: above it only the product
    at_rest speed^exponent enters, and a wall that is elastic below some speed has to be seen there."""
    name = "restitution_speed"
    if setting.restitution != "power" or name in setting.fixed or name in setting.bounds:
        return setting, []
    up = 1 - (setting.contact_height or 1.0)
    least = float(v_n.min() * np.sqrt(1 - up * up))
    said = (
        f"{name} is held at {least:.4g} m/s, the least normal speed, so that restitution_at_rest is the value there; to fit it as"
        " well, give it bounds (`bound`)"
    )
    return replace(setting, fixed=setting.fixed | {name: least}), [said]


def _spins_in_words(problem: Problem, name: str) -> str:
    """Return a note on unmeasured spins: how many rows have none, and from where they are taken."""
    unknown, drawn = problem.unknown.sum(), problem.drawn.sum()
    said = f"{name}: not measured in {unknown} of {len(problem.x)} rows"
    if not problem.carried:
        return f"{said}; integrated over its prior ({prior_in_words(problem.setting)})"
    said += f"; in {unknown - drawn} later contacts carried on from the ball's contact before"
    if drawn:
        said += f", in {drawn} others integrated over its prior ({prior_in_words(problem.setting)})"
    few = 0 < drawn < FEW_DRAWN
    return f"{said}; film more throws before relying on a verdict (`spin` 0 if they had none)" if few else said


def prior_in_words(setting: Setting) -> str:
    """Return the prior of unmeasured spins in words."""
    uniform = setting.spin_prior == "uniform"
    mean = 0.0 if uniform and setting.spin_mean is None else setting.spin_mean
    about = "with a fitted mean along v_t" if mean is None else f"about {mean:g} v_t/a" if mean else "about 0"
    width = "fitted width" if setting.spin_width is None else f"width {setting.spin_width:g} v/a"
    return f"uniform {about}, within {setting.spin_width:g} v/a" if uniform else f"normal {about}, {width}"


def _warnings(problem: Problem, spin: str) -> list[str]:
    """Return notes on data that limit any fit: few rows, copies, one angle, one speed, no spin."""
    notes = []
    n = len(problem.x)
    if n < FEW_ROWS:
        notes.append(
            f"rows: only {n} rebounds, but error bars are valid for many; measure more before drawing conclusions"
        )
    both = np.nan_to_num(np.concatenate([problem.x, problem.y], axis=1), nan=np.inf)
    different, first = np.unique(both, axis=0, return_index=True)
    if len(different) < n:
        label = problem.rebounds.rows or tuple(f"row {i + 1}" for i in range(n))
        copies = [label[i] for i in range(n) if i not in set(first.tolist())]
        notes.append(
            f"rows: {len(copies)} of {n} are copies of others ({', '.join(copies[:3])}{', ...' if len(copies) > 3 else ''}); each"
            " counts as an independent measurement, so error bars are too small; remove the copies"
        )
    angle = np.degrees(np.arctan2(problem.x[:, 1], problem.x[:, 0]))
    spun = problem.x[:, 2] * problem.setting.radius / np.hypot(problem.x[:, 0], problem.x[:, 1])
    spinless = not np.nanmax(np.abs(spun), initial=0.0) > 0.05
    if np.isfinite(problem.y[:, 1]).any() and np.ptp(angle) < SAME_ANGLE and spinless:
        notes.append(
            f"angles: all rows have the same angle, {np.median(angle):.1f} degrees within {np.ptp(angle):.1g}: one angle"
            " determines one parameter along the wall, not two; film other angles (carom design proposes them)"
        )
    speed = problem.x[:, 0]
    if speed.max() < SAME_SPEED * speed.min() and problem.setting.restitution != "constant":
        notes.append(
            f"speeds: v_n_in only from {speed.min():.3g} to {speed.max():.3g} m/s: too few for a restitution that depends on it"
        )
    notes += energy_remarks(problem.rebounds, problem.setting.radius, problem.setting.kappa, problem.setting.roll)
    return [*notes, *_unmeasured(problem, spin)]


def _unmeasured(problem: Problem, spin: str) -> list[str]:
    """Return notes on what was not measured after the wall, and what then depends on nothing that was."""
    n, after = len(problem.x), np.isfinite(problem.y)
    seen = dict(zip(("v_n_out", "v_t_out", spin), after.sum(axis=0).tolist(), strict=True))
    notes = [
        f"{name}: not measured in {n - count} of {n} rows; it does not enter the likelihood there"
        for name, count in seen.items()
        if 0 < count < n
    ]
    if (alone := directions_of(problem.rebounds)).any():
        notes.append(
            f"only the angle after the wall is known in {alone.sum()} of {n} rows: balls that slide show restitution and friction"
            " over a range of angles, balls that grip only (1 + tangential restitution)/restitution"
        )
    elif not seen["v_n_out"]:
        notes.append(
            "v_n_out: not measured; the restitution enters only through its product with the friction, where balls slide"
        )
    if not seen[spin]:
        notes.append(f"{spin}: not measured; only v_t depends on friction")
    elif not seen["v_t_out"] and problem.rebounds["v_t_in"].any():
        notes.append(f"v_t_out: not measured; only {spin} depends on friction")
    if (empty := int((~after.any(axis=1)).sum())) > 0:
        notes.append(f"rows: nothing was measured after the wall in {empty} of {n}: they have no say")
    return notes


# ----------------------------------------------------------------------------------------------------
# The rows of a table that a fit may use, with default error bars and spins, and notes on what was left out or assumed.


Rows = NDArray[np.bool_]
CONTACT = ("film", "shot", "ball", "contact")  # columns by which rows of one contact are known
LEAST_SIGNED, CLEARER = 5, 5.0  # rows, and ratio of what is not conserved, from which signs and units are doubted
MOST_CARRIED = 1000  # rows up to which spins are carried from one contact to the next


def usable_rows(
    rebounds: Rebounds,
    setting: Setting,
    *,
    where: Where = (),
    sigma_v: float | None = None,
    sigma_spin: float | None = None,
    spin: float | str | None = None,
    every_contact: bool = False,
) -> tuple[Rebounds, Setting]:
    """Return the rows of a table that a fit may use, and the setting with what was assumed.

    Parameters
    ----------
    rebounds : Rebounds
    setting : Setting
    where : str, sequence of str or mapping
        Conditions that rows have to meet, such as ``"racket=smooth"``: values of the table's additional columns.
    sigma_v, sigma_spin : float, optional
        Error bars of speeds (m/s) and spins (rad/s) that have none.
    spin : float or str, optional
        Unmeasured spins before the wall: rad/s, of the first contact of each ball; or their prior, ``"normal"``,
        ``"normal:WIDTH"`` or ``"uniform:WIDTH"`` (in v/a, about 0), in place of the setting's.
    every_contact : bool
        Whether unmeasured spins of later contacts are taken as independent draws of the prior. By default each is what the ball's
        contact before left, in the order of the column ``bounce`` or ``contact``; in tables of more than 1000 rows later contacts
        are left out.

    Returns
    -------
    rows : Rebounds
        With notes on kinds of rows, on an assumed height of the contact, and on the rows that were left out.
    setting : Setting
        With the prior of spins and the height of the contact.

    Raises
    ------
    CaromError
        One line per problem.

    Examples
    --------
    >>> from carom.data import make_rebounds
    >>> from carom.fitting import Setting
    >>> table = make_rebounds("planar", {"v_n_in": [1.0, 2.0], "v_n_out": [0.8, 1.5]})
    >>> rows, _setting = usable_rows(table, Setting(radius=0.02), sigma_v=0.02, spin=0.0)
    >>> rows["sigma_v_n_out"], rows["spin_in"]
    (array([0.02, 0.02]), array([0., 0.]))
    """
    faults = FaultList()
    faults.attempt(require_error_bars, sigma_v, sigma_spin)
    known_spin, prior = faults.attempt(spin_of_rows, spin) or (None, {})
    met = faults.attempt(rows_that_meet, rebounds, where)
    faults.raise_if_any()
    rows, height_note = cast(Rebounds, met), assumed_height(rebounds.kind, setting)
    rows = replace(rows, notes=(*kinds_note(rows.extra, len(rows)), *height_note, *rows.notes))
    if not every_contact:
        rows = _without_later_contacts(rows)
    rows = _with_one_stage(rows)
    rows = _with_defaults(rows, sigma_v, sigma_spin, known_spin)
    rows = replace(rows, notes=(*rows.notes, *_conservation_note(rows, setting)))
    return rows, replace(setting, **prior, chained=not every_contact).with_height()


def rows_that_meet(rebounds: Rebounds, where: Where) -> Rebounds:
    """Return the rows that meet conditions on the additional columns or on the stage."""
    columns: dict[str, Any] = dict(rebounds.extra) | ({} if rebounds.stage is None else {"stage": rebounds.stage})
    return rebounds.select(rows_where(columns, where, len(rebounds)))


def require_error_bars(sigma_v: float | None, sigma_spin: float | None) -> None:
    """Raise CaromError for an error bar that is given and not above 0."""
    faults = FaultList()
    for name, value in (("sigma_v", sigma_v), ("sigma_spin", sigma_spin)):
        if value is not None and not float_or_nan(value) > 0:
            faults.add(f"`{name}`", "an error bar above 0", f"{value!r}")
    faults.raise_if_any()


def assumed_height(kind: Kind, setting: Setting) -> list[str]:
    """Return a note where the height of a contact on a table is assumed: neither given, nor fitted, nor held."""
    if kind != "table" or setting.contact_height is not None or "contact_height" in {*setting.fit, *setting.fixed}:
        return []
    return [
        "`contact_height` is not given: assumed to be 1, a wall that touches the ball level with its centre; the nose of a cushion"
        " touches it higher (nose height / radius: mostly 1.2 to 1.4)"
    ]


def _conservation_note(rows: Rebounds, setting: Setting) -> list[str]:
    """Return a note where v_t + kappa a spin, which every impact at one point conserves, is so with another sign or unit only."""
    if rows.kind != "planar":
        return []
    before, after = rows["v_t_in"], rows["v_t_out"]
    spins = setting.kappa * setting.radius * np.stack([rows["spin_in"], rows["spin_out"]])
    known = np.isfinite(before + after + spins.sum(axis=0))
    if known.sum() < LEAST_SIGNED:
        return []

    def change(v: Array, spin: Array) -> float:
        return float(np.median(np.abs((v + spin[1] - before - spin[0])[known])))

    others = [
        (change(after, -spins), "the other sign of the spins"),
        (change(-after, spins), "the other sign of v_t_out"),
    ]
    others += [(change(after, spins / unit.to_si(1.0)), f"speeds in {unit.name}") for unit in UNITS["speed"].values()]
    others += [(change(after, spins * unit.to_si(1.0)), f"spins in {unit.name}") for unit in UNITS["spin"].values()]
    given, (least, meant) = change(after, spins), min(others)
    if not least * CLEARER < given:
        return []
    sign = "sign" in meant
    return [
        f"{'signs' if sign else 'units'}: an impact at one point conserves v_t + kappa a spin; here it changes by {given:.2g} m/s"
        f" (median), with {meant} by {least:.2g}{' m/s' * sign}: check the"
        f" {'signs (slip is v_t - a spin)' if sign else 'units in the header, and the radius'}"
    ]


def spin_of_rows(spin: float | str | None) -> tuple[float | None, dict[str, Any]]:
    """Return the spin of all rows (rad/s; None: not given), and the prior of unmeasured spins as fields of a Setting.

    Raises CaromError for a text that is neither a number nor a prior.

    Examples
    --------
    >>> spin_of_rows("12.5"), spin_of_rows("uniform:0.5")[1]["spin_width"]
    ((12.5, {}), 0.5)
    """
    name, _, width = str("normal" if spin is None else spin).partition(":")
    try:
        if name == "normal" and not width:
            return None, {}
        if name in ("normal", "uniform"):
            if float(width) > 0:
                return None, {"spin_prior": name, "spin_width": float(width), "spin_mean": 0.0}
        elif math.isfinite(value := 0.0 if name == "none" else float(name)):
            return value, {}
    except ValueError:
        pass
    raise CaromError(
        f"`spin`: expected a spin in rad/s, normal, normal:WIDTH or uniform:WIDTH (in v/a), got {str(spin)!r}"
    )


def second_rows(rows: Rebounds) -> Rows:
    """Return which rows (N,) are the second of a contact, once the ball rolls: one that has a row as it leaves the wall as well."""
    if rows.stage is None:
        return np.zeros(len(rows), bool)
    same = [rows.extra[name].tolist() for name in CONTACT if name in rows.extra]
    key = list(zip(rows["v_n_in"].tolist(), rows["v_t_in"].tolist(), *same, strict=True))
    first = {one for one, stage in zip(key, rows.stage.tolist(), strict=True) if stage == STAGES[0]}
    return np.array([stage != STAGES[0] and one in first for one, stage in zip(key, rows.stage.tolist(), strict=True)])


def _with_one_stage(rows: Rebounds) -> Rebounds:
    """Leave out the second rows of contacts that were measured at both stages, whose errors are not independent; with a note."""
    second = second_rows(rows)
    if not second.any():
        return rows
    note = (
        f"stage: {second.sum()} contacts have a row as the ball leaves the wall and one once it rolls, whose errors are not"
        " independent: the first is fitted (`stage` rolling: the others)"
    )
    rest = rows.select(~second)
    return replace(rest, notes=(*rest.notes, note))


def _with_defaults(rows: Rebounds, sigma_v: float | None, sigma_spin: float | None, spin: float | None) -> Rebounds:
    """Fill in error bars and spins where the table has none; a spin holds for the first contact of each ball."""
    columns, sigma, notes = dict(rows.columns), dict(rows.sigma), list(rows.notes)
    first = first_contacts(rows)
    for name, column in rows.columns.items():
        if spin is not None and name in ("spin_in", "spin_z_in"):
            unknown = np.isnan(column)
            notes += _spin_note(name, spin, first, unknown & ~first)
            columns[name] = np.where(unknown & first, spin, column)
            continue
        given = sigma_spin if name.startswith("spin") else sigma_v
        if given is not None and name not in sigma and np.isfinite(column).any():
            sigma[name] = np.full(len(column), given)
    return replace(rows, columns=columns, sigma=sigma, notes=tuple(notes))


def _spin_note(name: str, spin: float, first: Rows, later: Rows) -> list[str]:
    """Return a note where a given spin does not hold for all rows. Raises CaromError where it holds for none."""
    if not later.any():
        return []
    if not first.any():
        raise CaromError(
            f"`spin`: expected rows that are the first contact of a ball (column bounce = 1), got {len(first)} later ones,"
            " in which the ball spins already; omit the spin"
        )
    return [
        f"{name}: `spin` {spin:g} holds for the first contact of a ball ({first.sum()} of {len(first)} rows); a ball that has"
        f" bounced spins, so in the later contacts ({later.sum()}) it follows from those before"
    ]


def _without_later_contacts(rows: Rebounds) -> Rebounds:
    """Leave out the later contacts of balls in flight whose spin was not measured, in tables too long to carry it; with a note.

    The first contact sets a ball spinning. Spins of later contacts follow from it, in a narrow range that depends on the law, and
    are no draws of the distribution from which the spins of throws come: fitted as such, they favour wrong laws by large odds.
    """
    if rows.kind != "planar" or len(rows) <= MOST_CARRIED or not np.isfinite(rows["v_t_in"]).any():
        return rows
    later = np.isnan(rows["spin_in"]) & ~first_contacts(rows)
    if not later.any():
        return rows
    note = (
        f"spin_in: not measured, and a ball that has bounced spins as its first contact left it: the {later.sum()} later contacts"
        f" of {len(rows)} rows are left out (spins are carried on in up to {MOST_CARRIED} rows; `every_contact` keeps them, as if"
        " their spins were independent)"
    )
    rest = rows.select(~later)
    return replace(rest, notes=(*rest.notes, note))
