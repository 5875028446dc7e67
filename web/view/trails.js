// Trails: a full line where a ball rolls, dashes where it slides, dots with threads to the floor where it flies; dots of a film.

/** @import { Shot } from "./shot.js" */
/** @import { Vec } from "../state/types.js" */
import { BufferGeometry, Float32BufferAttribute, Group, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, Points, PointsMaterial, RingGeometry } from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import { placeAt } from "../state/film.js";
import { trail } from "../state/motion.js";
import { dotsOf, sizeOf } from "./shot.js";

/** Dashes and gaps, in hundredths of what is seen. @type {Record<string, [number, number] | null>} */
const DASHES = { rolling: null, sliding: [1.5, 0.9], flight: [0.28, 0.55] };

/** @param {Vec[]} points */
function pairs(points) {
  const found = [];
  for (let i = 0; i + 1 < points.length; i++) found.push(...points[i], ...points[i + 1]);
  return found;
}

/** Size of a film's dots, px. */
const DOT = 2;
const RING = new RingGeometry(1.05, 1.3, 48);

/** All trails. Lines and materials are kept from change to change: a new one would have its shaders compiled anew. */
export class Trails {
  constructor() {
    this.group = new Group();
    /** @type {Map<string, LineSegments2 | LineSegments>} */
    this.lines = new Map();
    /** Of a film: of each ball its places, and the one at the time that is shown. @type {[Points<BufferGeometry, PointsMaterial>, Mesh<RingGeometry, MeshBasicMaterial>][]} */
    this.dots = [];
    this.pixels = { width: 1, height: 1 };
  }

  /** @param {string} key @param {number[]} points @param {string} style @param {import("three").ColorRepresentation} colour @param {number} width @param {number} opacity @param {number} unit @param {boolean} leads */
  #draw(key, points, style, colour, width, opacity, unit, leads) {
    const thread = style === "thread";
    let line = this.lines.get(key);
    if (!line) {
      line = thread
        ? new LineSegments(new BufferGeometry(), new LineBasicMaterial({ transparent: true, depthWrite: false }))
        : new LineSegments2(new LineSegmentsGeometry(), new LineMaterial({ dashed: DASHES[style] !== null, transparent: true, depthWrite: false }));
      line.frustumCulled = false;
      this.lines.set(key, line);
      this.group.add(line);
    }
    line.geometry.dispose();
    const material = /** @type {LineMaterial | LineBasicMaterial} */ (line.material);
    material.color.set(colour);
    material.opacity = opacity;
    line.renderOrder = leads ? 3 : 2;
    line.visible = true;
    if (line instanceof LineSegments2) {
      const dashes = DASHES[style];
      line.geometry = new LineSegmentsGeometry().setPositions(points);
      line.material.linewidth = width;
      line.material.resolution.set(this.pixels.width, this.pixels.height);
      if (dashes) {
        line.material.dashSize = dashes[0] * unit;
        line.material.gapSize = dashes[1] * unit;
        line.computeLineDistances();
      }
    } else {
      line.geometry = new BufferGeometry();
      line.geometry.setAttribute("position", new Float32BufferAttribute(points, 3));
    }
  }

  /** Draw where a film saw the balls, in an ink that their paths have not. @param {Shot} shot @param {string} ink */
  film(shot, ink) {
    shot.scene.balls.forEach(({ radius: a }, i) => {
      const [dots, ring] = (this.dots[i] ??= this.#dots());
      dots.material.color.set(ink);
      ring.material.color.set(ink);
      ring.scale.setScalar(a);
      dots.geometry.setAttribute("position", new Float32BufferAttribute(dotsOf(shot.film[i] ?? [], shot.box).flatMap(([, x, y]) => [x, y, a]), 3));
    });
  }

  /** Dots and a ring of one ball. @returns {[Points<BufferGeometry, PointsMaterial>, Mesh<RingGeometry, MeshBasicMaterial>]} */
  #dots() {
    const look = { transparent: true, depthWrite: false };
    const dots = new Points(new BufferGeometry(), new PointsMaterial({ size: DOT, sizeAttenuation: false, ...look }));
    const ring = new Mesh(RING, new MeshBasicMaterial({ ...look, depthTest: false }));
    dots.frustumCulled = false;
    dots.renderOrder = ring.renderOrder = 4;
    this.group.add(dots, ring);
    return [dots, ring];
  }

  /** Set the rings to where the film saw the balls at a time. @param {Shot} shot @param {number} t */
  filmAt(shot, t) {
    this.dots.forEach(([, ring], i) => {
      const place = shot.film[i] && placeAt(shot.film[i], t);
      ring.visible = Boolean(place);
      if (place) ring.position.set(...place, shot.scene.balls[i].radius);
    });
  }

  /** @param {Shot} shot @param {(ball: number) => string} bodyColour */
  update(shot, bodyColour) {
    for (const line of this.lines.values()) line.visible = false;
    const unit = sizeOf(shot.box) / 100;
    const many = shot.scene.balls.length > 6;
    const crowd = shot.scene.balls.length > 60; // whose paths would hide each other
    for (const [law, run] of shot.runs) {
      const leads = law === shot.followed;
      run.balls.forEach(({ pieces }, i) => {
        const edited = i === shot.ball;
        if (!edited && (!leads || crowd)) return;
        const colour = (edited ? shot.colours.get(law) : null) ?? bodyColour(i);
        /** @type {Record<string, number[]>} */
        const found = { rolling: [], sliding: [], flight: [], thread: [] };
        for (const { style, points } of trail(pieces, shot.span, shot.scene.balls[i].radius)) {
          // (without a floor there is nothing but flight)
          found[shot.scene.floor ? style : "rolling"].push(...pairs(points));
          if (style !== "flight" || !shot.scene.floor || many) continue;
          const a = shot.scene.balls[i].radius;
          for (const p of points) if (p[2] > a * 1.001 && p[2] < 5 * a) found.thread.push(...p, p[0], p[1], 0);
        }
        for (const [style, points] of Object.entries(found)) {
          if (!points.length) continue;
          const opacity = style === "thread" ? 0.35 : edited ? 1 : many ? 0.45 : 0.75;
          this.#draw(`${law} ${i} ${style}`, points, style, colour, edited ? (leads ? 3.4 : 2.4) : 1.4, opacity, unit, leads);
        }
      });
    }
  }

  /** @param {number} width @param {number} height */
  resize(width, height) {
    this.pixels = { width, height };
    for (const line of this.lines.values()) if (line instanceof LineSegments2) line.material.resolution.set(width, height);
  }
}
