// Shapes as numbers. Page units.

import type { Point, Shape } from "../wire/protocol";

/** A zig-zag with a spring's coils and width between straight leads. */
export function coil(start: Point, end: Point, coils: number, width: number): Point[] {
  const dx = end[0] - start[0], dy = end[1] - start[1], length = Math.hypot(dx, dy) || 1;
  const teeth = 2 * Math.min(200, Math.max(1, Math.round(coils)));
  const at = (share: number, side: number): Point =>
    [start[0] + share * dx - (side * dy * width) / (2 * length), start[1] + share * dy + (side * dx * width) / (2 * length)];
  return [
    at(0, 0), at(0.1, 0),
    ...Array.from({ length: teeth }, (_, k) => at(0.1 + (0.8 * (k + 0.5)) / teeth, k % 2 ? -1 : 1)),
    at(0.9, 0), at(1, 0),
  ];
}

/** Between two shapes of one kind; the second where they cannot be compared. */
export function between(a: Shape, b: Shape, t: number): Shape {
  if (t >= 1) return b;
  const mix = (p: Point, q: Point): Point => [p[0] + (q[0] - p[0]) * t, p[1] + (q[1] - p[1]) * t];
  if (a.kind === "circle" && b.kind === "circle") {
    return { ...b, centre: mix(a.centre, b.centre), radius: a.radius + (b.radius - a.radius) * t };
  }
  if (a.kind === "polygon" && b.kind === "polygon") {
    return a.vertices.length === b.vertices.length
      ? { ...b, vertices: b.vertices.map((vertex, k) => mix(a.vertices[k]!, vertex)) }
      : t < 0.5 ? a : b;
  }
  if ("start" in a && "start" in b) return { ...b, start: mix(a.start, b.start), end: mix(a.end, b.end) } as Shape;
  return b;
}
