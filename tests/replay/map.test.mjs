// The page of `talus batch --map-3d`: cells of a map of failure on the blocks of a slope.
// `node map.test.mjs PAGE.html CHROMIUM [SCREENSHOT_FOLDER]`; exit code 0 when all holds.

import { equal, ok } from "node:assert/strict";
import { drawn, end, open, test } from "./opened.mjs";

const shots = process.argv[4];
const text = (page, selector) => page.locator(selector).innerText();

/** The cell of the highest probability: its number, its probability and where it is on the page. */
const worst = (page) => page.evaluate(() => {
  const { replay } = window, { map } = replay, { values } = map.quantities.probability;
  const cell = values.indexOf(Math.max(...values)), { x, y } = replay.stage.screenOf(map.cells.centre.slice(3 * cell, 3 * cell + 3));
  const box = document.getElementById("scene").getBoundingClientRect();
  return { cell, probability: values[cell], x: x + box.left, y: y + box.top };
});

await test("it shows cells in the colours of their probability, and nothing of a run", async () => {
  const page = await open("", { width: 1280, height: 800 });
  ok((await text(page, "#title")).startsWith("Probability of failure of "));
  ok(/\d+ of \d+ samples fail/.test(await text(page, "#facts")), await text(page, "#facts"));
  for (const id of ["transport", "colours", "film"]) equal(await page.locator(`#${id}`).isVisible(), false, id);
  ok((await text(page, "#legend")).startsWith("Probability of failure"));
  ok(/expected failing volume/.test(await text(page, "#run")));
  const seen = await page.evaluate(() => {
    const { renderer } = window.replay.stage, gl = renderer.getContext();
    window.replay.stage.render();
    const [w, h] = [renderer.domElement.width, renderer.domElement.height], pixels = new Uint8Array(4 * w * h);
    gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    const none = [1, 3, 5].map((k) => parseInt(window.replay.map.none.slice(k, k + 2), 16));
    let warm = 0, grey = 0;
    for (let k = 0; k < pixels.length; k += 4) {
      warm += pixels[k] > pixels[k + 2] + 60;
      grey += none.every((v, j) => Math.abs(pixels[k + j] - v) < 2);
    }
    return { warm, grey };
  });
  ok(seen.warm > 500 && seen.grey > 500, JSON.stringify(seen));
  if (shots) await page.screenshot({ path: `${shots}/map-1280.png` });
  await page.context().close();
});

await test("a cell tells its probability, the interval and the expected volume", async () => {
  const page = await open("", { width: 1280, height: 800 });
  const { cell, probability, x, y } = await worst(page);
  ok(probability > 0);
  await page.mouse.move(x, y);
  await page.waitForFunction(() => !document.getElementById("tip").hidden);
  const tip = await text(page, "#tip"), figure = String(Number(probability.toPrecision(3)));
  ok(tip.startsWith(`probability ${figure} (`) && tip.endsWith("m³/m²"), tip);
  await page.mouse.click(x, y);
  await drawn(page);
  equal(await page.evaluate(() => window.replay.selected.cell), cell);
  const told = await text(page, "#selection");
  for (const part of [`Cell ${cell}`, figure, "% interval", "Expected volume", "Cells on it"]) ok(told.includes(part), told);
  if (shots) await page.screenshot({ path: `${shots}/map-chosen-1280.png` });
  const sums = await page.evaluate(() => {
    const { replay } = window, blocks = replay.header.names.map((_, b) => replay.cellsOn(b).length);
    return { cells: replay.map.cells.area.length, onBlocks: blocks.reduce((a, b) => a + b, 0) };
  });
  ok(sums.onBlocks >= 0.99 * sums.cells && sums.onBlocks <= 1.01 * sums.cells, JSON.stringify(sums));
  await page.keyboard.press("Escape");
  await drawn(page);
  equal(await page.evaluate(() => window.replay.selected.cell), -1);
  await page.context().close();
});

await test("keys and the address switch to the expected volume; a cell behind rock is not told of", async () => {
  const page = await open("", { width: 1000, height: 700 });
  await page.keyboard.press("2");
  await drawn(page);
  ok((await text(page, "#legend")).startsWith("Expected failing volume"));
  const again = await open("#colour=volume", { width: 1000, height: 700 });
  equal(await again.evaluate(() => window.replay.look.colouring), "volume");
  await again.context().close();
  const found = await page.evaluate(() => { // from behind and below, where there are no cells
    const { replay } = window, { cells } = replay.map, cell = cells.hits.indexOf(Math.max(...cells.hits));
    const [centre, normal] = [cells.centre, cells.normal].map((list) => list.slice(3 * cell, 3 * cell + 3));
    return replay.cellAlong(centre.map((v, k) => v - 1000 * normal[k]), normal);
  });
  equal(found, -1);
  await page.context().close();
});

await test("it fits a narrow window, and pictures are saved", async () => {
  const page = await open("", { width: 390, height: 844 });
  if (shots) await page.screenshot({ path: `${shots}/map-390.png` });
  ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 390);
  await page.click("#panel-button");
  if (shots) await page.screenshot({ path: `${shots}/map-panel-390.png` });
  const [file] = await Promise.all([page.waitForEvent("download"), page.click("#picture")]);
  ok(file.suggestedFilename().endsWith("-probability.png"), file.suggestedFilename());
  if (shots) await file.saveAs(`${shots}/map-saved.png`);
  await page.context().close();
});

await end();
