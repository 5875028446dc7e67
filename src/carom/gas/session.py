"""A gas run as its scene says: equilibrated, measured, looked at, kept on the way; and on again where it was stopped."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.engine.swarm_arrays import BODY, FACE, MOTION, PAIR, PLAN, SPECIES, SWARM, WALL
from carom.engine.swarm_run import STATE
from carom.errors import CaromError
from carom.gas.build import build
from carom.gas.ends import refuse_rest
from carom.gas.measure import Measures
from carom.gas.model import GasScene
from carom.gas.run import Gas, GasRun, Mark

__all__ = ["LOOKS", "Session"]

LOOKS = 50  # at the gas while it is measured
PAIR_LOOKS = 5  # of so many looks one counts pairs
CHUNK = 100_000  # collisions between two looks at the outside world: a tenth of a second

State = dict[str, NDArray[Any]]


class Session:
    """A gas on its way through its scene.

    Parameters
    ----------
    scene : GasScene
    where : what faults are told to be in
    growing : called while a dense random start grows, with the share of the final radii

    :meth:`run` goes on to the end, or to where it is told to stop; nothing about the gas, or about what is measured,
    depends on how often it was stopped. Times for looks follow the rate of collisions, so that a look comes after every
    fiftieth of the events (or of the duration); they are not the times of collisions, at which two balls are in contact.
    """

    def __init__(self, scene: GasScene, where: str = "gas", growing: Callable[[float], None] | None = None) -> None:
        self._enter(scene, build(scene, where, growing))
        self.mark: Mark | None = None
        self.measures: Measures | None = None
        self.begun = 0  # collisions when measuring began
        # a look is due at a time; the last one was at this time and number of collisions
        self.due, self.last_time, self.last_collisions = math.inf, 0.0, 0
        if self.patience == math.inf and (scene.equilibrate > 0 or scene.run.duration is None):
            what = "balls at rest" if scene.count > 1 or scene.container.room.walls else "one ball without walls"
            remedy = "more balls, walls" if what.startswith("one") else "give a temperature"
            raise CaromError(
                f"{where}: run: expected a gas in which something happens, got {what}; {remedy},"
                " or equilibrate = 0 and a duration"
            )
        self.step = LOOKS if scene.run.max_events is None else max(scene.run.max_events // LOOKS, 1)
        # snapshots so far; the next is due after so many collisions, or after this time, as ``every`` has it
        self.frames, self.shot, self.timed = 0, 0.0, False
        self._equilibrated()

    def _enter(self, scene: GasScene, gas: Gas) -> None:
        self.scene, self.gas = scene, gas
        self.patience = _patience(scene, gas)
        # nothing happens, but the loop is compiled, which is no part of the time that it takes
        gas.go_on(1, until=-1.0)
        self.names = tuple(one.name for one in scene.species)

    # --- where it is ---------------------------------------------------------------------------------------------

    @property
    def done(self) -> int:
        """Collisions of the part that it is in: equilibrating, or measuring."""
        return self.gas.collisions - self.begun

    @property
    def measuring(self) -> bool:
        """Whether it is equilibrated."""
        return self.mark is not None

    @property
    def finished(self) -> bool:
        """Whether all that was asked for is measured."""
        run = self.scene.run
        return self.mark is not None and (
            (run.max_events is not None and self.done >= run.max_events)
            or (run.duration is not None and self.gas.time >= self.mark.time + run.duration)
        )

    @property
    def share(self) -> float:
        """How much of this part is done, 0 to 1."""
        run, shares = self.scene.run, [0.0]
        if self.mark is None:
            return self.done / max(self.scene.equilibrate, 1)
        if run.max_events is not None:
            shares.append(self.done / run.max_events)
        if run.duration is not None:
            shares.append((self.gas.time - self.mark.time) / run.duration)
        return min(max(shares), 1.0)

    @property
    def result(self) -> GasRun:
        """What was measured so far."""
        if self.mark is None:
            raise CaromError("Session: expected a gas that is equilibrated, got one that is not yet; run it further")
        return self.gas.measured(self.mark)

    # --- on ------------------------------------------------------------------------------------------------------

    def run(
        self,
        *,
        stop: Callable[[], bool] = lambda: False,
        progress: Callable[[Session], None] | None = None,
        every: int | float | None = None,
        snapshot: Callable[[Session], None] | None = None,
    ) -> bool:
        """Go on to the end, and say True; or False, where ``stop`` said so.

        ``progress`` is called some ten times a second. ``snapshot`` is called when measuring begins, and then after every so
        many collisions (``every`` an int) or so much time (a float). What these raise ends the run.
        """
        while True:
            if snapshot is not None and every is not None and self.mark is not None:
                self._take(every, snapshot)
            if progress is not None:
                progress(self)
            if self.finished:
                return True
            if stop():
                return False
            collisions, until = self._piece(every)
            if self.gas.over and (self.mark is None or self.scene.run.duration is None):
                refuse_rest(self.gas.time)
            before, end = self.gas.collisions, self.gas.time + self.patience
            self.gas.go_on(collisions, min(until, end))
            # a cooling gas slows down without end: where little of what was asked for came, longer pieces
            if end < until and self.gas.collisions - before <= collisions // 8:
                self.patience *= 2
            self._equilibrated()
            if self.measures is not None and self.gas.time >= self.due:
                self._look(self.measures)

    def _piece(self, every: int | float | None) -> tuple[int, float]:
        """How far to go at once: collisions, and a time."""
        run, least = self.scene.run, CHUNK
        if self.mark is None:
            return min(least, self.scene.equilibrate - self.done), math.inf
        until = self.due
        if run.max_events is not None:
            least = min(least, run.max_events - self.done)
        if run.duration is not None:
            until = min(until, self.mark.time + run.duration)
        if self.due == math.inf:  # the rate of collisions is to be found first
            least = min(least, max(self.step - self.done, 1))
        if every is not None and self.timed:
            until = min(until, self.mark.time + self.shot)
        elif every is not None:
            least = min(least, int(self.shot) - self.done)
        return least, until

    def _take(self, every: int | float, snapshot: Callable[[Session], None]) -> None:
        """Take the snapshot that is due, and say when the next one is: at the next multiple of ``every``."""
        assert self.mark is not None
        timed = isinstance(every, float)
        passed = self.gas.time - self.mark.time if timed else self.done
        if timed != self.timed:  # another unit than before
            self.timed, self.shot = timed, passed
        if self.gas.time >= self.mark.time + self.shot if timed else self.done >= self.shot:
            self.frames += 1
            snapshot(self)
            self.shot = (math.floor(passed / every + 1e-9) + 1) * every

    def _equilibrated(self) -> None:
        """Begin to measure, when it is time to; set the first look, once a rate is known."""
        gas, run = self.gas, self.scene.run
        if self.mark is None and self.done >= self.scene.equilibrate:
            self.mark, self.measures = gas.mark(), Measures(gas, self.names, self.scene.container.room)
            self.begun = self.last_collisions = gas.collisions
            self.last_time = gas.time
            if run.duration is not None and run.max_events is None:
                self.due = gas.time + run.duration / LOOKS
            elif gas.time > 0 and gas.collisions > 0:
                self.due = gas.time + self.step * gas.time / gas.collisions
        elif self.mark is not None and self.due == math.inf and self.done >= self.step:
            self.due = gas.time + self.step * (gas.time - self.mark.time) / self.done

    def _look(self, measures: Measures) -> None:
        gas, run = self.gas, self.scene.run
        measures.look(gas, pairs=measures.looks % PAIR_LOOKS == 0)
        if run.duration is not None and run.max_events is None:
            self.due = self.due + run.duration / LOOKS
        else:
            events = gas.collisions - self.last_collisions
            self.due = gas.time + (gas.time - self.last_time) * min(self.step / max(events, 1), 2.0)
        self.last_time, self.last_collisions = gas.time, gas.collisions

    # --- kept ----------------------------------------------------------------------------------------------------

    def state(self) -> State:
        """Everything that a later session needs to go on with the same bits."""
        found: State = {f"gas.{name}": array for name, array in self.gas.state().items()}
        found["session"] = np.array([self.begun, self.last_collisions, self.step, self.frames, self.timed], np.int64)
        found["clock"] = np.array([self.due, self.last_time, self.shot])
        if self.mark is not None and self.measures is not None:
            mark = self.mark
            found |= {"mark.swarm": np.array([mark.swarm]), "mark.pairs": mark.pairs, "mark.walls": mark.walls}
            found["mark.faces"] = mark.faces
            # (of the processor's time, what the measuring has taken so far)
            cpu = self.result.cpu_seconds
            found["mark.numbers"] = np.array([*mark.energy, mark.time, cpu])
            found |= {f"measures.{name}": array for name, array in self.measures.state().items()}
        return found

    @classmethod
    def restore(cls, scene: GasScene, state: State, compiling: Callable[[], None] | None = None) -> Session:
        """The session of :meth:`state`, to go on with. ``compiling`` is called once all that it needs is known to be there."""
        gas = _part(state, "gas.")
        _require(gas)
        if lost := [name for name in ("session", "clock") if name not in state]:
            raise KeyError(lost[0])
        if compiling is not None:
            compiling()
        found = object.__new__(cls)
        found._enter(scene, Gas.restore(gas))
        found.begun, found.last_collisions, found.step, found.frames, timed = map(int, state["session"])
        found.due, found.last_time, found.shot = map(float, state["clock"])
        found.timed = bool(timed)
        found.mark, found.measures = None, None
        if (kept := _part(state, "mark.")) and (measures := _part(state, "measures.")):
            *energy, time, cpu = map(float, kept["numbers"])
            found.mark = Mark(
                kept["swarm"][0],
                kept["pairs"],
                kept["walls"],
                kept["faces"],
                (energy[0], energy[1], energy[2]),
                time,
                found.gas._cpu - cpu,
            )
            found.measures = Measures.restore(found.gas, found.names, scene.container.room, measures)
        return found


def _require(gas: State) -> None:
    """KeyError or TypeError where an array of a gas is missing, or its records are others than now: before all is compiled."""
    kinds = dict(zip(STATE, (SWARM, MOTION, PLAN, BODY, np.dtype("u4"), SPECIES, PAIR, WALL, FACE), strict=True))
    for name in (*STATE, "names", "time"):
        if name not in gas:
            raise KeyError(name)
        if name in kinds and gas[name].dtype != kinds[name]:
            raise TypeError(f"other records of {name!r}")
    if not np.array_equal(np.sort(gas["numbers"]), np.arange(len(gas["motions"]))):
        raise TypeError("the balls' numbers")


def _patience(scene: GasScene, gas: Gas) -> float:
    """A time after which the outside world is looked at even if nothing has met: thirty ways through the room.

    Infinite where nothing can ever happen.
    """
    room = scene.container.room
    side, mass = max(room.size), sum(one.count * one.mass for one in scene.species)
    pull = math.hypot(*scene.pull)
    speed = math.sqrt(2 * gas.energy()[0] / mass) + math.sqrt(pull * side)
    speed += sum(one.amplitude * (one.frequency or 0.0) for one in scene.drives)
    if scene.thermostat is not None:
        speed += math.sqrt(scene.thermostat.temperature * scene.count / mass)
    meets = scene.count > 1 or bool(room.walls)
    return 30 * side / speed if speed > 0 and meets else math.inf


def _part(state: State, prefix: str) -> State:
    return {name.removeprefix(prefix): array for name, array in state.items() if name.startswith(prefix)}
