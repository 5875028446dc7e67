"""The explorer's page in Chromium, drawn by the processor: how soon it is ready, what a change takes, how long frames are.

    python benchmarks/explorer_page.py

Debian's Chromium without a window, 1280 x 720, WebGL by SwiftShader; Playwright drives it (extra dev). Frames are those of three
balls under four laws while time runs. Goals: ready within 300 ms after the file is loaded, 95 % of frames within 50 ms.
"""

from __future__ import annotations

import shutil
import tempfile
from pathlib import Path

from rows import run_script

import carom

ARGUMENTS = [
    "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-gpu-compositing",
]  # fmt: skip
READY = """() => {
    const [loaded] = performance.getEntriesByType("navigation");
    return performance.getEntriesByName("ready")[0].startTime - loaded.responseEnd;
}"""
FRAMES = """async () => {
    const found = [];
    document.getElementById("play").click();
    let before = await new Promise(requestAnimationFrame);
    while (found.length < 300) {
        const now = await new Promise(requestAnimationFrame);
        found.push(now - before);
        before = now;
    }
    return found.sort((a, b) => a - b);
}"""
CHANGES = """async () => {
    const slider = document.getElementById("control-angle");
    const found = [];
    for (let i = 0; i < 120; i++) {
        const begin = performance.now();
        slider.value = 12 + 0.01 * i;
        slider.dispatchEvent(new Event("input", { bubbles: true }));
        await new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
        found.push(performance.now() - begin);
    }
    return found.slice(20).sort((a, b) => a - b);
}"""


def main() -> None:
    """Print the three."""
    from playwright.sync_api import sync_playwright

    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        file = carom.explore().save(Path(folder) / "page.html")
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=ARGUMENTS)
        ready = []
        for _ in range(5):
            page = browser.new_page(viewport={"width": 1280, "height": 720})
            page.goto(file.as_uri())
            page.wait_for_function("() => document.documentElement.dataset.ready")
            ready.append(page.evaluate(READY))
        print("ready after the file is loaded, ms:", " ".join(f"{x:.0f}" for x in sorted(ready)))
        page.select_option("#preset", label="Three cushions")
        for law in ("maw", "stronge"):
            page.locator(f"#law-{law}").check()
        page.wait_for_timeout(500)
        for what, script in (("change and frame", CHANGES), ("frame while time runs", FRAMES)):
            times = page.evaluate(script)
            shares = [times[int(share * (len(times) - 1))] for share in (0.05, 0.25, 0.5, 0.75, 0.95, 0.99)]
            print(f"{what}, ms, at 5, 25, 50, 75, 95, 99 %:", " ".join(f"{x:.1f}" for x in shares))
        browser.close()


if __name__ == "__main__":
    run_script(main)
