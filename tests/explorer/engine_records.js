// For tests: the bytes of the records that a scene becomes, and of the log of its run.

import { follow } from "/web/engine/run.js";
import { setUp } from "/web/scene/setup.js";

/** @param {Uint8Array} bytes */
const text = (bytes) => {
  let found = "";
  for (let i = 0; i < bytes.length; i += 4096) found += String.fromCharCode(...bytes.subarray(i, i + 4096));
  return btoa(found);
};

export function recordsOf(engine, scene, limits) {
  const { module } = engine;
  const { records } = module.layout;
  module.memory.clear();
  const made = setUp(scene, module);
  const at = {
    world: module.memory.records(records.world, [made.world]),
    features: module.memory.records(records.features, made.features),
    balls: module.memory.records(records.balls, made.balls),
  };
  const bytes = (from, count) => new Uint8Array(module.exports.memory.buffer, from, count);
  const found = {
    world: text(bytes(at.world, records.world.bytes)),
    features: text(bytes(at.features, records.features.bytes * made.features.length)),
    balls: text(bytes(at.balls, records.balls.bytes * made.balls.length)),
  };
  const { logs, status, end } = follow(module, scene, limits);
  return { ...found, log: logs.map((part) => text(bytes(part.at, part.rows * records.log.bytes))), status, end };
}
