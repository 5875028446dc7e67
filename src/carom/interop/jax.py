"""Runs as functions of JAX: values and exact derivatives, forward and reverse, batched over all cores."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from carom.bodies import Ball
from carom.errors import CaromError
from carom.files import import_optional
from carom.interop.run_function import RunFunction, impact_in
from carom.scene.scene import Scene


def function(scene: Scene, wrt: str | Iterable[str], of: str = "final.position") -> Callable[[Any], Any]:
    """Return the final state of a scene as a function of numbers of it, which JAX differentiates, batches and compiles around.

    Parameters
    ----------
    scene : Scene
    wrt : paths, as for ``run.sensitivity``
        ``function.columns`` has the names of the p numbers, ``function.start`` their values in the scene. Starts and numbers of
        surfaces are quick; for lengths, angles and strikes each point needs a scene of its own, some 50 times the time.
    of : "final.position", "final.velocity" or "final.spin"

    Returns
    -------
    function of an array (p,)
        Returns (B, 3). ``jax.jacfwd``, ``jax.grad`` and ``jax.vmap`` go through it (a batch is run at once, on all cores),
        ``jax.jit`` goes round it: the run itself is a callback. It is computed in double precision and returned in JAX's default
        one, which is single unless ``jax_enable_x64`` is set.

    Raises CaromError for paths that are refused, or without JAX; in a call for another shape, for numbers that the scene refuses
    (NaN, say), and for second derivatives. Under ``jax.jit`` and ``jax.vmap`` what the scene refuses is wrapped in an error of JAX.

    Examples
    --------
    >>> import carom, jax
    >>> wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.5, friction=0)
    >>> ball = carom.SceneBall(radius=0.1, mass=0.2, position=(1.1, 0, 0), velocity=(-2, 1, 0))
    >>> scene = carom.Scene(gravity=0, walls=[wall], balls=[ball], run=carom.Run(duration=1))
    >>> place = carom.interop.jax.function(scene, ["balls.0.velocity.x", "walls.0.restitution"])
    >>> jax.jacfwd(place)(jax.numpy.array([-2.0, 0.5]))[0, 0].round(3).tolist()
    [-0.5, 1.0]
    """
    jax = import_optional("jax", "interop.jax")
    run = RunFunction(scene, wrt, of, "interop.jax.function")
    numbers = jax.numpy

    def outside(compute: Callable[[Any], Any], *shapes: tuple[int, ...]) -> Callable[[Any], Any]:
        """Return a function that NumPy computes: at once, or from within jit and vmap as a callback."""

        def called(x: Any) -> Any:
            kind = numbers.result_type(x, float)

            def computed(x: Any) -> tuple[Any, ...]:
                return tuple(one.astype(kind) for one in compute(np.asarray(x)))

            if not isinstance(x, jax.core.Tracer):  # (what is refused is not wrapped by JAX)
                return tuple(map(numbers.asarray, computed(x)))
            made = tuple(jax.ShapeDtypeStruct(shape, kind) for shape in shapes)
            return jax.pure_callback(computed, made, x, vmap_method="broadcast_all")

        return called

    value = outside(lambda x: (run.evaluate(x),), run.shape)
    both = jax.custom_jvp(outside(run.differentiate, run.shape, (*run.shape, len(run.columns))))

    @both.defjvp  # type: ignore[untyped-decorator]
    def second(_primals: Any, _tangents: Any) -> Any:
        raise CaromError(
            "interop.jax.function: expected first derivatives, got a derivative of one (jax.hessian, a gradient of a gradient):"
            " they are exact, but do not support JVP themselves; take differences of the gradient"
        )

    @jax.custom_jvp  # type: ignore[untyped-decorator]
    def final(x: Any) -> Any:
        return value(x)[0]

    @final.defjvp  # type: ignore[untyped-decorator]
    def final_jvp(primals: Any, tangents: Any) -> Any:
        found, slopes = both(primals[0])
        # (linear in the tangent: JAX transposes it for reverse mode)
        return found, slopes @ tangents[0]

    def call(x: Any) -> Any:
        try:
            given = numbers.asarray(x)
        except (TypeError, ValueError) as error:
            said = str(error).splitlines()[0]
            raise CaromError(
                f"interop.jax.function: expected an array ({len(run.columns)},) of numbers, got {said}"
            ) from None
        if given.dtype.kind not in "iuf" and not numbers.issubdtype(given.dtype, numbers.floating):
            raise CaromError(f"interop.jax.function: expected real numbers, got {given.dtype}")
        if given.shape != (len(run.columns),):
            raise CaromError(
                f"interop.jax.function: expected {len(run.columns)} numbers ({', '.join(run.columns)}), got shape {given.shape};"
                " jax.vmap takes many"
            )
        return final(numbers.asarray(given, dtype=numbers.result_type(given, float)))

    call.columns, call.start = run.columns, run.start  # type: ignore[attr-defined]
    return call


def impact(
    velocity: Any,
    spin: Any,
    *,
    ball: Ball | None = None,
    normal: Any = (1.0, 0.0, 0.0),
    restitution: Any = 1.0,
    friction: Any = math.inf,
    tangential_restitution: Any = 0.0,
) -> tuple[Any, Any]:
    """Return velocity and spin just after one contact, as :func:`carom.impact` has them, in JAX's own operations.

    Parameters
    ----------
    velocity, spin, normal : arrays (..., 3)
        m/s and rad/s before the contact; from the surface to the ball, of any length.
    ball : Ball, optional
        Default: ``carom.Ball()``.
    restitution, friction, tangential_restitution : arrays (...)

    Returns
    -------
    velocity, spin : arrays (..., 3)
        ``jax.grad``, ``jax.vmap``, ``jax.jit`` and second derivatives go through it. A ball that moves away is left as it is. Other
        laws, and a wall with a floor: :func:`function` of a scene with ``max_events=1``.

    Examples
    --------
    >>> import carom, jax
    >>> push = lambda mu: carom.interop.jax.impact((-1.0, 1.0, 0.0), (0.0, 0.0, 0.0), restitution=0.9, friction=mu)[0][1]
    >>> round(float(push(0.1)), 4), round(float(jax.grad(push)(0.1)), 4)
    (0.81, -1.9)
    """
    numbers = import_optional("jax", "interop.jax").numpy
    given = (velocity, spin, normal, restitution, friction, tangential_restitution)
    return impact_in(numbers, lambda x: numbers.asarray(x, dtype=float), ball or Ball(), *given)
