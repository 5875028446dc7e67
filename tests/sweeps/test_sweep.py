"""Sweeps: every point bit for bit what ``simulate`` gives, whatever its parameters; what has no outcome says why."""

from __future__ import annotations

import itertools
import sys
import warnings
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from reference.sweep_scenes import table_scene
from typer.testing import CliRunner

import carom
from carom import plot, sweeps
from carom.cli import app
from carom.core.jit.threads import limit_threads, thread_count
from carom.scene.toml import replaced
from carom.simulation.records import BALL, FLOOR, PHASE, WALL

KEEP = [
    "final.position", "final.velocity", "final.spin", "final.phase", "final.time", "events.count", "events.wall.count",
    "events.ball.count", "events.floor.count", "events.rolling.count", "events.wall.1.position", "events.ball.0.time",
    "events.wall.0.met",
]  # fmt: skip


def run_of(scene: carom.Scene, values: dict[str, object]) -> dict[str, object]:
    """What ``simulate`` gives for one point."""
    run = carom.simulate(replaced(scene, values))
    log = run.log
    walls, balls = log[log["kind"] == WALL], log[log["kind"] == BALL]
    return {
        "final.position": run.final.position,
        "final.velocity": run.final.velocity,
        "final.spin": run.final.spin,
        "events.wall.count": len(walls),
        "events.ball.count": len(balls) // 2,
        "events.floor.count": int((log["kind"] == FLOOR).sum()),
        "events.rolling.count": int(((log["kind"] == PHASE) & (log["phase"] == 2)).sum()),
        "events.wall.1.position": walls["x"][1] if len(walls) > 1 else np.full(3, np.nan),
        "events.ball.0.time": balls["t"][0] if len(balls) else np.nan,
        "events.wall.0.met": walls["other"][0] if len(walls) else -1,
    }


def require_same(scene: carom.Scene, space: carom.Space, count: int = 12) -> None:
    """Compare points of a sweep with single runs, bit for bit."""
    found = carom.sweep(space, KEEP).run()
    for index in np.random.default_rng(1).choice(space.size, min(count, space.size), replace=False).tolist():
        place = dict(zip(space.dims, np.unravel_index(index, space.shape), strict=True))
        assert int(found["failed"][place]) == 0
        for name, value in run_of(scene, space.point(index)).items():
            assert np.array_equal(found[name][place].values, value, equal_nan=True), (name, place)


@pytest.mark.parametrize(
    "parameters",
    [
        {"balls.0.velocity": carom.polar([0.7, 2.5], np.linspace(3, 87, 9)), "walls.*.friction": [0.12, 0.25]},
        {"balls.white.velocity.x": [1.0, 2.0, 3.0], "balls.white.spin_z": [-40.0, 0.0, 40.0], "floor.friction": [0.15, 0.25]},
        {"walls.0.restitution": np.linspace(0.5, 0.95, 12), "ball_contact.friction": [0.0, 0.1], "balls.0.mass": [0.19, 0.21]},
        {"run.law": ["two-step", "mirror", "mathavan2010"], "balls.0.velocity": carom.polar(2.0, np.linspace(20, 60, 5))},
        {"balls.1.position": [[0.1, 0.3], [0.2, -0.3], [0.4, 0.5]], "balls.0.velocity": carom.polar(2.2, [20.0, 30.0])},
        {"balls.0.radius": [0.03, 0.03075], "walls.0.length": [2.7, 2.84], "walls.0.friction": [0.1, 0.2]},
        {"run.duration": [0.5, 1.5, 4.0], "floor.rolling_resistance": np.linspace(0.005, 0.02, 10)},
        {"walls.*.friction": sweeps.sobol(0.1, 0.3, 16), "walls.*.restitution": sweeps.sobol(0.6, 0.95, 16)},
        {"gravity": [9.7, 9.8, 9.9]},
        {"floor.rolling_drag": [0.0, 0.004], "floor.spin_damping": [0.0, 0.3], "walls.*.yield_time": [0.0, 0.003]},
        {"floor.spin_drag": [0.0, 3.0], "balls.0.velocity.x": [1.0, 2.0]},
        {"floor.slope": [[0.0, 0.0], [0.002, -0.001]], "floor.spin_damping": [0.0, 0.3]},
    ],
    ids="+".join,
)  # fmt: skip
def test_every_point_is_what_simulate_gives(parameters: dict[str, object]) -> None:
    scene = table_scene()
    require_same(scene, carom.Space(scene, parameters))


def test_struck_balls() -> None:
    base = table_scene()
    ball = carom.SceneBall(radius=0.03075, mass=0.21, position=(-0.71, -0.3), strike={"speed": 2.0}, name="white")
    scene = base.model_copy(
        update={"balls": (ball.model_copy(update={"position": (-0.71, -0.3, 0.03075)}), *base.balls[1:])}
    )
    space = carom.Space(
        scene,
        {
            "balls.0.strike.speed": [1.0, 3.0],
            "balls.0.strike.azimuth": np.linspace(0, 60, 4),
            "balls.0.strike.offset": [[0.0, 0.0], [0.3, -0.2]],
            "balls.0.strike.elevation": [0.0, 12.0],
        },
    )
    require_same(scene, space)


def test_pockets() -> None:
    scene = carom.Scene(
        floor=carom.Floor(friction=0.2, rolling_resistance=0.01),
        walls=[{"shape": "table", "preset": "pool-9ft"}],
        balls=[carom.SceneBall(radius=0.028575, mass=0.17, position=(0, 0), velocity=(1, 0), rolling=True)],
        run=carom.Run(duration=20),
    )
    space = carom.Space(scene, {"balls.0.velocity": carom.polar(2.5, np.linspace(0, 360, 145))})
    found = carom.sweep(space, ["final.pocket", "events.pocketed.count", "final.phase"]).run()
    fell = found["final.pocket"].values[:, 0] >= 0
    assert 5 < fell.sum() < 140
    assert np.array_equal(fell, found["events.pocketed.count"].values == 1)
    names = found["final.pocket"].attrs["flag_meanings"]
    assert names == list(scene.pocket_names)
    for k in np.flatnonzero(fell)[:5].tolist():
        run = carom.simulate(replaced(scene, space.point(k)))
        (event,) = (one for one in run.events if one.kind == "pocketed")
        assert event.name == names[int(found["final.pocket"].values[k, 0])]


def test_points_that_a_scene_refuses_say_why() -> None:
    scene = table_scene()
    places = [[0.1, 0.3], [0.72, 0.0], [5.0, 0.0]]  # free, on the red ball, outside
    made = carom.sweep(carom.Space(scene, {"balls.1.position": places}), ["final.position"])
    found = made.run()
    assert found["failed"].values.tolist() == [0, 4, 4]
    assert np.isnan(found["final.position"].values[1:]).all()
    assert made.why(0) == ""
    assert "overlaps" in made.why(1)
    assert made.why(2) != ""


def test_points_without_an_answer_say_why() -> None:
    upright = {"walls.0.restitution": 1.0, "walls.0.nose_height": None, "run.law": "conventional"}
    scene = replaced(table_scene(), {**upright, "balls.0.rolling": False})
    made = carom.sweep(
        carom.Space(scene, {"balls.0.velocity": carom.polar([1.0, 6.0], np.linspace(5, 85, 9))}), ["final.position"]
    )
    failed = made.run()["failed"].values
    assert (failed == 1).sum() > 0
    place = tuple(int(k) for k in np.argwhere(failed == 1)[0])
    assert "rolls into a vertical wall" in made.why(*place)


def test_the_number_of_threads_and_the_size_of_blocks_change_nothing() -> None:
    velocity = carom.polar(np.linspace(0.5, 4, 7), np.linspace(0, 80, 11))
    space = carom.Space(
        table_scene(), {"balls.0.velocity": velocity, "floor.friction": sweeps.uniform(0.15, 0.25)}, repeats=3
    )
    whole = carom.sweep(space, ["final.position", "events.count"]).run()
    threads = thread_count()
    try:
        limit_threads(1)
        parts = carom.sweep(space, ["final.position", "events.count"], block=17).run()
    finally:
        limit_threads(threads)
    assert np.array_equal(whole["final.position"].values, parts["final.position"].values)
    assert np.array_equal(whole["events.count"].values, parts["events.count"].values)


def test_impacts_are_what_compare_gives() -> None:
    case = sweeps.ImpactCase(restitution=0.85, friction=0.2, contact_height=1.2, floor_friction=0.2)
    parameters = {
        "law": ["mirror", "two-step", "conventional", "mathavan2010"],
        "angle": [0.0, 20.0, 70.0],
        "spin_z": [-30.0, 0.0],
        "speed": [0.5, 3.0],
    }
    space = carom.Space(case, parameters)
    made = carom.sweep(space, ["reflection_angle", "final.velocity", "after_wall.spin", "energy_ratio"])
    found = made.run()
    for index in range(space.size):
        place = np.unravel_index(index, space.shape)
        values = space.point(index)
        law, angle_deg = values.pop("law"), values.pop("angle")
        incoming = carom.incoming(
            angle_deg=angle_deg, restitution=0.85, friction=0.2, contact_height=1.2, floor_friction=0.2, **values
        )
        verdict = carom.compare(incoming, [law]).verdicts[0]
        at = dict(zip(space.dims, place, strict=True))
        if verdict.after_wall is None:
            assert int(found["failed"][at]) == 4
            assert made.why(*(int(k) for k in place)) == "; ".join(verdict.why)
            continue
        assert found["after_wall.spin"][at].values == pytest.approx(verdict.after_wall.spin, rel=1e-12, abs=1e-12)
        assert verdict.final is not None
        assert found["final.velocity"][at].values == pytest.approx(verdict.final.velocity, rel=1e-12, abs=1e-12)
        assert float(found["energy_ratio"][at]) == pytest.approx(verdict.energy_ratio, rel=1e-12)


def test_orbits_and_gases() -> None:
    case = sweeps.OrbitCase(table="sinai", law="mirror", bounces=2000)
    space = carom.Space(case, {"table.radius": [0.2, 0.4]}, repeats=2)
    found = carom.sweep(space, ["lyapunov.largest", "lyapunov.spectrum", "bounces.count", "ended", "time"]).run()
    largest = found["lyapunov.largest"].values
    assert (largest[0] > largest[1]).all()  # the smaller the disc, the larger the exponent of a bounce
    assert len(set(largest.ravel().tolist())) == 4  # every point has starts of its own
    assert (found["bounces.count"].values == 2000).all()
    gas = carom.gas.GasScene(
        container={"shape": "periodic", "size": (8, 8, 8)},
        species=[{"count": 100, "radius": 0.5}],
        contacts=[{"between": ("a", "a"), "restitution": 1, "friction": 0}],
        run={"equilibrate": 500, "max_events": 4000},
    )
    space = carom.Space(gas, {"contacts.0.restitution": [0.9, 1.0]}, repeats=2)
    runs = carom.sweep(space, ["temperature_translational", "events", "species.a.temperature_translational"]).run()
    temperature = runs["temperature_translational"].values
    assert (temperature[0] < temperature[1]).all()
    assert temperature[0, 0] != temperature[0, 1]
    again = carom.sweep(space, ["temperature_translational"], block=1).run()
    assert np.array_equal(again["temperature_translational"].values, temperature)


@pytest.mark.parametrize(
    ("keep", "said"),
    [
        (["final.fase"], "did you mean 'final.phase'?"),
        (["events.wal.count"], "did you mean 'events.wall.count'?"),
        (["events.wall.x.time"], "got 'events.wall.x.time'"),
        ([], "expected a list of outcomes"),
        ("final.phase", "expected a list of outcomes"),
        (["final.phase", []], "expected a list of outcomes"),
    ],
)
def test_unknown_outcomes(keep: object, said: str) -> None:
    with pytest.raises(carom.CaromError, match="sweep: keep") as caught:
        carom.sweep(carom.Space(table_scene(), {"floor.friction": [0.2]}), keep)  # type: ignore[arg-type]
    assert said in str(caught.value)


def test_all_faults_of_a_file_at_once(tmp_path: Path) -> None:
    text = sweeps.new_sweep().replace("walls.*.friction", "walls.*.frction").replace("final.phase", "final.fase")
    (tmp_path / "a.toml").write_text(text, encoding="utf-8")
    with pytest.raises(carom.CaromError) as caught:
        sweeps.load_sweep(tmp_path / "a.toml")
    assert "did you mean 'walls.*.friction'?" in str(caught.value)
    (tmp_path / "b.toml").write_text(text.replace("linspace = [0.5", "linspce = [0.5"), encoding="utf-8")
    with pytest.raises(carom.CaromError) as caught:
        sweeps.load_sweep(tmp_path / "b.toml")
    assert len(caught.value.faults) == 2
    assert all(str(tmp_path) in fault for fault in caught.value.faults)
    good = sweeps.load_sweep(_written(tmp_path / "c.toml", sweeps.new_sweep()))
    assert good.space.size == 1488
    impacts = 'keep = ["reflection_angle"]\nrepeats = 3\n[impact]\nfriction = 0.2\n[parameters]\nangle = [10, 20]\n'
    impacts += "speed = { normal = [2, 0.1] }\n"
    assert sweeps.load_sweep(_written(tmp_path / "d.toml", impacts)).run()["reflection_angle"].shape == (2, 3)


def _written(path: Path, text: str) -> Path:
    path.write_text(text, encoding="utf-8")
    return path


def test_explain_estimates_and_writes_nothing(tmp_path: object, monkeypatch: pytest.MonkeyPatch) -> None:
    clock = itertools.count()  # each look at it is a second later: the sample of points takes one
    module = sys.modules[carom.Sweep.__module__]
    monkeypatch.setattr(module, "time", SimpleNamespace(perf_counter=lambda: float(next(clock))))
    space = carom.Space(table_scene(), {"balls.0.velocity": carom.polar(np.linspace(1, 2, 40), np.linspace(0, 90, 50))})
    made = carom.sweep(space, ["final.position", "final.phase"], store=f"{tmp_path}/s.zarr", block=500)
    plan = made.explain()
    assert (plan.points, plan.blocks, plan.blocks_done) == (2000, 4, 0)
    assert plan.bytes == 2000 * (72 + 3 + 1)
    assert plan.seconds == 2000 / 16  # points, by the second that 16 of them took
    assert "speed 40 x angle 50" in repr(plan)
    assert made.store is not None
    assert made.store.attributes() is None


def test_the_names_that_a_sweep_may_keep_are_all_listed() -> None:
    """The message ended with "and 10 more", and no page had them."""
    from carom.sweeps import impacts, orbits, shots
    from carom.sweeps import orbits as gases

    page = (Path(__file__).parents[2] / "docs" / "howto" / "sweeps.md").read_text()
    rows = {row.split("|")[1].strip(): row for row in page.splitlines() if row.startswith("| ")}
    for row, names in (
        ("an impact", impacts.OUTCOMES),
        ("an orbit", orbits.OUTCOMES),
        ("a gas", gases.TOTALS),
        ("a gas", gases.OF_SPECIES),
    ):
        assert [name for name in names if f"`{name}`" not in rows[row] and f".{name}`" not in rows[row]] == []
    assert ", ".join(shots.EVENT_KINDS) in rows["a scene"]
    with pytest.raises(carom.CaromError, match="sweep: keep") as caught:
        carom.sweep(carom.Space(sweeps.OrbitCase(table="circle"), {"table.radius": [1, 2]}), ["lyapunov.large"])
    assert str(caught.value) == (
        "sweep: keep: expected names among lyapunov.largest, lyapunov.error, lyapunov.spectrum, bounces.count, ended, time,"
        " got 'lyapunov.large'; did you mean 'lyapunov.largest'?"
    )


def test_repeats_are_drawn_as_their_mean_with_its_error() -> None:
    """They were drawn as a map over the parameter and the number of the repeat."""
    case = sweeps.OrbitCase(table="sinai", law="mirror", bounces=100)
    found = carom.sweep(carom.Space(case, {"table.radius": [0.2, 0.3, 0.4]}, repeats=4), ["lyapunov.largest"]).run()
    values = found["lyapunov.largest"].values
    (axes,) = plot.plot_sweep(found).axes
    assert axes.lines[0].get_ydata() == pytest.approx(values.mean(axis=1), rel=1e-12)
    (bars,) = axes.collections
    ends = np.array([part[:, 1] for part in bars.get_segments()])
    assert np.diff(ends, axis=1)[:, 0] == pytest.approx(2 * values.std(axis=1, ddof=1) / 2, rel=1e-9)
    assert axes.get_ylabel() == "Lyapunov exponents: largest"
    assert axes.figure.get_suptitle() == "Lyapunov exponents: largest, mean of 4 repeats ± standard error"
    (axes,) = plot.plot_sweep(found, at={"repeat": 1}).axes
    assert axes.lines[0].get_ydata().tolist() == values[:, 1].tolist()
    assert len(plot.plot_sweep(found, x="radius", y="repeat").axes) == 2


def test_points_without_an_outcome_are_named_with_their_reasons(tmp_path: Path) -> None:
    case = sweeps.OrbitCase(table="sinai", law="mirror", bounces=20)
    space = carom.Space(case, {"table.radius": [0.3, 0.6, 0.8]}, repeats=2)
    carom.sweep(space, ["lyapunov.largest"], store=tmp_path / "s.zarr").run()
    text = CliRunner().invoke(app, ["sweep", "status", str(tmp_path / "s.zarr")], catch_exceptions=False).stdout
    why = "sinai: obstacles: expected room between them, got one that covers the cell; take a smaller one"
    assert text.splitlines()[1:] == [
        "  without an outcome: 2 points (refused)",
        f"    table.radius = 0.8: {why} (2 times)",
    ]


def test_polygons_by_their_corners() -> None:
    """A corner of an L moves: every point is the orbit in that polygon."""
    corners = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)]
    case = sweeps.OrbitCase(table={"shape": "polygon", "points": corners}, bounces=40)
    found = carom.sweep(carom.Space(case, {"table.points.3.0": [0.9, 1.0, 1.2]}), ["time", "bounces.count"]).run()
    assert found["bounces.count"].values.tolist() == [40, 40, 40]
    assert len(set(found["time"].values.tolist())) == 3
    for given, message in (
        ({"points": corners[:2]}, "table.points: expected 3 or more points"),
        ({"points": [(0, 0), (1, 1), (1, 0), (0, 1)]}, "table.points: expected sides that do not cross"),
        ({"points": corners, "sides": 4}, "table.sides: expected a field that is known here"),
    ):
        with pytest.raises(carom.CaromError, match=f"^OrbitCase: {message}"):
            sweeps.OrbitCase(table={"shape": "polygon", **given})


def test_a_sweep_over_the_seed_of_a_rack_breaks_the_racks_that_simulate_breaks() -> None:
    pool = carom.replaced(
        carom.load_scene("pool-9ft"), {"rack.gap": 5e-5, "rack.gap_spread": 4e-5, "run.duration": 0.5}
    )
    found = carom.sweep(carom.Space(pool, {"rack.seed": range(3)}), keep=["final.position"]).run()["final.position"]
    for seed in range(3):
        np.testing.assert_array_equal(
            found.sel(seed=seed), carom.simulate(carom.replaced(pool, {"rack.seed": seed})).final.position
        )
    assert not np.array_equal(found.sel(seed=0), found.sel(seed=1))


@pytest.mark.slow
def test_a_number_out_of_range_is_a_point_that_failed_without_a_warning():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = carom.sweep(
            carom.Space(carom.new_scene(), {"balls.0.velocity": carom.polar([1.0, 1e308], [10.0])}), ["final.position"]
        ).run()
    assert (found["failed"].values.ravel() != 0).tolist() == [False, True]
