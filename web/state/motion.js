// Where a ball is at any time, from the pieces of its path: between two events it moves on a parabola and its spin changes
// at a constant rate, so nothing is stored but where each piece begins.

/** @import { Piece, Run, Scene, Vec } from "./types.js" */
import { kineticEnergy, pullOf } from "../scene/setup.js";
import { cross, dot, length } from "./vectors.js";

/** @typedef {[number, number, number, number]} Quaternion w, x, y, z */
/** @typedef {{x: Vec, v: Vec, w: Vec, phase: string}} State */

const SMALLEST_TURN = 0.15; // rad that the orientation turns in one step of the integration, at most
const MOST_STEPS = 400;

/** The last piece that begins at or before a time. @param {Piece[]} pieces @param {number} t */
function pieceAt(pieces, t) {
  let low = 0;
  let high = pieces.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (pieces[middle].t <= t) low = middle;
    else high = middle - 1;
  }
  return low;
}

/** @param {Piece} piece @param {number} s time since it began @returns {State} */
export function along(piece, s) {
  const { x, v, w, acc, turn } = piece;
  return {
    x: [x[0] + s * (v[0] + 0.5 * s * acc[0]), x[1] + s * (v[1] + 0.5 * s * acc[1]), x[2] + s * (v[2] + 0.5 * s * acc[2])],
    v: [v[0] + s * acc[0], v[1] + s * acc[1], v[2] + s * acc[2]],
    w: [w[0] + s * turn[0], w[1] + s * turn[1], w[2] + s * turn[2]],
    phase: piece.phase,
  };
}

/** The state of a ball at a time. @param {Piece[]} pieces @param {number} t @returns {State} */
export function stateAt(pieces, t) {
  const piece = pieces[pieceAt(pieces, t)];
  return along(piece, Math.max(0, Math.min(t - piece.t, piece.lasts)));
}

/** @param {Quaternion} a @param {Quaternion} b @returns {Quaternion} */
function product(a, b) {
  return [
    a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
    a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
    a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
    a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
  ];
}

/** Turn an orientation by a spin that lasts a time. @param {Quaternion} q @param {Vec} w @param {number} s @returns {Quaternion} */
function turned(q, w, s) {
  const size = length(w);
  const half = (size * s) / 2;
  if (half === 0) return q;
  const k = Math.sin(half) / size;
  return product([Math.cos(half), w[0] * k, w[1] * k, w[2] * k], q);
}

/** Follow the spin through a piece (midpoints of short steps). @param {Quaternion} q @param {Piece} piece @param {number} s */
function turnedAlong(q, piece, s) {
  const changes = length(piece.turn) > 0;
  const most = Math.max(length(piece.w), length(along(piece, s).w)) * s;
  const steps = changes ? Math.min(MOST_STEPS, Math.max(1, Math.ceil(most / SMALLEST_TURN))) : 1;
  for (let i = 0; i < steps; i++) q = turned(q, along(piece, ((i + 0.5) * s) / steps).w, s / steps);
  return q;
}

/** The orientation of one ball at any time; remembers where each piece began. */
export class Orientation {
  /** @param {Piece[]} pieces */
  constructor(pieces) {
    this.pieces = pieces;
    /** @type {Quaternion[]} */
    this.starts = [[1, 0, 0, 0]];
  }

  /** @param {number} t @returns {Quaternion} */
  at(t) {
    const { pieces, starts } = this;
    const i = pieceAt(pieces, t);
    while (starts.length <= i) {
      const before = pieces[starts.length - 1];
      starts.push(turnedAlong(starts[starts.length - 1], before, Math.max(0, pieces[starts.length].t - before.t)));
    }
    return turnedAlong(starts[i], pieces[i], Math.max(0, Math.min(t - pieces[i].t, pieces[i].lasts)));
  }
}

/** How a trail is drawn in a phase. @param {string} phase @returns {"flight" | "sliding" | "rolling"} */
export function styleOf(phase) {
  if (phase === "flight" || phase === "bouncing" || phase === "left") return "flight";
  return phase === "sliding" ? "sliding" : "rolling";
}

/** How far a chord may be from the path, in radii of the ball: a hop of 2 mm is looked at closely, a long slide is not. */
const CHORD = { flight: 0.001, sliding: 0.02, rolling: 0.02 };

/**
 * The path of a ball between two times, as chains of points of one style each. (A chord of a parabola that lasts s is a s^2/8 off it.)
 * @param {Piece[]} pieces
 * @param {{from: number, until: number}} span s
 * @param {number} radius of the ball
 * @returns {{style: "flight" | "sliding" | "rolling", points: Vec[]}[]}
 */
export function trail(pieces, { from, until }, radius) {
  /** @type {{style: "flight" | "sliding" | "rolling", points: Vec[]}[]} */
  const found = [];
  for (const piece of pieces) {
    const [first, end] = [Math.max(0, from - piece.t), Math.min(piece.lasts, until - piece.t)];
    const lasts = end - first;
    if (!(lasts > 0)) continue;
    const style = styleOf(piece.phase);
    const { v, acc } = piece;
    const straight = length(cross(v, acc)) < 1e-9 * length(v) * length(acc);
    const off = (length(acc) * lasts * lasts) / 8;
    const steps = straight ? 1 : Math.max(1, Math.min(32, Math.ceil(Math.sqrt(off / (CHORD[style] * radius)))));
    let last = found[found.length - 1];
    if (!last || last.style !== style) found.push((last = { style, points: [along(piece, first).x] }));
    const top = straight ? -dot(v, acc) / dot(acc, acc) : 0; // when a ball that was thrown straight up turns round
    if (top > first && top < end) last.points.push(along(piece, top).x);
    for (let i = 1; i <= steps; i++) last.points.push(along(piece, first + (lasts * i) / steps).x);
  }
  return found;
}

const MOST_TRAIL = 300; // pieces of a path that are drawn as a whole; of a longer one, as many before the time that is shown
/** How long before the time that is shown trails begin, s. @param {Run | undefined} run @param {{from: number, until: number}} span */
export function trailTime(run, { from, until }) {
  // (a hop that cannot be seen from above is no piece)
  const seen = (/** @type {Piece} */ piece) => piece.lasts > (until - from) / 5000;
  const most = Math.max(0, ...(run?.balls.map(({ pieces }) => pieces.filter(seen).length) ?? []));
  return most > MOST_TRAIL ? (0.2 * MOST_TRAIL * (until - from)) / most : Infinity;
}

/** Kinetic and potential energy of all balls, J. @param {Scene} scene @param {Run} run @param {number} t */
export function energyAt(scene, run, t) {
  let energy = 0;
  scene.balls.forEach((ball, i) => {
    const { x, v, w } = stateAt(run.balls[i].pieces, t);
    const height = scene.floor ? [x[0], x[1], x[2] - ball.radius] : x;
    energy += kineticEnergy(ball, v, w) - ball.mass * dot(pullOf(scene), /** @type {Vec} */ (height));
  });
  return energy;
}

/** Times at which a curve of a run is drawn: events, and enough in between. @param {Run} run @param {number} ball @param {{from: number, until: number}} span @param {number} count */
export function sampleTimes(run, ball, { from, until }, count) {
  const times = new Set([until]);
  for (let i = 0; i < count; i++) times.add(from + ((until - from) * i) / count);
  let left = 4 * count;
  for (const { t, lasts, acc } of run.balls[ball].pieces) {
    if (t > until || left <= 0) break;
    if (t < from) continue;
    times.add(t);
    times.add(Math.min(until, t + lasts * (1 - 1e-9)));
    // a short hop is still a curve
    if (acc[2] !== 0 && lasts < (until - from) / 20) for (let i = 1; i < 6; i++, left--) times.add(Math.min(until, t + (lasts * i) / 6));
    left--;
  }
  return [...times].sort((a, b) => a - b);
}
