"""Read the input of ``carom fit``: a table of rebounds, a track, or a published set."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from carom.cli.common import attempt
from carom.errors import CaromError

if TYPE_CHECKING:
    from carom.data.published import Published
    from carom.data.rebounds import Rebounds
    from carom.fitting import Setting

MIN_FIRST_CONTACTS = 4  # so many are fitted without the later ones, whose spin follows from them

__all__ = ["chosen", "completed", "own_set", "read", "with_height_note"]


def own_set(file: Path) -> Published | None:
    """Return the published set of that name, where there is no such file. CaromError where it cannot be fitted."""
    from carom.data.published import published_name, published_rebounds

    name = None if file.exists() else published_name(str(file))
    return None if name is None else published_rebounds(name)


def read(
    files: Sequence[Path],
    faults: list[str],
    setting: Setting,
    given: Any,
    view: str | None,
    kind: str | None,
    stage: str | None,
    bar: Any,
) -> Rebounds:
    """Return the rebounds of a table, or of one or more tracks. CaromError with its problems and those found before."""
    from carom.tracks.contact import Settings
    from carom.tracks.film_files import is_track, rebounds_of_films

    before, file = len(faults), files[0]
    track = attempt(faults, is_track, file)
    if track and not faults:  # measuring contacts takes time, so invalid options are reported first
        settings = Settings(radius=setting.radius, kappa=setting.kappa, view=view)  # type: ignore[arg-type]
        with bar() as say:
            return rebounds_of_films(
                files, given, settings, stage=stage or "best",  # type: ignore[arg-type]
                progress=lambda done, total, text: say(text, done / total),
            )  # fmt: skip
    rebounds: Rebounds | None = (
        None if track or len(faults) > before else attempt(faults, read_table, file, kind, stage)
    )
    if faults or rebounds is None:
        raise CaromError(*faults)
    return rebounds


def read_table(file: Path, kind: str | None, stage: str | None) -> Rebounds:
    """Return the rebounds of a table; an invalid kind or stage, reported elsewhere, is ignored."""
    from carom.data.rebounds import KINDS, STAGES, read_rebounds

    return read_rebounds(file, kind=kind if kind in KINDS else None, stage=stage if stage in STAGES else None)


def chosen(rebounds: Rebounds, where: list[str]) -> Rebounds:
    """Return the rows that ``--where`` selects, with a note where a column of words distinguishes kinds of rows."""
    from dataclasses import replace

    from carom.data.where import kinds_note, rows_where

    rebounds = rebounds.select(rows_where(rebounds.extra, where, len(rebounds)))
    return replace(rebounds, notes=(*kinds_note(rebounds.extra, len(rebounds)), *rebounds.notes))


def completed(
    rebounds: Rebounds, sigma_v: float | None, sigma_spin: float | None, spin: float | None, *, first_only: bool = False
) -> Rebounds:
    """Fill in the error bars and spins given by options, where the table has none.

    ``first_only``: leave out the later contacts of thrown balls, where spins were not measured and enough first ones remain.
    A spin is that before the first contact of a flight or shot: a ball that has met a wall spins differently.
    """
    from dataclasses import replace

    import numpy as np

    from carom.tracks.rebounds import first_contacts

    if first_only:
        rebounds = _without_later_contacts(rebounds)
    columns, sigma = dict(rebounds.columns), dict(rebounds.sigma)
    notes: tuple[str, ...] = ()
    first = first_contacts(rebounds)
    for name, column in columns.items():
        exact = spin is not None and name in ("spin_in", "spin_z_in")
        if spin is not None and exact:
            later = np.isnan(column) & ~first
            columns[name] = np.where(np.isnan(column) & first, spin, column)
            notes += _spin_note(len(rebounds), name, spin, int(first.sum()), int(later.sum()))
        given = sigma_spin if name.startswith("spin") else sigma_v
        if given is not None and name not in sigma and np.isfinite(column).any() and not exact:
            sigma[name] = np.full(len(column), given)
    return replace(rebounds, columns=columns, sigma=sigma, notes=(*rebounds.notes, *notes))


def with_height_note(rebounds: Rebounds, height: float | None, known: bool) -> Rebounds:
    """Add a note to rebounds on a table where the height of the contact is assumed: neither given nor ``known`` otherwise."""
    from dataclasses import replace

    if height is not None or known or rebounds.kind != "table":
        return rebounds
    note = (
        "contact_height: not given; assumed to be 1, a wall that touches the ball level with its centre; the nose of a cushion"
        " touches it higher (--contact-height, nose height / radius: mostly 1.2 to 1.4)"
    )
    return replace(rebounds, notes=(note, *rebounds.notes))


def _spin_note(rows: int, name: str, spin: float, first: int, later: int) -> tuple[str, ...]:
    """Return a note where --spin does not hold for all rows. CaromError where it holds for none."""
    if not later:
        return ()
    if not first:
        raise CaromError(
            f"--spin: expected rows that are the first contact of a ball (column bounce = 1), got {rows} later ones,"
            " in which the ball spins already; omit the option"
        )
    return (
        f"{name}: --spin {spin:g} holds for the first contact of a ball ({first} of {rows} rows); a ball that has bounced"
        f" spins, so the later contacts ({later}) count as unmeasured",
    )


def _without_later_contacts(rebounds: Rebounds) -> Rebounds:
    """Leave out the later contacts of balls in flight whose spin was not measured, where enough first ones remain; with a note.

    The first contact sets a ball spinning. Spins of later contacts follow from it, in a narrow range that depends on the law, and
    are no draws of the distribution from which the spins of throws come: fitted as such, they favour wrong laws by large odds.
    """
    from dataclasses import replace

    import numpy as np

    from carom.tracks.rebounds import first_contacts

    if rebounds.kind != "planar" or not np.isfinite(rebounds["v_t_in"]).any():
        return rebounds
    first, unknown = first_contacts(rebounds), np.isnan(rebounds["spin_in"])
    later = unknown & ~first
    if not later.any():
        return rebounds
    why = "spin_in: not measured, and a ball that has bounced spins as its first contact left it"
    if first.sum() < MIN_FIRST_CONTACTS:
        note = (
            f"{why}; {later.sum()} of {len(rebounds)} rows are later contacts, and count as if their spins were independent, as"
            f" there are only {first.sum()} first ones: film more throws before relying on a verdict (--spin 0 if they had none)"
        )
        return replace(rebounds, notes=(*rebounds.notes, note))
    note = (
        f"{why}: the {later.sum()} later contacts of {len(rebounds)} rows are left out (--every-contact keeps them, as if their"
        " spins were independent)"
    )
    rest = rebounds.select(~later)
    return replace(rest, notes=(*rest.notes, note))
