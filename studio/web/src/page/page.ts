// What the browser knows of a page: the server's last word, and the strokes that it has not answered yet.

import { boxOf, grown, union, type Box } from "../pen/camera";
import type { Component, InkStroke, Line, Point, Shape, State, Verdict } from "../wire/protocol";

export const EMPTY: State = {
  type: "state", page: "", seq: 0, title: "", name: "Untitled", analyzed: false, loose: 0, strokes: [], components: [],
  lines: [], associations: [], corrections: [], notices: [], selected: { strokes: [], components: [], lines: [] },
  undo: null, redo: null, next: "",
};

export class PageModel {
  state: State = EMPTY;
  verdicts: Verdict[] = [];
  readonly ink = new Map<string, InkStroke>();
  /** Strokes that the server has not answered, by key; shown as drawn until it says otherwise. */
  readonly pending = new Map<string, InkStroke>();

  take(state: State): void {
    this.state = state;
    for (const { id } of state.strokes) this.pending.delete(id);
  }

  drawn(id: string, stroke: InkStroke | undefined): void {
    const known = stroke ?? this.pending.get(id) ?? this.ink.get(id);
    if (known) this.ink.set(id, known);
    this.pending.delete(id);
    if (!this.state.strokes.some((one) => one.id === id)) this.state.strokes.push({ id, dx: 0, dy: 0, kind: null });
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

  lineBox(line: Line): Box | null { return union(line.strokes.map((id) => this.strokeBox(id))); }

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
