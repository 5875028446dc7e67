"""Starts that reach a target: a coarse sweep for sequences of events that do, least squares with exact gradients within each."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from numbers import Integral
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError, FaultList, require_type
from carom.files import import_optional
from carom.formatting import format_number, html_table
from carom.public.progress import Progress, loop_callback
from carom.scene.scene import Scene
from carom.simulation.contacts.kinds import partner_names
from carom.simulation.sensitivity.compiled import finished_meanwhile
from carom.simulation.simulate import simulate
from carom.sweeps.aim_problem import AimProblem, CoarseSweep, Signature, signature
from carom.sweeps.targets import EVENTS, TargetEvent, find, targets_of
from carom.sweeps.unknowns import Unknown, unknowns_of, values_at

if TYPE_CHECKING:
    from carom.simulation.trajectory import Trajectory

__all__ = ["Aim", "Aims", "aim", "is_linear"]

Array = NDArray[np.float64]
SEQUENCES, STARTS_EACH = 10, 2  # that are refined: sequences of events, and starts of each
MOST_STARTS = 1 << 20
DRAWS = 200  # of the player's errors, for the share of shots that succeed
STEPS, ENOUGH = 8, 1e-3  # of least squares, at most; and a share of what is allowed that need not be improved on
LINEAR = 3.0  # times what shots miss by, that gradients say at most
NOT_LINEAR = "–: the miss is not linear within the player's errors; success, of shots that were run, holds."
APART = 4.0  # solutions nearer than this, in the player's errors, are one
LOST = 10.0  # miss, in what is allowed, of a start with another sequence of events


@dataclass(frozen=True, eq=False)
class Aim:
    """One solution: made by :func:`carom.aim`."""

    values: dict[str, float]
    """The unknowns: speed in m/s, angles in degrees, offsets in radii."""
    chance: float
    """Share of shots that reach the target under the player's errors, of 200 that were drawn and run."""
    spread: Array
    """(R,), m: standard deviation of the miss under the player's errors, by gradients: of an impact parameter, or along x, y;
    m/s of the speed where that is asked for."""
    covariance: Array
    """(R, R) of the miss."""
    sequence: tuple[str, ...]
    """Objects that the targets' balls meet, in this order."""
    time: float
    """When the last target is reached, s."""
    scene: Scene
    """The scene with this start."""
    changes: dict[str, Any]
    """The numbers of the start by path, as :func:`carom.replaced` takes them."""
    linear: bool = True
    """Whether spread and covariance hold: gradients say of the shots that were run by about how much they miss."""

    @property
    def run(self) -> Trajectory:
        """The run of this start."""
        return simulate(self.scene)

    def __repr__(self) -> str:
        """Return one line."""
        numbers = ", ".join(f"{name} {format_number(x, 5)}" for name, x in self.values.items())
        return f"<Aim: {numbers}: {self.chance:.0%} under the player's errors>"


class Aims(Sequence[Aim]):
    """Solutions, the most robust one first."""

    def __init__(self, solutions: list[Aim], unknowns: list[Unknown], targets: list[TargetEvent]) -> None:
        self._solutions, self._unknowns = solutions, unknowns
        self.targets = targets

    def __len__(self) -> int:
        """Return how many there are."""
        return len(self._solutions)

    def __getitem__(self, k: Any) -> Any:
        """Return one, or several."""
        return self._solutions[k]

    def rows(self) -> tuple[list[str], list[list[str]]]:
        """Return head and rows of a table."""
        head = [
            *(f"{name} {one.unit}" for name, one in zip(self._names(), self._unknowns, strict=True)),
            "success",
            "spread mm",
        ]
        body = []
        for one in self._solutions:
            units = [unit for target in self.targets for unit in target.units]
            told = [
                format_number(1e3 * s) if unit == "m" else f"{format_number(s)} m/s"
                for s, unit in zip(one.spread, units, strict=True)
            ]
            spread = " x ".join(told) if one.linear else "–"
            numbers = [format_number(x, 5) for x in one.values.values()]
            body.append([*numbers, f"{one.chance:.0%}", spread, ", ".join(one.sequence)])
        return [*head, "sequence"], body

    @property
    def note(self) -> str:
        """Notes below the table: the player's errors, and the meaning of a dash."""
        each = [
            f"{one.name} {100 * one.error:g} %" if one.name == "speed" else f"{one.name} {one.error:g} {one.unit}"
            for one in self._unknowns
        ]
        said = f"The player's errors, one standard deviation: {', '.join(dict.fromkeys(each))}.".replace(" °", "°")
        return said if all(one.linear for one in self) else f"{said} {NOT_LINEAR}"

    def _names(self) -> list[str]:
        return list(self._solutions[0].values) if self._solutions else []

    def __repr__(self) -> str:
        """Return a table as text."""
        head, body = self.rows()
        widths = [max(len(row[k]) for row in [head, *body]) for k in range(len(head))]
        lines = [
            "  ".join(cell.ljust(w) for cell, w in zip(row, widths, strict=True)).rstrip() for row in [head, *body]
        ]
        return "\n".join([*lines, self.note])

    def _repr_html_(self) -> str:
        return f"{html_table(*self.rows())}<p>{self.note}</p>"


def aim(
    scene: Scene,
    free: Sequence[str] | Mapping[str, tuple[float, float]],
    reach: Any,
    *,
    errors: Mapping[str, float] | None = None,
    solutions: int = 5,
    starts: int = 1 << 14,
    seed: int = 0,
    progress: Progress | None = None,
) -> Aims:
    """Find starts of a ball that reach a target, the most robust one first.

    Parameters
    ----------
    scene : Scene
    free : paths, or a mapping of them to ranges (low, high)
        What may be chosen: a ball's ``velocity`` on the floor (speed 0.5 to 6 m/s, or the range given, and all directions),
        ``strike`` (speed and azimuth), ``strike.offset`` (side and top, up to half a radius), ``strike.elevation``, ``spin_z``.
    reach : mapping, or several
        ``{"ball": 2, "point": (1.2, 0.4)}``: where it comes to rest, within its radius, or ``"within"`` m;
        ``{"ball": 1, "pocket": "any"}``: it falls into a pocket, of that name or any;
        ``{"ball": 0, "hit": ("yellow", "red"), "cushions": 3}``: it touches both, and at least three cushions before the last one.
        ``"speed": 0.8``: and comes there with this speed (m/s), within a tenth, or ``"speed_within"`` m/s.
        Several must all be met: pot a ball and leave the cue ball at a place.
    errors : mapping, optional
        The player's, one standard deviation: "speed" (a share: 0.03), "angle" and "azimuth" (0.2 degrees), "elevation" (0.5
        degrees), "side" and "top" (0.02 radii), "spin_z" (2 rad/s).
    solutions : int
        How many are returned, at most.
    starts : int
        Of the coarse sweep.
    seed : int
        Of the draws of the player's errors.
    progress : callable(done, total, text), optional
        Called with the current step in words; how much of it is done is not known (NaN).

    Returns
    -------
    Aims
        Distinct solutions, each centred within its sequence of events; ordered by the share of shots that succeed.

    Raises CaromError: unknown paths, balls and pockets, numbers out of range; no start that reaches the target.

    Examples
    --------
    >>> import carom
    >>> wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.85, friction=0.2)
    >>> balls = [carom.SceneBall(radius=0.03, mass=0.2, position=(0.5, y), velocity=(0, 0), rolling=True) for y in (0, 0.6)]
    >>> scene = carom.Scene(floor=carom.Floor(friction=0.2, rolling_resistance=0.01), walls=[wall], balls=balls)
    >>> best = carom.aim(scene, ["balls.0.velocity"], {"hit": 1, "cushions": 1}, starts=512)
    >>> best[0].sequence
    ('plane 0', 'ball 1')
    """
    require_type("aim", "scene", scene, Scene)
    faults = FaultList("aim")
    unknowns: list[Unknown] = faults.attempt(unknowns_of, scene, free, {} if errors is None else errors)
    targets: list[TargetEvent] = faults.attempt(targets_of, scene, reach)
    for name, value, least, most in (
        ("solutions", solutions, 1, math.inf), ("starts", starts, 1, MOST_STARTS), ("seed", seed, 0, math.inf)
    ):  # fmt: skip
        if isinstance(value, bool) or not isinstance(value, Integral) or not least <= value <= most:
            span = f"from {least} to {most:,}" if most < math.inf else f">= {least}"
            faults.add(name, f"a whole number {span}", f"{value!r:.60}")
    faults.raise_if_any()
    problem = AimProblem(scene, unknowns, targets)
    say = loop_callback(progress, lambda tell: lambda text: tell(math.nan, math.nan, text)) or (lambda _text: None)
    say(f"{starts:,} starts")
    refined: list[tuple[Array, Array, Any]] = []
    with finished_meanwhile():  # (the starts are run without derivatives, and then refined with them)
        sweep = _coarse(problem, starts)
        for x0, sequence in _candidates(problem, sweep):
            say(f"refining, {len(refined)} so far")
            found = _refined(problem, x0, sequence)
            if found is not None:
                refined.append(found)
    draws = np.random.default_rng(seed).normal(size=(DRAWS, len(unknowns)))
    say("the player's errors")
    made = _judged(problem, refined, draws)
    if not made:
        advice = "free more numbers, widen their ranges, or try more starts"
        if moving := int(sweep.moves.sum()):
            advice += f"; in {moving:,} of them the ball still moves when the run ends: a longer run.duration"
        raise CaromError(f"aim: reach: expected a target that some of {starts:,} starts come near, got none; {advice}")
    return Aims(made[:solutions], unknowns, targets)


def _coarse(problem: AimProblem, starts: int) -> CoarseSweep:
    """Run starts that are spread over the ranges."""
    qmc = import_optional("scipy.stats.qmc", "aim")
    power = math.ceil(math.log2(starts))
    points = qmc.Sobol(len(problem.unknowns), scramble=False).random_base2(power)[:starts]
    return problem.sweep(problem.low + points * (problem.high - problem.low))


def _candidates(problem: AimProblem, sweep: CoarseSweep) -> Iterator[tuple[Array, Signature]]:
    """Yield starts to be refined, with their sequences: of those that come nearest to the targets, some of each sequence."""
    x, worst, reached = sweep.x, sweep.miss, sweep.reached
    groups: dict[Signature, list[int]] = {}
    for n in np.argsort(worst, kind="stable").tolist():
        if not math.isfinite(worst[n]):
            break
        groups.setdefault(signature(sweep.codes[n], problem.targets, sweep.rows[n].tolist()), []).append(n)
    # (a sequence that many starts have is one that is easily kept; a place is mostly come near by a few)
    reaches = {sequence: int(reached[group].sum()) for sequence, group in groups.items()}
    order = sorted(groups, key=lambda one: (-reaches[one], worst[groups[one][0]]))
    for sequence in order[:SEQUENCES]:
        chosen: list[int] = []
        for n in groups[sequence]:
            if all((np.abs(x[n] - x[k]) > APART * problem.scale(x[n])).any() for k in chosen):
                chosen.append(n)
                yield x[n], sequence
            if len(chosen) == STARTS_EACH:
                break


def _refined(problem: AimProblem, x0: Array, sequence: Signature) -> tuple[Array, Array, Any] | None:
    """Bring a start to the middle of its target, within its sequence; return it, its miss's derivatives (R, U), and its run."""
    optimize = import_optional("scipy.optimize", "aim")
    known: dict[bytes, tuple[Array, Array, Any]] = {}

    def at(x: Array) -> tuple[Array, Array, Any]:
        key = x.tobytes()
        if key not in known:
            size = sum(len(target.windows) for target in problem.targets)
            lost = np.full(size, LOST), np.zeros((size, len(x))), None
            known[key] = lost
            try:
                run, its, found = problem.follow(x)
                if its == sequence:
                    miss, derivatives = problem.miss(run, found, run.sensitivity(problem.paths), x)
                    if np.isfinite(miss).all() and np.isfinite(derivatives).all():
                        known[key] = miss, derivatives, (run, found)
            except (
                CaromError
            ):  # (a start that the scene refuses, an event without an answer, a graze without a derivative)
                pass
        return known[key]

    if at(x0)[2] is None:
        return None
    circular = np.array([one.circular for one in problem.unknowns])
    bounds = np.where(circular, -np.inf, problem.low), np.where(circular, np.inf, problem.high)
    try:
        found = optimize.least_squares(
            lambda x: at(x)[0],
            x0,
            jac=lambda x: at(x)[1],
            bounds=bounds,
            x_scale=problem.scale(x0),
            max_nfev=STEPS,
            ftol=ENOUGH,
            xtol=ENOUGH,
            gtol=ENOUGH**2,
        )
    except ValueError:  # (a start on the border of its range)
        return None
    _miss, rates, followed = at(found.x)
    return (found.x, rates, followed[0]) if followed is not None and problem.reaches(*followed) else None


def _judged(problem: AimProblem, refined: list[tuple[Array, Array, Any]], draws: Array) -> list[Aim]:
    """Return distinct solutions with the share of shots that succeed, in its order."""
    found: list[tuple[float, Array, Aim]] = []
    if not refined:
        return []
    tried = [x + draws * problem.sigma(x) for x, _slopes, _run in refined]
    miss, reached = problem.judge(np.clip(np.concatenate(tried), *_wide(problem)))
    success = reached.reshape(len(refined), len(draws)).mean(axis=1)
    windows = np.concatenate([target.windows for target in problem.targets])
    each = miss.max(axis=1).reshape(len(refined), len(draws))
    for (x, rates, run), chance, missed in zip(refined, success, each, strict=True):
        scaled = rates * problem.sigma(x) * windows[:, None]
        covariance = scaled @ scaled.T
        one = Aim(
            dict(zip(_names(problem.unknowns), problem.wrapped(x).tolist(), strict=True)),
            float(chance), np.sqrt(np.diag(covariance)), covariance, *_sequence(problem, run), run.scene,
            values_at(problem.unknowns, x),
            is_linear(draws * problem.sigma(x) @ rates.T, missed),
        )  # fmt: skip
        found.append((float(chance), x, one))
    found.sort(key=lambda item: (-item[0], float(item[2].spread.max())))
    kept: list[tuple[Array, Aim]] = []
    for _chance, x, one in found:
        near = [(np.abs(_turn(problem, x - other)) <= APART * problem.scale(x)).all() for other, _aim in kept]
        if not any(near):
            kept.append((x, one))
    return [one for _x, one in kept]


def is_linear(predicted: Array, missed: Array) -> bool:
    """Return whether gradients say by how much shots miss: ``predicted`` (N, R) as shares of what is allowed, ``missed`` (N,).

    Of shots that do not reach the target's event it is not known by how much (inf), and where none does the gradients say nothing.
    """
    known = np.isfinite(missed)
    if not known.any():
        return False
    said = np.median(np.abs(predicted[known]).max(axis=1))
    return bool(said <= LINEAR * max(1.0, float(np.median(missed[known]))))


def _turn(problem: AimProblem, x: Array) -> Array:
    """Return differences of starts, of angles that go round the shorter one."""
    circular = np.array([one.circular for one in problem.unknowns])
    return np.where(circular, (x + 180.0) % 360.0 - 180.0, x)


def _wide(problem: AimProblem) -> tuple[Array, Array]:
    """Return limits of starts that a player's errors may reach: speeds stay positive, and miscues are left to the scene."""
    low = np.array([1e-3 if one.name == "speed" else -np.inf for one in problem.unknowns])
    return low, np.full(len(low), np.inf)


def _names(unknowns: Sequence[Unknown]) -> list[str]:
    """Return names of the unknowns, with the ball's path where two have the same."""
    names = [one.name for one in unknowns]
    return [name if names.count(name) == 1 else f"{one.path}.{name}" for name, one in zip(names, unknowns, strict=True)]


def _sequence(problem: AimProblem, run: Any) -> tuple[tuple[str, ...], float]:
    """Return the objects that the balls of the targets meet, up to the last target, and its time."""
    scene = problem.scene
    rows = run.log[np.isin(run.log["kind"], EVENTS)]
    found = [int(find(target, rows[None, :])[0]) for target in problem.targets]
    to_the_end = any(target.kind == "point" for target in problem.targets)
    last = len(rows) if to_the_end else max(found) + 1
    balls = {target.ball for target in problem.targets}
    met = [
        (f"{scene.ball_names[int(row['ball'])]}: " if len(balls) > 1 else "")
        + (partner_names(scene, int(row["met"])) or ())[int(row["other"])]
        for row in rows[:last]
        if int(row["ball"]) in balls
    ]
    counted = ((name, len(list(same))) for name, same in itertools.groupby(met))
    told = tuple(name if count == 1 else f"{count} x {name}" for name, count in counted)
    return told, float(run.end if to_the_end else rows["t"][last - 1])
