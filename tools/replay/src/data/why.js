// Sentences on why a block or a joint fails or is stable, each with numbers of the file.

import { add, dot, get, norm, poseOf, scale, sub, turn, upOf } from "./poses.js";
import { flowPushes } from "./flow.js";
import { neighboursOf, waterForce } from "./contacts.js";
import { motionAt, Role, rule } from "./roles.js";
import { angle, percent, quantity } from "../units.js";

const kUsedUp = 0.98; // share of the strength from which a joint counts as slipping as a whole
const kAtEdge = 0.85; // of the distance from a patch's centroid to its edge

const words = { [Role.stands]: "Stands", [Role.slides]: "Slides", [Role.topples]: "Topples" };

const listed = (names, most = 3) =>
  names.slice(0, most).join(", ") + (names.length > most ? ` and ${names.length - most} more` : "");

/**
 * The motion of a block, with the numbers that decide it: its farthest corner's displacement, and its rotation times the
 * extent of the moving group (roles.js). A search that kept the run has judged by the motion of the failure itself: where
 * that differs from the motion up to the frame, both are given.
 */
function motionSentences({ header, frame, radius, block, role, setOff, falls }) {
  if (role === Role.fixed) return ["Fixed: it cannot move."];
  if (role === Role.driven) return ["Driven: its velocity is prescribed."];
  const { motion, largest, moving, extent } = motionAt(header, frame, radius);
  const way = motion[block], turned = norm(get(frame.rotation, block)), swing = turned * extent;
  const shown = !moving[block] ? Role.stands : swing > rule.toppling * way ? Role.topples : Role.slides;
  const since = setOff === null || setOff > frame.time ? "" : `, since t = ${quantity(setOff, "s")}`;
  const numbers = `its rotation of ${angle(turned)} times the moving group's extent of ${quantity(extent, "m", 3)} is ${quantity(swing, "m", 3)}, ` +
    `${swing > rule.toppling * way ? "more" : "less"} than ${percent(rule.toppling)} of its displacement of ${quantity(way, "m", 3)}${since}.`;
  const flies = falls && shown !== Role.stands;
  const said = shown === Role.topples ? `${flies ? "Counts as toppling" : "Topples"}: ${numbers}`
    : shown === Role.slides ? `${flies ? "Counts as sliding" : "Slides"}: ${numbers}`
    : way > rule.share * largest ? `Stands: its displacement of ${quantity(way, "m", 3)} is no more than that of elastic joints.`
    : `Stands: its displacement of ${quantity(way, "m", 3)} is below ${percent(rule.share)} of the largest one.`;
  const flight = flies ? ["Falls: during a part of its motion gravity alone changes its velocity."] : [];
  if (shown === role) return [...flight, said];
  return [`${words[role]} at the failure, by the search that kept this run.`, ...flight,
    `By its motion up to this frame: ${said[0].toLowerCase()}${said.slice(1)}`];
}

/** Facts on the contacts of a block: friction used, open contacts, forces at an edge. */
function contactSentences(header, full, block, up) {
  const sentences = [];
  const neighbours = neighboursOf(full, block);
  const name = (n) => header.names[n.other];
  const closed = neighbours.filter((n) => n.sums.openShare < 1 && n.sums.strength > 0);
  const used = closed.filter((n) => n.sums.mobilised >= kUsedUp);
  const open = neighbours.filter((n) => n.sums.openShare >= 1);
  const centre = get(header.centroid, block);
  const below = closed.filter((n) => dot(sub(get(header.centroid, n.other), centre), up) < 0);
  const edge = below.filter((n) => n.sums.edge >= kAtEdge);
  if (used.length) sentences.push(`Friction is fully mobilised on ${listed(used.map(name))}.`);
  else if (closed.length) {
    const most = closed.reduce((a, b) => (b.sums.mobilised > a.sums.mobilised ? b : a));
    sentences.push(`At most ${percent(most.sums.mobilised)} of the shear strength is used (on ${name(most)}).`);
  }
  if (edge.length) sentences.push(`It stands on an edge: the force from ${listed(edge.map(name))} acts at ${percent(edge[0].sums.edge)} of the distance from the middle to the rim.`);
  if (open.length) sentences.push(`Open towards ${listed(open.map(name))}.`);
  if (neighbours.length === 0) sentences.push("It touches nothing: it falls or flies.");
  return sentences;
}

function waterSentence(header, full, block, pose) {
  const weight = header.mass[block] * header.gravity;
  const walls = full.walls.get(block) ?? [];
  const thrust = [...walls.map((k) => waterForce(header, full, k, pose.turn)),
    ...flowPushes(header, block).map(({ force }) => turn(pose.turn, scale(force, full.loads.waterShare)))].reduce(add, [0, 0, 0]);
  if (norm(thrust) < 1e-9 * weight) return null;
  return `Water pushes it with ${quantity(norm(thrust), "N")}, ${percent(norm(thrust) / weight)} of its weight.`;
}

/** `radius`: of all blocks; `falls`: it flies in much of its motion; the role is that of frame `frames.a`. */
export function whyBlock({ header, full, frames, block, radius, role, setOff, falls }) {
  const { a } = frames;
  const sentences = motionSentences({ header, frame: a, radius, block, role, setOff, falls });
  if (!full || role === Role.fixed) return sentences;
  const water = waterSentence(header, full, block, poseOf(header, frames, block));
  return [...sentences, ...contactSentences(header, full, block, upOf(a.tilt)), ...(water ? [water] : [])];
}

export function whyInterface(header, full, i) {
  const s = full.sums[i], joint = header.joints[full.interfaces.joint[i]];
  const sentences = [];
  if (s.openShare >= 1) sentences.push("Open: the faces have parted, and the joint carries nothing.");
  else if (s.mobilised >= kUsedUp)
    sentences.push(`Slips: shear ${quantity(s.shear, "N")} has reached its strength of ${quantity(s.strength, "N")}.`);
  else if (s.slipping > 0)
    sentences.push(`Slips in part: ${s.slipping} of ${s.points} contact points, ${percent(s.mobilised)} of the strength used.`);
  else if (s.strength > 0) sentences.push(`Holds: ${percent(s.mobilised)} of the shear strength is used.`);
  else sentences.push("Holds: it carries no shear.");
  if (s.openShare > 0 && s.openShare < 1) sentences.push(`${percent(s.openShare)} of its area is open.`);
  if (s.openShare < 1 && s.edge >= kAtEdge) sentences.push(`The normal force acts at ${percent(s.edge)} of the distance from the middle to the rim: the block turns about an edge.`);
  if (joint && (joint.cohesion > 0 || joint.tensileStrength > 0))
    sentences.push(s.broken > 0 ? `Its bond is broken at ${s.broken} of ${s.points} contact points.` : "Its bond is intact.");
  if (s.water > 0) sentences.push(`Water presses its walls apart with ${quantity(s.water, "N")}.`);
  return sentences;
}
