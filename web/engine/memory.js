// Records in the module's memory: places for them, writing and reading them.

/** @import { RecordLayout } from "./types.js" */
/** @import { Row } from "../scene/setup.js" */

const PAGE = 65536;
const MOST_BYTES = 256 * 1024 * 1024;

/** Memory of a module above what it uses itself, taken from below and given back all at once. */
export class Memory {
  /** @param {WebAssembly.Memory} memory @param {number} base */
  constructor(memory, base) {
    this.memory = memory;
    this.base = Math.ceil(base / 16) * 16;
    this.top = this.base;
    this.doubles = new Float64Array(memory.buffer);
    this.words = new Int32Array(memory.buffer);
  }

  clear() {
    this.top = this.base;
  }

  /** @param {number} bytes @returns {number} an address, of zeros */
  take(bytes) {
    const at = this.top;
    this.top = Math.ceil((at + bytes) / 16) * 16;
    if (this.top > MOST_BYTES) throw new Error("engine: expected a run that fits into 256 MB, got a larger one; ask for fewer events");
    const missing = this.top - this.memory.buffer.byteLength;
    if (missing > 0) this.memory.grow(Math.ceil(missing / PAGE));
    if (this.doubles.buffer !== this.memory.buffer) {
      this.doubles = new Float64Array(this.memory.buffer);
      this.words = new Int32Array(this.memory.buffer);
    }
    new Uint8Array(this.memory.buffer, at, this.top - at).fill(0);
    return at;
  }

  /** @param {ArrayLike<number>} numbers @returns {number} the address of doubles */
  put(numbers) {
    const at = this.take(8 * Math.max(numbers.length, 1));
    this.doubles.set(numbers, at / 8);
    return at;
  }

  /** @param {number} at @param {number} count @returns {number[]} */
  numbers(at, count) {
    return Array.from(this.doubles.subarray(at / 8, at / 8 + count));
  }

  /** @param {number} at @param {number} value as a whole number of 8 bytes */
  putWhole(at, value) {
    this.words[at / 4] = value;
    this.words[at / 4 + 1] = value < 0 ? -1 : 0;
  }

  /** Write records one after the other. @param {RecordLayout} layout @param {Row[]} rows @returns {number} their address */
  records(layout, rows) {
    const first = this.take(layout.bytes * Math.max(rows.length, 1));
    rows.forEach((row, i) => {
      for (const [name, value] of Object.entries(row)) this.set(layout, first + i * layout.bytes, name, value);
    });
    return first;
  }

  /** @param {RecordLayout} layout @param {number} at @param {string} name @param {number | boolean | number[]} value */
  set(layout, at, name, value) {
    const place = layout.fields[name];
    if (typeof value === "object") this.doubles.set(value, (at + place.at) / 8);
    else if (place.whole) this.putWhole(at + place.at, Number(value));
    else this.doubles[(at + place.at) / 8] = Number(value);
  }

  /** A reader of a field of records: a number, or a list of three. @param {RecordLayout} layout @param {string} name */
  field(layout, name) {
    const { at, count, whole } = layout.fields[name];
    /** @param {number} record @returns {any} */
    const one = (record) => (whole ? this.words[(record + at) / 4] : this.doubles[(record + at) / 8]);
    /** @param {number} record @returns {any} */
    const three = (record) => {
      const k = (record + at) / 8;
      const numbers = this.doubles;
      return [numbers[k], numbers[k + 1], numbers[k + 2]];
    };
    return count === 1 ? one : three;
  }
}
