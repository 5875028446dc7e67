// Is this a scene that can be run? Its parts, its size, and what only the whole scene tells: rules of carom.scene, kernels of the
// module with their texts.

/** @import { Scene, Wall } from "../state/types.js" */
/** @import { Law } from "../engine/types.js" */
/** @import { Module } from "../engine/module.js" */
import { unmetRules } from "../engine/objections.js";
import { extended, fill, filled, general, repr } from "../engine/text.js";
import { length } from "../state/vectors.js";
import { fieldFaults } from "./fields.js";
import { placeAt } from "./shapes.js";
import { centerOf, contactModulus, kappaOf, lawOf, ownSurfaces, pairLawOf, pairStiffness, setUp } from "./setup.js";

const COLUMNS = 7; // of rows of faults

/** All that is wrong with a scene, one line per problem. @param {Module} module @param {Scene} scene @returns {string[]} */
export function sceneFaults(module, scene) {
  const { layout, memory } = module;
  const faults = fieldFaults(module, "", scene, layout.fields.scene);
  if (faults.length > 0) return faults;
  const { balls, walls, ball_contact: pair } = scene;
  memory.clear();
  const { features } = setUp(scene, module);
  for (const [what, count] of Object.entries({ balls: balls.length, "features of walls": features.length })) {
    const most = layout.limits[/** @type {"balls"} */ (what)];
    if (count > most) faults.push(`${what}: expected at most ${most.toLocaleString("en")}, got ${count.toLocaleString("en")}; carom simulate takes more`);
  }
  if (faults.length > 0) return faults;
  const names = balls.map((ball, i) => ball.name || `ball ${i}`);
  const centers = balls.map((ball) => centerOf(scene, ball));
  const rows = balls.map((ball, i) => [...centers[i], ball.radius, Number(ball.rolling), names.indexOf(names[i]), Number(Boolean(ball.name)), length(ball.velocity), ball.mass]);
  const places = walls.map((wall) => centers.map((x) => placeAt(wall, x)));
  const wallRows = walls.map((wall, k) => [Number(wall.shape === "plane"), places[k][0].room, wall.nose_height ?? NaN]);
  const blocked = places.map((one) => one.map((place) => Number(place.blocked)));
  /** @param {number[]} row */
  const said = ([code, i, k, a, b, c, d]) => filled(layout.scene_faults[code], {
    ...scene, i, k, a, b, c, d, place: [b, c, d], ball: { ...balls[i], center: centers[i] }, name: names[i], wall: walls[k] && wallName(walls[k], k),
  });
  const ground = [...scene.gravity, Number(scene.floor !== null), walls.findIndex(({ shape }) => shape === "table")];
  const [table, count] = [(/** @type {number[][]} */ all, /** @type {number} */ columns) => ({ rows: all, columns }), balls.length];
  const atWalls = [
    [extended(pair.young), contactModulus(pair)], table(rows, 9), table(wallRows, 3), memory.records(layout.records.features, features), features.length,
    table(blocked, count),
  ];
  return [
    ...module.rows("faults_on_floor", [ground, table(rows, 9)], COLUMNS, count + 1).map(said), ...lawFaults(module, scene),
    ...module.rows("faults_at_walls", atWalls, COLUMNS, 64).map(said),
  ];
}

/** @param {Wall} wall @param {number} k */
const wallName = (wall, k) => `walls[${k}] (${wall.name || `${wall.shape} ${k}`})`;

/** @param {Module} module @param {Scene} scene */
function lawFaults(module, scene) {
  const { layout } = module;
  const pair = scene.ball_contact;
  return [
    ...scene.walls.flatMap((wall, i) => {
      const [law, at] = [lawOf(scene, wall, layout), `walls[${i}]`];
      const missing = law.needed.filter(({ name }) => wall[name] === null).map((values) => filled(layout.law_faults.needed, { at, ...values }));
      const vertical = (/** @type {number} */ z) => placeAt(wall, [0, 0, z]).vertical;
      const own = Object.entries(ownSurfaces(wall)).flatMap(([part, one]) =>
        conditionFaults(module, scene, one, law, `${at}.${part}`, {}, one.stiffness_ratio, vertical).filter((text) => text.startsWith(`${at}.${part}.restitution`)));
      return [...missing, ...conditionFaults(module, scene, wall, law, at, { shape: at, floor: wall.law ? `${at}.law` : "run.law" }, wall.stiffness_ratio, vertical), ...own];
    }),
    ...conditionFaults(module, scene, { ...pair, shape: "" }, pairLawOf(scene, layout), "ball_contact", {}, pairStiffness(pair)),
  ];
}

/** A law's conditions on a wall, the floor or the pairs, of each ball, coming square to the surface. @param {Module} module @param {Scene} scene @param {Pick<Wall, "restitution" | "tangential_restitution" | "shape">} surface @param {Law} law @param {string} at @param {Record<string, string>} places @param {number} stiffness @param {(z: number) => boolean} [vertical] */
function conditionFaults(module, scene, surface, law, at, places, stiffness, vertical = () => true) {
  const { law_faults: texts } = module.layout;
  const r = surface.restitution;
  const e = r === null ? 1 : r.form === "constant" ? Number(r.value) : 0.5;
  /** @type {Map<string, string>} */
  const unmet = new Map();
  for (const ball of scene.balls) {
    for (const { field, text } of unmetRules(module, {
      v: [-1, 0, 0], w: [0, scene.floor ? -1 / ball.radius : 0, 0], n: vertical(ball.radius) ? [1, 0, 0] : [0.8, 0, 0.6], radius: ball.radius,
      kappa: kappaOf(ball), mass: ball.mass, e, mu: Infinity, beta: 0, stiffness, floor: { e: 0, mu: Infinity, beta: 0 }, height: 0, together: true,
    }, law)) if (!unmet.has(field)) unmet.set(field, text);
  }
  const form = r === null ? "" : r.form === "constant" ? general(e, 6) : fill(texts.restitution.got, r);
  /** @type {Record<string, string>} */
  const got = { shape: fill(texts.shape.got, surface), floor: texts.floor.got, restitution: form, stiffness_ratio: repr(stiffness, true) };
  const found = [...unmet].filter(([field]) => places[field] || field === "restitution" || field === "stiffness_ratio");
  const springs = law.last === "stiffness_ratio" && surface.tangential_restitution !== 0;
  return [
    ...found.map(([field, expected]) => filled(texts.unmet, { at: places[field] ?? `${at}.${field}`, expected, law: law.name, got: got[field] })),
    ...(springs ? [filled(texts.springs, { at, law: law.name, beta: surface.tangential_restitution })] : []),
  ];
}
