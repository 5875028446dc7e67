"""Laws of the pair: what they are for walls, with the masses of two balls; friction that falls with the slip; published throws."""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numpy as np
import pytest
from reference.hertz_contacts import RADIUS, Case
from reference.hertz_contacts import integrate as integrate_contacts
from reference.pair_springs import Disc
from reference.pair_springs import collide as integrate

import carom
from carom.laws.law import contact_kernel
from carom.laws.registry import laws_of_pairs
from carom.scene.toml import replaced
from carom.simulation.records import IN_CLUSTER
from carom.simulation.simulate import law_notes

POOL = {"radius": 0.028575, "mass": 0.17}
REST = carom.State((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
SPEEDS = (0.447, 1.341, 3.129)  # m/s: Alciatore's slow, medium and fast shots, 1, 3 and 7 mph


def throw(law: str, speed: float, cut: float, rolling: bool = False, **surface: float) -> float:
    """Return by how much the object ball leaves the line of centres, degrees: towards where the cue ball goes."""
    ball = carom.Ball(**POOL)
    cue = carom.State((speed, 0.0, 0.0), (0.0, speed / ball.radius if rolling else 0.0, 0.0))
    c, s = math.cos(math.radians(cut)), math.sin(math.radians(cut))
    v = (
        carom.collide(ball, cue, ball, REST, (-c, s, 0.0), carom.Surface(**{"restitution": 1.0, **surface}), law)
        .after[1]
        .velocity
    )
    return cut + math.degrees(math.atan2(v[1], v[0]))


def published_throw(speed: float, cut: float, rolling: bool) -> float:
    """TP A.14, (15)-(17), without sidespin: friction up to mu of the normal impulse, at most a seventh of the slip."""
    c, s = math.cos(math.radians(cut)), math.sin(math.radians(cut))
    slip = math.hypot(speed * s, speed * c if rolling else 0.0)
    mu = 0.009951 + 0.108 * math.exp(-1.088 * slip)
    return math.degrees(math.atan(min(mu * speed * c / slip, 1 / 7) * s / c))


@pytest.mark.parametrize("rolling", [False, True])
def test_throw_is_that_of_alciatore(rolling: bool) -> None:
    for speed in SPEEDS:
        for cut in (5.0, 10.0, 30.0, 45.0, 60.0, 80.0):
            assert throw("alciatore", speed, cut, rolling) == pytest.approx(
                published_throw(speed, cut, rolling), abs=1e-9
            )
    # (values that others who coded TP A.14 print)
    expected = (2.186, 1.004, 0.388) if rolling else (4.715, 3.549, 1.698)
    assert [throw("marlow", speed, 30.0, rolling) for speed in SPEEDS] == pytest.approx(expected, abs=2e-3)


@pytest.mark.parametrize("seed", range(4))
def test_a_kernel_of_walls_gives_the_contact_of_the_pair(seed: int) -> None:
    rng = np.random.default_rng(seed)
    n = rng.normal(size=(200, 3))
    balls = [carom.Ball(r, m, k) for r, m, k in rng.uniform((0.02, 0.1, 0.1), (0.05, 0.5, 0.66), (2, 3))]
    n /= np.linalg.norm(n, axis=1)[:, None]
    v = rng.normal(size=(200, 3))
    v -= (abs((v * n).sum(axis=1)) + (v * n).sum(axis=1))[:, None] * n
    states = [carom.State(v, 40 * rng.normal(size=(200, 3))), carom.State(0 * v, 40 * rng.normal(size=(200, 3)))]
    surface = carom.Surface(rng.uniform(), rng.uniform(0, 0.4), rng.uniform(-1, 1))
    own = carom.wall_law(carom.Card("as a wall", "", (), "", "", ""), contact_kernel)
    right, found = (
        carom.collide(balls[0], states[0], balls[1], states[1], n, surface, law) for law in ("contact", own)
    )
    for one, other in zip(right.after, found.after, strict=True):
        assert np.abs(one.velocity - other.velocity).max() < 1e-13
        assert np.abs(one.spin - other.spin).max() < 1e-11
    assert set(found.regime) == {""}


@pytest.mark.parametrize("restitution", [None, 0.8])
def test_compliance_against_an_integration_in_time(restitution: float | None) -> None:
    discs = (Disc(0.03, 0.17, 0.4, (1.0, 0.0), 0.0), Disc(0.02, 0.3, 0.6, (-0.5, 0.3), 10.0))
    law = "maw" if restitution is None else "stronge"
    for along, spin in ((0.05, 5.0), (0.4, -20.0), (1.5, 30.0)):
        one = discs[0]._replace(velocity=(1.0, along), spin=spin)
        right = integrate(one, discs[1], 0.2, 0.8, restitution)
        balls = [carom.Ball(d.radius, d.mass, d.kappa) for d in (one, discs[1])]
        states = [carom.State((*d.velocity, 0.0), (0.0, 0.0, d.spin)) for d in (one, discs[1])]
        surface = carom.Surface(1.0 if restitution is None else restitution, 0.2)
        hit = carom.collide(balls[0], states[0], balls[1], states[1], (-1, 0, 0), surface, law, stiffness_ratio=0.8)
        for state, ball, (vx, vy, w) in zip(hit.after, balls, right, strict=True):
            assert state.velocity[:2] == pytest.approx((vx, vy), abs=1e-3)
            assert ball.radius * state.spin[2] == pytest.approx(ball.radius * w, abs=1e-3)


def scene(law: Any, **more: Any) -> carom.Scene:
    first = {**POOL, "position": (0.0, 0.0), "velocity": (1.3, 0.1), "spin": (3.0, 20.0, 12.0)}
    other = {"radius": 0.03, "mass": 0.2, "inertia": 0.5, "position": (0.2, 0.04)}
    pair = {"restitution": 0.9, "friction": 0.05, "poisson": 0.3, "law": law}
    return carom.Scene(gravity=0, balls=[first, other], ball_contact=pair | more, run={"duration": 1.0})


@pytest.mark.parametrize("law", laws_of_pairs())
def test_runs_and_collide_agree(law: str) -> None:
    run = carom.simulate(scene(law))
    one, other = run.log[2:4]
    balls = [ball.ball for ball in run.scene.balls]
    states = [carom.State(row["v_before"], row["w_before"]) for row in (one, other)]
    hit = carom.collide(balls[0], states[0], balls[1], states[1], one["x"] - other["x"], carom.Surface(0.9, 0.05), law)
    for row, state in zip((one, other), hit.after, strict=True):
        assert row["v"] == pytest.approx(state.velocity, abs=1e-14)
        assert row["w"] == pytest.approx(state.spin, abs=1e-12)
    assert one["impulse"] == pytest.approx(hit.impulse, abs=1e-14)
    many = carom.simulate_many(run.scene, velocity=np.array([[[1.3, 0.1, 0.0], [0.0, 0.0, 0.0]]] * 2))
    assert np.array_equal(many.final.velocity[1], run.final.velocity)  # (compiled, and in Python)


@pytest.mark.parametrize("law", ["alciatore", "maw", "stronge"])
def test_sensitivities_are_differences(law: str) -> None:
    values = {"ball_contact.restitution": 0.9, "balls.0.velocity.y": 0.1, "balls.1.mass": 0.2}
    if law != "alciatore":
        values["ball_contact.friction"] = 0.05
    found = carom.simulate(scene(law)).sensitivity(list(values)).final.velocity
    h = 1e-5
    for k, (name, value) in enumerate(values.items()):
        first, second = (carom.simulate(replaced(scene(law), {name: value + x})).final.velocity for x in (h, -h))
        assert found[..., k] == pytest.approx((first - second) / (2 * h), abs=1e-6)


def test_clusters_take_the_friction_of_the_slip() -> None:
    row = [{**POOL, "position": (x, y, 0.0)} for x, y in ((0.0, 0.0), (0.05, 0.03), (0.05, -0.0285))]
    row[0] |= {"velocity": (2.0, 0.0, 0.0), "spin": (0.0, 0.0, 30.0)}

    def final(**pair: Any) -> Any:
        return carom.simulate(carom.Scene(gravity=0, balls=row, ball_contact=pair, run={"duration": 0.1})).final

    falling = carom.LAWS["alciatore"]
    as_constant = dataclasses.replace(falling, slip_friction=(0.05, 0.0, 0.0))
    right, found = final(friction=0.05), final(law=as_constant)
    assert np.array_equal(right.velocity, found.velocity)
    assert np.array_equal(right.spin, found.spin)
    # friction that does not change within the slips of this meeting is as good as constant, and alciatore's is not
    slow = dataclasses.replace(falling, slip_friction=(0.02, 0.03, 1e-9))
    assert np.abs(final(law=slow).velocity - right.velocity).max() < 1e-9
    assert np.abs(final(law=falling).velocity - right.velocity).max() > 1e-4
    momentum = final(law=falling).velocity.sum(axis=0)
    assert momentum == pytest.approx((2.0, 0.0, 0.0), abs=1e-12)


def test_friction_that_falls_with_the_slip_in_a_scene() -> None:
    falling = {"at_rest": 0.117951, "at_speed": 0.009951, "speed": 1 / 1.088}
    found = carom.simulate(scene("contact", friction=falling))
    assert found.final.velocity == pytest.approx(carom.simulate(scene("alciatore")).final.velocity, abs=1e-15)
    # (a law of the scene's own kernel is given the friction of the slip, too)
    (one, other), balls = found.log[2:4], [ball.ball for ball in found.scene.balls]
    n = (one["x"] - other["x"]) / np.linalg.norm(one["x"] - other["x"])
    turn = balls[0].radius * one["w_before"] + balls[1].radius * other["w_before"]
    u = one["v_before"] - other["v_before"] - np.cross(turn, n)
    mu = found.scene.ball_contact.friction.at(np.linalg.norm(u - (u @ n) * n))
    compliant = [carom.simulate(scene("maw", friction=x)).final.velocity for x in (falling, mu)]
    assert compliant[0] == pytest.approx(compliant[1], abs=1e-14)
    names = ["ball_contact.friction.at_rest", "ball_contact.friction.speed"]
    slopes = found.sensitivity(names).final.velocity
    for k, name in enumerate(names):
        value, h = falling[name.rpartition(".")[2]], 1e-6
        ends = [carom.simulate(replaced(found.scene, {name: value + x})).final.velocity for x in (h, -h)]
        assert slopes[..., k] == pytest.approx((ends[0] - ends[1]) / (2 * h), abs=1e-6)
    with pytest.raises(
        carom.CaromError, match=r"ball_contact.friction.at_rest: expected at least at_speed = 0.2, got 0.1"
    ):
        scene("contact", friction={"at_rest": 0.1, "at_speed": 0.2, "speed": 1.0})


def test_a_cluster_with_friction_that_falls_against_an_integration_in_time() -> None:
    x = np.array([(0.0, 0.0, RADIUS), (0.05, 0.0277, RADIUS), (0.04874, -0.02987, RADIUS)])
    v, w = np.zeros((3, 3)), np.zeros((3, 3))
    v[0], w[0] = (1.0, 0.1, 0.0), (0.0, 10.0, 40.0)
    case = Case(x, v, w, 0.95, lambda u: 0.02 + 0.2 * np.exp(-2 * u))
    _x, right, spins = integrate_contacts(case, 0.0009, 2.5e-7)
    pair = {"restitution": 0.95, "friction": {"at_rest": 0.22, "at_speed": 0.02, "speed": 0.5}}
    balls = [{**POOL, "position": tuple(x[i]), "velocity": tuple(v[i]), "spin": tuple(w[i])} for i in range(3)]
    run = carom.simulate(carom.Scene(gravity=0, balls=balls, ball_contact=pair, run={"duration": 0.02}))
    assert (run.log["kind"] == IN_CLUSTER).sum() == 1
    assert np.abs(run.final.velocity - right).max() < 2e-4
    assert RADIUS * np.abs(run.final.spin - spins).max() < 1e-4
    constant = carom.simulate(replaced(run.scene, {"ball_contact.friction": 0.22})).final.velocity
    assert np.abs(constant - right).max() > 1e-2


@pytest.mark.parametrize(
    ("pair", "told"),
    [
        ({"law": "two-step"}, "ball_contact.law: expected one of maw, stronge, contact"),
        ({"law": "alciatorre"}, "did you mean 'alciatore'?"),
        (
            {"law": "maw", "stiffness_ratio": 60.0},
            "ball_contact.stiffness_ratio: expected a stiffness ratio from 0.171 to 3.43",
        ),
        (
            {"law": "stronge", "tangential_restitution": 0.5},
            "ball_contact.tangential_restitution: expected 0 for the law stronge",
        ),
        ({"law": "own.py:law"}, "ball_contact.law: expected one of carom's laws, as opening a file runs no code"),
    ],
)
def test_bad_laws_are_told_in_one_line(pair: dict[str, Any], told: str, tmp_path: Any) -> None:
    file = tmp_path / "scene.toml"
    lines = [f"{name} = {value!r}" for name, value in pair.items()]
    file.write_text(
        "\n".join(["[[balls]]", "radius = 0.03", "mass = 0.2", "position = [0, 0, 0]", "[ball_contact]", *lines])
    )
    with pytest.raises(carom.CaromError) as error:
        carom.load_scene(file)
    assert told in str(error.value)
    assert len(str(error.value).splitlines()) == 1


def test_a_law_of_walls_is_none_of_pairs() -> None:
    ball, cue = carom.Ball(), carom.State((1.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    with pytest.raises(
        carom.CaromError, match=r"law: expected a law of one contact: .*, got 'two-step', a law of walls"
    ):
        carom.collide(ball, cue, ball, REST, law="two-step")
    with pytest.raises(carom.CaromError, match=r"a stiffness ratio from 0\.171 to 3\.43"):
        carom.collide(ball, cue, ball, REST, law="maw", stiffness_ratio=[0.8, 50.0])
    with pytest.raises(carom.CaromError, match=r"collide: stiffness_ratio: expected a number > 0, got -1"):
        carom.collide(ball, cue, ball, REST, law="maw", stiffness_ratio=-1.0)
    with pytest.raises(carom.CaromError, match=r"collide: law: expected a name, file.py:name or a carom.Law, got 3"):
        carom.collide(ball, cue, ball, REST, law=3)


def test_a_law_in_a_file_beside_the_scene(tmp_path: Any) -> None:
    law = "def smooth(v, w, n, a, kappa, e, mu, beta):\n    u = (1 + e) * (v[0] * n[0] + v[1] * n[1] + v[2] * n[2])\n"
    law += "    return (v[0] - u * n[0], v[1] - u * n[1], v[2] - u * n[2]), w\n"
    (tmp_path / "own.py").write_text(law)
    carom.save_scene(scene("contact", friction=0.0), tmp_path / "scene.toml")
    text = (tmp_path / "scene.toml").read_text().replace("[ball_contact]", '[ball_contact]\nlaw = "own.py:smooth"')
    (tmp_path / "scene.toml").write_text(text)
    found = carom.simulate(carom.load_scene(tmp_path / "scene.toml", allow_own_laws=True))
    right = carom.simulate(scene("contact", friction=0.0))
    assert found.final.velocity == pytest.approx(right.final.velocity, abs=1e-14)


def test_a_law_of_pairs_that_creates_energy_is_told() -> None:
    def doubled(v: Any, w: Any, n: Any, a: float, kappa: float, e: float, mu: float, beta: float) -> Any:
        u = 3 * (v[0] * n[0] + v[1] * n[1] + v[2] * n[2])
        return (v[0] - u * n[0], v[1] - u * n[1], v[2] - u * n[2]), w

    def passes(v: Any, w: Any, n: Any, a: float, kappa: float, e: float, mu: float, beta: float) -> Any:
        return v, w

    card = carom.Card("mine", "", (), "", "", "")
    run = carom.simulate(scene(carom.wall_law(card, doubled)))
    assert run.scene.describe() == "2 balls, law two-step, balls by mine, 1 s"
    (told,) = law_notes(run)
    assert told.startswith("law mine creates energy: first at t = 0.1")
    assert "ball 0 at ball 1" in told
    assert told.endswith(" J in all")
    (told,) = law_notes(carom.simulate(scene(carom.wall_law(card, passes), restitution=1.0), max_events=1))
    assert told.startswith("law mine leaves two balls moving into each other: first at t = 0.1")
    assert law_notes(carom.simulate(scene("alciatore"))) == []


def test_a_run_says_where_a_law_of_the_pair_did_not_act() -> None:
    row = [{"radius": 0.03, "mass": 0.2, "position": (x, y, 0.03)} for x, y in ((0.5, 0.0), (0.552, 0.03))]
    row.append({"radius": 0.03, "mass": 0.2, "position": (0.3, 0.0, 0.03), "velocity": (1.0, 0.0, 0.0)})
    for contact, what in (
        ({"law": "maw"}, "law maw"),
        ({"tangential_restitution": 0.3}, "tangential restitution"),
        ({}, ""),
    ):
        between = {"restitution": 0.95, "friction": 0.1, **contact}
        told = law_notes(carom.simulate(carom.Scene(balls=row, gravity=0, ball_contact=between, run={"duration": 0.2})))
        assert len(told) == (1 if what else 0)
        assert all(line.startswith(f"{what} did not act in 1 event in which contacts overlap in time") for line in told)
