"""One ball in a table: what it meets, what it keeps, that it comes back, and the law's bits."""

import math

import numpy as np
import pytest
from hypothesis import given
from identities import directions, inertias, vectors

import carom
from carom import orbits
from carom.kernel import dot
from carom.laws.no_slip import no_slip_bounce, no_slip_reflection
from carom.orbits.arrays import ENDS
from carom.orbits.loop import follow
from carom.orbits.oval import quadrature
from carom.orbits.setup import prepare, setup_of

L_SHAPE = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
SPIKES = [(0, 0), (1, 0.4), (2, 0), (1.5, 1), (2, 2), (1, 1.6), (0, 2), (0.5, 1)]
PLANE = {
    "circle": orbits.circle,
    "ellipse": orbits.ellipse,
    "tall ellipse": lambda **o: orbits.ellipse(0.7, 1.1, **o),
    # (for the balls of these tests wide: they do not come to the ends)
    "narrow ellipse": lambda **o: orbits.ellipse(1.1, 0.25, **o),
    "tall narrow ellipse": lambda **o: orbits.ellipse(0.25, 1.1, **o),
    "triangle": lambda **o: orbits.regular(3, **o),
    "seven": lambda **o: orbits.regular(7, **o),
    "rectangle": orbits.rectangle,
    "stadium": orbits.stadium,
    "L": lambda **o: orbits.polygon(L_SHAPE, **o),
    "star": lambda **o: orbits.polygon(SPIKES, **o),
    "sinai": orbits.sinai,
    "torus": lambda **o: orbits.torus((1.0, 1.4), ((0.45, 0.1, 0.25), (-0.2, -0.6, 0.2)), **o),
    "periodic strip": orbits.periodic_strip,
}
SPACE = {
    "sphere": orbits.sphere,
    "box": lambda **o: orbits.box((1.0, 1.4, 2.0), **o),
    "cylinder": lambda **o: orbits.cylinder(orbits.circle(**o), 2.0),
    "stadium cylinder": lambda **o: orbits.cylinder(orbits.stadium(1.0, 0.6, **o), 2.0),
}
BOTH = ("centre", "surface")


def tables():
    return [pytest.param(make(bounds=b), id=f"{name}-{b}") for name, make in (PLANE | SPACE).items() for b in BOTH]


# --- by brute force: small steps, and distances that know nothing of pieces -----------------------------------------------


def segments(vertices, x):
    p = np.asarray(vertices, float)
    q = np.roll(p, -1, axis=0)
    e = q - p
    u = np.clip(((x[:, None] - p) * e).sum(-1) / (e * e).sum(-1), 0, 1)
    distance = np.linalg.norm(x[:, None] - p - u[..., None] * e, axis=-1).min(-1)
    turns = np.zeros(len(x))
    for a, b in zip(p, q, strict=True):
        d, f = a - x, b - x
        turns += np.arctan2(d[:, 0] * f[:, 1] - d[:, 1] * f[:, 0], (d * f).sum(-1))
    return np.where(np.abs(turns) > math.pi, distance, -distance)


def ellipse_distance(p, q, x):
    u, width = np.broadcast_to(np.linspace(0, math.tau, 300, endpoint=False), (len(x), 300)), math.tau / 300
    for _ in range(7):
        away = (p * np.cos(u) - x[:, :1]) ** 2 + (q * np.sin(u) - x[:, 1:]) ** 2
        best = u[np.arange(len(x)), np.argmin(away, axis=1)]
        u, width = best[:, None] + np.linspace(-width, width, 31), width / 14
    distance = np.hypot(p * np.cos(best) - x[:, 0], q * np.sin(best) - x[:, 1])
    return np.where((x[:, 0] / p) ** 2 + (x[:, 1] / q) ** 2 < 1, distance, -distance)


def lattice(x, scatterers, cell):
    found = np.full(len(x), math.inf)
    for cx, cy, r in scatterers:
        d = x - (cx, cy)
        for k, side in enumerate(cell):
            if side:
                d[:, k] -= side * np.round(d[:, k] / side)
        found = np.minimum(found, np.hypot(d[:, 0], d[:, 1]) - r)
    return found


def stadium_distance(x):
    return 1.0 - np.hypot(np.maximum(np.abs(x[:, 0]) - 1.0, 0), x[:, 1])


CLEARANCE = {
    "circle": lambda x: 1 - np.hypot(x[:, 0], x[:, 1]),
    "ellipse": lambda x: ellipse_distance(1.0, 0.8, x),
    "tall ellipse": lambda x: ellipse_distance(0.7, 1.1, x),
    "narrow ellipse": lambda x: ellipse_distance(1.1, 0.25, x),
    "tall narrow ellipse": lambda x: ellipse_distance(0.25, 1.1, x),
    "triangle": lambda x: segments([(math.cos(a), math.sin(a)) for a in np.radians([-150, -30, 90])], x),
    "rectangle": lambda x: segments([(-1, -0.5), (1, -0.5), (1, 0.5), (-1, 0.5)], x),
    "stadium": stadium_distance,
    "L": lambda x: segments(L_SHAPE, x),
    "star": lambda x: segments(SPIKES, x),
    "sinai": lambda x: lattice(x, [(0, 0, 0.3)], (1, 1)),
    "torus": lambda x: lattice(x, [(0.45, 0.1, 0.25), (-0.2, -0.6, 0.2)], (1.0, 1.4)),
    "periodic strip": lambda x: np.minimum(0.5 - np.abs(x[:, 1]), lattice(x, [(0, 0, 0.2)], (1, 0))),
}


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
    found = orbits.orbit(table, (x, v, 0.0), 1, ball=carom.Disc(0.07, 1.0), corners="pass")
    steps = np.arange(0, 15 if table.shape(0.0).cell else 4, 1e-3)
    for k in range(len(x)):
        path = x[k] + steps[:, None] * v[k]
        out = np.flatnonzero(clearance(path) < inset)
        if not len(out):  # a long way between scatterers
            assert table.name in ("sinai", "torus", "periodic strip")
            assert not found.t[k, 0] < steps[-1]
            continue
        low, high = steps[out[0] - 1], steps[out[0]]
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
    begin = orbits.starts(table, 60, 7)
    found = orbits.orbit(table, begin, 500, corners="pass")
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
    begin = orbits.starts(table, 200, 8)
    found = orbits.orbit(table, begin, 20, corners="pass")
    back, error = orbits.reverse(found)
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
    "table", [orbits.circle(), orbits.regular(5), orbits.sinai(), orbits.ellipse(bounds="surface")]
)
def test_compiled_as_python(table):
    """The loop as Python gives the compiled loop's bits."""
    begin = orbits.starts(table, 1, 3)
    found = orbits.orbit(table, begin, 70, corners="pass")
    setup = setup_of(table, None, "no-slip", None, "pass")
    rows, _shape = prepare(setup, begin)
    kept, piece, last = np.full((70, 6), np.nan), np.zeros(70, np.int32), np.zeros(10)
    row = [float(r) for r in rows[0]]
    world, pieces = setup.world.view(np.recarray)[0], setup.pieces.view(np.recarray)
    ended, count = follow(world, pieces, tuple(row[:3]), tuple(row[3:6]), tuple(row[6:]), 70, kept, piece, last)
    assert (ended, count) == (0, 70)
    np.testing.assert_array_equal(kept[:, 0], found.t[0])
    np.testing.assert_array_equal(kept[:, 1:3], found.position[0])
    np.testing.assert_array_equal(kept[:, 5], found.spin[0])
    np.testing.assert_array_equal(last, found.last[0])


def test_threads_do_not_matter():
    import numba

    begin = orbits.starts(orbits.stadium(), 64, 5)
    many = orbits.orbit(orbits.stadium(), begin, 300)
    before = numba.get_num_threads()
    try:
        numba.set_num_threads(1)
        one = orbits.orbit(orbits.stadium(), begin, 300)
    finally:
        numba.set_num_threads(before)
    for a, b in ((many.position, one.position), (many.spin, one.spin), (many.t, one.t)):
        np.testing.assert_array_equal(a, b)
    # and each orbit is what it is alone
    alone = orbits.orbit(orbits.stadium(), (begin.position[7], begin.velocity[7], begin.spin[7]), 300)
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


@pytest.mark.parametrize("table", [orbits.stadium(), orbits.ellipse(bounds="surface"), orbits.sphere(), orbits.box()])
def test_laws_agree_where_they_are_the_same(table):
    begin = orbits.starts(table, 10, 2)
    one = orbits.orbit(table, begin, 40, corners="pass")
    two = orbits.orbit(table, begin, 40, law="contact", surface=carom.Surface(1, math.inf, 1), corners="pass")
    np.testing.assert_array_equal(one.position, two.position)

    def mine(v, w, n, a, kappa, e, mu, beta):
        un = v[0] * n[0] + v[1] * n[1] + v[2] * n[2]
        return (v[0] - 2 * un * n[0], v[1] - 2 * un * n[1], v[2] - 2 * un * n[2]), w

    own = orbits.orbit(table, begin, 40, law=mine, corners="pass")
    mirror = orbits.orbit(table, begin, 40, law="mirror", corners="pass")
    np.testing.assert_allclose(own.position[:, :10], mirror.position[:, :10], atol=1e-9)
    np.testing.assert_array_equal(mirror.spin[:, -1], begin.spin)


def test_every_bounce_is_the_verb_that_carom_has():
    """State after each bounce of an orbit in an ellipse, against carom.no_slip and carom.conventional at that normal."""
    table = orbits.ellipse(1.2, 0.9, bounds="surface")
    ball = carom.Ball(0.1, 1.0)
    for law, verb in (("no-slip", carom.no_slip), ("rolling", carom.conventional)):
        found = orbits.orbit(table, ((0.1, 0.2), (0.7, -0.5), 3.0), 30, ball=ball, law=law)
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
    found = orbits.orbit(orbits.stadium(), ((0.1, 0.0), (0.7, 0.4), 0.3), 200, law="contact", surface=soft)
    speed = found.speed[: found.count]
    assert (np.diff(speed) <= 1e-15).all()
    assert speed[-1] < 0.5 * speed[0]
    stuck = orbits.orbit(
        orbits.circle(), ((0.0, 0.0), (0.7, 0.4), 0.3), 5, law="contact", surface=carom.Surface(0.0, 0.1)
    )
    assert str(stuck.ended) == "grazed"
    assert stuck.count == 0


# --- ends -------------------------------------------------------------------------------------------------------------------


def test_corners():
    """A ball on its way into a corner ends there, or meets both sides."""
    square = orbits.rectangle(2.0, 2.0)
    found = orbits.orbit(square, ((0.0, 0.0), (1.0, 1.0), 0.0), 10)
    assert (str(found.ended), found.count) == ("corner", 0)
    assert np.isnan(found.t).all()
    through = orbits.orbit(square, ((0.0, 0.0), (1.0, 1.0), 0.0), 10, law="mirror", corners="pass")
    assert through.count == 10
    np.testing.assert_allclose(through.velocity[1], [-1, -1], atol=1e-12)
    # where two sides are one, or the centre goes round a vertex, there is no corner
    flat = orbits.polygon([(-1, -1), (0, -1), (1, -1), (1, 1), (-1, 1)])
    assert orbits.orbit(flat, ((0.0, 0.0), (0.0, -1.0), 0.0), 4, law="mirror").count == 4
    reentrant = orbits.polygon(L_SHAPE, bounds="surface")
    straight = orbits.orbit(reentrant, ((0.5, 0.5), (1.0, 1.0), 0.0), 2, law="mirror")
    assert straight.count >= 1
    np.testing.assert_allclose(straight.position[0], 1 - 0.1 / math.sqrt(2), atol=1e-12)
    assert str(orbits.orbit(orbits.polygon(L_SHAPE), ((0.5, 0.5), (1.0, 1.0), 0.0), 2).ended) == "corner"


def test_escapes_and_flies_free():
    assert str(orbits.orbit(orbits.wedge(0.5), ((1.0, 0.0), (1.0, 0.0), 0.0), 5).ended) == "escaped"
    assert str(orbits.orbit(orbits.sinai(0.2), ((0.0, 0.3), (1.0, 0.0), 0.0), 5).ended) == "free"
    assert {str(e) for e in ENDS} == {"bounces", "escaped", "corner", "grazed", "free"}


@pytest.mark.parametrize("slope", [1e-3, 1e-6, 1e-9, 1e-13])
def test_whispering(slope):
    """Nearly along the wall: chords as short as they should be, bounce after bounce, on the wall to the last digits."""
    tables = [(orbits.circle(), 1.0), (orbits.ellipse(1, 0.8), 1.0)]
    if slope > 1e-8:  # flatter flights along a parallel curve end as "grazed"
        tables.append((orbits.ellipse(1, 0.8, bounds="surface"), 0.9))
    for table, far in tables:
        found = orbits.orbit(table, ((far, 0.0), (-slope, 1.0), 0.0), 1000, law="mirror")
        assert found.count == 1000
        if table.bounds == "centre":
            x, y = found.position.T
            assert np.abs(x * x + (y / table.sizes.get("minor", 1.0)) ** 2 - 1).max() < 1e-13
        if table.name == "circle":  # (a root of the chord's square, but for the flattest)
            digits = 2e-15 / slope**2 if slope > 1e-4 else 1e-15 / slope
            np.testing.assert_allclose(np.diff(found.t), 2 * slope / (1 + slope**2), rtol=digits)
        else:  # adiabatic: the angle goes with the cube root of the curvature
            assert found.across.max() < 2 * slope
            assert found.across.min() > slope / 4


def test_no_orbits_at_all():
    found = orbits.orbit(orbits.circle(), (np.zeros((0, 2)), np.ones((0, 2)), 0.0), 10)
    assert found.t.shape == (0, 10)
    assert "0 orbits" in repr(found)


def test_final_keeps_nothing_and_says_the_same():
    begin = orbits.starts(orbits.sinai(), 20, 4)
    found = orbits.orbit(orbits.sinai(), begin, 500)
    state, t, count, ending = orbits.final(orbits.sinai(), begin, 500)
    np.testing.assert_array_equal(state.position, found.position[:, -1])
    np.testing.assert_array_equal(state.spin, found.spin[:, -1])
    np.testing.assert_array_equal(t, found.t[:, -1])
    assert (count == 500).all()
    assert (ending == 0).all()


def test_a_million_bounces_keep_their_energy():
    for table in (
        orbits.circle(),
        orbits.regular(5),
        orbits.cylinder(acceleration=-1.0),
        orbits.strip(acceleration=0.3),
    ):
        flat = table.dimension == 2
        begin = ((0.1, 0.2), (0.7, 0.4), 0.9) if flat else ((0.1, 0.2, 0.0), (0.7, 0.4, 0.1), (0.3, 0.2, 0.9))
        state, *_ = orbits.final(table, begin, 1_000_000)
        kappa = 0.5 if flat else 0.4
        energy = [
            (np.square(v).sum() + kappa * np.square(w).sum()) / 2 - np.dot(table.pull[: len(x)], x)
            for x, v, w in (begin, (state.position, state.velocity, state.spin))
        ]
        scale = abs(energy[0]) + np.square(state.velocity).sum()
        assert abs(energy[1] - energy[0]) < 1e-12 * scale


# --- shapes -----------------------------------------------------------------------------------------------------------------


def test_lengths():
    assert orbits.circle(2.0).wall().lengths.sum() == pytest.approx(4 * math.pi)
    assert orbits.stadium(2.0, 1.0, bounds="surface").shape(0.25).lengths.sum() == pytest.approx(4 + 1.5 * math.pi)
    # an ellipse's, by Ramanujan's second formula (to 1e-9 here); its parallel curve is shorter by 2 pi a
    h = (0.2 / 1.8) ** 2
    ramanujan = math.pi * 1.8 * (1 + 3 * h / (10 + math.sqrt(4 - 3 * h)))
    assert 4 * quadrature(1.0, 0.8, math.pi / 2) == pytest.approx(ramanujan, rel=1e-9)
    assert orbits.ellipse(1.0, 0.8, bounds="surface").shape(0.1).lengths.sum() == pytest.approx(
        ramanujan - 0.2 * math.pi
    )
    # round a reflex right angle the centre of a ball goes a quarter of a circle
    assert orbits.polygon(L_SHAPE, bounds="surface").shape(0.1).lengths.sum() == pytest.approx(
        8 - 10 * 0.1 + math.pi * 0.1 / 2
    )


def test_wedge_of_a_surface_is_a_wedge_of_the_centre():
    inner = orbits.wedge(0.8, bounds="surface")
    found = orbits.orbit(inner, ((1.5, 0.0), (0.0, 1.0), -2.0), 20, ball=carom.Disc(0.2, 1.0))
    shift = np.array([0.2 / math.sin(0.4), 0.0])
    moved = orbits.orbit(
        orbits.wedge(0.8), (np.array([1.5, 0.0]) - shift, (0.0, 1.0), -2.0), 20, ball=carom.Disc(0.2, 1.0)
    )
    np.testing.assert_allclose(found.position, moved.position + shift, atol=1e-12)


BAD = {
    "circle: radius": lambda: orbits.circle(0),
    "circle: bounds: expected 'centre' or 'surface'": lambda: orbits.circle(bounds="center"),
    "did you mean 'centre'": lambda: orbits.circle(bounds="center"),
    "wedge: angle": lambda: orbits.wedge(4.0),
    "polygon: sides": lambda: orbits.regular(2),
    "sides that do not cross": lambda: orbits.polygon([(0, 0), (2, 2), (2, 0), (0, 1)]),
    "three or more points": lambda: orbits.polygon([(0, 0), (1, 1)]),
    "room in the ellipse": lambda: orbits.orbit(
        orbits.ellipse(1, 0.3, bounds="surface"), ((0, 0), (1, 0), 0), 3, ball=carom.Disc(0.3)
    ),
    "room in the circle": lambda: orbits.orbit(
        orbits.circle(bounds="surface"), ((0, 0), (1, 0), 0), 3, ball=carom.Disc(2.0)
    ),
    "a centre within the table": lambda: orbits.orbit(orbits.stadium(), ((5, 0), (1, 0), 0), 3),
    "2.1 outside": lambda: orbits.orbit(orbits.circle(bounds="surface"), ((3, 0), (1, 0), 0), 3),
    "a ball that moves": lambda: orbits.orbit(orbits.stadium(), ((0, 0), (0, 0), 1), 3),
    "squares are numbers": lambda: orbits.orbit(orbits.stadium(), ((0, 0), (1e200, 0), 1), 3),
    "bounces: expected a whole number": lambda: orbits.orbit(orbits.stadium(), ((0, 0), (0, 1), 1), 0),
    "law: expected one of": lambda: orbits.orbit(orbits.stadium(), ((0, 0), (0, 1), 1), 5, law="noslip"),
    "surface: expected a carom.Surface, for the contact law": lambda: orbits.orbit(
        orbits.stadium(), ((0, 0), (0, 1), 1), 5, law="contact"
    ),
    "vectors (..., 2)": lambda: orbits.orbit(orbits.stadium(), ((0, 0, 0), (0, 1), 1), 5),
    "level table": lambda: orbits.orbit(orbits.sphere(), ((0, 0, 0), (0, 1, 0), (0, 0, 0)), 5, law="rolling"),
    "kappa <= 2/3": lambda: orbits.orbit(
        orbits.circle(), ((0, 0), (0, 1), 0), 5, law="rolling", ball=carom.Disc(inertia=1.0)
    ),
    "lies in space": lambda: orbits.orbit(orbits.sphere(), ((0, 0, 0), (0, 1, 0), (0, 0, 0)), 5, ball=carom.Disc()),
    "which are kept": lambda: orbits.orbit(orbits.circle(), ((0, 0), (0, 1), 0), 10**9),
    "expected a table": lambda: orbits.orbit("circle", ((0, 0), (0, 1), 0), 5),
    "centres within the cell": lambda: orbits.torus((1, 1), ((2, 0, 0.1),)),
    "brings back every ball, got wedge (angle 1.0; bounds the centre)": lambda: orbits.starts(orbits.wedge(1.0), 5),
    "along a wall they go out for ever": lambda: orbits.starts(orbits.under(orbits.wedge(2.0), (-0.2, -1.0)), 5),
    "with which a ball gets to a wall": lambda: orbits.starts(
        orbits.under(orbits.wedge(1.0, bounds="surface"), (-1.0, 0.0)), 5, speed=0.1
    ),
    "one whose wall has an end": lambda: orbits.uniformity(orbits.strip(), 100),
    "undoes itself": lambda: orbits.reverse(
        orbits.orbit(orbits.circle(), ((0, 0), (0, 1), 0), 5, law="contact", surface=carom.Surface(0.5))
    ),
}


@pytest.mark.parametrize("words", BAD)
def test_bad_input(words):
    with pytest.raises(carom.CaromError) as caught:
        BAD[words]()
    assert words in str(caught.value)
    assert all(len(fault.splitlines()) == 1 for fault in caught.value.faults)
