"""``carom fit``: fit the laws to measured rebounds or whole tracks, rank them, and write a report."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from carom.cli.common import attempt, require_outputs, tell, write_report_page
from carom.cli.option_names import with_options
from carom.cli.options import (
    OUTPUT,
    REBOUNDS,
    comma_separated,
    parse_assignments,
    parse_bounds,
    parse_inertia,
    parse_length,
    parse_number,
    parse_spin,
    shared,
    unused_options,
)
from carom.cli.ranking_output import show
from carom.errors import CaromError

if TYPE_CHECKING:
    from rich.console import Console

    from carom.data.rebounds import Rebounds
    from carom.fitting import Ranking, Setting

DATA, LAWS = REBOUNDS, "Laws"


def register(app: typer.Typer) -> None:
    """Add the verb."""
    app.command()(fit)


def fit(
    files: Annotated[
        list[Path],
        typer.Argument(
            metavar="FILE",
            help="A table of rebounds (CSV, Parquet), one or more tracks, or a set of carom datasets.",
        ),
    ],
    radius: Annotated[float | None, shared("radius", default="the radius of a set that comes with carom")] = None,
    inertia: Annotated[str | None, shared("inertia", default="solid")] = None,
    laws: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME,NAME", help="Fit only these laws; may be repeated.", rich_help_panel=LAWS),
    ] = None,
    restitution: Annotated[
        str,
        typer.Option(
            help="Restitution as a function of speed: constant, line, polynomial, viscoelastic, exponential.",
            rich_help_panel=LAWS,
        ),
    ] = "constant",
    fit_: Annotated[
        list[str] | None,
        typer.Option(
            "--fit",
            metavar="NAME",
            help="Fit this as well: kappa, contact_height, floor_friction, roll.",
            rich_help_panel=LAWS,
        ),
    ] = None,
    fix: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME=VALUE", help="Hold a parameter of the laws at a value; may be repeated.", rich_help_panel=LAWS
        ),
    ] = None,
    bound: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME=LOW:HIGH", help="Bounds of a fitted parameter; may be repeated.", rich_help_panel=LAWS
        ),
    ] = None,
    robust: Annotated[
        bool, typer.Option("--robust", help="Assume errors with heavy tails (Student's t).", rich_help_panel=LAWS)
    ] = False,
    contact_height: Annotated[float | None, shared("contact_height", default="1")] = None,
    floor_friction: Annotated[float | None, shared("floor_friction", default="what the film says, else 0.2")] = None,
    floor_restitution: Annotated[float, shared("floor_restitution")] = 0.0,
    roll: Annotated[
        float,
        typer.Option(
            help="Spin before the wall, in units of a rolling ball's spin: 1 rolling, 0 without spin.",
            rich_help_panel=LAWS,
        ),
    ] = 1.0,
    kind: Annotated[str | None, shared("kind", default="by the columns")] = None,
    stage: Annotated[
        str | None, typer.Option(help="Stage of all rows: after_wall or rolling.", rich_help_panel=DATA)
    ] = None,
    rate: Annotated[float | None, shared("rate", default="from the times")] = None,
    scale: Annotated[str | None, shared("scale")] = None,
    view: Annotated[str | None, shared("view", default="by the motion")] = None,
    whole: Annotated[
        bool,
        typer.Option(
            "--whole",
            help="Fit whole tracks, each simulated from its own initial state, instead of contacts.",
            rich_help_panel=DATA,
        ),
    ] = False,
    cushions: Annotated[
        int, typer.Option(help="With --whole: largest number of contacts followed per ball.", rich_help_panel=DATA)
    ] = 3,
    noise: Annotated[str | None, shared("noise", default="estimated; only with --whole")] = None,
    where: Annotated[
        list[str] | None,
        typer.Option(
            metavar="COLUMN=VALUE",
            help="Use only rows with this value in the column; may be repeated.",
            rich_help_panel=DATA,
        ),
    ] = None,
    sigma_v: Annotated[float | None, shared("sigma_v", default="of the table")] = None,
    sigma_spin: Annotated[float | None, shared("sigma_spin", default="of the table")] = None,
    spin: Annotated[
        str | None,
        typer.Option(
            help="Unmeasured spins before the wall: rad/s at the first contact of each ball (0: thrown without spin), or a prior:"
            " normal, normal:WIDTH, uniform:WIDTH (in v/a, about 0).",
            show_default="normal, mean along v_t and width fitted",
            rich_help_panel=DATA,
        ),
    ] = None,
    every_contact: Annotated[
        bool,
        typer.Option(
            "--every-contact",
            help="Keep later contacts of thrown balls whose spin was not measured; by default only first ones are fitted.",
            rich_help_panel=DATA,
        ),
    ] = False,
    scatter: Annotated[
        str | None,
        typer.Option(
            metavar="share|absolute",
            help="Fit what contacts scatter beyond the error bars: a share of the speed before the wall, or m/s.",
            show_default="none",
            rich_help_panel=DATA,
        ),
    ] = None,
    bootstrap: Annotated[
        int | None,
        typer.Option(help="Number of bootstrap fits.", show_default="200 where quick", rich_help_panel=OUTPUT),
    ] = None,
    profiles: Annotated[
        bool | None,
        typer.Option(
            "--profiles/--no-profiles",
            help="Compute intervals by profile likelihood.",
            show_default="where quick",
            rich_help_panel=OUTPUT,
        ),
    ] = None,
    seed: Annotated[
        int | None, shared("seed", default="0", help="Seed of the bootstrap.", rich_help_panel=OUTPUT)
    ] = None,
    report: Annotated[
        Path | None,
        typer.Option(metavar="FILE.html", help="Write a report with figures to this file.", rich_help_panel=OUTPUT),
    ] = None,
    no_report: Annotated[bool, typer.Option("--no-report", help="The default.", hidden=True)] = False,
    as_json: Annotated[bool, shared("json")] = False,
) -> None:
    """Fit the laws of impact to measured rebounds, and report which of them the data favour.

    carom fit bounces.csv --radius 0.02 --inertia hollow

    carom fit kharaz
    """
    from carom.cli.console import err
    from carom.files import require_library

    require_library("scipy", "fit")
    from carom.cli.fit_tracks import TrackOptions, fit_track_files
    from carom.data.published import published_at
    from carom.data.rebounds import KINDS, STAGES
    from carom.fitting import Setting, fit_laws
    from carom.fitting.usable_rows import require_error_bars
    from carom.tracks.contact import Settings
    from carom.tracks.film_files import are_films, rebounds_of_files
    from carom.tracks.formats.text_table import Calibration

    faults: list[str] = []
    films = None if whole else attempt(faults, are_films, files)  # (with --whole every file is checked there)
    kappa = None if inertia is None else attempt(faults, parse_inertia, inertia)
    prior = attempt(faults, parse_spin, spin, whole) or {}
    held = _held(faults, fix, bound, whole)
    attempt(faults, require_error_bars, sigma_v, sigma_spin)
    _pages(faults, report, no_report)
    faults += unused_options(
        whole,
        {"--sigma-v": sigma_v, "--sigma-spin": sigma_spin, "--bootstrap": bootstrap, "--profiles": profiles,
         "--every-contact": every_contact or None, "--kind": kind, "--stage": stage, "--seed": seed,
         "--robust": robust or None, "--scatter": scatter,
         "--roll": None if roll == 1 else roll},
        {"--noise": noise, "--cushions": cushions if cushions != 3 else None},
    )  # fmt: skip
    metres = attempt(faults, parse_length, "scale", scale)
    names = [name for text in laws or [] for name in comma_separated(text)]
    faults += _words(names if laws else None, whole, view, kind, stage, bootstrap, seed)
    own_faults: list[str] = []
    ours = attempt(own_faults, published_at, files[0])
    if radius is None and ours is None and not own_faults:
        faults.append("--radius: expected the ball's radius in m, got none; a table-tennis ball has --radius 0.02")
    given = {"radius": radius, "kappa": kappa, "contact_height": contact_height, "floor_friction": floor_friction}
    ball = (
        {"radius": 1.0}
        | (ours.setting if ours else {})
        | {key: value for key, value in given.items() if value is not None}
    )
    setting = Setting(
        **ball,
        restitution=restitution, floor_restitution=floor_restitution, roll=roll, **prior, **held,
        fit=tuple(name for text in fit_ or [] for name in comma_separated(text)), robust=robust, scatter=scatter or "",
    )  # fmt: skip
    if whole:
        frames = TrackOptions(view, where or [], cushions, noise, Calibration(scale=metres, rate=rate))
        return fit_track_files(files, setting, names, frames, report, as_json, faults, _bar)
    attempt(faults, _checked, setting)
    console = err()
    if own_faults or (faults and (ours or films)):  # (before contacts are measured, which takes time)
        raise CaromError(*faults, *own_faults)
    rebounds = ours.rebounds if ours else None
    if films is not None and ours is None:
        about = Settings(radius=setting.radius, kappa=setting.kappa, view=view)  # type: ignore[arg-type]
        with _bar(console) as say:

            def read() -> Rebounds:
                return rebounds_of_files(
                    files, Calibration(scale=metres, rate=rate), about,
                    kind=kind if kind in KINDS else None, stage=stage if stage in STAGES else None,  # type: ignore[arg-type]
                    progress=lambda done, total, text: say(text, done / total),
                )  # fmt: skip

            rebounds = read() if films else attempt(faults, read)  # (an error of films carries notes)
    if faults or rebounds is None:
        raise CaromError(*faults)
    _read(rebounds, bool(films), {"--scale": scale, "--rate": rate, "--view": view},
          {"--contact-height": contact_height, "--floor-friction": floor_friction,
           "--floor-restitution": floor_restitution or None, "--roll": None if roll == 1 else roll})  # fmt: skip

    with _bar(console) as say:
        ranking = fit_laws(
            rebounds, setting, names or None, where=where or (), sigma_v=sigma_v, sigma_spin=sigma_spin, spin=spin,
            every_contact=every_contact, shifted=ours.shifted if ours else (), profiles=profiles, bootstrap=bootstrap,
            seed=seed or 0, say=say,
        )  # fmt: skip
        written = None if report is None else write_report_page(lambda: _page(with_options(ranking), report), say)
    tell(ranking, show, as_json, console, written)


def _held(faults: list[str], fix: list[str] | None, bound: list[str] | None, whole: bool) -> dict[str, Any]:
    """Return the parameters that are held, and bounds of the others, as fields of a Setting."""
    from carom.cli.fit_tracks import TRACK_NUMBERS
    from carom.fitting.parameters import FORMS, INDEX

    forms = (p.name for form in FORMS.values() for p in form.parameters)
    known = sorted({*INDEX, *forms, *(TRACK_NUMBERS if whole else ())})
    fixed = {
        name: attempt(faults, parse_number, "--fix", name, text)
        for name, text in parse_assignments(faults, "--fix", fix, known)
    }
    bounds = {
        name: attempt(faults, parse_bounds, name, text)
        for name, text in parse_assignments(faults, "--bound", bound, known)
    }
    return {field: {name: value for name, value in given.items() if value is not None}
            for field, given in (("fixed", fixed), ("bounds", bounds))}  # fmt: skip


def _words(
    names: list[str] | None,
    whole: bool,
    view: str | None,
    kind: str | None,
    stage: str | None,
    bootstrap: int | None,
    seed: int | None,
) -> list[str]:
    """Return one line per invalid option, as far as that does not depend on the file."""
    from carom.data.rebounds import KINDS, STAGES
    from carom.fitting.laws import unknown_laws

    faults = [f"--laws: {fault.removeprefix('law: ')}" for fault in unknown_laws(names or [])]
    if names == []:
        faults.append("--laws: expected names of laws, NAME,NAME, got none; omit the option to fit all laws")
    if seed is not None and seed < 0:
        faults.append(f"--seed: expected a whole number >= 0, got {seed}")
    if view not in (None, "above", "side"):
        faults.append(f"--view: expected above (a ball on a table) or side (a ball in flight), got {view!r}")
    if whole:  # (not used)
        return faults
    if kind not in (None, *KINDS):
        faults.append(f"--kind: expected planar or table, got {kind!r}")
    if stage not in (None, *STAGES):
        faults.append(f"--stage: expected after_wall or rolling, got {stage!r}")
    if bootstrap is not None and (bootstrap < 0 or bootstrap == 1):
        faults.append(f"--bootstrap: expected 0 (none) or a number of draws, 2 or more, got {bootstrap}")
    return faults


def _checked(setting: Setting) -> None:
    from carom.fitting.setting import require_settings

    require_settings(setting)


def _pages(faults: list[str], report: Path | None, no_report: bool) -> None:
    require_outputs(faults, {"--report": report}, {"--report": (".html", ".htm")})
    if report is not None and no_report:
        faults.append("--no-report: expected no --report with it, got one; give one of them")


def _read(rebounds: Rebounds, track: bool, of_tracks: dict[str, Any], of_tables: dict[str, Any]) -> None:
    """Raise CaromError for options without effect: options for tracks with rebounds, options for tables with planar rebounds."""
    faults = (
        [] if track else [f"{name}: expected a track, got rebounds" for name, x in of_tracks.items() if x is not None]
    )
    if rebounds.kind == "planar":
        said = "expected rebounds of a ball on a table, got planar ones"
        faults += [f"{name}: {said}" for name, value in of_tables.items() if value is not None]
    if faults:
        raise CaromError(*(f"{fault}; omit the option" for fault in faults))


@contextmanager
def _bar(console: Console) -> Iterator[Any]:
    """Show a progress bar on standard error, where that is a terminal."""
    if not console.is_terminal:
        yield lambda _what, _done: None
        return
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    columns = (BarColumn(), TextColumn("{task.description}", markup=False), TimeElapsedColumn())
    with Progress(*columns, console=console, transient=True) as progress:
        task = progress.add_task("compiling, once", total=1.0)
        yield lambda what, done: progress.update(task, completed=done, description=what)


def _page(ranking: Ranking, path: Path) -> Path:
    from carom.plot.fit import write_report

    return write_report(ranking, path)
