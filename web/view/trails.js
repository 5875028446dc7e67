// Trails: a full line where a ball rolls, dashes where it slides, dots with threads to the floor where it flies.

/** @import { Shot } from "./shot.js" */
/** @import { Vec } from "../state/types.js" */
import { BufferGeometry, Color, Float32BufferAttribute, Group, LineBasicMaterial, LineSegments } from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import { trail } from "../state/motion.js";
import { sizeOf } from "./shot.js";

/** Dashes and gaps, in hundredths of what is seen. @type {Record<string, [number, number] | null>} */
const DASHES = { rolling: null, sliding: [1.5, 0.9], flight: [0.28, 0.55] };

/** @param {Vec[]} points */
function pairs(points) {
  const found = [];
  for (let i = 0; i + 1 < points.length; i++) found.push(...points[i], ...points[i + 1]);
  return found;
}

/**
 * @param {Shot} shot
 * @param {{width: number, height: number}} pixels
 * @param {(ball: number) => string} bodyColour
 * @returns {Group}
 */
export function trailLines(shot, pixels, bodyColour) {
  const group = new Group();
  const unit = sizeOf(shot.box) / 100;
  const many = shot.scene.balls.length > 6;
  for (const [law, run] of shot.runs) {
    const leads = law === shot.followed;
    run.balls.forEach(({ pieces }, i) => {
      if (!leads && i !== shot.ball) return;
      const edited = i === shot.ball;
      const colour = new Color(edited ? shot.colours.get(law) : bodyColour(i));
      /** @type {Record<string, number[]>} */
      const found = { rolling: [], sliding: [], flight: [] };
      /** @type {number[]} */
      const threads = [];
      for (const { style, points } of trail(pieces, shot.until)) {
        found[style].push(...pairs(points));
        if (style !== "flight" || !shot.scene.floor || many) continue;
        for (const p of points) if (p[2] > shot.scene.balls[i].radius * 1.001) threads.push(...p, p[0], p[1], 0);
      }
      for (const [style, points] of Object.entries(found)) {
        if (!points.length) continue;
        const dashes = DASHES[style];
        const material = new LineMaterial({
          color: colour.getHex(), linewidth: edited ? (leads ? 3.4 : 2.4) : 1.4, dashed: dashes !== null, transparent: true,
          opacity: edited ? 1 : many ? 0.45 : 0.75, depthWrite: false,
        });
        if (dashes) {
          material.dashSize = dashes[0] * unit;
          material.gapSize = dashes[1] * unit;
        }
        material.resolution.set(pixels.width, pixels.height);
        const line = new LineSegments2(new LineSegmentsGeometry().setPositions(points), material);
        if (dashes) line.computeLineDistances();
        line.renderOrder = leads ? 3 : 2;
        group.add(line);
      }
      if (threads.length) {
        const made = new BufferGeometry();
        made.setAttribute("position", new Float32BufferAttribute(threads, 3));
        group.add(new LineSegments(made, new LineBasicMaterial({ color: colour, transparent: true, opacity: 0.35, depthWrite: false })));
      }
    });
  }
  return group;
}
