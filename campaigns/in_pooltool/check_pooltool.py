"""carom's laws and runs in pooltool, 0.6.0 or main: the campaign `pooltool_shots` has pytest run these where it is installed."""

from __future__ import annotations

import importlib.util
import sys
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import carom
import carom.interop.pooltool as interop
from carom.interop.pooltool import engine, read, to_system
from carom.interop.pooltool.engine import use_as_default
from carom.interop.pooltool.physics import nose_normal, off_floor

MAIN = importlib.util.find_spec("pooltool.evolution.engine") is not None
needs_main = pytest.mark.skipif(not MAIN, reason="pooltool's main branch is not installed")
FILES = Path(__file__).parents[2] / "tests" / "interop" / "files"
BALL = carom.Ball(0.028575, 0.170097)
WALL, FLOOR, GRAVITY = carom.Surface(0.85, 0.2), carom.Surface(0.0, 0.2), 9.81


def shot(phi: float = 67.0, nose: float | None = None, sidespin: float = 0.0, speed: float = 3.0) -> Any:
    import pooltool as pt

    table = pt.Table.default(pt.TableType.BILLIARD)
    if nose is not None:
        table.set_cushion_height(nose)
    white = pt.Ball.create("white", xy=(0.4, 0.5))
    system = pt.System(cue=pt.Cue(cue_ball_id="white"), table=table, balls={"white": white})
    system.strike(V0=speed, phi=phi, a=sidespin)
    return system


def with_balls(phi: float) -> Any:
    import pooltool as pt

    table = pt.Table.default()
    system = pt.System(cue=pt.Cue(cue_ball_id="cue"), table=table, balls=pt.get_rack(pt.GameType.NINEBALL, table))
    system.strike(V0=6, phi=pt.aim.at_ball(system, "1") + phi)
    return system


@pytest.mark.parametrize("phi", [67.0, 20.0, 200.0, 300.0, 123.0])
@pytest.mark.parametrize("e", [1.0, 0.85])
def test_smooth_upright_cushions_give_pooltools_own_shot(phi: float, e: float) -> None:
    import pooltool as pt
    from pooltool.physics.resolve.ball_cushion.unrealistic import UnrealisticCircular, UnrealisticLinear
    from pooltool.physics.resolve.resolver import default_resolver

    from carom.interop.pooltool.models import make_engine

    resolver = default_resolver()  # its ball has a restitution of 0.85
    resolver.ball_linear_cushion = UnrealisticLinear(restitution=e < 1)
    resolver.ball_circular_cushion = UnrealisticCircular(restitution=e < 1)
    own = pt.simulate(shot(phi, BALL.radius), engine=make_engine(resolver, False))
    ours = pt.simulate(shot(phi, BALL.radius), engine=interop.engine("two-step", carom.Surface(e, 0.0)))
    assert [event.event_type for event in ours.events] == [event.event_type for event in own.events]
    assert ours.t == pytest.approx(own.t, abs=1e-12)
    assert ours.balls["white"].state.rvw == pytest.approx(own.balls["white"].state.rvw, abs=1e-12)


@pytest.mark.parametrize("number", range(10))
def test_shots_played_in_pooltool_have_two_steps_states_after_their_cushions(number: int) -> None:
    import pooltool as pt

    played = (
        with_balls(0.1 * number)
        if number > 6
        else shot(20.0 + 45 * number, sidespin=0.1 * (number - 3), nose=[None, BALL.radius][number % 2])
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        pt.simulate(played, engine=interop.engine(wall=WALL), inplace=True)
    found = 0
    for event in played.events:
        if "cushion" not in event.event_type:
            continue
        ball, cushion = sorted(event.agents, key=lambda agent: agent.agent_type != "ball")
        before, after = ball.initial.state.rvw, ball.final.state.rvw
        cushion = cushion.initial
        # (pooltool moves the ball by some micrometres onto the cushion first, and then asks for the normal of a jaw)
        n = nose_normal(cushion.get_normal_xy(after[0]), before[1], cushion.height, BALL.radius)
        two = carom.two_step(BALL, carom.State(before[1], before[2]), WALL, FLOOR, n, GRAVITY)
        assert after[1][:2].tolist() == two.after_floor.velocity[:2].tolist()
        assert after[2].tolist() == two.after_floor.spin.tolist()
        assert after[1][2] == 0
        found += 1
    assert found > 0
    assert played.t > 0
    assert all(ball.state.s in (0, 4) for ball in played.balls.values())  # at rest, or in a pocket


def test_flights_left_out_are_listed_and_warned_of_once() -> None:
    import pooltool as pt

    engine = interop.engine(wall=carom.Surface(0.85, 0.3))
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        pt.simulate(shot(67.0, BALL.radius), engine=engine)
        pt.simulate(shot(20.0, BALL.radius), engine=engine)
    said = [str(one.message) for one in caught if "has no gravity" in str(one.message)]
    flights = engine.resolver.ball_linear_cushion.flights
    assert len(flights) > 1
    assert all(flight.height > 0 for flight in flights)
    assert engine.resolver.ball_circular_cushion.flights is flights
    assert len(said) == 1
    assert f"{1000 * flights[0].height:.3g} mm high" in said[0]


@pytest.mark.parametrize("ending", [".yaml", ".json"])
def test_a_registered_resolver_survives_a_file(tmp_path: Path, ending: str) -> None:
    from pooltool.physics.resolve.resolver import Resolver

    interop.register()
    resolver = interop.engine("mathavan2010", carom.Surface(0.9, 0.14)).resolver
    path = resolver.save(tmp_path / f"resolver{ending}")
    loaded = Resolver.load(path)
    assert loaded == resolver
    assert loaded.ball_circular_cushion.law == "mathavan2010"
    assert loaded.ball_linear_cushion.flights == []


def test_a_custom_law_plays_and_is_not_written_to_files(tmp_path: Path) -> None:
    import pooltool as pt

    def dead(v, w, n, a, kappa, e, mu, beta):  # type: ignore[no-untyped-def]
        u = v[0] * n[0] + v[1] * n[1] + v[2] * n[2]
        return (v[0] - u * n[0], v[1] - u * n[1], v[2] - u * n[2]), w

    law = carom.wall_law(carom.Card("dead", "Takes the normal velocity.", (), "An example.", "", ""), dead)
    interop.register()
    engine = interop.engine(law)
    played = pt.simulate(shot(90.0, BALL.radius), engine=engine, t_final=1.5)
    assert abs(played.balls["white"].state.rvw[0][1] - (2.84 - BALL.radius)) < 1e-3
    with pytest.raises(carom.CaromError, match="pooltool: law: expected a law of carom's by name in a file"):
        engine.resolver.save(tmp_path / "resolver.yaml")


# --- in its main branch, where balls fly ------------------------------------------------------------------------------


@pytest.mark.skipif(MAIN, reason="this pooltool has flights")
def test_flights_are_refused_where_pooltool_has_none() -> None:
    with pytest.raises(
        carom.CaromError, match=r"engine: is_3d: expected False, as pooltool 0\.6\.0 has no flights, got True"
    ):
        interop.engine(is_3d=True)


@needs_main
def test_main_has_flights_if_nothing_else_is_asked() -> None:
    assert interop.engine(is_3d=True).is_3d
    assert not interop.engine(is_3d=False).is_3d
    assert interop.engine(ball_ball=None).resolver.ball_ball.model == "frictional_inelastic"
    with pytest.raises(carom.CaromError, match="engine: ball_ball: expected 'carom' where balls fly"):
        interop.engine(ball_ball=None, is_3d=True)


@needs_main
@pytest.mark.parametrize("phi", [60.0, 75.0, 110.0])
def test_main_flies_the_hop_of_two_step_and_lands_on_caroms_floor(phi: float) -> None:
    import pooltool as pt

    played = pt.simulate(shot(phi, BALL.radius), engine=interop.engine(wall=WALL, is_3d=True), t_final=1.5)
    kinds = [str(event.event_type) for event in played.events]
    first = kinds.index("ball_linear_cushion")
    assert kinds[first + 1] == "ball_table"
    met, down = played.events[first], played.events[first + 1]
    ball, cushion = sorted(met.agents, key=lambda agent: agent.agent_type != "ball")
    before, after = ball.initial.state.rvw, ball.final.state.rvw
    floor = carom.Surface(0.5, 0.2)  # the ball's e_t and u_s
    n = nose_normal(cushion.initial.get_normal_xy(after[0]), before[1], cushion.initial.height, BALL.radius)
    two = carom.two_step(BALL, carom.State(before[1], before[2]), WALL, floor, n, GRAVITY)
    assert after[1].tolist() == two.after_wall.velocity.tolist()
    assert down.time - met.time == pytest.approx(two.flight.duration, rel=1e-9)
    landing, left = (getattr(down.agents[0], when).state.rvw for when in ("initial", "final"))
    on_floor = carom.impact(BALL, carom.State(landing[1], landing[2]), (0.0, 0.0, 1.0), floor).after
    assert left[1] == pytest.approx(on_floor.velocity, abs=1e-12)
    assert left[2] == pytest.approx(on_floor.spin, abs=1e-9)


@needs_main
@pytest.mark.parametrize("number", range(10))
def test_shots_in_main_end_where_carom_alone_ends_them(number: int, tmp_path: Path) -> None:
    import pooltool as pt

    played = shot(20.0 + 35 * number, sidespin=0.05 * (number - 5), speed=1.0 + 0.1 * number)
    pt.simulate(played, engine=interop.engine(is_3d=True), inplace=True)
    played.save(tmp_path / "shot.json")
    (found,) = interop.read(tmp_path / "shot.json")
    run = carom.simulate(found.scene)
    path = found.paths["white"]
    length = np.linalg.norm(np.diff(path[:, 1:3], axis=0), axis=1).sum()
    assert len(run.events.of("wall")) > 0
    assert np.linalg.norm(run.final.position[0, :2] - path[-1, 1:3]) < 0.01 * length


@needs_main
def test_an_elevated_cue_lifts_the_ball_in_main_and_in_its_file(tmp_path: Path) -> None:
    import pooltool as pt

    played = shot(90.0, speed=2.0)
    played.cue.theta = 40.0
    pt.simulate(played, engine=interop.engine(is_3d=True), inplace=True, t_final=0.3)
    heights = [state.rvw[1, 2] for state in played.balls["white"].history]
    assert max(heights) > 0.1
    assert min(heights) < 0
    played.save(tmp_path / "jump.json")
    run = carom.simulate(interop.read(tmp_path / "jump.json")[0].scene)
    assert np.nanmax(run.at(np.linspace(0, 0.3, 300)).position[:, 0, 2]) > BALL.radius + 1e-3


@needs_main
def test_balls_in_main_meet_as_in_collide() -> None:
    import pooltool as pt

    played = pt.simulate(with_balls(0.3), engine=interop.engine(is_3d=True), t_final=1.0)
    event = next(one for one in played.events if one.event_type == "ball_ball")
    one, two = event.agents
    states = [carom.State(agent.initial.state.rvw[1], agent.initial.state.rvw[2]) for agent in (one, two)]
    normal = one.final.state.rvw[0] - two.final.state.rvw[0]
    hit = carom.collide(BALL, states[0], BALL, states[1], normal, carom.Surface(0.95, 0.05)).after
    flying = 0
    for agent, met in zip((one, two), hit, strict=True):
        after = off_floor(BALL, met, carom.Surface(0.5, 0.2))  # (one of the two is pressed on the cloth)
        assert agent.final.state.rvw[1] == pytest.approx(after.velocity, abs=1e-12)
        assert agent.final.state.rvw[2] == pytest.approx(after.spin, abs=1e-9)
        flying += agent.final.state.s == 5
    assert flying == 2


@needs_main
def test_the_floor_survives_a_file(tmp_path: Path) -> None:
    from pooltool.physics.resolve.resolver import Resolver

    interop.register()
    resolver = interop.engine("mathavan2010", is_3d=True).resolver
    loaded = Resolver.load(resolver.save(tmp_path / "resolver.yaml"))
    assert loaded == resolver
    assert (loaded.ball_table.model, loaded.ball_table.least_bounce, loaded.ball_linear_cushion.is_3d) == (
        "carom_floor",
        1e-9,
        True,
    )


# --- carom's runs in pooltool ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["break.json", "bank.json"])
def test_a_run_comes_back_from_pooltools_file(name: str, tmp_path: Path) -> None:
    scene = read(FILES / name)[0].scene
    run = carom.simulate(scene)
    system = to_system(run, dt=0.02)
    assert system.simulated
    assert system.continuized
    system.save(tmp_path / "run.msgpack")
    (back,) = read(tmp_path / "run.msgpack")
    old, new = scene.walls[0], back.scene.walls[0]
    assert isinstance(new, carom.scene.Table)
    assert new.restitution == old.restitution
    for field in ("length", "width", "nose_height", "friction"):
        assert getattr(new, field) == pytest.approx(getattr(old, field), abs=1e-12)
    assert back.scene.floor == scene.floor
    final = run.final.position
    for i, ball in enumerate(scene.balls):
        assert back.paths[ball.name or ""][-1, 1:] == pytest.approx(final[i], abs=1e-12)


def test_a_table_along_x_is_turned_and_hops_are_kept() -> None:
    ball = carom.SceneBall(radius=0.03, mass=0.2, position=(0.5, 0.1), velocity=(-2.0, 1.0), rolling=True, name="white")
    table = carom.scene.Table(length=2.84, width=1.42, restitution=0.85, friction=0.2)
    floor = carom.Floor(friction=0.2, rolling_resistance=0.01, spin_friction=0.01)
    run = carom.simulate(carom.Scene(floor=floor, walls=[table], balls=[ball], run=carom.Run(duration=1)))
    system = to_system(run)
    rvw, _s, t = system.balls["white"].history_cts.vectorize()
    there = run.at(t)
    # a quarter turn: x in pooltool is half the width less y
    assert rvw[:, 0, 0] == pytest.approx(0.71 - there.position[:, 0, 1], abs=1e-12)
    assert rvw[:, 0, 1] == pytest.approx(1.42 + there.position[:, 0, 0], abs=1e-12)
    assert rvw[:, 1, 1] == pytest.approx(there.velocity[:, 0, 0], abs=1e-12)
    assert np.allclose(rvw[:, 0, 2], there.position[:, 0, 2])
    assert rvw[:, 0, 2].max() > 0.031
    assert (system.table.w, system.table.l) == (1.42, 2.84)
    assert system.cue.cue_ball_id == "white"


def test_the_game_plays_with_caroms_engine() -> None:
    import pooltool as pt

    module = sys.modules["pooltool.evolution.event_based.simulate"]
    before = module.DEFAULT_ENGINE.resolver
    try:
        use_as_default(engine("mathavan2010"))
        shot = pt.System.example()
        given = pt.simulate(shot, engine=engine("mathavan2010"))
        assert pt.simulate(shot).t == given.t
    finally:
        module.DEFAULT_ENGINE.resolver = before
    assert pt.simulate(shot).t != given.t
