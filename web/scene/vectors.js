// Vectors of three numbers, as carom.core.jit.kernel and carom.scene.feature_builders have them: the same operations in the same
// order, and so the same bits.

/** @import { Vec } from "../state/types.js" */
import { exactSum, twoProd, ulp } from "./numbers.js";

/** @type {Vec} */
export const UP = [0, 0, 1];
const FEW_DIGITS = 8;
const NEAR = 4e-15;
const COARSE = 0.01;
const MOST_KEPT = 4096;

/** @param {Vec} p @param {Vec} q */
export const dot = (p, q) => p[0] * q[0] + p[1] * q[1] + p[2] * q[2];

/** @param {Vec} p @param {Vec} q @returns {Vec} */
export const cross = (p, q) => [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];

/** @param {Vec} p @param {Vec} q @returns {Vec} */
export const minus = (p, q) => [p[0] - q[0], p[1] - q[1], p[2] - q[2]];

/** The part of p across the unit vector d. @param {Vec} p @param {Vec} d @returns {Vec} */
export function across(p, d) {
  const c = dot(p, d);
  return [p[0] - c * d[0], p[1] - c * d[1], p[2] - c * d[2]];
}

/** @param {Vec} v @returns {Vec} */
function scaled(v) {
  const most = Math.max(Math.abs(v[0]), Math.abs(v[1]), Math.abs(v[2]));
  const [x, y, z] = [v[0] / most, v[1] / most, v[2] / most];
  const size = Math.sqrt(x * x + y * y + z * z);
  return [x / size, y / size, z / size];
}

/** |n|^2 - 1, without rounding. @param {Vec} n */
const tooLong = (n) => exactSum([-1, ...n.flatMap((c) => twoProd(c, c))]);

/** @type {Map<string, Vec>} the search takes a while, and a scene asks for the same few normals again and again */
const kept = new Map();

/** A vector along v whose length is nearest to 1 (carom.scene.feature_builders.unit). @param {Vec} v @returns {Vec} */
export function unit(v) {
  const key = `${v[0]} ${v[1]} ${v[2]} ${Object.is(v[0], -0)}${Object.is(v[1], -0)}${Object.is(v[2], -0)}`;
  let found = kept.get(key);
  if (found === undefined) {
    if (kept.size >= MOST_KEPT) kept.clear();
    found = nearest(v);
    kept.set(key, found);
  }
  return found;
}

/** @param {Vec} v @returns {Vec} */
function nearest(v) {
  const n = scaled(v);
  let best = n;
  let error = Math.abs(tooLong(n));
  if (error === 0) return n;
  let k = -1; // the finer its last digit, the better
  for (let i = 0; i < 3; i++) if (Math.abs(n[i]) > COARSE && (k < 0 || Math.abs(n[i]) < Math.abs(n[k]))) k = i;
  for (let i = 0; i < 3; i++) {
    if (i === k || n[i] === 0) continue;
    const step = ulp(n[i]);
    for (let digits = -FEW_DIGITS; digits <= FEW_DIGITS; digits++) {
      /** @type {Vec} */
      const tried = [...n];
      tried[i] += digits * step;
      tried[k] -= tooLong(tried) / (2 * n[k]);
      const size = Math.abs(tooLong(tried));
      if (Math.abs(tried[k] - n[k]) <= NEAR && size < error) {
        best = tried;
        error = size;
      }
    }
  }
  return best;
}

/** Two unit vectors that make a right-handed frame with the unit axis. @param {Vec} axis @returns {[Vec, Vec]} */
export function frame(axis) {
  const u = scaled(across(Math.abs(axis[0]) > 1 - 1e-9 ? [0, 1, 0] : [1, 0, 0], axis));
  return [u, cross(axis, u)];
}
