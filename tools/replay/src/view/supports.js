// Supports (bolts) as bars through the blocks they hold, coloured by how much of their strength is used; and the water table of a slope.

import { add, cross, get, norm, scale, sub } from "../data/poses.js";
import { openJoint, rgb, used, water as waterColour } from "./colours.js";
import { emptyMesh, put, putPolygon, Sheets } from "./sheets.js";

const unit = (v) => scale(v, 1 / (norm(v) || 1));

/** Two ribbons at right angles between two points that each go with a block of their own. */
function putBar(mesh, from, to, width, tint) {
  const along = unit(sub(to.place, from.place));
  const side = unit(cross(along, Math.abs(along[1]) < 0.9 ? [0, 1, 0] : [1, 0, 0]));
  for (const across of [side, cross(along, side)]) {
    const half = scale(across, width / 2);
    const corners = [[from, -1], [from, 1], [to, 1], [to, -1]].map(([end, sign]) => [end.block, add(end.offset, scale(half, sign))]);
    for (const k of [0, 1, 2, 0, 2, 3]) put(mesh, ...corners[k], tint);
  }
}

export class SupportsView extends Sheets {
  constructor(header, motion, blockSize) {
    super(motion, 30);
    this.header = header;
    this.width = 0.04 * blockSize;
    this.supports = header.supports ? Array.from(header.supports.name, (_, k) => this.pointsOf(k)) : [];
  }

  pointsOf(k) {
    const { pointBegin, point, block } = this.header.supports;
    return Array.from({ length: pointBegin[k + 1] - pointBegin[k] }, (_, j) => {
      const at = pointBegin[k] + j, place = get(point, at);
      return { block: block[at], place, offset: sub(place, get(this.header.centroid, block[at])) };
    });
  }

  show(frame) {
    const bars = emptyMesh();
    this.supports.forEach((points, k) => {
      const tint = [...(frame.supports?.broken[k] ? rgb(openJoint) : used(frame.supports?.utilisation[k] ?? 0)), 1];
      for (let j = 0; j + 1 < points.length; ++j) putBar(bars, points[j], points[j + 1], this.width, tint);
    });
    this.fill(bars, emptyMesh());
  }
}

/** Its triangles, or a line over the blocks' extent; it stands still, like the first block that does. */
export class PhreaticView extends Sheets {
  constructor(header, motion) {
    super(motion, 24);
    const block = Array.from(header.motion).findIndex((kind) => kind === 1);
    const sheet = emptyMesh(), lines = emptyMesh();
    if (header.phreaticTriangle?.length && block >= 0) {
      const colour = rgb(waterColour), corner = header.phreaticTriangle;
      for (let k = 0; k < corner.length; k += 3) {
        const corners = [0, 1, 2].map((j) => corner[k + j])
          .map((v) => sub([header.phreaticX[v], header.phreaticY[v], header.phreaticZ[v]], get(header.centroid, block)));
        putPolygon(sheet, block, corners, corners.map(() => [...colour, 0.22]));
        for (const j of [0, 1, 2]) for (const at of [j, (j + 1) % 3]) put(lines, block, corners[at], [...colour, 0.5]);
      }
    } else if (header.phreaticX?.length && block >= 0) {
      const low = Math.min(...header.vertex.y), high = Math.max(...header.vertex.y);
      const left = Math.min(...header.vertex.x), right = Math.max(...header.vertex.x);
      const line = Array.from(header.phreaticX, (x, k) => [x, header.phreaticZ[k]]);
      line.unshift([Math.min(left, line[0][0]), line[0][1]]);
      line.push([Math.max(right, line.at(-1)[0]), line.at(-1)[1]]);
      const colour = rgb(waterColour);
      for (let k = 0; k + 1 < line.length; ++k) {
        const corners = [[line[k], low], [line[k + 1], low], [line[k + 1], high], [line[k], high]]
          .map(([[x, z], y]) => sub([x, y, z], get(header.centroid, block)));
        putPolygon(sheet, block, corners, corners.map(() => [...colour, 0.22]));
        for (const [j, l] of [[0, 1], [3, 2]]) for (const at of [j, l]) put(lines, block, corners[at], [...colour, 1]);
      }
    }
    this.fill(sheet, lines);
  }
}
