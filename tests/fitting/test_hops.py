"""A rolling ball hops at a vertical wall: how fast, and what `carom fit` says where that spoils what films from above show."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from reference.commands import command

import carom
from carom.data import make_rebounds
from carom.data.rebounds import Rebounds
from carom.fitting import Setting, fit_laws, make_problem
from carom.fitting.adequacy import Adequacy
from carom.fitting.hops import hop_speeds

A, E, MU, MU_FLOOR = 0.025, 0.72, 0.18, 0.25
BALL = carom.Ball(radius=A, mass=0.04)


def as_filmed(stage: str, film: bool = True, count: int = 24) -> Rebounds:
    """Rolling balls at a vertical wall; as they leave the wall with v_n too large by the hop, as a film from above shows it."""
    rng = np.random.default_rng(1)
    v_n, v_t = rng.uniform(0.5, 2.0, count), rng.uniform(-1, 1, count)
    before = carom.rolling(BALL, np.stack([-v_n, v_t], axis=-1), np.zeros(count))
    hit = carom.two_step(BALL, before, wall=carom.Surface(E, MU), floor=carom.Surface(0.0, MU_FLOOR))
    columns = {"v_n_in": v_n, "v_t_in": v_t, "spin_z_in": np.zeros(count)}
    # after the wall the ball flies; the friction of the landing is missing in what was measured
    v = hit.wall.after.velocity if stage == "after_wall" else hit.rolling.velocity
    columns |= {
        "v_n_out": v[:, 0] + 0.005 * rng.normal(size=count),
        "v_t_out": v[:, 1] + 0.005 * rng.normal(size=count),
    }
    sigma = {"sigma_v_n_out": 0.005, "sigma_v_t_out": 0.005}
    extra = {"cloth_friction": np.full(count, MU_FLOOR), "sigma_cloth_friction": np.full(count, 0.01)} if film else {}
    return make_rebounds("table", columns | sigma, stage=stage, extra=extra)


def notes(rebounds: Rebounds, **setting: float) -> list[str]:
    found = fit_laws(
        rebounds,
        Setting(radius=A, floor_friction=MU_FLOOR, **setting),
        ["two-step"],
        profiles=False,
        bootstrap=0,  # type: ignore[arg-type]
    )
    return [note for note in found.notes if note.startswith("hops: ")]


def test_the_speed_of_a_hop_is_that_of_the_engine() -> None:
    rows = as_filmed("after_wall")
    problem, _notes = make_problem(rows, Setting(radius=A))
    before = carom.rolling(BALL, np.stack([-rows["v_n_in"], rows["v_t_in"]], axis=-1), np.zeros(len(rows)))
    for friction in (0.05, 0.18, 1.0):
        hit = carom.impact(BALL, before, surface=carom.Surface(E, friction))
        np.testing.assert_allclose(hop_speeds(problem, E, friction), hit.after.velocity[:, 2], rtol=1e-9)


def test_hops_are_noted_where_they_matter() -> None:
    (note,) = notes(as_filmed("after_wall"))
    assert "it hops, up to " in note
    assert "use the state in which it rolls again (--stage rolling" in note
    assert notes(as_filmed("rolling")) == []
    assert notes(as_filmed("after_wall", film=False)) == []  # measured some other way
    assert notes(as_filmed("after_wall"), contact_height=1.25) == []


@pytest.mark.parametrize(
    ("words", "said"), [((), True), (("--contact-height", "1.25"), False), (("--fit", "contact_height"), False)]
)
def test_an_assumed_height_is_noted(
    words: tuple[str, ...], said: bool, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = as_filmed("rolling", film=False).save(tmp_path / "rebounds.csv")
    options = ("--radius", str(A), "--laws", "mirror", "--no-profiles", "--bootstrap", "0")
    code, _out, err = command(capsys, "fit", str(file), *options, *words)
    assert code == 0, err
    assert ("contact_height: not given; assumed to be 1" in " ".join(err.split())) is said


def test_a_chi2_that_is_seldom_so_large_is_not_as_expected() -> None:
    words = [Adequacy(p, np.nan, "", False, 1.0).in_words() for p in (0.4, 0.002)]
    assert words == [
        "its chi^2 is as expected (p = 0.4)", "its chi^2 is large, but not large enough to reject it (p = 0.002)",
    ]  # fmt: skip
