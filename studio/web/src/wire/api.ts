export interface PageEntry { id: string; title: string; words: string; strokes: number; created: number; changed: number }
export interface ExampleEntry { name: string; title: string; about: string }
export interface Typed { mathml: string | null; problem: string | null }

async function asked<T>(method: string, path: string, body?: BodyInit, type = "application/json"): Promise<T> {
  const answer = await fetch(path, body === undefined ? { method } : { method, body, headers: { "content-type": type } });
  if (!answer.ok) {
    const said = (await answer.json().catch(() => ({}))) as { detail?: unknown };
    throw new Error(typeof said.detail === "string" ? said.detail : `the studio answered ${answer.status}`);
  }
  return (answer.status === 204 ? undefined : await answer.json()) as T;
}

const safe = encodeURIComponent;

export const api = {
  pages: (words = "") => asked<PageEntry[]>("GET", `/api/pages?words=${safe(words)}`),
  create: () => asked<PageEntry>("POST", "/api/pages", "{}"),
  throwAway: (page: string) => asked<void>("DELETE", `/api/pages/${safe(page)}`),
  fetchBack: (page: string) => asked<void>("POST", `/api/pages/${safe(page)}/back`),
  examples: () => asked<ExampleEntry[]>("GET", "/api/examples"),
  example: (name: string) => asked<PageEntry>("POST", `/api/examples/${safe(name)}`),
  open: (file: File) => asked<PageEntry>("POST", `/api/open?name=${safe(file.name)}`, file, "application/octet-stream"),
  formula: (text: string) => asked<Typed>("GET", `/api/formula?text=${safe(text)}`),
  exported: (page: string, kind: string) => `/api/pages/${safe(page)}/export?kind=${kind}`,
  thumbnail: (page: PageEntry) => `/api/pages/${safe(page.id)}/thumbnail.svg?of=${page.changed}`,
};
