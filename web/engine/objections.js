// When a law has no answer, and why an answer may not apply: the sentences of carom's laws (conditions and objections of each file in
// carom.laws), which a test compares.

/** @import { Law, Layout } from "./types.js" */
/** @import { Answer } from "./answers.js" */
/** @import { Meeting } from "./meeting.js" */
import { dot } from "../scene/vectors.js";
import { kineticEnergy, slip, slips, slipsOnFloor, sum } from "./slip.js";
import { general } from "./text.js";

const SLOWEST = 1e-100; // a motion slower than this has a square of 0

/** @typedef {(m: Meeting, layout: Layout, law: Law) => string[]} Conditions what is expected and not met */
/** @typedef {(m: Meeting, answer: Answer) => string[]} Objections */

/** @type {Conditions} */
function approaches({ v, w, n }) {
  const found = dot(v, n) <= 1e-12 * sum(v) ? [] : ["a ball that moves towards the wall"];
  const largest = Math.max(...[...v, ...w].map(Math.abs));
  if (largest !== 0 && largest < SLOWEST) found.push("a ball at rest, or a component of velocity or spin of at least 1e-100");
  return found;
}

/** @type {Conditions} */
function rolls(m) {
  const found = [];
  const grounded = m.floor !== null && m.v[2] === 0 && m.height === 0;
  if (!grounded || slipsOnFloor(m, m)) found.push("hypothesis 1: a ball that rolls on the floor without sliding");
  if (!(Math.abs(m.n[2]) < 1e-12)) found.push("hypothesis 1: a vertical wall (any other lifts the ball or presses it down)");
  if (m.e !== 1) found.push("hypothesis 3: a wall of restitution 1 (with less, energy would have to be created)");
  return found;
}

/** @type {Conditions} */
function notPressed(m) {
  if (m.floor === null || !m.together || m.beta === 0 || m.beta === -1) return [];
  const u = slip(m.radius, m, m.n);
  const down = m.n[2] < 0 || (u[2] > 0 && Math.min(m.mu, 1e300) * u[2] > m.n[2] * Math.sqrt(dot(u, u)));
  const pressed = m.height === 0 && m.v[2] <= 0 && (down || m.v[2] < 0);
  return pressed ? ["tangential restitution 0 where the wall presses the ball on the floor"] : [];
}

/** @type {Conditions} */
function tabulated(m, _layout, law) {
  const [low, high] = law.chi_range ?? [0, Infinity];
  const share = (1 + 1 / m.kappa) / 2;
  const chi = m.stiffness * share;
  if (low <= chi && chi <= high) return [];
  return [`a stiffness ratio from ${general(low / share, 3)} to ${general(high / share, 3)}, for which the law is tabulated`];
}

/** @type {Conditions} */
function resolved(m, { limits }) {
  const [low, high] = limits.stiffness;
  const found = [];
  if (!(low <= m.stiffness && m.stiffness <= high)) found.push(`a stiffness ratio from ${general(low, 6)} to ${general(high, 6)}`);
  if (!(Math.sqrt(m.stiffness * (1 + 1 / m.kappa)) <= limits.most_omega)) {
    found.push(`a stiffness ratio k and an inertia kappa with k (1 + 1/kappa) at most ${general(limits.most_omega ** 2, 6)}`);
  }
  return found;
}

/** @type {Record<string, Conditions>} beyond that the ball approaches */
const CONDITIONS = { conventional: rolls, "two-step": notPressed, maw: tabulated, stronge: resolved, "stronge-cushion": resolved };

/** What a law expects and this meeting does not have. @param {Meeting} m @param {Law} law @param {Layout} layout */
export const unmet = (m, law, layout) => [...approaches(m, layout, law), ...(CONDITIONS[law.name]?.(m, layout, law) ?? [])];

/** @param {{mu: number, beta: number} | null} surface */
const rubs = (surface) => surface !== null && surface.mu > 0 && surface.beta > -1;

/** @type {Objections} */
function drivesIntoFloor(m, { afterWall }) {
  const down = m.floor !== null && m.height === 0 && afterWall.v[2] < -1e-9 * sum(m.v);
  return down ? ["it drives the ball into the floor and ignores the simultaneous reaction of the floor"] : [];
}

/** @type {Objections} */
function impossible(m, { afterWall }) {
  const found = [];
  const [before, after] = [kineticEnergy(m, m), kineticEnergy(m, afterWall)];
  if (after > before * (1 + 1e-9)) found.push(`it creates energy: ${general((100 * after) / before, 4)} % is left after the wall`);
  if (dot(afterWall.v, m.n) < -1e-9 * sum(m.v)) found.push("it sends the ball through the wall");
  return found;
}

/** @type {Objections} */
function frictionless(m, answer) {
  const found = drivesIntoFloor(m, answer);
  if (rubs(m) && slips(m, m, m.n)) {
    found.push("the ball slips on the wall, and this wall has friction: the tangential impulse is ignored");
  }
  if (rubs(m.floor) && slipsOnFloor(m, answer.afterWall)) {
    found.push("the ball leaves the wall sliding on a floor with friction, which bends its path");
  }
  return found;
}

/** @type {Objections} */
const againstFriction = (_m, answer) =>
  answer.requiredFloor > 0
    ? [
        "it reverses the slip at the wall, whereas friction can only stop it: the wall would have to pull the ball down" +
          " and the floor would need a friction above 1, whatever the impulses",
      ]
    : [];

/** @type {Objections} */
function noSlip(m, answer) {
  const found = m.e !== 1 ? [`it assumes restitution 1; this wall has ${general(m.e, 6)}`] : [];
  if (slips(m, m, m.n)) {
    if (m.beta < 1) found.push(`it assumes tangential restitution 1, which reverses the slip; this wall has ${general(m.beta, 6)}`);
    if (answer.required > m.mu) {
      found.push(`it requires a wall friction of ${general(answer.required, 3)}; this wall has ${general(m.mu, 6)}`);
    }
  }
  return [...impossible(m, answer), ...found, ...drivesIntoFloor(m, answer)];
}

/** @type {Objections} */
function compliant(m, answer) {
  const found = [...impossible(m, answer), ...drivesIntoFloor(m, answer)];
  if (m.beta !== 0) found.push("it models the tangential rebound by springs and ignores this wall's tangential restitution");
  return found;
}

/** @type {Objections} */
function ignoresFloor(m, { afterWall }) {
  const grounded = m.floor !== null && m.height === 0 && m.v[2] === 0;
  const moved = afterWall.v[2] !== 0 || slipsOnFloor(m, afterWall);
  return grounded && moved ? ["it ignores the floor on which this ball rests"] : [];
}

/** @type {Objections} */
function onTable(m, answer) {
  const found = impossible(m, answer);
  if (m.v[2] !== 0 || m.height > 0) return [...found, "it describes a ball on the table; one in flight meets the cushion as if there were no table"];
  if (m.n[2] > 1e-12) return [...found, "it describes a cushion, which touches the ball at or above its centre"];
  const rise = answer.vertical ?? 0;
  if (!(Math.abs(rise) > 1e-9 * sum(m.v))) return found;
  const share = (100 * ((m.mass * rise * rise) / 2)) / kineticEnergy(m, m);
  const way = rise > 0 ? "throws it up" : "drives it into the table";
  return [...found, `it keeps the ball on the table, though the cushion ${way}: ${general(share, 3)} % of the energy is dropped`];
}

/** @type {Record<string, Objections>} */
const OBJECTIONS = {
  mirror: frictionless, conventional: againstFriction, "no-slip": noSlip, maw: compliant, stronge: compliant, contact: ignoresFloor,
  han2005: onTable, mathavan2010: onTable, "stronge-cushion": onTable,
};

/** Why a law's answer may not apply. @param {Meeting} m @param {Law} law @param {Answer} answer */
export const objections = (m, law, answer) => OBJECTIONS[law.name]?.(m, answer) ?? [];

