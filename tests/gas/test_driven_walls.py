"""Pistons, belts and plates."""

from __future__ import annotations

import numpy as np
import pytest
from reference.brute_force_gas import follow
from reference.driven_walls import DrivenRoom, Plane, Plate

from carom import CaromError, Disc, Surface
from carom.gas import Drive, Gas, Session, Species, container, load_gas
from carom.gas.report import report

ROUGH = Surface(0.95, 0.4, 0.3)
SIZE = (6.0, 5.0)


def box(**changed):
    """The walls of the box, of which some are others."""
    found = {
        "left": Plane((0, 0, 0), (1, 0, 0)), "right": Plane((6, 0, 0), (-1, 0, 0)), "bottom": Plane((0, 0, 0), (0, 1, 0)),
        "top": Plane((0, 5, 0), (0, -1, 0)),
    }  # fmt: skip
    return list((found | changed).values())


CASES = {
    "a piston with a weight": (
        {}, {"top": Drive(mass=3.0, force=6.0)}, box(top=Plane((0, 5, 0), (0, -1, 0), mass=3.0, force=6.0)), (0, -1), ROUGH,
    ),
    "two pistons": (
        {}, {"left": Drive(mass=2.0, speed=0.5, force=3.0), "right": Drive(mass=5.0, force=3.0)},
        box(left=Plane((0, 0, 0), (1, 0, 0), 0.5, mass=2.0, force=3.0), right=Plane((6, 0, 0), (-1, 0, 0), mass=5.0, force=3.0)),
        (0, 0), ROUGH,
    ),
    "a belt": (
        {}, {"bottom": Drive(surface_velocity=(1.5, 0.0))}, box(bottom=Plane((0, 0, 0), (0, 1, 0), along=(1.5, 0, 0))), (0, -2),
        ROUGH,
    ),
    "a hopper": (
        {"plates": [(0.0, 3.2, 2.2, 2.0), (6.0, 3.2, 3.8, 2.0)]}, {},
        [*box(), Plate((0.0, 3.2), (2.2, 2.0)), Plate((6.0, 3.2), (3.8, 2.0))], (0, -1), ROUGH,
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", CASES)
def test_the_same_events_as_in_small_steps(name):
    extra, drives, walls, gravity, wall = CASES[name]
    room = container("box", SIZE, **extra)
    pair = Surface(0.95, 0.3, 0.2)
    species = [Species(Disc(0.3, 1.0, 0.4), 5, "a", 1.0, 0.5), Species(Disc(0.2, 0.4, 0.25), 4, "b", 1.0, 0.5)]
    contacts = {("a", "a"): pair, ("a", "b"): pair, ("b", "b"): pair, ("*", "wall"): wall}
    gas = Gas(species, room, contacts=contacts, gravity=gravity, drives=drives, seed=3)
    state = gas.balls()
    kinds = gas.arrays.materials.species[state.species]
    numbers = (wall.restitution, wall.friction, wall.tangential_restitution)
    brute = DrivenRoom(
        state.position, state.velocity, state.spin, kinds["radius"], kinds["mass"], kinds["kappa"], (*SIZE, 1.0),
        np.array([False, False, True]), (*gravity, 0.0), lambda i, j: (0.95, 0.3, 0.2), lambda i, k: numbers, 2, walls=walls,
    )  # fmt: skip
    met = sum(follow(gas, brute) for _ in range(30))
    assert met > 4
    for wall_name, motion in gas.wall_motion().items():
        one = walls[["left", "right", "bottom", "top"].index(wall_name)]
        if not np.any(one.along):
            assert (motion.displacement, motion.speed) == pytest.approx(
                (float(one.at(gas.time)), one.rate(gas.time)), abs=1e-9
            )


def test_a_piston_and_its_weight_have_the_energy_that_the_gas_lacks():
    gas = Gas(
        [Species(Disc(0.3, 1.0), 250)], container("box", (12.0, 40.0)), contacts=Surface(1, 0, -1), gravity=(0, -0.1),
        drives={"top": Drive(mass=30.0, force=40.0)}, seed=2,
    )  # fmt: skip
    start = sum(gas.energy())
    run = gas.run(40_000)
    piston = gas.wall_motion()["top"]
    held = 15.0 * piston.speed**2 - 40.0 * piston.displacement
    assert sum(gas.energy()) + held == pytest.approx(start, rel=1e-11)
    assert run.energy_from_walls["top"] == pytest.approx(-held, rel=1e-10)
    # the mean pressure on a piston that rests on the gas is its weight
    assert gas.run(40_000).wall_pressure["top"] == pytest.approx(40.0 / 12.0, rel=0.05)
    again = Gas.restore(gas.state())
    for one in (gas, again):
        one.run(3000)
    assert gas.wall_motion() == again.wall_motion()


SILO = """
gravity = 1.0
contact_time = 1e-4
[container]
shape = "box"
size = [12.0, 20.0]
periodic = ["y"]
plates = [[0.0, 8.0, 4.0, 5.0], [12.0, 8.0, 8.0, 5.0]]
[[species]]
count = 50
radius = 0.4
[[contacts]]
between = ["*", "*"]
restitution = 0.7
friction = 0.3
[run]
equilibrate = 3000
max_events = 20_000
"""


def test_balls_out_of_a_hopper_are_counted(tmp_path):
    (tmp_path / "silo.toml").write_text(SILO, encoding="utf-8")
    scene = load_gas(tmp_path / "silo.toml")
    assert scene.container.geometry.names == ("left", "right", "plate1", "plate2")
    session = Session(scene)
    before = session.gas.balls().images[:, 1].sum()
    session.run()
    found = report(session)
    flow, passed = found["outflow"], session.measures.series["passed"]
    assert passed[-1] == before - session.gas.balls().images[:, 1].sum()
    assert flow["balls"] == passed[-1] - passed[0] > 8
    assert flow["rate"] == pytest.approx(flow["balls"] / flow["time"])
    assert abs(found["energy_imbalance"]) < 1e-10


@pytest.mark.parametrize(
    ("wall", "drive", "line"),
    [
        ("right", {"speed": 1.0, "temperature": 1.0}, "mass: expected a mass with a speed, got none"),
        (
            "right",
            {"mass": 1.0, "amplitude": 0.1, "frequency": 1.0},
            "mass: expected one way to move, got amplitude and mass",
        ),
        ("right", {"force": 1.0, "temperature": 1.0}, "mass: expected a mass with a force, got none"),
        ("right", {"temperature": 1.0, "mass": 1.0}, "temperature: expected none for a wall that balls move, got 1"),
        ("right", {"mass": -1.0}, "mass: expected a mass in kg, > 0, got -1.0"),
        (
            "scatterer",
            {"mass": 1.0},
            "drives[0].mass: expected a plane wall, got 'scatterer', which is round",
        ),
        (
            "right",
            {"surface_velocity": (1.0, 0.0)},
            "drives[0].surface_velocity: expected a velocity along the wall",
        ),
        ("plate1", {"mass": 1.0}, "drives[0].mass: expected a plane wall, got 'plate1', a plate"),
        (
            "right",
            {},
            "amplitude: expected an amplitude > 0, a temperature, a mass or a surface_velocity, got none of them",
        ),
    ],
)
def test_bad_drives_have_one_line_each(wall, drive, line):
    room = container("box", (6.0, 6.0), obstacles=[(3.0, 3.0, 1.0)], plates=[(1.0, 1.0, 2.0, 1.0)])
    with pytest.raises(CaromError) as error:
        Gas([Species(Disc(0.1, 1.0), 5)], room, contacts=Surface(1, 0, -1), drives={wall: Drive(**drive)})
    assert line in str(error.value)
    assert len(error.value.faults) == 1


@pytest.mark.parametrize(
    ("plates", "line"),
    [
        ([(1, 1, 1, 1)], "plates[0]: expected x1, y1, x2, y2 of two places"),
        ([(1, 1, 2)], "plates[0]: expected x1, y1, x2, y2 of two places"),
    ],
)
def test_bad_plates_have_one_line_each(plates, line):
    with pytest.raises(CaromError) as error:
        container("box", (6.0, 6.0), plates=plates)
    assert line in str(error.value)
