"""Laws that a trajectory violates: runs of carom violate none; each violation that is put into motions by hand is found, alone."""

from __future__ import annotations

import json
import math
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from reference import judged_runs
from typer.testing import CliRunner

import carom
from carom.cli import app
from carom.errors import CaromError
from carom.tracks import Track, judge, judgement, read, verdicts
from carom.tracks.verdicts import by_film_laws

R, M, G = 0.03, 0.2, 9.80665
TIMES = np.arange(60) / 200


def parabola(t: Any, x: Any, v: Any, a: Any) -> Any:
    return np.add.outer(np.zeros_like(t), x) + np.multiply.outer(t, v) + np.multiply.outer(t * t / 2, a)


def two_balls(
    *,
    after: tuple[Any, Any],
    spin_after: Any = (0, 0, 0),
    noise: float = 0.0,
    seed: int = 1,
    t: Any = TIMES,
) -> dict[str, Any]:
    """One ball slides without friction to another at rest, and both go on with given velocities from 0.1037 s on."""
    at = 0.1037
    rng = np.random.default_rng(seed)
    rows: dict[str, list[Any]] = {name: [] for name in ("t", "ball", "x", "y", "z", "wx", "wy", "wz")}
    for name, x, before, then in (
        ("a", (0, 0, R), (1, 0, 0), after[0]),
        ("b", (at + 2 * R, 0, R), (0, 0, 0), after[1]),
    ):
        met = np.add(x, np.multiply(at, before))
        path = np.where((t < at)[:, None], parabola(t, x, before, (0, 0, 0)), parabola(t - at, met, then, (0, 0, 0)))
        path = path + noise * rng.normal(size=path.shape)
        w = np.where((t < at)[:, None], (0, 0, 0), spin_after)
        for values, column in ((t, "t"), (np.full(len(t), name), "ball"), *zip(path.T, "xyz", strict=True)):
            rows[column].extend(values.tolist())
        for values, axis in zip(w.T, "xyz", strict=True):
            rows[f"w{axis}"].extend(values.tolist())
    return rows


def laws_of(found: Any) -> dict[str, int]:
    return {law: len(found.of(law)) for law in found.checked if found.of(law)}


@pytest.mark.parametrize("scene", ["pool-9ft", "carom"])
@pytest.mark.parametrize("rate", [60, 240])
def test_runs_of_carom_violate_nothing(scene: str, rate: float, tmp_path: Path) -> None:
    run = carom.simulate(carom.new_scene(scene), duration=4)
    found = judge(run.save_frames(tmp_path / "run.csv", rate))
    assert found.violations == []
    assert found.checked["energy"] > 5
    assert found.checked["slip"] > 8
    assert found.noise < 1e-14


@pytest.mark.parametrize(
    ("kind", "seed", "noise"),
    [
        *(("rack", seed, 1e-4) for seed in (1009, 1030, 1039, 2012, 2041)),  # blows passed on; paths that are none; hops
        *(("frozen", seed, 1e-4) for seed in (1042, 2007)),  # beside a cushion
        ("table", 2113, 1e-4), ("air", 1036, 1e-4), ("leaning", 2048, 0.0),  # low flights
        ("rack", 3078, 1e-4),  # the deepest of many frames
    ],
)  # fmt: skip
def test_runs_with_noise_are_not_blamed(kind: str, seed: int, noise: float) -> None:
    assert judged_runs.judged(kind, seed, noise).violations == []


@pytest.mark.parametrize("rate", [24.7, 30, 119.88, 240])
def test_rounded_times_are_known_no_better_than_their_clock(rate: float) -> None:
    for k in range(4):
        t = (np.arange(60) + k / 5) / rate
        for g, blamed in ((G, False), (0.9 * G, True)):
            x = parabola(t, (0, 0, 40.0), (0.3, 0, 0), (0, 0, -g)).round(6)
            found = judge({"t": t.round(3), "x": x[:, 0], "y": x[:, 1], "z": x[:, 2]}, radius=R)
            assert found.checked["gravity"] > 0
            assert bool(found.of("gravity")) == blamed, (k, found.notes, found.of("gravity"))


@pytest.mark.parametrize("kind", judged_runs.KINDS)
def test_drawn_runs_of_carom_violate_nothing(kind: str) -> None:
    """On slopes, among cushions, struck while frozen to one, in the air, from racks; at four frame rates."""
    for seed in range(8):
        assert judged_runs.judged(kind, seed).violations == []


@pytest.mark.parametrize("noise", [0.0, 1e-4, 1e-3])
def test_balls_that_bounce_are_blamed_for_what_is_wrong_alone(noise: float) -> None:
    # (in runs 4, 11 and 29 four frames lie on both sides of a bounce alike, and have no third difference)
    right = [judged_runs.faulty("none", 0.0, seed, noise) for seed in (4, 11, 17, 22, 29, 30)]
    assert [one.violations for one in right] == [[]] * 6
    assert judged_runs.faulty("gravity", 0.1, 1, noise).of("gravity") or noise == 1e-3
    if noise < 1e-3:
        for fault, size, law in (("restitution", 1.05, "energy"), ("energy", 0.05, "energy"), ("kink", 0.2, "turn")):
            assert [one.law for one in judged_runs.faulty(fault, size, 1, noise).violations][:1] == [law]


@pytest.mark.parametrize("friction", [0.0, 0.7])
def test_a_ball_in_the_air_turns_at_a_wall_that_no_ball_was_behind(friction: float) -> None:
    """A ball between two tilted walls without a floor's bounce; one of another ball, far behind a wall, and the wall is none."""
    n, rng = np.array([-0.8, 0.36, 0.48]), np.random.default_rng(2)
    t, at, place = np.arange(80) / 200, 0.2037, np.array([0.5, 0.2, 1.0])
    v = np.array([2.0, 0.3, 0.4])
    aside = np.cross(n, rng.normal(size=3))
    u = v - 1.8 * (v @ n) * (n + friction * aside / np.linalg.norm(aside))
    pull = np.array([0.0, 0.0, -G])
    path = np.where((t < at)[:, None], parabola(t - at, place, v, pull), parabola(t - at, place, u, pull))
    for behind, obstacles, blamed in ((0.0, False, False), (0.9, False, True), (0.9, True, False)):
        other = place - behind * n + [0, 0, 0] if behind else place + n
        both = np.concatenate([path, np.tile(other, (80, 1))])
        rows = {"t": np.tile(t, 2), "ball": np.repeat(["a", "b"], 80), **dict(zip("xyz", both.T, strict=True))}
        found = judge(rows, radius=R, obstacles=obstacles)
        assert bool(found.of("turn")) is blamed
        assert found.checked["turn"] == (0 if obstacles else 1)


@pytest.mark.parametrize("sign", [1, -1])
def test_momentum_may_come_from_a_cushion_only_if_no_ball_was_ever_behind_it(sign: int) -> None:
    rows = two_balls(after=((0.0, 0.3 * sign, 0), (1.0, 0.3 * sign, 0)))
    third = {"t": TIMES, "ball": ["c"] * 60, "x": [0.3] * 60, "y": [0.3] * 60, "z": [R] * 60}
    rows = {name: [*values, *third.get(name, [0.0] * 60)] for name, values in rows.items()}
    assert ("momentum" in laws_of(judge(rows, radius=R))) == (sign < 0)


@pytest.mark.parametrize("noise", [0.0, 2e-5])
@pytest.mark.parametrize(
    ("after", "laws"),
    [
        (((0.03, 0, 0), (0.97, 0, 0)), set()),
        (((0.0, 0, 0), (1.0, 0, 0)), set()),
        (((0.1, 0, 0), (1.2, 0, 0)), {"momentum", "energy"}),
        (((-0.2, 0, 0), (1.2, 0, 0)), {"energy"}),
        (((0.2, 0, 0), (0.2, 0, 0)), {"momentum"}),
        (((0.4, 0.4, 0), (0.6, -0.4, 0)), set()),  # friction 0.67, possible
    ],
)
def test_contacts_of_two_balls(after: Any, laws: set[str], noise: float) -> None:
    found = judge(two_balls(after=after, noise=noise))
    assert set(laws_of(found)) == laws
    assert found.checked["momentum"] == 1
    assert found.noise == pytest.approx(noise, rel=0.2, abs=1e-12)
    if "energy" in laws:
        gained = M * (np.square(after).sum() - 1) / 2
        one = judge(two_balls(after=after, noise=noise), mass=M).worst("energy")
        assert one is not None
        assert one.size == pytest.approx(gained, abs=4 * one.error + 1e-9)
        assert one.balls == ("a", "b")


@pytest.mark.parametrize("noise", [0.0, 2e-5])
def test_contacts_far_from_each_other_at_the_same_time_are_each_judged_alone(noise: float) -> None:
    """What one pair loses of its momentum another one gains, a metre beside it."""
    one = two_balls(after=((0.1, 0, 0), (0.7, 0, 0)), noise=noise)
    two = two_balls(after=((0.3, 0, 0), (0.9, 0, 0)), noise=noise, seed=2)
    two |= {"ball": [name + name for name in two["ball"]], "y": [y + 1 for y in two["y"]]}
    found = judge({name: one[name] + two[name] for name in one}, radius=R, mass=M)
    assert sorted(one.balls for one in found.of("momentum")) == [("a", "b"), ("aa", "bb")]


@pytest.mark.parametrize("gaps", [False, True])
@pytest.mark.parametrize("decimals", [2, 3, 4, 6])
def test_rounded_times_hide_nothing(decimals: int, gaps: bool) -> None:
    """As found with exact times, at 240 frames a second: rows that share a time, rounding of an eighth of a frame, gaps."""
    t = np.delete(np.arange(60), [7, 8, 34, 35, 41] if gaps and decimals > 2 else []) / 240
    rows = two_balls(after=((0.1, 0, 0), (1.2, 0, 0)), t=t)
    expected, found = judge(rows, radius=R), judge(dict(rows, t=np.round(rows["t"], decimals)), radius=R)
    assert laws_of(found) == laws_of(expected) == {"momentum": 1, "energy": 1}
    for one, other in zip(found.violations, expected.violations, strict=True):
        assert one.size == pytest.approx(other.size, rel=5e-3)


def test_uneven_times_of_a_program_are_its_own() -> None:
    t = np.arange(60) / 200 + 4e-4 * np.random.default_rng(1).uniform(-1, 1, 60)
    found = judge(two_balls(after=((0.1, 0, 0), (1.2, 0, 0)), t=t), radius=R)
    assert laws_of(found) == {"momentum": 1, "energy": 1}
    assert found.of("momentum")[0].size == pytest.approx(0.3 * 0.17, rel=1e-6)


def test_friction_of_two_balls() -> None:
    columns = two_balls(after=((0.4, 0.4, 0), (0.6, -0.4, 0)))
    assert judge(columns, friction=0.67).violations == []
    assert laws_of(judge(columns, friction=0.6)) == {"friction": 1}
    assert judge(columns, friction=0.6).violations[0].size == pytest.approx(2 / 3 - 0.6, abs=1e-9)


def test_error_bars_are_those_of_many_films() -> None:
    """The momentum that appears, over its error bar, scatters by one."""
    pulls = []
    for seed in range(150):
        found = judge(two_balls(after=((0.1, 0, 0), (1.2, 0, 0)), noise=2e-5, seed=seed), mass=M, noise=2e-5)
        worst = found.worst("momentum")
        if worst is not None:
            pulls.append((worst.size - 0.3 * M) / worst.error)
    assert len(pulls) > 140
    assert 0.75 < np.std(pulls) < 1.25
    assert abs(np.mean(pulls)) < 0.3


def test_a_ball_in_the_air_falls_freely() -> None:
    t = np.arange(40) / 100
    for g, wrong in ((G, False), (9.0, True)):
        x = parabola(t, (0, 0, 1.0), (1, 0, 0), (0, 0, -g))
        found = judge({"t": t, "x": x[:, 0], "y": x[:, 1], "z": x[:, 2]}, radius=R)
        assert laws_of(found) == ({"gravity": 1} if wrong else {})
        if wrong:
            assert found.violations[0].size == pytest.approx(G - 9, rel=1e-9)


@pytest.mark.parametrize(
    ("a", "spin", "change", "law"),
    [
        (-2.0, 0.0, 2.0 / (0.4 * R), None),  # slides, and friction turns it
        (2.0, 0.0, 0.0, "slip"),  # pushed along its slip
        (-12.0, 0.0, 0.0, "friction"),
        (-0.1, 1.0 / R, -0.1 / R, None),  # rolls
        (-0.1, 1.0 / R, 3.0 / R, "slip"),  # rolls, and begins to slip
    ],
)
def test_on_the_floor(a: float, spin: float, change: float, law: str | None) -> None:
    t = np.arange(12) / 100
    x = parabola(t, (0, 0, R), (1, 0, 0), (a, 0, 0))
    columns = {"t": t, "x": x[:, 0], "y": x[:, 1], "z": x[:, 2], "wx": 0 * t, "wy": spin + change * t, "wz": 0 * t}
    assert set(laws_of(judge(columns))) == ({law} if law else set())


def test_balls_in_each_other_and_in_the_floor() -> None:
    t = np.tile(np.arange(6) / 100, 2)
    columns = {
        "t": t,
        "ball": np.repeat(["a", "b"], 6),
        "x": np.repeat([0.0, 0.055], 6),
        "y": 0 * t,
        "z": np.repeat([R, 0.02], 6),
    }
    found = judge(columns, radius=R)
    assert [(one.balls, round(one.size, 4)) for one in found.of("penetration")] == [
        (("b",), 0.01),
        (("a", "b"), 0.0041),
    ]


@pytest.mark.parametrize("name", ["t", "y", "z", "wy"])
@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_a_row_without_a_number_hides_nothing(name: str, value: float) -> None:
    rows = two_balls(after=((0.1, 0, 0), (1.2, 0, 0)))
    rows["z"][90] = 0.02  # in the floor
    expected = judge(rows, radius=R)
    rows[name][100] = value
    found = judge(rows, radius=R)
    assert laws_of(found) == laws_of(expected) == {"penetration": 1, "energy": 1, "momentum": 1}
    assert math.isfinite(found.noise)
    assert [note for note in found.notes if "left out" in note] == (
        [] if name == "wy" else ["1 row without a time and a place in finite numbers left out"]
    )


@pytest.mark.parametrize(
    ("columns", "settings", "said"),
    [
        (
            {"t": [0.0], "y": [0.0]},
            {},
            "judge: expected columns t, x and y, in s and m, a row per ball and frame, or tracks of a program",
        ),
        ({"t": [0.0], "x": [0.0], "y": [0.0]}, {}, "judge: expected more than 4 frames of a ball"),
        ({"t": [0.0] * 9, "x": [0.0] * 9, "y": [0.0] * 9}, {}, "expected one row per frame, got two of the same time"),
        ({"t": [0.0], "x": ["far"], "y": [0.0]}, {}, "judge: x: expected numbers, got 'far'"),
        ({"t": [0.0, 1.0], "x": [0.0, 1.0], "y": ["0", "far"]}, {}, "judge: y: expected numbers, got 'far'"),
        ({"t": [0.0], "x": [1e200], "y": [0.0]}, {}, "judge: x: expected numbers up to 1e+30, got 1e+200"),
        ({"t": [0.0], "x": [0.0], "y": [0.0], "radius": [math.nan]}, {}, "radius: expected numbers > 0, got nan"),
        ({"t": [0.0], "x": [0.0], "y": [0.0], "mass": [0.0]}, {}, "mass: expected numbers > 0, got 0"),
        (
            {"t": range(9), "x": [0] * 9, "y": [0] * 9, "z": [0] * 9},
            {},
            "the radius of the ball, got none, and a least",
        ),
        ({"t": [0.0], "x": [0.0], "y": [0.0]}, {"mass": -1.0}, "judge: mass: expected a number > 0, got -1"),
    ],
)
def test_what_cannot_be_judged(columns: dict[str, Any], settings: dict[str, float], said: str) -> None:
    with pytest.raises(CaromError) as caught:
        judge(columns, **settings)
    assert said in str(caught.value)
    assert len(caught.value.faults) == 1


@pytest.mark.parametrize("suffix", [".csv", ".json"])
def test_a_tilted_floor(suffix: str, tmp_path: Path) -> None:
    """A ball that slides and rolls across a slope violates nothing on it, and on a level floor it does not fall freely."""
    floor = carom.Floor(friction=0.2, restitution=0.5, rolling_resistance=0.01, slope=(0.02, -0.01))
    balls = [
        carom.SceneBall(radius=R, mass=M, position=(0, 0), velocity=(1.0, 0.4)),
        carom.SceneBall(radius=R, mass=M, position=(1.0, 1.0, 0.2), velocity=(0.3, 0.0, 0.0)),
    ]
    run = carom.simulate(carom.Scene(floor=floor, balls=balls, run=carom.Run(duration=2)))
    file = run.save_frames(tmp_path / f"run{suffix}", 240)
    assert judge(file, slope=(0.02, -0.01)).violations == []
    assert laws_of(judge(file))["gravity"] > 3
    said = CliRunner().invoke(app, ["judge", str(file), "--slope", "0.02,-0.01"])
    assert said.stdout.splitlines()[-1] == "checked 5 of 7 laws: no violation in them"


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("scene.toml", "[floor]\nfriction = 0.2\n", "expected columns t, x and y"),
        ("run.json", '{"t": [0, 1], "balls": []}', "as frames are saved, got JSON without 'position'"),
        ("run.json", "t,x\n", "with t, balls and position as frames are saved, got text that is no JSON in line 1"),
        ("run.json", '{"t": [0], "balls": [1], "position": [[[1]]]}', "as frames are saved, got JSON of another form"),
    ],
)
def test_files_that_are_no_trajectory_get_one_line(name: str, text: str, said: str, tmp_path: Path) -> None:
    (tmp_path / name).write_text(text)
    with pytest.raises(CaromError) as caught:
        judge(tmp_path / name)
    assert said in str(caught.value)
    assert len(caught.value.faults) == 1


def test_headers_with_units_and_files_of_tracker_are_judged_as_columns_in_metres(tmp_path: Path) -> None:
    rows = two_balls(after=((0.1, 0, 0), (1.2, 0, 0)))
    t, x, y, balls = (rows[name] for name in ("t", "x", "y", "ball"))
    plain = judge({"t": t, "x": x, "y": y, "ball": balls}, radius=R)
    (tmp_path / "units.csv").write_text(
        "t [ms],x [cm],y [cm],ball\n"
        + "".join(f"{1e3 * a!r},{100 * b!r},{100 * c!r},{d}\n" for a, b, c, d in zip(t, x, y, balls, strict=True))
    )
    units = judge(tmp_path / "units.csv", radius=R)
    assert (
        [(one.law, one.balls) for one in units.violations] == [(one.law, one.balls) for one in plain.violations] != []
    )
    assert units.violations[0].time == pytest.approx(plain.violations[0].time, abs=1e-9)
    alone = [k for k, ball in enumerate(balls) if ball == balls[0]]
    text = "mass_A\nt,x,y\n" + "".join(f"{t[k]!r},{x[k]!r},{y[k]!r}\n" for k in alone)
    (tmp_path / "tracker.txt").write_text(text)
    assert judge(tmp_path / "tracker.txt", radius=R).checked["friction"] > 0


def test_the_command_prints_the_table(tmp_path: Path) -> None:
    rows = two_balls(after=((0.1, 0, 0), (1.2, 0, 0)))
    file = tmp_path / "run.csv"
    file.write_text(
        "\n".join([",".join(rows), *(",".join(map(str, row)) for row in zip(*rows.values(), strict=True))]) + "\n"
    )
    said = CliRunner().invoke(app, ["judge", str(file), "--mass", "200g"])
    assert said.exit_code == 0
    assert "2 violations" in said.output
    assert "45 % more energy" in said.output
    found = CliRunner().invoke(app, ["judge", str(file), "--json", "--strict"])
    assert found.exit_code == 1
    assert [one["law"] for one in json.loads(found.stdout)["violations"]] == ["energy", "momentum"]
    assert set(json.loads(found.stdout)["unchecked"]) == {"gravity", "turn"}


def test_the_picture_has_a_strip_for_each_law_that_is_violated(tmp_path):
    pytest.importorskip("matplotlib")
    rows = two_balls(after=((0.2, 0, 0), (0.9, 0, 0)), noise=1e-4)
    rows["ball"] = np.where(np.array(rows["ball"]) == "a", 1.0, 2.0)
    found = judge(rows, radius=R)
    figure = carom.plot.plot_judgement(found)
    strips = {axes.get_title(loc="left").partition(":")[0]: axes for axes in figure.axes}
    assert set(strips) == {one.law for one in found.violations}
    dots = [axes.lines[0].get_xydata() for axes in strips.values()]
    drawn = sorted(tuple(dot) for strip in dots for dot in strip)
    assert drawn == sorted((one.time, one.size * {"penetration": 1e3}.get(one.law, 1.0)) for one in found.violations)
    assert any(text.get_text() == "2 and 1" for text in strips["momentum"].texts)
    file, picture = tmp_path / "two.csv", tmp_path / "two.svg"
    file.write_text("t,x,y\n" + "".join(f"{t},{t},0\n" for t in np.arange(20) / 100))
    got = CliRunner().invoke(app, ["judge", str(file), "--radius", "0.03", "--plot", str(picture)])
    assert got.exit_code == 0, got.output
    assert picture.stat().st_size > 1000
    got = CliRunner().invoke(app, ["judge", str(file), "--plot", str(tmp_path / "two.docx")])
    assert "--plot" in str(got.exception)
    assert ".svg, .pdf or .png" in str(got.exception)


def test_balls_of_many_names_are_judged_as_few_are() -> None:
    """3,000 balls of a frame each beside two that meet: pairs are not compared one by one; overlaps are found."""
    rows = two_balls(after=((0.1, 0, 0), (1.2, 0, 0)))
    for name in rows:
        extra = {
            "ball": [f"c{k}" for k in range(3000)],
            "t": [0.1] * 3000,
            "z": [R] * 3000,
            "x": [10 + k for k in range(3000)],
        }
        rows[name] = [*rows[name], *extra.get(name, [0.0] * 3000)]
    rows["x"][-1] = 10.02  # the last is in the first
    found = judge(rows)
    assert laws_of(found) == {"momentum": 1, "energy": 1, "penetration": 1}
    assert found.of("penetration")[0].balls == ("c0", "c2999")
    assert found.of("penetration")[0].size == pytest.approx(2 * R - 0.02)
    assert found.checked["penetration"] == 3002 + 3002 * 3001 // 2


def bouncing(pull: float = G, restitution: float = 0.8, count: int = 240, rate: int = 200) -> tuple[Any, Any]:
    """Heights of a ball that bounces on the floor, from 1 m, in 240 frames of 5 ms; the last bounce may add speed."""
    t, z, v, at = np.arange(count) / rate, 1.0, 0.0, 0.0
    heights = []
    for now in t:
        while (late := at + (v + math.sqrt(v * v + 2 * pull * (z - R))) / pull) < now:
            v, z, at = restitution * math.sqrt(v * v + 2 * pull * (z - R)), R, late
        heights.append(z + v * (now - at) - pull / 2 * (now - at) ** 2)
    return t, np.array(heights)


def test_heights_in_a_table_of_two_columns_are_read_as_fits_read_them() -> None:
    """The second column is a height where the ball falls: judged as with a column z; on a slope it is a place on the floor."""
    for restitution in (0.8, 1.3):  # (beyond what an unknown spin may hold)
        t, z = bouncing(restitution=restitution)
        with_z = judge({"t": t, "x": 0.3 * t, "y": 0 * t, "z": z - z.min() + R}, radius=R)
        without = judge({"t": t, "x": 0.3 * t, "y": z}, radius=R)
        assert without.checked == with_z.checked | {"penetration": 0}  # (there the floor is where the ball is lowest)
        assert laws_of(without) == laws_of(with_z)
        assert [one.size for one in without.violations] == pytest.approx(
            [one.size for one in with_z.violations], rel=1e-9
        )
        assert without.checked["gravity"] >= 2
        assert any(note.startswith("seen from the side (") for note in without.notes)
    assert laws_of(without) == {"energy": len(without.of("energy"))} != {}
    sloped = judge({"t": t[:60], "x": 0.3 * t[:60], "y": z[:60]}, radius=R, slope=(0.0, -0.3))
    assert sloped.checked["gravity"] == 0


def test_a_rate_and_a_scale_hold_for_tables_as_for_tracks(tmp_path: Path) -> None:
    """Times of a film that is played at a quarter of its speed, lengths in cm: judged as the motion itself once both are given."""
    t, z = bouncing(restitution=0.8)
    truth = judge({"t": t, "x": 0.3 * t, "y": z}, radius=R)
    rate = 1 / float(t[1] - t[0])
    slow = {"t": 4 * t, "x": 100 * 0.3 * t, "y": 100 * z}
    assert laws_of(judge({"t": 4 * t, "x": 0.3 * t, "y": z}, radius=R))["gravity"] > 0
    rows = "".join(f"{a!r},{b!r},{c!r}\n" for a, b, c in zip(*(slow[name].tolist() for name in "txy"), strict=True))
    (tmp_path / "slow.csv").write_text(f"t,x,y\n{rows}")
    (tmp_path / "headed.csv").write_text(f"t [s],x,y\n{rows}")
    for table in (slow, tmp_path / "slow.csv", tmp_path / "headed.csv"):
        found = judge(table, radius=R, scale=0.01, rate=rate)
        assert found.checked == truth.checked
        assert laws_of(found) == {}
        assert found.noise == pytest.approx(truth.noise, rel=1e-3, abs=1e-13)


def test_the_readout_of_a_camera_holds_for_tables_of_all_forms(tmp_path: Path) -> None:
    """Rows read one after the other: by their own times a flight is a parabola to rounding, by the stamps it is none."""
    t, _z = bouncing(restitution=0.8)
    v, readout, high = 1.0, 0.03, 0.5
    t = t[:60]
    late = t.copy()
    for _ in range(60):  # (when its row is read, a ball that is lower is seen later)
        z = 0.4 + v * late - G / 2 * late**2
        late = t - readout * z / high
    film = {"readout": readout, "picture_height": high}
    rows = "".join(
        f"{a!r},{b!r},{c!r}\n" for a, b, c in zip(t.tolist(), (0.3 * late).tolist(), z.tolist(), strict=True)
    )
    (tmp_path / "plain.csv").write_text(f"t,x,y\n{rows}")
    (tmp_path / "headed.csv").write_text(f"t [s],x [m],y [m]\n{rows}")
    for table in ({"t": t, "x": 0.3 * late, "y": z}, tmp_path / "plain.csv", tmp_path / "headed.csv"):
        found = judge(table, radius=R, film=film)
        assert laws_of(found) == {}
        assert found.checked["gravity"] > 0
        assert found.noise < 1e-13
        assert judge(table, radius=R).noise > 1e-8
    with pytest.raises(CaromError, match="`picture_height`: expected the height of the picture"):
        judge(tmp_path / "plain.csv", radius=R, film={"readout": readout})


def test_settings_of_pictures_are_refused_for_tables() -> None:
    t, z = bouncing(restitution=0.8)
    with pytest.raises(CaromError) as caught:
        judge({"t": t, "x": t, "y": z}, scale="gravity", film={"region": "0,0,9,9", "start": 1.0, "picture_height": 1})
    names = [said.split(":")[1].strip() for said in caught.value.faults]
    assert names == ["`scale`", "`region`", "`start`", "`picture_height`"]


@pytest.fixture
def filmed(monkeypatch: pytest.MonkeyPatch) -> Any:
    """Films whose ball carom has tracked, and followed as most likely a ball: their pixels, and their metres by a radius."""

    def judged(path: Any, scale: float, **given: Any) -> Any:
        seen = np.isfinite(path.places).all(axis=1)
        places = scale * path.places[seen] * [1, -1]
        film = SimpleNamespace(radius_px=path.radius, scale=scale)
        file = SimpleNamespace(tracks=(Track("ball", path.times[seen], places),), notes=(), film=film)
        monkeypatch.setattr(judgement, "is_film", lambda _path: True)
        monkeypatch.setattr(read, "read_tracks", lambda *_: file)
        monkeypatch.setattr(judgement, "likeliest_ball", lambda *_, **__: path)
        return judge("film.mp4", **given)

    return judged


def test_a_film_is_convicted_with_and_without_a_radius(filmed: Any) -> None:
    """A ball that hangs in the air, which the metres of a radius read as seen from above."""
    path = judged_runs.film_of("clean", 1, "hang", 0.5)
    plain = by_film_laws(path, "no scale")
    found = filmed(path, 1e-5, radius=0.02)
    assert any(note.startswith("seen from above") for note in found.notes)
    assert laws_of(plain)
    assert laws_of(plain).items() <= laws_of(found).items()
    assert set(found.laws) == set(plain.laws) | set(verdicts.LAWS)


def test_a_film_in_slow_motion_is_told_the_rate_to_give(filmed: Any) -> None:
    t, z = bouncing(pull=0.4, count=1600)
    path = judged_runs.film_of("clean", 1)._replace(
        times=t, places=np.stack([300 + 0 * z, -1000 * z], axis=-1), outlines=None
    )
    found = filmed(path, 1e-3, radius=0.02)
    assert found.violations == []
    assert "falls with 0.4 m/s^2: is the film slowed down (`rate` 4.95 times the container's)" in found.notes[0]
    assert filmed(path, 1e-3, radius=0.02, rate=200.0).of("gravity")  # (who gives the rate is taken at their word)


@pytest.mark.parametrize("rate", [30, 120, 240])
def test_a_film_is_not_convicted_for_what_outlines_and_scales_are_off_by(filmed: Any, rate: int) -> None:
    """Marks that turn move an outline to and fro by 0.03 of its radius, and a radius gives the scale to some 2 %; but a bounce that
    doubles the energy is found."""
    t, z = bouncing(restitution=0.8, count=rate, rate=rate)
    path, scale = judged_runs.film_of("clean", 1), 2e-3  # m per px

    def judged(z: Any, scale: float) -> Any:
        off = 0.03 * R / 2e-3 * np.sin(2 * np.pi * 9 * t)
        places = np.stack([300 + 100 * t + off, 900 - z / 2e-3 + off], axis=-1)
        noise = np.random.default_rng(3).normal(0, 0.03, places.shape)
        film = path._replace(times=t, places=places + noise, outlines=None, radius=R / 2e-3)
        return filmed(film, scale, radius=R)

    for factor in (1.0, 0.96, 1.04):
        found = judged(z, factor * scale)
        assert laws_of(found) == {}
        assert found.checked["gravity"] > 0
    assert "energy" in laws_of(judged(bouncing(restitution=1.5, count=rate, rate=rate)[1], scale))


@pytest.mark.parametrize("noise", [0.0, 2e-4])
def test_a_ball_seen_from_the_side_may_lie_on_something(noise: float) -> None:
    """It rolls along a shelf, over its edge, and falls: at g as balls do, and otherwise as they do not."""
    t = np.arange(120) / 120
    for pull, laws in ((G, {}), (0.9 * G, {"gravity": 1})):
        y = 1.3 - pull / 2 * np.maximum(t - 0.5, 0) ** 2
        x, y = (one + np.random.default_rng(k).normal(0, noise, 120) for k, one in enumerate((0.8 * t, y)))
        assert {
            law: n for law, n in laws_of(judge({"t": t, "x": x, "y": y}, radius=R)).items() if law != "turn"
        } == laws
    # (of its height nothing is known, and so nothing of a floor)
    assert judge({"t": t, "x": x, "y": y}, radius=R).checked["penetration"] == 0


def test_a_moment_of_inertia_is_given_or_said() -> None:
    """A hollow ball whose topspin becomes speed at the floor, more than a solid one could hold."""
    ball = carom.SceneBall(
        radius=0.02, mass=0.0027, inertia="hollow", position=(0, 0, 0.25), velocity=(3, 0, 0), spin=(0, 400, 0)
    )
    run = carom.simulate(carom.Scene(floor=carom.Floor(restitution=0.9, friction=0.3), balls=[ball]), duration=1.0)
    t = np.arange(200) / 200
    state = run.at(t)
    places = {name: np.asarray(state.position)[:, 0, k] for k, name in enumerate("xyz")}
    columns = {"t": t, **places} | {f"w{name}": np.asarray(state.spin)[:, 0, k] for k, name in enumerate("xyz")}
    solid = judge(columns, radius=0.02)
    assert "energy" in laws_of(solid)
    assert any("no column kappa: the moment of inertia of balls is taken as 0.4 m a^2" in note for note in solid.notes)
    for known in (
        judge(columns, radius=0.02, inertia="hollow"),
        judge(columns | {"kappa": np.full(200, 2 / 3)}, radius=0.02),
    ):
        assert laws_of(known) == {}
    with pytest.raises(CaromError, match="`inertia`: expected solid, hollow or kappa"):
        judge(columns, radius=0.02, inertia="wooden")


@pytest.mark.parametrize(("gravity", "laws"), [("3", []), ("9.81", ["gravity"])])
def test_the_gravity_that_is_given_holds(tmp_path: Path, gravity: str, laws: list[str]) -> None:
    t, z = bouncing(restitution=0.8, pull=3.0)
    (tmp_path / "moon.csv").write_text("t,x,y,z\n" + "".join(f"{a},0,0,{b}\n" for a, b in zip(t, z, strict=True)))
    given = ["judge", str(tmp_path / "moon.csv"), "--gravity", gravity, "--radius", "0.03", "--json"]
    found = json.loads(CliRunner().invoke(app, given).stdout)
    assert sorted({one["law"] for one in found["violations"]} - {"energy"}) == laws
