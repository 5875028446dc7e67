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
