"""Draw the pictures of the explorer that README and docs show, light and dark, and the moving one: Chromium, at twice the size."""

from __future__ import annotations

import io
import shutil
import tempfile
from pathlib import Path

from PIL import Image
from playwright.sync_api import Page, sync_playwright

import carom

SIZE = {"width": 1280, "height": 720}
ARGUMENTS = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]


FRAMES = 20


def at_time(page: Page, value: int) -> Image.Image:
    """Return the page with its slider of time at a value up to 10,000."""
    page.evaluate(
        "value => { const time = document.getElementById('time'); time.value = value; time.dispatchEvent(new Event('input')); }",
        value,
    )
    page.wait_for_timeout(300)
    return Image.open(io.BytesIO(page.screenshot())).convert("RGB")


def moving(page: Page, path: Path) -> None:
    """Write the page from the start of its run to the end as a GIF."""
    pictures = [
        at_time(page, 10000 * k // FRAMES).resize((768, 432), Image.Resampling.LANCZOS) for k in range(FRAMES + 1)
    ]
    colours = pictures[-1].quantize(256, method=Image.Quantize.MAXCOVERAGE, kmeans=2, dither=Image.Dither.NONE)
    first, *frames = (one.quantize(palette=colours, dither=Image.Dither.NONE) for one in pictures)
    first.save(path, save_all=True, append_images=frames, duration=[100] * FRAMES + [1500], loop=0, optimize=True)


def main() -> None:
    """Write docs/images/explorer.png, its dark copy, and explorer.gif."""
    images = Path(__file__).parents[1] / "images"
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        file = carom.explore().save(Path(folder) / "page.html")
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=ARGUMENTS)
        for scheme, path in (("light", images / "explorer.png"), ("dark", images / "dark/explorer.png")):
            page = browser.new_page(viewport=SIZE, device_scale_factor=2, color_scheme=scheme)
            page.goto(file.as_uri())
            page.wait_for_function("() => document.documentElement.dataset.ready")
            page.wait_for_timeout(1000)
            picture = at_time(page, 7600)
            small = picture.resize((SIZE["width"], SIZE["height"]), Image.Resampling.LANCZOS)
            few = small.quantize(256, method=Image.Quantize.MAXCOVERAGE, kmeans=2, dither=Image.Dither.NONE)
            few.save(path, optimize=True)
            if scheme == "light":
                moving(page, images / "explorer.gif")
        browser.close()


if __name__ == "__main__":
    main()
