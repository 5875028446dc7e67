// What walls are made of (carom.scene.feature_builders): faces, lines, points, rims, and gates above low walls.

/** @import { Vec } from "../state/types.js" */
import { length2 } from "./numbers.js";
import { UP, frame, unit } from "./vectors.js";

/** @typedef {[number, number]} Flat */

/** Kinds, as carom.core.geometry.features numbers them. */
export const KIND = { face: 0, over: 1, line: 2, point: 3, rim: 4 };

/**
 * @typedef {object} Feature
 * @property {number} kind
 * @property {Vec} p
 * @property {Vec} d
 * @property {number} R
 * @property {number} side
 * @property {Vec} u
 * @property {number} lo1
 * @property {number} hi1
 * @property {number} lo2
 * @property {number} hi2
 * @property {number} pocket number of the pocket whose edge it is, among those of its wall; -1 for none
 */

/** @param {number} kind @param {Vec} p @param {Partial<Feature>} [rest] @returns {Feature} */
export const feature = (kind, p, rest) => ({
  kind, p, d: UP, R: 0, side: 1, u: [1, 0, 0], lo1: -Infinity, hi1: Infinity, lo2: -Infinity, hi2: Infinity, pocket: -1, ...rest,
});

/** @param {Vec} p @param {Vec} normal */
export const plane = (p, normal) => feature(KIND.face, p, { d: normal, u: frame(normal)[0] });

/** @param {Vec} p @param {Vec} d @param {number} [low] @param {number} [high] @param {number} [R] @param {number} [side] */
export const line = (p, d, low = -Infinity, high = Infinity, R = 0, side = 1) =>
  feature(KIND.line, p, { d, R, side, u: frame(d)[0], lo1: -1, hi1: 1, lo2: low, hi2: high });

/** @param {Flat} at @param {number} low @param {number} high */
export const post = (at, low, high) => line([at[0], at[1], 0], UP, low, high);

/** @param {Vec} p */
export const corner = (p) => feature(KIND.point, p);

/** @param {Vec} p @param {Vec} normal @param {number} R */
export const disc = (p, normal, R) => feature(KIND.face, p, { d: normal, R, u: frame(normal)[0] });

/** @param {Vec} p @param {Vec} d @param {number} R @param {Vec} [u] @param {number} [cosine] */
export const rim = (p, d, R, u, cosine = -1) => feature(KIND.rim, p, { d, R, u: u ?? frame(d)[0], lo1: cosine });

/** A vertical face, or a gate, from start to end; balls are on its right. @param {number} kind @param {Flat} start @param {Flat} end @param {number} low @param {number} high */
function standing(kind, start, end, low, high) {
  const [tx, ty] = unit([end[0] - start[0], end[1] - start[1], 0]);
  const size = length2(start[0] - end[0], start[1] - end[1]);
  return feature(kind, [start[0], start[1], 0], { d: [ty, -tx, 0], u: [tx, ty, 0], lo1: 0, hi1: size, lo2: low, hi2: high });
}

/** The finite ones of two heights, from below. @param {number} low @param {number} high */
export function levels(low, high) {
  const finite = [low, high].filter(Number.isFinite).sort((a, b) => a - b);
  return finite.length === 2 && finite[0] === finite[1] ? [finite[0]] : finite;
}

/** One side of an outline that is gone round counterclockwise, with the balls inside. @param {Flat} start @param {Flat} end @param {number} low @param {number} high */
export function cushion(start, end, low, high) {
  const found = low < high ? [standing(KIND.face, end, start, low, high)] : [];
  const t = unit([end[0] - start[0], end[1] - start[1], 0]);
  const size = length2(start[0] - end[0], start[1] - end[1]);
  for (const z of [low, high].filter(Number.isFinite)) found.push(line([start[0], start[1], z], t, 0, size));
  if (Number.isFinite(high)) found.push(standing(KIND.over, end, start, high, Infinity));
  return found;
}

/** The same along an arc that is convex towards the balls. @param {Flat} center @param {number} R @param {Flat} middle @param {number} cosine @param {number} low @param {number} high */
export function roundCushion(center, R, middle, cosine, low, high) {
  /** @type {Vec} */
  const u = [middle[0], middle[1], 0];
  const side = (/** @type {number} */ kind, /** @type {number} */ lo2, /** @type {number} */ hi2) =>
    feature(kind, [center[0], center[1], 0], { R, u, lo1: cosine, hi1: 1, lo2, hi2 });
  const found = low < high ? [side(KIND.line, low, high)] : [];
  for (const z of [low, high].filter(Number.isFinite)) found.push(rim([center[0], center[1], z], UP, R, u, cosine));
  if (Number.isFinite(high)) found.push(side(KIND.over, high, Infinity));
  return found;
}

/** An upright wall without thickness along a polyline. @param {Flat[]} points @param {boolean} closed @param {number} low @param {number} high @param {boolean} [inside] */
export function upright(points, closed, low, high, inside = false) {
  const after = closed ? [...points.slice(1), points[0]] : points.slice(1);
  /** @type {[Flat, Flat][]} */
  const pairs = after.map((end, i) => [points[i], end]);
  const heights = levels(low, high);
  const found = [];
  for (const [start, end] of pairs) {
    if (low < high) {
      found.push(standing(KIND.face, end, start, low, high));
      if (!inside) found.push(standing(KIND.face, start, end, low, high));
    }
    const t = unit([end[0] - start[0], end[1] - start[1], 0]);
    const size = length2(start[0] - end[0], start[1] - end[1]);
    for (const z of heights) found.push(line([start[0], start[1], z], t, 0, size));
  }
  if (!inside) {
    for (const at of points) {
      if (low < high) found.push(post(at, low, high));
      for (const z of heights) found.push(corner([at[0], at[1], z]));
    }
  }
  if (Number.isFinite(high)) {
    for (const [start, end] of pairs) {
      found.push(standing(KIND.over, end, start, high, Infinity));
      if (!closed) found.push(standing(KIND.over, start, end, high, Infinity));
    }
  }
  return found;
}
