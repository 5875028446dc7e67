// What the page shows now, who wants to know when it changes, and the way back.

/** @import { Film, Scene, Rebound, LawCard } from "./types.js" */

/**
 * @typedef {object} State
 * @property {Scene} scene
 * @property {Film} film
 * @property {string} shot name of the preset that the film is of
 * @property {string[]} laws names of the laws that are shown
 * @property {string} followed the law whose balls are drawn solid, and whose events are stepped through
 * @property {number} ball number of the ball that is edited
 * @property {number} wall number of the wall that is edited; -1: all
 * @property {number} t s
 * @property {[number, number] | null} span times that are shown, s; null: the whole run
 * @property {boolean} playing
 * @property {number} speed seconds of the scene in one second
 * @property {Rebound[]} rebounds
 * @property {string} reboundsFrom
 * @property {LawCard[]} cards
 */

/** @typedef {"scene" | "laws" | "time" | "data"} Part */

const MOST_STEPS_BACK = 100;

/** The state; `change` says what changed, so that each part of the page draws only what it has to. */
export class Store {
  /** @param {State} state */
  constructor(state) {
    this.state = state;
    /** @type {((part: Set<Part>) => void)[]} */
    this.listeners = [];
    /** @type {string[]} */
    this.past = [];
    /** @type {string[]} */
    this.future = [];
  }

  /** @param {(part: Set<Part>) => void} listener */
  listen(listener) {
    this.listeners.push(listener);
  }

  /** @param {Partial<State>} changes @param {...Part} parts */
  change(changes, ...parts) {
    Object.assign(this.state, changes);
    const set = new Set(parts);
    for (const listener of this.listeners) listener(set);
  }

  /** A scene to come back to: called before a gesture changes it. */
  remember() {
    const now = JSON.stringify(this.state.scene);
    if (this.past[this.past.length - 1] === now) return;
    this.past.push(now);
    if (this.past.length > MOST_STEPS_BACK) this.past.shift();
    this.future = [];
  }

  /** @param {string[]} from @param {string[]} to */
  #step(from, to) {
    const now = JSON.stringify(this.state.scene);
    let next = from.pop();
    while (next === now) next = from.pop();
    if (next === undefined) return;
    to.push(now);
    const scene = JSON.parse(next);
    const ball = Math.min(this.state.ball, scene.balls.length - 1);
    this.change({ scene, ball, wall: Math.min(this.state.wall, scene.walls.length - 1) }, "scene", "laws");
  }

  undo() {
    this.#step(this.past, this.future);
  }

  redo() {
    this.#step(this.future, this.past);
  }
}
