"""carom's laws in pooltool: an engine for ``pooltool.simulate``, and names for resolver files."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from carom.bodies import Surface
from carom.errors import CaromError, require_type
from carom.interop.pooltool.physics import has_flights, require_pooltool
from carom.laws.law import Law
from carom.laws.registry import law_named

if TYPE_CHECKING:
    from pooltool.physics import PhysicsEngine


def engine(
    cushion: str | Law = "two-step",
    wall: Surface | None = None,
    ball_ball: Literal["carom"] | None = "carom",
    *,
    is_3d: bool = False,
) -> PhysicsEngine:
    """Make a physics engine for ``pooltool.simulate`` in which a law of carom's acts at the cushions.

    pooltool's main branch (June 2026) lets balls fly, with ``is_3d=True``: the ball leaves a cushion with its vertical velocity and
    lands on carom's floor, with the ball's e_t and u_s. Cushions do not hold a ball in the air, as main does not look for them.

    pooltool 0.6.0, and main in two dimensions, have no gravity. The ball that a cushion lifts lands at once, with the impulse
    that the cloth would give it after the flight (cloth: the ball's u_s, no restitution). The flights that are left out are
    listed by ``engine.resolver.ball_linear_cushion.flights`` (carom.Flight; that of the jaws is the same list) and, for balls
    that throw each other up, ``engine.resolver.ball_ball.flights``; the first one of each list is a warning.

    Parameters
    ----------
    cushion : str or carom.Law
        A law by name, such as "two-step", "mathavan2010", "mirror", or a custom one.
    wall : carom.Surface, optional
        The cushion's restitution and friction, for straight cushions and jaws. Default: the balls' own e_c and f_c.
    ball_ball : "carom" or None
        carom.collide, with the balls' e_b and u_b, where balls meet; None: pooltool's own model, which is for two dimensions.
    is_3d : bool
        Whether balls fly; with pooltool's main branch only.

    Returns
    -------
    pooltool.physics.PhysicsEngine, or pooltool.evolution.SimulationEngine (main)
        pooltool's default models in everything else.

    Raises
    ------
    CaromError
        For an unknown law or surface; for flights where pooltool has none; without pooltool (MissingLibraryError). During a run:
        where the law has no answer.

    Examples
    --------
    >>> import carom.interop.pooltool
    >>> import pooltool as pt                                                       # doctest: +SKIP
    >>> shot = pt.System.example()                                                  # doctest: +SKIP
    >>> pt.simulate(shot, engine=carom.interop.pooltool.engine(), inplace=True)     # doctest: +SKIP
    """
    if not isinstance(cushion, Law):
        require_type("engine", "cushion", cushion, str)
        cushion = law_named(cushion).name
    if wall is not None:
        require_type("engine", "wall", wall, Surface)
        if any(np.ndim(x) for x in (wall.restitution, wall.friction, wall.tangential_restitution)):
            raise CaromError("engine: wall: expected one surface, got arrays of numbers; give single numbers")
    if ball_ball not in ("carom", None):
        raise CaromError(f"engine: ball_ball: expected 'carom' or None (pooltool's model), got {ball_ball!r:.60}")
    require_type("engine", "is_3d", is_3d, bool)
    require_pooltool("engine")
    if is_3d and not has_flights():
        raise CaromError(
            "engine: is_3d: expected False, as pooltool 0.6.0 has no flights, got True; its main branch has"
        )
    if is_3d and ball_ball is None:
        raise CaromError(
            "engine: ball_ball: expected 'carom' where balls fly, as pooltool's own models are for two dimensions, got None;"
            " is_3d=False keeps them"
        )
    from carom.interop.pooltool.models import build_engine

    return build_engine(cushion, wall, ball_ball == "carom", is_3d)


def register() -> None:
    """Make carom's models known to pooltool, so that resolvers with them can be saved to YAML or JSON, and loaded.

    Their names are ``carom_cushion`` (fields law, restitution, friction, tangential_restitution) and ``carom_collide``
    (restitution, friction), both with is_3d; and, with pooltool's main branch, ``carom_floor`` (restitution, friction,
    least_bounce). Load such a file by ``Resolver.load(path)`` after ``register()``. Keep it out of pooltool's own folder
    of settings: pooltool reads that one while it is imported, before anything can be registered, and moves it away as malformed.

    Raises
    ------
    CaromError
        Without pooltool 0.6 (MissingLibraryError).

    Examples
    --------
    >>> import carom.interop.pooltool
    >>> carom.interop.pooltool.register()                                           # doctest: +SKIP
    """
    require_pooltool("register")
    from carom.interop.pooltool.models import register_models

    register_models()


def use_as_default(own: Any) -> None:
    """Let pooltool, in this process, play with an engine wherever none is given, as in its game."""
    import pooltool.evolution.event_based.simulate  # noqa: F401  (the package has a function of that name)

    default = sys.modules["pooltool.evolution.event_based.simulate"].DEFAULT_ENGINE
    for name in ("is_3d", "detector", "resolver"):
        if hasattr(own, name):
            setattr(default, name, getattr(own, name))
