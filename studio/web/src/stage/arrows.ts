// Arrows at bodies: their length follows the magnitude, one scale for all of one unit through the whole run (row E4).

import { colours } from "../ui/theme";
import { head } from "../page/shapes";
import { sizes, type Run } from "./run";

const LONGEST = 90; // page units, as physics/observables.py has it
const SHORTEST = 1;

export interface Chosen { body: string; quantity: string; bold: boolean; colour: number }

/** The greatest size of each unit among the chosen vectors. */
export function scales(run: Run, chosen: Chosen[]): Map<string, number> {
  const greatest = new Map<string, number>();
  for (const { body, quantity } of chosen) {
    const series = run.series.get(`${body} ${quantity}`);
    if (!series?.vector || quantity === "position") continue;
    const most = sizes(series).reduce((most, size) => (Number.isFinite(size) && size > most ? size : most), 0);
    greatest.set(series.unit, Math.max(greatest.get(series.unit) ?? 0, most));
  }
  return greatest;
}

export function drawArrows(context: CanvasRenderingContext2D, run: Run, chosen: Chosen[], seconds: number, scale: Map<string, number>): void {
  for (const one of chosen) {
    const series = run.series.get(`${one.body} ${one.quantity}`), pose = run.pose(one.body, seconds);
    const value = run.vector(one.body, one.quantity, seconds);
    const greatest = series && scale.get(series.unit);
    if (!series || !pose || !value || !greatest || one.quantity === "position") continue;
    const dx = (value[0] / greatest) * LONGEST, dy = (-value[1] / greatest) * LONGEST;
    if (Math.hypot(dx, dy) < SHORTEST) continue;
    const tip: [number, number] = [pose.x + dx, pose.y + dy];
    context.save();
    context.strokeStyle = context.fillStyle = colours().series[one.colour % colours().series.length]!;
    context.lineWidth = one.bold ? 4.5 : 1.8;
    context.lineCap = "round";
    context.beginPath();
    context.moveTo(pose.x, pose.y);
    context.lineTo(...tip);
    head(context, [pose.x, pose.y], tip, one.bold ? 13 : 9);
    context.stroke();
    context.font = `${one.bold ? 600 : 400} 12px system-ui, sans-serif`;
    context.textAlign = dx < 0 ? "right" : "left";
    context.fillText(one.quantity, tip[0] + Math.sign(dx || 1) * 8, tip[1] + Math.sign(dy || -1) * 14);
    context.restore();
  }
}
