// Framing of the scene: the model and the paths of moving blocks, beside the legends over the scene.

import { add, get, norm, poseOf, sub, turn } from "../data/poses.js";

const kGroundSize = 3; // a fixed block this many times as large as the free ones is ground
const kGroundInView = 2.2; // ground that makes the view larger than this many times is not put in view
const kFarWay = 20; // in sizes of a block: one that flies this far must not make the rest a dot
const kMoments = 9, kMany = 1000; // positions along a path, at most; blocks
const kDot = 60; // moving blocks are a dot in a view this many times as large
const kDirections = 300; // directions in which the outermost points of a cloud are sought

const emptyBox = () => ({ low: [Infinity, Infinity, Infinity], high: [-Infinity, -Infinity, -Infinity] });
const radiusOf = ({ low, high }) => norm(sub(high, low)) / 2;

export function boxOf(points) {
  const box = emptyBox();
  for (const point of points)
    for (let k = 0; k < 3; ++k) box.low[k] = Math.min(box.low[k], point[k]), (box.high[k] = Math.max(box.high[k], point[k]));
  return box;
}

/** Corners of a box drawn `times` as large, and no smaller than `least` to each side of its middle. */
function cornersOf({ low, high }, times, least = 0) {
  const middle = low.map((v, k) => (v + high[k]) / 2);
  const half = low.map((v, k) => Math.max(least, (times * (high[k] - v)) / 2));
  return Array.from({ length: 8 }, (_, c) => middle.map((v, k) => v + ((c >> k) & 1 ? half[k] : -half[k])));
}

/** Corners of a block as it lies in a frame. */
function cornersIn(header, frame, block, points) {
  const { position, turn: turned } = poseOf(header, { a: frame, b: frame, share: 0 }, block);
  const centre = get(header.centroid, block);
  for (let v = header.vertexBegin[block]; v < header.vertexBegin[block + 1]; ++v)
    points.push(add(position, turn(turned, sub(get(header.vertex, v), centre))));
  return points;
}

/** Positions of blocks along their paths; fewer moments for very many blocks. */
function wayOf(header, frames, blocks) {
  const count = blocks.length > kMany ? 3 : kMoments, points = [];
  const moments = new Set(Array.from({ length: count }, (_, k) => frames[Math.round((k * (frames.length - 1)) / (count - 1))]));
  for (const frame of moments) for (const b of blocks) cornersIn(header, frame, b, points);
  return points;
}

/** Moving blocks without those that fly off while most of the moving mass does not. */
function nearMovers(header, frame, radius, moving) {
  const typical = Math.max(...Array.from(moving, (b) => radius[b]).slice(0, 10000));
  const near = moving.filter((b) => norm(get(frame.displacement, b)) < kFarWay * typical);
  const mass = (blocks) => blocks.reduce((sum, b) => sum + header.mass[b], 0);
  return mass(near) > 0.5 * mass(moving) ? near : moving;
}

/** The model at the start and the moving blocks along their paths; ground only where it is not far larger. */
function wholeModel(header, frames, radius, free, way) {
  const typical = free.reduce((most, b) => Math.max(most, radius[b]), 0);
  const points = way.slice(), ground = [];
  header.names.forEach((_, b) =>
    cornersIn(header, frames[0], b, header.motion[b] !== 0 && radius[b] > kGroundSize * typical ? ground : points));
  const all = points.concat(ground);
  return radiusOf(boxOf(all)) < kGroundInView * radiusOf(boxOf(points)) ? all : points;
}

/**
 * Points that are to be seen: all of the model; or what moves, with as much again around it, where that is much smaller
 * (`closer`); or what moves as it lies in `frame`, where it would be no more than a dot in the whole.
 */
export function pointsInView({ header, frames, radius, free, moving }, closer, frame) {
  const near = nearMovers(header, frames.at(-1), radius, moving);
  const way = wayOf(header, frames, near), all = wholeModel(header, frames, radius, free, way);
  if (near.length === 0) return all;
  const size = radiusOf(boxOf(all)), largest = near.reduce((most, b) => Math.max(most, radius[b]), 0);
  if (frame && kDot * largest < size)
    return cornersOf(boxOf(near.flatMap((b) => cornersIn(header, frame, b, []))), 2, 12 * largest);
  return closer && 2 * radiusOf(boxOf(way)) < 0.8 * size ? cornersOf(boxOf(way), 2) : all;
}

/** The outermost points of a cloud in many directions. */
export function outermost(points) {
  if (points.length <= kDirections) return points;
  const found = new Set();
  for (let k = 0; k < kDirections; ++k) { // a spiral from pole to pole
    const z = 1 - (2 * k + 1) / kDirections, r = Math.sqrt(1 - z * z), angle = k * 2.399963;
    const x = r * Math.cos(angle), y = r * Math.sin(angle);
    let most = -Infinity, best = null;
    for (const point of points) {
      const reach = x * point[0] + y * point[1] + z * point[2];
      if (reach > most) most = reach, (best = point);
    }
    found.add(best);
  }
  return [...found];
}

// --- beside the legends ----------------------------------------------------------------------------------------------

const kGap = 10, kMargin = 0.035; // beside what stands over the scene [px], around the whole in heights or widths

/** Whether the convex hull of points has something in a rectangle: no line of the usual directions parts them. */
function touches(points, { left, top, right, bottom }) {
  const corners = [[left, top], [right, top], [right, bottom], [left, bottom]];
  for (let k = 0; k < 32; ++k) {
    const c = Math.cos((k * Math.PI) / 16), s = Math.sin((k * Math.PI) / 16);
    const nearest = Math.min(...corners.map(([x, y]) => c * x + s * y));
    if (points.every(([x, y]) => c * x + s * y < nearest)) return false;
  }
  return true;
}

/** Every way to keep clear of what stands over the scene: of each at one of its inner sides, or not. */
function insetsFor(overlays, width, height) {
  const margin = Math.max(kGap, kMargin * Math.min(width, height));
  return overlays.reduce((list, box) => {
    const sides = [box.left + box.right < width ? { left: box.right + kGap } : { right: width - box.left + kGap },
      box.top + box.bottom < height ? { top: box.bottom + kGap } : { bottom: height - box.top + kGap }];
    return list.flatMap((inset) => [inset, ...sides.map((side) => {
      const [[name, value]] = Object.entries(side);
      return { ...inset, [name]: Math.max(inset[name], value) };
    })]);
  }, [{ left: margin, right: margin, top: margin, bottom: margin }]);
}

/** How a rectangle of the canvas is filled: `seen` are points as [right, up, towards], `pixel` the tangent of one. */
function fill(seen, { left, right, top, bottom }, width, height, pixel) {
  const halves = [((width - left - right) / 2) * pixel, ((height - top - bottom) / 2) * pixel];
  if (Math.min(...halves) < 40 * pixel) return null;
  const most = (k, sign) => seen.reduce((far, p) => Math.max(far, sign * p[k] + halves[k] * p[2]), -Infinity);
  const reach = [0, 1].map((k) => [most(k, 1), most(k, -1)]);
  const distance = Math.max(...reach.map(([a, b], k) => (a + b) / (2 * halves[k])));
  return { distance, shift: reach.map(([a, b]) => (a - b) / 2),
    middle: [(left + width - right) / 2, (top + height - bottom) / 2] };
}

/**
 * The nearest place from which all points are on the canvas and none is beneath what stands over it: the distance of the
 * camera from the origin's depth, the point it looks at as [right, up], and where on the canvas that is.
 */
export function frameBeside(seen, overlays, width, height, pixel) {
  let best = null;
  for (const inset of insetsFor(overlays, width, height)) {
    const place = fill(seen, inset, width, height, pixel);
    if (!place || (best && place.distance >= best.distance)) continue;
    const points = seen.map(([x, y, z]) => {
      const scale = 1 / ((place.distance - z) * pixel);
      return [place.middle[0] + (x - place.shift[0]) * scale, place.middle[1] - (y - place.shift[1]) * scale];
    });
    if (!overlays.some((box) => touches(points, box))) best = place;
  }
  return best ?? fill(seen, { left: 0, right: 0, top: 0, bottom: 0 }, Math.max(width, 80), Math.max(height, 80), pixel);
}
