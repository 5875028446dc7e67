"""A shape, a figure and a law, one Python file each, are in the page once its module is rebuilt: two minutes (make check-added)."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

from test_added_files import package, python

from carom.core.jit.cache import cache_folder

__all__ = ["package"]  # (a fixture)

SIMULATE = (
    "import carom, json; print(json.dumps([float(t) for t in carom.simulate(carom.load_scene('scene.toml')).events.t]))"
)
VERDICT = "import carom, json; print(json.dumps(carom.compare(carom.incoming(), ['three-quarters']).verdicts[0].why))"


def test_all_are_in_the_page_once_the_module_is_built(package: Path, open_page: Any, tmp_path: Path) -> None:
    shutil.copytree(cache_folder(), tmp_path / cache_folder().name)
    built = python(package, "-m", "carom.explorer.module", cache=tmp_path)
    assert built.returncode == 0, built.stderr
    made = python(package, "-m", "carom", "explore", "scene.toml", "--out", "page.html", "--no-open", cache=tmp_path)
    assert made.returncode == 0, made.stderr
    page = open_page(package / "page.html")
    times = page.evaluate("() => carom.run(carom.scene(), 'three-quarters').events.map((event) => event.t)")
    done = python(package, "-c", SIMULATE, cache=tmp_path)
    assert times == json.loads(done.stdout), done.stderr
    assert len(times) >= 2  # the post, and then the rhombus
    (said,) = json.loads(python(package, "-c", VERDICT, cache=tmp_path).stdout)
    assert said == "it leaves the spin as it is, 2.5 times"
    assert page.evaluate("() => document.body.textContent").count(said) == 1
