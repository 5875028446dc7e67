"""Objections of a run to the laws of its walls: energy created, balls left moving into the wall."""

from __future__ import annotations

from typing import Any

import numpy as np

from carom.formatting import counted, format_number
from carom.laws.registry import laws
from carom.scene.wall import law_name
from carom.simulation.narrate import wall_normal
from carom.simulation.records import WALL
from carom.simulation.trajectory import Trajectory

__all__ = ["law_notes"]

ROUNDING = 1e-9  # of the energy, or the speed
LOOKED_AT = 1000  # contacts of a law, for the direction in which balls leave


def law_notes(run: Trajectory) -> list[str]:
    """Return a line for each law that creates energy, and for each custom one that leaves balls moving into the wall."""
    rows = run.log[run.log["kind"] == WALL]
    with np.errstate(over="ignore", invalid="ignore"):  # (a law that doubles speeds soon has no number for the energy)
        before = np.asarray(run.kinetic_energy(rows["ball"], rows["v_before"], rows["w_before"]))
        gained = np.asarray(run.kinetic_energy(rows["ball"], rows["v"], rows["w"]) - before)
    known = {law.name for law in laws().values()}
    names = np.array([law_name(law) for law in run.scene.wall_laws], dtype=object)[rows["other"]]
    found = []
    for name in dict.fromkeys(names):
        own = names == name
        created = own & (gained > ROUNDING * before)
        if created.any():
            in_all = f"{counted(int(created.sum()), 'contact')}, {format_number(float(gained[created].sum()))} J in all"
            first = int(created.argmax())
            found.append(
                f"law {name} creates energy: first {_where(run, rows[first])}, {format_number(float(gained[first]))} J; {in_all}"
            )
        if name not in known and (row := _into_the_wall(run, rows[own][:LOOKED_AT])) is not None:
            found.append(
                f"law {name} leaves the ball moving into the wall: first {_where(run, row)}; expected n . v >= 0 after it"
            )
    return found


def _where(run: Trajectory, row: Any) -> str:
    ball, wall = run.scene.ball_names[row["ball"]], run.scene.wall_names[row["other"]]
    return f"at t = {float(row['t']):.4g} s, {ball} at {wall}"


def _into_the_wall(run: Trajectory, rows: Any) -> Any:
    """Return the first of a log's rows after which a ball moves into the wall that it has met; None for none."""
    features = run.scene.features().view(np.recarray)
    for row in rows:
        n = np.array(wall_normal(features, row, run.scene.balls[row["ball"]].radius))
        if n @ row["v"] < -ROUNDING * np.linalg.norm(row["v"]):
            return row
    return None
