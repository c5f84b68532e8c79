// How large things are and where north is: scale bar and compass.

import { quantity } from "../units.js";

const kLongest = 130; // [px]

/** The longest of 1, 2, 5, 10, ... that is no longer than this. */
export function niceLength(most) {
  const power = 10 ** Math.floor(Math.log10(most));
  return [5, 2, 1].map((k) => k * power).find((length) => length <= most) ?? power;
}

/** {metres, pixels, text} of a bar, by the size of a pixel at the middle of the view. */
export function scaleBar(metresPerPixel) {
  const metres = niceLength(kLongest * metresPerPixel);
  return { metres, pixels: metres / metresPerPixel, text: quantity(metres, "m", 3) };
}

export const scaleSvg = ({ pixels, text }) =>
  `<svg width="${Math.ceil(pixels) + 2}" height="22" role="img" aria-label="Scale: ${text} at the middle of the view">` +
  `<path d="M1 14v6H${pixels.toFixed(1)}v-6M1 20v-3" fill="none" stroke="currentColor" stroke-width="1.5"/>` +
  `<text x="${(pixels / 2).toFixed(1)}" y="11" text-anchor="middle" fill="currentColor">${text}</text></svg>`;

const bearing = (degrees) => String(Math.round(((degrees % 360) + 360) % 360) % 360).padStart(3, "0");

/** Where a view looks to: clockwise from north, and how far down, in degrees. */
export function viewText([x, y, z]) {
  const down = (Math.asin(Math.max(-1, Math.min(1, -z))) * 180) / Math.PI;
  const level = Math.hypot(x, y);
  const to = level > 1e-3 ? `to ${bearing((Math.atan2(x, y) * 180) / Math.PI)}°, ` : "";
  return `${to}${Math.abs(down).toFixed(0)}° ${down < -0.5 ? "up" : "down"}`;
}

/** Ring of the horizon with north, as it is seen: `north` and `east` as [right, up, towards] of unit vectors. */
export function compassSvg({ north, east }) {
  const at = (angle, size) =>
    [0, 1].map((k) => (k ? -1 : 1) * size * (north[k] * Math.cos(angle) + east[k] * Math.sin(angle)));
  const point = (angle, size) => at(angle, size).map((v) => v.toFixed(1)).join(" ");
  const ring = Array.from({ length: 37 }, (_, k) => point((k * Math.PI) / 18, 38)).join("L");
  const ticks = [1, 2, 3].map((k) => `M${point((k * Math.PI) / 2, 34)}L${point((k * Math.PI) / 2, 38)}`).join("");
  const [x, y] = at(0, 46);
  return `<g stroke="currentColor" fill="none" opacity=".55"><path d="M${ring}Z${ticks}"/></g>` +
    `<path d="M${point(0, 41)}L${point(0.14, 34)}L${point(-0.14, 34)}Z" fill="currentColor"/>` +
    `<text x="${x.toFixed(1)}" y="${(y + 4).toFixed(1)}" text-anchor="middle" font-weight="700" fill="currentColor">N</text>`;
}
