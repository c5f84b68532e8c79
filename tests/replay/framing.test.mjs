// Where the replay page looks: what moves is on the canvas, beside the legends, on a telephone and on a screen; letters of the
// compass stand apart; what is said of why a block fails follows the numbers that decide.
// `node framing.test.mjs PAGE.html CHROMIUM`; exit code 0 when all holds.

import { deepEqual, equal, ok } from "node:assert/strict";
import { drawn, end, open as openAt, test } from "./opened.mjs";

const open = (hash, width) => openAt(hash, { width, height: 844 });

/** What is wrong with where the corners of the moving blocks are seen; runs in the page. */
function inspect() {
  const { replay } = window, { header, moving } = replay;
  const stage = document.getElementById("stage").getBoundingClientRect();
  const over = ["legend", "orientation", "scale"].map((id) => [id, document.getElementById(id).getBoundingClientRect()]);
  const faults = new Set(), xs = [], ys = [];
  for (const b of moving)
    for (let v = header.vertexBegin[b]; v < header.vertexBegin[b + 1]; ++v) {
      const { x, y } = replay.screenOfPoint(b, ["x", "y", "z"].map((k) => header.vertex[k][v] - header.centroid[k][b]));
      xs.push(x), ys.push(y);
      if (x < 0 || y < 0 || x > stage.width || y > stage.height) faults.add(`outside, at ${x.toFixed(0)} ${y.toFixed(0)} of ${stage.width} x ${stage.height}`);
      for (const [id, box] of over)
        if (x > box.left - stage.left && x < box.right - stage.left && y > box.top - stage.top && y < box.bottom - stage.top) faults.add(`beneath the ${id}`);
    }
  const spread = Math.max(Math.max(...xs) - Math.min(...xs), Math.max(...ys) - Math.min(...ys));
  if (spread < 12) faults.add(`a dot of ${spread} px`);
  const right = Math.max(...over.map(([, box]) => box.right));
  if (right > stage.right) faults.add("what stands over the scene reaches beyond it");
  const [legend, , scale] = over.map(([, box]) => box);
  if (legend.right > scale.left && legend.bottom > scale.top) faults.add("the legend lies on the scale");
  return [...faults];
}

for (const width of [390, 1400])
  await test(`what moves is seen beside the legends, at the moment asked for, at ${width} px`, async () => {
    for (const hash of ["#t=end", "#t=end&view=front", "#t=end&view=toe", "#t=end&view=front&colour=role&joints", "#t=0"]) {
      const page = await open(hash, width);
      ok(await page.evaluate(() => window.replay.moving.length > 0));
      deepEqual(await page.evaluate(inspect), [], `${hash} at ${width} px`);
      await page.context().close();
    }
  });

await test("what the reader has turned stays as it is; R frames it again, the tilt stays that of the moment", async () => {
  const page = await open("#t=end&view=front", 1000);
  const camera = () => page.evaluate(() => window.replay.stage.camera.position.toArray());
  const [asked, tilted] = [await camera(), await page.evaluate(() => window.replay.stage.model.rotation.y)];
  const box = await page.locator("#scene").boundingBox();
  await page.mouse.move(box.x + 300, box.y + 200);
  await page.mouse.wheel(0, 300);
  await drawn(page);
  const turned = await camera();
  ok(Math.hypot(...asked.map((v, k) => v - turned[k])) > 0);
  await page.keyboard.press("j");
  await page.setViewportSize({ width: 900, height: 844 });
  await drawn(page);
  deepEqual(await camera(), turned);
  await page.keyboard.press("r");
  await drawn(page);
  equal(await page.evaluate(() => window.replay.stage.model.rotation.y), tilted);
  deepEqual(await page.evaluate(inspect), []);
  await page.context().close();
});

await test("letters of compass and axes stand apart in every view", async () => {
  const page = await open("#t=end", 1000);
  for (const view of ["iso", "front", "toe", "top"])
    for (const turn of [0, 0.7, 1.6, 2.9]) {
      const nearest = await page.evaluate(async ([one, by]) => {
        const { replay } = window, { stage } = replay;
        replay.home(one);
        const from = stage.camera.position.clone().sub(stage.controls.target);
        stage.camera.position.copy(stage.controls.target).add(from.applyAxisAngle(stage.camera.up, by));
        stage.controls.update();
        replay.draw();
        const places = [...document.querySelectorAll("#axes text")].map((text) => [Number(text.getAttribute("x")), Number(text.getAttribute("y"))]);
        return { count: places.length, apart: Math.min(...places.flatMap((a, k) => places.slice(k + 1).map((b) => Math.hypot(a[0] - b[0], a[1] - b[1])))) };
      }, [view, turn]);
      equal(nearest.count, 5);
      ok(nearest.apart > 9, `${nearest.apart} px between two letters, view ${view}, turned by ${turn}`);
    }
  await page.context().close();
});

await test("why a block slides or topples follows the numbers that decide, and those of a search are told apart", async () => {
  const page = await open("#t=end", 1000);
  const said = (block) => page.evaluate(async (one) => {
    window.replay.select(one);
    window.replay.draw();
    return { text: document.querySelector("#selection .why").innerText, role: window.replay.roles[one] };
  }, block);
  const metres = (value, unit) => Number(value) * { m: 1, mm: 1e-3, "µm": 1e-6, km: 1e3 }[unit];
  const moving = await page.evaluate(() => window.replay.moving);
  for (const block of moving.slice(0, 12)) {
    const { text, role } = await said(block);
    const found = /(Slides|Topples|sliding|toppling): its rotation of ([\d.]+)° times the moving group's extent of ([\d.]+) (\w*m) is ([\d.]+) ([µ\w]*m), (more|less) than (\d+) % of its displacement of ([\d.]+) (\w*m)/.exec(text);
    ok(found, text);
    const [, word, turned, extent, extentUnit, swing, swingUnit, more, share, way, wayUnit] = found;
    const [size, arc, gone] = [metres(extent, extentUnit), metres(swing, swingUnit), metres(way, wayUnit)];
    ok(Math.abs(((turned * Math.PI) / 180) * size - arc) < 0.02 * arc, text);
    equal(arc > (share / 100) * gone, more === "more", text);
    equal(/topp/i.test(word), more === "more", text);
    equal(role === 4, more === "more", text);
  }
  const block = moving[0], { role } = await said(block);
  await page.evaluate(([one, other]) => {
    const { replay } = window;
    replay.header.failure = { role: replay.header.names.map((_, b) => (b === one ? other : 0)), factor: [], mode: "mixed", analysis: "" };
    replay.rolesFrame = null;
  }, [block, role === 4 ? 1 : 2]);
  const { text } = await said(block);
  ok(text.startsWith(role === 4 ? "Slides at the failure" : "Topples at the failure"), text);
  ok(/By its motion up to this frame: (counts as )?(topples|slides|toppling|sliding)/.test(text), text);
  await page.context().close();
});

await test("where a contact carries, be it the only one of many, its force is drawn and its scale told", async () => {
  for (const hash of ["#t=0&forces", "#t=end&forces"]) {
    const page = await open(hash, 1000);
    await page.waitForFunction(() => window.replay.fullIndex < 0 || window.replay.full);
    await drawn(page);
    const [largest, arrows, legend] = await page.evaluate(() => {
      const { full, arrows } = window.replay, force = full?.interfaces.force;
      const strengths = force ? Array.from(force.x, (x, i) => Math.hypot(x, force.y[i], force.z[i])) : [];
      return [Math.max(0, ...strengths), arrows.geometry.instanceCount, document.getElementById("legend").innerText];
    });
    equal(arrows > 0, largest > 0, `${arrows} arrows for ${largest} N at ${hash}`);
    equal(/Contact forces/.test(legend), largest > 0, legend);
    await page.context().close();
  }
});

await end();
