"""The explorer's engine in Chromium: how soon it is ready, how long all laws of the default page take at a change, 18,000 shots.

    python benchmarks/explorer.py

Debian's Chromium (or the one that CAROM_CHROMIUM names) without a window, one page, one thread; Playwright drives it (extra
dev). The median and the 95th percentile of 300 changes, after 100 to warm up; goal: 4 ms for the runs of all six laws.
"""

from __future__ import annotations

import base64
import json
import os
import shutil
from pathlib import Path
from typing import Any

from aim import position
from rows import run_script

import carom
from carom.explorer.module import engine_bytes, engine_layout
from carom.scene.scene import scene_dict

ROOT = Path(__file__).parents[1]
SITE = "http://carom.test"
LAWS = ["mirror", "conventional", "no-slip", "two-step", "maw", "stronge"]
TYPES = {".js": "text/javascript", ".json": "application/json", ".wasm": "application/wasm"}
MEASURE = """async ({ wasm, layout, scenes, laws }) => {
    const { loadEngine } = await import("/web/engine/engine.js");
    const bytes = Uint8Array.from(atob(wasm), (c) => c.charCodeAt(0));
    const ready = [];
    let engine = null;
    for (let i = 0; i < 5; i++) {
        const begin = performance.now();
        engine = await loadEngine(bytes, layout);
        ready.push(performance.now() - begin);
    }
    const angles = Array.from({ length: 30 }, (_, i) => 3 * i);
    const found = {};
    for (const [name, scene] of Object.entries(scenes)) {
        const accepted = laws.filter((law) => { try { return engine.run(scene, law); } catch { return false; } });
        const work = {
            runs: (one) => accepted.forEach((law) => engine.run(one, law)),
            compare: (one) => engine.compare(one),
            curves: (one) => laws.forEach((law) => engine.curve(law, one, angles)),
        };
        found[name] = { laws: accepted, events: accepted.map((law) => engine.run(scene, law).events.length) };
        for (const [what, run] of Object.entries(work)) {
            const times = [];
            for (let i = 0; i < 400; i++) {
                const [x, y, z] = scene.balls[0].velocity;
                const velocity = [x, y * (1 + 1e-4 * i), z];
                const one = { ...scene, balls: [{ ...scene.balls[0], velocity }, ...scene.balls.slice(1)] };
                const begin = performance.now();
                run(one);
                if (i >= 100) times.push(performance.now() - begin);
            }
            times.sort((a, b) => a - b);
            found[name][what] = [times[150], times[285]];
        }
    }
    return { ready: ready.map((x) => Math.round(10 * x) / 10), found };
}"""


SHOTS = 18_000
IN_A_WORKER = """({ site, ...asked }) => new Promise((answer, fail) => {
    const text = `onmessage = async ({ data: { wasm, layout, scene, count } }) => {
        const { loadEngine } = await import("${site}/web/engine/engine.js");
        const engine = await loadEngine(Uint8Array.from(atob(wasm), (c) => c.charCodeAt(0)), layout);
        const starts = Array.from({ length: count }, (_, i) => {
            const [angle, speed] = [(2 * Math.PI * 0.6180339887 * i) % (2 * Math.PI), 0.5 + (5.5 * i) / count];
            return { velocity: [speed * Math.cos(angle), speed * Math.sin(angle), 0] };
        });
        engine.shots(scene, starts.slice(0, 500));
        const begin = performance.now();
        const found = engine.shots(scene, starts);
        postMessage([(performance.now() - begin) / 1000, found.reduce((sum, one) => sum + one.length, 0)]);
    }`;
    const worker = new Worker(URL.createObjectURL(new Blob([text], { type: "text/javascript" })), { type: "module" });
    worker.onmessage = ({ data }) => answer(data);
    worker.onerror = (error) => fail(new Error(error.message));
    worker.postMessage(asked);
})"""


def scenes() -> dict[str, Any]:
    """The default page's scene (the paper's example), and three balls on a table."""
    wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=1.0, friction=float("inf"))
    ball = carom.SceneBall(
        radius=0.02625, mass=0.1406, position=(0.3, -0.28), velocity=(-(0.5**0.5), 0.5**0.5), rolling=True
    )
    floor = carom.Floor(friction=float("inf"))
    paper = carom.Scene(floor=floor, walls=[wall], balls=[ball], run=carom.Run(duration=0.9))
    table = carom.load_scene(ROOT / "docs" / "scenes" / "three_balls.toml")
    return {"paper": scene_dict(paper), "three balls": scene_dict(table)}


def main() -> None:
    from playwright.sync_api import sync_playwright

    path = os.environ.get("CAROM_CHROMIUM") or shutil.which("chromium") or shutil.which("chromium-browser")
    if path is None:
        raise ImportError("expected Chromium, got none")

    def serve(route: Any) -> None:
        file = ROOT / route.request.url.removeprefix(SITE).lstrip("/")
        if file.is_file():
            route.fulfill(body=file.read_bytes(), content_type=TYPES.get(file.suffix, "text/plain"))
        else:
            route.fulfill(body="<!doctype html><title>engine</title>", content_type="text/html")

    with sync_playwright() as player:
        browser = player.chromium.launch(executable_path=path, args=["--no-sandbox"])
        page = browser.new_page()
        page.route(f"{SITE}/**", serve)
        page.goto(f"{SITE}/")
        wasm = base64.b64encode(engine_bytes()).decode()
        asked = {"wasm": wasm, "layout": engine_layout(), "scenes": scenes(), "laws": LAWS}
        answer = json.loads(
            page.evaluate(f"async (text) => JSON.stringify(await ({MEASURE})(JSON.parse(text)))", json.dumps(asked))
        )
        shots = {name: asked[name] for name in ("wasm", "layout")} | {
            "scene": scene_dict(position()),
            "count": SHOTS,
            "site": SITE,
        }
        seconds, impacts = page.evaluate(f"async (text) => ({IN_A_WORKER})(JSON.parse(text))", json.dumps(shots))
        print(f"Chromium {browser.version}")
        browser.close()
    print(f"engine ready after {', '.join(map(str, answer['ready']))} ms (first and later loads)")
    print(
        f"{SHOTS:,} shots at a three-cushion position with real noses, in a worker: {seconds:.2f} s, {impacts:,} impacts"
    )
    for name, found in answer["found"].items():
        print(f"{name} ({', '.join(map(str, found['events']))} events under {', '.join(found['laws'])}):")
        for what in ("runs", "compare", "curves"):
            median, late = found[what]
            print(f"  {what + ' of all laws':22} {median:6.2f} ms, 95th percentile {late:6.2f} ms")


if __name__ == "__main__":
    run_script(main)
