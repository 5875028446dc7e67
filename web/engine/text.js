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

/** As carom.formatting.format_number. @param {number} x @param {number} [digits] */
export function numberText(x, digits = 3) {
  if (Number.isNaN(x)) return "–";
  if (!Number.isFinite(x)) return x > 0 ? "∞" : "−∞";
  const size = Math.abs(x);
  if (x !== 0 && !(size >= 1e-3 && size < 1e4)) return general(x, digits);
  const places = x === 0 ? digits : Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
  const text = x.toFixed(places);
  return text.includes(".") ? text.replace(/\.?0+$/, "") : text;
}

/** A length in m as text in m, mm or µm. @param {number} x @param {number} [digits] */
export function lengthText(x, digits = 3) {
  const size = Math.abs(x);
  if (size >= 1) return `${numberText(x, digits)} m`;
  return size >= 1e-3 ? `${numberText(x * 1e3, digits)} mm` : `${numberText(x * 1e6, digits)} µm`;
}

/** A time in s as text in s or ms. @param {number} x */
export const timeText = (x) => (x >= 1 ? `${numberText(x)} s` : `${numberText(x * 1e3)} ms`);
