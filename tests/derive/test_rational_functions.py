"""Rational functions of symbols and angles: put together, cancelled and factored as SymPy does it; no square of a cosine stays."""

import itertools
import random

import pytest
import sympy as sp
from sympy.physics.mechanics import dynamicsymbols

from carom.derive.system import is_zero, reduce_trig, tidy

a, m, u = sp.symbols("a m u", positive=True)
x = sp.Symbol("x", real=True)
theta = dynamicsymbols("theta")
PLAIN = (a, m, u, x, theta, theta.diff())
WAVES = (a, m, sp.sin(x), sp.cos(x), sp.sin(theta))


def drawn(seed, letters, terms=3):
    """A sum of quotients whose numerators and denominators share factors; linear and quadratic in the letters."""
    draw = random.Random(seed)

    def polynomial():
        powers = itertools.product((0, 1, 2), repeat=2)
        pair = draw.sample(letters, 2)
        return sum((draw.randint(-3, 3) * pair[0] ** i * pair[1] ** j for i, j in powers), sp.Integer(1))

    shared = polynomial() * draw.choice(letters)
    return (
        sum(polynomial() * shared / (draw.randint(1, 4) * polynomial() ** draw.randint(1, 2)) for _ in range(terms))
        / shared
    )


@pytest.mark.parametrize("seed", range(4))
def test_of_angles_no_square_of_a_cosine_stays_and_nothing_changes(seed):
    expression = drawn(seed, WAVES, 1)
    for keep, other in (("sin", sp.cos), ("cos", sp.sin)):
        short = reduce_trig(expression, keep)
        assert not [w for w in short.atoms(sp.Pow) if isinstance(w.base, other) and abs(w.exp) > 1]
        assert is_zero(short - expression)
    assert is_zero(tidy(expression) - expression)


def test_what_is_no_rational_function_is_left_to_sympy():
    expression = (sp.sqrt(a) - sp.sqrt(m)) / (a - m) + sp.exp(u) * a / a**2
    assert is_zero(tidy(expression) - expression)
    assert tidy(sp.Float(0.5) * a + a * m) == sp.factor(sp.Float(0.5) * a + a * m)
