// Numbers in sentences, as Python's format has them.

/** As Python's f"{x:.<digits>g}". @param {number} x @param {number} digits */
export function general(x, digits) {
  if (!Number.isFinite(x)) return Number.isNaN(x) ? "nan" : x > 0 ? "inf" : "-inf";
  if (x === 0) return Object.is(x, -0) ? "-0" : "0";
  const [head, tail] = x.toExponential(digits - 1).split("e");
  const power = Number(tail);
  /** @param {string} text */
  const short = (text) => (text.includes(".") ? text.replace(/\.?0+$/, "") : text);
  if (power < -4 || power >= digits) {
    return `${short(head)}e${power < 0 ? "-" : "+"}${String(Math.abs(power)).padStart(2, "0")}`;
  }
  return short(x.toFixed(Math.max(digits - 1 - power, 0)));
}

/** @param {ArrayLike<number>} v @param {number} digits */
export const vectorText = (v, digits) => `(${Array.from(v, (x) => general(x, digits)).join(", ")})`;
