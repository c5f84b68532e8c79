// The page of a report: reads the JSON that the program put into it and draws its content (../README.md).

import { html, words } from "./dom.js";
import { drawings } from "./drawing.js";
import { plotFigure } from "./plot.js";
import { table } from "./table.js";

const plots = [];

const drawers = {
  text: ({ text, style }) => html("p", { class: style }, words(text)),
  heading: ({ text }) => html("h3", {}, words(text)),
  table,
  drawings,
  plot(block) {
    const plot = plotFigure(block);
    plots.push(plot);
    return plot.figure;
  },
  facts: ({ items }) => html("dl", {}, items.flatMap(([term, value]) => [html("dt", {}, words(term)), html("dd", {}, words(value))])),
  file: ({ name, text }) => html("details", {}, html("summary", {}, name), html("pre", { tabindex: "0" }, text)),
};

const draw = (block) => [drawers[block.type](block)].flat().filter(Boolean);

/** Three plots or more in a row stand side by side where there is room. */
function arranged(blocks) {
  const rows = [];
  for (const block of blocks) {
    if (block.type === "plot" && rows.at(-1)?.[0].type === "plot") rows.at(-1).push(block);
    else rows.push([block]);
  }
  return rows.flatMap((row) => (row.length > 2 ? html("div", { class: "plots" }, row.flatMap(draw)) : row.flatMap(draw)));
}

function section({ id, title, blocks }) {
  return html("section", { "aria-labelledby": id }, html("h2", { id }, words(title)), arranged(blocks));
}

function opening(report) {
  const links = report.sections.map(({ id, nav }) => html("a", { href: `#${id}` }, nav));
  return [
    html("h1", {}, words(report.heading)),
    ...report.opening.flatMap(draw),
    html("nav", { "aria-label": "Contents" }, links.flatMap((link) => [link, " "])),
  ];
}

function show(report) {
  document.title = report.title;
  document.getElementById("opening").replaceChildren(...opening(report));
  document.getElementById("sections").replaceChildren(...report.sections.map(section));
  for (const { draw } of plots) draw();
  const observer = new ResizeObserver(() => plots.forEach(({ draw }) => draw()));
  observer.observe(document.getElementById("sections"));
  document.getElementById(decodeURIComponent(location.hash.slice(1)))?.scrollIntoView();
}

try {
  show(JSON.parse(document.getElementById("report").textContent));
  document.documentElement.dataset.state = "ready";
} catch (error) {
  document.documentElement.dataset.state = "failed";
  document.getElementById("opening").append(html("p", { class: "alert", role: "alert" }, `This report cannot be shown: ${error.message}`));
  throw error;
}
