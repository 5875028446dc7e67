// The shapes of what the page's parts hand to each other. SI units throughout.

/** @typedef {[number, number, number]} Vec */

/** A number, or the text "inf". @typedef {number | "inf" | "-inf"} Extended */

/** @typedef {{form: string, value?: number, coefficients?: number[], [key: string]: unknown}} Restitution */

/**
 * @typedef {object} Surface
 * @property {Restitution | null} restitution
 * @property {Extended | null} friction
 * @property {number} tangential_restitution
 */

/** @typedef {Surface & {rolling_resistance: number, spin_friction: number, rolling_drag: number, spin_damping: number, spin_drag: number, slope: [number, number]}} Floor */

/** @typedef {Surface & {shape: string, stiffness_ratio: number, contact_time: number, yield_time: number, law: string | null, name: string | null, [key: string]: any}} Wall */

/**
 * @typedef {object} Ball
 * @property {number} radius
 * @property {number} mass
 * @property {"solid" | "hollow" | number} inertia
 * @property {Vec} position
 * @property {Vec} velocity
 * @property {boolean} rolling
 * @property {Vec | null} spin
 * @property {number | null} spin_z
 * @property {number | string | null} [drag]
 * @property {number | string | null} [lift]
 * @property {number} [spin_decay]
 * @property {string | null} name
 */

/**
 * As `carom scene check FILE --json` prints it.
 * @typedef {object} Scene
 * @property {Vec} gravity
 * @property {Floor | null} floor
 * @property {{density: number, viscosity: number, wind: Vec, buoyancy: boolean} | null} [air]
 * @property {Wall[]} walls
 * @property {Ball[]} balls
 * @property {Omit<Surface, "friction"> & {friction: Extended | {at_rest: number, at_speed: number, speed: number}, law?: string, stiffness_ratio: number | null, young: number, poisson: number, overlap: boolean}} ball_contact
 * @property {{law: string, duration: number | null, max_events: number | null, floor_contact: "with" | "after"}} run
 */

/** @typedef {import("../engine/types.js").Piece} Piece */
/** @typedef {import("../engine/types.js").LoggedEvent} Happening */
/** @typedef {import("../engine/types.js").Run} Run */

/** @typedef {import("../engine/types.js").Verdict} Verdict */

/** A law as the page shows it: its colour and dashes are those of carom's figures.
 * @typedef {{name: string, summary: string, valid: string, colour: string, dashes: number[] | null, reads: string[] | null}} LawCard */

/** Rows of each ball in a film: s of the scene, and m from above. @typedef {[number, number, number][][]} Film */

/** @typedef {{name: string, title: string, about: string, laws: string[], scene: Scene, film?: Film, strikes?: (Strike | null)[], view?: string, slow?: number, time?: number, span?: [number, number]}} Preset */

/** How a cue has struck a ball of a preset: m/s, degrees, and radii to the player's right and up. @typedef {{speed: number, azimuth: number, elevation: number, offset: [number, number]}} Strike */

/** One measured rebound: angles from the wall's normal, degrees. @typedef {{incidence: number, reflection: number, stage: string}} Rebound */

export {};
