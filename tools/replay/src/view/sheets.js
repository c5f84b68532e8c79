// Polygons fixed to blocks: fissure water on its walls, and the patches where blocks touch.

import * as THREE from "three";
import { add, dot, get, poseOf, restOffset, scale, turn, upOf } from "../data/poses.js";
import { wetPart } from "../data/wet.js";
import { openJoint, rgb, used, water as waterColour } from "./colours.js";
import { sheetFragment, sheetVertex } from "./shaders.js";

/** Triangles and lines that are filled anew; drawn over the blocks. */
export class Sheets {
  constructor(motion, order) {
    const material = (strength, depth) =>
      new THREE.ShaderMaterial({
        glslVersion: THREE.GLSL3, vertexShader: sheetVertex, fragmentShader: sheetFragment,
        uniforms: { ...motion.uniforms, strength: { value: strength } },
        transparent: true, depthWrite: false, depthTest: depth !== null, side: THREE.DoubleSide,
        ...(depth === null ? {} : { depthFunc: depth }),
        polygonOffset: true, polygonOffsetFactor: -2, polygonOffsetUnits: -2,
      });
    // Twice: full strength where the sheet is in sight, faint where rock hides it.
    this.geometry = new THREE.BufferGeometry();
    this.lines = new THREE.BufferGeometry();
    this.object = new THREE.Group();
    const parts = [
      new THREE.Mesh(this.geometry, material(1, THREE.LessEqualDepth)),
      new THREE.Mesh(this.geometry, material(0.35, THREE.GreaterDepth)),
      new THREE.LineSegments(this.lines, material(1, null)),
    ];
    parts.forEach((part, k) => {
      part.frustumCulled = false, (part.renderOrder = order + k);
      this.object.add(part);
    });
  }

  fill(triangles, lines) {
    for (const [geometry, mesh] of [[this.geometry, triangles], [this.lines, lines]]) {
      geometry.dispose();
      geometry.setAttribute("position", new THREE.BufferAttribute(Float32Array.from(mesh.position), 3));
      geometry.setAttribute("block", new THREE.BufferAttribute(Float32Array.from(mesh.block), 1));
      geometry.setAttribute("tint", new THREE.BufferAttribute(Float32Array.from(mesh.tint), 4));
      geometry.setDrawRange(0, mesh.block.length);
    }
  }
}

export const emptyMesh = () => ({ position: [], block: [], tint: [] });
export const put = (mesh, block, point, tint) => (mesh.position.push(...point), mesh.block.push(block), mesh.tint.push(...tint));

export function putPolygon(mesh, block, points, tints) {
  for (let k = 1; k + 1 < points.length; ++k)
    for (const j of [0, k, k + 1]) put(mesh, block, points[j], tints[j]);
}

// --- water ----------------------------------------------------------------------------------------------------------

export class WaterView extends Sheets {
  constructor(header, motion) {
    super(motion, 20);
    this.header = header;
    /** Per water: {water, text, block, offset}, at its highest wet point, for the labels. */
    this.labels = [];
  }

  /** Wet polygons of the full state, up to the level of the frame. */
  show(full, frame) {
    const triangles = emptyMesh(), lines = emptyMesh();
    const best = new Map();
    if (full) {
      for (let k = 0; k < full.wet.count; ++k) this.putWall(full.wet, k, frame, triangles, lines, best);
    }
    this.fill(triangles, lines);
    this.labels = [...best.entries()].map(([w, at]) => ({ water: w, text: waterText(this.header, frame, w), ...at }));
  }

  putWall(wet, k, frame, triangles, lines, best) {
    const w = wet.water[k], block = wet.block[k];
    if (frame.waterDrained[w]) return;
    const two = this.header.waters[w].kind === "head";
    const table = frame.waterTable[w], up = upOf(frame.tilt);
    if (!two && !Number.isFinite(table)) return;
    const pose = poseOf(this.header, { a: frame, b: frame, share: 0 }, block);
    const points = [], depths = [];
    for (let v = wet.vertexBegin[k]; v < wet.vertexBegin[k + 1]; ++v) {
      const x = wet.vertexX[v], y = wet.vertexY[v];
      const own = add(get(wet.origin, k), add(scale(get(wet.e1, k), x), scale(get(wet.e2, k), y)));
      const offset = restOffset(this.header, block, own);
      points.push(offset);
      const at = add(pose.position, turn(pose.turn, offset));
      depths.push(two ? wet.head.x[k] + wet.head.y[k] * x + wet.head.z[k] * y : table - dot(up, at));
    }
    const { part, values, surface } = wetPart(points, depths);
    if (part.length < 3) return;
    const deepest = Math.max(...values);
    const colour = rgb(waterColour);
    const tints = values.map((depth) => [...colour, 0.2 + 0.3 * (deepest > 0 ? depth / deepest : 0)]);
    putPolygon(triangles, block, part, tints);
    const line = [0.02, 0.22, 0.5, 1];
    const edge = surface.length === 2 ? surface : [];
    for (const p of edge) put(lines, block, p, line);
    part.forEach((p, j) => {
      const height = dot(up, add(pose.position, turn(pose.turn, p)));
      if (!best.has(w) || height > best.get(w).height + 1e-9) best.set(w, { block, offset: part[j], height });
    });
  }
}

function waterText(header, frame, w) {
  const water = header.waters[w];
  const metres = (value) => `${Number(value.toPrecision(4))} m`;
  if (water.kind === "head") return `heads ${water.head.map(metres).join(" → ")}`;
  return `${water.kind} ${metres(frame.waterLevel[w])}`;
}

// --- joints ---------------------------------------------------------------------------------------------------------

/** Corners of an interface's patch, as offsets from block a's centroid at the start. */
export function patchCorners(header, full, i) {
  const f = full.interfaces, corners = [];
  for (let k = f.patchBegin[i]; k < f.patchBegin[i + 1]; ++k) corners.push(patchPoint(header, full, i, f.patchXi[k], f.patchEta[k]));
  return corners;
}

export function patchPoint(header, full, i, xi, eta) {
  const f = full.interfaces;
  const own = add(get(f.origin, i), add(scale(get(f.e1, i), xi), scale(get(f.e2, i), eta)));
  return restOffset(header, f.blockA[i], own);
}

/** Patches coloured by mobilised friction; open ones as outlines. `chosen` alone when only that one is shown, as an outline
 * where another view colours the joints (`is_coloured`). */
export class JointsView extends Sheets {
  constructor(header, motion) {
    super(motion, 10);
    this.header = header;
  }

  show(full, sums, visible, chosen, is_coloured = false) {
    const triangles = emptyMesh(), lines = emptyMesh();
    const count = full ? full.interfaces.count : 0;
    for (let i = 0; i < count; ++i) {
      if (!visible && i !== chosen) continue;
      const corners = patchCorners(this.header, full, i), block = full.interfaces.blockA[i];
      const open = sums[i].openShare >= 1;
      const colour = open ? rgb(openJoint) : used(sums[i].mobilised);
      const alpha = i === chosen ? 0.95 : open ? 0.1 : 0.8;
      if (!is_coloured) putPolygon(triangles, block, corners, corners.map(() => [...colour, alpha]));
      const ink = i === chosen ? [0.04, 0.42, 0.8, 1] : [...(open ? colour : [0.15, 0.18, 0.22]), open ? 0.9 : 0.5];
      corners.forEach((p, k) => {
        put(lines, block, p, ink), put(lines, block, corners[(k + 1) % corners.length], ink);
      });
    }
    this.fill(triangles, lines);
  }
}
