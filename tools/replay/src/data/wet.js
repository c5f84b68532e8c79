// Polygons under water.

import { add, scale } from "./poses.js";

/** The part of a polygon where `depth` (linear, given at the corners) is positive, and its surface line. */
export function wetPart(points, depths) {
  const part = [], values = [], surface = [];
  points.forEach((p, k) => {
    const next = (k + 1) % points.length;
    if (depths[k] > 0) part.push(p), values.push(depths[k]);
    if (depths[k] > 0 !== depths[next] > 0) {
      const share = depths[k] / (depths[k] - depths[next]);
      const cut = add(scale(p, 1 - share), scale(points[next], share));
      part.push(cut), values.push(0), surface.push(cut);
    }
  });
  return { part, values, surface };
}
