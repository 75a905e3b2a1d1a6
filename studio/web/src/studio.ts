// One page that is open: what its rooms (pen, page, stage, graph, contest) have to do with each other and with the server.

import { ClaimsHover } from "./contest/hover";
import { Contest } from "./contest/contest";
import { Editor } from "./page/editor";
import { Formulas, type Chip } from "./page/formulas";
import { PageModel } from "./page/page";
import { Panel } from "./page/panel";
import type { Scene } from "./page/painter";
import { View } from "./page/view";
import { toScreen } from "./pen/camera";
import { Hand } from "./pen/hand";
import type { WetInk } from "./pen/layers";
import type { Pointers } from "./pen/pointer";
import type { Controls } from "./stage/controls";
import type { Player } from "./stage/player";
import { Stage } from "./stage/stage";
import { el, say } from "./ui/dom";
import type { Guide } from "./ui/guide";
import type { Packed, Told } from "./wire/protocol";
import { Line as Connection } from "./wire/socket";

export interface Places { paper: HTMLElement; side: HTMLElement; mode: HTMLElement; guide: Guide; named(name: string): void; steps(undo: string | null, redo: string | null): void }

export class Studio {
  readonly page = new PageModel();
  readonly formulas: Formulas;
  readonly view: View;
  readonly stage: Stage;
  readonly contest: Contest;
  private readonly overlay = el("div", { id: "overlay" });
  private readonly banner = el("div", { class: "banner", role: "alert", hidden: true });
  private readonly editor: Editor;
  private readonly panel: Panel;
  private readonly hand: Hand;
  private line: Connection | null = null;
  private shown = "";
  private fitNext = false;

  constructor(private places: Places) {
    const { paper, side, guide } = places;
    this.formulas = new Formulas(this.overlay, this.page, (chip) => this.editChip(chip));
    this.stage = new Stage(() => this.view, this.page, {
      send: (message) => this.line?.send(message) ?? false, begins: () => this.editor.close(), changed: () => { this.mode(); this.guide(); },
    });
    this.view = new View(paper, this.page, this.formulas, () => this.stage.player.playing);
    this.contest = new Contest((name) => { this.contestMode(false); this.analyze(name); });
    new ClaimsHover(paper, this.page, this.view, this.contest);
    this.editor = new Editor(this.overlay, {
      write: (line, text, at, strokes) => this.act({ do: "write", text, line, at, strokes }),
      erase: (line) => this.act({ do: "erase", strokes: [], components: [], lines: [line] }),
      associate: (line, component, anchor) => this.act({ do: "associate", lines: [line], component, anchor }),
      dissociate: (line, component) => this.act({ do: "dissociate", line, component }),
    });
    const [objects, corrections, remarks] = [el("div"), el("div"), el("div", { id: "remarks" })];
    this.panel = new Panel(objects, corrections, remarks, this.page, {
      act: (action) => this.act(action), edit: (line) => this.edit(line), newFormula: () => this.newFormula(),
      light: (labels, lines) => this.view.light(labels, lines),
      compare: (on) => { this.scene.comparing = on; this.view.stale(true); },
    });
    this.hand = new Hand(paper, this.page, this.view, this.stage, this.editor, this.formulas, {
      ask: (message) => this.connection.ask(message), undo: () => this.undo(), edit: (chip) => this.editChip(chip), busy: () => this.contest.on,
    });
    paper.append(this.overlay, this.contest.element, guide.element, this.banner);
    side.append(this.stage.element, el("h2", {}, "Answers and remarks"), remarks, el("h2", {}, "On the page"), objects, el("h2", {}, "Corrections"), corrections);
  }

  /** Opens a page, and closes the one that was open. */
  open(page: string, gone: () => void): void {
    this.line?.close();
    this.reset();
    this.contestMode(false);
    this.page.empty();
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
  get pen(): Pointers { return this.hand.pointers; }
  get scene(): Scene { return this.view.scene; }
  get player(): Player { return this.stage.player; }
  get controls(): Controls { return this.stage.controls; }
  get wet(): WetInk { return this.view.wet; }

  // --- what can be asked for by button and by key

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
  toggleRun(): void { this.stage.toggle(); }
  reset(): void { this.stage.reset(); }
  step(frames: number): void { this.stage.step(frames); }
  zoom(factor: number): void { this.view.zoom(factor); }
  everything(): void { this.view.everything(); }
  savePicture(): void { this.view.picture(this.page.state.name || "page"); }

  eraseSelected(): void {
    const { strokes, components, lines } = this.page.state.selected;
    if (strokes.length || components.length || lines.length) this.act({ do: "erase", strokes, components, lines });
  }

  nudge(dx: number, dy: number): void {
    if (this.page.selectionBox()) this.act({ do: "move", dx, dy });
    else this.view.pan(4 * dx, 4 * dy);
  }

  letGo(): void {
    if (this.editor.open) this.editor.close();
    else if (this.contest.on) this.contestMode(false);
    else if (this.page.selectionBox()) this.act({ do: "select", strokes: [], components: [], lines: [] });
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
    const [x, y] = toScreen(this.scene.camera, this.hand.last);
    this.reset();
    this.editor.show(this.page.state, null, this.hand.last, x, y);
  }

  /** Edits a line of the page. */
  edit(number: number): void {
    const chip = this.formulas.of(number);
    if (chip) this.editChip(chip);
  }

  private editChip(chip: Chip): void {
    this.reset();
    const at = this.formulas.spot(chip)?.at ?? [0, 0];
    const [x, y] = toScreen(this.scene.camera, at);
    this.editor.show(this.page.state, chip, at, x, y + 30);
  }

  // --- what the server says

  private unpack(message: Packed, numbers: Float32Array): void {
    if (message.type === "reading") this.contest.add(message, numbers);
    else this.stage.took(message, numbers);
  }

  private hear(message: Told): void {
    switch (message.type) {
      case "strokes":
        for (const stroke of message.strokes) this.page.ink.set(stroke.id, stroke);
        this.view.stale(true);
        break;
      case "state":
        this.page.take(message);
        this.meant();
        break;
      case "drawn":
        this.page.drawn(message);
        this.meant(message.stroke === undefined);
        break;
      case "live":
        this.page.live = message.lines;
        this.formulas.refresh();
        this.panel.refresh();
        break;
      case "ack": this.hand.acknowledged(message); break;
      case "verdicts":
        this.page.verdicts = message.verdicts;
        this.panel.refresh();
        this.formulas.refresh();
        this.view.stale();
        break;
      case "run": this.stage.begun(message); break;
      case "end": this.stage.ended(message); break;
      case "error":
        if (message.key) this.page.pending.delete(message.key);
        this.stage.failed(message.run);
        say(message.message);
        this.view.stale(true);
        break;
      case "status":
        if (!message.ready) say("The engine is being made ready for this machine: about a minute, once. You can draw meanwhile.");
        this.places.mode.dataset["ready"] = String(message.ready);
        this.mode();
        break;
      case "pong": break;
    }
  }

  /** The page means something else now; quietly: a stroke has only been confirmed. */
  private meant(quietly = false): void {
    const { state } = this.page;
    if (this.fitNext) {
      this.fitNext = false;
      if (this.page.box()) this.everything();
    }
    this.view.painter.changed();
    if (!quietly) {
      this.formulas.refresh();
      this.panel.refresh();
    }
    this.places.named(state.title || state.name);
    this.places.steps(state.undo, state.redo);
    this.mode();
    this.guide();
    this.view.stale(!quietly);
  }

  private guide(): void { this.places.guide.tell({ state: this.page.state, ran: this.stage.ran }); }

  /** Says in words what the next stroke will do, or what is waited for. */
  private mode(): void {
    const text = this.stage.waiting
      ? this.places.mode.dataset["ready"] === "false" ? "The engine is being made ready for this machine, about a minute, once; then it runs." : "Computing …"
      : this.stage.run ? "In motion: tap a thing to observe it. Reset to draw and change values." : this.page.state.next;
    if (text !== this.shown) this.places.mode.textContent = this.shown = text;
  }
}
