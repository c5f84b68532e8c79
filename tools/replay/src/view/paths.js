// Paths of blocks: lines through their centroids, frame by frame, up to the moment shown.

import * as THREE from "three";
import { cutDeclaration, cutDiscard } from "./shaders.js";

const kMostSegments = 400_000;

const pathVertex = `
uniform float exaggeration;
in vec3 way;
out vec3 vPlace;
void main() {
  vPlace = position + way * exaggeration;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(vPlace, 1.0);
}`;

const pathFragment = `
precision highp float;
${cutDeclaration}
uniform vec4 ink;
out vec4 colour;
void main() { ${cutDiscard} colour = ink; }`;

export class PathsView {
  /** `moving`: blocks whose paths are drawn. */
  constructor(header, frames, motion, moving) {
    this.stride = Math.max(1, Math.ceil((moving.length * frames.length) / kMostSegments));
    this.perFrame = 2 * moving.length;
    const used = frames.filter((_, k) => k % this.stride === 0);
    const count = Math.max(0, used.length - 1) * this.perFrame;
    const position = new Float32Array(3 * count), way = new Float32Array(3 * count);
    let at = 0;
    for (let k = 0; k + 1 < used.length; ++k)
      for (const b of moving)
        for (const { displacement: u } of [used[k], used[k + 1]]) {
          position.set([header.centroid.x[b], header.centroid.y[b], header.centroid.z[b]], at);
          way.set([u.x[b], u.y[b], u.z[b]], at);
          at += 3;
        }
    this.geometry = new THREE.BufferGeometry();
    this.geometry.setAttribute("position", new THREE.BufferAttribute(position, 3));
    this.geometry.setAttribute("way", new THREE.BufferAttribute(way, 3));
    const material = (alpha, depth) => new THREE.ShaderMaterial({
      glslVersion: THREE.GLSL3, vertexShader: pathVertex, fragmentShader: pathFragment,
      uniforms: { exaggeration: motion.uniforms.exaggeration, cut: motion.uniforms.cut, ink: { value: new THREE.Vector4(0.72, 0.1, 0.35, alpha) } },
      transparent: true, depthWrite: false, depthFunc: depth,
    });
    this.object = new THREE.Group();
    // Fainter where rock hides them.
    for (const part of [material(0.95, THREE.LessEqualDepth), material(0.3, THREE.GreaterDepth)]) {
      const lines = new THREE.LineSegments(this.geometry, part);
      lines.frustumCulled = false, (lines.renderOrder = 5);
      this.object.add(lines);
    }
  }

  /** Up to the frame of this number. */
  show(index) {
    this.geometry.setDrawRange(0, Math.floor(index / this.stride) * this.perFrame);
  }
}
