// What each law predicts for one ball at one wall (carom.laws): the wall, the flight, the landing, the rolling. All numbers are from
// the module's kernels.

/** @import { Vec } from "../state/types.js" */
/** @import { Law } from "./types.js" */
/** @import { Meeting } from "./meeting.js" */
/** @import { Module } from "./module.js" */
import { numbersOf } from "./objections.js";

/** @typedef {{v: Vec, w: Vec}} Motion */

/** Flight, first landing and final rolling. @typedef {{height: number, distance: number, required: number, rolling: Motion, why: number}} Steps */

/**
 * @typedef {object} Answer
 * @property {Motion} afterWall
 * @property {Motion} final NaN where there is none
 * @property {number} required friction of the wall
 * @property {number} requiredFloor
 * @property {string} why why there is no final state, else empty
 * @property {Steps | null} steps
 * @property {number} [vertical] the vertical velocity after the wall that a law of cushions drops, m/s
 * @property {boolean} [withFloor] whether the floor has a part in the required friction before the landing, as in the two-step law
 */

const ROUNDING = 1e-12;

/** @param {number[]} found @param {number} at @returns {Vec} */
const three = (found, at) => [found[at], found[at + 1], found[at + 2]];

/** The wall alone, by a law's kernel. @param {Module} module @param {Meeting} m @param {Law} law @returns {Motion} */
function atWall(module, m, law) {
  const out = module.memory.take(48);
  const last = { stiffness_ratio: m.stiffness, floor_friction: m.floor?.mu ?? 0, tangential_restitution: m.beta }[law.last];
  module.exports[law.function](...m.v, ...m.w, ...m.n, m.radius, m.kappa, m.e, m.mu, last, out);
  const found = module.memory.numbers(out, 6);
  return { v: three(found, 0), w: three(found, 3) };
}

/** @param {Module} module @param {Meeting} m @param {Motion} after @returns {Steps | null} null without a floor */
function settle(module, m, after) {
  if (m.floor === null) return null;
  const { memory } = module;
  const numbers = [...after.v, ...after.w, ...m.n, m.radius, m.kappa, m.floor.e, m.floor.mu, m.floor.beta, m.g, m.height];
  const [taken, out] = [memory.put(numbers), memory.take(8 * 21)];
  module.call("second_impact", 0, taken, numbers.length, out, 21);
  const found = memory.numbers(out, 21);
  return { height: found[1], distance: found[2], required: found[12], rolling: { v: three(found, 14), w: three(found, 17) }, why: found[20] };
}

/** What is said of the motion just after a wall, and of the last one (carom.explorer.entries.judge_row). @param {Module} module @param {Meeting} m @param {Motion} after @param {Motion} [final] */
export function judged(module, m, after, final = after) {
  const { memory } = module;
  const numbers = [...numbersOf(m), ...after.v, ...after.w, ...final.v, ...final.w];
  const [given, out] = [memory.put(numbers), memory.take(48)];
  module.call("judge", 0, given, numbers.length, out, 6);
  const [required, slips, incidence, afterWall, angle, kept] = memory.numbers(out, 6);
  return { required, slips, incidence, afterWall, angle, kept };
}

/** @param {Module} module @param {Meeting} m @param {Motion} after @returns {Answer} */
function wallThenFloor(module, m, after) {
  const steps = settle(module, m, after);
  return {
    afterWall: after,
    final: steps === null ? after : steps.rolling,
    required: judged(module, m, after).required,
    requiredFloor: steps === null ? 0 : steps.required,
    why: steps === null ? "" : module.layout.reasons[steps.why],
    steps,
  };
}

/** @param {Module} module @param {Meeting} m @param {boolean} together @returns {Answer} */
function twoStep(module, m, together) {
  const { memory, layout } = module;
  const floor = m.floor ?? { e: 0, mu: 0, beta: 0 };
  const height = m.floor === null ? 1 : m.height;
  const numbers = [...m.v, ...m.w, ...m.n, m.radius, m.kappa, m.e, m.mu, m.beta, floor.e, floor.mu, floor.beta, height, Number(together)];
  const [taken, out] = [memory.put(numbers), memory.take(8 * 14)];
  module.call("first_impact", 0, taken, numbers.length, out, 14);
  const found = memory.numbers(out, 14);
  const [jx, jy, jz] = three(found, 9);
  /** @type {Vec} */
  const jf = [jx * m.mass, jy * m.mass, jz * m.mass];
  const used = jf[2] > 0 ? Math.hypot(jf[0], jf[1]) / jf[2] : 0;
  const answer = wallThenFloor(module, m, { v: three(found, 0), w: three(found, 3) });
  const landing = Number.isNaN(answer.requiredFloor) ? 0 : answer.requiredFloor;
  return {
    ...answer,
    required: found[12],
    requiredFloor: Math.max(landing, used >= layout.limits.least_firm / 2 ? Infinity : used),
    withFloor: true,
  };
}

/** What a published law of cushions drops: the vertical velocity. @param {Module} module @param {Meeting} m @param {Law} law @returns {Answer} */
function onTable(module, m, law) {
  const found = /** @type {Law} */ (module.layout.laws.find(({ name }) => name === law.on_table));
  // (one in flight is at some height: it has no table)
  const height = m.v[2] === 0 ? 0 : m.radius;
  const floor = m.floor && { e: 0, mu: m.floor.mu, beta: 0 };
  const [e, mu] = [m.given.e ? m.e : (law.defaults.restitution ?? m.e), m.given.mu ? m.mu : (law.defaults.friction ?? m.mu)];
  const full = answerOf(module, { ...m, e, mu, beta: 0, floor, height, together: true }, found);
  const [vx, vy, vz] = full.afterWall.v;
  const own = wallThenFloor(module, m, { v: [vx, vy, m.v[2] === 0 && m.n[2] <= ROUNDING ? 0 : vz], w: full.afterWall.w });
  const acts = full.withFloor ? (vz > 0 ? 0 : full.requiredFloor) : undefined;
  return { ...own, required: full.required, requiredFloor: acts ?? own.requiredFloor, vertical: vz };
}

/** What a law predicts, for a meeting that it has an answer for. @param {Module} module @param {Meeting} m @param {Law} law @returns {Answer} */
export function answerOf(module, m, law) {
  const { responses } = module.layout;
  if (law.on_table !== "") return onTable(module, m, law);
  if (law.order !== "") return twoStep(module, m, law.order === "scene" ? m.together : law.order === "with");
  const after = atWall(module, m, law);
  const alone = { afterWall: after, final: after, why: "", steps: null };
  if (law.response === responses.mirror) return { ...alone, required: 0, requiredFloor: 0 };
  if (law.response === responses.rolling) {
    const needed = judged(module, m, after).slips;
    return { ...alone, required: needed, requiredFloor: needed };
  }
  if (law.ignores_floor) return { ...alone, required: judged(module, m, after).required, requiredFloor: 0 };
  return wallThenFloor(module, m, after);
}
