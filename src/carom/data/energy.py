"""A note on measured rebounds with more energy after the contact than before it."""

from __future__ import annotations

import numpy as np

from carom.data.rebounds import Rebounds
from carom.data.remarks import BEYOND, WITHOUT_ERROR_BARS

__all__ = ["energy_remarks"]

MAX_SPIN = 3.0  # largest spin before a contact that is taken for possible where it was not measured, in units of speed / radius


def energy_remarks(rebounds: Rebounds, radius: float | None, kappa: float, roll: float = 1.0) -> list[str]:
    """Return a note on rebounds with more energy after the contact than before it, beyond the error bar.

    Where the spin before was not measured, the ball may have brought the energy along as spin, but no more than MAX_SPIN speeds per
    radius. A spin after that was not measured counts as none.

    Parameters
    ----------
    rebounds : Rebounds
    radius : float or None
        Of the ball, m; None: not known, so that spins that were measured do not tell energies.
    kappa : float
        I/(m a^2).
    roll : float
        Spin of a ball on a table before the contact, in units of a rolling ball's spin.
    """
    columns, sigma, n = rebounds.columns, rebounds.sigma, len(rebounds)
    if radius is None:
        columns = columns | {name: np.full(n, np.nan) for name in columns if name.startswith("spin")}
    rows = rebounds.rows or tuple(f"row {i + 1}" for i in range(n))
    # the spin about a horizontal axis of a ball that rolls goes with its velocity
    rolls = np.zeros((n, 2))
    if rebounds.kind == "table":
        rolls[:, 0], rolls[:, 1] = roll**2, rebounds.stage == "rolling"
    spin = next(name.removesuffix("_in") for name in columns if name.startswith("spin"))
    energy, error = np.zeros((2, len(rows))), np.zeros((2, len(rows)))
    # (numbers that are too large are refused elsewhere; the square of one that is hardly more than zero is zero)
    with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
        for k, side in enumerate(("in", "out")):
            for name, factor in ((f"v_n_{side}", 1 + kappa * rolls[:, k]), (f"v_t_{side}", 1 + kappa * rolls[:, k]),
                                 (f"{spin}_{side}", kappa * (radius or 0.0) ** 2)):  # fmt: skip
                value = columns[name]
                energy[k] += np.where(np.isnan(value) & (name == f"{spin}_{side}"), 0.0, factor * value**2 / 2)
                error[k] += np.nan_to_num(factor * value * sigma.get(name, np.zeros(len(rows)))) ** 2
        speed2 = columns["v_n_in"] ** 2 + columns["v_t_in"] ** 2
        energy[0] += np.where(np.isnan(columns[f"{spin}_in"]), kappa * MAX_SPIN**2 * speed2 / 2, 0.0)
        bar = np.sqrt(error.sum(axis=0))
        bar = np.where(bar > 0, bar, 2 * WITHOUT_ERROR_BARS / BEYOND * energy[0])
        grows = energy[1] - energy[0] > BEYOND * bar
        if not grows.any():
            return []
        ratio = np.where(grows, energy[1] / energy[0], -np.inf)
    i = int(np.argmax(ratio))
    return [
        f"energy: {grows.sum()} of {len(rows)} rebounds have more energy after the contact than before, beyond the error bar, up"
        f" to {ratio[i]:.3g} times as much at {rows[i]}: no wall at rest gives energy; are the radius, and the spins' signs and"
        " units, right?"
    ]
