"""Scenes of gases that several tests share."""

from __future__ import annotations

ROUGH = """
[container]
shape = "periodic"
size = [8.0, 7.5, 7.0]
[[species]]
name = "a"
count = 200
radius = 0.5
mass = 1.0
inertia = 0.4
temperature = 1.0
temperature_rotational = 0.5
[[contacts]]
between = ["a", "a"]
restitution = 1.0
friction = inf
tangential_restitution = 1.0
[run]
equilibrate = 5_000
max_events = 60_000
seed = 1
"""

MIXED = """
gravity = 0.2
contact_time = 1e-6
[container]
shape = "box"
size = [20.0, 16.0]
periodic = ["x"]
[[species]]
name = "big"
count = 60
radius = 0.6
mass = 1.44
[[species]]
name = "small"
count = 100
radius = 0.3
mass = 0.36
inertia = "ring"
temperature_rotational = 0.0
[[contacts]]
between = ["big", "big"]
restitution = 0.99
friction = 0.3
tangential_restitution = 0.5
[[contacts]]
between = ["small", "big"]
restitution = 1.0
friction = inf
tangential_restitution = 1.0
[[contacts]]
between = ["small", "small"]
restitution = 1.0
friction = 0.0
[[contacts]]
between = ["big", "wall"]
restitution = 1.0
friction = 0.5
[[contacts]]
between = ["small", "top"]
restitution = 1.0
friction = inf
[[contacts]]
between = ["small", "bottom"]
restitution = 0.9
friction = 0.0
[run]
start = "random"
equilibrate = 0
duration = 20.0
seed = 3
"""
