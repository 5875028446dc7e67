// Is this object a scene that the page can show? Links and dropped files are looked at as carefully as scene files are by
// carom itself: every field, its kind and its range. What only the engine can tell (balls that overlap, a law that needs a
// parameter) it says itself, as a sentence.

/** @import { Scene } from "./types.js" */

export const MOST_BALLS = 40;
export const MOST_WALLS = 60;
const MOST_POINTS = 400;
const LARGEST = 1e6;
const LONGEST_NAME = 80;

/** @typedef {(value: unknown) => string | null} Check what was expected, or null if the value is that */

/** @param {number} least @param {number} most @param {string} what @returns {Check} */
const number = (least, most, what) => (value) =>
  typeof value === "number" && value >= least && value <= most ? null : what;

/** @param {unknown} value */
const infinite = (value) => value === "inf" || value === "-inf" || value === Infinity || value === -Infinity;

const any = number(-LARGEST, LARGEST, "a number");
const positive = number(1e-6, LARGEST, "a number > 0");
const notNegative = number(0, LARGEST, "a number >= 0");
const share = number(0, 1, "a number from 0 to 1");
const spring = number(-1, 1, "a number from -1 to 1");
/** @type {Check} */
const friction = (value) => (value === "inf" || value === Infinity ? null : notNegative(value) && "a number >= 0, or inf");
/** @type {Check} */
const extent = (value) => (infinite(value) ? null : any(value) && "a length in m, or inf");
/** @type {Check} */
const flag = (value) => (typeof value === "boolean" ? null : "true or false");
/** @type {Check} */
const name = (value) => (typeof value === "string" && value.length <= LONGEST_NAME ? null : `a text of at most ${LONGEST_NAME} characters`);
/** @type {Check} */
const inertia = (value) =>
  value === "solid" || value === "hollow" ? null : number(1e-6, 2 / 3 + 1e-12, "solid, hollow or a number above 0, up to 2/3")(value);

/** @param {Check} check @returns {Check} */
const optional = (check) => (value) => (value === null || value === undefined ? null : check(value));

/** @param {number} count @param {string} what @param {Check} [check] @returns {Check} */
const vector = (count, what, check = any) => (value) =>
  Array.isArray(value) && value.length === count && value.every((one) => check(one) === null) ? null : what;

const point = vector(3, "3 lengths in m");
const place = vector(2, "2 lengths in m");
/** @type {Check} */
const direction = (value) =>
  point(value) === null && /** @type {number[]} */ (value).some((one) => one !== 0) ? null : "3 numbers, not all zero";
const size = vector(3, "3 lengths in m, > 0", positive);

/** @param {...string} names @returns {Check} */
const oneOf = (...names) => (value) => (typeof value === "string" && names.includes(value) ? null : `one of ${names.join(", ")}`);

/** @type {Record<string, Record<string, Check>>} */
const FORMS = {
  constant: { value: share },
  polynomial: { coefficients: vector(3, "3 numbers") },
  "han-2005": {},
  power: { at_rest: share, speed: positive, exponent: positive },
  viscoelastic: { c: positive },
  exponential: { at_rest: share, at_speed: share, speed: positive },
};

const FLOOR = { friction, tangential_restitution: spring, rolling_resistance: notNegative, spin_friction: notNegative };
const BALL_CONTACT = { friction, tangential_restitution: spring };
const BALL = {
  radius: positive, mass: positive, inertia, position: point, velocity: vector(3, "3 speeds in m/s"), rolling: flag,
  spin: optional(vector(3, "3 spins in rad/s")), spin_z: optional(any), name: optional(name),
};
const RUN = {
  law: name, duration: optional(positive), max_events: optional(number(1, 1e9, "a whole number >= 1")),
  floor_contact: oneOf("with", "after"),
};
const WALL = {
  friction: optional(friction), tangential_restitution: spring, stiffness_ratio: positive, law: optional(name), name: optional(name),
};
const STANDING = { low: extent, height: extent };
/** @type {Record<string, Record<string, Check>>} */
const SHAPES = {
  plane: { point, normal: direction },
  strip: { point, normal: direction, width: positive },
  wedge: { apex: point, axis: direction, from_angle: any, to_angle: any },
  box: { center: optional(point), corner: optional(point), size, inside: flag },
  segment: { ...STANDING, start: place, end: place },
  polygon: {
    ...STANDING,
    points: (value) =>
      Array.isArray(value) && value.length >= 3 && value.length <= MOST_POINTS && value.every((one) => place(one) === null)
        ? null
        : `3 to ${MOST_POINTS} points [x, y]`,
    closed: flag,
  },
  table: { length: positive, width: positive, center: place, nose_height: optional(positive), height: extent },
  cylinder: { point, axis: direction, radius: positive, inside: flag, length: extent },
  sphere: { center: point, radius: positive, inside: flag },
  arc: { ...STANDING, center: place, radius: positive, from_angle: any, to_angle: any },
  stadium: { length: positive, radius: positive, center: place, angle: any },
};

/** @param {unknown} value @returns {value is Record<string, unknown>} */
const isTable = (value) => typeof value === "object" && value !== null && !Array.isArray(value);

/** @param {unknown} value */
function shown(value) {
  const text = value === undefined ? "nothing" : (JSON.stringify(value) ?? String(value));
  return text.length > 60 ? `${text.slice(0, 57)}...` : text;
}

/** @param {string[]} faults @param {string} at @param {unknown} value @param {Record<string, Check>} fields @param {string[]} [others] */
function table(faults, at, value, fields, others = []) {
  if (!isTable(value)) {
    faults.push(`${at}: expected a table, got ${shown(value)}`);
    return false;
  }
  for (const key of Object.keys(value)) {
    if (!(Object.hasOwn(fields, key) || others.includes(key))) faults.push(`${at}.${key}: expected a field that is known here`);
  }
  for (const [key, check] of Object.entries(fields)) {
    const expected = check(value[key]);
    if (expected) faults.push(`${at}.${key}: expected ${expected}, got ${shown(value[key])}`);
  }
  return true;
}

/** @param {string[]} faults @param {string} at @param {unknown} value @param {boolean} needed */
function restitution(faults, at, value, needed) {
  if (!needed && (value === null || value === undefined)) return;
  const form = isTable(value) ? value.form : undefined;
  if (typeof form !== "string" || !Object.hasOwn(FORMS, form)) {
    faults.push(`${at}.restitution: expected a form of restitution, got ${shown(value)}`);
    return;
  }
  table(faults, `${at}.restitution`, value, FORMS[form], ["form"]);
}

/** @param {string[]} faults @param {string} what @param {unknown} value @param {number} least @param {number} most @returns {unknown[]} */
function several(faults, what, value, least, most) {
  if (Array.isArray(value) && value.length >= least && value.length <= most) return value;
  const got = Array.isArray(value) ? `${value.length}; carom simulate takes more` : shown(value);
  faults.push(`${what}: expected ${least} to ${most} of them, got ${got}`);
  return [];
}

/**
 * Return what is wrong with an object that should be a scene: sentences, none if it is one.
 * @param {unknown} scene
 * @returns {string[]}
 */
export function sceneFaults(scene) {
  /** @type {string[]} */
  const faults = [];
  const parts = ["floor", "walls", "balls", "ball_contact", "run"];
  if (!table(faults, "scene", scene, { gravity: vector(3, "3 accelerations in m/s^2") }, parts) || !isTable(scene)) return faults;
  if (scene.floor !== null && scene.floor !== undefined) {
    if (table(faults, "floor", scene.floor, FLOOR, ["restitution"]) && isTable(scene.floor)) restitution(faults, "floor", scene.floor.restitution, true);
  }
  if (table(faults, "ball_contact", scene.ball_contact, BALL_CONTACT, ["restitution"]) && isTable(scene.ball_contact)) {
    restitution(faults, "ball_contact", scene.ball_contact.restitution, true);
  }
  table(faults, "run", scene.run, RUN);
  several(faults, "balls", scene.balls, 1, MOST_BALLS).forEach((ball, i) => table(faults, `balls[${i}]`, ball, BALL));
  several(faults, "walls", scene.walls, 0, MOST_WALLS).forEach((wall, i) => {
    const shape = isTable(wall) ? wall.shape : undefined;
    if (typeof shape !== "string" || !Object.hasOwn(SHAPES, shape)) {
      faults.push(`walls[${i}].shape: expected one of ${Object.keys(SHAPES).join(", ")}, got ${shown(shape)}`);
      return;
    }
    if (table(faults, `walls[${i}]`, wall, { ...WALL, ...SHAPES[shape] }, ["shape", "restitution"]) && isTable(wall)) {
      restitution(faults, `walls[${i}]`, wall.restitution, false);
    }
  });
  return faults;
}

/**
 * Return the scene, or throw an Error whose message says what is wrong.
 * @param {unknown} scene
 * @returns {Scene}
 */
export function checkedScene(scene) {
  const faults = sceneFaults(scene);
  if (faults.length) throw new Error(faults.slice(0, 3).join(". ") + (faults.length > 3 ? `, and ${faults.length - 3} more.` : "."));
  return /** @type {Scene} */ (scene);
}
