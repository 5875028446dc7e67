// When a law has no answer, and why an answer may not apply: the rules of carom.laws, kernels of the module with their sentences.

/** @import { Law, Rule } from "./types.js" */
/** @import { Answer } from "./answers.js" */
/** @import { Meeting } from "./meeting.js" */
/** @import { Module } from "./module.js" */
import { general } from "./text.js";

/** What kernels of rules take of a meeting (carom.laws.law.Case). @param {Omit<Meeting, "t" | "wall" | "balls" | "given" | "g">} m */
export const numbersOf = (m) => [
  ...m.v, ...m.w, ...m.n, m.radius, m.kappa, m.mass, m.e, m.mu, m.beta, m.stiffness, 0, m.floor?.mu ?? 0, m.floor?.beta ?? 0, m.height,
  Number(m.together),
];

/** The rules that say yes, or no, and their sentences. @param {Module} module @param {Rule[]} rules @param {number[]} numbers @param {boolean} yes */
function saying(module, rules, numbers, yes) {
  const { memory } = module;
  const top = memory.top;
  const [given, out] = [memory.put(numbers), memory.take(24)];
  const found = rules.flatMap(({ function: name, text, field }) => {
    module.call(name, 0, given, numbers.length, out, 3);
    const [holds, a, b] = memory.numbers(out, 3);
    if ((holds !== 0) !== yes) return [];
    return [{ field, text: text.replace(/\{([ab]):\.?(\d*)g\}/g, (_, which, digits) => general(which === "a" ? a : b, Number(digits) || 6)) }];
  });
  memory.top = top;
  return found;
}

/** What a law expects and a ball at a wall does not have. @param {Module} module @param {Omit<Meeting, "t" | "wall" | "balls" | "given" | "g">} m @param {Law} law */
export const unmetRules = (module, m, law) => saying(module, law.conditions, numbersOf(m), false);

/** The same as sentences. @param {Module} module @param {Meeting} m @param {Law} law */
export const unmet = (module, m, law) => unmetRules(module, m, law).map(({ text }) => text);

/** Why a law's answer may not apply. @param {Module} module @param {Meeting} m @param {Law} law @param {Answer} answer */
export function objections(module, m, law, answer) {
  const outcome = [...answer.afterWall.v, ...answer.afterWall.w, answer.required, answer.requiredFloor, answer.vertical ?? 0];
  return saying(module, law.objections, [...numbersOf(m), ...outcome], true).map(({ text }) => text);
}
