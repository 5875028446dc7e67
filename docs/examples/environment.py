"""A player who aims by ``carom.aim``; and shots that are found under one law of impact and played under others.

python docs/examples/environment.py 20      # clears 20 racks, as far as it comes
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

import carom
import carom.env

Array = NDArray[np.float64]
SPEEDS = (0.8, 4.0)  # m/s
NARROW = 2.5  # degrees beside the line to the place where the cue ball pots
LOOKED_AT = 4  # of pots, the easiest ones
SAFE = 0.9  # of shots that succeed under a player's error: no further pot is looked at
SHOTS = 2000  # that are tried where no pot is found


class AimingPlayer:
    """A player of one table.

    At eight-ball it aims at the easiest pots (by the cut and both distances), and takes the one that forgives most of a player's
    error; of 2,000 shots at random the best where it finds none. At three-cushion it aims at both balls by three cushions.
    """

    def __init__(self, game: Any, starts: int = 128) -> None:
        self.game, self.starts = game, starts

    def action(self) -> Array:
        """Return the next shot: speed, angle, side, top, elevation."""
        game, row = self.game, np.zeros(1, int)
        places, lies, cue = game.places[0], game.lies[0], int(game.cue(row)[0])
        pool = isinstance(game, carom.env.EightBall)
        if pool and game.taken[0] == 0:
            return shot(7.0, angle(game.start[1] - places[0]))
        i = int(lies[:cue].sum())
        x = np.column_stack([np.where(lies[:, None], places, np.nan), np.full(len(lies), game.radius)])
        scene = game.scene_of(x, {f"balls.{i}.strike": {"speed": 1.0, "azimuth": 0.0}})
        paths = f"balls.{i}.strike.azimuth", f"balls.{i}.strike.speed"
        if pool:
            wanted = [
                (
                    {paths[0]: (way - NARROW, way + NARROW), paths[1]: SPEEDS},
                    {"ball": int(lies[:k].sum()), "pocket": "any"},
                )
                for _ease, k, way in self.pots()[:LOOKED_AT]
            ]
        else:
            both = {"ball": i, "hit": (1 - i, 2), "cushions": 3}
            wanted = [({paths[0]: (0.0, 360.0), paths[1]: (1.5, 7.0)}, both)]
        found = []
        for free, reach in wanted:
            try:
                aims = carom.aim(scene, free, reach, starts=self.starts if pool else 32 * self.starts, solutions=2)
            except carom.CaromError:  # (no start reaches it)
                continue
            for one in aims:
                action = shot(one.values["speed"], one.values["azimuth"])
                if game.foresee(0, action[None]).reward[0] > 0:
                    found.append((one.chance, action))
            if found and max(found, key=lambda one: one[0])[0] > SAFE:
                break
        if found:
            return max(found, key=lambda one: one[0])[1]
        low, high = np.array(list(game.bounds.values())).T
        tried = np.random.default_rng(int(game.taken[0])).uniform(low, high, (SHOTS, 5)) * (1, 1, 0.5, 0.5, 0)
        played = game.foresee(0, tried)
        return np.asarray(tried[np.argmax(played.reward - 0.1 * (played.info.get("foul", np.zeros(SHOTS)) > 0))])

    def pots(self) -> list[tuple[float, int, float]]:
        """Return how easy each pot is, the ball, and the direction, degrees, from the easiest on."""
        game, a = self.game, self.game.radius
        places, lies = game.places[0], game.lies[0]
        x, y = game.size
        found = []
        for k in np.flatnonzero(game.targets(np.zeros(1, int))[0]).tolist():
            for pocket in np.array([(x, y), (x, -y), (-x, y), (-x, -y), (0, y), (0, -y)]):
                way = pocket - places[k]
                ghost = places[k] - 2 * a * way / np.linalg.norm(way)
                come = ghost - places[0]
                far = float(np.linalg.norm(come) * np.linalg.norm(way))
                cut = float(come @ way) / far
                beside = [places[j] for j in range(1, 16) if lies[j] and j != k]
                free = all(min(near(places[0], ghost, one), near(places[k], pocket, one)) > 2 * a for one in beside)
                if cut > 0.2 and free:
                    found.append((cut**2 / far, k, angle(come)))
        return sorted(found, reverse=True)


def shot(speed: float, way: float) -> Array:
    """Return a shot in the middle of the ball."""
    return np.array([speed, (way + 180) % 360 - 180, 0.0, 0.0, 0.0])


def angle(way: Array) -> float:
    """Return a direction in degrees."""
    return float(np.degrees(np.arctan2(way[1], way[0])))


def near(start: Array, end: Array, place: Array) -> float:
    """Return how near a straight way comes to a place, m."""
    way = end - start
    return float(np.linalg.norm(start + np.clip((place - start) @ way / (way @ way), 0, 1) * way - place))


def win_rates(laws: Sequence[str], tables: int = 12, tries: int = 800, seed: int = 1) -> Array:
    """Return the share of tables (trained, played) on which a three-cushion shot that scores under one law does under another.

    The shot is found among ``tries`` at random, from places of the balls at random: the scoring one whose neighbours score most.
    """
    rng = np.random.default_rng(seed)
    games = [carom.env.ThreeCushion(1, law=law) for law in laws]
    low, high = np.array(list(games[0].bounds.values())).T
    reach, scored, count = 0.9 * games[0].size, np.zeros((len(laws), len(laws))), np.zeros(len(laws))
    for _table in range(tables):
        places, tried = rng.uniform(-reach, reach, (3, 2)), rng.uniform(low, high, (tries, 5)) * (1, 1, 1, 1, 0)
        for game in games:
            game.places[0] = places
        for i, game in enumerate(games):
            good = tried[game.foresee(0, tried).reward > 0]
            if len(good):
                beside = good[:, None] + rng.normal(size=(len(good), 20, 5)) * (0.05, 0.3, 0.01, 0.01, 0)
                sure = game.foresee(0, beside.reshape(-1, 5)).reward.reshape(len(good), 20).sum(axis=1)
                best = good[np.argmax(sure)][None]
                count[i] += 1
                scored[i] += [other.foresee(0, best).reward[0] for other in games]
    return scored / np.maximum(count, 1)[:, None]


def sum_to_three(games: int, tries: int = 0, seed: int = 0) -> tuple[float, float]:
    """Return the mean points of games of ten shots at random, and its standard error.

    With ``tries``: of that many shots at random, foreseen, the first that scores.
    """
    rng, rows = np.random.default_rng(seed), np.arange(games)
    game = carom.env.SumToThree(games)
    game.begin(rows, [rng] * games)
    low, high = np.array(list(game.bounds.values())).T
    points = np.zeros(games)
    for _shot in range(game.most):
        actions = rng.uniform(low, high, (games, 2))
        for row in rows.tolist() if tries else ():
            tried = rng.uniform(low, high, (tries, 2))
            actions[row] = tried[np.argmax(game.foresee(row, tried).reward)]
        points += game.play(rows, actions).reward
    return float(points.mean()), float(points.std(ddof=1) / np.sqrt(games))


def racks(count: int, seed: int = 0) -> dict[str, float]:
    """Return how the player does on so many racks: share of shots after the break that pot, of racks cleared in one turn."""
    made = shots = cleared = won = 0
    game = carom.env.EightBall(1)
    for k in range(count):
        game.begin(np.zeros(1, int), [np.random.default_rng(seed + k)])
        player, over, first = AimingPlayer(game), False, True
        while not over:
            played = game.play(np.zeros(1, int), player.action()[None])
            over = bool(played.ended[0] or played.cut[0])
            if not first:
                made, shots = made + int(played.reward[0] > 0), shots + 1
            first = False
        cleared, won = cleared + int(played.info["cleared"][0]), won + int(played.info["won"][0] > 0)
    return {"shots": shots, "pots": made / shots, "cleared": cleared / count, "won": won / count}


if __name__ == "__main__":
    print(racks(int(sys.argv[1]) if len(sys.argv) > 1 else 5))
