// How a stroke looks: a line whose width follows the pressure. Page units.

import type { InkStroke } from "../wire/protocol";

export const WIDTH = 2.4;

/** The line's width at a pressure from 0 to 1; a mouse, which has none, reports 0.5. */
export const widthAt = (pressure: number): number => WIDTH * (0.45 + 1.1 * Math.min(1, Math.max(0, pressure)));

const CLASSES = 8; // widths that are told apart: more cannot be seen
const SMOOTH = 0.35; // share of a new pressure in the smoothed one: digitizers are noisy

/** Pressures without their noise. */
export function smoothed(pressure: number[]): number[] {
  let now = pressure[0] ?? 0.5;
  return pressure.map((one) => (now += SMOOTH * (one - now)));
}

/** For each segment of a line which of so many widths it has: runs of one width are [first point, last point, class]. */
export function runs(pressure: number[]): [number, number, number][] {
  const found: [number, number, number][] = [];
  const classOf = (k: number): number => Math.min(CLASSES - 1, Math.max(0, Math.floor(((pressure[k - 1]! + pressure[k]!) / 2) * CLASSES)));
  for (let k = 1; k < pressure.length; k++) {
    const last = found.at(-1), width = classOf(k);
    if (last && last[2] === width) last[1] = k;
    else found.push([k - 1, k, width]);
  }
  return found;
}

export interface Painted { path: Path2D; width: number }

/** A stroke as paths in page units, one for each width that it has. */
export function painted({ points, pressure }: Pick<InkStroke, "points" | "pressure">): Painted[] {
  const line = (path: Path2D, from: number, to: number): void => {
    path.moveTo(...points[from]!);
    for (let k = from + 1; k <= to; k++) path.lineTo(...points[k]!);
    if (from === to) path.lineTo(points[from]![0] + 0.01, points[from]![1]);
  };
  if (points.length === 1 || !pressure || pressure.every((one) => one === pressure[0])) {
    const path = new Path2D();
    line(path, 0, points.length - 1);
    return [{ path, width: pressure ? widthAt(pressure[0]!) : WIDTH }];
  }
  const byWidth = new Map<number, Path2D>();
  for (const [from, to, width] of runs(smoothed(pressure))) {
    let path = byWidth.get(width);
    if (!path) byWidth.set(width, (path = new Path2D()));
    line(path, from, to);
  }
  return [...byWidth].map(([width, path]) => ({ path, width: widthAt((width + 0.5) / CLASSES) }));
}
