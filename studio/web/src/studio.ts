// One page that is open: ink goes to the server, what it says of the page comes back, runs are played.

import type { Packed, Point, Told } from "./wire/protocol";
import { Line as Connection } from "./wire/socket";
import { boxOf, fitted, grown, holds, START, toScreen, zoomed, type Box, type Camera } from "./pen/camera";
import { Layer, WetInk } from "./pen/layers";
import { Pointers, type RawStroke } from "./pen/pointer";
import { Editor } from "./page/editor";
import { download, png } from "./page/files";
import { Formulas } from "./page/formulas";
import { fromSegment, hit, PageModel, shapeBox } from "./page/page";
import { Painter, type Scene } from "./page/painter";
import { Panel } from "./page/panel";
import { Contest, claimsTable } from "./contest/contest";
import { csv } from "./graph/csv";
import { Graphs } from "./graph/graphs";
import { scales } from "./stage/arrows";
import { Controls } from "./stage/controls";
import { Observing } from "./stage/observe";
import { Player } from "./stage/player";
import { Run } from "./stage/run";
import { el, say } from "./ui/dom";
import type { Guide } from "./ui/guide";
import { colours, onTheme } from "./ui/theme";

export interface Places { paper: HTMLElement; side: HTMLElement; mode: HTMLElement; guide: Guide; named(name: string): void; steps(undo: string | null, redo: string | null): void }

const MOVED_TAP = 6; // page units: a stroke that spans less is a tap

export class Studio {
  readonly page = new PageModel();
  readonly controls: Controls;
  readonly player: Player;
  readonly contest: Contest;
  readonly wet: WetInk;
  private readonly things: Layer;
  private readonly dry: Layer;
  private readonly wetLayer: Layer;
  private readonly overlay = el("div", { id: "overlay" });
  private readonly banner = el("div", { class: "banner", role: "alert", hidden: true });
  private readonly tip = el("div", { class: "tip", hidden: true });
  private readonly formulas: Formulas;
  private readonly editor: Editor;
  private readonly painter: Painter;
  private readonly panel: Panel;
  private readonly graphs: Graphs;
  private readonly observing: Observing;
  private readonly happened = el("ul", { class: "happened" });
  private readonly told = el("ul", { class: "told", "aria-live": "polite" });
  private readonly motion = el("div", { hidden: true });
  private readonly pointers: Pointers;
  private line: Connection | null = null;
  private scene: Scene = {
    camera: START, run: null, time: 0, chosen: [], scale: new Map(), bright: new Set(), brightLines: new Set(), drag: null,
    comparing: false, fading: new Map(),
  };
  private runs = 0;
  private waiting = false;
  private ran = false;
  private queued = false;
  private inkStale = true;
  private shown = "";
  private hereLast: Point = [80, 80];
  private fitNext = false;
  private asInk = new Map<string, RawStroke>();

  constructor(private places: Places) {
    const { paper, side } = places;
    this.things = new Layer(paper, "things");
    this.dry = new Layer(paper, "dry");
    this.wetLayer = new Layer(paper, "wet", true);
    this.wet = new WetInk(this.wetLayer);
    this.contest = new Contest((name) => { this.contestMode(false); this.analyze(name); });
    paper.append(this.overlay, this.contest.element, places.guide.element, this.banner);
    document.body.append(this.tip);
    this.formulas = new Formulas(this.overlay, this.page, (line) => this.edit(line));
    this.editor = new Editor(this.overlay, {
      write: (line, text, at) => this.act({ do: "write", text, line, at }),
      erase: (line) => this.act({ do: "erase", strokes: [], components: [], lines: [line] }),
      associate: (line, component, anchor) => this.act({ do: "associate", lines: [line], component, anchor }),
      dissociate: (line, component) => this.act({ do: "dissociate", line, component }),
    });
    this.painter = new Painter(this.things, this.dry, this.page, this.formulas);
    const [objects, corrections, remarks] = [el("div"), el("div"), el("div", { id: "remarks" })];
    this.panel = new Panel(objects, corrections, remarks, this.page, {
      act: (action) => this.act(action), edit: (line) => this.edit(line), newFormula: () => this.newFormula(),
      light: (labels, lines) => this.light(labels, lines),
      compare: (on) => { this.scene.comparing = on; this.stale(true); },
    });
    this.player = new Player(() => this.scene.run?.until ?? 0, () => this.scene.run?.ended ?? true, () => this.tick());
    this.graphs = new Graphs((seconds) => { this.player.pause(); this.player.seek(seconds); }, () => this.player.time);
    this.observing = new Observing((chosen) => this.observe(chosen));
    this.controls = new Controls({
      toggle: () => this.toggleRun(), reset: () => this.reset(), step: (n) => this.step(n),
      speed: (factor) => { this.player.speed = factor; }, seek: (seconds) => { this.player.pause(); this.player.seek(seconds); },
    });
    this.motion.append(
      el("h2", {}, "What happens"), this.told, this.happened, el("h2", {}, "Observe"), this.observing.element, this.graphs.element,
      el("button", { type: "button", class: "small", id: "csv", onclick: () => this.saveCsv() }, "Save the graphs' numbers (CSV)"));
    side.append(this.motion, el("h2", {}, "Answers and remarks"), remarks, el("h2", {}, "On the page"), objects, el("h2", {}, "Corrections"), corrections);
    this.pointers = new Pointers(paper, {
      camera: () => this.scene.camera, look: (camera) => this.look(camera), down: (at) => this.down(at),
      wet: (stroke, from) => this.wet.add(stroke, from, this.scene.camera, colours().ink),
      stroke: (stroke) => this.stroke(stroke), cancel: () => this.wet.clear(this.scene.camera),
      drag: (dx, dy, done) => this.drag(dx, dy, done), hover: (at) => this.hover(at),
    });
    new ResizeObserver(() => this.resize()).observe(paper);
    onTheme(() => this.stale(true));
    this.resize();
  }

  /** Opens a page, and closes the one that was open. */
  open(page: string, gone: () => void): void {
    this.line?.close();
    this.reset();
    this.contestMode(false);
    this.page.ink.clear();
    this.page.pending.clear();
    this.fitNext = true;
    this.line = new Connection(page, {
      told: (message) => this.hear(message), packed: (message, numbers) => this.unpack(message, numbers),
      connected: (on, unsent) => {
        this.banner.hidden = on;
        this.banner.textContent = `No connection to the studio: it is tried again.${unsent ? ` ${unsent} thing${unsent === 1 ? "" : "s"} will be sent then.` : ""}`;
      },
      gone: (why) => { say(why); gone(); },
    });
  }

  get connection(): Connection { return this.line!; }
  get pageId(): string { return this.line?.page ?? ""; }
  get pen(): Pointers { return this.pointers; }

  act(action: object): void {
    this.reset();
    this.connection.ask({ type: "do", action });
  }

  analyze(recognizer?: string): void {
    this.reset();
    this.connection.ask({ type: "analyze", ...(recognizer ? { recognizer, anew: true } : {}) });
  }

  undo(): void { this.reset(); this.connection.ask({ type: "undo" }); }
  redo(): void { this.reset(); this.connection.ask({ type: "redo" }); }

  eraseSelected(): void {
    const { strokes, components, lines } = this.page.state.selected;
    if (strokes.length || components.length || lines.length) this.act({ do: "erase", strokes, components, lines });
  }

  nudge(dx: number, dy: number): void {
    if (this.page.selectionBox()) this.act({ do: "move", dx, dy });
    else this.look({ ...this.scene.camera, x: this.scene.camera.x + 4 * dx, y: this.scene.camera.y + 4 * dy });
  }

  letGo(): void {
    if (this.editor.open) this.editor.close();
    else if (this.contest.on) this.contestMode(false);
    else if (this.page.selectionBox()) this.act({ do: "select", strokes: [], components: [], lines: [] });
  }

  zoom(factor: number): void {
    const { clientWidth: wide, clientHeight: high } = this.places.paper;
    this.look(zoomed(this.scene.camera, factor, [wide / 2, high / 2]));
  }

  everything(): void {
    const box = this.page.box();
    const { clientWidth: wide, clientHeight: high } = this.places.paper;
    this.look(box ? fitted(grown(box, 40), wide, high) : START);
  }

  contestMode(on: boolean): void {
    this.contest.toggle(on);
    document.getElementById("contest")?.setAttribute("aria-pressed", String(on));
    if (on) {
      this.reset();
      this.connection.send({ type: "contest", seconds: 3 });
    }
  }

  newFormula(): void {
    const camera = this.scene.camera;
    const [x, y] = toScreen(camera, this.hereLast);
    this.reset();
    this.editor.show(this.page.state, null, this.hereLast, x, y);
  }

  edit(number: number): void {
    const line = this.page.state.lines.find((one) => one.line === number);
    const spot = line && this.formulas.spot(line);
    if (!line) return;
    this.reset();
    const at = spot?.at ?? [0, 0];
    const [x, y] = toScreen(this.scene.camera, at);
    this.editor.show(this.page.state, line, at, x, y + 30);
  }

  savePicture(): void {
    png([this.things.canvas, this.dry.canvas], colours().paper, `${this.page.state.name || "page"}.png`);
  }

  // --- motion

  toggleRun(): void {
    if (this.waiting) return;
    if (!this.scene.run) this.start();
    else if (this.player.playing) this.player.pause();
    else this.player.play();
    this.showControls();
  }

  /** Back to the drawing (row P6). */
  reset(): void {
    if (!this.scene.run && !this.waiting) return;
    this.player.playing = false;
    this.player.time = 0;
    this.waiting = false;
    this.runs++;
    this.line?.send({ type: "stop" });
    this.scene.run = null;
    this.motion.hidden = true;
    this.showControls();
    this.mode();
    this.stale(true);
  }

  step(frames: number): void {
    if (this.scene.run) this.player.step(frames, this.scene.run.head.rate);
    this.showControls();
  }

  private start(): void {
    if (!this.page.state.components.length) {
      say(this.page.state.strokes.length ? "Analyze first: then there is something that can move." : "Draw something first, then Analyze, then Run.");
      return;
    }
    this.editor.close();
    this.waiting = this.connection.send({ type: "run", run: ++this.runs, seconds: Number(this.controls.length.value) });
    this.showControls();
  }

  private showControls(): void {
    this.controls.show(this.scene.run !== null, this.player.playing, this.waiting);
    this.mode();
  }

  private unpack(message: Packed, numbers: Float32Array): void {
    if (message.type === "reading") { this.contest.add(message, numbers); return; }
    const run = this.scene.run;
    if (!run || message.run !== this.runs) return;
    if (message.type === "piece") {
      run.add(message.rows, message.columns, numbers, message.events);
      if (this.waiting) {
        this.waiting = false;
        this.player.play();
        this.showControls();
      }
      this.listEvents(run);
    } else {
      run.series.set(`${message.body} ${message.quantity}`, { ...message, values: numbers });
      this.scene.scale = scales(run, this.scene.chosen);
      if (this.scene.chosen.every((one) => run.series.has(`${one.body} ${one.quantity}`))) this.graphs.show(run, this.scene.chosen);
      this.stale();
    }
  }

  private observe(chosen: Scene["chosen"]): void {
    this.scene.chosen = chosen;
    const run = this.scene.run;
    if (!run?.ended) return;
    const missing = chosen.filter((one) => !run.series.has(`${one.body} ${one.quantity}`));
    for (const { body, quantity } of missing) this.line?.send({ type: "observe", run: run.head.run, body, quantity });
    this.scene.scale = scales(run, chosen);
    if (!missing.length) this.graphs.show(run, chosen);
    this.stale();
  }

  private listEvents(run: Run): void {
    this.happened.replaceChildren(...run.events.slice(0, 60).map((event) =>
      el("li", { "data-time": event.time }, el("button", { type: "button", onclick: () => { this.player.pause(); this.player.seek(event.time); this.showControls(); } },
        `${event.time.toFixed(2)} s: ${event.message}`))));
    if (run.events.length > 60) this.happened.append(el("li", { class: "faint" }, `and ${run.events.length - 60} more`));
  }

  private saveCsv(): void {
    const run = this.scene.run;
    const series = this.scene.chosen.flatMap((one) => run?.series.get(`${one.body} ${one.quantity}`) ?? []);
    if (run && series.length) download(`${this.page.state.name || "motion"}.csv`, csv(run.times(), series), "text/csv");
  }

  private tick(): void {
    const run = this.scene.run;
    this.scene.time = this.player.time;
    if (run) {
      this.controls.tick(this.player.time, run.until);
      this.graphs.tick();
      for (const item of this.happened.children) item.classList.toggle("past", Number(item.getAttribute("data-time")) <= this.player.time + 1e-9);
    }
    this.painter.draw(this.scene);
    if (!this.player.playing) this.showControls();
  }

  // --- what the server says

  private hear(message: Told): void {
    switch (message.type) {
      case "strokes":
        for (const stroke of message.strokes) this.page.ink.set(stroke.id, stroke);
        this.stale(true);
        break;
      case "state":
        for (const [id, stroke] of this.page.pending) if (message.strokes.some((one) => one.id === id)) this.page.ink.set(id, stroke);
        this.page.take(message);
        this.meant();
        break;
      case "drawn":
        this.page.drawn(message.id, message.stroke);
        Object.assign(this.page.state, { seq: message.seq, undo: message.undo, redo: message.redo, next: message.next, loose: message.loose, name: message.name });
        this.meant(message.stroke === undefined);
        break;
      case "ack": this.acknowledged(message); break;
      case "verdicts":
        this.page.verdicts = message.verdicts;
        this.panel.refresh();
        this.formulas.refresh();
        this.stale();
        break;
      case "run":
        if (message.run !== this.runs) break;
        this.scene.run = new Run(message);
        this.player.time = 0;
        this.motion.hidden = false;
        this.told.replaceChildren();
        this.graphs.show(null, []);
        this.stale(true);
        break;
      case "end": this.ended(message); break;
      case "error":
        if (message.key) this.page.pending.delete(message.key);
        if (message.run === this.runs && this.waiting) { this.waiting = false; this.reset(); this.showControls(); }
        say(message.message);
        this.stale(true);
        break;
      case "status":
        if (!message.ready) say("The engine is being made ready for this machine: about a minute, once. You can draw meanwhile.");
        else if (this.waiting) this.mode();
        this.places.mode.dataset["ready"] = String(message.ready);
        break;
      case "pong": break;
    }
  }

  private acknowledged(ack: Extract<Told, { type: "ack" }>): void {
    const stroke = this.page.pending.get(ack.key);
    if (ack.said === "lasso" || ack.said === "scribble" || ack.said === "tap") {
      this.page.pending.delete(ack.key);
      if (stroke) this.scene.fading.set(ack.key, { points: stroke.points, since: performance.now() });
      const raw = this.asInk.get(ack.key);
      if (raw && ack.said !== "tap") say(ack.words || "Selected.", { label: "It was a drawing", act: () => this.keepAsInk(raw) });
      else if (ack.words) say(ack.words);
    } else if (ack.words) say(ack.words);
    this.asInk.delete(ack.key);
    this.stale(true);
  }

  private keepAsInk(raw: RawStroke): void {
    this.undo();
    this.send(raw, true);
  }

  private ended(message: Extract<Told, { type: "end" }>): void {
    const run = this.scene.run;
    if (!run || message.run !== this.runs) return;
    run.ended = true;
    run.told = message.told;
    run.observable = message.observable;
    this.ran = true;
    this.told.replaceChildren(...message.told.map((text) => el("li", {}, text)));
    if (message.seconds < message.asked - 0.05) this.told.append(el("li", { class: "why" }, `The run ends at ${message.seconds.toFixed(2)} s.`));
    this.observing.show(run);
    this.guide();
    this.tick();
  }

  /** The page means something else now; quietly: a stroke has only been confirmed. */
  private meant(quietly = false): void {
    const { state } = this.page;
    if (this.fitNext) {
      this.fitNext = false;
      if (this.page.box()) this.everything();
    }
    this.painter.changed();
    if (!quietly) {
      this.formulas.refresh();
      this.panel.refresh();
    }
    this.places.named(state.title || state.name);
    this.places.steps(state.undo, state.redo);
    this.mode();
    this.guide();
    this.stale(!quietly);
  }

  private guide(): void { this.places.guide.tell({ state: this.page.state, ran: this.ran }); }

  private mode(): void {
    const text = this.waiting
      ? this.places.mode.dataset["ready"] === "false" ? "The engine is being made ready for this machine, about a minute, once; then it runs." : "Computing …"
      : this.scene.run ? "In motion: tap a thing to observe it. Reset to draw and change values." : this.page.state.next;
    if (text !== this.shown) this.places.mode.textContent = this.shown = text;
  }

  // --- pen

  private down(at: Point): "draw" | "drag" | "ignore" {
    this.hereLast = at;
    if (this.contest.on) return "ignore";
    if (this.editor.open) this.editor.close();
    const box = this.scene.run ? null : this.page.selectionBox();
    return box && holds(box, at) ? "drag" : "draw";
  }

  private stroke(raw: RawStroke): void {
    this.wet.clear(this.scene.camera);
    const box = boxOf(raw.points)!;
    const tap = Math.hypot(box.right - box.left, box.bottom - box.top) * this.scene.camera.scale <= MOVED_TAP;
    if (this.scene.run) {
      if (tap) this.pick(raw.points[0]!);
      else say("Reset first: then you can draw again.");
      return;
    }
    if (tap && this.tappedFormula(raw)) return;
    this.send(raw, false);
  }

  private tappedFormula(raw: RawStroke): boolean {
    const paper = this.places.paper.getBoundingClientRect();
    const [x, y] = toScreen(this.scene.camera, raw.points.at(-1)!);
    const line = this.formulas.under(x + paper.left, y + paper.top);
    if (line === null) return false;
    this.edit(line);
    return true;
  }

  private send(raw: RawStroke, ink: boolean): void {
    const key = this.connection.ask({ type: "stroke", points: raw.points, times: raw.times, pressure: raw.pressure, pointer: raw.pointer, ...(ink ? { ink } : {}) });
    this.page.pending.set(key, { id: key, points: raw.points, pressure: raw.pointer === "pen" ? raw.pressure : null, pointer: raw.pointer });
    this.asInk.set(key, raw);
    if (this.page.selectionBox()) this.stale(true);
    else this.painter.addStroke(key, this.scene.camera);
  }

  private drag(dx: number, dy: number, done: boolean): void {
    if (done) {
      this.scene.drag = null;
      this.connection.ask({ type: "do", action: { do: "move", dx, dy } });
    } else this.scene.drag = dx || dy ? [dx, dy] : null;
    this.stale(true);
  }

  private pick(at: Point): void {
    const run = this.scene.run!;
    const part = this.page.state.components.find((one) => {
      const placed = run.placed(one.label, one.shape, this.player.time);
      return placed && hit(placed.shape, at);
    });
    if (part) this.observing.pick(part.label);
  }

  private hover(at: Point | null): void {
    this.tip.hidden = true;
    if (!at) { this.light([], []); return; }
    this.hereLast = at;
    if (this.contest.on || this.scene.run) return;
    const part = [...this.page.state.components].sort((a, b) => size(shapeBox(a.shape)) - size(shapeBox(b.shape))).find((one) => hit(one.shape, at));
    this.light(part ? [part.label] : [], part ? this.page.associationsOf(part.label).map((line) => line.line) : []);
  }

  /** Shows what recognizers say of the stroke under a point, while the contest is on. */
  claimsAt(clientX: number, clientY: number): void {
    const paper = this.places.paper.getBoundingClientRect();
    const camera = this.scene.camera;
    const at: Point = [(clientX - paper.left) / camera.scale + camera.x, (clientY - paper.top) / camera.scale + camera.y];
    const id = this.nearest(at);
    const claims = id ? this.contest.claims(id) : [];
    this.tip.hidden = !claims.length;
    if (!claims.length) return;
    this.tip.replaceChildren(claimsTable(claims));
    this.tip.style.left = `${Math.min(clientX + 14, innerWidth - 350)}px`;
    this.tip.style.top = `${clientY + 14}px`;
  }

  private nearest(at: Point): string | null {
    let best: string | null = null, least = 10;
    for (const { id, dx, dy } of this.page.state.strokes) {
      const points = this.page.ink.get(id)?.points ?? [];
      for (let k = 0; k < points.length; k++) {
        const a = points[Math.max(0, k - 1)]!, b = points[k]!;
        const away = fromSegment([a[0] + dx, a[1] + dy], [b[0] + dx, b[1] + dy], at);
        if (away < least) { least = away; best = id; }
      }
    }
    return best;
  }

  private light(labels: string[], lines: number[]): void {
    const same = labels.length === this.scene.bright.size && labels.every((label) => this.scene.bright.has(label))
      && lines.length === this.scene.brightLines.size && lines.every((line) => this.scene.brightLines.has(line));
    if (same) return;
    this.scene.bright = new Set(labels);
    this.scene.brightLines = new Set(lines);
    this.formulas.light(this.scene.brightLines);
    this.stale();
  }

  // --- drawing

  private look(camera: Camera): void {
    this.scene.camera = camera;
    this.wet.clear(camera);
    this.stale(true);
  }

  private resize(): void {
    const { clientWidth: wide, clientHeight: high } = this.places.paper;
    for (const layer of [this.things, this.dry, this.wetLayer]) layer.resize(wide, high);
    this.stale(true);
  }

  /** Draws in the next frame; ink: finished ink as well. */
  private stale(ink = false): void {
    this.inkStale ||= ink;
    if (this.queued) return;
    this.queued = true;
    requestAnimationFrame(() => {
      this.queued = false;
      const fading = this.scene.fading.size > 0 || this.painter.busy;
      if (this.inkStale || fading) this.painter.ink(this.scene);
      this.inkStale = false;
      if (!this.player.playing) this.painter.draw(this.scene);
      if (fading) this.stale(true);
    });
  }
}

const size = (box: Box): number => (box.right - box.left) * (box.bottom - box.top);
