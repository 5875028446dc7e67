"""Rebounds that no wall at rest brings about are noted in the table, and in fits; those within their error bars are not."""

from __future__ import annotations

import numpy as np
import pytest

from carom.data import make_rebounds
from carom.data.rebounds import Kind, energy_remarks
from carom.fitting import Setting
from carom.fitting.rows import make_problem


@pytest.mark.parametrize(
    ("after", "sigma", "flagged"),
    [
        (
            [0.9, 1.2],
            0.02,
            "1 of 2 rebounds have a restitution above 1 beyond the error bar, up to 1.2 ± 0.028 at row 2",
        ),
        ([0.9, 1.2], 0.1, ""),
        ([0.9, 1.01], None, ""),
        ([1.1, 1.3], None, "2 of 2 rebounds have a restitution above 1 beyond the error bar, up to 1.3 at row 2"),
    ],
)
def test_restitution(after: list[float], sigma: float | None, flagged: str) -> None:
    bars = {} if sigma is None else {"sigma_v_n_in": sigma, "sigma_v_n_out": sigma}
    table = make_rebounds("planar", {"v_n_in": [1.0, 1.0], "v_n_out": after, **bars})
    notes = [note for note in table.notes if note.startswith("v_n_out: ")]
    assert [flagged in note for note in notes] == ([True] if flagged else [])


def test_errors_that_go_together_tell_more() -> None:
    columns = {"v_n_in": [1.0], "v_n_out": [1.05], "sigma_v_n_in": 0.03, "sigma_v_n_out": 0.03}
    apart = make_rebounds("planar", columns)
    together = make_rebounds("planar", columns, extra={"covariance_v_n": np.array([0.0008])})
    assert [any("restitution above 1" in note for note in table.notes) for table in (apart, together)] == [False, True]


def energy(spin_in: float, spin_out: float, v_t_out: float, kind: Kind = "planar") -> list[str]:
    spin = "spin" if kind == "planar" else "spin_z"
    columns = {
        "v_n_in": 1.0,
        "v_t_in": 1.0,
        f"{spin}_in": spin_in,
        "v_n_out": 0.8,
        "v_t_out": v_t_out,
        f"{spin}_out": spin_out,
    }
    table = make_rebounds(kind, columns, stage=None if kind == "planar" else "rolling")
    return energy_remarks(table, 0.02, 0.4)


def test_energy() -> None:
    assert energy(0.0, 0.0, 1.0) == []
    assert energy(0.0, 30.0, 1.0) == []  # 1.64 + 0.4 * 0.36 < 2
    assert "1 of 1 rebounds have more energy after the contact than before" in energy(0.0, 80.0, 1.0)[0]
    assert energy(100.0, 80.0, 1.0) == []  # it came with more
    assert energy(np.nan, 100.0, 1.0) == []  # it may have
    assert "up to" in energy(np.nan, 0.0, 3.0)[0]  # but not with so much
    assert energy(0.0, 0.0, 1.1, "table") == []
    assert energy(0.0, 0.0, 1.6, "table") != []


@pytest.mark.filterwarnings("error")
def test_energy_of_a_ball_that_hardly_moves() -> None:
    """The square of its speed is next to zero: a file may say 1e-90."""
    columns = {"v_n_in": [1e-90, 1.0], "v_t_in": [0.0, 0.5], "spin_in": [0.0, 0.0], "v_n_out": [1.0, 0.8], "v_t_out": [0.0, 0.4],
               "spin_out": [0.0, 0.0]}  # fmt: skip
    (said,) = energy_remarks(make_rebounds("planar", columns), 0.02, 0.4)
    assert "1 of 2 rebounds have more energy" in said
    columns["v_n_out"][0] = 0.0
    assert energy_remarks(make_rebounds("planar", columns), 0.02, 0.4) == []


def test_fits_warn() -> None:
    n = 12
    rng = np.random.default_rng(1)
    columns = {
        "v_n_in": rng.uniform(1, 2, n),
        "v_t_in": rng.uniform(0.2, 1, n),
        "spin_in": np.zeros(n),
        "spin_out": np.full(n, 200.0),
    }
    columns |= {"v_n_out": 0.8 * columns["v_n_in"], "v_t_out": 0.8 * columns["v_t_in"]}
    _problem, notes = make_problem(make_rebounds("planar", columns), Setting(radius=0.02))
    assert any(note.startswith("energy: 12 of 12 rebounds") for note in notes)
    _problem, notes = make_problem(make_rebounds("planar", columns), Setting(radius=0.0002))
    assert not any(note.startswith("energy: ") for note in notes)
