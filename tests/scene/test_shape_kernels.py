"""The kernels of shapes: features with the same bits for ever, a wall's numbers, texts of faults."""

from __future__ import annotations

import hashlib
import math

import numpy as np
import pytest
from reference.random_walls import SHAPES, random_wall

import carom
from carom.core.geometry.circles import direction
from carom.core.roots import two_prod
from carom.scene.feature_builders import _last_digit, _too_long, built, length_2d, put_upright
from carom.scene.ruled import number_fields
from carom.scene.shapes import Box, Polygon, Table

# Of 30 random walls of each shape, as they were when features were built by Python alone, with math.fsum, fmod, ulp and dist.
BITS = {
    "plane": "6e4375b915f74902",
    "strip": "766cf5407a43df5f",
    "wedge": "d43285308ed0072f",
    "box": "bfa8385fc94c4cef",
    "segment": "3e374a17ba238fe9",
    "polygon": "2655771c86b2e5b2",
    "table": "e0dfb7d0b926c136",
    "cylinder": "d39065edfb0156bf",
    "sphere": "076a74683d938f93",
    "arc": "a3d53c816cc334db",
    "stadium": "d050fa972118161e",
}


@pytest.mark.parametrize("shape", SHAPES)
def test_features_have_the_same_bits_as_ever(shape: str) -> None:
    digest = hashlib.sha256()
    for seed in range(SHAPES.index(shape), 330, len(SHAPES)):
        wall = random_wall(seed)
        assert wall.kind == shape
        for f in wall.features():
            numbers = [f.kind, *f.p, *f.d, f.R, f.side, *f.u, f.lo1, f.hi1, f.lo2, f.hi2, f.pocket >= 0]
            digest.update(np.array(numbers, float).tobytes())
    assert digest.hexdigest()[:16] == BITS[shape]


def test_exact_arithmetic_of_kernels_is_that_of_the_standard_library() -> None:
    rng = np.random.default_rng(40)
    for _ in range(300):
        n = rng.normal(size=3)
        n = n / np.linalg.norm(n) * np.where(rng.random(3) < 0.2, 10.0 ** -rng.uniform(0, 30, 3), 1.0)
        x, y, z = n.tolist()
        assert _too_long((x, y, z)) == math.fsum((-1.0, *(part for c in (x, y, z) for part in two_prod(c, c))))
        assert _last_digit(x) == math.ulp(x)
        far = float(10.0 ** rng.uniform(-5, 5)) * y
        assert length_2d(x, far) == math.dist((0.0, 0.0), (x, far))
        degrees = float(10.0 ** rng.uniform(-20, 30)) * x
        assert direction(degrees) == direction(math.fmod(degrees, 360.0))


def test_numbers_of_a_wall_are_its_fields_in_their_order() -> None:
    assert Box(center=(1, 2, 3), size=(4, 5, 6), inside=True).numbers[:3] == (1.0, 2.0, 3.0)
    assert all(math.isnan(x) for x in Box(center=(1, 2, 3), size=(4, 5, 6)).numbers[3:6])
    assert Polygon(points=[(0, 0), (1, 0), (0, 1)]).numbers[2:] == (3.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0)
    counts = number_fields(Table)
    assert list(counts) == ["length", "width", "center", "nose_height", "height", "corner_pockets", "side_pockets"]
    assert counts["corner_pockets"] == counts["side_pockets"] == ("mouth", "jaw_angle", "jaw_radius", "shelf", "radius")
    assert len(Table(length=2, width=1).numbers) == 16


def test_features_that_find_no_row_are_counted() -> None:
    points = [x for k in range(40) for x in (math.cos(k / 10), math.sin(k / 10))]
    found = built(put_upright, points, 0, 40, False, True, 0.0, 0.1, 0)
    assert len(found) == 40 * (
        2 + 2 + 3 + 1
    )  # of each side two faces, two edges and a gate; of each point a post and two corners


def test_pockets_that_overlap_are_named() -> None:
    pocket = {"mouth": 0.12, "jaw_angle": 140, "jaw_radius": 0.01, "shelf": -0.12, "radius": 2.2}
    with pytest.raises(carom.CaromError, match=r"bottom left pocket and top left pocket, which overlap by"):
        Table(length=2, width=1, corner_pockets=pocket)


def test_a_wall_far_beyond_its_own_size_is_refused() -> None:
    """Its sides have no length once its place is rounded."""
    with pytest.raises(carom.CaromError, match="a wall near the origin, compared with its size"):
        carom.scene.Table(length=1.42, width=2.84, center=(1e23, 1.42))
