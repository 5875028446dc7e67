"""carom orbit: tables, JSON that is the library's answer, pictures that are whole or not there, faults of one line."""

from __future__ import annotations

import io
import json
import math
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from reference import commands
from typer.testing import CliRunner

import carom
from carom import billiards
from carom.cli import app, main
from carom.plot import plot_boundary, plot_lyapunov, plot_orbit, plot_portrait, save
from carom.plot.billiards import on_curves

runner = CliRunner()
START = ["--position", "0.2,0.1", "--velocity", "0.8,0.3", "--spin", "0.5"]


def run(*words: str) -> Any:
    done = runner.invoke(app, ["orbit", *words])
    assert done.exit_code == 0, (done.output, done.exception)
    return done


def fails(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], *words: str) -> list[str]:
    monkeypatch.setattr(sys, "argv", ["carom", "orbit", *words])
    with pytest.raises(SystemExit) as end:
        main()
    assert end.value.code == 2
    said = capsys.readouterr()
    assert said.out == ""
    return said.err.splitlines()


def test_json_is_the_librarys_answer_in_full() -> None:
    done = json.loads(
        run("circle:radius=1.5", "--kappa", "0.3", "--bounces", "50", *START, "--reverse", "--json").stdout
    )
    ball = carom.Disc(1.0, 1.0, 0.3)
    found = billiards.orbit(billiards.circle(1.5), ((0.2, 0.1), (0.8, 0.3), 0.5), 50, ball=ball)
    assert [b["t"] for b in done["bounces"]] == found.t.tolist()
    assert [b["position"] for b in done["bounces"]] == found.position.tolist()
    assert [b["s"] for b in done["bounces"]] == found.arc.tolist()
    assert [b["spin"] for b in done["bounces"]] == found.spin.tolist()
    assert done["caustics"] == billiards.caustics(found).radii.tolist()
    assert done["ended"] == {"bounces": 1}
    assert done["reversal_error"] == billiards.reverse(found)[1].max() < 1e-12
    assert done["table"] == {"name": "circle", "bounds": "centre", "radius": 1.5}


TABLES = [
    ["circle"], ["ellipse:half_axes=1,0.7"], ["stadium:straight=1"], ["regular:sides=5"],
    ["polygon:points=0,0 2,0 2,1 1,1 1,2 0,2"], ["rectangle:size=2,1"], ["sinai:radius=0.2"],
    ["periodic-strip"], ["sphere"], ["box:size=1,1,2"], ["cylinder:stadium:height=2"],
    ["cylinder:circle", "--acceleration", "-9.81"], ["cylinder:regular:sides=3"], ["cell:obstacles=[[0.1,0,0.2]]"],
    ["cylinder:regular:height=2"], ["cylinder:rectangle:height=2", "--acceleration", "1"],
]  # fmt: skip


@pytest.mark.parametrize("words", TABLES, ids=" ".join)
@pytest.mark.parametrize("bounds", ["centre", "surface"])
def test_every_table(words: list[str], bounds: str) -> None:
    """Drawn starts, both bounds: tables for people, nothing cut at 80 columns; the same as JSON, every bounce there."""
    done = run(*words, "--bounds", bounds, "--bounces", "30", "--seed", "3")
    assert "30 in 1 orbit" in done.stdout
    assert "…" not in "".join(line for line in done.stdout.splitlines() if line.strip() != "…")
    assert max(map(len, done.stdout.splitlines())) <= 80
    found = json.loads(run(*words, "--bounds", bounds, "--bounces", "30", "--seed", "3", "--json").stdout)
    assert len(found["bounces"]) == found["count"] == 30


def test_a_table_from_a_file(tmp_path: Path) -> None:
    file = tmp_path / "room.json"
    file.write_text("[[0, 0], [2, 0], [0, 1]]")
    found = json.loads(run("--table", str(file), "--bounces", "5", "--json").stdout)
    assert found["table"] == {"name": "polygon", "bounds": "centre", "points": [[0, 0], [2, 0], [0, 1]]}


def test_an_orbit_without_a_period_says_how_far_it_was_sought() -> None:
    words = " ".join(run("sinai", "--bounces", "60").stdout.split())
    assert "period none up to 30 bounces" in words


def test_one_bounce_has_neither_period_nor_caustics() -> None:
    words = " ".join(run("circle", *START, "--bounces", "1").stdout.split())
    assert "1 in 1 orbit" in words
    assert "period" not in words
    assert "caustics" not in words
    three = " ".join(run("strip", *START, "--bounces", "3").stdout.split())
    assert "period none up to 1 bounce bounces (" in three


def test_open_tables_and_their_drift() -> None:
    words = ["strip", "--acceleration", "0.5", *START[:2], "--velocity", "0.3,0.9", "--bounces", "500"]
    assert "bounded" in run(*words).stdout
    assert json.loads(run(*words, "--json").stdout)["drift"]["growth"] < 1.1
    falls = [
        "plates",
        "--acceleration",
        "-1",
        "--law",
        "mirror",
        "--position",
        "0,0,0",
        "--velocity",
        "0,1,0",
        "--bounces",
        "500",
    ]
    assert "not bounded so far" in run(*falls).stdout
    assert json.loads(run(*falls, "--json").stdout)["drift"]["acceleration"] == pytest.approx(-1.0)
    wedge = json.loads(run("wedge:angle=20", "--position", "1,0", "--velocity", "1,0.1", "--json").stdout)
    assert wedge["ended"] == {"escaped": 1}


def test_plates_have_no_force_unless_one_is_given() -> None:
    words = ["plates", "--law", "mirror", "--position", "0,0,0", "--velocity", "0.2,1,0", "--bounces", "40", "--json"]
    found = json.loads(run(*words).stdout)
    assert {tuple(np.round(v[::2], 12)) for v in (one["velocity"] for one in found["bounces"])} == {(0.2, 0.0)}


def test_the_force_is_along_the_cylinder() -> None:
    """Over a strip, which could have a force of its own, along z as well, as the option says."""
    start = ("--position", "0,0.1,0", "--velocity", "0,0.9,0", "--bounces", "20", "--law", "mirror", "--json")
    for section in ("strip", "circle"):
        last = json.loads(run(f"cylinder:{section}", "--acceleration", "-1", *start).stdout)["bounces"][-1]
        assert last["position"][0] == pytest.approx(0, abs=1e-12)
        assert last["position"][2] == pytest.approx(-0.5 * last["t"] ** 2)


def test_many_orbits_laws_and_exponents() -> None:
    many = json.loads(run("regular", "--orbits", "7", "--bounces", "40", "--json").stdout)
    assert len(many["bounces"]) == 7
    assert set(many["periods"]) <= {"4", "6"}
    assert sum(many["periods"].values()) == 7
    chaos = json.loads(run("stadium", "--law", "mirror", "--lyapunov", "--bounces", "3000", "--json").stdout)
    spectrum = chaos["lyapunov"]["per_bounce"]
    assert spectrum[0] > 0.5
    assert sum(spectrum) == pytest.approx(0, abs=0.01)
    soft = json.loads(
        run("circle", "--law", "contact", "--restitution", "0.9", *START, "--bounces", "20", "--json").stdout
    )
    speeds = [math.hypot(*b["velocity"]) for b in soft["bounces"]]
    assert speeds[-1] < 0.5 * speeds[0]
    assert "Lyapunov" in run("circle", "--lyapunov", "--bounces", "100").stdout
    # an orbit that ends has no exponents, and nothing but that is said
    short = run("circle", "--law", "contact", "--restitution", "0.5", "--lyapunov", "--json")
    assert json.loads(short.stdout)["lyapunov"] == dict.fromkeys(("per_bounce", "per_time", "error"), [None] * 4)
    assert not short.stderr


def test_exponents_of_several_orbits_have_the_error_of_their_mean() -> None:
    """It was the error within the orbits, too small by a factor of eight where regular and chaotic orbits coexist."""
    words = ("stadium", "--orbits", "20", "--bounces", "500", "--lyapunov")
    found = json.loads(run(*words, "--json").stdout)["lyapunov"]
    every = np.array(found["per_bounce_of_each"])
    assert every.shape == (20, 4)
    assert found["per_bounce"] == pytest.approx(every.mean(axis=0), rel=1e-12)
    assert found["error"] == pytest.approx(every.std(axis=0, ddof=1) / math.sqrt(20), rel=1e-12)
    text = " ".join(run(*words).stdout.split())
    assert "Means over 20 orbits; ±: their standard error, from the scatter between orbits." in text
    low, high = every[:, 0].min(), every[:, 0].max()
    assert (
        f"Largest exponent of each, per bounce: {low:.5f} to {high:.5f}, median {np.median(every[:, 0]):.5f}." in text
    )
    one = run("stadium", "--bounces", "500", "--lyapunov").stdout
    assert "scatter between 20 parts of the orbit, or change since half of it" in " ".join(one.split())


def test_the_laws_that_a_billiard_takes_are_listed_with_their_other_names() -> None:
    with pytest.raises(
        carom.CaromError, match=r"law: expected one of mirror, specular, conventional, rolling, no-slip, .*'rolling'\?$"
    ):
        billiards.orbit(billiards.circle(), ((0, 0), (1, 0), 0), 5, law="roling")


def test_starts_lie_where_scatterers_do_not_overlap() -> None:
    """Discs wider than half the cell overlap: a start on a covered arc was refused as a position that nobody had given."""
    found = json.loads(run("sinai:radius=0.6", "--orbits", "20", "--bounces", "50", "--json").stdout)
    assert found["count"] == 1000


def test_pictures(tmp_path: Path) -> None:
    files = [tmp_path / name for name in ("way.svg", "phase.png", "map.pdf")]
    done = run(
        "circle", *START, "--plot", str(files[0]), "--portrait", str(files[1]), "--boundary", str(files[2]), "--json"
    )
    json.loads(done.stdout)
    assert all(f.stat().st_size > 2000 for f in files)
    first = files[0].read_bytes()
    run("circle", *START, "--plot", str(files[0]))
    assert files[0].read_bytes() == first


def drawn(figure: Any) -> None:
    """All of a picture, as coarse as will do; files are written above."""
    figure.savefig(io.BytesIO(), format="png", dpi=40)


@pytest.mark.parametrize(
    "table",
    [billiards.sinai(bounds="surface"), billiards.periodic_strip(), billiards.strip(acceleration=0.4), billiards.wedge(40),
     billiards.sphere(), billiards.box(), billiards.cylinder(billiards.stadium(), acceleration=-9.81),
     billiards.ellipse(bounds="surface")],
    ids=str,
)  # fmt: skip
@pytest.mark.slow(keep=1)
def test_every_kind_of_picture(table: billiards.Table) -> None:
    d = table.dimension
    begin = ((0.45, 0.1, 0.0)[:d], (0.1, 0.9, 0.3)[:d], 1.0 if d == 2 else (0.3, 0.2, 1.0))
    found = billiards.orbit(table, begin, 50)
    figure = plot_orbit(found)
    drawn(figure)
    # what is drawn lies within what is shown
    axes = figure.axes[0]
    (lines,) = axes.collections
    points = np.concatenate([np.asarray(p.vertices) for p in lines.get_paths()])
    (x0, x1), (y0, y1) = axes.get_xlim(), axes.get_ylim()
    assert points[:, 0].min() >= x0
    assert points[:, 0].max() <= x1
    assert points[:, 1].min() >= y0
    assert points[:, 1].max() <= y1
    drawn(plot_portrait(found))
    if table.name != "sphere":
        drawn(plot_boundary(found))
    else:
        with pytest.raises(carom.CaromError, match="boundary map"):
            plot_boundary(found)


@pytest.mark.parametrize(("name", "bounds"), [("flower", "centre"), ("flower", "surface"), ("mushroom", "centre")])
def test_walls_of_curves_are_drawn(name: str, bounds: Any) -> None:
    """Orbits within smooth curves were drawn without the wall."""
    table = billiards.table(name, bounds=bounds)
    found = billiards.orbit(table, billiards.starts(table, 1), 30)
    lines = [line.get_xydata() for line in plot_orbit(found).axes[0].lines if len(line.get_xydata()) > 1]
    for x in found.position.reshape(-1, 2):
        assert min(away(x, line) for line in lines) < 1e-3


def away(x: Any, line: Any) -> float:
    """The distance of a point from a line of segments."""
    step, d = np.diff(line, axis=0), x - line[:-1]
    along = np.clip((d * step).sum(1) / np.maximum((step**2).sum(1), 1e-300), 0, 1)
    return float(np.hypot(*(d - along[:, None] * step).T).min())


def test_exponents_drawn(tmp_path: Path) -> None:
    table = billiards.stadium()
    save(plot_lyapunov(billiards.lyapunov(table, billiards.starts(table, 3, 1), 500)), tmp_path / "l.png")
    assert (tmp_path / "l.png").stat().st_size > 2000


def test_exponents_are_drawn_from_the_command_line(tmp_path: Path) -> None:
    file = tmp_path / "l.svg"
    done = run("stadium", "--orbits", "3", "--bounces", "300", "--lyapunov-plot", str(file), "--json")
    spectrum = json.loads(done.stdout)["lyapunov"]["per_bounce"]
    assert spectrum[0] > 0.1 > abs(sum(spectrum))
    first = file.read_bytes()
    run("stadium", "--orbits", "3", "--bounces", "300", "--lyapunov-plot", str(file))
    assert file.read_bytes() == first
    table = billiards.stadium()
    (axes,) = plot_lyapunov(billiards.lyapunov(table, billiards.starts(table, 3, 1), 300)).axes
    assert "3 orbits" in axes.get_title()
    assert [text.get_text()[:13] for text in axes.get_legend().texts] == [rf"$\lambda_{{{k}}}$" for k in (1, 2, 3, 4)]


@pytest.mark.parametrize("table", ["circle", "sphere"])
def test_every_bounce_is_a_row_of_a_table(table: str, tmp_path: Path) -> None:
    found = json.loads(
        run(table, "--orbits", "3", "--bounces", "4", "--json", "--out", str(tmp_path / "all.csv")).stdout
    )
    first, *rows = (tmp_path / "all.csv").read_text(encoding="utf-8").splitlines()
    flat = [
        [str(orbit), str(bounce), *(repr(x) for value in row.values() for x in (value if isinstance(value, list) else [value]))]
        for orbit, orbits in enumerate(found["bounces"], 1) for bounce, row in enumerate(orbits, 1)
    ]  # fmt: skip
    assert [row.split(",") for row in rows] == flat
    assert first.startswith(
        "orbit,bounce,t,piece,s,x,y,vx,vy,spin," if table == "circle" else "orbit,bounce,t,piece,x,y,z,vx,"
    )


def test_portraits_have_a_title_a_legend_and_one_ink_for_chaotic_orbits() -> None:
    """Every orbit had a colour of twenty, chaotic ones too, and neither table nor kappa was named."""
    table = billiards.stadium()
    found = billiards.orbit(table, billiards.starts(table, 60, 0), 1500)
    for figure in (plot_portrait(found), plot_boundary(found)):
        (axes,) = figure.axes
        assert axes.get_title() == (
            "stadium, straight = 2, radius = 1; boundary of the ball's centre\nno-slip, $\\kappa$ = 0.5; 60 orbits of 1,500 bounces"
        )
        (sea,) = [one for one in axes.collections if one.get_label() == "_sea"]
        islands = [one for one in axes.collections if one.get_label() == "_island"]
        assert len(np.unique(sea.get_facecolors(), axis=0)) == 1
        assert 3 < len(islands) < 20
        assert len(sea.get_offsets()) == (60 - len(islands)) * 1500
        texts = [text.get_text() for text in axes.get_legend().texts]
        assert texts[1].endswith(f"({len(islands)})")
        FigureCanvasAgg(figure).draw()
        words = [axes.title, axes.xaxis.label, axes.get_legend()]
        boxes = [word.get_window_extent() for word in words]
        assert all(box.x0 >= 0 and box.x1 <= figure.bbox.x1 and box.y0 >= 0 for box in boxes)
        assert not any(one.overlaps(other) for i, one in enumerate(boxes) for other in boxes[:i])
    # a mirror circle: every orbit keeps its angle, on a line of the portrait; a mirror stadium is chaotic throughout
    circle = billiards.orbit(
        billiards.circle(), billiards.starts(billiards.circle(), 10, 1, law="mirror"), 300, law="mirror"
    )
    assert on_curves(circle).sum() >= 9
    mirror = billiards.orbit(table, billiards.starts(table, 10, 1, law="mirror"), 1500, law="mirror")
    assert on_curves(mirror).sum() == 0


BAD = [
    ([], "TABLE: expected a table such as circle, or --table FILE, got neither"),
    (["circle", "--table", "a.toml"], "got both"),
    (["--table", "nowhere.toml"], "nowhere.toml: expected a file of a figure, got: No such file or directory"),
    (["--table", "nowhere.json"], "nowhere.json: expected a file of a figure, got: No such file or directory"),
    (["circle:2"], "expected sizes such as straight=2,radius=1, got '2'"),
    (["circl"], "did you mean 'circle'?"),
    (["cardiod"], "got 'cardiod'; a cardioid is the limit of 'limacon:eps=0.99'"),
    (["poincare"], "got 'poincare'; --portrait draws the Poincare section of a table"),
    (["trefoil"], "got 'trefoil'; any smooth curve is given by its formula: 'curve:r=1 + 0.1*cos(3*theta)'"),
    (["cylinder:cone"], "figure: expected sizes such as straight=2,radius=1"),
    (["circle:sides=3"], "circle: sides: expected a field that is known here, got 'sides'; known are shape, radius"),
    (["circle:radius=-1"], "circle: radius: expected a length in m, > 0, got -1"),
    (["circle", "--kappa", "0"], "Disc: inertia: expected kappa = I/(m a^2) above 0, got 0"),
    (["circle", "--position", "1"], "--velocity: expected one together with --position, got none"),
    (["circle", "--position", "1", "--velocity", "1,0"], "--position: expected two numbers, such as 0.1,0.2, got '1'"),
    (["circle", "--position", "3,0", "--velocity", "1,0"], "2 outside"),
    (
        ["circle", "--position", "0,0", "--velocity", "1 m/s,0"],
        "--velocity: expected two numbers, such as 0.1,0.2, got '1 m/s,0'",
    ),
    (["strip", "--acceleration", "g"], "--acceleration: expected a number, got 'g'"),
    (["circle", "--spin", "3"], "--spin: expected --position and --velocity with it"),
    (["circle", "--bounces", "0"], "bounces: expected a whole number >= 1, got 0"),
    (
        ["circle", "--bounces", "100000000000"],
        "which fill 4 GB, got 100,000,000,000, which take 5.2 TB; take fewer; in Python carom",
    ),
    (["circle", "--orbits", "3", *START], "--orbits: expected 1 with --position, got 3"),
    (["circle", "--law", "noslip"], "did you mean 'no-slip'?"),
    (["circle", "--friction", "0.3"], "--friction: law no-slip does not use it"),
    (["circle", "--law", "mirror", "--friction", "0.1"], "--friction: law mirror does not use it; --law contact does"),
    (["circle", "--plot", "a.png", "--boundary", "./a.png"], "--boundary a.png: expected another file than --plot's"),
    (["cylinder:plates"], "cylinder: section: expected a figure in the plane"),
    (["wedge:angle=400"], "wedge: angle: expected degrees > 0 and < 180, got 400"),
    (["sphere", "--kappa", "0.9"], "got 0.9; a thin shell is 'hollow'; in the plane carom.Disc takes any"),
    (["sinai:radius=0.8"], "sinai: obstacles: expected room between them, got one that covers the cell"),
    (["periodic-strip:radius=0.8"], "periodic-strip: obstacles: expected room between them"),
    (["circle", "--seed", "-1"], "seed: expected a whole number >= 0, got -1"),
    (["circle", "--orbits", "100000000000"], "starts: count: expected no more than 10,000,000, which fill 4 GB"),
    (["circle", "--bounds", "center"], "did you mean 'centre'?"),
    (["circle", "--at-corner", "stop"], "--at-corner: expected 'end' or 'pass', got 'stop'"),
    (["wedge"], "give an acceleration towards the vertex (of a wedge such as -9.81,0), or --position and --velocity"),
    (["polygon:points=0,0 1,x 2,2"], "polygon: points[1][1]: expected a length in m, got 'x'"),
    (
        ["polygon:points=0,0 4,0 4,4 2,4 2,2 2,4 0,4"],
        "the side from corner 5 to 6 back along that from 4 to 5",
    ),
    (["circle", "--plot", "nowhere/a.svg"], "expected a folder that exists"),
    (["circle", "--law", "contact", "--restitution", "2", *START], "--restitution: expected a number from 0 to 1"),
    (["ellipse:half_axes=1,0.1", "--bounds", "surface"], "expected one that fits in the ellipse, got 0.1"),
    (["circle", "--law", "contact", "--restitution", "0.5", "--reverse"], "expected a reversible one"),
]


@pytest.mark.parametrize(("words", "said"), BAD, ids=[" ".join(words) for words, _said in BAD])
def test_a_fault_is_a_line(
    words: list[str], said: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    lines = fails(monkeypatch, capsys, *words)
    assert len(lines) == 1
    assert said in lines[0]


def test_all_faults_at_once(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    assert len(fails(monkeypatch, capsys, "stadium:sides=4,angle=3")) == 2


def test_all_faults_of_the_options_at_once(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    words = ("stadium:sides=4", "--law", "noslip", "--bounces", "0", "--plot", "nowhere/a.svg")
    lines = fails(monkeypatch, capsys, *words)
    assert [line.split(": ")[1] for line in lines] == ["--plot nowhere/a.svg", "stadium", "--law", "--bounces"]
    words = ("circle", "--friction", "0.3", "--bounces", "0", "--position", "3")
    assert [line.split(": ")[1] for line in fails(monkeypatch, capsys, *words)] == [
        "--friction",
        "--bounces",
        "--velocity",
    ]
    words = ("circle", "--law", "contact", "--friction", "0.3", "--reverse", "--position", "3,0", "--velocity", "1,0")
    assert [line.split(": ")[1] for line in fails(monkeypatch, capsys, *words)] == ["--reverse", "--position"]
    lines = fails(monkeypatch, capsys, "circle", "--orbits", "-1", "--seed", "-5")
    assert [line.split(": ")[1] for line in lines] == ["--seed", "--orbits"]


def test_no_orbit_is_run_that_could_not_be_reversed(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def never(*_args: Any, **_options: Any) -> None:
        raise AssertionError("it was run")

    monkeypatch.setattr("carom.billiards.orbit_by_name.orbit_from_setup", never)
    (line,) = fails(monkeypatch, capsys, "circle", "--law", "contact", "--restitution", "0.5", "--reverse")
    assert "reverse: law: expected a reversible one" in line


def test_why_orbits_ended_is_printed_in_words() -> None:
    assert "ended: after all bounces" in run("circle", "--bounces", "3", *START).stdout
    assert "ended: 2 after all bounces" in run("circle", "--bounces", "3", "--orbits", "2").stdout


def test_a_wedge_without_a_force_names_one_that_runs():
    done = runner.invoke(app, ["orbit", "wedge:angle=40"])
    assert (
        "got a wedge, whose walls are infinite; give an acceleration towards the vertex (of a wedge such as -9.81,0)"
        in str(done.exception)
    )
    assert runner.invoke(app, ["orbit", "wedge", "--acceleration=-9.81,0", "--bounces", "5"]).exit_code == 0


@pytest.mark.slow
def test_the_legend_of_a_portrait_is_no_wider_than_its_axes() -> None:
    """Two entries in one line were wider: the axes shrank, and the last number was cut off."""
    figure = plot_portrait(carom.orbit("curve:r=1 + 0.1*cos(3*theta)", 100, orbits=100))
    FigureCanvasAgg(figure).draw()
    axes = figure.axes[0]
    legend = axes.get_legend()
    assert len(legend.get_texts()) == 2
    assert legend.get_window_extent().width <= axes.bbox.width


def test_periodic_orbits_by_their_walls() -> None:
    words = ["discs", "--law", "mirror", "--itinerary", "AB,ABC", "--starts", "8", "--bounces", "1"]
    shown = json.loads(run(*words, "--json").stdout)["periodic"]
    assert [one["itinerary"] for one in shown] == ["AB", "ABC"]
    assert " ABC " in run(*words).stdout
    with pytest.raises(carom.CaromError, match="itinerary: expected two walls or more, letters from A to C"):
        runner.invoke(app, ["orbit", *words[:4], "AX"], catch_exceptions=False)


def test_a_table_of_points_is_no_figure_and_whole_numbers_may_have_an_exponent(tmp_path, capsys):
    (tmp_path / "r.csv").write_text("x,y\n0,0\n1,0\n1,1\n")
    (line,) = commands.fails(capsys, "orbit", "--table", str(tmp_path / "r.csv"))
    assert "expected a figure in TOML or JSON, got a table (.csv); corners are a list of [x, y] in JSON" in line
    code, out, _err = commands.command(capsys, "orbit", "circle", "--bounces", "2e1", "--json", "--seed", "1")
    assert (code, out) == (
        0,
        commands.command(capsys, "orbit", "circle", "--bounces", "20", "--json", "--seed", "1")[1],
    )
    (line,) = commands.fails(capsys, "orbit", "circle", "--bounces", "2.5")
    assert "--bounces: expected a whole number, such as 20000 or 2e4, got '2.5'" in line
    (line,) = commands.fails(capsys, "gas", "--max-events", "1e3.5")
    assert "--max-events: expected a whole number" in line
