"""One ball in a table: what it meets, what it keeps, that it comes back, and the law's bits."""

import math

import numpy as np
import pytest
from hypothesis import given
from reference.identities import directions, inertias, vectors
from reference.plane_tables import CLEARANCE, L_SHAPE, PLANE, first_outside

import carom
from carom import billiards
from carom.billiards.intersections import ENDS, circle_exit
from carom.billiards.loop import MEMORY, iterate
from carom.billiards.setup import orbit_setup, start_rows
from carom.core.jit.kernel import dot
from carom.laws.no_slip import no_slip_bounce, no_slip_reflection

SPACE = {
    "sphere": billiards.sphere,
    "box": lambda **o: billiards.box((1.0, 1.4, 2.0), **o),
    "cylinder": lambda **o: billiards.cylinder(billiards.circle(**o), 2.0),
    "stadium cylinder": lambda **o: billiards.cylinder(billiards.stadium(1.0, 0.6, **o), 2.0),
}
BOTH = ("centre", "surface")


def tables():
    return [pytest.param(make(bounds=b), id=f"{name}-{b}") for name, make in (PLANE | SPACE).items() for b in BOTH]


# --- by brute force: small steps, and distances that know nothing of pieces -----------------------------------------------


@pytest.mark.parametrize("bounds", BOTH)
@pytest.mark.parametrize("name", CLEARANCE)
def test_meets_what_small_steps_meet(name, bounds):
    """From random places inside, the first wall is where a march in steps of 1e-3 first finds it, to 1e-9."""
    table, clearance = PLANE[name](bounds=bounds), CLEARANCE[name]
    inset = 0.07 if bounds == "surface" else 0.0
    rng = np.random.default_rng(1)
    x = rng.uniform(-1, 2, (400, 2))
    x = x[clearance(x) > inset + 0.01][:8]
    angle = rng.uniform(0, math.tau, len(x))
    v = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    found = billiards.orbit(table, (x, v, 0.0), 1, ball=carom.Disc(0.07, 1.0), at_corner="pass")
    steps = np.arange(0, 15 if table.shape(0.0).cell else 4, 1e-3)
    for k in range(len(x)):
        out = first_outside(clearance, lambda t, k=k: x[k] + t[:, None] * v[k], steps, inset)
        if out is None:  # a long way between scatterers
            assert table.name in ("sinai", "torus", "periodic strip")
            assert not found.t[k, 0] < steps[-1]
            continue
        low, high = steps[out - 1], steps[out]
        for _ in range(45):
            middle = (low + high) / 2
            if clearance(x[k : k + 1] + middle * v[k])[0] < inset:
                high = middle
            else:
                low = middle
        # (grazing a convex wall, a step may pass over what is met: then earlier)
        t = found.t[k, 0]
        assert t == pytest.approx(low, abs=1e-9) or (t < low and clearance(x[k : k + 1] + t * v[k])[0] < inset + 1e-9)


@pytest.mark.parametrize("table", tables())
def test_never_outside_never_lost(table):
    """500 bounces of 60 orbits from the invariant measure: all made, on the wall, away from it, with their energy."""
    begin = billiards.starts(table, 60, 7)
    found = billiards.orbit(table, begin, 500, at_corner="pass")
    assert set(np.unique(found.ended)) == {"bounces"}
    gap = found.setup.shape.gap(found.folded)
    assert np.abs(gap).max() < 1e-9 * (1 + np.abs(found.position).max())
    assert found.across.min() > 0
    np.testing.assert_allclose(found.speed, 1.0, rtol=1e-13)
    if table.dimension == 2:
        length = found.setup.shape.lengths.sum()
        assert found.arc.min() >= -1e-9
        assert found.arc.max() <= length + 1e-9
        # and back: from the arc length to the place
        _piece, x, n = found.setup.shape.place(found.arc[:, -1])
        there = found.folded[:, -1]
        if found.setup.shape.cell is None:
            np.testing.assert_allclose(x, there, atol=1e-9)
            np.testing.assert_allclose(n, found.normal[:, -1], atol=1e-8)
        assert ((found.phase**2).sum(-1) <= 1).all()


@pytest.mark.parametrize("table", tables())
def test_comes_back(table):
    """Reversed after 20 bounces every orbit finds its way back, as far as chaos lets 1e-16 be."""
    begin = billiards.starts(table, 200, 8)
    found = billiards.orbit(table, begin, 20, at_corner="pass")
    back, error = billiards.reverse(found)
    assert error.shape == (200, 20)
    assert np.median(error[:, :5].max(axis=-1)) < 1e-9
    if not table.name.startswith(("sinai", "torus", "periodic", "stadium", "cylinder")):
        assert np.median(error.max(axis=-1)) < 1e-9
    # its second bounce undoes the last but one: the spin is then that before it, backwards
    spin, before = (
        (back.spin[:, 1], found.spin[:, -3]) if table.dimension == 2 else (back.spin[:, 1, 2], found.spin[:, -3, 2])
    )
    assert np.median(np.abs(spin + before)) < 1e-9


@pytest.mark.parametrize(
    "table", [billiards.circle(), billiards.regular(5), billiards.sinai(), billiards.ellipse(bounds="surface")]
)
def test_compiled_as_python(table):
    """The loop as Python gives the compiled loop's bits."""
    begin = billiards.starts(table, 1, 3)
    found = billiards.orbit(table, begin, 70, at_corner="pass")
    setup = orbit_setup(table, None, "no-slip", None, "pass")
    rows, _shape = start_rows(setup, begin)
    kept, piece, last = np.full((70, 6), np.nan), np.zeros(70, np.int32), np.zeros(10)
    row = [float(r) for r in rows[0]]
    world, pieces = setup.world.view(np.recarray)[0], setup.pieces.view(np.recarray)
    memory, start = np.zeros(MEMORY), (tuple(row[:3]), tuple(row[3:6]), tuple(row[6:]))
    for done in (9, 18, 27, 36, 45, 54, 63, 70):  # in pieces, as long runs are
        ended, count = iterate(world, pieces, setup.panels, *start, 70, 9, kept, piece, last, memory)
        assert (ended, count) == (0, done)
    np.testing.assert_array_equal(kept[:, 0], found.t[0])
    np.testing.assert_array_equal(kept[:, 1:3], found.position[0])
    np.testing.assert_array_equal(kept[:, 5], found.spin[0])
    np.testing.assert_array_equal(last, found.last[0])


def test_threads_do_not_matter():
    import numba

    begin = billiards.starts(billiards.stadium(), 64, 5)
    many = billiards.orbit(billiards.stadium(), begin, 300)
    before = numba.get_num_threads()
    try:
        numba.set_num_threads(1)
        one = billiards.orbit(billiards.stadium(), begin, 300)
    finally:
        numba.set_num_threads(before)
    for a, b in ((many.position, one.position), (many.spin, one.spin), (many.t, one.t)):
        np.testing.assert_array_equal(a, b)
    # and each orbit is what it is alone
    alone = billiards.orbit(billiards.stadium(), (begin.position[7], begin.velocity[7], begin.spin[7]), 300)
    np.testing.assert_array_equal(alone.position, many.position[7])


# --- laws -------------------------------------------------------------------------------------------------------------------


@given(vectors(), vectors(), directions(), inertias)
def test_no_slip_bounce_is_the_contact_kernel(v, w, n, kappa):
    """What the loop calls gives the bits of the one contact kernel."""
    if dot(v, n) > 0:
        v = tuple(-c for c in v)
    slip = 1 + max(map(abs, (*v, *w)))
    if dot(v, n) < -1e-12 * slip:
        v1, w1, _j, _required = no_slip_reflection(v, w, n, 0.3, kappa)
        assert no_slip_bounce(v, w, n, 0.3, kappa) == (v1, w1)


@pytest.mark.parametrize(
    "table", [billiards.stadium(), billiards.ellipse(bounds="surface"), billiards.sphere(), billiards.box()]
)
def test_laws_agree_where_they_are_the_same(table):
    begin = billiards.starts(table, 10, 2)
    one = billiards.orbit(table, begin, 40, at_corner="pass")
    two = billiards.orbit(table, begin, 40, law="contact", surface=carom.Surface(1, math.inf, 1), at_corner="pass")
    np.testing.assert_array_equal(one.position, two.position)

    def mine(v, w, n, a, kappa, e, mu, beta):
        un = v[0] * n[0] + v[1] * n[1] + v[2] * n[2]
        return (v[0] - 2 * un * n[0], v[1] - 2 * un * n[1], v[2] - 2 * un * n[2]), w

    own = billiards.orbit(table, begin, 40, law=mine, at_corner="pass")
    mirror = billiards.orbit(table, begin, 40, law="mirror", at_corner="pass")
    np.testing.assert_allclose(own.position[:, :10], mirror.position[:, :10], atol=1e-9)
    np.testing.assert_array_equal(mirror.spin[:, -1], begin.spin)


def test_every_bounce_is_the_verb_that_carom_has():
    """State after each bounce of an orbit in an ellipse, against carom.no_slip and carom.conventional at that normal."""
    table = billiards.ellipse(1.2, 0.9, bounds="surface")
    ball = carom.Ball(0.1, 1.0)
    for law, verb in (("no-slip", carom.no_slip), ("rolling", carom.conventional)):
        found = billiards.orbit(table, ((0.1, 0.2), (0.7, -0.5), 3.0), 30, ball=ball, law=law)
        n = np.concatenate([found.normal[1:], np.zeros((29, 1))], axis=1)
        v = np.concatenate([found.velocity, np.zeros((30, 1))], axis=1)
        w = np.zeros((30, 3))
        w[:, 2] = found.spin
        if law == "rolling":
            w[:, 0], w[:, 1] = -v[:, 1] / 0.1, v[:, 0] / 0.1
        after = verb(ball, carom.State(v[:-1], w[:-1]), n)
        np.testing.assert_allclose(after.velocity, v[1:], atol=1e-12)
        np.testing.assert_allclose(after.spin[:, 2], w[1:, 2], atol=1e-11)


def test_soft_walls_lose_energy_and_graze():
    soft = carom.Surface(0.9, 0.2, 0.3)
    found = billiards.orbit(billiards.stadium(), ((0.1, 0.0), (0.7, 0.4), 0.3), 200, law="contact", surface=soft)
    speed = found.speed[: found.count]
    assert (np.diff(speed) <= 1e-15).all()
    assert speed[-1] < 0.5 * speed[0]
    stuck = billiards.orbit(
        billiards.circle(), ((0.0, 0.0), (0.7, 0.4), 0.3), 5, law="contact", surface=carom.Surface(0.0, 0.1)
    )
    assert str(stuck.ended) == "grazed"
    assert stuck.count == 0


# --- ends -------------------------------------------------------------------------------------------------------------------


def test_corners():
    """A ball on its way into a corner ends there, or meets both sides."""
    square = billiards.rectangle(2.0, 2.0)
    found = billiards.orbit(square, ((0.0, 0.0), (1.0, 1.0), 0.0), 10)
    assert (str(found.ended), found.count) == ("corner", 0)
    assert np.isnan(found.t).all()
    through = billiards.orbit(square, ((0.0, 0.0), (1.0, 1.0), 0.0), 10, law="mirror", at_corner="pass")
    assert through.count == 10
    np.testing.assert_allclose(through.velocity[1], [-1, -1], atol=1e-12)
    # where two sides are one, or the centre goes round a vertex, there is no corner
    flat = billiards.polygon([(-1, -1), (0, -1), (1, -1), (1, 1), (-1, 1)])
    assert billiards.orbit(flat, ((0.0, 0.0), (0.0, -1.0), 0.0), 4, law="mirror").count == 4
    reentrant = billiards.polygon(L_SHAPE, bounds="surface")
    straight = billiards.orbit(reentrant, ((0.5, 0.5), (1.0, 1.0), 0.0), 2, law="mirror")
    assert straight.count >= 1
    np.testing.assert_allclose(straight.position[0], 1 - 0.1 / math.sqrt(2), atol=1e-12)
    assert str(billiards.orbit(billiards.polygon(L_SHAPE), ((0.5, 0.5), (1.0, 1.0), 0.0), 2).ended) == "corner"


def test_escapes_and_flies_free():
    assert str(billiards.orbit(billiards.wedge(30), ((1.0, 0.0), (1.0, 0.0), 0.0), 5).ended) == "escaped"
    assert str(billiards.orbit(billiards.sinai(0.2), ((0.0, 0.3), (1.0, 0.0), 0.0), 5).ended) == "free"
    assert {str(e) for e in ENDS} == {"bounces", "escaped", "corner", "grazed", "free"}


@pytest.mark.parametrize("slope", [1e-3, 1e-6, 1e-9, 1e-13])
def test_whispering(slope):
    """Nearly along the wall: chords as short as they should be, bounce after bounce, on the wall to the last digits."""
    tables = [(billiards.circle(), 1.0), (billiards.ellipse(1, 0.8), 1.0)]
    if slope > 1e-8:  # flatter flights along a parallel curve end as "grazed"
        tables.append((billiards.ellipse(1, 0.8, bounds="surface"), 0.9))
    for table, far in tables:
        found = billiards.orbit(table, ((far, 0.0), (-slope, 1.0), 0.0), 1000, law="mirror")
        assert found.count == 1000
        if table.bounds == "centre":
            x, y = found.position.T
            assert np.abs(x * x + (y / table.sizes.get("half_axes", [1.0, 1.0])[1]) ** 2 - 1).max() < 1e-13
        if table.name == "circle":  # (a root of the chord's square, but for the flattest)
            digits = 2e-15 / slope**2 if slope > 1e-4 else 1e-15 / slope
            np.testing.assert_allclose(np.diff(found.t), 2 * slope / (1 + slope**2), rtol=digits)
        else:  # adiabatic: the angle goes with the cube root of the curvature
            assert found.across.max() < 2 * slope
            assert found.across.min() > slope / 4


def test_no_orbits_at_all():
    found = billiards.orbit(billiards.circle(), (np.zeros((0, 2)), np.ones((0, 2)), 0.0), 10)
    assert found.t.shape == (0, 10)
    assert "0 orbits" in repr(found)


def test_final_keeps_nothing_and_says_the_same():
    begin = billiards.starts(billiards.sinai(), 20, 4)
    found = billiards.orbit(billiards.sinai(), begin, 500)
    state, t, count, ending = billiards.final(billiards.sinai(), begin, 500)
    np.testing.assert_array_equal(state.position, found.position[:, -1])
    np.testing.assert_array_equal(state.spin, found.spin[:, -1])
    np.testing.assert_array_equal(t, found.t[:, -1])
    assert (count == 500).all()
    assert (ending == 0).all()


def test_a_million_bounces_keep_their_energy():
    for table in (
        billiards.circle(),
        billiards.regular(5),
        billiards.cylinder(acceleration=-1.0),
        billiards.strip(acceleration=0.3),
    ):
        flat = table.dimension == 2
        begin = ((0.1, 0.2), (0.7, 0.4), 0.9) if flat else ((0.1, 0.2, 0.0), (0.7, 0.4, 0.1), (0.3, 0.2, 0.9))
        state, *_ = billiards.final(table, begin, 1_000_000)
        kappa = 0.5 if flat else 0.4
        energy = [
            (np.square(v).sum() + kappa * np.square(w).sum()) / 2 - np.dot(table.acceleration[: len(x)], x)
            for x, v, w in (begin, (state.position, state.velocity, state.spin))
        ]
        scale = abs(energy[0]) + np.square(state.velocity).sum()
        assert abs(energy[1] - energy[0]) < 1e-12 * scale


# --- shapes -----------------------------------------------------------------------------------------------------------------


def test_lengths():
    assert billiards.circle(2.0).wall().lengths.sum() == pytest.approx(4 * math.pi)
    assert billiards.stadium(2.0, 1.0, bounds="surface").shape(0.25).lengths.sum() == pytest.approx(4 + 1.5 * math.pi)
    # an ellipse's, by Ramanujan's second formula (to 1e-9 here); its parallel curve is shorter by 2 pi a
    h = (0.2 / 1.8) ** 2
    ramanujan = math.pi * 1.8 * (1 + 3 * h / (10 + math.sqrt(4 - 3 * h)))
    assert billiards.ellipse(1.0, 0.8).wall().lengths.sum() == pytest.approx(ramanujan, rel=1e-9)
    assert billiards.ellipse(1.0, 0.8, bounds="surface").shape(0.1).lengths.sum() == pytest.approx(
        ramanujan - 0.2 * math.pi
    )
    # round a reflex right angle the centre of a ball goes a quarter of a circle
    assert billiards.polygon(L_SHAPE, bounds="surface").shape(0.1).lengths.sum() == pytest.approx(
        8 - 10 * 0.1 + math.pi * 0.1 / 2
    )


def test_wedge_of_a_surface_is_a_wedge_of_the_centre():
    inner = billiards.wedge(45, bounds="surface")
    found = billiards.orbit(inner, ((1.5, 0.0), (0.0, 1.0), -2.0), 20, ball=carom.Disc(0.2, 1.0))
    shift = np.array([0.2 / math.sin(math.radians(22.5)), 0.0])
    moved = billiards.orbit(
        billiards.wedge(45), (np.array([1.5, 0.0]) - shift, (0.0, 1.0), -2.0), 20, ball=carom.Disc(0.2, 1.0)
    )
    np.testing.assert_allclose(found.position, moved.position + shift, atol=1e-12)


BAD = {
    "circle: radius": lambda: billiards.circle(0),
    "circle: bounds: expected 'centre' or 'surface'": lambda: billiards.circle(bounds="center"),
    "did you mean 'centre'": lambda: billiards.circle(bounds="center"),
    "wedge: angle": lambda: billiards.wedge(200),
    "regular: sides": lambda: billiards.regular(2),
    "sides that do not cross": lambda: billiards.polygon([(0, 0), (2, 2), (2, 0), (0, 1)]),
    "3 or more points": lambda: billiards.polygon([(0, 0), (1, 1)]),
    "one that fits in the ellipse": lambda: billiards.orbit(
        billiards.ellipse(1, 0.3, bounds="surface"), ((0, 0), (1, 0), 0), 3, ball=carom.Disc(0.3)
    ),
    "one that fits in the circle": lambda: billiards.orbit(
        billiards.circle(bounds="surface"), ((0, 0), (1, 0), 0), 3, ball=carom.Disc(2.0)
    ),
    "a centre inside stadium": lambda: billiards.orbit(billiards.stadium(), ((5, 0), (1, 0), 0), 3),
    "2.1 outside": lambda: billiards.orbit(billiards.circle(bounds="surface"), ((3, 0), (1, 0), 0), 3),
    "a moving ball": lambda: billiards.orbit(billiards.stadium(), ((0, 0), (0, 0), 1), 3),
    "whose squares are finite": lambda: billiards.orbit(billiards.stadium(), ((0, 0), (1e200, 0), 1), 3),
    "bounces: expected a whole number": lambda: billiards.orbit(billiards.stadium(), ((0, 0), (0, 1), 1), 0),
    "law: expected one of": lambda: billiards.orbit(billiards.stadium(), ((0, 0), (0, 1), 1), 5, law="noslip"),
    "surface: expected a carom.Surface, which the contact law needs": lambda: billiards.orbit(
        billiards.stadium(), ((0, 0), (0, 1), 1), 5, law="contact"
    ),
    "vectors (..., 2)": lambda: billiards.orbit(billiards.stadium(), ((0, 0, 0), (0, 1), 1), 5),
    "a horizontal table": lambda: billiards.orbit(
        billiards.sphere(), ((0, 0, 0), (0, 1, 0), (0, 0, 0)), 5, law="rolling"
    ),
    "kappa <= 2/3": lambda: billiards.orbit(
        billiards.circle(), ((0, 0), (0, 1), 0), 5, law="rolling", ball=carom.Disc(inertia=1.0)
    ),
    "lies in space": lambda: billiards.orbit(
        billiards.sphere(), ((0, 0, 0), (0, 1, 0), (0, 0, 0)), 5, ball=carom.Disc()
    ),
    "billiards.final keeps none": lambda: billiards.orbit(billiards.circle(), ((0, 0), (0, 1), 0), 10**9),
    "expected a table": lambda: billiards.orbit("circle", ((0, 0), (0, 1), 0), 5),
    "centres within the cell": lambda: billiards.torus((1, 1), ((2, 0, 0.1),)),
    "brings back every ball, got a wedge, whose walls": lambda: billiards.starts(billiards.wedge(60), 5),
    "whose walls are infinite": lambda: billiards.starts(billiards.under(billiards.wedge(115), (-0.2, -1.0)), 5),
    "with which a ball reaches a wall": lambda: billiards.starts(
        billiards.under(billiards.wedge(60, bounds="surface"), (-1.0, 0.0)), 5, speed=0.1
    ),
    "a closed one": lambda: billiards.uniformity(billiards.strip(), 100),
    "a reversible one": lambda: billiards.reverse(
        billiards.orbit(billiards.circle(), ((0, 0), (0, 1), 0), 5, law="contact", surface=carom.Surface(0.5))
    ),
}


@pytest.mark.parametrize("words", BAD)
def test_bad_input(words):
    with pytest.raises(carom.CaromError) as caught:
        BAD[words]()
    assert words in str(caught.value)
    assert all(len(fault.splitlines()) == 1 for fault in caught.value.faults)


def test_a_ball_that_just_fits_between_the_walls_of_a_strip():
    """Up to half the width there is room for it; from there on there is none."""
    strip, ball = billiards.strip(1.0, bounds="surface"), carom.Ball(radius=0.499, mass=1.0)
    orbit = billiards.orbit(strip, ((0.0, 0.0), (0.3, 1.0), 0.0), 3, ball=ball)
    np.testing.assert_allclose(np.abs(orbit.position[..., 1]), 0.001, rtol=1e-9)
    with pytest.raises(carom.CaromError, match=r"expected one that fits between the walls, got 0\.5;"):
        billiards.orbit(strip, ((0.0, 0.0), (0.3, 1.0), 0.0), 3, ball=carom.Ball(radius=0.5, mass=1.0))


def test_a_ball_on_a_circle_that_flies_along_its_tangent_never_meets_it_again():
    assert circle_exit(0.0, 1.0, 1.0, 0.0, 1.0) == math.inf
    assert circle_exit(-1.0, 0.0, 1.0, 0.0, 1.0) == 2.0


def test_the_slowest_ball_that_is_followed():
    assert billiards.orbit(billiards.circle(), ((0.0, 0.0), (0.0, 1e-100), 0.0), 2).velocity[-1, 1] != 0
    with pytest.raises(carom.CaromError, match="speeds and spins from 1e-100"):
        billiards.orbit(billiards.circle(), ((0.0, 0.0), (0.0, 0.99e-100), 0.0), 2)


def test_a_ball_that_settles_on_an_arc_ends_where_rounding_would_go_on():
    dissipative = carom.Surface(0.9, math.inf, 0.9)
    found = billiards.orbit(
        billiards.circle(), ((0.3, 0.2), (0.8, 0.5), 0.4), bounces=3000, law="contact", surface=dissipative
    )
    count = int(found.count)
    assert found.ended == "grazed"
    assert 100 < count < 3000
    across = found.across[: count - 60]  # (the last ones are near the rounding of the normal)
    np.testing.assert_allclose(across[1:] / across[:-1], 0.9, rtol=1e-3)
    assert found.across[count - 1] < 1e-15 * np.hypot(*found.velocity[count - 1])
    assert found.energy_drift < -0.1


def unchanged(v, w, n, a, kappa, e, mu, beta):
    return v, w


def tripled(v, w, n, a, kappa, e, mu, beta):
    u = v[0] * n[0] + v[1] * n[1] + v[2] * n[2]
    return (v[0] - 2 * u * n[0], v[1] - 2 * u * n[1], v[2] - 2 * u * n[2]), (3 * w[0], 3 * w[1], 3 * w[2])


@pytest.mark.parametrize(
    ("law", "table", "note"),
    [
        (unchanged, billiards.strip(), "leaves the ball moving into the wall: first at bounce 1, with the velocity (1, 0.1) m/s"),
        (unchanged, billiards.sinai(), "leaves the ball moving into the wall: first at bounce 1, with the velocity (1, 0.1) m/s"),
        (tripled, billiards.circle(), "creates energy: first at bounce 1, 2 J"),
    ],
)  # fmt: skip
def test_a_custom_law_that_is_wrong_is_noted_with_its_first_bounce(law, table, note, recwarn):
    found = billiards.orbit(table, ((0.35, 0.01), (1.0, 0.1), 1.0), 900, law=law)
    assert [one.partition(";")[0] for one in found.notes] == [f"law {law.__name__} {note}"]
    found.energy_drift  # noqa: B018
    assert not recwarn.list


def test_orbits_that_lose_energy_are_not_regular():
    start = billiards.starts(billiards.stadium(), 5, seed=1)
    surface = carom.Surface(1.0, math.inf, 0.9)
    found = billiards.orbit(billiards.stadium(), start, 300, law="contact", surface=surface)
    assert (found.energy_drift < -1e-3).all()
    assert not billiards.is_regular(found).any()
