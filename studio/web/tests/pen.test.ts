import { fitted, panned, pinched, toPage, toScreen, zoomed, type Camera } from "../src/pen/camera";
import { runs, smoothed, widthAt } from "../src/pen/look";
import { Palm } from "../src/pen/palm";
import type { Point } from "../src/wire/protocol";
import { assert, near, test } from "./check";

const CAMERA: Camera = { x: 30, y: -12, scale: 1.7 };

test("screen and page are each other's inverse", () => {
  const [x, y] = toPage(CAMERA, toScreen(CAMERA, [123.4, 56.7]));
  near(x, 123.4);
  near(y, 56.7);
});

test("zooming leaves what is under the pointer where it is", () => {
  const spot: Point = [200, 90], before = toPage(CAMERA, spot), after = toPage(zoomed(CAMERA, 1.9, spot), spot);
  near(after[0], before[0]);
  near(after[1], before[1]);
});

test("panning there and back is nothing", () => {
  const back = panned(panned(CAMERA, 40, -7), -40, 7);
  near(back.x, CAMERA.x);
  near(back.y, CAMERA.y);
});

test("a pinch keeps the page under both fingers", () => {
  const before: [Point, Point] = [[100, 100], [200, 100]], after: [Point, Point] = [[80, 120], [280, 120]];
  const camera = pinched(CAMERA, before, after);
  for (const k of [0, 1] as const) {
    const was = toPage(CAMERA, before[k]), is = toPage(camera, after[k]);
    near(is[0], was[0]);
    near(is[1], was[1]);
  }
});

test("a page that is fitted lies within the window", () => {
  const camera = fitted({ left: -50, top: 20, right: 900, bottom: 300 }, 800, 600);
  for (const corner of [[-50, 20], [900, 300]] as Point[]) {
    const [x, y] = toScreen(camera, corner);
    assert.ok(x >= 0 && x <= 800 && y >= 0 && y <= 600);
  }
});

test("harder is wider, and never without end", () => {
  assert.ok(widthAt(0.2) < widthAt(0.8));
  assert.equal(widthAt(7), widthAt(1));
  assert.equal(widthAt(-1), widthAt(0));
});

test("runs of one width cover the stroke without a gap", () => {
  const pressure = smoothed(Array.from({ length: 60 }, (_, k) => 0.5 + 0.5 * Math.sin(k / 3)));
  const found = runs(pressure);
  assert.equal(found[0]![0], 0);
  assert.equal(found.at(-1)![1], 59);
  found.slice(1).forEach(([from], k) => assert.equal(from, found[k]![1]));
});

test("before a pen is seen a finger draws; afterwards it moves the page", () => {
  const palm = new Palm();
  assert.equal(palm.part("touch", 0, 20, 0, false), "draw");
  assert.equal(palm.part("pen", 100, 1, 0, false), "draw");
  palm.penAt(200, false);
  assert.equal(palm.part("touch", 5000, 20, 0, false), "move");
});

test("a palm does nothing while the pen draws, nor shortly after", () => {
  const palm = new Palm();
  palm.part("pen", 0, 1, 0, false);
  assert.equal(palm.part("touch", 5, 20, 0, false), "ignore");
  palm.penAt(1000, false);
  assert.equal(palm.part("touch", 1300, 20, 0, false), "ignore");
  assert.equal(palm.part("touch", 9000, 90, 0, false), "ignore");
});

test("a mouse draws with its first button and moves the page with the middle one", () => {
  const palm = new Palm();
  assert.equal(palm.part("mouse", 0, 1, 0, false), "draw");
  assert.equal(palm.part("mouse", 0, 1, 1, false), "move");
  assert.equal(palm.part("mouse", 0, 1, 0, true), "move");
});
