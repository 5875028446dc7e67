"""Contacts that overlap in time, resolved in one event, against an integration of its own (tests/reference/hertz_contacts.py)."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from reference.brute_force_scene import judge, random_scene
from reference.hertz_contacts import MASS, RADIUS, Case, contact_time, integrate, known, known_case, rack
from scipy.spatial.distance import pdist

import carom
from carom.core.jit.kernel import as_objects
from carom.simulation import cluster
from carom.simulation.loop import ALL, FULL, run
from carom.simulation.records import BALL, IN_CLUSTER, LOG, event_numbers, set_up

KNOWN = known()
CASES = KNOWN["cases"]
Array = Any


def scene_of(case: Case, duration: float = 0.01, **contact: Any) -> carom.Scene:
    balls = [
        {"radius": case.radius, "mass": case.mass, "position": x, "velocity": v, "spin": w}
        for x, v, w in zip(*(np.array(one).tolist() for one in case[:3]), strict=True)
    ]
    pair = {"restitution": case.restitution, "friction": case.friction, "young": case.young, "poisson": case.poisson}
    return carom.Scene(gravity=0, balls=balls, ball_contact=pair | contact, run={"duration": duration})


def row(count: int, *, gap: float = 0.0, restitution: float = 1.0, friction: float = 0.0, speed: float = 1.0) -> Case:
    """The first of balls in a row comes to the others, of which it touches the first."""
    x = np.array([[k * 2 * RADIUS + max(k - 1, 0) * gap, 0.0, RADIUS] for k in range(count)])
    x[0, 0] -= 1e-9
    v = np.zeros_like(x)
    v[0, 0] = speed
    return Case(x, v, 0 * v, restitution, friction)


def broken(gap: float = 5e-5, spread: float = 0.0, seed: int = 0, **how: Any) -> Case:
    """A rack of fifteen, and a ball that touches it."""
    x = np.vstack([[-2 * RADIUS - 1e-9, 0.0, RADIUS], rack(gap, spread, seed)])
    if spread:
        x[0] = x[1] - [2 * RADIUS + 1e-9, 0.0, 0.0]
    v = np.zeros_like(x)
    v[0] = how.pop("velocity", (9.5, 0.0, 0.0))
    return Case(x, v, 0 * v, **how)


def after(case: Case, **contact: Any) -> tuple[Array, Array]:
    """Velocities and spins after the contacts."""
    done = carom.simulate(scene_of(case, 1e-6, **contact))
    return done.final.velocity, done.final.spin


def energy(case: Case, v: Array, w: Array) -> float:
    return float(case.mass / 2 * (v**2).sum() + case.mass * 0.2 * case.radius**2 * (w**2).sum())


@pytest.mark.parametrize("name", CASES)
def test_a_cluster_has_the_velocities_of_the_reference(name: str) -> None:
    one = CASES[name]
    case = known_case(one)
    done = carom.simulate(scene_of(case, one["duration"]))
    v, size = done.final.velocity, np.abs(case.velocity).max()
    assert np.abs(v - one["out_velocity"]).max() < 6e-5 * size
    assert np.abs((v - case.velocity).sum(axis=0)).max() < 1e-12 * size
    if case.restitution == 1:
        assert (v**2).sum() == pytest.approx((np.array(case.velocity) ** 2).sum(), rel=1e-12)
    # far from one pair at a time, but for the two balls
    far = np.abs(np.array(one["one_pair_at_a_time"]) - one["out_velocity"]).max() / size
    assert far > 0.05 or len(v) == 2


def velocities(radii: Any, masses: Any, gaps: Any, spin: float, **contact: Any) -> Array:
    """Velocities long after the first of a row, with a spin about z (1: its rim turns as fast as it comes), has met the others."""
    x = np.cumsum([0, *(np.add(radii[1:], radii[:-1]) + gaps)])
    balls = [
        {
            "radius": a,
            "mass": m,
            "position": (y, 0, 0),
            "velocity": (float(k == 0), 0, 0),
            "spin": (0, 0, spin * (k == 0) / a),
        }
        for k, (a, m, y) in enumerate(zip(radii, masses, x, strict=True))
    ]
    scene = carom.Scene(gravity=0, balls=balls, ball_contact=contact, run={"duration": 0.05})
    return carom.simulate(scene).final.velocity


@pytest.mark.parametrize(
    ("masses", "right"),
    [((0.25, 0.5, 4), (-0.5540, -0.4121, 0.1486)), ((1, 1, 0.5, 2), (-0.3809, -0.0627, 0.4107, 0.6191))],
)
def test_balls_that_meet_again_have_the_restitution_of_the_pair(masses: Any, right: Any) -> None:
    # they part by some 0.1 mm, and meet once more (right: SciPy's DOP853 with places that move)
    v = velocities([RADIUS] * len(masses), MASS * np.array(masses), 0, 0, restitution=1, friction=0)
    assert v[:, 0] == pytest.approx(right, abs=1e-4)


def test_balls_that_pass_each_other_are_not_stopped() -> None:
    # the first two rub along each other: with the places put back they would meet again
    # (right: tests/reference/contacts_followed.py)
    radii, masses = RADIUS * np.array([1.2791, 0.7232, 0.6973]), MASS * np.array([0.6793, 0.8501, 1.0922])
    v = velocities(radii, masses, [0, 8.122e-5], 2.0, restitution=0.77, friction=0.186)
    assert v[:, :2] == pytest.approx(np.array([[0.0136, -0.1837], [0.0043, 0.1830], [0.6102, -0.0282]]), abs=2e-4)


@pytest.mark.parametrize("restitution", [0.9, 0.5, 0.2, 0.05])
def test_any_restitution_is_that_of_the_damping(restitution: float) -> None:
    case = row(4, restitution=restitution)
    _x, v, _w = integrate(case, 0.004)
    assert after(case)[0] == pytest.approx(v, abs=3e-4)


def test_without_restitution_a_row_goes_on_together() -> None:
    # (one pair at a time needs infinitely many impacts for that; the damping of no restitution is that of 0.0025)
    v, _w = after(row(3, restitution=0.0))
    assert v[:, 0] == pytest.approx([1 / 3] * 3, abs=3e-3)
    # so do slow ones, which need more than a step for the last digits of their places before they touch
    slow = carom.simulate(scene_of(row(3, restitution=0.0, speed=7e-4), 1e-5))
    assert slow.final.velocity[:, 0] == pytest.approx([7e-4 / 3] * 3, abs=3e-3 * 7e-4)
    assert len(slow.log) == 3 + 3


@pytest.mark.parametrize("friction", [0.05, 0.3])
def test_friction_is_that_of_the_integration(friction: float) -> None:
    case = broken(restitution=0.95, friction=friction, velocity=(9.5, 0.4, 0.0))
    case.spin[0] = 0.0, 200.0, 60.0
    _x, v, w = integrate(case, 0.0011)
    found, spins = after(case)
    assert found == pytest.approx(v, abs=4e-3 * 9.5)
    assert RADIUS * spins == pytest.approx(RADIUS * w, abs=1e-2 * 9.5)
    assert energy(case, found, spins) < energy(case, case.velocity, case.spin)


@pytest.mark.parametrize(
    "e", [{"form": "polynomial", "coefficients": [0.97, -0.01, 0]}, {"form": "viscoelastic", "c": 0.1}]
)
def test_a_restitution_of_the_speed_is_read_at_the_contact(e: Any) -> None:
    # two balls of a cluster: a third one is near, and untouched
    for speed in (0.5, 3.0, 9.5):
        case = row(2, speed=speed)
        setup = set_up(scene_of(case, restitution=e), compiled=False)
        world, features, balls = as_objects(setup.world)[0], as_objects(setup.features), as_objects(setup.balls)
        cluster.place_all(world, balls, 0, 1)
        assert (
            cluster.collide_cluster(world, features, balls, 0, 1, -1) == 2
        )  # (the pair's law is that of the integration)
        alone = carom.simulate(scene_of(case, restitution=e)).final.velocity
        assert [one.cv[0] for one in balls] == pytest.approx(alone[:, 0].tolist(), abs=3e-4 * speed)


def test_mirror_images_and_numbers_do_not_matter() -> None:
    case = broken(velocity=(9.5, 0.0, 0.0), restitution=0.95, friction=0.06)
    v, w = after(case)
    twin = [int(np.linalg.norm(case.position * [1, -1, 1] - x, axis=1).argmin()) for x in case.position]
    assert v[twin] == pytest.approx(v * [1, -1, 1], abs=1e-9)
    assert w[twin] == pytest.approx(w * [-1, 1, -1], abs=1e-7)
    case = broken(spread=4e-5, velocity=(9.5, 0.3, 0.0), restitution=0.95, friction=0.06)
    order = np.random.default_rng(1).permutation(16)
    mixed = after(case._replace(position=case.position[order], velocity=case.velocity[order], spin=case.spin[order]))
    assert mixed[0] == pytest.approx(after(case)[0][order], abs=1e-8)


def test_two_strikes_at_one_instant_do_not_depend_on_the_numbers() -> None:
    # two balls that touch: one is struck so that it leaves the other, which is struck towards it
    d, angle = 2 * RADIUS, np.radians(70)
    x = np.array([[0, 0, RADIUS], [d, 0, RADIUS], [d * np.cos(angle), d * np.sin(angle), RADIUS], [2 * d, 0, RADIUS]])
    v = np.array([[0, 0, 0], [0, 0, 0], [-np.cos(angle), -np.sin(angle), 0], [-1.0, 0, 0]])
    case = Case(x, v, 0 * v, 0.95)
    found = after(case)[0]
    assert found == pytest.approx(integrate(case, 0.002)[1], abs=1e-4)
    for order in ([3, 1, 0, 2], [1, 3, 2, 0], [2, 3, 0, 1]):
        mixed = after(Case(x[order], v[order], 0 * v, 0.95))[0]
        assert mixed == pytest.approx(found[order], abs=1e-12)


def test_meetings_of_pairs_at_one_instant_stay_pairs() -> None:
    # two pairs beside each other, farther apart than a contact lasts: bits of one pair at a time
    x = np.array([[a * 2 * RADIUS, b * 2.1 * RADIUS, RADIUS] for b in (0, 1) for a in (0, 1)])
    v = np.array([[1.0, 0, 0], [0, 0, 0], [2.0, 0, 0], [0, 0, 0]])
    case = Case(x, v, 0 * v, 0.9, 0.1)
    assert after(case)[0].tolist() == after(case, overlap=False)[0].tolist()


@pytest.mark.parametrize("seed", range(4))
def test_energy_never_grows_and_without_loss_it_stays(seed: int) -> None:
    rng = np.random.default_rng(seed)
    for restitution, friction in ((1.0, 0.0), (1.0, 0.2), (0.8, np.inf)):
        case = broken(
            gap=1e-4,
            spread=4e-5,
            seed=seed,
            restitution=restitution,
            friction=friction,
            velocity=(*rng.uniform(1, 9, 2), 0.0),
        )
        case.spin[:] = rng.normal(0, 30, (16, 3)) * (friction > 0)
        v, w = after(case)
        before = energy(case, case.velocity, case.spin)
        assert (v - case.velocity).sum(axis=0) == pytest.approx(np.zeros(3), abs=1e-12)
        if friction == 0:
            assert energy(case, v, w) == pytest.approx(before, rel=1e-12)
        else:
            assert energy(case, v, w) <= before * (1 + 1e-12)


def test_balls_of_any_sizes_and_masses() -> None:
    radii, masses = [0.02, 0.03, 0.025], [0.05, 0.2, 0.1]
    x = [-0.05 - 1e-9, 0.0, 0.055 + 2e-5]
    balls = [
        {"radius": a, "mass": m, "position": (y, 0, 0), "velocity": (v, 0, 0)}
        for a, m, y, v in zip(radii, masses, x, (2.0, 0.0, 0.0), strict=True)
    ]
    v = carom.simulate(carom.Scene(gravity=0, balls=balls, run={"duration": 1e-6})).final.velocity[:, 0]
    modulus, dt = 5.84e9 / (2 * (1 - 0.34**2)), 5e-8
    k = [4 / 3 * modulus * np.sqrt(radii[i] * radii[i + 1] / (radii[i] + radii[i + 1])) for i in range(2)]
    y, u = np.array(x), np.array([2.0, 0.0, 0.0])
    for _ in range(16_000):
        f = [k[i] * max(radii[i] + radii[i + 1] - y[i + 1] + y[i], 0.0) ** 1.5 for i in range(2)]
        u += dt / np.array(masses) * [-f[0], f[0] - f[1], f[1]]
        y += dt * u
    assert v == pytest.approx(u, abs=1e-4)


def test_in_the_open_nothing_changes() -> None:
    # a ball that meets two, one after the other, farther apart than a contact lasts: the log has the same bits
    case = row(3, gap=0.01, restitution=0.95, friction=0.05)
    one, other = (carom.simulate(scene_of(case, 0.2, overlap=overlap)) for overlap in (True, False))
    assert one.log.tobytes() == other.log.tobytes()
    assert not (one.log["kind"] == IN_CLUSTER).any()


def test_a_third_ball_counts_as_far_as_the_contact_lasts() -> None:
    # at 1 m/s: the struck ball comes to the third one within the time that the contact lasts, or after that
    lasts = contact_time(row(3), 1.0)
    for gap, together in ((0.9 * lasts, True), (1.1 * lasts, False)):
        done = carom.simulate(scene_of(row(3, gap=gap), 0.01))
        assert (done.log["kind"] == IN_CLUSTER).any() == together


def test_python_and_compiled_code_have_the_same_bits() -> None:
    case = broken(spread=4e-5, restitution=0.95, friction=0.05)
    scene = scene_of(case, 1e-6)
    setup, log = set_up(scene, compiled=False), np.zeros(40, LOG)
    rows = as_objects(log)
    answer = run(
        as_objects(setup.world)[0], as_objects(setup.features), as_objects(setup.balls), rows, -1.0, 1e-6, 99, [], ALL
    )
    carom.simulate_many(scene, velocity=[case.velocity])  # (the compiled loop is loaded from here on)
    compiled = carom.simulate(scene).log
    assert answer[2] == len(compiled) == 32
    assert [one.v for one in rows[:32]] == compiled["v"].tolist()
    assert [one.w for one in rows[:32]] == compiled["w"].tolist()


def test_the_log_has_a_row_for_each_ball_that_was_touched() -> None:
    done = carom.simulate(scene_of(broken(gap=0.0), 1e-6))
    log = done.log[16:]
    assert log["kind"].tolist() == [BALL] * 2 + [IN_CLUSTER] * 14
    assert sorted(log["ball"]) == list(range(16))
    assert log["other"][:2].tolist() == [1, 0]
    assert done.events.kinds == ["ball"] * 16
    assert set(event_numbers(done.log)[16:]) == {16}
    assert log["impulse"] == pytest.approx(MASS * (log["v"] - log["v_before"]), abs=1e-15)
    assert log["impulse"].sum(axis=0) == pytest.approx(np.zeros(3), abs=1e-12)
    # each names a ball that it touches; they are put back on their ways, at most a tenth of a radius off, and none overlap
    start, after = done.log["x"][:16], log["x"][np.argsort(log["ball"])]
    assert np.linalg.norm(start[log["ball"]] - start[log["other"]], axis=1) == pytest.approx(2 * RADIUS, abs=1e-8)
    assert np.linalg.norm(after - start, axis=1).max() < 0.1 * RADIUS
    assert pdist(after).min() > 2 * RADIUS * (1 - 1e-9)
    # a ball beside that nothing touches has no row
    far = broken(gap=0.0)
    far = Case(
        np.vstack([far.position, [0.0, 2.1 * RADIUS, RADIUS]]),
        np.vstack([far.velocity, [0, 0, 0]]),
        np.zeros((17, 3)),
        1.0,
    )
    assert len(carom.simulate(scene_of(far, 1e-6)).log) == 17 + 16


def test_a_log_that_is_full_goes_on_with_the_next() -> None:
    scene = scene_of(broken(spread=4e-5, restitution=0.95), 0.05)
    whole = carom.simulate(scene).log
    setup = set_up(scene, compiled=False)
    world, features, balls = as_objects(setup.world)[0], as_objects(setup.features), as_objects(setup.balls)
    slow, parts, status = -1.0, [], FULL
    while status == FULL:
        rows = as_objects(np.zeros(17, LOG))
        status, _events, count, _ball, slow, _last = run(world, features, balls, rows, slow, 0.05, 10**6, [], ALL)
        parts += rows[:count]
    assert [one.v for one in parts] == whole["v"].tolist()
    assert [one.kind for one in parts] == whole["kind"].tolist()


def test_bystanders_that_overlap_by_rounding_do_not_keep_a_cluster_alive() -> None:
    # two balls that overlap by 1e-12 m beside a row: their contact is too slow to count, and they stay where they are
    case = row(3)
    beside = np.array([[0.0, 2.1 * RADIUS, RADIUS], [2 * RADIUS - 1e-12, 2.1 * RADIUS, RADIUS]])
    whole = Case(np.vstack([case.position, beside]), np.vstack([case.velocity, 0 * beside]), np.zeros((5, 3)), 1.0)
    v, _w = after(whole)
    assert v[:3] == pytest.approx(after(case)[0], abs=1e-12)
    assert not v[3:].any()


def test_derivatives_are_those_of_differences() -> None:
    # the ball comes in from some way, so that the time of the event changes too
    case = broken(spread=4e-5, restitution=0.95, friction=0.05)
    case.position[0, 0] -= 0.05
    scene = scene_of(case, 0.02)
    values = {
        "balls.0.velocity.y": 0.0,
        "balls.5.mass": case.mass,
        "ball_contact.restitution": 0.95,
        "ball_contact.young": 5.84e9,
    }
    run = carom.simulate(scene)
    found = run.sensitivity(list(values)).final.velocity
    for k, (name, value) in enumerate(values.items()):
        h = 1e-7 * max(value, 1.0)
        ends = [carom.simulate(carom.replaced(scene, {name: value + s * h})).final.velocity for s in (1, -1)]
        differences = (ends[0] - ends[1]) / (2 * h)
        assert found[..., k] == pytest.approx(differences, abs=2e-4 * np.abs(differences).max())


def test_one_pair_at_a_time_on_demand() -> None:
    one = CASES["cradle 3, touching, e 1"]
    v, _w = after(known_case(one), overlap=False)
    assert v == pytest.approx(np.array(one["one_pair_at_a_time"]), abs=1e-12)


def test_harder_balls_touch_for_a_shorter_time() -> None:
    # with gaps of 0.1 mm and balls of steel the contacts no longer overlap
    for young, together in ((5.84e9, True), (5e13, False)):
        assert (
            carom.simulate(scene_of(row(3, gap=1e-4), 0.01, young=young)).log["kind"] == IN_CLUSTER
        ).any() == together


@pytest.mark.parametrize("seed", [0, 4, 8, 9, 13, 18])
def test_drawn_layouts_with_gaps_and_double_strikes_keep_what_they_must(seed: int) -> None:
    rng, a = np.random.default_rng(seed), RADIUS
    centres = [np.zeros(2)]
    while len(centres) < 4:
        turn, gap = rng.uniform(0, 2 * np.pi), rng.choice([0, 1e-5, 1e-4, 5e-4])
        there = centres[rng.integers(len(centres))] + (2 * a + gap) * np.array([np.cos(turn), np.sin(turn)])
        if all(np.hypot(*(there - one)) >= 2 * a for one in centres):
            centres.append(there)
    turn = rng.uniform(0, 2 * np.pi)
    way = np.array([np.cos(turn), np.sin(turn)])
    start = -way * (max(float(-way @ one) for one in centres) + 4 * a) + rng.uniform(-a, a) * np.array(
        [-way[1], way[0]]
    )
    # (of every fourth, another ball comes from the other side at the same instant)
    strikers = [(start, way), *([(-start, -way)] if seed % 4 == 0 else [])]
    given = [*((one, np.zeros(2)) for one in centres), *strikers]
    e, mu = (1.0, 0.0) if seed % 2 else (0.9, 0.3)

    def after(order: Any) -> tuple[Any, Any]:
        balls = [
            {"radius": a, "mass": 0.17, "position": (*given[i][0], a), "velocity": (*given[i][1], 0.0)} for i in order
        ]
        contact = {"restitution": e, "friction": mu}
        scene = carom.Scene(gravity=0, balls=balls, walls=[], ball_contact=contact, run={"duration": 0.2})
        state, back = carom.simulate(scene).final, np.argsort(order)
        return np.array(state.velocity)[back], np.array(state.spin)[back]

    v, w = after(np.arange(len(given)))
    other, _spin = after(rng.permutation(len(given)))
    before = np.array([one[1] for one in given])
    assert np.abs(other - v).max() < 1e-9
    assert np.abs(v[:, :2].sum(axis=0) - before.sum(axis=0)).max() < 1e-12
    kept = (np.square(v).sum() + 0.4 * a * a * np.square(w).sum()) / np.square(before).sum()
    assert kept == pytest.approx(1, abs=1e-12) if e == 1 else kept < 1


@pytest.mark.parametrize("seed", [8001436, 8019294, 8023716])
def test_balls_that_a_wall_moves_apart_overlap_by_a_thousandth_at_most(seed: int) -> None:
    """Random scenes in which a pair and a wall are in contact at once: judged by small steps, with distances of their own."""
    assert judge(carom.simulate(random_scene(seed)))[0] == ""
