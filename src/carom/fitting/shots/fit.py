"""Fit whole shots, from the stroke to rest: an own start for each, and the numbers of the table that all share."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError, FaultList, did_you_mean
from carom.files import require_library
from carom.fitting.evidence import DECIDED, LEANS, Ranked, verdict_words, weigh
from carom.fitting.laws import FittedLaw, track_laws_named
from carom.fitting.result import Estimate
from carom.fitting.shots.film import FilmedShot, Films, filmed_shots
from carom.fitting.shots.joint import JointFit, fit_shared, frames_of_events, information_of_shots
from carom.fitting.shots.result import FittedShot, ShotsFit, ShotsRanking
from carom.fitting.shots.search import SearchSettings, ShotStart, refined, rms, search_start
from carom.fitting.shots.start import FIRST_PLACE, SPIN, VELOCITY, distances
from carom.fitting.shots.table import FREE, TableModel, TableNumbers, scene_of_films, with_balls
from carom.fitting.tracks.errors import covariance_by_shot
from carom.laws.registry import one_or_several
from carom.public.progress import Progress
from carom.scene.paths import path_match, replaced
from carom.scene.scene import Scene
from carom.tracks.film_tracks import films_of

__all__ = ["fit_shots"]

Array = NDArray[np.float64]
DURATION = 60.0  # s: no shot takes longer
JOINT = (3, 4, 6)  # events up to which the shared numbers are fitted, one after the other
KEPT = 12  # starts of earlier searches that are tried again
LAW = "two-step"
FOLLOWED = 1.3  # ratio of the median distance to the noise, up to which the frames' noise alone gives the errors
FEWEST = 5  # shots for errors from their scatter
SURE, HINT = 0.01, 0.1  # as for whole tracks


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
    of all shots, in which no error has grown much yet.

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
    found, reading = films_of(tracks, scale=scale, rate=rate, where=where)
    films = filmed_shots(found, ball)
    balls = max(len(one.balls) for one in films.shots)
    scene = scene_of_films(table, films.walls, radius, balls, DURATION, "fit_shots")
    scene = replaced(scene, dict(fix)) if fix else scene
    paths = _paths(scene, FREE if free is None else free, fix or {})
    fits = []
    for number, law in enumerate(chosen):

        def tell(done: float, text: str, number: int = number, law: FittedLaw = law) -> None:
            if progress is not None:
                progress(number + done, len(chosen), f"{law.name}: {text}" if len(chosen) > 1 else text)

        model = _model(scene, law, paths, bound or {})
        fits.append(_fit_law(model, law, films, seed, tell))
    fits.sort(key=lambda one: one.aicc)
    return _ranked(fits, [*reading, *films.notes, *notes])


def _paths(scene: Scene, free: Sequence[str], fixed: Mapping[str, float]) -> tuple[str, ...]:
    """Return the paths that are fitted; CaromError for one that leads nowhere, or a ball's."""
    faults = FaultList("fit_shots")
    kept = []
    for path in dict.fromkeys([free] if isinstance(free, str) else free):
        if path in fixed:
            continue
        match = faults.attempt(path_match, scene, path, "fit_shots: free")
        if match is None:
            continue
        if path.startswith("balls."):
            faults.add("free", "a number of the table", f"{path}: the start of each shot is fitted anyway")
        value = match.values[0]
        form = getattr(value, "form", "constant")
        if form == "constant":
            kept.append(path)
        else:
            kept += [f"{path}.{name}" for name in type(value).model_fields if name != "form"]
    faults.raise_if_any()
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
        changes |= held
    else:
        held = {path: value for path, value in held.items() if value is not None}
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


def _fit_law(
    model: TableModel, law: FittedLaw, films: Films, seed: int, tell: Callable[[float, str], None]
) -> ShotsFit:
    """Fit one law: starts up to the first events, shared numbers there, and so on; then all shots to rest."""
    values = np.array([one.value for one in model.shared])
    settings = SearchSettings()
    starts: list[ShotStart | None] = [None] * len(films.shots)
    rounds = JOINT if len(values) else ()
    fitted: JointFit | None = None

    def searched(part: float, share: float, events: int | None) -> list[ShotStart]:
        table, found = model.at(values), []
        for i, shot in enumerate(films.shots):
            tell(part + share * i / len(films.shots), f"{shot.name or 'film'}: start")
            old = starts[i]
            last = None if events is None else frames_of_events(shot, events)
            rng = np.random.default_rng([seed, i, events or 0])
            found.append(
                search_start(table, shot, films.noise, rng, settings, before=old.pool[-KEPT:] if old else (), last=last)
            )
        return found

    for turn, events in enumerate(rounds):
        part, share = 0.6 * turn / len(rounds), 0.6 / len(rounds)
        if turn == 0 or events > 4:
            starts = [*searched(part, share / 2, max(events, 4))]
        ready = [one for one in starts if one is not None]
        frames = [frames_of_events(one.shot, events) for one in ready]
        fitted = fit_shared(
            model, values, ready, frames,
            functools.partial(_said, tell, part, share),
        )  # fmt: skip
        values = fitted.values
    final = searched(0.6, 0.4, None)
    table = model.at(values)
    shots = tuple(_fitted(table, model, one) for one in final)
    return _with_errors(model, law, films, shots, values, final, fitted, table)


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
    a = table.scene.balls[0].radius
    balls = []
    for k, name in enumerate(shot.balls):
        old, place = table.scene.balls[k], best[FIRST_PLACE + 2 * k : FIRST_PLACE + 2 * k + 2]
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
    return FittedShot(shot, best, with_balls(table.scene, balls), far, by_horizon)


def _with_errors(
    model: TableModel, law: FittedLaw, films: Films, shots: tuple[FittedShot, ...], values: Array, starts: Sequence[ShotStart],
    fitted: JointFit | None, table: TableNumbers,
) -> ShotsFit:  # fmt: skip
    """Return the fit with the errors of the shared numbers, and its deviance at the joint horizon."""
    shared, p = model.shared, len(model.shared)
    events = JOINT[-1]
    frames = [frames_of_events(one.shot, events) for one in starts]
    found = [refined(table, one, n, 9, 2) for one, n in zip(starts, frames, strict=True)]
    squares = np.array(
        [rms(table, one.shot, got.start, n) ** 2 for one, n, got in zip(starts, frames, found, strict=True)]
    )
    counts = np.array([_independent(one.shot, n) for one, n in zip(starts, frames, strict=True)])
    deviance = float((counts * np.log(squares + films.noise**2)).sum())
    covariance = np.zeros((p, p))
    stderr: list[float | None] = [None] * p
    by_shots = False
    if p and fitted is not None:
        used = [i for i, n in enumerate(fitted.frames) if n]
        some = [starts[i] for i in used]
        ends = [fitted.frames[i] for i in used]
        got = [refined(table, one, n, 9, 2) for one, n in zip(some, ends, strict=True)]
        scores, matrices, _follows = information_of_shots(table, some, ends, got, p)
        scale = np.array([one.scale for one in shared])
        scores, matrices = scores * scale, matrices * scale[:, None] * scale
        far = [rms(table, one.shot, start.start, n) for one, n, start in zip(some, ends, got, strict=True)]
        frames_each = np.array([2 * one.shot.known[:n].sum() for one, n in zip(some, ends, strict=True)])
        matrix = matrices.sum(axis=0) + 1e-12 * np.eye(p)
        if np.median(far) < FOLLOWED * math.sqrt(2) * films.noise or len(some) < FEWEST:
            # (each shot's information is that of its frames over its mean square)
            covariance = np.linalg.inv((matrices * frames_each[:, None, None]).sum(axis=0) + 1e-9 * np.eye(p))
        else:
            covariance, by_shots = covariance_by_shot(matrix, scores, matrices), True
        covariance = covariance * scale[:, None] * scale
        stderr = [float(x) for x in np.sqrt(np.maximum(np.diag(covariance), 0.0))]
    estimates = {}
    for one, value, error in zip(shared, values.tolist(), stderr, strict=True):
        bound = min(value - one.low, one.high - value) < 1e-9 * max(abs(one.high - one.low), 1e-9)
        estimates[one.name] = Estimate(value, None if bound else error, "at its bound" if bound else "")
    return ShotsFit(
        law, table.scene, shots, estimates, covariance, deviance, int(counts.sum()), events, films.noise, by_shots,
    )  # fmt: skip


def _independent(shot: FilmedShot, frames: int) -> int:
    """Return how many independent numbers the frames up to a horizon are: two for each ball that moves and each stretch."""
    until = shot.time[frames - 1]
    met = sum(1 + (one.kind == "ball") for one in shot.events if one.high <= until)
    return 2 * (1 + met)


def _ranked(fits: list[ShotsFit], notes: list[str]) -> ShotsRanking:
    from scipy.stats import wilcoxon

    best, evidence = fits[0], weigh(fits)
    closer, chance, support, reason = None, math.nan, evidence.odds, ""
    if evidence.rival is not None:
        ratio = np.log([b.rms / a.rms for a, b in zip(best.shots, evidence.rival.shots, strict=True)])
        chance = float(wilcoxon(ratio).pvalue) if len(ratio) > 1 and np.any(ratio != 0) else 1.0
        closer = (int((ratio > 0).sum()), len(ratio))
        support = 0.0 if chance > HINT or closer[0] <= closer[1] / 2 else LEANS if chance > SURE else DECIDED
        reason = f"nearer than {evidence.rival.law.name} in {closer[0]} of {closer[1]} shots"
    words = verdict_words(best.law.called, evidence, "the shots", support, reason)
    lost = [one for one in best.shots if not one.followed]
    if lost:
        words += f"; {len(lost)} of {len(best.shots)} shots are not followed to the end"
    ranked = tuple(Ranked(fit, weight) for fit, weight in zip(fits, evidence.weights.tolist(), strict=True))
    return ShotsRanking(
        ranked, f"{words[0].upper()}{words[1:]}.", math.nan, evidence.rival.law.name if evidence.rival else "",
        tuple(dict.fromkeys(notes)), closer, chance, evidence.rival is not None and support >= DECIDED,
    )  # fmt: skip
