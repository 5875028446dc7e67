"""Objections of a run to the laws of its walls and pairs: energy created, balls left moving into what they have met."""

from __future__ import annotations

from typing import Any

import numpy as np

from carom.formatting import counted, format_number
from carom.laws.registry import laws
from carom.scene.wall import law_name
from carom.simulation.contacts.wall import wall_normal
from carom.simulation.records import BALL, CLUSTERS, START, WALL, are_in_clusters
from carom.simulation.trajectory import Trajectory

__all__ = ["law_notes"]

ROUNDING = 1e-9  # of the energy, or the speed
LOOKED_AT = 1000  # contacts of a law, for the direction in which balls leave


def law_notes(run: Trajectory) -> list[str]:
    """Return a line for each law that creates energy, and for each custom one that leaves a ball moving into what it has met."""
    rows = run.log[(run.log["kind"] == WALL) & ~are_in_clusters(run.log)]
    names = np.array([law_name(law) for law in run.scene.wall_laws], dtype=object)[rows["other"]]
    found = []
    for name in dict.fromkeys(names):
        own = rows[names == name]
        found += _created(run, name, own, own[:0])
        if name not in laws() and (row := _into_the_wall(run, own[:LOOKED_AT])) is not None:
            found.append(
                f"law {name} leaves the ball moving into the wall: first {_where(run, row)}; expected n . v >= 0 after it"
            )
    return found + _notes_on_pairs(run)


def _notes_on_pairs(run: Trajectory) -> list[str]:
    """Return the lines on the law by which two balls meet, where no contacts overlap in time."""
    name = law_name(run.scene.ball_contact.law)
    kinds = np.append(run.log["kind"], START)
    first = np.flatnonzero(kinds == BALL)[::2]
    first = first[~np.isin(kinds[first + 2], CLUSTERS)]
    rows, others = run.log[first], run.log[first + 1]
    found = _created(run, name, rows, others)
    n, v = rows["x"] - others["x"], rows["v"] - others["v"]
    sizes = np.linalg.norm(n, axis=1) * (np.linalg.norm(rows["v"], axis=1) + np.linalg.norm(others["v"], axis=1))
    meets = np.flatnonzero((n * v).sum(axis=1) < -ROUNDING * sizes)
    if name not in laws() and len(meets):
        where = _where(run, rows[meets[0]])
        found.append(f"law {name} leaves two balls moving into each other: first {where}; expected n . v >= 0 after it")
    return found + _replaced(run, name, int(np.unique(run.log["t"][np.isin(run.log["kind"], CLUSTERS)]).size))


def _replaced(run: Trajectory, name: str, clusters: int) -> list[str]:
    """Return a line where contacts of balls that overlap in time did not have the law of the pair, but friction alone."""
    contact = run.scene.ball_contact
    law = laws().get(name)
    if not clusters or not ((law is None or not law.one_contact) or contact.tangential_restitution != 0):
        return []
    what = f"law {name}" if law is None or not law.one_contact else "tangential restitution"
    return [
        f"{what} did not act in {counted(clusters, 'event')} in which contacts overlap in time: friction there is Coulomb's, and a"
        " contact whose slip ends goes on without slip (0.006 to 0.017 of the speed from contacts that store slip, at a friction of"
        " 0.05)"
    ]


def _created(run: Trajectory, name: str, rows: Any, others: Any) -> list[str]:
    """Return a line if a law creates energy in contacts; ``others`` are the second balls, where balls meet."""
    with np.errstate(over="ignore", invalid="ignore"):  # (a law that doubles speeds soon has no number for the energy)
        before, after = (
            sum(np.asarray(run.kinetic_energy(x["ball"], x[v], x[w])) for x in (rows, others) if len(x))
            for v, w in (("v_before", "w_before"), ("v", "w"))
        )
        gained = np.asarray(after - before)
        created = gained > ROUNDING * before
    if not created.any():
        return []
    in_all = f"{counted(int(created.sum()), 'contact')}, {format_number(float(gained[created].sum()))} J in all"
    first = int(created.argmax())
    where, energy = _where(run, rows[first]), format_number(float(gained[first]))
    return [f"law {name} creates energy: first {where}, {energy} J; {in_all}"]


def _where(run: Trajectory, row: Any) -> str:
    names = run.scene.ball_names if row["met"] == BALL else run.scene.wall_names
    return f"at t = {float(row['t']):.4g} s, {run.scene.ball_names[row['ball']]} at {names[row['other']]}"


def _into_the_wall(run: Trajectory, rows: Any) -> Any:
    """Return the first of a log's rows after which a ball moves into the wall that it has met; None for none."""
    features = run.scene.features().view(np.recarray)
    for row in rows:
        n = np.array(wall_normal(features, row, run.scene.balls[row["ball"]].radius))
        if n @ row["v"] < -ROUNDING * np.linalg.norm(row["v"]):
            return row
    return None
