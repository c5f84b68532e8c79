// The replay page of a run with steady flow: joints coloured by the pressure of their water.
// `node flow.test.mjs PAGE.html CHROMIUM KIND [SCREENSHOT_FOLDER]`: KIND is "flow" or "none"; exit code 0 when all holds.

import { equal, ok } from "node:assert/strict";
import { drawn, end, open, test } from "./opened.mjs";

const has_flow = process.argv[4] === "flow", shots = process.argv[5];
const text = (page, selector) => page.locator(selector).innerText();
const look = (page) => page.evaluate(() => window.replay.look);

await test("joints can be coloured by water pressure where there is flow, with a scale in Pa", async () => {
  const page = await open("", { width: 1280, height: 800 });
  equal(await page.locator("#joint-colours").isVisible(), has_flow);
  await page.keyboard.press("u");
  await drawn(page);
  equal((await look(page)).joints, has_flow);
  equal(await page.evaluate(() => window.replay.showsFlow()), has_flow);
  const legend = await text(page, "#legend");
  equal(legend.includes("Water pressure in joints"), has_flow, legend);
  if (!has_flow) return;
  ok(/[\d.]+ k?Pa/.test(legend) && legend.includes("dry"), legend);
  if (shots) await page.screenshot({ path: `${shots}/flow-1280.png` });
  await page.check("[value=friction]");
  await drawn(page);
  equal(await page.evaluate(() => window.replay.showsFlow()), false);
  ok((await text(page, "#legend")).includes("friction used"));
  await page.check("[value=pressure]");
  await page.keyboard.press("u");
  await drawn(page);
  equal((await look(page)).joints, false);
  await page.context().close();
});

await test("the pressure under the pointer is that of the file at this place", async () => {
  const page = await open("#joints=pressure", { width: 1280, height: 800 });
  equal(await page.evaluate(() => window.replay.showsFlow()), has_flow);
  if (!has_flow) return;
  const found = await page.evaluate(() => {
    const { replay } = window, { flow } = replay.header;
    const node = (n) => ["x", "y", "z"].map((k) => flow.node[k][n]);
    let checked = 0, worst = 0;
    for (let t = 0; t < flow.joint.length; ++t) {
      const corners = [0, 1, 2].map((k) => flow.triangle[3 * t + k]);
      const middle = [0, 1, 2].map((k) => corners.reduce((sum, n) => sum + node(n)[k], 0) / 3);
      const at = replay.stage.screenOf(middle), ray = replay.stage.rayAt(at.x, at.y);
      const hit = replay.flowAlong(ray.origin, ray.direction);
      if (hit?.triangle !== t) continue; // another one lies before it
      const mean = corners.reduce((sum, n) => sum + flow.pressure[n], 0) / 3;
      worst = Math.max(worst, Math.abs(hit.value - mean));
      ++checked;
    }
    return { checked, worst, most: replay.flow.most };
  });
  ok(found.checked > 3 && found.worst < 1e-3 * found.most, JSON.stringify(found));
  const { x, y } = await page.evaluate(() => {
    const { replay } = window, { flow } = replay.header;
    const wettest = flow.joint.findIndex((_, t) => [0, 1, 2].some((k) => flow.pressure[flow.triangle[3 * t + k]] === replay.flow.most));
    const corners = [0, 1, 2].map((k) => flow.triangle[3 * wettest + k]);
    return replay.stage.screenOf(["x", "y", "z"].map((k) => corners.reduce((sum, n) => sum + flow.node[k][n], 0) / 3));
  });
  const box = await page.locator("#scene").boundingBox();
  await page.mouse.move(box.x + x, box.y + y);
  await page.waitForFunction(() => !document.getElementById("tip").hidden);
  ok(/^([\d.]+ k?Pa|dry), joint .+ between .+ and .+/.test(await text(page, "#tip")), await text(page, "#tip"));
  await page.mouse.click(box.x + x, box.y + y);
  await drawn(page);
  ok(/Water pressure/.test(await text(page, "#selection")), await text(page, "#selection"));
  await page.context().close();
});

await test("with the flow's pushes the forces on a block are those that the file says move it", async () => {
  const page = await open("#joints=pressure&t=0", { width: 1000, height: 700 });
  const found = await page.evaluate(() => {
    const { replay } = window, { header, full, now } = replay, free = replay.freeBlocks();
    const off = free.map((b) => {
      const arrows = replay.arrows.onBlock(full, now.a, b, [0, 0, 0]), told = ["x", "y", "z"].map((k) => full.force[k][b]);
      const sum = arrows.reduce((all, { force }) => all.map((v, k) => v + force[k]), [0, 0, 0]);
      return Math.hypot(...sum.map((v, k) => v - told[k])) / (header.mass[b] * header.gravity);
    });
    replay.select(free[0]);
    return { worst: Math.max(...off), name: header.names[free[0]] };
  });
  ok(found.worst < 1e-4, JSON.stringify(found));
  await drawn(page);
  if (found.name === "box") equal((await text(page, "#selection")).includes("Water pushes it with 39.24 kN"), has_flow); // rho g 1 m 4 m2
  await page.context().close();
});

await test("it fits a narrow window", async () => {
  const page = await open("#joints=pressure", { width: 390, height: 844 });
  if (shots) await page.screenshot({ path: `${shots}/flow-390.png` });
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  ok(wide <= 390, `${wide} px`);
  await page.context().close();
});

await end();
