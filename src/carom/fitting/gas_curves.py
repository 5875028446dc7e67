"""Restitution, friction and tangential restitution from a gas's cooling curve or temperature ratio, by simulated gases.

No formula stands between the numbers and the curve: gases like the measured one are simulated with numbers drawn from a box, and
a linear regression turns their curves into an estimate of each number (Fearnhead & Prangle, J. R. Stat. Soc. B 74, 419 (2012),
doi:10.1111/j.1467-9868.2011.01010.x). That estimate is calibrated by simulations that it was not made from: its mean as a function
of the true numbers, and its covariance, which includes the fluctuations of so few balls and the measurement's own noise. Then the
box shrinks about the answer, and the simulations begin anew.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.gas.build import build
from carom.gas.endings import EndedEarlyError
from carom.gas.scene import GasScene
from carom.gas.schema import GasContact
from carom.gas.species import ANY
from carom.public.progress import Progress
from carom.scene.paths import replaced
from carom.scene.restitution import Exponential, Polynomial, Power, Restitution, Viscoelastic

__all__ = ["CURVES", "GasCurve", "curve_numbers", "fit_curve", "of_balls", "restitution_form"]

Array = NDArray[np.float64]
CURVES = ("temperature", "temperature_rotational", "ratio")
ROUNDS = 4
WIDTHS = 3.0  # error bars, on both sides, to which the box shrinks
SHAPES = 4  # of a curve: polynomials of the logarithm of time
RIDGE = 1e-3
STEPS, STEP, FARTHEST = 8, 1e-4, 1.5  # of Newton's method on a quadratic surface; of half a box from its middle
BOX = {"restitution": (0.3, 1.0), "friction": (0.0, 1.0), "tangential_restitution": (-1.0, 1.0)}
FORM_BOX = {"at_rest": (0.3, 1.0), "at_speed": (0.3, 1.0), "exponent": (1e-3, 0.5)}
SOFTEST = 0.8  # c v^(1/5) of a viscoelastic contact at the thermal speed of the start: a restitution of 0.43


class GasCurve(NamedTuple):
    """A measured gas: times (K,), s, and curves (K,) by name, with their relative standard errors (K,)."""

    t: Array
    values: dict[str, Array]
    errors: dict[str, Array]

    def starts(self) -> dict[str, float]:
        """Return the temperatures at the first time, with which the simulations begin."""
        first = {"temperature": 1.0} | {name: float(values[0]) for name, values in self.values.items()}
        warm = first["temperature"]
        spins = first.get("temperature_rotational", warm * first.get("ratio", 1.0))
        return {"temperature": warm, "temperature_rotational": spins}

    def thermal_speed(self, scene: GasScene) -> float:
        """Return the speed of a ball of the first species along an axis at the first time, m/s."""
        return math.sqrt(self.starts()["temperature"] / scene.species[0].nominal_mass(scene.container.dimensions))


def of_balls(scene: GasScene, contact: GasContact) -> bool:
    """Return whether a contact is one of two balls (with wildcards also of a ball and a wall)."""
    return set(contact.between) <= {ANY, *(one.name for one in scene.species)}


def restitution_form(scene: GasScene) -> str:
    """Return the form of the restitution of the balls' contact, as a fit of rebounds has it: "constant" for numbers."""
    first = next(one.restitution for one in scene.contacts if of_balls(scene, one))
    return first.form if isinstance(first, (Exponential, Polynomial, Power, Viscoelastic)) else "constant"


def curve_numbers(scene: GasScene, thermal_speed: float) -> dict[str, tuple[str, float, float]]:
    """Return by name the numbers that a curve may tell: their field in a contact, and the range that is searched.

    Where the scene's restitution depends on the speed these are the numbers of its form, as the fit of rebounds names them.
    """
    found = {name: (name, low, high) for name, (low, high) in BOX.items()}
    form = next(one.restitution for one in scene.contacts if of_balls(scene, one))
    if restitution_form(scene) == "constant" or not isinstance(form, Restitution):
        return found
    del found["restitution"]
    boxes = FORM_BOX | {"c": (1e-3, SOFTEST / thermal_speed**0.2)}
    own = [name for name in type(form).model_fields if name in boxes]
    return {f"restitution_{name}": (f"restitution.{name}", *boxes[name]) for name in own} | found


def fit_curve(
    curve: GasCurve,
    scene: GasScene,
    names: Sequence[str],
    simulations: int,
    seed: int,
    progress: Progress | None = None,
) -> tuple[dict[str, float], dict[str, float], list[str]]:
    """Return those of the numbers with ``names`` that the curve tells, their standard errors, and notes."""
    rng = np.random.default_rng([seed, 0x6A5])
    known = curve_numbers(scene, curve.thermal_speed(scene))
    fields = [known[name][0] for name in names]
    low, high = (np.array([known[name][k] for name in names]) for k in (1, 2))
    begin, end = low.copy(), high.copy()
    target = _features(curve, curve.values)
    total, count, notes = ROUNDS * simulations, 0, list[str]()
    where, covariance = (low + high) / 2, np.diag((high - low) ** 2 / 12)
    for _ in range(ROUNDS):
        inputs, outputs = [], []
        for _ in range(simulations):
            given = low + (high - low) * rng.random(len(names))
            found = _simulated(curve, scene, dict(zip(fields, given.tolist(), strict=True)), rng)
            count += 1
            if progress is not None:
                progress(count, total, "simulated gases")
            if found is not None:
                inputs.append(given)
                outputs.append(found)
        if len(inputs) < 4 * (len(target) + len(names)) // 2:
            raise CaromError(
                "fit_gas: simulations: expected gases that reach the last time, got too few: give the scene a contact_time, or more"
                " simulations"
            )
        where, covariance = _calibrated(np.array(inputs), np.array(outputs), target)
        where = np.clip(where, begin, end)
        width = WIDTHS * np.sqrt(np.diag(covariance))
        low, high = np.maximum(where - width, begin), np.minimum(where + width, end)
    flat = [name for k, name in enumerate(names) if math.sqrt(covariance[k, k]) > (end - begin)[k] / math.sqrt(12)]
    notes += [f"{name} is not told by these data" for name in flat]
    notes += [
        f"{name}: {where[k]:g} is the end of the range that was searched; check the other numbers of the scene, which were held"
        for k, name in enumerate(names)
        if name not in flat and where[k] in (begin[k], end[k])
    ]
    told = [k for k, name in enumerate(names) if name not in flat]
    values = {names[k]: float(where[k]) for k in told}
    return values, {names[k]: math.sqrt(covariance[k, k]) for k in told}, notes


def _calibrated(inputs: Array, outputs: Array, target: Array) -> tuple[Array, Array]:
    """Return numbers and covariance: a regression from one half of the simulations, calibrated by the other, and the reverse."""
    halves = (slice(0, None, 2), slice(1, None, 2))
    found = []
    for made, tested in (halves, halves[::-1]):
        middle, scale = outputs[made].mean(axis=0), outputs[made].std(axis=0) + 1e-300
        y = np.column_stack([np.ones(len(inputs[made])), (outputs[made] - middle) / scale])
        penalty = RIDGE * len(y) * np.diag([0.0] + [1.0] * (y.shape[1] - 1))
        weights = np.linalg.solve(y.T @ y + penalty, y.T @ inputs[made])

        def estimate(rows: Array, middle: Array = middle, scale: Array = scale, weights: Array = weights) -> Array:
            made_of: Array = np.column_stack([np.ones(len(rows)), (rows - middle) / scale]) @ weights
            return made_of

        # the mean estimate as a function of the true numbers, and its scatter
        centre = (inputs.max(axis=0) + inputs.min(axis=0)) / 2
        reach = (inputs.max(axis=0) - inputs.min(axis=0)) / 2 + 1e-300
        x = _powers((inputs[tested] - centre) / reach)
        surface = np.asarray(np.linalg.lstsq(x, estimate(outputs[tested]), rcond=None)[0], np.float64)
        left = estimate(outputs[tested]) - x @ surface
        scatter = left.T @ left / max(len(left) - x.shape[1], 1)
        u, inverse = _solved(surface, estimate(target[None])[0])
        found.append((centre + reach * u, reach[:, None] * (inverse @ scatter @ inverse.T) * reach))
    (one, first), (two, second) = found
    return (one + two) / 2, (first + second) / 2


def _powers(u: Array) -> Array:
    """Return 1, the numbers (N, P), and their products of two, by columns."""
    pairs = [u[:, i] * u[:, j] for i in range(u.shape[1]) for j in range(i, u.shape[1])]
    return np.column_stack([np.ones(len(u)), u, *pairs])


def _solved(surface: Array, wanted: Array) -> tuple[Array, Array]:
    """Return where a quadratic surface, of the columns of :func:`_powers`, has the wanted values, and its inverse slope there."""
    size = len(wanted)
    u: Array = np.zeros(size)
    inverse = np.asarray(np.linalg.pinv(surface[1 : size + 1].T), np.float64)
    for _ in range(STEPS):
        u = np.clip(u + inverse @ (wanted - (_powers(u[None]) @ surface)[0]), -FARTHEST, FARTHEST)
        slope = np.stack(
            [(_powers((u + h)[None]) - _powers((u - h)[None]))[0] @ surface / (2 * STEP) for h in STEP * np.eye(size)]
        )
        inverse = np.asarray(np.linalg.pinv(slope.T), np.float64)
    return u, inverse


def _features(curve: GasCurve, values: dict[str, Array]) -> Array:
    """Return what curves are compared by: the numbers of polynomials of the logarithm of time, of the logarithm of each."""
    u = np.log1p((curve.t - curve.t[0]) / max(float(np.diff(curve.t).min()), 1e-300))
    shapes = min(SHAPES, len(u) - 1)
    design = np.polynomial.legendre.legvander(2 * u / u[-1] - 1, max(shapes - 1, 0))
    found = []
    for column in values.values():
        rows = slice(1, None) if shapes > 1 else slice(-1, None)
        if shapes > 1:
            found.append(np.linalg.lstsq(design[rows], np.log(column[rows]), rcond=None)[0])
        else:
            found.append(np.log(column[rows]))
    return np.concatenate(found)


def _simulated(curve: GasCurve, scene: GasScene, numbers: dict[str, float], rng: np.random.Generator) -> Array | None:
    """Return the features of a simulated gas, with the noise of the measurement; None where it collapses."""
    contacts = [k for k, one in enumerate(scene.contacts) if of_balls(scene, one)]
    changes: dict[str, Any] = {f"contacts.{k}.{field}": value for field, value in numbers.items() for k in contacts}
    changes |= {f"species.*.{name}": value for name, value in curve.starts().items()}
    changes["run.seed"] = int(rng.integers(2**31))
    gas = build(replaced(scene, changes))
    values: dict[str, list[float]] = {name: [] for name in curve.values}
    try:
        for t in (curve.t - curve.t[0]).tolist():
            if t > 0:
                gas.advance(until=t)
            warm, spins = _temperatures(gas)
            now = {"temperature": warm, "temperature_rotational": spins, "ratio": spins / warm}
            for name, column in values.items():
                column.append(now[name])
    except EndedEarlyError:
        return None
    noisy = {
        name: np.array(column) * np.exp(curve.errors[name] * rng.standard_normal(len(column)))
        for name, column in values.items()
    }
    return _features(curve, noisy)


def _temperatures(gas: Any) -> tuple[float, float]:
    """Return the translational and the rotational temperature of all balls, relative to the motion of their centre of mass."""
    now, kinds = gas.balls(), gas.arrays.materials.species
    mass = kinds["mass"][now.species]
    moment = mass * kinds["kappa"][now.species] * kinds["radius"][now.species] ** 2
    flat = int(gas.arrays.system[0]["dimensions"]) == 2
    v = now.velocity - mass @ now.velocity / mass.sum()
    return (
        float((mass[:, None] * v * v).sum() / (len(mass) * (2 if flat else 3))),
        float((moment[:, None] * now.spin**2).sum() / (len(mass) * (1 if flat else 3))),
    )
