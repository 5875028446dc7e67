"""Describe a run in plain sentences."""

from __future__ import annotations

import contextlib
import math
from collections import Counter
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.core.motion.phases import BOUNCING, FLIGHT, HELD, LEFT, PIVOTING, POCKETED, REST, ROLLING, SLIDING
from carom.errors import CaromError
from carom.formatting import counted, format_length, format_number, format_time
from carom.simulation.contact_kinds import CONTACTS, cushion_side, overlap_note, partner_names
from carom.simulation.records import (
    BALL,
    CLUSTERS,
    FLOOR,
    HELD_EVENT,
    IN_CLUSTER,
    START,
    WALL_IN_CLUSTER,
    RunRecord,
    direction,
    listed,
    speed,
    when,
)

OPEN_AFTER = 0.012  # s after the first contact: the balls of a rack have parted, and none has met a cushion
FAST = 1.0  # m/s


@dataclass(frozen=True)
class BreakStatistics:
    """Figures of a break: :func:`break_statistics`."""

    time: float
    """Of the first contact with the rack, s."""
    speeds: NDArray[np.float64]
    """Of all balls (B,), 12 ms later, m/s: the rack has opened then."""
    fastest: int
    """The number of the fastest ball of the rack then."""
    share: float
    """Its share of the kinetic energy of motion of all balls then."""
    distance: float
    """Mean distance of the racked balls that lie on the table at the end from the rack's centre, m; NaN if none does."""
    pocketed: tuple[int, ...]
    """Numbers of the balls that are pocketed."""
    names: tuple[str, ...]

    @property
    def fast(self) -> int:
        """The number of balls faster than 1 m/s when the rack has opened."""
        return int((self.speeds > FAST).sum())

    @property
    def median(self) -> float:
        """The median speed of all balls when the rack has opened, m/s."""
        return float(np.median(self.speeds))

    def describe(self) -> str:
        """Return the figures in a sentence or two."""
        names = [f"ball {name}" if name.isdigit() else name for name in self.names]
        down = [names[i] for i in self.pocketed]
        far = (
            "" if np.isnan(self.distance) else f"; on average {format_length(self.distance)} from its centre at the end"
        )
        return (
            f"The break: {counted(self.fast, 'ball')} faster than 1 m/s when the rack has opened, median"
            f" {format_number(self.median)} m/s; the fastest, {names[self.fastest]}, at"
            f" {format_number(float(self.speeds[self.fastest]))} m/s has {100 * self.share:.0f} % of the balls' translational"
            f" energy{far};"
            f" {f'pocketed: {listed(down)}' if down else 'none is pocketed'}."
        )


def break_statistics(run: RunRecord) -> BreakStatistics:
    """Return figures of the break of a run whose scene has a rack.

    Raises CaromError, one line, for a scene without a rack, and for a run in which no ball meets it.

    Examples
    --------
    >>> import carom
    >>> found = carom.simulate(carom.new_scene("pool-9ft", rack="9-ball")).break_statistics()
    >>> found.fast, found.names[found.fastest]
    (6, '5')
    """
    names = run.scene.ball_names
    racked = [] if run.scene.rack is None else [names.index(name) for name in run.scene.rack.balls]
    if not racked:
        raise CaromError("break_statistics: expected a scene with a rack, got one without; carom.Rack names its balls")
    met = run.log[np.isin(run.log["kind"], (BALL, IN_CLUSTER)) & np.isin(run.log["ball"], racked)]
    if len(met) == 0:
        raise CaromError("break_statistics: expected a ball that meets the rack, got none in this run")
    time = float(met["t"][0])
    opened = run.at(min(time + OPEN_AFTER, run.end)).velocity
    start, end = run.at(0.0).position, run.final.position
    assert start is not None
    assert end is not None
    speeds = np.nan_to_num(np.linalg.norm(opened, axis=1))
    energy = speeds**2 * np.array([ball.mass for ball in run.scene.balls])
    away = np.linalg.norm((end - start[racked].mean(axis=0))[racked, :2], axis=1)
    pocketed = {int(row["ball"]) for row in run.log[run.log["phase"] == POCKETED]}
    fastest = racked[int(np.argmax(speeds[racked]))]
    lying = away[~np.isnan(away)]
    return BreakStatistics(
        time=time, speeds=speeds, fastest=fastest, share=float(energy[fastest] / energy.sum()),
        distance=float(lying.mean()) if len(lying) else float("nan"), pocketed=tuple(sorted(pocketed)), names=names,
    )  # fmt: skip


# ----------------------------------------------------------------------------------------------------
# Describe a run in plain sentences.


# The events that begin a sentence.
IMPACT_KINDS = (START, IN_CLUSTER, *(one.code for one in CONTACTS.values() if one.sentence is not None))
# How many impacts of a ball are described, the first and the last; those between are counted.
FIRST, LAST = 6, 3
# Lower bounces (m) and shorter phases (s) are not mentioned; hops of less than 0.1 mm in few words.
SMALL, SHORT, LOW = 1e-6, 1e-4, 1e-4
LONG = 1e-3  # s: how long infinitely many bounces last is said from here on
NOTABLE = 1e-3  # m: how high a ball bounces is said from here on
MOST_BALLS = 4  # that are described one by one
LAST_ROWS = 200  # of the log: what a run that did not end did at last
PHASE_VERBS = {
    FLIGHT: "flies",
    SLIDING: "slides",
    ROLLING: "rolls",
    PIVOTING: "spins on the spot",
    REST: "rests",
    BOUNCING: "bounces",
}

Rows = NDArray[np.void]


def describe_run(run: RunRecord) -> list[str]:
    """Describe a run: a paragraph for each of the first balls that move, one for all others, one for a break, one for how it ended.

    A line before the last one says where contacts of balls overlap in time that the run was to resolve one pair at a time.

    Of a ball with many impacts, the first and the last are described and the others counted.
    """
    rows = [run.log[run.log["ball"] == i] for i in range(len(run.scene.balls))]
    moved = [i for i, own in enumerate(rows) if len(own) > 1 or own["phase"][0] != REST]
    described = moved if len(moved) <= MOST_BALLS else moved[: MOST_BALLS - 1]
    tables = run.scene.features().view(np.recarray)
    found = [_ball(run, tables, rows[i]) for i in described]
    if more := moved[len(described) :]:
        found.append(_others(run, [rows[i] for i in more]))
    if still := [i for i in range(len(rows)) if i not in moved]:
        names = run.scene.ball_names
        if len(still) <= MOST_BALLS:
            found.append(f"{listed([names[i] for i in still])} {'stays' if len(still) == 1 else 'stay'} at rest.")
        else:
            found.append(f"{len(still)} balls stay at rest.")
    if run.scene.rack is not None:
        with contextlib.suppress(CaromError):  # (no ball meets it)
            found.append(break_statistics(run).describe())
    found += [] if (note := overlap_note(run)) is None else [f"{note}."]
    spin = [name for name, own in zip(run.scene.ball_names, rows, strict=True) if own["phase"][-1] == PIVOTING]
    if spin and (floor := run.scene.floor) is not None and not floor.spin_friction + floor.spin_damping > 0:
        found.append(f"Spin on the spot without an end: {listed(spin)}; floor.spin_friction is 0, cloth has 0.0125.")
    if run.ended == "duration":
        found.append(
            f"The run ends after its duration, {format_time(run.end)}, and {counted(_event_count(run), 'event')}."
        )
    elif run.ended == "max_events":  # (a meeting of two balls is one event of the loop, and two of the record)
        found.append(
            f"The run ends at its greatest number of events, {run.scene.run.max_events or _event_count(run):,}, after"
            f" {when(run.end)}{_endless(run)}."
        )
    return found


def _endless(run: RunRecord) -> str:
    """Say which ball has filled the end of a run with bounces that return all its speed along the normal, and so have no end."""
    last = run.log[-LAST_ROWS:]
    for ball, name in enumerate(run.scene.ball_names):
        rows = last[(last["ball"] == ball) & (last["kind"] == FLOOR)]
        up, down = rows["v"][:, 2], rows["v_before"][:, 2]
        if 2 * len(rows) > LAST_ROWS and np.all(up > -(1 - 1e-9) * down):
            high, often = up[-1] ** 2 / (2 * -run.scene.pull[2]), np.ptp(rows["t"]) / (len(rows) - 1)
            return f"; {name} goes on bouncing on the floor, {format_length(high)} high, every {format_time(often)}"
    return ""


def _event_count(run: RunRecord) -> int:
    return int((run.log["kind"] != START).sum())


# --- one ball ------------------------------------------------------------------------------------------------------


def _ball(run: RunRecord, features: Any, rows: Rows) -> str:
    """A ball's paragraph: a sentence for each of its meetings, and for what it does until the next."""
    firsts = [k for k, kind in enumerate(rows["kind"]) if kind in IMPACT_KINDS]
    # what is held is held by what it met at that instant: one sentence
    firsts = [k for k in firsts if not (rows["kind"][k] == HELD_EVENT and k > 0 and rows["t"][k] == rows["t"][k - 1])]
    firsts = [k for k in firsts if not _is_further(rows[k])]
    parts = [rows[a:b] for a, b in zip(firsts, [*firsts[1:], len(rows)], strict=True)]
    ends = [float(part["t"][0]) for part in parts[1:]] + [run.end]
    shown = range(len(parts))
    skipped = range(0)
    if len(parts) > FIRST + LAST + 2:
        skipped = shown[FIRST:-LAST]
    sentences = []
    for k in shown:
        if k in skipped:
            if k == skipped[0]:
                sentences.append(_skipped([parts[m] for m in skipped]))
        else:
            sentences.append(_sentence(run, features, parts[k], ends[k]))
    sentences.append(_outcome(run, rows))
    return " ".join(text for text in sentences if text)


def _is_further(row: Any) -> bool:
    """Return whether a row is of something else that a ball touches in the same contact, after its first row."""
    return bool(row["kind"] in CLUSTERS and np.array_equal(row["v_before"], row["v"]))


def _meanwhile(run: RunRecord, features: Any, part: Rows) -> str:
    """Name what a ball touches together with what it meets."""
    names = []
    for row in part[1:][[_is_further(row) for row in part[1:]]]:
        side = cushion_side(run, features, row) if row["kind"] == WALL_IN_CLUSTER else ""
        name = str((partner_names(run.scene, int(row["met"])) or ())[row["other"]])
        names.append(f"{name} ({side})" if side else name)
    return f", touching {listed(list(dict.fromkeys(names)))} meanwhile" if names else ""


def _skipped(parts: list[Rows]) -> str:
    """Count the impacts that are not described one by one."""
    return f"Then come {_met([part[0] for part in parts], 'more ')}, up to {when(parts[-1]['t'][0])}."


def _met(firsts: list[Any], more: str = "") -> str:
    kinds = Counter(BALL if row["kind"] == IN_CLUSTER else int(row["kind"]) for row in firsts)
    said = [
        counted(kinds[one.code], f"{more}{one.noun}") + one.clause
        for one in CONTACTS.values()
        if one.noun and kinds[one.code]
    ]
    return listed(said) if said else "nothing"


def _sentence(run: RunRecord, features: Any, part: Rows, end: float) -> str:
    """Describe one impact, and the motion until the time ``end``."""
    row = part[0]
    kind = int(row["kind"])
    if kind == START:
        head = _start(run, row)
    else:
        contact = CONTACTS[BALL if kind == IN_CLUSTER else kind]
        assert contact.sentence is not None
        head = contact.sentence(run, features, row) + _meanwhile(run, features, part)
        if contact.last:
            return head
    if row["phase"] == LEFT:
        return f"{head} and has left: it is followed no further."
    if part["phase"][-1] == HELD:
        return f"{head} and is held there, pressed on it: it is followed no further."
    then = _then(run, part[[not (k and _is_further(row)) for k, row in enumerate(part)]], end)
    return f"{head}{'; it ' if then else ''}{listed(then) if then else ''}."


def _start(run: RunRecord, row: Any) -> str:
    """Describe the initial state."""
    name, phase, v = run.scene.ball_names[row["ball"]], int(row["phase"]), row["v"]
    if phase in (REST, PIVOTING):
        spin = f", {format_number(abs(float(row['w'][2])))} rad/s" if phase == PIVOTING else ""
        return f"{name} {PHASE_VERBS[phase]}{spin}" if phase == PIVOTING else f"{name} is at rest"
    if speed(v) == 0:
        return f"{name} {'is let go' if phase == FLIGHT else 'starts from rest'}{_spin(row)}"
    strike = run.scene.balls[row["ball"]].strike
    if strike is not None:
        miscue = ", a miscue," if strike.on(run.scene.balls[row["ball"]].ball).miscue else ""
        driven = "is driven onto the floor" if v[2] < 0 else PHASE_VERBS[phase]
        return f"{name} is struck{miscue} and {driven} at {format_number(speed(v))} m/s{direction(v)}{_spin(row)}"
    return f"{name} {PHASE_VERBS[phase]} at {format_number(speed(v))} m/s{direction(v)}{_spin(row)}"


def _spin(row: Any) -> str:
    """Describe the spin: sidespin; of a ball that slides, topspin or backspin as well."""
    v, w = row["v"], row["w"]
    said = []
    flat = math.hypot(float(v[0]), float(v[1]))
    if row["phase"] == SLIDING and flat > 0:
        over = float(v[0] * w[1] - v[1] * w[0]) / flat
        if over != 0:
            said.append(f"{format_number(abs(over))} rad/s of {'topspin' if over > 0 else 'backspin'}")
    elif row["phase"] != ROLLING and (w[:2] != 0).any():
        return f", spinning at {format_number(speed(w))} rad/s"
    if w[2] != 0:
        # seen from above, a ball hit on its right side turns counterclockwise
        said.append(f"{format_number(abs(float(w[2])))} rad/s of side to the {'right' if w[2] > 0 else 'left'}")
    return f", with {listed(said)}" if said else ""


# --- what it does between two meetings --------------------------------------------------------------------------------


def _then(run: RunRecord, part: Rows, end: float) -> list[str]:
    """Describe the motion after an impact: flying, landing, bouncing, sliding, rolling."""
    said: list[str] = []
    phases = part["phase"].tolist()
    lands = [k for k in range(1, len(part)) if part["kind"][k] == FLOOR]
    if run.scene.floor is not None and phases[0] in (FLIGHT, BOUNCING):
        said += _hop(run, part, lands, end)
    times = [*part["t"].tolist(), end]
    for k, phase in enumerate(phases):
        lasts = times[k + 1] - times[k]
        if phase == PIVOTING and k > 0 and lasts > SHORT and k + 1 < len(phases):
            said.append(f"spins on the spot for {format_time(lasts)}")
        elif phase == SLIDING and lasts > SHORT and k + 1 < len(phases):
            said.append(f"slides for {format_time(lasts)}")
        elif phase == ROLLING and (k > 0 or part["kind"][0] != START):
            said.append(
                "rolls on" if k == 0 else f"rolls at {format_number(speed(part['v'][k]))} m/s{_turned(part, k)}"
            )
    if phases[-1] == REST and len(part) > 1 and run.end > end:
        said.append(f"comes to rest at {_place(part[-1])} at {when(times[-2])}")
    return said


def _turned(part: Rows, k: int) -> str:
    """Return the direction in which a ball rolls at last, where it stood still or sliding has turned it by 5 degrees or more."""
    (x0, y0, _), (x1, y1, _) = part["v"][0].tolist(), part["v"][k].tolist()
    turned = abs(math.degrees(math.atan2(x0 * y1 - y0 * x1, x0 * x1 + y0 * y1)))
    stood = math.hypot(x0, y0) <= 1e-9 * math.hypot(x1, y1)
    return direction(part["v"][k]) if turned >= 5 or stood else ""


def _hop(run: RunRecord, part: Rows, lands: list[int], end: float) -> list[str]:
    """Describe a flight over the floor: its height and length, and the bounces."""
    row = part[0]
    g, up = -run.scene.pull[2], float(row["v"][2])
    said: list[str] = []
    if row["kind"] != START and g > 0:
        ups = part["v"][[k for k in (0, *lands) if part["phase"][k] in (FLIGHT, BOUNCING)], 2]
        highest = max(float(ups.max(initial=0.0)), 0.0) ** 2 / (2 * g)
        if highest < LOW and (lands or row["phase"] == BOUNCING):
            return ["hops by less than 0.1 mm"] if highest >= SMALL else said
    if up > 0 and g > 0 and row["kind"] != START:
        said.append(f"is lifted {format_length(up * up / (2 * g))}")
    if row["phase"] == BOUNCING:
        return [*said, f"bounces infinitely often within {format_time(_bouncing_time(part, 0, end))}"]
    if not lands:
        return said
    first = part[lands[0]]
    far = math.hypot(*(first["x"] - row["x"])[:2].tolist())
    if first["t"] > row["t"] and far > 0:
        said.append(
            f"flies {format_length(far)}" if row["kind"] != START else f"comes down {format_length(far)} further on"
        )
    bounces = [k for k in lands if part["phase"][k] in (FLIGHT, BOUNCING)]
    if not bounces:
        return [*said, f"lands at {when(first['t'])}"]
    last = bounces[-1]
    ever = _bouncing_time(part, last, end) if part["phase"][last] == BOUNCING else 0.0
    more = f", the last time in infinitely many bounces within {format_time(ever)}" if ever >= LONG else ""
    rises = float(part["v"][bounces, 2].max()) ** 2 / (2 * g)
    high = f", up to {format_length(rises)} high" if rises > NOTABLE else ""
    return [*said, f"bounces {_times(len(bounces))} from {when(first['t'])} on{high}{more}"]


def _times(count: int) -> str:
    return {1: "once", 2: "twice"}.get(count, f"{count:,} times")


def _bouncing_time(part: Rows, k: int, end: float) -> float:
    """Return how long infinitely many bounces last, s."""
    return float(part["t"][k + 1] if k + 1 < len(part) else end) - float(part["t"][k])


def _place(row: Any) -> str:
    x, y, z = (format_number(float(c) if abs(c) > 1e-9 else 0.0) for c in row["x"])
    return f"({x}, {y}) m" if row["phase"] in (PIVOTING, REST) else f"({x}, {y}, {z}) m"


def _outcome(run: RunRecord, rows: Rows) -> str:
    """Describe the final state of a ball, after how long and how many impacts."""
    last = rows[-1]
    phase, ball = int(last["phase"]), int(last["ball"])
    if phase in (HELD, LEFT, POCKETED):
        return ""
    met = _met(list(rows[1:]))
    after = "" if met == "nothing" else f" and {met}" if " and " not in met else f", {met}"
    if phase == REST:
        return f"It comes to rest at {_place(last)} after {when(last['t'])}{after}."
    final = run.final
    assert final.position is not None
    v = final.velocity[ball]
    how = (
        f"{PHASE_VERBS[phase]} at {format_number(speed(v))} m/s"
        if phase != PIVOTING and speed(v) > 0
        else PHASE_VERBS[phase]
    )
    if run.ended == "nothing more happens":
        verb = PHASE_VERBS[phase]
        spot = f"goes on spinning on the spot at {_place(last)} from {when(last['t'])} on"
        on = spot if phase == PIVOTING else how.replace(verb, f"{verb} on", 1)
        return f"Then it meets nothing more, and {on}{direction(v) if speed(v) else ''}."
    x, y, _z = (format_number(float(c)) for c in final.position[ball])
    return f"At the end, after {when(run.end)}{after}, it {how} at ({x}, {y}) m."


def _others(run: RunRecord, balls: list[Rows]) -> str:
    """Describe all other balls in one sentence: their impacts and final states."""
    firsts = [row for rows in balls for row in rows[1:] if row["kind"] in IMPACT_KINDS]
    ends = Counter(int(rows["phase"][-1]) for rows in balls)
    words = {
        REST: ("is at rest", "are at rest"),
        HELD: ("is held", "are held"),
        LEFT: ("has left", "have left"),
        POCKETED: ("is pocketed", "are pocketed"),
    }
    how = [
        f"{count:,} {words[k][count > 1] if k in words else _plural(PHASE_VERBS[k], count)}"
        for k, count in sorted(ends.items())
    ]
    noun = counted(len(balls), "more ball")
    return f"{noun} {'meets' if len(balls) == 1 else 'meet'} {_met(firsts)}; at the end {listed(how)}."


def _plural(verb: str, count: int) -> str:
    return (
        verb
        if count == 1
        else {"flies": "fly", "spins on the spot": "spin on the spot"}.get(verb, verb.removesuffix("s"))
    )
