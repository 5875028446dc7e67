"""Tables of rebounds: read, checked with all faults at once, written so that they read back as themselves."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from carom.data.rebound_files import read_rebounds
from carom.data.rebounds import COLUMNS, Rebounds, make_rebounds
from carom.errors import CaromError
from carom.fitting import Setting, fit_laws
from carom.tracks.films import is_track

PLANAR = "v_n_in,v_t_in,spin_in,v_n_out,v_t_out,spin_out"
TABLE = "v_n_in,v_t_in,spin_z_in,v_n_out,v_t_out,spin_z_out,stage"


def put(folder: Path, text: str, encoding: str = "utf-8") -> Path:
    file = folder / "rebounds.csv"
    file.write_bytes(text.encode(encoding))
    return file


def faults(folder: Path, text: str, **options: str) -> list[str]:
    with pytest.raises(CaromError) as error:
        read_rebounds(put(folder, text), **options)  # type: ignore[arg-type]
    return list(error.value.faults)


def same(one: Rebounds, other: Rebounds) -> None:
    assert one.kind == other.kind
    assert list(one.flat()) == list(other.flat())
    for name, column in one.flat().items():
        np.testing.assert_array_equal(column, other.flat()[name])


def test_missing_columns_are_listed_with_those_found(tmp_path: Path) -> None:
    (fault,) = faults(tmp_path, "v_t_in,speed_out,spin_in,v_n_out\n1,2,0,1\n")
    expected = "column 'v_n_in': expected this column for a planar bounce, got v_t_in, spin_in, v_n_out, speed_out"
    assert fault.endswith(expected)


def test_planar(tmp_path: Path) -> None:
    found = read_rebounds(put(tmp_path, f"{PLANAR},sigma_v_n_out\n1.5,0.5,,1.2,0.4,12.5,0.01\n2,1,3,1.5,0.9,,0.02\n"))
    assert found.kind == "planar"
    assert len(found) == 2
    assert found["v_n_in"].tolist() == [1.5, 2.0]
    assert np.isnan(found["spin_in"][0])
    assert found["sigma_v_n_out"].tolist() == [0.01, 0.02]
    assert found.angle_in[0] == pytest.approx(np.arctan2(0.5, 1.5))
    assert found.rows == ("line 2", "line 3")


def test_table_with_extras_and_units(tmp_path: Path) -> None:
    text = "shot;v_n_in [mm/s];v_t_in_cm_s;spin_z_in (rpm);v_n_out;v_t_out;stage\n7;1500,5;50;60;1,2;0,4;rolling\n"
    found = read_rebounds(put(tmp_path, text, "utf-8-sig"))
    assert found.kind == "table"
    assert found["v_n_in"][0] == 1.5005
    assert found["v_t_in"][0] == 0.5
    assert found["spin_z_in"][0] == pytest.approx(2 * np.pi)
    assert np.isnan(found["spin_z_out"][0])
    assert found.stage is not None
    assert found.stage.tolist() == ["rolling"]
    assert found.extra["shot"].tolist() == ["7"]


@pytest.mark.parametrize("ending", [".csv", ".parquet"])
def test_what_is_written_reads_back(tmp_path: Path, ending: str) -> None:
    rng = np.random.default_rng(1)
    columns = {name: rng.uniform(0.1, 3, 50) for name in COLUMNS["table"]}
    columns |= {f"sigma_{name}": rng.uniform(0.01, 0.1, 50) for name in COLUMNS["table"]}
    columns["spin_z_in"][::3] = np.nan
    columns["sigma_spin_z_in"][::3] = np.nan
    made = make_rebounds("table", columns, stage=["after_wall", "rolling"] * 25,
                         extra={"wall": np.array(["x = 0, left"] * 50)})  # fmt: skip
    file = made.save(tmp_path / f"out{ending}")
    same(made, read_rebounds(file))
    assert [path.name for path in tmp_path.iterdir()] == [file.name]


def test_line_ends_and_rows_picked(tmp_path: Path) -> None:
    found = read_rebounds(put(tmp_path, f"{PLANAR}\r\n1,0,0,1,0,0\r\n2,0,0,1,0,0\r\n3,0,0,1,0,0\r\n"))
    assert found.select(found["v_n_in"] > 1.5).rows == ("line 3", "line 4")
    assert found.select([2, 0])["v_n_in"].tolist() == [3.0, 1.0]


def test_only_normal_speeds_are_square_on(tmp_path: Path) -> None:
    file = put(tmp_path, "v_n_in_m_s,v_n_out_m_s\n0.269,0.233\n")
    found = read_rebounds(file, kind="table", stage="rolling")
    assert found["v_t_out"].tolist() == [0.0]
    assert "normal incidence" in found.notes[0]


def test_the_kind_is_asked_for(tmp_path: Path) -> None:
    (fault,) = faults(tmp_path, "v_n_in,v_n_out\n1,1\n")
    assert "`kind` planar or table" in fault
    (fault,) = faults(tmp_path, "v_n_in,v_n_out,spin_z_in\n1,1,0\n")
    assert "`stage`" in fault


def test_all_faults_at_once(tmp_path: Path) -> None:
    text = (
        f"{TABLE},sigma_v_n_in,sigma_v_t_in [furlong]\n"
        "1,nan,0,1,0,0,rolling,0.1,1\n-1,0,0,1,0,inf,after,0,1\n1,0,x,1,0,0,rolling,0.1,1\n"
    )
    found = faults(tmp_path, text)
    expected = [
        ("sigma_v_t_in [furlong]", "expected a unit"),
        ("spin_z_in", "got 'x' at line 4"),
        ("v_t_in", "got an empty cell at line 2"),
        ("spin_z_out", "got inf at line 3"),
        ("sigma_v_n_in", "above 0, got 0.0 at line 3"),
        ("v_n_in", "toward the wall, above 0, got -1.0 at line 3"),
        ("stage", "got 'after' at line 3"),
    ]
    for field, what in expected:
        assert sum(field in fault and what in fault for fault in found) == 1, (field, found)
    assert len(found) == len(expected)


def test_missing_and_doubled_columns(tmp_path: Path) -> None:
    found = faults(tmp_path, "v_n_in,spin_in,v_t_out,v_n_out,vn_out\n1,1,1,1,1\n")
    assert any("'v_t_in'" in fault for fault in found)
    assert any("expected one column for v_n_out" in fault for fault in found)
    (fault,) = faults(tmp_path, "v_n_in,v_n_out,spin_in,spin_z_in,stage\n1,1,1,1,rolling\n")[:1]
    assert "got spin_in, spin_z_in" in fault


def test_units_in_cells_and_rows_too_wide(tmp_path: Path) -> None:
    (fault,) = faults(tmp_path, f"{PLANAR}\n1 m/s,0,0,1,0,0\n")
    assert "'1 m/s' at line 2; write units in the header" in fault
    (fault,) = faults(tmp_path, f"{PLANAR}\n1,0,0,1,0,0,9\n")
    assert "expected 6 fields" in fault
    assert fault.endswith("a comma within a number: write a decimal point there, and no comma before thousands")


def test_a_mistyped_number_is_one_fault(tmp_path: Path) -> None:
    (fault,) = faults(
        tmp_path, "speed_in,incidence_deg,speed_out,reflection_deg,spin_out\n2O,30,9,31,4\n20,3l,9,31,n.a.\n"
    )[:1]
    assert fault.endswith("speed_in: expected a number, got '2O' at line 2; it has a letter in place of a digit: '20'?")
    found = faults(
        tmp_path, "speed_in,incidence_deg,speed_out,reflection_deg,spin_out\n2O,30,9,31,4\n20,3l,9,31,n.a.\n"
    )
    assert [fault.split(": ")[1] for fault in found] == ["speed_in", "incidence_deg"]


def test_columns_before_and_after(tmp_path: Path) -> None:
    table = "speed {0},angle {0} [deg],spin {0},speed {1},angle {1} [deg],spin {1}\n"
    one, two = (
        read_rebounds(put(tmp_path, table.format(*names).replace("spin", "spin_y") + "2,30,0,1.5,20,9\n"))
        for names in (("before", "after"), ("in", "out"))
    )
    assert {name: column.tolist() for name, column in one.columns.items()} == {
        name: column.tolist() for name, column in two.columns.items()
    }


def test_a_spin_in_an_unknown_unit_is_one_fault(tmp_path: Path) -> None:
    (fault,) = faults(tmp_path, "v_n_in,v_t_in,spin_out [U/min],v_n_out\n1,1,1,1\n")
    assert "expected a unit, one of rad/s, deg/s, rpm, rev/s, got 'U/min'" in fault


def test_mixed_units_are_remarked(tmp_path: Path) -> None:
    found = read_rebounds(put(tmp_path, "v_n_in,v_t_in,v_n_out,v_t_out,stage\n1.5,0.5,1200,400,rolling\n"))
    assert any("mixed units?" in note for note in found.notes)
    found = read_rebounds(put(tmp_path, "v_n_in,v_t_in,v_n_out,v_t_out,stage\n1.5,0.5,1.2,0.4,rolling\n"))
    assert not any("mixed units?" in note for note in found.notes)


@pytest.mark.filterwarnings("error")
def test_the_smallest_speed_and_the_smallest_error_bar_give_no_warnings_of_numpy() -> None:
    """1e-320 m/s: a quotient by it overflows, its square is 0. It is no speed; 1e-90 m/s is the first that is one."""
    rng = np.random.default_rng(1)
    v_n, v_t = rng.uniform(1, 3, 20), rng.uniform(-1, 1, 20)
    columns = {"v_n_in": v_n.copy(), "v_t_in": v_t, "spin_in": 0.0, "v_n_out": 0.8 * v_n, "v_t_out": 0.9 * v_t}
    columns |= {"sigma_v_n_out": np.full(20, 0.01), "sigma_v_t_out": np.full(20, 0.01)}
    columns["v_n_in"][3] = 1e-320
    with pytest.raises(CaromError, match="v_n_in: expected a speed toward the wall, above 0, got 1e-320"):
        make_rebounds("planar", columns)
    columns["v_n_in"][3] = 1e-90
    found = make_rebounds("planar", columns)
    assert "restitution above 1" in " ".join(found.notes)
    columns["v_n_in"][3], columns["sigma_v_t_out"][5] = v_n[3], 1e-320
    fit_laws(make_rebounds("planar", columns), Setting(radius=0.02), ["contact"], bootstrap=0)


def test_nothing_to_read(tmp_path: Path) -> None:
    with pytest.raises(CaromError, match="No such file"):
        read_rebounds(tmp_path / "none.csv")
    assert "expected rebounds, got none" in faults(tmp_path, f"{PLANAR}\n")[0]
    assert "empty file" in faults(tmp_path, "")[0]


def test_encodings(tmp_path: Path) -> None:
    text = f"{PLANAR},Größe\n1.5,0.5,,1.2,0.4,12.5,ä\n"
    plain = read_rebounds(put(tmp_path, text))
    assert plain.extra["Größe"].tolist() == ["ä"]
    for encoding in ("utf-8-sig", "utf-16"):
        same(read_rebounds(put(tmp_path, text, encoding)), plain)


def test_a_ball_that_hardly_comes_off_is_not_a_fault() -> None:
    columns = {"v_n_in": [1.0], "v_t_in": [0.0], "v_n_out": [-0.02], "v_t_out": [0.0]}
    make_rebounds("table", columns | {"sigma_v_n_out": [0.01]}, stage="rolling")
    with pytest.raises(CaromError, match="within 3 sigma"):
        make_rebounds("table", columns | {"sigma_v_n_out": [0.005]}, stage="rolling")


def test_datasets_of_carom_are_rebound_tables() -> None:
    from carom.data.datasets import load

    snooker = read_rebounds(load("mathavan2009").path, kind="table", stage="rolling")
    assert len(snooker) == 30
    rackets = read_rebounds(load("tt_rackets").path)
    assert rackets.kind == "planar"
    assert rackets["spin_in"][0] == 147.25
    assert rackets.extra["racket"][0] == "10_antispin"


@pytest.mark.parametrize(
    ("text", "encoding"),
    [
        ("v_n_in,v_t_in,spin_in,v_n_out\n3.0,\u22121.25,0,2.4\n", "utf-8"),
        ("v_n_in,v_t_in,spin_in,v_n_out\n3.0,\u20131.25,0,2.4\n", "cp1252"),
        ('v_n_in, v_t_in, spin_in, v_n_out\n"3,0", "\u22121,25", "0", "2,4"\n', "utf-8"),
        ("sep=;\nv_n_in;v_t_in;spin_in;v_n_out\n3,0;-1,25;0;2,4\n", "utf-8-sig"),
        ("v_n_in,v_t_in,spin_in,v_n_out\nm/s,m/s,rad/s,m/s\n3.0,-1.25,0,2.4\n", "utf-8"),
        (
            "v_n_in;v_t_in;spin_in;v_n_out\n\u0663\u066b\u0660;\u061c-\u0661\u066b\u0662\u0665;\u0660;\u0662\u066b\u0664\n",
            "utf-8",
        ),
    ],
)
def test_numbers_and_headers_of_spreadsheets_in_any_language(tmp_path: Path, text: str, encoding: str) -> None:
    path = tmp_path / "rebounds.csv"
    path.write_bytes(text.encode(encoding))
    found = read_rebounds(path)
    assert [found[name].tolist() for name in ("v_n_in", "v_t_in", "spin_in", "v_n_out")] == [
        [3.0],
        [-1.25],
        [0.0],
        [2.4],
    ]


def test_a_comma_that_may_separate_thousands_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "rebounds.csv"
    path.write_text('v_n_in [mm/s],v_t_in [mm/s],spin_in,v_n_out [mm/s]\n"3,000","-1,250",0,"2,400"\n')
    with pytest.raises(
        CaromError, match="may be a decimal sign or separate thousands: write numbers with a decimal point"
    ):
        read_rebounds(path)


def test_angles_under_another_name_are_no_speeds_along_the_normal(tmp_path: Path) -> None:
    said = faults(tmp_path, "v_in,v_out,alpha (deg)\n5,4,20\n6,5,30\n", kind="planar")
    assert "column 'alpha (deg)': expected a name of an angle that is read" in said[0]
    found = read_rebounds(put(tmp_path, "v1,v2,theta1 [deg],theta2 [deg]\n5,4,20,21\n6,5,30,31\n"), kind="planar")
    assert found["v_t_in"] == pytest.approx(np.array([5, 6]) * np.sin(np.radians([20, 30])))


@pytest.mark.parametrize(
    "above", ["Table 2. Tennis balls", "# filmed by hand\n# e_n, in water", "Racket, ball\n\n# cold", '"Balls', "#"]
)
def test_a_title_and_comments_may_stand_above_the_header(tmp_path: Path, above: str) -> None:
    file = put(tmp_path, f"{above}\nincidence_deg;e_n\n30;0,8\n60;0,7\n")
    assert not is_track(file)
    found = read_rebounds(file, kind="planar")
    assert found.rows[0] == f"line {above.count(chr(10)) + 3}"
    assert (found["v_n_out"] / found["v_n_in"]).tolist() == pytest.approx([0.8, 0.7])


def test_a_header_as_numpy_writes_it_is_no_comment(tmp_path: Path) -> None:
    columns = {"v_n_in": [1.0, 2.0], "v_t_in": [0.5, 0.6], "v_n_out": [0.8, 1.6], "spin_in": [0.0, 0.0]}
    file = tmp_path / "saved.csv"
    np.savetxt(file, np.transpose(list(columns.values())), header=",".join(columns), delimiter=",")
    assert read_rebounds(file)["v_n_out"].tolist() == columns["v_n_out"]
    numbered = put(tmp_path, "#,v_n_in,v_t_in,v_n_out,spin_in\n1,1,0.5,0.8,0\n")
    assert read_rebounds(numbered).extra["#"].tolist() == ["1"]
