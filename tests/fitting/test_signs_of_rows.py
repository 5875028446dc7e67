"""A wrong sign or unit of spins or velocities along the wall is noted: every impact at one point conserves v_t + kappa a spin."""

from __future__ import annotations

import numpy as np
import pytest

from carom.data import make_rebounds
from carom.fitting import Setting
from carom.fitting.rows import usable_rows


@pytest.mark.parametrize(
    ("turned", "said"), [("", ""), ("spin_out", "the spins"), ("v_t_out", "v_t_out"), ("spins", "the spins")]
)
def test_a_wrong_sign_is_noted(turned: str, said: str) -> None:
    rng = np.random.default_rng(2)
    a, kappa, v, before = 0.03, 0.4, rng.uniform(1, 3, 12), rng.uniform(-20, 20, 12)
    if turned == "spin_out":
        before = 0 * before
    change = -rng.uniform(0.1, 0.5, 12) * (v - a * before)
    columns = {"v_n_in": v, "v_n_out": 0.8 * v, "v_t_in": v, "v_t_out": v + change + 0.01 * rng.normal(size=12),
               "spin_in": before, "spin_out": before - change / (kappa * a)}  # fmt: skip
    for name in ("spin_in", "spin_out") if turned == "spins" else (turned,) if turned else ():
        columns[name] = -columns[name]
    rows, _setting = usable_rows(make_rebounds("planar", columns), Setting(radius=a, kappa=kappa))
    assert [f"with the other sign of {said} by" in note for note in rows.notes if note.startswith("signs: ")] == [
        True
    ] * bool(said)


@pytest.mark.parametrize(("unit", "kind", "by"), [("speeds in km/h", "v", 3.6), ("spins in rpm", "spin", 30 / np.pi)])
def test_a_unit_that_was_forgotten_is_noted(unit: str, kind: str, by: float) -> None:
    rng = np.random.default_rng(3)
    a, kappa, v, before = 0.03, 0.4, rng.uniform(1, 3, 12), rng.uniform(-20, 20, 12)
    change = -rng.uniform(0.1, 0.5, 12) * (v - a * before)
    columns = {"v_n_in": v, "v_n_out": 0.8 * v, "v_t_in": v, "v_t_out": v + change + 0.01 * rng.normal(size=12),
               "spin_in": before, "spin_out": before - change / (kappa * a)}  # fmt: skip
    columns = {name: column * (by if name.startswith(kind) else 1) for name, column in columns.items()}
    rows, _setting = usable_rows(make_rebounds("planar", columns), Setting(radius=a, kappa=kappa))
    assert [f"with {unit} by" in note for note in rows.notes if note.startswith("units: ")] == [True]
