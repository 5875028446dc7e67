// A run of a scene: the event loop is the module's; here its log becomes events, pieces of motion, and final states.

/** @import { Scene, Vec } from "../state/types.js" */
/** @import { Impact, Limits, LoggedEvent, Piece, Run, Start } from "./types.js" */
/** @import { Module } from "./module.js" */
import { setUp, spinOf } from "../scene/setup.js";
import { general, vectorText } from "./text.js";

const MOST_EVENTS = 2000;
const MOST_MILLISECONDS = 2000;
const SLICE = 256; // events between two looks at the clock
const FIRST_ROWS = 128;
const MOST_ROWS = 4096;

/** A part of the log. @typedef {{at: number, rows: number}} Part */

/**
 * What the event loop has written, by address.
 * @typedef {object} Followed
 * @property {number} world
 * @property {number} features
 * @property {number} balls
 * @property {Part[]} logs
 * @property {Run["status"]} status
 * @property {number} code how the loop ended
 * @property {number} end s: time up to which the balls were followed
 * @property {number} atFault the ball for which a law has no answer
 */

/** A scene in the memory, by address. @typedef {{world: number, features: number, count: number, balls: number, users: number, called: number, out: number}} Placed */

/** Write a scene into the memory, which is emptied. @param {Module} module @param {Scene} scene @returns {Placed} */
function place(module, scene) {
  const { memory, layout } = module;
  const { records } = layout;
  memory.clear();
  const made = setUp(scene, module);
  const world = memory.records(records.world, [made.world]);
  const features = memory.records(records.features, made.features);
  const balls = memory.records(records.balls, made.balls);
  const users = memory.take(8 * Math.max(made.called.length, 1));
  made.called.forEach((law, i) => memory.putWhole(users + 8 * i, module.address(law.function)));
  return { world, features, count: made.features.length, balls, users, called: made.called.length, out: memory.take(64) };
}

/** Run the event loop on a scene. @param {Module} module @param {Scene} scene @param {Limits} limits @returns {Followed} */
export const follow = (module, scene, limits) => followFrom(module, scene, place(module, scene), limits);

/** Run the event loop on a scene that is in the memory. @param {Module} module @param {Scene} scene @param {Placed} placed @param {Limits} limits @returns {Followed} */
function followFrom(module, scene, { world, features, count: walls, balls, users, called, out }, limits) {
  const { memory, layout } = module;
  const { records, run: status } = layout;
  const count = scene.balls.length;
  const until = limits.until ?? scene.run.duration ?? Infinity;
  const most = Math.min(limits.events ?? MOST_EVENTS, scene.run.max_events ?? Infinity);
  const deadline = performance.now() + (limits.milliseconds ?? MOST_MILLISECONDS);
  /** @type {Part[]} */
  const logs = [];
  let [slow, events, code, atFault, last, room] = [-1, 0, status.full, -1, 0, FIRST_ROWS + count];
  while (code === status.full) {
    const log = memory.take(room * records.log.bytes);
    const step = Math.min(most - events, SLICE);
    module.call(
      "run", out, world, 1, features, walls, balls, count, log, room, slow, until, step, users, called, status.all,
    );
    // (a tuple of four whole numbers and two numbers, 8 bytes each)
    const words = memory.words.subarray(out / 4);
    code = words[0];
    events += words[2];
    atFault = words[6];
    [slow, last] = memory.numbers(out + 32, 2);
    const part = { at: log, rows: words[4] };
    logs.push(part);
    room = Math.min(4 * room, MOST_ROWS);
    const enough = limits.enough?.(part);
    if (code === status.full && enough) code = status.limit;
    else if (code === status.limit && events < most && performance.now() < deadline && !enough) code = status.full;
  }
  /** @type {Record<number, Run["status"]>} */
  const known = { [status.done]: "done", [status.quiet]: "quiet", [status.limit]: events < most ? "time" : "limit" };
  const reached = known[code] ?? "refused";
  const found = reached === "done" && until === Infinity ? "quiet" : reached; // no end was asked for
  return { world, features, balls, logs, status: found, code, end: found === "done" ? until : last, atFault };
}

/**
 * The impacts of many runs of a scene, from other velocities and spins of one ball: the scene is read once.
 * @param {Module} module @param {Scene} scene @param {number} ball @param {Start[]} starts @param {Limits} limits @returns {Impact[][]}
 */
export function runMany(module, scene, ball, starts, limits) {
  const { memory, layout } = module;
  const { balls: record, log } = layout.records;
  const placed = place(module, scene);
  const [free, at] = [memory.top, placed.balls + ball * record.bytes];
  const before = new Uint8Array(memory.memory.buffer, placed.balls, scene.balls.length * record.bytes).slice();
  return starts.map(({ velocity, spin }) => {
    memory.top = free;
    new Uint8Array(memory.memory.buffer).set(before, placed.balls);
    const one = { ...scene.balls[ball], velocity, ...(spin && { spin, rolling: false }) };
    memory.set(record, at, "v", velocity);
    memory.set(record, at, "w", spinOf(one));
    const { logs } = followFrom(module, scene, placed, limits);
    const [t, met, own, other] = ["t", "met", "ball", "other"].map((name) => memory.field(log, name));
    return logs.flatMap(({ at: first, rows }) => {
      const found = [];
      for (let row = first; row < first + rows * log.bytes; row += log.bytes) {
        const what = layout.kinds[met(row)];
        if (what !== "nothing") found.push({ t: t(row), met: /** @type {Impact["met"]} */ (what), ball: own(row), other: other(row) });
      }
      return found;
    });
  });
}

/** @param {Module} module @param {Scene} scene @param {Limits} limits @returns {Run} */
export function runScene(module, scene, limits) {
  const followed = follow(module, scene, limits);
  const { status, code, balls, atFault } = followed;
  const why = status === "refused" ? refusal(module, scene, code, balls, atFault) : "";
  return { ...runOf(module, scene, followed), why };
}

/** Events, pieces of motion and final states from what a log holds; its first rows are the balls' starts. @param {Module} module @param {Scene} scene @param {Pick<Followed, "world" | "balls" | "logs" | "status" | "end">} followed @returns {Run} */
export function runOf(module, scene, { world, balls, logs, status, end }) {
  const { memory, layout } = module;
  const { balls: record, log } = layout.records;
  const found = readLog(module, logs);
  const open = status === "quiet" ? Infinity : end; // where nothing more happens, the last motion goes on
  const rows = logs.reduce((sum, part) => sum + part.rows, 0);
  const whole = logs.length === 1 ? logs[0].at : joined(module, logs, rows * log.bytes);
  const last = memory.take(72);
  const motions = scene.balls.map((_, i) => {
    // (a ball to work in, and the numbers that it ends with)
    const table = module.rows("pieces", [world, 1, balls + i * record.bytes, 1, whole, rows, i, open, end, last, 9], PIECE_COLUMNS, FIRST_ROWS);
    const [x, v, w] = [0, 3, 6].map((k) => /** @type {Vec} */ (memory.numbers(last + 8 * k, 3)));
    return { pieces: table.map((row) => pieceOf(row, layout.phases)), x, v, w };
  });
  const phase = (/** @type {number} */ i) => found.findLast((row) => row.ball === i)?.phase ?? "";
  return {
    status, why: "", until: end, events: found.slice(scene.balls.length), balls: motions.map(({ pieces }) => ({ pieces })),
    final: motions.map(({ x, v, w }, i) => ({ x, v, w, phase: phase(i) })),
  };
}

const PIECE_COLUMNS = 18; // as carom.explorer.entries writes them

/** @param {number[]} r @param {string[]} phases @returns {Piece} */
const pieceOf = (r, phases) => ({
  t: r[0], lasts: r[1], x: [r[2], r[3], r[4]], v: [r[5], r[6], r[7]], w: [r[8], r[9], r[10]], acc: [r[11], r[12], r[13]],
  turn: [r[14], r[15], r[16]], phase: phases[r[17]],
});

/** Parts of the log, one after the other. @param {Module} module @param {Part[]} logs @param {number} bytes @returns {number} their address */
function joined({ memory, layout }, logs, bytes) {
  let to = memory.take(bytes);
  const first = to;
  for (const { at, rows } of logs) {
    const size = rows * layout.records.log.bytes;
    new Uint8Array(memory.memory.buffer).copyWithin(to, at, at + size);
    to += size;
  }
  return first;
}

/** @param {Module} module @param {Part[]} logs @returns {LoggedEvent[]} */
function readLog(module, logs) {
  const { layout, memory } = module;
  const { kinds, phases, regimes, records } = layout;
  const names = /** @type {const} */ (["t", "kind", "ball", "met", "other", "x", "v_before", "w_before", "v", "w", "phase_before", "phase", "impulse", "floor_impulse", "required", "regime"]);
  const read = /** @type {Record<typeof names[number], (at: number) => any>} */ (
    Object.fromEntries(names.map((name) => [name, memory.field(records.log, name)]))
  );
  /** @type {LoggedEvent[]} */
  const found = [];
  for (const log of logs) {
    for (let i = 0; i < log.rows; i++) {
      const at = log.at + i * records.log.bytes;
      const phase = phases[read.phase(at)];
      const kind = kinds[read.kind(at)];
      const met = kinds[read.met(at)];
      const regime = read.regime(at);
      found.push({
        t: read.t(at),
        kind: kind === "phase" ? phase : kind, // the end of a phase has the name of the one that begins
        ball: read.ball(at),
        met: /** @type {"wall" | "ball" | "pocketed" | null} */ (met === "nothing" ? null : met),
        other: read.other(at),
        x: read.x(at),
        v_before: read.v_before(at),
        w_before: read.w_before(at),
        v: read.v(at),
        w: read.w(at),
        phase_before: phases[read.phase_before(at)],
        phase,
        impulse: read.impulse(at),
        floor_impulse: read.floor_impulse(at),
        required: read.required(at),
        regime: regime < 0 ? null : regimes[regime],
      });
    }
  }
  return found;
}

/** Why a law has no answer, as carom.simulate says it. @param {Module} module @param {Scene} scene @param {number} code @param {number} balls @param {number} i */
function refusal(module, scene, code, balls, i) {
  const { memory, layout } = module;
  const at = balls + i * layout.records.balls.bytes;
  const [t, x] = ["clock", "x"].map((name) => memory.field(layout.records.balls, name)(at));
  const name = scene.balls[i].name ?? `ball ${i}`;
  return `${name}: expected an event that its law has an answer for, got one at t = ${general(t, 6)} s, x = ${vectorText(x, 4)}: ${layout.refusals[code]}`;
}
