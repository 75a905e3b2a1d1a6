// Saving: the server writes .inklined, InkML, SVG, GIF and MP4; a PNG is what is seen.

import { api } from "../wire/api";
import { el } from "../ui/dom";
import { download } from "../ui/download";

const KINDS: [string, string][] = [
  ["inklined", "Everything (.inklined)"],
  ["inkml", "Ink (InkML)"],
  ["svg", "Picture (SVG)"],
  ["gif", "Motion of 3 s (GIF)"],
  ["mp4", "Motion of 3 s (film, MP4)"],
];

/** The layers of the page, one over the other, on paper. */
export function png(layers: HTMLCanvasElement[], paper: string, name: string): void {
  const first = layers[0]!;
  const whole = document.createElement("canvas");
  whole.width = first.width;
  whole.height = first.height;
  const context = whole.getContext("2d")!;
  context.fillStyle = paper;
  context.fillRect(0, 0, whole.width, whole.height);
  for (const layer of layers) context.drawImage(layer, 0, 0);
  whole.toBlob((blob) => { if (blob) download(name, blob); }, "image/png");
}

export function saveMenu(anchor: HTMLElement, page: () => string, picture: () => void): void {
  const old = document.querySelector("menu.save");
  if (old) { old.remove(); return; }
  const close = (): void => { menu.remove(); removeEventListener("pointerdown", outside, true); };
  const outside = (event: Event): void => { if (!menu.contains(event.target as Node) && event.target !== anchor) close(); };
  const menu = el("menu", { class: "save" },
    ...KINDS.map(([kind, text]) => el("li", {}, el("button", {
      type: "button", "data-kind": kind, onclick: () => { el("a", { href: api.exported(page(), kind), download: "" }).click(); close(); },
    }, text))),
    el("li", {}, el("button", { type: "button", "data-kind": "png", onclick: () => { picture(); close(); } }, "Picture of what is seen (PNG)")));
  menu.addEventListener("keydown", (event) => { if (event.key === "Escape") { close(); anchor.focus(); } });
  const box = anchor.getBoundingClientRect();
  menu.style.left = `${box.left}px`;
  menu.style.top = `${box.bottom + 2}px`;
  document.body.append(menu);
  addEventListener("pointerdown", outside, true);
  menu.querySelector("button")!.focus();
}
