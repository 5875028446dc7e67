"""Several films: rebounds of each, in one table with a column for the film."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.data.rebounds import Rebounds, make_rebounds
from carom.errors import CaromError, shortened_list
from carom.tracks.contact import TrackContact
from carom.tracks.flight_fits import with_other_drag
from carom.tracks.flights import drag_in_words, joint_air
from carom.tracks.floor import WithError
from carom.tracks.hops import DECISIVE, hop_excess
from carom.tracks.measurement import Measured

__all__ = ["air_together", "combined_rebounds", "decided_together", "film_names", "hops_together"]


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
        floor |= {"air drag": WithError(air.drag, air.drag_error)} if air.drag_shown else {}
        notes = tuple(note for note in film.notes if not note.startswith("air drag:"))
        own = film.air.with_drag(air.drag, air.drag_error)
        found.append(replace(film, contacts=contacts, floor=floor, notes=notes, air=own))
    return found, [
        f"{drag_in_words(air)}, from the flights of all films together, as of one ball; its error is shared by all velocities"
        " (`drag` gives k, 0 for none)"
    ]
