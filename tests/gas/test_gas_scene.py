"""The scene of a gas: what it says, and all that can be wrong with one."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from reference.gases import MIXED, ROUGH

import carom
from carom import Ball, CaromError, Surface, simulate_gas
from carom.gas import Gas, Species
from carom.gas.containers import GasContainer
from carom.gas.report import report
from carom.gas.scene import GasScene, GasSettings, gas_text, is_gas, load_gas
from carom.gas.session import Session, build
from carom.gas.species import GasContact


def load(folder: Path, text: str):
    path = folder / "gas.toml"
    path.write_text(text)
    return load_gas(path)


def faults(folder: Path, text: str) -> list[str]:
    with pytest.raises(CaromError) as found:
        build(load(folder, text), str(folder / "gas.toml"))
    return [fault.removeprefix(f"{folder / 'gas.toml'}: ") for fault in found.value.faults]


def test_a_file_and_python_say_the_same(tmp_path):
    scene = GasScene(
        container=GasContainer(shape="periodic", size=(8, 7.5, 7)),
        species=(Species(count=200, radius=0.5, inertia=0.4, temperature_rotational=0.5),),
        contacts=(GasContact(between=("a", "a"), restitution=1, friction=math.inf, tangential_restitution=1),),
        run=GasSettings(equilibrate=5000, max_events=60_000, seed=1),
    )
    assert load(tmp_path, ROUGH) == scene
    parts = {"container": (8, 7.5, 7), "species": scene.species[0], "run": scene.run}
    assert GasScene(**parts, contacts={("a", "a"): Surface(1, math.inf, 1)}) == scene
    assert scene.packing_fraction == pytest.approx(200 * math.pi / 6 / (8 * 7.5 * 7))
    assert "200 balls, periodic 8 x 7.5 x 7, packing fraction 0.2493, 60,000 events after 5,000" in scene.describe()


def test_what_is_left_out(tmp_path):
    text = ROUGH.replace("inertia = 0.4\n", "").replace("equilibrate = 5_000\n", "").replace("mass = 1.0\n", "")
    scene = load(
        tmp_path, text.replace("tangential_restitution = 1.0\n", "").replace("temperature_rotational = 0.5", "")
    )
    assert (scene.cools, scene.equilibrate) == (True, 0)  # (its contacts stop the slip: there is no equilibrium)
    warm = load(tmp_path, ROUGH.replace("equilibrate = 5_000\n", ""))
    assert (warm.cools, warm.equilibrate) == (False, 40 * 200)
    gas = build(scene)
    assert gas.arrays.materials.species[0].tolist() == (0.5, 1.0, 0.4)
    assert gas.arrays.materials.pairs[0]["beta"] == 0
    assert gas.energy()[:2] == (pytest.approx(300, rel=1e-12), pytest.approx(300, rel=1e-12))


def test_discs_walls_gravity_and_seeds(tmp_path):
    scene = load(tmp_path, MIXED)
    gas = build(scene)
    one = gas.arrays.system[0]
    assert one["dimensions"] == 2
    assert one["periodic"].tolist()[:2] == [1, 0]
    assert one["gravity"].tolist() == [0, -0.2, 0]
    assert one["contact_time"] == 1e-6
    assert gas.arrays.materials.species["kappa"].tolist() == [0.5, 1.0]
    balls = gas.balls()
    assert not balls.spin[balls.species == 1].any()
    again, other = build(load(tmp_path, MIXED)), build(load(tmp_path, MIXED.replace("seed = 3", "seed = 4")))
    assert again.balls().position.tobytes() == balls.position.tobytes()
    assert again.balls().velocity.tobytes() == balls.velocity.tobytes()
    assert other.balls().position.tobytes() != balls.position.tobytes()
    vector = load(tmp_path, MIXED.replace("gravity = 0.2", "gravity = [0.1, -0.3]"))
    assert vector.gravity_vector == (0.1, -0.3)


def test_units(tmp_path):
    text = ROUGH.replace("radius = 0.5", 'radius = "0.5 mm"').replace(
        "size = [8.0, 7.5, 7.0]", 'size = ["8 mm", 0.0075, "0.7 cm"]'
    )
    scene = load(
        tmp_path, text.replace("mass = 1.0", 'mass = "1.3 mg"').replace("temperature = 1.0", 'temperature = "2 nJ"')
    )
    assert scene.container.size == (0.008, 0.0075, 0.007)
    assert (scene.species[0].radius, scene.species[0].mass, scene.species[0].temperature) == (5e-4, 1.3e-6, 2e-9)


def test_the_scene_to_begin_with_runs(tmp_path):
    gas = build(load(tmp_path, gas_text()))
    assert len(gas.balls().species) == 1000
    assert is_gas(tmp_path / "gas.toml")
    assert not is_gas(tmp_path / "none.toml")


@pytest.mark.parametrize(
    "path", sorted((Path(__file__).parents[2] / "docs" / "scenes").glob("*.toml")), ids=lambda path: path.stem
)
def test_the_gases_of_the_docs_are_sound(path):
    if is_gas(path):
        session = Session(
            carom.replaced(load_gas(path), {"run.max_events": 400, "run.duration": None, "run.equilibrate": 100})
        )
        session.run()
        found = report(session)
        # (work of walls, heat, gravity along a periodic slope, and what contacts take, by the events of the log)
        assert abs(found["energy_imbalance"]) < 1e-9


def test_rooms_drives_and_a_thermostat(tmp_path):
    text = ROUGH.replace(
        '"periodic"\nsize = [8.0, 7.5, 7.0]',
        '"cylinder"\nradius = 4.5\nheight = "1200 cm"\nobstacles = [[4.5, 4.5, 6.0, 1.0]]',
    )
    text = text.replace(
        "[run]",
        """
[[contacts]]
between = ["a", "wall"]
restitution = 0.9
friction = 0.3
[[contacts]]
between = ["side", "a"]
restitution = 0.5
friction = 0
[[drives]]
wall = "bottom"
amplitude = 0.2
frequency = 3.0
temperature = 2.0
[thermostat]
temperature = 1.5
rate = 0.25
temperature_rotational = 0.5
[run]""",
    )
    # (without it a ball soon slides along the side: ever more collisions in no time)
    scene = load(tmp_path, "contact_time = 1e-4\n" + text)
    assert scene.container.geometry.volume == pytest.approx(math.pi * 4.5**2 * 12 - 4 / 3 * math.pi)
    gas = build(scene)
    assert gas.walls == ("side", "bottom", "top", "scatterer")
    walls, faces, one = gas.arrays.walls.contacts, gas.arrays.walls.faces, gas.arrays.system[0]
    assert walls["e"].tolist() == [0.5, 0.9, 0.9, 0.9]
    assert faces["amplitude"].tolist() == [0, 0.2, 0, 0]
    assert faces["temperature"].tolist() == [-1, 2, -1, -1]
    assert (one["temperature"], one["spin_temperature"], one["rate"]) == (1.5, 0.5, 0.25 * 200)
    assert "a cylinder 9 x 9 x 12 with 1 obstacle" in scene.describe()
    run = gas.run(20_000)
    assert run.energy_from_thermostat != 0
    assert run.energy_from_walls["bottom"] > 0
    assert run.pair_collisions > 1000


def test_a_dense_random_start(tmp_path):
    scene = load(tmp_path, ROUGH.replace("count = 200", "count = 380") + 'start = "random"')
    shares: list[float] = []
    gas = build(scene, progress=lambda done, _total, _text: shares.append(done))
    assert scene.packing_fraction == pytest.approx(0.4737, abs=1e-4)
    assert shares == sorted(shares)
    assert gas.run(5000).max_overlap < 1e-12
    assert build(scene).balls().position.tobytes() == build(scene).balls().position.tobytes()


# --- what can be wrong ---------------------------------------------------------------------------------------------

WRONG = {
    "unknown field": (
        ROUGH.replace("radius = 0.5", "radius = 0.5\nradios = 1"),
        "species[0].radios: expected a field that is known here, got 'radios'; did you mean 'radius'?",
    ),
    "shape": (ROUGH.replace('"periodic"', '"periodical"'), "container.shape: expected one of periodic, box"),
    "one size": (ROUGH.replace("[8.0, 7.5, 7.0]", "8.0"), "container.size: expected 2 or 3 lengths > 0"),
    "negative size": (
        ROUGH.replace("7.5, 7.0", "-7.5, 7.0"),
        "container.size[1]: expected a length in m, > 0, got -7.5",
    ),
    "short side": (
        ROUGH.replace("[8.0, 7.5, 7.0]", "[80.0, 75.0, 2.5]"),
        "container.size[2]: expected at least 3 diameters of the largest ball, 3, got 2.5",
    ),
    "no balls": (ROUGH.replace("count = 200", "count = 0"), "species[0].count: expected a whole number >= 1, got 0"),
    "part of a ball": (
        ROUGH.replace("count = 200", "count = 1.5"),
        "species[0].count: expected a whole number >= 1, got 1.5",
    ),
    "kappa": (
        ROUGH.replace("inertia = 0.4", "inertia = 0.9"),
        "species[0].inertia: expected kappa of at most 2/3 for balls, that of a thin shell, got 0.9; for discs give",
    ),
    "inertia": (ROUGH.replace("inertia = 0.4", 'inertia = "holow"'), "did you mean 'hollow'?"),
    "cold": (
        ROUGH.replace("temperature = 1.0", "temperature = -1"),
        "species[0].temperature: expected a temperature k_B T >= 0",
    ),
    "a ball called wall": (
        ROUGH.replace('name = "a"', 'name = "wall"'),
        "species[0].name: expected a name other than wall, left",
    ),
    "no contact": (
        ROUGH[: ROUGH.index("[[contacts]]")] + ROUGH[ROUGH.index("[run]") :],
        'contacts: expected a contact between ["a", "a"], got none; add a table [[contacts]] with between = ["a", "a"]',
    ),
    "no wall's contact": (
        ROUGH.replace('"periodic"', '"box"'),
        'contacts: expected a contact between ["a", "wall"], got none',
    ),
    "one wall left": (
        MIXED.replace('["small", "bottom"]', '["small", "left"]'),
        'contacts: expected a contact between ["small", "bottom"], got none',
    ),
    "strange name": (
        ROUGH.replace('between = ["a", "a"]', 'between = ["a", "wal"]'),
        "contacts[0].between: expected names of species, or of walls, got 'wal'; did you mean 'wall'?",
    ),
    "restitution": (
        ROUGH.replace("restitution = 1.0\nf", "restitution = 1.1\nf"),
        "contacts[0].restitution: expected a number from 0",
    ),
    "no friction": (
        ROUGH.replace("friction = inf\n", ""),
        "contacts[0].friction: expected a number >= 0 (inf: never slips), or a table { at_rest, at_speed, speed }, got nothing",
    ),
    "twice": (
        ROUGH.replace("[run]", '[[contacts]]\nbetween = ["a", "a"]\nrestitution = 1\nfriction = 0\n[run]'),
        'contacts[1].between: expected one contact for each pair, got a second one for ["a", "a"]',
    ),
    "no end": (ROUGH.replace("max_events = 60_000", ""), "run: expected max_events or duration, got neither"),
    "start": (
        ROUGH + 'start = "latice"',
        "run.start: expected 'lattice', 'random', or a file (.csv, .npz, .gsd), got 'latice'; did you",
    ),
    "too dense to be": (
        ROUGH.replace("count = 200", "count = 900"),
        "species: expected a packing fraction of at most 0.7405, the densest packing of equal balls, got 1.1220; use fewer",
    ),
    "too dense for chance": (
        ROUGH.replace("count = 200", "count = 60")
        .replace("radius = 0.5", "radius = 1.12")
        .replace("[8.0, 7.5, 7.0]", "[8, 8, 8]"),
        "run.start: expected a packing fraction that can be reached, got 0.",
    ),
    "swings where nothing is": (
        ROUGH.replace("[run]", '[[drives]]\nwall = "top"\namplitude = 1\nfrequency = 1\n[run]'),
        "drives[0].wall: expected walls to drive, got none in a container of shape 'periodic'",
    ),
    "swings never": (
        MIXED.replace("[run]", '[[drives]]\nwall = "bottom"\namplitude = 1\n[run]'),
        "drives[0].frequency: expected a number > 0 for an oscillating wall, got none",
    ),
    "a floor by another name": (
        MIXED.replace("[run]", '[[drives]]\nwall = "floor"\namplitude = 1\nfrequency = 1\n[run]'),
        "drives[0].wall: expected the name of a wall, got 'floor'; known are bottom, top",
    ),
    "periodic everywhere": (
        MIXED.replace('periodic = ["x"]', "periodic = true"),
        "container.periodic: expected a list of the axes without walls, such as ['x'], got True",
    ),
    "a distribution without a name": (
        MIXED.replace("[run]", '[[species]]\nname = "c"\ncount = 3\nradius = {median = 0.5}\n[run]'),
        "species[2].radius.sigma: expected a standard deviation of ln r, > 0 and at most 1, got nothing",
    ),
    "half a ball": (
        MIXED.replace("[run]", '[[species]]\nname = "c"\ncount = 2.5\nradius = 0.5\n[run]'),
        "species[2].count: expected a whole number >= 1, got 2.5",
    ),
    "warms nothing": (
        MIXED.replace("[run]", '[[drives]]\nwall = "botom"\ntemperature = 1\n[run]'),
        "drives[0].wall: expected the name of a wall, got 'botom'; did you mean 'bottom'?",
    ),
    "kicks without a rate": (
        MIXED.replace("[run]", "[thermostat]\ntemperature = 1\n[run]"),
        "thermostat.rate: expected a rate > 0: kicks per ball per unit time, got nothing",
    ),
    "sides that cross": (
        ROUGH.replace('"periodic"\nsize = [8.0, 7.5, 7.0]', '"polygon"\npoints = [[0, 0], [8, 8], [8, 0], [0, 7]]'),
        "container.points: expected sides that do not cross, got those from corner 1 to 2 and from corner 3 to 4, which meet at",
    ),
    "gravity": (
        MIXED.replace("gravity = 0.2", "gravity = [0, 0, 1]"),
        "gravity: expected one number, or 2, got 3 numbers",
    ),
    "gravity without walls": (
        "gravity = 9.81\n" + ROUGH,
        "gravity: expected no gravity without walls to fall on, got 9.81; add walls",
    ),
    "events without number": (
        ROUGH.replace("max_events = 60_000", "max_events = 99999999999999999999999"),
        "run.max_events: expected a whole number < 2^63, got 99999999999999999999999",
    ),
    "a law": (
        ROUGH.replace("restitution = ", 'law = "mirror"\nrestitution = ', 1),
        "contacts[0].law: expected a field that is known here, got 'law'; a gas takes no custom law",
    ),
    "contact time": (MIXED.replace("1e-6", "-1"), "contact_time: expected a time >= 0, got -1"),
}


def test_a_ball_as_wide_as_an_ellipse(tmp_path):
    wall = '[[contacts]]\nbetween = ["a", "wall"]\nrestitution = 1\nfriction = 0\n[run]'
    sizes = '"ellipse"\nhalf_axes = [4.0, 0.5]\nheight = 7.0'
    text = ROUGH.replace('"periodic"\nsize = [8.0, 7.5, 7.0]', sizes).replace("[run]", wall)
    assert any(
        "radius: expected a radius below the ellipse's smaller half axis, 0.5, got 0.5" in line
        for line in faults(tmp_path, text)
    )


@pytest.mark.parametrize("what", WRONG)
def test_what_is_wrong_is_one_line(tmp_path, what):
    text, said = WRONG[what]
    assert text not in (ROUGH, MIXED)
    (line,) = faults(tmp_path, text)
    assert said in line


def test_all_faults_at_once(tmp_path):
    text = (
        ROUGH.replace("count = 200", "count = 0").replace("radius = 0.5", "radius = -1").replace("seed = 1", "sed = 1")
    )
    assert [line.split(":")[0] for line in faults(tmp_path, text)] == [
        "species[0].count",
        "species[0].radius",
        "run.sed",
    ]


def test_species_without_a_surface_are_all_named(tmp_path):
    text = MIXED[: MIXED.index("[[contacts]]")] + MIXED[MIXED.index("[run]") :]
    lines = faults(tmp_path, text)
    for line, pair in zip(lines, ("big,big", "big,small", "small,small", "big,wall", "small,wall"), strict=True):
        one, two = pair.split(",")
        assert f'got none; add a table [[contacts]] with between = ["{one}", "{two}"]' in line


def test_scenes_of_the_other_kind_are_told_apart(tmp_path):
    (tmp_path / "balls.toml").write_text("[[balls]]\nradius = 1\n")
    with pytest.raises(CaromError, match="expected a gas, got a scene of single balls, with balls; run carom simulate"):
        load_gas(tmp_path / "balls.toml")
    from carom import load_scene

    (tmp_path / "gas.toml").write_text(ROUGH)
    with pytest.raises(
        CaromError, match="expected a scene of single balls, got a gas, with container and species; carom gas"
    ):
        load_scene(tmp_path / "gas.toml")
    with pytest.raises(
        CaromError,
        match=r"scene file of a gas, got: No such file.*; carom scene new with `gas` or carom.gas.gas_text makes one$",
    ):
        load_gas(tmp_path / "none.toml")


# --- starts from files ---------------------------------------------------------------------------------------------


def start_files(folder: Path):
    gas = build(load(folder, MIXED))
    gas.run(1000)
    balls = gas.balls()
    names = np.array(["big", "small"])[balls.species]
    with (folder / "start.csv").open("w") as file:
        file.write("species,x,y,vx,vy,wz\n")
        for k in range(len(names)):
            numbers = [*balls.position[k, :2], *balls.velocity[k, :2], balls.spin[k, 2]]
            file.write(f"{names[k]},{','.join(repr(float(x)) for x in numbers)}\n")
    np.savez(
        folder / "start.npz", position=balls.position, velocity=balls.velocity, spin=balls.spin[:, 2], species=names
    )
    return balls


@pytest.mark.parametrize("kind", ["csv", "npz"])
def test_a_start_from_a_file_is_that_of_the_file(tmp_path, kind):
    balls = start_files(tmp_path)
    scene = load(tmp_path, MIXED.replace('"random"', f'"start.{kind}"'))  # beside the scene
    found = build(scene).balls()
    order = np.argsort(balls.species, kind="stable")
    for name in ("position", "velocity", "spin"):
        assert np.array_equal(getattr(found, name), getattr(balls, name)[order]), name


def test_a_start_without_velocities_gets_those_of_the_temperature(tmp_path):
    side = np.arange(6) + 0.6
    x = np.stack(np.meshgrid(side, side, side), axis=-1).reshape(-1, 3)[:200]
    np.savetxt(tmp_path / "x.csv", x, delimiter=",", header="x,y,z", comments="")
    gas = build(load(tmp_path, ROUGH + 'start = "x.csv"'))
    assert gas.balls().position.tolist() == x.tolist()
    assert gas.energy()[0] == pytest.approx(300, rel=1e-12)


@pytest.mark.parametrize(
    ("rows", "said"),
    [
        (["x,y,z", "1,2"], "row 2: expected 3 cells, got 2"),
        (["x,y,z", "1,2,up"], "row 2: z: expected a number, got 'up'"),
        (["x,y,z", "1,2,nan"], "expected finite numbers, got position [1.0, 2.0, nan] of ball 0"),
        (["x,y", "1,2"], "line 1: expected the columns x, y, z, got no z"),
        (["x,y,q", "1,2,3"], "line 1: expected a known column, got 'q'"),
        (["x,y,z", "1,2,3"], "expected 200 balls, the sum over the species, got 1 in x.csv"),
        (["x,y,z,species", "1,2,3,b"], "species: expected a, got 'b'"),
        (["x,y,z", *["1,2,3"] * 200], "run.start: expected balls that do not overlap, got balls 0 and 1, at"),
    ],
)
def test_starts_that_are_none(tmp_path, rows, said):
    (tmp_path / "x.csv").write_text("\n".join(rows) + "\n")
    with pytest.raises(CaromError) as found:
        build(load(tmp_path, ROUGH + 'start = "x.csv"'))
    (line,) = found.value.faults
    assert said in line


def test_a_start_that_is_not_there_or_damaged(tmp_path):
    with pytest.raises(CaromError, match=r"x.csv: expected a file with positions, got: No such file"):
        build(load(tmp_path, ROUGH + 'start = "x.csv"'))
    for kind, said in (
        ("npz", "expected arrays saved by NumPy, got another file"),
        ("gsd", "expected a GSD file of HOOMD's schema"),
    ):
        (tmp_path / f"x.{kind}").write_bytes(b"no such thing")
        with pytest.raises(CaromError, match=said):
            build(load(tmp_path, ROUGH + f'start = "x.{kind}"'))


def test_a_scene_is_simulated_in_one_call(tmp_path):
    """simulate_gas of a scene was a TypeError about a missing side."""
    scene = load(tmp_path, ROUGH)
    gas, run = simulate_gas(scene, max_events=3000, equilibrate=1000)
    assert gas.collisions == 4000
    assert run.pair_collisions == 3000
    session = Session(scene)
    session.run()
    found = simulate_gas(scene)[1]
    assert {**found.to_dict(), "cpu_seconds": 0} == {**session.result.to_dict(), "cpu_seconds": 0}


def test_arguments_that_a_scene_excludes_and_those_that_are_missing(tmp_path):
    scene = load(tmp_path, ROUGH)
    with pytest.raises(CaromError) as found:
        simulate_gas(scene, (8.0, 8.0, 8.0), gravity=(0, 0, -1))
    assert found.value.faults == (
        "simulate_gas: side: expected none beside a GasScene, got (8.0, 8.0, 8.0); change the scene",
        "simulate_gas: gravity: expected none beside a GasScene, got (0, 0, -1); change the scene",
    )
    with pytest.raises(CaromError) as found:
        simulate_gas([Species(Ball(0.5, 1.0), 64)], contacts=Surface(1, 0, -1))
    assert found.value.faults == (
        "simulate_gas: side: expected two or three lengths, or a container, with a list of Species, got none",
    )
    with pytest.raises(CaromError, match="run: expected max_events or duration, got neither"):
        simulate_gas([Species(Ball(0.5, 1.0), 64)], (6.0, 6.0, 6.0), contacts=Surface(1, 0, -1))


def test_a_gas_of_parts_is_that_of_their_scene():
    """One way to run a gas: of parts, of a scene, by a session and by pieces, all have the same balls."""
    parts = {"species": [Species(Ball(0.5, 1.0), 64)], "contacts": Surface(0.9, 0.3, 0.5)}
    run = {"equilibrate": 300, "max_events": 2000, "seed": 3}
    scene = GasScene(container=(6.0, 6.0, 6.0), run=run, **parts)
    by_hand = Gas(parts["species"], (6.0, 6.0, 6.0), contacts=parts["contacts"], seed=3)
    assert sum(1 for _ in by_hand.pieces(2300, chunk=100)) == 23
    session = Session(scene)
    assert sum(session.pieces(every=500)) == 5
    gas, result = simulate_gas(parts["species"], (6.0, 6.0, 6.0), contacts=parts["contacts"], **run)
    places = [one.balls().position.tobytes() for one in (by_hand, session.gas, gas, simulate_gas(scene).gas)]
    assert len(set(places)) == 1
    assert {**result.to_dict(), "cpu_seconds": 0} == {**session.result.to_dict(), "cpu_seconds": 0}


def test_what_a_gas_says_of_itself(tmp_path):
    gas = build(load(tmp_path, MIXED))
    gas.advance(1)
    assert repr(gas).startswith("<Gas: 160 discs in 20 x 16, periodic x, walls bottom, top; t = ")
    assert repr(gas).endswith(", 1 collision>")


def test_a_diameter_is_answered_with_the_radius(tmp_path):
    (line,) = [one for one in faults(tmp_path, ROUGH.replace("radius = 0.5", "diameter = 1.0")) if "known here" in one]
    assert (
        line == "species[0].diameter: expected a field that is known here, got 'diameter'; give the radius, half of it"
    )


@pytest.mark.parametrize("contacts", [{"restitution": 0.9}, {("a", "a"): 0.9}, {("a",): Surface(1, 0, -1)}, 0.9])
def test_contacts_that_are_none(contacts):
    """A letter of a key was called the name of a species that is not known."""
    with pytest.raises(CaromError) as found:
        Gas([Species(Ball(0.5, 1.0), 8)], (6.0, 6.0, 6.0), contacts=contacts)
    (line,) = found.value.faults
    assert line.startswith("Gas: contacts: expected ")


def test_a_default_temperature_that_makes_beads_fast_is_said():
    bead = {"count": 50, "radius": "0.5 mm", "mass": "2.6 mg"}
    contact = {"between": ("a", "a"), "restitution": 1, "friction": 0}

    def notes(**species):
        box = {"shape": "periodic", "size": (0.01, 0.01, 0.01)}
        return GasScene(
            container=box, species=[bead | species], contacts=[contact], run={"max_events": 10}
        ).temperature_notes()

    assert notes() == [
        "species 'a': no temperature, so k_B T = 1 J: 620 m/s along each axis for 2.6e-06 kg; temperature = 2.6e-06 would be 1 m/s"
    ]
    assert notes(temperature=2.6e-6) == notes(temperature=1.0) == notes(mass=1.0) == []
