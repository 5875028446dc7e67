"""Many balls at once: the same bits compiled and as Python, on one thread and on two; shapes that broadcast."""

import subprocess
import sys

import numba
import numpy as np
import pytest
from reference.exploring import tried
from reference.identities import approaching, surfaces, units, with_zeros

import carom
from carom.core.jit.calls import answer_at
from carom.laws.arrays import CALLS_AT_FIRST, FEW_AT_FIRST, loop_for, wall_law_rows
from carom.laws.callbacks import user_address
from carom.laws.contact import contact_final_rows, contact_rows
from carom.laws.landing import second_rows
from carom.laws.pair import pair_rows
from carom.laws.registry import LAWS
from carom.laws.two_step import first_rows
from carom.laws.two_step_batch import ROOM, two_step_final_rows

COUNT = 20_000


def rows(seed, count, *, floor):
    """Arguments for the loops: states, normals, parameters for wall and floor; half of the balls on the floor."""
    rng = np.random.default_rng(seed)
    v, w, n = approaching(rng, count)
    if floor:
        n[:, 2] = np.where(rng.random(count) < 0.5, 0.0, n[:, 2] / 2)
        n[(n[:, :2] == 0).all(axis=-1), 0] = 1.0
        n /= np.linalg.norm(n, axis=-1, keepdims=True)
        v[rng.random(count) < 0.7, 2] = 0.0
        away = (v * n).sum(axis=-1) > 0
        v[away] *= -1
    kappa = rng.choice([2 / 5, 2 / 3, 0.1], count)
    height = np.where(rng.random(count) < 0.7, 0.0, rng.random(count))
    wall, ground = surfaces(rng, count), surfaces(rng, count)
    # floors that return nearly everything bounce some million times: a thing for another test
    ef = np.minimum(ground[0], 0.95)
    return v, w, n, np.ones(count), kappa, wall, (ef, *ground[1:]), np.full(count, 9.81), height


def by_python(loop, args, out):
    loop(*args, *out)
    return out


def by_threads(loop, args, out, threads):
    before = numba.get_num_threads()
    numba.set_num_threads(min(threads, numba.config.NUMBA_NUM_THREADS))
    try:
        loop_for(loop, FEW_AT_FIRST)(*args, *out)
    finally:
        numba.set_num_threads(before)
    return out


def same_bits(loop, args, make):
    with np.errstate(
        all="ignore"
    ):  # the loops' Python runs on NumPy's numbers, which warn where compiled code does not
        expected = by_python(loop, args, make())
    for threads in (1, 2):
        for got, want in zip(by_threads(loop, args, make(), threads), expected, strict=True):
            np.testing.assert_array_equal(got, want)  # NaN equals NaN
            assert (np.signbit(got) == np.signbit(want)).all() or got.dtype != float


def test_one_row_takes_the_loop_that_is_machine_code() -> None:
    """A single ball pressed on the floor takes Python some ten milliseconds, and the loop some ten microseconds."""
    state = carom.State(np.array([[-1.0, 0.2, 0.0]]), np.zeros((1, 3)))
    out = carom.State(np.zeros((1, 3)), np.zeros((1, 3)))
    for _ in range(CALLS_AT_FIRST + 1):
        carom.impact_into(out, carom.Ball(), state)
    assert loop_for(contact_final_rows, 1) is loop_for(contact_final_rows, FEW_AT_FIRST)


def room(count, *widths):
    return [np.full((count, k), 7.0) if k > 0 else np.zeros(count, dtype=np.int8 if k < 0 else float) for k in widths]


def test_contact():
    v, w, n, a, kappa, wall, *_ = rows(50, COUNT, floor=False)
    p = np.stack([a, kappa, *wall], axis=-1)
    same_bits(contact_rows, (v, w, n, p), lambda: room(COUNT, 3, 3, 3, 0, -1))
    # the short loop, flat, one wall for all
    same_bits(
        contact_final_rows, (v.ravel(), w.ravel(), n[0], p[0]), lambda: [np.zeros(3 * COUNT), np.zeros(3 * COUNT)]
    )


def test_two_step_of_lifted_balls():
    count = tried(2000, 6000)  # Python takes its time
    v, w, n, a, kappa, wall, floor, g, h = rows(51, count, floor=True)
    p = np.stack([a, kappa, *wall, *floor, h], axis=-1)
    same_bits(first_rows, (v, w, n, p, False), lambda: room(count, 3, 3, 3, 3, 0, -1))
    q = np.stack([a, kappa, *floor, g, h], axis=-1)
    v1, w1 = by_threads(first_rows, (v, w, n, p, False), room(count, 3, 3, 3, 3, 0, -1), 2)[:2]

    def second():
        return room(count, 0, 0, 0, 3, 3, 3, 0, -1, 3, 3, -1)

    same_bits(second_rows, (v1, w1, n, q), second)
    # the short loop, one wall and one floor for all
    both = np.array([1.0, 2 / 5, 0.8, 0.3, 0.0, 0.5, 0.2, 0.0, 9.81, 0.0])
    for wall_normal in (n[0], np.array([1.0, 0.0, 0.0])):
        args = (v.ravel(), w.ravel(), wall_normal, both, False)
        same_bits(
            two_step_final_rows,
            args,
            lambda: [np.zeros(3 * count), np.zeros(3 * count), *room(count, -1), np.zeros((2, ROOM))],
        )


def test_two_step_of_pressed_balls():
    """Wall and floor at once uses atan2 where a ball is lifted while the wall acts, which need not round alike."""
    count = 300
    v, w, n, a, kappa, wall, floor, _g, _h = rows(52, count, floor=True)
    beta = np.where(wall[2] == -1, -1.0, 0.0)
    v[:, 2] = np.minimum(v[:, 2], 0)
    p = np.stack([a, kappa, wall[0], wall[1], beta, *floor, 0 * a], axis=-1)
    args, out = (v, w, n, p, True), room(count, 3, 3, 3, 3, 0, -1)
    keep = (v * n).sum(axis=-1) <= 0
    args = (v[keep], w[keep], n[keep], p[keep], True)
    out = [x[keep] for x in out]
    with np.errstate(all="ignore"):
        expected = by_python(first_rows, args, [x.copy() for x in out])
    one, two = (by_threads(first_rows, args, [x.copy() for x in out], t) for t in (1, 2))
    for x, y, z in zip(one, two, expected, strict=True):
        np.testing.assert_array_equal(x, y)
        np.testing.assert_allclose(x, z, rtol=1e-12, atol=1e-12)
        assert (x == z).mean() > 0.9


def at_upright_walls(law):
    v, w, n, a, kappa, wall, *_ = rows(53, COUNT, floor=False)
    n[:, 2] = 0
    n[(n == 0).all(axis=-1), 0] = 1.0
    n /= np.linalg.norm(n, axis=-1, keepdims=True)
    count = tried(1500, 5000)
    v, w, n, p = (np.ascontiguousarray(x[:count]) for x in (v, w, n, np.stack([a, kappa, *wall], axis=-1)))
    if law.last == "stiffness_ratio":
        p[:, 4] = 0.5 + 0.5 * np.abs(p[:, 4])
    return v, w, n, p


@pytest.mark.parametrize("name", [name for name, law in LAWS.items() if name != "two-step" and not law.on_table])
@pytest.mark.slow(keep=4)
def test_laws(name):
    args = at_upright_walls(LAWS[name])
    same_bits(wall_law_rows(LAWS[name].kernel), args, lambda: room(len(args[0]), 3, 3))


@pytest.mark.parametrize("name", [name for name, law in LAWS.items() if law.on_table])
def test_laws_of_cushions(name):
    """Runs call their kernels by the address, and no loop over rows has them: the verbs evaluate nose and table apart."""
    v, w, n, p = at_upright_walls(LAWS[name])
    address, expected = user_address(LAWS[name].kernel), np.zeros((len(v), 6))
    with np.errstate(all="ignore"):
        wall_law_rows(LAWS[name].kernel)(v, w, n, p, expected[:, :3], expected[:, 3:])
    got = np.array([answer_at(address, tuple(numbers)) for numbers in np.hstack([v, w, n, p]).tolist()])
    np.testing.assert_array_equal(got, expected)
    assert (np.signbit(got) == np.signbit(expected)).all()


def test_pairs():
    rng = np.random.default_rng(54)
    v1, w1, v2, w2 = (with_zeros(rng, rng.normal(size=(COUNT, 3))) for _ in range(4))
    n = units(rng, COUNT)
    balls = [rng.uniform(0.5, 2, COUNT), 10 ** rng.uniform(-1, 1, COUNT), rng.choice([2 / 5, 2 / 3], COUNT)]
    falls = [with_zeros(rng, rng.uniform(0, 0.3, (COUNT, 1)))[:, 0], rng.uniform(0, 2, COUNT)]  # of mu with the slip
    p = np.stack([*balls, *balls[::-1][1:], balls[2], *surfaces(rng, COUNT), *falls], axis=-1)
    p[:, 3], p[:, 4] = balls[0][::-1], balls[1][::-1]
    same_bits(pair_rows, (v1, w1, v2, w2, n, p), lambda: room(COUNT, 3, 3, 3, 3, 3, 0, -1))


# --- the public verbs ---------------------------------------------------------------------------------------------


def many_states(count=1000):
    rng = np.random.default_rng(55)
    velocity = rng.normal(size=(count, 2))
    velocity[:, 0] = -np.abs(velocity[:, 0])
    return carom.rolling(carom.Ball(), velocity, rng.normal(size=count))


def test_into_equals_the_full_answer():
    ball, states = carom.Ball(), many_states()
    wall, floor = carom.Surface(0.85, 0.2), carom.Surface(0.5, 0.2)
    for count in (1000, 100):  # compiled, and Python
        some = states[:count]
        out = carom.State(np.zeros((count, 3)), np.zeros((count, 3)))
        carom.impact_into(out, ball, some, surface=wall)
        assert out == carom.impact(ball, some, surface=wall).after
        why = np.zeros(count, dtype=np.int8)
        carom.two_step_into(out, why, ball, some, wall, floor)
        full = carom.two_step(ball, some, wall, floor)
        assert out == full.rolling
        np.testing.assert_array_equal(why == 0, full.rolls)


@pytest.mark.parametrize("count", [3, 1000])
def test_into_what_cannot_be_written_into(count):
    """A short array of reasons was written beyond its end, and pressed balls were computed from others' results."""
    ball, some = carom.Ball(), many_states()[:count]
    out, why = carom.State(np.zeros((count, 3)), np.zeros((count, 3))), np.zeros(count, np.int8)
    several = np.tile([1.0, 0.0, 0.0], (count, 1))
    for wrong in (
        why[:-1],
        np.zeros(count),
        np.zeros((count, 1), np.int8),
        np.zeros(2 * count, np.int8)[::2],
        [0] * count,
    ):
        with pytest.raises(
            carom.CaromError, match=rf"why: expected a contiguous array of shape \({count},\) and type int8"
        ):
            carom.two_step_into(out, wrong, ball, some)
    with pytest.raises(carom.CaromError, match="out: expected arrays apart from the state's own, got the same memory"):
        carom.two_step_into(some, why, ball, some)
    short = carom.State(np.zeros((count - 1, 3)), np.zeros((count - 1, 3)))
    for into in (carom.impact_into, lambda out, *rest, **more: carom.two_step_into(out, why, *rest, **more)):
        with pytest.raises(carom.CaromError, match="out: velocity: expected a contiguous array of shape"):
            into(short, ball, some)
        with pytest.raises(carom.CaromError, match="normal: expected 3 numbers, the same for all balls"):
            into(out, ball, some, normal=several)
    assert not out.velocity.any()
    expected = carom.impact(ball, some).after
    carom.impact_into(some, ball, some)  # (row by row: in place)
    assert some == expected


def test_one_as_many():
    """What one state gives is what it gives among a thousand, bit for bit, in every field."""
    ball, states = carom.Ball(), many_states()
    wall, floor = carom.Surface(0.5, 0.2, 0.0), carom.Surface(0.7, 0.2, 0.3)
    many = carom.two_step(ball, states, wall, floor, height=0.0)
    for i in (0, 17, 999):
        one = carom.two_step(ball, states[i], wall, floor)
        assert one.after_wall == many.after_wall[i]
        assert one.after_floor == many.after_floor[i]
        assert one.rolling == many.rolling[i]
        assert one.rolls == many.rolls[i]
        assert one.why == many.why[i]
        assert one.wall.regime == many.wall.regime[i]
        assert one.floor.regime == many.floor.regime[i]
        np.testing.assert_array_equal(one.wall.impulse, many.wall.impulse[i])
        np.testing.assert_array_equal(one.floor.impulse, many.floor.impulse[i])
        for field in ("duration", "height", "distance"):
            assert getattr(one.flight, field) == getattr(many.flight, field)[i]
        assert one.wall.required_friction == many.wall.required_friction[i]
        assert one.wall.energy_lost == many.wall.energy_lost[i]
        np.testing.assert_array_equal(one.reflection_angle, many.reflection_angle[i])
        assert isinstance(one.rolls, bool | np.bool_)
        assert isinstance(one.reflection_angle, float)


def test_everything_broadcasts():
    """States (3, 1), normals (4,), radii (4,), masses (3, 1), frictions (4,): answers (3, 4), each as it is alone."""
    v = np.array([(-1, 0.3, 0), (-1, -1, 0), (-2, 0.1, 0)], dtype=float)[:, None]
    states = carom.State(v, (0.0, -20.0, 3.0))
    normals = np.array([(1, 0, 0), (2, 0.1, 0), (1, -0.1, 0), (1, 0, 0.1)])
    radius, mass = np.array([0.02, 0.03, 0.04, 0.05]), np.array([0.1, 0.2, 0.3])[:, None]
    mu = np.array([0.0, 0.1, 0.5, np.inf])
    ball, wall = carom.Ball(radius, mass), carom.Surface(0.9, mu)
    hit = carom.impact(ball, states, normals, wall)
    two = carom.two_step(ball, states, wall, carom.Surface(0.5, mu[::-1]), normals, height=np.array([0, 0, 0.1, 0]))
    assert hit.after.shape == two.rolling.shape == (3, 4)
    assert hit.regime.shape == two.why.shape == two.flight.duration.shape == (3, 4)
    assert hit.energy_lost.shape == two.wall.energy_lost.shape == two.reflection_angle.shape == (3, 4)
    for i in range(3):
        for k in range(4):
            one = carom.Ball(radius[k], mass[i, 0])
            single = carom.impact(one, states[i, 0], normals[k], carom.Surface(0.9, mu[k]))
            assert single.after == hit.after[i, k]
            np.testing.assert_array_equal(single.impulse, hit.impulse[i, k])
            np.testing.assert_allclose(single.energy_lost, hit.energy_lost[i, k], rtol=1e-13, atol=1e-18)
            step = carom.two_step(
                one, states[i, 0], carom.Surface(0.9, mu[k]), carom.Surface(0.5, mu[::-1][k]), normals[k],
                height=[0, 0, 0.1, 0][k],
            )  # fmt: skip
            assert step.rolling == two.rolling[i, k]
            assert step.why == two.why[i, k]


def test_normal_of_any_length():
    ball, state = carom.Ball(), carom.State((-1, 0.5, 0), (1, 2, 3))
    unit = carom.impact(ball, state, (0.6, 0.8, 0))
    for factor in (5, 1e-90, 1e90):
        got = carom.impact(ball, state, np.array([0.6, 0.8, 0]) * factor)
        np.testing.assert_allclose(got.after.velocity, unit.after.velocity, rtol=1e-14)


def test_no_states_at_all():
    none = carom.State(np.zeros((0, 3)))
    assert carom.impact(carom.Ball(), none).after.shape == (0,)
    assert carom.two_step(carom.Ball(), none).rolls.shape == (0,)
    assert carom.two_step(carom.Ball(), none).why.shape == (0,)


def test_input_is_left_alone():
    ball, states = carom.Ball(), many_states(500)
    v, w = states.velocity.copy(), states.spin.copy()
    carom.two_step(ball, states)
    carom.conventional(ball, states)
    np.testing.assert_array_equal(states.velocity, v)
    np.testing.assert_array_equal(states.spin, w)


# --- what is imported when ------------------------------------------------------------------------------------------

HEAVY = ("numba", "matplotlib", "sympy", "scipy", "pyarrow", "rich", "typer")


@pytest.mark.parametrize(
    "code",
    [
        "import carom",
        "import carom; b = carom.Ball(); carom.two_step(b, carom.rolling(b, (-1, 1)))",
        "import carom; b = carom.Ball(); carom.two_step(b, carom.State((-1, 1, 0), (0, 90, 0)))",
        "import carom; b = carom.Ball(); carom.conventional(b, carom.rolling(b, (-1, 1)))",
        "import carom; carom.domenech(carom.Ball()).regime",
    ],
)
def test_light(code):
    code += f"; import sys; print([m for m in {HEAVY} if m in sys.modules])"
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert out.stdout.strip() == "[]"


@pytest.mark.parametrize("law", ["two_step", "impact", "conventional"])
def test_the_rows_beside_one_that_recedes_are_answered(law: str) -> None:
    rng = np.random.default_rng(1)
    velocity = np.stack([-rng.uniform(1, 3, 40), rng.normal(size=40), np.zeros(40)], axis=-1)
    velocity[12, 0] = 1.0
    ball = carom.Ball()
    state = carom.rolling(ball, velocity[:, :2])
    with pytest.raises(carom.CaromError, match=r"\(12,\) \(1 of 40; go on with the others, state\[keep\]"):
        getattr(carom, law)(ball, state)
    keep = velocity[:, 0] < 0
    after = getattr(carom, law)(ball, state[keep])
    columns = {"velocity_x": velocity[:, 0], "velocity_y": velocity[:, 1]}
    numbers = {} if law == "conventional" else {"restitution": 1.0}
    found = carom.predict(
        columns, {"two_step": "two-step", "impact": "contact"}.get(law, law), spin="rolling", **numbers
    )
    assert np.flatnonzero(found["note"] != "").tolist() == [12]
    seen = getattr(after, "after_wall", getattr(after, "after", after))
    assert found["velocity_x_out"][keep] == pytest.approx(seen.velocity[:, 0])
