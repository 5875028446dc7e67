"""Tables in the plane, and how far a point is inside each: distances that know nothing of the pieces of a boundary."""

import math

import numpy as np

from carom import billiards

L_SHAPE = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
SPIKES = [(0, 0), (1, 0.4), (2, 0), (1.5, 1), (2, 2), (1, 1.6), (0, 2), (0.5, 1)]
PLANE = {
    "circle": billiards.circle,
    "ellipse": billiards.ellipse,
    "tall ellipse": lambda **o: billiards.ellipse(0.7, 1.1, **o),
    # (for the balls of these tests wide: they do not come to the ends)
    "narrow ellipse": lambda **o: billiards.ellipse(1.1, 0.25, **o),
    "tall narrow ellipse": lambda **o: billiards.ellipse(0.25, 1.1, **o),
    "triangle": lambda **o: billiards.regular(3, **o),
    "seven": lambda **o: billiards.regular(7, **o),
    "rectangle": billiards.rectangle,
    "stadium": billiards.stadium,
    "L": lambda **o: billiards.polygon(L_SHAPE, **o),
    "star": lambda **o: billiards.polygon(SPIKES, **o),
    "sinai": billiards.sinai,
    "torus": lambda **o: billiards.torus((1.0, 1.4), ((0.45, 0.1, 0.25), (-0.2, -0.6, 0.2)), **o),
    "periodic strip": billiards.periodic_strip,
}


def segments(vertices, x):
    p = np.asarray(vertices, float)
    q = np.roll(p, -1, axis=0)
    e = q - p
    u = np.clip(((x[:, None] - p) * e).sum(-1) / (e * e).sum(-1), 0, 1)
    distance = np.linalg.norm(x[:, None] - p - u[..., None] * e, axis=-1).min(-1)
    turns = np.zeros(len(x))
    for a, b in zip(p, q, strict=True):
        d, f = a - x, b - x
        turns += np.arctan2(d[:, 0] * f[:, 1] - d[:, 1] * f[:, 0], (d * f).sum(-1))
    return np.where(np.abs(turns) > math.pi, distance, -distance)


def ellipse_distance(p, q, x):
    u, width = np.broadcast_to(np.linspace(0, math.tau, 300, endpoint=False), (len(x), 300)), math.tau / 300
    for _ in range(7):
        away = (p * np.cos(u) - x[:, :1]) ** 2 + (q * np.sin(u) - x[:, 1:]) ** 2
        best = u[np.arange(len(x)), np.argmin(away, axis=1)]
        u, width = best[:, None] + np.linspace(-width, width, 31), width / 14
    distance = np.hypot(p * np.cos(best) - x[:, 0], q * np.sin(best) - x[:, 1])
    return np.where((x[:, 0] / p) ** 2 + (x[:, 1] / q) ** 2 < 1, distance, -distance)


def lattice(x, scatterers, cell):
    found = np.full(len(x), math.inf)
    for cx, cy, r in scatterers:
        d = x - (cx, cy)
        for k, side in enumerate(cell):
            if side:
                d[:, k] -= side * np.round(d[:, k] / side)
        found = np.minimum(found, np.hypot(d[:, 0], d[:, 1]) - r)
    return found


def stadium_distance(x):
    return 1.0 - np.hypot(np.maximum(np.abs(x[:, 0]) - 1.0, 0), x[:, 1])


CLEARANCE = {
    "circle": lambda x: 1 - np.hypot(x[:, 0], x[:, 1]),
    "ellipse": lambda x: ellipse_distance(1.0, 0.8, x),
    "tall ellipse": lambda x: ellipse_distance(0.7, 1.1, x),
    "narrow ellipse": lambda x: ellipse_distance(1.1, 0.25, x),
    "tall narrow ellipse": lambda x: ellipse_distance(0.25, 1.1, x),
    "triangle": lambda x: segments([(math.cos(a), math.sin(a)) for a in np.radians([-150, -30, 90])], x),
    "rectangle": lambda x: segments([(-1, -0.5), (1, -0.5), (1, 0.5), (-1, 0.5)], x),
    "stadium": stadium_distance,
    "L": lambda x: segments(L_SHAPE, x),
    "star": lambda x: segments(SPIKES, x),
    "sinai": lambda x: lattice(x, [(0, 0, 0.3)], (1, 1)),
    "torus": lambda x: lattice(x, [(0.45, 0.1, 0.25), (-0.2, -0.6, 0.2)], (1.0, 1.4)),
    "periodic strip": lambda x: np.minimum(0.5 - np.abs(x[:, 1]), lattice(x, [(0, 0, 0.2)], (1, 0))),
}


def first_outside(clearance, at, times, inset):
    """Index of the first of the times at which the point ``at(t)`` is nearer to the boundary than ``inset``; None if never."""
    for begin in range(0, len(times), 250):  # (in pieces: most orbits end early, and distances to an ellipse take long)
        out = np.flatnonzero(clearance(at(times[begin : begin + 250])) < inset)
        if len(out):
            return begin + int(out[0])
    return None
