"""Record types of the event loop: the world, the balls, and the log of events; and names of what a log holds.

A scene becomes one record of the world, an array of features (F,), and an array of balls (B,); a run writes a log (M,). Compiled
code reads and writes these records in place. They are all that the event loop, the scene and the trajectory share.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.bodies import Numbers, State, vectors
from carom.core.geometry.circles import rim_address
from carom.core.geometry.curve_arcs import arc_address
from carom.core.geometry.features import CURVE, OVER, RIM, gap_to_feature
from carom.core.jit.kernel import vector
from carom.core.jit.threads import row_slices
from carom.core.motion.air import LAWS
from carom.core.motion.phases import PHASES
from carom.errors import CaromError, FaultList
from carom.formatting import format_number
from carom.laws.callbacks import user_address
from carom.laws.law import CALLED_WALL, CONTACT_WALL
from carom.scene.air import balls_in_air
from carom.scene.ruled import BALLS_TOUCH, TOUCH
from carom.scene.scene import Scene

# What can come next for a ball, and what a log says of it. A meeting of balls has two rows of the kind BALL; where contacts overlap
# in time (carom.simulation.cluster) a row of the kind IN_CLUSTER for every other ball that was touched follows, then a row of the
# kind WALL_IN_CLUSTER for every wall that a ball touched. A ball's first row has its velocities before and after all that; each row
# has the impulse of what it names.
(
    START, WALL, FLOOR, BALL, PHASE, SETTLED, LEFT_EVENT, HELD_EVENT, NOTHING, POCKETED_EVENT, IN_CLUSTER, WALL_IN_CLUSTER
) = range(12)  # fmt: skip
# The end of a piece of a path in air, which is no event
PIECE = 12
# As files have them. People see that a phase ends by the name of the one that begins, and "ball" or "wall" in a cluster.
KINDS = (
    "start", "wall", "floor", "ball", "phase", "settled", "left", "held", "nothing", "pocketed", "in-cluster", "wall-in-cluster",
)  # fmt: skip
MEETINGS, WALLS, CLUSTERS = (BALL, IN_CLUSTER), (WALL, WALL_IN_CLUSTER), (IN_CLUSTER, WALL_IN_CLUSTER)
# Kinds of the loop by number as people see them
SEEN = (*KINDS[:IN_CLUSTER], KINDS[BALL], KINDS[WALL])
# The kinds that people see; the end of a phase is called by the phase that begins.
EVENT_KINDS = tuple(
    dict.fromkeys(kind for kind in (*KINDS[:IN_CLUSTER], *PHASES) if kind not in ("start", "phase", "nothing"))
)

_NUMBER, _WHOLE, _VECTOR = "f8", "i8", ("f8", (3,))

# A surface: a form of restitution and its three numbers (carom.core.motion.phases), friction, tangential restitution.
_SURFACE = [("form", _WHOLE), ("p", *_VECTOR), ("mu", _NUMBER), ("beta", _NUMBER)]

WORLD = np.dtype(
    [
        ("force", *_VECTOR),  # acceleration in flight
        ("floor", _WHOLE),  # whether there is one
        ("g", _NUMBER),  # how strongly it is pressed; 0 where nothing presses
        *((f"floor_{name}", *kind) for name, *kind in _SURFACE),
        ("resistance", _NUMBER),
        ("spin_friction", _NUMBER),
        # of a resistance that grows with the speed, s/m; of a spin that fades the faster the more there is of it, 1/s, or the
        # faster the ball rolls, rad/m: 0 by default
        ("rolling_drag", _NUMBER),
        ("spin_damping", _NUMBER),
        ("spin_drag", _NUMBER),
        *((f"pair_{name}", *kind) for name, *kind in _SURFACE),
        # friction that falls with the slip, mu + drop exp(-rate slip) (carom.core.contact.friction_at_slip): 0, 0 where it does not
        ("pair_drop", _NUMBER),
        ("pair_rate", _NUMBER),
        (
            "pair_law",
            _WHOLE,
        ),  # CONTACT_WALL, or from CALLED_WALL on the place of a law that is called, whose last number is pair_beta
        ("pair_modulus", _NUMBER),  # E* of the balls, Pa; 0: contacts take no time, one pair after the other
        ("wind", *_VECTOR),
        ("laws", _NUMBER, (8 * LAWS,)),  # segments of laws of drag and lift (carom.core.motion.air)
        ("together", _WHOLE),  # wall and floor act at once on a ball that the wall pushes down
    ]
)

BALLS = np.dtype(
    [
        ("radius", _NUMBER),
        ("mass", _NUMBER),
        ("kappa", _NUMBER),
        # position, velocity, spin and phase at the ball's own clock: the time of its last event
        ("x", *_VECTOR),
        ("v", *_VECTOR),
        ("w", *_VECTOR),
        ("phase", _WHOLE),
        ("clock", _NUMBER),
        ("acc", *_VECTOR),
        ("turn", *_VECTOR),  # angular acceleration
        # how they change (carom.core.motion.phases.decays); 0 where both are constant
        ("decays", _WHOLE),
        ("fade", _NUMBER),
        ("spin_fade", _NUMBER),
        ("spin_gain", _NUMBER),
        # how a tilted floor turns it downhill (carom.core.motion.tilt.Lean), if ``decays``; the last is 0 where it does not
        ("lean", _NUMBER, (4,)),
        # the feature, counted from 1, that bears it on a tilted floor, else 0; its normal there, and its friction
        # (carom.core.motion.tilt.along_wall)
        ("borne_by", _WHOLE),
        ("borne", _NUMBER, (4,)),
        ("lasts", _NUMBER),  # how long the phase lasts from the clock on
        ("next_in", _NUMBER),  # time from the clock to the next event; the absolute time is next_at
        ("next_at", _NUMBER),
        ("next_kind", _WHOLE),
        ("next_who", _WHOLE),  # the feature, or the other ball
        # the feature, counted from 1, of a wall that yields in which the ball has turned last, and its gap there
        ("turned_in", _WHOLE),
        ("turned_at", _NUMBER),
        ("repeats", _WHOLE),  # events in a row at one place
        ("energy", _NUMBER),  # a unit of mass, since nothing takes any: what rounding must not change; else NaN
        # In a cluster (carom.simulation.cluster). Record k also holds what is of its member k: the ball's number, and bits for the
        # members before it that are near; and the number of the ball that was touched as number k.
        ("member", _WHOLE),
        ("near", _WHOLE),
        ("joined", _WHOLE),  # so for those that stay in contact
        ("touched", _WHOLE),
        ("met", _WHOLE),  # the ball that it touched first, or less than 0
        ("was", _WHOLE),  # its phase before
        *((f"c{name}", *_VECTOR) for name in "xvw"),  # place, velocity and spin in the cluster's own time
        *((f"d{name}", *_VECTOR) for name in "xvw"),  # their changes; then velocity and spin before
        ("push", *_VECTOR),  # force, and its torque per radius
        ("twist", *_VECTOR),
        # the walls near it (carom.simulation.cluster_steps): how many, their features' numbers, bits for those that it has touched
        ("walls", _WHOLE),
        ("wall", _WHOLE),
        ("hits", _WHOLE),
        ("pushes", _WHOLE),  # what pushes it now
        ("parts", _NUMBER),  # how many did in the step that has ended
        ("ago", _NUMBER),  # how far it is put back on its way after a cluster, s
        ("coupled", _WHOLE),  # whether a wall and something else have pushed it at once
        ("rests", _WHOLE),  # whether the floor bears it
        ("wall_n", _NUMBER, (9,)),  # normals
        ("wall_at", _NUMBER, (3,)),  # where the contacts begin, along the normals
        ("wall_push", _NUMBER, (9,)),  # impulses
        # friction at the members before it that are near (carom.simulation.cluster_steps); in air, where there are no clusters,
        # the piece of its path (carom.core.motion.air)
        ("work", _NUMBER, (122,)),
        ("wall_rub", _NUMBER, (24,)),
        # in air: rho pi a^2/(2 m), the share of its weight that air bears, the decay of its spin; first and last segment of its
        # laws of drag and lift, and those of the piece; the piece's span, s, and about how long the next one will be; the time of
        # the last event, and how long after that the piece has begun
        *((name, _NUMBER) for name in ("air", "buoyancy", "spin_decay", "span", "guess", "since", "begun")),
        *((f"{name}{which}", _WHOLE) for name in ("drag", "lift") for which in ("", "_last", "_now")),
        # the order of the piece, and what ends with it; on the floor, the sign of the spin about the vertical, and, if its last
        # number is not 0, the direction that friction keeps
        ("order", _WHOLE),
        ("ends", _WHOLE),
        ("sense", _WHOLE),
        ("course", *_VECTOR),
    ]
)

LOG = np.dtype(
    [
        ("t", _NUMBER),
        ("kind", _WHOLE),
        ("ball", _WHOLE),
        ("met", _WHOLE),  # WALL, BALL, POCKETED_EVENT, or NOTHING: what ``other`` is the number of
        ("other", _WHOLE),  # -1 for none
        ("x", *_VECTOR),
        ("v_before", *_VECTOR),
        ("w_before", *_VECTOR),
        ("v", *_VECTOR),
        ("w", *_VECTOR),
        ("phase_before", _WHOLE),
        ("phase", _WHOLE),
        ("impulse", *_VECTOR),  # N s, on the ball
        ("floor_impulse", *_VECTOR),  # N s: what the floor gave while the wall acted
        ("required", _NUMBER),  # friction
        ("borne_by", _WHOLE),  # as a ball has them
        ("borne", _NUMBER, (4,)),
        ("regime", _WHOLE),  # what the contact did (carom.core.contact.REGIMES); NO_REGIME where a law does not say
    ]
)


def kind_names(rows: NDArray[np.void]) -> NDArray[Any]:
    """Return the kinds of a log's rows as people see them."""
    kinds = np.array(SEEN, dtype=object)[rows["kind"]]
    phases = np.array(PHASES, dtype=object)[rows["phase"]]
    names: NDArray[Any] = np.where(rows["kind"] == PHASE, phases, kinds)
    return names


def first_kinds(log: NDArray[np.void]) -> NDArray[np.int64]:
    """Return for each row (M,) of a whole log the kind with which its event begins: BALL or WALL where contacts overlap in time."""
    number = event_numbers(log)
    found: NDArray[np.int64] = log["kind"][np.unique(number, return_index=True)[1]][number]
    return found


def are_in_clusters(log: NDArray[np.void]) -> NDArray[np.bool_]:
    """Return which rows (M,) of a whole log are of events of contacts that overlap in time."""
    number = event_numbers(log)
    found: NDArray[np.bool_] = np.isin(number, number[np.isin(log["kind"], CLUSTERS)])
    return found


def event_numbers(log: NDArray[np.void]) -> NDArray[np.int64]:
    """Return the number of the event (M,) that each row of a whole log is of: a meeting of balls has two rows or more."""
    kind = log["kind"]
    second = (kind == BALL) & (np.cumsum(kind == BALL) % 2 == 0)
    return np.asarray(np.cumsum(~second & ~np.isin(kind, CLUSTERS)) - 1)


# ----------------------------------------------------------------------------------------------------
# The content of a run that its readers are handed: for tables, files, figures and words.


class EventSource(Protocol):
    """Source of a table of events: :class:`carom.Trajectory` and :class:`carom.ManyRuns` are such sources."""

    @property
    def scene(self) -> Scene:
        """Return the scene."""
        ...

    def kinetic_energy(self, ball: Any, velocity: NDArray[np.float64], spin: NDArray[np.float64]) -> Numbers:
        """Return kinetic energies (N,), J, of balls given by number (N,) at velocities and spins (N, 3)."""
        ...


class RunRecord(EventSource, Protocol):
    """Content of a run for tables and files; :class:`carom.Trajectory` offers it."""

    log: NDArray[np.void]
    end: float
    ended: str

    @property
    def final(self) -> State:
        """Return the final states (B, 3)."""
        ...

    def at(self, t: ArrayLike) -> State:
        """Return states (..., B, 3) at times (...)."""
        ...

    def phase(self, t: ArrayLike) -> NDArray[np.str_]:
        """Return the names of phases (..., B)."""
        ...

    def orientation(self, t: ArrayLike) -> NDArray[np.float64]:
        """Return unit quaternions (..., B, 4)."""
        ...

    def energy(self, t: ArrayLike, *, each: bool = False) -> Numbers:
        """Return energies (...), or (..., B) of each ball, J."""
        ...


# ----------------------------------------------------------------------------------------------------
# Words that the sentences of a run share: times, speeds, directions, enumerations.


def at(row: Any) -> str:
    """Return when a row of the log was written."""
    return f"At {when(row['t'])}"


def when(t: Any) -> str:
    """Format a time; a late one with all digits before the point."""
    return f"{format_number(float(t))} s" if t < 1000 else f"{float(t):,.1f} s"


def speed(v: Any) -> float:
    """Return the length of a vector."""
    return math.sqrt(float((v * v).sum()))


def direction(v: Any) -> str:
    """Return the direction of a velocity: its angle from the x axis, seen from above, and how steep it is."""
    flat = math.hypot(float(v[0]), float(v[1]))
    if flat == 0:
        return ", straight up" if v[2] > 0 else ", straight down"
    degrees = round(math.degrees(math.atan2(float(v[1]), float(v[0])))) % 360  # (0 to 359, as in aim and of cues)
    words = f", {degrees}° from the x axis" if degrees else ", along the x axis"
    steep = math.degrees(math.atan2(float(v[2]), flat))
    return words + (f", {abs(steep):.0f}° {'upwards' if steep > 0 else 'downwards'}" if abs(steep) >= 0.5 else "")


def listed(parts: list[str]) -> str:
    """Return an enumeration with its last two parts joined by "and"."""
    return parts[0] if len(parts) == 1 else f"{', '.join(parts[:-1])} and {parts[-1]}"


# ----------------------------------------------------------------------------------------------------
# Convert a scene to the arrays that the event loop works on.


class SceneArrays(NamedTuple):
    """A scene as arrays of records."""

    world: NDArray[np.void]
    """(1,) of WORLD."""
    features: NDArray[np.void]
    """(F,) of FEATURES."""
    balls: NDArray[np.void]
    """(B,) of BALLS, at the start; read-only where they belong to a scene."""
    users: NDArray[np.int64]
    """Addresses of laws that are not compiled in, in the order of ``scene.called_laws``."""

    def balls_to_move(self) -> NDArray[np.void]:
        """Return a copy of the balls, which a run changes."""
        # (from bytes: NumPy copies the fields of records one by one)
        return np.frombuffer(bytearray(self.balls.tobytes()), BALLS)

    def for_runs(self, count: int) -> SceneArrays:
        """Return the same world and features, and the balls of ``count`` runs, (count, B)."""
        return self._replace(balls=np.tile(self.balls, (count, 1)))


def set_up(scene: Scene, compiled: bool = True) -> SceneArrays:
    """Return the arrays of a scene. The scene keeps them: a run of a shot takes less time than making them.

    With ``compiled`` false nothing is compiled but laws of the user's, and only Python can run the event loop on these arrays.
    """
    key = "compiled arrays" if compiled else "arrays"
    if key not in scene.kept:
        scene.kept[key] = _set_up(scene, compiled)
    found: SceneArrays = scene.kept[key]
    return found


def _set_up(scene: Scene, compiled: bool) -> SceneArrays:
    world = np.zeros(1, WORLD)
    world["force"] = scene.pull
    floor = scene.floor
    if floor is not None:
        world["floor"], world["g"] = 1, -scene.pull[2]
        _surface(world, "floor", floor.contact)
        world["resistance"], world["spin_friction"] = floor.rolling_resistance, floor.spin_friction
        for name in ("rolling_drag", "spin_damping", "spin_drag"):
            world[name] = getattr(floor, name)
    in_air, rows = balls_in_air(scene) if scene.air is not None else ([], [])
    if scene.air is not None:
        world["wind"], world["laws"][0, : 8 * len(rows)] = scene.air.wind, np.ravel(rows)
    law = scene.pair_law
    _surface(world, "pair", scene.ball_contact.contact_of(law))
    world["pair_law"] = CONTACT_WALL if law.one_contact else CALLED_WALL + scene.called_laws.index(law)
    world["pair_mu"], world["pair_drop"], world["pair_rate"] = scene.ball_contact.friction_of(law)
    world["pair_modulus"] = scene.ball_contact.modulus
    world["together"] = scene.run.floor_contact == "with"
    balls = np.zeros(len(scene.balls), BALLS)
    for row, ball in zip(balls, scene.balls, strict=True):
        state = ball.state
        row["radius"], row["mass"], row["kappa"] = ball.radius, ball.mass, ball.ball.kappa
        row["x"], row["v"], row["w"] = ball.center, state.velocity, state.spin
    for row, ball, own in zip(balls if in_air else (), scene.balls, in_air, strict=False):
        row["air"], row["buoyancy"], row["spin_decay"] = own.strength, own.buoyancy, ball.spin_decay
        for name in ("drag", "lift"):
            row[name], row[f"{name}_last"] = getattr(own, name)
        if not any(any(one[2:]) for k in (own.drag, own.lift) for one in rows[k[0] : k[1] + 1]):
            row["air"] = 0
    kernels = [law.kernel for law in scene.called_laws]
    users = [user_address(kernel, compiled) for kernel in kernels if kernel is not None]
    features = scene.features()
    rims = features["kind"] == RIM
    if rims.any():
        features["at"][rims] = rim_address(compiled)
    curves = features["kind"] == CURVE
    if curves.any():
        features["at"][curves] = arc_address(compiled)
    balls.flags.writeable = False
    return SceneArrays(world, features, balls, np.array(users, dtype=np.int64))


def _surface(world: Any, name: str, contact: Any) -> None:
    for field, value in zip(("form", "p", "mu", "beta"), contact, strict=True):
        world[f"{name}_{field}"] = value


# ----------------------------------------------------------------------------------------------------
# Find which of many initial states overlap a wall, the floor, or each other.


def _overlaps(worlds: Any, features: Any, balls: Any, bad: Any) -> None:
    for n in range(balls.shape[0]):
        for i in range(balls.shape[1]):
            ball = balls[n, i]
            x, a = vector(ball.x), ball.radius
            if worlds[0].floor != 0 and x[2] < a * (1 - TOUCH):
                bad[n] = True
            for f in range(features.shape[0]):
                # (a gap below -a: the ball is behind a face, which may be the back of another)
                if features[f].kind != OVER and -a < gap_to_feature(features[f], a, x) < -TOUCH * a:
                    bad[n] = True
            for k in range(i):
                other = balls[n, k]
                reach = a + other.radius - BALLS_TOUCH * min(a, other.radius)
                r = (x[0] - other.x[0], x[1] - other.x[1], x[2] - other.x[2])
                if r[0] * r[0] + r[1] * r[1] + r[2] * r[2] < reach * reach:
                    bad[n] = True


@functools.cache
def _compiled() -> Callable[..., None]:
    from carom.core.jit.compile import njit

    return njit(_overlaps)


def overlapping(setup: SceneArrays, balls: NDArray[np.void]) -> NDArray[np.bool_]:
    """Return (N,) which of the initial states ``balls`` (N, B) overlap a wall, the floor, or each other, by more than touches."""
    bad = np.zeros(len(balls), dtype=bool)
    check = _compiled()
    for rows in row_slices(len(balls), 1024):
        check(setup.world, setup.features, balls[rows], bad[rows])
    return bad


# ----------------------------------------------------------------------------------------------------
# Initial states of many runs of a scene: the scene's balls with the states that are given, checked.


def starts_of(
    where: str, scene: Scene, arrays: SceneArrays, velocity: Any, spin: Any, position: Any
) -> NDArray[np.void]:
    """Return the balls (N, B) at their starts: the scene's, with the states that are given; CaromError for those it refuses."""
    faults = FaultList(where)
    given = {}
    for field, unit, value in (("v", "m/s", velocity), ("w", "rad/s", spin), ("x", "m", position)):
        if value is not None:
            given[field] = vectors(faults, {"v": "velocity", "w": "spin", "x": "position"}[field], value, unit)
    faults.raise_if_any()
    shape: tuple[int, ...] = (1, count := len(arrays.balls))
    if count == 1:
        given = {field: array[:, None, :] if array.ndim == 2 else array for field, array in given.items()}
    for array in given.values():
        # (broadcast, one row a run would set all balls alike, and one row a ball would be one run)
        if count > 1 and (array.ndim != 3 or array.shape[1] != count):
            raise CaromError(
                f"{where}: expected states (N, {count}, 3), runs by balls by axes, got shape {array.shape}"
            )
        try:
            shape = np.broadcast_shapes(shape, array.shape[:-1])
        except ValueError:
            shape = ()
        if len(shape) != 2 or shape[1] != count:
            raise CaromError(f"{where}: expected states (N, {count}, 3), got shape {array.shape}")
    balls = arrays.for_runs(shape[0]).balls
    for field, array in given.items():
        balls[field] = array
    if "x" in given:
        _check_places(where, scene, arrays, balls)
    return balls


def _check_places(where: str, scene: Scene, arrays: SceneArrays, balls: NDArray[np.void]) -> None:
    """Raise CaromError for the first initial state that overlaps something, or lies where no ball can be."""
    bad = overlapping(arrays, balls)
    places, which = np.unique(balls["x"].reshape(-1, 3), axis=0, return_inverse=True)
    walls = [(wall.kernels.blocked, wall.numbers) for wall in scene.walls]
    blocked = np.array([any(check(numbers, x) for check, numbers in walls) for x in map(tuple, places.tolist())])
    bad |= blocked[which.reshape(balls.shape)].any(axis=1)
    if bad.any():
        n = int(np.flatnonzero(bad)[0])
        raise CaromError(
            f"{where}: position: expected places where the balls touch nothing, got {balls['x'][n].tolist()}"
            f" at index {n} ({int(bad.sum())} in all)"
        )
