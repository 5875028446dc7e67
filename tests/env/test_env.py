"""Environments for learning: Gymnasium's and PettingZoo's own checks; rules beside a referee who walks through single runs."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import pytest

import carom
from carom.errors import CaromError

gymnasium = pytest.importorskip("gymnasium")
pytest.importorskip("pettingzoo")

from gymnasium.utils.env_checker import check_env  # noqa: E402
from gymnasium.vector import SyncVectorEnv  # noqa: E402
from pettingzoo.test import api_test, parallel_api_test  # noqa: E402

import carom.env  # noqa: E402
from carom.env.billiards import BLACK, EightBall, SumToThree, ThreeCushion  # noqa: E402
from carom.env.registration import GAMES  # noqa: E402


@pytest.mark.parametrize("name", GAMES)
def test_gymnasium_finds_no_fault(name: str) -> None:
    env = gymnasium.make(f"carom/{name}-v0", shots=30)
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", ".*normalized space")  # (actions are in units)
        check_env(env.unwrapped)


@pytest.mark.parametrize("name", ["ThreeCushion", "EightBall", "SumToThree"])
def test_pettingzoo_finds_no_fault(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    api_test(carom.env.two_players(name, shots=8), num_cycles=20)
    assert "Passed" in capsys.readouterr().out


def test_pettingzoo_finds_no_fault_with_players_at_the_same_time() -> None:
    parallel_api_test(carom.env.two_players("AirHockey", shots=40), num_cycles=60)


@pytest.mark.parametrize(
    ("name", "steps"), [("ThreeCushion", 7), ("EightBall", 5), ("AirHockey", 40), ("TableTennisReturn", 5)]
)
def test_the_same_seed_is_the_same_game_also_among_many(name: str, steps: int) -> None:
    shots = min(steps - 2, 30)
    many = gymnasium.make_vec(f"carom/{name}-v0", num_envs=3, shots=shots)
    one_by_one = SyncVectorEnv([lambda: gymnasium.make(f"carom/{name}-v0", shots=shots)] * 3)
    assert many.observation_space == one_by_one.observation_space
    many.action_space.seed(5)
    actions = [many.action_space.sample() for _ in range(steps)]
    seen = []
    for envs in (many, one_by_one, many):
        played = [(envs.reset(seed=7)[0], *np.zeros((3, 3))), *(envs.step(action)[:4] for action in actions)]
        seen.append([np.concatenate([np.ravel(one) for one in step]) for step in played])
    assert np.array_equal(seen[0], seen[1])
    assert np.array_equal(seen[0], seen[2])
    assert not np.array_equal(many.reset(seed=8)[0], seen[0][0][: many.reset(seed=8)[0].size]) or name in (
        "ThreeCushion",
    )


def run_of(game: Any, row: int, before: tuple[Any, Any], stroke: Any) -> Any:
    """The run of a shot alone, from places and balls on the table before it."""
    speed, angle, side, top, elevation = (float(x) for x in stroke)
    places, lies = before
    struck = carom.strike(game.ball, speed=speed, azimuth_deg=angle, elevation_deg=elevation, offset=(side, top)).state
    changes = {"balls.0.velocity": tuple(struck.velocity), "balls.0.spin": tuple(struck.spin)}
    x = np.column_stack([np.where(lies[:, None], places, np.nan), np.full(len(lies), game.radius)])
    return carom.simulate(game.scene_of(x, changes))


@pytest.mark.parametrize("game_of", [ThreeCushion, SumToThree])
def test_points_are_those_of_a_referee(game_of: Any) -> None:
    game, rows = game_of(60, law="mirror"), np.arange(60)
    game.begin(rows, [np.random.default_rng(k) for k in rows])
    rng = np.random.default_rng(3)
    low, high = np.array(list(game.bounds.values())).T
    points = 0
    tried = rng.uniform(low, high, (900, len(low)))
    scored = tried[game.foresee(0, tried).reward > 0][:8]  # (all tables are alike at first)
    for _shot in range(2):
        actions = rng.uniform(low, high, (60, len(low)))
        actions[: 6 * len(scored) : 6] = scored
        before = game.places.copy(), game.lies.copy()
        strokes = game.strokes(rows, actions)
        played = game.play(rows, actions)
        points += int(played.reward.sum())
        for row in range(0, 60, 6):
            run = run_of(game, row, (before[0][row], before[1][row]), strokes[row])
            names = run.scene.ball_names
            met: list[str] = []
            cushions = 0
            for event in run.events:
                if event.kind == "wall" and (game_of is SumToThree or (event.ball == 0 and len(set(met)) < 2)):
                    cushions += 1
                if event.kind == "ball" and event.ball == 0:
                    met.append(event.name)
            right = cushions == 3 and len(met) > 0 if game_of is SumToThree else len(set(met)) == 2 and cushions >= 3
            assert bool(played.info["point"][row]) == right, (row, met, cushions, names)
            assert np.abs(run.final.position[:, :2] - game.places[row]).max() < 1e-9
    assert points > 0


def pool(places: dict[int, tuple[float, float]], *, kind: int = 0, opening: bool = False, **settings: Any) -> EightBall:
    """A table of eight-ball with some balls on it."""
    game = EightBall(1, **settings)
    game.begin(np.array([0]), [np.random.default_rng(1)])
    game.lies[0] = False
    for ball, place in places.items():
        game.lies[0, ball], game.places[0, ball] = True, place
    game.kind[0], game.taken[0] = kind, 0 if opening else 5
    return game


def shot(game: EightBall, speed: float, angle: float) -> Any:
    return game.play(np.array([0]), np.array([[speed, angle, 0.0, 0.0, 0.0]]))


X, Y = 1.27, 0.635
STRAIGHT = np.degrees(np.arctan2(0.4, 0.4))


@pytest.mark.parametrize(
    ("kind", "ball", "others", "speed", "angle", "wanted"),
    [
        (0, 3, (11,), 2.0, 45.0, {"foul": 0, "own": 1, "won": 0}),  # decides that it plays 1 to 7
        (1, 3, (11,), 2.0, 45.0, {"foul": 0, "own": 1, "won": 0}),
        (2, 3, (11,), 2.0, 45.0, {"foul": 3, "own": 0, "pocketed": 1, "won": 0}),  # the opponent's ball
        (1, BLACK, (), 2.0, 45.0, {"foul": 0, "won": 1}),  # the last one
        (1, BLACK, (3,), 2.0, 45.0, {"foul": 3, "won": -1}),  # too early
        (1, 3, (11,), 2.0, -90.0, {"foul": 2, "own": 0, "won": 0}),
        (1, 3, (11,), 0.35, 45.0, {"foul": 4, "own": 0, "won": 0}),
    ],
)
def test_rules_of_eight_ball(
    kind: int, ball: int, others: Any, speed: float, angle: float, wanted: dict[str, int]
) -> None:
    spots = {0: (X - 0.5, Y - 0.5), ball: (X - 0.22, Y - 0.22), BLACK: (-1.0, 0.0)} | {
        k: (-0.8, 0.1 * k - 0.5) for k in others
    }
    spots[ball] = (X - 0.22, Y - 0.22)
    game = pool(spots, kind=kind)
    played = shot(game, speed, angle)
    assert {name: int(played.info[name][0]) for name in wanted} == wanted
    assert bool(played.ended[0]) == (wanted["won"] != 0)
    if wanted.get("own") and kind == 0:
        assert game.kind[0] == 1
    if wanted["foul"] == 2:
        assert np.allclose(game.places[0, 0], (-X / 2, 0.0))  # in hand: on the head spot


def test_the_cue_ball_in_a_pocket_is_a_foul_and_the_turn_passes() -> None:
    game = pool({0: (X - 0.3, Y - 0.3), 3: (-1.0, 0.1), 11: (-X / 2, 0.0), BLACK: (-1.0, -0.3)}, kind=1, players=2)
    played = shot(game, 2.0, 45.0)
    assert played.info["foul"][0] == 1
    assert game.turn[0] == 1
    assert game.lies[0, 0]
    gap = np.linalg.norm(game.places[0, 0] - game.places[0, 11])
    assert 2 * game.radius < gap < 2.6 * game.radius  # beside the ball that lies on the head spot


def test_drawn_shots_of_eight_ball_are_as_a_referee_says() -> None:
    game, rows = EightBall(12, law="mirror"), np.arange(12)
    game.begin(rows, [np.random.default_rng(k) for k in rows])
    rng = np.random.default_rng(5)
    fouls = set()
    for number in range(6):
        actions = np.column_stack(
            [rng.uniform(2, 7, 12), rng.uniform(-180, 180, 12), rng.uniform(-0.3, 0.3, (12, 2)), np.zeros(12)]
        )
        if number == 0:
            actions[:, 1] = 13.3
        before = game.places.copy(), game.lies.copy()
        targets = game.targets(rows)
        played = game.play(rows, actions)
        for row in range(0, 12, 3):
            run = run_of(game, row, (before[0][row], before[1][row]), actions[row])
            names = [0 if name == "cue" else int(name.removesuffix("-ball")) for name in run.scene.ball_names]
            down = {names[i] for i, phase in enumerate(run.final_phase) if phase in ("pocketed", "left")}
            hits = [(event.t, int(event.name.removesuffix("-ball"))) for event in run.events.of("ball", ball=0)]
            after = [event for event in run.events.of("wall") if hits and event.t > hits[0][0]]
            foul = (
                1 if 0 in down else 2 if not hits else 3 if not targets[row, hits[0][1]] else 0 if down or after else 4
            )
            assert int(played.info["foul"][row]) == foul
            assert int(played.info["pocketed"][row]) == len(down - {0})
            fouls.add(foul)
    assert len(fouls) > 2


def test_a_rack_has_the_black_ball_in_the_middle_and_other_places_for_each_seed() -> None:
    game = EightBall(40)
    game.begin(np.arange(40), [np.random.default_rng(k) for k in range(40)])
    gaps = np.linalg.norm(game.places[:, :, None] - game.places[:, None, :], axis=-1)[:, ~np.eye(16, dtype=bool)]
    assert gaps.min() > 2 * game.radius
    assert np.abs(game.places[:, BLACK] - game.places[0, BLACK]).max() < 1e-4
    assert len({tuple(np.argsort(places[:, 0] + 1e-3 * places[:, 1])) for places in game.places}) == 40


def test_laws_differ_and_words_tell_the_shot() -> None:
    ends = {}
    for law in ("two-step", "mirror"):
        env = gymnasium.make("carom/ThreeCushion-v0", law=law, render_mode="ansi")
        env.reset(seed=1)
        env.step(np.array([4.0, 8.6, -0.3, 0.0, 0.0], np.float32))
        ends[law] = env.unwrapped.game.places.copy()
        assert "white" in env.render()
        assert "red" in env.render()
    assert np.abs(ends["two-step"] - ends["mirror"]).max() > 0.05


def test_what_a_shot_would_give_is_what_it_gives() -> None:
    game = carom.env.ThreeCushion(1)
    game.begin(np.array([0]), [np.random.default_rng(1)])
    actions = np.random.default_rng(2).uniform(*np.array(list(game.bounds.values())).T, (20, 5))
    foreseen = game.foresee(0, actions)
    assert np.array_equal(game.places[0], game.start)
    for k in range(3):
        game.begin(np.array([0]), [np.random.default_rng(1)])
        assert game.play(np.array([0]), actions[k : k + 1]).reward[0] == foreseen.reward[k]


def test_a_goal_counts_for_the_side_that_struck_and_sides_see_alike() -> None:
    game, row = carom.env.AirHockey(1, players=2), np.array([0])
    game.begin(row, [np.random.default_rng(1)])
    game.x[0, 0], game.v[0, 0] = (0.9, 0.05, 0.0), (6.0, 0.0, 0.0)
    game.x[0, 2, :2] = 0.5, 0.3
    seen = [game.observe(row)[0]]
    game.turn[0] = 1
    assert np.allclose(game.observe(row)[0], -seen[0][[0, 2, 1]])
    game.turn[0] = 0
    played = game.play(row, np.zeros((1, 4)))
    assert played.reward[0] == 1
    assert game.goals[0].tolist() == [1, 0]
    assert np.allclose(game.x[0, 0], 0)


def test_a_good_return_is_a_point_and_no_bat_is_none() -> None:
    game, rows = carom.env.TableTennisReturn(30), np.arange(30)
    game.begin(rows, [np.random.default_rng(k) for k in rows])
    x, v = game.met[:, 0], game.met[:, 1]
    assert ((x[:, 0] < -1.5) & (x[:, 2] > 0.1) & (v[:, 0] < 0)).all()
    met = game.met.copy()
    actions = np.tile([2.5, 0.0, 1.0, 0.0, 15.0], (30, 1))
    played = game.play(rows, actions)
    assert 0 < played.reward.sum() < 30
    for k in np.flatnonzero(played.info["x"])[:3]:
        up = np.radians(15.0)
        bat, face = np.array([2.5, 0.0, 1.0]), np.array([np.cos(up), 0.0, np.sin(up)])
        rubber = carom.Surface(restitution=0.85, friction=1.0, tangential_restitution=0.3)
        come = carom.State(velocity=met[k, 1] - bat, spin=met[k, 2])
        hit = carom.impact(carom.Ball(0.02, 0.0027, inertia="hollow"), come, normal=face, surface=rubber).after
        ball = game.scene.balls[0]
        start = {"position": tuple(met[k, 0]), "velocity": tuple(hit.velocity + bat), "spin": tuple(hit.spin)}
        run = carom.simulate(carom.replaced(game.scene, {f"balls.0.{name}": value for name, value in start.items()}))
        down = next(event for event in run.events if event.kind == "floor")
        assert np.allclose(down.position[:2], (played.info["x"][k], played.info["y"][k]), atol=1e-9), ball
        assert bool(played.info["point"][k]) == (0 < down.position[0] < 1.37 and abs(down.position[1]) < 0.7625)
    back = game.play(rows, np.tile([-1.0, 0.0, 0.0, 0.0, 0.0], (30, 1)))
    assert np.isfinite(back.info["x"]).all()


@pytest.mark.parametrize(
    ("made", "said"),
    [
        (lambda: carom.env.CaromEnv("NineBall"), "game: expected one of"),
        (lambda: carom.env.ThreeCushion(0), "count: expected a whole number >= 1"),
        (lambda: carom.env.ThreeCushion(shots=0), "shots: expected a whole number >= 1"),
        (lambda: carom.env.ThreeCushion(law="mirrow"), "mirror"),
        (lambda: carom.env.two_players("TableTennisReturn"), "a game for two"),
        (lambda: carom.env.ThreeCushion(1).play(np.array([0]), np.zeros((1, 3))), "actions of 5 finite numbers"),
    ],
)
def test_wrong_settings_get_one_line(made: Any, said: str) -> None:
    with pytest.raises(CaromError) as caught:
        made()
    assert said in str(caught.value)


@pytest.mark.parametrize("name", GAMES)
def test_the_last_shot_is_drawn_in_a_picture_of_the_same_size_as_the_table_before_it(name: str) -> None:
    env = gymnasium.make(f"carom/{name}-v0", render_mode="rgb_array", shots=3)
    assert env.metadata["render_fps"] == (60 if name == "AirHockey" else 1)
    env.action_space.seed(2)
    env.reset(seed=1)
    before, same = (env.render() for _ in range(2))
    env.step(env.action_space.sample())
    after = env.render()
    assert before.dtype == np.uint8
    assert before.shape == after.shape == (len(before), 640, 3)
    assert np.array_equal(before, same)
    assert (before != after).any(axis=2).sum() > 100
    many = gymnasium.make_vec(f"carom/{name}-v0", num_envs=2, render_mode="rgb_array", shots=3)
    many.reset(seed=1)
    assert np.array_equal(many.render()[0], before)


def test_a_ball_is_drawn_where_it_lies() -> None:
    env = gymnasium.make("carom/ThreeCushion-v0", render_mode="rgb_array")
    env.reset(seed=1)
    red = (np.abs(env.render()[:, :500].astype(int) - [0xC2, 0x36, 0x16]).max(axis=2) < 12).nonzero()
    felt = (np.abs(env.render()[:, :500].astype(int) - [0xF4, 0xF2, 0xEC]).max(axis=2) < 3).nonzero()
    game = env.unwrapped.game
    for axis, sign in ((1, 1), (0, -1)):
        low, high = felt[axis].min(), felt[axis].max()
        share = (red[axis].mean() - (low + high) / 2) / (high - low)
        assert abs(sign * share - game.places[0, 2, 1 - axis] / (2 * game.size[1 - axis])) < 0.01


def test_other_ways_to_render_are_refused() -> None:
    for make in (carom.env.CaromEnv, carom.env.CaromVectorEnv, carom.env.two_players):
        with pytest.raises(CaromError, match=r"^render_mode: expected ansi or rgb_array, got 'video'$"):
            make("EightBall", render_mode="video")
