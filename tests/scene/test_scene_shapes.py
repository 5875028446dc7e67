"""Shapes: what a ball can touch of each is as far away as the shape itself, measured in another way; gates; drawing."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

import carom
from carom.core.geometry.features import FACE, LINE, OVER, POINT, feature_hit, feature_normal, gap_to_feature
from carom.scene import (
    Arc,
    Box,
    Cylinder,
    Plane,
    Polygon,
    Segment,
    Sphere,
    Stadium,
    Strip,
    Table,
    Wedge,
)
from carom.scene.shapes import OutlineWall
from carom.scene.wall import WallShape

Distance = Callable[[np.ndarray], float]
INF = math.inf


# --- distances, worked out from the shapes alone ------------------------------------------------------------------


def to_rectangle(
    start: tuple[float, float], end: tuple[float, float], low: float = -INF, high: float = INF
) -> Distance:
    """To an upright rectangle: go to its nearest point."""
    p, q = np.array(start), np.array(end)

    def far(x: np.ndarray) -> float:
        s = np.clip((x[:2] - p) @ (q - p) / ((q - p) @ (q - p)), 0, 1)
        return float(math.hypot(*(x[:2] - p - s * (q - p)), x[2] - np.clip(x[2], low, high)))

    return far


def to_sides(points: list[tuple[float, float]], closed: bool, low: float = -INF, high: float = INF) -> Distance:
    pairs = list(zip(points, points[1:] + points[:1] if closed else points[1:], strict=False))
    sides = [to_rectangle(*pair, low, high) for pair in pairs]
    return lambda x: min(side(x) for side in sides)


def to_plane(p: tuple[float, ...], n: tuple[float, ...]) -> Distance:
    return lambda x: float(abs((x - p) @ np.array(n)) / np.linalg.norm(n))


def to_half_planes(p: tuple[float, ...], axis: np.ndarray, ways: list[np.ndarray]) -> Distance:
    def far(x: np.ndarray) -> float:
        r = x - p
        r = r - (r @ axis) * axis
        return min(float(np.linalg.norm(r - max(r @ way, 0.0) * way)) for way in ways)

    return far


def to_box(low: np.ndarray, high: np.ndarray) -> Distance:
    def far(x: np.ndarray) -> float:
        if ((low < x) & (x < high)).all():
            return float(min((x - low).min(), (high - x).min()))
        return float(np.linalg.norm(x - np.clip(x, low, high)))

    return far


def to_tube(p: tuple[float, ...], axis: tuple[float, ...], radius: float) -> Distance:
    unit = np.array(axis) / np.linalg.norm(axis)
    return lambda x: float(abs(np.linalg.norm(np.cross(x - p, unit)) - radius))


def to_pillar(p: tuple[float, ...], axis: tuple[float, ...], radius: float, length: float, open: bool) -> Distance:  # noqa: A002
    unit = np.array(axis) / np.linalg.norm(axis)

    def far(x: np.ndarray) -> float:
        h = float((x - p) @ unit)
        off, past = float(np.linalg.norm(x - p - h * unit)) - radius, max(-h, h - length, 0.0)
        return math.hypot(off if open else max(off, 0.0), past)

    return far


def to_arc(
    center: tuple[float, float], radius: float, first: float, last: float, low: float = -INF, high: float = INF
) -> Distance:
    def far(x: np.ndarray) -> float:
        return math.hypot(flat(x), max(low - x[2], x[2] - high, 0.0))

    def flat(x: np.ndarray) -> float:
        r = x[:2] - center
        turn = (math.degrees(math.atan2(r[1], r[0])) - first) % 360
        if turn <= last - first:
            return abs(math.hypot(*r) - radius)
        ends = [radius * np.array([math.cos(math.radians(t)), math.sin(math.radians(t))]) for t in (first, last)]
        return min(float(np.linalg.norm(r - end)) for end in ends)

    return far


def to_stadium(length: float, radius: float, center: tuple[float, float], angle: float) -> Distance:
    t = np.array([math.cos(math.radians(angle)), math.sin(math.radians(angle))])
    core = to_rectangle(tuple(center - length / 2 * t), tuple(center + length / 2 * t))
    return lambda x: abs(core(x) - radius)


L_SHAPE = [(-2.0, -2.0), (2.0, -2.0), (2.0, 0.0), (0.5, 0.3), (0.0, 2.0), (-2.0, 2.0)]
TABLE = [(-1.5, -1.0), (2.5, -1.0), (2.5, 1.0), (-1.5, 1.0)]
TILTED = np.array([1.0, 2.0, 2.0]) / 3
TILTED_U = np.array([8.0, -2.0, -2.0]) / math.sqrt(72)  # x, without what lies along the axis
SHAPES: dict[str, tuple[WallShape, Distance]] = {
    "plane": (Plane(point=(0.3, 0, 0), normal=(1, 2, -2)), to_plane((0.3, 0, 0), (1, 2, -2))),
    "segment": (Segment(start=(-1, 0), end=(1.5, 0.7)), to_rectangle((-1, 0), (1.5, 0.7))),
    "segment, low": (Segment(start=(-1, 0), end=(1.5, 0.7), height=0.5), to_rectangle((-1, 0), (1.5, 0.7), high=0.5)),
    "segment, raised": (
        Segment(start=(-1, 0), end=(1.5, 0.7), low=-0.2, height=0.5), to_rectangle((-1, 0), (1.5, 0.7), -0.2, 0.5),
    ),
    "segment, an edge": (
        Segment(start=(-1, 0), end=(1.5, 0.7), low=0.4, height=0.4), to_rectangle((-1, 0), (1.5, 0.7), 0.4, 0.4),
    ),
    "polygon": (Polygon(points=L_SHAPE), to_sides(L_SHAPE, True)),
    "polygon, low": (Polygon(points=L_SHAPE[::-1], height=0.3), to_sides(L_SHAPE, True, high=0.3)),
    "polygon, open": (Polygon(points=L_SHAPE, closed=False), to_sides(L_SHAPE, False)),
    "table": (Table(length=4, width=2, center=(0.5, 0)), to_sides(TABLE, True)),
    "table, noses": (
        Table(length=4, width=2, center=(0.5, 0), nose_height=0.4, height=0.9), to_sides(TABLE, True, 0.4, 0.9),
    ),
    "box": (
        Box(center=(0, 0.5, 0), size=(1, 2, 3)), to_box(np.array([-0.5, -0.5, -1.5]), np.array([0.5, 1.5, 1.5])),
    ),
    "box, inside": (
        Box(corner=(-2, -1, -2), size=(3, 3, 4), inside=True), to_box(np.array([-2.0, -1, -2]), np.array([1.0, 2, 2])),
    ),
    "strip": (
        Strip(point=(0, 0, -1), normal=(0, 3, 4), width=2.5),
        lambda x: min(to_plane((0, 0, -1), (0, 3, 4))(x), to_plane((0, 1.5, 1), (0, 3, 4))(x)),
    ),
    "wedge": (
        Wedge(apex=(0.2, 0, 0), from_angle=0, to_angle=120),
        to_half_planes((0.2, 0, 0), np.array([0.0, 0, 1]), [np.array([1.0, 0, 0]), np.array([-0.5, math.sqrt(0.75), 0])]),
    ),
    "wedge, wide": (
        Wedge(apex=(0.2, 0, 0), from_angle=-90, to_angle=180),
        to_half_planes((0.2, 0, 0), np.array([0.0, 0, 1]), [np.array([0.0, -1, 0]), np.array([-1.0, 0, 0])]),
    ),
    "wedge, tilted": (
        Wedge(apex=(0.2, 0, 0), axis=(1, 2, 2), from_angle=0, to_angle=270),
        to_half_planes((0.2, 0, 0), TILTED, [TILTED_U, -np.cross(TILTED, TILTED_U)]),
    ),
    "screen": (
        Wedge(apex=(0.2, 0, 0), from_angle=0, to_angle=360),
        to_half_planes((0.2, 0, 0), np.array([0.0, 0, 1]), [np.array([1.0, 0, 0])]),
    ),
    "cylinder": (Cylinder(point=(0, 1, 0), radius=0.7), to_tube((0, 1, 0), (0, 0, 1), 0.7)),
    "cylinder, tilted": (Cylinder(point=(0, 1, 0), axis=(1, 1, 0.5), radius=0.7), to_tube((0, 1, 0), (1, 1, 0.5), 0.7)),
    "tube": (Cylinder(point=(0, 1, 0), axis=(1, 1, 0.5), radius=2, inside=True), to_tube((0, 1, 0), (1, 1, 0.5), 2)),
    "cylinder with ends": (
        Cylinder(point=(0, 1, -0.5), axis=(1, 1, 0.5), radius=0.7, height=1.2),
        to_pillar((0, 1, -0.5), (1, 1, 0.5), 0.7, 1.2, open=False),
    ),
    "open tube": (
        Cylinder(point=(0, 1, -0.5), axis=(1, 1, 0.5), radius=0.9, height=1.2, inside=True),
        to_pillar((0, 1, -0.5), (1, 1, 0.5), 0.9, 1.2, open=True),
    ),
    "arc, low": (
        Arc(center=(0, 0.2), radius=1.5, from_angle=20, to_angle=110, low=-0.3, height=0.8),
        to_arc((0, 0.2), 1.5, 20, 110, -0.3, 0.8),
    ),
    "arc, whole and low": (
        Arc(center=(0, 0.2), radius=1.5, from_angle=0, to_angle=360, height=0.8),
        to_arc((0, 0.2), 1.5, 0, 360, -INF, 0.8),
    ),
    "arc": (Arc(center=(0, 0.2), radius=1.5, from_angle=20, to_angle=110), to_arc((0, 0.2), 1.5, 20, 110)),
    "arc, long": (Arc(center=(0, 0.2), radius=1.5, from_angle=-30, to_angle=250), to_arc((0, 0.2), 1.5, -30, 250)),
    "arc, whole": (Arc(center=(0, 0.2), radius=1.5, from_angle=0, to_angle=360), to_arc((0, 0.2), 1.5, 0, 360)),
    "sphere": (Sphere(center=(0, 0, 0.5), radius=1.1), lambda x: abs(math.dist(x, (0, 0, 0.5)) - 1.1)),
    "sphere, inside": (
        Sphere(center=(0, 0, 0.5), radius=2, inside=True), lambda x: abs(math.dist(x, (0, 0, 0.5)) - 2),
    ),
    "stadium": (
        Stadium(straight=2, radius=1, center=(0.3, -0.2), angle=30), to_stadium(2, 1, (0.3, -0.2), 30),
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.slow(keep=6)
def test_features_are_as_far_away_as_the_shape(name: str) -> None:
    wall, far = SHAPES[name]
    features = [feature for feature in wall.features() if feature.kind != OVER]
    rng = np.random.default_rng(4)
    seen = blocked = 0
    while seen < 400:
        x, a = rng.uniform(-3, 3, 3), rng.uniform(0.05, 0.5)
        if wall.blocked(tuple(x.tolist())):
            blocked += 1
            continue
        seen += 1
        gaps = [gap_to_feature(feature, a, tuple(x.tolist())) for feature in features]
        before = [gap if gap >= -a else INF for gap in gaps]  # the others are faces that the ball is behind of
        gap = min(before)
        assert gap == pytest.approx(far(x) - a, abs=1e-12)
        # the normal is the way in which the distance grows fastest
        n = feature_normal(features[before.index(gap)], tuple(x.tolist()))
        h = 1e-6
        slope = [(far(x + h * e) - far(x - h * e)) / (2 * h) for e in np.eye(3)]
        if abs(np.linalg.norm(slope) - 1) < 1e-6:  # not where two features are equally near
            assert n == pytest.approx(slope, abs=1e-4)
    thin = name.startswith(("segment", "polygon", "arc", "screen", "open"))
    assert (blocked == 0) == thin


@pytest.mark.parametrize("name", SHAPES)
def test_features_are_clean(name: str) -> None:
    for f in SHAPES[name][0].features():
        assert math.hypot(*f.d) == pytest.approx(1, abs=1e-15)
        assert math.hypot(*f.u) == pytest.approx(1, abs=1e-15)
        assert f.lo1 < f.hi1 or f.kind == POINT
        assert f.lo2 < f.hi2 or f.kind == POINT
        if f.kind != POINT:
            assert sum(p * q for p, q in zip(f.d, f.u, strict=True)) == pytest.approx(0, abs=1e-15)


@pytest.mark.parametrize("name", SHAPES)
def test_every_shape_can_be_drawn_and_named(name: str) -> None:
    wall, far = SHAPES[name]
    assert wall.describe().split()[0] in {"a", "an"}
    assert wall.kind in type(wall).__name__.lower()
    outline = wall.outline()
    assert outline
    level = isinstance(wall, (Segment, Polygon, Table, Arc, Stadium)) or name in {"cylinder", "wedge", "wedge, wide"}
    for polyline in outline:
        assert polyline.shape[1] == 2
        assert np.isfinite(polyline).all()
        if level:  # upright: what is drawn is where the wall is
            z = 0.5 if name == "table, noses" else 0.4 if name == "segment, an edge" else 0.25
            assert max(far(np.array([*p, z])) for p in polyline) < 1e-12
    assert wall.bounded == (np.abs(np.concatenate(outline)).max() < 100)


def test_a_tilted_cylinder_with_ends_is_drawn_as_a_closed_rectangle() -> None:
    pillar = Cylinder(point=(0, 1, -0.5), axis=(3, 4, 5), radius=0.7, height=math.sqrt(50))
    [outline] = pillar.outline()
    expected = [(-0.56, 1.42), (2.44, 5.42), (3.56, 4.58), (0.56, 0.58), (-0.56, 1.42)]
    np.testing.assert_allclose(outline, expected, atol=1e-12)


@pytest.mark.parametrize(("opening", "edges"), [(179.5, 0), (180, 0), (180.5, 1), (270, 1)])
def test_a_wedge_has_an_edge_where_balls_can_touch_it(opening: float, edges: int) -> None:
    features = Wedge(apex=(0.2, 0, 0), from_angle=0, to_angle=opening).features()
    assert len([f for f in features if f.kind == FACE]) == 2
    assert len([f for f in features if f.kind == LINE]) == edges


def test_the_room_inside_a_wall() -> None:
    assert Table(length=3, width=1.5).room == Table(length=1.5, width=3).room == 0.75
    assert Cylinder(point=(0, 0, 0), radius=0.5, inside=True).room == 0.5
    assert Cylinder(point=(0, 0, 0), radius=0.5, inside=True, height=2).room == INF  # outside of it
    assert Cylinder(point=(0, 0, 0), radius=0.5).room == INF


def test_a_level_plane_has_no_outline() -> None:
    assert Plane(point=(0, 0, 1), normal=(0, 0, -1)).outline() == []


def over(wall: WallShape, x: tuple[float, float, float], v: tuple[float, float, float]) -> list[float]:
    """When a small ball that flies straight passes a gate."""
    gates = [feature for feature in wall.features() if feature.kind == OVER]
    times = [feature_hit(gate, 0.01, x, v, (0.0, 0.0, 0.0), 100.0, 0.0) for gate in gates]
    return [float(t) for t in times if t < INF]


def test_gates_stand_on_low_walls_only() -> None:
    for wall in (
        Segment(start=(0, -1), end=(0, 1)),
        Polygon(points=L_SHAPE),
        Table(length=2, width=1, nose_height=0.1),
    ):
        assert not any(feature.kind == OVER for feature in wall.features())


def test_a_segment_is_cleared_from_both_sides() -> None:
    wall = Segment(start=(0, -1), end=(0, 1), height=0.5)
    assert over(wall, (1, 0, 0.6), (-1, 0, 0)) == [1.0]
    assert over(wall, (-1, 0, 0.6), (1, 0, 0)) == [1.0]
    assert over(wall, (1, 0, 0.4), (-1, 0, 0)) == []  # lower than it
    assert over(wall, (1, 1.5, 0.6), (-1, 0, 0)) == []  # past its end
    assert not wall.encloses


@pytest.mark.parametrize(
    "wall",
    [
        Table(length=2, width=2, height=0.5),
        Table(length=2, width=2, nose_height=0.2, height=0.5),
        Polygon(points=[(-1, -1), (1, -1), (1, 1), (-1, 1)], height=0.5),
        Polygon(points=[(-1, 1), (1, 1), (1, -1), (-1, -1)], height=0.5),
    ],
)
def test_what_stands_all_around_is_left_outwards_only(wall: WallShape) -> None:
    assert wall.encloses
    for v in ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0)):
        assert over(wall, (0, 0, 0.6), v) == [1.0]
        assert over(wall, (0, 0, 0.4), v) == []
    assert over(wall, (3, 0, 0.6), (-1, 0, 0)) == [4.0]  # in without a word, and out


def test_an_open_polygon_does_not_enclose() -> None:
    assert not Polygon(points=L_SHAPE, closed=False).encloses


def test_a_nose_meets_a_ball_on_the_floor_above_its_centre() -> None:
    a, h = 0.03, 0.037
    features = Table(length=2, width=1, nose_height=h).features()
    x = (0.9, 0.1, a)
    hits = [(feature_hit(f, a, x, (1.0, 0.0, 0.0), (0.0, 0.0, 0.0), 10.0, 0.0), f) for f in features]
    time, nose = min(hits, key=lambda hit: hit[0])
    sine = (h - a) / a
    assert nose.kind == LINE
    assert time == pytest.approx(0.1 - a * math.sqrt(1 - sine * sine), abs=1e-12)
    n = feature_normal(nose, (x[0] + time, x[1], a))
    assert n == pytest.approx((-math.sqrt(1 - sine * sine), 0, -sine), abs=1e-12)


def test_a_box_has_faces_edges_and_corners() -> None:
    kinds = [feature.kind for feature in Box(center=(0, 0, 0), size=(1, 1, 1)).features()]
    assert [kinds.count(kind) for kind in (FACE, LINE, POINT)] == [6, 12, 8]
    inside = Box(center=(0, 0, 0), size=(1, 1, 1), inside=True).features()
    assert [feature.kind for feature in inside] == [FACE] * 6


def test_a_box_by_its_corner_is_the_box_by_its_center() -> None:
    one, other = Box(center=(1, 2, 3), size=(2, 4, 6)), Box(corner=(0, 0, 0), size=(2, 4, 6))
    assert one.features() == other.features()


WRONG = {
    "segment": (lambda: Segment(start=(1, 1), end=(1, 1)), "Segment: end: expected another point than start, got [1.0, 1.0]"),
    "segment upside down": (
        lambda: Segment(start=(0, 0), end=(1, 1), low=2, height=1), "Segment: height: expected a height above low = 2 m, got 1.0",
    ),
    "two points": (
        lambda: Polygon(points=[(0, 0), (1, 1)]), "Polygon: points: expected at least 3 points [x, y], got [(0, 0), (1, 1)]",
    ),
    "bow tie": (
        lambda: Polygon(points=[(0, 0), (1, 1), (1, 0), (0, 1)]),
        "Polygon: points: expected an outline that does not meet itself, got sides 0 and 2 that meet; give the points in order",
    ),
    "spike": (
        lambda: Polygon(points=[(0, 0), (2, 0), (1, 0), (1, 1)]),
        "Polygon: points: expected an outline that does not meet itself, got sides 0 and 1 that meet; give the points in order",
    ),
    "touching": (
        lambda: Polygon(points=[(0, 0), (2, 0), (2, 1), (1, 0), (0, 1)]),
        "Polygon: points: expected an outline that does not meet itself, got sides 0 and 2 that meet; give the points in order",
    ),
    "back on itself": (
        lambda: Polygon(points=[(0, 0), (1, 0), (-1, 0), (0, 1)]),
        "Polygon: points: expected an outline that does not meet itself, got sides 0 and 1 that meet; give the points in order",
    ),
    "spike at the first": (
        lambda: Polygon(points=[(0, 0), (2, 0), (2, 2), (1, 0)]),
        "Polygon: points: expected an outline that does not meet itself, got sides 0 and 2 that meet; give the points in order",
    ),
    "flat": (
        lambda: Polygon(points=[(0, 0), (2, 0), (1, 0)]),
        "Polygon: points: expected an outline that does not meet itself, got sides 0 and 1 that meet; give the points in order",
    ),
    "open, begins on a side": (
        lambda: Polygon(points=[(1, 0), (0, 1), (0, 0), (2, 0)], closed=False),
        "Polygon: points: expected an outline that does not meet itself, got sides 0 and 2 that meet; give the points in order",
    ),
    "open, ends on a side": (
        lambda: Polygon(points=[(0, 0), (2, 0), (2, 1), (1, 0)], closed=False),
        "Polygon: points: expected an outline that does not meet itself, got sides 0 and 2 that meet; give the points in order",
    ),
    "open, ends where it begins": (
        lambda: Polygon(points=[(0, 0), (2, 0), (2, 1), (0, 0)], closed=False),
        "Polygon: points: expected an outline that does not meet itself, got sides 0 and 2 that meet; give the points in order",
    ),
    "twice": (
        lambda: Polygon(points=[(0, 0), (1, 0), (1, 0), (1, 1)]),
        "Polygon: points[2]: expected another point than the one before, got [1.0, 0.0]",
    ),
    "first and last": (
        lambda: Polygon(points=[(0, 0), (1, 0), (1, 1), (0, 0)]),
        "Polygon: points[0]: expected another point than the one before, got [0.0, 0.0]",
    ),
    "box nowhere": (
        lambda: Box(size=(1, 1, 1)), "Box: expected either center or corner (the lowest in x, y and z), got nothing",
    ),
    "box twice": (
        lambda: Box(size=(1, 1, 1), center=(0, 0, 0), corner=(0, 0, 0)),
        "Box: expected either center or corner (the lowest in x, y and z), got both",
    ),
    "flat cylinder": (
        lambda: Cylinder(point=(0, 0, 0), radius=1, height=0), "Cylinder: height: expected a length greater than 0 m, got 0.0",
    ),
    "arc upside down": (
        lambda: Arc(center=(0, 0), radius=1, from_angle=0, to_angle=90, low=1, height=0.5),
        "Arc: height: expected a height above low = 1 m, got 0.5",
    ),
    "closed wedge": (
        lambda: Wedge(apex=(0, 0, 0), from_angle=30, to_angle=30),
        "Wedge: expected an opening of more than 0 and at most 360 degrees, got 30 to 30; to_angle is the greater one",
    ),
    "backward arc": (
        lambda: Arc(center=(0, 0), radius=1, from_angle=90, to_angle=0),
        "Arc: expected an arc of more than 0 and at most 360 degrees, got 90 to 0; to_angle is the greater one",
    ),
    "outline of numbers that no piece has": (
        lambda: OutlineWall(pieces=[(0.5, 0, 0, 1, 0, 1, 0, 0, 0, 0), (0, 0, 0, 1, 1, 1, 0, 0, 0, 2)], sense=0.5),
        "OutlineWall: pieces.0.0: expected a way: 0, 1, -1, 2 or 3, got 0.5",
        "OutlineWall: pieces.1.9: expected 1 where a re-entrant corner is, or 0, got 2",
        "OutlineWall: pieces.1.3: expected a direction of length 1, got (1, 1)",
        "OutlineWall: sense: expected 1, -1 or 0, got 0.5",
    ),
    "outline without the table of its arc": (
        lambda: OutlineWall(pieces=[(2, 0, 0, 1, 0, 1, 0, 0, 0, 0)]),
        "OutlineWall: pieces.0.6: expected the first row of a table in panels, got 0",
    ),
    "arc of no length": (
        lambda: Arc(center=(0, 0), radius=1, from_angle=90, to_angle=90),
        "Arc: expected an arc of more than 0 and at most 360 degrees, got 90 to 90; to_angle is the greater one",
    ),
    "low table": (
        lambda: Table(length=2, width=1, nose_height=0.04, height=0.03),
        "Table: height: expected at least nose_height = 0.04 m, got 0.03",
    ),
    "zero normal": (
        lambda: Plane(point=(0, 0, 0), normal=(0, 0, 0)), "Plane: normal: expected a direction, not all zero, got [0.0, 0.0, 0.0]",
    ),
    "zero axis": (
        lambda: Cylinder(point=(0, 0, 0), axis=(0, 0, 0), radius=1),
        "Cylinder: axis: expected a direction, not all zero, got [0.0, 0.0, 0.0]",
    ),
    "no width": (lambda: Strip(point=(0, 0, 0), normal=(1, 0, 0), width=0), "Strip: width: expected a length in m, > 0, got 0"),
}  # fmt: skip


@pytest.mark.parametrize("name", WRONG)
def test_a_shape_that_is_none_says_why(name: str) -> None:
    make, *lines = WRONG[name]
    with pytest.raises(carom.CaromError) as error:
        make()
    assert error.value.faults == tuple(lines)


def test_sound_polygons_are_let_through() -> None:
    """Star-shaped ones are simple; so are those whose sides lie in one line."""
    rng = np.random.default_rng(7)
    for n in (3, 4, 7, 40):
        angles = np.sort(rng.uniform(0, 2 * math.pi, n))
        while np.diff([*angles, angles[0] + 2 * math.pi]).max() > 3:
            angles = np.sort(rng.uniform(0, 2 * math.pi, n))
        radii = rng.uniform(0.5, 2, n)
        Polygon(points=np.column_stack((radii * np.cos(angles), radii * np.sin(angles))))
    Polygon(points=[(0, 0), (1, 0), (2, 0), (2, 1), (0, 1)])


@pytest.mark.parametrize(("low", "high"), [(-math.inf, -math.inf), (math.inf, math.inf), (0.2, 0.1)])
def test_a_wall_of_no_height_is_refused(low: float, high: float) -> None:
    with pytest.raises(carom.CaromError, match="Segment: height: expected a height above low"):
        Segment(start=(0, 0), end=(1, 0), low=low, height=high)
    assert Segment(start=(0, 0), end=(1, 0)).vertical(0.03)
