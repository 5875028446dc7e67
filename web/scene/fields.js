// Are the fields of a scene what carom.scene says they are? The bounds are those of its models, which engine.json carries.

/** @import { Layout } from "../engine/types.js" */
/**
 * @typedef {object} Field
 * @property {string} kind number, vector, flag, choice, text, whole, part; or the name of a field with rules of its own
 * @property {string} [what]
 * @property {number | null} [least]
 * @property {number | null} [most]
 * @property {boolean} [above]
 * @property {boolean} [infinite]
 * @property {[number, number]} [counts]
 * @property {Field} [each]
 * @property {boolean} [nonzero]
 * @property {string[]} [values]
 * @property {boolean} [optional]
 * @property {boolean} [required]
 * @property {Field} [number] of a friction
 * @property {Record<string, Field>} [falling] of a friction that falls with the slip
 */

/** @typedef {Record<string, Field>} Fields */

/** A number of a scene; "inf" is infinity. @param {unknown} value @returns {number} */
export function extended(value) {
  if (value === "inf") return Infinity;
  if (value === "-inf") return -Infinity;
  return typeof value === "number" ? value : NaN;
}

const [SMALLEST, LARGEST] = [1e-100, 1e100];
const LONGEST_SHOWN = 60;
/** @type {Field} */
const ACCELERATION = { kind: "number", what: "an acceleration in m/s^2" };
const KAPPA = "'solid', 'hollow', or kappa = I/(m a^2) in (0, 2/3]";

/** @param {unknown} value */
function textOf(value) {
  if (typeof value === "number") return String(value); // (JSON has no NaN)
  try {
    return JSON.stringify(value) ?? String(value);
  } catch {
    return String(value); // (what refers to itself)
  }
}

/** What a user has given, in a message. @param {unknown} value */
export function shown(value) {
  const text = value === undefined || value === null ? "nothing" : textOf(value);
  return text.length > LONGEST_SHOWN ? `${text.slice(0, LONGEST_SHOWN - 3)}...` : text;
}

/** @param {unknown} value @returns {value is Record<string, unknown>} */
export const isTable = (value) => typeof value === "object" && value !== null && !Array.isArray(value);

/** @param {unknown} value @param {Field} field */
function isNumber(value, field) {
  const x = extended(value);
  const least = field.least ?? -Infinity;
  const held = field.above ? x > least : x >= least;
  const size = Math.abs(x);
  const resolved = (field.above ? size >= SMALLEST : true) && size <= LARGEST;
  return held && x <= (field.most ?? Infinity) && (resolved || (field.infinite === true && size === Infinity));
}

/** Lists the faults of a scene's fields. */
class FieldChecker {
  /** @param {Layout} layout */
  constructor(layout) {
    this.layout = layout;
    /** @type {string[]} */
    this.faults = [];
  }

  /** @param {string} at @param {string} expected @param {unknown} value */
  fault(at, expected, value) {
    this.faults.push(`${at}: expected ${expected}, got ${shown(value)}`);
  }

  /** @param {string} at @param {unknown} value @param {Fields} fields */
  table(at, value, fields) {
    if (!isTable(value)) {
      this.fault(at, "a table of fields", value);
      return;
    }
    for (const name of Object.keys(value)) {
      if (!Object.hasOwn(fields, name)) this.fault(at || "scene", "a field that is known here", name);
    }
    for (const [name, field] of Object.entries(fields)) {
      if (field.kind !== "part") this.field(at === "" ? name : `${at}.${name}`, value[name], field);
    }
  }

  /** @param {string} at @param {unknown} value @param {Field} field */
  field(at, value, field) {
    if (value === undefined || value === null) {
      if (!field.optional) this.fault(at, field.what ?? "a value", value);
      return;
    }
    const texts = ["text", "law"].includes(field.kind);
    if (field.kind === "number" && !isNumber(value, field)) this.fault(at, field.what ?? "a number", value);
    else if (field.kind === "vector" || field.kind === "gravity") this.vector(at, value, field);
    else if (field.kind === "flag" && typeof value !== "boolean") this.fault(at, "true or false", value);
    else if (field.kind === "choice" && !field.values?.includes(String(value))) this.fault(at, `one of ${field.values?.join(", ")}`, value);
    else if (field.kind === "whole" && !(Number.isInteger(value) && Number(value) >= 1)) this.fault(at, "a whole number >= 1", value);
    else if (texts && typeof value !== "string") this.fault(at, "a text", value);
    else if (field.kind === "law" && !this.layout.laws.some((law) => law.name === value)) {
      this.fault(at, `one of ${this.layout.laws.map((law) => law.name).join(", ")}`, value);
    } else if (field.kind === "pockets") this.table(at, value, this.layout.fields.pockets);
    else if (field.kind === "restitution") this.restitution(at, value);
    else if (field.kind === "friction" && isTable(value)) this.table(at, value, field.falling ?? {});
    else if (field.kind === "friction" && field.number) this.field(at, value, field.number);
    else if (field.kind === "inertia" && value !== "solid" && value !== "hollow") {
      if (!isNumber(value, { kind: "number", least: 0, most: (2 / 3) * (1 + 1e-12), above: true })) this.fault(at, KAPPA, value);
    }
  }

  /** @param {string} at @param {unknown} value @param {Field} field */
  vector(at, value, field) {
    const [least, most] = field.counts ?? [3, 3];
    const each = field.each ?? ACCELERATION;
    if (!Array.isArray(value) || value.length < least || value.length > most) {
      this.fault(at, field.what ?? "3 numbers", value);
      return;
    }
    value.forEach((one, i) => this.field(`${at}[${i}]`, one, each));
    if (field.nonzero && value.every((one) => one === 0)) this.fault(at, "a direction, not all zero", value);
  }

  /** @param {string} at @param {unknown} value */
  restitution(at, value) {
    const forms = this.layout.fields.restitution;
    const form = isTable(value) ? value.form : undefined;
    if (typeof form === "string" && Object.hasOwn(forms, form)) this.table(at, value, forms[form]);
    else this.fault(`${at}.form`, `one of ${Object.keys(forms).join(", ")}`, form ?? value);
  }
}

/** All that is wrong with the fields of a scene, one line per problem; none if it has the fields of a scene. @param {unknown} scene @param {Layout} layout @returns {string[]} */
export function fieldFaults(scene, layout) {
  const { fields } = layout;
  const checker = new FieldChecker(layout);
  if (!isTable(scene)) {
    checker.fault("scene", "a table of fields", scene);
    return checker.faults;
  }
  checker.table("", scene, fields.scene);
  if (scene.floor !== null) checker.table("floor", scene.floor, fields.floor);
  checker.table("ball_contact", scene.ball_contact, fields.ball_contact);
  checker.table("run", scene.run, fields.run);
  const [walls, balls] = [scene.walls, scene.balls];
  if (!Array.isArray(walls)) checker.fault("walls", "a list", walls);
  else {
    walls.forEach((wall, i) => {
      const shape = isTable(wall) ? wall.shape : undefined;
      if (typeof shape === "string" && Object.hasOwn(fields.walls, shape)) checker.table(`walls[${i}]`, wall, fields.walls[shape]);
      else checker.fault(`walls[${i}].shape`, `one of ${Object.keys(fields.walls).join(", ")}`, shape);
    });
  }
  if (!Array.isArray(balls) || balls.length === 0) checker.fault("balls", "at least one ball", balls);
  else balls.forEach((ball, i) => checker.table(`balls[${i}]`, ball, fields.ball));
  return checker.faults;
}
