"""Tables as people write them: each layout gives the components, and the fit gives the numbers, that a simulator of its own had."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from reference.commands import fails
from reference.written_tables import BETA, KAPPA, LAYOUTS, MU, RADIUS, STRAIGHT, E, bounces, drops, layout

from carom.data import read_rebounds
from carom.data.rebound_files import heads_rebounds
from carom.errors import CaromError
from carom.fitting import Setting, fit_laws, usable_rows
from carom.tracks import Settings, Track, measure, to_rebounds

ALL = ("speed_and_angle", "from_surface", "x_and_y", "errors_in_cells", "missing_cells", "normalised_spin")
EXAMPLES = Path(__file__).parents[2] / "docs" / "data" / "tables"


def table(tmp_path: Path, text: str, **options):
    path = tmp_path / "table.csv"
    path.write_text(text, encoding="utf-8")
    return read_rebounds(path, ball=(RADIUS, KAPPA), **options)


@pytest.mark.parametrize("name", ALL)
def test_a_layout_has_the_components_that_were_written(tmp_path: Path, name: str) -> None:
    found, true = table(tmp_path, layout(name)), bounces(1)
    for column, expected in true.items():
        seen = np.isfinite(found[column])
        assert seen.sum() >= 20
        # (as many digits as are written)
        assert np.abs(found[column] - expected)[seen].max() < (0.05 if "spin" in column else 0.006)


@pytest.mark.parametrize("name", LAYOUTS)
def test_the_examples_in_the_documentation_are_these(name: str) -> None:
    assert (EXAMPLES / f"{name}.csv").read_text(encoding="utf-8") == layout(name)


@pytest.mark.parametrize("name", [*ALL, "cross", "walton", "errors_in_per_cent"])
def test_the_fit_of_a_layout_gives_what_the_simulator_had(tmp_path: Path, name: str) -> None:
    fit = fit_laws(table(tmp_path, layout(name)), Setting(RADIUS, KAPPA), ["contact"], bootstrap=0, profiles=False).best
    for parameter, true in (("restitution", E), ("friction", MU), ("tangential_restitution", BETA)):
        one = fit.estimates[parameter]
        assert abs(one.value - true) < 3 * one.stderr, parameter
        assert one.stderr < 0.02


@pytest.mark.parametrize("name", [*STRAIGHT, "angle_and_ratios"])
def test_heights_times_and_ratios_without_spins_give_the_restitution_alone(tmp_path: Path, name: str) -> None:
    ranking = fit_laws(table(tmp_path, layout(name)), Setting(RADIUS, KAPPA), ["contact"], bootstrap=0, profiles=False)
    one = ranking.best.estimates["restitution"]
    assert abs(one.value - E) < 3 * one.stderr < 0.01
    assert "Only the restitution is measured" in ranking.verdict
    assert not any("lower limit" in said for said in ranking.best.degenerate)


def test_angles_alone_give_all_numbers_where_some_balls_slide_and_others_grip(tmp_path: Path) -> None:
    found = table(tmp_path, layout("angles"))
    rows, setting = usable_rows(found, Setting(RADIUS, KAPPA), spin=0.0)
    fit = fit_laws(rows, setting, ["contact"], bootstrap=0, profiles=False).best
    for parameter, true in (("restitution", E), ("friction", 0.15), ("tangential_restitution", BETA)):
        one = fit.estimates[parameter]
        assert abs(one.value - true) < 3 * one.stderr < 0.1, parameter
    # a speed is given in one row: an angle of the others
    mixed = table(tmp_path, "speed_in,incidence_deg,speed_out,reflection_deg,spin_in\n2,30,1.5,30,0\n2,30,,30,0\n")
    assert mixed["v_t_out"] == pytest.approx([0.75, 0.5])
    assert np.isnan(mixed["v_n_out"]).tolist() == [False, True]
    assert mixed.extra["unit_of_v_t_out"].tolist() == ["", "speed_out"]
    # with the ratio of the normal speeds the speed is known
    ratio = table(tmp_path, "incidence_deg,e_n,reflection_deg\n45,0.8,45\n30,0.8,20\n")
    assert ratio["v_t_out"][0] == pytest.approx(ratio["v_n_out"][0]) == pytest.approx(0.8 * 0.5**0.5)


def test_heights_are_speeds(tmp_path: Path) -> None:
    assert table(tmp_path, layout("heights"))["v_n_in"] == pytest.approx(drops(1)["v_n_in"], rel=1e-5)


def test_times_in_a_row_are_pairs_within_a_ball(tmp_path: Path) -> None:
    found = table(tmp_path, "ball,flight_time_s\n1,1.0\n1,0.8\n1,0.64\n2,0.5\n2,0.4\n")
    assert found["v_n_out"] / found["v_n_in"] == pytest.approx([0.8, 0.8, 0.8])
    assert found.extra["ball"].tolist() == ["1", "1", "2"]


def test_heights_in_a_row_are_pairs(tmp_path: Path) -> None:
    for text in ("bounce,height (cm)\n0,150\n1,96\n2,61.44\n", "height\n1.5\n0.96\n0.6144\n"):
        assert heads_rebounds(text)
        found = table(tmp_path, text)
        assert found["v_n_out"] / found["v_n_in"] == pytest.approx([0.8, 0.8])
        assert found["v_n_in"][0] == pytest.approx((2 * 9.80665 * 1.5) ** 0.5)
    assert not heads_rebounds("t [s],height [m]\n0,1\n0.1,0.9\n")
    # beside velocities a height is another one
    both = table(tmp_path, "v_n_in,v_n_out,spin_in,spin_out,height\n1,0.8,0,0,0.3\n")
    assert both["v_n_in"].tolist() == [1.0]


HEIGHTS = {
    "h": np.array([[1.0, 0.64, 0.3136, 0.2], [1.2, 0.769, 0.376, 0.25]]),
    "v": np.array([[4.0, 3.2, 2.24, 1.8], [5.0, 4.0, 2.8, 2.2]]),
}


@pytest.mark.parametrize("count", [2, 3, 4])
@pytest.mark.parametrize(
    ("kind", "unit", "names"),
    [
        ("h", 100, ["h0 (cm)", "h1 (cm)", "h2 (cm)", "h3 (cm)"]),
        ("h", 100, ["H_0 [cm]", "H_1 [cm]", "H_2 [cm]", "H_3 [cm]"]),
        ("h", 1, ["h₀", "h₁", "h₂", "h₃"]),
        ("h", 100, ["h0 in cm", "h1 in cm", "h2 in cm", "h3 in cm"]),
        ("h", 1000, ["height 0/mm", "height 1/mm", "height 2/mm", "height 3/mm"]),
        ("h", 100, ["drop height (cm)", "bounce 1 height (cm)", "bounce 2 height (cm)", "bounce 3 height (cm)"]),
        ("h", 100, ["initial_height_cm", "1st bounce (cm)", "2nd bounce (cm)", "3rd bounce (cm)"]),
        (
            "h",
            1,
            ["Release height", "Height after first bounce", "Height after second bounce", "Height after third bounce"],
        ),
        ("v", 1, ["v0", "v1", "v2", "v3"]),
        ("v", 100, ["speed 1 (cm/s)", "speed 2 (cm/s)", "speed 3 (cm/s)", "speed 4 (cm/s)"]),
        ("v", 3.6, ["v(0) [km/h]", "v(1) [km/h]", "v(2) [km/h]", "v(3) [km/h]"]),
    ],
)
def test_a_series_of_bounces_is_read_whole(
    tmp_path: Path, kind: str, unit: float, names: list[str], count: int
) -> None:
    values = HEIGHTS[kind][:, :count]
    text = "\n".join([";".join(names[:count]), *(";".join(map(repr, row)) for row in (values * unit).tolist())])
    assert heads_rebounds(text)
    found = table(tmp_path, text + "\n", kind="planar")
    speed = np.sqrt(2 * 9.80665 * values) if kind == "h" else values
    assert found["v_n_in"] == pytest.approx(speed[:, :-1].ravel())
    assert found["v_n_out"] == pytest.approx(speed[:, 1:].ravel())


def test_a_series_that_ends_early_has_error_bars_and_is_followed(tmp_path: Path) -> None:
    found = table(tmp_path, "ball,h0,h1,sigma_h1,h2\nA,1,0.64,0.01,\nB,1,0.64,0.01,0.4\n")
    assert found.extra["ball"].tolist() == ["A", "B", "B"]
    assert [found.extra[name].tolist() for name in ("drop", "bounce")] == [[1, 2, 2], [1, 1, 2]]
    assert found["sigma_v_n_out"][0] == found["sigma_v_n_in"][2] == pytest.approx(0.01 * 9.80665 / found["v_n_out"][0])


@pytest.mark.parametrize(
    ("text", "field"),
    [
        ("h0,h1,h3\n1,0.6,0.2\n", "columns 'h0', 'h1', 'h3'"),
        ("drop height,bounce 1 height,bounce 2 height\n1,0.6,0.61\n1,0.6,0.62\n", "columns height"),
        ("v0,v1,v2,theta0_deg,theta1_deg\n3,2,1,30,30\n", "columns speed"),
        ("incidence_deg,e_n,spin_in [rpm]\n30,0.7,100\n", "columns"),
        ("incidence_deg,reflection_deg,spin_out\n30,30,100\n", "columns"),
        ("incidence_deg,reflection_deg,speed_out\n30,30,2\n", "columns"),
        ("speed_in,incidence_deg,speed_out,spin_in\n3,30,2,0\n", "column 'speed_out'"),
        ("v_n_in,v_t_in,speed_out,spin_in\n3,1,2,0\n", "column 'speed_out'"),
        ("drop_height,speed_in,rebound_height\n1,4,0.5\n", "columns"),
    ],
)
def test_what_is_not_one_contact_a_row_is_refused(tmp_path: Path, text: str, field: str) -> None:
    with pytest.raises(CaromError) as caught:
        table(tmp_path, text)
    assert field in [fault.field for fault in caught.value.records]


def test_a_speed_beside_the_velocity_along_the_wall_gives_that_along_the_normal(tmp_path: Path) -> None:
    found = table(tmp_path, "speed_in,v_t_in,speed_out,v_t_out,spin_in\n5,4,2.5,1.5,0\n")
    assert [found[name].tolist() for name in ("v_n_in", "v_n_out")] == [[3.0], [2.0]]


def test_a_drop_height_with_the_time_of_flight_after_it(tmp_path: Path) -> None:
    found = table(tmp_path, "drop_height (cm),flight_time (s)\n60,0.52\n90,0.64\n")
    e = 9.80665 * np.array([0.52, 0.64]) / (2 * np.sqrt(2 * 9.80665 * np.array([0.6, 0.9])))
    assert found["v_n_out"] / found["v_n_in"] == pytest.approx(e)


@pytest.mark.parametrize("law", ["contact", "two-step"])
@pytest.mark.parametrize(
    "text",
    [
        "speed [km/h],incidence_deg\n36,30\n72,40\n",
        "speed,incidence_deg,spin_z_in\n5,30,2\n6,40,3\n",
        "v_n_in_mm_s,v_t_in_mm_s\n5000,1000\n6000,-2000\n",
        "velocity_x,velocity_y,spin_z\n-5,1,2\n-6,2,3\n",
        "v_n_in,v_t_in,spin_z_in\nmph,mph,rpm\n5,1,30\n6,1,30\n",
    ],
)
def test_what_predict_writes_is_read(tmp_path: Path, text: str, law: str) -> None:
    import carom

    source, out = tmp_path / "in.csv", tmp_path / "out.csv"
    source.write_text(text)
    numbers = {"restitution": 0.8} | ({"friction": 0.2} if law == "contact" else {"floor_friction": 0.2})
    made = carom.predict(source, law, **numbers)
    carom.predict(source, law, out=out, **numbers)
    in_air = any(name.startswith("spin_in") or name.startswith("spin_out") for name in made.columns)
    found = read_rebounds(out, stage=None if in_air else "after_wall")
    # (the same from components alone)
    x, out_x = (np.stack([found[f"v_n_{side}"], found[f"v_t_{side}"]], axis=-1) for side in ("in", "out"))
    spin = np.nan_to_num(found["spin_in" if in_air else "spin_z_in"])
    again = carom.predict(
        {"v_n_in": x[:, 0], "v_t_in": x[:, 1], "spin_in" if in_air else "spin_z_in": spin}, law, **numbers
    )
    assert out_x == pytest.approx(np.stack([again["v_n_out"], again["v_t_out"]], axis=-1))
    assert found["spin_out" if in_air else "spin_z_out"] == pytest.approx(again["spin_out" if in_air else "spin_z_out"])


def test_what_predict_writes_of_angles_is_read_where_components_are_left_out(tmp_path: Path) -> None:
    import carom

    made = carom.predict(
        {"speed": [5.0, 6.0], "incidence_deg": [30.0, 50.0], "spin_in": [0.0, 9.0]}, "contact", friction=0.2
    )
    names = ("speed", "incidence_deg", "spin_in", "speed_out", "reflection_out_deg", "spin_out")
    rows = zip(*(made[name].tolist() for name in names), strict=True)
    text = "speed,incidence_deg,spin_in,speed_out,reflection_out,spin_out\n"
    found = table(tmp_path, text + "\n".join(",".join(map(repr, row)) for row in rows) + "\n")
    assert found["v_n_out"] == pytest.approx(made["v_n_out"])
    assert found["v_t_out"] == pytest.approx(made["v_t_out"])


def test_what_tracks_write_is_read_and_used(tmp_path: Path) -> None:
    t = np.arange(40) / 200
    y = np.where(t < 0.1, 2 * (0.1 - t), 1.6 * (t - 0.1)) - 9.81 / 2 * (t - 0.1) ** 2
    ball = Track("ball", t, np.stack([0.5 * t, y], axis=-1))
    made = to_rebounds(measure([ball], Settings(view="side", noise=1e-4)))
    found = read_rebounds(made.save(tmp_path / "rebounds.csv"))
    assert (found.kind, found.notes, list(found.extra)) == ("planar", (), list(made.extra))
    for name, column in made.flat().items():
        assert np.array_equal(found.flat()[name].astype(str), column.astype(str)), name


@pytest.mark.parametrize("name", ["kharaz2001", "mathavan2009", "tt_rackets", "alciatore_tpb28"])
def test_a_copy_of_a_published_set_is_that_set(tmp_path: Path, name: str) -> None:
    from carom.data.datasets import load
    from carom.data.published import published_at, published_rebounds

    ours = published_at(load(name).to_csv(tmp_path / "copy.csv"))
    assert ours is not None
    assert ours.setting == published_rebounds(name).setting


def test_error_bars_in_cells_in_headers_and_in_per_cent(tmp_path: Path) -> None:
    text = "v_n_in,v_t_in,spin_in,v_n_out [m/s] ± 0.10,v_t_out,spin_out\n2,1,0,1.6,0.7 ± 2 %,10(2)\n3,1,0,2.4,0.8±0.05,20\n"
    found = table(tmp_path, text)
    assert found["sigma_v_n_out"] == pytest.approx([0.1, 0.1])
    assert found["sigma_v_t_out"] == pytest.approx([0.014, 0.05])
    assert found["sigma_spin_out"] == pytest.approx([2, 2])


def test_units_stand_in_the_row_below_the_names_of_any_layout(tmp_path: Path) -> None:
    """They were read as SI units in columns of other forms than components, such as speeds."""
    path = tmp_path / "below.tsv"
    path.write_text(
        "speed_in\tincidence\tspin_in\te_n\te_t\nkm/h\tdeg\trev/s\t-\t\n36\t60\t2\t0.8\t0.5\n36\t30\t2\t0.8\t0.5\n"
    )
    rows = read_rebounds(path)
    assert rows["v_n_in"] == pytest.approx([5.0, 10 * np.sqrt(0.75)])
    assert rows["v_n_out"] == pytest.approx(0.8 * rows["v_n_in"])
    assert rows["spin_in"] == pytest.approx(4 * np.pi)


def test_a_column_whose_error_bar_is_in_per_cent_is_no_column_in_per_cent(tmp_path: Path) -> None:
    path = tmp_path / "percent.csv"
    path.write_text("v_n_in,v_t_in,spin_in,v_n_out ± 2 %,v_t_out [m/s] ± 5%\n2,1,0,1.6,0.5\n4,1,0,3.2,0.5\n")
    rows = read_rebounds(path)
    assert rows["v_n_out"].tolist() == [1.6, 3.2]
    assert rows["sigma_v_n_out"] == pytest.approx([0.032, 0.064])
    assert rows["sigma_v_t_out"] == pytest.approx(0.025)


def test_spins_alone_are_refused_with_what_they_lack(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "spins.csv"
    path.write_text("spin_in,spin_out\n10,20\n20,30\n0,12\n")
    said = " ".join(fails(capsys, "fit", str(path), "--radius", "0.033"))
    assert "friction (1 + restitution)" in said
    assert "v_n_in" in said


def test_a_column_of_ratios_beside_components_is_passed_on(tmp_path: Path) -> None:
    found = table(tmp_path, "v_n_in,v_t_in,spin_in,v_n_out,e\n2,1,0,1.6,0.8\n3,1,0,2.4,0.8\n")
    assert found.extra["e"].tolist() == ["0.8", "0.8"]
    heights = table(tmp_path, "h0 (cm),h1 (cm),h2 (cm),COR\n100,64,36,0.8\n100,64,36,0.8\n")
    assert len(heights) == 4
    assert heights.extra["COR"].tolist() == ["0.8"] * 4


def test_numbers_under_an_unknown_name_are_not_passed_over_in_silence(tmp_path: Path) -> None:
    text = "incidence_deg,reflection_deg,err_percent,angle,theta,shot,speed\n30,25,2,30,,1,slow\n40,33,2,40,,2,fast\n"
    (note,) = [one for one in table(tmp_path, text.replace("speed", "speed class")).notes if "not read" in one]
    assert note.startswith("not read: 'err_percent', 'angle'; names that are read")
    (note,) = [
        one for one in table(tmp_path, "v_n_in,v_n_out,spin_in,mu,sigma_t\n2,1.6,0,0.8,1\n").notes if "not read" in one
    ]
    assert note.startswith("not read: 'mu';")


def test_a_header_tells_a_table_of_rebounds_from_a_track() -> None:
    assert heads_rebounds("drop_height_cm;rebound_height_cm\n")
    assert not heads_rebounds("t,x,y\n")
    assert not heads_rebounds("frame,vx,vy,speed\n")


def test_a_stage_is_chosen_and_not_put_on_other_rows(tmp_path: Path) -> None:
    text = "v_n_in,v_t_in,v_n_out,v_t_out,stage\n1,0.5,0.9,0.4,after_wall\n1,0.5,0.6,0.4,rolling\n"
    found = table(tmp_path, text, stage="rolling")
    assert found["v_n_out"].tolist() == [0.6]
    assert any("others are left out" in note for note in found.notes)


def test_a_height_below_the_floor_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "heights.csv"
    path.write_text("drop_height_cm,rebound_height_cm\n100,50\n200,-10\n300,150\n400,200\n")
    assert "column 'rebound_height': expected heights of at least 0, got -0.1 m" in " ".join(
        fails(capsys, "fit", str(path), "--radius", "0.033")
    )


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("vx_in [furlong],vy_in,vx_out,vy_out\n1,1,-1,1\n", "column 'vx_in [furlong]': expected a unit, one of m/s"),
        (
            "v_n_in,v_n_out,spin_in\n1,0.6 ± 1e999,0\n",
            "v_n_out: expected an error bar that is a finite number, got inf at",
        ),
        ("angle_in_deg,angle_out_deg\n", "rebounds.csv: expected rebounds, got none"),
        ("angle,e,e_t\n30,0.8,0.7\n40,0.8,0.7\n", "column 'e_t': expected v_t_in, or an angle of incidence, beside it"),
        (
            "v_n_in,v_n_out ± 1e999,spin_in\n1,0.6,0\n",
            "v_n_out ± 1e999: expected an error bar that is a finite number, got",
        ),
    ],
)
def test_a_fault_is_one_line(tmp_path: Path, text: str, line: str) -> None:
    file = tmp_path / "rebounds.csv"
    file.write_text(text)
    with pytest.raises(CaromError) as caught:
        read_rebounds(file)
    (fault,) = str(caught.value).splitlines()
    assert line in fault


@pytest.mark.parametrize(
    "header", ["COR, v (m/s)", "COR,v_n [m/s]", "e,velocity [m/s]", "Coefficient of restitution,Impact velocity (cm/s)"]
)
def test_restitution_against_speed_is_read_as_it_is_published(tmp_path: Path, header: str) -> None:
    file = tmp_path / "published.csv"
    file.write_text(f"{header}\n0.9,1\n0.8,2\n", encoding="utf-8")
    found = read_rebounds(file)
    speed = np.array([1.0, 2.0]) * (0.01 if "cm/s" in header else 1.0)
    np.testing.assert_allclose(found["v_n_in"], speed)
    np.testing.assert_allclose(found["v_n_out"], speed * [0.9, 0.8])
