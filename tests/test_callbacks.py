"""One callback everywhere, progress(done, total, text); the forms of the last release are called as they were, with a warning."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import carom
from carom.data.rebounds import make_rebounds
from carom.fitting import Setting, fit_laws
from carom.gas import Gas, GasScene, Session, Species, dense
from carom.sweeps import gas_ensemble

BALL = carom.SceneBall(radius=0.03, mass=0.2, position=(1, 0, 0), velocity=(-1, 0, 0))
WALLS = [carom.scene.Plane(point=(x, 0, 0), normal=(n, 0, 0)) for x, n in ((0, 1), (2, -1))]
SCENE = carom.Scene(gravity=0, walls=WALLS, balls=[BALL], run=carom.Run(law="mirror", max_events=200_000))
GAS = GasScene(
    container={"shape": "periodic", "size": (6, 6, 6)}, species=[{"count": 64, "radius": 0.5}],
    contacts=[{"between": ("a", "a"), "restitution": 1, "friction": 0}], run={"equilibrate": 100, "max_events": 500},
)  # fmt: skip
TABLE = make_rebounds(
    "planar",
    {"v_n_in": [1.0, 2.0, 3.0, 4.0], "v_t_in": [1.0, 2.0, 3.0, 4.0], "spin_in": [0.0] * 4, "v_n_out": [0.81, 1.59, 2.42, 3.18],
     "v_t_out": [0.71, 1.43, 2.15, 2.85], "sigma_v_n_out": 0.02, "sigma_v_t_out": 0.02},
)  # fmt: skip
ONE_GAS = [Species(carom.Ball(0.5, 1.0), 64)], (6.0, 6.0, 6.0)

# By function: the call, how many arguments the callback of the last release had, and the last (done, total, text) that is expected.
CALLS: dict[str, tuple[Callable[[Any], Any], int, tuple[Any, Any, str]]] = {
    "simulate": (lambda f: carom.simulate(SCENE, f), 2, (None, 200_000, " s")),
    "simulate_many": (
        lambda f: carom.simulate_many(SCENE.model_copy(update={"run": carom.Run(duration=2)}), [[1, 0, 0]], progress=f),
        2, (1, 1, "runs"),
    ),
    "Gas.run": (lambda f: Gas(*ONE_GAS, contacts=carom.Surface(1, 0, -1)).run(300, progress=f), 2, (300, 300, "collisions")),
    "Session.run": (lambda f: Session(GAS).run(progress=f), 1, (1.0, 1.0, "measuring")),
    "gas_ensemble": (lambda f: gas_ensemble(GAS, 2, progress=f), 2, (2, 2, "gases")),
    "dense": (lambda f: dense(np.full(60, 0.5), (4.2, 4.2, 4.2), seed=1, progress=f), 1, (None, 1.0, "growing")),
    "fit_laws": (lambda f: fit_laws(TABLE, Setting(radius=0.02), ["sticking"], bootstrap=0, progress=f), 2, (None, 1.0, "")),
}  # fmt: skip


@pytest.mark.parametrize("name", CALLS)
def test_a_callback_is_told_how_much_of_what_is_done(name: str) -> None:
    call, _count, (done, total, text) = CALLS[name]
    told: list[tuple[float, float, str]] = []
    call(lambda *one: told.append(one))
    assert told
    assert all(len(one) == 3 for one in told)
    assert told[-1][1] == total
    assert done in (None, told[-1][0])
    assert text in told[-1][2]
    assert [one[0] for one in told if not math.isnan(one[0])] == sorted(one[0] for one in told)
