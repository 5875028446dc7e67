// The scene in three dimensions. Nothing is drawn unless something has changed.

/** @import { Drag, Palette, Shot, View } from "./shot.js" */
/** @import { Vec } from "../state/types.js" */
import {
  AmbientLight, BufferGeometry, Color, ConeGeometry, CylinderGeometry, DirectionalLight, Float32BufferAttribute, Group, LineBasicMaterial,
  LineSegments, Mesh, MeshBasicMaterial, PerspectiveCamera, Plane, PlaneGeometry, Quaternion, Raycaster, RingGeometry, Scene, Vector2, Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { Orientation, stateAt } from "../state/motion.js";
import { unit } from "../state/vectors.js";
import { lengthText } from "../panels/dom.js";
import { BallMesh, ballColour } from "./balls.js";
import { oncePerFrame } from "./frames.js";
import { arrowTime, middleOf, sizeOf } from "./shot.js";
import { Trails } from "./trails.js";
import { dispose, wallMeshes } from "./walls.js";

const REACH = 26; // pixels around a handle in which it is grasped
const SHORTEST_ARROW = 1.8; // radii: the arrow of a slow ball can still be grasped

/** A length that people like, near a value. @param {number} value */
export function roundLength(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  const first = value / power;
  return (first >= 5 ? 5 : first >= 2 ? 2 : 1) * power;
}

/** A round length with its unit. @param {number} metres */
export function roundText(metres) {
  const [size, unit] = /** @type {[number, string]} */ ([[1e3, "km"], [1, "m"], [1e-3, "mm"], [1e-6, "µm"], [1e-9, "nm"]].find(([least]) => metres >= Number(least) * (1 - 1e-9)) ?? [1e-9, "nm"]);
  return `${Number((metres / size).toPrecision(1))} ${unit}`;
}

/** Whether the processor draws, for want of a graphics card: smooth edges would make it three times as slow. */
function drawnBySoftware() {
  const probe = document.createElement("canvas").getContext("webgl2");
  const names = probe?.getExtension("WEBGL_debug_renderer_info");
  const name = probe && names ? String(probe.getParameter(names.UNMASKED_RENDERER_WEBGL)) : "";
  probe?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

/**
 * @param {HTMLElement} host
 * @param {Drag | null} drag what to do when the ball or its arrow is dragged; null: neither can be
 * @param {{scale: HTMLElement, height: HTMLElement}} labels
 * @returns {View}
 */
export function stage(host, drag, labels) {
  const renderer = new WebGLRenderer({ antialias: !drawnBySoftware(), alpha: false, powerPreference: "low-power" });
  const canvas = renderer.domElement;
  canvas.tabIndex = 0;
  canvas.setAttribute("role", "img");
  host.prepend(canvas);

  const scene = new Scene();
  const camera = new PerspectiveCamera(30, 1, 0.01, 100);
  camera.up.set(0, 0, 1);
  const sun = new DirectionalLight("#ffffff", 2.3);
  sun.position.set(0.5, -1, 2.1);
  const ambient = new AmbientLight("#ffffff", 1.35);
  scene.add(sun, ambient);

  /** @type {Shot | null} */
  let shot = null;
  let now = 0;
  const request = oncePerFrame(render);
  const gaze = new Vector3();
  /** Floor and walls, and what they were made of. @type {{groups: Group[], of: string}} */
  let fixed = { groups: [], of: "" };
  /** @type {Map<string, BallMesh>} */
  const meshes = new Map();
  /** @type {{mesh: BallMesh, turns: Orientation, law: string, ball: number}[]} */
  let balls = [];
  const trails = new Trails();
  const arrow = makeArrow();
  // All that is drawn, in metres. The camera's own units are others where the scene is very small, very large or far away: its
  // controls and the depth of the picture have fixed numbers.
  const world = new Group();
  world.add(arrow.group, trails.group);
  scene.add(world);
  /** Where a point of the scene is for the camera. @param {Vector3} p */
  const seenAt = (p) => p.clone().multiplyScalar(world.scale.x).add(world.position);
  const size = { width: 1, height: 1 }; // of the canvas, in pixels of the page

  // --- dragging: before the controls hear of it ------------------------------------------------------------------
  const caster = new Raycaster();
  /** @type {"ball" | "velocity" | null} */
  let grasped = null;
  let offset = [0, 0];

  /** @param {PointerEvent} event */
  const pixel = (event) => {
    const area = canvas.getBoundingClientRect();
    return new Vector2(event.clientX - area.left, event.clientY - area.top);
  };
  /** @param {Vector3} p */
  const project = (p) => {
    const q = seenAt(p).project(camera);
    return new Vector2(((q.x + 1) / 2) * size.width, ((1 - q.y) / 2) * size.height);
  };
  /** Where a pixel meets the horizontal plane of the edited ball's centre. @param {Vector2} at */
  const onPlane = (at) => {
    if (!shot) return null;
    const z = shot.scene.balls[shot.ball].position[2];
    caster.setFromCamera(new Vector2((at.x / size.width) * 2 - 1, 1 - (at.y / size.height) * 2), camera);
    if (Math.abs(caster.ray.direction.z) < 0.03) return null; // seen along the floor
    const hit = caster.ray.intersectPlane(new Plane(new Vector3(0, 0, 1), -seenAt(new Vector3(0, 0, z)).z), new Vector3());
    return hit && hit.sub(world.position).divideScalar(world.scale.x);
  };
  /** What a pixel grasps. @param {Vector2} at @returns {"ball" | "velocity" | null} */
  const handle = (at) => {
    if (!shot || !arrow.group.visible) return null;
    const ball = shot.scene.balls[shot.ball];
    const centre = new Vector3(...ball.position);
    const side = new Vector3(1, 0, 0).applyQuaternion(camera.quaternion).multiplyScalar(ball.radius);
    const radius = Math.max(project(centre).distanceTo(project(centre.clone().add(side))), REACH * 0.7);
    if (project(arrow.tip).distanceTo(at) < REACH) return "velocity";
    return project(centre).distanceTo(at) < radius ? "ball" : null;
  };
  canvas.addEventListener("pointerdown", (event) => {
    if (event.button !== 0 || !event.isPrimary || !shot) return;
    const at = pixel(event);
    const what = handle(at);
    const hit = what && onPlane(at);
    if (!what || !hit) return;
    grasped = what;
    controls.enabled = false;
    canvas.setPointerCapture(event.pointerId);
    const from = what === "ball" ? shot.scene.balls[shot.ball].position : arrow.tip.toArray();
    offset = [from[0] - hit.x, from[1] - hit.y];
    drag?.start();
  });
  canvas.addEventListener("pointermove", (event) => {
    const at = pixel(event);
    if (!grasped) {
      if (event.buttons === 0) canvas.style.cursor = handle(at) ? "grab" : "";
      return;
    }
    const hit = onPlane(at);
    if (!hit || !shot) return;
    canvas.style.cursor = "grabbing";
    const [x, y] = [hit.x + offset[0], hit.y + offset[1]];
    if (grasped === "ball") drag?.ball(x, y);
    else {
      const { position, radius } = shot.scene.balls[shot.ball];
      const away = Math.hypot(x - position[0], y - position[1]);
      const speed = Math.max(0, away - SHORTEST_ARROW * radius) / arrow.time;
      drag?.velocity((speed * (x - position[0])) / (away || 1), (speed * (y - position[1])) / (away || 1));
    }
  });
  const release = () => {
    if (!grasped) return;
    grasped = null;
    controls.enabled = true;
    canvas.style.cursor = "";
    arrow.time = shot ? arrowTime(shot) : 1;
    placeArrow();
    drag?.end();
    request();
  };
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);

  const controls = new OrbitControls(camera, canvas);
  controls.zoomSpeed = 0.8;
  controls.maxPolarAngle = Math.PI * 0.499;
  controls.addEventListener("change", () => request());
  /** The side that the camera looks from; null once a hand has moved it. @type {string | null} */
  let side = null;
  controls.addEventListener("start", () => (side = null));

  function placeArrow() {
    if (!shot) return;
    const { position, velocity, radius } = shot.scene.balls[shot.ball];
    const speed = Math.hypot(velocity[0], velocity[1]);
    const way = speed > 0 ? [velocity[0] / speed, velocity[1] / speed] : [1, 0];
    arrow.place(position, way, SHORTEST_ARROW * radius + speed * arrow.time, radius, sizeOf(shot.box));
  }

  /** @param {Shot} next @param {Palette} palette */
  function update(next, palette) {
    const reframe = !shot || shot.box !== next.box;
    shot = next;
    scene.background = new Color(palette.background);
    const of = JSON.stringify([next.scene.walls, Boolean(next.scene.floor), next.box, palette, next.scene.balls.map(({ radius }) => radius)]);
    if (of !== fixed.of) {
      const groups = [floorGrid(next, palette), wallMeshes(next.scene, next.box, palette)];
      world.add(...groups);
      for (const group of fixed.groups) {
        world.remove(group);
        dispose(group);
      }
      fixed = { groups, of };
    }
    trace(next.span);
    for (const { mesh } of balls) world.remove(mesh.group);
    balls = [];
    for (const [law, run] of next.runs) {
      const leads = law === next.followed;
      run.balls.forEach(({ pieces }, i) => {
        if (!leads && i !== next.ball) return;
        const colour = next.colours.get(law) ?? palette.ink;
        const edited = i === next.ball;
        const body = leads ? ballColour(next.scene.balls[i], i) : colour;
        const mark = leads ? (edited ? colour : "#2b2f36") : palette.dark ? "#15181d" : "#ffffff";
        const look = { ghost: !leads, halo: edited ? colour : null, floor: Boolean(next.scene.floor), dark: palette.dark };
        const key = JSON.stringify([law, i, body, mark, look]);
        const mesh = meshes.get(key) ?? new BallMesh(body, mark, look);
        meshes.set(key, mesh);
        mesh.resize(next.scene.balls[i].radius);
        world.add(mesh.group);
        balls.push({ mesh, turns: new Orientation(pieces), law, ball: i });
      });
    }
    arrow.colour(palette.ink);
    trails.film(next, palette.ink);
    if (!grasped) arrow.time = arrowTime(next);
    placeArrow();
    if (reframe) look("free");
    draw(now);
  }

  /** @param {{from: number, until: number}} span */
  function trace(span) {
    if (!shot) return;
    const { balls } = shot.scene;
    trails.update({ ...shot, span }, (i) => ballColour(balls[i], i));
  }

  /** @param {number} t */
  function draw(t) {
    now = t;
    request();
  }

  function render() {
    if (!shot) return;
    const leads = shot.runs.get(shot.followed);
    const solid = leads ? stateAt(leads.balls[shot.ball].pieces, now).x : null;
    for (const { mesh, turns, law } of balls) {
      const { x, phase } = stateAt(turns.pieces, now);
      if (phase === "pocketed") {
        mesh.group.visible = false;
        continue;
      }
      const apart = law === shot.followed || !solid ? Infinity : Math.hypot(x[0] - solid[0], x[1] - solid[1], x[2] - solid[2]);
      mesh.place(x, turns.at(now), apart);
    }
    trails.filmAt(shot, now);
    // (seen along the floor, nothing can be dragged over it; the dots of a film are not to be taken for its shaft)
    arrow.group.visible = drag !== null && !(shot.film.length && now > shot.span.from) && Math.abs(camera.getWorldDirection(gaze).z) > 0.12;
    renderer.render(scene, camera);
    label(solid);
    // where hands, and tests, find the handles
    const at = [new Vector3(...shot.scene.balls[shot.ball].position), arrow.tip].map((p) => project(p).toArray().map(Math.round).join());
    [canvas.dataset.ball, canvas.dataset.arrow] = at;
  }

  /** The scale, and how high the ball is. @param {Vec | null} x */
  function label(x) {
    if (!shot) return;
    const away = camera.position.distanceTo(controls.target);
    const perMetre = (size.height * world.scale.x) / (2 * away * Math.tan((camera.fov * Math.PI) / 360));
    const bar = roundLength(110 / perMetre);
    const wide = `${(bar * perMetre).toFixed(1)}px`;
    if (labels.scale.style.width !== wide) {
      labels.scale.style.width = wide;
      labels.scale.textContent = roundText(bar);
    }
    const { radius } = shot.scene.balls[shot.ball];
    const lift = x && shot.scene.floor ? x[2] - radius : 0;
    const shown = lift > Math.min(2e-5, 2e-3 * radius);
    labels.height.hidden = !(x && shown);
    if (x && shown) {
      const at = project(new Vector3(x[0], x[1], x[2] + radius));
      const usual = lift < 0.1 ? `${(lift * 1e3).toPrecision(2)} mm` : `${lift.toPrecision(3)} m`;
      labels.height.textContent = `${lift < 1e-5 || lift >= 1e3 ? lengthText(lift) : usual} up`;
      labels.height.style.transform = `translate(${at.x.toFixed(1)}px, ${(at.y - 26).toFixed(1)}px) translateX(-50%)`;
    }
  }

  /** Look at the scene from a named side. @param {string} name */
  function look(name) {
    if (!shot) return;
    side = name;
    const { low, high } = shot.box;
    const target = new Vector3(...middleOf(shot.box));
    const plane = shot.scene.walls.find((wall) => wall.shape === "plane" && Math.hypot(wall.normal[0], wall.normal[1]) > 0.3);
    const first = shot.runs.get(shot.followed)?.events.find((event) => event.kind === "wall" && event.ball === shot?.ball);
    const n = plane ? unit([plane.normal[0], plane.normal[1], 0]) : name === "along" && first ? facing(first.impulse) : [0, -1, 0];
    const out = new Vector3(n[0], n[1], 0);
    const along = new Vector3(-n[1], n[0], 0);
    /** @type {Vector3[]} */
    let seen = [];
    for (const x of [low[0], high[0]]) for (const y of [low[1], high[1]]) for (const z of [low[2], high[2]]) seen.push(new Vector3(x, y, z));
    const way = new Vector3();
    if (name === "along") {
      way.copy(along).multiplyScalar(-1).setZ(0.05);
      // close up, where the ball first meets the wall: a hop of 2 mm is to be seen
      const radius = shot.scene.balls[shot.ball].radius;
      if (first && shot.scene.floor) {
        target.set(first.x[0], first.x[1], 1.6 * radius).addScaledVector(out, 3 * radius);
        seen = [-5, 6].flatMap((k) => [-1.4, 2].map((z) => target.clone().addScaledVector(out, k * radius).setZ(target.z + z * radius)));
      }
    } else if (name === "side") way.copy(out).setZ(0.05);
    else if (name === "above") way.set(0, -0.0005, 1);
    else way.copy(out).multiplyScalar(plane ? 0.8 : 1).addScaledVector(along, plane ? -0.75 : 0.2).setZ(plane ? 0.8 : 1.05);
    way.normalize();
    const metres = distanceFor(seen, target, way);
    // (float32 has no place for a scene beside coordinates that are much larger than it is)
    const usual = metres > 0.01 && metres < 1e4;
    world.scale.setScalar(usual ? 1 : 1 / metres);
    world.position.set(0, 0, 0);
    if (target.length() > 1e3 * metres) world.position.copy(target).multiplyScalar(-world.scale.x);
    world.updateMatrixWorld(true);
    const away = metres * world.scale.x;
    camera.near = away / 200;
    camera.far = away * 60;
    camera.updateProjectionMatrix();
    controls.target.copy(seenAt(target));
    camera.position.copy(controls.target).addScaledVector(way, away);
    controls.minDistance = away / 40;
    controls.maxDistance = away * 8;
    controls.update();
    request();
  }

  /** How far from a point, along a direction, a camera sees all of some points. @param {Vector3[]} points @param {Vector3} target @param {Vector3} way */
  function distanceFor(points, target, way) {
    const right = new Vector3().crossVectors(camera.up, way).normalize();
    const up = new Vector3().crossVectors(way, right);
    const half = Math.tan((camera.fov * Math.PI) / 360) * 0.9;
    return Math.max(
      ...points.map((point) => {
        const p = point.clone().sub(target);
        return p.dot(way) + Math.max(Math.abs(p.dot(right)) / (half * camera.aspect), Math.abs(p.dot(up)) / half);
      }),
    );
  }

  function resize() {
    const [width, height] = [host.clientWidth, host.clientHeight];
    if (!width || !height) return;
    renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    renderer.setSize(width, height);
    Object.assign(size, { width, height });
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    trails.resize(canvas.width, canvas.height);
    if (side !== null) look(side); // (all is to be seen at any size)
    request();
  }

  /** @returns {Promise<Blob>} */
  function picture() {
    render();
    return new Promise((resolve, reject) => canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("The browser gave no picture."))), "image/png"));
  }

  resize();
  return { update, trace, draw, look, resize, picture };
}

/** Which of the four ways along the axes a wall faces, from its impulse on a ball (friction turns it by less than 45 degrees, mostly). @param {Vec} impulse @returns {Vec} */
const facing = ([x, y]) => (Math.abs(x) > Math.abs(y) ? [Math.sign(x), 0, 0] : [0, Math.sign(y) || -1, 0]);

/** The floor with lines at round distances. @param {Shot} shot @param {Palette} palette */
function floorGrid(shot, palette) {
  const group = new Group();
  if (!shot.scene.floor) return group;
  const size = sizeOf(shot.box);
  const [x, y] = middleOf(shot.box);
  const half = 1.6 * size;
  const floor = new Mesh(new PlaneGeometry(2 * half, 2 * half), new MeshBasicMaterial({ color: palette.floor, polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 2 }));
  floor.position.set(x, y, 0);
  group.add(floor);
  const step = roundLength(size / 6);
  const points = [];
  // (counted: far from the origin a coordinate plus a step may be the same number)
  const [columns, rows] = [x, y].map((at) => Array.from({ length: Math.ceil((2 * half) / step) }, (_, k) => (Math.ceil((at - half) / step) + k) * step));
  for (const at of columns) if (at <= x + half) points.push(at, y - half, 0, at, y + half, 0);
  for (const at of rows) if (at <= y + half) points.push(x - half, at, 0, x + half, at, 0);
  const lines = new BufferGeometry();
  lines.setAttribute("position", new Float32BufferAttribute(points, 3));
  group.add(new LineSegments(lines, new LineBasicMaterial({ color: palette.grid })));
  return group;
}

/** The arrow of the edited ball's velocity, and a ring where the ball starts. */
function makeArrow() {
  const material = new MeshBasicMaterial({ color: "#000000" });
  const shaft = new Mesh(new CylinderGeometry(1, 1, 1, 12).rotateX(Math.PI / 2).translate(0, 0, 0.5), material);
  const head = new Mesh(new ConeGeometry(1, 1, 20).rotateX(Math.PI / 2).translate(0, 0, -0.5), material);
  const start = new Mesh(new RingGeometry(0.9, 1, 48), new MeshBasicMaterial({ color: "#000000", transparent: true, opacity: 0.5, depthWrite: false }));
  const group = new Group();
  group.add(shaft, head, start);
  const tip = new Vector3();
  const z = new Vector3(0, 0, 1);
  return {
    group,
    tip,
    time: 1,
    /** @param {string} ink */
    colour(ink) {
      material.color.set(ink);
      /** @type {MeshBasicMaterial} */ (start.material).color.set(ink);
    },
    /** @param {Vec} from @param {number[]} way @param {number} long @param {number} radius @param {number} size of what is seen */
    place(from, way, long, radius, size) {
      const thick = Math.max(0.07 * radius, 0.0022 * size);
      const turn = new Quaternion().setFromUnitVectors(z, new Vector3(way[0], way[1], 0));
      tip.set(from[0] + way[0] * long, from[1] + way[1] * long, from[2]);
      const cone = Math.min(6 * thick, 0.6 * long);
      shaft.position.set(...from);
      shaft.quaternion.copy(turn);
      shaft.scale.set(thick, thick, Math.max(long - cone, 1e-3 * long));
      head.position.copy(tip);
      head.quaternion.copy(turn);
      head.scale.set(2.4 * thick, 2.4 * thick, cone);
      start.position.set(from[0], from[1], from[2] - radius * 0.99);
      start.scale.setScalar(radius);
    },
  };
}
