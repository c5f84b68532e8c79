// Texts of the page: safe in markup, and loads in the program's words.

export const escape = (text) => String(text).replace(/[&<>"]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[c]);

/** The program's words for the loads of a search: { text, scale, decimals, unit }; undefined for one of another version. */
export const wordsOf = (analysis) => JSON.parse(document.getElementById("searches")?.textContent ?? "{}")[analysis];

/** A load of the file in its unit: "19.531°", "1.0799". */
export function loadFigure(words, load, decimals = words.decimals) {
  const figure = (load / words.scale).toFixed(decimals).replace("-", "−");
  return figure + (words.unit === "deg" ? "°" : words.unit && ` ${words.unit}`);
}

/** A table of names and values in the panel. */
export const facts = (rows) => `<dl>${rows.map(([name, value]) => `<dt>${name}</dt><dd>${value}</dd>`).join("")}</dl>`;

export const close = `<button class="quiet" data-close aria-label="Select nothing">✕</button>`;
