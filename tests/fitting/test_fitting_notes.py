"""What a fit says of a contact height that nobody gave, and of a chi^2 that is seldom so large."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from reference.commands import command

import carom
from carom.data import make_rebounds
from carom.data.rebounds import Rebounds
from carom.fitting.verdict import Adequacy

A = 0.025
BALL = carom.Ball(radius=A, mass=0.04)


def rolling_balls(count: int = 24) -> Rebounds:
    """Balls that roll into a vertical wall and, after it, roll again."""
    rng = np.random.default_rng(1)
    v_n, v_t = rng.uniform(0.5, 2.0, count), rng.uniform(-1, 1, count)
    before = carom.rolling(BALL, np.stack([-v_n, v_t], axis=-1), np.zeros(count))
    v = carom.two_step(BALL, before, wall=carom.Surface(0.72, 0.18), floor=carom.Surface(0.0, 0.25)).rolling.velocity
    columns = {"v_n_in": v_n, "v_t_in": v_t, "spin_z_in": np.zeros(count)}
    columns |= {f"v_{name}_out": v[:, k] + 0.005 * rng.normal(size=count) for k, name in enumerate("nt")}
    return make_rebounds("table", columns | {"sigma_v_n_out": 0.005, "sigma_v_t_out": 0.005}, stage="rolling")


@pytest.mark.parametrize(
    ("words", "said"), [((), True), (("--contact-height", "1.25"), False), (("--fit", "contact_height"), False)]
)
def test_an_assumed_height_is_noted(
    words: tuple[str, ...], said: bool, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = rolling_balls().save(tmp_path / "rebounds.csv")
    options = ("--radius", str(A), "--laws", "mirror", "--no-profiles", "--bootstrap", "0")
    code, _out, err = command(capsys, "fit", str(file), *options, *words)
    assert code == 0, err
    assert ("--contact-height is not given: assumed to be 1" in " ".join(err.split())) is said


def test_a_law_that_fits_poorly_is_said_to() -> None:
    words = [
        Adequacy(p, q, "v_t on spin", False, 1.0).in_words("contact")
        for p, q in ((0.4, 0.3), (0.002, 0.3), (0.4, 0.0012))
    ]
    assert words == [
        "its chi^2 is as expected (p = 0.4)", "contact fits poorly: its chi^2 is large (p = 0.002)",
        "contact fits poorly: its residuals depend on what came before (v_t on spin, p = 0.0012)",
    ]  # fmt: skip


def test_groups_of_which_one_is_far_more_exact_have_a_scatter() -> None:
    from carom.fitting.ranking import _scatter

    chance, between, _mean, stderr = _scatter(np.array([0.0, 3.0]), np.array([1e-30, 1.0]))
    # weights 1e30 and 1: q = 9, of which 1 is expected, over their sum less that of squares over it, 2
    assert chance == pytest.approx(0.0027, rel=0.01)
    assert between == pytest.approx(8 / 2)
    assert np.isfinite(stderr)
