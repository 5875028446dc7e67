// Numbers in sentences, as Python's format has them.

/** As toFixed, with ties to even as in Python. @param {number} x @param {number} places */
function fixed(x, places) {
  const [cut, rest] = [x.toFixed(places + 30).slice(0, -30).replace(/\.$/, ""), x.toFixed(places + 30).slice(-30)];
  return /^50*$/.test(rest) && "02468".includes(cut.slice(-1)) ? cut : x.toFixed(places);
}

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
  return short(fixed(x, Math.max(digits - 1 - power, 0)));
}

/** @param {ArrayLike<number>} v @param {number} digits */
export const vectorText = (v, digits) => `(${Array.from(v, (x) => general(x, digits)).join(", ")})`;

/** As carom.formatting.format_number. @param {number} x @param {number} [digits] */
function numberText(x, digits = 3) {
  if (Number.isNaN(x)) return "–";
  if (!Number.isFinite(x)) return x > 0 ? "∞" : "−∞";
  const size = Math.abs(x);
  if (x !== 0 && !(size >= 1e-3 && size < 1e7)) return general(x, digits - 1);
  const places = x === 0 ? digits : Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
  const text = fixed(x, places);
  return text.includes(".") ? text.replace(/\.?0+$/, "") : text;
}

/** A length in m as text in m, mm or µm. @param {number} x @param {number} [digits] */
function lengthText(x, digits = 3) {
  const size = Math.abs(x);
  if (size >= 1) return `${numberText(x, digits)} m`;
  return size >= 1e-3 ? `${numberText(x * 1e3, digits)} mm` : `${numberText(x * 1e6, digits)} µm`;
}

/** A number of a scene; "inf" is infinity. @param {unknown} value @returns {number} */
export function extended(value) {
  if (value === "inf") return Infinity;
  if (value === "-inf") return -Infinity;
  return typeof value === "number" ? value : NaN;
}

/** A number as Python's repr; a whole one has ".0" where it is known to be a float. @param {number} x @param {boolean} float */
function numberRepr(x, float) {
  if (!Number.isFinite(x)) return general(x, 6);
  const [head, power] = x.toExponential().split("e").map(String);
  if (x !== 0 && (Number(power) < -4 || Number(power) >= 16)) return `${head}e${power[0]}${power.slice(1).padStart(2, "0")}`;
  return Number.isInteger(x) && float ? `${x}.0` : String(x);
}

/** As Python's repr of what JSON holds. @param {any} value @param {boolean} [float] whether numbers are floats @returns {string} */
export function repr(value, float = false) {
  if (value === null || value === undefined) return "None";
  if (typeof value === "boolean") return value ? "True" : "False";
  if (typeof value === "number" || !Number.isNaN(extended(value))) return numberRepr(extended(value), float);
  if (Array.isArray(value)) return `[${value.map((one) => repr(one, float)).join(", ")}]`;
  if (typeof value === "object") return `{${Object.entries(value).map(([name, one]) => `'${name}': ${repr(one, float)}`).join(", ")}}`;
  const text = JSON.stringify(value);
  return text.includes("'") ? text : `'${text.slice(1, -1).replaceAll('\\"', '"')}'`;
}

const LONGEST_SHOWN = 80;

/** What a user has given, in a message. @param {unknown} value @returns {string} */
export function shown(value) {
  if (value === undefined) return "nothing";
  try {
    const text = repr(value);
    return text.length > LONGEST_SHOWN ? `${text.slice(0, LONGEST_SHOWN - 3)}...` : text;
  } catch {
    return String(value); // (what refers to itself)
  }
}

/** A text with values in its places (carom.scene.ruled.FaultText). @param {string} text @param {Record<string, any>} values @param {string[]} [pockets] */
export function fill(text, values, pockets = []) {
  return text.replace(/\{([^}:]*):?([^}]*)\}/g, (_, path, how) => {
    const value = path.split(".").reduce((/** @type {any} */ of, /** @type {string} */ name) => of[name], values);
    if (how === "pocket") return pockets[value];
    if (how === "s") return value;
    if (how === "m") return lengthText(extended(value));
    if (how === "v") return vectorText(value.map((/** @type {number} */ x) => (Math.abs(x) > 1e-12 ? x : 0)), 6);
    return how === "" ? repr(value, true) : general(extended(value), Number(how.slice(1, -1)) || 6);
  });
}

/** A fault with its values; `at`: the part that it is about. @param {import("./types.js").FaultText} text @param {Record<string, any>} values @param {string} [at] @param {string[]} [pockets] */
export function filled(text, values, at = "", pockets = []) {
  const [field, expected, got, advice] = [text.field, text.expected, text.got, text.advice].map((one) => fill(one, values, pockets));
  return `${[at, field].filter(Boolean).join(".")}: expected ${expected}${got && `, got ${got}`}${advice && `; ${advice}`}`;
}
