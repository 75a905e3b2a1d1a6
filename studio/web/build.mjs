// Bundles the front end to dist/ (node build.mjs), or its unit tests to build-test/ (node build.mjs test).
import { build } from "esbuild";
import { copyFile, mkdir, readdir, rm } from "node:fs/promises";

const folder = process.argv[2] === "test" ? "build-test" : "dist";
await rm(folder, { recursive: true, force: true });
await mkdir(folder);
if (folder === "dist") {
  await build({
    entryPoints: { studio: "src/main.ts" },
    bundle: true, minify: true, format: "esm", target: "es2022", outdir: folder,
    loader: { ".css": "css" }, legalComments: "inline", sourcemap: "linked",
  });
  for (const name of ["index.html", "icon.svg"]) await copyFile(`src/${name}`, `${folder}/${name}`);
} else {
  const tests = (await readdir("tests")).filter((name) => name.endsWith(".test.ts"));
  await build({
    entryPoints: tests.map((name) => `tests/${name}`),
    bundle: true, format: "esm", platform: "node", target: "node20", outdir: folder, outExtension: { ".js": ".mjs" },
  });
}
