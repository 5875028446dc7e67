"""Runs as functions of PyTorch (``make check-torch``; PyTorch is no part of the tests' own install)."""

from __future__ import annotations

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


def test_refused() -> None:
    place = carom.interop.torch.function(table_scene(duration=0.5), ["walls.*.friction"])
    with pytest.raises(carom.CaromError, match="friction: expected"):
        place(torch.tensor([-1.0], dtype=torch.float64))
