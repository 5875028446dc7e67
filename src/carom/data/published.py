"""The published data sets (:mod:`carom.data.datasets`) as rebounds to which laws can be fitted."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from carom.data.datasets import Dataset, load, names
from carom.data.headers import DIRECTION_COLUMN, DIRECTION_UNIT
from carom.data.rebound_files import read_rebounds
from carom.data.rebounds import Rebounds, make_rebounds
from carom.files import read_regular


@dataclass(frozen=True)
class Published:
    """A published set as rebounds, with the ball and the table of the experiment.

    Examples
    --------
    >>> from carom.data import published_rebounds
    >>> snooker = published_rebounds("mathavan2009")
    >>> len(snooker.rebounds), snooker.setting["radius"]
    (30, 0.02625)
    """

    rebounds: Rebounds
    setting: dict[str, Any]
    """Fields of a :class:`carom.fitting.Setting`: radius, kappa and others."""
    shifted: tuple[tuple[str, Rebounds], ...] = ()
    """Systematic errors common to all rows: a description, and the rebounds shifted by one standard deviation."""


def published_name(text: str) -> str | None:
    """Return the name of the set that a text abbreviates; None if there is none or more than one."""
    found = [name for name in names() if text and name.startswith(text)]
    return text if text in found else found[0] if len(found) == 1 else None


def published_at(path: Path) -> Published | None:
    """Return the set that a path names, where there is no such file, or of which it is a copy; None for any other path."""
    if not path.exists():
        name = published_name(str(path))
    else:
        size = path.stat().st_size if path.is_file() else -1
        sets = {name: load(name).path for name in _READ}
        same = (
            name
            for name, ours in sets.items()
            if ours.stat().st_size == size and read_regular(ours) == read_regular(path)
        )
        name = next(same, None)
    return None if name is None else published_rebounds(name)


def published_rebounds(name: str) -> Published:
    """Return a published set as rebounds.

    Parameters
    ----------
    name : str
        One of ``carom datasets``.

    Returns
    -------
    Published

    Examples
    --------
    >>> from carom.data import published_rebounds
    >>> rackets = published_rebounds("tt_rackets").rebounds
    >>> rackets.kind, len(rackets)
    ('planar', 38)
    """
    return _READ[name](load(name))


def _mathavan(data: Dataset) -> Published:
    v, out = data.columns["v_n_in_m_s"], data.columns["v_n_out_m_s"]
    rebounds = make_rebounds(
        "table", {"v_n_in": v, "v_n_out": out, "spin_z_in": np.zeros(len(v))}, stage="after_wall", source=data.name,
        notes=("the printed error bars contain the digitisation alone; the scatter is estimated",),
    )  # fmt: skip
    return Published(rebounds, {"radius": 0.02625, "kappa": 0.4, "contact_height": 1.4, "floor_friction": 0.212})


KHARAZ_SPEED, KHARAZ_ANGLE = 3.9, 0.2  # m/s; degrees by which the series disagree about the angle of one shot
KHARAZ_SHARED = 0.25  # degrees by which they disagree on the average of all shots, and two readers of one series do


def _kharaz(data: Dataset) -> Published:
    """Return the rebounds of :func:`_kharaz_rows`, also with all angles of a series shifted.

    The sign of the shift lowers the restitution, which has an upper bound.
    """
    notes = (
        "v_n_out: from the tangential speed and the angle of rebound, two series that were digitised apart; their angles are"
        f" taken as right to {KHARAZ_ANGLE:g} degrees, by which the series disagree",
        f"v_n_in, v_t_in: all shots taken at {KHARAZ_SPEED:g} m/s",
    )
    rebounds, incidence, turned = (
        make_rebounds("planar", _kharaz_rows(data, *shift), source=data.name, notes=notes)
        for shift in ((0.0, 0.0), (-KHARAZ_SHARED, 0.0), (0.0, KHARAZ_SHARED))
    )
    words = f"{KHARAZ_SHARED:g} degrees of all"
    shifted = ((f"{words} incidences", incidence), (f"{words} angles of rebound", turned))
    return Published(rebounds, {"radius": 0.0025, "kappa": 0.4}, shifted)


def _kharaz_rows(data: Dataset, incidences: float, rebounds: float) -> dict[str, Any]:
    """Return the columns from two series: ratio of tangential speeds, and angle of rebound; shifted by some degrees.

    tan(rebound) = v_t_out / v_n_out, so that both together give v_n_out, and with it the restitution.
    """
    series, angle, value = (data.columns[key] for key in ("quantity", "incidence_from_normal_deg", "value"))
    kept, turned = series == "vt_out/vt_in (centre)", series == "rebound_angle_from_normal"
    # the same shots in both: of the angles of rebound the nearest by incidence
    place = np.argmin(np.abs(angle[kept][:, None] - angle[turned]), axis=1)
    rebound, incidence = np.radians(value[turned][place] + rebounds), np.radians(angle[kept] + incidences)
    error = np.radians(KHARAZ_ANGLE)
    v_n, v_t = KHARAZ_SPEED * np.cos(incidence), KHARAZ_SPEED * np.sin(incidence)
    v_t_out = value[kept] * v_t
    v_n_out = v_t_out / np.tan(rebound)
    return {
        "v_n_in": v_n, "v_t_in": v_t, "spin_in": np.zeros(len(v_n)), "v_n_out": v_n_out, "v_t_out": v_t_out,
        "sigma_v_n_in": v_t * error, "sigma_v_t_in": v_n * error, "sigma_v_t_out": 0.01 * np.abs(v_t_out) + 0.005,
        "sigma_v_n_out": v_n_out * error / (np.sin(rebound) * np.cos(rebound)),
    }  # fmt: skip


def _rackets(data: Dataset) -> Published:
    return Published(read_rebounds(data.path), {"radius": 0.02, "kappa": 2 / 3})


def _alciatore(data: Dataset) -> Published:
    """Return the directions of the tables whose angles are known, of balls without spin."""
    seen = np.isfinite(data.columns["theta_in_deg_derived"])
    before, after = (np.radians(data.columns[f"theta_{name}_deg_derived"][seen]) for name in ("in", "out"))
    columns = {"v_n_in": np.cos(before), "v_t_in": np.sin(before), "spin_in": 0 * before, "v_t_out": np.sin(after)}
    extra = {"table": data.columns["table"][seen], DIRECTION_COLUMN: np.full(len(before), DIRECTION_UNIT)}
    notes = (
        "directions alone, at a speed taken as 1 m/s, for an aim at diamond 0; the push of the nose on the upper half of the ball,"
        " which the cloth turns into speed on the way to the opposite rail, is left out: see docs/datasets.md#alciatore",
    )
    rebounds = make_rebounds("planar", columns, extra=extra, source=data.name, notes=notes)
    return Published(rebounds, {"radius": 0.028575, "kappa": 0.4})


_READ: dict[str, Callable[[Dataset], Published]] = {
    "mathavan2009": _mathavan, "kharaz2001": _kharaz, "tt_rackets": _rackets, "alciatore_tpb28": _alciatore,
}  # fmt: skip
