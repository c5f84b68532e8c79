// What the replay page shows of a failure that an analysis has kept: the groups of a factor of safety, the mechanism of a limit analysis.
// `node kept.test.mjs PAGE.html CHROMIUM KIND`: KIND is "groups" or "mechanism"; exit code 0 when all holds.

import { equal, ok } from "node:assert/strict";
import { drawn as drawnOn, end, open as openPage, test } from "./opened.mjs";

const kind = process.argv[4];
let page;
const drawn = () => drawnOn(page);
const text = (selector) => page.locator(selector).innerText();

async function open(hash) {
  await page?.context().close();
  page = await openPage(hash);
}

const groups = () => page.evaluate(() => window.replay.groups);

await test("blocks have the colour of the factor at which they go, and the legend lists them", async () => {
  await open("#t=0");
  equal((await groups()).length, kind === "groups" ? 2 : 0);
  equal(await page.locator("#factor-row").isVisible(), kind === "groups");
  await page.keyboard.press("5");
  await drawn();
  equal(await page.evaluate(() => window.replay.look.colouring), kind === "groups" ? "factor" : "displacement");
  if (kind !== "groups") return;
  const [first, second] = await groups();
  ok(first.factor < second.factor && first.share > second.share, "the first to go is the hottest");
  const legend = await text("#legend");
  for (const { factor, blocks } of [first, second]) ok(legend.includes(`at ${factor.toFixed(3)}: ${blocks} block`), legend);
  ok(!(await page.locator("#scale-row").isVisible()));
  const heat = await page.evaluate(() => [...window.replay.heatOfGroups]);
  equal(heat.filter((share) => share > 0).length, first.blocks + second.blocks);
});

await test("the address asks for it, and a block says at which factor it goes", async () => {
  const name = await page.evaluate(() => window.replay.header.names[window.replay.header.motion.findIndex((m) => m === 0)]);
  await open(`#colour=factor&select=${encodeURIComponent(name)}`);
  equal(await page.evaluate(() => window.replay.look.colouring), kind === "groups" ? "factor" : "displacement");
  equal((await text("#selection")).includes("Fails at a factor of"), kind === "groups");
});

await test("the curve of the search stands in the panel with its answer", async () => {
  equal(await page.locator("#path").isVisible(), kind === "groups");
  if (kind !== "groups") return;
  const failure = await page.evaluate(() => ({ ...window.replay.header.failure, pathLoad: [...window.replay.header.failure.pathLoad] }));
  ok(failure.pathLoad.length > 2 && failure.stands < failure.answer && failure.answer < failure.fails);
  const told = await page.locator("#path .told").textContent();
  ok(told.startsWith(`${failure.answer.toFixed(4)}: stands at ${failure.stands.toFixed(4)}`), told);
  const [curve, answer, frame] = await page.evaluate(() =>
    ["#path .curve", "#path .answer", "#path"].map((one) => document.querySelector(one).getBoundingClientRect().toJSON()));
  ok(curve.left >= frame.left && curve.right <= frame.right && curve.top >= frame.top && curve.bottom <= frame.bottom, "it fits");
  ok(answer.top >= curve.top - 3 && answer.top <= curve.bottom, "the answer lies within the curve's loads");
});

await test("a mechanism has no energies to show; a run has", async () => {
  equal(await page.locator("#curves").isVisible(), kind === "groups");
  await page.keyboard.press("End");
  await drawn();
  ok((await page.evaluate(() => window.replay.motionText)).length > 0);
});

await end();
