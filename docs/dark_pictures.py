"""Copies of the README's pictures for dark pages, in docs/images/dark; GitHub shows them where the reader has chosen a dark theme.

    python docs/dark_pictures.py

A copy has no background, and lightness is inverted while hues are kept: black becomes #f0f6fc, white #0d1117, GitHub's dark page.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

ROOT = Path(__file__).parents[1]
IMAGES = ROOT / "docs" / "images"
LIGHT, DARK = np.array([240, 246, 252]) / 255, np.array([13, 17, 23]) / 255
# (W3C, Filter Effects: hue-rotate by 180 degrees)
TURNED = np.array([[-0.574, 1.43, 0.144], [0.426, 0.43, 0.144], [0.426, 1.43, -0.856]])


GAMMA = 0.7  # brightens what is between, as yellow and green would be too dark


def shade() -> str:
    """Return the SVG filter: invert, turn hues back, brighten, and map to the two ends."""
    inverted = np.hstack([-TURNED, np.zeros((3, 1)), np.ones((3, 1))])
    values = " ".join(f"{x:.4g}" for x in [*inverted.ravel(), 0, 0, 0, 1, 0])
    ends = "".join(
        f'<feFunc{name} type="gamma" exponent="{GAMMA}" amplitude="{light - dark:.4g}" offset="{dark:.4g}"/>'
        for name, light, dark in zip("RGB", LIGHT, DARK, strict=True)
    )
    return (
        '<filter id="dark" color-interpolation-filters="sRGB">'
        f'<feColorMatrix values="{values}"/><feComponentTransfer>{ends}</feComponentTransfer></filter>'
    )


def dark(svg: str) -> str:
    """Return a Matplotlib picture for a dark page."""
    svg, count = re.subn(r'<g id="figure_1">', f'{shade()}\n <g id="figure_1" filter="url(#dark)">', svg, count=1)
    if count != 1:
        raise ValueError("expected a figure of Matplotlib")
    # backgrounds: the first patch of the figure and of each of its axes, a white rectangle
    corner = r"[ML] [\d.]+ [\d.]+ \n"
    return re.sub(
        rf'(<g id="(?:figure|axes)_\d+"[^>]*>\s*<g id="patch_\d+">\s*<path d="(?:{corner}){{4}}z\n" style="fill: )#ffffff',
        r"\1none",
        svg,
    )


def pictures() -> list[Path]:
    """Return the drawings that the README shows."""
    names = re.findall(r'src="docs/images/(\w+\.svg)"', (ROOT / "README.md").read_text(encoding="utf-8"))
    return [IMAGES / name for name in names]


if __name__ == "__main__":
    (IMAGES / "dark").mkdir(exist_ok=True)
    for picture in pictures():
        copy = IMAGES / "dark" / picture.name
        copy.write_text(dark(picture.read_text(encoding="utf-8")), encoding="utf-8", newline="\n")
