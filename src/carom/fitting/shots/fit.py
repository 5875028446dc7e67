"""Fit whole shots, from the stroke to rest; and films of shots with known truth."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError, FaultList, did_you_mean
from carom.files import require_library
from carom.fitting.evidence import weigh
from carom.fitting.identify import Identified
from carom.fitting.laws import FittedLaw, track_laws_named
from carom.fitting.result import Estimate
from carom.fitting.shots.joint import (
    FEWEST,
    PRIOR_WIDTH,
    WIDTH,
    JointFit,
    Optimum,
    deviance_of,
    fit_scatter,
    fit_shared,
    frames_of_events,
    identified,
    mean_squares,
    one_table,
    searched_together,
)
from carom.fitting.shots.result import (
    FREE,
    FittedShot,
    Halves,
    OneTable,
    ShotsFit,
    ShotsRanking,
    TableModel,
    begun,
    of_table,
    scene_of_films,
    table_of,
    with_balls,
)
from carom.fitting.shots.search import (
    FAILED,
    FIRST_PLACE,
    SPIN,
    VELOCITY,
    Films,
    SearchSettings,
    ShotStart,
    distances,
    filmed_shots,
    refined,
    require_on_table,
    rms,
    search_start,
    start_size,
)
from carom.fitting.table_numbers import TableNumbers, compared_by_shots
from carom.formatting import counted
from carom.laws.registry import one_or_several
from carom.public.progress import Progress
from carom.scene.scene import Scene
from carom.scene.schema import Model
from carom.scene.toml import path_match, replaced
from carom.simulation.simulate import simulate
from carom.tracks.films import tracks_of_films
from carom.tracks.formats.tables import Calibration
from carom.tracks.track import Track

Array = NDArray[np.float64]
DURATION = 60.0  # s: no shot takes longer
JOINT = (3, 4, 6)  # events up to which the shared numbers are fitted, one after the other
AGAIN = 2  # times that shots are fitted once more with other draws: few while one is not followed, at last by a wider search
FAR, DRAWS = 2.0, 2  # of the median distance: shots that are searched again at last, and how often with other draws
KEPT = 12  # starts of earlier searches that are tried again
LAW = "two-step"
# Where the table is free, too: a start with any side spin would come near the film on a wrong one, and each takes longer.
OWN_TABLE = SearchSettings(descents=3, evaluations=6, anew=0.0)


def fit_shots(
    tracks: str | Path | Sequence[Any] | Any,
    table: Scene | None = None,
    radius: float | None = None,
    *,
    laws: str | Sequence[str] | None = None,
    free: Sequence[str] | None = None,
    fix: Mapping[str, float] | None = None,
    bound: Mapping[str, tuple[float, float]] | None = None,
    rate: float | None = None,
    scale: float | None = None,
    where: Any = (),
    seed: int = 0,
    progress: Progress | None = None,
) -> ShotsRanking:
    """Fit whole filmed shots, from the stroke to rest, with all balls and all their contacts, as ``carom fit`` with ``shot``.

    Each shot has an unknown start: when the cue ball sets off, its velocity and spin, and the places of all balls (known to a
    millimetre). All shots share the numbers of the table. The horizon grows from event to event; starts descend with exact
    derivatives through all contacts, beside others that are drawn at each event; the shared numbers are fitted to the first events
    of all shots, in which no error has grown much yet. Ten shots or more are fitted in two halves, too, each from scratch: error
    bars are as wide as their differences are.

    Parameters
    ----------
    tracks : path, sequence of paths, columns, or Tracks
        Films of one table from above, all balls, beginning before the stroke: what :func:`carom.measure_tracks` takes.
    table : Scene, optional
        A floor and a wall of the shape table, with the numbers from which the fit begins; the radius of its first ball. Default: a
        carom table between the cushions of the films.
    radius : float
        Of the balls, m; default: the table's.
    laws : str or sequence of str, optional
        Names of cushions' laws to compare. Default: two-step.
    free : sequence of str, optional
        Paths of the scene's numbers that are fitted. Default: restitution, friction and place of the cushions, the cloth's
        friction, rolling resistance and loss of spin, restitution and friction of the balls.
    fix, bound : mapping, optional
        Numbers of the scene that are held, and bounds of fitted ones, by path.
    rate, scale : float, optional
        Frames per second, and metres per unit of the films.
    where : optional
        The tracks that enter, ``"shot=NAME"`` or ``"ball=NAME"``.
    seed : int
        Of the starts that are drawn; one seed gives the same answer.
    progress : callable(done, total, text), optional

    Returns
    -------
    ShotsRanking
        ``best.estimates``, ``best.shots`` (start, distances, events that only film or model have), ``describe()``.

    Raises
    ------
    CaromError
        One line per problem: no stroke, a film that begins in the middle of a shot, films of different tables, an unknown path.

    Examples
    --------
    >>> import carom
    >>> from carom.fitting.shots import drawn_films
    >>> tracks, scenes = drawn_films(2, seed=5, until=3.0)
    >>> free = ["walls.0.restitution"]
    >>> ranking = carom.fit_shots(tracks, scenes[0], free=free)
    >>> round(ranking.best.estimates["walls.0.restitution"].value, 2)
    0.85
    """
    require_library("scipy", "fit")
    if not isinstance(seed, int) or seed < 0:
        raise CaromError(f"fit_shots: seed: expected a whole number of at least 0, got {seed!r:.60}")
    if table is not None and not isinstance(table, Scene):
        raise CaromError(f"fit_shots: table: expected a carom.Scene, got {type(table).__name__}")
    if radius is None and table is None:
        raise CaromError("fit_shots: `radius`: expected the balls' radius in m, got none; a carom ball has 30.75 mm")
    names = one_or_several("fit_shots", laws) if laws else [LAW]
    chosen, notes = track_laws_named(names, False)
    ball = radius or (table.balls[0].radius if table is not None else 0.0)
    found, reading = tracks_of_films(tracks, Calibration(scale, rate), where)
    films = filmed_shots(found, ball)
    balls = max(len(one.balls) for one in films.shots)
    scene = scene_of_films(table, films, radius, balls, DURATION, "fit_shots")
    scene = replaced(scene, dict(fix)) if fix else scene
    require_on_table(films.shots, table_of(scene), ball)
    wanted = [free] if isinstance(free, str) else list(FREE if free is None else free)
    _check_paths(scene, wanted)
    scene, paths = begun(scene, [path for path in wanted if path not in (fix or {})])
    paths = _paths(scene, paths)
    fits: list[ShotsFit] = []
    together = len(chosen) > 1 and len(films.shots) >= FEWEST
    steps = len(chosen) + together

    def tell(done: float, text: str) -> None:
        if progress is not None:
            progress(len(fits) + done, steps, text)

    for law in chosen:
        model = _model(scene, law, paths, bound or {})

        def of_law(done: float, text: str, law: FittedLaw = law) -> None:
            tell(done, f"{law.name}: {text}" if len(chosen) > 1 else text)

        fits.append(_fit_law(model, law, films, seed, of_law))
    if together and paths:
        fits = searched_together(fits, tell)
    fits.sort(key=lambda one: one.aicc)
    return _ranked(fits, [*reading, *films.notes, *notes])


def _check_paths(scene: Scene, free: Sequence[str]) -> None:
    """Raise CaromError for a path that leads nowhere, or a ball's."""
    faults = FaultList("fit_shots")
    for path in free:
        if faults.attempt(path_match, scene, path, "fit_shots: free") is not None and path.startswith("balls."):
            faults.add("free", "a number of the table", f"{path}: the start of each shot is fitted anyway")
    faults.raise_if_any()


def _paths(scene: Scene, free: Sequence[str]) -> tuple[str, ...]:
    """Return the paths that are fitted, of a form of the restitution or friction its numbers."""
    kept = []
    for path in free:
        value = path_match(scene, path).values[0]
        form = getattr(value, "form", "falling" if isinstance(value, Model) else "constant")
        kept += (
            [path] if form == "constant" else [f"{path}.{name}" for name in type(value).model_fields if name != "form"]
        )
    return tuple(kept)


def _model(
    scene: Scene, law: FittedLaw, paths: tuple[str, ...], bound: Mapping[str, tuple[float, float]]
) -> TableModel:
    """Return the table with a law, which may hold some of the numbers."""
    engine = law.engine
    assert engine is not None
    changes: dict[str, Any] = {"run.law": engine.law, "run.floor_contact": engine.floor_contact}
    held = {"walls.0.friction": law.pinned.get("friction"), "walls.0.restitution": law.pinned.get("restitution")}
    if not engine.surface:
        held = {"walls.0.friction": None, "walls.0.restitution": None}
    else:
        held = {path: value for path, value in held.items() if value is not None}
    held |= {path: held[of_table(path)] for path in paths if of_table(path) in held}
    changes |= held
    model = TableModel(replaced(scene, changes), tuple(path for path in paths if path not in held), bound)
    strange = [name for name in bound if name not in {one.name for one in model.shared}]
    if strange and not held:
        known = [one.name for one in model.shared]
        raise CaromError(
            *(
                f"fit_shots: bound: expected a fitted number, got {name!r}; {did_you_mean(name, known)}"
                for name in strange
            )
        )
    return model


@dataclass(frozen=True, eq=False)
class _Together:
    """The fit of one law's shared numbers to all shots, with the starts that go with them."""

    model: TableModel
    films: Films
    seed: int
    tell: Callable[[float, str], None]

    @property
    def few(self) -> bool:
        """Whether the shots are too few for errors from their scatter."""
        return len(self.films.shots) < FEWEST

    def searched(
        self, values: Array, starts: Sequence[ShotStart | None], part: float, share: float, events: int | None = None,
        widths: Array | None = None, turn: int = 0,
    ) -> list[ShotStart]:  # fmt: skip
        """Search a start for each shot, on a table with such numbers, up to so many events."""
        table, found = self.model.at(values), []
        own = self.few and len(values) > 0
        settings = OWN_TABLE if own else SearchSettings()
        widths = PRIOR_WIDTH * np.array([one.scale for one in self.model.shared]) if own else widths
        for i, (shot, old) in enumerate(zip(self.films.shots, starts, strict=True)):
            self.tell(part + share * i / len(self.films.shots), f"{shot.name or 'film'}: start")
            last = None if events is None else frames_of_events(shot, events)
            rng = np.random.default_rng([self.seed, i, turn if self.few else events or 0])
            before, wider = old.pool[-KEPT:] if old else (), not own or turn == AGAIN
            found.append(search_start(table, shot, self.films.noise, rng, settings, before, last, widths, wider))
        return found

    def fitted(
        self, values: Array, starts: Sequence[ShotStart], part: float, share: float, events: int, loosened: bool = True
    ) -> JointFit:
        """Fit the numbers up to so many events of each shot."""
        frames = [frames_of_events(one, events) for one in self.films.shots]
        tell = functools.partial(_said, self.tell, part, share)
        return fit_shared(self.model, values, starts, frames, self.films.noise, tell, loosened)

    def of_few(self, values: Array) -> tuple[JointFit, list[ShotStart]]:
        """Fit to all events; while a shot is not followed, once more with other draws: a wrong table holds its shots astray."""
        none, share, ends = [None] * len(self.films.shots), 0.6 / (1 + AGAIN), list[tuple[JointFit, list[ShotStart]]]()
        for turn in range(1 + AGAIN):
            old = none if turn < AGAIN else min(ends, key=_farness)[1]
            own = self.searched(values, old, turn * share, share / 2, self.events, turn=turn)
            middle, starts = one_table(self.model, values, own)
            found = self.fitted(middle, starts, turn * share, share, self.events)
            ends.append((found, starts))
            if not _lost(self.model.at(found.values), found, self.films):
                break
        return min(ends, key=_farness)

    def of_many(self, values: Array) -> tuple[JointFit, list[ShotStart]]:
        """Fit to the first events of all shots, then to more."""
        starts, share = list[ShotStart](), 0.6 / len(JOINT)
        for turn, events in enumerate(JOINT):
            if turn == 0 or events > 4:
                old: Sequence[ShotStart | None] = starts or [None] * len(self.films.shots)
                starts = self.searched(values, old, turn * share, share / 2, max(events, 4))
            found = self.fitted(values, starts, turn * share, share, events)
            values = found.values
        for turn in range(AGAIN):
            self.searched_again(values, starts, turn)
            found = self.fitted(values, starts, 0.6, 0.0, events, loosened=False)
            values = found.values
        return found, starts

    def searched_again(self, values: Array, starts: Sequence[ShotStart], turn: int) -> None:
        """Search the shots that are far again, with other draws and without the starts so far; the pools take what is found."""
        table, frames = self.model.at(values), [frames_of_events(one, self.events) for one in self.films.shots]
        far = mean_squares(table, starts, frames)
        for i in np.flatnonzero(far > FAR**2 * np.median(far)).tolist():
            one = starts[i]
            self.tell(0.6, f"{one.shot.name or 'film'}: start")
            for draw in range(DRAWS):
                rng = np.random.default_rng([self.seed, i, turn, draw])
                other = search_start(
                    table, one.shot, self.films.noise, rng, SearchSettings(), last=frames[i], wider=False
                )
                one.pool.append(other.best[max(other.best)])

    @property
    def events(self) -> int:
        """Number of events up to which the numbers are fitted at last."""
        return max(len(shot.events) for shot in self.films.shots) if self.few else JOINT[-1]


def _fit_law(
    model: TableModel, law: FittedLaw, films: Films, seed: int, tell: Callable[[float, str], None]
) -> ShotsFit:
    """Fit one law: the shared numbers, their error bars by two halves of the shots, then all shots to rest."""
    share = 0.5 if len(model.shared) and len(films.shots) >= 2 * FEWEST else 1.0
    together = _Together(model, films, seed, lambda done, text: tell(share * done, text))
    found, halves = _shared_numbers(together), Halves()
    if share < 1:
        halves = _halves(replace(together, tell=lambda done, text: tell(0.35 + 0.25 * done, text)), law)
    values, final = found.values, found.starts
    known = Identified(np.zeros((0, 0)), {}, (), ())
    if found.optimum is not None:
        known = identified(found.optimum, law.name, halves.enlarge)
    if found.widths is not None:
        final = replace(together, tell=tell).searched(values, final, 0.7, 0.3, widths=found.widths)
    table = model.at(values)
    shots = tuple(_fitted(table, model, one) for one in final)
    return ShotsFit(
        law, model.scene_at(values), shots, known.estimates, known.covariance, *found.likelihood, together.events, films.noise,
        found.widths is not None, known.degenerate, known.untold, model=model, values=values, widths=found.widths,
        starts=tuple(found.starts), one_table=found.one_table, halves=halves,
    )  # fmt: skip


@dataclass(frozen=True, eq=False)
class _Numbers:
    """The shared numbers of shots, and the starts that go with them; ``optimum`` is None where no number is free."""

    values: Array
    starts: list[ShotStart]
    likelihood: tuple[float, int]
    one_table: OneTable
    optimum: Optimum | None = None
    widths: Array | None = None


def _shared_numbers(together: _Together) -> _Numbers:
    """Search the shared numbers: starts up to the first events, the numbers there, and so on; then their scatter between shots."""
    model, shots, noise = together.model, together.films.shots, together.films.noise
    values = np.array([one.value for one in model.shared])
    frames = [frames_of_events(one, together.events) for one in shots]
    if not len(values):
        ready = together.searched(values, [None] * len(shots), 0.7, 0.3)
    else:
        fitted, ready = (together.of_few if together.few else together.of_many)(values)
        values = fitted.values
    likelihood = deviance_of(mean_squares(model.at(values), ready, frames), ready, frames, noise)
    found = _Numbers(values, ready, likelihood, OneTable(values, tuple(ready)))
    if not len(values):
        return found
    if together.few:
        return replace(found, optimum=Optimum.of_few(model, fitted, ready))
    begin = WIDTH * np.array([one.scale for one in model.shared])
    scattered = fit_scatter(
        model, values, ready, frames, begin, noise, functools.partial(_said, together.tell, 0.6, 0.1)
    )
    return replace(
        found, values=scattered.values, starts=scattered.starts, widths=scattered.widths,
        optimum=Optimum.of_scatter(model, scattered, frames),
    )  # fmt: skip


def _halves(together: _Together, law: FittedLaw) -> Halves:
    """Return how far apart two halves of the shots are, each searched from scratch: a half that begins from the fit to all has seen
    the other. A search ends beside the optimum, and laws miss some of what a ball does; the curvature knows of neither.
    """

    def estimates(k: int) -> dict[str, Estimate]:
        def tell(done: float, text: str) -> None:
            together.tell(0.7 * k + done, f"half {k + 1}: {text}")

        some = together.films._replace(shots=together.films.shots[k::2])
        optimum = _shared_numbers(replace(together, films=some, tell=tell)).optimum
        assert optimum is not None
        return identified(optimum, law.name).estimates

    apart = [
        (one.value - other.value) / math.hypot(one.stderr, other.stderr)
        for one, other in zip(estimates(0).values(), estimates(1).values(), strict=True)
        if one.stderr and other.stderr and one.value is not None and other.value is not None
    ]
    return Halves(float(np.square(apart).sum()), len(apart))


def _farness(end: tuple[JointFit, object]) -> tuple[int, float]:
    """Return the number of shots that are left out, and the objective of the others."""
    return end[0].frames.count(0), end[0].objective


def _lost(table: TableNumbers, fitted: JointFit, films: Films) -> bool:
    """Return whether a shot is not followed as far as the shared numbers were fitted."""
    each = zip(films.shots, fitted.found, fitted.frames, strict=True)
    return any(not n or rms(table, shot, found.start, n) >= FAILED for shot, found, n in each)


def _said(tell: Callable[[float, str], None], part: float, share: float, done: float) -> None:
    tell(part + share * (1 + done) / 2, "numbers of the table")


def _fitted(table: TableNumbers, model: TableModel, start: ShotStart) -> FittedShot:
    """Return a shot beside its film, with its distances up to all horizons."""
    shot, by_horizon, best = start.shot, {}, None
    for name, frames in shot.horizons.items():
        found = refined(table, start, frames, 30 if name == "whole" else 9, 2)
        by_horizon[name] = rms(table, shot, found.start, frames)
        best = found.start
    assert best is not None
    known = shot.known
    far = np.full(known.shape, np.nan)
    squared = np.zeros(known.shape)
    squared[known] = distances(table, shot, best[None], len(shot.time))[0]
    far[shot.measured] = np.sqrt(squared[shot.measured])
    own = start_size(len(shot.balls))
    scene = model.scene_at(table.at_deviations(best[own:]) if len(best) > own else table.values)
    a = scene.balls[0].radius
    balls = []
    for k, name in enumerate(shot.balls):
        old, place = scene.balls[k], best[FIRST_PLACE + 2 * k : FIRST_PLACE + 2 * k + 2]
        moves: dict[str, Any] = {}
        if k == 0:
            moves = {"velocity": tuple(best[VELOCITY].tolist()), "spin": tuple((best[SPIN] / a).tolist())}
        given: dict[str, Any] = {
            "radius": a,
            "mass": old.mass,
            "inertia": old.inertia,
            "name": name,
            "position": tuple(place.tolist()),
        }
        balls.append(given | moves)
    deviations = dict(zip((one.name for one in model.shared), best[own:].tolist(), strict=False))
    return FittedShot(shot, best[:own], with_balls(scene, balls), far, by_horizon, deviations)


def _ranked(fits: list[ShotsFit], notes: list[str]) -> ShotsRanking:
    best = fits[0]
    if best.count <= best.k + 1:
        few = f"{counted(len(best.shots), 'shot')} with {best.count} independent numbers for {best.k} that are fitted"
        notes = [*notes, f"{few}: AIC instead of AICc; fit fewer numbers, or film more shots"]
    lost = sum(not one.followed for one in best.shots)
    compared = compared_by_shots(
        fits, weigh(fits), lambda fit: np.array([one.rms for one in fit.shots]), "the shots",
        more=f"; {lost} of {len(best.shots)} shots are not followed to the end" if lost else "",
        alone=f"the median distance of its shots from the films is {1e3 * best.median():.3g} mm to rest",
    )  # fmt: skip
    return ShotsRanking(**compared, notes=tuple(dict.fromkeys(notes)))


# ----------------------------------------------------------------------------------------------------
# Films of shots that carom draws, with known truth: what a fit has to find again.


RADIUS, MASS, GRAVITY = 0.03075, 0.21, 9.80665
SPIN_LOSS = 5.0  # rad/s^2


def drawn_films(
    count: int, *, seed: int = 0, noise: float = 1.5e-3, rate: float = 50.0, until: float = 12.0, law: str = "two-step",
    numbers: Mapping[str, float] | None = None, scatter: Mapping[str, float] | None = None,
) -> tuple[list[Track], list[Scene]]:  # fmt: skip
    """Draw shots on a carom table, and films of them: tracks of three balls, and the scenes with the true numbers.

    The cue ball hits another ball first. ``noise``: of one coordinate, m; ``rate``: frames per second; ``until``: length of a
    film, s. ``numbers``: of the table, by their paths in the scene; ``scatter``: standard deviations between shots, as shares of
    these numbers.

    Examples
    --------
    >>> from carom.fitting.shots import drawn_films
    >>> tracks, scenes = drawn_films(2, seed=1)
    >>> [track.group for track in tracks], len(scenes)
    (['shot 1', 'shot 1', 'shot 1', 'shot 2', 'shot 2', 'shot 2'], 2)
    """
    rng = np.random.default_rng(seed)
    tracks, scenes = list[Track](), list[Scene]()
    ball: dict[str, Any] = {"radius": RADIUS, "mass": MASS}
    half = np.array([1.42, 0.71]) - 0.15
    while len(scenes) < count:
        places = rng.uniform(-half, half, (3, 2)) + np.array([1.42, 0.71])
        gaps = [np.hypot(*(places[i] - places[j])) for i, j in ((0, 1), (0, 2), (1, 2))]
        if min(gaps) < 0.25 or gaps[0] > 1.6:
            continue
        way = places[1] - places[0]
        aside = rng.uniform(-0.75, 0.75) * 2 * RADIUS
        angle = math.atan2(way[1], way[0]) + math.asin(aside / float(np.hypot(*way)))
        speed, side, follow = rng.uniform(2.5, 5.0), rng.uniform(-0.6, 0.6), rng.uniform(-0.3, 0.9)
        v = speed * np.array([math.cos(angle), math.sin(angle)])
        w = speed / RADIUS * np.array([-follow * math.sin(angle), follow * math.cos(angle), side])
        given: dict[str, Any] = {
            "floor": {"friction": 0.19, "rolling_resistance": 0.006, "spin_friction": 0.4 * RADIUS * SPIN_LOSS / GRAVITY},
            "walls": [{"shape": "table", "length": 2.84, "width": 1.42, "center": (1.42, 0.71), "nose_height": 0.037,
                       "restitution": 0.85, "friction": 0.2}],
            "balls": [ball | {"name": "1", "position": tuple(places[0]), "velocity": tuple(v), "spin": tuple(w)},
                      ball | {"name": "2", "position": tuple(places[1])}, ball | {"name": "3", "position": tuple(places[2])}],
            "ball_contact": {"restitution": 0.94, "friction": 0.06}, "run": {"duration": 60.0, "law": law},
        }  # fmt: skip
        scene = replaced(Scene(**given), dict(numbers or {}))
        for path, share in (scatter or {}).items():
            own = path_match(scene, path).values[0]
            scene = replaced(scene, {path: getattr(own, "value", own) * (1 + share * rng.normal())})
        run = simulate(scene)
        first = next((event for event in run.events if event.kind in ("ball", "wall")), None)
        if first is None or first.kind != "ball":
            continue
        begins = rng.uniform(0.0, 1 / rate)
        time = np.arange(int(min(until, run.end) * rate)) / rate
        places_seen = np.asarray(run.at(np.clip(time - begins, 0.0, run.end)).position)
        name = f"shot {len(scenes) + 1}"
        for k in range(3):
            seen = places_seen[:, k, :2] + rng.normal(0.0, noise, (len(time), 2))
            tracks.append(Track(str(k + 1), time, seen, group=name))
        scenes.append(replaced(scene, {"run.duration": 60.0}))
    return tracks, scenes
