"""Snapshots as GSD files of HOOMD's schema, which the field's viewers open (OVITO, freud, HOOMD itself).

What the schema says: the box is centred on 0 (of discs Lz = 0 and 2 dimensions), positions and velocities are single
precision, ``step`` is the number of collisions, ``image`` counts the turns round a period. The spin w is in ``angmom``, the
quaternion 2 q (0, S), with the orientation q and the angular momentum S = I w about the body's axes. A gas does not follow
how its balls are turned, so q is 1. The time is the logged ``carom/time``.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.files import library
from carom.gas.run import Gas

__all__ = ["Snapshots", "spin_of"]


def _gsd(path: Path) -> Any:
    return library("gsd.hoomd", "gsd", path.name)


class Snapshots:
    """A GSD file that is written frame by frame.

    Parameters
    ----------
    path : of the file
    names : of the species
    keep : frames of the file to go on from; left out: it is begun anew

    Raises CaromError where the file cannot be written, or has fewer frames than are to be kept.
    """

    def __init__(self, path: Path, names: tuple[str, ...], keep: int | None = None) -> None:
        self.path, self.names, gsd = path, names, _gsd(path)
        try:
            if keep is None:
                self._file = gsd.open(str(path), "w")
                return
            self._cut(gsd, keep)
            self._file = gsd.open(str(path), "r+")
        except CaromError:
            raise
        except Exception as error:  # OSError, RuntimeError and others
            raise CaromError(f"{path}: expected a GSD file to write to, got: {error}") from None

    def _cut(self, gsd: Any, keep: int) -> None:
        """Take away what was written after the checkpoint from which the run goes on."""
        with gsd.open(str(self.path), "r") as old:
            if len(old) < keep:
                raise CaromError(
                    f"{self.path}: expected the {keep} frames that the checkpoint knows of, got {len(old)}"
                )
            if len(old) == keep:
                return
            part = self.path.with_name(f".{self.path.name}.part")
            with gsd.open(str(part), "w") as new:
                for k in range(keep):
                    new.append(old[k])
        os.replace(part, self.path)

    def write(self, gas: Gas) -> None:
        """Add the gas as it is now."""
        try:
            self._file.append(self._frame(gas))
        except OSError as error:
            raise CaromError(f"{self.path}: expected room for a frame, got: {error.strerror or error}") from None

    def flush(self) -> None:
        """Bring all frames to the disk."""
        self._file.flush()

    def close(self) -> None:
        """Bring all frames to the disk, and leave the file."""
        self._file.close()

    def _frame(self, gas: Gas) -> Any:
        balls, one = gas.balls(), gas._arrays.swarm[0]
        kinds = gas._arrays.species[balls.species]
        axes, count = int(one["axes"]), len(balls.species)
        frame = _gsd(self.path).Frame()
        side = np.zeros(3)
        side[:axes] = one["side"][:axes]
        frame.configuration.step = gas.collisions
        frame.configuration.dimensions = axes
        frame.configuration.box = [*side.tolist(), 0.0, 0.0, 0.0]
        particles = frame.particles
        particles.N = count
        particles.types = list(self.names)
        particles.typeid = balls.species
        particles.position = balls.position - side / 2
        particles.velocity = balls.velocity
        particles.image = balls.images
        particles.mass = kinds["mass"]
        particles.diameter = 2 * kinds["radius"]
        moment = kinds["kappa"] * kinds["mass"] * kinds["radius"] ** 2
        # of discs the moments about x and y are not there: HOOMD then lets them turn about z only
        particles.moment_inertia = moment[:, None] * np.array([0, 0, 1] if axes == 2 else [1, 1, 1])
        particles.angmom = np.concatenate([np.zeros((count, 1)), 2 * moment[:, None] * balls.spin], axis=1)
        frame.log = {"carom/time": np.array([gas.time])}
        return frame


def spin_of(particles: Any) -> NDArray[np.float64] | None:
    """Spins (N, 3) of a frame's particles about fixed axes; None where it has no moments of inertia."""
    moment = np.asarray(particles.moment_inertia, dtype=float)
    if not moment.any():
        return None
    q, p = (np.asarray(part, dtype=float) for part in (particles.orientation, particles.angmom))
    # S = Im(q* p) / 2 about the body's axes
    body = (q[:, :1] * p[:, 1:] - p[:, :1] * q[:, 1:] - np.cross(q[:, 1:], p[:, 1:])) / 2
    w = np.divide(body, moment, out=np.zeros_like(body), where=moment > 0)
    # and about fixed ones: q w q*
    t = 2 * np.cross(q[:, 1:], w)
    turned: NDArray[np.float64] = w + q[:, :1] * t + np.cross(q[:, 1:], t)
    return turned
