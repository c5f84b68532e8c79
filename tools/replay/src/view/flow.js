// Water pressure of steady flow on the polygons of the joint network.

import { get, sub } from "../data/poses.js";
import { largestPressure, outlineOf } from "../data/flow.js";
import { dryJoint, rgb } from "./colours.js";
import { emptyMesh, put } from "./sheets.js";
import { emptyValues, ValueSheets } from "./value_sheets.js";

const kOutline = [0.08, 0.14, 0.22, 0.55];

export class FlowView extends ValueSheets {
  constructor(header, motion) {
    super(motion, { order: 10, colours: "pressure", none: [...rgb(dryJoint), 0.3] });
    const flow = (this.flow = header.flow);
    this.most = flow ? largestPressure(flow) : 0; // [Pa]
    this.uniforms.most.value = this.most;
    if (!flow) return;
    const offset = (node, block) => sub(get(flow.node, node), get(header.centroid, block));
    const triangles = emptyValues(), lines = emptyMesh();
    flow.triangle.forEach((node, k) => {
      const block = flow.blockA[Math.floor(k / 3)];
      triangles.position.push(...offset(node, block)), triangles.block.push(block), triangles.value.push(flow.pressure[node]);
    });
    for (const { triangle, nodes } of outlineOf(flow))
      for (const node of nodes) put(lines, flow.blockA[triangle], offset(node, flow.blockA[triangle]), kOutline);
    this.fill(triangles);
    this.setLines(lines);
  }
}
