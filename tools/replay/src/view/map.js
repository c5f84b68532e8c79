// The cells of a map of failure on the face of the slope. They lie still.

import { get, sub } from "../data/poses.js";
import { accent, rgb } from "./colours.js";
import { emptyMesh, put } from "./sheets.js";
import { emptyValues, ValueSheets } from "./value_sheets.js";

const kCarrier = 0; // the block that the cells' places count from: none moves

export class MapView extends ValueSheets {
  constructor(map, header, motion) {
    super(motion, { order: 0.5, colours: map.colours, none: [...rgb(map.none), 1] });
    this.map = map;
    this.centre = get(header.centroid, kCarrier);
    this.cellOf = []; // of each triangle
    const triangles = emptyValues();
    map.pieceCell.forEach((cell, piece) => {
      const corners = this.cornersOf(piece);
      for (let k = 1; k + 1 < corners.length; ++k) {
        for (const j of [0, k, k + 1]) triangles.position.push(...corners[j]), triangles.block.push(kCarrier);
        this.cellOf.push(cell);
      }
    });
    this.fill(triangles);
    this.setLines();
  }

  cornersOf(piece) {
    const { corner, pieceBegin } = this.map, corners = [];
    for (let k = pieceBegin[piece]; k < pieceBegin[piece + 1]; ++k) corners.push(sub(corner.slice(3 * k, 3 * k + 3), this.centre));
    return corners;
  }

  /** Colours the cells by a quantity of the map, and outlines the chosen one. */
  show(quantity, chosen) {
    if (quantity !== this.shown) {
      this.shown = quantity;
      const { most, values } = this.map.quantities[quantity];
      this.uniforms.most.value = most;
      this.setValues(this.cellOf.flatMap((cell) => [values[cell], values[cell], values[cell]]));
    }
    if (chosen === this.chosen) return;
    this.chosen = chosen;
    const lines = emptyMesh(), ink = [...rgb(accent), 1];
    this.map.pieceCell.forEach((cell, piece) => {
      if (cell !== chosen) return;
      const corners = this.cornersOf(piece);
      corners.forEach((p, k) => (put(lines, kCarrier, p, ink), put(lines, kCarrier, corners[(k + 1) % corners.length], ink)));
    });
    this.setLines(lines);
  }

  /** Number of the first cell along a ray up to a distance, or -1. */
  cellAlong(origin, direction, farthest, isCut) {
    const hit = this.pick(() => ({ position: this.centre, turn: [1, 0, 0, 0] }), origin, direction, isCut);
    return hit && hit.t <= farthest ? this.cellOf[hit.triangle] : -1;
  }
}
