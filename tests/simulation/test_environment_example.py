"""The example of an environment for learning: its points are the shots that touch both balls, by a run of each alone."""

from __future__ import annotations

import numpy as np
from examples.environment import CaromTables

import carom


def test_points_are_shots_that_touch_both_balls_and_others_begin_anew() -> None:
    tables = CaromTables(40)
    begin, _ = tables.reset(seed=3)
    actions = np.random.default_rng(4).uniform(*CaromTables.BOUNDS, (40, 4))
    towards = np.arctan2(*(begin[:, 1] - begin[:, 0]).T[::-1])
    actions[:, 1] = towards + np.linspace(-0.06, 0.06, 40)  # at the second ball, so that some go on to the third
    after, points, ended, cut, _more = tables.step(actions)
    assert 0 < points.sum() < 40
    assert (ended == (points == 0)).all()
    assert not cut.any()
    a = tables.ball.radius
    for k in range(8):
        speed, azimuth, *offset = (float(x) for x in actions[k])
        struck = carom.strike(tables.ball, speed=speed, azimuth_deg=np.degrees(azimuth), offset=tuple(offset)).state
        changes = {f"balls.{i}.position": tuple(place) for i, place in enumerate(begin[k])}
        changes |= {"balls.0.velocity": tuple(struck.velocity), "balls.0.spin": tuple(struck.spin)}
        run = carom.simulate(carom.replaced(tables.scene, changes | {"balls.0.rolling": False, "balls.0.spin_z": None}))
        met = {event.name for event in run.events.of("ball", ball=0)}
        assert (len(met) == 2) == bool(points[k])
        if points[k]:
            assert np.abs(after[k] - run.final.position[:, :2]).max() < 1e-9
    gaps = np.linalg.norm(after[:, 0] - after[:, 1], axis=-1)
    assert (gaps[ended] > 2 * a).all()
    assert tables.reset(seed=3)[0].tolist() == begin.tolist()
