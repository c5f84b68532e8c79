// Colours of the scene. Stone colours at rest, hot colours for motion. The scales darken evenly, so that they work in
// black-and-white print and for colour-blind readers.

import * as THREE from "three";

const kHeat = ["#dedad0", "#f3d189", "#ef9d4f", "#d65c3b", "#9c2b4e", "#4d1454"];
const kUsed = ["#2f8f9d", "#8fc1a9", "#f0dc9a", "#ee9a4a", "#cf3030"];
const kPressure = ["#d3e5f5", "#94c5e6", "#4b9bd1", "#1f6bb0", "#0a3a78"];
const scales = { heat: kHeat, used: kUsed, pressure: kPressure };
export const roleColours = ["#9aa2aa", "#5d9a86", "#dedad0", "#e8871e", "#7f3fb0"]; // in the order of Role
export const held = "#a9b0b7";
export const accent = "#0b6bcb";
export const water = "#1c7ed6";
export const openJoint = "#8a94a0";
export const dryJoint = "#b5aa98";
export const forceColours = { contact: "#27415c", slipping: "#d02f2f", water: "#1c7ed6", weight: "#3c8d40" };

export const rgb = (text) => {
  const value = parseInt(text.slice(1), 16);
  return [(value >> 16) / 255, ((value >> 8) & 255) / 255, (value & 255) / 255];
};

function along(stops, x) {
  const at = Math.min(Math.max(x, 0), 1) * (stops.length - 1);
  const k = Math.min(Math.floor(at), stops.length - 2);
  const a = rgb(stops[k]), b = rgb(stops[k + 1]);
  return a.map((value, i) => value + (b[i] - value) * (at - k));
}
export const heat = (x) => along(kHeat, x);
export const heatText = (x) => `rgb(${heat(x).map((v) => Math.round(255 * v)).join()})`;
export const used = (x) => along(kUsed, x);
/** Colours of a scale: one of those above by its name, or its own. */
export const gradientStops = (scale) => scales[scale] ?? scale;
export const gradientOf = (scale) => `linear-gradient(90deg,${gradientStops(scale).join(",")})`;

export function scaleTexture(scale) {
  const data = new Uint8Array(256 * 4), stops = gradientStops(scale);
  for (let k = 0; k < 256; ++k) data.set([...along(stops, k / 255).map((v) => Math.round(v * 255)), 255], 4 * k);
  const texture = new THREE.DataTexture(data, 256, 1);
  texture.magFilter = texture.minFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}
