// Makes FOLDER/dist/page.html out of page.html, page.css and src/ there and the packages of its package.json: one page
// without data, which the talus program carries and fills. `node bundle-page.mjs FOLDER` writes it, with `--check` it is
// compared with the one that is there. A page that reads snapshots ("schema" in its package.json) needs flatc, as the
// build of Talus does.

import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join, relative, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const tools = dirname(fileURLToPath(import.meta.url));
const here = resolve(process.argv[2]);
const name = join("tools", relative(tools, here));
const text = (path) => readFileSync(join(here, path), "utf8");
const { schema } = JSON.parse(text("package.json"));
const { build, transform } = createRequire(join(here, "package.json"))("esbuild");

/** The script and the packages that went into it. */
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
    alias: schema ? { schema: join(generated, "talus/snapshot") } : {},
    nodePaths: [join(here, "node_modules")],
    write: false,
    metafile: true,
    logLevel: "warning",
  });
  const used = Object.values(result.metafile.outputs).flatMap(({ inputs }) =>
    Object.entries(inputs).filter(([, { bytesInOutput }]) => bytesInOutput > 0).map(([path]) => path));
  const packages = used.map((path) => path.match(/.*node_modules\/((?:@[^/]+\/)?[^/]+)/)?.[1]).filter(Boolean);
  return { code: result.outputFiles[0].text.trim(), packages: [...new Set(packages)].sort() };
}

/** Texts that the licences require: each package's name, version and licence text. */
const licences = (packages) => packages.map((name) => {
  const folder = join(here, "node_modules", name);
  const { version, license } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
  const found = ["LICENSE", "LICENSE.md", "LICENSE.txt", "LICENCE"].map((file) => {
    try { return readFileSync(join(folder, file), "utf8"); } catch { return null; }
  }).find(Boolean);
  if (!found) console.error(`${name} has no licence text`);
  return `${name} ${version} (${license})\n\n${(found ?? "").trim()}`;
}).join("\n\n--------------------------------\n\n");

async function page() {
  const generated = mkdtempSync(join(tmpdir(), "talus-page-"));
  try {
    if (schema) execFileSync("flatc", ["--ts", "-o", generated, join(here, schema)]);
    const style = (await transform(text("page.css"), { loader: "css", minify: true })).code.trim();
    const { code, packages } = await script(generated);
    const fill = {
      STYLE: style,
      SCRIPT: code,
      SCRIPT_HASH: createHash("sha256").update(code.replace(/\r/g, "")).digest("base64"),
      LICENCES: licences(packages).replace(/&/g, "&amp;").replace(/</g, "&lt;"),
    };
    return text("page.html").replace(/\/\*(STYLE|SCRIPT|SCRIPT_HASH|LICENCES)\*\//g, (_, what) => fill[what]).replace(/\r/g, "");
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
    console.error(`${name}/dist/page.html is not what its sources make: run \`npm run bundle\` in ${name}`);
    process.exit(1);
  }
  console.log(`${name}/dist/page.html is what its sources make`);
} else {
  mkdirSync(dirname(path), { recursive: true });
  writeFileSync(path, made);
  console.log(`${name}/dist/page.html: ${(made.length / 1e3).toFixed(0)} kB`);
}
