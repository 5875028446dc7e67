"""SLEAP: the analysis as CSV, one row per frame and track, with node.x, node.y; pixels, the second axis down, frame numbers."""

from __future__ import annotations

from dataclasses import replace

from carom.tracks.formats import tables as columns
from carom.tracks.formats.tables import Calibration, first_rows, require_calibration
from carom.tracks.track import Track

PROGRAM = "SLEAP"


def matches(text: str) -> bool:
    """Return whether there are columns frame_idx and instance.score."""
    return {"frame_idx", "instance.score"} <= {cell.strip() for row in first_rows(text, 1) for cell in row}


def read(name: str, text: str, calibration: Calibration) -> list[Track]:
    """Read one track per node and track."""
    require_calibration(
        name, PROGRAM, calibration, scale="since its positions are in pixels",
        rate="since it has frame numbers but no times",
    )  # fmt: skip
    return columns.read(name, text, replace(calibration, down=calibration.down is not False))
