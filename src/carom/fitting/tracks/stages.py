"""Which part of a simulation leaves the frames: distances through none, one, two, ... contacts."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from carom.fitting.tracks.fit import with_best_sidespins
from carom.fitting.tracks.objective import settle
from carom.fitting.tracks.result import TrackFit
from carom.formatting import format_length

__all__ = ["distances_through_contacts", "failing_part"]

Array = NDArray[np.float64]
LEAST_SEGMENTS = 3  # for a median
CLOTH = 3.0  # times the noise: larger distances before any contact are the cloth's
GROWTH = 1.5  # from one number of contacts to the next, for which the contacts are to blame


def distances_through_contacts(fit: TrackFit) -> Array:
    """Return the median over segments of the RMS distance (m) up to the first contact, through one contact, two, ...

    Each start is fitted anew to the frames of its stage alone, with the shared parameters of the fit, so that no stage pays for a
    later one. Stages with fewer than LEAST_SEGMENTS segments are left out.
    """
    table, found = fit.model.table(fit.numbers), []
    for contacts in range(1 + max(len(one.contacts) for one in fit.frames.segments)):
        which = np.array([n for n, one in enumerate(fit.frames.segments) if len(one.contacts) >= contacts])
        if len(which) < LEAST_SEGMENTS:
            break
        frames, starts, q = fit.frames.until(contacts).pick(which), fit.starts.pick(which), fit.q[which]
        if contacts:
            q = with_best_sidespins(fit.model, frames, starts, q, fit.numbers)
        gap = settle(table, frames, starts, q).gap * frames.sigma[:, None]
        found.append(float(np.median(np.sqrt((gap * gap).sum(axis=1) / frames.count))))
    return np.array(found)


def failing_part(distances: Sequence[float] | Array, noise: float) -> str:
    """Return a sentence on where a law leaves the frames; empty if there are too few segments to tell.

    Examples
    --------
    >>> from carom.fitting.tracks.stages import failing_part
    >>> print(failing_part([0.0007, 0.002, 0.005], 0.0004))
    distance from the frames up to the first contact: 700 µm, through 1 contact: 2 mm, through 2: 5 mm (noise of a frame: 566 µm); \
worst described: the contacts
    """
    if not len(distances):
        return ""
    of_frame = float(np.sqrt(2.0)) * noise
    stages = [f"up to the first contact: {format_length(distances[0])}"]
    stages += [
        f"through {n}{' contact' if n == 1 else ''}: {format_length(distance)}"
        for n, distance in enumerate(distances[1:], 1)
    ]
    worst = []
    if distances[0] > CLOTH * of_frame:
        worst.append("the motion on the cloth before any contact (a slope, an obstacle that was not tracked)")
    if any(after > GROWTH * before for before, after in pairwise(distances)):
        worst.append("the contacts")
    said = f"distance from the frames {', '.join(stages)} (noise of a frame: {format_length(of_frame)})"
    return f"{said}; worst described: {', '.join(worst)}" if worst else said
