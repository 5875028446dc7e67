"""The table of the paper's equations and of the functions that compute and derive them."""

from __future__ import annotations

import importlib

from dev import equations


def test_the_page_is_made_of_todays_sources() -> None:
    assert equations.PAGE.read_text(encoding="utf-8") == equations.page()  # else: python docs/dev/equations.py


def test_every_equation_is_derived_and_the_laws_are_computed() -> None:
    computed, derived = equations.computed(), equations.derived()
    assert all(derived[n] for n in range(1, equations.LAST + 1))
    assert all(computed[n] for n in (1, 2, 3, 4, 5, 8, 11, 18, 19, 20, 22, 24, *range(27, 35), 37, 38, 39))
    assert all(computed[n] or n in equations.ELSEWHERE for n in range(1, equations.LAST + 1))
    assert len(equations.WHAT) == equations.LAST


def test_functions_of_the_table_exist() -> None:
    for places in equations.computed().values():
        for place in places:
            path, _, name = place.partition(".py: ")
            assert hasattr(importlib.import_module("carom." + path.replace("/", ".")), name) or path == "scene/ball"
