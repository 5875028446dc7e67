"""Figures, one Python file each, in a copy of the package: scenes, gases, billiards, sweeps, the page's data, the list."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import carom

HOWTO = Path(__file__).parents[2] / "docs" / "howto" / "figures.md"
ASKED = """
import json, math, numpy, carom
from carom import billiards, gas, sweeps
from carom.explorer.page import with_outlines
from carom.scene import FIGURES

found = {"listed": "rhombus" in FIGURES}
sizes = {"shape": "rhombus", "width": 3.0, "depth": 1.0}
wall = {**sizes, "center": (0.5, 0.0), "angle": 90, "restitution": 1.0, "friction": 0.0}
ball = {"radius": 0.05, "mass": 0.2, "position": (0.5, 0.2, 0.0), "velocity": (1.0, 0.7, 0.0)}
scene = carom.Scene(gravity=0, walls=[wall], balls=[ball], run={"law": "mirror", "max_events": 8, "duration": 50})
run = carom.simulate(scene)
found["scene"] = [one.t for one in run.events if one.kind == "wall"]
page = with_outlines(scene)
found["page"] = [page.walls[0].kind, [one.t for one in carom.simulate(page).events if one.kind == "wall"]]
table = billiards.table("rhombus:width=3,depth=1", bounds="surface")
# the scene's wall is turned by 90 degrees about its place
start = {"position": (0.2, 0.0), "velocity": (0.7, -1.0)}
found["orbit"] = carom.orbit(table, 8, law="mirror", ball_radius=0.05, **start).t.tolist()
made = gas.container("rhombus", width=3.0, depth=1.0)
found["gas"] = [list(made.names), made.volume, list(made.size)]
contacts = [{"between": ("a", other), "restitution": 1.0, "friction": 0.0} for other in ("a", "wall")]
species, run = [{"count": 8, "radius": 0.05}], {"max_events": 200, "equilibrate": 0}
filled = gas.GasScene(container=sizes, species=species, contacts=contacts, run=run)
made, result = carom.simulate_gas(filled)
places = numpy.c_[numpy.asarray(made.balls().position)[:, :2], numpy.zeros(8)]
gap = filled.container.geometry.clearance(0.05, places)
found["packed"] = [filled.packing_fraction, float(gap.min()), int(result.wall_collisions)]
space = carom.Space(sweeps.OrbitCase(table=sizes, bounces=20, law="mirror"), {"table.width": [2.0, 3.0]})
egg = {"shape": "egg", "blunt": 0.2, "radius": 1.0}
ball |= {"position": (0.1, 0.2, 0.0)}
wall = {**egg, "restitution": 1.0, "friction": 0.0}
scene = carom.Scene(gravity=0, walls=[wall], balls=[ball], run={"law": "mirror", "max_events": 8})
start = {"position": (0.1, 0.2), "velocity": (1.0, 0.7)}
orbit = carom.orbit(billiards.table(egg, bounds="surface"), 8, law="mirror", ball_radius=0.05, **start)
found["egg"] = [[one.t for one in carom.simulate(scene).events if one.kind == "wall"], orbit.t.tolist()]
found["gas of eggs"] = gas.container(egg).volume
again = carom.simulate(with_outlines(scene))
found["page of eggs"] = [len(carom.explore(scene).html) > 1000, [one.t for one in again.events if one.kind == "wall"]]
found["sweep"] = carom.sweep(space, ["bounces.count"]).run()["bounces.count"].values.tolist()
print(json.dumps(found))
"""


EGG = '''
"""An egg, whose only piece is smooth."""

from typing import Literal

from carom.scene.figures.figure import call
from carom.scene.figures import PlaneFigure
from carom.scene.figures.curve import PolarPiece
from carom.scene.schema import Share, Size


class EggFigure(PlaneFigure):
    """An egg about the origin."""

    shape: Literal["egg"] = "egg"
    blunt: Share
    radius: Size

    def outline(self):
        return [[PolarPiece(lambda t: self.radius * (1.0 + self.blunt * call("cos", t)))]]
'''


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of the package with two figures more, one as the page of figures has it."""
    folder = tmp_path_factory.mktemp("copy")
    shutil.copytree(Path(carom.__file__).parent, folder / "carom", ignore=shutil.ignore_patterns("__pycache__"))
    text = re.search(
        r"`figures/rhombus.py`:\n\n```{code-cell} ipython3\n(.*?)```", HOWTO.read_text(encoding="utf-8"), re.DOTALL
    )
    assert text is not None
    figures = folder / "carom" / "scene" / "figures"
    (figures / "rhombus.py").write_text(text[1])
    (figures / "egg.py").write_text(EGG)
    return folder


def python(folder: Path, *arguments: str) -> Any:
    """Run Python with the copy in the place of carom."""
    path = os.pathsep.join([str(folder), *os.environ.get("PYTHONPATH", "").split(os.pathsep)])
    done = subprocess.run(
        [sys.executable, *arguments],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": path},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.mark.slow
def test_a_figure_that_is_added_as_a_file_is_everywhere(package: Path) -> None:
    found = python(package, "-c", ASKED)
    assert found["listed"]
    assert len(found["scene"]) == 8
    assert found["page"] == ["outline", found["scene"]]
    assert found["scene"] == pytest.approx(found["orbit"], rel=1e-9)
    names, volume, size = found["gas"]
    assert names == ["edge1", "edge2", "edge3", "edge4"]
    assert (volume, size) == (pytest.approx(1.5), [3.0, 1.0])
    fraction, gap, collisions = found["packed"]
    assert fraction == pytest.approx(8 * 3.141592653589793 * 0.05**2 / 1.5)
    assert (gap > -1e-12, collisions > 10) == (True, True)
    assert found["egg"][0] == pytest.approx(found["egg"][1], rel=1e-9)
    assert found["gas of eggs"] == pytest.approx(3.141592653589793 * (1 + 0.2**2 / 2))
    assert found["page of eggs"] == [True, found["egg"][0]]
    assert found["sweep"] == [20.0, 20.0]


def test_the_command_takes_it(package: Path) -> None:
    found = python(package, "-m", "carom", "orbit", "rhombus:width=3,depth=1", "--bounces", "5", "--json")
    assert found["table"] == {"name": "rhombus", "bounds": "centre", "width": 3.0, "depth": 1.0}
    assert found["count"] == 5
