"""Tables of bounces as people write them, made by a simulator of its own: formulas of one contact, no carom.

A ball hits a wall with restitution e, friction mu and tangential restitution beta. With a the radius and k = I/(m a^2), the slip
s = v_t - a w becomes -beta s if Coulomb's friction allows that impulse, m k/(1+k) (1+beta) |s| <= mu m (1+e) v_n; else the
impulse is mu m (1+e) v_n against s. ``python tests/reference/written_tables.py FOLDER`` writes an example of each layout.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Columns = dict[str, Array]
RADIUS, KAPPA, G = 0.033, 0.55, 9.80665
E, MU, BETA = 0.75, 0.5, 0.1


def contact(
    v_n: Array, v_t: Array, spin: Array, e: float = E, mu: float = MU, beta: float = BETA
) -> tuple[Array, Array, Array]:
    """Return v_n, v_t and spin after the contact."""
    slip = v_t - RADIUS * spin
    wanted = KAPPA / (1 + KAPPA) * (1 + beta) * np.abs(slip)
    impulse = np.minimum(wanted, mu * (1 + e) * v_n) * np.sign(slip)
    return e * v_n, v_t - impulse, spin + impulse / (KAPPA * RADIUS)


def bounces(
    seed: int, rows: int = 30, *, sigma_v: float = 0.05, sigma_spin: float = 2.0, spins: float = 120.0, e: float = E,
    mu: float = MU, beta: float = BETA,
) -> Columns:  # fmt: skip
    """Return components before and after, SI, with noise after the contact."""
    rng = np.random.default_rng(seed)
    v_n, v_t, spin = rng.uniform(3, 17, rows), rng.uniform(0.5, 14, rows), rng.uniform(-spins, spins, rows)
    out = contact(v_n, v_t, spin, e, mu, beta)
    noise = (sigma_v, sigma_v, sigma_spin)
    after = [x + s * rng.normal(size=rows) for x, s in zip(out, noise, strict=True)]
    names = ("v_n_in", "v_t_in", "spin_in", "v_n_out", "v_t_out", "spin_out")
    return dict(zip(names, (v_n, v_t, spin, *after), strict=True))


def drops(seed: int, rows: int = 30) -> Columns:
    """Return bounces of balls that fall straight down without spin."""
    found = bounces(seed, rows)
    zero = np.zeros(rows)
    return found | {"v_t_in": zero, "v_t_out": zero, "spin_in": zero, "spin_out": zero}


def _text(columns: dict[str, list[str]], delimiter: str = ",") -> str:
    lines = [delimiter.join(columns), *(delimiter.join(row) for row in zip(*columns.values(), strict=True))]
    return "\n".join(lines) + "\n"


def _cells(x: Array, digits: int = 4, comma: bool = False) -> list[str]:
    return [
        "" if np.isnan(value) else f"{value:.{digits}f}".replace(".", "," if comma else ".") for value in x.tolist()
    ]


def _polar(t: Columns) -> tuple[Array, Array, Array, Array]:
    """Return speeds and angles from the normal, before and after."""
    return (
        np.hypot(t["v_n_in"], t["v_t_in"]), np.arctan2(t["v_t_in"], t["v_n_in"]),
        np.hypot(t["v_n_out"], t["v_t_out"]), np.arctan2(t["v_t_out"], t["v_n_out"]),
    )  # fmt: skip


def _speed_angle(t: Columns) -> str:
    v, i, w, o = _polar(t)
    i, o = np.degrees(i), np.degrees(o)
    columns = {"speed_in": v, "incidence_deg": i, "spin_in": t["spin_in"], "speed_out": w, "reflection_deg": o}
    columns["spin_out"] = t["spin_out"]
    return _text({name: _cells(x) for name, x in columns.items()})


def _from_surface(t: Columns) -> str:
    v, i, w, o = _polar(t)
    rpm = 60 / (2 * np.pi)
    i, o = 90 - np.degrees(i), 90 - np.degrees(o)
    columns = {"v_in [km/h]": 3.6 * v, "angle_in_from_surface [deg]": i, "spin_in [rpm]": rpm * t["spin_in"]}
    columns |= {"v_out [km/h]": 3.6 * w, "angle_out_from_surface [deg]": o, "spin_out [rpm]": rpm * t["spin_out"]}
    return _text({name: _cells(x, comma=True) for name, x in columns.items()}, ";")


def _plane(t: Columns) -> str:
    columns = {"vx_in": t["v_t_in"], "vy_in": -t["v_n_in"], "spin_in": t["spin_in"], "vx_out": t["v_t_out"], "vy_out": t["v_n_out"],
               "spin_out": t["spin_out"]}  # fmt: skip
    return _text({name: _cells(x) for name, x in columns.items()})


def _ratios(t: Columns) -> str:
    columns = {
        "incidence_deg": np.degrees(_polar(t)[1]),
        "e_n": t["v_n_out"] / t["v_n_in"],
        "e_t": t["v_t_out"] / t["v_t_in"],
    }
    return _text({name: _cells(x) for name, x in columns.items()})


def _angles(t: Columns) -> str:
    """Angles from the normal to 0.5 degrees, of balls without spin on a smooth wall; no speed at all."""
    rng = np.random.default_rng(3)
    v_n, v_t = t["v_n_in"], t["v_t_in"]
    out = contact(v_n, v_t, np.zeros_like(v_n), mu=0.15)
    columns = {
        "incidence_deg": np.degrees(np.arctan2(v_t, v_n)),
        "reflection_deg": np.degrees(np.arctan2(out[1], out[0])),
    }
    columns["reflection_deg"] += 0.5 * rng.normal(size=len(v_n))
    return _text({name: _cells(x, 2) for name, x in columns.items()} | {"sigma_reflection_deg": ["0.5"] * len(v_n)})


def _slip_ratios(name: str) -> Callable[[Columns], str]:
    def text(t: Columns) -> str:
        slip = {side: t[f"v_t_{side}"] - RADIUS * t[f"spin_{side}"] for side in ("in", "out")}
        columns = {"v_n_in": t["v_n_in"], "v_t_in": t["v_t_in"], "spin_in": t["spin_in"], "e": t["v_n_out"] / t["v_n_in"],
                   name: -slip["out"] / slip["in"]}  # fmt: skip
        return _text({head: _cells(x, 6) for head, x in columns.items()})

    return text


def _heights(t: Columns) -> str:
    columns = {
        "drop_height_cm": 100 * t["v_n_in"] ** 2 / (2 * G),
        "rebound_height_cm": 100 * t["v_n_out"] ** 2 / (2 * G),
    }
    return _text({name: _cells(x) for name, x in columns.items()})


def _times(t: Columns) -> str:
    """Times between bounces in a row, of a few balls: each is the restitution times the one before."""
    rng = np.random.default_rng(1)
    balls, times = [], []
    for ball in range(5):
        time = 0.9
        for _ in range(6):
            balls.append(str(ball + 1))
            times.append(time)
            time *= E * (1 + 0.005 * rng.normal())
    return _text({"ball": balls, "flight_time_s": _cells(np.array(times), 5)})


def _plus_minus(t: Columns) -> str:
    columns = {name: _cells(t[name]) for name in ("v_n_in", "v_t_in", "spin_in")}
    columns |= {name: [f"{x:.2f} ± 0.05" for x in t[name].tolist()] for name in ("v_n_out", "v_t_out")}
    return _text(columns | {"spin_out ± 2": _cells(t["spin_out"], 1)})


def _per_cent(t: Columns) -> str:
    rng, rows = np.random.default_rng(2), len(t["v_n_in"])
    exact = contact(t["v_n_in"], t["v_t_in"], t["spin_in"])
    columns = {name: _cells(t[name]) for name in ("v_n_in", "v_t_in", "spin_in")}
    for name, x, share in zip(("v_n_out", "v_t_out"), exact, (0.006, 0.015), strict=False):
        columns |= {
            name: _cells(x * (1 + share * rng.normal(size=rows))),
            f"sigma_{name} [%]": [f"{100 * share:g}"] * rows,
        }
    return _text(columns)


def _missing(t: Columns) -> str:
    columns = {name: x.copy() for name, x in t.items()}
    columns["v_n_out"][::3], columns["v_t_out"][1::3], columns["spin_out"][2::3] = np.nan, np.nan, np.nan
    return _text({name: _cells(x) for name, x in columns.items()})


def _spin_after(t: Columns) -> str:
    return _text({name: _cells(t[name]) for name in ("v_n_in", "v_t_in", "spin_in", "spin_out")})


def _normalised(t: Columns) -> str:
    v, i, w, o = _polar(t)
    columns = {"speed_in": v, "incidence_deg": np.degrees(i), "normalised_spin_in": RADIUS * t["spin_in"] / v, "speed_out": w,
               "reflection_deg": np.degrees(o), "normalised_spin_out": RADIUS * t["spin_out"] / w}  # fmt: skip
    return _text({name: _cells(x, 6) for name, x in columns.items()})


def _surfaces(t: Columns) -> str:
    half = {"rough": bounces(7, mu=0.5), "smooth": bounces(8, mu=0.15)}
    columns = {"surface": [name for name, table in half.items() for _ in table["v_n_in"]]}
    for name in t:
        columns[name] = [cell for table in half.values() for cell in _cells(table[name])]
    return _text(columns)


LAYOUTS: dict[str, Callable[[Columns], str]] = {
    "speed_and_angle": _speed_angle, "from_surface": _from_surface, "x_and_y": _plane, "angle_and_ratios": _ratios,
    "angles": _angles, "cross": _slip_ratios("e_x"), "walton": _slip_ratios("beta"), "heights": _heights, "times": _times,
    "errors_in_cells": _plus_minus, "errors_in_per_cent": _per_cent, "missing_cells": _missing, "spin_after": _spin_after,
    "normalised_spin": _normalised, "surfaces": _surfaces,
}  # fmt: skip
STRAIGHT = ("heights", "times")


def layout(name: str, seed: int = 1) -> str:
    """Return the text of a table in a layout."""
    return LAYOUTS[name](drops(seed) if name in STRAIGHT else bounces(seed))


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for one in LAYOUTS:
        (folder / f"{one}.csv").write_text(layout(one), encoding="utf-8")
