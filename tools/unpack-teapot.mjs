// Writes the Utah teapot of the npm package "teapot" as OBJ. usage: unpack-teapot.mjs MODULE OUT.obj
import { writeFileSync, renameSync } from "node:fs";
import { createRequire } from "node:module";

const [modulePath, out] = process.argv.slice(2);
const { positions, cells } = createRequire(import.meta.url)(modulePath);
const lines = [
  ...positions.map((p) => `v ${p.map((x) => x / 10).join(" ")}`),
  ...cells.map((c) => `f ${c.map((i) => i + 1).join(" ")}`),
];
writeFileSync(`${out}.tmp`, lines.join("\n") + "\n");
renameSync(`${out}.tmp`, out);
