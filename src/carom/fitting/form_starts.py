"""Starting values of a restitution that depends on the speed, from the measured ratios of normal speeds.

A form of three numbers has several valleys, and a grid of starting values may miss the one of the data: a polynomial whose vertex
lies below the least measured speed is constant over the table, and the deviance there does not depend on two of its coefficients.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from carom.fitting.parameters import viscous_loss

__all__ = ["form_starts"]

Array = NDArray[np.float64]
SPEED_SHARES = (0.3, 1.0, 3.0)  # of the median speed: over which an exponential is tried
LEAST_SPEEDS = 3
MOST_RATIO = 1.2  # of normal speeds: larger ones are errors of measurement


def form_starts(form: str, speed: Array, ratio: Array) -> list[tuple[float, ...]]:
    """Return starting values of a form's parameters, by least squares.

    Parameters
    ----------
    form : str
        One of :data:`carom.fitting.parameters.FORMS`.
    speed, ratio : (N,)
        Normal speed of the approach, m/s, and the ratio of the normal speeds after and before; NaN: not measured.

    Returns
    -------
    list of tuples, empty for a constant, and where fewer than three different speeds were measured.

    Examples
    --------
    >>> import numpy as np
    >>> speed = np.array([4.0, 8.0, 12.0])
    >>> [[round(x, 4) for x in one] for one in form_starts("polynomial", speed, 0.95 - 0.03 * speed + 0.001 * speed**2)]
    [[0.95, -0.03, 0.001]]
    """
    good = np.isfinite(speed) & np.isfinite(ratio) & (speed > 0)
    v, e = speed[good], np.clip(ratio[good], 1e-3, MOST_RATIO)
    if len(np.unique(v)) < LEAST_SPEEDS:
        return []
    if form in ("polynomial", "line"):
        coefficients = np.polyfit(v, e, 2)[::-1] if form == "polynomial" else np.polyfit(v, e * v, 1)
        return [tuple(coefficients.tolist())]
    if form == "power":
        slope, height = np.polyfit(np.log(v / v.min()), np.log(e), 1)
        return [(float(np.exp(height)), float(v.min()), -float(slope))]
    if form == "viscoelastic":
        return [(float(np.median(viscous_loss(e) / v**0.2)),)]
    if form == "exponential":
        found: list[tuple[float, ...]] = []
        for share in SPEED_SHARES:
            over = share * float(np.median(v))
            fall = np.exp(-v / over)
            (far, rise), *_ = np.linalg.lstsq(np.stack([np.ones_like(v), fall], axis=-1), e, rcond=None)
            found.append((float(far + rise), float(far), over))
        return found
    return []
