"""Contacts of balls with each other in films: against films made by small steps, without carom; and what is refused."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest
from reference.pair_films import Shots, drawn_shots

import carom
from carom import cli
from carom.errors import CaromError
from carom.tracks import Measured, PairContact, Settings, Track, measure, measure_pairs, pair_rebounds

RADIUS, NOISE, SHOTS = 0.03075, 3e-4, 6


def filmed(shots: Shots, noise: float, seed: int) -> list[Track]:
    rng = np.random.default_rng(seed)
    return [
        Track(name, shots.time, x[:, k] + noise * rng.normal(size=x[:, k].shape), group=f"shot{k}")
        for k in range(len(shots.contact))
        for name, x in (("cue", shots.striking), ("red", shots.struck))
    ]


def measured(tracks: list[Track], noise: float = NOISE) -> Measured:
    about = Settings(radius=RADIUS, view="above", noise=noise, floor_friction=0.2, rolling_resistance=0.008)
    return measure(tracks, about)


@pytest.fixture(scope="module")
def shots() -> Shots:
    return drawn_shots(np.random.default_rng(4), SHOTS)


@pytest.fixture(scope="module")
def found(shots: Shots) -> tuple[PairContact, ...]:
    return measure_pairs(measured(filmed(shots, NOISE, 0)))


@pytest.mark.slow
def test_velocities_and_impulses_are_those_of_an_independent_integration(shots: Shots) -> None:
    exact = measure_pairs(measured(filmed(shots, 0.0, 0)[:6], 3e-5))
    assert len(exact) == 3
    for k, one in enumerate(exact):
        assert one.fit is not None, one.why
        assert (one.striking, one.struck) == ("cue", "red")
        assert one.time == pytest.approx(shots.contact[k], abs=2e-4)
        assert one.fit["jn"] == pytest.approx(shots.normal[k], abs=1e-3)
        assert one.fit["jz"] == pytest.approx(shots.across[k, 2], abs=1e-3)
        assert one.restitution.value == pytest.approx(0.93, abs=2e-3)
        assert one.friction.value == pytest.approx(np.linalg.norm(shots.across[k]) / shots.normal[k], abs=1e-3)


def test_error_bars_hold_the_truth(shots: Shots, found: tuple[PairContact, ...]) -> None:
    pulls = []
    for one in found:
        k = int(one.group.removeprefix("shot"))
        assert one.fit is not None, one.why
        pulls += [
            (one.restitution.value - 0.93) / one.restitution.error,
            (one.fit["jn"] - shots.normal[k]) / one.fit.error("jn"),
            (one.fit["jz"] - shots.across[k, 2]) / one.fit.error("jz"),
        ]
    assert len(pulls) == 3 * SHOTS
    assert max(map(abs, pulls)) < 4
    assert 0.4 < np.sqrt(np.mean(np.square(pulls))) < 1.6


def test_restitution_and_friction_are_fitted(found: tuple[PairContact, ...]) -> None:
    table = pair_rebounds(found, RADIUS)
    assert table.kind == "planar"
    best = carom.fit(table, RADIUS, laws=["sliding"], bootstrap=0).best
    for name, truth in (("restitution", 0.93), ("friction", 0.06)):
        one = best.estimates[name]
        assert one.value is not None
        assert one.stderr is not None
        assert one.stderr < 0.005
        assert abs(one.value - truth) < 4 * one.stderr


def test_friction_is_left_out_where_the_slip_is_not_seen(found: tuple[PairContact, ...]) -> None:
    # without sidespin and with little follow, a ball that slides into the other shows no direction of friction beside a large error
    table = pair_rebounds(found, RADIUS)
    unseen = np.isnan(table["v_t_out"])
    slip = table["v_t_in"] - RADIUS * table["spin_in"]
    assert (RADIUS * table["sigma_spin_in"][~unseen] < 0.3 * slip[~unseen]).all()
    assert unseen.any() == any("v_t_out: left out" in note for note in table.notes)


def test_the_mirror_image_has_the_mirrored_contact(shots: Shots, found: tuple[PairContact, ...]) -> None:
    one = filmed(shots, NOISE, 0)[:2]
    mirrored = [Track(each.name, each.time, each.position * [1, -1], group=each.group) for each in one]
    other, first = measure_pairs(measured(mirrored))[0], found[0]
    assert other.fit is not None
    assert first.fit is not None
    for name, sign in (("vn_in", 1), ("vt_in", -1), ("jn", 1), ("jt", -1), ("jz", 1), ("un_in", 1)):
        assert other.fit[name] == pytest.approx(sign * first.fit[name], abs=0.1 * first.fit.error(name) + 1e-6)


def test_what_cannot_be_measured_has_a_reason(shots: Shots) -> None:
    cue, red = filmed(shots, NOISE, 0)[:2]
    late = cue.select(cue.time > shots.contact[0] - 0.07)
    assert measure_pairs(measured([late, red]))[0].why.endswith("of ball cue before it, expected 4 or more")
    later = cue.select(cue.time > shots.contact[0] - 0.01)
    assert measure_pairs(measured([later, red]))[0].why == "no frames before it show which ball strikes the other"
    # both move: the frame that goes along with the struck ball's later motion
    moving = Track("red", red.time, red.position + 0.3 * red.time[:, None] * [1.0, 0.0], group=red.group)
    along = Track("cue", cue.time, cue.position + 0.3 * cue.time[:, None] * [1.0, 0.0], group=cue.group)
    both = measure_pairs(measured([along, moving]))[0]
    assert both.why.startswith("both balls move before it")
    with pytest.raises(CaromError, match="none of which can be measured; 1 of them: both balls move"):
        pair_rebounds([both], RADIUS)


def test_a_ball_that_passes_another_is_no_contact() -> None:
    t = np.arange(50) / 50
    rolling = np.stack([t - 0.0025 * t * t, 0.3 + 0 * t], axis=-1)
    rests = np.tile([0.5, 0.3 + 2.1 * RADIUS], (50, 1))
    film = measured([Track("A", t, rolling), Track("B", t, rests)])
    assert measure_pairs(film) == ()
    with pytest.raises(CaromError, match="got no contact of balls"):
        pair_rebounds((), RADIUS)


def test_films_from_the_side_and_without_a_radius_are_refused() -> None:
    t = np.arange(40) / 200
    y = np.where(t < 0.1, 2 * (0.1 - t), 1.6 * (t - 0.1)) - 9.81 / 2 * (t - 0.1) ** 2
    thrown = [Track("ball", t, np.stack([0.5 * t, y], axis=-1))]
    with pytest.raises(CaromError, match="expected a film from above"):
        measure_pairs(measure(thrown, Settings(view="side", noise=1e-4)))
    with pytest.raises(CaromError, match="expected the balls' radius"):
        measure_pairs(measure(thrown, Settings(view="above", noise=1e-4)))


def test_the_command_measures_and_fits_them(
    shots: Shots, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    film = tmp_path / "film.csv"
    with film.open("w", newline="") as opened:
        rows = csv.writer(opened)
        rows.writerow(["shot", "ball", "t [s]", "x [m]", "y [m]"])
        for track in filmed(shots, NOISE, 0)[:8]:
            rows.writerows(
                [track.group, track.name, t, *x] for t, x in zip(track.time, track.position.tolist(), strict=True)
            )

    def run(*words: str) -> tuple[int, str, str]:
        monkeypatch.setattr("sys.argv", ["carom", *words])
        with pytest.raises(SystemExit) as ended:
            cli.main()
        said = capsys.readouterr()
        return int(ended.value.code or 0), said.out, said.err

    about = ("--radius", "30.75mm", "--view", "above", "--balls")
    code, out, err = run("tracks", "show", str(film), *about, "--out", str(tmp_path / "balls.csv"))
    assert code == 0, err
    assert "Balls that strike balls at rest" in out
    assert "4 contacts, 4 measured" in out
    code, out, err = run(
        "fit", str(film), "--radius", "0.03075", "--view", "above", "--balls", "--laws", "sliding", "--bootstrap", "0"
    )
    assert code == 0, err
    assert "restitution" in out
    code, out, err = run("fit", str(tmp_path / "balls.csv"), "--radius", "0.03075", "--balls", "--laws", "sliding")
    assert code == 2
    assert "--balls: expected a track, got rebounds" in err
