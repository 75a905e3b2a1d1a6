import { toScreen, type Camera } from "./camera";
import { painted, widthAt, WIDTH, type Painted } from "./look";
import type { RawStroke } from "./pointer";
import type { InkStroke } from "../wire/protocol";

/** A canvas as large as its box, in device pixels. */
export class Layer {
  readonly canvas = document.createElement("canvas");
  readonly context: CanvasRenderingContext2D;

  constructor(parent: HTMLElement, name: string, quick = false) {
    this.canvas.className = name;
    this.canvas.setAttribute("aria-hidden", "true");
    parent.append(this.canvas);
    this.context = this.canvas.getContext("2d", { desynchronized: quick })!;
  }

  resize(width: number, height: number): void {
    const ratio = devicePixelRatio || 1;
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
  }

  /** Empties it, and lets what follows be drawn in page units. */
  begin(camera: Camera): CanvasRenderingContext2D {
    this.context.setTransform(1, 0, 0, 1, 0, 0);
    this.context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    this.aim(camera);
    return this.context;
  }

  aim(camera: Camera): void {
    const ratio = (devicePixelRatio || 1) * camera.scale;
    this.context.setTransform(ratio, 0, 0, ratio, -camera.x * ratio, -camera.y * ratio);
  }
}

export interface Shown { stroke: InkStroke; dx: number; dy: number; alpha: number; colour: string }

/** Finished ink: each stroke's path is made once. */
export class DryInk {
  private made = new WeakMap<InkStroke, Painted[]>();

  draw(context: CanvasRenderingContext2D, shown: Shown): void {
    let looks = this.made.get(shown.stroke);
    if (!looks) this.made.set(shown.stroke, (looks = painted(shown.stroke)));
    context.save();
    context.translate(shown.dx, shown.dy);
    context.globalAlpha = shown.alpha;
    context.strokeStyle = shown.colour;
    context.lineCap = context.lineJoin = "round";
    for (const { path, width } of looks) {
      context.lineWidth = width;
      context.stroke(path);
    }
    context.restore();
  }
}

/** The stroke that is being drawn: only what is new is drawn, at once, in the event that brought it. */
export class WetInk {
  /** Milliseconds that drawing took, event by event: for the benchmark. */
  readonly spent: number[] = [];

  constructor(private layer: Layer) {}

  clear(camera: Camera): void { this.layer.begin(camera); }

  add(stroke: RawStroke, from: number, camera: Camera, colour: string): void {
    const began = performance.now();
    const context = this.layer.context;
    this.layer.aim(camera);
    context.strokeStyle = colour;
    context.lineCap = "round";
    const { points, pressure } = stroke;
    for (let k = Math.max(1, from); k < points.length; k++) {
      context.lineWidth = widthAt(stroke.pointer === "pen" ? pressure[k]! : 0.5);
      context.beginPath();
      context.moveTo(...points[k - 1]!);
      context.lineTo(...points[k]!);
      context.stroke();
    }
    if (points.length === 1) {
      context.fillStyle = colour;
      context.beginPath();
      context.arc(...points[0]!, WIDTH / 2, 0, 2 * Math.PI);
      context.fill();
    }
    this.spent.push(performance.now() - began);
    if (this.spent.length > 5000) this.spent.shift();
  }
}

/** Puts an element at a page point. */
export function place(element: HTMLElement, camera: Camera, at: [number, number]): void {
  const [x, y] = toScreen(camera, at);
  element.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
}
