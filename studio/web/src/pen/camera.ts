import type { Point } from "../wire/protocol";

export interface Box { left: number; top: number; right: number; bottom: number }

/** Which part of the page is seen: screen = (page − origin) · scale, in CSS pixels. A value. */
export interface Camera { x: number; y: number; scale: number }

export const START: Camera = { x: 0, y: 0, scale: 1 };
const FAR = 0.1;
const NEAR = 12;

export const toPage = (camera: Camera, [x, y]: Point): Point => [x / camera.scale + camera.x, y / camera.scale + camera.y];
export const toScreen = (camera: Camera, [x, y]: Point): Point => [(x - camera.x) * camera.scale, (y - camera.y) * camera.scale];

export function panned(camera: Camera, dx: number, dy: number): Camera {
  return { ...camera, x: camera.x - dx / camera.scale, y: camera.y - dy / camera.scale };
}

/** Nearer by a factor; what is under the screen point stays there. */
export function zoomed(camera: Camera, factor: number, about: Point): Camera {
  const scale = Math.min(NEAR, Math.max(FAR, camera.scale * factor));
  const [x, y] = toPage(camera, about);
  return { x: x - about[0] / scale, y: y - about[1] / scale, scale };
}

/** Two fingers: what was between them stays between them. */
export function pinched(camera: Camera, before: [Point, Point], after: [Point, Point]): Camera {
  const middle = ([a, b]: [Point, Point]): Point => [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
  const span = ([a, b]: [Point, Point]): number => Math.max(1, Math.hypot(a[0] - b[0], a[1] - b[1]));
  const from = middle(before), to = middle(after);
  return zoomed(panned(camera, to[0] - from[0], to[1] - from[1]), span(after) / span(before), to);
}

/** Shows a box whole, with a margin, in a window of this size; never nearer than `most`. */
export function fitted(box: Box, width: number, height: number, most = 1.6): Camera {
  const wide = Math.max(box.right - box.left, 1), high = Math.max(box.bottom - box.top, 1);
  const scale = Math.min(most, Math.max(FAR, 0.9 * Math.min(width / wide, height / high)));
  return {
    x: (box.left + box.right) / 2 - width / 2 / scale,
    y: (box.top + box.bottom) / 2 - height / 2 / scale,
    scale,
  };
}

export function boxOf(points: Iterable<Point>): Box | null {
  let box: Box | null = null;
  for (const [x, y] of points) {
    if (!box) box = { left: x, top: y, right: x, bottom: y };
    box.left = Math.min(box.left, x);
    box.right = Math.max(box.right, x);
    box.top = Math.min(box.top, y);
    box.bottom = Math.max(box.bottom, y);
  }
  return box;
}

export function union(boxes: Iterable<Box | null>): Box | null {
  return boxOf([...boxes].flatMap((box) => (box ? ([[box.left, box.top], [box.right, box.bottom]] as Point[]) : [])));
}

export const grown = (box: Box, by: number): Box =>
  ({ left: box.left - by, top: box.top - by, right: box.right + by, bottom: box.bottom + by });
export const holds = (box: Box, [x, y]: Point): boolean =>
  x >= box.left && x <= box.right && y >= box.top && y <= box.bottom;
