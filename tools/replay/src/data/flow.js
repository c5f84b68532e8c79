// Pressure of steady flow in the joints, as the header has it: triangles of the polygons where blocks touch.

import { add, cross, get, norm, scale, sub } from "./poses.js";
import { wetPart } from "./wet.js";

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

/** Integrals of a pressure that is linear on a triangle, where it is positive: { force along its normal [N], moment [N m] }. */
function pushOn(corners, pressures) {
  const { part, values } = wetPart(corners, pressures);
  let force = [0, 0, 0], moment = [0, 0, 0];
  for (let k = 1; k + 1 < part.length; ++k) {
    const at = [part[0], part[k], part[k + 1]], p = [values[0], values[k], values[k + 1]], sum = p[0] + p[1] + p[2];
    const across = scale(cross(sub(at[1], at[0]), sub(at[2], at[0])), 0.5);
    force = add(force, scale(across, sum / 3));
    at.forEach((x, j) => (moment = add(moment, scale(x, (norm(across) * (sum + p[j])) / 12))));
  }
  return { force, moment };
}

/**
 * What the flow pushes on a block with, polygon by polygon: { offset, force }, the point from its centroid [m] and the
 * force [N] as it lies at the start. Both turn with the block.
 */
export function flowPushes(header, block) {
  const { flow } = header, centroid = get(header.centroid, block), pushes = [];
  for (let t = 0, first = 0; t < (flow?.joint.length ?? 0); ++t) {
    if (!samePolygon(flow, first, t)) first = t;
    if (flow.blockA[t] !== block && flow.blockB[t] !== block) continue;
    const nodes = [0, 1, 2].map((k) => flow.triangle[3 * t + k]);
    const { force, moment } = pushOn(nodes.map((n) => sub(get(flow.node, n), centroid)), nodes.map((n) => flow.pressure[n]));
    if (norm(force) === 0) continue;
    if (pushes.at(-1)?.polygon !== first) pushes.push({ polygon: first, force: [0, 0, 0], moment: [0, 0, 0] });
    const all = pushes.at(-1), towards = flow.blockB[t] === block ? 1 : -1;
    all.force = add(all.force, scale(force, towards)), (all.moment = add(all.moment, moment));
  }
  return pushes.map(({ force, moment }) => ({ force, offset: scale(moment, 1 / norm(force)) }));
}
