"""Restitution, friction and tangential restitution of a gas, from tracks of its balls: ``carom fit gas``."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from carom.data.columns import as_columns, is_columns, read_columns
from carom.data.rebounds import Rebounds
from carom.errors import FaultList
from carom.files import as_path
from carom.fitting.fit_files import fit
from carom.fitting.gas_collisions import collisions_of_tracks
from carom.fitting.ranking import Ranking
from carom.fitting.result import Estimate, estimate_dict
from carom.formatting import counted
from carom.gas.build import load_gas
from carom.gas.contact_forms import ANY
from carom.gas.scene import GasScene
from carom.scene.restitution import Exponential, Polynomial, Power, Viscoelastic

__all__ = ["GasFit", "fit_gas"]

TRACKS = ("t", "ball", "x", "y")
MIN_SLIDING = 4  # collisions, by which friction is told: of fewer one with a wrong error bar may decide


@dataclass(frozen=True)
class GasFit:
    """Numbers of the contacts of a gas's balls, with standard errors."""

    values: dict[str, float]
    errors: dict[str, float]
    rows: int
    """Collisions found in the tracks."""
    notes: tuple[str, ...] = ()

    def estimates(self) -> dict[str, Estimate]:
        """Return value and error bar of each number."""
        return {name: Estimate(x, self.errors[name], "") for name, x in self.values.items()}

    def to_dict(self) -> dict[str, Any]:
        """Return the results as plain numbers."""
        parameters = {name: estimate_dict(one) for name, one in self.estimates().items()}
        return {"parameters": parameters, "rows": self.rows, "notes": list(self.notes)}


def fit_gas(file: str | Path | Any, scene: str | Path | GasScene) -> GasFit:
    """Infer restitution, friction and tangential restitution of the balls of a gas, with error bars.

    Parameters
    ----------
    file : path, or columns
        Tracks of free balls: columns ``t``, ``ball``, ``x``, ``y``, maybe ``z`` and spins ``wz`` (``wx``, ``wy``), a row per ball
        and frame. Each collision of two balls in them is a rebound, to which the contact law is fitted.
    scene : path or GasScene
        The gas: container, radius and inertia of the balls. Where its restitution has a form of the speed, the numbers of the form
        are inferred: ``restitution_c`` of a viscoelastic contact, ``restitution_at_rest`` and so on.

    Returns
    -------
    GasFit
        Raises CaromError, one line per problem.

    Examples
    --------
    >>> from carom.fitting import fit_gas
    >>> fit_gas({"t": [0.0, 1.0]}, "gas.toml")
    Traceback (most recent call last):
    carom.errors.CaromError: fit_gas: expected tracks of balls (columns t, ball, x, y), got t
    """
    where = "fit_gas"
    if is_columns(file):
        columns = as_columns(file, where)
    else:
        path = as_path(where, file)
        where, columns = str(path), read_columns(path)[0]
    faults = FaultList(where)
    if not set(TRACKS) <= set(columns):
        faults.add("", f"tracks of balls (columns {', '.join(TRACKS)})", f"{', '.join(columns)}")
    if isinstance(scene, GasScene) or not faults:
        gas = scene if isinstance(scene, GasScene) else load_gas(scene)
        names = {ANY, *(one.name for one in gas.species)}
        # (with wildcards also of a ball and a wall)
        of_balls = [one for one in gas.contacts if set(one.between) <= names]
        if not of_balls:
            faults.add("contacts", "a contact of the balls in the scene", "none")
    faults.raise_if_any()
    first = of_balls[0].restitution
    form = first.form if isinstance(first, (Exponential, Polynomial, Power, Viscoelastic)) else "constant"
    return _of_tracks(columns, gas, form)


def _of_tracks(columns: Any, scene: GasScene, form: str) -> GasFit:
    species = scene.species[0]
    box, sides, gravity = scene.container.geometry, np.full(3, math.inf), np.zeros(3)
    gravity[: len(scene.gravity_vector)] = scene.gravity_vector
    for axis, (length, around) in enumerate(zip(box.size, box.periodic, strict=True)):
        sides[axis] = length if around else math.inf
    table, notes = collisions_of_tracks(dict(columns), species.nominal, sides, gravity)
    kappa = species.kappa(scene.container.dimensions)
    how: Any = {"bootstrap": 0, "profiles": False, "robust": True}
    ranking = fit(table, species.nominal, inertia=kappa, laws=["contact"], restitution=form, **how)
    assert isinstance(ranking, Ranking)
    estimates = dict(ranking.ranked[0].fit.estimates)
    if "friction" in estimates and (sliding := _sliding(table, estimates, species.nominal, kappa)) < MIN_SLIDING:
        least = estimates.pop("friction").value
        notes.append(
            f"friction is not told by these data: {counted(sliding, 'collision')} in {len(table)} slide"
            + ("" if least is None else f"; it is some {least:.2g} or more")
        )
    values, errors = {}, {}
    for name, one in estimates.items():
        if one.value is None:
            notes.append(f"{name} is not told by these data")
        elif one.stderr is None or not one.stderr > 0:
            notes.append(f"{name}: {one.value:.4g}, at the end of its range, has no error bar")
        else:
            values[name], errors[name] = float(one.value), float(one.stderr)
    return GasFit(values, errors, len(table["v_n_in"]), tuple(notes))


def _sliding(table: Rebounds, estimates: Any, radius: float, kappa: float) -> int:
    """Return how many collisions slide to their end: more friction would change them. (All, if spins are not known.)"""
    beta, mu = (estimates[name].value if name in estimates else None for name in ("tangential_restitution", "friction"))
    if beta is None or mu is None or not np.isfinite(table["spin_in"]).all():
        return len(table)
    slip = np.abs(table["v_t_in"] - radius * table["spin_in"])
    needed = (1 + beta) * kappa / (1 + kappa) * slip / (table["v_n_in"] + table["v_n_out"])
    return int((needed > mu).sum())
