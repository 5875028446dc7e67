// The scene from above and from the side, for browsers without WebGL 2.

/** @import { Drag, Palette, Shot, View } from "./shot.js" */
import { pocketsOf } from "../scene/shapes.js";
import { placeAt } from "../state/film.js";
import { Orientation, stateAt, trail } from "../state/motion.js";
import { ballColour } from "./balls.js";
import { oncePerFrame } from "./frames.js";
import { arrowTime, dotsOf, outline } from "./shot.js";

const DASHES = { rolling: [], sliding: [7, 4], flight: [1.5, 3.5] };
const REACH = 24;
const SHORTEST_ARROW = 1.8;

/** @param {HTMLElement} host @param {Drag | null} drag as of stage @returns {View} */
export function flat(host, drag) {
  const canvas = document.createElement("canvas");
  canvas.tabIndex = 0;
  canvas.setAttribute("role", "img");
  host.prepend(canvas);
  /** @type {Shot | null} */
  let shot = null;
  /** @type {Palette | null} */
  let palette = null;
  let now = 0;
  const request = oncePerFrame(render);
  /** @type {"ball" | "velocity" | null} */
  let grasped = null;
  let offset = [0, 0];
  let arrowScale = 1;
  /** @type {{law: string, ball: number, turns: Orientation}[]} */
  let balls = [];

  /** From metres to pixels, above and at the side. @param {Shot} s */
  function frame(s) {
    const [width, height] = [host.clientWidth, host.clientHeight];
    const { low, high } = s.box;
    const strip = Math.min(0.3 * height, 150);
    const k = Math.min((width - 40) / (high[0] - low[0]), (height - strip - 50) / (high[1] - low[1]));
    const [cx, cy] = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2];
    const tall = Math.max(high[2] - low[2], 1e-30);
    const up = Math.min(k, (strip - 50) / tall);
    return {
      width, height, k, up, strip,
      above: (/** @type {number} */ x, /** @type {number} */ y) => [width / 2 + k * (x - cx), (height - strip) / 2 - k * (y - cy)],
      side: (/** @type {number} */ x, /** @type {number} */ z) => [width / 2 + k * (x - cx), height - 34 - up * (z - low[2])],
      metres: (/** @type {number} */ px, /** @type {number} */ py) => [cx + (px - width / 2) / k, cy - (py - (height - strip) / 2) / k],
    };
  }

  function tip() {
    if (!shot) return [0, 0];
    const { position, velocity, radius } = shot.scene.balls[shot.ball];
    const speed = Math.hypot(velocity[0], velocity[1]);
    const way = speed > 0 ? [velocity[0] / speed, velocity[1] / speed] : [1, 0];
    const long = SHORTEST_ARROW * radius + speed * arrowScale;
    return [position[0] + way[0] * long, position[1] + way[1] * long];
  }

  canvas.addEventListener("pointerdown", (event) => {
    if (!shot || drag === null || event.button !== 0) return;
    const view = frame(shot);
    const ball = shot.scene.balls[shot.ball];
    const far = (/** @type {number[]} */ p) => Math.hypot(p[0] - event.offsetX, p[1] - event.offsetY);
    const end = tip();
    if (far(view.above(end[0], end[1])) < REACH) grasped = "velocity";
    else if (far(view.above(ball.position[0], ball.position[1])) < Math.max(REACH, view.k * ball.radius)) grasped = "ball";
    else return;
    const at = view.metres(event.offsetX, event.offsetY);
    const from = grasped === "ball" ? ball.position : end;
    offset = [from[0] - at[0], from[1] - at[1]];
    canvas.setPointerCapture(event.pointerId);
    drag.start();
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!grasped || !shot || drag === null) return;
    const [x, y] = frame(shot).metres(event.offsetX, event.offsetY).map((value, k) => value + offset[k]);
    if (grasped === "ball") {
      drag.ball(x, y);
      return;
    }
    const { position, radius } = shot.scene.balls[shot.ball];
    const away = Math.hypot(x - position[0], y - position[1]);
    const speed = Math.max(0, away - SHORTEST_ARROW * radius) / arrowScale;
    drag.velocity((speed * (x - position[0])) / (away || 1), (speed * (y - position[1])) / (away || 1));
  });
  const release = () => {
    if (!grasped) return;
    grasped = null;
    if (shot) arrowScale = arrowTime(shot);
    drag?.end();
    request();
  };
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);

  /** @param {Shot} next @param {Palette} colours */
  function update(next, colours) {
    shot = next;
    palette = colours;
    if (!grasped) arrowScale = arrowTime(next);
    balls = [];
    for (const [law, run] of next.runs) {
      run.balls.forEach(({ pieces }, ball) => {
        if (law === next.followed || ball === next.ball) balls.push({ law, ball, turns: new Orientation(pieces) });
      });
    }
    request();
  }

  function render() {
    if (!shot || !palette) return;
    const view = frame(shot);
    const ratio = Math.min(devicePixelRatio, 2);
    if (canvas.width !== Math.round(view.width * ratio) || canvas.height !== Math.round(view.height * ratio)) {
      canvas.width = Math.round(view.width * ratio);
      canvas.height = Math.round(view.height * ratio);
      canvas.style.width = `${view.width}px`;
      canvas.style.height = `${view.height}px`;
    }
    const c = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.fillStyle = palette.background;
    c.fillRect(0, 0, view.width, view.height);
    c.strokeStyle = palette.edge;
    c.lineWidth = 2;
    for (const wall of shot.scene.walls) {
      for (const line of outline(wall, shot.box)) {
        c.beginPath();
        line.forEach(([x, y]) => c.lineTo(...pair(view.above(x, y))));
        c.stroke();
      }
    }
    c.fillStyle = palette.edge;
    for (const wall of shot.scene.walls) {
      for (const { center, radius } of pocketsOf(wall)) {
        c.beginPath();
        c.arc(...pair(view.above(...center)), view.k * radius, 0, 7);
        c.fill();
      }
    }
    c.fillStyle = palette.floor;
    c.fillRect(0, view.height - view.strip, view.width, view.strip);
    c.fillStyle = palette.soft;
    c.font = "12px system-ui, sans-serif";
    c.fillText("from above", 12, 20);
    c.fillText(view.up < view.k * 0.99 ? "from the side (heights reduced)" : "from the side", 12, view.height - view.strip + 18);
    if (shot.scene.floor) {
      c.strokeStyle = palette.edge;
      c.beginPath();
      const ground = view.side(shot.box.low[0], 0)[1];
      c.moveTo(0, ground);
      c.lineTo(view.width, ground);
      c.stroke();
    }
    for (const { law, ball, turns } of balls) {
      c.strokeStyle = ball === shot.ball ? (shot.colours.get(law) ?? palette.ink) : ballColour(shot.scene.balls[ball], ball);
      c.lineWidth = law === shot.followed && ball === shot.ball ? 2.4 : 1.4;
      for (const { style, points } of trail(turns.pieces, shot.span, shot.scene.balls[ball].radius)) {
        c.setLineDash(DASHES[style]);
        for (const to of [(/** @type {number[]} */ p) => view.above(p[0], p[1]), (/** @type {number[]} */ p) => view.side(p[0], p[2])]) {
          c.beginPath();
          points.forEach((p) => c.lineTo(...pair(to(p))));
          c.stroke();
        }
      }
      c.setLineDash([]);
    }
    c.fillStyle = palette.ink;
    c.strokeStyle = palette.ink;
    for (const [i, rows] of shot.film.entries()) {
      for (const [, x, y] of dotsOf(rows, shot.box)) {
        const at = view.above(x, y);
        c.fillRect(at[0] - 1, at[1] - 1, 2, 2);
      }
      const place = placeAt(rows, now);
      if (!place) continue;
      c.beginPath();
      c.arc(...pair(view.above(...place)), 3 + view.k * shot.scene.balls[i].radius, 0, 7);
      c.stroke();
    }
    const end = tip();
    const start = shot.scene.balls[shot.ball].position;
    if (drag) {
      c.strokeStyle = c.fillStyle = palette.ink;
      c.lineWidth = 2;
      c.beginPath();
      c.moveTo(...pair(view.above(start[0], start[1])));
      c.lineTo(...pair(view.above(end[0], end[1])));
      c.stroke();
      c.beginPath();
      c.arc(...pair(view.above(end[0], end[1])), 5, 0, 7);
      c.fill();
    }
    [canvas.dataset.ball, canvas.dataset.arrow] = [start, end].map((p) => view.above(p[0], p[1]).map(Math.round).join());
    const leader = shot.runs.get(shot.followed);
    const solid = leader ? stateAt(leader.balls[shot.ball].pieces, now).x : null;
    for (const { law, ball, turns } of [...balls].reverse()) {
      const { x, phase } = stateAt(turns.pieces, now);
      if (phase === "pocketed") continue;
      const leads = law === shot.followed;
      // a ghost in the place of the ball that leads is not drawn
      if (!leads && solid && Math.hypot(x[0] - solid[0], x[1] - solid[1], x[2] - solid[2]) < 0.02 * shot.scene.balls[ball].radius) continue;
      const colour = leads ? ballColour(shot.scene.balls[ball], ball) : (shot.colours.get(law) ?? palette.ink);
      const radius = Math.max(3, view.k * shot.scene.balls[ball].radius);
      const [w, qx, qy, qz] = turns.at(now);
      // the mark on the ball's own x axis
      const mark = [1 - 2 * (qy * qy + qz * qz), 2 * (qx * qy + w * qz), 2 * (qx * qz - w * qy)];
      for (const [at, u, v, towards] of /** @type {[number[], number, number, number][]} */ ([[view.above(x[0], x[1]), mark[0], -mark[1], mark[2]], [view.side(x[0], x[2]), mark[0], -mark[2], -mark[1]]])) {
        c.globalAlpha = leads ? 1 : 0.55;
        c.fillStyle = colour;
        c.strokeStyle = palette.edge;
        c.lineWidth = 1;
        c.beginPath();
        c.arc(...pair(at), radius, 0, 7);
        c.fill();
        c.stroke();
        if (towards > 0) {
          c.fillStyle = palette.ink;
          c.beginPath();
          c.arc(at[0] + radius * u, at[1] + radius * v, Math.max(1.2, 0.2 * radius), 0, 7);
          c.fill();
        }
        c.globalAlpha = 1;
      }
    }
  }

  return {
    update,
    trace(span) {
      if (shot) shot = { ...shot, span };
    },
    draw(t) {
      now = t;
      request();
    },
    look: () => request(),
    resize: () => request(),
    picture() {
      render();
      return new Promise((resolve, reject) => canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("The browser gave no picture."))), "image/png"));
    },
  };
}

/** @param {number[]} p @returns {[number, number]} */
const pair = (p) => [p[0], p[1]];

