"""The gas that another program is handed is the gas that runs here."""

import importlib.util
import math
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import pytest

import carom
from carom.gas import Gas, Species

SCRIPT = Path(__file__).parents[2] / "benchmarks" / "gas_dynamo.py"


def numbers(element, tag):
    return np.array([[float(one.find(tag).attrib[k]) for k in "xyz"] for one in element])


@pytest.mark.skipif(not SCRIPT.exists(), reason="the benchmarks are not installed")
@pytest.mark.parametrize("rough", [False, True])
@pytest.mark.parametrize("walls", [False, True])
def test_it_is_handed_over_as_it_is(tmp_path, rough, walls):
    spec = importlib.util.spec_from_file_location("gas_dynamo", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    species = [
        Species(carom.Ball(0.5, 1.0, 0.4), 40, "large"), Species(carom.Ball(0.35, 0.343, 0.4), 60, "small"),
    ]  # fmt: skip
    surface = carom.Surface(1, math.inf, 1) if rough else carom.Surface(1, 0, -1)
    gas = Gas(species, (6.0, 6.0, 6.0), periodic=not walls, contacts=surface)
    gas.run(500)
    module.write_dynamo(tmp_path / "gas.xml", gas, species, (6.0, 6.0, 6.0), rough=rough, walls=walls)
    root = ET.parse(tmp_path / "gas.xml").getroot()
    balls, order = gas.balls(), np.argsort(gas.balls().species, kind="stable")
    points = root.find("ParticleData")
    assert [int(one.attrib["ID"]) for one in points] == list(range(100))
    # every bit of it, in the order of the species, about the middle
    np.testing.assert_array_equal(numbers(points, "P"), balls.position[order] - 3.0)
    np.testing.assert_array_equal(numbers(points, "V"), balls.velocity[order])
    assert [float(one.attrib["D"]) for one in points] == [1.0] * 40 + [0.7] * 60
    assert [kind.attrib["Mass"] for kind in root.iter("Species")] == ["1.0", "0.343"]
    ranges = [one.attrib for one in root.findall(".//Species/IDRange")]
    assert [(one["Start"], one["End"]) for one in ranges] == [("0", "39"), ("40", "99")]
    if rough:
        np.testing.assert_array_equal(numbers(points, "O"), balls.spin[order])
        # it calls kappa r^2 the inertia of a kilogram
        inertia = [float(kind.attrib["InertiaConstant"]) for kind in root.iter("Species")]
        assert inertia == pytest.approx([0.4 * 0.25, 0.4 * 0.1225])
    assert root.find(".//BC").attrib["Type"] == ("None" if walls else "PBC")
    faces = root.findall(".//Local")
    assert len(faces) == (6 * (1 + rough) if walls else 0)
    for face in faces:
        # the origin lies on the wall, the normal towards the room
        n, origin = ([float(face.find(tag).attrib[k]) for k in "xyz"] for tag in ("Norm", "Origin"))
        assert np.dot(n, origin) == -3.0
        assert face.attrib["Type"] == ("RoughWall" if rough else "Wall")
