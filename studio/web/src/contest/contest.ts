// How each recognizer reads the page: side by side, each moving as what it read would, and what each says of a stroke.

import { boxOf, fitted, grown, union } from "../pen/camera";
import { Layer } from "../pen/layers";
import { shapeBox } from "../page/page";
import { draw } from "../page/shapes";
import { Run } from "../stage/run";
import { el } from "../ui/dom";
import { still } from "../ui/theme";
import type { Claim, Reading } from "../wire/protocol";

interface Pane { reading: Reading; run: Run | null; layer: Layer; element: HTMLElement }

export class Contest {
  readonly element = el("section", { class: "contest", hidden: true, "aria-label": "How each recognizer reads the page" });
  private panes: Pane[] = [];
  private began = 0;

  constructor(private use: (name: string) => void) {}

  get on(): boolean { return !this.element.hidden; }

  toggle(on: boolean): void {
    this.element.hidden = !on;
    this.panes = [];
    this.element.replaceChildren(...(on ? [el("p", { class: "faint" }, "Each recognizer reads the page …")] : []));
  }

  add(reading: Reading, numbers: Float32Array): void {
    if (!this.on) return;
    if (!this.panes.length) {
      this.element.replaceChildren();
      this.began = performance.now();
      requestAnimationFrame(this.tick);
    }
    const claimed = reading.claims.filter((claim) => !claim.rejected);
    const sure = claimed.length ? claimed.reduce((sum, claim) => sum + claim.confidence, 0) / claimed.length : 0;
    const counted = new Map<string, number>();
    for (const part of reading.components) counted.set(part.kind, (counted.get(part.kind) ?? 0) + 1);
    const found = [...counted].map(([kind, n]) => `${n} ${kind}${n === 1 ? "" : "s"}`).join(", ") || "nothing that moves";
    const canvas = el("div", { class: "pane-canvas" });
    const element = el("article", { class: "pane", "data-reading": reading.name },
      el("h3", {}, reading.name), canvas,
      el("p", {}, `${found}; ${reading.lines} line${reading.lines === 1 ? "" : "s"} of mathematics`),
      el("p", { class: "faint" }, `${(100 * sure).toFixed(0)} % sure of a stroke on average; ${reading.claims.length - claimed.length} rejected. ${reading.about}.`),
      el("button", { type: "button", onclick: () => this.use(reading.name) }, "Use this reading"));
    this.element.append(element);
    const layer = new Layer(canvas, "pane-layer");
    let run: Run | null = null;
    if (reading.run) {
      run = new Run(reading.run);
      if (reading.rows) run.add(reading.rows, reading.columns, numbers, reading.events ?? []);
    }
    this.panes.push({ reading, run, layer, element });
  }

  /** What every recognizer says of a stroke, the surest kinds first. */
  claims(stroke: string): { name: string; claim: Claim }[] {
    return this.panes.flatMap(({ reading }) => {
      const claim = reading.claims.find((one) => one.id === stroke);
      return claim ? [{ name: reading.name, claim }] : [];
    });
  }

  private tick = (now: number): void => {
    if (!this.on || !this.panes.length) return;
    const box = union(this.panes.flatMap(({ reading }) => reading.components.map((part) => shapeBox(part.shape))))
      ?? boxOf([[0, 0], [100, 100]])!;
    for (const { reading, run, layer } of this.panes) {
      const { clientWidth: wide, clientHeight: high } = layer.canvas;
      if (layer.canvas.width !== Math.round(wide * devicePixelRatio)) layer.resize(wide, high);
      const camera = fitted(grown(box, 30), wide, high, 1);
      const context = layer.begin(camera);
      const seconds = run && !still() ? ((now - this.began) / 1000) % (run.until + 0.8) : 0;
      for (const part of reading.components) {
        const placed = run?.placed(part.label, part.shape, Math.min(seconds, run.until));
        if (placed !== null) draw(context, part, placed?.shape ?? part.shape, { spoke: placed?.spoke, unit: 1.4 });
      }
    }
    requestAnimationFrame(this.tick);
  };
}

/** The claims as a small table, for hovering over a stroke. */
export function claimsTable(claims: { name: string; claim: Claim }[]): HTMLElement {
  return el("table", { class: "claims" }, ...claims.map(({ name, claim }) => {
    const sorted = Object.entries(claim.scores).sort((a, b) => b[1] - a[1]).slice(0, 3);
    return el("tr", {}, el("th", {}, name), el("td", {}, claim.rejected ? "rejected; " : "",
      sorted.map(([kind, score]) => `${kind} ${(100 * score).toFixed(0)} %`).join(", ")));
  }));
}
