// The first page, step by step: each step is over when it has been done.

import { el } from "./dom";
import type { State } from "../wire/protocol";

export interface Progress { state: State; ran: boolean }
interface Step { say: string; done: (now: Progress) => boolean }

const KEY = "inklined-guided";

export const STEPS: Step[] = [
  { say: "Draw a big triangle: a ramp. Begin and end at the same corner.", done: ({ state }) => state.strokes.length > 0 },
  { say: "Draw a ball, a ring, on its slope.", done: ({ state }) => state.strokes.length > 1 || state.components.length > 1 },
  { say: "Press Analyze (or the key A): ink becomes things.", done: ({ state }) => state.components.length > 0 },
  { say: "Tap the ramp: it stays where it is then. Another tap frees it.", done: ({ state }) => state.components.some((part) => part.fixed) },
  { say: "Press Run and watch.", done: ({ ran }) => ran },
  {
    say: "Press Reset, then F, and type v = (2, 1): how fast the ball is at first. In its box, choose what it is said of. Run again.",
    done: ({ state, ran }) => ran && state.associations.length > 0,
  },
];

/** The first step that is not done yet; their number when all are. Steps that were done once stay done. */
export function stepAt(now: Progress, from: number): number {
  let step = from;
  while (step < STEPS.length && STEPS[step]!.done(now)) step++;
  return step;
}

export class Guide {
  private step = 0;
  readonly element = el("aside", { class: "guide", hidden: true, "aria-live": "polite" });

  /** Shown to whoever has never been through it; again: also to who has. */
  begin(again: boolean): void {
    if (!again && localStorage.getItem(KEY)) return;
    this.step = 0;
    this.element.hidden = false;
    this.draw();
  }

  tell(now: Progress): void {
    if (this.element.hidden) return;
    const step = stepAt(now, this.step);
    if (step !== this.step) {
      this.step = step;
      this.draw();
    }
  }

  private draw(): void {
    const over = this.step >= STEPS.length;
    if (over) localStorage.setItem(KEY, "done");
    this.element.replaceChildren(
      el("b", {}, over ? "That is all there is to it. " : `${this.step + 1} of ${STEPS.length}: `),
      over ? "The notebook (key N) has ten examples; ? shows all keys. " : STEPS[this.step]!.say, " ",
      el("button", { type: "button", class: "small", onclick: () => { localStorage.setItem(KEY, "done"); this.element.hidden = true; } }, over ? "Close" : "Skip the tour"));
  }
}
