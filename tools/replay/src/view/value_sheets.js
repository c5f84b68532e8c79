// Polygons fixed to blocks and coloured by a value: water pressure in joints, cells of a map.

import * as THREE from "three";
import { add, cross, dot, scale, sub, turn } from "../data/poses.js";
import { scaleTexture } from "./colours.js";
import { sheetFragment, sheetVertex, valueFragment, valueVertex } from "./shaders.js";
import { emptyMesh } from "./sheets.js";

/** Where a ray meets a triangle (Moeller and Trumbore 1997): { t, u, v }, u and v at its second and third corner, or null. */
function rayToTriangle(origin, direction, [a, b, c]) {
  const ab = sub(b, a), ac = sub(c, a), normal = cross(direction, ac);
  const volume = dot(ab, normal);
  if (volume === 0) return null;
  const from = sub(origin, a), u = dot(from, normal) / volume;
  if (!(u >= 0 && u <= 1)) return null;
  const other = cross(from, ab), v = dot(direction, other) / volume;
  if (!(v >= 0 && u + v <= 1)) return null;
  const t = dot(ac, other) / volume;
  return t > 0 ? { t, u, v } : null;
}

const back = ([w, x, y, z]) => [w, -x, -y, -z];

/** Corners of triangles in threes: `position` from their block's centroid at the start, `block`, `value`. */
export const emptyValues = () => ({ position: [], block: [], value: [] });

export class ValueSheets {
  /** `order` of drawing; `colours` of the scale; `none`: colour and opacity where the value is 0 or less. */
  constructor(motion, { order, colours, none }) {
    this.uniforms = { ...motion.uniforms, colours: { value: scaleTexture(colours) }, most: { value: 1 }, none: { value: new THREE.Vector4(...none) } };
    this.geometry = new THREE.BufferGeometry();
    this.lines = new THREE.BufferGeometry();
    this.triangles = emptyValues();
    const value_material = (drawsNone) => new THREE.ShaderMaterial({
      glslVersion: THREE.GLSL3, vertexShader: valueVertex, fragmentShader: valueFragment,
      uniforms: { ...this.uniforms, drawsNone: { value: drawsNone } },
      transparent: true, depthWrite: !drawsNone || none[3] === 1, side: THREE.DoubleSide,
      polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 2, // behind edges, before faces
    });
    const line_material = new THREE.ShaderMaterial({
      glslVersion: THREE.GLSL3, vertexShader: sheetVertex, fragmentShader: sheetFragment,
      uniforms: { ...motion.uniforms, strength: { value: 1 } }, transparent: true, depthWrite: false,
    });
    const parts = [new THREE.Mesh(this.geometry, value_material(false)), new THREE.Mesh(this.geometry, value_material(true)),
      new THREE.LineSegments(this.lines, line_material)];
    this.object = new THREE.Group().add(...parts);
    parts.forEach((part, k) => ((part.frustumCulled = false), (part.renderOrder = order + 0.1 * k)));
  }

  fill(triangles) {
    this.triangles = triangles;
    this.geometry.setAttribute("position", new THREE.BufferAttribute(Float32Array.from(triangles.position), 3));
    this.geometry.setAttribute("block", new THREE.BufferAttribute(Float32Array.from(triangles.block), 1));
    this.setValues(triangles.value);
  }

  setValues(values) {
    this.triangles.value = values;
    this.geometry.setAttribute("value", new THREE.BufferAttribute(Float32Array.from(values), 1));
  }

  /** Lines as of Sheets: `position`, `block` and `tint`. */
  setLines(mesh = emptyMesh()) {
    this.lines.dispose();
    this.lines.setAttribute("position", new THREE.BufferAttribute(Float32Array.from(mesh.position), 3));
    this.lines.setAttribute("block", new THREE.BufferAttribute(Float32Array.from(mesh.block), 1));
    this.lines.setAttribute("tint", new THREE.BufferAttribute(Float32Array.from(mesh.tint), 4));
    this.lines.setDrawRange(0, mesh.block.length);
  }

  corner(k) {
    const { position } = this.triangles;
    return [position[3 * k], position[3 * k + 1], position[3 * k + 2]];
  }

  /**
   * What a ray meets first: { triangle, t, value }, or null. `poseOf(block)` says where blocks are, `isCut(point)` what is
   * not drawn.
   */
  pick(poseOf, origin, direction, isCut) {
    const rays = new Map(), { block, value } = this.triangles;
    const rayOf = (b) => {
      const { position, turn: turned } = poseOf(b);
      return [turn(back(turned), sub(origin, position)), turn(back(turned), direction)];
    };
    let best = null;
    for (let k = 0; k < block.length; k += 3) {
      if (!rays.has(block[k])) rays.set(block[k], rayOf(block[k]));
      const hit = rayToTriangle(...rays.get(block[k]), [0, 1, 2].map((j) => this.corner(k + j)));
      if (!hit || (best && hit.t >= best.t) || isCut(add(origin, scale(direction, hit.t)))) continue;
      best = { triangle: k / 3, t: hit.t, value: value[k] * (1 - hit.u - hit.v) + value[k + 1] * hit.u + value[k + 2] * hit.v };
    }
    return best;
  }
}
