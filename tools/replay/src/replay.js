// The replay: the scene at the player's time. Everything is drawn on demand, at most once a picture.

import { add, get, norm, poseOf, radiiOf, sub, turn } from "./data/poses.js";
import { prepareFull } from "./data/contacts.js";
import { groupsOf, heatOfGroups } from "./data/groups.js";
import { falls, headingOf, motionText, movingBlocks } from "./data/moving.js";
import { overallMode, rolesAt, setOffTime } from "./data/roles.js";
import { Player } from "./player.js";
import { ArrowsView } from "./view/arrows.js";
import { outermost, pointsInView } from "./view/framing.js";
import { BlocksView } from "./view/blocks.js";
import { MotionTextures } from "./view/motion.js";
import { PathsView } from "./view/paths.js";
import { pickBlock, pickInterface } from "./view/pick.js";
import { isCut, planeOf } from "./view/section.js";
import { FlowView } from "./view/flow.js";
import { MapView } from "./view/map.js";
import { JointsView, WaterView } from "./view/sheets.js";
import { SupportsView, PhreaticView } from "./view/supports.js";
import { Stage } from "./view/stage.js";
import { Controls } from "./ui/controls.js";

const magnitudes = (list) => Float32Array.from(list.x, (_, b) => Math.hypot(list.x[b], list.y[b], list.z[b]));
const median = (values) => values.slice().sort((a, b) => a - b)[Math.floor(values.length / 2)];

const kSameDepth = 1e-3; // of a block: a cell no farther behind a block's face lies on it

export class Replay {
  /** A run, or the blocks of a slope with a map of failure on it. */
  constructor(file, map = null) {
    this.file = file;
    this.header = file.header;
    this.frames = file.frames;
    this.radius = radiiOf(this.header);
    this.look = { colouring: map ? "probability" : "displacement", ownScale: false, water: true, forces: false, joints: false, edges: true,
      jointColouring: "friction", fixed: true, paths: false, section: { axis: "", share: 0.5, flipped: false }, exaggeration: 1, opacity: 1, arrowSize: 1 };
    this.selected = { block: -1, interface: -1, cell: -1 };
    this.hovered = -1;
    this.map = map;
    this.fullIndex = -1, (this.full = null);
    this.valuesOf = { frame: [], values: [] };
    const roles = rolesAt(this.header, this.frames.at(-1), this.radius);
    this.groups = groupsOf(this.header);
    this.heatOfGroups = heatOfGroups(this.header);
    this.mode = overallMode(this.header, roles);
    this.moving = movingBlocks(roles);
    this.motionText = motionText(this.header, this.frames, this.mode, this.moving);
    this.player = new Player(this.frames, () => this.invalidate("time"));
    this.buildScene();
    this.controls = new Controls(this);
    this.dirty = new Set(["all"]);
    this.home("iso");
    this.controls.readAddress();
    this.ready = this.refreshFull().then(() => this.runLoop());
  }

  buildScene() {
    this.stage = new Stage(document.getElementById("scene"), () => this.invalidate("camera"), () => (this.framed = null));
    this.motion = new MotionTextures(this.header);
    this.blocks = new BlocksView(this.header, this.motion);
    this.joints = new JointsView(this.header, this.motion);
    this.water = new WaterView(this.header, this.motion);
    const free = this.freeBlocks();
    this.blockSize = median(free.map((b) => this.header.size[b]));
    this.arrows = new ArrowsView(this.header, this.motion, this.blockSize);
    this.supports = new SupportsView(this.header, this.motion, this.blockSize);
    this.phreatic = new PhreaticView(this.header, this.motion);
    this.flow = new FlowView(this.header, this.motion);
    this.cells = this.map && new MapView(this.map, this.header, this.motion);
    this.paths = new PathsView(this.header, this.frames, this.motion, this.moving.length ? this.moving : free);
    this.stage.model.add(this.blocks.object, this.joints.object, this.water.object, this.supports.object, this.phreatic.object,
      this.paths.object, this.flow.object);
    if (this.cells) this.stage.model.add(this.cells.object);
    this.stage.over.add(this.arrows.object);
    this.ranges = this.wholeRanges();
  }

  freeBlocks() {
    const free = this.header.names.map((_, b) => b).filter((b) => this.header.motion[b] === 0);
    return free.length ? free : this.header.names.map((_, b) => b);
  }

  /** Largest displacement, velocity and rotation of a free block over the whole run. */
  wholeRanges() {
    const ranges = { displacement: 0, velocity: 0, rotation: 0 };
    for (const frame of this.frames)
      for (const kind of Object.keys(ranges)) ranges[kind] = Math.max(ranges[kind], this.largest(frame, kind));
    return ranges;
  }

  largest(frame, kind) {
    const { x, y, z } = frame[kind];
    let most = 0;
    for (let b = 0; b < x.length; ++b)
      if (this.header.motion[b] === 0) most = Math.max(most, x[b] * x[b] + y[b] * y[b] + z[b] * z[b]);
    return Math.sqrt(most);
  }

  /** Sets one of the named views; with a `moment` of the run, on the positions at that time. */
  home(view, moment = null) {
    this.view = view;
    this.moment = moment;
    this.framed = outermost(pointsInView({ header: this.header, frames: this.frames, radius: this.radius,
      free: this.freeBlocks(), moving: this.moving }, view !== "top", moment));
    this.frameAgain();
  }

  /** Frames the scene beside the legends, unless the reader has moved the camera since. */
  frameAgain() {
    if (!this.framed) return;
    this.stage.setTilt((this.moment ?? this.frames[0]).tilt);
    this.stage.look(this.view, this.framed, this.controls?.overlays() ?? [],
      this.map?.heading ?? headingOf(this.header, this.frames.at(-1), this.moving) ?? undefined);
    if (this.now) this.stage.setTilt(this.tiltNow());
  }

  tiltNow() {
    const { a, b, share } = this.now;
    return a.tilt + (b.tilt - a.tilt) * share;
  }

  /** Whether a block is drawn. */
  shows(block) {
    return this.look.fixed || this.header.motion[block] !== 1;
  }

  invalidate(what) {
    this.dirty?.add(what);
  }

  runLoop() {
    let last = performance.now();
    const tick = (now) => {
      this.player.advance(Math.min(0.25, (now - last) / 1000));
      last = now;
      if (this.dirty.size) this.draw();
      requestAnimationFrame(tick);
    };
    this.draw();
    requestAnimationFrame(tick);
  }

  draw() {
    const dirty = this.dirty;
    this.dirty = new Set();
    const shape = ["all", "time", "look", "selection", "full"].some((what) => dirty.has(what));
    if (shape) this.updateScene(dirty);
    this.controls.update(dirty);
    if (dirty.has("all") || dirty.has("framing")) this.frameAgain();
    this.stage.render();
    this.controls.film?.take();
    this.pictures = (this.pictures ?? 0) + 1;
  }

  updateScene(dirty) {
    const now = this.player.between();
    this.now = now;
    const { a, b } = now;
    this.stage.setTilt(this.tiltNow());
    this.motion.uniforms.share.value = now.share;
    this.motion.uniforms.exaggeration.value = this.look.exaggeration;
    const newFrame = this.shownFrame !== a || dirty.has("look") || dirty.has("all");
    if (newFrame) this.uploadFrames(a, b);
    const uniforms = this.blocks.uniforms;
    uniforms.selected.value = this.selected.block, (uniforms.hovered.value = this.hovered);
    uniforms.hideFixed.value = !this.look.fixed;
    this.updateSection();
    this.paths.object.visible = this.look.paths;
    this.paths.show(now.index + (now.share > 0 ? 1 : 0));
    this.blocks.setOpacity(this.rockOpacity());
    this.blocks.edges.visible = this.look.edges;
    uniforms.ink.value.set(...this.controls.edgeInk(this.rockOpacity()));
    this.refreshFull();
    if (newFrame || dirty.has("full") || dirty.has("selection")) this.updateLayers(a);
    this.shownFrame = a;
  }

  updateSection() {
    this.plane = planeOf(this.header, this.look.section, (b) => this.shows(b));
    this.motion.uniforms.cut.value.set(...(this.plane ? [...this.plane.normal, this.plane.at] : [0, 0, 0, 1]));
    this.blocks.setCut(this.plane !== null);
  }

  /** Failure role of every block by its motion up to the frame shown. */
  get roles() {
    const frame = this.now.a;
    if (this.rolesFrame !== frame) {
      this.rolesFrame = frame;
      this.rolesFound = rolesAt(this.header, frame, this.radius);
    }
    return this.rolesFound;
  }

  /** Whether joints are shown, coloured by the pressure of their water. */
  showsFlow() {
    return this.look.joints && this.look.jointColouring === "pressure" && Boolean(this.header.flow);
  }

  /** Joints lie between opaque blocks: they need ghosts to be seen. */
  rockOpacity() {
    if (this.look.joints) return Math.min(this.look.opacity, 0.12);
    return this.look.forces ? Math.min(this.look.opacity, 0.6) : this.look.opacity;
  }

  uploadFrames(a, b) {
    const colouring = this.look.colouring;
    const values = (frame) => (colouring === "role" ? this.roles : colouring === "factor" ? this.heatOfGroups
      : this.map ? new Float32Array(this.radius.length) : magnitudes(frame[colouring]));
    this.motion.set(a, b, values(a), values(b));
    const most = colouring === "role" || colouring === "factor" || this.map ? 1
      : this.look.ownScale ? this.largest(a, colouring) : this.ranges[colouring];
    this.range = [0, most > 0 ? most : 1e-12];
    this.blocks.uniforms.range.value.set(...this.range);
    this.blocks.uniforms.categories.value = colouring === "role";
  }

  updateLayers(frame) {
    this.water.object.visible = this.look.water;
    this.water.show(this.look.water ? this.full : null, frame);
    this.phreatic.object.visible = this.look.water;
    this.supports.show(frame);
    this.cells?.show(this.look.colouring, this.selected.cell);
    const chosen = this.selected.interface, by_friction = this.look.joints && !this.showsFlow();
    this.flow.object.visible = this.showsFlow();
    this.joints.object.visible = by_friction || chosen >= 0;
    this.joints.show(this.joints.object.visible ? this.full : null, this.full?.sums, by_friction, chosen, this.showsFlow());
    const body = this.selected.block;
    const wanted = !this.map && (this.look.forces || body >= 0);
    this.arrows.show(wanted ? this.full : null, frame, body, this.look.arrowSize, this.controls.dark());
  }

  /** Reads the last full state not after the time when it is not the one at hand. */
  async refreshFull() {
    const ns = BigInt(Math.round(this.player.time * 1e9)) + 1n;
    let k = this.file.fullTimes.length - 1;
    while (k >= 0 && this.file.fullTimes[k] > ns) --k;
    if (k === this.fullIndex) return;
    this.fullIndex = k;
    const full = k < 0 ? null : prepareFull(this.header, await this.file.full(k));
    if (this.fullIndex !== k) return; // time has gone on meanwhile
    this.keepInterface(full);
    this.full = full;
    this.invalidate("full");
  }

  /** A selected interface stays selected in another full state, by its blocks and faces' order. */
  keepInterface(full) {
    const i = this.selected.interface;
    if (i < 0 || !this.full) return;
    const was = this.full.interfaces, f = full?.interfaces;
    let found = -1;
    for (let k = 0; f && k < f.count && found < 0; ++k)
      if (f.blockA[k] === was.blockA[i] && f.blockB[k] === was.blockB[i]) found = k;
    this.selected.interface = found;
  }

  /** Selects a block by name or index, or nothing (-1). */
  select(block) {
    const index = typeof block === "string" ? this.header.names.indexOf(block) : block;
    this.selected = { block: index, interface: -1, cell: -1 };
    this.invalidate("selection");
  }

  selectInterface(i) {
    this.selected = { block: -1, interface: i, cell: -1 };
    this.invalidate("selection");
  }

  /** Selects what is drawn at a point of the canvas (CSS pixels). */
  pick(x, y) {
    const { origin, direction } = this.stage.rayAt(x, y);
    const times = this.look.exaggeration;
    if (this.look.joints) {
      const i = pickInterface(this.header, this.full, this.now, times, origin, direction, this.selected.interface);
      if (i >= 0) return this.selectInterface(i);
    }
    this.select(this.blockAlong(origin, direction).block);
    this.selected.cell = this.cellAlong(origin, direction);
  }

  /** Number of the map's cell that a ray meets first, or -1. */
  cellAlong(origin, direction) {
    if (!this.cells) return -1;
    const least = kSameDepth * this.blockSize;
    return this.cells.cellAlong(origin, direction, this.blockAlong(origin, direction).t + least, (point) => isCut(this.plane, point));
  }

  /** Numbers of the map's cells whose centre lies on a block of the scenario. */
  cellsOn(block) {
    const { cells } = this.map, centroid = get(this.header.centroid, block), least = kSameDepth * this.blockSize;
    const onBlock = (cell) => {
      const [centre, normal] = [cells.centre, cells.normal].map((list) => list.slice(3 * cell, 3 * cell + 3));
      if (norm(sub(centre, centroid)) > this.radius[block] + least) return false;
      const from = add(centre, normal.map((x) => x * least));
      return pickBlock(this.header, this.radius, this.now, 1, from, normal.map((x) => -x), (b) => b === block).t < 2 * least;
    };
    return cells.area.map((_, cell) => cell).filter(onBlock);
  }

  /** Where a ray meets the flow in joints first, as it is drawn: { triangle, value }, or null. */
  flowAlong(origin, direction) {
    if (!this.showsFlow()) return null;
    return this.flow.pick((b) => poseOf(this.header, this.now, b, this.look.exaggeration), origin, direction,
      (point) => isCut(this.plane, point));
  }

  blockAlong(origin, direction) {
    return pickBlock(this.header, this.radius, this.now, this.look.exaggeration, origin, direction, (b) => this.shows(b),
      (point) => isCut(this.plane, point));
  }

  hover(x, y) {
    const { origin, direction } = this.stage.rayAt(x, y);
    this.hovered = this.blockAlong(origin, direction).block;
    this.under = { cell: this.cellAlong(origin, direction), flow: this.flowAlong(origin, direction) };
    this.blocks.uniforms.hovered.value = this.hovered;
    this.invalidate("camera");
    return this.hovered;
  }

  /** Canvas point (CSS pixels) of a block's centroid, by name or index. */
  screenOf(block) {
    const index = typeof block === "string" ? this.header.names.indexOf(block) : block;
    return this.stage.screenOf(poseOf(this.header, this.now, index, this.look.exaggeration).position);
  }

  /** A point that moves with a block, where it is drawn in the model frame. */
  placeOf(block, offset) {
    const pose = poseOf(this.header, this.now, block, this.look.exaggeration);
    return add(pose.position, turn(pose.turn, offset));
  }

  /** Canvas point of a point that moves with a block. */
  screenOfPoint(block, offset) {
    return this.stage.screenOf(this.placeOf(block, offset));
  }

  isCutAway(block, offset) {
    return isCut(this.plane ?? null, this.placeOf(block, offset));
  }

  /** When a block began to move, and whether it flies in much of its motion. */
  historyOf(block) {
    this.histories ??= new Map();
    if (!this.histories.has(block))
      this.histories.set(block, { setOff: setOffTime(this.header, this.frames, block, this.radius), falls: falls(this.header, this.frames, block) });
    return this.histories.get(block);
  }
}
