"""What the environments of one table, of many and of two players share: games on many tables at once, by numbers of tables."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError, FaultList, checked_number, require_count
from carom.plot.film import picture
from carom.scene.scene import Scene
from carom.scene.toml import replaced
from carom.simulation.simulate import simulate

Array = NDArray[np.float64]
Rows = NDArray[np.int64]
Mask = NDArray[np.bool_]


class Played(NamedTuple):
    """What a step on n tables gave."""

    reward: Array
    """(n,): of the player who played."""
    ended: Mask
    """(n,): the game is over."""
    cut: Mask
    """(n,): all shots, or steps, of the game are used up."""
    info: dict[str, NDArray[Any]]
    """Columns (n,)."""
    against: Array
    """(n,): what the player wins of the other one, where there are two."""


class Game(ABC):
    """A game on ``count`` tables at once.

    Parameters
    ----------
    count : int
        Tables.
    players : int
        One, or two in turn.
    law : str
        Law of the walls: a name of ``carom.LAWS``.
    shots : int, optional
        Shots, or steps, of a game. Default: the game's own.

    Raises CaromError, one line per problem.
    """

    shots: ClassVar[int] = 10
    metadata: ClassVar[dict[str, Any]] = {"render_modes": ["ansi", "rgb_array"], "render_fps": 1}
    bounds: ClassVar[dict[str, tuple[float, float]]]
    """Least and largest of each number of an action."""
    low: Array
    """Least observation; its shape is that of all."""
    high: Array
    scene: Scene

    def __init__(self, count: int = 1, *, players: int = 1, law: str = "two-step", shots: int | None = None) -> None:
        faults = FaultList(type(self).__name__)
        for name, value in (("count", count), ("players", players), ("shots", 1 if shots is None else shots)):
            faults.attempt(require_count, faults.where, name, value)
        checked_number(faults, "players", min(players, 3), "1 or 2 players", lambda x: x < 3)
        faults.raise_if_any()
        self.count, self.players, self.law, self.most = count, players, law, self.shots if shots is None else shots
        self.turn, self.taken = np.zeros((2, count), np.int64)
        """(count,): whose turn it is; shots, or steps, of this game."""
        self._last: tuple[NDArray[Any], ...] = (np.empty(0, np.int64),)  # tables, and x, v, w (n, B, 3) of their balls
        self.rngs: list[np.random.Generator] = [np.random.default_rng() for _ in range(count)]

    def begin(self, rows: Rows, rngs: Sequence[np.random.Generator]) -> None:
        """Begin new games on some tables, each drawn with its own generator."""
        self.turn[rows], self.taken[rows] = 0, 0
        for row, rng in zip(rows.tolist(), rngs, strict=True):
            self.rngs[row] = rng
            self.draw(row, rng)

    @abstractmethod
    def draw(self, row: int, rng: np.random.Generator) -> None:
        """Draw the start of a game."""

    @abstractmethod
    def play(self, rows: Rows, actions: Array) -> Played:
        """Play a step on some tables, with an action for each, (n, A)."""

    @abstractmethod
    def observe(self, rows: Rows) -> NDArray[np.float32]:
        """Return what the players see whose turn it is, (n, ...)."""

    def seen(self, rows: Rows) -> NDArray[np.float32]:
        """Return the same, all numbers in a row, (n, K)."""
        return self.observe(rows).reshape(len(rows), -1)

    def scene_of(self, x: Array, changes: Mapping[str, Any] | None = None) -> Scene:
        """Return the scene with the balls at places (B, 3), m, without those whose place is NaN, and with changes of it."""
        there = np.flatnonzero(np.isfinite(x[:, 0])).tolist()
        scene = replaced(self.scene, {"balls": [self.scene.balls[k] for k in there]})
        return replaced(scene, {f"balls.{i}.position": tuple(x[k]) for i, k in enumerate(there)} | dict(changes or {}))

    def shown(self, row: int, mode: str) -> str | NDArray[np.uint8]:
        """Return the last shot, or step, of a table; before the first one the balls there.

        In words, a line for each ball ("ansi"), or as a picture, (high, 640, 3) bytes ("rgb_array").
        """
        played = np.flatnonzero(self._last[0] == row)
        if self.taken[row] and len(played):
            x, v, w = (one[played[0]] for one in self._last[1:])
        else:
            x, v, w = np.array([ball.center for ball in self.scene.balls]), *np.zeros((2, len(self.scene.balls), 3))
            x[:, :2] = self.observe(np.array([row]))[0, : len(x), :2]
        there = enumerate(np.flatnonzero(np.isfinite(x[:, 0])).tolist())
        start = {f"balls.{i}.{name}": tuple(of[k]) for i, k in there for name, of in (("velocity", v), ("spin", w))}
        run = simulate(self.scene_of(x, start))
        return "\n".join(run.describe()) if mode == "ansi" else picture(run, self.high[0, :2])

    def clipped(self, actions: Array) -> Array:
        """Return actions (n, A) within their bounds. Raises CaromError for another shape, and for what is no number."""
        names = list(self.bounds)
        found = np.asarray(actions, dtype=float)
        if found.ndim != 2 or found.shape[1] != len(names) or not np.isfinite(found).all():
            expected = f"actions of {len(names)} finite numbers: {', '.join(names)}"
            raise CaromError(f"{type(self).__name__}: expected {expected}, got shape {found.shape[1:]}")
        low, high = np.array(list(self.bounds.values())).T
        return np.asarray(np.clip(found, low, high))
