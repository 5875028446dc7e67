"""What a session measured, as plain numbers: what ``carom gas --json`` gives, and more in full."""

from __future__ import annotations

import math
from dataclasses import asdict
from typing import Any

from carom.gas.channel import channels
from carom.gas.session import Session

__all__ = ["report", "series"]


def report(session: Session) -> dict[str, Any]:
    """The run after equilibration: what the event loop measured, then each species, each kind of contact, diffusion."""
    mark, measures, run = session.mark, session.measures, session.result
    assert mark is not None
    assert measures is not None
    found = {name: value for name, value in run.to_dict().items() if name != "crossings"}
    energy = session.gas.energy()
    found |= {
        "events": session.done,
        "time": session.gas.time,
        "balls": session.scene.count,
        "packing_fraction": session.scene.fraction,
        "energy_start": sum(mark.energy),
        "energy_end": sum(energy),
        "looks": measures.looks,
        "diffusion": measures.displacement().diffusion if measures.diffuses and measures.steady else math.nan,
        "species": {},
        "channels": [asdict(channel) for channel in channels(session.gas, mark, session.names)],
    }
    for name in session.names:
        translational, rotational = measures.temperature(name)
        looked = measures.looks > 0
        found["species"][name] = {
            "temperature_translational": translational if looked else math.nan,
            "temperature_rotational": rotational if looked else math.nan,
            "a2_translational": measures.velocity(name).a2 if looked else math.nan,
            "a2_rotational": measures.spin(name).a2 if looked else math.nan,
        }
    return found


def series(session: Session) -> dict[str, Any]:
    """What is drawn, as lists: the series over time, distributions, pair correlations, displacement."""
    measures = session.measures
    assert measures is not None
    found: dict[str, Any] = {"series": {name: values.tolist() for name, values in measures.series.items()}}
    for what, of in (("velocity", measures.velocity), ("spin", measures.spin)):
        found[f"{what}_distribution"] = {
            name: {
                "component": (one := of(name)).center.tolist(),
                "density": one.density.tolist(),
                "error": one.error.tolist(),
                "maxwell": one.maxwell.tolist(),
            }
            for name in session.names
        }
    pairs = []
    for i, first in enumerate(session.names):
        for second in session.names[i:]:
            g = measures.pair_correlation(first, second)
            pairs.append(
                {
                    "between": [first, second],
                    "distance": g.distance.tolist(),
                    "g": g.g.tolist(),
                    "error": g.error.tolist(),
                    "contact": g.contact,
                }
            )
    found["pair_correlation"] = pairs
    if measures.diffuses:
        moved = measures.displacement()
        found["displacement"] = {"lag": moved.lag.tolist(), "square": moved.square.tolist()}
    return found
