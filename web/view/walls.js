// Walls as meshes: faces of one quiet colour with their edges drawn.

/** @import { Scene, Vec, Wall } from "../state/types.js" */
/** @import { Box, Palette } from "./shot.js" */
import {
  BackSide, BoxGeometry, BufferGeometry, CylinderGeometry, DoubleSide, EdgesGeometry, Float32BufferAttribute, Group, LineBasicMaterial,
  LineSegments, Mesh, MeshLambertMaterial, Quaternion, Shape, ShapeGeometry, SphereGeometry, Vector2, Vector3,
} from "three";
import { cross, plus, times, unit } from "../state/vectors.js";
import { pocketsOf } from "../scene/shapes.js";
import { chainsOf, lineOf } from "./outline.js";
import { RAIL, boxOf, levels, middleOf, outline, sizeOf } from "./shot.js";
import { toNumber } from "../state/edit.js";

const HOLE = "#0c0d0f";

/** @param {number[]} points triples @param {number[]} index */
function geometry(points, index) {
  const made = new BufferGeometry();
  made.setAttribute("position", new Float32BufferAttribute(points, 3));
  made.setIndex(index);
  made.computeVertexNormals();
  return made;
}

/** Vertical faces over chains of points. @param {[number, number][][]} lines @param {number} low @param {number} high */
function ribbons(lines, low, high) {
  const points = [];
  const index = [];
  for (const line of lines) {
    for (let i = 0; i + 1 < line.length; i++) {
      const k = points.length / 3;
      points.push(...line[i], low, ...line[i + 1], low, ...line[i + 1], high, ...line[i], high);
      index.push(k, k + 1, k + 2, k, k + 2, k + 3);
    }
  }
  return geometry(points, index);
}

/** Chains of points at a height, as pairs for LineSegments. @param {[number, number][][]} lines @param {number[]} heights */
function edges(lines, heights) {
  const points = [];
  for (const z of heights) for (const line of lines) for (let i = 0; i + 1 < line.length; i++) points.push(...line[i], z, ...line[i + 1], z);
  const made = new BufferGeometry();
  made.setAttribute("position", new Float32BufferAttribute(points, 3));
  return made;
}

/** The cushions of a table: a profile (distance outwards, height) swept along the four sides. @param {Wall} wall @param {Scene} scene @param {Box} box */
function cushions(wall, scene, box) {
  const radius = Math.max(...scene.balls.map((ball) => ball.radius));
  const [, top] = levels(wall, scene, box);
  const nose = wall.nose_height ?? null;
  const high = Math.max(Math.min(top, 1.7 * radius), nose === null ? 0 : nose + 0.12 * radius);
  const width = RAIL * radius;
  /** @type {[number, number][]} */
  const profile = nose === null ? [[0, 0], [0, high], [width, high], [width, 0]] : [[0.55 * radius, 0], [0, nose], [0.25 * radius, high], [width, high], [width, 0]];
  const [x, y] = wall.center;
  const corners = [[-1, -1], [1, -1], [1, 1], [-1, 1], [-1, -1]].map(([i, j]) => profile.map(([d, z]) => [x + i * (wall.length / 2 + d), y + j * (wall.width / 2 + d), z]));
  const points = [];
  const index = [];
  for (let side = 0; side < 4; side++) {
    for (let i = 0; i + 1 < profile.length; i++) {
      const k = points.length / 3;
      points.push(...corners[side][i], ...corners[side + 1][i], ...corners[side + 1][i + 1], ...corners[side][i + 1]);
      index.push(k, k + 1, k + 2, k, k + 2, k + 3);
    }
  }
  const at = nose === null ? 1 : 1;
  const line = corners.map((corner) => /** @type {[number, number]} */ ([corner[at][0], corner[at][1]]));
  return { faces: geometry(points, index), lines: edges([line], [profile[at][1]]) };
}

/** The cushions of a table with pockets, upright: their faces, their tops, and the pockets. @param {Wall} wall @param {Scene} scene @param {Box} box */
function pocketTable(wall, scene, box) {
  const radius = Math.max(...scene.balls.map((ball) => ball.radius));
  const nose = wall.nose_height ?? radius;
  const high = Math.max(Math.min(levels(wall, scene, box)[1], 1.7 * radius), nose + 0.12 * radius);
  const chains = chainsOf(wall, [0, 0], 0);
  const lines = chains.map(lineOf);
  const long = (/** @type {import("./outline.js").Part} */ { points: [p, q], face }) => (face === null ? -1 : Math.hypot(q[0] - p[0], q[1] - p[1]));
  const tops = chains.map((chain, i) => {
    // back to its beginning along the rail, behind the nose: the longest of its faces
    const { face } = chain.reduce((one, other) => (long(other) > long(one) ? other : one));
    const { p: at, d } = /** @type {import("../scene/shapes.js").Feature} */ (face);
    const out = (/** @type {number[]} */ p) => -(p[0] - at[0]) * d[0] - (p[1] - at[1]) * d[1];
    const width = Math.max(RAIL * radius, ...lines[i].map(out));
    const back = [lines[i][lines[i].length - 1], lines[i][0]].map((p) => new Vector2(p[0] - (width - out(p)) * d[0], p[1] - (width - out(p)) * d[1]));
    return new Shape([...lines[i].map((p) => new Vector2(...p)), ...back]);
  });
  const holes = pocketsOf(wall).map(({ center, radius: r }) => new Shape().absarc(center[0], center[1], r, 0, 2 * Math.PI, false));
  return [
    { faces: ribbons(lines, 0, high), lines: edges(lines, [nose, high]) },
    { faces: new ShapeGeometry(tops).translate(0, 0, high), lines: new BufferGeometry() },
    { faces: new ShapeGeometry(holes, 24).translate(0, 0, 0.06 * radius), lines: new BufferGeometry(), hole: true },
  ];
}

/** A rectangle of a plane near what is seen. @param {Vec} point @param {Vec} n unit @param {Scene} scene @param {Box} box @param {boolean} solid */
function planeFaces(point, n, scene, box, solid) {
  const size = sizeOf(box);
  const flat = Math.hypot(n[0], n[1]);
  const at = middleOf(box);
  const off = (point[0] - at[0]) * n[0] + (point[1] - at[1]) * n[1] + (point[2] - at[2]) * n[2];
  const foot = plus(at, times(n, off));
  if (flat < 0.05) {
    const half = 0.62 * size;
    const z = foot[2];
    const thick = -Math.sign(n[2]) * 0.02 * size;
    return new BoxGeometry(2 * half, 2 * half, Math.abs(thick)).translate(at[0], at[1], z + thick / 2);
  }
  const u = unit([-n[1], n[0], 0]);
  const up = cross(n, u); // rises, as n is nearly horizontal
  const rise = up[2] < 0 ? times(up, -1) : up;
  const [low, high] = levels(/** @type {any} */ ({}), scene, box);
  // the edge of the plane at a height
  const atHeight = (/** @type {number} */ z) => plus(foot, times(rise, (z - foot[2]) / rise[2]));
  const half = 0.75 * size;
  const behind = times(unit([n[0], n[1], 0]), -0.05 * size);
  const [a, b] = [atHeight(low), atHeight(high)];
  const front = [plus(a, times(u, -half)), plus(a, times(u, half)), plus(b, times(u, half)), plus(b, times(u, -half))];
  const back = front.map((p) => plus(p, behind));
  const index = solid ? [0, 1, 2, 0, 2, 3, 3, 2, 6, 3, 6, 7, 0, 4, 5, 0, 5, 1, 1, 5, 6, 1, 6, 2, 0, 3, 7, 0, 7, 4] : [0, 1, 2, 0, 2, 3];
  const made = geometry([...front, ...back].flat(), index).toNonIndexed();
  made.computeVertexNormals();
  return made;
}

/**
 * @param {Wall} wall @param {Scene} scene @param {Box} box
 * @returns {{faces: BufferGeometry, lines?: BufferGeometry, inside?: boolean, clear?: boolean, hole?: boolean}[]}
 */
function parts(wall, scene, box) {
  const [low, high] = levels(wall, scene, box);
  switch (wall.shape) {
    case "table":
      return pocketsOf(wall).length > 0 ? pocketTable(wall, scene, box) : [cushions(wall, scene, box)];
    case "plane": {
      const n = unit(wall.normal);
      return [{ faces: planeFaces(wall.point, n, scene, box, true), clear: Math.hypot(n[0], n[1]) < 0.05 }];
    }
    case "strip": {
      const n = unit(wall.normal);
      const far = plus(wall.point, times(n, wall.width));
      const clear = Math.hypot(n[0], n[1]) < 0.05;
      return [{ faces: planeFaces(wall.point, n, scene, box, true), clear }, { faces: planeFaces(far, times(n, -1), scene, box, true), clear }];
    }
    case "box": {
      const [from, to] = boxOf(wall);
      const at = times(plus(from, to), 0.5);
      return [{ faces: new BoxGeometry(...wall.size).translate(...at), inside: wall.inside }];
    }
    case "sphere":
      return [{ faces: new SphereGeometry(wall.radius, 48, 24).rotateX(Math.PI / 2).translate(.../** @type {Vec} */ (wall.center)), inside: wall.inside, lines: new BufferGeometry() }];
    case "cylinder": {
      const axis = unit(wall.axis);
      const long = toNumber(wall.height);
      const upright = Math.abs(axis[2]) > 0.99;
      const shown = Number.isFinite(long) ? long : upright ? high - low : 2 * sizeOf(box);
      const faces = new CylinderGeometry(wall.radius, wall.radius, shown, 64, 1, wall.inside);
      faces.applyQuaternion(new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), new Vector3(...axis)));
      const start = Number.isFinite(long) ? 0 : upright ? 0 : -shown / 2;
      const base = Number.isFinite(long) || !upright ? /** @type {Vec} */ (wall.point) : /** @type {Vec} */ ([wall.point[0], wall.point[1], axis[2] > 0 ? low : high]);
      return [{ faces: faces.translate(...plus(base, times(axis, start + shown / 2))), inside: wall.inside }];
    }
    default: {
      const lines = outline(wall, box);
      return [{ faces: ribbons(lines, low, high), lines: edges(lines, [low, high]), clear: true }];
    }
  }
}

/** All walls of a scene. @param {Scene} scene @param {Box} box @param {Palette} palette @returns {Group} */
export function wallMeshes(scene, box, palette) {
  const group = new Group();
  const edge = new LineBasicMaterial({ color: palette.edge });
  for (const wall of scene.walls) {
    for (const { faces, lines, inside, clear, hole } of parts(wall, scene, box)) {
      const see = Boolean(clear || inside);
      const material = new MeshLambertMaterial({
        color: hole ? HOLE : palette.wall, side: inside ? BackSide : DoubleSide, transparent: see, opacity: see ? 0.3 : 1, depthWrite: !see,
        // (behind its own edges; a hole has none, and lies over the lines of the floor)
        polygonOffset: !hole, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
      });
      group.add(new Mesh(faces, material));
      group.add(new LineSegments(lines ?? edgesOf(faces, sizeOf(box)), edge));
    }
  }
  return group;
}

/** The edges of faces. (Three rounds places to 1e-4 to find them: a very small or large scene is brought to a size of 1 for it.) @param {BufferGeometry} faces @param {number} size */
function edgesOf(faces, size) {
  if (size > 0.01 && size < 1e4) return new EdgesGeometry(faces, 25);
  const scaled = faces.clone().scale(1 / size, 1 / size, 1 / size);
  const found = new EdgesGeometry(scaled, 25).scale(size, size, size);
  scaled.dispose();
  return found;
}

/** Free the memory of all that is in a group. @param {import("three").Object3D} group */
export function dispose(group) {
  group.traverse((/** @type {any} */ one) => {
    one.geometry?.dispose();
    for (const material of [one.material].flat()) material?.dispose();
  });
}
