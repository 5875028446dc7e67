// What the page says of a ball that a cue has struck: its scene holds the velocity and the spin that the strike gives.

/** @import { Ball, Preset, Scene, Strike } from "../state/types.js" */
import { shown } from "./dom.js";

/** A strike in words. @param {Strike} strike */
function inWords({ speed, azimuth, elevation, offset: [right, up] }) {
  const sides = [right && `${shown(Math.abs(right))} to the ${right > 0 ? "right" : "left"}`, up && `${shown(Math.abs(up))} ${up > 0 ? "up" : "down"}`].filter(Boolean);
  const where = sides.length ? `offset ${sides.join(" and ")} (in ball radii)` : "at the centre";
  return `${shown(speed)} m/s, azimuth ${shown(azimuth, 4)}°, ${elevation ? `elevation ${shown(elevation)}°, ` : ""}${where}`;
}

/** What a strike gives, and what it depends on, of a ball. @param {Ball} ball */
const moved = ({ velocity, spin, rolling, radius, mass, inertia }) => JSON.stringify([velocity, spin, rolling, radius, mass, inertia]);

/** Whether a scene is one of a preset's, changed or not. @param {Scene} scene */
const kindOf = ({ balls, walls }) => JSON.stringify([balls.map(({ name }) => name), walls.map(({ shape }) => shape)]);

/** What to say of each ball; empty where no cue has struck it. @param {Preset[]} presets @returns {(scene: Scene, ball: number) => string} */
export function strikeNotes(presets) {
  const preset = presets.find(({ strikes }) => strikes);
  return (scene, ball) => {
    const strike = preset?.strikes?.[ball];
    if (!preset || !strike || kindOf(scene) !== kindOf(preset.scene)) return "";
    if (moved(scene.balls[ball]) === moved(preset.scene.balls[ball])) {
      return `Struck by a cue: ${inWords(strike)}. Below are the velocity and the spin that it gives; changing one of them replaces the strike.`;
    }
    return `The cue's strike (${inWords(strike)}) is replaced by the velocity and the spin that are set here; undo brings it back.`;
  };
}
