"""Arcs of smooth curves and balls of any radius, on straight lines and parabolas, against small steps."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from reference.curve_walls import Backwards, drawn_flights, first_contact
from reference.curves import CURVES, PolarSum, depth

from carom.core.geometry.curve_arcs import SENSE, arc_contact, arc_gap, arc_hit, arc_tables

END = 4.0


def tables_of(curve: Any) -> list[Any]:
    return arc_tables(curve.at, *curve.span())


def soonest(tables: list[Any], a: float, x: Any, v: Any, g: Any, until: float = math.inf) -> float:
    return min(arc_hit(table, 0, a, 0.0, *x.tolist(), *v.tolist(), *g.tolist(), until, 1e-14) for table in tables)


@pytest.mark.parametrize("inside", [True, False])
@pytest.mark.parametrize("name", ["swallowtail", "flower", "random 3"])
def test_first_contacts_are_those_of_small_steps(name: str, inside: bool) -> None:
    """Also of balls that are larger than a radius of curvature."""
    curve, rng = CURVES[name][0], np.random.default_rng(5)
    tables = tables_of(curve if inside else Backwards(curve))
    touched = 0
    for a, x, v, g in drawn_flights(curve, rng, 6, inside):
        found, expected = soonest(tables, a, x, v, g), first_contact(curve, a, x, v, g, END)
        if expected == math.inf:
            assert found > END
            continue
        touched += 1
        assert found == pytest.approx(expected, abs=1e-7)
        place = x + v * found + g * found**2 / 2
        assert float(depth(curve, place[None])[0]) == pytest.approx(a, abs=4e-15)
    assert touched >= 2


@pytest.mark.parametrize(
    ("name", "x", "v", "t"),
    [
        ("flower", (0.49549449644086785, -0.8825576350373271), (5.0867184551152786e-11, 1.6492739854114085), 3.4658572069141),
        ("random 3", (0.9397281409923082, 0.001205764413273025), (0.0, 0.28778924644733356), 1.5927710376818),
    ],
)  # fmt: skip
def test_a_flight_over_the_tangent_of_an_arc_comes_back_to_it(name: str, x: Any, v: Any, t: float) -> None:
    """It passes the continuation of the arc where rounding hides on which side it is; the place is known to the billiard."""
    found = soonest(tables_of(CURVES[name][0]), 0.0, np.array(x), np.array(v), np.array([0.0, -1.0]))
    assert found == pytest.approx(t, rel=1e-12)


def test_a_circle() -> None:
    """Of constant curvature: quarters, from both sides, with the contacts of its equation; in touch, and along the wall."""
    circle = CURVES["ellipse"][0].__class__(())
    tables = tables_of(circle)
    assert [table[0, SENSE] for table in tables] == [1.0] * 4
    x, v = np.array([0.1, -0.2]), np.array([0.6, 0.9])
    a, zero = 0.3, np.zeros(2)
    b, c = float(x @ v), float(x @ x) - (1 - a) ** 2
    exact = (-b + math.sqrt(b * b - float(v @ v) * c)) / float(v @ v)
    assert soonest(tables, a, x, v, zero) == pytest.approx(exact, rel=1e-15)
    # after the contact it leaves, at a small angle, and comes back a chord later
    for angle in (0.5, 1e-3, 1e-6):
        at, away = np.array([0.7, 0.0]), np.array([-math.sin(angle), math.cos(angle)])
        assert soonest(tables, a, at, away, zero) == pytest.approx(1.4 * math.sin(angle), abs=1e-15 / angle)
        assert soonest(tables, a, at, -away, zero) <= 1e-15 / angle
    outer = tables_of(Backwards(circle))
    assert [table[0, SENSE] for table in outer] == [-1.0] * 4
    assert soonest(outer, a, np.array([3.0, 0.0]), np.array([-2.0, 0.0]), zero) == pytest.approx(0.85, rel=1e-15)
    assert soonest(outer, a, np.array([1.3, 0.0]), np.array([1e-9, 1.0]), zero) == math.inf
    assert soonest(outer, a, np.array([1.3, 0.0]), np.array([1.0, 0.0]), np.array([-1.0, 0.0])) == pytest.approx(2.0)
    nx, ny, kappa, far = arc_contact(outer[0], 0, 1.1 * math.cos(-0.4), 1.1 * math.sin(-0.4))
    assert (nx, ny, kappa, far) == pytest.approx((math.cos(-0.4), math.sin(-0.4), -1.0, 0.1), abs=1e-14)


def test_growing_balls() -> None:
    """In a room with inflections, with no limit of the time: the gap is closed then, and not before."""
    curve, rng = PolarSum(((3, 1 / 6, 0.0),)), np.random.default_rng(1)
    tables = tables_of(curve)
    for a, x, v, _g in drawn_flights(curve, rng, 40, inside=True):
        rate = float(rng.uniform(0, 1.2)) * float(np.linalg.norm(v))
        s = min(arc_hit(table, 0, a, rate, *x.tolist(), *v.tolist(), 0.0, 0.0, math.inf, 1e-14) for table in tables)
        t = np.linspace(0, s, 200)[1:]
        gap = depth(curve, x + np.outer(t, v)) - a - rate * t
        assert abs(gap[-1]) < 1e-12
        assert gap[:-1].min() > 0


def test_gaps_end_with_the_arc() -> None:
    curve = CURVES["ellipse"][0]
    x = np.array([0.3, 0.2])
    found = [arc_gap(table, 0, 0.1, *x.tolist()) for table in tables_of(curve)]
    assert min(gap for gap, beyond, _x, _y in found if beyond <= 0) == pytest.approx(
        float(depth(curve, x[None])[0]) - 0.1, abs=1e-15
    )
