"""carom's laws in pooltool: the numbers alone everywhere, whole shots where pooltool, 0.6.0 or main, is installed."""

from __future__ import annotations

import importlib.util
import math
import sys
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import carom
import carom.interop.pooltool as interop
from carom.interop.pooltool.physics import after_collision, after_cushion, landed, nose_normal, off_cushion, off_floor

POOLTOOL = importlib.util.find_spec("pooltool") is not None
MAIN = POOLTOOL and importlib.util.find_spec("pooltool.evolution.engine") is not None
needs_pooltool = pytest.mark.skipif(not POOLTOOL, reason="pooltool is not installed")
needs_main = pytest.mark.skipif(not MAIN, reason="pooltool's main branch is not installed")
# (what pooltool and its libraries warn of is theirs)
foreign = pytest.mark.filterwarnings("ignore::DeprecationWarning", "ignore::SyntaxWarning", "ignore::UserWarning")

BALL = carom.Ball(0.028575, 0.170097)
WALL, FLOOR, GRAVITY = carom.Surface(0.85, 0.2), carom.Surface(0.0, 0.2), 9.81
NOSE = 0.036576
RESTING = carom.State((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


def states(count: int) -> list[carom.State]:
    """Balls on the table, of all directions, speeds and spins."""
    random = np.random.default_rng(7)
    found = []
    for _ in range(count):
        speed, angle = 10 ** random.uniform(-2, 1), random.uniform(0, 2 * math.pi)
        v = np.array([speed * math.cos(angle), speed * math.sin(angle), 0.0])
        found.append(carom.State(v, random.normal(size=3) * speed / BALL.radius))
    return found


@pytest.mark.parametrize("side", [1, -1])
def test_the_normal_points_from_the_nose_to_the_ball(side: int) -> None:
    n = nose_normal((0.0, side), (1.0, 2.0, 0.0), NOSE, BALL.radius)
    # the ball comes along +y, so the cushion lies beyond it; its nose is 8.001 mm above the centre
    assert n[0] == 0
    assert n[1] == pytest.approx(-math.sqrt(1 - (8.001 / 28.575) ** 2), rel=1e-12)
    assert n[2] == pytest.approx(-8.001 / 28.575, rel=1e-12)


@pytest.mark.parametrize("height", [0.0, -0.01, 2 * 0.028575, 1.0])
def test_a_nose_beside_the_ball_is_refused_in_one_line(height: float) -> None:
    with pytest.raises(carom.CaromError, match=r"^pooltool: cushion: expected a nose between 0 and 0\.05715 m.* got"):
        nose_normal((1.0, 0.0), (1.0, 0.0, 0.0), height, BALL.radius)


@pytest.mark.parametrize("nose", [NOSE, BALL.radius])
def test_a_cushion_leaves_the_state_of_two_step_after_the_landing_bit_for_bit(nose: float) -> None:
    lifted = 0
    for state in states(100):
        n = nose_normal((0.6, 0.8), state.velocity, nose, BALL.radius)
        after, flight = after_cushion(carom.LAWS["two-step"], BALL, state, n, WALL, FLOOR, GRAVITY)
        two = carom.two_step(BALL, state, WALL, FLOOR, n, GRAVITY)
        if np.isfinite(two.after_floor.velocity).all():
            assert after == two.after_floor
            assert (flight.height, flight.duration, flight.distance) == (
                two.flight.height, two.flight.duration, two.flight.distance,
            )  # fmt: skip
            lifted += flight.height > 0
        assert abs(after.velocity[2]) <= 1e-15 * np.abs(after.velocity).sum()
    assert lifted > 30 if nose == BALL.radius else lifted < 30


def test_a_ball_that_is_thrown_up_lands_with_the_friction_of_that_impulse() -> None:
    after, flight = landed(BALL, carom.State((1.0, 0.0, 0.5), (0.0, 0.0, 0.0)), FLOOR, GRAVITY)
    # Coulomb: mu times the impulse that stops 0.5 m/s; 2/7 of the slip would end it
    assert after.velocity == pytest.approx((1 - 0.2 * 0.5, 0.0, 0.0))
    assert after.spin == pytest.approx((0.0, 0.2 * 0.5 / (0.4 * BALL.radius), 0.0))
    assert flight.duration == pytest.approx(2 * 0.5 / GRAVITY)
    assert flight.height == pytest.approx(0.5**2 / (2 * GRAVITY))
    assert flight.distance == pytest.approx(flight.duration)


def test_a_ball_that_is_driven_down_lands_without_a_flight() -> None:
    after, flight = landed(BALL, carom.State((1.0, 0.0, -0.5), (0.0, 0.0, 0.0)), FLOOR, GRAVITY)
    assert after.velocity == pytest.approx((0.9, 0.0, 0.0))
    assert (flight.duration, flight.height, flight.distance) == (0, 0, 0)


def test_two_balls_meet_as_in_collide_and_land() -> None:
    surface = carom.Surface(0.95, 0.06)
    striking = carom.State((1.0, 0.2, 0.0), (0.0, 40.0, 30.0))
    (one, two), flights = after_collision(
        BALL, (striking, RESTING), np.array([-1.0, 0.0, 0.0]), surface, FLOOR, GRAVITY
    )
    hit = carom.collide(BALL, striking, BALL, RESTING, (-1.0, 0.0, 0.0), surface)
    for after, before_landing in zip((one, two), hit.after, strict=True):
        down = carom.State((*before_landing.velocity[:2], -abs(before_landing.velocity[2])), before_landing.spin)
        assert after == carom.impact(BALL, down, (0.0, 0.0, 1.0), FLOOR).after
    assert sorted(flight.height > 0 for flight in flights) == [False, True]


def test_balls_that_move_apart_are_left_alone() -> None:
    pair = (carom.State((-1.0, 0.0, 0.0), (0.0, 0.0, 0.0)), RESTING)
    assert after_collision(BALL, pair, np.array([-1.0, 0.0, 0.0]), WALL, FLOOR, GRAVITY)[0] is pair


def test_a_law_that_does_not_hold_says_so_in_one_line() -> None:
    state = carom.State((-1.0, 0.5, 0.0), (0.0, 0.0, 0.0))  # slides, which the conventional law excludes
    with pytest.raises(carom.CaromError, match="needs, got velocity") as caught:
        after_cushion(carom.LAWS["conventional"], BALL, state, np.array([1.0, 0.0, 0.0]), WALL, FLOOR, GRAVITY)
    assert len(caught.value.faults) == 1


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"cushion": "two-stp"}, "law: expected one of .*did you mean 'two-step'"),
        ({"cushion": 3}, "engine: cushion: expected a str, got int 3"),
        ({"wall": (0.8, 0.2)}, "engine: wall: expected a Surface, got tuple"),
        ({"wall": carom.Surface([0.8, 0.9], 0.2)}, "engine: wall: expected one surface, got arrays"),
        ({"ball_ball": "pooltool"}, "engine: ball_ball: expected 'carom' or None"),
        ({"is_3d": "yes"}, "engine: is_3d: expected a bool, got str 'yes'"),
    ],
)
def test_wrong_arguments_are_one_line_each(options: dict[str, Any], said: str) -> None:
    with pytest.raises(carom.CaromError, match=said) as caught:
        interop.engine(**options)
    assert len(caught.value.faults) == 1


@pytest.mark.parametrize("nose", [NOSE, BALL.radius])
def test_where_balls_fly_a_cushion_leaves_the_state_of_two_step_after_the_wall_bit_for_bit(nose: float) -> None:
    floor = carom.Surface(0.5, 0.2)
    rising = 0
    for state in states(100):
        n = nose_normal((0.6, 0.8), state.velocity, nose, BALL.radius)
        after = off_cushion(carom.LAWS["two-step"], BALL, state, n, WALL, floor, GRAVITY)
        two = carom.two_step(BALL, state, WALL, floor, n, GRAVITY)
        if two.after_wall.velocity[2] >= 0:
            assert after == two.after_wall
        assert after.velocity[2] >= 0
        rising += after.velocity[2] > 0
    assert rising > 30 if nose == BALL.radius else rising == 0  # a nose above the centre presses the ball on the cloth


def test_a_law_that_drives_the_ball_down_leaves_the_floor_at_once() -> None:
    down = carom.State((1.0, 0.0, -0.5), (0.0, 0.0, 0.0))
    after = off_floor(BALL, down, carom.Surface(0.5, 0.2))
    # Coulomb: the impulse stops 0.5 m/s and gives 0.25 m/s back
    assert after.velocity == pytest.approx((1 - 0.2 * 0.75, 0.0, 0.25))
    up = carom.State((1.0, 0.0, 0.5), (0.0, 0.0, 0.0))
    assert off_floor(BALL, up, FLOOR) is up


@pytest.mark.skipif(POOLTOOL, reason="pooltool is installed")
@pytest.mark.parametrize("function", [interop.engine, interop.register])
def test_without_pooltool_one_line_says_what_is_needed(function: Any) -> None:
    assert "pooltool" not in sys.modules
    with pytest.raises(carom.CaromError, match=r"needs pooltool 0\.6, which is not installed; .* two commands"):
        function()


# --- in pooltool ------------------------------------------------------------------------------------------------------


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


@needs_pooltool
@foreign
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


@needs_pooltool
@foreign
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


@needs_pooltool
@foreign
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


@needs_pooltool
@foreign
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


@needs_pooltool
@foreign
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


@needs_pooltool
@foreign
@pytest.mark.skipif(MAIN, reason="this pooltool has flights")
def test_flights_are_refused_where_pooltool_has_none() -> None:
    with pytest.raises(
        carom.CaromError, match=r"engine: is_3d: expected False, as pooltool 0\.6\.0 has no flights, got True"
    ):
        interop.engine(is_3d=True)


@needs_main
@foreign
def test_main_has_flights_if_nothing_else_is_asked() -> None:
    assert interop.engine(is_3d=True).is_3d
    assert not interop.engine(is_3d=False).is_3d
    assert interop.engine(ball_ball=None).resolver.ball_ball.model == "frictional_inelastic"
    with pytest.raises(carom.CaromError, match="engine: ball_ball: expected 'carom' where balls fly"):
        interop.engine(ball_ball=None, is_3d=True)


@needs_main
@foreign
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
@foreign
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
@foreign
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
@foreign
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
@foreign
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
