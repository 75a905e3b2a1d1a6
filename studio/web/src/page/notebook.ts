// The notebook: all pages with their pictures, the examples, and files.

import { api, type PageEntry } from "../wire/api";
import { el, say } from "../ui/dom";

export class Notebook {
  private readonly dialog = el("dialog", { class: "notebook", "aria-label": "Notebook" });
  private readonly grid = el("div", { class: "grid" });
  private readonly search = el("input", { type: "search", placeholder: "Search names and formulas", "aria-label": "Search the notebook" });
  private current = "";

  constructor(private go: (page: string) => void) {
    const file = el("input", { type: "file", accept: ".inklined,.inkml", hidden: true });
    file.addEventListener("change", () => { if (file.files?.[0]) void this.open(file.files[0]); file.value = ""; });
    let wait: ReturnType<typeof setTimeout> | undefined;
    this.search.addEventListener("input", () => { clearTimeout(wait); wait = setTimeout(() => void this.fill(), 150); });
    this.dialog.append(
      el("header", {}, el("h2", {}, "Notebook"), this.search,
        el("button", { type: "button", class: "primary", id: "new-page", onclick: () => void this.fresh() }, "New page"),
        el("button", { type: "button", onclick: () => file.click() }, "Open a file …"),
        el("button", { type: "button", "aria-label": "Close", onclick: () => this.dialog.close() }, "×")),
      file, this.grid);
    document.body.append(this.dialog);
  }

  async show(current: string): Promise<void> {
    this.current = current;
    if (!this.dialog.open) this.dialog.showModal();
    await this.fill();
  }

  /** A file that was dropped or chosen, as a new page. */
  async open(file: File): Promise<void> {
    try {
      this.leave((await api.open(file)).id);
    } catch (error) {
      say((error as Error).message);
    }
  }

  async fresh(): Promise<void> { this.leave((await api.create()).id); }

  private leave(page: string): void {
    if (this.dialog.open) this.dialog.close();
    this.go(page);
  }

  private async fill(): Promise<void> {
    const [pages, examples] = await Promise.all([api.pages(this.search.value), api.examples()]);
    const asked = this.search.value.trim().toLowerCase();
    const fitting = examples.filter((one) => `${one.title} ${one.about}`.toLowerCase().includes(asked));
    this.grid.replaceChildren(
      ...pages.map((page) => this.card(page)),
      ...(pages.length ? [] : [el("p", { class: "faint" }, asked ? "No page of yours has that." : "No pages yet.")]),
      el("h3", {}, "Examples"),
      ...fitting.map((one) => el("div", { class: "card example" },
        el("button", { type: "button", "data-example": one.name, onclick: () => void api.example(one.name).then((page) => this.leave(page.id), (e: Error) => say(e.message)) },
          el("b", {}, one.title), el("span", { class: "faint" }, one.about)))));
  }

  private card(page: PageEntry): HTMLElement {
    const name = page.title || "Untitled";
    return el("div", { class: `card${page.id === this.current ? " current" : ""}` },
      el("button", { type: "button", "data-page": page.id, onclick: () => this.leave(page.id) },
        el("img", { src: api.thumbnail(page), alt: "", loading: "lazy", width: 240, height: 160 }),
        el("b", {}, name),
        el("span", { class: "faint" }, `${page.strokes} strokes, ${new Date(page.changed * 1000).toLocaleString()}`)),
      el("button", { type: "button", class: "small erase", "aria-label": `Throw ${name} away`, onclick: () => void this.throwAway(page) }, "×"));
  }

  private async throwAway(page: PageEntry): Promise<void> {
    await api.throwAway(page.id);
    say(`${page.title || "The page"} was thrown away.`, { label: "Fetch it back", act: () => void api.fetchBack(page.id).then(() => this.fill()) });
    await this.fill();
    if (page.id === this.current) await this.fresh();
  }
}
