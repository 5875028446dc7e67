"""From tracks to contacts: clock, walls, events, fits; what could not be measured is named, with the reason."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.tracks.clock import step_of
from carom.tracks.contact import Contact, Settings, View
from carom.tracks.contacts import Event, Wall, find_events, find_walls
from carom.tracks.fits import Fits, Say
from carom.tracks.fitted import require_scipy
from carom.tracks.prepare import first_noise, prepared, view_of
from carom.tracks.track import Track

__all__ = ["Contact", "Measured", "Settings", "measure"]

Array = NDArray[np.float64]
SIDES = {"above": ("left", "right", "bottom", "top"), "side": ("bottom",)}


@dataclass(frozen=True, eq=False)
class Measured:
    """All that was found in some tracks."""

    tracks: tuple[Track, ...]
    """As they were fitted: seen frames only, on the camera's clock."""
    view: View
    walls: tuple[Wall, ...]
    events: dict[tuple[str, str], list[Event]]
    """By group and name of a track."""
    contacts: tuple[Contact, ...]
    noise: float
    """m."""
    noise_given: bool
    step: tuple[float, float]
    """m to which places were rounded, along each axis; 0 where there is no sign of it."""
    interval: float
    blind: tuple[float, float]
    """s before and after a contact whose frames were left out."""
    floor: dict[str, tuple[float, float]] = field(default_factory=dict)
    """What the fits say of the floor (friction, rolling resistance) or of gravity, each with its error."""
    notes: tuple[str, ...] = ()
    gravity: float = 9.80665
    """m/s^2, by which the friction of the floor is told."""

    @property
    def measured(self) -> list[Contact]:
        """Those contacts that were measured."""
        return [contact for contact in self.contacts if contact.fit is not None]


def measure(tracks: Sequence[Track], settings: Settings | None = None, say: Say | None = None) -> Measured:
    """Find and measure the contacts of tracks that were filmed with one camera, in one frame.

    ``say(done, total)`` is called as the fits go on. Raises CaromError for settings that make no sense, tracks in space, and
    where there is nothing to measure.
    """
    settings = settings or Settings()
    require_scipy()
    settings.check()
    if not tracks or not all(isinstance(track, Track) for track in tracks):
        raise CaromError(f"measure: tracks: expected one or more of carom.tracks' tracks, got {tracks!r:.60}")
    notes: list[str] = []
    seen, interval = prepared(tracks, notes)
    step = (step_of([t.position[:, 0] for t in seen]), step_of([t.position[:, 1] for t in seen]))
    noise = settings.noise if settings.noise is not None else first_noise(seen, interval, step)
    view = settings.view or view_of(seen, settings.gravity, notes)
    walls = settings.walls if settings.walls is not None else tuple(find_walls(seen, noise, SIDES[view]))
    groups: dict[str, list[Track]] = {}
    for track in seen:
        groups.setdefault(track.group, []).append(track)
    if settings.radius is None and any(len(members) > 1 for members in groups.values()):
        raise CaromError(
            "tracks: expected the balls' radius, since several were filmed together and may meet, got none;"
            " --radius 30.75mm, or --radius 0 if they cannot meet"
        )
    radii = 2 * settings.radius if settings.radius else None
    events = {
        (track.group, track.name): find_events(
            track, [other for other in groups[track.group] if other is not track], walls, noise, radii, interval
        )
        for track in seen
    }
    job = Fits(settings, view, {wall.name: wall for wall in walls}, interval, noise, (settings.blind or 0.0,) * 2)
    found = job.run(seen, events, notes, say)
    if not walls:
        notes.append("no wall: no ball turns back at the end of where the balls go (--wall gives one)")
    notes += _doubts(walls, events, job.floor, settings)
    return Measured(
        tuple(seen), view, walls, events, tuple(found), job.noise, settings.noise is not None, step, interval, job.blind,
        job.floor, tuple(notes), settings.gravity,
    )  # fmt: skip


def _doubts(
    walls: Sequence[Wall], events: dict[tuple[str, str], list[Event]], floor: dict[str, tuple[float, float]],
    settings: Settings,
) -> list[str]:  # fmt: skip
    """What looks like a wall in the wrong place, or a wrong scale, rate or view."""
    met = {event.what for some in events.values() for event in some}
    notes = [
        f"wall {wall.name}: no ball comes to it; --wall is where the ball's centre turns, in m"
        for wall in walls
        if not wall.found and wall.name not in met
    ]
    if "gravity" in floor and not abs(floor["gravity"][0] / settings.gravity - 1) < 0.1:
        notes.append(
            f"gravity is {floor['gravity'][0]:.3g} m/s^2 in this film and not {settings.gravity:.3g}: is the scale (--scale),"
            " the frame rate (--rate) or the view (--view) wrong?"
        )
    return notes
