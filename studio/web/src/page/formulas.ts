// Formulas beside their ink: MathML as the server read it, what is being written as well, or a question where nobody
// could read it.

import { holds, toScreen, type Box, type Camera } from "../pen/camera";
import type { Line, LiveLine, Point, Verdict } from "../wire/protocol";
import { el, formula } from "../ui/dom";
import { typedBox, type PageModel } from "./page";

const MARK = { right: "✓", wrong: "✗", "not determined": "?" } as const;
const FORGOTTEN = 500; // pen-ups whose reading is still waited for: more were no mathematics

/** A formula as it stands beside its place. line: its number on the page, null while it is being written only; live: what
 * it reads as at the moment, which is not the page's until Analyze or a tap makes it so. */
export interface Chip {
  line: number | null; strokes: string[]; text: string | null; mathml: string | null; problem: string | null; at: Point | null;
  alternatives: string[]; live: boolean; sure: boolean;
}

interface Shown { chip: Chip; element: HTMLElement; made: string }

/** What is to be shown: the page's lines, as they read now where their ink has changed, and lines that are only written yet. */
export function chips(lines: Line[], live: LiveLine[]): Chip[] {
  const writing = (one: LiveLine, line: Line | null): Chip => ({ ...one, line: line?.line ?? null, at: line?.at ?? null, problem: null, live: true });
  return [
    ...lines.filter((line) => line.text !== null || line.strokes.length).map((line) => {
      const now = live.find((one) => one.line === line.line);
      return now ? writing(now, line) : { ...line, live: false, sure: line.text !== null };
    }),
    ...live.filter((one) => one.line === null).map((one) => writing(one, null)),
  ];
}

export class Formulas {
  /** Milliseconds from a pen-up to the reading that shows its stroke: for the benchmark. */
  readonly spent: number[] = [];
  private shown = new Map<string, Shown>();
  private bright = new Set<number>();
  private camera: Camera | null = null;
  private moved = false;
  private lifts = new Map<string, number>();

  constructor(private overlay: HTMLElement, private page: PageModel, private edit: (chip: Chip) => void) {}

  /** The pen has been lifted after a stroke. */
  lifted(stroke: string): void {
    if (this.lifts.size > FORGOTTEN) this.lifts.clear();
    this.lifts.set(stroke, performance.now());
  }

  /** Shows what the page says now; what has not changed stays as it is. */
  refresh(): void {
    const before = this.shown;
    this.shown = new Map();
    for (const chip of chips(this.page.state.lines, this.page.writing())) {
      const name = chip.line === null ? `written ${chip.strokes[0]}` : `line ${chip.line}`;
      const verdict = chip.live ? undefined : this.page.verdicts.find((one) => one.line === chip.line);
      const selected = chip.line !== null && this.page.state.selected.lines.includes(chip.line);
      const made = JSON.stringify([{ ...chip, strokes: chip.strokes.length > 0 }, verdict?.status, selected]);
      const old = before.get(name);
      before.delete(name);
      if (old?.made === made) this.shown.set(name, { ...old, chip });
      else {
        const element = this.element(chip, verdict, selected);
        if (old) old.element.replaceWith(element);
        else this.overlay.append(element);
        this.shown.set(name, { chip, element, made });
      }
      if (chip.live) this.time(chip.strokes);
    }
    for (const gone of before.values()) gone.element.remove();
    this.light(this.bright);
    this.moved = true;
    if (this.camera) this.place(this.camera); // at once: a chip in the corner for a frame flickers, and is clicked beside
  }

  private element(chip: Chip, verdict: Verdict | undefined, selected: boolean): HTMLElement {
    const classes = ["formula", chip.text === null && "unread", chip.problem && "problem", selected && "selected", !chip.strokes.length && "typed", chip.live && "live", chip.live && !chip.sure && "unsure"];
    const what = chip.text === null ? "not read yet" : chip.live ? `being written, reads ${chip.text}${chip.sure ? "" : ", not sure"}` : chip.text;
    const made = el("button", {
      type: "button", tabindex: 0, class: classes.filter(Boolean).join(" "), "data-line": chip.line ?? undefined,
      "aria-label": `Formula ${what}${verdict ? `, ${verdict.status}` : ""}; edit`,
    });
    made.addEventListener("click", () => {
      const now = [...this.shown.values()].find((one) => one.element === made);
      if (now) this.edit(now.chip);
    });
    if (chip.text === null) made.append("what does this say?");
    else made.append(chip.mathml ? formula(chip.mathml) : chip.text);
    if (chip.live && !chip.sure) made.append(el("span", { class: "doubt" }, "?"));
    if (chip.problem) made.append(el("span", { class: "why" }, chip.problem));
    if (verdict) made.append(el("span", { class: `verdict ${verdict.status.split(" ")[0]}` }, MARK[verdict.status]));
    return made;
  }

  private time(strokes: string[]): void {
    for (const id of strokes) {
      const began = this.lifts.get(id);
      if (began === undefined) continue;
      this.lifts.delete(id);
      requestAnimationFrame(() => this.spent.push(performance.now() - began));
    }
  }

  /** The chip of a line of the page. */
  of(line: number): Chip | undefined { return this.shown.get(`line ${line}`)?.chip; }

  /** Where a formula stands: under its ink, or with its middle at its place. */
  spot(chip: Pick<Chip, "strokes" | "at">): { at: Point; centred: boolean } | null {
    const box = this.page.inkBox(chip.strokes);
    if (box) return { at: [box.left, box.bottom + 4], centred: false };
    return chip.at ? { at: chip.at, centred: true } : null;
  }

  /** Puts the chips where they belong, for this camera; they stay there until it is another one. */
  place(camera: Camera): void {
    if (camera === this.camera && !this.moved) return;
    this.camera = camera;
    this.moved = false;
    for (const { chip, element } of this.shown.values()) {
      const spot = this.spot(chip);
      if (!spot) continue;
      const [x, y] = toScreen(camera, spot.at);
      const transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)${spot.centred ? " translate(-50%, -50%)" : ""}`;
      if (element.style.transform !== transform) element.style.transform = transform;
    }
  }

  /** The formula whose chip lies under a point of the screen, as the client sees it. */
  under(x: number, y: number): Chip | null {
    for (const { chip, element } of this.shown.values()) {
      const box: Box = element.getBoundingClientRect();
      if (holds(box, [x, y])) return chip;
    }
    return null;
  }

  light(lines: Set<number>): void {
    this.bright = lines;
    for (const { chip, element } of this.shown.values()) element.classList.toggle("bright", chip.line !== null && lines.has(chip.line));
  }

  /** From where a line to what a formula governs begins, page units. */
  root(line: Line): Point | null {
    const box = this.page.inkBox(line.strokes) ?? (line.at && typedBox(line.text ?? "", line.at));
    return box && [(box.left + box.right) / 2, (box.top + box.bottom) / 2];
  }
}
