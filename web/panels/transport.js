// Time: play, pause, speed, and from event to event.

/** @import { Store } from "../state/store.js" */
import { byId, timeText } from "./dom.js";

export const SPEEDS = [1 / 1000, 1 / 300, 1 / 100, 1 / 30, 1 / 10, 1 / 4, 1 / 2, 1, 2, 4];
const STEPS = 10_000; // of the slider

/**
 * @param {Store} store
 * @param {() => {from: number, until: number, events: {t: number, text: string}[]}} timeline of the law that is followed
 */
export function transport(store, timeline) {
  const play = /** @type {HTMLButtonElement} */ (byId("play"));
  const slider = /** @type {HTMLInputElement} */ (byId("time"));
  const speed = /** @type {HTMLSelectElement} */ (byId("speed"));
  slider.max = String(STEPS);
  for (const value of SPEEDS) {
    const option = document.createElement("option");
    option.value = String(value);
    option.textContent = value < 1 ? `1/${Math.round(1 / value)} ×` : `${value} ×`;
    speed.append(option);
  }
  let before = /** @type {number | null} */ (null);

  /** @param {number} stamp ms */
  function tick(stamp) {
    if (!store.state.playing) {
      before = null;
      return;
    }
    const { until } = timeline();
    const passed = before === null ? 0 : Math.min((stamp - before) / 1000, 0.1);
    before = stamp;
    const t = Math.min(store.state.t + passed * store.state.speed, until);
    store.change({ t, playing: t < until }, "time");
    requestAnimationFrame(tick);
  }

  /** @param {boolean} on */
  function setPlaying(on) {
    if (on === store.state.playing) return;
    const { from, until } = timeline();
    const t = on && store.state.t >= until - 1e-9 * (until - from) ? from : store.state.t;
    before = null;
    store.change({ playing: on, t }, "time");
    if (on) requestAnimationFrame(tick);
  }

  /** @param {number} t */
  function seek(t) {
    const { from, until } = timeline();
    store.change({ t: Math.max(from, Math.min(t, until)), playing: false }, "time");
  }

  /** To the next event, or the one before. @param {1 | -1} way */
  function step(way) {
    const { events, from, until } = timeline();
    const now = store.state.t;
    const close = 1e-9 * Math.max(until, 1e-3);
    const times = events.map(({ t }) => t).filter((t) => t >= from && t <= until);
    const next = way > 0 ? times.find((t) => t > now + close) : times.findLast((t) => t < now - close);
    seek(next ?? (way > 0 ? until : from));
  }

  play.onclick = () => setPlaying(!store.state.playing);
  byId("next").onclick = () => step(1);
  byId("previous").onclick = () => step(-1);
  byId("restart").onclick = () => seek(timeline().from);
  slider.oninput = () => {
    const { from, until } = timeline();
    seek(from + (Number(slider.value) / STEPS) * (until - from));
  };
  speed.onchange = () => store.change({ speed: Number(speed.value) }, "time");

  addEventListener("keydown", (event) => {
    const target = /** @type {HTMLElement} */ (event.target);
    if (event.ctrlKey || event.metaKey || event.altKey || /^(INPUT|SELECT|TEXTAREA)$/.test(target.tagName)) return;
    const { from, until } = timeline();
    const frame = (until - from) / 200;
    /** @type {Record<string, () => void>} */
    const does = {
      " ": () => setPlaying(!store.state.playing), ArrowLeft: () => seek(store.state.t - frame * (event.shiftKey ? 10 : 1)),
      ArrowRight: () => seek(store.state.t + frame * (event.shiftKey ? 10 : 1)), ",": () => step(-1), ".": () => step(1), Home: () => seek(from),
      End: () => seek(until),
    };
    if (event.key === " " && target.tagName === "BUTTON") return; // (a button is pressed)
    if (Object.hasOwn(does, event.key)) {
      event.preventDefault();
      does[event.key]();
    }
  });

  return {
    setPlaying,
    seek,
    update() {
      const { from, until, events } = timeline();
      const { t, playing } = store.state;
      slider.value = String(Math.round(((t - from) / (until - from)) * STEPS));
      slider.setAttribute("aria-valuetext", timeText(t));
      byId("clock").textContent = `${timeText(t)} of ${timeText(until)}`;
      play.textContent = playing ? "Pause" : "Play";
      play.setAttribute("aria-pressed", String(playing));
      speed.value = String(SPEEDS.reduce((best, one) => (Math.abs(Math.log(one / store.state.speed)) < Math.abs(Math.log(best / store.state.speed)) ? one : best)));
      const close = 1e-9 * Math.max(until, 1e-3);
      const last = events.findLast((event) => event.t <= t + close);
      byId("event").textContent = last ? `${timeText(last.t)}: ${last.text}` : "";
    },
  };
}
