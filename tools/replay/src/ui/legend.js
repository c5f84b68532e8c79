// The legend over the scene: what colours and arrows mean, with units.

import { degrees, quantity } from "../units.js";
import { mapLegend } from "./map.js";
import { dryJoint, forceColours, gradientOf, heatText, openJoint, roleColours } from "../view/colours.js";
import { roleNames } from "../data/roles.js";

const titles = { displacement: "Displacement", velocity: "Velocity", rotation: "Rotation" };
const item = (colour, text) => `<li><i style="background:${colour}"></i>${text}</li>`;
const unitOf = (kind) => (value) =>
  kind === "rotation" ? `${Number(degrees(value).toPrecision(3))}°` : quantity(value, kind === "velocity" ? "m/s" : "m", 3);

const kGroupsListed = 8;

/** Colour and words of each group that fails together, and of the other blocks. */
export function groupItems(groups) {
  const listed = groups.slice(0, kGroupsListed).map(({ factor, blocks, share }) =>
    [heatText(share), `at ${factor.toFixed(3)}: ${blocks} block${blocks === 1 ? "" : "s"}`]);
  if (groups.length > kGroupsListed) listed.push([heatText(groups.at(-1).share), `... to ${groups.at(-1).factor.toFixed(3)}`]);
  return [...listed, [heatText(0), "not known to fail"]];
}

/** The colours' meaning in words, for pictures. */
export const colourCaption = ({ colouring }, range, groups) =>
  colouring === "factor" ? { items: groupItems(groups), scale: null } : colouring === "role" ? { items: [], scale: null } : { title: titles[colouring], most: unitOf(colouring)(range[1]), scale: "heat" };

/** A joint under most pressure, and dry ones. `acts`: whether the run has this pressure. */
const flowLegend = ({ most, acts }) =>
  `Water pressure in joints, before the run${acts ? "" : " (does not act in it)"}<div class="bar" style="background:${gradientOf("pressure")}"></div>` +
  `<div class="ends"><span>0</span><span>${quantity(most / 2, "Pa", 3)}</span><span>${quantity(most, "Pa", 3)}</span></div>` +
  `<ul>${item(`${dryJoint}55`, "dry")}</ul>`;

export function legendHtml({ map, flow, colouring, range, ownScale, roles, groups, joints, forces, reference, arrowPixels, fullTime, time, exaggeration, selected, supports }) {
  const parts = [];
  if (map) {
    parts.push(mapLegend(map, colouring));
  } else if (colouring === "role") {
    const present = [...new Set(roles)].sort();
    parts.push(`Failure role<ul>${present.map((role) => item(roleColours[role], roleNames[role])).join("")}</ul>`);
  } else if (colouring === "factor") {
    parts.push(`Factor of safety at which blocks fail<ul>${groupItems(groups).map(([colour, text]) => item(colour, text)).join("")}</ul>`);
  } else {
    const text = unitOf(colouring);
    parts.push(`${titles[colouring]}${ownScale ? " (scale of this frame)" : ""}<div class="bar" style="background:${gradientOf("heat")}"></div>` +
      `<div class="ends"><span>0</span><span>${text(range[1] / 2)}</span><span>${text(range[1])}</span></div>`);
  }
  const is_past = fullTime !== null && time - fullTime > 1e-9;
  const at = fullTime === null ? ": not known before the first full state"
    : ` at t = ${quantity(fullTime, "s")}${is_past ? " (the last known)" : ""}`;
  if (joints)
    parts.push(`Joints${at}: friction used<div class="bar" style="background:${gradientOf("used")}"></div>` +
      `<div class="ends"><span>0</span><span>½</span><span>all: slips</span></div><ul>${item(openJoint + "55", "open")}</ul>`);
  if (flow) parts.push(flowLegend(flow));
  if (forces && reference > 0)
    parts.push(`${selected ? "Forces on the block" : "Contact forces"}${at}<br>` +
      `<svg width="${arrowPixels + 2}" height="10" style="vertical-align:-1px"><path d="M1 5H${arrowPixels - 7}m0-4 8 4-8 4z" stroke="currentColor" stroke-width="2" fill="currentColor"/></svg>` +
      ` ${quantity(reference, "N", 2)}<ul>${item("var(--ink)", "holds")}${item(forceColours.slipping, "slips")}` +
      `${selected ? item(forceColours.water, "water") + item(forceColours.weight, "weight") : ""}</ul>`);
  if (supports)
    parts.push(`Supports: strength used<div class="bar" style="background:${gradientOf("used")}"></div>` +
      `<div class="ends"><span>0</span><span>½</span><span>all</span></div><ul>${item(openJoint, "broken")}</ul>`);
  if (exaggeration !== 1) parts.push(`Displacement drawn × ${Number(exaggeration.toPrecision(3))}`);
  return parts.map((part) => `<div>${part}</div>`).join("");
}
