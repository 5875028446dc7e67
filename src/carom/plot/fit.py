"""Figures and HTML reports of fits: to rebounds, whole tracks, whole shots, flights."""

from __future__ import annotations

import html
import io
import math
from collections.abc import Callable, Iterable, Sequence
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from carom.fitting.result import with_error_bar
from carom.formatting import called_ball
from carom.laws.registry import law_styles
from carom.plot.style import COLOURS, GREY, INK, literal, new_figure, style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from carom.fitting import Fit, Ranked, Ranking
    from carom.fitting.free_balls import AirFit
    from carom.fitting.shots import FittedShot, ShotsFit, ShotsRanking
    from carom.fitting.tracks import TrackFit, TrackRanking
    from carom.tracks.video.reading import TrackedFilm


SHOWN = 4  # laws in one picture
WIDTH = 5.4  # inches: letters are read on a phone, and from the last row
NAMES = ("normal speed", "speed along wall", "spin")


class ResidualPanels(NamedTuple):
    """What a fit leaves of its data, against what the data were taken at: an axis for each, a line of panels for each output."""

    title: str
    against: dict[str, Any]
    """(N,) by label: incidence, speed, order of the session."""
    outputs: dict[str, dict[str, Any]]
    """(N,) by law, the best first, by output."""
    bars: bool = False
    """Whether they are in error bars; else distances, mm."""


def residuals_of_rows(ranking: Ranking) -> ResidualPanels:
    """Return the residuals of the two best laws, in error bars."""
    rows = ranking.best.problem.rebounds
    side = np.where(rows["v_t_in"] < 0, -1.0, 1.0)[:, None] ** [0, 1, 1]  # (contacts from both sides are mirror images)
    gaps = {one.fit.law.name: side * one.fit.residuals() for one in ranking.ranked[:2]}
    seen = [j for j in range(3) if np.isfinite(ranking.best.problem.y[:, j]).any()]
    return ResidualPanels(
        "Residuals: (measured - law) / error bar",
        {
            "incidence, degrees": np.degrees(np.abs(rows.angle_in)), "speed, m/s": np.hypot(rows["v_n_in"], rows["v_t_in"]),
            "row": np.arange(len(rows)) + 1,
        },
        {NAMES[j]: {name: gap[:, j] for name, gap in gaps.items()} for j in seen}, True,
    )  # fmt: skip


def residuals_of_tracks(ranking: TrackRanking) -> ResidualPanels:
    """Return the distances of the segments under the two best laws, mm."""
    segments = ranking.best.frames.segments
    before = [np.searchsorted(one.time, one.contacts[0]) - 1 for one in segments]
    v = np.array([(one.position[k] - one.position[0]) / one.time[k] for one, k in zip(segments, before, strict=True)])
    v = np.where([[one.walls[0] in ("bottom", "top")] for one in segments], v[:, ::-1], v)  # (normal, along)
    return ResidualPanels(
        "Distance from track to law, of each segment",
        {
            "incidence, degrees": np.degrees(np.arctan2(*np.abs(v.T[::-1]))), "speed, m/s": np.hypot(*v.T),
            "segment": np.arange(len(v)) + 1,
        },
        {"RMS, mm": {fit.law.name: np.array([1e3 * fit.rms([n]) for n in range(len(v))]) for fit in ranking.fits[:2]}},
    )  # fmt: skip


def residuals_of_shots(fits: Sequence[ShotsFit]) -> ResidualPanels:
    """Return the distances of whole shots under some laws, mm; the incidence is that of the struck ball's first cushion."""
    shots = fits[0].shots
    found = {fit.law.name: np.array([1e3 * shot.rms for shot in fit.shots]) for fit in fits}
    return ResidualPanels(
        "Distance from film to law, of each shot",
        {
            "incidence, degrees": np.array([_first_incidence(shot) for shot in shots]),
            "speed, m/s": np.array([np.linalg.norm(shot.velocity) for shot in shots]), "shot": np.arange(len(shots)) + 1,
        },
        {"RMS, mm": {name: far for name, far in found.items() if len(far) == len(shots)}},
    )  # fmt: skip


def _first_incidence(shot: FittedShot) -> float:
    """Return the angle between the struck ball's path and the normal of the first cushion that it meets, degrees; NaN for none."""
    from carom.fitting.shots.result import table_of

    table, met = table_of(shot.scene), shot.simulate().events.of("wall", ball=0)
    if not met:
        return math.nan
    side = np.array([table.length, table.width]) / 2 - np.abs(met[0].position[:2] - table.center)
    v = np.abs(np.asarray(met[0].before.velocity)[:2])
    return math.degrees(math.atan2(*(v if side[0] > side[1] else v[::-1])))


def residuals_of_flights(fit: AirFit) -> ResidualPanels:
    """Return the distances of flights from their paths, mm."""
    return ResidualPanels(
        "Distance from flight to path", dict(fit.against), {"RMS, mm": {"flight": 1e3 * fit.distances}}
    )


def _residual_panel(axes: Any, found: ResidualPanels, label: str, output: str) -> None:
    """Plot the residuals of one output against one quantity: filled dots of the best law, open ones of the next."""
    x, series = found.against[label], found.outputs[output]
    look = law_styles(list(series))
    if found.bars:
        axes.axhspan(-2, 2, color="#eeeeee", zorder=0)
        axes.axhline(0, color=GREY, lw=0.6)
    for k, (name, y) in enumerate(series.items()):
        colour = look[name][0]
        face = {"color": colour} if k == 0 else {"mec": colour, "mfc": "none", "mew": 0.7}
        axes.plot(
            x,
            y,
            "o",
            ms=3.5 if len(x) < 50 else 2.5 if len(x) < 300 else 1.2,
            label=literal(name),
            zorder=3 - k,
            **face,
        )
    every = np.concatenate(list(series.values()))
    if not found.bars and np.nanmax(every) > 10 * np.nanmin(every):
        _in_mm(axes)
    elif not found.bars:
        axes.set_ylim(0, 1.1 * np.nanmax(every))
    axes.locator_params(axis="x", nbins=4, integer=bool((np.asarray(x) % 1 == 0).all()))
    axes.set(xlabel=label)


def _varied(found: ResidualPanels) -> list[str]:
    """Return the quantities that were varied; the order, if none was."""
    steady = [label for label, x in found.against.items() if not np.nanstd(x) > 1e-9 * np.nanmax(np.abs(x))]
    return [label for label in found.against if label not in steady] or list(found.against)[-1:]


def _residual_grid(figure: Any, found: ResidualPanels, height: float) -> None:
    """Plot residuals, a line of panels for each output."""
    shown = _varied(found)
    panels = figure.subplots(len(found.outputs), len(shown), squeeze=False, sharex="col", sharey="row")
    for line, output in zip(panels, found.outputs, strict=True):
        for axes, label in zip(line, shown, strict=True):
            _residual_panel(axes, found, label, output)
            axes.label_outer()
        line[0].set_ylabel(output)
    compared = len(next(iter(found.outputs.values()))) > 1
    head = 0.5 if compared else 0.32
    figure.subplots_adjust(left=0.12, right=0.98, top=1 - head / height, bottom=0.46 / height, wspace=0.1, hspace=0.12)
    figure.text(0.01, 1 - 0.05 / height, found.title, va="top", fontsize=9)
    if compared:
        figure.legend(
            *panels[0, 0].get_legend_handles_labels(), loc="upper left", ncols=2, frameon=False,
            bbox_to_anchor=(0.0, 1 - 0.18 / height), borderaxespad=0.0, handletextpad=0.2, columnspacing=1.0,
        )  # fmt: skip


def _residual_height(found: ResidualPanels) -> float:
    """Return the height of a grid of residuals, inches."""
    return 0.96 + 1.25 * len(found.outputs)


def residual_parts(found: ResidualPanels) -> list[str]:
    """Return residuals for a page: drawings beside each other, or below each other on a narrow one."""
    parts = [f"<h2>{found.title}</h2>"]
    for output in found.outputs:
        drawings = []
        for label in _varied(found):

            def draw(axes: Any, label: str = label, output: str = output) -> None:
                _residual_panel(axes, found, label, output)
                axes.set_ylabel(output)

            drawings.append(panel(draw, 2.7, 1.9, left=0.21, right=0.97, top=0.95, bottom=0.26))
        parts.append(beside(drawings, "beside three"))
    said = "Filled: " + "; open: ".join(next(iter(found.outputs.values())))
    return [*parts, f"<p>{html.escape(said)}{'; grey: two error bars.' if found.bars else '.'}</p>"]


def plot_fit(ranking: Ranking) -> Figure:
    """Plot what was measured beside the best laws, and residuals against incidence, speed and order (a Matplotlib Figure)."""
    found = residuals_of_rows(ranking)
    height = _residual_height(found)
    with style():
        figure = new_figure(WIDTH, 2.5 + height)
        upper, lower = figure.subfigures(2, 1, squeeze=False, height_ratios=[2.5, height]).flat
        _measured(upper.subplots(), ranking)
        upper.subplots_adjust(left=0.12, right=0.68, top=0.96, bottom=0.2)
        spins = "at the mean spin" if ranking.best.problem.unknown.any() else None
        upper.axes[0].legend(
            loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False, markerscale=1.6, title=spins, handletextpad=0.2
        )
        _residual_grid(lower, found, height)
    return figure


def plot_flights(fit: AirFit) -> Figure:
    """Plot the distances of flights from their paths against spin, speed and order (a Matplotlib Figure)."""
    found = residuals_of_flights(fit)
    height = _residual_height(found)
    with style():
        figure = new_figure(WIDTH, height)
        _residual_grid(figure, found, height)
    return figure


def _look(ranking: Ranking) -> dict[str, tuple[str, Any]]:
    return law_styles([one.fit.law.name for one in ranking.ranked])


def _measured(axes: Any, ranking: Ranking) -> None:
    """Plot what was measured, and the best laws: the motion along the wall, or of balls that came straight the restitution."""
    (_along if ranking.best.problem.rebounds["v_t_in"].any() else _normal)(axes, ranking, ranking.ranked[:SHOWN])


def _points(axes: Any, x: Any, y: Any, xerr: Any = None, yerr: Any = None) -> None:
    many = len(x) > 300
    axes.errorbar(
        x, y, xerr=None if many else xerr, yerr=None if many else yerr, fmt="o", ms=1.5 if many else 3, color=INK,
        elinewidth=0.6, alpha=0.3 if many else 0.9, label="measured", zorder=1, rasterized=many,
    )  # fmt: skip


def _outliers(axes: Any, ranking: Ranking, x: Any, y: Any, label: str = "") -> None:
    """Plot rings around the outliers."""
    names = {outlier.row for outlier in ranking.outliers}
    rows = [i for i, name in enumerate(ranking.best.problem.rebounds.rows) if name in names]
    if rows:
        axes.plot(x[rows], y[rows], "o", ms=9, mfc="none", mec="#D55E00", mew=1.2, label=label or "_", zorder=3)


def _normal(axes: Any, ranking: Ranking, shown: Sequence[Ranked[Fit]]) -> None:
    """Plot the ratio of normal speeds over the speed before, measured and predicted by some laws."""
    rebounds = ranking.best.problem.rebounds
    v, bars = rebounds["v_n_in"], rebounds.sigma.get("v_n_out")
    _points(axes, v, rebounds["v_n_out"] / v, rebounds.sigma.get("v_n_in"), None if bars is None else bars / v)
    _outliers(axes, ranking, v, rebounds["v_n_out"] / v, "outlier")
    for one in shown:
        axes.plot(
            v,
            one.fit.predicted()[:, 0] / v,
            ".",
            ms=3,
            color=_look(ranking)[one.fit.law.name][0],
            label=one.fit.law.name,
        )
    axes.set(xlabel="normal speed before, m/s", ylabel="normal speed after / before")


def _along(axes: Any, ranking: Ranking, shown: Sequence[Ranked[Fit]]) -> None:
    """Plot slip over normal speed for planar bounces, or the angles of balls on a table, measured and predicted by some laws."""
    best = ranking.best
    planar = best.law.kind == "planar"
    rebounds, a = best.problem.rebounds, best.problem.setting.radius
    look = _look(ranking)
    seen = np.isfinite(best.problem.y)
    if planar and seen[:, 1:].all() and np.isfinite(rebounds["spin_in"]).all():
        v = rebounds["v_n_in"]

        def place(y: Any) -> Any:
            return (y[:, 1] - a * y[:, 2]) / v

        x = (rebounds["v_t_in"] - a * rebounds["spin_in"]) / v
        sign = np.where(x < 0, -1.0, 1.0)
        words = ("slip before / normal speed", "slip after / normal speed before")
        xerr = yerr = None
    elif not seen[:, :2].all(axis=1).any():
        # no angle of reflection: the one that was measured

        def place(y: Any) -> Any:
            return (y[:, 1] if seen[:, 1].any() else a * y[:, 2]) / v

        v = rebounds["v_n_in"]
        x = rebounds["v_t_in"] / v
        sign = np.where(x < 0, -1.0, 1.0)
        after = "along the wall" if seen[:, 1].any() else "radius times spin"
        words = ("speed along the wall before / normal speed", f"{after} after / normal before")
        xerr = yerr = None
    else:

        def place(y: Any) -> Any:
            return np.degrees(np.arctan2(y[:, 1], y[:, 0]))

        x = np.degrees(rebounds.angle_in)
        sign = np.where(x < 0, -1.0, 1.0)
        words = ("incidence, degrees", "reflection, degrees")
        xerr = _angle_error(best, "in")
        yerr = _angle_error(best, "out")
    measured = np.stack([rebounds["v_n_out"], rebounds["v_t_out"], _spin_out(rebounds)], axis=-1)
    _points(axes, x * sign, place(measured) * sign, xerr, yerr)
    _outliers(axes, ranking, x * sign, place(measured) * sign)
    order = np.argsort(x * sign)
    for one in shown:
        (ink, _dash), name = look[one.fit.law.name], one.fit.law.name
        axes.plot(
            (x * sign)[order], (place(one.fit.predicted()) * sign)[order], ".", ms=2.5, color=ink, label=name, zorder=2
        )
    low, high = axes.get_xlim()
    if not planar and words[1].endswith("degrees"):
        axes.plot((0, 90), (0, 90), color=GREY, lw=0.6, ls=":")
        axes.set_xlim(low, high)
        top = float(np.nanmax(np.abs(place(measured)))) * 1.15
        axes.set_ylim(bottom=max(axes.get_ylim()[0], -top), top=min(axes.get_ylim()[1], max(top, 20)))
    else:
        axes.axhline(0, color=GREY, lw=0.6, ls=":")
    axes.set(xlabel=words[0], ylabel=words[1])


def _angle_error(fit: Fit, side: str) -> Any:
    rebounds = fit.problem.rebounds
    names = (f"v_n_{side}", f"v_t_{side}")
    if any(name not in rebounds.sigma for name in names):
        return None
    n, t = (rebounds[name] for name in names)
    sn, st = (rebounds.sigma[name] for name in names)
    return np.degrees(np.sqrt(np.square(t * sn) + np.square(n * st)) / (n * n + t * t))


def _spin_out(rebounds: Any) -> Any:
    return rebounds["spin_out" if rebounds.kind == "planar" else "spin_z_out"]


def svg(figure: Any) -> str:
    """Return a figure as SVG for a page."""
    buffer = io.StringIO()
    with style():
        figure.savefig(buffer, format="svg", metadata={"Date": None})
    text = buffer.getvalue()
    return text[text.index("<svg") :]


MARGINS = {"left": 0.13, "right": 0.97, "top": 0.97, "bottom": 0.16}  # of a panel with axes
LEGEND = {"top": 0.88}  # of one with a legend above them


def panel(draw: Callable[[Any], None], width: float, height: float, **margins: float) -> str:
    """Return one panel as a drawing of its own: on a narrow page such drawings stand below each other, and stay readable."""
    with style():
        figure = new_figure(width, height)
        draw(figure.subplots())
        figure.subplots_adjust(**margins)
    return svg(figure)


def beside(drawings: Iterable[str], kind: str = "beside") -> str:
    """Return drawings beside each other, as many as the page is wide."""
    return f'<div class="{kind}">{"".join(drawings)}</div>'


PAGE = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>{title}</title>
<meta name="viewport" content="width=device-width, initial-scale=1">
<style>
body {{ font: 16px/1.5 system-ui, sans-serif; color: #222; max-width: 62rem; margin: 2rem auto; padding: 0 1rem; }}
h1 {{ font-size: 1.5rem; overflow-wrap: anywhere; }} h2 {{ font-size: 1.1rem; margin-top: 2rem; }}
p.verdict {{ font-size: 1.15rem; border-left: 4px solid {colour}; padding: .4rem .8rem; background: #f6f6f4; }}
div.wide {{ overflow-x: auto; }}
table {{ border-collapse: collapse; font-size: .88rem; }} th, td {{ padding: .25rem .7rem; }}
th, td {{ text-align: left; vertical-align: top; }}
th {{ border-bottom: 1px solid #444; white-space: nowrap; }} td.n {{ text-align: right; white-space: nowrap; }}
tr:nth-child(odd) td {{ background: #fafaf8; }} tr.best td {{ font-weight: 600; }}
th:first-child, td:first-child {{ min-width: 8rem; }}
svg {{ max-width: 100%; height: auto; }} footer {{ color: #777; font-size: .8rem; margin-top: 2rem; }}
h3 {{ font-size: 1rem; margin: 1rem 0 .2rem; }}
div.beside {{ display: flex; flex-wrap: wrap; gap: .2rem .8rem; }} div.beside svg {{ flex: 0 1 29rem; min-width: 0; }}
div.small svg {{ flex: 0 1 11.5rem; }} div.three svg {{ flex: 0 1 19rem; }}
@media (max-width: 40rem) {{
div.beside svg {{ flex-basis: 100%; }} div.small svg {{ flex-basis: 47%; }}
table.laws, .laws tr, .laws td {{ display: block; }} .laws th {{ display: none; }} .laws td {{ padding: 0 .5rem; }}
.laws td.n {{ text-align: left; }} .laws td.n::before {{ content: attr(data-head) " "; color: #777; }}
.laws tr {{ margin-bottom: 1rem; }}
}}
@media (prefers-color-scheme: dark) {{
:root {{ color-scheme: dark; }} body {{ color: #e6e6e6; background: #111; }}
p.verdict, tr:nth-child(odd) td {{ background: #1c1c1c; }}
th {{ border-color: #999; }} footer {{ color: #999; }} svg, svg image {{ filter: invert(.93) hue-rotate(180deg); }}
}}
</style></head><body>
{body}
</body></html>
"""


def _cell(text: str, head: str = "") -> str:
    """Return a cell of a table; one of numbers has the head of its column, which stands before it on a narrow page."""
    return f'<td class="n" data-head="{head}">{text}</td>' if head else f"<td>{text}</td>"


def table_of_laws(
    ranking: Ranking | TrackRanking | ShotsRanking, heads: Sequence[str], cells: Callable[[Any], Sequence[str]],
    parameters: bool = True,
) -> str:  # fmt: skip
    """Return the table of laws, best first; ``cells`` of a ranked fit: one for each of ``heads``, and the parameters."""
    rows, numbered = [], ("ΔAICc", *heads)
    for one in ranking.ranked:
        law, found = one.fit.law, (f"{one.fit.aicc - ranking.best.aicc:.1f}", *cells(one))
        made = _cell(f"<b>{law.name}</b><br>{html.escape(law.words)}")
        made += "".join(map(_cell, found[: len(numbered)], numbered)) + "".join(map(_cell, found[len(numbered) :]))
        rows.append(f'<tr class="{"best" if one is ranking.ranked[0] else ""}">{made}</tr>')
    head = "".join(f"<th>{head}</th>" for head in ("law", *numbered, *(["parameters"] if parameters else [])))
    return f'<div class="wide"><table class="laws"><tr>{head}</tr>{"".join(rows)}</table></div>'


def _laws(ranking: Ranking) -> str:
    least_bic = min(one.fit.bic for one in ranking.ranked)

    def cells(one: Ranked[Fit]) -> tuple[str, ...]:
        fit = one.fit
        numbers = (
            "<br>".join(
                f"{html.escape(n)} {html.escape(with_error_bar(e, interval=True))}" for n, e in fit.estimates.items()
            )
            or "none"
        )
        if fit.contact_scatter is not None:
            numbers += "<br>" + fit.scatter_in_words
        elif fit.scatter:
            numbers += "<br>scatter: " + ", ".join(f"{n} {s:.3g}" for n, s in fit.scatter.items())
        goodness = "–" if fit.scatter or fit.dof <= 0 else f"{fit.chi2:.1f} / {fit.dof}"
        weight, score = (
            f"{one.weight:.3g}" if one.weight >= 1e-6 else "0",
            "–" if math.isnan(one.score) else f"{one.score:.3f}",
        )
        return f"{fit.bic - least_bic:.1f}", weight, goodness, score, numbers

    return table_of_laws(ranking, ("ΔBIC", "weight", "chi² / dof", "CV log score"), cells)


def write_page(
    ranking: Ranking | TrackRanking | ShotsRanking, path: str | Path, source: str, title: str, parts: Sequence[str],
    footer: str = "", films: Sequence[TrackedFilm] = (),
) -> Path:  # fmt: skip
    """Write the HTML page of a fit atomically: title, verdict, parts (HTML), unconstrained parameters, notes, sheets of films."""
    from carom import __version__
    from carom.files import write_text

    about = html.escape(Path(source).name)
    body = [
        f"<h1>{title.format(about)}</h1>", f'<p class="verdict">{html.escape(ranking.verdict)}</p>', *parts,
        listed("Unconstrained parameters", ranking.degenerate), listed("Notes", list(ranking.notes)), *film_parts(films),
        f"<footer>carom {__version__}. {footer or ranking.aicc_note}</footer>",
    ]  # fmt: skip
    colour = "#009E73" if ranking.decisive else "#E69F00"
    write_text(Path(path), PAGE.format(title=f"carom fit: {about}", colour=colour, body="\n".join(body)))
    return Path(path)


def listed(title: str, lines: list[str]) -> str:
    """Return a heading and a list of lines as HTML; nothing without lines."""
    items = "".join(f"<li>{html.escape(line)}</li>" for line in lines)
    return f"<h2>{title}</h2><ul>{items}</ul>" if lines else ""


def _table(fit: Fit) -> str:
    """Return the assumed height of the cushion and friction of the cloth, for a ball on a table."""
    setting = fit.problem.setting
    if fit.law.kind == "planar":
        return ""
    return f"; the cushion touches it at {setting.contact_height:.4g} radii, friction of the cloth {setting.floor_friction:.4g}"


def film_parts(films: Sequence[TrackedFilm]) -> list[str]:
    """Return the contact sheets of films as HTML."""
    from carom.plot.tracks import plot_film

    return [f"<h2>Film {html.escape(film.path.name)}</h2>{svg(plot_film(film))}" for film in films]


def write_report(ranking: Ranking, path: str | Path, films: Sequence[TrackedFilm] = ()) -> Path:
    """Write the HTML report atomically: verdict, figures, table, unconstrained parameters, outliers, sheets of the films."""
    setting, best = ranking.best.problem.setting, ranking.best
    ball = f" Ball of radius {setting.radius * 1e3:.4g} mm, moment of inertia {setting.kappa:.4g} m a²{_table(best)}."

    def measured(axes: Any) -> None:
        _measured(axes, ranking)
        axes.legend(loc="best", frameon=False, markerscale=1.6)

    parts = [
        f"<p>{len(best.problem.x)} rebounds ({best.law.kind}), {best.problem.count} measurements after the wall."
        f"{ball if best.problem.rebounds['v_t_in'].any() else ''}</p>",
        beside([panel(measured, 3.9, 2.9, **MARGINS)]),
        "<h2>The laws, best first</h2>", _laws(ranking), *residual_parts(residuals_of_rows(ranking)),
        listed("Outliers under the best law", [f"{o.row}: chi² {o.chi2:.1f}; {o.why}" for o in ranking.outliers]),
    ]  # fmt: skip
    footer = (
        f"ΔAICc: how much higher the law's AICc"
        f" ({'Hurvich and Tsai' if best.scatter else 'chi² + 2 k, error bars given'}) is than the lowest, {best.aicc:.1f}; ΔBIC:"
        f" the same of BIC, {min(one.fit.bic for one in ranking.ranked):.1f}. Lower is better; weight and CV log score"
        " (cross-validation, per row left out): higher is better."
    )
    source = best.problem.rebounds.source
    return write_page(ranking, path, source, "Which law is right for {}?", parts, footer, films)


# ----------------------------------------------------------------------------------------------------
# Figures of whole tracks and their simulations, and the HTML report.


FARTHEST = 4  # shots that are drawn from above


def plot_tracks(ranking: TrackRanking) -> Figure:
    """Plot the farthest shots from above, tracked and simulated, the distances of all, and over time (a Matplotlib Figure)."""
    best, found = ranking.best, residuals_of_tracks(ranking)
    shots = list(dict.fromkeys(one.group for one in best.frames.segments))
    shots.sort(key=lambda shot: -best.rms([n for n, one in enumerate(best.frames.segments) if one.group == shot]))
    shown = shots[:FARTHEST]
    size = np.ptp(np.concatenate([one.position for one in best.frames.segments]), axis=0)
    columns = min(2 if size[0] > size[1] else FARTHEST, len(shown))
    rows, wide = -(-len(shown) // columns), WIDTH / columns
    above, height = rows * min(2.6, 0.25 + wide * float(size[1] / size[0])) + 0.35, _residual_height(found)  # inches
    with style():
        figure = new_figure(WIDTH, above + height + 2.0)
        upper, middle, lower = figure.subfigures(3, 1, squeeze=False, height_ratios=[above, height, 2.0]).flat
        panels = upper.subplots(rows, columns, squeeze=False)
        for axes in panels.flat[len(shown) :]:
            axes.set_axis_off()
        for axes, shot in zip(panels.flat, shown, strict=False):
            _from_above(axes, best, shot)
        upper.subplots_adjust(left=0.01, right=0.99, top=1 - 0.5 / above, bottom=0.01, wspace=0.06, hspace=0.28)
        far = f", the farthest of {len(shots)} shots" if len(shots) > len(shown) else ""
        upper.suptitle(f"Tracked (dots) and {literal(best.law.name)} (lines){far}", fontsize=9)
        _residual_grid(middle, found, height)
        _track_distances(lower.subplots(), best)
        lower.subplots_adjust(left=0.12, right=0.98, top=0.9, bottom=0.22)
    return figure


def _from_above(axes: Any, fit: TrackFit, shot: str) -> None:
    """Plot one shot: all its segments, and the lines on which the ball's centre turns."""
    at = {**fit.model.held, **fit.numbers}
    which = [n for n, one in enumerate(fit.frames.segments) if one.group == shot]
    names = list(dict.fromkeys(one.name for one in fit.frames.segments))
    every = np.concatenate([one.position for one in fit.frames.segments])
    low, high = every.min(axis=0), every.max(axis=0)
    for name, value in at.items():
        side = name.removeprefix("wall_")
        if side in ("left", "right"):
            axes.plot([value, value], [low[1], high[1]], color=GREY, lw=0.8)
        elif side in ("bottom", "top"):
            axes.plot([low[0], high[0]], [value, value], color=GREY, lw=0.8)
    for n in which:
        one = fit.frames.segments[n]
        colour = COLOURS[names.index(one.name) % len(COLOURS)]
        count = int(fit.frames.count[n])
        t = np.linspace(0.0, one.time[count - 1], 300)
        run = fit.simulate(n)
        x = np.asarray(run.at(np.minimum(t, run.end)).position)[:, 0, :2]
        axes.plot(*x.T, "-", color=colour, lw=0.9, zorder=2)
        step = max(1, count // 60)
        axes.plot(*one.position[:count:step].T, "o", color=colour, ms=2.2, mec="none", alpha=0.75, zorder=3)
        axes.plot(*one.position[0], "o", color=colour, ms=5, mfc="none", mew=0.8, zorder=3)
    margin = 0.03 * float((high - low).max())
    axes.set(aspect="equal", xlim=(low[0] - margin, high[0] + margin), ylim=(low[1] - margin, high[1] + margin))
    axes.set(xticks=[], yticks=[])
    axes.spines[:].set_visible(False)
    axes.set_title(f"{literal(shot or 'track')}: {1e3 * fit.rms(which):.2g} mm", fontsize=8)


def _track_distances(axes: Any, fit: TrackFit) -> None:
    """Plot the distances of tracks since the first contact."""
    gaps = [1e3 * np.hypot(*fit.gap[n, : int(c)].T) for n, c in enumerate(fit.frames.count)]
    times = [one.time[: len(gap)] - one.contacts[0] for one, gap in zip(fit.frames.segments, gaps, strict=True)]
    _over_time(axes, times, gaps)
    axes.axvline(0, color=GREY, lw=0.8, ls=":")
    axes.set(xlabel="time since the first contact, s", ylabel=f"{fit.law.name}: distance, mm")


def _over_time(axes: Any, times: Sequence[Any], gaps: Sequence[Any]) -> None:
    """Plot distances, mm, over time: a line for each track or shot, of more than a few the shares; and the median."""
    if len(gaps) <= len(COLOURS):
        for time, gap in zip(times, gaps, strict=True):
            axes.plot(time, gap, color=INK, lw=0.5, alpha=0.5)
    since, every = np.concatenate(times), np.concatenate(gaps)
    edges = np.linspace(since.min(), since.max(), 25)
    bins = [((a + b) / 2, every[(since >= a) & (since < b)]) for a, b in pairwise(edges)]
    bins = [(middle, some) for middle, some in bins if len(some) >= 10]
    if bins:
        middles = [middle for middle, _some in bins]
        shares = np.array([np.percentile(some, (10, 25, 50, 75, 90)) for _middle, some in bins]).T
        if len(gaps) > len(COLOURS):
            axes.fill_between(middles, shares[0], shares[4], color=INK, alpha=0.12, lw=0, label="80 % of frames")
            axes.fill_between(middles, shares[1], shares[3], color=INK, alpha=0.25, lw=0, label="50 %")
        axes.plot(middles, shares[2], color="#D55E00", lw=1.8, label="median")
        axes.legend(frameon=False, loc="lower left", bbox_to_anchor=(0, 1), borderaxespad=0.2, ncols=3)
    _in_mm(axes)


def _laws_of_tracks(ranking: TrackRanking) -> str:
    def cells(one: Ranked[TrackFit]) -> tuple[str, ...]:
        fit = one.fit
        numbers = "<br>".join(f"{name} {html.escape(with_error_bar(e))}" for name, e in fit.estimates.items())
        goodness = f"{fit.chi2:.5g} / {fit.dof:.0f}" if fit.known else "–"
        return goodness, f"{1e3 * fit.median_rms:.3g}", f"{1e3 * fit.rms():.3g}", numbers

    return table_of_laws(ranking, ("chi² / dof", "median RMS, mm", "RMS, mm"), cells)


def _track_drawings(fit: TrackFit) -> list[str]:
    """Return the drawings of tracks for a page: the farthest shots from above, and the distances over time."""
    rows = fit.frames.groups
    far = sorted(rows, key=lambda which: -fit.rms(which))[:FARTHEST]
    small = [
        panel(
            lambda axes, shot=fit.frames.segments[which[0]].group: _from_above(axes, fit, shot),  # type: ignore[misc]
            1.7, 1.5, left=0.02, right=0.98, top=0.88, bottom=0.02,
        )
        for which in far
    ]  # fmt: skip
    over = panel(lambda axes: _track_distances(axes, fit), 4.5, 2.8, **MARGINS | LEGEND)
    said = f"Tracked (dots) and {fit.law.name} (lines)" + f", the farthest of {len(rows)} shots" * (
        len(rows) > len(far)
    )
    return [f"<p>{html.escape(said)}:</p>", beside(small, "beside small"), beside([over])]


def write_track_report(ranking: TrackRanking, source: str, path: str | Path) -> Path:
    """Write the HTML report atomically: verdict, figure, table, unconstrained parameters."""
    best, tracks = ranking.best, ranking.best.frames.segments
    contacts = sum(len(one.contacts) for one in tracks)
    ball = f"{1e3 * best.model.setting.radius:.4g} mm, moment of inertia {best.model.setting.kappa:.4g} m a²"
    parts = [
        f"<p>{len(tracks)} track segments, {contacts} contacts, {int(best.frames.count.sum()):,} frames; each segment is simulated"
        f" from its own start. Ball of radius {ball}.</p>",
*_track_drawings(best), "<h2>The laws, best first</h2>", _laws_of_tracks(ranking),
        *residual_parts(residuals_of_tracks(ranking)),
    ]  # fmt: skip
    footer = f"{ranking.aicc_note} wall_left, ...: position at which the ball's centre is reflected, m."
    return write_page(ranking, path, source, "Which law follows {}?", parts, footer)


# ----------------------------------------------------------------------------------------------------
# Figures of fits to whole shots: film and model on each other, distances over time, all shots on one page; the HTML report.

COLUMNS = 3  # of small multiples
ORDER = [
    "struck",
    "second",
    "third",
    "fourth",
    "fifth",
    "sixth",
]  # balls of a shot: by the cue, and in the order of the film
LEAST_MM = 0.1  # of a distance that is drawn
DOTS = 120  # of a ball's path


def plot_shot(shot: FittedShot) -> Figure:
    """Plot one shot: film (dots) and model (lines) from above, contacts of both, and distances over time. Returns a Figure."""
    with style():
        figure = new_figure(9.0, 4.0)
        left, right = figure.subplots(1, 2, width_ratios=[1.5, 1])
        _shot_above(left, shot, marks=True)
        _shot_over_time(right, shot)
        balls = _balls_in_words(shot)
        figure.legend(
            handles=balls, loc="lower left", ncols=len(balls), fontsize=8, frameon=False, bbox_to_anchor=(0.01, 0.06)
        )
        figure.legend(
            handles=_marks(), loc="lower left", ncols=5, fontsize=8, frameon=False, bbox_to_anchor=(0.01, 0.0)
        )
        figure.suptitle(f"{literal(shot.name)}: {1e3 * shot.rms:.3g} mm (rms) from film to model", fontsize=9)
        figure.subplots_adjust(left=0.02, right=0.97, top=0.9, bottom=0.22, wspace=0.16)
    return figure


def plot_shots(fit: ShotsFit, *others: ShotsFit) -> Figure:
    """Plot all shots as small multiples, film (dots) and model (lines), and their distances against incidence, speed, order, also
    under another law. Returns a Matplotlib Figure."""
    columns = min(COLUMNS, len(fit.shots))
    rows = -(-len(fit.shots) // columns)
    found = residuals_of_shots([fit, *others[:1]])
    height, below = 1.1 * rows + 1.0, _residual_height(found) if len(fit.shots) > 1 else 0.0
    with style():
        whole = new_figure(WIDTH, height + below)
        figure, *rest = whole.subfigures(
            1 + (below > 0), 1, squeeze=False, height_ratios=[height, *[below] * (below > 0)]
        ).flat
        for one in rest:
            _residual_grid(one, found, below)
        panels = figure.subplots(rows, columns, squeeze=False)
        for axes in panels.flat[len(fit.shots) :]:
            axes.set_axis_off()
        for axes, shot in zip(panels.flat, fit.shots, strict=False):
            _small(axes, shot)
        balls = _legend(f"{word} ball" for word, _ in zip(ORDER, range(most_balls(fit)), strict=False))
        figure.legend(
            handles=balls, loc="lower center", ncols=6, fontsize=7.5, frameon=False, bbox_to_anchor=(0.5, 0.18 / height)
        )
        figure.legend(
            handles=_marks(),
            loc="lower center",
            ncols=5,
            fontsize=7.5,
            columnspacing=1.0,
            frameon=False,
            bbox_to_anchor=(0.5, 0.0),
        )
        figure.subplots_adjust(
            left=0.01, right=0.99, top=1 - 0.42 / height, bottom=0.45 / height, wspace=0.05, hspace=0.2
        )
        figure.suptitle(f"Film and {literal(fit.law.name)}, distance (rms) to rest", fontsize=9, y=1 - 0.05 / height)
    return whole


def most_balls(fit: ShotsFit) -> int:
    """Return the largest number of balls of a shot."""
    return max(len(shot.film.balls) for shot in fit.shots)


def _small(axes: Any, shot: FittedShot) -> None:
    """Plot one shot small, with its distance."""
    _shot_above(axes, shot, marks=True, size=0.5)
    lost = "" if shot.followed else ", not followed"
    axes.set_title(
        f"{literal(shot.name)}: {1e3 * shot.rms:.3g} mm{lost}", fontsize=7, color="#D55E00" if lost else INK, pad=2
    )


def _legend(names: Iterable[str]) -> list[Any]:
    """Return a line for each ball."""
    from matplotlib.lines import Line2D

    return [Line2D([], [], color=COLOURS[k % len(COLOURS)], label=literal(name)) for k, name in enumerate(names)]


def _balls_in_words(shot: FittedShot) -> list[Any]:
    return _legend(
        f"{called_ball(name)}{', struck by the cue' if k == 0 else ''}" for k, name in enumerate(shot.film.balls)
    )


def _marks() -> list[Any]:
    """Return what dots, lines, circles and crosses are."""
    from matplotlib.lines import Line2D

    look: dict[str, Any] = {"color": INK, "ls": "none", "mfc": "none"}
    return [
        Line2D([], [], color=INK, ls="none", marker="o", ms=2, label="film"),
        Line2D([], [], color=INK, lw=0.8, label="model"),
        Line2D([], [], **look, marker="s", ms=4, mew=0.8, label="start"),
        Line2D([], [], **look, marker="o", ms=6, mew=0.6, label="contact in the model"),
        Line2D([], [], **look, marker="x", ms=5, mew=0.7, label="contact in the film"),
    ]


def _distances(axes: Any, fit: ShotsFit) -> None:
    """Plot the distances of all shots over time."""
    seen = [shot.film.measured.any(axis=1) for shot in fit.shots]
    far = [
        np.sqrt(np.nanmean(np.square(shot.distance[rows]), axis=1)) for shot, rows in zip(fit.shots, seen, strict=True)
    ]
    times = [shot.film.time[rows] for shot, rows in zip(fit.shots, seen, strict=True)]
    _over_time(axes, times, [np.maximum(1e3 * one, LEAST_MM) for one in far])
    axes.axhline(1e3 * fit.noise * np.sqrt(2), color=GREY, lw=0.8, ls=":")
    axes.set(xlabel="time, s (dotted: noise of the film)", ylabel="distance of all shots, mm")


def _all_shots(fit: ShotsFit) -> list[str]:
    """Return the drawings of all shots: small multiples, if there are several, and their distances."""
    small = [
        panel(lambda axes, one=one: _small(axes, one), 1.7, 1.05, left=0.02, right=0.98, top=0.86, bottom=0.02)  # type: ignore[misc]
        for one in fit.shots
    ]
    over = panel(lambda axes: _distances(axes, fit), 3.9, 2.6, **MARGINS | LEGEND)
    return [beside(small, "beside small") if len(small) > 1 else "", beside([over])]


def _shot_above(axes: Any, shot: FittedShot, *, marks: bool = False, size: float = 1.0) -> None:
    """Plot one shot from above: noses of the cushions, rows of the film, paths and contacts of the model; ``size`` of the marks."""
    from carom.fitting.shots.result import table_of

    table = table_of(shot.scene)
    half, (cx, cy) = np.array([table.length, table.width]) / 2, table.center
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1], [-1, -1]]) * half + [cx, cy]
    axes.plot(*corners.T, color=GREY, lw=0.8)
    run, end = shot.simulate(), float(shot.film.time[-1])
    t = np.linspace(0.0, max(min(end - shot.time, run.end), 1e-3), 600)
    x = np.asarray(run.at(t).position)
    for k in range(len(shot.film.balls)):
        colour = COLOURS[k % len(COLOURS)]
        axes.plot(*x[:, k, :2].T, color=colour, lw=0.7, zorder=2)
        rows = np.flatnonzero(shot.film.measured[:, k])
        rows = rows[:: max(1, len(rows) // DOTS)]
        axes.plot(*shot.film.position[rows, k].T, "o", ms=1.6, color=colour, mec="none", alpha=0.7, zorder=3)
        axes.plot(*shot.film.first[k], "s", ms=4 * size, mfc="none", mec=colour, mew=0.8, zorder=4)
        met = [event for event in run.events.of("wall", "ball", ball=k) if event.t + shot.time < end] if marks else []
        for event in met:
            place = np.asarray(event.after.position)[:2]
            axes.plot(*place, "o", ms=7 * size, mfc="none", mec=colour, mew=0.6 * size, zorder=4)
    for one in shot.film.events if marks else ():
        rows = np.flatnonzero(shot.film.known[:, one.ball])
        if len(rows):
            near = rows[np.argmin(np.abs(shot.film.time[rows] - (one.low + one.high) / 2))]
            axes.plot(*shot.film.position[near, one.ball], "x", ms=5 * size, color=INK, mew=0.7 * size, zorder=5)
    margin = 0.02 * table.length
    axes.set(aspect="equal", xticks=[], yticks=[])
    axes.set(xlim=(cx - half[0] - margin, cx + half[0] + margin), ylim=(cy - half[1] - margin, cy + half[1] + margin))
    axes.spines[:].set_visible(False)


def _shot_over_time(axes: Any, shot: FittedShot) -> None:
    """Plot the distances of the balls over time; lines at the events of the film."""
    for k in range(len(shot.film.balls)):
        rows = shot.film.measured[:, k]
        if rows.sum() > 2:
            axes.plot(
                shot.film.time[rows],
                np.maximum(1e3 * shot.distance[rows, k], LEAST_MM),
                lw=0.8,
                color=COLOURS[k % len(COLOURS)],
            )
    for one in shot.film.events:
        axes.axvline((one.low + one.high) / 2, color=GREY, lw=0.5, ls="-" if one.kind == "ball" else ":")
    _in_mm(axes)
    axes.set(xlabel="time, s (contacts in the film: ball solid, cushion dotted)", ylabel="distance, mm")


def _in_mm(axes: Any) -> None:
    """Let the vertical axis be logarithmic, with plain numbers at its ticks."""
    from matplotlib.ticker import LogFormatter

    class Plain(LogFormatter):
        def __call__(self, x: float, pos: Any = None) -> str:
            return f"{x:g}" if super().__call__(x, pos) else ""

    axes.set(yscale="log")
    axes.yaxis.set_major_formatter(Plain(labelOnlyBase=False))
    axes.yaxis.set_minor_formatter(Plain(labelOnlyBase=False, minor_thresholds=(1, 0.4)))


def _laws_of_shots(ranking: ShotsRanking) -> str:
    from carom.fitting.shots.result import HORIZONS

    def cells(one: Ranked[ShotsFit]) -> tuple[str, ...]:
        medians = (1e3 * one.fit.median(name) for name in HORIZONS)
        return tuple("–" if math.isnan(mm) else f"{mm:.1f}" for mm in medians)

    return table_of_laws(ranking, tuple(f"{name}, mm" for name in HORIZONS), cells, parameters=False)


def _numbers(ranking: ShotsRanking) -> str:
    """Return the table of the fitted numbers, a column for each of the best laws."""
    fits = [one.fit for one in ranking.ranked[:SHOWN]]
    rows = [
        [name, *(with_error_bar(fit.estimates[name]) if name in fit.estimates else "–" for fit in fits)]
        for name in dict.fromkeys(name for fit in fits for name in fit.estimates)
    ]
    head = "".join(f"<th>{html.escape(text)}</th>" for text in ("number", *(fit.law.name for fit in fits)))
    body = "".join(f"<tr>{''.join(f'<td>{html.escape(text)}</td>' for text in row)}</tr>" for row in rows)
    return f'<div class="wide"><table><tr>{head}</tr>{body}</table></div>'


def _shot(shot: FittedShot) -> str:
    """Return the two drawings of a shot below its name."""

    def above(axes: Any) -> None:
        _shot_above(axes, shot, marks=True)
        axes.legend(
            handles=_balls_in_words(shot),
            loc="upper center",
            bbox_to_anchor=(0.5, 0.0),
            ncols=3,
            fontsize=8,
            frameon=False,
        )

    said = f"{html.escape(shot.name)}: {1e3 * shot.rms:.3g} mm{'' if shot.followed else ', not followed'}"
    whole = panel(above, 4.6, 2.6, left=0.01, right=0.99, top=0.99, bottom=0.12)
    return f"<h3>{said}</h3>" + beside([whole, panel(lambda axes: _shot_over_time(axes, shot), 4.4, 2.6, **MARGINS)])


def _legend_of_marks() -> str:
    def draw(axes: Any) -> None:
        axes.set_axis_off()
        axes.legend(handles=_marks(), loc="center", ncols=3, fontsize=8, frameon=False)

    return panel(draw, 4.6, 0.5, left=0.0, right=1.0, top=1.0, bottom=0.0)


def write_shots_report(ranking: ShotsRanking, source: str, path: str | Path) -> Path:
    """Write the HTML report atomically: verdict, sentences, all shots, each shot, the laws."""
    best = ranking.best
    parts = [
        *(f"<p>{html.escape(line)}</p>" for line in best.describe()), *_all_shots(best),
        *residual_parts(residuals_of_shots([one.fit for one in ranking.ranked[:2]])),
        "<h2>The laws, best first</h2>", _laws_of_shots(ranking), "<h2>The table</h2>", _numbers(ranking),
        "<h2>The shots, the farthest from the film first</h2>",
        _legend_of_marks(), *map(_shot, sorted(best.shots, key=lambda one: -one.rms)),
    ]  # fmt: skip
    return write_page(ranking, path, source, "Whole shots: {}", parts)
