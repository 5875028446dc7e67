"""The calendar of many balls: what comes out is the earliest, whatever was put in and taken out before."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carom.compiled import njit
from carom.engine import queue
from carom.engine.queue import PAGE, RING, S, U, calendar, enqueue, fill, full, open_page, page_of, take_out
from carom.engine.swarm_arrays import NOBODY, PLAN

BALLS = 300


def _earliest(plans, heads, tails, leaves, current, bins):
    """The ball of the earliest event, the current bin and how often the void notes had to go, as the loop has it; or -1."""
    while current < bins and heads[U(current & (RING - 1))] == NOBODY:
        current += 1
        page = page_of(current) + 1
        if current & (PAGE - 1) == 0 and page * PAGE < bins:
            open_page(plans, heads, tails, leaves, page)
    if current == bins:
        return S(-1), current
    i = S(heads[U(current & (RING - 1))])
    k = plans[U(i)].next
    while k != NOBODY:
        if plans[U(k)].at < plans[U(i)].at or (plans[U(k)].at == plans[U(i)].at and k < i):
            i = S(k)
        k = plans[U(k)].next
    return i, current


@pytest.fixture(scope="module")
def compiled():
    return {one.__name__: njit(one, cache=False, _nrt=False) for one in (_earliest, enqueue, fill, full, take_out)}


@pytest.mark.parametrize("bins", [4 * BALLS, PAGE // 2, 3 * PAGE])
@pytest.mark.parametrize("crowd", [0.0, 0.9])  # share of the events that fall together
def test_the_earliest_comes_first(compiled, bins, crowd):
    rng = np.random.default_rng(bins)
    plans = np.zeros(BALLS + 1, PLAN)
    sizes = calendar(BALLS, bins)
    heads, tails, leaves = (np.zeros(n, np.uint32) for n in sizes)
    width, current, swept, met = 0.01, 0, 0, 0

    def later(now):
        wait = rng.exponential(bins * width / 3) if rng.random() > crowd else 2 * width * (rng.random() < 0.5)
        return math.inf if rng.random() < 0.02 else now + wait

    plans["at"] = [later(0.0) for _ in range(BALLS + 1)]
    compiled["fill"](plans, heads, tails, leaves, width, bins, 0)
    while True:
        if compiled["full"](tails):
            compiled["fill"](plans, heads, tails, leaves, width, bins, current)
            swept += 1
        i, current = compiled["_earliest"](plans, heads, tails, leaves, current, bins)
        if i < 0 or met == 30_000:
            break
        met += 1
        assert plans["at"][i] == plans["at"].min()
        now = plans["at"][i]
        # its own next event, and those of balls that it meets: they come earlier or later than was planned
        for k in {int(i), *rng.integers(0, BALLS + 1, 2).tolist()}:
            compiled["take_out"](plans, heads, k)
            plans["at"][k] = later(now)
            compiled["enqueue"](plans, heads, tails, leaves, k, width, bins, current)
    assert met > 100
    if i < 0:  # nothing of this turn is left
        assert plans["at"].min() >= bins * width * (1 - 1e-12)
    if bins == 4 * BALLS and crowd:
        assert swept > 0


def test_what_it_takes():
    # of a large gas: no more than 20 bytes a ball
    count = 100_000
    assert 4 * sum(calendar(count, 4 * count)) < 20 * count
    assert queue.RING == 2 * PAGE
