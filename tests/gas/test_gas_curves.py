"""Gases in smooth curves: against circles, brute force; re-entrant corners, growth, states; refusals."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from reference.curves import CURVES, depth

import carom
from carom import gas

ROUGH = carom.Surface(0.9, 0.2, 0.3)


def shaken(container: Any, **options: Any) -> gas.Gas:
    """Return discs of two sizes that start at the same places in any container of the size of a circle of radius 6."""
    x = np.array([(a + 6.0, b + 6.0) for a in (-3.0, 0.1, 3.0) for b in (-2.5, 0.0, 2.7)])
    x += np.asarray(container.faces[0].centre[:2]) - 6.0
    v = np.random.default_rng(4).normal(size=x.shape)
    species = [gas.Species(carom.Disc(0.5, 1.0), 5, "a"), gas.Species(carom.Disc(0.9, 2.0), 4, "b")]
    return gas.Gas(species, container, contacts=ROUGH, position=x, velocity=v, **options)


def test_a_curve_that_is_a_circle() -> None:
    """Rough discs, with and without a force: the same places after some thirty contacts, relative to the centre."""
    circle, curve = gas.container("circle", radius=6.0), gas.container("curve", r="6")
    assert (curve.volume, curve.names) == (pytest.approx(circle.volume, rel=1e-12), ("edge1",))
    assert sum(face.area for face in curve.faces) == pytest.approx(12 * math.pi, rel=1e-12)
    for gravity in ((0.0, 0.0), (0.3, -0.5)):
        found = []
        for container in (circle, curve):
            made = shaken(container, gravity=gravity)
            made.run(until=6.0)
            places = np.asarray(made.balls().position)[:, :2] - np.asarray(container.faces[0].centre[:2])
            found.append((places, made.collisions))
        assert found[0][1] == found[1][1] > 20
        assert found[0][0] == pytest.approx(found[1][0], abs=1e-9)


def test_a_gas_stays_in_its_curve_and_is_restored() -> None:
    """A dense gas in a room with inflections; its state goes on with the same bits."""
    room = gas.container("curve", r="6 + cos(3*theta)")
    made = shaken(room)
    made.run(collisions=300)
    again = gas.Gas.restore(made.state())
    radius = np.repeat([0.5, 0.9], [5, 4])
    for one in (made, again):
        one.run(collisions=100)
    x = np.asarray(made.balls().position)
    assert (x == np.asarray(again.balls().position)).all()
    assert room.clearance(radius, np.c_[x[:, :2], np.zeros(9)]).min() > -1e-12


def test_a_dense_start_grows_in_its_curve() -> None:
    """Growing discs: two of three parts of a room with inflections; and their walls press as a gas does."""
    room = gas.container("curve", r="6 + cos(3*theta)")
    radius = math.sqrt(0.6 * room.volume / (40 * math.pi))
    x = np.asarray(gas.dense([radius] * 40, room, seed=3))
    assert room.clearance(radius, np.c_[x[:, :2], np.zeros(40)]).min() > -1e-12


def test_gaps_are_distances() -> None:
    """From 1,000 random places, against nearest points of the curve by its formula."""
    curve = CURVES["flower"][0]
    room = gas.container("flower", leaves=5, eps=0.3, radius=1.0)
    x = np.random.default_rng(2).uniform(-1.3, 1.3, size=(1000, 2))
    gap = room.clearance(0.05, np.c_[x + room.faces[0].centre[:2], np.zeros(1000)])
    # (near the wall to rounding, elsewhere as good as a polygon)
    off = np.abs(np.abs(gap + 0.05) - depth(curve, x))
    assert off.max() < 1e-4
    assert off[np.abs(gap) < 1e-3].max() < 1e-12


def test_every_plane_figure_holds_a_gas() -> None:
    found = {}
    for name, kind in carom.scene.FIGURES.items():
        if name in gas.SHAPES and kind.dimension == 2 and kind.usual:
            made = gas.container(kind(**kind.usual))
            found[name] = (made.volume, sum(face.area for face in made.faces))
            assert made.volume == pytest.approx(kind(**kind.usual).area, rel=1e-9)
            assert found[name][1] == pytest.approx(kind(**kind.usual).length, rel=1e-9)
    assert {"lemon", "mushroom", "squash", "superellipse", "limacon", "flower", "oval"} <= set(found)


def test_a_narrow_figure_is_named() -> None:
    contacts = [{"between": ("a", other), "restitution": 1.0, "friction": 0.0} for other in ("a", "wall")]
    for sizes, said in (
        ({"radius": 0.3}, "container: expected a width along x of"),
        ({"radius": 3.0, "height": 0.5}, "container.height"),
    ):
        with pytest.raises(carom.CaromError) as error:
            gas.GasScene(
                container={"shape": "circle", **sizes},
                species=[{"count": 3, "radius": 0.5}],
                contacts=contacts,
                run={"max_events": 9},
            )
        assert said in str(error.value)
        assert "\n" not in str(error.value)
