"""What is known beforehand, and what a contact is: measured, or not, and why not."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from carom.checks import Faults
from carom.tracks.contacts import Wall
from carom.tracks.fitted import Fitted, Prior
from carom.tracks.on_table import tells_rolling

__all__ = ["Contact", "Settings", "View", "tells_before"]

View = Literal["above", "side"]
NUMBERS = (int, float, np.integer, np.floating)


@dataclass(frozen=True)
class Settings:
    """What is known beforehand; None: found in the data, or taken as the literature has it."""

    radius: float | None = None
    """m; without it meetings of balls are not looked for."""
    kappa: float = 2 / 5
    view: View | None = None
    """From above (a ball on a table) or from the side (a ball in flight)."""
    walls: tuple[Wall, ...] | None = None
    noise: float | None = None
    """m, of one coordinate of one frame."""
    cloth: float | None = None
    """Coulomb's friction of the floor."""
    rolling: float | None = None
    """Rolling resistance: deceleration / g."""
    gravity: float = 9.80665
    window: float = 0.5
    """s that are looked at before and after a contact, at most."""
    blind: float | None = None
    """s on each side of a contact whose frames are left out: a soft wall takes its time, and programs smooth over it. None:
    as the frames themselves show, by how they scatter there."""
    hard: bool = False
    """Whether the two motions have to meet on the wall's line."""

    def check(self) -> None:
        """CaromError, a line a fault, where a number makes no sense."""
        faults = Faults("tracks")
        for name, low in (("kappa", 0.0), ("gravity", 0.0), ("window", 0.0), ("noise", 0.0), ("cloth", 0.0)):
            value = getattr(self, name)
            if value is not None and not (isinstance(value, NUMBERS) and low < value < np.inf):
                faults.add(name, "a number above 0", repr(value))
        if isinstance(self.kappa, NUMBERS) and 1 < self.kappa < np.inf:
            faults.add("kappa", "kappa = I/(m a^2), at most 1", repr(self.kappa))
        for name in ("radius", "rolling", "blind"):
            value = getattr(self, name)
            if value is not None and not (isinstance(value, NUMBERS) and 0 <= value < np.inf):
                faults.add(name, "a number of at least 0", repr(value))
        if self.view not in (None, "above", "side"):
            faults.add("view", "'above' or 'side'", repr(self.view))
        faults.done()


@dataclass(frozen=True, eq=False)
class Contact:
    """A ball at a wall: measured, or not, and why not."""

    track: str
    group: str
    wall: Wall
    time: float
    """s; that of the frame nearest to the wall where it was not measured."""
    before: int
    """Frames."""
    after: int
    fit: Fitted | None = None
    why: str = ""
    """Why it was not measured; empty where it was."""
    spin: tuple[float, float, float, float] = (np.nan, np.nan, np.nan, np.nan)
    """Tracked spin before and after with their errors, rad/s; NaN where none was tracked."""
    last: float = np.nan
    """s: the last frame of the fit."""
    interval: float = np.nan
    scatter: float = np.nan
    """m: what the residuals of this contact alone say of the noise."""
    planar: bool = False
    """In flight, not on a table."""
    prior: Prior = field(default_factory=Prior)
    """What the fit was told of the floor."""

    def why_not(self, stage: str) -> str:
        """Why there is no rebound of this stage (after_wall, rolling); empty where there is one."""
        if self.fit is None:
            return self.why
        return _why_not(self, stage)


def tells_before(one: Contact, fit: Fitted) -> bool:
    """Whether the frames before the contact tell if the ball slides there or rolls."""
    return fit.slid or tells_rolling(one.before, fit["t"] - float(fit.time[0]), fit.noise, fit["mu_g"])


def _why_not(one: Contact, stage: str) -> str:
    fit = one.fit
    assert fit is not None
    if -fit["vn_in"] < 3 * fit.error("vn_in"):
        return "it does not move toward the wall by more than its error"
    if one.planar:
        return "" if fit["vn_out"] > 3 * fit.error("vn_out") else "it does not leave the wall by more than its error"
    if not tells_before(one, fit):
        span = fit["t"] - float(fit.time[0])
        return f"{one.before} frames in {1e3 * span:.3g} ms before the wall do not tell whether it rolls or slides"
    if fit["slides"] < one.interval:
        # (the contact may as well have been some ms earlier or later, and the slide as much longer)
        return f"it slides for {fit['slides'] / one.interval:.1f} frames only: when it began to roll is not told, nor how it left"
    return _not_rolling(one, fit) if stage == "rolling" else _not_leaving(one, fit)


def _not_rolling(one: Contact, fit: Fitted) -> str:
    # so long that rolling on is told from sliding on
    least = 3 * one.interval + np.sqrt(10 * fit.noise / fit["mu_g"])
    if one.last - fit["t"] - fit["slides"] < least:
        return "it is not seen to roll again: it still slides at the last frame, or nearly"
    return ""


def _not_leaving(one: Contact, fit: Fitted) -> str:
    if fit.error("vn_out") <= 0.2 * max(fit["vn_out"], 1e-9):
        return ""
    frames = fit["slides"] / one.interval
    return "how fast it leaves is not told to 20 %" + (
        f": it slides for {frames:.1f} frames only" if frames < 4 else ""
    )
