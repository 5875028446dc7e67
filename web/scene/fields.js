// Are the parts of a scene what carom.scene says they are? Their fields, bounds and texts are those of its models, which engine.json
// carries, and their rules are kernels.

/** @import { Field } from "../engine/types.js" */
/** @import { Module } from "../engine/module.js" */
import { extended, general, repr, shown } from "../engine/text.js";
import { ruleFaults } from "./shapes.js";

const [SMALLEST, LARGEST] = [1e-100, 1e100];

/** @param {unknown} value @returns {value is Record<string, any>} */
export const isTable = (value) => typeof value === "object" && value !== null && !Array.isArray(value);

/** What is expected of a number that a value is not; empty if it is one. @param {unknown} value @param {Field} field */
function expectedNumber(value, { what, least, most, above, infinite, words }) {
  if (typeof value === "string" && words?.includes(value)) return "";
  const x = extended(value);
  const size = Math.abs(x);
  const held = above ? x > (least ?? -Infinity) : x >= (least ?? -Infinity);
  const resolved = (!above || size >= SMALLEST) && size <= LARGEST;
  if (held && x <= (most ?? Infinity) && (resolved || (infinite && size === Infinity))) return "";
  if (size > LARGEST && size < Infinity) return `${what}, at most ${general(LARGEST, 6)} in size`;
  return size > 0 && size < SMALLEST ? `${what}, at least ${general(SMALLEST, 6)} in size` : what;
}

/** All that is wrong with a value and the parts in it, one line per problem. @param {Module} module @param {string} at @param {any} value @param {Field} field @returns {string[]} */
export function fieldFaults(module, at, value, field) {
  const { fields } = module.layout;
  if (field.optional && (value === null || value === undefined)) return [];
  if (field.of) return fieldFaults(module, at, value, fields[field.of]);
  const { kind, what, each } = field;
  const fault = (/** @type {string} */ expected = what, /** @type {unknown} */ got = value, /** @type {string} */ place = at) =>
    [`${place || "scene"}: expected ${expected}, got ${shown(at === "" ? (got ?? undefined) : got)}`];
  /** @param {any[]} list @param {Field} of */
  const inside = (list, of) => list.flatMap((one, i) => fieldFaults(module, `${at}[${i}]`, one, of));
  const place = (/** @type {string} */ name) => (at === "" ? name : `${at}.${name}`);
  if (kind === "part") {
    if (!isTable(value)) return fault();
    const own = Object.entries(field.fields ?? {});
    const found = [
      ...own.flatMap(([name, one]) => fieldFaults(module, place(name), value[name], one)),
      ...Object.keys(value).filter((name) => !own.some(([known]) => known === name)).flatMap((name) => fault("a field that is known here", name, place(name))),
    ];
    return found.length === 0 && field.rules ? ruleFaults(module, at, field.rules, value) : found;
  }
  if (kind === "tagged") {
    const [tag, options] = [/** @type {string} */ (field.tag), field.options ?? {}];
    if (!isTable(value)) return fault(what ?? "a table of fields");
    return Object.hasOwn(options, value[tag]) ? fieldFaults(module, at, value, options[value[tag]]) : [`${place(tag)}: expected one of ${Object.keys(options).join(", ")}, got ${shown(value[tag])}`];
  }
  if (kind === "list" || kind === "vector") {
    if (!Array.isArray(value)) return fault();
    if (field.least && value.length === 0) return [`${at}: expected ${field.least}, got none; a file has a table [[${at}]] for each`];
    const [least, most] = field.counts ?? [0, Infinity];
    if (value.length < least || value.length > most) return fault();
    const found = inside(value, /** @type {Field} */ (each));
    return found.length === 0 && field.nonzero && value.every((one) => one === 0) ? [`${at}: expected a direction, not all zero, got ${repr(value, true)}`] : found;
  }
  if (kind === "number") {
    if (field.part && isTable(value)) return fieldFaults(module, at, value, fields[field.part]);
    const expected = expectedNumber(value, field);
    return expected ? fault(expected) : [];
  }
  const holds = {
    flag: typeof value === "boolean", text: typeof value === "string", choice: field.values?.includes(value),
    whole: Number.isSafeInteger(value) && value >= Number(field.least),
  };
  return holds[/** @type {keyof typeof holds} */ (kind)] ? [] : fault();
}
