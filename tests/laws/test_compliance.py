"""Tangential compliance: Stronge's lumped springs against an integration that knows nothing of arcs; identities, limits."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from reference.commands import command
from reference.exploring import tried
from reference.identities import contact_velocity, energy, mirrored, rotation, units

import carom
from carom.laws.arrays import loop_for
from carom.laws.arrays import wall_law_rows as law_rows
from carom.laws.law import LIKE_SOLIDS
from carom.laws.maw import CHI, integrate_hertz_springs, maw_contact, maw_slip_ratio
from carom.laws.stronge import stronge_contact, stronge_slip_ratio

COUNT = 20_000
KERNELS = {"stronge": stronge_contact, "maw": maw_contact}


def springs(u: Any, kappa: Any, e: Any, k: Any, steps: int) -> Any:
    """The share of the slip that is left, by leapfrog: a spring along the surface, clipped to the normal one's force."""
    x, v = np.zeros_like(u), u.copy()
    for half, lasts in ((0, 1.0), (1, e)):
        step = math.pi / 2 * lasts / steps
        push, pull = k * step, (1 + 1 / kappa) * step
        v -= x * pull / 2
        for most in np.sin(math.pi / 2 * (half + np.arange(1, steps + 1) / steps)).tolist():
            x = np.minimum(np.maximum(x + push * v, -most), most)
            v -= pull * x
        v += x * pull / 2
    return v / u


def slip_left(u: Any, kappa: Any, e: Any, k: Any) -> Any:
    """The share of the slip that Stronge's law leaves, of slips in units of mu u_n; of many at once."""
    count = len(u)
    v, n, p = np.zeros((count, 3)), np.zeros((count, 3)), np.ones((count, 5))
    v[:, 0], v[:, 1], n[:, 0] = -1, u, 1
    p[:, 1], p[:, 2], p[:, 4] = kappa, e, k
    v1, w1 = answers("stronge", v, np.zeros((count, 3)), n, p)
    return (v1[:, 1] - w1[:, 2]) / u


def test_against_an_integration_of_the_springs() -> None:
    """400 contacts of all kinds: stuck to the end, slip-stick-slip many times over, slipping throughout; order 2 in the step."""
    rng = np.random.default_rng(60)
    count = 400
    u, k = np.exp(rng.uniform(-3, 2.5, count)), np.exp(rng.uniform(-2.5, 3, count))
    kappa, e = rng.uniform(0.05, 2 / 3, count), rng.uniform(0.02, 1, count)
    law = np.array([stronge_slip_ratio(*map(float, row)) for row in zip(u, kappa, e, k, strict=True)])
    rough, fine = (springs(u, kappa, e, k, steps) for steps in (5_000, 10_000))
    assert np.abs(law - fine).max() < 1e-5
    # the law is what the integration tends to: a third of what halving the step changed, and in the same direction
    np.testing.assert_allclose(law - fine, (fine - rough) / 3, atol=1e-6)
    assert (law < 0).sum() > 50  # slip turned round
    assert (law > 0.9).sum() > 5


def states(rng: Any, count: int = COUNT) -> tuple[Any, ...]:
    """v, w, n and parameters a, kappa, e, mu, k."""
    n = units(rng, count)
    v, w = rng.normal(size=(count, 3)), rng.normal(size=(count, 3)) * 3
    v -= np.maximum((v * n).sum(axis=-1), 0)[:, None] * n * 2
    kappa = rng.choice([2 / 5, 2 / 3, 1 / 2], count)
    p = np.stack(
        [
            rng.uniform(0.5, 2, count), kappa, rng.choice([0.0, 1e-3, 0.3, 0.8, 1.0], count),
            rng.choice([0.0, 1e-9, 0.05, 0.3, 2.0, 1e6, math.inf], count), rng.choice([0.2, LIKE_SOLIDS, 1.3], count),
        ],
        axis=-1,
    )  # fmt: skip
    return v, w, n, p


def answers(name: str, v: Any, w: Any, n: Any, p: Any) -> tuple[Any, Any]:
    v1, w1 = np.empty_like(v), np.empty_like(w)
    loop_for(law_rows(KERNELS[name]), len(v))(*(np.ascontiguousarray(x) for x in (v, w, n, p)), v1, w1)
    return v1, w1


@pytest.mark.parametrize("name", KERNELS)
def test_identities(name: str) -> None:
    """Energy never grows, Newton's e, the cone, no lever about the contact point, the plane of slip, symmetry."""
    v, w, n, p = states(np.random.default_rng(61))
    a, kappa, e, mu, _k = p.T
    v1, w1 = answers(name, v, w, n, p)
    assert np.isfinite(v1).all()
    assert np.isfinite(w1).all()
    size = np.abs(v).max(axis=-1) + a * np.abs(w).max(axis=-1)
    assert (energy(v1, w1, a, kappa) <= energy(v, w, a, kappa) + 1e-13 * size**2).all()
    un, ut = contact_velocity(v, w, n, a[:, None])
    un1, ut1 = contact_velocity(v1, w1, n, a[:, None])
    np.testing.assert_allclose(un1, -e * un, atol=1e-13 * size.max())
    j = v1 - v
    jn = (j * n).sum(axis=-1)
    f = j - jn[:, None] * n
    rough = np.isfinite(mu)
    assert (np.sqrt((f * f).sum(axis=-1)) <= np.where(rough, mu, 0) * jn * (1 + 1e-9) + 1e-13 * size)[rough].all()
    # about the contact point, divided by a
    before, after = (np.cross(n, x) + (kappa * a)[:, None] * y for x, y in ((v, w), (v1, w1)))
    np.testing.assert_allclose(after, before, atol=1e-12 * size.max())
    assert (np.abs(np.cross(ut, ut1)).max(axis=-1) < 1e-12 * size**2).all()
    r = rotation((1, 2, 3), 0.7).T
    for x, y, m, x1, y1 in (
        (v @ r, w @ r, n @ r, v1 @ r, w1 @ r),
        (*mirrored(v, w, (0.6, 0, 0.8)), mirrored(n, n, (0.6, 0, 0.8))[0], *mirrored(v1, w1, (0.6, 0, 0.8))),
        (3 * v, 3 * w, n, 3 * v1, 3 * w1),
    ):
        got = answers(name, x, y, m, p)
        assert (np.abs(got[0] - x1).max(axis=-1) < 1e-10 * size).mean() > 0.999
        assert (np.abs(got[1] - y1).max(axis=-1) < 1e-10 * size).mean() > 0.999


def test_where_it_slips_throughout_it_is_coulombs() -> None:
    """From (1 + e)(1 + 1/kappa) - 1/(k e) on, in units of mu u_n, where the spring is fast enough to take over later."""
    v, w, n, p = states(np.random.default_rng(62), 4000)
    p[:, 2] = np.maximum(p[:, 2], 0.3)
    _a, kappa, e, _mu, k = p.T
    un, ut = contact_velocity(v, w, n, p[:, :1])
    slip = np.sqrt((ut * ut).sum(axis=-1))
    inverse = 1 + 1 / kappa
    omega = np.sqrt(k * inverse)
    border = np.where(e * omega > 1, (1 + e) * inverse - 1 / (k * e), np.where(omega > 1, inverse, 1 / k))
    border = np.maximum(border, 1 / k)
    for share in (1.001, 0.97):
        p[:, 3] = slip / -un / (border * share)
        v1, _w1 = answers("stronge", v, w, n, p)
        used = -((v1 - v) * ut).sum(axis=-1) / slip / (p[:, 3] * (1 + e) * -un)
        if share > 1:
            np.testing.assert_allclose(used, 1, rtol=1e-9)
        else:
            assert (used < 1 - 1e-6).all()
    p[:, 3] = 0
    for name in KERNELS:
        v1, w1 = answers(name, v, w, n, p)
        np.testing.assert_array_equal(w1, w)
        np.testing.assert_allclose(v1, v - ((1 + e) * un)[:, None] * n, atol=1e-14)


def test_no_compliance_is_the_rigid_contact() -> None:
    """A stiffer and stiffer spring stores less: the slip that is left falls as 1/sqrt(k), where a rigid contact stops it."""
    far = [abs(stronge_slip_ratio(1.5, 0.4, 0.8, k)) for k in (10.0, 1e3, 1e5)]
    assert far[0] > far[1] > far[2]
    for k in (1e3, 1e5):
        u = np.linspace(0.5, 6.2, 40)
        left = np.abs(slip_left(u, 0.4, 0.8, k)) * u
        # on the cone until the spring takes over, with no more than mu F in it: |u| <= mu u_n sqrt((1 + 1/kappa)/k)
        assert left.max() < math.sqrt(3.5 / k)
    assert stronge_slip_ratio(7.0, 0.4, 0.8, 1e5) == pytest.approx(1 - 1.8 * 3.5 / 7.0, abs=1e-12)


@pytest.mark.parametrize("e", [0.0, 0.3, 1.0])
def test_a_point_that_holds_swings(e: float) -> None:
    """mu = inf: the spring swings for as long as the wall acts, and large frictions tend to that."""
    omega = math.sqrt(LIKE_SOLIDS * 3.5)
    known = math.cos(omega * (1 + e) * math.pi / 2)
    assert stronge_slip_ratio(0.0, 0.4, e, LIKE_SOLIDS) == known
    assert stronge_slip_ratio(1e-7, 0.4, e, LIKE_SOLIDS) == pytest.approx(known, abs=1e-6)


def test_nothing_jumps() -> None:
    """Along the slip, the restitution and the stiffness, across every border between regimes (but for e -> 0 at the end)."""
    x = np.linspace(0.05, 8, 20_001)
    for u, e, k in ((x, 0.8, 1.2), (0 * x + 1.4, 0.2 + x / 10, 1.2), (0 * x + 1.4, 0.8, 0.3 + x)):
        assert np.abs(np.diff(slip_left(u, 0.4, e, k))).max() < 2e-3


# --- through the verbs and the command ------------------------------------------------------------------------------


def test_compare_and_predict_agree(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The same ball by either verb; the ratio as an option and as a column."""
    wall = ["--restitution", "0.9", "--friction", "0.15"]
    words = [
        "compare",
        "--angle",
        "15",
        "--stiffness-ratio",
        "1.1",
        "--laws",
        "maw",
        "--laws",
        "stronge",
        *wall,
        "--json",
    ]
    code, text, _notes = command(capsys, *words)
    assert code == 0
    told = json.loads(text)
    laws = {row["law"]: row for row in told["laws"]}
    assert laws["maw"]["admissible"]
    assert laws["stronge"]["admissible"]
    assert told["settings"]["stiffness_ratio"] == 1.1
    table = tmp_path / "in.csv"
    tau = math.radians(15)
    table.write_text(f"velocity_x,velocity_y,stiffness_ratio\n{-math.cos(tau)!r},{math.sin(tau)!r},1.1\n")
    for name, row in laws.items():
        out = tmp_path / f"{name}.csv"
        words = ["predict", str(table), "--law", name, "--spin", "rolling", *wall, "--out", str(out)]
        assert command(capsys, *words)[0] == 0
        header, values = (line.split(",") for line in out.read_text().splitlines())
        found = dict(zip(header, values, strict=True))
        assert [float(found[f"velocity_{k}_out"]) for k in "xyz"] == pytest.approx(
            row["after_wall"]["velocity"], abs=1e-14
        )
        assert [float(found[f"velocity_{k}_rolling"]) for k in "xyz"] == pytest.approx(
            row["final"]["velocity"], abs=1e-14
        )


def test_what_they_refuse() -> None:
    meeting = carom.incoming(stiffness_ratio=9.0, tangential_restitution=0.5)
    verdicts = carom.compare(meeting)
    assert verdicts["maw"].after_wall is None
    assert "stiffness ratio from 0.171 to 3.43" in verdicts["maw"].why[0]
    assert any("ignores this wall's tangential restitution" in why for why in verdicts["stronge"].why)
    for bad in (0.0, -1.0, math.nan, math.inf):
        with pytest.raises(carom.CaromError, match="stiffness_ratio: expected a number > 0"):
            carom.incoming(stiffness_ratio=bad)


@pytest.mark.parametrize("kappa", [1.4519770036461357e-05, 1e-3, 1e-9, 1e-300])
@pytest.mark.parametrize("k", [1e-3, 1.0, 449.4471833045699, 1e3])
@pytest.mark.slow(keep=6)
def test_a_moment_of_inertia_near_zero_ends(kappa: float, k: float) -> None:
    """The tangential spring swings ever faster; the kernel is bounded, whatever the numbers, and keeps no more slip than it got."""
    for u in (1e-9, 0.21083695130965174, 1.0, 50.0):
        for e in (0.0, 0.5, 1.0):
            kept = stronge_slip_ratio(u, kappa, e, k)
            assert abs(kept) <= 1 + 1e-9, (u, e)


def test_many_swings_against_an_integration() -> None:
    """A stiff spring on a light moment of inertia: 160 half swings and more, near the bound that the law states."""
    kappa, k, e, u = 1e-3, 250.0, 1.0, np.array([0.5, 5.0, 40.0, 400.0])
    law = np.array([stronge_slip_ratio(float(x), kappa, e, k) for x in u])
    rough, fine = (springs(u, kappa, e, k, steps) for steps in tried((50_000, 100_000), (200_000, 400_000)))
    np.testing.assert_allclose(law, fine + (fine - rough) / 3, atol=3e-6)


def test_what_swings_too_fast_is_refused() -> None:
    verdict = carom.compare(carom.incoming(inertia=1e-5, stiffness_ratio=100.0), ["stronge"])["stronge"]
    assert verdict.after_wall is None
    assert "k (1 + 1/kappa) at most 1e+06" in verdict.why[0]


def test_maw_keeps_no_more_slip_than_it_got() -> None:
    """Its table passes 1 by its own error, 2e-4; energy must not."""
    rng = np.random.default_rng(11)
    for psi, chi in zip(rng.uniform(0, 3, 20_000), np.exp(rng.uniform(*np.log(CHI), 20_000)), strict=True):
        assert abs(maw_slip_ratio(float(psi), float(chi))) <= 1, (psi, chi)
    v, w = maw_contact((-1.0, 1.0, 0.0), (0.0, 0.0, 0.0), (1.0, 0.0, 0.0), 1.0, 0.4, 1.0, 0.5, 0.29)
    assert energy(np.array(v), np.array(w), 1.0, 0.4) <= 1 + 1e-14


@pytest.mark.parametrize("name", KERNELS)
def test_a_ball_along_the_wall_is_left_alone(name: str) -> None:
    """An approach that is the rounding of a ball moving along the wall gives no rough wall a hold of it."""
    v, w = KERNELS[name]((-1e-17, 1.0, 0.0), (0.0, 0.0, 0.0), (1.0, 0.0, 0.0), 0.03, 0.4, 1.0, math.inf, 0.8)
    assert v == pytest.approx((0, 1, 0), abs=1e-15)
    assert w == (0, 0, 0)


@pytest.mark.parametrize("chi", [CHI[0], 0.31, 1.0, 5.9, CHI[1]])
def test_the_curve_at_the_edges_of_its_table(chi: float) -> None:
    """In the first and last cell of either part, and in the first and last row, as well as within: the springs themselves."""
    far = max(4 * chi - 1, 1.0)
    places = [0.02, 0.5, 0.985]
    if far > 1:
        places += [1 + (far - 1) * share for share in (0.015, 0.5, 0.985)]
    for psi in places:
        # (as near as 31 rows and 32 cells a part allow: the curve swings faster where chi is large)
        near = 2e-3 if chi < 2 else 0.03
        assert psi * maw_slip_ratio(psi, chi) == pytest.approx(integrate_hertz_springs(psi, chi), abs=near), psi
