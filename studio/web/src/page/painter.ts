// The page on its canvases: paper and things below, finished ink above, formulas over both.

import type { Camera } from "../pen/camera";
import { DryInk, type Layer } from "../pen/layers";
import { drawArrows, type Chosen } from "../stage/arrows";
import type { Run } from "../stage/run";
import { colours, still } from "../ui/theme";
import type { Component, Shape } from "../wire/protocol";
import type { Formulas } from "./formulas";
import type { PageModel } from "./page";
import { between } from "./geometry";
import type { Ground } from "./ground";
import { draw } from "./shapes";

const CORRECTING = 450; // ms: ink becomes shapes, and shapes what they were corrected to

export interface Scene {
  camera: Camera;
  run: Run | null;
  time: number;
  chosen: Chosen[];
  scale: Map<string, number>;
  bright: Set<string>;
  brightLines: Set<number>;
  drag: [number, number] | null;
  comparing: boolean;
  /** Strokes that have just turned out to be gestures, by id, with the time when they did. */
  fading: Map<string, { points: [number, number][]; since: number }>;
}

export class Painter {
  private readonly dryInk = new DryInk();
  private became = new Map<string, { from: Shape; since: number }>();
  private known = new Map<string, string>();

  constructor(private ground: Ground, private things: Layer, private dry: Layer, private page: PageModel, private formulas: Formulas) {}

  /** The page has changed: what is new or has moved goes there by itself. */
  changed(): void {
    const now = performance.now(), known = new Map<string, string>();
    for (const part of this.page.state.components) {
      const is = JSON.stringify(part.shape);
      const before = this.known.get(part.label);
      if (before !== is && !still()) {
        this.became.set(part.label, { from: before ? (JSON.parse(before) as Shape) : part.drawn, since: now });
      }
      known.set(part.label, is);
    }
    this.known = known;
  }

  /** Whether something is on its way still. */
  get busy(): boolean { return this.became.size > 0; }

  ink(scene: Scene): void {
    const context = this.dry.begin(scene.camera), { ink } = colours();
    this.dry.canvas.style.opacity = scene.run ? "0.55" : "1";
    const { state, pending } = this.page;
    const owned = new Set(state.components.flatMap((part) => part.strokes));
    const selected = new Set(state.selected.strokes);
    const inLines = new Set(state.lines.filter((line) => state.selected.lines.includes(line.line)).flatMap((line) => line.strokes));
    for (const part of state.components) if (state.selected.components.includes(part.label)) part.strokes.forEach((id) => selected.add(id));
    let drawn = pending.size + scene.fading.size;
    for (const { id, dx, dy, kind } of state.strokes) {
      const stroke = this.page.ink.get(id);
      if (!stroke) continue;
      const chosen = selected.has(id) || inLines.has(id);
      const hidden = owned.has(id) || kind === "tap" || kind === "scribble" || kind === "lasso";
      const alpha = hidden ? (scene.comparing ? 0.5 : this.fadingIn(id)) : 1;
      if (alpha <= 0.01) continue;
      drawn++;
      const [mx, my] = chosen && scene.drag ? scene.drag : [0, 0];
      this.dryInk.draw(context, { stroke, dx: dx + mx, dy: dy + my, alpha, colour: chosen ? colours().accent : ink });
    }
    for (const stroke of pending.values()) this.dryInk.draw(context, { stroke, dx: 0, dy: 0, alpha: 1, colour: ink });
    this.dry.canvas.hidden = drawn === 0;
    const now = performance.now();
    for (const [id, { points, since }] of scene.fading) {
      const alpha = 0.8 * (1 - (now - since) / 350);
      if (alpha <= 0) scene.fading.delete(id);
      else this.dryInk.draw(context, { stroke: { id, points, pressure: null, pointer: "" }, dx: 0, dy: 0, alpha, colour: colours().accent });
    }
  }

  /** One more finished stroke, without drawing the others again. */
  addStroke(id: string, camera: Camera): void {
    const stroke = this.page.pending.get(id);
    if (!stroke) return;
    this.dry.canvas.hidden = false;
    this.dry.aim(camera);
    this.dryInk.draw(this.dry.context, { stroke, dx: 0, dy: 0, alpha: 1, colour: colours().ink });
  }

  private fadingIn(id: string): number {
    const part = this.page.state.components.find((one) => one.strokes.includes(id));
    const turn = part && this.became.get(part.label);
    return turn ? Math.max(0, 1 - (performance.now() - turn.since) / CORRECTING) : 0;
  }

  draw(scene: Scene): void {
    this.ground.draw(scene.camera, scene.run, scene.time);
    const context = this.things.begin(scene.camera), now = performance.now();
    const { state } = this.page;
    const parts = [...state.components].sort((a, b) => order(a) - order(b));
    for (const [label, turn] of this.became) if (now - turn.since > CORRECTING) this.became.delete(label);
    for (const part of parts) this.part(context, part, scene, now);
    if (scene.run) drawArrows(context, scene.run, scene.chosen, scene.time, scene.scale);
    else this.leaders(context, scene);
    this.frame(context, scene);
    this.formulas.place(scene.camera);
  }

  private part(context: CanvasRenderingContext2D, part: Component, scene: Scene, now: number): void {
    const selected = this.page.state.selected.components.includes(part.label);
    const bright = scene.bright.has(part.label);
    if (scene.run) {
      const placed = scene.run.placed(part.label, part.shape, scene.time);
      if (placed !== null) draw(context, part, placed?.shape ?? part.shape, { spoke: placed?.spoke, bright });
      return;
    }
    const turn = this.became.get(part.label), t = turn ? ease((now - turn.since) / CORRECTING) : 1;
    const shape = scene.comparing ? part.drawn : turn ? between(turn.from, part.shape, t) : part.shape;
    context.save();
    if (selected && scene.drag) context.translate(...scene.drag);
    draw(context, part, shape, { bright, selected, alpha: turn ? 0.25 + 0.75 * t : 1 });
    context.restore();
  }

  /** From formulas to what they govern, of what the person looks at (row P4). */
  private leaders(context: CanvasRenderingContext2D, scene: Scene): void {
    for (const one of this.page.state.associations) {
      if (!scene.bright.has(one.component) && !scene.brightLines.has(one.line)) continue;
      const line = this.page.state.lines.find((other) => other.line === one.line);
      const root = line && this.formulas.root(line);
      if (!root) continue;
      context.strokeStyle = colours().accent;
      context.lineWidth = 1.6;
      context.setLineDash([5, 4]);
      context.beginPath();
      context.moveTo(...root);
      context.lineTo(...one.anchor);
      context.stroke();
      context.setLineDash([]);
      context.beginPath();
      context.arc(...one.anchor, 4, 0, 2 * Math.PI);
      context.fillStyle = colours().accent;
      context.fill();
    }
  }

  private frame(context: CanvasRenderingContext2D, scene: Scene): void {
    const box = scene.run ? null : this.page.selectionBox();
    if (!box) return;
    const [dx, dy] = scene.drag ?? [0, 0];
    context.strokeStyle = colours().accent;
    context.lineWidth = 1.5 / scene.camera.scale;
    context.setLineDash([6 / scene.camera.scale, 4 / scene.camera.scale]);
    context.strokeRect(box.left + dx, box.top + dy, box.right - box.left, box.bottom - box.top);
    context.setLineDash([]);
  }
}

const order = (part: Component): number => (part.kind === "circle" || part.kind === "polygon" ? 1 : 0);
const ease = (t: number): number => { const s = Math.min(1, Math.max(0, t)); return s * s * (3 - 2 * s); };
