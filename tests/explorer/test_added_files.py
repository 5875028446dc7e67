"""A shape, a figure and a law, one Python file each, in a copy of the package (check_added_files.py: in the page)."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import carom

HOWTO = Path(__file__).parents[2] / "docs" / "howto"
LAW = '''
"""A wall that takes a part of the velocity along it, an example."""

from __future__ import annotations

from carom.core.jit.kernel import Vec, dot, kernel
from carom.laws.law import Card, wall_law
from carom.laws.law import Case, Objections, Predicted, Rule, Said

CARD = Card("three-quarters", "A quarter of the velocity along the wall is lost.", ("spin unchanged",), "A test.", "none", "none")


@kernel
def three_quarters(v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float) -> tuple[Vec, Vec]:
    """Velocity and spin after the wall."""
    c = 0.75 * dot(v, n) + e * dot(v, n)
    return (0.75 * v[0] - c * n[0], 0.75 * v[1] - c * n[1], 0.75 * v[2] - c * n[2]), w


@kernel
def _turns(c: Case, r: Predicted) -> Said:
    return dot(c.w, c.w) > 0, 2.5, 0.0


OBJECTIONS = Objections(Rule(_turns, "it leaves the spin as it is, {a:g} times"))
LAW = wall_law(CARD, three_quarters, objections=OBJECTIONS, reads=("restitution",))
'''
SCENE: dict[str, Any] = {
    "gravity": 0.0,
    "walls": [
        {"shape": "post", "center": [0.0, 0.0], "radius": 0.1, "height": 0.5, "restitution": 0.5, "friction": 0.2},
        {"shape": "rhombus", "width": 4.0, "depth": 2.0, "restitution": 0.5},
    ],
    "balls": [
        {"radius": 0.03, "mass": 0.1, "position": [1.0, 0.02, 0.1], "velocity": [-1.0, 0.0, 0.0], "spin": [0, 0, 5]}
    ],
    "run": {"law": "three-quarters", "duration": 6.0},
}


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of the package with a shape, a figure and a law more, and a scene of them."""
    folder = tmp_path_factory.mktemp("copy")
    shutil.copytree(Path(carom.__file__).parent, folder / "carom", ignore=shutil.ignore_patterns("__pycache__"))
    for page, path, language in (
        ("own_law", "shapes/post", "python"),
        ("figures", "figures/rhombus", "{code-cell} ipython3"),
    ):
        text = (HOWTO / f"{page}.md").read_text(encoding="utf-8")
        code = re.search(rf"`{path}.py`:\n\n```{language}\n(.*?)```", text, re.DOTALL)
        assert code is not None
        (folder / "carom" / "scene" / f"{path}.py").write_text(code[1])
    (folder / "carom" / "laws" / "three_quarters.py").write_text(LAW)
    import tomli_w

    (folder / "scene.toml").write_text(tomli_w.dumps(SCENE))
    return folder


def python(folder: Path, *arguments: str, cache: Path | None = None) -> subprocess.CompletedProcess[str]:
    """Run Python with the copy in the place of carom."""
    path = os.pathsep.join([str(folder), *os.environ.get("PYTHONPATH", "").split(os.pathsep)])
    settings = {**os.environ, "PYTHONPATH": path, **({"CAROM_CACHE": str(cache)} if cache else {})}
    return subprocess.run(
        [sys.executable, *arguments], cwd=folder, env=settings, capture_output=True, text=True, check=False
    )


@pytest.mark.slow
def test_a_shape_that_the_page_does_not_have_is_refused_in_a_line(package: Path) -> None:
    done = python(package, "-m", "carom", "explore", "scene.toml", "--out", "page.html", "--no-open")
    said = [line for line in done.stderr.splitlines() if "shape" in line]
    assert done.returncode == 2, done.stderr
    assert len(said) == 1
    assert "walls[0].shape: expected one of plane, segment, " in said[0]
    assert "got 'post'; the page holds no other; carom simulate takes it" in said[0]
    assert "scene.toml: law: expected one of mirror, " in done.stderr
    assert "got 'three-quarters'" in done.stderr
    assert not (package / "page.html").exists()


def test_a_wall_of_the_shape_is_checked_by_its_kernel(package: Path) -> None:
    scene = (package / "scene.toml").read_text().replace("height = 0.5", "height = 50.0")
    (package / "high.toml").write_text(scene)
    done = python(package, "-m", "carom", "scene", "check", "high.toml")
    assert done.returncode == 2
    assert "walls[0].height: expected at most 100 radii, 100 mm each, got 50.0" in done.stderr
