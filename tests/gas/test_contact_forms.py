"""Contacts of gases with a restitution of the speed or of chance, friction of the slip, and wildcards."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import kstest, norm, uniform

import carom
from carom import Ball, CaromError, Disc
from carom.gas import Gas, GasScene, GasSurface, Species, container, gas_text, load_gas

VISCOELASTIC = {"form": "viscoelastic", "c": 0.2}
FORMS = [
    VISCOELASTIC,
    {"form": "power", "at_rest": 0.9, "speed": 0.5},
    {"form": "polynomial", "coefficients": (0.9, -0.1, 0.01)},
    {"form": "exponential", "at_rest": 0.9, "at_speed": 0.5, "speed": 2.0},
]


@pytest.mark.parametrize("form", FORMS, ids=lambda form: form["form"])
def test_two_discs_and_a_wall_meet_at_the_restitution_of_their_speed(form):
    surface = GasSurface(restitution=form, friction=0.0)
    pair = Gas(
        [Species(Disc(0.5, 1.0), 2)], (8.0, 8.0), contacts=surface, position=[[2, 4], [5, 4]], velocity=[[1.5, 0], [-1.5, 0]],
        spin=[0, 0],
    )  # fmt: skip
    pair.advance(1)
    assert pair.balls().velocity[1, 0] == pytest.approx(1.5 * surface.restitution.at(3.0), rel=1e-14)
    wall = Gas(
        [Species(Disc(0.5, 1.0), 1)], container("box", (8.0, 8.0)), contacts={("*", "*"): surface}, position=[[4, 4]],
        velocity=[[1.2, 0]], spin=[0],
    )  # fmt: skip
    wall.advance(1)
    assert wall.balls().velocity[0, 0] == pytest.approx(-1.2 * surface.restitution.at(1.2), rel=1e-14)


def test_friction_falls_with_the_slip():
    falling = {"at_rest": 0.4, "at_speed": 0.1, "speed": 2.0}
    gas = Gas(
        [Species(Disc(0.5, 1.0), 1)], container("box", (8.0, 8.0)), contacts=GasSurface(restitution=0.8, friction=falling),
        position=[[4, 4]], velocity=[[2.0, 1.0]], spin=[3.0],
    )  # fmt: skip
    gas.advance(1)
    now = gas.balls()
    # the disc's rim at the right wall, whose normal is (-1, 0), moves at 1 + 0.5 * 3 along it
    mu = GasSurface(restitution=0.8, friction=falling).friction.at(2.5)
    assert 0.1 < mu < 0.4
    assert now.velocity[0, 1] == pytest.approx(1.0 - mu * 1.8 * 2.0, rel=1e-12)


@pytest.mark.parametrize(
    ("form", "distribution"),
    [
        ({"form": "uniform", "low": 0.6, "high": 0.9}, uniform(0.6, 0.3)),
        ({"form": "normal", "mean": 0.7, "deviation": 0.05}, norm(0.7, 0.05)),
    ],
)
def test_random_restitution_has_its_distribution_and_its_seed(form, distribution):
    surface = GasSurface(restitution=form, friction=0.0)

    def restitutions(seed):
        gas, found = Gas([Species(Disc(0.5, 1.0), 40)], (12.0, 12.0), contacts=surface, seed=seed), []
        before = gas.balls()
        for _ in range(150):
            gas.advance(1)
            now = gas.balls()
            i, j = np.flatnonzero((now.velocity != before.velocity).any(axis=1))
            n = now.position[i] - now.position[j]
            n -= 12.0 * np.round(n / 12.0)
            was, after = (one.velocity[i] - one.velocity[j] for one in (before, now))
            found.append(-float(after @ n) / float(was @ n))
            before = now
        return found

    found = restitutions(3)
    assert kstest(found, distribution.cdf).pvalue > 0.01
    assert found == restitutions(3) != restitutions(4)


def test_a_viscoelastic_gas_cools_as_time_to_the_minus_five_thirds():
    """Brilliantov & Poeschel, Phys. Rev. E 61, 5573 (2000); with a constant restitution it would be the square (Haff)."""
    contact = GasSurface(restitution={"form": "viscoelastic", "c": 0.05}, friction=0.0)
    gas = Gas([Species(Ball(0.5, 1.0), 500)], (16.0, 16.0, 16.0), contacts=contact, seed=1)
    gas.advance(2000)
    start, first, times, ratios = gas.time, gas.energy()[0], [], []
    for _ in range(3):
        gas.advance(20_000)
        times.append(gas.time - start)
        ratios.append(first / gas.energy()[0])
    t, warm = np.array(times), np.array(ratios)
    slopes, haff = (warm ** (3 / 5) - 1) / t, (np.sqrt(warm) - 1) / t
    assert warm[-1] > 10
    assert slopes.max() < 1.08 * slopes.min()
    assert haff.max() > 1.15 * haff.min()


def scene_of(*contacts, **more) -> GasScene:
    return GasScene(
        container={"shape": "box", "size": (9, 9)},
        species=[{"name": "a", "count": 5, "radius": 0.5}, {"name": "b", "count": 5, "radius": 0.3}],
        contacts=contacts, run={"max_events": 100}, **more,
    )  # fmt: skip


def test_wildcards_stand_for_what_no_other_contact_names():
    scene = scene_of(
        {"between": ("*", "*"), "restitution": 0.5, "friction": 0.1},
        {"between": ("*", "wall"), "restitution": 0.6, "friction": 0.1},
        {"between": ("a", "*"), "restitution": 0.7, "friction": 0.1},
        {"between": ("b", "left"), "restitution": 0.8, "friction": 0.1},
    )
    gas = Gas(scene.species, scene.container.geometry, contacts=scene.contacts)
    pairs, walls = gas.arrays.materials.pairs["e"], gas.arrays.walls.contacts["e"].reshape(-1, 2)
    assert pairs.tolist() == [0.7, 0.7, 0.7, 0.5]
    left = gas.faces.index("left")
    assert walls[left].tolist() == [0.6, 0.8]
    assert np.delete(walls, left, axis=0).tolist() == [[0.6, 0.6]] * 3


def test_contacts_with_forms_are_kept_in_files():
    scene = scene_of(
        {
            "between": ("*", "*"),
            "restitution": VISCOELASTIC,
            "friction": {"at_rest": 0.3, "at_speed": 0.1, "speed": 1.0},
        }
    )
    assert load_gas(gas_text(scene)) == scene
    assert carom.replaced(scene, {"contacts.0.restitution": 0.5}).contacts[0].restitution == 0.5


@pytest.mark.parametrize(
    ("restitution", "said"),
    [
        ({"form": "elastic"}, "one of constant, polynomial"),
        ({"form": "uniform", "low": 0.9, "high": 0.6}, "at least low = 0.9"),
        ({"form": "viscoelastic"}, "c"),
        (1.5, "a number from 0 to 1, or a table"),
    ],
)
def test_what_is_no_restitution(restitution, said):
    with pytest.raises(CaromError, match="restitution") as error:
        scene_of({"between": ("*", "*"), "restitution": restitution, "friction": 0.1})
    assert said in str(error.value)
    assert len(error.value.faults) == 1


def test_a_random_restitution_goes_on_from_a_state():
    surface = GasSurface(restitution={"form": "uniform", "low": 0.6, "high": 0.9}, friction=0.2)
    whole, parts = (Gas([Species(Disc(0.5, 1.0), 40)], (12.0, 12.0), contacts=surface, seed=2) for _ in range(2))
    whole.advance(400)
    for _ in range(4):
        parts.advance(100)
        parts = Gas.restore(parts.state())
    assert parts.balls().velocity.tobytes() == whole.balls().velocity.tobytes()
