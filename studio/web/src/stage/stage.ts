// A run: asked for, received piece by piece, played, observed and told.

import type { PageModel } from "../page/page";
import { hit } from "../page/page";
import type { View } from "../page/view";
import { csv } from "../graph/csv";
import { Graphs } from "../graph/graphs";
import { el, say } from "../ui/dom";
import { download } from "../ui/download";
import type { Packed, Point, RunHead, Told } from "../wire/protocol";
import { scales, type Chosen } from "./arrows";
import { Controls } from "./controls";
import { Observing } from "./observe";
import { Player } from "./player";
import { Run } from "./run";

export interface StageAsks {
  /** Sends a message that is worth nothing later: false where there is no connection. */
  send(message: object): boolean;
  /** A run begins: whatever is open is closed. */
  begins(): void;
  /** Whether there is a run, whether it is waited for, or whether it has ended is otherwise now. */
  changed(): void;
}

const MOST_TOLD = 60; // events that are listed: more nobody reads

export class Stage {
  readonly controls: Controls;
  readonly player: Player;
  /** What happens, what is observed, and its graphs: beside the page while there is a run. */
  readonly element = el("div", { hidden: true });
  waiting = false;
  /** Whether anything has been run to its end since the page was opened. */
  ran = false;
  private runs = 0;
  private marked = 0;
  private readonly graphs: Graphs;
  private readonly observing: Observing;
  private readonly happened = el("ul", { class: "happened" });
  private readonly told = el("ul", { class: "told", "aria-live": "polite" });

  constructor(private view: () => View, private page: PageModel, private asks: StageAsks) {
    this.player = new Player(() => this.run?.until ?? 0, () => this.run?.ended ?? true, () => this.tick());
    this.graphs = new Graphs((seconds) => this.seek(seconds), () => this.player.time);
    this.observing = new Observing((chosen) => this.observe(chosen));
    this.controls = new Controls({
      toggle: () => this.toggle(), reset: () => this.reset(), step: (n) => this.step(n),
      speed: (factor) => { this.player.speed = factor; }, seek: (seconds) => this.seek(seconds),
    });
    this.element.append(
      el("h2", {}, "What happens"), this.told, this.happened, el("h2", {}, "Observe"), this.observing.element, this.graphs.element,
      el("button", { type: "button", class: "small", id: "csv", onclick: () => this.saveCsv() }, "Save the graphs' numbers (CSV)"));
  }

  get run(): Run | null { return this.view().scene.run; }

  /** Runs, pauses or plays on. */
  toggle(): void {
    if (this.waiting) return;
    if (!this.run) this.start();
    else if (this.player.playing) this.player.pause();
    else this.player.play();
    this.show();
  }

  /** Back to the drawing (row P6). */
  reset(): void {
    if (!this.run && !this.waiting) return;
    this.player.playing = false;
    this.player.time = 0;
    this.waiting = false;
    this.runs++;
    this.asks.send({ type: "stop" });
    this.view().scene.run = null;
    this.element.hidden = true;
    this.show();
    this.view().stale(true);
  }

  step(frames: number): void {
    if (this.run) this.player.step(frames, this.run.head.rate);
    this.show();
  }

  /** What a tap during a run means: the thing under it is observed. */
  pick(at: Point): void {
    const part = this.page.state.components.find((one) => {
      const placed = this.run!.placed(one.label, one.shape, this.player.time);
      return placed && hit(placed.shape, at);
    });
    if (part) this.observing.pick(part.label);
  }

  begun(head: RunHead): void {
    if (head.run !== this.runs) return;
    this.view().scene.run = new Run(head);
    this.player.time = 0;
    this.element.hidden = false;
    this.told.replaceChildren();
    this.graphs.show(null, []);
    this.view().stale(true);
  }

  /** A piece of the run, or a quantity of it that was asked for. */
  took(message: Exclude<Packed, { type: "reading" }>, numbers: Float32Array): void {
    const run = this.run;
    if (!run || message.run !== this.runs) return;
    if (message.type === "piece") {
      run.add(message.rows, message.columns, numbers, message.events);
      if (this.waiting) {
        this.waiting = false;
        this.player.play();
        this.show();
      }
      this.list(run);
    } else {
      run.series.set(`${message.body} ${message.quantity}`, { ...message, values: numbers });
      this.draw(run);
    }
  }

  ended(message: Extract<Told, { type: "end" }>): void {
    const run = this.run;
    if (!run || message.run !== this.runs) return;
    run.ended = true;
    run.told = message.told;
    run.observable = message.observable;
    this.ran = true;
    this.told.replaceChildren(...message.told.map((text) => el("li", {}, text)));
    if (message.seconds < message.asked - 0.05) this.told.append(el("li", { class: "why" }, `The run ends at ${message.seconds.toFixed(2)} s.`));
    this.observing.show(run);
    this.asks.changed();
    this.tick();
  }

  /** A run that was asked for cannot be had. */
  failed(run: number | undefined): void {
    if (run === this.runs && this.waiting) this.reset();
  }

  private start(): void {
    const { components, strokes } = this.page.state;
    if (!components.length) {
      say(strokes.length ? "Analyze first: then there is something that can move." : "Draw something first, then Analyze, then Run.");
      return;
    }
    this.asks.begins();
    this.waiting = this.asks.send({ type: "run", run: ++this.runs, seconds: Number(this.controls.length.value) });
    this.show();
  }

  private show(): void {
    this.controls.show(this.run !== null, this.player.playing, this.waiting);
    this.asks.changed();
  }

  private seek(seconds: number): void {
    this.player.pause();
    this.player.seek(seconds);
    this.show();
  }

  private observe(chosen: Chosen[]): void {
    this.view().scene.chosen = chosen;
    const run = this.run;
    if (!run?.ended) return;
    for (const { body, quantity } of chosen) {
      if (!run.series.has(`${body} ${quantity}`)) this.asks.send({ type: "observe", run: run.head.run, body, quantity });
    }
    this.draw(run);
  }

  /** Arrows by their new scale; graphs when all that was asked for is there. */
  private draw(run: Run): void {
    const { scene } = this.view();
    scene.scale = scales(run, scene.chosen);
    if (scene.chosen.every((one) => run.series.has(`${one.body} ${one.quantity}`))) this.graphs.show(run, scene.chosen);
    this.view().stale();
  }

  private list(run: Run): void {
    this.marked = 0;
    this.happened.replaceChildren(...run.events.slice(0, MOST_TOLD).map((event) =>
      el("li", { "data-time": event.time }, el("button", { type: "button", onclick: () => this.seek(event.time) }, `${event.time.toFixed(2)} s: ${event.message}`))));
    if (run.events.length > MOST_TOLD) this.happened.append(el("li", { class: "faint" }, `and ${run.events.length - MOST_TOLD} more`));
  }

  /** Marks what has happened by now. */
  private past(run: Run): void {
    const now = run.events.slice(0, MOST_TOLD).filter((event) => event.time <= this.player.time + 1e-9).length;
    const { children } = this.happened;
    for (; this.marked < now; this.marked++) children[this.marked]?.classList.add("past");
    while (this.marked > now) children[--this.marked]?.classList.remove("past");
  }

  private saveCsv(): void {
    const run = this.run;
    const series = this.view().scene.chosen.flatMap((one) => run?.series.get(`${one.body} ${one.quantity}`) ?? []);
    if (run && series.length) download(`${this.page.state.name || "motion"}.csv`, csv(run.times(), series), "text/csv");
  }

  private tick(): void {
    const { run } = this;
    if (run) {
      this.controls.tick(this.player.time, run.until, !this.player.playing);
      this.graphs.tick();
      this.past(run);
    }
    this.view().frame(this.player.time);
    if (!this.player.playing) this.show();
  }
}
