// Runs the ONNX file in onnxruntime-web over many inputs: node raw_parity.mjs strokes.onnx inputs.json answers.json
// inputs.json: [{points, times, stroke, page, timed}, …] as lists; answers.json: [{kinds, strange, together}, …].
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";

const [file, inputs, answers, modules] = process.argv.slice(2);
const ort = createRequire(join(modules, "package.json"))("onnxruntime-web");
ort.env.wasm.numThreads = 1;
const session = await ort.InferenceSession.create(readFileSync(file));
const found = [];
for (const given of JSON.parse(readFileSync(inputs, "utf8"))) {
  const said = await session.run({
    points: new ort.Tensor("float64", Float64Array.from(given.points.flat()), [given.points.length, 2]),
    times: new ort.Tensor("float64", Float64Array.from(given.times), [given.times.length]),
    stroke: new ort.Tensor("int64", BigInt64Array.from(given.stroke.map(BigInt)), [given.stroke.length]),
    page: new ort.Tensor("int64", BigInt64Array.from(given.page.map(BigInt)), [given.page.length]),
    timed: new ort.Tensor("float32", Float32Array.from(given.timed), [given.timed.length]),
  });
  found.push(Object.fromEntries(Object.entries(said).map(([name, tensor]) => [name, Array.from(tensor.data)])));
}
writeFileSync(answers, JSON.stringify(found));
