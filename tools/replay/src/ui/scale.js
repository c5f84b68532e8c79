// Scale bar and compass.

import { quantity } from "../units.js";

const kLongest = 130, kWidest = 0.24; // of a scale bar [px], and in widths of the view

/** The longest of 1, 2, 5, 10, ... that is no longer than this. */
export function niceLength(most) {
  const power = 10 ** Math.floor(Math.log10(most));
  return [5, 2, 1].map((k) => k * power).find((length) => length <= most) ?? power;
}

/** {metres, pixels, text} of a bar, by the size of a pixel at the middle of the view and the view's width. */
export function scaleBar(metresPerPixel, width = Infinity) {
  const metres = niceLength(Math.min(kLongest, kWidest * width) * metresPerPixel);
  return { metres, pixels: metres / metresPerPixel, text: quantity(metres, "m", 3) };
}

export const scaleSvg = ({ pixels, text }) =>
  `<svg width="${Math.ceil(pixels) + 2}" height="22" role="img" aria-label="Scale: ${text} at the middle of the view">` +
  `<path d="M1 14v6H${pixels.toFixed(1)}v-6M1 20v-3" fill="none" stroke="currentColor" stroke-width="1.5"/>` +
  `<text x="${(pixels / 2).toFixed(1)}" y="11" text-anchor="middle" fill="currentColor">${text}</text></svg>`;

const bearing = (degrees) => String(Math.round(((degrees % 360) + 360) % 360) % 360).padStart(3, "0");

/** Direction of a view: clockwise from north, and plunge, in degrees. */
export function viewText([x, y, z]) {
  const down = (Math.asin(Math.max(-1, Math.min(1, -z))) * 180) / Math.PI;
  const level = Math.hypot(x, y);
  const to = level > 1e-3 ? `to ${bearing((Math.atan2(x, y) * 180) / Math.PI)}°, ` : "";
  return `${to}${Math.abs(down).toFixed(0)}° ${down < -0.5 ? "up" : "down"}`;
}

const kApart = 12, kOffLine = 8, kReach = 46; // of letters: from each other, from lines, from the middle at most [px]
const kAlong = 0.3; // least visible share of north's length: below it, north lies along the view
const colours = { x: "#c0392b", y: "#2e8b57", z: "#2f6fd0", g: "currentColor" };
const apart = ([x, y], [u, v]) => Math.hypot(x - u, y - v);

/** The place nearest to the wanted one where a letter is clear of other letters and of lines. */
function freePlace(wanted, letters, lines) {
  const isFree = (at) => Math.abs(at[0]) <= kReach && Math.abs(at[1]) <= kReach &&
    letters.every((other) => apart(at, other) >= kApart) && lines.every((point) => apart(at, point) >= kOffLine);
  for (let away = 0; away <= 2 * kReach; away += 2)
    for (let k = 0; k < (away ? 16 : 1); ++k) {
      const at = [wanted[0] + away * Math.cos((k * Math.PI) / 8), wanted[1] + away * Math.sin((k * Math.PI) / 8)];
      if (isFree(at)) return at;
    }
  return wanted;
}

const letter = (name, [x, y], more) =>
  `<text x="${x.toFixed(1)}" y="${(y + 4).toFixed(1)}" text-anchor="middle" ${more}>${name}</text>`;

/** The mark of a direction that goes away from the reader, a cross in a circle, or comes towards him, a dot in one. */
const along = (is_away, [x, y]) => `<g stroke="currentColor" fill="none"><circle cx="${x.toFixed(1)}" cy="${y.toFixed(1)}" r="4.5"/>` +
  `<path d="${is_away ? `M${x - 3} ${y - 3}l6 6M${x + 3} ${y - 3}l-6 6` : `M${x - 0.7} ${y}h1.4`}" stroke-width="${is_away ? 1 : 2}"/></g>`;

/**
 * Compass and axes as they are seen, [right, up, towards] of unit vectors: the ring of the horizon with `north` and `east`,
 * the model's axes x (uphill), y and z, and gravity. No letter stands on another one.
 */
export function compassSvg({ north, east }, axes) {
  const at = (angle, size) =>
    [0, 1].map((k) => (k ? -1 : 1) * size * (north[k] * Math.cos(angle) + east[k] * Math.sin(angle)));
  const point = (angle, size) => at(angle, size).map((v) => v.toFixed(1)).join(" ");
  const ring = Array.from({ length: 37 }, (_, k) => point((k * Math.PI) / 18, 38)).join("L");
  const ticks = [1, 2, 3].map((k) => `M${point((k * Math.PI) / 2, 34)}L${point((k * Math.PI) / 2, 38)}`).join("");
  const arms = Object.entries(axes).sort(([, a], [, b]) => a[2] - b[2]).map(([name, [x, y]]) => {
    const length = name === "g" ? 27 : 22;
    return { name, colour: colours[name], end: [x * length, -y * length] };
  });
  const lines = [at(0, 38), ...arms.flatMap(({ end }) => [0, 0.5, 1].map((share) => end.map((v) => share * v)))];
  const letters = [];
  const place = (wanted) => (letters.push(freePlace(wanted, letters, lines)), letters.at(-1));
  const level = Math.hypot(north[0], north[1]);
  const n = place(level > kAlong ? at(0, 46) : [-26, 24]);
  const bold = letter("N", n, 'font-weight="700" fill="currentColor"') + (level > kAlong ? "" : along(north[2] < 0, [n[0] + 13, n[1]]));
  const drawn = arms.map(({ name, colour, end: [u, v] }) =>
    `<path d="M0 0L${u.toFixed(1)} ${v.toFixed(1)}" stroke="${colour}" stroke-width="2"${name === "g" ? ' stroke-dasharray="3 2"' : ""}/>`);
  const named = arms.map(({ name, colour, end }) => letter(name, place(end.map((v) => 1.36 * v)), `fill="${colour}"`));
  return `<g stroke="currentColor" fill="none" opacity=".55"><path d="M${ring}Z${ticks}"/></g>${drawn.join("")}` +
    `<path d="M${point(0, 41)}L${point(0.14, 34)}L${point(-0.14, 34)}Z" fill="currentColor"/>${named.join("")}${bold}`;
}
