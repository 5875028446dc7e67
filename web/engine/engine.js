// carom's own engine: the event loop and the laws of impact that Python runs, as WebAssembly.

/** @import { Scene } from "../state/types.js" */
/** @import { Law, Layout, Limits, Run } from "./types.js" */
/** @import { Module } from "./module.js" */
import { loadModule } from "./module.js";
import { runScene } from "./run.js";

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
   * Simulate a scene. Throws an Error, a sentence, for a scene that is none.
   * @param {Scene} scene as `carom scene check FILE --json` prints it
   * @param {string} [law] put at all walls in place of the scene's
   * @param {Limits} [limits] at most so many events (default: 2000), the end in s (default: the scene's), at most so many milliseconds
   * @returns {Run}
   */
  run(scene, law, limits = {}) {
    return runScene(this.module, law === undefined ? scene : withLaw(scene, law), limits);
  }
}

/** The scene with one law at all walls. @param {Scene} scene @param {string} law @returns {Scene} */
export const withLaw = (scene, law) => ({
  ...scene,
  run: { ...scene.run, law },
  walls: scene.walls.map((wall) => ({ ...wall, law: null })),
});
