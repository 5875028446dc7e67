"""Events of a run: one by one as records, all of them, or the events of some kinds or of one ball."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import NDArray

from carom.bodies import State
from carom.core.motion.phases import PHASES
from carom.errors import CaromError, Fault, did_you_mean
from carom.formatting import html_table
from carom.laws.results import REGIME_NAMES as NAMES
from carom.scene.paths import ball_index
from carom.simulation.contacts.kinds import partner_names
from carom.simulation.records import EVENT_KINDS, kind_names
from carom.simulation.run_record import RunRecord
from carom.simulation.tables import events_table

if TYPE_CHECKING:
    import pandas

__all__ = ["Event", "Events"]

Array = NDArray[np.float64]
HTML_ROWS = 20  # of events in a notebook


@dataclass(frozen=True, eq=False)
class Event:
    """One event of one ball. An impact of two balls is two events, one for each; of several at once, as in a rack, one for each.

    Examples
    --------
    >>> import carom
    >>> run = carom.simulate("carom", duration=1)
    >>> hit = run.events.of("wall")[0]
    >>> hit.name, hit.regime, round(hit.t, 3), round(hit.energy_lost, 3)
    ('cushions', 'stick', 0.692, 0.264)
    """

    t: float
    """s."""
    kind: str
    """ "wall", "floor", "ball"; "rolling", "pivoting", "rest": the phase that begins; "settled": the end of infinitely many
    bounces; "left": it cleared a wall; "held": a force presses it on a wall or a ball, and it is followed no further;
    "pocketed": it fell into a pocket, and is followed no further."""
    ball: int
    other: int
    """Number of the wall, of the other ball (the first of several), or of the pocket (in ``scene.pocket_names``); -1 for none."""
    name: str
    """Name of the wall, of the other ball, or of the pocket; empty for none."""
    phase: str
    """The phase that begins: flight, sliding, rolling, pivoting, rest, bouncing, held, left, pocketed."""
    before: State
    after: State
    """Velocity, spin, position."""
    impulse: Array
    """(3,), N s, on the ball."""
    floor_impulse: Array
    """(3,), N s: of the floor, while a wall pressed the ball on it."""
    required_friction: float
    """The least coefficient of friction with which the contact would have stuck."""
    regime: str
    """Regime of the contact: "stick", "slide", ...; empty if there was none."""
    energy_lost: float
    """J, of this ball (negative for a ball that is struck)."""

    @property
    def position(self) -> Array:
        """Of the centre at the event (3,), m."""
        assert self.after.position is not None
        return self.after.position

    @property
    def velocity(self) -> Array:
        """After the event (3,), m/s."""
        return self.after.velocity

    @property
    def spin(self) -> Array:
        """After the event (3,), rad/s."""
        return self.after.spin


class Events(Sequence[Event]):
    """The events of a run, in order of time.

    Examples
    --------
    >>> import carom
    >>> run = carom.simulate("carom", duration=1)
    >>> run.events
    <40 events: 2 ball, 31 floor, 2 rolling, 2 settled, 3 wall>
    >>> run.events.of("wall", ball="white").t.round(3)
    array([0.798, 0.991])
    """

    def __init__(self, run: RunRecord, rows: NDArray[np.void]) -> None:
        self._run = run
        self.rows = rows

    def __len__(self) -> int:
        """Return the number of events."""
        return len(self.rows)

    @overload
    def __getitem__(self, index: int) -> Event: ...
    @overload
    def __getitem__(self, index: slice) -> Events: ...
    def __getitem__(self, index: int | slice) -> Event | Events:
        """Return one event, or a slice of them."""
        if isinstance(index, slice):
            return Events(self._run, self.rows[index])
        return _event(self._run, self.rows[index])

    def __iter__(self) -> Iterator[Event]:
        """Iterate over the events."""
        return (self[i] for i in range(len(self)))

    def of(self, *kinds: str, ball: int | str | None = None) -> Events:
        """Return the events of some kinds (:attr:`Event.kind`; default: all), and of one ball, by number or name (default: of all).

        Raises CaromError for a kind that no event has, with the nearest one, and for an unknown ball.
        """
        if strange := [kind for kind in kinds if kind not in EVENT_KINDS]:
            raise CaromError(
                *(
                    Fault(
                        "Events.of",
                        "",
                        f"a kind of {', '.join(EVENT_KINDS)}",
                        repr(one),
                        did_you_mean(one, EVENT_KINDS),
                    )
                    for one in strange
                )
            )
        names = kind_names(self.rows)
        keep = np.isin(names, kinds) if kinds else np.ones(len(self), dtype=bool)
        if ball is not None:
            keep &= self.rows["ball"] == ball_index(self._run.scene, ball)
        return Events(self._run, self.rows[keep])

    @property
    def t(self) -> Array:
        """Return their times (N,), s."""
        return np.array(self.rows["t"])

    @property
    def kinds(self) -> list[str]:
        """Return their kinds."""
        return list(kind_names(self.rows))

    def table(self) -> pandas.DataFrame:
        """Return a pandas DataFrame, one row per event. CaromError without pandas."""
        return events_table(self._run, self.rows)

    def __repr__(self) -> str:
        """Return how many there are of each kind."""
        names, counts = np.unique(kind_names(self.rows), return_counts=True)
        listed = ", ".join(f"{count} {name}" for name, count in zip(names, counts, strict=True))
        return f"<{len(self)} events: {listed}>" if listed else "<no events>"

    def _repr_html_(self) -> str:
        """Return a table for notebooks: the first events."""
        names = self._run.scene.ball_names
        rows = []
        for one in itertools.islice(self, HTML_ROWS):
            place = np.concatenate([np.asarray(one.after.position), one.after.velocity])
            rows.append((f"{one.t:.6g}", names[one.ball], one.kind, one.name, *(f"{x:.4g}" for x in place)))
        rest = f"<p>and {len(self) - HTML_ROWS:,} more</p>" if len(self) > HTML_ROWS else ""
        return html_table(("t, s", "ball", "event", "with", "x, m", "y", "z", "v_x, m/s", "v_y", "v_z"), rows) + rest


def _event(run: RunRecord, row: Any) -> Event:
    i, met, other = int(row["ball"]), int(row["met"]), int(row["other"])
    x = np.array(row["x"])
    before = State.of(np.array(row["v_before"]), np.array(row["w_before"]), x)
    after = State.of(np.array(row["v"]), np.array(row["w"]), x)
    names = partner_names(run.scene, met)
    return Event(
        t=float(row["t"]),
        kind=str(kind_names(row)),
        ball=i,
        other=other,
        name=names[other] if names else "",
        phase=PHASES[row["phase"]],
        before=before,
        after=after,
        impulse=np.array(row["impulse"]),
        floor_impulse=np.array(row["floor_impulse"]),
        required_friction=float(row["required"]),
        regime="" if row["regime"] < 0 else str(NAMES[row["regime"]]),
        energy_lost=float(
            run.kinetic_energy(i, before.velocity, before.spin) - run.kinetic_energy(i, after.velocity, after.spin)
        ),
    )
