"""A validated scene as plain data for JSON: SI numbers, every default filled in."""

from __future__ import annotations

from typing import Any

from carom.formatting import json_value
from carom.scene.scene import Scene
from carom.scene.schema import Model

__all__ = ["plain_model", "scene_dict"]


def scene_dict(scene: Scene) -> dict[str, Any]:
    """Return a scene as lists, dicts and SI numbers, with the names of a scene file; infinity is the string "inf".

    Nothing is left to be inferred from other fields but the spin of a ball that rolls, which follows from its velocity (27) with
    ``spin_z``: every ``inertia`` is a number, every position has three (a rack has become positions), and a ball that does not roll
    has a ``spin``. The sides of a table are there only where they differ. What is not there is None: a floor, a name, a limit of
    the run, a wall's own law or a surface's number that its law does not read.

    Examples
    --------
    >>> import carom
    >>> ball = carom.SceneBall(radius="30 mm", mass=0.2, position=(1, 0), velocity=(-2, 1), rolling=True)
    >>> scene = carom.Scene(floor=carom.Floor(friction=float("inf")), balls=[ball])
    >>> found = scene_dict(scene)
    >>> found["floor"]["friction"], found["balls"][0]["position"], found["balls"][0]["inertia"]
    ('inf', [1.0, 0.0, 0.03], 0.4)
    """
    found = plain_model(scene)
    del found["rack"]
    for entry, wall in zip(found["walls"], scene.walls, strict=True):
        if "sides" in entry and not wall.own_surfaces:
            del entry["sides"]
    for entry, ball in zip(found["balls"], scene.balls, strict=True):
        entry["inertia"] = float(ball.ball.kappa)
        if entry.pop("strike") is not None:
            entry["velocity"], entry["spin"] = ball.state.velocity.tolist(), ball.state.spin.tolist()
            continue
        if ball.rolling:
            entry["spin_z"] = ball.spin_z or 0.0
        else:
            entry["spin"] = list(ball.spin or (0.0, 0.0, 0.0))
    return found  # type: ignore[no-any-return]


def plain_model(model: Model) -> Any:
    """Return a model as lists, dicts and numbers; infinity is the string "inf"."""
    return json_value(model.model_dump(mode="json"), infinite=True)
