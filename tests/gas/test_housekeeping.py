"""Balls put in the order of their cells: nobody sees it from outside, and what is near in the room is near in memory."""

from __future__ import annotations

import functools

import numpy as np
import pytest

from carom import Ball, Surface
from carom.core.jit.compile import njit
from carom.gas import Gas, Species
from carom.gas.edmd.calendar import SLOTS, morton_offsets
from carom.gas.edmd.gas_records import NO_BALL
from carom.gas.edmd.loop import sort_by_cell

BOXES = {"periodic": (True, True, True), "walls": (True, False, True)}


def crowd(periodic=(True, True, True), axes=3):
    """Small balls, many in a cell of the one big ball's size, where they have been for a while, in no order."""
    species = [Species(Ball(0.5, 1.0, 0.4), 1, "big"), Species(Ball(0.08, 0.01, 0.4), 400, "small")]
    gas = Gas(species, (5.0,) * axes, contacts=Surface(1.0, 0.3, 0.5), periodic=periodic[:axes], seed=3)
    gas.run(4000)
    return gas


@functools.cache
def sort():
    return njit(sort_by_cell, _nrt=False)


def ordered(gas):
    a = gas.arrays
    sort()(a.balls, a.scratch, a.cells, a.calendar)
    return gas


def slots(arrays):
    """Where each ball's cell begins."""
    places, plans = morton_offsets(arrays.system[0])[0], arrays.balls.plans[:-1]
    return sum(places[k][plans[name]] for k, name in enumerate(("cx", "cy", "cz")))


@pytest.mark.parametrize("periodic", BOXES.values(), ids=BOXES.keys())
@pytest.mark.parametrize("axes", [2, 3])
def test_balls_lie_in_the_order_of_their_cells_and_are_the_same(periodic, axes):
    gas = crowd(periodic, axes)
    before, plans, numbers = gas.balls(), gas.arrays.balls.plans.copy(), gas.arrays.balls.numbers.copy()
    assert (np.diff(slots(gas.arrays)) < 0).any()
    assert np.unique(slots(gas.arrays), return_counts=True)[1].max() > SLOTS + 2
    arrays = ordered(gas).arrays
    assert (np.diff(slots(arrays)) >= 0).all()
    same = np.diff(slots(arrays)) == 0
    assert (np.diff(arrays.balls.numbers.astype(int))[same] > 0).all()
    after = gas.balls()
    for name in ("position", "velocity", "spin", "species", "images"):
        assert getattr(after, name).tobytes() == getattr(before, name).tobytes(), name
    # whom each ball will meet, by number
    assert (numbers == np.arange(len(numbers))).all()
    whom = arrays.balls.plans["partner"][:-1]
    meets = whom != NO_BALL
    assert meets.sum() > 50
    assert (arrays.balls.numbers[whom[meets]] == plans["partner"][:-1][arrays.balls.numbers[meets]]).all()


@pytest.mark.parametrize("periodic", BOXES.values(), ids=BOXES.keys())
def test_what_happens_next_does_not_depend_on_the_order(periodic):
    plain, other = crowd(periodic), ordered(crowd(periodic))
    other = Gas.restore(other.state())
    assert (other.arrays.balls.numbers != np.arange(401)).any()
    for gas in (plain, other):
        gas.run(3000)
    assert other.time == plain.time
    for name in ("position", "velocity", "spin", "images"):
        assert getattr(other.balls(), name).tobytes() == getattr(plain.balls(), name).tobytes(), name


@pytest.mark.parametrize("axes", [2, 3])
@pytest.mark.parametrize("count", [1, 3, 4, 9, 20])
def test_the_curve_has_a_place_for_every_cell(axes, count):
    system = np.zeros(1, [("cells", "i8", (3,)), ("periodic", "i8", (3,)), ("dimensions", "i8")])[0]
    system["cells"], system["periodic"], system["dimensions"] = (count, 5, 7 if axes == 3 else 1), (1, 0, 1), axes
    found, total = morton_offsets(system)
    assert [len(one) for one in found] == [count, 6, 7 if axes == 3 else 1]
    every = (found[0][:, None, None] + found[1][:, None] + found[2]).ravel()
    assert len(np.unique(every)) == len(every)
    assert (every % SLOTS == 0).all()
    assert every.max() < total <= 8 * SLOTS * len(every)
    if count > 3:  # a line of the cache is a block
        assert set(every[every < 16]) == {0, 2, 4, 6, 8, 10, 12, 14}
