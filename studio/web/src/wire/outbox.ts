// What was sent and is not acknowledged yet: it outlives a lost connection, and a closed tab.

export interface Keyed { key: string; type: string; [more: string]: unknown }
interface Shelf { getItem(name: string): string | null; setItem(name: string, value: string): void; removeItem(name: string): void }

export class Outbox {
  private waiting = new Map<string, Keyed>();

  constructor(private shelf: Shelf, private name: string) {
    try {
      for (const message of JSON.parse(shelf.getItem(name) ?? "[]") as Keyed[]) this.waiting.set(message.key, message);
    } catch {
      shelf.removeItem(name);
    }
  }

  get size(): number { return this.waiting.size; }

  put(message: Keyed): void { this.waiting.set(message.key, message); }

  /** The message was carried out, or refused for good. */
  settle(key: string): Keyed | undefined {
    const message = this.waiting.get(key);
    this.waiting.delete(key);
    return message;
  }

  /** All that has to be sent (again), in order. */
  all(): Keyed[] { return [...this.waiting.values()]; }

  /** Keeps what waits where it outlives the tab. */
  keep(): void {
    if (this.waiting.size) this.shelf.setItem(this.name, JSON.stringify(this.all()));
    else this.shelf.removeItem(this.name);
  }
}
