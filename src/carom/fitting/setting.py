"""Settings of a fit, to rebounds or to whole tracks, and the parameters that are free or held with them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from carom.errors import FaultList, float_or_nan, require_type
from carom.fitting.laws import FittedLaw
from carom.fitting.parameters import ALONG, ALONG_FORMS, FORMS, PARAMETERS, RESTITUTION_FORMS, Form, Parameter
from carom.tracks.contact import BALL_RADIUS, MAX_RADIUS_M

__all__ = ["FORM_PARAMETERS", "Setting", "code_of", "decided", "forms_of", "require_settings"]

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
    """One of :data:`carom.fitting.parameters.FORMS`; whole tracks: any but line, which no scene has."""
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
    cushions: int = 3
    """Whole tracks: largest number of contacts of a simulated track: each of them magnifies the errors made before."""
    after: float = 2.0
    """Whole tracks: time simulated after the last contact, s: later motion is dominated by slope and dirt of the table."""
    gravity: float = 9.80665
    """Whole tracks, m/s^2."""

    def with_height(self) -> Setting:
        """Return the setting with a height of the contact: 1 where none is given."""
        return self if self.contact_height is not None else replace(self, contact_height=1.0)


def require_settings(setting: Setting, *, whole: bool = False) -> None:
    """Raise CaromError for a setting with which rebounds, or ``whole`` tracks, cannot be fitted, one line per problem."""
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
        ("cushions", lambda x: x >= 1, "a whole number of contacts, 1 or more"),
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
                require(low <= float_or_nan(value[one]) <= high, f"fix: {one}", f"{low:g} to {high:g}", value[one])
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
