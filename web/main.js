// The explorer: one scene, every law of impact side by side, computed by carom's own engine.

/** @import { LawCard, Preset, Rebound, Scene } from "./state/types.js" */
/** @import { Engine } from "./state/compute.js" */
/** @import { Box, Palette, View } from "./view/shot.js" */
import { requireTime } from "./engine/arguments.js";
import { loadEngine } from "./engine/engine.js";
import { loadRecorded } from "./engine/recorded.js";
import { byId, el } from "./panels/dom.js";
import { controls } from "./panels/controls.js";
import { lawPanel } from "./panels/laws.js";
import { menu } from "./panels/menu.js";
import { anglePlot, timePlot } from "./panels/plots.js";
import { strikeNotes } from "./panels/strike.js";
import { transport } from "./panels/transport.js";
import { AS_GIVEN, cardsFor, checked, comparedAt, curvesOf, horizon, runAll, sentence, steps } from "./state/compute.js";
import { withBall } from "./state/edit.js";
import { nameOf } from "./state/files.js";
import { fromHash } from "./state/link.js";
import { apartAt, apartCurve } from "./state/film.js";
import { Orientation, energyAt, sampleTimes, stateAt, trailTime } from "./state/motion.js";
import { Store } from "./state/store.js";
import { ballColour } from "./view/balls.js";
import { flat } from "./view/flat.js";
import { VIEWS, boxAround } from "./view/shot.js";
import { stage } from "./view/stage.js";

/** `recorded`: a run that the page shows and does not compute. @typedef {{presets: Preset[], cards: LawCard[], rebounds: Rebound[], reboundsFrom: string, recorded?: import("./engine/types.js").Recording}} PageData */

let fading = 0;

/** Show a sentence; a good one goes by itself. @param {string} text @param {boolean} [good] */
function say(text, good = false) {
  const message = byId("message");
  message.textContent = text;
  message.hidden = !text;
  message.className = good ? "good" : "bad";
  clearTimeout(fading);
  if (good) fading = window.setTimeout(() => (message.hidden = true), 6000);
}

/** An angle of incidence on the plot's axis; null where it has no place there. @param {number} degrees */
const angleShown = (degrees) => (degrees <= 90 ? degrees : null);

/** @param {string} hex @param {boolean} dark lighter on a dark ground */
function tint(hex, dark) {
  if (!dark) return hex;
  const parts = [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));
  return `#${parts.map((one) => Math.round(one + (255 - one) * 0.28).toString(16).padStart(2, "0")).join("")}`;
}

/** What stands below the plot of angles. @param {number} count of measured rebounds @param {string} from a file */
function measuredText(count, from) {
  if (count === 0) return "drop a CSV table anywhere on the page";
  return `${count} from ${from}. The curves are not fitted to them: they are for the restitution, friction and cushion height set by the sliders.`;
}

/** @returns {Palette} */
function palette() {
  const style = getComputedStyle(document.documentElement);
  const of = (/** @type {string} */ name) => style.getPropertyValue(`--${name}`).trim();
  return {
    background: of("sky"), floor: of("felt"), grid: of("grid"), wall: of("wall"), edge: of("edge"), ink: of("ink"), soft: of("soft"),
    dark: document.documentElement.dataset.theme === "dark",
  };
}

const json = (/** @type {string} */ id) => JSON.parse(byId(id).textContent ?? "null");

async function start() {
  performance.mark("script");
  document.documentElement.dataset.theme = matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
  if (typeof WebAssembly !== "object") throw new Error("This browser has no WebAssembly, in which carom's engine is: any browser since 2018 has it.");
  /** @type {PageData} */
  const data = json("page-data");
  const module = Uint8Array.from(atob((byId("engine-module").textContent ?? "").trim()), (c) => c.charCodeAt(0));
  const layout = json("engine-layout");
  const { recorded, presets } = data;
  const loaded = await (recorded ? loadRecorded(module, layout, presets[0].scene, recorded) : loadEngine(module, layout));
  const engine = /** @type {Engine} */ (/** @type {unknown} */ (loaded));
  const [run, pieces] = [loaded.report.bind(loaded), loaded.run.bind(loaded)]; // run: in the form of carom simulate --json
  const carom = { run, pieces, version: loaded.version, ...(!recorded && { shots: loaded.shots.bind(loaded) }) };
  Object.assign(window, { carom });
  if (recorded) document.documentElement.dataset.recorded = "true";
  const { store, at } = show(data, engine);
  Object.assign(carom, { scene: () => structuredClone(store.state.scene), at });
}

/** @param {PageData} data @param {Engine} engine */
function show(data, engine) {
  // (the documentation links to #preset=NAME)
  const asked = () => data.presets.findIndex(({ name }) => name === new URLSearchParams(location.hash.replace(/^#/, "")).get("preset"));
  const number = Math.max(0, asked());
  const first = data.presets[number];
  /** The film beside a preset's scene. @param {Preset | undefined} preset */
  const filmed = (preset) => ({ film: preset?.film ?? [], shot: preset?.film ? preset.name : "" });
  const names = [AS_GIVEN, ...data.cards.map(({ name }) => name)];
  const cardsOf = (/** @type {Scene} */ of) => (data.recorded ? data.cards : cardsFor(data.cards, of));
  const lawsOf = (/** @type {Preset} */ preset) => cardsOf(preset.scene).map(({ name }) => name).filter((name) => preset.laws.includes(name));
  /** @type {ReturnType<typeof fromHash>} */
  let linked = null;
  try {
    if (!data.recorded) linked = fromHash(location.hash, engine, names);
  } catch (error) {
    say(sentence(error));
  }
  let scene = linked?.scene ?? checked(engine, first.scene);
  const laws = linked?.laws ?? lawsOf(first);
  const fault = runAll(engine, scene, laws.length ? laws : [scene.run.law]).fault;
  if (fault !== null && linked) {
    say(`The scene of this link cannot be shown: ${fault}`);
    linked = null;
    scene = checked(engine, first.scene);
  }
  const store = new Store({
    scene, ...filmed(linked && asked() < 0 ? undefined : first), laws: linked?.laws ?? lawsOf(first), followed: "", ball: 0, wall: -1, t: linked?.t ?? first.time ?? 0, playing: false,
    span: linked ? null : (first.span ?? null), speed: first.slow ?? 1, rebounds: data.rebounds, reboundsFrom: data.reboundsFrom, cards: cardsOf(scene),
  });
  const { state } = store;

  /** The law that leads: the one asked for, the scene's own, or the first. @param {string} [wanted] */
  const leader = (wanted) => [wanted, state.cards[0]?.name === AS_GIVEN ? AS_GIVEN : undefined, state.scene.run.law].find((law) => law && state.laws.includes(law)) ?? state.laws[0] ?? "";
  state.followed = leader(linked?.followed);

  let outcome = runAll(engine, state.scene, state.laws);
  let span = horizon(state.scene, outcome.runs.values(), state.span);
  /** @type {Box} */
  let box = boxAround(state.scene, outcome.runs, state.followed, span);
  let events = steps(state.scene, outcome.runs.get(state.followed));
  const colours = () => new Map(state.cards.map(({ name, colour }) => [name, tint(colour, document.documentElement.dataset.theme === "dark")]));

  // --- what is seen ---------------------------------------------------------------------------------------------------
  const host = byId("stage");
  const drag = data.recorded ? null : {
    start: () => store.remember(),
    ball: (/** @type {number} */ x, /** @type {number} */ y) => change(withBall(state.scene, state.ball, { position: [x, y, state.scene.balls[state.ball].position[2]] })),
    velocity: (/** @type {number} */ x, /** @type {number} */ y) => change(withBall(state.scene, state.ball, { velocity: [x, y, state.scene.balls[state.ball].velocity[2]] })),
    end: () => {},
  };
  /** @type {View} */
  let view;
  const webgl2 = Boolean(document.createElement("canvas").getContext("webgl2"));
  if (webgl2) view = stage(host, drag, { scale: byId("scale"), height: byId("height") });
  else {
    view = flat(host, drag);
    byId("scale").hidden = true;
    say("This browser has no WebGL 2: the scene is drawn from above and from the side.");
  }
  const canvas = /** @type {HTMLCanvasElement} */ (host.querySelector("canvas"));
  const views = /** @type {HTMLElement} */ (host.querySelector(".views"));
  for (const { name, label } of webgl2 ? VIEWS : []) {
    views.append(el("button", { type: "button", "data-view": name, click: () => {
      box = boxAround(state.scene, outcome.runs, state.followed, span);
      draw(new Set(["scene"]));
      view.look(name);
    } }, label));
  }

  const lawColumn = lawPanels();
  const sliders = controls(byId("controls"), store, change, say, strikeNotes(data.presets));
  const angles = anglePlot(byId("angles"));
  const time = transport(store, () => ({ ...span, events }));
  const course = timePlot(byId("course"), time.seek);
  menu(store, view, () => outcome.runs.get(state.followed), say);

  function lawPanels() {
    byId("laws").replaceChildren(el("h2", {}, "Laws"));
    return { cards: state.cards, panel: lawPanel(byId("laws"), store) };
  }

  // --- changes ----------------------------------------------------------------------------------------------------------
  /** Adopt a scene if the engine takes it; else say why not. @param {Scene} next */
  function change(next) {
    const found = runAll(engine, next, state.laws.length ? state.laws : [next.run.law]);
    if (found.fault !== null) {
      say(found.fault);
      sliders.update();
      return;
    }
    say("");
    store.change({ scene: next, span: null }, "scene");
  }

  /** @type {Set<import("./state/store.js").Part>} */
  let dirty = new Set();
  let queued = false;
  store.listen((parts) => {
    if (parts.has("scene") || parts.has("laws")) {
      state.cards = cardsOf(state.scene);
      state.laws = state.cards.map(({ name }) => name).filter((name) => state.laws.includes(name));
      state.followed = leader(state.followed);
      outcome = runAll(engine, state.scene, state.laws);
      span = horizon(state.scene, outcome.runs.values(), state.span);
      events = steps(state.scene, outcome.runs.get(state.followed));
      state.t = Math.max(span.from, Math.min(state.t, span.until));
    }
    dirty = new Set([...dirty, ...parts]);
    if (!queued) requestAnimationFrame(() => draw(dirty));
    queued = true;
  });

  /** The times between which paths are drawn: of long runs only the last. */
  function trailSpan() {
    const lasts = trailTime(outcome.runs.get(state.followed), span);
    return lasts === Infinity ? span : { from: Math.max(span.from, state.t - lasts), until: state.t };
  }

  /** @param {Set<string>} parts */
  function draw(parts) {
    queued = false;
    dirty = new Set();
    const of = colours();
    if (parts.has("scene") || parts.has("laws")) {
      view.update({ scene: state.scene, ball: state.ball, followed: state.followed, runs: outcome.runs, colours: of, span: trailSpan(), box, film: state.film }, palette());
      byId("key").hidden = !state.scene.floor;
      byId("apart").hidden = byId("key-film").hidden = !state.film.length;
      canvas.setAttribute("aria-label", `The scene: ${state.scene.balls.length} ball${state.scene.balls.length > 1 ? "s" : ""} under ${state.laws.join(", ") || "no law"}. Drag the ball or its arrow, or use the sliders.`);
      const compared = comparedAt(engine, state.scene, state.cards);
      if (lawColumn.cards.length !== state.cards.length) Object.assign(lawColumn, lawPanels());
      lawColumn.panel.update(compared.verdicts, of, outcome.notes, compared.note);
      sliders.update();
      drawAngles(compared, of);
      drawCourse(of);
    } else if (parts.has("data")) drawAngles(comparedAt(engine, state.scene, state.cards), of);
    else if (trailSpan() !== span) view.trace(trailSpan());
    view.draw(state.t);
    course.place(state.t);
    time.update();
    byId("apart").textContent = apartText();
  }

  /** How far the run that is followed is from the film now. */
  function apartText() {
    const run = outcome.runs.get(state.followed);
    const each = state.film.map((rows, i) => {
      const apart = run && apartAt(rows, run.balls[i].pieces, state.t);
      return `${nameOf(state.scene, i)}: ${apart === null || apart === undefined ? "not seen" : `${(1e3 * apart).toFixed(1)} mm`}`;
    });
    return `From film to run: ${each.join(", ")}`;
  }

  /** @param {import("./state/compute.js").Compared} compared @param {Map<string, string>} of */
  function drawAngles({ meeting, verdicts }, of) {
    const shown = state.cards.filter(({ name }) => state.laws.includes(name));
    const found = curvesOf(engine, meeting, shown.map(({ name }) => name));
    angles.update(
      shown.map(({ name, dashes }) => ({ name, colour: of.get(name) ?? "#888", dashes, width: name === state.followed ? 2.4 : 1.6, points: found.get(name) ?? [] })),
      state.rebounds, meeting && angleShown(engine.incidenceAt(meeting)),
      shown.flatMap(({ name }) => {
        const angle = verdicts.get(name)?.angle;
        return typeof angle === "number" ? [{ colour: of.get(name) ?? "#888", y: angle }] : [];
      }),
      meeting || data.recorded ? "" : `${nameOf(state.scene, 0)} meets no wall`,
    );
    byId("measured").textContent = measuredText(state.rebounds.length, state.reboundsFrom);
  }

  /** @param {Map<string, string>} of */
  function drawCourse(of) {
    /** @type {import("./panels/plots.js").Curve[]} */
    const energy = [];
    /** @type {import("./panels/plots.js").Curve[]} */
    const height = [];
    for (const { name, dashes } of state.cards) {
      const run = outcome.runs.get(name);
      if (!run) continue;
      const look = { name, colour: of.get(name) ?? "#888", dashes, width: name === state.followed ? 2.2 : 1.5 };
      const times = sampleTimes(run, state.ball, span, 60);
      const all = energyAt(state.scene, run, 0);
      const low = state.scene.floor ? state.scene.balls[state.ball].radius : 0;
      if (all > 0) energy.push({ ...look, points: times.map((t) => [t, energyAt(state.scene, run, t) / all]) });
      height.push({ ...look, points: times.map((t) => [t, (stateAt(run.balls[state.ball].pieces, t).x[2] - low) * 1e3]) });
    }
    const run = outcome.runs.get(state.followed);
    const apart = state.film.map((rows, i) => {
      const colour = (i === state.ball ? of.get(state.followed) : null) ?? ballColour(state.scene.balls[i], i);
      return { name: String(i), colour, dashes: null, width: 1.5, points: run ? apartCurve(rows, run.balls[i].pieces, span) : [] };
    });
    course.update(energy, apart.length ? apart : height, span, apart.length ? "from film to run" : "height");
  }

  // --- presets, theme, undo -------------------------------------------------------------------------------------------
  const presets = /** @type {HTMLSelectElement} */ (byId("preset"));
  presets.append(...data.presets.map(({ title }, i) => el("option", { value: String(i) }, title)));
  presets.value = String(number);
  const about = (/** @type {string} */ text) => (byId("about").textContent = text);
  about(linked ? "" : first.about);
  presets.onchange = () => {
    const preset = data.presets[Number(presets.value)];
    store.remember();
    say("");
    about(preset.about);
    Object.assign(state, { ...filmed(preset), ball: 0, wall: -1, t: preset.time ?? 0, span: preset.span ?? null, speed: preset.slow ?? 1, playing: false });
    store.change({ scene: checked(engine, preset.scene), laws: lawsOf(preset), followed: preset.scene.run.law }, "scene", "laws", "time");
    box = boxAround(state.scene, outcome.runs, state.followed, span);
    draw(new Set(["scene"]));
    view.look(preset.view ?? "free");
  };
  byId("undo").onclick = () => store.undo();
  byId("redo").onclick = () => store.redo();
  byId("theme").onclick = () => {
    const root = document.documentElement;
    root.dataset.theme = root.dataset.theme === "dark" ? "light" : "dark";
    draw(new Set(["scene"]));
  };
  addEventListener("keydown", (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "z") return;
    event.preventDefault();
    if (event.shiftKey) store.redo();
    else store.undo();
  });
  addEventListener("hashchange", () => {
    try {
      const found = data.recorded ? null : fromHash(location.hash, engine, names);
      if (!found) return;
      const bad = runAll(engine, found.scene, found.laws.length ? found.laws : [found.scene.run.law]).fault;
      if (bad !== null) throw new Error(bad);
      store.remember();
      store.change({ ...found, ...filmed(data.presets[asked()]), ball: 0, wall: -1, span: null, playing: false }, "scene", "laws", "time");
      box = boxAround(state.scene, outcome.runs, state.followed, span);
      draw(new Set(["scene"]));
    } catch (error) {
      say(sentence(error));
    }
  });
  new ResizeObserver(() => {
    view.resize();
    draw(new Set(["scene"]));
  }).observe(host);
  draw(new Set(["scene"]));
  view.look(linked ? "free" : (first.view ?? "free"));
  performance.mark("ready");
  document.documentElement.dataset.ready = "true";
  /** All balls and their energy, J, at a time under the law that is followed; q: orientation, a quaternion w, x, y, z. @param {number} t s */
  function at(t) {
    requireTime(t);
    const run = outcome.runs.get(state.followed);
    if (!run) return null;
    return { energy: energyAt(state.scene, run, t), balls: run.balls.map(({ pieces }) => ({ ...stateAt(pieces, t), q: new Orientation(pieces).at(t) })) };
  }
  return { store, at };
}

start().catch((error) => {
  say(sentence(error));
  document.documentElement.dataset.ready = "failed";
});
