"""What the contacts of each kind did: how often they came, and the energy that went through them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from carom.gas.run import Gas, Mark

__all__ = ["Channel", "channels"]


@dataclass(frozen=True)
class Channel:
    """The contacts between two species, or between a species and a wall."""

    between: tuple[str, str]
    collisions: int
    rate: float
    """Collisions a time and ball of the first species."""
    lost_normal: float
    """Energy that the restitution took."""
    lost_tangential: float
    """Energy that friction and tangential restitution took."""
    to_spin: float
    """Energy that went from the motion of the centres to the spins."""


def channels(gas: Gas, since: Mark, names: tuple[str, ...]) -> list[Channel]:
    """Of each pair of species, and of each species and wall, what its contacts did since a mark."""
    arrays, kinds, t = gas._arrays, len(names), gas.time - since.time
    count = [int((arrays.motions["kind"] == k).sum()) for k in range(kinds)]

    def made(between: tuple[str, str], table: Any, before: Any, rows: set[int], share: float) -> Channel:
        sums = {
            name: sum((table[row][name] - before[row][name]).item() for row in rows)
            for name in ("hits", "normal", "tangential", "spun")
        }
        rate = share * sums["hits"] / t if t > 0 else float("nan")
        return Channel(between, sums["hits"], rate, sums["normal"], sums["tangential"], sums["spun"])

    found = []
    for i in range(kinds):
        for j in range(i, kinds):
            # every collision within a species is one of two of its balls
            share = (2 if i == j else 1) / count[i]
            rows = {i * kinds + j, j * kinds + i}
            found.append(made((names[i], names[j]), arrays.pairs, since.pairs, rows, share))
    for wall in gas.walls:
        faces = [k for k, name in enumerate(gas.faces) if name == wall]  # several may have one name
        for i in range(kinds):
            rows = {face * kinds + i for face in faces}
            found.append(made((names[i], wall), arrays.walls, since.walls, rows, 1 / count[i]))
    return found
