"""Everything public can be pickled and copied, so that scenes, runs, fits and gases pass between processes."""

from __future__ import annotations

import copy
import functools
import pickle
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import sympy as sp
from reference.public_names import public_classes
from sympy.physics.mechanics import Point, ReferenceFrame, dynamicsymbols

import carom
from carom import billiards, data, derive, fitting, gas, scene, sweeps, tracks
from carom.fitting import AirFit, GasFit
from carom.fitting.shots import drawn_films
from carom.fitting.tracks import fit_tracks
from carom.gas.results import LayerAverages
from carom.interop import pooltool
from carom.plot import path_after_wall

BALL, SURFACE = carom.Ball(radius=0.03, mass=0.2), carom.Surface(0.8, 0.2)
STATE = carom.rolling(BALL, velocity=(-1.0, 1.0, 0.0))


@functools.cache
def a_scene() -> Any:
    wall = scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.85, friction=0.2)
    balls = [
        carom.SceneBall(radius=0.03, mass=0.2, position=(0.5, 0), velocity=(-2, 1), rolling=True, name="white"),
        carom.SceneBall(radius=0.03, mass=0.2, position=(0.3, 0.3)),
    ]
    return carom.Scene(floor=carom.Floor(friction=0.2), walls=[wall], balls=balls, run=carom.Run(duration=1))


def scene_in_air() -> Any:
    made: Any = carom.Scene
    return made(
        air={},
        balls=[{"radius": 0.02, "position": (0, 0, 1), "mass": 0.0027, "drag": "table-tennis"}],
        run={"duration": 1},
    )


@functools.cache
def a_run() -> Any:
    return carom.simulate(a_scene())


@functools.cache
def a_film() -> Any:
    """A ball in flight that bounces at t = 0.1 s, filmed at 200 per second."""
    t = np.arange(50) / 200
    before, after = 0.4 - 3 * t - 4.9 * t * t, 0.051 + 2.4 * (t - 0.1) - 4.9 * (t - 0.1) ** 2
    y = np.where(t < 0.1, before, after) + 1e-5 * np.cos(7.0 * np.arange(50))
    return tracks.Track("film", t, np.stack([0.1 + t, y], axis=-1))


def a_film_from_above() -> Any:
    """The same as a file, and the run of a scene as a track, with its fit."""
    t = np.arange(0.0, 0.6, 1 / 60)
    track = tracks.Track("ball", t, np.array([a_run().at(time).position[0, :2] for time in t]))
    found = tracks.measure([track], tracks.Settings(radius=0.03, view="above", noise=1e-4))
    return [found, fit_tracks(found, fitting.Setting(radius=0.03, noise=1e-4), ["conventional"])]


def a_collision_from_above() -> Any:
    """A ball that strikes one at rest, filmed from above."""
    t = np.arange(0.0, 0.6, 1 / 60)
    ball = {"radius": 0.03, "mass": 0.2}
    balls = [
        {**ball, "position": (0.0, 0.0), "velocity": (1.0, 0.0), "rolling": True},
        {**ball, "position": (0.3, 0.01)},
    ]
    run = carom.simulate(carom.Scene(balls=balls, walls=[], floor={"friction": 0.2}))
    film = [tracks.Track(name, t, np.asarray(run.at(t).position)[:, k, :2]) for k, name in enumerate("AB")]
    return tracks.measure_pairs(tracks.measure(film, tracks.Settings(radius=0.03, view="above", noise=1e-4)))


def a_derivation() -> list[Any]:
    """A rod that is caught by a hook, and a contact of a ball with the floor."""
    m, length = sp.symbols("m l", positive=True)
    y, theta = dynamicsymbols("y theta")
    energy = m * y.diff() ** 2 / 2 + m * length**2 / 3 * theta.diff() ** 2 / 2
    motion = derive.ImpulsiveMotion(energy, [y, theta], imposed={"hook": y.diff() - length * theta.diff()})
    frame, point = ReferenceFrame("N"), Point("P")
    point.set_vel(frame, y.diff() * frame.y)
    return [motion, motion.solve(), derive.contact_at("floor", point, frame, (frame.y, frame.x), restitution=1)]


@functools.cache
def rebounds() -> Any:
    v = [1.0, 2.0, 3.0, 4.0]
    columns = {"v_n_in": v, "v_t_in": v, "spin_in": [0.0] * 4, "v_n_out": [0.81, 1.59, 2.42, 3.18],
               "v_t_out": [0.71, 1.43, 2.15, 2.85], "sigma_v_n_out": 0.02, "sigma_v_t_out": 0.02}  # fmt: skip
    return data.make_rebounds("planar", columns)


def a_gas_scene() -> Any:
    return gas.GasScene(
        container={"shape": "periodic", "size": (6, 6, 6)}, species=[{"name": "a", "count": 30, "radius": 0.5}],
        contacts=[{"between": ("a", "a"), "restitution": 0.9, "friction": 0.1}], run={"max_events": 300, "seed": 1},
    )  # fmt: skip


def a_session() -> Any:
    session = gas.Session(a_gas_scene())
    session.run()
    return session


FILES = Path(__file__).parent / "interop" / "files"
TWO_STARTS = [[(-2, 1, 0), (0, 0, 0)], [(-1, 1, 0), (0, 0, 0)]]
CIRCLE = billiards.circle()
START = billiards.Start((0.2, 0.1), (0.8, 0.3), 0.5)
SHAPES: dict[str, dict[str, Any]] = {
    "Arc": {"center": (0, 0), "radius": 1, "from_angle": 0, "to_angle": 90},
    "Box": {"center": (0, 0, 0), "size": (1, 1, 1)},
    "Cylinder": {"point": (0, 0, 0), "radius": 1},
    "Polygon": {"points": [(0, 0), (1, 0), (0, 1)]},
    "Segment": {"start": (0, 0), "end": (1, 0)},
    "Sphere": {"center": (0, 0, 0), "radius": 1},
    "Stadium": {"straight": 1, "radius": 1},
    "Strip": {"point": (0, 0, 0), "normal": (1, 0, 0), "width": 1},
    "Wedge": {"apex": (0, 0, 0), "from_angle": 0, "to_angle": 60},
}


# What is made here reaches every public class, in itself or in what it holds (a test says which are missing).
def sinai_of_radius(radius: float) -> dict[str, Any]:
    return {"table": billiards.sinai(radius)}


def a_whole_shot() -> Any:
    """A drawn film of a shot, fitted with the numbers of its table held."""
    films, scenes = drawn_films(1, seed=5, until=1.0)
    ranking = carom.fit_shots(films, scenes[0], free=[])
    return [ranking, ranking.best.shots[0].events()]


def a_tracked_film() -> carom.TrackedFilm:
    """Three frames of a ball that falls."""
    places, seen = np.array([[5.0, 1.0], [5.0, 2.0], [5.0, 5.0]]), np.ones(3, bool)
    return carom.TrackedFilm(
        Path("fall.mp4"), np.arange(3) / 60, {"ball": places}, 2.0, np.ones(3), ~seen, 0.002, 1.0,
        np.zeros((8, 12, 3), np.uint8), {"ball": 60 * places}, used={"ball": seen},
    )  # fmt: skip


EXAMPLES: dict[str, Callable[[], list[Any]]] = {
    "rolling": lambda: [
        run := billiards.roll(billiards.surfaces.bowl(1.0), (0, 0, -0.9), (1.0, 0, 0), ball=carom.Ball(0.1, 1.0)),
        run.at([0.0, 0.1]),
    ],
    "periodic orbits": lambda: [
        found := billiards.periodic_orbits(billiards.circle(), 2, law="mirror", starts=20),
        found[0],
        across := billiards.refine_orbit(billiards.sinai(0.33), ((0.5, 0.0), (1.0, 0.0), 0.0), 2),
        billiards.continue_orbit(across, sinai_of_radius, 0.33, 0.34),
        billiards.manifold(
            billiards.periodic_orbits(billiards.ellipse(1.25), 2, law="mirror", starts=30)[-1], length=0.1
        ),
        billiards.rotation_number(billiards.orbit(billiards.circle(), ((0.2, 0.1), (0.8, 0.3), 0.5), 60)),
    ],
    "impacts": lambda: [
        BALL,
        SURFACE,
        STATE,
        carom.impact(BALL, STATE, normal=(1, 0, 0), surface=SURFACE),
        carom.two_step(BALL, STATE, wall=SURFACE, floor=SURFACE),
        carom.Cue(),
        carom.strike(BALL, speed=2.0, azimuth_deg=0.0),
        carom.collide(BALL, STATE, BALL, carom.State((0, 0, 0), (0, 0, 0)), (1, 0, 0), SURFACE),
        carom.domenech(BALL),
    ],
    "laws": lambda: [
        carom.compare(),
        m := carom.incoming(),
        *carom.LAWS.values(),
        path_after_wall(m, carom.LAWS["maw"].answer(m)),
    ],
    "whole shots": a_whole_shot,
    "parts of longer fits and runs": lambda: [
        AirFit(
            {"balls.0.drag": 0.5},
            {"balls.0.drag": 0.01},
            30,
            4e-3,
            (0.2, 1.0),
            carom.load_scene("carom"),
            np.ones(30),
            {"speed": np.ones(30)},
        ),
        gas.TransportCoefficients(*3 * [gas.Coefficient(0.2, 0.01, np.ones(3), np.ones(3))]),
        gas.enskog(0.1),
        gas.LayerProfiles(*2 * [LayerAverages("z", *7 * [np.ones(3)])]),
        gas.DiffusionCoefficients(*2 * [gas.DiffusionCoefficient(1.0, 0.1, 1.0, 0.1, *3 * [np.ones(3)])]),
        gas.ShearRun(1.0, 0.2, 0.1, 5.0),
        gas.GasSurface(restitution=0.9, friction=0.1),
    ],
    "judgements": lambda: [
        tracks.judge({"t": np.arange(9.0), "x": np.arange(9.0), "y": np.zeros(9), "z": 1 + np.arange(9.0)}, radius=0.1)
    ],
    "scenes": lambda: [
        a_scene(),
        carom.load_scene("pool-9ft"),
        scene_in_air(),
        *(getattr(scene, k)(restitution=1, friction=0, **v) for k, v in SHAPES.items()),
    ],
    "runs": lambda: [
        a_run(),
        a_run().events,
        a_run().events[0],
        a_run().sensitivity(["balls.0.velocity"]),
        carom.simulate_many(a_scene(), velocity=TWO_STARTS),
        carom.sensitivities(a_scene(), "balls.0.velocity", velocity=TWO_STARTS),
    ],
    "aims": lambda: [
        carom.aim(a_scene(), ["balls.white.velocity"], {"hit": 1}, seed=1),
        carom.aim_windows(a_scene(), ["balls.white.velocity"], {"hit": 1}, speeds=2, directions=90),
    ],
    "sweeps": lambda: [
        carom.Space(a_scene(), {"walls.0.restitution": [0.1, 0.2]}),
        carom.sweep(carom.Space(a_scene(), {"walls.0.restitution": [0.1]}), keep=["final.position"]),
        sweeps.ImpactCase(),
        [scene.figure(one) for one in ("stadium", "ellipse", "cylinder:regular:sides=5")],
        [scene.SegmentPiece((0, 0), (1, 0)), scene.ArcPiece((0, 0), 1.0, 0.0, 90.0), scene.EllipsePiece((1.0, 0.5))],
        sweeps.OrbitCase(table="circle"),
    ],
    "billiards": lambda: [
        CIRCLE,
        START,
        (found := billiards.orbit(CIRCLE, START, 30)),
        carom.orbit("circle", 5, lyapunov=True),
        billiards.lyapunov(CIRCLE, START, 30),
        billiards.tangent_map(CIRCLE, START),
        billiards.caustics(found),
        billiards.section(found),
        (left := billiards.escape(CIRCLE, billiards.starts(CIRCLE, 50), 30, holes=[(0.0, 1.0)])),
        left.decay(),
        billiards.mean_flight(CIRCLE),
        billiards.corridors(billiards.sinai()),
        billiards.diffusion(billiards.sinai(), 2, 200),
        billiards.recurrence(found, [(0.0, 1.0)]),
        billiards.words(found, 2),
        billiards.uniformity(CIRCLE, 10, 10),
        billiards.drift(billiards.orbit(billiards.strip(), START, 30)),
        billiards.sinai(),
        billiards.regular(5),
        billiards.cylinder(CIRCLE),
        billiards.sphere(),
        billiards.box(),
        billiards.wedge(60),
        billiards.ellipse(),
        billiards.stadium(),
        billiards.periodic_strip(),
    ],
    "data": lambda: [
        data.PredictSummary("in.csv", "out.csv", "two-step", rows=10, answered=8),
        *pooltool.read(FILES / "bank.json"),
        rebounds(),
        data.published_rebounds("kharaz2001"),
        data.PredictSettings(carom.LAWS["contact"]),
    ],
    "fits": lambda: [
        ranking := fitting.fit_laws(rebounds(), fitting.Setting(radius=0.02), ["sticking", "mirror"], bootstrap=0),
        ranking.predict([[6.0, 1.0, 0.0]]),
        GasFit({"restitution": 0.9}, {"restitution": 0.01}, 30, ranking),
        fitting.Setting(0.03),
        fitting.RankingsBy("surface"),
        fitting.Outlier("line 7", 3.0, "far"),
    ],
    "films": lambda: [
        *a_film_from_above(),
        *a_collision_from_above(),
        tracks.read_tracks(FILES.parents[1] / "tracks" / "files" / "tracker_single.txt"),
        tracks.Settings(radius=0.02),
        tracks.Calibration(),
        tracks.measure([a_film()], tracks.Settings(radius=0.02)),
        a_tracked_film(),
    ],
    "derivations": a_derivation,
    "gases": lambda: [
        a_gas_scene(),
        *(found := carom.simulate_gas(a_gas_scene())),
        found[0].balls(),
        a_session(),
        sweeps.gas_ensemble(a_gas_scene(), 2),
        gas.Species(BALL, 5),
        gas.Thermostat(temperature=1.0, rate=1.0),
        gas.EarlyEnd("at rest", 1.0),
        gas.Drive(amplitude=1.0, frequency=1.0),
    ],
    "games": lambda: [
        *(carom.env.CaromEnv(name) for name in ("ThreeCushion", "EightBall", "TableTennisReturn")),
        carom.env.CaromVectorEnv("SumToThree", 2),
        *(carom.env.two_players(name) for name in ("ThreeCushion", "AirHockey")),
    ],
}


@functools.cache
def examples(name: str) -> list[Any]:
    return EXAMPLES[name]()


def parts(thing: Any, seen: dict[int, Any]) -> Iterator[Any]:
    """A thing and all that it holds."""
    if id(thing) in seen or isinstance(thing, (np.ndarray, str, bytes, type)):
        return
    seen[id(thing)] = thing
    yield thing
    held = list(thing.values()) if isinstance(thing, dict) else list(thing) if isinstance(thing, (list, tuple)) else []
    for one in [*held, *getattr(thing, "__dict__", {}).values()]:
        yield from parts(one, seen)


def same(a: Any, b: Any) -> bool:
    """Whether two things hold the same numbers and texts: arrays and records; of what has neither, whether it is of one class."""
    if isinstance(a, np.ndarray):
        return a.dtype == b.dtype and a.tobytes() == b.tobytes()
    if isinstance(a, (list, tuple)):
        return len(a) == len(b) and all(map(same, a, b))
    if isinstance(a, dict):  # (those of SymPy have no order of their own)
        keys = dict(zip(map(str, b), b, strict=True))
        return {str(key) for key in a} == set(keys) and all(same(a[key], b[keys[str(key)]]) for key in a)
    if isinstance(a, (str, int, float, type(None))):
        return repr(a) == repr(b)
    # (SymPy makes a class of every function of time)
    return a == b or sp.expand(a - b) == 0 if isinstance(a, sp.Expr) else type(a).__name__ == type(b).__name__


@pytest.mark.parametrize("name", EXAMPLES)
@pytest.mark.slow(keep=3)
def test_results_and_what_they_are_made_of_are_pickled_and_copied(name: str) -> None:
    for thing in examples(name):
        for way in (lambda x: pickle.loads(pickle.dumps(x)), copy.deepcopy, copy.copy):
            other = way(thing)
            assert type(other) is type(thing), thing
            state, found = (getattr(one, "__dict__", {}) for one in (thing, other))
            assert all(same(state[key], found[key]) for key in found), (thing, way)


def test_every_public_class_is_among_the_examples() -> None:
    seen: dict[int, Any] = {}
    reached = {type(part) for name in EXAMPLES for thing in examples(name) for part in parts(thing, seen)}
    left = {one.__name__ for one in public_classes() if one not in reached}
    # an open file; a deprecated name; bases of figures and pieces
    assert left == {"Snapshots", "Figure", "PlaneFigure", "Piece"}


def test_no_record_refuses_to_be_compared() -> None:
    seen: dict[int, Any] = {}
    records = [part for name in EXAMPLES for thing in examples(name) for part in parts(thing, seen)]
    public = {type(part).__name__ for part in records} & {one.__name__ for one in public_classes()}
    for record in records:
        if type(record).__name__ in public:
            # (a copy has arrays of its own, so that these are compared)
            assert (record == copy.deepcopy(record)) in (True, False)
            assert record in [record]


def test_pickled_laws_are_those_of_the_registry_and_custom_ones_go_along() -> None:
    law = carom.wall_law(carom.Card("soft", "Halves the speed.", (), "An example.", "", ""), soft)
    again = pickle.loads(pickle.dumps(law))
    made, expected = (carom.compare(carom.incoming(friction=0.0), [one])["soft"] for one in (again, law))
    assert pickle.loads(pickle.dumps(carom.LAWS["maw"])) is carom.LAWS["maw"]
    assert made.angle_after_wall_deg == expected.angle_after_wall_deg


def soft(v: Any, w: Any, n: Any, a: float, kappa: float, e: float, mu: float, beta: float) -> Any:
    return (-0.5 * v[0], v[1], v[2]), w
