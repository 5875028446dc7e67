"""How large a file of snapshots becomes, estimated before the run, and whether that is wanted and fits on the disk."""

from __future__ import annotations

import math
import shutil
from pathlib import Path
from typing import NamedTuple

from carom.errors import CaromError
from carom.formatting import format_bytes, format_number
from carom.gas.contact_forms import ANY
from carom.gas.sampling import Every, LogTimes
from carom.gas.scene import GasScene

__all__ = ["MAX_BYTES", "SnapshotSize", "expected_snapshots", "mean_free_time", "require_size"]

MAX_BYTES = 1e9  # of a file of snapshots, unless a user allows more
# Per ball and frame, in single precision: position and velocity; angular momentum; the periods crossed. Per frame: the index.
MOVING, SPINNING, PERIODIC, INDEX = 24, 16, 12, 500


class SnapshotSize(NamedTuple):
    """Expected number of frames (nan where nothing is known of it), and bytes of each."""

    frames: float
    frame_bytes: float

    @property
    def total(self) -> float:
        """Bytes of the file."""
        return self.frames * self.frame_bytes

    def describe(self, balls: int) -> str:
        """Return one phrase."""
        frames = f"{self.frames:,.0f}" if self.frames < 1e12 else format_number(self.frames, 2)
        each = f"{frames} frames of {balls:,} balls, {format_bytes(self.frame_bytes)} each"
        return f"about {format_bytes(self.total)}: {each}"


def expected_snapshots(scene: GasScene, every: Every) -> SnapshotSize:
    """Return the expected size of the snapshots of a run, at every so many collisions, so much time, or equal ratios of time.

    Where a run is limited by collisions and snapshots are spaced in time, or the other way round, the rate of collisions is that of
    Enskog's theory, with Haff's law for gases that cool: an estimate within a factor of two or so of uniform gases.

    Examples
    --------
    >>> from carom.gas import GasScene
    >>> from carom.gas.snapshot_sizes import expected_snapshots
    >>> contact = {"between": ("a", "a"), "restitution": 1, "friction": 0}
    >>> scene = GasScene(
    ...     container={"shape": "periodic", "size": (6, 6, 6)}, species=[{"count": 64, "radius": 0.5}], contacts=[contact],
    ...     run={"max_events": 10_000},
    ... )
    >>> expected_snapshots(scene, 100).frames, expected_snapshots(scene, 100).frame_bytes
    (101, 2804)
    """
    run = scene.run
    lengths: list[float] = []
    if isinstance(every, int):
        lengths += [run.max_events] if run.max_events is not None else []
        lengths += [_collisions(scene, run.duration)] if run.duration is not None else []
    else:
        lengths += [run.duration] if run.duration is not None else []
        lengths += [_duration(scene, run.max_events)] if run.max_events is not None else []
    per_ball = MOVING + SPINNING * scene.spins_change + PERIODIC * any(scene.container.geometry.periodic)
    length = min((one for one in lengths if not math.isnan(one)), default=math.nan)
    frames = every.count(length) if isinstance(every, LogTimes) else length / every
    return SnapshotSize(math.floor(frames) + 1 if frames < 1e15 else frames, scene.count * per_ball + INDEX)


def _mean_speed(scene: GasScene) -> float:
    """Return the thermal speed along an axis of balls of the mean mass and temperature."""
    mass = sum(one.total_mass(scene.container.dimensions) for one in scene.species)
    temperature = sum(one.count * one.temperature for one in scene.species)
    return math.sqrt(temperature / mass)


def _rate(scene: GasScene) -> float:
    """Return the initial rate of collisions of a ball with others: Enskog's for balls of the mean size, mass and temperature."""
    count, axes = scene.count, scene.container.dimensions

    diameter = 2 * sum(one.count * float(one.radii.mean()) for one in scene.species) / count
    speed = _mean_speed(scene)
    density, filled = count / scene.container.geometry.volume, min(scene.packing_fraction, 0.7)
    if axes == 2:
        contact = (1 - 7 * filled / 16) / (1 - filled) ** 2
        return 2 * math.sqrt(math.pi) * density * diameter * speed * contact
    contact = (1 - filled / 2) / (1 - filled) ** 3
    return 4 * math.sqrt(math.pi) * density * diameter**2 * speed * contact


def _cooling(scene: GasScene) -> float:
    """Return by how much ln v falls per collision of a ball; 0 for gases that are supplied with energy."""
    if scene.thermostat is not None or scene.drives or any(scene.gravity_vector) or scene.shear_rate:
        return 0.0
    names, speed = {one.name for one in scene.species}, _mean_speed(scene)
    lost = [1 - one.restitution_at(speed) ** 2 for one in scene.contacts if set(one.between) <= {ANY, *names}]
    return sum(lost) / len(lost) / (2 * scene.container.dimensions) if lost else 0.0


def mean_free_time(scene: GasScene) -> float:
    """Return the expected mean free time of a ball at the start; nan for a gas at rest, or of one ball."""
    rate = _rate(scene) if scene.count > 1 else 0.0
    return 1 / rate if rate > 0 else math.nan


def _duration(scene: GasScene, collisions: float) -> float:
    """Return the expected time of so many collisions."""
    rate, cooling = _rate(scene), _cooling(scene)
    each = 2 * collisions / scene.count
    if rate == 0:  # (a gas that starts at rest)
        return math.nan
    if cooling == 0:
        return each / rate
    return math.expm1(cooling * each) / (cooling * rate) if cooling * each < 700 else math.inf


def _collisions(scene: GasScene, time: float) -> float:
    """Return the expected number of collisions in so much time."""
    rate, cooling = _rate(scene), _cooling(scene)
    if rate == 0:
        return math.nan
    each = rate * time if cooling == 0 else math.log1p(cooling * rate * time) / cooling
    return each * scene.count / 2


def require_size(path: Path, size: SnapshotSize, balls: int, most: float) -> None:
    """Raise CaromError where snapshots are expected to be larger than ``most`` bytes, or than the disk has room for."""
    said = size.describe(balls)
    if size.total > most:
        raise CaromError(
            f"{path}: expected snapshots of at most {format_bytes(most)}, got {said}; choose a larger `every`, or allow more"
            " with `max_bytes`"
        )
    try:
        free = shutil.disk_usage(path.absolute().parent).free
    except OSError:
        return
    if size.total > free:
        raise CaromError(
            f"{path}: expected snapshots that fit on the disk, where {format_bytes(free)} are free, got {said}; choose a longer"
            " interval"
        )
