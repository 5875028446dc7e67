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

from carom.data.table_cells import EMPTY, parse_numbers
from carom.errors import CaromError, Fault, did_you_mean, require_type
from carom.files import as_path, atomic_path, read_text

__all__ = ["Dataset", "load", "names"]
FOLDER = Path(str(resources.files("carom.data.datasets")))


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


DATASETS = (
    Dataset(
        name="mathavan2009",
        path=FOLDER / "mathavan2009_rolling_cushion.csv",
        title="30 snooker balls that roll square into a cushion: normal speed before and after",
        citation="S. Mathavan, M. R. Jackson & R. M. Parkin, Application of high-speed imaging to determine the dynamics"
        " of billiards, Am. J. Phys. 77(9), 788-794 (2009), Fig. 9.",
        doi="10.1119/1.3157159",
        notes="Ball 52.4 to 52.5 mm across, 0.1406 kg, rolling without sidespin; cushion of a Riley Renaissance"
        " table, which touches at 7/5 of the radius. Digitised: 30 of the 31 shots of the figure; u_... is the"
        " digitising error, the authors print no error bars; their tracking resolves 1 mm. A refit gives"
        " 0.8165 v + 0.0870 where the figure prints 0.8178 v + 0.0864. The same shots are Fig. 7a of Proc."
        " IMechE C 224(9), 1863-1873 (2010), doi 10.1243/09544062JMES1964, where the authors fit restitution"
        " (energetic) 0.98 and friction 0.14 for v < 1.5 m/s: not an independent measurement.",
    ),
    Dataset(
        name="kharaz2001",
        path=FOLDER / "kharaz2001_alumina_on_glass.csv",
        title="5 mm alumina spheres on glass, without spin, at 3.9 m/s and many angles: four series, one value per row",
        citation="A. H. Kharaz, D. A. Gorham & A. D. Salman, An experimental study of the elastic rebound of spheres,"
        " Powder Technol. 120(3), 281-291 (2001).",
        doi="10.1016/S0032-5910(01)00283-2",
        notes="Speed about 3.9 m/s, incidence from the normal, normal restitution 0.98. From digitisations by"
        " others; the publication itself was not available; the series have different angles. Do not use the"
        " contact-patch series above 60 degrees. The table has no speed column: carom predict takes one, 3.9 m/s.",
    ),
    Dataset(
        name="alciatore_tpb28",
        path=FOLDER / "alciatore_tpb28_sliding_banks.csv",
        title="Where sliding balls without spin, banked on five pool tables, cross the opposite rail",
        citation="D. G. Alciatore, TP B.28, billiards.colostate.edu (2023).",
        doi="",
        notes="Columns ..._derived assume that the aim is at diamond 0; they are empty for the 7-foot tables. No"
        " error bars; printed to 0.01 diamond, 3.2 mm.",
    ),
    Dataset(
        name="tt_rackets",
        path=FOLDER / "tt_rackets_subset.csv",
        title="38 bounces of a table-tennis ball on two rackets, velocity and spin before and after",
        citation="T. Gossard et al., tt_rackets, arXiv:2604.11349; the data are MIT-licensed.",
        doi="10.48550/arXiv.2604.11349",
        notes="Ball 40 mm across, a thin shell (kappa 2/3); rounded from the published set, of which these are two"
        " rackets. Slip at the contact is v_t - a spin_y. A repeated bounce scatters by 0.12 to 0.17 m/s.",
    ),
)


def names() -> list[str]:
    """Return the names of the tables.

    Examples
    --------
    >>> from carom.data import datasets
    >>> datasets.names()
    ['mathavan2009', 'kharaz2001', 'alciatore_tpb28', 'tt_rackets']
    """
    return [one.name for one in DATASETS]


def load(name: str) -> Dataset:
    """Load a table by its name. Raises CaromError, with the nearest name, for an unknown one.

    Examples
    --------
    >>> from carom.data import datasets
    >>> datasets.load("tt_rackets").columns["v_n_in_m_s"].shape
    (38,)
    """
    require_type("datasets.load", "name", name, str)
    if name not in names():
        raise CaromError(Fault("dataset", "", f"one of {', '.join(names())}", repr(name), did_you_mean(name, names())))
    return DATASETS[names().index(name)]
