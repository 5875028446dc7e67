"""Orbits that are followed in step, in vector registers, have the bits of orbits that are followed alone."""

from __future__ import annotations

import numpy as np
import pytest

import carom
from carom import billiards
from carom.billiards.loop import CHUNK, LANES, STATE, T, U, V, W, X, Y, chunk_in_step, goes_in_step
from carom.billiards.setup import orbit_setup

DISC = carom.Disc(0.1, 1.0, 0.45)
TABLES = {
    "circle": billiards.circle(),
    "triangle": billiards.regular(3),
    "rectangle": billiards.rectangle(1.3, 0.7),
    "dodecagon": billiards.regular(12),
}


def in_step(table: billiards.Table, law: str) -> bool:
    setup = orbit_setup(table, DISC, law, None, "end")
    return goes_in_step(setup.world.view(np.recarray)[0], setup.pieces.view(np.recarray))


@pytest.mark.parametrize("name", TABLES)
@pytest.mark.parametrize("bounces", [1, CHUNK, 2 * CHUNK + 17, 1000])
def test_many_orbits_have_the_bits_of_each(name: str, bounces: int) -> None:
    table, count = TABLES[name], 2 * LANES + 3
    assert in_step(table, "no-slip")
    start = billiards.starts(table, count, 5, ball=DISC)
    state, t, made, why = billiards.final(table, start, bounces, ball=DISC)
    for k in range(count):
        one = billiards.Start(start.position[k], start.velocity[k], start.spin[k])
        alone, its_t, its_count, _why = billiards.final(table, one, bounces, ball=DISC)
        assert (made[k], t[k]) == (its_count, its_t)
        for field in ("position", "velocity", "spin"):
            assert (getattr(state, field)[k] == getattr(alone, field)).all()
    assert (why == 0).all()


def test_an_orbit_that_ends_in_a_corner_among_others() -> None:
    table = billiards.rectangle(1.0, 1.0)
    x, v, w = np.full((LANES, 2), 0.1), np.full((LANES, 2), (0.3, 0.7)), np.zeros(LANES)
    x[3], v[3] = (0.2, 0.2), (1.0, 1.0)  # straight into the corner
    start = billiards.Start(x, v, w)
    _state, _t, made, why = billiards.final(table, start, 400, ball=DISC)
    assert billiards.ENDS[int(why[3])] == "corner"
    assert made[3] < 400
    alone = billiards.final(table, billiards.Start(x[0], v[0], w[0]), 400, ball=DISC)
    assert (made[[0, -1]] == alone[2]).all()
    assert (_state.position[0] == alone[0].position).all()


def test_parts_have_the_bits_of_the_whole() -> None:
    table = TABLES["circle"]
    start = billiards.starts(table, 2 * LANES, 3, ball=DISC)
    whole = billiards.final(table, start, 5000, ball=DISC)
    parts = billiards.final(table, start, 5000, ball=DISC, progress=lambda _done, _all, _text: None)
    assert (whole[0].position == parts[0].position).all()
    assert (whole[1] == parts[1]).all()


def test_what_does_not_go_in_step() -> None:
    assert not in_step(billiards.stadium(), "no-slip")
    assert not in_step(TABLES["circle"], "mirror")


@pytest.mark.parametrize("name", TABLES)
def test_a_bounce_in_step_is_that_of_each_ball(name: str) -> None:
    """Nothing here comes to a corner: whatever is given up would only be slower, and is seen by no other test."""
    table = TABLES[name]
    setup = orbit_setup(table, DISC, "no-slip", None, "end")
    world, pieces = setup.world.view(np.recarray)[0], setup.pieces.view(np.recarray)
    start = billiards.starts(table, LANES, 5, ball=DISC)
    s = np.zeros(STATE)
    for row, values in zip((X, Y, U, V, W), (*start.position.T, *start.velocity.T, start.spin), strict=True):
        s[row : row + LANES] = values
    assert chunk_in_step(world, pieces, s)
    state, t, _made, _why = billiards.final(table, start, CHUNK, ball=DISC)
    for row, values in zip((X, Y), state.position.T, strict=True):
        np.testing.assert_allclose(s[row : row + LANES], values, atol=1e-12)
    np.testing.assert_allclose(s[T : T + LANES], t, rtol=1e-13)
