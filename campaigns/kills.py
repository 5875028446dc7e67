"""Killed and resumed: a gas that is killed at random moments ends with the same bits as one that is not.

    python campaigns/kills.py [N] [--rows FILE]

N runs (100) of `carom gas` with checkpoints are killed (SIGKILL) at a random moment, resumed from the last checkpoint, killed
again with a chance of one half, and so on to the end. The answer (--json) and the final checkpoint have to be those of an
undisturbed run, and no other file may be left. A run that was killed before its first checkpoint starts again. How long an
undisturbed run takes is measured once everything is compiled.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from campaign import Campaign, campaign
from reference.gases import ROUGH

EVENTS, FEW = 1_000_000, 60_000
MOST = 20  # kills of one run


def gas(*words: str) -> list[str]:
    """Return the command that runs the gas with checkpoints."""
    every = ("--checkpoint", "c.npz", "--checkpoint-every", "20000 events", "--json")
    return [sys.executable, "-m", "carom", "gas", "gas.toml", *every, *words]


def undisturbed(folder: Path) -> tuple[dict[str, Any], dict[str, bytes], float]:
    """Return the answer of a whole run, the arrays of its last checkpoint, and how long it took, s."""
    begin = time.monotonic()
    done = subprocess.run(gas(), cwd=folder, capture_output=True, check=True)
    return answer(done.stdout), arrays(folder / "c.npz"), time.monotonic() - begin


def answer(text: bytes) -> dict[str, Any]:
    """Return what --json printed, without the time taken."""
    found: dict[str, Any] = json.loads(text)
    del found["cpu_seconds"]
    return found


def arrays(path: Path) -> dict[str, bytes]:
    """Return the bytes of a checkpoint's arrays, but for versions and the time taken, and for where the calendar stands: a run that
    was killed after its last event, and is resumed, looks for one more."""
    with np.load(path) as file:
        found = {
            name: file[name] for name in file.files if file[name].dtype.kind not in "US" and name != "mark.numbers"
        }
    system = found.pop("gas.system")
    return {name: array.tobytes() for name, array in found.items()} | {
        name: system[name].tobytes() for name in system.dtype.names if name not in ("bin", "status")
    }


def one(seed: int, scene: str, whole: tuple[dict[str, Any], dict[str, bytes], float]) -> dict[str, Any]:
    """A run with kills: how many, how many of them before the first checkpoint, and what differs at the end."""
    rng = np.random.default_rng(seed)
    kills = fresh = 0
    with tempfile.TemporaryDirectory(prefix="carom-kill-") as name:
        folder = Path(name)
        (folder / "gas.toml").write_text(scene, encoding="utf-8")
        while True:
            resume = ("--resume", "c.npz") if (folder / "c.npz").exists() else ()
            with subprocess.Popen(gas(*resume), cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as run:
                if kills == 0 or (kills < MOST and rng.random() < 0.5):
                    try:
                        out, _err = run.communicate(timeout=rng.uniform(0.2, 0.95) * whole[2])
                    except subprocess.TimeoutExpired:
                        run.kill()
                        kills, fresh = kills + 1, fresh + (not (folder / "c.npz").exists())
                        continue
                else:
                    out, _err = run.communicate()
            break
        wrong = [] if answer(out) == whole[0] else ["answer"]
        wrong += [] if arrays(folder / "c.npz") == whole[1] else ["checkpoint"]
        left = sorted(path.name for path in folder.iterdir() if path.name not in ("gas.toml", "c.npz"))
    return {"kills": kills, "fresh": fresh, "wrong": wrong, "left": left}


def main(words: Sequence[str] | None = None) -> int:
    """Two lines; 1 if a run ended otherwise."""
    with campaign("kills", __doc__, words, count=100, small=1) as run:
        return report(run)


def report(run: Campaign) -> int:
    """Kill the runs one after the other."""
    scene = ROUGH.replace("60_000", str(FEW if run.small else EVENTS))
    with tempfile.TemporaryDirectory(prefix="carom-kill-") as name:
        (Path(name) / "gas.toml").write_text(scene, encoding="utf-8")
        if not run.small:
            undisturbed(Path(name))  # (compiles)
        whole = undisturbed(Path(name))
    # (the run of seed 1 is killed once)
    rows = run.rows.fill("gas", [1] if run.small else range(run.count), lambda seed: one(seed, scene, whole))
    wrong = [row for row in rows if row["wrong"]]
    kills, fresh = (sum(row[name] for row in rows) for name in ("kills", "fresh"))
    run.say(
        f"{len(rows)} runs, {kills} kills ({fresh} of them before the first checkpoint): {len(wrong)} ended otherwise"
    )
    left = sorted({name for row in rows for name in row["left"]})
    run.say(f"files left behind: {', '.join(left) or 'none'}")
    return int(bool(wrong))


if __name__ == "__main__":
    raise SystemExit(main())
