// The shapes of walls: their features, whether they surround the balls, how much room they have, and where no ball can be. As
// carom.scene.planes, segments and rounds have them, with the same bits.

/** @import { Vec, Wall } from "../state/types.js" */
/** @import { Feature, Flat } from "./builders.js" */
/** @import { Pocket } from "./pockets.js" */
import { KIND, corner, disc, feature, levels, line, plane, post, rim, upright } from "./builders.js";
import { direction, extended, length2 } from "./numbers.js";
import { layoutOf, pocketTableFeatures, tableBlocked, tableCorners } from "./pockets.js";
import { UP, across, cross, dot, frame, minus, unit } from "./vectors.js";

/**
 * @typedef {object} Shape
 * @property {(wall: Wall) => Feature[]} features
 * @property {(wall: Wall, x: Vec) => boolean} blocked whether no ball's centre can be at x
 * @property {(wall: Wall, z: number) => boolean} vertical whether it is vertical where a ball with its centre at height z meets it
 * @property {(wall: Wall) => boolean} [encloses] whether the run of a ball that clears it ends
 * @property {(wall: Wall) => Pocket[]} [pockets]
 * @property {(wall: Wall) => number} [room] upper bound of the radius of a ball inside, m
 */

const LEVEL = 1e-12;

/** @param {Wall} wall @param {Vec} d @returns {Vec} */
function beyond(wall, d) {
  const { point: p, width } = wall;
  return [p[0] + width * d[0], p[1] + width * d[1], p[2] + width * d[2]];
}

/** @param {Wall} wall @param {number} degrees @returns {Vec} */
function wedgeSide(wall, degrees) {
  const [u, v] = frame(unit(wall.axis));
  const [c, s] = direction(degrees);
  return [c * u[0] + s * v[0], c * u[1] + s * v[1], c * u[2] + s * v[2]];
}

/** @param {Wall} wall @returns {[Vec, Vec]} the lowest and the highest corner */
function boxEnds(wall) {
  const s = wall.size;
  const c = wall.center;
  /** @type {Vec} */
  const low = wall.corner ?? [c[0] - s[0] / 2, c[1] - s[1] / 2, c[2] - s[2] / 2];
  return [low, [low[0] + s[0], low[1] + s[1], low[2] + s[2]]];
}

/** @type {Vec[]} */
const AXES = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];

/** @param {Wall} wall */
function boxFeatures(wall) {
  const ends = boxEnds(wall);
  const found = [];
  for (let k = 0; k < 3; k++) {
    for (const side of [0, 1]) {
      const [i, j] = [(k + 1) % 3, (k + 2) % 3];
      const way = (side === 1) !== wall.inside ? 1 : -1;
      /** @type {Vec} */
      const d = [way * AXES[k][0], way * AXES[k][1], way * AXES[k][2]];
      if (wall.inside) {
        found.push(plane(ends[side], d));
        continue;
      }
      /** @type {Vec} */
      const p = [...ends[0]];
      p[k] = ends[side][k];
      const [lo2, hi2] = way > 0 ? [0, wall.size[j]] : [-wall.size[j], 0];
      found.push(feature(KIND.face, p, { d, u: AXES[i], lo1: 0, hi1: wall.size[i], lo2, hi2 }));
    }
  }
  if (wall.inside) return found;
  for (let k = 0; k < 3; k++) {
    const [i, j] = [(k + 1) % 3, (k + 2) % 3];
    for (const one of [0, 1]) {
      for (const two of [0, 1]) {
        /** @type {Vec} */
        const p = [...ends[0]];
        p[i] = ends[one][i];
        p[j] = ends[two][j];
        found.push(line(p, AXES[k], 0, wall.size[k]));
      }
    }
  }
  for (const i of [0, 1]) for (const j of [0, 1]) for (const k of [0, 1]) found.push(corner([ends[i][0], ends[j][1], ends[k][2]]));
  return found;
}

/** @param {Wall} wall @returns {Flat[]} its points, counterclockwise where it is closed */
function polygonPoints(wall) {
  /** @type {Flat[]} */
  const points = wall.points;
  if (!wall.closed) return points;
  let area = 0;
  points.forEach(([x, y], i) => {
    const [u, v] = points[(i + 1) % points.length];
    area += x * v - y * u;
  });
  return area < 0 ? [...points].reverse() : points;
}

/** @param {Wall} wall @returns {Vec} */
function cylinderEnd(wall) {
  const [p, d, long] = [wall.point, unit(wall.axis), extended(wall.length)];
  return [p[0] + long * d[0], p[1] + long * d[1], p[2] + long * d[2]];
}

/** @param {Wall} wall */
function cylinderFeatures(wall) {
  /** @type {[Vec, Vec, number, number]} */
  const [p, d, R, long] = [wall.point, unit(wall.axis), wall.radius, extended(wall.length)];
  if (!(long < Infinity)) return [line(p, d, -Infinity, Infinity, R, wall.inside ? -1 : 1)];
  const found = (wall.inside ? [-1, 1] : [1]).map((side) => line(p, d, 0, long, R, side));
  if (!wall.inside) found.push(disc(p, [-d[0], -d[1], -d[2]], R), disc(cylinderEnd(wall), d, R));
  return [...found, rim(p, d, R), rim(cylinderEnd(wall), d, R)];
}

/** @param {Wall} wall @param {Vec} x */
function cylinderBlocked(wall, x) {
  const [r, d] = [minus(x, wall.point), unit(wall.axis)];
  const off = across(r, d);
  const far = Math.sqrt(dot(off, off));
  if (extended(wall.length) < Infinity) {
    const along = dot(r, d);
    return !wall.inside && far < wall.radius && 0 < along && along < extended(wall.length);
  }
  return wall.inside ? far > wall.radius : far < wall.radius;
}

/** @param {Wall} wall */
const fullCircle = (wall) => wall.to_angle - wall.from_angle >= 360;

/** @param {Wall} wall */
function arcFeatures(wall) {
  const [low, high, span] = [extended(wall.low), extended(wall.height), wall.to_angle - wall.from_angle];
  /** @type {Vec} */
  const u = [...direction(wall.from_angle + span / 2), 0];
  const cosine = fullCircle(wall) ? -1 : direction(span / 2)[0];
  const [x, y] = wall.center;
  const R = wall.radius;
  /** @param {number} kind @param {number} which @param {number} lo2 @param {number} hi2 */
  const side = (kind, which, lo2, hi2) => feature(kind, [x, y, 0], { R, side: which, u, lo1: cosine, hi1: 1, lo2, hi2 });
  const found = low < high ? [-1, 1].map((which) => side(KIND.line, which, low, high)) : [];
  for (const z of levels(low, high)) found.push(rim([x, y, z], UP, R, u, cosine));
  if (!fullCircle(wall)) {
    for (const degrees of [wall.from_angle, wall.to_angle]) {
      const [c, s] = direction(degrees);
      /** @type {Flat} */
      const end = [x + R * c, y + R * s];
      if (low < high) found.push(post(end, low, high));
      for (const z of levels(low, high)) found.push(corner([...end, z]));
    }
  }
  if (Number.isFinite(high)) {
    for (const which of fullCircle(wall) ? [-1] : [-1, 1]) found.push(side(KIND.over, which, high, Infinity));
  }
  return found;
}

/** @param {Wall} wall */
function stadiumFeatures(wall) {
  const [t, half, R] = [direction(wall.angle), wall.length / 2, wall.radius];
  const n = [-t[1], t[0]];
  /** @param {number} along @param {number} off @returns {Vec} */
  const at = (along, off) => [wall.center[0] + along * t[0] + off * n[0], wall.center[1] + along * t[1] + off * n[1], 0];
  const found = [];
  for (const s of [1, -1]) {
    /** @type {Vec} */
    const u = [s * t[0], s * t[1], 0];
    found.push(feature(KIND.face, at(0, -s * R), { d: [-u[1], u[0], 0], u, lo1: -half, hi1: half }));
    found.push(feature(KIND.line, at(s * half, 0), { R, side: -1, u, lo1: 0, hi1: 1 }));
  }
  return found;
}

/** @param {Wall} wall @param {number} z */
const stands = (wall, z) => extended(wall.low) <= z && z <= extended(wall.height);
/** @param {Vec} v */
const level = (v) => Math.abs(unit(v)[2]) < LEVEL;

/** @type {Record<string, Shape>} */
export const SHAPES = {
  plane: {
    features: (wall) => [plane(wall.point, unit(wall.normal))],
    blocked: (wall, x) => dot(minus(x, wall.point), wall.normal) < 0,
    vertical: (wall) => level(wall.normal),
  },
  strip: {
    features: (wall) => {
      const near = unit(wall.normal);
      return [plane(wall.point, near), plane(beyond(wall, near), [-near[0], -near[1], -near[2]])];
    },
    blocked: (wall, x) => {
      const d = unit(wall.normal);
      return dot(minus(x, wall.point), d) < 0 || dot(minus(x, beyond(wall, d)), d) > 0;
    },
    vertical: (wall) => level(wall.normal),
  },
  wedge: {
    features: (wall) => {
      const axis = unit(wall.axis);
      const [first, last] = [wedgeSide(wall, wall.from_angle), wedgeSide(wall, wall.to_angle)];
      if (wall.to_angle - wall.from_angle <= 180) return [plane(wall.apex, cross(axis, first)), plane(wall.apex, cross(last, axis))];
      return [
        feature(KIND.face, wall.apex, { d: cross(axis, first), u: first, lo1: 0 }),
        feature(KIND.face, wall.apex, { d: cross(last, axis), u: last, lo1: 0 }),
        line(wall.apex, axis),
      ];
    },
    blocked: (wall, x) => {
      const r = minus(x, wall.apex);
      const [u, v] = frame(unit(wall.axis));
      const angle = (Math.atan2(dot(r, v), dot(r, u)) * 180) / Math.PI - wall.from_angle;
      return angle - 360 * Math.floor(angle / 360) > wall.to_angle - wall.from_angle;
    },
    vertical: (wall) => Math.abs(unit(wall.axis)[2]) > 1 - LEVEL,
  },
  box: {
    features: boxFeatures,
    blocked: (wall, x) => {
      const [low, high] = boxEnds(wall);
      return [0, 1, 2].every((k) => low[k] < x[k] && x[k] < high[k]) !== wall.inside;
    },
    vertical: (wall, z) => boxEnds(wall)[0][2] <= z && z <= boxEnds(wall)[1][2],
  },
  segment: {
    features: (wall) => upright([wall.start, wall.end], false, extended(wall.low), extended(wall.height)),
    blocked: () => false,
    vertical: stands,
  },
  polygon: {
    features: (wall) => upright(polygonPoints(wall), wall.closed, extended(wall.low), extended(wall.height)),
    blocked: () => false,
    vertical: stands,
    encloses: (wall) => wall.closed,
  },
  table: {
    features: (wall) => {
      const layout = layoutOf(wall);
      if (layout.mouths.length > 0) return pocketTableFeatures(wall, layout);
      return upright(tableCorners(wall), true, wall.nose_height ?? -Infinity, extended(wall.height), true);
    },
    blocked: tableBlocked,
    pockets: (wall) => layoutOf(wall).mouths.map(({ pocket }) => pocket),
    vertical: (wall, z) => (wall.nose_height === null || wall.nose_height <= z) && z <= extended(wall.height),
    encloses: () => true,
    room: (wall) => Math.min(wall.length, wall.width) / 2,
  },
  cylinder: {
    features: cylinderFeatures,
    blocked: cylinderBlocked,
    vertical: (wall, z) => {
      const ends = extended(wall.length) < Infinity ? [wall.point[2], cylinderEnd(wall)[2]] : [-Infinity, Infinity];
      return Math.abs(unit(wall.axis)[2]) > 1 - LEVEL && Math.min(...ends) <= z && z <= Math.max(...ends);
    },
    room: (wall) => (wall.inside && !(extended(wall.length) < Infinity) ? wall.radius : Infinity),
  },
  sphere: {
    features: (wall) => [feature(KIND.point, wall.center, { R: wall.radius, side: wall.inside ? -1 : 1 })],
    blocked: (wall, x) => {
      const r = minus(x, wall.center);
      const far = Math.sqrt(dot(r, r));
      return wall.inside ? far > wall.radius : far < wall.radius;
    },
    vertical: (wall, z) => Math.abs(z - wall.center[2]) < LEVEL * wall.radius,
    room: (wall) => (wall.inside ? wall.radius : Infinity),
  },
  arc: { features: arcFeatures, blocked: () => false, vertical: stands, encloses: fullCircle },
  stadium: {
    features: stadiumFeatures,
    blocked: (wall, x) => {
      const [[tx, ty], dx, dy] = [direction(wall.angle), x[0] - wall.center[0], x[1] - wall.center[1]];
      const [along, off] = [dx * tx + dy * ty, dy * tx - dx * ty];
      return length2(Math.max(Math.abs(along) - wall.length / 2, 0), off) > wall.radius;
    },
    vertical: () => true,
    room: (wall) => wall.radius,
  },
};
