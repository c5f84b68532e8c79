// Motion in a run: which blocks move, in which direction, and whether they fly.

import { add, get, norm, scale, sub, upOf } from "./poses.js";
import { Role } from "./roles.js";

const kFlightShare = 0.1; // of the frames in which a block moves: a block that flies in more of them falls
const kFlightFit = 0.05; // largest difference of a flight's acceleration from gravity's, over g
const kMoves = 0.02; // of the fastest speed of the run: slower does not count as moving

/** Blocks that slide or topple by these roles. */
export const movingBlocks = (roles) =>
  Array.from(roles.keys()).filter((b) => roles[b] === Role.slides || roles[b] === Role.topples);

/** Level direction of the moving mass, or null when it has none. */
export function headingOf(header, frame, blocks) {
  let sum = [0, 0, 0], all = 0;
  for (const b of blocks) {
    const u = get(frame.displacement, b);
    sum = add(sum, scale(u, header.mass[b]));
    all += header.mass[b] * norm(u);
  }
  const level = Math.hypot(sum[0], sum[1]);
  return level > 0.1 * all && level > 0 ? Math.atan2(sum[1], sum[0]) : null;
}

/** Whether a block flies in much of its motion: its velocity then changes by gravity alone. */
export function falls(header, frames, block) {
  const g = header.gravity;
  if (!(g > 0) || frames.length < 3) return false;
  const fastest = frames.reduce((most, { velocity }) => Math.max(most, norm(get(velocity, block))), 0);
  let moves = 0, flies = 0;
  for (let k = 0; k + 1 < frames.length; ++k) {
    const a = frames[k], b = frames[k + 1], dt = b.time - a.time;
    if (!(dt > 0) || norm(get(b.velocity, block)) < kMoves * fastest) continue;
    ++moves;
    const acceleration = scale(sub(get(b.velocity, block), get(a.velocity, block)), 1 / dt);
    if (norm(sub(acceleration, scale(upOf(a.tilt), -g))) < kFlightFit * g) ++flies;
  }
  return moves > 0 && flies > kFlightShare * moves;
}

/** The motion of all blocks in words: the mode, or that more than half of the moving mass falls. */
export function motionText(header, frames, mode, blocks) {
  if (mode === "none" || blocks.length === 0) return "no failure";
  const massOf = (list) => list.reduce((sum, b) => sum + header.mass[b], 0);
  if (massOf(blocks.filter((b) => falls(header, frames, b))) > 0.5 * massOf(blocks)) return "falling";
  return mode === "mixed" ? "sliding and toppling" : mode;
}
