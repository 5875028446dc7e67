"""Runs as functions of PyTorch (``make check-torch``; PyTorch is no part of the tests' own install)."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from reference.sweep_scenes import table_scene

import carom

torch = pytest.importorskip("torch")
# (its own functions warn of each other)
pytestmark = pytest.mark.filterwarnings("ignore::FutureWarning", "ignore::DeprecationWarning")


def test_derivatives_are_those_of_the_run() -> None:
    scene, wrt = table_scene(duration=1.5), ["balls.0.velocity", "walls.*.friction"]
    place = carom.interop.torch.function(scene, wrt)
    run = carom.simulate(scene)
    exact = run.sensitivity(wrt).final.position
    x = torch.tensor(place.start, requires_grad=True)
    assert np.array_equal(place(x).detach().numpy(), run.final.position)
    assert torch.autograd.functional.jacobian(place, x).numpy() == pytest.approx(exact, abs=1e-15)
    place(x)[1, 0].backward()
    assert x.grad.numpy() == pytest.approx(exact[1, 0], abs=1e-15)
    assert torch.autograd.gradcheck(place, (x,), eps=1e-5, atol=1e-5, rtol=1e-4)
    _value, along = torch.func.jvp(place, (x.detach(),), (torch.ones_like(x),))
    assert along.numpy() == pytest.approx(exact.sum(axis=-1), abs=1e-14)


def test_batches() -> None:
    scene = table_scene(duration=1.5)
    place = carom.interop.torch.function(scene, ["balls.0.velocity"])
    points = torch.tensor(place.start + 0.05 * np.arange(4)[:, None], requires_grad=True)
    found = place(points)
    assert found.shape == (4, 3, 3)
    assert torch.equal(torch.func.vmap(place)(points.detach()), found.detach())
    found[:, 0, 0].sum().backward()
    for k in range(4):
        x = points[k].detach().requires_grad_()
        place(x)[0, 0].backward()
        assert points.grad[k].numpy() == pytest.approx(x.grad.numpy(), abs=1e-14)


def gradient_twice(of: Any, x: Any) -> Any:
    """Differentiate a gradient by ``torch.autograd.grad``."""
    (first,) = torch.autograd.grad(of(x), x, create_graph=True)
    return torch.autograd.grad(first.sum(), x)


def dual_of_gradient(of: Any, x: Any) -> Any:
    """Differentiate a gradient forwards, by ``torch.autograd.forward_ad``."""
    with torch.autograd.forward_ad.dual_level():
        dual = torch.autograd.forward_ad.make_dual(x, torch.ones_like(x))
        (first,) = torch.autograd.grad(of(dual), dual, create_graph=True)
        return torch.autograd.forward_ad.unpack_dual(first).tangent


SECOND = {
    "hessian": lambda of, x: torch.func.hessian(of)(x),
    "jacrev of jacrev": lambda of, x: torch.func.jacrev(torch.func.jacrev(of))(x),
    "jacfwd of jacfwd": lambda of, x: torch.func.jacfwd(torch.func.jacfwd(of))(x),
    "jacrev of jacfwd": lambda of, x: torch.func.jacrev(torch.func.jacfwd(of))(x),
    "grad of grad": lambda of, x: torch.func.grad(lambda y: torch.func.grad(of)(y).sum())(x),
    "jvp of grad": lambda of, x: torch.func.jvp(torch.func.grad(of), (x,), (torch.ones_like(x),)),
    "hessians of a batch": lambda of, x: torch.func.vmap(torch.func.hessian(of))(x[None]),
    "functional.hessian": torch.autograd.functional.hessian,
    "functional.hessian, forwards": lambda of, x: torch.autograd.functional.hessian(
        of, x, vectorize=True, outer_jacobian_strategy="forward-mode"
    ),
    "functional.hvp": lambda of, x: torch.autograd.functional.hvp(of, x, torch.ones_like(x)),
    "functional.vhp": lambda of, x: torch.autograd.functional.vhp(of, x, torch.ones_like(x)),
    "grad, twice": lambda of, x: gradient_twice(of, x.requires_grad_()),
    "grad, then forwards": lambda of, x: dual_of_gradient(of, x.requires_grad_()),
    "backward, twice": lambda of, x: (
        torch.autograd.grad(of(x.requires_grad_()), x, create_graph=True)[0].sum().backward()
    ),
    "gradgradcheck": lambda of, x: torch.autograd.gradgradcheck(of, (x.requires_grad_(),)),
}


@pytest.mark.parametrize("way", SECOND)
@pytest.mark.parametrize("wrt", [["balls.0.velocity"], ["walls.*.friction"]])
def test_second_derivatives_are_refused(way: str, wrt: list[str]) -> None:
    place = carom.interop.torch.function(table_scene(duration=0.5), wrt)
    with pytest.raises(
        carom.CaromError, match=r"^interop.torch.function: expected first derivatives, got a second one"
    ):
        SECOND[way](lambda y: place(y).sum(), torch.tensor(place.start, dtype=torch.float64))


def test_first_derivatives_in_every_way() -> None:
    """Also the ways that differentiate a gradient with respect to what it is multiplied by, and linear functions of a run."""
    scene = table_scene(duration=1.5)
    place = carom.interop.torch.function(scene, ["balls.0.velocity"])
    exact = torch.tensor(carom.simulate(scene).sensitivity(["balls.0.velocity"]).final.position)
    x, along = torch.tensor(place.start), torch.tensor([0.3, -0.7], dtype=torch.float64)
    functional = torch.autograd.functional
    with torch.autograd.forward_ad.dual_level():
        dual = place(torch.autograd.forward_ad.make_dual(x, along))
        forwards = torch.autograd.forward_ad.unpack_dual(dual).tangent
    for found in (
        functional.jvp(place, x, along)[1],
        functional.jvp(place, x, along, create_graph=True)[1].detach(),
        torch.func.jvp(place, (x,), (along,))[1],
        forwards,
    ):
        assert torch.allclose(found, exact @ along, atol=1e-14)
    for found in (
        functional.jacobian(place, x),
        functional.jacobian(place, x, vectorize=True),
        functional.jacobian(place, x, vectorize=True, strategy="forward-mode"),
        functional.jacobian(place, x, create_graph=True).detach(),
        torch.func.jacrev(place)(x),
        torch.func.jacfwd(place)(x),
        torch.func.vmap(torch.func.jacfwd(place))(x[None])[0],
        torch.func.vmap(torch.func.jacrev(place))(x[None])[0],
    ):
        assert torch.allclose(found, exact, atol=1e-14)
    # of a function of the run and its derivative only the run's part is differentiated where the derivative is taken as a number
    y = x.clone().requires_grad_()
    (slope,) = torch.autograd.grad(place(y).sum(), y)
    (place(y).sum() * slope.sum()).backward()
    assert torch.allclose(y.grad, exact.sum(dim=(0, 1)) * slope.sum())


@pytest.mark.parametrize("wrt", [["balls.0.velocity"], ["walls.*.friction"]])
def test_an_empty_batch_is_empty(wrt: list[str]) -> None:
    place = carom.interop.torch.function(table_scene(duration=0.5), wrt)
    for before in ((0,), (3, 0), (0, 2)):
        x = torch.zeros((*before, len(place.start)), dtype=torch.float64, requires_grad=True)
        found = place(x)
        assert found.shape == (*before, 3, 3)
        found.sum().backward()
        assert x.grad.shape == x.shape


@pytest.mark.parametrize("dtype", [torch.complex128, torch.complex64, torch.int64, torch.bool])
def test_numbers_are_real(dtype: Any) -> None:
    place = carom.interop.torch.function(table_scene(duration=0.5), ["walls.*.friction"])
    with pytest.raises(carom.CaromError, match="expected a tensor of real floating-point numbers, got torch"):
        place(torch.ones(1, dtype=dtype))
    assert place(torch.tensor(place.start, dtype=torch.float32)).dtype == torch.float32


def test_refused() -> None:
    place = carom.interop.torch.function(table_scene(duration=0.5), ["walls.*.friction"])
    with pytest.raises(carom.CaromError, match="friction: expected"):
        place(torch.tensor([-1.0], dtype=torch.float64))


def test_one_impact_is_that_of_the_kernel_and_has_derivatives() -> None:
    ball = carom.Ball(radius=0.03, mass=0.2)
    impact = carom.interop.torch.impact
    rng = np.random.default_rng(5)
    for _ in range(20):
        n = rng.normal(size=3)
        n /= np.linalg.norm(n)
        v, w = rng.normal(size=3), rng.normal(size=3) / 0.03
        v -= 2 * max(n @ v, 0.0) * n
        e, mu, beta = rng.uniform(0.2, 0.95), rng.uniform(0.05, 0.5), rng.uniform(-0.5, 0.9)
        after = carom.impact(ball, carom.State(v, w), n, carom.Surface(e, mu, beta)).after
        found = impact(v, w, ball=ball, normal=n, restitution=e, friction=mu, tangential_restitution=beta)
        assert found[0].detach().numpy() == pytest.approx(after.velocity, abs=1e-13)
        assert found[1].detach().numpy() == pytest.approx(after.spin, abs=1e-11)

    def speeds(x: Any) -> Any:
        return impact((-1.0, 1.0, 0.2), (3.0, 5.0, 7.0), ball=ball, restitution=x[0], friction=x[1])[0]

    x = torch.tensor([0.8, 0.1], dtype=torch.float64, requires_grad=True)
    assert torch.autograd.gradcheck(speeds, (x,), eps=1e-6, atol=1e-7)
