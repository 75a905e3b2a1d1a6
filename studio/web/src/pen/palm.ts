// Which pointers draw, which move the page, and which are a palm. No DOM here: decisions alone.

export type Tool = "pen" | "touch" | "mouse";
export type Part = "draw" | "move" | "ignore";

const REST_MS = 600; // a palm comes down before the pen and leaves after it
const PALM = 60; // CSS pixels: a contact wider than that is no fingertip

/** As soon as a pen has been seen, touch only moves the page, and none at all around the time when the pen draws. */
export class Palm {
  penSeen = false;
  fingerDraws = true;
  private penDown = false;
  private penLast = -Infinity;

  /** What a pointer that comes down does. */
  part(tool: Tool, at: number, size: number, button: number, hand: boolean): Part {
    if (tool === "pen") {
      this.penSeen = true;
      this.penDown = true;
      this.penLast = at;
      return hand ? "move" : "draw";
    }
    if (tool === "mouse") return button === 0 && !hand ? "draw" : button === 2 ? "ignore" : "move";
    if (this.penSeen && (this.penDown || at - this.penLast < REST_MS || size > PALM)) return "ignore";
    return this.penSeen || !this.fingerDraws || hand ? "move" : "draw";
  }

  /** The pen hovers, draws or has left. */
  penAt(at: number, down: boolean): void {
    this.penSeen = true;
    this.penDown = down;
    this.penLast = at;
  }
}
