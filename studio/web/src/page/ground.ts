// What lies under the things of a page: its grid, and in a run the ways that bodies have come. Of a way only what is new
// is drawn: a frame of play costs as many pieces of line as there are bodies.

import type { Camera } from "../pen/camera";
import type { Layer } from "../pen/layers";
import type { Run } from "../stage/run";
import { colours } from "../ui/theme";

const GRID = 100; // page units: a metre
const LEAST = 24; // CSS pixels between two lines

export class Ground {
  private drawn: { camera: Camera; run: Run | null; row: number; paper: string } | null = null;

  constructor(private layer: Layer) {}

  /** The window has another size: all is to be drawn again. */
  resized(): void { this.drawn = null; }

  draw(camera: Camera, run: Run | null, time: number): void {
    const row = run ? run.at(time).row : 0, { paper } = colours(), before = this.drawn;
    const goesOn = before !== null && before.camera === camera && before.run === run && before.paper === paper && row >= before.row;
    if (!goesOn) this.grid(this.layer.begin(camera), camera);
    if (run) this.ways(run, goesOn ? before.row : 0, row);
    this.drawn = { camera, run, row, paper };
  }

  private grid(context: CanvasRenderingContext2D, camera: Camera): void {
    const wide = this.layer.canvas.clientWidth / camera.scale, high = this.layer.canvas.clientHeight / camera.scale;
    const step = GRID * 2 ** Math.max(0, Math.ceil(Math.log2(LEAST / (GRID * camera.scale))));
    context.strokeStyle = colours().grid;
    context.lineWidth = 1 / camera.scale;
    context.beginPath();
    for (let x = Math.floor(camera.x / step) * step; x < camera.x + wide; x += step) {
      context.moveTo(x, camera.y);
      context.lineTo(x, camera.y + high);
    }
    for (let y = Math.floor(camera.y / step) * step; y < camera.y + high; y += step) {
      context.moveTo(camera.x, y);
      context.lineTo(camera.x + wide, y);
    }
    context.stroke();
  }

  private ways(run: Run, from: number, to: number): void {
    if (to <= from) return;
    const { context } = this.layer;
    context.strokeStyle = colours().faint;
    context.globalAlpha = 0.6;
    context.lineWidth = 1;
    context.beginPath();
    run.head.bodies.forEach((_, body) => {
      context.moveTo(...run.centre(body, from));
      for (let row = from + 1; row <= to; row++) context.lineTo(...run.centre(body, row));
    });
    context.stroke();
    context.globalAlpha = 1;
  }
}
