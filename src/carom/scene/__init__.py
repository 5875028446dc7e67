"""Where the balls are: floor, walls, shapes; the TOML form of a scene.

Names are imported when first used: the numeric core is then free of what reads scenes.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from carom.scene.balls import SceneBall as SceneBall
    from carom.scene.model import BallContact as BallContact
    from carom.scene.model import Floor as Floor
    from carom.scene.model import Run as Run
    from carom.scene.model import Scene as Scene
    from carom.scene.toml import load_scene as load_scene
    from carom.scene.toml import new_scene as new_scene
    from carom.scene.walls import Arc as Arc
    from carom.scene.walls import Box as Box
    from carom.scene.walls import Cylinder as Cylinder
    from carom.scene.walls import Plane as Plane
    from carom.scene.walls import Polygon as Polygon
    from carom.scene.walls import Segment as Segment
    from carom.scene.walls import Sphere as Sphere
    from carom.scene.walls import Stadium as Stadium
    from carom.scene.walls import Strip as Strip
    from carom.scene.walls import Table as Table
    from carom.scene.walls import Wedge as Wedge

HOME = {
    "SceneBall": "balls",
    **dict.fromkeys(("BallContact", "Floor", "Run", "Scene"), "model"),
    **dict.fromkeys(("load_scene", "new_scene"), "toml"),
    **dict.fromkeys(
        ("Arc", "Box", "Cylinder", "Plane", "Polygon", "Segment", "Sphere", "Stadium", "Strip", "Table", "Wedge"),
        "walls",
    ),
}

__all__ = sorted(HOME)  # noqa: PLE0605


def __getattr__(name: str) -> Any:
    if name not in HOME:
        raise AttributeError(f"module 'carom.scene' has no attribute {name!r}")
    return getattr(importlib.import_module(f"carom.scene.{HOME[name]}"), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *HOME})
