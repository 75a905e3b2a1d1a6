import { csv } from "../src/graph/csv";
import { between, coil } from "../src/page/geometry";
import { fromSegment, hit } from "../src/page/page";
import { advanced } from "../src/stage/player";
import { posed, Run, sizes, type Series } from "../src/stage/run";
import { Outbox } from "../src/wire/outbox";
import { unpacked } from "../src/wire/binary";
import type { RunHead } from "../src/wire/protocol";
import { assert, near, test } from "./check";

const HEAD: RunHead = {
  type: "run", run: 1, seconds: 1, rate: 60, links: ["C"], perMetre: 100, notices: [],
  bodies: [{ label: "A", kind: "circle", mass: 1, radius: 10 }],
};
const row = (k: number, broken = false): number[] =>
  [k / 60, 2 * k, -k, 0.1 * k, ...(broken ? [NaN, NaN, NaN, NaN] : [0, 0, 2 * k, -k])];

function run(rows: number, broken = Infinity): Run {
  const made = new Run(HEAD);
  for (let k = 0; k < rows; k++) made.add(1, 8, new Float32Array(row(k, k >= broken)), []);
  return made;
}

test("between two frames a body is between their places", () => {
  const pose = run(10).pose("A", 4.5 / 60)!;
  near(pose.x, 9, 1e-4);
  near(pose.y, -4.5, 1e-4);
});

test("a link that is broken is not shown, and was before", () => {
  const made = run(10, 5), drawn = { kind: "wire", start: [0, 0], end: [1, 1] } as const;
  assert.equal(made.placed("C", { ...drawn, start: [0, 0], end: [1, 1] }, 9 / 60), null);
  assert.ok(made.placed("C", { ...drawn, start: [0, 0], end: [1, 1] }, 2 / 60));
});

test("the clock never runs beyond what has arrived", () => {
  near(advanced(0.2, 0.1, 0.5, 1), 0.25);
  assert.equal(advanced(0.98, 0.1, 1, 1), 1);
});

test("a piece of another run is refused", () => {
  assert.throws(() => run(2).add(1, 5, new Float32Array(5), []), RangeError);
});

test("a posed block is turned about its middle, clockwise to the eye", () => {
  const shape = posed({ label: "B", kind: "polygon", mass: 1, vertices: [[10, 0], [0, 5], [-10, 0]] }, { x: 100, y: 50, angle: Math.PI / 2 });
  assert.ok(shape.kind === "polygon");
  near((shape as { vertices: [number, number][] }).vertices[0]![0], 100);
  near((shape as { vertices: [number, number][] }).vertices[0]![1], 60);
});

test("the size of a vector is its length, of a scalar itself", () => {
  const series = (vector: boolean): Series => ({ body: "A", quantity: "v", unit: "m/s", vector, values: new Float32Array([3, 4, -6, 8]) });
  assert.deepEqual(sizes(series(true)), [5, 10]);
  assert.deepEqual(sizes(series(false)), [3, 4, -6, 8]);
});

test("CSV has a column for the time, one for a scalar and two for a vector, and quotes what it must", () => {
  const text = csv([0, 0.5], [
    { body: "A", quantity: 'the "T"', unit: "N", vector: true, values: new Float32Array([1, 2, 3, NaN]) },
    { body: "B", quantity: "speed", unit: "m/s", vector: false, values: new Float32Array([0.5, 0.25]) },
  ]);
  const [head, first, second] = text.split("\r\n");
  assert.equal(head, '"t (s)","the ""T"" x of A (N)","the ""T"" y of A (N)","speed of B (m/s)"');
  assert.equal(first, "0,1,2,0.5");
  assert.equal(second, "0.5,3,,0.25");
});

test("a binary message says its own length, or is refused", () => {
  const text = new TextEncoder().encode('{"type":"piece"} '.padEnd(20));
  const data = new Uint8Array(4 + text.length + 8);
  new DataView(data.buffer).setUint32(0, text.length, true);
  data.set(text, 4);
  new DataView(data.buffer).setFloat32(4 + text.length, 1.5, true);
  const { told, numbers } = unpacked(data.buffer);
  assert.equal(told.type, "piece");
  assert.deepEqual([...numbers], [1.5, 0]);
  assert.throws(() => unpacked(new ArrayBuffer(2)), RangeError);
  assert.throws(() => unpacked(new Uint8Array([200, 0, 0, 0]).buffer), RangeError);
});

test("what is not acknowledged outlives the tab, in order", () => {
  const kept = new Map<string, string>();
  const shelf = { getItem: (n: string) => kept.get(n) ?? null, setItem: (n: string, v: string) => void kept.set(n, v), removeItem: (n: string) => void kept.delete(n) };
  const box = new Outbox(shelf, "page");
  for (const key of ["a", "b", "c"]) box.put({ key, type: "stroke" });
  box.settle("b");
  box.keep();
  assert.deepEqual(new Outbox(shelf, "page").all().map((one) => one.key), ["a", "c"]);
  for (const key of ["a", "c"]) box.settle(key);
  box.keep();
  assert.equal(kept.size, 0);
});

test("a spring's zig-zag begins and ends at its ends, whatever its coils", () => {
  for (const coils of [0.4, 3, 12]) {
    const points = coil([0, 0], [30, 40], coils, 12);
    assert.deepEqual(points[0], [0, 0]);
    near(points.at(-1)![0], 30);
    near(points.at(-1)![1], 40);
  }
});

test("half way between two rings is a ring half way", () => {
  const shape = between({ kind: "circle", centre: [0, 0], radius: 10 }, { kind: "circle", centre: [10, 20], radius: 20 }, 0.5);
  assert.deepEqual(shape, { kind: "circle", centre: [5, 10], radius: 15 });
});

test("a point in a triangle is in it, one beside it is not; a wire is hit near its line", () => {
  const triangle = { kind: "polygon" as const, vertices: [[0, 0], [100, 0], [100, 80]] as [number, number][] };
  assert.ok(hit(triangle, [80, 20]));
  assert.ok(!hit(triangle, [20, 60]));
  assert.ok(hit({ kind: "wire", start: [0, 0], end: [100, 0] }, [50, 6]));
  near(fromSegment([0, 0], [10, 0], [13, 4]), 5);
});
