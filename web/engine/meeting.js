// A ball just before it meets a wall: all that a law may depend on (carom.Meeting).

/** @import { Scene, Vec } from "../state/types.js" */
/** @import { Module } from "./module.js" */
import { contactOf, pullOf, setUp, surfaceAt } from "../scene/setup.js";
import { featuresOf } from "../scene/shapes.js";
import { follow } from "./run.js";

/**
 * @typedef {object} Meeting
 * @property {number} t s: when
 * @property {number} wall the wall's number
 * @property {number} balls how many others the ball has met before
 * @property {number} radius
 * @property {number} mass
 * @property {number} kappa
 * @property {Vec} v
 * @property {Vec} w
 * @property {Vec} n the wall's unit normal, towards the ball
 * @property {number} e the wall's restitution at this speed
 * @property {{e: boolean, mu: boolean}} given whether the wall has them; if not, a law may have its authors' numbers
 * @property {number} mu
 * @property {number} beta tangential restitution
 * @property {number} stiffness tangential over normal stiffness
 * @property {{e: number, mu: number, beta: number} | null} floor null: none; its restitution is that at the speed of approach to the wall
 * @property {number} g m/s^2
 * @property {number} height m: of the centre above its position on the floor
 * @property {boolean} together wall and floor act at once
 */

/** The first hit of the first ball on a wall (its row in the log), and the balls that it meets before. @param {Module} module @param {Scene} scene @returns {{hit: number | undefined, balls: Set<number>}} */
function firstHit(module, scene) {
  const { memory, layout } = module;
  const record = layout.records.log;
  const [kind, ball, other] = ["kind", "ball", "other"].map((name) => memory.field(record, name));
  const own = (/** @type {number} */ at, /** @type {string} */ what) => ball(at) === 0 && layout.kinds[kind(at)] === what;
  const rowsOf = (/** @type {import("./run.js").Part} */ part) => Array.from({ length: part.rows }, (_, i) => part.at + i * record.bytes);
  const { logs } = follow(module, scene, { enough: (last) => rowsOf(last).some((at) => own(at, "wall")) });
  const rows = logs.flatMap(rowsOf);
  const at = rows.findIndex((one) => own(one, "wall"));
  const before = at < 0 ? rows : rows.slice(0, at);
  return { hit: at < 0 ? undefined : rows[at], balls: new Set(before.filter((one) => own(one, "ball")).map(other)) };
}

/** The first meeting of the first ball with a wall, in a run of the scene. Throws a sentence where there is none. @param {Module} module @param {Scene} scene @returns {Meeting} */
export function firstMeeting(module, scene) {
  const { memory, layout } = module;
  const record = layout.records.log;
  const { hit, balls } = firstHit(module, scene);
  if (hit === undefined) throw new Error(withoutMeeting(scene, balls.size));
  const [t, x, v, w, number] = ["t", "x", "v_before", "w_before", "other"].map((field) => memory.field(record, field)(hit));
  // (the surface as the wall has it: a law may hold some of it fixed)
  const plain = { ...scene, run: { ...scene.run, law: "two-step" }, walls: scene.walls.map((wall) => ({ ...wall, law: null })) };
  memory.clear();
  const made = setUp(plain, module);
  const features = memory.records(layout.records.features, made.features);
  const one = memory.records(layout.records.balls, [{ ...made.balls[0], x, v, w }]);
  const gaps = memory.take(8 * made.features.length);
  module.call("gaps", 0, features, made.features.length, one, 1, gaps, 1, made.features.length);
  let met = -1;
  memory.numbers(gaps, made.features.length).forEach((gap, f) => {
    const better = met < 0 || Math.abs(gap) < Math.abs(memory.doubles[gaps / 8 + met]);
    if (made.features[f].wall === number && Number.isFinite(gap) && better) met = f;
  });
  const out = memory.take(40);
  module.call("meet", 0, features + met * layout.records.features.bytes, 1, one, 1, out, 5);
  const [nx, ny, nz, approach, e] = memory.numbers(out, 5);
  const first = made.features.findIndex((feature) => feature.wall === number);
  const [wall, { radius, mass }] = [surfaceAt(scene.walls[number], featuresOf(scene.walls[number])[met - first].pocket, layout), scene.balls[0]];
  const { mu, beta } = contactOf(wall, layout);
  return {
    given: { e: wall.restitution !== null, mu: wall.friction !== null },
    t, wall: number, balls: balls.size, radius, mass, kappa: Number(made.balls[0].kappa), v, w, n: [nx, ny, nz], e, mu, beta,
    stiffness: wall.stiffness_ratio,
    floor: scene.floor && floorAt(module, scene.floor, approach),
    g: scene.floor ? -pullOf(scene)[2] : 0,
    height: scene.floor ? Math.max(x[2] - radius, 0) : Infinity,
    together: scene.run.floor_contact === "with",
  };
}

/** @param {number} count of balls, at least 1 */
export const others = (count) => (count === 1 ? "another ball" : `${count} other balls`);

/** Why there is no meeting. @param {Scene} scene @param {number} balls how many others the ball meets */
function withoutMeeting(scene, balls) {
  const name = scene.balls[0].name ?? "the first ball";
  const met = scene.walls.length === 0 ? "this scene has none" : balls > 0 ? `here it meets ${others(balls)} and no wall` : "here it meets none";
  return `The laws are compared at the first wall that ${name} meets; ${met}.`;
}

/** @param {Module} module @param {import("../state/types.js").Floor} floor @param {number} speed */
function floorAt(module, floor, speed) {
  const { form, p, mu, beta } = contactOf(floor, module.layout);
  const [numbers, out] = [module.memory.put([form, ...p, Math.max(speed, 0)]), module.memory.take(8)];
  module.call("restitution", 0, numbers, 5, out, 1);
  return { e: module.memory.numbers(out, 1)[0], mu, beta };
}
