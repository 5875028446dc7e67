"""Starts that reach a target: closed forms, gradients against differences, solutions that are run, and what is refused."""

from __future__ import annotations

import html
import json
import math
import shlex
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from reference.sweep_scenes import table_scene

import carom
from carom.simulation.records import BALL, WALL
from carom.sweeps.aiming import Aim, AimProblem, Aims, is_linear, unknowns_of
from carom.sweeps.targets import is_reached, sizes, targets_of

GRAVITY = 9.80665


def bank(law: str = "mirror", resistance: float = 0.0) -> carom.Scene:
    """A rolling ball, another one, and a wall along y."""
    wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), law=law)
    places = {"white": (0.5, 0.0), "red": (0.8, 0.9)}
    balls = [
        carom.SceneBall(radius=0.03, mass=0.2, position=place, name=name, velocity=(0, 0), rolling=True)
        for name, place in places.items()
    ]
    floor = carom.Floor(friction=0.2, rolling_resistance=resistance)
    return carom.Scene(floor=floor, walls=[wall], balls=balls, run=carom.Run(duration=30, max_events=200))


@pytest.mark.slow
def test_a_bank_shot_under_a_law_that_reflects_is_that_of_the_mirrored_ball() -> None:
    scene = bank("two-step-paper")
    best = carom.aim(scene, {"balls.0.velocity": (1.0, 2.0)}, {"hit": "red", "cushions": 1}, starts=2048)
    run = best[0].run
    rows = run.log[np.isin(run.log["kind"], (WALL, BALL))]
    assert rows["kind"][:2].tolist() == [WALL, BALL]
    # full on the ball: the centres lie along the motion
    r, u = rows["x"][2] - rows["x"][1], rows["v_before"][1] - rows["v_before"][2]
    assert abs(r[0] * u[1] - r[1] * u[0]) / np.hypot(*u[:2]) < 1e-3 * 0.06  # a thousandth of what is allowed
    assert best[0].sequence == ("plane 0", "red")
    assert best[0].chance > 0.5


def test_a_ball_that_is_to_stop_at_a_place_has_the_speed_that_rolling_takes() -> None:
    resistance, place = 0.02, (1.7, 0.35)
    scene = bank(resistance=resistance)
    best = carom.aim(scene, {"balls.0.velocity": (0.3, 1.5)}, {"ball": "white", "point": place}, starts=2048)
    way = math.dist(place, (0.5, 0.0))
    straight = next(one for one in best if one.sequence == ())
    # rolling with a resistance c: the speed falls by c g
    assert straight.values["speed"] == pytest.approx(math.sqrt(2 * resistance * GRAVITY * way), rel=1e-6)
    assert straight.values["angle"] == pytest.approx(math.degrees(math.atan2(0.35, 1.2)), abs=1e-5)
    # errors along the way: 2 sigma_v/v of its length; across it: sigma of the angle
    along, across = 2 * 0.03 * way, math.radians(0.2) * way
    found = np.sqrt(np.linalg.eigvalsh(straight.covariance))
    assert found == pytest.approx([across, along], rel=1e-3)
    assert straight.run.final.position[0, :2] == pytest.approx(place, abs=1e-6)


@pytest.mark.parametrize(
    ("reach", "start"),
    [
        ({"hit": ("red", "yellow"), "cushions": 3}, (4.4947, 335.06)),
        ({"ball": 1, "point": (1.0, 0.4)}, (1.26, 26.45)),
        ({"hit": "red", "speed": 1.0, "speed_within": 4.0}, (3.0, 12.0)),
    ],
)
@pytest.mark.slow(keep=1)
def test_the_gradient_of_a_miss_is_that_of_differences(reach: object, start: tuple[float, float]) -> None:
    scene = table_scene(duration=20.0)
    problem = AimProblem(scene, unknowns_of(scene, ["balls.0.velocity"], {}), targets_of(scene, reach))
    x = np.array(start)

    def miss(x: np.ndarray) -> tuple[np.ndarray, np.ndarray, object]:
        run, sequence, found = problem.run_one(x)
        return *problem.miss(run, found, run.sensitivity(problem.paths), x), sequence

    # (a start that reaches the target's event, by way of whatever sequence)
    if not isinstance(reach, dict) or "hit" in reach:
        best = carom.aim(scene, ["balls.0.velocity"], reach, starts=2048, solutions=1)
        x = np.array(list(best[0].values.values())) + 1e-3
    _miss, slopes, sequence = miss(x)
    for k in range(2):
        h = 1e-4 * np.eye(2)[k]
        (above, _d, s1), (below, _e, s2) = miss(x + h), miss(x - h)
        assert s1 == s2 == sequence
        assert slopes[:, k] == pytest.approx((above - below) / 2e-4, rel=1e-4, abs=1e-5 * np.abs(slopes).max())


def test_a_spread_that_gradients_cannot_say_is_a_dash() -> None:
    """As where a start lies close to a graze: huge gradients, and shots that come in all the same."""
    missed = np.array([0.2, 0.5, 0.9, np.inf])
    assert is_linear(np.array([[0.3], [-0.4], [1.0], [30.0]]), missed)
    assert not is_linear(np.array([[30.0], [-40.0], [55.0], [1.0]]), missed)
    assert not is_linear(np.array([[0.1]]), np.array([np.inf]))  # the gradients of an event that no shot comes to
    assert is_linear(
        np.array([[9.0, 0], [0, 11.0]]), np.array([8.0, 12.0])
    )  # a place that is missed by far, as they say
    scene = bank()
    targets = targets_of(scene, {"hit": "red"})
    one = Aim({"speed": 1.0}, 0.73, np.array([2.655]), np.array([[7.05]]), ("red",), 1.0, scene, {})
    unknowns = unknowns_of(scene, ["balls.0.velocity"], {})[:1]
    assert repr(Aims([one], unknowns, targets)).splitlines()[1].split() == ["1", "73%", "2655", "red"]
    said = Aims([replace(one, linear=False)], unknowns, targets)
    row, note = repr(said).splitlines()[1:]
    assert row.split() == ["1", "73%", "–", "red"]
    assert (
        note == said.note == "The player's errors, one standard deviation: speed 3 %."
        " –: the miss is not linear within the player's errors; success, of shots that were run, holds."
    )
    assert html.escape(said.note) in said._repr_html_()


def pool_pair(**run: float) -> carom.Scene:
    """A table with pockets, the cue ball at its centre, and another ball."""
    balls = [
        carom.SceneBall(radius=0.028575, mass=0.17, position=(0, 0), velocity=(1, 0), rolling=True, name="cue"),
        carom.SceneBall(radius=0.028575, mass=0.17, position=(0.9, 0.45), name="one"),
    ]
    floor = carom.Floor(restitution=0.5, friction=0.2, rolling_resistance=0.01, spin_friction=0.044)
    contact = carom.BallContact(restitution=0.95, friction=0.06)
    table = {"shape": "table", "preset": "pool-9ft"}
    return carom.Scene(floor=floor, walls=[table], balls=balls, ball_contact=contact, run=carom.Run(**run))


@pytest.mark.slow
def test_a_ball_in_a_pocket_or_under_way_does_not_end_at_a_place() -> None:
    place = (1.2, 0.58)  # in front of a corner pocket
    best = carom.aim(pool_pair(duration=60), ["balls.0.velocity"], {"point": place, "within": 0.1}, starts=1024)
    for one in best:
        run = one.run
        assert run.final_phase[0] in ("rest", "pivoting")
        assert math.dist(run.final.position[0, :2], place) <= 0.1
    with pytest.raises(carom.CaromError, match=r"the ball still moves when the run ends: a longer run\.duration"):
        carom.aim(pool_pair(duration=1.0), {"balls.0.velocity": (2, 4)}, {"point": (0.5, 0), "within": 2.0}, starts=64)


@pytest.mark.slow
def test_a_solution_is_a_shot_that_counts_and_success_is_of_shots_that_count() -> None:
    """Solutions and success, each told from runs by themselves: pot a ball, and leave the other within a distance of a place."""
    scene, place, within = pool_pair(duration=60), (0.4, 0.1), 0.4

    def counts(run: carom.Trajectory) -> bool:
        apart = math.dist(run.final.position[0, :2], place)
        return run.final_phase[1] == "pocketed" and run.final_phase[0] == "rest" and apart <= within

    reach = [{"ball": "one", "pocket": "any"}, {"ball": "cue", "point": place, "within": within}]
    best = carom.aim(scene, ["balls.0.velocity"], reach, starts=1 << 12, seed=3)
    assert all(counts(one.run) for one in best)
    one = best[0]
    draws = np.random.default_rng(3).normal(size=(200, 2)) * [0.03 * one.values["speed"], 0.2]
    shots = np.array(list(one.values.values())) + draws
    starts = [(v * math.cos(math.radians(a)), v * math.sin(math.radians(a))) for v, a in shots]
    runs = [carom.simulate(carom.replaced(scene, {"balls.0.velocity": start})) for start in starts]
    assert one.chance == pytest.approx(np.mean([counts(run) for run in runs]), abs=0.0051)


def test_within_is_a_distance() -> None:
    (target,) = targets_of(bank(), {"point": (1.0, 0.0), "within": 0.1})
    missed = np.array([[0.8, 0.8], [0.6, -0.6], [1.0, 0.0], [np.inf, np.inf]])
    assert is_reached(target, missed).tolist() == [False, True, True, False]
    assert sizes(target, missed)[0] == pytest.approx(math.hypot(0.8, 0.8))


def test_a_target_that_is_reached_late_is_reached() -> None:
    """After 30 cushions: more events than the coarse sweep looks at."""
    walls = [carom.scene.Plane(point=(x, 0, 0), normal=(-x, 0, 0), law="mirror") for x in (-1.0, 1.0)]
    places = {"white": (0.0, 0.0), "red": (0.0, 6.15)}
    balls = [
        carom.SceneBall(radius=0.05, mass=0.2, position=place, name=name, velocity=(0, 0), rolling=True)
        for name, place in places.items()
    ]
    scene = carom.Scene(floor=carom.Floor(friction=0), walls=walls, balls=balls, run=carom.Run(duration=100))
    targets = targets_of(scene, {"hit": "red"})
    problem = AimProblem(scene, unknowns_of(scene, ["balls.0.velocity"], {}), targets)
    x = np.array([[2.0, math.degrees(math.atan2(6.15, 60 * 0.95))], [2.0, 180.0]])
    assert [event.kind for event in problem.run_one(x[0])[0].events][:31] == ["wall"] * 30 + ["ball"]
    assert problem.run_many(x)[1].tolist() == [False, False]
    assert problem.judge(x)[1].tolist() == [True, False]


def test_a_player_without_errors() -> None:
    best, again = (
        carom.aim(bank(), ["balls.0.velocity"], {"hit": "red"}, errors={"speed": 0, "angle": 0}, starts=256)
        for _ in range(2)
    )
    assert best[0].chance == 1.0
    assert best[0].spread.tolist() == [0.0]
    assert [one.values for one in again] == [one.values for one in best]


def test_three_cushions() -> None:
    scene = table_scene(duration=20.0)
    best = carom.aim(scene, ["balls.0.velocity"], {"hit": ("red", "yellow"), "cushions": 3}, starts=4096, solutions=3)
    assert 1 <= len(best) <= 3
    assert [one.chance for one in best] == sorted((one.chance for one in best), reverse=True)
    for one in best:
        rows = one.run.log
        mine = rows[(rows["ball"] == 0) & np.isin(rows["kind"], (WALL, BALL))]
        hits = [int(np.flatnonzero((mine["kind"] == BALL) & (mine["other"] == k))[0]) for k in (1, 2)]
        assert (mine["kind"][: max(hits)] == WALL).sum() >= 3
    assert "success" in repr(best)


@pytest.mark.slow
def test_a_pocket_and_a_struck_ball() -> None:
    table = {"shape": "table", "preset": "pool-9ft"}
    cue = carom.SceneBall(
        radius=0.028575, mass=0.17, position=(-0.3, 0.1), strike={"speed": 2.0, "azimuth": 0.0}, name="cue"
    )
    one = carom.SceneBall(radius=0.028575, mass=0.17, position=(0.5, 0.3), name="one")
    floor = carom.Floor(restitution=0.5, friction=0.2, rolling_resistance=0.01, spin_friction=0.044)
    contact = carom.BallContact(restitution=0.95, friction=0.06)
    scene = carom.Scene(floor=floor, walls=[table], balls=[cue, one], ball_contact=contact, run=carom.Run(duration=15))
    best = carom.aim(scene, {"balls.cue.strike": (1.0, 3.0)}, {"ball": "one", "pocket": "any"}, starts=4096)
    assert best[0].run.final_phase[1] == "pocketed"
    assert set(best[0].values) == {"speed", "azimuth"}


def test_a_ball_that_is_to_come_with_a_speed() -> None:
    scene = bank("two-step-paper", resistance=0.02)
    reach = {"hit": "red", "cushions": 1, "speed": 0.8}
    best = carom.aim(scene, {"balls.0.velocity": (0.5, 3.0)}, reach, starts=2048)
    run = best[0].run
    row = run.log[run.log["kind"] == BALL][0]
    assert np.hypot(*row["v_before"][:2]) == pytest.approx(0.8, abs=2e-3 * 0.08)  # of what is allowed
    assert best[0].spread.shape == (2,)
    assert " m/s" in best.table().rows[0][3]


def test_bad_input_is_said_at_once() -> None:
    scene = table_scene()
    for free, reach, more, said in [
        (["balls.0.mass"], {"hit": 1}, {}, "expected one ball's velocity"),
        (["balls.*.velocity"], {"hit": 1}, {}, "expected one ball's velocity"),
        (["balls.0.strike"], {"hit": 1}, {}, "aim: free"),
        ({"balls.0.velocity": (2, 1)}, {"hit": 1}, {}, "expected a range"),
        ([], {"hit": 1}, {}, "expected paths"),
        (["balls.0.velocity"], {"hit": "blue"}, {}, "expected a ball of white, yellow, red"),
        (["balls.0.velocity"], {"hit": 0}, {}, "expected balls other than the one that hits them, got white itself"),
        (["balls.0.velocity"], {"pocket": "any"}, {}, "expected a table with pockets, got a scene without"),
        (["balls.0.velocity"], {"hit": 1, "point": (1, 2)}, {}, "expected one of `point`, `pocket` and `hit`"),
        (["balls.0.velocity"], {}, {}, "expected one of `point`, `pocket` and `hit`"),
        (["balls.0.velocity"], {"hit": 1}, {"starts": 0}, "starts: expected a whole number"),
        (["balls.0.velocity"], {"hit": 1}, {"errors": {"sped": 1}}, "expected names of speed"),
    ]:  # fmt: skip
        with pytest.raises(carom.CaromError) as error:
            carom.aim(scene, free, reach, **more)
        assert said in str(error.value)
    with pytest.raises(carom.CaromError) as error:
        carom.aim(scene, ["balls.0.mass"], {"hit": "blue"}, starts=0)
    assert len(error.value.faults) == 3
    with pytest.raises(carom.CaromError, match="free more numbers"):
        carom.aim(scene, ["balls.0.velocity"], {"hit": (1, 2), "cushions": 30}, starts=64)


@pytest.mark.parametrize(
    ("reach", "said"),
    [
        *[({"point": (1, 0), "within": bad}, "within: expected a length in m, > 0, got ") for bad in (-1, 0, math.nan, True)],
        *[({"point": bad}, "point") for bad in ((math.nan, 0), (1,), 5, "1,0", (True, 0))],
        *[({"hit": bad}, "hit: expected a ball") for bad in (True, -1, 7, 1.0, "", "blue", (), (True,), [[1]], {"red": 1})],
        *[({"ball": bad, "hit": 1}, "ball: expected a ball of white, red") for bad in (False, -1, None, 0.0, [0])],
        *[({"hit": 1, "cushions": bad}, "cushions: expected a whole number >= 0") for bad in (-1, True, 1.5, "2", None)],
        *[({"hit": 1, "speed": bad}, "speed: expected a number > 0") for bad in (0, math.nan, math.inf, True)],
        *[({"hit": 1, "speed": 1, "speed_within": bad}, "speed_within: expected a number > 0") for bad in (0, math.nan)],
        *[({"pocket": bad}, "pocket: expected text") for bad in (3, True, b"any")],
        ({"hit": (1, "red")}, "hit: expected each ball once, got red, red"),
        ({"hit": 1, "within": 0.1}, "expected within with point only, got within = 0.1 with hit"),
        ({"hit": 1, "speed_within": 0.1}, "expected speed_within with speed only"),
        ({"point": (1, 0), "cushions": 1}, "expected cushions with hit only"),
        *[(bad, "expected a target such as") for bad in (5, None, "red", [], [[]], {1: 2}, np.array(3))],
    ],
)  # fmt: skip
def test_a_wrong_target_is_one_line(reach: object, said: str) -> None:
    with pytest.raises(carom.CaromError) as error:
        carom.aim(bank(), ["balls.0.velocity"], reach)
    assert str(error.value).startswith("aim: reach: ")
    assert said in str(error.value)
    assert len(str(error.value).splitlines()) == 1


@pytest.mark.parametrize(
    "settings",
    [
        *[{"errors": {"angle": bad}} for bad in (-1, math.nan, math.inf, True, "x", None)],
        {"errors": 5}, {"errors": {3: 1}}, {"seed": -1}, {"starts": 10**12}, {"starts": True}, {"solutions": 1.5},
        *[{"free": bad} for bad in (5, None, ["balls.0.velocity", "balls.white.velocity"], ["balls.0.spin_z"] * 2, [3])],
        *[{"free": {"balls.0.velocity": bad}} for bad in (5, "ab", (1, 2, 3), (True, 2), (0, 1), (1, math.inf), None)],
    ],
)  # fmt: skip
def test_a_wrong_setting_is_one_line(settings: dict[str, object]) -> None:
    given = {"free": ["balls.0.velocity"], **settings}
    with pytest.raises(carom.CaromError, match=rf"^aim: {next(iter(settings))}: .*expected .*, got ") as error:
        carom.aim(bank(), reach={"hit": 1}, **given)  # type: ignore[arg-type]
    assert len(str(error.value).splitlines()) == 1


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ("--point 0,0 --within -1", "aim: reach: within: expected a length in m, > 0, got -1.0"),
        ("--point 0,0 --within nan", "aim: reach: within: expected a length in m, > 0, got nan"),
        ("--point nan,0", "aim: reach: point[0]: expected a length in m, got nan"),
        ("--hit red --within 0.1", "aim: reach: expected within with point only, got within = 0.1 with hit"),
        ("--hit red --pocket any", "aim: reach: expected one of `point`, `pocket` and `hit`, got pocket, hit"),
        ("", "aim: reach: expected one of `point`, `pocket` and `hit`, got none of them"),
        ("--hit red --error angle=nan", "aim: errors: angle: expected a number >= 0, got nan"),
    ],
)
def test_the_command_refuses_as_the_library_does(tmp_path: Path, options: str, said: str) -> None:
    from typer.testing import CliRunner

    from carom.cli import app

    carom.save_scene(bank(), tmp_path / "scene.toml")
    done = CliRunner().invoke(app, ["aim", str(tmp_path / "scene.toml"), *options.split()])
    assert isinstance(done.exception, carom.CaromError)
    assert done.exception.faults == (said,)


def test_the_command_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from typer.testing import CliRunner

    from carom.cli import app

    file = tmp_path / "scene.toml"
    balls = "".join(
        f'[[balls]]\nname = "{name}"\nradius = 0.03075\nmass = 0.21\nposition = [{x}, {y}]\n{more}'
        for name, x, y, more in [("white", -0.7, -0.3, "velocity = [1, 0]\nrolling = true\n"), ("red", 0.7, 0.1, "")]
    )
    file.write_text(
        f'[floor]\nfriction = 0.2\nrolling_resistance = 0.01\n[[walls]]\nshape = "table"\npreset = "carom"\n{balls}'
    )
    words = ["aim", str(file), "--hit", "red", "--cushions", "1", "--starts", "1024", "--solutions", "2"]
    done = CliRunner().invoke(app, [*words, "--json", "--plot", str(tmp_path / "aim.svg")])
    assert done.exit_code == 0, done.output
    monkeypatch.setattr("carom.plot.trajectory.DRAWN", 0)
    more = CliRunner().invoke(app, [*words, "--json", "--plot", str(tmp_path / "more.svg")])
    assert f"note: the figure has the first 0 of the {len(json.loads(more.stdout))} shots" in more.stderr
    assert (tmp_path / "aim.svg").stat().st_size > 5000
    rows = json.loads(done.stdout)
    assert 1 <= len(rows) <= 2
    assert "note: the figure has" not in done.stderr
    assert {"speed", "angle", "success", "spread_m", "sequence"} <= set(rows[0])
    refused = CliRunner().invoke(app, ["aim", str(file), "--hit", "white,red"])
    assert str(refused.exception) == "--hit: expected a ball, got 'white,red'; several are --hit white --hit red"


def struck_pair(name: str) -> str:
    """A scene file: a ball that is struck, and another of that name."""
    return (
        "[floor]\nfriction = 0.2\nrolling_resistance = 0.01\n"
        "[[balls]]\nname = 'cue'\nradius = 0.03\nmass = 0.2\nposition = [0, 0]\nstrike = {speed = 1.0, azimuth = 3.0}\n"
        f"[[balls]]\nname = '{name}'\nradius = 0.03\nmass = 0.2\nposition = [0.7, 0.1]\n"
    )


def test_a_struck_ball_is_aimed_by_its_strike_and_a_name_of_digits_is_a_name(tmp_path: Path) -> None:
    from typer.testing import CliRunner

    from carom.cli import app

    (tmp_path / "scene.toml").write_text(struck_pair("8"))
    done = CliRunner().invoke(app, ["aim", str(tmp_path / "scene.toml"), "--hit", "8", "--starts", "256", "--json"])
    assert done.exit_code == 0, done.output
    assert json.loads(done.stdout)[0]["azimuth"] == pytest.approx(math.degrees(math.atan2(0.1, 0.7)), abs=2)
    done = CliRunner().invoke(app, ["aim", str(tmp_path / "scene.toml"), "--hit", "8", "--starts", "256"])
    (line,) = [line for line in done.stdout.splitlines() if line.startswith("The first one: carom simulate ")]
    played = CliRunner().invoke(app, [*shlex.split(line)[4:], "--json"])
    best = carom.aim(
        carom.load_scene(tmp_path / "scene.toml"), ["balls.cue.strike"], {"ball": 0, "hit": "8"}, starts=256
    )[0]
    assert json.loads(played.stdout)["final"][1]["position"] == best.run.final.position[1].tolist()
    scene = carom.load_scene(tmp_path / "scene.toml")
    assert carom.scene.toml.path_match(scene, "balls.8.mass").places == (("balls", 1, "mass"),)


def test_a_pocket_of_another_name_is_refused_with_the_nearest() -> None:
    with pytest.raises(carom.CaromError, match="did you mean 'top left pocket'"):
        carom.aim(carom.load_scene("pool-9ft"), ["balls.0.velocity"], {"pocket": "top left"})


def test_a_speed_below_zero_is_one_clear_line() -> None:
    with pytest.raises(carom.CaromError, match=r"aim: reach: speed: expected a number > 0, got -1"):
        carom.aim(bank(), ["balls.0.velocity"], {"hit": 1, "speed": -1})


def test_a_place_beside_the_table_is_refused_before_anything_is_run() -> None:
    with pytest.raises(
        carom.CaromError, match=r"point: expected a place on the table, 2.54 m by 1.27 m around \(0.0, 0.0\)"
    ):
        carom.aim(pool_pair(), ["balls.0.velocity"], {"point": (1.3, 0.0)}, starts=64)
