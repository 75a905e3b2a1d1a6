// A page that recognizes with no server: what is drawn is told at pen-up, by the model in this browser.

import "../style.css";
import { boxOf, START, toScreen, union, type Camera } from "../pen/camera";
import { DryInk, Layer, WetInk } from "../pen/layers";
import { Pointers, type RawStroke } from "../pen/pointer";
import { download } from "../ui/download";
import { el, say } from "../ui/dom";
import { apply, colours, onTheme, toggleTheme } from "../ui/theme";
import type { InkStroke } from "../wire/protocol";
import { InkModel, type Read } from "./model";

const at = (id: string): HTMLElement => document.getElementById(id)!;
const paper = at("paper"), labels = el("div", { id: "overlay" }), list = el("ul", { class: "objects", "aria-live": "polite", "aria-label": "What was drawn" });
const dry = new Layer(paper, "dry"), wetLayer = new Layer(paper, "wet", true), wet = new WetInk(wetLayer), ink = new DryInk();
const strokes: (RawStroke & InkStroke)[] = [];
let camera: Camera = START, model: InkModel | null = null, read: Read = { answers: [], things: [] }, turn = 0;

paper.append(labels);
at("side").append(el("h2", {}, "What was drawn"), list);
at("bar").append(
  el("b", {}, "inklined in this browser"),
  el("button", { type: "button", id: "undo", onclick: () => { strokes.pop(); void look(); } }, "Undo"),
  el("button", { type: "button", id: "clear", onclick: () => { strokes.length = 0; void look(); } }, "Clear"),
  el("button", { type: "button", id: "save", onclick: save }, "Save the ink (JSON Lines)"),
  el("span", { class: "space" }),
  el("button", { type: "button", id: "theme", "aria-label": "Light or dark", onclick: toggleTheme }, "◐"));

new Pointers(paper, {
  camera: () => camera, look: (next) => { camera = next; wet.clear(camera); draw(); }, down: () => "draw",
  wet: (stroke, from) => wet.add(stroke, from, camera, colours().ink), cancel: () => wet.clear(camera), drag: () => undefined, hover: () => undefined,
  stroke: (stroke) => {
    strokes.push({ ...stroke, id: String(strokes.length) });
    wet.clear(camera);
    void look();
  },
});
addEventListener("keydown", (event) => {
  if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "z") { event.preventDefault(); strokes.pop(); void look(); }
});

/** Reads the page as it is; an answer that comes after a newer stroke is not shown. */
async function look(): Promise<void> {
  const mine = ++turn;
  draw();
  if (!model) return;
  const now = await model.read(strokes);
  if (mine !== turn) return;
  read = now;
  draw();
}

function draw(): void {
  const context = dry.begin(camera);
  for (const stroke of strokes) ink.draw(context, { stroke, dx: 0, dy: 0, alpha: 1, colour: colours().ink });
  const shown = read.things.filter((thing) => thing.strokes.every((k) => k < strokes.length));
  labels.replaceChildren(...shown.flatMap((thing) => {
    const box = union(thing.strokes.map((k) => boxOf(strokes[k]!.points)));
    if (!box) return [];
    const [x, y] = toScreen(camera, [box.left, box.bottom + 4]);
    const made = el("span", { class: "formula", "data-kind": thing.rejected ? "none" : thing.kind }, said(thing));
    made.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
    return [made];
  }));
  list.replaceChildren(...shown.map((thing) => el("li", {}, `${said(thing)}, ${thing.strokes.length} stroke${thing.strokes.length === 1 ? "" : "s"}`)));
}

const said = (thing: { kind: string; confidence: number; rejected: boolean }): string =>
  thing.rejected ? "nothing known" : `${thing.kind} ${(100 * thing.confidence).toFixed(0)} %`;

/** As sketch/files/jsonl.py reads it: x, y and milliseconds. */
function save(): void {
  const start = strokes[0]?.times[0] ?? 0;
  const rows = strokes.map((one) => one.points.map(([x, y], k) => [x, y, Math.round(1e5 * (one.times[k]! - start)) / 100]));
  download("ink.jsonl", `${JSON.stringify({ strokes: rows })}\n`, "application/jsonl");
}

function resize(): void {
  for (const layer of [dry, wetLayer]) layer.resize(paper.clientWidth, paper.clientHeight);
  draw();
}

apply();
onTheme(draw);
new ResizeObserver(resize).observe(paper);
at("mode").textContent = "The model is being loaded …";
InkModel.loaded().then(
  (made) => {
    model = made;
    at("mode").textContent = "Draw balls, boxes, springs, wires, arrows or signs: this page says what each is. Nothing leaves this browser.";
    void look();
  },
  (error: Error) => { at("mode").textContent = `The model could not be loaded: ${error.message}`; say("The model could not be loaded."); });
