// Pictures and films of the scene, with captions: name and time, colours, scale, compass. Both are made in the page; a
// film is recorded by the browser while the run plays.

import { gradientStops } from "../view/colours.js";

const kFont = "system-ui, sans-serif", kRate = 30; // pictures a second
const kTypes = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm"];

/** Hands a file to the user. */
function download(blob, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob), (link.download = name);
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}

/** Draws the lines and letters of a small SVG as the page shows them, its origin at (x, y). */
function drawSvg(pen, svg, x, y) {
  pen.save();
  pen.translate(x, y);
  for (const shape of svg.querySelectorAll("path, circle, text")) {
    const style = getComputedStyle(shape), number = (name) => Number(shape.getAttribute(name));
    pen.globalAlpha = Number(getComputedStyle(shape.parentElement).opacity);
    if (shape.tagName === "text") {
      Object.assign(pen, { font: `${style.fontWeight} 12px ${kFont}`, textAlign: "center", fillStyle: style.fill });
      pen.fillText(shape.textContent, number("x"), number("y"));
      continue;
    }
    const line = new Path2D(shape.getAttribute("d") ?? "");
    if (shape.tagName === "circle") line.arc(number("cx"), number("cy"), number("r"), 0, 2 * Math.PI);
    if (style.fill !== "none") pen.fillStyle = style.fill, pen.fill(line);
    if (style.stroke === "none") continue;
    Object.assign(pen, { strokeStyle: style.stroke, lineWidth: parseFloat(style.strokeWidth) });
    pen.setLineDash(style.strokeDasharray === "none" ? [] : style.strokeDasharray.split(/[ ,]+/).map(parseFloat));
    pen.stroke(line);
  }
  pen.restore();
}

/** Draws the scene as it was just rendered, and its captions, into a canvas of the same size. */
export function compose(canvas, scene, { dark, ratio, title, lines, colours, scale, compass }) {
  canvas.width = scene.width & ~1, (canvas.height = scene.height & ~1); // films want even sizes
  const pen = canvas.getContext("2d"), { width, height } = canvas;
  const sky = pen.createLinearGradient(0, 0, 0, height);
  (dark ? ["#2a3036", "#171a1d"] : ["#fbfcfd", "#e3e8ec"]).forEach((tone, k) => sky.addColorStop(k, tone));
  pen.fillStyle = sky, pen.fillRect(0, 0, width, height);
  pen.drawImage(scene, 0, 0);
  pen.scale(ratio, ratio);
  const ink = dark ? "#e8ebee" : "#1b2026", bottom = height / ratio, right = width / ratio;
  const write = (text, x, y, font = "13px", align = "left") =>
    Object.assign(pen, { font: `${font} ${kFont}`, textAlign: align, fillStyle: ink }).fillText(text, x, y);
  write(title, 14, 26, "600 15px");
  lines.forEach((line, k) => write(line, 14, 46 + 18 * k));
  if (colours.scale) {
    const bar = pen.createLinearGradient(14, 0, 214, 0), stops = gradientStops(colours.scale);
    stops.forEach((tone, k) => bar.addColorStop(k / (stops.length - 1), tone));
    write(colours.title, 14, bottom - 46);
    pen.fillStyle = bar, pen.fillRect(14, bottom - 38, 200, 10);
    write("0", 14, bottom - 14), write(colours.most, 214, bottom - 14, "13px", "right");
  }
  colours.items?.forEach(([tone, text], k) => {
    pen.fillStyle = tone, pen.fillRect(14 + 90 * k, bottom - 26, 12, 12);
    write(text, 31 + 90 * k, bottom - 15);
  });
  const from = right - 16 - scale.pixels;
  Object.assign(pen, { strokeStyle: ink, lineWidth: 1.5 });
  pen.beginPath(), pen.moveTo(from, bottom - 22), pen.lineTo(from, bottom - 16), pen.lineTo(right - 16, bottom - 16);
  pen.lineTo(right - 16, bottom - 22), pen.stroke();
  write(scale.text, (from + right - 16) / 2, bottom - 26, "13px", "center");
  drawSvg(pen, compass.svg, right - 70, 64);
  write(compass.text, right - 70, 130, "12px", "center");
}

export function savePicture(canvas, name) {
  return new Promise((resolve) => canvas.toBlob((blob) => (download(blob, `${name}.png`), resolve(blob)), "image/png"));
}

export const canFilm = () =>
  typeof MediaRecorder !== "undefined" && !!HTMLCanvasElement.prototype.captureStream && kTypes.some((type) => MediaRecorder.isTypeSupported(type));

/** A film in the making: `canvas` is drawn anew for every picture; `finish` hands the file over. */
export class Film {
  constructor(canvas, name) {
    this.name = name;
    this.pieces = [];
    this.recorder = new MediaRecorder(canvas.captureStream(kRate), {
      mimeType: kTypes.find((type) => MediaRecorder.isTypeSupported(type)), videoBitsPerSecond: 8_000_000,
    });
    this.recorder.ondataavailable = ({ data }) => data.size && this.pieces.push(data);
    this.done = new Promise((resolve) => (this.recorder.onstop = () => {
      const film = new Blob(this.pieces, { type: "video/webm" });
      download(film, `${this.name}.webm`);
      resolve(film);
    }));
    this.recorder.start(500);
  }

  finish() {
    if (this.recorder.state !== "inactive") this.recorder.stop();
    return this.done;
  }
}
