"""A run as a page that plays it: the explorer with one law, or with a recorded run where the page cannot compute it."""

from __future__ import annotations

import base64
import gzip
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.explorer.module import MOST_BALLS, engine_layout
from carom.explorer.page import SEVERAL_LAWS, filled_page, not_shown, page_text
from carom.laws.law import Law
from carom.laws.registry import law_named, law_styles
from carom.scene.as_json import scene_dict
from carom.scene.wall import law_name
from carom.simulation.records import LOG
from carom.simulation.trajectory import Trajectory

__all__ = ["MOST_EVENTS_RUN", "MOST_ROWS", "player_page"]

# Up to so many events the page runs a scene itself (web/state/compute.js); a longer run is recorded, up to so many rows of its log:
# with more a browser no longer plays smoothly.
MOST_EVENTS_RUN, MOST_ROWS = 2000, 200_000
STATUS = {"nothing more happens": "quiet", "duration": "done", "max_events": "limit"}


def player_page(run: Trajectory, start: float, end: float, speed: float) -> str:
    """Return the HTML of a page that plays a run from ``start`` to ``end`` (s), ``speed`` seconds of it in one second.

    A run of at most 2,000 events under carom's own laws is computed by the page, from the scene, and the scene can be changed
    there. Any other is recorded: its log of events is in the page, and the motion between them is computed from it.

    Raises CaromError for a run of more than 200,000 events.

    Examples
    --------
    >>> import carom
    >>> ball = carom.SceneBall(radius=0.03, mass=0.2, position=(1, 0, 0), velocity=(-1, 0, 0))
    >>> run = carom.simulate(carom.Scene(gravity=0, balls=[ball], run=carom.Run(law="mirror", duration=2)))
    >>> player_page(run, 0.0, 2.0, 1.0).startswith("<!doctype html>")
    True
    """
    seen = {"span": [start, end], "time": start, "slow": speed}
    why = _why_recorded(run)
    if not why:
        name = SEVERAL_LAWS if _several(run) else law_name(run.scene.run.law)
        return page_text(run.scene, [name], seen=seen)
    rows = _rows(run, start, end)
    if len(rows) > MOST_ROWS + len(run.scene.balls):
        raise CaromError(
            f"animate: expected at most {MOST_ROWS:,} events in a page, got {len(rows):,}; take a shorter time: start=, end="
        )
    card = _card(run)
    about = f"{run.scene.describe()}; recorded: {why}"
    first = {"name": "scene", "title": "Recorded run", "about": about, "laws": [card["name"]]}
    recorded = {
        "log": base64.b64encode(gzip.compress(rows.tobytes(), mtime=0)).decode("ascii"),
        "status": STATUS[run.ended],
        "end": min(run.end, max(end, float(rows["t"].max(initial=0.0)))),
        "why": f"A recorded run ({why}): it is played, not computed anew.",
    }
    return filled_page(
        {
            "presets": [{**first, "scene": scene_dict(run.scene), **seen}],
            "cards": [card],
            "rebounds": [],
            "reboundsFrom": "",
            "recorded": recorded,
        }
    )


def _why_recorded(run: Trajectory) -> str:
    """Return why the page does not compute a run; empty if it does."""
    balls, events = len(run.scene.balls), len(run.events)
    if balls > MOST_BALLS:
        return f"{balls:,} balls"
    if events > MOST_EVENTS_RUN:
        return f"{events:,} events"
    return "a page does not show its walls or its law" if not_shown(run.scene, "") else ""


def _several(run: Trajectory) -> bool:
    return any(wall.law is not None for wall in run.scene.walls)


def _rows(run: Trajectory, start: float, end: float) -> NDArray[np.void]:
    """Return the log from ``start`` to ``end``, and before it the row in which each ball is at ``start``, in their order."""
    log = run.log
    before = log[log["t"] <= start]
    last = {int(ball): i for i, ball in enumerate(before["ball"])}
    first = before[[last[i] for i in range(len(run.scene.balls))]]
    rows = np.concatenate([first, log[(log["t"] > start) & (log["t"] <= end)]])
    # (the page reads the records by the layout of its module)
    assert rows.dtype == LOG
    assert LOG.itemsize == engine_layout()["records"]["log"]["bytes"]
    return rows


def _card(run: Trajectory) -> dict[str, Any]:
    """Description of the law of a recorded run, as the page shows it."""
    several, law = _several(run), run.scene.run.law
    card = (law if isinstance(law, Law) else law_named(law)).card
    name = SEVERAL_LAWS if several else law_name(law)
    colour, _dashes = law_styles([name])[name] if not several else ("#777777", None)
    summary = "Each wall with its own law." if several else card.summary
    valid = "" if several else card.valid
    return {"name": name, "summary": summary, "valid": valid, "colour": colour, "dashes": None, "reads": None}
