"""Measurement of the contacts in tracks: camera clock, walls, events and fits; each contact not measured has a reason."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from itertools import chain

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.files import require_library
from carom.tracks.camera import unlisted_turns, without_turned
from carom.tracks.clock import on_camera_clock
from carom.tracks.contact import BlindTime, Settings, TrackContact, View, certainly_sharp, turns_smoothly
from carom.tracks.contact_fits import ContactFitter, Progress
from carom.tracks.elsewhere import (
    Turn,
    elsewhere_notes,
    facing_up,
    find_turns,
    floor_of_turns,
    only_level,
    with_turns,
)
from carom.tracks.events import TrackEvent, WallLine, find_events, find_walls
from carom.tracks.flights import (
    STILL_AIR,
    Air,
    air_and_notes,
    axis_points_down,
    constant_acceleration,
    falls_freely,
    moves_on_a_table,
    what_would_give,
)
from carom.tracks.floor import WithError
from carom.tracks.least_squares import WHITE, Correlation
from carom.tracks.plausibility import (
    GRAVITY_TOLERANCE,
    MIN_JUDGED,
    restitution_note,
    restitutions_in_words,
    shared_error_notes,
    why_implausible,
)
from carom.tracks.preprocess import guess_view, initial_noise, rounding_step, without_outliers
from carom.tracks.track import Track

Array = NDArray[np.float64]
OF_VIEW: dict[View, str] = {"above": "from above", "side": "from the side"}
KIND_OF_MOTION: dict[View, str] = {"above": "a ball on a table", "side": "a ball in flight"}
SIDES = {"above": ("left", "right", "bottom", "top"), "side": ("bottom",)}


@dataclass(frozen=True, eq=False)
class Measured:
    """Result of a measurement: walls, events, contacts, noise and floor.

    Examples
    --------
    >>> import numpy as np
    >>> from carom.tracks import Settings, Track, measure
    >>> t = np.arange(40) / 100
    >>> ball = Track("ball", t, np.stack([np.abs(0.2 - t), 0.1 * t], axis=-1))
    >>> found = measure([ball], Settings(view="above", noise=1e-4))
    >>> [wall.name for wall in found.walls], len(found.contacts)
    (['left'], 1)
    """

    tracks: tuple[Track, ...]
    """The tracks as fitted: only frames in which the ball was found, with times on the camera's clock."""
    view: View
    walls: tuple[WallLine, ...]
    events: dict[tuple[str, str], list[TrackEvent]]
    """By group and name of a track."""
    contacts: tuple[TrackContact, ...]
    noise: float
    """Standard deviation of one coordinate of one frame, m."""
    noise_given: bool
    step: tuple[float, float]
    """Step to which positions were rounded along each axis, m; 0 if there is no sign of rounding."""
    interval: float
    """Between frames, s."""
    blind: BlindTime
    """Times before and after a contact whose frames were excluded, s."""
    floor: dict[str, WithError] = field(default_factory=dict)
    """Estimates from all contacts: ``floor friction`` and ``rolling resistance``, or ``gravity`` (m/s^2) and, if the
    flights show it, ``air drag`` (1/m), with their errors."""
    air: Air = STILL_AIR
    """Of a film from the side: the direction of gravity and the drag that the velocities at contacts allow for."""
    notes: tuple[str, ...] = ()
    gravity: float = 9.80665
    """m/s^2, by which decelerations were divided to give the friction of the floor."""
    radius: float | None = None
    """Radius of the balls, m; None if it was not given."""
    kappa: float = 2 / 5
    """I/(m a^2)."""
    correlation: float = 0.0
    """Correlation of the noise between neighbouring frames; 0 where the frames show none."""
    frame_correlation: Correlation = WHITE
    """The same between frames any time apart."""
    window: float = 0.5
    """Longest time before and after a contact that a fit uses, s."""
    view_reason: str = ""
    """Why the view was taken for what it is; empty if it was given."""

    @property
    def measured(self) -> list[TrackContact]:
        """The contacts that were measured."""
        return [contact for contact in self.contacts if contact.fit is not None]


def measure(tracks: Sequence[Track], settings: Settings | None = None, progress: Progress | None = None) -> Measured:
    """Find and measure the contacts of balls with walls in tracks filmed with one camera.

    On both sides of a contact the motion is fitted by the physics: sliding and rolling with friction on a table, parabolas in
    flight; the two motions meet at the wall. Floor, noise and blind time are estimated from all contacts together. A view that
    is not given is guessed from the acceleration of the ball; if contacts are impossible in it and not in the other, that is
    taken.

    Parameters
    ----------
    tracks : sequence of Track
        In one coordinate system, m and s; tracks of one ``group`` were filmed together.
    settings : Settings, optional
        Prior knowledge of the film.
    progress : callable(done, total), optional
        Called after each fit.

    Returns
    -------
    Measured
        Walls, events, contacts, noise and floor.

    Raises
    ------
    CaromError
        For settings out of range, tracks with three coordinates, an unknown radius where balls may meet, and without SciPy.

    Examples
    --------
    A ball in flight bounces at t = 0.1 s:

    >>> import numpy as np
    >>> from carom.tracks import Settings, Track, measure
    >>> t = np.arange(40) / 200
    >>> y = np.where(t < 0.1, 2 * (0.1 - t), 1.6 * (t - 0.1)) - 9.81 / 2 * (t - 0.1) ** 2
    >>> found = measure([Track("ball", t, np.stack([0.5 * t, y], axis=-1))], Settings(view="side", noise=1e-4))
    >>> contact = found.contacts[0]
    >>> contact.wall.name, round(contact.time, 6), round(contact.fit["vn_out"], 3)
    ('bottom', 0.1, 1.6)
    """
    settings = settings or Settings()
    found = _measured(tracks, settings, progress)
    if all(one.sigma_time is None for one in tracks):
        return found
    # (an error that all times have in common: what it changes, once more with it)
    late = [one if one.sigma_time is None else replace(one, time=one.time + one.sigma_time) for one in tracks]
    others = _measured(late, replace(settings, view=found.view), None).measured
    return replace(found, contacts=tuple(_with_change(one, others) for one in found.contacts))


def _with_change(contact: TrackContact, others: Sequence[TrackContact]) -> TrackContact:
    """Return a contact whose covariance has the change of its values to those of the same contact among others."""
    same = [
        one
        for one in others
        if (one.group, one.track, one.wall.name) == (contact.group, contact.track, contact.wall.name)
    ]
    near = min(same, key=lambda one: abs(one.time - contact.time), default=None)
    if contact.fit is None or near is None or near.fit is None:
        return contact
    change = np.nan_to_num(near.fit.value - contact.fit.value)
    return replace(contact, fit=replace(contact.fit, covariance=contact.fit.covariance + np.outer(change, change)))


def _measured(tracks: Sequence[Track], settings: Settings, progress: Progress | None) -> Measured:
    require_library("scipy", "tracks")
    settings.check()
    if not tracks or not all(isinstance(track, Track) for track in tracks):
        raise CaromError(f"measure: tracks: expected one or more carom.tracks.Track, got {tracks!r:.60}")
    notes: list[str] = []
    seen, interval = on_camera_clock(tracks, notes)
    seen = without_outliers(seen, interval, settings.gravity, notes)
    step = (rounding_step([t.position[:, 0] for t in seen]), rounding_step([t.position[:, 1] for t in seen]))
    noise = settings.noise if settings.noise is not None else initial_noise(seen, interval, step)
    groups: dict[str, list[Track]] = {}
    for track in seen:
        groups.setdefault(track.group, []).append(track)
    if settings.radius is None and any(len(members) > 1 for members in groups.values()):
        raise CaromError(
            "tracks: expected the balls' radius, since several were filmed together and may meet, got none;"
            " `radius` 30.75mm, or `radius` 0 if they cannot meet"
        )
    _require_axis_up(seen, settings)
    film = Measured(
        tracks=tuple(seen), view="above", walls=(), events={}, contacts=(), noise=noise, noise_given=settings.noise is not None,
        step=step, interval=interval, blind=BlindTime(*(settings.blind or 0.0,) * 2), gravity=settings.gravity,
        radius=settings.radius or None, kappa=settings.kappa, window=settings.window,
    )  # fmt: skip
    if settings.view is not None:
        found = _in_view(film, settings.view, settings, groups, progress)
    else:
        found = _in_likely_view(film, settings, groups, progress)
    return replace(found, notes=(*notes, *found.notes, *restitution_note(found.contacts)))


def _require_axis_up(tracks: Sequence[Track], settings: Settings) -> None:
    """Raise CaromError if a ball filmed from the side falls upward."""
    if settings.view == "above":
        return
    upward = axis_points_down(tracks, settings.gravity)
    if upward:
        raise CaromError(
            f"tracks: expected positions that count upward, but the ball falls upward, with {upward:.3g} m/s^2: they count"
            " downward, as in pictures; give `down` (y with the other sign), or `view` above if the ball is on a table"
        )
    across = [replace(track, position=track.position[:, ::-1]) for track in tracks]
    for sign, side in ((1, "left"), (-1, "right")):
        if falls_freely(across, sign * settings.gravity) and not falls_freely(tracks, settings.gravity):
            raise CaromError(
                f"tracks: expected a second axis that points up, but the ball falls to the {side}: the picture lies on its side;"
                " exchange x and y, or `view` above if the ball is on a table"
            )


def _flight_gravity(tracks: Sequence[Track], gravity: float) -> float:
    """Return the acceleration with which flights are fitted, m/s^2: gravity, or another if the ball falls with that throughout."""
    fall = -constant_acceleration(tracks)
    return fall if fall > 0 and abs(fall / gravity - 1) > GRAVITY_TOLERANCE else gravity


def _in_likely_view(
    film: Measured, settings: Settings, groups: dict[str, list[Track]], progress: Progress | None
) -> Measured:
    """Measure in the view that the motion suggests; where the contacts are impossible there, in the other, if they are not."""
    view, why = guess_view(film.tracks, settings.gravity)
    gravity = _flight_gravity(film.tracks, settings.gravity)
    other: View = "above" if view == "side" else "side"
    found = _in_view(film, view, settings, groups, progress)
    wrong = why_implausible(found.contacts, view, found.floor, gravity)
    certain = view == "side" and falls_freely(film.tracks, settings.gravity) > 0
    unsure = not certain and not moves_on_a_table(film.tracks, settings.gravity) and gravity == settings.gravity
    second, wrong_too, doubts = None, "", list[str]()
    if (wrong and not certain) or unsure:
        second = _in_view(film, other, settings, groups, progress)
        wrong_too = why_implausible(second.contacts, other, second.floor, gravity)
        if not wrong_too and turns_smoothly(found.contacts) and not certainly_sharp(second.contacts):
            wrong_too = "the frames show no velocity that jumps"
        if wrong and not wrong_too and len(second.measured) >= MIN_JUDGED:
            found, second, view, other, why, wrong = second, found, other, view, f"{OF_VIEW[view]}, {wrong}", ""
    if wrong:
        also = f"; {OF_VIEW[other]}, {wrong_too}" if wrong_too else ""
        doubts.append(
            f"the motion fits no view: {OF_VIEW[view]}, {wrong}{also}. Is it a ball on a curved rail, another scale or frame"
            f" rate? Trust none of these contacts, or try `view` {other}"
        )
    elif unsure and second is not None and second.measured:
        doubts.append(
            f"the frames do not show for sure from where it was filmed; {OF_VIEW[other]} (`view` {other}), out/in is"
            f" {restitutions_in_words(second.contacts)}"
        )
    said = f"assumed to be filmed {OF_VIEW[view]}, {KIND_OF_MOTION[view]}: {why} (`view` {other} overrides this)"
    return replace(found, view_reason=why, notes=(said, *doubts, *found.notes))


def _in_view(
    film: Measured, view: View, settings: Settings, groups: dict[str, list[Track]], progress: Progress | None
) -> Measured:
    """Find and measure the contacts of a film in a view."""
    gravity = _flight_gravity(film.tracks, settings.gravity) if view == "side" else settings.gravity
    air, notes = STILL_AIR, list[str]()
    if view == "side":
        given = settings.walls is not None
        air, notes = air_and_notes(film.tracks, film.noise, film.interval, gravity, settings.drag_per_metre, given)
    walls = settings.walls
    turns = dict[tuple[str, str], list[Turn]]()
    if view == "side":
        turns = {
            (one.group, one.name): find_turns(one, film.noise, air.down, gravity, film.interval) for one in film.tracks
        }
    if walls is None:
        walls = tuple(find_walls(film.tracks, film.noise, SIDES[view], air.down))
        walls = floor_of_turns(walls, [*chain.from_iterable(turns.values())], air.down)
    elif view == "side":
        walls = tuple(facing_up(wall, film.tracks, film.noise, air.down) for wall in walls)
    radii = 2 * settings.radius if settings.radius else None

    def events_in(track: Track, noise: float) -> list[TrackEvent]:
        others = [other for other in groups[track.group] if other is not track]
        found = find_events(track, others, walls, noise, radii, film.interval)
        if view == "above":
            return found
        return with_turns(found, track, walls, noise, air.down, turns[track.group, track.name], film.interval)

    def fitted(noise: float) -> tuple[ContactFitter, list[TrackContact], list[str]]:
        """Fit the contacts that stand out of a noise."""
        events.update({(track.group, track.name): events_in(track, noise) for track in film.tracks})
        lines, said = {wall.name: wall for wall in walls}, list[str]()
        job = ContactFitter(replace(settings, gravity=gravity), view, lines, film.interval, film.noise, film.blind, air)
        return job, job.run(list(film.tracks), events, said, progress), said

    events = dict[tuple[str, str], list[TrackEvent]]()
    job, contacts, said = fitted(film.noise)
    # neighbouring frames differ by less than correlated noise, so that a ball at rest on the floor seems to bounce
    if (
        view == "side"
        and job.correlation != WHITE
        and any(events_in(track, job.noise) != events[track.group, track.name] for track in film.tracks)
    ):
        job, contacts, said = fitted(job.noise)
    if view == "side":
        contacts = only_level(contacts, walls, settings.kappa / (1 + settings.kappa))
        lost = sum(turn.lost and turn.meets for turn in chain.from_iterable(turns.values()))
        notes += elsewhere_notes(chain.from_iterable(events.values()), len(walls) > 1, lost)
    notes += said
    if view == "above":
        turned = list[str]()
        if settings.walls is None:
            contacts, turned = without_turned(contacts, film.tracks, events, film.noise, film.interval)
        unlisted = unlisted_turns(film.tracks, events, film.interval)
        notes += turned or elsewhere_notes(unlisted, len(walls) > 1, 0)
    notes += shared_error_notes(contacts, air)
    if not walls:
        notes.append("no wall found: no ball turns back at an extreme of the positions (`wall` gives one)")
    other = what_would_give(gravity, settings.gravity, film.interval) if gravity != settings.gravity else ""
    notes += _plausibility_notes(
        walls, events, job.floor.get("gravity", WithError(gravity, 0.0)).value, other, settings
    )
    return replace(
        film, view=view, walls=walls, events=events, contacts=tuple(contacts), noise=job.noise,
        correlation=job.correlation.neighbours, frame_correlation=job.correlation, blind=job.blind, air=air,
        floor=job.floor | ({"air drag": WithError(air.drag_per_metre, air.drag_error)} if air.drag_shown else {}),
        notes=tuple(notes),
    )  # fmt: skip


def _plausibility_notes(
    walls: Sequence[WallLine], events: dict[tuple[str, str], list[TrackEvent]], gravity: float, other: str,
    settings: Settings,
) -> list[str]:  # fmt: skip
    """Return notes on signs of a misplaced wall, or of a wrong scale, rate or view.

    ``gravity``: from the film, m/s^2; ``other``: the change that would make it the setting's, if known.
    """
    met = {event.what for some in events.values() for event in some}
    notes = [
        f"wall {wall.name}: no ball reaches it; `wall` is the line at which the ball's centre is reflected, in m"
        for wall in walls
        if not wall.found and wall.name not in met
    ]
    if not abs(gravity / settings.gravity - 1) < 0.1:
        notes.append(
            f"gravity is {gravity:.3g} m/s^2 in this film instead of {settings.gravity:.3g}: is the scale (`scale`),"
            f" the frame rate (`rate`) or the view (`view`) wrong?{f' {other[0].upper()}{other[1:]}' if other else ''}"
        )
    return notes
