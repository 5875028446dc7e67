"""Verified periodic orbits: orbits to 40 digits lie in every bound; wrong ones and members of families are refused."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from mpmath import mp, workdps
from reference.precise_bounces import closed_orbit

import carom
from carom import billiards
from carom.billiards.energy_shell import EnergyShell
from carom.billiards.verified import Verified, verify
from carom.errors import CaromError


@pytest.mark.parametrize(("law", "period"), [("mirror", 3), ("mirror", 4), ("no-slip", 3), ("no-slip", 5)])
def test_orbits_to_forty_digits_lie_in_the_bounds(law: str, period: int) -> None:
    found = billiards.periodic_orbits(billiards.stadium(2.0, 1.0), period, law=law, starts=40, seed=3)
    assert len(found) >= 2
    for one in found[:4]:
        assert one.verified, one.verified.reason
        run, size = one.orbit, one.orbit.setup.shape.size
        begin = [*run.position[-1], *run.velocity[-1], run.spin[-1]]
        half = one.verified.radius / 8
        with workdps(40):
            for move in ((0, 0, 0, 0), (half * size, half, -half, half if law == "no-slip" else 0)):
                states = closed_orbit(begin, period, 2, 1, mp.mpf(1) / 2, law == "no-slip", move)
                for k, state in enumerate(states):
                    here = [*run.position[k - 1], *run.velocity[k - 1], run.spin[k - 1]]
                    off = [float(a - mp.mpf(float(b))) for a, b in zip(state, here, strict=True)]
                    assert math.hypot(*off[:2]) <= one.verified.error * size
                    assert max(map(abs, off[2:4])) <= one.verified.error
                    assert abs(off[4]) * math.sqrt(0.5) <= one.verified.error
        assert one.verified.error <= one.error * 4 + 1e-15


TRIANGLE = billiards.polygon([(0, 0), (3, 0), (1.2, 1.9)])
L_SHAPE = billiards.polygon([(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)], bounds="surface")
TORUS = billiards.torus((1.0, 1.4), ((0.45, 0.1, 0.25), (-0.2, -0.6, 0.2)))
FORMULA = billiards.table("curve:r=1/(1+0.1*cos(theta)+0.05*sin(2*theta))")
OVAL = billiards.table("oval")
CURVES = {
    "formula, no-slip": (FORMULA, (-0.5452682558, 0.957542542), (0.7421761, -0.6149183), 0.3769616, 3, "no-slip", None),
    "oval, rolling": (OVAL, (0.67630680549, 0.72682693110), (-0.7666563, -0.3136995), -0.3136995, 3, "rolling", carom.Ball(1.0)),
    "ball in an oval": (billiards.table("oval", bounds="surface"), (0.9, 0.0), (-1.0, 0.0), 0.0, 2, "mirror", None),
}  # fmt: skip


@pytest.mark.parametrize("name", CURVES)
def test_curves(name: str) -> None:
    table, *start, period, law, ball = CURVES[name]
    one = billiards.refine_orbit(table, start, period, law=law, ball=ball)
    assert not one.family
    assert one.verified, one.verified.reason
    assert one.verified.error < 1e-11


CASES = {
    "ellipse": (billiards.ellipse(2.0, 1.0), "mirror", None, 2),
    "sinai": (billiards.sinai(0.4), "no-slip", None, 3),
    "torus": (TORUS, "mirror", None, 2),
    "triangle": (TRIANGLE, "no-slip", carom.Disc(1, 1, 0.2), 3),
    "L": (L_SHAPE, "mirror", carom.Disc(0.2), 2),
}


@pytest.mark.parametrize("name", CASES)
def test_tables_and_laws(name: str) -> None:
    table, law, ball, period = CASES[name]
    starts = 16 if name == "torus" else 60
    found = billiards.periodic_orbits(table, period, law=law, ball=ball, starts=starts, seed=1)
    alone = [one for one in found if not one.family]
    assert alone or name == "L"
    for one in found:
        if one.family:
            assert one.verified.reason == "one of a continuous family"
            continue
        assert one.verified, (one, one.verified.reason)
        assert one.verified.error < 1e-9


def test_wrong_orbits_are_refused() -> None:
    one = billiards.periodic_orbits(billiards.stadium(2.0, 1.0), 3, law="mirror", starts=40, seed=3)[0]
    shell = EnergyShell(one.orbit.setup, one.energy)

    def moved(by: float) -> billiards.Orbit:
        turn = np.array([[math.cos(by), -math.sin(by)], [math.sin(by), math.cos(by)]])
        return replace(one.orbit, velocity=one.orbit.velocity @ turn)

    assert not verify(shell, moved(0.2), (0, 0))
    # near by, the bound tells how far off the given one is
    near = verify(shell, moved(1e-6), (0, 0))
    assert 0.5e-6 < near.error < 2e-6
    # an orbit that does not close, and walls of another one
    run = billiards.orbit(billiards.stadium(2.0, 1.0), ((0.1, 0.2), (0.6, 0.8), 0.0), 3, law="mirror")
    assert "orbit that closes" in verify(shell, run, (0, 0)).reason
    # one whose flight passes through an obstacle that stands in its way
    free = billiards.periodic_orbits(billiards.sinai(0.2), 2, law="mirror", starts=60, seed=1)
    far = max(free, key=lambda orbit: orbit.duration)
    assert far.verified
    crowded = billiards.torus((1.0, 1.0), ((0.0, 0.0, 0.2), (0.5, 0.5, 0.2)))
    setup = replace(far.orbit.setup, shape=crowded.shape(1.0))
    run = replace(far.orbit, setup=setup, piece=np.zeros_like(far.orbit.piece))
    blocked = verify(EnergyShell(setup, far.energy), run, far.cells)
    assert not blocked
    assert "another wall may stand between" in blocked.reason


def test_what_cannot_be_verified_is_said() -> None:
    def reason(table: billiards.Table, x: tuple[float, float]) -> str:
        start = (x, (-x[0], -x[1]), 0.0)
        return billiards.refine_orbit(table, start, 2, law="mirror").verified.reason

    falling = billiards.under(billiards.ellipse(2.0, 1.0), (0.0, -0.1))
    assert reason(falling, (0.0, 0.5)) == "a force acts on the ball"
    assert reason(billiards.table("flower:leaves=4"), (0.5, 0.0)) == "a curve that is not shown to be convex"


def test_bounds_stay_bounds_in_print() -> None:
    assert Verified(0.0999, 3.41e-15).describe() == "verified: the only one within 0.099, known to 3.5e-15"


def test_the_command_says_what_is_verified() -> None:
    found = carom.orbit("ellipse:half_axes=[2,1]", 5, law="mirror", periodic="2", starts=30, verify=True)
    assert all(one.to_dict()["verified"]["radius"] > 1e-4 for one in found.periodic)
    with pytest.raises(CaromError, match="`verify`: expected `periodic` with it, got none"):
        carom.orbit("circle", 5, verify=True)
