// A scene as the engine's records: world, features, balls (carom.simulation.records, carom.scene.Scene.features).

/** @import { Ball, Restitution, Scene, Vec, Wall } from "../state/types.js" */
/** @import { Law, Layout } from "../engine/types.js" */
/** @import { Module } from "../engine/module.js" */
import { extended } from "../engine/text.js";
import { dot } from "../state/vectors.js";
import { featuresOf, placeAt } from "./shapes.js";

/** @typedef {Record<string, number | boolean | number[]>} Row fields of a record by name */

/** @typedef {{world: Row, features: Row[], balls: Row[], called: Law[]}} Setup */

const INERTIAS = { solid: 2 / 5, hollow: 2 / 3 };

/** I / (m a^2). @param {Ball} ball @returns {number} */
export const kappaOf = (ball) => (typeof ball.inertia === "string" ? INERTIAS[ball.inertia] : ball.inertia);

/** J. @param {Ball} ball @param {Vec} v @param {Vec} w */
export const kineticEnergy = (ball, v, w) => (ball.mass * dot(v, v)) / 2 + (kappaOf(ball) * ball.mass * (ball.radius * ball.radius) * dot(w, w)) / 2;

/** Acceleration in flight along the axes of the floor: gravity, turned by its slope. @param {Scene} scene @returns {Vec} */
export function pullOf({ gravity, floor }) {
  const [x, y] = floor?.slope ?? [0, 0];
  const g = -gravity[2];
  return x === 0 && y === 0 ? gravity : [g * x, g * y, -g * Math.sqrt(1 - x * x - y * y)];
}

/** Angular velocity at the start. @param {Ball} ball @returns {Vec} */
export function spinOf(ball) {
  const [x, y] = ball.velocity;
  return ball.rolling ? [-y / ball.radius, x / ball.radius, ball.spin_z ?? 0] : (ball.spin ?? [0, 0, 0]);
}

/** @param {string} name @param {Layout} layout @returns {Law} */
function lawNamed(name, layout) {
  const law = layout.laws.find((one) => one.name === name);
  if (law === undefined) throw new Error(`law: expected one of ${layout.laws.map((one) => one.name).join(", ")}, got ${name}`);
  return law;
}

/** The law of a wall. @param {Scene} scene @param {Wall} wall @param {Layout} layout */
export const lawOf = (scene, wall, layout) => lawNamed(wall.law ?? scene.run.law, layout);

/** The law by which two balls meet. @param {Scene} scene @param {Layout} layout */
export const pairLawOf = (scene, layout) => lawNamed(scene.ball_contact.law ?? "contact", layout);

/** Tangential over normal stiffness of two balls. @param {Scene["ball_contact"]} pair */
export const pairStiffness = ({ stiffness_ratio: k, poisson }) => k ?? (2 * (1 - poisson)) / (2 - poisson);

/** A restitution as a code and three numbers. @param {Restitution | null} found @param {Layout} layout @returns {[number, Vec]} */
export function restitutionNumbers(found, layout) {
  /** @type {any} */
  const r = found ?? { form: "constant", value: 1 };
  const code = layout.forms[r.form === "han-2005" ? "polynomial" : r.form];
  switch (r.form) {
    case "constant": return [code, [r.value, 0, 0]];
    case "polynomial": return [code, r.coefficients];
    case "han-2005": return [code, layout.han2005];
    case "power": return [code, [r.at_rest, r.speed, r.exponent]];
    case "viscoelastic": return [code, [r.c, 0, 0]];
    case "exponential": return [code, [r.at_rest, r.at_speed, r.speed]];
    default: throw new Error(`restitution: expected one of ${Object.keys(layout.forms).join(", ")}, got ${r.form}`);
  }
}

/** @param {{restitution: Restitution | null, friction: unknown, tangential_restitution: number}} surface @param {Layout} layout */
export function contactOf(surface, layout) {
  const [form, p] = restitutionNumbers(surface.restitution, layout);
  return { form, p, mu: surface.friction === null ? Infinity : extended(surface.friction), beta: surface.tangential_restitution };
}

/** @param {string} of @param {ReturnType<typeof contactOf>} contact @returns {Row} */
const prefixed = (of, contact) => Object.fromEntries(Object.entries(contact).map(([key, value]) => [`${of}_${key}`, value]));

/** A wall with its law's numbers where it has none. @template {{restitution: Restitution | null, friction: unknown}} T @param {T} wall @param {Law} law @returns {T} */
export function withDefaults(wall, { defaults }) {
  const restitution = wall.restitution ?? (defaults.restitution === undefined ? null : { form: "constant", value: defaults.restitution });
  return { ...wall, restitution, friction: wall.friction ?? defaults.friction ?? null };
}

/** Give a contact the numbers that its law's kernel takes. @param {ReturnType<typeof contactOf>} contact @param {Law} law @param {number} stiffness @param {Layout} layout */
function underLaw(contact, law, stiffness, layout) {
  if (law.response === layout.responses.contact) {
    const { restitution, friction, tangential_restitution: beta } = law.pinned;
    if (restitution !== undefined) [contact.form, contact.p] = [layout.forms.constant, [extended(restitution), 0, 0]];
    if (friction !== undefined) contact.mu = extended(friction);
    if (beta !== undefined) contact.beta = extended(beta);
  }
  if (law.last === "stiffness_ratio") contact.beta = stiffness;
  return contact;
}

/** The surface of a wall as its law reads it. @param {Scene} scene @param {Wall} wall @param {Law} law @param {Layout} layout */
export function surfaceOf(scene, wall, law, layout) {
  const contact = underLaw(contactOf(withDefaults(wall, law), layout), law, wall.stiffness_ratio, layout);
  if (law.last === "floor_friction") contact.beta = scene.floor ? contactOf(scene.floor, layout).mu : 0;
  return contact;
}

/** The walls with the surfaces of the parts that differ from a wall, by their paths in it. @param {Wall} wall @returns {Record<string, Wall>} */
export function ownSurfaces(wall) {
  const sides = Object.entries(wall.sides ?? {}).filter(([, side]) => side && ((side.restitution ?? null) !== null || (side.friction ?? null) !== null));
  return Object.fromEntries(sides.map(([name, side]) => [`sides.${name}`, { ...wall, restitution: side.restitution ?? wall.restitution, friction: side.friction ?? wall.friction }]));
}

/** The wall with the surface of a feature: its cushion's where that differs. @param {Wall} wall @param {number} pocket of the feature @param {Layout} layout @returns {Wall} */
export function surfaceAt(wall, pocket, layout) {
  const names = Object.keys(layout.fields.sides?.fields ?? {});
  return ownSurfaces(wall)[`sides.${names[layout.first_cushion - pocket]}`] ?? wall;
}

/** E* of the contacts of two balls, Pa; 0 where they are resolved one pair after the other. @param {Scene["ball_contact"]} pair */
export const contactModulus = ({ young, poisson, overlap }) => (overlap ? extended(young) / (2 * (1 - poisson * poisson)) : 0);

/** Balls that meet under their law, the fields of the world. @param {Scene} scene @param {Law} law @param {Law[]} called @param {Layout} layout @returns {Row} */
function pairFields({ ball_contact: pair }, law, called, layout) {
  const falls = typeof pair.friction === "object" && law.pinned.friction === undefined ? pair.friction : null;
  const contact = underLaw(contactOf({ ...pair, friction: falls ? falls.at_speed : pair.friction }, layout), law, pairStiffness(pair), layout);
  const { contact: own, called: first } = layout.responses;
  const [mu, drop, rate] = law.slip_friction ?? (falls ? [falls.at_speed, falls.at_rest - falls.at_speed, 1 / falls.speed] : [contact.mu, 0, 0]);
  return {
    ...prefixed("pair", { ...contact, mu }), pair_drop: drop, pair_rate: rate,
    pair_law: law.one_contact ? own : first + called.indexOf(law), pair_modulus: contactModulus(pair),
  };
}

/** What the air of a scene is to the world and to its balls: rows of the laws of drag and lift, and the places of each ball's. @param {Scene} scene @param {Layout} layout @param {boolean} [share] rows of the same numbers, where there are too many @returns {{world: Row, balls: Row[]}} */
function airOf({ air, balls }, layout, share = false) {
  if (!air) return { world: {}, balls: balls.map(() => ({})) };
  /** @type {number[]} */
  const laws = [];
  /** @type {Map<string, number>} */
  const known = new Map(); // the first rows of laws, by their numbers
  const own = balls.map((ball) => {
    const [a, perSpeed] = [ball.radius, (2 * ball.radius * air.density) / air.viscosity];
    let acts = false; // whether a law is not zero
    const places = /** @type {const} */ (["drag", "lift"]).map((name) => {
      const law = ball[name] ?? 0;
      const segments = typeof law === "string" ? layout.air_laws[law][name] : [[law, 0, 0, 0, 0, 0, Infinity, 0]];
      const rows = segments.map(([p0, p1, p2, p3, q, r, high, overSpin]) => {
        const top = extended(/** @type {any} */ (high));
        return [Number(overSpin), overSpin ? top : top / perSpeed, p0, p1 * perSpeed, p2 / perSpeed, p3 / (perSpeed * perSpeed), q, r];
      });
      acts ||= rows.some((row) => row.slice(2).some((one) => one !== 0));
      const first = (share ? known.get(JSON.stringify(rows)) : undefined) ?? laws.length / 8;
      if (first === laws.length / 8) laws.push(...rows.flat());
      known.set(JSON.stringify(rows), first);
      return { [name]: first, [`${name}_last`]: first + rows.length - 1 };
    });
    const moved = ((air.density * 4) / 3 * Math.PI * (a * a * a)) / ball.mass;
    return { ...places[0], ...places[1], air: acts ? (air.density * Math.PI * (a * a)) / (2 * ball.mass) : 0, buoyancy: air.buoyancy ? moved : 0, spin_decay: ball.spin_decay ?? 0 };
  });
  const most = layout.records.world.fields.laws.count;
  return laws.length > most && !share ? airOf(/** @type {Scene} */ ({ air, balls }), layout, true) : { world: { wind: air.wind, laws }, balls: own };
}

/** A scene as records; tables of curves are put into the memory. @param {Scene} scene @param {Module} module @returns {Setup} */
export function setUp(scene, module) {
  const { layout, memory } = module;
  const { rim, curve } = layout.features;
  const floor = scene.floor;
  const found = scene.walls.map((wall) => lawOf(scene, wall, layout));
  const pairLaw = pairLawOf(scene, layout);
  const byAddress = found.filter((law) => law.response === layout.responses.called);
  const called = [...new Set(pairLaw.one_contact ? byAddress : [...byAddress, pairLaw])];
  /** @type {Row} */
  const world = {
    force: pullOf(scene),
    ...(floor && { floor: 1, g: -pullOf(scene)[2], ...prefixed("floor", contactOf(floor, layout)) }),
    ...(floor && { resistance: floor.rolling_resistance, spin_friction: floor.spin_friction }),
    ...(floor && { rolling_drag: floor.rolling_drag, spin_damping: floor.spin_damping, spin_drag: floor.spin_drag }),
    ...pairFields(scene, pairLaw, called, layout),
    together: scene.run.floor_contact === "with", ...airOf(scene, layout).world,
  };
  let pockets = 0; // of the walls before
  const features = scene.walls.flatMap((wall, i) => {
    const law = found[i];
    const number = law.response + (law.response === layout.responses.called ? called.indexOf(law) : 0);
    const { leaves, falls, goes_on: goesOn } = layout.gates;
    const common = { wall: i, contact_time: wall.contact_time, yield_time: wall.yield_time, law: number };
    const gate = placeAt(wall, [0, 0, 0]).encloses ? leaves : goesOn;
    return featuresOf(wall).map(({ pocket, rows, ...one }) => {
      const { form, p, mu, beta } = surfaceOf(scene, surfaceAt(wall, pocket, layout), law, layout);
      const surface = { ...common, form, e: p, mu, beta };
      if (pocket >= 0) return { ...one, ...surface, ends: falls, at: pockets++ };
      const entry = { [rim]: "rim", [curve]: "arc" }[one.kind];
      return { ...one, ...surface, ends: gate, at: entry ? module.address(entry) : 0, ...(rows && { lo1: memory.put(rows.flat()) }) };
    });
  });
  const inAir = airOf(scene, layout).balls;
  const balls = scene.balls.map((ball, i) => ({
    ...inAir[i], radius: ball.radius, mass: ball.mass, kappa: kappaOf(ball), x: centerOf(scene, ball), v: ball.velocity, w: spinOf(ball),
  }));
  return { world, features, balls, called };
}

/** The centre of a ball: with two numbers, on the floor, or in the plane z = 0. @param {Scene} scene @param {Ball} ball @returns {Vec} */
export function centerOf(scene, ball) {
  const [x, y, z] = ball.position;
  return [x, y, z ?? (scene.floor ? ball.radius : 0)];
}
