"""A magnetic field: arcs met exactly, what they conserve, their tangent map, and orbits whose closed form is known."""

import json
import math

import numpy as np
import pytest
from reference.commands import command, fails
from reference.magnetic_bounces import bounces

import carom
from carom import CaromError, billiards
from carom.core.geometry.circles import angle_of_tangent

OVAL = {"shape": "curve", "r": lambda theta: 1 + 0.2 * np.cos(3 * theta)}
TABLES = {
    "circle": billiards.circle(), "ellipse": billiards.ellipse(1.0, 0.8),
    "inset ellipse": billiards.ellipse(1.0, 0.8, bounds="surface"), "triangle": billiards.regular(3),
    "stadium": billiards.stadium(), "curve": billiards.table(OVAL), "sinai": billiards.sinai(0.3),
}  # fmt: skip
DISC = carom.Disc(0.3, 1.0)


def in_field(table, field):
    return billiards.in_magnetic_field(table, field)


@pytest.mark.parametrize(
    ("name", "field", "law"),
    [
        ("circle", -1.7, "mirror"), ("ellipse", 1.7, "no-slip"), ("inset ellipse", -1.7, "no-slip"),
        ("inset ellipse", 0.3, "mirror"), ("triangle", 1.3, "no-slip"), ("stadium", -0.9, "mirror"), ("stadium", 0.3, "no-slip"),
        ("curve", -1.7, "no-slip"), ("curve", 0.3, "mirror"), ("sinai", 4.0, "mirror"), ("sinai", -1.7, "no-slip"),
    ],
)  # fmt: skip
def test_bounces_are_those_of_small_steps(name, field, law):
    """Six bounces with position, velocity and spin, to 1e-10 beside SciPy's integration of the equation of motion."""
    x, y, u, v, w = (0.4, 0.1, 0.3, 0.7, 0.5) if name == "sinai" else (0.1, 0.05, 0.8, 0.45, 0.3)
    found = billiards.orbit(in_field(TABLES[name], field), ((x, y), (u, v), w / 0.3), 6, ball=DISC, law=law)
    assert found.count == 6
    got = np.column_stack([found.t, found.position, found.velocity, found.spin * 0.3])
    np.testing.assert_allclose(got, bounces(name, (x, y, u, v, w), field, 6, 0.5, law), atol=1e-10)


@pytest.mark.parametrize(("field", "bound"), [(1e-3, 5e-12), (0.3, 1e-12), (-1.1, 1e-12), (1.9, 1e-12)])
def test_circle_keeps_the_angular_momentum(field, bound):
    """x cross v - field x^2/2 stays over 10^4 bounces to 1e-12, and skips advance by the angle of the triangle of the centres."""
    table = in_field(billiards.circle(), field)
    start = billiards.starts(table, 20, 1, law="mirror", spins=False)
    found = billiards.orbit(table, start, 10_000, law="mirror")
    assert (found.count == 10_000).all()
    x, v = found.position, found.velocity
    kept = x[..., 0] * v[..., 1] - x[..., 1] * v[..., 0] - field * (x * x).sum(-1) / 2
    assert np.abs(kept - kept[:, :1]).max() < bound
    # the arc's centre lies at x + J v/field, at a distance d from the table's
    d = np.hypot(x[..., 0] - v[..., 1] / field, x[..., 1] + v[..., 0] / field)
    half = np.arccos(np.clip((1 + d * d - 1 / field**2) / (2 * d), -1, 1))
    turned = np.abs(np.diff(np.unwrap(np.arctan2(x[..., 1], x[..., 0]), axis=-1), axis=-1))
    assert np.abs(np.cos(turned) - np.cos(2 * half[:, :-1])).max() < (1e-9 if abs(field) > 0.1 else 1e-6)


@pytest.mark.parametrize("law", ["mirror", "no-slip", "rolling"])
@pytest.mark.parametrize("name", TABLES)
def test_tangent_map(name, law):
    """Three bounces keep the measure |v.n| ds dv dspin to rounding, and each column is that of central differences."""
    table, ball = in_field(TABLES[name], 1.3), carom.Disc(0.2, 1.0)
    start = billiards.starts(table, 6, 5, ball=ball, law=law)
    base = billiards.orbit(table, start, 4, ball=ball, law=law)
    k = int(np.argmax(base.across.min(1)))  # far from grazes
    assert base.count[k] == 4
    state = (start.position[k], start.velocity[k], start.spin[k])
    found = billiards.tangent_map(table, state, 3, ball=ball, law=law)
    assert abs(abs(np.linalg.det(found.matrix)) * found.across[1] / found.across[0] - 1) < 1e-11
    x, v, w, n = base.folded[k, 0], base.velocity[k, 0], base.spin[k, 0], base.normal[k, [0, 3]]
    t, size, h = np.stack([n[:, 1], -n[:, 0]], axis=1), math.sqrt(0.5) * 0.2, 1e-6
    for column, (dx, dv, dw) in enumerate([(t[0], 0, 0), (0, t[0], 0), (0, n[0], 0), (0, 0, 1 / size)]):
        sides = (np.array([[1.0], [-1.0]]) * h * part for part in (dx, dv))
        run = billiards.orbit(
            table, (x + next(sides), v + next(sides), w + np.array([h, -h]) * dw), 3, ball=ball, law=law
        )
        y, u, q = (part[0, -1] - part[1, -1] for part in (run.folded, run.velocity, run.spin))
        slope = np.array([t[1] @ y, t[1] @ u, n[1] @ u, size * q]) / (2 * h)
        assert np.abs(found.matrix[:, column] - slope).max() < 1e-8 * (1 + np.abs(found.matrix).max()) ** 3


def test_orbit_of_two_arcs_along_the_axes_of_an_ellipse():
    """Their traces are those of two arcs and two mirrors of curvature k (Robnik & Berry 1985; Berglund & Kunz 1996)."""
    p, q = 1.3, 1.0
    for field in (0.2, 0.5, 0.7):
        for along, across, at in ((p, q, (1.0, 0.0)), (q, p, (0.0, 1.0))):
            radius, k = 1 / field, along / across**2
            turn = math.asin(along / radius)  # from the chord, which is along the normals
            c, s = math.cos(2 * turn), math.sin(2 * turn)
            arc = np.array([[c, radius * s], [-s / radius, c]])
            mirror = np.array([[-1.0, 0.0], [2 * k / math.cos(turn) - 2 * math.tan(turn) / radius, -1.0]])
            half = mirror @ arc
            n = np.array(at)
            v = -math.cos(turn) * n + math.sin(turn) * np.array([-n[1], n[0]])
            one = billiards.refine_orbit(
                in_field(billiards.ellipse(p, q), field), (0.999 * along * n, v, 0.0), 2, law="mirror"
            )
            assert one.trace == pytest.approx(np.trace(half @ half), abs=1e-9)
            assert one.duration == pytest.approx(4 * turn / field, abs=1e-11)


@pytest.mark.slow
def test_stars_of_arcs_and_continuation_in_the_field():
    """Stars of arcs have closed forms, and winding one way differs from the other; a branch leads through zero field."""
    field = 0.6
    found = billiards.periodic_orbits(in_field(billiards.circle(), field), 3, law="mirror", starts=60)
    turn = math.asin(field * math.sin(math.pi / 3))
    expected = sorted([6 * turn / field, 6 * turn / field])
    assert [one.winding for one in found] in ([1, 2], [2, 1])
    np.testing.assert_allclose([one.duration for one in found], expected, rtol=1e-12)
    assert all(one.stability == "parabolic" and one.family == 1 for one in found)
    oval = billiards.ellipse(1.3, 1.0)
    one = billiards.refine_orbit(in_field(oval, -0.5), ((0.0, 0.999), (0.5, -math.sqrt(0.75)), 0.0), 2, law="mirror")
    branch = billiards.continue_orbit(one, lambda value: {"table": in_field(oval, value)}, -0.5, 0.5)
    assert branch.ended == "range"
    np.testing.assert_allclose(
        branch.duration, [4 * math.asin(b) / b if b else 4.0 for b in branch.parameter], rtol=1e-10
    )


def test_ellipse_is_integrable_without_a_field_only():
    """Near its long axis orbits are chaotic in a field: Robnik & Berry 1985."""
    start = ((0.0, 0.02), (1.0, 0.05), 0.0)
    spectra = [
        billiards.lyapunov(in_field(billiards.ellipse(1.5, 1.0), field), start, 4000, law="mirror")
        for field in (0.0, 0.4)
    ]
    assert spectra[0].per_bounce[0] < 0.02
    assert spectra[1].per_bounce[0] > 0.1


@pytest.mark.parametrize("field", [1e-6, 0.7, -1.4])
def test_circle_has_two_caustics(field):
    """By a rough wall, too: each flight leaves the wall at the angle at which it met it, so that every second one is congruent."""
    table = in_field(billiards.circle(), field)
    found = billiards.orbit(table, ((0.2, 0.1), (0.8, 0.3), 0.5), 500)
    caustics = billiards.caustics(found)
    assert caustics.scatter.max() < 1e-11
    assert abs(caustics.radii[0] - caustics.radii[1]) > 1e-2
    path = (
        found.path(points=64)[64:].reshape(-1)[: 2 * 64 * 20].reshape(20, 64, 2)
    )  # the flights after the first bounce
    nearest = np.linalg.norm(path, axis=-1).min(1)
    assert np.abs(nearest - np.resize(caustics.radii, 20)).max() < 2e-3


def test_closed_circles_ways_back_and_pictures():
    """A circle that meets no wall is said; reversing orbits reverses the field; paths lie on their arcs."""
    table = in_field(billiards.circle(), 4.0)
    assert billiards.orbit(table, ((0.0, 0.0), (1.0, 0.0), 0.0), 5).ended == "free"
    lattice = in_field(billiards.torus((1.0, 1.0), ((0.0, 0.0, 0.1),)), 1 / 0.55)
    assert billiards.orbit(lattice, ((0.5, 0.55), (-1.0, 0.0), 0.0), 5).ended == "bounces"
    assert (
        billiards.orbit(in_field(billiards.sinai(0.1), 2.5), ((0.4, 0.1), (0.0, -1.0), 0.0), 5, law="mirror").ended
        == "free"
    )
    for name, law in (("stadium", "mirror"), ("curve", "no-slip")):
        found = billiards.orbit(in_field(TABLES[name], 0.7), ((0.1, 0.2), (0.8, 0.3), 0.4), 12, law=law)
        assert billiards.reverse(found)[1].max() < 1e-9
        path = found.path(points=7)
        centre = found.position[0] + np.array([-found.velocity[0, 1], found.velocity[0, 0]]) / 0.7
        radii = np.linalg.norm(path[7:15] - centre, axis=1)
        np.testing.assert_allclose(radii, np.linalg.norm(found.velocity[0]) / 0.7, rtol=1e-12)


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: in_field(billiards.sphere(), 1.0), "magnetic_field: expected a magnetic field in a table in the plane"),
        (lambda: in_field(billiards.under(billiards.circle(), (0.0, -1.0)), 1.0), "acceleration or a magnetic field"),
        (lambda: billiards.under(in_field(billiards.circle(), 1.0), (0.0, -1.0)), "acceleration or a magnetic field"),
        (lambda: in_field(billiards.circle(), math.nan), "magnetic_field: expected a number"),
        (lambda: billiards.cylinder(in_field(billiards.circle(), 1.0)), "a table without a magnetic field"),
        (lambda: billiards.section(billiards.orbit(in_field(billiards.circle(), 1.0), ((0.9, 0), (1, 0), 0), 4)), "field"),
        (lambda: billiards.mean_flight(in_field(billiards.circle(), 1.0)), "without a force"),
    ],
)  # fmt: skip
def test_refusals_are_one_line(make, said):
    with pytest.raises(CaromError) as caught:
        make()
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.slow
def test_command(capsys, tmp_path):
    plot = tmp_path / "arcs.svg"
    options = (
        "orbit",
        "circle",
        "--magnetic-field",
        "0.8",
        "--law",
        "mirror",
        "--bounces",
        "60",
        "--reverse",
        "--json",
    )
    code, printed, _said = command(capsys, *options, "--plot", str(plot))
    facts = json.loads(printed)
    assert (code, facts["table"]["magnetic_field"]) == (0, 0.8)
    assert facts["reversal_error"] < 1e-11
    assert plot.stat().st_size > 10_000
    (line,) = fails(capsys, "orbit", "sphere", "--magnetic-field", "1")
    assert "--magnetic-field: expected a magnetic field in a table in the plane only, got sphere" in line


@pytest.mark.parametrize("name", ["ellipse", "curve"])
def test_weak_fields_bend_nothing(name):
    """Circles up to 10^60 times as large as the table miss no wall: their middles are rounded."""
    start = billiards.starts(TABLES[name], 300, 3, law="mirror")
    straight = billiards.orbit(TABLES[name], start, 3, law="mirror")
    for field in (1e-13, 0.1 + 0.2 - 0.3, -1e-30, 1e-60):
        found = billiards.orbit(in_field(TABLES[name], field), start, 3, law="mirror")
        assert (found.count == straight.count).all()
        np.testing.assert_allclose(found.t[:, 0], straight.t[:, 0], rtol=0, atol=1e-13 + 100 * abs(field))


def test_angle_of_a_tangent():
    x = np.append(np.random.default_rng(1).uniform(0, 1, 300), [0.0, 1e-300, 0.4375, 0.6875, 1.0])
    found = np.array([angle_of_tangent(float(one)) for one in x])
    assert (np.abs(found - np.arctan(x)) <= np.spacing(np.arctan(x))).all()
