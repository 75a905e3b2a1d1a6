import { el } from "./dom";
import { BINDINGS } from "./keys";

const LOCAL = "local/local.html"; // there where onnxruntime-web could be had at install

/** What is moved by pointer and key together. */
const POINTERS: [string, string][] = [
  ["Space and drag, two fingers", "Move the page"],
  ["Ctrl and wheel, pinch", "Zoom"],
];

export function helpDialog(): HTMLDialogElement {
  const local = el("p", { hidden: true }, "Without a server: ", el("a", { href: LOCAL }, "what you draw, told by this browser alone"), ".");
  const dialog = el("dialog", { class: "help", "aria-label": "Help" },
    el("h2", {}, "Draw it, write it, watch it move"),
    el("p", {}, "Draw balls (rings), blocks (polygons), springs (zig-zags) and wires (lines from one thing to another). Write formulas beside them. Analyze, then Run."),
    el("h3", {}, "Three gestures"),
    el("ul", {},
      el("li", {}, el("b", {}, "Circle"), " ink, formulas or shapes to select them; drag inside the frame to move them."),
      el("li", {}, el("b", {}, "Scribble"), " over anything to erase it."),
      el("li", {}, el("b", {}, "Tap"), " a shape to fix it in place or free it; with a formula selected, the tap says what it governs. Tap a formula to correct it.")),
    el("h3", {}, "Keys"),
    el("table", {}, ...[...BINDINGS.map((one): [string, string] => [one.shown, one.does]), ...POINTERS].map(([key, does]) => el("tr", {}, el("th", {}, key), el("td", {}, does)))),
    local,
    el("button", { type: "button", class: "primary", onclick: () => dialog.close() }, "Close"));
  void fetch(LOCAL, { method: "HEAD" }).then((answer) => { local.hidden = !answer.ok; }, () => undefined);
  document.body.append(dialog);
  return dialog;
}
