// What both views (3-D, and 2-D where there is no WebGL 2) draw, and how large it is.

/** @import { Film, Run, Scene, Vec, Wall } from "../state/types.js" */
import { toNumber } from "../state/edit.js";
import { trail } from "../state/motion.js";
import { chainsOf, lineOf } from "./outline.js";

/**
 * @typedef {object} Shot
 * @property {Scene} scene
 * @property {number} ball the ball that is edited: each law has a ghost of it
 * @property {string} followed the law whose balls are all drawn
 * @property {Map<string, Run>} runs by law, those shown
 * @property {Map<string, string>} colours of the laws, for the theme
 * @property {{from: number, until: number}} span s: where trails begin and end
 * @property {Box} box
 * @property {Film} film
 */

/** @typedef {{low: Vec, high: Vec}} Box */

/** @typedef {{background: string, floor: string, grid: string, wall: string, edge: string, ink: string, soft: string, dark: boolean}} Palette */

/**
 * @typedef {object} View
 * @property {(shot: Shot, palette: Palette) => void} update
 * @property {(span: {from: number, until: number}) => void} trace draw paths between other times
 * @property {(t: number) => void} draw
 * @property {(name: string) => void} look one of VIEWS
 * @property {() => void} resize
 * @property {() => Promise<Blob>} picture
 */

/** @typedef {{start: () => void, ball: (x: number, y: number) => void, velocity: (x: number, y: number) => void, end: () => void}} Drag */

export const VIEWS = [
  { name: "free", label: "3-D" },
  { name: "above", label: "Above" },
  { name: "side", label: "Side" },
  { name: "along", label: "Along the wall" },
];

/** What is further away than this, relative to a metre or to where the balls start, is not looked at. */
const FAR = 1e4;
/** How far that is, m. @param {Scene} scene */
const farIn = (scene) => FAR * Math.max(1, ...scene.balls.flatMap(({ position, radius }) => [...position.map(Math.abs), radius]));
/** Width of a cushion, in radii of the largest ball. */
export const RAIL = 2.2;

/** The dots of a film that do not cover each other, m. @param {Film[number]} rows @param {Box} box */
export function dotsOf(rows, box) {
  const least = sizeOf(box) / 150;
  let [x, y] = [Infinity, Infinity];
  return rows.filter((row) => Math.hypot(row[1] - x, row[2] - y) > least && ([, x, y] = row));
}

/** How far the arrow of a velocity reaches: s, so that it is length over speed. @param {Shot} shot */
export const arrowTime = (shot) => (0.16 * sizeOf(shot.box)) / Math.max(1, Math.hypot(...shot.scene.balls[shot.ball].velocity) / 2 || 1);

/** @param {Box} box */
export const sizeOf = ({ low, high }) => Math.max(high[0] - low[0], high[1] - low[1], 1e-30);
/** @param {Box} box @returns {Vec} */
export const middleOf = ({ low, high }) => [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2];

/** The outline of a wall from above, as chains of points; an infinite one is cut near a box. @param {Wall} wall @param {Box} box @returns {[number, number][][]} */
export function outline(wall, box) {
  const [x, y] = middleOf(box);
  return chainsOf(wall, [x, y], 1.2 * sizeOf(box)).map(lineOf);
}

/** The lowest and the highest corner of a box. @param {Wall} wall @returns {[Vec, Vec]} */
export function boxOf(wall) {
  const low = wall.corner ?? wall.center.map((/** @type {number} */ x, /** @type {number} */ k) => x - wall.size[k] / 2);
  return [low, low.map((/** @type {number} */ x, /** @type {number} */ k) => x + wall.size[k])];
}

/** Whether a wall is finite as seen from above, and no larger than what is looked at. @param {Wall} wall @param {number} far m */
const bounded = (wall, far) => {
  const parts = chainsOf(wall, [0, 0], far).flat();
  return parts.length > 0 && parts.every(({ points, open }) => !open && points.some((p) => p.every((x) => Math.abs(x) < far)));
};

/** Largest radius of the balls. @param {Scene} scene */
const largest = (scene) => Math.max(...scene.balls.map((ball) => ball.radius));

/** How wide the cushions of a wall are drawn behind their noses, m. @param {Wall} wall @param {Scene} scene */
const rail = (wall, scene) => (wall.shape === "table" ? RAIL * largest(scene) : 0);

/**
 * All that is worth looking at: paths of the balls, finite walls, and where the edited ball first meets a wall.
 * @param {Scene} scene @param {Map<string, Run>} runs @param {string} followed a law; balls under others may leave the box
 * @param {{from: number, until: number}} span @returns {Box}
 */
export function boxAround(scene, runs, followed, span) {
  const far = farIn(scene);
  /** @type {Vec} */
  const low = [Infinity, Infinity, scene.floor ? 0 : Infinity];
  /** @type {Vec} */
  const high = [-Infinity, -Infinity, -Infinity];
  const add = (/** @type {number[]} */ x, margin = 0) => {
    for (let k = 0; k < x.length; k++) {
      if (Math.abs(x[k]) > far) continue;
      low[k] = Math.min(low[k], x[k] - margin);
      high[k] = Math.max(high[k], x[k] + margin);
    }
  };
  const none = /** @type {Box} */ ({ low: [0, 0, 0], high: [0, 0, 0] });
  const enclosed = scene.walls.some((wall) => bounded(wall, far) && wall.shape !== "segment");
  for (const wall of scene.walls) if (bounded(wall, far)) for (const line of outline(wall, none)) for (const p of line) add(p, rail(wall, scene));
  scene.balls.forEach((ball) => add(ball.position, ball.radius));
  // the law that is followed first: the others widen the box to no more than twice its size
  const reach = (/** @type {number[]} */ x) => x.map((value, k) => Math.max(low[k] - wide, Math.min(high[k] + wide, value)));
  let wide = Infinity;
  for (const law of new Set([followed, ...runs.keys()])) {
    const run = runs.get(law);
    run?.balls.forEach(({ pieces }, i) => {
      const radius = scene.balls[i].radius;
      const [x, y] = scene.balls[i].position;
      for (const { points } of trail(pieces, span, radius)) for (const p of points) add(enclosed ? [x, y, p[2]] : wide < Infinity ? reach(p) : p, radius);
    });
    if (run && wide === Infinity) wide = 0.25 * Math.max(high[0] - low[0], high[1] - low[1]);
  }
  const least = 10 * largest(scene);
  for (const k of [0, 1]) {
    const missing = (least - (high[k] - low[k])) / 2;
    if (missing > 0) {
      low[k] -= missing;
      high[k] += missing;
    }
  }
  return { low, high };
}

/** Heights between which an upright wall is drawn. @param {Wall} wall @param {Scene} scene @param {Box} box @returns {[number, number]} */
export function levels(wall, scene, box) {
  const radius = largest(scene);
  const low = toNumber(wall.low ?? "-inf");
  const high = toNumber(wall.height ?? "inf");
  const bottom = scene.floor ? 0 : Math.min(box.low[2], -radius);
  // an infinite wall is drawn as high as the balls get, and a little lower than they are wide
  const top = Math.max(bottom + 1.7 * radius, Math.min(box.high[2], bottom + 8 * radius));
  return [Math.max(low, bottom), Math.min(high, top)];
}
