import uPlot from "uplot";
import { el } from "../ui/dom";
import { colours, onTheme } from "../ui/theme";
import { sizes, type Run, type Series } from "../stage/run";
import type { Chosen } from "../stage/arrows";

interface Graph { plot: uPlot; now: HTMLElement }

/** Live graphs, one for each unit; a line shows the time, the cursor reads values and a click goes to its time. */
export class Graphs {
  readonly element = el("div", { class: "graphs" });
  private graphs: Graph[] = [];
  private run: Run | null = null;
  private chosen: Chosen[] = [];

  constructor(private seek: (seconds: number) => void, private time: () => number) {
    onTheme(() => this.make());
    new ResizeObserver(() => {
      for (const { plot } of this.graphs) plot.setSize({ width: this.width(), height: plot.height });
    }).observe(this.element);
  }

  show(run: Run | null, chosen: Chosen[]): void {
    this.run = run;
    this.chosen = chosen;
    this.make();
  }

  /** Moves the line of the time: all that a frame of play costs. */
  tick(): void {
    for (const { plot, now } of this.graphs) now.style.transform = `translateX(${plot.valToPos(this.time(), "x").toFixed(1)}px)`;
  }

  private width(): number { return Math.max(160, this.element.clientWidth - 4); }

  private make(): void {
    for (const { plot } of this.graphs) plot.destroy();
    this.graphs = [];
    this.element.replaceChildren();
    const run = this.run;
    if (!run?.ended) return;
    const there = this.chosen.flatMap((one) => {
      const series = run.series.get(`${one.body} ${one.quantity}`);
      return series ? [{ one, series }] : [];
    });
    const times = run.times();
    for (const unit of new Set(there.map(({ series }) => series.unit))) {
      const mine = there.filter(({ series }) => series.unit === unit);
      const lines = mine.flatMap(({ one, series }) => columns(series, one));
      const plot = new uPlot(
        {
          width: this.width(), height: 150, cursor: { sync: { key: "time" } }, legend: { live: true },
          scales: { x: { time: false } },
          axes: [axis("t (s)"), axis(unit)],
          series: [
            { label: "t (s)", value: (_, v) => (v === null ? "–" : v.toFixed(3)) },
            ...lines.map((line) => ({
              label: line.label, stroke: line.colour, width: line.bold ? 2.5 : 1.4, pxAlign: 0, show: line.show, dash: line.dash,
              value: (_: uPlot, v: number | null) => (v === null ? "–" : v.toPrecision(4)),
            })),
          ],
        },
        [times, ...lines.map((line) => line.values)] as uPlot.AlignedData,
        this.element,
      );
      const now = el("div", { class: "now" });
      plot.over.append(now);
      plot.over.addEventListener("click", () => {
        const at = plot.cursor.left;
        if (at !== undefined && at >= 0) this.seek(plot.posToVal(at, "x"));
      });
      plot.root.setAttribute("role", "img");
      plot.root.setAttribute("aria-label", `Graph over time of ${mine.map(({ one }) => `${one.quantity} of ${one.body}`).join(", ")} in ${unit}`);
      this.graphs.push({ plot, now });
    }
    this.tick();
  }
}

function axis(label: string): uPlot.Axis {
  const { faint, grid } = colours();
  return { label, stroke: faint, grid: { stroke: grid }, ticks: { stroke: grid }, size: 44, labelSize: 16, font: "11px system-ui", labelFont: "11px system-ui" };
}

function columns(series: Series, one: Chosen): { label: string; values: (number | null)[]; colour: string; bold: boolean; show: boolean; dash?: number[] }[] {
  const palette = colours().series, colour = palette[one.colour % palette.length]!;
  const clean = (values: number[]): (number | null)[] => values.map((value) => (Number.isFinite(value) ? value : null));
  const name = `${one.quantity} of ${one.body}`;
  const whole = { label: name, values: clean(sizes(series)), colour, bold: one.bold, show: true };
  if (!series.vector) return [whole];
  const part = (offset: number): number[] => Array.from({ length: series.values.length / 2 }, (_, k) => series.values[2 * k + offset]!);
  return [
    { ...whole, label: `|${one.quantity}| of ${one.body}` },
    { label: "→", values: clean(part(0)), colour, bold: false, show: false, dash: [6, 4] },
    { label: "↑", values: clean(part(1)), colour, bold: false, show: false, dash: [2, 4] },
  ];
}
