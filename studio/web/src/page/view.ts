// What is seen of a page: its layers one over the other, the part of it that the window shows, and when to draw again.

import { boxOf, fitted, grown, START, toPage, zoomed, type Camera } from "../pen/camera";
import { Layer, WetInk } from "../pen/layers";
import type { Point } from "../wire/protocol";
import { colours, onTheme } from "../ui/theme";
import { png } from "./files";
import type { Formulas } from "./formulas";
import { Ground } from "./ground";
import type { PageModel } from "./page";
import { Painter, type Scene } from "./painter";

export class View {
  readonly scene: Scene = {
    camera: START, run: null, time: 0, chosen: [], scale: new Map(), bright: new Set(), brightLines: new Set(), drag: null,
    comparing: false, fading: new Map(),
  };
  readonly wet: WetInk;
  readonly painter: Painter;
  private readonly layers: { ground: Layer; things: Layer; dry: Layer; wet: Layer };
  private readonly ground: Ground;
  private queued = false;
  private inkStale = true;

  /** playing: whether a run draws its own frames. */
  constructor(private paper: HTMLElement, private page: PageModel, private formulas: Formulas, private playing: () => boolean) {
    this.layers = { ground: new Layer(paper, "ground"), things: new Layer(paper, "things"), dry: new Layer(paper, "dry"), wet: new Layer(paper, "wet", true) };
    this.wet = new WetInk(this.layers.wet);
    this.ground = new Ground(this.layers.ground);
    this.painter = new Painter(this.ground, this.layers.things, this.layers.dry, page, formulas);
    new ResizeObserver(() => this.resize()).observe(paper);
    onTheme(() => this.stale(true));
    this.resize();
  }

  /** Where a point of the screen, as the client sees it, lies on the page. */
  at(clientX: number, clientY: number): Point {
    const paper = this.paper.getBoundingClientRect();
    return toPage(this.scene.camera, [clientX - paper.left, clientY - paper.top]);
  }

  look(camera: Camera): void {
    this.scene.camera = camera;
    this.wet.clear(camera);
    this.stale(true);
  }

  zoom(factor: number): void {
    const { clientWidth: wide, clientHeight: high } = this.paper;
    this.look(zoomed(this.scene.camera, factor, [wide / 2, high / 2]));
  }

  pan(dx: number, dy: number): void {
    const { camera } = this.scene;
    this.look({ ...camera, x: camera.x + dx, y: camera.y + dy });
  }

  everything(): void {
    const box = this.page.box();
    const { clientWidth: wide, clientHeight: high } = this.paper;
    this.look(box ? fitted(grown(box, 40), wide, high) : START);
  }

  /** Shows a stroke that is being drawn, from its point `from` on. */
  drawing(stroke: Parameters<WetInk["add"]>[0], from: number): void { this.wet.add(stroke, from, this.scene.camera, colours().ink); }

  /** A stroke is over: it is no longer wet. */
  dried(): void { this.wet.clear(this.scene.camera); }

  /** Makes components and formulas bright. */
  light(labels: string[], lines: number[]): void {
    const { scene } = this;
    const same = labels.length === scene.bright.size && labels.every((label) => scene.bright.has(label))
      && lines.length === scene.brightLines.size && lines.every((line) => scene.brightLines.has(line));
    if (same) return;
    scene.bright = new Set(labels);
    scene.brightLines = new Set(lines);
    this.formulas.light(scene.brightLines);
    this.stale();
  }

  picture(name: string): void {
    png([this.layers.ground.canvas, this.layers.things.canvas, this.layers.dry.canvas], colours().paper, `${name}.png`);
  }

  /** Draws what moves: all that a frame of play costs here. */
  frame(time: number): void {
    this.scene.time = time;
    this.painter.draw(this.scene);
  }

  /** Draws in the next frame; ink: finished ink as well. */
  stale(ink = false): void {
    this.inkStale ||= ink;
    if (this.queued) return;
    this.queued = true;
    requestAnimationFrame(() => {
      this.queued = false;
      const fading = this.scene.fading.size > 0 || this.painter.busy;
      if (this.inkStale || fading) this.painter.ink(this.scene);
      this.inkStale = false;
      this.layers.wet.canvas.hidden = this.scene.run !== null; // a layer that shows nothing costs as much as any
      if (!this.playing()) this.painter.draw(this.scene);
      if (fading) this.stale(true);
    });
  }

  private resize(): void {
    const { clientWidth: wide, clientHeight: high } = this.paper;
    for (const layer of Object.values(this.layers)) layer.resize(wide, high);
    this.ground.resized();
    this.stale(true);
  }
}

/** The size of what a stroke spans, page units. */
export function span(points: Point[]): number {
  const box = boxOf(points)!;
  return Math.hypot(box.right - box.left, box.bottom - box.top);
}
