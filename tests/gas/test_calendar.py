"""The calendar of many balls: what comes out is the earliest, whatever was put in and taken out before."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carom.core.jit.compile import njit
from carom.gas.edmd import calendar as queue
from carom.gas.edmd.calendar import (
    I64,
    PAGE,
    RING,
    U64,
    calendar_sizes,
    load_page,
    nearly_full,
    page_of,
    rebuild,
    schedule,
    unschedule,
)
from carom.gas.edmd.gas_records import NO_BALL, PLAN, Calendar

BALLS = 300


def _earliest(plans, calendar, current, bins):
    """The ball of the earliest event, the current bin and how often the void notes had to go, as the loop has it; or -1."""
    while current < bins and calendar.heads[U64(current & (RING - 1))] == NO_BALL:
        current += 1
        page = page_of(current) + 1
        if current & (PAGE - 1) == 0 and page * PAGE < bins:
            load_page(plans, calendar, page)
    if current == bins:
        return I64(-1), current
    i = I64(calendar.heads[U64(current & (RING - 1))])
    k = plans[U64(i)].next
    while k != NO_BALL:
        if plans[U64(k)].event_time < plans[U64(i)].event_time or (
            plans[U64(k)].event_time == plans[U64(i)].event_time and k < i
        ):
            i = I64(k)
        k = plans[U64(k)].next
    return i, current


@pytest.fixture(scope="module")
def compiled():
    return {one.__name__: njit(one, _nrt=False) for one in (_earliest, schedule, rebuild, nearly_full, unschedule)}


@pytest.mark.parametrize("bins", [4 * BALLS, PAGE // 2, 3 * PAGE])
@pytest.mark.parametrize("crowd", [0.0, 0.9])  # share of the events that fall together
@pytest.mark.slow(keep=2)
def test_the_earliest_comes_first(compiled, bins, crowd):
    rng = np.random.default_rng(bins)
    plans = np.zeros(BALLS + 1, PLAN)
    calendar = Calendar(*(np.zeros(n, np.uint32) for n in calendar_sizes(BALLS, bins)))
    width, current, swept, met = 0.01, 0, 0, 0

    def later(now):
        wait = rng.exponential(bins * width / 3) if rng.random() > crowd else 2 * width * (rng.random() < 0.5)
        return math.inf if rng.random() < 0.02 else now + wait

    plans["event_time"] = [later(0.0) for _ in range(BALLS + 1)]
    compiled["rebuild"](plans, calendar, width, bins, 0)
    while True:
        if compiled["nearly_full"](calendar):
            compiled["rebuild"](plans, calendar, width, bins, current)
            swept += 1
        i, current = compiled["_earliest"](plans, calendar, current, bins)
        if i < 0 or met == 30_000:
            break
        met += 1
        assert plans["event_time"][i] == plans["event_time"].min()
        now = plans["event_time"][i]
        # its own next event, and those of balls that it meets: they come earlier or later than was planned
        for k in {int(i), *rng.integers(0, BALLS + 1, 2).tolist()}:
            compiled["unschedule"](plans, calendar, k)
            plans["event_time"][k] = later(now)
            compiled["schedule"](plans, calendar, k, width, bins, current)
    assert met > 100
    if i < 0:  # nothing of this turn is left
        assert plans["event_time"].min() >= bins * width * (1 - 1e-12)
    if bins == 4 * BALLS and crowd:
        assert swept > 0


def test_what_it_takes():
    # of a large gas: no more than 20 bytes a ball
    count = 100_000
    assert 4 * sum(calendar_sizes(count, 4 * count)) < 20 * count
    assert queue.RING == 2 * PAGE
