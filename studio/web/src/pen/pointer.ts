import type { Point } from "../wire/protocol";
import { panned, pinched, toPage, zoomed, type Camera } from "./camera";
import { Palm, type Tool } from "./palm";

export interface RawStroke { points: Point[]; times: number[]; pressure: number[]; pointer: Tool }

export interface PenSays {
  camera(): Camera;
  look(camera: Camera): void;
  /** A pointer that would draw comes down: "drag" to be told of its way instead. */
  down(at: Point, tool: Tool): "draw" | "drag" | "ignore";
  wet(stroke: RawStroke, from: number): void;
  stroke(stroke: RawStroke): void;
  cancel(): void;
  drag(dx: number, dy: number, done: boolean): void;
  hover(at: Point | null): void;
}

interface Held { part: "draw" | "drag" | "move"; at: Point; start: Point; stroke: RawStroke | null }

const where = (event: PointerEvent, element: HTMLElement): Point => {
  const box = element.getBoundingClientRect();
  return [event.clientX - box.left, event.clientY - box.top];
};

/** Listens to pens, fingers and mice on an element; points are kept raw, all coalesced ones, with times in seconds. */
export class Pointers {
  readonly palm = new Palm();
  private held = new Map<number, Held>();
  private hand = false;

  constructor(private element: HTMLElement, private says: PenSays) {
    element.addEventListener("pointerdown", this.down);
    element.addEventListener("pointermove", this.move);
    element.addEventListener("pointerup", this.up);
    element.addEventListener("pointercancel", this.cancel);
    element.addEventListener("lostpointercapture", this.up);
    element.addEventListener("pointerleave", () => says.hover(null));
    element.addEventListener("contextmenu", (event) => event.preventDefault());
    element.addEventListener("wheel", this.wheel, { passive: false });
    addEventListener("keydown", (event) => { if (event.code === "Space" && event.target === document.body) this.hand = true; });
    addEventListener("keyup", (event) => { if (event.code === "Space") this.hand = false; });
    addEventListener("blur", () => { this.hand = false; });
  }

  private down = (event: PointerEvent): void => {
    if (event.target !== this.element) return; // what lies over the page, as the editor of a formula, has its own pointers
    const tool = event.pointerType === "pen" || event.pointerType === "touch" ? event.pointerType : "mouse";
    let part = this.palm.part(tool, event.timeStamp, Math.max(event.width, event.height), event.button, this.hand);
    const at = where(event, this.element);
    this.up(event); // whose release nobody told: what was drawn is drawn
    if (part === "draw" && tool === "touch" && this.held.size) {
      this.giveUp(); // a second finger: they move the page
      part = "move";
    }
    if (part === "ignore" || (part === "draw" && [...this.held.values()].some((one) => one.part !== "move"))) return;
    event.preventDefault();
    this.element.setPointerCapture(event.pointerId);
    const held: Held = { part: "move", at, start: at, stroke: null };
    if (part === "draw") {
      const spot = toPage(this.says.camera(), at);
      const does = this.says.down(spot, tool);
      if (does === "ignore") return;
      held.part = does;
      held.stroke = { points: [], times: [], pressure: [], pointer: tool };
      this.add(held.stroke, event);
      if (does === "draw") this.says.wet(held.stroke, 0);
    }
    this.held.set(event.pointerId, held);
  };

  private move = (event: PointerEvent): void => {
    if (event.pointerType === "pen") this.palm.penAt(event.timeStamp, event.buttons !== 0);
    if (event.buttons === 0 && event.pointerType !== "touch") this.up(event);
    const held = this.held.get(event.pointerId);
    if (!held) {
      this.says.hover(toPage(this.says.camera(), where(event, this.element)));
      return;
    }
    const at = where(event, this.element);
    if (held.part === "move") this.moved(event.pointerId, held, at);
    else if (held.stroke) {
      const from = held.stroke.points.length;
      const coalesced = event.getCoalescedEvents?.() ?? [];
      for (const one of coalesced.length ? coalesced : [event]) this.add(held.stroke, one);
      if (held.part === "draw") this.says.wet(held.stroke, from);
      else {
        const scale = this.says.camera().scale;
        this.says.drag((at[0] - held.start[0]) / scale, (at[1] - held.start[1]) / scale, false);
      }
    }
    held.at = at;
  };

  private up = (event: PointerEvent): void => {
    if (event.pointerType === "pen") this.palm.penAt(event.timeStamp, false);
    const held = this.held.get(event.pointerId);
    this.held.delete(event.pointerId);
    if (!held?.stroke) return;
    const at = where(event, this.element), scale = this.says.camera().scale;
    const dx = (at[0] - held.start[0]) / scale, dy = (at[1] - held.start[1]) / scale;
    if (held.part === "drag" && Math.hypot(dx, dy) * scale > 4) this.says.drag(dx, dy, true);
    else {
      if (held.part === "drag") this.says.drag(0, 0, false);
      this.says.stroke(held.stroke);
    }
  };

  private cancel = (event: PointerEvent): void => {
    const held = this.held.get(event.pointerId);
    this.held.delete(event.pointerId);
    if (held?.part === "draw") this.says.cancel();
    if (held?.part === "drag") this.says.drag(0, 0, false);
  };

  private giveUp(): void {
    for (const held of this.held.values()) {
      if (held.part === "draw") this.says.cancel();
      held.part = "move";
      held.stroke = null;
    }
  }

  private moved(id: number, held: Held, at: Point): void {
    const others = [...this.held].filter(([other, one]) => other !== id && one.part === "move");
    const other = others[0]?.[1];
    const camera = this.says.camera();
    this.says.look(
      other
        ? pinched(camera, [held.at, other.at], [at, other.at])
        : panned(camera, at[0] - held.at[0], at[1] - held.at[1]),
    );
  }

  private wheel = (event: WheelEvent): void => {
    if (event.target !== this.element) return;
    event.preventDefault();
    const camera = this.says.camera();
    const box = this.element.getBoundingClientRect();
    if (event.ctrlKey || event.metaKey) {
      this.says.look(zoomed(camera, Math.exp(-event.deltaY / 200), [event.clientX - box.left, event.clientY - box.top]));
    } else this.says.look(panned(camera, -event.deltaX, -event.deltaY));
  };

  private add(stroke: RawStroke, event: PointerEvent): void {
    const [x, y] = toPage(this.says.camera(), where(event, this.element));
    const seconds = (performance.timeOrigin + event.timeStamp) / 1000;
    const last = stroke.times.at(-1);
    stroke.points.push([x, y]);
    stroke.times.push(last !== undefined && last > seconds ? last : seconds);
    stroke.pressure.push(event.pressure);
  }
}
