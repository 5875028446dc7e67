// Is this a scene that can be run? Its fields, its size, and what only the whole scene tells: room, overlaps, and numbers that a law
// needs (carom.scene.scene and its shapes).

/** @import { Scene, Vec, Wall } from "../state/types.js" */
/** @import { Law } from "../engine/types.js" */
/** @import { Module } from "../engine/module.js" */
import { general, lengthText, vectorText } from "../engine/text.js";
import { unmetRules } from "../engine/objections.js";
import { fieldFaults, shown } from "./fields.js";
import { placeAt, shapeFaults } from "./shapes.js";
import { centerOf, kappaOf, lawOf, pairLawOf, pairStiffness, setUp } from "./setup.js";

const TOUCH = 1e-9; // of the radius: what overlaps by less touches
const BALLS_TOUCH = 1e-7; // so do balls: a rack in a file is rounded to some digits
const [MOST_BALLS, MOST_FEATURES] = [100, 2000];

/** All that is wrong with a scene, one line per problem. @param {Module} module @param {Scene} scene @returns {string[]} */
export function sceneFaults(module, scene) {
  const faults = fieldFaults(scene, module.layout);
  if (faults.length > 0) return faults;
  faults.push(...partFaults(scene), ...floorFaults(scene), ...lawFaults(module, scene));
  return faults.length > 0 ? faults : overlaps(module, scene);
}

/** @param {Scene} scene */
function partFaults(scene) {
  const found = scene.walls.flatMap((wall, i) => shapeFaults(wall).map((fault) => `walls[${i}]${fault}`));
  scene.balls.forEach((ball, i) => {
    if (ball.rolling && ball.spin !== null) found.push(`balls[${i}].spin: expected no spin with rolling = true; it follows from the velocity`);
    if (ball.rolling && ball.velocity[2]) found.push(`balls[${i}].velocity: expected no speed along z with rolling = true`);
  });
  if (scene.balls.length > MOST_BALLS) found.push(`balls: expected at most ${MOST_BALLS} in a page, got ${scene.balls.length}; carom simulate takes more`);
  return found;
}

/** @param {Scene} scene */
function floorFaults(scene) {
  const found = [];
  const [gx, gy, gz] = scene.gravity;
  if (scene.floor && (gx !== 0 || gy !== 0 || gz > 0)) {
    found.push(`gravity: expected gravity along -z, as there is a floor, got ${vectorText(scene.gravity, 6)}`);
  }
  if (scene.floor?.slope.some((x) => x !== 0)) {
    const [x, y] = scene.floor.slope;
    if (!(x * x + y * y < 1)) found.push(`floor.slope: expected a floor that is less steep than upright, got ${vectorText(scene.floor.slope, 6)}`);
    for (const name of /** @type {const} */ (["rolling_drag", "spin_drag"])) {
      if (scene.floor[name] > 0) found.push(`floor.${name}: expected 0 on a floor with a slope, got ${general(scene.floor[name], 6)}`);
    }
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

/** @param {Module} module @param {Scene} scene */
function lawFaults(module, scene) {
  const pair = scene.ball_contact;
  return [
    ...scene.walls.flatMap((wall, i) => {
      const law = lawOf(scene, wall, module.layout);
      const expected = { restitution: "a number from 0 to 1, or a form", friction: "a number >= 0 (inf: never slips)" };
      const missing = /** @type {const} */ (["restitution", "friction"]).filter((name) => law.needs.includes(name) && wall[name] === null);
      const vertical = (/** @type {number} */ z) => placeAt(wall, [0, 0, z]).vertical;
      /** @type {Places} */
      const got = { shape: [`walls[${i}]`, wall.shape], floor: [wall.law ? `walls[${i}].law` : "run.law", "a scene without a floor"] };
      return [
        ...missing.map((name) => `walls[${i}].${name}: expected ${expected[name]}, got nothing; the law ${law.name} reads it`),
        ...conditionFaults(module, scene, wall, law, `walls[${i}]`, got, wall.stiffness_ratio, vertical),
      ];
    }),
    ...conditionFaults(module, scene, pair, pairLawOf(scene, module.layout), "ball_contact", {}, pairStiffness(pair)),
  ];
}

/** Places of conditions on what a scene declares, and what stands there. @typedef {Record<string, [string, unknown]>} Places */

/** A law's conditions on a wall, the floor or the pairs, of each ball, coming square to the surface. @param {Module} module @param {Scene} scene @param {Pick<Wall, "restitution" | "tangential_restitution">} surface @param {Law} law @param {string} at @param {Places} got @param {number} stiffness @param {(z: number) => boolean} [vertical] */
function conditionFaults(module, scene, surface, law, at, got, stiffness, vertical = () => true) {
  const r = surface.restitution;
  const e = r === null ? 1 : r.form === "constant" ? Number(r.value) : 0.5;
  /** @type {Places} */
  const places = { ...got, restitution: [`${at}.restitution`, r], stiffness_ratio: [`${at}.stiffness_ratio`, stiffness] };
  /** @type {Map<string, string>} */
  const unmet = new Map();
  for (const ball of scene.balls) {
    for (const { field, text } of unmetRules(module, {
      v: [-1, 0, 0], w: [0, scene.floor ? -1 / ball.radius : 0, 0], n: vertical(ball.radius) ? [1, 0, 0] : [0.8, 0, 0.6], radius: ball.radius,
      kappa: kappaOf(ball), mass: ball.mass, e, mu: Infinity, beta: 0, stiffness, floor: { e: 0, mu: Infinity, beta: 0 }, height: 0, together: true,
    }, law)) {
      if (field in places && !unmet.has(field)) unmet.set(field, `${places[field][0]}: expected ${text}, for the law ${law.name}, got ${shown(places[field][1])}`);
    }
  }
  const springs = law.last === "stiffness_ratio" && surface.tangential_restitution !== 0;
  const beta = `${at}.tangential_restitution: expected 0 for the law ${law.name}, got ${general(surface.tangential_restitution, 6)}`;
  return [...unmet.values(), ...(springs ? [beta] : [])];
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
      const bad = placeAt(wall, x).blocked;
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
    const room = placeAt(wall, [0, 0, 0]).room;
    if (most >= room) return [`walls[${k}]: expected room for a ball of radius ${lengthText(most)}, got room for radii below ${lengthText(room)}`];
    const nose = wall.nose_height ?? null;
    if (nose === null || nose < 2 * least) return [];
    return [`walls[${k}].nose_height: expected less than ${lengthText(2 * least)}, the diameter of a ball, which would roll under it, got ${general(nose, 6)}`];
  });
}
