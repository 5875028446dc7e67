"""Shots of pooltool's, played by it with its own cushions and with carom's two-step law, and by carom alone.

    python campaigns/pooltool_shots.py [N] [--python PYTHON]

N shots (100) of one ball, on pooltool's billiard and pool tables in turn: any direction, cue speeds of 0.5 to 3 m/s, offsets up to
0.3. pooltool is run by PYTHON, or in a virtual environment of its own (build/pooltool), which is made first; the checks of
campaigns/in_pooltool pass in it before. With --small the stored shot of tests/interop is compared, and pooltool is not needed.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import warnings
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
from campaign import ROOT, campaign

import carom
from carom.interop.pooltool import engine, read

FILES = ROOT / "tests" / "interop" / "files"
NEEDED = (
    "attrs", "cattrs", "click", "h5py", "msgpack-numpy", "numpy-quaternion", "panda3d==1.10.16", "panda3d-gltf",
    "panda3d-simplepbr", "pillow", "pytest", "pyyaml", "scipy",
)  # fmt: skip
SAME = 0.01  # m: final places that count as the same


def prepared() -> str:
    """Return the interpreter of an environment with carom and pooltool; it is made if it is not there."""
    folder = ROOT / "build" / "pooltool"
    python = folder / "bin" / "python"
    if not python.exists():
        subprocess.run([sys.executable, "-m", "venv", folder], check=True)
        pip = [python, "-m", "pip", "-q", "install"]
        subprocess.run([*pip, f"{ROOT}[msgpack]", *NEEDED], check=True)
        subprocess.run([*pip, "--no-deps", "pooltool-billiards==0.6.0"], check=True)
    return str(python)


def play(folder: Path, count: int) -> None:
    """Play shots with both laws, in an interpreter that has pooltool, and save them."""
    import pooltool as pt

    rng = np.random.default_rng(1)
    laws = {"own": None, "two_step": engine("two-step")}
    for i in range(count):
        table = pt.Table.default([pt.TableType.BILLIARD, pt.TableType.POCKET][i % 2])
        radius, mass = [(0.03075, 0.2125), (0.028575, 0.170097)][i % 2]
        x, y = rng.uniform(0.2, table.w - 0.2), rng.uniform(0.2, table.l - 0.2)
        speed, phi, (a, b) = rng.uniform(0.5, 3.0), rng.uniform(0.0, 360.0), rng.uniform(-0.3, 0.3, 2)
        for name, own in laws.items():
            ball = pt.Ball.create("white", xy=(x, y), R=radius, m=mass)
            shot = pt.System(cue=pt.Cue(cue_ball_id="white"), table=table.copy(), balls={"white": ball})
            shot.strike(V0=speed, phi=phi, a=a, b=b)
            pt.simulate(shot, engine=own, inplace=True)
            shot.save(folder / f"{i:03}_{name}.msgpack")


def final_place(path: np.ndarray) -> tuple[np.ndarray, bool]:
    """Return where a ball of pooltool's ends, and whether in a pocket (there its centre is below the table)."""
    return path[-1, 1:3], bool(path[-1, 3] < 0)


def compare(folder: Path, pairs: Sequence[tuple[str, str]], say: Callable[[str], None]) -> None:
    """Print how far the final places lie apart."""
    apart: dict[str, list[float]] = {
        "pooltool's law and two-step in pooltool": [],
        "two-step in pooltool and in carom": [],
    }
    falls = dict.fromkeys(apart, 0)
    cushions = []
    for own, two in pairs:
        shot, other = read(folder / own)[0], read(folder / two)[0]
        run = carom.simulate(shot.scene)
        ours = run.final.position[0, :2], run.final_phase[0] == "pocketed"
        cushions.append(len(run.events.of("wall")))
        places = [final_place(one.paths["white"]) for one in (shot, other)]
        for kind, (one, falls1), (another, falls2) in zip(apart, places, (places[1], ours), strict=True):
            falls[kind] += falls1 != falls2
            if not (falls1 or falls2):
                apart[kind].append(float(np.linalg.norm(one - another)))
    say(f"shots: {len(pairs)}, with {sum(cushions)} contacts with cushions in carom")
    for kind, gaps in apart.items():
        near, median, most = np.mean(np.array(gaps) < SAME), np.median(gaps), np.quantile(gaps, 0.9)
        say(
            f"{kind}: final places apart by {1000 * median:.1f} mm (median), nine in ten by less than {1000 * most:.1f} mm,"
            f" {100 * near:.0f} % within {1000 * SAME:.0f} mm; the ball falls into a pocket in one alone: {falls[kind]}"
        )


def main(words: Sequence[str] | None = None) -> None:
    """A line for each pair of players."""
    options = {"python": {"help": "interpreter with carom's dependencies and pooltool"}, "play": {"type": Path}}
    with campaign("pooltool_shots", __doc__, words, count=100, small=1, **options) as run:
        if run.given.play:
            warnings.simplefilter("ignore")
            play(run.given.play, run.count)
        elif run.small:
            compare(FILES, [("bank.msgpack", "bank_two_step.msgpack")], run.say)
        else:
            python = run.given.python or prepared()
            with tempfile.TemporaryDirectory() as folder:
                paths = os.pathsep.join([str(ROOT / "src"), str(ROOT / "campaigns")])
                environment = {**os.environ, "PYTHONPATH": paths}
                checks = ["-m", "pytest", "-q", "-c", os.devnull, f"{ROOT}/campaigns/in_pooltool/check_pooltool.py"]
                for command in (checks, [__file__, str(run.count), "--play", folder]):
                    subprocess.run([python, "-W", "ignore", *command], check=True, env=environment, stdout=sys.stderr)
                names = sorted(path.name for path in Path(folder).glob("*_own.msgpack"))
                compare(Path(folder), [(name, name.replace("own", "two_step")) for name in names], run.say)


if __name__ == "__main__":
    main()
