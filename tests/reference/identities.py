"""What tests of laws share: random states with many special values, and the quantities that laws must keep.

Velocities v and spins w are arrays (..., 3); lengths in m, but every quantity per mass (mass drops out of one contact).
"""

import math

import numpy as np
from hypothesis import strategies as st

KAPPAS = (2 / 5, 2 / 3, 1 / 2, 0.1, 1e-6)

# Rounding: a law is some tens of operations, each wrong by at most 1.1e-16 of the largest number that takes part.
ROUNDING = 1e-14


def energy(v, w, a, kappa):
    """(20), per mass."""
    return ((v * v).sum(axis=-1) + kappa * a * a * (w * w).sum(axis=-1)) / 2


def contact_velocity(v, w, n, a):
    """Velocity of the contact point -a n (24): its size along n, and the rest."""
    u = v - a * np.cross(w, n)
    un = (u * n).sum(axis=-1)
    return un, u - un[..., None] * n


def angular_momentum(v, w, n, a, kappa):
    """About the contact point -a n, per mass: a n x v + kappa a^2 w."""
    return a * np.cross(n, v) + np.asarray(kappa * a * a)[..., None] * w


def floor_invariants(v, w, a, kappa):
    """(37), per mass and divided by a: what no impulse at the floor's contact point can change."""
    k = kappa * a
    return np.stack([k * w[..., 0] - v[..., 1], k * w[..., 1] + v[..., 0], k * w[..., 2]], axis=-1)


def size(v, w, a):
    """Scale of a state, for tolerances: |v| + a |w|, by the largest parts (their squares would vanish below 1e-162)."""
    return abs(v).max(axis=-1) + a * abs(w).max(axis=-1)


def mirrored(v, w, m):
    """The state seen in a mirror with unit normal m: velocity is a vector, spin a pseudovector."""
    m = np.asarray(m, dtype=float)
    flip = np.eye(3) - 2 * np.outer(m, m)
    return v @ flip, -(w @ flip)


def rotation(axis, angle):
    """Rodrigues' rotation matrix R; rotate rows by x @ R.T."""
    x, y, z = np.asarray(axis, dtype=float) / np.linalg.norm(axis)
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + math.sin(angle) * k + (1 - math.cos(angle)) * (k @ k)


def units(rng, count):
    """Random directions, some of them axes."""
    n = rng.normal(size=(count, 3))
    n /= np.linalg.norm(n, axis=-1, keepdims=True)
    axes = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, 0, 1], [0.6, 0.8, 0], [0.6, 0, -0.8]])
    some = rng.random(count) < 0.2
    n[some] = axes[rng.integers(len(axes), size=some.sum())]
    return n


def with_zeros(rng, array, share=0.1):
    """Some components are exactly zero."""
    array = array.copy()
    array[rng.random(array.shape) < share] = 0.0
    return array


def approaching(rng, count, a=1.0, zeros=0.1):
    """Random states and normals with u_n <= 0."""
    n = units(rng, count)
    v = with_zeros(rng, rng.normal(size=(count, 3)), zeros)
    w = with_zeros(rng, rng.normal(size=(count, 3)), zeros) / a
    un = (v * n).sum(axis=-1)
    v[un > 0] *= -1
    return v, w, n


def surfaces(rng, count):
    """Random e, mu, beta with every special value in turn."""
    e = rng.choice([0.0, 0.5, 1.0, -1.0], size=count)
    e = np.where(e < 0, rng.random(count), e)
    mu = rng.choice([0.0, 1e-9, 0.2, 1.0, 10.0, np.inf, -1.0], size=count)
    mu = np.where(mu < 0, rng.random(count), mu)
    beta = rng.choice([-1.0, 0.0, 1.0, 2.0], size=count)
    beta = np.where(beta > 1, rng.uniform(-1, 1, count), beta)
    return e, mu, beta


def kappas(rng, count):
    return rng.choice(KAPPAS, size=count)


# --- strategies: plain floats that like to be special ---------------------------------------------------------------


def numbers(most=10.0):
    return st.one_of(st.sampled_from([0.0, 1.0, -1.0, 0.5, -2.0]), st.floats(-most, most, allow_subnormal=False))


def vectors(most=10.0):
    return st.tuples(numbers(most), numbers(most), numbers(most))


@st.composite
def directions(draw, level=False):
    """Unit normals as the library makes them: a vector over its length."""
    x, y, z = draw(vectors(1.0))
    z = 0.0 if level else z
    length = math.sqrt(x * x + y * y + z * z)
    if length < 1e-3:
        return (1.0, 0.0, 0.0)
    return (x / length, y / length, z / length)


restitutions = st.one_of(st.sampled_from([0.0, 0.5, 1.0]), st.floats(0, 1, allow_subnormal=False))
frictions = st.one_of(st.sampled_from([0.0, 0.1, 1.0, math.inf]), st.floats(0, 20, allow_subnormal=False))
tangentials = st.one_of(st.sampled_from([-1.0, 0.0, 1.0]), st.floats(-1, 1, allow_subnormal=False))
inertias = st.one_of(st.sampled_from([2 / 5, 2 / 3, 1.0]), st.floats(1e-6, 1.0))
