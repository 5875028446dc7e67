// The slip of a ball's contact point, and what follows from it (carom.laws.law, carom.bodies).

/** @import { Vec } from "../state/types.js" */
/** @import { Motion } from "./answers.js" */
/** @import { Meeting } from "./meeting.js" */
import { cross, dot } from "../state/vectors.js";

/** @param {Vec} v */
export const sum = (v) => Math.abs(v[0]) + Math.abs(v[1]) + Math.abs(v[2]);

/** Velocity of the contact point along a surface. @param {number} radius @param {Motion} motion @param {Vec} n @returns {Vec} */
export function slip(radius, { v, w }, n) {
  const [un, s] = [dot(v, n), cross(w, n)];
  return [v[0] - un * n[0] - radius * s[0], v[1] - un * n[1] - radius * s[1], v[2] - un * n[2] - radius * s[2]];
}

/** Whether it slips by more than rounding. @param {{radius: number}} m @param {Motion} motion @param {Vec} n */
export const slips = (m, motion, n) =>
  Math.max(...slip(m.radius, motion, n).map(Math.abs)) > 1e-9 * (sum(motion.v) + m.radius * sum(motion.w));

/** J. @param {Meeting} m @param {Motion} motion */
export const kineticEnergy = (m, { v, w }) =>
  (m.mass * dot(v, v)) / 2 + (m.kappa * m.mass * m.radius ** 2 * dot(w, w)) / 2;
