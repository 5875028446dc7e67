"""Restitution, friction and tangential restitution of a gas, from tracks of its balls or its temperatures: ``carom fit gas``."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from carom.data.columns import as_columns, is_columns, read_columns
from carom.errors import FaultList, did_you_mean
from carom.files import as_path
from carom.fitting.fit_files import fit
from carom.fitting.gas_collisions import collisions_of_tracks
from carom.fitting.gas_curves import CURVES, GasCurve, curve_numbers, fit_curve, of_balls, restitution_form
from carom.fitting.ranking import Ranking
from carom.fitting.result import Estimate, estimate_dict
from carom.gas.build import load_gas
from carom.gas.scene import GasScene
from carom.public.progress import Progress

__all__ = ["GasFit", "fit_gas"]

TRACKS = ("t", "ball", "x", "y")


@dataclass(frozen=True)
class GasFit:
    """Numbers of the contacts of a gas's balls, with standard errors."""

    values: dict[str, float]
    errors: dict[str, float]
    data: str
    """From which they are: "tracks" or "curve"."""
    rows: int
    """Collisions found in tracks, or times of a curve."""
    notes: tuple[str, ...] = ()
    intervals_95: dict[str, tuple[float, float]] = field(default_factory=dict)
    """By profile likelihood, of numbers from a curve (of which value ± error is the interval of 68 %); none of tracks."""

    def estimates(self) -> dict[str, Estimate]:
        """Return value, error bar and interval of each number."""
        found = {}
        for name, x in self.values.items():
            error, wide = self.errors[name], self.intervals_95.get(name)
            found[name] = Estimate(x, error, "", (x - error, x + error) if wide else None, wide)
        return found

    def to_dict(self) -> dict[str, Any]:
        """Return the results as plain numbers."""
        parameters = {name: estimate_dict(one) for name, one in self.estimates().items()}
        return {"parameters": parameters, "data": self.data, "rows": self.rows, "notes": list(self.notes)}


def fit_gas(
    file: str | Path | Any,
    scene: str | Path | GasScene,
    *,
    names: Sequence[str] | None = None,
    simulations: int = 80,
    seed: int = 0,
    progress: Progress | None = None,
) -> GasFit:
    """Infer restitution, friction and tangential restitution of the balls of a gas, with error bars.

    Parameters
    ----------
    file : path, or columns
        Tracks of free balls: columns ``t``, ``ball``, ``x``, ``y``, maybe ``z`` and spins ``wz`` (``wx``, ``wy``), a row per ball
        and frame. Each collision of two balls in them is a rebound, to which the contact law is fitted. Or curves: columns ``t``
        and ``temperature``, ``temperature_rotational`` or ``ratio`` (rotational to translational), maybe with relative standard
        errors ``sigma_temperature``, ...; they are compared with those of simulated gases.
    scene : path or GasScene
        The gas: container, number, radius and inertia of the balls; of curves the numbers that are not inferred, too.
    names : sequence of str, optional
        What is inferred from a curve. Default: restitution and, with rotational temperatures, tangential_restitution. Tracks tell
        all. Where the scene's restitution has a form of the speed, the numbers of the form stand in its place: ``restitution_c`` of
        a viscoelastic contact, ``restitution_at_rest`` and so on.
    simulations : int
        Gases simulated in each of four rounds, for a curve.
    seed : int
        Of these.
    progress : callable(done, total, text), optional

    Returns
    -------
    GasFit
        Of a curve, value ± error is the interval of 68 % by profile likelihood, and ``intervals_95`` has those of 95 %, which may
        be longer on one side. Raises CaromError, one line per problem.

    Examples
    --------
    >>> from carom.fitting import fit_gas
    >>> fit_gas({"t": [0.0, 1.0]}, "gas.toml")
    Traceback (most recent call last):
    carom.errors.CaromError: fit_gas: expected tracks (columns t, ball, x, y) or curves (t and temperature or ratio), got t
    """
    where = "fit_gas"
    if is_columns(file):
        columns = as_columns(file, where)
    else:
        path = as_path(where, file)
        where, columns = str(path), read_columns(path)[0]
    curves = [name for name in CURVES if name in columns]
    is_track = set(TRACKS) <= set(columns)
    faults, arguments = FaultList(where), FaultList("fit_gas")
    if not is_track and not ("t" in columns and curves):
        expected = f"tracks (columns {', '.join(TRACKS)}) or curves (t and temperature or ratio)"
        faults.add("", expected, f"{', '.join(columns)}")
    if is_track and names:
        arguments.add("names", "none with tracks, which tell all", f"{', '.join(names)}", "omit it")
    if isinstance(simulations, bool) or not simulations >= 20:
        arguments.add("simulations", "a whole number >= 20", f"{simulations!r}")
    if isinstance(scene, GasScene) or not faults:
        gas = scene if isinstance(scene, GasScene) else load_gas(scene)
        if not any(of_balls(gas, one) for one in gas.contacts):
            faults.add("contacts", "a contact of the balls in the scene", "none")
        else:
            known = list(curve_numbers(gas, 1.0))
            for name in names or ():
                if name not in known:
                    arguments.add("names", f"some of {', '.join(known)}", f"{name!r}", did_you_mean(name, known))
    faults += arguments
    faults.raise_if_any()
    return (
        _of_tracks(columns, gas)
        if is_track
        else _of_curves(where, columns, curves, gas, names, simulations, seed, progress)
    )


def _of_tracks(columns: Any, scene: GasScene) -> GasFit:
    species = scene.species[0]
    box, sides = scene.container.geometry, np.full(3, math.inf)
    for axis, (length, around) in enumerate(zip(box.size, box.periodic, strict=True)):
        sides[axis] = length if around else math.inf
    table, notes = collisions_of_tracks(dict(columns), species.nominal, sides)
    kappa = species.kappa(scene.container.dimensions)
    form = restitution_form(scene)
    how: Any = {"bootstrap": 0, "profiles": False, "robust": True}
    ranking = fit(table, species.nominal, inertia=kappa, laws=["contact"], restitution=form, **how)
    assert isinstance(ranking, Ranking)
    estimates = ranking.ranked[0].fit.estimates
    values, errors = {}, {}
    for name, one in estimates.items():
        if one.value is None:
            notes.append(f"{name} is not told by these data")
        elif one.stderr is None or not one.stderr > 0:
            notes.append(f"{name}: {one.value:.4g}, at the end of its range, has no error bar")
        else:
            values[name], errors[name] = float(one.value), float(one.stderr)
    return GasFit(values, errors, "tracks", len(table["v_n_in"]), tuple(notes))


def _of_curves(
    where: str, columns: Any, curves: Sequence[str], scene: GasScene, names: Sequence[str] | None, simulations: int, seed: int,
    progress: Progress | None,
) -> GasFit:  # fmt: skip
    faults = FaultList(where)
    t = np.asarray(columns["t"], dtype=float)
    values = {name: np.asarray(columns[name], dtype=float) for name in curves}
    errors = {name: np.asarray(columns.get(f"sigma_{name}", np.zeros(len(t))), dtype=float) for name in curves}
    if len(t) < 2 or not np.isfinite(t).all() or not (np.diff(t) > 0).all():
        faults.add("t", "two or more times, each later than the one before", f"{len(t)} values")
    for name, column in values.items():
        if not ((column > 0) & (column < math.inf)).all():
            faults.add(name, "numbers > 0", f"{column[~((column > 0) & (column < math.inf))][0]:g}")
    for name, column in errors.items():
        if not ((column >= 0) & (column < 1)).all():
            faults.add(f"sigma_{name}", "relative standard errors from 0 to 1", "others")
    faults.raise_if_any()
    if names is None:
        names = [name for name in curve_numbers(scene, 1.0) if name.startswith("restitution")]
        names += [] if list(curves) == ["temperature"] else ["tangential_restitution"]
    curve = GasCurve(t, values, errors)
    found, notes = fit_curve(curve, scene, names, simulations, seed, progress)
    return GasFit(
        {name: float(ends[0].mean()) for name, ends in found.items()},
        {name: float(np.ptp(ends[0])) / 2 for name, ends in found.items()},
        "curve", len(t), tuple(notes), {name: (float(ends[1, 0]), float(ends[1, 1])) for name, ends in found.items()},
    )  # fmt: skip
