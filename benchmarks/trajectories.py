"""Whole trajectories: carom beside pooltool (event-driven), MuJoCo and PyBullet (stepping), where they are installed.

    python benchmarks/trajectories.py

Everything is measured in one run, on one thread except where it says so. pooltool gets the physics that both have: a
frictionless cushion that returns everything, smooth elastic balls, the same cloth. Its balls keep 1 um from cushions.
"""

from __future__ import annotations

import importlib
import math
import time
from collections.abc import Callable
from typing import Any

import numpy as np
from rows import REPEATS, SMALL, Row, alone, clock, paired, report, run_script, seconds, usually

import carom
from carom.core.jit.native import fixed
from carom.scene.shapes import Plane, Table
from carom.simulation.loop import ALL, FIRST_ROWS, compiled_engine, run_scene
from carom.simulation.records import LOG, set_up
from carom.simulation.trajectory import Trajectory

RADIUS, MASS, GRAVITY = 0.03075, 0.21, 9.81
LENGTH, WIDTH = 2.84, 1.42
ONE = [((0.4, 0.6), (1.0, 5.5, 0.0), 20.0)]
THREE = [((0.4, 0.6), (0.8, 5.5, 0.0), 20.0), ((0.71, 2.13), (0.0, 0.0, 0.0), 0.0), ((0.9, 0.71), (0.0, 0.0, 0.0), 0.0)]


def best(run: Callable[[], Any], repeats: int = 30) -> float:
    run()
    return min(seconds(run) for _ in range(usually(repeats, 1)))


def spin(v: Any, side: float) -> tuple[float, float, float]:
    return (-v[1] / RADIUS, v[0] / RADIUS, side)


def scene(starts: Any, law: str, nose: float | None = None) -> carom.Scene:
    elastic = law == "mirror"
    return carom.Scene(
        gravity=GRAVITY,
        floor=carom.Floor(friction=0.2, restitution=0.5, rolling_resistance=0.01, spin_friction=4 / 9 * RADIUS),
        walls=[
            Table(
                length=WIDTH, width=LENGTH, center=(WIDTH / 2, LENGTH / 2),
                restitution=1.0 if elastic else 0.85, friction=0.2, nose_height=nose,
            )
        ],
        balls=[
            carom.SceneBall(radius=RADIUS, mass=MASS, position=x, velocity=v, spin=spin(v, side)) for x, v, side in starts
        ],
        ball_contact=carom.BallContact(restitution=1.0 if elastic else 0.95, friction=0.0 if elastic else 0.05),
        run=carom.Run(law=law),
    )  # fmt: skip


def carom_shots() -> dict[str, float]:
    print("\ncarom: one shot by `simulate`, hit hard, until everything rests")
    compiled_engine()  # (a process that runs few shots interprets them)
    found = {}
    for name, starts in (("one ball", ONE), ("three balls", THREE)):
        for law, nose in (("mirror", None), ("two-step", None), ("two-step", 0.037)):
            table = scene(starts, law, nose)
            run = carom.simulate(table)
            took = best(lambda table=table: carom.simulate(table))
            label = f"{name}, {law}" + (", nose at 37 mm" if nose else "")
            rate = len(run.events) / took
            print(f"  {label:38} {len(run.events):4} events {took * 1e6:8.0f} us {rate:12,.0f} events/s")
            found[label] = took
    rests = carom.Scene(
        floor=carom.Floor(friction=0.2), balls=[carom.SceneBall(radius=RADIUS, mass=MASS, position=(0, 0))]
    )
    report(alone("a shot that does nothing: a ball at rest", lambda: carom.simulate(rests), unit="shot", calls=1000))
    rack = carom.load_scene("pool-9ft")
    report(
        alone("the break of a pool rack, 16 balls", lambda: carom.simulate(rack), unit="break", calls=30, wanted=5e6)
    )
    return found


def call_steps() -> None:
    """The steps of one call of `simulate`, a mirror shot of one ball: each is the difference of two calls timed in turn."""
    table = scene(ONE, "mirror")
    found = run_scene(table)
    arrays = set_up(table)
    balls, log = arrays.balls_to_move(), np.empty(FIRST_ROWS, LOG)
    starts, bytes_of = arrays.balls.tobytes(), balls.view(np.uint8).data

    def loop(most: int, slow: float) -> Callable[[], Any]:
        return fixed(
            compiled_engine(), (arrays.world, arrays.features, balls, log, slow, math.inf, most, arrays.users, ALL)
        )

    nothing, whole = loop(0, 0.0), loop(2**62, -1.0)

    def shot() -> None:
        bytes_of[:] = starts
        whole()

    def reset() -> None:
        bytes_of[:] = starts

    bare = carom.simulate.__wrapped__  # type: ignore[attr-defined]
    calls = (
        nothing,
        reset,
        shot,
        lambda: run_scene(table),
        lambda: Trajectory(*found),
        lambda: bare(table),
        lambda: carom.simulate(table),
    )
    many = usually(1000, 1)

    def took(call: Callable[[], Any]) -> float:
        begin = clock()
        for _ in range(many):
            call()
        return (clock() - begin) / many

    times = [[took(call) for call in calls] for _ in range(REPEATS)]
    handed, back, ran, kept, made, unguarded, all_of_it = (min(times) for times in zip(*times, strict=True))
    print("\ncarom: a mirror shot of one ball by `simulate`, step by step")
    steps = {
        "arguments": handed,
        "events": ran - back - handed,
        "log": kept - (ran - back),
        "Trajectory": made,
        "checks": unguarded - kept - made,
        "guard": all_of_it - unguarded,
    }
    for step, took_it in steps.items():
        report(Row(f"shot, {step}", took_it * 1e9, "shot"))


def carom_many(shots: int = usually(40_000, 100)) -> dict[str, float]:
    import numba

    threads = numba.get_num_threads()
    print(f"\ncarom: {shots:,} shots by `simulate_many`, {threads} threads")
    rng = np.random.default_rng(1)
    v = np.zeros((shots, 3))
    v[:, :2] = 5 * rng.normal(size=(shots, 2))
    w = np.column_stack((-v[:, 1] / RADIUS, v[:, 0] / RADIUS, 30 * rng.normal(size=shots)))
    found = {}
    for law, nose in (("mirror", None), ("two-step", None), ("two-step", 0.037)):
        table = scene(ONE, law, nose)
        carom.simulate_many(table, velocity=v[:100], spin=w[:100])
        begin = time.perf_counter()
        run = carom.simulate_many(table, velocity=v, spin=w)
        rate = run.count.sum() / (time.perf_counter() - begin) / threads
        label = f"one ball, {law}" + (", nose at 37 mm" if nose else "")
        print(f"  {label:38} {run.count.sum():10,} events {rate:12,.0f} events/s a core")
        found[label] = rate
    return found


def pooltool_shots(single: dict[str, float], many: dict[str, float]) -> None:
    try:
        pt = importlib.import_module("pooltool")
    except ImportError:
        print("\npooltool: not installed (plain pip gives 0.3.3; 0.6.0 needs --no-deps and panda3d)")
        return
    import attrs

    specs = importlib.import_module("pooltool.objects.table.specs").BilliardTableSpecs(l=LENGTH, w=WIDTH)
    cushions = importlib.import_module("pooltool.physics.resolve.ball_cushion")
    balls = importlib.import_module("pooltool.physics.resolve.ball_ball")
    resolver = importlib.import_module("pooltool.physics.resolve.resolver").default_resolver()
    engine_of = importlib.import_module("pooltool.physics.engine").PhysicsEngine

    def system(starts: Any) -> Any:
        made = {}
        for k, (x, v, side) in enumerate(starts):
            ball = pt.Ball.create(str(k), xy=x, R=RADIUS, m=MASS)
            ball.state.rvw = np.array([[*x, RADIUS], v, spin(v, side)])
            ball.state.s = 2 if any(v) else 0
            made[str(k)] = ball
        return pt.System(cue=pt.Cue(cue_ball_id="0"), table=pt.Table.from_table_specs(specs), balls=made)

    print(f"\npooltool {pt.__version__}: the same shots")
    models = {
        "mirror": ("UnrealisticLinear", "FrictionlessElastic"),
        "two-step, nose at 37 mm": ("Mathavan2010Linear", "FrictionalMathavan"),
    }
    for name, starts in (("one ball", ONE), ("three balls", THREE)):
        for law, (cushion, contact) in models.items():
            engine = engine_of(
                resolver=attrs.evolve(
                    resolver, ball_linear_cushion=getattr(cushions, cushion)(), ball_ball=getattr(balls, contact)()
                )
            )
            label = f"{name}, {law}"
            table = scene(starts, law.partition(",")[0], 0.037 if "nose" in law else None)
            pairs = []
            for _ in range(REPEATS):
                times = []
                for shot in [system(starts) for _ in range(3)]:
                    begin = clock()
                    pt.simulate(shot, engine=engine, inplace=True)
                    times.append(clock() - begin)
                pairs.append((best(lambda table=table: carom.simulate(table)), min(times)))
            theirs = min(there for _ours, there in pairs)
            rate = len(shot.events) / theirs
            wanted = 1 / 35 if "nose" in label else math.nan
            peer = f"pooltool {pt.__version__} {cushion}"
            report(paired(f"a shot, {label}", pairs, peer, count=1, unit="shot", wanted=wanted))
            print(
                f"  {label:38} {len(shot.events):4} events {theirs * 1e6:8.0f} us {rate:12,.0f} events/s; carom",
                end=" ",
            )
            print(f"{theirs / single[label]:.0f} x a shot by simulate", end="")
            print(f", {many[label] / rate:.0f} x an event by simulate_many" if label in many else "")
            if law == "mirror":
                run = carom.simulate(scene(starts, "mirror"))
                there = np.array([shot.balls[str(k)].state.rvw[0] for k in range(len(starts))])
                print(
                    f"    where the balls rest, largest difference: {1e6 * np.abs(there - run.final.position).max():.1f} um"
                )


# --- the paper's example by stepping ------------------------------------------------------------------------------

A, M = 0.02625, 0.1406


def paper() -> float:
    table = carom.Scene(
        floor=carom.Floor(friction=math.inf),
        walls=[Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=1.0, friction=math.inf)],
        balls=[carom.SceneBall(radius=A, mass=M, position=(0.3, 0.0), velocity=(-1.0, 1.0), rolling=True)],
        run=carom.Run(duration=1.0),
    )
    run = carom.simulate(table)
    v = run.final.velocity[0]
    angle = math.degrees(math.atan2(v[1], v[0]))
    print("\nThe paper's example (45 degrees in; exact: 51.5198), error against time spent")
    print(
        f"  carom            {angle:9.4f} deg  error {abs(angle - ANGLE):8.1e}  {best(lambda: carom.simulate(table)) * 1e3:9.3f} ms"
    )
    return angle


# (40), (41): v = (31/49, 39/49) after the landing
ANGLE = math.degrees(math.atan2(39, 31))


def mujoco_steps() -> None:
    try:
        mujoco = importlib.import_module("mujoco")
    except ImportError:
        print("  MuJoCo: not installed")
        return
    for step in (1e-2, 1e-3, 1e-4, 1e-5):
        # the stiffest contacts that the step allows; an elastic wall is one without damping
        floor, wall = f"{2 * step} 1", f"{-1 / (4 * step * step)} 0"
        rough = 'friction="1000 0 0" condim="3"'
        pair = 'friction="1000 1000 0 0 0" condim="3"'
        body = f'<geom name="ball" type="sphere" size="{A}" mass="{M}" {rough}/>'
        model = mujoco.MjModel.from_xml_string(f"""
        <mujoco>
          <option timestep="{step}" gravity="0 0 -9.80665" cone="elliptic" impratio="100"/>
          <worldbody>
            <geom name="floor" type="plane" size="5 5 .1" solref="{floor}" {rough}/>
            <geom name="wall" type="box" pos="-0.5 0 0" size="0.5 5 1" solref="{wall}" {rough}/>
            <body pos="0.3 0 {A}"><freejoint/>{body}</body>
          </worldbody>
          <contact>
            <pair geom1="ball" geom2="floor" solref="{floor}" {pair}/>
            <pair geom1="ball" geom2="wall" solref="{wall}" {pair}/>
          </contact>
        </mujoco>""")
        data = mujoco.MjData(model)
        data.qvel[:] = [-1, 1, 0, -1 / A, -1 / A, 0]
        begin = time.perf_counter()
        for _ in range(round(1.0 / step)):
            mujoco.mj_step(model, data)
        seconds = time.perf_counter() - begin
        angle = math.degrees(math.atan2(data.qvel[1], data.qvel[0]))
        print(f"  MuJoCo {step:.0e} s    {angle:9.4f} deg  error {abs(angle - ANGLE):8.1e}  {seconds * 1e3:9.3f} ms")


def pybullet_steps() -> None:
    try:
        bullet = importlib.import_module("pybullet")
    except ImportError:
        print("  PyBullet: not installed")
        return
    for step in (1e-2, 1e-3, 1e-4, 1e-5):
        client = bullet.connect(bullet.DIRECT)
        bullet.setGravity(0, 0, -9.80665)
        bullet.setPhysicsEngineParameter(fixedTimeStep=step, numSolverIterations=200, restitutionVelocityThreshold=1e-4)
        floor = bullet.createMultiBody(0, bullet.createCollisionShape(bullet.GEOM_PLANE))
        box = bullet.createCollisionShape(bullet.GEOM_BOX, halfExtents=[0.5, 5, 1])
        wall = bullet.createMultiBody(0, box, basePosition=[-0.5, 0, 0])
        ball = bullet.createMultiBody(
            M, bullet.createCollisionShape(bullet.GEOM_SPHERE, radius=A), basePosition=[0.3, 0, A]
        )
        for body, e in ((floor, 0.0), (wall, 1.0), (ball, 1.0)):
            bullet.changeDynamics(
                body, -1, restitution=e, lateralFriction=1000.0, rollingFriction=0.0, spinningFriction=0.0,
                linearDamping=0.0, angularDamping=0.0,
            )  # fmt: skip
        bullet.changeDynamics(ball, -1, localInertiaDiagonal=[0.4 * M * A * A] * 3)
        bullet.resetBaseVelocity(ball, [-1, 1, 0], [-1 / A, -1 / A, 0])
        begin = time.perf_counter()
        for _ in range(round(1.0 / step)):
            bullet.stepSimulation()
        seconds = time.perf_counter() - begin
        v, _w = bullet.getBaseVelocity(ball)
        angle = math.degrees(math.atan2(v[1], v[0]))
        print(f"  PyBullet {step:.0e} s  {angle:9.4f} deg  error {abs(angle - ANGLE):8.1e}  {seconds * 1e3:9.3f} ms")
        bullet.disconnect(client)


def main() -> None:
    single = carom_shots()
    call_steps()
    many = carom_many()
    paper()
    if not SMALL:
        pooltool_shots(single, many)
        mujoco_steps()
        pybullet_steps()


if __name__ == "__main__":
    run_script(main)
