"""Sweeps on a GPU: by numba-cuda's simulator the bits of the cores; as assembly for a real one; and what is refused."""

from __future__ import annotations

import os
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest
from reference.exploring import tried
from reference.sweep_scenes import table_scene

import carom
from carom import sweeps

needs_numba_cuda = pytest.mark.skipif(
    find_spec("numba_cuda") is None, reason="numba-cuda is not installed (extra cuda)"
)
needs_nvvm = pytest.mark.skipif(find_spec("nvidia") is None, reason="NVIDIA's compiler is not installed (extra cuda)")


def program(task: str, **more: str) -> str:
    """What ``reference.sweeps_on_gpu`` writes, in a process of its own."""
    path = os.pathsep.join([str(Path(__file__).parents[1]), *filter(None, sys.path)])
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-m", "reference.sweeps_on_gpu", task],
        env={**os.environ, "PYTHONPATH": path, **more}, capture_output=True, text=True, check=False, timeout=600,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr[-2000:]
    return done.stdout


@needs_numba_cuda
def test_the_simulator_gives_the_bits_of_the_cores() -> None:
    lines = program("compare", NUMBA_ENABLE_CUDASIM="1").splitlines()
    assert [line.rpartition(": ")[2] for line in lines] == ["the same bits"] * 7
    assert "a table: 4 points, 4 with an outcome" in lines[0]


@needs_numba_cuda
@needs_nvvm
def test_assembly_rounds_every_product_by_itself() -> None:
    lines = program("assemble").splitlines()
    assert len(lines) == tried(2, 5)  # a loop over numbers and one over records; the long ones take half a minute
    for line in lines:
        name, found = line.split(": ")
        handed, *numbers, size = found.split()
        counts = dict(zip(("rounded", "contractible", "bytewise"), map(int, numbers), strict=True))
        # (what the linker gets in another form it compiles again, with products and sums fused)
        assert handed == "assembly", name
        # (10 MB, and minutes to compile, where NVVM copies functions into all their callers)
        assert float(size) < 5, name
        assert counts["rounded"] > 10, name
        assert counts["contractible"] == 0, name
        # (so numbers of records are read whose alignment is not known)
        assert counts["bytewise"] == 0, name


@pytest.fixture
def no_gpu(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("carom.sweeps.gpu.why_no_gpu", lambda: "got none (no driver)")


@pytest.fixture
def a_gpu(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("carom.sweeps.gpu.why_no_gpu", lambda: "")


def space_of(subject: object, path: str = "walls.*.friction") -> carom.Space:
    return carom.Space(subject, {path: [0.1, 0.2]})


def test_without_a_gpu_it_says_so(tmp_path: Path, no_gpu: None) -> None:
    with pytest.raises(carom.CaromError) as error:
        carom.sweep(space_of(table_scene()), ["final.phase"]).run(on="cuda")
    assert error.value.faults == (
        "sweep: run: on='cuda': expected a GPU of NVIDIA's and its driver, got none (no driver); or use on='cores'",
    )
    (tmp_path / "s.toml").write_text(
        'keep = ["reflection_angle"]\n[impact]\nangle = 30\n[parameters]\nfriction = [0.1, 0.2]\n'
    )
    # (a machine with a GPU has to be kept from using it)
    said = carom_sweep(tmp_path, "s.toml", "--on", "cuda", CUDA_VISIBLE_DEVICES="-1")
    assert "expected a GPU of NVIDIA's and its driver, got" in said
    assert not (tmp_path / "s.zarr").exists()
    assert "--on: expected cores, cuda, or dask:ADDRESS" in carom_sweep(tmp_path, "s.toml", "--on", "gpu")


def carom_sweep(folder: Path, *words: str, **more: str) -> str:
    """What ``carom sweep run`` says when it refuses."""
    done = subprocess.run(
        [sys.executable, "-m", "carom", "sweep", "run", *words],
        cwd=folder, env={**os.environ, "COLUMNS": "300", **more}, capture_output=True, text=True, check=False, timeout=120,
    )  # fmt: skip
    assert done.returncode == 2, done.stdout
    return done.stderr


def test_laws_that_are_called_by_address_are_refused_by_name(no_gpu: None) -> None:
    scene = table_scene(law="mathavan2010")
    with pytest.raises(carom.CaromError) as error:
        carom.sweep(space_of(scene), ["final.phase"]).run(on="cuda")
    first, second = error.value.faults  # both faults at once
    assert "got mathavan2010, which is called by its address; use on='cores'" in first
    assert "expected a GPU" in second
    swept = carom.Space(table_scene(), {"run.law": ["mirror", "stronge"]})
    with pytest.raises(carom.CaromError, match="got stronge, which"):
        carom.sweep(swept, ["final.phase"]).run(on="cuda")


def test_orbits_and_gases_are_refused(a_gpu: None) -> None:
    space = carom.Space(sweeps.OrbitCase(table="stadium", bounces=50), {"table.straight": [0.5, 1.0]})
    with pytest.raises(carom.CaromError, match="expected a sweep of a scene or of impacts, got an orbit"):
        carom.sweep(space, ["time"]).run(on="cuda")


def test_blocks_of_cores_and_of_a_gpu_are_not_mixed(tmp_path: Path, a_gpu: None) -> None:
    store = str(tmp_path / "s.zarr")
    carom.sweep(space_of(table_scene(duration=0.5)), ["final.phase"], store).run()
    with pytest.raises(
        carom.CaromError, match=r"expected on='cores', where its blocks were computed .*, got on='cuda'"
    ):
        carom.sweep(store).run(on="cuda")
    assert carom.sweep(store).verify() == []
