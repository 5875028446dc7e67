"""Radii by distribution: their moments, the gas that has them, and what is refused."""

from __future__ import annotations

import math

import numpy as np
import pytest

import carom
from carom import Ball, CaromError, Disc, Surface
from carom.gas import Gas, GasScene, Measures, Session, Species, channels
from carom.gas.report import report

ROUGH = Surface(0.9, 0.3, 0.2)


def scene(radius, count=400, size=(60.0, 60.0), **species):
    contact = {"between": ("a", "a"), "restitution": 0.9, "friction": 0.3, "tangential_restitution": 0.2}
    return GasScene(
        container={"shape": "periodic", "size": size}, species=[{"count": count, "radius": radius, **species}], contacts=[contact],
        run={"max_events": 3000, "equilibrate": 500},
    )  # fmt: skip


def test_drawn_radii_and_their_classes_have_the_moments_of_the_distribution():
    sigma = 0.2
    growth = math.exp(sigma**2)
    # mean, standard deviation, skewness in closed form
    mean, deviation = 0.5 * math.sqrt(growth), 0.5 * math.sqrt(growth * (growth - 1))
    skewness = (growth + 2) * math.sqrt(growth - 1)
    form = {"distribution": "lognormal", "median": 0.5, "sigma": sigma}
    count = 4000
    kept = scene({**form, "seed": 4}, count, (400.0, 400.0)).species[0].all_radii
    assert kept.mean() == pytest.approx(mean, abs=4 * deviation / math.sqrt(count))
    assert kept.std() == pytest.approx(deviation, rel=4 / math.sqrt(count))
    assert ((kept - kept.mean()) ** 3).mean() / kept.std() ** 3 == pytest.approx(skewness, abs=0.25)
    same, other = (scene({**form, "seed": k}, count, (400.0, 400.0)).species[0].all_radii for k in (4, 5))
    assert np.array_equal(same, kept)
    assert not np.array_equal(other, kept)


def test_a_gas_of_given_radii_is_the_gas_of_as_many_species_with_the_same_bits():
    rng = np.random.default_rng(3)
    radii = np.sort(rng.choice([0.3, 0.4, 0.5], 60))
    place = np.stack(np.meshgrid(*[np.arange(8) * 1.5 + 1] * 2), axis=-1).reshape(-1, 2)[:60]
    v, w = rng.normal(size=(60, 2)), rng.normal(size=60)
    one = Gas(
        [Species(Disc(0.5, 1.0), 60, radii=radii)], (12.0, 12.0), contacts=ROUGH, position=place, velocity=v, spin=w
    )
    kinds = [Species(Disc(a, (a / 0.5) ** 2), int((radii == a).sum()), f"r{a}") for a in (0.3, 0.4, 0.5)]
    several = Gas(kinds, (12.0, 12.0), contacts=ROUGH, position=place, velocity=v, spin=w)
    mark = one.mark()
    run, apart = one.run(2000), several.run(2000)
    assert np.array_equal(one.balls().position, several.balls().position)
    assert run.temperature_translational == pytest.approx(apart.temperature_translational, rel=1e-12)
    assert run.averages.temperatures.shape == (1, 2)
    assert channels(one, mark, ("a",))[0].collisions == 2000
    measures = Measures(one)
    measures.sample(one)
    now = one.balls()
    mass = one.arrays.materials.species["mass"][now.species]
    v = now.velocity - mass @ now.velocity / mass.sum()
    assert measures.temperature("a")[0] == pytest.approx((mass * (v**2).sum(axis=1)).mean() / 2, rel=1e-9)


def test_the_packing_fraction_and_g_of_r_are_those_of_the_radii():
    one = scene({"distribution": "lognormal", "median": 0.5, "sigma": 0.2}, density=2.0)
    radii = one.species[0].all_radii
    assert one.packing_fraction == pytest.approx(math.pi * (radii**2).sum() / 3600, rel=1e-12)
    assert one.species[0].total_mass(2) == pytest.approx(2.0 * math.pi * (radii**2).sum(), rel=1e-12)
    session = Session(one)
    session.run()
    far = session.measures.pair_correlation("a", "a").g[40:]
    assert far.mean() == pytest.approx(1.0, abs=0.05)
    assert list(report(session)["species"]) == ["a"]
    state = session.state()
    again = Session.restore(one, state)
    assert np.array_equal(again.gas.groups, session.gas.groups)


@pytest.mark.parametrize(
    ("radius", "line"),
    [
        ({"distribution": "uniform", "median": 1, "sigma": 0.1}, "radius.distribution: expected"),
        ({"distribution": "lognormal", "median": 0.5, "sigma": 2}, "radius.sigma: expected a standard deviation of ln r"),
        ("half", "radius: expected a length in m, > 0, or a table { distribution ="),
    ],
)  # fmt: skip
def test_bad_distributions_have_one_line_each(radius, line):
    with pytest.raises(CaromError) as error:
        scene(radius)
    assert line in str(error.value)
    assert len(error.value.faults) == 1


def test_a_density_has_the_unit_of_balls_or_of_discs():
    grain = {"radius": 0.5, "count": 2}
    assert scene(**grain, density="0.2 g/cm^2").species[0].nominal_mass(2) == pytest.approx(2.0 * math.pi * 0.25)
    assert scene(**grain, size=(60,) * 3, density="2500 kg/m^3").species[0].nominal_mass(3) == pytest.approx(
        2500 * math.pi / 6
    )
    with pytest.raises(
        CaromError, match=r"species\[0\].density: .*got '2500 kg/m\^3'; 'kg/m\^3' is a unit of another quantity"
    ):
        scene(**grain, density="2500 kg/m^3")


def test_a_mass_and_a_density_and_radii_of_another_number_are_refused():
    with pytest.raises(CaromError, match="density: expected a mass or a density, got both"):
        scene(0.5, mass=1.0, density=2.0)
    with pytest.raises(CaromError, match="expected 8 radii > 0 of 'a', got shape"):
        Gas([Species(Ball(0.5, 1.0), 8, radii=[1.0])], (6.0, 6.0, 6.0), contacts=ROUGH)


def test_a_changed_scene_keeps_its_distribution():
    one = scene({"distribution": "lognormal", "median": 0.5, "sigma": 0.2})
    assert carom.replaced(one, {"run.seed": 2}).species[0].radius == one.species[0].radius
