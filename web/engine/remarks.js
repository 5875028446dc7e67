// What happens to a ball, in sentences (carom.laws.comparison.remarks_on).

/** @import { Answer, Motion } from "./answers.js" */
/** @import { Meeting } from "./meeting.js" */
import { UP } from "../state/vectors.js";
import { slip, sum } from "./slip.js";
import { lengthText, numberText, timeText } from "./text.js";

/** @type {Record<string, string>} */
const ENDS = { stick: "sticking", slide: "sliding", graze: "by separation", jam: "jammed", stall: "unresolved" };

/** @param {Meeting} m @param {Answer} answer @param {Motion | null} final null if it never rolls @returns {string[]} */
export function remarksOn(m, answer, final) {
  const found = [...wallRemarks(m, answer), ...floorRemarks(m, answer)];
  return final === null ? [...found, `the ball never rolls again: ${answer.why}`] : [...found, ...wayRemarks(m, final)];
}

/** @param {Meeting} m @param {Answer} answer */
function wallRemarks(m, { impact }) {
  if (impact === null) return [];
  if (impact.floorImpulse.some((x) => x !== 0)) {
    return [`the wall presses the ball on the floor: both act at once, and the wall contact ends ${ENDS[impact.regime]}`];
  }
  if (impact.regime === "slide") {
    return [`the ball slides on the wall: its friction ${numberText(m.mu)} is below the ${numberText(impact.required)} required for sticking`];
  }
  return impact.regime === "graze" ? ["the ball only grazes the wall, without an impulse"] : [];
}

/** @param {Meeting} m @param {Answer} answer */
function floorRemarks(m, { steps }) {
  if (steps === null) return [];
  const found = [];
  if (Number.isFinite(steps.duration) && steps.duration > 0) {
    const bounces = steps.after.v[2] > 0 ? ", and bounces" : "";
    const [far, high] = [lengthText(steps.distance), lengthText(steps.height)];
    found.push(`the ball flies for ${timeText(steps.duration)}, ${far} far and up to ${high} high${bounces}`);
    if (steps.regime === "slide" && steps.why === 0) {
      const [mu, needed] = [numberText(m.floor?.mu ?? 0), numberText(steps.required)];
      found.push(`it lands sliding: the floor's friction ${mu} is below the ${needed} required for sticking`);
    }
  } else if (steps.duration === 0 && steps.why === 0) {
    const left = Math.max(...slip(m.radius, steps.after, UP).map(Math.abs));
    if (left > 1e-9 * sum(steps.after.v)) found.push("the ball stays on the floor and slides until it rolls");
  }
  return found;
}

/** @param {Meeting} m @param {Motion} final */
function wayRemarks(m, final) {
  const [v0, v, n] = [m.v, final.v, m.n];
  const size = sum(v0) + m.radius * sum(m.w);
  if (!(Math.abs(v[0]) + Math.abs(v[1]) > 1e-12 * size)) return ["the ball stops at the wall"];
  const found = [];
  if (n[0] * v[0] + n[1] * v[1] < -1e-9 * size) {
    found.push("its spin turns the ball round: it rolls back to the wall and meets it again");
  }
  const [along0, along] = [v0, v].map((u) => n[0] * u[1] - n[1] * u[0]);
  if (along0 * along < 0 && Math.abs(along) > 1e-12 * size) {
    found.push("the ball returns to the side of the normal from which it came");
  } else if (along0 === 0 && Math.abs(along) > 1e-12 * size) {
    found.push(`the ball leaves to the ${along > 0 ? "left" : "right"} of the wall's normal`);
  }
  return found;
}
