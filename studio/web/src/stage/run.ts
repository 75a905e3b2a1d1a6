// The numbers of a run: rows of time, poses and ends, as they arrive. See studio/motion.py.

import type { Body, Happening, Point, RunHead, Shape } from "../wire/protocol";

export interface Placed { shape: Shape; spoke?: number }
export interface Series { body: string; quantity: string; unit: string; vector: boolean; values: Float32Array }

export class Run {
  readonly columns: number;
  readonly events: Happening[] = [];
  readonly series = new Map<string, Series>();
  told: string[] = [];
  observable: Record<string, string[]> = {};
  ended = false;
  rows = 0;
  private data = new Float32Array(0);

  constructor(readonly head: RunHead) {
    this.columns = 1 + 3 * head.bodies.length + 4 * head.links.length;
  }

  add(rows: number, columns: number, numbers: Float32Array, events: Happening[]): void {
    if (columns !== this.columns || numbers.length !== rows * columns) throw new RangeError("a piece of another run");
    const needed = (this.rows + rows) * columns;
    if (needed > this.data.length) {
      const larger = new Float32Array(Math.max(needed, 2 * this.data.length));
      larger.set(this.data.subarray(0, this.rows * columns));
      this.data = larger;
    }
    this.data.set(numbers, this.rows * columns);
    this.rows += rows;
    this.events.push(...events);
  }

  /** Seconds that have arrived. */
  get until(): number { return this.rows ? this.data[(this.rows - 1) * this.columns]! : 0; }

  time(row: number): number { return this.data[row * this.columns]!; }

  /** The frame at or before a time, and how far to the next one. */
  at(seconds: number): { row: number; share: number } {
    const exact = Math.min(Math.max(0, seconds * this.head.rate), Math.max(0, this.rows - 1));
    const row = Math.min(Math.floor(exact + 1e-6), Math.max(0, this.rows - 1));
    return { row, share: row + 1 < this.rows ? exact - row : 0 };
  }

  private value(row: number, share: number, column: number): number {
    const a = this.data[row * this.columns + column]!;
    return share > 0 ? a + share * (this.data[(row + 1) * this.columns + column]! - a) : a;
  }

  /** Where a body's centre is, and its angle; null for one that does not move. */
  pose(label: string, seconds: number): { x: number; y: number; angle: number } | null {
    const k = this.head.bodies.findIndex((body) => body.label === label);
    if (k < 0 || !this.rows) return null;
    const { row, share } = this.at(seconds), c = 1 + 3 * k;
    return { x: this.value(row, share, c), y: this.value(row, share, c + 1), angle: this.value(row, share, c + 2) };
  }

  /** A component's shape at a time; null for a link that is broken, undefined for what the run does not move. */
  placed(label: string, drawn: Shape, seconds: number): Placed | null | undefined {
    const pose = this.pose(label, seconds);
    if (pose) {
      const body = this.head.bodies.find((one) => one.label === label)!;
      return { shape: posed(body, pose), spoke: body.radius === undefined ? undefined : pose.angle };
    }
    const k = this.head.links.indexOf(label);
    if (k < 0 || !this.rows || !("start" in drawn)) return undefined;
    const { row, share } = this.at(seconds), c = 1 + 3 * this.head.bodies.length + 4 * k;
    const [x1, y1, x2, y2] = [0, 1, 2, 3].map((n) => this.value(row, share, c + n)) as [number, number, number, number];
    return [x1, y1, x2, y2].every(Number.isFinite) ? { shape: { ...drawn, start: [x1, y1], end: [x2, y2] } } : null;
  }

  /** Where the centre of a body, by its place in the head, is in a frame. */
  centre(body: number, row: number): Point {
    const at = row * this.columns + 1 + 3 * body;
    return [this.data[at]!, this.data[at + 1]!];
  }

  times(): number[] { return Array.from({ length: this.rows }, (_, row) => this.time(row)); }

  /** A vector observed of a body at a time, SI; null where it is not there. */
  vector(body: string, quantity: string, seconds: number): Point | null {
    const series = this.series.get(`${body} ${quantity}`);
    if (!series?.vector) return null;
    const { row } = this.at(seconds), x = series.values[2 * row], y = series.values[2 * row + 1];
    return x === undefined || y === undefined || !Number.isFinite(x) || !Number.isFinite(y) ? null : [x, y];
  }
}

export function posed(body: Body, { x, y, angle }: { x: number; y: number; angle: number }): Shape {
  if (body.radius !== undefined) return { kind: "circle", centre: [x, y], radius: body.radius };
  const cos = Math.cos(angle), sin = Math.sin(angle);
  return {
    kind: "polygon",
    vertices: (body.vertices ?? []).map(([u, v]) => [x + u * cos - v * sin, y + u * sin + v * cos]),
  };
}

/** |value| of a vector's series, a scalar's as it is. */
export function sizes(series: Series): number[] {
  if (!series.vector) return Array.from(series.values);
  return Array.from({ length: series.values.length / 2 }, (_, k) => Math.hypot(series.values[2 * k]!, series.values[2 * k + 1]!));
}
