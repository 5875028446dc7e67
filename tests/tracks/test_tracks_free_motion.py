"""Contacts that are none, and frames that belong to another flight: curved rails, pendulums, and bounces that are not found."""

from __future__ import annotations

import numpy as np
import pytest
from reference.known_films import Fall, drawn_curve, fallen, noise, rotated, swung

from carom.errors import CaromError
from carom.tracks import Measured, Settings, Track, measure, to_rebounds, usable_stages
from carom.tracks.events import flight_ends


def usable(found: Measured) -> list[float]:
    """The restitutions that enter a table."""
    fits = [one.fit for one in found.contacts if usable_stages(one, "both", True)[0]]
    return [fit["vn_out"] / -fit["vn_in"] for fit in fits if fit is not None]


@pytest.mark.parametrize("seed", [1, 4, 9, 11, 20, 21, 22, 24])
def test_a_smooth_path_has_no_contacts(seed: int) -> None:
    """Pendulums, valleys and rails at several rates; each of these had contacts with restitutions of 0.1 to 6."""
    _kind, track = drawn_curve(np.random.default_rng(seed))
    assert usable(measure([track])) == []


def test_a_pendulum_is_refused_with_its_reason() -> None:
    t = np.arange(0, 2.5, 1 / 100)
    x = swung(0.5, 0.5, t)
    track = Track("bob", t, x + noise(np.random.default_rng(1), x.shape, 2e-4))
    found = measure([track])
    assert "the ball turns in a smooth curve in " in " ".join(found.notes)
    assert found.noise == pytest.approx(2e-4, rel=0.2)  # no longer what the fits of no contacts left over, 2 mm
    with pytest.raises(CaromError, match="the ball turns over several frames there, as on a curved rail"):
        to_rebounds(found)


@pytest.mark.parametrize("degrees", [-8.0, 0.0, 8.0])
def test_a_bounce_in_the_same_place_is_a_contact(degrees: float) -> None:
    """As fast as a pendulum at its lowest point, at the same rate and with the same noise."""
    track, _bounces = fallen(Fall(restitution=0.8, height=0.06, speed=1.0, last=0.42, rate=100.0, noise=2e-4), 3)
    found = measure(
        [Track("ball", track.time, rotated(track.position, degrees))], Settings(view="side", drag_per_metre=0.0)
    )
    assert usable(found)[0] == pytest.approx(0.8, abs=0.01)


@pytest.mark.parametrize(
    ("fall", "seed"),
    [
        (Fall(0.462, 0.43, 0.3, first=0.09, last=1.45, rate=60.0, noise=3e-4), 2),  # said 0.687 +- 0.038
        (Fall(0.399, 0.73, 0.4, first=0.10, last=1.76, rate=60.0, noise=3e-4), 32),  # 0.692 +- 0.032
        (Fall(0.302, 1.06, 0.24, first=0.07, last=1.53, rate=30.0, noise=1e-3), 34),  # 0.416 +- 0.020
        (Fall(0.376, 0.38, 0.4, first=0.02, last=1.61, rate=30.0, noise=2e-3), 44),  # 0.629 +- 0.038
        (Fall(0.438, 0.67, 0.4, first=0.01, last=1.09, rate=240.0, noise=1e-3), 54),  # 0.587 +- 0.017
        (Fall(0.372, 1.03, 0.4, first=0.01, last=1.15, rate=240.0, noise=3e-4), 112),  # 0.598 +- 0.013
    ],
)
def test_frames_beyond_a_bounce_that_is_not_found_are_not_used(fall: Fall, seed: int) -> None:
    track, bounces = fallen(fall, seed)
    assert sum(bounce.t < track.time[-1] for bounce in bounces) > 2
    found = measure([track], Settings(view="side", drag_per_metre=0.0))
    for one in found.contacts:
        if usable_stages(one, "both")[0]:
            assert one.fit is not None
            e, error = one.fit["vn_out"] / -one.fit["vn_in"], one.fit.error("vn_out") / -one.fit["vn_in"]
            assert abs(e - fall.restitution) < 4 * error + 0.002
            nearest = min(bounces, key=lambda bounce: abs(bounce.t - one.time))
            later = [bounce.t for bounce in bounces if bounce.t > nearest.t]
            assert one.last < min(later) + 1.5 / fall.rate


def test_a_ball_that_falls_past_its_wall_has_one_flight() -> None:
    s = np.arange(60) / 200
    d = 0.5 * s - 5 * s**2
    assert flight_ends(s, d, 10.0, 1e-4, 1 / 200) == np.inf
    rests = np.maximum(d, 0.0)
    assert flight_ends(s, rests, 10.0, 1e-4, 1 / 200) == pytest.approx(0.1, abs=2e-3)
    assert flight_ends(s, rests, -1.0, 1e-4, 1 / 200) == np.inf  # a wall that gravity leads away from
