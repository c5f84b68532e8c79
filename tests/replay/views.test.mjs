// What the replay page shows first, and what helps to look at it: view, section, ways, scale, pictures and films.
// `node views.test.mjs PAGE.html CHROMIUM WORD`: WORD is how the page has to call the motion; exit code 0 when all holds.

import { deepEqual, equal, ok } from "node:assert/strict";
import { readFileSync } from "node:fs";
import { drawn, end, open, test } from "./opened.mjs";

const word = process.argv[4];
const text = (page, selector) => page.locator(selector).innerText();

await test("it opens on what moves, and says how that moves", async () => {
  const page = await open();
  const { places, width, height } = await page.evaluate(() => {
    const { replay } = window, { header, frames, moving } = replay;
    const at = (frame, b) => ["x", "y", "z"].map((k) => header.centroid[k][b] + frame.displacement[k][b]);
    const places = moving.flatMap((b) => [frames[0], frames.at(-1)].map((frame) => replay.stage.screenOf(at(frame, b))));
    const { clientWidth: width, clientHeight: height } = document.getElementById("stage");
    return { places, width, height };
  });
  ok(places.length > 0);
  for (const { x, y } of places) ok(x > 0 && x < width && y > 0 && y < height, `${x} ${y} in ${width} x ${height}`);
  const spread = Math.max(...["x", "y"].map((k) => Math.max(...places.map((p) => p[k])) - Math.min(...places.map((p) => p[k]))));
  ok(spread > 0.2 * Math.min(width, height), `they fill the view: ${spread} px`);
  ok((await text(page, "#facts")).includes(word), await text(page, "#facts"));
  await page.context().close();
});

await test("scale and compass stand beside it and are right", async () => {
  const page = await open("#view=front");
  const bar = await page.evaluate(() => {
    const { replay } = window, { target } = replay.stage.controls;
    const seen = [0, 1].map((x) => target.clone().setX(target.x + x).project(replay.stage.camera).x);
    const perMetre = ((seen[1] - seen[0]) / 2) * document.getElementById("stage").clientWidth;
    const svg = document.querySelector("#scale svg");
    const [value, unit] = svg.textContent.split(/\s/);
    return { perMetre, pixels: svg.querySelector("path").getBBox().width, metres: Number(value) * { m: 1, mm: 1e-3, km: 1e3, cm: 0.01 }[unit] };
  });
  ok(Math.abs(bar.pixels / (bar.metres * bar.perMetre) - 1) < 0.03, JSON.stringify(bar));
  ok(/^to 0(00|01)°|^to 3(59|60)°/.test(await text(page, "#view-text")), await text(page, "#view-text"));
  ok((await page.locator("#axes").textContent()).includes("N"));
  await page.context().close();
});

await test("a section takes away what is before it; fixed blocks and ways can be shown or not", async () => {
  const page = await open("#t=end&view=front");
  const inked = () => page.evaluate(() => {
    const { renderer } = window.replay.stage, gl = renderer.getContext();
    window.replay.stage.render();
    const [w, h] = [renderer.domElement.width, renderer.domElement.height], pixels = new Uint8Array(4 * w * h);
    gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    let count = 0, red = 0;
    for (let k = 0; k < pixels.length; k += 4) {
      count += pixels[k + 3] > 0;
      red += pixels[k] > pixels[k + 1] + 60 && pixels[k] > pixels[k + 2] + 40;
    }
    return { count, red };
  });
  const whole = await inked();
  await page.keyboard.press("b");
  await drawn(page);
  const free = await inked();
  ok(free.count > 0 && free.count < whole.count, `${free.count} without fixed blocks, ${whole.count} with them`);
  await page.keyboard.press("b");
  await page.selectOption("#section", "x");
  await drawn(page);
  const half = await inked();
  ok(half.count < 0.95 * whole.count, `${half.count} of ${whole.count} behind the section`);
  ok(/^x = /.test(await text(page, "#section-value")));
  await page.locator("#section-share").evaluate((slider) => ((slider.value = 1), slider.dispatchEvent(new Event("input", { bubbles: true }))));
  await drawn(page);
  ok((await inked()).count < 0.05 * whole.count, "all is cut away at the far end");
  equal(await page.evaluate(() => {
    const { clientWidth, clientHeight } = document.getElementById("stage");
    return window.replay.hover(clientWidth / 2, clientHeight / 2);
  }), -1, "what is cut away cannot be picked");
  await page.selectOption("#section", "");
  await page.keyboard.press("y");
  await drawn(page);
  const range = await page.evaluate(() => window.replay.paths.geometry.drawRange.count);
  ok(range > 0, "ways up to the end");
  await page.keyboard.press("Home");
  await drawn(page);
  equal(await page.evaluate(() => window.replay.paths.geometry.drawRange.count), 0);
  await page.context().close();
});

await test("between full states contacts are said to be the last known", async () => {
  const page = await open("#joints&t=0");
  await page.evaluate(() => window.replay.player.seek(window.replay.frames[3].time));
  await drawn(page);
  ok((await text(page, "#legend")).includes("last known"), await text(page, "#legend"));
  ok((await text(page, "#opacity-value")).startsWith("100 %"), "the slider's own number");
  await page.context().close();
});

await test("pictures and films are saved", async () => {
  const page = await open("#t=0.1");
  const saved = async (button) => {
    const [file] = await Promise.all([page.waitForEvent("download"), page.click(button)]);
    return readFileSync(await file.path());
  };
  const png = await saved("#picture");
  equal(png.subarray(1, 4).toString(), "PNG");
  ok(png.length > 10_000, `${png.length} bytes`);
  await page.evaluate(() => (window.replay.player.speed = 0.5 * (window.replay.player.last - window.replay.player.first)));
  const webm = await saved("#film");
  deepEqual([...webm.subarray(0, 4)], [0x1a, 0x45, 0xdf, 0xa3], "EBML");
  ok(webm.length > 5_000, `${webm.length} bytes`);
  equal(await page.evaluate(() => window.replay.player.time === window.replay.player.last), true);
  await page.context().close();
});

await end();
