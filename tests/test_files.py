"""Files are complete or not there; libraries that are missing are one line that names the extra."""

import errno
import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import tomli_w
from reference.forking import Forked

import carom
from carom import files
from carom.cli import main
from carom.errors import CaromError, MissingLibraryError
from carom.files import OPTIONAL, atomic_path, install_command, require_library, require_writable, write_text
from carom.gas.snapshots import read_initial_state
from carom.laws.registry import find_law
from carom.public.own_laws import OwnLaw
from carom.tracks import judge


def fail_half_way(target, error):
    with atomic_path(target) as part:
        part.write_text("half")
        raise error


def test_a_file_that_fails_leaves_the_one_before(tmp_path):
    target = tmp_path / "a.txt"
    write_text(target, "before")
    with pytest.raises(RuntimeError):
        fail_half_way(target, RuntimeError())
    assert [(path.name, path.read_text()) for path in tmp_path.iterdir()] == [("a.txt", "before")]


def test_what_a_killed_process_left_is_removed(tmp_path):
    code = (
        "import os, sys, signal\nfrom pathlib import Path\nfrom carom.files import atomic_path\n"
        "with atomic_path(Path(sys.argv[1])) as part:\n    part.write_text('half')\n    os.kill(os.getpid(), signal.SIGKILL)\n"
    )
    target = tmp_path / "a.txt"
    done = subprocess.run([sys.executable, "-c", code, str(target)], check=False)
    assert done.returncode == -signal.SIGKILL
    (left,) = tmp_path.iterdir()
    alive = tmp_path / left.name.replace(left.name.split("-")[-2], str(os.getpid()))
    alive.mkdir()
    write_text(target, "whole")
    assert sorted(tmp_path.iterdir()) == sorted([target, alive])
    assert target.read_text() == "whole"


def test_a_link_is_followed_and_modes_are_those_of_new_files(tmp_path):
    target, link, plain = tmp_path / "a.txt", tmp_path / "link.txt", tmp_path / "plain.txt"
    target.write_text("before")
    link.symlink_to(target)
    write_text(link, "after")
    plain.write_text("")
    assert link.is_symlink()
    assert target.read_text() == "after"
    assert target.stat().st_mode == plain.stat().st_mode


def test_standard_output_and_devices(capfdbinary):
    write_text(None, "text\n")
    assert capfdbinary.readouterr().out == b"text\n"
    write_text(Path(os.devnull), "gone")
    assert not Path(os.devnull).is_file()


def test_a_full_disk_is_one_line(tmp_path):
    full = OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
    with pytest.raises(
        CaromError, match=r"a\.txt: expected room to write, got: No space left on device; free some space"
    ):
        fail_half_way(tmp_path / "a.txt", full)
    assert list(tmp_path.iterdir()) == []


def test_errors_of_other_files_are_not_those_of_the_target(tmp_path):
    with pytest.raises(FileNotFoundError), atomic_path(tmp_path / "a.txt"):
        (tmp_path / "other.txt").read_text()


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("a.pgn", "expected a name that ends with .svg or .png, got '.pgn'; did you mean '.png'?"),
        ("a", "expected a name that ends with .svg or .png, got none"),
        ("no/a.svg", "expected a folder that exists, got '{folder}/no'; make it first"),
    ],
)
def test_where_nothing_can_be_written(tmp_path, name, said):
    with pytest.raises(CaromError) as caught:
        require_writable(tmp_path / name, (".svg", ".png"))
    assert str(caught.value) == f"{tmp_path / name}: {said.format(folder=tmp_path)}"
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", OPTIONAL)
def test_a_missing_library_names_the_extra(name, monkeypatch):
    monkeypatch.setitem(sys.modules, name, None)
    prose, extra = OPTIONAL[name]
    with pytest.raises(MissingLibraryError) as caught:
        require_library(name, "here")
    assert str(caught.value) == f"here: needs {prose}, which is not installed; run: {install_command(extra)}"
    assert isinstance(caught.value, ImportError)


@pytest.mark.parametrize(
    ("origin", "requirement"),
    [
        ('{"dir_info": {}, "url": "file://FOLDER"}', "'FOLDER[plot]'"),
        ('{"dir_info": {}, "url": "file:///nowhere/carom"}', "'.[plot]'  # in a clone of carom"),
        (
            '{"vcs_info": {"vcs": "git", "commit_id": "a1"}, "url": "https://host/carom.git"}',
            "'carom[plot] @ git+https://host/carom.git@a1'",
        ),
        ("", "'carom[plot]'"),  # from an index
    ],
)
@pytest.mark.skipif(os.name == "nt", reason="a shell of Windows has other quotes")
def test_an_extra_is_installed_from_where_carom_came_from(origin, requirement, tmp_path, monkeypatch):
    record = {"direct_url.json": origin.replace("FOLDER", str(tmp_path)), "INSTALLER": "pip\n"}
    monkeypatch.setattr(files, "__file__", str(tmp_path / "lib" / "site-packages" / "carom" / "files.py"))
    monkeypatch.setattr(files, "_metadata", record.get)
    monkeypatch.setattr(files, "_is_installed", {"pip": True}.get)
    monkeypatch.setattr(sys, "executable", "/opt/my python")
    found = requirement.replace("FOLDER", str(tmp_path))
    assert install_command("plot") == f"'/opt/my python' -m pip install {found}"
    # an environment made by `python -m venv --without-pip`, or by uv
    monkeypatch.setattr(files, "_is_installed", {"pip": False}.get)
    monkeypatch.setattr(sys, "prefix", "/home/me/.venv")
    monkeypatch.setattr(sys, "_base_executable", "/base/python3", raising=False)
    assert install_command("plot") == f"/base/python3 -m pip --python /home/me/.venv install {found}"
    record["INSTALLER"] = "uv"
    assert install_command("plot") == f"uv pip install --python /home/me/.venv {found}"


def test_an_extra_is_installed_from_the_clone_that_carom_runs_from():
    if not (clone := Path(files.__file__).parents[2]).joinpath("pyproject.toml").is_file():
        pytest.skip("carom is installed")
    assert f"{clone}[plot]" in install_command("plot")


def test_fit_without_scipy_is_one_line(monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "scipy", None)
    monkeypatch.setattr(sys, "argv", ["carom", "fit", "kharaz2001"])
    with pytest.raises(SystemExit) as ended:
        main()
    lines = [line for line in capsys.readouterr().err.splitlines() if not line.startswith("note: ")]
    assert ended.value.code == 2
    assert lines == [f"carom: fit: needs SciPy, which is not installed; run: {install_command('fit')}"]


BASE = """
import sys

sys.argv = ["carom", *WORDS]

class Base:

    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in ("scipy", "matplotlib"):
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)

sys.meta_path.insert(0, Base())
from carom import files
from carom.cli import main
main()
"""


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["fit", "kharaz2001"], f"carom: fit: needs SciPy, which is not installed; run: {install_command('fit')}"),
        (
            ["fit", "none.csv"],
            "carom: none.csv: expected a file, got: No such file or directory\n"
            f"carom: fit: needs SciPy, which is not installed; run: {install_command('fit')}",
        ),
        (
            ["compare", "--plot", "a.svg"],
            f"carom: --plot: needs Matplotlib, which is not installed; run: {install_command('plot')}",
        ),
        (
            ["orbit", "circle", "--plot", "a.svg"],
            f"carom: --plot: needs Matplotlib, which is not installed; run: {install_command('plot')}",
        ),
    ],
)
def test_the_base_install_names_the_extra(words: list[str], said: str, tmp_path: Path, forked: Forked) -> None:
    code, out, err = forked(tmp_path, "-c", BASE.replace("WORDS", repr(words)))
    assert (code, out, err.splitlines()) == (2, "", said.splitlines())


def test_pictures_need_no_scipy(tmp_path: Path, forked: Forked) -> None:
    """Matplotlib alone is what the extra of pictures installs."""
    code = "import sys; sys.modules['scipy'] = None; from carom import plot; print(all(getattr(plot, one) for one in plot.__all__))"
    ended, out, err = forked(tmp_path, "-c", code)
    assert (ended, out.strip(), err) == (0, "True", "")


READERS = {
    "scene": carom.load_scene,
    "gas": carom.gas.load_gas,
    "sweep": carom.sweeps.load_sweep,
    "checkpoint": carom.gas.load_checkpoint,
    "start.csv": lambda path: read_initial_state(Path(path), 3, (1.0, 1.0, 1.0)),
    "run.parquet": carom.load_trajectory,
    "rebounds": carom.data.read_rebounds,
    "rebounds.parquet": carom.data.read_rebounds,
    "states": carom.predict,
    "states.pq": carom.predict,
    "tracks": carom.tracks.read_tracks,
    "paths": lambda path: judge(path, radius=0.03),
    "paths.json": lambda path: judge(path, radius=0.03),
    "films": lambda path: carom.fit([path, path], radius=0.03),
    "figure.json": lambda path: carom.billiards.table(Path(path)),
    "figure.toml": lambda path: carom.billiards.table(Path(path)),
    "law.py": lambda path: find_law(OwnLaw(f"{path}:law")),
    "shot.json": carom.interop.pooltool.read,
    "shot.msgpack": carom.interop.pooltool.read,
}


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs pipes with names")
@pytest.mark.parametrize("name", READERS)
def test_no_reader_opens_what_has_no_end(name, tmp_path):
    """A pipe would wait for ever, a device fill the memory; what is expected, and where, differs from reader to reader."""
    path = tmp_path / name
    os.mkfifo(path)
    with pytest.raises(CaromError) as caught:
        READERS[name](path)
    assert {"a device or a pipe"} == {one.got for one in caught.value.records}
    path.unlink()
    path.symlink_to("/dev/zero")
    with pytest.raises(CaromError):
        READERS[name](path)


@pytest.mark.parametrize("name", ["scene", "gas", "sweep", "figure.json", "law.py", "tracks", "rebounds", "paths.json"])
def test_a_file_that_would_fill_the_memory_is_not_read(name, tmp_path):
    path = tmp_path / name
    with path.open("wb") as file:
        file.truncate(1 << 42)  # (of holes: it takes no room on the disk)
    with pytest.raises(CaromError) as caught:
        READERS[name](path)
    assert {one.got for one in caught.value.records} == {"4.4 TB"}


def test_a_sweep_that_names_a_device(tmp_path):
    for kind, given in (("scene", "/dev/zero"), ("gas", "/dev/urandom"), ("scene", "a\0b")):
        sweep = {kind: given, "keep": ["final.position"], "parameters": {"balls.0.radius": [1.0]}}
        (tmp_path / "s.toml").write_text(tomli_w.dumps(sweep))
        with pytest.raises(CaromError) as caught:
            carom.sweeps.load_sweep(tmp_path / "s.toml")
        assert len(caught.value.faults) == 1


def crowd():
    scene = carom.gas.gas_text().replace("count = 1000", "count = 10_000_000").replace("12.6", "500.0")
    return carom.gas.load_gas(scene)


def gas_of_many():
    many = [carom.gas.Species(carom.Ball(0.5, 1.0), 10_000_000)]
    return carom.gas.Gas(many, (500.0,) * 3, contacts=carom.Surface(1, 0, 0))


def wide_sweep():
    space = carom.Space(
        carom.new_scene(), dict.fromkeys(("floor.friction", "floor.restitution"), np.linspace(0, 1, 3000))
    )
    return carom.sweep(space, keep=["final.position"]).run()


def many_events():
    velocity = np.tile([1.0, 0.0, 0.0], (100_000, 1))
    return carom.simulate_many(carom.new_scene(), velocity=velocity, events=100)


LARGE = {
    "gas in a file": (crowd, "species"),
    "gas": (gas_of_many, "species"),
    "orbits": (lambda: carom.orbit("circle", orbits=1000, bounces=10_000), "bounces"),
    "starts": (lambda: carom.orbit("circle", orbits=8_000_000, bounces=1), "count"),
    "sweep": (wide_sweep, "points"),
    "events of runs": (many_events, "events"),
}


@pytest.mark.parametrize("name", LARGE)
def test_what_would_fill_the_memory_is_refused_before_it_is_made(name, monkeypatch):
    make, field = LARGE[name]
    monkeypatch.setattr(files, "memory_left", lambda: 2e8)
    with pytest.raises(CaromError) as caught:
        make()
    (one,) = caught.value.records
    assert one.field == field
    assert re.search(r"which fill 200 MB$", one.expected)


def test_the_memory_of_this_machine_is_known():
    assert 1e6 < files.memory_left() < 1e15
