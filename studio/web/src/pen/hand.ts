// What a pointer on the page does: it draws, drags what is selected, or taps; what it drew is sent, and what that was
// taken for is shown.

import type { Editor } from "../page/editor";
import type { Chip, Formulas } from "../page/formulas";
import { hit, shapeBox, type PageModel } from "../page/page";
import { span, type View } from "../page/view";
import type { Stage } from "../stage/stage";
import { say } from "../ui/dom";
import type { Point, Told } from "../wire/protocol";
import { holds, toScreen, type Box } from "./camera";
import { Pointers, type RawStroke } from "./pointer";

export interface HandAsks {
  /** Sends a message that the server acknowledges by its key, which is returned. */
  ask(message: { type: string; [more: string]: unknown }): string;
  undo(): void;
  edit(chip: Chip): void;
  /** Whether drawing is not to be had now. */
  busy(): boolean;
}

const TAP = 6; // CSS pixels: a stroke that spans less is a tap

export class Hand {
  readonly pointers: Pointers;
  /** Where the pointer was last, page units. */
  last: Point = [80, 80];
  private sent = new Map<string, RawStroke>();

  constructor(
    private paper: HTMLElement, private page: PageModel, private view: View, private stage: Stage, private editor: Editor,
    private formulas: Formulas, private asks: HandAsks,
  ) {
    this.pointers = new Pointers(paper, {
      camera: () => view.scene.camera, look: (camera) => view.look(camera), down: (at) => this.down(at),
      wet: (stroke, from) => view.drawing(stroke, from), stroke: (stroke) => this.stroke(stroke), cancel: () => view.dried(),
      drag: (dx, dy, done) => this.drag(dx, dy, done), hover: (at) => this.hover(at),
    });
  }

  /** The server has taken a stroke for something. */
  acknowledged(ack: Extract<Told, { type: "ack" }>): void {
    const stroke = this.page.pending.get(ack.key), raw = this.sent.get(ack.key);
    this.sent.delete(ack.key);
    const gesture = ack.said === "lasso" || ack.said === "scribble" || ack.said === "tap";
    if (gesture) {
      this.page.pending.delete(ack.key);
      if (stroke) this.view.scene.fading.set(ack.key, { points: stroke.points, since: performance.now() });
    }
    if (gesture && raw && ack.said !== "tap") say(ack.words || "Selected.", { label: "It was a drawing", act: () => { this.asks.undo(); this.send(raw, true); } });
    else if (ack.words) say(ack.words);
    this.view.stale(true);
  }

  private down(at: Point): "draw" | "drag" | "ignore" {
    this.last = at;
    if (this.asks.busy()) return "ignore";
    if (this.editor.open) this.editor.close();
    const box = this.stage.run ? null : this.page.selectionBox();
    return box && holds(box, at) ? "drag" : "draw";
  }

  private stroke(raw: RawStroke): void {
    this.view.dried();
    const tap = span(raw.points) * this.view.scene.camera.scale <= TAP;
    if (this.stage.run) {
      if (tap) this.stage.pick(raw.points[0]!);
      else say("Reset first: then you can draw again.");
    } else if (!(tap && this.tappedFormula(raw))) this.send(raw, false);
  }

  private tappedFormula(raw: RawStroke): boolean {
    const paper = this.paper.getBoundingClientRect();
    const [x, y] = toScreen(this.view.scene.camera, raw.points.at(-1)!);
    const chip = this.formulas.under(x + paper.left, y + paper.top);
    if (chip === null) return false;
    this.asks.edit(chip);
    return true;
  }

  private send(raw: RawStroke, ink: boolean): void {
    const key = this.asks.ask({ type: "stroke", points: raw.points, times: raw.times, pressure: raw.pressure, pointer: raw.pointer, ...(ink ? { ink } : {}) });
    this.page.pending.set(key, { id: key, points: raw.points, pressure: raw.pointer === "pen" ? raw.pressure : null, pointer: raw.pointer });
    this.sent.set(key, raw);
    this.formulas.lifted(key);
    if (this.page.selectionBox()) this.view.stale(true);
    else this.view.painter.addStroke(key, this.view.scene.camera);
  }

  private drag(dx: number, dy: number, done: boolean): void {
    const { scene } = this.view;
    if (done) {
      scene.drag = null;
      this.asks.ask({ type: "do", action: { do: "move", dx, dy } });
    } else scene.drag = dx || dy ? [dx, dy] : null;
    this.view.stale(true);
  }

  /** Shows what is said of the thing under the pointer (row P4). */
  private hover(at: Point | null): void {
    if (!at) { this.view.light([], []); return; }
    this.last = at;
    if (this.asks.busy() || this.stage.run) return;
    const part = [...this.page.state.components].sort((a, b) => size(shapeBox(a.shape)) - size(shapeBox(b.shape))).find((one) => hit(one.shape, at));
    this.view.light(part ? [part.label] : [], part ? this.page.associationsOf(part.label).map((line) => line.line) : []);
  }
}

const size = (box: Box): number => (box.right - box.left) * (box.bottom - box.top);
