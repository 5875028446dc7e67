"""Measured collisions of two balls as rebounds of one: what a fit of restitution and friction between balls takes."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.data.rebounds import Rebounds, make_rebounds
from carom.errors import CaromError, first_bad_index, float_array

__all__ = ["rebounds_of_collisions"]

Array = NDArray[np.float64]


def rebounds_of_collisions(
    before: ArrayLike, after: ArrayLike, struck: ArrayLike, centres: ArrayLike, *, sigma_v: ArrayLike | None = None
) -> Rebounds:
    """Return collisions of a rolling ball with an equal one at rest as rebounds, whose laws a fit compares.

    By their relative velocity two balls meet as one meets a wall (:func:`carom.collide`), and a ball that rolls without sidespin
    meets one at rest as a rolling ball does. So `carom.fit(table, radius, laws=["contact", "maw"], spin="0")` gives restitution and
    friction between the balls, with error bars.

    Parameters
    ----------
    before, after : array (N, 2)
        Velocity of the striking ball along the table just before the collision and just after it, before the cloth has bent its
        path, m/s.
    struck : array (N, 2)
        Velocity of the ball that was at rest, just after the collision.
    centres : array (N, 2)
        From the centre of the striking ball to the centre of the other as they touch; any length.
    sigma_v : float or array (N,), optional
        One standard deviation of each component of these velocities, m/s.

    Returns
    -------
    Rebounds
        Of the kind "table", stage "after_wall". Raises CaromError for arrays of other shapes, a line of centres of zero length, or
        balls that do not approach.

    Examples
    --------
    >>> from carom.data import rebounds_of_collisions
    >>> table = rebounds_of_collisions([[1.0, 0.0]], [[0.26, 0.42]], [[0.74, -0.42]], [[0.866, -0.5]], sigma_v=0.01)
    >>> table["v_n_in"].round(3).tolist(), table["v_n_out"].round(3).tolist(), table["v_t_out"].round(3).tolist()
    ([0.866], [0.836], [0.487])
    """
    given = {"before": before, "after": after, "struck": struck, "centres": centres}
    arrays = {name: float_array(value) for name, value in given.items()}
    shape = (len(np.atleast_1d(arrays["before"])), 2)
    for name, array in arrays.items():
        if array.shape != shape:
            raise CaromError(f"rebounds_of_collisions: {name}: expected an array of shape {shape}, got {array.shape}")
    u, v, w, line = arrays.values()
    length = np.linalg.norm(line, axis=1)
    if (length == 0).any():
        bad = first_bad_index(length == 0)
        raise CaromError(f"rebounds_of_collisions: centres: expected a direction, got zero length{bad}")
    n = line / length[:, None]
    t = np.stack([-n[:, 1], n[:, 0]], axis=1)
    relative = v - w
    columns: dict[str, ArrayLike] = {
        "v_n_in": (u * n).sum(axis=1), "v_t_in": (u * t).sum(axis=1),
        "v_n_out": -(relative * n).sum(axis=1), "v_t_out": (relative * t).sum(axis=1),
    }  # fmt: skip
    if sigma_v is not None:
        sigma = np.broadcast_to(float_array(sigma_v), shape[:1])
        columns |= {f"sigma_{name}": sigma * (1 if name.endswith("in") else np.sqrt(2)) for name in list(columns)}
    return make_rebounds("table", columns, stage="after_wall", source="collisions")
