// The page of talus replay in headless Chromium, as a user has it: opened from the disk, without a network.
// `node page.test.mjs PAGE.html CHROMIUM [SCREENSHOT_FOLDER]`; exit code 0 when all holds.

import { deepEqual, equal, notEqual, ok } from "node:assert/strict";
import { end, open as openPage, test } from "./opened.mjs";

const shots = process.argv[4];

/** Opens the page at a moment. */
async function open(hash = "", viewport = { width: 1200, height: 800 }) {
  const page = await openPage(hash, viewport);
  await settled(page);
  return page;
}

/** Waits until everything that is to be drawn has been drawn. */
const settled = (page) =>
  page.waitForFunction(() => window.replay.dirty.size === 0 && (window.stillSince = (window.stillSince ?? 0) + 1) > 3, null, { polling: 100 })
    .then(() => page.evaluate(() => void (window.stillSince = 0)));

/** Shares of the scene's pixels by what they look like. */
async function colours(page, name) {
  const picture = await page.locator("#stage").screenshot(shots ? { path: `${shots}/${name}.png` } : {});
  return page.evaluate(async (base64) => {
    const image = new Image();
    image.src = `data:image/png;base64,${base64}`;
    await image.decode();
    const canvas = new OffscreenCanvas(image.width, image.height), pen = canvas.getContext("2d");
    pen.drawImage(image, 0, 0);
    const { data } = pen.getImageData(0, 0, image.width, image.height);
    const count = { blue: 0, warm: 0, purple: 0, red: 0 }, pixels = data.length / 4;
    for (let k = 0; k < data.length; k += 4) {
      const [r, g, b] = [data[k], data[k + 1], data[k + 2]];
      if (b > r + 60 && b > g + 25) ++count.blue;
      if (r > b + 50 && r > g + 20) ++count.warm;
      if (r > g + 30 && b > g + 50) ++count.purple;
      if (r > g + 90 && r > b + 90) ++count.red;
    }
    return Object.fromEntries(Object.entries(count).map(([what, n]) => [what, n / pixels]));
  }, picture.toString("base64"));
}

const time = (page) => page.evaluate(() => window.replay.player.time);
const text = (page, selector) => page.locator(selector).innerText();

await test("the run's facts, curves and controls stand in the page", async () => {
  const page = await open();
  const run = await text(page, "#run");
  ok(/Blocks\s+\d+/.test(run) && run.includes("finished"), run);
  ok(/[0-9a-f]{16}/.test(run), "state hash");
  equal(await page.evaluate(() => window.replay.frames.length > 10), true);
  const inked = await page.evaluate(() => ["energy", "balance"].map((id) => {
    const canvas = document.getElementById(id);
    return canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.some((v, k) => k % 4 === 3 && v > 0);
  }));
  deepEqual(inked, [true, true]);
  await page.context().close();
});

await test("it plays, pauses and ends at the last frame", async () => {
  const page = await open();
  await page.keyboard.press("Space");
  await page.waitForFunction(() => window.replay.player.time > window.replay.player.first, null, { timeout: 60000 });
  await page.keyboard.press("Space");
  equal(await page.evaluate(() => window.replay.player.playing), false);
  const paused = await time(page);
  ok(paused > 0);
  await page.evaluate(() => (window.replay.player.speed = 10));
  await page.click("#play");
  await page.waitForFunction(() => !window.replay.player.playing, null, { timeout: 60000 });
  equal(await time(page), await page.evaluate(() => window.replay.frames.at(-1).time));
  await page.context().close();
});

await test("keys and slider seek; the picture follows", async () => {
  const page = await open();
  const still = await colours(page, "start");
  await page.keyboard.press("End");
  await settled(page);
  const moved = await colours(page, "end");
  ok(moved.warm > still.warm + 0.02, `displaced blocks are warm: ${still.warm} -> ${moved.warm}`);
  await page.keyboard.press("ArrowLeft");
  const frames = await page.evaluate(() => window.replay.frames.map((frame) => frame.time));
  equal(await time(page), frames.at(-2));
  await page.keyboard.press("Home");
  equal(await time(page), frames[0]);
  await page.locator("#timeline").evaluate((slider, value) => {
    slider.value = value;
    slider.dispatchEvent(new Event("input", { bubbles: true }));
  }, frames[5]);
  ok(Math.abs((await time(page)) - frames[5]) < 1e-9);
  const box = await page.locator("#energy").boundingBox();
  await page.mouse.click(box.x + box.width / 2 + 25, box.y + 20);
  ok(Math.abs((await time(page)) / frames.at(-1) - 0.5) < 0.1, "a click in the curves seeks");
  await page.context().close();
});

await test("a click on a block selects it, tells its numbers and why", async () => {
  const page = await open("#t=end&view=front");
  const place = await page.evaluate(() => {
    const { header } = window.replay;
    const free = header.names.filter((_, b) => header.motion[b] === 0);
    const name = free.find((one) => /r1s1$/.test(one)) ?? free[0];
    return { name, ...window.replay.screenOf(name) };
  });
  const stage = await page.locator("#stage").boundingBox();
  await page.mouse.click(stage.x + place.x, stage.y + place.y);
  await settled(page);
  const panel = await text(page, "#selection");
  ok(panel.includes(`Block ${place.name}`), panel.slice(0, 80));
  ok(/Why/.test(panel) && /Slides|Topples|Stands/.test(panel), "why");
  ok(/Displacement\s+[\d.]+ [mµ]*m/.test(panel) && /kg|g/.test(panel), "units");
  const shown = await page.evaluate(() => window.replay.arrows.geometry.instanceCount);
  ok(shown >= 2, "weight and contacts are drawn as arrows");
  await page.locator("#selection [data-interface]").first().click();
  await settled(page);
  const joint = await text(page, "#selection");
  ok(joint.includes("Joint") && joint.includes("Friction used") && /sticking|slipping|open/.test(joint), joint.slice(0, 80));
  await page.keyboard.press("Escape");
  await settled(page);
  ok((await text(page, "#selection")).includes("Click a block"));
  await page.context().close();
});

await test("the numbers of a block are those of the file", async () => {
  const page = await open("#t=end");
  const { panel, way } = await page.evaluate(() => {
    const { header, frames } = window.replay;
    const block = header.motion.findIndex((m) => m === 0);
    const u = frames.at(-1).displacement;
    return { panel: header.names[block], way: Math.hypot(u.x[block], u.y[block], u.z[block]) };
  });
  await page.evaluate((name) => window.replay.select(name), panel);
  await settled(page);
  const [, value, prefix] = /Displacement\s+([\d.]+) ([mµn]?)m/.exec(await text(page, "#selection"));
  const factor = { "": 1, m: 1e-3, µ: 1e-6, n: 1e-9 }[prefix];
  ok(Math.abs(Number(value) * factor - way) <= 1e-3 * way, `${value} ${prefix}m against ${way} m`);
  await page.context().close();
});

await test("joints: a click picks one, its patch is drawn", async () => {
  const page = await open("#t=end&joints&view=front");
  const found = await page.evaluate(() => {
    const { stage, full, header, now } = window.replay;
    const box = document.getElementById("stage").getBoundingClientRect();
    for (let y = 40; y < box.height; y += 7)
      for (let x = 40; x < box.width; x += 7) {
        window.replay.pick(x, y);
        if (window.replay.selected.interface >= 0) return { x, y, faces: full.interfaces.count, ok: !!(stage && header && now) };
      }
    return null;
  });
  ok(found, "some joint is under the pointer");
  await settled(page);
  ok((await text(page, "#selection")).includes("Joint"));
  await page.context().close();
});

await test("water is blue where there is some, failure roles have their colours", async () => {
  const page = await open("#t=0&view=iso");
  const wet = await page.evaluate(() => window.replay.water.labels.length);
  const shown = await colours(page, "water");
  if (wet > 0) {
    const label = await text(page, "#labels");
    ok(/\d m/.test(label), label);
    await page.keyboard.press("w");
    await settled(page);
    const dry = await colours(page, "dry");
    ok(shown.blue > dry.blue + 0.003, `${shown.blue} against ${dry.blue}`);
  }
  await page.keyboard.press("4");
  await page.keyboard.press("End");
  await settled(page);
  const roles = await colours(page, "roles");
  ok(roles.warm + roles.purple > 0.02, JSON.stringify(roles));
  ok((await text(page, "#legend")).includes("Failure role"));
  await page.context().close();
});

await test("exaggeration moves what is drawn, not what is said", async () => {
  const page = await open("#t=end");
  const name = await page.evaluate(() => window.replay.header.names[window.replay.header.motion.findIndex((m) => m === 0)]);
  const before = await page.evaluate((one) => window.replay.screenOf(one), name);
  await page.keyboard.press("+");
  await page.keyboard.press("+");
  await settled(page);
  const after = await page.evaluate((one) => window.replay.screenOf(one), name);
  ok(Math.hypot(after.x - before.x, after.y - before.y) > 3, "it moves on the screen");
  ok((await text(page, "#legend")).includes("× 3.16"));
  await page.context().close();
});

await test("help opens and closes; a small screen has no sideways scrolling", async () => {
  const page = await open("", { width: 390, height: 800 });
  await page.keyboard.press("?");
  equal(await page.locator("#help").isVisible(), true);
  await page.keyboard.press("Escape");
  equal(await page.locator("#help").isVisible(), false);
  equal(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), true);
  notEqual((await page.locator("#scene").boundingBox()).height, 0);
  await page.context().close();
});

await end();
