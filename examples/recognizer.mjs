// A recognizer in JavaScript: straight strokes are wires, closed ones circles, the rest is mathematics.
//   inklined compare --recognizer "run:node examples/recognizer.mjs" geometric
import { createInterface } from "node:readline";

const distance = ([ax, ay], [bx, by]) => Math.hypot(ax - bx, ay - by);

function claim(stroke) {
  let length = 0;
  for (let k = 1; k < stroke.length; k++) length += distance(stroke[k - 1], stroke[k]);
  const open = length ? distance(stroke[0], stroke.at(-1)) / length : 0; // 0: the ends meet; 1: as straight as can be
  return { kind: open < 0.1 ? "circle" : open > 0.95 ? "wire" : "math", confidence: 0.8 };
}

for await (const line of createInterface({ input: process.stdin })) {
  const asked = JSON.parse(line);
  const answer = "kinds" in asked
    ? { name: "simple-js", claims: ["circle", "wire", "math"] }
    : { page: asked.page, claims: asked.strokes.map(claim) };
  process.stdout.write(JSON.stringify(answer) + "\n");
}
