"""Scenes to draw: each with something that pictures and animations must cope with."""

import math

from carom.scene import BallContact, Box, Floor, Plane, Run, Scene, SceneBall, Sphere, Stadium, Table

BALL = {"radius": 0.02625, "mass": 0.1406}


def hop(duration: float = 1.0) -> Scene:
    """The paper's ball, on a floor that gives something back."""
    return Scene(
        floor=Floor(friction=math.inf, restitution=0.5),
        walls=(Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=1.0, friction=math.inf),),
        balls=(SceneBall(**BALL, position=(0.4, -0.3), velocity=(-1.0, 1.0), rolling=True),),
        run=Run(duration=duration),
    )


def three() -> Scene:
    ball = {"radius": 0.03075, "mass": 0.21}
    return Scene(
        floor=Floor(friction=0.2, restitution=0.5, rolling_resistance=0.01, spin_friction=0.0127),
        walls=(Table(length=2.84, width=1.42, nose_height=0.037, restitution=0.85, friction=0.2),),
        balls=(
            SceneBall(**ball, name="white", position=(-1.0, -0.3), velocity=(4.2, 1.82), spin=(0.0, 60.0, 80.0)),
            SceneBall(**ball, name="yellow", position=(-0.71, 0.2)),
            SceneBall(**ball, name="red", position=(0.71, 0.42)),
        ),
        ball_contact=BallContact(restitution=0.95, friction=0.05),
        run=Run(duration=12.0),
    )


def free() -> Scene:
    return Scene(
        walls=(Box(center=(0, 0, 0.3), size=(0.8, 0.6, 0.6), inside=True, restitution=0.9, friction=0.2),),
        balls=(SceneBall(radius=0.03, mass=0.1, position=(0.1, 0.0, 0.4), velocity=(1.2, 0.9, 1.0), spin=(0, 30, 0)),),
        run=Run(duration=2.0),
    )


def gallery() -> Scene:
    return Scene(
        gravity=0,
        walls=(
            Stadium(straight=1.0, radius=0.5, law="mirror", restitution=1.0),
            Sphere(center=(0.5, 0.2, 0.0), radius=0.1, law="mirror", restitution=1.0),
        ),
        balls=(SceneBall(radius=0.02, mass=0.1, position=(0.1, 0.05), velocity=(1.2, 0.9), spin=(0, 0, 9)),),
        run=Run(max_events=60),
    )


def still() -> Scene:
    return Scene(floor=Floor(friction=0.2), balls=(SceneBall(**BALL, position=(0, 0)),))


def away() -> Scene:
    return Scene(gravity=0, balls=(SceneBall(**BALL, position=(0, 0), velocity=(1, 0)),))


SCENES = [hop, three, free, gallery, still, away]
