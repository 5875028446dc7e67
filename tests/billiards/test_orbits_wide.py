"""A ball wider than an ellipse's sharpest curve: two arcs and the corners where it touches both sides at once."""

import math

import numpy as np
import pytest

import carom
from carom import billiards
from carom.gas import Gas, Species, container
from carom.scene.figures.polygons import ellipse_depth

P, Q = 1.2, 0.5  # smallest radius of curvature: 0.2083
BALL = carom.Disc(0.35, 1.0)
WIDE, TALL = billiards.ellipse(P, Q, bounds="surface"), billiards.ellipse(Q, P, bounds="surface")


def level(p, q, a, count=4000):
    """Where rays from the middle come to the depth a: by halving, (count, 2)."""
    angle = np.linspace(0, math.tau, count, endpoint=False)
    out = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    low, high = np.zeros(count), np.full(count, max(p, q))
    for _ in range(50):
        middle = (low + high) / 2
        within = ellipse_depth(p, q, middle[:, None] * out) > a
        low, high = np.where(within, middle, low), np.where(within, high, middle)
    return low[:, None] * out


@pytest.mark.parametrize("table", [WIDE, TALL], ids=["wide", "tall"])
@pytest.mark.parametrize("a", [0.21, 0.3, 0.45, 0.499])
def test_the_curve_is_where_the_ball_touches(table, a):
    """Its points have the depth a, its length is that of the level line, it begins and ends at corners on the long axis."""
    shape = table.shape(a)
    p, q = table.figure.half_axes
    lengths = np.bincount(shape.parts, shape.lengths)
    assert lengths.shape == (2,)
    assert lengths[0] == pytest.approx(lengths[1], rel=1e-12)
    s = np.linspace(0, lengths.sum(), 501)[:-1]
    piece, x, n = shape.place(s)
    np.testing.assert_allclose(ellipse_depth(p, q, x), a, atol=1e-12)
    around = level(p, q, a)
    np.testing.assert_allclose(np.linalg.norm(x - around[:, None], axis=-1).min(axis=0), 0, atol=2e-3)
    polygon = np.linalg.norm(np.roll(around, -1, axis=0) - around, axis=-1).sum()
    assert lengths.sum() == pytest.approx(polygon, rel=1e-4)
    # arc length is arc length: neighbours lie as far apart, and the normal stands across
    close = shape.place(s[piece == shape.place(s + 1e-6)[0]] + 1e-6)[1] - x[piece == shape.place(s + 1e-6)[0]]
    np.testing.assert_allclose(np.linalg.norm(close, axis=-1), 1e-6, rtol=1e-3)
    assert np.abs((close * n[piece == shape.place(s + 1e-6)[0]]).sum(-1)).max() < 1e-9
    # the corner: where a ball on the long axis touches
    corner = shape.place([0.0, lengths[0]])[1]
    long = int(p < q)
    np.testing.assert_allclose(corner[:, 1 - long], 0, atol=1e-12)
    assert abs(corner[0, long]) == pytest.approx(np.abs(around[:, long]).max(), abs=1e-5)
    np.testing.assert_allclose(shape.coordinate(piece, x), s, atol=1e-9)


def test_as_the_ball_gets_wider_nothing_leaps():
    """Length and bounces just below the sharpest radius of curvature and just above."""
    sharpest = Q * Q / P
    below, above = (WIDE.shape(sharpest * (1 + step)) for step in (-1e-8, 1e-8))
    assert (np.ptp(below.parts), np.ptp(above.parts)) == (0, 1)
    assert below.lengths.sum() == pytest.approx(above.lengths.sum(), rel=1e-7)
    begin = ((0.1, 0.05), (0.7, 0.4), 0.3)
    runs = [billiards.orbit(WIDE, begin, 8, ball=carom.Disc(sharpest * (1 + step), 1.0)) for step in (-1e-8, 1e-8)]
    np.testing.assert_allclose(runs[0].position, runs[1].position, atol=1e-5)


@pytest.mark.parametrize("pull", [(0.0, 0.0), (0.3, -1.0)])
def test_the_gas_of_one_disc_goes_the_same_way(pull):
    """Two engines, with and without a force."""
    table = billiards.under(WIDE, pull) if any(pull) else WIDE
    begin = ((0.2, 0.05), (1.0, 0.4), 0.7)
    found = billiards.orbit(table, begin, 25, ball=BALL)
    gas = Gas(
        [Species(BALL, 1)], container("ellipse", half_axes=(P, Q)), contacts=carom.Surface(1, math.inf, 1), gravity=pull,
        position=[(0.2 + P, 0.05 + Q)], velocity=[begin[1]], spin=[begin[2]],
    )  # fmt: skip
    for k in range(25):
        gas.run(1)
        balls = gas.balls()
        assert gas.time == pytest.approx(found.t[k], rel=1e-8)
        np.testing.assert_allclose(balls.position[0, :2] - (P, Q), found.position[k], atol=1e-6)
        np.testing.assert_allclose(balls.spin[0, 2], found.spin[k], atol=1e-5)


@pytest.mark.parametrize("pull", [(0.0, 0.0), (1e-3, 0.0)])
@pytest.mark.parametrize("sign", [1, -1])
def test_into_the_corner(sign, pull):
    """Along the long axis: the orbit ends at the corner, or the ball meets both sides there and comes back as it must."""
    table = billiards.under(WIDE, pull) if any(pull) else WIDE
    begin = ((0.0, 0.0), (sign, 0.0), 0.0)
    ended = billiards.orbit(table, begin, 5, ball=BALL, law="mirror")
    assert (ended.ended, ended.count) == ("corner", 0)
    reach = abs(WIDE.shape(0.35).place(0.0)[1][0])
    assert abs(ended.last[1]) == pytest.approx(reach, rel=1e-13)
    went = billiards.orbit(table, begin, 2, ball=BALL, law="mirror", at_corner="pass")
    assert sorted(went.piece.tolist()) == [0, 1]
    assert went.t[1] == pytest.approx(went.t[0], abs=1e-13)
    # two mirrors one after the other turn the velocity by twice the angle between them
    n = [WIDE.shape(0.35).normals([k], np.array([[sign * reach, 0.0]]))[0, :2] for k in went.piece]
    v = np.array([ended.last[4], 0.0])
    for one in n:
        v = v - 2 * (v @ one) * one
    np.testing.assert_allclose(went.velocity[1], v, atol=1e-12)


@pytest.mark.parametrize("law", ["no-slip", "mirror", "rolling"])
def test_the_measure_is_kept(law):
    found = billiards.uniformity(WIDE, 10_000, 30, seed=3, ball=carom.Ball(0.35, 1.0), law=law)
    assert found.orbits > 9_990
    assert min(found.p.values()) > 1e-3


def test_a_cylinder_over_it():
    """Between lids: evenly filled, and its cross-section is the billiard of the plane where nothing spins across."""
    table = billiards.cylinder(WIDE, 2.0)
    ball = carom.Ball(0.35, 1.0)
    found = billiards.uniformity(table, 10_000, 30, seed=2, ball=ball)
    assert min(found.p.values()) > 1e-3
    flat = billiards.orbit(WIDE, ((0.2, 0.05), (1.0, 0.4), 0.0), 20, ball=ball, law="mirror")
    tube = billiards.orbit(
        billiards.cylinder(WIDE), ((0.2, 0.05, 0), (1.0, 0.4, 0.5), (0, 0, 0)), 20, ball=ball, law="mirror"
    )
    np.testing.assert_allclose(tube.position[:, :2], flat.position, atol=1e-9)
    np.testing.assert_allclose(tube.position[:, 2], 0.5 * flat.t, rtol=1e-12)


def test_corners_make_it_chaotic():
    """A small ball's mirror billiard in a nearly round ellipse has regular orbits; a wide one's, with its corners, fewer."""
    spectra = [
        billiards.lyapunov(WIDE, billiards.starts(WIDE, 40, 4, ball=ball), 3000, ball=ball, law="mirror").per_bounce[
            :, 0
        ]
        for ball in (carom.Disc(0.01, 1.0), BALL)
    ]
    small, wide = ((spectrum > 0.02).mean() for spectrum in map(np.nan_to_num, spectra))
    assert wide > small


@pytest.mark.parametrize("share", [0.3, 0.999])
@pytest.mark.parametrize(("p", "q"), [(2.0, 1.0), (0.9, 1.7)])
def test_places_along_an_ellipse_that_is_as_sharp_as_the_ball(share: float, p: float, q: float) -> None:
    """Centres of a ball of (nearly) the ellipse's least radius of curvature: evenly along the curve, and back."""
    a = share * min(p, q) ** 2 / max(p, q)
    shape = billiards.ellipse(p, q, bounds="surface").shape(a)
    length = shape.lengths.sum()
    s = np.linspace(0, length, 2001)[:-1]
    piece, x, n = shape.place(s)
    steps = np.hypot(*np.diff(x, axis=0).T)
    assert steps.max() < 1.001 * length / 2000
    np.testing.assert_allclose(shape.coordinate(piece, x), s, atol=1e-8)
    np.testing.assert_allclose(shape.normals(piece, x)[:, :2], n, atol=1e-9)
    np.testing.assert_allclose(((x - a * n) / (p, q)) ** 2 @ (1, 1), 1, atol=1e-12)


def test_both_lids_get_as_many_starts() -> None:
    start = billiards.starts(billiards.cylinder(billiards.circle(), 0.2), 4000, 3)
    top, bottom = (
        (np.sign(start.position[:, 2]) == side) & (np.abs(start.position[:, 2]) > 0.0999) for side in (1, -1)
    )
    assert top.sum() + bottom.sum() > 2000
    assert abs(int(top.sum()) - int(bottom.sum())) < 5 * math.sqrt(top.sum() + bottom.sum())


@pytest.mark.parametrize("radius", [0.3, 0.6])
def test_starts_in_a_cell_with_a_disc_are_those_of_the_invariant_measure(radius: float) -> None:
    """No start lay on the flat ends of a cylinder over such a cell; where discs overlap, starts lay within others."""
    flat = billiards.sinai(radius)
    at = billiards.starts(flat, 1000, seed=1).position
    around = np.stack([at - (x, y) for x in (-1, 0, 1) for y in (-1, 0, 1)])
    assert np.hypot(around[..., 0], around[..., 1]).min() >= radius * (1 - 1e-9)
    table = billiards.cylinder(flat, height=0.8)
    start = billiards.starts(table, 4000, seed=1)
    high = np.abs(start.position[:, 2]).max()
    share = (np.abs(start.position[:, 2]) == high).mean()
    found = billiards.orbit(table, start, 60)
    later = (np.abs(found.position[..., 2]) > high * (1 - 1e-9)).mean(axis=0)
    assert share == pytest.approx(later[20:].mean(), abs=0.03)
    assert share > 0.08
