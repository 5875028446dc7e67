"""Walls that are none: corners of a path in the picture of a camera that was turned, where no wall parallel to its axes stands."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from carom.errors import shortened_list
from carom.tracks.contact import TrackContact
from carom.tracks.least_squares import ContactFit
from carom.tracks.turned_camera import TURNED

__all__ = ["is_oblique", "needs_lines", "oblique_note", "without_oblique"]

OBLIQUE = (
    "a corner of the path, not a wall: velocities change more along walls parallel to the picture's axes than friction can change"
    " them; give the wall's line by two points"
)
# Of the change of the velocity across the wall: friction changes the velocity along it by less. Cushions have 0.1 to 0.3. A ball
# that grips the wall loses at most k (1 + beta) of its slip; one with running spin becomes faster along the wall, which is rare.
MAX_FRICTION, MAX_FASTER, ERRORS = 0.5, 0.35, 3.0
DOUBTFUL = 0.3  # a friction that few cushions have, from which a note is given


def is_oblique(fit: ContactFit, k: float) -> bool:
    """Return whether the velocity changes more along a wall than friction can change it; k = kappa / (1 + kappa)."""
    along, across = fit["vt_out"] - fit["vt_in"], fit["vn_out"] - fit["vn_in"]
    error = ERRORS * float(np.hypot(fit.error("vt_out"), fit.error("vt_in")))
    if along * fit["vt_in"] > 0:
        return abs(along) - error > MAX_FASTER * across
    return abs(along) - error > max(MAX_FRICTION * across, 2 * k * abs(fit["vt_in"]))


def without_oblique(contacts: Sequence[TrackContact], k: float) -> list[TrackContact]:
    """Return the contacts without those at walls that were found, and are none; without all of these if half of them are none."""
    at_found = [one for one in contacts if one.fit is not None and one.wall.found]
    none = [one for one in at_found if one.fit is not None and is_oblique(one.fit, k)]
    gone = at_found if 2 * len(none) >= len(at_found) and none else none
    return [replace(one, fit=None, why=OBLIQUE) if any(one is other for other in gone) else one for one in contacts]


def oblique_note(contacts: Sequence[TrackContact]) -> list[str]:
    """Return a note on walls that are none, and on what is left of the others: the camera was turned."""
    names = list(dict.fromkeys(one.wall.name for one in contacts if one.why == OBLIQUE))
    if names:
        walls = f"wall {names[0]} is none" if len(names) == 1 else f"walls {shortened_list(names)} are none"
        return [
            f"{walls}: the ball's path has corners there, but what turned it was not parallel to the picture's axes. The camera was"
            " turned: give the walls' lines by two points each, or turn the positions"
        ]
    steep = [
        ratio for one in contacts if one.fit is not None and one.wall.found if (ratio := _needed(one.fit)) > DOUBTFUL
    ]
    if not steep:
        return []
    return [
        f"the velocity changes along the walls as with a friction of {max(steep):.2f}, or as with a camera turned by up to"
        f" {np.degrees(np.arctan(max(steep))):.0f} degrees: the walls found are taken to be parallel to the picture's axes;"
        " give their lines by two points each if they are not"
    ]


def needs_lines(contacts: Sequence[TrackContact]) -> bool:
    """Return whether the lines of the walls should be given: the camera was turned, or may have been."""
    return any(one.why == TURNED for one in contacts) or bool(oblique_note(contacts))


def _needed(fit: ContactFit) -> float:
    """Return the friction that the change of the velocity along the wall needs, beyond its error; a gain of speed counts twice."""
    along, across = fit["vt_out"] - fit["vt_in"], fit["vn_out"] - fit["vn_in"]
    error = ERRORS * float(np.hypot(fit.error("vt_out"), fit.error("vt_in")))
    return (abs(along) - error) / max(across, 1e-12) * (2.0 if along * fit["vt_in"] > 0 else 1.0)
