// Walls as the module's kernels see them: what a ball can touch, where no ball can be, and what is wrong with one. A shape is known
// by its name in engine.json alone, so that one that is added in Python is here too.

/** @import { Vec, Wall } from "../state/types.js" */
/** @import { Module } from "../engine/module.js" */
import { extended, filled } from "../engine/text.js";

/**
 * A feature of a wall, as carom.core.geometry.features has them.
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
 * @property {number[][]} [rows] the table of a smooth arc
 * @property {number} pocket place of the pocket whose edge it is, among those of its shape; -1 for none, layout.first_cushion - k for a part of cushion k
 */

const COLUMNS = 17;
const FAULT_COLUMNS = 4;
const [ROOM, FAULTS] = [64, 64];
const MOST_KEPT = 256;

/** @type {Module | null} the engine of this page */
let module = null;
/** @type {Map<string, Feature[]>} by shape and numbers: a scene asks for the same walls again and again */
const kept = new Map();

/** Ask a module's kernels from now on. @param {Module} loaded */
export function askOf(loaded) {
  module = loaded;
  kept.clear();
}

const engine = () => {
  if (module === null) throw new Error("engine: expected carom's module to be loaded before a wall is looked at");
  return module;
};

/** What kernels take: fields in their order. @param {any} part @param {Record<string, number | string[]>} fields @returns {number[]} */
function numbersOf(part, fields) {
  /** @param {any} value @returns {number[]} */
  const flat = (value) => (Array.isArray(value) ? value.flatMap(flat) : [typeof value === "boolean" ? Number(value) : extended(value)]);
  return Object.entries(fields).flatMap(([name, count]) => {
    const value = part[name] ?? null;
    if (Array.isArray(count)) return count.map((one) => (value === null ? NaN : extended(value[one]))); // (of a part, its fields)
    if (value === null) return Array(count).fill(NaN);
    return count > 0 ? flat(value) : [value.length, ...flat(value)];
  });
}

/** The table of an arc, whose first row begins with the number of its panels. @param {Wall} wall @param {number} first @returns {number[][]} */
const tableOf = ({ panels }, first) => panels.slice(first, first + panels[first][0] + 2);

/** @param {Wall} wall */
const wallNumbers = (wall) => numbersOf(wall, engine().layout.shapes[wall.shape].numbers);

/** What a ball can touch of a wall, and the gates above. @param {Wall} wall @returns {Feature[]} */
export function featuresOf(wall) {
  const numbers = wallNumbers(wall);
  const key = `${wall.shape} ${numbers.map((x) => (Object.is(x, -0) ? "-0" : x)).join(" ")}`;
  let found = kept.get(key);
  if (found === undefined) {
    if (kept.size >= MOST_KEPT) kept.clear();
    found = engine().rows(`features_${wall.shape}`, [numbers], COLUMNS, ROOM).map((r) => ({
      kind: r[0], p: [r[1], r[2], r[3]], d: [r[4], r[5], r[6]], R: r[7], side: r[8], u: [r[9], r[10], r[11]],
      lo1: r[12], hi1: r[13], lo2: r[14], hi2: r[15], pocket: r[16], ...(r[0] === engine().layout.features.curve && { rows: tableOf(wall, r[12]) }),
    }));
    kept.set(key, found);
  }
  return found;
}

/**
 * What a wall says of a place: whether no ball's centre can be there, and whether it is vertical where a ball at its height meets it;
 * whether it surrounds the balls, and the upper bound of the radius of a ball inside, m.
 * @param {Wall} wall @param {Vec} x
 */
export function placeAt(wall, x) {
  const { memory } = engine();
  const top = memory.top;
  const numbers = wallNumbers(wall);
  const [given, at, out] = [memory.put(numbers), memory.put(x), memory.take(32)];
  engine().call(`place_${wall.shape}`, 0, given, numbers.length, at, 3, out, 4);
  const [blocked, vertical, encloses, room] = memory.numbers(out, 4);
  memory.top = top;
  return { blocked: blocked !== 0, vertical: vertical !== 0, encloses: encloses !== 0, room };
}

/** @param {Wall} wall @returns {{name: string, center: [number, number], radius: number}[]} */
export const pocketsOf = (wall) =>
  featuresOf(wall).filter(({ pocket }) => pocket >= 0).map(({ p, R, pocket }) => ({ name: pocketName(wall, pocket), center: [p[0], p[1]], radius: R }));

/** @param {Wall} wall @param {number} place */
const pocketName = (wall, place) => (engine().layout.shapes[wall.shape].pockets ?? [])[place];

/** What is wrong with a part whose fields are sound, in the words of its Python class. @param {Module} module @param {string} at @param {string} name of the part, or a shape @param {any} value @returns {string[]} */
export function ruleFaults({ layout }, at, name, value) {
  const own = name in layout.parts ? `part_${name}` : name;
  const { numbers, faults, pockets } = layout.parts[name] ?? layout.shapes[name];
  const found = engine().rows(`faults_${own}`, [numbersOf(value, numbers)], FAULT_COLUMNS, FAULTS).map(([code, a, b, c]) => filled(faults[code], { ...value, a, b, c }, at, pockets));
  const vanishes = found.length === 0 && name in layout.shapes && featuresOf(value).some(({ p, d, R }) => Number.isNaN(p[0] + p[1] + p[2] + d[0] + d[1] + d[2] + R));
  return vanishes ? [filled(layout.vanishes, {}, at)] : found;
}
