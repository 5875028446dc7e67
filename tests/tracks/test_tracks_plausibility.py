"""Contacts that no wall brings about are flagged, and the view is guessed from the motion and from what the contacts say."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest
from reference.exploring import tried
from reference.synthetic_tracks import Camera, bounce, seen, shot

from carom.cli import main
from carom.errors import CaromError
from carom.tracks import Measured, Settings, Track, measure, to_rebounds, usable_stages
from carom.tracks.preprocess import guess_view


def rocking(rate: float = 60.0) -> Track:
    """A ball that rocks on a curved rail of radius 0.5 m, seen from the side."""
    t = np.arange(0, 8, 1 / rate)
    angle = 0.5 * np.exp(-0.03 * t) * np.cos(np.sqrt(9.80665 / 0.5 / 1.4) * t)
    place = 0.5 * np.stack([np.sin(angle), 1 - np.cos(angle)], axis=-1)
    return Track("ball", t, place + np.random.default_rng(1).normal(0, 5e-4, place.shape))


def hops(gain: float, gravity: float = 9.80665, count: int = 5, first: float = 0.8) -> Track:
    """A ball in flight whose speed after each bounce is ``gain`` times that before it."""
    t, up = np.arange(0, 3, 1 / 200), first
    y, begin = np.zeros_like(t), 0.0
    for _ in range(count):
        since = t - begin
        y = np.where((since >= 0) & (since < 2 * up / gravity), up * since - gravity / 2 * since**2, y)
        begin, up = begin + 2 * up / gravity, gain * up
    keep = t < begin
    place = np.stack([0.3 * t, y], axis=-1)[keep]
    return Track("ball", t[keep], place + np.random.default_rng(3).normal(0, 2e-4, place.shape))


def said(measured: Measured) -> str:
    return "\n".join(measured.notes)


def test_a_ball_on_a_curved_rail_fits_no_view() -> None:
    measured = measure([rocking()])
    assert "the motion fits no view: from above, the ball turns in a smooth curve in " in said(measured)
    assert "try `view` side" in said(measured)
    assert not [one for one in measured.contacts if usable_stages(one, "both", True)[0]]
    assert measured.view_reason == "the ball does not fall with gravity"


@pytest.mark.parametrize("seed", range(tried(2, 4)))
def test_what_is_possible_is_not_flagged(seed: int) -> None:
    rng = np.random.default_rng(seed)
    table = measure([seen(shot(rng), Camera(120, 3e-4), rng)])
    flight = measure([seen(bounce(rng), Camera(120, 3e-4), rng, (0, 2))])
    assert (table.view, flight.view) == ("above", "side")
    for measured in (table, flight):
        assert "above 1" not in said(measured)
        assert "fits no view" not in said(measured)
    assert "of the track the ball falls with gravity" in said(flight)


def test_a_wall_that_gives_more_than_it_gets_is_flagged() -> None:
    measured = measure([hops(1.1, count=4)])
    assert measured.view == "side"
    assert "of 3 contacts have a restitution above 1 beyond the error bar, up to 1.1" in said(measured)
    assert any("v_n_out: 3 of 3 rebounds have a restitution above 1" in note for note in to_rebounds(measured).notes)
    assert "above 1" not in said(measure([hops(0.9)]))


def test_another_constant_acceleration_is_a_view_from_the_side_at_another_scale() -> None:
    view, why = guess_view([hops(0.8, gravity=2.9)], 9.80665)
    assert view == "side"
    found = re.search(
        r"a constant acceleration, up and down; but it is ([\d.]+) m/s\^2: is the scale or the frame rate wrong", why
    )
    assert found
    assert float(found[1]) == pytest.approx(2.9, rel=0.03)


def test_friction_is_no_gravity() -> None:
    t = np.arange(0, 1.5, 1 / 120)  # a ball that slides up and down the table, slowed down by the cloth
    y = np.where(t < 0.7, 0.1 + 1.5 * t - t**2, 0.66 - 0.9 * (t - 0.7) + 0.5 * (t - 0.7) ** 2)
    assert guess_view([Track("ball", t, np.stack([0.1 * t, y], axis=-1))], 9.80665)[0] == "above"


def test_the_view_that_the_contacts_allow_is_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    def wrong(_tracks: object, _gravity: float) -> tuple[str, str]:
        return "above", "a wrong guess"

    monkeypatch.setattr("carom.tracks.measurement.guess_view", wrong)
    measured = measure([hops(0.8)])
    assert measured.view == "side"
    assert measured.view_reason.startswith("from above, ")
    assert "assumed to be filmed from the side, a ball in flight: from above, " in said(measured)


def test_a_view_that_is_given_is_kept() -> None:
    above, side = (measure([rocking()], Settings(view=view)) for view in ("above", "side"))
    assert (above.view, side.view, above.view_reason, side.view_reason) == ("above", "side", "", "")
    assert "assumed to be filmed" not in said(above) + said(side)
    assert not any(measured.measured for measured in (above, side))


def test_the_command_flags_them(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    track = hops(1.1, count=4)
    file = tmp_path / "film.csv"
    np.savetxt(
        file, np.column_stack([track.time, track.position]), delimiter=",", header="t [s],x [m],y [m]", comments=""
    )
    for words in ((), ("--json",)):
        monkeypatch.setattr("sys.argv", ["carom", "tracks", "show", str(file), *words])
        with pytest.raises(SystemExit) as end:
            main()
        assert not end.value.code
        told = capsys.readouterr()
        if words:
            facts = json.loads(told.out)
            assert [one["impossible"] for one in facts["contacts"]] == [True, True, True]
            assert "falls with gravity" in facts["view_reason"]
        else:
            assert told.out.count("restitution above 1") == 3
            assert "no wall at rest gives back more than it gets" in told.err


def test_energy_that_grows_is_noted(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    # along the wall the ball becomes six times as fast: no spin that it may have brought along suffices
    t = np.arange(0.15, 0.6, 1 / 200)
    y = np.where(t < 0.4, 1.6 * (0.4 - t), 1.2 * (t - 0.4)) - 9.80665 / 2 * (t - 0.4) ** 2
    x = np.where(t < 0.4, 0.5 * (t - 0.4), 6 * (t - 0.4))
    place = np.stack([x, y], axis=-1) + np.random.default_rng(1).normal(0, 2e-4, (len(t), 2))
    measured = measure([Track("ball", t, place)], Settings(view="side"))
    assert "above 1" not in said(measured)
    expected = "energy: 1 of 1 rebounds have more energy after the contact than before"
    assert any(expected in note for note in to_rebounds(measured).notes)
    file = tmp_path / "film.csv"
    np.savetxt(file, np.column_stack([t, place]), delimiter=",", header="t [s],x [m],y [m]", comments="")
    monkeypatch.setattr("sys.argv", ["carom", "tracks", "show", str(file), "--view", "side"])
    with pytest.raises(SystemExit):
        main()
    assert expected in capsys.readouterr().err


def test_a_radius_in_millimetres_is_refused() -> None:
    expected = r"radius: expected a ball's radius in m \(a billiard ball's: 0.0286, or 28.6mm\), got 28.6"
    with pytest.raises(CaromError, match=expected):
        Settings(radius=28.6).check()
