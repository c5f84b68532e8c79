// Pictures a second of a replay page while it plays and turns, in headless Chromium (software rendering):
// `node speed.mjs PAGE.html CHROMIUM [SECONDS]`.

import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const [path, executablePath, seconds = "10"] = process.argv.slice(2);
const browser = await chromium.launch({ executablePath, args: ["--no-sandbox", "--enable-unsafe-swiftshader"] });
const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
const begin = Date.now();
await page.goto(pathToFileURL(path).href);
await page.waitForFunction(() => document.documentElement.dataset.state === "ready", null, { timeout: 300000 });
const loaded = (Date.now() - begin) / 1000;
const found = await page.evaluate(async (limit) => {
  const { replay } = window;
  replay.player.loop = true;
  replay.player.play();
  // What a picture costs the page itself: the work of its script, without the drawing.
  const draw = replay.draw.bind(replay);
  let script = 0;
  replay.draw = () => { const t = performance.now(); draw(); script += performance.now() - t; };
  const first = replay.pictures, start = performance.now();
  while (performance.now() - start < limit * 1000) await new Promise((next) => requestAnimationFrame(next));
  const pictures = replay.pictures - first;
  const gl = replay.stage.renderer.getContext();
  gl.finish();
  return { blocks: replay.header.names.length, frames: replay.frames.length, triangles: replay.stage.renderer.info.render.triangles,
    pictures_per_second: pictures / ((performance.now() - start) / 1000), script_ms_per_picture: script / pictures };
}, Number(seconds));
console.log(JSON.stringify({ loaded_s: loaded, ...found }, null, 1));
await browser.close();
