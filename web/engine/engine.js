// carom's own engine: the event loop and the laws of impact that Python runs, as WebAssembly.

/** @import { Scene } from "../state/types.js" */
/** @import { Meeting } from "./meeting.js" */
/** @import { Impact, Law, Layout, Limits, Run, Start, Verdict } from "./types.js" */
/** @import { Module } from "./module.js" */
import { requireLaw, requireLimits, requireStarts } from "./arguments.js";
import { incidenceAt, reflections, verdicts } from "./compare.js";
import { firstMeeting } from "./meeting.js";
import { loadModule } from "./module.js";
import { reportOf } from "./report.js";
import { runMany, runScene } from "./run.js";
import { sceneFaults } from "../scene/check.js";
import { isTable } from "../scene/fields.js";

/** Compile the module. @param {Uint8Array} wasm engine.wasm @param {Layout} layout engine.json @returns {Promise<Engine>} */
export async function loadEngine(wasm, layout) {
  return new Engine(await loadModule(wasm, layout));
}

export class Engine {
  /** @param {Module} module */
  constructor(module) {
    this.module = module;
    /** The hash of the kernels' sources. */
    this.version = module.layout.version;
    /** @type {Law[]} */
    this.laws = module.layout.laws;
  }

  /**
   * All that is wrong with a scene, one line per problem: its fields and their bounds, overlaps, what its laws need.
   * @param {Scene} scene
   * @returns {string[]}
   */
  faults(scene) {
    return sceneFaults(this.module, scene);
  }

  /**
   * Simulate a scene. Throws an Error, one line per problem, for one that cannot be run.
   * @param {Scene} scene as `carom scene check FILE --json` prints it
   * @param {string} [law] put at all walls in place of the scene's
   * @param {Limits} [limits] at most so many events (default: 2000), the end in s (default: the scene's), at most so many milliseconds
   * @returns {Run}
   */
  run(scene, law, limits = {}) {
    requireLimits(limits);
    if (law !== undefined) requireLaw(law, this.laws);
    return runScene(this.module, this.checked(law === undefined ? scene : withLaw(scene, law)), limits);
  }

  /**
   * A run in the form of `carom simulate --json`; the same arguments as of `run`.
   * @param {Scene} scene
   * @param {string} [law]
   * @param {Limits} [limits]
   */
  report(scene, law, limits = {}) {
    return reportOf(scene, this.run(scene, law, limits));
  }

  /**
   * The impacts of many shots of one ball, for a search among them: what `run` finds of walls, balls and pockets.
   * @param {Scene} scene
   * @param {Start[]} starts a velocity, m/s, and a spin, rad/s (default: of a ball that rolls, or the ball's own)
   * @param {{ball?: number, law?: string} & Limits} [options] the ball that is shot (default: the first); a law, and limits of each run, as `run` takes them
   * @returns {Impact[][]}
   */
  shots(scene, starts, { ball = 0, law, ...limits } = {}) {
    requireLimits(limits);
    if (law !== undefined) requireLaw(law, this.laws);
    const checked = this.checked(law === undefined ? scene : withLaw(scene, law));
    requireStarts(starts, ball, checked.balls.length);
    return runMany(this.module, checked, ball, starts, limits);
  }

  /** @param {Scene} scene @returns {Scene} */
  checked(scene) {
    const faults = this.faults(scene);
    if (faults.length > 0) throw new Error(faults.join("\n"));
    return scene;
  }

  /**
   * What `carom compare` says of the first ball at the first wall, for each law that it lists; laws of cushions that it does not list, by name.
   * @param {Scene} scene
   * @param {string[]} [also]
   * @returns {Verdict[]}
   */
  compare(scene, also = []) {
    return this.compareAt(this.meeting(scene), also);
  }

  /** The same of a meeting. @param {Meeting} meeting @param {string[]} [also] @returns {Verdict[]} */
  compareAt(meeting, also = []) {
    return verdicts(this.module, meeting, also);
  }

  /** The angle of incidence of a meeting, degrees. @param {Meeting} meeting */
  incidenceAt(meeting) {
    return incidenceAt(this.module, meeting);
  }

  /** The first ball just before the first wall. @param {Scene} scene @returns {Meeting} */
  meeting(scene) {
    return firstMeeting(this.module, this.checked(scene));
  }

  /**
   * The angle of reflection, degrees, for each angle of incidence, degrees: the first ball at the first wall, its velocity and spin
   * turned about the vertical. Null where the law has no answer.
   * @param {string} law
   * @param {Scene} scene
   * @param {number[]} incidences
   * @param {"final" | "wall"} [stage] once the ball rolls again, or just after the wall
   */
  curve(law, scene, incidences, stage = "final") {
    return this.curveAt(law, this.meeting(scene), incidences, stage);
  }

  /** The same of a meeting. @param {string} law @param {Meeting} meeting @param {number[]} incidences @param {"final" | "wall"} [stage] */
  curveAt(law, meeting, incidences, stage = "final") {
    requireLaw(law, this.laws);
    const found = /** @type {Law} */ (this.laws.find((one) => one.name === law));
    return reflections(this.module, found, meeting, incidences, stage);
  }
}

/** Whether something has walls and a run whose law can be replaced: of anything else a check says what is wrong. @param {unknown} scene */
const hasWalls = (scene) => isTable(scene) && isTable(scene.run) && Array.isArray(scene.walls) && scene.walls.every(isTable);

/** The scene with one law at all walls. @param {Scene} scene @param {string} law @returns {Scene} */
export const withLaw = (scene, law) =>
  hasWalls(scene) ? { ...scene, run: { ...scene.run, law }, walls: scene.walls.map((wall) => ({ ...wall, law: null })) } : scene;
