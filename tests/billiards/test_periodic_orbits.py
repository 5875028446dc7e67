"""Periodic orbits: against bounces to 40 digits, critical points of the length, closed forms and published lists."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
from mpmath import mp, workdps
from reference.commands import command
from reference.critical_lengths import critical_lengths
from reference.precise_bounces import return_map_trace

import carom
from carom import billiards
from carom.billiards.coded_orbits import periods_of
from carom.errors import CaromError


@pytest.mark.parametrize(("law", "period"), [("mirror", 3), ("mirror", 4), ("no-slip", 3), ("no-slip", 5)])
def test_orbits_close_and_have_their_trace_to_forty_digits(law: str, period: int) -> None:
    found = billiards.periodic_orbits(billiards.stadium(2.0, 1.0), period, law=law, starts=60, seed=3)
    assert len(found) >= 2
    for one in found:
        assert one.error < 1e-9
        begin = [*np.ravel(one.orbit.position[-1]), *np.ravel(one.orbit.velocity[-1]), float(one.orbit.spin[-1])]
        with workdps(40):
            gap, trace = return_map_trace(begin, period, 2, 1, mp.mpf(1) / 2, law == "no-slip")
            # (the fourth multiplier of the mirror is that of the spin, which is one of `trace` here as well)
            pair = float(trace) - 1 - one.third
        assert float(gap) < one.error * (2 + abs(pair)) * 2 + 1e-14
        assert pair == pytest.approx(one.trace, abs=1e-7 * (1 + abs(pair)))


def test_an_orbit_that_is_a_multiple_root_is_listed_once() -> None:
    """Its matrix is singular and it is isolated, so that each start ends some 1e-5 away from it, each at another place."""
    room = billiards.table("curve", r="1 + 0.1*cos(3*theta)")
    near, far = billiards.periodic_orbits(room, 3, starts=30)
    assert (near.multiple, far.multiple, near.found > 1) == (True, False, True)
    # the triangles whose corners have r = 0.9 and r = 1.1, with the speed along the chords that grips three times a turn
    for one, r in ((near, 0.9), (far, 1.1)):
        assert one.duration == pytest.approx(3 * r * math.sqrt(3) / math.sqrt(8 / 9), rel=1e-9)
        away = np.abs(np.linalg.norm(one.orbit.position, axis=-1) - r).max()
        assert away <= 10 * one.error
    assert 1e-7 < near.error < 1e-3


@pytest.mark.parametrize("period", [3, 4, 5])
@pytest.mark.slow(keep=1)
def test_the_orbits_in_an_oval_are_the_critical_points_of_the_length(period: int) -> None:
    """The curve of the centre of a ball in an ellipse: smooth, and not integrable."""
    a, b, r = 1.6, 1.0, 0.2

    def parallel(u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        size = np.hypot(b * np.cos(u), a * np.sin(u))
        n, turn = np.stack([b * np.cos(u), a * np.sin(u)]) / size, a * b / size**2
        x = np.stack([a * np.cos(u), b * np.sin(u)]) - r * n
        return x, np.stack([-a * np.sin(u), b * np.cos(u)]) * (1 - r * turn / size)

    table = billiards.ellipse(a, b, bounds="surface")
    found = billiards.periodic_orbits(
        table, period, ball=carom.Disc(r, 1.0), law="mirror", starts=600 if period == 5 else 250, seed=1
    )
    lengths, expected = sorted(one.duration for one in found), critical_lengths(parallel, period, 250, seed=2)
    # (each list may lack what the other has: both start at random; none has what is no orbit)
    assert len(expected) > 1
    assert len(lengths) > 1
    assert all(min(abs(one - other) for other in expected) < 1e-9 for one in lengths)
    missed = [one for one in expected if min(abs(one - other) for other in lengths) > 1e-9]
    assert missed == []


@pytest.mark.slow
def test_all_listed_periods_of_the_pentagon_are_found_from_random_starts() -> None:
    """Ahmed, Cox & Wang's list, and 18."""
    listed = (6, 8, 10, 14, 18, 20, 30, 40)
    found = billiards.periodic_orbits(
        billiards.regular(5), listed, ball=carom.Disc(1, 1, (3 - math.sqrt(5)) / 2), starts=100
    )
    for period in listed:
        ours = [one for one in found if one.period == period]
        assert any(one.family == 3 and np.allclose(one.multipliers, 1) for one in ours), period
        assert all(
            billiards.period(
                billiards.orbit(one.orbit.setup.table, one.orbit.start, 2 * period, ball=one.orbit.setup.ball), 1e-7
            )
            == period
            for one in ours
        )


def test_the_corner_orbit_has_the_closed_form_of_the_wedge() -> None:
    """Two bounces in a corner of angle phi rotate the velocities by 2 arccos((kappa - cos phi)/(1 + kappa))."""
    all_of_two = billiards.periodic_orbits(billiards.regular(5), 2, ball=carom.Disc(1, 1, 0.2), starts=40)
    one = next(one for one in all_of_two if abs(one.pieces[0] - one.pieces[1]) in (1, 4))
    branch = billiards.continue_orbit(one, lambda kappa: {"ball": carom.Disc(1, 1, kappa)}, 0.2, 0.95)
    phi = math.radians(108)
    theta = [2 * math.acos((kappa - math.cos(phi)) / (1 + kappa)) for kappa in branch.parameter]
    assert np.abs(branch.trace - 2 * np.cos(theta)).max() < 1e-12
    assert branch.ended == "range"
    # kappa = (cos phi + cos(pi m/n))/(1 - cos(pi m/n)), where theta = 2 pi m/n
    expected = {}
    for m, n, kind in (
        (1, 2, "period doubling"),
        (1, 3, "1:3 resonance"),
        (1, 4, "1:4 resonance"),
        (2, 3, "1:3 resonance"),
    ):
        kappa = (math.cos(phi) + math.cos(math.pi * m / n)) / (1 - math.cos(math.pi * m / n))
        if 0.2 < kappa < 0.95:
            expected[kappa] = kind
    assert expected
    seen = {event.parameter: event.kind for event in branch.events}
    assert sorted(seen) == pytest.approx(sorted(expected), abs=1e-12)
    assert [seen[key] for key in sorted(seen)] == [expected[key] for key in sorted(expected)]


@pytest.mark.parametrize("kappa", [0.2, 0.5, 1.0])
def test_between_two_scatterers_the_orbit_turns_elliptic_at_the_known_radius(kappa: float) -> None:
    """Wojtkowski 1994; Cox, Feres & Zhang, arXiv:1612.03355: in the unit torus at R = 1/(2 + 2 kappa)."""
    ball, edge = carom.Disc(1, 1, kappa), 1 / (2 + 2 * kappa)
    one = billiards.refine_orbit(billiards.sinai(0.9 * edge), ((0.5, 0.0), (1.0, 0.0), 0.0), 2, ball=ball)
    assert one.stability == "hyperbolic"
    branch = billiards.continue_orbit(one, lambda r: {"table": billiards.sinai(r)}, 0.9 * edge, 1.05 * edge)
    assert branch.events[0].kind == "1:1 resonance"
    assert branch.events[0].parameter == pytest.approx(edge, abs=1e-12)
    assert branch.orbit(-1).stability == "elliptic"


@pytest.mark.parametrize(("sides", "kappa", "listed"), [(3, 0.5, {4, 6}), (4, 1.0, {4, 6, 8, 10, 12})])
@pytest.mark.slow(keep=1)
def test_polygons_have_the_listed_periods(sides: int, kappa: float, listed: set[int]) -> None:
    """Ahmed, Cox & Wang, arXiv:2111.07397: of open sets of orbits. (Others, such as period 3 in the triangle, have no volume.)"""
    found = billiards.periodic_orbits(billiards.regular(sides), range(2, 13), ball=carom.Disc(1, 1, kappa), starts=60)
    assert {one.period for one in found if one.family == 3} == listed
    assert all(one.stability == "parabolic" for one in found if one.family == 3)


def test_each_orbit_once() -> None:
    """In a circle the orbits are the stars: as many as there are numbers below p/2 without a common divisor."""
    found = billiards.periodic_orbits(billiards.circle(), range(2, 8), law="mirror", starts=60)
    expected = [(p, m) for p in range(2, 8) for m in range(1, p // 2 + 1) if math.gcd(p, m) == 1]
    assert sorted((one.period, one.winding) for one in found) == expected
    for one in found:
        length = 2 * one.period * math.sin(math.pi * one.winding / one.period)
        assert one.duration == pytest.approx(length, abs=1e-12)


def test_seeds_and_starts_are_repeated_exactly() -> None:
    one, other = (billiards.periodic_orbits(billiards.stadium(), (2, 3), starts=50, seed=5) for _ in range(2))
    assert [a.duration for a in one] == [b.duration for b in other]
    closed = sum(orbit.found for orbit in one)
    assert f"{closed:,} starts closed, of 50 for each period; " in one.describe()


def test_nothing_is_claimed_beyond_rounding() -> None:
    """The map of forty bounces enlarges rounding by up to 1e16: what closes there only seems to."""
    found = billiards.periodic_orbits(billiards.stadium(2.0, 1.0), 40, starts=10)
    assert all(one.error < 1e-6 and abs(one.trace) < 1e9 for one in found)


@pytest.mark.parametrize(("text", "periods"), [("4", [4]), ("2-4", [2, 3, 4]), (" 3, 5-6,3 ", [3, 5, 6])])
def test_periods_as_text(text: str, periods: list[int]) -> None:
    assert periods_of(text) == periods


def test_carom_orbit_finds_them_too() -> None:
    one = carom.orbit("circle", 5, law="mirror", periodic="2-3", starts=60).periodic
    other = billiards.periodic_orbits(billiards.circle(), (2, 3), law="mirror", starts=60)
    assert one is not None
    assert [a.duration for a in one] == [b.duration for b in other]
    assert json.loads(json.dumps(one[0].to_dict()))["period"] == 2


def test_under_a_force_and_rolling() -> None:
    fall = billiards.under(billiards.wedge(100), (-1.0, 0.0))
    with pytest.raises(CaromError, match="closed boundary"):
        billiards.periodic_orbits(fall, 2)
    found = billiards.periodic_orbits(billiards.under(billiards.circle(), (0, -1.0)), 1, law="mirror", starts=60)
    # a ball that hops on the lowest point, up to the height of the energy of speed 1 at the middle: v^2 = 1 + 2 g R
    assert [round(one.duration, 12) for one in found] == [round(2 * math.sqrt(3), 12)]
    rolling = billiards.periodic_orbits(billiards.circle(), 2, law="rolling", starts=60)
    assert all(np.isfinite(one.trace) for one in rolling)
    assert len(rolling) >= 1


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: billiards.periodic_orbits(billiards.circle(), 0), "whole number >= 1"),
        (lambda: billiards.periodic_orbits(billiards.circle(), 5000), "at most 1000"),
        (lambda: billiards.periodic_orbits(billiards.circle(), "3,6-2"), "smaller number to the larger, such as 2-6, got '6-2'"),
        (lambda: billiards.periodic_orbits(billiards.sphere(), 2), "in the plane"),
        (lambda: billiards.periodic_orbits(billiards.strip(), 2), r"polygon's, .*carom\.billiards\.tangent_map"),
        (lambda: billiards.periodic_orbits(billiards.circle(), 2, law="contact", surface=carom.Surface(0.8, 0.1)), "keeps"),
        (lambda: billiards.refine_orbit(billiards.stadium(), ((0.3, 0.2), (1.0, 0.3), 0.1), 7), "leads to none"),
    ],
)  # fmt: skip
def test_refusals(call, said: str) -> None:
    with pytest.raises(CaromError, match=said):
        call()


def test_a_branch_begins_at_its_orbit() -> None:
    one = billiards.refine_orbit(billiards.sinai(0.3), ((0.5, 0.0), (1.0, 0.0), 0.0), 2)
    with pytest.raises(CaromError, match="where it does not close"):
        billiards.continue_orbit(one, lambda radius: {"table": billiards.sinai(radius)}, 0.31, 0.4)
    with pytest.raises(CaromError, match="a mapping such as"):
        billiards.continue_orbit(one, billiards.sinai, 0.3, 0.4)
    with pytest.raises(CaromError, match="`table` and `ball`, got sides"):
        billiards.continue_orbit(one, lambda radius: {"sides": radius}, 0.3, 0.4)


def test_lists_say_what_they_may_leave_out(capsys):
    """Corners, at which orbits end; orbits between obstacles that random starts do not find."""
    assert (
        "corners: orbits that meet one are left out."
        in billiards.periodic_orbits(billiards.regular(3), 2, starts=5).completeness
    )
    assert "corners" not in billiards.periodic_orbits(billiards.circle(), 2, law="mirror", starts=5).completeness
    code, printed, told = command(capsys, "orbit", "discs", "--periodic", "2", "--starts", "5")
    assert code == 0
    assert "No periodic orbit" in printed
    assert "--itinerary AB,ABC seeks" in told
    assert "--itinerary" not in command(capsys, "orbit", "discs", "--itinerary", "AB", "--starts", "5")[2]


def test_a_near_miss_beside_a_joint_is_no_orbit() -> None:
    """In a stadium a ball that bounces up and down beside a joint comes back to within the cube of its distance from it."""
    found = billiards.periodic_orbits(billiards.stadium(2.0, 1.0), 2, starts=300)
    assert len(found) >= 2
    for one in found:
        assert one.error < 1e-12
        begin = one.orbit.position[-1], one.orbit.velocity[-1], float(one.orbit.spin[-1])
        again = billiards.orbit(billiards.stadium(2.0, 1.0), begin, 200)
        # (of a hyperbolic orbit rounding grows by its multiplier at every period)
        periods = 4 if one.stability == "hyperbolic" else 100
        assert np.linalg.norm(again.position[2 * periods - 1] - begin[0]) < 1e-9
