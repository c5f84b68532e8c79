// Plots with Observable Plot. A series is rows of numbers whose columns its type names; see ../README.md.

import * as Plot from "@observablehq/plot";
import { html, svg, words } from "./dom.js";
import { figure, fixed, short, typeset } from "./numbers.js";
import { table } from "./table.js";

/** How a role looks; the colours are page.css's. */
const roles = {
  dem: { fill: "var(--dem)", stroke: "var(--dem)", strokeWidth: 1.5 },
  "dem-open": { fill: "var(--page)", stroke: "var(--dem)", strokeWidth: 1.8 },
  "dem-ring": { fill: "none", stroke: "var(--dem)", strokeWidth: 1.8 },
  dot: { fill: "var(--dem)", fillOpacity: 0.55, stroke: "none" },
  laboratory: { fill: "none", stroke: "var(--laboratory)", strokeWidth: 1.8 },
  repeat: { fill: "var(--laboratory)", stroke: "none" },
  theory: { fill: "none", stroke: "var(--theory)", strokeWidth: 2 },
  rule: { fill: "none", stroke: "var(--muted)", strokeWidth: 1.2, strokeDasharray: "7 4" },
  dots: { fill: "none", stroke: "var(--muted)", strokeWidth: 1.2, strokeDasharray: "2 3" },
  frame: { fill: "none", stroke: "var(--ink)", strokeWidth: 1 },
  band: { fill: "var(--band)", stroke: "none" },
  bar: { fill: "var(--water)", stroke: "var(--page)", strokeWidth: 1 },
};
const strokeOf = (role) => { const { fill, ...stroke } = roles[role]; return stroke; };
const fillOf = (role) => ({ fill: roles[role].fill });

const columnsOf = {
  line: ["x", "y"], steps: ["x", "y"], points: ["x", "y"], band: ["x", "low", "high"], bars: ["from", "to", "y"],
  correlation: ["y", "x", "low", "high"], box: ["x", "5 %", "25 %", "50 %", "75 %", "95 %"], cells: ["x", "y", "value"],
};

const by = (k) => (row) => row[k];

/** Tips follow the pointer; they name the row, or give its numbers. */
function tipped(series, x, y) {
  if (!series.tips?.length) return [];
  return [Plot.tip(series.rows, Plot.pointer({ x, y, title: (_, k) => series.tips[k], fontSize: 13 }))];
}

const drawers = {
  line: (s) => [Plot.line(s.rows, { x: by(0), y: by(1), ...strokeOf(s.role) })],
  steps: (s) => [Plot.line(s.rows, { x: by(0), y: by(1), curve: "step-after", ...strokeOf(s.role) })],
  points: (s, frame) => [
    Plot.dot(s.rows, {
      x: by(0), y: by(1), r: s.size ?? 5, symbol: s.symbol ?? "circle", dx: (s.shift ?? 0) * frame.squeeze, ...roles[s.role],
      title: s.tips ? (_, k) => s.tips[k] : undefined,
    }),
    ...tipped(s, by(0), by(1)),
  ],
  band: (s) => [Plot.areaY(s.rows, { x: by(0), y1: by(1), y2: by(2), ...fillOf(s.role) })],
  bars: (s) => [
    Plot.rect(s.rows, { x1: by(0), x2: by(1), y1: 0, y2: by(2), ...roles[s.role], title: (row) => `${short(row[0])} to ${short(row[1])}: ${row[2]}` }),
    Plot.tip(s.rows, Plot.pointerX({ x: (row) => (row[0] + row[1]) / 2, y: by(2), title: (row) => `${short(row[0])} to ${short(row[1])}: ${row[2]}`, fontSize: 13 })),
  ],
  correlation: (s, frame) => [
    Plot.rect(s.rows, { x1: 0, x2: by(1), y1: (row) => row[0] - (frame.above ? 0.1 : 0.32), y2: (row) => row[0] + (frame.above ? 0.42 : 0.32), ...roles[s.role] }),
    Plot.ruleY(s.rows, { y: (row) => row[0] + (frame.above ? 0.16 : 0), x1: by(2), x2: by(3), stroke: "var(--ink)" }),
    Plot.ruleX([0], { stroke: "var(--ink)" }),
    ...tipped(s, by(1), by(0)),
  ],
  box: (s, frame) => {
    const half = 0.16;
    return [
      Plot.ruleX(s.rows, { x: by(0), y1: by(1), y2: by(2), stroke: "var(--ink)" }),
      Plot.ruleX(s.rows, { x: by(0), y1: by(4), y2: by(5), stroke: "var(--ink)" }),
      Plot.rect(s.rows, { x1: (row) => row[0] - half, x2: (row) => row[0] + half, y1: by(2), y2: by(4), ...fillOf("band"), title: s.tips ? (_, k) => s.tips[k] : undefined }),
      Plot.ruleY(s.rows, { y: by(3), x1: (row) => row[0] - half, x2: (row) => row[0] + half, ...strokeOf("theory") }),
      ...[1, 5].map((k) => Plot.ruleY(s.rows, { y: by(k), x1: (row) => row[0] - half / 2, x2: (row) => row[0] + half / 2, stroke: "var(--ink)" })),
      ...tipped(s, by(0), by(3)),
    ];
  },
  cells: (s, frame) => {
    const values = s.rows.map(by(2)), low = Math.min(...values), high = Math.max(...values);
    const share = (value) => (high > low ? (value - low) / (high - low) : 0.5);
    const fits = frame.width / new Set(s.rows.map(by(0))).size > 44;
    return [
      Plot.rect(s.rows, { x1: (row) => row[0] - 0.5, x2: (row) => row[0] + 0.5, y1: (row) => row[1] - 0.5, y2: (row) => row[1] + 0.5, fill: by(2), inset: 0.3 }),
      fits ? Plot.text(s.rows, { x: by(0), y: by(1), text: (row) => fixed(row[2], 2), fill: (row) => (share(row[2]) < 0.5 ? "#fff" : "#111") }) : null,
      ...tipped(s, by(0), by(1)),
    ];
  },
  labels: (s) => [Plot.text(s.rows, {
    x: by(0), y: by(1), text: (_, k) => s.tips[k], dy: -8, lineAnchor: "bottom", fill: "var(--muted)", fontSize: 12,
  })],
};

function reference({ axis, at, to, role, text, below }, frame) {
  const along = axis === "x" ? Plot.ruleX : Plot.ruleY;
  if (to !== undefined) {
    const span = axis === "x" ? { x1: at, x2: to } : { y1: at, y2: to };
    return [Plot.rect([0], { ...span, ...fillOf(role) })];
  }
  const marks = [along([at], strokeOf(role))];
  if (text && axis === "y")
    marks.push(Plot.text([text], { frameAnchor: "left", y: at, dx: 6, dy: below ? 10 : -10, fill: "var(--muted)", fontSize: 12 }));
  if (text && axis === "x")
    marks.push(Plot.text([text], { frameAnchor: "bottom", x: at, dx: frame.width < 480 ? -6 : 8, dy: -12, textAnchor: frame.width < 480 ? "end" : "start", lineWidth: 7, fill: "var(--muted)", fontSize: 12 }));
  return marks;
}

/** A categorical axis is linear over the categories' numbers, with their names for ticks; too many are thinned out. */
function scaleOf(axis, pixels) {
  const { categories, domain, decimals } = axis;
  if (!categories) {
    const ticks = axis.step ? Math.round((domain[1] - domain[0]) / axis.step) : Math.max(3, Math.round(pixels / (axis.upright ? 50 : 80)));
    return {
      domain: domain ?? undefined, nice: domain ? false : ticks, label: null, ticks,
      tickFormat: decimals === undefined ? (value) => short(value) : (value) => typeset(value.toFixed(decimals)),
    };
  }
  const widest = Math.max(...categories.map((name) => name.length)) * 7 + 8;
  const stride = axis.upright ? Math.ceil((18 * categories.length) / pixels) : Math.ceil((widest * categories.length) / pixels);
  const ticks = categories.map((_, k) => k).filter((k) => k % Math.max(1, stride) === 0);
  return { domain: [-0.5, categories.length - 0.5], label: null, ticks, tickFormat: (k) => categories[k], tickSize: 0 };
}

/** `spare`: room on the left and the right for labels that turned out longer. */
function drawn(plot, width, spare) {
  const rows = plot.y.categories;
  const named = rows ? Math.max(...rows.map((name) => name.length)) * 7.2 + 16 : 0;
  const above = rows && plot.y.first_on_top && named > 0.4 * width; // the names then stand over their bars
  const marginLeft = spare.left + (rows && !above ? Math.max(40, Math.min(named, 0.5 * width)) : above ? 16 : 46);
  const height = rows ? Math.min(rows.length * (above ? 46 : 30), 620) + 66 : Math.round(Math.max(290, Math.min(460, 0.6 * width)));
  const titleLines = Math.ceil((plot.x.title.length * 8.2) / width);
  const marginRight = 14 + spare.right;
  const margins = { marginLeft, marginRight, marginTop: plot.y.title ? 34 : 8, marginBottom: 32 + 16 * titleLines };
  const frame = { width: width - marginLeft - marginRight, squeeze: Math.min(1, width / 640), above };
  const y = scaleOf({ ...plot.y, upright: true }, height - 80);
  if (rows && plot.y.first_on_top) y.reverse = true; // the first on top
  return Plot.plot({
    width, height, ...margins,
    style: { fontFamily: "inherit", fontSize: "13px", background: "none", color: "var(--ink)" },
    x: scaleOf(plot.x, frame.width), y,
    color: { scheme: "viridis", type: "linear" },
    marks: [
      ...plot.references.filter(({ to }) => to !== undefined).flatMap((one) => reference(one, frame)),
      ...plot.series.filter(({ type }) => type === "band").flatMap((s) => drawers.band(s, frame)),
      plot.x.categories ? null : Plot.gridX({ stroke: "var(--grid)", strokeOpacity: 1, ticks: scaleOf(plot.x, frame.width).ticks }),
      rows ? null : Plot.gridY({ stroke: "var(--grid)", strokeOpacity: 1, ticks: y.ticks }),
      Plot.frame({ stroke: "var(--muted)" }),
      ...plot.references.filter(({ to }) => to === undefined).flatMap((one) => reference(one, frame)),
      ...plot.series.filter(({ type }) => type !== "band").flatMap((s) => drawers[s.type](s, frame)),
      above ? Plot.text(rows, { frameAnchor: "left", y: (_, k) => k - 0.28, text: (name) => name, dx: 2, fontSize: 12.5, fill: "var(--ink)" }) : null,
      above ? Plot.axisY({ ticks: [] }) : Plot.axisY({ label: null, ticks: y.ticks, tickFormat: y.tickFormat, tickSize: 0, textOverflow: "ellipsis", lineWidth: Math.max(4, marginLeft / 14) }),
      Plot.text([plot.y.title], { frameAnchor: "top-left", dx: rows ? 0 : 8 - marginLeft, dy: -24, fontWeight: 600, lineAnchor: "bottom", textAnchor: "start" }),
      Plot.text([plot.x.title], { frameAnchor: "bottom", dx: (14 - marginLeft) / 2, dy: 26, fontWeight: 600, lineAnchor: "top", lineWidth: width / 16 }),
    ],
  });
}

// --- legend and numbers ----------------------------------------------------------------------------------------------

const shapes = {
  circle: (r) => svg("circle", { cx: 13, cy: 7, r }),
  triangle: () => svg("polygon", { points: "13,1 19,12 7,12" }),
  square: () => svg("rect", { x: 8, y: 2, width: 10, height: 10 }),
};

function swatch(series) {
  const line = () => svg("line", { x1: 1, y1: 7, x2: 25, y2: 7 });
  const patch = () => svg("rect", { x: 1, y: 1, width: 24, height: 12 });
  const shape = series.type === "points" ? shapes[series.symbol ?? "circle"](Math.min(5, series.size ?? 5))
    : ["line", "steps", "reference"].includes(series.type) ? line() : patch();
  for (const [name, value] of Object.entries(roles[series.role]))
    shape.style.setProperty(name.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`), value);
  return svg("svg", { viewBox: "0 0 26 14", "aria-hidden": "true" }, shape);
}

/** Values at the ends of a heat map's colours. */
function colourScale({ rows }) {
  const values = rows.map(by(2)), [low, high] = [Math.min(...values), Math.max(...values)].map(figure);
  return html("ul", { class: "key" }, html("li", {}, `${low} `, html("span", { class: "viridis" }), ` ${high}`));
}

function legend(plot) {
  const cells = plot.series.find(({ type }) => type === "cells");
  if (cells) return colourScale(cells);
  const zones = plot.references.filter(({ name }) => name).map(({ name, role, to }) => ({ name, role, type: to === undefined ? "reference" : "band" }));
  const named = [...plot.series.filter(({ name }) => name), ...(plot.key ?? []), ...zones];
  if (!named.length) return null;
  return html("ul", { class: "key" }, named.map((one) => html("li", {}, swatch(one), words(one.name))));
}

/** The plotted data as tables, for screen readers and for the numbers. Made when opened. */
function numbers(plot) {
  const box = html("details", {}, html("summary", {}, "Numbers"));
  box.addEventListener("toggle", () => {
    if (!box.open || box.children.length > 1) return;
    for (const s of plot.series) {
      if (!columnsOf[s.type]) continue;
      const title = { x: plot.x.title || "x", y: plot.y.title || "y" };
      const columns = columnsOf[s.type].map((name) => ({ title: title[name] ?? name }));
      const name = (axis, value) => (axis.categories ? axis.categories[value] : value);
      const rows = s.rows.map((row) => row.map((value, k) => {
        const what = columnsOf[s.type][k];
        return what === "x" ? name(plot.x, value) : what === "y" ? name(plot.y, value) : value;
      }));
      box.append(table({ caption: s.name ?? plot.title, columns, rows }));
    }
  });
  return box;
}

/** How far texts reach over the left and right edges of a drawing [px]. */
function beyond(made) {
  const edge = made.getBoundingClientRect(), spare = { left: 0, right: 0 };
  for (const text of made.querySelectorAll("text")) {
    const box = text.getBoundingClientRect();
    if (box.width === 0) continue;
    spare.left = Math.max(spare.left, Math.ceil(edge.left - box.left));
    spare.right = Math.max(spare.right, Math.ceil(box.right - edge.right));
  }
  return spare;
}

/** A plot that is as wide as its place, and drawn again when that changes. */
export function plotFigure(plot) {
  const place = html("div", { class: "drawn" });
  const figure = html("figure", { class: "plot", id: plot.id },
    html("h3", {}, words(plot.title)), plot.description ? html("p", {}, words(plot.description)) : null, legend(plot), place, numbers(plot));
  let width = 0;
  const put = (spare) => {
    const made = drawn(plot, width, spare);
    made.setAttribute("role", "img");
    made.setAttribute("aria-label", `${plot.title}. ${plot.description ?? ""}`);
    place.replaceChildren(made);
    return made;
  };
  const draw = () => {
    const room = Math.floor(Math.min(832, place.getBoundingClientRect().width || 720));
    if (Math.abs(room - width) < 2) return;
    width = room;
    const spare = beyond(put({ left: 0, right: 0 }));
    if (spare.left > 0 || spare.right > 0) put(spare);
  };
  return { figure, draw, place };
}
