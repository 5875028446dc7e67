"""Read the input of ``carom fit``: a table of rebounds, a track, or a published set."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from carom.cli.common import attempt, noting
from carom.errors import CaromError
from carom.files import text_encoding

if TYPE_CHECKING:
    from carom.data.published import Published
    from carom.data.rebounds import Rebounds
    from carom.fitting import Setting

REBOUND_COLUMNS = (
    "v_n_in, v_t_in, v_n_out, v_t_out (m/s, toward the wall, along it, away from it, along it), and spin_in, spin_out if they were"
    " measured (rad/s)"
)

MIN_FIRST_CONTACTS = 4  # so many are fitted without the later ones, whose spin follows from them

__all__ = ["chosen", "completed", "is_track", "own_set", "read", "with_height_note"]


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
    before, file = len(faults), files[0]
    track = attempt(faults, is_track, file)
    if track and not faults:  # measuring contacts takes time, so invalid options are reported first
        with bar() as say:
            return measured(files, setting, given, view, stage, say)
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

    import numpy as np

    from carom.errors import did_you_mean, shortened_list, suggestion

    faults = []
    keep = np.ones(len(rebounds), bool)
    for text in where:
        name, _equals, value = text.partition("=")
        column = rebounds.extra.get(name)
        if column is None:
            got = (
                f"{text!r}; {suggestion(name, list(rebounds.extra))}" if rebounds.extra else f"{text!r}; there is none"
            )
            faults.append(f"--where: expected COLUMN=VALUE, with an additional column of the table, got {got}")
            continue
        rows = column.astype(str) == value
        if not rows.any():
            known = sorted(set(column.astype(str).tolist()))
            faults.append(
                f"--where {name}: expected one of its values ({shortened_list(known)}), got {value!r}{did_you_mean(value, known)}"
            )
        keep &= rows
    if not faults and not keep.any():
        faults.append("--where: expected conditions that some rows meet, but no row meets all of them")
    if faults:
        raise CaromError(*faults)
    rebounds = rebounds.select(keep)
    kinds = {
        name: sorted(set(column.tolist()))
        for name, column in rebounds.extra.items()
        if _words(column.tolist()) and 1 < len(set(column.tolist())) <= len(rebounds) // 5
    }
    notes = tuple(
        f"{name}: {len(values)} kinds of rows are fitted together ({', '.join(map(str, values[:4]))}"
        f"{', ...' if len(values) > 4 else ''}); --where {name}={values[0]} selects one of them"
        for name, values in kinds.items()
    )
    return replace(rebounds, notes=(*notes, *rebounds.notes))


def _words(cells: list[Any]) -> bool:
    """Return whether a column holds names, not numbers; empty cells are neither."""
    try:
        _numbers = [float(cell) for cell in cells if str(cell).strip()]
    except (TypeError, ValueError):
        return True
    return False


def is_track(file: Path) -> bool:
    """Return whether a file is treated as a track: it has no column of a rebound. CaromError for a file that is not text."""
    if file.suffix.lower() in (".parquet", ".pq") or not file.is_file():
        return False
    with file.open("rb") as opened:
        raw = opened.read(4096)
    wanted = f"{file}: expected a table of rebounds or a track, as text"
    if not raw.strip():
        raise CaromError(f"{wanted}, got an empty file")
    from carom.tracks.read import require_text

    require_text(file, "a table of rebounds or a track")
    codec = text_encoding(raw).codec
    if b"\0" in raw and codec == "utf-8":
        raise CaromError(f"{wanted}, got bytes that are not text; export it as CSV from the program that made it")
    text = raw.decode(codec, errors="replace")
    if any(name in text.lower() for name in ("v_n_in", "vn_in", "v_n_out", "vn_out", "v_t_in", "vt_in")):
        return False
    from carom.tracks.formats.columns import HEADER_EXAMPLE
    from carom.tracks.read import format_of, got_instead, track_text

    whole = track_text(file)
    if format_of(whole) is None:
        raise CaromError(
            f"{wanted}, {got_instead(whole)}; a table of rebounds has the columns {REBOUND_COLUMNS}; a track is like"
            f" {HEADER_EXAMPLE!r} (carom tracks show --help)"
        )
    return True


def measured(
    files: Sequence[Path], setting: Setting, given: Any, view: str | None, stage: str | None, say: Any
) -> Rebounds:
    """Measure the rebounds of one or more tracks; those without any are noted."""
    from dataclasses import replace

    from carom.cli.track_files import notes_by_film, read_files
    from carom.tracks.contact import Settings
    from carom.tracks.films import combined_rebounds, film_names, hops_together
    from carom.tracks.measurement import Measured, measure
    from carom.tracks.rebounds import to_rebounds

    faults: list[str] = []
    found = read_files(files, given)
    settings = Settings(radius=setting.radius, kappa=setting.kappa, view=view)  # type: ignore[arg-type]
    tables: dict[str, Rebounds] = {}

    def once(number: int, hops: bool | None = None) -> Measured:
        def progress(done: int, total: int) -> None:
            say("contacts", (number + done / max(total, 1)) / len(files))

        return measure(found[number].tracks, replace(settings, hops=hops), progress)

    notes = notes_by_film(files, [film.notes for film in found])
    with noting(notes):
        films = hops_together([once(number) for number in range(len(files))], once)
    notes += notes_by_film(files, [one.notes for one in films])
    for name, one in zip(film_names(files), films, strict=True):
        table = attempt(faults, lambda one=one: to_rebounds(one, stage or "best"))  # type: ignore[arg-type]
        if table is not None:
            tables[name] = table
    if not tables:
        with noting(notes):
            raise CaromError(*dict.fromkeys(faults))
    rebounds = combined_rebounds(tables) if len(files) > 1 else next(iter(tables.values()))
    notes += [f"{len(rebounds)} rebounds measured (carom tracks shows them)"]
    if len(files) > len(tables):
        notes.append(f"{len(files) - len(tables)} of {len(files)} films have no contact that can be measured")
    source = str(files[0]) if len(files) == 1 else rebounds.source
    return replace(rebounds, source=source, notes=(*notes, *rebounds.notes))


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
