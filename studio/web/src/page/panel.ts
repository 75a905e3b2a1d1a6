// Beside the page: what is on it, what was corrected, what is to be said of it. All of it can be walked by keyboard.

import { el, formula } from "../ui/dom";
import type { Component, Line, LiveLine } from "../wire/protocol";
import type { PageModel } from "./page";

export interface PanelAsks {
  act(action: object): void;
  edit(line: number): void;
  light(labels: string[], lines: number[]): void;
  compare(on: boolean): void;
  newFormula(): void;
}

const KINDS: Record<Component["kind"], string> = { circle: "ball", polygon: "block", spring: "spring", wire: "wire", arrow: "arrow" };

export class Panel {
  private comparing = false;

  constructor(private objects: HTMLElement, private corrections: HTMLElement, private remarks: HTMLElement,
    private page: PageModel, private asks: PanelAsks) {}

  refresh(): void {
    this.keepFocus(() => {
      this.objects.replaceChildren(...this.objectList());
      this.corrections.replaceChildren(...this.correctionList());
      this.remarks.replaceChildren(...this.remarkList());
    });
  }

  private keepFocus(change: () => void): void {
    const id = document.activeElement?.getAttribute("data-id");
    change();
    if (id) document.querySelector<HTMLElement>(`[data-id="${CSS.escape(id)}"]`)?.focus();
  }

  private objectList(): Node[] {
    const { components, lines, loose } = this.page.state;
    const items = [
      ...components.map((part) => this.component(part)),
      ...lines.filter((line) => line.text !== null || line.strokes.length).map((line) => this.line(line)),
      ...this.page.writing().map((line) => this.written(line)),
    ];
    const nothing = loose ? `${loose} stroke${loose === 1 ? "" : "s"} not read yet` : "Nothing yet";
    return [
      items.length ? el("ul", { class: "objects", "aria-label": "What is on the page" }, ...items) : el("p", { class: "faint" }, nothing),
      el("button", { type: "button", class: "link", "data-id": "new-formula", onclick: () => this.asks.newFormula() }, "Type a formula …"),
    ];
  }

  private component(part: Component): HTMLElement {
    const lines = this.page.associationsOf(part.label), solid = part.kind === "circle" || part.kind === "polygon";
    const tied = part.ends.filter((end) => end !== null);
    const said = `${KINDS[part.kind]} ${part.label}${part.fixed ? ", stays" : ""}${tied.length ? `, on ${tied.join(" and ")}` : ""}`;
    const light = (): void => this.asks.light([part.label], lines.map((line) => line.line));
    return el("li", { onmouseenter: light, onmouseleave: () => this.asks.light([], []) },
      el("button", {
        type: "button", class: `object ${part.kind}`, "data-id": `part-${part.label}`, onfocus: light, onblur: () => this.asks.light([], []),
        "aria-label": `${said}${lines.length ? `; said of it: ${lines.map((line) => line.text).join(", ")}` : ""}`,
        onclick: () => this.asks.act({ do: "select", strokes: [], components: [part.label], lines: [] }),
      }, el("b", {}, part.label), ` ${KINDS[part.kind]}${tied.length ? ` on ${tied.join(", ")}` : ""}`,
        ...lines.map((line) => el("span", { class: "tag" }, line.mathml ? formula(line.mathml) : line.text ?? "?"))),
      solid && el("button", {
        type: "button", class: "small", "data-id": `fix-${part.label}`, "aria-pressed": String(part.fixed),
        "aria-label": `${part.label} stays where it is`,
        onclick: () => this.asks.act({ do: "fix", component: part.label, fixed: !part.fixed }),
      }, part.fixed ? "stays" : "can move"),
      el("button", {
        type: "button", class: "small erase", "data-id": `erase-${part.label}`, "aria-label": `Erase ${part.label}`,
        onclick: () => this.asks.act({ do: "erase", strokes: [], components: [part.label], lines: [] }),
      }, "×"));
  }

  private line(line: Line): HTMLElement {
    const of = this.page.state.associations.filter((one) => one.line === line.line).map((one) => one.component);
    const light = (): void => this.asks.light(of, [line.line]);
    return el("li", { onmouseenter: light, onmouseleave: () => this.asks.light([], []) },
      el("button", {
        type: "button", class: "object line", "data-id": `line-${line.line}`, onfocus: light, onblur: () => this.asks.light([], []),
        "aria-label": `Formula ${line.text ?? "not read yet"}${of.length ? `, of ${of.join(", ")}` : ""}; edit`, onclick: () => this.asks.edit(line.line),
      }, line.mathml ? formula(line.mathml) : el("i", {}, line.text ?? "what does this say?"),
        el("span", { class: "faint" }, of.length ? ` of ${of.join(", ")}` : " for the whole page"),
        line.problem && el("span", { class: "why" }, line.problem)));
  }

  private written(line: LiveLine): HTMLElement {
    return el("li", { class: "faint" }, line.sure ? "being written: " : "being written, not sure: ", line.mathml ? formula(line.mathml) : line.text);
  }

  private correctionList(): Node[] {
    const { corrections } = this.page.state;
    if (!corrections.length) return [el("p", { class: "faint" }, "Nothing was corrected.")];
    const compare = el("button", {
      type: "button", class: "small", "data-id": "compare", "aria-pressed": String(this.comparing),
      onclick: () => { this.comparing = !this.comparing; this.asks.compare(this.comparing); this.refresh(); },
    }, this.comparing ? "Show as corrected" : "Show as drawn");
    return [compare, el("ul", { class: "corrections" }, ...corrections.map((one) =>
      el("li", { class: one.made ? "" : "left", onmouseenter: () => this.asks.light(one.labels, []), onmouseleave: () => this.asks.light([], []) },
        el("span", {}, one.why[0] ?? "", one.why.length > 1 && el("span", { class: "faint" }, ` (and ${one.why.length - 1} more)`)),
        el("button", {
          type: "button", class: "small", "data-id": `correction-${one.rule}-${one.component}`,
          "aria-label": `${one.made ? "Undo" : "Make again"}: ${one.why[0] ?? ""}`,
          onclick: () => this.asks.act({ do: one.made ? "leave" : "correct", rule: one.rule, component: one.component }),
        }, one.made ? "undo" : "again"))))];
  }

  private remarkList(): Node[] {
    const { notices } = this.page.state;
    const verdicts = this.page.verdicts.map((one) => el("li", { class: `verdict ${one.status.split(" ")[0]}` },
      el("b", {}, `${one.component}: `), one.message,
      one.dimensions !== null && !one.message.includes(one.dimensions) && el("span", { class: "why" }, one.dimensions)));
    const told = notices.map((text) => el("li", {}, text));
    return verdicts.length + told.length
      ? [el("ul", { class: "remarks", "aria-live": "polite" }, ...verdicts, ...told)]
      : [el("p", { class: "faint" }, "Nothing to remark.")];
  }
}
