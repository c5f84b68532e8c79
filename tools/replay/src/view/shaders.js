// Everything that moves with a block is drawn by one vertex shader: a texture holds the blocks' motion at two frames, the
// shader goes between them and exaggerates. Playing costs one small upload a frame, whatever the blocks' shapes.

/** Four texels a block: displacement and colour value at frame a, rotation vector and kind; the same at frame b. */
export const kTexelsPerBlock = 4;
export const kBlocksPerRow = 512;

/** Cut away is what lies in front of the section plane. */
export const cutDeclaration = `uniform vec4 cut;
in vec3 vPlace;`;
export const cutDiscard = "if (dot(cut.xyz, vPlace) > cut.w) discard;";

/** `placed(offset, block)`: where a point is that lay at centroid + offset at the start. */
export const poseShader = `
uniform highp sampler2D motions;
uniform highp sampler2D centroids;
uniform float share;
uniform float exaggeration;

vec4 motionTexel(int block, int which) {
  return texelFetch(motions, ivec2((block % ${kBlocksPerRow}) * ${kTexelsPerBlock} + which, block / ${kBlocksPerRow}), 0);
}
vec4 quaternionOf(vec3 r) {
  float angle = length(r);
  float s = angle > 1e-6 ? sin(0.5 * angle) / angle : 0.5;
  return vec4(r * s, cos(0.5 * angle));
}
vec3 turned(vec4 q, vec3 v) { vec3 t = 2.0 * cross(q.xyz, v); return v + q.w * t + cross(q.xyz, t); }

vec4 turnOf(int block) {
  vec4 a = quaternionOf(motionTexel(block, 1).xyz), b = quaternionOf(motionTexel(block, 3).xyz);
  vec4 q = normalize(mix(a, dot(a, b) < 0.0 ? -b : b, share));
  float sine = length(q.xyz);
  if (sine < 1e-6) return vec4(0.0, 0.0, 0.0, 1.0);
  float halfAngle = atan(sine, q.w) * exaggeration;
  return vec4(q.xyz / sine * sin(halfAngle), cos(halfAngle));
}
vec3 centroidOf(int block) {
  vec3 u = mix(motionTexel(block, 0).xyz, motionTexel(block, 2).xyz, share) * exaggeration;
  return texelFetch(centroids, ivec2(block % ${kBlocksPerRow}, block / ${kBlocksPerRow}), 0).xyz + u;
}
vec3 placed(vec3 offset, int block) { return centroidOf(block) + turned(turnOf(block), offset); }
`;

export const blockVertex = `${poseShader}
in float block;
in vec3 faceNormal;
out vec3 vNormal;
out float vValue;
out vec3 vPlace;
flat out int vKind;
flat out int vBlock;
void main() {
  int b = int(block + 0.5);
  vBlock = b;
  vKind = int(motionTexel(b, 1).w + 0.5);
  vValue = mix(motionTexel(b, 0).w, motionTexel(b, 2).w, share);
  vNormal = normalMatrix * turned(turnOf(b), faceNormal);
  vPlace = placed(position, b);
  gl_Position = projectionMatrix * modelViewMatrix * vec4(vPlace, 1.0);
}`;

export const blockFragment = `
precision highp float;
uniform sampler2D colours;
uniform vec2 range;
uniform bool categories;
uniform vec3 categoryColours[5];
uniform vec3 heldColour;
uniform vec3 accent;
uniform float opacity;
uniform int selected;
uniform int hovered;
uniform bool hideFixed;
${cutDeclaration}
in vec3 vNormal;
in float vValue;
flat in int vKind;
flat in int vBlock;
out vec4 colour;
void main() {
  if (hideFixed && vKind == 1) discard;
  ${cutDiscard}
  vec3 base;
  if (categories) base = categoryColours[int(vValue + 0.5)];
  else if (vKind > 0) base = heldColour;
  else {
    float x = clamp((vValue - range.x) / max(range.y - range.x, 1e-30), 0.0, 1.0);
    base = texture(colours, vec2(0.5 / 256.0 + x * 255.0 / 256.0, 0.5)).rgb;
  }
  // Seen from the camera: light from above left, and a little from everywhere, so that faces stay apart.
  vec3 n = normalize(vNormal);
  float light = 0.62 + 0.30 * max(dot(n, normalize(vec3(-0.35, 0.85, 0.4))), 0.0) + 0.14 * max(n.z, 0.0);
  vec3 lit = base * light;
  // The inside of a block is seen only where the section cuts it open: one flat tone there looks solid.
  if (!gl_FrontFacing) lit = base * 0.72;
  if (vBlock == selected) lit = mix(lit, accent, 0.45);
  else if (vBlock == hovered) lit = mix(lit, vec3(1.0), 0.22);
  colour = vec4(lit, vBlock == selected ? max(opacity, 0.55) : opacity);
}`;

export const edgeVertex = `${poseShader}
in float block;
out vec3 vPlace;
flat out int vBlock;
flat out int vKind;
void main() {
  int b = int(block + 0.5);
  vBlock = b;
  vKind = int(motionTexel(b, 1).w + 0.5);
  vPlace = placed(position, b);
  gl_Position = projectionMatrix * modelViewMatrix * vec4(vPlace, 1.0);
}`;

export const edgeFragment = `
precision highp float;
uniform vec4 ink;
uniform vec3 accent;
uniform int selected;
uniform bool hideFixed;
${cutDeclaration}
flat in int vBlock;
flat in int vKind;
out vec4 colour;
void main() {
  if (hideFixed && vKind == 1) discard;
  ${cutDiscard}
  colour = vBlock == selected ? vec4(accent, 1.0) : ink;
}`;

/** Flat polygons fixed to blocks (water, joints): a colour of their own per vertex. */
export const sheetVertex = `${poseShader}
in float block;
in vec4 tint;
out vec4 vTint;
out vec3 vPlace;
void main() {
  vTint = tint;
  vPlace = placed(position, int(block + 0.5));
  gl_Position = projectionMatrix * modelViewMatrix * vec4(vPlace, 1.0);
}`;

export const sheetFragment = `
precision highp float;
uniform float strength;
${cutDeclaration}
in vec4 vTint;
out vec4 colour;
void main() { ${cutDiscard} colour = vec4(vTint.rgb, vTint.a * strength); }`;

/** Flat polygons fixed to blocks, coloured along a scale by a value that is linear on each triangle. */
export const valueVertex = `${poseShader}
in float block;
in float value;
out float vValue;
out vec3 vPlace;
void main() {
  vValue = value;
  vPlace = placed(position, int(block + 0.5));
  gl_Position = projectionMatrix * modelViewMatrix * vec4(vPlace, 1.0);
}`;

/** Drawn twice: where the value is positive, and where it is not (`drawsNone`). */
export const valueFragment = `
precision highp float;
uniform sampler2D colours;
uniform float most;
uniform vec4 none;
uniform bool drawsNone;
${cutDeclaration}
in float vValue;
out vec4 colour;
void main() {
  ${cutDiscard}
  if (vValue > 0.0 == drawsNone) discard;
  float x = clamp(vValue / max(most, 1e-30), 0.0, 1.0);
  colour = drawsNone ? none : vec4(texture(colours, vec2(0.5 / 256.0 + x * 255.0 / 256.0, 0.5)).rgb, 1.0);
}`;

/** One arrow an instance: its tip (or its tail, where pushing is 0) at a point of a block, along a force. */
export const arrowVertex = `${poseShader}
uniform float metresPerNewton;
uniform float thickness;
uniform float longest;
in vec3 offset;
in float block;
in vec3 force;
in vec3 tint;
in float pushing;
out vec3 vNormal;
out vec3 vTint;
void main() {
  float strength = length(force);
  vec3 along = force / max(strength, 1e-30);
  vec3 side = normalize(cross(along, abs(along.x) < 0.9 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0)));
  vec3 across = cross(along, side);
  float size = min(strength * metresPerNewton, longest);
  float thick = min(thickness, size * 0.12);
  float headSize = thick * 3.6;
  // The mesh: z from 0 (tail) to 1 (neck) is the shaft, from 1 to 2 the head.
  float z = position.z <= 1.0 ? position.z * (size - headSize) : size - headSize + (position.z - 1.0) * headSize;
  vec3 local = side * position.x * thick + across * position.y * thick + along * (z - pushing * size);
  vNormal = normalMatrix * (side * normal.x + across * normal.y + along * normal.z);
  vTint = tint;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(placed(offset, int(block + 0.5)) + local, 1.0);
}`;

export const arrowFragment = `
precision highp float;
in vec3 vNormal;
in vec3 vTint;
out vec4 colour;
void main() {
  vec3 n = normalize(vNormal);
  colour = vec4(vTint * (0.72 + 0.35 * max(dot(n, normalize(vec3(-0.35, 0.85, 0.4))), 0.0)), 1.0);
}`;
