// The curve of the search that kept the run: load against displacement with its answer, as a small chart.

import { ticks } from "../units.js";
import { escape, loadFigure, wordsOf } from "./words.js";

const kWidth = 310, kHeight = 190, kLeft = 46, kRight = 10, kTop = 20, kBottom = 34; // pixels
const kHeadroom = 0.14; // of the loads, above the highest

/** Of displacements [m]: the unit in which the largest has few digits. */
const lengthUnit = (most) => (most >= 0.5 ? ["m", 1] : most >= 5e-6 ? ["mm", 1e-3] : ["µm", 1e-6]);

/** The last reset of the displacement: the points before belong to the path to the scenario's own strength. */
const lastLeg = (displacements) =>
  displacements.reduce((begin, u, k) => (k > 0 && u === 0 && displacements[k - 1] > 0 ? k : begin), 0);

/** "" for a run without a curve: one of an older file, or that no search has kept. */
export function pathHtml(failure) {
  const words = failure && wordsOf(failure.analysis);
  if (!words || !failure.pathLoad?.length) return "";
  const most = Math.max(...failure.pathDisplacement, 1e-12), [unit, metres] = lengthUnit(most);
  const loads = Array.from(failure.pathLoad, (load) => load / words.scale), answer = failure.answer / words.scale;
  const low = Math.min(...loads, answer), highest = Math.max(...loads, answer);
  const high = highest + kHeadroom * (highest - low || 1), far = most / metres;
  const x = (u) => kLeft + (u / far) * (kWidth - kLeft - kRight);
  const y = (load) => kTop + (1 - (load - low) / (high - low)) * (kHeight - kTop - kBottom);
  const tick = (value) => String(Number(value.toPrecision(6))).replace("-", "−");
  const line = (from, to, role) => {
    const points = loads.slice(from, to).map((load, k) => `${x(failure.pathDisplacement[from + k] / metres).toFixed(1)},${y(load).toFixed(1)}`);
    return points.length ? `<polyline class="${role}" points="${points.join(" ")}"/>` : "";
  };
  const begin = lastLeg(Array.from(failure.pathDisplacement));
  const across = ticks(low, high, 5).map((v) => `<path class="grid" d="M${kLeft} ${y(v).toFixed(1)}H${kWidth - kRight}"/>` +
    `<text x="${kLeft - 5}" y="${(y(v) + 4).toFixed(1)}" text-anchor="end">${tick(v)}</text>`);
  const along = ticks(0, far, 5).map((v) => `<path class="grid" d="M${x(v).toFixed(1)} ${kTop}V${kHeight - kBottom}"/>` +
    `<text x="${x(v).toFixed(1)}" y="${kHeight - kBottom + 14}" text-anchor="middle">${tick(v)}</text>`);
  const figure = (load) => loadFigure(words, load, words.decimals - 1); // as in the search's text
  const told = `${figure(failure.answer)}: stands at ${figure(failure.stands)}, fails at ${figure(failure.fails)}`;
  return `<h3>Load against displacement</h3><svg id="path" viewBox="0 0 ${kWidth} ${kHeight}" role="img" aria-label="${escape(`Curve of the search; answer ${told}`)}">` +
    `${across.join("")}${along.join("")}${line(0, begin, "before")}${line(begin, loads.length, "curve")}` +
    `<path class="answer" d="M${kLeft} ${y(answer).toFixed(1)}H${kWidth - kRight}"/>` +
    `<text class="told" x="${kLeft + 4}" y="${Math.max(kTop + 8, y(answer) - 5).toFixed(1)}">${escape(told)}</text>` +
    `<text x="4" y="10">${escape(words.text)}${words.unit === "deg" ? " (°)" : ""}</text>` +
    `<text x="${(kLeft + kWidth - kRight) / 2}" y="${kHeight - 4}" text-anchor="middle">largest displacement of a block (${unit})</text></svg>`;
}
