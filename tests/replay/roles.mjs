// What the replay page says of blocks: `node roles.mjs SOURCE INPUT` reads {rule, header, frame, radius} and prints each
// block's role and the whole's mode.

import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [source, input] = process.argv.slice(2);
const { rule, header, frame, radius } = JSON.parse(readFileSync(input, "utf8"));
globalThis.document = { getElementById: (id) => (id === "motion-rule" ? { textContent: JSON.stringify(rule) } : null) };
const { overallMode, rolesAt } = await import(pathToFileURL(`${source}/tools/replay/src/data/roles.js`));
const roles = rolesAt(header, frame, radius);
console.log(JSON.stringify({ roles: [...roles], mode: overallMode(header, roles) }));
