// Sums over the contact points of a full state, per interface.

import { add, get, restOffset, scale, turn } from "./poses.js";

export const State = { open: 0, sticking: 1, slipping: 2 };
export const stateNames = ["open", "sticking", "slipping"];

/** Sums over the Lps of interface i: forces [N], areas [m²], shares 0..1, and where the normal force acts. */
function sumsOf(full, i) {
  const f = full.interfaces, p = full.points;
  const sums = { points: 0, normal: 0, shear1: 0, shear2: 0, water: 0, area: 0, open: 0, slipping: 0, broken: 0,
    shear: 0, strength: 0, xi: 0, eta: 0 };
  for (let k = f.pointBegin[i]; k < f.pointBegin[i + 1]; ++k) {
    const shear = Math.hypot(p.shear1[k], p.shear2[k]);
    ++sums.points;
    sums.normal += p.normal[k], (sums.shear1 += p.shear1[k]), (sums.shear2 += p.shear2[k]);
    sums.water += p.water[k] ?? 0;
    sums.area += p.area[k];
    if (p.state[k] === State.open) sums.open += p.area[k];
    if (p.state[k] === State.slipping) ++sums.slipping;
    if (p.bond[k] < 1) ++sums.broken;
    sums.xi += p.normal[k] * p.xi[k], (sums.eta += p.normal[k] * p.eta[k]);
    // The file has |S| over strength; the strength follows where an Lp carries shear.
    if (p.mobilised[k] > 0) sums.shear += shear, (sums.strength += shear / p.mobilised[k]);
  }
  sums.openShare = sums.area > 0 ? sums.open / sums.area : 1;
  sums.mobilised = sums.strength > 0 ? Math.min(1, sums.shear / sums.strength) : 0;
  const pressed = sums.normal > 1e-12;
  sums.xi = pressed ? sums.xi / sums.normal : 0, (sums.eta = pressed ? sums.eta / sums.normal : 0);
  sums.edge = pressed ? edgeShare(full, i, sums.xi, sums.eta) : 0;
  return sums;
}

/** 0: the normal force acts at the patch's centroid (its origin); 1: on its edge. */
function edgeShare(full, i, xi, eta) {
  const f = full.interfaces, away = Math.hypot(xi, eta);
  if (away < 1e-9) return 0;
  let reach = 0;
  for (let k = f.patchBegin[i]; k < f.patchBegin[i + 1]; ++k)
    reach = Math.max(reach, (f.patchXi[k] * xi + f.patchEta[k] * eta) / away);
  return reach > 0 ? Math.min(1, away / reach) : 0;
}

/** A place kept for a vertex or an edge, of one corner, that touches nothing now. */
function isIdle(full, i) {
  return full.interfaces.patchBegin[i + 1] - full.interfaces.patchBegin[i] === 1 && full.sums[i].normal === 0;
}

/** Adds derived data to a full state: sums per interface, interfaces and water force per block. */
export function prepareFull(header, full) {
  const count = full.interfaces.count;
  full.sums = Array.from({ length: count }, (_, i) => sumsOf(full, i));
  full.ofBlock = new Map();
  const note = (block, i) => (full.ofBlock.get(block) ?? full.ofBlock.set(block, []).get(block)).push(i);
  for (let i = 0; i < count; ++i)
    if (!isIdle(full, i)) note(full.interfaces.blockA[i], i), note(full.interfaces.blockB[i], i);
  full.walls = new Map();
  for (let k = 0; k < full.wet.count; ++k) {
    const b = full.wet.block[k];
    (full.walls.get(b) ?? full.walls.set(b, []).get(b)).push(k);
  }
  return full;
}

/** Force of the water on a wall k, in the model frame [N], with its block's turn since the start. */
export function waterForce(header, full, k, turned) {
  const b = full.wet.block[k];
  return turn(turned, restOffset(header, b, get(full.wet.force, k)));
}

/** The neighbours of a block: {i, other, force on the block [N], sums}. */
export function neighboursOf(full, block) {
  const f = full.interfaces;
  return (full.ofBlock.get(block) ?? []).map((i) => {
    const isB = f.blockB[i] === block;
    return { i, other: isB ? f.blockA[i] : f.blockB[i], force: scale(get(f.force, i), isB ? 1 : -1), sums: full.sums[i] };
  });
}

/** Where an interface's force acts: its normal force's point, else the patch's centroid (on block a, from rest). */
export function pointOfAction(header, full, i) {
  const f = full.interfaces, s = full.sums[i];
  const own = add(get(f.origin, i), add(scale(get(f.e1, i), s.xi), scale(get(f.e2, i), s.eta)));
  return restOffset(header, f.blockA[i], own);
}
