"""Balls that roll over the rims of pockets within a run (``run.pockets = "rim"``), against `pocket_rim` by hand."""

import numpy as np
import pytest

import carom
from carom import billiards

RADIUS, MASS = 0.028575, 0.163
# the pocket's edge comes 50 mm in front of the noses
POCKETS = {"mouth": 0.1, "jaw_angle": 100, "jaw_radius": 0.005, "shelf": -0.05, "radius": 0.08}
ENDS = [
    (0.5, 0.03, "pocketed"),
    (1.0, 0.04, "rolling"),
]  # speed, distance from the nose, event that ends the way over the rim


def scene(speed, off, *others, **run):
    table = {
        "shape": "table", "length": 2.0, "width": 1.0, "nose_height": 0.037, "restitution": 0.9, "friction": 0.2,
        "side_pockets": POCKETS,
    }  # fmt: skip
    shot = {"radius": RADIUS, "mass": MASS, "position": (-0.3, off - 0.5), "velocity": (speed, 0.0), "rolling": True}
    balls = [shot, *({"radius": RADIUS, "mass": MASS, "rolling": True, **one} for one in others)]
    floor = {"friction": 0.2, "rolling_resistance": 0.01}
    return carom.Scene(floor=floor, walls=[table], balls=balls, run={"pockets": "rim", "duration": 2.0, **run})


@pytest.mark.parametrize(("speed", "off", "ends"), ENDS)
def test_a_ball_on_a_rim_moves_as_pocket_rim_says(speed, off, ends):
    made = scene(speed, off)
    run = carom.simulate(made)
    entry = run.events[0]
    caught = carom.simulate(scene(speed, off, pockets="catch")).events.of("pocketed")[0]
    assert (entry.kind, entry.phase, entry.name, entry.t) == ("rim", "rim", "bottom middle pocket", caught.t)
    hand = billiards.pocket_rim(made, caught.name, caught.after)
    assert hand.end == ("bottom" if ends == "pocketed" else "away")
    between = [one for one in hand.events if one.kind in ("leaves", "lands")]
    events = run.events[: 2 + len(between)]
    assert events.kinds == ["rim", *({"leaves": "flight", "lands": "rim"}[one.kind] for one in between), ends]
    last = hand.events[-1] if ends == "pocketed" else hand.events[-2]
    for event, one in zip(events[1:], [*between, last], strict=True):
        assert event.t - entry.t == pytest.approx(one.time, abs=1e-12)
        assert np.abs(event.velocity - one.velocity).max() < 1e-12
    for t in np.linspace(0, last.time, 9)[1:-1]:
        now, then = hand.at(t), run.at(entry.t + t)
        assert np.abs(then.position[0] - now.place[0] - (0, -0.53, 0)).max() < 1e-12
        assert np.abs(then.velocity[0] - now.velocity[0]).max() < 1e-12


@pytest.mark.parametrize(("speed", "off", "ends"), ENDS)
def test_energy_never_grows_and_a_ball_that_comes_out_goes_on(speed, off, ends):
    run = carom.simulate(scene(speed, off))
    energy = run.energy(np.linspace(0, run.end, 300), each=True)[:, 0]
    energy = energy[np.isfinite(energy)]
    assert np.diff(energy).max() < 1e-8 * energy[0]
    assert run.final_phase == (["pocketed"] if ends == "pocketed" else ["rolling"])
    assert len(run.events.of("wall")) == (0 if ends == "pocketed" else 2)
    said = " ".join(run.describe())
    assert "rolls over the rim of the bottom middle pocket" in said
    assert ("comes out at" in said) == (ends == "rolling")
    q = run.orientation(np.array([0.3, 0.3001]))[:, 0]
    if ends == "rolling":  # dq = w q dt / 2
        spin = run.at(0.30005).spin[0]
        w, u = q[0, 0], q[0, 1:]
        rate = np.array([-spin @ u, *(w * spin + np.cross(spin, u))]) / 2
        assert run.phase(0.3).tolist() == ["rim"]
        assert np.abs((q[1] - q[0]) / 1e-4 - rate).max() < 0.01 * np.linalg.norm(spin)


def test_two_runs_cut_on_the_rim_equal_one(tmp_path):
    whole = carom.simulate(scene(1.0, 0.04))
    cut = carom.simulate(scene(1.0, 0.04, duration=0.3))
    assert (cut.ended, cut.final_phase) == ("duration", ["rim"])
    assert cut.log.tobytes() == whole.log[: len(cut.log)].tobytes()
    assert np.array_equal(cut.final.position, whole.at(0.3).position)
    # from where it comes out
    out = whole.events.of("rolling")[0]
    one = {"position": out.position, "velocity": out.velocity, "spin": out.spin}
    rest = scene(1.0, 0.04, duration=2.0 - out.t)
    rest = carom.replaced(rest, {"balls.0.rolling": False, **{f"balls.0.{name}": tuple(x) for name, x in one.items()}})
    again = carom.simulate(rest)
    assert np.abs(again.final.position - whole.final.position).max() < 1e-9
    read = carom.load_trajectory(whole.save(tmp_path / "run.parquet"))
    assert np.array_equal(read.at([0.3, 1.0]).position, whole.at([0.3, 1.0]).position)


def test_other_balls_have_the_same_bits():
    others = {"position": (0.3, 0.2), "velocity": (0.9, 0.5)}, {"position": (0.3, 0.46), "velocity": (-1.0, 0.0)}
    runs = [carom.simulate(scene(1.0, 0.04, *others, pockets=pockets, duration=1.0)) for pockets in ("catch", "rim")]
    first, second = (run.log[run.log["ball"] == 1] for run in runs)
    assert len(first) > 2
    assert first.tobytes() == second.tobytes()
    # two are on rims at the same time, as mirror images (point reflection)
    x, y = (runs[1].at(0.3).position[k, :2] for k in (0, 2))
    assert runs[1].phase(0.3).tolist() == ["rim", "rolling", "rim"]
    assert np.abs(x + y).max() < 1e-9
    assert (np.diff(runs[1].log["t"]) >= 0).all()


def test_what_rims_cannot_be_in_is_refused_in_one_line():
    made, line = scene(1.0, 0.04), r"run\.pockets: expected 'catch', as only single runs follow"
    run = carom.simulate(made)
    for refused in (
        lambda: carom.simulate_many(made, velocity=[[1, 0, 0]]),
        lambda: run.sensitivity("balls.0.velocity"),
        run.lyapunov,
        lambda: carom.sweep(carom.Space(made, {"balls.0.velocity.0": [1.0, 2.0]}), keep=["final.position"]).run(),
    ):
        with pytest.raises(carom.CaromError, match=line):
            refused()
    with pytest.raises(carom.CaromError, match=r"run\.pockets: expected 'catch' or 'rim', got 'edge'"):
        scene(1.0, 0.04, pockets="edge")
    out = run.events.of("rolling")[0].position
    with pytest.raises(carom.CaromError, match=r"ball 0: expected a free place where it comes back .* where ball 1 is"):
        carom.simulate(scene(1.0, 0.04, {"position": (out[0] + 0.05, out[1] + 0.01), "velocity": (0.0, 0.0)}))


def test_the_default_stands_in_no_file():
    assert "pockets" not in carom.Run().model_dump()
    assert scene(1.0, 0.04).model_dump()["run"]["pockets"] == "rim"
