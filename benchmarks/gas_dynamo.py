"""A gas of carom's as DynamO's input: the same balls at the same places, as they move at that moment.

DynamO reads XML (https://www.dynamomd.com/index.php/documentation): its balls must stand in the order of their species, the
origin is the middle of the box, a rough ball needs an orientation. Its contacts are smooth or perfectly rough here, and its balls
solid: what it takes a rough ball's inertia for.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np

from carom.gas import Gas, Species

__all__ = ["write_dynamo"]


def _vector(parent: Any, tag: str, value: Any) -> None:
    ET.SubElement(parent, tag, dict(zip("xyz", (repr(float(x)) for x in value), strict=True)))


def write_dynamo(
    path: Path, gas: Gas, species: Sequence[Species], size: Sequence[float], *, rough: bool, walls: bool
) -> None:
    """Write the gas, in a box of that size, periodic or between walls, as a file for ``dynarun``."""
    root = ET.Element("DynamOconfig", version="1.5.0")
    simulation = ET.SubElement(root, "Simulation")
    scheduler = ET.SubElement(simulation, "Scheduler", Type="NeighbourList")
    ET.SubElement(scheduler, "Sorter", Type="BoundedPQMinMax3")
    _vector(simulation, "SimulationSize", size)
    genus = ET.SubElement(simulation, "Genus")
    ET.SubElement(simulation, "BC", Type="None" if walls else "PBC")
    ET.SubElement(simulation, "Topology")
    interactions = ET.SubElement(simulation, "Interactions")
    locals_ = ET.SubElement(simulation, "Locals")
    for empty in ("Globals", "SystemEvents"):
        ET.SubElement(simulation, empty)
    ET.SubElement(simulation, "Dynamics", Type="Newtonian")
    # (a diameter given to a pair would be the arm of both; so each ball has its own)
    ET.SubElement(ET.SubElement(root, "Properties"), "Property", Type="PerParticle", Name="D", Units="Length")
    # (its tangential elasticity is 1 where nothing is passed on, -1 where the surfaces' velocity is turned around)
    turned = {"Elasticity": "1", "TangentialElasticity": "-1"} if rough else {}
    contact = ET.SubElement(
        interactions, "Interaction", {"Type": "HardSphere", "Diameter": "D"} | turned | {"Name": "pair"}
    )
    ET.SubElement(contact, "IDPairRange", Type="All")
    diameter = []
    for one in species:
        known = {
            "Name": one.name,
            "Mass": repr(float(one.nominal_mass(3))),
            "Type": "SphericalTop" if rough else "Point",
        }
        radius, first = float(one.nominal), len(diameter)
        if rough:
            known["InertiaConstant"] = repr(float(one.kappa(3)) * radius**2)
        diameter += [2 * radius] * one.count
        those = {"Type": "Ranged", "Start": str(first), "End": str(len(diameter) - 1)}
        ET.SubElement(ET.SubElement(genus, "Species", known), "IDRange", those)
        for axis in range(3 if walls else 0):
            if not rough and first:
                continue  # a smooth wall reads the balls' diameters, and is one for all
            for up in (False, True):
                shape = {"Type": "Wall", "Elasticity": "1", "Diameter": "D"}
                if rough:
                    shape = {"Type": "RoughWall", "Radius": repr(radius), "Render": "0"} | turned
                wall = ET.SubElement(locals_, "Local", shape | {"Name": f"{one.name}{axis}{up:d}"})
                ET.SubElement(wall, "IDRange", those if rough else {"Type": "All"})
                n, origin = np.zeros(3), np.zeros(3)
                n[axis] = -1 if up else 1
                origin[axis] = size[axis] / 2 if up else -size[axis] / 2
                _vector(wall, "Norm", n)
                _vector(wall, "Origin", origin)
    balls = gas.balls()
    data = ET.SubElement(root, "ParticleData", {"OrientationData": "Y"} if rough else {})
    middle = np.array(size) / 2
    for number, k in enumerate(np.argsort(balls.species, kind="stable")):
        ball = ET.SubElement(data, "Pt", ID=str(number), D=repr(diameter[number]))
        _vector(ball, "P", balls.position[k] - middle)
        _vector(ball, "V", balls.velocity[k])
        if rough:
            _vector(ball, "O", balls.spin[k])
            ET.SubElement(ball, "U", x="0", y="0", z="0", w="1")
    ET.ElementTree(root).write(path, xml_declaration=True)
