// The page's state in the part of its address after #: a link restores it. What a link holds is looked at like any file.

/** @import { Engine } from "./compute.js" */
/** @import { Scene } from "./types.js" */
import { checked } from "./compute.js";

const LONGEST = 60_000; // characters of a link that are looked at

/** @typedef {{scene: Scene, laws: string[], followed: string, t: number}} Shown */

/** @param {Shown} shown @param {string} [shot] a preset whose film stands beside the scene @returns {string} */
export function toHash({ scene, laws, followed, t }, shot) {
  const bytes = new TextEncoder().encode(JSON.stringify({ scene, laws, followed, t: Number(t.toPrecision(9)) }));
  let text = "";
  for (const byte of bytes) text += String.fromCharCode(byte);
  return `#${shot ? `preset=${encodeURIComponent(shot)}&` : ""}s=${btoa(text).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "")}`;
}

/**
 * What a link shows; null if the address has no state. Throws an Error, a sentence, for one that cannot be shown.
 * @param {string} hash
 * @param {Engine} engine
 * @param {string[]} known names of laws
 * @returns {Shown | null}
 */
export function fromHash(hash, engine, known) {
  const coded = new URLSearchParams(hash.replace(/^#/, "")).get("s");
  if (coded === null) return null;
  if (coded.length > LONGEST) throw new Error("This link is too long to be one of the explorer's.");
  let found;
  try {
    const text = atob(coded.replaceAll("-", "+").replaceAll("_", "/"));
    found = JSON.parse(new TextDecoder("utf-8", { fatal: true }).decode(Uint8Array.from(text, (c) => c.charCodeAt(0))));
  } catch {
    throw new Error("This link is damaged: it may have been cut off when it was copied.");
  }
  if (typeof found !== "object" || found === null) throw new Error("This link holds no scene.");
  const scene = checked(engine, found.scene);
  const laws = Array.isArray(found.laws) ? known.filter((name) => found.laws.includes(name)) : known;
  const followed = known.includes(found.followed) ? found.followed : "";
  const t = typeof found.t === "number" && found.t >= 0 && found.t < 1e6 ? found.t : 0;
  return { scene, laws, followed, t };
}
