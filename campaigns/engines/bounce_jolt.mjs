// A ball that falls and bounces, by Jolt: `npm install jolt-physics`. Prints step, restitution, z, vx, vz of every step.
import { pathToFileURL } from "node:url";

const { default: start } = await import(pathToFileURL(`${process.cwd()}/node_modules/jolt-physics/dist/jolt-physics.wasm-compat.js`));
const J = await start();
const given = JSON.parse(process.argv[2]);
for (const step of given.steps)
  for (const e of given.restitutions) {
    const settings = new J.JoltSettings();
    const pairs = new J.ObjectLayerPairFilterTable(2);
    pairs.EnableCollision(0, 1);
    const layers = new J.BroadPhaseLayerInterfaceTable(2, 2);
    for (const k of [0, 1]) layers.MapObjectToBroadPhaseLayer(k, new J.BroadPhaseLayer(k));
    settings.mObjectLayerPairFilter = pairs;
    settings.mBroadPhaseLayerInterface = layers;
    settings.mObjectVsBroadPhaseLayerFilter = new J.ObjectVsBroadPhaseLayerFilterTable(layers, 2, pairs, 2);
    const world = new J.JoltInterface(settings);
    const system = world.GetPhysicsSystem();
    system.SetGravity(new J.Vec3(0, 0, -given.gravity));
    const put = (shape, z, kind, layer, active) => {
      const about = new J.BodyCreationSettings(shape, new J.RVec3(0, 0, z), new J.Quat(0, 0, 0, 1), kind, layer);
      about.mRestitution = e;
      about.mFriction = given.friction;
      about.mLinearDamping = about.mAngularDamping = 0;
      about.mLinearVelocity = new J.Vec3(active * given.speed, 0, 0);
      const body = system.GetBodyInterface().CreateBody(about);
      system.GetBodyInterface().AddBody(body.GetID(), active ? J.EActivation_Activate : J.EActivation_DontActivate);
      return body;
    };
    put(new J.BoxShape(new J.Vec3(100, 100, 0.5)), -0.5, J.EMotionType_Static, 0, 0);
    const ball = put(new J.SphereShape(given.radius), given.height, J.EMotionType_Dynamic, 1, 1);
    for (let k = Math.round(given.duration / step); k > 0; k--) {
      world.Step(step, 1);
      const v = ball.GetLinearVelocity();
      console.log(step, e, ball.GetPosition().GetZ(), v.GetX(), v.GetZ());
    }
    J.destroy(world);
  }
