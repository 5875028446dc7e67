"""From measured contacts to a table of rebounds."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np

from carom.errors import CaromError
from carom.rebounds import Kind, Rebounds, make_rebounds
from carom.tracks.floor import shared_part
from carom.tracks.measure import Contact, Measured

__all__ = ["Stage", "chosen", "to_rebounds"]

Stage = Literal["best", "after_wall", "rolling", "both"]
# Of the floor: what it is called, in a fit, and in columns
FLOOR = (("cloth friction", "mu_g", "cloth"), ("rolling resistance", "c_g", "rolling"))


def chosen(one: Contact, stage: Stage, sliding: bool = False) -> tuple[list[str], str]:
    """Which stages of a contact go into a table, and, where none does, why."""
    if one.fit is None:
        return [], one.why
    slip = rolls_in(one)
    if slip and not sliding:
        return [], slip
    if one.planar:
        why = one.why_not("after_wall")
        return ([] if why else ["after_wall"]), why
    wanted = ("after_wall", "rolling") if stage in ("best", "both") else (stage,)
    whys = {name: one.why_not(name) for name in wanted}
    good = [name for name in wanted if not whys[name]]
    return (good[:1] if stage == "best" else good), ("" if good else "; ".join(dict.fromkeys(whys.values())))


def rolls_in(one: Contact) -> str:
    """Empty where the ball rolls when it meets the wall, as a rebound on a table has it; else what it does."""
    if one.fit is None or one.planar or not one.fit.slid:
        return ""
    size = float(np.hypot(one.fit["un_in"], one.fit["ut_in"]))
    error = float(np.hypot(one.fit.error("un_in"), one.fit.error("ut_in")))
    if size < max(2 * error, 0.01):
        return ""
    return "it still slides when it meets the wall, where a rebound on a table rolls (--sliding keeps it)"


def to_rebounds(measured: Measured, stage: Stage = "best", *, sliding: bool = False) -> Rebounds:
    """The table of rebounds: planar for balls in flight, else of a ball on a table, one row a contact.

    ``stage`` best: as the ball leaves the wall where the track tells that, else once it rolls again; both: two rows, which
    are not independent. ``sliding`` keeps balls that still slide when they meet the wall: the columns slip_n_in, slip_t_in
    then say by how much. Extra columns: shot, ball, wall, contact (its number), t (s), spin_source, the covariances of the
    errors before and after (covariance_v_n, covariance_v_t, m^2/s^2, which the fits take up), and of a table the slips
    on the floor (velocity less that of rolling, m/s, in the axes and signs of v_n and v_t) with their errors, and what the film
    says of the floor. spin_source says where the spin before the contact is from: tracked, rolling (inferred), sliding
    (fitted), or none. Raises CaromError where
    no contact could be measured.
    """
    planar = measured.view == "side"
    kind: Kind = "planar" if planar else "table"
    spin = "spin" if planar else "spin_z"
    rows: list[dict[str, Any]] = []
    for number, one in enumerate(measured.contacts):
        for name in chosen(one, stage, sliding)[0]:
            rows.append(_row(one, number + 1, name, spin) | _floor(one, name, measured))  # noqa: PERF401
    if not rows:
        raise CaromError(_nothing(measured, stage, sliding))
    numbers = [f"{side}_{which}" for which in ("in", "out") for side in ("v_n", "v_t", spin)]
    columns = {name: np.array([row[name] for row in rows]) for name in numbers}
    columns |= {f"sigma_{name}": np.array([row[f"sigma_{name}"] for row in rows]) for name in numbers}
    for name in (f"{spin}_in", f"{spin}_out"):
        if np.isnan(columns[name]).all():
            del columns[name], columns[f"sigma_{name}"]
    read = {*numbers, *(f"sigma_{name}" for name in numbers), "stage"}
    extra = {name: np.array([row[name] for row in rows]) for name in rows[0] if name not in read}
    return make_rebounds(
        kind, columns, stage=None if planar else [row["stage"] for row in rows], extra=extra, source="tracks"
    )


def _row(one: Contact, number: int, stage: str, spin: str) -> dict[str, Any]:
    fit = one.fit
    assert fit is not None
    out = ("vn_roll", "vt_roll") if stage == "rolling" else ("vn_out", "vt_out")
    spin_in, spin_out, error_in, error_out = one.spin
    row: dict[str, Any] = {
        "shot": one.group, "ball": one.track, "wall": one.wall.name, "contact": number, "t": fit["t"],
        "sigma_t": fit.error("t"), "spin_source": _spin_source(one),
        "v_n_in": -fit["vn_in"], "sigma_v_n_in": fit.error("vn_in"),
        "v_t_in": fit["vt_in"], "sigma_v_t_in": fit.error("vt_in"),
        "v_n_out": fit[out[0]], "sigma_v_n_out": fit.error(out[0]),
        "v_t_out": fit[out[1]], "sigma_v_t_out": fit.error(out[1]),
        f"{spin}_in": spin_in, f"sigma_{spin}_in": error_in, f"{spin}_out": spin_out, f"sigma_{spin}_out": error_out,
        "stage": stage,
        "covariance_v_n": -fit.covaries("vn_in", out[0]), "covariance_v_t": fit.covaries("vt_in", out[1]),
    }  # fmt: skip
    if not one.planar:
        for side in ("in", "out"):
            for axis in "nt":
                sign = -1.0 if (axis, side) == ("n", "in") else 1.0
                told = fit.told(f"u{axis}_{side}")
                row[f"slip_{axis}_{side}"] = sign * fit[f"u{axis}_{side}"] if told else np.nan
                row[f"sigma_slip_{axis}_{side}"] = fit.error(f"u{axis}_{side}") if told else np.nan
    return row


def _floor(one: Contact, stage: str, measured: Measured) -> dict[str, float]:
    """What all contacts together say of the floor, and by how much the velocities move with one error bar of that.

    The ways that a ball slides and rolls are extrapolated to the contact with these numbers, so rows share their errors, as far as
    they have them from each other.
    """
    found: dict[str, float] = {}
    out = ("vn_roll", "vt_roll") if stage == "rolling" else ("vn_out", "vt_out")
    names = {"v_n_in": "vn_in", "v_t_in": "vt_in", "v_n_out": out[0], "v_t_out": out[1]}
    for label, inner, prefix in FLOOR:
        if one.fit is None or label not in measured.floor:
            continue
        value, sigma = measured.floor[label]
        found |= {label.replace(" ", "_"): value, f"sigma_{label.replace(' ', '_')}": sigma}
        error, own = sigma * measured.gravity, one.fit.error(inner)
        # (at most what it knows: one that was not told of a contact that stands apart may know more than all together)
        part = shared_part(own, getattr(one.prior, f"{inner}_error"), getattr(one.prior, f"{inner}_between"))
        share = min(error * part / own**2, 1 / error) if own and error else 0.0
        for name, of in names.items():
            found[f"{prefix}_{name}"] = (-share if name == "v_n_in" else share) * one.fit.covaries(of, inner)
    return found


def _spin_source(one: Contact) -> str:
    if np.isfinite(one.spin[0]):
        return "tracked"
    if one.planar:
        return "none"
    return "sliding (fitted)" if rolls_in(one) else "rolling (inferred)"


def _nothing(measured: Measured, stage: Stage, sliding: bool) -> str:
    if not measured.contacts:
        walls = ", ".join(wall.name for wall in measured.walls) or "none"
        return (
            f"tracks: expected a contact with a wall, got none (walls: {walls}); a track that turns back shows one: give the"
            " wall with --wall, or film on until the ball has come off"
        )
    whys: dict[str, int] = {}
    for one in measured.contacts:
        why = chosen(one, stage, sliding)[1]
        whys[why] = whys.get(why, 0) + 1
    most = max(whys, key=lambda why: whys[why])
    count = len(measured.contacts)
    return f"tracks: expected a contact that can be measured, got {count} that cannot; {whys[most]} of them: {most}"
