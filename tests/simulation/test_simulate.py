"""simulate and simulate_many: what they take, how they end, laws of a user's own."""

import copy
import math
import pickle
from typing import Any

import numpy as np
import pytest

import carom
from carom.scene.shapes import Plane, Segment, Sphere
from carom.simulation import records
from carom.simulation.records import LOG, WALL, set_up

A = 0.03


def ball(position, velocity=(0.0, 0.0, 0.0), **more):
    return carom.SceneBall(radius=A, mass=0.2, position=position, velocity=velocity, **more)


def wall(law="mirror", **more):
    return Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=1.0, friction=0.2, law=law, **more)


def test_a_copy_of_a_scene_is_another_scene():
    """The arrays that a run was set up with are not those of a copy with other walls; and scenes still compare."""
    scene = carom.Scene(gravity=0, walls=[wall()], balls=[ball((1, 0, 0), (-1, 0, 0))], run=carom.Run(duration=3.0))
    assert carom.simulate(scene).events.kinds == ["wall"]
    bare = scene.model_copy(update={"walls": ()})
    assert carom.simulate(bare).events.kinds == []
    assert scene == carom.Scene.model_validate(scene.model_dump())
    assert carom.simulate(scene).events.kinds == ["wall"]


@pytest.mark.parametrize("way", [copy.copy, copy.deepcopy, lambda scene: pickle.loads(pickle.dumps(scene))])
def test_a_copy_of_a_scene_takes_nothing_computed_along(way: Any) -> None:
    scene = carom.Scene(gravity=0, walls=[wall()], balls=[ball((1, 0, 0), (-1, 0, 0))], run=carom.Run(duration=3.0))
    run = carom.simulate(scene)
    assert set(scene.kept) <= {"arrays", "compiled arrays", "loops"}
    copied = way(scene)
    assert copied == scene
    assert copied.kept == {}
    assert carom.simulate(copied).log.tobytes() == run.log.tobytes()


def test_the_arrays_of_a_scene_are_made_once_for_a_run_and_all_that_follows(monkeypatch: pytest.MonkeyPatch) -> None:
    made = []
    make = records._set_up
    monkeypatch.setattr(records, "_set_up", lambda scene, compiled: made.append(scene) or make(scene, compiled))
    scene = carom.Scene(gravity=0, walls=[wall()], balls=[ball((1, 0, 0), (-1, 0, 0))], run=carom.Run(duration=3.0))
    run = carom.simulate(scene)
    assert [one is scene for one in made] == [True]
    run.at([0.0, 1.5])
    found = run.sensitivity("walls.0.restitution")
    assert (found.near_misses, len(found.margin)) is not None
    assert sum(one is scene for one in made) == 1


def test_a_run_changes_nothing_of_its_scene():
    scene = carom.Scene(gravity=0, walls=[wall()], balls=[ball((1, 0, 0), (-1, 0, 0))], run=carom.Run(duration=3.0))
    before = set_up(scene).balls.tobytes()
    first = carom.simulate(scene)
    with pytest.raises(ValueError, match="read-only"):
        first.arrays.balls["x"] = 0.0
    assert set_up(scene).balls.tobytes() == before
    assert carom.simulate(scene).log.tobytes() == first.log.tobytes()


def test_how_a_run_ends():
    fall = carom.simulate(carom.Scene(balls=[ball((0, 0, 1))], run=carom.Run(duration=1.0)))
    assert (fall.end, fall.ended) == (1.0, "duration")
    np.testing.assert_allclose(fall.final.position[0], (0, 0, 1 - 9.80665 / 2), rtol=1e-15)
    rests = carom.simulate(
        carom.Scene(floor=carom.Floor(friction=0.2, rolling_resistance=0.01), balls=[ball((0, 0), (1, 0, 0))])
    )
    assert rests.ended == "nothing more happens"
    assert rests.final_phase == ["rest"]
    assert rests.at(rests.end + 5).position[0, 0] == rests.final.position[0, 0]
    most = carom.simulate(
        carom.Scene(
            gravity=0, walls=[Sphere(center=(0, 0, 0), radius=1, inside=True, restitution=1.0, friction=0.0)],
            balls=[ball((0, 0, 0), (1, 0.2, 0))], run=carom.Run(max_events=7),
        )
    )  # fmt: skip
    assert most.ended == "max_events"
    assert len(most.events) == 7
    with pytest.raises(carom.CaromError, match=r"expected times from 0 to .* s, got"):
        most.at(most.end + 1)


def test_conventional_refuses_a_ball_that_does_not_roll():
    def scene(**more):
        return carom.Scene(
            floor=carom.Floor(friction=0.2), walls=[Plane(point=(0, 0, 0), normal=(1, 0, 0))],
            balls=[ball((0.2, 0), (-1, 0.5, 0), **more)], run=carom.Run(law="conventional", duration=1.0),
        )  # fmt: skip

    run = carom.simulate(scene(rolling=True))
    state = carom.conventional(carom.Ball(A, 0.2), carom.rolling(carom.Ball(A, 0.2), (-1.0, 0.5)))
    np.testing.assert_allclose(run.final.velocity[0], state.velocity, rtol=1e-14)
    with pytest.raises(carom.CaromError, match=r"simulate: ball 0: .* the wall's law is for a ball that rolls"):
        carom.simulate(scene(spin=(0, 20.0, 0)))


def test_laws_of_a_users_own():
    """Two of them, on two walls, called through their addresses; the same numbers as the functions themselves."""

    def soft(v, w, n, a, kappa, e, mu, beta):
        un = v[0] * n[0] + v[1] * n[1] + v[2] * n[2]
        return (v[0] - 1.5 * un * n[0], v[1] - 1.5 * un * n[1], v[2] - 1.5 * un * n[2]), (2 * w[0], w[1], w[2])

    def hard(v, w, n, a, kappa, e, mu, beta):
        un = v[0] * n[0] + v[1] * n[1] + v[2] * n[2]
        return (v[0] - 2 * e * un * n[0], v[1] - 2 * e * un * n[1], v[2] - 2 * e * un * n[2]), (a, kappa, mu)

    laws = [carom.wall_law(carom.Card(f.__name__, "", (), "", "", ""), f) for f in (soft, hard)]
    scene = carom.Scene(
        gravity=0,
        walls=[
            wall(laws[0]),
            Plane(point=(2, 0, 0), normal=(-1, 0, 0), restitution=1.0, friction=0.3, law=laws[1]),
        ],
        balls=[ball((1, 0, 0), (-1, 0.25, 0), spin=(1.0, 2.0, 3.0))],
        run=carom.Run(max_events=2),
    )
    first, second = carom.simulate(scene).events
    assert (first.name, second.name) == ("plane 0", "plane 1")
    np.testing.assert_allclose(first.after.velocity, (0.5, 0.25, 0))
    np.testing.assert_allclose(first.after.spin, (2, 2, 3))
    np.testing.assert_allclose(second.after.velocity, (-0.5, 0.25, 0))
    np.testing.assert_allclose(second.after.spin, (A, 0.4, 0.3))
    assert first.regime == ""  # such a law does not say


def test_a_run_under_another_law_than_the_scenes():
    own = Plane(point=(3, 0, 0), normal=(-1, 0, 0), restitution=0.9, friction=0.1, law="no-slip")
    others = [Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.9, friction=0.1), own]
    scene = carom.Scene(gravity=0, walls=others, balls=[ball((1, 0, 0), (-1, 0.5, 0))], run=carom.Run(duration=4))
    again = carom.Scene(gravity=0, walls=others, balls=scene.balls, run=carom.Run(duration=4, law="maw"))
    run = carom.simulate(scene, law="maw")
    assert run.scene == again
    assert np.array_equal(run.final.velocity, carom.simulate(again).final.velocity)
    assert not np.array_equal(run.final.velocity, carom.simulate(scene).final.velocity)
    assert np.array_equal(carom.simulate(scene, law=carom.LAWS["maw"]).final.velocity, run.final.velocity)
    assert scene.run.law == "two-step"
    for wrong in ("mow", 3, carom.Ball):
        with pytest.raises(carom.CaromError, match=r"^simulate: law: expected one of mirror, .*got"):
            carom.simulate(scene, law=wrong)
    with pytest.raises(carom.CaromError, match="for the law conventional"):
        carom.simulate(scene, law="conventional")


def test_many_runs_are_single_runs():
    """Bit by bit; kept events are the single run's; a refused run says why."""
    scene = carom.Scene(
        floor=carom.Floor(friction=0.2, restitution=0.5, rolling_resistance=0.01),
        walls=[
            Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.8, friction=0.2),
            Segment(start=(1, -1), end=(1, 1), height=0.05, restitution=0.9, friction=0.1),
        ],
        balls=[ball((0.5, 0)), ball((0.6, 0.2), (0.1, 0, 0))],
        ball_contact=carom.BallContact(restitution=0.9, friction=0.1),
    )
    rng = np.random.default_rng(3)
    v = np.concatenate([rng.normal(size=(40, 2, 2)), np.zeros((40, 2, 1))], axis=2) * (3, 3, 0)
    many = carom.simulate_many(scene, velocity=v, events=5, kinds=("wall", "rest"))
    for n in range(40):
        balls = [b.model_copy(update={"velocity": tuple(u)}) for b, u in zip(scene.balls, v[n].tolist(), strict=True)]
        one = carom.simulate(scene.model_copy(update={"balls": tuple(balls)}))
        assert many.final[n] == one.final
        assert many.phase[n].tolist() == one.final_phase
        rows = one.events.of("wall", "rest").rows[:5]
        assert many.events[n, : len(rows)].tobytes() == rows.tobytes()
        assert (many.events[n, len(rows) :]["kind"] == 0).all()
        assert many.count[n] == len(
            {(e.t, min(e.ball, e.other) if e.kind == "ball" else (e.ball, e.kind)) for e in one.events}
        )


def test_many_starts_are_checked():
    scene = carom.Scene(gravity=0, walls=[wall()], balls=[ball((1, 0, 0), (-1, 0, 0))], run=carom.Run(duration=3.0))
    x = np.tile([1.0, 0.0, 0.0], (5, 1))
    for bad in ((A / 2, 0, 0), (-1.0, 0, 0)):  # in the wall, behind it
        x[3] = bad
        with pytest.raises(carom.CaromError, match=r"position: .* at index 3 \(1 in all\)"):
            carom.simulate_many(scene, position=x)
    with pytest.raises(carom.CaromError, match=r"expected states \(N, 1, 3\), got shape \(5, 2, 3\)"):
        carom.simulate_many(scene, velocity=np.zeros((5, 2, 3)))
    with pytest.raises(carom.CaromError, match=r"kinds: expected kinds of events .* got 'wal'"):
        carom.simulate_many(scene, kinds=("wal",))
    with pytest.raises(carom.CaromError, match="velocity: expected finite numbers"):
        carom.simulate_many(scene, velocity=np.full((5, 3), math.nan))


def test_starts_of_several_balls_are_given_ball_by_ball():
    """Three numbers of each run would be those of all balls, and those of each ball one run."""
    scene = carom.Scene(gravity=0, balls=[ball((float(x), 0, 0)) for x in range(3)], run=carom.Run(duration=1))
    for wrong in ([1.0, 0, 0], [[1.0, 0, 0]], [[1.0, 0, 0], [2, 0, 0], [3, 0, 0]], [[[1.0, 0, 0]]]):
        with pytest.raises(carom.CaromError, match=r"expected states \(N, 3, 3\), runs by balls by axes, got shape"):
            carom.simulate_many(scene, velocity=wrong)
    many = carom.simulate_many(scene, velocity=[[[1.0, 0, 0], [0, 1, 0], [0, 0, 1]]])
    assert many.final.velocity[0].tolist() == [[1, 0, 0], [0, 1, 0], [0, 0, 1]]


def test_a_run_describes_itself():
    from carom.simulation.narrate import describe_run

    scene = carom.Scene(gravity=0, walls=[wall()], balls=[ball((1, 0, 0), (-1, 0, 0))], run=carom.Run(duration=1.0))
    run = carom.simulate(scene)
    assert run.describe() == describe_run(run)
    assert run.describe()[0].startswith("ball 0 flies at 1 m/s")


def test_strikes_of_many_runs_are_the_scene_s_own():
    """What the how-to does: the states of strikes as starts."""
    struck = carom.SceneBall(
        radius=A, mass=0.2, position=(0, 0), strike={"speed": 2.0, "azimuth": 10.0, "offset": (0.2, 0.1)}
    )
    floor = carom.Floor(friction=0.2, rolling_resistance=0.01)
    scene = carom.Scene(floor=floor, balls=[struck, ball((0.8, 0.1))], run=carom.Run(duration=1.0))
    start = carom.strike(struck.ball, speed=2.0, azimuth_deg=[10.0, 12.0], offset=(0.2, 0.1)).state
    velocity, spin = np.zeros((2, 2, 3)), np.zeros((2, 2, 3))
    velocity[:, 0], spin[:, 0] = start.velocity, start.spin
    many = carom.simulate_many(scene, velocity=velocity, spin=spin)
    assert many.final[0] == carom.simulate(scene).final
    assert many.final[1] == carom.simulate(carom.replaced(scene, {"balls.0.strike.azimuth": 12.0})).final


def test_events_of_many_runs_as_a_table():
    scene = carom.Scene(gravity=0, walls=[wall()], balls=[ball((1, 0, 0))], run=carom.Run(duration=1.0))
    many = carom.simulate_many(scene, velocity=[[-1.0, 0, 0], [1, 0, 0], [-2, 0, 0]], events=2)
    table = many.table()
    one = carom.simulate(carom.replaced(scene, {"balls.0.velocity": (-2, 0, 0)})).events.table()
    assert table.columns.tolist() == ["run", *one.columns]
    assert table["run"].tolist() == [0, 2]
    assert table.iloc[1].drop("run").tolist() == one.iloc[0].tolist()
    assert table.attrs["units"] == one.attrs["units"]
    assert many.to_pandas().equals(table)
    assert np.isnan(many.events["t"][1]).all()  # no event is at no time
    assert repr(many) == "<ManyRuns: 3 runs of 1 ball, 2 events kept>"


def test_what_holds_a_ball_is_named():
    held = carom.simulate(
        carom.Scene(
            walls=[Plane(name="slope", point=(0, 0, 0), normal=(0, -0.6, 0.8), restitution=0.2, friction=0.1)],
            balls=[ball((0, 0, 0.3))], run=carom.Run(duration=5.0),
        )
    )  # fmt: skip
    last = held.events[-1]
    assert (last.kind, last.name, last.phase, held.final_phase) == ("held", "slope", "held", ["held"])
    assert np.isnan(held.at(held.end + 0.1).velocity).all()
    assert np.isfinite(held.final.velocity).all()


def test_a_wall_far_away_does_not_keep_bounces_from_being_summed():
    """A ball is behind one of the two faces of a thin wall, wherever it is."""

    def run(walls):
        return carom.simulate(
            carom.Scene(
                floor=carom.Floor(friction=0.2, restitution=0.5), walls=walls, balls=[ball((0, 0), (1, 0, 1))],
                run=carom.Run(duration=2.0),
            )
        )  # fmt: skip

    alone = run([])
    assert alone.events.of("settled")
    beside = run([Segment(start=(50, 0), end=(51, 0), restitution=0.5, friction=0.1)])
    assert beside.log.tobytes() == alone.log.tobytes()


def test_a_users_law_may_make_arrays():
    """carom's own kernels make none, and are compiled without what that takes; a user's may."""

    def rotated(v, w, n, a, kappa, e, mu, beta):
        u = np.array(v) - 2 * np.dot(np.array(v), np.array(n)) * np.array(n)
        return (u[0], u[1], u[2]), w

    law = carom.wall_law(carom.Card("rotated", "", (), "", "", ""), rotated)
    scene = carom.Scene(
        gravity=0, walls=[wall(law)], balls=[ball((1, 0, 0), (-1, 0.25, 0))], run=carom.Run(max_events=1)
    )
    np.testing.assert_allclose(carom.simulate(scene).final.velocity[0], (1, 0.25, 0))


def test_a_meeting_is_two_rows_and_what_follows_has_its_own() -> None:
    """A head-on meeting in mid-air: both initial states, the meeting of either ball, then the wall."""
    balls = [
        carom.SceneBall(radius=0.1, mass=1.0, position=(x, 0, 1), velocity=(v, 0, 0))
        for x, v in ((1.0, -1.0), (0.5, 0.0))
    ]
    walls = [carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=1, friction=0)]
    run = carom.simulate(carom.Scene(balls=balls, walls=walls, gravity=0.0, run=carom.Run(max_events=3)))
    events = run.events
    assert list(events.kinds) == ["ball", "ball", "wall", "ball", "ball"]
    who = events.rows["ball"].tolist()
    assert sorted(who[:2]) == sorted(who[3:]) == [0, 1]
    assert who[2] == 1
    np.testing.assert_allclose(events.rows["t"], [0.3, 0.3, 0.7, 1.1, 1.1], rtol=1e-12)


def test_every_regime_of_the_log_has_its_name() -> None:
    """A contact without a normal impulse is a graze, which is not the same as no contact."""
    run = carom.simulate("carom", duration=3)
    hit = next(k for k, row in enumerate(run.log) if row["kind"] == WALL)
    for code, name in ((-1, ""), (0, "graze"), (1, "stick"), (2, "slide")):
        log = run.log.copy()
        log["regime"][hit] = code
        assert carom.Trajectory(run.scene, log, run.end, run.ended).events.of("wall")[0].regime == name


@pytest.mark.parametrize("law", ["maw", "stronge", "conventional", "no-slip", "mirror", "two-step"])
def test_the_impulse_of_a_wall_is_the_change_of_momentum(law: str) -> None:
    """Whoever computes the impact: a kernel that is compiled in, or one that is called by its address."""
    surface = {"law": law} if law == "conventional" else {"law": law, "restitution": 0.8, "friction": 0.2}
    plane = Plane(point=(0, 0, 0), normal=(0.8, 0.6, 0), **surface)
    rolling = carom.SceneBall(radius=0.03, mass=0.2, position=(1, 0), velocity=(-2, 0.3), rolling=True)
    run = carom.simulate(carom.Scene(floor={"friction": 0.2}, walls=[plane], balls=[rolling]), max_events=1)
    hit = run.events.of("wall")[0]
    expected = 0.2 * (hit.after.velocity - hit.before.velocity)
    assert abs(expected[0]) > 0.1
    np.testing.assert_allclose(hit.impulse, expected, rtol=1e-12, atol=1e-14)


def test_more_events_than_memory_has_places_for(monkeypatch: pytest.MonkeyPatch) -> None:
    """``events=10**9`` asked for 240 GB a run at once; memory is taken as events happen."""
    wall = {"shape": "box", "corner": (0, 0, 0), "size": (9, 9, 9), "inside": True}
    ball = {"radius": 0.1, "mass": 1, "position": (1, 1, 1)}
    starts = np.random.default_rng(2).normal(size=(40, 3)) * np.geomspace(1, 100, 40)[:, None]
    scene = carom.Scene(gravity=0, walls=[wall], balls=[ball], run={"law": "mirror", "duration": 200})
    for block in (16_384, 7):
        monkeypatch.setattr("carom.simulation.simulate.BLOCK", block)
        many = carom.simulate_many(scene, velocity=starts, events=10**9)
        assert many.events.shape == (40, many.count.max())
        assert many.count.min() < 100
        assert many.count.max() > 4000
        assert (many.events["kind"] != 0).sum(axis=1).tolist() == many.count.tolist()
        few = carom.simulate_many(scene, velocity=starts, events=1000)
        assert few.events.shape == (40, 1000)
        assert few.events.tobytes() == many.events[:, :1000].tobytes()
        some = carom.simulate_many(scene, velocity=starts, events=np.int64(1500))
        assert some.events.tobytes() == many.events[:, :1500].tobytes()
        assert carom.simulate_many(scene, velocity=starts, events=10**9, kinds=("rest",)).events.shape == (40, 0)
    longest = int(many.count.argmax())
    ball["velocity"] = starts[longest].tolist()
    log = carom.simulate(carom.Scene(gravity=0, walls=[wall], balls=[ball], run=scene.run)).log
    assert log["t"][1:].tolist() == many.events["t"][longest].tolist()
    assert carom.simulate_many(scene, velocity=starts[:0], events=10**9).events.shape == (0, 0)
    monkeypatch.setattr("carom.simulation.simulate.MAX_KEPT_BYTES", LOG.itemsize * 40 * 2000)
    with pytest.raises(
        carom.CaromError, match=r"events: expected runs of no more than 2,000 events, .* of 40 runs, got one with"
    ):
        carom.simulate_many(scene, velocity=starts, events=10**9)
