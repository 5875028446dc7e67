// A ball that falls and bounces, by Rapier: `npm install @dimforge/rapier3d-compat`. Prints step, restitution, z, vx, vz of every step.
import { createRequire } from "node:module";

const R = createRequire(`${process.cwd()}/`)("@dimforge/rapier3d-compat");
await R.init();
const given = JSON.parse(process.argv[2]);
for (const step of given.steps)
  for (const e of given.restitutions) {
    const world = new R.World({ x: 0, y: 0, z: -given.gravity });
    world.timestep = step;
    const floor = R.ColliderDesc.cuboid(100, 100, 0.5).setTranslation(0, 0, -0.5);
    world.createCollider(floor.setRestitution(e).setFriction(given.friction));
    const body = R.RigidBodyDesc.dynamic().setTranslation(0, 0, given.height).setLinvel(given.speed, 0, 0);
    const ball = world.createRigidBody(body.setCcdEnabled(false));
    world.createCollider(R.ColliderDesc.ball(given.radius).setRestitution(e).setFriction(given.friction), ball);
    for (let k = Math.round(given.duration / step); k > 0; k--) {
      world.step();
      console.log(step, e, ball.translation().z, ball.linvel().x, ball.linvel().z);
    }
  }
