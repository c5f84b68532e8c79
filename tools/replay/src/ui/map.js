// Texts on a map of failure: its legend, a cell's numbers, and facts of the batch.

import { area } from "../units.js";
import { gradientOf } from "../view/colours.js";
import { close, escape, facts } from "./words.js";

/** Three digits that count. */
const figure = (value) => String(Number(value.toPrecision(3)));

export function mapLegend(map, quantity) {
  const { title, most } = map.quantities[quantity];
  return `${escape(title)}<div class="bar" style="background:${gradientOf(map.colours)}"></div>` +
    `<div class="ends"><span>0</span><span>${figure(most / 2)}</span><span>${figure(most)}</span></div>` +
    `<ul><li><i style="background:${map.none}"></i>in no failure</li></ul>`;
}

/** What pictures say of the colours. */
export const mapCaption = (map, quantity) =>
  ({ title: map.quantities[quantity].title, most: figure(map.quantities[quantity].most), scale: map.colours });

const probabilityOf = ({ quantities, cells }, cell) =>
  `${figure(quantities.probability.values[cell])} (${figure(cells.low[cell])} to ${figure(cells.high[cell])})`;

/** One line, for the pointer. */
export const cellTip = (map, cell) =>
  `probability ${probabilityOf(map, cell)}, ${figure(map.cells.volume[cell])} m³/m²`;

export function cellText(map, cell) {
  const { cells } = map;
  const rows = [
    ["Probability of failure", figure(map.quantities.probability.values[cell])],
    [`${figure(100 * map.confidence)} % interval`, `${figure(cells.low[cell])} to ${figure(cells.high[cell])}`],
    ["Samples that fail here", `${cells.hits[cell]} of ${map.runs}`],
    ["Expected volume", `${figure(cells.volume[cell])} m³/m²`],
    ["in the whole cell", `${figure(cells.volume[cell] * cells.area[cell])} m³`],
    ["Area", area(cells.area[cell])],
  ];
  return `<h2><span>Cell ${cell}</span>${close}</h2>` + facts(rows);
}

/** Of the cells on one block of the scenario. */
export function blockCells(map, cells) {
  if (cells.length === 0)
    return `<p class="note">No cell of the map lies on this block. The base of the region and the sides where it was cut off have none.</p>`;
  const { values } = map.quantities.probability;
  const most = cells.reduce((best, cell) => (values[cell] > values[best] ? cell : best));
  const sum = (list) => cells.reduce((all, cell) => all + list(cell), 0);
  return facts([
    ["Cells on it", `${cells.length}, ${area(sum((cell) => map.cells.area[cell]))}`],
    ["Highest probability", probabilityOf(map, most)],
    ["lowest", probabilityOf(map, cells.reduce((best, cell) => (values[cell] < values[best] ? cell : best)))],
    ["Expected volume", `${figure(sum((cell) => map.cells.volume[cell] * map.cells.area[cell]))} m³`],
  ]);
}

export const mapText = (map, header) =>
  `<h3>The map</h3><p>${escape(map.lead)}</p>${map.warning ? `<p>${escape(map.warning)}</p>` : ""}` +
  facts(map.facts.map((pair) => pair.map(escape))) +
  `<p class="note">${escape(map.reading)}</p>` +
  `<details><summary class="note">Sweep file</summary><pre>${escape(map.sweep)}</pre></details>` +
  `<details><summary class="note">Scenario file</summary><pre>${escape(header.scenarioText)}</pre></details>`;
