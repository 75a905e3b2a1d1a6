// A small editor for one formula: typed text, read live, with the alternatives and what it is said of.

import { api } from "../wire/api";
import type { Point, State } from "../wire/protocol";
import { el, formula } from "../ui/dom";
import type { Chip } from "./formulas";
import { middle } from "./page";

export interface Asks {
  /** strokes: the ink that says so, where it is no line of the page yet. */
  write(line: number | null, text: string, at: Point | null, strokes: string[]): void;
  erase(line: number): void;
  associate(line: number, component: string, anchor: Point): void;
  dissociate(line: number, component: string): void;
}

export class Editor {
  private box: HTMLElement | null = null;

  constructor(private parent: HTMLElement, private asks: Asks) {}

  get open(): boolean { return this.box !== null; }

  close(): void {
    this.box?.remove();
    this.box = null;
  }

  /** chip: the formula to be edited, null for a new one at a place on the page; x, y: where on the screen. */
  show(state: State, chip: Chip | null, at: Point, x: number, y: number): void {
    this.close();
    const input = el("input", {
      type: "text", class: "formula-text", value: chip?.text ?? "", autocomplete: "off", autocapitalize: "off", spellcheck: "false",
      maxlength: 1000, "aria-label": "Formula, in LaTeX or plain typing", placeholder: "m = 2 kg",
    });
    const shown = el("output", { class: "preview", "aria-live": "polite" });
    const submit = (): void => {
      const text = input.value.trim();
      const there = chip !== null && chip.line !== null;
      if (text && (text !== chip?.text || chip.live)) this.asks.write(chip?.line ?? null, text, there ? null : at, there ? [] : chip?.strokes ?? []);
      this.close();
    };
    const box = el("form", { class: "editor", onsubmit: (event: Event) => { event.preventDefault(); submit(); } },
      el("label", {}, chip ? "This says" : "New formula", input), shown);
    const line = chip?.line ?? null;
    if (chip?.alternatives.length) box.append(this.alternatives(chip, input));
    if (line !== null) box.append(this.saidOf(state, line));
    box.append(el("div", { class: "row" },
      el("button", { type: "submit", class: "primary" }, "OK"),
      el("button", { type: "button", onclick: () => this.close() }, "Cancel"),
      line !== null && el("button", { type: "button", class: "erase", onclick: () => { this.asks.erase(line); this.close(); } }, "Erase")));
    box.addEventListener("keydown", (event) => { if (event.key === "Escape") { event.stopPropagation(); this.close(); } });
    let asked = 0;
    const preview = async (): Promise<void> => {
      const turn = ++asked, text = input.value.trim();
      if (!text) { shown.replaceChildren(); return; }
      const read = await api.formula(text).catch(() => null);
      if (turn !== asked || !read) return;
      shown.replaceChildren(read.mathml ? formula(read.mathml) : el("span", { class: "why" }, read.problem ?? ""));
    };
    input.addEventListener("input", () => void preview());
    this.parent.append(box);
    this.box = box;
    const room = this.parent.getBoundingClientRect();
    box.style.left = `${Math.max(8, Math.min(x, room.width - box.offsetWidth - 8))}px`;
    box.style.top = `${Math.max(8, Math.min(y, room.height - box.offsetHeight - 8))}px`;
    input.focus();
    input.select();
    void preview();
  }

  private alternatives({ alternatives }: Chip, input: HTMLInputElement): HTMLElement {
    return el("div", { class: "row", role: "group", "aria-label": "It may also say" },
      ...alternatives.slice(0, 5).map((text) =>
        el("button", { type: "button", onclick: () => { input.value = text; input.dispatchEvent(new Event("input")); } }, text)));
  }

  private saidOf(state: State, line: number): HTMLElement {
    const mine = state.associations.filter((one) => one.line === line);
    const choice = el("select", { "aria-label": "Say it of" }, el("option", { value: "" }, "say it of …"));
    for (const part of state.components) {
      const spots: [string, Point][] = "start" in part.shape
        ? [["upper end", ends(part.shape.start, part.shape.end)[0]], ["lower end", ends(part.shape.start, part.shape.end)[1]]]
        : [["", middle(part.shape)]];
      for (const [name, [x, y]] of spots) {
        choice.append(el("option", { value: `${part.label} ${x} ${y}` }, `${part.label}, a ${part.kind}${name ? `, ${name}` : ""}`));
      }
    }
    choice.addEventListener("change", () => {
      const [label, x, y] = choice.value.split(" ");
      if (label) this.asks.associate(line, label, [Number(x), Number(y)]);
      this.close();
    });
    return el("div", { class: "row said" },
      ...mine.map((one) => el("span", { class: "of" }, `of ${one.component}`,
        el("button", { type: "button", "aria-label": `No longer of ${one.component}`, onclick: () => { this.asks.dissociate(one.line, one.component); this.close(); } }, "×"))),
      choice);
  }
}

/** (near the upper end, near the lower end) of a link: an angle means something else at either. */
function ends(a: Point, b: Point): [Point, Point] {
  const [up, down] = a[1] <= b[1] ? [a, b] : [b, a];
  const at = (share: number): Point => [up[0] + share * (down[0] - up[0]), up[1] + share * (down[1] - up[1])];
  return [at(0.2), at(0.8)];
}
