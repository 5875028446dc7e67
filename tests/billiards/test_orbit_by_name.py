"""carom.orbit: the command in Python, with tables by name and of one's own, arrays and tuples."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import carom
from carom import billiards


def test_names_and_tables_of_ones_own_agree() -> None:
    start = billiards.Start((0.2, 0.1), (0.8, 0.3), 0.5)
    named = carom.orbit("stadium", 40, straight=2.0, radius=0.8, position=(0.2, 0.1), velocity=(0.8, 0.3), spin=0.5)
    table = billiards.stadium(2.0, 0.8)
    assert named.position.tobytes() == billiards.orbit(table, start, 40).position.tobytes()
    assert named.t.tobytes() == carom.orbit(table, 40, position=(0.2, 0.1), velocity=(0.8, 0.3), spin=0.5).t.tobytes()
    wedge = carom.orbit("wedge", 5, angle=60, position=(1.0, 0.0), velocity=(0.1, 1.0))
    made = billiards.orbit(billiards.wedge(60), billiards.Start((1.0, 0.0), (0.1, 1.0)), 5)
    assert wedge.position.tobytes() == made.position.tobytes()


def test_sampled_orbits_spectra_and_reversal() -> None:
    found = carom.orbit("circle", 30, orbits=4, seed=3, lyapunov=True, reverse=True)
    start = billiards.starts(billiards.circle(), 4, 3)
    assert found.position.tobytes() == billiards.orbit(billiards.circle(), start, 30).position.tobytes()
    assert found.spectrum is not None
    assert found.reversal_error is not None
    assert found.spectrum.per_bounce.tobytes() == billiards.lyapunov(billiards.circle(), start, 30).per_bounce.tobytes()
    assert found.reversal_error.tobytes() == billiards.reverse(found)[1].tobytes()
    plain = carom.orbit("circle", 3)
    assert (plain.spectrum, plain.reversal_error) == (None, None)


def test_arrays_of_states_and_vertices() -> None:
    triangle = np.array([[0.0, 0.0], [2.0, 0.0], [0.0, 2.0]])
    many = carom.orbit(
        "polygon", 3, points=triangle, position=[[0.5, 0.5], [0.4, 0.3]], velocity=(0.3, 1.0), law="mirror"
    )
    assert many.position.shape == (2, 3, 2)
    falls = carom.orbit("cylinder:circle", 4, acceleration=-1.0, position=(0.5, 0.1, 0), velocity=(0.1, 0.9, 0.3))
    assert falls.position[-1, 2] < 0


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"table": "circl"}, "did you mean 'circle'?"),
        ({"table": 3}, "figure: shape: expected one of"),
        ({"table": billiards.circle(), "radius": 2.0}, "`radius`: has no effect on a Table"),
        (
            {"table": "stadium", "sides": 3},
            "stadium: sides: expected a field that is known here, got 'sides'; known are shape, straight",
        ),
        ({"table": "circle", "kapa": 0.5}, "got 'kapa'; did you mean 'kappa'?"),
        ({"table": billiards.circle(), "lyapunof": True}, "got 'lyapunof'; did you mean 'lyapunov'?"),
        ({"table": "circle", "position": (0, 0)}, "`velocity`: expected one together with `position`"),
        ({"table": "circle", "position": (0, 0, 1), "velocity": (1, 0)}, "`position`: expected two numbers"),
        ({"table": "circle", "friction": 0.1}, "`friction`: law no-slip does not use it; `law` contact does"),
        ({"table": "circle", "law": "contact", "restitution": 0.5, "reverse": True}, "expected a reversible one"),
    ],
)
def test_faults_name_arguments(options: dict[str, Any], said: str) -> None:
    with pytest.raises(carom.CaromError) as error:
        carom.orbit(**options)
    assert len(error.value.faults) == 1
    assert said in error.value.faults[0]


def test_figures_texts_tables_of_fields_and_files_agree(tmp_path: Any) -> None:
    file = tmp_path / "room.toml"
    file.write_text('shape = "stadium"\nstraight = "150 cm"\nradius = 0.5\n')
    ways = [
        "stadium:straight=1.5,radius=50 cm", {"shape": "stadium", "straight": 1.5, "radius": 0.5}, file,
        carom.scene.figure("stadium", straight=1.5, radius=0.5), billiards.table("stadium", straight=1.5, radius=0.5),
    ]  # fmt: skip
    assert len({carom.orbit(way, 20, seed=2).position.tobytes() for way in ways}) == 1
    points = tmp_path / "room.json"
    points.write_text("[[0, 0], [2, 0], [0, 1]]")
    triangle = carom.orbit(points, 20, seed=2).position.tobytes()
    assert triangle == carom.orbit("polygon:points=0,0 2,0 0,1", 20, seed=2).position.tobytes()
