"""Least squares for one contact: the motions before and after it are fitted together and meet at the wall.

Vectors are in the frame of the wall: the first component is the distance from the wall along its normal, the second runs
along the wall, counter-clockwise from the normal. The time of the contact is a parameter and lies between frames. The
minimisers are SciPy's (the extra ``carom[fit]``); error bars are computed from the Jacobian at the solution, with the noise as
given or as estimated from the residuals.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from carom.tracks.correlation import FittedFrames

__all__ = [
    "AT_CONTACT",
    "OUTPUTS",
    "ContactFit",
    "Prior",
    "central_differences",
    "contact_fit",
    "solve",
    "starting_values",
    "unresolved_time",
]

Array = NDArray[np.float64]
Model = Callable[[Array], Array]

# The quantities of a contact, in the order of ``ContactFit.value``. Velocities (v) and slips (u) have a component away from the
# wall (n) and one along it (t); in: before the contact, out: after it, roll: once the ball rolls again.
OUTPUTS = (
    "t", "away", "along", "vn_in", "vt_in", "vn_out", "vt_out", "vn_roll", "vt_roll",
    "un_in", "ut_in", "un_out", "ut_out", "mu_g", "c_g", "slides", "hop",
)  # fmt: skip
# Of these, time, place and velocities of the contact itself, which every fit has.
AT_CONTACT = slice(OUTPUTS.index("t"), OUTPUTS.index("vt_out") + 1)
START_IN, START_OUT = slice(3, 5), slice(5, 7)  # velocities of :func:`starting_values`


@dataclass(frozen=True)
class Prior:
    """Prior knowledge of the floor: decelerations in m/s^2, each with its standard deviation."""

    mu_g: float = 2.0
    """While the ball slides: friction times gravity."""
    mu_g_error: float = 0.8
    c_g: float = 0.08
    """While it rolls: rolling resistance times gravity."""
    c_g_error: float = 0.06
    k: float = 2 / 7
    """kappa / (1 + kappa)."""
    mu_g_between: float | None = None
    """Variance of mu_g between contacts; None for a contact that has no weight in the estimate of the floor."""
    c_g_between: float | None = None


@dataclass(frozen=True, eq=False)
class ContactFit:
    """A fitted contact: values, covariances and residuals.

    ``fit["vn_in"]`` is a value by its name in OUTPUTS: ``t`` (s); the place ``away`` from the wall's line and ``along`` it (m);
    velocities ``vn_in``, ``vt_in`` before the contact, ``vn_out``, ``vt_out`` after it, ``vn_roll``, ``vt_roll`` once the ball
    rolls again (m/s; n away from the wall, t along it); slips ``un_in`` ... ``ut_out`` on the floor (m/s); decelerations ``mu_g``
    while sliding and ``c_g`` while rolling (m/s^2; in flight the components of gravity); ``slides``, the time after the contact
    until the ball rolls, and ``hop``, how long of that it flies (s). NaN for what does not apply.

    Examples
    --------
    >>> import numpy as np
    >>> from carom.tracks import Settings, Track, measure
    >>> t = np.arange(40) / 200
    >>> y = np.where(t < 0.1, 2 * (0.1 - t), 1.6 * (t - 0.1)) - 9.81 / 2 * (t - 0.1) ** 2  # a bounce at t = 0.1 s
    >>> ball = Track("ball", t, np.stack([0.5 * t, y], axis=-1))
    >>> fit = measure([ball], Settings(view="side", noise=1e-4)).contacts[0].fit
    >>> round(fit["t"], 6), round(-fit["vn_in"], 3), round(fit["vn_out"], 3)
    (0.1, 2.0, 1.6)
    >>> fit.error("vn_out") < 0.01
    True
    """

    value: Array
    """(17,): the quantities of OUTPUTS."""
    covariance: Array
    """(17, 17), for the noise ``noise``."""
    noise: float
    """Standard deviation of one coordinate of one frame that was assumed, m."""
    chi2: float
    dof: float
    """Degrees of freedom: measured numbers, less the effective number of parameters that they determine without priors."""
    residuals: Array
    """(n, 2) m: measured less fitted; for a mean of m frames, times sqrt(m)."""
    time: Array
    """(n,) s: the frames of the fit."""
    slid_before: bool
    """Whether the track shows that the ball still slid at the first frame before the contact."""
    position: Callable[[Array], Array]
    """Times (m,) in s to fitted positions (m, 2) in the wall's frame, m."""
    slid_until_contact: bool = False
    """Whether it slid until the contact, so that no frame shows how much slip was left."""
    theta: Array = field(default_factory=lambda: np.zeros(0))
    """The parameters of the fit, from which another one can start."""
    hopping: ContactFit | None = None
    """The same contact, of a ball that hops off the wall; None if it cannot, or if this is such a fit."""
    hop_chi2: float = 0.0
    """By how much chi2 is higher if the ball hops for as long as off a wall that it touches at its centre."""
    rate: Array | None = None
    """(17, p): derivatives of the values by the parameters of ``fitted``."""
    fitted: FittedFrames | None = None
    """Data for the estimate of the noise's correlation."""
    shifts: Mapping[str, Array] = field(default_factory=dict)
    """By how much the values (17,) change with one standard deviation more of a quantity that all contacts of a film share: the
    air's ``drag``, the camera's ``roll``. Part of the covariance."""

    def __getitem__(self, name: str) -> float:
        """Return a value by its name in OUTPUTS."""
        return float(self.value[OUTPUTS.index(name)])

    def error(self, name: str) -> float:
        """Return the standard deviation of a value."""
        i = OUTPUTS.index(name)
        return float(np.sqrt(max(self.covariance[i, i], 0.0)))

    def covariance_of(self, name: str, other: str) -> float:
        """Return the covariance of two values."""
        return float(self.covariance[OUTPUTS.index(name), OUTPUTS.index(other)])

    @property
    def restitution(self) -> tuple[float, float]:
        """The ratio of the speeds away from the wall and toward it, and its standard deviation."""
        before, after = -self["vn_in"], self["vn_out"]
        ratio, v, w = after / before, self.error("vn_in") / before, self.error("vn_out") / after
        # (v_n before the contact is negative)
        shared = 2 * self.covariance_of("vn_in", "vn_out") / (before * after)
        return ratio, abs(ratio) * float(np.sqrt(max(v**2 + w**2 + shared, 0.0)))

    def resolved(self, name: str) -> bool:
        """Return whether the frames determine a value.

        They do not determine the slip of a ball that slides until the contact, or until its last frames.
        """
        if name in ("un_in", "ut_in"):
            return not self.slid_until_contact
        if name in ("un_out", "ut_out", "vn_roll", "vt_roll", "slides"):
            left = float(self.time[-1]) - self["t"] - self["slides"]
            return left > 0 and left > unresolved_time(self["mu_g"], self.noise, self.time)
        return bool(np.isfinite(self[name]))

    def scaled(self, noise: float) -> ContactFit:
        """Return the same fit with its covariance scaled to another noise.

        The prior's share is scaled as well; the next round of fits corrects that. Errors that the film shares are no noise.
        """
        shared = sum((np.outer(shift, shift) for shift in self.shifts.values()), np.zeros_like(self.covariance))
        return replace(self, covariance=(self.covariance - shared) * (noise / self.noise) ** 2 + shared, noise=noise)


def unresolved_time(mu_g: float, noise: float, time: Array) -> float:
    """Return for how long (s) rolling can pass for sliding, or sliding for rolling, before frames at times (n,) show it.

    The path bends by mu g / 2 t^2, which has to reach a few times the noise at one of the frames.
    """
    return float(np.sqrt(5 * noise / mu_g) + np.median(np.diff(time)))


def central_differences(f: Model, theta: Array, step: Array) -> Array:
    """Return the derivatives (rows, parameters) of a function by central differences."""
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
    """Minimise a sum of squares: return the parameters and the minimum.

    MINPACK's Levenberg-Marquardt first, which is several times faster but knows no bounds; if it ends beyond one,
    SciPy's trust-region reflective method.
    """
    from scipy.optimize import least_squares, leastsq

    low, high = bounds if bounds is not None else (np.full(len(theta), -np.inf), np.full(len(theta), np.inf))
    start = np.clip(theta, low + 1e-12, high - 1e-12)
    beyond = np.full(len(residual(start)), 1e3)

    def within(part: Array) -> Array:
        return residual(part) if (part >= low).all() and (part <= high).all() else beyond

    best, _cov, info, _message, status = leastsq(
        within, start, Dfun=slope, diag=1 / scale, ftol=tolerance, xtol=tolerance, gtol=0.0, maxfev=60, full_output=True
    )
    if status in (1, 2, 3, 4) and (best > low).all() and (best < high).all():
        return np.asarray(best), float(info["fvec"] @ info["fvec"])
    found = least_squares(
        residual, start, jac=slope, x_scale=scale, bounds=(low, high), method="trf",
        xtol=tolerance, ftol=tolerance, gtol=tolerance, max_nfev=60,
    )  # fmt: skip
    return found.x, float(2 * found.cost)


def contact_fit(
    best: Array, free: NDArray[np.bool_], residual: Model, slope: Array, outputs: Model, position: Model, *,
    scale: Array, time: Array, noise: float, slid_before: bool = False, slid_until_contact: bool = False,
) -> ContactFit:  # fmt: skip
    """Propagate the errors of the fitted parameters to OUTPUTS, by derivatives at the solution.

    Parameters
    ----------
    best, free : the parameters at the minimum (p,), and which of them were fitted
    residual, slope : the residuals, frames first, as a function; their derivatives (rows, p) at the minimum
    outputs, position : parameters to OUTPUTS (17,); times (m,) to fitted positions (m, 2)
    scale : (p,) typical sizes of the parameters
    """
    step = 1e-4 * scale
    slope = slope[:, free]
    inverse = np.linalg.pinv(slope.T @ slope, rcond=1e-14, hermitian=True)
    n = 2 * len(time)
    spent = float(np.einsum("ij,jk,ik->", slope[:n], inverse, slope[:n]))
    rate = central_differences(outputs, best, step)[:, free]
    r = residual(best)
    gap = r[:n].reshape(-1, 2) * noise
    chi2 = float(r[:n] @ r[:n])
    return ContactFit(
        value=outputs(best), covariance=rate @ inverse @ rate.T, noise=noise, chi2=chi2, dof=n - spent, residuals=gap,
        time=time, slid_before=slid_before, position=position, slid_until_contact=slid_until_contact, rate=rate,
    )  # fmt: skip


def starting_values(
    time: Array, position: Array, before: NDArray[np.bool_], after: NDArray[np.bool_], near_time: float
) -> Array:
    """Return starting values (7,) from straight lines through the frames next to the contact: time, place, velocities."""
    near, then = np.flatnonzero(before)[-8:], np.flatnonzero(after)[:6]
    theta = np.zeros(7)
    lines = [np.polyfit(time[rows] - near_time, position[rows], 1) for rows in (near, then)]
    (v0, x0), (v1, x1) = lines
    rate = v0[0] - v1[0]
    t = (x1[0] - x0[0]) / rate if abs(rate) > 1e-9 else 0.0
    t = float(np.clip(t, time[near[-1]] - near_time, time[then[0]] - near_time))
    theta[0] = near_time + t
    theta[1:3] = (x0 + v0 * t + x1 + v1 * t) / 2
    theta[START_IN], theta[START_OUT] = v0, v1
    return theta
