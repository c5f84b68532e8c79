// Side views: outlines in metres, drawn to scale; a shape's role is its class.

import { html, link, svg, words } from "./dom.js";

const width = 340, margin = 10; // [px]

function fitted({ shapes }) {
  const spots = shapes.flatMap((shape) => shape.points);
  const xs = spots.map(([x]) => x), ys = spots.map(([, y]) => y);
  const left = Math.min(...xs), top = Math.max(...ys), scale = (width - 2 * margin) / (Math.max(...xs) - left);
  const at = ([x, y]) => [margin + scale * (x - left), margin + scale * (top - y)].map((pixel) => pixel.toFixed(1));
  return { at, height: scale * (top - Math.min(...ys)) + 2 * margin };
}

function picture(drawing) {
  const { at, height } = fitted(drawing);
  const shapes = drawing.shapes.map(({ role, points, open, tip }) =>
    svg(open ? "polyline" : "polygon", { class: role, points: points.map((spot) => at(spot).join()).join(" ") },
      tip ? svg("title", {}, tip) : null));
  const [x, y] = drawing.label ? at(drawing.label.at) : [];
  const label = drawing.label ? svg("text", { class: "label", x, y }, drawing.label.text) : null;
  return svg("svg", { class: "drawing", viewBox: `0 0 ${width} ${height.toFixed(1)}`, role: "img", "aria-label": drawing.title },
    svg("desc", {}, drawing.description), shapes, label);
}

function drawnFigure(drawing) {
  const { caption } = drawing;
  const shown = picture(drawing);
  const framed = drawing.links?.length ? link(drawing.links[0].href, shown) : shown;
  const links = (drawing.links ?? []).flatMap(({ href, text }, k) => [k ? "; " : " ", link(href, text)]);
  return html("figure", {}, framed, html("figcaption", {}, html("strong", {}, words(caption.title)), ": ", words(caption.text.replace(/(\d)-(\d)/g, "$1\u2011$2")),
    links, links.length ? "." : null));
}

const swatch = (role) => svg("svg", { viewBox: "0 0 26 14", "aria-hidden": "true" },
  svg("rect", { x: 1, y: 1, width: 24, height: 12, class: role }));

export function drawings({ items, colours = [], pair }) {
  const key = colours.map(({ role, text }) => html("li", {}, swatch(role), text));
  return [
    key.length ? html("ul", { class: "key" }, key) : null,
    html("div", { class: pair ? "drawings pair" : "drawings" }, items.map(drawnFigure)),
  ];
}
