// All blocks in two draw calls, faces and edges, whatever their shapes.

import * as THREE from "three";
import { cross, get, norm, scale, sub } from "../data/poses.js";
import { accent, scaleTexture, held, rgb, roleColours } from "./colours.js";
import { blockFragment, blockVertex, edgeFragment, edgeVertex } from "./shaders.js";

const attribute = (values, size) => new THREE.BufferAttribute(Float32Array.from(values), size);

/** Corners of a face share its normal, so each face has corners of its own. */
function facesOf(header) {
  const position = [], normal = [], block = [], index = [];
  for (let b = 0; b < header.names.length; ++b) {
    const centre = get(header.centroid, b);
    const corner = (k) => sub(get(header.vertex, header.faceVertex[k]), centre);
    for (let f = header.faceBegin[b]; f < header.faceBegin[b + 1]; ++f) {
      if (header.faceInner[f]) continue;
      const begin = header.faceVertexBegin[f], end = header.faceVertexBegin[f + 1];
      const outward = newellNormal(corner, begin, end), first = block.length;
      for (let k = begin; k < end; ++k) position.push(...corner(k)), normal.push(...outward), block.push(b);
      for (let k = 1; k + 1 < end - begin; ++k) index.push(first, first + k, first + k + 1);
    }
  }
  return geometryOf(position, block, index).setAttribute("faceNormal", attribute(normal, 3));
}

function geometryOf(position, block, index) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", attribute(position, 3));
  geometry.setAttribute("block", attribute(block, 1));
  geometry.setIndex(new THREE.BufferAttribute(Uint32Array.from(index), 1));
  return geometry;
}

function newellNormal(corner, begin, end) {
  let sum = [0, 0, 0];
  for (let k = begin + 1; k + 1 < end; ++k) {
    const part = cross(sub(corner(k), corner(begin)), sub(corner(k + 1), corner(begin)));
    sum = [sum[0] + part[0], sum[1] + part[1], sum[2] + part[2]];
  }
  return scale(sum, 1 / Math.max(norm(sum), 1e-300));
}

/** Each edge once: a closed polyhedron's faces name it in both directions. Blocks of several parts have corners of their own
 * for each part; there an edge between two faces of one plane is none. */
function edgesOf(header) {
  const position = [], block = [], index = [];
  for (let b = 0; b < header.names.length; ++b) {
    const centre = get(header.centroid, b);
    for (let v = header.vertexBegin[b]; v < header.vertexBegin[b + 1]; ++v)
      position.push(...sub(get(header.vertex, v), centre)), block.push(b);
    const edges = new Map();
    for (let f = header.faceBegin[b]; f < header.faceBegin[b + 1]; ++f) {
      if (header.faceInner[f]) continue;
      const begin = header.faceVertexBegin[f], end = header.faceVertexBegin[f + 1];
      const normal = newellNormal((k) => get(header.vertex, header.faceVertex[k]), begin, end);
      for (let k = begin; k < end; ++k) {
        const ends = [header.faceVertex[k], header.faceVertex[k + 1 < end ? k + 1 : begin]];
        const places = ends.map((v) => get(header.vertex, v).map((x) => Math.round(x / (1e-6 * header.size[b]))).join());
        const key = places.sort().join(";"), known = edges.get(key);
        edges.set(key, { ends, normal, flat: known && norm(sub(known.normal, normal)) < 1e-3 });
      }
    }
    for (const { ends, flat } of edges.values()) if (!flat) index.push(...ends);
  }
  return geometryOf(position, block, index);
}

export class BlocksView {
  constructor(header, motion) {
    this.uniforms = {
      ...motion.uniforms,
      colours: { value: scaleTexture("heat") },
      range: { value: new THREE.Vector2(0, 1) },
      categories: { value: false },
      categoryColours: { value: roleColours.map((text) => new THREE.Vector3(...rgb(text))) },
      heldColour: { value: new THREE.Vector3(...rgb(held)) },
      accent: { value: new THREE.Vector3(...rgb(accent)) },
      opacity: { value: 1 },
      selected: { value: -1 },
      hovered: { value: -1 },
      hideFixed: { value: false },
      ink: { value: new THREE.Vector4(0.1, 0.12, 0.15, 0.5) },
    };
    this.faceMaterial = new THREE.ShaderMaterial({
      glslVersion: THREE.GLSL3, uniforms: this.uniforms, vertexShader: blockVertex, fragmentShader: blockFragment,
      polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 4, // behind value sheets
    });
    const edgeMaterial = new THREE.ShaderMaterial({
      glslVersion: THREE.GLSL3, uniforms: this.uniforms, vertexShader: edgeVertex, fragmentShader: edgeFragment,
      transparent: true, depthWrite: false,
    });
    this.faces = new THREE.Mesh(facesOf(header), this.faceMaterial);
    this.edges = new THREE.LineSegments(edgesOf(header), edgeMaterial);
    this.edges.renderOrder = 1;
    this.object = new THREE.Group().add(this.faces, this.edges);
    for (const part of [this.faces, this.edges]) part.frustumCulled = false; // the shader moves them
  }

  /** With a section both sides of faces are drawn. */
  setCut(is_cut) {
    const side = is_cut ? THREE.DoubleSide : THREE.FrontSide;
    if (this.faceMaterial.side !== side) (this.faceMaterial.side = side), (this.faceMaterial.needsUpdate = true);
  }

  setOpacity(opacity) {
    this.uniforms.opacity.value = opacity;
    const ghost = opacity < 1;
    if (this.faceMaterial.transparent !== ghost) {
      this.faceMaterial.transparent = ghost;
      this.faceMaterial.depthWrite = !ghost;
      this.faceMaterial.needsUpdate = true;
    }
  }
}
