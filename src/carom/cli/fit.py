"""``carom fit``: rebounds to the laws' numbers, which law the data prefer, and a page to keep."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from carom.cli.fit_input import chosen, completed, is_track, own_set, read
from carom.cli.fit_options import bounds_of, kappa_of, number, pairs, spin_of, split, unread
from carom.cli.places import require_places
from carom.cli.ranking_table import show
from carom.cli.shared import attempt, noting, page_of, tell
from carom.errors import CaromError

if TYPE_CHECKING:
    from rich.console import Console

    from carom.fitting import Ranking, Setting
    from carom.rebounds import Rebounds

BALL, DATA, LAWS, OUT = "The ball", "The table", "The laws", "What comes out"


def register(app: typer.Typer) -> None:
    """Add the verb."""
    app.command()(fit)


def fit(
    file: Annotated[
        Path, typer.Argument(help="a table of rebounds (CSV, Parquet), a track, or a set of carom datasets")
    ],
    radius: Annotated[
        float | None, typer.Option(help="m; a set that comes with carom has its own", rich_help_panel=BALL)
    ] = None,
    inertia: Annotated[
        str | None,
        typer.Option(
            metavar="solid|hollow|KAPPA", help="kappa = I/(m a^2)", show_default="solid", rich_help_panel=BALL
        ),
    ] = None,
    laws: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME,NAME", help="only these; may be repeated", rich_help_panel=LAWS),
    ] = None,
    restitution: Annotated[
        str,
        typer.Option(
            help="over the speed: constant, line, polynomial, viscoelastic, exponential", rich_help_panel=LAWS
        ),
    ] = "constant",
    fit_: Annotated[
        list[str] | None,
        typer.Option(
            "--fit",
            metavar="NAME",
            help="fit this too: kappa, contact_height, floor_friction, roll",
            rich_help_panel=LAWS,
        ),
    ] = None,
    fix: Annotated[
        list[str] | None, typer.Option(metavar="NAME=VALUE", help="hold a number of the laws", rich_help_panel=LAWS)
    ] = None,
    bound: Annotated[
        list[str] | None, typer.Option(metavar="NAME=LOW:HIGH", help="seek it between these", rich_help_panel=LAWS)
    ] = None,
    robust: Annotated[
        bool, typer.Option("--robust", help="errors with heavy tails (Student's t)", rich_help_panel=LAWS)
    ] = False,
    contact_height: Annotated[
        float | None,
        typer.Option(
            "--contact-height",
            "--cushion-height",
            help="where the wall touches, radii: a cushion 1.2 to 1.4",
            show_default="1.0",
            rich_help_panel=LAWS,
        ),
    ] = None,
    floor_friction: Annotated[
        float | None,
        typer.Option(help="of the cloth", show_default="what the film says, else 0.2", rich_help_panel=LAWS),
    ] = None,
    floor_restitution: Annotated[float, typer.Option(rich_help_panel=LAWS)] = 0.0,
    roll: Annotated[
        float, typer.Option(help="share of rolling before the wall: 1, stunned 0", rich_help_panel=LAWS)
    ] = 1.0,
    kind: Annotated[
        str | None, typer.Option(help="planar or table, where the columns do not say", rich_help_panel=DATA)
    ] = None,
    stage: Annotated[str | None, typer.Option(help="of all rows: after_wall or rolling", rich_help_panel=DATA)] = None,
    rate: Annotated[
        float | None,
        typer.Option("--rate", "--fps", help="of a track without times: frames a second", rich_help_panel=DATA),
    ] = None,
    scale: Annotated[
        float | None, typer.Option(help="of a track in pixels: m to a pixel", rich_help_panel=DATA)
    ] = None,
    view: Annotated[str | None, typer.Option(help="of a track: above (a table) or side", rich_help_panel=DATA)] = None,
    whole: Annotated[
        bool,
        typer.Option("--whole", help="of a track: fit all of it, simulated, not its contacts", rich_help_panel=DATA),
    ] = False,
    cushions: Annotated[
        int, typer.Option(help="with --whole: contacts of a ball that are followed at most", rich_help_panel=DATA)
    ] = 3,
    noise: Annotated[
        str | None, typer.Option(help="with --whole: of one coordinate of one frame, 0.3mm", rich_help_panel=DATA)
    ] = None,
    where: Annotated[
        list[str] | None,
        typer.Option(metavar="COLUMN=VALUE", help="only rows with this in that column", rich_help_panel=DATA),
    ] = None,
    sigma_v: Annotated[
        float | None, typer.Option(help="error bar of speeds without one, m/s", rich_help_panel=DATA)
    ] = None,
    sigma_spin: Annotated[
        float | None, typer.Option(help="error bar of spins without one, rad/s", rich_help_panel=DATA)
    ] = None,
    spin: Annotated[
        str | None,
        typer.Option(
            help="where none was measured before: a number in rad/s, normal, normal:WIDTH or uniform:WIDTH (in v/a, about 0)",
            show_default="normal, mean along v_t and width fitted",
            rich_help_panel=DATA,
        ),
    ] = None,
    bootstrap: Annotated[
        int | None, typer.Option(help="fits to rows drawn anew", show_default="200 where quick", rich_help_panel=OUT)
    ] = None,
    profiles: Annotated[
        bool | None,
        typer.Option(
            "--profiles/--no-profiles",
            help="intervals by profile likelihood",
            show_default="where quick",
            rich_help_panel=OUT,
        ),
    ] = None,
    seed: Annotated[int | None, typer.Option(help="of the bootstrap", show_default="0", rich_help_panel=OUT)] = None,
    report: Annotated[
        Path | None, typer.Option(help="the page to write", show_default="FILE-fit.html, here", rich_help_panel=OUT)
    ] = None,
    no_report: Annotated[bool, typer.Option("--no-report", help="write none", rich_help_panel=OUT)] = False,
    as_json: Annotated[
        bool, typer.Option("--json", help="JSON on standard output, nothing else", rich_help_panel=OUT)
    ] = False,
) -> None:
    """Fit the laws of impact to measured rebounds, and say which the data prefer.

    carom fit bounces.csv --radius 0.02 --inertia hollow

    carom fit kharaz
    """
    from rich.console import Console

    from carom.cli.whole import NUMBERS, fit_tracks
    from carom.fitting import Setting, fit_laws
    from carom.fitting.parameters import FORMS, INDEX
    from carom.fitting.shared import with_shared
    from carom.tracks.formats.sheet import Given

    faults: list[str] = []
    kappa = None if inertia is None else attempt(faults, kappa_of, inertia)
    every_spin, prior = attempt(faults, spin_of, spin, whole) or (None, {})
    known = sorted({*INDEX, *(p.name for form in FORMS.values() for p in form.parameters), *(NUMBERS if whole else ())})
    fixed = {name: attempt(faults, number, "--fix", name, text) for name, text in pairs(faults, "--fix", fix, known)}
    bounds = {name: attempt(faults, bounds_of, name, text) for name, text in pairs(faults, "--bound", bound, known)}
    extra = tuple(name for text in fit_ or [] for name in split(text))
    for name, value in (("--sigma-v", sigma_v), ("--sigma-spin", sigma_spin)):
        if value is not None and not value > 0:
            faults.append(f"{name}: expected an error bar above 0, got {value:g}")
    page = report or Path(f"{file.stem}-fit.html")
    _pages(faults, report, no_report)
    if seed is not None and seed < 0:
        faults.append(f"--seed: expected a whole number >= 0, got {seed}")
    faults += unread(
        whole,
        {"--sigma-v": sigma_v, "--sigma-spin": sigma_spin, "--bootstrap": bootstrap, "--profiles": profiles,
         "--kind": kind, "--stage": stage, "--seed": seed, "--robust": robust or None, "--roll": None if roll == 1 else roll},
        {"--noise": noise, "--cushions": cushions if cushions != 3 else None},
    )  # fmt: skip
    names = [name for text in laws or [] for name in split(text)]
    if laws and not names:
        faults.append("--laws: expected names of laws, NAME,NAME, got none; leave it out for all of them")
    faults += _words(names, whole, view, kind, stage, bootstrap)
    own_faults: list[str] = []
    ours = attempt(own_faults, own_set, file)
    if radius is None and ours is None and not own_faults:
        faults.append("--radius: expected the ball's radius, in m, got none; --radius 0.02 is a table-tennis ball")
    given = {"radius": radius, "kappa": kappa, "contact_height": contact_height, "floor_friction": floor_friction}
    ball = (
        {"radius": 1.0}
        | (ours.setting if ours else {})
        | {key: value for key, value in given.items() if value is not None}
    )
    setting = Setting(
        **ball,
        restitution=restitution, floor_restitution=floor_restitution, roll=roll, fit=extra, **prior,
        fixed={name: value for name, value in fixed.items() if value is not None},
        bounds={name: value for name, value in bounds.items() if value is not None}, robust=robust,
    )  # fmt: skip
    if whole:
        pages = (None if no_report else page, report is not None, as_json)
        frames = (view, where or [], cushions, noise)
        return fit_tracks(file, setting, names, Given(scale=scale, rate=rate), frames, pages, faults, _bar)
    attempt(faults, _checked, setting)
    console = Console(stderr=True, highlight=False)
    if own_faults or (ours and faults):
        raise CaromError(*faults, *own_faults)
    film = Given(scale=scale, rate=rate)
    rebounds = ours.rebounds if ours else read(file, faults, setting, film, view, kind, stage, lambda: _bar(console))

    _read(rebounds, ours is None and is_track(file), {"--scale": scale, "--rate": rate, "--view": view},
          {"--contact-height": contact_height, "--floor-friction": floor_friction,
           "--floor-restitution": floor_restitution or None, "--roll": None if roll == 1 else roll})  # fmt: skip

    def ready(rows: Rebounds) -> Rebounds:
        return completed(chosen(rows, where or []), sigma_v, sigma_spin, every_spin)

    rebounds, shifted = ready(rebounds), [(words, ready(rows)) for words, rows in (ours.shifted if ours else ())]
    with noting(rebounds.notes), _bar(console) as say:
        ranking = fit_laws(
            rebounds, setting, names or None, profiles=profiles, bootstrap=bootstrap, seed=seed or 0, say=say
        )
        ranking = with_shared(ranking, shifted)
        say("the page", 1.0)
        written = None if no_report else page_of(lambda: _page(ranking, page), report is not None, console)
    tell(ranking, show, as_json, console, written)


def _words(
    names: list[str], whole: bool, view: str | None, kind: str | None, stage: str | None, bootstrap: int | None
) -> list[str]:
    """Faults of words and numbers that are right or wrong whatever the file holds."""
    from carom.fitting.laws import unknown_laws
    from carom.rebounds import KINDS, STAGES

    more = ("stronge",) if whole else ()
    faults = [f"--laws: {fault.removeprefix('law: ')}" for fault in unknown_laws(names, more=more)]
    if view not in (None, "above", "side"):
        faults.append(f"--view: expected above (a ball on a table) or side (a ball in flight), got {view!r}")
    if whole:  # (they are not read)
        return faults
    if kind not in (None, *KINDS):
        faults.append(f"--kind: expected planar or table, got {kind!r}")
    if stage not in (None, *STAGES):
        faults.append(f"--stage: expected after_wall or rolling, got {stage!r}")
    if bootstrap is not None and (bootstrap < 0 or bootstrap == 1):
        faults.append(f"--bootstrap: expected 0 (none) or a number of draws, 2 or more, got {bootstrap}")
    return faults


def _checked(setting: Setting) -> None:
    from carom.fitting.data import require_settings

    require_settings(setting)


def _pages(faults: list[str], report: Path | None, no_report: bool) -> None:
    require_places(faults, {"--report": report}, {"--report": (".html", ".htm")})
    if report is not None and no_report:
        faults.append("--no-report: expected no --report beside it, got one; give one of them")


def _read(rebounds: Rebounds, track: bool, of_tracks: dict[str, Any], of_tables: dict[str, Any]) -> None:
    """CaromError for options that were given and would do nothing: of a track, or of a ball on a table, where there is none."""
    faults = (
        [] if track else [f"{name}: expected a track, got rebounds" for name, x in of_tracks.items() if x is not None]
    )
    if rebounds.kind == "planar":
        said = "expected rebounds of a ball on a table, got planar ones"
        faults += [f"{name}: {said}" for name, value in of_tables.items() if value is not None]
    if faults:
        raise CaromError(*(f"{fault}; leave it out" for fault in faults))


@contextmanager
def _bar(console: Console) -> Iterator[Any]:
    """A progress bar on standard error, where that is a terminal."""
    if not console.is_terminal:
        yield lambda _what, _done: None
        return
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    columns = (BarColumn(), TextColumn("[progress.description]{task.description}"), TimeElapsedColumn())
    with Progress(*columns, console=console, transient=True) as progress:
        task = progress.add_task("compiling, once", total=1.0)
        yield lambda what, done: progress.update(task, completed=done, description=what)


def _page(ranking: Ranking, path: Path) -> Path:
    from carom.plot.fit import write_report

    return write_report(ranking, path)
