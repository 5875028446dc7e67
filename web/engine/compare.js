// What each law says of the first ball at the first wall, and which laws are admissible (carom.laws.comparison).

/** @import { Vec } from "../state/types.js" */
/** @import { Answer, Motion } from "./answers.js" */
/** @import { Law, Verdict } from "./types.js" */
/** @import { Meeting } from "./meeting.js" */
/** @import { Module } from "./module.js" */
import { answerOf, judged } from "./answers.js";
import { objections, unmet } from "./objections.js";

/** @param {number} x */
const known = (x) => (Number.isNaN(x) ? null : x);

/** @param {Motion} motion */
const isMotion = (motion) => !motion.v.some(Number.isNaN);

/** @param {Module} module @param {Meeting} m @param {Law} law @returns {{answer: Answer | null, why: string}} */
function answered(module, m, law) {
  const missing = unmet(module, m, law);
  if (missing.length > 0) return { answer: null, why: `no prediction: it requires ${missing.join("; and ")}` };
  const answer = answerOf(module, m, law);
  return isMotion(answer.afterWall) ? { answer, why: "" } : { answer: null, why: `no prediction: ${answer.why}` };
}

/** @param {Module} module @param {Meeting} m @param {Law} law @returns {Verdict} */
function verdict(module, m, law) {
  const { answer, why } = answered(module, m, law);
  const nothing = {
    law: law.name, angle: null, angle_after_wall: null, velocity: null, spin: null, after_wall: null, energy_kept: null, hop: null,
    flight: null, required: null, available: m.mu, required_floor: null, available_floor: m.floor?.mu ?? null,
  };
  if (answer === null) return { ...nothing, admissible: false, reasons: [why] };
  const reasons = objections(module, m, law, answer);
  const final = isMotion(answer.final) ? answer.final : null;
  const { afterWall, steps } = answer;
  const said = judged(module, m, afterWall, answer.final);
  return {
    ...nothing,
    angle: final && known(said.angle),
    angle_after_wall: known(said.afterWall),
    velocity: final && final.v,
    spin: final && final.w,
    after_wall: { velocity: afterWall.v, spin: afterWall.w },
    energy_kept: final && known(said.kept),
    hop: steps && known(steps.height),
    flight: steps && known(steps.distance),
    required: known(answer.required),
    required_floor: known(answer.requiredFloor),
    admissible: reasons.length === 0,
    reasons,
  };
}

/** All laws of one meeting, but special cases of others, and published laws of cushions elsewhere than at a nose if they are not named. @param {Module} module @param {Meeting} m @param {string[]} also */
export function verdicts(module, m, also) {
  const aloft = m.height > 0;
  const cushion = !aloft && m.n[2] < 0;
  const laws = module.layout.laws.filter(
    (law) => law.variant_of === "" && (aloft || !law.ignores_floor) && (cushion || law.on_table === "" || also.includes(law.name)),
  );
  return laws.map((law) => {
    module.memory.clear();
    return verdict(module, m, law);
  });
}

/** The angle of incidence, degrees. @param {Module} module @param {Meeting} m */
export function incidenceAt(module, m) {
  module.memory.clear();
  return judged(module, m, m).incidence;
}

/** A meeting at another angle of incidence: velocity and spin turned about the vertical. @param {Meeting} m @param {number} degrees @returns {Meeting} */
export function atIncidence(m, degrees) {
  const { v, w, n } = m;
  const before = Math.atan2(n[0] * v[1] - n[1] * v[0], -(n[0] * v[0] + n[1] * v[1]));
  const way = before < 0 ? -1 : 1;
  const by = -((way * degrees * Math.PI) / 180 - before);
  const [c, s] = [Math.cos(by), Math.sin(by)];
  /** @param {Vec} p @returns {Vec} */
  const turned = ([x, y, z]) => [c * x - s * y, s * x + c * y, z];
  return { ...m, v: turned(v), w: turned(w) };
}

/** The angle, degrees, at which a ball leaves for each angle of incidence; null where the law has no answer. @param {Module} module @param {Law} law @param {Meeting} meeting @param {number[]} incidences degrees @param {"final" | "wall"} stage once it rolls, or just after the wall @returns {(number | null)[]} */
export function reflections(module, law, meeting, incidences, stage) {
  return incidences.map((degrees) => {
    module.memory.clear();
    const m = atIncidence(meeting, degrees);
    const { answer } = answered(module, m, law);
    const motion = answer && (stage === "wall" ? answer.afterWall : answer.final);
    return motion && isMotion(motion) ? known(judged(module, m, motion).angle) : null;
  });
}
