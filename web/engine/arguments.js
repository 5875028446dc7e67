// What the engine's functions are given, before they look into it: a page's console and a user's script call them.

/** @import { Law, Limits } from "./types.js" */
import { shown } from "./text.js";

/** Throw an Error, one line, unless a law has one of the names. @param {unknown} law @param {Law[]} laws */
export function requireLaw(law, laws) {
  const names = laws.map(({ name }) => name);
  if (typeof law !== "string" || !names.includes(law)) throw new Error(`law: expected one of ${names.join(", ")}, got ${shown(law)}`);
}

const LEAST = { events: 1, until: 0, milliseconds: 0 };

/** Throw an Error, one line per problem, unless limits are numbers by their names. @param {unknown} limits @returns {asserts limits is Limits} */
export function requireLimits(limits) {
  if (typeof limits !== "object" || limits === null || Array.isArray(limits)) {
    throw new Error(`limits: expected an object such as { events: 500, until: 2 }, got ${shown(limits)}`);
  }
  const wrong = Object.entries(limits).flatMap(([name, value]) => {
    if (name === "enough") return []; // (the page's own)
    if (!Object.hasOwn(LEAST, name)) return [`limits: expected ${Object.keys(LEAST).join(", ")}, got ${shown(name)}`];
    const least = LEAST[/** @type {keyof typeof LEAST} */ (name)];
    const whole = name !== "events" || Number.isInteger(value) || value === Infinity;
    if (value === undefined || (typeof value === "number" && value >= least && whole)) return [];
    return [`limits.${name}: expected a ${name === "events" ? "whole " : ""}number >= ${least}, got ${shown(value)}`];
  });
  if (wrong.length > 0) throw new Error(wrong.join("\n"));
}

/** Throw an Error, one line, unless a time is a number. @param {unknown} t */
export function requireTime(t) {
  if (typeof t !== "number" || Number.isNaN(t)) throw new Error(`t: expected a time in s, such as 0.5, got ${shown(t)}`);
}

const isVector = (/** @type {unknown} */ x) => Array.isArray(x) && x.length === 3 && x.every(Number.isFinite);

/** Throw an Error, one line, unless starts are velocities, maybe with spins, and a ball is one of so many. @param {unknown} starts @param {unknown} ball @param {number} count */
export function requireStarts(starts, ball, count) {
  if (!Number.isInteger(ball) || !(Number(ball) >= 0 && Number(ball) < count)) throw new Error(`ball: expected a whole number from 0 to ${count - 1}, got ${shown(ball)}`);
  if (!Array.isArray(starts)) throw new Error(`starts: expected a list such as [{ velocity: [1, 0, 0] }], got ${shown(starts)}`);
  const wrong = starts.findIndex((one) => !isVector(one?.velocity) || (one.spin !== undefined && !isVector(one.spin)));
  if (wrong >= 0) throw new Error(`starts[${wrong}]: expected a velocity and maybe a spin of three numbers each, got ${shown(starts[wrong])}`);
}
