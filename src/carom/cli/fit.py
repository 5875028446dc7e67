"""``carom fit``: fit the laws to measured rebounds or whole tracks, rank them, and write a report."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from carom.cli.console import working
from carom.cli.options import (
    OUTPUT,
    REBOUNDS,
    comma_separated,
    of_films,
    option,
    parse_assignments,
    parse_bounds,
    parse_length,
    parse_number,
    parse_scale,
    require_outputs,
    shared,
    tell,
    write_report_page,
    wrote,
)
from carom.cli.verbs import with_options
from carom.errors import CaromError, FaultList, shortened_list
from carom.formatting import counted
from carom.public.defaults import CUSHIONS

if TYPE_CHECKING:
    from rich.console import Console

    from carom.fitting import Fit, Ranked, Ranking, RankingsBy
    from carom.fitting.forms import FormChoice
    from carom.fitting.shots import ShotsFit, ShotsRanking
    from carom.fitting.tracks import TrackFit, TrackRanking


def show_shots(ranking: ShotsRanking) -> None:
    """Print a ranking of fits to whole shots, then the sentences on the best one."""
    from rich.text import Text

    from carom.cli.console import out
    from carom.fitting.result import with_error_bar
    from carom.fitting.shots.result import HORIZONS
    from carom.formatting import counted

    best = ranking.best
    frames = sum(len(one.film.time) for one in best.shots)
    out().print(f"{counted(len(best.shots), 'shot')}, {frames:,} frames; noise {1e3 * best.noise:.2g} mm estimated")

    def cells(one: Ranked[ShotsFit]) -> tuple[str, ...]:
        numbers = ", ".join(f"{name} {with_error_bar(estimate)}" for name, estimate in one.fit.estimates.items())
        medians = (1e3 * one.fit.median(name) for name in HORIZONS)
        return (*("–" if math.isnan(mm) else f"{mm:.1f}" for mm in medians), numbers or "none")

    said = f"\nRMS distances in mm: median of the shots, to the first ball, through its cushions, to rest. Errors: {_errors(best)}"
    print_ranking(ranking, ("ball", "1", "2", "3 cushions", "whole"), cells, said)
    for line in best.describe()[1:]:
        out().print(Text(line), soft_wrap=True)


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
    from carom.cli.console import out
    from carom.fitting.result import with_error_bar
    from carom.formatting import counted

    best, tracks = ranking.best, ranking.best.frames.segments
    out().print(
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
    print_ranking(ranking, ("chi²/dof", "RMS, mm"), cells, more)


# ----------------------------------------------------------------------------------------------------
# Print a ranking of laws, fitted to rebounds or to whole tracks, as a table, with its verdict and notes.


MAX_OUTLIERS = 10
GAP, EDGES = 3, 2  # characters between columns, and at both edges of a table
LEAST_ROOM = 26  # characters, for the longest names of parameters


def show(ranking: Ranking) -> None:
    """Print a ranking of fits to rebounds."""
    from rich.text import Text

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
        out().print(Text(f"outlier: {outlier.row}: chi² {outlier.chi2:.1f}, {outlier.why}"), soft_wrap=True)
    if (more := len(ranking.outliers) - MAX_OUTLIERS) > 0:
        out().print(f"and {counted(more, 'more outlier')}")


def _print_forms(choice: FormChoice) -> None:
    """Print the functions of the impact that were tried for a law's parameters, and the choice."""
    from rich import box
    from rich.table import Table
    from rich.text import Text

    from carom.cli.console import out

    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, header_style="bold")
    for head in (f"{choice.law}: parameters as", "ΔAICc", "held-out score", "gain"):
        table.add_column(head, justify="left" if head.startswith(choice.law) else "right", no_wrap=True)
    first = choice.tried[0]
    for i, one in enumerate(choice.tried):
        gain = f"{one.gain:+.3f} ± {one.gain_error:.3f}" if i else ""
        cells = (one.words, f"{one.aicc - first.aicc:+.1f}", f"{one.score:.3f}", gain)
        table.add_row(*cells, style="bold" if i in choice.chosen else None)
    out().print(table)
    out().print(Text(f"{choice.sentence}."), soft_wrap=True)


def show_each(rankings: RankingsBy) -> None:
    """Print the rankings of the values of a column, one after the other."""
    from rich.text import Text

    from carom.cli.console import out

    for value, ranking in rankings.items():
        out().print(Text(f"{rankings.column} {value}", style="bold"))
        show(ranking)


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
) -> None:
    """Print the laws as a table, best first, and the sentences below it.

    ``cells`` of a ranked fit: one for each of ``heads``, and the parameters; ``more``: a note on the columns.
    """
    from rich import box
    from rich.table import Table
    from rich.text import Text

    from carom.cli.console import out

    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, header_style="bold")
    names = ("law", "ΔAICc", *heads, "parameters")
    for head in names:
        words = head in ("law", "parameters")
        table.add_column(head, justify="left" if words else "right", no_wrap=head != "parameters")
    rows = [(one.fit.law.name, f"{one.fit.aicc - ranking.best.aicc:.1f}", *cells(one)) for one in ranking.ranked]
    others = list(zip(names, *rows, strict=True))[:-1]
    room = out().width - EDGES - sum(GAP + max(map(len, column)) for column in others)
    beside = room >= LEAST_ROOM
    if not beside:  # the numbers of each law stand below the table
        table.columns.pop()
    for i, row in enumerate(rows):
        table.add_row(*row[:-1], *([_in_lines(row[-1], room)] if beside else []), style=None if i else "bold")
    out().print(table)
    for law, *_cells, numbers in [] if beside else rows:
        out().print(Text(f"{law}: {numbers}"))
    out().print(Text(f"{ranking.aicc_note}{more}", style="dim"), soft_wrap=True)
    out().print(Text(ranking.verdict, style="bold green" if ranking.decisive else "bold yellow"), soft_wrap=True)
    if unidentified := dict.fromkeys(ranking.degenerate):
        out().print("Unconstrained parameters:")
    for line in unidentified:
        out().print(Text(f"  {line}"), soft_wrap=True)


# ----------------------------------------------------------------------------------------------------
# ``carom fit``: fit the laws to measured rebounds or whole tracks, rank them, and write a report.


DATA, LAWS = REBOUNDS, "Laws"


def register(app: typer.Typer) -> None:
    """Add the verb."""
    app.command()(fit)


def fit(
    files: Annotated[
        list[Path],
        typer.Argument(
            metavar="FILE", help="A table of rebounds (CSV, Parquet), one or more tracks, or a set of carom datasets."
        ),
    ],
    radius: Annotated[float | None, shared("radius", default="the radius of a set that comes with carom")] = None,
    inertia: Annotated[str | None, shared("inertia", default="solid")] = None,
    laws: Annotated[
        list[str] | None, option(LAWS, "Fit only these laws; may be repeated.", metavar="NAME,NAME")
    ] = None,
    restitution: Annotated[
        str,
        option(
            LAWS, "Restitution as a function of speed: constant, line, polynomial, power, viscoelastic, exponential."
        ),
    ] = "constant",
    friction: Annotated[
        str,
        option(
            LAWS,
            "Friction: constant, or linear or exponential in the slip, or in v_n, slip/v_n, speed after a colon.",
            metavar="FORM[:VARIABLE]",
        ),
    ] = "constant",
    tangential_restitution: Annotated[
        str, option(LAWS, "Tangential restitution: the same, by default in slip/v_n.", metavar="FORM[:VARIABLE]")
    ] = "constant",
    stiffness_ratio: Annotated[
        str, option(LAWS, "Stiffness ratio: the same, by default in slip/v_n.", metavar="FORM[:VARIABLE]")
    ] = "constant",
    forms: Annotated[
        bool,
        option(
            LAWS,
            "Choose a form or a spline for each parameter of the best law, and the tails of errors, by rows held out.",
            "--forms",
        ),
    ] = False,
    fit_: Annotated[
        list[str] | None,
        option(LAWS, "Fit this as well: kappa, contact_height, floor_friction, roll.", "--fit", metavar="NAME"),
    ] = None,
    fix: Annotated[
        list[str] | None,
        option(LAWS, "Hold a parameter of the laws at a value; may be repeated.", metavar="NAME=VALUE"),
    ] = None,
    bound: Annotated[
        list[str] | None, option(LAWS, "Bounds of a fitted parameter; may be repeated.", metavar="NAME=LOW:HIGH")
    ] = None,
    robust: Annotated[bool, option(LAWS, "Assume errors with heavy tails (Student's t).", "--robust")] = False,
    contact_height: Annotated[float | None, shared("contact_height", default="1")] = None,
    floor_friction: Annotated[float | None, shared("floor_friction", default="what the film says, else 0.2")] = None,
    floor_restitution: Annotated[float, shared("floor_restitution")] = 0.0,
    roll: Annotated[
        float, option(LAWS, "Spin before the wall, in units of a rolling ball's spin: 1 rolling, 0 without spin.")
    ] = 1.0,
    kind: Annotated[str | None, shared("kind", default="by the columns")] = None,
    stage: Annotated[str | None, option(DATA, "Stage of all rows: after_wall or rolling.")] = None,
    rate: Annotated[float | None, shared("rate", default="from the times")] = None,
    scale: Annotated[str | None, shared("scale")] = None,
    view: Annotated[str | None, shared("view", default="by the motion")] = None,
    balls: Annotated[bool, shared("balls")] = False,
    format_: Annotated[str | None, option(DATA, "Format of the films; overrides detection.", "--format")] = None,
    down: Annotated[bool | None, option(DATA, "The second axis points down, as in images.", "--down/--up")] = None,
    wall: Annotated[list[str] | None, option(DATA, "Line of a wall, as in carom tracks show; may be repeated.")] = None,
    hard: Annotated[bool | None, option(DATA, "The wall is rigid: both motions meet on its line.", "--hard")] = None,
    rolling_resistance: Annotated[
        float | None, option(DATA, "Deceleration / g of a rolling ball.", "--rolling-resistance")
    ] = None,
    gravity: Annotated[float | None, shared("gravity", default="9.80665", rich_help_panel=DATA)] = None,
    drag: Annotated[float | None, option(DATA, "Air drag k, 1/m. Default: from the flights.")] = None,
    window: Annotated[
        float | None, option(DATA, "Time fitted before and after a contact, s.", "--window", unit="s")
    ] = None,
    blind: Annotated[float | None, option(DATA, "Time excluded beside a contact, s.", "--blind", unit="s")] = None,
    length: Annotated[str | None, shared("length")] = None,
    readout: Annotated[float | None, shared("readout")] = None,
    ball: Annotated[list[str] | None, shared("ball")] = None,
    colour: Annotated[str | None, shared("colour")] = None,
    region: Annotated[str | None, shared("region")] = None,
    start: Annotated[float | None, shared("start")] = None,
    end: Annotated[float | None, shared("end")] = None,
    whole: Annotated[
        bool,
        option(DATA, "Fit whole tracks, each simulated from its own initial state, instead of contacts.", "--whole"),
    ] = False,
    cushions: Annotated[int, option(DATA, "With --whole: largest number of contacts followed per ball.")] = CUSHIONS,
    shot: Annotated[
        bool,
        option(
            DATA,
            "Fit whole shots from the stroke to rest, all balls and cushions; --fit, --fix and --bound take paths of a scene.",
            "--shot",
        ),
    ] = False,
    table: Annotated[
        Path | None,
        option(
            DATA,
            "With --shot: the table with which the fit begins.",
            metavar="SCENE.toml",
            show_default="a carom table between the cushions of the films",
        ),
    ] = None,
    noise: Annotated[str | None, shared("noise", default="estimated; only with --whole")] = None,
    where: Annotated[
        list[str] | None,
        option(DATA, "Use only rows with this value in the column; may be repeated.", metavar="COLUMN=VALUE"),
    ] = None,
    by: Annotated[
        str | None, option(DATA, "Fit the rows of each value of this column, such as surface.", metavar="COLUMN")
    ] = None,
    sigma_v: Annotated[float | None, shared("sigma_v", default="of the table")] = None,
    sigma_spin: Annotated[float | None, shared("sigma_spin", default="of the table")] = None,
    spin: Annotated[
        str | None,
        option(
            DATA,
            "Unmeasured spins before the wall: rad/s at the first contact of each ball (0: thrown without spin), or a prior:"
            " normal, normal:WIDTH, uniform:WIDTH (in v/a, about 0).",
            show_default="normal, mean along v_t and width fitted",
        ),
    ] = None,
    every_contact: Annotated[
        bool,
        option(
            DATA,
            "Take unmeasured spins of a ball's later contacts as independent; by default each contact sets the next one's.",
            "--every-contact",
        ),
    ] = False,
    scatter: Annotated[
        str | None,
        option(
            DATA,
            "Fit what contacts scatter beyond the error bars: a share of the speed before the wall, or m/s.",
            metavar="share|absolute",
            show_default="none",
        ),
    ] = None,
    bootstrap: Annotated[
        int | None, option(OUTPUT, "Number of bootstrap fits.", show_default="200 where quick")
    ] = None,
    profiles: Annotated[
        bool | None,
        option(
            OUTPUT, "Compute intervals by profile likelihood.", "--profiles/--no-profiles", show_default="where quick"
        ),
    ] = None,
    seed: Annotated[
        int | None, shared("seed", default="0", help="Seed of the bootstrap.", rich_help_panel=OUTPUT)
    ] = None,
    report: Annotated[
        Path | None, option(OUTPUT, "Write a report with figures to this file.", metavar="FILE.html")
    ] = None,
    plot: Annotated[Path | None, shared("plot", help="Draw what was measured and what the best laws predict.")] = None,
    explore: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE.html",
            help="With --shot: write a page that plays the fitted shots beside their films.",
            rich_help_panel=OUTPUT,
        ),
    ] = None,
    no_report: Annotated[bool, typer.Option("--no-report", help="The default.", hidden=True)] = False,
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

    faults = FaultList()
    fixed, bounds = _held(faults, fix, bound)
    _pages(faults, report, no_report, plot, explore)
    if by is not None and (report is not None or plot is not None):
        faults.add(
            "", "", advice=f"--{'plot' if report is None else 'report'} has no effect with --by; omit one of them"
        )
    if explore is not None and not shot:
        faults.add("", "", advice="--explore has no effect without --shot; omit it, or add --shot")
    options: dict[str, Any] = {
        "radius": radius, "inertia": inertia, "laws": [name for text in laws for name in comma_separated(text)] if laws else None,
        "restitution": restitution, "friction": friction, "tangential_restitution": tangential_restitution,
        "stiffness_ratio": stiffness_ratio, "forms": forms,
        "fit": [name for text in fit_ or [] for name in comma_separated(text)], "fix": fixed,
        "bound": bounds, "robust": robust, "contact_height": contact_height, "floor_friction": floor_friction,
        "floor_restitution": floor_restitution, "roll": roll, "kind": kind, "stage": stage, "rate": rate,
        "scale": faults.attempt(parse_scale, scale), "view": view, "balls": balls, "whole": whole,
        "cushions": cushions, "shot": shot, "table": table,
        "noise": faults.attempt(parse_length, "noise", noise), "where": where or (), "by": by,
        "sigma_v": sigma_v,
        "sigma_spin": sigma_spin, "spin": spin, "every_contact": every_contact, "scatter": scatter, "bootstrap": bootstrap,
        "profiles": profiles, "seed": seed,
    }  # fmt: skip
    options["film"] = of_films(
        format=format_, down=down, wall=wall, hard=hard, rolling_resistance=rolling_resistance, gravity=gravity, drag=drag,
        window=window, blind=blind, length=length, readout=readout, ball=ball, colour=colour, region=region, start=start, end=end,
        balls=len(ball) if ball else None,
    ) or None  # fmt: skip
    if faults:
        found = FaultList()
        found.attempt(check_fit, files=files, **options)
        raise CaromError(*found, *faults)
    console = err()
    with _bar(console) as progress:
        ranking = fit_laws_to(files, progress=progress, **options)
    shows: list[tuple[bool, Any]] = [(shot, show_shots), (whole, show_whole), (by is not None, show_each)]
    tell(ranking, next((one for wanted, one in shows if wanted), show), as_json, console, ())
    with _bar(console) as progress:  # (what was computed is shown, whatever becomes of the files)
        if report is not None:
            write_report_page(
                lambda: _page(with_options(ranking), files, report), lambda text, done: progress(done, 1.0, text)
            )
            wrote(report)
        if plot is not None:
            from carom.plot.style import save

            save(_picture(ranking), plot)
            wrote(plot)
        if explore is not None:
            from carom.explorer.page import explore as make_page

            make_page(ranking).save(explore)
            wrote(explore)


def _held(
    faults: FaultList, fix: list[str] | None, bound: list[str] | None
) -> tuple[dict[str, float], dict[str, tuple[float, float]]]:
    """Return the parameters that are held, and the bounds of others."""
    fixed = {
        name: faults.attempt(parse_number, "--fix", name, text)
        for name, text in parse_assignments(faults, "--fix", fix)
    }
    bounds = {
        name: faults.attempt(parse_bounds, name, text) for name, text in parse_assignments(faults, "--bound", bound)
    }
    return ({name: x for name, x in fixed.items() if x is not None},
            {name: x for name, x in bounds.items() if x is not None})  # fmt: skip


def _pages(faults: FaultList, report: Path | None, no_report: bool, plot: Path | None, explore: Path | None) -> None:
    pages = (".html", ".htm")
    require_outputs(
        faults, {"--report": report, "--plot": plot, "--explore": explore}, {"--report": pages, "--explore": pages}
    )
    if report is not None and no_report:
        faults.add("", "", advice="--no-report has no effect with --report; omit one of them")


@contextmanager
def _bar(console: Console) -> Iterator[Any]:
    """Show a progress bar on standard error, where that is a terminal."""
    with working("fit", console) as update:
        yield update or (lambda _done, _total, _text: None)


def _picture(ranking: Any) -> Any:
    """Return the figure of a fit: film and model on each other, of rows what was measured and predicted."""
    from carom.fitting import Ranking
    from carom.fitting.shots import ShotsRanking
    from carom.plot.fit import plot_fit, plot_tracks
    from carom.plot.shots import plot_shot, plot_shots

    if not isinstance(ranking, ShotsRanking):
        return plot_fit(ranking) if isinstance(ranking, Ranking) else plot_tracks(ranking)
    return plot_shots(ranking.best) if len(ranking.best.shots) > 1 else plot_shot(ranking.best.shots[0])


def _page(ranking: Any, files: list[Path], path: Path) -> Path:
    from carom.fitting import Ranking
    from carom.fitting.shots import ShotsRanking
    from carom.plot.fit import write_report, write_track_report
    from carom.plot.shots import write_shots_report

    source = shortened_list([str(file) for file in files])
    if isinstance(ranking, ShotsRanking):
        return write_shots_report(ranking, source, path)
    return write_report(ranking, path) if isinstance(ranking, Ranking) else write_track_report(ranking, source, path)
