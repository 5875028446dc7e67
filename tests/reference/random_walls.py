"""Random walls of all shapes, the same for the same seed."""

from __future__ import annotations

from typing import Any

import numpy as np
from pydantic import TypeAdapter

from carom.errors import CaromError
from carom.scene.presets import presets
from carom.scene.shapes import AnyWall
from carom.scene.wall import WallShape

__all__ = ["random_wall"]

SHAPES = ("plane", "strip", "wedge", "box", "segment", "polygon", "table", "cylinder", "sphere", "arc", "stadium")
ROUND_ANGLES = (0.0, 30.0, 45.0, 90.0, 180.0, -90.0, 270.0, 360.0, 720.0, -1e-20, 1e17)


def random_wall(seed: int) -> WallShape:
    """Return a wall; its shape is that of ``SHAPES`` with the number seed modulo 11."""
    rng = np.random.default_rng([seed, 40])
    adapter: TypeAdapter[WallShape] = TypeAdapter(AnyWall)
    while True:
        try:
            return adapter.validate_python(
                {"shape": SHAPES[seed % len(SHAPES)], **_fields(SHAPES[seed % len(SHAPES)], rng)}
            )
        except (CaromError, ValueError):
            continue


def _numbers(rng: np.random.Generator, count: int) -> list[float]:
    """Return numbers of either sign, some of them round."""
    scale = 10.0 ** rng.integers(-3, 4)
    exact = rng.choice([0.0, 1.0, -1.0, 0.5, 2.0], count)
    return [float(x) for x in np.where(rng.random(count) < 0.3, exact, scale * rng.normal(size=count))]  # fmt: skip


def _angle(rng: np.random.Generator) -> float:
    return float(rng.choice(ROUND_ANGLES)) if rng.random() < 0.3 else float(rng.uniform(-400, 400))


def _direction(rng: np.random.Generator) -> list[float]:
    found = _numbers(rng, 3)
    return found if any(found) else [0.0, 0.0, 1.0]


def _span(rng: np.random.Generator) -> dict[str, float]:
    start = _angle(rng)
    return {"from_angle": start, "to_angle": start + float(rng.choice([90.0, 180.0, 360.0, rng.uniform(1, 360)]))}


def _heights(rng: np.random.Generator) -> dict[str, float]:
    low, high = sorted(rng.uniform(-1, 1, 2).tolist())
    given: list[dict[str, float]] = [
        {},
        {"low": low},
        {"height": high},
        {"low": low, "height": high},
        {"low": low, "height": low},
    ]
    return given[rng.integers(len(given))]


def _pockets(rng: np.random.Generator) -> dict[str, float]:
    mouth = float(rng.uniform(0.05, 0.3))
    return {
        "mouth": mouth, "jaw_angle": float(rng.choice([90.0, 135.0, rng.uniform(90, 175)])),
        "jaw_radius": float(rng.uniform(0.001, 0.05)),
        "shelf": float(rng.uniform(-0.5, 0.8)) * mouth, "radius": float(rng.uniform(0.4, 0.9)) * mouth,
    }  # fmt: skip


def _table(rng: np.random.Generator) -> dict[str, Any]:
    found: dict[str, Any] = {"center": _numbers(rng, 2)}
    if rng.random() < 0.3:
        found["preset"] = str(rng.choice(sorted(presets())))
    else:
        found |= {"length": float(rng.uniform(1, 4)), "width": float(rng.uniform(1, 4))}
        found |= {name: _pockets(rng) for name in ("corner_pockets", "side_pockets") if rng.random() < 0.6}
    if rng.random() < 0.5:
        found["nose_height"] = float(rng.uniform(0.01, 0.05))
    if rng.random() < 0.5:
        found["height"] = float(rng.uniform(0.06, 0.1))
    return found


def _polygon(rng: np.random.Generator, backwards: bool) -> dict[str, Any]:
    angles = np.sort(rng.uniform(0, 2 * np.pi, rng.integers(3, 9)))[:: -1 if backwards else 1]
    points = rng.uniform(0.5, 2, len(angles)) * np.array([np.cos(angles), np.sin(angles)])
    return {"points": np.round(points.T, 3).tolist(), "closed": bool(rng.random() < 0.7), **_heights(rng)}


def _fields(shape: str, rng: np.random.Generator) -> dict[str, Any]:
    length, radius = (float(x) for x in 10.0 ** rng.uniform(-2, 1, 2))
    inside = bool(rng.random() < 0.5)
    of_shapes: dict[str, Any] = {
        "plane": lambda: {"point": _numbers(rng, 3), "normal": _direction(rng)},
        "strip": lambda: {"point": _numbers(rng, 3), "normal": _direction(rng), "width": length},
        "wedge": lambda: {"apex": _numbers(rng, 3), **({} if inside else {"axis": _direction(rng)}), **_span(rng)},
        "box": lambda: {
            str(rng.choice(["center", "corner"])): _numbers(rng, 3), "size": (10.0 ** rng.uniform(-2, 1, 3)).tolist(),
            "inside": inside,
        },
        "segment": lambda: {"start": _numbers(rng, 2), "end": _numbers(rng, 2), **_heights(rng)},
        "polygon": lambda: _polygon(rng, not inside),
        "table": lambda: _table(rng),
        "cylinder": lambda: {
            **({"height": length} if rng.random() < 0.6 else {}),
            "point": _numbers(rng, 3), "axis": _direction(rng), "radius": radius, "inside": inside,
        },
        "sphere": lambda: {"center": _numbers(rng, 3), "radius": radius, "inside": inside},
        "arc": lambda: {"center": _numbers(rng, 2), "radius": radius, **_span(rng), **_heights(rng)},
        "stadium": lambda: {"straight": length, "radius": radius, "center": _numbers(rng, 2), "angle": _angle(rng)},
    }  # fmt: skip
    found: dict[str, Any] = of_shapes[shape]()
    return found
