"""Numbers that only damaged files have: tiny intervals, places beyond all lengths, units of thousands of letters."""

from __future__ import annotations

import numpy as np
import pytest

from carom.core.units import parse_quantity
from carom.tracks.floor import shared_fraction
from carom.tracks.formats.missing import without_marked_places
from carom.tracks.frame_clock import file_interval
from carom.tracks.track import Track


def test_a_tiny_step_of_time_does_not_make_a_clock():
    time = np.round(np.arange(40) / 120, 8)
    time[1] = 1e-320  # one damaged cell: clocks with intervals of 1e-320 s were tried, for hours
    assert file_interval(time, 120.0) in (None, pytest.approx(1 / 120, rel=1e-3))


def test_a_fit_without_an_error_has_the_prior_s_fraction():
    assert shared_fraction(0.0, 1.0, 0.0) == 0.0
    assert shared_fraction(0.1, 0.2, 0.0) == pytest.approx(1.0)


def test_places_beyond_all_lengths_are_left_to_their_check():
    place = np.full((5, 2), 1e308)
    assert without_marked_places(Track("a", np.arange(5.0), place), 1e-3).position.tolist() == place.tolist()


def test_a_long_unit_is_refused_at_once():
    with pytest.raises(ValueError, match="is not a known unit"):
        parse_quantity("30" + 50_000 * "A", "m")
