// Two live plots: reflection against incidence under each law, with measured rebounds; energy over time, and height or distance from a film.

/** @import { Rebound } from "../state/types.js" */
import { scaleLinear } from "d3-scale";
import { line } from "d3-shape";
import { svg } from "./dom.js";

const MARGIN = { left: 38, right: 10, top: 20, bottom: 26 };

/** @typedef {{name: string, colour: string, dashes: number[] | null, width: number, points: [number, number][]}} Curve */

/** @param {number} x */
const tidy = (x) => String(Number(x.toPrecision(6))).replace("-", "−");

/** Axes and grid of one plot. Units are at the ticks: within the area a label would lie on curves. Without `xUnit` there are no ticks below. @param {{x: number, y: number, width: number, height: number}} area
 * @param {import("d3-scale").ScaleLinear<number, number>} sx @param {import("d3-scale").ScaleLinear<number, number>} sy
 * @param {{title: string, xUnit?: string, yTicks?: number, yFormat?: (value: number) => string}} words */
function axes(area, sx, sy, { title, xUnit, yTicks = 4, yFormat = tidy }) {
  const group = svg("g", { class: "axes" });
  for (const value of sy.ticks(yTicks)) {
    const y = sy(value);
    group.append(svg("path", { class: "grid", d: `M${area.x} ${y}H${area.x + area.width}` }));
    group.append(svg("text", { x: area.x - 6, y: y + 3.5, "text-anchor": "end" }, yFormat(value)));
  }
  const bottom = area.y + area.height;
  group.append(svg("path", { class: "axis", d: `M${area.x} ${bottom}H${area.x + area.width}` }));
  if (xUnit !== undefined) {
    for (const value of sx.ticks(Math.max(3, area.width / 70))) {
      const x = sx(value);
      group.append(svg("path", { class: "axis", d: `M${x} ${bottom}v4` }));
      group.append(svg("text", { x, y: bottom + 15, "text-anchor": "middle" }, tidy(value) + xUnit));
    }
  }
  group.append(svg("text", { class: "title", x: area.x, y: area.y - 7 }, title));
  return group;
}

/** @param {Curve[]} curves @param {(x: number) => number} sx @param {(y: number) => number} sy */
function paths(curves, sx, sy) {
  const draw = line()
    .defined(([x, y]) => Number.isFinite(x) && Number.isFinite(y))
    .x(([x]) => Math.round(sx(x) * 10) / 10)
    .y(([, y]) => Math.round(sy(y) * 10) / 10);
  return curves.map(({ points, colour, dashes, width }) =>
    svg("path", { class: "curve", d: draw(points) ?? "", stroke: colour, "stroke-width": width, ...(dashes ? { "stroke-dasharray": dashes.map((one) => one * width).join(" ") } : {}) }),
  );
}

/** @param {HTMLElement} host @param {string} label */
function surface(host, label) {
  const root = /** @type {SVGSVGElement} */ (svg("svg", { role: "img", "aria-label": label }));
  host.append(root);
  return {
    root,
    size() {
      const [width, height] = [Math.max(200, host.clientWidth), Math.max(120, host.clientHeight)];
      root.setAttribute("viewBox", `0 0 ${width} ${height}`);
      return { x: MARGIN.left, y: MARGIN.top, width: width - MARGIN.left - MARGIN.right, height: height - MARGIN.top - MARGIN.bottom };
    },
  };
}

/** Reflection against incidence. @param {HTMLElement} host */
export function anglePlot(host) {
  const { root, size } = surface(host, "Angle of reflection against angle of incidence under each law");
  return {
    /** @param {Curve[]} curves @param {Rebound[]} rebounds @param {number | null} incidence at the wall that the ball meets @param {{colour: string, y: number}[]} now @param {string} missing why there is no curve */
    update(curves, rebounds, incidence, now, missing) {
      const area = size();
      const heights = [...curves.flatMap(({ points }) => points.map(([, y]) => y)), ...rebounds.map(({ reflection }) => reflection)].filter(Number.isFinite);
      const low = Math.min(0, ...heights);
      const sx = scaleLinear([0, 90], [area.x, area.x + area.width]);
      const sy = scaleLinear([Math.max(-90, Math.floor(low / 15) * 15), 90], [area.y + area.height, area.y]);
      const marks = rebounds.map(({ incidence: x, reflection: y, stage }) =>
        svg("circle", { class: `measured ${stage === "after_wall" ? "early" : ""}`, cx: sx(x).toFixed(1), cy: sy(y).toFixed(1), r: 2.6 }),
      );
      const here = incidence === null ? [] : [svg("path", { class: "cursor", d: `M${sx(incidence)} ${area.y}V${area.y + area.height}` })];
      const dots = incidence === null ? [] : now.map(({ colour, y }) => svg("circle", { class: "now", cx: sx(incidence).toFixed(1), cy: sy(y).toFixed(1), r: 3.4, fill: colour }));
      root.replaceChildren(
        axes(area, sx, sy, { title: "reflection over incidence", xUnit: "°", yFormat: (y) => `${tidy(y)}°` }),
        svg("path", { class: "same", d: `M${sx(0)} ${sy(0)}L${sx(90)} ${sy(90)}` }),
        ...marks, ...paths(curves, sx, sy), ...here, ...dots,
        ...(missing ? [svg("text", { class: "missing", x: area.x + area.width / 2, y: area.y + area.height / 2, "text-anchor": "middle" }, missing)] : []),
      );
    },
  };
}

/** Energy over time, and below it a length: height, or the distance from a film. @param {HTMLElement} host @param {(t: number) => void} seek */
export function timePlot(host, seek) {
  const { root, size } = surface(host, "Energy kept, and height of the ball or distance from the film, over time");
  const cursor = svg("path", { class: "cursor" });
  let span = { from: 0, until: 1 };
  let area = size();
  const at = (/** @type {PointerEvent} */ event) => {
    const box = root.getBoundingClientRect();
    const x = ((event.clientX - box.left) / box.width) * (area.x + area.width + MARGIN.right);
    seek(span.from + Math.max(0, Math.min(1, (x - area.x) / area.width)) * (span.until - span.from));
  };
  root.addEventListener("pointerdown", (event) => {
    root.setPointerCapture(event.pointerId);
    at(event);
  });
  root.addEventListener("pointermove", (event) => {
    if (event.buttons) at(event);
  });

  const place = (/** @type {number} */ t) => {
    const x = area.x + (area.width * (Math.min(t, span.until) - span.from)) / (span.until - span.from);
    cursor.setAttribute("d", `M${x.toFixed(1)} ${area.y}V${area.y + area.height}`);
  };
  return {
    place,
    /** @param {Curve[]} energy shares of the energy at the start @param {Curve[]} height mm @param {{from: number, until: number}} shown s @param {string} words of the height */
    update(energy, height, shown, words) {
      area = size();
      span = shown;
      const most = Math.max(0, ...height.flatMap(({ points }) => points.map(([, y]) => y || 0)));
      const both = most > 1e-3;
      const top = { ...area, height: both ? (area.height - 24) * 0.52 : area.height };
      const sx = scaleLinear([span.from, span.until], [area.x, area.x + area.width]);
      const peak = Math.max(1, ...energy.flatMap(({ points }) => points.map(([, y]) => y)));
      const se = scaleLinear([0, peak * 1.02], [top.y + top.height, top.y]);
      const children = [axes(top, sx, se, { title: "energy kept over time", yTicks: both ? 2 : 4, yFormat: (y) => `${tidy(100 * y)} %`, ...(both ? {} : { xUnit: " s" }) }), ...paths(energy, sx, se)];
      if (both) {
        const low = { ...area, y: top.y + top.height + 24, height: area.height - top.height - 24 };
        const long = most > 500;
        const sh = scaleLinear([0, most * 1.05], [low.y + low.height, low.y]);
        const format = (/** @type {number} */ y) => tidy(long ? y / 1000 : y);
        children.push(axes(low, sx, sh, { title: `${words}, ${long ? "m" : "mm"}`, xUnit: " s", yTicks: 2, yFormat: format }), ...paths(height, sx, sh));
      }
      root.replaceChildren(...children, cursor);
    },
  };
}
