// A replay page in headless Chromium, opened from the disk and without a network, for the tests that look at it.

import { deepEqual } from "node:assert/strict";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const [page_path, executablePath] = process.argv.slice(2);
const browser = await chromium.launch({ executablePath, args: ["--no-sandbox", "--enable-unsafe-swiftshader"] });
const faults = [];
let passed = 0;

/** Waits until what was asked for is drawn. */
export const drawn = (page) => page.waitForFunction(() => window.replay.dirty.size === 0);

/** Opens the page at an address of its own in a window of its own, and waits until it shows something; its errors are remembered. */
export async function open(hash = "", viewport = { width: 1000, height: 700 }) {
  const context = await browser.newContext({ viewport, offline: true, acceptDownloads: true });
  const page = await context.newPage();
  page.setDefaultTimeout(120_000); // a page of megabytes on cores that are busy
  page.on("console", (message) => message.type() === "error" && faults.push(message.text()));
  page.on("pageerror", (error) => faults.push(error.stack));
  page.on("request", (request) => /^(file|data|blob):/.test(request.url()) || faults.push(`asks for ${request.url()}`));
  await page.goto(pathToFileURL(page_path).href + hash);
  await page.waitForFunction(() => document.documentElement.dataset.state === "ready" && window.replay.pictures > 0);
  await drawn(page);
  return page;
}

export async function test(name, body) {
  await body();
  ++passed;
  console.log(`ok: ${name}`);
}

/** Closes the browser and says how many passed; throws when a page had an error or asked a network for something. */
export async function end() {
  await browser.close();
  deepEqual(faults, [], "no error in the console, the content security policy's too, and nothing asked of a network");
  console.log(`${passed} passed, 0 failed`);
}
