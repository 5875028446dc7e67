// A run as `carom simulate --json` prints it: the same names, in the same order.

/** @import { Scene } from "../state/types.js" */
/** @import { Run } from "./types.js" */
import { kineticEnergy } from "../scene/setup.js";

const ENDED = { quiet: "nothing more happens", done: "duration", limit: "max_events", time: "time of computing", refused: "refused" };

/** Infinite and undefined numbers are null there. @param {number} x */
const finite = (x) => (Number.isFinite(x) ? x : null);

/** @param {Scene} scene @param {Run} run */
export function reportOf(scene, run) {
  const wallNames = scene.walls.map((wall, i) => wall.name || `${wall.shape} ${i}`);
  const ballNames = scene.balls.map((ball, i) => ball.name || `ball ${i}`);
  return {
    events: run.events.map((event) => ({
      t: event.t,
      kind: event.kind,
      ball: event.ball,
      position: event.x,
      velocity: event.v,
      spin: event.w,
      other: event.other,
      name: event.met === "wall" ? wallNames[event.other] : event.met === "ball" ? ballNames[event.other] : "",
      phase: event.phase,
      impulse: event.impulse,
      required_friction: finite(event.required),
      energy_lost: kineticEnergy(scene.balls[event.ball], event.v_before, event.w_before) - kineticEnergy(scene.balls[event.ball], event.v, event.w),
    })),
    final: run.final.map(({ x, v, w, phase }, i) => ({ position: x, velocity: v, spin: w, phase, name: ballNames[i] })),
    end: run.until,
    ended: ENDED[run.status],
  };
}
