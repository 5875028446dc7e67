// The numbers that sliders show, and how a scene changes when one is moved. A change returns a new scene; the old one stays
// as it was, for the way back.

/** @import { Ball, Extended, Scene, Surface, Vec, Wall } from "./types.js" */
import { extended } from "../engine/text.js";
import { kappaOf, spinOf } from "../scene/setup.js";
import { unit } from "./vectors.js";

/** @param {Extended | null | undefined} value */
export const toNumber = (value) => (value === null || value === undefined ? Infinity : extended(value));
/** @param {number} value @returns {Extended} */
export const fromNumber = (value) => (value === Infinity ? "inf" : value === -Infinity ? "-inf" : value);

/**
 * @typedef {object} Control
 * @property {string} key
 * @property {"Ball" | "Wall" | "Floor"} group
 * @property {string} label
 * @property {string} unit
 * @property {number} scale shown = SI times this
 * @property {number} least of the slider, SI
 * @property {number} most
 * @property {number} step
 * @property {boolean} [infinite] the right end of the slider is infinity
 * @property {string} [help]
 * @property {(scene: Scene, ball: number, wall: number) => number | null} read null: this scene has no such number
 * @property {(scene: Scene, ball: number, wall: number, value: number) => Scene} write
 */

const DEGREE = Math.PI / 180;

/** @param {Scene} scene @param {number} i @param {Partial<Ball>} changes @returns {Scene} */
export function withBall(scene, i, changes) {
  return { ...scene, balls: scene.balls.map((ball, k) => (k === i ? { ...ball, ...changes } : ball)) };
}

/** @param {Scene} scene @param {number} i -1: all @param {(wall: Wall) => Wall} change @returns {Scene} */
function withWalls(scene, i, change) {
  return { ...scene, walls: scene.walls.map((wall, k) => (i < 0 || k === i ? change(wall) : wall)) };
}

/** The wall that angles are measured from: the first that is a vertical plane. @param {Scene} scene @returns {Vec | null} its normal */
export function referenceNormal(scene) {
  const plane = scene.walls.find((wall) => wall.shape === "plane");
  if (!plane) return null;
  const n = unit(plane.normal);
  const flat = Math.hypot(n[0], n[1]);
  return flat > 0.3 ? [n[0] / flat, n[1] / flat, 0] : null;
}

/** The direction of a ball's way, degrees: from the wall's normal, or from x. @param {Scene} scene @param {number} i */
export function angleOf(scene, i) {
  const [vx, vy] = scene.balls[i].velocity;
  if (vx === 0 && vy === 0) return 0;
  const n = referenceNormal(scene);
  if (!n) return Math.atan2(vy, vx) / DEGREE;
  // towards the wall is -n; positive to the left of the normal, as carom compare has it
  return Math.atan2(vy * n[0] - vx * n[1], -(vx * n[0] + vy * n[1])) / DEGREE;
}

/** @param {Scene} scene @param {number} i @param {number} speed along the floor @param {number} degrees @returns {Scene} */
export function withHeading(scene, i, speed, degrees) {
  const n = referenceNormal(scene);
  const c = Math.cos(degrees * DEGREE) * speed;
  const s = Math.sin(degrees * DEGREE) * speed;
  const vz = scene.balls[i].velocity[2];
  return withBall(scene, i, { velocity: n ? [-c * n[0] - s * n[1], -c * n[1] + s * n[0], vz] : [c, s, vz] });
}

/** A ball at its start: rolling or not. @param {Scene} scene @param {number} i @param {boolean} rolling @returns {Scene} */
export function withRolling(scene, i, rolling) {
  const ball = scene.balls[i];
  if (!rolling) return withBall(scene, i, { rolling, spin: spinOf(ball), spin_z: null });
  const [vx, vy] = ball.velocity;
  const [x, y] = ball.position;
  return withBall(scene, i, {
    rolling, spin: null, spin_z: spinOf(ball)[2], velocity: [vx, vy, 0], position: [x, y, ball.radius],
  });
}

/** The axes of a ball's spin: about its way's horizontal normal (topspin), about its way. @param {Ball} ball */
function axes({ velocity: [vx, vy] }) {
  const flat = Math.hypot(vx, vy);
  const [cx, cy] = flat > 0 ? [vx / flat, vy / flat] : [1, 0];
  return { top: /** @type {Vec} */ ([-cy, cx, 0]), way: /** @type {Vec} */ ([cx, cy, 0]) };
}

/** @param {Ball} ball @param {"top" | "way"} which */
function spinAbout(ball, which) {
  const axis = axes(ball)[which];
  const w = spinOf(ball);
  return w[0] * axis[0] + w[1] * axis[1];
}

/** @param {Scene} scene @param {number} i @param {"top" | "way"} which @param {number} value @returns {Scene} */
function withSpinAbout(scene, i, which, value) {
  const ball = scene.balls[i];
  const found = axes(ball);
  const top = which === "top" ? value : spinAbout(ball, "top");
  const way = which === "way" ? value : spinAbout(ball, "way");
  const spin = /** @type {Vec} */ ([0, 1].map((k) => top * found.top[k] + way * found.way[k]));
  const next = ball.rolling ? withRolling(scene, i, false) : scene;
  return withBall(next, i, { spin: [spin[0], spin[1], spinOf(ball)[2]] });
}

/** @param {Surface} surface */
const restitutionOf = (surface) => (surface.restitution?.form === "constant" ? (surface.restitution.value ?? 1) : null);

/** @param {Scene} scene @param {number} wall the wall shown: the one chosen, or the first */
const shownWall = (scene, wall) => scene.walls[Math.max(wall, 0)];

/** Height of the point that the wall touches, over the radius of the ball. @param {Scene} scene @param {number} i @param {number} wall */
function cushionOf(scene, i, wall) {
  const found = shownWall(scene, wall);
  if (!found) return null;
  const a = scene.balls[i].radius;
  if (found.shape === "table") return found.nose_height === null || found.nose_height === undefined ? a : found.nose_height;
  if (found.shape !== "plane" || !scene.floor) return null;
  const n = unit(found.normal);
  return Math.hypot(n[0], n[1]) > 0.05 ? a * (1 - n[2]) : null;
}

/** @param {Scene} scene @param {number} i @param {number} wall @param {number} height @returns {Scene} */
function withCushion(scene, i, wall, height) {
  const a = scene.balls[i].radius;
  return withWalls(scene, wall, (found) => {
    // (a nose at the height of the centre is an upright cushion)
    if (found.shape === "table") return { ...found, nose_height: height <= a * (1 + 1e-6) ? null : height };
    if (found.shape !== "plane") return found;
    const n = unit(found.normal);
    const flat = Math.hypot(n[0], n[1]);
    const nz = Math.max(-0.95, Math.min(0.95, 1 - height / a));
    const across = Math.sqrt(1 - nz * nz);
    return flat > 0.05 ? { ...found, normal: [(n[0] / flat) * across, (n[1] / flat) * across, nz] } : found;
  });
}

/** @param {Scene} scene @param {number} i @param {number} radius @returns {Scene} */
function withRadius(scene, i, radius) {
  const ball = scene.balls[i];
  const [x, y, z] = ball.position;
  // on the floor it stays on the floor
  const onFloor = scene.floor && Math.abs(z - ball.radius) < 1e-9 * ball.radius;
  return withBall(scene, i, { radius, position: [x, y, onFloor ? radius : Math.max(z, scene.floor ? radius : z)] });
}

/** @param {keyof Surface | "stiffness_ratio"} key @returns {Pick<Control, "read" | "write">} */
const ofWall = (key) => ({
  read: (scene, _ball, wall) => {
    const found = shownWall(scene, wall);
    if (!found) return null;
    if (key === "restitution") return found.restitution ? restitutionOf(found) : 1;
    return toNumber(/** @type {Extended} */ (found[key]));
  },
  write: (scene, _ball, wall, value) =>
    withWalls(scene, wall, (found) => ({
      ...found,
      [key]: key === "restitution" ? { form: "constant", value } : fromNumber(value),
    })),
});

/** @param {"restitution" | "friction" | "tangential_restitution" | "rolling_resistance" | "spin_friction"} key @returns {Pick<Control, "read" | "write">} */
const ofFloor = (key) => ({
  read: ({ floor }) => (!floor ? null : key === "restitution" ? restitutionOf(floor) : toNumber(floor[key])),
  write: (scene, _ball, _wall, value) =>
    scene.floor
      ? { ...scene, floor: { ...scene.floor, [key]: key === "restitution" ? { form: "constant", value } : fromNumber(value) } }
      : scene,
});

/** @type {Control[]} */
export const CONTROLS = [
  {
    key: "speed", group: "Ball", label: "Speed", unit: "m/s", scale: 1, least: 0, most: 8, step: 0.01, help: "along the floor",
    read: (scene, i) => Math.hypot(scene.balls[i].velocity[0], scene.balls[i].velocity[1]),
    write: (scene, i, _wall, value) => withHeading(scene, i, value, angleOf(scene, i)),
  },
  {
    key: "angle", group: "Ball", label: "Angle", unit: "°", scale: 1, least: -180, most: 180, step: 0.1,
    help: "from the wall's normal; without a plane wall from the x axis",
    read: angleOf,
    write: (scene, i, _wall, value) => withHeading(scene, i, Math.hypot(scene.balls[i].velocity[0], scene.balls[i].velocity[1]), value),
  },
  {
    key: "topspin", group: "Ball", label: "Top / back spin", unit: "rad/s", scale: 1, least: -200, most: 200, step: 0.1,
    help: "positive as in rolling forward, negative: backspin; moving it ends rolling",
    read: (scene, i) => spinAbout(scene.balls[i], "top"),
    write: (scene, i, _wall, value) => withSpinAbout(scene, i, "top", value),
  },
  {
    key: "sidespin", group: "Ball", label: "Side spin", unit: "rad/s", scale: 1, least: -200, most: 200, step: 0.1,
    help: "about the vertical, counterclockwise as seen from above",
    read: (scene, i) => spinOf(scene.balls[i])[2],
    write: (scene, i, _wall, value) => {
      const ball = scene.balls[i];
      const [x, y] = spinOf(ball);
      return withBall(scene, i, ball.rolling ? { spin_z: value } : { spin: [x, y, value] });
    },
  },
  {
    key: "massespin", group: "Ball", label: "Massé spin", unit: "rad/s", scale: 1, least: -200, most: 200, step: 0.1,
    help: "about the direction of motion, as after a massé; moving it ends rolling",
    read: (scene, i) => spinAbout(scene.balls[i], "way"),
    write: (scene, i, _wall, value) => withSpinAbout(scene, i, "way", value),
  },
  {
    key: "height", group: "Ball", label: "Height", unit: "mm", scale: 1e3, least: 0, most: 1, step: 0.001, help: "of its lowest point above the floor",
    read: (scene, i) => (scene.floor ? Math.max(0, scene.balls[i].position[2] - scene.balls[i].radius) : null),
    write: (scene, i, _wall, value) => {
      const next = value > 0 && scene.balls[i].rolling ? withRolling(scene, i, false) : scene;
      const { position, radius } = next.balls[i];
      return withBall(next, i, { position: [position[0], position[1], radius + Math.max(0, value)] });
    },
  },
  {
    key: "rise", group: "Ball", label: "Upward speed", unit: "m/s", scale: 1, least: -5, most: 5, step: 0.01,
    read: (scene, i) => scene.balls[i].velocity[2],
    write: (scene, i, _wall, value) => {
      const next = value !== 0 && scene.balls[i].rolling ? withRolling(scene, i, false) : scene;
      const [x, y] = next.balls[i].velocity;
      return withBall(next, i, { velocity: [x, y, value] });
    },
  },
  {
    key: "radius", group: "Ball", label: "Radius", unit: "mm", scale: 1e3, least: 0.005, most: 0.08, step: 0.00025,
    read: (scene, i) => scene.balls[i].radius,
    write: (scene, i, _wall, value) => withRadius(scene, i, value),
  },
  {
    key: "inertia", group: "Ball", label: "Inertia I/(m a²)", unit: "", scale: 1, least: 0.01, most: 0.66, step: 0.01,
    help: "0.4: solid ball; 0.667: thin shell",
    read: (scene, i) => kappaOf(scene.balls[i]),
    write: (scene, i, _wall, value) => withBall(scene, i, { inertia: Math.abs(value - 2 / 3) < 0.001 ? 2 / 3 : value }),
  },
  { key: "restitution", group: "Wall", label: "Restitution", unit: "", scale: 1, least: 0, most: 1, step: 0.01, ...ofWall("restitution") },
  { key: "friction", group: "Wall", label: "Friction", unit: "", scale: 1, least: 0, most: 1.5, step: 0.01, infinite: true, help: "∞: never slips", ...ofWall("friction") },
  {
    key: "tangential_restitution", group: "Wall", label: "Tangential restitution", unit: "", scale: 1, least: -1, most: 1, step: 0.01,
    help: "0 stops the slip, 1 reverses it; maw and stronge compute it from the stiffness ratio", ...ofWall("tangential_restitution"),
  },
  {
    key: "cushion_height", group: "Wall", label: "Cushion height", unit: "mm", scale: 1e3, least: 0.01, most: 0.06, step: 0.0001,
    help: "of the point where the wall touches the ball; at the ball's centre: an upright wall",
    read: cushionOf, write: withCushion,
  },
  {
    key: "stiffness_ratio", group: "Wall", label: "Stiffness ratio", unit: "", scale: 1, least: 0.2, most: 2, step: 0.01,
    help: "tangential over normal, of the laws maw and stronge", ...ofWall("stiffness_ratio"),
  },
  { key: "floor_restitution", group: "Floor", label: "Restitution", unit: "", scale: 1, least: 0, most: 0.95, step: 0.01, ...ofFloor("restitution") },
  { key: "floor_friction", group: "Floor", label: "Friction", unit: "", scale: 1, least: 0, most: 1.5, step: 0.01, infinite: true, help: "∞: never slips", ...ofFloor("friction") },
  { key: "rolling_resistance", group: "Floor", label: "Rolling resistance", unit: "", scale: 1, least: 0, most: 0.05, step: 0.0005, ...ofFloor("rolling_resistance") },
  { key: "spin_friction", group: "Floor", label: "Spin friction", unit: "", scale: 1, least: 0, most: 0.05, step: 0.0005, ...ofFloor("spin_friction") },
];

/** What is wrong with a typed number, as a sentence; null if nothing is. @param {Control} control @param {number} value SI */
export function valueFault(control, value) {
  const { key, label, unit: u, scale } = control;
  /** @type {Record<string, [number, number]>} */
  const hard = {
    speed: [0, 1000], rise: [-1000, 1000], height: [0, 1000], radius: [0.0001, 1], inertia: [0.001, 2 / 3 + 1e-9], restitution: [0, 1],
    floor_restitution: [0, 1], friction: [0, Infinity], floor_friction: [0, Infinity], tangential_restitution: [-1, 1],
    stiffness_ratio: [0.001, 1000], rolling_resistance: [0, 10], spin_friction: [0, 10], angle: [-360, 360], cushion_height: [0.0001, 1],
  };
  const [low, high] = hard[key] ?? [-1e5, 1e5];
  if (value >= low && value <= high) return null;
  const shown = (/** @type {number} */ x) => (x === Infinity ? "∞" : String(Number((x * scale).toPrecision(4))));
  return `${label}: expected a number from ${shown(low)} to ${shown(high)}${u ? ` ${u}` : ""}.`;
}
