"""``carom fit``: rebounds to the laws' numbers, which law the data prefer, and a page to keep."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from carom.cli.fit_options import bounds_of, kappa_of, number, pairs, spin_of, split
from carom.cli.ranking_table import show
from carom.cli.shared import attempt
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
    file: Annotated[Path, typer.Argument(help="a table of rebounds (CSV, Parquet), or a track")],
    radius: Annotated[float, typer.Option(help="m", rich_help_panel=BALL)],
    inertia: Annotated[
        str, typer.Option(metavar="solid|hollow|KAPPA", help="kappa = I/(m a^2)", rich_help_panel=BALL)
    ] = "solid",
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
        float,
        typer.Option(
            "--contact-height",
            "--cushion-height",
            help="where the wall touches, radii: a cushion 1.2 to 1.4",
            rich_help_panel=LAWS,
        ),
    ] = 1.0,
    floor_friction: Annotated[
        float, typer.Option(help="while a cushion presses the ball on it", rich_help_panel=LAWS)
    ] = 0.2,
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
    seed: Annotated[int, typer.Option(help="of the bootstrap", rich_help_panel=OUT)] = 0,
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
    """
    from rich.console import Console

    from carom.cli.whole import NUMBERS, fit_tracks
    from carom.fitting import Setting, fit_laws
    from carom.fitting.parameters import FORMS, INDEX
    from carom.tracks.formats.sheet import Given

    faults: list[str] = []
    kappa = attempt(faults, kappa_of, inertia)
    every_spin, prior = attempt(faults, spin_of, spin) or (None, {})
    known = sorted({*INDEX, *(p.name for form in FORMS.values() for p in form.parameters), *(NUMBERS if whole else ())})
    fixed = {name: attempt(faults, number, "--fix", name, text) for name, text in pairs(faults, "--fix", fix, known)}
    bounds = {name: attempt(faults, bounds_of, name, text) for name, text in pairs(faults, "--bound", bound, known)}
    extra = tuple(name for text in fit_ or [] for name in split(text))
    for name, value in (("--sigma-v", sigma_v), ("--sigma-spin", sigma_spin)):
        if value is not None and not value > 0:
            faults.append(f"{name}: expected an error bar above 0, got {value:g}")
    page = report or Path(f"{file.stem}-fit.html")
    if report is not None:
        attempt(faults, _writable, report)
    setting = Setting(
        radius=radius, kappa=kappa or 0.4, restitution=restitution, contact_height=contact_height,
        floor_friction=floor_friction, floor_restitution=floor_restitution, roll=roll,
        fit=extra, **prior,
        fixed={name: value for name, value in fixed.items() if value is not None},
        bounds={name: value for name, value in bounds.items() if value is not None}, robust=robust,
    )  # fmt: skip
    if whole:
        names = [name for text in laws or [] for name in split(text)]
        given, frames = Given(scale=scale, rate=rate), (view, where or [], cushions, noise)
        pages = (None if no_report else page, report is not None, as_json)
        return fit_tracks(file, setting, names, given, frames, pages, faults, _bar)
    attempt(faults, _checked, setting)
    console = Console(stderr=True, highlight=False)
    rebounds = None
    if is_track(file):
        if not faults:  # contacts take a while: the options first
            with _bar(console) as say:
                rebounds = _measured(file, setting, Given(scale=scale, rate=rate), view, stage, say)
    else:
        rebounds = attempt(faults, _read, file, kind, stage)
    if faults or rebounds is None:
        raise CaromError(*faults)
    rebounds = _chosen(rebounds, where or [])
    rebounds = _completed(rebounds, sigma_v, sigma_spin, every_spin)
    names = [name for text in laws or [] for name in split(text)]
    with _bar(console) as say:
        ranking = fit_laws(rebounds, setting, names or None, profiles=profiles, bootstrap=bootstrap, seed=seed, say=say)
        say("the page", 1.0)
        written = None if no_report else _page(ranking, page, insists=report is not None, console=console)
    if as_json:
        sys.stdout.write(json.dumps(ranking.as_dict(), indent=2, allow_nan=False) + "\n")
    else:
        show(ranking)
    for note in ranking.notes:
        console.print(f"note: {note}", style="yellow", markup=False, soft_wrap=True)
    if written is not None:
        console.print(f"written: {written}", markup=False, soft_wrap=True)


def _checked(setting: Setting) -> None:
    from carom.fitting.data import require_settings

    require_settings(setting)


def _read(file: Path, kind: str | None, stage: str | None) -> Rebounds:
    from carom.rebounds import KINDS, read_rebounds

    if kind is not None and kind not in KINDS:
        raise CaromError(f"--kind: expected planar or table, got {kind!r}")
    return read_rebounds(file, kind=kind, stage=stage)


def _chosen(rebounds: Rebounds, where: list[str]) -> Rebounds:
    """The rows that ``--where`` names; a note where a column of words says that there are rows of several kinds."""
    from dataclasses import replace

    import numpy as np

    from carom.checks import nearest

    faults = []
    keep = np.ones(len(rebounds), bool)
    for text in where:
        name, _equals, value = text.partition("=")
        column = rebounds.extra.get(name)
        if column is None:
            got = f"{text!r}; {nearest(name, list(rebounds.extra))}" if rebounds.extra else f"{text!r}; it has none"
            faults.append(f"--where: expected COLUMN=VALUE, with a column of the table's own, got {got}")
            continue
        rows = column.astype(str) == value
        if not rows.any():
            found = ", ".join(sorted(set(column.astype(str).tolist()))[:8])
            faults.append(f"--where {name}: expected one of its values ({found}), got {value!r}")
        keep &= rows
    if not faults and not keep.any():
        faults.append("--where: expected conditions that some row meets, got none that meets all")
    if faults:
        raise CaromError(*faults)
    rebounds = rebounds.select(keep)
    kinds = {
        name: sorted(set(column.tolist()))
        for name, column in rebounds.extra.items()
        if _words(column.tolist()) and 1 < len(set(column.tolist())) <= len(rebounds) // 5
    }
    notes = tuple(
        f"{name}: {len(values)} kinds of rows are fitted as one ({', '.join(map(str, values[:4]))}"
        f"{', ...' if len(values) > 4 else ''}); --where {name}={values[0]} fits one of them"
        for name, values in kinds.items()
    )
    return replace(rebounds, notes=(*notes, *rebounds.notes))


def _words(cells: list[Any]) -> bool:
    """Whether a column holds names and not numbers."""
    try:
        return not [float(cell) for cell in cells]
    except (TypeError, ValueError):
        return True


def is_track(file: Path) -> bool:
    """Whether a file has no column of a rebound: then it is taken for a track."""
    if file.suffix.lower() in (".parquet", ".pq") or not file.is_file():
        return False
    with file.open("rb") as opened:
        raw = opened.read(4096)
    utf16 = raw.startswith((b"\xff\xfe", b"\xfe\xff"))  # as spreadsheets save "Unicode text"
    head = raw.decode("utf-16" if utf16 else "utf-8", errors="replace").lower()
    return not any(name in head for name in ("v_n_in", "vn_in", "v_n_out", "vn_out", "v_t_in", "vt_in"))


def _measured(file: Path, setting: Setting, given: Any, view: str | None, stage: str | None, say: Any) -> Rebounds:
    """The rebounds of a track."""
    from dataclasses import replace

    from carom.tracks.contact import Settings
    from carom.tracks.measure import measure
    from carom.tracks.read import read_tracks
    from carom.tracks.table import to_rebounds

    if view not in (None, "above", "side"):
        raise CaromError(f"--view: expected above (a ball on a table) or side (a ball in flight), got {view!r}")
    if stage not in (None, "after_wall", "rolling"):
        raise CaromError(f"--stage: expected after_wall or rolling, got {stage!r}")
    read = read_tracks(file, given=given)
    settings = Settings(radius=setting.radius, kappa=setting.kappa, view=view)  # type: ignore[arg-type]
    measured = measure(read.tracks, settings, lambda done, total: say("contacts", done / max(total, 1)))
    rebounds = to_rebounds(measured, stage or "best")  # type: ignore[arg-type]
    notes = [
        *getattr(read, "notes", ()),
        *measured.notes,
        f"{len(rebounds)} rebounds measured (carom tracks shows them)",
    ]
    return replace(rebounds, source=str(file), notes=(*notes, *rebounds.notes))


def _completed(rebounds: Rebounds, sigma_v: float | None, sigma_spin: float | None, spin: float | None) -> Rebounds:
    """Error bars and spins that the options give, where the table has none."""
    from dataclasses import replace

    import numpy as np

    columns, sigma = dict(rebounds.columns), dict(rebounds.sigma)
    for name, column in columns.items():
        if spin is not None and name in ("spin_in", "spin_z_in"):
            columns[name] = np.where(np.isnan(column), spin, column)
        given = sigma_spin if name.startswith("spin") else sigma_v
        exact = spin is not None and name in ("spin_in", "spin_z_in")
        if given is not None and name not in sigma and np.isfinite(column).any() and not exact:
            sigma[name] = np.full(len(column), given)
    return replace(rebounds, columns=columns, sigma=sigma)


def _writable(path: Path) -> None:
    folder = path.absolute().parent
    if path.is_dir() or not folder.is_dir() or not os.access(folder, os.W_OK):
        raise CaromError(
            f"--report: {path}: expected a file in a folder that exists and can be written to; make it first"
        )


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


def _page(ranking: Ranking, path: Path, *, insists: bool, console: Console) -> Path | None:
    import importlib.util

    if importlib.util.find_spec("matplotlib") is None:
        if insists:
            raise CaromError("--report: needs Matplotlib, which is not installed; run: pip install matplotlib")
        console.print("no report: Matplotlib is not installed (pip install matplotlib)", style="yellow")
        return None
    from carom.plot.fit import write_report

    try:
        return write_report(ranking, path)
    except CaromError as error:
        if insists:
            raise
        console.print(f"no report: {error}", style="yellow", markup=False, soft_wrap=True)
        return None
