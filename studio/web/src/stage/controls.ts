// Run, pause, reset, step, slow motion and the slider of the time.

import { el } from "../ui/dom";

export interface Drives {
  toggle(): void;
  reset(): void;
  step(frames: number): void;
  speed(factor: number): void;
  seek(seconds: number): void;
}

const READABLE = 60; // ms: nobody reads a clock that is quicker, and a slider costs a frame of play more than all else

export class Controls {
  readonly run = el("button", { type: "button", class: "primary", id: "run", title: "Run or pause (Enter)", onclick: () => this.drives.toggle() }, "Run");
  private readonly slider = el("input", {
    type: "range", min: 0, max: 1, step: "any", value: 0, id: "time", "aria-label": "Time", oninput: () => this.drives.seek(Number(this.slider.value)),
  });
  private readonly clock = el("output", { id: "clock" }, "0.00 s");
  readonly length = el("select", { id: "seconds", "aria-label": "Length of a run" },
    ...[2, 5, 10, 30, 60].map((n) => el("option", { value: n, selected: n === 2 }, `${n} s`)));
  private readonly moving = el("span", { class: "moving", hidden: true },
    el("button", { type: "button", id: "reset", title: "Back to the start, to draw and change (R)", onclick: () => this.drives.reset() }, "Reset"),
    el("button", { type: "button", id: "back", title: "One frame back (,)", "aria-label": "One frame back", onclick: () => this.drives.step(-1) }, "◂"),
    el("button", { type: "button", id: "forth", title: "One frame on (.)", "aria-label": "One frame on", onclick: () => this.drives.step(1) }, "▸"),
    el("label", { class: "bare" }, "", this.speedChoice()),
    this.slider, this.clock);
  readonly element = el("span", { class: "controls" }, this.run, this.length, this.moving);

  private told = 0;

  constructor(private drives: Drives) {}

  private speedChoice(): HTMLSelectElement {
    const choice = el("select", { id: "speed", "aria-label": "Speed: real time or slow motion" },
      ...[["1", "1 ×"], ["0.5", "½ ×"], ["0.25", "¼ ×"], ["0.1", "⅒ ×"]].map(([value, text]) => el("option", { value: value! }, text!)));
    choice.addEventListener("change", () => this.drives.speed(Number(choice.value)));
    return choice;
  }

  /** What the buttons say; until: seconds that there are. */
  show(moving: boolean, playing: boolean, waiting: boolean): void {
    this.run.textContent = waiting ? "Computing …" : playing ? "Pause" : moving ? "Play" : "Run";
    this.moving.hidden = !moving;
    this.length.hidden = moving;
  }

  /** The time has gone on; atOnce: not only as often as it can be read. */
  tick(time: number, until: number, atOnce: boolean): void {
    const now = performance.now();
    if (!atOnce && now - this.told < READABLE) return;
    this.told = now;
    if (this.slider.max !== String(until)) this.slider.max = String(until);
    this.slider.value = String(time);
    const text = `${time.toFixed(2)} s`;
    if (this.clock.textContent !== text) this.clock.textContent = text;
  }
}
