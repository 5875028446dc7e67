"""Tables with pockets: which ball falls where, against a second geometry and against small steps in time."""

from __future__ import annotations

import functools
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from reference.brute_force_scene import HOLE, SHEET, _gap, judge, solids
from reference.exploring import tried
from reference.table_shots import shot

import carom
from carom.core.jit.compile import njit
from carom.scene import Table
from carom.simulation.narrate import describe_run

# --- leg by leg --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("preset", ["pool-9ft", "pool-7ft", "snooker"])
def test_no_ball_gets_past_a_jaw_or_a_pocket(preset: str) -> None:
    fallen = met = 0
    for seed in range(40):
        run = carom.simulate(shot(preset, seed, 3))
        fault, row, size, _steps = judge(run)
        assert not fault, f"shot {seed}, row {row}: {fault} ({size:.3g})"
        fallen += len(run.events.of("pocketed"))
        met += len(run.events.of("wall"))
    assert fallen > 3
    assert met > 60


def test_balls_in_the_air_low_cushions_and_all_laws() -> None:
    kinds: set[str] = set()
    for seed in range(40):
        law = ("two-step", "mirror", "no-slip")[seed % 3]
        scene = shot("pool-7ft", seed, 2, wall={"height": 0.045}, run={"law": law, "duration": 4, "max_events": 300})
        first = scene.balls[0]
        speed = math.hypot(*first.velocity[:2])
        thrown = first.model_copy(
            update={"velocity": (*first.velocity[:2], 0.3 * speed), "rolling": False, "spin": (0.0, 0.0, 0.0)}
        )
        run = carom.simulate(scene.model_copy(update={"balls": (thrown, *scene.balls[1:])}))
        fault, row, size, _steps = judge(run)
        assert not fault, f"shot {seed}, row {row}: {fault} ({size:.3g})"
        kinds |= set(run.events.kinds)
    assert {"pocketed", "left", "wall", "floor"} <= kinds


def test_the_judge_sees_a_ball_that_does_not_fall() -> None:
    found = set()
    for seed in range(60):
        run = carom.simulate(shot("pool-7ft", seed, 1))
        last = np.flatnonzero(run.log["kind"] == 9)
        if len(last):
            without = np.delete(run.log, last[0])
            elsewhere = run.log.copy()
            elsewhere["other"][last[0]] = (run.log["other"][last[0]] + 1) % 6
            for name, log in (("missed", without), ("elsewhere", elsewhere)):
                found.add((name, judge(carom.Trajectory(run.scene, log, run.end + 0.1, "duration"))[0]))
    assert {"missed", "elsewhere"} == {name for name, _fault in found}
    assert "" not in {fault for _name, fault in found}


# --- small steps in time -----------------------------------------------------------------------------------------------


def _follow(stuff: Any, x: Any, v: Any, a: float, e: float, h: float, until: float, out: Any) -> None:
    """Move two balls without friction among solids by steps of h, each halved down to the instant of a contact.

    Nothing is looked at while a ball has less way behind it than the nearest solid was away.
    """
    t = 0.0
    clear = np.zeros(2)
    gone = np.zeros(2, np.int64)
    while t < until and (gone[0] == 0 or gone[1] == 0):
        step = h
        for i in range(2):
            for c in range(2):
                x[i, c] += step * v[i, c] * (1 - gone[i])
        t += step
        for i in range(2):
            clear[i] -= step * math.sqrt(v[i, 0] ** 2 + v[i, 1] ** 2)
            if gone[i] != 0 or clear[i] > 1e-9 * a:
                continue
            clear[i] = math.inf
            for k in range(stuff.shape[0]):
                own = a if stuff[k, 0] != HOLE else 0.0
                gap = _gap(stuff[k], x[i, 0], x[i, 1], a) - own
                clear[i] = min(clear[i], gap)
                if gap >= 0:
                    continue
                if stuff[k, 0] == HOLE:
                    gone[i] = 1
                    out[i, 0], out[i, 1] = -1 - stuff[k, 1], t
                    break
                # back to the contact, by halves; then the mirror, from there on
                left, right = -step, 0.0
                for _ in range(60):
                    m = (left + right) / 2
                    if _gap(stuff[k], x[i, 0] + m * v[i, 0], x[i, 1] + m * v[i, 1], a) - own >= 0:
                        left = m
                    else:
                        right = m
                p, q = x[i, 0] + left * v[i, 0], x[i, 1] + left * v[i, 1]
                nx, ny = p - stuff[k, 2], q - stuff[k, 3]
                if stuff[k, 0] == SHEET:  # from the nearest point, not from the first one
                    dx, dy = stuff[k, 4] - stuff[k, 2], stuff[k, 5] - stuff[k, 3]
                    along = min(max((nx * dx + ny * dy) / (dx * dx + dy * dy), 0.0), 1.0)
                    nx, ny = nx - along * dx, ny - along * dy
                size = math.sqrt(nx * nx + ny * ny)
                nx, ny = nx / size, ny / size
                un = v[i, 0] * nx + v[i, 1] * ny
                if un < 0:
                    v[i, 0] -= (1 + e) * un * nx
                    v[i, 1] -= (1 + e) * un * ny
                    x[i, 0], x[i, 1] = p - left * v[i, 0], q - left * v[i, 1]
        if gone[0] + gone[1] == 0:
            rx, ry = x[0, 0] - x[1, 0], x[0, 1] - x[1, 1]
            ux, uy = v[0, 0] - v[1, 0], v[0, 1] - v[1, 1]
            far2 = rx * rx + ry * ry
            if far2 < 4 * a * a and rx * ux + ry * uy < 0:
                b, uu = rx * ux + ry * uy, ux * ux + uy * uy
                s = (b + math.sqrt(b * b - uu * (far2 - 4 * a * a))) / uu  # how long ago they touched
                for i in range(2):
                    for c in range(2):
                        x[i, c] -= s * v[i, c]
                nx, ny = (x[0, 0] - x[1, 0]) / (2 * a), (x[0, 1] - x[1, 1]) / (2 * a)
                un = ux * nx + uy * ny
                v[0, 0] -= un * nx
                v[0, 1] -= un * ny
                v[1, 0] += un * nx
                v[1, 1] += un * ny
                for i in range(2):
                    clear[i] = 0.0
                    for c in range(2):
                        x[i, c] += s * v[i, c]


@functools.cache
def _compiled() -> Any:
    return njit(_follow, cache=False)  # (the cache would not see changes of _gap, in another file)


@pytest.mark.parametrize(("preset", "shots", "least"), [("pool-9ft", 40, 6), ("snooker", 40, 2)])
@pytest.mark.slow(keep=1)
def test_the_same_ball_falls_into_the_same_pocket_by_small_steps(preset: str, shots: int, least: int) -> None:
    wall = {"restitution": 0.9, "friction": 0.0, "nose_height": None}
    until, h = 8.0, tried(1e-4, 4e-5)
    compared: list[int] = []
    for seed in range(shots):
        if len(compared) >= tried(2, shots):
            break
        run_for = {"law": "mirror", "duration": until}
        scene = shot(preset, seed, 2, wall=wall, floor={"friction": 0.0}, ball_contact={}, run=run_for)
        run = carom.simulate(scene)
        x = np.array([ball.center[:2] for ball in scene.balls])
        v = np.array([ball.velocity[:2] for ball in scene.balls])
        # jaws and balls disperse: where a hundred-millionth of a metre at the start changes the end, nothing is compared
        x[0, 0] += 1e-8
        nudged = (scene.balls[0].model_copy(update={"position": (*x[0], scene.balls[0].radius)}), scene.balls[1])
        fates = [
            {event.ball: (event.other, event.t) for event in one.events.of("pocketed")}
            for one in (run, carom.simulate(scene.model_copy(update={"balls": nudged})))
        ]
        x[0, 0] -= 1e-8
        out = np.full((2, 2), -1.0)
        _compiled()(solids(scene), x, v, scene.balls[0].radius, 0.9, h, until, out)
        for i in range(2):
            (pocket, t), (other, late) = (fate.get(i, (-1, until)) for fate in fates)
            if pocket != other or abs(late - t) > h:
                continue
            assert out[i, 0] == pocket, seed
            if pocket >= 0:
                assert out[i, 1] == pytest.approx(t, abs=2 * h), seed
                compared.append(pocket)
    assert len(compared) >= tried(2, least)


# --- what becomes of a ball that falls -----------------------------------------------------------------------------------


def one_ball(velocity: tuple[float, ...], *more: dict[str, Any], **run: Any) -> carom.Scene:
    ball = {"radius": 0.028575, "mass": 0.163}
    balls = [{**ball, "position": (0, 0), "velocity": velocity, "rolling": True, "name": "white"}]
    floor = {"friction": 0.2, "rolling_resistance": 0.01}
    table = {"shape": "table", "preset": "pool-9ft"}
    return carom.Scene(floor=floor, walls=[table], balls=[*balls, *({**ball, **one} for one in more)], run=run)


def test_a_ball_falls_at_the_edge_and_is_gone() -> None:
    run = carom.simulate(one_ball((0.0, -1.2), duration=2))
    (event,) = run.events.of("pocketed")
    table = run.scene.walls[0]
    pocket = table.pockets[event.other]
    assert event.name == pocket.name == "bottom middle pocket"
    assert event.other == 1
    # by hand: 0.635 m to the nose, and the shelf; at a deceleration of 0.01 g
    way, v = 0.635 + table.side_pockets.shelf, 1.2
    t = (v - math.sqrt(v * v - 2 * 0.01 * 9.80665 * way)) / (0.01 * 9.80665)
    assert event.t == pytest.approx(t, abs=1e-12)
    assert math.dist(event.after.position[:2], pocket.center) == pytest.approx(pocket.radius, abs=1e-15)
    assert event.phase == "pocketed" == run.final_phase[0]
    assert run.ended == "nothing more happens"
    assert run.phases(0) == [(0.0, event.t, "rolling"), (event.t, event.t, "pocketed")]
    assert np.isnan(run.at(1.0).position).all()
    assert not np.isnan(run.at(event.t).position).any()
    assert run.final.position[0].tolist() == event.after.position.tolist()
    assert "falls into the bottom middle pocket at 1.15 m/s." in " ".join(describe_run(run))


def test_nothing_meets_a_ball_that_has_fallen() -> None:
    # the second ball comes along later and would meet the first one, had it stayed at the edge
    second = {"position": (0.0, 0.5), "velocity": (0.0, -1.2), "rolling": True}
    run = carom.simulate(one_ball((0.0, -1.2), second))
    assert run.events.kinds == ["pocketed", "pocketed"]
    assert run.final_phase == ["pocketed", "pocketed"]
    assert run.ended == "nothing more happens"
    assert "1 more" not in " ".join(describe_run(run))
    # (the energy of all balls was NaN from the first pocket on)
    between = (run.events[0].t + run.events[1].t) / 2
    assert run.energy(between) == run.energy(between, each=True)[1] > 0


def test_a_slow_ball_stops_at_the_edge() -> None:
    run = carom.simulate(one_ball((0.0, -math.sqrt(2 * 0.01 * 9.80665 * 0.63))))
    assert run.events.kinds == ["rest"]


def test_bounces_too_low_to_see_end_at_the_edge() -> None:
    # the infinitely many bounces before the edge are summed only as far as no pocket is in reach
    for away in (1e-7, 1e-5, 1e-3):
        scene = one_ball((0.0, 0.0))
        edge = -0.635 - scene.walls[0].side_pockets.shelf
        ball = {
            "radius": 0.028575,
            "mass": 0.163,
            "position": (0.0, edge + away, 0.028575 + 1e-9),
            "velocity": (0.0, -0.5, 0.0),
        }
        floor = {"friction": 0.2, "restitution": 0.5}
        run = carom.simulate(carom.Scene(floor=floor, walls=scene.walls, balls=[ball], run={"duration": 1}))
        assert run.final_phase == ["pocketed"]
        assert run.events[-1].after.position[1] == pytest.approx(edge, abs=1e-12)


def test_a_ball_in_the_air_falls_too_but_above_the_cushions_it_has_left() -> None:
    ball = {"radius": 0.028575, "mass": 0.163, "position": (0.0, -0.5), "velocity": (0.0, -2.0, 1.0)}
    for height, kind in ((math.inf, "pocketed"), (0.05, "left")):
        table = Table(preset="pool-9ft", height=height)
        run = carom.simulate(carom.Scene(floor={"friction": 0.2}, walls=[table], balls=[ball], run={"duration": 1}))
        assert run.events.kinds == [kind]


def test_tables_files_and_many_runs_know_pockets(tmp_path: Path) -> None:
    run = carom.simulate(one_ball((0.0, -1.2), duration=2))
    table = run.events.table()
    assert table[["kind", "other", "name", "phase"]].values.tolist() == [
        ["pocketed", 1, "bottom middle pocket", "pocketed"]
    ]
    assert run.table([0.0, 1.0])["phase"].tolist() == ["rolling", "pocketed"]
    again = carom.load_trajectory(run.save(tmp_path / "run.parquet"))
    assert again.log.tobytes() == run.log.tobytes()
    assert again.events[0].name == "bottom middle pocket"
    assert again.scene == run.scene
    spin = [[1.2 / 0.028575, 0, 0], [0, 0.3 / 0.028575, 0]]
    many = carom.simulate_many(
        run.scene, velocity=[[0, -1.2, 0], [0.3, 0, 0]], spin=spin, events=4, kinds=("pocketed",)
    )
    assert many.phase[:, 0].tolist() == ["pocketed", "rolling"]
    assert many.events["kind"][:, 0].tolist() == [9, 0]
    assert many.final.position[0].tobytes() == run.final.position.tobytes()
    with pytest.raises(carom.CaromError, match="expected places where the balls touch nothing"):
        carom.simulate_many(run.scene, position=[[0.0, -0.66, 0.028575]])
