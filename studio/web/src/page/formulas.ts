// Formulas beside their ink: MathML as the server read it, or a question where nobody could.

import { holds, toScreen, type Box, type Camera } from "../pen/camera";
import type { Line, Point, Verdict } from "../wire/protocol";
import { el, formula } from "../ui/dom";
import { typedBox, type PageModel } from "./page";

const MARK = { right: "✓", wrong: "✗", "not determined": "?" } as const;

export class Formulas {
  private readonly chips = new Map<number, HTMLElement>();
  private bright = new Set<number>();
  private camera: Camera | null = null;

  constructor(private overlay: HTMLElement, private page: PageModel, private edit: (line: number) => void) {}

  /** Makes the chips anew from the page. */
  refresh(): void {
    const lit = this.bright;
    for (const chip of this.chips.values()) chip.remove();
    this.chips.clear();
    for (const line of this.page.state.lines) {
      if (line.text === null && !line.strokes.length) continue;
      const verdict = this.page.verdicts.find((one) => one.line === line.line);
      const chip = this.chip(line, verdict);
      this.chips.set(line.line, chip);
      this.overlay.append(chip);
    }
    this.light(lit);
    if (this.camera) this.place(this.camera); // at once: a chip in the corner for a frame flickers, and is clicked beside
  }

  private chip(line: Line, verdict: Verdict | undefined): HTMLElement {
    const selected = this.page.state.selected.lines.includes(line.line);
    const what = line.text === null ? "not read yet" : line.text;
    const chip = el("button", {
      type: "button", tabindex: 0, "data-line": line.line,
      class: `formula${line.text === null ? " unread" : ""}${line.problem ? " problem" : ""}${selected ? " selected" : ""}${line.strokes.length ? "" : " typed"}`,
      "aria-label": `Formula ${what}${verdict ? `, ${verdict.status}` : ""}; edit`,
      onclick: () => this.edit(line.line),
    });
    if (line.text === null) chip.append("what does this say?");
    else chip.append(line.mathml ? formula(line.mathml) : line.text);
    if (line.problem) chip.append(el("span", { class: "why" }, line.problem));
    if (verdict) chip.append(el("span", { class: `verdict ${verdict.status.split(" ")[0]}` }, MARK[verdict.status]));
    return chip;
  }

  /** Where a formula stands: under its ink, or with its middle at its place. */
  spot(line: Line): { at: Point; centred: boolean } | null {
    const box = this.page.lineBox(line);
    if (box) return { at: [box.left, box.bottom + 4], centred: false };
    return line.at ? { at: line.at, centred: true } : null;
  }

  place(camera: Camera): void {
    this.camera = camera;
    for (const line of this.page.state.lines) {
      const chip = this.chips.get(line.line), spot = this.spot(line);
      if (!chip || !spot) continue;
      const [x, y] = toScreen(camera, spot.at);
      chip.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)${spot.centred ? " translate(-50%, -50%)" : ""}`;
    }
  }

  /** The formula whose chip lies under a point of the screen, as the client sees it. */
  under(x: number, y: number): number | null {
    for (const [line, chip] of this.chips) {
      const box: Box = chip.getBoundingClientRect();
      if (holds(box, [x, y])) return line;
    }
    return null;
  }

  light(lines: Set<number>): void {
    this.bright = lines;
    for (const [line, chip] of this.chips) chip.classList.toggle("bright", lines.has(line));
  }

  /** From where a line to what a formula governs begins, page units. */
  root(line: Line): Point | null {
    const box = this.page.lineBox(line) ?? (line.at && typedBox(line.text ?? "", line.at));
    return box && [(box.left + box.right) / 2, (box.top + box.bottom) / 2];
  }
}
