"""All laws side by side: the paper's example, refusals, what JSON may hold."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from reference.bad_options import BAD

import carom
from carom.laws.comparison import remarks_on


def test_the_papers_example() -> None:
    comparison = carom.compare()
    assert comparison.incident_angle_deg == pytest.approx(45.0, abs=1e-12)
    conventional, two = comparison["conventional"], comparison["two-step"]
    # section 4: arctan 5/9 = 29.05 (printed 29.1), arctan 39/31 = 51.52 (printed 51.5)
    assert conventional.reflection_angle_deg == pytest.approx(math.degrees(math.atan(5 / 9)), abs=1e-10)
    assert two.reflection_angle_deg == pytest.approx(math.degrees(math.atan(39 / 31)), abs=1e-10)
    # (41)
    assert two.final is not None
    assert two.final.velocity == pytest.approx(np.array([31, 39, 0]) / 49 / math.sqrt(2), abs=1e-14)
    # (31): tangential over normal impulse, sqrt(2)/7
    assert two.required_wall == pytest.approx(math.sqrt(2) / 7, rel=1e-14)
    # (33) over (32)
    assert two.energy_ratio_after_wall == pytest.approx(39 / 49, rel=1e-14)
    assert conventional.energy_ratio == pytest.approx(1.0, rel=1e-14)
    assert two.admissible
    assert not two.why
    assert not conventional.admissible
    assert any("friction above 1" in sentence for sentence in conventional.why)


def test_every_law_is_there_in_order() -> None:
    main = [name for name, law in carom.LAWS.items() if not law.variant_of]
    cushions = ["han2005", "mathavan2010", "stronge-cushion"]
    assert main == ["mirror", "conventional", "no-slip", "two-step", "maw", "stronge", "contact", *cushions]
    on_floor = [name for name in main if name not in ("contact", *cushions)]  # which leaves the floor out
    assert [v.law for v in carom.compare().verdicts] == on_floor
    assert [v.law for v in carom.compare(carom.incoming(contact_height=1.3)).verdicts] == [*on_floor, *cushions]
    assert [v.law for v in carom.compare(carom.incoming(height=0.1)).verdicts] == [*on_floor, "contact"]
    assert [v.law for v in carom.compare(laws=["two-step", "mirror", "two-step"]).verdicts] == ["two-step", "mirror"]
    with pytest.raises(KeyError):
        carom.compare(laws=["mirror"])["two-step"]


def test_a_law_that_refuses_says_why() -> None:
    verdict = carom.compare(carom.incoming(spin_y=40.0))["conventional"]
    assert verdict.final is None
    assert verdict.reflection_angle_deg is None
    assert verdict.energy_ratio is None
    assert not verdict.admissible
    assert "rolls on the floor" in verdict.why[0]
    told = verdict.as_dict()
    assert told["after_wall"] is None
    assert told["required_friction"] == {"wall": None, "floor": None}


def test_a_ball_that_never_rolls() -> None:
    verdict = carom.compare(carom.incoming(floor_friction=0.0))["two-step"]
    assert verdict.after_wall is not None
    assert verdict.final is None
    assert verdict.reflection_angle_deg is None
    assert verdict.energy_ratio is None
    assert verdict.energy_ratio_after_wall == pytest.approx(39 / 49)
    assert verdict.remarks[-1] == "the ball never rolls again: the floor has no friction, so the ball slides for ever"


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"friction": 0.1}, "slides on the wall: its friction 0.1 is below the 0.202 required for sticking"),
        ({"floor_friction": 0.1}, "lands sliding: the floor's friction 0.1 is below"),
        ({"contact_height": 1.3, "friction": 0.2, "floor_friction": 0.2}, "presses the ball on the floor"),
        ({"floor_restitution": 0.5}, "bounces"),
        ({"angle_deg": 0.0, "spin_z": 20.0}, "leaves to the left"),
        ({"angle_deg": 0.0, "spin_z": -20.0}, "leaves to the right"),
        ({"angle_deg": 20.0, "spin_z": -100.0}, "to the side of the normal from which it came"),
    ],
)  # fmt: skip
def test_remarks(given: dict[str, float], said: str) -> None:
    assert any(said in remark for remark in carom.compare(carom.incoming(**given))["two-step"].remarks)  # type: ignore[arg-type]


def test_remarks_are_only_what_happens() -> None:
    meeting = carom.incoming()
    answer = carom.LAWS["two-step"].answer(meeting)
    assert list(remarks_on(meeting, answer, answer.final)) == [
        "the ball flies for 41.2 ms, 35.8 mm far and up to 2.08 mm high"
    ]


def test_a_cushion_touches_at_its_nose() -> None:
    meeting = carom.incoming(contact_height=1.4, radius=0.03)
    assert meeting.normal == pytest.approx([math.sqrt(1 - 0.16), 0, -0.4])
    # with the ball in the air the nose is lower on it
    lifted = carom.incoming(contact_height=1.4, radius=0.03, height=0.012)
    assert lifted.normal == pytest.approx([1, 0, 0], abs=1e-14)
    assert carom.incoming(contact_height=1.0).normal == pytest.approx([1, 0, 0])


def test_rolling_and_sliding() -> None:
    ball = carom.Ball()
    rolls = carom.incoming(2.0, 30.0, 5.0)
    assert carom.slip(ball, rolls.state) == pytest.approx(np.zeros(3), abs=1e-15)
    assert rolls.state.spin[2] == 5.0
    assert np.hypot(*rolls.state.velocity[:2]) == pytest.approx(2.0)
    assert carom.incoming(sliding=True).state.spin.tolist() == [0.0, 0.0, 0.0]
    assert carom.incoming(sliding=True, spin_y=3.0).state.spin.tolist() == [0.0, 3.0, 0.0]


@pytest.mark.parametrize(("given", "where"), BAD)
def test_bad_input_is_one_line(given: dict[str, float], where: str) -> None:
    with pytest.raises(carom.CaromError) as caught:
        carom.incoming(**given)  # type: ignore[arg-type]
    assert len(caught.value.faults) == 1
    assert caught.value.faults[0].startswith(where)
    assert "expected" in caught.value.faults[0]
    assert "got" in caught.value.faults[0]


def test_all_faults_at_once() -> None:
    with pytest.raises(carom.CaromError) as caught:
        carom.incoming(math.nan, 95.0, radius=0.0, restitution=2.0, floor_friction=-1.0)
    assert [fault.split(":")[0] for fault in caught.value.faults] == ["Ball", "wall", "floor", "incoming", "incoming"]


def test_what_is_not_one_ball_is_refused() -> None:
    ball = carom.Ball()
    many = carom.Meeting(ball, carom.rolling(ball, [(-1.0, 1.0), (-1.0, 2.0)]))
    with pytest.raises(carom.CaromError, match="expected one ball and one wall"):
        carom.compare(many)
    away = carom.Meeting(ball, carom.rolling(ball, (1.0, 1.0)))
    with pytest.raises(carom.CaromError, match="towards the wall"):
        carom.compare(away)
    with pytest.raises(carom.CaromError, match="did you mean 'two-step'"):
        carom.compare(laws=["twostep"])


share = st.one_of(st.just(0.0), st.just(1.0), st.floats(0, 1))
friction = st.one_of(st.just(0.0), st.just(math.inf), st.floats(0, 3))


@settings(deadline=None, max_examples=150)
@given(
    speed=st.floats(1e-3, 30), angle_deg=st.floats(0, 89.9), spin_z=st.floats(-300, 300), sliding=st.booleans(),
    spin_y=st.one_of(st.none(), st.floats(-300, 300)), inertia=st.floats(0.01, 2 / 3),
    restitution=share, friction=friction, floor_restitution=share, floor_friction=friction,
    height=st.one_of(st.just(0.0), st.floats(0, 0.3)), gravity=st.one_of(st.just(0.0), st.just(9.8)),
    contact_height=st.one_of(st.none(), st.floats(0.6, 1.5)),
)  # fmt: skip
def test_any_ball_gives_json_without_nan(**given: float) -> None:
    low = given["height"] / 0.02625
    if given["contact_height"] is not None and not low < given["contact_height"] < low + 2:
        given["contact_height"] = low + 1
    comparison = carom.compare(carom.incoming(**given))  # type: ignore[arg-type]
    told = json.loads(json.dumps(comparison.as_dict(), allow_nan=False))
    assert {row["law"] for row in told["laws"]} >= {"mirror", "conventional", "no-slip", "two-step"}
    for row in told["laws"]:
        # an inadmissible law says why; one without a final state says why
        assert row["admissible"] == (not row["why"])
        assert row["final"] is not None or row["why"] or row["remarks"]
        assert (row["energy_ratio"] is None) == (row["final"] is None)
        if row["energy_ratio"] is not None:
            assert row["energy_ratio"] <= 1 + 1e-9


def test_a_wall_that_lies_flat_has_laws_and_no_angles() -> None:
    ball, state = carom.Ball(), carom.State((1.0, 0.0, -1.0), (0.0, 0.0, 0.0))
    found = carom.compare(carom.Meeting(ball, state, np.array([0.0, 0.0, 1.0]), carom.Surface(0.8, 0.2)))
    assert math.isnan(found.incident_angle_deg)
    assert math.isnan(found["two-step"].reflection_angle_deg)
    assert found["two-step"].final is not None
