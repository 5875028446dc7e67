"""Smooth curves as walls: against brute force, 40 digits, ellipses and circles of their own, theorems on caustics."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from mpmath import mp
from reference.curves import CURVES, PolarSum, bounces_in, depth, first_crossings, precise_frame
from reference.exploring import tried

import carom
from carom import billiards
from carom.billiards.curved_wall import CurvedWall, curved_region
from carom.billiards.intersections import next_hit
from carom.billiards.loop import MEMORY, iterate
from carom.billiards.setup import orbit_setup, start_rows
from carom.core.geometry.curve import curve_wall
from carom.scene.figures import ArcPiece, EllipsePiece, OutlineFigure, Piece, SegmentPiece

START = ((0.2, 0.1), (0.8, 0.3), 0.5)


class Given(Piece):
    """A piece by the formula of a reference curve."""

    def __init__(self, curve: PolarSum) -> None:
        self.curve = curve

    def at(self, t: Any) -> Any:
        return self.curve.at(t)

    def span(self) -> tuple[float, float]:
        return self.curve.span()


def table_of_outline(loops: Any, bounds: Any = "centre") -> billiards.Table:
    return billiards.table(OutlineFigure(loops=loops), bounds=bounds)


class Whole(EllipsePiece):
    """An ellipse that is followed as a curve."""

    is_whole = False


def table_of(curve: PolarSum, bounds: Any = "centre") -> billiards.Table:
    return table_of_outline([[Given(curve)]], bounds)


ELLIPSE = table_of_outline([[Whole((1.0, 0.8))]])
INSET = table_of_outline([[Whole((1.0, 0.8))]], "surface")


# (billiards refuse a ball that is larger than a radius of curvature)
@pytest.mark.parametrize("name", [name for name in CURVES if name != "swallowtail"])
@pytest.mark.parametrize("pull", [0.0, 1.0])
@pytest.mark.slow(keep=1)
def test_first_hits_are_those_of_brute_force(name: str, pull: float) -> None:
    n = tried(60, 150)
    curve, a = CURVES[name]
    table = table_of(curve, "surface" if a else "centre")
    ball = carom.Disc(a or 1.0, 1.0)
    table = billiards.under(table, (0.0, -pull)) if pull else table
    begin = billiards.starts(table, n, 1, ball=ball, law="mirror", speed=1.5)
    x, v = np.asarray(begin.position), np.asarray(begin.velocity)
    # from inside, upright and nearly so
    x, v = np.concatenate([x, np.zeros((20, 2))]), np.concatenate([v, np.zeros((20, 2))])
    x[n:], v[n:, 0], v[n:, 1] = (0.02, 0.03), np.where(np.arange(20) % 2, 0.0, 1e-9), np.linspace(-1.5, 1.5, 20)
    found = billiards.orbit(table, (x, v, 0.0), 1, ball=ball, law="mirror", at_corner="pass")
    assert (found.count == 1).all()
    expected = first_crossings(curve, a, x, v, np.array([0.0, -pull]), np.full(len(x), np.inf), after=1e-5)
    seen = np.isfinite(expected)  # (at the apex brute force sees nothing)
    assert seen.mean() > 0.95
    assert found.t[seen, 0] == pytest.approx(expected[seen], abs=1e-8)
    assert depth(curve, found.position[:, 0]) == pytest.approx(a, abs=1e-14)


def test_a_start_on_the_wall_to_the_rounding_of_its_place_meets_the_wall_again() -> None:
    """A panel is off by some units in the last place: what lies as far behind it is on it, and does not leave the table."""
    curve, a = CURVES["random 5"]
    table = billiards.under(table_of(curve, "surface" if a else "centre"), (0.0, -1.0))
    t = np.linspace(0.0, 6.28, 400)
    y, d, _dd = curve.at(t)
    n = np.stack([-d[:, 1], d[:, 0]], axis=1) / np.hypot(*d.T)[:, None]
    x = y + a * n
    x, n = x[depth(curve, x) > a - 1e-13], n[depth(curve, x) > a - 1e-13]
    v = 0.3 * (0.02 * n + np.stack([-n[:, 1], n[:, 0]], axis=1))
    found = billiards.orbit(table, (x, v, 0.0), 1, ball=carom.Disc(a or 1.0, 1.0), law="mirror", at_corner="pass")
    assert len(x) > 300
    assert (found.count == 1).all()


@pytest.mark.parametrize("a", [0.0, 0.1, 0.3])
def test_place_normal_and_curvature_to_forty_digits(a: float) -> None:
    curve = PolarSum(((2, 0.1, 0.3), (3, 0.03, 1.0)))
    region = curved_region(CurvedWall("curve", ((Given(curve),),)), a)
    worst = [0.0, 0.0, 0.0]
    with mp.workdps(40):
        for t in np.linspace(0.1, 6.2, 25):
            x, y, nx, ny, kappa = (float(one) for one in precise_frame(curve, float(t), a))
            here = np.array([[x, y]])
            places = [wall.place(wall.along(here))[0][0] for wall in region.walls]
            off = [math.hypot(*(place - (x, y))) for place in places]
            arc = region.arcs[int(np.argmin(off))]
            found = curve_wall(region.table, arc.first, arc.last, a, *arc.direction, x, y)
            errors = (min(off), math.hypot(found[0] - nx, found[1] - ny), abs(found[2] / kappa - 1))
            worst = [max(pair) for pair in zip(worst, errors, strict=True)]
    assert 0 < worst[0] < 2e-15
    assert worst[1] < 2e-15
    assert worst[2] < 2e-14


@pytest.mark.parametrize(
    ("table", "own"), [(ELLIPSE, billiards.ellipse()), (INSET, billiards.ellipse(bounds="surface"))]
)
def test_an_ellipse_as_a_curve_is_the_ellipse(table: billiards.Table, own: billiards.Table) -> None:
    a = 0.1 if table.bounds == "surface" else 0.0
    one, two = table.shape(a), own.shape(a)
    assert one.lengths.sum() == pytest.approx(two.lengths.sum(), rel=1e-14)
    x = np.random.default_rng(1).uniform(-1, 1, (500, 2))
    assert one.gap(x) == pytest.approx(two.gap(x), abs=1e-14)
    s = np.linspace(0, two.lengths.sum(), 50, endpoint=False)
    k, place, n = one.place(s)
    assert one.coordinate(k, place) == pytest.approx(s, abs=1e-13)
    assert one.normals(k, place)[:, :2] == pytest.approx(n, abs=1e-14)
    j, place, n = two.place(s)
    assert place == pytest.approx(one.place(s)[1], abs=1e-13)
    assert one.curvatures(k, place) == pytest.approx(two.curvatures(j, place), rel=1e-12)
    for law, pull in (("mirror", 0.0), ("no-slip", 0.0), ("no-slip", -1.0)):
        found, expected = (
            billiards.orbit(billiards.under(one, (0.0, pull)) if pull else one, START, 8 if pull else 20, law=law)
            for one in (table, own)
        )
        assert found.position == pytest.approx(expected.position, abs=1e-9)
        assert found.spin == pytest.approx(expected.spin, abs=1e-9)
        spectra = (
            [billiards.tangent_map(one, START, 6, law=law).matrix for one in (table, own)] if not pull else [0.0, 0.0]
        )
        assert spectra[0] == pytest.approx(spectra[1], rel=1e-8, abs=1e-8)


def test_angular_momenta_about_the_foci_are_kept() -> None:
    found = billiards.orbit(ELLIPSE, START, 10_000, law="mirror")
    x, v, f = found.position, found.velocity, 0.6
    product = np.prod([(x[:, 0] - focus) * v[:, 1] - x[:, 1] * v[:, 0] for focus in (f, -f)], axis=0)
    drift = np.abs(product / product[0] - 1)
    assert 1e-16 < drift.max() < 1e-10
    # rounding adds up with all signs: it grows more slowly than the number of bounces
    assert drift[5000:].mean() < 4 * drift[100:5000].mean() + 1e-13


def test_a_circle_as_a_curve_is_the_circle() -> None:
    circle = table_of_outline([[ArcPiece((0.0, 0.0), 1.0, 0.0, 180.0), ArcPiece((0.0, 0.0), 1.0, 180.0, 360.0)]])
    for law in ("mirror", "no-slip", "rolling"):
        ball = carom.Ball(1.0, 1.0) if law == "rolling" else None
        one, two = (billiards.orbit(t, START, 200, law=law, ball=ball) for t in (circle, billiards.circle()))
        assert one.position == pytest.approx(two.position, abs=1e-11)


def test_bounces_in_a_curve_with_inflections_to_forty_digits() -> None:
    curve = CURVES["flower"][0]
    found = billiards.orbit(table_of(curve), ((0.1, 0.05), (0.8, 0.3), 0.0), 8, law="mirror")
    with mp.workdps(40):
        x, y, vx, vy = bounces_in(curve, (0.1, 0.05, 0.8, 0.3), 8)
    # (the error grows by a factor of some ten a bounce)
    assert found.position[-1] == pytest.approx([float(x), float(y)], abs=1e-8)
    assert found.velocity[-1] == pytest.approx([float(vx), float(vy)], abs=1e-7)


@pytest.mark.parametrize("eps", [0.1, 0.3])
def test_orbits_along_an_oval_stay_there_below_the_known_border(eps: float) -> None:
    """r = 1 + eps cos 2 theta has rotational invariant curves near the wall while its curvature is above zero: eps < 1/5.

    Beyond it there are none (J. N. Mather, Ergodic Theory Dyn. Syst. 2, 397 (1982)).
    """
    table = table_of(PolarSum(((2, eps, 0.0),)))
    shape = table.shape(0.0)
    _k, x, n = shape.place(np.linspace(0, shape.lengths.sum(), 8, endpoint=False))
    angle = 0.05
    v = math.sin(angle) * n + math.cos(angle) * np.stack([n[:, 1], -n[:, 0]], -1)
    found = billiards.orbit(table, (x, v, 0.0), 20_000, law="mirror")
    turned = [bool((along < 0).any()) for along in found.along]
    assert all(turned) if eps > 0.2 else not any(turned)
    if eps < 0.2:
        assert (found.count == 20_000).all()
        assert np.abs(found.angle).min() > 1.3


class Side(Piece):
    """A straight piece that is followed as a curve."""

    def __init__(self, start: Any, end: Any) -> None:
        self.start = start
        self.segment = SegmentPiece(start, end)

    def at(self, t: Any) -> Any:
        return self.segment.at(t)

    def span(self) -> tuple[float, float]:
        return 0.0, 1.0


def square(bulge: float) -> list[list[Piece]]:
    """A square with one notch: convex and reflex corners."""
    corners = [(0, 0), (2, 0), (2, 2), (1, 2), (1, 1 + bulge), (0, 1 + bulge)]
    return [[Side(p, q) for p, q in zip(corners, corners[1:] + corners[:1], strict=True)]]


def test_corners_of_the_wall_are_those_of_a_polygon() -> None:
    table = table_of_outline(square(0.3))
    own = billiards.polygon([p.start for p in square(0.3)[0]])
    one, two = table.shape(0.0), own.shape(0.0)
    assert one.lengths.sum() == pytest.approx(two.lengths.sum(), rel=1e-13)
    x = np.random.default_rng(2).uniform(0.2, 1.8, (300, 2))
    assert one.gap(x) == pytest.approx(two.gap(x), abs=1e-13)
    found, expected = (billiards.orbit(t, ((0.4, 0.5), (0.9, 0.37), 0.3), 60) for t in (table, own))
    assert found.position == pytest.approx(expected.position, abs=1e-10)
    assert np.isfinite(found.arc).all()


def test_a_ball_goes_around_the_corners_of_an_obstacle_on_circles() -> None:
    corners = [(-0.3, -0.2), (-0.3, 0.2), (0.3, 0.2), (0.3, -0.2)]
    obstacle: list[Piece] = [Side(p, q) for p, q in zip(corners, corners[1:] + corners[:1], strict=True)]
    table, a = table_of_outline([[Whole((1.5, 1.2))], obstacle], "surface"), 0.1
    shape, outside = table.shape(a), billiards.ellipse(1.5, 1.2, bounds="surface").shape(a)
    assert shape.lengths.sum() == pytest.approx(outside.lengths.sum() + 2 * (0.6 + 0.4) + math.tau * a, rel=1e-12)
    s = np.linspace(0, shape.lengths.sum(), 200)[:-1]
    piece, x, _n = shape.place(s)
    assert shape.coordinate(piece, x) == pytest.approx(s, abs=1e-12)
    ball = carom.Disc(a, 1.0)
    found = billiards.orbit(
        table, billiards.starts(table, 10, 1, ball=ball, law="mirror"), 200, ball=ball, law="mirror"
    )
    assert (found.ended == "bounces").all()
    assert np.abs(shape.gap(found.position)).max() < 1e-14


@pytest.mark.parametrize(
    ("table", "a"),
    [
        (table_of(PolarSum(((2, 0.6, 0.0),)), "surface"), 0.42), (table_of_outline([[Whole((1.0, 0.4))]], "surface"), 0.25),
        (billiards.table("mushroom:radius=1,stem=0.3,0.9", bounds="surface"), 0.05),
        (billiards.table("polygon", points=[(0, 0), (2, 0), (2, 0.85), (3, 0.85), (3, 0), (5, 0), (5, 2), (3, 2), (3, 1.15),
                                            (2, 1.15), (2, 2), (0, 2)], bounds="surface"), 0.2),
    ], ids=["a neck", "a radius of curvature", "a corner of a curve", "a corridor"],
)  # fmt: skip
def test_a_ball_that_does_not_touch_all_of_the_wall_is_refused_in_one_line(table: billiards.Table, a: float) -> None:
    with pytest.raises(carom.CaromError, match="expected one that touches all of the wall") as caught:
        table.shape(a)
    assert len(str(caught.value).splitlines()) == 1


@pytest.mark.parametrize(
    "table", [ELLIPSE, INSET, billiards.under(INSET, (0.0, -1.0))], ids=["point", "ball", "falling"]
)
def test_compiled_as_python(table: billiards.Table) -> None:
    found = billiards.orbit(table, START, 12, law="no-slip")
    setup = orbit_setup(table, None, "no-slip", None, "end")
    rows, _shape = start_rows(setup, START)
    kept, piece, last = np.full((12, 6), np.nan), np.zeros(12, np.int32), np.zeros(10)
    row = [float(r) for r in rows[0]]
    world, pieces = setup.world.view(np.recarray)[0], setup.pieces.view(np.recarray)
    with np.errstate(all="ignore"):
        iterate(
            world, pieces, setup.panels, tuple(row[:3]), tuple(row[3:6]), tuple(row[6:]), 12, 12, kept, piece, last,
            np.zeros(MEMORY),
        )  # fmt: skip
    np.testing.assert_array_equal(kept[:, 1:3], found.position)
    assert next_hit(world, pieces, setup.panels, (9.0, 0.0, 0.0), (1.0, 0.0, 0.0))[1] == -1


@pytest.mark.parametrize(
    ("outline", "text"),
    [
        ([[Given(PolarSum(((1, 1.6, 0.0),)))]], "does not meet itself"),
        ([[ArcPiece((0.0, 0.0), 1.0, 0.0, 300.0)]], "a closed curve"),
        ([[Given(PolarSum(((1, 1.0, 0.0),)))]], "tangent|cusp"),
    ],
)
def test_what_is_no_boundary_is_refused_in_one_line(outline: Any, text: str) -> None:
    with pytest.raises(carom.CaromError, match=text) as caught:
        table_of_outline(outline).wall()
    assert len(str(caught.value).splitlines()) == 1


@pytest.mark.slow
def test_periodic_orbits_of_a_curve_are_those_of_the_ellipse() -> None:
    one, two = (billiards.periodic_orbits(t, "2-3", law="mirror", starts=40) for t in (ELLIPSE, billiards.ellipse()))
    assert [(p.period, round(p.duration, 9)) for p in one] == [(p.period, round(p.duration, 9)) for p in two]
