// Raw strokes to signs of mathematics with onnxruntime-web, no preprocessing: looks.onnx, then signs.onnx.
//   node raw_signs.mjs FOLDER_OF_WEIGHTS < ink.json
// ink.json: {"strokes": [[[x, y], …], …], "groups": [[0], [1, 2], …], "alone": false}; y grows downward, any unit. A group
// holds the strokes of what may be one sign; alone: each group by itself, not on the line that all strokes make.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import * as ort from "onnxruntime-web";

// In the order of the net's answers; the last answer is that the group is no sign.
const SIGNS = `
  0 1 2 3 4 5 6 7 8 9 a b c d e f g h i j k l m n o p q r s t u v w x y z A B C D E F G H I J K L M N O P Q R
  S T U V W X Y Z \\alpha \\beta \\gamma \\delta \\Delta \\epsilon \\eta \\theta \\lambda \\mu \\pi \\rho
  \\sigma \\tau \\phi \\omega \\Omega + - \\times \\cdot / = < > \\leq \\geq ( [ ) ] | \\Vert . , \\sin \\cos
  \\tan \\log \\ln \\exp ' \\circ \\bar \\sqrt \\vec \\hat
`.trim().split(/\s+/).concat("");
const { strokes, groups, alone = false } = JSON.parse(readFileSync(0, "utf8"));
const points = strokes.flat();
const most = Math.max(...groups.map((group) => group.length));
const padded = groups.flatMap((group) => Array.from({ length: most }, (_, k) => BigInt(group[k] ?? -1)));
let end = 0;
const ends = strokes.map((stroke) => BigInt((end += stroke.length)));
ort.env.wasm.numThreads = 1;
const load = (name) => ort.InferenceSession.create(readFileSync(join(process.argv[2], name)));
const [looks, net] = [await load("looks.onnx"), await load("signs.onnx")];
const seen = await looks.run({
  points: new ort.Tensor("float64", Float64Array.from(points.flatMap(([x, y]) => [x, y])), [points.length, 2]),
  ends: new ort.Tensor("int64", BigInt64Array.from(ends), [ends.length]),
  groups: new ort.Tensor("int64", BigInt64Array.from(padded), [groups.length, most]),
  alone: new ort.Tensor("bool", new Uint8Array(groups.length).fill(alone), [groups.length]),
});
const { scores } = await net.run(seen);
const rows = groups.map((_, k) => scores.data.slice(SIGNS.length * k, SIGNS.length * (k + 1)));
const best = rows.map((row) => Math.max(...row));
const chances = rows.map((row, k) => 1 / row.reduce((sum, score) => sum + Math.exp(score - best[k]), 0));
const signs = rows.map((row, k) => SIGNS[row.indexOf(best[k])]);
console.log(JSON.stringify({ signs, chances }));
