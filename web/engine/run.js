// A run of a scene: the event loop is the module's; here its log becomes events, pieces of motion, and final states.

/** @import { Scene, Vec } from "../state/types.js" */
/** @import { Limits, LoggedEvent, Piece, Run } from "./types.js" */
/** @import { Module } from "./module.js" */
import { setUp } from "../scene/setup.js";
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

/** Run the event loop on a scene. @param {Module} module @param {Scene} scene @param {Limits} limits @returns {Followed} */
export function follow(module, scene, limits) {
  const { memory, layout } = module;
  const { records, run: status } = layout;
  memory.clear();
  const made = setUp(scene, layout, module.address("rim"));
  const count = made.balls.length;
  const world = memory.records(records.world, [made.world]);
  const features = memory.records(records.features, made.features);
  const balls = memory.records(records.balls, made.balls);
  const users = memory.take(8 * Math.max(made.called.length, 1));
  made.called.forEach((law, i) => memory.putWhole(users + 8 * i, module.address(law.function)));
  const out = memory.take(64);

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
      "run", out, world, 1, features, made.features.length, balls, count, log, room, slow, until, step, users, made.called.length,
      status.all,
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

/** @param {Module} module @param {Scene} scene @param {Limits} limits @returns {Run} */
export function runScene(module, scene, limits) {
  const followed = follow(module, scene, limits);
  const { status, code, balls, atFault } = followed;
  return { ...runOf(module, scene, followed), why: status === "refused" ? refusal(module, scene, code, balls, atFault) : "" };
}

/** Events, pieces of motion and final states from what a log holds; its first rows are the balls' starts. @param {Module} module @param {Scene} scene @param {Pick<Followed, "world" | "balls" | "logs" | "status" | "end">} followed @returns {Run} */
export function runOf(module, scene, { world, balls, logs, status, end }) {
  const found = readLog(module, logs);
  /** @type {LoggedEvent[][]} */
  const perBall = scene.balls.map(() => []);
  for (const row of found) perBall[row.ball].push(row);
  const bytes = module.layout.records.balls.bytes;
  const open = status === "quiet" ? Infinity : end; // where nothing more happens, the last motion goes on
  return {
    status,
    why: "",
    until: end,
    events: found.slice(perBall.length),
    final: finalStates(module, world, balls, perBall, end),
    balls: perBall.map((rows, i) => ({ pieces: pieces(module, world, balls + i * bytes, rows, open) })),
  };
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

/** Records of one ball in the states of rows. @param {Module} module @param {number} ball @param {LoggedEvent[]} rows @returns {number} */
function ballsIn(module, ball, rows) {
  const { memory, layout } = module;
  const record = layout.records.balls;
  const at = memory.take(record.bytes * Math.max(rows.length, 1));
  const size = record.bytes / 8;
  const [x, v, w, clock] = ["x", "v", "w", "clock"].map((name) => record.fields[name].at / 8);
  const phase = record.fields.phase.at;
  const codes = new Map(layout.phases.map((name, code) => [name, code]));
  const numbers = memory.doubles;
  let one = at / 8;
  for (const row of rows) {
    numbers.copyWithin(one, ball / 8, ball / 8 + size);
    for (let k = 0; k < 3; k++) {
      numbers[one + x + k] = row.x[k];
      numbers[one + v + k] = row.v[k];
      numbers[one + w + k] = row.w[k];
    }
    numbers[one + clock] = 0;
    memory.putWhole(8 * one + phase, codes.get(row.phase) ?? 0);
    one += size;
  }
  return at;
}

/** @param {string} phase */
const gone = (phase) => phase === "held" || phase === "left" || phase === "pocketed";

const PIECE = 0.05; // s: a ball whose acceleration decays is drawn by parabolas so short, 1e-7 m from its path

/** Rows with more in between where the acceleration of a ball decays. @param {Module} module @param {number} world @param {number} ball @param {LoggedEvent[]} rows @param {number} end @returns {LoggedEvent[]} */
function withPartsOf(module, world, ball, rows, end) {
  const { memory, layout } = module;
  const record = layout.records.balls;
  const at = ballsIn(module, ball, rows);
  module.call("begin", 0, world, 1, at, rows.length);
  const decays = memory.field(record, "decays");
  const [x, v, w] = ["x", "v", "w"].map((name) => memory.field(record, name));
  return rows.flatMap((row, i) => {
    const lasts = (rows[i + 1]?.t ?? end) - row.t;
    if (decays(at + i * record.bytes) === 0 || gone(row.phase) || !(lasts > PIECE && lasts < Infinity)) return [row];
    const parts = Array.from({ length: Math.ceil(lasts / PIECE) }, (_, k) => k * PIECE);
    const first = ballsIn(module, ball, parts.map(() => row));
    module.call("states", 0, world, 1, first, parts.length, memory.put(parts), parts.length);
    const places = parts.map((_, k) => first + k * record.bytes);
    return places.map((one, k) => (k === 0 ? row : { ...row, t: row.t + parts[k], x: x(one), v: v(one), w: w(one) }));
  });
}

/** The motion between events, in closed form. @param {Module} module @param {number} world @param {number} ball @param {LoggedEvent[]} events @param {number} end @returns {Piece[]} */
function pieces(module, world, ball, events, end) {
  const { memory, layout } = module;
  const rows = withPartsOf(module, world, ball, events, end);
  const record = layout.records.balls;
  const at = ballsIn(module, ball, rows);
  module.call("begin", 0, world, 1, at, rows.length);
  const [acc, turn] = [memory.field(record, "acc"), memory.field(record, "turn")];
  /** @type {Piece[]} */
  const found = [];
  rows.forEach((row, i) => {
    const next = rows[i + 1];
    const lasts = (next?.t ?? end) - row.t;
    if (!(lasts > 0) && next !== undefined) return;
    const one = at + i * record.bytes;
    /** @type {Piece} */
    const piece = { t: row.t, lasts, x: row.x, v: row.v, w: row.w, acc: acc(one), turn: turn(one), phase: row.phase };
    if (gone(row.phase)) Object.assign(piece, { v: [0, 0, 0], acc: [0, 0, 0], turn: [0, 0, 0] });
    if (row.phase === "bouncing") Object.assign(piece, along(module, world, one, lasts, row.x));
    found.push(...untilSpinEnds(piece));
  });
  return found;
}

/** The spin about the vertical fades, and stays at zero: a piece in which it ends becomes two. @param {Piece} piece @returns {Piece[]} */
function untilSpinEnds(piece) {
  const { t, lasts, x, v, w, acc, turn } = piece;
  const s = -w[2] / turn[2];
  if (!(s > 0 && s < lasts)) return [piece];
  /** @param {Vec} p @param {Vec} rate @param {Vec} [bend] @returns {Vec} */
  const later = (p, rate, bend = [0, 0, 0]) => [
    p[0] + rate[0] * s + (bend[0] * s * s) / 2,
    p[1] + rate[1] * s + (bend[1] * s * s) / 2,
    p[2] + rate[2] * s + (bend[2] * s * s) / 2,
  ];
  const [wx, wy] = later(w, turn);
  const second = { ...piece, t: t + s, lasts: lasts - s, x: later(x, v, acc), v: later(v, acc) };
  return [{ ...piece, lasts: s }, { ...second, w: [wx, wy, 0], turn: [turn[0], turn[1], 0] }];
}

/** Bounces too low to see, as the straight line from the first to the last. @param {Module} module @param {number} world @param {number} ball @param {number} lasts @param {Vec} x */
function along(module, world, ball, lasts, x) {
  const { memory, layout } = module;
  if (!(lasts > 0)) return { v: [0, 0, 0], acc: [0, 0, 0] };
  module.call("states", 0, world, 1, ball, 1, memory.put([lasts]), 1);
  const y = memory.field(layout.records.balls, "x")(ball);
  return { v: [(y[0] - x[0]) / lasts, (y[1] - x[1]) / lasts, 0], acc: [0, 0, 0] };
}

/** @param {Module} module @param {number} world @param {number} balls @param {LoggedEvent[][]} perBall @param {number} end */
function finalStates(module, world, balls, perBall, end) {
  const { memory, layout } = module;
  const record = layout.records.balls;
  return perBall.map((rows, i) => {
    const row = rows[rows.length - 1];
    if (gone(row.phase)) return { x: row.x, v: row.v, w: row.w, phase: row.phase };
    const one = ballsIn(module, balls + i * record.bytes, [row]);
    module.call("states", 0, world, 1, one, 1, memory.put([end - row.t]), 1);
    const [x, v, w] = ["x", "v", "w"].map((name) => memory.field(record, name)(one));
    return { x, v, w, phase: row.phase };
  });
}

/** Why a law has no answer, as carom.simulate says it. @param {Module} module @param {Scene} scene @param {number} code @param {number} balls @param {number} i */
function refusal(module, scene, code, balls, i) {
  const { memory, layout } = module;
  const at = balls + i * layout.records.balls.bytes;
  const [t, x] = ["clock", "x"].map((name) => memory.field(layout.records.balls, name)(at));
  const name = scene.balls[i].name ?? `ball ${i}`;
  return `${name}: expected an event that its law has an answer for, got one at t = ${general(t, 6)} s, x = ${vectorText(x, 4)}: ${layout.refusals[code]}`;
}
