"""Restitution, friction and tangential restitution from a gas's cooling curve or temperature ratio, by simulated gases.

No formula stands between the numbers and the curve: gases like the measured one are simulated, with the noise of the measurement,
and the likelihood of the numbers is that of the measured curve's shape among theirs (:mod:`carom.fitting.simulated_likelihood`). It
includes the fluctuations of so few balls, with their correlation along the curve. Each round simulates gases with numbers that are
plausible under the rounds before (history matching: Vernon, Goldstein & Bower, Bayesian Anal. 5, 619 (2010),
doi:10.1214/10-BA524). Intervals are those of the profile likelihood, within the range that is searched.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.fitting.evidence import UNLIKELY
from carom.fitting.profile_likelihood import LEVELS
from carom.fitting.simulated_likelihood import Deviance, Simulated, interval, likelihood_of, plausible
from carom.gas.build import build
from carom.gas.contact_forms import ANY
from carom.gas.endings import EndedEarlyError
from carom.gas.scene import GasScene
from carom.gas.schema import GasContact
from carom.public.progress import Progress
from carom.scene.paths import replaced
from carom.scene.restitution import Exponential, Polynomial, Power, Restitution, Viscoelastic

__all__ = ["CURVES", "GasCurve", "curve_numbers", "fit_curve", "of_balls", "restitution_form"]

Array = NDArray[np.float64]
CURVES = ("temperature", "temperature_rotational", "ratio")
ROUNDS = 4
SHAPES = 4  # of a curve: polynomials of the logarithm of time
BOX = {"restitution": (0.3, 1.0), "friction": (0.0, 1.0), "tangential_restitution": (-1.0, 1.0)}
FORM_BOX = {"at_rest": (0.3, 1.0), "at_speed": (0.3, 1.0), "exponent": (1e-3, 0.5)}
SOFTEST = 0.8  # c v^(1/5) of a viscoelastic contact at the thermal speed of the start: a restitution of 0.43


class GasCurve(NamedTuple):
    """A measured gas: times (K,), s, and curves (K,) by name, with their relative standard errors (K,)."""

    t: Array
    values: dict[str, Array]
    errors: dict[str, Array]

    def starts(self, scene: GasScene) -> dict[str, float]:
        """Return the temperatures at the first time, with which the simulations begin; the scene's where none was measured."""
        first = {"temperature": scene.species[0].temperature or 1.0}
        first |= {name: float(values[0]) for name, values in self.values.items()}
        warm = first["temperature"]
        spins = first.get("temperature_rotational", warm * first.get("ratio", 1.0))
        return {"temperature": warm, "temperature_rotational": spins}

    def thermal_speed(self, scene: GasScene) -> float:
        """Return the speed of a ball of the first species along an axis at the first time, m/s."""
        return math.sqrt(self.starts(scene)["temperature"] / scene.species[0].nominal_mass(scene.container.dimensions))


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
) -> tuple[dict[str, Array], list[str]]:
    """Return the intervals of 68 and 95 % (2, 2) of those of the numbers with ``names`` that the curve tells, and notes."""
    rng = np.random.default_rng([seed, 0x6A5])
    known = curve_numbers(scene, curve.thermal_speed(scene))
    fields = [known[name][0] for name in names]
    begin, end = (np.array([known[name][k] for name in names]) for k in (1, 2))
    target = _features(curve, curve.values)
    total, count = ROUNDS * simulations, 0
    inputs, outputs, rounds = [], [], list[Simulated]()
    deviance: Deviance = lambda numbers: np.zeros(len(numbers))  # noqa: E731
    near = begin + (end - begin) * rng.random((simulations, len(names)))
    for _ in range(ROUNDS):
        for given in near[rng.permutation(len(near))[:simulations]]:
            found = _simulated(curve, scene, dict(zip(fields, given.tolist(), strict=True)), rng)
            count += 1
            if progress is not None:
                progress(count, total, "simulated gases")
            if found is not None:
                inputs.append(given)
                outputs.append(found)
        x, y = np.array(inputs), np.array(outputs)
        alike = np.isfinite(deviance(x))
        simulated = likelihood_of(x[alike], y[alike], target)
        if simulated is None:
            raise CaromError(
                "fit_gas: simulations: expected gases that reach the last time, got too few: give the scene a contact_time, or more"
                " simulations"
            )
        rounds.append(simulated)
        near, deviance = plausible([one.deviance for one in rounds], begin, end, rng)
    one, two = (interval(deviance, near, begin, end, rise, rng) for rise in LEVELS)
    told, notes = dict[str, Array](), list[str]()
    for k, name in enumerate(names):
        if (one[0, k], one[1, k]) == (begin[k], end[k]):  # (nothing that was searched is less likely)
            notes.append(f"{name} is not told by these data")
            continue
        told[name] = np.stack([one[:, k], two[:, k]])
        ends = [f"{edge:g}" for edge, its in ((begin[k], one[0, k]), (end[k], one[1, k])) if edge == its]
        notes += [f"{name}: its interval ends at {edge}, at the end of the range that was searched" for edge in ends]
    chi2, free, probability = rounds[-1].probability(near)
    if probability < UNLIKELY:
        notes.append(
            f"no simulated gas has such a curve (chi^2 {chi2:.3g} where {free} is expected): check the other numbers of the scene,"
            " which were held"
        )
    return told, notes


def _features(curve: GasCurve, values: dict[str, Array]) -> Array:
    """Return the features by which curves are compared: coefficients of polynomials in ln t, of the logarithm of each."""
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
    changes |= {f"species.*.{name}": value for name, value in curve.starts(scene).items()}
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
