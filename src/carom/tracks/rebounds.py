"""Tables of rebounds from measured contacts."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from carom.data.rebounds import Kind, Rebounds, energy_remarks, make_rebounds
from carom.data.table_cells import parse_numbers
from carom.errors import CaromError
from carom.tracks.contact import TrackContact
from carom.tracks.floor import shared_fraction
from carom.tracks.least_squares import OUTPUTS
from carom.tracks.measurement import Measured

Stage = Literal["best", "after_wall", "rolling", "both"]
# Properties of the floor: name, name in a fit, prefix of columns
FLOOR = (("floor friction", "mu_g", "cloth"), ("rolling resistance", "c_g", "rolling"))


def usable_stages(one: TrackContact, stage: Stage, sliding: bool = False) -> tuple[list[str], str]:
    """Return the stages of a contact that go into a table of rebounds, and the reason if there is none.

    Parameters
    ----------
    one : TrackContact
        From :func:`carom.tracks.measure`.
    stage : "best", "after_wall", "rolling" or "both"
        As in :func:`to_rebounds`.
    sliding : bool
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
    if slip and not sliding:
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
    return "it still slides when it meets the wall; rebounds on a table are of rolling balls (`sliding` keeps it)"


def to_rebounds(measured: Measured, stage: Stage = "best", *, sliding: bool = False) -> Rebounds:
    """Make a table of rebounds from measured contacts: planar in flight, else of a ball on a table.

    Parameters
    ----------
    measured : Measured
        From :func:`carom.tracks.measure`.
    stage : "best", "after_wall", "rolling" or "both"
        Of a ball on a table: as it leaves the wall, once it rolls again, the first of these that the track determines (the
        second, if it may hop off the wall), or both as two rows, which are not independent.
    sliding : bool
        Whether to keep balls that still slide when they meet the wall; the columns slip_n_in, slip_t_in are their slip.

    Returns
    -------
    Rebounds
        One row per contact. Extra columns: shot, ball, wall, contact (its number in the film), bounce (its number among the
        contacts of its ball in its shot), t (s); spin_source, the source of the spin before the contact (tracked, rolling
        (inferred), sliding (fitted), none); covariance_v_n and covariance_v_t of the errors before and after, m^2/s^2, which fits
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
        for name in usable_stages(one, stage, sliding)[0]:
            rows.append(_row(one, numbers, name, spin) | _floor(one, name, measured) | _air(one, measured))  # noqa: PERF401
    if not rows:
        raise CaromError(_nothing(measured, stage, sliding))
    speeds = [f"{side}_{which}" for which in ("in", "out") for side in ("v_n", "v_t", spin)]
    columns = {name: np.array([row[name] for row in rows]) for name in speeds}
    columns |= {f"sigma_{name}": np.array([row[f"sigma_{name}"] for row in rows]) for name in speeds}
    for name in (f"{spin}_in", f"{spin}_out"):
        if np.isnan(columns[name]).all():
            del columns[name], columns[f"sigma_{name}"]
        elif (np.isnan(columns[f"sigma_{name}"]) & ~np.isnan(columns[name])).any():
            # (one value for a flight, with neither an error bar nor a scatter)
            del columns[f"sigma_{name}"]
    read = {*speeds, *(f"sigma_{name}" for name in speeds), "stage"}
    extra = {name: np.array([row[name] for row in rows]) for name in rows[0] if name not in read}
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


def _row(one: TrackContact, numbers: dict[str, int], stage: str, spin: str) -> dict[str, Any]:
    fit = one.fit
    assert fit is not None
    out = ("vn_roll", "vt_roll") if stage == "rolling" else ("vn_out", "vt_out")
    row: dict[str, Any] = {
        "shot": one.group, "ball": one.track, "wall": one.wall.name, **numbers, "t": fit["t"],
        "sigma_t": fit.error("t"), "spin_source": _spin_source(one),
        "v_n_in": -fit["vn_in"], "sigma_v_n_in": fit.error("vn_in"),
        "v_t_in": fit["vt_in"], "sigma_v_t_in": fit.error("vt_in"),
        "v_n_out": fit[out[0]], "sigma_v_n_out": fit.error(out[0]),
        "v_t_out": fit[out[1]], "sigma_v_t_out": fit.error(out[1]),
        f"{spin}_in": one.spin.before, f"sigma_{spin}_in": one.spin.before_error,
        f"{spin}_out": one.spin.after, f"sigma_{spin}_out": one.spin.after_error,
        "stage": stage,
        "covariance_v_n": -fit.covariance_of("vn_in", out[0]), "covariance_v_t": fit.covariance_of("vt_in", out[1]),
    }  # fmt: skip
    if one.blind_shift is not None:  # all rows share the error of the blind time
        names = {"v_n_in": "vn_in", "v_t_in": "vt_in", "v_n_out": out[0], "v_t_out": out[1]}
        shift = {name: one.blind_shift.get(inner, 0.0) for name, inner in names.items()}
        shift["v_n_in"] *= -1
        row |= {f"sigma_{name}": float(np.hypot(row[f"sigma_{name}"], change)) for name, change in shift.items()}
        row["covariance_v_n"] += shift["v_n_in"] * shift["v_n_out"]
        row["covariance_v_t"] += shift["v_t_in"] * shift["v_t_out"]
        row |= {f"blind_{name}": change for name, change in shift.items()}
    for prefix, values in fit.shifts.items():  # part of the error bars of the fit already
        names = {"v_n_in": "vn_in", "v_t_in": "vt_in", "v_n_out": out[0], "v_t_out": out[1]}
        shift = {name: float(values[OUTPUTS.index(inner)]) for name, inner in names.items()}
        row |= {f"{prefix}_{name}": -change if name == "v_n_in" else change for name, change in shift.items()}
    if not one.planar:
        for side in ("in", "out"):
            for axis in "nt":
                sign = -1.0 if (axis, side) == ("n", "in") else 1.0
                resolved = fit.resolved(f"u{axis}_{side}")
                row[f"slip_{axis}_{side}"] = sign * fit[f"u{axis}_{side}"] if resolved else np.nan
                row[f"sigma_slip_{axis}_{side}"] = fit.error(f"u{axis}_{side}") if resolved else np.nan
    return row


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


def _nothing(measured: Measured, stage: Stage, sliding: bool) -> str:
    if not measured.contacts:
        walls = ", ".join(wall.name for wall in measured.walls) or "none"
        return (
            f"tracks: expected a contact with a wall, got none (walls: {walls}); give the wall with `wall`, or film until"
            " the ball has left the wall"
        )
    whys: dict[str, int] = {}
    for one in measured.contacts:
        why = usable_stages(one, stage, sliding)[1]
        whys[why] = whys.get(why, 0) + 1
    most = max(whys, key=lambda why: whys[why])
    count = len(measured.contacts)
    return f"tracks: expected a contact that can be measured, got {count} that cannot; {whys[most]} of them: {most}"
