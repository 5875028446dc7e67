// Is this a scene that can be run? Its fields, its size, and what only the whole scene tells: room, overlaps, and numbers that a law
// needs (carom.scene.scene and its shapes).

/** @import { Scene, Vec, Wall } from "../state/types.js" */
/** @import { Law, Layout } from "../engine/types.js" */
/** @import { Module } from "../engine/module.js" */
import { general, lengthText, vectorText } from "../engine/text.js";
import { fieldFaults } from "./fields.js";
import { extended } from "./numbers.js";
import { pocketFaults } from "./pockets.js";
import { SHAPES } from "./shapes.js";
import { centerOf, kappaOf, lawOf, pairLawOf, pairStiffness, setUp } from "./setup.js";

const TOUCH = 1e-9; // of the radius: what overlaps by less touches
const BALLS_TOUCH = 1e-7; // so do balls: a rack in a file is rounded to some digits
const [MOST_BALLS, MOST_FEATURES] = [100, 2000];

/** All that is wrong with a scene, one line per problem. @param {Module} module @param {Scene} scene @returns {string[]} */
export function sceneFaults(module, scene) {
  const faults = fieldFaults(scene, module.layout);
  if (faults.length > 0) return faults;
  faults.push(...partFaults(scene), ...floorFaults(scene), ...lawFaults(scene, module.layout));
  return faults.length > 0 ? faults : overlaps(module, scene);
}

/** @param {number} from @param {number} to @param {string} what */
const turn = (from, to, what) => (0 < to - from && to - from <= 360 ? [] : [`expected ${what} of more than 0 and at most 360 degrees`]);

/** What is wrong with a wall by itself. @param {Wall} wall @returns {string[]} */
function shapeFaults(wall) {
  const found = [];
  const [low, height] = [extended(wall.low ?? "-inf"), extended(wall.height ?? "inf")];
  if (wall.shape === "wedge") found.push(...turn(wall.from_angle, wall.to_angle, "an opening"));
  if (wall.shape === "arc") found.push(...turn(wall.from_angle, wall.to_angle, "an arc"));
  if (wall.shape === "box" && (wall.center === null) === (wall.corner === null)) found.push("expected either center or corner");
  if (wall.shape === "segment" && String(wall.start) === String(wall.end)) found.push("expected another point than start");
  if (wall.shape === "cylinder" && !(extended(wall.length) > 0)) found.push("expected a length greater than 0 m");
  if (wall.shape === "table" && !(height >= (wall.nose_height ?? 0) && height > 0)) found.push("expected a height above nose and floor");
  if (wall.shape === "table") found.push(...pocketFaults(wall));
  if ("low" in wall && !(low <= height && low < Infinity && height > -Infinity)) found.push(`expected a height above low = ${general(low, 6)} m`);
  if (wall.shape === "polygon" && crosses(wall.points, wall.closed)) found.push("expected an outline that does not meet itself");
  return found;
}

/** @param {Scene} scene */
function partFaults(scene) {
  const found = scene.walls.flatMap((wall, i) => shapeFaults(wall).map((fault) => `walls[${i}]: ${fault}`));
  scene.balls.forEach((ball, i) => {
    if (ball.rolling && ball.spin !== null) found.push(`balls[${i}].spin: expected no spin with rolling = true; it follows from the velocity`);
    if (ball.rolling && ball.velocity[2]) found.push(`balls[${i}].velocity: expected no speed along z with rolling = true`);
  });
  if (scene.balls.length > MOST_BALLS) found.push(`balls: expected at most ${MOST_BALLS} in a page, got ${scene.balls.length}; carom simulate takes more`);
  return found;
}

/** Whether the sides of an outline meet other than end to end. @param {[number, number][]} points @param {boolean} closed */
function crosses(points, closed) {
  const count = closed ? points.length : points.length - 1;
  const sides = Array.from({ length: count }, (_, i) => [points[i], points[(i + 1) % points.length]]);
  /** @param {number[]} p @param {number[]} q @param {number[]} r */
  const side = (p, q, r) => Math.sign((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]));
  /** @param {number[]} p @param {number[]} q @param {number[]} r */
  const on = (p, q, r) => side(p, q, r) === 0 && [0, 1].every((k) => Math.min(p[k], q[k]) <= r[k] && r[k] <= Math.max(p[k], q[k]));
  return sides.some(([p, q], i) =>
    String(p) === String(q) ||
    sides.slice(i + 1).some(([r, s], j) => {
      const crossed = side(p, q, r) * side(p, q, s) < 0 && side(r, s, p) * side(r, s, q) < 0;
      const joined = closed && i === 0 && i + 1 + j === count - 1; // where the last one ends, the first one starts
      return crossed || (!joined && (on(p, q, s) || on(r, s, p)));
    }),
  );
}

/** @param {Scene} scene */
function floorFaults(scene) {
  const found = [];
  const [gx, gy, gz] = scene.gravity;
  if (scene.floor && (gx !== 0 || gy !== 0 || gz > 0)) {
    found.push(`gravity: expected gravity along -z, as there is a floor, got ${vectorText(scene.gravity, 6)}`);
  }
  scene.balls.forEach((ball, i) => {
    const [z, a] = [centerOf(scene, ball)[2], ball.radius];
    if (scene.floor && z < a * (1 - TOUCH)) {
      found.push(`balls[${i}].position[2]: expected z of at least the radius, ${general(a, 6)}, got ${general(z, 6)}, which overlaps the floor by ${lengthText(a - z)}`);
    } else if (ball.rolling && !scene.floor) found.push(`balls[${i}].rolling: expected a floor to roll on, got true in a scene without one`);
    else if (ball.rolling && z > a * (1 + TOUCH)) found.push(`balls[${i}].position[2]: expected z = radius = ${general(a, 6)}, got ${general(z, 6)} of a ball that rolls`);
  });
  return found;
}

/** @param {Scene} scene @param {Layout} layout */
function lawFaults(scene, layout) {
  const pair = /** @type {any} */ ({ ...scene.ball_contact, stiffness_ratio: pairStiffness(scene.ball_contact) });
  return [
    ...scene.walls.flatMap((wall, i) => wallLawFaults(scene, wall, lawOf(scene, wall, layout), layout).map((fault) => `walls[${i}].${fault}`)),
    ...wallLawFaults(scene, pair, pairLawOf(scene, layout), layout).map((fault) => `ball_contact.${fault}`),
  ];
}

/** What a law needs of a wall, whatever ball comes. @param {Scene} scene @param {Wall} wall @param {Law} law @param {Layout} layout */
function wallLawFaults(scene, wall, law, layout) {
  const found = [];
  const expected = { restitution: "a number from 0 to 1, or a form", friction: "a number >= 0 (inf: never slips)" };
  for (const name of /** @type {const} */ (["restitution", "friction"])) {
    if (law.needs.includes(name) && wall[name] === null) found.push(`${name}: expected ${expected[name]}, got nothing; the law ${law.name} reads it`);
  }
  if (law.last === "stiffness_ratio") {
    const k = wall.stiffness_ratio;
    const [low, high] = law.chi_range ?? [0, Infinity];
    const shares = scene.balls.map((ball) => (1 + 1 / kappaOf(ball)) / 2);
    const [least, most] = [Math.max(...shares.map((x) => low / x)), Math.min(...shares.map((x) => high / x))];
    if (law.chi_range && !(least <= k && k <= most)) {
      found.push(`stiffness_ratio: expected a stiffness ratio from ${general(least, 3)} to ${general(most, 3)}, for which the law ${law.name} is tabulated, got ${general(k, 6)}`);
    }
    const { stiffness, most_omega: fastest } = layout.limits;
    const slow = shares.every((x) => Math.sqrt(k * 2 * x) <= fastest);
    if (!law.chi_range && !(stiffness[0] <= k && k <= stiffness[1] && slow)) {
      found.push(`stiffness_ratio: expected a stiffness ratio from ${stiffness[0]} to ${stiffness[1]} for the law ${law.name}, got ${general(k, 6)}`);
    }
    if (wall.tangential_restitution !== 0) found.push(`tangential_restitution: expected 0 for the law ${law.name}, got ${general(wall.tangential_restitution, 6)}`);
  }
  if (law.response === layout.responses.rolling) {
    const r = wall.restitution;
    if (r && !(r.form === "constant" && r.value === 1)) found.push(`restitution: expected hypothesis 3: a wall of restitution 1, for the law ${law.name}`);
    if (!scene.balls.every((ball) => SHAPES[wall.shape].vertical(wall, ball.radius))) found.push(`shape: expected hypothesis 1: a vertical wall, for the law ${law.name}`);
  }
  return found;
}

/** @param {Module} module @param {Scene} scene */
function overlaps(module, scene) {
  const { memory, layout } = module;
  const made = setUp(scene, layout, 0);
  if (made.features.length > MOST_FEATURES) {
    return [`walls: expected at most ${MOST_FEATURES} faces, edges and corners in a page, got ${made.features.length}; carom simulate takes more`];
  }
  const found = roomFaults(scene);
  if (found.length > 0) return found;
  const centers = scene.balls.map((ball) => centerOf(scene, ball));
  const blocked = scene.walls.map((wall, k) =>
    centers.map((x, i) => {
      const bad = SHAPES[wall.shape].blocked(wall, x);
      if (bad) {
        found.push(`balls[${i}].position: expected a place on the free side of ${wallName(wall, k)}, got ${vectorText(x, 6)}; move the ball`);
      }
      return bad;
    }),
  );
  memory.clear();
  const count = made.features.length;
  const features = memory.records(layout.records.features, made.features);
  const balls = memory.records(layout.records.balls, made.balls);
  const gaps = memory.take(8 * Math.max(count * centers.length, 1));
  module.call("gaps", 0, features, count, balls, centers.length, gaps, centers.length, count);
  centers.forEach((x, i) => {
    const a = scene.balls[i].radius;
    let [deepest, at] = [-TOUCH * a, -1];
    for (let f = 0; f < count; f++) {
      const gap = memory.doubles[gaps / 8 + i * count + f];
      if (gap >= -a && gap < deepest && !blocked[Number(made.features[f].wall)][i]) [deepest, at] = [gap, f]; // (of less than -a: the ball is behind a face)
    }
    if (at >= 0) {
      const wall = Number(made.features[at].wall);
      found.push(touches(i, x, wallName(scene.walls[wall], wall), -deepest));
    }
    for (let k = 0; k < i; k++) {
      const reach = a + scene.balls[k].radius;
      const gap = Math.hypot(x[0] - centers[k][0], x[1] - centers[k][1], x[2] - centers[k][2]) - reach;
      if (gap < -BALLS_TOUCH * Math.min(a, scene.balls[k].radius)) found.push(touches(i, x, `balls[${k}]`, -gap));
    }
  });
  return found;
}

/** @param {number} i @param {Vec} x @param {string} what @param {number} deep */
const touches = (i, x, what, deep) =>
  `balls[${i}].position: expected a place where the ball touches nothing, got ${vectorText(x, 6)}, which overlaps ${what} by ${lengthText(deep)}; move it by ${lengthText(deep)} or more`;

/** @param {Wall} wall @param {number} k */
const wallName = (wall, k) => `walls[${k}] (${wall.name ?? `${wall.shape} ${k}`})`;

/** @param {Scene} scene */
function roomFaults(scene) {
  const radii = scene.balls.map((ball) => ball.radius);
  const [least, most] = [Math.min(...radii), Math.max(...radii)];
  return scene.walls.flatMap((wall, k) => {
    const room = SHAPES[wall.shape].room?.(wall) ?? Infinity;
    if (most >= room) return [`walls[${k}]: expected room for a ball of radius ${lengthText(most)}, got room for radii below ${lengthText(room)}`];
    const nose = wall.shape === "table" ? wall.nose_height : null;
    if (nose === null || nose < 2 * least) return [];
    return [`walls[${k}].nose_height: expected less than ${lengthText(2 * least)}, the diameter of a ball, which would roll under it, got ${general(nose, 6)}`];
  });
}
