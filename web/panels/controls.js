// Sliders with number fields; the scene changes while they move.

/** @import { Store } from "../state/store.js" */
/** @import { Control } from "../state/edit.js" */
import { CONTROLS, referenceNormal, valueFault, withRolling } from "../state/edit.js";
import { nameOf, wallName } from "../state/files.js";
import { el } from "./dom.js";

/** A number as its field shows it. @param {number} value */
function numberText(value) {
  if (value === Infinity) return "∞";
  return Math.abs(value) < 1e-9 ? "0" : String(Number(value.toPrecision(4))); // (what rounding leaves is nobody's spin)
}

/**
 * @param {HTMLElement} host @param {Store} store
 * @param {(scene: import("../state/types.js").Scene) => void} change
 * @param {(sentence: string) => void} complain
 * @param {(scene: import("../state/types.js").Scene, ball: number) => string} strikeOf what to say of a cue that has struck a ball
 * @returns {{update: () => void}}
 */
export function controls(host, store, change, complain, strikeOf) {
  let moving = false;
  /** @type {{control: Control, row: HTMLElement, range: HTMLInputElement, field: HTMLInputElement}[]} */
  const rows = [];
  const ballChoice = el("select", { id: "ball-choice", "aria-label": "Ball", change: () => store.change({ ball: Number(ballChoice.value) }, "scene", "laws") });
  const struck = el("p", { class: "note", id: "strike", hidden: true });
  const wallChoice = el("select", { id: "wall-choice", "aria-label": "Wall", change: () => store.change({ wall: Number(wallChoice.value) }, "scene") });
  const rolling = el("input", {
    type: "checkbox", id: "rolling",
    change: () => {
      store.remember();
      change(withRolling(store.state.scene, store.state.ball, rolling.checked));
    },
  });

  /** @param {Control} control @param {number} value shown on a slider with ends at -1... of a range input */
  const toRange = (control, value) => (value === Infinity ? control.most + control.step * 4 : Math.max(control.least, Math.min(control.most, value)));

  for (const group of /** @type {const} */ (["Ball", "Wall", "Floor"])) {
    const section = el("section", { class: "controls", "aria-label": group });
    const head = el("div", { class: "head" }, el("h2", {}, group));
    if (group === "Ball") head.append(ballChoice, el("label", { class: "check" }, rolling, "rolling"));
    if (group === "Wall") head.append(wallChoice);
    section.append(head);
    if (group === "Ball") section.append(struck);
    for (const control of CONTROLS.filter((one) => one.group === group)) {
      const id = `control-${control.key}`;
      const range = el("input", {
        type: "range", id, min: String(control.least), max: String(control.infinite ? control.most + control.step * 4 : control.most), step: "any",
        change: () => (moving = false),
        input: () => {
          if (!moving) store.remember(); // (once for a whole drag)
          moving = true;
          const raw = Number(range.value);
          const value = control.infinite && raw > control.most + control.step ? Infinity : Math.round(raw / control.step) * control.step;
          write(control, value);
        },
      });
      const field = el("input", {
        type: "text", inputmode: "decimal", autocomplete: "off", "aria-label": `${control.label}${control.unit ? `, ${control.unit}` : ""}`, id: `${id}-number`,
        change: () => {
          const text = field.value.trim().replace("−", "-").replace(",", ".");
          const value = /^(inf|∞)$/i.test(text) ? Infinity : text === "" ? NaN : Number(text) / control.scale;
          const fault = valueFault(control, value);
          if (fault) {
            complain(fault);
            update();
            return;
          }
          store.remember();
          write(control, value);
        },
      });
      const row = el("div", { class: "row", ...(control.help ? { title: control.help } : {}) }, el("label", { for: id }, control.label), range, field, el("span", { class: "unit" }, control.unit));
      section.append(row);
      rows.push({ control, row, range, field });
    }
    host.append(section);
  }

  /** @param {Control} control @param {number} value */
  function write(control, value) {
    const { scene, ball, wall } = store.state;
    // (rounded as it is shown: 0.30000000000000004 is nobody's friction)
    change(control.write(scene, ball, wall, value === Infinity ? value : Number(value.toPrecision(12))));
  }

  function options(/** @type {HTMLSelectElement} */ select, /** @type {string[]} */ names, /** @type {number} */ first, /** @type {number} */ chosen) {
    const texts = names.join("\n");
    if (select.dataset.names !== texts) {
      select.replaceChildren(...names.map((name, i) => el("option", { value: String(i + first) }, name)));
      select.dataset.names = texts;
    }
    select.value = String(chosen);
    select.hidden = names.length < 2;
  }

  function update() {
    const { scene, ball, wall } = store.state;
    options(ballChoice, scene.balls.map((_, i) => nameOf(scene, i)), 0, ball);
    options(wallChoice, scene.walls.length > 1 ? ["all walls", ...scene.walls.map((_, i) => wallName(scene, i))] : ["wall"], -1, wall);
    struck.textContent = strikeOf(scene, ball);
    struck.hidden = !struck.textContent;
    rolling.checked = scene.balls[ball].rolling;
    rolling.disabled = !scene.floor;
    for (const { control, row, range, field } of rows) {
      const value = control.read(scene, ball, wall);
      row.hidden = value === null;
      if (value === null) continue;
      if (control.key === "angle") {
        const most = referenceNormal(scene) ? 89.9 : 180;
        range.min = String(-most);
        range.max = String(most);
      }
      const text = numberText(value * control.scale);
      if (document.activeElement !== range) range.value = String(toRange(control, value));
      range.setAttribute("aria-valuetext", `${text} ${control.unit}`.trim());
      if (document.activeElement !== field || field.dataset.said === field.value) field.value = field.dataset.said = text;
    }
    for (const section of host.querySelectorAll("section")) {
      /** @type {HTMLElement} */ (section).hidden = [...section.querySelectorAll(".row")].every((row) => /** @type {HTMLElement} */ (row).hidden);
    }
  }
  return { update };
}
