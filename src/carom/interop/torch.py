"""Runs as functions of PyTorch, with exact derivatives."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

from carom.files import import_optional
from carom.interop.run_function import RunFunction
from carom.scene.scene import Scene

__all__ = ["function"]


def function(scene: Scene, wrt: str | Iterable[str], of: str = "final.position") -> Callable[[Any], Any]:
    """Return the final state of a scene as a function of numbers of it, which PyTorch differentiates.

    Parameters
    ----------
    scene : Scene
    wrt : paths, as for ``run.sensitivity``
        ``function.columns`` has the names of the p numbers, ``function.start`` their values in the scene.
    of : "final.position", "final.velocity" or "final.spin"

    Returns
    -------
    function of a tensor (..., p)
        Returns (..., B, 3); a batch is run at once, on all cores. ``backward``, ``torch.autograd.functional.jacobian`` and
        ``torch.func.jvp`` go through it, ``torch.func.vmap`` makes a batch of it. Second derivatives are refused.

    Raises CaromError for paths that are refused, without PyTorch, and in a call where a scene or its run is refused.
    """
    torch = import_optional("torch", "interop.torch")
    run = RunFunction(scene, wrt, of, "interop.torch.function")

    class FinalState(torch.autograd.Function):  # type: ignore[misc, name-defined]
        """Final state and derivatives (not an output that is differentiated again)."""

        @staticmethod
        def forward(x: Any) -> tuple[Any, Any]:
            found, slopes = run.differentiate(x.detach().cpu().numpy())
            return tuple(torch.as_tensor(one, dtype=x.dtype, device=x.device) for one in (found, slopes))

        @staticmethod
        def setup_context(ctx: Any, inputs: Any, output: Any) -> None:
            del inputs
            ctx.mark_non_differentiable(output[1])
            ctx.save_for_backward(output[1])
            ctx.save_for_forward(output[1])

        @staticmethod
        @torch.autograd.function.once_differentiable  # type: ignore[untyped-decorator]
        def backward(ctx: Any, gradient: Any, _slopes: Any) -> Any:
            (slopes,) = ctx.saved_tensors
            return (gradient.unsqueeze(-1) * slopes).sum(dim=(-3, -2))

        @staticmethod
        def jvp(ctx: Any, tangent: Any) -> tuple[Any, None]:
            (slopes,) = ctx.saved_tensors
            return (slopes * tangent[..., None, None, :]).sum(dim=-1), None

        @staticmethod
        def vmap(_info: Any, dims: Any, x: Any) -> tuple[Any, Any]:
            batch = x.movedim(dims[0], 0)
            return FinalState.apply(batch), (0, 0)

    def call(x: Any) -> Any:
        return FinalState.apply(torch.as_tensor(x))[0]

    call.columns, call.start = run.columns, run.start  # type: ignore[attr-defined]
    return call
