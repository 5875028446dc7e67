"""What has no answer is refused with one clear line a fault: where, what was expected, what came."""

import math

import numpy as np
import pytest
from reference.commands import command, fails

import carom
from carom.cli.verbs import as_option
from carom.errors import Fault

NAN, INF = math.nan, math.inf
BALL = carom.Ball()
STATE = carom.rolling(BALL, (-1.0, 1.0))


def refused(make, *words):
    """The error's lines, after looking that each is one clear line: where, expected, got."""
    with pytest.raises(carom.CaromError) as caught:
        make()
    assert isinstance(caught.value, ValueError)
    text = str(caught.value)
    assert text.splitlines() == list(caught.value.faults)
    for line in text.splitlines():
        assert "expected" in line, line
        assert "got" in line, line
        assert line.index("expected") > 0, line  # where comes first
    for word in words:
        assert word in text, text
    return text


@pytest.mark.parametrize("value", [0.0, -1.0, NAN, INF, -INF, "a", None, [0.1, 0.0], [[0.1], [NAN]], 1e101, 1 + 2j])
def test_radius_and_mass(value):
    refused(lambda: carom.Ball(radius=value), "Ball: radius", "m, > 0")
    refused(lambda: carom.Ball(mass=value), "Ball: mass", "kg, > 0")


def test_a_number_that_is_only_too_large_is_told_how_large_it_may_be():
    assert "expected a length in m, > 0, at most 1e+100 in size, got 1e+300" in refused(lambda: carom.Ball(1e300))
    assert "at most" not in refused(lambda: carom.Ball(INF))


@pytest.mark.parametrize("value", [0.0, -0.4, 0.7, NAN, INF, None, [0.4, 0.9], "sold"])
def test_kappa(value):
    refused(lambda: carom.Ball(inertia=value), "Ball: inertia")


def test_kappa_of_discs():
    assert carom.Disc(inertia="ring").kappa == 1
    assert carom.Ball(inertia=2 / 3).kappa == 2 / 3
    refused(lambda: carom.Disc(inertia=0.0), "Disc: inertia")
    refused(lambda: carom.Disc(inertia="solid"), "'disc', 'ring'")
    # a remedy where there is one
    refused(lambda: carom.Ball(inertia=1.0), "carom.Disc")


def test_every_fault_at_once():
    text = refused(lambda: carom.Ball(radius=0, mass=-1, inertia=5))
    assert len(text.splitlines()) == 3
    text = refused(lambda: carom.Surface(2, -1, 3))
    assert len(text.splitlines()) == 3


@pytest.mark.parametrize("value", [-0.1, 1.0001, NAN, INF, None, "x", [0.5, 2.0]])
def test_restitution(value):
    refused(lambda: carom.Surface(value), "Surface: restitution", "0 to 1")


@pytest.mark.parametrize("value", [-0.1, -INF, NAN, None, "x", [0.5, -2.0]])
def test_friction(value):
    refused(lambda: carom.Surface(1, value), "Surface: friction", ">= 0")
    assert carom.Surface(1, INF).friction == INF  # here infinity has a meaning


@pytest.mark.parametrize("value", [-1.1, 1.1, NAN, INF, None])
def test_tangential_restitution(value):
    refused(lambda: carom.Surface(1, 1, value), "Surface: tangential_restitution", "-1 to 1")


@pytest.mark.parametrize(
    "value",
    [
        (NAN, 0, 0),
        (INF, 0, 0),
        (1, 2),
        3.0,
        (1, 2, 3, 4),
        "abc",
        None,
        [(1, 2, 3), (1, 2)],
        [(0, 0, 0), (0, NAN, 0)],
        (1e101, 0, 0),
    ],
)
def test_states(value):
    refused(lambda: carom.State(value), "State: velocity", "m/s")
    refused(lambda: carom.State((0, 0, 0), value), "State: spin", "rad/s")
    if value is not None:
        refused(lambda: carom.State((0, 0, 0), (0, 0, 0), value), "State: position", "in m")


def test_masked_numbers_are_no_numbers():
    masked = np.ma.masked_array([1.0, 2.0, 3.0], [False, True, False])
    refused(lambda: carom.State(masked), "State: velocity")
    assert carom.State(np.ma.masked_array([1.0, 2.0, 3.0])).velocity[1] == 2.0


def test_what_came_is_one_line_however_large_it_is():
    text = refused(lambda: carom.State(np.full((40, 3), "x")), "State: velocity")
    assert len(text.splitlines()) == 1
    assert len(text) < 300


def test_where_of_many():
    v = np.zeros((4, 5, 3))
    v[2, 3, 1] = NAN
    v[3, 0, 1] = INF
    refused(lambda: carom.State(v), "index (2, 3)", "2 in all")
    refused(lambda: carom.Ball(radius=[0.1, 0.2, -0.3]), "index (2,)", "-0.3")


def test_shapes_that_do_not_broadcast():
    refused(lambda: carom.State(np.zeros((2, 3)), np.zeros((4, 3))), "(2, 3)", "(4, 3)")
    many = carom.State(np.zeros((4, 3)) - [1, 0, 0])
    refused(lambda: carom.impact(BALL, many, np.ones((3, 3)) * [1, 0, 0]), "broadcast")
    refused(lambda: carom.impact(carom.Ball(radius=[1.0, 2.0, 3.0]), many), "broadcast")
    refused(lambda: carom.impact(BALL, many, surface=carom.Surface([0.1, 0.2])), "broadcast")
    refused(lambda: carom.two_step(BALL, many, height=[0, 1, 2]), "broadcast")
    refused(lambda: carom.kinetic_energy(carom.Ball(mass=[1.0, 2.0, 3.0]), many), "broadcast")
    refused(lambda: carom.slip(carom.Ball(radius=[1.0, 2.0, 3.0]), many), "broadcast")
    refused(lambda: carom.rolling(carom.Ball(radius=[1.0, 2.0, 3.0]), [(1, 0), (2, 0)]), "broadcast")
    refused(lambda: carom.rolling(BALL, [(1, 0), (2, 0)], [1, 2, 3]), "broadcast")
    other = carom.State(np.zeros((3, 3)))
    refused(lambda: carom.collide(BALL, many, BALL, other), "broadcast")
    refused(
        lambda: carom.collide(BALL, many, carom.Ball(mass=[1.0, 2.0]), carom.State((0, 0, 0)), (1, 0, 0)), "broadcast"
    )
    refused(
        lambda: carom.domenech(BALL, carom.rolling(BALL, [(1, 0), (2, 0)]), impact_angle=[0.1, 0.2, 0.3]), "broadcast"
    )


@pytest.mark.parametrize(
    "normal", [(0, 0, 0), (NAN, 0, 0), (INF, 0, 0), (1, 0), 1.0, "x", None, [(1, 0, 0), (0, 0, 0)], [(1, 0, 0), (1, 0)]]
)
@pytest.mark.parametrize(
    "verb", [carom.impact, carom.two_step, carom.conventional, carom.mirror, carom.no_slip, carom.settle]
)
def test_normals(verb, normal):
    if verb is carom.settle:
        refused(lambda: verb(BALL, STATE, carom.Surface(0), normal), "normal")
    else:
        refused(lambda: verb(BALL, STATE, normal=normal), "normal")


@pytest.mark.parametrize("verb", [carom.impact, carom.two_step, carom.conventional, carom.mirror, carom.no_slip])
def test_a_ball_that_moves_away(verb):
    away = carom.rolling(BALL, (0.25, 1.0))
    refused(lambda: verb(BALL, away), "moves towards the wall", "0.25 m/s away", "the normal points")
    states = carom.rolling(BALL, [(-1, 1), (-1, 0), (0.25, 1)])
    refused(lambda: verb(BALL, states), "index (2,)")


def test_along_the_wall_is_not_away():
    state = carom.rolling(BALL, (0.0, 1.0))
    assert carom.impact(BALL, state).regime == "graze"
    assert carom.impact(BALL, state).after == state


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"gravity": -1.0}, ("gravity",)),
        ({"gravity": NAN}, ("gravity",)),
        ({"gravity": INF}, ("gravity",)),
        ({"gravity": "9.81"}, ("gravity",)),
        ({"gravity": (0, 0, -9.81)}, ("gravity",)),
        ({"height": -0.1}, ("height",)),
        ({"height": NAN}, ("height",)),
        ({"height": INF}, ("height",)),
        ({"floor_contact": "before"}, ("floor_contact", "'with'", "'after'", "'before'")),
        ({"gravity": -1.0, "height": -1.0}, ("gravity", "height")),
    ],
)
def test_two_step_options(options, words):
    refused(lambda: carom.two_step(BALL, STATE, **options), *words)
    if "floor_contact" not in options:
        refused(lambda: carom.settle(BALL, STATE, **options), *words)


def test_pressed_with_tangential_restitution():
    backspin = carom.State((-1, 0, 0), (0, 100, 0))
    wall = carom.Surface(0.9, 0.3, 0.5)
    refused(lambda: carom.two_step(BALL, backspin, wall), "tangential_restitution", "floor_contact='after'")
    assert carom.two_step(BALL, backspin, wall, floor_contact="after").after_wall.velocity[2] < 0


def test_discs():
    disc = carom.Disc()
    refused(lambda: carom.two_step(disc, carom.State((-1, 0, 0))), "disc", "carom.impact")
    refused(lambda: carom.rolling(disc, (-1, 0)), "disc")
    refused(lambda: carom.impact(disc, carom.State((-1, 0, 0.1))), "plane")
    refused(lambda: carom.impact(disc, carom.State((-1, 0, 0), (1, 0, 0))), "plane")
    refused(lambda: carom.impact(disc, carom.State((-1, 0, -1)), (1, 0, 1)), "plane")
    refused(lambda: carom.conventional(disc, carom.State((-1, 0, 0))), "disc")


def test_rolling():
    refused(lambda: carom.rolling(BALL, (1, 0, 0.1)), "rolling: velocity", "v_z")
    refused(lambda: carom.rolling(BALL, (1, 0, 0, 0)), "rolling: velocity")
    refused(lambda: carom.rolling(BALL, 1.0), "rolling: velocity")
    refused(lambda: carom.rolling(BALL, (NAN, 0)), "rolling: velocity")
    refused(lambda: carom.rolling(BALL, (1, 0), NAN), "rolling: spin_z")
    refused(lambda: carom.rolling(BALL, (1, 0), "x"), "rolling: spin_z")
    refused(lambda: carom.rolling(BALL, None), "rolling: velocity")


def test_unknown_law_names_the_nearest():
    from carom.laws.registry import law_named

    refused(lambda: law_named("twostep"), "two-step")
    refused(lambda: law_named("nonsense"), "mirror")


def readers():
    """Everything public that takes a file's name."""
    from carom import gas
    from carom.data import datasets, make_rebounds, predict, read_rebounds
    from carom.laws.registry import law_named
    from carom.plot import save
    from carom.tracks import read_tracks

    table = datasets.load("tt_rackets")
    rebounds = make_rebounds("planar", {"v_n_in": 1.0, "v_n_out": 0.9})
    settings = predict.PredictSettings(law=law_named("mirror"))
    return {
        "load_scene": carom.load_scene,
        "load_trajectory": carom.load_trajectory,
        "load_gas": gas.load_gas,
        "load_checkpoint": gas.load_checkpoint,
        "read_rebounds": read_rebounds,
        "read_tracks": read_tracks,
        "predict_table": lambda path: predict.predict_table(path, None, settings),
        "Dataset.to_csv": table.to_csv,
        "Rebounds.save": rebounds.save,
        "plot": lambda path: save(None, path),
    }


@pytest.mark.parametrize("name", list(readers()))
@pytest.mark.parametrize("value", [3, None, b"x", ["a"], "a\0b"])
def test_what_is_no_name_of_a_file(name, value):
    refused(lambda: readers()[name](value), f"{name}: path: expected a file's name")


@pytest.mark.parametrize("name", list(readers()))
def test_a_folder_is_no_file(name, tmp_path):
    with pytest.raises(carom.CaromError, match="expected"):
        readers()[name](tmp_path)


@pytest.mark.parametrize("value", [5, 0.5])
def test_what_is_neither_a_law_nor_several(value):
    from carom.fitting import Setting, fit_laws

    said = "laws: expected a name or a sequence of names"
    refused(lambda: carom.compare(laws=value), f"compare: {said}")
    refused(lambda: carom.explore(laws=value), f"explore: {said}")
    refused(
        lambda: fit_laws(carom.data.published_rebounds("kharaz2001").rebounds, Setting(radius=0.0025), value),
        f"fit_laws: {said}",
    )


@pytest.mark.parametrize("value", [5, "mirror", 0.5])
def test_what_is_no_pair_of_laws(value):
    from carom.fitting.design import Shots, require_plan

    setting = carom.fitting.Setting(radius=0.02)
    refused(lambda: require_plan(setting, value, Shots()), "expected two laws")


@pytest.mark.parametrize("value", [3, None, ["a"], b"mirror"])
def test_what_is_no_name(value):
    from carom.data import datasets
    from carom.laws.registry import card_named, find_law, law_named

    for verb in (datasets.load, find_law, law_named, card_named, lambda name: carom.compare(laws=[name])):
        refused(lambda verb=verb: verb(value), "name: expected a str")
    refused(lambda: carom.compare(value), "compare: meeting") if value else None


@pytest.mark.parametrize("value", ["x", [0.1], b"x", 1j, 10**400])
def test_settings_of_fits_that_are_no_numbers(value):
    from carom.fitting import Setting
    from carom.fitting.rows import require_settings

    names = ("kappa", "contact_height", "floor_restitution", "floor_friction", "roll", "spin_width", "spin_mean")
    given = dict.fromkeys(names, value)
    text = refused(
        lambda: require_settings(Setting(radius=value, **given, fixed={"friction": value})), "radius: ", "fix"
    )
    assert len(text.splitlines()) == 9
    refused(lambda: require_settings(Setting(radius=0.02, fit=3, fixed=3, bounds=3)), "fit: ", "fixed: ", "bounds: ")
    refused(lambda: require_settings(value), "fit: setting: expected a Setting")
    given = dict.fromkeys(("kappa", "noise", "contacts", "spin_width"), value)
    assert (
        len(refused(lambda: require_settings(Setting(radius=value, **given), whole=True), "contacts: ").splitlines())
        == 5
    )


@pytest.mark.parametrize(
    ("words", "line"),
    [
        (
            ("compare", "--angle", "x"),
            "carom: --angle: expected an angle, such as 45 (degrees) or 0.79rad, got 'x'",
        ),
        (
            ("compare", "--angle=x"),
            "carom: --angle: expected an angle, such as 45 (degrees) or 0.79rad, got 'x'",
        ),
        (
            ("simulate", "a.toml", "--max-events", "1.5"),
            "carom: --max-events: expected a whole number, such as 20000 or 2e4, got '1.5' (carom simulate --help)",
        ),
    ],
)
def test_an_option_that_is_no_number(capsys, words, line):
    assert fails(capsys, *words) == [line]


@pytest.mark.parametrize(
    ("words", "begins", "ends"),
    [
        (("explore", "--laws", "maww", "--out", "a.html"), "--laws: expected one of mirror, ", "did you mean 'maw'?"),
        (("design", "--laws", "maw,contct"), "--laws: expected one of mirror, ", "did you mean 'contact'?"),
        (("aim", "carom"), "aim: reach: expected one of --point, --pocket and --hit", "got none of them"),
        (("simulate", "pool-9f"), "pool-9f: expected a scene file", "did you mean 'pool-9ft'?"),
        (("simulate", "carom", "--set", "balls.0.radius=-1mm"), "--set: balls[0].radius: expected a length", "got '-1mm'"),
        (("orbit", "stadium", "--periodic", "4-2"), "--periodic: expected ranges from the smaller", "got '4-2'"),
        (("explore", "--data", "a.png", "--out", "a.html"), "a.png: expected a CSV file", "got a binary file"),
        (("predict", "a.png", "--out", "a.csv"), "a.png: expected a CSV file", "got a binary file"),
        (("sweep", "run", "a.toml"), "a.toml: expected a sweep of a scene, got the scene itself", "scene = 'a.toml'"),
    ],
)  # fmt: skip
def test_a_wrong_name_or_file_is_one_line_and_writes_nothing(capsys, tmp_path, monkeypatch, words, begins, ends):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a.png").write_bytes(b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0")
    (tmp_path / "a.toml").write_text(carom.scene_text(), encoding="utf-8")
    (line,) = fails(capsys, *words)
    assert line.startswith(f"carom: {begins}")
    assert line.endswith(ends)
    assert sorted(one.name for one in tmp_path.iterdir()) == ["a.png", "a.toml"]


def test_a_plot_of_a_sweep_names_its_own_options(capsys):
    fails(capsys, "sweep", "plot", "none.zarr", "--of", "a", "--x", "b", "--out", "c.png")
    assert str(as_option(Fault("plot", "of", "an outcome", "'a'"))) == "--of: expected an outcome, got 'a'"
    assert str(as_option(Fault("plot", "panels", "a dimension", "'b'"))) == "--panels: expected a dimension, got 'b'"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("compare", "--restitution", "85%"), "--restitution: expected a valid number, got '85%'; write 0.85"),
        (("tracks", "show", "a.csv", "--rate", "120fps"), "--rate: expected a valid number, got '120fps'; write 120"),
        (("compare", "--gravity=9.8", "--gravity", "3"), "--gravity: expected one value, got 2"),
        (
            ("simulate", "a.toml", "--law", "mirror", "--law", "maw"),
            "--law: expected one value, got 2; carom compare takes several laws",
        ),
        (
            ("compare", "--contact-height", "37apples"),
            "--contact-height: expected radii of the ball, such as 1.25, or a length with its unit, such as 37mm, got '37apples'",
        ),
        (
            ("compare", "--cushion-height", "0.037"),
            "--contact-height: expected radii of the ball, such as 1.25, or a length with its unit, such as 37mm, got 0.037;"
            " for a length write 37mm",
        ),
        (("orbit", "circle", "--starts", "5"), "--starts has no effect without --periodic or --itinerary; omit it"),
        (
            ("predict", "a.csv", "--law", "maw", "--contact-height", "37mm"),
            "--contact-height: expected --radius beside a length, got none",
        ),
    ],
)
def test_values_with_signs_units_and_repetitions_get_a_line_with_a_remedy(words, said, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a.csv").write_text("v_n_in,v_t_in\n1,0\n")
    assert said in fails(capsys, *words)[-1]


def test_the_height_of_a_contact_is_a_number_of_radii_or_a_length(capsys):
    heads = []
    for height in ("1.24", "1,24", "37.2mm", "3.72 cm"):
        _code, out, _err = command(
            capsys, "compare", "--radius", "30mm", "--laws", "mirror", "--cushion-height", height
        )
        heads.append(out.split("Floor:")[0])
    assert "touching 1.24 radii above the floor" in heads[0]
    assert heads == heads[:1] * 4
