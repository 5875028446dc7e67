"""The verdicts on the paper: computed, moved by a changed print, and given by the command."""

import ast
import dataclasses
import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import sympy as sp
from reference.commands import command
from reference.exploring import tried
from typer.testing import CliRunner

import carom as carom_package
import carom.derive as carom_derive
from carom.cli import app
from carom.derive.paper import as_record, as_tex, derive_paper, find_entries, judge
from carom.derive.paper import ledger as k
from carom.derive.paper.ledger import INSIDE, OUTSIDE, Branch, Entry, poles, says_nothing, true_of
from carom.derive.system import is_zero
from carom.errors import CaromError

NUMBERED = [str(k) for k in range(1, 42)]


@pytest.fixture(scope="module")
def rows():
    return list(derive_paper())


@pytest.fixture(scope="module")
def statuses(rows):
    return {entry.id: verdict.status for entry, verdict in rows}


def test_every_equation_is_there_once(rows):
    names = [entry.id for entry, _ in rows]
    assert len(names) == len(set(names))
    assert set(NUMBERED) <= set(names)
    assert all(re.fullmatch(r"\d+[a-z]?|s\d+-\d+", name) for name in names)
    assert all(entry.steps and entry.title and entry.printed and entry.derived for entry, _ in rows)


def test_misprints(statuses):
    # found by comparison; this list pins what the comparison finds
    assert [n for n, s in statuses.items() if s == "misprint"] == ["37", "37c", "s4-1", "41", "41e"]
    record = next(as_record(*row) for row in find_entries("41e"))
    assert record["printed"] == "omega_y2 = 25*u_0/(49*a)"
    assert record["derived"] == "omega_y2 = 31*u_0/(49*a)"


def test_conditions(statuses, rows):
    notes = {entry.id: as_record(entry, verdict)["note"] for entry, verdict in rows}
    for name in ("6", "12", "13", "14"):
        assert statuses[name] == "conditional"
        assert "psi = 0" in notes[name]
    assert statuses["15"] == statuses["16"] == statuses["17"] == "holds"
    assert "mirror" in notes["22"]
    assert "reverses the slip" in notes["26"]
    assert "e = 0" in notes["s3-1"]
    assert "trivially" in notes["s2-6"]
    assert "3 -> 5" in notes["s2-6"]
    assert notes["s2-8"].startswith("holds if the tangential state does not change")
    assert "backspin" in notes["s3-2"]
    assert "kappa/(kappa + 1)" in notes["26"]


def test_what_rests_on_a_sticking_wall_is_conditional(rows):
    """(31) follows from (29) and (30), which are conditions; so do the lines of (33), (40) and (41) that use it."""
    verdicts = {entry.id: verdict for entry, verdict in rows}
    stick = [
        "31",
        *(f"31{x}" for x in "bcefhi"),
        "33",
        "40",
        *(f"40{x}" for x in "bcef"),
        *(f"41{x}" for x in "abdf"),
        "s4-2",
    ]
    for name in ("30", *stick):
        assert verdicts[name].status == "conditional", name
        assert (verdicts[name].true_in, verdicts[name].false_in) == ((INSIDE,), (OUTSIDE,)), name
    # the normal motion, the spin about the normal and the energy before do not ask how the contact ends
    for name in ("28", "31a", "31d", "31g", "32", "39", "40a", "40d", "41c"):
        assert verdicts[name].status == "holds", name
    for name in ("s3-4", "s3-5"):
        assert verdicts[name].false_in == ("at a wall without friction",), name
    assert verdicts["s4-3"].false_in == ("at a wall without friction (66.8 degrees)",)


def test_sliding_case_is_that_of_the_law():
    """The facts of the case outside the cone, with numbers, against the compiled law at a friction too small to stick."""
    numbers = {k.I: sp.Rational(2, 5), k.m: 1, k.a: 1, k.mu: 0.1, k.e: 0.8, k.x0: -1.0, k.y0: 0.7, k.wz0: -0.4}
    ball = carom_package.Ball(radius=1.0, mass=1.0)
    state = carom_package.rolling(ball, velocity=(-1.0, 0.7), spin_z=-0.4)
    two = carom_package.two_step(ball, state, wall=carom_package.Surface(0.8, 0.1))
    assert two.wall.regime == "slide"
    expected = [*two.after_wall.velocity, *two.after_wall.spin]
    facts = k.sliding_facts()
    assert [float(facts[q].subs(numbers)) for q in k.FIRST] == pytest.approx(expected, abs=1e-14)


def test_what_is_derived_holds_by_the_same_judge(rows):
    for entry, verdict in rows:
        if verdict.status == "misprint" and entry.id[0].isdigit():
            mended = judge(dataclasses.replace(entry, printed=entry.derived))
            assert mended.status != "misprint", entry.id
            # (41) rests on (31): the right form fails too where the wall's friction does not suffice
            assert set(mended.false_in) == ({OUTSIDE} if entry.id.startswith("41") else set()), entry.id


def test_every_verdict_moves_when_the_print_does(rows):
    """Change one printed relation at a time: no case in which it held may go on holding."""
    one = sp.Integer(1)
    for entry, verdict in rows:
        for i, relation in enumerate(entry.printed):
            if isinstance(relation, sp.Equality):
                wrongs = [sp.Eq(relation.lhs, relation.rhs + one, evaluate=False)]
                if relation.rhs != 0 and not says_nothing(relation):
                    wrongs.append(sp.Eq(relation.lhs, -relation.rhs, evaluate=False))
                    wrongs = tried(wrongs[i % 2 :][:1], wrongs)  # one of the two for each relation
            else:
                wrongs = [relation.negated]
            for wrong in wrongs:
                printed = (*entry.printed[:i], wrong, *entry.printed[i + 1 :])
                changed = judge(dataclasses.replace(entry, printed=printed))
                assert changed.status != "holds", (entry.id, wrong)
                # a false print may be true on another branch, as the mirror root keeps the slip that (25) reverses
                assert changed.status == "misprint" or not set(changed.true_in) & set(verdict.true_in), (
                    entry.id,
                    wrong,
                )


def test_the_judge_on_small_things():
    x, y = sp.symbols("x y", real=True)
    u = sp.Symbol("u", positive=True)
    assert true_of(sp.Eq(sp.sin(x) ** 2, 1 - sp.cos(x) ** 2, evaluate=False), {})
    assert not true_of(sp.Eq(x, y), {})
    assert true_of(sp.Gt(x, y), {x: 2 * u, y: u})
    assert not true_of(sp.Gt(x, y), {})
    assert true_of(sp.Ne(x, y), {x: u, y: 2 * u})
    assert not true_of(sp.Ne(x, y), {x: u, y: u})
    assert poles(sp.Eq(y, 1 / sp.sin(x)), {}, {x: 0})
    assert not poles(sp.Eq(y, sp.sin(x) / x), {}, {x: 0})
    half = Entry("1", "", (sp.Eq(x, y),), (sp.Eq(x, y),), (Branch("here", {x: y}), Branch("there", {x: 2 * u, y: u})))
    assert judge(half).status == "conditional"
    assert judge(half).sentence == "holds here; not there"
    assert judge(half).gap == "x = y: left - right = u"


def test_zero_test_is_not_fooled():
    x = sp.Symbol("x", real=True)
    assert is_zero(sp.sin(2 * x) - 2 * sp.sin(x) * sp.cos(x))
    assert not is_zero(sp.sin(x) ** 2 + sp.cos(x) ** 2 - 1 - sp.Rational(1, 10**12))
    assert not is_zero(x - x**2)


def test_unknown_equation():
    for wrong in ("42", "31z", "s9-9"):
        with pytest.raises(CaromError, match="the paper has no"):
            find_entries(wrong)
    with pytest.raises(CaromError, match="expected a number"):
        find_entries("thirty")


# -- the command -----------------------------------------------------------------------------------------------------


def test_json_is_json_and_nothing_else(rows):
    # in this process, where the equations are derived already
    done = CliRunner().invoke(app, ["derive", "--json"])
    assert done.exit_code == 0, done.stderr
    found = json.loads(done.stdout)["equations"]
    assert [e["id"] for e in found] == [entry.id for entry, _ in rows]
    assert found == [as_record(*row) for row in rows]
    for record in found:
        assert {"id", "status", "printed", "derived", "note"} <= set(record)
        assert record["status"] in ("holds", "misprint", "conditional")


def test_one_equation_with_its_steps(capsys):
    code, said, _notes = command(capsys, "derive", "--equation", "31")
    assert code == 0
    assert "R_z = -I*m*xdot0/(I + a**2*m)" in said
    assert "steps" in said
    assert "(31g)  holds" in said
    assert "(31i)  conditional" in said
    _code, said, _notes = command(capsys, "derive", "--equation", "s4-3", "--json")
    (record,) = json.loads(said)["equations"]
    assert record["status"] == "conditional"
    assert record["note"].endswith("51.519802 degrees.")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--equation", "99"), "the paper has no 99"),
        (("--json", "--tex"), "exclude each other"),
        (("out.tex",), "goes with --json or --tex"),
        (("--tex", "no/such/folder/out.tex"), "expected a folder that exists"),
        (("--json", "out.tex"), "expected a name that ends with .json"),
        (("--tex", "x.tex/../"), "expected a name that ends with .tex"),
    ],
)
def test_bad_input_is_one_line_and_exit_code_2(arguments, message, capsys):
    code, said, notes = command(capsys, "derive", *arguments)
    assert (code, said) == (2, "")
    faults = [line for line in notes.splitlines() if line.startswith("carom:")]
    assert len(faults) == 1
    assert message in faults[0]


def test_the_room_stands_apart_and_sympy_waits():
    room = Path(carom_derive.__file__).parent
    for file in sorted(room.rglob("*.py")):
        tree = ast.parse(file.read_text(encoding="utf-8"))
        names = [node.module or "" for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)]
        names += [name.name for node in ast.walk(tree) if isinstance(node, ast.Import) for name in node.names]
        own = {name for name in names if name.split(".")[0] == "carom"}
        allowed = {"carom.errors", "carom.bodies", "carom.files", "carom.public.guard"}
        assert all(name in allowed or name.startswith(("carom.derive", "carom.core.jit.")) for name in own), file
    code = "import sys, carom, carom.cli; sys.exit('sympy' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


# -- LaTeX -----------------------------------------------------------------------------------------------------------


def test_tex_is_well_formed(rows):
    document = as_tex(rows)
    assert document.startswith(r"\documentclass")
    assert document.rstrip().endswith(r"\end{document}")
    depth = 0
    for brace in re.findall(r"(?<!\\)[{}]", document.replace(r"\\", "")):
        depth += 1 if brace == "{" else -1
        assert depth >= 0
    assert depth == 0
    for kind in set(re.findall(r"\\begin\{(\w+)\}", document)):
        assert document.count(rf"\begin{{{kind}}}") == document.count(rf"\end{{{kind}}}")
    assert document.count(r"\[") == document.count(r"\]")
    assert all(ord(letter) < 128 for letter in document)
    for name in NUMBERED:
        assert rf"\subsection*{{({name}) " in document


def test_tex_compiles(rows, tmp_path):
    latex = shutil.which("pdflatex")
    if latex is None:
        pytest.skip("LaTeX is not installed")
    (tmp_path / "paper.tex").write_text(as_tex(rows), encoding="utf-8")
    done = subprocess.run(
        [latex, "-interaction=nonstopmode", "-halt-on-error", "paper.tex"],
        cwd=tmp_path,
        capture_output=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout.decode(errors="replace")[-2000:]
    assert (tmp_path / "paper.pdf").stat().st_size > 10_000
