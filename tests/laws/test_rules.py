"""Conditions of laws are kernels that take arrays as they take numbers, and every law's rules are data for the explorer."""

from __future__ import annotations

import string

import numpy as np
import pytest

import carom
from carom.bodies import Surface
from carom.explorer.entries import rule_name, rules_of
from carom.laws.law import Meeting
from carom.laws.registry import laws

COUNT = 60


def meetings() -> tuple[Meeting, list[Meeting]]:
    """Return balls at walls as one meeting of arrays, and one by one."""
    rng = np.random.default_rng(3)
    v = rng.normal(size=(COUNT, 3)) * rng.choice([0.0, 1.0], (COUNT, 3)) - (1.0, 0.0, 0.0)
    v[::7] = 1e-130
    w = np.where(rng.random((COUNT, 1)) < 0.5, np.cross((0.0, 0.0, 1.0), v) / 0.03, rng.normal(size=(COUNT, 3)))
    tilt = rng.choice([0.0, 0.3, -0.3], COUNT)
    n = np.column_stack((np.sqrt(1 - tilt * tilt), 0 * tilt, tilt))
    e, beta = rng.choice([1.0, 0.8], COUNT), rng.choice([0.0, 0.5, -1.0], COUNT)
    mu, k, height = (
        rng.choice([0.0, 0.2, np.inf], COUNT),
        rng.choice([1e-3, 0.82, 3.0, 50.0], COUNT),
        rng.choice([0.0, 0.1], COUNT),
    )
    ball, floor = carom.Ball(radius=0.03, mass=0.2), Surface(0.0, 0.2)
    every = Meeting(ball, carom.State(v, w), n, Surface(e, mu, beta), floor, height=height, stiffness_ratio=k)
    single = [
        Meeting(
            ball, carom.State(v[i], w[i]), n[i], Surface(float(e[i]), float(mu[i]), float(beta[i])), floor, height=float(height[i]),
            stiffness_ratio=float(k[i]),
        )
        for i in range(COUNT)
    ]  # fmt: skip
    return every, single


@pytest.mark.parametrize("name", laws())
def test_a_condition_of_arrays_is_that_of_each_state(name: str) -> None:
    every, single = meetings()
    found = laws()[name].conditions(every)
    one_by_one = [laws()[name].conditions(m) for m in single]
    assert len(found) >= 2
    for j, condition in enumerate(found):
        mask = np.broadcast_to(condition.holds, (COUNT,))
        assert mask.tolist() == [bool(conditions[j].holds) for conditions in one_by_one]
    assert not np.all(found[0].holds)
    assert np.any(found[0].holds)


def test_rules_of_all_laws_are_functions_with_sentences() -> None:
    kernels: dict[str, object] = {}
    for law in laws().values():
        rules = (*rules_of(law.conditions), *rules_of(law.objections))
        assert rules_of(law.conditions)
        for rule in rules:
            assert kernels.setdefault(rule_name(rule), rule.kernel) is rule.kernel
            assert {name for _text, name, _how, _as in string.Formatter().parse(rule.text) if name is not None} <= {
                "a",
                "b",
            }
