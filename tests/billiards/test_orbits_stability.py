"""The exact tangent map against differences, the spectrum against what is known, and what one asks of orbits."""

import math

import numpy as np
import pytest

import carom
from carom import billiards

ROUGH = carom.Surface(0.9, math.inf, 0.3)
SLIDES = carom.Surface(0.9, 0.1, 0.3)
TABLES = {
    "circle": billiards.circle(),
    "ellipse": billiards.ellipse(),
    "ellipse-surface": billiards.ellipse(bounds="surface"),
    "narrow ellipse": billiards.ellipse(1.2, 0.3, bounds="surface"),
    "triangle": billiards.regular(3),
    "stadium": billiards.stadium(),
    "sinai": billiards.sinai(),
    "strip": billiards.strip(acceleration=0.7),
    "L": billiards.polygon([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)], bounds="surface"),
    "sphere": billiards.sphere(),
    "box": billiards.box(),
    "cylinder": billiards.cylinder(billiards.ellipse(bounds="surface"), acceleration=-1.3),
    "narrow cylinder": billiards.cylinder(billiards.ellipse(0.6, 2.0, bounds="surface"), acceleration=-1.3),
    "plates": billiards.plates(acceleration=(0.3, -0.8)),
    # a force across the walls
    "circle, falling": billiards.under(billiards.circle(), (0.3, -1.0)),
    "ellipse-surface, falling": billiards.under(billiards.ellipse(bounds="surface"), (0.3, -1.0)),
    "narrow ellipse, falling": billiards.under(billiards.ellipse(1.2, 0.3, bounds="surface"), (0.3, -1.0)),
    "L, falling": billiards.under(
        billiards.polygon([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)], bounds="surface"), (-0.3, -1.0)
    ),
    "stadium, falling": billiards.under(billiards.stadium(), (0.3, -1.0)),
    "sinai, falling": billiards.under(billiards.sinai(), (0.3, -0.2)),
    "wedge, falling": billiards.under(billiards.wedge(140), (-1.0, 0.1)),
    "sphere, falling": billiards.under(billiards.sphere(), (0.3, 0.2, -1.0)),
    "cylinder with lids, falling": billiards.cylinder(
        billiards.under(billiards.ellipse(), (0.2, -0.5)), 2.0, acceleration=-1.0
    ),
}


def springy(v, w, n, a, kappa, e, mu, beta):
    """A custom law: a wall gives back less of a fast slip."""
    un = v[0] * n[0] + v[1] * n[1] + v[2] * n[2]
    s = (w[1] * n[2] - w[2] * n[1], w[2] * n[0] - w[0] * n[2], w[0] * n[1] - w[1] * n[0])
    x, y, z = v[0] - un * n[0] - a * s[0], v[1] - un * n[1] - a * s[1], v[2] - un * n[2] - a * s[2]
    c = -(1.0 + 0.9 / (1.0 + math.sqrt(x * x + y * y + z * z))) * kappa / (1.0 + kappa)
    p, q, r, b = c * x, c * y, c * z, 1.0 / (kappa * a)
    v = (v[0] - 1.9 * un * n[0] + p, v[1] - 1.9 * un * n[1] + q, v[2] - 1.9 * un * n[2] + r)
    return v, (w[0] - (n[1] * r - n[2] * q) * b, w[1] - (n[2] * p - n[0] * r) * b, w[2] - (n[0] * q - n[1] * p) * b)


def turned(v, w, n, a, kappa, e, mu, beta):
    """A custom law, which is the no-slip law of discs: slip and spin are mirrored at a line between their axes."""
    c, s, q = (1 - kappa) / (1 + kappa), 2 * math.sqrt(kappa) / (1 + kappa), math.sqrt(kappa) * a
    un, ut = v[0] * n[0] + v[1] * n[1], v[0] * n[1] - v[1] * n[0]
    ut, spin = c * ut - s * q * w[2], -s * ut - c * q * w[2]
    return (-un * n[0] + ut * n[1], -un * n[1] - ut * n[0], v[2]), (w[0], w[1], spin / q)


LAWS = {"no-slip": {}, "mirror": {"law": "mirror"}, "rough": {"law": "contact", "surface": ROUGH},
        "slides": {"law": "contact", "surface": SLIDES}, "rolling": {"law": "rolling"}, "custom": {"law": springy}}  # fmt: skip


def begin(table):
    d = table.dimension
    return (
        (0.31, 0.12 if table.sizes.get("half_axes", [0, 0])[1] == 0.3 else 0.42, 0.1)[:d],
        (0.8, 0.5, 0.3)[:d],
        0.7 if d == 2 else (0.4, -0.3, 0.7),
    )


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("name", TABLES)
@pytest.mark.slow(keep=5)
def test_tangent_map_against_differences(name, law):
    """Every column of the tangent map of three bounces is what a small displacement becomes, to the displacement's square."""
    table, options = TABLES[name], dict(LAWS[law])
    planar = table.dimension == 2
    radius = 0.1 if table.bounds == "surface" else 1.0
    options["ball"] = carom.Ball(radius, 1.0)
    if law == "rolling" and (not planar or any(table.acceleration)):
        pytest.skip("the rolling reflection has a level floor")
    bounces = 3
    found = billiards.tangent_map(table, begin(table), bounces, **options)
    base = billiards.orbit(table, begin(table), bounces + 1, **options)
    assert base.count == bounces + 1
    flat = base.folded
    kappa = options["ball"].kappa
    size = math.sqrt(kappa) * radius

    def frame(k):
        n = np.append(base.normal[k], 0.0) if planar else base.normal[k]
        t = np.array([n[1], -n[0], 0.0]) if math.hypot(*n[:2]) > 1e-9 else np.array([1.0, 0.0, 0.0])
        t = t / np.linalg.norm(t)
        return t, np.cross(n, t), n

    t0, b0, n0 = frame(0)
    t1, b1, n1 = frame(bounces)

    def space(x, v, w):
        return (np.append(x, 0.0), np.append(v, 0.0), np.array([0, 0, w])) if planar else (x, v, w)

    def coordinates(x, v, w):
        full = {"s": t1 @ x, "b": b1 @ x, "v_t": t1 @ v, "v_b": b1 @ v, "v_n": n1 @ v, "spin": size * w[2]}
        return full | {"spin_t": size * (t1 @ w), "spin_b": size * (b1 @ w), "spin_n": size * (n1 @ w)}

    x0, v0, w0 = space(flat[0], base.velocity[0], base.spin[0])
    h = 1e-6
    for column, name_ in enumerate(found.coordinates):
        e = {"s": t0, "b": b0, "t": t0, "n": n0}[name_[-1]] if name_ != "spin" else np.array([0, 0, 1.0])
        rows = []
        for step in (h, -h):
            # (beside the wall by h^2 where it is curved, the same on both sides)
            x, v, w = x0.copy(), v0.copy(), w0.copy()
            if name_ in ("s", "b"):
                x += step * e
            elif name_.startswith("v"):
                v += step * e
            else:
                w += step / size * e
            run = billiards.orbit(table, (x[:2], v[:2], w[2]) if planar else (x, v, w), bounces, **options)
            after = coordinates(*space(run.folded[-1] - flat[-1], run.velocity[-1], run.spin[-1]))
            rows.append([after[key] for key in found.coordinates])
        slope = (np.array(rows[0]) - rows[1]) / (2 * h)
        scale = 1 + np.abs(found.matrix).max() ** 2
        np.testing.assert_allclose(found.matrix[:, column], slope, atol=1e-8 * scale, err_msg=name_)


@pytest.mark.parametrize(
    "name",
    [
        "circle", "ellipse-surface", "narrow ellipse", "stadium", "sinai", "sphere", "cylinder", "circle, falling",
        "ellipse-surface, falling", "narrow ellipse, falling", "sphere, falling",
    ],
)  # fmt: skip
def test_determinant_is_the_measures(name):
    """|det| of the tangent map is the ratio of the velocities across the wall: |v.n| ds dv d(spin) is kept."""
    table = TABLES[name]
    start = billiards.starts(table, 20, 5) if name != "cylinder" else begin(table)
    for bounces in (1, 4):
        found = billiards.tangent_map(table, start, bounces)
        det = np.abs(np.linalg.det(found.matrix))
        # (a determinant of what stretches by so much has so many digits)
        digits = 1e-14 * np.linalg.cond(found.matrix)
        assert (np.abs(det * found.across[..., 1] / found.across[..., 0] - 1) < digits).all()
        assert np.median(digits) < 1e-6


def test_spectrum_of_what_is_not_chaotic():
    """Circle, strip, sphere, polygon: all exponents fall to zero as log(n)/n."""
    for table in (TABLES["circle"], TABLES["strip"], TABLES["sphere"], TABLES["triangle"]):
        found = billiards.lyapunov(table, begin(table), 20_000)
        assert np.abs(found.per_bounce).max() < 2 * math.log(20_000) / 20_000 + 1e-3


def test_spectrum_of_chaos_sums_to_nothing():
    """In the plane the no-slip map keeps a measure and undoes itself: (l, 0, 0, -l)."""
    for table in (billiards.stadium(), billiards.sinai(0.2)):
        found = billiards.lyapunov(table, billiards.starts(table, 4, 1), 20_000)
        assert np.abs(found.per_bounce.sum(axis=-1)).max() < 5e-3
        assert (found.per_bounce[:, 0] > 0.1).all()
        assert np.abs(found.per_bounce[:, 1:3]).max() < 0.02
        np.testing.assert_allclose(found.per_bounce[:, 0], -found.per_bounce[:, 3], atol=0.02)
        assert found.history.shape == (20, 4, 4)
        assert (found.per_time[:, 0] > 0).all()


def test_mirror_as_wave_fronts_have_it():
    """With the mirror law the greatest exponent is the mean of log(1 + tau B), B the curvature of a wave front (Sinai):

    B -> B/(1 + tau B) in flight, + 2/(R cos angle) at a scatterer. An independent way to the same number, orbit by orbit.
    """
    table = billiards.sinai(0.3)
    start = billiards.starts(table, 50, 3)
    bounces = 8
    found = billiards.orbit(table, start, bounces + 1, law="mirror")
    tangent = billiards.tangent_map(table, start, bounces, law="mirror")
    speed = np.linalg.norm(found.velocity, axis=-1)
    cos, sin = found.across / speed, found.along / speed
    tau = np.diff(found.t, axis=1) * speed[:, :-1]
    front, growth = np.full(50, 1.0), np.ones(50)
    for k in range(bounces):
        growth *= 1 + tau[:, k] * front
        front = front / (1 + tau[:, k] * front) + 2 / (0.3 * cos[:, k + 1])
    # neighbours at a distance of 1 across the ray: 1/cos along the wall, their velocities turned by the front's curvature
    ray = np.stack([1 / cos[:, 0], speed[:, 0] * cos[:, 0], -speed[:, 0] * sin[:, 0], np.zeros(50)], axis=-1)
    after = np.einsum("nij,nj->ni", tangent.matrix, ray)[:, 0] * cos[:, -1]
    np.testing.assert_allclose(np.abs(after), growth, rtol=1e-5)
    # so on the long run the mean of log(1 + tau B) is the exponent
    long = billiards.orbit(table, start, 2000, law="mirror")
    speed, cos = np.linalg.norm(long.velocity, axis=-1), long.across / np.linalg.norm(long.velocity, axis=-1)
    tau, front, total = np.diff(long.t, axis=1) * speed[:, :-1], np.ones(50), 0.0
    for k in range(1999):
        total += np.log1p(tau[:, k] * front).mean() / 1999
        front = front / (1 + tau[:, k] * front) + 2 / (0.3 * cos[:, k + 1])
    spectrum = billiards.lyapunov(table, start, 2000, law="mirror")
    assert spectrum.per_bounce[:, 0].mean() == pytest.approx(total, rel=0.01)


def test_a_custom_law_has_exponents_periodic_orbits_and_manifolds():
    """A law of four lines that is the no-slip law has all that this one has; one that loses energy has no periodic orbits."""
    table = billiards.stadium()
    start = billiards.starts(table, 3, 1)
    one, two = (billiards.lyapunov(table, start, 12, law=law).per_bounce for law in (turned, "no-slip"))
    np.testing.assert_allclose(one, two, atol=1e-9)
    found, known = (billiards.periodic_orbits(table, "2-3", law=law, starts=30) for law in (turned, "no-slip"))
    assert [(orbit.period, orbit.stability, orbit.family) for orbit in found] == [
        (orbit.period, orbit.stability, orbit.family) for orbit in known
    ]
    isolated = [(a, b) for a, b in zip(found, known, strict=True) if not a.family]
    assert isolated
    for a, b in isolated:
        np.testing.assert_allclose((a.duration, a.trace), (b.duration, b.trace), rtol=1e-9)
    hyperbolic = [(a, b) for a, b in isolated if a.stability == "hyperbolic" and a.trace > 2]
    ways = [billiards.manifold(orbit, length=0.05).position for orbit in hyperbolic[0]]
    assert all(np.isfinite(way).all() for way in ways)
    with pytest.raises(carom.CaromError, match="law: expected one that keeps the energy and volumes"):
        billiards.periodic_orbits(table, 2, law=springy)


def test_what_meets_no_wall_has_no_derivative():
    with pytest.raises(carom.CaromError, match="orbits with at least one bounce"):
        billiards.tangent_map(billiards.wedge(30), ((1, 0), (1, 0), 0.0))


# --- analysis -----------------------------------------------------------------------------------------------------------------


def test_section():
    """Crossings of a line: on the line, in order, and as many as flights that cross it."""
    table = billiards.stadium()
    found = billiards.orbit(table, billiards.starts(table, 6, 2), 500)
    cut = billiards.section(found, (0.3, 0.0), (0.0, 1.0))
    left = found.position[:, :-1, 0] - 0.3
    right = found.position[:, 1:, 0] - 0.3
    assert len(cut.t) == ((left > 0) & (right < 0)).sum()
    both = billiards.section(found, (0.3, 0.0), (0.0, 1.0), both=True)
    assert len(both.t) == (left * right < 0).sum()
    assert (np.abs(cut.at) <= 1 + 1e-12).all()
    assert (cut.velocity[:, 0] < 0).all()
    first = cut.orbit == 0
    assert (np.diff(cut.t[first]) > 0).all()
    # with a force along the line's plane: heights between two bounces
    fall = billiards.orbit(billiards.strip(acceleration=0.4), ((0.0, 0.0), (0.3, 1.0), 0.2), 50)
    middle = billiards.section(fall, (0.0, 0.0), (1.0, 0.0))
    k = int(np.searchsorted(fall.t, middle.t[3])) - 1
    dt = middle.t[3] - fall.t[k]
    assert middle.at[3] == pytest.approx(fall.position[k, 0] + fall.velocity[k, 0] * dt + 0.2 * dt * dt)


def test_escape_through_a_hole():
    """With the mirror law in a chaotic stadium the chance to stay falls as exp(-n hole/length)."""
    table = billiards.stadium()
    length = table.wall().lengths.sum()
    hole = 0.02 * length
    start = billiards.starts(table, 4000, 1)
    gone = billiards.escape(table, start, 400, holes=[(0.4, 0.4 + hole)], law="mirror")
    assert gone.escaped.mean() > 0.95
    assert np.median(gone.bounces[gone.escaped]) == pytest.approx(math.log(2) / 0.02, rel=0.15)
    assert np.isnan(gone.t[~gone.escaped]).all()
    assert (gone.bounces[~gone.escaped] == 400).all()
    # the same, from the orbits
    found = billiards.orbit(table, start, 400, law="mirror")
    through = (found.arc >= 0.4) & (found.arc <= 0.4 + hole)
    np.testing.assert_array_equal(through.any(1), gone.escaped)
    np.testing.assert_array_equal(through.argmax(1)[gone.escaped] + 1, gone.bounces[gone.escaped])
    np.testing.assert_allclose(found.t[gone.escaped, gone.bounces[gone.escaped] - 1], gone.t[gone.escaped])


def test_escape_from_a_wedge():
    """With the mirror law a ball that comes into a wedge leaves it again after at most ceil(pi/angle) bounces."""
    rng = np.random.default_rng(3)
    angle = 0.3
    start = (np.array([3.0, 0.0]) + 0.1 * rng.normal(size=(500, 2)), rng.normal(size=(500, 2)), 0.0)
    gone = billiards.escape(billiards.wedge(math.degrees(angle)), start, 100, law="mirror")
    assert gone.escaped.all()
    assert gone.bounces.max() <= math.ceil(math.pi / angle)
    assert gone.bounces.max() >= math.ceil(math.pi / angle) - 1
    # no-slip: some stay for good
    stays = billiards.escape(billiards.wedge(math.degrees(angle)), (start[0], start[1], rng.normal(size=500)), 2000)
    assert 0.02 < (~stays.escaped).mean() < 0.98


def test_period_needs_all_bounces():
    square = billiards.rectangle(1.0, 1.0)
    found = billiards.orbit(square, ((0.1, 0.0), (1.0, 0.5), 0.0), 60, law="mirror")
    assert billiards.period(found) == 6
    assert billiards.period(billiards.orbit(square, ((0.1, 0.0), (1.0, math.sqrt(0.2)), 0.0), 60, law="mirror")) == 0


def test_a_spectrum_prints_in_one_line() -> None:
    table, starts = billiards.sinai(), ([[0.4, 0.4], [0.3, 0.4]], [[0.8, 0.3], [0.5, 0.6]], [0.5, 0.1])
    both = billiards.lyapunov(table, starts, bounces=200, law="mirror")
    one = billiards.lyapunov(table, ((0.4, 0.4), (0.8, 0.3), 0.5), bounces=200, law="mirror")
    assert repr(one) == f"<Lyapunov: largest {one.per_bounce[0]:.4g} ± {one.error[0]:.2g} a bounce; 200 bounces>"
    low, high = np.sort(both.per_bounce[:, 0])
    assert repr(both) == f"<Lyapunov: 2 orbits, largest {low:.4g} to {high:.4g} a bounce; 200 bounces>"
