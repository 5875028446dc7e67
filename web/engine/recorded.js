// A run that was computed before the page was written: its law is not in the module, or it is too long to run while one looks. Its log
// of events is in the page, and the motion between them is computed from it as from the module's own.

/** @import { Scene } from "../state/types.js" */
/** @import { Layout, Recording, Run } from "./types.js" */
import { Engine } from "./engine.js";
import { loadModule } from "./module.js";
import { reportOf } from "./report.js";
import { runOf } from "./run.js";
import { setUp } from "../scene/setup.js";

/** @param {Uint8Array} wasm @param {Layout} layout @param {Scene} scene @param {Recording} record @returns {Promise<Recorded>} */
export async function loadRecorded(wasm, layout, scene, record) {
  return new Recorded(await loadModule(wasm, layout), scene, await unpacked(record.log), record);
}

/** @param {string} log base64 of gzip @returns {Promise<Uint8Array>} */
async function unpacked(log) {
  if (typeof DecompressionStream === "undefined") throw new Error("This browser cannot unpack the run in this page: any browser since May 2023 can.");
  const bytes = Uint8Array.from(atob(log), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

export class Recorded extends Engine {
  /** @param {import("./module.js").Module} module @param {Scene} scene @param {Uint8Array} log @param {Recording} record */
  constructor(module, scene, log, record) {
    super(module);
    const { memory, layout } = module;
    memory.clear();
    // (walls have met the balls already: neither they nor their laws are needed)
    const made = setUp({ ...scene, walls: [] }, module);
    const world = memory.records(layout.records.world, [made.world]);
    const balls = memory.records(layout.records.balls, made.balls);
    const at = memory.take(log.length);
    new Uint8Array(memory.memory.buffer, at, log.length).set(log);
    const logs = [{ at, rows: log.length / layout.records.log.bytes }];
    /** @type {Run} */
    this.found = runOf(module, scene, { world, balls, logs, status: record.status, end: record.end });
    this.why = record.why;
    this.scene = scene;
  }

  /** @override @returns {string[]} */
  faults() {
    return [];
  }

  /** @override @returns {Run} */
  run() {
    return this.found;
  }

  /** @override */
  report() {
    return reportOf(this.scene, this.found);
  }

  /** @override @param {Scene} scene */
  meeting(scene) {
    try {
      return super.meeting(scene);
    } catch {
      throw new Error(this.why);
    }
  }
}
