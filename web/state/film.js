// A film beside a run: where it saw a ball at a time, and how far from there the run has it.

/** @import { Film, Piece } from "./types.js" */
import { stateAt } from "./motion.js";

const STILL = 0.003; // m between two rows of a ball that lies still, however much later the second one is
const GAP = 0.15; // s between two rows, over which a moving ball is not followed

/** Where a film saw a ball, m, between two of its rows; null where it did not. @param {Film[number]} rows @param {number} t s @returns {[number, number] | null} */
export function placeAt(rows, t) {
  const before = rows.findLast(([at]) => at <= t) ?? rows[0];
  const after = rows.find(([at]) => at >= t) ?? rows[rows.length - 1];
  if (!before || t < before[0] - GAP || t > after[0] + GAP) return null;
  const [lasts, dx, dy] = after.map((value, k) => value - before[k]);
  if (lasts > GAP && Math.hypot(dx, dy) > STILL) return null;
  const share = lasts > 0 ? (t - before[0]) / lasts : 0;
  return [before[1] + share * dx, before[2] + share * dy];
}

/** From a film to a run, seen from above, m; null where the film did not see the ball. @param {Film[number]} rows @param {Piece[]} pieces @param {number} t */
export function apartAt(rows, pieces, t) {
  const place = placeAt(rows, t);
  const { x } = stateAt(pieces, t);
  return place && Math.hypot(x[0] - place[0], x[1] - place[1]);
}

/** The same at each row, mm, as a curve that breaks where the film does. @param {Film[number]} rows @param {Piece[]} pieces @param {{from: number, until: number}} span @returns {[number, number][]} */
export function apartCurve(rows, pieces, { from, until }) {
  const shown = rows.filter(([t]) => t >= from && t <= until);
  return shown.flatMap(([t], i) => {
    /** @type {[number, number][]} */
    const found = [[t, 1e3 * (apartAt(rows, pieces, t) ?? NaN)]];
    return i > 0 && placeAt(rows, (shown[i - 1][0] + t) / 2) === null ? [[NaN, NaN], ...found] : found;
  });
}
