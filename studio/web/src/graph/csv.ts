// The observed quantities as a table (RFC 4180): times, then each series, a vector as its two parts.

import type { Series } from "../stage/run";

const quoted = (text: string): string => `"${text.replaceAll('"', '""')}"`;

export function csv(times: number[], series: Series[]): string {
  const names = ["t (s)", ...series.flatMap((one) =>
    (one.vector ? [" x", " y"] : [""]).map((axis) => `${one.quantity}${axis} of ${one.body} (${one.unit})`))];
  const rows = times.map((time, row) => [time, ...series.flatMap((one) =>
    one.vector ? [one.values[2 * row], one.values[2 * row + 1]] : [one.values[row]])]);
  const number = (value: number | undefined): string =>
    value === undefined || !Number.isFinite(value) ? "" : String(Number(value.toPrecision(8)));
  return [names.map(quoted).join(","), ...rows.map((row) => row.map(number).join(","))].join("\r\n") + "\r\n";
}
