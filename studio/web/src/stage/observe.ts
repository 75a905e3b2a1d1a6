// What is observed of which body: arrows and graphs follow it. One quantity is the chosen one, and bold.

import { el } from "../ui/dom";
import type { Chosen } from "./arrows";
import type { Run } from "./run";

export class Observing {
  readonly element = el("div", { class: "observe" });
  chosen: Chosen[] = [];
  private body = "";
  private run: Run | null = null;
  private colours = new Map<string, number>();

  constructor(private changed: (chosen: Chosen[]) => void) {}

  /** A run has ended: what was observed before is observed again, where it is still there. */
  show(run: Run | null): void {
    this.run = run;
    const bodies = Object.keys(run?.observable ?? {});
    if (!bodies.includes(this.body)) this.body = bodies[0] ?? "";
    this.chosen = this.chosen.filter((one) => run?.observable[one.body]?.includes(one.quantity));
    if (!this.chosen.length && this.body) this.chosen = [this.made(this.body, "velocity", true)];
    this.refresh();
    this.changed(this.chosen);
  }

  /** Observes this body. */
  pick(body: string): void {
    if (!this.run?.observable[body]) return;
    this.body = body;
    if (!this.chosen.some((one) => one.body === body)) this.toggle("velocity", true);
    else this.refresh();
  }

  private made(body: string, quantity: string, bold: boolean): Chosen {
    const key = `${body} ${quantity}`;
    if (!this.colours.has(key)) this.colours.set(key, this.colours.size);
    return { body, quantity, bold, colour: this.colours.get(key)! };
  }

  private toggle(quantity: string, on: boolean): void {
    const others = this.chosen.filter((one) => one.body !== this.body || one.quantity !== quantity);
    this.chosen = on ? [...others.map((one) => ({ ...one, bold: false })), this.made(this.body, quantity, true)] : others;
    if (this.chosen.length && !this.chosen.some((one) => one.bold)) this.chosen[this.chosen.length - 1]!.bold = true;
    this.refresh();
    this.changed(this.chosen);
  }

  private refresh(): void {
    const focus = document.activeElement?.getAttribute("data-id");
    const bodies = Object.keys(this.run?.observable ?? {});
    if (!bodies.length) {
      this.element.replaceChildren(el("p", { class: "faint" }, this.run ? "Nothing on the page can move." : "Run first."));
      return;
    }
    const choice = el("select", { "aria-label": "Body", "data-id": "observe-body" },
      ...bodies.map((label) => el("option", { value: label, selected: label === this.body }, label)));
    choice.addEventListener("change", () => { this.body = choice.value; this.refresh(); });
    const quantities = this.run!.observable[this.body]!.filter((name) => !name.startsWith("work of "));
    this.element.replaceChildren(
      el("label", { class: "bare" }, "Of ", choice),
      el("div", { class: "quantities", role: "group", "aria-label": `Quantities of ${this.body}` }, ...quantities.map((name) => {
        const mine = this.chosen.find((one) => one.body === this.body && one.quantity === name);
        const box = el("input", { type: "checkbox", checked: mine !== undefined, "data-id": `observe-${name}` });
        box.addEventListener("change", () => this.toggle(name, box.checked));
        return el("label", { class: mine?.bold ? "bold" : "" }, box, ` ${name}`);
      })));
    if (focus) this.element.querySelector<HTMLElement>(`[data-id="${CSS.escape(focus)}"]`)?.focus();
  }
}
