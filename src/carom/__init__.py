"""carom: a ball meets a wall; what does it do next, and which law of impact is right?

    import carom
    ball = carom.Ball(radius=0.02625, mass=0.1406)
    hit = carom.two_step(ball, carom.rolling(ball, velocity=(-1.0, 1.0)))
    hit.reflection_angle, hit.flight.height

The public names stand in ``__init__.pyi``; each is imported when it is first used, so that ``import carom`` is quick.
"""

from carom.public.interrupts import end_at_once_while_starting as _end_at_once_while_starting

_end_at_once_while_starting()

from carom.public.guard import attach_public as _attach_public  # noqa: E402
from carom.public.other_rooms import find_functions_with as _find_functions_with  # noqa: E402

__getattr__, __dir__, __all__ = _attach_public(__name__, __file__)
_find_functions_with(lambda room, name: getattr(__getattr__(room), name))
__version__ = "0.2.0"
