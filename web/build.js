// Bundle the page: `make page`. Writes page.js, style.css, index.html and page.json (the hash of the sources, which a test
// compares, and the licences of what is inside) into src/carom/explorer/assets.
import { createHash } from "node:crypto";
import { mkdir, readFile, readdir, writeFile } from "node:fs/promises";
import path from "node:path";
import { fileURLToPath } from "node:url";
import * as esbuild from "esbuild";

const here = path.dirname(fileURLToPath(import.meta.url));
const assets = path.join(here, "..", "src", "carom", "explorer", "assets");

/** All sources, sorted; what is installed and what only checks them is none. */
async function sources(folder = here) {
  const found = [];
  for (const entry of await readdir(folder, { withFileTypes: true })) {
    if (["node_modules", "tsconfig.json", "eslint.config.js"].includes(entry.name)) continue;
    const file = path.join(folder, entry.name);
    if (entry.isDirectory()) found.push(...(await sources(file)));
    else if (/\.(js|css|html|json)$/.test(entry.name) && !entry.name.endsWith(".test.js")) found.push(file);
  }
  return found.sort();
}

async function hashOf(files) {
  const hash = createHash("sha256");
  for (const file of files) {
    hash.update(path.relative(here, file).split(path.sep).join("/") + "\n");
    hash.update(await readFile(file));
  }
  return hash.digest("hex");
}

const built = await esbuild.build({
  entryPoints: [path.join(here, "main.js")],
  bundle: true,
  minify: true,
  format: "iife",
  target: "es2022",
  charset: "ascii",
  legalComments: "none",
  metafile: true,
  write: false,
});
const styles = await esbuild.transform(await readFile(path.join(here, "style.css"), "utf8"), { loader: "css", minify: true });

// The licence of every package that is inside, word for word.
const packages = new Set();
for (const input of Object.keys(built.metafile.inputs)) {
  const match = /node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(input.split(path.sep).join("/"));
  if (match) packages.add(match[1]);
}
const licences = [];
for (const name of [...packages].sort()) {
  const folder = path.join(here, "node_modules", name);
  const { version, license } = JSON.parse(await readFile(path.join(folder, "package.json"), "utf8"));
  const file = (await readdir(folder)).find((entry) => /^licen[cs]e/i.test(entry));
  if (!file) throw new Error(`${name}: expected a file LICENSE in the package, got none`);
  licences.push(`${name} ${version} (${license})\n\n${(await readFile(path.join(folder, file), "utf8")).trim()}\n`);
}

await mkdir(assets, { recursive: true });
await writeFile(path.join(assets, "page.js"), built.outputFiles[0].contents);
await writeFile(path.join(assets, "style.css"), styles.code);
await writeFile(path.join(assets, "index.html"), await readFile(path.join(here, "index.html")));
await writeFile(path.join(assets, "LICENSES.txt"), licences.join("\n" + "-".repeat(80) + "\n\n"));
const record = { sources: await hashOf(await sources()), packages: [...packages].sort() };
await writeFile(path.join(assets, "page.json"), JSON.stringify(record, null, 2) + "\n");
console.log(`page.js ${(built.outputFiles[0].contents.length / 1e3).toFixed(0)} kB, sources ${record.sources.slice(0, 12)}`);
