"""Which shots to film next: ``carom design``, in Python ``carom.design``, for rebounds in files and in memory."""

from __future__ import annotations

import inspect
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from carom.bodies import inertia_number
from carom.data.columns import as_rebounds
from carom.data.rebound_files import read_rebounds
from carom.data.rebounds import KINDS, STAGES, Rebounds
from carom.errors import FaultList
from carom.fitting.design import Plan, Shots, require_plan
from carom.fitting.design import design as plan_shots
from carom.fitting.rows import Setting, spin_of_rows
from carom.public.defaults import ANGLES_DEG, DESIGNED_LAWS, ODDS, RADIUS, SIGMA_V, SPEEDS, SPINS


def design(
    file: str | Path | Rebounds | Any | None = None,
    laws: str | Sequence[str] = DESIGNED_LAWS,
    *,
    radius: float = RADIUS,
    inertia: str | float = "solid",
    kind: str | None = None,
    stage: str = "after_wall",
    truth: Mapping[str, float] | None = None,
    contact_height: float | None = None,
    floor_friction: float | None = None,
    angles_deg: tuple[float, float] = ANGLES_DEG,
    speeds: tuple[float, float] = SPEEDS,
    spins: tuple[float, float] | str = SPINS,
    spin: float | str | None = None,
    sigma_v: float = SIGMA_V,
    sigma_spin: float | None = None,
    odds: float = ODDS,
    fine: bool = False,
) -> Plan:
    """Find the shots that discriminate best between two laws, and how many are needed: ``carom design``.

    Parameters
    ----------
    file : path, columns or Rebounds, optional
        Rebounds measured so far; their evidence counts.
    laws : two names, or "TRUE,OTHER"
        Two laws; the first is assumed to be true.
    radius : float
        Radius, m.
    inertia : str or float
        "solid", "hollow" or I/(m a^2).
    kind : str, optional
        "planar" (ball in flight) or "table" (ball on a table). Default: that of the file, else planar.
    stage : str
        Stage at which a ball on a table is measured: after_wall or rolling.
    truth : mapping, optional
        Parameters of the first law by name. Default: fitted to the file.
    contact_height : float, optional
        Height of the contact above the floor, in ball radii; billiard cushions: 1.25 to 1.4. Default: 1.
    floor_friction : float, optional
        Friction of the floor. Default: what the file says, else 0.2.
    angles_deg : pair
        Angles of incidence, degrees from the normal.
    speeds : pair
        Speeds, m/s.
    spins : pair
        Spin before the wall, rad/s; unknown if not measured.
    spin : float or str, optional
        Unmeasured spins before the wall in the file: rad/s at the first contact of each ball, or a prior, as for
        :func:`carom.fit`. Default: normal, mean along v_t and width fitted.
    sigma_v : float
        Standard error of speeds, m/s.
    sigma_spin : float, optional
        Standard error of spins, rad/s. Default: spin is not measured.
    odds : float
        Target odds, N to 1.
    fine : bool
        Whether the gain is computed on a finer grid too, for a picture.

    Returns
    -------
    Plan

    Raises
    ------
    CaromError
        One line per problem.

    Examples
    --------
    >>> import carom
    >>> plan = carom.design(laws="sliding,mirror", truth={"restitution": 0.8, "friction": 0.2}, speeds=(2.0, 2.0))
    >>> plan.laws, plan.count
    (('sliding', 'mirror'), 1)
    """
    filmed, of, setting, pair, shots = _checked(SimpleNamespace(**locals()))
    return plan_shots(
        of or "planar", setting, pair, shots, dict(truth) if truth else None, odds=odds, filmed=filmed, spin=spin, fine=fine
    )  # fmt: skip


def check_design(**options: Any) -> None:
    """Raise CaromError, one line per problem, for arguments of :func:`design` that it refuses before it begins."""
    bound = inspect.signature(design).bind(**options)
    bound.apply_defaults()
    _checked(SimpleNamespace(**bound.arguments))


def _checked(asked: SimpleNamespace) -> tuple[Rebounds | None, Any, Setting, tuple[str, str], Shots]:
    """Return the rebounds filmed so far, the kind of rebound, the setting, the two laws and the shots to come."""
    file, laws, kind, spin = asked.file, asked.laws, asked.kind, asked.spin
    faults = FaultList()
    kappa = faults.attempt(inertia_number, asked.inertia)
    prior: dict[str, Any] = (faults.attempt(spin_of_rows, spin) or (None, {}))[1]
    if spin is not None and file is None:
        faults.add("`spin`", "a file of rebounds with it", "none", "`spins` describes the shots to come")
    pair = tuple(part.strip() for part in laws.split(",") if part.strip()) if isinstance(laws, str) else tuple(laws)
    if kind not in (None, *KINDS):
        faults.add("`kind`", "planar or table", repr(kind))
    read = read_rebounds if isinstance(file, str | os.PathLike) else as_rebounds
    filmed: Rebounds | None = None if file is None else faults.attempt(read, file)
    clash = filmed is not None and kind not in (None, filmed.kind)
    if filmed is not None:
        if clash:
            faults.add("`kind`", f"{filmed.kind}, the kind of {filmed.source}", str(kind), "omit it")
        kind = filmed.kind
    if not clash and kind in (None, "planar") and (file is None or filmed is not None):
        given = {"stage": asked.stage in STAGES[1:], "contact_height": asked.contact_height is not None,
                 "floor_friction": asked.floor_friction is not None}  # fmt: skip
        for name in (name for name, there in given.items() if there):
            faults.add(f"`{name}`", "a ball on a table", "one in flight", "choose `kind` table, or omit it")
    spins = None if asked.spins == "unknown" else asked.spins
    shots = Shots(asked.angles_deg, asked.speeds, spins, asked.sigma_v, asked.sigma_spin, asked.stage)
    setting = Setting(
        radius=asked.radius, kappa=0.4 if kappa is None else kappa, contact_height=asked.contact_height,
        floor_friction=asked.floor_friction, **prior,
    )  # fmt: skip
    faults.attempt(require_plan, setting, pair, shots, dict(asked.truth or {}), asked.odds)
    faults.raise_if_any()
    return filmed, kind, setting, (pair[0], pair[1]), shots
