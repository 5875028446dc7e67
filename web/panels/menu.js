// The link, files that are saved, files that are dropped.

/** @import { Store } from "../state/store.js" */
/** @import { Run } from "../state/types.js" */
/** @import { View } from "../view/shot.js" */
import { eventsCsv, readRebounds, sceneToml } from "../state/files.js";
import { toHash } from "../state/link.js";
import { sentence } from "../state/compute.js";
import { byId, el } from "./dom.js";

/** @param {string} name @param {Blob} blob */
function save(name, blob) {
  const url = URL.createObjectURL(blob);
  const link = el("a", { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

/**
 * @param {Store} store @param {View} view
 * @param {() => Run | undefined} followed
 * @param {(sentence: string, good?: boolean) => void} say
 */
export function menu(store, view, followed, say) {
  const hash = () => {
    const { scene, laws, followed: leads, t, shot } = store.state;
    return toHash({ scene, laws, followed: leads, t }, shot);
  };
  let waiting = 0;
  // browsers count how often an address is changed: once when the hand rests
  store.listen((parts) => {
    if (document.documentElement.dataset.recorded || store.state.playing || (parts.size === 1 && parts.has("data"))) return;
    clearTimeout(waiting);
    waiting = window.setTimeout(() => {
      try {
        history.replaceState(null, "", hash());
      } catch {
        // a notebook's frame has no address
      }
    }, 250);
  });

  byId("link").onclick = async () => {
    const address = location.href.split("#")[0] + hash();
    if (location.protocol === "about:") {
      say("A notebook's frame has no address: save the scene instead, or write the page with carom explore --out.");
      return;
    }
    try {
      history.replaceState(null, "", hash());
      await navigator.clipboard.writeText(address);
      say("The link is copied.", true);
    } catch {
      say("The link is in the address bar.", true);
    }
  };
  const shut = () => /** @type {HTMLDetailsElement} */ (document.querySelector("details.menu")).removeAttribute("open");
  byId("save-scene").onclick = () => {
    const { scene, followed: law } = store.state;
    const given = scene.walls.some((wall) => wall.law) || !law;
    save("scene.toml", new Blob([sceneToml(given ? scene : { ...scene, run: { ...scene.run, law } })], { type: "application/toml" }));
    shut();
  };
  byId("save-events").onclick = () => {
    const run = followed();
    if (run) save("events.csv", new Blob([eventsCsv(store.state.scene, run)], { type: "text/csv" }));
    else say("No law is shown: switch one on to save its events.");
    shut();
  };
  byId("save-picture").onclick = async () => {
    shut();
    try {
      save("scene.png", await view.picture());
    } catch (error) {
      say(sentence(error));
    }
  };

  /** @param {File} file */
  async function read(file) {
    if (/\.toml$/i.test(file.name)) {
      say("A scene is opened by carom explore FILE; here a table of measured rebounds (CSV) can be dropped.");
      return;
    }
    try {
      if (file.size > 2e7) throw new Error("This file is too large for the page: expected at most 5 MB.");
      const rebounds = readRebounds(await file.text());
      store.change({ rebounds, reboundsFrom: file.name }, "data");
      say(`${rebounds.length} measured rebounds from ${file.name}.`, true);
    } catch (error) {
      say(`${file.name}: ${sentence(error)}`);
    }
  }
  addEventListener("dragover", (event) => {
    event.preventDefault();
    document.body.classList.add("dropping");
  });
  addEventListener("dragleave", (event) => {
    if (!event.relatedTarget) document.body.classList.remove("dropping");
  });
  addEventListener("drop", (event) => {
    event.preventDefault();
    document.body.classList.remove("dropping");
    const file = event.dataTransfer?.files[0];
    if (file) void read(file);
  });
  const input = /** @type {HTMLInputElement} */ (byId("file"));
  input.onchange = () => {
    if (input.files?.[0]) void read(input.files[0]);
    input.value = "";
  };
}
