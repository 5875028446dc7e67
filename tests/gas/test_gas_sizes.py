"""Containers that are very large, flat or long beside their balls: a fault by name, or a gas that fits in memory."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carom import Ball, CaromError, Surface
from carom.gas import Gas, GasScene, Species, dense, lattice
from carom.gas.measures import Measures
from carom.gas.species import CELLS_PER_BALL, cells_at_most, lattice_steps

ELASTIC = Surface(1.0, 0.0, -1.0)


def gas_of(*side: float, count: int = 20) -> Gas:
    return Gas([Species(Ball(0.5, 1.0), count)], side, contacts=ELASTIC, seed=1)


@pytest.mark.parametrize("side", [(1e23, 1e23, 1e23), (1e23, 5.0, 5.0), (5.0, 6e8, 5.0)])
@pytest.mark.parametrize("start", ["lattice", "random"])
def test_sides_beyond_double_precision_are_refused(side: tuple[float, ...], start: str) -> None:
    with pytest.raises(
        CaromError, match=r"container.size\[\d\]: expected at most 1e\+09 radii of the smallest ball, 5e\+08, got"
    ):
        gas_of(*side)
    contact = {"between": ("a", "a"), "restitution": 1, "friction": 0}
    with pytest.raises(CaromError) as found:
        GasScene(
            container={"shape": "periodic", "size": side},
            species=[{"count": 20, "radius": 0.5}],
            contacts=[contact],
            run={"max_events": 5, "start": start},
        )
    assert len(found.value.faults) == sum(x > 5e8 for x in side)
    assert all("container.size[" in fault and "expected at most 1e+09 radii" in fault for fault in found.value.faults)


@pytest.mark.parametrize(("side", "count"), [((100.0, 100.0, 100.0), 500), ((300.0, 300.0), 400)])
def test_a_dilute_gas_has_about_half_a_ball_in_a_cell(side: tuple[float, ...], count: int) -> None:
    """With few cells every ball looks at many others, with many most of them are empty."""
    gas = Gas([Species(Ball(0.5, 1.0) if len(side) == 3 else _disc(), count)], side, contacts=ELASTIC, seed=1)
    cells = math.prod(gas.arrays.system[0]["cells"].tolist())
    assert 0.3 <= count / cells <= 0.8


@pytest.mark.parametrize(
    "side", [(4e8, 5.0, 5.0), (4e8, 4e8, 5.0), (4e8, 4e8, 4e8), (1e4, 3.1, 3.1), (1e8, 4.0), (3e8, 3e8)]
)
def test_large_and_long_boxes_fit_in_memory(side: tuple[float, ...]) -> None:
    """What is allocated grows with the balls, not with the box."""
    gas = Gas([Species(Ball(0.5, 1.0) if len(side) == 3 else _disc(), 20)], side, contacts=ELASTIC, seed=1)
    assert gas.bytes_per_ball < 20_000
    assert math.prod(gas.arrays.system[0]["cells"].tolist()) <= 27 + CELLS_PER_BALL * 20
    gas.run(30, until=1e3)
    Measures(gas).sample(gas)
    x = dense(np.full(20, 0.5), side, seed=1)
    assert (x[:, : len(side)] >= 0).all()
    assert (x[:, : len(side)] <= side).all()


def _disc() -> Ball:
    from carom import Disc

    return Disc(0.5, 1.0)


def test_a_long_box_collides_as_brute_force_has_it() -> None:
    """Few and long cells, many balls in each: the next collision is that of all pairs."""
    gas = gas_of(400.0, 3.2, 3.2, count=40)
    balls, side = gas.balls(), np.array([400.0, 3.2, 3.2])
    r = balls.position[:, None] - balls.position
    v = balls.velocity[:, None] - balls.velocity
    first = math.inf
    for image in np.stack(np.meshgrid(*[[-1, 0, 1]] * 3), axis=-1).reshape(-1, 3):
        q = r + image * side
        b, c, vv = (q * v).sum(-1), (q * q).sum(-1) - 1.0, (v * v).sum(-1)
        with np.errstate(all="ignore"):
            t = np.where((b < 0) & (b * b > vv * c) & (vv > 0), (-b - np.sqrt(b * b - vv * c)) / vv, math.inf)
        first = min(first, float(t[c > 1e-9].min(initial=math.inf)))
    run = gas.run(1)
    assert run.simulated_time == pytest.approx(first, rel=1e-9)


def test_cells_are_reduced_only_where_there_are_too_many() -> None:
    rng = np.random.default_rng(2)
    for _ in range(300):
        numbers, balls = (10 ** rng.uniform(0, 6, 3)).tolist(), int(10 ** rng.uniform(0, 5))
        found = cells_at_most(numbers, balls)
        whole = [int(x) for x in numbers]
        assert math.prod(found) <= 27 + CELLS_PER_BALL * balls
        assert all(1 <= n <= w for n, w in zip(found, whole, strict=True))
        if math.prod(numbers) <= 27 + CELLS_PER_BALL * balls:
            assert found == whole


def test_a_lattice_in_a_flat_box_has_not_many_more_sites_than_balls() -> None:
    assert lattice_steps([4.0, 4.0, 4.0], 256, 4) == [4.0, 4.0, 4.0]
    assert math.prod(lattice_steps([1e9, 1.0, 1.0], 64, 4)) == pytest.approx(16)
    x = lattice(64, (1e9, 1.0, 1.0))
    assert len(np.unique(x[:, 0])) >= 16


@pytest.mark.parametrize("until", [math.nan, "soon", None, True])
def test_a_time_that_is_none_is_refused(until: object) -> None:
    gas = gas_of(6.0, 6.0, 6.0)
    with pytest.raises(CaromError, match="until: expected a time, or inf, got"):
        gas.run(until=until)  # type: ignore[arg-type]
    with pytest.raises(CaromError, match="until: expected a time, or inf, got"):
        gas.advance(10, until=until)  # type: ignore[arg-type]


@pytest.mark.parametrize("options", [{"collisions": -1}, {"collisions": 2.5}, {"collisions": 5, "chunk": 0}])
def test_counts_that_are_none_are_refused(options: dict[str, object]) -> None:
    with pytest.raises(CaromError, match="expected a whole number >= "):
        gas_of(6.0, 6.0, 6.0).run(**options)  # type: ignore[arg-type]


@pytest.mark.parametrize("field", ["mass", "radius"])
def test_sizes_below_the_least_are_refused(field: str) -> None:
    contact = {"between": ("a", "a"), "restitution": 1, "friction": 0}
    with pytest.raises(CaromError, match=f"species.0..{field}: expected .*, at least 1e-100 in size, got 1e-320"):
        GasScene(
            container={"shape": "periodic", "size": (6, 6, 6)},
            species=[{"count": 20, "radius": 0.5} | {field: 1e-320}],
            contacts=[contact],
            run={"max_events": 5},
        )


def test_a_share_of_cells_that_is_a_whole_number_is_not_one_less() -> None:
    """Of 27 + 8 · 163 = 11³ cells, whose cube root is below 11 by rounding."""
    assert CELLS_PER_BALL == 8
    assert cells_at_most([1e9, 1e9, 1e9], 163) == [11, 11, 11]
