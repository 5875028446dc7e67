// The WebAssembly module: its functions, its memory, and what engine.json says of both.

/** @import { Layout } from "./types.js" */
import { askOf } from "../scene/shapes.js";
import { Memory } from "./memory.js";

export class Module {
  /** @param {WebAssembly.Instance} instance @param {Layout} layout */
  constructor(instance, layout) {
    /** @type {any} */
    const exports = instance.exports;
    this.exports = exports;
    this.layout = layout;
    this.memory = new Memory(exports.memory, exports.__heap_base.value);
  }

  /** Call a function of the module; its results are written to `out`. @param {string} name @param {number} out @param {...number} rest */
  call(name, out, ...rest) {
    this.exports[name](out, ...rest);
  }

  /** Rows of numbers that a function writes, as many as it has; it is given lists, tables, numbers, and addresses with counts.
   * @param {string} name @param {(number | number[] | {rows: number[][], columns: number})[]} given @param {number} columns @param {number} room @returns {number[][]} */
  rows(name, given, columns, room) {
    const { memory } = this;
    const top = memory.top;
    const taken = given.flatMap((one) => {
      if (typeof one === "number") return one;
      return Array.isArray(one) ? [memory.put(one), one.length] : [memory.put(one.rows.flat()), one.rows.length, one.columns];
    });
    const [out, rows] = [memory.take(8), memory.take(8 * columns * room)];
    this.call(name, out, ...taken, rows, room, columns);
    const count = memory.words[out / 4];
    const found = Array.from({ length: Math.min(count, room) }, (_, i) => memory.numbers(rows + 8 * columns * i, columns));
    memory.top = top;
    return count > room ? this.rows(name, given, columns, count) : found;
  }

  /** By which compiled code calls a function. @param {string} name @returns {number} */
  address(name) {
    return this.exports[`address_of_${name}`]();
  }
}

/** Compile a module; throws a sentence where it cannot be, or is not that of the layout. @param {Uint8Array} wasm @param {Layout} layout @returns {Promise<Module>} */
export async function loadModule(wasm, layout) {
  if (typeof WebAssembly === "undefined") throw new Error("expected a browser with WebAssembly, got one without; any browser of the last years has it");
  const bytes = new Uint8Array(wasm);
  const compiled = await WebAssembly.compile(bytes).catch((error) => {
    throw new Error(`engine.wasm: expected carom's module, got one that the browser refuses: ${error.message}`);
  });
  const [section] = WebAssembly.Module.customSections(compiled, "carom");
  const version = section === undefined ? "none" : new TextDecoder().decode(section);
  if (version !== layout.version) {
    throw new Error(`engine.wasm: expected the module of version ${layout.version}, got version ${version}; build both anew with make wasm`);
  }
  const module = new Module(await WebAssembly.instantiate(compiled), layout);
  askOf(module);
  return module;
}
