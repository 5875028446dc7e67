"""A ball that falls and bounces, by PyBullet: ``pip install pybullet``. Prints step, restitution, z, vx, vz of every step."""

import json
import sys

import pybullet as p

given = json.loads(sys.argv[1])
for step in given["steps"]:
    for e in given["restitutions"]:
        p.connect(p.DIRECT)
        p.setGravity(0, 0, -given["gravity"])
        p.setTimeStep(step)
        floor = p.createMultiBody(0, p.createCollisionShape(p.GEOM_PLANE))
        sphere = p.createCollisionShape(p.GEOM_SPHERE, radius=given["radius"])
        ball = p.createMultiBody(1, sphere, basePosition=[0, 0, given["height"]])
        # (the numbers of both are multiplied)
        p.changeDynamics(floor, -1, restitution=e, lateralFriction=given["friction"])
        p.changeDynamics(ball, -1, restitution=1, lateralFriction=1, linearDamping=0, angularDamping=0)
        p.resetBaseVelocity(ball, [given["speed"], 0, 0])
        for _ in range(round(given["duration"] / step)):
            p.stepSimulation()
            v = p.getBaseVelocity(ball)[0]
            print(step, e, p.getBasePositionAndOrientation(ball)[0][2], v[0], v[2])
        p.disconnect()
