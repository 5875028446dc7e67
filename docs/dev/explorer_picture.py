"""Draw the pictures of the explorer that README and docs show, light and dark: Chromium, at twice the size."""

from __future__ import annotations

import io
import shutil
import tempfile
from pathlib import Path

from PIL import Image
from playwright.sync_api import sync_playwright

import carom

SIZE = {"width": 1280, "height": 720}
ARGUMENTS = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]


def main() -> None:
    """Write docs/images/explorer.png, and its dark copy."""
    images = Path(__file__).parents[1] / "images"
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        file = carom.explore().save(Path(folder) / "page.html")
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=ARGUMENTS)
        for scheme, path in (("light", images / "explorer.png"), ("dark", images / "dark/explorer.png")):
            page = browser.new_page(viewport=SIZE, device_scale_factor=2, color_scheme=scheme)
            page.goto(file.as_uri())
            page.wait_for_function("() => document.documentElement.dataset.ready")
            page.evaluate(
                "() => { const time = document.getElementById('time'); time.value = 7600; time.dispatchEvent(new Event('input')); }"
            )
            page.wait_for_timeout(1000)
            picture = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
            small = picture.resize((SIZE["width"], SIZE["height"]), Image.Resampling.LANCZOS)
            few = small.quantize(256, method=Image.Quantize.MAXCOVERAGE, kmeans=2, dither=Image.Dither.NONE)
            few.save(path, optimize=True)
        browser.close()


if __name__ == "__main__":
    main()
