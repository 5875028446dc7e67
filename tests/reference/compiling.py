"""Functions that the compiled loops of the references call, without the compiling of each by itself.

``numba.njit`` brings a function to machine code alone, and once more within each loop that calls it: half of the time, for
nothing. A part stays a plain function for Python; in a loop that ``carom.core.jit.compile.njit`` compiles it is optimised with
the rest. It makes no arrays. It stands in the loop's own file: the cache of compiled code looks at that file only.
"""

from collections.abc import Callable
from typing import TypeVar

from numba.extending import register_jitable

from carom.core.jit.cache import cache_folder
from carom.core.jit.compile import KERNEL_OPTIONS, linked_only

Part = TypeVar("Part", bound=Callable[..., object])


def part(function: Part) -> Part:
    """Make a function callable from compiled loops."""
    made: Part = register_jitable(**KERNEL_OPTIONS, **linked_only(cache_folder()))(function)
    return made
