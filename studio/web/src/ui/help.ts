import { el } from "./dom";

export const KEYS: [string, string][] = [
  ["A", "Analyze: read what was drawn"],
  ["Enter", "Run, pause, play"],
  ["R", "Reset: back to the start, to draw and change"],
  [", and .", "One frame back, one frame on"],
  ["Ctrl+Z, Ctrl+Shift+Z", "Undo, redo (without limit)"],
  ["F", "Type a formula"],
  ["Delete", "Erase what is selected"],
  ["Arrow keys", "Move what is selected; otherwise the page"],
  ["Esc", "Let go of what is selected; close what is open"],
  ["+ and −, 0", "Zoom; show everything"],
  ["C", "How each recognizer reads the page"],
  ["N", "Notebook"],
  ["Space and drag, two fingers", "Move the page"],
  ["Ctrl and wheel, pinch", "Zoom"],
  ["?", "This sheet"],
];

export function helpDialog(): HTMLDialogElement {
  const dialog = el("dialog", { class: "help", "aria-label": "Help" },
    el("h2", {}, "Draw it, write it, watch it move"),
    el("p", {}, "Draw balls (rings), blocks (polygons), springs (zig-zags) and wires (lines from one thing to another). Write formulas beside them. Analyze, then Run."),
    el("h3", {}, "Three gestures"),
    el("ul", {},
      el("li", {}, el("b", {}, "Circle"), " ink, formulas or shapes to select them; drag inside the frame to move them."),
      el("li", {}, el("b", {}, "Scribble"), " over anything to erase it."),
      el("li", {}, el("b", {}, "Tap"), " a shape to fix it in place or free it; with a formula selected, the tap says what it governs. Tap a formula to correct it.")),
    el("h3", {}, "Keys"),
    el("table", {}, ...KEYS.map(([key, does]) => el("tr", {}, el("th", {}, key), el("td", {}, does)))),
    el("button", { type: "button", class: "primary", onclick: () => dialog.close() }, "Close"));
  document.body.append(dialog);
  return dialog;
}
