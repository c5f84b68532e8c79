// Forces as arrows, one instanced mesh. Without a selection: each interface's force on the upper of its two blocks. With a
// block selected: all that acts on it, contacts, water and weight.

import * as THREE from "three";
import { dot, get, norm, poseOf, restOffset, scale, turn, upOf } from "../data/poses.js";
import { neighboursOf, pointOfAction, waterForce } from "../data/contacts.js";
import { flowPushes } from "../data/flow.js";
import { forceColours, rgb } from "./colours.js";
import { arrowFragment, arrowVertex } from "./shaders.js";
import { roundDown } from "../units.js";

const kSides = 8;
const kUsedUp = 0.98;

/** Shaft of radius 1 from z = 0 to 1 and head of radius 2.6 from z = 1 to 2: the shader gives them their sizes. */
function arrowMesh() {
  const shaft = new THREE.CylinderGeometry(1, 1, 1, kSides).rotateX(Math.PI / 2).translate(0, 0, 0.5);
  const head = new THREE.ConeGeometry(2.6, 1, kSides).rotateX(Math.PI / 2).translate(0, 0, 1.5);
  const geometry = new THREE.InstancedBufferGeometry();
  for (const [name, size] of [["position", 3], ["normal", 3]])
    geometry.setAttribute(name, new THREE.BufferAttribute(
      Float32Array.from([...shaft.getAttribute(name).array, ...head.getAttribute(name).array]), size));
  const shift = shaft.getAttribute("position").count;
  geometry.setIndex([...shaft.index.array, ...Array.from(head.index.array, (k) => k + shift)]);
  return geometry;
}

export class ArrowsView {
  constructor(header, motion, blockSize) {
    this.header = header;
    this.blockSize = blockSize;
    this.geometry = arrowMesh();
    this.uniforms = {
      ...motion.uniforms, metresPerNewton: { value: 0 }, thickness: { value: 0.03 * blockSize }, longest: { value: 0 },
    };
    const material = new THREE.ShaderMaterial({
      glslVersion: THREE.GLSL3, uniforms: this.uniforms, vertexShader: arrowVertex, fragmentShader: arrowFragment,
    });
    this.object = new THREE.Mesh(this.geometry, material);
    this.object.frustumCulled = false;
    this.reference = 0; // force of the legend's arrow [N]
  }

  /** `chosen`: a block's index or -1; `size` scales all arrows. */
  show(full, frame, chosen, size, dark) {
    const contact = rgb(dark ? "#dfe7ee" : forceColours.contact);
    const arrows = !full ? [] : chosen >= 0 ? this.onBlock(full, frame, chosen, contact) : this.everywhere(full, frame, contact);
    // Of what carries: most interfaces of a rock mass may be open.
    const strengths = arrows.map((arrow) => norm(arrow.force)).filter((strength) => strength > 0).sort((a, b) => a - b);
    const typical = strengths.length ? strengths[Math.round(0.95 * (strengths.length - 1))] : 0;
    const metres = typical > 0 ? (1.1 * this.blockSize * size) / typical : 0;
    this.uniforms.metresPerNewton.value = metres;
    this.uniforms.thickness.value = 0.032 * this.blockSize * Math.sqrt(size);
    this.uniforms.longest.value = 3 * 1.1 * this.blockSize * size;
    this.reference = typical > 0 ? roundDown(typical) : 0;
    const least = typical * 0.01;
    this.fill(arrows.filter((arrow) => norm(arrow.force) > least));
  }

  everywhere(full, frame, contact) {
    const f = full.interfaces, up = upOf(frame.tilt), arrows = [];
    for (let i = 0; i < f.count; ++i) {
      const a = f.blockA[i], b = f.blockB[i];
      const aHigher = dot(get(this.header.centroid, a), up) > dot(get(this.header.centroid, b), up);
      const force = scale(get(f.force, i), aHigher ? -1 : 1);
      const slips = full.sums[i].mobilised >= kUsedUp;
      arrows.push({ block: a, offset: pointOfAction(this.header, full, i), force, tint: slips ? rgb(forceColours.slipping) : contact, pushing: 1 });
    }
    return arrows;
  }

  onBlock(full, frame, block, contact) {
    const arrows = neighboursOf(full, block).map((n) => ({
      block: full.interfaces.blockA[n.i], offset: pointOfAction(this.header, full, n.i), force: n.force,
      tint: n.sums.mobilised >= kUsedUp ? rgb(forceColours.slipping) : contact, pushing: 1,
    }));
    const pose = poseOf(this.header, { a: frame, b: frame, share: 0 }, block);
    for (const k of full.walls.get(block) ?? [])
      arrows.push({ block, offset: restOffset(this.header, block, wallMiddle(full.wet, k)),
        force: waterForce(this.header, full, k, pose.turn), tint: rgb(forceColours.water), pushing: 1 });
    for (const { offset, force } of flowPushes(this.header, block))
      arrows.push({ block, offset, force: turn(pose.turn, scale(force, full.loads.waterShare)), tint: rgb(forceColours.water), pushing: 1 });
    if (this.header.motion[block] === 0) {
      const weight = scale(upOf(frame.tilt), -this.header.mass[block] * this.header.gravity);
      arrows.push({ block, offset: [0, 0, 0], force: weight, tint: rgb(forceColours.weight), pushing: 0 });
    }
    return arrows;
  }

  fill(arrows) {
    const put = (name, values, size) =>
      this.geometry.setAttribute(name, new THREE.InstancedBufferAttribute(Float32Array.from(values), size));
    this.geometry.dispose();
    put("offset", arrows.flatMap((a) => a.offset), 3);
    put("block", arrows.map((a) => a.block), 1);
    put("force", arrows.flatMap((a) => a.force), 3);
    put("tint", arrows.flatMap((a) => a.tint), 3);
    put("pushing", arrows.map((a) => a.pushing), 1);
    this.geometry.instanceCount = arrows.length;
    this.object.visible = arrows.length > 0;
  }
}

/** Middle of a wet polygon's corners, in the block's own frame: where its arrow is drawn. */
function wallMiddle(wet, k) {
  const begin = wet.vertexBegin[k], end = wet.vertexBegin[k + 1];
  let x = 0, y = 0;
  for (let v = begin; v < end; ++v) x += wet.vertexX[v] / (end - begin), (y += wet.vertexY[v] / (end - begin));
  return get(wet.origin, k).map((o, c) => o + get(wet.e1, k)[c] * x + get(wet.e2, k)[c] * y);
}
