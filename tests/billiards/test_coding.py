"""Itineraries, words, and periodic orbits by their codes: three discs against closed forms, published numbers and an own search."""

from __future__ import annotations

import math

import numpy as np
import pytest
from reference.three_discs import codes, shortest

import carom
from carom import billiards

HIGH = 6 / math.sqrt(3)
CENTRES = np.array([(0.0, HIGH), (-3.0, -HIGH / 2), (3.0, -HIGH / 2)])  # R = 6, a = 1
DISCS = billiards.discs([(x, y, 1.0) for x, y in CENTRES])


def test_orbits_of_three_discs_are_those_of_the_literature() -> None:
    """Gaspard & Rice, J. Chem. Phys. 90, 2225 (1989); Cvitanovic et al., Chaos: Classical and Quantum, table of the 3-disc pinball.

    Its cycles in the fundamental domain, 0, 1, 01, 011, are a half, a third, a half, a half of the codes here.
    """
    found = billiards.periodic_orbits(DISCS, itinerary=["AB", "ABC", "ABCB", "ABACBC"], law="mirror", starts=8)
    parts = {"AB": 2, "ABC": 3, "ABCB": 2, "ABACBC": 2}
    published = {
        "AB": (4.000000000000, 9.898979485566e0), "ABC": (4.267949192431, -1.177145519638e1),
        "ABCB": (8.316529485168, -1.240948019921e2), "ABACBC": (12.580807741032, 1.449545074956e3),
    }  # fmt: skip
    assert len(found) == 4
    for code, (length, multiplier) in published.items():
        one = next(x for x in found if x.itinerary in (code, min(code[k:] + code[:k] for k in range(len(code)))))
        assert one.duration / parts[code] == pytest.approx(length, rel=1e-11)
        assert one.multipliers[0].real == pytest.approx(multiplier ** parts[code], rel=1e-7)
        assert one.stability == "hyperbolic"
    assert found[0].multipliers[0].real == pytest.approx((5 + 2 * math.sqrt(6)) ** 2, rel=1e-12)
    assert found[1].duration == pytest.approx(3 * (6 - math.sqrt(3)), rel=1e-14)


@pytest.mark.slow
def test_every_code_of_three_discs_has_its_orbit() -> None:
    for period, number in ((2, 3), (3, 2), (4, 3), (5, 6), (6, 9), (7, 18)):
        wanted = codes("ABC", period)
        assert billiards.codes(DISCS, period) == wanted
        assert len(wanted) == number
        if period > 5:
            continue
        found = billiards.periodic_orbits(DISCS, itinerary=wanted, law="mirror", starts=4)
        assert sorted(one.itinerary for one in found) == wanted
        for one in found:
            length, multiplier = shortest(CENTRES, 1.0, ["ABC".index(letter) for letter in one.itinerary])
            assert one.duration == pytest.approx(length, rel=1e-11)
            assert one.multipliers[0].real == pytest.approx(multiplier, rel=1e-8)


def test_a_disc_in_the_way_prunes_codes() -> None:
    # the disc in the middle stands between the outer two
    table = billiards.discs([(-2.0, 0.0, 0.5), (0.0, 0.0, 0.5), (2.0, 0.0, 0.5)])
    found = billiards.periodic_orbits(table, itinerary=["AB", "AC", "BC"], law="mirror", starts=10)
    assert [one.itinerary for one in found] == ["AB", "BC"]


def test_orbits_by_code_in_closed_tables() -> None:
    # Fagnano's orbit joins the feet of the altitudes
    triangle = billiards.polygon([(0.0, 0.0), (1.0, 0.0), (0.4, 0.8)])
    (fagnano,) = billiards.periodic_orbits(triangle, itinerary="ABC", law="mirror", starts=20)
    a, b, c = triangle.wall().lengths
    area = 0.4
    assert fagnano.duration == pytest.approx(8 * area**2 / (a * b * c), rel=1e-12)
    # an orbit of maximal length, around an ellipse: Cayley's and Chasles's triangle is one of a family
    (around,) = billiards.periodic_orbits(billiards.ellipse(1.2, 1.0), itinerary="AAA", law="mirror", starts=30)
    assert around.family == 1
    # without a mirror: an orbit of period three of the no-slip law in a triangle
    (third,) = billiards.periodic_orbits(billiards.regular(3), itinerary="ABC", starts=60)
    assert (third.period, third.stability) == (3, "parabolic")


def test_words_of_a_square_grow_as_mignosi_counts() -> None:
    table = billiards.rectangle(1.0, 1.0)
    run = billiards.orbit(table, billiards.starts(table, 800, law="mirror"), 150, law="mirror")
    found = billiards.words(run, 7, "ABAB")
    phi = [sum(math.gcd(k, n) == 1 for k in range(1, n + 1)) for n in range(1, 8)]
    assert found.number == [1 + sum((n - k + 1) * phi[k - 1] for k in range(1, n + 1)) for n in range(1, 8)]
    assert found.entropy[-1] < found.entropy[0] == pytest.approx(math.log(2))
    assert found.unseen[-1] < 1e-3
    # with four sides none follows itself, and a corner is passed on its two sides in turn
    sides = billiards.words(run, 3)
    assert sides.number[:2] == [4, 12]
    assert sides.pruned[0] == ["AA", "BB", "CC", "DD"]
    assert "ABA" in sides.pruned[1]
    texts = billiards.itinerary(run)
    assert texts.shape == (800,)
    assert texts[0] == "".join("ABCD"[k] for k in run.piece[0])


def test_images_and_arcs_have_the_letter_of_their_wall() -> None:
    cell = billiards.torus((1.0, 1.0), [(0.0, 0.0, 0.3), (0.5, 0.5, 0.25)])
    assert set("".join(billiards.itinerary(billiards.orbit(cell, billiards.starts(cell, 20), 50)))) == {"A", "B"}
    smooth = billiards.table("limacon")
    assert set(billiards.itinerary(billiards.orbit(smooth, billiards.starts(smooth, 1), 50))[0]) == {"A"}


def test_survival_among_three_discs() -> None:
    # Gaspard & Rice: the escape rate is 0.41034
    start = billiards.starts(DISCS, 100_000, seed=2, law="mirror", spins=False)
    found = billiards.escape(DISCS, start, 20, law="mirror")
    early, late = 6.0, 14.4  # (two flights of 4.2 on the mean apart)
    share, _error = found.survival([early, late])
    rate = math.log(share[0] / share[1]) / (late - early)
    error = math.sqrt((1 / share[1] - 1 / share[0]) / 100_000) / (late - early)
    assert abs(rate - 0.41034) < 4 * error


@pytest.mark.parametrize(
    ("words", "arguments"),
    [
        ("two walls or more, letters from A to C", {"itinerary": "AD"}), ("two walls or more", {"itinerary": "A"}),
        ("one of the two, got both", {"itinerary": "AB", "period": 2}), ("one of the two, got neither", {}),
    ],
)  # fmt: skip
def test_codes_that_are_none_are_one_line(words: str, arguments: dict[str, object]) -> None:
    with pytest.raises(carom.CaromError, match=words) as error:
        billiards.periodic_orbits(DISCS, law="mirror", **arguments)
    assert "\n" not in str(error.value)


def test_an_open_table_has_no_mean_flight_and_discs_stay_apart() -> None:
    with pytest.raises(carom.CaromError, match="a table from which no ball escapes"):
        billiards.mean_flight(DISCS)
    with pytest.raises(carom.CaromError, match="apart from each other, got 1 and 2 that touch"):
        billiards.discs([(0.0, 0.0, 1.0), (1.5, 0.0, 0.6)])
    with pytest.raises(carom.CaromError, match="between obstacles"):
        billiards.orbit(billiards.discs(bounds="surface"), ((0.0, 0.0), (1.0, 0.0), 0.0), 3, ball=carom.Disc(0.6))
