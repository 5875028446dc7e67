"""The measured sets that come with carom (:mod:`carom.datasets`), as rebounds that laws can be fitted to."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from carom.datasets import Dataset, load, names
from carom.errors import CaromError
from carom.rebounds import Rebounds, make_rebounds, read_rebounds

__all__ = ["Published", "published", "published_name"]


@dataclass(frozen=True)
class Published:
    """A set as rebounds, and the ball and table it was measured with."""

    rebounds: Rebounds
    setting: dict[str, Any]
    """Fields of a :class:`carom.fitting.Setting`: radius, kappa and others."""
    shifted: tuple[tuple[str, Rebounds], ...] = ()
    """What all rows may have wrong together: in words, and the rebounds with one standard error of it put in."""


def published_name(text: str) -> str | None:
    """The set that a word means: its name or the beginning of it; None where there is none or more than one."""
    found = [name for name in names() if text and name.startswith(text)]
    return text if text in found else found[0] if len(found) == 1 else None


def published(name: str) -> Published:
    """A set by its name. Raises CaromError for a set that says too little for a fit, with what it lacks."""
    return _READ[name](load(name))


def _mathavan(data: Dataset) -> Published:
    v, out = data.columns["v_n_in_m_s"], data.columns["v_n_out_m_s"]
    rebounds = make_rebounds(
        "table", {"v_n_in": v, "v_n_out": out, "spin_z_in": np.zeros(len(v))}, stage="after_wall", source=data.name,
        notes=("the printed error bars are those of digitising alone; the scatter is estimated",),
    )  # fmt: skip
    return Published(rebounds, {"radius": 0.02625, "kappa": 0.4, "contact_height": 1.4, "floor_friction": 0.212})


KHARAZ_SPEED, KHARAZ_ANGLE = 3.9, 0.2  # m/s; degrees by which the series disagree about the angle of one shot
KHARAZ_SHARED = 0.25  # degrees by which they disagree on the average of all shots, and two readers of one series do


def _kharaz(data: Dataset) -> Published:
    """The rebounds of :func:`_kharaz_rows`; and what they are if all angles of a series were read wrongly, by one sign.

    (The sign is that which lowers the restitution: upwards there is a bound.)
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
    """Columns of a shot from two series: tangential speeds after over before, and angles of rebound; shifted by degrees.

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
    raise CaromError(
        f"{data.name}: expected speeds before and after the wall, got directions alone: no law can be fitted to them; what they"
        " say is in docs/datasets/alciatore.md"
    )


_READ: dict[str, Callable[[Dataset], Published]] = {
    "mathavan2009": _mathavan, "kharaz2001": _kharaz, "tt_rackets": _rackets, "alciatore_tpb28": _alciatore,
}  # fmt: skip
