"""Real three-cushion shots beside carom: a picture in docs/images and the tables that docs/validation/filmed_shots.md shows.

    python docs/dev/real_shots.py carom_tracks_50hz.csv billiards_parameters.csv

Both files are your own copies. The tracks have rows shot, ball, t_s, x_long_m, y_short_m: three balls from above, no spin.
The start of a ball's run is taken from its track, the constants from the literature; one number a leg is fitted, the
sidespin at the start.
"""

from __future__ import annotations

import argparse
import csv
import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from pathlib import Path

import numpy as np

import carom
from carom.scene.shapes import Table

IMAGES = Path(__file__).parents[1] / "images"
LENGTH, WIDTH = 2.84, 1.42
RADIUS, MASS, GRAVITY = 0.03075, 0.21, 9.80665
LOW = np.array([RADIUS, RADIUS])
HIGH = np.array([LENGTH, WIDTH]) - RADIUS
# The camera's clock. The times of its frames are cut to 0.5 ms in the file; a ball at 5 m/s goes 2.5 mm in that.
FRAME, CUT = 0.0199145, 0.0005
# Alciatore: 5 to 15 rad/s^2 of spin about the vertical, 0.5 from ball to table; the literature has no other values
SPIN_LOSS, FLOOR_RESTITUTION = 10.0, 0.5
# Frames of the free run that the start is fitted to, at least and at most; what they may scatter; the least speed
FEWEST, MOST, SCATTER, SLOWEST = 4, 15, 0.003, 0.3
AFTER = 0.3  # s that a leg must go on after its first cushion
SIDE = 1.25  # the largest sidespin tried, in v/a: a cue half a radius off the centre gives it
TOUCH = 2 * RADIUS + 0.010  # a pass closer than this is taken for a contact: the steps cannot tell
CUSHIONS = 3  # the sidespin is fitted, and distances are told, until the next cushion after so many


# --- constants and laws ----------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Constants:
    """One published set."""

    name: str
    cloth: float
    rolling: float
    restitution: float
    friction: float
    nose: float = 0.037


@dataclass(frozen=True)
class Cushion:
    """What the cushions are taken for."""

    name: str
    law: str = "two-step"
    nose: bool = True
    floor_contact: str = "with"


WITH = Cushion("two-step, nose, cloth and cushion at once")
LAWS = (
    WITH,
    Cushion("two-step, nose, cushion then cloth", floor_contact="after"),
    Cushion("two-step, upright cushion", nose=False),
    Cushion("mirror with restitution", law="mirror", nose=False),
    Cushion("conventional", law="conventional", nose=False),
)


def read_constants(path: Path) -> list[Constants]:
    """The sets that give what a table needs; the first is the one that the page uses."""
    with path.open(newline="") as file:
        rows = {(row["set"], row["quantity"]): row["value"] for row in csv.DictReader(file)}

    def numbers(which: str, quantity: str) -> list[float]:
        return [float(x) for x in re.findall(r"[\d.]+", rows[which, quantity])]

    _m, _r, cloth, rolling, e, mu = numbers("pooltool BILLIARD", "m R u_s u_r e_c f_c")
    billiard = Constants("pooltool BILLIARD", cloth, rolling, e, mu)
    rolls, slides, _rho, _m, _r, e, _slate, mu = numbers("tailuge 3C", "mu muS rho m R ee mu_s mu_w")
    tailuge = Constants("tailuge 3C", slides, rolls, e, mu)
    e, mu, offset = numbers("Alciatore TP7.3", "e / mu / contact offset")
    alciatore = Constants("Alciatore TP7.3", 0.2, 0.01, e, mu, (1 + offset) * RADIUS)
    low, high = numbers("Mathavan2009", "rolling_deceleration")
    mathavan = Constants(
        "Mathavan 2010 (snooker)",
        float(rows["Mathavan2010", "mu_table (assumed mean)"]),
        (low + high) / 2 / GRAVITY,
        float(rows["Mathavan2010", "e_e (energetic; fitted v<1.5 m/s)"]),
        float(rows["Mathavan2010", "mu_cushion (fitted)"]),
        7 / 5 * RADIUS,
    )
    return [billiard, tailuge, alciatore, mathavan]


def table(constants: Constants, cushion: Cushion) -> carom.Scene:
    """A table on which the centre turns where the tracks turn, whatever the height of the nose."""
    reach = math.sqrt(RADIUS**2 - (constants.nose - RADIUS) ** 2) if cushion.nose else RADIUS
    wall = Table(
        length=LENGTH - 2 * (RADIUS - reach), width=WIDTH - 2 * (RADIUS - reach), center=(LENGTH / 2, WIDTH / 2),
        restitution=None if cushion.law == "conventional" else constants.restitution,
        friction=None if cushion.law in ("conventional", "mirror") else constants.friction,
        nose_height=constants.nose if cushion.nose else None,
    )  # fmt: skip
    return carom.Scene(
        gravity=GRAVITY,
        floor=carom.Floor(
            friction=constants.cloth, restitution=FLOOR_RESTITUTION, rolling_resistance=constants.rolling,
            spin_friction=0.4 * RADIUS * SPIN_LOSS / GRAVITY,
        ),
        walls=[wall],
        balls=[carom.SceneBall(radius=RADIUS, mass=MASS, position=(LENGTH / 2, WIDTH / 2))],
        run=carom.Run(law=cushion.law, floor_contact=cushion.floor_contact, duration=30.0),
    )  # fmt: skip


# --- tracks and legs -------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Leg:
    """A ball's run from when it is set in motion until it next meets another ball."""

    shot: str
    ball: str
    struck: bool
    """By another ball, not by the cue."""
    t: np.ndarray
    """(N,) s, the camera's frames."""
    x: np.ndarray
    """(N, 2) m."""
    cushions: np.ndarray
    """(C,) s."""
    slid: float = 0.0
    """s from when it was set in motion to its first frame."""

    def until(self, cushions: int = CUSHIONS) -> Leg:
        """Up to the next cushion after so many."""
        if len(self.cushions) <= cushions:
            return self
        keep = self.t < self.cushions[cushions] - 0.005
        return replace(self, t=self.t[keep], x=self.x[keep], cushions=self.cushions[:cushions])


def read_tracks(path: Path) -> dict[str, dict[str, np.ndarray]]:
    """Rows (t, x, y) of each ball of each shot."""
    shots: dict[str, dict[str, list[list[float]]]] = {}
    with path.open(newline="") as file:
        for row in csv.DictReader(file):
            place = [float(row[key]) for key in ("t_s", "x_long_m", "y_short_m")]
            shots.setdefault(row["shot"], {}).setdefault(row["ball"], []).append(place)
    return {shot: {ball: np.array(rows) for ball, rows in balls.items()} for shot, balls in shots.items()}


def frames(rows: np.ndarray) -> np.ndarray:
    """The rows that the camera saw, on its own clock.

    The others stand at contacts and are interpolated by whoever made the file, some of them 10 ms beside the contact.
    """
    t = rows[:, 0]
    n = np.floor(t / FRAME + 0.05)
    late = n * FRAME - t
    seen = (np.abs(t / CUT - np.round(t / CUT)) < 0.01) & (late > -CUT / 2 - 1e-5) & (late < CUT * 1.2)
    found = rows[seen].copy()
    found[:, 0] = n[seen] * FRAME
    return found[np.concatenate([[True], np.diff(found[:, 0]) > FRAME / 2])] if len(found) else found


def onset(rows: np.ndarray) -> int | None:
    """The first row at which a ball is no longer where it lay."""
    away = np.flatnonzero(np.hypot(*(rows[:, 1:] - rows[0, 1:]).T) > 0.003)
    return int(away[0]) if len(away) else None


def place(rows: np.ndarray, t: np.ndarray) -> np.ndarray:
    """Where a ball is: straight from row to row, but at rest where it has no rows because it does not move."""
    found = np.stack([np.interp(t, rows[:, 0], rows[:, k]) for k in (1, 2)], axis=-1)
    steps = np.diff(rows, axis=0)
    way = np.hypot(steps[:, 1], steps[:, 2])
    speed = way / np.maximum(steps[:, 0], 1e-4)
    for i in np.flatnonzero(steps[:, 0] > 0.05):
        after = speed[i + 1 : i + 4].max(initial=0.0)
        if way[i] < after * steps[i, 0] / 2 or after == 0:
            found[(t > rows[i, 0]) & (t < rows[i + 1, 0])] = rows[i, 1:]
    return found


def closest(first: np.ndarray, second: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Times between the rows of two balls, and how close the two are in each interval."""
    t = np.union1d(first[:, 0], second[:, 0])
    gap = place(first, t) - place(second, t)
    step = np.diff(gap, axis=0)
    share = np.clip(-(gap[:-1] * step).sum(axis=1) / np.maximum((step * step).sum(axis=1), 1e-12), 0, 1)
    return (t[:-1] + t[1:]) / 2, np.hypot(*(gap[:-1] + share[:, None] * step).T)


def meets(balls: dict[str, np.ndarray], ball: str, since: float) -> float:
    """When a ball that was set in motion at ``since`` next meets another."""
    found = math.inf
    for other, rows in balls.items():
        if other == ball:
            continue
        t, gap = closest(balls[ball], rows)
        apart = np.flatnonzero((t > since) & (gap > TOUCH + 0.005))
        near = np.flatnonzero((t > t[apart[0]]) & (gap < TOUCH)) if len(apart) else apart
        if len(near):
            found = min(found, t[near[0]])
        moved = onset(rows)
        if moved is not None and rows[moved, 0] > since + FRAME / 2:
            at = rows[moved, 0]
            if np.hypot(*(place(balls[ball], np.array([at]))[0] - rows[0, 1:])) < 0.2:
                found = min(found, at - FRAME)
    return found


def cushions(rows: np.ndarray) -> np.ndarray:
    """When a ball is at a cushion: it turns near the line, or is on it."""
    found: list[tuple[float, int]] = []
    for axis in (0, 1):
        x = rows[:, 1 + axis]
        step = np.diff(x)
        turns = np.zeros(len(x), bool)
        turns[1:-1] = step[:-1] * step[1:] < 0
        for side, depth in enumerate((x - LOW[axis], HIGH[axis] - x)):
            at = rows[(depth < 0.0005) | (turns & (depth < 0.03)), 0]
            new = np.concatenate([[True], np.diff(at) > 0.08]) if len(at) else np.zeros(0, bool)
            found += [(t, 2 * axis + side) for t in at[new]]
    return np.array([t for t, _side in sorted(found)])


def lost(rows: np.ndarray) -> float:
    """When a moving ball is first lost from sight."""
    steps = np.diff(rows, axis=0)
    gone = np.flatnonzero((steps[:, 0] > 0.1) & (np.hypot(steps[:, 1], steps[:, 2]) > 0.01))
    return float(rows[gone[0], 0]) if len(gone) else math.inf


def awake(rows: np.ndarray) -> np.ndarray:
    """The rows until the ball has come to rest."""
    still = np.hypot(*(rows[:, 1:] - rows[-1, 1:]).T) < 0.001
    moving = np.flatnonzero(~still)
    return rows[: moving[-1] + 2] if len(moving) else rows[:1]


def find_legs(shots: dict[str, dict[str, np.ndarray]], constants: Constants) -> list[Leg]:
    """All first legs with a cushion that tell, before it, how the ball starts."""
    legs = []
    for shot, balls in shots.items():
        starts = {ball: onset(rows) for ball, rows in balls.items()}
        begin = {ball: balls[ball][k, 0] for ball, k in starts.items() if k is not None}
        cue = min(begin, key=lambda ball: (begin[ball], ball))
        for ball, since in begin.items():
            own = balls[ball][starts[ball] :]
            end = min(meets(balls, ball, since), lost(own))
            own = own[own[:, 0] < end - FRAME / 2]
            seen = frames(awake(own)) if len(own) else own
            if len(seen) < FEWEST:
                continue
            at = cushions(own)
            speed = np.hypot(*(seen[2, 1:] - seen[0, 1:])) / (seen[2, 0] - seen[0, 0])
            slid = min(np.hypot(*(seen[0, 1:] - balls[ball][0, 1:])) / max(speed, 1e-6), 2 * FRAME)
            leg = Leg(shot, ball, ball != cue, seen[:, 0], seen[:, 1:], at[at > seen[0, 0]], float(slid))
            if tells(leg, constants):
                legs.append(leg)
    return legs


def tells(leg: Leg, constants: Constants) -> bool:
    """Whether a leg has a cushion, goes on after it, and shows before it how the ball starts."""
    if not len(leg.cushions) or leg.t[-1] < leg.cushions[0] + AFTER or len(free_run(leg)) < FEWEST:
        return False
    _origin, velocity, scatter = start(leg, constants, slides(leg, constants))
    return scatter < SCATTER and float(np.hypot(*velocity)) > SLOWEST


# --- start, run, distance ---------------------------------------------------------------------------------------------


def free_run(leg: Leg) -> np.ndarray:
    """Numbers of the frames before the first cushion."""
    inside = ((leg.x > LOW + 0.001) & (leg.x < HIGH - 0.001)).all(axis=1)
    return np.flatnonzero((leg.t < leg.cushions[0] - 0.003) & inside)[:MOST]


def start(leg: Leg, constants: Constants, sliding: bool) -> tuple[np.ndarray, np.ndarray, float]:
    """Position and velocity at the leg's first frame, and what the frames of the free run scatter about them (m).

    The ball slows as it slides and then as it rolls; its way is straight.
    """
    rows = free_run(leg)
    t, x = leg.t[rows] - leg.t[rows[0]], leg.x[rows]
    slow, roll = constants.cloth * GRAVITY, constants.rolling * GRAVITY
    columns = np.stack([np.ones_like(t), t], axis=1)
    short = np.zeros_like(t)
    along = (x[-1] - x[0]) / np.hypot(*(x[-1] - x[0]))
    for _ in range(8):
        (origin, velocity), *_rest = np.linalg.lstsq(columns, x + short[:, None] * along, rcond=None)
        speed = np.hypot(*velocity)
        along = velocity / speed
        slides = 2 / 7 * (speed - roll_speed(leg, constants, speed, sliding)) / slow
        first, then = np.minimum(t, slides), np.maximum(t - slides, 0)
        short = slow * first * first / 2 + slow * slides * then + roll * then * then / 2
    gap = x + short[:, None] * along - columns @ np.stack([origin, velocity])
    return origin, velocity, float(np.sqrt((gap * gap).sum(axis=1).mean()))


def roll_speed(leg: Leg, constants: Constants, speed: float, sliding: bool) -> float:
    """a times the spin about the axis of rolling at the first frame: all of it, or what the cloth gave since the start."""
    return min(5 / 2 * constants.cloth * GRAVITY * leg.slid, speed) if sliding else speed


def slides(leg: Leg, constants: Constants) -> bool:
    """Whether a ball slides at its start: one that is struck does; the cue ball if that describes its free run better."""
    return leg.struck or start(leg, constants, True)[2] < start(leg, constants, False)[2]


def play(
    scene: carom.Scene, origin: np.ndarray, velocity: np.ndarray, spin: Sequence[float], t: np.ndarray
) -> np.ndarray:
    """Where the simulated ball is at times since its start, (N, 2); NaN where the law has no answer."""
    vx, vy = velocity.tolist()
    ball = scene.balls[0].model_copy(
        update={"position": (*origin.tolist(), RADIUS), "velocity": (vx, vy, 0.0), "spin": tuple(spin)}
    )
    try:
        run = carom.simulate(scene.model_copy(update={"balls": (ball,)}))
    except carom.CaromError:
        return np.full((len(t), 2), np.nan)
    many = np.pad(t, (0, max(0, 400 - len(t))), mode="edge")  # so many are looped over by compiled code
    return np.asarray(run.at(many).position)[: len(t), 0, :2]


@dataclass(frozen=True)
class Fit:
    """A leg and the run beside it."""

    leg: Leg
    origin: np.ndarray
    velocity: np.ndarray
    sliding: bool
    spin_z: float
    scatter: float
    x: np.ndarray
    """(N, 2): the run at the leg's frames."""
    plain: np.ndarray
    """(N,) m: distance over time without sidespin."""

    @property
    def distance(self) -> np.ndarray:
        """(N,) m."""
        return np.hypot(*(self.x - self.leg.x).T)

    @property
    def share(self) -> float:
        """The sidespin over v/a."""
        return self.spin_z * RADIUS / float(np.hypot(*self.velocity))

    @property
    def beside(self) -> np.ndarray:
        """(N,) m: how far the tracked places are from the simulated path, whenever the simulated ball is there."""
        p, q = self.x[:-1], self.x[1:]
        step = q - p
        gap = self.leg.x[:, None] - p
        share = np.clip((gap * step).sum(axis=-1) / np.maximum((step * step).sum(axis=-1), 1e-12), 0, 1)
        return np.sqrt(((gap - share[..., None] * step) ** 2).sum(axis=-1).min(axis=1))

    def passes(self, distance: float = RADIUS) -> float:
        """When the distance first passes a ball's radius, s since the start; infinite if never."""
        far = np.flatnonzero(self.distance > distance)
        return float(self.leg.t[far[0]] - self.leg.t[0]) if len(far) else math.inf


def rms(x: np.ndarray) -> float:
    return float(np.sqrt((x * x).mean()))


def fit(leg: Leg, constants: Constants, cushion: Cushion = WITH, sliding: bool | None = None) -> Fit:
    """The sidespin with which the run comes closest to the leg in the mean square."""
    if cushion.law == "conventional":
        sliding = False  # it knows only balls that roll
    elif sliding is None:
        sliding = slides(leg, constants)
    scene = table(constants, cushion)
    origin, velocity, scatter = start(leg, constants, sliding)
    speed = float(np.hypot(*velocity))
    unit = speed / RADIUS
    rolls = np.array([-velocity[1], velocity[0]]) / speed * roll_speed(leg, constants, speed, sliding) / RADIUS
    t = leg.t - leg.t[0]

    def run(spin_z: float) -> np.ndarray:
        return play(scene, origin, velocity, (*rolls.tolist(), spin_z), t)

    def apart(spin_z: float) -> np.ndarray:
        return np.hypot(*(run(spin_z) - leg.x).T)

    best, width = 0.0, SIDE
    for count, narrower in ((51, 0.05), (11, 0.01), (11, 0.002), (9, 0.0005)):
        tried = np.clip(best + width * np.linspace(-1, 1, count), -SIDE, SIDE)
        tried = tried[np.argsort(np.abs(tried), kind="stable")]  # of equals the least: a little dies before it tells
        costs = [rms(apart(spin * unit)) for spin in tried]
        best = float(tried[int(np.nanargmin(costs))])
        width = narrower
    spin_z = best * unit
    return Fit(leg, origin, velocity, sliding, spin_z, scatter, run(spin_z), apart(0.0))


# --- what the first cushion does ---------------------------------------------------------------------------------------


@dataclass(frozen=True)
class First:
    """The first cushion, by the same straight lines through the same frames of track and run, 20 to 160 ms after it."""

    before: np.ndarray
    """(2,) m/s, along the cushion's normal and along the cushion: of the start."""
    track: np.ndarray
    run: np.ndarray

    @property
    def turned(self) -> float:
        """Degrees between the two, signed: positive where the run leaves closer to the cushion's normal."""
        angles = [math.degrees(math.atan2(v[1], v[0])) for v in (self.track, self.run)]
        return angles[0] - angles[1]


def first_cushion(found: Fit) -> First | None:
    """None where fewer than four frames are left before the next cushion."""
    leg = found.leg
    until = leg.cushions[1] if len(leg.cushions) > 1 else math.inf
    rows = (leg.t > leg.cushions[0] + 0.02) & (leg.t < min(leg.cushions[0] + 0.16, until - 0.01))
    if rows.sum() < FEWEST:
        return None
    at = leg.x[np.argmin(np.abs(leg.t - leg.cushions[0]))]
    axis = int(np.argmin(np.concatenate([at - LOW, HIGH - at]))) % 2
    sign = -np.sign(found.velocity)
    sign[1 - axis] *= -1
    order = [axis, 1 - axis]
    track, run = (np.polyfit(leg.t[rows], x[rows], 1)[0] * sign for x in (leg.x, found.x))
    return First(np.abs(found.velocity)[order], track[order], run[order])


def first_cushions(legs: Sequence[Leg], constants: Constants, cushion: Cushion) -> list[First]:
    """With the sidespin fitted until the second cushion."""
    found = [first_cushion(fit(leg.until(1), constants, cushion)) for leg in legs]
    return [one for one in found if one is not None]


def slowing(t: np.ndarray, x: np.ndarray) -> tuple[float, float]:
    """Speed and deceleration / g on a straight way."""
    way = np.polyfit(t - t[0], np.hypot(*(x - x[0]).T), 2)
    return float(way[1]), float(-2 * way[0] / GRAVITY)


def rolling_loss(legs: Sequence[Leg]) -> np.ndarray:
    """Decelerations / g on straight ways that begin 0.9 s after a cushion or the start, and last half a second."""
    found = []
    for leg in legs:
        for begin, end in pairwise([leg.t[0], *leg.cushions, leg.t[-1] + 0.05]):
            rows = (leg.t > begin + 0.9) & (leg.t < end - 0.05)
            if rows.sum() > 15 and np.ptp(leg.t[rows]) > 0.5:
                found.append(slowing(leg.t[rows], leg.x[rows]))
    return np.array([loss for speed, loss in found if speed > 0.15])


def sliding_loss(legs: Sequence[Leg]) -> np.ndarray:
    """Decelerations / g in the first nine frames of balls that start faster than 1 m/s."""
    ways = [free_run(leg)[:9] for leg in legs]
    found = [slowing(leg.t[rows], leg.x[rows]) for leg, rows in zip(legs, ways, strict=True) if len(rows) == 9]
    return np.array([loss for speed, loss in found if speed > 1])


# --- tables and picture -------------------------------------------------------------------------------------------------


def mm(x: float) -> str:
    return f"{1e3 * x:.0f}"


def print_table(head: str, rows: Sequence[Sequence[str]]) -> None:
    columns = [cell.strip() for cell in head.split("|")]
    print("\n| " + " | ".join(columns) + " |\n|" + "---|" * len(columns))
    for cells in rows:
        print("| " + " | ".join(cells) + " |")


def leg_row(found: Fit) -> list[str]:
    leg, when = found.leg, found.passes()
    count = int((leg.cushions < leg.t[0] + when).sum())
    bound = " (the most)" if abs(found.share) > SIDE - 1e-6 else ""
    return [
        f"{leg.shot.removeprefix('shot_')}, {leg.ball}",
        "a ball" if leg.struck else "the cue",
        f"{np.hypot(*found.velocity):.2f}",
        str(len(leg.cushions)),
        f"{np.ptp(leg.t):.2f}",
        mm(rms(found.distance)),
        mm(found.distance.max()),
        mm(rms(found.beside)),
        f"{found.spin_z:.0f}",
        f"{found.share:.2f}{bound}",
        mm(rms(found.plain)),
        "never" if math.isinf(when) else f"{when:.2f} s, after {count}",
    ]


def law_row(name: str, legs: Sequence[Leg], constants: Constants, cushion: Cushion) -> list[str]:
    fits = [fit(leg.until(), constants, cushion) for leg in legs]
    firsts = first_cushions(legs, constants, cushion)
    normal = np.percentile([one.track[0] / one.run[0] for one in firsts], [25, 50, 75])
    along = np.median([(one.track[1] - one.run[1]) / np.hypot(*one.before) for one in firsts])
    return [
        name,
        mm(np.median([rms(one.distance) for one in fits])),
        mm(np.median([rms(one.beside) for one in fits])),
        mm(np.median([rms(one.plain) for one in fits])),
        f"{normal[1]:.2f} ({normal[0]:.2f} to {normal[2]:.2f})",
        f"{100 * along:+.1f} %",
        f"{np.median([abs(one.turned) for one in firsts]):.1f}",
    ]


def by_cushions(fits: Sequence[Fit]) -> list[list[str]]:
    """The distance in the last frame before each cushion."""
    rows = []
    for count in range(CUSHIONS + 1):
        gaps = []
        for one in fits:
            ends = [*one.leg.cushions, one.leg.t[-1] + 1]
            if len(one.leg.cushions) >= count:
                gaps.append(one.distance[np.flatnonzero(one.leg.t < ends[count] - 0.003)[-1]])
        rows.append([str(count), str(len(gaps)), mm(np.median(gaps)), mm(np.max(gaps))])
    return rows


STYLE = {
    "svg.hashsalt": "carom", "font.family": "STIXGeneral", "mathtext.fontset": "stix",
    "svg.fonttype": "path", "font.size": 9, "axes.spines.top": False, "axes.spines.right": False,
    "axes.titlesize": 9, "axes.titlelocation": "left", "legend.frameon": False,
}  # fmt: skip
BALLS = {"1": "#1f5fa8", "2": "#c0392b", "3": "#2e8b57"}
COUNTED = ("#888888", "#1f5fa8", "#e08e0b", "#c0392b")


def draw_shot(axes: object, fits: Sequence[Fit]) -> None:
    """One shot from above."""
    nose = np.array([[0, 0], [LENGTH, 0], [LENGTH, WIDTH], [0, WIDTH], [0, 0]])
    axes.plot(*nose.T, color="#888888", lw=0.8)
    for one in fits:
        color = BALLS[one.leg.ball]
        axes.plot(*one.leg.x[::2].T, "o", ms=1.8, color=color, mec="none")
        axes.plot(*one.x.T, color=color, lw=0.7)
        axes.plot(*one.leg.x[0], "o", ms=5, mfc="none", mec=color, mew=0.8)
    told = ", ".join(mm(rms(one.distance)) for one in fits)
    axes.set(aspect="equal", xticks=[], yticks=[], title=f"shot {fits[0].leg.shot.removeprefix('shot_')}: {told} mm")
    axes.set_axis_off()
    axes.title.set_visible(True)


def draw_distances(axes: object, fits: Sequence[Fit]) -> None:
    """Distances over time in ball radii, coloured by the cushions so far."""
    for one in fits:
        t, gap = one.leg.t - one.leg.t[0], np.maximum(one.distance, 1e-4) / RADIUS
        count = np.searchsorted(one.leg.cushions, one.leg.t)
        for k, color in enumerate(COUNTED):
            rows = np.flatnonzero(count == k)
            if len(rows):
                part = slice(max(rows[0] - 1, 0), rows[-1] + 1)
                axes.plot(t[part], gap[part], color=color, lw=0.8)
    for k, color in enumerate(COUNTED):
        axes.plot([], [], color=color, label=("no cushion yet", "after 1", "after 2", "after 3")[k])
    axes.axhline(1, color="black", lw=0.7, ls="--")
    axes.set(yscale="log", xlim=(0, 6), ylim=(0.005, 40), xlabel="time, s", ylabel="distance, ball radii (30.75 mm)",
             title="Distance from track to simulation, all legs")  # fmt: skip
    axes.legend(loc="lower right", fontsize=8)


def draw_first(axes: object, ways: Sequence[tuple[str, str, Sequence[First]]]) -> None:
    """Normal speeds after the first cushion, simulated over tracked."""
    for marker, name, firsts in ways:
        axes.plot(*np.array([(one.track[0], one.run[0]) for one in firsts]).T, marker, ms=4, mew=0.8, label=name)
    axes.plot([0, 2.6], [0, 2.6], color="#888888", lw=0.8)
    axes.set(xlim=(0, 2.6), ylim=(0, 2.6), aspect="equal", xlabel="tracked, m/s", ylabel="simulated, m/s",
             title="Normal speed after the first cushion")  # fmt: skip
    axes.legend(loc="upper left", fontsize=8)


def draw(legs: Sequence[Leg], fits: Sequence[Fit], constants: Constants, file: Path, shots: int = 16) -> None:
    """The first shots from above; distances; the first cushion."""
    import matplotlib as mpl

    mpl.use("svg")
    import matplotlib.pyplot as plt

    names = list(dict.fromkeys(leg.shot for leg in legs))[:shots]
    with plt.rc_context(STYLE):
        figure = plt.figure(figsize=(10.5, 11.0), layout="constrained")
        upper, lower = figure.subfigures(2, 1, height_ratios=[2.1, 1])
        for axes, shot in zip(upper.subplots(4, 4).flat, names, strict=False):
            draw_shot(axes, [one for one in fits if one.leg.shot == shot])
        key = [plt.Line2D([], [], color=color, label=f"ball {ball}") for ball, color in BALLS.items()]
        key += [
            plt.Line2D([], [], color="#444444", marker="o", ls="", ms=2.5, label="track, every second frame"),
            plt.Line2D([], [], color="#444444", lw=0.8, label="simulation, sidespin fitted"),
            plt.Line2D([], [], color="#444444", marker="o", ls="", ms=5, mfc="none", label="start of the leg"),
        ]
        upper.legend(handles=key, loc="outside lower center", ncols=6, fontsize=8)
        upper.suptitle("Table 2.84 m x 1.42 m from above; RMS distance of each leg", fontsize=10, x=0.01, ha="left")
        left, right = lower.subplots(1, 2, width_ratios=[1.5, 1])
        draw_distances(left, fits)
        with_, after = LAWS[:2]
        ways = [("o", "cloth and cushion at once", first_cushions(legs, constants, with_))]
        ways += [("x", "cushion, then cloth", first_cushions(legs, constants, after))]
        draw_first(right, ways)
        file.parent.mkdir(exist_ok=True)
        figure.savefig(file, metadata={"Date": None} if file.suffix == ".svg" else None, dpi=110)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("tracks", type=Path)
    parser.add_argument("parameters", type=Path)
    parser.add_argument("--picture", type=Path, default=IMAGES / "real_shots.svg")
    given = parser.parse_args()
    sets = read_constants(given.parameters)
    base = sets[0]
    legs = find_legs(read_tracks(given.tracks), base)
    fits = [fit(leg.until(), base) for leg in legs]
    print(f"{len(legs)} legs of {len({leg.shot for leg in legs})} shots; {base}")
    print_table(
        "shot, ball | set in motion by | speed, m/s | cushions | s | RMS, mm | largest, mm | beside the path, mm"
        " | sidespin, rad/s | over v/a | RMS without, mm | a radius off at",
        [leg_row(one) for one in fits],
    )
    print_table("cushions so far | legs | median distance, mm | largest, mm", by_cushions(fits))
    head = (
        "{} | RMS, mm | beside the path, mm | RMS without sidespin, mm | 1st cushion: normal speed, track / run"
        " | along it, track - run | angle off, degrees"
    )
    print_table(head.format("cushion"), [law_row(law.name, legs, base, law) for law in LAWS])
    mixed = replace(base, name="pooltool BILLIARD, rolling 0.0055 of tailuge 3C", rolling=sets[1].rolling)
    after = [(replace(one, name=f"{one.name}, cushion then cloth"), LAWS[1]) for one in (*sets, mixed)]
    tried = [pair for one, other in zip((*sets, mixed), after, strict=True) for pair in ((one, WITH), other)]
    print_table(head.format("constants"), [law_row(one.name, legs, one, law) for one, law in tried])
    print()
    for what, loss in (("rolling", rolling_loss(legs)), ("sliding", sliding_loss(legs))):
        low, middle, high = np.percentile(loss, [25, 50, 75])
        print(f"{what}: deceleration / g {middle:.4f} (quartiles {low:.4f} to {high:.4f}, {len(loss)} ways)")
    for struck, who in ((True, "struck"), (False, "by the cue")):
        both = [[start(leg, base, slide)[2] for slide in (True, False)] for leg in legs if leg.struck == struck]
        sliding, rolling = 1e3 * np.median(both, axis=0)
        print(f"{who}: free run scatters {sliding:.2f} mm about a sliding start, {rolling:.2f} mm about a rolling one")
    for leg in legs:
        if not leg.struck:
            slid, rolled = (rms(fit(leg.until(), base, sliding=slide).distance) for slide in (True, False))
            print(f"cue ball of {leg.shot}: RMS {mm(slid)} mm if it slides, {mm(rolled)} mm if it rolls")
    draw(legs, fits, base, given.picture)


if __name__ == "__main__":
    main()
