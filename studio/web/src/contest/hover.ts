// While the contest is on: what every recognizer says of the stroke under the pointer.

import type { PageModel } from "../page/page";
import type { View } from "../page/view";
import { el } from "../ui/dom";
import { claimsTable, type Contest } from "./contest";

const REACH = 10; // page units

export class ClaimsHover {
  private readonly tip = el("div", { class: "tip", hidden: true });

  constructor(paper: HTMLElement, private page: PageModel, private view: View, private contest: Contest) {
    document.body.append(this.tip);
    paper.addEventListener("pointermove", (event) => this.show(event));
    paper.addEventListener("pointerleave", () => { this.tip.hidden = true; });
  }

  private show(event: PointerEvent): void {
    const id = this.contest.on ? this.page.nearest(this.view.at(event.clientX, event.clientY), REACH) : null;
    const claims = id ? this.contest.claims(id) : [];
    this.tip.hidden = !claims.length;
    if (!claims.length) return;
    this.tip.replaceChildren(claimsTable(claims));
    this.tip.style.left = `${Math.min(event.clientX + 14, innerWidth - 350)}px`;
    this.tip.style.top = `${event.clientY + 14}px`;
  }
}
