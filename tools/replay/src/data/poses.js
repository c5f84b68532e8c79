// Where blocks are: the same arithmetic as the vertex shader of view/shaders.js, for picking, labels and numbers.

export const get = (list, k) => [list.x[k], list.y[k], list.z[k]];
export const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const norm = (a) => Math.hypot(a[0], a[1], a[2]);
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/** v turned by the unit quaternion [w, x, y, z]. */
export function turn(q, v) {
  const u = [q[1], q[2], q[3]];
  const t = scale(cross(u, v), 2);
  return add(add(v, scale(t, q[0])), cross(u, t));
}

/** Unit quaternion of a rotation vector, axis times angle [rad]. */
export function quaternionOf(r) {
  const angle = norm(r);
  const s = angle > 1e-12 ? Math.sin(angle / 2) / angle : 0.5;
  return [Math.cos(angle / 2), r[0] * s, r[1] * s, r[2] * s];
}

/** Rotation between two unit quaternions, turned `times` as far. */
function blended(a, b, share, times) {
  const sign = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] < 0 ? -1 : 1;
  const q = a.map((value, k) => value * (1 - share) + sign * b[k] * share);
  const length = Math.hypot(...q);
  const v = [q[1] / length, q[2] / length, q[3] / length], sine = norm(v);
  if (sine < 1e-9) return [1, 0, 0, 0];
  const half = Math.atan2(sine, q[0] / length) * times;
  return [Math.cos(half), ...scale(v, Math.sin(half) / sine)];
}

/** Pose of a block between two frames, its motion since the start drawn `times` as large. */
export function poseOf(header, frames, block, times = 1) {
  const { a, b, share } = frames;
  const u = add(scale(get(a.displacement, block), 1 - share), scale(get(b.displacement, block), share));
  const q = blended(quaternionOf(get(a.rotation, block)), quaternionOf(get(b.rotation, block)), share, times);
  return { position: add(get(header.centroid, block), scale(u, times)), turn: q };
}

/** A point given in a block's own frame, relative to its centroid as it lay at the start. */
export function restOffset(header, block, own) {
  const q = header.orientation;
  return turn([q.w[block], q.x[block], q.y[block], q.z[block]], own);
}

/** Distance of each block's farthest vertex from its centroid [m]. */
export function radiiOf(header) {
  return Float64Array.from(header.mass, (_, b) => {
    let most = 0;
    for (let v = header.vertexBegin[b]; v < header.vertexBegin[b + 1]; ++v)
      most = Math.max(most, norm(sub(get(header.vertex, v), get(header.centroid, b))));
    return most;
  });
}

/** Up in the model frame when gravity is tilted. */
export const upOf = (tilt) => [Math.sin(tilt), 0, Math.cos(tilt)];
