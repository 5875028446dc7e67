"""Sessions: a gas equilibrated and measured as its scene says, in pieces, saved and continued."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.gas.build import build
from carom.gas.endings import AT_REST, EarlyEnd, EndedEarlyError
from carom.gas.gas import Gas
from carom.gas.measures import Measures
from carom.gas.results import GasRun, Mark
from carom.gas.sampling import Every, LogTimes, next_due, spread_time
from carom.gas.scene import GasScene
from carom.gas.state import State, course_as_arrays, gas_of_arrays, require_state, set_course
from carom.public.progress import Progress, loop_callback

__all__ = ["SAMPLES", "Session"]

SAMPLES = 50  # of the gas while it is measured
PAIR_SAMPLING = 5  # every fifth sample counts pairs
RATE_SAMPLES = 8  # over which the rate of collisions is taken where walls oscillate: over one it varies with the phase
TINY = 1e-300
CHUNK = 100_000  # collisions between two checks for progress and interrupts: a tenth of a second


class Session:
    """The run of a gas scene: equilibration, then measurement.

    Parameters
    ----------
    scene : GasScene
    growing : callable(done, total, text), optional
        Called while a dense random start grows, as by :func:`carom.gas.dense`.

    :meth:`run` continues to the end, or to where it is stopped; neither the gas nor its measures depend on how often it was
    stopped. Samples are taken after about every fiftieth of the events (or of the duration), at times that follow from the rate of
    collisions; these are no instants of collision, at which two balls are in contact. Where walls oscillate, each sample is taken
    within its interval at a phase that the earlier ones have left out. Raises CaromError for a scene in which nothing can ever
    happen, and as :class:`carom.gas.Gas` does.

    Examples
    --------
    >>> from carom.gas import GasScene, Session
    >>> species = {"count": 64, "radius": 0.5}
    >>> contact = {"between": ("a", "a"), "restitution": 1, "friction": 0}
    >>> scene = GasScene(
    ...     container={"shape": "periodic", "size": (6, 6, 6)}, species=[species], contacts=[contact],
    ...     run={"equilibrate": 500, "max_events": 2000},
    ... )
    >>> session = Session(scene)
    >>> session.run()
    True
    >>> session.result.pair_collisions
    2000
    """

    def __init__(self, scene: GasScene, growing: Progress | None = None) -> None:
        self._set(scene, build(scene, growing))
        self.mark: Mark | None = None
        self.measures: Measures | None = None
        self.first_collision = 0  # number of collisions when the measurement began
        # the interval of the next sample ends at a time; the last one was at this time and number of collisions
        self.sample_due, self.last_sample_time, self.last_sample_collisions = math.inf, 0.0, 0
        self.next_sample = math.inf
        if self.max_wait == math.inf and (scene.equilibrate > 0 or scene.run.duration is None):
            what = "balls at rest" if scene.count > 1 or scene.container.geometry.faces else "one ball without walls"
            remedy = "add balls or walls" if what.startswith("one") else "give a temperature > 0"
            raise CaromError(
                f"{scene.where}: run: expected a gas with collisions to come, got {what}; {remedy},"
                " or set equilibrate = 0 and a duration"
            )
        self.sample_interval = SAMPLES if scene.run.max_events is None else max(scene.run.max_events // SAMPLES, 1)
        # the next snapshot is due after so many collisions, or after this time, as ``every`` says
        self.snapshots_taken, self.snapshot_due, self.snapshots_by_time = 0, 0.0, 0
        self._start_measuring()

    def _set(self, scene: GasScene, gas: Gas) -> None:
        self.scene, self.gas = scene, gas
        self.outputs: dict[str, str] = {}  # options that name files of the run, for those who resume it
        self.max_wait = _max_wait(scene, gas)
        self.oscillations = sorted({one.frequency or 0.0 for one in scene.drives if one.amplitude > 0})
        self.names = tuple(one.name for one in scene.species)

    # --- progress ------------------------------------------------------------------------------------------------

    @property
    def done(self) -> int:
        """Number of collisions in the current part, equilibration or measurement."""
        return self.gas.collisions - self.first_collision

    @property
    def measuring(self) -> bool:
        """Whether equilibration is over."""
        return self.mark is not None

    @property
    def part(self) -> str:
        """Name of the current part: "equilibrating" or "measuring"."""
        return "measuring" if self.measuring else "equilibrating"

    @property
    def finished(self) -> bool:
        """Whether the measurement is complete."""
        run = self.scene.run
        return self.mark is not None and (
            (run.max_events is not None and self.done >= run.max_events)
            or (run.duration is not None and self.gas.time >= self.mark.time + run.duration)
        )

    @property
    def completed(self) -> float:
        """Fraction of the current part that is done, 0 to 1."""
        run, fractions = self.scene.run, [0.0]
        if self.mark is None:
            shares = [self.done / max(self.scene.equilibrate, 1)]
            shares += [] if run.from_time is None else [self.gas.time / run.from_time]
            return min(*shares, 1.0)
        if run.max_events is not None:
            fractions.append(self.done / run.max_events)
        if run.duration is not None:
            fractions.append((self.gas.time - self.mark.time) / run.duration)
        return min(max(fractions), 1.0)

    @property
    def result(self) -> GasRun:
        """Measurements so far; CaromError before the measurement has begun."""
        if self.mark is None:
            raise CaromError("Session: expected an equilibrated gas, got one in equilibration; run it further")
        return self.gas.measured_since(self.mark)

    # --- running -------------------------------------------------------------------------------------------------

    def run(
        self,
        *,
        stop: Callable[[], bool] = lambda: False,
        progress: Progress | None = None,
        every: Every | None = None,
        snapshot: Callable[[Session], None] | None = None,
    ) -> bool:
        """Continue to the end and return True, or return False where ``stop`` returns True.

        ``progress`` is called some ten times per second with the share of the part that is done, 1, and the part,
        "equilibrating" or "measuring". ``snapshot`` is called when the measurement begins, and then every so many
        collisions (``every`` an int), every so much simulated time (a float), or at :class:`LogTimes`. What these raise
        ends the run.

        Raises EndedEarlyError as :meth:`carom.gas.Gas.run` does; :attr:`result` and :attr:`measures` then hold what was measured
        until then.
        """
        if not isinstance(every, LogTimes | None) and not (isinstance(every, int | float) and 0 < every < math.inf):
            raise CaromError(f"Session.run: every: expected a whole number >= 1, or a time > 0, got {every!r}")
        try:
            tell = loop_callback(progress, lambda now: lambda session: now(session.completed, 1.0, session.part))
            return self._run(stop, tell, every, snapshot)
        except EndedEarlyError as error:
            if self.mark is None:
                *others, last = error.faults
                said = "nothing was measured, since the gas was still equilibrating"
                raise EndedEarlyError(error.end, *others, f"{last}; {said}") from None
            if self.measures is not None and self.measures.samples == 0:
                self.measures.sample(self.gas, pairs=False)  # (those that collide ever faster are in contact)
            error.result = self.result
            raise

    def run_until_early(self, **options: Any) -> tuple[bool, EndedEarlyError | None]:
        """Continue as :meth:`run` does; return whether the run is over and, in place of an error, why the gas ended early.

        Raises EndedEarlyError for a gas that ends while it equilibrates.
        """
        try:
            return self.run(**options), None
        except EndedEarlyError as error:
            if not self.measuring:
                raise
            return True, error

    def _run(
        self,
        stop: Callable[[], bool],
        progress: Callable[[Session], None] | None,
        every: Every | None,
        snapshot: Callable[[Session], None] | None,
    ) -> bool:
        while True:
            if snapshot is not None and every is not None and self.mark is not None:
                self._take_snapshot(every, snapshot)
            if progress is not None:
                progress(self)
            if self.finished:
                return True
            if stop():
                return False
            collisions, until = self._next_piece(every)
            if self.gas.at_rest and (self.mark is None or self.scene.run.duration is None):
                self.gas.raise_early(EarlyEnd(AT_REST, self.gas.time))
            before, end = self.gas.collisions, self.gas.time + self.max_wait
            self.gas.advance(collisions, min(until, end), stop=stop)
            # a cooling gas slows down without limit: after few collisions in a piece, take longer ones
            if end < until and self.gas.collisions - before <= collisions // 8:
                self.max_wait *= 2
            self._start_measuring()
            if self.measures is not None and self.gas.time >= self.next_sample:
                self._take_sample(self.measures)

    def _next_piece(self, every: Every | None) -> tuple[int, float]:
        """Return how far to advance at once: a number of collisions, and a time."""
        run, least = self.scene.run, CHUNK
        if self.mark is None:
            left = self.scene.equilibrate - self.done
            return (min(least, left), math.inf) if left > 0 else (least, run.from_time or math.inf)
        until = self.next_sample
        if run.max_events is not None:
            least = min(least, run.max_events - self.done)
        if run.duration is not None:
            until = min(until, self.mark.time + run.duration)
        if self.sample_due == math.inf:  # the rate of collisions is not known yet
            least = min(least, max(self.sample_interval - self.done, 1))
        if every is not None and self.snapshots_by_time:
            until = min(until, self.mark.time + self.snapshot_due)
        elif every is not None:
            least = min(least, int(self.snapshot_due) - self.done)
        return least, until

    def _take_snapshot(self, every: Every, snapshot: Callable[[Session], None]) -> None:
        """Take a snapshot if one is due, and set when the next one is: at the next multiple of ``every``."""
        assert self.mark is not None
        timed = not isinstance(every, int)
        passed = self.gas.time - self.mark.time if timed else self.done
        if timed != self.snapshots_by_time:  # another unit than before
            self.snapshots_by_time, self.snapshot_due = int(timed), passed
        if self.gas.time >= self.mark.time + self.snapshot_due if timed else self.done >= self.snapshot_due:
            self.snapshots_taken += 1
            snapshot(self)
            self.snapshot_due = next_due(every, passed)

    def snapshot_gap(self, every: Every) -> tuple[float, float] | None:
        """Return from when to when snapshots are missing, in simulated time, since the run was continued without them; or None."""
        if self.mark is None or self.snapshots_taken == 0 or isinstance(every, int) == bool(self.snapshots_by_time):
            return None
        if isinstance(every, int):
            rate = max(self.done, 1) / max(self.gas.time - self.mark.time, TINY)
            due = self.mark.time + self.snapshot_due / rate if self.done > self.snapshot_due else math.inf
        else:
            due = self.mark.time + self.snapshot_due
        return (due, self.gas.time) if due < self.gas.time else None

    def _start_measuring(self) -> None:
        """Begin the measurement after equilibration; set the time of the first sample once the collision rate is known."""
        gas, run = self.gas, self.scene.run
        if self.mark is None and self.done >= self.scene.equilibrate and gas.time >= (run.from_time or 0.0):
            self.mark, self.measures = gas.mark(), Measures(gas, self.names, self.scene.container.geometry)
            self.first_collision = self.last_sample_collisions = gas.collisions
            self.last_sample_time = gas.time
            if run.duration is not None and run.max_events is None:
                self.sample_due = gas.time + run.duration / SAMPLES
            elif gas.time > 0 and gas.collisions > 0:
                self.sample_due = gas.time + self.sample_interval * gas.time / gas.collisions
        elif self.mark is not None and self.sample_due == math.inf and self.done >= self.sample_interval:
            self.sample_due = gas.time + self.sample_interval * (gas.time - self.mark.time) / self.done
        else:
            return
        self.next_sample = self._time_in_interval()

    def _take_sample(self, measures: Measures) -> None:
        """Take a sample, and set the time of the next one."""
        gas, run = self.gas, self.scene.run
        measures.sample(gas, pairs=measures.samples % PAIR_SAMPLING == 0)
        if self.oscillations or (run.duration is not None and run.max_events is None):
            self.sample_due += self._interval(measures)
        else:
            events = gas.collisions - self.last_sample_collisions
            self.sample_due = gas.time + (gas.time - self.last_sample_time) * min(
                self.sample_interval / max(events, 1), 2.0
            )
        self.last_sample_time, self.last_sample_collisions = gas.time, gas.collisions
        self.next_sample = self._time_in_interval()

    def _interval(self, measures: Measures) -> float:
        """Return the length of the interval in which a sample is taken after those so far: with a duration a share of it.

        Else it is the time in which so many collisions happen, at the rate since some samples ago.
        """
        run, mark = self.scene.run, self.mark
        assert mark is not None
        if run.duration is not None and run.max_events is None:
            return run.duration / SAMPLES
        rows = measures.series
        times = np.concatenate([[mark.time], rows["time"]])[-RATE_SAMPLES - 1 :]
        events = np.concatenate([[self.first_collision], rows["collisions"]])[-RATE_SAMPLES - 1 :]
        passed = float(times[-1] - times[0]) / (len(times) - 1)
        share = self.sample_interval * (len(times) - 1) / max(float(events[-1] - events[0]), 1.0)
        return passed * min(share, 2.0)

    def _time_in_interval(self) -> float:
        """Return when the next sample is taken: where walls oscillate, within its interval at the phase most needed.

        It follows from what is kept in a checkpoint, so that a run that is continued takes the same samples.
        """
        measures = self.measures
        if not self.oscillations or measures is None or measures.samples == 0:
            return self.sample_due
        width, times = self._interval(measures), measures.series["time"]
        return max(spread_time(self.sample_due, width, self.oscillations, times, PAIR_SAMPLING), self.gas.time)

    # --- state ---------------------------------------------------------------------------------------------------

    def state(self) -> State:
        """Return all that a later session needs to continue with the same bits."""
        return {f"gas.{name}": array for name, array in self.gas.state().items()} | course_as_arrays(self)

    @classmethod
    def restore(
        cls, scene: GasScene, state: Mapping[str, NDArray[Any]], compiling: Callable[[], None] | None = None
    ) -> Session:
        """Return the session with a :meth:`state`. ``compiling`` is called when the state is known to be complete."""
        require_state(scene, state)
        if compiling is not None:
            compiling()
        found = object.__new__(cls)
        found._set(scene, gas_of_arrays(state))
        set_course(found, state)
        found.next_sample = found._time_in_interval()
        return found


def _max_wait(scene: GasScene, gas: Gas) -> float:
    """Return the longest simulated time between two checks for interrupts: what a ball needs to cross the container thirty times.

    Infinite where nothing can ever happen.
    """
    container = scene.container.geometry
    side, mass = max(container.size), sum(one.total_mass(scene.container.dimensions) for one in scene.species)
    pull = math.hypot(*scene.gravity_vector)
    speed = math.sqrt(2 * gas.energy()[0] / mass) + math.sqrt(pull * side)
    speed += sum(one.drive.greatest_speed for one in scene.drives)
    if scene.thermostat is not None:
        speed += math.sqrt(scene.thermostat.temperature * scene.count / mass)
    collides = scene.count > 1 or bool(container.faces)
    return 30 * side / speed if speed > 0 and collides else math.inf
