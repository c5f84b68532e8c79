// Pages of reports in headless Chromium, as a user has them: opened from the disk, without a network, on a telephone and
// on a screen. `node page.test.mjs CHROMIUM PAGE.html...`; exit code 0 when all holds. With SHOTS=FOLDER it leaves
// pictures there.

import { deepEqual, equal, ok } from "node:assert/strict";
import { basename } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const [executablePath, ...paths] = process.argv.slice(2);
const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
let passed = 0;

/** The element that reaches farthest to the right. */
function widest() {
  const all = [...document.body.querySelectorAll("*")].filter((element) => !element.closest(".scroll"));
  const right = (element) => element.getBoundingClientRect().right;
  const one = all.reduce((a, b) => (right(b) > right(a) ? b : a));
  return `${one.tagName} "${one.getAttribute("class") ?? ""}" in "${one.parentElement.getAttribute("class") ?? ""}"`;
}

/** What is wrong with the page as it stands; runs in the page. */
function inspect() {
  const report = JSON.parse(document.getElementById("report").textContent);
  const blocks = [...report.opening, ...report.sections.flatMap((section) => section.blocks)];
  const plots = blocks.filter(({ type }) => type === "plot"), faults = [];
  for (const plot of plots) {
    const drawn = document.querySelector(`#${CSS.escape(plot.id)} svg[role=img]`);
    if (!drawn) { faults.push(`${plot.id}: not drawn`); continue; }
    if (/NaN|Infinity|undefined/.test(drawn.outerHTML)) faults.push(`${plot.id}: a place that is no number`);
    const rows = plot.series.reduce((sum, { type, rows }) => sum + (["points", "bars", "correlation", "cells", "box"].includes(type) ? rows.length : Math.min(1, rows.length)), 0);
    const marks = drawn.querySelectorAll("circle,rect,path,polygon").length;
    if (marks < rows) faults.push(`${plot.id}: ${marks} marks for ${rows} values`);
  }
  for (const box of document.querySelectorAll(".scroll")) if (getComputedStyle(box).overflowX !== "auto") faults.push("a table does not scroll in its box");
  for (const drawn of document.querySelectorAll(".plot svg[role=img]")) {
    const edge = drawn.getBoundingClientRect();
    for (const text of drawn.querySelectorAll("text")) {
      const box = text.getBoundingClientRect();
      if (box.width > edge.width / 2) continue; // a name that long has room nowhere
      if (box.width > 0 && (box.left < edge.left - 1 || box.right > edge.right + 1))
        faults.push(`${drawn.closest("figure").id}: "${text.textContent}" reaches over the edge of its plot`);
    }
  }
  const drawings = blocks.filter(({ type }) => type === "drawings").flatMap(({ items }) => items);
  const shapes = drawings.reduce((sum, drawing) => sum + drawing.shapes.length, 0);
  return {
    state: document.documentElement.dataset.state,
    faults,
    wider: document.documentElement.scrollWidth - window.innerWidth,
    title: document.title === report.title && document.querySelector("h1").innerText === report.heading,
    headings: [...document.querySelectorAll("h2")].map((one) => one.innerText),
    titles: report.sections.map(({ title }) => title),
    tables: [document.querySelectorAll("main table").length, blocks.filter(({ type }) => type === "table").length],
    shapes: [document.querySelectorAll(".drawing polygon, .drawing polyline").length, shapes],
    ran: window.ran ?? false,
    unnamed: [...document.querySelectorAll("svg[role=img]")].filter((one) => !one.getAttribute("aria-label")).length,
    outside: [...document.querySelectorAll("a[href]")].map((one) => one.getAttribute("href")).filter((href) => /^[a-z]+:/i.test(href)),
  };
}

/** What of the tables cannot be read where they are wider than the screen; runs in the page. */
async function inspectTables() {
  const faults = [], pictured = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
  for (const box of document.querySelectorAll(".scroll")) {
    const name = box.getAttribute("aria-label"), cell = box.querySelector("tbody td");
    const is_cut = box.scrollWidth > box.clientWidth;
    if (is_cut && innerWidth > 1200) faults.push(`${name}: ${box.scrollWidth} px wide in ${box.clientWidth} px`);
    if ((getComputedStyle(box).maskImage !== "none") !== is_cut) faults.push(`${name}: nothing shows whether it goes on to the right`);
    if (!is_cut) continue;
    const { left, width } = cell.getBoundingClientRect();
    const beside = Math.max(...[...box.querySelectorAll("tbody tr:first-child td:not(:first-child)")].map((one) => one.offsetWidth), 0);
    if (width + beside > box.clientWidth + 1) faults.push(`${name}: a column of ${beside} px cannot be read beside the first one`);
    box.scrollLeft = box.scrollWidth;
    await pictured();
    if (Math.abs(cell.getBoundingClientRect().left - left) > 1) faults.push(`${name}: what a row is about is not to be seen beside its end`);
    if (getComputedStyle(box).maskImage !== "none") faults.push(`${name}: its end is faded`);
    box.scrollLeft = 0;
  }
  return faults;
}

for (const path of paths) {
  for (const width of [390, 1400]) {
    const faults = [];
    const context = await browser.newContext({ viewport: { width, height: 900 }, offline: true });
    const page = await context.newPage();
    page.setDefaultTimeout(120_000); // a page of megabytes on cores that are busy
    page.on("console", (message) => message.type() === "error" && faults.push(message.text()));
    page.on("pageerror", (error) => faults.push(error.stack));
    page.on("request", (request) => /^(file|data|blob):/.test(request.url()) || faults.push(`asks for ${request.url()}`));
    await page.goto(pathToFileURL(path).href);
    const found = await page.evaluate(inspect);
    equal(found.state, "ready");
    deepEqual([...found.faults, ...faults], []);
    ok(found.wider <= 0, `${path} is ${found.wider} px wider than a screen of ${width} px: ${await page.evaluate(widest)}`);
    deepEqual(await page.evaluate(inspectTables), [], `${path} at ${width} px`);
    ok(found.title);
    deepEqual(found.headings, found.titles);
    equal(found.tables[0], found.tables[1]);
    equal(found.shapes[0], found.shapes[1]);
    equal(found.ran, false, "a text of the report ran");
    equal(found.unnamed, 0);
    deepEqual(found.outside, []);
    if (width === 390 && (await page.locator(".plot details").count()) > 0) {
      await page.locator(".plot details summary").first().click();
      await page.locator(".plot details").first().locator("table").first().waitFor(); // drawn when the page hears of the click
      await page.locator(".plot details summary").first().click();
    }
    if (process.env.SHOTS) await page.screenshot({ path: `${process.env.SHOTS}/${basename(path)}-${width}.png`, fullPage: true });
    await context.close();
    ++passed;
    console.log(`ok: ${basename(path)} at ${width} px`);
  }
}
await browser.close();
console.log(`${passed} passed, 0 failed`);
