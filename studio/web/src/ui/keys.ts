// Keyboard: everything that pen and mouse can do.

export interface Commands {
  analyze(): void; toggleRun(): void; reset(): void; step(frames: number): void; undo(): void; redo(): void;
  formula(): void; erase(): void; nudge(dx: number, dy: number): void; letGo(): void; zoom(factor: number): void;
  everything(): void; contest(): void; notebook(): void; help(): void;
}

const typing = (target: EventTarget | null): boolean =>
  target instanceof HTMLInputElement && target.type !== "range" && target.type !== "checkbox" || target instanceof HTMLSelectElement || target instanceof HTMLTextAreaElement;
const STEP = 10;

export function keys(commands: Commands): void {
  addEventListener("keydown", (event) => {
    if (event.defaultPrevented || document.querySelector("dialog[open]") || event.altKey) return;
    if (typing(event.target) && event.key !== "Escape") return;
    const act = commandOf(event, commands);
    if (!act) return;
    event.preventDefault();
    act();
  });
}

function commandOf(event: KeyboardEvent, to: Commands): (() => void) | null {
  const onButton = event.target instanceof HTMLButtonElement;
  if (event.ctrlKey || event.metaKey) {
    switch (event.key.toLowerCase()) {
      case "z": return event.shiftKey ? to.redo : to.undo;
      case "y": return to.redo;
      default: return null;
    }
  }
  switch (event.key) {
    case "a": case "A": return to.analyze;
    case "Enter": return onButton ? null : to.toggleRun;
    case "r": case "R": return to.reset;
    case ",": return () => to.step(-1);
    case ".": return () => to.step(1);
    case "f": case "F": return to.formula;
    case "Delete": case "Backspace": return to.erase;
    case "ArrowLeft": return range(event) ? null : () => to.nudge(-STEP, 0);
    case "ArrowRight": return range(event) ? null : () => to.nudge(STEP, 0);
    case "ArrowUp": return range(event) ? null : () => to.nudge(0, -STEP);
    case "ArrowDown": return range(event) ? null : () => to.nudge(0, STEP);
    case "Escape": return to.letGo;
    case "+": case "=": return () => to.zoom(1.25);
    case "-": return () => to.zoom(0.8);
    case "0": return to.everything;
    case "c": case "C": return to.contest;
    case "n": case "N": return to.notebook;
    case "?": return to.help;
    default: return null;
  }
}

const range = (event: KeyboardEvent): boolean => event.target instanceof HTMLInputElement;
