// Elements with text; nothing here reads HTML.

/**
 * @template {keyof HTMLElementTagNameMap} K
 * @param {K} tag @param {Record<string, string | boolean | ((event: any) => void)>} [attributes] @param {...(Node | string)} children
 * @returns {HTMLElementTagNameMap[K]}
 */
export function el(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") made.addEventListener(name, value);
    else if (value === true) made.setAttribute(name, "");
    else if (value !== false) made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}

/** @param {string} tag @param {Record<string, string | number>} [attributes] @param {...(Node | string)} children */
export function svg(tag, attributes = {}, ...children) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, String(value));
  made.append(...children);
  return made;
}

/** @param {string} id @returns {HTMLElement} */
export function byId(id) {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no element ${id}`);
  return found;
}

/** A number of about `digits` digits, for people. @param {number | null | undefined} value @param {number} [digits] */
export function shown(value, digits = 3) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (value === Infinity) return "∞";
  if (value === -Infinity) return "−∞";
  if (Math.abs(value) < 1e-9) return "0";
  const text = Math.abs(value) >= 10 ** digits ? value.toFixed(0) : String(Number(value.toPrecision(digits)));
  return text.replace("-", "−");
}

/** A length with a fitting unit. @param {number} metres */
export function lengthText(metres) {
  const size = Math.abs(metres);
  if (size < 1e-9) return "0 mm";
  if (size < 1e-3) return `${shown(metres * 1e6)} µm`;
  return size < 1 ? `${shown(metres * 1e3)} mm` : `${shown(metres)} m`;
}

/** A time with a fitting unit. @param {number} seconds */
export const timeText = (seconds) => (seconds !== 0 && Math.abs(seconds) < 0.1 ? `${shown(seconds * 1e3)} ms` : `${seconds.toFixed(3)} s`);
