// Pressure of steady flow in the joints, as the header has it: triangles of the polygons where blocks touch.

/** Edges of the polygons, as pairs of nodes per triangle: those that no other triangle of the same polygon shares. */
export function outlineOf(flow) {
  const edges = [];
  for (let first = 0, next = 0; first < flow.joint.length; first = next) {
    const seen = new Map();
    for (next = first; next < flow.joint.length && samePolygon(flow, first, next); ++next)
      for (const k of [0, 1, 2]) {
        const [a, b] = [flow.triangle[3 * next + k], flow.triangle[3 * next + ((k + 1) % 3)]];
        const key = a < b ? `${a},${b}` : `${b},${a}`;
        if (!seen.delete(key)) seen.set(key, { triangle: next, nodes: [a, b] });
      }
    edges.push(...seen.values());
  }
  return edges;
}

const samePolygon = (flow, j, k) =>
  flow.blockA[j] === flow.blockA[k] && flow.blockB[j] === flow.blockB[k] && flow.joint[j] === flow.joint[k];

export const largestPressure = (flow) => flow.pressure.reduce((most, p) => Math.max(most, p), 0);

/** Lowest and highest pressure that acts between two blocks [Pa]; null where the flow has no polygon. */
export function pressureBetween(flow, a, b) {
  let low = Infinity, high = -Infinity;
  for (let t = 0; t < flow.joint.length; ++t) {
    if (!((flow.blockA[t] === a && flow.blockB[t] === b) || (flow.blockA[t] === b && flow.blockB[t] === a))) continue;
    for (const k of [0, 1, 2]) {
      const p = Math.max(0, flow.pressure[flow.triangle[3 * t + k]]);
      low = Math.min(low, p), (high = Math.max(high, p));
    }
  }
  return low <= high ? [low, high] : null;
}
