// Components on a canvas. Page units.

import type { Component, Point, Shape } from "../wire/protocol";
import { colours } from "../ui/theme";
import { coil } from "./geometry";

export function outline(context: CanvasRenderingContext2D, shape: Shape): void {
  context.beginPath();
  switch (shape.kind) {
    case "circle": context.arc(...shape.centre, shape.radius, 0, 2 * Math.PI); break;
    case "polygon":
      shape.vertices.forEach((vertex, k) => (k ? context.lineTo(...vertex) : context.moveTo(...vertex)));
      context.closePath();
      break;
    case "spring":
      coil(shape.start, shape.end, shape.coils, shape.width).forEach((p, k) => (k ? context.lineTo(...p) : context.moveTo(...p)));
      break;
    default:
      context.moveTo(...shape.start);
      context.lineTo(...shape.end);
      if (shape.kind === "arrow") head(context, shape.start, shape.end, 12);
  }
}

export function head(context: CanvasRenderingContext2D, tail: Point, tip: Point, size: number): void {
  const angle = Math.atan2(tip[1] - tail[1], tip[0] - tail[0]);
  for (const turn of [-0.45, 0.45]) {
    context.moveTo(...tip);
    context.lineTo(tip[0] - size * Math.cos(angle + turn), tip[1] - size * Math.sin(angle + turn));
  }
}

export interface Style { alpha?: number; bright?: boolean; selected?: boolean; label?: boolean; spoke?: number; unit?: number }

/** One component: solids tinted, fixed ones hatched, links as lines; its label beside it. */
export function draw(context: CanvasRenderingContext2D, part: Pick<Component, "kind" | "label" | "fixed">, shape: Shape, style: Style = {}): void {
  const colour = colours()[part.kind], unit = style.unit ?? 1;
  context.save();
  context.globalAlpha = style.alpha ?? 1;
  context.lineJoin = context.lineCap = "round";
  context.strokeStyle = colour;
  context.lineWidth = (style.bright || style.selected ? 4.5 : 2.6) * unit;
  outline(context, shape);
  if (shape.kind === "circle" || shape.kind === "polygon") {
    context.fillStyle = colour;
    context.globalAlpha *= 0.13;
    context.fill();
    context.globalAlpha = style.alpha ?? 1;
    if (part.fixed) hatch(context, shape, unit);
    outline(context, shape);
  }
  context.stroke();
  if (shape.kind === "circle" && style.spoke !== undefined) {
    const [x, y] = shape.centre;
    context.beginPath();
    context.moveTo(x, y);
    context.lineTo(x + shape.radius * Math.cos(style.spoke), y + shape.radius * Math.sin(style.spoke));
    context.lineWidth = 1.6 * unit;
    context.stroke();
  }
  if (style.label !== false) name(context, part.label, shape, unit);
  context.restore();
}

function name(context: CanvasRenderingContext2D, label: string, shape: Shape, unit: number): void {
  const solid = shape.kind === "circle" || shape.kind === "polygon";
  let [x, y] = solid && shape.kind === "circle" ? shape.centre : centre(shape);
  if (!solid) { x += 10 * unit; y -= 10 * unit; }
  context.font = `600 ${15 * unit}px system-ui, sans-serif`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.lineWidth = 4 * unit;
  context.strokeStyle = colours().paper;
  context.strokeText(label, x, y);
  context.fillStyle = colours().text;
  context.fillText(label, x, y);
}

function centre(shape: Shape): Point {
  if (shape.kind === "circle") return shape.centre;
  const points = shape.kind === "polygon" ? shape.vertices : [shape.start, shape.end];
  return [points.reduce((sum, p) => sum + p[0], 0) / points.length, points.reduce((sum, p) => sum + p[1], 0) / points.length];
}

/** Slanted lines inside: this stays where it is. */
function hatch(context: CanvasRenderingContext2D, shape: Shape, unit: number): void {
  const points = shape.kind === "polygon" ? shape.vertices : shape.kind === "circle"
    ? [[shape.centre[0] - shape.radius, shape.centre[1] - shape.radius], [shape.centre[0] + shape.radius, shape.centre[1] + shape.radius]] as Point[] : [];
  const left = Math.min(...points.map((p) => p[0])), right = Math.max(...points.map((p) => p[0]));
  const top = Math.min(...points.map((p) => p[1])), bottom = Math.max(...points.map((p) => p[1]));
  const step = Math.max(9 * unit, (right - left + bottom - top) / 120);
  context.save();
  context.clip();
  context.globalAlpha *= 0.45;
  context.lineWidth = 1.1 * unit;
  context.beginPath();
  for (let x = left - (bottom - top); x < right; x += step) {
    context.moveTo(x, bottom);
    context.lineTo(x + bottom - top, top);
  }
  context.stroke();
  context.restore();
}
