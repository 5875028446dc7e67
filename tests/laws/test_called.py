"""Laws that are called with a ball and its state, as ``two_step`` is."""

from __future__ import annotations

import numpy as np
import pytest

import carom
from carom.errors import CaromError

BALL = carom.Ball(radius=0.0286, mass=0.17)
STATE = carom.rolling(BALL, (-2.0, 1.0), spin_z=5.0)
RAIL, CLOTH = carom.Surface(0.85, 0.2), carom.Surface(0.5, 0.2)


def test_the_two_step_law_is_the_function() -> None:
    for state in (STATE, carom.rolling(BALL, np.array([[-2.0, 1.0], [-0.5, -3.0]]))):
        found = carom.LAWS["two-step"](BALL, state, RAIL, CLOTH, normal=(1, 0, -0.2))
        steps = carom.two_step(BALL, state, RAIL, CLOTH, normal=(1, 0, -0.2))
        np.testing.assert_allclose(
            found.after_wall.spin, steps.after_wall.spin, rtol=1e-13
        )  # (summed in another order)
        np.testing.assert_allclose(found.final.velocity, steps.rolling.velocity, rtol=1e-13)


@pytest.mark.parametrize("name", ["han2005", "mathavan2010", "stronge-cushion", "maw", "stronge", "contact"])
def test_every_law_answers_as_in_a_comparison(name: str) -> None:
    meeting = carom.incoming(
        2.0, 30.0, 4.0, restitution=0.85, friction=0.2, floor_restitution=0.5, floor_friction=0.2, radius=0.0286, mass=0.17,
        contact_height=1.3,
    )  # fmt: skip
    found = carom.LAWS[name](BALL, meeting.state, RAIL, CLOTH, normal=meeting.normal)
    verdict = carom.compare(meeting, [name])[name]
    np.testing.assert_array_equal(found.after_wall.velocity, verdict.after_wall.velocity)


def test_the_authors_own_parameters_are_the_default() -> None:
    law, nose = carom.LAWS["mathavan2010"], (1, 0, -0.37)
    own = law(BALL, STATE, carom.Surface(0.98, 0.14), normal=nose).after_wall.velocity
    assert law(BALL, STATE, normal=nose).after_wall.velocity.tobytes() == own.tobytes()


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: carom.LAWS["conventional"](BALL, carom.State((-1, 0, 0), (0, 0, 5.0))), "conventional: expected "),
        (
            lambda: carom.LAWS["maw"](BALL, carom.rolling(BALL, (1.0, 0.0))),
            "expected a ball that moves towards the wall",
        ),
        (lambda: carom.LAWS["maw"](BALL, STATE, 0.8), "maw: wall: expected a Surface"),
        (lambda: carom.LAWS["maw"](BALL, STATE, gravity=-1), "maw: gravity: expected a number >= 0 in m/s^2, got -1"),
    ],
)
def test_calls_that_cannot_be(call: object, said: str) -> None:
    with pytest.raises(CaromError) as caught:
        call()  # type: ignore[operator]
    assert said in str(caught.value)
    assert len(caught.value.faults) == 1


def test_a_law_that_is_asked_for_as_a_function_is_named() -> None:
    with pytest.raises(AttributeError, match=r"carom\.LAWS\['stronge-cushion'\]\(ball, state, wall\)"):
        carom.stronge_cushion  # noqa: B018
    with pytest.raises(AttributeError, match=r"carom has no billard; did you mean billiards\?"):
        carom.billard  # noqa: B018
    with pytest.raises(AttributeError, match=r"carom has no twostep; did you mean two_step\?"):
        carom.twostep  # noqa: B018
    with pytest.raises(AttributeError, match=r"no function curve; the table is carom.billiards.table\('curve', ...\)"):
        carom.billiards.curve  # noqa: B018
    for name, said in (("two_step", "did you mean 'two-step'"), ("abc", "known are mirror, ")):
        with pytest.raises(KeyError, match=f"no law '{name}'; {said}"):
            carom.LAWS[name]


def test_a_law_that_is_called_shows_itself_and_has_the_names_of_two_step() -> None:
    ball = carom.Ball()
    found = carom.LAWS["mathavan2010"](ball, carom.rolling(ball, (-1.0, 1.0)), normal=(1.0, 0.0, -0.3))
    assert found.rolling is found.final
    assert repr(found).startswith("<Answer: after the wall 0.")
    many = carom.LAWS["mirror"](ball, carom.rolling(ball, [(-1.0, 1.0), (-2.0, 1.0)]))
    assert repr(many) == "<Answer of shape (2,)>"


def test_an_event_has_the_state_after_it() -> None:
    hit = carom.simulate("carom", duration=1).events.of("wall")[0]
    assert hit.velocity is hit.after.velocity
    assert hit.spin is hit.after.spin
    assert hit.position is hit.after.position
