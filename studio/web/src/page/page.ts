// What the browser knows of a page: the server's last word, and the strokes that it has not answered yet.

import { boxOf, grown, union, type Box } from "../pen/camera";
import type { Component, Drawn, InkStroke, Line, LiveLine, Point, Shape, State, Verdict } from "../wire/protocol";

export const EMPTY: State = {
  type: "state", page: "", seq: 0, title: "", name: "Untitled", analyzed: false, loose: 0, strokes: [], components: [],
  lines: [], associations: [], corrections: [], notices: [], selected: { strokes: [], components: [], lines: [] },
  undo: null, redo: null, next: "",
};

export class PageModel {
  state: State = EMPTY;
  verdicts: Verdict[] = [];
  /** What is being written, as it read when the server looked last. */
  live: LiveLine[] = [];
  readonly ink = new Map<string, InkStroke>();
  /** Strokes that the server has not answered, by key; shown as drawn until it says otherwise. */
  readonly pending = new Map<string, InkStroke>();

  /** Another page is to come. */
  empty(): void {
    this.ink.clear();
    this.pending.clear();
    this.live = [];
    this.verdicts = [];
  }

  take(state: State): void {
    for (const { id } of state.strokes) {
      const mine = this.pending.get(id);
      if (mine) this.ink.set(id, mine);
      this.pending.delete(id);
    }
    this.state = state;
  }

  /** A stroke, somebody's or one's own, is on the page. */
  drawn({ id, stroke, seq, undo, redo, next, loose, name }: Drawn): void {
    const known = stroke ?? this.pending.get(id) ?? this.ink.get(id);
    if (known) this.ink.set(id, known);
    this.pending.delete(id);
    if (!this.state.strokes.some((one) => one.id === id)) this.state.strokes.push({ id, dx: 0, dy: 0, kind: null });
    Object.assign(this.state, { seq, undo, redo, next, loose, name });
  }

  /** What is being written as far as it is still so: its ink is there, and nobody has read it as anything since. */
  writing(): LiveLine[] {
    const { strokes, components, lines } = this.state;
    const there = new Set(strokes.map((one) => one.id));
    for (const part of components) for (const id of part.strokes) there.delete(id);
    const read = new Set(lines.filter((line) => line.text !== null).map((line) => [...line.strokes].sort().join()));
    return this.live.filter((one) => one.strokes.every((id) => there.has(id)) && !read.has([...one.strokes].sort().join()));
  }

  component(label: string): Component | undefined { return this.state.components.find((part) => part.label === label); }
  associationsOf(label: string): Line[] {
    const lines = new Set(this.state.associations.filter((one) => one.component === label).map((one) => one.line));
    return this.state.lines.filter((line) => lines.has(line.line));
  }

  strokeBox(id: string): Box | null {
    const stroke = this.ink.get(id), placed = this.state.strokes.find((one) => one.id === id);
    if (!stroke || !placed) return null;
    const box = boxOf(stroke.points);
    return box && { left: box.left + placed.dx, right: box.right + placed.dx, top: box.top + placed.dy, bottom: box.bottom + placed.dy };
  }

  /** Around the ink of a line, or of any strokes. */
  lineBox(line: Line): Box | null { return this.inkBox(line.strokes); }
  inkBox(strokes: string[]): Box | null { return union(strokes.map((id) => this.strokeBox(id))); }

  /** The stroke that lies nearest to a place, within reach. */
  nearest(at: Point, reach: number): string | null {
    let best: string | null = null, least = reach;
    for (const { id, dx, dy } of this.state.strokes) {
      const points = this.ink.get(id)?.points ?? [];
      for (let k = 0; k < points.length; k++) {
        const a = points[Math.max(0, k - 1)]!, b = points[k]!;
        const away = fromSegment([a[0] + dx, a[1] + dy], [b[0] + dx, b[1] + dy], at);
        if (away < least) { least = away; best = id; }
      }
    }
    return best;
  }

  /** Around all that is selected, null where nothing is. */
  selectionBox(): Box | null {
    const { strokes, components, lines } = this.state.selected;
    const chosen = this.state.lines.filter((line) => lines.includes(line.line));
    const box = union([
      ...strokes.map((id) => this.strokeBox(id)),
      ...components.map((label) => { const part = this.component(label); return part ? shapeBox(part.shape) : null; }),
      ...chosen.map((line) => this.lineBox(line) ?? (line.at && typedBox(line.text ?? "", line.at))),
    ]);
    return box && grown(box, 8);
  }

  /** Around everything. */
  box(): Box | null {
    return union([
      ...this.state.strokes.map(({ id }) => this.strokeBox(id)),
      ...this.state.components.map((part) => shapeBox(part.shape)),
      ...this.state.lines.map((line) => line.at && typedBox(line.text ?? "", line.at)),
    ]);
  }
}

export function shapeBox(shape: Shape): Box {
  switch (shape.kind) {
    case "circle": {
      const [x, y] = shape.centre;
      return grown({ left: x, right: x, top: y, bottom: y }, shape.radius);
    }
    case "polygon": return boxOf(shape.vertices)!;
    default: return boxOf([shape.start, shape.end])!;
  }
}

export function typedBox(text: string, [x, y]: Point): Box {
  return { left: x - 5 * Math.max(3, text.length), right: x + 5 * Math.max(3, text.length), top: y - 14, bottom: y + 14 };
}

/** Whether a point lies in a shape, or within reach of a line. */
export function hit(shape: Shape, [x, y]: Point, reach = 8): boolean {
  switch (shape.kind) {
    case "circle": return Math.hypot(x - shape.centre[0], y - shape.centre[1]) <= shape.radius + reach / 2;
    case "polygon": {
      let inside = false;
      shape.vertices.forEach(([ax, ay], k) => {
        const [bx, by] = shape.vertices[(k + 1) % shape.vertices.length]!;
        if (ay > y !== by > y && x < ((bx - ax) * (y - ay)) / (by - ay) + ax) inside = !inside;
      });
      return inside;
    }
    default: return fromSegment(shape.start, shape.end, [x, y]) <= reach;
  }
}

export function fromSegment([ax, ay]: Point, [bx, by]: Point, [x, y]: Point): number {
  const length = (bx - ax) ** 2 + (by - ay) ** 2;
  const t = length ? Math.min(1, Math.max(0, ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / length)) : 0;
  return Math.hypot(x - ax - t * (bx - ax), y - ay - t * (by - ay));
}

/** The middle of a shape: where an association that is made by keyboard is tapped. */
export function middle(shape: Shape): Point {
  switch (shape.kind) {
    case "circle": return shape.centre;
    case "polygon": {
      const n = shape.vertices.length;
      return [shape.vertices.reduce((sum, v) => sum + v[0], 0) / n, shape.vertices.reduce((sum, v) => sum + v[1], 0) / n];
    }
    default: return [(shape.start[0] + shape.end[0]) / 2, (shape.start[1] + shape.end[1]) / 2];
  }
}
