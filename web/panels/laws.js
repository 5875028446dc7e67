// One card per law: what it says of the first contact with a wall, and whether it may apply.

/** @import { Store } from "../state/store.js" */
/** @import { Verdict } from "../state/types.js" */
import { el, shown } from "./dom.js";

/** A sample of a law's line, as in the plots. @param {string} colour @param {number[] | null} dashes */
function sample(colour, dashes) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  made.setAttribute("viewBox", "0 0 26 8");
  made.setAttribute("class", "sample");
  made.setAttribute("aria-hidden", "true");
  const line = document.createElementNS("http://www.w3.org/2000/svg", "path");
  line.setAttribute("d", "M1 4H25");
  line.setAttribute("stroke", colour);
  line.setAttribute("stroke-width", "3");
  if (dashes) line.setAttribute("stroke-dasharray", dashes.map((one) => one * 2).join(" "));
  made.append(line);
  return made;
}

/**
 * @param {HTMLElement} host @param {Store} store
 * @returns {{update: (verdicts: Map<string, Verdict>, colours: Map<string, string>, notes: Map<string, string>, which: string) => void}}
 */
export function lawPanel(host, store) {
  const contact = el("p", { class: "contact", hidden: true });
  host.append(contact);
  const cards = store.state.cards.map((card) => {
    const box = el("input", {
      type: "checkbox", id: `law-${card.name}`, "aria-label": `show ${card.name}`,
      change: () => {
        const { laws, followed } = store.state;
        const next = store.state.cards.map(({ name }) => name).filter((name) => (name === card.name ? box.checked : laws.includes(name)));
        store.change({ laws: next, followed: next.includes(followed) ? followed : (next[0] ?? "") }, "laws");
      },
    });
    const follow = el("button", {
      type: "button", class: "follow", title: `${card.summary} Press to follow its balls.`,
      click: () => {
        const laws = store.state.laws.includes(card.name) ? store.state.laws : store.state.cards.map(({ name }) => name).filter((name) => name === card.name || store.state.laws.includes(name));
        store.change({ followed: card.name, laws }, "laws");
      },
    }, card.name);
    const swatch = el("span", { class: "swatch" });
    const why = el("ul", { class: "why", hidden: true, id: `why-${card.name}` });
    const verdict = el("button", {
      type: "button", class: "verdict", "aria-controls": why.id, "aria-expanded": "false",
      click: () => {
        why.hidden = !why.hidden;
        verdict.setAttribute("aria-expanded", String(!why.hidden));
      },
    });
    const numbers = el("dl", {});
    const root = el("article", { class: "law", "data-law": card.name }, el("header", {}, box, swatch, follow, verdict), why, numbers);
    host.append(root);
    return { card, box, follow, swatch, verdict, numbers, why, root };
  });

  return {
    update(verdicts, colours, notes, which) {
      contact.textContent = which;
      contact.hidden = !which;
      for (const { card, box, follow, swatch, verdict, numbers, why, root } of cards) {
        const found = verdicts.get(card.name);
        const note = notes.get(card.name);
        const colour = colours.get(card.name) ?? "currentColor";
        const on = store.state.laws.includes(card.name);
        box.checked = on;
        root.style.setProperty("--law", colour);
        root.classList.toggle("off", !on);
        root.classList.toggle("followed", store.state.followed === card.name);
        follow.setAttribute("aria-pressed", String(store.state.followed === card.name));
        swatch.replaceChildren(sample(colour, card.dashes));
        const reasons = note ? [note] : (found?.reasons ?? []);
        const fine = found?.admissible && !note;
        verdict.textContent = found || note ? (fine ? "✓ may apply" : "✗ may not apply") : "";
        verdict.className = `verdict ${fine ? "yes" : "no"}`;
        verdict.disabled = reasons.length === 0;
        verdict.title = reasons.join("; ");
        why.replaceChildren(...reasons.map((one) => el("li", {}, one)));
        numbers.replaceChildren(...(found ? facts(found) : []));
      }
    },
  };
}

/** @param {Verdict} verdict */
function facts({ angle, velocity, spin, energy_kept, hop, required, available }) {
  /** @type {[string, string, string][]} */
  const rows = [
    ["angle", "angle", angle === null ? "–" : `${angle.toFixed(1)}°`],
    ["energy", "energy kept", energy_kept === null ? "–" : `${(100 * energy_kept).toFixed(1)} %`],
    ["hop", "hop", hop === null ? "–" : `${shown(hop * 1e3)} mm`],
    ["friction", "μ needed", required === null ? "–" : `${shown(required, 2)} of ${shown(available, 2)}`],
    ["velocity", "velocity", velocity ? `${velocity.map((one) => shown(one)).join(", ")} m/s` : "–"],
    ["spin", "spin", spin ? `${spin.map((one) => shown(one)).join(", ")} rad/s` : "–"],
  ];
  return rows.map(([name, label, text]) => el("div", { class: name }, el("dt", {}, label), el("dd", {}, text)));
}
