// All that the page computes for a scene, by carom's own engine: a run, a verdict and a curve for each law.

/** @import { Meeting } from "../engine/meeting.js" */
/** @import { LawCard, Run, Scene, Verdict } from "./types.js" */
import { others } from "../engine/meeting.js";
import { eventText, nameOf } from "./files.js";

export const MOST_EVENTS = 2000;
const MOST_MILLISECONDS = 600; // of one change, for all laws together: a page that computes longer seems frozen
/** The card of a scene whose walls have laws of their own. */
export const AS_GIVEN = "as in the scene";

/**
 * @typedef {object} Engine
 * @property {(scene: Scene) => string[]} faults
 * @property {(scene: Scene, law?: string, limits?: {events?: number, until?: number, milliseconds?: number}) => Run} run
 * @property {(scene: Scene) => Meeting} meeting
 * @property {(meeting: Meeting, also: string[]) => Verdict[]} compareAt
 * @property {(meeting: Meeting) => number} incidenceAt
 * @property {(law: string, meeting: Meeting, incidences: number[]) => (number | null)[]} curveAt
 */

/** @typedef {{runs: Map<string, Run>, notes: Map<string, string>, fault: string | null}} Outcome */

/** @param {unknown} error */
export const sentence = (error) => (error instanceof Error ? error.message : String(error));

/** Return a scene, or throw an Error that says what is wrong with it. @param {Engine} engine @param {unknown} scene @returns {Scene} */
export function checked(engine, scene) {
  const faults = engine.faults(/** @type {Scene} */ (scene));
  if (faults.length) throw new Error(faults.slice(0, 3).join(". ") + (faults.length > 3 ? `. (${faults.length - 3} more)` : ""));
  return /** @type {Scene} */ (scene);
}

/** Run a scene under laws. @param {Engine} engine @param {Scene} scene @param {string[]} laws @returns {Outcome} */
export function runAll(engine, scene, laws) {
  /** @type {Outcome} */
  const found = { runs: new Map(), notes: new Map(), fault: null };
  for (const law of laws) {
    try {
      const run = engine.run(scene, law === AS_GIVEN ? undefined : law, { events: MOST_EVENTS, milliseconds: MOST_MILLISECONDS / laws.length });
      found.runs.set(law, run);
      const after = `after ${run.events.length} events, at ${Number(run.until.toPrecision(4))} s`;
      if (run.status === "refused") found.notes.set(law, run.why);
      const asked = run.events.length >= (scene.run.max_events ?? Infinity);
      if (!asked && (run.status === "limit" || run.status === "time")) found.notes.set(law, `The run is cut off ${after}: carom simulate goes on.`);
    } catch (error) {
      found.notes.set(law, sentence(error));
    }
  }
  // one law may refuse a scene; what all refuse is no scene
  if (laws.length && !found.runs.size) found.fault = [...found.notes.values()][0];
  return found;
}

/** The first ball at its first wall, and what each law says of it; `note`: which contact that is where it is not plain, or why there is none.
 * @typedef {{meeting: Meeting | null, verdicts: Map<string, Verdict>, note: string}} Compared */

/** @param {Engine} engine @param {Scene} scene @param {LawCard[]} cards @returns {Compared} */
export function comparedAt(engine, scene, cards) {
  try {
    const meeting = engine.meeting(scene);
    const found = engine.compareAt(meeting, cards.map(({ name }) => name));
    return { meeting, verdicts: new Map(found.map((verdict) => [verdict.law, verdict])), note: whichContact(scene, meeting) };
  } catch (error) {
    return { meeting: null, verdicts: new Map(), note: sentence(error) };
  }
}

/** Which contact the laws are compared at, where other balls come first. @param {Scene} scene @param {Meeting} meeting */
function whichContact(scene, { t, balls }) {
  if (balls === 0) return "";
  return `The laws are compared at the first wall that ${nameOf(scene, 0)} meets: at ${t.toFixed(3)} s of the scene's own run, after ${others(balls)}.`;
}

const INCIDENCES = Array.from({ length: 30 }, (_, i) => 1 + 3 * i);

/** Reflection against incidence. @param {Engine} engine @param {Meeting | null} meeting @param {string[]} laws @returns {Map<string, [number, number][]>} */
export function curvesOf(engine, meeting, laws) {
  const found = new Map();
  if (meeting === null) return found;
  for (const law of laws) {
    if (law === AS_GIVEN) continue;
    try {
      found.set(law, engine.curveAt(law, meeting, INCIDENCES).map((y, i) => [INCIDENCES[i], y ?? NaN]));
    } catch {
      // this law says nothing of such a ball
    }
  }
  return found;
}

/** The times between which the slider moves, s. @param {Scene} scene @param {Iterable<Run>} runs @param {[number, number] | null} asked @returns {{from: number, until: number}} */
export function horizon(scene, runs, asked) {
  if (asked) return { from: asked[0], until: asked[1] };
  let until = 0;
  for (const run of runs) {
    const last = run.events.at(-1)?.t ?? 0;
    const still = run.final.every(({ phase }) => phase === "rest" || phase === "pocketed");
    const whole = run.status === "done" || run.status === "quiet";
    until = Math.max(until, still || !whole ? last : last * 1.3 + 0.3);
  }
  const duration = scene.run.duration;
  return { from: 0, until: Math.max(1e-6, duration === null ? until || 1 : Math.min(until || duration, duration)) };
}

/** The events of a run that people step through; of two balls that meet, one is enough. @param {Scene} scene @param {Run | undefined} run */
export function steps(scene, run) {
  /** @type {{t: number, text: string}[]} */
  const found = [];
  for (const event of run?.events ?? []) {
    if (event.kind === "start" || (event.kind === "ball" && (event.other ?? 0) < event.ball)) continue;
    found.push({ t: event.t, text: eventText(scene, event) });
  }
  return found;
}

/** Laws of which the page has cards, and one more where the scene's walls have laws of their own. @param {LawCard[]} cards @param {Scene} scene @returns {LawCard[]} */
export function cardsFor(cards, scene) {
  const plain = cards.filter(({ name }) => name !== AS_GIVEN);
  if (!scene.walls.some((wall) => wall.law !== null && wall.law !== undefined)) return plain;
  const about = "Each wall with its own law.";
  return [{ name: AS_GIVEN, summary: about, valid: "", colour: "#777777", dashes: null, reads: null }, ...plain];
}
