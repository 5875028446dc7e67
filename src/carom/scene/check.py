"""What only the whole scene can tell: what overlaps, what a law lacks, what the floor does not allow."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from carom.kernel import Vec
from carom.law import LAWS, Law, Meeting
from carom.scene.faults import Fault, Words
from carom.scene.features import OVER, distance, feature_normal
from carom.scene.parts import Feature
from carom.scene.restitution import Constant
from carom.scene.wall import spelled
from carom.state import State
from carom.units import length

if TYPE_CHECKING:
    from carom.scene.balls import SceneBall
    from carom.scene.model import Scene
    from carom.scene.wall import Wall

__all__ = ["scene_faults"]

TOUCH = 1e-9  # of the radius: what overlaps by less touches


def scene_faults(scene: Scene) -> list[Fault]:
    """All faults of a scene whose parts are sound."""
    return [*_floor_faults(scene), *_law_faults(scene), *_wall_overlaps(scene), *_ball_overlaps(scene)]


# --- floor --------------------------------------------------------------------------------------------------------


def _floor_faults(scene: Scene) -> list[Fault]:
    found = []
    gx, gy, gz = scene.gravity
    if scene.floor is not None and (gx != 0 or gy != 0 or gz > 0):
        advice = (
            "on a tilted floor a sliding ball has no path in closed form; leave the floor out and use a wall of shape"
            " 'plane', on which the ball flies and bounces"
        )
        got = Words(spelled(scene.gravity))
        found.append(Fault("gravity along -z, as there is a floor", got, advice if gx or gy else "", ("gravity",)))
    for i, ball in enumerate(scene.balls):
        z, a = ball.center[2], ball.radius
        if scene.floor is not None and z < a * (1 - TOUCH):
            got = Words(f"{z:.6g}, which overlaps the floor by {length(a - z)}")
            advice = "leave out z to put it on the floor"
            found.append(Fault(f"z of at least the radius, {a:.6g}", got, advice, ("balls", i, "position", 2)))
        elif ball.rolling and scene.floor is None:
            found.append(Fault("a floor to roll on", Words("true in a scene without one"), at=("balls", i, "rolling")))
        elif ball.rolling and z > a * (1 + TOUCH):
            got, advice = Words(f"{z:.6g} of a ball that rolls"), "leave out z, or rolling"
            found.append(Fault(f"z = radius = {a:.6g}", got, advice, ("balls", i, "position", 2)))
    return found


# --- laws ---------------------------------------------------------------------------------------------------------


def _law_faults(scene: Scene) -> list[Fault]:
    found = []
    heights = [ball.radius for ball in scene.balls]
    for i, (wall, law) in enumerate(zip(scene.walls, scene.wall_laws, strict=True)):
        at = ("walls", i)
        springs = LAWS[law] if isinstance(law, str) and law in LAWS and LAWS[law].compliant else None
        if law == "two-step" or springs:
            advice = f"the law {law} reads it; no-slip, conventional and mirror do not need it"
            if wall.restitution is None:
                found.append(Fault("a number from 0 to 1, or a form", Words("nothing"), advice, (*at, "restitution")))
            if wall.friction is None:
                found.append(Fault("a number >= 0 (inf: never slips)", Words("nothing"), advice, (*at, "friction")))
        if springs:
            found += _spring_faults(scene, wall, springs, at)
        elif law == "conventional":
            if not all(wall.vertical(z) for z in (min(heights), max(heights))):
                got = Words(wall.describe())
                advice = "no other leaves a rolling ball on the floor; two-step does any wall"
                found.append(Fault("a vertical wall for the law conventional", got, advice, at))
            if not (wall.restitution is None or wall.restitution == Constant(value=1.0)):
                got = Words(wall.restitution.describe().removeprefix("restitution "))
                advice = "it gives back all of the normal velocity; leave it out"
                found.append(Fault("1 for the law conventional", got, advice, (*at, "restitution")))
    if "conventional" in scene.wall_laws and scene.floor is None:
        k = scene.wall_laws.index("conventional")
        here: tuple[str | int, ...] = ("walls", k, "law") if scene.walls[k].law else ("run", "law")
        found.append(Fault("a [floor] for the law conventional", Words("none"), "its ball rolls all the time", here))
    return found


def _spring_faults(scene: Scene, wall: Wall, law: Law, at: tuple[str | int, ...]) -> list[Fault]:
    """What a law with springs along the surface does not take: its own conditions, asked for each ball's inertia."""
    found = []
    for ball in {ball.ball.kappa: ball for ball in scene.balls}.values():
        towards = State((-1.0, 0.0, 0.0), (0.0, 0.0, 0.0))
        for holds, expected in law.conditions(Meeting(ball.ball, towards, stiffness_ratio=wall.stiffness_ratio)):
            if not np.all(holds):
                found.append(
                    Fault(f"for the law {law.name} {expected}", wall.stiffness_ratio, at=(*at, "stiffness_ratio"))
                )
    if wall.tangential_restitution != 0:
        advice = "it has springs in its place; leave it out, and give stiffness_ratio"
        expected = f"0 for the law {law.name}"
        found.append(Fault(expected, wall.tangential_restitution, advice, (*at, "tangential_restitution")))
    return found


# --- walls --------------------------------------------------------------------------------------------------------


def _wall_overlaps(scene: Scene) -> list[Fault]:
    found = []
    largest = max(range(len(scene.balls)), key=lambda i: scene.balls[i].radius)
    for k, wall in enumerate(scene.walls):
        name = f"walls[{k}] ({scene.wall_names[k]})"
        if scene.balls[largest].radius >= wall.room:
            expected = f"room for a ball of radius {length(scene.balls[largest].radius)} (balls[{largest}])"
            got = Words(f"room for radii below {length(wall.room)}")
            found.append(Fault(expected, got, "make the wall larger, or the ball smaller", ("walls", k)))
            continue
        found += _rolls_under(scene, wall, k)
        features = [feature for feature in wall.features() if feature.kind != OVER]
        for i, ball in enumerate(scene.balls):
            at = ("balls", i, "position")
            if wall.blocked(ball.center):
                got = Words(f"{spelled(ball.center)}, where {wall.describe()} lets no ball be")
                advice = "move the ball" + ("; or turn the normal round" if wall.kind == "plane" else "")
                found.append(Fault(f"a place on the free side of {name}", got, advice, at))
            else:
                found += _overlap(ball, features, name, at)
    return found


def _rolls_under(scene: Scene, wall: Wall, k: int) -> list[Fault]:
    """A table whose cushions a ball would roll under: it has nothing behind them."""
    nose = getattr(wall, "nose_height", None)
    smallest = min(range(len(scene.balls)), key=lambda i: scene.balls[i].radius)
    diameter = 2 * scene.balls[smallest].radius
    if nose is None or nose < diameter:
        return []
    expected = f"less than {length(diameter)}, the diameter of balls[{smallest}], which would roll under it"
    return [Fault(expected, nose, "a cushion's nose stands at 5/4 to 7/5 of the radius", ("walls", k, "nose_height"))]


def _overlap(ball: SceneBall, features: list[Feature], name: str, at: tuple[str | int, ...]) -> list[Fault]:
    """The deepest overlap of a ball with a wall; a face that it is behind of does not count."""
    a, x = ball.radius, ball.center
    gaps = [distance(feature, a, x) for feature in features]
    gap = min((gap for gap in gaps if gap >= -a), default=math.inf)
    if gap >= -TOUCH * a:
        return []
    n: Vec = feature_normal(features[gaps.index(gap)], x)
    place = (x[0] - (gap + a) * n[0], x[1] - (gap + a) * n[1], x[2] - (gap + a) * n[2])
    got = Words(f"{spelled(x)}, which overlaps {name} by {length(-gap)} at {spelled(place)}")
    return [Fault("a place where the ball touches nothing", got, f"move it by {length(-gap)} or more", at)]


# --- balls --------------------------------------------------------------------------------------------------------


def _ball_overlaps(scene: Scene) -> list[Fault]:
    """Pairs of balls that overlap, found along x: of each ball those whose x is near enough."""
    found = []
    x = np.array([ball.center for ball in scene.balls])
    a = np.array([ball.radius for ball in scene.balls])
    order = np.argsort(x[:, 0], kind="stable")
    x, a = x[order], a[order]
    last = np.searchsorted(x[:, 0], x[:, 0] + a + a.max(), side="right")
    for i in range(len(x) - 1):
        near = slice(i + 1, last[i])
        gap = np.sqrt(((x[near] - x[i]) ** 2).sum(axis=1)) - a[near] - a[i]
        for j in np.flatnonzero(gap < -TOUCH * np.minimum(a[near], a[i])):
            one, two = sorted((int(order[i]), int(order[i + 1 + j])))
            found.append((one, two, float(-gap[j])))
    return [
        Fault(
            "a place where the ball touches nothing",
            Words(f"{spelled(scene.balls[two].center)}, which overlaps balls[{one}] by {length(deep)}"),
            f"move it by {length(deep)} or more",
            ("balls", two, "position"),
        )
        for one, two, deep in sorted(found)
    ]
