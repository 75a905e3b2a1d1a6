import "../node_modules/uplot/dist/uPlot.min.css";
import "./style.css";
import { api } from "./wire/api";
import { saveMenu } from "./page/files";
import { Notebook } from "./page/notebook";
import { Studio } from "./studio";
import { el, say } from "./ui/dom";
import { Guide } from "./ui/guide";
import { helpDialog } from "./ui/help";
import { keys } from "./ui/keys";
import { apply, toggleTheme } from "./ui/theme";

const at = (id: string): HTMLElement => document.getElementById(id)!;

apply();
const guide = new Guide();
const help = helpDialog();
const title = el("input", { type: "text", class: "title", id: "title", maxlength: 200, "aria-label": "Name of the page" });
const undo = el("button", { type: "button", id: "undo", "aria-label": "Undo", onclick: () => studio.undo() }, "↶");
const redo = el("button", { type: "button", id: "redo", "aria-label": "Redo", onclick: () => studio.redo() }, "↷");
const studio: Studio = new Studio({
  paper: at("paper"), side: at("side"), mode: at("mode"), guide,
  named: (name) => {
    document.title = `${name} – inklined`;
    if (document.activeElement !== title) title.value = name === "Untitled" ? "" : name;
    title.placeholder = "Untitled";
  },
  steps: (back, forth) => {
    undo.disabled = back === null;
    redo.disabled = forth === null;
    undo.title = back === null ? "Nothing to undo" : `Undo ${back} (Ctrl+Z)`;
    redo.title = forth === null ? "Nothing to do again" : `Do ${forth} again (Ctrl+Shift+Z)`;
  },
});
const notebook = new Notebook((page) => { location.hash = `page=${page}`; });

title.addEventListener("change", () => studio.act({ do: "title", title: title.value.trim() }));
title.addEventListener("keydown", (event) => { if (event.key === "Enter") title.blur(); });

const finger = el("button", { type: "button", id: "finger", "aria-pressed": "true", title: "Whether a finger draws; with a pen it moves the page", onclick: () => {
  const { palm } = studio.pen;
  palm.fingerDraws = !palm.fingerDraws;
  palm.penSeen = !palm.fingerDraws;
  finger.setAttribute("aria-pressed", String(palm.fingerDraws));
} }, "Finger draws");
const save = el("button", { type: "button", id: "save", "aria-haspopup": "menu", onclick: () => saveMenu(save, () => studio.pageId, () => studio.savePicture()) }, "Save …");
at("bar").append(
  el("button", { type: "button", id: "notebook", title: "Notebook (N)", onclick: () => void notebook.show(studio.pageId) }, "Notebook"),
  title, undo, redo,
  el("button", { type: "button", class: "primary", id: "analyze", title: "Read what was drawn (A)", onclick: () => studio.analyze() }, "Analyze"),
  studio.controls.element,
  el("span", { class: "space" }),
  el("button", { type: "button", id: "contest", "aria-pressed": "false", title: "How each recognizer reads the page (C)", onclick: () => studio.contestMode(!studio.contest.on) }, "Contest"),
  ...(navigator.maxTouchPoints > 0 ? [finger] : []),
  save,
  el("button", { type: "button", id: "theme", "aria-label": "Light or dark", onclick: toggleTheme }, "◐"),
  el("button", { type: "button", id: "tour", "aria-label": "Guided first page", title: "Guided first page", onclick: () => void notebook.fresh().then(() => guide.begin(true)) }, "Tour"),
  el("button", { type: "button", id: "help", "aria-label": "Help", onclick: () => help.showModal() }, "?"),
);

keys({
  analyze: () => studio.analyze(), toggleRun: () => studio.toggleRun(), reset: () => studio.reset(), step: (n) => studio.step(n),
  undo: () => studio.undo(), redo: () => studio.redo(), formula: () => studio.newFormula(), erase: () => studio.eraseSelected(),
  nudge: (dx, dy) => studio.nudge(dx, dy), letGo: () => studio.letGo(), zoom: (factor) => studio.zoom(factor), everything: () => studio.everything(),
  contest: () => studio.contestMode(!studio.contest.on), notebook: () => void notebook.show(studio.pageId), help: () => help.showModal(),
});

addEventListener("dragover", (event) => event.preventDefault());
addEventListener("drop", (event) => {
  event.preventDefault();
  const file = event.dataTransfer?.files[0];
  if (file) void notebook.open(file);
});

async function route(): Promise<void> {
  const named = new URLSearchParams(location.hash.slice(1)).get("page");
  if (named) {
    if (named !== studio.pageId) studio.open(named, () => { location.hash = ""; });
    return;
  }
  const [latest] = await api.pages();
  if (!latest) guide.begin(false);
  location.replace(`#page=${(latest ?? (await api.create())).id}`);
}

addEventListener("hashchange", () => void route().catch((error: Error) => say(error.message)));
void route().catch((error: Error) => say(error.message));
// For benchmarks and tests: what drawing and frames cost.
Object.assign(window, { inklined: studio });
