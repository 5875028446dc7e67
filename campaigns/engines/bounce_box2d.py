"""A ball that falls and bounces, by Box2D 3: ``pip install pyb2d3``. Prints step, restitution, z, vx, vz of every step."""

import json
import sys

import pyb2d3 as b2d

given = json.loads(sys.argv[1])
for step in given["steps"]:
    for e in given["restitutions"]:
        world = b2d.World(gravity=(0, -given["gravity"]))
        material = b2d.surface_material(restitution=e, friction=given["friction"])
        floor = world.create_static_body(position=(0, 0))
        floor.create_shape(b2d.shape_def(material=material), b2d.box(hx=100, hy=0.5, center=(0, -0.5)))
        ball = world.create_dynamic_body(
            position=(0, given["height"]), linear_velocity=(given["speed"], 0), linear_damping=0, angular_damping=0
        )
        ball.create_shape(b2d.shape_def(material=material, density=1), b2d.circle(radius=given["radius"]))
        for _ in range(round(given["duration"] / step)):
            world.step(step, 4)
            print(step, e, ball.position[1], ball.linear_velocity[0], ball.linear_velocity[1])
