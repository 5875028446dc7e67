"""Drag and lift from flights with known spins: of drawn flights, as numbers and as forms; what is refused."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import carom
from carom.plot.fit import plot_flights

api: Any = carom  # (parts of scenes as dicts)
LIFT = {"form": "saturating", "slope": 1.0, "saturation": 2.0}


def flights(count: int, noise: float) -> tuple[Any, dict[str, Any]]:
    """Return the scene of a ball, and so many flights of it with noise."""
    rng = np.random.default_rng(3)
    ball = {"radius": 0.02, "mass": 0.0027, "inertia": "hollow", "position": (0, 0, 1), "drag": 0.54, "lift": LIFT}
    scene = api.Scene(air={"density": 1.2}, balls=[ball], run={"duration": 0.3})
    rows: dict[str, list[Any]] = {name: [] for name in ("t", "ball", "x", "y", "z", "wx", "wy", "wz")}
    for n in range(count):
        spin = rng.normal(0, 120, 3)
        start = {"balls.0.velocity": tuple(rng.normal((6, 0, 2), 1.0)), "balls.0.spin": tuple(spin)}
        t = np.linspace(0, 0.3, 25 + n % 3)
        place = api.simulate(api.replaced(scene, start)).at(t).position[:, 0] + rng.normal(0, noise, (len(t), 3))
        for name, values in zip(("x", "y", "z", "wx", "wy", "wz"), (*place.T, *spin), strict=True):
            rows[name].extend(np.broadcast_to(values, len(t)).tolist())
        rows["t"].extend((0.5 + t).tolist())
        rows["ball"].extend([f"flight {n}"] * len(t))
    return scene, rows


def test_a_law_is_found_again_in_every_form() -> None:
    scene, rows = flights(12, 1e-3)
    other = {"balls.0.drag": 0.4, "balls.0.lift.slope": 0.5, "balls.0.lift.saturation": 1.0}
    found = carom.fit_air(rows, api.replaced(scene, other))
    for name, value in {"balls.0.drag": 0.54, "balls.0.lift.slope": 1.0, "balls.0.lift.saturation": 2.0}.items():
        assert abs(found.values[name] - value) < 4 * found.errors[name]
        assert found.errors[name] < 0.2 * value
    assert found.flights == 12
    assert found.residual == pytest.approx(1e-3 * 3**0.5, rel=0.15)
    table = {"form": "table", "spin_ratio": [0.1, 0.5, 1.0], "values": [0.1, 0.1, 0.1]}
    tabled = carom.fit_air(rows, api.replaced(scene, {"balls.0.lift": table}))
    assert tabled.residual == pytest.approx(found.residual, rel=0.05)
    assert tabled.values["balls.0.lift.values.1"] == pytest.approx(0.25, abs=0.03)


def test_a_flight_that_is_another_is_left_out() -> None:
    scene, rows = flights(8, 1e-4)
    here = np.array(rows["ball"]) == "flight 3"
    rows["x"] = np.where(here, np.array(rows["x"]) * 1.3, rows["x"])
    rows["y"] = np.where(here, np.square(rows["x"]), rows["y"])
    found = carom.fit_air(rows, scene)
    assert found.flights == 7
    assert any("left out" in note for note in found.notes)
    assert found.values["balls.0.drag"] == pytest.approx(0.54, abs=0.01)
    spin, speed, flight = plot_flights(found).axes  # each flight keeps its number
    assert flight.lines[0].get_xdata().tolist() == [1, 2, 3, 5, 6, 7, 8]
    assert [axes.get_xlabel() for axes in (spin, speed)] == ["spin ratio", "speed, m/s"]
    assert np.mean(flight.lines[0].get_ydata() ** 2) == pytest.approx((1e3 * found.residual) ** 2)


def test_a_flight_with_a_bounce_in_it_is_said() -> None:
    scene, rows = flights(1, 0.0)
    assert not carom.fit_air(rows, scene).notes
    rows["z"] = np.abs(np.array(rows["z"]) - 1.2) + 1.2
    assert any("a bounce in it" in note for note in carom.fit_air(rows, scene).notes)


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"air": None, "balls.0.drag": None, "balls.0.lift": None}, "scene"),
        ({"balls.0.drag": "tennis", "balls.0.lift": "tennis"}, "scene"),
        ({}, "file"),
    ],
)
def test_what_is_refused(change: Any, field: str) -> None:
    scene, rows = flights(1, 0.0)
    given = api.replaced(scene, change) if change else scene
    if not change:
        del rows["wx"]
    with pytest.raises(carom.CaromError) as raised:
        carom.fit_air(rows, given)
    assert [fault.field for fault in raised.value.records] == [field]
