// Makes dist/page.html out of the sources here, the packages of package.json and the schema: one page without a run, which
// the talus program carries and fills. `node bundle.mjs` writes it, `node bundle.mjs --check` compares it with the one
// that is there. Needs flatc, as the build of Talus does.

import { execFileSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build, transform } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const text = (path) => readFileSync(join(here, path), "utf8");
const packages = ["three", "@mcap/core", "@foxglove/crc", "heap-js", "tslib", "flatbuffers", "fzstd"];

async function script(generated) {
  const result = await build({
    absWorkingDir: here,
    entryPoints: ["src/main.js"],
    bundle: true,
    minify: true,
    format: "iife",
    target: "es2022",
    charset: "ascii",
    legalComments: "none", // the licences stand in the page as a whole
    alias: { schema: join(generated, "talus/snapshot") },
    nodePaths: [join(here, "node_modules")],
    write: false,
    logLevel: "warning",
  });
  return result.outputFiles[0].text.trim();
}

/** What the licences want to go along: each package's name, version and licence text. */
function licences() {
  return packages.map((name) => {
    const folder = join(here, "node_modules", name);
    const { version, license } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
    const found = ["LICENSE", "LICENSE.md", "LICENSE.txt", "LICENCE"].map((file) => {
      try { return readFileSync(join(folder, file), "utf8"); } catch { return null; }
    }).find(Boolean);
    return `${name} ${version} (${license})\n\n${(found ?? "").trim()}`;
  }).join("\n\n--------------------------------\n\n");
}

async function page() {
  const generated = mkdtempSync(join(tmpdir(), "talus-replay-"));
  try {
    execFileSync("flatc", ["--ts", "-o", generated, join(here, "../../formats/snapshot.fbs")]);
    const style = (await transform(text("page.css"), { loader: "css", minify: true })).code.trim();
    const code = await script(generated);
    const escaped = licences().replace(/&/g, "&amp;").replace(/</g, "&lt;");
    const fill = { STYLE: style, SCRIPT: code, LICENCES: escaped };
    return text("page.html").replace(/\/\*(STYLE|SCRIPT|LICENCES)\*\//g, (_, name) => fill[name]).replace(/\r/g, "");
  } finally {
    rmSync(generated, { recursive: true, force: true });
  }
}

const made = await page();
const path = join(here, "dist/page.html");
if (process.argv.includes("--check")) {
  let there = "";
  try { there = readFileSync(path, "utf8"); } catch { /* not there: differs */ }
  if (there !== made) {
    console.error("tools/replay/dist/page.html is not what its sources make: run `npm run bundle` in tools/replay");
    process.exit(1);
  }
  console.log("tools/replay/dist/page.html is what its sources make");
} else {
  mkdirSync(dirname(path), { recursive: true });
  writeFileSync(path, made);
  console.log(`dist/page.html: ${(made.length / 1e3).toFixed(0)} kB`);
}
