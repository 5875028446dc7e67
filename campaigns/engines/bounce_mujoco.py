"""A ball that falls and bounces, by MuJoCo: ``pip install mujoco``. Prints step, restitution, z, vx, vz of every step."""

import json
import sys

import mujoco

given = json.loads(sys.argv[1])
for step in given["steps"]:
    for e, (stiffness, damping) in zip(given["restitutions"], given["solref"][f"{step}"], strict=True):
        model = mujoco.MjModel.from_xml_string(f"""
        <mujoco><option timestep="{step}" gravity="0 0 {-given["gravity"]}" cone="elliptic"/>
        <worldbody><geom name="floor" type="plane" size="100 100 .1"/><body pos="0 0 {given["height"]}"><freejoint/>
        <geom name="ball" type="sphere" size="{given["radius"]}" mass="1"/></body></worldbody><contact><pair geom1="floor"
        geom2="ball" condim="3" friction="{given["friction"]} {given["friction"]} 0 0 0" solref="{stiffness} {damping}"/>
        </contact></mujoco>""")
        data = mujoco.MjData(model)
        data.qvel[0] = given["speed"]
        for _ in range(round(given["duration"] / step)):
            mujoco.mj_step(model, data)
            print(step, e, data.qpos[2], data.qvel[0], data.qvel[2])
