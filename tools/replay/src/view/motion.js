// The motion textures: two neighbouring frames for the shaders.

import * as THREE from "three";
import { cutUniforms } from "./section.js";
import { kBlocksPerRow, kTexelsPerBlock } from "./shaders.js";

const floatTexture = (data, width, height) => {
  const texture = new THREE.DataTexture(data, width, height, THREE.RGBAFormat, THREE.FloatType);
  texture.needsUpdate = true;
  return texture;
};

export class MotionTextures {
  constructor(header) {
    const rows = Math.ceil(header.names.length / kBlocksPerRow);
    const centroids = new Float32Array(kBlocksPerRow * rows * 4);
    header.names.forEach((_, b) => centroids.set([header.centroid.x[b], header.centroid.y[b], header.centroid.z[b]], 4 * b));
    this.motion = header.motion;
    this.data = new Float32Array(kBlocksPerRow * kTexelsPerBlock * rows * 4);
    this.texture = floatTexture(this.data, kBlocksPerRow * kTexelsPerBlock, rows);
    /** Shared by all materials: a value set here holds everywhere. */
    this.uniforms = {
      motions: { value: this.texture },
      centroids: { value: floatTexture(centroids, kBlocksPerRow, rows) },
      share: { value: 0 },
      exaggeration: { value: 1 },
      ...cutUniforms(),
    };
  }

  /** Takes two frames and the values that colour the blocks at each. */
  set(a, b, valuesA, valuesB) {
    const data = this.data;
    for (let k = 0, at = 0; k < this.motion.length; ++k, at += 4 * kTexelsPerBlock) {
      data[at] = a.displacement.x[k], data[at + 1] = a.displacement.y[k], data[at + 2] = a.displacement.z[k];
      data[at + 3] = valuesA[k];
      data[at + 4] = a.rotation.x[k], data[at + 5] = a.rotation.y[k], data[at + 6] = a.rotation.z[k];
      data[at + 7] = this.motion[k];
      data[at + 8] = b.displacement.x[k], data[at + 9] = b.displacement.y[k], data[at + 10] = b.displacement.z[k];
      data[at + 11] = valuesB[k];
      data[at + 12] = b.rotation.x[k], data[at + 13] = b.rotation.y[k], data[at + 14] = b.rotation.z[k];
    }
    this.texture.needsUpdate = true;
  }
}
