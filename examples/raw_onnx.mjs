// Raw ink into the ONNX file with onnxruntime-web, no preprocessing:  node raw_onnx.mjs strokes.onnx < ink.json
// ink.json: the strokes of one page, [[[x, y, t_seconds or null], …], …]; y grows downward, any unit.
import { readFileSync } from "node:fs";
import * as ort from "onnxruntime-web";

const KINDS = ["circle", "polygon", "spring", "wire", "arrow", "tap", "scribble", "lasso", "math"];
const page = JSON.parse(readFileSync(0, "utf8"));
const points = page.flat();
const tensor = (type, values, shape) => new ort.Tensor(type, values, shape ?? [values.length]);
const timed = page.map((stroke) => stroke[0][2] != null);
ort.env.wasm.numThreads = 1;
const session = await ort.InferenceSession.create(readFileSync(process.argv[2]));
const { kinds, strange, together } = await session.run({
  points: tensor("float64", Float64Array.from(points.flatMap(([x, y]) => [x, y])), [points.length, 2]),
  times: tensor("float64", Float64Array.from(points.map(([, , t]) => t ?? 0))),
  stroke: tensor("int64", BigInt64Array.from(page.flatMap((stroke, k) => stroke.map(() => BigInt(k))))),
  page: tensor("int64", new BigInt64Array(page.length)),
  timed: tensor("float32", Float32Array.from(timed.map(Number))),
});
const scores = page.map((_, k) => Array.from(kinds.data.slice(9 * k, 9 * k + 9)));
const names = scores.map((row) => KINDS[row.indexOf(Math.max(...row))]);
console.log(JSON.stringify({ names, scores, strange: Array.from(strange.data), together: Array.from(together.data) }));
