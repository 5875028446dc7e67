"""Files that declare far more than they are: refused by their headers, in one line, before anything is unpacked."""

from __future__ import annotations

import io
import json
import tomllib
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from reference.commands import fails
from reference.laws_in_files import GAS, SCENE, SWEEPS

import carom
from carom import files, sweeps
from carom.gas import GasScene, Session, load_checkpoint, save_checkpoint
from carom.simulation import files as save

LIMIT, MANY = 1_000_000, 2_000_000
SAID = "expected arrays of at most 100 times the size of their file, got "


@pytest.fixture(autouse=True)
def small(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """A limit of a megabyte, so that files are made quickly."""
    monkeypatch.setattr(files, "MOST_UNPACKED", LIMIT)
    monkeypatch.chdir(tmp_path)


def refused(read: Callable[[], object]) -> str:
    """The one line of a refusal."""
    with pytest.raises(carom.CaromError) as caught:
        read()
    [line] = caught.value.faults
    return line


@pytest.fixture
def nothing_unpacked(monkeypatch: pytest.MonkeyPatch) -> None:
    """NumPy's reader of arrays is not called."""

    def load(*_given: object, **_options: object) -> None:
        raise AssertionError("arrays were read")

    monkeypatch.setattr(np, "load", load)


def start_of(name: str, capsys: pytest.CaptureFixture[str]) -> str:
    Path("gas.toml").write_text(GAS.replace('"lattice"', f'"{name}"'))
    [line] = fails(capsys, "gas", "gas.toml", "--quiet")
    return line


@pytest.mark.parametrize("name", ["position", "velocity", "species"])
@pytest.mark.usefixtures("nothing_unpacked")
def test_a_start_with_another_number_of_balls(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    arrays: dict[str, Any] = {"position": np.zeros((8, 3))}
    arrays[name] = np.full(MANY, "a") if name == "species" else np.zeros((MANY, 3), np.float32)
    np.savez_compressed("start.npz", **arrays)
    line = start_of("start.npz", capsys)
    assert line == f"carom: gas.toml: run.start: expected 8 balls, the sum over the species, got {MANY} in start.npz"


@pytest.mark.usefixtures("nothing_unpacked")
def test_a_start_whose_other_arrays_are_too_large(capsys: pytest.CaptureFixture[str]) -> None:
    np.savez_compressed("start.npz", position=np.zeros((8, 3)), more=np.zeros(MANY))
    assert f"start.npz: {SAID}16 MB in" in start_of("start.npz", capsys)
    # a name of a million characters, of which few are used
    np.savez_compressed("start.npz", position=np.zeros((8, 3)), species=np.array(["a"] * 8, dtype="U1000000"))
    assert f"start.npz: {SAID}32 MB in" in start_of("start.npz", capsys)


@pytest.mark.usefixtures("nothing_unpacked")
def test_a_header_that_is_not_of_its_data(capsys: pytest.CaptureFixture[str]) -> None:
    """NumPy makes the array that a header declares before it looks for the data."""
    part = io.BytesIO()
    np.lib.format.write_array_header_1_0(part, {"descr": "<f8", "fortran_order": False, "shape": (8, 10**12)})
    with zipfile.ZipFile("start.npz", "w") as archive:
        archive.writestr("position.npy", part.getvalue() + bytes(64))
    assert "start.npz: expected arrays saved by NumPy, got another file, or a damaged one" in start_of(
        "start.npz", capsys
    )


def test_a_member_without_a_header(capsys: pytest.CaptureFixture[str]) -> None:
    """NumPy finds it under the name of an array, and reads all of it."""
    np.savez("start.npz", velocity=np.zeros((8, 3)))
    with zipfile.ZipFile("start.npz", "a", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("position", bytes(MANY))
    assert "start.npz: expected arrays saved by NumPy, got another file, or a damaged one" in start_of(
        "start.npz", capsys
    )


@pytest.mark.slow
def test_a_checkpoint() -> None:
    save_checkpoint(Session(GasScene(**tomllib.loads(GAS))), "gas.npz")
    with np.load("gas.npz") as file:
        arrays = dict(file)
    name = next(one for one in arrays if one.startswith("gas."))
    np.savez_compressed("bomb.npz", **arrays | {name: np.zeros(MANY, arrays[name].dtype)})
    assert load_checkpoint("gas.npz").scene.count == 8
    assert f"bomb.npz: {SAID}" in refused(lambda: load_checkpoint("bomb.npz"))


def test_a_gsd_file(capsys: pytest.CaptureFixture[str]) -> None:
    """Its library makes the arrays that a frame leaves out, of the number of particles that it declares."""
    fl = pytest.importorskip("gsd.fl")
    for part, said in (
        ("particles", "expected 8 balls, the sum over the species, got 1000000000"),
        ("bonds", SAID + "100 GB in"),
    ):
        Path("start.gsd").unlink(missing_ok=True)
        with fl.open("start.gsd", "w", application="carom", schema="hoomd", schema_version=[1, 4]) as file:
            file.write_chunk("configuration/box", np.array([8, 8, 8, 0, 0, 0], np.float32))
            file.write_chunk("particles/N", np.array([8], np.uint32))
            if part != "particles":
                file.write_chunk("particles/position", np.zeros((8, 3), np.float32))
            file.end_frame()
            file.write_chunk(f"{part}/N", np.array([10**9], np.uint32))
            file.end_frame()
        assert said in start_of("start.gsd", capsys)


def test_a_saved_run() -> None:
    run = carom.simulate(carom.load_scene(SCENE))
    scene = run.scene.model_dump_json()
    about = {
        "carom_format": save.FORMAT,
        "carom": "1",
        "scene": scene,
        "end": run.end,
        "ended": run.ended,
        "sha256": "",
    }
    path = Path("run.parquet")
    pytest.importorskip("pyarrow")
    columns = {name: np.repeat(values[:1], 50_000) for name, values in save.log_columns(run.log).items()}
    save.write_parquet(columns, {"carom": json.dumps(about)}, path)
    assert f"run.parquet: {SAID}" in refused(lambda: carom.load_trajectory(path))


def test_a_table_of_rebounds() -> None:
    pa, pq = pytest.importorskip("pyarrow"), pytest.importorskip("pyarrow.parquet")
    names = ("v_n_in", "v_t_in", "v_n_out", "v_t_out")
    pq.write_table(pa.table({name: np.ones(MANY) for name in names}), "table.parquet", compression="zstd")
    assert f"table.parquet: {SAID}64 MB in" in refused(lambda: carom.data.read_rebounds("table.parquet"))


@pytest.mark.parametrize("change", [{"shape": [10**9, 3]}, {"data_type": "float32"}])
def test_a_store_whose_arrays_are_others(change: dict[str, Any]) -> None:
    pytest.importorskip("zarr")
    space = carom.Space(sweeps.ImpactCase(**SWEEPS["impact"]["impact"]), {"angle": [10.0, 20.0, 30.0]})
    carom.sweep(space, keep=["reflection_angle", "final.velocity"], store="s.zarr").run()
    meta = Path("s.zarr/zarr.json")
    whole = json.loads(meta.read_text())
    whole["consolidated_metadata"]["metadata"]["final.velocity"] |= change
    meta.write_text(json.dumps(whole))
    for look in (lambda made: made.status(), lambda made: made.verify(), lambda made: made.missing()):
        line = refused(lambda look=look: look(carom.sweep("s.zarr")))
        assert "s.zarr: expected final.velocity as this sweep makes it, float64 (3, 3), got float" in line


def test_axes_and_blocks_without_end() -> None:
    for form in (
        "{linspace = [0, 80, 1e12]}",
        "{arange = [0, 1e15]}",
        "{arange = [0, 1, 1e-15]}",
        "{geomspace = [1, 80, 1e12]}",
    ):
        Path("sweep.toml").write_text(
            f"keep = ['reflection_angle']\n[impact]\nfriction = 0.1\n[parameters]\nangle = {form}\n"
        )
        assert "expected at most 100,000,000 values, got 1e+" in refused(lambda: sweeps.load_sweep("sweep.toml"))
    space = carom.Space(sweeps.ImpactCase(friction=0.1), {"speed": sweeps.uniform(1, 2)}, repeats=10**14)
    line = refused(lambda: carom.sweep(space, keep=["reflection_angle"]))
    assert line.startswith("sweep: block: expected at most 33,554,432 blocks, got 1,525,878,907; take larger blocks")
