"""Balls that bounce, roll, meet in a cradle and in a rack, by engines that install here: judged by laws that hold for every engine.

    python campaigns/engines_judged.py [--python PYTHON] [--only roll]

MuJoCo, PyBullet, pymunk and pooltool are run by PYTHON, or in a virtual environment of their own (build/engines), which is made
first; carom plays the same. Their frames go to docs/data/engines, a file per engine and situation, and are judged. With --small the
files that are there are judged, and no engine is needed.
"""

from __future__ import annotations

import csv
import math
import os
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from campaign import ROOT, campaign

import carom
from carom.tracks import judge

FILES = ROOT / "docs" / "data" / "engines"
# (of pooltool 0.6.0 without its own pin of panda3d: campaigns/pooltool_shots.py)
NEEDED = (
    "mujoco", "pybullet", "pymunk", "attrs", "cattrs", "click", "h5py", "msgpack-numpy", "numpy-quaternion",
    "panda3d==1.10.16", "panda3d-gltf", "panda3d-simplepbr", "pillow", "pyyaml", "scipy",
)  # fmt: skip
RADIUS, MASS, G = 0.028575, 0.17, 9.80665
RATE = 240
DIGITS = 9  # after the point, in m: a nanometre
Rows = Iterator[tuple[float, str, Sequence[float], Sequence[float]]]  # time, ball, place, spin


@dataclass(frozen=True)
class Situation:
    """Balls with places and velocities (m, m/s), and the surfaces that each engine is asked for."""

    duration: float
    places: tuple[tuple[float, float, float], ...]
    velocity: tuple[float, float, float]
    """Of the first ball; the others are at rest."""
    floor: tuple[float, float] = (0.0, 0.2)
    """Restitution and friction."""
    balls: tuple[float, float] = (0.95, 0.06)
    names: tuple[str, ...] = field(init=False)

    def __post_init__(self) -> None:
        """Name the balls."""
        object.__setattr__(self, "names", tuple(f"{k}" for k in range(len(self.places))))


STEP = 2 * RADIUS
RACK = tuple((row * STEP * math.sqrt(0.75), (k - row / 2) * STEP, RADIUS) for row in range(3) for k in range(row + 1))
SITUATIONS = {
    "bounce": Situation(1.2, ((0.0, 0.0, 0.3),), (0.5, 0.0, 0.0), floor=(0.8, 0.2)),
    "roll": Situation(0.6, ((0.0, 0.0, RADIUS),), (1.0, 0.0, 0.0)),
    "cradle": Situation(
        0.4,
        ((-0.1 - STEP, 0.0, RADIUS), *((k * STEP, 0.0, RADIUS) for k in range(4))),
        (1.0, 0.0, 0.0),
        (0.0, 0.0),
        (1.0, 0.0),
    ),
    "rack": Situation(0.4, ((-0.2, 0.003, RADIUS), *RACK), (4.0, 0.0, 0.0)),
}


# --- engines --------------------------------------------------------------------------------------------------------------


def by_carom(given: Situation) -> Rows:
    """Play by events, in closed form."""
    floor = carom.Floor(restitution=given.floor[0], friction=given.floor[1])
    balls = [
        carom.SceneBall(
            radius=RADIUS, mass=MASS, position=place, velocity=given.velocity if k == 0 else (0, 0, 0), name=name
        )
        for k, (name, place) in enumerate(zip(given.names, given.places, strict=True))
    ]
    contact = carom.BallContact(restitution=given.balls[0], friction=given.balls[1])
    run = carom.simulate(
        carom.Scene(floor=floor, balls=balls, ball_contact=contact, run=carom.Run(duration=given.duration))
    )
    times = np.arange(round(given.duration * RATE) + 1) / RATE
    states = run.at(times)
    for k, t in enumerate(times.tolist()):
        yield from ((t, name, states.position[k, i], states.spin[k, i]) for i, name in enumerate(given.names))


def by_mujoco(given: Situation) -> Rows:
    """Play with MuJoCo's own step of 2 ms; restitution by the damping of the stiffest contact that the step allows."""
    import mujoco

    step = 0.002

    def contact(names: tuple[str, str], restitution: float, friction: float) -> str:
        stiffness = 1 / (4 * step * step)
        ratio = 1.0 if restitution == 0 else -math.log(restitution) / math.hypot(math.pi, math.log(restitution))
        spring = "0.02 1" if restitution == 0 else f"{-stiffness} {-2 * ratio * math.sqrt(stiffness)}"
        rough = max(friction, 1e-9)
        return f'<pair geom1="{names[0]}" geom2="{names[1]}" solref="{spring}" friction="{rough} {rough} 0 0 0" condim="3"/>'

    names = given.names
    pairs = [contact(("floor", name), *given.floor) for name in names]
    pairs += [contact((a, b), *given.balls) for i, a in enumerate(names) for b in names[i + 1 :]]
    bodies = "".join(
        f'<body pos="{x} {y} {z}"><freejoint/><geom name="{name}" type="sphere" size="{RADIUS}" mass="{MASS}"/></body>'
        for name, (x, y, z) in zip(names, given.places, strict=True)
    )
    model = mujoco.MjModel.from_xml_string(f"""
    <mujoco><option timestep="{step}" gravity="0 0 {-G}" cone="elliptic"/>
    <worldbody><geom name="floor" type="plane" size="5 5 .1"/>{bodies}</worldbody>
    <contact>{"".join(pairs)}</contact></mujoco>""")
    data = mujoco.MjData(model)
    data.qvel[:3] = given.velocity
    every = 2  # steps between frames: 250 frames per second
    for k in range(round(given.duration / step / every) + 1):
        mujoco.mj_kinematics(model, data)
        for i, name in enumerate(names):
            # (the spin of a free joint is along the axes of the body)
            spin = data.xmat[i + 1].reshape(3, 3) @ data.qvel[6 * i + 3 : 6 * i + 6]
            yield k * every * step, name, data.qpos[7 * i : 7 * i + 3].copy(), spin
        mujoco.mj_step(model, data, every)


def by_pybullet(given: Situation) -> Rows:
    """Play with PyBullet's own step of 1/240 s; it multiplies the numbers of the two that touch."""
    import pybullet

    client = pybullet.connect(pybullet.DIRECT)
    pybullet.setGravity(0, 0, -G)
    sphere = pybullet.createCollisionShape(pybullet.GEOM_SPHERE, radius=RADIUS)
    floor = pybullet.createMultiBody(0, pybullet.createCollisionShape(pybullet.GEOM_PLANE))
    balls = [pybullet.createMultiBody(MASS, sphere, basePosition=place) for place in given.places]
    alone = len(balls) == 1
    own = (1.0, 1.0) if alone else (math.sqrt(given.balls[0]), math.sqrt(given.balls[1]))
    shares = [wanted / mine if mine else 0.0 for wanted, mine in zip(given.floor, own, strict=True)]
    for body, (restitution, friction) in [(floor, shares), *((ball, own) for ball in balls)]:
        pybullet.changeDynamics(
            body, -1, restitution=restitution, lateralFriction=friction, rollingFriction=0, spinningFriction=0,
            linearDamping=0, angularDamping=0,
        )  # fmt: skip
    for ball in balls:
        pybullet.changeDynamics(ball, -1, localInertiaDiagonal=[0.4 * MASS * RADIUS**2] * 3)
    pybullet.resetBaseVelocity(balls[0], given.velocity, (0, 0, 0))
    for k in range(round(given.duration * RATE) + 1):
        for ball, name in zip(balls, given.names, strict=True):
            yield k / RATE, name, pybullet.getBasePositionAndOrientation(ball)[0], pybullet.getBaseVelocity(ball)[1]
        pybullet.stepSimulation()
    pybullet.disconnect(client)


def by_pymunk(given: Situation) -> Rows:
    """Play in a plane with steps of 1/240 s: upright with a floor, the rack from above and without one."""
    import pymunk

    upright = len({y for _x, y, _z in given.places}) == 1
    space = pymunk.Space()
    space.gravity = (0, -G) if upright else (0, 0)
    own = (math.sqrt(given.balls[0]), math.sqrt(given.balls[1])) if len(given.places) > 1 else (1.0, 1.0)
    if upright:
        floor = pymunk.Segment(space.static_body, (-5, -0.1), (5, -0.1), 0.1)
        floor.elasticity, floor.friction = (
            wanted / mine if mine else 0.0 for wanted, mine in zip(given.floor, own, strict=True)
        )
        space.add(floor)
    bodies = []
    for x, y, z in given.places:
        body = pymunk.Body(MASS, 0.4 * MASS * RADIUS**2)  # a sphere's
        body.position = (x, z) if upright else (x, y)
        shape = pymunk.Circle(body, RADIUS)
        shape.elasticity, shape.friction = own
        space.add(body, shape)
        bodies.append(body)
    bodies[0].velocity = (given.velocity[0], 0)
    for k in range(round(given.duration * RATE) + 1):
        for body, name in zip(bodies, given.names, strict=True):
            (x, second), turn = body.position, body.angular_velocity
            yield (
                k / RATE,
                name,
                (x, 0, second) if upright else (x, second, RADIUS),
                (0, -turn, 0) if upright else (0, 0, turn),
            )
        space.step(1 / RATE)


def by_pooltool(given: Situation) -> Rows:
    """Play on a large table of pooltool's: by events; its balls do not leave the table."""
    import pooltool as pt

    middle = (2.0, 2.0)
    table = pt.Table.from_table_specs(pt.objects.BilliardTableSpecs(l=4.0, w=4.0))
    numbers = {"m": MASS, "R": RADIUS, "u_s": 0.2, "e_b": given.balls[0], "u_b": given.balls[1] or 0.05, "g": G}
    balls = {
        name: pt.Ball.create(name, xy=(x + middle[0], y + middle[1]), **numbers)
        for name, (x, y, _z) in zip(given.names, given.places, strict=True)
    }
    balls["0"].state.rvw[1] = given.velocity
    balls["0"].state.s = pt.constants.sliding
    shot = pt.System(cue=pt.Cue(cue_ball_id="0"), table=table, balls=balls)
    pt.simulate(shot, inplace=True, t_final=given.duration)
    pt.continuize(shot, dt=1 / RATE, inplace=True)
    frames = {name: ball.history_cts.vectorize() for name, ball in shot.balls.items()}
    for k in np.flatnonzero(frames["0"][2] <= given.duration + 1e-9).tolist():
        for name, (rvw, _states, times) in frames.items():
            yield times[k], name, rvw[k, 0] - (*middle, 0), rvw[k, 2]


ENGINES: dict[str, Callable[[Situation], Rows]] = {
    "carom": by_carom, "MuJoCo": by_mujoco, "PyBullet": by_pybullet, "pymunk": by_pymunk, "pooltool": by_pooltool,
}  # fmt: skip


def plays(engine: str, situation: str) -> bool:
    """Return whether an engine has a situation: pooltool's balls do not leave the table, and its touching rows do not end.

    (pooltool 0.6.0 was ended after 60 s in a cradle whose balls touch; with gaps of 10 micrometres places become NaN.)
    """
    return engine != "pooltool" or situation in ("roll", "rack")


def file_of(engine: str, situation: str) -> Path:
    """Return where the frames of an engine are."""
    return FILES / f"{engine.lower()}_{situation}.csv"


def play(engines: Sequence[str], situations: Sequence[str]) -> None:
    """Play in an interpreter that has the engines, and save the frames."""
    FILES.mkdir(parents=True, exist_ok=True)
    for engine in engines:
        for situation in situations:
            if plays(engine, situation):
                with file_of(engine, situation).open("w", encoding="utf-8", newline="") as file:
                    writer = csv.writer(file, lineterminator="\n")
                    writer.writerow(["t", "ball", "x", "y", "z", "wx", "wy", "wz"])
                    for t, name, place, spin in ENGINES[engine](SITUATIONS[situation]):
                        numbers = [round(float(number), DIGITS) + 0.0 for number in (*place, *spin)]
                        writer.writerow([round(t, DIGITS), name, *numbers])


def prepared() -> str:
    """Return the interpreter of an environment with carom and the engines; it is made if it is not there."""
    folder = ROOT / "build" / "engines"
    python = folder / "bin" / "python"
    if not python.exists():
        subprocess.run([sys.executable, "-m", "venv", folder], check=True)
        pip = [python, "-m", "pip", "-q", "install"]
        subprocess.run([*pip, ROOT, *NEEDED], check=True)
        subprocess.run([*pip, "--no-deps", "pooltool-billiards==0.6.0"], check=True)
    return str(python)


# --- judged ---------------------------------------------------------------------------------------------------------------


def judged(engine: str, situation: str) -> Any:
    """Judge the frames of an engine."""
    given = SITUATIONS[situation]
    return judge(
        file_of(engine, situation),
        radius=RADIUS,
        mass=MASS,
        gravity=G,
        friction=given.balls[1],
        floor_friction=given.floor[1],
    )


def main(words: Sequence[str] | None = None) -> None:
    """A line for each engine and situation."""
    options = {
        "python": {"help": "interpreter with carom's dependencies and the engines"},
        "play": {"action": "store_true", "help": "save frames in an interpreter that has the engines"},
    }
    with campaign("engines_judged", __doc__, words, count=1, small=1, **options) as run:
        wanted = [name for name in SITUATIONS if name.startswith(run.given.only)]
        if run.given.play:
            play(list(ENGINES), wanted)
            return
        if not run.small:
            paths = os.pathsep.join([str(ROOT / "src"), str(ROOT / "campaigns")])
            command = [
                run.given.python or prepared(),
                "-W",
                "ignore",
                __file__,
                "1",
                "--play",
                "--only",
                run.given.only,
            ]
            subprocess.run(command, check=True, env={**os.environ, "PYTHONPATH": paths}, stdout=subprocess.DEVNULL)
        for situation in wanted:
            for engine in ENGINES:
                if plays(engine, situation):
                    found = judged(engine, situation)
                    said = ", ".join(
                        f"{law} {len(found.of(law))} of {n}" for law, n in found.checked.items() if found.of(law)
                    )
                    run.say(f"{situation}, {engine}: {said or 'no violation'}")


if __name__ == "__main__":
    main()
