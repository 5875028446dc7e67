"""Symbolic coding: the walls that orbits meet as letters, words that occur and words that do not, growth of their number."""

from __future__ import annotations

import math
import string
from collections import Counter
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.billiards.boundary import Boundary
from carom.billiards.orbits import Orbit, require_integer
from carom.errors import CaromError, Fault

__all__ = ["LETTERS", "Words", "code_numbers", "itinerary", "letters_of", "words"]

LETTERS = string.ascii_uppercase + string.ascii_lowercase


def letters_of(numbers: Any) -> str:
    """Return walls by number as one text; beyond 52 walls their numbers with dots between."""
    walls = [int(k) for k in numbers]
    return "".join(LETTERS[k] for k in walls) if max(walls, default=0) < len(LETTERS) else ".".join(map(str, walls))


def code_numbers(shape: Boundary, code: Any) -> list[int]:
    """Return the walls of a code such as "ABC" or "0.1.2" by number; CaromError where it is none of the table."""
    count = int(shape.parts.max(initial=-1)) + 1
    text = str(code)
    parts = text.split(".") if "." in text else list(text)
    known = {letter: k for k, letter in enumerate(LETTERS[:count])} | {str(k): k for k in range(count)}
    if len(parts) < 2 or any(one not in known for one in parts):
        last = letters_of([count - 1])
        raise CaromError(
            Fault("orbit", "itinerary", f"two walls or more, letters from A to {last}, such as AB", repr(text))
        )
    return [known[one] for one in parts]


def itinerary(found: Orbit) -> str | NDArray[np.str_]:
    """Return the walls that orbits meet as letters: A for the first piece of the boundary, B for the second.

    The pieces are those of :attr:`Orbit.piece` in order; images of an obstacle have its letter, and arcs of a smooth curve between
    corners are one wall. Beyond 52 walls numbers with dots between stand in place of letters.

    Parameters
    ----------
    found : Orbit, one or many

    Returns
    -------
    str, or array (...) of them

    Examples
    --------
    >>> from carom import billiards
    >>> found = billiards.orbit(billiards.rectangle(2.0, 1.0), ((0.0, 0.1), (1.0, 0.5), 0.0), bounces=6, law="mirror")
    >>> billiards.itinerary(found)
    'CBADCB'
    """
    numbers = found.setup.shape.wall_parts(found.piece)
    rows = numbers.reshape(-1, numbers.shape[-1])
    texts = [letters_of(row[:n]) for row, n in zip(rows, np.ravel(found.count), strict=True)]
    return np.array(texts).reshape(numbers.shape[:-1]) if numbers.ndim > 1 else texts[0]


@dataclass(frozen=True, eq=False)
class Words:
    """Words of orbits: how many of each length occur, and which do not.

    Examples
    --------
    Three discs in the plane: no disc follows itself, and all other words occur.

    >>> from carom import billiards
    >>> table = billiards.sinai(0.3)
    >>> found = billiards.words(billiards.orbit(billiards.rectangle(), billiards.starts(billiards.rectangle(), 99), 200), 3)
    >>> found.number, found.pruned[0][:3]
    ([4, 12, 36], ['AA', 'BB', 'CC'])
    """

    counts: tuple[dict[str, int], ...]
    """Number of times that each word of 1, 2, ... walls occurs."""
    symbols: tuple[str, ...]
    """Letters that occur."""

    @property
    def number(self) -> list[int]:
        """Number of different words of 1, 2, ... walls."""
        return [len(one) for one in self.counts]

    @property
    def entropy(self) -> list[float]:
        """ln(N(n)/N(n - 1)) for n = 2, 3, ...: it tends to the topological entropy per bounce where all words are seen."""
        return [math.log(b / a) for a, b in zip(self.number, self.number[1:], strict=False)]

    @property
    def unseen(self) -> list[float]:
        """Estimated chance that one more word of 1, 2, ... walls is a new one: the share of words seen once (Good 1953)."""
        return [sum(k == 1 for k in one.values()) / sum(one.values()) for one in self.counts]

    @property
    def pruned(self) -> list[list[str]]:
        """Words of 2, 3, ... walls that do not occur although their beginnings and ends do, and chance would show them 10 times."""
        found = []
        for shorter, longer in zip(self.counts, self.counts[1:], strict=False):
            total = sum(shorter.values())
            middles = Counter[str]()
            for word, count in shorter.items():
                middles[word[1:]] += count
            found.append(
                sorted(
                    word + end[-1]
                    for word in shorter
                    for end in shorter
                    if word[1:] == end[:-1]
                    and word + end[-1] not in longer
                    and shorter[word] * shorter[end] >= EXPECTED * (middles[word[1:]] if word[1:] else total)
                )
            )
        return found


EXPECTED = 10.0  # times that a word must be expected, by the words of one wall less, before it counts as pruned


def words(found: Orbit, longest: int, symbols: str | None = None) -> Words:
    """Count the words of 1 to ``longest`` walls in the itineraries of orbits.

    Parameters
    ----------
    found : Orbit
        One or many; long orbits show more words.
    longest : int
        Length of the longest words.
    symbols : str, optional
        A letter for each wall, in the order of :func:`itinerary`: "ABAB" counts opposite sides of a rectangle as one.

    Returns
    -------
    Words

    Raises
    ------
    CaromError
        A number of letters that is not the number of walls; more than 52 walls.

    Examples
    --------
    Sides of a square by their direction, with the mirror law: there are 1 + sum of (n - k + 1) phi(k) words of length n (Mignosi
    1991), so that the entropy is zero.

    >>> from carom import billiards
    >>> table = billiards.rectangle(1.0, 1.0)
    >>> run = billiards.orbit(table, billiards.starts(table, 500, law="mirror"), 100, law="mirror")
    >>> billiards.words(run, 5, "ABAB").number
    [2, 4, 8, 14, 24]
    """
    longest = require_integer("longest", longest)
    count = int(found.setup.shape.parts.max(initial=-1)) + 1
    letters = LETTERS[:count] if symbols is None else symbols
    if len(letters) != count:
        raise CaromError(
            Fault("words", "symbols", f"{count} letters, one for each wall, and at most 52 walls", repr(symbols))
        )
    numbers = found.setup.shape.wall_parts(found.piece)
    table = np.array([*letters, ""])
    rows = numbers.reshape(-1, numbers.shape[-1])
    texts = ["".join(table[row[:n]]) for row, n in zip(rows, np.ravel(found.count), strict=True)]
    counts = [
        Counter(text[k : k + n] for text in texts for k in range(len(text) - n + 1)) for n in range(1, longest + 1)
    ]
    return Words(tuple(dict(one) for one in counts), tuple(sorted(set(letters))))
