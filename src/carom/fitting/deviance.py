"""Deviance of one rebound under a law, with its scores and information: the kernels of a row whose spin was measured.

Inputs x and outputs y are measured with variances. The law f(x, p), linear near x, makes the deviance

    c = r' S^-1 r,   r = y - f(x, p),   S = var(y) + J var(x) J' - J C - C' J',   J = df/dx,   C = cov(x, y),

which is the least sum of squared adjustments of x and y, in error bars (Fuller, Measurement Error Models (1987), 1.3).
Its gradient in p is -2 G' S^-1 r with G = df/dp at the most likely x, x + (var(x) J' - C) S^-1 r; log det S is left out, since it
would bias the estimates. With nu > 0 errors follow Student's t with nu degrees of freedom: (nu + d) log(1 + c/nu). Rows whose spin
was not measured are in :mod:`carom.fitting.spins`.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from carom.core.jit.kernel import Vec, kernel
from carom.fitting.laws import INDEX, NUMBERS

UNDEFINED_DEVIANCE = 1e8  # of a row for which a law has no prediction
RELATIVE_STEP = 1e-4  # of a numerical derivative, in the parameter's own size
SPIN_WIDTH, SPIN_MEAN = INDEX["spin_width"], INDEX["spin_mean"]  # of the prior: the law does not depend on them


def call_law(called: Any, given: tuple[Any, ...]) -> Vec:
    """Call a law: a function; in compiled code its address (:func:`carom.core.jit.calls.call_at`)."""
    return called(*given)  # type: ignore[no-any-return]


class RowData(NamedTuple):
    """N rebounds in the form used by compiled code."""

    code: int
    """Code of the contact model (:mod:`carom.fitting.laws`)."""
    form: int
    """Form of the restitution."""
    stages: Any
    radius: float
    spins: Any
    """A :class:`carom.fitting.spins.SpinGrid`, or None where all spins were measured."""
    x: Any
    """(N, 3) v_n, v_t, spin before the wall."""
    vx: Any
    """(N, 3) their variances."""
    covariance: Any
    """(N, 2) of the errors of v_n before and after, and of v_t before and after."""
    y: Any
    """(N, 3) v_n, v_t, spin after the wall; NaN: not measured."""
    vy: Any
    nu: float
    """Degrees of freedom of Student's t; 0: normal errors."""
    known: Any
    """(M,) a table of the law at the trial point (:mod:`carom.fitting.model`); empty where the law itself is asked."""


class Trial(NamedTuple):
    """Parameter values at which rows are evaluated, and the steps of their numerical derivatives."""

    values: Any
    """(NUMBERS + S,) law parameters, then the shared errors in their error bars."""
    numbers: Any
    """(1,) the law parameters as a record, in the same memory."""
    free: Any
    """(k,) indices of the fitted ones."""
    steps: Any
    moved: Any
    """(S, N, 6) shift of inputs and outputs by one unit of each shared error."""
    stepped: Any
    """(S, NUMBERS) law parameters after one step of each shared error."""
    stepped_numbers: Any
    """(S,) the same as records."""


class Workspace(NamedTuple):
    """Scratch arrays of one thread."""

    u: Any
    """(k,) scores of one row."""
    h: Any
    """(k, k) its information."""
    asked: Any
    """(4 + 3 k, 3) predictions and their derivatives, as :func:`predict_with_derivatives` writes them."""
    s: Any
    """(3, 3) S."""
    q: Any
    """(3, 3) its inverse."""
    r: Any
    """(3, 3) residuals."""
    qr: Any
    """(3, 3) S^-1 times residuals."""
    qg: Any
    """(3,) S^-1 times a derivative."""
    slopes: Any
    """(2, 3) derivatives in v_n and v_t."""
    sigma: Any
    """(P,) spins at which the law is evaluated, in v/a."""
    predicted: Any
    """(P, 3) its predictions there."""
    intervals: Any
    """(M,) records of :data:`carom.fitting.spins.INTERVAL`."""
    score: Any
    """(k, 3) score of each parameter as a polynomial in the position within an interval."""
    prior: Any
    """(k, 3) the same of the log prior."""
    start: Any
    """(k, 3) derivative of the prediction at the beginning of an interval,"""
    slope: Any
    """(k, 3) and its change across it."""
    mean_shift: Any
    """(k,) derivative of the prior's mean."""
    curvature: Any
    """(k, k)"""
    outer: Any
    """(k, k) products of scores."""


@kernel
def predict_with_derivatives(
    law: Any, rows: Any, trial: Any, i: int, x: Vec, speed: float, inputs: int, each: int, first: int, last: int, asked: Any
) -> None:  # fmt: skip
    """Evaluate the law and its derivatives at x, items ``first`` to ``last``, into asked[item].

    Item 0 is the prediction; 1 to ``inputs`` its derivative in each input; then ``each`` items for each free parameter: its
    derivative in that and, where ``each`` is above 1, the mixed derivatives with the inputs. The derivative in a shared error is
    that of prediction less measurement. (It changes a row so little that the derivatives in the inputs are unaffected; a spin prior
    in v/a changes with v.)
    """
    for item in range(first, last):
        j, to = -1, item
        if item > inputs:
            j, to = trial.free[(item - inputs - 1) // each], (item - inputs - 1) % each
        z = j - NUMBERS
        if (to > 0 and (z >= 0 or not rows.vx[i, to - 1] > 0)) or j in (SPIN_WIDTH, SPIN_MEAN):
            for n in range(3):
                asked[item, n] = 0
            continue
        h = RELATIVE_STEP * (speed if to < 3 else speed / rows.radius)
        at0 = x[0] + h if to == 1 else x[0]
        at1 = x[1] + h if to == 2 else x[1]
        at2 = x[2] + h if to == 3 else x[2]
        step = trial.steps[j] if j >= 0 else 0 * speed
        if z >= 0:
            at0, at1, at2 = (
                at0 + step * trial.moved[z, i, 0],
                at1 + step * trial.moved[z, i, 1],
                at2 + step * trial.moved[z, i, 2],
            )
            if inputs == 2:
                at2 *= math.sqrt(at0 * at0 + at1 * at1) / speed
            g = call_law(
                law,
                (
                    rows.code,
                    rows.form,
                    rows.stages[i],
                    (at0, at1, at2),
                    rows.radius,
                    trial.stepped_numbers[z],
                    rows.known,
                ),
            )
            for n in range(3):
                asked[item, n] = (g[n] - asked[0, n]) / step - trial.moved[z, i, 3 + n]
            continue
        was = trial.values[j] if j >= 0 else 0 * speed
        if j >= 0:
            trial.values[j] = was + step
        g = call_law(
            law, (rows.code, rows.form, rows.stages[i], (at0, at1, at2), rows.radius, trial.numbers[0], rows.known)
        )
        if j >= 0:
            trial.values[j] = was
        for n in range(3):
            if item == 0:
                asked[0, n] = g[n]
            elif j < 0:
                asked[item, n] = (g[n] - asked[0, n]) / h
            elif to == 0:
                asked[item, n] = (g[n] - asked[0, n]) / step
            else:  # mixed derivative
                asked[item, n] = ((g[n] - asked[0, n]) / step - asked[item - to, n]) / h - asked[to, n] / step


@kernel
def residual_precision(rows: Any, i: int, jacobian: Any, first: int, inputs: int, s: Any, q: Any) -> None:
    """Compute S and its inverse q, with zeros where nothing was measured; jacobian[first + o] is the derivative in input o."""
    y, vx, vy = rows.y, rows.vx, rows.vy
    for m in range(3):
        for n in range(3):
            s[m, n] = vy[i, m] if m == n else 0.0
            for o in range(inputs):
                if vx[i, o] > 0:
                    s[m, n] += jacobian[first + o, m] * vx[i, o] * jacobian[first + o, n]
        for o in range(2):  # each velocity component with itself, before and after
            s[m, o] -= jacobian[first + o, m] * rows.covariance[i, o]
            s[o, m] -= jacobian[first + o, m] * rows.covariance[i, o]
    for m in range(3):
        if y[i, m] != y[i, m]:  # not measured
            for n in range(3):
                s[m, n] = s[n, m] = 0
            s[m, m] = 1
    d00, d01, d02, d11, d12, d22 = s[0, 0], s[0, 1], s[0, 2], s[1, 1], s[1, 2], s[2, 2]
    m0, m1, m2 = d11 * d22 - d12 * d12, d02 * d12 - d01 * d22, d01 * d12 - d02 * d11
    t = 1 / (d00 * m0 + d01 * m1 + d02 * m2)
    q[0, 0], q[0, 1], q[0, 2] = m0 * t, m1 * t, m2 * t
    q[1, 0], q[1, 1], q[1, 2] = m1 * t, (d00 * d22 - d02 * d02) * t, (d01 * d02 - d00 * d12) * t
    q[2, 0], q[2, 1], q[2, 2] = m2 * t, (d01 * d02 - d00 * d12) * t, (d00 * d11 - d01 * d01) * t
    for m in range(3):
        if y[i, m] != y[i, m]:
            q[m, m] = 0


@kernel
def measured_outputs(y: Any, i: int) -> int:
    """Count the components measured after the wall."""
    d = 0
    for m in range(3):
        if y[i, m] == y[i, m]:
            d += 1
    return d


@kernel
def row_deviance(law: Any, rows: Any, trial: Any, i: int, u: Any, h: Any, work: Any) -> tuple[float, float]:
    """Return a row's deviance and its c; write its scores (-1/2 of the gradient) to u and its information to h."""
    k, asked, q, qr, r, vx, nu = trial.free.shape[0], work.asked, work.q, work.qr[0], work.r[0], rows.vx, rows.nu
    zero = 0 * rows.radius
    u[:] = 0
    h[:] = 0
    d = measured_outputs(rows.y, i)
    if d == 0:
        return zero, zero
    x0, x1, x2 = rows.x[i, 0], rows.x[i, 1], rows.x[i, 2]
    speed = math.sqrt(x0 * x0 + x1 * x1)
    predict_with_derivatives(law, rows, trial, i, (x0, x1, x2), speed, 3, 1, 0, 4, asked)
    residual_precision(rows, i, asked, 1, 3, work.s, q)
    for m in range(3):
        r[m] = rows.y[i, m] - asked[0, m] if rows.y[i, m] == rows.y[i, m] else 0.0
    c = zero
    for m in range(3):
        qr[m] = q[m, 0] * r[0] + q[m, 1] * r[1] + q[m, 2] * r[2]
        c += r[m] * qr[m]
    if not c < UNDEFINED_DEVIANCE:
        return UNDEFINED_DEVIANCE, UNDEFINED_DEVIANCE
    if k > 0:
        # the most likely x
        off = (
            vx[i, 0] * (asked[1, 0] * qr[0] + asked[1, 1] * qr[1] + asked[1, 2] * qr[2]) - rows.covariance[i, 0] * qr[0]
        )
        x0 = max(x0 + off, x0 / 2)
        x1 += (
            vx[i, 1] * (asked[2, 0] * qr[0] + asked[2, 1] * qr[1] + asked[2, 2] * qr[2]) - rows.covariance[i, 1] * qr[1]
        )
        x2 += vx[i, 2] * (asked[3, 0] * qr[0] + asked[3, 1] * qr[1] + asked[3, 2] * qr[2])
        predict_with_derivatives(law, rows, trial, i, (x0, x1, x2), speed, 3, 1, 0, 1, asked)
        predict_with_derivatives(law, rows, trial, i, (x0, x1, x2), speed, 3, 1, 4, 4 + k, asked)
    t = (nu + d) / (nu + c) if nu > 0 else 1 + zero
    for j in range(k):
        g, qg = asked[4 + j], work.qg
        u[j] = t * (g[0] * qr[0] + g[1] * qr[1] + g[2] * qr[2])
        for m in range(3):
            qg[m] = q[m, 0] * g[0] + q[m, 1] * g[1] + q[m, 2] * g[2]
        for m in range(k):
            other = asked[4 + m]
            h[j, m] = t * (other[0] * qg[0] + other[1] * qg[1] + other[2] * qg[2])
    if nu > 0:
        return (nu + d) * math.log(1 + c / nu), c
    return c, c
