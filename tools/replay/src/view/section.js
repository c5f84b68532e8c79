// The section plane: everything in front of it is hidden, and cut blocks look solid.

import * as THREE from "three";
import { add, dot, get } from "../data/poses.js";

/** Directions a section may look along, in the model frame. */
export const sections = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };

/** Uniforms shared by everything that is cut: a point p is drawn where dot(xyz, p) <= w. */
export const cutUniforms = () => ({ cut: { value: new THREE.Vector4(0, 0, 0, 1) } });

/** Extent of the blocks along a direction, at the start of the run. */
export function reach(header, along, shown) {
  let low = Infinity, high = -Infinity;
  for (let v = 0, b = 0; v < header.vertex.x.length; ++v) {
    while (v >= header.vertexBegin[b + 1]) ++b;
    if (!shown(b)) continue;
    const at = dot(along, get(header.vertex, v));
    low = Math.min(low, at), (high = Math.max(high, at));
  }
  return low < high ? [low, high] : [0, 1];
}

/**
 * The plane of a section: `axis` x, y, z or "" for none, `share` how far it has come in (0 to 1), `flipped` from the other
 * side. Null without one.
 */
export function planeOf(header, { axis, share, flipped }, shown) {
  if (!sections[axis]) return null;
  const normal = flipped ? sections[axis].map((x) => -x) : sections[axis];
  const [low, high] = reach(header, normal, shown);
  return { normal, at: high - share * (high - low) };
}

/** Whether a point of the model is cut away. */
export const isCut = (plane, point) => plane !== null && dot(plane.normal, point) > plane.at;

/** "x = 3.2 m", in the model's coordinates. */
export function planeText(plane, axis, text) {
  const sign = plane.normal.reduce((sum, x) => sum + x, 0);
  return `${axis} = ${text(sign * plane.at)}`;
}

export const alongRay = (origin, direction, t) => add(origin, direction.map((x) => x * t));
