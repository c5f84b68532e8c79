// The block or joint under the pointer, by casting its ray at them as drawn.

import { add, cross, dot, get, norm, poseOf, scale, sub, turn } from "../data/poses.js";
import { patchCorners } from "./sheets.js";

/** Distance along the ray to a convex planar polygon, or Infinity. */
function rayToPolygon(origin, direction, corners) {
  const normal = cross(sub(corners[1], corners[0]), sub(corners[2], corners[0]));
  const slope = dot(direction, normal);
  if (Math.abs(slope) < 1e-300) return Infinity;
  const t = dot(sub(corners[0], origin), normal) / slope;
  if (!(t > 0)) return Infinity;
  const hit = add(origin, scale(direction, t));
  let sign = 0;
  for (let k = 0; k < corners.length; ++k) {
    const edge = sub(corners[(k + 1) % corners.length], corners[k]);
    const side = Math.sign(dot(cross(edge, sub(hit, corners[k])), normal));
    if (side !== 0 && sign !== 0 && side !== sign) return Infinity;
    if (side !== 0) sign = side;
  }
  return t;
}

function rayNearSphere(origin, direction, centre, radius) {
  const to = sub(centre, origin);
  const along = dot(to, direction);
  return along > -radius && norm(sub(to, scale(direction, along))) <= radius;
}

/**
 * The first block along the ray (unit direction, model frame) and the distance to it: { block, t }, or { -1, Infinity }.
 * `seen(block)` and `isCut(point)` say what is not drawn.
 */
export function pickBlock(header, radius, frames, times, origin, direction, seen = () => true, isCut = () => false) {
  let best = -1, nearest = Infinity;
  for (let b = 0; b < header.names.length; ++b) {
    if (!seen(b)) continue;
    const pose = poseOf(header, frames, b, times);
    if (!rayNearSphere(origin, direction, pose.position, radius[b])) continue;
    for (let f = header.faceBegin[b]; f < header.faceBegin[b + 1]; ++f) {
      const corners = [];
      for (let k = header.faceVertexBegin[f]; k < header.faceVertexBegin[f + 1]; ++k) {
        const offset = sub(get(header.vertex, header.faceVertex[k]), get(header.centroid, b));
        corners.push(add(pose.position, turn(pose.turn, offset)));
      }
      const t = rayToPolygon(origin, direction, corners);
      if (t < nearest && !isCut(add(origin, scale(direction, t)))) (nearest = t), (best = b);
    }
  }
  return { block: best, t: nearest };
}

/** Index of the first joint patch along the ray, or -1; the next one when `after` is the first. */
export function pickInterface(header, full, frames, times, origin, direction, after = -1) {
  if (!full) return -1;
  const hits = [];
  for (let i = 0; i < full.interfaces.count; ++i) {
    const pose = poseOf(header, frames, full.interfaces.blockA[i], times);
    const corners = patchCorners(header, full, i).map((p) => add(pose.position, turn(pose.turn, p)));
    const t = corners.length > 2 ? rayToPolygon(origin, direction, corners) : Infinity;
    if (t < Infinity) hits.push({ i, t });
  }
  hits.sort((a, b) => a.t - b.t);
  const at = hits.findIndex((hit) => hit.i === after);
  return hits.length ? hits[(at + 1) % hits.length].i : -1;
}
