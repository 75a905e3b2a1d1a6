import { unpacked } from "./binary";
import { Outbox, type Keyed } from "./outbox";
import type { Packed, Told } from "./protocol";

export interface Hears {
  told(message: Told): void;
  packed(message: Packed, numbers: Float32Array): void;
  connected(on: boolean, unsent: number): void;
  gone(why: string): void;
}

const SOONEST = 250;
const LATEST = 3000;

/** The connection to one page: comes back by itself, and sends again what was not acknowledged. */
export class Line {
  private socket: WebSocket | null = null;
  private closed = false;
  private pause = SOONEST;
  private serial = 0;
  private readonly self = Math.random().toString(36).slice(2, 10);
  readonly outbox: Outbox;

  constructor(readonly page: string, private hears: Hears) {
    this.outbox = new Outbox(localStorage, `inklined-unsent-${page}`);
    addEventListener("pagehide", this.keep);
    this.open();
  }

  /** Sends a message that the server acknowledges by its key, which is returned. */
  ask(message: { type: string; [more: string]: unknown }): string {
    const key = `${Date.now().toString(36)}-${this.self}-${this.serial++}`;
    const keyed: Keyed = { ...message, key };
    this.outbox.put(keyed);
    if (!this.send(keyed)) this.hears.connected(false, this.outbox.size);
    return key;
  }

  /** Sends a message that is worth nothing later: false where there is no connection. */
  send(message: object): boolean {
    if (this.socket?.readyState !== WebSocket.OPEN) return false;
    this.socket.send(JSON.stringify(message));
    return true;
  }

  close(): void {
    this.closed = true;
    removeEventListener("pagehide", this.keep);
    this.keep();
    this.socket?.close();
  }

  private keep = (): void => this.outbox.keep();

  private open(): void {
    const scheme = location.protocol === "https:" ? "wss:" : "ws:";
    const socket = new WebSocket(`${scheme}//${location.host}/ws/${encodeURIComponent(this.page)}`);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    socket.onopen = () => {
      this.pause = SOONEST;
      for (const message of this.outbox.all()) socket.send(JSON.stringify(message));
      this.hears.connected(true, this.outbox.size);
    };
    socket.onmessage = (event: MessageEvent<string | ArrayBuffer>) => {
      if (typeof event.data !== "string") {
        const { told, numbers } = unpacked(event.data);
        this.hears.packed(told, numbers);
        return;
      }
      const told = JSON.parse(event.data) as Told;
      if ((told.type === "ack" || told.type === "error") && told.key !== null && told.key !== undefined) {
        this.outbox.settle(told.key);
        if (!this.outbox.size) this.outbox.keep();
      }
      this.hears.told(told);
    };
    socket.onclose = (event) => {
      if (this.closed) return;
      if (event.code === 4404) {
        this.closed = true;
        this.hears.gone(event.reason);
        return;
      }
      this.outbox.keep();
      this.hears.connected(false, this.outbox.size);
      setTimeout(() => { if (!this.closed) this.open(); }, this.pause);
      this.pause = Math.min(this.pause * 2, LATEST);
    };
  }
}
