"""Frobenius' test against distributions whose answer is known, the integrals it finds, and the paper's claim."""

import math

import pytest
import sympy as sp
from sympy.physics.mechanics import dynamicsymbols

from carom.derive.corners import first_integrals, frobenius, lie_bracket
from carom.derive.system import is_zero
from carom.errors import CaromError

x, y, z, theta, phi, psi = dynamicsymbols("x y z theta varphi psi")
t = dynamicsymbols._t
a, c = sp.symbols("a c", positive=True)


def D(q):  # noqa: N802
    return q.diff(t)


def spins():
    """Angular velocity of the paper's (1)."""
    return (
        D(theta) * sp.cos(psi) + D(phi) * sp.sin(theta) * sp.sin(psi),
        D(theta) * sp.sin(psi) - D(phi) * sp.sin(theta) * sp.cos(psi),
        D(phi) * sp.cos(theta) + D(psi),
    )


def drift_of(integral, test, start, speed, length=0.5, steps=400):
    """Largest change of a function along the one velocity that the constraints leave, by the classical Runge-Kutta method."""
    field = sp.lambdify(list(test.coordinates), list(test.fields), modules="math")
    value = sp.lambdify(list(test.coordinates), integral, modules="math")
    at, h, worst = [float(start[q]) for q in test.coordinates], length / steps, 0.0
    first = value(*at)
    for _ in range(steps):
        slopes, now = [], at
        for share in (0.5, 0.5, 1.0, 0.0):
            slopes.append([speed * rate for rate in field(*now)])
            now = [x + share * h * k for x, k in zip(at, slopes[-1], strict=True)]
        at = [x + h / 6 * (k + 2 * m + 2 * n + o) for x, k, m, n, o in zip(at, *slopes, strict=True)]
        worst = max(worst, abs(value(*at) - first))
    return worst


WX, WY, WZ = spins()
# constraints, coordinates, growth of the ranks; the growths of the last five are textbook (Neimark & Fufaev 1972;
# Bloch,
# Nonholonomic Mechanics and Control, 2003; Montgomery, A Tour of Subriemannian Geometries, 2002)
KNOWN = {
    "surface": ([D(z) - y * D(x) - x * D(y)], [x, y, z], (2,)),
    "sphere": ([x * D(x) + y * D(y) + z * D(z)], [x, y, z], (2,)),
    "Heisenberg": ([D(z) - y * D(x)], [x, y, z], (2, 3)),
    "knife edge": ([D(x) * sp.sin(theta) - D(y) * sp.cos(theta)], [x, y, theta], (2, 3)),
    "upright disc": (
        [D(x) - a * D(theta) * sp.cos(phi), D(y) - a * D(theta) * sp.sin(phi)],
        [x, y, theta, phi],
        (2, 3, 4),
    ),
    "ball on a plane": ([D(x) - a * WY, D(y) + a * WX], [x, y, theta, phi, psi], (3, 5)),
    "ball that does not pivot": ([D(x) - a * WY, D(y) + a * WX, WZ], [x, y, theta, phi, psi], (2, 3, 5)),
    "half of it": ([D(z), D(y) - x * D(theta)], [x, y, z, theta], (2, 3)),
}


@pytest.mark.parametrize("name", KNOWN)
def test_known_distributions(name):
    constraints, coordinates, growth = KNOWN[name]
    test = frobenius(constraints, coordinates)
    assert test.growth == growth
    assert test.integrable is (len(growth) == 1)
    assert test.holonomic == len(coordinates) - growth[-1]
    assert (test.witness is None) is test.integrable
    # the fields are allowed, and the witness' bracket really leaves the constraints
    assert all(is_zero(v) for v in test.rows * test.fields)
    if test.witness:
        i, j, values = test.witness
        bracket = lie_bracket(test.fields[:, i], test.fields[:, j], test.coordinates)
        assert any(not is_zero(v) for v in test.rows * bracket)
        assert all(is_zero(v) for v in values - test.rows * bracket)


def test_first_integrals_are_found_and_proved():
    test = frobenius(KNOWN["surface"][0], KNOWN["surface"][1])
    (found,) = first_integrals(test)
    X, Y, Z = test.coordinates
    assert is_zero(sp.diff(found, Z) * (-Y) - sp.diff(found, X))  # gradient along (Y, X, -1)
    assert is_zero(sp.diff(found, Z) * (-X) - sp.diff(found, Y))
    half = frobenius(KNOWN["half of it"][0], KNOWN["half of it"][1])
    assert first_integrals(half) == [half.coordinates[2]]
    assert first_integrals(frobenius(KNOWN["knife edge"][0], KNOWN["knife edge"][1])) == []


def test_the_papers_two_constraints_and_their_integrals():
    test = frobenius([WY, WX + WZ], [theta, phi, psi])
    assert test.trivial
    assert test.integrable
    assert "trivially" in test.sentence()
    th, ph, ps = test.coordinates
    (found,) = first_integrals(test)
    assert is_zero(found - (sp.sin(th) * sp.sin(ps) - sp.cos(th)) * found.coeff(sp.sin(th) * sp.sin(ps)))
    # (11), on the branch where (9) holds: constant along the path from there
    eleven = sp.tan(ph) + 0
    start = {th: 1.2, ph: 0.3, ps: math.asin(1 / math.tan(1.2))}
    assert drift_of(found, test, start, 0.4) < 1e-10
    root = sp.sqrt(2 * sp.sin(th) ** 2 - 1)
    constant = ph - sp.atan(root)  # (11) solved for d
    assert drift_of(constant, test, start, 0.4) < 1e-9
    # and a function that is no integral drifts
    assert drift_of(eleven, test, start, 0.4) > 1e-2


def test_claim_fails_with_two_freedoms():
    # the wall alone, as in the two-step model: V_B = 0 ties x', y', z' to the spin, three freedoms are left
    wall = frobenius([D(x), D(y) - a * WZ, D(z) + a * WY], [x, y, z, theta, phi, psi])
    assert wall.growth == (3, 5)
    assert wall.holonomic == 1
    assert first_integrals(wall, degree=1) == [wall.coordinates[0]]  # x: the ball stays at the wall
    # two freedoms: no pivoting about the wall's normal either
    pinned = frobenius([D(x), D(y) - a * WZ, D(z) + a * WY, WX], [x, y, z, theta, phi, psi])
    assert pinned.growth == (2, 3, 5)
    assert "not integrable" in pinned.sentence()
    # a distribution of rank 1 is integrable whatever its one row is made of
    odd = frobenius([D(x) - y**2 * D(z), D(y) - x * z * D(z)], [x, y, z])
    assert odd.integrable
    assert odd.trivial


def test_bad_input():
    with pytest.raises(CaromError, match="no constraint"):
        frobenius([], [x, y])
    with pytest.raises(CaromError, match="free of speeds"):
        frobenius([D(x) - 1], [x, y])
    with pytest.raises(CaromError, match="not linear"):
        frobenius([D(x) * D(y)], [x, y])
