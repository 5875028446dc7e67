"""A film in which balls were tracked: places, times, outline of each frame, and the pixels around a ball."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError, Fault
from carom.formatting import counted
from carom.tracks.video.reading import Array, Bytes, open_film

Mask = NDArray[np.bool_]
AROUND = 1.6  # radii that a crop shows around the middle of the ball


@dataclass(frozen=True, eq=False)
class TrackedFilm:
    """Balls tracked in a film, in pixels: x to the right and y down, from the middle of the first pixel of the upright picture.

    F is the number of frames.
    """

    path: Path
    times: Array
    """(F,) s, from the first frame on: the middle of each exposure, in the row of the picture's middle."""
    places: Mapping[str, Array]
    """By ball: (F, 2) px, the middle of its outline; NaN where it was not seen."""
    radius_px: float
    """Radius of the balls, px."""
    outline_cost: Array
    """(F,) mean square misfit of the outline, 1 for the usual frame; the worst of the balls, NaN where none was seen."""
    flagged: Mask
    """(F,): frames in which the outline of a ball does not fit."""
    exposure: float
    """s."""
    psf: float
    """Standard deviation of the blur of the camera, px."""
    background: Bytes
    """(H, W, 3): red, green, blue of the picture without what moves."""
    velocity_px: Mapping[str, Array]
    """By ball: (F, 2) px/s, in the frame; NaN where it was not seen."""
    notes: tuple[str, ...] = ()
    used: Mapping[str, Mask] = field(default_factory=dict)
    """By ball: (F,) frames whose place is used: seen, not flagged, without a contact within the exposure."""

    def __repr__(self) -> str:
        """Return one line: the number of balls and frames."""
        balls = ", ".join(f"{name} {int(np.isfinite(x[:, 0]).sum())}" for name, x in self.places.items())
        return f"<TrackedFilm {self.path.name}: {counted(len(self.times), 'frame')}; seen: {balls}>"


class Crop(NamedTuple):
    """Pixels around a ball in a frame."""

    frame: int
    corner: tuple[int, int]
    """x, y of the first pixel, px."""
    pixels: Bytes
    """(h, w, 3): red, green, blue; parts beyond the picture's edge are left out."""


def crops(film: TrackedFilm, ball: str, frames: Sequence[int]) -> Iterator[Crop]:
    """Yield the pixels around a ball in some frames, in the order of the film; frames in which it was not seen are left out.

    Each shows 1.6 radii around the middle, and the way of the exposure. The film is read again from its beginning.
    Raises CaromError for a ball that is none of the film's, and if the film can no longer be read.
    """
    if ball not in film.places:
        raise CaromError(Fault("crops", "ball", f"one of {', '.join(film.places)}", repr(ball)))
    file, wanted = open_film(film.path), {int(k) for k in frames}
    last = max(wanted, default=-1)
    for frame in file.frames() if wanted else ():
        if frame.number > last:
            return
        x, y = film.places[ball][frame.number] if frame.number < len(film.times) else (np.nan, np.nan)
        if frame.number not in wanted or not np.isfinite(x):
            continue
        way = np.nan_to_num(film.velocity_px[ball][frame.number]) * film.exposure / 2
        (left, right), (top, bottom) = (
            np.clip([middle - half, middle + half], 0, most).astype(int) // 2 * 2
            for middle, half, most in zip(
                (x, y), AROUND * film.radius_px + np.abs(way) + 2, frame.y.shape[::-1], strict=True
            )
        )
        if right > left and bottom > top:
            rows, columns = slice(top, bottom), slice(left, right)
            halves = slice(top // 2, bottom // 2), slice(left // 2, right // 2)
            pixels = file.to_rgb(frame.y[rows, columns], frame.u[halves], frame.v[halves])
            yield Crop(frame.number, (int(left), int(top)), pixels)
