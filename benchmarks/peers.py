"""Peers, timed where they are installed; none of them is needed."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Iterator

import numpy as np

# pooltool's cushion models by the name that each of its versions gives them.
POOLTOOL = (
    ("pooltool.physics.resolve.ball_cushion", "Han2005Linear"),
    ("pooltool.physics.resolve.ball_cushion.han_2005", "Han2005Linear"),
    ("pooltool.physics.resolve.ball_cushion.mathavan_2010.model", "Mathavan2010Linear"),
    ("pooltool.physics.resolve.ball_cushion.stronge_compliant.model", "StrongeCompliantLinear"),
)


def pooltool_resolves() -> Iterator[tuple[str, Callable[[], object]]]:
    """pooltool's cushion models: name, and one impact resolved, ball and cushion copied as pooltool's loop has them."""
    pooltool = importlib.import_module("pooltool")
    table = pooltool.Table.default()
    cushion = next(iter(table.cushion_segments.linear.values()))
    ball = pooltool.Ball.create("cue", xy=(0.5, 0.5))
    normal = np.asarray(
        cushion.normal if not callable(getattr(cushion, "get_normal", None)) else cushion.get_normal(ball.state.rvw)
    )
    rvw = np.array([[0.5, 0.5, ball.params.R], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    toward = -normal / np.linalg.norm(normal)
    along = np.cross([0.0, 0.0, 1.0], toward)
    rvw[1] = 1.0 * toward + 0.6 * along
    rvw[2] = np.cross([0.0, 0.0, 1.0], rvw[1]) / ball.params.R
    seen = set()
    for module, name in POOLTOOL:
        try:
            model = getattr(importlib.import_module(module), name)()
        except (ImportError, AttributeError):
            continue
        if name in seen:
            continue
        seen.add(name)

        def resolve(model: object = model) -> object:
            ball.state.rvw = rvw.copy()
            return model.resolve(ball, cushion, inplace=True)  # type: ignore[attr-defined]

        yield f"pooltool {pooltool.__version__} {name}", resolve
