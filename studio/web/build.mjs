// Bundles the front end to dist/ (node build.mjs), what recognizes without a server to dist/local/ (node build.mjs local
// MODEL, the folder of its weights), or the unit tests to build-test/ (node build.mjs test).
import { build } from "esbuild";
import { copyFile, mkdir, readdir, rm } from "node:fs/promises";
import { join } from "node:path";

const [what = "studio", model] = process.argv.slice(2);
const folder = { studio: "dist", local: "dist/local", test: "build-test" }[what];
await rm(folder, { recursive: true, force: true });
await mkdir(folder, { recursive: true });
const page = { bundle: true, minify: true, format: "esm", target: "es2022", outdir: folder, legalComments: "inline" };
const copied = (from, names) => Promise.all(names.map((name) => copyFile(join(from, name), join(folder, name))));

if (what === "studio") {
  await build({ ...page, entryPoints: { studio: "src/main.ts" }, sourcemap: "linked" });
  await copied("src", ["index.html", "icon.svg"]);
} else if (what === "local") {
  await build({ ...page, entryPoints: { local: "src/local/main.ts" }, nodePaths: ["runtime/node_modules"] });
  await copied("src/local", ["local.html"]);
  await copied("src", ["icon.svg"]);
  await copied("runtime/node_modules/onnxruntime-web/dist", ["ort-wasm-simd-threaded.wasm"]);
  await copied(model, ["strokes.onnx", "strokes.json"]);
} else {
  const tests = (await readdir("tests")).filter((name) => name.endsWith(".test.ts"));
  await build({
    entryPoints: tests.map((name) => `tests/${name}`),
    bundle: true, format: "esm", platform: "node", target: "node20", outdir: folder, outExtension: { ".js": ".mjs" },
  });
}
