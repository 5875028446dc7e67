"""Names of the user's stand in figures as they are: no formula is made of a dollar sign, no control character is drawn."""

from __future__ import annotations

import warnings
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import carom
from carom import billiards, plot
from carom.cli.streams import guarded_streams
from carom.plot.film import Film
from carom.plot.fit import _from_above
from carom.plot.style import literal, new_figure, style

pytest.importorskip("matplotlib")
from matplotlib.text import Text
from reference.commands import command

NAME = "_$\\frac{$ NAME \x1b[31m\x07\u202e漢 $x$"


def scene() -> carom.Scene:
    wall = carom.scene.Plane(name=NAME, point=(0, 0, 0), normal=(1, 0, 0), restitution=0.8, friction=0.2)
    balls = [
        {"name": NAME, "radius": 0.03, "mass": 0.2, "position": (1, 0), "velocity": (-1, 0.3, 0)},
        {"name": "$", "radius": 0.03, "mass": 0.2, "position": (0.5, 0.1)},
    ]
    return carom.Scene(floor=carom.Floor(friction=0.2), walls=[wall], balls=balls, run=carom.Run(duration=1))


def trajectory(_folder: Path) -> Any:
    return plot.plot_trajectory(carom.simulate(scene()), title=NAME)


def many_balls(_folder: Path) -> Any:
    balls = [{"name": f"${i}", "radius": 0.03, "mass": 0.2, "position": (0.2 * i + 0.1, 0)} for i in range(9)]
    run = carom.simulate(scene().model_copy(update={"balls": carom.Scene(balls=balls, floor={"friction": 0.2}).balls}))
    return plot.plot_trajectory(run, title=NAME)


def film(_folder: Path) -> Any:
    with style():
        made = Film(carom.simulate(scene()), np.array([0.0, 0.5]), (0.0, 1.0), 400)
        made.frame(1)
    return made.axes.figure


def gas(_folder: Path) -> Any:
    species = [{"name": name, "count": 27, "radius": 0.3, "temperature": 1.0} for name in (NAME, "b")]
    contacts = [
        {"between": pair, "restitution": 1, "friction": 0.1} for pair in ((NAME, NAME), (NAME, "b"), ("b", "b"))
    ]
    made = carom.gas.GasScene(
        container={"shape": "periodic", "size": (6, 6, 6)}, species=species, contacts=contacts, run={"max_events": 600},
    )  # fmt: skip
    session = carom.gas.Session(made)
    session.run()
    return plot.plot_gas(session, title=NAME)


def ensemble(_folder: Path) -> Any:
    species = [{"name": name, "count": 8, "radius": 0.3, "temperature": 1.0} for name in (NAME, "b")]
    contacts = [
        {"between": pair, "restitution": 1, "friction": 0.1} for pair in ((NAME, NAME), (NAME, "b"), ("b", "b"))
    ]
    made = carom.gas.GasScene(
        container={"shape": "periodic", "size": (4, 4, 4)}, species=species, contacts=contacts, run={"max_events": 200}
    )
    return plot.plot_ensemble(carom.sweeps.gas_ensemble(made, 2), title=NAME)


def whole_tracks(_folder: Path) -> Any:
    """The panel of a shot: of a fit only what it draws."""
    place, time = np.array([[0.0, 0.0], [0.1, 0.1]]), np.array([0.0, 1.0])
    frames = SimpleNamespace(
        segments=[SimpleNamespace(group=NAME, name=NAME, position=place, time=time)], count=np.array([2])
    )
    run = SimpleNamespace(end=1.0, at=lambda t: SimpleNamespace(position=np.zeros((len(t), 1, 3))))
    fit: Any = SimpleNamespace(
        frames=frames, model=SimpleNamespace(held={}), numbers={}, simulate=lambda _n: run, rms=lambda _which: 1e-3
    )
    with style():
        figure = new_figure(3, 3)
        _from_above(figure.subplots(), fit, NAME)
    return figure


def comparison(_folder: Path) -> Any:
    def kernel(v: Any, w: Any, n: Any, a: Any, kappa: Any, e: Any, mu: Any, beta: Any) -> Any:
        return (-v[0], v[1], v[2]), w

    law = carom.wall_law(carom.Card(NAME, "", (), "", "", ""), kernel)
    return plot.compare(carom.compare(laws=[law, "mirror"], speed=1.0, angle_deg=45.0))


def orbit(_folder: Path) -> Any:
    def kernel(v: Any, w: Any, n: Any, a: Any, kappa: Any, e: Any, mu: Any, beta: Any) -> Any:
        d = 2 * (v[0] * n[0] + v[1] * n[1])
        return (v[0] - d * n[0], v[1] - d * n[1], v[2]), w

    kernel.__name__ = NAME
    law = carom.wall_law(carom.Card(NAME, "", (), "", "", ""), kernel)
    found = billiards.orbit(billiards.stadium(), ((0.2, 0.1), (0.8, 0.3), 0.5), bounces=40, law=law)
    return plot.plot_portrait(found)


def sweep(_folder: Path) -> Any:
    pytest.importorskip("xarray")
    axes = {"balls.0.velocity.x": [-1.0, -2.0], "walls.0.friction": [0.1, 0.2]}
    made = carom.sweep(carom.Space(scene(), axes), keep=["final.velocity"]).run()
    return plot.plot_sweep(made, "final.velocity", panels="ball")


@pytest.mark.parametrize("draw", [trajectory, many_balls, film, gas, ensemble, whole_tracks, comparison, orbit, sweep])
@pytest.mark.slow(keep=3)
def test_names_are_drawn_as_they_are(draw: Any, tmp_path: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        figure = draw(tmp_path)
        plot.save(figure, tmp_path / "a.svg")
    said = [text for text in figure.findobj(Text) if "NAME" in text.get_text()]
    assert said
    for text in said:
        line, is_formula = text._preprocess_math(text.get_text())
        assert "\x1b" not in line
        assert "$\\frac{$ NAME \\x1b[31m\\x07\\u202e漢 $x$" in line or is_formula
        assert not is_formula or r"\$\frac{\$" in text.get_text()  # (beside a formula of carom's own)
    assert not set("\x1b\x07\u202e") & set((tmp_path / "a.svg").read_text(encoding="utf-8"))


def test_a_film_of_a_shot_that_is_named_so(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    rows = [f"{NAME},{k / 60},{900 - 12 * k if k < 50 else 300 + 9 * (k - 50)},{5 * k}" for k in range(100)]
    file = tmp_path / "film.csv"
    file.write_text("track,t [s],x [mm],y [mm]\n" + "\n".join(rows) + "\n", encoding="utf-8")
    code, out, err = command(
        capsys, "tracks", "show", str(file), "--view", "above", "--radius", "20mm", "--plot", str(tmp_path / "a.svg")
    )
    assert code == 0, err
    assert (tmp_path / "a.svg").exists()
    assert not set("\x1b\x07\u202e") & set(out + err)


def test_a_name_in_the_table_of_a_run_is_whole(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = carom.save_scene(scene(), tmp_path / "scene.toml")
    code, out, err = command(capsys, "simulate", str(file), "--plot", str(tmp_path / "a.svg"))
    assert code == 0
    assert not set("\x1b\x07\u202e") & set(out + err)
    assert "Glyph" not in err
    assert "NAME \\x1b[31m\\x07\\u202e漢" in out


def test_warnings_of_libraries_do_not_steer_the_terminal() -> None:
    before = warnings.formatwarning
    with guarded_streams():
        said = warnings.formatwarning("a \x1b[31mname", UserWarning, "file.py", 1)
    assert said.startswith("file.py:1: UserWarning: a \\x1b[31mname\n")
    assert warnings.formatwarning is before


def test_what_a_font_lacks_is_no_warning() -> None:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        with style():
            warnings.warn("Glyph 28450 (\\N{CJK}) missing from font(s) STIXGeneral.", stacklevel=1)
            warnings.warn("another", stacklevel=1)
    assert [str(one.message) for one in caught] in ([], ["another"])
    assert literal("a $b$") == r"a \$b\$"
    assert np.char.count(literal("$" * 5), r"\$") == 5


def test_the_legend_of_a_map_of_names_stays_in_the_figure() -> None:
    """Six names of pockets in a row went beyond both edges."""
    from carom.plot.style import new_figure, style
    from carom.plot.sweeps import _legend

    names = [f"{side} {place} pocket" for side in ("bottom", "top") for place in ("left", "middle", "right")]
    with style():
        figure = new_figure(6.3, 5.5)
        _legend(figure, names, set(range(6)))
        figure.canvas.draw()
        (legend,) = figure.legends
        box = legend.get_window_extent()
    assert box.x0 >= 0
    assert box.x1 <= figure.bbox.width
