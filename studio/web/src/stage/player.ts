// The clock of a run: plays what has arrived, at the speed that was chosen.

export class Player {
  time = 0;
  playing = false;
  speed = 1;
  /** Milliseconds between frames shown, the latest ones: for the benchmark. */
  readonly frames: number[] = [];
  /** Milliseconds of work in each of them. */
  readonly work: number[] = [];
  private last = 0;

  constructor(private until: () => number, private ended: () => boolean, private show: () => void) {}

  play(): void {
    if (this.playing) return;
    if (this.ended() && this.time >= this.until() - 1e-9) this.time = 0;
    this.playing = true;
    this.last = performance.now();
    requestAnimationFrame(this.tick);
  }

  pause(): void {
    this.playing = false;
    this.show();
  }

  seek(seconds: number): void {
    this.time = Math.min(Math.max(0, seconds), this.until());
    this.show();
  }

  step(frames: number, rate: number): void {
    this.playing = false;
    this.seek((Math.round(this.time * rate) + frames) / rate);
  }

  private tick = (now: number): void => {
    if (!this.playing) return;
    const passed = Math.max(0, now - this.last);
    this.last = now;
    this.frames.push(passed);
    if (this.frames.length > 3600) this.frames.shift();
    this.time = advanced(this.time, Math.min(passed, 250) / 1000, this.speed, this.until());
    if (this.ended() && this.time >= this.until() - 1e-9) this.playing = false;
    const began = performance.now();
    this.show();
    this.work.push(performance.now() - began);
    if (this.work.length > 3600) this.work.shift();
    if (this.playing) requestAnimationFrame(this.tick);
  };
}

/** The time after a frame: never beyond what has arrived. */
export function advanced(time: number, passed: number, speed: number, until: number): number {
  return Math.min(until, time + passed * speed);
}
