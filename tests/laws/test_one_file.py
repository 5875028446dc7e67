"""A law is one file: dropped into a copy of the package, every part of carom knows it, with no other file touched."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from reference.forking import forking

import carom
from carom.core.jit.cache import cache_base, cache_folder

LAW = '''
"""A wall that takes half of the tangential velocity, an example."""

from __future__ import annotations

from carom.core.jit.kernel import Vec, dot, kernel
from carom.laws.law import Card, wall_law

CARD = Card("half-slide", "Half of the velocity along the wall is lost.", ("spin unchanged",), "A test.", "none", "none")


@kernel
def half_slide(v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float) -> tuple[Vec, Vec]:
    """Velocity and spin after the wall."""
    u = dot(v, n)
    c = 0.5 * u + e * u
    return (0.5 * v[0] - c * n[0], 0.5 * v[1] - c * n[1], 0.5 * v[2] - c * n[2]), w


LAW = wall_law(CARD, half_slide, reads=("restitution",))
'''

PAIR_LAW = '''
"""Two balls that rub twice as much, an example."""

from __future__ import annotations

from carom.core.jit.kernel import Vec, kernel
from carom.laws.law import Card, contact_kernel, wall_law

CARD = Card("double-rub", "Friction counts twice.", ("one contact",), "A test.", "none", "none")


@kernel
def double_rub(v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float) -> tuple[Vec, Vec]:
    """Velocity and spin after the contact."""
    return contact_kernel(v, w, n, a, kappa, e, 2 * mu, beta)


LAW = wall_law(CARD, double_rub, reads=("restitution", "friction"), in_flight=True)
'''

PAIR_SCENE = """
gravity = 0.0
[[balls]]
radius = 0.03
mass = 0.1
position = [0.0, 0.0]
velocity = [1.0, 0.0]
[[balls]]
radius = 0.03
mass = 0.1
position = [0.2, 0.03]
[ball_contact]
friction = 0.05
law = "double-rub"
[run]
duration = 1.0
"""

PAIR = """
import json, carom
scene = carom.load_scene("pair.toml")
run = carom.simulate(scene)
(_, _, first, second) = run.log[:4]
ball, at = carom.Ball(0.03, 0.1), carom.State.of(first["v_before"], first["w_before"])
rest, n = carom.State((0.0, 0.0, 0.0), (0.0, 0.0, 0.0)), first["x"] - second["x"]
hit = carom.collide(ball, at, ball, rest, n, carom.Surface(1.0, 0.05), law="double-rub")
plain = carom.simulate(scene.model_copy(update={"ball_contact": carom.BallContact(friction=0.1)}))
swept = carom.sweep(carom.Space(scene, {"ball_contact.law": ["contact", "double-rub"]}), ["final.velocity"]).run()["final.velocity"]
found = [second["v"], hit.after[1].velocity, plain.log[3]["v"], swept.values]
print(json.dumps([one.tolist() for one in found]))
"""

SCENE = """
gravity = 0.0
[[walls]]
shape = "plane"
point = [0.0, 0.0, 0.0]
normal = [1.0, 0.0, 0.0]
restitution = 0.5
[[balls]]
radius = 0.03
mass = 0.1
position = [0.2, 0.0]
velocity = [-1.0, 1.0]
[run]
law = "half-slide"
duration = 1.0
"""

MANY = """
import json, carom, numpy as np
scene = carom.load_scene("scene.toml")
many = carom.simulate_many(scene, velocity=np.array([[[-1.0, 1.0, 0.0]], [[-2.0, 1.0, 0.0]]]))
orbit = carom.billiards.orbit(carom.billiards.circle(), ((0.2, 0.0), (1.0, 0.3)), 3, law="half-slide")
print(json.dumps([many.final.velocity.tolist(), int(np.sum(orbit.count)), orbit.setup.law]))
"""


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Callable[..., str]]:
    """Runs of a copy of the package with two files more, a scene and tables beside it: what they write."""
    folder = tmp_path_factory.mktemp("copy")
    shutil.copytree(Path(carom.__file__).parent, folder / "carom")
    (folder / "carom" / "laws" / "half_slide.py").write_text(LAW)
    (folder / "carom" / "laws" / "double_rub.py").write_text(PAIR_LAW)
    (folder / "scene.toml").write_text(SCENE)
    (folder / "pair.toml").write_text(PAIR_SCENE)
    (folder / "shots.csv").write_text("v_n_in,v_t_in,spin_z_in\n1.0,0.5,0.0\n2.0,0.5,0.0\n")
    rows = [(1 + 0.1 * k, 0.5 + 0.2 * (k % 4), 0.0) for k in range(12)]
    lines = [f"{n:.3f},{t:.3f},{s:.1f},{0.7 * n:.3f},{0.5 * t:.3f},{s:.1f},0.02,0.02,0.5" for n, t, s in rows]
    head = "v_n_in,v_t_in,spin_in,v_n_out,v_t_out,spin_out,sigma_v_n_out,sigma_v_t_out,sigma_spin_out"
    (folder / "rebounds.csv").write_text("\n".join([head, *lines]) + "\n")
    # (a cache of its own: a second copy of the sources must not push the first one's compiled code out)
    own = {"PYTHONPATH": str(folder), "CAROM_CACHE": str(folder / "cache"), "NO_COLOR": "1"}
    # (what each run that compiles the law would do first)
    prepare = "from carom.core.jit.compile import register_kernels; register_kernels()"
    with forking("numpy", "numba", prepare=prepare, **own) as forked:

        def answer(*words: str) -> str:
            code, out, err = forked(folder, *words)
            assert code == 0, err
            return out

        # the loops call such a law by its address: what was compiled without it serves, and only the law itself is new
        shutil.copytree(cache_folder(), answer("-c", WHERE).strip(), dirs_exist_ok=True)
        for code in cache_base().glob("*/*.o"):  # machine code of the package's loops
            copied = folder / "cache" / code.relative_to(cache_base())
            copied.parent.mkdir(exist_ok=True)
            shutil.copy2(code, copied)
        yield answer


WHERE = "from carom.core.jit.cache import cache_folder; print(cache_folder())"


def test_the_command_knows_it(run: Callable[..., str]) -> None:
    pairs = {law["name"]: law["for_pairs"] for law in json.loads(run("laws", "--json"))["laws"]}
    assert [pairs[name] for name in ("double-rub", "contact", "half-slide", "two-step")] == [True, True, False, False]
    compared = json.loads(run("compare", "--restitution", "0.5", "--json"))["laws"]
    found = next(law for law in compared if law["law"] == "half-slide")
    assert found["after_wall"]["velocity"][:2] == pytest.approx([0.5 * 0.5**0.5, 0.5 * 0.5**0.5])
    predicted = run("predict", "shots.csv", "--law", "half-slide", "--restitution", "0.5", "--spin", "none")
    assert predicted.splitlines()[1].split(",")[3:5] == ["0.5", "0.25"]


def test_scenes_many_runs_and_billiards_know_it(run: Callable[..., str]) -> None:
    events = json.loads(run("simulate", "scene.toml", "--json"))
    assert events["final"][0]["velocity"] == pytest.approx([0.5, 0.5, 0.0])
    many, bounces, law = json.loads(run("-c", MANY).splitlines()[-1])
    assert [v[0][:2] for v in many] == [[0.5, 0.5], [1.0, 0.5]]
    assert (bounces, law) == (3, "half-slide")


def test_two_balls_meet_by_a_law_of_one_file(run: Callable[..., str]) -> None:
    scene, collide, twice, swept = json.loads(run("-c", PAIR).splitlines()[-1])
    assert scene == collide == pytest.approx(twice, abs=1e-15)
    assert swept[1][1] == pytest.approx(twice, abs=1e-12)
    assert swept[0][1] != pytest.approx(twice, abs=1e-3)


def test_fits_know_it(run: Callable[..., str]) -> None:
    ranked = json.loads(run("fit", "rebounds.csv", "--radius", "0.02", "--json"))
    laws = {law["law"]: law for law in ranked["ranking"]}
    assert laws["half-slide"]["parameters"]["restitution"]["value"] == pytest.approx(0.7, abs=0.02)


@pytest.mark.slow
def test_the_documentation_knows_it(run: Callable[..., str]) -> None:
    # (the page of the laws is made from carom.CARDS)
    assert "half-slide" in run("-c", "import carom; print(list(carom.CARDS))")
