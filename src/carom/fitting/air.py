"""Drag and lift of a ball from flights with known spins: each with a start of its own, along carom's own paths and derivatives."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError, Fault
from carom.fitting.result import Estimate, estimate_dict
from carom.scene.scene import Run, Scene
from carom.scene.schema import Model
from carom.scene.toml import load_scene, path_match, replaced
from carom.simulation.sensitivity.at_times import sensitivities
from carom.tracks.judgement import BallRows, read_rows

Array = NDArray[np.float64]
STARTS = ["balls.0.position", "balls.0.velocity"]
ROUNDS, CLOSE = 20, 1e-9  # of steps; a change of the coefficients that is none
ASTRAY = 4.0  # times the median: a flight that is so far from its path is left out
FEWEST = 5  # frames of a flight


@dataclass(frozen=True, eq=False)
class AirFit:
    """Coefficients of drag and lift that flights show."""

    values: dict[str, float]
    """By path, such as ``balls.0.drag``."""
    errors: dict[str, float]
    flights: int
    residual: float
    """Root mean square distance of the frames from the paths, m."""
    spin_ratios: tuple[float, float]
    """The least and the largest of the flights, as they begin."""
    scene: Scene
    """The ball with these numbers."""
    notes: tuple[str, ...] = ()

    def estimates(self) -> dict[str, Estimate]:
        """Return value and error bar of each number."""
        return {name: Estimate(x, self.errors[name], "") for name, x in self.values.items()}

    def to_dict(self) -> dict[str, Any]:
        """Return the results as plain numbers."""
        parameters = {name: estimate_dict(one) for name, one in self.estimates().items()}
        return {
            "parameters": parameters, "flights": self.flights, "residual": self.residual, "spin_ratios": list(self.spin_ratios),
            "notes": list(self.notes),
        }  # fmt: skip


def fit_air(file: str | Path | Any, scene: str | Path | Scene) -> AirFit:
    """Fit the numbers of a ball's drag and lift to flights, each with a start of its own.

    Parameters
    ----------
    file : path or columns
        Columns t (s), x, y, z (m), wx, wy, wz (rad/s), and ``ball``, which names the flight: a row per frame.
    scene : path or Scene
        Its air, its gravity, and its first ball: radius, mass, and the numbers or forms of ``drag`` and ``lift``, whose numbers are
        fitted, from there on.

    Returns
    -------
    AirFit. Error bars are from how the flights differ. Raises CaromError, one line, for columns that are missing, flights of fewer
    than 5 frames, and for a ball without a number to fit.

    Examples
    --------
    >>> import carom, numpy as np
    >>> ball = {"radius": 0.02, "mass": 0.0027, "position": (0, 0, 1), "drag": 0.5, "lift": 0.2}
    >>> ball |= {"velocity": (6, 0, 2), "spin": (0, 200, 0)}
    >>> scene = carom.Scene(air={"density": 1.2}, balls=[ball], run=carom.Run(duration=0.3))
    >>> table = carom.simulate(scene).table(np.linspace(0, 0.3, 31))
    >>> found = carom.fit_air(table, carom.replaced(scene, {"balls.0.drag": 0.4, "balls.0.lift": 0.1}))
    >>> {name: round(x, 6) for name, x in found.values.items()}
    {'balls.0.drag': 0.5, 'balls.0.lift': 0.2}
    """
    where = "fit_air"
    given = scene if isinstance(scene, Scene) else load_scene(scene)
    if given.air is None:
        raise CaromError(Fault(where, "scene", "a scene with a table [air]", "one without"))
    ball = given.balls[0]
    paths = [path for name in ("drag", "lift") for path in _numbers(name, getattr(ball, name))]
    if not paths:
        raise CaromError(Fault(where, "scene", "numbers or forms for drag or lift of its first ball", "names of laws"))
    rows, _noise, notes = read_rows(file, ball.radius, ball.mass, None)
    flights = [one for one in rows if len(one.t) >= FEWEST]
    if not flights or any(one.w is None for one in flights):
        got = f"flights of fewer than {FEWEST}" if not flights else "no spins"
        raise CaromError(Fault(where, "file", f"flights of {FEWEST} frames or more, and columns wx, wy, wz", got))
    longest = 1.001 * max(float(np.ptp(one.t)) for one in flights)
    still = {"position": (0.0, 0.0, 0.0), "rolling": False, "strike": None, "spin": (0.0, 0.0, 0.0), "spin_z": None}
    one_ball = (ball.model_copy(update=still),)
    alone = Scene(air=given.air, gravity=given.gravity, balls=one_ball, run=Run(law="mirror", duration=longest))
    values = np.array([path_match(alone, path).values[0] for path in paths])
    values, covariance, far, good = _fit(alone, paths, values, flights)
    if not good.all():
        out = f"{int((~good).sum())} of {len(flights)} flights left out"
        notes.append(f"{out}: farther from their paths than {ASTRAY:g} times the median")
    flights = [one for one, use in zip(flights, good, strict=True) if use]
    far = far[good]
    starts = [_start(one) for one in flights]
    ratios = [ball.radius * float(np.linalg.norm(w) / np.linalg.norm(v)) for _x, v, w in starts]
    return AirFit(
        dict(zip(paths, values.tolist(), strict=True)),
        dict(zip(paths, np.sqrt(np.diag(covariance)).tolist(), strict=True)),
        len(flights), float(np.sqrt(np.mean(np.square(far)))), (min(ratios), max(ratios)),
        replaced(given, dict(zip(paths, values.tolist(), strict=True))), tuple(notes),
    )  # fmt: skip


def _numbers(name: str, law: Any) -> list[str]:
    """Return the paths of the numbers of a ball's law of drag or lift."""
    if isinstance(law, float):
        return [f"balls.0.{name}"]
    fields = type(law).model_fields if isinstance(law, Model) else ()
    found = [(field, getattr(law, field)) for field in fields if field not in ("reynolds", "spin_ratio")]
    own = [f"balls.0.{name}.{field}" for field, value in found if isinstance(value, float)]
    return own + [
        f"balls.0.{name}.{field}.{k}" for field, value in found if isinstance(value, tuple) for k in range(len(value))
    ]


def _start(one: BallRows) -> tuple[Array, Array, Array]:
    """Return about where a flight begins, how fast, and its spin."""
    numbers = np.polynomial.polynomial.polyfit(one.t - one.t[0], one.x, 2)
    return numbers[0], numbers[1], np.zeros(3) if one.w is None else one.w[0]


def _fit(
    scene: Scene, paths: list[str], values: Array, flights: list[BallRows]
) -> tuple[Array, Array, Array, NDArray[np.bool_]]:
    """Return the numbers, their covariance, the distance of each flight's frames from its path (root mean square, m), and which
    flights were used.
    """
    most = max(len(one.t) for one in flights)
    times = np.array([np.pad(one.t - one.t[0], (0, most - len(one.t)), mode="edge") for one in flights])
    seen = np.array([np.arange(most) < len(one.t) for one in flights])
    measured = np.array([np.pad(one.x, ((0, most - len(one.t)), (0, 0)), mode="edge") for one in flights])
    starts, spin = np.split(np.array([np.concatenate(_start(one)) for one in flights]), [6], axis=1)
    bends: Any = None
    for _ in range(ROUNDS):
        here = replaced(scene, dict(zip(paths, values.tolist(), strict=True)))
        many = sensitivities(
            here, [*STARTS, *paths], starts[:, None, 3:], spin[:, None], starts[:, None, :3], times=times
        )
        if (bad := np.flatnonzero(many.why != "")).size:
            raise CaromError(
                f"fit_air: expected flights that can be followed, got at flight {bad[0]}: {many.why[bad[0]]}"
            )
        apart = (measured - many.states.position[:, :, 0]) * seen[..., None]  # type: ignore[union-attr, index]
        slopes = many.slopes.position[:, :, 0] * seen[..., None, None]  # type: ignore[union-attr]
        own, shared = np.zeros((len(flights), 6, len(paths) + 1)), []
        for n, (r, j) in enumerate(
            zip(apart.reshape(len(flights), -1), slopes.reshape(len(flights), 3 * most, -1), strict=True)
        ):
            q, upper = np.linalg.qr(j[:, :6])
            rest = np.column_stack([j[:, 6:], r])
            own[n] = np.linalg.solve(upper, q.T @ rest)
            shared.append(rest - q @ (q.T @ rest))
        far = np.sqrt(np.square(apart).sum(axis=(1, 2)) / seen.sum(axis=1))
        good = far <= ASTRAY * np.median(far)
        bends = np.array(shared)[good]
        flat = bends.reshape(-1, len(paths) + 1)
        step = np.linalg.lstsq(flat[:, :-1], flat[:, -1], rcond=None)[0]
        step *= _share(scene, paths, values, step)
        values, starts = values + step, starts + own[..., -1] - own[..., :-1] @ step
        if np.abs(step).max() <= CLOSE:
            break
    slope, r = bends[..., :-1], bends[..., -1]
    inverse, used = np.linalg.pinv(np.einsum("nij,nik->jk", slope, slope), hermitian=True), len(bends)
    free = max(3 * int(seen[good].sum()) - 6 * used - len(paths), 1)
    covariance = inverse * float(np.square(r).sum()) / free
    if used >= FEWEST:
        pull = np.einsum("nij,ni->nj", slope, r - slope @ step)
        covariance = inverse @ (pull.T @ pull) @ inverse * used / (used - 1)
    return values, covariance, far, good


def _share(scene: Scene, paths: list[str], values: Array, step: Array) -> float:
    """Return the share of a step that leads to numbers which a scene takes."""
    for halvings in range(20):
        try:
            replaced(scene, dict(zip(paths, (values + step * 0.5**halvings).tolist(), strict=True)))
        except CaromError:
            continue
        return float(0.5**halvings)
    return 0.0
