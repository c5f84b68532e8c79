// The role of each block in a failure, by the rule of talus/motion_roles.h; its numbers come with the page. A block moves when
// its displacement is a share of the largest one and more than a share of the smallest block's size, since a file has no
// elastic displacements. It topples when its rotation, times the moving group's extent, exceeds a share of its displacement.

import { get, norm } from "./poses.js";

export const Role = { fixed: 0, driven: 1, stands: 2, slides: 3, topples: 4 };
export const roleNames = ["fixed", "driven", "stands", "slides", "topples"];

export const rule = JSON.parse(document.getElementById("motion-rule")?.textContent ?? "{}");
const kStandingShare = rule.deflections * rule.deflectionOfSize; // of a block's size: a smaller displacement is no motion

/** Displacement of a block's farthest corner since the start [m]. */
export const motionOf = (frame, block, radius) =>
  norm(get(frame.displacement, block)) + norm(get(frame.rotation, block)) * radius[block];

const smallestFree = (header) =>
  header.size.reduce((least, size, b) => (header.motion[b] === 0 ? Math.min(least, size) : least), Infinity);

/** Diagonal of the box around the blocks that move [m]. */
function movingExtent(header, frame, radius, moving) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  moving.forEach((moves, b) => {
    if (!moves) return;
    const at = get(header.centroid, b), u = get(frame.displacement, b);
    for (let k = 0; k < 3; ++k) {
      low[k] = Math.min(low[k], at[k] + u[k] - radius[b]);
      high[k] = Math.max(high[k], at[k] + u[k] + radius[b]);
    }
  });
  return norm([high[0] - low[0], high[1] - low[1], high[2] - low[2]]);
}

/** Input of the rule from a frame: each block's displacement, the moving blocks, the extent of the moving group. */
export function motionAt(header, frame, radius) {
  const motion = header.names.map((_, b) => (header.motion[b] === 0 ? motionOf(frame, b, radius) : 0));
  const largest = motion.reduce((most, value) => Math.max(most, value), 0);
  const least = Math.max(kStandingShare * smallestFree(header), rule.share * largest);
  const moving = motion.map((way) => way > least);
  return { motion, largest, moving, extent: movingExtent(header, frame, radius, moving) };
}

const rolesOfSearch = [Role.stands, Role.slides, Role.topples, Role.topples]; // in the order of the schema

/** Role of every block by the search that kept this run, else by its motion up to this frame, as a Uint8Array. */
export function rolesAt(header, frame, radius) {
  if (header.failure)
    return Uint8Array.from(header.motion, (motion, b) =>
      motion === 1 ? Role.fixed : motion === 2 ? Role.driven : rolesOfSearch[header.failure.role[b]] ?? Role.stands);
  const { motion, moving, extent } = motionAt(header, frame, radius);
  return Uint8Array.from(motion, (way, b) => {
    if (header.motion[b] === 1) return Role.fixed;
    if (header.motion[b] === 2) return Role.driven;
    if (!moving[b]) return Role.stands;
    return norm(get(frame.rotation, b)) * extent > rule.toppling * way ? Role.topples : Role.slides;
  });
}

/** "sliding", "toppling", "mixed" or "none", by moving mass as in the engine. */
export function overallMode(header, roles) {
  if (header.failure) return header.failure.mode;
  let sliding = 0, toppling = 0;
  roles.forEach((role, b) => {
    if (role === Role.slides) sliding += header.mass[b];
    if (role === Role.topples) toppling += header.mass[b];
  });
  const all = sliding + toppling;
  if (all === 0) return "none";
  return sliding >= rule.pure * all ? "sliding" : toppling >= rule.pure * all ? "toppling" : "mixed";
}

/** Time at which a block was displaced by that share of its size, or null. */
export function setOffTime(header, frames, block, radius) {
  const found = frames.find((frame) => motionOf(frame, block, radius) > kStandingShare * header.size[block]);
  return found ? found.time : null;
}
