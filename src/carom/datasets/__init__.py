"""Small published tables of balls that were really filmed, each with its source and what to beware of."""

from __future__ import annotations

import shutil
from dataclasses import dataclass
from functools import cached_property
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np

from carom.checks import expect, meant
from carom.datasets.sources import SOURCES
from carom.errors import CaromError
from carom.files import path_of, whole

__all__ = ["Dataset", "load", "names"]


@dataclass(frozen=True)
class Dataset:
    """A table with its source."""

    name: str
    title: str
    citation: str
    doi: str
    notes: str
    """What was measured, how the numbers were taken, and what to beware of."""
    path: Path

    @cached_property
    def columns(self) -> dict[str, Any]:
        """Arrays (N,) by header, in its units: floats where every cell is a number or empty (NaN), else text."""
        import csv

        with self.path.open(encoding="utf-8", newline="") as file:
            headers, *rows = csv.reader(file)
        return {header: _column([row[i] for row in rows]) for i, header in enumerate(headers)}

    def to_csv(self, path: str | Path) -> Path:
        """Write the table as it is to a new file, and return its path; CaromError where it cannot be written."""
        path = path_of("Dataset.to_csv", path)
        with whole(path) as part:
            shutil.copyfile(self.path, part)
        return path


def _column(cells: list[str]) -> Any:
    try:
        return np.array([float(cell) if cell else np.nan for cell in cells])
    except ValueError:
        return np.array(cells)


def names() -> list[str]:
    """The names of the tables."""
    return list(SOURCES)


def load(name: str) -> Dataset:
    """A table by its name; CaromError with the nearest name where there is none."""
    expect("datasets.load", "name", name, str)
    if name not in SOURCES:
        raise CaromError(f"dataset: expected one of {', '.join(SOURCES)}, got {name!r}{meant(name, names())}")
    source = SOURCES[name]
    path = Path(str(resources.files("carom.datasets").joinpath(source.file)))
    return Dataset(name, source.title, source.citation, source.doi, source.notes, path)
