"""A ball that falls and bounces, by pymunk: ``pip install pymunk``. Prints step, restitution, z, vx, vz of every step."""

import json
import sys

import pymunk

given = json.loads(sys.argv[1])
for step in given["steps"]:
    for e in given["restitutions"]:
        space = pymunk.Space()
        space.gravity = (0, -given["gravity"])
        floor = pymunk.Segment(space.static_body, (-100, -0.5), (100, -0.5), 0.5)
        body = pymunk.Body(1, 0.4 * given["radius"] ** 2)
        body.position, body.velocity = (0, given["height"]), (given["speed"], 0)
        ball = pymunk.Circle(body, given["radius"])
        ball.elasticity = ball.friction = 1.0  # (the numbers of both are multiplied)
        floor.elasticity, floor.friction = e, given["friction"]
        space.add(floor, body, ball)
        for _ in range(round(given["duration"] / step)):
            space.step(step)
            print(step, e, body.position.y, *body.velocity)
