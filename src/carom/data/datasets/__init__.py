"""Small published tables of filmed balls, each with its source and its limitations."""

from __future__ import annotations

import csv
import io
import shutil
from dataclasses import dataclass
from functools import cached_property
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.data.datasets.carom_tracks import SOURCES
from carom.data.table_cells import EMPTY, parse_numbers
from carom.errors import CaromError, Fault, did_you_mean, require_type
from carom.files import as_path, atomic_path, read_text

__all__ = ["Dataset", "load", "names"]


@dataclass(frozen=True)
class Dataset:
    """A published table with its source.

    Examples
    --------
    >>> from carom.data import datasets
    >>> snooker = datasets.load("mathavan2009")
    >>> snooker.doi, snooker.columns["v_n_in_m_s"][:2]
    ('10.1119/1.3157159', array([0.269, 0.361]))
    """

    name: str
    title: str
    citation: str
    doi: str
    notes: str
    """Measured quantities, how the numbers were obtained, and their limitations."""
    path: Path

    @cached_property
    def columns(self) -> dict[str, Any]:
        """Arrays (N,) by header, in the units of the header: floats if every cell is a number or empty (NaN), else text."""
        headers, *rows = csv.reader(io.StringIO(read_text(self.path)))
        return {header: _column([row[i] for row in rows]) for i, header in enumerate(headers)}

    def to_csv(self, path: str | Path) -> Path:
        """Write the table to a file and return its path. Raises CaromError if it cannot be written."""
        path = as_path("Dataset.to_csv", path)
        with atomic_path(path) as part:
            shutil.copyfile(self.path, part)
        return path


def _column(cells: list[str]) -> NDArray[Any]:
    values, bad = parse_numbers(cells, missing=EMPTY)
    return np.array(cells) if bad else values


def names() -> list[str]:
    """Return the names of the tables.

    Examples
    --------
    >>> from carom.data import datasets
    >>> datasets.names()
    ['mathavan2009', 'kharaz2001', 'alciatore_tpb28', 'tt_rackets']
    """
    return list(SOURCES)


def load(name: str) -> Dataset:
    """Load a table by its name. Raises CaromError, with the nearest name, for an unknown one.

    Examples
    --------
    >>> from carom.data import datasets
    >>> datasets.load("tt_rackets").columns["v_n_in_m_s"].shape
    (38,)
    """
    require_type("datasets.load", "name", name, str)
    if name not in SOURCES:
        raise CaromError(Fault("dataset", "", f"one of {', '.join(SOURCES)}", repr(name), did_you_mean(name, names())))
    source = SOURCES[name]
    path = Path(str(resources.files("carom.data.datasets").joinpath(source.file)))
    return Dataset(name, source.title, source.citation, source.doi, source.notes, path)
