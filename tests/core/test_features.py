"""Features of walls: normals, and how the gap of a ball changes, against differences of the distance."""

from __future__ import annotations

import numpy as np
import pytest

from carom.core.geometry.circles import rim_hit
from carom.core.geometry.features import (
    OVER,
    RIM,
    feature_hit,
    feature_normal,
    gap_derivatives,
    gap_to_feature,
    is_out_of_reach,
)
from carom.scene.feature_builders import built, frame, put_corner, put_disc, put_line, put_plane, put_rim, unit

INF = float("inf")
TILTED = unit((1.0, 2.0, 2.0))
FEATURES = {
    name: built(build, (0.1, 0.2, 0.3), *given, 0)[0]
    for name, build, given in (
        ("plane", put_plane, (TILTED,)),
        ("edge", put_line, (TILTED, -INF, INF, 0.0, 1.0)),
        ("cylinder", put_line, (TILTED, -INF, INF, 0.5, 1.0)),
        ("tube", put_line, (TILTED, -INF, INF, 2.5, -1.0)),
        ("corner", put_corner, (0.0, 1.0)),
        ("disc", put_disc, (TILTED, 9.0)),
        ("rim", put_rim, (TILTED, 0.5, frame(TILTED)[0], -1.0)),
    )
}
VELOCITY, ACCELERATION = np.array([0.7, -0.4, 1.3]), np.array([0.3, 0.5, -9.8])


@pytest.mark.parametrize("name", FEATURES)
def test_the_gap_changes_as_its_derivatives_say(name: str) -> None:
    feature, x = FEATURES[name], np.array([1.3, 0.9, 1.1])
    a = gap_to_feature(feature, 0.0, tuple(x.tolist()))  # a ball that touches it
    assert gap_to_feature(feature, a, tuple(x.tolist())) == pytest.approx(0, abs=1e-15)

    def gap(s: float) -> float:
        return gap_to_feature(feature, a, tuple((x + VELOCITY * s + ACCELERATION * s * s / 2).tolist()))

    h = 1e-4
    speed, bend = gap_derivatives(feature, tuple(x.tolist()), tuple(VELOCITY.tolist()), tuple(ACCELERATION.tolist()))
    assert speed == pytest.approx((gap(h) - gap(-h)) / (2 * h), rel=1e-6)
    assert bend == pytest.approx((gap(h) - 2 * gap(0) + gap(-h)) / (h * h), rel=1e-5)


@pytest.mark.parametrize("name", FEATURES)
def test_the_normal_is_where_the_gap_grows_fastest(name: str) -> None:
    feature, x, h = FEATURES[name], np.array([1.3, 0.9, 1.1]), 1e-6
    grows = [
        (
            gap_to_feature(feature, 0.0, tuple((x + h * e).tolist()))
            - gap_to_feature(feature, 0.0, tuple((x - h * e).tolist()))
        )
        / (2 * h)
        for e in np.eye(3)
    ]
    assert feature_normal(feature, tuple(x.tolist())) == pytest.approx(grows, abs=1e-8)


@pytest.mark.parametrize("name", [*FEATURES, "gate"])
def test_a_feature_out_of_reach_is_not_hit(name: str) -> None:
    gate = built(put_disc, (0.1, 0.2, 0.3), TILTED, 0.5, 0)[0]._replace(kind=OVER)
    f = gate if name == "gate" else FEATURES[name]
    rng, a, hits, far = np.random.default_rng(7), 0.1, 0, 0
    for _ in range(400):
        place, noise, pull = rng.normal(0, 1.5, 3), rng.normal(0, 0.2, 3), rng.normal(0, 0.5, 3)
        v = 2 * (np.array(f.p) + f.R * np.array(unit(tuple(noise.tolist()))) - place)  # (towards it)
        x, v, acc = (tuple(one.tolist()) for one in (place, v, pull))
        path = (a, x, v, acc, 1.0, 0.0)
        s = rim_hit(f.p, f.d, f.R, f.u, f.lo1, *path) if f.kind == RIM else feature_hit(f, *path)
        if s < np.inf:
            hits += 1
            assert not is_out_of_reach(f, a, x, (np.linalg.norm(v) + np.linalg.norm(acc) * s / 2) * s)
        far += is_out_of_reach(f, a, x, 0.2)
    assert hits > 50
    assert far > 20
