"""The explorer as one HTML file: the engine's module, the page's script and styles, presets, a scene and measured rebounds."""

from __future__ import annotations

import base64
import functools
import gzip
import html
import json
import os
import re
import tomllib
from collections.abc import Iterable, Sequence
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.data.rebound_files import read_rebounds
from carom.data.rebounds import Rebounds
from carom.errors import CaromError, Fault, FaultList, collected, require_type, shortened_list, suggestion
from carom.explorer.module import ASSETS, MOST_BALLS, MOST_FEATURES, engine_bytes, engine_layout
from carom.files import as_path, require_writable, write_text
from carom.laws.law import Law
from carom.laws.registry import law_named, law_styles, one_or_several
from carom.laws.registry import laws as all_laws
from carom.scene.scene import Scene, scene_dict
from carom.scene.schema import Model
from carom.scene.shapes import FigureWall
from carom.scene.shapes.planes import Plane
from carom.scene.toml import load_scene
from carom.scene.wall import WallShape, law_name
from carom.simulation.simulate import simulate
from carom.simulation.trajectory import Trajectory
from carom.tracks.read import film_of
from carom.tracks.track import Track

PageFilm = list[list[list[float]]]
"""Of each ball of a scene the rows of a film: s after the start of the scene, x and y in m."""
BEFORE_FILM_S = 0.2  # that a scene may begin before the film does
STARTS, FRAMES = 400, 60  # starts of the scene that are tried, and frames at which they are compared
STEP_S, MOST_PLACES = 0.002, 20_000  # of the run, between which a ball is taken to go straight
FAR = 0.3  # m: a frame that is farther from the run counts as this far


def fitted_shots(given: Any) -> tuple[Any, ...]:
    """Return the shots of a fit to whole shots, of a ranking of such fits, or one shot; none of anything else.

    A shot (:class:`carom.fitting.shots.FittedShot`; fits stand above the page's room) is a scene beside its film, with the time of
    the film at which the scene begins, s, and the root mean square distance from the film, m.
    """
    shots = getattr(getattr(given, "best", given), "shots", (given,))
    are_shots = all(isinstance(getattr(one, "scene", None), Scene) and hasattr(one, "film") for one in shots)
    return tuple(shots) if are_shots else ()


def places_of_shot(shot: Any) -> PageFilm:
    """Return where the film of a fitted shot saw its balls."""
    film = shot.film
    return [
        _rows(film.time[seen] - shot.time, film.position[seen, k])
        for k, seen in enumerate(film.measured[:, : len(film.balls)].T)
    ]


def places_in_film(film: Any, shot: str | None, scene: Scene) -> PageFilm:
    """Return where a film saw the balls of a scene, which begins when its run is nearest to the film."""
    tracks = film_of(film, 0).tracks
    shots = list(dict.fromkeys(track.group for track in tracks))
    if len(shots) > 1 and shot is None:
        got = f"{len(shots)}: {shortened_list(shots, 6)}"
        raise CaromError(Fault("explore", "film", "one shot", got, "name one with `shot`"))
    if shot is not None and shot not in shots:
        raise CaromError(
            Fault("explore", "shot", f"one of {shortened_list(shots, 6)}", repr(shot), suggestion(shot, shots))
        )
    tracks = tuple(track for track in tracks if shot is None or track.group == shot)
    names = scene.ball_names
    if len(tracks) > len(names):
        raise CaromError(Fault("explore", "film", f"at most the {len(names)} balls of the scene", f"{len(tracks)}"))
    if all(track.name in names for track in tracks):
        order = [names.index(track.name) for track in tracks]
    else:
        order = list(range(len(tracks)))
    start = _start_of_scene(scene, order, tracks)
    places: PageFilm = [[] for _ in names]
    for k, track in zip(order, tracks, strict=True):
        places[k] = _rows(track.time[track.seen] - start, track.position[track.seen][:, :2])
    return places


def _rows(time: Any, position: Any) -> list[list[float]]:
    rows: list[list[float]] = np.column_stack([time, position]).round(5).tolist()
    return rows


def _start_of_scene(scene: Scene, order: Sequence[int], tracks: Sequence[Track]) -> float:
    """Return the time of a film, s, at which the run of a scene begins that is nearest to it."""
    run = simulate(scene)
    seen = []
    for k, track in zip(order, tracks, strict=True):
        rows = np.flatnonzero(track.seen)
        rows = rows[np.unique(np.linspace(0, len(rows) - 1, FRAMES).astype(int))]
        seen.append((k, track.time[rows], track.position[rows, 0] + 1j * track.position[rows, 1]))
    first, last = min(t[0] for _k, t, _x in seen), max(t[-1] for _k, t, _x in seen)
    until = min(run.end, last - first + BEFORE_FILM_S)
    grid = np.linspace(0.0, until, max(2, min(MOST_PLACES, int(until / STEP_S))))
    x, y, _z = np.moveaxis(np.asarray(run.at(grid).position), -1, 0)
    path = x + 1j * y

    def distance(start: float) -> float:
        """Mean distance of the frames from the run, m."""
        far = [np.abs(np.interp(t - start, grid, path[:, k]) - place) for k, t, place in seen]
        return float(np.mean(np.fmin(np.concatenate(far), FAR)))

    tried = np.linspace(first - BEFORE_FILM_S, last, STARTS)
    best = min(tried, key=distance)
    step = tried[1] - tried[0]
    return float(min(np.linspace(best - step, best + step, 41), key=distance))


# ----------------------------------------------------------------------------------------------------
# The explorer as one HTML file: the engine's module, the page's script and styles, presets, a scene and measured rebounds.


MOST_REBOUNDS = 20_000
FEW_BALLS = 6
WITH_NOSES = ("mirror", "two-step")  # beside the published laws of cushions, where a nose presses a ball on the floor
SEVERAL_LAWS = "as in the scene"  # as web/state/compute.js calls walls that have laws of their own
FRAME_HEIGHT = 760  # px, in a notebook


class ExplorerPage:
    """A page in which one scene runs under several laws: a notebook shows it, and :meth:`save` writes it as one file.

    Examples
    --------
    >>> import carom
    >>> page = carom.explore(laws=["two-step", "mirror"])
    >>> page.html.startswith("<!doctype html>")
    True
    """

    def __init__(self, text: str) -> None:
        self.html = text
        """The whole page."""

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write the page to a file .html and return its path. Raises CaromError if it cannot be written."""
        target = as_path("explore", path)
        require_writable(target, [".html", ".htm"])
        write_text(target, self.html)
        return target

    def _repr_html_(self) -> str:
        # a frame of its own, from whose scripts the notebook is safe
        return (
            f'<iframe srcdoc="{html.escape(self.html)}" title="carom explorer" sandbox="allow-scripts allow-downloads"'
            f' style="width: 100%; height: {FRAME_HEIGHT}px; border: 1px solid #8884; border-radius: 6px"></iframe>'
        )


def explore(
    scene: str | Path | Any = None,
    laws: str | Iterable[str] | None = None,
    data: str | Path | Rebounds | None = None,
    film: str | Path | Any = None,
    shot: str | None = None,
) -> ExplorerPage:
    """Return a page in which a scene can be changed by hand and is run under several laws at once, by carom's own engine.

    Parameters
    ----------
    scene : Scene or path, or a fit to whole shots, optional
        Default: the paper's example. At most 100 balls, and walls of at most 2,000 faces, edges and corners. Of a fit
        (:func:`carom.fit_shots`, or one of its shots) each shot is a scene of the page, with its film beside it.
    laws : str or sequence of str, optional
        Laws that are shown at first. Default: the scene's own, which leads, and the laws of compare for its walls; of more than 6
        balls, or with a film, its own alone.
    data : path or Rebounds, optional
        Measured rebounds, drawn over the laws' curves. These are not fitted to them: they are for the restitution and friction of
        the scene, and of the page's sliders.
    film : path or Tracks, optional
        A track file of one shot, in the coordinates of the scene: dots beside the balls' paths, a ring where the film saw each
        ball. Balls go by their names, or by their order. The scene begins when its run is nearest to the film.
    shot : str, optional
        Name of the shot, if the film has several.

    Returns
    -------
    ExplorerPage
        Jupyter and marimo show it; ``save("page.html")`` writes one file that needs no network.

    Raises
    ------
    CaromError
        For a scene that is too large or has a law of its own code, an unknown law, data that are no rebounds, and for a film
        without a scene, of several shots, or of more balls than the scene has.

    Examples
    --------
    >>> import carom
    >>> ball = carom.SceneBall(radius=0.03, mass=0.2, position=(1, 0), velocity=(-2, 1), rolling=True)
    >>> wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.85, friction=0.2)
    >>> page = carom.explore(carom.Scene(floor=carom.Floor(friction=0.2), walls=[wall], balls=[ball]))
    >>> len(page.html) < 1_500_000
    True
    """
    faults = FaultList()
    shots = fitted_shots(scene)
    given = None if scene is None or shots else _scene(scene, faults)
    named = _laws(laws, faults)
    rebounds = None
    if data is not None:
        rebounds = data if isinstance(data, Rebounds) else faults.attempt(read_rebounds, Path(data))
    if rebounds is not None and len(rebounds) > MOST_REBOUNDS:
        wanted = f"at most {MOST_REBOUNDS:,} rebounds"
        faults.append(Fault("explore", "data", wanted, f"{len(rebounds):,}", "carom fit takes more"))
    beside: dict[str, Any] = {}
    if film is not None and shots:
        faults.append(Fault("explore", "film", advice="`film` has no effect with a fit, which has its own; omit it"))
    elif film is not None and scene is None:
        faults.append(Fault("explore", "film", "a scene beside it, in whose coordinates it is", "none"))
    elif film is not None and given is not None:
        beside = {"film": faults.attempt(places_in_film, film, shot, given), "view": "above"}
    for one in shots:
        faults += not_shown(one.scene, "explore")
    faults.raise_if_any()
    return ExplorerPage(_shots_text(shots, named, rebounds) if shots else page_text(given, named, rebounds, beside))


def _scene(scene: Scene | str | os.PathLike[str], faults: FaultList) -> Scene | None:
    """Return a scene that the page can show; else add to the faults why it cannot."""
    with collected(faults):
        found: Any = load_scene(Path(scene)) if isinstance(scene, str | os.PathLike) else scene
        require_type("explore", "scene", found, Scene)
        found = with_outlines(found)
        faults += not_shown(found, "explore" if isinstance(scene, Scene) else str(scene))
        return found  # type: ignore[no-any-return]
    return None


def with_outlines(scene: Scene) -> Scene:
    """Return a scene whose walls of figures are outlines: the page has their pieces, not their sizes."""
    walls = tuple(
        wall.as_outline.model_copy(update={"name": name}) if isinstance(wall, FigureWall) else wall
        for wall, name in zip(scene.walls, scene.wall_names, strict=True)
    )
    return scene if walls == scene.walls else scene.model_copy(update={"walls": walls})


def not_shown(scene: Scene, where: str) -> FaultList:
    """Return why the page cannot run a scene; ``where`` is the place of all these faults."""
    faults = FaultList(where)
    known = engine_layout()["shapes"]
    for i, wall in enumerate(scene.walls):
        if wall.kind not in known:
            advice = "the page holds no other; carom simulate takes it"
            faults.add(f"walls[{i}].shape", f"one of {', '.join(known)}", repr(wall.kind), advice)
    for i, ball in enumerate(scene.balls):
        for name in ("drag", "lift"):
            if isinstance(getattr(ball, name), Model):
                faults.add(f"balls[{i}].{name}", "a number or the name of a law", "a form", "carom simulate takes it")
    features = sum(len(wall.features()) for wall in scene.walls)
    for what, count, most in (("balls", len(scene.balls), MOST_BALLS), ("features of walls", features, MOST_FEATURES)):
        if count > most:
            faults.add(what, f"at most {most:,}", f"{count:,}", "carom simulate takes more")
    for law in scene.given_laws:
        name = law_name(law)
        if isinstance(law, Law) or name not in _compiled():
            advice = "the page holds no other law; carom simulate runs it"
            faults.add("law", f"one of {', '.join(_compiled())}", repr(name), advice)
    return faults


def _laws(laws: str | Iterable[str] | None, faults: FaultList) -> list[str]:
    """Return the names of laws, each once."""
    found: dict[str, None] = {}
    for name in faults.attempt(one_or_several, "explore", laws or []) or ():
        try:
            law = name if isinstance(name, Law) else law_named(name)
        except CaromError as error:
            faults += error.records_at("explore: laws")
            continue
        if law.name not in _compiled():
            wanted = f"one of {', '.join(_compiled())}"
            faults.append(Fault("explore", "laws", wanted, repr(law.name), "the page holds no other"))
        found[law.name] = None
    return list(found)


def _compiled() -> list[str]:
    """The laws in the engine's module."""
    return [law["name"] for law in engine_layout()["laws"]]


def presets() -> list[dict[str, Any]]:
    """Return the explorer's presets: name, title, about, laws, view, and the scene as plain data."""
    folder = files("carom.explorer") / "presets"
    found = tomllib.loads((folder / "presets.toml").read_text(encoding="utf-8"))["preset"]
    for preset in found:
        preset["name"] = name = preset.pop("file")
        table = tomllib.loads((folder / f"{name}.toml").read_text(encoding="utf-8"))
        preset["scene"] = scene_dict(Scene(**table))
    return list(found)


def page_text(
    scene: Scene | None, laws: list[str], rebounds: Rebounds | None = None, seen: dict[str, Any] | None = None
) -> str:
    """Return the page's HTML; ``seen``: further fields of the first preset, which is the scene (``web/state/types.js``)."""
    shown = presets()
    own = [] if scene is None else [law_name(law) for law in (scene.run.law, *scene.wall_laws)]
    names = _offered([*laws, *own])
    if scene is not None:
        first = {"name": "scene", "title": "Your scene", "about": scene.describe(), "scene": scene_dict(scene)}
        # (many balls under all laws at once, or paths of other laws among a film's dots, would hide what is to be seen)
        alone = len(scene.balls) > FEW_BALLS or "film" in (seen or {})
        wanted = {*own} if alone else {*_for_walls(scene, _main_laws()), *own}
        several = [SEVERAL_LAWS] if _several(scene) else []
        listed = laws or [*several, *(name for name in names if name in wanted)]
        shown.insert(0, {**first, **_strikes(scene), "laws": listed, "slow": 1.0, **(seen or {})})
    elif laws:
        shown[0]["laws"] = laws
    return _page_of(shown, map(_card, names), rebounds)


def _shots_text(shots: Sequence[Any], laws: list[str], rebounds: Rebounds | None) -> str:
    """Return the HTML of a page with the shots of a fit, each with its film."""
    shown = []
    for one in shots:
        own = law_name(one.scene.run.law)
        found = {
            "name": one.name, "title": f"{one.name}: {1e3 * one.rms:.3g} mm from the film",
            "about": f"fitted to {len(one.film.time):,} frames under {own}", "scene": scene_dict(one.scene),
            "laws": laws or [own], "slow": 1.0, "view": "above", "film": places_of_shot(one),
        }  # fmt: skip
        shown.append(found)
    names = _offered([*laws, *(law_name(one.scene.run.law) for one in shots)])
    return _page_of(shown, map(_card, names), rebounds)


def _main_laws() -> list[Law]:
    return [law for law in all_laws().values() if not law.variant_of and not law.ignores_floor]


def _offered(others: Iterable[str]) -> list[str]:
    """Return the laws of which the page has cards: the laws of carom compare, and others."""
    wanted = {*(law.name for law in _main_laws()), *others}
    return [name for name in _compiled() if name in wanted]


def _for_walls(scene: Scene, laws: list[Law]) -> set[str]:
    """Return the names of the laws for the walls of a scene: noses of cushions, which press a ball on the floor, and others."""
    noses = {scene.floor is not None and _is_nose(wall) for wall in scene.walls} or {False}
    found = {law.name for law in laws if not law.on_table} if False in noses else {*WITH_NOSES}
    return found | {law.name for law in laws if law.on_table and True in noses}


def _is_nose(wall: WallShape) -> bool:
    """Whether a wall touches a ball above its centre."""
    if isinstance(wall, Plane):
        x, y, z = wall.normal
        return z < 0 and (x, y) != (0, 0)
    return getattr(wall, "nose_height", None) is not None


def _strikes(scene: Scene) -> dict[str, Any]:
    """Return how cues have struck the balls of a scene: the page has the velocities and spins that they give."""
    names = ("speed", "azimuth", "elevation", "offset")
    strikes = [one.strike and {name: getattr(one.strike, name) for name in names} for one in scene.balls]
    return {"strikes": strikes} if any(strikes) else {}


def _page_of(
    shown: list[dict[str, Any]], cards: Iterable[dict[str, Any]], rebounds: Rebounds | None = None, **more: Any
) -> str:
    """Return the page's HTML around what it shows, in the form of ``PageData`` of ``web/main.js``."""
    data = {
        "presets": shown,
        "cards": list(cards),
        "rebounds": [] if rebounds is None else _angles(rebounds),
        "reboundsFrom": "" if rebounds is None else Path(rebounds.source).name or "the data given",
        **more,
    }
    parts = {
        "STYLE": _asset("style.css"),
        "DATA": _script_json(data),
        "LAYOUT": _script_json(engine_layout()),
        # (the file is a copy of what is inside, so that their licences go with it)
        "LICENCES": (_asset("LICENSES.txt") + _asset("LICENSE-musl.txt")).replace("</", "<\\/"),
        "MODULE": base64.b64encode(engine_bytes()).decode("ascii"),
        "SCRIPT": _asset("page.js"),
    }
    # in one pass: what is put in is not looked at again
    return re.sub(r"@([A-Z]+)@", lambda match: parts[match[1]], _asset("index.html"))


def _card(name: str) -> dict[str, Any]:
    """Description of a law as the page shows it; colour and dashes are the same as in figures."""
    law = law_named(name)
    colour, dashes = law_styles(_compiled())[name]
    return {
        "name": name,
        "summary": law.card.summary,
        "valid": law.card.valid,
        "colour": colour,
        "dashes": None if isinstance(dashes, str) else list(dashes[1]),
        "reads": None if law.reads is None else list(law.reads),
    }


def _angles(rebounds: Rebounds) -> list[dict[str, Any]]:
    """Return incidence and reflection of measured rebounds, degrees, mirrored so that each comes from the positive side."""
    side = np.where(rebounds["v_t_in"] < 0, -1.0, 1.0)
    incidence = np.degrees(np.arctan2(side * rebounds["v_t_in"], rebounds["v_n_in"]))
    reflection = np.degrees(np.arctan2(side * rebounds["v_t_out"], rebounds["v_n_out"]))
    stages = np.full(len(rebounds), "") if rebounds.stage is None else rebounds.stage
    return [
        {"incidence": round(x, 4), "reflection": round(y, 4), "stage": stage}
        for x, y, stage in zip(incidence.tolist(), reflection.tolist(), stages.tolist(), strict=True)
        if np.isfinite(x) and np.isfinite(y)
    ]


@functools.cache
def _asset(name: str) -> str:
    return (ASSETS / name).read_text(encoding="utf-8")


def _script_json(data: Any) -> str:
    """Return JSON that may stand in a script element, whatever names are in it."""
    return json.dumps(data, separators=(",", ":"), allow_nan=False, ensure_ascii=True).replace("<", "\\u003c")


# ----------------------------------------------------------------------------------------------------
# A run as a page that plays it: the explorer with one law, or with a recorded run where the page cannot compute it.


# Up to so many events the page runs a scene itself (web/state/compute.js); a longer run is recorded, up to so many rows of its log:
# with more a browser no longer plays smoothly.
MOST_EVENTS_RUN, MOST_ROWS = 2000, 200_000
STATUS = {"nothing more happens": "quiet", "duration": "done", "max_events": "limit"}


def player_page(run: Trajectory, start: float, end: float, speed: float) -> str:
    """Return the HTML of a page that plays a run from ``start`` to ``end`` (s), ``speed`` seconds of it in one second.

    A run of at most 2,000 events under carom's own laws is computed by the page, from the scene, and the scene can be changed
    there. Any other is recorded: its log of events is in the page, and the motion between them is computed from it.

    Raises CaromError for a run of more than 200,000 events.

    Examples
    --------
    >>> import carom
    >>> ball = carom.SceneBall(radius=0.03, mass=0.2, position=(1, 0, 0), velocity=(-1, 0, 0))
    >>> run = carom.simulate(carom.Scene(gravity=0, balls=[ball], run=carom.Run(law="mirror", duration=2)))
    >>> player_page(run, 0.0, 2.0, 1.0).startswith("<!doctype html>")
    True
    """
    seen = {"span": [start, end], "time": start, "slow": speed}
    scene = with_outlines(run.scene)
    why = _why_recorded(run, scene)
    if not why:
        return page_text(scene, [SEVERAL_LAWS if _several(run.scene) else law_name(run.scene.run.law)], seen=seen)
    rows = _piece_rows(run, start, end)
    if len(rows) > MOST_ROWS + len(run.scene.balls):
        raise CaromError(
            f"animate: expected at most {MOST_ROWS:,} events in a page, got {len(rows):,}; take a shorter time: start=, end="
        )
    card = _run_card(run)
    about = f"{run.scene.describe()}; recorded: {why}"
    first = {"name": "scene", "title": "Recorded run", "about": about, "laws": [card["name"]]}
    recorded = {
        "log": base64.b64encode(gzip.compress(rows.tobytes(), mtime=0)).decode("ascii"),
        "status": STATUS[run.ended],
        "end": min(run.end, max(end, float(rows["t"].max(initial=0.0)))),
        "why": f"A recorded run ({why}): it is played, not computed anew.",
    }
    return _page_of([{**first, "scene": scene_dict(scene), **seen}], [card], recorded=recorded)


def _why_recorded(run: Trajectory, scene: Scene) -> str:
    """Return why the page does not compute a run; empty if it does."""
    balls, events = len(run.scene.balls), len(run.events)
    if balls > MOST_BALLS:
        return f"{balls:,} balls"
    if events > MOST_EVENTS_RUN:
        return f"{events:,} events"
    return "a page does not show its walls or its law" if not_shown(scene, "") else ""


def _several(scene: Scene) -> bool:
    return any(wall.law is not None for wall in scene.walls)


def _piece_rows(run: Trajectory, start: float, end: float) -> NDArray[np.void]:
    """Return the log from ``start`` to ``end``, and before it the row in which each ball is at ``start``, in their order."""
    log = run.log
    before = log[log["t"] <= start]
    last = {int(ball): i for i, ball in enumerate(before["ball"])}
    first = before[[last[i] for i in range(len(run.scene.balls))]]
    return np.concatenate([first, log[(log["t"] > start) & (log["t"] <= end)]])


def _run_card(run: Trajectory) -> dict[str, Any]:
    """Description of the law of a recorded run, as the page shows it."""
    law = run.scene.run.law
    law = law if isinstance(law, Law) else law_named(law)
    card = {"name": law.name, "summary": law.card.summary, "valid": law.card.valid}
    colour, _dashes = law_styles([law.name])[law.name]
    if _several(run.scene):
        card, colour = {"name": SEVERAL_LAWS, "summary": "Each wall with its own law.", "valid": ""}, "#777777"
    return {**card, "colour": colour, "dashes": None, "reads": None}
