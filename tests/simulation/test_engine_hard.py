"""The hard instants: contact that lasts, contact at time zero, bounces without number, many contacts at once."""

import itertools
import math
from typing import Any

import numpy as np
import pytest
from reference.exploring import tried
from reference.hertz_contacts import Case, integrate

import carom

A = 0.03
BALL = {"radius": A, "mass": 0.2}
FLOOR = {"friction": 0.2, "restitution": 0.5}
TILT = np.array([0.3, 0.0, 1.0]) / math.hypot(0.3, 1.0)
SURFACE = {"restitution": 0.5, "friction": 0.2}


def ball(*position: float, **more: Any) -> dict[str, Any]:
    return {**BALL, "position": list(position), **more}


def plane(*normal: float, at: tuple[float, ...] = (0.0, 0.0, 0.0), **more: Any) -> dict[str, Any]:
    return {"shape": "plane", "point": list(at), "normal": list(normal), **SURFACE, **more}


def run(*balls: dict[str, Any], **scene: Any) -> carom.Trajectory:
    scene.setdefault("run", {"duration": 10.0, "max_events": 20_000})
    return carom.simulate(carom.Scene(balls=list(balls), **scene))


def gaps(run: carom.Trajectory, times: Any) -> Any:
    """Least distance between two balls, over their radii's sum, at each time."""
    x = run.at(times).position
    assert x is not None
    a = np.array([one.radius for one in run.scene.balls])
    apart = np.sqrt(((x[..., :, None, :] - x[..., None, :, :]) ** 2).sum(-1)) - a[:, None] - a
    apart[..., np.arange(len(a)), np.arange(len(a))] = np.inf
    return np.nanmin(apart, axis=(-1, -2))


# --- contact that lasts, from the first instant on -------------------------------------------------------------------

LYING = {
    "on a tilted plane": ([plane(0.3, 0, 1)], TILT * A),
    "on a tilted plane that returns everything": ([plane(0.3, 0, 1, restitution=1.0)], TILT * A),
    "on a sphere": ([{"shape": "sphere", "center": [0, 0, 0], "radius": 0.1, **SURFACE}], (0, 0, 0.13)),
    "on an edge": ([{"shape": "box", "center": [0, 0, -0.05], "size": [0.1] * 3, **SURFACE}], (0.05, 0, A)),
    "on a corner": ([{"shape": "box", "center": [0, 0, -0.05], "size": [0.1] * 3, **SURFACE}], (0.05, 0.05, A)),
    "on a bar": ([{"shape": "segment", "start": [-1, 0], "end": [1, 0], "height": 0.1, **SURFACE}], (0, 0, 0.1 + A)),
}


@pytest.mark.parametrize(("walls", "place"), LYING.values(), ids=LYING.keys())
def test_a_ball_that_lies_there_is_held_at_once(walls: Any, place: Any) -> None:
    found = run(ball(*map(float, place)), walls=walls)
    assert found.events.kinds == ["wall", "held"]
    assert found.events.t.tolist() == [0.0, 0.0]
    assert found.final_phase == ["held"]


@pytest.mark.parametrize("e", [0.0, 0.5, 1.0])
def test_a_ball_that_lies_on_a_ball_is_held(e: float) -> None:
    found = run(ball(0, 0), ball(0, 0, 3 * A), floor=FLOOR, ball_contact={"restitution": e})
    assert found.events.kinds == ["ball", "ball", "held", "held"]
    assert found.final_phase == ["held", "held"]


@pytest.mark.parametrize("e", [0.0, 0.3, 0.5, 0.9])
@pytest.mark.parametrize("floor", [0.0, 0.5, 0.9])
def test_a_ball_that_drops_on_a_ball_comes_to_lie_on_it(e: float, floor: float) -> None:
    # under the other's hops the lower one is struck, and struck again by the floor
    found = run(ball(0, 0), ball(0, 0, 4 * A), floor={**FLOOR, "restitution": floor}, ball_contact={"restitution": e})
    assert found.final_phase == ["held", "held"]
    x = found.final.position
    assert x is not None
    assert x[1, 2] == pytest.approx(3 * A, abs=1e-8 * A)
    assert gaps(found, np.linspace(0, found.end, 5000)).min() >= -1e-9 * A


# --- along a wall ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("approach", [0.0, 1e-16, 1e-15, 1e-14, 1e-12, 1e-10])
@pytest.mark.parametrize("e", [0.0, 0.5, 1.0])
def test_a_ball_that_rolls_along_a_wall_for_100_m(approach: float, e: float) -> None:
    n = np.array([1.0, 0.7]) / math.hypot(1.0, 0.7)
    v = [0.7 * 3.0 - approach, -3.0]
    found = run(
        ball(*(A * n), velocity=v, rolling=True),
        floor={"friction": 0.2},
        walls=[plane(1.0, 0.7, 0.0, restitution=e)],
        run={"duration": 40.0},
    )
    assert len(found.events) <= 3
    assert found.final_phase == ["rolling"]
    x = found.at(np.linspace(0, 40, 1000)).position
    assert x is not None
    assert np.abs(x[-1, 0, :2] - A * n) @ np.abs([n[1], -n[0]]) > 100
    assert (x[:, 0, :2] @ n - A).min() >= -1e-9 * A


def test_a_ball_that_slides_along_a_side_does_not_meet_its_end() -> None:
    # the post at the end touches the ball's path in one point; rounding must not make a blow of it
    rng = np.random.default_rng(5)
    for _ in range(200):
        p, t = rng.normal(size=2), rng.normal(size=2)
        t /= np.linalg.norm(t)
        n = np.array([-t[1], t[0]])
        wall = {
            "shape": "segment",
            "start": p.tolist(),
            "end": (p + t).tolist(),
            "restitution": 0.0,
            "friction": math.inf,
        }
        start = [*(p + 0.3 * t + 2 * A * n), 0.0]
        found = run(
            ball(*start, velocity=[*(rng.uniform(1, 3) * t - n), 0.0]), gravity=0.0, walls=[wall], run={"duration": 5.0}
        )
        assert found.events.kinds == ["wall"]


# --- bounces without number ------------------------------------------------------------------------------------------


def test_hops_are_summed_behind_a_wall_as_they_are_anywhere() -> None:
    segment = {"shape": "segment", "start": [-1, -1], "end": [1, -1], **SURFACE}
    drop = ball(0, 0, 3 * A, velocity=[0.1, 0.2, 0.0])
    alone, behind = (run(drop, floor={**FLOOR, "restitution": 0.9}, walls=walls) for walls in ([], [segment]))
    assert "settled" in alone.events.kinds
    assert behind.events.rows.tobytes() == alone.events.rows.tobytes()


def test_a_bouncing_ball_is_struck_where_it_is() -> None:
    # it is free of all others when its hops are summed; then a light ball beside it is struck, and comes
    found = run(
        ball(0, 0, A + 0.9e-8, velocity=[0.001, 0.002, 0.0]),
        ball(0.21, 0, mass=0.002),
        ball(0.97, 0, velocity=[-10.0, 0.0]),
        floor={**FLOOR, "restitution": 0.999},
        run={"duration": 0.084, "max_events": 20_000},
    )
    assert "bouncing" in [phase for _from, _to, phase in found.phases(0)]
    struck = found.events.of("ball", ball=0)
    assert len(struck) >= 2
    for event in struck:
        assert abs(gaps(found, event.t)) <= 1e-9 * A
    assert gaps(found, np.linspace(0, found.end, 20_001)).min() >= -1e-9 * A


# --- many contacts at once -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("count", [2, 3, 5, 10])
def test_a_row_of_soft_balls_goes_on_together(count: int) -> None:
    # e = 0: contacts that close stay closed, until all have the same speed
    row = [ball(2 * A * k, 0, 0) for k in range(count)]
    found = run(
        ball(-0.5, 0, 0, velocity=[1.0, 0.0, 0.0]),
        *row,
        gravity=0.0,
        ball_contact={"restitution": 0.0},
        run={"duration": 5.0},
    )
    assert set(found.events.kinds) == {"ball"}
    assert found.final.velocity[:, 0] == pytest.approx(1 / (count + 1), abs=1e-12)


@pytest.mark.parametrize("gap", [0.0, 1e-9, 1e-6])
def test_newtons_cradle(gap: float) -> None:
    # its contacts overlap in time, and so the last ball does not get all: the first one turns back
    row = [ball((2 * A + gap) * k, 0, 0) for k in range(5)]
    striker = ball(-0.5, 0, 0, velocity=[1.0, 0.0, 0.0])
    found = run(striker, *row, gravity=0.0, run={"duration": 5.0})
    assert found.events.kinds == ["ball"] * 6
    x = np.array([one["position"] for one in (ball(-2 * A, 0, 0), *row)])
    v = np.zeros_like(x)
    v[0, 0] = 1.0
    _x, right, _w = integrate(Case(x, v, 0 * v, 1.0, 0.0, A, 0.2), 0.002)
    assert found.final.velocity == pytest.approx(right, abs=1e-4)
    assert right[0, 0] < -0.06
    one_by_one = run(striker, *row, gravity=0.0, run={"duration": 5.0}, ball_contact={"overlap": False})
    assert one_by_one.events.kinds == ["ball"] * 10
    assert one_by_one.final.velocity[:, 0] == pytest.approx([0, 0, 0, 0, 0, 1], abs=1e-15)


# --- the series of bounces against a sum of its own ----------------------------------------------------------------------


def series(x: Any, v: Any, w: Any, g: float, e: Any, mu: float, beta: float) -> tuple[Any, Any, Any, float, list[Any]]:
    """A drop from x and all its bounces in 50 digits: place, velocity, spin and time when it lies; its landings."""
    from mpmath import mp, mpf

    mp.dps = 50
    a, k = mpf(A), mpf(2) / 5
    x, v, w = [[mpf(float(c)) for c in vector] for vector in (x, v, w)]
    g, t, landings = mpf(g), mpf(0), []
    fall = (v[2] + mp.sqrt(v[2] ** 2 + 2 * g * (x[2] - a))) / g
    while True:
        t += fall
        x = [x[0] + v[0] * fall, x[1] + v[1] * fall, a]
        down = -(v[2] - g * fall)
        q = mpf(float(e(float(down))) if callable(e) else e)
        u = (v[0] - a * w[1], v[1] + a * w[0])
        slip = mp.sqrt(u[0] ** 2 + u[1] ** 2)
        p = (1 + q) * down
        hold = (1 + mpf(beta)) * k / (1 + k) * slip
        f = hold if mu == math.inf or hold <= mpf(mu) * p else mpf(mu) * p
        if slip > 0:
            fx, fy = -f * u[0] / slip, -f * u[1] / slip
            v[0], v[1] = v[0] + fx, v[1] + fy
            w[0], w[1] = w[0] + fy / (k * a), w[1] - fx / (k * a)
        v[2] = q * down
        landings.append((t, list(x), list(v), list(w)))
        fall = 2 * v[2] / g
        if fall < mpf(10) ** -30:
            return x, v, w, t, landings


BOUNCY = list(itertools.product([0.0, 0.5, 0.9, 0.99], [0.05, 0.3, math.inf], [0.0, 0.6, -0.4]))


@pytest.mark.parametrize(("e", "mu", "beta"), BOUNCY[:: tried(2, 1)])
@pytest.mark.slow(keep=9)
def test_all_bounces_are_summed(e: float, mu: float, beta: float) -> None:
    start = ([0.1, -0.2, 3 * A], [1.0, 0.3, 0.4], [5.0, -30.0, 7.0])
    floor = {"restitution": e, "friction": mu, "tangential_restitution": beta}
    found = run(ball(*start[0], velocity=start[1], spin=start[2]), floor=floor, gravity=9.8, run={"duration": 60.0})
    x, v, w, t, landings = series(*start, 9.8, e, mu, beta)
    last = found.events.of("settled" if e > 0 else "floor")[0]
    assert last.t == pytest.approx(float(t), rel=1e-12)
    assert last.before.position == pytest.approx([float(c) for c in x], abs=1e-12)
    assert [*last.after.velocity[:2], 0] == pytest.approx([float(v[0]), float(v[1]), 0], abs=1e-12)
    assert A * last.after.spin == pytest.approx([A * float(c) for c in w], abs=1e-12)
    # in the midst of it: between two landings of which the run logs none
    for k in {0, len(landings) // 3, len(landings) // 2, 3 * len(landings) // 4} - {len(landings) - 1}:
        (t0, x0, v0, w0), (t1, *_rest) = landings[k], landings[k + 1]
        when = float((t0 + t1) / 2)
        s = when - t0
        if (t1 - t0) < 1e-9:
            continue
        state = found.at(when)
        assert state.position is not None
        assert state.position[0] == pytest.approx(
            [float(x0[0] + v0[0] * s), float(x0[1] + v0[1] * s), float(x0[2] + v0[2] * s - 9.8 * s * s / 2)], abs=1e-12
        )
        assert state.velocity[0][:2] == pytest.approx([float(v0[0]), float(v0[1])], abs=1e-12)
        assert A * state.spin[0] == pytest.approx([A * float(c) for c in w0], abs=1e-12)


FORMS = [
    {"form": "han-2005"},
    {"form": "power", "at_rest": 0.9, "speed": 0.1},
    {"form": "exponential", "at_rest": 0.95, "at_speed": 0.5, "speed": 1.0},
    {"form": "polynomial", "coefficients": [0.5, 0.2, 0.0]},
]


@pytest.mark.parametrize("form", FORMS, ids=[str(form["form"]) for form in FORMS])
def test_all_bounces_are_summed_where_restitution_follows_the_speed(form: dict[str, Any]) -> None:
    start = ([0.0, 0.0, 5 * A], [0.5, 0.0, 0.0], [0.0, -30.0, 7.0])
    floor = {"restitution": form, "friction": 0.1}
    found = run(ball(*start[0], velocity=start[1], spin=start[2]), floor=floor, gravity=9.8, run={"duration": 60.0})
    restitution = found.scene.floor.restitution  # type: ignore[union-attr]
    x, _v, w, t, _landings = series(*start, 9.8, restitution.at, 0.1, 0.0)
    last = found.events.of("settled")[0]
    assert last.t == pytest.approx(float(t), rel=1e-12)
    assert last.before.position == pytest.approx([float(c) for c in x], abs=1e-12)
    assert A * last.after.spin == pytest.approx([A * float(c) for c in w], abs=1e-12)


# --- corners, gaps, and walls that end ------------------------------------------------------------------------------------


@pytest.mark.parametrize("law", ["mirror", "two-step"])
def test_a_corner_is_the_same_whichever_wall_comes_first_where_the_law_commutes(law: str) -> None:
    # (without friction the blows of two square walls commute; with it the wall that is listed first comes first)
    normals = [(1, 0, 0), (0, 1, 0), (0, 0, 1)]
    ends = []
    for order in ([0, 1, 2], [2, 1, 0], [1, 0, 2]):
        walls = [plane(*normals[k], friction=0.0) for k in order]
        found = run(
            ball(0.1, 0.1, 0.1, velocity=[-1.0] * 3, spin=[1.0, 2.0, 3.0]),
            walls=walls,
            gravity=0.0,
            run={"law": law, "duration": 1.0},
        )
        assert found.events.kinds == ["wall"] * 3
        assert found.events.rows["other"].tolist() == [0, 1, 2]
        assert len(set(found.events.t.tolist())) == 1
        ends.append(found.final.velocity[0].tolist())
    assert ends[0] == ends[1] == ends[2] == [0.5, 0.5, 0.5]


@pytest.mark.parametrize("gap", [0.0, 1e-13, 1e-9])
def test_a_ball_between_two_walls_as_wide_as_itself(gap: float) -> None:
    strip = {"shape": "strip", "point": [0, 0, 0], "normal": [1, 0, 0], "width": 2 * A + gap, **SURFACE}
    along = run(ball(A, 0, velocity=[0.0, 1.0], rolling=True), floor=FLOOR, walls=[strip], run={"duration": 5.0})
    assert along.events.kinds == []
    to_and_fro = run(ball(A, 0, 0, velocity=[1e-3, 1.0, 0.0]), walls=[strip], gravity=0.0, run={"duration": 5.0})
    assert set(to_and_fro.events.kinds) == {"wall"}
    assert len(to_and_fro.events) < 60
    x = to_and_fro.at(np.linspace(0, 5, 2000)).position
    assert x is not None
    assert x[:, 0, 0].min() >= A - 1e-9 * A
    assert x[:, 0, 0].max() <= A + gap + 1e-9 * A


@pytest.mark.slow
def test_a_ball_pinned_for_ever_is_held() -> None:
    strip = {
        "shape": "strip",
        "point": [0, 0, 0],
        "normal": [1, 0, 0],
        "width": 2 * A,
        "restitution": 1.0,
        "friction": 0.0,
    }
    found = run(ball(A, 0, 0, velocity=[1e-3, 0.0, 0.0]), walls=[strip], gravity=0.0)
    assert found.events.kinds[-1] == "held"
    assert found.end == 0.0


BAR = {"shape": "segment", "start": [0, -1], "end": [0, 1], **SURFACE}


def test_a_ball_that_hops_clears_a_low_cushion() -> None:
    # its centre is over the wall at t = 0.5 / 2 s, 12.6 cm above where it was
    found = run(
        ball(0.5, 0, velocity=[-2.0, 0.0, 1.6]), floor=FLOOR, walls=[{**BAR, "height": 0.05}], run={"duration": 0.3}
    )
    assert found.events.kinds == ["left"]
    assert found.events[0].t == pytest.approx(0.25, rel=1e-14)
    assert found.final_phase == ["flight"]
    # a wall all around: it has left for good
    table = {"shape": "table", "length": 2.0, "width": 1.0, "height": 0.04, **SURFACE}
    gone = run(ball(0.5, 0, velocity=[3.0, 0.0, 1.5]), floor=FLOOR, walls=[table])
    assert gone.events.kinds == ["left"]
    assert gone.final_phase == ["left"]
    assert gone.end == gone.events[0].t


def test_a_ball_that_does_not_clear_it_strikes_the_edge() -> None:
    def thrown(z: float) -> carom.Trajectory:
        return run(ball(0.2, 0, z, velocity=[-2.0, 0.0, 0.0]), walls=[{**BAR, "height": 0.05}], gravity=0.0)

    assert thrown(0.05 + 1.001 * A).events.kinds == ["left"]
    for above in (0.9, 0.5, 0.01):
        hit = thrown(0.05 + above * A).events[0]
        assert hit.kind == "wall"
        assert hit.before.position == pytest.approx([A * math.sqrt(1 - above**2), 0.0, 0.05 + above * A], abs=1e-14)
        assert hit.impulse[2] / hit.impulse[0] > 0
    face = thrown(0.049).events[0]
    assert face.before.position == pytest.approx([A, 0.0, 0.049], abs=1e-15)
    assert face.after.velocity[0] == pytest.approx(1.0)


def test_a_ball_rolls_under_a_raised_bar_and_strikes_one_that_is_too_low() -> None:
    under = run(
        ball(0.2, 0, velocity=[-2.0, 0.0], rolling=True),
        floor=FLOOR,
        walls=[{**BAR, "low": 0.0601}],
        run={"duration": 1.0},
    )
    assert under.events.kinds == []
    assert under.final.position is not None
    assert under.final.position[0, 0] == pytest.approx(-1.8)
    struck = run(
        ball(0.2, 0, velocity=[-2.0, 0.0], rolling=True),
        floor=FLOOR,
        walls=[{**BAR, "low": 0.05}],
        run={"duration": 1.0},
    )
    assert struck.events[0].kind == "wall"
    assert struck.events[0].before.position[0] == pytest.approx(math.sqrt(A**2 - 0.02**2), abs=1e-14)  # type: ignore[index]


@pytest.mark.parametrize("e", [0.0, 0.3])
def test_topspin_presses_a_ball_on_a_cushion_until_it_is_gone(e: float) -> None:
    mu, g = 0.2, 9.80665
    found = run(
        ball(0.1, 0, velocity=[-1.0, 0.0, 0.0], spin=[0.0, -200.0, 0.0]),
        floor=FLOOR,
        walls=[plane(1, 0, 0, restitution=e)],
        run={"duration": 3.0},
    )
    assert found.final_phase == ["rolling"]
    assert np.diff(found.energy(np.linspace(0, found.end, 20_000))).max() <= 1e-14
    x = found.at(np.linspace(0, found.end, 20_000)).position
    assert x is not None
    assert np.nanmin(x[:, 0, 0]) >= A - 1e-9 * A
    assert np.nanmin(x[:, 0, 2]) >= A - 1e-9 * A
    # while it is pressed: N_f + mu N_w = m g, N_w = mu N_f, and both frictions turn it
    late = [0.75, 0.9]
    assert found.at(late).position[:, 0, 0] == pytest.approx([A, A], abs=1e-6 * A)  # type: ignore[index]
    spins = found.at(late).spin[:, 0, 1]
    assert (spins[1] - spins[0]) / 0.15 == pytest.approx(5 / 2 * g * mu * (1 + mu) / (1 + mu * mu) / A, rel=2e-3)


@pytest.mark.parametrize("e", [0.0, 0.5, 1.0])
def test_a_ball_goes_round_in_a_ring(e: float) -> None:
    # the bend of the wall presses it all the way: a smooth one changes its direction only
    found = run(
        ball(0, A - 0.3, velocity=[1.0, 0.0, 0.0]),
        floor={"friction": 0.0, "restitution": 0.0},
        walls=[
            {"shape": "cylinder", "point": [0, 0, 0], "radius": 0.3, "inside": True, "restitution": e, "friction": 0.0}
        ],
        run={"duration": 2.0},
    )
    times = np.linspace(0.0, 2.0, 201)
    state = found.at(times)
    assert found.final_phase == ["sliding"]
    angle = times / (0.3 - A)
    place = (0.3 - A) * np.stack([np.sin(angle), -np.cos(angle)], axis=1)
    assert state.position is not None
    assert state.position[:, 0, :2] == pytest.approx(place, abs=1e-5)
    assert np.hypot(*state.position[:, 0, :2].T).max() <= 0.3 - A + 1e-9 * A
    speeds = np.sqrt((state.velocity[:, 0] ** 2).sum(axis=-1))
    assert speeds == pytest.approx(1.0, abs=1e-6)
    assert np.diff(speeds).max() <= 1e-14


@pytest.mark.parametrize("count", range(1, 8))
def test_a_run_may_end_amid_events_of_one_instant(count: int) -> None:
    # one pair at a time: contacts that overlap in time are one event
    row = [ball(2 * A * k, 0, 0) for k in range(5)]
    whole, cut = (
        run(
            ball(-0.5, 0, 0, velocity=[1.0, 0.0, 0.0]),
            *row,
            gravity=0.0,
            ball_contact={"overlap": False},
            run={"max_events": n, "duration": 5.0},
        )
        for n in (100, count)
    )
    rows = min(2 * count, 10)
    assert cut.events.rows.tobytes() == whole.events.rows[:rows].tobytes()
    assert cut.ended == ("max_events" if count < 5 else "duration")


@pytest.mark.parametrize("mu", [0.0, math.inf])
def test_a_floor_without_friction_and_one_with_all(mu: float) -> None:
    found = run(
        ball(0.5, 0.5, velocity=[-1.0, -0.7, 0.0], spin=[0.0, 50.0, 3.0]),
        floor={**FLOOR, "friction": mu},
        walls=[plane(1, 0, 0)],
        run={"duration": 3.0},
    )
    if mu == 0:
        assert found.phase(0.2).tolist() == ["sliding"]
        assert found.events[0].before.velocity == pytest.approx([-1.0, -0.7, 0.0])
    else:
        assert found.events[0].kind == "rolling"
        assert found.events[0].t == 0
        assert found.events[0].after.velocity == pytest.approx(
            [5 / 7 * -1.0 + 2 / 7 * 50 * A, 5 / 7 * -0.7, 0.0], abs=1e-15
        )


@pytest.mark.parametrize("friction", [0.0, 0.05])
@pytest.mark.parametrize("e", tried([1.0, 0.97, 0.8, 0.5, 0.3, 0.0], [1.0, 0.99, 0.97, 0.9, 0.8, 0.5, 0.3, 0.0]))
@pytest.mark.slow(keep=1)
def test_the_break_of_a_frozen_rack(e: float, friction: float) -> None:
    rack = [ball(i * A * math.sqrt(3) * (1 + 1e-15), (2 * j - i) * A) for i in range(5) for j in range(i + 1)]
    cloth = {**FLOOR, "rolling_resistance": 0.01, "spin_friction": 0.01}
    # (with little restitution the balls stay in touch, for hundreds of thousands of contacts: not to the end here)
    duration = tried(0.12 if e <= 0.3 else 60.0, 60.0)
    found = run(
        ball(-0.5, 0, velocity=[5.0, 0.0], rolling=True),
        *rack,
        floor=cloth,
        ball_contact={"restitution": e, "friction": friction},
        run={"duration": duration},
    )
    if duration == 60:
        assert found.ended == "nothing more happens"
        assert set(found.final_phase) == {"rest"}
    assert np.diff(found.energy(np.linspace(0, found.end, 2_000))).max() <= 1e-14
    blows = found.events.of("ball")
    first = blows.rows[blows.t < blows.t[0] + 1e-9]
    # (one row for each ball: all contacts of the first instant are one event, but for what is left over)
    assert set(first["ball"]) == set(range(16))
    # in that event no momentum is lost
    cluster = first[:16]
    assert cluster["v"].sum(axis=0)[:2] == pytest.approx(cluster["v_before"].sum(axis=0)[:2], abs=1e-12)
    # at the first instant: what the first ball brought is what all have (with friction the floor takes a part)
    v = found.at(blows.t[0] + 1e-9).velocity
    # (those that stay in touch pay for their first hop)
    if not friction:
        assert v[:, 1].sum() == pytest.approx(0, abs=1e-8 if e > 0 else 1e-6)
        assert v[:, 0].sum() == pytest.approx(blows[0].before.velocity[0], abs=1e-7 if e > 0 else 2e-6)
    # balls put back on their ways may overlap while they leave each other, by some micrometres; a millisecond later none does
    meet = np.unique(blows.t)
    times = np.union1d(meet, np.linspace(0, found.end, tried(5_000, 20_000)))
    late = times - meet[np.maximum(np.searchsorted(meet, times, "right") - 1, 0)] > 1e-3
    apart = gaps(found, times)
    assert apart[late].min(initial=math.inf) >= -1e-9 * A
    assert apart[~late].min() >= (-2e-4 if e > 0 else -1e-9) * A


@pytest.mark.parametrize("heavy", [1.0, 0.5, 3.0])
def test_a_ball_that_pushes_another_from_rest_in_touch(heavy: float) -> None:
    # after a blow that returns nothing both slide on with one speed: one pushes, for it has topspin, the other brakes
    mu, g, v = 0.2, 9.80665, 2.0
    found = run(
        ball(-1.0, 0, velocity=[v, 0.0], rolling=True),
        {**ball(0, 0), "mass": heavy * 0.2},
        floor=FLOOR,
        ball_contact={"restitution": 0.0},
    )
    blow = found.events.of("ball").t[0]
    common = v / (1 + heavy)
    acc = mu * g * (1 - heavy) / (1 + heavy)
    # the slip of each: how much its spin is ahead of its way; the floor's friction turns both at the same rate
    turn = mu * g * 5 / 2
    first = min((v - common) / (turn + acc), common / (turn - acc))
    times = blow + np.linspace(0.05, 0.9, 7) * first
    x, velocity = found.at(times).position, found.at(times).velocity
    assert x is not None
    assert np.abs(gaps(found, times)).max() < 1e-6 * A
    assert velocity[:, :, 0] == pytest.approx((common + acc * (times - blow))[:, None] + np.zeros(2), abs=3e-4)
    assert np.diff(found.energy(np.linspace(0, found.end, 5_000))).max() <= 1e-14
    assert set(found.final_phase) <= {"rolling", "rest"}
