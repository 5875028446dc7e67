"""Forms of cushion, cloth and balls compared on the same shots: what each term is worth, and what would replace it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.fitting.shots.joint import FEWEST, deviance_of, fit_shared, frames_of_events, mean_squares
from carom.fitting.shots.result import ComparedForm, ShotsFit, criterion
from carom.fitting.shots.search import ShotStart
from carom.fitting.shots.table import TableModel
from carom.scene.paths import path_match, replaced
from carom.scene.scene import Scene

__all__ = ["FORMS", "compare_forms", "searched_together"]

Array = NDArray[np.float64]
FALL = 0.9  # m/s over which the friction of balls falls with their slip (Alciatore, TP A.14)
ROUNDS = 2  # in which forms are searched from each other's optimum; in the first also with tables of the shots' own
BOTH = (False, True)  # ways to descend: from the optimum that is given, and with tables of the shots' own before
ENOUGH = 1.0  # of the deviance: less than this in a round ends the search


class ChangedForm(NamedTuple):
    """Another form of a part of the table."""

    part: str
    name: str
    change: Callable[[Scene], dict[str, Any]]
    """Of a scene: of one of a form that this form contains, to the same table."""
    without: tuple[str, ...] = ()
    """Paths that are no longer fitted."""
    more: tuple[str, ...] = ()
    """Others that are."""


def _falling(scene: Scene) -> dict[str, Any]:
    mu = float(path_match(scene, "ball_contact.friction").values[0])
    return {"ball_contact.friction": {"at_rest": mu, "at_speed": mu, "speed": FALL}}


def _by_speed(scene: Scene) -> dict[str, Any]:
    e = path_match(scene, "walls.0.restitution").values[0].value
    return {"walls.0.restitution": {"form": "polynomial", "coefficients": [float(e), 0.0, 0.0]}}


def _by_side(scene: Scene) -> dict[str, Any]:
    return dict.fromkeys(OWN, path_match(scene, "walls.0.restitution").values[0])


def _constant(_scene: Scene) -> dict[str, Any]:
    return dict.fromkeys(RATES, 0.0)


RATES = ("floor.rolling_drag", "floor.spin_drag")
COEFFICIENTS = tuple(f"walls.0.restitution.coefficients.{k}" for k in range(2))
OWN = tuple(f"walls.0.sides.{name}.restitution" for name in ("bottom", "right", "top", "left"))
FORMS = (
    ChangedForm("cushion", "does not yield", lambda _s: {"walls.0.yield_time": 0.0}, ("walls.0.yield_time",)),
    ChangedForm("cushion", "restitution c0 + c1 v", _by_speed, ("walls.0.restitution",), COEFFICIENTS),
    ChangedForm("cushion", "cushions that differ", _by_side, ("walls.0.restitution",), OWN),
    ChangedForm("cloth", "rolling resistance without drag", lambda _s: {"floor.rolling_drag": 0.0}, ("floor.rolling_drag",)),
    ChangedForm("cloth", "constant loss of spin", lambda _s: {"floor.spin_drag": 0.0}, ("floor.spin_drag",)),
    ChangedForm(
        "cloth", "loss of spin that grows with the spin", lambda _s: {"floor.spin_drag": 0.0, "floor.spin_damping": 0.1},
        ("floor.spin_drag",), ("floor.spin_damping",),
    ),
    ChangedForm("cloth", "constant rates", _constant, RATES),
    # (a path on a slope has a closed form only where the rates are constant)
    ChangedForm("cloth", "constant rates, tilted", _constant, RATES, ("floor.slope",)),
    ChangedForm(
        "balls", "friction that falls with the slip", _falling, ("ball_contact.friction",),
        ("ball_contact.friction.at_rest", "ball_contact.friction.at_speed"),
    ),
)  # fmt: skip
"""Forms that are compared with those of :data:`carom.fitting.shots.table.FREE`."""


@dataclass(frozen=True, eq=False)
class _Tried:
    """A form, and the best that has been found for it."""

    change: Callable[[Scene], dict[str, Any]]
    model: TableModel
    values: Array
    starts: list[ShotStart]
    squares: Array
    """(N,) m^2: mean square distances of the shots."""
    deviance: float
    count: int

    @property
    def numbers(self) -> dict[str, float]:
        return dict(zip((one.name for one in self.model.shared), self.values.tolist(), strict=True))

    @property
    def aicc(self) -> float:
        return criterion(self.deviance, len(self.values) + len(self.starts), self.count)


class _Search(NamedTuple):
    """The shots to which forms are fitted."""

    frames: Sequence[int]
    noise: float

    def at(self, one: _Tried, values: Array, starts: Sequence[ShotStart]) -> _Tried:
        """Return a form at values (P,), with copies of starts."""
        mine = [_copied(start) for start in starts]
        squares = mean_squares(one.model.at(values), mine, self.frames)
        found = deviance_of(squares, mine, self.frames, self.noise)
        return _Tried(one.change, one.model, values, mine, squares, *found)

    def descended(self, one: _Tried, values: Array, starts: Sequence[ShotStart], ways: Sequence[bool]) -> _Tried:
        """Return the better of a form's optima below values (P,): from there, and with tables of the shots' own before."""
        found = []
        for loosened in ways:
            mine = [_copied(start) for start in starts]
            fit = fit_shared(one.model, values, mine, self.frames, self.noise, lambda _done: None, loosened)
            found.append(self.at(one, fit.values, mine))
        return min(found, key=lambda tried: tried.deviance)

    def within(self, one: _Tried, other: _Tried) -> _Tried:
        """Return a form at the optimum of another, if that is better: a form that contains another is never farther."""
        if one.deviance <= other.deviance:
            return one
        here = self.at(one, _values_of(one, other)[0], other.starts)
        return here if here.deviance < one.deviance else one

    def searched(self, one: _Tried, other: _Tried, ways: Sequence[bool]) -> _Tried:
        """Return a form searched again from the optimum of another, with the starts of both, if that is better."""
        one, (_same, begin) = self.within(one, other), _values_of(one, other)
        starts = [_copied(mine) for mine in one.starts]
        for mine, more, n in zip(starts, other.starts, self.frames, strict=True):
            mine.pool.append(more.best[n])
        return min(one, self.descended(one, begin, starts, ways), key=lambda tried: tried.deviance)

    def held_out(self, one: _Tried) -> tuple[float, float]:
        """Return the deviance of each half of the shots on the other half's table, and their median distance, m; NaN of few."""
        if len(self.frames) < 2 * FEWEST:
            return float("nan"), float("nan")
        squares = np.zeros(len(self.frames))
        for k in range(2):
            half, rest = (_Search(self.frames[first::2], self.noise) for first in (k, 1 - k))
            found = half.descended(one, one.values, one.starts[k::2], BOTH)
            squares[1 - k :: 2] = rest.at(one, found.values, one.starts[1 - k :: 2]).squares
        return deviance_of(squares, one.starts, self.frames, self.noise)[0], float(np.sqrt(np.median(squares)))


def _copied(one: ShotStart) -> ShotStart:
    return ShotStart(one.shot, one.prior, dict(one.best), list(one.pool))


def _values_of(one: _Tried, other: _Tried) -> tuple[Array, Array]:
    """Return the numbers (P,) of a form at the optimum of another, and those from which its search begins: terms that the other
    does not have are a usual change away from nothing, where some have no derivative."""
    scene = other.model.scene_at(other.values)
    there = one.model.values_in(scene)
    changed = one.model.values_in(replaced(scene, one.change(scene)))
    values = np.where(np.isnan(there), np.where(np.isnan(changed), one.values, changed), there)
    begin = values.copy()
    for k, number in enumerate(one.model.shared):
        if number.name not in other.numbers:
            away = -number.scale if number.name.endswith("at_speed") else number.scale
            begin[k] = np.clip(values[k] + away, number.low, number.high)
    return values, begin


def compare_forms(
    fit: ShotsFit, forms: Sequence[ChangedForm] = FORMS, tell: Callable[[float, str], None] = lambda _done, _text: None
) -> tuple[ComparedForm, ...]:
    """Fit other forms of the cushion, the cloth and the balls to the same shots, and compare them with a fit.

    Each is fitted up to the joint horizon, on one table for all shots. The form of the fit and each other one are searched again
    from the optimum of the other, with the starts of both: from there, and with tables of the shots' own before. A form that
    contains another is never farther from the shots. Forms whose paths the fit does not have are left out. With ten shots or more
    each half of the shots is also compared with the table that the other half gives.

    ``tell(share, text)`` is called as it goes on.
    """
    starts = fit.one_table.starts
    scene, frames = fit.model.scene_at(fit.one_table.values), [frames_of_events(one.shot, fit.events) for one in starts]
    search, chosen, tried = _Search(frames, fit.noise), list[ChangedForm](), list[_Tried]()

    def first(change: Callable[[Scene], dict[str, Any]], paths: tuple[str, ...]) -> _Tried:
        model = replace(fit.model, scene=replaced(scene, change(scene)), paths=paths)
        values = np.array([one.value for one in model.shared])
        return search.at(_Tried(change, model, values, [], values, np.inf, 0), values, starts)

    for form in forms:
        if set(form.without) <= set(fit.model.paths):
            paths = tuple(path for path in fit.model.paths if path not in form.without)
            chosen.append(form)
            tried.append(first(form.change, tuple(dict.fromkeys((*paths, *form.more)))))
    if not chosen:
        return ()
    tried.append(first(lambda _scene: {}, fit.model.paths))
    _search_all(search, tried, lambda done, k: tell(0.7 * done, f"form: {chosen[k].name}"))
    own, found = tried.pop(), []
    mine = search.held_out(own)
    for k, (form, other) in enumerate(zip(chosen, tried, strict=True)):
        tell(0.7 + 0.3 * k / len(chosen), f"form: {form.name}, held out")
        more = {name: x for name, x in other.numbers.items() if name not in own.numbers}
        nearer = (int((other.squares < own.squares).sum()), len(frames))
        held, above = search.held_out(other), other.deviance - own.deviance
        found.append(
            ComparedForm(
                form.part, form.name, other.aicc - own.aicc, above, more, nearer, held[0] - mine[0], (held[1], mine[1])
            )
        )
    return tuple(found)


def searched_together(fits: Sequence[ShotsFit], tell: Callable[[float, str], None]) -> list[ShotsFit]:
    """Return fits of several laws to the same shots, each searched again from the optimum of the best, and the best from theirs.

    Where each was searched for by itself, the place at which a search ends would decide between laws.
    """
    order = sorted(fits, key=lambda one: -one.aicc)
    search = _Search([frames_of_events(one.shot, order[-1].events) for one in order[-1].starts], order[-1].noise)
    tried = []
    for one in order:
        values, starts = one.one_table
        model = replace(one.model, scene=one.model.scene_at(values))
        tried.append(search.at(_Tried(lambda _scene: {}, model, values, [], values, np.inf, 0), values, starts))
    _search_all(search, tried, lambda done, k: tell(done, f"{order[k].law.name}: from the other's optimum"))
    return [replace(one, deviance=min(one.deviance, found.deviance)) for one, found in zip(order, tried, strict=True)]


def _search_all(search: _Search, tried: list[_Tried], tell: Callable[[float, int], None]) -> None:
    """Search for each form, and the fit's own, the last, from each other's optimum; and from those of forms with fewer numbers."""
    own = len(tried) - 1
    smaller = [(k, j) for k in range(own) for j in range(own) if set(tried[j].model.paths) < set(tried[k].model.paths)]
    pairs = [pair for k in range(own) for pair in ((k, own), (own, k))] + smaller
    for turn in range(ROUNDS):
        before = [one.deviance for one in tried]
        for i, (k, j) in enumerate(pairs):
            tell((turn + i / len(pairs)) / ROUNDS, min(k, j))
            tried[k] = search.searched(tried[k], tried[j], BOTH if turn == 0 else BOTH[:1])
        if all(old - one.deviance < ENOUGH for old, one in zip(before, tried, strict=True)):
            break
    old: list[_Tried] = []
    while old != tried:
        old = list(tried)
        for k, j in pairs:
            tried[k] = search.within(tried[k], tried[j])
