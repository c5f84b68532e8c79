// The panel's text for a selected block or interface: its numbers and why it fails or is stable.

import { close, escape, facts, loadFigure, wordsOf } from "./words.js";
import { add, cross, dot, get, norm, poseOf, sub, turn, upOf } from "../data/poses.js";
import { pressureBetween } from "../data/flow.js";
import { neighboursOf, stateNames } from "../data/contacts.js";
import { roleNames } from "../data/roles.js";
import { whyBlock, whyInterface } from "../data/why.js";
import { patchPoint } from "../view/sheets.js";
import { roleColours } from "../view/colours.js";
import { angle, area, degrees, percent, quantity, ratio } from "../units.js";

const why = (sentences) => `<h3>Why</h3><ul class="why">${sentences.map((s) => `<li>${escape(s)}</li>`).join("")}</ul>`;
const metres = (v) => `(${v.map((value) => value.toFixed(4).replace("-", "−")).join(", ")}) m`;
const inked = new Set(["#dedad0"]);

export function blockText({ header, full, frames, block, radius, roles, setOff, falls }) {
  const { a, b, share } = frames;
  const frame = share < 0.5 ? a : b;
  const pose = poseOf(header, frames, block);
  const moved = sub(pose.position, get(header.centroid, block));
  const velocity = get(a.velocity, block).map((v, k) => v * (1 - share) + get(b.velocity, block)[k] * share);
  const role = roles[block];
  const colour = roleColours[role];
  const badge = `<span class="badge" style="background:${colour};color:${inked.has(colour) ? "#333" : "#fff"}">${roleNames[role]}</span>`;
  const rows = [
    ["Displacement", quantity(norm(moved), "m")],
    ["along x, y, z", moved.map((v) => quantity(v, "m", 3)).join(", ")],
    ["Velocity", quantity(norm(velocity), "m/s")],
    ["Rotation", angle(norm(get(frame.rotation, block)), 4)],
    ["Centroid", metres(pose.position)],
    ["Mass, weight", `${quantity(header.mass[block] * 1000, "g")}, ${quantity(header.mass[block] * header.gravity, "N")}`],
  ];
  const goesAt = header.failure?.factor[block];
  if (goesAt > 0) rows.push(["Fails at a factor of", goesAt.toFixed(4)]);
  if (full) rows.push(["Out of balance", quantity(norm(get(full.force, block)), "N")]);
  return `<h2><span>Block ${escape(header.names[block])} ${badge}</span>${close}</h2>` +
    why(whyBlock({ header, full, frames, block, radius, role, setOff, falls })) + facts(rows) + neighbourTable(header, full, block);
}

function neighbourTable(header, full, block) {
  if (!full) return `<p class="note">Contacts are not known before the first full state.</p>`;
  const rows = neighboursOf(full, block).map((n) =>
    `<tr><td><button data-interface="${n.i}">${escape(header.names[n.other])}</button></td>` +
    `<td>${quantity(n.sums.normal, "N", 3)}</td><td>${quantity(Math.hypot(n.sums.shear1, n.sums.shear2), "N", 3)}</td>` +
    `<td>${n.sums.openShare >= 1 ? "open" : percent(n.sums.mobilised)}</td></tr>`);
  return `<h3>Contacts at t = ${quantity(full.time, "s")}</h3><div class="scroll"><table><thead><tr><th>with</th>` +
    `<th>normal</th><th>shear</th><th>friction used</th></tr></thead><tbody>${rows.join("")}</tbody></table></div>`;
}

/** Friction and cohesion, or which other law its strength follows. */
function strengthText(joint) {
  if (joint?.law && joint.law !== "coulomb") return escape(joint.law);
  return `φ = ${angle(joint?.friction ?? NaN)}, C = ${quantity(joint?.cohesion ?? NaN, "Pa", 3)}`;
}

/** Of water that stands in the joint, or that flows in it. */
function waterRows({ flow }, sums, a, b) {
  if (!flow) return [["Water thrust", quantity(sums.water, "N")]];
  const range = pressureBetween(flow, a, b);
  return [["Water pressure", range ? `${quantity(range[0], "Pa", 3)} to ${quantity(range[1], "Pa", 3)}` : "none"]];
}

/** One line for the pointer: the pressure at a point of the flow. */
export function flowTip({ flow, joints, names }, { triangle, value }) {
  const pressure = value > 0 ? quantity(value, "Pa", 3) : "dry";
  const blocks = [flow.blockA[triangle], flow.blockB[triangle]].map((block) => names[block]);
  return `${pressure}, joint ${joints[flow.joint[triangle]].name} between ${blocks.join(" and ")}`;
}

export function interfaceText({ header, full, frames, i }) {
  const f = full.interfaces, p = full.points, s = full.sums[i];
  const joint = header.joints[f.joint[i]];
  const [a, b] = [f.blockA[i], f.blockB[i]];
  const name = (block) => `<button data-block="${block}">${escape(header.names[block])}</button>`;
  const pose = poseOf(header, frames, a);
  const at = add(pose.position, turn(pose.turn, patchPoint(header, full, i, 0, 0)));
  const origin = patchPoint(header, full, i, 0, 0);
  const normal = cross(sub(patchPoint(header, full, i, 1, 0), origin), sub(patchPoint(header, full, i, 0, 1), origin));
  const steep = Math.abs(dot(turn(pose.turn, normal), upOf(frames.a.tilt))) / norm(normal);
  const dip = degrees(Math.acos(Math.min(1, steep)));
  const rows = [
    ["Joint", `${escape(joint?.name ?? "–")}, ${strengthText(joint)}`],
    ["Area, open", `${area(f.area[i])}, ${percent(s.openShare)}`],
    ["Normal force", quantity(s.normal, "N")],
    ["Shear force", quantity(Math.hypot(s.shear1, s.shear2), "N")],
    ...waterRows(header, s, a, b),
    ["Friction used", percent(s.mobilised)],
    ["Normal force acts", `${percent(s.edge)} of the distance to the rim`],
    ["Middle", metres(at)],
    ["Dip of the plane", `${dip.toFixed(1)}°`],
  ];
  const points = [];
  for (let k = f.pointBegin[i]; k < f.pointBegin[i + 1]; ++k)
    points.push(`<tr><td>${k - f.pointBegin[i]}</td><td>${quantity(p.normal[k], "N", 3)}</td>` +
      `<td>${quantity(Math.hypot(p.shear1[k], p.shear2[k]), "N", 3)}</td><td>${quantity(p.water[k] ?? 0, "N", 3)}</td>` +
      `<td>${area(p.area[k])}</td><td>${stateNames[p.state[k]] ?? "–"}</td><td>${percent(p.mobilised[k] ?? 0)}</td></tr>`);
  return `<h2><span>Joint ${name(a)} – ${name(b)}</span>${close}</h2>` + why(whyInterface(header, full, i)) + facts(rows) +
    `<h3>Contact points at t = ${quantity(full.time, "s")}</h3><div class="scroll"><table><thead><tr><th>Lp</th><th>N</th><th>S</th>` +
    `<th>P</th><th>area</th><th>state</th><th>used</th></tr></thead><tbody>${points.join("")}</tbody></table></div>`;
}

/** "tilt 19.5312°": the words are those of the program for the loads of its searches. */
function loadText({ analysis, load }) {
  const words = wordsOf(analysis);
  return words ? `${words.text} ${loadFigure(words, load)}` : `load ${ratio(load)}`;  // a search of another version
}

/** Facts of the run for the panel's last section. */
export function runText(file, mode) {
  const { header, end, frames } = file;
  const ended = end?.get("ended") ?? "not known (still running, or killed)";
  const rows = [
    ["Scenario", escape(header.scenarioPath || "–")],
    ["Blocks", `${header.names.length} (${header.motion.filter((m) => m === 0).length} free)`],
    ["Frames", `${frames.length}, ${file.fullTimes.length} with contacts`],
    ["Reached", `${quantity(frames.at(-1).time, "s")} of ${quantity(header.duration, "s")}`],
    ["Tilt at the end", angle(frames.at(-1).tilt, 4)],
    ["Motion", mode],
    ...(header.failure ? [["Kept by", escape(`talus ${header.failure.analysis}, ${loadText(header.failure)}`)]] : []),
    ["Run ended", escape(ended)],
    ["State hash", `<code>${frames.at(-1).stateHash}</code>`],
    ["Written by", escape(`talus ${header.build.version} ${header.build.gitHash}`)],
  ];
  const warnings = end?.get("warnings");
  return `<h3>The run</h3>${facts(rows)}` + (warnings ? `<p class="note">${escape(warnings)}</p>` : "") +
    `<details><summary class="note">Scenario file</summary><pre>${escape(header.scenarioText)}</pre></details>`;
}
