"""Names of the release before are read as the new ones, with a warning."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import carom
from carom.data.rebounds import make_rebounds
from carom.errors import CaromError
from carom.fitting import Setting, make_problem
from carom.fitting.shared_errors import film_says
from carom.public.renamed import with_old_keys
from carom.sweeps import ImpactCase
from carom.tracks import Settings
from carom.tracks.floor import FloorEstimates, WithError


def warned(match: str) -> Any:
    return pytest.warns(DeprecationWarning, match=match)


def test_settings_of_a_film_take_the_old_names() -> None:
    with warned("cloth is called floor_friction now"):
        old = Settings(cloth=0.2)  # type: ignore[call-arg]
    assert old == Settings(floor_friction=0.2)
    with warned("Settings.rolling is called rolling_resistance now"):
        assert Settings(rolling_resistance=0.01).rolling == 0.01
    with pytest.raises(CaromError, match="expected floor_friction alone, got both"):
        Settings(cloth=0.2, floor_friction=0.2)  # type: ignore[call-arg]


def test_estimates_of_the_floor_answer_to_the_old_name() -> None:
    floor = FloorEstimates({"floor friction": WithError(0.2, 0.01)})
    with warned("floor friction"):
        assert floor["cloth friction"].value == 0.2
    with pytest.raises(KeyError):
        FloorEstimates()["cloth friction"]


@pytest.mark.parametrize("name", ["floor_friction", "cloth_friction"])
def test_a_table_says_the_friction_of_the_floor_by_either_name(name: str) -> None:
    ones = np.ones(12)
    speeds = {"v_n_in": ones, "v_t_in": ones, "v_n_out": 0.8 * ones, "v_t_out": 0.7 * ones}
    errors = {f"sigma_{of}_out": 0.02 * ones for of in ("v_n", "v_t")}
    table = make_rebounds(
        "table", speeds | errors, stage="rolling", extra={name: 0.23 * ones, f"sigma_{name}": 0.01 * ones}
    )
    assert film_says(table, "floor_friction") == (0.23, 0.01, 1)
    assert make_problem(table, Setting(radius=0.03))[0].setting.floor_friction == 0.23


def test_an_impact_and_its_sweep_take_the_old_height() -> None:
    with warned("cushion_height is called contact_height now"):
        old = ImpactCase(cushion_height=1.2)  # type: ignore[call-arg]
    assert old == ImpactCase(contact_height=1.2)
    with warned("cushion_height is called contact_height now"):
        space = carom.Space(old, {"cushion_height": [1.1, 1.2]})
    assert list(space.parameters) == ["contact_height"]


def test_json_keeps_the_old_keys() -> None:
    assert with_old_keys({"new": 1, "other": 2}, {"old": "new", "gone": "never"}) == {"new": 1, "other": 2, "old": 1}
