// Walls as seen from above, from what a ball can touch of them: upright faces are lines, round ones arcs, planes without end their
// traces on the floor.

/** @import { Wall } from "../state/types.js" */
/** @import { Feature } from "../scene/shapes.js" */
import { featuresOf } from "../scene/shapes.js";

/** @typedef {[number, number]} Flat */

/** `face`: of a straight one; `open`: it has no end, and is cut where nobody looks. @typedef {{points: Flat[], face: Feature | null, open: boolean}} Part */

const LEVEL = 1e-6;
const [FACE, LINE, POINT, RIM] = [0, 2, 3, 4];
// of a row of a smooth arc's table: the chord's beginning and direction, half its length, the coefficients (carom.core.geometry.curve)
const [BEGIN, ALONG, HALF, COEFFICIENTS] = [4, 6, 8, 17];

/** @param {Flat} center @param {number} radius @param {number} from @param {number} to degrees @returns {Flat[]} */
function arc(center, radius, from, to) {
  const steps = Math.max(8, Math.ceil(Math.abs(to - from) / 4));
  return Array.from({ length: steps + 1 }, (_, i) => {
    const a = ((from + ((to - from) * i) / steps) * Math.PI) / 180;
    return [center[0] + radius * Math.cos(a), center[1] + radius * Math.sin(a)];
  });
}

/** @param {Feature} f */
const endless = (f) => f.kind === FACE && f.R === 0 && [f.lo1, f.hi1, f.lo2, f.hi2].every((x) => !Number.isFinite(x));

/** The trace of a plane on the floor, as far as it bounds the space in front of the others. @param {Feature} f @param {Feature[]} others @param {Flat} at @param {number} reach @returns {Part[]} */
function trace({ p, d, ...rest }, others, at, reach) {
  const flat = Math.hypot(d[0], d[1]);
  if (flat < LEVEL) return [];
  const [nx, ny] = [d[0] / flat, d[1] / flat];
  // the point nearest to the middle of what is seen
  const shift = ((p[0] - at[0]) * d[0] + (p[1] - at[1]) * d[1] + p[2] * d[2]) / flat;
  const [x, y] = [at[0] + shift * nx, at[1] + shift * ny];
  let [from, to] = [-Infinity, Infinity];
  for (const { p: q, d: e } of others) {
    if (Math.hypot(e[0], e[1]) < LEVEL) continue;
    const gap = (x - q[0]) * e[0] + (y - q[1]) * e[1] - q[2] * e[2];
    const slope = -ny * e[0] + nx * e[1];
    if (slope > LEVEL) from = Math.max(from, -gap / slope);
    else if (slope < -LEVEL) to = Math.min(to, -gap / slope);
  }
  if (from >= to) return [];
  const ends = [Math.max(from, -reach), Math.min(to, reach)];
  return [{ points: ends.map((s) => [x - s * ny, y + s * nx]), face: { p, d, ...rest }, open: !Number.isFinite(from + to) }];
}

/** Points of a smooth arc in its frame at p along u. @param {Feature} f @returns {Flat[]} */
const smooth = ({ p, u, rows = [] }) => rows.slice(1, -1).flatMap((row) => [-1, -0.5, 0, 0.5, 1].map((w) => {
  const [xi, eta] = [row[HALF] * (1 + w), row.slice(COEFFICIENTS).reduceRight((sum, c) => sum * w + c, 0)];
  const [x, y] = [row[BEGIN] + row[ALONG] * xi - row[ALONG + 1] * eta, row[BEGIN + 1] + row[ALONG + 1] * xi + row[ALONG] * eta];
  return /** @type {Flat} */ ([p[0] + u[0] * x - u[1] * y, p[1] + u[1] * x + u[0] * y]);
}));

/** One feature from above; nothing where others show it. @param {Feature} f @param {Feature[]} all @param {Flat} at @param {number} reach @returns {Part[]} */
function partsOf(f, all, at, reach) {
  const { kind, p, d, R, u } = f;
  const [x, y] = p;
  if (f.rows) return [{ points: smooth(f), face: null, open: false }];
  if (kind === POINT && R > 0) return [{ points: arc([x, y], R, 0, 360), face: null, open: false }];
  if (kind === FACE && endless(f)) return trace(f, all.filter((one) => one !== f && endless(one)), at, reach);
  if (kind === FACE && R === 0) {
    if (Math.abs(d[2]) > 1 - LEVEL) return [];
    // along u, or where that rises along d x u
    const along = Math.abs(u[2]) < 0.5 ? u : [d[1] * u[2] - d[2] * u[1], d[2] * u[0] - d[0] * u[2]];
    const ends = Math.abs(u[2]) < 0.5 ? [f.lo1, f.hi1] : [f.lo2, f.hi2];
    const points = ends.map((s) => (Number.isFinite(s) ? s : Math.sign(s) * 2 * reach)).map((s) => /** @type {Flat} */ ([x + s * along[0], y + s * along[1]]));
    return [{ points, face: f, open: !ends.every(Number.isFinite) }];
  }
  const upright = Math.abs(d[2]) > 1 - LEVEL;
  if (R > 0 && (kind === LINE || (kind === RIM && !all.some((one) => one.kind === LINE && one.R > 0)))) {
    const [middle, half] = upright && f.lo1 > -1 ? [(Math.atan2(u[1], u[0]) * 180) / Math.PI, (Math.acos(f.lo1) * 180) / Math.PI] : [180, 180];
    return [{ points: arc([x, y], R, middle - half, middle + half), face: null, open: !upright && !Number.isFinite(f.hi2) }];
  }
  if (kind === LINE && R === 0 && Math.abs(d[2]) < LEVEL && Number.isFinite(f.hi2) && !all.some((one) => one.kind === FACE)) {
    return [{ points: [f.lo2, f.hi2].map((s) => [x + s * d[0], y + s * d[1]]), face: null, open: false }]; // (a wall of no height)
  }
  return [];
}

/** @param {Flat} p @param {Flat} q @param {number} near */
const same = (p, q, near) => Math.abs(p[0] - q[0]) <= near && Math.abs(p[1] - q[1]) <= near;

/** Chains of parts that meet end to end. @param {Part[]} parts @param {number} near @returns {Part[][]} */
function chained(parts, near) {
  const left = [...parts];
  /** @type {Part[][]} */
  const chains = [];
  for (let first = left.shift(); first !== undefined; first = left.shift()) {
    const chain = [first];
    for (let found = true; found; ) {
      const [start, end] = [chain[0].points[0], /** @type {Flat} */ (chain[chain.length - 1].points.at(-1))];
      found = false;
      for (const [i, part] of left.entries()) {
        const [a, b] = [part.points[0], /** @type {Flat} */ (part.points.at(-1))];
        const turned = { ...part, points: [...part.points].reverse() };
        if (same(a, end, near)) chain.push(part);
        else if (same(b, end, near)) chain.push(turned);
        else if (same(b, start, near)) chain.unshift(part);
        else if (same(a, start, near)) chain.unshift(turned);
        else continue;
        left.splice(i, 1);
        found = true;
        break;
      }
    }
    chains.push(chain);
  }
  return chains;
}

/** The outline of a wall, in chains of parts; what has no end is cut at a distance from a point. @param {Wall} wall @param {Flat} at @param {number} reach @returns {Part[][]} */
export function chainsOf(wall, at, reach) {
  const all = featuresOf(wall);
  const parts = all.flatMap((f) => partsOf(f, all, at, reach));
  const size = Math.max(...parts.filter(({ open }) => !open).flatMap(({ points: [p, q] }) => [Math.abs(q[0] - p[0]), Math.abs(q[1] - p[1])]), 1e-30);
  const near = 1e-6 * size;
  // (a thin wall has two faces, one on either side)
  const once = parts.filter(({ points }, i) => {
    const [a, b, m] = [points[0], /** @type {Flat} */ (points.at(-1)), points[points.length >> 1]];
    return !parts.slice(0, i).some(({ points: other }) => {
      const [c, e] = [other[0], /** @type {Flat} */ (other.at(-1))];
      return other.length === points.length && ((same(a, c, near) && same(b, e, near) && same(m, other[points.length >> 1], near)) || (points.length === 2 && same(a, e, near) && same(b, c, near)));
    });
  });
  return chained(once, near);
}

/** The points of a chain, one after the other. @param {Part[]} chain @returns {Flat[]} */
export const lineOf = (chain) => chain.flatMap(({ points }, i) => (i === 0 ? points : points.slice(1)));
