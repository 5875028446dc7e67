"""`carom predict`: tables in every shape, and rows that are at fault."""

from __future__ import annotations

import csv
import errno
import json
import math
import os
import sys
from pathlib import Path

import numpy as np
import pytest

import carom
from carom.cli import main
from carom.data import PredictSettings, predict_table
from carom.data import table_files as text
from carom.data.headers import parse_header
from carom.files import atomic_file
from carom.laws.registry import find_law

BALL = carom.Ball()
WALL = carom.Surface(0.8, 0.2)
FLOOR = carom.Surface(0.0, 0.3)
GIVEN = {"restitution": 0.8, "friction": 0.2, "floor_friction": 0.3}
SURFACES = ("--restitution", "0.8", "--friction", "0.2", "--floor-friction", "0.3")


class Ran:
    def __init__(self, code: int, out: str, err: str) -> None:
        self.code, self.out, self.err = code, out, err


@pytest.fixture
def carom_run(monkeypatch, capsys):
    def run(*args: object) -> Ran:
        monkeypatch.setattr(sys, "argv", ["carom", *map(str, args)])
        with pytest.raises(SystemExit) as end:
            main()
        captured = capsys.readouterr()
        return Ran(int(end.value.code or 0), captured.out, captured.err)

    return run


def write(path: Path, content: str | bytes) -> Path:
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


def predict(tmp_path: Path, content: str | bytes, law: str = "two-step", *, strict: bool = False, **settings):
    """Rows of the answer as dictionaries, and the summary."""
    source, out = write(tmp_path / "in.csv", content), tmp_path / "out.csv"
    settings = {"given": GIVEN, **settings}
    summary = predict_table(source, out, PredictSettings(find_law(law), **settings), strict=strict)
    with out.open(encoding="utf-8-sig", newline="") as file:
        return list(csv.DictReader(file)), summary


def faults(tmp_path: Path, content: str | bytes, law: str = "two-step", **settings) -> tuple[str, ...]:
    with pytest.raises(carom.CaromError) as caught:
        predict(tmp_path, content, law, **settings)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["in.csv"]  # nothing written, nothing left over
    return caught.value.faults


def numbers(row: dict[str, str], *names: str) -> list[float]:
    return [float(row[name]) for name in names]


# --- the forms ------------------------------------------------------------------------------------------------------


def test_vector_form_is_the_library_bit_for_bit(tmp_path):
    rng = np.random.default_rng(1)
    n = 60
    velocity = np.stack([-rng.uniform(0.1, 3, n), rng.normal(size=n), np.zeros(n)], axis=-1)
    spin = rng.normal(scale=20, size=(n, 3))
    head = "label,velocity_x,velocity_y,velocity_z,spin_x,spin_y,spin_z"
    lines = [",".join([f"s{i}", *map(repr, velocity[i].tolist()), *map(repr, spin[i].tolist())]) for i in range(n)]
    rows, summary = predict(tmp_path, "\n".join([head, *lines]) + "\n")
    two = carom.two_step(BALL, carom.State(velocity, spin), wall=WALL, floor=FLOOR)
    assert [row["label"] for row in rows] == [f"s{i}" for i in range(n)]
    assert summary.rows == n
    for i, row in enumerate(rows):
        assert numbers(row, *(f"velocity_{k}_out" for k in "xyz")) == two.after_wall.velocity[i].tolist()
        assert numbers(row, *(f"spin_{k}_out" for k in "xyz")) == two.after_wall.spin[i].tolist()
        if two.rolls[i]:
            assert numbers(row, *(f"velocity_{k}_rolling" for k in "xyz")) == two.rolling.velocity[i].tolist()
            assert numbers(row, *(f"spin_{k}_rolling" for k in "xyz")) == two.rolling.spin[i].tolist()
        else:
            assert row["velocity_x_rolling"] == ""
            assert row["note"] == two.why[i]
    assert summary.answered == int(two.rolls.sum())


def test_bounce_form_on_a_table(tmp_path):
    rows, _ = predict(tmp_path, "v_n_in,v_t_in,spin_z_in\n1.5,0.5,3\n")
    two = carom.two_step(BALL, carom.rolling(BALL, (-1.5, 0.5), 3.0), wall=WALL, floor=FLOOR)
    v, w, r = two.after_wall.velocity, two.after_wall.spin, two.rolling
    got = numbers(rows[0], "v_n_out", "v_t_out", "v_z_out", "spin_n_out", "spin_t_out", "spin_z_out")
    assert got == [*v.tolist(), *w.tolist()]
    got = numbers(rows[0], "v_n_rolling", "v_t_rolling", "spin_z_rolling")
    assert got == [r.velocity[0], r.velocity[1], r.spin[2]]


def test_planar_bounce_of_a_ball_in_flight(tmp_path):
    # slip is v_t - a spin: 2 - 0.02 * 50 = 1; it slides with mu = 0.2, e = 0.8, so v_t falls by mu (1+e) v_n = 0.36
    given = {"restitution": 0.8, "friction": 0.2, "radius": 0.02, "kappa": 2 / 3}
    rows, _ = predict(tmp_path, "v_n_in,v_t_in,spin_in\n1,2,50\n", "contact", given=given)
    got = numbers(rows[0], "v_n_out", "v_t_out", "spin_out")
    assert got == pytest.approx([0.8, 1.64, 50 + 0.36 / (2 / 3 * 0.02)], rel=1e-14)
    assert "v_n_rolling" not in rows[0]


def test_empty_spins_are_0_at_the_first_bounce_and_unknown_later(tmp_path):
    given = {"restitution": 0.8, "friction": 0.2, "radius": 0.02, "kappa": 2 / 3}
    for spin in (None, "none"):
        rows, summary = predict(
            tmp_path,
            "bounce,v_n_in,v_t_in,spin_in\n1,1,2,\n2,1,2,\n2,1,2,50\nlast,1,2,\n",
            "contact",
            given=given,
            spin=spin,
        )
        assert [row["v_t_out"] != "" for row in rows] == [True, False, True, True]
        assert numbers(rows[0], "v_t_out") == pytest.approx([1.64])
        assert "spin before bounce 2: expected a number" in rows[1]["note"]
        assert "spin_in: 3 empty cells taken as 0, but for later bounces, whose spin is unknown" in summary.notes
        (tmp_path / "out.csv").unlink()
    mirror = predict(
        tmp_path, "bounce,v_n_in,v_t_in,spin_in\n1,1,2,\n2,1,2,\n2,1,2,9\n", "mirror", given={"restitution": 0.8}
    )
    assert [row["v_n_out"] for row in mirror[0]] == ["0.8"] * 3  # (which needs no spin)
    assert [row["note"] for row in mirror[0]] == [""] * 3
    assert [row["spin_out"] for row in mirror[0]] == ["0.0", "", "9.0"]
    (tmp_path / "out.csv").unlink()
    rows, _ = predict(tmp_path, "bounce,v_n_in,v_t_in\n1,1,2\n2,1,2\n", "contact", given=given)
    assert [row["v_t_out"] != "" for row in rows] == [True, False]
    (tmp_path / "out.csv").unlink()
    rows, summary = predict(tmp_path, "v_n_in,v_t_in,spin_z_in\n1,2,\n", given=given)
    assert rows[0]["v_n_out"]
    assert "spin_z_in: 1 empty cell taken as 0" in summary.notes
    (tmp_path / "out.csv").unlink()
    with pytest.raises(carom.CaromError, match="`spin` rolling"):
        predict(tmp_path, "v_n_in,v_t_in,spin_in\n1,2,\n", "contact", given=given, spin="rolling")


def test_angle_form_with_speed_from_an_option(tmp_path):
    content = "incidence_from_normal_deg\n60\n"
    rows, _ = predict(tmp_path, content, "contact", given={"restitution": 0.98, "friction": 0.09, "speed": 3.9})
    vn, vt = 3.9 * math.cos(math.pi / 3), 3.9 * math.sin(math.pi / 3)
    un, ut = 0.98 * vn, vt - 0.09 * 1.98 * vn
    got = numbers(rows[0], "v_n_out_m_s", "v_t_out_m_s", "speed_out_m_s", "reflection_out_deg")
    assert got == pytest.approx([un, ut, math.hypot(un, ut), math.degrees(math.atan2(ut, un))], rel=1e-14)


def test_a_title_and_a_row_of_units_are_read_and_kept(tmp_path):
    content, out = "speed [km/h],incidence [deg],spin_in [rpm]\n36,20,10\n18,30,20\n", tmp_path / "out.csv"
    predict(tmp_path, content, "contact", given=GIVEN)
    plain = out.read_text()
    out.unlink()
    title = "Throws, of Tuesday\n# indoors\n"
    below = content.replace(" [km/h]", "").replace(" [deg]", "").replace(" [rpm]\n", "\nkm/h,deg,rpm\n")
    predict(tmp_path, title + below, "contact", given=GIVEN)
    assert out.read_text() == title + plain


def test_parameters_by_row_and_an_option_that_wins(tmp_path):
    content = "v_n_in,v_t_in,restitution,kappa,friction\n1,0.5,0.5,0.4,0.1\n1,0.5,0.9,0.6,0.3\n"
    rows, _ = predict(tmp_path, content, given={"friction": 0.2})
    for row in rows:
        ball = carom.Ball(inertia=float(row["kappa"]))
        wall = carom.Surface(float(row["restitution"]), 0.2)
        two = carom.two_step(ball, carom.rolling(ball, (-1.0, 0.5)), wall=wall)
        assert numbers(row, "v_n_rolling", "v_t_rolling") == two.rolling.velocity[:2].tolist()


def test_normals_by_row_and_a_cushion_above_the_centre(tmp_path):
    content = "velocity_x,velocity_y,normal_x,normal_y\n-1,0,2,0\n0,1,0,-3\n"
    rows, _ = predict(tmp_path, content, contact_height=1.4)
    n = (math.sqrt(1 - 0.4**2), 0.0, -0.4)
    two = carom.two_step(BALL, carom.rolling(BALL, (-1.0, 0.0)), wall=WALL, floor=FLOOR, normal=n)
    assert float(rows[0]["velocity_x_out"]) == pytest.approx(two.after_wall.velocity[0], rel=1e-12)
    assert float(rows[1]["velocity_y_out"]) == pytest.approx(-two.after_wall.velocity[0], rel=1e-12)


def test_spin_nobody_measured(tmp_path):
    content = "v_n_in,v_t_in\n1,0.7\n"
    rolls, summary = predict(tmp_path, content)
    none, _ = predict(tmp_path, content, spin="none")
    two = carom.two_step(BALL, carom.State((-1.0, 0.7, 0.0)), wall=WALL, floor=FLOOR)
    assert float(none[0]["v_t_rolling"]) == two.rolling.velocity[1]
    assert rolls[0]["v_t_rolling"] != none[0]["v_t_rolling"]
    assert any("taken to roll" in note for note in summary.notes)
    rows, _ = predict(tmp_path, "velocity_x,velocity_y,velocity_z\n-1,0,0.1\n-1,0,0\n")
    assert "velocity_z: expected 0 for a ball that is taken to roll" in rows[0]["note"]
    assert rows[1]["note"] == ""


# --- headers and units ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("header", "quantity", "si"),
    [
        ("velocity_x [mm/s]", "velocity_x", 0.5), ("v_n_in_m_s", "v_n_in", 500.0), ("V_N_IN", "v_n_in", 500.0),
        ("incidence_from_normal_deg", "incidence", math.radians(500)), ("theta_in_deg_derived", "incidence", math.radians(500)),
        ("spin_y_in_rpm", "spin_in", 500 * 2 * math.pi / 60), ("radius (mm)", "radius", 0.5), ("mass_g", "mass", 0.5),
        ("vx", "velocity_x", 500.0), ("Spin Z in [rad s^-1]", "spin_z_in", 500.0),
    ],
)  # fmt: skip
def test_headers(header, quantity, si):
    found = parse_header(header)
    assert found.quantity == quantity
    assert found.unit.to_si(500.0) == pytest.approx(si, rel=1e-15)


@pytest.mark.parametrize(
    "header", ["v_n_out_m_s", "velocity", "shot", "v_n_in_sigma", "u_digit_v_in", "marker", "speedy"]
)
def test_headers_that_pass_through(header):
    assert parse_header(header) is None


def test_units_go_out_as_they_came_in(tmp_path):
    rows, _ = predict(tmp_path, "velocity_x [mm/s],velocity_y [mm/s],mass [g]\n-1000,500,140.6\n", "mirror")
    assert numbers(rows[0], "velocity_x_out [mm/s]", "velocity_y_out [mm/s]") == [800.0, 500.0]
    assert "spin_x_out [rad/s]" in rows[0]


def test_unknown_units_and_angles_without_one(tmp_path):
    assert (
        "'velocity_x [furlong/s]': expected a unit, one of m/s"
        in faults(tmp_path, "velocity_x [furlong/s],velocity_y\n1,2\n")[0]
    )
    assert "as in 'incidence_deg'" in faults(tmp_path, "speed,incidence\n1,2\n")[0]


def test_measured_columns_are_kept_apart(tmp_path):
    rows, _ = predict(tmp_path, "v_n_in_m_s,v_n_out_m_s,note\n1,0.7,x\n")
    assert rows[0]["v_n_out_m_s"] == "0.7"
    assert rows[0]["note"] == "x"
    assert float(rows[0]["v_n_out_predicted_m_s"]) > 0
    assert rows[0]["note_predicted"] == ""
    again = (tmp_path / "out.csv").read_text()
    (tmp_path / "out.csv").unlink()
    assert "`suffix`" in faults(tmp_path, again)[0]
    rows, _ = predict(tmp_path, again, suffix="mirror", law="mirror")
    assert rows[0]["v_n_out_mirror_m_s"] == "0.8"


def test_missing_columns_are_named_with_the_nearest(tmp_path):
    assert faults(tmp_path, "velocity_x,velocty_y\n1,2\n") == (
        "column 'velocity_y': expected this column for the vector form, got none; rename 'velocty_y'",
    )
    assert "rename 'v_n_inn'" in faults(tmp_path, "v_n_inn,other\n1,2\n")[0]
    assert "'spin_y': expected this column beside 'spin_x'" in faults(tmp_path, "vx,vy,spin_x\n1,2,3\n")[0]


def test_all_faults_of_a_header_at_once(tmp_path):
    found = faults(tmp_path, "v_t_in,v_t_in_mm_s,spin_in,spin_z_in\n1,2,3,4\n")
    assert len(found) == 1  # two columns for one thing: nothing else can be said
    assert "expected one column for v_t_in, got 2" in found[0]
    found = faults(tmp_path, "v_t_in,spin_in,spin_z_in\n1,2,3\n", contact_height=2.5, given={"radius": -1.0})
    assert [one.split(":")[0] for one in found] == [
        "column 'v_n_in'",
        "`contact_height`",
        "columns",
        "`radius`",
        "`contact_height`",
    ]


# --- CSV as it comes ------------------------------------------------------------------------------------------------


def test_every_byte_of_the_table_is_kept(tmp_path):
    head = '\ufeff"a ""quoted"", header",v_n_in,text,text\r\n'
    body = '1,+1.50e0,"x\r\ny",\udce9\r\n"2", 2 ,,\r\n'
    content = (head + body).encode("utf-8", "surrogateescape")
    source, out = write(tmp_path / "in.csv", content), tmp_path / "out.csv"
    summary = predict_table(source, out, PredictSettings(find_law("mirror")))
    lines = out.read_bytes()
    assert summary.answered == 2
    assert lines.startswith(b'\xef\xbb\xbf"a ""quoted"", header",v_n_in,text,text,v_n_out')
    assert b'\r\n1,+1.50e0,"x\r\ny",\xe9,1.5,' in lines
    assert b'\r\n"2", 2 ,,,2.0,' in lines
    assert lines.count(b"\n") == lines.count(b"\r\n") == 4


@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_line_ends_blank_lines_and_no_last_end(tmp_path, end):
    rows, summary = predict(tmp_path, end.join(["v_n_in", "", "1", "", "2", "", "3"]), "mirror")
    assert [row["v_n_in"] for row in rows] == ["1", "2", "3"]
    assert summary.answered == 3
    assert (tmp_path / "out.csv").read_bytes().count(end.encode()) == 4


def test_semicolons_and_decimal_commas(tmp_path):
    rows, _ = predict(tmp_path, "v_n_in;name\n1,5;a,b\n", "mirror")
    del rows
    assert (tmp_path / "out.csv").read_text().splitlines()[1].startswith("1,5;a,b;1,2000000000000002;0,0;0,0")
    predict(tmp_path, "v_n_in\tname\n1.5\ta\n", "mirror")
    assert (tmp_path / "out.csv").read_text().splitlines()[1].startswith("1.5\ta\t1.2000000000000002\t")


def test_empty_header_only_and_foreign_encodings(tmp_path):
    assert "got an empty file" in faults(tmp_path, "")[0]
    assert "got an empty file" in faults(tmp_path, b"\xef\xbb\xbf\r\n\r\n")[0]
    rows, summary = predict(tmp_path, "v_n_in\n", "mirror")
    assert (rows, summary.rows) == ([], 0)
    assert (tmp_path / "out.csv").read_text().startswith("v_n_in,v_n_out")


@pytest.mark.parametrize("codec", ["utf-8-sig", "utf-16"])
def test_a_table_keeps_its_encoding(tmp_path, codec):
    settings = PredictSettings(find_law("mirror"), given=GIVEN)
    texts = []
    for name in ("utf-8", codec):
        table, out = tmp_path / f"{name}.csv", tmp_path / f"{name}-out.csv"
        table.write_bytes("v_n_in,Größe\n1.5,ä\n".encode(name))
        predict_table(table, out, settings)
        texts.append(out.read_bytes().decode(name))
    assert texts[0] == texts[1]
    assert texts[0].splitlines()[1].startswith("1.5,ä,1.2000000000000002,")


def test_duplicate_names_pass_through_unless_they_are_read(tmp_path):
    predict(tmp_path, "v_n_in,x,x\n1,2,3\n", "mirror")
    assert (tmp_path / "out.csv").read_text().splitlines()[1].startswith("1,2,3,0.8,")
    (tmp_path / "out.csv").unlink()
    assert "'v_n_in' (column 1) and 'v_n_in' (column 3)" in faults(tmp_path, "v_n_in,x,v_n_in\n1,2,3\n")[0]


# --- rows at fault --------------------------------------------------------------------------------------------------

BAD = [
    ("abc,0,0.8", "v_n_in: expected a number, got 'abc'"),
    (",0,0.8", "v_n_in: expected a number, got an empty cell"),
    ("nan,0,0.8", "v_n_in: expected a finite number, got nan"),
    ("inf,0,0.8", "v_n_in: expected a finite number, got inf"),
    ("1e200,0,0.8", "v_n_in: expected a finite number, got 1e+200"),
    ("-1,0,0.8", "expected a ball that moves towards the wall"),
    ("1,0,1.5", "restitution: expected a number from 0 to 1, got 1.5"),
    ("x,y,-1", "v_n_in: expected a number, got 'x'; v_t_in: expected a number, got 'y'"),
    ("1,0", "expected 3 fields, got 2"),
    ("1,0,0.8,7,8", "expected 3 fields, got 5, of which left out: 7,8"),
    ('1,"0,0.8', "v_t_in: expected a number, got '\"0'"),
]


@pytest.mark.parametrize(("bad", "why"), BAD)
def test_a_bad_row_is_named_and_loses_nothing_of_the_rest(tmp_path, bad, why):
    content = f"v_n_in,v_t_in,restitution\n1,0.5,0.8\n{bad}\n2,0.5,0.8\n3,0.5,0.8\n"
    given = {"friction": 0.2}
    rows, summary = predict(tmp_path, content, given=given)
    assert [row["v_n_in"] for row in rows][::2] == ["1", "2"]
    assert rows[3]["v_n_in"] == "3"
    assert [bool(row["note"]) for row in rows] == [False, True, False, False]
    assert rows[1]["note"].startswith(why)
    assert rows[1]["v_n_out"] == ""
    assert all(row["v_n_out"] for row in (rows[0], rows[2], rows[3]))
    assert (summary.rows, summary.answered) == (4, 3)
    assert summary.faults == [{"row": "line 3", "what": rows[1]["note"]}]
    (tmp_path / "out.csv").unlink()
    assert f"line 3: {why}" in faults(tmp_path, content, given=given, strict=True)[0]


def test_line_numbers_across_pieces_and_quotes(tmp_path, monkeypatch):
    monkeypatch.setattr(text, "CHUNK_ROWS", 7)
    lines = [f'{i + 1},"a\nb"' if i % 5 == 0 else f"{i + 1},c" for i in range(40)]
    lines[11] = "oops,c"
    lines[30] = '31,"never closed'
    rows, summary = predict(tmp_path, "\n".join(["v_n_in,name", *lines]) + "\n", "mirror")
    # lines 2 to 41, and one more for each quoted line end before them: rows 0, 5, 10 and so on
    assert [fault["row"] for fault in summary.faults] == [f"line {11 + 2 + 3}"]
    assert [row["v_n_in"] for row in rows if row["v_n_in"] != "oops"] == [str(i + 1) for i in range(40) if i != 11]


def test_a_quote_that_is_never_closed_costs_one_row(tmp_path, monkeypatch):
    monkeypatch.setattr(text, "CHUNK_ROWS", 16)
    lines = [f"{i + 1},c" for i in range(100)]
    lines[50] = '"51,c'
    rows, summary = predict(tmp_path, "\n".join(["v_n_in,name", *lines]) + "\n", "mirror")
    assert len(rows) == 100
    assert [fault["row"] for fault in summary.faults] == ["line 52"]


def test_pieces_and_compiled_loops_do_not_change_a_byte(tmp_path, monkeypatch):
    rng = np.random.default_rng(3)
    rows = "".join(f"{x!r},{y!r}\n" for x, y in rng.uniform(0, 2, (500, 2)).tolist())
    answers = []
    for at_once in (64, 1 << 14):  # plain Python, and compiled
        monkeypatch.setattr(text, "CHUNK_ROWS", at_once)
        predict(tmp_path, "v_n_in,v_t_in\n" + rows, "contact", spin="rolling")
        answers.append((tmp_path / "out.csv").read_bytes())
    assert answers[0] == answers[1]
    assert answers[0].count(b"\n") == 501


def test_what_a_law_refuses_is_a_note(tmp_path):
    rows, _ = predict(
        tmp_path, "velocity_x,velocity_y,spin_x,spin_y\n-1,0,0,0\n-1,0,0,%r\n" % (-1 / 0.02625), "conventional",
        given={"restitution": 1.0},
    )  # fmt: skip
    assert rows[0]["note"] == "expected hypothesis 1: a ball that rolls on the floor without sliding"
    assert rows[1]["velocity_x_out"] == "1.0"


# --- files ----------------------------------------------------------------------------------------------------------


def test_out_may_not_be_the_table_or_a_folder(tmp_path, carom_run):
    source = write(tmp_path / "in.csv", "v_n_in\n1\n")
    (tmp_path / "link.csv").symlink_to(source)
    for out, why in (
        (source, "got the same"), (tmp_path / "link.csv", "got the same"), (tmp_path, "got a folder"),
        (tmp_path / "none" / "x.csv", "a folder that exists"), (tmp_path / "x.parquet", "expected a CSV file"),
    ):  # fmt: skip
        ran = carom_run("predict", source, "--law", "mirror", "--out", out)
        assert ran.code == 2
        assert why in ran.err
        assert source.read_text() == "v_n_in\n1\n"
    assert sorted(p.name for p in tmp_path.iterdir()) == ["in.csv", "link.csv"]


@pytest.mark.parametrize("error", [KeyboardInterrupt, RuntimeError])
def test_nothing_half_written_when_it_is_interrupted(tmp_path, monkeypatch, error):
    monkeypatch.setattr(text, "CHUNK_ROWS", 4)
    source = write(tmp_path / "in.csv", "v_n_in\n" + "1\n" * 20)
    out = write(tmp_path / "out.csv", "before\n")

    def progress(done: float, size: float, _text: str) -> None:
        raise error

    with pytest.raises(error):
        predict_table(source, out, PredictSettings(find_law("mirror")), progress=progress)
    assert out.read_text() == "before\n"
    assert sorted(p.name for p in tmp_path.iterdir()) == ["in.csv", "out.csv"]


@pytest.mark.parametrize("number", [errno.ENOSPC, errno.EDQUOT, errno.EFBIG])
def test_a_disk_that_is_full_is_one_line(tmp_path, number):
    out = tmp_path / "out.csv"

    def fill() -> None:
        with atomic_file(out) as file:
            file.write(b"some")
            raise OSError(number, os.strerror(number))

    with pytest.raises(carom.CaromError, match=r"out.csv: expected room to write, got: "):
        fill()
    assert list(tmp_path.iterdir()) == []


def test_the_command(tmp_path, carom_run):
    source = write(tmp_path / "in.csv", "v_n_in,v_t_in\n1,0.5\nx,0\n")
    out = tmp_path / "out.csv"
    printed = carom_run("predict", source, *SURFACES)
    assert printed.code == 0
    assert "line 3: v_n_in: expected a number, got 'x'" in printed.err
    written = carom_run("predict", source, *SURFACES, "--out", out, "--json")
    summary = json.loads(written.out)
    assert (summary["rows"], summary["answered"], summary["without_answer"], summary["law"]) == (2, 1, 1, "two-step")
    assert out.read_text() == printed.out
    assert carom_run("predict", source, *SURFACES, "--strict").out == ""


@pytest.mark.parametrize(
    ("args", "why"),
    [
        (("--law", "two-stp"), "did you mean 'two-step'?"),
        (("--law", "nothing.py:law"), "No such file"),
        (("--spin", "rollin"), "did you mean 'rolling'?"),
        (("--inertia", "wood"), "expected solid, hollow or kappa"),
        (("--inertia", "0.9"), "kappa = I/(m a^2) in (0, 2/3]"),
        (("--restitution", "1.1"), "expected a number from 0 to 1"),
        (("--radius", "0"), "expected a length above 0"),
        (("--radius", "nan"), "expected a length above 0"),
        (("--friction", "-1"), "expected a number >= 0"),
        (("--normal", "0,0,0"), "expected a vector"),
        (("--normal", "1,0"), "expected three numbers"),
        (("--contact-height", "2"), "above 0 and below 2"),
        (("--floor-contact", "never"), "expected 'with'"),
        (("--gravity", "-1"), "expected a number >= 0"),
        (("--json",), "--out: expected a file"),
        (("--speed", "2"), "--speed: expected a table with incidence_deg"),
    ],
)
def test_options_that_make_no_sense(tmp_path, carom_run, args, why):
    ran = carom_run("predict", write(tmp_path / "in.csv", "v_n_in\n1\n"), *args)
    assert ran.code == 2
    assert why in ran.err
    assert ran.out == ""


def test_columns_that_are_nearly_read_are_told(tmp_path):
    notes = predict(tmp_path, "v_n_in_km_h,v_t_in_parsec,fricton,v_n_out,marker\n1,1,0.3,1,a\n", given={})[1].notes
    told = [note for note in notes if note.startswith("not read")]
    assert [note.split(";")[0] for note in told] == ["not read: column 'v_t_in_parsec'", "not read: column 'fricton'"]
    assert "'v_t_in'" in told[0]
    assert "'friction'" in told[1]


def test_a_floor_that_a_flying_ball_does_not_meet_is_told(tmp_path):
    _, summary = predict(tmp_path, "v_n_in,v_t_in\n1,1\n", "maw", given={"floor_friction": 0.3, "friction": 0.2})
    assert summary.notes[-1] == "not used, since the ball is in flight: floor_friction"


def test_a_law_by_its_name_only_is_refused(tmp_path):
    source = write(tmp_path / "in.csv", "v_n_in\n1\n")
    with pytest.raises(carom.CaromError, match="PredictSettings: law: expected a Law, got str 'two-step'"):
        predict_table(source, tmp_path / "out.csv", PredictSettings("two-step"))


def test_bytes_that_are_no_text_and_an_empty_suffix(tmp_path):
    assert faults(tmp_path, b"\x89\x1b\x02\xff\xfe\n\x00") == (
        f"{tmp_path / 'in.csv'}: expected a CSV file, a line of text with names first, got a binary file",
    )
    assert predict(tmp_path, "v_n_in\n1\n", suffix="")[1].added[0] == "v_n_out"


def test_all_faults_of_the_options_at_once(tmp_path, carom_run):
    source = write(tmp_path / "in.csv", "v_n_in\n1\n")
    ran = carom_run("predict", source, "--law", "no-slipp", "--radius", "0", "--inertia", "3", "--spin", "x", "--json")
    assert [line.split(":")[1].strip() for line in ran.err.splitlines()] == [
        "--inertia",
        "--law",
        "--spin",
        "--radius",
        "--out",
    ]
    assert carom_run("predict", source, "--inertia", "hollow").code == 0
    ran = carom_run("predict", source, "--radius", "0", "--out", tmp_path / "none" / "out.csv")
    assert [line.split(":")[1].split()[0] for line in ran.err.splitlines()] == ["--radius", "--out"]
    assert "none/out.csv: expected a folder that exists" in ran.err


def test_a_table_that_is_not_there(tmp_path, carom_run):
    assert "No such file" in carom_run("predict", tmp_path / "no.csv").err
    assert "carom datasets mathavan2009" in carom_run("predict", "mathavan2009").err


# --- a law of one's own ---------------------------------------------------------------------------------------------

OWN = """
def law(v, w, n, a, kappa, e, mu, beta):
    un = v[0] * n[0] + v[1] * n[1] + v[2] * n[2]
    p = -(1 + e) * un
    return (v[0] + p * n[0], v[1] + p * n[1], v[2] + p * n[2]), (w[0] * FACTOR, w[1] * FACTOR, w[2] * FACTOR)
"""


def test_a_law_of_ones_own_and_what_becomes_of_it_when_it_is_edited(tmp_path):
    law = tmp_path / "own" / "my_law.py"
    law.parent.mkdir()
    content = "velocity_x,velocity_y,spin_x,spin_y,spin_z\n" + "-1,0.5,0,0,8\n" * 450  # enough to be compiled
    for factor in ("0.5", "0.25"):
        write(law, OWN.replace("FACTOR", factor))
        rows, _ = predict(tmp_path, content, f"{law}:law")
        assert [float(rows[i]["spin_z_out"]) for i in (0, -1)] == [8 * float(factor)] * 2
        assert float(rows[0]["velocity_x_rolling"]) > 0


def test_faults_of_a_law_of_ones_own(tmp_path):
    law = write(tmp_path / "my_law.py", "law = 3\ndef other(v): pass\n")
    with pytest.raises(carom.CaromError, match=r"expected a carom\.Law or a kernel, got int"):
        find_law(f"{law}:law")
    with pytest.raises(carom.CaromError, match="did you mean 'other'"):
        find_law(f"{law}:othr")
    with pytest.raises(carom.CaromError, match=r"as in .*my_law\.py:law"):
        find_law(str(law))
    with pytest.raises(carom.CaromError, match=r"got ZeroDivisionError"):
        find_law(f"{write(law, '1/0')}:law")
    write(law, "def law(v, w, n, a, kappa, e, mu, beta): return v")
    write(tmp_path / "in.csv", "v_n_in\n1\n")
    with pytest.raises(carom.CaromError, match="expected \\(v, w\\), two triples of finite numbers"):
        predict_table(tmp_path / "in.csv", tmp_path / "out.csv", PredictSettings(find_law(f"{law}:law")))


# --- Parquet --------------------------------------------------------------------------------------------------------


def parquet_of(path: Path, **columns):
    pa, pq = pytest.importorskip("pyarrow"), pytest.importorskip("pyarrow.parquet")
    pq.write_table(pa.table(columns), path)
    return pq


def test_parquet_is_as_csv(tmp_path):
    n, t = [1.0, 2.5, None, float("nan"), -1.0], [0.5, 0.25, 0.0, 0.0, 0.0]
    source, out = tmp_path / "in.parquet", tmp_path / "out.parquet"
    pq = parquet_of(source, v_n_in=n, name=["a", None, "c", "d", "e"], v_t_in=t, count=[1, 2, 3, 4, 5])
    summary = predict_table(source, out, PredictSettings(find_law("two-step"), GIVEN))
    table = pq.read_table(out)
    assert table.column_names[:4] == ["v_n_in", "name", "v_t_in", "count"]
    assert table.select(["name", "count"]).equals(pq.read_table(source).select(["name", "count"]))
    rows, _ = predict(tmp_path, "v_n_in,v_t_in\n1.0,0.5\n2.5,0.25\n,0\nnan,0\n-1,0\n")
    for name in rows[0]:
        if name not in ("v_n_in", "v_t_in", "note"):
            assert [None if row[name] == "" else float(row[name]) for row in rows] == table[name].to_pylist()
    assert [row["note"] or None for row in rows] == table["note"].to_pylist()
    assert [fault["row"] for fault in summary.faults] == ["row 3", "row 4", "row 5"]


def test_parquet_faults(tmp_path, carom_run, monkeypatch):
    source, out = tmp_path / "in.parquet", tmp_path / "out.parquet"
    parquet_of(source, v_n_in=["1", "2"], v_t_in=[True, False])
    ran = carom_run("predict", source, "--out", out)
    assert ran.code == 2
    assert "column 'v_n_in': expected numbers, got string" in ran.err
    assert "column 'v_t_in': expected numbers, got bool" in ran.err
    assert "expected a file to write Parquet to" in carom_run("predict", source).err
    assert "expected a Parquet file" in carom_run("predict", source, "--out", tmp_path / "x.csv").err
    torn = write(tmp_path / "torn.parquet", source.read_bytes()[:-20])
    assert "torn.parquet: expected a Parquet file" in carom_run("predict", torn, "--out", out).err
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    assert "[parquet]" in carom_run("predict", source, "--out", out).err
    assert not out.exists()


@pytest.mark.parametrize("law", list(carom.LAWS.values()), ids=list(carom.LAWS))
def test_a_law_reads_what_it_says_and_nothing_else(law):
    """Each number of wall and floor changed in turn: the answer changes, somewhere, where the law reads it, and nowhere else."""
    from dataclasses import replace

    from carom.laws.law import SURFACES

    ball = carom.Ball()
    states = [
        (carom.rolling(ball, (-1.0, 1.5), 5.0), 1.0, 0.0),
        (carom.State((-1.0, 1.5, -0.4), (3.0, -9.0, 5.0)), 0.8, 0.1),
        (
            carom.State((-2.0, 0.3, -0.4), (0.0, 0.0, 0.0)),
            0.8,
            0.0,
        ),  # little slip: it holds with the friction of pool balls
    ]
    meetings = [
        carom.Meeting(ball, state, wall=carom.Surface(e, mu, 0.0), floor=carom.Surface(0.4, mu, 0.1), height=height)
        for state, e, height in states
        for mu in (0.05, 2.0)  # it slides, it holds
    ]

    def said(meeting):
        if not all(np.all(holds) for holds, _expected, *_field in law.conditions(meeting)):
            return "no answer"
        answer = law.answer(meeting)
        # (how it rolls at last is the same on every floor, for what the floor gives goes through the point that it touches)
        landed = () if answer.steps is None else (answer.steps.after_floor,)
        return [
            np.round(x, 9).tolist() for s in (answer.after_wall, answer.final, *landed) for x in (s.velocity, s.spin)
        ]

    def changed(meeting, name):
        if name == "stiffness_ratio":
            return replace(meeting, stiffness_ratio=1.3)
        part, field = ("floor", name.removeprefix("floor_")) if name.startswith("floor") else ("wall", name)
        value = {"restitution": 0.6, "friction": 0.02, "tangential_restitution": -0.5}[field]
        return replace(meeting, **{part: replace(getattr(meeting, part), **{field: value})})

    found = [name for name in SURFACES if any(str(said(m)) != str(said(changed(m, name))) for m in meetings)]
    assert found == [name for name in SURFACES if name in law.reads]


def test_numbers_that_the_law_does_not_read_are_refused_as_options(tmp_path, carom_run):
    table = write(tmp_path / "in.csv", "velocity_x,velocity_y\n-1,1\n")
    ran = carom_run("predict", table, "--law", "mirror", *SURFACES, "--stiffness-ratio", "0.8")
    assert (ran.code, ran.out) == (2, "")
    assert [line.split(":")[1].strip() for line in ran.err.splitlines()] == [
        "--friction",
        "--stiffness-ratio",
        "--floor-friction",
    ]
    assert "--friction: expected a law that reads it, got mirror, which reads restitution; omit it" in ran.err
    ran = carom_run("predict", table, "--law", "no-slip", "--friction", "0.2")
    assert "got no-slip, which reads floor_restitution, floor_friction" in ran.err
    assert len(carom_run("predict", table, "--law", "mirror", "--friction", "nan").err.splitlines()) == 1
    assert carom_run("predict", table, "--law", "mirror", "--restitution", "0.8").code == 0


def test_numbers_that_the_law_does_not_read_are_told(tmp_path):
    rows, summary = predict(
        tmp_path,
        "velocity_x,velocity_y,friction\n-1,1,x\n",
        "mirror",
        given={"restitution": 0.8, "floor_friction": 0.3},
    )
    assert numbers(rows[0], "velocity_x_out", "velocity_y_out") == [0.8, 1.0]  # what it does not read may be anything
    assert "not read, since the law mirror does not use it: column 'friction'" in summary.notes
    assert "not read, since the law mirror does not use it: floor_friction" in summary.notes
    assert "friction" not in next(note for note in summary.notes if note.startswith("neither"))
    _, summary = predict(tmp_path, "velocity_x,velocity_y\n-1,1\n")
    assert not [note for note in summary.notes if note.startswith("not read")]


def test_compiling_is_told_and_loading_is_not(tmp_path):
    import io

    from rich.console import Console

    from carom.cli.console import working
    from carom.core.jit.threads import watch_compiling

    text = "velocity_x,velocity_y\n" + "-1,1\n" * 500
    (tmp_path / "own.py").write_text(
        f"def law(v, w, n, a, kappa, e, mu, beta):  # {tmp_path}\n    return (-v[0], v[1], v[2]), w\n"
    )
    (tmp_path / "here").mkdir()
    source, out = write(tmp_path / "in.csv", text), tmp_path / "here" / "out.csv"
    settings = PredictSettings(find_law(f"{tmp_path / 'own.py'}:law"))
    told: list[tuple[str, bool]] = []
    with watch_compiling(lambda function, finished: told.append((function, finished))):
        predict_table(source, out, settings)
        assert any(function.endswith(":law") for function, _ in told)
        assert sorted(name for name, finished in told if finished) == sorted(name for name, end in told if not end)
        told.clear()
        predict_table(source, out, settings)
        assert not told
    (tmp_path / "own.py").write_text(
        "def law(v, w, n, a, kappa, e, mu, beta):\n    return (-v[0], v[1], 2 * v[2]), w\n"
    )
    terminal = Console(file=io.StringIO(), force_terminal=True, width=80)
    with working("predict", terminal) as progress:
        predict(tmp_path / "here", text, f"{tmp_path / 'own.py'}:law")
        progress(1, 2)
    shown = terminal.file.getvalue()
    assert shown.index("predict") < shown.index("compiling, once")
    file = Console(file=io.StringIO(), width=80)
    with working("predict", file) as progress:
        progress(1, 2)
    assert not file.file.getvalue()  # (a line every ten seconds)


def test_a_table_keeps_bytes_that_are_not_utf8(tmp_path):
    source, out = write(tmp_path / "in.csv", b"name,v_n_in,v_t_in,spin_in\n\xe9,1.5,0.5,3\n"), tmp_path / "out.csv"
    summary = predict_table(source, out, PredictSettings(find_law("mirror"), given={"restitution": 0.5}))
    assert summary.answered == 1
    assert out.read_bytes().splitlines()[1:] == [b"\xe9,1.5,0.5,3,0.75,0.5,3.0,"]


# --- from Python: files and arrays ---------------------------------------------------------------------------------

STATES = {"v_n_in": np.array([1.5, 3.0, -1.0]), "v_t_in": np.array([0.5, 0.0, 1.0])}


def test_arrays_frames_and_files_give_the_same_columns(tmp_path):
    path = write(tmp_path / "in.csv", "v_n_in,v_t_in\n1.5,0.5\n3.0,0.0\n-1.0,1.0\n")
    settings = {"restitution": 0.5, "friction": 0.2}
    written = carom.predict(path, "contact", out=tmp_path / "out.csv", **settings)
    assert written.columns == {}
    pandas = pytest.importorskip("pandas")
    arrow = pytest.importorskip("pyarrow")
    expected = pandas.read_csv(
        tmp_path / "out.csv", keep_default_na=False, na_values={name: [""] for name in written.added[:-1]}
    )
    kinds = [
        path, str(path), STATES, pandas.DataFrame(STATES), arrow.table(STATES),
        np.array(list(zip(*STATES.values(), strict=True)), dtype=[(name, float) for name in STATES]),
    ]  # fmt: skip
    for table in kinds:
        found = carom.predict(table, "contact", **settings)
        assert (found.rows, found.answered, found.without_answer) == (3, 2, 1)
        assert list(found.columns) == list(expected)
        for name in written.added[:-1]:
            assert np.array_equal(found[name], expected[name].to_numpy(), equal_nan=True), (type(table), name)
        assert found[written.added[-1]].tolist() == expected[written.added[-1]].tolist()
    assert found.faults[0]["row"] == "row 3"
    assert carom.predict(path, "contact", **settings).faults[0]["row"] == "line 4"


def test_a_result_is_the_input_of_the_next_function(tmp_path):
    rebounds = carom.data.make_rebounds("planar", {"v_n_in": [1.0, 2.0], "v_t_in": [1.0, 1.0], "v_n_out": [0.8, 1.6]})
    found = carom.predict(rebounds, "sticking", radius=0.02)
    assert found["v_n_out"].tolist() == [0.8, 1.6]  # as measured
    assert found["v_n_out_predicted"].tolist() == [1.0, 2.0]


def test_a_table_that_is_not_there_is_one_line_from_python(tmp_path):
    """It had been "expected arguments that fit its documentation", with the system's own exception."""
    for out in (None, tmp_path / "out.csv"):
        with pytest.raises(carom.CaromError) as caught:
            carom.predict(tmp_path / "none.csv", out=out)
        (one,) = caught.value.records
        assert (one.where, one.got) == (str(tmp_path / "none.csv"), ": No such file or directory")
    with pytest.raises(carom.CaromError, match=r"got none$"):
        carom.predict({})


def test_misuse_from_python_is_one_line():
    for table, options, said in [
        (5, {}, "predict: table: expected a path, or columns"),
        ({"v_n_in": [[1.0]], "v_t_in": [1.0]}, {}, "expected a column (N,), got an array of shape (1, 1)"),
        ({"v_n_in": [1.0, 2.0], "v_t_in": [1.0, 1.0, 1.0]}, {}, "expected one length for all"),
        ({"v_n_in": ["a"], "v_t_in": [1.0]}, {}, "column 'v_n_in': expected numbers, got "),
        (STATES, {"out": "x.csv"}, "expected none with columns in memory"),
        (STATES, {"law": "mirror", "friction": 0.2}, "`friction`: expected a law that reads it"),
        (STATES, {"inertia": 3}, "`inertia`: expected solid"),
    ]:
        with pytest.raises(carom.CaromError) as error:
            carom.predict(table, **options)
        assert len(error.value.faults) == 1
        assert said in error.value.faults[0]
    with pytest.raises(carom.CaromError, match="expected a column of the result"):
        carom.predict(STATES, "sticking")["v_n"]
