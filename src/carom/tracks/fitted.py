"""One contact, measured: the motions before and after it, fitted together, so that they meet at the wall.

The frame is the wall's: the first coordinate is the distance from it along its normal, the second along it, counter-clockwise
from the normal. On a table the ball slides or rolls before, and slides, then rolls after; in the air it flies. The time of
the contact is a parameter and lies between frames. Least squares by scipy (the extra ``carom[fit]``); error bars from the
Jacobian at the solution, with the noise as given or as the residuals have it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError

__all__ = ["OUTPUTS", "Fitted", "Prior", "differences", "guess", "require_scipy", "solve", "told", "unseen"]

Array = NDArray[np.float64]
Model = Callable[[Array], Array]

# What a fit tells, by place in ``Fitted.value``. Velocities and slips in the wall's frame (away from the wall, along it).
OUTPUTS = (
    "t", "away", "along", "vn_in", "vt_in", "vn_out", "vt_out", "vn_roll", "vt_roll",
    "un_in", "ut_in", "un_out", "ut_out", "mu_g", "c_g", "slides",
)  # fmt: skip


@dataclass(frozen=True)
class Prior:
    """What is known of the floor beforehand: decelerations while sliding and rolling, m/s^2, each with its error; and the variance
    between contacts, None for a contact that is not among those of which the floor is had."""

    mu_g: float = 2.0
    mu_g_error: float = 0.8
    c_g: float = 0.08
    c_g_error: float = 0.06
    k: float = 2 / 7
    mu_g_between: float | None = None
    c_g_between: float | None = None


@dataclass(frozen=True, eq=False)
class Fitted:
    """A contact that was fitted."""

    value: Array
    """(16,): see OUTPUTS."""
    covariance: Array
    """(16, 16), for the noise ``noise``."""
    noise: float
    """m, of one coordinate of one frame: what was assumed."""
    chi2: float
    dof: float
    """Numbers tracked, less what they alone told of the parameters: what is known besides told the rest."""
    residuals: Array
    """(n, 2) m: tracked less fitted; of a mean of m frames, times sqrt(m)."""
    time: Array
    """(n,) s."""
    slid: bool
    """Whether the ball still slid at the first frame before the contact, as far as the track shows."""
    places: Callable[[Array], Array]
    """Times (m,) to places (m, 2) in the wall's frame."""
    on: bool = False
    """Whether it slid until the contact, so that no frame tells how much slip was left."""
    theta: Array = field(default_factory=lambda: np.zeros(0))
    """The parameters that were fitted, from which another fit can go on."""

    def __getitem__(self, name: str) -> float:
        """A value by its name in OUTPUTS."""
        return float(self.value[OUTPUTS.index(name)])

    def error(self, name: str) -> float:
        """Its standard deviation."""
        i = OUTPUTS.index(name)
        return float(np.sqrt(max(self.covariance[i, i], 0.0)))

    def covaries(self, name: str, other: str) -> float:
        """The covariance of two values."""
        return float(self.covariance[OUTPUTS.index(name), OUTPUTS.index(other)])

    def told(self, name: str) -> bool:
        """Whether the frames tell a value: not the slip of a ball that slides on until the contact, or until its last frames."""
        if name in ("un_in", "ut_in"):
            return not self.on
        if name in ("un_out", "ut_out", "vn_roll", "vt_roll", "slides"):
            left = float(self.time[-1]) - self["t"] - self["slides"]
            return left > 0 and left > unseen(self["mu_g"], self.noise, self.time)
        return bool(np.isfinite(self[name]))

    def scaled(self, noise: float) -> Fitted:
        """The same fit for another noise (the prior's share stays as it is: a second fit takes it up)."""
        return replace(self, covariance=self.covariance * (noise / self.noise) ** 2, noise=noise)


def unseen(mu_g: float, noise: float, time: Array) -> float:
    """For how long a ball may roll, or slide, in place of the other, before frames (n,) show it: s.

    Its way bends by mu g / 2 t^2, which has to come to a few times the noise, and a frame has to be there.
    """
    return float(np.sqrt(5 * noise / mu_g) + np.median(np.diff(time)))


def require_scipy() -> None:
    """CaromError where scipy is not installed."""
    import importlib.util

    if importlib.util.find_spec("scipy") is None:
        raise CaromError(
            "tracks: contacts are fitted with scipy, which is not installed; run: pip install 'carom[fit]'"
        )


def differences(f: Model, theta: Array, step: Array) -> Array:
    """Central differences (rows, parameters)."""
    columns = []
    for j, h in enumerate(step):
        up, down = theta.copy(), theta.copy()
        up[j] += h
        down[j] -= h
        columns.append((f(up) - f(down)) / (2 * h))
    return np.stack(columns, axis=-1)


def solve(
    residual: Model, slope: Model, theta: Array, scale: Array, bounds: tuple[Array, Array] | None = None,
    tolerance: float = 1e-9,
) -> tuple[Array, float]:  # fmt: skip
    """Least squares by scipy: the parameters, and the sum of squares.

    MINPACK's way first, which is several times as quick and knows no bounds; where it ends beyond one, the way that does.
    """
    from scipy.optimize import least_squares, leastsq

    low, high = bounds if bounds is not None else (np.full(len(theta), -np.inf), np.full(len(theta), np.inf))
    start = np.clip(theta, low + 1e-12, high - 1e-12)
    beyond = np.full(len(residual(start)), 1e3)

    def within(part: Array) -> Array:
        return residual(part) if (part >= low).all() and (part <= high).all() else beyond

    best, _cov, info, _said, why = leastsq(
        within, start, Dfun=slope, diag=1 / scale, ftol=tolerance, xtol=tolerance, gtol=0.0, maxfev=60, full_output=True
    )
    if why in (1, 2, 3, 4) and (best > low).all() and (best < high).all():
        return np.asarray(best), float(info["fvec"] @ info["fvec"])
    found = least_squares(
        residual, start, jac=slope, x_scale=scale, bounds=(low, high), method="trf",
        xtol=tolerance, ftol=tolerance, gtol=tolerance, max_nfev=60,
    )  # fmt: skip
    return found.x, float(2 * found.cost)


def told(
    best: Array, free: NDArray[np.bool_], residual: Model, slope: Array, outputs: Model, places: Model, scale: Array, time: Array,
    noise: float, slid: bool, on: bool = False,
) -> Fitted:  # fmt: skip
    """Error bars: from parameters to what is told, by derivatives at the solution."""
    step = 1e-4 * scale
    slope = slope[:, free]
    inverse = np.linalg.pinv(slope.T @ slope, rcond=1e-14, hermitian=True)
    n = 2 * len(time)
    spent = float(np.einsum("ij,jk,ik->", slope[:n], inverse, slope[:n]))
    rate = differences(outputs, best, step)[:, free]
    r = residual(best)
    gap = r[:n].reshape(-1, 2) * noise
    chi2 = float(r[:n] @ r[:n])
    return Fitted(
        outputs(best), rate @ inverse @ rate.T, noise, chi2, n - spent, gap, time, slid, places, on,
    )  # fmt: skip


def guess(time: Array, position: Array, before: NDArray[np.bool_], after: NDArray[np.bool_], near_time: float) -> Array:
    """Where to start from (7,): time, place, velocities, by straight lines through the frames next to the contact."""
    near, then = np.flatnonzero(before)[-8:], np.flatnonzero(after)[:6]
    theta = np.zeros(7)
    lines = [np.polyfit(time[rows] - near_time, position[rows], 1) for rows in (near, then)]
    (v0, x0), (v1, x1) = lines
    rate = v0[0] - v1[0]
    t = (x1[0] - x0[0]) / rate if abs(rate) > 1e-9 else 0.0
    t = float(np.clip(t, time[near[-1]] - near_time, time[then[0]] - near_time))
    theta[0] = near_time + t
    theta[1:3] = (x0 + v0 * t + x1 + v1 * t) / 2
    theta[3:5], theta[5:7] = v0, v1
    return theta
