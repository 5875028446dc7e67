"""Tables of the arcs of a smooth curve, on which :mod:`carom.core.geometry.curve_arcs` works, and their addresses."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from carom.core.geometry.curve import COEFFICIENTS, HALF, ROW, TX, X
from carom.core.geometry.curve_arcs import COUNT, SENSE, SHARP_END, SHARPEST, SIZE
from carom.core.geometry.panels import At, curvature, cut_into_panels

__all__ = ["arc_circle", "arc_length", "arc_tables", "join_ends"]

Array = NDArray[np.float64]
SAMPLES = 4096  # parameters at which the curvature is looked at
REVERSAL = 1e-6  # of the largest curvature: a change of its slope that is no rounding
JOINT = 1e-11  # of the size: ends that are nearer are one place
WIDEST = math.pi / 2 + 1e-6  # rad: an arc that turns by more is divided


def _vertices(at: At, t0: float, t1: float) -> Array:
    """Return the parameters at which the curvature has a greatest or least value."""
    t = np.linspace(t0, t1, SAMPLES + 1)
    k = curvature(at, t)
    least = REVERSAL * float(np.abs(k).max())
    found, best, way = [], 0, 0
    for i in range(1, len(k)):
        rise = k[i] - k[best]
        if way == 0:
            way = int(np.sign(rise)) if abs(rise) > least else 0
            best = i if way else best
        elif rise * way > 0:
            best = i
        elif abs(rise) > least:
            found.append((best, way))
            best, way = i, -way
    vertices = []
    for i, way in found:
        low, high = t[max(i - 1, 0)], t[min(i + 1, SAMPLES)]
        for _ in range(4):
            fine = np.linspace(low, high, 33)
            here = int(np.argmax(way * curvature(at, fine)))
            low, high = fine[max(here - 1, 0)], fine[min(here + 1, 32)]
        vertices.append((low + high) / 2)
    return np.array(vertices)


def arc_tables(at: At, t0: float, t1: float, cuts: Array | None = None) -> list[Array]:
    """Return the table (P + 2, ROW) of each arc of a curve from a parameter to a larger one, in order; the ball is on the left.

    ``cuts``: parameters at which the third derivative may jump. Raises ValueError, with the parameter, where it is not smooth.
    """
    x = at(np.linspace(t0, t1, 257))[0]
    if not np.isfinite(x).all():
        raise ValueError(t0)
    size = max(float(np.linalg.norm(np.ptp(x, axis=0)) / 2), float(np.abs(x).max()))
    vertices = _vertices(at, t0, t1)
    panels = cut_into_panels(at, t0, t1, size, np.concatenate([vertices, [] if cuts is None else cuts]))
    begins = [0]
    turned = 0.0
    for k in range(1, len(panels.rows)):
        turned += float(panels.turn[k - 1])
        at_vertex = len(vertices) > 0 and bool((np.abs(vertices - panels.t[k, 0]) <= 1e-9 * (t1 - t0)).any())
        if at_vertex or panels.sign[k] != panels.sign[k - 1] or abs(turned + float(panels.turn[k])) > WIDEST:
            begins.append(k)
            turned = 0.0
    parts = [slice(*one) for one in zip(begins, [*begins[1:], len(panels.rows)], strict=True)]
    tables = [_table(at, panels.rows[k], panels.t[k], int(panels.sign[k.start]), size) for k in parts]
    join_ends([*tables, tables[0]])
    return tables


def join_ends(tables: Sequence[Array]) -> None:
    """Give an arc that ends where the next one begins, but for rounding, the very same node."""
    for one, two in pairwise(tables):
        near = np.abs(one[-1, X : X + 2] - two[1, X : X + 2]).max() <= JOINT * one[0, SIZE]
        if near and np.abs(one[-1, TX : TX + 2] - two[1, TX : TX + 2]).max() <= JOINT:
            one[-1] = 0.0
            one[-1, [X, X + 1, TX, TX + 1]] = two[1, [X, X + 1, TX, TX + 1]]


def arc_length(table: Array) -> float:
    """Return the length of an arc, m."""
    w, weights = np.polynomial.legendre.leggauss(16)
    powers = np.arange(1, ROW - COEFFICIENTS)
    half, c = table[1:-1, HALF], table[1:-1, COEFFICIENTS + 1 :]
    slope = (c * powers) @ w ** (powers[:, None] - 1) / half[:, None]
    return float((np.sqrt(1 + slope * slope) @ weights * half).sum())


def arc_circle(table: Array) -> tuple[float, float, float]:
    """Return a circle in which an arc lies: its centre and its radius."""
    nodes, half = table[1:, X : X + 2], table[1:-1, HALF]
    x, y = (nodes.min(axis=0) + nodes.max(axis=0)) / 2
    # (between two nodes it is within the length of the chord from them)
    return float(x), float(y), float(np.hypot(*(nodes - (x, y)).T).max() + 2 * half.max())


def _table(at: At, rows: Array, t: Array, sign: int, size: float) -> Array:
    count = len(rows)
    table = np.zeros((count + 2, ROW))
    table[1:-1] = rows
    nodes = np.append(t[:, 0], t[-1, 1])
    x, d, _dd = at(nodes)
    table[1:, X : X + 2], table[1:, TX : TX + 2] = x, d / np.linalg.norm(d, axis=-1, keepdims=True)
    bend = np.abs(curvature(at, nodes[[0, -1]]))
    table[0, COUNT], table[0, SENSE], table[0, SIZE] = count, -1.0 if sign < 0 else 1.0, size
    table[0, SHARPEST], table[0, SHARP_END] = 0.0 if sign == 0 else bend.max(), float(bend[1] > bend[0])
    return table
