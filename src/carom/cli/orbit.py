"""``carom orbit``: follow single-particle billiards; bounces, phase portraits, Lyapunov exponents."""

from __future__ import annotations

import math
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING, Annotated, Any

import typer

from carom.cli.console import working
from carom.cli.options import OUTPUT, option, require_outputs, shared, wrote
from carom.cli.parameters import Given, of_library
from carom.cli.streams import note, say_json, say_notes
from carom.errors import CaromError, Fault
from carom.files import atomic_path
from carom.formatting import Listing, counted, json_value

if TYPE_CHECKING:
    from carom.billiards import Lyapunov, Orbit, OrbitResult, PeriodicOrbits

LONGEST_SHOWN = 12  # walls of a periodic orbit, as letters
LETTERS = {"position": "", "velocity": "v", "spin": "w"}
# Why an orbit ended, in words.
REASONS = {
    "bounces": "after all bounces",
    "escaped": "escaped",
    "corner": "at a corner",
    "grazed": "without leaving the wall",
    "free": "without another bounce",
}


def orbit_facts(found: OrbitResult) -> dict[str, Any]:
    """Return the results of the orbits as plain numbers; None for quantities that are undefined."""
    import numpy as np

    from carom import billiards
    from carom.billiards.intersections import PARABOLA

    table = found.setup.table
    ball = found.setup.ball
    made, ends = np.atleast_1d(found.count), np.atleast_1d(found.ended)
    facts: dict[str, Any] = {
        "table": {"name": table.name, "bounds": table.bounds, **table.sizes},
        "ball": {"radius": float(ball.radius), "kappa": float(ball.kappa)},
        "law": found.setup.law,
        "orbits": len(made),
        "count": int(made.sum()),
        "ended": {str(name): int((ends == name).sum()) for name in np.unique(ends)},
        "energy_drift": None,
    }
    whole = made == found.t.shape[-1]
    if made.max(initial=0) > 0:
        facts["mean_time_between_bounces"] = float(np.nansum(found.last[..., 0]) / made.sum())
        facts["energy_drift"] = json_value(max(np.ravel(found.energy_drift), key=lambda x: np.nan_to_num(abs(x))))
    if whole.all() and found.t.shape[-1] > 1:
        periods = np.atleast_1d(billiards.period(found))
        names, counts = np.unique(periods, return_counts=True)
        facts["periods"] = {str(p): int(c) for p, c in zip(names.tolist(), counts.tolist(), strict=True) if p}
        falls = bool(found.setup.world["flight"][0] == PARABOLA)
        round_ = "circle" in (table.name, getattr(getattr(table.figure, "over", None), "shape", ""))
        if round_ and not falls:
            caustics = billiards.caustics(found)
            facts["caustics"] = np.atleast_2d(caustics.radii)[0].tolist() if len(made) == 1 else None
        along = any(table.acceleration) or table.name in ("strip", "plates", "cylinder")
        if along and not falls and found.t.shape[-1] >= 4 and len(made) == 1:
            axis = 2 if table.name in ("plates", "cylinder") else 0
            drift = billiards.drift(found, axis)
            names_ = ("extent", "velocity", "velocity_error", "acceleration", "acceleration_error", "growth")
            facts["drift"] = {"axis": "xyz"[axis]} | {n: json_value(np.ravel(getattr(drift, n))[0]) for n in names_}
    if found.reversal_error is not None:
        facts["reversal_error"] = float(np.max(found.reversal_error))
    if found.spectrum is not None:
        facts["lyapunov"] = _exponents(found.spectrum)
    if found.periodic is not None:
        facts["periodic"] = [one.to_dict() for one in found.periodic]
    return facts


def _exponents(spectrum: Lyapunov) -> dict[str, Any]:
    """Return the exponents of an orbit with their errors; of several their means, standard errors of these, and each one's.

    An orbit that ended early has no exponents. Orbits of a mixed phase space have different ones, so the error of a mean over
    orbits is the error of their scatter.
    """
    import numpy as np

    every = spectrum.per_bounce.reshape(-1, spectrum.per_bounce.shape[-1])
    lasted = np.isfinite(every).all(axis=-1)
    means = [every, spectrum.per_time.reshape(every.shape), spectrum.error.reshape(every.shape)]
    per_bounce, per_time, error = (
        np.mean(x[lasted], axis=0) if lasted.any() else np.full(x.shape[-1], np.nan) for x in means
    )
    if lasted.sum() > 1:
        error = np.std(every[lasted], axis=0, ddof=1) / math.sqrt(lasted.sum())
    named = {"per_bounce": per_bounce, "per_time": per_time, "error": error}
    found: dict[str, Any] = {name: json_value(values) for name, values in named.items()}
    if len(every) > 1:
        found["per_bounce_of_each"] = json_value(every)
    return found


def _columns(found: Orbit) -> dict[str, Any]:
    """Return what is known of every bounce: arrays (orbits, bounces, ...)."""
    columns: dict[str, Any] = {
        "t": found.t, "piece": found.piece, "s": found.arc if found.setup.shape.sphere is None else None,
        "position": found.position, "velocity": found.velocity, "spin": found.spin, "along": found.along, "across": found.across,
    }  # fmt: skip
    shape, axes = (found.count.size, found.t.shape[-1]), found.t.ndim
    return {name: one.reshape(*shape, *one.shape[axes:]) for name, one in columns.items() if one is not None}


def every_bounce(found: Orbit) -> list[Any]:
    """Return every bounce: of one orbit a list, of many a list of lists."""
    columns, rows = _columns(found), []
    for m, count in enumerate(found.count.ravel()):
        lists = [column[m, :count].tolist() for column in columns.values()]
        rows.append([dict(zip(columns, values, strict=True)) for values in zip(*lists, strict=True)])
    return rows[0] if len(rows) == 1 else rows


def write_bounces(found: Orbit, path: Path) -> None:
    """Write every bounce as a row, numbered from 1 within its orbit, of a CSV or Parquet file."""
    from carom.simulation.files import write_columns

    orbit, bounce = (found.count.reshape(-1, 1) > range(found.t.shape[-1])).nonzero()
    rows = {"orbit": orbit + 1, "bounce": bounce + 1}
    for name, column in _columns(found).items():
        axes = [name] if column.ndim == 2 else [f"{LETTERS[name]}{axis}" for axis in "xyz"[: column.shape[2]]]
        rows |= dict(zip(axes, column[orbit, bounce].reshape(len(orbit), len(axes)).T, strict=True))
    with atomic_path(path) as part:
        write_columns(rows, part)


def print_orbit(facts: dict[str, Any], found: OrbitResult) -> None:
    """Print the results as tables."""
    from carom.billiards.orbits import CONSERVED
    from carom.billiards.setup import needs_surface
    from carom.cli.console import out

    console = out()
    rows: list[tuple[str, str]] = []
    sizes = ", ".join(
        f"{k} {v:.6g}" if isinstance(v, float) else f"{k} {v}"
        for k, v in facts["table"].items()
        if k not in ("name", "bounds")
    )
    rows.append(("table", f"{facts['table']['name']}: {sizes}; boundary of the ball's {facts['table']['bounds']}"))
    law, wall = facts["law"], found.setup.world[0]
    if needs_surface(law):
        law += f" with restitution {wall['e']:g}, friction {wall['mu']:g}, tangential restitution {wall['beta']:g}"
    rows.append(("ball", f"kappa {facts['ball']['kappa']:.6g}, radius {facts['ball']['radius']:.6g} m; law {law}"))
    ends = ", ".join(f"{count} {REASONS[one]}" for one, count in facts["ended"].items())
    ends = ends if facts["orbits"] > 1 else ends.removeprefix("1 ")
    rows.append(("bounces", f"{facts['count']:,} in {counted(facts['orbits'], 'orbit')}; ended: {ends}"))
    if facts.get("mean_time_between_bounces") is not None:
        rows.append(("mean time", f"{facts['mean_time_between_bounces']:.6g} s between bounces"))
    if facts["energy_drift"] is not None:
        change = facts["energy_drift"]
        said = f"changes by {100 * change:+.4g} %" if abs(change) > CONSERVED else f"conserved to {abs(change):.1e}"
        rows.append(("energy", said))
    if facts.get("periods"):
        shown = ", ".join(p if facts["orbits"] == 1 else f"{p} ({c})" for p, c in facts["periods"].items())
        rows.append(("period", shown))
    elif "periods" in facts:
        rows.append(("period", f"none up to {counted(found.t.shape[-1] // 2, 'bounce')}"))
    if facts.get("caustics"):
        rows.append(("caustics", " and ".join(f"{r:.9g}" for r in facts["caustics"]) + " m"))
    if facts.get("drift"):
        d = facts["drift"]
        kind = "bounded" if d["growth"] is not None and d["growth"] < 1.3 else "not bounded so far"
        rows.append((f"along {d['axis']}", f"{kind}: extent {d['extent']:.6g} m{_drift_rates(d)}"))
    if facts.get("reversal_error") is not None:
        rows.append(("backwards", f"returns to within {facts['reversal_error']:.1e} m"))
    console.facts(rows)
    if facts.get("lyapunov"):
        both = facts["lyapunov"]
        lines = [
            (str(number + 1), *("–" if x is None else f"{x:.5f}" for x in row))
            for number, row in enumerate(zip(both["per_bounce"], both["error"], both["per_time"], strict=True))
        ]
        console.table(Listing(("Lyapunov exponents", "per bounce", "±", "per second"), lines))
        console.print(_meaning(both), style="dim", soft_wrap=True)
    if found.periodic is not None:
        console.table(_periodic_orbits(found.periodic))
    elif facts["orbits"] == 1 and facts["count"]:
        _first_bounces(console, found)


def _drift_rates(d: dict[str, Any]) -> str:
    """Return mean velocity and acceleration with their errors; nothing for an orbit that is too short to have errors."""
    if d["velocity_error"] is None:
        return ""
    return (
        f", mean velocity {d['velocity']:.3g} ± {d['velocity_error']:.1g} m/s,"
        f" acceleration {d['acceleration']:.3g} ± {d['acceleration_error']:.1g} m/s²"
    )


def _periodic_orbits(found: PeriodicOrbits) -> Listing:
    """Return periodic orbits as a table: a row each."""
    rows = []
    for one in found:
        far, turns = one.multipliers[0], one.rotation_number
        walls = one.itinerary if one.period <= LONGEST_SHOWN else "–"
        rows.append((
            str(one.period), f"{one.duration:.9g}", one.stability, "–" if far.imag else f"{far.real:.6g}",
            "–" if turns is None else f"{turns:.6f}", walls, "–" if one.winding is None else str(one.winding),
            str(one.family) if one.family else "–", str(one.found),
        ))  # fmt: skip
    heads = [
        "bounces",
        "duration (s)",
        "stability",
        "multiplier",
        "rotation number",
        "walls",
        "turns",
        "family",
        "found",
    ]
    return Listing(heads, rows, found.completeness)


def _meaning(exponents: dict[str, Any]) -> str:
    """Return a sentence on the exponents and their errors."""
    largest = sorted(row[0] for row in exponents.get("per_bounce_of_each", ()) if row[0] is not None)
    if len(largest) < 2:
        return "±: error of exponents per bounce: scatter between 20 parts of the orbit, or change since half of it if it is more."
    low, middle, high = largest[0], median(largest), largest[-1]
    return (
        f"Means over {len(largest):,} orbits; ±: their standard error, from the scatter between orbits."
        f" Largest exponent of each, per bounce: {low:.5f} to {high:.5f}, median {middle:.5f}."
    )


def _first_bounces(console: Any, found: Orbit) -> None:
    """Print the first five bounces and the last as a table that fits 80 columns."""
    import numpy as np

    n = found.t.shape[-1]
    x = found.position.reshape(n, -1)
    columns = {"t": found.t}
    columns |= {"s": found.arc, "x": x[:, 0], "y": x[:, 1]} if found.setup.planar else {"z": x[:, 2]}
    columns |= {"v along": found.along, "v across": found.across}
    spins = found.spin.reshape(n, -1)
    rows = []
    count = int(np.ravel(found.count)[0])
    for k in [*range(min(count, 5)), *([count - 1] if count > 5 else [])]:
        if k > 5:
            rows.append(("-", *[""] * (len(columns) + 1)))
        numbers = [float(column.reshape(n)[k]) for column in columns.values()]
        turn = " ".join(f"{w:.3g}" if len(spins[k]) > 1 else f"{w:.4g}" for w in spins[k])
        cells = (f"{number + 0.0:.4g}" if math.isfinite(number) else "–" for number in numbers)
        rows.append((str(k + 1), *cells, turn))
    console.print("bounces (m, s, rad)", style="dim")
    console.table(Listing(("", *columns, "spin"), rows), grid=True)


# ----------------------------------------------------------------------------------------------------
# ``carom orbit``: follow single-particle billiards; bounces, phase portraits, Lyapunov exponents.


TABLE, LAW, START = "Table", "Law", "Initial state"


@of_library(
    "billiards.orbit_by_name:orbit",
    panels={
        TABLE: "bounds acceleration magnetic_field", LAW: "law restitution friction tangential_restitution at_corner",
        START: "position velocity spin orbits seed", OUTPUT: "lyapunov reverse periodic itinerary starts",
    },
)  # fmt: skip
def orbit(
    table: Annotated[
        str | None,
        typer.Argument(
            help="A figure, with sizes or without: circle, stadium:straight=2,radius=1, polygon:points=[[0,0],[2,0],[0,1]];"
            " or cylinder:NAME, a cylinder along z over a figure in the plane. An unknown name is answered with all names."
        ),
    ] = None,
    *,
    table_file: Annotated[
        Path | None,
        option(
            TABLE,
            "The table from a file: TOML with a shape and sizes, or JSON, such as a list of points.",
            "--table",
            metavar="FILE",
        ),
    ] = None,
    given: Given,
    plot: Annotated[Path | None, shared("plot", help="Draw the first orbit in the table: .svg, .pdf or .png.")] = None,
    portrait: Annotated[Path | None, shared("plot", help="Draw the velocity phase portrait.")] = None,
    boundary: Annotated[Path | None, shared("plot", help="Draw the boundary map.")] = None,
    lyapunov_plot: Annotated[
        Path | None, shared("plot", help="Draw how the Lyapunov exponents converge; computes them.")
    ] = None,
    out: Annotated[
        Path | None, option(OUTPUT, "Write every bounce as a row: .csv or .parquet.", metavar="FILE")
    ] = None,
    json_: Annotated[bool, shared("json", help="Print JSON on standard output, with every bounce.")] = False,
) -> None:
    """Single-particle billiards: follow one ball in a table from bounce to bounce, with the no-slip law or another.

    Sizes that the table leaves out are about 1 m. Without --position and --velocity, the initial state is sampled from the
    invariant measure.
    """
    from carom.billiards.orbit_by_name import check_orbit
    from carom.billiards.orbit_by_name import orbit as follow

    faults = given.faults
    plots = {"--plot": plot, "--portrait": portrait, "--boundary": boundary, "--lyapunov-plot": lyapunov_plot}
    require_outputs(faults, plots | {"--out": out}, {"--out": (".csv", ".parquet")})
    what: Any = None if table and table_file else table or table_file
    if what is None:
        advice = "TABLE: expected a table such as circle, or --table FILE, got "
        faults.append(Fault(advice=advice + ("both" if table else "neither")))
    if faults:
        faults.attempt(lambda: check_orbit(table=what, **given))
        raise CaromError(*faults)
    if lyapunov_plot is not None:
        given["lyapunov"] = True
    with working("orbits") as report:
        found = follow(what, progress=report, **given)
        facts = orbit_facts(found)
    say_notes(found.notes)
    if json_:
        facts["bounces"] = every_bounce(found)
        say_json(facts)
    else:
        print_orbit(facts, found)
        if found.periodic is not None and not len(found.periodic) and "itinerary" not in given:
            note(
                "note: random starts seldom lead to unstable orbits between obstacles or through openings;"
                " --itinerary AB,ABC seeks those that meet given walls"
            )
    for name, path in plots.items():
        if path is not None:
            getattr(found, name[2:].removesuffix("-plot"))(path)
            wrote(path)
    if out is not None:
        write_bounces(found, out)
        wrote(out)
