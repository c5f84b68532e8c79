// Tables: a column says how its values are shown, a cell is a number, a text, null or a share with its interval.

import { html, words } from "./dom.js";
import { figure, fixed, percent } from "./numbers.js";

const kLong = 22, kSentence = 60; // letters

const isText = (column) => column.format === "text";

function cellText(value, column) {
  if (value === null || value === undefined) return "–";
  if (typeof value === "object") return `${percent(value.share)} ${`(${percent(value.low)} to ${percent(value.high)})`.replaceAll(" ", "\u00a0")}`;
  if (typeof value !== "number") return value;
  if (column.format === "figure") return figure(value);
  if (column.format === "share") return percent(value);
  return column.decimals === undefined ? String(value) : fixed(value, column.decimals, column.signed);
}

const classes = (column, ...more) =>
  [isText(column) && "words", column.start && "start", ...more].filter(Boolean).join(" ");

/** The row of what columns side by side have in common, if any have. */
function groupRow(columns) {
  if (!columns.some((column) => column.group)) return null;
  const groups = [];
  for (const column of columns) {
    const last = groups.at(-1);
    if (last && column.group && last.group === column.group) ++last.span;
    else groups.push({ ...column, span: 1 });
  }
  return html("tr", {}, groups.map((group) => html("th", {
    class: classes(group), colspan: group.span > 1 && group.span, scope: group.span > 1 ? "colgroup" : "col",
  }, words(group.group ?? ""))));
}

/** Text in which a field's name of this length may be broken after its dots and lines. */
function breakable(text) {
  const pieces = text.split(/(\S{20,})/).flatMap((part, k) => (k % 2 ? part.split(/(?<=[._/])(?=[a-z])/i).flatMap((one, j) => (j ? [html("wbr"), one] : one)) : part));
  return pieces.flatMap((piece) => (typeof piece === "string" ? words(piece) : piece));
}

/** Long texts of a column are broken into lines, sentences into wider lines, and a share before its interval. */
function breaking(column, texts, values) {
  if (values.some((value) => typeof value === "object" && value !== null)) return "share";
  const longest = isText(column) ? texts.reduce((most, text) => Math.max(most, text.length), 0) : 0;
  return longest > kSentence ? "sentence" : longest > kLong ? "long" : "";
}

/** Marks a table that continues beyond the right edge of its box, or beneath its first column. */
function showWhereCut(box) {
  const look = () => {
    box.classList.toggle("more", box.scrollLeft + box.clientWidth < box.scrollWidth - 1);
    box.classList.toggle("moved", box.scrollLeft > 0);
  };
  new ResizeObserver(look).observe(box);
  box.addEventListener("scroll", look, { passive: true });
  return box;
}

/** `alerts`: rows that differ from their reference. */
export function table({ caption, columns, rows, alerts = [] }) {
  const head = html("tr", {}, columns.map((column) => html("th", { class: classes(column), scope: "col" }, words(column.title))));
  const texts = columns.map((column, k) => rows.map((row) => cellText(row[k], column)));
  const breaks = columns.map((column, k) => breaking(column, texts[k], rows.map((row) => row[k])));
  const body = rows.map((_, r) => html("tr", { class: alerts.includes(r) && "bad" }, columns.map((column, k) =>
    html("td", { class: classes(column, column.strong && "strong", breaks[k]) }, breaks[k] ? breakable(texts[k][r]) : words(texts[k][r])))));
  return showWhereCut(html("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": caption },
    html("table", {}, html("caption", {}, html("span", { class: "whole" }, words(caption))),
      html("thead", {}, groupRow(columns), head), html("tbody", {}, body))));
}
