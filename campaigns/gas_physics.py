"""Gases against what is known of them: known beside found.

    python campaigns/gas_physics.py [--scale 1.0]
        [--only pressure|free-time|diffusion|sharing|haff|rough|ratio|transport|
        rough-transport|shear|walls]

``--scale`` multiplies the lengths of the runs: at 1 all parts take about ten minutes of CPU time. Units: diameter, mass, k_B T
at the start.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
from campaign import Campaign, campaign

import carom
from carom.gas import (
    Drive,
    Gas,
    Species,
    diffusion_coefficients,
    layer_profiles,
    scattered,
    sheared_viscosity,
    transport_coefficients,
)
from carom.gas import enskog as enskog_theory

SMOOTH, ROUGH = carom.Surface(1, 0, -1), carom.Surface(1, math.inf, 1)
BALL, DISC = carom.Ball(0.5, 1.0, 0.4), carom.Disc(0.5, 1.0, 0.5)


def line(run: Campaign, what: str, known: float, found: float, note: str = "") -> None:
    run.say(f"{what:66} {known:10.5g} {found:10.5g} {100 * (found / known - 1):+8.2f} %  {note}".rstrip())


def carnahan_starling(y: float) -> float:
    """p / (n k T) of hard spheres (Carnahan & Starling 1969); y: share of the volume."""
    return (1 + y + y**2 - y**3) / (1 - y) ** 3


def kolafa(y: float) -> float:
    """The same, with the terms that Kolafa added (as in Boublik & Nezbeda 1986)."""
    return (1 + y + y**2 - 2 / 3 * y**3 - 2 / 3 * y**4) / (1 - y) ** 3


def henderson(y: float) -> float:
    """p / (n k T) of hard discs (Henderson 1975); y: share of the area."""
    return (1 + y * y / 8) / (1 - y) ** 2


def enskog(density: float, pressure: float, temperature: float, axes: int) -> float:
    """Collisions a ball and time, from p / (n k T) through the pair correlation at contact; diameter and mass 1."""
    half_virial = 2 * math.pi / 3 if axes == 3 else math.pi / 2
    contact = (pressure - 1) / (half_virial * density)
    return (4 if axes == 3 else 2) * density * contact * math.sqrt(math.pi * temperature)


def free_time(run: Campaign, scale: float) -> None:
    balls = 4000
    _gas, found = carom.simulate_gas(
        [Species(BALL, balls)], ((balls / 0.5) ** (1 / 3),) * 3, contacts=SMOOTH, max_events=int(8e6 * scale)
    )
    y = 0.5 * math.pi / 6
    line(run, "mean free time, spheres, n = 0.5 (Kolafa)", 1 / enskog(0.5, kolafa(y), 1, 3), found.mean_free_time)


def pressure(run: Campaign, scale: float) -> None:
    for density in (0.1, 0.3, 0.5, 0.7, 0.85):
        _gas, found = carom.simulate_gas(
            [Species(BALL, 2000)], ((2000 / density) ** (1 / 3),) * 3, contacts=SMOOTH, max_events=int(2e6 * scale)
        )
        y = density * math.pi / 6
        line(
            run,
            f"p / n k T, spheres, n = {density} (Carnahan & Starling)",
            carnahan_starling(y),
            found.pressure / density,
        )
        line(run, f"p / n k T, spheres, n = {density} (Kolafa)", kolafa(y), found.pressure / density)
    for share in (0.1, 0.3, 0.45, 0.6, 0.68):
        density = share * 4 / math.pi
        _gas, found = carom.simulate_gas(
            [Species(DISC, 2000)], ((2000 / density) ** 0.5,) * 2, contacts=SMOOTH, max_events=int(2e6 * scale)
        )
        line(run, f"p / n k T, discs, share {share} (Henderson)", henderson(share), found.pressure / density)


def sharing(run: Campaign, scale: float) -> None:
    for ball, side, energy in ((BALL, (14.0, 12.0, 13.0), 1 / 2), (DISC, (50.0, 40.0), 2 / 3)):
        gas = Gas([Species(ball, 1200, temperature_rotational=0.0)], side, contacts=ROUGH, seed=1)
        gas.run(100_000)
        found = gas.run(int(2e6 * scale))
        what = "spheres" if len(side) == 3 else "discs"
        line(run, f"rough {what} from no spin: T of translation", energy, found.temperature_translational)
        line(run, f"rough {what} from no spin: T of rotation", energy, found.temperature_rotational)


def diffusion(run: Campaign, scale: float) -> None:
    density = 0.5
    # after Speedy, Mol. Phys. 62, 509 (1987): a fit to boxes of some hundred balls
    fit = 3 / 8 / math.sqrt(math.pi) / density * (1 - density / 1.09) * (1 + density**2 * (0.4 - 0.83 * density**2))
    # Enskog's viscosity; a periodic box slows diffusion by 2.837 k T / (6 pi eta L) (Duenweg & Kremer 1993; Yeh & Hummer 2004)
    x = kolafa(density * math.pi / 6) - 1
    eta = 5 / 16 / math.sqrt(math.pi) * 2 * math.pi / 3 * density * (1 / x + 0.8 + 0.761 * x)
    sizes, found = (500, 1000, 4000, 16000), []
    for balls in sizes:
        side = (balls / density) ** (1 / 3)
        gas = Gas([Species(BALL, balls)], (side,) * 3, contacts=SMOOTH)
        gas.run(40 * balls)
        step, steps = 4.0, max(int(scale * 1.5e6 / balls), 30)
        places = []
        for _ in range(steps):
            gas.advance(until=gas.time + step)
            now = gas.balls()
            places.append(now.position + now.images * side)
        path = np.array(places)
        # the slope of the mean square between 8 and 20 times, well past the free time of 0.13
        lags = np.array([2, 3, 4, 5])
        squares = [((path[lag:] - path[:-lag]) ** 2).sum(axis=2).mean() for lag in lags]
        found.append(float(np.polyfit(lags * step, squares, 1)[0]) / 6)
        slow = 2.837 / (6 * math.pi * eta * side)
        note = f"for N = inf, by Enskog's viscosity: {found[-1] + slow:.4f}"
        line(run, f"diffusion, spheres, n = 0.5, N = {balls} (a fit to some hundred)", fit, found[-1], note)
    limit = np.polyfit(np.array(sizes) ** (-1 / 3), found, 1)[1]
    run.say(f"{'diffusion, by a line in 1/L to N = inf':66} {'':10} {limit:10.5g}")


def cooling(ball: carom.Ball, balls: int, density: float, surface: carom.Surface, seed: int) -> Gas:
    """A gas from a start at random: on a lattice the first contacts would be more central than later ones."""
    axes = 2 if ball is DISC else 3
    side = ((balls / density) ** (1 / axes),) * axes
    x = scattered(np.full(balls, 0.5), side, rng=np.random.default_rng(seed))
    return Gas([Species(ball, balls)], side, contacts=surface, position=x, seed=seed)


def haff(run: Campaign, scale: float) -> None:
    for axes, e, density in ((3, 0.95, 0.1), (3, 0.8, 0.1), (2, 0.9, 0.2)):
        # (so few that no vortices and clusters grow in the time)
        ball, balls = (BALL, 500) if axes == 3 else (DISC, 200)
        y = density * (math.pi / 6 if axes == 3 else math.pi / 4)
        found, squares = [], []
        for seed in range(max(int(60 * scale), 2)):
            gas = cooling(ball, balls, density, carom.Surface(e, 0, 0), seed)
            gas.run(balls)
            warm, time = 2 * gas.energy()[0] / (axes * balls), gas.time
            rate = enskog(density, carnahan_starling(y) if axes == 3 else henderson(y), warm, axes)
            # (3/2 dT/dt = -rate/2 (1 - e^2) T, for a Maxwellian)
            tau = 2 * axes / ((1 - e * e) * rate)
            squares = []
            for k in range(1, 7):
                gas.advance(until=time + k * tau / 2)
                squares.append(math.sqrt(warm / (2 * gas.energy()[0] / (axes * balls))) - 1)
            found.append(np.array(squares))
        mean = np.mean(found, axis=0)
        # what the velocities' fourth moment adds (van Noije & Ernst 1998)
        a2 = 16 * (1 - e) * (1 - 2 * e * e) / (9 + 24 * axes + (8 * axes - 41) * e + 30 * e * e * (1 - e))
        name = f"Haff, {'spheres' if axes == 3 else 'discs'}, e = {e}, n = {density}"
        for k in (1, 3, 5):
            line(
                run,
                f"{name}: sqrt(T0/T) - 1 after {(k + 1) / 2} tau (Enskog)",
                (k + 1) / 2 * (1 + 3 * a2 / 16),
                mean[k],
            )


def rough_rates(e: float, beta: float, q: float, axes: int) -> Callable[[float, float], tuple[float, float]]:
    """Energies (translational, rotational) that one contact changes on the mean, for Maxwellians at T_tr, T_rot.

    As Huthmann & Zippelius (1997) and Luding, Huthmann, McNamara & Zippelius (1998), derived anew: the tangential impulse is
    (m/2) eta times the slip, eta = (1 + beta) q / (1 + q), and the slip's mean square (d - 1) 2/m (T_tr + T_rot/q).
    """
    eta = (1 + beta) * q / (1 + q)
    c = (axes - 1) / 2

    def rates(tr: float, rot: float) -> tuple[float, float]:
        both = tr + rot / q
        return -(1 - e * e) * tr + c * (eta**2 * both - 2 * eta * tr), c / q * (eta**2 * both - 2 * eta * rot)

    return rates


def rough(run: Campaign, scale: float) -> None:
    for axes, e, beta in ((3, 0.9, 0.0), (3, 0.9, -0.5), (3, 0.95, 0.5), (2, 0.95, 0.0), (2, 0.9, -0.6)):
        ball, balls = (BALL, 400) if axes == 3 else (DISC, 200)
        q = 0.4 if axes == 3 else 0.5
        density = 0.1 if axes == 3 else 0.2
        name = f"rough cooling {'spheres' if axes == 3 else 'discs'}, e = {e}, beta = {beta}: T_rot/T_tr"
        rates, about = rough_rates(e, beta, q, axes), 3 if axes == 3 else 1
        seeds = max(int(300 * scale), 2)
        gases = [
            Gas(
                [Species(ball, balls)], ((balls / density) ** (1 / axes),) * axes, seed=seed,
                contacts=carom.Surface(e, math.inf, beta),
            )
            for seed in range(seeds)
        ]  # fmt: skip
        # the mean-field equations, by the collisions n of a ball: (d/2) dT_tr = (1/2) dE_tr dn
        tr, rot, done, step = 1.0, 1.0, 0, 0.002
        for until in (2, 4, 10, 20):
            for _ in range(round((until - done) / step)):
                d_tr, d_rot = rates(tr, rot)
                tr, rot = tr + d_tr / axes * step, rot + d_rot / about * step
            for gas in gases:
                gas.advance((until - done) * balls // 2)
            done = until
            energies = np.array([gas.energy() for gas in gases])
            # (each gas as warm as the others, so that none counts more)
            found = float((energies[:, 1] / about / (energies[:, 0] / axes)).mean())
            line(run, f"{name} after {until} a ball", rot / tr, found, "mean field, Maxwellians")


def ratio(run: Campaign, scale: float) -> None:
    """Rough spheres that cool freely: T_rot/T_tr after so long that the start is forgotten, and the energy by Haff's law."""
    balls = 400
    for e, beta in ((0.9, 0.0), (0.8, 0.5), (0.95, -0.5), (0.7, 0.9)):
        rates = rough_rates(e, beta, BALL.kappa, 3)
        tr, rot = 1.0, 1.0
        for _ in range(20_000):
            d_tr, d_rot = rates(tr, rot)
            tr, rot = tr + d_tr / 3 * 0.01, rot + d_rot / 3 * 0.01
            tr, rot = 1.0, rot / tr
        found, kept = [], []
        for seed in range(max(int(60 * scale), 2)):
            gas = cooling(BALL, balls, 0.05, carom.Surface(e, math.inf, beta), seed)
            gas.advance(60 * balls // 2)
            begin, energy = gas.time, sum(gas.energy())
            gas.advance(balls)
            # (with a constant ratio the energy falls as T0 / (1 + t/tau)^2, Haff's law: to 1/16 after three tau)
            tau = (gas.time - begin) / (math.sqrt(energy / sum(gas.energy())) - 1)
            for k in range(1, 16):
                gas.advance(until=max(gas.time, begin + 3 * tau * k / 15))
                moves, turns, _ = gas.energy()
                found.append(turns / moves)
            kept.append(sum(gas.energy()) / energy)
        name = f"rough spheres, e = {e}, beta = {beta}"
        line(run, f"{name}: T_rot/T_tr after 60 a ball", rot, float(np.mean(found)), "mean field, Maxwellians")
        line(run, "  the energy, three Haff times later", 1 / 16, float(np.mean(kept)))


def transport(run: Campaign, scale: float) -> None:
    """Helfand's relations in equilibrium, smooth spheres, beside Enskog's theory."""
    balls = 200
    for density in (0.01, 0.1, 0.3, 0.5):
        gas = Gas([Species(BALL, balls)], ((balls / density) ** (1 / 3),) * 3, contacts=SMOOTH, seed=1)
        gas.advance(40 * balls)
        found, known = transport_coefficients(gas, max(int(5000 * scale), 200)), enskog_theory(density)
        for name in found._fields:
            one = getattr(found, name)
            line(
                run, f"{name}, spheres, n = {density} (Enskog)", getattr(known, name), one.value, f"+- {one.error:.2g}"
            )


def rough_transport(run: Campaign, scale: float) -> None:
    """Perfectly rough spheres, dilute, beside their kinetic theory; diffusion of balls and spins by Einstein and Green-Kubo.

    Viscosity, conductivity and self-diffusion in the first approximation: F. B. Pidduck, Proc. R. Soc. Lond. A 101, 101 (1922); S.
    Chapman & T. G. Cowling, The Mathematical Theory of Non-Uniform Gases (1970), 11.6. Spins: a collision takes the share
    (1 + beta) / (1 + kappa) / 2 of a spin across the line of centres, on the mean two thirds of that of the whole, so the
    correlation falls at the rate of collisions times (1 + beta) / (3 (1 + kappa)), and their diffusion is <w_x^2> over that.
    """
    balls, k = 200, BALL.kappa
    root = math.sqrt(math.pi)
    known = {
        "viscosity": 15 / 8 / root * (1 + k) ** 2 / (6 + 13 * k),
        "conductivity": 9
        / 16
        / root
        * (1 + k) ** 2
        * (37 + 151 * k + 50 * k**2)
        / (12 + 75 * k + 101 * k**2 + 102 * k**3),
    }
    density = 0.01
    side = ((balls / density) ** (1 / 3),) * 3
    gas = Gas([Species(BALL, balls)], side, contacts=ROUGH, seed=1)
    gas.advance(40 * balls)
    found = transport_coefficients(gas, max(int(5000 * scale), 200))
    for name, value in known.items():
        one = getattr(found, name)
        line(run, f"{name}, rough spheres, n = {density} (Pidduck)", value, one.value, f"+- {one.error:.2g}")
    for kind, surface, density in (("smooth", SMOOTH, 0.1), ("rough", ROUGH, 0.01), ("rough", ROUGH, 0.2)):
        side = ((balls / density) ** (1 / 3),) * 3
        gas = Gas([Species(BALL, balls)], side, contacts=surface, seed=1)
        gas.advance(40 * balls)
        begin = gas.mark()
        both = diffusion_coefficients(gas, max(int(40_000 * scale), 2000))
        state, theory = gas.measured_since(begin), enskog_theory(density).self_diffusion
        if surface is ROUGH:
            theory *= (1 + k) / (1 + 2 * k) / 1.01896  # (the first approximation)
        rate = 2 / (3 * (1 + k)) / state.mean_free_time
        spins = state.temperature_rotational / (k * BALL.mass * BALL.radius**2) / rate
        for name, one, value in (("diffusion", both.self_diffusion, theory), ("spins", both.spin_diffusion, spins)):
            if math.isnan(one.value):
                continue  # (no collision changes the spins of smooth balls)
            line(run, f"{name}, {kind} spheres, n = {density}, Einstein", value, one.value, f"+- {one.error:.2g}")
            line(run, "  by Green and Kubo", value, one.green_kubo, f"+- {one.green_kubo_error:.2g}")


def shear(run: Campaign, scale: float) -> None:
    """Lees-Edwards boundaries, smooth spheres: the shear heats them, so theory is taken at the temperature reached."""
    balls = 1000
    for density in (0.1, 0.3, 0.5):
        side = ((balls / density) ** (1 / 3),) * 3
        rate = 0.1 / enskog_theory(density).mean_free_time
        gas = Gas([Species(BALL, balls)], side, contacts=SMOOTH, shear_rate=rate, seed=1)
        gas.advance(20 * balls)
        begin = gas.mark()
        found = sheared_viscosity(gas, max(int(400 * balls * scale), 2 * balls))
        warm = gas.measured_since(begin).temperature_translational
        known = enskog_theory(density, temperature=warm).viscosity
        name = f"viscosity at a shear rate of 0.1 / mean free time, n = {density} (Enskog)"
        line(run, name, known, found.value, f"+- {found.error:.2g}, k_B T {warm:.2f}")


def walls(run: Campaign, scale: float) -> None:
    """Heat between walls of different temperature: flux from what the walls give, gradient in the middle from exact layers."""
    balls, density = 2000, 0.1
    width = (balls / density / 4) ** (1 / 3)
    side = (width, width, 4 * width)
    contacts = {("a", "a"): SMOOTH, ("a", "wall"): SMOOTH}
    drives = {
        name: Drive(temperature=t, temperature_rotational=0.0) for name, t in (("bottom", 0.8), ("top", 1.2))
    }  # fmt: skip
    species = Species(BALL, balls, "a", 1.0, 0.0)  # (smooth balls carry the energy of their spins unchanged)
    gas = Gas([species], side, periodic=(True, True, False), contacts=contacts, drives=drives, seed=1)
    gas.advance(200 * balls)
    begin, area = gas.mark(), width * width
    layers, errors = layer_profiles(gas, max(int(2000 * balls * scale), 20 * balls))
    found = gas.measured_since(begin)
    flux = (found.energy_from_walls["top"] - found.energy_from_walls["bottom"]) / (2 * area * found.simulated_time)
    middle = (layers.edges[1:] + layers.edges[:-1]) / 2
    inner = (middle > 0.25 * side[2]) & (middle < 0.75 * side[2])
    slope = np.polyfit(middle[inner], layers.temperature[0, inner], 1)[0]
    volumes = area * np.diff(layers.edges)
    known = np.mean([
        enskog_theory(n, temperature=t).conductivity
        for n, t in zip((layers.number[0] / volumes)[inner], layers.temperature[0, inner], strict=True)
    ])  # fmt: skip
    middle_flux = -float(np.nanmean(layers.heat_flux))  # (from the top, which is warmer)
    line(run, "  heat flux through the planes between layers (from the walls)", float(flux), middle_flux)
    spread = float(np.nanstd(layers.heat_flux, ddof=1))
    run.say(f"  its error in one plane {np.nanmean(errors.heat_flux):.2g}, scatter over the planes {spread:.2g}")
    line(run, f"conductivity between walls at 0.8 and 1.2, n = {density} (Enskog)", float(known), float(flux / slope))


PARTS = {
    "free-time": free_time, "pressure": pressure, "diffusion": diffusion, "sharing": sharing, "haff": haff, "rough": rough,
    "ratio": ratio, "transport": transport, "rough-transport": rough_transport, "shear": shear, "walls": walls,
}  # fmt: skip


def main(words: Sequence[str] | None = None) -> None:
    """A line a number that is known."""
    with campaign("gas_physics", __doc__, words, scale={"type": float, "default": 1.0}) as run:
        run.say(f"{'':66} {'known':>10} {'found':>10}")
        for name, part in PARTS.items():
            if run.wants(name, PARTS):
                part(run, 0.01 if run.small else run.given.scale)


if __name__ == "__main__":
    main()
