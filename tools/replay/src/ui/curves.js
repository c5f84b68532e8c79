// Curves under the time line, on plain canvases: energies on a linear axis, the unbalanced force on a logarithmic one.

import { quantity, ticks } from "../units.js";

const kLeft = 58, kRight = 8, kTop = 5, kBottom = 16; // pixels around the plot
const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

/** Values at time t, straight between frames. */
export function valueAt(times, values, t) {
  let high = times.findIndex((time) => time >= t);
  if (high < 0) high = times.length - 1;
  const low = Math.max(0, high - 1), span = times[high] - times[low];
  return span > 0 ? values[low] + ((t - times[low]) / span) * (values[high] - values[low]) : values[high];
}

export class Curve {
  /** series: [{values, colour (a CSS variable), shown}]; `log` for a logarithmic axis; `unit` behind the ticks. */
  constructor(canvas, times, series, { log = false, unit = "", onSeek }) {
    Object.assign(this, { canvas, times, series, log, unit });
    const seek = (event) => {
      if (event.type === "pointermove" && !(event.buttons & 1)) return;
      if (event.type === "pointerdown") canvas.setPointerCapture(event.pointerId);
      const { left, width } = canvas.getBoundingClientRect();
      const share = (event.clientX - left - kLeft) / (width - kLeft - kRight);
      onSeek(times[0] + Math.min(1, Math.max(0, share)) * (times.at(-1) - times[0]));
    };
    canvas.addEventListener("pointerdown", seek);
    canvas.addEventListener("pointermove", seek);
  }

  range() {
    let low = this.log ? Infinity : 0, high = this.log ? 1e-12 : 0;
    for (const { values } of this.series.filter((s) => s.shown)) {
      for (const value of values) {
        if (!Number.isFinite(value) || (this.log && !(value > 0))) continue;
        low = Math.min(low, value), (high = Math.max(high, value));
      }
    }
    if (!this.log) return high > low ? [low, high] : [0, 1];
    const least = Math.floor(Math.log10(Math.max(Math.min(low, high), high * 1e-8)));
    return [least, Math.max(Math.ceil(Math.log10(high)), least + 1)];
  }

  /** Draws everything but the cursor into a buffer; call when size, theme or what is shown has changed. */
  prepare() {
    const ratio = window.devicePixelRatio || 1;
    const { clientWidth: width, clientHeight: height } = this.canvas;
    this.canvas.width = width * ratio, (this.canvas.height = height * ratio);
    this.still = document.createElement("canvas");
    this.still.width = this.canvas.width, (this.still.height = this.canvas.height);
    const pen = this.still.getContext("2d");
    pen.scale(ratio, ratio);
    const [low, high] = this.range();
    const span = this.times.at(-1) - this.times[0] || 1;
    this.x = (t) => kLeft + ((t - this.times[0]) / span) * (width - kLeft - kRight);
    const y = (v) => kTop + (1 - (v - low) / (high - low)) * (height - kTop - kBottom);
    this.drawGrid(pen, width, height, low, high, y);
    for (const one of this.series.filter((s) => s.shown)) this.drawLine(pen, one, low, y);
  }

  drawGrid(pen, width, height, low, high, y) {
    pen.font = "11px system-ui, sans-serif";
    pen.fillStyle = css("--muted"), (pen.strokeStyle = css("--line"));
    pen.lineWidth = 1;
    pen.textBaseline = "middle", (pen.textAlign = "right");
    const count = Math.max(3, Math.floor((height - kTop - kBottom) / 18));
    const values = this.log ? ticks(low, high, count).filter(Number.isInteger) : ticks(low, high, count);
    for (const value of values) {
      pen.beginPath(), pen.moveTo(kLeft, y(value)), pen.lineTo(width - kRight, y(value)), pen.stroke();
      const text = this.log ? (value === 0 ? "1" : `10${superscript(value)}`) : quantity(value, this.unit, 2);
      pen.fillText(text, kLeft - 5, y(value));
    }
    pen.textBaseline = "top", (pen.textAlign = "center");
    for (const t of ticks(this.times[0], this.times.at(-1), Math.max(2, Math.floor(width / 110)))) {
      const x = Math.min(Math.max(this.x(t), kLeft + 8), width - kRight - 16);
      pen.fillText(quantity(t, "s", 3), x, height - kBottom + 4);
    }
  }

  drawLine(pen, one, low, y) {
    pen.strokeStyle = css(one.colour);
    pen.lineWidth = 1.6, (pen.lineJoin = "round");
    pen.beginPath();
    let up = true;
    one.values.forEach((value, k) => {
      if (this.log && !(value > 0)) return (up = true);
      const at = this.log ? Math.max(Math.log10(value), low) : value;
      up ? pen.moveTo(this.x(this.times[k]), y(at)) : pen.lineTo(this.x(this.times[k]), y(at));
      up = false;
    });
    pen.stroke();
  }

  draw(time) {
    if (!this.still) return;
    const pen = this.canvas.getContext("2d"), ratio = window.devicePixelRatio || 1;
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.clearRect(0, 0, this.canvas.width, this.canvas.height);
    pen.drawImage(this.still, 0, 0);
    pen.scale(ratio, ratio);
    pen.strokeStyle = css("--accent"), (pen.lineWidth = 1.5);
    pen.beginPath(), pen.moveTo(this.x(time), 0), pen.lineTo(this.x(time), this.canvas.clientHeight - kBottom + 2), pen.stroke();
    const [low, high] = this.range(), height = this.canvas.clientHeight;
    for (const one of this.series.filter((s) => s.shown)) {
      const value = valueAt(this.times, one.values, time);
      const at = this.log ? Math.log10(Math.max(value, 10 ** low)) : value;
      pen.fillStyle = css(one.colour);
      pen.beginPath();
      pen.arc(this.x(time), kTop + (1 - (at - low) / (high - low)) * (height - kTop - kBottom), 3, 0, 7);
      pen.fill();
    }
  }
}

const superscript = (k) => String(k).replace(/./g, (c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[c]));
