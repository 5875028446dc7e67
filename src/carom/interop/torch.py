"""Runs as functions of PyTorch, with exact derivatives."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import Any

from carom.bodies import Ball
from carom.errors import CaromError
from carom.files import import_optional
from carom.interop.run_function import RunFunction, impact_in
from carom.scene.scene import Scene

WHERE = "interop.torch.function"
NOT_TWICE = (
    f"{WHERE}: expected first derivatives, got a second one, which is not followed through a run;"
    " take differences of the gradient"
)


def function(scene: Scene, wrt: str | Iterable[str], of: str = "final.position") -> Callable[[Any], Any]:
    """Return the final state of a scene as a function of numbers of it, which PyTorch differentiates.

    Parameters
    ----------
    scene, wrt, of : as of :func:`carom.interop.jax.function`
        ``function.columns`` has the names of the p numbers, ``function.start`` their values in the scene.

    Returns
    -------
    function of a tensor (..., p)
        Returns (..., B, 3); a batch is run at once, on all cores. ``backward``, ``torch.autograd.functional.jacobian`` and
        ``torch.func.jvp`` go through it, ``torch.func.vmap`` makes a batch of it. An empty batch gives an
        empty result. Second derivatives are refused.

    Raises CaromError for paths that are refused, without PyTorch, and in a call where a scene or its run is refused, for numbers
    that are not real floating-point ones, and where a derivative is differentiated again.
    """
    torch = import_optional("torch", "interop.torch")
    run = RunFunction(scene, wrt, of, WHERE)

    class SlopesOf(torch.autograd.Function):  # type: ignore[misc, name-defined]
        """The derivatives as a function of the numbers: what is differentiated a second time passes through here."""

        generate_vmap_rule = True

        @staticmethod
        def forward(_x: Any, slopes: Any) -> Any:
            return slopes.clone()

        @staticmethod
        def setup_context(ctx: Any, inputs: Any, output: Any) -> None:
            del ctx, inputs, output

        @staticmethod
        def backward(_ctx: Any, _gradient: Any) -> Any:
            raise CaromError(NOT_TWICE)

        @staticmethod
        def jvp(_ctx: Any, _x: Any, _slopes: Any) -> Any:
            raise CaromError(NOT_TWICE)

    class FinalState(torch.autograd.Function):  # type: ignore[misc, name-defined]
        """Final state and derivatives (not an output that is differentiated again)."""

        @staticmethod
        def forward(x: Any) -> tuple[Any, Any]:
            found, slopes = run.differentiate(x.detach().cpu().double().numpy())
            return tuple(torch.as_tensor(one, dtype=x.dtype, device=x.device) for one in (found, slopes))

        @staticmethod
        def setup_context(ctx: Any, inputs: Any, output: Any) -> None:
            ctx.mark_non_differentiable(output[1])
            ctx.save_for_backward(*inputs, output[1])
            ctx.save_for_forward(*inputs, output[1])

        @staticmethod
        def backward(ctx: Any, gradient: Any, _slopes: Any) -> Any:
            return (gradient.unsqueeze(-1) * SlopesOf.apply(*ctx.saved_tensors)).sum(dim=(-3, -2))

        @staticmethod
        def jvp(ctx: Any, tangent: Any) -> tuple[Any, None]:
            x, slopes = ctx.saved_tensors
            # (without the tangent that is followed now; one of another level is that of a second derivative)
            x = torch.autograd.forward_ad.unpack_dual(x).primal
            return (SlopesOf.apply(x, slopes) * tangent[..., None, None, :]).sum(dim=-1), None

        @staticmethod
        def vmap(_info: Any, dims: Any, x: Any) -> tuple[Any, Any]:
            batch = x.movedim(dims[0], 0)
            return FinalState.apply(batch), (0, 0)

    def call(x: Any) -> Any:
        x = torch.as_tensor(x)
        if not x.dtype.is_floating_point:
            raise CaromError(f"{WHERE}: expected a tensor of real floating-point numbers, got {x.dtype}")
        return FinalState.apply(x)[0]

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
    """Return velocity and spin just after one contact, in PyTorch's own operations: see :func:`carom.interop.jax.impact`.

    Numbers are made tensors of the type and on the device of the first tensor that is given; of float64 without one.
    """
    torch = import_optional("torch", "interop.torch")
    given = (velocity, spin, normal, restitution, friction, tangential_restitution)
    first = next((x for x in given if torch.is_tensor(x)), torch.zeros(0, dtype=torch.float64))

    def array(x: Any) -> Any:
        return torch.as_tensor(x, dtype=first.dtype, device=first.device)

    return impact_in(torch, array, ball or Ball(), *given)
