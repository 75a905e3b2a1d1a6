import { chips } from "../src/page/formulas";
import { PageModel } from "../src/page/page";
import { BINDINGS, bindingOf, type Commands } from "../src/ui/keys";
import { stepAt, STEPS } from "../src/ui/guide";
import type { Line, LiveLine, State } from "../src/wire/protocol";
import { assert, test } from "./check";

const line = (number: number, text: string | null, strokes: string[]): Line =>
  ({ line: number, text, mathml: null, problem: null, at: null, strokes, confidence: 1, alternatives: [] });
const live = (number: number | null, text: string, strokes: string[]): LiveLine =>
  ({ line: number, text, mathml: null, sure: true, confidence: 0.9, alternatives: [], strokes });

function page(strokes: string[], lines: Line[] = [], owned: string[] = []): PageModel {
  const made = new PageModel();
  const part = { label: "A", kind: "circle", fixed: false, ends: [null, null], strokes: owned, drawn: null, shape: null };
  made.state = { ...made.state, strokes: strokes.map((id) => ({ id, dx: 0, dy: 0, kind: null })), lines, components: owned.length ? [part] : [] } as unknown as State;
  return made;
}

test("a line whose ink has changed shows what it reads as now, and every line is shown once", () => {
  const shown = chips([line(0, "m = 1", ["a"]), line(1, null, ["b"]), line(2, "g = 10", [])], [live(0, "m = 10", ["a", "z"]), live(null, "k = 3", ["c"])]);
  assert.deepEqual(shown.map((one) => [one.line, one.text, one.live]), [[0, "m = 10", true], [1, null, false], [2, "g = 10", false], [null, "k = 3", true]]);
});

test("what is written is shown while its ink is there and nobody has read it", () => {
  const one = live(null, "m = 2", ["a", "b"]);
  const told = (made: PageModel): number => { made.live = [one]; return made.writing().length; };
  assert.equal(told(page(["a", "b"])), 1);
  assert.equal(told(page(["a"])), 0);
  assert.equal(told(page(["a", "b"], [line(0, "m = 2", ["b", "a"])])), 0);
  assert.equal(told(page(["a", "b"], [line(0, null, ["b", "a"])])), 1);
  assert.equal(told(page(["a", "b"], [], ["a"])), 0);
});

test("a stroke that the server has placed is no longer waited for", () => {
  const made = page([]);
  made.pending.set("k", { id: "k", points: [[0, 0]], pressure: null, pointer: "pen" });
  made.drawn({ type: "drawn", id: "k", seq: 1, undo: "x", redo: null, next: "n", loose: 1, name: "N" });
  assert.equal(made.pending.size, 0);
  assert.equal(made.ink.get("k")!.points.length, 1);
  assert.equal(made.state.loose, 1);
});

test("the stroke under the pointer is the nearest one within reach", () => {
  const made = page(["a", "b"]);
  made.ink.set("a", { id: "a", points: [[0, 0], [100, 0]], pressure: null, pointer: "" });
  made.ink.set("b", { id: "b", points: [[0, 12], [100, 12]], pressure: null, pointer: "" });
  assert.equal(made.nearest([50, 3], 10), "a");
  assert.equal(made.nearest([50, 9], 10), "b");
  assert.equal(made.nearest([50, 40], 10), null);
});

test("no key does two things, and each does what the sheet says of it", () => {
  const names = BINDINGS.flatMap((one) => one.keys.map((key) => `${one.ctrl ? "ctrl " : ""}${key}`));
  assert.equal(new Set(names).size, names.length);
  const done: string[] = [];
  const commands = new Proxy({}, { get: (_, name) => (): void => void done.push(String(name)) }) as Commands;
  for (const one of BINDINGS) {
    assert.ok(one.shown && one.does);
    for (const key of one.keys) one.act(commands, { key, ctrl: one.ctrl ?? false, shift: false });
  }
  assert.deepEqual(new Set(done), new Set(["analyze", "toggleRun", "reset", "step", "undo", "redo", "formula", "erase", "nudge", "letGo", "zoom", "everything", "contest", "notebook", "help"]));
});

test("a button keeps Enter and a slider its arrows", () => {
  const press = (key: string): { key: string; ctrl: boolean; shift: boolean } => ({ key, ctrl: false, shift: false });
  assert.equal(bindingOf(press("enter"), "button"), undefined);
  assert.ok(bindingOf(press("enter"), null));
  assert.equal(bindingOf(press("arrowleft"), "input"), undefined);
  assert.ok(bindingOf(press("arrowleft"), "button"));
  assert.equal(bindingOf({ ...press("a"), ctrl: true }), undefined);
});

test("the guided page goes on by what was done, and never back", () => {
  const blank = page([]).state, drawn = page(["a"]).state;
  assert.equal(stepAt({ state: blank, ran: false }, 0), 0);
  assert.equal(stepAt({ state: drawn, ran: false }, 0), 1);
  assert.equal(stepAt({ state: blank, ran: false }, 1), 1);
  assert.equal(stepAt({ state: blank, ran: true }, STEPS.length), STEPS.length);
});
