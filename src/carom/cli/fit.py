"""``carom fit``: fit the laws to measured rebounds or whole tracks, rank them, write a report; ``carom design``."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from carom.cli.options import OUTPUT, TRACK, option, require_outputs, shared, tell, wrote
from carom.cli.parameters import Given, of_library
from carom.cli.streams import note, say_json
from carom.cli.verbs import with_options
from carom.errors import shortened_list
from carom.formatting import Listing, counted

if TYPE_CHECKING:
    from rich.console import Console

    from carom.fitting import Fit, Ranked, Ranking, RankingsBy
    from carom.fitting.forms import FormChoice
    from carom.fitting.shots import ShotsFit, ShotsRanking
    from carom.fitting.tracks import TrackFit, TrackRanking


def show_shots(ranking: ShotsRanking) -> None:
    """Print a ranking of fits to whole shots, then the sentences on the best one."""
    from carom.cli.console import out
    from carom.fitting.result import with_error_bar
    from carom.fitting.shots.result import HORIZONS

    best = ranking.best
    frames = sum(len(one.film.time) for one in best.shots)
    data = f"{counted(len(best.shots), 'shot')}, {frames:,} frames; noise {1e3 * best.noise:.2g} mm estimated"

    def cells(one: Ranked[ShotsFit]) -> tuple[str, ...]:
        numbers = ", ".join(f"{name} {with_error_bar(estimate)}" for name, estimate in one.fit.estimates.items())
        medians = (1e3 * one.fit.median(name) for name in HORIZONS)
        return (*("–" if math.isnan(mm) else f"{mm:.1f}" for mm in medians), numbers or "none")

    said = f"\nRMS distances in mm: median of the shots, to the first ball, through its cushions, to rest. Errors: {_errors(best)}"
    print_ranking(ranking, ("ball", "1", "2", "3 cushions", "whole"), cells, said, data)
    for line in best.describe()[1:]:
        out().print(line, soft_wrap=True)


def _errors(fit: ShotsFit) -> str:
    return (
        "from the scatter of shots."
        if fit.by_shots
        else "from the residuals of the frames, of which correlated ones count as one."
    )


# ----------------------------------------------------------------------------------------------------
# Output of ``carom fit TRACKS --whole``: laws fitted to whole tracks, each simulated from its own initial state.


def show_whole(ranking: TrackRanking) -> None:
    """Print a ranking of fits to whole tracks."""
    from carom.fitting.result import with_error_bar

    best, tracks = ranking.best, ranking.best.frames.segments
    data = (
        f"{counted(len(tracks), 'track segment')}, {counted(sum(len(one.contacts) for one in tracks), 'contact')},"
        f" {int(best.frames.count.sum()):,} frames; noise {1e3 * best.noise:.3g} mm {'as given' if best.known else 'estimated'}"
    )

    def cells(one: Ranked[TrackFit]) -> tuple[str, ...]:
        fit = one.fit
        known = [f"{name} {with_error_bar(e)}" for name, e in fit.estimates.items() if not name.startswith("wall_")]
        chi2 = f"{fit.chi2:.4g}/{fit.dof:.0f}" if fit.known else "–"
        return chi2, f"{1e3 * fit.median_rms:.3g}", ", ".join(known)

    over_all = f"{best.law.name} over all {1e3 * best.rms():.3g} mm"
    more = f"\nRMS: median of the segments; {over_all}. Wall positions: --json, --report"
    print_ranking(ranking, ("chi²/dof", "RMS, mm"), cells, more, data)


# ----------------------------------------------------------------------------------------------------
# Print a ranking of laws, fitted to rebounds or to whole tracks, as a table, with its verdict and notes.


MAX_OUTLIERS = 10
GAP, EDGES = 3, 2  # characters between columns, and at both edges of a table
LEAST_ROOM = 26  # characters, for the longest names of parameters


def show(ranking: Ranking) -> None:
    """Print a ranking of fits to rebounds."""
    from carom.cli.console import out
    from carom.fitting.result import with_error_bar

    def cells(one: Ranked[Fit]) -> tuple[str, ...]:
        fit = one.fit
        numbers = ", ".join(f"{name} {with_error_bar(estimate)}" for name, estimate in fit.estimates.items())
        return (
            f"{one.weight:.3g}" if one.weight >= 1e-4 else "0",
            "–" if fit.scatter or fit.dof <= 0 else f"{fit.chi2:.4g}/{fit.dof}",
            "–" if math.isnan(one.score) else f"{one.score:.3g}",
            ", ".join(part for part in (numbers, fit.scatter_in_words) if part) or "none",
        )

    print_ranking(ranking, ("weight", "chi²/dof", "CV score"), cells)
    for choice in ranking.forms:
        _print_forms(choice)
    for outlier in ranking.outliers[:MAX_OUTLIERS]:
        out().print(f"outlier: {outlier.row}: chi² {outlier.chi2:.1f}, {outlier.why}", soft_wrap=True)
    if (more := len(ranking.outliers) - MAX_OUTLIERS) > 0:
        out().print(f"and {counted(more, 'more outlier')}")


def _print_forms(choice: FormChoice) -> None:
    """Print the functions of the impact that were tried for a law's parameters, and the choice."""
    from carom.cli.console import out

    first = choice.tried[0]
    rows = [
        (
            one.words,
            f"{one.aicc - first.aicc:+.1f}",
            f"{one.score:.3f}",
            f"{one.gain:+.3f} ± {one.gain_error:.3f}" * (i > 0),
        )
        for i, one in enumerate(choice.tried)
    ]
    heads = (f"{choice.law}: parameters as", "ΔAICc", "held-out score", "gain")
    out().table(Listing(heads, rows), dict.fromkeys(choice.chosen, "bold"))
    out().print(f"{choice.sentence}.", soft_wrap=True)


def show_each(rankings: RankingsBy) -> None:
    """Print the rankings of the values of a column, one after the other."""
    from carom.cli.console import out

    for value, ranking in rankings.items():
        out().print(f"{rankings.column} {value}", style="bold")
        show(ranking)


def show_short(ranking: Any) -> None:
    """Print the verdict's sentence alone; of each value of a column, with the value."""
    from carom.cli.streams import say

    each = ranking.items() if hasattr(ranking, "column") else [("", ranking)]
    for value, one in each:
        say(f"{value}: {one.sentence}" if value else one.sentence)


def _in_lines(parameters: str, room: int) -> str:
    """Return names with their numbers in lines of so many characters, which end between two of them, or before a number."""
    lines: list[str] = []
    for item in re.split(r"(?<=,) (?=[a-z])", parameters):
        if lines and len(lines[-1]) + 1 + len(item) <= room:
            lines[-1] += f" {item}"
        else:
            lines += [item] if len(item) <= room else item.split(" ", 1)
    return "\n".join(lines)


def print_ranking(
    ranking: Ranking | TrackRanking | ShotsRanking,
    heads: Sequence[str],
    cells: Callable[[Any], Sequence[str]],
    more: str = "",
    data: str = "",
) -> None:
    """Print the verdict in a sentence, the laws as a table, best first, and what else is to be said.

    ``cells`` of a ranked fit: one for each of ``heads``, and the parameters; ``more``: a note on the columns; ``data``: on data.
    """
    from carom.cli.console import out

    style = "bold green" if ranking.decisive else "bold yellow"
    out().print(ranking.sentence, style=style, soft_wrap=True)
    if data:
        out().print(data)
    names = ("law", "ΔAICc", *heads, "parameters")
    rows = [(one.fit.law.name, f"{one.fit.aicc - ranking.best.aicc:.1f}", *cells(one)) for one in ranking.ranked]
    others = list(zip(names, *rows, strict=True))[:-1]
    room = out().width - EDGES - sum(GAP + max(map(len, column)) for column in others)
    beside = room >= LEAST_ROOM  # else the numbers of each law stand below the table
    shown = [(*row[:-1], *([_in_lines(row[-1], room)] * beside)) for row in rows]
    out().table(Listing(names if beside else names[:-1], shown), {0: "bold"})
    for law, *_cells, numbers in [] if beside else rows:
        out().print(f"{law}: {numbers}")
    out().print(f"{ranking.aicc_note}{more}", style="dim", soft_wrap=True)
    if rest := ranking.verdict[len(ranking.sentence) :].strip():
        out().print(rest, style=style, soft_wrap=True)
    if unidentified := dict.fromkeys(ranking.degenerate):
        out().print("Unconstrained parameters:")
    for line in unidentified:
        out().print(f"  {line}", soft_wrap=True)


# ----------------------------------------------------------------------------------------------------
# ``carom fit``: fit the laws to measured rebounds or whole tracks, rank them, and write a report.


LAWS = (
    "laws restitution friction tangential_restitution stiffness_ratio forms fit fix bound robust contact_height floor_friction"
    " floor_restitution roll"
)
DATA = (
    "format rate scale view balls down wall hard rolling_resistance gravity drag_per_metre window blind whole contacts shot"
    " table noise"
)


@of_library(
    "fitting.files:fit", "tracks.films:measure_tracks", "tracks.video.film:track_film",
    panels={"Laws": LAWS, TRACK: DATA, OUTPUT: "bootstrap profiles seed"},
)  # fmt: skip
def fit(
    files: Annotated[
        list[Path],
        typer.Argument(
            metavar="FILE", help="A table of rebounds (CSV, Parquet), one or more tracks, or a set of carom datasets."
        ),
    ],
    *,
    given: Given,
    report: Annotated[
        Path | None, option(OUTPUT, "Write a report with figures to this file.", metavar="FILE.html")
    ] = None,
    plot: Annotated[Path | None, shared("plot", help="Draw what was measured and what the best laws predict.")] = None,
    explore: Annotated[
        Path | None,
        option(
            OUTPUT, "With --shot: write a page that plays the fitted shots beside their films.", metavar="FILE.html"
        ),
    ] = None,
    short: Annotated[bool, option(OUTPUT, "Print the verdict alone, in one sentence.", "--short")] = False,
    as_json: Annotated[bool, shared("json")] = False,
) -> None:
    """Fit the laws of impact to measured rebounds, and report which of them the data favour.

    Examples: carom fit bounces.csv --radius 0.02 --inertia hollow; carom fit kharaz2001.
    """
    from carom.cli.console import err
    from carom.files import require_library

    require_library("scipy", "fit")
    from carom.fitting.files import check_fit
    from carom.fitting.files import fit as fit_laws_to

    faults, shot = given.faults, given.get("shot")
    pages = (".html", ".htm")
    require_outputs(
        faults, {"--report": report, "--plot": plot, "--explore": explore}, {"--report": pages, "--explore": pages}
    )
    if "by" in given and (report is not None or plot is not None):
        faults.add(
            "", "", advice=f"--{'plot' if report is None else 'report'} has no effect with --by; omit one of them"
        )
    if short and as_json:
        faults.add("", "", advice="--short has no effect with --json; omit one of them")
    if explore is not None and not shot:
        faults.add("", "", advice="--explore has no effect without --shot; omit it, or add --shot")
    given.raise_if_any(lambda: check_fit(files=files, **given))
    console = err()
    with _bar(console) as progress:
        ranking = fit_laws_to(files, progress=progress, **given)
    shows: dict[str, Any] = {"shot": show_shots, "whole": show_whole, "by": show_each}
    if short:
        show_short(ranking)
    else:
        tell(ranking, next((one for name, one in shows.items() if name in given), show), as_json, console, ())
    with _bar(console) as progress:  # (what was computed is shown, whatever becomes of the files)
        if report is not None:
            require_library("matplotlib", "--report")
            progress(1.0, 1.0, "report")
            _page(with_options(ranking), files, report)
            wrote(report)
        _draw(ranking, plot)
        if explore is not None:
            from carom.explorer.page import explore as make_page

            make_page(ranking).save(explore)
            wrote(explore)


@contextmanager
def _bar(console: Console) -> Iterator[Any]:
    """Show a progress bar on standard error, where that is a terminal."""
    from carom.cli.console import working

    with working("fit", console) as update:
        assert update is not None
        yield update


def _draw(found: Any, path: Path | None) -> None:
    """Write the figure of a fit, if a file is named: what was measured, the best laws, and residuals."""
    if path is None:
        return
    from carom.fitting.free_balls import AirFit, GasFit
    from carom.fitting.shots import ShotsRanking
    from carom.fitting.tracks import TrackRanking
    from carom.plot.fit import plot_fit, plot_flights, plot_shot, plot_shots, plot_tracks
    from carom.plot.style import save

    found = found.ranking if isinstance(found, GasFit) else found
    kinds: list[tuple[type, Any]] = [(AirFit, plot_flights), (TrackRanking, plot_tracks)]
    draw = next((draw for kind, draw in kinds if isinstance(found, kind)), plot_fit)
    if isinstance(found, ShotsRanking):
        shots = found.best.shots
        save(plot_shot(shots[0]) if len(shots) == 1 else plot_shots(*(one.fit for one in found.ranked[:2])), path)
    else:
        save(draw(found), path)
    wrote(path)


def _page(ranking: Any, files: list[Path], path: Path) -> Path:
    from carom.fitting import Ranking
    from carom.fitting.shots import ShotsRanking
    from carom.plot.fit import write_report, write_shots_report, write_track_report

    source = shortened_list([str(file) for file in files])
    if isinstance(ranking, ShotsRanking):
        return write_shots_report(ranking, source, path)
    return write_report(ranking, path) if isinstance(ranking, Ranking) else write_track_report(ranking, source, path)


def fit_gas(
    file: Annotated[
        Path,
        typer.Argument(
            metavar="FILE",
            help="Tracks: columns t, ball, x, y, z, wx, wy, wz.",
        ),
    ],
    scene: Annotated[Path, typer.Option(metavar="SCENE.toml", help="The gas: container and balls.")],
    plot: Annotated[
        Path | None, shared("plot", help="Draw the collisions, what the law predicts, and residuals.")
    ] = None,
    as_json: Annotated[bool, shared("json", rich_help_panel=OUTPUT)] = False,
) -> None:
    """Infer restitution, friction and tangential restitution of a gas from tracks of its balls.

    Example: carom fit gas tracks.csv --scene gas.toml.
    """
    from carom.files import require_library

    require_library("scipy", "fit")
    from carom.fitting.free_balls import fit_gas as infer

    _numbers(infer, file, scene, plot, as_json)


def fit_air(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Columns t, ball (of a flight), x, y, z, wx, wy, wz.")],
    scene: Annotated[Path, typer.Option(metavar="SCENE.toml", help="Its air, and its first ball: drag and lift.")],
    plot: Annotated[Path | None, shared("plot", help="Draw how far the flights are from their paths.")] = None,
    as_json: Annotated[bool, shared("json", rich_help_panel=OUTPUT)] = False,
) -> None:
    """Fit drag and lift of a ball to flights with known spins.

    Example: carom fit air flights.csv --scene ball.toml.
    """
    from carom.cli.streams import say
    from carom.fitting.free_balls import fit_air as infer

    found = _numbers(infer, file, scene, plot, as_json)
    if not as_json:
        low, high = found.spin_ratios
        off = f"{1e3 * found.residual:.3g} mm from their paths"
        say(f"{counted(found.flights, 'flight')}, {off}; spin ratios {low:.2g} to {high:.2g}")


def _numbers(infer: Any, file: Path, scene: Path, plot: Path | None, as_json: bool) -> Any:
    """Infer numbers of balls in free motion, print them with error bars and notes, and draw what is left."""
    from carom.cli.streams import say, say_json, say_notes
    from carom.errors import FaultList
    from carom.fitting.result import with_error_bar

    faults = FaultList()
    require_outputs(faults, {"--plot": plot})
    faults.raise_if_any()
    found = infer(file, scene)
    if as_json:
        say_json(found.to_dict())
    else:
        say_notes(found.notes)
        for name, one in found.estimates().items():
            say(f"{name.replace('_', ' ')}  {with_error_bar(one)}")
    _draw(found, plot)
    return found


# ----------------------------------------------------------------------------------------------------
# ``carom design``: which shots to film next, and how many.

SHOTS = "Shots"


@of_library(
    "fitting.design_shots:design",
    without=("fine",),
    panels={SHOTS: "angles_deg speeds spins spin sigma_v sigma_spin odds"},
)
def design(
    file: Annotated[Path | None, typer.Argument(help="Rebounds measured so far. Default: none.")] = None,
    *,
    given: Given,
    plot: Annotated[Path | None, shared("plot")] = None,
    as_json: Annotated[bool, shared("json")] = False,
) -> None:
    """Find the angles of incidence, speeds and spins that discriminate best between two laws, and how many shots are needed.

    carom design --laws maw,contact --radius 0.02 --inertia hollow --sigma-v 0.15 --sigma-spin 10 --speeds 3:10
    """
    from carom.cli.console import working
    from carom.fitting.design_shots import check_design
    from carom.fitting.design_shots import design as plan_shots

    require_outputs(given.faults, {"--plot": plot})
    given.raise_if_any(lambda: check_design(file=file, **given))
    with working("planning"):
        plan = plan_shots(file, **given, fine=plot is not None)
    if plot is not None:
        from carom.plot.style import save
        from carom.plot.sweeps import plot_design

        save(plot_design(plan), plot)
        wrote(plot)
    if as_json:
        say_json(plan.as_dict())
    else:
        _show(plan)
    for line in plan.notes:
        note(f"note: {line}")


def _show(plan: Any) -> None:
    from rich.text import Text

    from carom.cli.console import out
    from carom.formatting import Listing

    console = out()
    said = ", ".join(f"{name} {value:.4g}" for name, value in plan.truth.items()) or "no parameters"
    other = ", ".join(f"{name} {value:.4g}" for name, value in plan.other.items()) or "no parameters"
    console.print(
        Text(f"Assumed true: {plan.laws[0]} ({said})\nClosest parameters of the other: {plan.laws[1]} ({other})")
    )
    if plan.shots and plan.count:
        compared = all(shot.without is not None for shot in plan.shots)
        heads = ["shot", "angle\ndegrees", "speed\nm/s", "spin\nrad/s", "repeats", "2 log odds\neach"]
        heads += ["2 log odds\nwithout one"] * compared
        rows = []
        for number, shot in enumerate(plan.shots, 1):
            spin = "unknown" if shot.spin is None else f"{shot.spin:.4g}"
            rows.append(
                [str(number), f"{shot.angle_deg:.4g}", f"{shot.speed:.4g}", spin, str(shot.repeat), f"{shot.gain:.3g}"]
            )
            rows[-1] += [f"{shot.without:.3g}" if shot.without >= 5e-3 else "0"] if compared else []
        console.table(Listing(heads, rows))
    console.print(plan.sentence, style="bold green" if plan.count else "bold yellow", soft_wrap=True)
