// Elements in one line each.

type Child = Node | string | null | undefined | false;
type Props = Record<string, string | number | boolean | ((event: never) => void) | undefined>;

/** An element: on… are listeners, the rest attributes; false and undefined are left out. */
export function el<K extends keyof HTMLElementTagNameMap>(tag: K, props: Props = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(props)) {
    if (value === undefined || value === false) continue;
    if (typeof value === "function") made.addEventListener(name.slice(2), value as EventListener);
    else made.setAttribute(name, value === true ? "" : String(value));
  }
  for (const child of children) if (child !== null && child !== undefined && child !== false) made.append(child);
  return made;
}

/** A formula that the server wrote as MathML, as nodes: only elements of MathML without attributes that do anything. */
export function formula(mathml: string): Node {
  const read = new DOMParser().parseFromString(mathml, "application/xml").documentElement;
  return read.localName === "math" ? document.importNode(read, true) : document.createTextNode("");
}

/** Says something, for a while; politely to screen readers. */
export function say(text: string, more?: { label: string; act: () => void }): void {
  const box = document.getElementById("toasts")!;
  const toast = el("div", { class: "toast", role: "status" }, text);
  if (more) toast.append(el("button", { type: "button", onclick: () => { toast.remove(); more.act(); } }, more.label));
  box.append(toast);
  while (box.children.length > 3) box.firstElementChild!.remove();
  setTimeout(() => toast.remove(), more ? 9000 : 5000);
}
