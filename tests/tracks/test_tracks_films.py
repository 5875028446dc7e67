"""Several films as one table of rebounds."""

from __future__ import annotations

import numpy as np
import pytest

from carom.data import make_rebounds
from carom.errors import CaromError
from carom.tracks.films import combined_rebounds


def test_a_ball_on_a_table_and_one_in_flight_make_no_table() -> None:
    flight = make_rebounds("planar", {"v_n_in": [1.0], "v_n_out": [0.8]})
    after = {"v_n_in": [1.0], "v_t_in": [0.5], "v_n_out": [0.8]}
    rolling = make_rebounds("table", after, stage="after_wall")
    with pytest.raises(CaromError, match=r"expected films of one kind, got a ball on a table in 'two' .* in 'one'"):
        combined_rebounds({"one": flight, "two": rolling})


def test_what_one_film_lacks_is_missing_in_its_rows_only() -> None:
    spins = {"spin_out": [3.0, 4.0], "sigma_spin_out": [0.1, 0.2]}
    one = make_rebounds("planar", {"v_n_in": [1.0, 1.1], "v_n_out": [0.8, 0.9], **spins})
    two = make_rebounds("planar", {"v_n_in": [2.0], "v_n_out": [1.5]}, extra={"shot": np.array([7.0])})
    both = combined_rebounds({"one": one, "two": two})
    np.testing.assert_array_equal(both.extra["film"], ["one", "one", "two"])
    np.testing.assert_array_equal(both["v_n_out"], [0.8, 0.9, 1.5])
    np.testing.assert_array_equal(both["spin_out"], [3.0, 4.0, np.nan])
    np.testing.assert_array_equal(both.sigma["spin_out"], [0.1, 0.2, np.nan])
    np.testing.assert_array_equal(both.extra["shot"], [np.nan, np.nan, 7.0])
