"""Errors that rows of a table share: what a film measures once for all its contacts (floor friction, rolling resistance, ...)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from carom.data.rebounds import Rebounds

Array = NDArray[np.float64]
# Quantities that a film measures once for all its rows: prefix of the columns, and name
SHARED = {
    "cloth": "floor friction", "rolling": "rolling resistance", "blind": "blind time", "drag": "air drag", "roll": "camera roll",
}  # fmt: skip


@dataclass(frozen=True)
class Shared:
    """An error common to all rows of a film, which measures the quantity once: a standard normal variable z."""

    name: str
    rows: Array
    """(N, 6) change of the measurements before and after the wall for z = 1; 0 in the rows of other films."""
    floor: float = 0.0
    """Change of the floor's friction for z = 1, if that is from the same film."""


def shared_errors(rebounds: Rebounds, names: tuple[str, ...], floor: float) -> tuple[Shared, ...]:
    """Return the errors that rows share, from the columns of a table that carom made from films, which begin as in SHARED.

    Films measured separately (column ``film``) have an error each; of the drag, films that were measured with the same one have one
    (column ``drag_per_metre``). Where a film has one row, nothing is shared: the error is
    part of that of the row. The law's floor friction is the mean of the films, and follows all their errors.

    Parameters
    ----------
    rebounds : Rebounds
        The table.
    names : tuple of str
        The six columns before and after the wall.
    floor : float
        Error bar of the floor's friction, if that is the cloth's; else 0.
    """
    found = []
    for prefix, name in SHARED.items():
        films = _films(rebounds, prefix)
        rows = np.nan_to_num(np.stack([numbers_of(rebounds, f"{prefix}_{column}") for column in names], axis=-1))
        if not rows.any():
            continue
        link = floor if prefix == "cloth" else 0.0
        if len(films) == 1:
            found.append(Shared(name, rows, link))
            continue
        # a film's part of the mean's variance is its weight, 1/sigma^2
        weight = np.array([_weight(rebounds, own) for own in films.values()])
        part = link * np.sqrt(weight / weight.sum()) if weight.any() else np.full(len(films), link / len(films) ** 0.5)
        several = [own.sum() > 1 and bool(rows[own].any()) for own in films.values()]
        found += [
            Shared(f"{name} ({film})", np.where(own[:, None], rows, 0.0), float(of))
            for (film, own), of, many in zip(films.items(), part, several, strict=True)
            if many
        ]
        if rest := float(np.sqrt(np.square(part[~np.array(several)]).sum())):
            found.append(Shared(name, np.zeros_like(rows), rest))
    return tuple(found)


def shared_in_words(shared: tuple[Shared, ...]) -> str:
    """Return the note of a fit on shared errors."""
    by_film = [one.name.partition(" (")[0] for one in shared if one.rows.any()]
    if not by_film:  # one row per film
        return "floor_friction: its error bar is fitted with every law"
    of = (
        "all velocities share the error of the film's"
        if len(by_film) == len(set(by_film)) == len(shared)
        else ("velocities of one film share the error of its")
    )
    return f"{of} {' and its '.join(dict.fromkeys(by_film))}, which is fitted with every law"


def film_says(rebounds: Rebounds, name: str) -> tuple[float, float, int] | None:
    """Return a quantity that films measured once: value, error (0: unknown) and number of films; None if there is none.

    A table that carom makes from a film has it in a column, the same in all rows; several films in one table are weighted by their
    errors.
    """
    value, error = numbers_of(rebounds, name), numbers_of(rebounds, f"sigma_{name}")
    films = np.unique(np.stack([value, np.nan_to_num(error)], axis=-1)[np.isfinite(value) & (value >= 0)], axis=0)
    if not len(films):
        return None
    if len(films) == 1 or not (films[:, 1] > 0).all():
        return float(films[:, 0].mean()), float(films[:, 1].max()), len(films)
    weights = films[:, 1] ** -2
    return float((weights * films[:, 0]).sum() / weights.sum()), float(weights.sum() ** -0.5), len(films)


def numbers_of(rebounds: Rebounds, name: str) -> Array:
    """Return an extra column; NaN where a cell is empty, or the column missing."""
    column = rebounds.extra.get(name)
    try:
        return np.full(len(rebounds), np.nan) if column is None else np.where(column == "", "nan", column).astype(float)
    except ValueError:
        return np.full(len(rebounds), np.nan)


def _films(rebounds: Rebounds, prefix: str) -> dict[str, NDArray[np.bool_]]:
    """Return the rows (N,) of each film; all rows if the table names none, and films with the same air as one."""
    film = rebounds.extra.get("film")
    if prefix == "drag" and "drag_per_metre" in rebounds.extra:
        film = rebounds.extra["drag_per_metre"]
    if film is None:
        return {"": np.ones(len(rebounds), bool)}
    labels = np.array([str(cell) for cell in film.tolist()])
    return {label: labels == label for label in dict.fromkeys(labels.tolist())}


def _weight(rebounds: Rebounds, own: NDArray[np.bool_]) -> float:
    """Return the weight of a film in the mean of the cloth's friction: 0 if it has none, or no error bar."""
    error = numbers_of(rebounds, "sigma_floor_friction")[own]
    error = error[np.isfinite(error) & (error > 0)]
    return float(error[0] ** -2) if len(error) else 0.0
