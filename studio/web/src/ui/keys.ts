// Keyboard: everything that pen and mouse can do. One table says what each key does and what the help sheet says of it.

export interface Commands {
  analyze(): void; toggleRun(): void; reset(): void; step(frames: number): void; undo(): void; redo(): void;
  formula(): void; erase(): void; nudge(dx: number, dy: number): void; letGo(): void; zoom(factor: number): void;
  everything(): void; contest(): void; notebook(): void; help(): void;
}

/** What was pressed: the key in small letters. */
export interface Pressed { key: string; ctrl: boolean; shift: boolean }
/** keys: in small letters; ctrl: with Ctrl (or Cmd); not: elements that use these keys themselves. */
export interface Binding { keys: string[]; ctrl?: boolean; not?: "button" | "input"; shown: string; does: string; act(to: Commands, pressed: Pressed): void }

const STEP = 10; // page units
const ARROWS: Record<string, [number, number]> = { arrowleft: [-STEP, 0], arrowright: [STEP, 0], arrowup: [0, -STEP], arrowdown: [0, STEP] };

export const BINDINGS: Binding[] = [
  { keys: ["a"], shown: "A", does: "Analyze: read what was drawn", act: (to) => to.analyze() },
  { keys: ["enter"], not: "button", shown: "Enter", does: "Run, pause, play", act: (to) => to.toggleRun() },
  { keys: ["r"], shown: "R", does: "Reset: back to the start, to draw and change", act: (to) => to.reset() },
  { keys: [",", "."], shown: ", and .", does: "One frame back, one frame on", act: (to, { key }) => to.step(key === "," ? -1 : 1) },
  { keys: ["z"], ctrl: true, shown: "Ctrl+Z, Ctrl+Shift+Z", does: "Undo, redo (without limit)", act: (to, { shift }) => (shift ? to.redo() : to.undo()) },
  { keys: ["y"], ctrl: true, shown: "Ctrl+Y", does: "Redo", act: (to) => to.redo() },
  { keys: ["f"], shown: "F", does: "Type a formula", act: (to) => to.formula() },
  { keys: ["delete", "backspace"], shown: "Delete, Backspace", does: "Erase what is selected", act: (to) => to.erase() },
  { keys: Object.keys(ARROWS), not: "input", shown: "Arrow keys", does: "Move what is selected; otherwise the page", act: (to, { key }) => to.nudge(...ARROWS[key]!) },
  { keys: ["escape"], shown: "Esc", does: "Let go of what is selected; close what is open", act: (to) => to.letGo() },
  { keys: ["+", "=", "-"], shown: "+ and −", does: "Zoom", act: (to, { key }) => to.zoom(key === "-" ? 0.8 : 1.25) },
  { keys: ["0"], shown: "0", does: "Show everything", act: (to) => to.everything() },
  { keys: ["c"], shown: "C", does: "How each recognizer reads the page", act: (to) => to.contest() },
  { keys: ["n"], shown: "N", does: "Notebook", act: (to) => to.notebook() },
  { keys: ["?"], shown: "?", does: "This sheet", act: (to) => to.help() },
];

/** What a key does where nothing else wants it. */
export function bindingOf({ key, ctrl }: Pressed, on: "button" | "input" | null = null): Binding | undefined {
  return BINDINGS.find((one) => one.keys.includes(key) && (one.ctrl ?? false) === ctrl && (one.not === undefined || one.not !== on));
}

const typing = (target: EventTarget | null): boolean =>
  target instanceof HTMLInputElement && target.type !== "range" && target.type !== "checkbox" || target instanceof HTMLSelectElement || target instanceof HTMLTextAreaElement;

export function keys(commands: Commands): void {
  addEventListener("keydown", (event) => {
    if (event.defaultPrevented || document.querySelector("dialog[open]") || event.altKey) return;
    if (typing(event.target) && event.key !== "Escape") return;
    const pressed = { key: event.key.toLowerCase(), ctrl: event.ctrlKey || event.metaKey, shift: event.shiftKey };
    const on = event.target instanceof HTMLButtonElement ? "button" : event.target instanceof HTMLInputElement ? "input" : null;
    const found = bindingOf(pressed, on);
    if (!found) return;
    event.preventDefault();
    found.act(commands, pressed);
  });
}
