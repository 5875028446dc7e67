// Files that the page writes (scene, events) and reads (measured rebounds). What is read is shown as text, never as HTML.

/** @import { Happening, Rebound, Restitution, Run, Scene } from "./types.js" */
import { csvFormatRows, csvParseRows, dsvFormat, tsvParseRows } from "d3-dsv";
import { stringify } from "smol-toml";
import { pocketsOf } from "../scene/shapes.js";

/** @param {unknown} value @returns {any} */
function forToml(value) {
  if (value === "inf") return Infinity;
  if (value === "-inf") return -Infinity;
  if (Array.isArray(value)) return value.map(forToml);
  if (value && typeof value === "object") {
    const form = /** @type {Restitution} */ (value);
    if (form.form === "constant" && "value" in form) return form.value; // a plain number stands for it
    return Object.fromEntries(Object.entries(value).filter(([, one]) => one !== null && one !== undefined).map(([key, one]) => [key, forToml(one)]));
  }
  return value;
}

/** A scene file that carom simulate runs. @param {Scene} scene */
export function sceneToml(scene) {
  const balls = scene.balls.map(({ spin, spin_z, rolling, ...ball }) => ({ ...ball, rolling, ...(rolling ? { spin_z } : { spin }) }));
  // (all that a preset fills is there)
  const walls = scene.walls.map((wall) => ({ ...wall, preset: null }));
  const table = forToml({ ...scene, walls, balls });
  return `# A scene of carom: carom simulate FILE, carom explore FILE. SI units.\n${stringify(table, { numbersAsFloat: false })}`;
}

const AXES = ["x", "y", "z"];

/** The events of a run with the columns of `carom simulate --table`. @param {Scene} scene @param {Run} run */
export function eventsCsv(scene, run) {
  const vectors = (/** @type {string} */ name, after = "") => AXES.map((axis) => `${name}${axis}${after}`);
  const header = ["t", "kind", "ball", "name", "other", "phase", ...AXES, ...vectors("v", "_before"), ...vectors("w", "_before"), ...vectors("v"), ...vectors("w"), "required_friction"];
  const rows = run.events.map((event) => [
    event.t, event.kind, event.ball, scene.balls[event.ball].name ?? `ball ${event.ball}`, event.other ?? -1, event.phase, ...event.x, ...(event.v_before ?? []), ...(event.w_before ?? []), ...event.v,
    ...event.w, event.required ?? "",
  ]);
  return csvFormatRows([header, ...rows].map((row) => row.map(String)));
}

/** How a sentence calls a ball. @param {Scene} scene @param {number} i */
export const nameOf = (scene, i) => (scene.balls[i]?.name ?? String(i)).replace(/^\d+$/, "ball $&");
/** @param {Scene} scene @param {number} i */
export const wallName = (scene, i) => scene.walls[i]?.name ?? `${scene.walls[i]?.shape ?? "wall"} ${i}`;

/** The names of all pockets, wall by wall, as carom.Scene.pocket_names. @param {Scene} scene @returns {string[]} */
export function pocketNames(scene) {
  return scene.walls.flatMap((wall) => pocketsOf(wall).map(({ name }) => name));
}

/** @type {Record<string, string>} */
const HAPPENS = {
  wall: "meets", ball: "meets", floor: "lands", rolling: "rolls", sliding: "slides", pivoting: "spins on the spot", rest: "comes to rest",
  settled: "bounces no more", left: "clears", held: "is held", pocketed: "falls into the", flight: "flies", bouncing: "bounces", start: "starts",
};

/** What happens at an event, in words. @param {Scene} scene @param {Happening} event */
export function eventText(scene, event) {
  const other = event.other ?? 0;
  const names = { ball: () => nameOf(scene, other), wall: () => wallName(scene, other), left: () => wallName(scene, other), pocketed: () => pocketNames(scene)[other] };
  const met = names[/** @type {keyof typeof names} */ (event.kind)]?.() ?? "";
  return `${nameOf(scene, event.ball)} ${HAPPENS[event.kind] ?? event.kind} ${met}`.trim();
}

// --- measured rebounds ----------------------------------------------------------------------------------------------

const LARGEST_FILE = 5e6; // characters
const MOST_ROWS = 20_000;
/** @type {Record<string, number>} */
const SPEEDS = { m_s: 1, cm_s: 0.01, mm_s: 0.001, km_h: 1 / 3.6, ft_s: 0.3048, in_s: 0.0254, mph: 0.44704 };
const NEEDED = ["v_n_in", "v_t_in", "v_n_out", "v_t_out"];

/** Which speed a column holds, and its unit. @param {string} header @returns {{name: string, factor: number} | null} */
function columnOf(header) {
  const text = header.trim().toLowerCase();
  const bracket = /^(.*?)\s*[[(]([^\])]*)[\])]$/.exec(text);
  const plain = (bracket ? bracket[1] : text).trim().replaceAll(" ", "_").replace(/^v([nt])_/, "v_$1_").replace(/_derived$/, "");
  for (const name of NEEDED) {
    if (bracket && plain === name) {
      const factor = SPEEDS[bracket[2].trim().replace("/", "_")];
      if (factor === undefined) throw new Error(`Column ${JSON.stringify(header)}: expected a unit of speed, such as m/s or mm/s.`);
      return { name, factor };
    }
    if (plain === name) return { name, factor: 1 };
    if (plain.startsWith(`${name}_`) && SPEEDS[plain.slice(name.length + 1)] !== undefined) return { name, factor: SPEEDS[plain.slice(name.length + 1)] };
  }
  return null;
}

/**
 * Read measured rebounds from a CSV file with the columns of `carom fit`: v_n_in, v_t_in, v_n_out, v_t_out (m/s, or with a
 * unit: v_n_in_mm_s, "v_n_in [mm/s]"), and stage. Throws an Error, a sentence, for any other file.
 * @param {string} text
 * @returns {Rebound[]}
 */
export function readRebounds(text) {
  if (text.length > LARGEST_FILE) throw new Error("This file is too large for the page: expected at most 5 MB.");
  if (text.includes("\0")) throw new Error("This file holds no text: expected a CSV table of rebounds.");
  const first = text.slice(0, text.search(/\r?\n|$/));
  const semicolons = !first.includes(",") && first.includes(";");
  const parse = semicolons ? (/** @type {string} */ t) => dsvFormat(";").parseRows(t) : first.includes("\t") && !first.includes(",") ? tsvParseRows : csvParseRows;
  const rows = parse(text.replace(/^\uFEFF/, "")).filter((row) => row.some((cell) => cell.trim()));
  if (rows.length < 2) throw new Error("Expected a table of rebounds with a header and at least one row.");
  if (rows.length > MOST_ROWS) throw new Error(`Expected at most ${MOST_ROWS} rows, got ${rows.length - 1}; carom fit takes more.`);
  /** @type {Map<string, {at: number, factor: number}>} */
  const columns = new Map();
  let stage = -1;
  rows[0].forEach((header, at) => {
    if (header.trim().toLowerCase() === "stage") stage = at;
    const found = columnOf(header);
    if (found) columns.set(found.name, { at, factor: found.factor });
  });
  const missing = NEEDED.filter((name) => !columns.has(name));
  if (missing.length) {
    throw new Error(`Expected a table of rebounds, with the columns ${NEEDED.join(", ")}; this one lacks ${missing.join(", ")}.`);
  }
  /** @type {Rebound[]} */
  const found = [];
  rows.slice(1).forEach((row, i) => {
    const [nIn, tIn, nOut, tOut] = NEEDED.map((name) => {
      const { at, factor } = /** @type {{at: number, factor: number}} */ (columns.get(name));
      const cell = (row[at] ?? "").trim();
      if (!cell) return NaN; // not measured
      const value = Number(semicolons ? cell.replace(",", ".") : cell);
      if (!Number.isFinite(value)) throw new Error(`Row ${i + 1}, ${name}: expected a number, got ${JSON.stringify(cell.slice(0, 30))}.`);
      return value * factor;
    });
    // angles from the wall's normal, mirrored so that the ball comes from the positive side
    const side = tIn < 0 ? -1 : 1;
    const incidence = (Math.atan2(side * tIn, nIn) * 180) / Math.PI;
    const reflection = (Math.atan2(side * tOut, nOut) * 180) / Math.PI;
    if (Number.isFinite(incidence) && Number.isFinite(reflection)) found.push({ incidence, reflection, stage: stage < 0 ? "" : (row[stage] ?? "").trim().slice(0, 20) });
  });
  if (!found.length) throw new Error("Expected rows with all four speeds, got none.");
  return found;
}
