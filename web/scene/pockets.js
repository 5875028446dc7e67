// A table's pockets: noses, jaws, edges. As carom.scene.table and pockets have them, with the same bits.

/** @import { Vec, Wall } from "../state/types.js" */
/** @import { Feature, Flat } from "./builders.js" */
import { KIND, cushion, feature, roundCushion } from "./builders.js";
import { direction, extended } from "./numbers.js";

/** @typedef {{mouth: number, jaw_angle: number, jaw_radius: number, shelf: number, radius: number}} Pockets */
/** @typedef {{name: string, center: Flat, radius: number}} Pocket */
/** @typedef {{nose: Flat, center: Flat, radius: number, middle: Flat, cosine: number, facing: Flat, start: Flat, end: Flat, reaches: boolean, forward: boolean}} Jaw */
/** @typedef {{pocket: Pocket, before: Jaw, after: Jaw, shape: Pockets}} Mouth */
/** @typedef {{noses: [Flat, Flat, Flat][], mouths: Mouth[]}} Layout start, end and direction of each nose */

/** @type {Flat[]} */
const TURNS = [[1, 0], [0, 1], [-1, 0], [0, -1]];
const CORNERS = ["bottom left pocket", "bottom right pocket", "top right pocket", "top left pocket"];
const SIDES = ["bottom middle pocket", "right middle pocket", "top middle pocket", "left middle pocket"];

/** The corners of a table, counterclockwise. @param {Wall} wall @returns {Flat[]} */
export function tableCorners(wall) {
  const [[x, y], dx, dy] = [wall.center, wall.length / 2, wall.width / 2];
  return [[x - dx, y - dy], [x + dx, y - dy], [x + dx, y + dy], [x - dx, y + dy]];
}

/** The jaw of a tip; the unit vector `along` leads along the nose to the pocket, which is at `at`. @param {Flat} tip @param {Flat} along @param {boolean} forward @param {Pockets} shape @param {Flat} at @returns {Jaw} */
function jawAt(tip, along, forward, shape, at) {
  const [[tx, ty], r] = [along, shape.jaw_radius];
  const [ox, oy] = forward ? [ty, -tx] : [-ty, tx];
  const [c, s] = direction(180 - shape.jaw_angle);
  const [c2, s2] = direction((180 - shape.jaw_angle) / 2);
  const d = (r * s) / (1 + c);
  const [fx, fy] = [c * tx + s * ox, c * ty + s * oy];
  /** @type {Flat} */
  const nose = [tip[0] - d * tx, tip[1] - d * ty];
  const [wx, wy] = [at[0] - tip[0], at[1] - tip[1]];
  const on = wx * fx + wy * fy;
  const off2 = wx * wx + wy * wy - on * on;
  const reaches = off2 < shape.radius * shape.radius;
  const end = Math.max(reaches ? on - Math.sqrt(shape.radius * shape.radius - off2) : d, d);
  return {
    nose, center: [nose[0] + r * ox, nose[1] + r * oy], radius: r, middle: [s2 * tx - c2 * ox, s2 * ty - c2 * oy], cosine: c2, facing: [fx, fy],
    start: [tip[0] + d * fx, tip[1] + d * fy], end: [tip[0] + end * fx, tip[1] + end * fy], reaches, forward,
  };
}

/** Noses, pockets and jaws, counterclockwise from the bottom left corner; nothing for a table without pockets. @param {Wall} wall @returns {Layout} */
export function layoutOf(wall) {
  /** @type {Pockets | null} */
  const corner = wall.corner_pockets ?? null;
  /** @type {Pockets | null} */
  const side = wall.side_pockets ?? null;
  if (!corner && !side) return { noses: [], mouths: [] };
  const corners = tableCorners(wall);
  const long = wall.length >= wall.width ? 0 : 1;
  const half = Math.sqrt(0.5);
  /** @type {Mouth[]} */
  const mouths = [];
  /** @type {Flat[]} */
  const ends = [];
  /** @type {Flat[]} */
  const turns = [];
  corners.forEach(([x, y], k) => {
    const [[tx, ty], [sx, sy]] = [TURNS[k], TURNS[(k + 3) % 4]];
    /** @type {[Flat, Flat]} */
    let around = [[x, y], [x, y]];
    if (corner) {
      const [gx, gy, far] = [half * (sx - tx), half * (sy - ty), corner.shelf + corner.radius - corner.mouth / 2];
      /** @type {Flat} */
      const at = [x + far * gx, y + far * gy];
      const m = half * corner.mouth;
      const before = jawAt([x - m * sx, y - m * sy], [sx, sy], true, corner, at);
      const after = jawAt([x + m * tx, y + m * ty], [-tx, -ty], false, corner, at);
      mouths.push({ pocket: { name: CORNERS[k], center: at, radius: corner.radius }, before, after, shape: corner });
      around = [before.nose, after.nose];
    }
    ends.push(...around);
    turns.push([tx, ty]);
    if (side && k % 2 === long) {
      const [ux, uy] = corners[(k + 1) % 4];
      const [mx, my, m, far] = [(x + ux) / 2, (y + uy) / 2, side.mouth / 2, side.shelf + side.radius];
      /** @type {Flat} */
      const at = [mx + far * ty, my - far * tx];
      const before = jawAt([mx - m * tx, my - m * ty], [tx, ty], true, side, at);
      const after = jawAt([mx + m * tx, my + m * ty], [-tx, -ty], false, side, at);
      mouths.push({ pocket: { name: SIDES[k], center: at, radius: side.radius }, before, after, shape: side });
      ends.push(before.nose, after.nose);
      turns.push([tx, ty]);
    }
  });
  const noses = turns.map((t, i) => /** @type {[Flat, Flat, Flat]} */ ([ends[2 * i + 1], ends[(2 * i + 2) % ends.length], t]));
  return { noses, mouths };
}

/** Where a facing begins and ends, counterclockwise; null where the arc reaches the pocket. @param {Jaw} jaw @returns {[Flat, Flat] | null} */
export function facingOf({ start, end, forward }) {
  if (start[0] === end[0] && start[1] === end[1]) return null;
  return forward ? [start, end] : [end, start];
}

/** @param {Jaw} jaw @param {number} low @param {number} high */
function jawFeatures(jaw, low, high) {
  const facing = facingOf(jaw);
  return [...roundCushion(jaw.center, jaw.radius, jaw.middle, jaw.cosine, low, high), ...(facing ? cushion(...facing, low, high) : [])];
}

/** The features of a table with pockets. @param {Wall} wall @param {Layout} layout @returns {Feature[]} */
export function pocketTableFeatures(wall, { noses, mouths }) {
  const [low, high] = [wall.nose_height ?? -Infinity, extended(wall.height)];
  return [
    ...noses.flatMap(([start, end]) => cushion(start, end, low, high)),
    ...mouths.flatMap(({ before, after }) => [before, after].flatMap((jaw) => jawFeatures(jaw, low, high))),
    ...mouths.flatMap(({ pocket }, number) => {
      const edge = feature(KIND.over, [pocket.center[0], pocket.center[1], 0], { R: pocket.radius, lo1: -1, hi1: 1, hi2: high, pocket: number });
      return Number.isFinite(high) ? [edge, { ...edge, lo2: high, hi2: Infinity, pocket: -1 }] : [edge];
    }),
  ];
}

/** Whether a point behind the line of the nose is not in the rubber of a jaw. @param {Vec} x @param {Jaw} jaw */
function isFree(x, jaw) {
  const [fx, fy] = jaw.facing;
  const [nx, ny] = jaw.forward ? [-fy, fx] : [fy, -fx];
  if (nx * (x[0] - jaw.start[0]) + ny * (x[1] - jaw.start[1]) >= 0) return true;
  const [rx, ry] = [x[0] - jaw.center[0], x[1] - jaw.center[1]];
  const far = Math.sqrt(rx * rx + ry * ry);
  return far >= jaw.radius && rx * jaw.middle[0] + ry * jaw.middle[1] >= jaw.cosine * far;
}

/** Whether a point is beyond a cushion, or over a pocket. @param {Wall} wall @param {Vec} x */
export function tableBlocked(wall, x) {
  const out = Math.abs(x[0] - wall.center[0]) > wall.length / 2 || Math.abs(x[1] - wall.center[1]) > wall.width / 2;
  const apart = (/** @type {Flat} */ p, /** @type {Flat} */ q) => Math.hypot(p[0] - q[0], p[1] - q[1]);
  for (const { pocket, before, after } of layoutOf(wall).mouths) {
    const far = apart([x[0], x[1]], pocket.center);
    if (far < pocket.radius) return true;
    const [mx, my] = [(before.start[0] + after.start[0]) / 2, (before.start[1] + after.start[1]) / 2];
    const [gx, gy] = [pocket.center[0] - mx, pocket.center[1] - my];
    const front = (x[0] - mx) * gx + (x[1] - my) * gy < gx * gx + gy * gy;
    if (out && front && far < 2 * pocket.radius + apart(before.nose, after.nose) && isFree(x, before) && isFree(x, after)) return false;
  }
  return out;
}

/** What is wrong with a table's pockets. @param {Wall} wall @returns {string[]} */
export function pocketFaults(wall) {
  const { noses, mouths } = layoutOf(wall);
  const short = noses.some(([p, q, t]) => (q[0] - p[0]) * t[0] + (q[1] - p[1]) * t[1] <= 0);
  if (short) return ["expected a cushion between two pockets; make mouth or jaw_radius smaller"];
  const found = [];
  if (mouths.some(({ shape }) => Math.abs(shape.shelf) > shape.mouth)) found.push("expected a shelf of at most the mouth; the pocket would lie outside the table");
  if (mouths.some(({ before, after }) => !before.reaches || !after.reaches)) found.push("expected a pocket wide enough for the jaws to end over its edge");
  const overlap = mouths.some(({ pocket: p }, i) => mouths.slice(i + 1).some(({ pocket: q }) => Math.hypot(p.center[0] - q.center[0], p.center[1] - q.center[1]) < p.radius + q.radius));
  if (overlap) found.push("expected pockets that lie apart; make radius smaller, or the table larger");
  return found;
}
