"""The rows of a table that a fit may use, with default error bars and spins, and notes on what was left out or assumed."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from carom.core.units import UNITS
from carom.data.rebounds import STAGES, Kind, Rebounds
from carom.data.where import Where, kinds_note, rows_where
from carom.errors import CaromError, FaultList, float_or_nan
from carom.fitting.setting import Setting
from carom.tracks.rebounds import first_contacts

__all__ = ["assumed_height", "require_error_bars", "rows_that_meet", "second_rows", "spin_of_rows", "usable_rows"]

Array = NDArray[np.float64]
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
