// Tables: a column says how its values are shown, a cell is a number, a text, null or a share with its interval.

import { html, words } from "./dom.js";
import { figure, fixed, percent } from "./numbers.js";

const isText = (column) => column.format === "text";

function cellText(value, column) {
  if (value === null || value === undefined) return "–";
  if (typeof value === "object") return `${percent(value.share)} (${percent(value.low)} to ${percent(value.high)})`;
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

/** `alerts`: rows that are not as they should be. */
export function table({ caption, columns, rows, alerts = [] }) {
  const head = html("tr", {}, columns.map((column) => html("th", { class: classes(column), scope: "col" }, words(column.title))));
  const body = rows.map((row, r) => html("tr", { class: alerts.includes(r) && "bad" }, row.map((value, k) => {
    const column = columns[k], text = cellText(value, column);
    return html("td", { class: classes(column, column.strong && "strong", isText(column) && text.length > 60 && "long") }, words(text));
  })));
  return html("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": caption },
    html("table", {}, html("caption", {}, words(caption)), html("thead", {}, groupRow(columns), head), html("tbody", {}, body)));
}
