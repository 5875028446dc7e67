// Balls with marks, so that one sees them spin; their shadows; the ghost of one ball under each other law.

import {
  CanvasTexture, CircleGeometry, Color, Group, Mesh, MeshBasicMaterial, MeshLambertMaterial, RingGeometry, SRGBColorSpace, SphereGeometry,
} from "three";

/** @import { Ball } from "../state/types.js" */
/** @import { Quaternion } from "../state/motion.js" */

const NAMED = { white: "#f4f1e8", yellow: "#f0c43c", red: "#c63a32", blue: "#3569b0", green: "#2f8559", black: "#33353a", pink: "#dd8fa6", brown: "#8a5a3a" };
const OTHERS = ["#f4f1e8", "#c63a32", "#f0c43c", "#3569b0", "#2f8559", "#d9822b", "#7d4fa0", "#8a5a3a", "#dd8fa6", "#4aa3a2"];

/** @param {Ball} ball @param {number} i */
export const ballColour = (ball, i) => NAMED[/** @type {keyof typeof NAMED} */ ((ball.name ?? "").toLowerCase().split(" ")[0])] ?? OTHERS[i % OTHERS.length];

/** A ball's surface: one colour, a band, and six dots. @param {string} body @param {string} mark @returns {CanvasTexture} */
function marks(body, mark) {
  const canvas = document.createElement("canvas");
  canvas.width = 256;
  canvas.height = 128;
  const c = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
  c.fillStyle = body;
  c.fillRect(0, 0, 256, 128);
  c.fillStyle = mark;
  // a dot is wider on the map the nearer it is to a pole
  const dot = (/** @type {number} */ u, /** @type {number} */ v) => {
    c.beginPath();
    c.ellipse(u, v, 12 / Math.max(Math.sin((v / 128) * Math.PI), 0.05), 12, 0, 0, 7);
    c.fill();
  };
  for (const u of [32, 96, 160, 224]) dot(u, 64);
  c.fillRect(0, 0, 256, 12);
  c.fillRect(0, 116, 256, 12);
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  return texture;
}

let shadowMap = /** @type {CanvasTexture | null} */ (null);
function shadowTexture() {
  if (shadowMap) return shadowMap;
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 128;
  const c = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
  const fade = c.createRadialGradient(64, 64, 20, 64, 64, 64);
  fade.addColorStop(0, "rgba(0,0,0,1)");
  fade.addColorStop(0.55, "rgba(0,0,0,0.75)");
  fade.addColorStop(1, "rgba(0,0,0,0)");
  c.fillStyle = fade;
  c.fillRect(0, 0, 128, 128);
  return (shadowMap = new CanvasTexture(canvas));
}

const sphere = new SphereGeometry(1, 40, 20).rotateX(Math.PI / 2);
const disc = new CircleGeometry(1, 32);
const ring = new RingGeometry(1.16, 1.34, 48);

/** One drawn ball. `halo`: the colour of the law that it follows. */
export class BallMesh {
  /** @param {string} body @param {string} mark @param {{ghost?: boolean, halo?: string | null, floor: boolean, dark: boolean}} look */
  constructor(body, mark, { ghost = false, halo = null, floor, dark }) {
    this.radius = 1;
    this.group = new Group();
    const map = marks(body, mark);
    const material = new MeshLambertMaterial({ map, transparent: ghost, opacity: ghost ? 0.55 : 1, depthWrite: true });
    this.ball = new Mesh(sphere, material);
    this.group.add(this.ball);
    /** @type {Mesh<any, MeshBasicMaterial> | null} */
    this.shadow = null;
    if (floor) {
      const shade = new MeshBasicMaterial({ map: shadowTexture(), transparent: true, opacity: (dark ? 0.75 : 0.42) * (ghost ? 0.5 : 1), depthWrite: false });
      this.shadow = new Mesh(disc, shade);
      this.group.add(this.shadow);
    }
    /** @type {Mesh | null} */
    this.halo = null;
    if (halo && floor) {
      this.halo = new Mesh(ring, new MeshBasicMaterial({ color: new Color(halo), transparent: true, opacity: ghost ? 0.8 : 1, depthWrite: false }));
      this.group.add(this.halo);
    }
  }

  /** @param {number} radius */
  resize(radius) {
    this.radius = radius;
    this.ball.scale.setScalar(radius);
    this.halo?.scale.setScalar(radius);
  }

  /** @param {number[]} x @param {Quaternion} q @param {number} apart from the ball that leads, m: a ghost in its place is not drawn */
  place(x, q, apart) {
    this.group.visible = apart > 0.02 * this.radius;
    if (!this.group.visible) return;
    if (apart < Infinity) /** @type {MeshLambertMaterial} */ (this.ball.material).opacity = 0.6 * Math.min(1, apart / this.radius);
    this.ball.position.set(x[0], x[1], x[2]);
    this.ball.quaternion.set(q[1], q[2], q[3], q[0]);
    const lift = Math.max(0, x[2] - this.radius);
    if (this.shadow) {
      // a low sun: the shadow of a ball that is 2 mm up has moved by 3
      this.shadow.position.set(x[0] - 0.5 * lift - 0.06 * this.radius, x[1] + 1.4 * lift + 0.14 * this.radius, 0.004 * this.radius);
      this.shadow.scale.setScalar(this.radius * (1.12 + Math.min(1, (0.25 * lift) / this.radius)));
    }
    if (this.halo) this.halo.position.set(x[0], x[1], 0.008 * this.radius);
  }
}
