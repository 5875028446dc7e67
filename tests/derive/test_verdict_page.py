"""The page of verdicts: the paper's lines beside the derived ones, typeset, with an anchor for each equation."""

from __future__ import annotations

import re

import derived_paper
import pytest

paper = pytest.importorskip("carom.derive.paper")


@pytest.fixture
def equation() -> dict[str, object]:
    entry, verdict = paper.find_entries("12")[0]
    return {"section": 2, **paper.as_record(entry, verdict), **derived_paper.lines(entry)}


def test_lines_stand_side_by_side_and_are_typeset(equation: dict[str, object]) -> None:
    shown = derived_paper.side_by_side(equation)
    assert shown.count("id='eq-12'") == shown.count("href='#eq-12'") == 1
    cells = re.findall(r"<div class='math'>(.*?)</div>", shown)
    assert len(cells) == 4
    assert all(cell.startswith(r"\[") and cell.endswith(r"\]") for cell in cells)
    assert r"\delta_{\psi}" in cells[0]
    assert "θ = π/2, ψ = 0" in shown
    assert "δθ is infinite" in shown


def test_a_line_without_a_partner_has_an_empty_cell(equation: dict[str, object]) -> None:
    shown = derived_paper.side_by_side(equation | {"derived_tex": []})
    assert re.findall(r"<div class='math'>(.*?)</div>", shown)[1::2] == ["", ""]


def test_sentences_have_signs_in_place_of_code() -> None:
    assert (
        derived_paper.in_signs("-sqrt(3)*I/a**2 < pi, dvarphi -> omega_z1") == "-√(3) I/a² &lt; π, dφ → ω<sub>z1</sub>"
    )


def test_quantities_with_names_of_words_are_set_as_signs() -> None:
    entries = [entry for name in ("10", "s4-2", "s4-3") for entry, _ in paper.find_entries(name)]
    shown = " ".join(line for entry in entries for some in derived_paper.lines(entry).values() for line in some)
    assert r"\tan\tau_r" in shown
    assert r"d\varphi/d\theta" in shown
    assert r"\tau_r/1^\circ" in shown
    assert not re.search(r"tan_|deg|dvarphi", shown)


def test_results_of_derivations_are_lines_of_equations() -> None:
    import sympy as sp
    from examples import bodies
    from typeset_results import equations

    jump = bodies.ball_on_wall(nonhol_coneqs=bodies.rolling(), restitution=0).solve()
    lines = equations(jump.impulses)
    assert lines is not None
    assert lines.count(r"\\") == len(jump.impulses) - 1
    assert r"\text{wall.t2} &= \Lambda_{\text{wall.t2}}" in lines
    assert equations([sp.Eq(bodies.m, 1)]) == "\\begin{aligned}\nm &= 1\n\\end{aligned}"
    assert r"\text{wall approaches}:\quad & \dot{x}_{0} < 0" in str(equations(bodies.ball_on_wall().solve().conditions))
    assert equations({"a": {"b": 1}}) is None
