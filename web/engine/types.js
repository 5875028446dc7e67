// What engine.json holds (carom.explorer.module), and what the engine returns.

/** @import { Vec } from "../state/types.js" */

/** Where a field of a record is: offset in bytes, number of items, whether they are whole numbers of 8 bytes. @typedef {{at: number, count: number, whole: boolean}} Place */

/** @typedef {{bytes: number, fields: Record<string, Place>}} RecordLayout */

/** A condition or an objection of a law: a function of the module, its sentence with places for two numbers, the field of a wall concerned.
 * @typedef {{function: string, text: string, field: string}} Rule */

/**
 * @typedef {object} Law
 * @property {string} name
 * @property {string} title
 * @property {string[]} assumptions
 * @property {string} valid
 * @property {string} citation
 * @property {string} doi
 * @property {string[] | null} parameters parameters of wall and floor that it reads; null: unknown
 * @property {{name: string, [value: string]: string}[]} needed fields that a wall must have, with the values of the text of that fault
 * @property {Record<string, number | "inf">} pinned
 * @property {number} response
 * @property {string} function
 * @property {"tangential_restitution" | "stiffness_ratio" | "floor_friction"} last
 * @property {Record<string, number>} defaults its authors' parameters, where a wall has none
 * @property {string} on_table the law that it equals but for the vertical velocity, which stays zero; else empty
 * @property {string} order of wall and floor, of a law that answers as the two-step law does: "scene", "with" or "after"; else empty
 * @property {string} variant_of
 * @property {boolean} one_contact whether the engine's own contact of two balls is this law
 * @property {Vec | null} slip_friction
 * @property {boolean} ignores_floor
 * @property {string | null} colour
 * @property {number[]} dashes
 * @property {Rule[]} conditions
 * @property {Rule[]} objections
 */

/** @typedef {{field: string, expected: string, got: string, advice: string}} FaultText */

/** `numbers`: how many numbers each field takes in what its kernels are given, 0: a list after its length; of a part, its fields; `pockets`: places of them.
 * @typedef {{numbers: Record<string, number | string[]>, faults: FaultText[], pockets?: string[]}} Ruled */

/**
 * A field of a scene, as carom.explorer.module writes it.
 * @typedef {object} Field
 * @property {string} kind number, vector, list, flag, choice, text, whole, part, tagged: a part by its tag
 * @property {string} what is expected in its place
 * @property {string} [of] name of the part that it is
 * @property {any} [least] of a list: what it holds at least, in words
 * @property {number | null} [most]
 * @property {boolean} [above]
 * @property {boolean} [infinite]
 * @property {[number, number]} [counts]
 * @property {Field} [each]
 * @property {boolean} [nonzero]
 * @property {string[]} [values]
 * @property {string[]} [words] that stand for a number
 * @property {boolean} [optional]
 * @property {string} [part] that may stand in the place of a number
 * @property {Record<string, Field>} [fields] of a part
 * @property {string | null} [rules] of a part
 * @property {string} [tag]
 * @property {Record<string, Field>} [options]
 */

/**
 * @typedef {object} Layout
 * @property {string} version
 * @property {Record<string, RecordLayout>} records
 * @property {string[]} functions
 * @property {Record<string, number>} features
 * @property {number} first_cushion what stands in the column of pockets of a feature of cushion 0; of cushion k it is less by k
 * @property {Record<string, number>} gates
 * @property {string[]} kinds
 * @property {string[]} phases
 * @property {string[]} regimes
 * @property {Record<string, number>} forms
 * @property {Vec} han2005
 * @property {string[]} reasons
 * @property {Record<string, number>} run
 * @property {Record<string, string>} refusals
 * @property {Record<string, number>} responses
 * @property {Law[]} laws
 * @property {Record<string, Record<"drag" | "lift", number[][]>>} air_laws segments: p0, p1, p2, p3, q, r, their end, and whether that is of S
 * @property {Record<"least_firm" | "balls" | "features of walls", number>} limits of laws, and of a page
 * @property {Record<string, Ruled>} shapes
 * @property {Record<string, Ruled>} parts
 * @property {FaultText[]} scene_faults
 * @property {Record<string, FaultText>} law_faults
 * @property {FaultText} vanishes of a wall whose features cannot be computed
 * @property {Record<string, Field>} fields
 * @property {Record<string, string>} built_with
 */

/** A shot of a ball: m/s, rad/s. @typedef {{velocity: Vec, spin?: Vec}} Start */

/** What a ball met, and when, s; `other`: the number of the wall, ball or pocket. @typedef {{t: number, met: "wall" | "ball" | "pocketed", ball: number, other: number}} Impact */

/** `enough`: whether the rows of the log that were written last are all that is wanted. @typedef {{events?: number, until?: number, milliseconds?: number, enough?: (last: {at: number, rows: number}) => boolean}} Limits */

/** A recorded run: its log (gzip, base64), how and when it ended, and why the page does not run it. @typedef {{log: string, status: "done" | "quiet" | "limit", end: number, why: string}} Recording */

/**
 * @typedef {object} LoggedEvent
 * @property {number} t
 * @property {string} kind wall, floor, ball; rolling, pivoting, rest: the phase that begins; settled, left, held, pocketed
 * @property {number} ball
 * @property {"wall" | "ball" | "pocketed" | null} met what `other` is the number of
 * @property {number} other -1 for none
 * @property {Vec} x
 * @property {Vec} v_before
 * @property {Vec} w_before
 * @property {Vec} v
 * @property {Vec} w
 * @property {string} phase_before
 * @property {string} phase
 * @property {Vec} impulse N s
 * @property {Vec} floor_impulse N s
 * @property {number} required friction
 * @property {string | null} regime
 */

/** Position x + v s + acc s^2/2 and spin w + turn s for s from 0 to lasts. @typedef {{t: number, lasts: number, x: Vec, v: Vec, w: Vec, acc: Vec, turn: Vec, phase: string}} Piece */

/**
 * @typedef {object} Run
 * @property {"done" | "quiet" | "limit" | "time" | "refused"} status the end was reached; nothing more happens; so many events, or so long a computation; the law has no answer
 * @property {string} why why a law has no answer, else empty
 * @property {number} until
 * @property {LoggedEvent[]} events
 * @property {{x: Vec, v: Vec, w: Vec, phase: string}[]} final
 * @property {{pieces: Piece[]}[]} balls
 */

/**
 * What one law says of the first ball at the first wall.
 * @typedef {object} Verdict
 * @property {string} law
 * @property {number | null} angle final angle from the wall's normal, degrees; null where there is none
 * @property {number | null} angle_after_wall
 * @property {Vec | null} velocity final
 * @property {Vec | null} spin final
 * @property {{velocity: Vec, spin: Vec} | null} after_wall
 * @property {number | null} energy_kept final over incident kinetic energy
 * @property {number | null} hop m: height of the flight; null for laws without one
 * @property {number | null} flight m: its length
 * @property {number | null} required friction of the wall
 * @property {number} available friction of the wall
 * @property {number | null} required_floor
 * @property {number | null} available_floor
 * @property {boolean} admissible
 * @property {string[]} reasons why it may not apply
 */

export {};
