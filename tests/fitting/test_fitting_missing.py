"""Fits of tables that lack columns: what was not measured does not enter the likelihood, and what it leaves open is said."""

from __future__ import annotations

import re

import numpy as np
import pytest
from reference.commands import command
from reference.synthetic_bounces import SETTING, measured_bounces

from carom.data import make_rebounds, read_rebounds
from carom.errors import CaromError
from carom.fitting import fit_law, fit_laws, make_problem
from carom.fitting.laws import laws_named
from carom.plot.fit import write_report

LAW = laws_named(["contact"], "planar", True)[0][0]
AFTER = ("v_n_out", "v_t_out", "spin_out")


def without(columns, *names):
    """The columns without some, and without their error bars."""
    return {name: column for name, column in columns.items() if name.removeprefix("sigma_") not in names}


def fitted(columns):
    return fit_law(LAW, make_problem(make_rebounds("planar", columns), SETTING)[0])


@pytest.mark.parametrize("missing", [("v_n_out",), ("v_n_out", "v_t_out"), ("v_n_out", "spin_out"), ("v_t_out",)])
def test_what_was_not_measured_is_what_was_measured_with_an_endless_error(missing):
    columns = measured_bounces(4, 40)
    useless = columns | {f"sigma_{name}": np.full(40, 1e7) for name in missing}
    lacks, drowned = fitted(without(columns, *missing)), fitted(useless)
    assert lacks.dof == drowned.dof - 40 * len(missing)
    assert lacks.chi2 == pytest.approx(drowned.chi2, abs=1e-3)
    told = [name for name, estimate in lacks.estimates.items() if estimate.stderr]
    assert "tangential_restitution" in told
    for name in told:
        one, other = lacks.estimates[name], drowned.estimates[name]
        assert one.value == pytest.approx(other.value, abs=0.01 * one.stderr)
        assert one.stderr == pytest.approx(other.stderr, rel=0.01)


def test_spins_alone_tell_what_the_spin_depends_on():
    columns = without(measured_bounces(2, 60), "v_n_out", "v_t_out")
    fit = fitted(columns)
    assert fit.problem.count == 60
    returned = fit.estimates["tangential_restitution"]
    assert abs(returned.value - 0.3) < 3 * returned.stderr
    assert fit.untold == ("restitution", "friction")
    # what sliding contacts tell: 0.2 times 1.8
    (said,) = fit.degenerate
    assert float(re.search(r"friction \(1 \+ restitution\) = ([\d.]+)", said)[1]) == pytest.approx(0.36, abs=0.006)


def test_what_sticks_tells_neither_restitution_nor_more_than_a_least_friction():
    fit = fitted(without(measured_bounces(2, 60, mu=2.0), "v_n_out", "spin_out"))
    assert fit.untold == ("restitution", "friction")
    (said,) = fit.degenerate
    limit = float(re.search(r"a lower limit of friction \(1 \+ restitution\) is identifiable: ([\d.]+)", said)[1])
    assert 0.5 < limit < 2.0 * 1.8


def test_empty_cells_after_the_wall_are_not_measured():
    columns = measured_bounces(3, 30)
    columns["v_n_out"][::3] = columns["sigma_v_n_out"][::3] = np.nan
    columns["v_t_out"][4] = np.nan
    table = make_rebounds("planar", columns)
    problem, notes = make_problem(table, SETTING)
    assert problem.count == 90 - 11
    assert "v_n_out: not measured in 10 of 30 rows; it does not enter the likelihood there" in notes
    fit = fit_law(LAW, problem)
    for name, value in (("restitution", 0.8), ("friction", 0.2), ("tangential_restitution", 0.3)):
        assert abs(fit.estimates[name].value - value) < 4 * fit.estimates[name].stderr
    with pytest.raises(CaromError, match="v_n_in: expected a finite number, got an empty cell at row 1"):
        make_rebounds("planar", columns | {"v_n_in": np.full(30, np.nan)})


@pytest.mark.slow
def test_a_table_of_spins_is_fitted_from_the_command_line(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    make_rebounds("planar", without(measured_bounces(2, 40), "v_n_out", "v_t_out")).save("spins.csv")
    text = (tmp_path / "spins.csv").read_text().splitlines()
    kept = [i for i, name in enumerate(text[0].split(",")) if name not in ("v_n_out", "v_t_out")]
    lines = [",".join(line.split(",")[i] for i in kept) for line in text]
    (tmp_path / "spins.csv").write_text("\n".join(lines) + "\n")
    assert np.isnan(read_rebounds("spins.csv")["v_n_out"]).all()
    words = (
        "--radius",
        "0.02",
        "--inertia",
        "hollow",
        "--laws",
        "contact,sliding",
        "--bootstrap",
        "0",
        "--report",
        "page.html",
    )
    code, out, err = command(capsys, "fit", "spins.csv", *words)
    assert code == 0, err
    assert "v_t_out: not measured; only spin_out depends on friction" in err
    assert "Unconstrained parameters" in out
    assert (tmp_path / "page.html").read_text().count("<svg") == 1 + 3


@pytest.mark.parametrize("keep", [("v_t_out",), ("v_n_out",), ("spin_out",), ("v_n_out", "v_t_out")])
@pytest.mark.slow(keep=1)
def test_reports_are_drawn_of_what_there_is(tmp_path, keep):
    columns = without(measured_bounces(6, 30), *(name for name in AFTER if name not in keep))
    ranking = fit_laws(make_rebounds("planar", columns), SETTING, ["contact", "sliding"], bootstrap=0, profiles=False)
    page = write_report(ranking, tmp_path / "page.html").read_text()
    assert page.count("<svg") == 1 + 3 * len(keep)
    assert ranking.fits


def test_a_table_too_short_for_any_law_is_refused_in_one_line(tmp_path, capsys):
    """There was a line for each law and each note."""
    table = tmp_path / "three.csv"
    table.write_text("v_n_in,v_n_out\n4.4,3.3\n3.9,2.9\n3.1,2.3\n")
    code, told, notes = command(capsys, "fit", str(table), "--kind", "planar", "--radius", "0.033")
    assert (code, told) == (2, "")
    (line,) = [one for one in notes.splitlines() if one.startswith("carom: ")]
    assert (
        "expected 4 measured numbers or more, which mirror needs, got 3; measure more (restitution of each row: 0.750,"
        in line
    )
