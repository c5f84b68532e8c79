// The messages of formats/snapshot.fbs as plain objects of arrays, through the code that flatc writes for the schema.

import { Frame } from "schema/frame";
import { Full } from "schema/full";
import { Header } from "schema/header";

const none = { f64: new Float64Array(0), f32: new Float32Array(0), i32: new Int32Array(0), u8: new Uint8Array(0) };

const vectors = (v) => ({ x: v?.xArray() ?? none.f64, y: v?.yArray() ?? none.f64, z: v?.zArray() ?? none.f64 });
const floats = (v) => ({ x: v?.xArray() ?? none.f32, y: v?.yArray() ?? none.f32, z: v?.zArray() ?? none.f32 });
const quaternions = (v) => ({ ...vectors(v), w: v?.wArray() ?? none.f64 });
const listOf = (length, item) => Array.from({ length }, (_, k) => item(k));
const indices = (length, item) => Float64Array.from({ length }, (_, k) => Number(item(k)));

export function decodeHeader(buffer) {
  const h = Header.getRootAsHeader(buffer);
  const g = h.geometry(), j = h.joints(), b = h.build();
  return {
    format: h.format(),
    scenarioPath: h.scenarioPath() ?? "",
    scenarioText: h.scenarioText() ?? "",
    gravity: h.gravity(),
    duration: h.duration(),
    frameInterval: h.frameInterval(),
    framesPerFull: h.framesPerFull(),
    build: { version: b?.version() ?? "", gitHash: b?.gitHash() ?? "", compiler: b?.compiler() ?? "" },
    commandLine: b?.commandLine() ?? "",
    names: listOf(g.nameLength(), (k) => g.name(k)),
    motion: g.motionArray() ?? none.u8,
    mass: g.massArray() ?? none.f64,
    centroid: vectors(g.centroid()),
    orientation: quaternions(g.orientation()),
    size: g.sizeArray() ?? none.f64,
    vertexBegin: g.vertexBeginArray() ?? none.i32,
    vertex: vectors(g.vertex()),
    faceBegin: g.faceBeginArray() ?? none.i32,
    faceVertexBegin: g.faceVertexBeginArray() ?? none.i32,
    faceVertex: g.faceVertexArray() ?? none.i32,
    joints: listOf(j?.nameLength() ?? 0, (k) => ({
      name: j.name(k),
      friction: j.friction(k),
      cohesion: j.cohesion(k),
      tensileStrength: j.tensileStrength(k),
      residualFriction: j.residualFriction(k),
      residualCohesion: j.residualCohesion(k),
    })),
    waters: listOf(h.watersLength(), (k) => decodeWater(h.waters(k))),
    failure: decodeFailure(h.failure()),
  };
}

/** What the search says that kept this run; null for others. */
function decodeFailure(f) {
  if (!f) return null;
  return {
    analysis: f.analysis() ?? "",
    load: f.load(),
    mode: ["none", "sliding", "toppling", "mixed"][f.mode()] ?? "none",
    role: f.roleArray() ?? none.u8,
  };
}

function decodeWater(w) {
  return {
    kind: ["depth", "elevation", "head"][w.level()] ?? "depth",
    head: [...(w.headArray() ?? none.f64)],
    density: w.density(),
    field: w.field() ?? "water",
  };
}

export function decodeFrame(buffer) {
  const f = Frame.getRootAsFrame(buffer);
  const e = f.energies(), w = f.water();
  return {
    time: f.time(),
    step: Number(f.step()),
    stateHash: f.stateHash().toString(16).padStart(16, "0"),
    tilt: f.tilt(),
    timeStep: f.timeStep(),
    kinetic: e?.kinetic() ?? 0,
    elastic: e?.elastic() ?? 0,
    gravity: e?.gravity() ?? 0,
    outOfBalance: f.outOfBalance(),
    displacement: floats(f.displacement()),
    rotation: floats(f.rotation()),
    velocity: floats(f.velocity()),
    waterLevel: w?.levelArray() ?? none.f64,
    waterTable: w?.tableArray() ?? none.f64,
    waterDrained: w?.drainedArray() ?? none.u8,
  };
}

/** What is shown of a full state; what only a restart needs stays in the file. */
export function decodeFull(buffer) {
  const f = Full.getRootAsFull(buffer);
  const i = f.interfaces(), p = f.points(), w = f.wet();
  const faces = i?.blockALength() ?? 0;
  return {
    time: f.time(),
    force: vectors(f.blocks()?.force()),
    interfaces: {
      count: faces,
      blockA: i?.blockAArray() ?? none.i32,
      blockB: i?.blockBArray() ?? none.i32,
      joint: i?.jointArray() ?? none.i32,
      area: i?.areaArray() ?? none.f64,
      origin: vectors(i?.originA()),
      e1: vectors(i?.e1A()),
      e2: vectors(i?.e2A()),
      pointBegin: indices(i?.pointBeginLength() ?? 0, (k) => i.pointBegin(k)),
      patchBegin: indices(i?.patchBeginLength() ?? 0, (k) => i.patchBegin(k)),
      patchXi: i?.patchXiArray() ?? none.f64,
      patchEta: i?.patchEtaArray() ?? none.f64,
      force: vectors(i?.force()),
    },
    points: {
      xi: p?.xiArray() ?? none.f64,
      eta: p?.etaArray() ?? none.f64,
      area: p?.areaArray() ?? none.f64,
      bond: p?.bondArray() ?? none.f64,
      normal: p?.normalArray() ?? none.f64,
      shear1: p?.shear1Array() ?? none.f64,
      shear2: p?.shear2Array() ?? none.f64,
      water: p?.waterArray() ?? none.f32,
      state: p?.stateArray() ?? none.u8,
      mobilised: p?.mobilisedArray() ?? none.f32,
    },
    wet: {
      count: w?.blockLength() ?? 0,
      block: w?.blockArray() ?? none.i32,
      water: w?.waterArray() ?? none.i32,
      origin: vectors(w?.origin()),
      e1: vectors(w?.e1()),
      e2: vectors(w?.e2()),
      vertexBegin: indices(w?.vertexBeginLength() ?? 0, (k) => w.vertexBegin(k)),
      vertexX: w?.vertexXArray() ?? none.f64,
      vertexY: w?.vertexYArray() ?? none.f64,
      head: vectors(w?.head()),
      force: vectors(w?.force()),
    },
  };
}
