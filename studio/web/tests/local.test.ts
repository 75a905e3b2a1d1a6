import { answers, feeds, things, type Recipe } from "../src/local/feeds";
import { assert, near, test } from "./check";

const RECIPE: Recipe = { kinds: ["circle", "wire", "math"], reject_above: 0.5 };
const stroke = (n: number) => ({ points: Array.from({ length: n }, (_, k): [number, number] => [k, 2 * k]), times: Array.from({ length: n }, (_, k) => k / 100) });

test("every point is given once, with its time and its stroke", () => {
  const given = feeds([stroke(3), stroke(2)]);
  assert.deepEqual([...given.points], [0, 0, 1, 2, 2, 4, 0, 0, 1, 2]);
  assert.deepEqual([...given.stroke].map(Number), [0, 0, 0, 1, 1]);
  assert.equal(given.page.length, 2);
  assert.equal(given.times.length, 5);
});

test("a lone point is given twice", () => assert.equal(feeds([stroke(1)]).points.length, 4));

test("the likeliest kind is claimed, and what is too strange is rejected", () => {
  const [first, second] = answers([0.1, 0.7, 0.2, 0.8, 0.1, 0.1], [0.1, 0.9], RECIPE);
  assert.equal(first!.kind, "wire");
  near(first!.confidence, 0.7);
  assert.ok(!first!.rejected && second!.rejected);
});

test("strokes of one thing are one thing, also through a third, and its kind is what they say together", () => {
  const all = answers([0.6, 0.4, 0, 0.1, 0.9, 0, 0.1, 0.9, 0, 0, 0, 1], [0, 0, 0, 0], RECIPE);
  const bound = [1, 0.9, 0, 0, 0.9, 1, 0.8, 0, 0, 0.8, 1, 0, 0, 0, 0, 1];
  const found = things(all, bound);
  assert.deepEqual(found.map((one) => one.strokes), [[0, 1, 2], [3]]);
  assert.deepEqual(found.map((one) => one.kind), ["wire", "math"]);
});
