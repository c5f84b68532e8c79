// Buttons, sliders, keys, curves and labels of the page: they change the replay's look and time, and follow it.

import { speeds } from "../player.js";
import { rule } from "../data/roles.js";
import { angle, percent, quantity, ratio } from "../units.js";
import { Curve, valueAt } from "./curves.js";
import { Recorder } from "./recorder.js";
import { compassSvg, scaleBar, scaleSvg, viewText } from "./scale.js";
import { planeText } from "../view/section.js";
import { legendHtml } from "./legend.js";
import { blockCells, cellText, cellTip, mapText } from "./map.js";
import { pathHtml } from "./path.js";
import { blockText, flowTip, interfaceText, runText } from "./selection.js";
import { readAddress } from "./address.js";
import { close, escape } from "./words.js";

const element = (id) => document.getElementById(id);
const colourKeys = { 1: "displacement", 2: "velocity", 3: "rotation", 4: "role", 5: "factor" };
const mapKeys = { 1: "probability", 2: "volume" };
const layerKeys = { w: "water", f: "forces", j: "joints", e: "edges", b: "fixed", y: "paths" };
const viewKeys = { o: "iso", s: "front", t: "toe", p: "top" };
const kClickPixels = 5; // farther is a drag
const kPanelPerSecond = 8; // rewrites of the panel's text while playing

export class Controls {
  constructor(replay) {
    this.replay = replay;
    this.canvas = element("scene");
    this.darkQuery = matchMedia("(prefers-color-scheme: dark)");
    replay.map ? this.describeMap() : this.describeRun();
    for (const place of document.querySelectorAll("[data-rule]")) place.textContent = percent(rule[place.dataset.rule]);
    this.connectTransport();
    this.connectPanel();
    this.film = new Recorder(replay, element("picture"), element("film"));
    this.connectPointer();
    this.makeCurves();
    element("curves").hidden = replay.header.failure?.analysis.startsWith("limit-analysis"); // no forces drive a mechanism
    addEventListener("keydown", (event) => this.onKey(event));
    new ResizeObserver(() => this.resize()).observe(element("stage"));
    new ResizeObserver(() => this.prepareCurves()).observe(element("curves"));
    this.darkQuery.addEventListener("change", () => (this.prepareCurves(), replay.invalidate("look")));
    if (matchMedia("(max-width: 820px)").matches) this.showPanel(false);
    this.resize();
  }

  dark() {
    return this.darkQuery.matches;
  }

  /** Colour of the blocks' edges: fainter on ghosts and where there are very many. */
  edgeInk(opacity) {
    const many = this.replay.header.names.length > 3000 ? 0.6 : 1;
    return [0.1, 0.12, 0.15, (opacity < 1 ? 0.28 : 0.55) * many];
  }

  describeRun() {
    const { header, file, frames } = this.replay;
    const name = header.scenarioPath.split("/").at(-1) || "run";
    document.title = `${name} – Talus replay`;
    element("title").textContent = name;
    const motion = this.replay.motionText;
    element("facts").textContent = `${header.names.length} blocks · tilt ${angle(frames[0].tilt, 4)} · ` +
      `${quantity(frames.at(-1).time, "s")} · ${motion}` + (file.end?.get("ended") === "finished" ? "" : " · run not finished");
    element("search").innerHTML = pathHtml(header.failure);
    element("run").innerHTML = runText(file, motion);
    element("water").disabled = header.waters.length === 0 && !header.phreaticX?.length;
    element("joint-colours").hidden = !header.flow;
  }

  /** A map has no time and no forces: what shows them is not there. */
  describeMap() {
    const { header, map } = this.replay;
    document.body.classList.add("map");
    document.title = map.title;
    element("title").textContent = map.title;
    element("facts").textContent = map.lead;
    element("run").innerHTML = mapText(map, header);
    for (const id of ["water", "forces", "joints", "paths"]) element(id).disabled = true;
  }

  connectTransport() {
    const player = this.replay.player;
    const on = (id, act) => element(id).addEventListener("click", act);
    on("play", () => player.toggle());
    on("back", () => player.step(-1));
    on("forward", () => player.step(1));
    on("to-start", () => player.seek(player.first));
    on("to-end", () => player.seek(player.last));
    const speed = element("speed");
    speed.innerHTML = speeds.map((s, k) => `<option value="${k}">${s < 1 ? `1/${Math.round(1 / s)}` : s} ×</option>`).join("");
    speed.addEventListener("change", () => ((player.speed = speeds[speed.value]), this.replay.invalidate("time")));
    element("loop").addEventListener("change", (event) => (player.loop = event.target.checked));
    const timeline = element("timeline");
    timeline.min = player.first, (timeline.max = player.last);
    timeline.addEventListener("input", () => {
      player.playing = false;
      player.seek(Number(timeline.value));
    });
  }

  connectPanel() {
    const { look } = this.replay;
    const change = (id, act) => element(id).addEventListener("input", (event) => (act(event.target), this.replay.invalidate("look")));
    change("colours", (target) => (look.colouring = target.value));
    change("map-colours", (target) => (look.colouring = target.value));
    change("joint-colours", (target) => (look.jointColouring = target.value));
    change("own-scale", (target) => (look.ownScale = target.checked));
    for (const layer of Object.values(layerKeys)) change(layer, (target) => (look[layer] = target.checked));
    change("exaggeration", (target) => (look.exaggeration = 10 ** Number(target.value)));
    change("opacity", (target) => (look.opacity = Number(target.value)));
    change("section", (target) => (look.section.axis = target.value));
    change("section-share", (target) => (look.section.share = Number(target.value)));
    change("section-flip", (target) => (look.section.flipped = target.checked));
    change("arrow-size", (target) => (look.arrowSize = 10 ** Number(target.value)));
    for (const button of document.querySelectorAll("[data-view]"))
      button.addEventListener("click", () => this.replay.home(button.dataset.view));
    element("panel-button").addEventListener("click", () => this.showPanel(element("panel").hidden));
    element("help-button").addEventListener("click", () => this.help());
    element("selection").addEventListener("click", (event) => {
      const { block, interface: face, close } = event.target.dataset;
      if (block !== undefined) this.replay.select(Number(block));
      if (face !== undefined) this.replay.selectInterface(Number(face));
      if (close !== undefined) this.replay.select(-1);
    });
  }

  help() {
    const help = element("help");
    help.open ? help.close() : help.showModal();
  }

  showPanel(shown) {
    element("panel").hidden = !shown;
    element("panel-button").setAttribute("aria-expanded", shown);
  }

  connectPointer() {
    let down = null;
    const place = (event) => {
      const box = this.canvas.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    this.canvas.addEventListener("pointerdown", (event) => (down = place(event)));
    this.canvas.addEventListener("pointerup", (event) => {
      const [x, y] = place(event);
      if (event.button !== 0 || !down || Math.hypot(x - down[0], y - down[1]) > kClickPixels) return;
      this.replay.pick(x, y);
      if (Object.values(this.replay.selected).some((number) => number >= 0)) this.showPanel(true);
    });
    this.canvas.addEventListener("pointermove", (event) => {
      if (event.buttons || event.pointerType === "touch" || this.hovering) return;
      this.hovering = requestAnimationFrame(() => ((this.hovering = 0), this.showTip(...place(event))));
    });
    this.canvas.addEventListener("pointerleave", () => this.showTip(-1, -1));
  }

  showTip(x, y) {
    const block = x < 0 || !this.replay.now ? -1 : this.replay.hover(x, y);
    const tip = element("tip");
    const text = x < 0 || !this.replay.now ? "" : this.tipText(block);
    tip.hidden = !text;
    if (!text) return;
    tip.textContent = text;
    const room = element("stage").clientWidth - tip.offsetWidth - 4; // it does not leave the scene
    tip.style.left = `${Math.max(0, Math.min(x + 14, room))}px`, (tip.style.top = `${y + 10}px`);
  }

  /** What is under the pointer; "" for nothing. */
  tipText(block) {
    const { header, map, under } = this.replay;
    if (under.flow) return flowTip(header, under.flow);
    if (under.cell >= 0) return cellTip(map, under.cell);
    return block >= 0 ? header.names[block] : "";
  }

  makeCurves() {
    const { frames, player } = this.replay;
    const times = frames.map((frame) => frame.time);
    const series = (name, colour, key) => ({ name, colour, values: frames.map((frame) => frame[key]), shown: true });
    const onSeek = (time) => ((player.playing = false), player.seek(time));
    const energies = [series("kinetic", "--kinetic", "kinetic"), series("elastic", "--elastic", "elastic"), series("gravity", "--potential", "gravity")];
    this.energy = new Curve(element("energy"), times, energies, { unit: "J", onSeek });
    this.balance = new Curve(element("balance"), times, [series("unbalanced force / weight", "--balance", "outOfBalance")], { log: true, onSeek });
    element("energy-key").innerHTML = "Energy " + energies.map((one, k) =>
      `<button data-series="${k}" aria-pressed="true" title="Show or hide"><i style="background:var(${one.colour})"></i>${one.name} <span></span></button>`).join("");
    element("balance-key").innerHTML = `<span><i style="background:var(--balance)"></i>Unbalanced force over weight <span class="value"></span></span>`;
    element("energy-key").addEventListener("click", (event) => {
      const button = event.target.closest("[data-series]");
      if (!button) return;
      const one = energies[button.dataset.series];
      one.shown = !one.shown;
      button.setAttribute("aria-pressed", one.shown);
      this.prepareCurves();
    });
    this.markFulls();
  }

  /** Marks above the time line where contacts are known. */
  markFulls() {
    const { player, file } = this.replay;
    const marks = file.fullTimes.length <= 400 ? file.fullTimes : [];
    const span = player.last - player.first || 1;
    const at = (ns) => ((Number(ns) / 1e9 - player.first) / span) * 1000;
    const svg = `<svg id="marks" viewBox="0 0 1000 6" preserveAspectRatio="none" aria-hidden="true"><path d="${marks
      .map((ns) => `M${at(ns).toFixed(2)} 0V6`).join("")}" stroke="currentColor" stroke-width="1.5" vector-effect="non-scaling-stroke"/></svg>`;
    element("scrubber").insertAdjacentHTML("afterbegin", svg);
  }

  prepareCurves() {
    if (element("curves").clientWidth === 0) return;
    this.energy.prepare(), this.balance.prepare();
    this.replay.invalidate("time");
  }

  resize() {
    const { clientWidth, clientHeight } = element("stage");
    this.replay.stage.resize(clientWidth, clientHeight);
    this.replay.invalidate("framing");
  }

  /** Rectangles of the scene that something stands over. */
  overlays() {
    const stage = element("stage").getBoundingClientRect();
    return ["legend", "orientation", "scale"].map((id) => element(id).getBoundingClientRect()).filter((box) => box.width > 0)
      .map((box) => ({ left: box.left - stage.left, right: box.right - stage.left, top: box.top - stage.top, bottom: box.bottom - stage.top }));
  }

  onKey(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || element("help").open) return;
    const typing = event.target.matches?.("select, input[type=text]");
    const onButton = event.key === " " && event.target.matches?.("button, input[type=checkbox], input[type=radio], summary");
    const onSlider = event.key.startsWith("Arrow") && event.target.matches?.("input[type=radio], input[type=range]:not(#timeline)");
    if (typing || onButton || onSlider) return;
    if (this.act(event)) event.preventDefault();
  }

  /** True when the key means something. */
  act({ key, shiftKey }) {
    const { replay } = this, { player, look } = replay;
    const letter = key.toLowerCase();
    const press = (id) => (element(id).click(), true);
    const actions = {
      " ": () => player.toggle(),
      ArrowLeft: () => player.step(shiftKey ? -10 : -1),
      ArrowRight: () => player.step(shiftKey ? 10 : 1),
      Home: () => player.seek(player.first),
      End: () => player.seek(player.last),
      "[": () => player.faster(-1),
      "]": () => player.faster(1),
      "?": () => this.help(),
      h: () => this.help(),
      Escape: () => replay.select(-1),
      l: () => press("loop"),
      c: () => this.nextSection(),
      r: () => replay.home(replay.view),
      "+": () => this.exaggerate(look.exaggeration * 10 ** 0.25),
      "=": () => this.exaggerate(look.exaggeration * 10 ** 0.25),
      "-": () => this.exaggerate(look.exaggeration / 10 ** 0.25),
      0: () => this.exaggerate(1),
      u: () => this.toggleFlow(),
    };
    const action = actions[key] ?? actions[letter];
    if (action) return action(), true;
    if (replay.map && colourKeys[key]) return (look.colouring = mapKeys[key] ?? look.colouring), replay.invalidate("look"), true;
    if (colourKeys[key] === "factor" && replay.groups.length === 0) return false;
    if (colourKeys[key]) return (look.colouring = colourKeys[key]), replay.invalidate("look"), true;
    if (layerKeys[letter]) return element(layerKeys[letter]).disabled || press(layerKeys[letter]);
    if (viewKeys[letter]) return replay.home(viewKeys[letter]), true;
    return false;
  }

  /** Joints by water pressure, or no joints. */
  toggleFlow() {
    const { look, header } = this.replay;
    if (!header.flow || this.replay.map) return;
    look.joints = !this.replay.showsFlow();
    look.jointColouring = "pressure";
    this.replay.invalidate("look");
  }

  nextSection() {
    const { section } = this.replay.look, axes = ["", "x", "y", "z"];
    section.axis = axes[(axes.indexOf(section.axis) + 1) % axes.length];
    this.replay.invalidate("look");
  }

  exaggerate(times) {
    this.replay.look.exaggeration = Math.min(1e4, Math.max(1, times));
    this.replay.invalidate("look");
  }

  update(dirty) {
    const { replay } = this, { look, player } = replay;
    if (["all", "look", "time", "full", "selection"].some((what) => dirty.has(what))) {
      this.updateTime();
      this.updateLook(dirty);
      this.updateSelection(dirty);
    }
    const axes = replay.stage.axes(replay.now.a.tilt);
    element("axes").innerHTML = compassSvg(replay.stage.compass(), axes);
    element("view-text").textContent = viewText(replay.stage.direction());
    element("scale").innerHTML = scaleSvg(scaleBar(replay.stage.metresPerPixel(), element("stage").clientWidth));
    this.updateLabels(look.water);
    element("play").classList.toggle("playing", player.playing);
    element("play").setAttribute("aria-label", player.playing ? "Pause" : "Play");
  }

  updateTime() {
    const { player, frames, now } = this.replay;
    element("timeline").value = player.time;
    element("timeline").setAttribute("aria-valuetext", quantity(player.time, "s"));
    const shown = now.share > 0.5 ? now.index + 1 : now.index;
    element("clock").innerHTML = `<b>t = ${quantity(player.time, "s")}</b><span class="long"> of ${quantity(player.last, "s")} · frame ${shown} of ${frames.length - 1} · ` +
      `tilt ${angle(now.a.tilt, 4)}</span>`;
    element("speed").value = speeds.indexOf(player.speed);
    if (element("curves").hidden) return;
    const { times, series } = this.energy;
    element("energy-key").querySelectorAll("button span").forEach((span, k) => {
      span.textContent = quantity(valueAt(times, series[k].values, player.time), "J", 3);
    });
    element("balance-key").querySelector(".value").textContent = ratio(valueAt(times, this.balance.series[0].values, player.time));
    this.energy.draw(player.time), this.balance.draw(player.time);
  }

  updateLook(dirty) {
    const { replay } = this, { look } = replay;
    document.querySelector(`[value=${look.colouring}]`).checked = true;
    document.querySelector(`[value=${look.jointColouring}]`).checked = true;
    for (const layer of Object.values(layerKeys)) element(layer).checked = look[layer];
    element("own-scale").checked = look.ownScale;
    element("scale-row").hidden = look.colouring === "role" || look.colouring === "factor";
    element("factor-row").hidden = replay.groups.length === 0;
    element("exaggeration").value = Math.log10(look.exaggeration);
    element("exaggeration-value").textContent = `× ${Number(look.exaggeration.toPrecision(3))}`;
    element("opacity").value = look.opacity;
    const whole = (share) => `${Math.round(share * 100)} %`, drawn = replay.rockOpacity();
    element("opacity-value").textContent =
      whole(look.opacity) + (drawn < look.opacity ? `, ${whole(drawn)} with ${look.joints ? "joints" : "forces"}` : "");
    element("section").value = look.section.axis, (element("section-share").value = look.section.share);
    element("section-flip").checked = look.section.flipped;
    element("section-share").disabled = element("section-flip").disabled = !replay.plane;
    element("section-value").textContent = replay.plane ? planeText(replay.plane, look.section.axis, (at) => quantity(at, "m", 3)) : "none";
    const arrows = !replay.map && (look.forces || replay.selected.block >= 0);
    element("arrow-row").hidden = !arrows;
    element("arrow-size-value").textContent = `× ${Number(look.arrowSize.toPrecision(2))}`;
    const flow = replay.showsFlow() ? { most: replay.flow.most, acts: replay.full?.loads.waterShare !== 0 } : null;
    const html = legendHtml({ map: replay.map, flow,
      colouring: look.colouring, range: replay.range, ownScale: look.ownScale, roles: look.colouring === "role" ? replay.roles : [], groups: replay.groups, joints: look.joints && !flow,
      forces: arrows, reference: replay.arrows.reference, arrowPixels: this.arrowPixels(), fullTime: replay.full?.time ?? null, time: replay.player.time,
      exaggeration: look.exaggeration, selected: replay.selected.block >= 0,
      supports: replay.supports.supports.length > 0,
    });
    if (html === this.legendShown) return;
    const legend = element("legend"), { offsetWidth: width, offsetHeight: height } = legend;
    legend.innerHTML = this.legendShown = html;
    // A click that selects must not shift what was clicked.
    if (dirty.has("look") && (legend.offsetWidth > width || legend.offsetHeight > height)) replay.invalidate("framing");
  }

  /** Length of the legend's arrow at the middle of the view. */
  arrowPixels() {
    const { stage, arrows } = this.replay;
    const metres = arrows.reference * arrows.uniforms.metresPerNewton.value;
    return Math.min(160, Math.max(14, Math.round(metres / stage.metresPerPixel())));
  }

  updateSelection(dirty) {
    const { replay } = this, { selected } = replay;
    const since = performance.now() - (this.selectionAt ?? 0);
    if (replay.player.playing && !dirty.has("selection") && since < 1000 / kPanelPerSecond) return;
    this.selectionAt = performance.now();
    const context = { header: replay.header, full: replay.full, frames: replay.now };
    const html = replay.map ? this.mapSelection() : selected.block >= 0 ? blockText({ ...context, radius: replay.radius, roles: replay.roles, block: selected.block, ...replay.historyOf(selected.block) })
      : selected.interface >= 0 && replay.full ? interfaceText({ ...context, i: selected.interface })
      : `<p class="note">Click a block, or with <em>Joints</em> shown a joint, to see its numbers and why it fails or is stable.</p>`;
    if (html !== this.selectionShown) element("selection").innerHTML = this.selectionShown = html;
  }

  mapSelection() {
    const { map, selected, header } = this.replay;
    const name = header.names[selected.block], of_block = () => this.replay.cellsOn(selected.block);
    if (selected.cell >= 0) return cellText(map, selected.cell) + (selected.block >= 0 ? `<h3>Block ${escape(name)}</h3>` + blockCells(map, of_block()) : "");
    if (selected.block >= 0) return `<h2><span>Block ${escape(name)}</span>${close}</h2>` + blockCells(map, of_block());
    return `<p class="note">Click a cell to see its numbers.</p>`;
  }

  updateLabels(shown) {
    const labels = shown ? this.replay.water.labels : [];
    const html = labels.map((label) => {
      const at = this.replay.isCutAway(label.block, label.offset) ? null : this.replay.screenOfPoint(label.block, label.offset);
      return at ? `<span style="left:${at.x.toFixed(0)}px;top:${at.y.toFixed(0)}px">${label.text}</span>` : "";
    }).join("");
    if (html !== this.labelsShown) element("labels").innerHTML = this.labelsShown = html;
  }

  readAddress() {
    readAddress(this.replay, location.hash);
  }
}
