"""carom: a ball meets a wall; what does it do next, and which law of impact is right?

    import carom
    ball = carom.Ball(radius=0.02625, mass=0.1406)
    hit = carom.two_step(ball, carom.rolling(ball, velocity=(-1.0, 1.0)))
    hit.reflection_angle, hit.flight.height

The public names stand in ``__init__.pyi``; each is imported when it is first used, so that ``import carom`` is quick.
"""

from carom.public.interrupts import end_at_once_while_starting as _end_at_once_while_starting

_end_at_once_while_starting()
__version__ = "0.2.0"


def __getattr__(name: str) -> object:
    """Return a public name; the first that is asked for loads what finds them (the command's help needs none)."""
    from carom.public.guard import attach_public

    globals().update(zip(("__getattr__", "__dir__", "__all__"), attach_public(__name__, __file__), strict=True))
    return globals()[name] if name == "__all__" else globals()["__getattr__"](name)


def __dir__() -> list[str]:
    return list(globals().get("__all__") or __getattr__("__all__"))  # type: ignore[call-overload]
